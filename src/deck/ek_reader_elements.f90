!> &bushing and &load.
module ek_reader_elements
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_rotation, only: cross, perpendicular, unit_vector
   use ek_curve, only: curve_t
   use ek_elastic, only: bushing_t
   use ek_suspension, only: suspension_t, load_t
   use ek_builder, only: add_bushing, add_load
   use ek_group, only: bushing_group, load_group, word_length
   use ek_deck, only: deck_t
   use ek_reader_curves, only: find_curve, check_rate
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, find_point, find_body, find_bodies, &
      find_direction, to_internal, angle_between
   implicit none(type, external)
   private
   public :: read_bushings, read_loads

   real(wp), parameter :: least_angle = 0.01_wp   !! deg between x and z, below which x is undefined

contains

   !> &bushing. Rates: force/length and moment/angle, the moment being force × length.
   subroutine read_bushings(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, bodies(2), at(2), z_axis(2), x_axis(2), curve(6)
      real(wp) :: z_vector(3), x_vector(3), kt(3), kr(3), preload_force(3), preload_moment(3)
      namelist /bushing/ name, bodies, at, z_axis, z_vector, x_axis, x_vector, kt, kr, curve, preload_force, &
         preload_moment
      type(bushing_t) :: element
      real(wp) :: ends(3, 2)
      logical :: has_bodies, is_found
      integer :: k, j, number(2), status

      do k = 1, deck%used
         if (draft%cards(k)%group /= bushing_group) cycle
         name = ''
         bodies = ''
         at = ''
         z_axis = ''
         x_axis = ''
         curve = ''
         z_vector = 0.0_wp
         x_vector = 0.0_wp
         kt = 0.0_wp
         kr = 0.0_wp
         preload_force = 0.0_wp
         preload_moment = 0.0_wp
         read (draft%cards(k)%text, nml=bushing, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call find_bodies(draft, deck, k, bodies, number, has_bodies)
         call find_point(draft, deck, k, 'at', trim(at(1)), ends(:, 1), is_found)
         ends(:, 2) = ends(:, 1)
         if (at(2) /= '') call find_point(draft, deck, k, 'at', trim(at(2)), ends(:, 2), is_found)
         if (.not. (has_key(deck, k, 'kt') .or. has_key(deck, k, 'kr') .or. has_key(deck, k, 'curve'))) &
            call complain(draft, deck, k, '', "give 'kt', 'kr' or 'curve'")
         do j = 1, 3
            call check_rate(draft, deck, k, 'kt', '('//str(j)//')', kt(j))
            call check_rate(draft, deck, k, 'kr', '('//str(j)//')', kr(j))
         end do
         call find_laws(draft, deck, k, curve, [kt, kr], element)
         call find_axes(draft, deck, k, z_axis, z_vector, x_axis, x_vector, element%axes)
         if (.not. draft%cards(k)%is_good) cycle

         associate (units => draft%units)
            element%name = trim(name)
            element%where = where_of(deck, k)
            element%body_i = number(1)
            element%body_j = number(2)
            element%arm_i = ends(:, 1)
            element%arm_j = ends(:, 2)
            element%kt = kt*(units%force/units%length)
            element%kr = kr*(units%force*units%length/units%angle)
            element%preload_force = preload_force*units%force
            element%preload_moment = preload_moment*(units%force*units%length)
         end associate
         call add_bushing(suspension, element)
      end do
   end subroutine read_bushings

   !> Curves of a bushing: texts 'fx=c' or 'mz=-c', the minus sign for the curve reflected through the origin.
   subroutine find_laws(draft, deck, k, words, rates, element)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: words(:)
      real(wp), intent(in) :: rates(6)            !! deck units; a component has either a rate or a curve
      type(bushing_t), intent(inout) :: element
      character(*), parameter :: components(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']
      type(curve_t), allocatable :: curve
      character(:), allocatable :: name
      integer :: w, c, mark

      element%has_curves = .false.
      if (allocated(element%laws)) deallocate (element%laws)
      if (all(words == '')) return
      element%has_curves = .true.
      allocate (element%laws(6))
      do w = 1, size(words)
         if (words(w) == '') cycle
         mark = index(words(w), '=')
         c = 0
         if (mark > 0) c = findloc(components, lower(trim(adjustl(words(w) (:mark - 1)))), dim=1)
         if (c == 0) then
            call complain(draft, deck, k, 'curve', "curve must be like 'fx=name' or 'mz=-name' (fx, fy, fz, mx, my, mz), found "// &
               quoted(words(w)))
            cycle
         end if
         name = trim(adjustl(words(w) (mark + 1:)))
         if (index(name, '-') == 1) then
            element%laws(c)%sign = -1.0_wp
            name = trim(adjustl(name(2:)))
         end if
         if (element%laws(c)%has_curve) then
            call complain(draft, deck, k, 'curve', 'curve: '//components(c)//' is given twice')
         else if (abs(rates(c)) > 0.0_wp) then
            call complain(draft, deck, k, 'curve', 'curve: '//components(c)//' already has a rate; set its element of '// &
               merge('kt', 'kr', c <= 3)//' to 0')
         else if (name == '') then
            call complain(draft, deck, k, 'curve', 'curve: '//components(c)//' names no curve')
         end if
         if (c <= 3) then
            call find_curve(draft, deck, k, 'curve', name, draft%units%length, draft%units%force, curve)
         else
            call find_curve(draft, deck, k, 'curve', name, draft%units%angle, draft%units%force*draft%units%length, curve)
         end if
         element%laws(c)%has_curve = .true.
         if (allocated(curve)) element%laws(c)%curve = curve
      end do
   end subroutine find_laws

   !> The marker axes: z is kept, x is made perpendicular to it, y = z × x. If only one is given, the other is
   !> chosen by `perpendicular`; if none is given, they are the deck's global axes.
   subroutine find_axes(draft, deck, k, z_axis, z_vector, x_axis, x_vector, axes)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: z_axis(2), x_axis(2)
      real(wp), intent(in) :: z_vector(3), x_vector(3)
      real(wp), intent(out) :: axes(3, 3)      !! columns x, y, z; x rearward
      real(wp) :: x(3), z(3), angle
      logical :: has_x, has_z, is_x, is_z

      call find_direction(draft, deck, k, 'z_axis', z_axis, 'z_vector', z_vector, z, has_z, is_z)
      call find_direction(draft, deck, k, 'x_axis', x_axis, 'x_vector', x_vector, x, has_x, is_x)
      axes(:, 1) = to_internal(draft, [1.0_wp, 0.0_wp, 0.0_wp])
      axes(:, 2) = to_internal(draft, [0.0_wp, 1.0_wp, 0.0_wp])
      axes(:, 3) = [0.0_wp, 0.0_wp, 1.0_wp]
      if (.not. (has_x .or. has_z)) return
      if ((has_x .and. .not. is_x) .or. (has_z .and. .not. is_z)) return
      ! chosen in deck axes, so that the choice is the same in either frame
      if (.not. has_x) x = to_internal(draft, perpendicular(to_internal(draft, z)))
      if (.not. has_z) z = to_internal(draft, perpendicular(to_internal(draft, x)))
      angle = angle_between(x, z)
      if (min(angle, 180.0_wp - angle) < least_angle) then
         call complain(draft, deck, k, merge('x_axis  ', 'x_vector', has_key(deck, k, 'x_axis')), &
            'the x axis must not be parallel to the z axis, found '// &
            str(real(nint(angle*1e4_wp), wp)/1e4_wp)//' deg between them')
         return
      end if
      axes(:, 1) = unit_vector(x - dot_product(x, z)*z)
      axes(:, 2) = cross(z, axes(:, 1))
      axes(:, 3) = z
   end subroutine find_axes

   !> &load: force and moment in global axes.
   subroutine read_loads(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, body, at, factor
      real(wp) :: force(3), moment(3)
      logical :: follows
      namelist /load/ name, body, at, force, moment, follows, factor
      type(load_t) :: element
      logical :: has_body, is_found
      integer :: k, c, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= load_group) cycle
         name = ''
         body = ''
         at = ''
         factor = 'constant'
         force = 0.0_wp
         moment = 0.0_wp
         follows = .false.
         read (draft%cards(k)%text, nml=load, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         call find_body(draft, deck, k, 'body', trim(body), element%body, has_body)
         if (has_body .and. element%body == 0) &
            call complain(draft, deck, k, 'body', 'body must be one that moves, found '//quoted(body))
         call find_point(draft, deck, k, 'at', trim(at), element%arm, is_found)
         call choice(draft, deck, k, 'factor', trim(factor), [character(8) :: 'constant', 'case'], c)
         if (.not. (has_key(deck, k, 'force') .or. has_key(deck, k, 'moment'))) &
            call complain(draft, deck, k, '', "give 'force' or 'moment'")
         element%is_case = c /= 1
         ! stored for a rejected load too: a case may check whether it is scaled
         draft%cards(k)%is_used = element%is_case
         if (.not. draft%cards(k)%is_good) cycle

         element%name = trim(name)
         element%where = where_of(deck, k)
         element%force = to_internal(draft, force)*draft%units%force
         element%moment = to_internal(draft, moment)*(draft%units%force*draft%units%length)
         element%follows = follows
         call add_load(suspension, element)
      end do
   end subroutine read_loads

end module ek_reader_elements
