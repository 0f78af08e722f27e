!> &curve, and the elastic elements: &spring, &damper, &stop, &torsion, each of one measure, and &bushing.
!>
!> A curve itself has no units. Its numbers are in the deck units of the element that uses the curve, which converts them.
module ek_reader_elements
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_rotation, only: angle_between
   use ek_record, only: takes_image
   use ek_number_range, only: only_zero
   use ek_curve, only: curve_t, look_up_curve
   use ek_new_curve, only: new_curve, min_step
   use ek_dimension, only: unit_size, length, angle, force, moment
   use ek_measure, only: measure_t, distance, rotation
   use ek_element, only: element_t, set_kind, axial_spring, measure_spring, damper, stop_spring, torsion_spring, bushing_element, &
      rate_number, preload_number, free_length_number, clearance_number, rounding_number
   use ek_elastic, only: bushing_t
   use ek_blueprint, only: element_plan_t, curve_plan_t, vector_t, bushing_plan_t, chosen, chosen_right
   use ek_design_vector, only: marker_axes
   use ek_group, only: measure_group, bushing_group, spring_group, damper_group, stop_group, torsion_group, word_length
   use ek_deck_reading, only: deck_reading_t, complain, where_of, has_key, choice, text_of, texts_of, switch_of, number_of, &
      numbers_of, value_count, refuse, slot, unit_of
   use ek_reader_ratings, only: rating_t, read_rating, add_tilts
   use ek_reference, only: look_up, find_bodies, find_direction, find_ends, find_curve, new_vector
   implicit none(type, external)
   private
   public :: read_curve, read_element

   real(wp), parameter :: usual_rounding = 0.5e-3_wp   !! default rounding of a stop [m]: a typical soft lip

contains

   !> Reads &curve: points and interpolation.
   subroutine read_curve(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(curve_plan_t) :: plan
      real(wp), allocatable :: x(:)
      character(:), allocatable :: least
      integer :: j, c

      reading%plan%curves = [reading%plan%curves, plan]
      reading%cards(reading%k)%index = size(reading%plan%curves)
      call choice(reading, 'kind', c, word=plan%kind)
      if (.not. reading%cards(reading%k)%is_good) return
      plan%points = value_count(reading, 'x')
      if (value_count(reading, 'y') /= plan%points) call complain(reading, 'y', 'y needs as many values as x, '// &
         str(plan%points)//', found '//str(value_count(reading, 'y')))
      if (.not. reading%cards(reading%k)%is_good) return
      x = numbers_of(reading, 'x', plan%points)
      do j = 2, plan%points
         if (x(j) - x(j - 1) >= min_step) cycle
         least = ''
         if (x(j) > x(j - 1)) least = ' by '//str(min_step)//' or more'
         call complain(reading, 'x', 'x must increase'//least//', found '//str(x(j))//' after '//str(x(j - 1)))
         return
      end do
      plan%name = text_of(reading, 'name')
      call slot(reading, 'x', plan%x, count=plan%points)
      call slot(reading, 'y', plan%y, count=plan%points)
      reading%plan%curves(size(reading%plan%curves)) = plan
   end subroutine read_curve

   !> Reads the record of an elastic element.
   subroutine read_element(reading)
      type(deck_reading_t), intent(inout) :: reading

      select case (reading%cards(reading%k)%group)
      case (bushing_group)
         call read_bushing(reading)
      case (spring_group)
         call read_spring(reading)
      case (damper_group)
         call read_damper(reading)
      case (stop_group)
         call read_stop(reading)
      case (torsion_group)
         call read_torsion(reading)
      end select
   end subroutine read_element

   !> Reads &spring: between two points, or on a measure.
   subroutine read_spring(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t) :: plan
      type(measure_t) :: measure

      call set_dimensions(reading, plan, length, force)
      if (has_key(reading, 'measure')) then
         call find_measure()
      else
         if (.not. has_key(reading, 'bodies')) call complain(reading, '', "'bodies' is missing (give bodies and at, or measure)")
         if (.not. has_key(reading, 'at')) call complain(reading, '', "'at' is missing (give bodies and at, or measure)")
         call find_link(reading, plan, measure)
      end if
      call find_law(reading, plan)
      if (has_key(reading, 'preload') .and. has_key(reading, 'free_length')) &
         call complain(reading, 'free_length', 'give either preload or free_length, not both')
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'free_length', plan%numbers(free_length_number))
      if (plan%numbers(free_length_number) == 0) &
         call slot(reading, 'preload', plan%numbers(preload_number))
      call add(reading, plan, merge(axial_spring, measure_spring, measure%kind == distance), measure)

   contains

      !> Finds the measure of the spring, and the dimensions of its value and force.
      subroutine find_measure()
         integer :: found

         call refuse(reading, ['bodies', 'at    '], 'not used with measure; give either measure, or bodies and at')
         call look_up(reading, 'measure', measure_group, text_of(reading, 'measure'), found)
         if (found == 0) return
         plan%readout = reading%cards(found)%index
         if (plan%readout == 0) then      ! the measure was rejected
            reading%cards(reading%k)%is_good = .false.
            return
         end if
         call set_dimensions(reading, plan, reading%cards(found)%deflection, reading%cards(found)%reaction)
         measure = reading%plan%prototype%readouts(plan%readout)%measure
         if (measure%kind /= distance) call refuse(reading, ['free_length'], &
            'only a spring on a distance accepts this key; give preload instead')
      end subroutine find_measure

   end subroutine read_spring

   !> Reads &damper. Only the gas force of a damper acts in statics.
   subroutine read_damper(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t) :: plan
      type(measure_t) :: measure

      call find_link(reading, plan, measure)
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'gas_rate', plan%numbers(rate_number))
      call slot(reading, 'gas_force', plan%numbers(preload_number))
      call add(reading, plan, damper, measure)
   end subroutine read_damper

   !> Reads &stop: a bump stop or a rebound stop between two points.
   subroutine read_stop(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t) :: plan
      type(measure_t) :: measure
      type(curve_t) :: curve
      real(wp) :: force_at_contact, slope
      integer :: c

      call set_dimensions(reading, plan, length, force)
      call choice(reading, 'type', c)
      call find_link(reading, plan, measure)
      call find_law(reading, plan)
      if (plan%curve > 0) then
         associate (this => reading%plan%curves(plan%curve), x => reading%parameters%x)
            curve = new_curve(x(this%x:this%x + this%points - 1), x(this%y:this%y + this%points - 1), this%kind)
         end associate
         call look_up_curve(curve, 0.0_wp, force_at_contact, slope)
         if (abs(force_at_contact) > 0.0_wp) call complain(reading, 'curve', 'curve '//quoted(text_of(reading, 'curve'))// &
            ' must be 0 at 0 (a stop without contact exerts no force), found '//str(force_at_contact))
      end if
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'clearance', plan%numbers(clearance_number))
      call slot(reading, 'rounding', plan%numbers(rounding_number), &
         default=usual_rounding/unit_of(reading, 'rounding'))
      call add(reading, plan, stop_spring, measure)
      if (c == 2) reading%plan%prototype%elements(reading%plan%prototype%scalars)%law%sign = 1.0_wp
   end subroutine read_stop

   !> Reads &torsion: a spring with a moment over an angle, about an axis fixed in the first body.
   subroutine read_torsion(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t) :: plan
      logical :: has_axis, is_axis
      integer :: bodies(2)

      call set_dimensions(reading, plan, angle, moment)
      call find_bodies(reading, bodies)
      call find_direction(reading, 'axis', 'axis_vector', plan%axis, has_axis, is_axis)
      if (.not. has_axis) call complain(reading, '', "give 'axis' or 'axis_vector'")
      call find_law(reading, plan)
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'preload', plan%numbers(preload_number))
      call add(reading, plan, torsion_spring, measure_t(kind=rotation, body_i=bodies(1), body_j=bodies(2)))
   end subroutine read_torsion

   !> Sets the dimensions of deflection and reaction of an element, and thereby the units of its curve.
   subroutine set_dimensions(reading, plan, of_deflection, of_reaction)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t), intent(inout) :: plan
      integer, intent(in) :: of_deflection, of_reaction

      reading%cards(reading%k)%deflection = of_deflection
      reading%cards(reading%k)%reaction = of_reaction
      plan%value_unit = unit_size(of_deflection, reading%units)
      plan%force_unit = unit_size(of_reaction, reading%units)
   end subroutine set_dimensions

   !> Finds the distance between two distinct points of two different bodies as a measure.
   subroutine find_link(reading, plan, measure)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t), intent(inout) :: plan
      type(measure_t), intent(out) :: measure
      integer :: bodies(2)

      call find_bodies(reading, bodies)
      call find_ends(reading, .false., plan%ends)
      measure = measure_t(kind=distance, body_i=bodies(1), body_j=bodies(2))
   end subroutine find_link

   !> Finds the law of an element: a rate or a curve. It is an error if both are given, or if neither is given. An element whose
   !> property_file was rejected may have neither.
   subroutine find_law(reading, plan)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t), intent(inout) :: plan

      if (has_key(reading, 'rate') .and. has_key(reading, 'curve')) then
         call complain(reading, 'curve', 'give either rate or curve, not both')
      else if (.not. (has_key(reading, 'rate') .or. has_key(reading, 'curve') .or. has_key(reading, 'property_file'))) then
         call complain(reading, '', "give 'rate' or 'curve'")
      end if
      call find_curve(reading, 'curve', text_of(reading, 'curve'), plan%curve)
      call slot(reading, 'rate', plan%numbers(rate_number))
   end subroutine find_law

   !> Adds an element to the prototype, before all bushings, and adds its plan to the blueprint. `realise` sets the numbers.
   subroutine add(reading, plan, kind, measure)
      type(deck_reading_t), intent(inout) :: reading
      type(element_plan_t), intent(in) :: plan
      integer, intent(in) :: kind
      type(measure_t), intent(in) :: measure
      type(element_t) :: element

      call set_kind(element, kind, measure)
      element%law%has_curve = plan%curve > 0
      element%is_balanced = switch_of(reading, 'balance', .true.)
      element%name = text_of(reading, 'name')
      element%where = where_of(reading)
      associate (model => reading%plan%prototype)
         model%elements = [model%elements(:model%scalars), element, model%elements(model%scalars + 1:)]
         model%scalars = model%scalars + 1
      end associate
      reading%plan%elements = [reading%plan%elements, plan]
   end subroutine add

   !> Reads &bushing. Rates are force/length and moment/angle, with force × length as the unit of the moment.
   subroutine read_bushing(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(bushing_plan_t) :: plan
      type(element_t) :: element
      type(rating_t) :: rating
      integer :: number(2)

      call find_bodies(reading, number)
      call find_ends(reading, .true., plan%ends)
      if (.not. (has_key(reading, 'kt') .or. has_key(reading, 'kr') .or. has_key(reading, 'curve') .or. &
         has_key(reading, 'property_file'))) &
         call complain(reading, '', "give 'kt', 'kr' or 'curve'")
      call find_laws(reading, plan, element%bushing)
      call find_axes(reading, plan)
      call read_rating(reading, 1, .false., rating)
      if (.not. reading%cards(reading%k)%is_good) return

      call slot(reading, 'kt', plan%kt)
      call slot(reading, 'kr', plan%kr)
      call slot(reading, 'preload_force', plan%preload_force)
      call slot(reading, 'preload_moment', plan%preload_moment)
      if (element%bushing%has_curves) then
         associate (list => reading%parameters%list)
            where (element%bushing%laws(1:3)%has_curve) list(plan%kt:plan%kt + 2)%range = only_zero
            where (element%bushing%laws(4:6)%has_curve) list(plan%kr:plan%kr + 2)%range = only_zero
         end associate
      end if
      element%gives_z = plan%z > 0 .and. any([has_key(reading, 'z_axis'), has_key(reading, 'z_vector')])
      element%gives_x = plan%x > 0 .and. any([has_key(reading, 'x_axis'), has_key(reading, 'x_vector')])
      element%name = text_of(reading, 'name')
      element%where = where_of(reading)
      call set_kind(element, bushing_element, measure_t(body_i=number(1), body_j=number(2)))
      reading%plan%prototype%elements = [reading%plan%prototype%elements, element]
      reading%plan%bushings = [reading%plan%bushings, plan]
      call add_tilts(reading, rating, 0, size(reading%plan%bushings))
   end subroutine read_bushing

   !> Finds the curves of a bushing from strings such as 'fx=c' or 'mz=-c'. The minus sign stands for the curve reflected through
   !> the origin.
   subroutine find_laws(reading, plan, element)
      type(deck_reading_t), intent(inout) :: reading
      type(bushing_plan_t), intent(inout) :: plan
      type(bushing_t), intent(inout) :: element
      character(*), parameter :: components(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']
      character(word_length) :: words(6)
      character(:), allocatable :: name
      real(wp) :: rate
      integer :: w, c, mark

      words = texts_of(reading, 'curve', 6)
      if (all(words == '')) return
      element%has_curves = .true.
      allocate (element%laws(6))
      do w = 1, size(words)
         if (words(w) == '') cycle
         mark = index(words(w), '=')
         c = 0
         if (mark > 0) c = findloc(components, lower(trim(adjustl(words(w) (:mark - 1)))), dim=1)
         if (c == 0) then
            call complain(reading, 'curve', "curve must be like 'fx=name' or 'mz=-name' (fx, fy, fz, mx, my, mz), found "// &
               quoted(words(w)))
            cycle
         end if
         name = trim(adjustl(words(w) (mark + 1:)))
         if (index(name, '-') == 1) then
            element%laws(c)%sign = -1.0_wp
            name = trim(adjustl(name(2:)))
         end if
         rate = number_of(reading, trim(merge('kt', 'kr', c <= 3)), 0.0_wp, merge(c, c - 3, c <= 3))
         if (element%laws(c)%has_curve) then
            call complain(reading, 'curve', 'curve: '//components(c)//' is given twice')
         else if (abs(rate) > 0.0_wp) then
            call complain(reading, 'curve', 'curve: '//components(c)//' already has a rate; set its element of '// &
               merge('kt', 'kr', c <= 3)//' to 0')
         else if (name == '') then
            call complain(reading, 'curve', 'curve: '//components(c)//' names no curve')
         end if
         call find_curve(reading, 'curve', name, plan%curves(c))
         element%laws(c)%has_curve = .true.
      end do
   end subroutine find_laws

   !> Finds the marker axes. If only one axis is given, a perpendicular axis is chosen as the other, or the mirror image of the axis
   !> that would be chosen for the mirror image of the given axis (takes_image).
   subroutine find_axes(reading, plan)
      type(deck_reading_t), intent(inout) :: reading
      type(bushing_plan_t), intent(inout) :: plan
      real(wp) :: axes(3, 3), angle
      logical :: has_x, has_z, is_x, is_z, is_good
      logical :: is_image

      call find_direction(reading, 'z_axis', 'z_vector', plan%z, has_z, is_z)
      call find_direction(reading, 'x_axis', 'x_vector', plan%x, has_x, is_x)
      if (has_key(reading, 'mirrored') .and. (has_x .eqv. has_z)) call complain(reading, 'mirrored', 'mirrored: expected one '// &
         'axis, z or x, of which the other one is chosen; found '//trim(merge('both', 'none', has_x)))
      if (.not. (has_x .or. has_z)) return
      if ((has_x .and. .not. is_x) .or. (has_z .and. .not. is_z)) return
      is_image = takes_image(reading%records(reading%k))
      if (.not. has_x) call new_vector(reading, vector_t(kind=merge(chosen_right, chosen, is_image), a=plan%z), plan%x)
      if (.not. has_z) call new_vector(reading, vector_t(kind=merge(chosen_right, chosen, is_image), a=plan%x), plan%z)
      is_good = .true.
      call marker_axes(reading%plan, reading%vectors(:, plan%z), reading%vectors(:, plan%x), axes, is_good)
      if (is_good) return
      angle = angle_between(reading%vectors(:, plan%x), reading%vectors(:, plan%z))
      call complain(reading, trim(merge('x_axis  ', 'x_vector', has_key(reading, 'x_axis'))), &
         'the x axis must not be parallel to the z axis, found '//str(real(nint(angle*1e4_wp), wp)/1e4_wp)//' deg between them')
   end subroutine find_axes

end module ek_reader_elements
