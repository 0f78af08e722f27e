!> Solves many states of an axle on the rig, each given by heights, loads and the steering driver, as a test 'table' created in
!> memory.
module ek_rig_rows
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, fail, exit_model, exit_convergence
   use ek_text, only: str
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, load_table_t, table_column_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_case_result, only: case_result_t, solve_options_t, add_remarks
   use ek_defined_column, only: defined_t, define_columns
   use ek_defined_table, only: needed_columns
   use ek_table, only: name_length
   use ek_lone_case, only: solve_sound, heads_on_rig
   use ek_wheel_motion, only: wheel_motion, lengths, length_choice_t, quantities
   implicit none(type, external)
   private
   public :: add_column, rig_case, solve_table, motions

contains

   !> A case of the rig that is not defined in a deck.
   pure function rig_case(test, vertical) result(case)
      character(*), intent(in) :: test
      character(*), intent(in) :: vertical                  !! 'centre', 'road'; '': as in the test
      type(case_t) :: case

      case%name = 'export'
      case%where = 'export'
      case%load = ''
      case%drive = ''
      case%test = test
      case%file = ''
      case%target = ''
      case%vertical = vertical
      case%method = 'equilibrium'
   end function rig_case

   !> Adds a column to a load table (see table_column_t).
   pure subroutine add_column(table, name, wheel, component, values)
      type(load_table_t), intent(inout) :: table
      character(*), intent(in) :: name
      integer, intent(in) :: wheel, component
      real(wp), intent(in) :: values(:)
      type(table_column_t) :: column

      column%name = name
      column%wheel = wheel
      column%component = component
      column%values = values
      table%columns = [table%columns, column]
   end subroutine add_column

   !> Solves the rows of a table. If rows do not converge, the error gives their number and the first of these rows.
   subroutine solve_table(suspension, table, vertical, result, error, program)
      type(suspension_t), intent(in) :: suspension
      type(load_table_t), intent(in) :: table
      character(*), intent(in) :: vertical                  !! 'centre', 'road'; '': as the columns determine
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: error      !! exit_model, exit_convergence
      character(*), intent(in), optional :: program         !! the result has the columns that the columns of this program need
      type(case_t) :: case
      type(solve_options_t) :: options
      character(:), allocatable :: reason
      integer :: row, k

      case = rig_case('table', vertical)
      case%file = 'export'
      case%table = table
      allocate (options%columns(0))
      options%is_compared = .false.
      if (present(program)) call ask_columns(suspension, program, case, options%columns)
      call solve_sound(suspension, case, options, result, error)
      if (allocated(error)) return
      call add_remarks(options, result)
      if (.not. result%is_run()) then
         call fail(error, exit_model, result%remarks%failures())
         return
      end if
      if (all(result%path%is_reached)) return
      row = findloc(result%path%is_reached, .false., dim=1)
      reason = ''
      do k = 1, size(table%columns)
         associate (column => table%columns(k))
            if (column%component > 0 .and. .not. abs(column%values(row)) > 0.0_wp) cycle
            reason = reason//trim(merge(', ', '  ', len(reason) > 0))//' '//column%name//' = '// &
               str(merge(column%values(row), column%values(row)/millimetre, column%component > 0), 6)
         end associate
      end do
      call fail(error, exit_convergence, str(count(.not. result%path%is_reached))//' of '//str(table%rows)// &
         ' states of the export did not converge, so nothing was written; the first:'//reason// &
         '. Use a shorter range (--travel, --steer, --loads), or more points'//new_line('a')//result%remarks%failures())
   end subroutine solve_table

   !> Lists the columns of elastokin that the columns of another program need, and lets the case compute all quantities.
   subroutine ask_columns(suspension, program, case, columns)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: program
      type(case_t), intent(inout) :: case
      character(name_length), allocatable, intent(inout) :: columns(:)     !! receives the names
      character(name_length), allocatable :: heads(:)
      type(defined_t), allocatable :: list(:)

      case%has_all = .true.
      call heads_on_rig(suspension, case, heads)
      call define_columns(suspension, heads, program, list)
      call needed_columns(heads, list, columns)
   end subroutine ask_columns

   !> Computes the quantities of ek_wheel_motion of one wheel in all rows: (quantity, row). All rows must have converged.
   subroutine motions(result, wheel, choices, values)
      type(case_result_t), intent(in) :: result
      integer, intent(in) :: wheel
      type(length_choice_t), intent(in) :: choices(lengths)
      real(wp), allocatable, intent(out) :: values(:, :)
      type(state_t) :: state
      type(inputs_t) :: inputs
      type(schedule_t) :: schedule
      integer :: k

      allocate (values(quantities, result%path%states))
      state = design_state(result%suspension)
      schedule = new_schedule(result%suspension, result%case)
      do k = 1, result%path%states
         call unpack_state(result%path%packed(:, k), state)
         call inputs_at(schedule, result%path%value(k), inputs)
         values(:, k) = wheel_motion(result%suspension, state, inputs, wheel, choices)
      end do
   end subroutine motions

end module ek_rig_rows
