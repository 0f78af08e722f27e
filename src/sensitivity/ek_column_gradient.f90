!> The derivatives of columns with respect to the unknowns z of a state, at a fixed design, for the adjoint method:
!>
!>     dy/dp = ∂y/∂z dz/dp + ∂y/∂p = aᵀ ∂F/∂p + ∂y/∂p,   Nᵀ a = ∂y/∂z
!>
!> Here y is a column, p a number of the deck, F the right-hand side and N the KKT matrix. The method needs one solution for each
!> column instead of one for each number of the deck. ∂y/∂z is found by differences, with the formula by which the column is
!> observed. Most columns depend on one or two bodies; the unknowns of all other bodies are skipped.
module ek_column_gradient
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_motion, only: move_all
   use ek_kkt, only: kkt_t
   use ek_stencil, only: stencils, find_quotients
   use ek_column_observer, only: column_observer_t, observe_columns
   implicit none(type, external)
   private
   public :: find_gradients, parts_of_gradient, step_of_place

   integer, parameter :: parts_of_gradient = 3             !! the gradient, and two parts of its error
   real(wp), parameter :: step_of_place = 1.0e-4_wp        !! step of Δr [m]; for other unknowns, the step of equal work

   ! a motion in no special direction
   real(wp), parameter :: any_motion(6) = [0.83_wp, -0.71_wp, 0.92_wp, -0.64_wp, 0.77_wp, 0.58_wp]

contains

   !> Finds ∂y/∂z of all columns at a state, and two parts of the error of ∂y/∂z (see find_quotients).
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine find_gradients(suspension, state, inputs, kkt, observer, values, moved, gradients)
      type(suspension_t), intent(in) :: suspension         !! suspension on the rig
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                    !! work space
      type(column_observer_t), intent(inout) :: observer
      real(wp), intent(in) :: values(:)                    !! values of the columns at the state
      type(state_t), intent(inout) :: moved                !! work space: any state of this model
      real(wp), intent(inout) :: gradients(:, :, :)        !! (unknown, part, column)
      real(wp) :: y(size(values), 4), h
      integer :: b, c, k, j

      gradients = 0.0_wp
      moved%poses(:) = state%poses
      moved%reaction(:) = state%reaction
      do b = 1, size(suspension%bodies) + 1                ! the last: all reactions
         if (.not. is_read(b)) cycle
         do k = 6*b - 5, merge(6*b, kkt%n, b <= size(suspension%bodies))
            h = step_of_place*sqrt(kkt%stiffness)*kkt%scale(k)
            do j = 1, 4
               call move(b, k, stencils(1)%at(j)*h)
               call observe_columns(suspension, moved, inputs, kkt, observer, y(:, j))
            end do
            call put_back(b)
            do c = 1, size(values)
               call find_quotients(stencils(1), h, values(c), y(c, :), gradients(k, 1, c), gradients(k, 2, c), gradients(k, 3, c))
            end do
         end do
      end do

   contains

      !> Whether any column changes when body b moves; for b = number of bodies + 1, when the reactions change.
      logical function is_read(b)
         integer, intent(in) :: b

         is_read = .false.
         do j = 1, 4, 3
            call move(b, 0, stencils(1)%at(j)*step_of_place)
            call observe_columns(suspension, moved, inputs, kkt, observer, y(:, 1))
            call put_back(b)
            is_read = is_read .or. .not. all(abs(y(:, 1) - values) <= 0.0_wp)      ! or not a number
         end do
      end function is_read

      !> Moves one unknown of a body, or one reaction, away from the state. If `unknown` is 0, all unknowns of the body, or all
      !> reactions, are moved.
      subroutine move(b, unknown, distance)
         integer, intent(in) :: b, unknown
         real(wp), intent(in) :: distance
         real(wp) :: step(6)

         call put_back(b)
         if (b > size(suspension%bodies)) then
            if (unknown > 0) then
               associate (at => unknown - kkt%nq)
                  moved%reaction(at) = state%reaction(at) + distance
               end associate
            else
               moved%reaction(:) = state%reaction + distance*sqrt(kkt%stiffness)*kkt%scale(kkt%nq + 1:)
            end if
            return
         end if
         step = 0.0_wp
         if (unknown > 0) then
            step(unknown - 6*b + 6) = distance
         else
            step = distance*sqrt(kkt%stiffness)*kkt%scale(6*b - 5:6*b)*any_motion
         end if
         call move_all(1, step, moved%poses(b:b + 1))
      end subroutine move

      !> Restores the pose of a body, or the reactions, at the state.
      subroutine put_back(b)
         integer, intent(in) :: b

         if (b > size(suspension%bodies)) then
            moved%reaction(:) = state%reaction
         else
            moved%poses(b + 1) = state%poses(b + 1)
         end if
      end subroutine put_back

   end subroutine find_gradients

end module ek_column_gradient
