!> Converts files of other programs to groups of a deck, which `elastokin import` writes. The format of a file follows from its
!> content.
module ek_foreign_deck
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, lower
   use ek_decimal, only: decimal
   use ek_letters, only: with_line_ends
   use ek_file, only: read_whole, most_of_input, join_path, folder_name, base_name, file_exists
   use ek_flaws, only: flaws_t, new_flaws, shown
   use ek_fields, only: legal_name, lines_t, split_lines
   use ek_law_points, only: add_point
   use ek_property, only: property_t, parse_property, bushing_file, spring_file, rebound_file
   use ek_hardpoint_sheet, only: hardpoints_t, parse_hardpoints, single_point, left_point, right_point, point_pair
   use ek_frame_votes, only: wish_t
   use ek_point_table, only: point_table_t, parse_points
   use ek_axle_facts, only: axle_facts_t
   use ek_point_deck, only: put_points
   use ek_chrono, only: is_json, is_chrono, parse_chrono
   use ek_chrono_vehicle, only: is_chrono_vehicle, parse_chrono_vehicle
   use ek_point_list, only: is_toml, as_json, parse_point_list
   use ek_shark, only: is_shark, parse_shark
   use ek_optimum_sheet, only: is_optimum_sheet, as_point_table
   use ek_lotus_listing, only: is_lotus_listing, parse_lotus_listing
   use ek_unread_format, only: advice_on
   use ek_teimorbit, only: is_teimorbit
   use ek_kin, only: kin_t
   use ek_kin_reader, only: parse_kin, is_kin
   use ek_kin_check, only: is_used_mount, check_kin
   use ek_kin_deck, only: mount_law_t, kin_deck
   use ek_lcf, only: lcf_t, parse_lcf, lcf_table
   use ek_deck_text, only: deck_text_t
   use ek_law_text, only: put_curve, put_curves, put_bushing_law
   implicit none(type, external)
   private
   public :: axle_kind, points_kind, law_kind, loads_kind, table_kind, kind_of_text, import_text, import_file, put_model

   integer, parameter :: axle_kind = 1, points_kind = 2, law_kind = 3, loads_kind = 4
   integer, parameter :: table_kind = 5      !! points with their frame: a deck of its own

contains

   !> The format of a file content. A file in no known format is read as a table of hardpoints.
   pure integer function kind_of_text(text) result(kind)
      character(*), intent(in) :: text
      character(:), allocatable :: folded

      folded = lower(text)
      if (is_teimorbit(text)) then
         kind = law_kind
         if (index(folded, '[data]') > 0 .and. index(folded, '_curve]') == 0) kind = loads_kind
         if (index(folded, '[hardpoint]') > 0 .or. index(folded, '[subsystem]') > 0 .or. &
            index(folded, '[subsystem_header]') > 0 .or. index(folded, '[assembly_header]') > 0) kind = points_kind
      else if (is_kin(text)) then
         kind = axle_kind
      else if (index(folded, 'displacement') > 0 .and. index(folded, '''') > 0) then
         kind = law_kind
      else if (index(adjustl(text), '<') == 1) then
         kind = law_kind
      else
         kind = points_kind
      end if
   end function kind_of_text

   !> Reads a file and converts it to a part of a deck, or for loads_kind to a table of loads.
   subroutine import_file(path, text, kind, error, wish)
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      integer, intent(out) :: kind
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the file cannot be read; exit_deck: it has errors
      type(wish_t), intent(in), optional :: wish            !! see import_text
      character(:), allocatable :: content
      type(flaws_t) :: flaws

      kind = 0
      call read_whole(path, content, error, may_stream=.true., most=most_of_input)
      if (allocated(error)) return
      flaws = new_flaws(path)
      call import_text(content, path, text, kind, flaws, wish)
      if (flaws%count() == 0) return
      call fail(error, exit_deck, ten_lines(flaws%text()))
   end subroutine import_file

   !> A text of errors, of which at most ten lines are shown: an error in the form of a file repeats itself in every line.
   pure function ten_lines(text) result(shown_lines)
      character(*), intent(in) :: text
      character(:), allocatable :: shown_lines
      integer, parameter :: longest = 10
      integer :: k, ends

      shown_lines = text
      ends = count([(text(k:k) == new_line('a'), k=1, len(text))])
      if (ends < longest) return
      ends = 0
      do k = 1, len(text)
         if (text(k:k) == new_line('a')) ends = ends + 1
         if (ends == longest - 1) exit
      end do
      shown_lines = text(:k)//'and more errors: correct these first'
   end function ten_lines

   !> Converts the content of a file as import_file converts a file. Errors are in `flaws`; `text` is '' if there are errors.
   subroutine import_text(content, path, text, kind, flaws, wish)
      character(*), intent(in) :: content, path
      character(:), allocatable, intent(out) :: text
      integer, intent(out) :: kind
      type(flaws_t), intent(inout) :: flaws
      type(wish_t), intent(in), optional :: wish            !! frame, axle and side of a table; default: none given
      type(lcf_t) :: lcf

      text = ''
      kind = points_kind
      if (advice_on(path, content) /= '') then
         call flaws%add(0, advice_on(path, content))
         return
      end if
      kind = kind_of_text(with_line_ends(content))
      if (is_toml(path) .or. is_lotus_listing(content)) kind = table_kind
      select case (kind)
      case (axle_kind)
         call import_axle(content, path, text, flaws)
      case (points_kind)
         if (is_teimorbit(with_line_ends(content))) then
            call import_points(content, path, text, flaws)
         else
            kind = table_kind
            call import_table(content, path, text, flaws, wish)
         end if
      case (table_kind)
         call import_table(content, path, text, flaws, wish)
      case (law_kind)
         call import_law(content, path, text, flaws)
      case (loads_kind)
         call parse_lcf(content, lcf, flaws)
         if (flaws%count() == 0) text = lcf_table(lcf, 'rack_drive', path)
      end select
      if (flaws%count() > 0) text = ''
   end subroutine import_text

   !> The group &model of a deck, as a string. Its units are mm, N and deg, and its x axis points rearward, as in files of
   !> Adams/Car.
   function put_model(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      type(deck_text_t) :: deck

      call deck%comment('Made by elastokin import; a part of a deck: bodies, joints and elements are missing.')
      call deck%begin('model')
      call deck%word('name', legal_name(name))
      call deck%word('length', 'mm')
      call deck%word('force', 'N')
      call deck%word('angle', 'deg')
      call deck%word('axes', 'x-rear')
      call deck%end()
      text = deck%text()
   end function put_model

   !> Writes the deck of a table of hardpoints: frame and unit are those of the options, or decided by votes. JSON and TOML are
   !> lists of points, or a suspension of Chrono, whose format defines frame and unit.
   subroutine import_table(content, path, text, flaws, wish)
      character(*), intent(in) :: content, path
      character(:), allocatable, intent(inout) :: text
      type(flaws_t), intent(inout) :: flaws
      type(wish_t), intent(in), optional :: wish
      type(point_table_t) :: table
      type(lines_t) :: lines
      type(wish_t) :: given
      type(axle_facts_t) :: facts
      character(:), allocatable :: json                    !! or a table, converted
      character(:), allocatable :: source                  !! file of the points
      real(wp) :: radius(2)

      if (present(wish)) given = wish
      source = path
      call split_lines(content, lines, flaws)          ! reports a workbook and an empty file
      if (flaws%count() > 0) return
      if (is_shark(lines)) then
         call parse_shark(lines, table, radius, flaws)
         call choose_radius(table, radius, given)
      else if (is_lotus_listing(content)) then
         call parse_lotus_listing(lines, table, radius, facts, flaws)
         call choose_radius(table, radius, given)
      else if (is_toml(path)) then
         call as_json(lines, json, flaws)
         if (flaws%count() == 0) call parse_point_list(json, table, flaws)
      else if (is_json(lines%text) .and. .not. is_chrono(lines%text)) then
         call parse_point_list(lines%text, table, flaws)
      else if (is_json(lines%text)) then
         if (given%axes /= '' .or. given%length /= '') call flaws%add(0, 'the format defines axes and unit (x forward, y left, '// &
            'z up, m): omit --axes and --length')
         given%axes = 'iso'
         given%length = 'm'
         given%source = 'by the format of Chrono'
         if (is_chrono_vehicle(lines%text)) then
            call parse_chrono_vehicle(lines%text, path, trim(given%axle), table, facts, source, flaws)
         else
            call parse_chrono(lines%text, table, facts, flaws)
         end if
      else if (is_optimum_sheet(lines)) then
         call as_point_table(lines, json, facts%omitted)
         call parse_points(json, table, flaws)
      else
         call parse_points(content, table, flaws)
      end if
      if (flaws%count() == 0) call put_points(table, given, facts, source, text, flaws)
   end subroutine import_table

   !> Takes the loaded radius of the chosen axle of a model of Lotus Shark as the height of the wheel centre, if --datum is not
   !> given.
   subroutine choose_radius(table, radius, wish)
      type(point_table_t), intent(in) :: table
      real(wp), intent(in) :: radius(2)              !! 0: not given
      type(wish_t), intent(inout) :: wish
      real(wp) :: chosen

      if (wish%datum /= '') return
      chosen = maxval(radius)
      if (all([any(table%points(:table%used)%axle == 1), any(table%points(:table%used)%axle == 2)])) then
         if (wish%axle /= 'front' .and. wish%axle /= 'rear') return
         chosen = radius(merge(1, 2, wish%axle == 'front'))
      end if
      if (chosen > 0.0_wp) wish%datum = 'radius:'//decimal(chosen)
      if (chosen > 0.0_wp) wish%datum_source = 'the radius of the tyre in the file'
   end subroutine choose_radius

   !> Writes &point for each hardpoint; for a pair, the left and the right point.
   subroutine import_points(content, path, text, flaws)
      character(*), intent(in) :: content, path
      character(:), allocatable, intent(inout) :: text
      type(flaws_t), intent(inout) :: flaws
      type(hardpoints_t) :: sheet
      type(deck_text_t) :: deck
      integer :: k

      call parse_hardpoints(content, millimetre, sheet, flaws)
      if (flaws%count() > 0) return
      call deck%blank()
      call deck%comment('hardpoints of '//path)
      do k = 1, sheet%used
         associate (this => sheet%points(k))
            select case (this%symmetry)
            case (single_point)
               call put(trim(this%name), this%at)
            case (left_point)
               call put('left_'//trim(this%name), this%at)
            case (right_point)
               call put('right_'//trim(this%name), this%at)
            case (point_pair)
               call put('left_'//trim(this%name), this%at)
               call put('right_'//trim(this%name), this%at*[1.0_wp, -1.0_wp, 1.0_wp])
            end select
         end associate
      end do
      text = deck%text()

   contains

      subroutine put(name, at)
         character(*), intent(in) :: name
         real(wp), intent(in) :: at(3)

         call deck%begin('point')
         call deck%word('name', name)
         call deck%numbers('at', at/millimetre)
         call deck%word('note', plain_name(path)//':'//str(sheet%points(k)%line))
         call deck%end()
      end subroutine put

   end subroutine import_points

   !> Writes a &curve for the law of a spring or a stop, or for each law of a bushing that is not a constant rate. Comments contain
   !> the element that uses the curves.
   subroutine import_law(content, path, text, flaws)
      character(*), intent(in) :: content, path
      character(:), allocatable, intent(inout) :: text
      type(flaws_t), intent(inout) :: flaws
      type(property_t) :: property
      type(deck_text_t) :: deck, element
      character(:), allocatable :: name

      call parse_property(content, property, flaws)
      if (flaws%count() > 0) return
      name = legal_name(base_name(path))
      call deck%blank()
      call deck%comment('from '//path)
      call deck%comment('the element, to be completed by its bodies and points, is in the comment below')
      if (property%kind == bushing_file) then
         call put_curves(deck, name, property%laws, 'akima', plain_name(path))
         call element%begin('bushing')
         call element%word('name', name)
         call put_bushing_law(element, name, property%laws)
      else
         call put_curve(deck, name, property%laws(1), 1, 'akima', plain_name(path))
         if (property%kind == spring_file) then
            call element%begin('spring')
         else
            call element%begin('stop')
            call element%word('type', trim(merge('rebound', 'bump   ', property%kind == rebound_file)))
         end if
         call element%word('name', 'unnamed')
         call element%word('curve', name)
         if (property%free_length > 0.0_wp) call element%number('free_length', property%free_length/millimetre)
      end if
      call element%end()
      text = deck%text()//commented(element%text())
   end subroutine import_law

   !> The name of a file without its folder, for notes.
   pure function plain_name(path) result(name)
      character(*), intent(in) :: path
      character(:), allocatable :: name
      name = path(index(path, '/', back=.true.) + 1:)
   end function plain_name

   !> A string in which every line is a comment of a deck.
   function commented(text) result(lines)
      character(*), intent(in) :: text
      character(:), allocatable :: lines
      integer :: k

      lines = '! '
      do k = 1, len(text)
         lines = lines//text(k:k)
         if (text(k:k) == new_line('a') .and. k < len(text)) lines = lines//'! '
      end do
   end function commented

   !> Writes an axle with its bushings, whose laws are in separate files.
   subroutine import_axle(content, path, text, flaws)
      character(*), intent(in) :: content, path
      character(:), allocatable, intent(inout) :: text
      type(flaws_t), intent(inout) :: flaws
      type(kin_t) :: kin
      type(mount_law_t) :: mounts(size(kin%mounts))
      integer :: k

      call parse_kin(content, kin, flaws)
      if (flaws%count() > 0) return
      call check_kin(kin, flaws)
      do k = 1, size(mounts)
         if (is_used_mount(kin, k)) call find_mount(path, kin%mounts(k)%file, kin%mounts(k)%line, mounts(k), flaws)
      end do
      if (flaws%count() > 0) return
      call kin_deck(kin, mounts, path, text, flaws)
   end subroutine import_axle

   !> Finds the law of a bushing in its file. The file is in the folder of the axle, or below this folder at the path that the axle
   !> gives. IPGKinematics has files such as lin01000.gum for 1000 N/mm in all directions, without rotational stiffness; these files
   !> need not exist.
   subroutine find_mount(path, named, line, mount, flaws)
      character(*), intent(in) :: path, named
      integer, intent(in) :: line
      type(mount_law_t), intent(inout) :: mount
      type(flaws_t), intent(inout) :: flaws
      type(property_t) :: property
      type(flaws_t) :: inner
      type(error_t), allocatable :: error
      character(:), allocatable :: slashed, name, found, content
      real(wp) :: rate
      integer :: k

      slashed = named
      do k = 1, len(slashed)
         if (slashed(k:k) == '\') slashed(k:k) = '/'
      end do
      name = slashed(index(slashed, '/', back=.true.) + 1:)
      if (len(name) == 0) then
         call flaws%add(line, 'expected the file of a bushing, found '//shown(named))
         return
      end if
      found = join_path(folder_name(path), slashed)
      if (.not. file_exists(found)) found = join_path(folder_name(path), name)
      if (file_exists(found)) then
         call read_whole(found, content, error, most=most_of_input)
         if (allocated(error)) then
            call flaws%add(line, error%message)
            return
         end if
         inner = new_flaws(found)
         call parse_property(content, property, inner)
         if (inner%count() > 0) then
            call flaws%add(line, 'errors in the bushing:'//new_line('a')//inner%text())
            return
         end if
         if (property%kind /= bushing_file) then
            call flaws%add(line, 'expected a bushing, found another file: '//shown(found))
            return
         end if
         mount%laws = property%laws
         mount%note = name
         return
      end if
      if (is_linear(name)) then
         read (name(4:8), *) rate
         rate = rate/millimetre
         do k = 1, 6
            call add_point(mount%laws(k), -1.0_wp, merge(-rate, 0.0_wp, k <= 3), line)
            call add_point(mount%laws(k), 1.0_wp, merge(rate, 0.0_wp, k <= 3), line)
         end do
         mount%note = name//': the rate is that of its name, as the file is not there'
         return
      end if
      call flaws%add(line, 'cannot find the bushing '//shown(named)//'; put '//shown(name)//' in the folder of '//shown(path))
   end subroutine find_mount

   !> Whether the name of a bushing file gives the rate of the bushing, as lin01000.gum does.
   pure logical function is_linear(name)
      character(*), intent(in) :: name

      is_linear = len(name) == 12
      if (is_linear) is_linear = lower(name(:3)) == 'lin' .and. lower(name(9:)) == '.gum' .and. &
         verify(name(4:8), '0123456789') == 0
   end function is_linear

end module ek_foreign_deck
