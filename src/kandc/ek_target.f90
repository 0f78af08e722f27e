!> The place on a path at which a result has a wanted value: the travel that gives a spring length of 250 mm.
module ek_target
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck, exit_convergence
   use ek_text, only: str, quoted, nearest_name
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, demand_t, design_state, pack_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, demand_at
   use ek_kkt, only: kkt_t
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_path, only: path_t
   use ek_table, only: table_t, column_index, row_count
   use ek_sweep_table, only: sweep_table
   implicit none(type, external)
   private
   public :: target_t, find_target

   !> What was looked for, and where it is.
   type :: target_t
      character(:), allocatable :: column    !! its full name, with unit
      real(wp) :: wanted = 0.0_wp            !! in that unit
      real(wp) :: place = 0.0_wp             !! on the path, SI
      integer :: crossings = 0               !! how often the sweep passes the value; the one nearest design counts
      type(table_t) :: table                 !! the state there, one row
   end type target_t

contains

   !> Looks along a sweep for case%target, 'column=value', and solves for the place between its states.
   !>
   !> The column may be named without its unit when only one begins so. Errors: exit_deck, no such column;
   !> exit_convergence, the sweep never has the value.
   subroutine find_target(suspension, case, path, table, kkt, found, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(table_t), intent(in) :: table       !! of the sweep
      type(kkt_t), intent(inout) :: kkt
      type(target_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error
      integer, parameter :: most_steps = 80
      real(wp), parameter :: enough = 1.0e-9_wp   ! of the difference between the two states at hand
      type(path_t) :: here
      type(schedule_t) :: schedule
      real(wp) :: low, high, f_low, f_high, middle, f, span
      integer :: c, k, row, best, first, step, last_side, status

      k = index(case%target, '=')
      read (case%target(k + 1:), *, iostat=status) found%wanted
      call find_column(table, trim(adjustl(case%target(:k - 1))), c, error)
      if (allocated(error)) then
         error%message = case%where//': case '//quoted(case%name)//': target: '//error%message
         return
      end if
      found%column = trim(table%columns(c))

      best = 0
      do row = 1, row_count(table) - 1
         first = nint(table%values(1, row)) + 1     ! the states of the path are counted from 1
         if (.not. (path%is_reached(first) .and. path%is_reached(first + 1))) cycle
         if ((table%values(c, row) - found%wanted)*(table%values(c, row + 1) - found%wanted) > 0.0_wp) cycle
         found%crossings = found%crossings + 1
         if (best > 0) then
            if (abs(path%value(first)) >= abs(path%value(nint(table%values(1, best)) + 1))) cycle
         end if
         best = row
      end do
      if (best == 0) then
         call fail(error, exit_convergence, 'case '//quoted(case%name)//': target: '//found%column//' is never '// &
            str(found%wanted)//'; over the case it goes from '//str(table%values(c, 1), 6)//' to '// &
            str(table%values(c, row_count(table)), 6))
         return
      end if

      first = nint(table%values(1, best)) + 1
      call one_state(path, first, here)
      schedule = new_schedule(suspension, case)
      low = path%value(first)
      high = path%value(first + 1)
      f_low = table%values(c, best) - found%wanted
      f_high = table%values(c, best + 1) - found%wanted
      span = max(abs(f_low), abs(f_high), tiny(1.0_wp))
      last_side = 0
      middle = low
      if (abs(f_low) > abs(f_high)) middle = high
      f = huge(f)
      ! regula falsi; an end that stays is given half its weight (the Illinois rule)
      do step = 1, most_steps
         if (abs(f_high - f_low) > 0.0_wp) middle = high - f_high*(high - low)/(f_high - f_low)
         call look_at(middle)
         if (abs(f) <= enough*span) exit
         if (f*f_high > 0.0_wp) then
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
      found%place = middle

   contains

      !> Equilibrium at a place, from the state found last, and its distance to the wanted value.
      subroutine look_at(place)
         real(wp), intent(in) :: place
         type(state_t) :: state
         type(demand_t) :: demand
         type(outcome_t) :: outcome

         state = design_state(suspension)
         call unpack_state(here%packed(:, 1), state)
         call demand_at(schedule, place, demand)
         call find_equilibrium(suspension, demand, case%tolerance, state, kkt, outcome)
         here%value(1) = place
         here%iterations(1) = outcome%factorisations
         here%is_reached(1) = outcome%is_converged
         here%is_stable(1) = outcome%negative == kkt%nc
         here%pivot_ratio(1) = outcome%pivot_ratio
         call pack_state(state, here%packed(:, 1))
         call sweep_table(suspension, case, here, kkt, found%table)
         f = found%table%values(c, 1) - found%wanted
      end subroutine look_at

   end subroutine find_target

   !> A path of which only one state is left.
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

   !> The column of this name, or the only one that is this name with a unit behind it.
   subroutine find_column(table, name, place, error)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      integer, intent(out) :: place
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: hint
      integer :: k, alike

      place = column_index(table, name)
      if (place > 0) return
      alike = 0
      do k = 1, size(table%columns)
         if (index(table%columns(k), name//'_') /= 1) cycle
         if (.not. is_unit(trim(table%columns(k)(len(name) + 2:)))) cycle
         place = k
         alike = alike + 1
      end do
      if (alike == 1) return
      hint = nearest_name(name, table%columns)
      if (hint /= '') hint = ' (did you mean '//quoted(hint)//'?)'
      call fail(error, exit_deck, 'the results have no column '//quoted(name)//hint)
   end subroutine find_column

   !> 'mm', 'deg', 'n_per_mm' …
   pure logical function is_unit(text)
      character(*), intent(in) :: text
      is_unit = any(text == [character(10) :: 'mm', 'deg', 'n', 'nm', 'm', 'percent']) .or. index(text, '_per_') > 0
   end function is_unit

end module ek_target
