!> elastokin explain: contributions of each element, joint and load to each compliance, at every state.
!>
!> The printed output: the largest contributions to each column with bars, the value of each column with rigid
!> elements, and the change of each column by an added spring.
module ek_explain
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: str, quoted, suggestion, is_like, plural
   use ek_decimal, only: get_bounded, size_hint
   use ek_buffer, only: buffer_t
   use ek_file, only: make_folder, join_path
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_case, only: case_t
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_reader, only: definition_t
   use ek_examination, only: examination_t
   use ek_schedule, only: new_schedule
   use ek_path_states, only: nearest_state, nearest_reached
   use ek_case_result, only: case_result_t, solve_options_t, solve_with_remarks
   use ek_contribution_table, only: contribution_table_t, start_contributions, choose_contributions, find_contributions, &
      key_compliances
   use ek_explain_files, only: explain_files_t, begin_explain_files, add_explain_state, end_explain_files, &
      begin_explain_case, end_explain_case, end_explain_json
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen, spare_results
   use ek_run_numbers, only: split_names
   use ek_table, only: name_length
   use ek_version, only: version
   use ek_outbox, only: outbox_t, outbox_in
   use ek_console, only: print_text, print_error, print_model_remarks, print_remarks, show_progress
   use ek_quantity, only: unit_of, unit_text
   use ek_element, only: element_t
   use ek_element_part, only: is_part_of_angle
   use ek_kkt, only: kkt_t
   use ek_linear_columns, only: fill_changed_columns
   use ek_what_if, only: find_self_moves, changed_compliance, rigid_compliance
   use ek_largest, only: largest
   implicit none(type, external)
   private
   public :: explain

   integer, parameter :: shown = 10            !! largest number of rows per column
   integer, parameter :: longest_bar = 30      !! length of the longest bar [letters]
   real(wp), parameter :: added_rate = 1.0e6_wp      !! rate of the added spring [N/m]: 1 kN/mm

   type, extends(deck_settings_t) :: settings_t
      character(name_length), allocatable :: columns(:)     !! names or patterns of columns
      type(message_list_t) :: rigid                         !! names of elements, or element.part
      logical :: has_scan = .false., has_json = .false., has_place = .false.
      real(wp) :: place = 0.0_wp                            !! swept value of --at, in the unit of the case
   end type settings_t

contains

   !> Explains the chosen cases of a deck. `error` is the error of the last case that failed.
   subroutine explain(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(settings_t) :: settings
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(case_t), allocatable :: chosen(:)
      type(examination_t) :: found
      type(model_remarks_t) :: remarks
      type(explain_files_t) :: files
      type(error_t), allocatable :: trouble
      type(outbox_t) :: box
      character(:), allocatable :: checksum
      integer :: k

      call read_settings(line, settings, error)
      if (.not. allocated(error)) call load_deck(settings, definition, workspace, checksum, error)
      if (.not. allocated(error)) call chosen_cases(settings, workspace%raw, workspace%deck_cases, chosen, error)
      if (allocated(error)) return
      do k = 1, size(chosen)
         call spare_results(chosen(k)%name//'_contributions', workspace%deck_cases, error)
         call spare_results(chosen(k)%name//'_load_paths', workspace%deck_cases, error)
      end do
      if (.not. allocated(error)) call examine_chosen(settings%file, workspace%raw, chosen, found, error)
      if (.not. allocated(error)) call make_folder(settings%out, error)
      if (.not. allocated(error)) call balance_or_explain(chosen(1)%tolerance, workspace, error)
      if (allocated(error)) return
      call find_model_remarks(workspace%suspension, workspace%raw, workspace%deck_cases, chosen, .true., remarks)
      call print_model_remarks(settings%is_quiet, remarks)
      box = outbox_in(settings%out)
      files%has_json = settings%has_json
      if (files%has_json) then
         call files%json%begin_record(workspace%suspension%name, checksum)
         call files%json%open('[', 'cases')
      end if
      do k = 1, size(chosen)
         call explain_case(settings, workspace%suspension, chosen(k), found%faults%line(k), checksum, files, box, trouble)
         if (.not. allocated(trouble)) cycle
         if (allocated(error)) call print_error(error%message)
         call move_alloc(trouble, error)
         if (error%code == exit_usage) return
      end do
      if (files%has_json) then
         call end_explain_json(files%json)
         call box%put(workspace%suspension%name//'_contributions.json', files%json%text())
      end if
      call box%finish(error)
   end subroutine explain

   subroutine read_settings(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(out) :: settings
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: place

      call read_deck_settings(line, settings)
      if (line%has('--of')) then
         call split_names(line%value('--of'), settings%columns)
      else
         settings%columns = key_compliances
      end if
      settings%rigid = line%values('--rigid')
      settings%has_scan = line%has('--scan')
      settings%has_json = line%has('--json')
      settings%has_place = line%has('--at')
      if (settings%out == '-') call fail(error, exit_usage, 'explain writes several files and cannot be used with --out -')
      if (.not. settings%has_place .or. allocated(error)) return
      place = line%value('--at')
      call get_bounded(place, settings%place, settings%has_place)
      if (.not. settings%has_place) call fail(error, exit_usage, '--at: expected a swept value, found '//quoted(place)// &
         size_hint(place))
   end subroutine read_settings

   !> Explains one case: solves the case, splits its compliances, and writes and prints the contributions.
   subroutine explain_case(settings, base, wanted, fault, checksum, files, box, error)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: wanted
      character(*), intent(in) :: fault, checksum
      type(explain_files_t), intent(inout) :: files
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble
      type(solve_options_t) :: options
      class(case_result_t), allocatable :: result
      type(contribution_table_t) :: table
      integer, allocatable :: laws(:)
      character(:), allocatable :: name
      integer :: k, printed

      allocate (result)
      options%fault = fault
      allocate (options%columns(0))
      call solve_with_remarks(base, wanted, options, result, error, show_progress)
      call print_remarks(settings%is_quiet, result%remarks)
      if (.not. result%is_run()) return
      call find_printed(settings, result, printed, error)
      if (settings%has_place .and. printed == 0) return
      associate (suspension => result%suspension, case => result%case, path => result%path)
         call start_contributions(suspension, table)
         call take_columns(settings%columns, table, trouble)
         do k = 1, settings%rigid%count()
            if (.not. allocated(trouble)) call find_laws(settings%rigid%line(k), table, laws, trouble)
         end do
         name = suspension%name//'_'//wanted%name
         if (.not. allocated(trouble)) call begin_explain_files(join_path(settings%out, name), wanted%name, 'model '// &
            suspension%name//', case '//wanted%name//', elastokin '//version//', deck checksum '//checksum, files, trouble)
         if (.not. allocated(trouble)) then
            if (files%has_json) call begin_explain_case(wanted%name, case%unit_name, table, files%json)
            do k = 1, path%states
               if (.not. path%is_reached(k) .or. (settings%has_place .and. k /= printed)) cycle
               call find_contributions(suspension, new_schedule(suspension, case), path, k, result%kkt, table)
               if (table%is_known) call add_explain_state(suspension, k - 1, path%value(k)/case%unit, table, files)
            end do
            if (files%has_json) call end_explain_case(files%json)
            call end_explain_files(files, trouble)
         end if
         if (.not. allocated(trouble)) call box%announce(name//'_contributions.csv')
         if (.not. allocated(trouble)) call box%announce(name//'_load_paths.csv')
         if (.not. allocated(trouble) .and. printed > 0) call print_state(settings, result, printed, table, trouble)
      end associate
      if (allocated(trouble)) call move_alloc(trouble, error)
   end subroutine explain_case

   !> Restricts the table to the columns that match names or patterns.
   subroutine take_columns(names, table, error)
      character(name_length), intent(in) :: names(:)
      type(contribution_table_t), intent(inout) :: table
      type(error_t), allocatable, intent(out) :: error       !! exit_usage: all names that match no column
      logical, allocatable :: is_wanted(:), is_this(:)
      type(message_list_t) :: mistakes
      integer :: k, j

      allocate (is_wanted(table%columns%used), is_this(table%columns%used), source=.false.)
      do k = 1, size(names)
         do j = 1, size(is_this)
            is_this(j) = is_like(trim(table%columns%names(j)), trim(names(k)))
         end do
         is_wanted = is_wanted .or. is_this
         if (any(is_this) .or. any(key_compliances == names(k))) cycle
         call mistakes%add('--of: '//quoted(trim(names(k)))//' is not a compliance column'// &
            suggestion(trim(names(k)), table%columns%names))
      end do
      if (mistakes%count() == 0 .and. .not. any(is_wanted)) call mistakes%add('--of: the model has none of these columns')
      if (mistakes%count() > 0) then
         call fail(error, exit_usage, mistakes%text())
      else
         call choose_contributions(is_wanted, table)
      end if
   end subroutine take_columns

   !> Finds the state that is printed: the state nearest to --at, or the reached state nearest to design. A swept value outside the
   !> range of the case is an error, as is a state of --at that was not reached, for another state would be explained.
   subroutine find_printed(settings, result, printed, error)
      type(settings_t), intent(in) :: settings
      type(case_result_t), intent(in) :: result              !! is_run
      integer, intent(out) :: printed                        !! index of the state; 0: none
      type(error_t), allocatable, intent(inout) :: error     !! exit_usage; exit_convergence: added to the error of the case
      character(:), allocatable :: words
      real(wp) :: low, high
      integer :: near

      associate (path => result%path, case => result%case, place => settings%place)
         printed = nearest_reached(path, place*case%unit)
         if (.not. settings%has_place) return
         low = min(case%from, case%to)/case%unit
         high = max(case%from, case%to)/case%unit
         if (place < low - 1.0e-9_wp*(high - low) .or. place > high + 1.0e-9_wp*(high - low)) then
            printed = 0
            call fail(error, exit_usage, '--at: case '//quoted(case%name)//' goes from '//str(low)//' to '//str(high)//' '// &
               case%unit_name//', found '//str(place))
            return
         end if
         near = nearest_state(path, place*case%unit)
         if (path%is_reached(near)) return
         words = '--at: case '//quoted(case%name)//' did not reach the state at '//str(path%value(near)/case%unit)//' '// &
            case%unit_name//', so nothing is explained'
         if (printed > 0) words = words//'; the nearest state that was reached is at '// &
            str(path%value(printed)/case%unit)//' '//case%unit_name
         printed = 0
      end associate
      if (allocated(error)) words = error%message//new_line('a')//words
      call fail(error, exit_convergence, words)
   end subroutine find_printed

   !> Prints one state: the largest contributions, and the answers to --rigid and --scan.
   subroutine print_state(settings, result, k, table, error)
      type(settings_t), intent(in) :: settings
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: k
      type(contribution_table_t), intent(inout) :: table
      type(error_t), allocatable, intent(out) :: error
      type(buffer_t) :: text
      integer, allocatable :: laws(:)
      integer :: r

      associate (suspension => result%suspension, case => result%case, path => result%path)
         call find_contributions(suspension, new_schedule(suspension, case), path, k, result%kkt, table)
         call text%line('case '//quoted(case%name)//', '//case%place_name//' = '//str(path%value(k)/case%unit, 9)//' '// &
            case%unit_name//':')
         if (table%is_known) then
            call add_largest(table, text)
            do r = 1, settings%rigid%count()
               call find_laws(settings%rigid%line(r), table, laws, error)
               if (allocated(error)) return
               call add_rigid(suspension, settings%rigid%line(r), laws, result%kkt, table, text)
            end do
            if (settings%has_scan) call add_scan(suspension, result%kkt, table, text)
         else
            call text%line(trim(merge('  no spring carries the wheels: no contributions ', &
               '  the compliance matrix is singular at this state', .not. has_rates(suspension))))
         end if
      end associate
      call print_text(text%text(), error)
   end subroutine print_state

   !> Finds all laws of an element, or the law named `element.part`.
   subroutine find_laws(name, table, laws, error)
      character(*), intent(in) :: name
      type(contribution_table_t), intent(in) :: table
      integer, allocatable, intent(out) :: laws(:)
      type(error_t), allocatable, intent(out) :: error       !! exit_usage
      character(name_length), allocatable :: known(:)
      logical, allocatable :: is_this(:)
      integer :: k

      allocate (is_this(size(table%shares%law)), known(size(table%shares%law)))
      do k = 1, size(is_this)
         associate (row => table%row(table%shares%law(k)))
            known(k) = row%row
            is_this(k) = row%row == name .or. trim(row%row)//'.'//trim(row%part) == name
         end associate
      end do
      laws = pack([(k, k=1, size(is_this))], is_this)
      if (size(laws) > 0) return
      call fail(error, exit_usage, '--rigid: expected an element, or one axis of a bushing (element.x to element.rz), found '// &
         quoted(name)//suggestion(name, known))
   end subroutine find_laws

   !> Adds the largest contributions to each requested column, and the sum of the others.
   subroutine add_largest(table, text)
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      integer, allocatable :: order(:)
      real(wp) :: rest
      integer :: c, k

      do c = 1, size(table%values)
         call text%line(heading(table, c)//' = '//number(table%values(c))//' '//unit(table, c))
         call largest(table%parts(c, :), shown, order)
         rest = table%values(c) - sum(table%parts(c, order))
         do k = 1, size(order)
            associate (row => table%row(order(k)))
               call add_bar(trim(row%row)//'.'//trim(row%part), table%parts(c, order(k)), table%values(c), &
                  maxval(abs(table%parts(c, :))), text)
            end associate
         end do
         if (size(order) < count(abs(table%parts(c, :)) > 0.0_wp)) call add_bar('rest', rest, table%values(c), &
            maxval(abs(table%parts(c, :))), text)
      end do
   end subroutine add_largest

   !> Adds a line with name, value, share and bar.
   subroutine add_bar(name, value, whole, most, text)
      character(*), intent(in) :: name
      real(wp), intent(in) :: value, whole, most
      type(buffer_t), intent(inout) :: text
      character(8) :: percent
      integer :: letters

      percent = ''
      if (abs(whole) > 0.0_wp) write (percent, '(f7.1,a)') 100.0_wp*value/whole, '%'
      letters = 0
      if (most > 0.0_wp) letters = min(nint(longest_bar*abs(value)/most), longest_bar)
      call text%line('  '//padded(name)//number(value)//percent//repeat(' ', merge(2, 0, letters > 0))// &
         repeat(merge('+', '-', value > 0.0_wp), letters))
   end subroutine add_bar

   !> Adds the value of each requested column, and the value of the same column with some laws rigid.
   subroutine add_rigid(suspension, name, laws, kkt, table, text)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name                 !! name of the rigid element or axis
      integer, intent(in) :: laws(:)
      type(kkt_t), intent(inout) :: kkt                !! system with the factors of the state
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      real(wp), allocatable :: self_move(:, :), c(:, :)
      real(wp) :: values(size(table%values))
      integer :: k, n

      n = 6*table%columns%kandc%compliance%wheels
      call find_self_moves(laws, kkt, table%columns%kandc%compliance, table%shares, self_move)
      c = rigid_compliance(table%columns%kandc%compliance%response(:n, :n), table%shares%left_move(:, laws), &
         table%shares%move(:, laws), self_move)
      call fill_changed_columns(suspension, c, table%columns, values)
      call text%line('with '//name//' rigid, at this state:')
      do k = 1, size(values)
         call text%line('  '//padded(heading(table, k))//number(table%values(k))//'  ->'//number(values(k))//' '//unit(table, k))
      end do
   end subroutine add_rigid

   !> Adds the ten locations at which an added spring of 1 kN/mm changes a column most. The locations are along axes of bushings and
   !> parallel to springs.
   subroutine add_scan(suspension, kkt, table, text)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt                !! system with the factors of the state
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      real(wp), allocatable :: self_move(:, :), c(:, :)
      real(wp) :: change(size(table%values), size(table%shares%law)), values(size(table%values))
      integer, allocatable :: order(:)
      logical :: is_known
      integer :: k, law, n

      n = 6*table%columns%kandc%compliance%wheels
      change = 0.0_wp
      do law = 1, size(table%shares%law)
         associate (share => table%shares%share(table%shares%law(law)))
            if (is_part_of_angle(suspension%elements(share%item), share%part)) cycle
         end associate
         call find_self_moves([law], kkt, table%columns%kandc%compliance, table%shares, self_move)
         call changed_compliance(table%columns%kandc%compliance%response(:n, :n), table%shares%left_move(:, [law]), &
            table%shares%move(:, [law]), self_move, [added_rate], c, is_known)
         if (.not. is_known) cycle
         call fill_changed_columns(suspension, c, table%columns, values)
         change(:, law) = values - table%values
      end do
      do k = 1, size(values)
         call text%line('effect of +1 kN/mm on '//heading(table, k)//' (now '//number(table%values(k))//' '//unit(table, k)//'):')
         call largest(change(k, :), shown, order)
         do law = 1, size(order)
            associate (row => table%row(table%shares%law(order(law))))
               call add_bar(trim(row%row)//'.'//trim(row%part), change(k, order(law)), table%values(k), maxval(abs(change(k, :))), &
                  text)
            end associate
         end do
      end do
   end subroutine add_scan

   pure function heading(table, c) result(name)
      type(contribution_table_t), intent(in) :: table
      integer, intent(in) :: c
      character(:), allocatable :: name
      name = trim(table%columns%names(table%columns%asked(c)))
   end function heading

   pure function unit(table, c) result(text)
      type(contribution_table_t), intent(in) :: table
      integer, intent(in) :: c
      character(:), allocatable :: text
      text = unit_text(unit_of(heading(table, c)))
   end function unit

   !> A name, padded with blanks to the width of its column.
   pure function padded(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      integer, parameter :: width = 32
      text = name//repeat(' ', max(width - len(name), 1))
   end function padded

   !> A number with seven digits after the point.
   function number(value) result(text)
      real(wp), intent(in) :: value
      character(14) :: text
      write (text, '(f14.7)') value
   end function number

end module ek_explain
