!> The characteristics of an axle, from the responses of both wheels: roll rates, roll centres, and the vertical forces of the
!> ground under lateral forces.
module ek_axle_characteristics
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_loaded_wheels, only: loaded_t, stand_t, quotient, min_compliance
   implicit none(type, external)
   private
   public :: axle_characteristics_t, axle_characteristics, jacking_forces, roll_compliance

   !> Quantities of both wheels together. Without tyre rates, total_roll_rate, tramp_rate and tyre_roll_centre are 0.
   type :: axle_characteristics_t
      real(wp) :: suspension_roll_rate = 0.0_wp, total_roll_rate = 0.0_wp, tramp_rate = 0.0_wp   !! N m/rad
      real(wp) :: roll_centre(2) = 0.0_wp, tyre_roll_centre(2) = 0.0_wp     !! without and with tyre deflection: y, z [m]
      real(wp) :: force_roll_centre = 0.0_wp                !! height of the force-based roll centre above the contact points [m]
   end type axle_characteristics_t

contains

   !> Computes axle quantities: roll rates and roll centres.
   !>
   !> The roll moment is ½ t (F left − F right), with the track t. The unit forces +1 left and −1 right cause the moment t and the
   !> difference in height Δ of the contact points (roll_compliance). The slope of the moment over axle roll φ is t²/(cos²φ Δ).
   !>
   !> Force-based roll centre (W. C. Mitchell, "Asymmetric roll centers", SAE 983085; Milliken, Race Car Vehicle Dynamics, ch. 17):
   !> the height h above the contact points at which the lateral forces do not roll the body. With the contact points held at their
   !> heights, a unit force to the right at each contact point causes the vertical forces V of the ground. With the lateral
   !> positions y of the contact points, 2 h + y_left V_left + y_right V_right = 0.
   !> Equation (C.12) of docs/theory/compliance.md.
   !> Equation (S.6) of docs/theory/suspension.md.
   pure subroutine axle_characteristics(loaded, stand, has_centres, is)
      type(loaded_t), intent(in) :: loaded          !! two wheels
      type(stand_t), intent(in) :: stand
      logical, intent(in) :: has_centres            !! roll centres are requested
      type(axle_characteristics_t), intent(inout) :: is
      real(wp) :: at(2:3, 2), height, moment, lift(2)
      real(wp) :: wheel(2), tyre(2)      ! compliances, wheel under anti-phase loads [m/N]
      logical :: has_tyres

      has_tyres = minval(stand%tyre_rate) > 0.0_wp
      associate (patch => loaded%patch)
         height = roll_compliance(patch)
         moment = (stand%track/cos(stand%roll))**2
         is%suspension_roll_rate = quotient(moment, height, min_compliance)
         tyre = 0.0_wp
         if (has_tyres) then
            tyre = 1.0_wp/stand%tyre_rate
            is%total_roll_rate = quotient(moment, height + (tyre(1) + tyre(2)), min_compliance)
            ! each wheel's suspension and tyre in parallel support the unsprung masses in tramp
            wheel(1) = patch(3, 1, 3, 1) - patch(3, 1, 3, 2)
            wheel(2) = patch(3, 2, 3, 2) - patch(3, 2, 3, 1)
            is%tramp_rate = ieee_value(1.0_wp, ieee_quiet_nan)
            if (min(abs(wheel(1) + tyre(1)), abs(wheel(2) + tyre(2))) > min_compliance) is%tramp_rate = quotient(moment, &
               wheel(1)*tyre(1)/(wheel(1) + tyre(1)) + wheel(2)*tyre(2)/(wheel(2) + tyre(2)), min_compliance)
         end if
         if (.not. has_centres) return
         at = stand%centre(2:3, :) + stand%arm(2:3, :)
         is%roll_centre = roll_centre(patch, at, [0.0_wp, 0.0_wp])
         if (has_tyres) is%tyre_roll_centre = roll_centre(patch, at, tyre)
         lift = jacking_forces(patch, 1.0_wp)
         is%force_roll_centre = -0.5_wp*(at(2, 1)*lift(1) + at(2, 2)*lift(2))
      end associate
   end subroutine axle_characteristics

   !> Vertical forces V of the ground [N] on the left and the right contact point that hold the heights of these points under the
   !> lateral forces F. F is 1 N to the right on the left contact point and `right` on the right contact point. Then
   !> V = −CP_zz⁻¹ CP_zy F; NaN if the wheels cannot move independently in height.
   !> Equation (S.5) of docs/theory/suspension.md.
   pure function jacking_forces(patch, right) result(lift)
      real(wp), intent(in) :: patch(2:3, 2, 2:3, 2)
      real(wp), intent(in) :: right             !! N
      real(wp) :: lift(2), rise(2), determinant

      rise = patch(3, :, 2, 1) + right*patch(3, :, 2, 2)
      lift = ieee_value(1.0_wp, ieee_quiet_nan)
      associate (own => patch(3, 1, 3, 1), other => patch(3, 2, 3, 2), by_other => patch(3, 1, 3, 2), on_other => patch(3, 2, 3, 1))
         determinant = own*other - by_other*on_other
         if (abs(determinant) <= 1.0e-10_wp*abs(own*other) .or. abs(determinant) <= min_compliance**2) return
         lift(1) = -(other*rise(1) - by_other*rise(2))/determinant
         lift(2) = -(own*rise(2) - on_other*rise(1))/determinant
      end associate
   end function jacking_forces

   !> Difference in height of the contact points per force, upward on the left and downward on the right, CP33 − CP39 − CP93 + CP99
   !> [m/N].
   pure real(wp) function roll_compliance(patch)
      real(wp), intent(in) :: patch(2:3, 2, 2:3, 2)
      roll_compliance = patch(3, 1, 3, 1) - patch(3, 1, 3, 2) - patch(3, 2, 3, 1) + patch(3, 2, 3, 2)
   end function roll_compliance

   !> Intersection of the normals to the paths of both contact points in the front view [m]. The normal at the contact point
   !> (y0, z0) is dz (z − z0) + dy (y − y0) = 0, with the displacement (dy, dz) of the contact point in roll; dz includes the
   !> deflection of the tyre. If both normals are one line (level links, trailing arms, sliding pillars: the ground), every point
   !> of this line is an intersection; the result is the point midway between the contact points, the limit of symmetric changes.
   !> NaN if the normals are parallel to 1e-8 at a distance, or if a displacement vanishes.
   !> Equations (S.3), (S.4) of docs/theory/suspension.md.
   pure function roll_centre(patch, at, tyre) result(centre)
      real(wp), intent(in) :: patch(2:3, 2, 2:3, 2)
      real(wp), intent(in) :: at(2:3, 2)             !! lateral and vertical position of the contact points [m]
      real(wp), intent(in) :: tyre(2)                !! m/N
      real(wp), parameter :: parallel = 1.0e-8_wp    ! sine of an angle, and distance of parallel lines over the track
      real(wp) :: centre(2), left(2:3), right(2:3), span(2:3), of_left, of_right, determinant, size_of_both

      left = patch(:, 1, 3, 1) - patch(:, 1, 3, 2)
      left(3) = left(3) + tyre(1)
      right = patch(:, 2, 3, 2) - patch(:, 2, 3, 1)
      right(3) = right(3) + tyre(2)
      of_left = left(2)*at(2, 1) + left(3)*at(3, 1)
      of_right = right(2)*at(2, 2) + right(3)*at(3, 2)
      determinant = left(2)*right(3) - left(3)*right(2)
      size_of_both = sqrt(left(2)**2 + left(3)**2)*sqrt(right(2)**2 + right(3)**2)
      centre = ieee_value(1.0_wp, ieee_quiet_nan)
      if (size_of_both <= min_compliance**2) return
      if (abs(determinant) <= parallel*size_of_both) then
         span = at(:, 2) - at(:, 1)
         if (abs(left(2)*span(2) + left(3)*span(3)) <= parallel*sqrt(left(2)**2 + left(3)**2)*sqrt(span(2)**2 + span(3)**2)) &
            centre = 0.5_wp*(at(:, 1) + at(:, 2))
         return
      end if
      centre(1) = (of_left*right(3) - of_right*left(3))/determinant
      centre(2) = (left(2)*of_right - right(2)*of_left)/determinant
   end function roll_centre

end module ek_axle_characteristics
