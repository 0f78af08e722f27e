!> elastokin bench: time per increment, relative to LAPACK's factorisation and solution alone.
!>
!> The unit is dsysv on the matrices of the sweep (scaled KKT matrices of its equilibrium states) with one
!> right-hand side, timed alternately with the methods in the same run: the ratio then does not depend on the
!> speed or load of the machine. The minimum time of several rounds is reported for each.
module ek_bench
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence, exit_file
   use ek_text, only: str, quoted
   use ek_clock, only: seconds
   use ek_lapack, only: dsysv
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, method_names
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, new_kkt, assemble, whole_tangent
   use ek_balance, only: balance
   use ek_path, only: path_t, new_path, walk, sweep
   use ek_rig, only: mount
   use ek_examination, only: examination_t
   use ek_sweep_table, only: sweep_table, observe
   use ek_table, only: table_t, csv_text
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen, read_changed
   use ek_deck, only: deck_t
   use ek_parameter, only: choice_t
   use ek_worker, only: worker_t, factor_paths_t, make_worker, change_design
   use ek_case_result, only: solve_options_t, solve_mounted
   use ek_wheel_side, only: prefix_of
   use ek_json, only: json_t, json_string, json_number
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: bench

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: rounds = 15          !! each method is timed this often; the minimum counts
   integer, parameter :: kept_numbers = 2**17 !! size of the matrices kept for the unit: 1 MB stays in the cache

   integer, parameter :: short_sweep = 20     !! increments of a design, like those of a study
   integer, parameter :: designs = 10         !! timed together

   !> What was measured.
   type :: figures_t
      real(wp) :: unit = 0.0_wp              !! dsysv [s]
      real(wp) :: increment(3) = 0.0_wp      !! of each method [s]
      real(wp) :: factorisations = 0.0_wp    !! per state
      integer :: most = 0                    !! factorisations of one state
      real(wp) :: distance = 0.0_wp          !! from the exact solution [m]
      real(wp) :: design = 0.0_wp            !! a design of short_sweep increments, from numbers to a column [s]; 0: not measured
      real(wp) :: states = 0.0_wp            !! its states and the column alone [s]
   end type figures_t

contains

   !> Prints the table of ratios to standard output, or with --json an object.
   subroutine bench(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(deck_settings_t) :: settings
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path, exact
      type(figures_t) :: figures
      real(wp), allocatable :: matrices(:, :, :)
      real(wp) :: together, copying, start
      integer :: k, m

      call read_deck_settings(line, settings)
      call load_case(settings, suspension, case, error)
      if (allocated(error)) return
      kkt = new_kkt(suspension)
      case%method = 'equilibrium'
      case%follows_arc = .false.       ! the methods are compared over the factor
      call sweep(suspension, case, path, kkt)
      if (any(path%failure%state > 0)) then
         call fail(error, exit_convergence, 'case '//quoted(case%name)//' does not converge at every state and cannot be timed')
         return
      end if
      call collect_matrices(suspension, case, path, kkt, matrices)

      together = huge(together)
      copying = huge(copying)
      figures%increment = huge(together)
      do k = 1, rounds
         call time_lapack(kkt%n, matrices, together, copying, error)
         if (allocated(error)) return
         do m = 1, 3
            case%method = method_names(m)
            call new_path(suspension, case, path)
            start = seconds()
            call walk(suspension, case, path, kkt)
            figures%increment(m) = min(figures%increment(m), (seconds() - start)/(path%states - 1))
         end do
      end do
      figures%unit = together - copying
      case%method = 'equilibrium'
      call sweep(suspension, case, path, kkt)
      figures%factorisations = real(sum(path%iterations), wp)/path%states
      figures%most = maxval(path%iterations)
      case%tolerance = 1.0e-13_wp     ! m, a thousand times tighter than the default
      call sweep(suspension, case, exact, kkt)
      figures%distance = largest_distance(path, exact, kkt%nq/6)
      if (case%test /= 'table') call time_designs(settings, case%name, figures, error)
      if (allocated(error)) return
      if (line%has('--json')) then
         call print_text(json_of(suspension, case, kkt%n, figures)//nl, error)
      else
         call print_text(table_of(suspension, case, kkt%n, figures), error)
         if (.not. allocated(error) .and. .not. line%has('--quiet')) call whole_way(settings, error)
      end if
   end subroutine bench

   !> The figures as lines.
   function table_of(suspension, case, n, figures) result(text)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: n                   !! size of the matrix
      type(figures_t), intent(in) :: figures
      character(:), allocatable :: text
      character(200) :: line
      integer :: m

      text = 'model '//suspension%name//', case '//case%name//', '//str(case%increments)//' increments, matrix '// &
         str(n)//' x '//str(n)//nl//timing('LAPACK dsysv alone', figures%unit, figures%unit)
      do m = 1, 3
         text = text//timing(trim(method_names(m))//' increment', figures%increment(m), figures%unit)
      end do
      text = text//'equilibrium: converged states per second '//str(nint(1.0_wp/figures%increment(3)))//nl
      write (line, '(a,f5.3,a,i0)') 'equilibrium: factorisations per state ', figures%factorisations, ', at most ', figures%most
      text = text//trim(line)//nl
      write (line, '(a,es8.1,a)') 'equilibrium: largest distance to the solution at tolerance 1e-10 mm: ', &
         figures%distance*1000.0_wp, ' mm'
      text = text//trim(line)//nl
      if (.not. figures%design > 0.0_wp) return
      write (line, '(a,i0,a,f0.1,a,f0.1,a,i0)') 'design of ', short_sweep, ' increments, from numbers to a column: ', &
         figures%design*1.0e6_wp, ' us, ', (figures%design - figures%states)*1.0e6_wp, &
         ' us more than its states and the column; designs per second ', &
         nint(1.0_wp/figures%design)
      text = text//trim(line)//nl
   end function table_of

   !> The figures as a JSON object.
   function json_of(suspension, case, n, figures) result(text)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: n                   !! size of the matrix
      type(figures_t), intent(in) :: figures
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: m

      call json%open('{')
      call json%item('model', json_string(suspension%name))
      call json%item('case', json_string(case%name))
      call json%item('increments', str(case%increments))
      call json%item('n', str(n))
      call json%item('unit_us', json_number(figures%unit*1.0e6_wp))
      do m = 1, 3
         call json%item(trim(method_names(m))//'_units', json_number(figures%increment(m)/figures%unit))
      end do
      call json%item('states_per_s', json_number(1.0_wp/figures%increment(3)))
      call json%item('factorisations_per_state', json_number(figures%factorisations))
      call json%item('max_factorisations', str(figures%most))
      call json%item('distance_mm', json_number(figures%distance*1000.0_wp))
      if (figures%design > 0.0_wp) then
         call json%item('design_us', json_number(figures%design*1.0e6_wp))
         call json%item('design_states_us', json_number(figures%states*1.0e6_wp))
         call json%item('designs_per_s', json_number(1.0_wp/figures%design))
      end if
      call json%close('}')
      text = json%text()
   end function json_of

   !> Times whole designs, as a study runs them: numbers to suspension, examination, balance, states and one column; and the
   !> states with the column alone. The first given number of the deck is changed in its tenth digit.
   subroutine time_designs(settings, case_name, figures, error)
      type(deck_settings_t), intent(in) :: settings
      character(*), intent(in) :: case_name
      type(figures_t), intent(inout) :: figures
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(worker_t) :: worker
      type(factor_paths_t) :: paths(1)
      type(solve_options_t) :: options
      real(wp) :: start, value, time
      logical :: is_done
      integer :: k, d

      call read_changed(settings%file, settings%changes, deck, error)
      if (.not. allocated(error)) call make_worker(deck, [case_name], worker, error)
      if (allocated(error)) return
      associate (list => worker%design%parameters%list, x => worker%design%parameters%x)
         do k = 1, worker%design%parameters%used
            if (list(k)%is_given .and. abs(x(k)) > 0.0_wp) exit
         end do
         paths(1)%found = [choice_t(k, 1.0_wp)]
         value = x(k)/list(k)%unit
      end associate
      worker%design%cases%increments = short_sweep
      options%has_remarks = .false.
      allocate (options%columns(1))
      options%columns = 'toe_deg'
      if (size(worker%suspension%wheels) > 1) options%columns = prefix_of(worker%suspension, 1)//'toe_deg'
      figures%design = huge(time)
      figures%states = huge(time)
      do k = 1, 5
         start = seconds()
         do d = 1, designs
            call change_design(paths, [value*(1.0_wp + 1.0e-10_wp*d)], worker, is_done)
            if (.not. is_done) then      ! such a model has no design from numbers
               figures%design = 0.0_wp
               return
            end if
            call solve_mounted(options, worker%cases(1)%result, observer=worker%cases(1)%observer)
         end do
         figures%design = min(figures%design, (seconds() - start)/designs)
         start = seconds()
         do d = 1, designs
            associate (this => worker%cases(1)%result)
               call sweep(this%suspension, this%case, this%path, this%kkt)
               call observe(this%suspension, this%case, this%path, this%kkt, worker%cases(1)%observer, this%table)
            end associate
         end do
         figures%states = min(figures%states, (seconds() - start)/designs)
      end do
   end subroutine time_designs

   !> The first chosen case of a deck on the rig, examined and balanced.
   subroutine load_case(settings, suspension, case, error)
      type(deck_settings_t), intent(in) :: settings
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: base
      type(case_t), allocatable :: cases(:), chosen(:)
      type(examination_t) :: found
      character(:), allocatable :: checksum

      call load_deck(settings, base, cases, checksum, error)
      if (.not. allocated(error)) call chosen_cases(settings, cases, chosen, error)
      if (.not. allocated(error)) call examine_chosen(settings%file, base, chosen(1:1), found, error)
      if (.not. allocated(error)) call balance(base, chosen(1)%tolerance, error)
      if (allocated(error)) return
      if (.not. is_mountable(chosen(1))) then
         call fail(error, exit_file, chosen(1)%table%fault)
         return
      end if
      call mount(base, chosen(1), suspension, case)
   end subroutine load_case

   !> Name, microseconds, ratio.
   function timing(name, time, unit) result(line)
      character(*), intent(in) :: name
      real(wp), intent(in) :: time, unit
      character(:), allocatable :: line
      character(100) :: words

      write (words, '(a,t28,f9.3,a,f7.2,a)') name, time*1.0e6_wp, ' us', time/unit, ' units'
      line = trim(words)//nl
   end function timing

   !> The scaled matrices of some states of a sweep.
   subroutine collect_matrices(suspension, case, path, kkt, matrices)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt
      real(wp), allocatable, intent(out) :: matrices(:, :, :)
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      integer :: count, k, state_number, j

      count = min(max(kept_numbers/kkt%n**2, 4), path%states)
      allocate (matrices(kkt%n, kkt%n, count), source=0.0_wp)
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      do k = 1, count
         state_number = 1 + ((k - 1)*(path%states - 1))/max(count - 1, 1)
         call inputs_at(schedule, path%value(state_number), inputs)
         call unpack_state(path%packed(:, state_number), state)
         call assemble(suspension, state, inputs, whole_tangent, kkt)
         do j = 1, kkt%n
            matrices(j:, j, k) = kkt%matrix(j:, j)*kkt%scale(j)*kkt%scale(j:)
         end do
      end do
   end subroutine collect_matrices

   !> Time of dsysv on one of the matrices including a copy of it, and time of the copy alone: the minimum so far of each, so
   !> that a disturbed round affects neither.
   subroutine time_lapack(n, matrices, together, copying, error)
      integer, intent(in) :: n
      real(wp), intent(in) :: matrices(:, :, :)
      real(wp), intent(inout) :: together, copying     !! s
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: a matrix is singular
      real(wp) :: copy(n, n), rhs(n), work(64*n), start
      integer :: pivots(n), k, info
      logical :: is_singular

      start = seconds()
      do k = 1, size(matrices, 3)
         copy = matrices(:, :, k)
         rhs = real(k, wp)
         call keep(copy, rhs)
      end do
      copying = min(copying, (seconds() - start)/size(matrices, 3))
      is_singular = .false.
      start = seconds()
      do k = 1, size(matrices, 3)
         copy = matrices(:, :, k)
         rhs = real(k, wp)
         call dsysv('L', n, 1, copy, n, pivots, rhs, n, work, size(work), info)
         if (info /= 0) is_singular = .true.
      end do
      together = min(together, (seconds() - start)/size(matrices, 3))
      if (is_singular) call fail(error, exit_convergence, 'the matrix of a state is singular and cannot be timed')
   end subroutine time_lapack

   !> Does nothing, but keeps the optimiser from removing the copy as dead code.
   subroutine keep(copy, rhs)
      real(wp), intent(inout) :: copy(:, :), rhs(:)
      if (rhs(1) < 0.0_wp) copy(1, 1) = rhs(1)
   end subroutine keep

   !> The largest distance between bodies of two sweeps [m].
   pure real(wp) function largest_distance(a, b, bodies) result(largest)
      type(path_t), intent(in) :: a, b
      integer, intent(in) :: bodies
      integer :: j

      largest = 0.0_wp
      do j = 1, 7*bodies, 7
         largest = max(largest, maxval(norm2(a%packed(j:j + 2, :a%states) - b%packed(j:j + 2, :a%states), dim=1)))
      end do
   end function largest_distance

   !> Times all steps from deck to CSV text within this process.
   subroutine whole_way(settings, error)
      type(deck_settings_t), intent(in) :: settings
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
      type(table_t) :: table
      character(:), allocatable :: text
      character(200) :: line
      real(wp) :: marks(5)

      marks(1) = seconds()
      call load_case(settings, suspension, case, error)
      if (allocated(error)) return
      kkt = new_kkt(suspension)
      marks(2) = seconds()
      call sweep(suspension, case, path, kkt)
      marks(3) = seconds()
      call sweep_table(suspension, case, path, kkt, table)
      marks(4) = seconds()
      text = csv_text(table)
      marks(5) = seconds()
      write (line, '(4(a,f7.2),a,i0,a)') 'deck to CSV [ms]: deck and model ', 1000*(marks(2) - marks(1)), &
         ', sweep ', 1000*(marks(3) - marks(2)), ', table ', 1000*(marks(4) - marks(3)), &
         ', CSV text ', 1000*(marks(5) - marks(4)), ' (', len(text), ' bytes)'
      call print_text(trim(line)//nl, error)
   end subroutine whole_way

end module ek_bench
