!> Tilt of ball joints and bushings: the angle between the axis of a stud and the axis of its housing, which coincide at design.
!>
!>     between bodies i and j      θ = ∠(A_i u, A_j u)                      u: the common axis at design
!>     of an end of a rod          θ = |∠(A u, d) − ∠(u, d_design)|         A: body at this end, d: direction of the rod
!>
!> with ∠(p, q) = atan2(|p × q|, p·q), which is exact at small and at large angles. A rod (a `distance` joint) has no mass and may
!> turn about its own axis: θ is the smallest angle that such a rotation permits. If u is the direction of the rod, θ is the angle
!> between this direction in the body and the rod.
module ek_tilt
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   use ek_block, only: rotated
   use ek_relative_rotation, only: pose_t
   implicit none(type, external)
   private
   public :: tilt_t, tilt_between, tilt_of_end

   !> A rated tilt of a joint or bushing.
   type :: tilt_t
      character(:), allocatable :: name    !! name of the column without unit: '<joint>_tilt', or '<joint>_1_tilt' for an end of a rod
      integer :: joint = 0                 !! index of the joint; 0: a bushing
      integer :: bushing = 0               !! index of the bushing among the bushings; 0: a joint
      integer :: end = 0                   !! end of a rod, 1 on the first body, 2 on the second body; 0: between two bodies
      real(wp) :: axis(3) = 0.0_wp         !! axis of stud and housing at design, unit vector; 0: axis z of the bushing, or the rod
      real(wp) :: rating = 0.0_wp          !! largest permitted tilt [rad]
   end type tilt_t

contains

   !> The tilt between two bodies [rad], 0 to π.
   pure real(wp) function tilt_between(pose_i, pose_j, axis) result(tilt)
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp), intent(in) :: axis(3)      !! common axis at design, unit vector
      tilt = angle_of(rotated(pose_i%a, axis), rotated(pose_j%a, axis))
   end function tilt_between

   !> The tilt at an end of a rod [rad], 0 to π.
   pure real(wp) function tilt_of_end(pose, axis, rod, rod_at_design) result(tilt)
      type(pose_t), intent(in) :: pose     !! of the body at this end
      real(wp), intent(in) :: axis(3)      !! axis at design; 0: the direction of the rod
      real(wp), intent(in) :: rod(3), rod_at_design(3)      !! vectors from the first to the second end [m]

      if (norm2(axis) > 0.0_wp) then
         tilt = abs(angle_of(rotated(pose%a, axis), rod) - angle_of(axis, rod_at_design))
      else
         tilt = angle_of(rotated(pose%a, rod_at_design), rod)
      end if
   end function tilt_of_end

   !> The angle between two vectors [rad], 0 to π.
   pure real(wp) function angle_of(p, q) result(angle)
      real(wp), intent(in) :: p(3), q(3)
      angle = atan2(norm2(cross(p, q)), dot_product(p, q))
   end function angle_of

end module ek_tilt
