!> elastokin bench: time per increment, relative to LAPACK's factorisation and solution alone.
!>
!> The unit is dsysv on the matrices of the sweep (scaled KKT matrices of its equilibrium states) with one
!> right-hand side, timed alternately with the methods in the same run: the ratio then does not depend on the
!> speed or load of the machine. The minimum time of several rounds is reported for each.
module ek_bench
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_model, exit_convergence, exit_file
   use ek_text, only: str, quoted
   use ek_clock, only: seconds
   use ek_lapack, only: dsysv
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, method_names
   use ek_state, only: state_t, demand_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, demand_at
   use ek_kkt, only: kkt_t, new_kkt, assemble, whole_tangent
   use ek_balance, only: balance
   use ek_path, only: path_t, new_path, walk, sweep
   use ek_rig, only: mount
   use ek_examination, only: examination_t, examine_cases
   use ek_sweep_table, only: sweep_table
   use ek_table, only: table_t
   use ek_csv, only: csv_text
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: load_deck, chosen_cases, unsolvable_words
   use ek_console, only: tell => print_text
   implicit none(type, external)
   private
   public :: bench

   integer, parameter :: rounds = 15          !! each method is timed this often; the minimum counts
   integer, parameter :: kept_numbers = 2**17 !! size of the matrices kept for the unit: 1 MB stays in the cache

contains

   !> Prints the table of ratios to standard output.
   subroutine bench(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path, exact
      real(wp), allocatable :: matrices(:, :, :)
      real(wp) :: unit, together, copying, best(3), start
      character(200) :: line
      integer :: k, m

      call load_case(arguments, suspension, case, error)
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

      together = huge(unit)
      copying = huge(unit)
      best = huge(unit)
      do k = 1, rounds
         call time_lapack(kkt%n, matrices, together, copying, error)
         if (allocated(error)) return
         do m = 1, 3
            case%method = method_names(m)
            call new_path(suspension, case, path)
            start = seconds()
            call walk(suspension, case, path, kkt)
            best(m) = min(best(m), (seconds() - start)/(path%states - 1))
         end do
      end do

      unit = together - copying
      call put('model '//suspension%name//', case '//case%name//', '//str(case%increments)// &
         ' increments, matrix '//str(kkt%n)//' x '//str(kkt%n), error)
      call put(timing('LAPACK dsysv alone', unit, unit), error)
      do m = 1, 3
         call put(timing(trim(method_names(m))//' increment', best(m), unit), error)
      end do
      case%method = 'equilibrium'
      call sweep(suspension, case, path, kkt)
      call put('equilibrium: converged states per second '//str(nint(1.0_wp/best(3))), error)
      write (line, '(a,f5.3,a,i0)') 'equilibrium: factorisations per state ', &
         real(sum(path%iterations), wp)/path%states, ', at most ', maxval(path%iterations)
      call put(trim(line), error)
      case%tolerance = 1.0e-13_wp     ! m, a thousand times tighter than the default
      call sweep(suspension, case, exact, kkt)
      write (line, '(a,es8.1,a)') 'equilibrium: largest distance to the solution at tolerance 1e-10 mm: ', &
         largest_distance(path, exact, kkt%nq/6)*1000.0_wp, ' mm'
      call put(trim(line), error)
      if (arguments%quiet .or. allocated(error)) return
      call whole_way(arguments, error)
   end subroutine bench

   !> The first chosen case of a deck on the rig, examined and balanced.
   subroutine load_case(arguments, suspension, case, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: base
      type(case_t), allocatable :: cases(:), chosen(:)
      type(examination_t) :: found
      character(:), allocatable :: checksum

      call load_deck(arguments, base, cases, checksum, error)
      if (allocated(error)) return
      call chosen_cases(arguments, cases, chosen, error)
      if (allocated(error)) return
      call examine_cases(base, chosen(1:1), found)
      if (found%none_solvable()) then
         call fail(error, exit_model, unsolvable_words(arguments%file, found))
         return
      end if
      call balance(base, chosen(1)%tolerance, error)
      if (allocated(error)) return
      if (.not. is_mountable(chosen(1))) then
         call fail(error, exit_file, chosen(1)%table%fault)
         return
      end if
      call mount(base, chosen(1), suspension, case)
   end subroutine load_case

   !> Prints one line to standard output; after a failure nothing.
   subroutine put(line, error)
      character(*), intent(in) :: line
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: unheard

      if (allocated(error)) return
      call tell(line//new_line('a'), unheard)
      if (allocated(unheard)) call move_alloc(unheard, error)
   end subroutine put

   !> Name, microseconds, ratio.
   function timing(name, time, unit) result(line)
      character(*), intent(in) :: name
      real(wp), intent(in) :: time, unit
      character(:), allocatable :: line
      character(100) :: words

      write (words, '(a,t28,f9.3,a,f7.2,a)') name, time*1.0e6_wp, ' us', time/unit, ' units'
      line = trim(words)
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
      type(demand_t) :: demand
      integer :: count, k, state_number, j

      count = min(max(kept_numbers/kkt%n**2, 4), path%states)
      allocate (matrices(kkt%n, kkt%n, count), source=0.0_wp)
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      do k = 1, count
         state_number = 1 + ((k - 1)*(path%states - 1))/max(count - 1, 1)
         call demand_at(schedule, path%value(state_number), demand)
         call unpack_state(path%packed(:, state_number), state)
         call assemble(suspension, state, demand, whole_tangent, kkt)
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
      integer :: k, body

      largest = 0.0_wp
      do k = 1, a%states
         do body = 1, bodies
            largest = max(largest, norm2(a%packed(7*body - 6:7*body - 4, k) - b%packed(7*body - 6:7*body - 4, k)))
         end do
      end do
   end function largest_distance

   !> Times all steps from deck to CSV text within this process.
   subroutine whole_way(arguments, error)
      type(arguments_t), intent(in) :: arguments
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
      call load_case(arguments, suspension, case, error)
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
      call put(trim(line), error)
   end subroutine whole_way

end module ek_bench
