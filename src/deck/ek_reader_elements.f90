!> &bushing and &load.
module ek_reader_elements
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_rotation, only: angle_between
   use ek_twin, only: right_twin
   use ek_measure, only: measure_t
   use ek_element, only: element_t, set_kind, bushing_element
   use ek_elastic, only: bushing_t
   use ek_suspension, only: load_t
   use ek_blueprint, only: vector_t, bushing_plan_t, load_plan_t, chosen, chosen_right
   use ek_design_vector, only: marker_axes
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, texts_of, switch_of, number_of, slots
   use ek_group, only: word_length
   use ek_reference, only: find_point, find_body, find_bodies, find_direction, find_ends, find_curve, new_vector, vector_at
   implicit none(type, external)
   private
   public :: read_bushing, read_load

contains

   !> &bushing. Rates: force/length and moment/angle, the moment being force × length.
   subroutine read_bushing(draft)
      type(draft_t), intent(inout) :: draft
      type(bushing_plan_t) :: plan
      type(element_t) :: element
      logical :: has_bodies, is_found
      integer :: number(2)

      call find_bodies(draft, number, has_bodies)
      call find_ends(draft, .true., plan%ends, is_found)
      if (.not. (has_key(draft, 'kt') .or. has_key(draft, 'kr') .or. has_key(draft, 'curve'))) &
         call complain(draft, '', "give 'kt', 'kr' or 'curve'")
      call find_laws(draft, plan, element%bushing)
      call find_axes(draft, plan)
      if (.not. draft%cards(draft%k)%is_good) return

      associate (units => draft%units)
         call slots(draft, 'kt', 3, units%force/units%length, plan%kt, default=0.0_wp)
         call slots(draft, 'kr', 3, units%force*units%length/units%angle, plan%kr, default=0.0_wp)
         call slots(draft, 'preload_force', 3, units%force, plan%preload_force, default=0.0_wp)
         call slots(draft, 'preload_moment', 3, units%force*units%length, plan%preload_moment, default=0.0_wp)
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
      choice = merge(chosen_right, chosen, draft%records(draft%k)%twin == right_twin)
      if (.not. has_x) call new_vector(draft, vector_t(kind=choice, a=plan%z), plan%x)
      if (.not. has_z) call new_vector(draft, vector_t(kind=choice, a=plan%x), plan%z)
      is_good = .true.
      call marker_axes(draft%plan, vector_at(draft, plan%z), vector_at(draft, plan%x), axes, is_good)
      if (is_good) return
      angle = angle_between(vector_at(draft, plan%x), vector_at(draft, plan%z))
      call complain(draft, trim(merge('x_axis  ', 'x_vector', has_key(draft, 'x_axis'))), &
         'the x axis must not be parallel to the z axis, found '//str(real(nint(angle*1e4_wp), wp)/1e4_wp)//' deg between them')
   end subroutine find_axes

   !> &load: force and moment in global axes.
   subroutine read_load(draft)
      type(draft_t), intent(inout) :: draft
      type(load_plan_t) :: plan
      type(load_t) :: element
      logical :: has_body, is_found
      integer :: c

      call find_body(draft, 'body', text_of(draft, 'body'), element%body, has_body)
      if (has_body .and. element%body == 0 .and. text_of(draft, 'body') /= '') &
         call complain(draft, 'body', 'body must be one that moves, found '//quoted(text_of(draft, 'body')))
      call find_point(draft, 'at', text_of(draft, 'at'), plan%at, is_found)
      call choice(draft, 'factor', [character(8) :: 'constant', 'case'], c, default=1)
      if (.not. (has_key(draft, 'force') .or. has_key(draft, 'moment'))) &
         call complain(draft, '', "give 'force' or 'moment'")
      element%is_case = c /= 1
      ! stored for a rejected load too: a case may check whether it is scaled
      draft%cards(draft%k)%is_used = element%is_case
      if (.not. draft%cards(draft%k)%is_good) return

      call slots(draft, 'force', 3, draft%units%force, plan%force, default=0.0_wp)
      call slots(draft, 'moment', 3, draft%units%force*draft%units%length, plan%moment, default=0.0_wp)
      element%name = text_of(draft, 'name')
      element%where = where_of(draft)
      element%follows = switch_of(draft, 'follows', .false.)
      draft%plan%prototype%loads = [draft%plan%prototype%loads, element]
      draft%plan%loads = [draft%plan%loads, plan]
   end subroutine read_load

end module ek_reader_elements
