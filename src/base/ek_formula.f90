!> A formula as a string, 'atan(tan(toe_deg)*cos(camber_deg))': its value and its exact derivatives.
!>
!>     sum     = product { (+ | -) product }
!>     product = factor { (* | /) factor }
!>     factor  = [-] number | variable | ( sum ) | function ( sum [ , sum ] )
!>
!> Functions: sin cos tan asin acos atan sqrt abs, and of two arguments atan2 hypot. A variable consists of letters, digits,
!> underscores and #. The derivatives are those of the chain rule, step by step, without differences.
module ek_formula
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: formula_t, read_formula, evaluate, longest_variable

   integer, parameter :: longest_variable = 64, most_steps = 160, most_variables = 16

   character(*), parameter :: functions(*) = [character(5) :: 'sin', 'cos', 'tan', 'asin', 'acos', 'atan', 'sqrt', 'abs', &
      'atan2', 'hypot'], digits = '0123456789', letters = 'abcdefghijklmnopqrstuvwxyz'
   integer, parameter :: of_two = 9        !! index of the first function of two arguments

   ! steps: the functions have their index in `functions`
   integer, parameter :: add = 21, subtract = 22, multiply = 23, divide = 24, negate = 25, number = 26, variable = 27

   !> A formula as steps on a stack.
   type :: formula_t
      integer :: steps = 0, used = 0                                !! number of steps, number of variables
      integer :: step(most_steps) = 0, which(most_steps) = 0        !! kind of a step; index of its variable
      real(wp) :: constant(most_steps) = 0.0_wp                     !! value of a number
      character(longest_variable) :: variables(most_variables) = '' !! names in the order of their first use
   end type formula_t

contains

   !> Reads a formula. `mistake` is '' for a valid formula, and otherwise states what was expected and the rest of the text.
   subroutine read_formula(text, formula, mistake)
      character(*), intent(in) :: text
      type(formula_t), intent(out) :: formula
      character(:), allocatable, intent(out) :: mistake
      integer :: at

      mistake = ''
      at = 1
      call read_sum(text, at, formula, mistake)
      if (mistake /= '') return
      if (next(text, at) /= ' ') mistake = 'expected an operator, found '//text(at:)
   end subroutine read_formula

   !> The next character that is not a blank; ' ' at the end of the text.
   character function next(text, at)
      character(*), intent(in) :: text
      integer, intent(inout) :: at            !! moves to this character

      next = ' '
      do while (at <= len(text))
         next = text(at:at)
         if (next /= ' ') return
         at = at + 1
      end do
   end function next

   recursive subroutine read_sum(text, at, formula, mistake)
      character(*), intent(in) :: text
      integer, intent(inout) :: at
      type(formula_t), intent(inout) :: formula
      character(:), allocatable, intent(inout) :: mistake
      character :: sign

      call read_product(text, at, formula, mistake)
      do
         sign = next(text, at)
         if (mistake /= '' .or. .not. (sign == '+' .or. sign == '-')) return
         at = at + 1
         call read_product(text, at, formula, mistake)
         call put(formula, merge(add, subtract, sign == '+'), mistake)
      end do
   end subroutine read_sum

   recursive subroutine read_product(text, at, formula, mistake)
      character(*), intent(in) :: text
      integer, intent(inout) :: at
      type(formula_t), intent(inout) :: formula
      character(:), allocatable, intent(inout) :: mistake
      character :: sign

      call read_factor(text, at, formula, mistake)
      do
         sign = next(text, at)
         if (mistake /= '' .or. .not. (sign == '*' .or. sign == '/')) return
         at = at + 1
         call read_factor(text, at, formula, mistake)
         call put(formula, merge(multiply, divide, sign == '*'), mistake)
      end do
   end subroutine read_product

   recursive subroutine read_factor(text, at, formula, mistake)
      character(*), intent(in) :: text
      integer, intent(inout) :: at
      type(formula_t), intent(inout) :: formula
      character(:), allocatable, intent(inout) :: mistake
      character :: first
      integer :: last

      first = next(text, at)
      if (first == '-') then
         at = at + 1
         call read_factor(text, at, formula, mistake)
         call put(formula, negate, mistake)
      else if (first == '(') then
         at = at + 1
         call read_sum(text, at, formula, mistake)
         call expect(text, at, ')', mistake)
      else if (index(digits//'.', first) > 0) then
         last = end_of(text, at, digits//'.')
         call put(formula, number, mistake)
         read (text(at:last), *) formula%constant(formula%steps)
         at = last + 1
      else if (index(letters//'#', first) > 0) then
         last = end_of(text, at, letters//digits//'_#')
         if (any(functions == text(at:last))) then
            call read_call(text, at, last, formula, mistake)
         else
            call put_variable(text(at:last), formula, mistake)
            at = last + 1
         end if
      else if (mistake == '') then
         mistake = 'expected a number, a name or (, found '''//text(min(at, len(text) + 1):)//''''
      end if
   end subroutine read_factor

   !> Reads the arguments of a function.
   recursive subroutine read_call(text, at, last, formula, mistake)
      character(*), intent(in) :: text
      integer, intent(inout) :: at            !! begin of the name
      integer, intent(in) :: last             !! end of the name
      type(formula_t), intent(inout) :: formula
      character(:), allocatable, intent(inout) :: mistake
      integer :: f

      f = findloc(functions == text(at:last), .true., dim=1)
      at = last + 1
      call expect(text, at, '(', mistake)
      call read_sum(text, at, formula, mistake)
      if (f >= of_two) then
         call expect(text, at, ',', mistake)
         call read_sum(text, at, formula, mistake)
      end if
      call expect(text, at, ')', mistake)
      call put(formula, f, mistake)
   end subroutine read_call

   !> The last position of a run of characters that begins at a position.
   pure integer function end_of(text, at, set) result(last)
      character(*), intent(in) :: text, set
      integer, intent(in) :: at

      last = verify(text(at:)//'!', set) + at - 2
   end function end_of

   !> Moves behind an expected character.
   subroutine expect(text, at, wanted, mistake)
      character(*), intent(in) :: text
      integer, intent(inout) :: at
      character, intent(in) :: wanted
      character(:), allocatable, intent(inout) :: mistake

      if (mistake /= '') return
      if (next(text, at) /= wanted) mistake = 'expected '//wanted//', found '''//text(min(at, len(text) + 1):)//''''
      at = at + 1
   end subroutine expect

   !> Appends a step.
   subroutine put(formula, step, mistake)
      type(formula_t), intent(inout) :: formula
      integer, intent(in) :: step
      character(:), allocatable, intent(inout) :: mistake

      if (formula%steps == most_steps) then
         if (mistake == '') mistake = 'the formula has too many steps'
         return
      end if
      formula%steps = formula%steps + 1
      formula%step(formula%steps) = step
   end subroutine put

   !> Appends a variable.
   subroutine put_variable(name, formula, mistake)
      character(*), intent(in) :: name
      type(formula_t), intent(inout) :: formula
      character(:), allocatable, intent(inout) :: mistake
      integer :: k

      k = findloc(formula%variables(:formula%used) == name, .true., dim=1)
      if (k == 0) then
         if (formula%used == most_variables .or. len(name) > longest_variable) then
            if (mistake == '') mistake = 'too many variables, or too long a name: '//name
            return
         end if
         formula%used = formula%used + 1
         k = formula%used
         formula%variables(k) = name
      end if
      call put(formula, variable, mistake)
      formula%which(formula%steps) = k
   end subroutine put_variable

   !> Evaluates a formula and its derivatives with respect to its variables. All results are NaN where a variable is not finite,
   !> and where the formula is not defined (a quotient by 0, asin beyond 1). At a corner (abs, sqrt and hypot at 0, asin at 1), the
   !> derivatives are NaN.
   pure subroutine evaluate(formula, x, value, gradient)
      type(formula_t), intent(in) :: formula
      real(wp), intent(in) :: x(:)                    !! of the variables, in their order
      real(wp), intent(out) :: value
      real(wp), intent(out) :: gradient(:)            !! d value/d x
      real(wp) :: v(most_steps), d(most_variables, most_steps)
      logical :: is_defined
      integer :: k, n, top

      n = formula%used
      value = ieee_value(1.0_wp, ieee_quiet_nan)
      gradient(:n) = value
      if (.not. all(ieee_is_finite(x(:n)))) return
      top = 0
      v(1) = value                  ! of a formula without steps
      d(:n, 1) = value
      is_defined = .true.
      do k = 1, formula%steps
         select case (formula%step(k))
         case (number)
            top = top + 1
            v(top) = formula%constant(k)
            d(:n, top) = 0.0_wp
         case (variable)
            top = top + 1
            v(top) = x(formula%which(k))
            d(:n, top) = 0.0_wp
            d(formula%which(k), top) = 1.0_wp
         case (negate)
            v(top) = -v(top)
            d(:n, top) = -d(:n, top)
         case (add:divide, of_two:of_two + 1)
            top = top - 1
            call apply_two(formula%step(k), v(top), d(:n, top), v(top + 1), d(:n, top + 1), is_defined)
         case default
            call apply_one(formula%step(k), v(top), d(:n, top), is_defined)
         end select
         if (.not. is_defined) return
      end do
      value = v(1)
      gradient(:n) = d(:n, 1)
   end subroutine evaluate

   !> Replaces a value and its derivatives by those of a function of it.
   pure subroutine apply_one(step, v, d, is_defined)
      integer, intent(in) :: step
      real(wp), intent(inout) :: v, d(:)
      logical, intent(inout) :: is_defined
      real(wp) :: slope

      is_defined = .true.
      slope = 1.0_wp
      select case (trim(functions(step)))
      case ('sin')
         slope = cos(v)
         v = sin(v)
      case ('cos')
         slope = -sin(v)
         v = cos(v)
      case ('tan')
         v = tan(v)
         slope = 1.0_wp + v**2
      case ('asin', 'acos')
         is_defined = abs(v) <= 1.0_wp
         if (.not. is_defined) return
         slope = merge(1.0_wp, -1.0_wp, functions(step) == 'asin')*reciprocal(sqrt((1.0_wp - v)*(1.0_wp + v)))
         if (functions(step) == 'asin') then
            v = asin(v)
         else
            v = acos(v)
         end if
      case ('atan')
         slope = 1.0_wp/(1.0_wp + v**2)
         v = atan(v)
      case ('sqrt')
         is_defined = v >= 0.0_wp
         if (.not. is_defined) return
         v = sqrt(v)
         slope = 0.5_wp*reciprocal(v)
      case ('abs')
         slope = v*reciprocal(abs(v))
         v = abs(v)
      end select
      d = slope*d
   end subroutine apply_one

   !> Replaces the first of two values and its derivatives by those of an operation on both.
   pure subroutine apply_two(step, v, d, w, e, is_defined)
      integer, intent(in) :: step
      real(wp), intent(inout) :: v, d(:)
      real(wp), intent(in) :: w, e(:)
      logical, intent(inout) :: is_defined
      real(wp) :: size_of

      is_defined = .true.
      select case (step)
      case (add)
         v = v + w
         d = d + e
      case (subtract)
         v = v - w
         d = d - e
      case (multiply)
         d = w*d + v*e
         v = v*w
      case (divide)
         is_defined = abs(w) > 0.0_wp
         if (.not. is_defined) return
         v = v/w
         d = (d - v*e)/w
      case default
         size_of = hypot(v, w)
         if (functions(step) == 'atan2') then
            is_defined = size_of > 0.0_wp
            if (.not. is_defined) return
            d = (w*d - v*e)/size_of**2
            v = atan2(v, w)
         else
            d = (v*d + w*e)*reciprocal(size_of)
            v = size_of
         end if
      end select
   end subroutine apply_two

   !> 1/x; NaN for 0.
   pure real(wp) function reciprocal(x)
      real(wp), intent(in) :: x

      if (abs(x) > 0.0_wp) then
         reciprocal = 1.0_wp/x
      else
         reciprocal = ieee_value(1.0_wp, ieee_quiet_nan)
      end if
   end function reciprocal

end module ek_formula
