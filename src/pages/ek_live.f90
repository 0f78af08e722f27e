!> The part of a report that recomputes itself for other rates (`report --live`): the rates, and the data that the page script needs
!> for each state.
module ek_live
   use ek_kinds, only: wp
   use ek_text, only: is_like
   use ek_suspension, only: suspension_t
   use ek_schedule, only: new_schedule
   use ek_case_result, only: case_result_t
   use ek_live_rates, only: live_rates_t, choose_rates
   use ek_live_state, only: live_state_t, live_columns_t, start_live, find_live_state
   use ek_table, only: name_length, column_index
   use ek_quantity, only: charted
   use ek_test_result, only: test_result_t, design_row
   implicit none(type, external)
   private
   public :: live_t, live_test_t, add_live

   real(wp), parameter, public :: slider_end = 10.0_wp      !! a slider goes from 1/10 of a rate to 10 times the rate (live.js)

   !> The columns of a test at its states, or at the design state alone.
   type :: live_test_t
      character(:), allocatable :: name
      character(name_length), allocatable :: column(:)
      logical, allocatable :: is_held(:), is_inverse(:)      !! kind of each column (live_columns_t)
      real(wp), allocatable :: value(:, :)                   !! values of the columns, as in the table: (column, state)
      type(live_state_t), allocatable :: state(:)
      integer, allocatable :: shown(:)                       !! states for which the page gives the displacement with other rates
      logical :: holds_heights = .false.                     !! the test holds or drives the heights of the wheels
   end type live_test_t

   !> Data for the sliders: the rates, the design state and the tests.
   type :: live_t
      integer :: most = 0                                    !! largest number of rates
      type(live_rates_t), allocatable :: rates
      character(:), allocatable :: balance                   !! preload trim of another run; 'height', 'loads': see ek_start
      type(live_test_t) :: design
      type(live_test_t), allocatable :: tests(:)             !! tests with columns that follow the rates
      integer :: reruns = 0, failed = 0                      !! runs that were compared with the page; runs without a result
      real(wp) :: deviation = 0.0_wp                         !! largest deviation of a number of the page from a run [-]
      character(:), allocatable :: worst                     !! its column; not allocated without a deviation
      real(wp), allocatable :: worst_factor(:)               !! its factors of the rates
      real(wp) :: worst_values(2) = 0.0_wp                   !! its values of the page and of the run, in the unit of the column
   end type live_t

contains

   !> Adds a test that was solved. The first test with a solved design state provides the rates and the design state; earlier
   !> tests are omitted. All tests are omitted while there are no rates. A test without columns that follow the rates is not
   !> added.
   subroutine add_live(result, test, live)
      type(case_result_t), intent(inout) :: result           !! is_run
      type(test_result_t), intent(in) :: test                !! name and kind of the test
      type(live_t), intent(inout) :: live
      character(24), parameter :: of_design(*) = [character(24) :: '*_load_held_*', '*_height_held_*', '*_rate_n_per_mm', &
         '*_stiffness_n_per_mm', 'wheel_rate_n_per_mm', 'ride_rate_n_per_mm']
      type(live_test_t) :: new
      type(live_rates_t) :: rates
      character(48), allocatable :: columns(:)
      character(49), allocatable :: names(:)
      integer :: k

      if (.not. allocated(live%tests)) allocate (live%tests(0))
      associate (path => result%path)
         if (.not. allocated(live%rates)) then
            if (path%start == 0) return
            if (.not. path%is_reached(path%start)) return
            call choose_rates(result, path%start, live%most, rates)
            if (size(rates%rate) == 0) return
            allocate (live%rates, source=rates)
            live%balance = result%suspension%balance
            if (live%balance == 'none' .and. carries_force(result%suspension)) live%balance = 'height'
            if (any(result%suspension%start == [character(10) :: 'loads', 'wheel_load', 'added_mass'])) live%balance = 'loads'
            call find_test(result, test, rates, of_design, [design_row(result%table)], live%design)
         end if
         allocate (columns, source=charted(test%kind))
         allocate (names(size(columns)))
         do k = 1, size(names)
            names(k) = '*'//columns(k)
         end do
         call find_test(result, test, live%rates, names, [(k, k=1, size(result%table%values, 2))], new)
      end associate
      if (size(new%column) > 0) live%tests = [live%tests, new]
   end subroutine add_live

   !> Finds the columns of a test that match a list of names with * and follow the rates, and the data of their states, at the
   !> given rows of the table.
   subroutine find_test(result, test, rates, names, rows, self)
      type(case_result_t), intent(inout) :: result
      type(test_result_t), intent(in) :: test
      type(live_rates_t), intent(in) :: rates
      character(*), intent(in) :: names(:)
      integer, intent(in) :: rows(:)
      type(live_test_t), intent(out) :: self
      type(live_columns_t) :: columns
      logical, allocatable :: is_known(:)
      integer :: j, c, k, at, counter

      self%name = test%name
      self%holds_heights = index(test%held, 'height') > 0 .or. index(test%held, 'road') > 0 .or. &
         index(test%kind, 'travel') > 0
      counter = column_index(result%table, 'state')
      ! only what the table has: no ride rate without a tyre
      is_known = [(any([(is_like(trim(result%table%columns(c)), trim(names(k))), k=1, size(names))]), &
         c=1, size(result%table%columns))]
      call start_live(result%suspension, rates, pack(result%table%columns, is_known), columns)
      self%column = columns%name
      self%is_held = columns%is_held
      self%is_inverse = columns%is_inverse
      allocate (self%value(size(self%column), size(rows)), self%state(size(rows)), self%shown(0))
      if (size(self%column) == 0) return
      do j = 1, size(rows)
         k = nint(result%table%values(counter, rows(j))) + 1
         if (.not. result%path%is_reached(k)) cycle
         call find_live_state(result%suspension, new_schedule(result%suspension, result%case), result%path, k, result%kkt, &
            columns, self%state(j))
         do c = 1, size(self%column)
            at = column_index(result%table, self%column(c))
            self%value(c, j) = result%table%values(at, rows(j))
         end do
         if (self%state(j)%is_known) self%shown = [self%shown, j]
      end do
      if (size(self%shown) > 1) self%shown = [self%shown(1), self%shown(size(self%shown))]
   end subroutine find_test

   !> Whether the rig carries a force that holds the wheels in the start state (ek_start).
   pure logical function carries_force(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: k

      carries_force = suspension%start == 'height' .and. any([(suspension%loads(k)%start_of > 0 .and. &
         norm2(suspension%loads(k)%force) > 0.0_wp, k=1, size(suspension%loads))])
   end function carries_force

end module ek_live
