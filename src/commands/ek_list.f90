!> elastokin list: the names that commands accept for a deck: paths of its numbers, cases, key numbers.
!>
!> No case is solved, so that a listed key number may turn out to have no value.
module ek_list
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted, is_like, suggestion_by_part
   use ek_letters, only: as_utf8
   use ek_buffer, only: buffer_t
   use ek_json, only: json_t, json_string
   use ek_reader, only: definition_t
   use ek_case, only: case_t, is_mountable
   use ek_suspension, only: suspension_t
   use ek_standard_tests, only: standard_tests
   use ek_lone_case, only: case_on_rig
   use ek_number_names, only: list_numbers
   use ek_workspace, only: workspace_t
   use ek_direction, only: direction_t, all_directions
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck
   use ek_list_definitions, only: list_definitions
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: list_names

   character(*), parameter :: of_deck = 'case', of_report = 'standard test', on_request = 'standard test on request'
   character(*), parameter :: space = '  '      !! between two columns of the text

   !> A table of strings, which are printed in aligned columns.
   type :: columns_t
      type(message_list_t) :: cells      !! row by row
      integer :: columns = 0
   end type columns_t

contains

   !> Prints the names of a deck as text or, with --json, as one JSON object (schema/list.schema.json).
   subroutine list_names(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_usage also if no name matches --like
      type(deck_settings_t) :: settings
      type(definition_t), target :: definition
      class(workspace_t), allocatable :: workspace
      character(:), allocatable :: checksum, text
      type(direction_t), allocatable :: numbers(:)
      type(columns_t) :: cases, key_numbers, paths
      type(message_list_t) :: known
      logical :: is_all, wants(3)      ! paths, cases, key numbers

      if (line%has('--definitions')) then
         call list_definitions(line, error)
         return
      end if
      call read_deck_settings(line, settings)
      call load_deck(settings, definition, workspace, checksum, error)
      if (allocated(error)) return
      wants = [line%has('--paths'), line%has('--cases'), line%has('--numbers')]
      is_all = .not. any(wants)
      wants = wants .or. is_all
      allocate (numbers(0))
      if (wants(1)) call all_directions(definition, numbers)
      paths = path_table(numbers, sorted_by_path(numbers), line%value('--like', '*'), known)
      cases%columns = 6
      key_numbers%columns = 3
      if (any(wants(2:))) &
         call add_names(workspace%raw, workspace%deck_cases, line%value('--like', '*'), wants(2:), cases, key_numbers, known)
      if (paths%cells%count() + cases%cells%count() + key_numbers%cells%count() == 0 .and. line%has('--like')) then
         call fail(error, exit_usage, '--like: no name of '//settings%file//' matches '//quoted(line%value('--like'))// &
            '; * stands for any letters'//suggestion_by_part(line%value('--like'), all_lines(known)))
         return
      end if
      if (line%has('--json')) then
         text = as_json(settings%file, workspace%raw%name, checksum, wants, paths, cases, key_numbers)
      else
         text = as_text(wants, paths, cases, key_numbers)
      end if
      call print_text(text, error)
   end subroutine list_names

   !> Indices of the numbers, sorted by path. The elements of a key (x, y, z; (1), (2), …) stay in their order.
   function sorted_by_path(numbers) result(order)
      type(direction_t), intent(in) :: numbers(:)
      character(200) :: names(size(numbers)), name
      integer :: order(size(numbers)), k, j, this

      do k = 1, size(numbers)
         names(k) = numbers(k)%path
         j = index(names(k), '(')
         if (j == 0 .and. index(names(k), 'point.') == 1) j = index(names(k), '.', back=.true.) + 1
         if (j > 0) names(k) (j:) = ''
      end do
      order = [(k, k=1, size(numbers))]
      do k = 2, size(numbers)          ! some hundred numbers, most in order
         this = order(k)
         name = names(this)
         j = k - 1
         do while (j >= 1)
            if (names(order(j)) <= name) exit
            order(j + 1) = order(j)
            j = j - 1
         end do
         order(j + 1) = this
      end do
   end function sorted_by_path

   !> Paths, values and units of the numbers whose path matches a pattern. `known` receives all paths.
   function path_table(numbers, order, pattern, known) result(table)
      type(direction_t), intent(in) :: numbers(:)
      integer, intent(in) :: order(:)
      character(*), intent(in) :: pattern
      type(message_list_t), intent(inout) :: known
      type(columns_t) :: table
      integer :: k

      table%columns = 3
      do k = 1, size(numbers)
         associate (this => numbers(order(k)))
            call known%add(this%path)
            if (.not. is_like(this%path, pattern)) cycle
            call table%cells%add(this%path)
            call table%cells%add(str(this%value, 15))
            call table%cells%add(this%unit)
         end associate
      end do
   end function path_table

   !> Adds the cases and the key numbers whose names match a pattern: first the cases of the report in its order, then the standard
   !> tests that run on request only.
   subroutine add_names(suspension, own, pattern, wants, cases, key_numbers, known)
      type(suspension_t), intent(in) :: suspension      !! not on a rig
      type(case_t), intent(in) :: own(:)                !! cases of the deck
      character(*), intent(in) :: pattern
      logical, intent(in) :: wants(2)                   !! cases, key numbers
      type(columns_t), intent(inout) :: cases, key_numbers
      type(message_list_t), intent(inout) :: known      !! receives all names
      type(case_t), allocatable :: report(:), all(:)
      type(message_list_t) :: names, units, definitions
      integer :: k

      if (size(suspension%wheels) > 0) then
         call standard_tests(suspension, own, report)
      else
         allocate (report, source=own)
      end if
      if (wants(1)) then
         do k = 1, size(report)
            call add_case(report(k), trim(merge(of_deck//'         ', of_report, has_name(own, report(k)%name))))
         end do
         allocate (all(0))
         if (size(suspension%wheels) > 0) call standard_tests(suspension, own, all, '*')
         do k = 1, size(all)
            if (.not. has_name(report, all(k)%name)) call add_case(all(k), on_request)
         end do
      end if
      if (.not. wants(2)) return
      call list_numbers(suspension, report, names, units, definitions)
      do k = 1, names%count()
         call known%add(names%line(k))
         if (.not. is_like(names%line(k), pattern)) cycle
         call key_numbers%cells%add(names%line(k))
         call key_numbers%cells%add(units%line(k))
         call key_numbers%cells%add(definitions%line(k))
      end do

   contains

      !> Adds name, kind, swept value, range, unit and increments of a case.
      subroutine add_case(given, kind)
         type(case_t), intent(in) :: given
         character(*), intent(in) :: kind
         type(case_t) :: case

         call known%add(given%name)
         if (.not. is_like(given%name, pattern)) return
         call cases%cells%add(given%name)
         call cases%cells%add(kind)
         if (is_mountable(given) .and. given%is_good) then
            call case_on_rig(suspension, given, case)
            call cases%cells%add(case%place_name)
            call cases%cells%add(str(case%from/case%unit, 6)//' to '//str(case%to/case%unit, 6))
            call cases%cells%add(trim(merge(case%unit_name, repeat(' ', len(case%unit_name)), case%unit_name /= '-')))
            call cases%cells%add(str(case%increments))
         else                      ! its table cannot be read, which `check` reports
            call cases%cells%add('')
            call cases%cells%add('')
            call cases%cells%add('')
            call cases%cells%add('')
         end if
      end subroutine add_case

   end subroutine add_names

   !> Whether one of the cases has a name.
   pure logical function has_name(cases, name)
      type(case_t), intent(in) :: cases(:)
      character(*), intent(in) :: name
      integer :: k
      has_name = any([(cases(k)%name == name, k=1, size(cases))])
   end function has_name

   !> The lines of a list as an array.
   function all_lines(list) result(lines)
      type(message_list_t), intent(in) :: list
      character(200), allocatable :: lines(:)
      integer :: k

      allocate (lines(list%count()))
      do k = 1, size(lines)
         lines(k) = list%line(k)
      end do
   end function all_lines

   !> The tables as text. If there are several tables, each has a heading.
   function as_text(wants, paths, cases, key_numbers) result(text)
      logical, intent(in) :: wants(3)
      type(columns_t), intent(in) :: paths, cases, key_numbers
      character(:), allocatable :: text
      type(buffer_t) :: out

      if (wants(1)) call add_table(paths, 'parameters of the deck')
      if (wants(2)) call add_table(cases, 'cases and standard tests')
      if (wants(3)) call add_table(key_numbers, 'K&C metrics')
      text = out%text()

   contains

      !> Adds a table in aligned columns. The last column has no blanks at its end.
      subroutine add_table(table, title)
         type(columns_t), intent(in) :: table
         character(*), intent(in) :: title
         character(:), allocatable :: row, cell
         integer :: width(table%columns), rows, k, c

         rows = table%cells%count()/table%columns
         if (rows == 0) return
         if (count(wants) > 1) then
            if (out%length() > 0) call out%line('')
            call out%line(title)
         end if
         width = 0
         do k = 1, rows
            do c = 1, table%columns
               width(c) = max(width(c), len(cell_of(table, k, c)))
            end do
         end do
         do k = 1, rows
            row = ''
            if (count(wants) > 1) row = space
            do c = 1, table%columns
               cell = cell_of(table, k, c)
               row = row//cell//repeat(' ', width(c) - len(cell))//space
            end do
            call out%line(trim(row))
         end do
      end subroutine add_table

   end function as_text

   !> A cell of a table.
   function cell_of(table, row, column) result(cell)
      type(columns_t), intent(in) :: table
      integer, intent(in) :: row, column
      character(:), allocatable :: cell
      cell = table%cells%line((row - 1)*table%columns + column)
   end function cell_of

   !> The tables as one JSON object, which contains the requested tables only.
   function as_json(file, model, checksum, wants, paths, cases, key_numbers) result(text)
      character(*), intent(in) :: file, model, checksum
      logical, intent(in) :: wants(3)
      type(columns_t), intent(in) :: paths, cases, key_numbers
      character(:), allocatable :: text
      type(json_t) :: json

      call json%begin_record(model, checksum, deck=file)
      if (wants(1)) call add_list('paths', paths, [character(10) :: 'path', 'value', 'unit'])
      if (wants(2)) call add_list('cases', cases, [character(10) :: 'name', 'kind', 'swept', 'range', 'unit', 'increments'])
      if (wants(3)) call add_list('numbers', key_numbers, [character(10) :: 'name', 'unit', 'definition'])
      call json%close('}')
      text = json%text()

   contains

      !> Adds a table as a list of objects. A missing number is null; a range is a list of two numbers.
      subroutine add_list(key, table, names)
         character(*), intent(in) :: key, names(:)
         type(columns_t), intent(in) :: table
         character(:), allocatable :: cell
         integer :: k, c

         call json%open('[', key)
         do k = 1, table%cells%count()/table%columns
            call json%open('{')
            do c = 1, table%columns
               cell = cell_of(table, k, c)
               select case (names(c))
               case ('value', 'increments')
                  if (cell == '') cell = 'null'
                  call json%item(trim(names(c)), cell)
               case ('range')
                  if (cell == '') cell = 'null'
                  if (cell /= 'null') cell = '['//cell(:index(cell, ' to ') - 1)//', '//cell(index(cell, ' to ') + 4:)//']'
                  call json%item('range', cell)
               case default
                  call json%item(trim(names(c)), json_string(as_utf8(cell)))
               end select
            end do
            call json%close('}')
         end do
         call json%close(']')
      end subroutine add_list

   end function as_json

end module ek_list
