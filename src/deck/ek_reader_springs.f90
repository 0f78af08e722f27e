!> &curve, and &spring, &damper, &stop, &torsion: elastic elements of one measure.
!>
!> A curve has no units of its own: its numbers have the deck units of the element that uses it.
module ek_reader_springs
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_curve, only: curve_t, new_curve, look_up_curve, curve_kinds, least_step
   use ek_measure, only: measure_t, distance, rotation, is_of_angle
   use ek_element, only: element_t, set_kind, axial_spring, measure_spring, damper, stop_spring, torsion_spring
   use ek_blueprint, only: element_plan_t, curve_plan_t
   use ek_group, only: measure_group, spring_group, damper_group, stop_group, torsion_group
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, switch_of, numbers_of, value_count, slot, slots
   use ek_reference, only: look_up, find_bodies, find_direction, find_ends, find_curve
   implicit none(type, external)
   private
   public :: read_curve, read_elastic

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

   !> An elastic element of one measure.
   subroutine read_elastic(draft)
      type(draft_t), intent(inout) :: draft

      select case (draft%cards(draft%k)%group)
      case (spring_group)
         call read_spring(draft)
      case (damper_group)
         call read_damper(draft)
      case (stop_group)
         call read_stop(draft)
      case (torsion_group)
         call read_torsion(draft)
      end select
   end subroutine read_elastic

   !> &spring: between two points, or on a measure.
   subroutine read_spring(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(measure_t) :: measure

      plan%force_unit = draft%units%force
      plan%value_unit = draft%units%length
      if (has_key(draft, 'measure')) then
         call find_measure()
      else
         if (.not. has_key(draft, 'bodies')) call complain(draft, '', "'bodies' is missing (give bodies and at, or measure)")
         if (.not. has_key(draft, 'at')) call complain(draft, '', "'at' is missing (give bodies and at, or measure)")
         call find_link(draft, plan, measure)
      end if
      call find_law(draft, plan)
      if (has_key(draft, 'preload') .and. has_key(draft, 'free_length')) &
         call complain(draft, 'free_length', 'give either preload or free_length, not both')
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'free_length', draft%units%length, plan%free_length)
      if (plan%free_length == 0) call slot(draft, 'preload', plan%force_unit, plan%preload, default=0.0_wp)

      call add(draft, plan, merge(axial_spring, measure_spring, measure%kind == distance), measure)

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
      type(measure_t) :: measure

      call find_link(draft, plan, measure)
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'gas_rate', draft%units%force/draft%units%length, plan%rate, default=0.0_wp)
      call slot(draft, 'gas_force', draft%units%force, plan%preload, default=0.0_wp)
      call add(draft, plan, damper, measure)
   end subroutine read_damper

   !> &stop.
   subroutine read_stop(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(measure_t) :: measure
      type(curve_t) :: curve
      real(wp) :: force, slope
      integer :: c

      plan%force_unit = draft%units%force
      plan%value_unit = draft%units%length
      call choice(draft, 'type', [character(7) :: 'bump', 'rebound'], c)
      call find_link(draft, plan, measure)
      call find_law(draft, plan)
      if (plan%curve > 0) then
         associate (this => draft%plan%curves(plan%curve), x => draft%parameters%x)
            curve = new_curve(x(this%x:this%x + this%points - 1), x(this%y:this%y + this%points - 1), this%kind)
         end associate
         call look_up_curve(curve, 0.0_wp, force, slope)
         if (abs(force) > 0.0_wp) call complain(draft, 'curve', 'curve '//quoted(text_of(draft, 'curve'))// &
            ' must be 0 at 0 (a stop without contact exerts no force), found '//str(force))
      end if
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'clearance', draft%units%length, plan%clearance)
      call slot(draft, 'rounding', draft%units%length, plan%rounding, default=usual_rounding/draft%units%length)
      call add(draft, plan, stop_spring, measure)
      if (c == 2) draft%plan%prototype%elements(draft%plan%prototype%scalars)%law%sign = 1.0_wp
   end subroutine read_stop

   !> &torsion: moment/angle about an axis fixed in the first body.
   subroutine read_torsion(draft)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t) :: plan
      type(measure_t) :: measure
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
      measure = measure_t(kind=rotation, body_i=bodies(1), body_j=bodies(2))
      call add(draft, plan, torsion_spring, measure)
   end subroutine read_torsion

   !> The distance of two distinct points of two different bodies.
   subroutine find_link(draft, plan, measure)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t), intent(inout) :: plan
      type(measure_t), intent(out) :: measure
      integer :: bodies(2)
      logical :: has_bodies, has_ends

      call find_bodies(draft, bodies, has_bodies)
      call find_ends(draft, .false., plan%ends, has_ends)
      measure = measure_t(kind=distance, body_i=bodies(1), body_j=bodies(2))
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

   !> Adds an element to the prototype, before all bushings, and its plan to the blueprint; `realise` sets the numbers.
   subroutine add(draft, plan, kind, measure)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t), intent(in) :: plan
      integer, intent(in) :: kind
      type(measure_t), intent(in) :: measure
      type(element_t) :: element

      call set_kind(element, kind, measure)
      element%law%has_curve = plan%curve > 0
      element%is_balanced = switch_of(draft, 'balance', .true.)
      element%name = text_of(draft, 'name')
      element%where = where_of(draft)
      associate (model => draft%plan%prototype)
         model%elements = [model%elements(:model%scalars), element, model%elements(model%scalars + 1:)]
         model%scalars = model%scalars + 1
      end associate
      draft%plan%elements = [draft%plan%elements, plan]
   end subroutine add

end module ek_reader_springs
