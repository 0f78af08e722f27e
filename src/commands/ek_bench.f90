!> elastokin bench: time per increment, relative to LAPACK's factorisation and solution alone.
!>
!> The unit is the time of dsysv for the matrices of the sweep (scaled KKT matrices of its equilibrium states) with one right-hand
!> side. dsysv and the methods are timed in turn in the same run, so that the ratios do not depend on the speed of the machine. All
!> times are processor times, and the minimum of many rounds counts for each measurement, so that the load of the machine does not
!> change the ratios.
module ek_bench
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence, exit_file
   use ek_text, only: quoted
   use ek_clock, only: processor_seconds
   use ek_rig_test, only: is_scattered
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, method_names
   use ek_kkt, only: kkt_t, new_kkt
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_path, only: path_t, sweep
   use ek_rig, only: mount
   use ek_examination, only: examination_t
   use ek_sweep_table, only: sweep_table
   use ek_table, only: table_t, csv_text
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen
   use ek_increment_parts, only: parts_t, time_walk, time_parts
   use ek_bench_figures, only: figures_t, table_of, json_of
   use ek_bench_times, only: rounds, collect_matrices, time_lapack, time_packs, time_kandc, time_designs
   use ek_growth, only: bench_growth
   use ek_bench_derivatives, only: bench_derivatives
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: bench

   character(*), parameter :: nl = new_line('a')

contains

   !> Prints the time ratios of a case to standard output; with --json, prints them as a JSON object. With --growth or
   !> --derivatives, makes the measurement of ek_growth or ek_bench_derivatives instead.
   subroutine bench(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(deck_settings_t) :: settings
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt, planned
      type(path_t) :: path, exact
      type(parts_t) :: linear
      type(figures_t) :: figures
      real(wp), allocatable :: matrices(:, :, :)
      real(wp) :: together, copying
      integer :: k, m

      if (line%has('--growth')) then
         call bench_growth(line, error)
         return
      else if (line%has('--derivatives')) then
         call bench_derivatives(line, error)
         return
      end if
      call read_deck_settings(line, settings)
      call load_case(settings, suspension, case, error)
      if (allocated(error)) return
      kkt = new_kkt(suspension)
      planned = new_kkt(suspension, wants_plan=.true.)
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
      do k = 1, rounds
         call time_lapack(kkt%n, matrices, together, copying, error)
         if (allocated(error)) return
         do m = 1, 2
            case%method = method_names(m)
            linear%increment = figures%increment(m)
            call time_walk(suspension, case, path, kkt, linear)
            figures%increment(m) = linear%increment
         end do
         case%method = 'equilibrium'
         call time_walk(suspension, case, path, kkt, figures%lapack)
         call time_walk(suspension, case, path, planned, figures%plan)
      end do
      figures%unit = together - copying
      figures%fallbacks = planned%fallbacks/rounds
      call time_parts(suspension, case, path, kkt, figures%lapack)
      call time_parts(suspension, case, path, planned, figures%plan)
      call time_packs(suspension, case, planned, figures)
      figures%model = suspension%name
      figures%case = case%name
      figures%increments = case%increments
      figures%n = kkt%n
      figures%nonzeros = planned%pattern%entries
      figures%length = planned%plan(1)%length
      call sweep(suspension, case, path, kkt)
      figures%factorisations = real(sum(path%iterations), wp)/path%states
      figures%most = maxval(path%iterations)
      call time_kandc(suspension, case, path, planned, figures)
      case%tolerance = 1.0e-13_wp     ! m, a thousand times tighter than the default
      call sweep(suspension, case, exact, kkt)
      figures%distance = largest_distance(path, exact, kkt%nq/6)
      if (.not. is_scattered(case%test)) call time_designs(settings, case%name, figures, error)
      if (allocated(error)) return
      if (line%has('--json')) then
         call print_text(json_of(figures)//nl, error)
      else
         call print_text(table_of(figures), error)
         if (.not. allocated(error) .and. .not. line%has('--quiet')) call whole_way(settings, error)
      end if
   end subroutine bench

   !> Reads a deck, examines its model for the first chosen case, applies the preload trim (`balance`), and mounts the case on the
   !> rig.
   subroutine load_case(settings, suspension, case, error)
      type(deck_settings_t), intent(in) :: settings
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: workspace
      type(case_t), allocatable :: chosen(:)
      type(examination_t) :: found
      character(:), allocatable :: checksum

      call load_deck(settings, workspace, checksum, error)
      if (.not. allocated(error)) call chosen_cases(settings, workspace%raw, workspace%design%cases, chosen, error)
      if (.not. allocated(error)) call examine_chosen(settings%file, workspace%raw, chosen(1:1), found, error)
      if (.not. allocated(error)) call balance_or_explain(chosen(1)%tolerance, workspace, error)
      if (allocated(error)) return
      if (.not. is_mountable(chosen(1))) then
         call fail(error, exit_file, chosen(1)%table%fault)
         return
      end if
      call mount(workspace%suspension, chosen(1), suspension, case)
   end subroutine load_case

   !> The largest distance [m] between the positions of a body at one state in two sweeps, over all bodies and states.
   pure real(wp) function largest_distance(a, b, bodies) result(largest)
      type(path_t), intent(in) :: a, b
      integer, intent(in) :: bodies
      integer :: j

      largest = 0.0_wp
      do j = 1, 7*bodies, 7
         largest = max(largest, maxval(norm2(a%packed(j:j + 2, :a%states) - b%packed(j:j + 2, :a%states), dim=1)))
      end do
   end function largest_distance

   !> Prints the times of all steps from deck to CSV string within this process [ms]. The shortest of five rounds counts for each
   !> step.
   subroutine whole_way(settings, error)
      type(deck_settings_t), intent(in) :: settings
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
      type(table_t) :: table
      character(200) :: line
      real(wp) :: marks(5), least(4)
      integer :: k, bytes

      least = huge(least)
      do k = 1, 5
         marks(1) = processor_seconds()
         call load_case(settings, suspension, case, error)
         if (allocated(error)) return
         kkt = new_kkt(suspension)
         marks(2) = processor_seconds()
         call sweep(suspension, case, path, kkt)
         marks(3) = processor_seconds()
         call sweep_table(suspension, case, path, kkt, table)
         marks(4) = processor_seconds()
         bytes = len(csv_text(table))
         marks(5) = processor_seconds()
         least = min(least, marks(2:) - marks(:4))
      end do
      write (line, '(4(a,f7.2),a,i0,a)') 'deck to CSV [ms]: deck and model ', 1000*least(1), ', sweep ', 1000*least(2), &
         ', table ', 1000*least(3), ', CSV text ', 1000*least(4), ' (', bytes, ' bytes)'
      call print_text(trim(line)//nl, error)
   end subroutine whole_way

end module ek_bench
