!> &spring, &damper, &stop and &torsion: elastic elements of one measure.
module ek_reader_springs
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_curve, only: curve_t, look_up_curve
   use ek_measure, only: distance
   use ek_element, only: new_spring, new_damper, new_stop, new_torsion, new_measure_spring, is_of_angle, element_t
   use ek_suspension, only: suspension_t
   use ek_builder, only: add_element
   use ek_group, only: measure_group, spring_group, damper_group, stop_group, torsion_group, word_length
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, look_up, find_point, find_bodies, find_direction
   use ek_reader_curves, only: find_law, find_curve, check_rate, check_either
   implicit none(type, external)
   private
   public :: read_scalar_elements

   real(wp), parameter :: usual_rounding = 0.5e-3_wp   !! m: a typical soft lip of a bump stop

   !> The bodies and points of an element between two points.
   type :: ends_t
      integer :: body(2) = 0
      real(wp) :: at(3, 2) = 0.0_wp        !! m, x rearward
   end type ends_t

contains

   !> All elements of one measure. Their order here is that of their columns in the results.
   subroutine read_scalar_elements(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension

      call read_springs(deck, draft, suspension)
      call read_dampers(deck, draft, suspension)
      call read_stops(deck, draft, suspension)
      call read_torsions(deck, draft, suspension)
   end subroutine read_scalar_elements

   !> &spring.
   subroutine read_springs(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, bodies(2), at(2), measure, curve
      real(wp) :: rate, preload, free_length
      logical :: balance
      namelist /spring/ name, bodies, at, measure, rate, curve, preload, free_length, balance
      type(element_t) :: element
      type(ends_t) :: ends
      real(wp), allocatable :: free
      type(curve_t), allocatable :: law      ! unallocated (none, or rejected): an absent argument
      real(wp) :: force_unit, value_unit     ! SI per unit of the deck
      integer :: k, found, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= spring_group) cycle
         name = ''
         bodies = ''
         at = ''
         measure = ''
         curve = ''
         rate = 0.0_wp
         preload = 0.0_wp
         free_length = 1.0_wp
         balance = .true.
         read (draft%cards(k)%text, nml=spring, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         force_unit = draft%units%force
         value_unit = draft%units%length
         if (has_key(deck, k, 'measure')) then
            call find_measure()
         else
            if (.not. has_key(deck, k, 'bodies')) call complain(draft, deck, k, '', &
               "'bodies' is missing (give bodies and at, or measure)")
            if (.not. has_key(deck, k, 'at')) call complain(draft, deck, k, '', "'at' is missing (give bodies and at, or measure)")
            call find_ends(draft, deck, k, bodies, at, ends)
         end if
         call find_law(draft, deck, k, rate, trim(curve), value_unit, force_unit, law)
         if (.not. free_length > 0.0_wp) &
            call complain(draft, deck, k, 'free_length', 'free_length must be above 0, found '//str(free_length))
         if (has_key(deck, k, 'preload') .and. has_key(deck, k, 'free_length')) &
            call complain(draft, deck, k, 'free_length', 'give either preload or free_length, not both')
         if (.not. draft%cards(k)%is_good) cycle

         if (allocated(free)) deallocate (free)
         if (has_key(deck, k, 'free_length')) free = free_length*draft%units%length
         if (has_key(deck, k, 'measure')) then
            associate (readout => suspension%readouts(draft%cards(found)%index))
               element = new_measure_spring(trim(name), where_of(deck, k), readout%measure, &
                  rate*(force_unit/value_unit), preload*force_unit, free, law)
            end associate
         else
            element = new_spring(trim(name), where_of(deck, k), ends%body(1), ends%body(2), &
               ends%at(:, 1), ends%at(:, 2), rate*(force_unit/value_unit), preload*force_unit, free, law)
         end if
         element%is_balanced = balance
         call add_element(suspension, element)
      end do

   contains

      !> The measure of the spring, and the units of its value and force.
      subroutine find_measure()
         character(*), parameter :: own(2) = [character(6) :: 'bodies', 'at']
         integer :: j

         do j = 1, size(own)
            if (has_key(deck, k, trim(own(j)))) call complain(draft, deck, k, trim(own(j)), &
               trim(own(j))//': not used with measure; give either measure, or bodies and at')
         end do
         call look_up(draft, deck, k, 'measure', measure_group, trim(measure), found)
         if (found == 0) return
         if (draft%cards(found)%index == 0) then      ! the measure was rejected
            draft%cards(k)%is_good = .false.
            return
         end if
         value_unit = draft%cards(found)%factor
         associate (readout => suspension%readouts(draft%cards(found)%index))
            if (is_of_angle(readout%measure%kind)) force_unit = force_unit*draft%units%length
            if (has_key(deck, k, 'free_length') .and. readout%measure%kind /= distance) call complain(draft, deck, k, &
               'free_length', 'free_length: only a spring on a distance takes this key; give preload instead')
         end associate
      end subroutine find_measure

   end subroutine read_springs

   !> &damper: only the gas force acts in statics.
   subroutine read_dampers(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, bodies(2), at(2)
      real(wp) :: gas_force, gas_rate
      namelist /damper/ name, bodies, at, gas_force, gas_rate
      type(ends_t) :: ends
      integer :: k, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= damper_group) cycle
         name = ''
         bodies = ''
         at = ''
         gas_force = 0.0_wp
         gas_rate = 0.0_wp
         read (draft%cards(k)%text, nml=damper, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call find_ends(draft, deck, k, bodies, at, ends)
         call check_rate(draft, deck, k, 'gas_force', '', gas_force)
         call check_rate(draft, deck, k, 'gas_rate', '', gas_rate)
         if (.not. draft%cards(k)%is_good) cycle
         call add_element(suspension, new_damper(trim(name), where_of(deck, k), ends%body(1), ends%body(2), &
            ends%at(:, 1), ends%at(:, 2), gas_rate*(draft%units%force/draft%units%length), gas_force*draft%units%force))
      end do
   end subroutine read_dampers

   !> &stop.
   subroutine read_stops(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, type, bodies(2), at(2), curve
      real(wp) :: clearance, rate, rounding
      namelist /stop/ name, type, bodies, at, clearance, rate, curve, rounding
      type(ends_t) :: ends
      type(curve_t), allocatable :: law
      real(wp) :: force, slope
      integer :: k, c, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= stop_group) cycle
         name = ''
         type = ''
         bodies = ''
         at = ''
         curve = ''
         clearance = 0.0_wp
         rate = 0.0_wp
         rounding = usual_rounding/draft%units%length
         read (draft%cards(k)%text, nml=stop, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call choice(draft, deck, k, 'type', trim(type), [character(7) :: 'bump', 'rebound'], c)
         call find_ends(draft, deck, k, bodies, at, ends)
         call check_either(draft, deck, k)
         call check_rate(draft, deck, k, 'rate', '', rate)
         call check_rate(draft, deck, k, 'clearance', '', clearance)
         if (.not. rounding > 0.0_wp) &
            call complain(draft, deck, k, 'rounding', 'rounding must be above 0, found '//str(rounding))
         call find_curve(draft, deck, k, 'curve', trim(curve), draft%units%length, draft%units%force, law)
         if (allocated(law)) then
            call look_up_curve(law, 0.0_wp, force, slope)
            if (abs(force) > 0.0_wp) call complain(draft, deck, k, 'curve', 'curve '//quoted(curve)// &
               ' must be 0 at 0 (a stop without contact exerts no force), found '//str(force/draft%units%force))
         end if
         if (.not. draft%cards(k)%is_good) cycle

         associate (unit => draft%units%length)
            call add_element(suspension, new_stop(trim(name), where_of(deck, k), ends%body(1), ends%body(2), &
               ends%at(:, 1), ends%at(:, 2), c == 1, clearance*unit, rounding*unit, rate*(draft%units%force/unit), law))
         end associate
      end do
   end subroutine read_stops

   !> &torsion: moment/angle about an axis fixed in the first body.
   subroutine read_torsions(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, bodies(2), axis(2), curve
      real(wp) :: axis_vector(3), rate, preload, moment_unit, u(3)
      namelist /torsion/ name, bodies, axis, axis_vector, rate, curve, preload
      type(curve_t), allocatable :: law
      logical :: has_bodies, has_axis, is_axis
      integer :: k, number(2), status

      moment_unit = draft%units%force*draft%units%length
      do k = 1, deck%used
         if (draft%cards(k)%group /= torsion_group) cycle
         name = ''
         bodies = ''
         axis = ''
         curve = ''
         axis_vector = 0.0_wp
         rate = 0.0_wp
         preload = 0.0_wp
         read (draft%cards(k)%text, nml=torsion, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call find_bodies(draft, deck, k, bodies, number, has_bodies)
         call find_direction(draft, deck, k, 'axis', axis, 'axis_vector', axis_vector, u, has_axis, is_axis)
         if (.not. has_axis) call complain(draft, deck, k, '', "give 'axis' or 'axis_vector'")
         call find_law(draft, deck, k, rate, trim(curve), draft%units%angle, moment_unit, law)
         if (.not. draft%cards(k)%is_good) cycle

         call add_element(suspension, new_torsion(trim(name), where_of(deck, k), number(1), number(2), u, &
            rate*(moment_unit/draft%units%angle), preload*moment_unit, law))
      end do
   end subroutine read_torsions

   !> Two different bodies and two distinct points.
   subroutine find_ends(draft, deck, k, bodies, at, ends)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: bodies(2), at(2)
      type(ends_t), intent(out) :: ends
      logical :: has_bodies, is_there(2)
      integer :: j

      call find_bodies(draft, deck, k, bodies, ends%body, has_bodies)
      do j = 1, 2
         call find_point(draft, deck, k, 'at', trim(at(j)), ends%at(:, j), is_there(j))
      end do
      if (.not. all(is_there)) return
      if (.not. norm2(ends%at(:, 2) - ends%at(:, 1)) > 0.0_wp) &
         call complain(draft, deck, k, 'at', 'at: the points '//quoted(at(1))//' and '//quoted(at(2))//' coincide')
   end subroutine find_ends

end module ek_reader_springs
