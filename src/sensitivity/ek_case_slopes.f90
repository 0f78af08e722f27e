!> A case with the derivatives of its columns at every state. From the table at a design, the table of a neighbouring design follows
!> to first order, without a solution.
module ek_case_slopes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_table, only: table_t, new_table, name_length, column_index
   use ek_case_result, only: solve_options_t
   use ek_number_reach, only: lacks_state
   use ek_workspace, only: workspace_t, solve_numbers, solve_or_explain, succeeded
   use ek_defined_column, only: defined_t
   use ek_derivatives, only: derivatives_t, find_derivatives
   use ek_defined_slopes, only: define_derivatives
   implicit none(type, external)
   private
   public :: case_slopes_t, solve_with_slopes, move_table

   type :: case_slopes_t
      integer :: case = 0                                    !! index of the case in the workspace
      type(solve_options_t) :: options                       !! required columns, and required distance of the states from design
      real(wp) :: required = huge(1.0_wp)                    !! swept value within which no state may be missing
      logical :: reads_all = .false.                         !! numbers are read at all states, not only at the places of the case
      type(derivatives_t), allocatable :: derivatives        !! derivatives of the columns at the states
      type(defined_t), allocatable :: list(:)                !! columns of another program in the table (begin_defined), if any
      type(derivatives_t), allocatable :: defined            !! derivatives of these columns
      type(table_t) :: table !! table of the last solved design: quantities and entries of the compliance matrix
      type(table_t) :: moved                                 !! `table`, moved along a direction (move_table)
      integer, allocatable :: place(:), place_defined(:)     !! index in `table` of each column of the derivatives
      integer, allocatable :: row(:)                         !! row in `table` of each state of the derivatives
   end type case_slopes_t

contains

   !> Solves a case at the present numbers of the workspace, and finds the derivatives of its columns. is_valid is .false. if the
   !> case has no valid solution, or lacks a state within the required distance.
   subroutine solve_with_slopes(is_solved, this, workspace, is_valid)
      logical, intent(in) :: is_solved                       !! the workspace already contains the solution of the case
      type(case_slopes_t), intent(inout) :: this
      type(workspace_t), intent(inout) :: workspace
      logical, intent(out) :: is_valid
      type(error_t), allocatable :: error
      integer, allocatable :: states(:)
      logical, allocatable :: is_stop(:)
      integer :: c, k, s, outcome

      is_valid = is_solved
      if (.not. is_valid) then
         call solve_numbers(this%case, this%options, workspace, outcome)
         is_valid = outcome == succeeded
      end if
      if (.not. is_valid) then
         call solve_or_explain(this%case, this%options, workspace, is_valid, error)      ! with another proof that it is sound
         is_valid = is_valid .and. .not. allocated(error)
      end if
      if (is_valid) is_valid = .not. lacks_state(workspace%cases(this%case)%result, this%required)
      if (.not. is_valid) return
      associate (result => workspace%cases(this%case)%result, derivatives => this%derivatives)
         states = pack([(k, k=1, result%path%states)], result%path%is_reached .and. (this%reads_all .or. result%path%is_read))
         is_stop = [(is_at_stop(result%table, states(s)), s=1, size(states))]
         call find_derivatives(workspace, states, derivatives, is_stop)
         call make_table(result%table, derivatives, this%table, this%place, this%row)
         call move_stops(this)
         call put_values(derivatives, this%place, this%row, this%table)
         if (allocated(this%list)) then
            call define_derivatives(workspace, this%list, derivatives, this%defined)
            this%place_defined = [(column_index(this%table, trim(this%list(c)%head)), c=1, size(this%list))]
            call put_values(this%defined, this%place_defined, this%row, this%table)
         end if
         this%moved = this%table
      end associate
   end subroutine solve_with_slopes

   !> Puts the values of differentiated columns into a table.
   pure subroutine put_values(derivatives, place, row, table)
      type(derivatives_t), intent(in) :: derivatives
      integer, intent(in) :: place(:), row(:)                !! indices in the table of each column and of each state
      type(table_t), intent(inout) :: table
      integer :: c, s

      do s = 1, size(row)
         do c = 1, size(place)
            table%values(place(c), row(s)) = derivatives%values(c, s)
         end do
      end do
   end subroutine put_values

   !> Whether a state of a path is that of a stop of its table (ek_value_stops).
   pure logical function is_at_stop(table, state)
      type(table_t), intent(in) :: table
      integer, intent(in) :: state
      integer :: k

      is_at_stop = .false.
      if (.not. allocated(table%stops)) return
      do k = 1, size(table%stops)
         if (table%stops(k)%row > 0) is_at_stop = is_at_stop .or. nint(table%values(1, table%stops(k)%row)) == state - 1
      end do
   end function is_at_stop

   !> Changes the derivatives at the stops, which are those at a fixed swept value, to those where the column keeps its value: the
   !> state of a stop moves along the path.
   !> Equation (E.11) of docs/theory/derivatives.md.
   pure subroutine move_stops(this)
      type(case_slopes_t), intent(inout) :: this
      logical :: has_motion
      integer :: k, s, x, p

      if (.not. allocated(this%table%stops)) return
      associate (derivatives => this%derivatives)
         do k = 1, size(this%table%stops)
            s = findloc(this%row, this%table%stops(k)%row, dim=1)
            x = findloc(derivatives%columns == this%table%stops(k)%column, .true., dim=1)
            if (s == 0 .or. x == 0) cycle
            has_motion = ieee_is_finite(derivatives%along(x, s))
            if (has_motion) has_motion = abs(derivatives%along(x, s)) > 0.0_wp      ! it has no extreme at the stop
            do p = 1, size(derivatives%directions)
               if (has_motion) then
                  derivatives%slopes(:, p, s) = derivatives%slopes(:, p, s) - &
                     derivatives%along(:, s)*(derivatives%slopes(x, p, s)/derivatives%along(x, s))
               else
                  derivatives%slopes(:, p, s) = ieee_value(1.0_wp, ieee_quiet_nan)
               end if
            end do
         end do
      end associate
   end subroutine move_stops

   !> Builds a table of the columns of a case and of the differentiated entries of its compliance matrix. Also finds the columns and
   !> the rows of the derivatives in the table.
   subroutine make_table(table, derivatives, whole, place, row)
      type(table_t), intent(in) :: table
      type(derivatives_t), intent(in) :: derivatives
      type(table_t), intent(out) :: whole
      integer, allocatable, intent(out) :: place(:), row(:)
      character(name_length), allocatable :: columns(:)
      integer :: c, s, many

      many = size(table%columns)
      columns = [character(name_length) :: table%columns, &
         pack(derivatives%columns, [(column_index(table, trim(derivatives%columns(c))) == 0, c=1, size(derivatives%columns))])]
      whole = new_table(columns, size(table%values, 2))
      whole%values(:many, :) = table%values
      if (allocated(table%is_scheduled)) whole%is_scheduled = table%is_scheduled
      if (allocated(table%stops)) whole%stops = table%stops
      place = [(column_index(whole, trim(derivatives%columns(c))), c=1, size(derivatives%columns))]
      row = [(minloc(abs(table%values(1, :) - (derivatives%states(s) - 1)), dim=1), s=1, size(derivatives%states))]
   end subroutine make_table

   !> Moves the table to the design at a distance along a direction. A derivative that is NaN has no effect.
   pure subroutine move_table(p, distance, this)
      integer, intent(in) :: p                               !! index of the direction
      real(wp), intent(in) :: distance                       !! distance in the unit of the direction
      type(case_slopes_t), intent(inout) :: this

      call move_columns(this%derivatives, p, distance, this%place, this%row, this%table, this%moved)
      if (allocated(this%list)) call move_columns(this%defined, p, distance, this%place_defined, this%row, this%table, this%moved)
   end subroutine move_table

   !> Moves differentiated columns of a table.
   pure subroutine move_columns(derivatives, p, distance, place, row, table, moved)
      type(derivatives_t), intent(in) :: derivatives
      integer, intent(in) :: p                               !! index of the direction
      real(wp), intent(in) :: distance                       !! distance in the unit of the direction
      integer, intent(in) :: place(:), row(:)                !! indices in the table of each column and of each state
      type(table_t), intent(in) :: table
      type(table_t), intent(inout) :: moved                  !! the table, whose columns move
      real(wp) :: slope
      integer :: c, s

      do s = 1, size(row)
         do c = 1, size(place)
            slope = derivatives%slopes(c, p, s)
            if (.not. ieee_is_finite(slope)) slope = 0.0_wp
            moved%values(place(c), row(s)) = table%values(place(c), row(s)) + distance*slope
         end do
      end do
   end subroutine move_columns

end module ek_case_slopes
