!> &curve, and &spring, &damper, &stop, &torsion: elastic elements of one measure.
!>
!> A curve has no units of its own: its numbers have the deck units of the element that uses it.
module ek_reader_springs
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_curve, only: curve_t, new_curve, scaled_curve, look_up_curve, curve_kinds, least_step
   use ek_measure, only: measure_t, distance
   use ek_element, only: new_damper, new_stop, new_torsion, new_measure_spring, is_of_angle, element_t
   use ek_builder, only: add_element
   use ek_blueprint, only: element_plan_t, curve_plan_t
   use ek_group, only: measure_group
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, switch_of, numbers_of, value_count, slot, slots
   use ek_reference, only: look_up, find_bodies, find_direction, find_ends, find_curve, vector_at
   implicit none(type, external)
   private
   public :: read_curve, read_spring, read_damper, read_stop, read_torsion

   real(wp), parameter :: origin(3) = 0.0_wp           !! numbers of the prototype are set by `realise`
   real(wp), parameter :: usual_rounding = 0.5e-3_wp   !! m: a typical soft lip of a bump stop

contains

   !> &curve: points and interpolation.
   subroutine read_curve(draft)
      type(draft_t), intent(inout) :: draft
      type(curve_plan_t) :: plan
      real(wp), allocatable :: x(:)
      integer :: j, c

      draft%cards(draft%k)%index = size(draft%plan%curves) + 1
      call choice(draft, 'kind', curve_kinds, c, default=1)
      if (draft%cards(draft%k)%is_good) then
         plan%points = value_count(draft, 'x')
         if (value_count(draft, 'y') /= plan%points) call complain(draft, 'y', 'y needs as many values as x, '// &
            str(plan%points)//', found '//str(value_count(draft, 'y')))
      end if
      if (draft%cards(draft%k)%is_good) then
         x = numbers_of(draft, 'x', plan%points)
         do j = 2, plan%points
            if (x(j) - x(j - 1) >= least_step) cycle
            if (x(j) > x(j - 1)) then
               call complain(draft, 'x', 'x must increase by '//str(least_step)//' or more, found '//str(x(j))//' after '// &
                  str(x(j - 1)))
            else
               call complain(draft, 'x', 'x must increase, found '//str(x(j))//' after '//str(x(j - 1)))
            end if
            exit
         end do
      end if
      if (draft%cards(draft%k)%is_good) then
         plan%name = text_of(draft, 'name')
         plan%kind = trim(curve_kinds(c))
         call slots(draft, 'x', plan%points, 1.0_wp, plan%x)
         call slots(draft, 'y', plan%points, 1.0_wp, plan%y)
      end if
      draft%plan%curves = [draft%plan%curves, plan]
   end subroutine read_curve

   !> &spring: between two points, or on a measure.
   subroutine read_spring(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(measure_t) :: measure
      type(element_t) :: element
      type(curve_t), allocatable :: law      ! unallocated: an absent argument
      integer :: bodies(2)

      plan%force_unit = draft%units%force
      plan%value_unit = draft%units%length
      bodies = 0
      measure%kind = distance
      if (has_key(draft, 'measure')) then
         call find_measure()
      else
         if (.not. has_key(draft, 'bodies')) call complain(draft, '', "'bodies' is missing (give bodies and at, or measure)")
         if (.not. has_key(draft, 'at')) call complain(draft, '', "'at' is missing (give bodies and at, or measure)")
         call find_link(draft, plan, bodies)
      end if
      call find_law(draft, plan)
      if (has_key(draft, 'preload') .and. has_key(draft, 'free_length')) &
         call complain(draft, 'free_length', 'give either preload or free_length, not both')
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'free_length', draft%units%length, plan%free_length)
      if (plan%free_length == 0) call slot(draft, 'preload', plan%force_unit, plan%preload, default=0.0_wp)

      if (plan%readout == 0) then
         measure%body_i = bodies(1)
         measure%body_j = bodies(2)
      end if
      if (plan%curve > 0) allocate (law, source=scaled_curve(curve_of(draft, plan%curve), plan%value_unit, plan%force_unit))
      element = new_measure_spring(text_of(draft, 'name'), where_of(draft), measure, 0.0_wp, curve=law)
      element%is_balanced = switch_of(draft, 'balance', .true.)
      call add(draft, element, plan)

   contains

      !> The measure of the spring, and the units of its value and force.
      subroutine find_measure()
         character(*), parameter :: own(2) = [character(6) :: 'bodies', 'at']
         integer :: j, found

         do j = 1, size(own)
            if (has_key(draft, trim(own(j)))) call complain(draft, trim(own(j)), &
               trim(own(j))//': not used with measure; give either measure, or bodies and at')
         end do
         call look_up(draft, 'measure', measure_group, text_of(draft, 'measure'), found)
         if (found == 0) return
         plan%readout = draft%cards(found)%index
         if (plan%readout == 0) then      ! the measure was rejected
            draft%cards(draft%k)%is_good = .false.
            return
         end if
         plan%value_unit = draft%cards(found)%factor
         measure = draft%plan%prototype%readouts(plan%readout)%measure
         if (is_of_angle(measure%kind)) plan%force_unit = plan%force_unit*draft%units%length
         if (has_key(draft, 'free_length') .and. measure%kind /= distance) call complain(draft, &
            'free_length', 'free_length: only a spring on a distance takes this key; give preload instead')
      end subroutine find_measure

   end subroutine read_spring

   !> &damper: only the gas force acts in statics.
   subroutine read_damper(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      integer :: bodies(2)

      call find_link(draft, plan, bodies)
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'gas_rate', draft%units%force/draft%units%length, plan%rate, default=0.0_wp)
      call slot(draft, 'gas_force', draft%units%force, plan%preload, default=0.0_wp)
      call add(draft, new_damper(text_of(draft, 'name'), where_of(draft), bodies(1), bodies(2), origin, origin, 0.0_wp, 0.0_wp), &
         plan)
   end subroutine read_damper

   !> &stop.
   subroutine read_stop(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(curve_t), allocatable :: law
      real(wp) :: force, slope
      integer :: bodies(2), c

      plan%force_unit = draft%units%force
      plan%value_unit = draft%units%length
      call choice(draft, 'type', [character(7) :: 'bump', 'rebound'], c)
      call find_link(draft, plan, bodies)
      call find_law(draft, plan)
      if (plan%curve > 0) then
         allocate (law, source=scaled_curve(curve_of(draft, plan%curve), plan%value_unit, plan%force_unit))
         call look_up_curve(law, 0.0_wp, force, slope)
         if (abs(force) > 0.0_wp) call complain(draft, 'curve', 'curve '//quoted(text_of(draft, 'curve'))// &
            ' must be 0 at 0 (a stop without contact exerts no force), found '//str(force/plan%force_unit))
      end if
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'clearance', draft%units%length, plan%clearance)
      call slot(draft, 'rounding', draft%units%length, plan%rounding, default=usual_rounding/draft%units%length)
      call add(draft, new_stop(text_of(draft, 'name'), where_of(draft), bodies(1), bodies(2), origin, origin, c == 1, &
         0.0_wp, 1.0_wp, 0.0_wp, law), plan)
   end subroutine read_stop

   !> &torsion: moment/angle about an axis fixed in the first body.
   subroutine read_torsion(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(curve_t), allocatable :: law
      logical :: has_bodies, has_axis, is_axis
      integer :: bodies(2)

      plan%force_unit = draft%units%force*draft%units%length
      plan%value_unit = draft%units%angle
      call find_bodies(draft, bodies, has_bodies)
      call find_direction(draft, 'axis', 'axis_vector', plan%axis, has_axis, is_axis)
      if (.not. has_axis) call complain(draft, '', "give 'axis' or 'axis_vector'")
      call find_law(draft, plan)
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'preload', plan%force_unit, plan%preload, default=0.0_wp)
      if (plan%curve > 0) allocate (law, source=scaled_curve(curve_of(draft, plan%curve), plan%value_unit, plan%force_unit))
      call add(draft, new_torsion(text_of(draft, 'name'), where_of(draft), bodies(1), bodies(2), vector_at(draft, plan%axis), &
         0.0_wp, 0.0_wp, law), plan)
   end subroutine read_torsion

   !> Two different bodies and two distinct points.
   subroutine find_link(draft, plan, bodies)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t), intent(inout) :: plan
      integer, intent(out) :: bodies(2)
      logical :: has_bodies, has_ends

      call find_bodies(draft, bodies, has_bodies)
      call find_ends(draft, .false., plan%ends, has_ends)
   end subroutine find_link

   !> Exactly one of rate and curve.
   subroutine find_law(draft, plan)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t), intent(inout) :: plan

      if (has_key(draft, 'rate') .and. has_key(draft, 'curve')) then
         call complain(draft, 'curve', 'give either rate or curve, not both')
      else if (.not. (has_key(draft, 'rate') .or. has_key(draft, 'curve'))) then
         call complain(draft, '', "give 'rate' or 'curve'")
      end if
      call find_curve(draft, 'curve', text_of(draft, 'curve'), plan%curve)
      call slot(draft, 'rate', plan%force_unit/plan%value_unit, plan%rate)
   end subroutine find_law

   !> Adds an element to the prototype and its plan to the blueprint.
   subroutine add(draft, element, plan)
      type(draft_t), intent(inout) :: draft
      type(element_t), intent(in) :: element
      type(element_plan_t), intent(in) :: plan

      call add_element(draft%plan%prototype, element)
      draft%plan%elements = [draft%plan%elements, plan]
   end subroutine add

   !> A curve in deck units.
   pure function curve_of(draft, number) result(curve)
      type(draft_t), intent(in) :: draft
      integer, intent(in) :: number
      type(curve_t) :: curve

      associate (this => draft%plan%curves(number), x => draft%parameters%x)
         curve = new_curve(x(this%x:this%x + this%points - 1), x(this%y:this%y + this%points - 1), this%kind)
         curve%name = this%name
      end associate
   end function curve_of

end module ek_reader_springs
