!> Derivatives of columns in the definitions of another program, from the derivatives of the columns of elastokin.
!>
!>     call begin_defined(workspace, program, names, found, list, defined)      after begin_derivatives; creates strings
!>     call find_derivatives(workspace, states, found)
!>     call define_derivatives(workspace, list, found, defined)                 at each design
!>
!> A column y = f(v₁, v₂, …) is a formula of variables. By the chain rule,
!>
!>     dy/dp = Σ ∂f/∂vₖ dvₖ/dp,   vₖ = nₖ + Σ columns
!>
!> The formula gives ∂f/∂vₖ exactly (ek_formula). nₖ is a number of the model at design, for instance the height of the wheel
!> centre. Its derivative is a difference quotient over neighbouring designs, whose states need not be solved.
module ek_defined_slopes
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: inputs_t
   use ek_defined_column, only: defined_t, define_columns, keep_named, design_number, defined_value
   use ek_workspace, only: workspace_t
   use ek_neighbour, only: point_t, go_to
   use ek_stencil, only: stencils, differentiate
   use ek_derivatives, only: derivatives_t
   implicit none(type, external)
   private
   public :: begin_defined, define_derivatives

contains

   !> Lists the columns of a program that follow from the differentiated columns of a case. Creates strings.
   subroutine begin_defined(workspace, program, names, found, list, defined)
      type(workspace_t), intent(in) :: workspace
      character(*), intent(in) :: program                  !! one of `programs` of ek_definition_rows
      character(*), intent(in) :: names(:)                 !! names of columns (is_named)
      type(derivatives_t), intent(in) :: found             !! after begin_derivatives with the columns of needed_columns
      type(defined_t), allocatable, intent(out) :: list(:)
      type(derivatives_t), intent(out) :: defined

      call define_columns(workspace%cases(found%case)%result%suspension, found%columns, program, list)
      call keep_named(names, list)
      defined%case = found%case
      defined%columns = list%head
      defined%directions = found%directions
   end subroutine begin_defined

   !> Computes values, derivatives and their errors of the columns of a list. No string is created.
   subroutine define_derivatives(workspace, list, found, defined)
      type(workspace_t), intent(in) :: workspace           !! of find_derivatives, at the same numbers
      type(defined_t), intent(in) :: list(:)
      type(derivatives_t), intent(inout) :: found          !! after find_derivatives
      type(derivatives_t), intent(inout) :: defined
      real(wp), allocatable :: slopes(:, :), errors(:, :)
      integer :: c, s, first

      defined%states = found%states
      defined%factor = found%factor
      defined%can_move = found%can_move
      call allocate_defined(size(list), size(found%directions), size(found%states), defined)
      call find_number_slopes(workspace, list, found, slopes, errors)
      do s = 1, size(found%states)
         first = 1
         do c = 1, size(list)
            associate (last => first + size(list(c)%sources) - 1)
               call chain(workspace, list(c), found, s, slopes(first:last, :), errors(first:last, :), defined%values(c, s), &
                  defined%slopes(c, :, s), defined%errors(c, :, s))
               first = last + 1
            end associate
         end do
      end do
   end subroutine define_derivatives

   subroutine allocate_defined(columns, directions, states, defined)
      integer, intent(in) :: columns, directions, states
      type(derivatives_t), intent(inout) :: defined

      if (allocated(defined%slopes)) then
         if (all(shape(defined%slopes) == [columns, directions, states])) return
         deallocate (defined%values, defined%slopes, defined%errors)
      end if
      allocate (defined%values(columns, states), defined%slopes(columns, directions, states), &
         defined%errors(columns, directions, states))
   end subroutine allocate_defined

   !> Computes a column at a state by the chain rule. A derivative is NaN if one of its terms is.
   !> Equation (E.12) of docs/theory/derivatives.md.
   pure subroutine chain(workspace, this, found, s, number_slopes, number_errors, value, slopes, errors)
      type(workspace_t), intent(in) :: workspace
      type(defined_t), intent(in) :: this
      type(derivatives_t), intent(in) :: found
      integer, intent(in) :: s                             !! index of the state in `found`
      real(wp), intent(in) :: number_slopes(:, :), number_errors(:, :)     !! (variable, direction): of the numbers of the model
      real(wp), intent(out) :: value, slopes(:), errors(:)
      real(wp) :: gradient(size(this%sources))
      integer :: k, v

      call defined_value(workspace%cases(found%case)%result%suspension, found%values(:, s), this, value, gradient)
      slopes = 0.0_wp
      errors = 0.0_wp
      do v = 1, size(this%sources)
         slopes = slopes + gradient(v)*number_slopes(v, :)
         errors = errors + abs(gradient(v))*number_errors(v, :)
         associate (source => this%sources(v))
            do k = 1, size(source%columns)
               if (source%columns(k) == 0) cycle
               slopes = slopes + gradient(v)*source%factors(k)*found%slopes(source%columns(k), :, s)
               errors = errors + abs(gradient(v)*source%factors(k))*found%errors(source%columns(k), :, s)
            end do
         end associate
      end do
   end subroutine chain

   !> Finds the derivatives of the numbers of the model in all variables of a list, one variable after the other. The first stencil
   !> whose points are all valid designs is used. The derivative is 0 for a variable without a number.
   subroutine find_number_slopes(workspace, list, found, slopes, errors)
      type(workspace_t), intent(in) :: workspace
      type(defined_t), intent(in) :: list(:)
      type(derivatives_t), intent(inout) :: found          !! its neighbour moves
      real(wp), allocatable, intent(out) :: slopes(:, :), errors(:, :)     !! (variable, direction) [SI per unit of the number]
      real(wp), allocatable :: here(:), y(:, :)
      type(point_t) :: points(0)
      type(inputs_t) :: inputs(0)
      logical :: has_inputs, is_valid
      integer :: c, n, p, k, kind

      n = sum([(size(list(c)%sources), c=1, size(list))])
      allocate (slopes(n, size(found%directions)), errors(n, size(found%directions)), source=0.0_wp)
      allocate (here(n), y(n, 4))
      if (.not. any([(any(list(c)%sources%number > 0), c=1, size(list))])) return
      associate (result => workspace%cases(found%case)%result)
         call read_numbers(result%suspension, list, here)
         do p = 1, size(found%directions)
            is_valid = .false.
            do kind = 1, merge(size(stencils), 0, found%can_move(p))
               do k = 1, 4
                  call go_to(workspace%x, found%directions(p), stencils(kind)%at(k), result, points, found%neighbour, inputs, &
                     has_inputs, is_valid)
                  if (.not. is_valid) exit
                  call read_numbers(found%neighbour%workspace%cases(found%case)%result%suspension, list, y(:, k))
               end do
               if (is_valid) exit
            end do
            if (is_valid) then
               call differentiate(stencils(kind), found%directions(p)%step, here, y, slopes(:, p), errors(:, p))
            else
               slopes(:, p) = ieee_value(1.0_wp, ieee_quiet_nan)
               errors(:, p) = slopes(:, p)
            end if
         end do
      end associate
   end subroutine find_number_slopes

   !> Reads the numbers of the model in all variables of a list.
   pure subroutine read_numbers(suspension, list, numbers)
      type(suspension_t), intent(in) :: suspension
      type(defined_t), intent(in) :: list(:)
      real(wp), intent(out) :: numbers(:)
      integer :: c, n, v

      n = 0
      numbers = 0.0_wp
      do c = 1, size(list)
         do v = 1, size(list(c)%sources)
            n = n + 1
            if (list(c)%sources(v)%number > 0) numbers(n) = design_number(suspension, list(c)%sources(v))
         end do
      end do
   end subroutine read_numbers

end module ek_defined_slopes
