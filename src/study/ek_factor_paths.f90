!> The paths of the factors of a study: the numbers of the deck to which the paths lead, and errors in the paths. Also creates the
!> settings (as for --set) that define a design.
module ek_factor_paths
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: str, quoted, lower
   use ek_record, only: element, own_name, single
   use ek_group, only: group_names, point_group
   use ek_deck, only: deck_t, set_value
   use ek_matched_numbers, only: matches_t, match_t, claims_t, new_claims, claim, match_paths, match_name, choices_of, &
      separate_settings
   use ek_reader, only: definition_t
   use ek_sampler_kind, only: list_kind
   use ek_study, only: study_t, by_value, by_delta, by_scale
   use ek_factor_numbers, only: factor_paths_t
   implicit none(type, external)
   private
   public :: check_paths, check_planes, find_paths, shared_text, is_held_in_plane, setting_of, label_of, shortest

   real(wp), parameter :: plane = 1.0e-9_wp       !! limit of |y| below which a point lies in the centre plane and exists once on a
                                                  !! mirrored axle [m]
   integer, parameter :: max_named = 4            !! number of points named in a message

contains

   !> Checks that every path leads to a number of the deck. All errors are reported in one error.
   subroutine check_paths(study, deck, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(error_t), allocatable, intent(out) :: error
      character(*), parameter :: given = '--set '
      type(deck_t) :: changed
      type(error_t), allocatable :: fault
      type(message_list_t) :: mistakes
      integer :: f, k

      do f = 1, size(study%factors)
         associate (factor => study%factors(f))
            do k = 1, size(factor%paths)
               changed = deck
               call set_value(changed, trim(factor%paths(k)), setting_of(factor%change, 1.0_wp), fault)
               if (.not. allocated(fault)) cycle
               ! a mistake of the study, not of the command line
               if (index(fault%message, given) == 1) fault%message = factor%where//': factor '//quoted(factor%name)//': '// &
                  fault%message(len(given) + 1:)
               call mistakes%add(fault%message)
            end do
         end associate
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine check_paths

   !> Rejects factors that move a point out of the centre plane of a mirrored deck. Every such design would be invalid, because a
   !> point off the plane exists on both sides. Factors that multiply y are accepted. Studies of kind list are accepted, because the
   !> rows of the list may have zeros.
   subroutine check_planes(study, design, paths, error)
      type(study_t), intent(in) :: study
      type(definition_t), intent(in) :: design
      type(factor_paths_t), intent(in) :: paths(:)         !! paths of each factor
      type(error_t), allocatable, intent(out) :: error     !! exit_deck
      type(message_list_t) :: mistakes
      character(:), allocatable :: names
      integer :: f, j, points

      if (study%kind == list_kind) return
      do f = 1, size(paths)
         if (paths(f)%change == by_scale) cycle
         names = ''
         points = 0
         do j = 1, size(paths(f)%found)
            if (.not. is_held_in_plane(design, paths(f)%found(j)%number)) cycle
            points = points + 1
            if (points > max_named) cycle
            names = names//', '//quoted(own_name(design%records(design%parameters%list(paths(f)%found(j)%number)%record)))
         end do
         if (points == 0) cycle
         if (points > max_named) names = names//' and '//str(points - max_named)//' more'
         call mistakes%add(study%factors(f)%where//': factor '//quoted(study%factors(f)%name)//': its paths include y of '// &
            names(3:)//', in the centre plane of a deck with &mirror, where y must remain 0; use paths without it '// &
            '(each = .true. leaves it out), or list it in shared of &mirror if it is to move sideways')
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine check_planes

   !> Whether a number is the y coordinate of a point in the centre plane of a mirrored deck that `shared` does not name.
   pure logical function is_held_in_plane(design, number)
      type(definition_t), intent(in) :: design
      integer, intent(in) :: number               !! index of the parameter
      integer :: k, j

      is_held_in_plane = .false.
      associate (parameter => design%parameters%list(number), record => design%records(design%parameters%list(number)%record))
         if (record%group /= group_names(point_group) .or. parameter%at /= 2 .or. record%side /= single) return
         if (abs(design%parameters%x(number)) >= plane .or. all(design%records%side == single)) return
         do k = 1, size(design%records)
            if (design%records(k)%group /= 'mirror') cycle
            j = 1
            do while (element(design%records(k), 'shared', j) /= '')
               if (lower(element(design%records(k), 'shared', j)) == lower(element(record, 'name', 1))) return
               j = j + 1
            end do
         end do
      end associate
      is_held_in_plane = .true.
   end function is_held_in_plane

   !> Finds the numbers of the deck that each factor changes. Within a factor, a number counts once, also if several paths match it.
   !> Two factors that change one number are an error, because the later one would replace the value of the earlier one.
   subroutine find_paths(study, design, paths, error)
      type(study_t), intent(in) :: study
      type(definition_t), intent(in) :: design
      type(factor_paths_t), allocatable, intent(out) :: paths(:)       !! paths of each factor
      type(error_t), allocatable, intent(out) :: error                 !! exit_deck
      type(matches_t) :: matches
      type(match_t), allocatable :: shared(:)
      type(claims_t) :: claims
      type(message_list_t) :: mistakes
      character(:), allocatable :: message, before
      integer :: f, other

      allocate (paths(size(study%factors)))
      call new_claims(design%parameters, claims)
      before = ''
      do f = 1, size(paths)
         associate (factor => study%factors(f))
            paths(f)%change = factor%change
            call match_paths(design%parameters, design%records, factor%paths, factor%change /= by_value, matches, message)
            if (factor%change == by_scale) message = ''              ! a multiple has no direction
            if (message /= '') call mistakes%add(factor%where//': factor '//quoted(factor%name)//': '//message)
            paths(f)%found = choices_of(matches)
            call separate_settings(design%records, matches, factor%paths, paths(f)%settings)
            call claim(claims, matches%list, f, other, shared)
            if (other == 0) cycle
            message = factor%where//' '//study%factors(other)%where
            if (message == before) cycle                             ! each = .true. creates many factors in one line
            before = message
            call mistakes%add(shared_text(factor%where, factor%name, study%factors(other)%where, study%factors(other)%name, &
               match_name(design%records, shared(1), shared)))
         end associate
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine find_paths

   !> The message about a number that two factors change.
   function shared_text(where, name, other_where, other_name, path) result(text)
      character(*), intent(in) :: where, name              !! location and name of the later factor
      character(*), intent(in) :: other_where, other_name
      character(*), intent(in) :: path                     !! path of the number
      character(:), allocatable :: text

      text = where//': factor '//quoted(name)//': its paths match '//path//', which factor '//quoted(other_name)//' ('// &
         other_where//') also changes; let one factor change each number'
   end function shared_text

   !> The setting of a factor at a value, as in --set path=…: 5 (replaces the number), +5 (adds), *5 (multiplies).
   function setting_of(change, value) result(text)
      integer, intent(in) :: change
      real(wp), intent(in) :: value
      character(:), allocatable :: text

      text = shortest(value)
      if (change == by_delta) text = '+'//text
      if (change == by_scale) text = '*'//text
   end function setting_of

   !> The settings that define a design of the study, for messages: 'spring.coil.rate=30 bushing.top_mount.kt(1)=*1.5'.
   function label_of(study, values) result(label)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: label
      integer :: f, j

      label = ''
      do f = 1, size(values)
         do j = 1, size(study%factors(f)%paths)
            label = label//' '//trim(study%factors(f)%paths(j))//'='//setting_of(study%factors(f)%change, values(f))
         end do
      end do
      label = label(2:)
   end function label_of

   !> The shortest string that is read back as `value`, rounded to nine or more significant digits, for instance -5, 0.1 or 1E-05.
   function shortest(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      real(wp) :: again
      integer :: digits, status

      do digits = 9, 17
         text = str(value, digits)
         read (text, *, iostat=status) again
         if (status == 0 .and. abs(again - value) <= 0.0_wp) return
      end do
   end function shortest

end module ek_factor_paths
