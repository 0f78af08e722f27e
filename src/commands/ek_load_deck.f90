!> Reads a deck with the settings of a command and builds its model: the first step of each command with a deck.
module ek_load_deck
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_deck, exit_model
   use ek_text, only: str, quoted, suggestion
   use ek_deck, only: deck_t, read_deck, set_value, declare_path, deck_checksum
   use ek_reader, only: definition_t
   use ek_setting, only: split_setting
   use ek_set_file, only: set_file_t, read_set_file, apply_set_file, show_set_file, setting_count, get_setting
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_model
   use ek_session, only: session_t, take_deck
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_standard_tests, only: standard_tests
   use ek_case, only: case_t, method_names, solver_names, max_increments
   use ek_command_line, only: command_line_t
   use ek_examination, only: examination_t, examine_cases
   use ek_run_log, only: is_logging, log_deck, log_message
   use ek_setting_log, only: applied_t, add_applied, overridden_settings
   implicit none(type, external)
   private
   public :: deck_settings_t, read_deck_settings, settings_of, load_deck, load_session, read_changed, chosen_cases, &
      examine_chosen, spare_results

   !> Options of a command with a deck. A command extends the type by its own settings. An option that the command does not accept
   !> has the value of an option that is not given.
   type :: deck_settings_t
      character(:), allocatable :: file          !! path of the deck; '-' is standard input
      character(:), allocatable :: case          !! name of the case; '' for all cases
      character(:), allocatable :: method        !! method of the cases; '': as in the deck
      character(:), allocatable :: solver        !! solver of the cases; '': as in the deck
      character(:), allocatable :: out           !! output folder, or - for standard output
      integer :: increments = 0                  !! increments of the cases; 0: as in the deck
      logical :: is_quiet = .false.
      type(message_list_t) :: changes            !! settings of --set: path=value
      type(message_list_t) :: paths              !! paths of numbers that the command will vary
      type(message_list_t) :: set_files          !! files of --set-file: settings applied before the settings of --set
   end type deck_settings_t

contains

   !> Reads the options that all commands with a deck share.
   subroutine read_deck_settings(line, settings)
      type(command_line_t), intent(in) :: line
      class(deck_settings_t), intent(inout) :: settings

      settings%file = line%files%line(1)
      settings%case = line%value('--case')
      settings%method = line%value('--method')
      settings%solver = line%value('--solver')
      settings%out = line%value('--out', 'out')
      settings%increments = line%number('--increments')
      settings%is_quiet = line%has('--quiet')
      settings%changes = settings_of(line)
      settings%set_files = line%values('--set-file')
   end subroutine read_deck_settings

   !> The settings of a command line: --set, then the start state of --height and --state as settings of &model.
   type(message_list_t) function settings_of(line) result(settings)
      type(command_line_t), intent(in) :: line
      character(:), allocatable :: height

      settings = line%values('--set')
      if (line%has('--state')) call settings%add('model.state='//line%value('--state'))
      if (.not. line%has('--height')) return
      height = line%value('--height')
      if (height(1:min(1, len(height))) == '+') height = height(2:)      ! in a setting, + adds to the number of the deck
      call settings%add('model.start_height='//height)
   end function settings_of

   !> Reads a deck, applies --set-file and --set, builds the model, and checks the tables and targets of its cases. All errors in
   !> the deck are reported together.
   subroutine load_deck(settings, definition, workspace, checksum, error, needs_tables, used_deck)
      class(deck_settings_t), intent(in) :: settings
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the workspace and its copies
      class(workspace_t), allocatable, intent(out) :: workspace      !! without cases: the command chooses cases of the design
      character(:), allocatable, intent(out), optional :: checksum     !! checksum of the deck as it was used
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: needs_tables          !! if .true., a missing table is an error, also of a case not run
      type(deck_t), intent(out), optional :: used_deck       !! deck with the settings applied
      type(deck_t) :: deck
      type(set_file_t), allocatable :: files(:)
      type(error_t), allocatable :: unset

      allocate (workspace)
      call read_set_deck(settings, deck, files, unset, error)
      if (allocated(error)) return
      call open_model(deck, definition, workspace, error, needs_tables)
      call add_unset(files, unset, error)
      if (allocated(error)) return
      if (present(checksum)) checksum = deck_checksum(deck)
      if (present(used_deck)) used_deck = deck
   end subroutine load_deck

   !> Opens a deck as a session, with --set-file and --set applied. (load_deck returns a model instead.)
   subroutine load_session(settings, session, error)
      class(deck_settings_t), intent(in) :: settings
      class(session_t), allocatable, intent(out) :: session
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(set_file_t), allocatable :: files(:)
      type(error_t), allocatable :: unset

      allocate (session)
      call read_set_deck(settings, deck, files, unset, error)
      if (allocated(error)) return
      call take_deck(deck, session, error)
      call add_unset(files, unset, error)
   end subroutine load_session

   !> Reads the deck and applies --set-file and --set.
   subroutine read_set_deck(settings, deck, files, unset, error)
      class(deck_settings_t), intent(in) :: settings
      type(deck_t), intent(out) :: deck
      type(set_file_t), allocatable, intent(out) :: files(:)
      type(error_t), allocatable, intent(out) :: unset       !! errors of settings; the other settings may contain errors too
      type(error_t), allocatable, intent(out) :: error
      integer :: k

      allocate (files(settings%set_files%count()))
      do k = 1, size(files)
         if (.not. allocated(error)) call read_set_file(settings%set_files%line(k), files(k), error)
      end do
      if (.not. allocated(error)) call read_changed(settings%file, settings%changes, deck, error, files)
      do k = 1, settings%paths%count()
         if (.not. allocated(error)) call declare_path(deck, settings%paths%line(k), settings%file, error)
      end do
      if (.not. allocated(error)) return
      if (size(files) > 0 .and. error%code == exit_deck .and. deck%deck_errors%count() == 0) call move_alloc(error, unset)
   end subroutine read_set_deck

   !> Adds the errors in settings to the errors of the deck, each with its line in the file of settings.
   subroutine add_unset(files, unset, error)
      type(set_file_t), intent(in) :: files(:)
      type(error_t), allocatable, intent(inout) :: unset, error
      integer :: k

      if (allocated(unset)) then
         if (allocated(error)) unset%message = unset%message//new_line('a')//error%message
         call move_alloc(unset, error)
      end if
      do k = 1, size(files)
         if (allocated(error)) call show_set_file(files(k), error%message)
      end do
   end subroutine add_unset

   !> Reads a deck and applies files of settings, then --set path=value, in the order given. All errors of a file are reported.
   subroutine read_changed(file, changes, deck, error, set_files)
      character(*), intent(in) :: file
      type(message_list_t), intent(in) :: changes
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error
      type(set_file_t), intent(in), optional :: set_files(:)
      character(:), allocatable :: path, value
      integer :: k

      call read_deck(file, deck, error)
      if (present(set_files)) then
         do k = 1, size(set_files)
            if (.not. allocated(error)) call apply_set_file(set_files(k), deck, error)
         end do
         if (allocated(error)) return
      end if
      do k = 1, changes%count()
         if (.not. allocated(error)) call split_setting(changes%line(k), path, value, error)
         if (.not. allocated(error)) call set_value(deck, path, value, error)
      end do
      if (.not. is_logging() .or. allocated(error)) return
      call log_deck(file, deck_checksum(deck))
      call log_settings(changes, deck, set_files)
   end subroutine read_changed

   !> Logs where one setting overrides another.
   subroutine log_settings(changes, deck, set_files)
      type(message_list_t), intent(in) :: changes
      type(deck_t), intent(in) :: deck                       !! deck with all settings
      type(set_file_t), intent(in), optional :: set_files(:)
      type(applied_t) :: applied
      type(message_list_t) :: messages
      type(error_t), allocatable :: error
      character(:), allocatable :: path, value, where
      integer :: k, j

      if (present(set_files)) then
         do k = 1, size(set_files)
            do j = 1, setting_count(set_files(k))
               call get_setting(set_files(k), j, path, value, where)
               call add_applied(applied, where, path, value)
            end do
         end do
      end if
      do k = 1, changes%count()
         call split_setting(changes%line(k), path, value, error)
         if (.not. allocated(error)) call add_applied(applied, '--set', path, value)
      end do
      call overridden_settings(applied, deck, messages)
      do k = 1, messages%count()
         call log_message(messages%line(k))
      end do
   end subroutine log_settings

   !> Lists the cases to run, with --case, --method, --solver and --increments applied. --case may also name a standard test that the
   !> deck does not define.
   subroutine chosen_cases(settings, suspension, cases, chosen, error)
      class(deck_settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(case_t), allocatable, intent(out) :: chosen(:)
      type(error_t), allocatable, intent(out) :: error
      type(case_t), allocatable :: tests(:)
      character(64), allocatable :: names(:), known(:)
      character(:), allocatable :: hint
      integer :: k

      allocate (chosen(0), names(0), known(0))
      do k = 1, size(cases)
         names = [character(64) :: names, cases(k)%name]
         if (len(settings%case) == 0 .or. settings%case == cases(k)%name) chosen = [chosen, cases(k)]
      end do
      known = names
      if (size(chosen) == 0 .and. len(settings%case) > 0 .and. size(suspension%wheels) > 0) then
         call standard_tests(suspension, cases, tests, settings%case)
         do k = 1, size(tests)
            known = [character(64) :: known, tests(k)%name]
            if (tests(k)%name == settings%case) chosen = [chosen, tests(k)]
         end do
      end if
      if (size(known) == 0) then
         call fail(error, exit_usage, settings%file//': no &case group, so there is no case to run (check works without one)')
      else if (size(chosen) == 0) then
         hint = suggestion(settings%case, known)//'; it has'
         do k = 1, size(names)
            hint = hint//' '//quoted(names(k))
         end do
         if (size(names) == 0) hint = hint//' no case'
         if (size(known) > size(names)) hint = hint//', and the standard tests'
         if (.not. has_rates(suspension)) hint = hint//' of travel, roll and steering, as no spring carries the wheels'
         call fail(error, exit_usage, '--case: no case '//quoted(settings%case)//' in '//settings%file//hint)
      else if (settings%method /= '' .and. .not. any(method_names == settings%method)) then
         call fail(error, exit_usage, '--method: expected recursive, corrected or equilibrium, found '//quoted(settings%method))
      else if (settings%solver /= '' .and. .not. any(solver_names == settings%solver)) then
         call fail(error, exit_usage, '--solver: expected lapack or sparse, found '//quoted(settings%solver))
      else if (settings%increments > max_increments) then
         call fail(error, exit_usage, '--increments: expected 1 to '//str(max_increments)//', found '//str(settings%increments))
      end if
      if (allocated(error)) return
      do k = 1, size(chosen)
         if (chosen(k)%follows_arc .and. settings%method /= '' .and. settings%method /= 'equilibrium') then
            call fail(error, exit_usage, '--method: case '//quoted(chosen(k)%name)//' has follow = ''arc'', which requires '// &
               'method equilibrium, found '//quoted(settings%method))
            return
         end if
         if (settings%method /= '') chosen(k)%method = settings%method
         if (.not. chosen(k)%says_solver) chosen(k)%uses_plan = .false.      ! also where a session prefers the plan
         if (settings%solver /= '') then
            chosen(k)%uses_plan = settings%solver /= 'lapack'
            chosen(k)%says_solver = .true.
         end if
         if (settings%increments > 0) chosen(k)%increments = settings%increments
      end do
   end subroutine chosen_cases

   !> Rejects an output file <model>_<stem>.csv of a command other than `run` if it would overwrite the results of a case.
   subroutine spare_results(stem, cases, error)
      character(*), intent(in) :: stem                  !! file name, without the model and the extension
      type(case_t), intent(in) :: cases(:)              !! cases of the deck; `run` writes <model>_<case>.csv
      type(error_t), allocatable, intent(inout) :: error      !! exit_usage; an error that exists is left unchanged
      integer :: k

      if (allocated(error)) return
      do k = 1, size(cases)
         if (cases(k)%name == stem) call fail(error, exit_usage, 'the file of this command would overwrite the results of case '// &
            quoted(cases(k)%name)//'; rename this case')
      end do
   end subroutine spare_results

   !> Examines the cases to run. If no case can be solved, returns an error that lists each defect once.
   subroutine examine_chosen(file, suspension, chosen, found, error)
      character(*), intent(in) :: file                  !! the deck, for messages
      type(suspension_t), intent(in) :: suspension      !! model before the preload trim
      type(case_t), intent(in) :: chosen(:)
      type(examination_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error  !! exit_model

      call examine_cases(suspension, chosen, found)
      if (size(chosen) == 0 .or. any(found%is_solvable)) return
      if (size(chosen) == 1) then
         call fail(error, exit_model, found%faults%line(1))
      else
         call fail(error, exit_model, file//': the model cannot be solved'//new_line('a')//found%distinct%text())
      end if
   end subroutine examine_chosen

end module ek_load_deck
