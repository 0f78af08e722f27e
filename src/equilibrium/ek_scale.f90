!> The scale of a model: a characteristic length and stiffness, and the scaling of the system derived from them.
!>
!>     D S D     with D = 1/√k for Δr, 1/(L√k) for Δπ, √k for rows in metres, L√k for rows between directions
!>
!> With L [m] and k [N/m] all blocks of the matrix are of order one, so that pivots and condition numbers are independent of
!> the size of the model. D is rounded to powers of two, which makes the scaling exact.
module ek_scale
   use ek_kinds, only: wp
   use ek_measure, only: axis_axis, rotation
   use ek_element, only: element_kinds, bushing_element
   use ek_element_force, only: design_stiffness
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: characteristic, scale_factors

contains

   !> The size of the mechanism (mean distance of its attachment points from the reference points)
   !> and the geometric mean of its stiffnesses at design.
   subroutine characteristic(suspension, length, stiffness)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(out) :: length       !! L [m], at least 1 mm
      real(wp), intent(out) :: stiffness    !! k [N/m]; that of a coil spring if nothing is elastic
      real(wp) :: sum_log, least, rates(6)
      real(wp), parameter :: usual = 2.0e4_wp     ! N/m: a coil spring, for a model without elastic elements
      integer :: k, count, axis

      least = 1.0e-3_wp     ! a model whose points all coincide still needs a length: 1 mm
      length = 0.0_wp
      count = 0
      do k = 1, size(suspension%terms)
         associate (m => suspension%terms(k)%measure)
            if (m%body_i > 0) call include(m%arm_i)
            if (m%body_j > 0) call include(m%arm_j)
         end associate
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         associate (m => suspension%elements(k)%measure)
            if (m%body_i > 0) call include(m%arm_i)
            if (m%body_j > 0) call include(m%arm_j)
         end associate
      end do
      length = max(length/max(count, 1), least)

      sum_log = 0.0_wp
      count = 0
      do k = 1, size(suspension%elements)
         associate (kind => suspension%elements(k)%kind)       ! gas, stops and anti-roll bars carry no wheel at design
            if (.not. (element_kinds(kind)%carries .or. kind == bushing_element)) cycle
         end associate
         rates = design_stiffness(suspension%elements(k))
         do axis = 1, 3
            call include_rate(rates(axis))
         end do
      end do
      if (count == 0) call include_angles()
      stiffness = usual
      if (count > 0) stiffness = exp(sum_log/count)

   contains

      !> The stiffness of a model with torsion springs and rotational bushing rates only.
      subroutine include_angles()
         integer :: k, axis

         do k = 1, size(suspension%elements)
            rates = design_stiffness(suspension%elements(k))
            do axis = 4, 6
               call include_rate(rates(axis)/length**2)
            end do
         end do
      end subroutine include_angles

      subroutine include_rate(rate)
         real(wp), intent(in) :: rate      !! N/m
         if (rate <= 0.0_wp) return
         sum_log = sum_log + log(rate)
         count = count + 1
      end subroutine include_rate

      subroutine include(arm)
         real(wp), intent(in) :: arm(3)
         length = length + norm2(arm)
         count = count + 1
      end subroutine include

   end subroutine characteristic

   !> D of a model: six numbers per body, then one per row of Φ.
   !> Equation (K.5) of docs/theory/kkt.md.
   pure subroutine scale_factors(suspension, length, stiffness, scale)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: length, stiffness     !! from `characteristic`
      real(wp), intent(out) :: scale(:)             !! length: unknowns + rows of the system
      integer :: nq, k

      nq = suspension%unknowns()
      do k = 1, nq
         scale(k) = power_of_two(1.0_wp/sqrt(stiffness))
         if (mod(k - 1, 6) >= 3) scale(k) = power_of_two(1.0_wp/(length*sqrt(stiffness)))
      end do
      do k = 1, suspension%constraints()
         scale(nq + k) = power_of_two(sqrt(stiffness))
         select case (suspension%terms(suspension%rows(k)%first)%measure%kind)
         case (axis_axis, rotation)
            scale(nq + k) = power_of_two(sqrt(stiffness)*length)
         end select
      end do
   end subroutine scale_factors

   !> The power of two at or below a positive number.
   pure real(wp) function power_of_two(x)
      real(wp), intent(in) :: x
      power_of_two = scale(1.0_wp, exponent(x) - 1)
   end function power_of_two

end module ek_scale
