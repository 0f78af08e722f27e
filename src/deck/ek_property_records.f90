!> `property_file` of an element: the laws of the file become &curve records in the units of the deck, and the element refers to
!> these records.
module ek_property_records
   use ek_kinds, only: wp, units_t
   use ek_error, only: error_t, message_list_t
   use ek_text, only: quoted, str
   use ek_decimal, only: get_decimal
   use ek_kept_files, only: kept_files_t, read_kept
   use ek_record, only: deck_errors_t, record_t, entry_t, add_value, add_entry, add_record, entry_index, element, is_given
   use ek_group, only: group_number, word_length, bushing_group, spring_group, stop_group
   use ek_flaws, only: flaws_t, new_flaws
   use ek_law_points, only: law_points_t
   use ek_law_text, only: units_of_law
   use ek_property, only: property_t, parse_property, file_kinds, bushing_file, spring_file, bump_file, rebound_file, &
      component_names
   use ek_attachment, only: units_in_deck, path_of, report, text_of, complain, put_word, put_numbers
   implicit none(type, external)
   private
   public :: attach_properties

   ! longest name of an element whose curves are named after it: curve = 'name_law', and of a bushing curve = 'fx=name_fx'
   integer, parameter :: name_room = word_length - len('_law'), name_room_of_bushing = word_length - len('fx=_fx')

contains

   !> Adds the curves of all property files, and adds to each element the keys that refer to these curves.
   subroutine attach_properties(files, records, used, deck_errors)
      type(kept_files_t), intent(in) :: files      !! files already read, which are not read again
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(deck_errors_t), intent(inout) :: deck_errors
      type(units_t) :: units
      type(message_list_t) :: seen
      logical :: is_iso
      integer :: k, own, source

      own = used
      if (.not. any([(is_given(records(k), 'property_file'), k=1, own)])) return
      call units_in_deck(records(:own), units, is_iso)
      source = maxval([(records(k)%source, k=1, own)])
      do k = 1, own
         if (.not. any(group_number(records(k)%group) == [bushing_group, spring_group, stop_group])) cycle
         if (text_of(records(k), 'property_file') == '') cycle
         source = source + 1
         call attach_property(k, units, source, files, seen, records, used, deck_errors)
      end do
   end subroutine attach_properties

   !> Adds the laws of the property file of one element as &curve records, and the key `curve` to the element. A free length in the
   !> file is also added, unless the element has a preload, a free length or a measure.
   subroutine attach_property(k, units, source, files, seen, records, used, deck_errors)
      integer, intent(in) :: k                     !! index of the record of the element
      type(units_t), intent(in) :: units
      integer, intent(in) :: source
      type(kept_files_t), intent(in) :: files
      type(message_list_t), intent(inout) :: seen
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(deck_errors_t), intent(inout) :: deck_errors
      character(*), parameter :: laws(4) = [character(5) :: 'kt', 'kr', 'rate', 'curve']
      type(property_t) :: property
      type(flaws_t) :: flaws
      type(error_t), allocatable :: error
      type(entry_t) :: words
      character(:), allocatable :: name, path, curve, content
      real(wp) :: x_unit, y_unit
      integer :: c, j, room

      name = trim(element(records(k), 'name', 1))
      if (name == '') return                       ! the check of the record reports it
      room = merge(name_room_of_bushing, name_room, group_number(records(k)%group) == bushing_group)
      if (len(name) > room) then
         call complain(records(k), 'name', 'with property_file the name must have at most '//str(room)// &
            ' characters, found '//str(len(name)), deck_errors)
         return
      end if
      do j = 1, size(laws)
         if (.not. is_given(records(k), trim(laws(j)))) cycle
         call complain(records(k), trim(laws(j)), 'give either property_file or '//trim(laws(j))//', not both', deck_errors)
         return
      end do
      path = path_of(records(k), text_of(records(k), 'property_file'))
      flaws = new_flaws(path)
      call read_kept(files, path, content, error)
      if (.not. allocated(error)) call parse_property(content, property, flaws)
      if (allocated(error)) then
         call complain(records(k), 'property_file', 'property_file: '//error%message, deck_errors)
         return
      else if (flaws%count() > 0) then
         call report(flaws, source, seen, deck_errors)
         return
      end if
      if (.not. fits_group(property, group_number(records(k)%group))) then
         call complain(records(k), 'property_file', 'property_file: expected the file of a '//records(k)%group//', found that '// &
            'of a '//trim(file_kinds(property%kind))//': '//quoted(path), deck_errors)
         return
      end if
      words%key = 'curve'
      words%line = records(k)%entries(entry_index(records(k), 'property_file', 0))%line
      do c = 1, merge(6, 1, property%kind == bushing_file)
         associate (law => property%laws(c))
            curve = name//'_law'
            if (property%kind == bushing_file) then
               curve = name//'_'//component_names(c)
               if (c < 6 .or. words%used > 0) then
                  if (.not. any(abs(law%y(:law%used)) > 0.0_wp)) cycle      ! it carries nothing
               end if
               call add_value(words, component_names(c)//'='//curve, .true.)
            else
               call add_value(words, curve, .true.)
            end if
            call units_of_law(c, units%length, units%force, units%angle, x_unit, y_unit)
            call add_curve(curve, law, number_in(records(k), 'property_offset', c, 0.0_wp)*x_unit, &
               number_in(records(k), 'property_scale', c, 1.0_wp), x_unit, y_unit)
         end associate
      end do
      call add_entry(records(k), words)
      if (property%free_length > 0.0_wp .and. .not. (is_given(records(k), 'preload') .or. is_given(records(k), 'free_length') &
         .or. is_given(records(k), 'measure'))) call put_numbers(records(k), 'free_length', [property%free_length/units%length])

   contains

      !> Adds a law as a &curve record, whose location is the line of the file at which the law begins.
      subroutine add_curve(name, law, offset, scale, x_unit, y_unit)
         character(*), intent(in) :: name
         type(law_points_t), intent(in) :: law
         real(wp), intent(in) :: offset, scale, x_unit, y_unit
         type(record_t) :: record
         character(:), allocatable :: kind

         record%group = 'curve'
         record%file = path
         record%source = source
         record%line = law%line
         record%origin = 'property_file'
         call put_word(record, 'name', name)
         kind = text_of(records(k), 'property_kind')
         if (kind == '') kind = 'akima'
         call put_word(record, 'kind', kind)
         call put_numbers(record, 'x', (law%x(:law%used) - offset)/x_unit)
         call put_numbers(record, 'y', law%y(:law%used)*scale/y_unit)
         call add_record(records, used, record)
      end subroutine add_curve

   end subroutine attach_property

   !> Whether the kind of a property file fits a group.
   pure logical function fits_group(property, group)
      type(property_t), intent(in) :: property
      integer, intent(in) :: group

      select case (group)
      case (bushing_group)
         fits_group = property%kind == bushing_file
      case (spring_group)
         fits_group = property%kind == spring_file
      case default
         fits_group = property%kind == bump_file .or. property%kind == rebound_file
      end select
   end function fits_group

   !> Element `at` of a number key of a record; `default` if the element is not given, or is not a number. The check of the record
   !> reports the latter error.
   pure real(wp) function number_in(record, key, at, default) result(value)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      real(wp), intent(in) :: default
      logical :: is_number

      call get_decimal(element(record, key, at), value, is_number)
      if (.not. is_number) value = default
   end function number_in

end module ek_property_records
