!> The numbers of a design space as a caller has set them: in SI for the workspace, in the units of the deck for the caller, and
!> as the settings (as for --set) with which reading the deck gives the same design.
!>
!> After begin_numbers and add_path, only apply_settings creates strings.
module ek_design_numbers
   use ek_kinds, only: wp
   use ek_decimal, only: number_limit
   use ek_error, only: error_t
   use ek_parameter, only: choice_t, parameters_t, parameter_path
   use ek_number_range, only: is_inside
   use ek_reader, only: definition_t
   use ek_deck, only: deck_t, set_value
   use ek_factor_paths, only: shortest
   implicit none(type, external)
   private
   public :: design_numbers_t, begin_numbers, reset_numbers, place_number, add_path, put_path, put_at, is_legal_path, is_legal_at, &
      apply_settings

   !> A path that the caller has used.
   type :: path_setting_t
      character(:), allocatable :: path
      type(choice_t), allocatable :: found(:)
      real(wp) :: value = 0.0_wp           !! last value set [unit of the deck]
      integer :: turn = 0                  !! position in the order of setting; 0: not set
   end type path_setting_t

   !> The current numbers of a design, and the settings that changed them.
   type :: design_numbers_t
      real(wp), allocatable :: x(:)                 !! values of all parameters [SI, axes of the deck]
      real(wp), allocatable :: value(:)     !! values of all parameters [units of the deck], as the deck or the caller wrote them
      logical :: is_new = .false.                   !! whether the numbers changed since the workspace took them
      real(wp), allocatable, private :: unit(:), first_x(:), first_value(:)
      integer, allocatable, private :: turn(:)      !! position of each number in the order of setting; 0: not set by its index
      type(path_setting_t), allocatable, private :: settings(:)
      integer, private :: used = 0, turns = 0
   end type design_numbers_t

contains

   !> Stores the numbers of a deck as the current numbers and as the numbers of a reset.
   subroutine begin_numbers(design, numbers)
      type(definition_t), intent(in) :: design
      type(design_numbers_t), intent(out) :: numbers
      integer :: n, k

      n = design%parameters%used
      ! an assignment to what is not allocated reads its bounds
      allocate (numbers%first_x, source=design%parameters%x(:n))
      allocate (numbers%unit(n), numbers%first_value(n))
      do k = 1, n
         numbers%unit(k) = design%parameters%list(k)%unit
         numbers%first_value(k) = written(design%parameters%x(k)/design%parameters%list(k)%unit)
      end do
      allocate (numbers%settings(16))
      call reset_numbers(numbers)
   end subroutine begin_numbers

   !> Resets all numbers to the numbers of the deck.
   pure subroutine reset_numbers(numbers)
      type(design_numbers_t), intent(inout) :: numbers
      integer :: k

      numbers%x = numbers%first_x
      numbers%value = numbers%first_value
      if (allocated(numbers%turn)) deallocate (numbers%turn)
      allocate (numbers%turn(size(numbers%x)), source=0)
      do k = 1, numbers%used
         numbers%settings(k)%turn = 0
      end do
      numbers%turns = 0
      numbers%is_new = .true.
   end subroutine reset_numbers

   !> A number as a person would have written it, with at most 15 digits: the conversion to SI and back changes the last digit of a
   !> number. An integer of 15 digits and a power of ten up to 1e22 are exact, and one division or product rounds once. The result
   !> is the number nearest to the decimal, as if read from its string (W. D. Clinger, PLDI 1990).
   real(wp) function written(value)
      real(wp), intent(in) :: value
      integer :: places                            ! after the decimal point
      real(wp) :: digits
      character(32) :: text

      written = value
      if (.not. abs(value) > 0.0_wp) return
      places = 14 - floor(log10(abs(value)))
      if (abs(places) > 22) then
         write (text, '(es23.14e3)') value
         read (text, *) written
      else if (places >= 0) then
         digits = anint(value*10.0_wp**places)
         written = digits/10.0_wp**places
      else
         digits = anint(value/10.0_wp**(-places))
         written = digits*10.0_wp**(-places)
      end if
   end function written

   !> Index of the setting of a path that was used before; 0 if the path was not used.
   pure integer function place_number(numbers, path) result(k)
      type(design_numbers_t), intent(in) :: numbers
      character(*), intent(in) :: path

      do k = numbers%used, 1, -1
         if (numbers%settings(k)%path == path) return
      end do
   end function place_number

   !> Adds a path that is not set yet. `setting` returns the index of the path in the list of settings.
   subroutine add_path(numbers, path, found, setting)
      type(design_numbers_t), intent(inout) :: numbers
      character(*), intent(in) :: path
      type(choice_t), intent(in) :: found(:)              !! parameters to which the path leads
      integer, intent(out) :: setting

      if (numbers%used == size(numbers%settings)) numbers%settings = [numbers%settings, numbers%settings]   ! twice the size
      numbers%used = numbers%used + 1
      setting = numbers%used
      numbers%settings(setting)%path = path
      numbers%settings(setting)%found = found
      numbers%settings(setting)%turn = 0
   end subroutine add_path

   !> Sets all numbers of a path. A number on the right side of an axle receives the value times its sign (ek_parameter).
   pure subroutine put_path(numbers, setting, value)
      type(design_numbers_t), intent(inout) :: numbers
      integer, intent(in) :: setting
      real(wp), intent(in) :: value                       !! in the unit of the deck
      integer :: j

      numbers%turns = numbers%turns + 1
      associate (this => numbers%settings(setting))
         this%value = value
         this%turn = numbers%turns
         do j = 1, size(this%found)
            associate (k => this%found(j)%number)
               numbers%value(k) = this%found(j)%sign*value
               numbers%x(k) = (this%found(j)%sign*value)*numbers%unit(k)
            end associate
         end do
      end associate
      numbers%is_new = .true.
   end subroutine put_path

   !> Whether a value is inside the legal ranges of all numbers of a path.
   pure logical function is_legal_path(numbers, setting, value, parameters)
      type(design_numbers_t), intent(in) :: numbers
      integer, intent(in) :: setting
      real(wp), intent(in) :: value                       !! in the unit of the deck
      type(parameters_t), intent(in) :: parameters        !! prepared by begin_numbers
      integer :: j

      is_legal_path = .true.
      associate (found => numbers%settings(setting)%found)
         do j = 1, size(found)
            if (.not. is_legal_at(numbers, found(j)%number, found(j)%sign*value, parameters)) is_legal_path = .false.
         end do
      end associate
   end function is_legal_path

   !> Whether a value is inside the legal range of one number, and its magnitude is below the limit for all numbers.
   pure logical function is_legal_at(numbers, k, value, parameters)
      type(design_numbers_t), intent(in) :: numbers
      integer, intent(in) :: k
      real(wp), intent(in) :: value                       !! in the unit of the deck
      type(parameters_t), intent(in) :: parameters        !! prepared by begin_numbers

      is_legal_at = abs(value) < number_limit
      if (is_legal_at) is_legal_at = is_inside(parameters%list(k)%range, value*numbers%unit(k))
   end function is_legal_at

   !> Sets one number, given by its index. An equal value has no effect.
   pure subroutine put_at(numbers, k, value)
      type(design_numbers_t), intent(inout) :: numbers
      integer, intent(in) :: k
      real(wp), intent(in) :: value                       !! in the unit of the deck

      if (abs(value - numbers%value(k)) <= 0.0_wp) return
      numbers%turns = numbers%turns + 1
      numbers%turn(k) = numbers%turns
      numbers%value(k) = value
      numbers%x(k) = value*numbers%unit(k)
      numbers%is_new = .true.
   end subroutine put_at

   !> Applies the settings to a deck, in the order in which they were set.
   subroutine apply_settings(numbers, design, deck, error)
      type(design_numbers_t), intent(in) :: numbers
      type(definition_t), intent(in) :: design                 !! prepared by begin_numbers
      type(deck_t), intent(inout) :: deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      logical :: was_set(size(numbers%turn))               ! by an earlier setting
      integer :: turn, k, s, j

      turn = 0
      was_set = .false.
      do
         s = next(numbers%settings(:numbers%used)%turn, turn)
         k = next(numbers%turn, turn)
         if (s == 0 .and. k == 0) exit
         if (s > 0 .and. k > 0) then
            if (numbers%turn(k) < numbers%settings(s)%turn) s = 0
         end if
         if (s > 0) then
            turn = numbers%settings(s)%turn
            call set_value(deck, numbers%settings(s)%path, shortest(numbers%settings(s)%value), error)
            associate (this => numbers%settings(s))
               do j = 1, size(this%found)
                  ! the name of one side has priority over the name of both, also if it was set before
                  if (was_set(this%found(j)%number) .and. .not. allocated(error)) then
                     if (is_of_a_side(this%found(j)%number)) call set_one(this%found(j)%number, this%found(j)%sign*this%value)
                  end if
                  was_set(this%found(j)%number) = .true.
               end do
            end associate
         else
            turn = numbers%turn(k)
            call set_one(k, numbers%value(k))                  ! the last value, also that of a later setting
         end if
         if (allocated(error)) return
      end do

   contains

      !> Applies the value of one number by its own path.
      subroutine set_one(number, value)
         integer, intent(in) :: number
         real(wp), intent(in) :: value                     !! in the unit of the deck
         call set_value(deck, parameter_path(design%parameters%list(number), design%records, is_of_pair=.false.), &
            shortest(value), error)
      end subroutine set_one

      !> Whether a number belongs to one side of a mirrored deck.
      logical function is_of_a_side(number)
         integer, intent(in) :: number
         associate (parameter => design%parameters%list(number))
            is_of_a_side = parameter_path(parameter, design%records, is_of_pair=.false.) /= &
               parameter_path(parameter, design%records, is_of_pair=.true.)
         end associate
      end function is_of_a_side

      !> The index of the smallest turn that is larger than `last`; 0 if no turn is larger.
      pure integer function next(turns, last)
         integer, intent(in) :: turns(:), last
         next = 0
         if (any(turns > last)) next = minloc(turns, dim=1, mask=turns > last)
      end function next

   end subroutine apply_settings

end module ek_design_numbers
