!> The names of the key numbers that a model and its cases may have. Nothing is solved.
module ek_number_names
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, suggestion_by_part
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_table, only: name_length, new_table
   use ek_sweep_table, only: sweep_columns
   use ek_test_result, only: test_result_t, find_wheels
   use ek_gradient, only: gradient_t, test_gradients
   use ek_gradient_definition, only: windows_t
   use ek_planned_test, only: planned_tests
   use ek_key_number, only: key_number_t
   use ek_key_numbers, only: list_key_numbers, number_heads, wanted_gradients
   implicit none(type, external)
   private
   public :: list_numbers, list_all, plan_tables, find_number, side_of_only_wheel, stems_of, explain_unknown

contains

   !> Creates the error message on unknown names.
   subroutine explain_unknown(names, suspension, cases, error)
      character(*), intent(in) :: names(:)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error
      type(key_number_t), allocatable :: listed(:)
      type(test_result_t), allocatable :: tests(:)
      character(name_length), allocatable :: heads(:, :), known(:)
      type(message_list_t) :: mistakes
      integer :: k, number, wheel

      call list_all(suspension, cases, tests, listed, heads)
      known = pack(heads, heads /= '')
      do k = 1, size(names)
         call find_number(names(k), heads, number, wheel, side_of_only_wheel(suspension))
         if (number > 0) cycle
         call mistakes%add('there is no K&C metric '//quoted(trim(names(k)))// &
            suggestion_by_part(trim(names(k)), known))
      end do
      if (size(known) == 0) then
         call mistakes%add('the model has no K&C metrics: it has no wheel')
      else
         call mistakes%add('key_numbers.csv of the report has all names')
      end if
      call fail(error, exit_usage, mistakes%text())
   end subroutine explain_unknown

   !> Names without left_ and right_.
   pure function stems_of(names) result(stems)
      character(*), intent(in) :: names(:)
      character(name_length) :: stems(size(names))

      stems = names
      where (index(names, 'left_') == 1) stems = stems(:) (6:)
      where (index(names, 'right_') == 1) stems = stems(:) (7:)
   end function stems_of

   !> Finds a name among the key numbers. Of a number of both wheels, a name without left_ or right_ means the left wheel. In a model
   !> with one wheel, whose key numbers have no side, a name with its side means this wheel. `number` is 0 if the name is unknown.
   pure subroutine find_number(name, heads, number, wheel, only_side)
      character(*), intent(in) :: name
      character(*), intent(in) :: heads(:, :)           !! (wheel, number)
      integer, intent(out) :: number, wheel
      integer, intent(in), optional :: only_side        !! side of the only wheel: −1 left, 1 right; absent or 0: two wheels
      integer :: k

      number = 0
      wheel = 0
      if (name == '') return
      do k = size(heads, 2), 1, -1
         do wheel = 1, 2
            number = k
            if (heads(wheel, k) == name) return
         end do
      end do
      wheel = 1
      number = findloc(heads(1, :) == 'left_'//name, .true., dim=1, back=.true.)
      if (number > 0 .or. .not. present(only_side)) return
      if (only_side < 0 .and. index(name, 'left_') == 1) number = findloc(heads(1, :) == name(6:), .true., dim=1, back=.true.)
      if (only_side > 0 .and. index(name, 'right_') == 1) number = findloc(heads(1, :) == name(7:), .true., dim=1, back=.true.)
   end subroutine find_number

   !> Side of the wheel of a model with one wheel: −1 left, 1 right; 0 for other models.
   pure integer function side_of_only_wheel(suspension) result(side)
      type(suspension_t), intent(in) :: suspension
      side = 0
      if (size(suspension%wheels) == 1) side = suspension%wheels(1)%side
   end function side_of_only_wheel

   !> Lists the names of all key numbers, with units and definitions, in the order of the report. No case is solved, so that a
   !> listed key number may turn out to be NaN.
   subroutine list_numbers(suspension, cases, names, units, definitions)
      type(suspension_t), intent(in) :: suspension      !! not on a rig
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

   !> Lists the tests with the headings of their tables, and the key numbers that they may have. All tests have the headings of the
   !> first test, because the rig adds no column that a key number needs.
   subroutine list_all(suspension, cases, tests, listed, names, wanted)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(test_result_t), allocatable, intent(out) :: tests(:)
      type(key_number_t), allocatable, intent(out) :: listed(:)
      character(name_length), allocatable, intent(out) :: names(:, :)   !! (wheel, number): '' if a wheel does not have it
      character(*), intent(in), optional :: wanted(:)    !! names without left_ and right_; absent: all
      type(case_t), allocatable :: run(:)
      type(gradient_t), allocatable :: gradients(:)
      character(name_length), allocatable :: heads(:)
      character(64), allocatable :: quantities(:)
      logical, allocatable :: is_gradient(:), is_read(:)
      integer :: k

      allocate (run(size(cases)))
      run(:) = cases
      call planned_tests(suspension, run, tests)
      allocate (gradients(0))
      allocate (is_read(size(run)), source=.true.)
      if (present(wanted)) then
         allocate (is_gradient(size(wanted)), source=.false.)
         do k = 1, size(run)
            call wanted_gradients(tests(k)%kind, wanted, quantities, is_gradient)
            is_read(k) = size(quantities) > 0
         end do
         ! tables hold tens of kilobytes of heads; gradients are read from those of their own tests
         if (.not. all(is_gradient)) is_read = .true.
      end if
      do k = 1, size(run)
         if (k == 1) then
            call sweep_columns(suspension, run(k), heads)
            tests(k)%table = new_table(heads, 0)
            if (size(suspension%wheels) > 0) call find_wheels(tests(k), suspension%wheels(1)%side)
         else
            if (is_read(k)) tests(k)%table = tests(1)%table
            if (.not. is_read(k)) tests(k)%table = new_table(heads(:0), 0)
            tests(k)%prefixes = tests(1)%prefixes
            tests(k)%sides = tests(1)%sides
         end if
         if (.not. is_read(k)) cycle
         if (present(wanted)) then
            call wanted_gradients(tests(k)%kind, wanted, quantities, is_gradient)
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

   !> Plans the tests of cases, with the headings of their tables and no states.
   subroutine plan_tables(suspension, cases, tests)
      type(suspension_t), intent(in) :: suspension       !! on no rig
      type(case_t), intent(in) :: cases(:)
      type(test_result_t), allocatable, intent(out) :: tests(:)
      type(case_t), allocatable :: run(:)
      character(name_length), allocatable :: heads(:)
      integer :: k

      allocate (run(size(cases)))
      run(:) = cases
      call planned_tests(suspension, run, tests)
      do k = 1, size(run)
         if (k == 1) call sweep_columns(suspension, run(k), heads)
         tests(k)%table = new_table(heads, 0)
         if (size(suspension%wheels) > 0) call find_wheels(tests(k), suspension%wheels(1)%side)
      end do
   end subroutine plan_tables

end module ek_number_names
