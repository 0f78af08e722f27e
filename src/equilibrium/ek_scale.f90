!> The scale of a model: a characteristic length and stiffness, and the scaling of the system derived from them.
!>
!>     D S D     with D = 1/√k for Δr, 1/(L√k) for Δπ, √k for rows in metres, L√k for rows of cosines and angles
!>
!> With L [m] and k [N/m] all blocks of the matrix are of order one, so that pivots and condition numbers are independent of
!> the size of the model. D is rounded to powers of two, which makes the scaling exact.
module ek_scale
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, axis_axis, rotation
   use ek_element, only: element_kinds, bushing_element
   use ek_element_force, only: design_stiffness
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: characteristic, scale_factors

contains

   !> Computes the characteristic length (mean length of the arms of joints and bushings) and the characteristic stiffness
   !> (geometric mean of the rates of springs and bushings at design). If all these rates are zero, rotational rates / L² are used.
   subroutine characteristic(suspension, length, stiffness)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(out) :: length       !! L [m], at least 1 mm
      real(wp), intent(out) :: stiffness    !! k [N/m]; the rate of a coil spring if nothing is elastic
      real(wp) :: sum_log, least, rates(6)
      real(wp), parameter :: usual = 2.0e4_wp     ! N/m: a coil spring, for a model without elastic elements
      integer :: k, used

      least = 1.0e-3_wp     ! a model whose points all coincide still needs a length: 1 mm
      length = 0.0_wp
      used = 0
      do k = 1, size(suspension%terms)
         call include_arms(suspension%terms(k)%measure)
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         call include_arms(suspension%elements(k)%measure)
      end do
      length = max(length/max(used, 1), least)

      sum_log = 0.0_wp
      used = 0
      do k = 1, size(suspension%elements)
         associate (kind => suspension%elements(k)%kind)       ! gas, stops and anti-roll bars carry no wheel at design
            if (.not. (element_kinds(kind)%carries .or. kind == bushing_element)) cycle
         end associate
         rates = design_stiffness(suspension%elements(k))
         call include_rates(rates(1:3))
      end do
      if (used == 0) then      ! torsion springs and rotational bushing rates only
         do k = 1, size(suspension%elements)
            rates = design_stiffness(suspension%elements(k))
            call include_rates(rates(4:6)/length**2)
         end do
      end if
      stiffness = usual
      if (used > 0) stiffness = exp(sum_log/used)

   contains

      !> Adds the logarithms of the rates above zero.
      subroutine include_rates(rates)
         real(wp), intent(in) :: rates(3)      !! N/m
         real(wp) :: sum_of_three
         integer :: c

         sum_of_three = 0.0_wp
         do c = 1, 3
            if (rates(c) <= 0.0_wp) cycle      ! a NaN stays
            sum_of_three = sum_of_three + log(rates(c))
            used = used + 1
         end do
         sum_log = sum_log + sum_of_three
      end subroutine include_rates

      !> Adds the lengths of the arms of a measure on moving bodies.
      subroutine include_arms(measure)
         type(measure_t), intent(in) :: measure

         if (measure%body_i > 0) length = length + norm2(measure%arm_i)
         if (measure%body_j > 0) length = length + norm2(measure%arm_j)
         used = used + merge(1, 0, measure%body_i > 0) + merge(1, 0, measure%body_j > 0)
      end subroutine include_arms

   end subroutine characteristic

   !> Computes D of a model: six numbers per body, then one per row of Φ.
   !> Equation (K.5) of docs/theory/kkt.md.
   pure subroutine scale_factors(suspension, length, stiffness, scale)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: length, stiffness     !! from `characteristic`
      real(wp), intent(out) :: scale(:)             !! length: unknowns + rows of the system
      real(wp) :: of_place, of_angle, of_gap, of_direction
      integer :: nq, k, kind

      nq = suspension%unknowns()
      of_place = power_of_two(1.0_wp/sqrt(stiffness))
      of_angle = power_of_two(1.0_wp/(length*sqrt(stiffness)))
      of_gap = power_of_two(sqrt(stiffness))
      of_direction = power_of_two(sqrt(stiffness)*length)
      do k = 0, nq - 6, 6
         scale(k + 1:k + 3) = of_place
         scale(k + 4:k + 6) = of_angle
      end do
      do k = 1, suspension%constraints()
         kind = suspension%terms(suspension%rows(k)%first)%measure%kind
         scale(nq + k) = merge(of_direction, of_gap, kind == axis_axis .or. kind == rotation)
      end do
   end subroutine scale_factors

   !> The power of two at or below a positive number; a number that is not finite is returned unchanged.
   pure real(wp) function power_of_two(x)
      real(wp), intent(in) :: x
      power_of_two = x                              ! of a number that is not finite: itself
      if (ieee_is_finite(x)) power_of_two = scale(1.0_wp, exponent(x) - 1)
   end function power_of_two

end module ek_scale
