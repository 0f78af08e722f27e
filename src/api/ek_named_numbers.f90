!> Key numbers of a deck by their names. Only the required tests are solved, with only the required states and columns. Each number
!> equals, bit for bit, the number in key_numbers.csv of the report.
!>
!>     call prepare_numbers(names, suspension, cases, numbers, error)      once per deck
!>     call read_numbers(numbers, suspension, cases, values, is_whole)     for each design
!>
!> `cases` are the cases that the report solves, in the order of the report (standard_tests). read_numbers creates no strings, so
!> that several threads may read numbers, each thread with its own variable of type named_numbers_t.
module ek_named_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model, exit_convergence
   use ek_text, only: quoted
   use ek_buffer, only: buffer_t
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_table, only: table_t, name_length
   use ek_sweep_table, only: observer_t
   use ek_case_result, only: case_result_t, solve_options_t, add_remarks
   use ek_lone_case, only: solve_anew
   use ek_test_result, only: test_result_t
   use ek_gradient, only: gradient_windows
   use ek_gradient_definition, only: windows_t
   use ek_key_number, only: key_number_t, nothing, read_source, add_stops, is_slope, largest_of_all
   use ek_number_reach, only: reach_of, required_reach, lacks_state
   use ek_missing_number, only: missing_reason
   use ek_number_names, only: list_all, find_number, side_of_only_wheel, stems_of, explain_unknown
   implicit none(type, external)
   private
   public :: named_numbers_t, prepare_numbers, read_numbers, needed_tests, explain_missing

   !> One of the cases: its required columns and range, and its last solution.
   type :: needed_case_t
      logical :: is_first = .false.     !! whether the case must be examined: a number always needs it, or needs its slope
      logical :: is_solved = .false.              !! whether the case is solved for the present design
      logical :: is_missed = .false.              !! whether a number has no value because this case lacks a state
      type(solve_options_t) :: options            !! required columns; swept value beyond which no state is required
      type(case_t) :: read              !! a case with the places of the readings alone
      type(observer_t), allocatable :: observer   !! observer of the required columns; allocated at the first solution
      class(case_result_t), allocatable :: result
   end type needed_case_t

   !> The requested key numbers of the designs of a deck.
   type :: named_numbers_t
      private
      type(key_number_t), allocatable :: numbers(:)      !! key number of each wanted name
      integer, allocatable :: wheel(:)                   !! side of each wanted name. 1: left or single wheel, or axle; 2: right
      real(wp), allocatable :: reach(:, :)  !! swept value beyond which a number needs no state of a source: (source, number)
      logical, allocatable :: is_lost(:)                 !! whether a number needs a state that was not found, at the present design
      type(needed_case_t), allocatable :: cases(:)
   contains
      procedure :: unit => number_unit
   end type named_numbers_t

contains

   !> Finds requested key numbers among all key numbers of a model and its cases. No case is solved.
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
      integer :: k, number, wheel, most

      call list_all(suspension, cases, tests, listed, heads, stems_of(names))
      allocate (numbers%numbers(size(names)), numbers%wheel(size(names)), numbers%cases(size(cases)))
      allocate (numbers%is_lost(size(names)), source=.false.)
      most = 0
      do k = 1, size(listed)
         most = max(most, size(listed(k)%sources))
      end do
      allocate (numbers%reach(most, size(names)), source=0.0_wp)
      do k = 1, size(numbers%cases)
         allocate (numbers%cases(k)%options%columns(0))
         numbers%cases(k)%options%reach = 0.0_wp
         call gradient_windows(tests(k), windows_t(), numbers%cases(k)%read)      ! all of them: the states have the bits of the report
      end do
      is_complete = .true.
      do k = 1, size(names)
         call find_number(names(k), heads, number, wheel, side_of_only_wheel(suspension))
         is_complete = is_complete .and. number > 0
         if (number == 0) cycle
         numbers%numbers(k) = listed(number)
         numbers%wheel(k) = wheel
         call add_needs(listed(number), suspension, cases, numbers%cases, numbers%reach(:, k))
      end do
      if (.not. is_complete) call explain_unknown(names, suspension, cases, error)
   end subroutine prepare_numbers

   !> Adds the columns and states that a key number requires from its cases.
   subroutine add_needs(number, suspension, cases, needed, reach)
      type(key_number_t), intent(in) :: number
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(needed_case_t), intent(inout) :: needed(:)
      real(wp), intent(inout) :: reach(:)                !! reach of each source
      integer :: k, wheel

      do k = 1, size(number%sources)
         associate (source => number%sources(k), this => needed(number%sources(k)%test))
            ! a test with a defect has no slopes: the next one gives the number, and must be known to have no defect
            this%is_first = this%is_first .or. k == 1 .or. number%how == largest_of_all .or. is_slope(number%how)
            do wheel = 1, 2
               call add(source%column(wheel))
               call add(source%over(wheel))
            end do
            call add_stops(number%how, source, this%options%stops)
            reach(k) = reach_of(number%how, suspension, cases(source%test), source)
            this%options%reach = max(this%options%reach, reach(k))
         end associate
      end do

   contains

      !> Adds a column to the columns of the case, unless its name is blank or already listed.
      subroutine add(name)
         character(name_length), intent(in) :: name
         integer :: c

         c = number%sources(k)%test
         if (name == '' .or. any(needed(c)%options%columns == name)) return
         needed(c)%options%columns = [character(name_length) :: needed(c)%options%columns, name]
      end subroutine add

   end subroutine add_needs

   !> The unit of requested number k, as in key_numbers.csv.
   function number_unit(self, k) result(unit)
      class(named_numbers_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: unit
      unit = self%numbers(k)%unit
   end function number_unit

   !> Whether each case must be examined (examine_case) before the preload trim (`balance`): it is solved in any event, or gives a
   !> slope that an earlier case with a defect does not give.
   pure function needed_tests(numbers) result(is_needed)
      type(named_numbers_t), intent(in) :: numbers
      logical :: is_needed(size(numbers%cases))
      is_needed = numbers%cases%is_first
   end function needed_tests

   !> Reads the key numbers of a design. A key number is NaN if the model does not define the number, or if a state that the number
   !> requires did not converge, because the other states would give another value. States beyond the window of the key number do
   !> not matter.
   subroutine read_numbers(numbers, suspension, cases, values, is_whole, is_solvable)
      type(named_numbers_t), intent(inout) :: numbers
      type(suspension_t), intent(in) :: suspension       !! the design with trimmed preloads, on no rig
      type(case_t), intent(in) :: cases(:)               !! as for prepare_numbers, with the numbers of this design
      real(wp), intent(out) :: values(:)                 !! in the units of key_numbers.csv
      logical, intent(out) :: is_whole                   !! whether every value is a number
      logical, intent(in), optional :: is_solvable(:)    !! whether each case can be solved. Absent: all cases can
      real(wp) :: both(2)
      logical :: is_final
      integer :: k, j, c, first_missed

      first_missed = 0
      numbers%cases%is_solved = .false.
      numbers%cases%is_missed = .false.
      numbers%is_lost = .false.
      do k = 1, size(numbers%numbers)
         both = nothing()
         do j = 1, size(numbers%numbers(k)%sources)
            c = numbers%numbers(k)%sources(j)%test
            if (.not. is_mountable(cases(c))) cycle
            if (present(is_solvable)) then
               if (.not. is_solvable(c)) cycle
            end if
            if (.not. numbers%cases(c)%is_solved) call solve(suspension, cases(c), numbers%cases(c))
            if (lacks_state(numbers%cases(c)%result, required_reach(numbers%numbers(k)%how, numbers%reach(j, k)))) then
               if (.not. numbers%is_lost(k)) first_missed = c
               numbers%is_lost(k) = .true.
               if (is_slope(numbers%numbers(k)%how) .or. numbers%numbers(k)%how == largest_of_all) exit
               cycle                               ! a further test may have the number, as in the report
            end if
            call read_source(numbers%numbers(k)%how, numbers%numbers(k)%sources(j), numbers%cases(c)%result%table, both, is_final)
            if (is_final) exit
         end do
         values(k) = both(numbers%wheel(k))
         if (numbers%numbers(k)%how == largest_of_all .and. numbers%is_lost(k)) values(k) = nothing()
         numbers%is_lost(k) = numbers%is_lost(k) .and. .not. ieee_is_finite(values(k))
         if (numbers%is_lost(k)) numbers%cases(first_missed)%is_missed = .true.
      end do
      is_whole = all(ieee_is_finite(values))
   end subroutine read_numbers

   !> Solves one case at the required states, with the required columns.
   subroutine solve(suspension, case, needed)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(needed_case_t), intent(inout) :: needed
      type(case_t) :: full

      full = case
      full%has_all = .true.                  ! as in the report
      if (allocated(needed%read%windows)) full%windows = needed%read%windows
      call solve_anew(suspension, full, needed%options, needed%result, needed%observer)
      needed%is_solved = .true.
   end subroutine solve

   !> Explains for which key numbers the last read_numbers found no value, and why: states that did not converge, with their cases,
   !> or the reason of ek_missing_number. Returns no error if all key numbers have a value. Only one thread at a time may
   !> call this procedure.
   subroutine explain_missing(numbers, names, values, defects, error)
      type(named_numbers_t), intent(inout) :: numbers
      character(*), intent(in) :: names(:)
      real(wp), intent(in) :: values(:)
      type(message_list_t), intent(in) :: defects           !! defects of the model in some of the cases
      type(error_t), allocatable, intent(out) :: error      !! exit_convergence, or exit_model
      type(message_list_t) :: words
      type(buffer_t) :: lost
      logical :: is_told(size(names))
      integer :: c, k, code

      code = exit_convergence
      do c = 1, size(numbers%cases)
         if (.not. numbers%cases(c)%is_missed) cycle
         associate (result => numbers%cases(c)%result)
            call add_remarks(numbers%cases(c)%options, result)
            if (result%is_run()) then
               call words%add(result%remarks%failures())
            else
               code = exit_model
               call words%add('case '//quoted(result%case%name)//': '//result%remarks%failures())
            end if
         end associate
      end do
      is_told = ieee_is_finite(values(:size(names)))
      do k = 1, size(names)
         if (.not. is_told(k) .and. numbers%is_lost(k)) call lost%add(' '//trim(names(k)))
      end do
      is_told = is_told .or. numbers%is_lost
      if (lost%length() > 0) call words%add('no value of'//lost%text())
      if (.not. all(is_told) .and. defects%count() > 0) call words%add(defects%text())
      do while (.not. all(is_told))
         k = findloc(is_told, .false., dim=1)
         call say_reason(k)
      end do
      if (words%count() > 0) call fail(error, code, words%text())

   contains

      !> Adds the reason of a number, with all other numbers that have no value for this reason.
      subroutine say_reason(first)
         integer, intent(in) :: first
         type(buffer_t) :: list
         character(:), allocatable :: reason
         integer :: j

         reason = reason_of(numbers, first)
         do j = first, size(names)
            if (is_told(j)) cycle
            if (j > first) then
               if (reason_of(numbers, j) /= reason) cycle
            end if
            is_told(j) = .true.
            call list%add(' '//trim(names(j)))
         end do
         call words%add('no value of'//list%text()//' ('//reason//')')
      end subroutine say_reason

   end subroutine explain_missing

   !> The reason why requested number k has no value, from the first of its tests.
   function reason_of(numbers, k) result(text)
      type(named_numbers_t), intent(in) :: numbers
      integer, intent(in) :: k
      character(:), allocatable :: text
      type(table_t) :: none

      associate (case => numbers%cases(numbers%numbers(k)%sources(1)%test), number => numbers%numbers(k))
         if (case%is_solved) then
            text = missing_reason(number, numbers%wheel(k), 1, case%result%table)
         else
            text = missing_reason(number, numbers%wheel(k), 1, none)
         end if
         text = number%condition//': '//text
      end associate
   end function reason_of

end module ek_named_numbers
