!> &hardpoints: the points in the file become &point records, in the units and the axes of the deck.
module ek_hardpoint_records
   use ek_kinds, only: wp, units_t
   use ek_error, only: error_t, message_list_t
   use ek_text, only: lower, quoted, str
   use ek_kept_files, only: kept_files_t, keep_file, read_kept
   use ek_group, only: point_group
   use ek_record, only: deck_errors_t, place_in, record_t, add_record, is_given
   use ek_unit_word, only: unit_of, length_unit
   use ek_flaws, only: flaws_t, new_flaws
   use ek_hardpoint_sheet, only: hardpoints_t, parse_hardpoints, left_point, right_point, point_pair
   use ek_attachment, only: units_in_deck, path_of, report, text_of, complain, put_word, put_numbers
   implicit none(type, external)
   private
   public :: attach_hardpoints

   real(wp), parameter :: near = 1.0e-9_wp                !! greatest difference of a coordinate between two images [m]

contains

   !> Adds a &point record for each hardpoint in the files of all &hardpoints. Errors are added to the errors of the deck.
   subroutine attach_hardpoints(files, records, used, deck_errors)
      type(kept_files_t), intent(inout) :: files   !! receives the files that are read
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(deck_errors_t), intent(inout) :: deck_errors
      type(units_t) :: units
      type(hardpoints_t) :: sheet
      type(flaws_t) :: flaws
      type(error_t), allocatable :: error
      type(message_list_t) :: seen
      character(:), allocatable :: path, side, content
      real(wp) :: length
      logical :: is_iso, is_file_iso, has_mirror
      integer :: k, own, source, before, first

      own = used
      first = deck_errors%count()
      if (.not. any([(records(k)%group == 'hardpoints', k=1, own)])) return
      call units_in_deck(records(:own), units, is_iso)
      has_mirror = any([(records(k)%group == 'mirror', k=1, own)])
      source = maxval([(records(k)%source, k=1, own)])
      do k = 1, own
         if (records(k)%group /= 'hardpoints' .or. text_of(records(k), 'file') == '') cycle
         path = path_of(records(k), text_of(records(k), 'file'))
         length = units%length
         if (is_given(records(k), 'length')) length = unit_of(length_unit, text_of(records(k), 'length'))
         if (.not. length > 0.0_wp) then
            call complain(records(k), 'length', 'length must be a unit (mm, cm, m, inch, foot), found '// &
               quoted(text_of(records(k), 'length')), deck_errors)
            cycle
         end if
         side = lower(text_of(records(k), 'side'))
         if (side /= '' .and. side /= 'left' .and. side /= 'right' .and. side /= 'both') then
            call complain(records(k), 'side', 'side must be one of ''left'', ''right'', ''both'', found '//quoted(side), &
               deck_errors)
            cycle
         else if (has_mirror .and. (side == 'right' .or. side == 'both')) then
            call complain(records(k), 'side', 'side must be ''left'' in a deck with &mirror, found '//quoted(side), deck_errors)
            cycle
         end if
         if (has_mirror) side = 'left'
         sheet = hardpoints_t()
         flaws = new_flaws(path)
         call keep_file(files, path)
         call read_kept(files, path, content, error)
         if (.not. allocated(error)) call parse_hardpoints(content, length, sheet, flaws)
         if (allocated(error)) then
            call complain(records(k), 'file', 'file: '//error%message, deck_errors)
            cycle
         end if
         source = source + 1
         if (flaws%count() > 0) then
            call report(flaws, source, seen, deck_errors)
            cycle
         end if
         is_file_iso = is_iso .and. .not. sheet%is_adams
         select case (lower(text_of(records(k), 'axes')))
         case ('iso')
            is_file_iso = .true.
         case ('x-rear')
            is_file_iso = .false.
         case ('')
            continue
         case default
            call complain(records(k), 'axes', 'axes must be one of ''x-rear'', ''iso'', found '// &
               quoted(text_of(records(k), 'axes')), deck_errors)
            cycle
         end select
         before = deck_errors%count()
         if (has_mirror) call check_images(sheet, path, source, deck_errors)
         if (deck_errors%count() == before) call add_points(sheet, side, merge(-1.0_wp, 1.0_wp, is_file_iso .neqv. is_iso), &
            units%length, path, source, records, used)
      end do
      if (deck_errors%count() > first) call deck_errors%lose(point_group)
   end subroutine attach_hardpoints

   !> Checks that, in a deck with &mirror, each right hardpoint is the image of the left hardpoint with the same name.
   subroutine check_images(sheet, path, source, deck_errors)
      type(hardpoints_t), intent(in) :: sheet
      character(*), intent(in) :: path
      integer, intent(in) :: source
      type(deck_errors_t), intent(inout) :: deck_errors
      integer :: j, k

      do k = 1, sheet%used
         if (sheet%points(k)%symmetry /= right_point) cycle
         do j = 1, sheet%used
            if (sheet%points(j)%symmetry == left_point .and. lower(sheet%points(j)%name) == lower(sheet%points(k)%name)) exit
         end do
         if (j > sheet%used) then
            call deck_errors%add(place_in(path, source, sheet%points(k)%line), 'expected hardpoint '// &
               quoted(sheet%points(k)%name)//' on both sides, as the deck has &mirror, found it on the right only')
         else if (any(abs(sheet%points(k)%at*[1, -1, 1] - sheet%points(j)%at) > near)) then
            call deck_errors%add(place_in(path, source, sheet%points(k)%line), 'expected the image of the left hardpoint '// &
               quoted(sheet%points(k)%name)//' in line '//str(sheet%points(j)%line)//', as the deck has &mirror, found another')
         end if
      end do
   end subroutine check_images

   !> Adds a &point for each hardpoint of a side, and for each hardpoint that exists once. If no side or both sides are requested,
   !> adds the hardpoints of both sides, with left_ or right_ before their names.
   subroutine add_points(sheet, side, sign, length, path, source, records, used)
      type(hardpoints_t), intent(in) :: sheet
      character(*), intent(in) :: side, path        !! side: '' or 'both', 'left', 'right'
      real(wp), intent(in) :: sign                  !! factor of x and y: −1 if file and deck have different frames
      real(wp), intent(in) :: length                !! m per unit of the deck
      integer, intent(in) :: source
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      character(:), allocatable :: name
      real(wp) :: at(3)
      integer :: k, this

      do k = 1, sheet%used
         associate (point => sheet%points(k))
            name = trim(point%name)
            do this = left_point, right_point
               at = point%at
               select case (point%symmetry)
               case (left_point, right_point)
                  if (point%symmetry /= this) cycle
               case (point_pair)
                  if (this == right_point) at(2) = -at(2)
               case default
                  if (this == right_point) cycle      ! it exists once
               end select
               if (point%symmetry == left_point .or. point%symmetry == right_point .or. point%symmetry == point_pair) then
                  if (side == 'left' .and. this == right_point) cycle
                  if (side == 'right' .and. this == left_point) cycle
                  name = trim(point%name)
                  if (side == '' .or. side == 'both') name = trim(merge('left_ ', 'right_', this == left_point))//name
               end if
               call put(name, at*[sign, sign, 1.0_wp]/length, point%line)
            end do
         end associate
      end do

   contains

      !> Appends a &point record for one hardpoint.
      subroutine put(name, at, line)
         character(*), intent(in) :: name
         real(wp), intent(in) :: at(3)
         integer, intent(in) :: line
         type(record_t) :: record

         record%group = 'point'
         record%file = path
         record%source = source
         record%line = line
         record%origin = '&hardpoints'
         call put_word(record, 'name', name)
         call put_numbers(record, 'at', at)
         call add_record(records, used, record)
      end subroutine put

   end subroutine add_points

end module ek_hardpoint_records
