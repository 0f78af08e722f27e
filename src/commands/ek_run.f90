!> elastokin run: builds the model of a deck. For each case, solves the sweep and writes the table as CSV and, if requested, the
!> figures.
!> --json: the tables, messages (key `remarks`) and status of a run as one object (schema/run.schema.json).
module ek_run
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: str, quoted, plural
   use ek_file, only: make_folder, base_name, write_standard_output
   use ek_rig_test, only: rig_test, lifts, is_scattered
   use ek_suspension, only: suspension_t, load_number
   use ek_case, only: case_t
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_reader, only: definition_t
   use ek_examination, only: examination_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_with_remarks, add_header
   use ek_compliance_table, only: compliance_table
   use ek_target, only: target_t, find_target
   use ek_table, only: table_t, print_csv, name_length
   use ek_json, only: json_t, json_string, json_strings, json_numbers
   use ek_run_figures, only: figure_t, figure_script, run_figures
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen
   use ek_run_numbers, only: run_numbers, split_names
   use ek_run_columns, only: choose_columns, choose_defined
   use ek_defined_table, only: defined_table
   use ek_definition, only: check_program, label_of_heading
   use ek_definition_rows, only: definitions
   use ek_console, only: print_note, print_error, print_model_remarks, print_remarks, show_progress, clear_progress
   use ek_member_loads, only: load_record_t, begin_loads, add_loads, peak_loads
   use ek_report_names, only: loads_file, peaks_file, files_of_loads
   use ek_outbox, only: outbox_t, outbox_in, keep_first
   use ek_part_record, only: part_record_t, has_names, begin_parts, add_parts
   use ek_part_files, only: put_parts, remove_parts
   use ek_version, only: version
   use ek_remark, only: remark_t
   implicit none(type, external)
   private
   public :: run

   character(*), parameter :: severities(3) = [character(7) :: 'note', 'warning', 'failure']
   character(*), parameter :: outcomes(0:4) = [character(13) :: 'solved', 'partly_solved', 'not_solvable', 'not_mountable', &
      'out_of_memory']                                           ! of ek_case_result

   type, extends(deck_settings_t) :: settings_t
      logical :: has_plots = .false., has_compliance = .false., has_json = .false., has_loads = .false.
      logical :: is_named_only = .false.                    !! only the cases whose states have names
      character(name_length), allocatable :: columns(:)     !! columns of the tables; not allocated: all
      character(:), allocatable :: program                  !! whose definitions the tables have; not allocated: elastokin
      character(name_length), allocatable :: names(:)       !! columns of the program in the tables
   end type settings_t

   character(*), parameter :: compliance_ending = '_compliance.csv'

contains

   !> Runs the chosen cases of a deck. If a case fails part way, its converged states are written, and the other cases are run. If a
   !> case failed, `error` has the code of the first failure other than lack of convergence; without such a failure, the code is
   !> exit_convergence. With --responses, writes key numbers instead.
   subroutine run(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(settings_t) :: settings
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(case_t), allocatable :: chosen(:)
      type(error_t), allocatable :: trouble
      type(outbox_t) :: box
      type(examination_t) :: found
      type(model_remarks_t) :: remarks
      type(json_t) :: json
      type(load_record_t), allocatable :: loads
      type(part_record_t), allocatable :: parts
      character(:), allocatable :: checksum, words
      integer :: k, failed, code

      call read_settings(line, settings, error)
      if (line%has('--responses') .and. .not. allocated(error)) then
         call run_numbers(line, settings, error)
         return
      end if
      if (.not. allocated(error)) call load_deck(settings, definition, workspace, checksum, error)
      if (allocated(error)) return
      call chosen_cases(settings, workspace%raw, workspace%deck_cases, chosen, error)
      if (settings%is_named_only .and. .not. allocated(error)) call keep_named(settings%file, chosen, error)
      if (.not. allocated(error) .and. allocated(settings%program)) then
         call choose_defined(settings%program, settings%names, workspace%raw, chosen, settings%columns, error, '--columns')
      else if (.not. allocated(error) .and. line%has('--columns')) then
         call choose_columns(line%value('--columns'), workspace%raw, chosen, settings%columns, error)
      end if
      if (allocated(error)) return
      if (settings%out == '-' .and. size(chosen) > 1 .and. .not. settings%has_json) then
         call fail(error, exit_usage, '--out - writes one table, but '//settings%file//' has '//str(size(chosen))// &
            ' cases; name one with --case')
         return
      end if
      if (settings%has_compliance) call refuse_double_files(chosen, error)
      if (.not. allocated(error)) call examine_chosen(settings%file, workspace%raw, chosen, found, error)
      if (.not. allocated(error) .and. settings%out /= '-') call make_folder(settings%out, error)
      if (.not. allocated(error)) call balance_or_explain(chosen(1)%tolerance, workspace, error)
      if (allocated(error)) return
      call find_model_remarks(workspace%suspension, workspace%raw, workspace%deck_cases, chosen, .true., remarks)
      call print_model_remarks(settings%is_quiet, remarks)

      failed = 0
      code = exit_convergence
      box = outbox_in(settings%out)
      call json%begin_record(workspace%suspension%name, checksum)
      call json%open('[', 'cases')
      if (settings%has_loads) then
         call box%remove(files_of_loads)
         allocate (loads)
         call begin_loads(workspace%suspension, workspace%suspension%name, checksum, loads, chosen)
         call remove_parts(workspace%suspension, settings%out)
      end if
      if (settings%has_loads .and. has_names(chosen)) then
         allocate (parts)
         call begin_parts(workspace%suspension, workspace%suspension%name, 'elastokin '//version, checksum, parts)
      end if
      do k = 1, size(chosen)
         call run_case(settings, workspace%suspension, chosen(k), found%faults%line(k), checksum, json, loads, parts, box, &
            trouble)
         if (.not. allocated(trouble)) cycle
         failed = failed + 1
         if (code == exit_convergence) code = trouble%code     ! the first other than lack of convergence
         if (trouble%code /= exit_convergence .and. size(chosen) == 1) then
            call move_alloc(trouble, error)
         else
            call print_error(trouble%message)
         end if
      end do
      if (.not. allocated(error) .and. allocated(loads)) then
         call box%put(loads_file, loads%rows%csv())
         call box%put(peaks_file, peak_loads(loads))
         if (allocated(parts)) call put_parts(workspace%suspension, parts, box)
         call box%take(error)
      end if
      words = str(failed)//' of '//plural(size(chosen), 'case', 'cases')
      if (allocated(error)) then
         continue
      else if (failed == 0) then
         call box%finish(error)
      else if (code == exit_convergence) then
         call fail(error, code, words//' did not converge at every state; the converged states were written')
      else
         call fail(error, code, words//' failed (see above); the others were written')
      end if
      if (settings%has_json) call write_run_json(json, merge(code, 0, failed > 0), workspace%suspension%name, box, error)
   end subroutine run

   !> Selects the cases whose states have names: the manoeuvres, and load tables with a column `name`.
   subroutine keep_named(file, chosen, error)
      character(*), intent(in) :: file                        !! the deck, for the message
      type(case_t), allocatable, intent(inout) :: chosen(:)
      type(error_t), allocatable, intent(out) :: error        !! exit_usage: no such case
      integer :: k

      chosen = pack(chosen, [(has_names(chosen(k:k)), k=1, size(chosen))])
      if (size(chosen) == 0) call fail(error, exit_usage, file//': expected a &manoeuvre, or a load table with a column '// &
         '''name'', found neither: add &manoeuvre set = ''durability'' / to the deck, or name a case with --case')
   end subroutine keep_named

   subroutine read_settings(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(out) :: settings
      type(error_t), allocatable, intent(out) :: error        !! options that exclude each other

      call read_deck_settings(line, settings)
      settings%has_plots = line%has('--plot')
      settings%has_compliance = line%has('--compliance')
      settings%has_json = line%has('--json')
      settings%has_loads = line%has('--loads') .or. line%command == 'loads'
      settings%is_named_only = line%command == 'loads' .and. settings%case == ''
      if (settings%has_plots .and. line%has('--columns')) then
         call fail(error, exit_usage, '--plot draws all columns and cannot be used with --columns')
         return
      end if
      if (line%has('--definitions')) call read_program(line, settings, error)
      if (allocated(error)) return
      call refuse_with_responses(line, error)
      if (settings%out /= '-' .or. allocated(error)) return
      if (settings%has_plots) then
         call fail(error, exit_usage, '--plot needs an output folder and cannot be used with --out -')
      else if (settings%has_compliance) then
         call fail(error, exit_usage, '--compliance writes a second file and cannot be used with --out -')
      else if (settings%has_loads) then
         call fail(error, exit_usage, '--loads writes further files and cannot be used with --out -')
      end if
   end subroutine read_settings

   !> Reads --definitions, and the names of its columns.
   subroutine read_program(line, settings, error)
      type(command_line_t), intent(in) :: line
      type(settings_t), intent(inout) :: settings
      type(error_t), allocatable, intent(out) :: error        !! exit_usage

      settings%program = line%value('--definitions')
      call check_program(settings%program, error)
      if (allocated(error)) return
      call split_names(line%value('--columns', '*'), settings%names)
      if (line%has('--plot')) call fail(error, exit_usage, '--plot draws columns of elastokin, and cannot be used with '// &
         '--definitions; run once without it')
   end subroutine read_program

   !> Rejects options about tables and figures where only key numbers are written.
   subroutine refuse_with_responses(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      character(*), parameter :: others(*) = [character(13) :: '--out', '--plot', '--compliance', '--loads', '--columns', &
         '--json', '--definitions']
      integer :: k

      if (.not. line%has('--responses')) then
         if (line%has('--results')) call fail(error, exit_usage, '--results needs --responses: the names of K&C metrics')
         return
      end if
      do k = size(others), 1, -1
         if (line%has(trim(others(k)))) call fail(error, exit_usage, &
            '--responses writes K&C metrics only, and cannot be used with '//trim(others(k))// &
            trim(merge('; name a file for the numbers with --results FILE', &
            '                                                 ', others(k) == '--out')))
      end do
   end subroutine refuse_with_responses

   !> Rejects a case whose table would have the file name of another case's compliance matrix.
   subroutine refuse_double_files(cases, error)
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: k, j

      do k = 1, size(cases)
         do j = 1, size(cases)
            if (cases(j)%name//'.csv' == cases(k)%name//compliance_ending .and. .not. allocated(error)) &
               call fail(error, exit_usage, '--compliance: the compliance matrix of case '//quoted(cases(k)%name)// &
               ' would overwrite the results of case '//quoted(cases(j)%name)//'; rename one, or choose with --case')
         end do
      end do
   end subroutine refuse_double_files

   !> Runs one case: solves the case, prints its messages, and writes its table. If requested, also writes its figures, its
   !> compliance matrix, and the state that meets its target, and adds its loads and its JSON object.
   subroutine run_case(settings, base, wanted, fault, checksum, json, loads, parts, box, error)
      type(settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: wanted
      character(*), intent(in) :: fault                        !! defect of the model in this case; '' for none
      character(*), intent(in) :: checksum
      type(json_t), intent(inout) :: json
      type(load_record_t), allocatable, intent(inout) :: loads   !! loads of all members; allocated if requested
      type(part_record_t), allocatable, intent(inout) :: parts   !! loads on the parts; allocated if requested
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble
      type(solve_options_t) :: options
      class(case_result_t), allocatable :: result
      type(table_t) :: compliance, own            ! table in the columns of elastokin
      integer, allocatable :: rows(:)
      character(:), allocatable :: name

      allocate (result)
      options%fault = fault
      options%checksum = checksum
      if (allocated(settings%columns)) options%columns = settings%columns
      call solve_with_remarks(base, wanted, options, result, error, show_progress)
      if (result%path%states > 1000) call clear_progress()
      call print_remarks(settings%is_quiet, result%remarks)
      if (allocated(settings%program) .and. result%is_run()) then
         own = result%table
         call defined_table(result%suspension, own, settings%program, result%table, rows, names=settings%names)
      end if
      if (settings%has_json) call add_run_json(result, wanted, settings%program, rows, json)
      if (.not. result%is_run()) return
      if (allocated(loads)) call add_loads(result%suspension, result%case, result%path, result%kkt, loads)
      if (allocated(parts)) call add_parts(result%suspension, result%case, result%path, result%kkt, parts)
      name = result%suspension%name//'_'//wanted%name
      if (settings%out == '-') then
         if (.not. settings%has_json) call print_csv(result%table, trouble)
      else
         call box%put(name//'.csv', result%table)
         if (settings%has_plots .and. .not. box%has_failed()) call draw(settings, result, name, box)
         if (settings%has_compliance .and. .not. box%has_failed()) then
            call compliance_table(result%suspension, result%case, result%path, result%kkt, compliance)
            call add_header(compliance, result%suspension, result%case, checksum)
            call box%put(name//compliance_ending, compliance)
         end if
      end if
      if (.not. allocated(trouble)) call box%take(trouble)
      if (allocated(settings%program)) result%table = own
      if (.not. allocated(trouble) .and. len(wanted%target) > 0) &
         call aim(settings, result, checksum, name//'_target.csv', box, trouble)
      call keep_first(trouble, box%undrawn)
      if (.not. allocated(trouble)) return
      if (allocated(error)) trouble%message = error%message//new_line('a')//trouble%message
      call move_alloc(trouble, error)
   end subroutine run_case

   !> Finds the swept value that meets the target of a case, prints a note, and writes the state to a separate file (unless results
   !> go to standard output). The linear methods are excluded, because their states are not equilibria.
   subroutine aim(settings, result, checksum, name, box, error)
      type(settings_t), intent(in) :: settings
      type(case_result_t), intent(inout) :: result
      character(*), intent(in) :: checksum, name
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: error
      type(target_t) :: found
      type(table_t) :: own
      character(:), allocatable :: words

      associate (case => result%case)
         if (case%method /= 'equilibrium') then
            call print_note(settings%is_quiet, 'case '//quoted(case%name)//': a target is solved with method ''equilibrium'' only')
            return
         end if
         call find_target(result%suspension, case, result%path, result%table, result%kkt, found, error)
         if (allocated(error)) return
         if (settings%out /= '-') then
            call add_header(found%table, result%suspension, case, checksum)
            call found%table%header%add('target: '//found%column//' = '//str(found%wanted))
            if (allocated(settings%program)) then
               own = found%table
               call defined_table(result%suspension, own, settings%program, found%table, names=settings%names)
            end if
            call box%put(name, found%table)
            call box%take(error)
            if (allocated(error)) return
         end if
         words = 'case '//quoted(case%name)//': '//found%column//' = '//str(found%wanted)//' at '//case%place_name//' = '// &
            str(found%place/case%unit, 9)//' '//case%unit_name
         if (found%crossings > 1) words = words//' (of '//str(found%crossings)//' solutions the nearest to design)'
         call print_note(settings%is_quiet, words)
      end associate
   end subroutine aim

   !> Draws the figures of a case.
   subroutine draw(settings, result, name, box)
      type(settings_t), intent(in) :: settings
      type(case_result_t), intent(in) :: result
      character(*), intent(in) :: name              !! name of the table without its extension
      type(outbox_t), intent(inout) :: box
      type(figure_t), allocatable :: figures(:)
      character(64), allocatable :: elements(:)
      character(:), allocatable :: model, reason, label
      integer :: k

      associate (suspension => result%suspension, case => result%case)
         allocate (elements(size(suspension%elements) - suspension%scalars))
         do k = 1, size(elements)
            elements(k) = suspension%elements(suspension%scalars + k)%name
         end do
         model = suspension%title
         if (len(model) == 0) model = suspension%name
         label = case%place_name
         if (case%unit_name /= '-') label = label//' ['//case%unit_name//']'
         if (is_vertical(suspension, case)) label = ''      ! over the wheel travel
         call run_figures(result%table, model, case%name, base_name(name//'.csv')//'.csv', figures, label, elements, &
            is_scattered(case%test))
      end associate
      do k = 1, size(figures)
         call box%add_script(figures(k)%name, figure_script(figures(k)))
      end do
      call box%draw(settings%is_quiet, reason)
      if (len(reason) == 0 .and. .not. box%has_failed()) call print_note(settings%is_quiet, 'case '//quoted(result%case%name)// &
         ': '//str(size(figures))//' figures in '//settings%out//' ('//figures(1)%name//'.png …)')
   end subroutine draw

   !> Whether a case mainly moves the wheel vertically, so that its figures are plotted over the wheel travel.
   pure logical function is_vertical(suspension, case)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer :: k

      is_vertical = case%drive == 'wheel_travel' .or. lifts(rig_test(case%test))
      k = load_number(suspension, case%load)
      if (k == 0) return
      is_vertical = abs(suspension%loads(k)%force(3)) >= norm2(suspension%loads(k)%force(1:2)) &
         .and. norm2(suspension%loads(k)%moment) <= 0.0_wp
   end function is_vertical

   !> Adds one case: its outcome, its messages, and its table column by column. A case that was not solved has no columns.
   subroutine add_run_json(result, case, program, rows, json)
      type(case_result_t), intent(in) :: result
      type(case_t), intent(in) :: case             !! case as in the deck
      character(:), allocatable, intent(in) :: program      !! whose definitions the table has; not allocated: elastokin
      integer, allocatable, intent(in) :: rows(:)           !! of each column: its definition, 0 for none; allocated with program
      type(json_t), intent(inout) :: json
      type(message_list_t) :: names
      type(remark_t) :: remark
      integer :: k

      call json%open('{')
      call json%item('name', json_string(case%name))
      call json%item('test', json_string(case%test))
      call json%item('method', json_string(case%method))
      call json%item('solver', json_string(trim(merge('plan  ', 'lapack', case%uses_plan))))
      call json%item('outcome', json_string(trim(outcomes(result%outcome))))
      call json%open('[', 'remarks')
      do k = 1, result%remarks%count()
         remark = result%remarks%item(k)
         call json%open('{')
         call json%item('severity', json_string(trim(severities(remark%severity))))
         call json%item('text', json_string(remark%whole()))
         call json%close('}')
      end do
      call json%close(']')
      if (result%is_run()) then
         if (allocated(result%table%names)) then
            do k = 1, size(result%table%names)
               call names%add(result%table%names(k)%text)
            end do
            call json%item('names', json_strings(names))
         end if
         call json%item('factor_unit', json_string(result%case%unit_name))
         if (allocated(program)) call json%item('definitions', json_string(program))
         call json%open('[', 'columns')
         do k = 1, size(result%table%columns)
            call json%open('{')
            call json%item('name', json_string(trim(result%table%columns(k))))
            call json%item('unit', json_string(label_of_heading(result%table%columns(k))))
            if (allocated(rows)) then
               if (rows(k) > 0) call json%item('formula', json_string(trim(definitions(rows(k))%formula)))
            end if
            call json%item('values', json_numbers(result%table%values(k, :)))
            call json%close('}')
         end do
         call json%close(']')
      end if
      call json%close('}')
   end subroutine add_run_json

   !> Ends the JSON object and writes it.
   subroutine write_run_json(json, status, model, box, error)
      type(json_t), intent(inout) :: json
      integer, intent(in) :: status                                !! exit status of the program
      character(*), intent(in) :: model                            !! name of the model
      type(outbox_t), intent(inout) :: box                         !! its folder: - for standard output
      type(error_t), allocatable, intent(inout) :: error           !! a failure to write; an earlier error is not replaced
      type(error_t), allocatable :: unwritten

      call json%close(']')
      call json%item('status', str(status))
      call json%close('}')
      if (box%folder == '-') then
         call write_standard_output(json%text(), unwritten)
      else
         call box%put(model//'_run.json', json%text())
         call box%take(unwritten)
      end if
      call keep_first(error, unwritten)
   end subroutine write_run_json

end module ek_run
