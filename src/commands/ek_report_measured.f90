!> The measured curves of `elastokin report --measured TEST=FILE --map FILE`.
module ek_report_measured
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_deck
   use ek_text, only: str, plural, quoted, lower, did_you_mean
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_standard_tests, only: unit_of_swept_value
   use ek_quantity, only: name_length
   use ek_test_result, only: test_result_t
   use ek_grid, only: is_grid
   use ek_measurement, only: measurement_t, stop_where_measured, compare_measured, measured_csv
   use ek_outbox, only: outbox_t
   use ek_report_names, only: measured_file
   use ek_console, only: print_error
   use ek_rig_map, only: map_channel_t, read_map, read_measurement
   use ek_command_line, only: command_line_t
   implicit none(type, external)
   private
   public :: read_measured, compare_all_measured, put_measured

contains

   !> Reads the measured curves of --measured, each for one test of the report, and lets the path of this test stop at their points.
   subroutine read_measured(line, suspension, tests, cases, measured, error)
      type(command_line_t), intent(in) :: line
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: tests(:)            !! as planned
      type(case_t), intent(inout) :: cases(:)                !! case of each test
      type(measurement_t), allocatable, intent(out) :: measured(:)     !! not allocated without the option
      type(error_t), allocatable, intent(out) :: error       !! exit_usage, exit_file, exit_deck
      type(map_channel_t), allocatable :: channels(:)
      type(message_list_t) :: given
      integer :: k

      if (line%has('--measured') .neqv. line%has('--map')) then
         call fail(error, exit_usage, '--measured TEST=FILE and --map FILE belong together: '// &
            'measured curves, and the meaning of their headings')
         return
      end if
      if (.not. line%has('--measured')) return
      given = line%values('--measured')
      call read_map(line%value('--map'), channels, error)
      if (allocated(error)) return
      allocate (measured(given%count()))
      do k = 1, size(measured)
         call read_one(given%line(k), measured(k))
         if (allocated(error)) return
      end do

   contains

      subroutine read_one(text, this)
         character(*), intent(in) :: text                    !! TEST=FILE
         type(measurement_t), intent(out) :: this
         integer :: at, place

         at = index(text, '=')
         place = 0
         if (at > 0) place = test_number(text(:at - 1), tests)
         if (at == 0) then
            call fail(error, exit_usage, '--measured: expected TEST=FILE, found '//quoted(text))
         else if (place == 0) then
            call fail(error, exit_usage, '--measured: the report has no test '//quoted(text(:at - 1))//did_you_mean(text(:at - 1), &
               names_of(tests)))
         else if (.not. is_sweep(cases(place))) then
            call fail(error, exit_usage, '--measured: the states of test '//quoted(text(:at - 1))// &
               ' are not at swept values that can be chosen; expected a test over one swept value')
         else
            call read_measurement(text(at + 1:), tests(place)%name, tests(place)%kind, channels, this, error)
            if (allocated(error)) return
            this%place = place
            call stop_where_measured(unit_of_swept_value(suspension, cases(place)), this, cases(place))
         end if
      end subroutine read_one
   end subroutine read_measured

   !> Whether the path of a case can stop at given swept values.
   pure logical function is_sweep(case)
      type(case_t), intent(in) :: case

      is_sweep = .not. (is_grid(case) .or. case%follows_arc .or. allocated(case%manoeuvres))
      if (is_sweep .and. allocated(case%test)) is_sweep = case%test /= 'table'
   end function is_sweep

   !> Index of a test by its name or, if only one test is of this kind, by its kind; 0 if there is none.
   pure integer function test_number(name, tests) result(found)
      character(*), intent(in) :: name
      type(test_result_t), intent(in) :: tests(:)
      integer :: kinds, k

      kinds = 0
      found = 0
      do k = 1, size(tests)
         if (lower(tests(k)%name) == lower(name)) then
            found = k
            return
         end if
         if (tests(k)%kind == lower(name)) then
            kinds = kinds + 1
            if (found == 0) found = k
         end if
      end do
      if (kinds > 1) found = 0
   end function test_number

   pure function names_of(tests) result(names)
      type(test_result_t), intent(in) :: tests(:)
      character(name_length) :: names(size(tests))
      integer :: k

      do k = 1, size(tests)
         names(k) = tests(k)%name
      end do
   end function names_of

   !> Compares all measured curves with the solved tests. Points without a state of the model are warnings of the page.
   subroutine compare_all_measured(tests, measured, warnings, error)
      type(test_result_t), intent(in) :: tests(:)
      type(measurement_t), intent(inout) :: measured(:)
      type(message_list_t), intent(inout) :: warnings
      type(error_t), allocatable, intent(out) :: error       !! exit_deck: a column does not exist
      type(message_list_t) :: mistakes
      integer :: k, lost

      do k = 1, size(measured)
         associate (this => measured(k))
            call compare_measured(tests(this%place), this, mistakes)
            lost = count(this%rows == 0)
            if (lost > 0) call warnings%add(this%file//': '//str(lost)//' of '//plural(size(this%x), 'measured point', &
               'measured points')//' are not compared: the model has no state there ('//str(this%outside)// &
               ' are outside the range of test '//quoted(this%test)//')')
         end associate
      end do
      do k = 1, mistakes%count()
         call warnings%add(mistakes%line(k))
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine compare_all_measured

   !> Compares the measured curves of a report with its tests, and writes their table.
   subroutine put_measured(tests, measured, warnings, box, unmapped)
      type(test_result_t), intent(in) :: tests(:)
      type(measurement_t), intent(inout) :: measured(:)
      type(message_list_t), intent(inout) :: warnings
      type(outbox_t), intent(inout) :: box
      type(error_t), allocatable, intent(out) :: unmapped       !! as of compare_all_measured; also printed

      call compare_all_measured(tests, measured, warnings, unmapped)
      call box%put(measured_file, measured_csv(measured))
      if (allocated(unmapped)) call print_error(unmapped%message)
   end subroutine put_measured

end module ek_report_measured
