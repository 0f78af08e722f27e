!> The table of a sweep, one row per state: the quantities of a case.
!>
!> The columns come from ek_state_columns and ek_kandc_columns, between `state` and `factor` in front and `converged`, `stable`,
!> `near_singular`, `iterations` and `constraint_error` at the end.
module ek_sweep_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp, i8
   use ek_contract, only: are_checked, require
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state, coordinates
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, assemble_rows, residual_only, whole_tangent
   use ek_attitude, only: attitude_t, find_attitude
   use ek_path_states, only: path_t, most_places
   use ek_state_columns, only: list_state, state_values, has_wheels, has_joints, has_only_wheels
   use ek_column_list, only: column_list_t, choose
   use ek_kandc_list, only: kandc_t, list_kandc, choose_kandc, begin_design, same_columns
   use ek_kandc_columns, only: fill_kandc
   use ek_table, only: table_t, new_table, column_index, name_length
   implicit none(type, external)
   private
   public :: observer_t, make_observer, observe, observe_kandc_at, observe_one, observe_state, quantity_columns, reads_matrix, &
      is_kandc_column, reads_poses_of_wheels, nearly_singular, sweep_table, sweep_columns, open_states, sweep_bytes

   real(wp), parameter :: nearly_singular = 1.0e-12_wp   !! ratio of smallest to largest pivot; at this limit, four digits remain
   real(wp), parameter :: open_joints = 1.0e-2_wp   !! |Φ| [m, rad] above which a state of a linear method is marked converged = 0

   !> Layout of a table of states: its columns, and the work space to fill them.
   type :: observer_t
      character(name_length), allocatable :: columns(:)     !! column headings of the table
      integer, private :: shown = 0, reported = 0, ended = 0    !! index of the last column of the state, the quantities, the table
      integer, allocatable, private :: kept(:)              !! indices of the columns of the table among all columns
      type(column_list_t) :: list                           !! columns of the state
      type(kandc_t), private :: kandc                       !! K&C columns, if the case requests them
      character(name_length), allocatable, private :: wanted(:)
      logical, private :: has_wanted = .false., has_all = .false., has_stability = .false., has_violation = .true.
   end type observer_t

contains

   !> Prepares the table of a case. Does nothing if the table is already prepared for this model, case and these columns. Designs
   !> after the first therefore create no strings: gfortran stores the length of a string that a function returns in one location
   !> for all threads.
   subroutine make_observer(suspension, case, self, wanted, has_violation)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(case_t), intent(in) :: case
      type(observer_t), intent(inout) :: self
      character(*), intent(in), optional :: wanted(:)   !! columns; a name that the model does not define has no effect
      logical, intent(in), optional :: has_violation    !! .false.: constraint_error of equilibria is NaN
      character(name_length), allocatable :: columns(:), asked(:)
      logical, allocatable :: is_kept(:)
      integer :: k

      self%has_violation = .true.
      if (present(has_violation)) self%has_violation = has_violation .or. case%method /= 'equilibrium'
      allocate (asked(merge(1, 0, present(wanted))))
      if (present(wanted)) asked = wanted
      if (is_for(self, suspension, case, asked, present(wanted))) return
      call list_columns(suspension, case, columns, self%list, self%kandc)
      self%has_all = case%has_all
      self%has_stability = knows_stability(case)
      self%ended = size(columns)
      self%reported = self%ended - ends_of(case)
      self%shown = self%reported - self%kandc%used
      allocate (is_kept(self%ended), source=.true.)
      self%wanted = asked
      self%has_wanted = present(wanted)
      if (self%has_wanted) is_kept(3:self%reported) = [(any(self%wanted == columns(k)), k=3, self%reported)]
      self%kept = pack([(k, k=1, self%ended)], is_kept)
      self%columns = columns(self%kept)
      call choose(self%list, is_kept(3:self%shown))
      if (case%has_all) call choose_kandc(self%kandc, is_kept(self%shown + 1:self%reported))
   end subroutine make_observer

   !> Whether an observer was prepared for these columns of a model with the same parts.
   logical function is_for(self, suspension, case, asked, has_asked)
      type(observer_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), intent(in) :: asked(:)
      logical, intent(in) :: has_asked                  !! .false.: all columns

      is_for = .false.
      if (.not. allocated(self%columns)) return
      if (self%has_all .neqv. case%has_all) return
      if (self%has_stability .neqv. knows_stability(case)) return
      if (self%has_wanted .neqv. has_asked) return
      if (size(asked) /= size(self%wanted)) return
      if (any(asked /= self%wanted)) return
      is_for = .true.
      if (case%has_all) is_for = same_columns(suspension, self%kandc)
   end function is_for

   !> Builds the table of a sweep. The table contains all states that were reached, and on each side the first state that was not
   !> reached; for a load table, all rows. A state that was not reached has converged = 0 and NaN values. A state of a linear method
   !> that violates the joint constraints has converged = 0.
   !>
   !> If the case requests all columns, the K&C quantities precede the last columns. The compliance matrix of a state is solved only
   !> if a column of the observer needs it. With defers_kandc, the K&C quantities are NaN; observe_kandc_at computes them at the
   !> states that are read.
   subroutine observe(suspension, case, path, kkt, observer, table, defers_kandc)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(observer_t), intent(inout) :: observer   !! of make_observer
      type(table_t), intent(out) :: table
      logical, intent(in), optional :: defers_kandc
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(attitude_t), allocatable :: wheels(:)
      real(wp), allocatable :: values(:)         ! all columns of a row
      logical :: needs_kandc
      integer :: first, last, k, c

      call reached_rows(path, first, last)
      table = new_table(observer%columns, last - first + 1)
      table%is_along_arc = case%follows_arc
      table%is_of_rows = path%is_table
      table%lacks_springs = suspension%free_wheels > 0
      table%rests_on_bushings = suspension%bushed_wheels > 0
      if (allocated(path%is_scheduled)) then
         if (.not. all(path%is_scheduled)) table%is_scheduled = path%is_scheduled(first:last)
      end if
      allocate (wheels(size(suspension%wheels)))
      allocate (values(observer%ended), source=ieee_value(1.0_wp, ieee_quiet_nan))
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      needs_kandc = has_kandc(observer)
      if (present(defers_kandc)) needs_kandc = needs_kandc .and. .not. defers_kandc
      if (needs_kandc) call begin_design(suspension, observer%kandc)
      do k = first, last
         call fill_row(suspension, case, path, k, schedule, kkt, observer, needs_kandc, state, wheels, values)
         values(1) = k - 1
         do c = 1, size(observer%kept)      ! a vector subscript would ask for memory
            table%values(c, k - first + 1) = values(observer%kept(c))
         end do
      end do
   end subroutine observe

   !> Computes all columns of a state of a path, except its number.
   subroutine fill_row(suspension, case, path, k, schedule, kkt, observer, needs_kandc, state, wheels, values)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k                              !! index of the state
      type(schedule_t), intent(in) :: schedule              !! of the case
      type(kkt_t), intent(inout) :: kkt                     !! work space
      type(observer_t), intent(inout) :: observer
      logical, intent(in) :: needs_kandc
      type(state_t), intent(inout) :: state                 !! work space: any state of this model
      type(attitude_t), intent(inout) :: wheels(:)          !! work space
      real(wp), intent(inout) :: values(:)
      type(inputs_t) :: inputs

      associate (reported => observer%reported, ended => observer%ended)
         if (.not. path%is_reached(k)) values = ieee_value(1.0_wp, ieee_quiet_nan)
         values(2) = path%value(k)/case%unit
         values(reported + 1) = merge(1.0_wp, 0.0_wp, path%is_reached(k))
         values(ended - 1) = path%iterations(k)
         if (.not. path%is_reached(k)) return
         if (observer%has_stability) values(reported + 2) = merge(1.0_wp, 0.0_wp, path%is_stable(k))
         values(ended - 2) = merge(1.0_wp, 0.0_wp, path%pivot_ratio(k) < nearly_singular)
         call unpack_state(path%packed(:, k), state)
         call inputs_at(schedule, path%value(k), inputs)
         call fill_quantities(suspension, state, inputs, kkt, observer, observer%has_violation, needs_kandc, wheels, values)
         if (observer%has_violation) then
            values(ended) = sqrt(dot_product(kkt%values, kkt%values))
            if (values(ended) > open_joints) values(reported + 1) = 0.0_wp
         end if
      end associate
   end subroutine fill_row

   !> Computes the row of one state, as `observe` does, for a table of this observer. The first column, the number of the state, is
   !> left to the caller.
   subroutine observe_one(suspension, case, one, kkt, observer, row)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: one                       !! path of this one state
      type(kkt_t), intent(inout) :: kkt                     !! work space
      type(observer_t), intent(inout) :: observer           !! of make_observer
      real(wp), intent(out) :: row(:)                       !! of each column of the table
      type(attitude_t) :: wheels(size(suspension%wheels))
      type(state_t) :: state
      type(schedule_t) :: schedule
      real(wp) :: values(observer%ended)

      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (has_kandc(observer)) call begin_design(suspension, observer%kandc)
      call fill_row(suspension, case, one, 1, schedule, kkt, observer, has_kandc(observer), state, wheels, values)
      row = values(observer%kept)
   end subroutine observe_one

   !> Whether each state of a table was found by a linear method, but violates the joint constraints. Such a state has finite values
   !> and converged = 0.
   pure function open_states(table) result(is_open)
      type(table_t), intent(in) :: table         !! of `observe`
      logical :: is_open(size(table%values, 2))
      integer :: converged, violation

      converged = column_index(table, 'converged')
      violation = column_index(table, 'constraint_error')
      is_open = ieee_is_finite(table%values(violation, :)) .and. table%values(converged, :) < 0.5_wp
   end function open_states

   !> Fills the K&C quantities of a table created by `observe` with defers_kandc, at the states where they are read. At all other
   !> states the K&C quantities remain NaN.
   subroutine observe_kandc_at(is_read, suspension, case, path, kkt, observer, table)
      logical, intent(in) :: is_read(:)          !! of each row of the table
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(observer_t), intent(inout) :: observer   !! with which the table was made
      type(table_t), intent(inout) :: table
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      type(attitude_t), allocatable :: wheels(:)
      real(wp), allocatable :: values(:)         ! all columns of a row
      integer :: first, last, k, c, row

      if (are_checked) call require(size(is_read) == size(table%values, 2), 'observe_kandc_at: the table of another path')
      if (.not. (has_kandc(observer) .and. any(is_read))) return
      call reached_rows(path, first, last)
      allocate (wheels(size(suspension%wheels)), values(observer%ended))
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      call begin_design(suspension, observer%kandc)
      do k = first, last
         row = k - first + 1
         if (.not. (is_read(row) .and. path%is_reached(k))) cycle
         call unpack_state(path%packed(:, k), state)
         call inputs_at(schedule, path%value(k), inputs)
         call fill_quantities(suspension, state, inputs, kkt, observer, .false., .true., wheels, values)
         do c = 1, size(observer%kept)
            if (is_kandc_column(observer, c)) table%values(c, row) = values(observer%kept(c))
         end do
      end do
   end subroutine observe_kandc_at

   !> Computes the values of quantity_columns at one state, which is an equilibrium or close to one. The values equal the values in
   !> the table of `observe`.
   subroutine observe_state(suspension, state, inputs, kkt, observer, wheels, all_values, values)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                     !! work space
      type(observer_t), intent(inout) :: observer           !! of make_observer
      type(attitude_t), intent(inout) :: wheels(:)          !! work space, of each wheel
      real(wp), allocatable, intent(inout) :: all_values(:) !! work space
      real(wp), intent(out) :: values(:)                    !! of quantity_columns
      integer :: c

      if (.not. allocated(all_values)) allocate (all_values(observer%ended), source=0.0_wp)
      if (has_kandc(observer)) call begin_design(suspension, observer%kandc)
      call fill_quantities(suspension, state, inputs, kkt, observer, .false., has_kandc(observer), wheels, all_values)
      do c = 1, size(values)
         values(c) = all_values(observer%kept(c + 2))
      end do
   end subroutine observe_state

   !> The names of the quantities in the table: all columns except state and factor in front, and converged … at the end.
   pure function quantity_columns(observer) result(names)
      type(observer_t), intent(in) :: observer              !! of make_observer
      character(name_length), allocatable :: names(:)
      names = observer%columns(3:count(observer%kept <= observer%reported))
   end function quantity_columns

   !> Whether any column of the table is a K&C quantity. These quantities are computed together with the compliance matrix.
   pure logical function reads_matrix(observer)
      type(observer_t), intent(in) :: observer              !! of make_observer
      reads_matrix = has_kandc(observer)
   end function reads_matrix

   !> Whether a column of the table is a K&C quantity (ek_kandc_list).
   pure logical function is_kandc_column(observer, column)
      type(observer_t), intent(in) :: observer              !! of make_observer
      integer, intent(in) :: column                         !! index of a column of the table; 0: none
      is_kandc_column = column > 0
      if (is_kandc_column) is_kandc_column = observer%kept(column) > observer%shown .and. observer%kept(column) <= observer%reported
   end function is_kandc_column

   !> Whether all columns follow from the poses and the data of the wheels.
   pure logical function reads_poses_of_wheels(observer)
      type(observer_t), intent(in) :: observer              !! of make_observer
      reads_poses_of_wheels = .not. has_kandc(observer) .and. has_only_wheels(observer%list)
   end function reads_poses_of_wheels

   !> Whether K&C quantities are requested.
   pure logical function has_kandc(observer)
      type(observer_t), intent(in) :: observer
      has_kandc = observer%has_all
      if (has_kandc) has_kandc = size(observer%kandc%blocks) > 0
   end function has_kandc

   !> Fills the requested quantities of a state. begin_design must have been called.
   subroutine fill_quantities(suspension, state, inputs, kkt, observer, needs_violation, needs_kandc, wheels, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt
      type(observer_t), intent(inout) :: observer
      logical, intent(in) :: needs_violation                !! the constraint violation is wanted, in kkt%values
      logical, intent(in) :: needs_kandc                    !! so are the K&C quantities; only if has_kandc
      type(attitude_t), intent(inout) :: wheels(:)
      real(wp), intent(inout) :: values(:)                  !! all columns
      logical :: has_matrix, has_attitudes
      integer :: w, c

      has_matrix = .false.
      has_attitudes = has_wheels(observer%list)
      if (needs_kandc) then
         has_matrix = observer%kandc%is_matrix_wanted
         has_attitudes = has_attitudes .or. observer%kandc%has_wheels
      end if
      if (needs_kandc) then
         call assemble(suspension, state, inputs, merge(whole_tangent, residual_only, has_matrix), kkt)
      else if (needs_violation .or. has_joints(observer%list)) then
         call assemble_rows(suspension, state, inputs, kkt)
      end if
      if (has_attitudes) then
         do w = 1, size(wheels)
            associate (wheel => suspension%wheels(w))
               call find_attitude(wheel, suspension%bodies(wheel%body)%origin, state%poses(wheel%body + 1), wheels(w))
            end associate
         end do
      end if
      associate (shown => observer%shown)
         call state_values(suspension, state, wheels, kkt, observer%list, values(3:shown))
         if (.not. needs_kandc) return
         call fill_kandc(suspension, state, inputs, wheels, kkt, observer%kandc)
         do c = 1, size(observer%kandc%values)
            values(shown + c) = observer%kandc%values(c)
         end do
      end associate
   end subroutine fill_quantities

   !> Builds the table of a single path, like `observe`, but creates its observer.
   subroutine sweep_table(suspension, case, path, kkt, table, wanted)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(table_t), intent(out) :: table
      character(*), intent(in), optional :: wanted(:)   !! as for make_observer
      type(observer_t) :: observer

      if (present(wanted)) then           ! an absent array is not passed on: gfortran computes its bounds
         call make_observer(suspension, case, observer, wanted)
      else
         call make_observer(suspension, case, observer)
      end if
      call observe(suspension, case, path, kkt, observer, table)
   end subroutine sweep_table

   !> Lists the headings of the table of a case, as in observe.
   subroutine sweep_columns(suspension, case, columns)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), allocatable, intent(out) :: columns(:)
      type(column_list_t) :: list
      type(kandc_t) :: kandc

      call list_columns(suspension, case, columns, list, kandc)
   end subroutine sweep_columns

   !> Lists the headings, and prepares the K&C columns if the case requests them. The requested columns are marked afterwards.
   subroutine list_columns(suspension, case, columns, list, kandc)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), allocatable, intent(out) :: columns(:)
      type(column_list_t), intent(out) :: list          !! of the state itself
      type(kandc_t), intent(out) :: kandc
      integer :: shown, reported

      if (case%has_all) call list_kandc(suspension, kandc)
      call list_state(suspension, list)
      shown = 2 + list%used
      reported = shown + kandc%used
      allocate (columns(reported + ends_of(case)))
      columns(1) = 'state'
      columns(2) = 'factor'
      columns(3:shown) = list%names(:list%used)
      if (case%has_all) columns(shown + 1:reported) = kandc%names(:kandc%used)
      columns(reported + 1) = 'converged'
      if (knows_stability(case)) columns(reported + 2) = 'stable'
      columns(size(columns) - 2:) = [character(name_length) :: 'near_singular', 'iterations', 'constraint_error']
   end subroutine list_columns

   !> Whether the stability of the states is known. It is unknown for the recursive method, whose matrix does not contain the
   !> geometric stiffness.
   pure logical function knows_stability(case)
      type(case_t), intent(in) :: case
      knows_stability = case%method /= 'recursive'
   end function knows_stability

   !> Number of columns after the quantities: converged, stable, near_singular, iterations, constraint_error.
   pure integer function ends_of(case)
      type(case_t), intent(in) :: case
      ends_of = merge(5, 4, knows_stability(case))
   end function ends_of

   !> Memory for the sweep of a case and its table, with a margin [bytes].
   pure integer(i8) function sweep_bytes(suspension, case, observer) result(bytes)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(observer_t), intent(in) :: observer        !! of this case
      integer, parameter :: of_a_path = 6             ! numbers per state besides its coordinates
      integer(i8), parameter :: margin = 20000000_i8  ! bytes: all storage that does not grow with the states

      ! the table twice: working copy and result
      bytes = margin + 8*int(case%increments + 2 + most_places(case), i8)* &
         (coordinates(suspension) + of_a_path + 2*size(observer%columns))
   end function sweep_bytes

   !> Finds the first and last state in the table: all converged states, and one more of the schedule on a side that failed. If no
   !> state converged, both are the design state. For a load table, every row is included.
   pure subroutine reached_rows(path, first, last)
      type(path_t), intent(in) :: path
      integer, intent(out) :: first, last

      first = findloc(path%is_reached, .true., dim=1)
      last = findloc(path%is_reached, .true., dim=1, back=.true.)
      if (path%is_table) then
         first = 1
         last = path%states
      else if (last == 0) then     ! no state: the design state has failed
         first = max(path%start, 1)
         last = first
      else
         first = scheduled_from(max(first - 1, 1), -1)
         last = scheduled_from(min(last + 1, path%states), 1)
      end if

   contains

      !> The first state of the schedule from state k on, in a direction. The ends of a path are of the schedule.
      pure integer function scheduled_from(k, direction) result(state)
         integer, intent(in) :: k, direction

         state = k
         if (.not. allocated(path%is_scheduled)) return
         do while (.not. path%is_scheduled(state))
            state = state + direction
         end do
      end function scheduled_from

   end subroutine reached_rows

end module ek_sweep_table
