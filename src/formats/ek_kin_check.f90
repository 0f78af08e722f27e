!> The parts of an axle of IPGKinematics that can be imported, and the load on its wheels.
module ek_kin_check
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_kin, only: kin_t, wheel_centre, contact, off
   implicit none(type, external)
   private
   public :: is_used_mount, check_kin, wheel_load, standard_gravity

   real(wp), parameter :: standard_gravity = 9.80665_wp     !! m/s²

contains

   !> Whether the deck uses bushing k of the list in the file.
   pure logical function is_used_mount(kin, k)
      type(kin_t), intent(in) :: kin
      integer, intent(in) :: k
      is_used_mount = any(k == [3, 4, 5, 6, 7]) .or. (kin%has_subframe .and. k <= 2)
   end function is_used_mount

   !> Reports parts that the program does not model, and numbers that do not define a valid model.
   subroutine check_kin(kin, flaws)
      type(kin_t), intent(in) :: kin
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: shares(2)

      if (index(kin%axle_type, 'Querlenker') /= 1) call flaws%add(0, 'expected the axle Querlenker (double wishbones), found '// &
         shown(kin%axle_type))
      if (kin%has_elastic_gearbox) call flaws%add(0, 'expected a rack housing without bushings (0), found 1; it is not imported')
      if (kin%bar == 3) call flaws%add(0, 'expected no bar (0) or a U-shaped bar on the lower arm (1) or the '// &
         'carrier (2), found a bar on the rockers (3); it is not imported')
      if (kin%third /= off) call flaws%add(0, 'expected no third spring (0), found '//str(kin%third)//'; it is not imported')
      if (kin%spring /= off .and. kin%rod /= off) call flaws%add(0, 'expected a coil on the axle or on a pushrod, found both')
      if (kin%spring == off .and. kin%rod == off) call flaws%add(0, 'expected a coil on the axle or on a pushrod, found neither')
      if (.not. kin%wheelbase > 0.0_wp) call flaws%add(0, 'expected a wheelbase above 0, found '//str(kin%wheelbase))
      if (.not. kin%cg_height > 0.0_wp) call flaws%add(0, 'expected a height of the centre of gravity above 0, found '// &
         str(kin%cg_height))
      if (.not. kin%tyre_rate > 0.0_wp) call flaws%add(0, 'expected a tyre rate above 0, found '//str(kin%tyre_rate))
      if (.not. kin%at(3, wheel_centre) > kin%at(3, contact)) call flaws%add(0, 'expected the wheel centre above the contact '// &
         'point, found z = '//str(kin%at(3, wheel_centre))//' and '//str(kin%at(3, contact)))
      shares = [kin%brake_share, kin%drive_share]
      if (any(shares < 0.0_wp) .or. any(shares > 1.0_wp)) call flaws%add(0, &
         'expected shares of braking and drive from 0 to 1, found '//str(shares(1))//' and '//str(shares(2)))
      if (kin%has_forces .and. .not. wheel_load(kin) > 0.0_wp) call flaws%add(0, 'expected masses above 0, found none')
      if (kin%coil%factor < 0.0_wp .or. kin%rod_law%factor < 0.0_wp) call flaws%add(0, &
         'expected factors of the spring curves of 0 or more, found one below')
   end subroutine check_kin

   !> Load on a wheel [N]: half the weight of the axle and of all masses that the axle carries, without the anti-roll bar.
   pure real(wp) function wheel_load(kin)
      type(kin_t), intent(in) :: kin
      real(wp) :: whole, half

      half = kin%lower_arm + kin%carrier + kin%wheel + kin%upper_arm + kin%tie_rod
      if (kin%rod /= off) half = half + kin%rocker
      whole = kin%load + kin%body + kin%rack + kin%housing
      if (kin%has_subframe) whole = whole + kin%subframe
      wheel_load = (half + whole/2)*standard_gravity
   end function wheel_load

end module ek_kin_check
