!> Plausibility of the response of a model at design: wheel rate, ride frequency, motion ratio of each spring, bump toe and bump
!> camber, the share of an anti-roll bar in the roll rate, and springs without force although the wheels are loaded.
!>
!> The cost is one factorisation of the tangent at design, and one more for each anti-roll bar. No equilibrium is solved.
module ek_plausible_response
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, pi, degree
   use ek_text, only: str, quoted
   use ek_measure, only: distance
   use ek_element, only: element_kinds, axial_spring, torsion_spring, stop_spring
   use ek_element_label, only: element_label, is_between_bodies
   use ek_element_force, only: spring_tension
   use ek_manoeuvre, only: standing_load
   use ek_suspension, only: suspension_t
   use ek_state, only: design_state, inputs_t
   use ek_kkt, only: kkt_t
   use ek_wheel_side, only: prefix_of
   use ek_compliance, only: compliance_t, move_of
   use ek_characteristics, only: motion_ratio
   use ek_kandc_list, only: kandc_t, list_kandc, choose_kandc
   use ek_kandc_columns, only: observe_kandc
   use ek_geometry_columns, only: length_ratio
   use ek_plausible_range, only: doubts_t, force, length, rotation_rate, is_usual
   use ek_plausible_springs, only: doubt_stop_names
   use ek_plausible_steering, only: find_opposite_rod
   implicit none(type, external)
   private
   public :: doubt_response, find_shortening

   real(wp), parameter :: newton_per_mm = 1.0e3_wp      !! 1 N/mm in N/m
   real(wp), parameter :: standard_gravity = 9.80665_wp !! m/s²
   character(*), parameter :: wanted(*) = [character(24) :: 'wheel_rate_n_per_mm', 'bump_toe_deg_per_m', 'bump_camber_deg_per_m']
   character(*), parameter :: of_roll = 'suspension_roll_rate_nm_per_deg', of_spring = '_motion_ratio'

contains

   !> Adds the remarks on the response of a model that can be solved.
   subroutine doubt_response(suspension, kkt, doubts)
      type(suspension_t), intent(in) :: suspension     !! after the preload trim (`balance`) if possible; not on a rig
      type(kkt_t), intent(inout) :: kkt                !! work space
      type(doubts_t), intent(inout) :: doubts
      type(kandc_t) :: kandc
      integer :: k

      if (size(suspension%wheels) == 0) return
      call respond_at_design(suspension, kkt, kandc)
      if (.not. kandc%compliance%is_known) return
      do k = 1, size(suspension%elements)
         if (suspension%elements(k)%kind == axial_spring) call doubt_motion(suspension, k, kandc, doubts)
      end do
      call doubt_stops(suspension, kandc%compliance, doubts)
      do k = 1, size(suspension%wheels)
         call doubt_wheel(suspension, k, kandc, doubts)
      end do
      if (has_coil(suspension)) call doubt_torsion(suspension, kandc%compliance, doubts)
      call doubt_load(suspension, doubts)
      call doubt_bar(suspension, kandc, kkt, doubts)
   end subroutine doubt_response

   !> Finds the springs, dampers and stops that get shorter when the wheels move up. All are .false. if the response is not known.
   subroutine find_shortening(suspension, kkt, shortens)
      type(suspension_t), intent(in) :: suspension     !! not on a rig
      type(kkt_t), intent(inout) :: kkt                !! work space
      logical, intent(out) :: shortens(:)              !! of the elements on one measure
      type(kandc_t) :: kandc
      integer :: k

      shortens = .false.
      if (size(suspension%wheels) == 0) return
      call respond_at_design(suspension, kkt, kandc)
      if (.not. kandc%compliance%is_known) return
      do k = 1, size(shortens)
         if (suspension%elements(k)%measure%kind == distance) &
            shortens(k) = length_ratio(suspension, kandc%compliance, design_state(suspension), k) < 0.0_wp
      end do
   end subroutine find_shortening

   !> Computes the columns of the response at design that are judged.
   subroutine respond_at_design(suspension, kkt, kandc)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt
      type(kandc_t), intent(out) :: kandc
      logical, allocatable :: is_wanted(:)
      integer :: k, w

      call list_kandc(suspension, kandc)
      allocate (is_wanted(kandc%used), source=.false.)
      do k = 1, kandc%used
         associate (name => kandc%names(k))
            is_wanted(k) = name == of_roll .or. index(trim(name)//' ', of_spring//' ') > 0
            do w = 1, size(suspension%wheels)
               is_wanted(k) = is_wanted(k) .or. any(prefix_of(suspension, w)//wanted == name)
            end do
         end associate
      end do
      call choose_kandc(kandc, is_wanted)
      call observe_kandc(suspension, design_state(suspension), inputs_t(), kkt, kandc)
   end subroutine respond_at_design

   !> The value of a column; NaN if the model does not define the column.
   pure real(wp) function value_of(kandc, name) result(value)
      type(kandc_t), intent(in) :: kandc
      character(*), intent(in) :: name
      integer :: k

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      k = findloc(kandc%names(:kandc%used), name, dim=1)
      if (k > 0) value = kandc%values(k)
   end function value_of

   !> Examines the names of stops. Springs that get longer in bump show another error, in the levers.
   subroutine doubt_stops(suspension, compliance, doubts)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: ratios(suspension%scalars)
      integer :: k

      ratios = 0.0_wp
      do k = 1, suspension%scalars
         if (suspension%elements(k)%measure%kind == distance) &
            ratios(k) = length_ratio(suspension, compliance, design_state(suspension), k)
      end do
      if (any(suspension%elements(:suspension%scalars)%kind == axial_spring .and. ratios > 0.05_wp)) return
      do k = 1, suspension%scalars
         if (suspension%elements(k)%kind == stop_spring) call doubt_stop_names(suspension, k, ratios(k), doubts)
      end do
   end subroutine doubt_stops

   !> Examines the motion ratio of a spring: its magnitude, and whether a spring in tension gets longer in bump.
   subroutine doubt_motion(suspension, k, kandc, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(kandc_t), intent(in) :: kandc
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: felt = 1.0_wp         ! N: less is rounding of the preloads in the deck
      real(wp) :: ratio, rate, tension, slope

      associate (spring => suspension%elements(k))
         if (is_between_bodies(spring)) return      ! a rod or a helper spring
         ratio = value_of(kandc, spring%name//of_spring)
         rate = value_of(kandc, prefix_of(suspension, 1)//wanted(1))
         if (.not. (ieee_is_finite(ratio) .and. ieee_is_finite(rate))) return
         call doubts%examine(spring%where, element_label(spring))
         call doubts%judge('motion ratio', ratio, ' (with it, the wheel rate is '//str(rate, 4)//' N/mm)', is_computed=.true.)
         call spring_tension(spring, spring%design_length, tension, slope)
         if (ratio > 0.0_wp .and. tension > felt) call doubts%add('tension', 'in tension at design, '// &
            doubts%speak(force, tension)//', and it gets longer in bump (motion ratio '//str(ratio, 3)// &
            '): is it on the wrong side of its rocker or lever? A coil carries compression only')
      end associate
   end subroutine doubt_motion

   !> Examines bump toe and bump camber of a wheel and, if the model has a spring that carries the car, wheel rate and ride
   !> frequency.
   subroutine doubt_wheel(suspension, w, kandc, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: w
      type(kandc_t), intent(in) :: kandc
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: value, load
      character(:), allocatable :: prefix

      prefix = prefix_of(suspension, w)
      associate (wheel => suspension%wheels(w))
         call doubts%examine(wheel%where, 'wheel '//quoted(wheel%name))
         value = value_of(kandc, prefix//wanted(1))*newton_per_mm
         load = standing_load(suspension, w)
         if (ieee_is_finite(value) .and. has_coil(suspension)) then
            call doubts%judge('wheel rate', value)
            ! a load that compresses the spring by less than 0.1 mm is not that of a car
            if (load > 1.0e-4_wp*value .and. value > 0.0_wp) &
               call doubts%judge('ride frequency', sqrt(value*standard_gravity/load)/(2.0_wp*pi))
         end if
         value = value_of(kandc, prefix//wanted(2))*degree
         if (ieee_is_finite(value)) call doubt_bump_toe(suspension, w, value, doubts)
         value = value_of(kandc, prefix//wanted(3))*degree
         if (ieee_is_finite(value)) call doubts%judge('bump camber', value)
      end associate
   end subroutine doubt_wheel

   !> Examines bump toe. A value far from that of an axle is a remark, too, if the ends of a rod are at opposite heights.
   subroutine doubt_bump_toe(suspension, w, value, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: w
      real(wp), intent(in) :: value                 !! rad/m
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: large = 30.0_wp        ! deg/m
      character(:), allocatable :: name
      real(wp) :: z(2)

      if (abs(value) > large*degree) then
         call find_opposite_rod(suspension, suspension%wheels(w)%body, name, z)
         if (name /= '') then
            call doubts%add('bump toe', 'bump toe '//str(value/degree, 4)//' deg/m; the ends of '//name//' are at z = '// &
               doubts%speak(length, z(1))//' and '//doubts%speak(length, z(2))//': check the signs of z')
            return
         end if
      end if
      call doubts%judge('bump toe', value)
   end subroutine doubt_bump_toe

   !> Examines whether the rotation of bushings carries much of the load in travel of all wheels. The remark is on the bushing with
   !> the largest share.
   subroutine doubt_torsion(suspension, compliance, doubts)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: most = 0.3_wp              ! share of the wheel rate
      real(wp) :: shares(size(suspension%elements)), vertical
      integer :: k, axis, worst

      shares = 0.0_wp
      vertical = vertical_rate(compliance)
      if (.not. vertical > 0.0_wp) return
      do k = suspension%scalars + 1, size(suspension%elements)
         associate (bushing => suspension%elements(k)%bushing)
            do axis = 1, 3
               if (bushing%kr(axis) > 0.0_wp) shares(k) = shares(k) + bushing%kr(axis)* &
                  turn_ratio(suspension, compliance, k, bushing%axes(:, axis))**2/vertical
            end do
         end associate
      end do
      if (.not. sum(shares) > most) return
      worst = findloc(shares > 0.999_wp*maxval(shares), .true., dim=1)      ! the first of both sides
      call doubts%examine(suspension%elements(worst)%where, element_label(suspension%elements(worst)))
      call doubts%add('torsion', 'the rotation of bushings gives '//str(nint(100.0_wp*sum(shares)))//' % of the wheel rate, '// &
         'most of it in this bushing (kr up to '//doubts%speak(rotation_rate, maxval(suspension%elements(worst)%bushing%kr))// &
         '; usually below 30 %); check the unit of kr')
   end subroutine doubt_torsion

   !> Sum of the vertical forces on all wheels per equal travel of all wheels [N/m]; 0 if the wheels cannot move alone.
   pure real(wp) function vertical_rate(compliance) result(rate)
      type(compliance_t), intent(in) :: compliance
      real(wp) :: determinant

      rate = 0.0_wp
      associate (c => compliance%response)
         if (compliance%wheels == 1) then
            if (c(3, 3) > 0.0_wp) rate = 1.0_wp/c(3, 3)
         else
            determinant = c(3, 3)*c(9, 9) - c(3, 9)*c(9, 3)
            if (determinant > 0.0_wp) rate = (c(3, 3) + c(9, 9) - c(3, 9) - c(9, 3))/determinant
         end if
      end associate
   end function vertical_rate

   !> Relative rotation of the bodies of an element about an axis per equal travel of all wheels [rad/m].
   pure real(wp) function turn_ratio(suspension, compliance, k, axis) result(ratio)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      integer, intent(in) :: k                      !! index of the element
      real(wp), intent(in) :: axis(3)
      real(wp) :: gradient(12), turns(2)
      integer :: n, w

      gradient = 0.0_wp
      gradient(4:6) = -axis
      gradient(10:12) = axis
      turns = 0.0_wp
      associate (m => suspension%elements(k)%measure)
         do w = 1, min(compliance%wheels, 2)
            turns(w) = move_of(compliance, 6*w - 3, gradient, m%body_i, m%body_j)
         end do
      end associate
      n = 6*compliance%wheels
      ratio = motion_ratio(compliance%response(:n, :n), turns)
      if (.not. ieee_is_finite(ratio)) ratio = 0.0_wp
   end function turn_ratio

   pure logical function has_coil(suspension)
      type(suspension_t), intent(in) :: suspension
      has_coil = any(element_kinds(suspension%elements%kind)%carries)
   end function has_coil

   !> Examines whether the preload trim (`balance`) leaves all springs without force although the road loads the wheels.
   subroutine doubt_load(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: nothing = 0.01_wp          ! share of the wheel load
      real(wp) :: most, load, tension, slope
      integer :: k, first

      if (suspension%balance == 'none') return
      load = 0.0_wp
      do k = 1, size(suspension%wheels)
         load = max(load, standing_load(suspension, k))
      end do
      most = 0.0_wp
      first = 0
      do k = 1, suspension%scalars
         associate (e => suspension%elements(k))
            if (e%kind == torsion_spring .and. min(e%measure%body_i, e%measure%body_j) == 0) return
            if (.not. element_kinds(e%kind)%carries) cycle
            if (e%measure%kind /= distance) return
            if (first == 0) first = k
            call spring_tension(e, e%design_length, tension, slope)
            most = max(most, abs(tension))
         end associate
      end do
      if (first == 0 .or. most >= nothing*load .or. .not. has_preload(suspension)) return
      associate (spring => suspension%elements(first))
         call doubts%examine(spring%where, element_label(spring))
         call doubts%add('bearing', 'it carries '//doubts%speak(force, most)//' at design, although the road '// &
            'pushes a wheel up with '//doubts%speak(force, load)//': what carries the wheel? '// &
            'Check the bodies of the spring and the rods that lead to it')
      end associate
   end subroutine doubt_load

   !> Whether any element has a preload; otherwise the preload trim (`balance`) was not applied.
   pure logical function has_preload(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: k

      has_preload = .false.
      do k = 1, size(suspension%elements)
         associate (e => suspension%elements(k))
            has_preload = has_preload .or. abs(e%preload) > 0.0_wp .or. norm2(e%bushing%preload_force) > 0.0_wp
         end associate
      end do
   end function has_preload

   !> Examines whether an anti-roll bar contributes to the roll rate. A bar is a torsion spring between a body on the left and a
   !> body on the right.
   subroutine doubt_bar(suspension, kandc, kkt, doubts)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(in) :: kandc
      type(kkt_t), intent(inout) :: kkt
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: least = 1.005_wp     ! a bar adds 10 % or more; this is far above rounding
      type(suspension_t), allocatable :: without
      type(kandc_t) :: other
      real(wp) :: with_bar, without_bar
      integer :: k

      with_bar = value_of(kandc, of_roll)
      if (.not. ieee_is_finite(with_bar)) return
      do k = 1, suspension%scalars
         associate (bar => suspension%elements(k))
            if (bar%kind /= torsion_spring .or. min(bar%measure%body_i, bar%measure%body_j) == 0) cycle
            if (bar%law%has_curve) cycle
            if (.not. is_usual('torsion bar rate', bar%law%rate)) cycle      ! then its rate is the cause
            if (suspension%bodies(bar%measure%body_i)%origin(2)*suspension%bodies(bar%measure%body_j)%origin(2) >= 0.0_wp) cycle
            allocate (without, source=suspension)
            without%elements(k)%law%rate = 0.0_wp
            call respond_at_design(without, kkt, other)
            deallocate (without)
            if (.not. other%compliance%is_known) cycle
            without_bar = value_of(other, of_roll)
            if (.not. ieee_is_finite(without_bar) .or. .not. without_bar > 0.0_wp .or. with_bar > least*without_bar) cycle
            call doubts%examine(bar%where, element_label(bar))
            call doubts%add('bar axis', 'it adds nothing to the roll rate of '//str(with_bar, 4)//' N m/deg: check its axis, '// &
               'its hinges and the links at its ends')
         end associate
      end do
   end subroutine doubt_bar

end module ek_plausible_response
