!> The motion of an equilibrium state when a number p of the design changes: dz/dp = N⁻¹ ∂F/∂p.
!>
!> F = [f_ext − f_el − Φqᵀλ; c − Φ + Cλ] is the right-hand side of ek_kkt, which is zero at an equilibrium. N = −∂F/∂z is its
!> complete tangent along screw motions, and z contains the poses of the bodies and λ. ek_part_force computes ∂F/∂p.
!> N and F belong to given inputs. dz/dp therefore includes the motion of the static equilibrium, and needs no other state.
module ek_state_derivative
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, move_as_screw
   use ek_kkt, only: kkt_t, assemble, factorise, solve_many, whole_tangent
   use ek_skew_system, only: skew_system_t, has_skew_part, factorise_skew, solve_skew
   implicit none(type, external)
   private
   public :: solve_motions, displace

   real(wp), parameter :: singular = 1.0e-14_wp   !! pivot ratio below which the scaled matrix is singular to rounding

contains

   !> Converts ∂F/∂p to dz/dp, in place, for many numbers. With is_transposed, converts ∂y/∂z to a = N⁻ᵀ ∂y/∂z, for many columns y.
   !> If the tangent is singular, is_regular is .false. and the results are not valid.
   !> Equation (E.1) of docs/theory/derivatives.md.
   subroutine solve_motions(suspension, state, inputs, kkt, many, columns, is_regular, is_transposed)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state                   !! an equilibrium
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                    !! work space
      integer, intent(in) :: many
      real(wp), intent(inout) :: columns(kkt%n, many)      !! (unknown, number), or (unknown, column of the table)
      logical, intent(out) :: is_regular
      logical, intent(in), optional :: is_transposed
      type(skew_system_t) :: skew
      logical :: turns

      turns = .false.
      if (present(is_transposed)) turns = is_transposed

      call assemble(suspension, state, inputs, whole_tangent, kkt)
      if (has_skew_part(suspension, inputs)) then
         call factorise_skew(suspension, state, inputs, singular, kkt, skew)
         is_regular = .not. skew%is_singular
         if (is_regular) call solve_skew(skew, kkt, turns, many, columns)
      else
         call factorise(kkt)
         is_regular = .not. kkt%is_singular .and. kkt%pivot_ratio > singular
         if (is_regular) call solve_many(kkt, many, columns)
      end if
   end subroutine solve_motions

   !> Moves the state by a distance along a motion.
   pure subroutine displace(state, motion, distance, step, moved)
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: motion(:)                    !! motion dz/dp
      real(wp), intent(in) :: distance                     !! change of p
      real(wp), intent(inout) :: step(:)                   !! work space, one number per unknown of the bodies
      type(state_t), intent(inout) :: moved                !! on entry, any state of this model

      moved%poses(:) = state%poses
      step(:) = distance*motion(:size(step))
      call move_as_screw(moved, step)
      moved%reaction(:) = state%reaction + distance*motion(size(step) + 1:)
   end subroutine displace

end module ek_state_derivative
