!> From the states of a sweep to tables, one row per state: the quantities of a case, and the compliance matrix.
!>
!> The columns come from ek_state_columns and ek_kandc_columns, between `state` and `factor` in front and `converged`,
!> `iterations` and `constraint_error` at the end.
module ek_sweep_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8, degree
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state, coordinates
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_path, only: path_t
   use ek_state_columns, only: state_columns, state_values
   use ek_column_list, only: column_list_t, choose
   use ek_kandc_columns, only: kandc_t, start_kandc, same_columns, observe_kandc
   use ek_table, only: table_t, new_table, name_length
   use ek_block, only: rotated
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance, load_at_patch, read_at_patch
   implicit none(type, external)
   private
   public :: observer_t, make_observer, observe, nearly_singular, sweep_table, sweep_columns, sweep_bytes, compliance_table, &
      state_compliance

   real(wp), parameter :: nearly_singular = 1.0e-12_wp   !! smallest over largest pivot: four digits are left
   real(wp), parameter :: open_joints = 1.0e-2_wp   !! |Φ| [m, rad] above which a state of a linear method is marked converged = 0

   !> What a table of states holds: its columns, and the work space to fill them.
   type :: observer_t
      character(name_length), allocatable :: columns(:)     !! heads of the table
      integer, private :: shown = 0, reported = 0, ended = 0    !! last column of the state, of the quantities, of all
      integer, allocatable, private :: kept(:)              !! the columns of the table among all
      logical, allocatable, private :: is_kept(:)
      type(column_list_t), private :: list                  !! columns of the state
      type(kandc_t), private :: kandc                       !! K&C columns, if the case requests them
      character(name_length), allocatable, private :: wanted(:)
      logical, private :: has_wanted = .false., has_all = .false., has_stability = .false.
   end type observer_t

   character(*), parameter :: places(2) = [character(7) :: 'centre_', 'patch_']
   character(*), parameter :: moves(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz'], &
      loads(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']

contains

   !> Prepares the table of a case. Nothing is done where it is prepared for this model, case and these columns already; so in
   !> designs after the first there is no text at all: gfortran keeps the length of the text that a function returns in one
   !> place for all threads.
   subroutine make_observer(suspension, case, self, wanted)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(case_t), intent(in) :: case
      type(observer_t), intent(inout) :: self
      character(*), intent(in), optional :: wanted(:)   !! columns; a name that the model does not define has no effect
      character(name_length), allocatable :: columns(:), asked(:)
      integer :: k

      allocate (asked(merge(1, 0, present(wanted))))
      if (present(wanted)) asked = wanted
      if (is_for(self, suspension, case, asked, present(wanted))) return
      call list_columns(suspension, case, columns, self%list, self%kandc)
      self%has_all = case%has_all
      self%has_stability = knows_stability(case)
      self%ended = size(columns)
      self%reported = self%ended - ends_of(case)
      self%shown = self%reported - self%kandc%used
      if (allocated(self%is_kept)) deallocate (self%is_kept)
      allocate (self%is_kept(self%ended), source=.true.)
      self%wanted = asked
      self%has_wanted = present(wanted)
      if (self%has_wanted) self%is_kept(3:self%reported) = [(any(self%wanted == columns(k)), k=3, self%reported)]
      self%kept = pack([(k, k=1, self%ended)], self%is_kept)
      self%columns = columns(self%kept)
      if (self%kandc%used > 0) call choose(self%kandc, self%is_kept(self%shown + 1:self%reported))
   end subroutine make_observer

   !> Whether an observer was prepared for these columns of such a model.
   logical function is_for(self, suspension, case, asked, has_asked)
      type(observer_t), intent(in) :: self
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), intent(in) :: asked(:)
      logical, intent(in) :: has_asked                  !! else: all columns

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

   !> The table of a sweep: all states that were reached, and on either side the first that was not,
   !> marked by converged = 0 and values that are not numbers.
   !>
   !> If the case requests all columns, the K&C quantities precede the last columns, from the compliance matrix
   !> at every state; it is solved only if one of the columns of the observer needs it.
   subroutine observe(suspension, case, path, kkt, observer, table)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(observer_t), intent(inout) :: observer   !! of make_observer
      type(table_t), intent(out) :: table
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      real(wp), allocatable :: values(:)         ! all columns of a row
      integer :: first, last, k, row

      call reached_rows(path, first, last)
      table = new_table(observer%columns, last - first + 1)
      allocate (values(observer%ended))
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      associate (shown => observer%shown, reported => observer%reported, ended => observer%ended)
         do k = first, last
            row = k - first + 1
            call inputs_at(schedule, path%value(k), inputs)
            values = ieee_value(1.0_wp, ieee_quiet_nan)
            values(1) = k - 1
            values(2) = path%value(k)/case%unit
            values(reported + 1) = merge(1.0_wp, 0.0_wp, path%is_reached(k))
            values(ended - 1) = path%iterations(k)
            if (path%is_reached(k)) then
               if (observer%has_stability) values(reported + 2) = merge(1.0_wp, 0.0_wp, path%is_stable(k))
               values(ended - 2) = merge(1.0_wp, 0.0_wp, path%pivot_ratio(k) < nearly_singular)
               call unpack_state(path%packed(:, k), state)
               call assemble(suspension, state, inputs, residual_only, kkt)
               if (any(observer%is_kept(3:shown))) call state_values(suspension, state, kkt, observer%list, values(3:shown))
               values(ended) = norm2(kkt%values)
               if (norm2(kkt%values) > open_joints) values(reported + 1) = 0.0_wp
               if (any(observer%is_kept(shown + 1:reported))) then
                  call observe_kandc(suspension, state, inputs, kkt, observer%kandc)
                  values(shown + 1:reported) = observer%kandc%values
               end if
            end if
            table%values(:, row) = values(observer%kept)
         end do
      end associate
   end subroutine observe

   !> The table of a single path, as observe with an observer of its own.
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

   !> The heads of the table of a case, as in observe.
   subroutine sweep_columns(suspension, case, columns)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), allocatable, intent(out) :: columns(:)
      type(column_list_t) :: list
      type(kandc_t) :: kandc

      call list_columns(suspension, case, columns, list, kandc)
   end subroutine sweep_columns

   !> The heads, and the work space of the K&C columns if the case requests them.
   subroutine list_columns(suspension, case, columns, list, kandc)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(name_length), allocatable, intent(out) :: columns(:)
      type(column_list_t), intent(out) :: list          !! of the state itself
      type(kandc_t), intent(out) :: kandc
      integer :: shown, reported

      if (case%has_all) call start_kandc(suspension, kandc)
      call state_columns(suspension, list)
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

   !> Whether stability is known: the matrix of the recursive method has no geometric stiffness.
   pure logical function knows_stability(case)
      type(case_t), intent(in) :: case
      knows_stability = case%method /= 'recursive'
   end function knows_stability

   !> Columns after the quantities: converged, stable, near_singular, iterations, constraint_error.
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
      bytes = margin + 8*int(case%increments + 2, i8)*(coordinates(suspension) + of_a_path + 2*size(observer%columns))
   end function sweep_bytes

   !> The states in the table: those reached, and one more on a side that failed; of a load table every row.
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
         first = max(first - 1, 1)
         last = min(last + 1, path%states)
      end if
   end subroutine reached_rows

   !> The compliance matrix at every converged state of a sweep as a table: one row per state, one column per entry.
   !>
   !> A column is called <place>_<displacement>_by_<load>_<unit>: displacement and load begin with the wheel (`left_`, `right_`),
   !> then x, y, z (displacements), rx, ry, rz (rotations), fx, fy, fz (forces), mx, my, mz (moments), in the frame of the deck.
   !> `centre`: loads and displacements at the wheel centres; `patch`: at the contact points of the deck. Loads keep their
   !> direction; the vertical force on all wheels is held, heights held by the rig are released (ek_compliance). No wheel: none.
   subroutine compliance_table(suspension, case, path, kkt, table)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(table_t), intent(out) :: table
      type(compliance_t) :: compliance
      type(schedule_t) :: schedule
      real(wp), allocatable :: c(:, :), scale(:), arm(:, :)
      integer :: n, k, row

      compliance = new_compliance(suspension, .false.)
      n = 6*compliance%wheels
      allocate (c(n, n), scale(n), arm(3, compliance%wheels))
      scale = [(deck_frame(suspension), k=1, n/3)]
      table = new_table(columns_of(suspension, compliance), count(path%is_reached))
      schedule = new_schedule(suspension, case)
      row = 0
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         row = row + 1
         table%values(1, row) = k - 1
         table%values(2, row) = path%value(k)/case%unit
         call state_compliance(suspension, schedule, path, k, kkt, compliance, c, arm)
         call put(c, scale, table%values(3:2 + n*n, row))
         call put(read_at_patch(load_at_patch(c, arm), arm), scale, table%values(3 + n*n:2 + 2*n*n, row))
      end do
   end subroutine compliance_table

   !> The compliance matrix at one converged state of a sweep, at the wheel centres: x rearward, y right, z up
   !> [m/N, rad/N, m/(N m), rad/(N m)]; not a number where the matrix is singular.
   subroutine state_compliance(suspension, schedule, path, k, kkt, compliance, c, arm)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(schedule_t), intent(in) :: schedule          !! of the case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k                          !! the state
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(compliance_t), intent(inout) :: compliance   !! work space, of new_compliance
      real(wp), intent(out) :: c(:, :)                  !! 6 × wheels, left before right
      real(wp), intent(out) :: arm(:, :)                !! from each centre to the contact point of the deck [m]
      type(state_t) :: state
      type(inputs_t) :: inputs
      integer :: w

      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
      call inputs_at(schedule, path%value(k), inputs)
      call wheel_compliance(suspension, state, inputs, 0, kkt, compliance)
      do w = 1, compliance%wheels
         associate (wheel => suspension%wheels(compliance%order(w)))
            arm(:, w) = rotated(state%poses(wheel%body + 1)%a, wheel%contact - wheel%centre)
         end associate
      end do
      c = compliance%response(:size(c, 1), :size(c, 2))
   end subroutine state_compliance

   !> The entries of a matrix, row by row, in the units of the columns and the frame of the deck.
   pure subroutine put(c, frame, values)
      real(wp), intent(in) :: c(:, :)            !! SI
      real(wp), intent(in) :: frame(:)           !! sign of every direction
      real(wp), intent(inout) :: values(:)
      integer :: i, j, at

      at = 0
      do i = 1, size(c, 1)
         do j = 1, size(c, 2)
            at = at + 1
            values(at) = frame(i)*frame(j)*c(i, j)/(merge(1.0e-3_wp, degree, mod(i - 1, 6) < 3)/ &      ! mm or deg
               merge(1.0e3_wp, 1.0e2_wp, mod(j - 1, 6) < 3))                                             ! per kN or 100 N m
         end do
      end do
   end subroutine put

   !> 'state', 'factor', then every entry of both matrices, row by row.
   function columns_of(suspension, compliance) result(names)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      character(name_length), allocatable :: names(:)
      character(:), allocatable :: unit
      integer :: n, p, i, j, at

      n = 6*compliance%wheels
      allocate (names(2 + 2*n*n))
      names(1) = 'state'
      names(2) = 'factor'
      at = 2
      do p = 1, 2
         do i = 1, n
            do j = 1, n
               unit = trim(merge('mm ', 'deg', mod(i - 1, 6) < 3))//'_per_'//trim(merge('kn   ', '100nm', mod(j - 1, 6) < 3))
               at = at + 1
               names(at) = trim(places(p))//prefix_of(suspension, compliance%order((i + 5)/6))//trim(moves(mod(i - 1, 6) + 1))// &
                  '_by_'//prefix_of(suspension, compliance%order((j + 5)/6))//loads(mod(j - 1, 6) + 1)//'_'//unit
            end do
         end do
      end do
   end function columns_of

end module ek_sweep_table
