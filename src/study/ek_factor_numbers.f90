!> Conversion of factor values of a study to numbers of the deck.
module ek_factor_numbers
   use ek_kinds, only: wp
   use ek_parameter, only: choice_t, parameters_t
   use ek_matched_numbers, only: setting_path_t
   use ek_study, only: by_value, by_delta, not_given
   use ek_workspace, only: workspace_t, put_numbers, ready_cases
   implicit none(type, external)
   private
   public :: factor_paths_t, put_factor, deck_value, change_design

   !> The numbers of the deck that one factor changes.
   type :: factor_paths_t
      integer :: change = by_value                !! by_value, by_delta or by_scale (ek_study)
      type(choice_t), allocatable :: found(:)     !! the parameters, each once; empty if a path leads to no parameter
      type(setting_path_t), allocatable :: settings(:)     !! paths that change each number once in the text of the deck
   end type factor_paths_t

contains

   !> Changes the workspace to the design with the given factor values, from the numbers alone, and puts the cases of the workspace
   !> on the rig. `is_done` is .false. if the design must be read from the deck's strings: a path leads to no parameter, a value is
   !> outside its range, or the design may have a defect.
   subroutine change_design(factors, values, workspace, is_done)
      type(factor_paths_t), intent(in) :: factors(:)
      real(wp), intent(in) :: values(:)                    !! value of each factor, in the units of the deck
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_done
      real(wp) :: x(size(workspace%x))
      integer :: f

      is_done = .true.
      associate (parameters => workspace%definition%parameters)
         x = parameters%x(:parameters%used)
         do f = 1, size(factors)
            is_done = is_done .and. size(factors(f)%found) > 0
            call put_factor(factors(f), values(f), parameters, x)
         end do
      end associate
      call put_numbers(x, workspace)
      if (is_done) call ready_cases(workspace, is_done)
   end subroutine change_design

   !> Writes a factor value into x, by replacing, increasing or multiplying each number of the factor. A replacement or an increase
   !> is first multiplied by the sign of the number (ek_parameter).
   pure subroutine put_factor(factor, value, parameters, x)
      type(factor_paths_t), intent(in) :: factor
      real(wp), intent(in) :: value
      type(parameters_t), intent(in) :: parameters         !! parameters of the deck
      real(wp), intent(inout) :: x(:)                      !! numbers of the parameters [SI, axes of the deck]
      integer :: j

      do j = 1, size(factor%found)
         associate (number => factor%found(j)%number, sign => factor%found(j)%sign)
            associate (unit => parameters%list(number)%unit, at => x(number))
               select case (factor%change)
               case (by_value)
                  at = (sign*value)*unit
               case (by_delta)
                  at = at + (sign*value)*unit
               case default
                  at = at*value
               end select
            end associate
         end associate
      end do
   end subroutine put_factor

   !> The number of the deck that a factor changes, in the unit of the deck; NaN if the factor changes different numbers, or no
   !> parameter is known.
   pure real(wp) function deck_value(parameters, factor) result(value)
      type(parameters_t), intent(in) :: parameters
      type(factor_paths_t), intent(in) :: factor
      real(wp) :: this
      integer :: j

      value = not_given()
      do j = 1, size(factor%found)
         associate (number => factor%found(j)%number)
            this = factor%found(j)%sign*parameters%x(number)/parameters%list(number)%unit
         end associate
         if (j == 1) value = this
         if (abs(this - value) > 1.0e-12_wp*abs(value)) then
            value = not_given()
            exit
         end if
      end do
   end function deck_value

end module ek_factor_numbers
