!> Springs that keep their lengths: a suspension whose geometry stays as drawn under any load.
module ek_held_springs
   use ek_kinds, only: wp
   use ek_element, only: element_kinds
   use ek_element_force, only: spring_tension
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: hold_springs

   real(wp), parameter :: stiffer = 1.0e5_wp       !! a change of 10 kN moves a spring of 30 N/mm by 3 µm
   real(wp), parameter :: softest = 1.0e3_wp       !! N/m, N m/rad: of a spring without a rate at design

contains

   !> Makes all springs that carry the car stiff about design, with the forces that they have at design. Springs that act together
   !> share a load in proportion to their rates at design.
   pure subroutine hold_springs(suspension)
      type(suspension_t), intent(inout) :: suspension      !! completed, with trimmed preloads
      real(wp) :: tension, slope
      integer :: k

      do k = 1, suspension%scalars
         associate (spring => suspension%elements(k))
            if (.not. element_kinds(spring%kind)%carries) cycle
            call spring_tension(spring, spring%design_length, tension, slope)
            spring%law%has_curve = .false.
            spring%law%reference = spring%design_length
            spring%law%rate = stiffer*max(slope, softest)
            spring%preload = -tension
         end associate
      end do
   end subroutine hold_springs

end module ek_held_springs
