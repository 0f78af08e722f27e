!> elastokin-bench DECK --derivatives: time of derivatives, relative to the sweep of the same states. For the entries of the
!> compliance matrix, the time is relative to the time of the matrix itself.
!>
!> The sweep is solved by LAPACK. All measurements are made in turn in the same run, in processor time, and the minimum of several
!> rounds counts, so that a ratio does not depend on the speed or load of the machine.
module ek_bench_derivatives
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage, exit_model, exit_convergence
   use ek_text, only: str, quoted
   use ek_json, only: json_t, json_string, json_number
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, new_kkt
   use ek_path, only: path_t, sweep
   use ek_table, only: name_length
   use ek_column_list, only: column_list_t
   use ek_state_columns, only: state_columns
   use ek_compliance_table, only: compliance_columns
   use ek_wheel_side, only: prefix_of
   use ek_case_result, only: solve_options_t
   use ek_workspace, only: workspace_t, solve_or_explain
   use ek_workspace_cases, only: case_number
   use ek_session, only: session_t
   use ek_column_observer, only: column_observer_t, new_column_observer, observe_columns
   use ek_direction, only: direction_t, all_directions
   use ek_derivatives, only: derivatives_t, begin_derivatives, find_derivatives, refuse_case
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_session
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: bench_derivatives

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: rounds = 7

   !> A use of derivatives: the columns, the directions (numbers of the deck) and the states, and the time of their derivatives.
   type :: use_t
      character(:), allocatable :: name
      character(name_length), allocatable :: columns(:)
      type(direction_t), allocatable :: directions(:)
      integer, allocatable :: states(:)          !! places in the sweep
      type(derivatives_t) :: derivatives
      real(wp) :: time = huge(1.0_wp)            !! shortest time of the derivatives at these states [s]
   end type use_t

contains

   !> Prints the time of the sweep and the time ratios to standard output; with --json, prints them as a JSON object.
   subroutine bench_derivatives(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(deck_settings_t) :: settings
      class(session_t), allocatable :: session
      type(solve_options_t) :: options
      logical :: is_done
      integer :: k

      call read_deck_settings(line, settings)
      call load_session(settings, session, error)
      if (allocated(error)) return
      associate (workspace => session%workspace)
         k = case_number(settings%case, workspace)
         if (k == 0) call fail(error, exit_usage, '--case: no case '//quoted(settings%case)//' in '//settings%file)
         if (allocated(error)) return
         call refuse_case(workspace%cases(k)%case, error)
         if (allocated(error)) return
         if (settings%increments > 0) workspace%cases(k)%case%increments = settings%increments
         if (settings%increments > 0) workspace%deck_cases%increments = settings%increments
         allocate (options%columns(0))
         call solve_or_explain(k, options, workspace, is_done, error)
         if (allocated(error)) return
         if (.not. is_done) then
            call fail(error, exit_model, settings%file//': its numbers give no model')
         else if (.not. all(workspace%cases(k)%result%path%is_reached)) then
            call fail(error, exit_convergence, 'case '//quoted(workspace%cases(k)%case%name)// &
               ' does not converge at every state and cannot be timed')
         else
            call time_uses(workspace, k, line%has('--json'), error)
         end if
      end associate
   end subroutine bench_derivatives

   !> Times all uses of derivatives in turn.
   subroutine time_uses(workspace, k, is_json, error)
      type(workspace_t), intent(inout) :: workspace
      integer, intent(in) :: k
      logical, intent(in) :: is_json
      type(error_t), allocatable, intent(out) :: error
      type(use_t), allocatable :: uses(:)
      real(wp) :: walk, row
      integer :: u, round

      allocate (uses(6))
      call list_uses(workspace, k, uses)
      walk = huge(walk)
      row = huge(row)
      do u = 1, size(uses)
         call begin_derivatives(workspace, k, uses(u)%columns, uses(u)%directions, uses(u)%derivatives)
      end do
      do round = 1, rounds
         call time_sweep(workspace, k, walk)
         call time_columns(workspace, k, uses(3)%columns, row)
         do u = 1, size(uses)
            call time_use(workspace, uses(u))
         end do
      end do
      if (is_json) then
         call print_text(json_of(workspace, k, uses, walk, row)//nl, error)
      else
         call print_text(table_of(workspace, k, uses, walk, row), error)
      end if
   end subroutine time_uses

   !> Lists the six uses of derivatives. Three are with respect to all coordinates of points: motion of the states, all columns of
   !> the state, compliance matrix. Three are with respect to all numbers of the deck: one column at all states, motion of the
   !> states, and one response, which is the column at the last state.
   subroutine list_uses(workspace, k, uses)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      type(use_t), intent(inout) :: uses(6)
      type(direction_t), allocatable :: all(:), points(:)
      type(column_list_t) :: list
      integer :: p, s

      call all_directions(workspace%definition, all)
      allocate (points(0))
      do p = 1, size(all)
         if (index(all(p)%path, 'point.') == 1) points = [points, all(p)]
      end do
      associate (suspension => workspace%cases(k)%result%suspension)
         call state_columns(suspension, list)
         uses(1)%name = 'motion of the states, '//str(size(points))//' coordinates'
         uses(2)%name = 'all '//str(list%used)//' columns of the state, '//str(size(points))//' coordinates'
         call compliance_columns(suspension, uses(3)%columns)
         uses(3)%name = 'all '//str(size(uses(3)%columns))//' entries of the compliance matrix, '//str(size(points))//' coordinates'
         allocate (uses(1)%columns(0), uses(4)%columns(1), uses(5)%columns(0), uses(6)%columns(1))
         uses(2)%columns = list%names(:list%used)
         uses(4)%columns = 'toe_deg'
         if (size(suspension%wheels) > 1) uses(4)%columns = prefix_of(suspension, 1)//'toe_deg'
         uses(6)%columns = uses(4)%columns
         uses(4)%name = trim(uses(4)%columns(1))//' at all states, all '//str(size(all))//' numbers'
         uses(5)%name = 'motion of the states, all '//str(size(all))//' numbers'
         uses(6)%name = 'one response ('//trim(uses(6)%columns(1))//' at the last state), all '//str(size(all))//' numbers'
      end associate
      do p = 1, size(uses)
         if (p <= 3) uses(p)%directions = points
         if (p > 3) uses(p)%directions = all
         uses(p)%states = [(s, s=1, workspace%cases(k)%result%path%states)]
      end do
      uses(6)%states = uses(6)%states(size(uses(6)%states):)
   end subroutine list_uses

   !> Times the sweep of the case by LAPACK, and stores the shortest time so far.
   subroutine time_sweep(workspace, k, time)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      real(wp), intent(inout) :: time
      type(path_t) :: path
      type(kkt_t) :: kkt
      real(wp) :: start, now
      integer :: round

      associate (result => workspace%cases(k)%result)
         kkt = new_kkt(result%suspension)
         do round = 1, 5
            call cpu_time(start)
            call sweep(result%suspension, result%case, path, kkt)
            call cpu_time(now)
            time = min(time, now - start)
         end do
      end associate
   end subroutine time_sweep

   !> Times the computation of columns at all states, and stores the shortest time so far.
   subroutine time_columns(workspace, k, columns, time)
      type(workspace_t), intent(inout) :: workspace
      integer, intent(in) :: k
      character(*), intent(in) :: columns(:)
      real(wp), intent(inout) :: time
      type(column_observer_t) :: observer
      type(schedule_t) :: schedule
      type(state_t) :: state
      type(inputs_t) :: inputs
      real(wp), allocatable :: values(:)
      real(wp) :: start, now
      integer :: s

      associate (result => workspace%cases(k)%result)
         call new_column_observer(result%suspension, result%case, columns, observer)
         allocate (values(size(observer%columns)), source=0.0_wp)
         schedule = new_schedule(result%suspension, result%case)
         state = design_state(result%suspension)
         call cpu_time(start)
         do s = 1, result%path%states
            call unpack_state(result%path%packed(:, s), state)
            call inputs_at(schedule, result%path%value(s), inputs)
            call observe_columns(result%suspension, state, inputs, result%kkt, observer, values)
         end do
         call cpu_time(now)
         time = min(time, now - start)
      end associate
   end subroutine time_columns

   !> Times the derivatives of one use, and stores the shortest time so far.
   subroutine time_use(workspace, this)
      type(workspace_t), intent(inout) :: workspace
      type(use_t), intent(inout) :: this
      real(wp) :: start, now

      call cpu_time(start)
      call find_derivatives(workspace, this%states, this%derivatives)
      call cpu_time(now)
      this%time = min(this%time, now - start)
   end subroutine time_use

   !> The time ratios as lines for the terminal.
   function table_of(workspace, k, uses, walk, row) result(text)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      type(use_t), intent(in) :: uses(:)
      real(wp), intent(in) :: walk, row          !! sweep by LAPACK; compliance matrix at all states of the sweep [s]
      character(:), allocatable :: text
      character(200) :: line
      integer :: u

      associate (result => workspace%cases(k)%result)
         text = 'derivatives of model '//result%suspension%name//', case '//result%case%name//', '//str(result%path%states)// &
            ' states, matrix '//str(result%kkt%n)//' x '//str(result%kkt%n)//nl
      end associate
      write (line, '(a,t67,f9.3,a)') 'sweep by LAPACK', walk*1.0e3_wp, ' ms'
      text = text//trim(line)//nl
      do u = 1, size(uses)
         if (u == 3) cycle
         write (line, '(a,t67,f9.3,a,f8.2,a)') uses(u)%name, uses(u)%time*1.0e3_wp, ' ms', uses(u)%time/walk, ' sweeps'
         text = text//trim(line)//nl
      end do
      if (size(uses(3)%columns) == 0) return
      write (line, '(a,t67,f9.3,a,f8.2,a)') uses(3)%name, uses(3)%time*1.0e3_wp, ' ms', of_one(uses(3), row), &
         ' times the matrix itself, per number'
      text = text//trim(line)//nl
   end function table_of

   !> Ratio [-] of the time of the derivatives with respect to one number, to the time of the columns themselves.
   pure real(wp) function of_one(use, row)
      type(use_t), intent(in) :: use
      real(wp), intent(in) :: row
      of_one = use%time/(row*max(1, size(use%directions)))
   end function of_one

   !> The time of the sweep and the time ratios as a JSON object.
   function json_of(workspace, k, uses, walk, row) result(text)
      type(workspace_t), intent(in) :: workspace
      integer, intent(in) :: k
      type(use_t), intent(in) :: uses(:)
      real(wp), intent(in) :: walk, row
      character(:), allocatable :: text
      type(json_t) :: json

      call json%open('{')
      associate (result => workspace%cases(k)%result)
         call json%item('model', json_string(result%suspension%name))
         call json%item('case', json_string(result%case%name))
         call json%item('states', str(result%path%states))
         call json%item('n', str(result%kkt%n))
      end associate
      call json%item('sweep_ms', json_number(walk*1.0e3_wp))
      call json%item('coordinates', str(size(uses(1)%directions)))
      call json%item('numbers', str(size(uses(4)%directions)))
      call json%item('motion_sweeps', json_number(uses(1)%time/walk))
      call json%item('state_columns_sweeps', json_number(uses(2)%time/walk))
      call json%item('response_sweeps', json_number(uses(4)%time/walk))
      call json%item('response_at_one_state_sweeps', json_number(uses(6)%time/walk))
      call json%item('all_motions_sweeps', json_number(uses(5)%time/walk))
      if (size(uses(3)%columns) > 0) call json%item('compliance_rows_per_number', json_number(of_one(uses(3), row)))
      call json%close('}')
      text = json%text()
   end function json_of

end module ek_bench_derivatives
