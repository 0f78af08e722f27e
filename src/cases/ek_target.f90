!> The swept value at which a result has a target value, for instance the travel at which a spring length is 250 mm.
module ek_target
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck, exit_convergence
   use ek_text, only: str, quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, design_state, pack_state
   use ek_schedule, only: schedule_t, new_schedule
   use ek_kkt, only: kkt_t
   use ek_reach, only: failure_t, reach
   use ek_path, only: path_t
   use ek_branch, only: branch_t, new_branch, leave
   use ek_quantity, only: unit_of, column_hint
   use ek_table, only: table_t, column, column_range, row_count
   use ek_remark, only: swept_text
   use ek_sweep_table, only: sweep_table
   implicit none(type, external)
   private
   public :: target_t, find_target, find_column

   !> The target, and the swept value that meets it.
   type :: target_t
      character(:), allocatable :: column    !! full name of the column, with unit
      real(wp) :: wanted = 0.0_wp            !! target value, in the unit of the column
      real(wp) :: place = 0.0_wp             !! swept value at which the column has the target value, SI
      integer :: crossings = 0               !! number of crossings of the value in the sweep; the nearest to design is used
      type(table_t) :: table                 !! table of the state at this swept value, one row
   end type target_t

contains

   !> Searches a sweep of method `equilibrium` for case%target, 'column=value', and solves for the swept value between the states of
   !> the sweep.
   !>
   !> The unit of the column may be omitted if only one column has this name with a unit. If there are several solutions, the
   !> solution nearest to design is used. A jump of the column across the value, as at a pole, is not a solution. Errors: exit_deck
   !> if there is no such column; exit_convergence if the sweep does not reach the value.
   subroutine find_target(suspension, case, path, table, kkt, found, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(table_t), intent(in) :: table       !! of the sweep
      type(kkt_t), intent(inout) :: kkt
      type(target_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error
      logical :: is_crossing(row_count(table)), is_jump
      real(wp) :: place(row_count(table)), range(2)
      character(:), allocatable :: words
      integer :: c, k, status

      k = index(case%target, '=')
      read (case%target(k + 1:), *, iostat=status) found%wanted      ! the reader has checked that it is a number
      call find_column(table%columns, trim(adjustl(case%target(:k - 1))), c, error)
      if (allocated(error)) then
         error%message = case%where//': case '//quoted(case%name)//': target: '//error%message
         return
      end if
      found%column = trim(table%columns(c))

      call find_crossings(path, table, c, found%wanted, is_crossing, place)
      do while (any(is_crossing))
         found%crossings = count(is_crossing)
         k = minloc(abs(place), dim=1, mask=is_crossing)
         call close_in(suspension, case, path, table, c, k, kkt, found, is_jump, error)
         if (allocated(error) .or. .not. is_jump) return
         is_crossing(k) = .false.
      end do
      range = column_range(table, found%column)
      words = '; the column has no value in any state'
      if (ieee_is_finite(range(1))) words = '; its range over the case is '//str(range(1), 6)//' to '//str(range(2), 6)
      call fail(error, exit_convergence, 'case '//quoted(case%name)//': target: '//found%column//' is never '// &
         str(found%wanted)//words)
   end subroutine find_target

   !> Marks each row that has the target value, and each row after which the column crosses the target value before the next row.
   !> Estimates the swept value at each crossing.
   subroutine find_crossings(path, table, c, wanted, is_crossing, place)
      type(path_t), intent(in) :: path
      type(table_t), intent(in) :: table
      integer, intent(in) :: c                       !! column
      real(wp), intent(in) :: wanted
      logical, intent(out) :: is_crossing(:)         !! one per row
      real(wp), intent(out) :: place(:)              !! swept value at a crossing, SI
      real(wp) :: f, next
      integer :: row

      is_crossing = .false.
      place = 0.0_wp
      do row = 1, row_count(table)
         if (.not. ieee_is_finite(table%values(c, row))) cycle      ! not reached, or not defined in this state
         f = table%values(c, row) - wanted
         place(row) = path%value(state_of(table, row))
         is_crossing(row) = abs(f) <= 0.0_wp
         if (is_crossing(row) .or. row == row_count(table)) cycle
         if (.not. ieee_is_finite(table%values(c, row + 1))) cycle
         next = table%values(c, row + 1) - wanted
         if (abs(next) <= 0.0_wp .or. (f > 0.0_wp .eqv. next > 0.0_wp)) cycle
         is_crossing(row) = .true.
         place(row) = place(row) + (path%value(state_of(table, row + 1)) - place(row))*(f/(f - next))
      end do
   end subroutine find_crossings

   !> Index of the state of the path in a row of its table.
   pure integer function state_of(table, row)
      type(table_t), intent(in) :: table
      integer, intent(in) :: row
      state_of = nint(table%values(1, row)) + 1     ! the table counts from 0
   end function state_of

   !> Solves for the swept value between a row and the next row: regula falsi with the Illinois rule, which halves the weight of an
   !> end that stays.
   subroutine close_in(suspension, case, path, table, c, row, kkt, found, is_jump, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(table_t), intent(in) :: table
      integer, intent(in) :: c, row
      type(kkt_t), intent(inout) :: kkt
      type(target_t), intent(inout) :: found
      logical, intent(out) :: is_jump          !! the column jumps across the value, as at a pole
      type(error_t), allocatable, intent(out) :: error
      integer, parameter :: max_steps = 80
      real(wp), parameter :: min_step = 1.0e-6_wp   ! of the distance between the two states
      real(wp), parameter :: enough = 1.0e-9_wp   ! of the difference between the two states
      real(wp), parameter :: jump = 1.0e-3_wp     ! likewise: a smooth result is nearer once the interval has closed
      type(path_t) :: here
      type(schedule_t) :: schedule
      type(branch_t) :: branch
      real(wp) :: low, high, f_low, f_high, middle, f, span
      integer :: first, second, step, last_side

      is_jump = .false.
      first = state_of(table, row)
      second = min(first + 1, path%states)
      call one_state(path, first, here)
      schedule = new_schedule(suspension, case)
      branch = new_branch(suspension)
      branch%least = min_step*abs(path%value(second) - path%value(first))
      low = path%value(first)
      f_low = table%values(c, row) - found%wanted
      if (abs(f_low) <= 0.0_wp) then
         call look_at(low)
         found%place = low
         call sweep_table(suspension, case, here, kkt, found%table)
         return
      end if
      high = path%value(second)
      f_high = table%values(c, row + 1) - found%wanted
      span = max(abs(f_low), abs(f_high))
      last_side = 0
      do step = 1, max_steps
         middle = high - f_high*(high - low)/(f_high - f_low)
         call look_at(middle)
         if (allocated(error)) return
         if (abs(f) <= enough*span) exit
         if (f > 0.0_wp .eqv. f_high > 0.0_wp) then
            high = middle
            f_high = f
            if (last_side == 1) f_low = 0.5_wp*f_low
            last_side = 1
         else
            low = middle
            f_low = f
            if (last_side == -1) f_high = 0.5_wp*f_high
            last_side = -1
         end if
         if (abs(high - low) <= 4.0_wp*epsilon(1.0_wp)*max(abs(low), abs(high))) exit
      end do
      is_jump = abs(f) > jump*span
      found%place = middle
      call sweep_table(suspension, case, here, kkt, found%table)

   contains

      !> Solves the equilibrium at a swept value, from the nearer state of the sweep, and computes the difference to the target
      !> value.
      subroutine look_at(place)
         real(wp), intent(in) :: place
         type(state_t) :: state
         type(failure_t) :: failure
         real(wp) :: value(1)
         integer :: from

         from = first
         if (abs(path%value(second) - place) < abs(path%value(first) - place)) from = second
         state = design_state(suspension)
         call leave(branch, path%value(from), path%packed(:, from), -1)
         call reach(suspension, schedule, place, case%tolerance, branch, state, kkt, &
            here%iterations(1), failure)
         here%value(1) = place
         here%is_reached(1) = failure%state == 0
         here%is_stable(1) = kkt%negative == kkt%nc
         here%pivot_ratio(1) = kkt%pivot_ratio
         call pack_state(state, here%packed(:, 1))
         call sweep_table(suspension, case, here, kkt, found%table, wanted=table%columns(c:c))
         value = column(found%table, found%column)
         f = 0.0_wp
         if (ieee_is_finite(value(1))) then
            f = value(1) - found%wanted
         else
            call fail(error, exit_convergence, 'case '//quoted(case%name)//': target: '//found%column// &
               ' has no value at '//swept_text(case, place, 9))
         end if
      end subroutine look_at

   end subroutine close_in

   !> Reduces a path to one state.
   subroutine one_state(path, k, here)
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(path_t), intent(out) :: here

      here%states = 1
      here%start = 0
      here%value = path%value(k:k)
      here%packed = path%packed(:, k:k)
      here%is_reached = path%is_reached(k:k)
      here%is_stable = path%is_stable(k:k)
      here%iterations = path%iterations(k:k)
      here%pivot_ratio = path%pivot_ratio(k:k)
      here%settled = path%settled
   end subroutine one_state

   !> Finds the column with this name, or the only column whose name is this name with a unit.
   subroutine find_column(columns, name, place, error)
      character(*), intent(in) :: columns(:)
      character(*), intent(in) :: name
      integer, intent(out) :: place
      type(error_t), allocatable, intent(out) :: error       !! exit_deck: no such column, or more than one
      integer, parameter :: most = 4
      logical :: is_alike(size(columns)), is_near(size(columns))
      character(:), allocatable :: hint
      integer :: k

      place = findloc(columns, name, dim=1)
      if (place > 0) return
      is_alike = [(columns(k) == name//'_'//unit_of(trim(columns(k))), k=1, size(columns))]
      place = findloc(is_alike, .true., dim=1)
      if (count(is_alike) == 1) return
      if (place > 0) then
         call fail(error, exit_deck, quoted(name)//" may be '"//listed(pack(columns, is_alike), "' and '")//"'; give the full name")
         return
      end if
      is_near = index(columns, name) > 0            ! as left_coil_length_mm contains coil_length
      hint = column_hint(name, columns)
      if (hint == '' .and. any(is_near)) then
         hint = ' (columns with this in their name: '//listed(pack(columns, is_near .and. [(count(is_near(:k)) <= most, &
            k=1, size(columns))]), ', ')//repeat(', …', merge(1, 0, count(is_near) > most))//')'
      end if
      call fail(error, exit_deck, 'the results have no column '//quoted(name)//hint)
   end subroutine find_column

   !> A list of names with a separator between them, as a string.
   pure function listed(names, between) result(text)
      character(*), intent(in) :: names(:), between
      character(:), allocatable :: text
      integer :: k

      text = trim(names(1))
      do k = 2, size(names)
         text = text//between//trim(names(k))
      end do
   end function listed

end module ek_target
