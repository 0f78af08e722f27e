!> Key numbers of a deck by their names: only the tests that they need are solved, of these only the states and columns that they
!> need, and each is equal to the bit to that in key_numbers.csv of the report.
!>
!>     call prepare_numbers(names, suspension, cases, numbers, error)      once per deck
!>     call read_numbers(numbers, suspension, cases, values, is_whole)     for each design
!>
!> `cases` are those that the report solves, in its order (standard_tests). read_numbers makes no text, so that several threads may
!> read numbers, each with a value of its own type.
module ek_named_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, millimetre, degree
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_model, exit_convergence
   use ek_text, only: quoted, nearest_name
   use ek_rig_test, only: rig_test_t, rig_test, moves_heights, rolls, steers, of_one_wheel
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig, only: mount, mount_case
   use ek_table, only: name_length, new_table
   use ek_sweep_table, only: observer_t, sweep_columns
   use ek_case_result, only: case_result_t, solve_options_t, solve_mounted
   use ek_failure_text, only: failure_text
   use ek_test_result, only: test_result_t, find_wheels
   use ek_gradient, only: gradient_t, test_gradients
   use ek_gradient_definition, only: windows_t
   use ek_planned_test, only: planned_tests
   use ek_key_number, only: key_number_t, key_source_t, nothing, read_source, needs_path, at_design, largest_of_all
   use ek_key_numbers, only: list_key_numbers, number_heads, wanted_gradients
   implicit none(type, external)
   private
   public :: named_numbers_t, prepare_numbers, read_numbers, list_numbers, needed_tests, lost_states

   !> One of the cases: what is needed of it, and its last solution.
   type :: needed_case_t
      logical :: is_first = .false.               !! a number is read here first; other cases only where that gave no value
      logical :: is_solved = .false.              !! for the present design
      type(solve_options_t) :: options            !! its columns, and how far from design
      type(observer_t) :: observer
      type(case_result_t) :: result
   end type needed_case_t

   !> Wanted numbers of the designs of a deck.
   type :: named_numbers_t
      private
      type(key_number_t), allocatable :: numbers(:)      !! of each wanted name
      integer, allocatable :: wheel(:)                   !! 1: left or single wheel, or axle; 2: right
      type(needed_case_t), allocatable :: cases(:)
   contains
      procedure :: unit => number_unit
   end type named_numbers_t

   real(wp), parameter :: margin = 1.001_wp    !! of a window: its states may differ from their swept values by the tolerance

contains

   !> Finds wanted numbers among those that a model and its cases may have. Nothing is solved.
   subroutine prepare_numbers(names, suspension, cases, numbers, error)
      character(*), intent(in) :: names(:)
      type(suspension_t), intent(in) :: suspension      !! on no rig
      type(case_t), intent(in) :: cases(:)
      type(named_numbers_t), intent(out) :: numbers
      type(error_t), allocatable, intent(out) :: error  !! exit_usage: all unknown names, with suggestions
      type(key_number_t), allocatable :: listed(:)
      type(test_result_t), allocatable :: tests(:)
      character(name_length), allocatable :: heads(:, :)
      logical :: is_complete
      integer :: k, number, wheel

      call list_all(suspension, cases, tests, listed, heads, stems_of(names))
      allocate (numbers%numbers(size(names)), numbers%wheel(size(names)), numbers%cases(size(cases)))
      do k = 1, size(numbers%cases)
         allocate (numbers%cases(k)%options%columns(0))
         numbers%cases(k)%options%has_remarks = .false.
         numbers%cases(k)%options%reach = 0.0_wp
      end do
      is_complete = .true.
      do k = 1, size(names)
         call find(names(k), heads, number, wheel)
         is_complete = is_complete .and. number > 0
         if (number == 0) cycle
         numbers%numbers(k) = listed(number)
         numbers%wheel(k) = wheel
         call add_needs(listed(number), suspension, cases, tests, numbers%cases)
      end do
      if (.not. is_complete) call explain(names, suspension, cases, error)
   end subroutine prepare_numbers

   !> The message on unknown names.
   subroutine explain(names, suspension, cases, error)
      character(*), intent(in) :: names(:)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error
      type(key_number_t), allocatable :: listed(:)
      type(test_result_t), allocatable :: tests(:)
      character(name_length), allocatable :: heads(:, :), known(:)
      character(:), allocatable :: hint
      type(message_list_t) :: mistakes
      integer :: k, number, wheel

      call list_all(suspension, cases, tests, listed, heads)
      known = pack(heads, heads /= '')
      do k = 1, size(names)
         call find(names(k), heads, number, wheel)
         if (number > 0) cycle
         hint = nearest_name(trim(names(k)), known)
         if (any(known == 'left_'//names(k))) hint = 'left_'//trim(names(k))
         if (hint /= '') hint = ' (did you mean '//quoted(hint)//'?)'
         call mistakes%add('there is no key number '//quoted(trim(names(k)))//hint)
      end do
      if (size(known) == 0) then
         call mistakes%add('the model has no key numbers: it has no wheel')
      else
         call mistakes%add('key_numbers.csv of the report has all names')
      end if
      call fail(error, exit_usage, mistakes%text())
   end subroutine explain

   !> Names without left_ and right_.
   pure function stems_of(names) result(stems)
      character(*), intent(in) :: names(:)
      character(name_length) :: stems(size(names))

      stems = names
      where (index(names, 'left_') == 1) stems = stems(:) (6:)
      where (index(names, 'right_') == 1) stems = stems(:) (7:)
   end function stems_of

   !> The place of a name; number 0 if there is none.
   pure subroutine find(name, heads, number, wheel)
      character(*), intent(in) :: name
      character(*), intent(in) :: heads(:, :)           !! (wheel, number)
      integer, intent(out) :: number, wheel

      wheel = 0
      do number = size(heads, 2), 1, -1
         do wheel = 1, 2
            if (heads(wheel, number) == name .and. name /= '') return
         end do
      end do
   end subroutine find

   !> All names, with units and definitions, in the order of the report. Nothing is solved, so one of them may have no value.
   subroutine list_numbers(suspension, cases, names, units, definitions)
      type(suspension_t), intent(in) :: suspension      !! on no rig
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(out) :: names, units, definitions
      type(key_number_t), allocatable :: listed(:)
      type(test_result_t), allocatable :: tests(:)
      character(name_length), allocatable :: heads(:, :)
      integer :: k, wheel

      call list_all(suspension, cases, tests, listed, heads)
      do k = 1, size(listed)
         do wheel = 1, 2
            if (heads(wheel, k) == '') cycle
            call names%add(trim(heads(wheel, k)))
            call units%add(listed(k)%unit)
            call definitions%add(listed(k)%definition//'; '//listed(k)%condition)
         end do
      end do
   end subroutine list_numbers

   !> The tests with the heads of their tables, and the numbers that they may have. The rig adds nothing to what key numbers are read
   !> from, so that all tests have the heads of the first.
   subroutine list_all(suspension, cases, tests, listed, names, wanted)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(test_result_t), allocatable, intent(out) :: tests(:)
      type(key_number_t), allocatable, intent(out) :: listed(:)
      character(name_length), allocatable, intent(out) :: names(:, :)   !! (wheel, number): '' if a wheel does not have it
      character(*), intent(in), optional :: wanted(:)    !! of names without left_ and right_; absent: all
      type(case_t), allocatable :: all(:)
      type(gradient_t), allocatable :: gradients(:)
      character(name_length), allocatable :: heads(:)
      character(64), allocatable :: quantities(:)
      integer :: k

      allocate (all(size(cases)))
      all(:) = cases
      call planned_tests(suspension, all, tests)
      allocate (gradients(0))
      do k = 1, size(all)
         if (k == 1) then
            call sweep_columns(suspension, all(k), heads)
            tests(k)%table = new_table(heads, 0)
            if (size(suspension%wheels) > 0) call find_wheels(tests(k), suspension%wheels(1)%side)
         else
            tests(k)%table = tests(1)%table
            tests(k)%prefixes = tests(1)%prefixes
            tests(k)%sides = tests(1)%sides
         end if
         if (present(wanted)) then
            call wanted_gradients(tests(k)%kind, wanted, quantities)
            if (size(quantities) > 0) call test_gradients(tests(k), windows_t(), gradients, quantities)
         else
            call test_gradients(tests(k), windows_t(), gradients)
         end if
      end do
      call list_key_numbers(tests, gradients, listed, wanted)
      allocate (names(2, size(listed)))
      do k = 1, size(listed)
         call number_heads(listed(k), size(suspension%wheels) > 1, names(:, k))
      end do
   end subroutine list_all

   !> Adds what a number needs of its cases.
   subroutine add_needs(number, suspension, cases, tests, needed)
      type(key_number_t), intent(in) :: number
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(test_result_t), intent(in) :: tests(:)
      type(needed_case_t), intent(inout) :: needed(:)
      integer :: k, wheel
      real(wp) :: reach

      do k = 1, size(number%sources)
         associate (source => number%sources(k), this => needed(number%sources(k)%test))
            this%is_first = this%is_first .or. k == 1 .or. number%how == largest_of_all
            do wheel = 1, 2
               call add(source%column(wheel))
               call add(source%over(wheel))
            end do
            reach = huge(reach)
            if (number%how == at_design) reach = 0.0_wp
            if (.not. needs_path(number%how) .and. number%how /= at_design) &
               reach = reach_of(suspension, cases(source%test), source, tests(source%test))
            this%options%reach = max(this%options%reach, reach)
         end associate
      end do

   contains

      subroutine add(name)
         character(name_length), intent(in) :: name
         integer :: c

         c = number%sources(k)%test
         if (name == '' .or. any(needed(c)%options%columns == name)) return
         needed(c)%options%columns = [character(name_length) :: needed(c)%options%columns, name]
      end subroutine add

   end subroutine add_needs

   !> The swept value beyond which no state lies in the window of a gradient. Only where its abscissa is the swept value, up to
   !> a factor, by the way in which the test holds the wheels; otherwise all states are needed.
   pure real(wp) function reach_of(suspension, case, source, test) result(reach)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(key_source_t), intent(in) :: source
      type(test_result_t), intent(in) :: test
      type(suspension_t) :: on_rig
      type(case_t) :: this
      type(rig_test_t) :: rig
      character(name_length) :: over

      reach = huge(reach)
      rig = rig_test(case%test)
      over = source%over(1)
      if (over == '') over = source%over(2)
      if (over == 'factor') then
         if (.not. (abs(test%factor_size) > 0.0_wp .and. is_mountable(case))) return
         call mount(suspension, case, on_rig, this)
         reach = margin*source%half/abs(test%factor_size)*this%unit
      else if (case%vertical /= '') then
         return
      else if (index(over, 'wheel_travel_mm') > 0) then
         if (case%drive == 'wheel_travel' .and. size(suspension%wheels) == 1) reach = margin*source%half*millimetre
         if (rig%action == moves_heights .and. .not. of_one_wheel(rig)) reach = margin*source%half*millimetre
      else if (over == 'axle_roll_deg') then
         if (rig%action == rolls) reach = margin*source%half*degree
      else if (over == 'steering_wheel_deg') then
         if (rig%action == steers) reach = margin*source%half/360.0_wp*abs(suspension%steering%ratio)
      end if

   end function reach_of

   !> The unit of number k, as in key_numbers.csv.
   function number_unit(self, k) result(unit)
      class(named_numbers_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: unit
      unit = self%numbers(k)%unit
   end function number_unit

   !> Which cases are solved in any event. They must be examined before balance (examine_case).
   pure function needed_tests(numbers) result(is_needed)
      type(named_numbers_t), intent(in) :: numbers
      logical :: is_needed(size(numbers%cases))
      is_needed = numbers%cases%is_first
   end function needed_tests

   !> The values of a design. A number that needs a state without equilibrium may be not a number, as in the report.
   subroutine read_numbers(numbers, suspension, cases, values, is_whole, is_solvable)
      type(named_numbers_t), intent(inout) :: numbers
      type(suspension_t), intent(in) :: suspension       !! the design, balanced, on no rig
      type(case_t), intent(in) :: cases(:)               !! as for prepare_numbers, with the numbers of this design
      real(wp), intent(out) :: values(:)                 !! in the units of key_numbers.csv
      logical, intent(out) :: is_whole                   !! every state that was needed converged, and every value is a number
      logical, intent(in), optional :: is_solvable(:)    !! of each case; a mechanism has no result. Absent: all are
      real(wp) :: both(2)
      logical :: is_final
      integer :: k, j, c

      numbers%cases%is_solved = .false.
      do k = 1, size(numbers%numbers)
         both = nothing()
         do j = 1, size(numbers%numbers(k)%sources)
            c = numbers%numbers(k)%sources(j)%test
            if (.not. is_mountable(cases(c))) cycle
            if (present(is_solvable)) then
               if (.not. is_solvable(c)) cycle
            end if
            if (.not. numbers%cases(c)%is_solved) call solve(suspension, cases(c), numbers%cases(c))
            if (.not. numbers%cases(c)%result%is_run()) cycle
            call read_source(numbers%numbers(k)%how, numbers%numbers(k)%sources(j), numbers%cases(c)%result%table, both, is_final)
            if (is_final) exit
         end do
         values(k) = both(numbers%wheel(k))
      end do
      is_whole = all(ieee_is_finite(values))
      do c = 1, size(numbers%cases)
         if (numbers%cases(c)%is_solved) is_whole = is_whole .and. is_complete(numbers%cases(c)%result)
      end do
   end subroutine read_numbers

   !> Solves one case as far as it is needed.
   subroutine solve(suspension, case, needed)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(needed_case_t), intent(inout) :: needed
      type(case_t) :: full

      full = case
      full%has_all = .true.                  ! as in the report
      call mount_case(suspension, full, needed%result%mounted_case_t)
      call solve_mounted(needed%options, needed%result, observer=needed%observer)
      needed%is_solved = .true.
   end subroutine solve

   pure logical function is_complete(result)
      type(case_result_t), intent(in) :: result

      is_complete = result%is_run()
      if (is_complete) is_complete = all(result%path%failure%state == 0)
   end function is_complete

   !> The states that the last read_numbers did not find, and why; no error if it found all. Not for several threads at a time.
   subroutine lost_states(numbers, error)
      type(named_numbers_t), intent(inout) :: numbers
      type(error_t), allocatable, intent(out) :: error      !! exit_convergence, or exit_model
      type(message_list_t) :: words
      integer :: c, side, code

      code = exit_convergence
      do c = 1, size(numbers%cases)
         if (.not. numbers%cases(c)%is_solved) cycle
         associate (result => numbers%cases(c)%result)
            if (.not. result%is_run()) then
               code = exit_model
               call words%add('case '//quoted(result%case%name)//': '//result%remarks%failures())
               cycle
            end if
            do side = 1, 2
               if (result%path%failure(side)%state > 0) call words%add('case '//quoted(result%case%name)//': '// &
                  failure_text(result%suspension, result%case, result%path, result%path%failure(side), result%kkt))
            end do
         end associate
      end do
      if (words%count() > 0) call fail(error, code, words%text())
   end subroutine lost_states

end module ek_named_numbers
