!> Plausibility of the values of a deck's elements, loads, axle and cases, by the ranges of ek_plausible_range.
module ek_plausible_parts
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_curve, only: curve_t
   use ek_law, only: law_t
   use ek_element, only: element_t, element_label, axial_spring, damper, stop_spring, torsion_spring, bushing_element
   use ek_element_force, only: spring_tension
   use ek_measure, only: axis_axis, rotation, distance
   use ek_suspension, only: suspension_t, load_number
   use ek_case, only: case_t
   use ek_plausible_range, only: doubts_t, judge, speak, length, force
   implicit none(type, external)
   private
   public :: doubt_elements, doubt_loads, doubt_vehicle, doubt_cases

   real(wp), parameter :: felt = 1.0_wp        !! N: less is rounding of the preloads in the deck

contains

   !> Springs, dampers, stops, torsion springs, bushings, drivers with a stiffness.
   subroutine doubt_elements(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: k

      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k))
            select case (element%kind)
            case (axial_spring)
               call doubt_spring(element, doubts)
            case (damper)
               call judge(doubts, element%where, element_label(element), 'length at design', element%design_length)
               call judge(doubts, element%where, element_label(element), 'gas force', element%preload)
               call judge(doubts, element%where, element_label(element), 'gas rate', element%law%rate)
            case (stop_spring)
               call doubt_stop(element, doubts)
            case (torsion_spring)
               call doubt_torsion(element, doubts)
            case (bushing_element)
               call doubt_bushing(element, doubts)
            end select
         end associate
      end do
      do k = 1, size(suspension%rows)
         if (.not. suspension%rows(k)%compliance > 0.0_wp) cycle
         associate (joint => suspension%joints(suspension%rows(k)%joint))
            if (any(suspension%terms(suspension%rows(k)%first)%measure%kind == [axis_axis, rotation])) cycle
            call judge(doubts, joint%where, 'joint '//quoted(joint%name), 'driver stiffness', 1.0_wp/suspension%rows(k)%compliance)
         end associate
      end do
   end subroutine doubt_elements

   !> A spring: rate, length, and its force at design.
   subroutine doubt_spring(spring, doubts)
      type(element_t), intent(in) :: spring
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: thing
      real(wp) :: tension, slope

      thing = element_label(spring)
      if (spring%measure%kind == distance) call judge(doubts, spring%where, thing, 'length at design', spring%design_length)
      if (spring%law%has_curve) then
         call doubt_curve(spring%law, spring%where, thing, .false., doubts)
      else
         call judge(doubts, spring%where, thing, 'spring rate', spring%law%rate)
         if (spring%law%rate > 0.0_wp .and. spring%preload > felt) &
            call judge(doubts, spring%where, thing, 'static compression', spring%preload/spring%law%rate)
      end if
      call spring_tension(spring, spring%design_length, tension, slope)
      if (tension > felt) call doubts%add(spring%where, 'tension', thing//': in tension at design, '// &
         speak(doubts, force, tension)//'; a coil carries compression only: check '// &
         'the bodies at its ends, and preload or free_length')
   end subroutine doubt_spring

   !> A stop: clearance, transition, rate, and no contact at design.
   subroutine doubt_stop(stop, doubts)
      type(element_t), intent(in) :: stop
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: thing
      real(wp), parameter :: bears = 50.0_wp      ! N: more than in the transition of a stop that just touches
      real(wp) :: clearance, tension, slope

      thing = element_label(stop)
      clearance = stop%law%sign*(stop%law%reference - stop%design_length)
      call judge(doubts, stop%where, thing, 'length at design', stop%design_length)
      call judge(doubts, stop%where, thing, 'clearance', clearance)
      call judge(doubts, stop%where, thing, 'rounding', stop%law%rounding)
      if (stop%law%has_curve) then
         call doubt_curve(stop%law, stop%where, thing, .true., doubts)
      else
         call judge(doubts, stop%where, thing, 'stop rate', stop%law%rate)
      end if
      if (stop%law%sign < 0.0_wp .and. clearance >= stop%design_length) call doubts%add(stop%where, 'reach', thing// &
         ': its clearance '//speak(doubts, length, clearance)//' is longer than the '//speak(doubts, length, stop%design_length)// &
         ' between its points: contact cannot be reached')
      call spring_tension(stop, stop%design_length, tension, slope)
      if (abs(tension) > bears) call doubts%add(stop%where, 'contact', thing//': in contact at design, '// &
         speak(doubts, force, abs(tension))//'; clearance is measured from design')
   end subroutine doubt_stop

   subroutine doubt_torsion(spring, doubts)
      type(element_t), intent(in) :: spring
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: thing

      thing = element_label(spring)
      if (spring%law%has_curve) then
         call doubt_angular_curve(spring%law%curve, spring%where, thing, doubts)
      else if (min(spring%measure%body_i, spring%measure%body_j) > 0) then
         call judge(doubts, spring%where, thing, 'torsion bar rate', spring%law%rate)
      else
         call judge(doubts, spring%where, thing, 'torsion spring rate', spring%law%rate)
      end if
   end subroutine doubt_torsion

   !> A bushing: its largest and smallest rate, the distance of its markers, its curves.
   subroutine doubt_bushing(element, doubts)
      type(element_t), intent(in) :: element
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: rigid = 1.0e9_wp        ! N/m: such a bushing represents a joint, not rubber
      character(:), allocatable :: thing
      integer :: k

      thing = element_label(element)
      associate (bushing => element%bushing, where => element%where)
         call judge(doubts, where, thing, 'bushing gap', norm2(bushing%gap0))
         if (any(bushing%kt > 0.0_wp)) then
            call judge(doubts, where, thing, 'bushing rate kt', maxval(bushing%kt))
            call judge(doubts, where, thing, 'bushing rate kt', minval(bushing%kt, mask=bushing%kt > 0.0_wp))
         end if
         if (any(bushing%kr > 0.0_wp)) then
            call judge(doubts, where, thing, 'bushing rate kr', maxval(bushing%kr))
            call judge(doubts, where, thing, 'bushing rate kr', minval(bushing%kr, mask=bushing%kr > 0.0_wp))
         end if
         if (any(bushing%kt > 0.0_wp) .and. any(bushing%kr > 0.0_wp) .and. maxval(bushing%kt) < rigid) &
            call judge(doubts, where, thing, 'size √(kr/kt)', sqrt(maxval(bushing%kr)/maxval(bushing%kt)))
         if (.not. bushing%has_curves) return
         do k = 1, 6
            if (.not. bushing%laws(k)%has_curve) cycle
            if (k <= 3) call doubt_curve(bushing%laws(k), where, thing, .false., doubts)
            if (k > 3) call doubt_angular_curve(bushing%laws(k)%curve, where, thing, doubts)
         end do
      end associate
   end subroutine doubt_bushing

   !> A curve of force over deflection: its span and force are in the usual range, and it rises.
   subroutine doubt_curve(law, where, thing, is_stop, doubts)
      type(law_t), intent(in) :: law
      character(*), intent(in) :: where, thing
      logical, intent(in) :: is_stop
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: head
      integer :: n

      associate (curve => law%curve)
         n = size(curve%breaks)
         head = thing//', curve'//name_of(curve)
         call judge(doubts, where, head, 'span of the curve', curve%breaks(n) - curve%breaks(1))
         call judge(doubts, where, head, 'largest force of the curve', &
            max(maxval(abs(curve%coefficients(1, :))), abs(curve%end_value)))
         call judge(doubts, where, head, 'slope of the curve', abs(curve%end_value - curve%coefficients(1, 1))/ &
            (curve%breaks(n) - curve%breaks(1)))
         if (is_stop .and. curve%breaks(1) < 0.0_wp) call doubts%add(where, 'below 0', head// &
            ': has points below 0; the penetration of a stop is never negative')
      end associate
      call doubt_rise(law%curve, where, head, doubts)
   end subroutine doubt_curve

   subroutine doubt_angular_curve(curve, where, thing, doubts)
      type(curve_t), intent(in) :: curve
      character(*), intent(in) :: where, thing
      type(doubts_t), intent(inout) :: doubts

      call judge(doubts, where, thing//', curve'//name_of(curve), 'angular span of the curve', &
         curve%breaks(size(curve%breaks)) - curve%breaks(1))
      call doubt_rise(curve, where, thing//', curve'//name_of(curve), doubts)
   end subroutine doubt_angular_curve

   !> A restoring force must not decrease with deflection.
   subroutine doubt_rise(curve, where, head, doubts)
      type(curve_t), intent(in) :: curve
      character(*), intent(in) :: where, head
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: next
      integer :: k, n

      n = size(curve%breaks)
      do k = 1, n - 1
         next = curve%end_value
         if (k < n - 1) next = curve%coefficients(1, k + 1)
         if (next >= curve%coefficients(1, k)) cycle
         call doubts%add(where, 'fall', head//': falls from point '//str(k)//' to point '//str(k + 1)// &
            '; give the restoring force, with the sign of the deflection')
         return
      end do
   end subroutine doubt_rise

   !> " 'rubber'", or '' for a curve without name.
   pure function name_of(curve) result(text)
      type(curve_t), intent(in) :: curve
      character(:), allocatable :: text
      text = ''
      if (allocated(curve%name)) text = ' '//quoted(curve%name)
   end function name_of

   !> Masses, gravity, and the constant load of the road on each wheel.
   subroutine doubt_loads(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: same = 0.05_wp      ! m: at the patch or at the centre of a wheel
      real(wp) :: lift
      character(:), allocatable :: thing
      integer :: k, w

      call judge(doubts, suspension%where, '&model', 'gravity', suspension%gravity)
      do k = 1, size(suspension%bodies)
         if (suspension%bodies(k)%mass > 0.0_wp) call judge(doubts, suspension%bodies(k)%where, &
            'body '//quoted(suspension%bodies(k)%name), 'mass', suspension%bodies(k)%mass)
      end do
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (max(norm2(load%force), norm2(load%moment)) <= 0.0_wp) call doubts%add(load%where, 'nothing', &
               'load '//quoted(load%name)//': its force and moment are zero')
         end associate
      end do
      do w = 1, size(suspension%wheels)
         do k = 1, size(suspension%loads)
            associate (load => suspension%loads(k), wheel => suspension%wheels(w))
               if (load%is_case .or. load%is_weight .or. load%body /= wheel%body) cycle
               if (min(norm2(load%arm - wheel%contact), norm2(load%arm - wheel%centre)) > same) cycle
               lift = load%force(3)
               thing = 'load '//quoted(load%name)
               if (norm2(load%force(1:2)) > abs(lift)) then
                  call doubts%add(load%where, 'level', thing//': the constant load on wheel '//quoted(wheel%name)// &
                     ' is more horizontal than vertical; forces are given as x, y, z, and the road pushes along +z')
               else if (lift < 0.0_wp) then
                  call doubts%add(load%where, 'down', thing//': '//speak(doubts, force, lift)//' along z pulls wheel '// &
                     quoted(wheel%name)//' down; the road pushes a wheel up, along +z')
               else if (lift > 0.0_wp) then
                  call judge(doubts, load%where, thing, 'static wheel load', lift)
               end if
            end associate
         end do
      end do
      if (suspension%balance == 'none') return
      if (all(suspension%loads%is_case)) call doubts%add(suspension%where, 'balance', &
         '&model: balance = '//quoted(suspension%balance)//', but the deck has no constant load and no weight to balance')
   end subroutine doubt_loads

   !> &axle and &steering.
   subroutine doubt_vehicle(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts

      associate (axle => suspension%axle, steering => suspension%steering)
         if (axle%has_axle) then
            call judge(doubts, axle%where, '&axle', 'wheelbase', axle%wheelbase)
            call judge(doubts, axle%where, '&axle', 'cg height', axle%cg_height)
            call judge(doubts, axle%where, '&axle', 'brake share', axle%brake_share)
            if (axle%cg_height > 0.6_wp*axle%wheelbase) call doubts%add(axle%where, 'tall', '&axle: cg_height '// &
               speak(doubts, length, axle%cg_height)//' is more than 0.6 of the wheelbase: are the two swapped?')
         end if
         if (steering%has_steering) then
            call judge(doubts, steering%where, '&steering', 'rack ratio', steering%ratio)
            call judge(doubts, steering%where, '&steering', 'rack travel', steering%travel)
         end if
      end associate
   end subroutine doubt_vehicle

   !> The range of the cases.
   subroutine doubt_cases(suspension, cases, doubts)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(doubts_t), intent(inout) :: doubts
      character(:), allocatable :: thing, quantity, vertical
      real(wp) :: far
      integer :: k, l

      do k = 1, size(cases)
         associate (case => cases(k))
            thing = 'case '//quoted(case%name)
            far = max(abs(case%from), abs(case%to))
            vertical = ''
            if (allocated(case%vertical)) vertical = case%vertical
            quantity = ''
            select case (case%test)
            case ('parallel_travel', 'opposite_travel', 'single_travel')
               quantity = merge('test force  ', 'wheel travel', vertical == 'force')
            case ('roll')
               quantity = 'roll angle'
            case ('steering')
               if (suspension%steering%has_steering) quantity = 'rack displacement'
            case ('lateral_force', 'braking', 'traction', 'vertical_force')
               quantity = 'test force'
            case ('aligning_torque')
               quantity = 'test moment'
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
            if (len(quantity) > 0) call judge(doubts, case%where, thing, trim(quantity), far)
            if (case%test == 'lateral_force') call judge(doubts, case%where, thing, 'offset of the force', case%offset)
         end associate
      end do
   end subroutine doubt_cases

end module ek_plausible_parts
