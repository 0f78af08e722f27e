!> elastokin run: deck → model → sweep → table → CSV and figures, case by case.
module ek_run
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_model, exit_convergence
   use ek_units, only: degree, millimetre
   use ek_text, only: str, quoted, plural
   use ek_version, only: version
   use ek_file, only: make_folder, join_path, base_name
   use ek_suspension, only: suspension_t, body_name, add_travel_driver, load_number
   use ek_case, only: case_t
   use ek_state, only: state_t, design_state, unpack_state
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_diagnosis, only: diagnosis_t, diagnose
   use ek_path, only: path_t, failure_t, sweep
   use ek_attitude, only: attitude_t
   use ek_sweep_table, only: sweep_table, wheel_attitude, factor_unit
   use ek_drift, only: drift_t, drift_at
   use ek_table, only: table_t
   use ek_csv, only: write_csv, csv_text
   use ek_figure, only: figure_t
   use ek_plot, only: run_figures
   use ek_gnuplot, only: write_figure, render_figures
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: load_deck, chosen_cases
   use ek_words, only: say, warn, complain, show_progress, clear_progress
   implicit none(type, external)
   private
   public :: run

contains

   !> Runs the chosen cases of a deck. A case that fails part way is written as far as it came, the
   !> others go on, and the error at the end has code exit_convergence.
   subroutine run(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), chosen(:)
      type(error_t), allocatable :: trouble
      character(:), allocatable :: checksum, folder
      integer :: k, failed

      call load_deck(arguments, suspension, cases, checksum, error)
      if (allocated(error)) return
      call chosen_cases(arguments, cases, chosen, error)
      if (allocated(error)) return
      folder = arguments%out
      if (len(folder) == 0) folder = 'out'
      if (folder /= '-') then
         call make_folder(folder, error)
         if (allocated(error)) return
      end if
      call balance(suspension, chosen(1)%tolerance, error)
      if (allocated(error)) return
      call say_preloads(arguments, suspension)

      failed = 0
      do k = 1, size(chosen)
         call run_case(arguments, suspension, chosen(k), folder, checksum, trouble)
         if (.not. allocated(trouble)) cycle
         if (trouble%code /= exit_convergence) then
            call move_alloc(trouble, error)
            return
         end if
         call complain(trouble%message)
         failed = failed + 1
      end do
      if (failed > 0) call fail(error, exit_convergence, plural(failed, 'case', 'cases')//' of '//str(size(chosen))// &
         ' ended early; all states before are written')
   end subroutine run

   !> One case: examine, sweep, tell, write, draw.
   subroutine run_case(arguments, base, case, folder, checksum, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: base
      type(case_t), intent(in) :: case
      character(*), intent(in) :: folder, checksum
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: trouble
      type(suspension_t) :: suspension
      type(kkt_t) :: kkt
      type(diagnosis_t) :: diagnosis
      type(path_t) :: path
      type(table_t) :: table
      character(:), allocatable :: name
      integer :: side

      suspension = base
      if (case%drive == 'wheel_travel') call add_travel_driver(suspension, case%wheel)
      kkt = new_kkt(suspension)
      call diagnose(suspension, design_state(suspension), kkt, diagnosis)
      if (.not. diagnosis%is_solvable()) then
         call fail(error, exit_model, 'case '//quoted(case%name)//': the model cannot be solved'//new_line('a')//diagnosis%words())
         return
      end if

      call sweep(suspension, case, path, kkt, show_progress)
      if (path%states > 1000) call clear_progress()
      do side = 1, 2
         if (path%failure(side)%state > 0 .and. .not. allocated(error)) &
            call fail(error, exit_convergence, failure_words(suspension, case, path, path%failure(side)))
      end do
      call say_settled(arguments, suspension, case, path)
      call warn_of_drift(suspension, case, path, kkt)
      call warn_of_instability(suspension, case, path)

      call sweep_table(suspension, case, path, kkt, table)
      call add_header(table, suspension, case, checksum)
      if (folder == '-') then
         write (output_unit, '(a)', advance='no') csv_text(table)
         return
      end if
      name = join_path(folder, suspension%name//'_'//case%name//'.csv')
      call write_csv(table, name, trouble)
      if (.not. allocated(trouble)) then
         write (output_unit, '(a)') name
         if (arguments%plot) call draw(arguments, suspension, case, table, folder, name, trouble)
      end if
      if (allocated(trouble)) call move_alloc(trouble, error)
   end subroutine run_case

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
      character(:), allocatable :: model, message
      integer :: k

      allocate (elements(size(suspension%bushings)))
      do k = 1, size(elements)
         elements(k) = suspension%bushings(k)%name
      end do
      model = suspension%title
      if (len(model) == 0) model = suspension%name
      if (is_vertical(suspension, case)) then
         call run_figures(table, model, case%name, base_name(csv)//'.csv', figures, elements=elements)
      else
         call run_figures(table, model, case%name, base_name(csv)//'.csv', figures, 'factor', &
            'factor of load '//case%load, elements)
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

   !> Whether a case moves the wheel up and down in the first place, so that its figures stand over the stroke.
   pure logical function is_vertical(suspension, case)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer :: k

      is_vertical = .true.
      k = load_number(suspension, case%load)
      if (k == 0) return
      is_vertical = abs(suspension%loads(k)%force(3)) >= norm2(suspension%loads(k)%force(1:2)) &
         .and. norm2(suspension%loads(k)%moment) <= 0.0_wp
   end function is_vertical

   !> The lines above the table.
   subroutine add_header(table, suspension, case, checksum)
      type(table_t), intent(inout) :: table
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(*), intent(in) :: checksum

      call table%header%add('model '//suspension%name//', case '//case%name//', method '//case%method// &
         ', tolerance '//str(case%tolerance/millimetre)//' mm')
      if (len(case%load) > 0) then
         call table%header%add('factor: of load '//quoted(case%load))
      else
         call table%header%add('factor: change of '//case%drive//' ['//trim(factor_name(suspension, case))//']')
      end if
      call table%header%add('elastokin '//version//', deck checksum '//checksum)
      call table%header%add('spring force > 0: compression. Bushing force and moment: on its second body, axes of its first '// &
         'marker. Joint force and moment: on its second body, at its point, frame of the deck')
   end subroutine add_header

   !> 'mm', 'deg' or '-'
   function factor_name(suspension, case) result(name)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(3) :: name
      real(wp) :: unit

      unit = factor_unit(suspension, case)
      name = '-'
      if (abs(unit - millimetre) <= 0.0_wp) name = 'mm'
      if (abs(unit - degree) <= 0.0_wp) name = 'deg'
   end function factor_name

   !> By how much the wheels moved under the constant loads.
   subroutine say_settled(arguments, suspension, case, path)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(state_t) :: state
      type(attitude_t) :: attitude
      real(wp), parameter :: noticeable = 1.0e-8_wp      ! m
      integer :: k

      if (case%method == 'recursive') return
      if (count(path%is_reached) == 0) return
      state = design_state(suspension)
      call unpack_state(path%settled, state)
      do k = 1, size(suspension%wheels)
         attitude = wheel_attitude(suspension, state, k)
         if (norm2(attitude%centre) <= noticeable) cycle
         call say(arguments%quiet, 'case '//quoted(case%name)//': under the constant loads wheel '// &
            quoted(suspension%wheels(k)%name)//' settles by '//str(attitude%centre(3)/millimetre, 4)//' mm (toe '// &
            str((attitude%toe)/degree, 4)//' deg, camber '//str(attitude%camber/degree, 4)//' deg there)')
      end do
   end subroutine say_settled

   !> What balance has found.
   subroutine say_preloads(arguments, suspension)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      integer :: k

      if (suspension%balance == 'none') return
      do k = 1, size(suspension%springs)
         call say(arguments%quiet, 'balance: preload of spring '//quoted(suspension%springs(k)%name)//' = '// &
            str(suspension%springs(k)%preload, 9)//' N (compression)')
      end do
   end subroutine say_preloads

   !> The linear methods against one equilibrium solution at either end of the sweep.
   subroutine warn_of_drift(suspension, case, path, kkt)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt
      type(drift_t) :: drift
      real(wp), parameter :: much_travel = 1.0e-5_wp     ! m: 0.01 mm, about what a K&C rig resolves
      real(wp), parameter :: much_angle = 1.0e-3_wp*degree
      integer :: k, ends(2), n

      if (case%method == 'equilibrium') return
      ends = [1, path%states]
      do n = 1, 2
         k = ends(n)
         if (.not. path%is_reached(k) .or. k == path%start) cycle
         call drift_at(suspension, case, path, k, kkt, drift)
         if (.not. drift%is_known) then
            call warn('case '//quoted(case%name)//', method '//case%method// &
               ': no equilibrium was found near the state at factor '// &
               str(path%value(k)/factor_unit(suspension, case))//'; do not trust it')
         else if (abs(drift%travel) > much_travel .or. max(abs(drift%toe), abs(drift%camber)) > much_angle) then
            call warn('case '//quoted(case%name)//', method '//case%method//': at factor '// &
               str(path%value(k)/factor_unit(suspension, case))//' the state is off equilibrium by '// &
               str(drift%travel/millimetre, 3)//' mm travel, '//str(drift%toe/degree, 3)//' deg toe, '// &
               str(drift%camber/degree, 3)//' deg camber'//advice(case))
         end if
      end do
   end subroutine warn_of_drift

   !> What to do about drift.
   pure function advice(case) result(text)
      type(case_t), intent(in) :: case
      character(:), allocatable :: text
      text = '; more increments make it smaller'
      if (case%method == 'recursive') text = ' (the bias of this method, which more increments do not remove; '// &
         'method = ''equilibrium'' has none)'
   end function advice

   !> States that a real suspension would leave at once.
   subroutine warn_of_instability(suspension, case, path)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      integer :: unstable, first

      if (case%method == 'recursive') return     ! its matrix has no geometric stiffness to tell by
      unstable = count(path%is_reached .and. .not. path%is_stable)
      if (unstable == 0) return
      first = findloc(path%is_reached .and. .not. path%is_stable, .true., dim=1)
      call warn('case '//quoted(case%name)//': '//plural(unstable, 'state is', 'states are')// &
         ' unstable (negative stiffness: over centre or buckled), the first at factor '// &
         str(path%value(first)/factor_unit(suspension, case)))
   end subroutine warn_of_instability

   !> Where a sweep stopped, which body moved most in the attempt, which joint is furthest off.
   function failure_words(suspension, case, path, failure) result(text)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(failure_t), intent(in) :: failure
      character(:), allocatable :: text
      real(wp) :: unit

      unit = factor_unit(suspension, case)
      if (count(path%is_reached) == 0) then
         text = 'case '//quoted(case%name)//': no equilibrium under the constant loads'
      else
         text = 'case '//quoted(case%name)//': state '//str(failure%state - 1)//' (factor '// &
            str(path%value(failure%state)/unit)//') was not found; equilibrium is lost between factor '// &
            str(failure%reached/unit, 8)//' and '//str(failure%value/unit, 8)
      end if
      if (failure%is_singular) text = text//'; the matrix is singular there'
      if (failure%body > 0) text = text//'; body '//quoted(body_name(suspension, failure%body))// &
         ' moved most in the last attempt ('//str(failure%moved/millimetre, 3)//' mm)'
      if (failure%row > 0) text = text//'; joint '//quoted(suspension%joints(suspension%rows(failure%row)%joint)%name)// &
         ' is furthest from closing'
   end function failure_words

end module ek_run
