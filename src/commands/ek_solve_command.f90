!> elastokin solve: finds numbers of a deck for which quantities have given values.
module ek_solve_command
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: str, quoted, suggestion, plural
   use ek_decimal, only: decimal, get_bounded, size_hint
   use ek_buffer, only: buffer_t
   use ek_file, only: make_folder, join_path, write_whole
   use ek_table, only: name_length
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: case_number
   use ek_session, only: session_t
   use ek_parameter, only: choice_t
   use ek_direction, only: direction_t, find_directions, shared_number
   use ek_wanted_number, only: wanted_number_t, find_wanted
   use ek_condition_solver, only: unknown_t, findings_t, solve_conditions
   use ek_solve_text, only: add_findings
   use ek_deck_fragment, only: records_with
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_session
   use ek_console, only: print_path, print_text
   use ek_version, only: version
   implicit none(type, external)
   private
   public :: solve_for

   integer, parameter :: max_sweeps = 40      !! largest number of sweeps; Newton's method needs about five

contains

   !> Finds the numbers of --vary that meet the conditions of --for, and writes these numbers.
   subroutine solve_for(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: not all conditions are met
      type(deck_settings_t) :: settings
      class(session_t), allocatable :: session
      type(unknown_t), allocatable :: unknowns(:)
      type(wanted_number_t), allocatable :: wanted(:)
      real(wp), allocatable :: targets(:)
      type(findings_t) :: found
      type(error_t), allocatable :: fault

      call read_deck_settings(line, settings)
      if (settings%out == '-') then
         call fail(error, exit_usage, 'solve writes a file and cannot be used with --out -')
      else if (.not. line%has('--vary') .or. .not. line%has('--for')) then
         call fail(error, exit_usage, 'solve needs --vary path=low:high, and --for quantity=value')
      end if
      if (allocated(error)) return
      call load_session(settings, session, error)
      if (allocated(error)) return
      call read_unknowns(line%values('--vary'), session, unknowns, error)
      call read_conditions(line, settings, session%workspace, wanted, targets, fault)
      if (allocated(error) .and. allocated(fault)) error%message = error%message//new_line('a')//fault%message
      if (allocated(fault) .and. .not. allocated(error)) call move_alloc(fault, error)
      if (allocated(error)) return
      call solve_conditions(unknowns, wanted, targets, max_sweeps, session%workspace, found, error)
      if (allocated(error)) return
      call write_results(settings, session, unknowns, wanted, targets, found, error)
      if (allocated(error)) return
      if (.not. all(found%is_reached)) call fail(error, exit_convergence, 'not met: '//str(count(.not. found%is_reached))// &
         ' of '//plural(size(targets), 'condition', 'conditions')//'; the numbers that come closest were written')
   end subroutine solve_for

   !> Reads the numbers of --vary with their bounds; reports all errors.
   subroutine read_unknowns(given, session, unknowns, error)
      type(message_list_t), intent(in) :: given
      type(session_t), intent(in) :: session
      type(unknown_t), allocatable, intent(out) :: unknowns(:)
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: fault
      type(direction_t), allocatable :: directions(:)
      type(message_list_t) :: mistakes, path
      type(unknown_t) :: this
      character(:), allocatable :: text, hint
      type(buffer_t) :: names
      logical :: has_low, has_high
      integer :: k, j, equals, colon

      allocate (unknowns(0))
      do k = 1, given%count()
         text = given%line(k)
         equals = index(text, '=')
         colon = equals + index(text(equals + 1:), ':')
         has_low = .false.
         has_high = .false.
         if (equals > 1 .and. colon > equals) then
            call get_bounded(trim(adjustl(text(equals + 1:colon - 1))), this%lower, has_low)
            call get_bounded(trim(adjustl(text(colon + 1:))), this%upper, has_high)
         end if
         if (.not. (has_low .and. has_high)) then
            hint = size_hint(text(equals + 1:max(equals, colon - 1)))
            if (hint == '') hint = size_hint(text(colon + 1:))
            call mistakes%add('--vary '//text//': expected path=low:high, as in point.tie_rod_inner.z=-70:-50'//hint)
            cycle
         end if
         if (.not. this%upper > this%lower) then
            call mistakes%add('--vary '//text//': the upper bound must be above the lower one')
            cycle
         end if
         path = message_list_t()
         call path%add(trim(adjustl(text(:equals - 1))))
         call find_directions(session%workspace%design, session%deck, path, directions, fault)
         if (allocated(fault)) then
            call mistakes%add('--vary '//fault%message)
         else if (size(directions) > 1) then
            names = buffer_t()
            do j = 1, size(directions)
               call names%add(' '//directions(j)%path)
            end do
            call mistakes%add('--vary '//text//': leads to several numbers; give each its own --vary:'//names%text())
         else
            this%direction = directions(1)
            unknowns = [unknowns, this]
         end if
      end do
      do k = 2, size(unknowns)
         do j = 1, k - 1
            text = shared_number(session%workspace%design, unknowns(j)%direction, unknowns(k)%direction)
            if (text /= '') call mistakes%add('--vary: '//text)
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine read_unknowns

   !> Reads the conditions of --for, each [case:]quantity[@swept value]=value; reports all errors.
   subroutine read_conditions(line, settings, workspace, wanted, targets, error)
      type(command_line_t), intent(in) :: line
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), allocatable, intent(out) :: wanted(:)
      real(wp), allocatable, intent(out) :: targets(:)
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: given, mistakes
      type(error_t), allocatable :: fault
      character(:), allocatable :: text, case, place, usual
      real(wp) :: at
      logical :: is_number
      integer :: k, j, c, mark

      usual = line%value('--at', '0')
      place = ''
      given = line%values('--for')
      allocate (wanted(given%count()), targets(given%count()))
      do k = 1, given%count()
         text = given%line(k)
         mark = index(text, '=', back=.true.)
         is_number = .false.
         if (mark > 1) call get_bounded(trim(adjustl(text(mark + 1:))), targets(k), is_number)
         if (.not. is_number) then
            call mistakes%add('--for '//text//': expected quantity=value, case:quantity=value or quantity@swept value=value'// &
               size_hint(text(mark + 1:)))
            cycle
         end if
         text = trim(adjustl(text(:mark - 1)))
         case = settings%case
         mark = index(text, ':')
         if (mark > 0) case = text(:mark - 1)
         text = text(mark + 1:)
         place = usual
         mark = index(text, '@')
         if (mark > 0) then
            place = text(mark + 1:)
            text = trim(text(:mark - 1))
         end if
         call get_bounded(trim(adjustl(place)), at, is_number)
         if (.not. is_number) then
            call mistakes%add(trim(merge('--for', '--at ', mark > 0))//': expected a swept value, found '//quoted(place)// &
               size_hint(place))
            cycle
         end if
         c = case_number(case, workspace)
         if (c == 0) then
            call mistakes%add(unknown_case(case, settings%file, workspace))
            cycle
         end if
         call find_wanted(workspace, c, text, at, wanted(k), fault)
         if (allocated(fault)) call mistakes%add('--for '//fault%message)
         if (allocated(fault)) cycle
         do j = 1, k - 1
            if (.not. allocated(wanted(j)%name)) cycle
            if (wanted(j)%name == text .and. wanted(j)%case == wanted(k)%case .and. abs(wanted(j)%at - at) <= 0.0_wp) &
               call mistakes%add('--for: '//quoted(text)//' is given twice')
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine read_conditions

   !> Message about a case that the deck does not have.
   function unknown_case(name, file, workspace) result(text)
      character(*), intent(in) :: name, file
      type(workspace_t), intent(in) :: workspace
      character(:), allocatable :: text
      character(name_length) :: names(size(workspace%cases))
      integer :: j

      do j = 1, size(names)
         names(j) = workspace%cases(j)%case%name
      end do
      text = 'no case '//quoted(name)//' in '//file//', and no standard test of this name'//suggestion(name, names)
      if (size(names) == 0) text = file//': no &case group and no wheel, so there is no case to solve'
   end function unknown_case

   !> Writes the solution as a file of settings, and prints the findings.
   subroutine write_results(settings, session, unknowns, wanted, targets, found, error)
      type(deck_settings_t), intent(in) :: settings
      type(session_t), intent(in) :: session
      type(unknown_t), intent(in) :: unknowns(:)
      type(wanted_number_t), intent(in) :: wanted(:)
      real(wp), intent(in) :: targets(:)
      type(findings_t), intent(in) :: found
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: unprinted
      type(choice_t), allocatable :: changed(:)
      type(buffer_t) :: text, file
      character(:), allocatable :: path
      integer :: j

      allocate (changed(0))
      call add_findings(session%workspace, unknowns, wanted, targets, found, text)
      call file%line('# elastokin '//version//' solve: numbers of '//session%workspace%raw%name//' for --set-file')
      do j = 1, size(targets)
         call file%line('# '//wanted(j)%name//' = '//str(found%after(j), 9)//', wanted '//str(targets(j), 9))
      end do
      do j = 1, size(unknowns)
         call file%line(unknowns(j)%direction%path//' = '//decimal(found%x(j)))
         changed = [changed, unknowns(j)%direction%found]
      end do
      call text%line('as records of the deck:')
      call text%line(records_with(session%workspace%design, session%workspace%x, changed))
      path = join_path(settings%out, session%workspace%raw%name//'_solve.set')
      call make_folder(settings%out, error)
      if (.not. allocated(error)) call write_whole(path, file%text(), error)
      if (allocated(error)) return
      call print_path(path, unprinted)
      if (allocated(unprinted)) call move_alloc(unprinted, error)
      if (.not. allocated(error)) call print_text(text%text(), error)
   end subroutine write_results

end module ek_solve_command
