!> &curve, and the elastic elements: &spring, &damper, &stop, &torsion, each of one measure, and &bushing.
!>
!> A curve has no units of its own: its numbers have the deck units of the element that uses it.
module ek_reader_elements
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_rotation, only: angle_between
   use ek_record, only: right_side
   use ek_curve, only: curve_t, new_curve, look_up_curve, curve_kinds, least_step
   use ek_measure, only: measure_t, distance, rotation, is_of_angle
   use ek_element, only: element_t, set_kind, axial_spring, measure_spring, damper, stop_spring, torsion_spring, bushing_element
   use ek_elastic, only: bushing_t
   use ek_blueprint, only: element_plan_t, curve_plan_t, vector_t, bushing_plan_t, chosen, chosen_right
   use ek_design_vector, only: marker_axes
   use ek_group, only: measure_group, word_length
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, texts_of, switch_of, number_of, numbers_of, &
      value_count, refuse, slot
   use ek_reference, only: look_up, find_bodies, find_direction, find_ends, find_curve, new_vector
   implicit none(type, external)
   private
   public :: read_curve, read_spring, read_damper, read_stop, read_torsion, read_bushing

   real(wp), parameter :: usual_rounding = 0.5e-3_wp   !! m: a typical soft lip of a bump stop

contains

   !> &curve: points and interpolation.
   subroutine read_curve(draft)
      type(draft_t), intent(inout) :: draft
      type(curve_plan_t) :: plan
      real(wp), allocatable :: x(:)
      character(:), allocatable :: least
      integer :: j, c

      draft%plan%curves = [draft%plan%curves, plan]
      draft%cards(draft%k)%index = size(draft%plan%curves)
      call choice(draft, 'kind', curve_kinds, c, default=1)
      if (.not. draft%cards(draft%k)%is_good) return
      plan%points = value_count(draft, 'x')
      if (value_count(draft, 'y') /= plan%points) call complain(draft, 'y', 'y needs as many values as x, '// &
         str(plan%points)//', found '//str(value_count(draft, 'y')))
      if (.not. draft%cards(draft%k)%is_good) return
      x = numbers_of(draft, 'x', plan%points)
      do j = 2, plan%points
         if (x(j) - x(j - 1) >= least_step) cycle
         least = ''
         if (x(j) > x(j - 1)) least = ' by '//str(least_step)//' or more'
         call complain(draft, 'x', 'x must increase'//least//', found '//str(x(j))//' after '//str(x(j - 1)))
         return
      end do
      plan%name = text_of(draft, 'name')
      plan%kind = trim(curve_kinds(c))
      call slot(draft, 'x', 1.0_wp, plan%x, count=plan%points)
      call slot(draft, 'y', 1.0_wp, plan%y, count=plan%points)
      draft%plan%curves(size(draft%plan%curves)) = plan
   end subroutine read_curve

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
         integer :: found

         call refuse(draft, ['bodies', 'at    '], 'not used with measure; give either measure, or bodies and at')
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
         if (measure%kind /= distance) call refuse(draft, ['free_length'], &
            'only a spring on a distance takes this key; give preload instead')
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
      logical :: has_axis, is_axis
      integer :: bodies(2)

      plan%force_unit = draft%units%force*draft%units%length
      plan%value_unit = draft%units%angle
      call find_bodies(draft, bodies)
      call find_direction(draft, 'axis', 'axis_vector', plan%axis, has_axis, is_axis)
      if (.not. has_axis) call complain(draft, '', "give 'axis' or 'axis_vector'")
      call find_law(draft, plan)
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'preload', plan%force_unit, plan%preload, default=0.0_wp)
      call add(draft, plan, torsion_spring, measure_t(kind=rotation, body_i=bodies(1), body_j=bodies(2)))
   end subroutine read_torsion

   !> The distance of two distinct points of two different bodies.
   subroutine find_link(draft, plan, measure)
      type(draft_t), intent(inout) :: draft
      type(element_plan_t), intent(inout) :: plan
      type(measure_t), intent(out) :: measure
      integer :: bodies(2)

      call find_bodies(draft, bodies)
      call find_ends(draft, .false., plan%ends)
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

   !> &bushing. Rates: force/length and moment/angle, the moment being force × length.
   subroutine read_bushing(draft)
      type(draft_t), intent(inout) :: draft
      type(bushing_plan_t) :: plan
      type(element_t) :: element
      integer :: number(2)

      call find_bodies(draft, number)
      call find_ends(draft, .true., plan%ends)
      if (.not. (has_key(draft, 'kt') .or. has_key(draft, 'kr') .or. has_key(draft, 'curve'))) &
         call complain(draft, '', "give 'kt', 'kr' or 'curve'")
      call find_laws(draft, plan, element%bushing)
      call find_axes(draft, plan)
      if (.not. draft%cards(draft%k)%is_good) return

      associate (units => draft%units)
         call slot(draft, 'kt', units%force/units%length, plan%kt, default=0.0_wp, count=3)
         call slot(draft, 'kr', units%force*units%length/units%angle, plan%kr, default=0.0_wp, count=3)
         call slot(draft, 'preload_force', units%force, plan%preload_force, default=0.0_wp, count=3)
         call slot(draft, 'preload_moment', units%force*units%length, plan%preload_moment, default=0.0_wp, count=3)
      end associate
      element%name = text_of(draft, 'name')
      element%where = where_of(draft)
      call set_kind(element, bushing_element, measure_t(body_i=number(1), body_j=number(2)))
      draft%plan%prototype%elements = [draft%plan%prototype%elements, element]
      draft%plan%bushings = [draft%plan%bushings, plan]
   end subroutine read_bushing

   !> Curves of a bushing: texts 'fx=c' or 'mz=-c', the minus sign for the curve reflected through the origin.
   subroutine find_laws(draft, plan, element)
      type(draft_t), intent(inout) :: draft
      type(bushing_plan_t), intent(inout) :: plan
      type(bushing_t), intent(inout) :: element
      character(*), parameter :: components(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']
      character(word_length) :: words(6)
      character(:), allocatable :: name
      real(wp) :: rate
      integer :: w, c, mark

      words = texts_of(draft, 'curve', 6)
      if (all(words == '')) return
      element%has_curves = .true.
      allocate (element%laws(6))
      do w = 1, size(words)
         if (words(w) == '') cycle
         mark = index(words(w), '=')
         c = 0
         if (mark > 0) c = findloc(components, lower(trim(adjustl(words(w) (:mark - 1)))), dim=1)
         if (c == 0) then
            call complain(draft, 'curve', "curve must be like 'fx=name' or 'mz=-name' (fx, fy, fz, mx, my, mz), found "// &
               quoted(words(w)))
            cycle
         end if
         name = trim(adjustl(words(w) (mark + 1:)))
         if (index(name, '-') == 1) then
            element%laws(c)%sign = -1.0_wp
            name = trim(adjustl(name(2:)))
         end if
         rate = number_of(draft, trim(merge('kt', 'kr', c <= 3)), 0.0_wp, merge(c, c - 3, c <= 3))
         if (element%laws(c)%has_curve) then
            call complain(draft, 'curve', 'curve: '//components(c)//' is given twice')
         else if (abs(rate) > 0.0_wp) then
            call complain(draft, 'curve', 'curve: '//components(c)//' already has a rate; set its element of '// &
               merge('kt', 'kr', c <= 3)//' to 0')
         else if (name == '') then
            call complain(draft, 'curve', 'curve: '//components(c)//' names no curve')
         end if
         call find_curve(draft, 'curve', name, plan%curves(c))
         element%laws(c)%has_curve = .true.
      end do
   end subroutine find_laws

   !> The marker axes. If only one is given, the other is chosen perpendicular to it; on the right side of a mirrored axle the
   !> choice is the mirror image of that on the left.
   subroutine find_axes(draft, plan)
      type(draft_t), intent(inout) :: draft
      type(bushing_plan_t), intent(inout) :: plan
      real(wp) :: axes(3, 3), angle
      logical :: has_x, has_z, is_x, is_z, is_good
      integer :: choice

      call find_direction(draft, 'z_axis', 'z_vector', plan%z, has_z, is_z)
      call find_direction(draft, 'x_axis', 'x_vector', plan%x, has_x, is_x)
      if (.not. (has_x .or. has_z)) return
      if ((has_x .and. .not. is_x) .or. (has_z .and. .not. is_z)) return
      choice = merge(chosen_right, chosen, draft%records(draft%k)%side == right_side)
      if (.not. has_x) call new_vector(draft, vector_t(kind=choice, a=plan%z), plan%x)
      if (.not. has_z) call new_vector(draft, vector_t(kind=choice, a=plan%x), plan%z)
      is_good = .true.
      call marker_axes(draft%plan, draft%vectors(:, plan%z), draft%vectors(:, plan%x), axes, is_good)
      if (is_good) return
      angle = angle_between(draft%vectors(:, plan%x), draft%vectors(:, plan%z))
      call complain(draft, trim(merge('x_axis  ', 'x_vector', has_key(draft, 'x_axis'))), &
         'the x axis must not be parallel to the z axis, found '//str(real(nint(angle*1e4_wp), wp)/1e4_wp)//' deg between them')
   end subroutine find_axes

end module ek_reader_elements
