!> Plausibility of the values of a deck's elements, loads, axle and cases, by the ranges of ek_plausible_range.
module ek_plausible_parts
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, quoted
   use ek_curve, only: curve_t
   use ek_element, only: element_t, axial_spring, damper, stop_spring, torsion_spring, bushing_element
   use ek_element_label, only: element_label, is_rod
   use ek_element_force, only: spring_tension
   use ek_measure, only: axis_axis, rotation, distance
   use ek_suspension, only: suspension_t, load_number
   use ek_rig_test, only: rig_test_t, rig_test, moves_heights
   use ek_case, only: case_t
   use ek_plausible_range, only: doubts_t, length, force
   implicit none(type, external)
   private
   public :: doubt_elements, doubt_loads, doubt_vehicle, doubt_cases

   real(wp), parameter :: felt = 1.0_wp        !! N: a smaller force is rounding of the preloads in the deck

contains

   !> Examines springs on two points, dampers, stops, torsion springs, bushings, and drivers with a stiffness.
   subroutine doubt_elements(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: k

      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            call doubts%examine(element%where, element_label(element))
            select case (element%kind)
            case (axial_spring)
               if (is_rod(suspension%elements, k)) then            ! it pushes or pulls
                  call doubts%judge('length at design', element%design_length)
                  call doubts%judge('rod rate', element%law%rate)
               else
                  call doubt_spring(element, doubts)
               end if
            case (damper)
               call doubts%judge('length at design', element%design_length)
               call doubts%judge('gas force', element%preload)
               call doubts%judge('gas rate', element%law%rate)
            case (stop_spring)
               call doubt_stop(element, doubts)
            case (torsion_spring)
               if (element%law%has_curve) then
                  call doubt_curve(element%law%curve, element, .true., doubts)
               else if (is_across(suspension, element)) then
                  call doubts%judge('torsion bar rate', element%law%rate)
               else if (min(element%measure%body_i, element%measure%body_j) > 0) then
                  call doubts%judge('torsion element rate', element%law%rate)
               else
                  call doubts%judge('torsion spring rate', element%law%rate)
               end if
            case (bushing_element)
               call doubt_bushing(element, doubts)
            end select
         end associate
      end do
      do k = 1, size(suspension%rows)
         if (.not. suspension%rows(k)%compliance > 0.0_wp) cycle
         associate (joint => suspension%joints(suspension%rows(k)%joint))
            if (any(suspension%terms(suspension%rows(k)%first)%measure%kind == [axis_axis, rotation])) cycle
            call doubts%examine(joint%where, 'joint '//quoted(joint%name))
            call doubts%judge('driver stiffness', 1.0_wp/suspension%rows(k)%compliance)
         end associate
      end do
   end subroutine doubt_elements

   !> Whether a torsion spring is an anti-roll bar: between a body on the left and a body on the right.
   pure logical function is_across(suspension, element)
      type(suspension_t), intent(in) :: suspension
      type(element_t), intent(in) :: element

      associate (i => element%measure%body_i, j => element%measure%body_j)
         is_across = min(i, j) > 0
         if (is_across) is_across = suspension%bodies(i)%origin(2)*suspension%bodies(j)%origin(2) < 0.0_wp
      end associate
   end function is_across

   !> Examines a spring: rate, length, static compression, and force at design.
   subroutine doubt_spring(spring, doubts)
      type(element_t), intent(in) :: spring
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: tension, slope

      if (spring%measure%kind == distance) call doubts%judge('length at design', spring%design_length)
      if (spring%law%has_curve) then
         call doubt_curve(spring%law%curve, spring, .false., doubts)
      else
         call doubts%judge('spring rate', spring%law%rate)
         if (spring%law%rate > 0.0_wp .and. spring%preload > felt) &
            call doubts%judge('static compression', spring%preload/spring%law%rate)
      end if
      call spring_tension(spring, spring%design_length, tension, slope)
      if (tension > felt) call doubts%add('tension', 'in tension at design, '//doubts%speak(force, tension)// &
         '; a coil carries compression only: check the bodies at its ends, and preload or free_length')
   end subroutine doubt_spring

   !> Examines a stop: clearance, transition, rate, and no contact at design.
   subroutine doubt_stop(stop, doubts)
      type(element_t), intent(in) :: stop
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: bears = 50.0_wp      ! N: more than in the transition of a stop that just touches
      real(wp) :: clearance, tension, slope

      clearance = stop%law%sign*(stop%law%reference - stop%design_length)
      call doubts%judge('length at design', stop%design_length)
      call doubts%judge('clearance', clearance)
      call doubts%judge('rounding', stop%law%rounding)
      if (stop%law%has_curve) then
         call doubt_curve(stop%law%curve, stop, .false., doubts)
      else
         call doubts%judge('stop rate', stop%law%rate)
      end if
      if (stop%law%sign < 0.0_wp .and. clearance >= stop%design_length) call doubts%add('reach', 'its clearance '// &
         doubts%speak(length, clearance)//' is longer than the '//doubts%speak(length, stop%design_length)// &
         ' between its points: contact cannot be reached')
      call spring_tension(stop, stop%design_length, tension, slope)
      if (abs(tension) > bears) call doubts%add('contact', 'in contact at design, '//doubts%speak(force, abs(tension))// &
         '; clearance is measured from design')
   end subroutine doubt_stop

   !> Examines a bushing: largest and smallest rates, ratio of rotational to translational rates, distance of the markers, curves.
   subroutine doubt_bushing(element, doubts)
      type(element_t), intent(in) :: element
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: rigid = 1.0e9_wp        ! N/m: such a bushing represents a joint, not rubber
      integer :: k

      associate (bushing => element%bushing, kt => element%bushing%kt, kr => element%bushing%kr)
         call doubts%judge('bushing gap', norm2(bushing%gap0))
         if (any(kt > 0.0_wp)) then
            call doubts%judge('bushing rate kt', maxval(kt))
            call doubts%judge('bushing rate kt', minval(kt, mask=kt > 0.0_wp))
         end if
         if (any(kr > 0.0_wp)) then
            call doubts%judge('bushing rate kr', maxval(kr))
            call doubts%judge('bushing rate kr', minval(kr, mask=kr > 0.0_wp))
         end if
         if (any(kt > 0.0_wp) .and. any(kr > 0.0_wp) .and. maxval(kt) < rigid) &
            call doubts%judge('size √(kr/kt)', sqrt(maxval(kr)/maxval(kt)))
         if (.not. bushing%has_curves) return
         do k = 1, 6
            if (bushing%laws(k)%has_curve) call doubt_curve(bushing%laws(k)%curve, element, k > 3, doubts)
         end do
      end associate
   end subroutine doubt_bushing

   !> Examines a curve over a deflection. The span of the curve and, over a length, its force and slope should be in the usual
   !> range. The curve should rise, as a restoring force must.
   subroutine doubt_curve(curve, element, is_angular, doubts)
      type(curve_t), intent(in) :: curve
      type(element_t), intent(in) :: element
      logical, intent(in) :: is_angular
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: head
      real(wp) :: values(size(curve%breaks)), span
      integer :: k, n

      n = size(values)
      values = [curve%coefficients(1, :n - 1), curve%end_value]
      span = curve%breaks(n) - curve%breaks(1)
      head = element_label(element)//', curve'
      if (allocated(curve%name)) head = head//' '//quoted(curve%name)
      call doubts%examine(element%where, head)
      if (is_angular) then
         call doubts%judge('angular span of the curve', span)
      else
         call doubts%judge('span of the curve', span)
         call doubts%judge('largest force of the curve', maxval(abs(values)))
         call doubts%judge('slope of the curve', abs(values(n) - values(1))/span)
         if (element%kind == stop_spring .and. curve%breaks(1) < 0.0_wp) call doubts%add('below 0', &
            'has points below 0; the penetration of a stop is never negative')
      end if
      k = findloc(values(2:) < values(:n - 1), .true., dim=1)
      if (k > 0) call doubts%add('fall', 'falls from point '//str(k)//' to point '//str(k + 1)// &
         '; give the restoring force, with the sign of the deflection')
      call doubts%examine(element%where, element_label(element))
   end subroutine doubt_curve

   !> Examines masses, gravity, loads without a value, the constant load of the road on each wheel, and a preload trim (`balance`)
   !> without constant loads.
   subroutine doubt_loads(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: same = 0.05_wp      ! m: at the patch or at the centre of a wheel
      real(wp) :: lift
      integer :: k, w

      call doubts%examine(suspension%where, '&model')
      call doubts%judge('gravity', suspension%gravity)
      do k = 1, size(suspension%bodies)
         call doubts%examine(suspension%bodies(k)%where, 'body '//quoted(suspension%bodies(k)%name))
         if (.not. suspension%bodies(k)%mass > 0.0_wp) cycle
         if (any(suspension%wheels%body == k)) then
            call doubts%judge('mass', suspension%bodies(k)%mass)
         else
            call doubts%judge('mass of a link', suspension%bodies(k)%mass)
         end if
      end do
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (load%start_of > 0) cycle
            call doubts%examine(load%where, 'load '//quoted(load%name))
            if (max(norm2(load%force), norm2(load%moment)) <= 0.0_wp) call doubts%add('nothing', 'its force and moment are zero')
         end associate
      end do
      do w = 1, size(suspension%wheels)
         do k = 1, size(suspension%loads)
            associate (load => suspension%loads(k), wheel => suspension%wheels(w))
               if (wheel%has_crown .and. load%body == wheel%body .and. load%wheel == 0 .and. .not. load%is_weight .and. &
                  norm2(load%arm - wheel%contact) <= millimetre) then
                  call doubts%examine(load%where, 'load '//quoted(load%name))
                  call doubts%add('fixed', 'acts at a point of the carrier, but the contact point of wheel '//quoted(wheel%name)// &
                     ' moves; at = '//quoted(wheel%name//'_contact')//' moves with it')
               end if
               if (load%is_case .or. load%is_weight .or. load%start_of > 0 .or. load%body /= wheel%body) cycle
               if (min(norm2(load%arm - wheel%contact), norm2(load%arm - wheel%centre)) > same) cycle
               lift = load%force(3)
               call doubts%examine(load%where, 'load '//quoted(load%name))
               if (norm2(load%force(1:2)) > abs(lift)) then
                  call doubts%add('level', 'the constant load on wheel '//quoted(wheel%name)// &
                     ' is more horizontal than vertical; forces are given as x, y, z, and the road pushes along +z')
               else if (lift < 0.0_wp) then
                  call doubts%add('down', doubts%speak(force, lift)//' along z pulls wheel '//quoted(wheel%name)// &
                     ' down; the road pushes a wheel up, along +z')
               else if (lift > 0.0_wp) then
                  call doubts%judge('static wheel load', lift)
               end if
            end associate
         end do
      end do
      if (suspension%balance == 'none') return
      call doubts%examine(suspension%where, '&model')
      if (all(suspension%loads%is_case .or. suspension%loads%start_of > 0)) call doubts%add('balance', &
         'balance = '//quoted(suspension%balance)//', but the deck has no constant load and no weight to balance')
   end subroutine doubt_loads

   !> Examines &axle and &steering.
   subroutine doubt_vehicle(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts

      associate (axle => suspension%axle, steering => suspension%steering)
         if (axle%has_axle) then
            call doubts%examine(axle%where, '&axle')
            call doubts%judge('wheelbase', axle%wheelbase)
            call doubts%judge('cg height', axle%cg_height)
            call doubts%judge('brake share', axle%brake_share)
            if (axle%cg_height > 0.6_wp*axle%wheelbase) call doubts%add('tall', 'cg_height '// &
               doubts%speak(length, axle%cg_height)//' is more than 0.6 of the wheelbase: are the two swapped?')
         end if
         if (steering%has_steering) then
            call doubts%examine(steering%where, '&steering')
            call doubts%judge('rack ratio', steering%ratio)
            call doubts%judge('rack travel', steering%travel)
         end if
      end associate
   end subroutine doubt_vehicle

   !> Examines the ranges of the cases, and the offset of the force in tests with an offset.
   subroutine doubt_cases(suspension, cases, doubts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(doubts_t), intent(inout) :: doubts
      type(rig_test_t) :: test
      character(:), allocatable :: quantity, vertical
      real(wp) :: far
      integer :: k, l

      do k = 1, size(cases)
         associate (case => cases(k))
            call doubts%examine(case%where, 'case '//quoted(case%name))
            far = max(abs(case%from), abs(case%to))
            vertical = ''
            if (allocated(case%vertical)) vertical = case%vertical
            quantity = ''
            test = rig_test(case%test)
            select case (merge('N  ', test%unit, test%action == moves_heights .and. vertical == 'force'))
            case ('mm')
               quantity = 'wheel travel'
            case ('deg')
               quantity = 'roll angle'
            case ('N')
               quantity = 'test force'
            case ('N m')
               quantity = 'test moment'
            case ('')
               if (suspension%steering%has_steering) quantity = 'rack displacement'
            end select
            if (case%drive == 'wheel_travel') quantity = 'wheel travel'
            l = load_number(suspension, case%load)
            if (l > 0) then
               if (norm2(suspension%loads(l)%force) > 0.0_wp) then
                  quantity = 'test force'
                  far = far*norm2(suspension%loads(l)%force)
               else
                  quantity = 'test moment'
                  far = far*norm2(suspension%loads(l)%moment)
               end if
            end if
            if (len(quantity) > 0) call doubts%judge(trim(quantity), far)
            if (test%has_trail) call doubts%judge('offset of the force', case%offset)
         end associate
      end do
   end subroutine doubt_cases

end module ek_plausible_parts
