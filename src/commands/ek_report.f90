!> elastokin report: deck → tests → gradients, charts, picture → one page and its files.
module ek_report
   use ek_error, only: error_t, message_list_t, fail, exit_convergence
   use ek_units, only: millimetre
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_clock, only: date_words
   use ek_file, only: make_folder, write_whole, join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_balance, only: balance
   use ek_csv, only: write_csv
   use ek_table, only: table_t
   use ek_test_result, only: test_result_t
   use ek_chart, only: chart_t
   use ek_test_charts, only: test_charts
   use ek_gradient, only: gradient_t, test_gradients
   use ek_gradient_file, only: write_gradients
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: load_deck, chosen_cases, examine_chosen
   use ek_report_tests, only: planned_test_t, report_cases, planned_tests, run_planned
   use ek_report_files, only: write_contents, contents_file, gradients_file, compliance_file
   use ek_report_pictures, only: film_t, draw_pictures
   use ek_report_page, only: report_page
   use ek_examination, only: examination_t
   use ek_console, only: print_note, print_error, print_path, print_model_remarks
   implicit none(type, external)
   private
   public :: report

contains

   !> Runs the tests of a deck and writes all files. Of a test that fails part way the converged states are written; the
   !> error at the end then has code exit_convergence.
   subroutine report(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), chosen(:)
      type(planned_test_t), allocatable :: planned(:)
      type(test_result_t), allocatable :: tests(:)
      type(film_t), allocatable :: films(:)
      type(gradient_t), allocatable :: gradients(:)
      type(chart_t), allocatable :: charts(:)
      type(message_list_t) :: warnings, page_warnings
      type(examination_t) :: found
      type(error_t), allocatable :: trouble, undrawn, unprinted
      type(table_t) :: compliance
      character(:), allocatable :: checksum, folder, message
      logical :: has_matrix                        ! of the first test that is run: travel, with design
      logical :: has_pictures, has_animation
      integer :: k, failed, code

      call begin_report(arguments, suspension, cases, chosen, checksum, folder, found, error)
      if (allocated(error)) return
      call balance(suspension, default_tolerance, error)
      if (allocated(error)) return
      call planned_tests(suspension, chosen, planned)
      call print_model_remarks(arguments%quiet, suspension, cases, planned%case, warnings)
      call remove_file(join_path(folder, 'report.html'))     ! a page of an earlier report must not be mistaken for this one
      call remove_file(join_path(folder, contents_file))

      allocate (tests(size(planned)), films(size(planned)), charts(0), gradients(0))
      call remove_file(join_path(folder, compliance_file))
      has_matrix = size(suspension%wheels) == 0
      failed = 0
      code = exit_convergence
      do k = 1, size(planned)
         if (has_matrix) then
            call run_planned(suspension, planned(k), found%faults%line(k), checksum, tests(k), films(k)%path, trouble)
         else
            call run_planned(suspension, planned(k), found%faults%line(k), checksum, tests(k), films(k)%path, trouble, &
               compliance)
         end if
         if (allocated(trouble)) then
            call print_error(trouble%message)
            failed = failed + 1
            if (trouble%code /= exit_convergence) code = trouble%code     ! the test was not run at all
            call warnings%add(planned(k)%title//': '//trouble%message)
         end if
         if (.not. tests(k)%is_run) cycle
         films(k)%is_there = .true.
         call write_csv(tests(k)%table, join_path(folder, tests(k)%file), error)
         if (allocated(error)) return
         call print_path(join_path(folder, tests(k)%file), unprinted)
         if (.not. has_matrix) call write_matrix(compliance, folder, unprinted, error)
         if (allocated(error)) return
         has_matrix = .true.
         call test_gradients(tests(k), arguments%windows, gradients)
         call test_charts(tests(k), charts, k)
      end do
      call write_gradients(gradients, suspension%name, checksum, join_path(folder, gradients_file), &
         join_path(folder, 'gradients.json'), error)
      if (allocated(error)) return
      call print_path(join_path(folder, gradients_file), unprinted)
      call print_path(join_path(folder, 'gradients.json'), unprinted)

      call write_contents(tests, join_path(folder, contents_file), error)
      if (allocated(error)) return

      ! first the page without pictures: it then exists even if gnuplot fails or never ends
      if (.not. arguments%no_plots) then
         page_warnings = warnings
         call page_warnings%add('The page has no pictures: gnuplot has not finished')
         call write_page(arguments, suspension, checksum, tests, charts, gradients, page_warnings, folder, .false., .false., error)
         if (allocated(error)) return
      end if
      call draw_pictures(.not. arguments%no_plots, arguments%animate, suspension, tests, films, charts, folder, has_animation, &
         message, undrawn)
      if (allocated(undrawn)) then
         call print_error(undrawn%message)
         call warnings%add('The page lacks pictures: '//undrawn%message)
      else if (len(message) > 0) then
         if (.not. arguments%no_plots) call print_note(arguments%quiet, message)
         call warnings%add('The page has no pictures: '//message)
      end if
      has_pictures = .not. allocated(undrawn) .and. len(message) == 0
      call write_page(arguments, suspension, checksum, tests, charts, gradients, warnings, folder, has_pictures, &
         has_animation, error)
      if (allocated(error)) return
      call print_path(join_path(folder, 'report.html'), unprinted)
      if (failed > 0) then
         call fail(error, code, str(failed)//' of '//plural(size(tests), 'test', 'tests')// &
            trim(merge(' is ', ' are', failed == 1))//' incomplete; see the warnings at the top of the report')
      else if (allocated(undrawn)) then
         call fail(error, undrawn%code, 'the report was written, but some of its pictures are missing')
      else if (allocated(unprinted)) then
         call move_alloc(unprinted, error)
      end if
   end subroutine report

   !> Reads the deck, examines the chosen cases, and makes the folders; an error if no case can be solved.
   subroutine begin_report(arguments, suspension, cases, chosen, checksum, folder, found, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:), chosen(:)      !! all of the deck; those of this report
      character(:), allocatable, intent(out) :: checksum, folder
      type(examination_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error
      type(case_t), allocatable :: all_cases(:)

      call load_deck(arguments, suspension, cases, checksum, error)
      if (allocated(error)) return
      call report_cases(suspension, cases, all_cases)
      call chosen_cases(arguments, all_cases, chosen, error)
      if (allocated(error)) return
      folder = arguments%out
      call examine_chosen(arguments, suspension, chosen, found, error)
      if (allocated(error)) return
      call make_folder(folder, error)
      if (allocated(error)) return
      call make_folder(join_path(folder, 'figures'), error)
   end subroutine begin_report

   !> compliance.csv: the compliance matrix at every state of a test.
   subroutine write_matrix(table, folder, unprinted, error)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: unprinted     !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error

      call write_csv(table, join_path(folder, compliance_file), error)
      if (.not. allocated(error)) call print_path(join_path(folder, compliance_file), unprinted)
   end subroutine write_matrix

   !> report.html
   subroutine write_page(arguments, suspension, checksum, tests, charts, gradients, warnings, folder, has_pictures, &
      has_animation, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: checksum
      type(test_result_t), intent(in) :: tests(:)
      type(chart_t), intent(in) :: charts(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(message_list_t), intent(in) :: warnings
      character(*), intent(in) :: folder
      logical, intent(in) :: has_pictures, has_animation     !! those in the folder belong to this report
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: names, values
      character(:), allocatable :: title, settings
      integer :: k

      title = suspension%title
      if (len(title) == 0) title = suspension%name
      call fact('Deck', arguments%file)
      call fact('Model', suspension%name)
      settings = ''
      do k = 1, size(arguments%settings)
         settings = settings//arguments%settings(k)%text//' '
      end do
      if (len(settings) > 0) call fact('Changed by --set', trim(settings))
      if (size(suspension%wheels) > 0) call fact('Road at design', 'z = '//str(( &
         suspension%bodies(suspension%wheels(1)%body)%origin(3) + suspension%wheels(1)%contact(3))/millimetre, 6)//' mm')
      call fact('Deck checksum', checksum)
      call fact('Program', 'elastokin '//version)
      call fact('Date', date_words())
      call write_whole(join_path(folder, 'report.html'), report_page(title, 'Kinematics and compliance report', names, values, &
         warnings, tests, charts, gradients, folder, has_pictures, has_animation), error)

   contains

      subroutine fact(name, value)
         character(*), intent(in) :: name, value
         call names%add(name)
         call values%add(value)
      end subroutine fact

   end subroutine write_page

end module ek_report
