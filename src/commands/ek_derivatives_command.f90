!> elastokin derivatives: derivatives of the columns of a case with respect to the numbers of the deck; with --definitions, of the
!> columns of another program.
module ek_derivatives_command
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_model
   use ek_noise, only: is_flat
   use ek_text, only: str, quoted, plural, suggestion
   use ek_frame, only: frame_t, new_frame
   use ek_buffer, only: buffer_t
   use ek_decimal, only: get_bounded, size_hint
   use ek_file, only: make_folder, join_path, write_standard_output
   use ek_writer, only: writer_t, begin_file
   use ek_system, only: ask_memory
   use ek_case, only: case_t
   use ek_case_result, only: solve_options_t, add_remarks, failure_of
   use ek_path_states, only: nearest_state
   use ek_compliance_table, only: compliance_columns
   use ek_table, only: name_length
   use ek_workspace, only: workspace_t, solve_or_explain
   use ek_session, only: session_t
   use ek_direction, only: direction_t, all_directions, find_directions, refuse_shared
   use ek_quantity, only: unit_of
   use ek_definition, only: check_program
   use ek_defined_column, only: defined_t
   use ek_derivatives, only: derivatives_t, begin_derivatives, find_derivatives, refuse_case
   use ek_defined_slopes, only: begin_defined, define_derivatives
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_session, spare_results
   use ek_run_columns, only: choose_columns, choose_defined
   use ek_run_numbers, only: split_names
   use ek_outbox, only: outbox_t, outbox_in
   use ek_console, only: print_note, print_remarks, print_text
   implicit none(type, external)
   private
   public :: derive

   integer, parameter :: max_listed = 10      !! largest number of numbers listed for each column
   integer, parameter :: max_columns = 8      !! largest number of columns for which numbers are listed

contains

   !> Solves a case and writes the derivatives of its columns at some of its states.
   subroutine derive(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(deck_settings_t) :: settings
      class(session_t), allocatable :: session
      type(direction_t), allocatable :: directions(:)
      type(derivatives_t) :: derivatives, defined  ! as a class, a schedule in it would not be freed by gfortran 12
      type(defined_t), allocatable :: list(:)
      type(error_t), allocatable :: unreached
      character(name_length), allocatable :: columns(:)
      integer, allocatable :: states(:)
      type(message_list_t) :: given
      integer :: k

      if (line%has('--definitions')) call check_program(line%value('--definitions'), error)
      if (allocated(error)) return
      call read_deck_settings(line, settings)
      given = line%values('--with')
      do k = 1, given%count()
         call split(given%line(k), settings%paths)
      end do
      call load_session(settings, session, error)
      if (allocated(error)) return
      associate (workspace => session%workspace)
         call choose_case(settings, workspace, k, error)
         if (allocated(error)) return
         if (settings%out /= '-') &
            call spare_results(trim(workspace%cases(k)%case%name)//'_derivatives', workspace%deck_cases, error)
         if (allocated(error)) return
         call choose_numbers(line, session, directions, error)
         if (.not. allocated(error)) call choose_quantities(line, workspace, k, columns, error)
         if (.not. allocated(error)) call solve(settings, k, workspace, unreached, error)
         if (.not. allocated(error)) call choose_states(line, workspace, k, states, error)
         if (allocated(error)) return
         call ask_memory(bytes_of(size(columns), size(directions), size(states)), 'the derivatives of '//plural(size(columns), &
            'column', 'columns')//' at '//plural(size(states), 'state', 'states')//' with respect to '// &
            plural(size(directions), 'number', 'numbers'), error)
         if (allocated(error)) return
         call begin_derivatives(workspace, k, columns, directions, derivatives)
         if (line%has('--definitions')) call begin_defined(workspace, line%value('--definitions'), names_of(line), derivatives, &
            list, defined)
         call find_derivatives(workspace, states, derivatives)
         if (line%has('--definitions')) then
            call define_derivatives(workspace, list, derivatives, defined)
            call write_results(line, settings, workspace, defined, error)
         else
            call write_results(line, settings, workspace, derivatives, error)
         end if
         call warn(settings, workspace, derivatives)
      end associate
      if (.not. allocated(error)) call move_alloc(unreached, error)
   end subroutine derive

   !> The names of --of; * without --of.
   function names_of(line) result(names)
      type(command_line_t), intent(in) :: line
      character(name_length), allocatable :: names(:)

      call split_names(line%value('--of', '*'), names)
   end function names_of

   !> Bytes of the derivatives and of their errors.
   pure integer(i8) function bytes_of(columns, numbers, states)
      integer, intent(in) :: columns, numbers, states
      bytes_of = 8_i8*columns*states*(2_i8*numbers + 1)
   end function bytes_of

   !> Chooses the case of --case; without --case, the first case. An unknown case, or a case without derivatives, is an error.
   subroutine choose_case(settings, workspace, k, error)
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      integer, intent(out) :: k
      type(error_t), allocatable, intent(out) :: error
      character(name_length) :: names(size(workspace%cases))
      integer :: j

      do k = 1, size(workspace%cases)
         if (settings%case == '' .or. workspace%cases(k)%case%name == settings%case) exit
      end do
      if (k <= size(workspace%cases)) then
         call refuse_case(workspace%cases(k)%case, error)
         return
      end if
      do j = 1, size(names)
         names(j) = workspace%cases(j)%case%name
      end do
      if (size(names) == 0) then
         call fail(error, exit_usage, settings%file//': no &case group and no wheel, so there is no case to run')
      else
         call fail(error, exit_usage, '--case: no case '//quoted(settings%case)//' in '//settings%file// &
            ', and no standard test of this name'//suggestion(settings%case, names))
      end if
   end subroutine choose_case

   !> Chooses the numbers of --with, or all numbers that the deck gives.
   subroutine choose_numbers(line, session, directions, error)
      type(command_line_t), intent(in) :: line
      type(session_t), intent(in) :: session
      type(direction_t), allocatable, intent(out) :: directions(:)
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: given, paths
      integer :: k

      if (.not. line%has('--with')) then
         call all_directions(session%workspace%definition, directions)
         return
      end if
      given = line%values('--with')
      do k = 1, given%count()
         call split(given%line(k), paths)
      end do
      call find_directions(session%workspace%definition, session%deck, paths, directions, error)
      if (.not. allocated(error)) call refuse_shared(session%workspace%definition, directions, error)
      if (allocated(error)) error%message = '--with: '//error%message
   end subroutine choose_numbers

   !> Adds the items of a comma-separated list.
   subroutine split(list, items)
      character(*), intent(in) :: list
      type(message_list_t), intent(inout) :: items
      integer :: first, last

      first = 1
      do while (first <= len(list))
         last = first + index(list(first:)//',', ',') - 2
         if (list(first:last) /= '') call items%add(trim(adjustl(list(first:last))))
         first = last + 2
      end do
   end subroutine split

   !> Chooses the columns of --of, or all quantities of the case; with --definitions, the columns that follow from them.
   subroutine choose_quantities(line, workspace, k, columns, error)
      type(command_line_t), intent(in) :: line
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      character(name_length), allocatable, intent(out) :: columns(:)
      type(error_t), allocatable, intent(out) :: error
      character(*), parameter :: no_quantities(*) = [character(16) :: 'state', 'factor', 'converged', 'stable', 'near_singular', &
         'iterations', 'constraint_error']
      character(name_length), allocatable :: entries(:)
      logical, allocatable :: is_quantity(:)
      type(message_list_t) :: given
      type(case_t) :: case(1)
      integer :: c

      case(1) = workspace%cases(k)%case
      if (line%has('--definitions')) then
         call choose_defined(line%value('--definitions'), names_of(line), workspace%raw, case, columns, error, '--of')
         return
      else if (.not. line%has('--of')) then
         call choose_columns('*', workspace%raw, case, columns, error)
         return
      end if
      call compliance_columns(workspace%raw, entries)
      call split(line%value('--of'), given)
      do c = 1, given%count()
         if (any(no_quantities == given%line(c)) .and. .not. allocated(error)) call fail(error, exit_usage, '--of: '// &
            quoted(given%line(c))//' describes the solution and has no derivative; only quantities of the suspension have one')
      end do
      if (.not. allocated(error)) call choose_columns(line%value('--of'), workspace%raw, case, columns, error, '--of', entries)
      if (allocated(error)) return
      is_quantity = [(all(no_quantities /= columns(c)), c=1, size(columns))]
      if (.not. any(is_quantity)) call fail(error, exit_usage, '--of: '//quoted(line%value('--of'))// &
         ' matches only columns that describe the solution; only quantities of the suspension have derivatives')
      columns = pack(columns, is_quantity)
   end subroutine choose_quantities

   !> Solves the case. States that did not converge are reported; the derivatives of the converged states are still computed.
   subroutine solve(settings, k, workspace, unreached, error)
      type(deck_settings_t), intent(in) :: settings
      integer, intent(in) :: k
      type(workspace_t), intent(inout) :: workspace
      type(error_t), allocatable, intent(out) :: unreached     !! some states were not reached
      type(error_t), allocatable, intent(out) :: error         !! nothing was solved
      type(solve_options_t) :: options
      logical :: is_done

      allocate (options%columns(0))
      call solve_or_explain(k, options, workspace, is_done, error)
      if (allocated(error)) return
      if (.not. is_done) then
         call fail(error, exit_model, settings%file//': its numbers give no model')
         return
      end if
      associate (result => workspace%cases(k)%result)
         call add_remarks(options, result)
         call print_remarks(settings%is_quiet, result%remarks)
         call failure_of(result, unreached)
         if (.not. result%is_run()) call move_alloc(unreached, error)
      end associate
   end subroutine solve

   !> Chooses the states of --at: the state nearest to each swept value, or all states. Without --at, chooses the state nearest to
   !> the swept value 0 (design).
   subroutine choose_states(line, workspace, k, states, error)
      type(command_line_t), intent(in) :: line
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      integer, allocatable, intent(out) :: states(:)
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: words
      real(wp) :: place, low, high, half
      logical :: is_number
      integer :: j

      associate (path => workspace%cases(k)%result%path, case => workspace%cases(k)%result%case)
         if (line%value('--at') == 'all') then
            states = [(j, j=1, path%states)]
            return
         end if
         allocate (states(0))
         call split(line%value('--at', '0'), words)
         low = minval(path%value)
         high = maxval(path%value)
         half = 0.5_wp*(high - low)/max(1, path%states - 1)
         do j = 1, words%count()
            call get_bounded(words%line(j), place, is_number)
            if (is_number) place = place*case%unit
            if (.not. is_number) then
               call fail(error, exit_usage, '--at: expected swept values or all, found '//quoted(words%line(j))// &
                  size_hint(words%line(j)))
            else if (line%has('--at') .and. (place < low - half .or. place > high + half)) then
               call fail(error, exit_usage, '--at: case '//quoted(case%name)//' goes from '//str(case%from/case%unit, 6)//' to '// &
                  str(case%to/case%unit, 6)//' '//case%unit_name//', found '//words%line(j))
            end if
            if (allocated(error)) return
            if (.not. any(states == nearest_state(path, place))) states = [states, nearest_state(path, place)]
         end do
      end associate
      if (size(states) == 0) call fail(error, exit_usage, '--at: no swept value is given')
   end subroutine choose_states

   !> Writes the table to a file, or with `--out -` to standard output. With a file and at most max_columns columns of --of, prints
   !> the numbers with the largest effects on each column.
   subroutine write_results(line, settings, workspace, found, error)
      type(command_line_t), intent(in) :: line
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      type(derivatives_t), intent(in) :: found
      type(error_t), allocatable, intent(out) :: error
      type(outbox_t) :: box
      type(buffer_t) :: list
      character(:), allocatable :: name
      integer :: c, s

      if (settings%out == '-') then
         call write_csv(found, '-', error)
         return
      end if
      associate (result => workspace%cases(found%case)%result)
         box = outbox_in(settings%out)
         name = result%suspension%name//'_'//result%case%name//'_derivatives.csv'
         call make_folder(settings%out, error)
         if (.not. allocated(error)) call write_csv(found, join_path(settings%out, name), error)
         if (allocated(error)) return
         call box%announce(name)
         call box%finish(error)
         if (allocated(error) .or. .not. line%has('--of') .or. size(found%columns) > max_columns) return
         do s = 1, size(found%states)
            do c = 1, size(found%columns)
               call add_list(found, c, s, result%case, list)
            end do
         end do
      end associate
      call print_text(list%text(), error)
   end subroutine write_results

   !> Writes the heading of the table and one row per state, column and number. The table may be larger than the memory.
   subroutine write_csv(found, path, error)
      type(derivatives_t), intent(in) :: found
      character(*), intent(in) :: path                       !! '-': standard output
      type(error_t), allocatable, intent(out) :: error       !! exit_file
      integer, parameter :: held = 50000                     ! characters that are held before they are written
      type(writer_t) :: writer
      type(frame_t) :: frame
      integer :: c, p, s

      if (path /= '-') call begin_file(writer, path, error)
      if (allocated(error)) return
      frame = new_frame('state,factor,column,value,number,unit,at,derivative,error')
      do s = 1, size(found%states)
         do c = 1, size(found%columns)
            call frame%put(found%states(s) - 1)
            call frame%put(found%factor(s))
            call frame%put(trim(found%columns(c)))
            call frame%put(found%values(c, s))
            call frame%hold()
            do p = 1, size(found%directions)
               call frame%put(found%directions(p)%path)
               call frame%put(found%directions(p)%unit)
               call frame%put([found%directions(p)%value, found%slopes(c, p, s), found%errors(c, p, s)])
               if (frame%length() > held) call pass()
               if (allocated(error)) return
            end do
            call frame%release()
         end do
      end do
      call pass()
      if (path /= '-') call writer%finish(error)

   contains

      !> Writes the rows that are held.
      subroutine pass()
         character(:), allocatable :: text

         call frame%next_csv(text)
         if (path == '-') call write_standard_output(text, error)
         if (path /= '-') call writer%add(text)
      end subroutine pass

   end subroutine write_csv

   !> Adds the value of a column and its derivatives with respect to the ten numbers with the largest effects. The effects are for
   !> changes of 1 mm, of 0.06 deg, or of 1 % of a rate or a force (steps of ek_direction). Derivatives that are only rounding noise
   !> are not listed.
   subroutine add_list(found, c, s, case, list)
      type(derivatives_t), intent(in) :: found
      integer, intent(in) :: c, s
      type(case_t), intent(in) :: case
      type(buffer_t), intent(inout) :: list
      real(wp) :: effect(size(found%directions))
      character(:), allocatable :: unit
      integer :: j, p

      do p = 1, size(effect)
         effect(p) = -1.0_wp
         if (is_flat(found%slopes(c, p, s), found%directions(p)%step, '_'//unit_of(trim(found%columns(c))), &
            found%values(c, s))) cycle
         if (.not. ieee_is_nan(found%slopes(c, p, s))) effect(p) = abs(found%slopes(c, p, s))*found%directions(p)%step
      end do
      call list%line(trim(found%columns(c))//' = '//str(found%values(c, s), 7)//' at '//case%place_name//' = '// &
         str(found%factor(s), 7)//' '//case%unit_name)
      do j = 1, min(max_listed, size(effect))
         p = maxloc(effect, dim=1)
         if (effect(p) <= 0.0_wp) exit
         unit = found%directions(p)%unit
         if (unit /= '') unit = ' per '//unit
         call list%line('  '//found%directions(p)%path//repeat(' ', max(1, 40 - len(found%directions(p)%path)))// &
            str(found%slopes(c, p, s), 7)//unit)
         effect(p) = -1.0_wp
      end do
   end subroutine add_list

   !> Prints notes on states that did not converge, and on numbers without a derivative, with the reason.
   subroutine warn(settings, workspace, found)
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      type(derivatives_t), intent(in) :: found
      type(buffer_t) :: names
      integer :: p, s, lost

      lost = 0
      do s = 1, size(found%states)
         if (.not. workspace%cases(found%case)%result%path%is_reached(found%states(s))) lost = lost + 1
      end do
      if (lost > 0) call print_note(settings%is_quiet, plural(lost, 'state', 'states')//' did not converge: no derivatives there')
      do p = 1, size(found%directions)
         if (.not. found%can_move(p)) call names%add(found%directions(p)%path//' ')
      end do
      if (names%length() > 0) call print_note(settings%is_quiet, 'no derivative, because a change either way gives another '// &
         'model, or a case with other states: '//names%text())
   end subroutine warn

end module ek_derivatives_command
