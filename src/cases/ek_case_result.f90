!> Solves one case of a deck: the path of its states, the table of the states, and the outcome.
!>
!> Every command and every study chooses options, solves its cases with this module, and prints or writes the result. A solution
!> consists of numbers and of a code, the outcome. On request, add_remarks describes both in messages.
module ek_case_result
   use ek_load_state, only: start_line
   use ek_kinds, only: wp, i8, millimetre
   use ek_error, only: error_t, fail, exit_model, exit_convergence, exit_file
   use ek_text, only: str, quoted, plural
   use ek_version, only: version
   use ek_system, only: has_memory, memory_remarks
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, row_name
   use ek_path, only: path_t, sweep, progress_procedure
   use ek_path_states, only: drop_readings
   use ek_rig, only: mounted_case_t, mount_case
   use ek_wheel_side, only: single_side
   use ek_standard_tests, only: describe_sweep
   use ek_sweep_table, only: observer_t, make_observer, observe, open_states, sweep_bytes
   use ek_defined_table, only: defined_list_t, append_defined
   use ek_failure_text, only: failure_text, stability_remarks
   use ek_case_remarks, only: settling_remarks, drift_remarks, travel_remarks, rack_remarks, closure_remarks, curve_reach_remarks
   use ek_remark, only: remark_list_t, failure, on_case, on_end
   use ek_value_stops, only: stop_at_values
   use ek_table, only: table_t, stop_t, name_length, column, keep_rows, scheduled_rows
   use ek_test_result, only: frame_line, test_result_t, find_wheels
   implicit none(type, external)
   private
   public :: case_result_t, solve_options_t, solve_case, solve_with_remarks, solve_mounted, add_remarks, failure_of, test_of, &
      add_header
   public :: solved, partly_solved, not_solvable, not_mountable, out_of_memory

   ! outcomes
   integer, parameter :: solved = 0           !! all states converged
   integer, parameter :: partly_solved = 1    !! some states have converged = 0; the others are available
   integer, parameter :: not_solvable = 2     !! the model is a mechanism, or over-constrained
   integer, parameter :: not_mountable = 3    !! the load table of the case cannot be read
   integer, parameter :: out_of_memory = 4    !! the states would not fit into memory

   !> Options of a solution: the requested results, and a known defect of the model.
   type :: solve_options_t
      character(:), allocatable :: fault           !! defect of the model in this case; such a case is not solved. '': no defect
      logical :: has_violation = .true.            !! constraint_error of equilibria is computed; otherwise NaN
      logical :: is_compared = .true.              !! a linear method is compared with equilibrium at the ends of the path
      real(wp) :: min_settling = 1.0e-8_wp       !! a larger displacement of a wheel under the constant loads gives a note [m]
      character(name_length), allocatable :: columns(:)   !! quantities that are computed; not allocated: all
      type(defined_list_t), allocatable :: defined !! columns of another program that the table also has, at its end
      logical :: defers_kandc = .false.            !! the caller fills the K&C quantities at the states that are read
      type(stop_t), allocatable :: stops(:)        !! values of columns at which the path stops; not allocated: none
      real(wp) :: reach = huge(1.0_wp)             !! swept value [SI] beyond which, on either side of design, no state is needed
      character(:), allocatable :: checksum        !! checksum of the deck, for the header of the table; not allocated: no header
   end type solve_options_t

   !> The solution of a case. Its work space serves further solutions at the states of the path.
   type, extends(mounted_case_t) :: case_result_t
      integer :: outcome = solved                  !! one of the constants above
      integer(i8) :: bytes = 0                     !! memory that the states need
      type(path_t) :: path                         !! states of the case
      type(table_t) :: table                       !! observations: one row per state; only if the case was run
      type(remark_list_t) :: remarks               !! messages, from add_remarks
   contains
      procedure :: is_run                          !! whether the case has a path and a table
   end type case_result_t

contains

   pure logical function is_run(self)
      class(case_result_t), intent(in) :: self
      is_run = self%outcome == solved .or. self%outcome == partly_solved
   end function is_run

   !> Puts a suspension on the rig for a case, solves the path of the case, and creates the table of the case. If the model has a
   !> fault in this case, or if the case cannot be mounted, only the outcome and the case are set.
   subroutine solve_case(base, case, options, result, progress, observer)
      type(suspension_t), intent(in) :: base           !! after the preload trim (`balance`); not changed
      type(case_t), intent(in) :: case                 !! case of the deck; not changed
      type(solve_options_t), intent(in) :: options
      type(case_result_t), intent(out) :: result
      procedure(progress_procedure), optional :: progress
      type(observer_t), intent(inout), optional :: observer   !! reused for all designs of a deck

      if (allocated(options%fault)) then
         if (len(options%fault) > 0) result%outcome = not_solvable
      end if
      if (result%outcome == solved .and. .not. is_mountable(case)) result%outcome = not_mountable
      if (result%outcome /= solved) then
         result%case = case
         return
      end if
      call mount_case(base, case, result%mounted_case_t)
      call solve_mounted(options, result, progress, observer)
   end subroutine solve_case

   !> Solves a case as solve_case does, and adds its messages. Only one thread at a time may call this procedure.
   subroutine solve_with_remarks(base, case, options, result, error, progress, read)
      type(suspension_t), intent(in) :: base           !! after the preload trim (`balance`); not changed
      type(case_t), intent(in) :: case
      type(solve_options_t), intent(in) :: options
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error !! failures of the result (failure_of)
      procedure(progress_procedure), optional :: progress
      type(table_t), allocatable, intent(out), optional :: read      !! the table with the states where numbers are read, if there
                                                       !! are such states; the result then has the states of the schedule only

      call solve_case(base, case, options, result, progress)
      if (present(read)) then
         if (allocated(result%table%is_scheduled)) allocate (read, source=result%table)
         call keep_schedule(result)
      end if
      call add_remarks(options, result)
      call failure_of(result, error)
   end subroutine solve_with_remarks

   !> Solves the path of a case that was put on the rig (mount_case), and creates the table of the case. If the states do not fit
   !> into memory, only the outcome is set.
   subroutine solve_mounted(options, result, progress, observer, is_walked)
      type(solve_options_t), intent(in) :: options     !! without a fault
      type(case_result_t), intent(inout) :: result     !! all but the case on the rig (and the path, if is_walked) is replaced
      procedure(progress_procedure), optional :: progress
      type(observer_t), intent(inout), optional, target :: observer   !! reused for all designs of a deck
      logical, intent(in), optional :: is_walked       !! .true.: the path of `result` is complete
      type(observer_t), allocatable, target :: own
      type(observer_t), pointer :: tells
      type(remark_list_t) :: none
      logical :: has_path
      integer(i8) :: had

      has_path = .false.
      if (present(is_walked)) has_path = is_walked
      if (result%outcome == out_of_memory) result%bytes = 0
      result%outcome = solved
      result%remarks = none
      if (present(observer)) then
         tells => observer
      else
         allocate (own)
         tells => own
      end if
      call make_observer(result%suspension, result%case, tells, options%columns, options%has_violation)
      had = result%bytes
      result%bytes = sweep_bytes(result%suspension, result%case, tells)
      if (result%bytes > had) then                     ! less is there already, from the design before
         if (.not. has_memory(result%bytes)) then
            result%outcome = out_of_memory
            return
         end if
      end if
      if (.not. has_path) call sweep(result%suspension, result%case, result%path, result%kkt, progress, options%reach, result%space)
      call observe(result%suspension, result%case, result%path, result%kkt, tells, result%table, options%defers_kandc)
      if (allocated(options%stops)) call stop_at_values(options%stops, result%suspension, result%case, result%kkt, result%space, &
         tells, result%path, result%table)
      if (allocated(options%defined)) call append_defined(result%suspension, options%defined, result%table)
      if (any(result%path%failure%state > 0) .or. any(open_states(result%table))) result%outcome = partly_solved
      if (allocated(options%checksum)) call add_header(result%table, result%suspension, result%case, options%checksum)
   end subroutine solve_mounted

   !> Removes the states where numbers are read from a result, after the numbers were read. The states of the schedule remain.
   subroutine keep_schedule(result)
      type(case_result_t), intent(inout) :: result
      real(wp), allocatable :: states(:)
      integer :: k

      if (.not. allocated(result%path%is_scheduled)) return
      if (all(result%path%is_scheduled)) return
      call keep_rows(scheduled_rows(result%table), result%table)
      states = column(result%table, 'state')
      do k = 1, size(states)
         result%table%values(1, k) = count(result%path%is_scheduled(:nint(states(k))))      ! the table counts from 0
      end do
      if (allocated(result%table%is_scheduled)) deallocate (result%table%is_scheduled)
      call drop_readings(result%path)
   end subroutine keep_schedule

   !> A result as a test of the report: name, kind, settings and table of its case, with the wheels found in the table.
   function test_of(result) result(test)
      type(case_result_t), intent(in) :: result
      type(test_result_t) :: test

      test%name = result%case%name
      test%kind = result%case%test
      test%is_anti = result%case%is_anti
      test%trail = result%case%offset
      test%is_iso = result%suspension%is_iso
      call describe_sweep(result%suspension, result%case, test)
      test%table = result%table
      allocate (test%prefixes(0), test%sides(0))
      if (size(result%suspension%wheels) > 0) call find_wheels(test, result%suspension%wheels(1)%side)
   end function test_of

   !> Replaces the messages (notes, warnings, failures) on a solution. A case that was not run has one message, the reason. If there
   !> is a failure on a solved case, the outcome becomes partly_solved. Only one thread at a time may call add_remarks, because it
   !> creates strings.
   subroutine add_remarks(options, result)
      type(solve_options_t), intent(in) :: options     !! of the solution
      type(case_result_t), intent(inout) :: result     !! its messages are replaced
      type(remark_list_t) :: none

      result%remarks = none
      if (result%is_run()) then
         call remark_on_path(options, result)
         call closure_remarks(result%case, result%table, result%remarks)
         if (result%remarks%has_failed()) result%outcome = partly_solved      ! drift: only remarks compare with equilibrium
      else
         call result%remarks%add(failure, on_case, result%case, reason(options, result))
      end if
   end subroutine add_remarks

   !> The reason why a case was not run.
   function reason(options, result) result(words)
      type(solve_options_t), intent(in) :: options
      type(case_result_t), intent(in) :: result
      character(:), allocatable :: words

      associate (case => result%case)
         select case (result%outcome)
         case (not_solvable)
            words = options%fault
         case (not_mountable)
            words = 'case '//quoted(case%name)//': its table was not read'
            if (allocated(case%table%fault)) words = case%table%fault
         case default
            words = memory_remarks(result%bytes, 'case '//quoted(case%name)//' with '// &
               plural(case%increments, 'increment', 'increments'))
         end select
      end associate
   end function reason

   !> Adds the messages on the states of a path.
   subroutine remark_on_path(options, result)
      type(solve_options_t), intent(in) :: options
      type(case_result_t), intent(inout) :: result
      integer :: side

      associate (suspension => result%suspension, case => result%case, path => result%path, remarks => result%remarks)
         do side = 1, 2
            if (path%failure(side)%state > 0) call remarks%add(failure, on_end, case, &
               failure_text(suspension, case, path, path%failure(side), result%kkt), path%failure(side)%reached)
         end do
         call settling_remarks(suspension, case, path, options%min_settling, remarks)
         if (options%is_compared) call drift_remarks(suspension, case, path, result%kkt, remarks)
         call travel_remarks(suspension, case, path, remarks)
         call stability_remarks(case, path, remarks)
         call rack_remarks(suspension, case, remarks)
         call curve_reach_remarks(suspension, case, path, remarks)
      end associate
   end subroutine remark_on_path

   !> Returns the failures of a result as an error; no error if the case was solved.
   subroutine failure_of(result, error)
      type(case_result_t), intent(in) :: result             !! with its messages
      type(error_t), allocatable, intent(out) :: error      !! exit_convergence, exit_model or exit_file
      integer, parameter :: codes(partly_solved:out_of_memory) = [exit_convergence, exit_model, exit_file, exit_file]

      if (result%outcome /= solved) call fail(error, codes(result%outcome), result%remarks%failures())
   end subroutine failure_of

   !> Gives each row of a table the name of its row in the load table, or of its manoeuvre; 'design' for the design state.
   subroutine name_rows(case, table)
      type(case_t), intent(in) :: case
      type(table_t), intent(inout) :: table
      real(wp), allocatable :: places(:)
      integer :: k

      if (row_name(case, 1) == '' .or. allocated(table%names)) return
      places = column(table, 'factor')
      allocate (table%names(size(places)))
      do k = 1, size(places)
         table%names(k)%text = row_name(case, nint(places(k)))
      end do
   end subroutine name_rows

   !> Adds the header lines of the table of a case. The rows of a table with names receive their names.
   subroutine add_header(table, suspension, case, checksum)
      type(table_t), intent(inout) :: table
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case              !! on the rig
      character(*), intent(in) :: checksum          !! of the deck
      character(:), allocatable :: start

      call name_rows(case, table)
      call table%header%add('model '//suspension%name//', case '//case%name//', method '//case%method// &
         trim(merge(', follow arc', '            ', case%follows_arc))// &
         trim(merge(', solver sparse', '               ', case%uses_plan))//', tolerance '//str(case%tolerance/millimetre)//' mm')
      if (len(case%test) > 0) then
         call table%header%add('factor: '//case%place_name//' ['//case%unit_name//'], test '//case%test)
      else if (len(case%load) > 0) then
         call table%header%add('factor: multiplier of load '//quoted(case%load))
      else
         call table%header%add('factor: '//case%place_name//' ['//case%unit_name//']')
      end if
      call table%header%add(frame_line(suspension%is_iso, single_side(suspension)))
      call table%header%add('elastokin '//version//', deck checksum '//checksum)
      if (suspension%free_wheels > 0) call table%header%add('kinematics only: no spring carries the wheels; columns that '// &
         'depend on a rate are nan')
      if (suspension%bushed_wheels > 0) call table%header%add('only bushings carry the wheels; columns that depend on '// &
         'the spring are nan')
      start = start_line(suspension)
      if (start /= '') call table%header%add(start)
      call table%header%add('spring force > 0: compression. Bushing force and moment: on its second body, axes of its first '// &
         'marker. Joint force and moment: on its second body, at its point, frame of the deck')
   end subroutine add_header

end module ek_case_result
