!> elastokin run: deck → model → sweep → table → CSV and figures, case by case.
module ek_run
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_model, exit_convergence
   use ek_units, only: millimetre
   use ek_text, only: str, quoted, plural
   use ek_version, only: version
   use ek_file, only: make_folder, join_path, base_name
   use ek_memory, only: ask_memory
   use ek_suspension, only: suspension_t, load_number
   use ek_case, only: case_t
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_examination, only: examination_t, examine_cases
   use ek_path, only: path_t, sweep
   use ek_rig, only: mount
   use ek_wheel_side, only: single_side
   use ek_sweep_table, only: sweep_table, sweep_bytes
   use ek_compliance_table, only: compliance_table
   use ek_test_result, only: frame_line
   use ek_curve_reach, only: curve_reach_words
   use ek_target, only: target_t, find_target
   use ek_table, only: table_t
   use ek_csv, only: write_csv, tell_csv
   use ek_figure, only: figure_t
   use ek_plot, only: run_figures
   use ek_gnuplot, only: write_figure, render_figures
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: load_deck, chosen_cases
   use ek_remark_words, only: warn_of_balance, warn_of_remarks, unsolvable_words
   use ek_failure_words, only: failure_words, stability_words
   use ek_run_words, only: say_settled, say_preloads, patch_words, spring_words, rack_words, warn_of_drift, &
      warn_of_travel, open_words, add_line
   use ek_words, only: say, warn, complain, tell_path, show_progress, clear_progress
   implicit none(type, external)
   private
   public :: run, add_header

   character(*), parameter :: compliance_ending = '_compliance.csv'

contains

   !> Runs the chosen cases of a deck. Of a case that fails part way the converged states are written, and the other cases are
   !> run. The error at the end has the code of the first failure other than lack of convergence, otherwise exit_convergence.
   subroutine run(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), chosen(:)
      type(error_t), allocatable :: trouble, unheard
      type(message_list_t) :: doubts
      type(examination_t) :: found
      character(:), allocatable :: checksum, folder, words
      integer :: k, failed, code

      call load_deck(arguments, suspension, cases, checksum, error)
      if (allocated(error)) return
      call chosen_cases(arguments, cases, chosen, error)
      if (allocated(error)) return
      folder = arguments%out
      if (len(folder) == 0) folder = 'out'
      if (folder == '-' .and. size(chosen) > 1) then
         call fail(error, exit_usage, '--out - writes one table, but '//arguments%file//' has '//str(size(chosen))// &
            ' cases; name one with --case')
         return
      end if
      if (arguments%compliance) then
         call refuse_double_files(chosen, error)
         if (allocated(error)) return
      end if
      call examine_cases(suspension, chosen, found)
      if (found%none_solvable()) then
         call fail(error, exit_model, unsolvable_words(arguments%file, found))
         return
      end if
      if (folder /= '-') then
         call make_folder(folder, error)
         if (allocated(error)) return
      end if
      call balance(suspension, chosen(1)%tolerance, error)
      if (allocated(error)) return
      call say_preloads(arguments, suspension)
      call patch_words(suspension, doubts)
      call spring_words(suspension, chosen, doubts)
      do k = 1, doubts%count()
         call warn(doubts%line(k))
      end do
      call warn_of_balance(suspension)
      call warn_of_remarks(suspension, cases)

      failed = 0
      code = exit_convergence
      do k = 1, size(chosen)
         if (found%is_solvable(k)) then
            call run_case(arguments, suspension, chosen(k), folder, checksum, unheard, trouble)
         else
            call fail(trouble, exit_model, found%faults%line(k))
         end if
         if (.not. allocated(trouble)) cycle
         if (trouble%code /= exit_convergence .and. size(chosen) == 1) then
            call move_alloc(trouble, error)
            return
         end if
         call complain(trouble%message)
         failed = failed + 1
         if (code == exit_convergence) code = trouble%code     ! the first other than lack of convergence
      end do
      if (failed == 0) then
         call move_alloc(unheard, error)
         return
      end if
      words = str(failed)//' of '//plural(size(chosen), 'case', 'cases')
      if (code == exit_convergence) then
         call fail(error, code, words//' did not converge at every state; the converged states were written')
      else
         call fail(error, code, words//' failed (see above); the others were written')
      end if
   end subroutine run

   !> Refuses a case whose table would have the file name of another case's compliance matrix.
   subroutine refuse_double_files(cases, error)
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: k, j

      do k = 1, size(cases)
         do j = 1, size(cases)
            if (cases(j)%name//'.csv' /= cases(k)%name//compliance_ending) cycle
            call fail(error, exit_usage, '--compliance: the compliance matrix of case '//quoted(cases(k)%name)// &
               ' would overwrite the results of case '//quoted(cases(j)%name)//'; rename one, or choose with --case')
            return
         end do
      end do
   end subroutine refuse_double_files

   !> One case: sweep, report, write, draw.
   subroutine run_case(arguments, base, wanted, folder, checksum, unheard, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: wanted
      character(*), intent(in) :: folder, checksum
      type(error_t), allocatable, intent(inout) :: unheard     !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble, undrawn
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
      type(table_t) :: table
      type(message_list_t) :: doubts
      character(:), allocatable :: name, words, lost
      integer :: side

      suspension = base
      case = wanted
      call mount(suspension, case, error)
      if (allocated(error)) return
      kkt = new_kkt(suspension)
      call ask_memory(sweep_bytes(suspension, case), 'case '//quoted(case%name)//' with '// &
         plural(case%increments, 'increment', 'increments'), error)
      if (allocated(error)) return
      call sweep(suspension, case, path, kkt, show_progress)
      if (path%states > 1000) call clear_progress()
      words = ''
      do side = 1, 2
         if (path%failure(side)%state == 0) cycle
         call add_line(words, failure_words(suspension, case, path, path%failure(side), kkt))
      end do
      call say_settled(arguments, suspension, case, path)
      call warn_of_drift(suspension, case, path, kkt, lost)
      call warn_of_travel(suspension, case, path)
      call stability_words(suspension, case, path, doubts)
      call rack_words(suspension, case, doubts)
      call curve_reach_words(suspension, case, path, doubts)
      do side = 1, doubts%count()
         call warn('case '//quoted(case%name)//': '//doubts%line(side))
      end do
      call sweep_table(suspension, case, path, kkt, table)
      call add_line(words, lost)
      call add_line(words, open_words(case, table))
      if (len(words) > 0) call fail(error, exit_convergence, words)

      call add_header(table, suspension, case, checksum)
      if (folder == '-') then
         call tell_csv(table, trouble)
      else
         name = join_path(folder, suspension%name//'_'//case%name//'.csv')
         call write_csv(table, name, trouble)
         if (.not. allocated(trouble)) then
            call tell_path(name, unheard)
            if (arguments%plot) call draw(arguments, suspension, case, table, folder, name, undrawn)
            if (arguments%compliance) call write_compliance(suspension, case, path, checksum, folder, kkt, unheard, trouble)
         end if
      end if
      if (.not. allocated(trouble) .and. len(case%target) > 0) &
         call aim(arguments, suspension, case, path, table, checksum, folder, kkt, unheard, trouble)
      if (.not. allocated(trouble)) call move_alloc(undrawn, trouble)
      if (.not. allocated(trouble)) return
      call add_line(words, trouble%message)
      call fail(error, trouble%code, words)
   end subroutine run_case

   !> Writes the compliance matrix at every converged state to a separate file.
   subroutine write_compliance(suspension, case, path, checksum, folder, kkt, unheard, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      character(*), intent(in) :: checksum, folder
      type(kkt_t), intent(inout) :: kkt
      type(error_t), allocatable, intent(inout) :: unheard     !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error
      type(table_t) :: table
      character(:), allocatable :: name

      call compliance_table(suspension, case, path, kkt, table)
      call add_header(table, suspension, case, checksum)
      name = join_path(folder, suspension%name//'_'//case%name//compliance_ending)
      call write_csv(table, name, error)
      if (.not. allocated(error)) call tell_path(name, unheard)
   end subroutine write_compliance

   !> Finds the swept value that meets the target of a case, reports it, and writes its state to a separate file (unless the
   !> results go to standard output). Not for the linear methods, whose states are not equilibria.
   subroutine aim(arguments, suspension, case, path, table, checksum, folder, kkt, unheard, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(table_t), intent(in) :: table
      character(*), intent(in) :: checksum, folder
      type(kkt_t), intent(inout) :: kkt
      type(error_t), allocatable, intent(inout) :: unheard     !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error
      type(target_t) :: found
      character(:), allocatable :: name, words

      if (case%method /= 'equilibrium') then
         call say(arguments%quiet, 'case '//quoted(case%name)//': a target is solved with method ''equilibrium'' only')
         return
      end if
      call find_target(suspension, case, path, table, kkt, found, error)
      if (allocated(error)) return
      if (folder /= '-') then
         call add_header(found%table, suspension, case, checksum)
         call found%table%header%add('target: '//found%column//' = '//str(found%wanted))
         name = join_path(folder, suspension%name//'_'//case%name//'_target.csv')
         call write_csv(found%table, name, error)
         if (allocated(error)) return
         call tell_path(name, unheard)
      end if
      words = 'case '//quoted(case%name)//': '//found%column//' = '//str(found%wanted)//' at '//case%place_name//' = '// &
         str(found%place/case%unit, 9)//' '//case%unit_name
      if (found%crossings > 1) words = words//' (of '//str(found%crossings)//' solutions the nearest to design)'
      call say(arguments%quiet, words)
   end subroutine aim

   !> Figures of a case.
   subroutine draw(arguments, suspension, case, table, folder, csv, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(table_t), intent(in) :: table
      character(*), intent(in) :: folder, csv
      type(error_t), allocatable, intent(out) :: error
      type(figure_t), allocatable :: figures(:)
      character(64), allocatable :: elements(:)
      character(:), allocatable :: model, message, label
      integer :: k

      allocate (elements(size(suspension%elements) - suspension%scalars))
      do k = 1, size(elements)
         elements(k) = suspension%elements(suspension%scalars + k)%name
      end do
      model = suspension%title
      if (len(model) == 0) model = suspension%name
      if (is_vertical(suspension, case)) then
         call run_figures(table, model, case%name, base_name(csv)//'.csv', figures, elements=elements)
      else
         label = case%place_name
         if (case%unit_name /= '-') label = label//' ['//case%unit_name//']'
         call run_figures(table, model, case%name, base_name(csv)//'.csv', figures, 'factor', label, elements, &
            case%test == 'table')
      end if
      do k = 1, size(figures)
         call write_figure(figures(k), folder, error)
         if (allocated(error)) return
      end do
      call render_figures(figures, folder, message, error)
      if (allocated(error)) return
      if (len(message) > 0) then
         call say(arguments%quiet, message)
      else
         call say(arguments%quiet, 'case '//quoted(case%name)//': '//str(size(figures))//' figures in '//folder// &
            ' ('//figures(1)%name//'.png …)')
      end if
   end subroutine draw

   !> Whether a case mainly moves the wheel vertically, so that its figures are plotted over the wheel travel.
   pure logical function is_vertical(suspension, case)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(*), parameter :: vertical_tests(3) = [character(15) :: 'parallel_travel', 'single_travel', 'vertical_force']
      integer :: k

      is_vertical = case%drive == 'wheel_travel' .or. any(case%test == vertical_tests)
      k = load_number(suspension, case%load)
      if (k == 0) return
      is_vertical = abs(suspension%loads(k)%force(3)) >= norm2(suspension%loads(k)%force(1:2)) &
         .and. norm2(suspension%loads(k)%moment) <= 0.0_wp
   end function is_vertical

   !> The header lines above the table.
   subroutine add_header(table, suspension, case, checksum)
      type(table_t), intent(inout) :: table
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(*), intent(in) :: checksum

      call table%header%add('model '//suspension%name//', case '//case%name//', method '//case%method// &
         trim(merge(', follow arc', '            ', case%follows_arc))//', tolerance '//str(case%tolerance/millimetre)//' mm')
      if (len(case%test) > 0) then
         call table%header%add('factor: '//case%place_name//' ['//case%unit_name//'], test '//case%test)
      else if (len(case%load) > 0) then
         call table%header%add('factor: multiplier of load '//quoted(case%load))
      else
         call table%header%add('factor: '//case%place_name//' ['//case%unit_name//']')
      end if
      call table%header%add(frame_line(suspension%is_iso, single_side(suspension)))
      call table%header%add('elastokin '//version//', deck checksum '//checksum)
      call table%header%add('spring force > 0: compression. Bushing force and moment: on its second body, axes of its first '// &
         'marker. Joint force and moment: on its second body, at its point, frame of the deck')
   end subroutine add_header

end module ek_run
