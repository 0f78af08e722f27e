!> elastokin-bench: time per increment, relative to LAPACK's factorisation and solution alone.
!>
!> The unit is the time of dsysv for the matrices of the sweep (scaled KKT matrices of its equilibrium states) with one right-hand
!> side. dsysv and the methods are timed in turn in the same run, so that the ratios do not depend on the speed of the machine. All
!> times are processor times, and the minimum of many rounds counts for each measurement, so that the load of the machine does not
!> change the ratios.
module ek_bench
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence, exit_file
   use ek_text, only: quoted
   use ek_rig_test, only: is_scattered
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable, method_names
   use ek_kkt, only: kkt_t, new_kkt, assemble, whole_matrix, whole_tangent
   use ek_workspace, only: workspace_t, balance_or_explain
   use ek_reader, only: definition_t
   use ek_path, only: path_t, sweep, new_path
   use ek_rig, only: mount
   use ek_examination, only: examination_t
   use ek_sweep_table, only: sweep_table, observe
   use ek_table, only: table_t, csv_text
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_deck, chosen_cases, examine_chosen, read_changed
   use ek_increment_parts, only: parts_t, time_walk, time_parts, processor_seconds
   use ek_bench_figures, only: figures_t, table_of, json_of, short_sweep
   use ek_bench_loads, only: time_loads
   use ek_growth, only: bench_growth
   use ek_bench_derivatives, only: bench_derivatives
   use ek_console, only: print_text
   use ek_lapack, only: dsysv
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_lanes, only: lanes
   use ek_pack, only: new_pack
   use ek_pack_walk, only: member_t, walker_t, walk_pack
   use ek_compliance, only: compliance_t, new_compliance, ask, wheel_compliance
   use ek_kandc_list, only: kandc_t, start_kandc
   use ek_kandc_columns, only: observe_kandc
   use ek_deck, only: deck_t
   use ek_parameter, only: choice_t
   use ek_workspace_cases, only: open_cases
   use ek_factor_numbers, only: factor_paths_t, change_design
   use ek_case_result, only: solve_options_t, solve_mounted
   use ek_wheel_side, only: prefix_of
   implicit none(type, external)
   private
   public :: bench

   integer, parameter :: rounds = 30          !! rounds of a measurement; the minimum counts
   integer, parameter :: kept_numbers = 2**17 !! numbers in the matrices stored for the unit: 1 MB fits in the cache
   integer, parameter :: designs = 10         !! number of designs timed together
   integer, parameter :: rows = 20            !! number of rows of K&C quantities timed together

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
      call time_loads(suspension, case, planned, figures%loads)
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
      type(definition_t), target :: definition
      type(case_t), allocatable :: chosen(:)
      type(examination_t) :: found
      character(:), allocatable :: checksum

      call load_deck(settings, definition, workspace, checksum, error)
      if (.not. allocated(error)) call chosen_cases(settings, workspace%raw, workspace%deck_cases, chosen, error)
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

   !> Collects the scaled matrices of some states of a sweep.
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
         matrices(:, :, k) = whole_matrix(kkt)
         do j = 1, kkt%n
            matrices(:, j, k) = matrices(:, j, k)*(kkt%scale(j)*kkt%scale)
         end do
      end do
   end subroutine collect_matrices

   !> Times dsysv on all matrices including a copy of each matrix, and times the copies alone, both per matrix. The shortest time so
   !> far counts for each, so that a disturbed round affects neither.
   subroutine time_lapack(n, matrices, together, copying, error)
      integer, intent(in) :: n
      real(wp), intent(in) :: matrices(:, :, :)
      real(wp), intent(inout) :: together, copying     !! time of dsysv with copy; time of the copy [s]
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: a matrix is singular
      real(wp) :: copy(n, n), rhs(n), work(64*n), start
      integer :: pivots(n), k, info
      logical :: is_singular

      start = processor_seconds()
      do k = 1, size(matrices, 3)
         copy = matrices(:, :, k)
         rhs = real(k, wp)
         call keep(copy, rhs)
      end do
      copying = min(copying, (processor_seconds() - start)/size(matrices, 3))
      is_singular = .false.
      start = processor_seconds()
      do k = 1, size(matrices, 3)
         copy = matrices(:, :, k)
         rhs = real(k, wp)
         call dsysv('L', n, 1, copy, n, pivots, rhs, n, work, size(work), info)
         if (info /= 0) is_singular = .true.
      end do
      together = min(together, (processor_seconds() - start)/size(matrices, 3))
      if (is_singular) call fail(error, exit_convergence, 'the matrix of a state is singular and cannot be timed')
   end subroutine time_lapack

   !> Does nothing, but prevents the optimiser from removing the copy as dead code.
   subroutine keep(copy, rhs)
      real(wp), intent(inout) :: copy(:, :), rhs(:)
      if (rhs(1) < 0.0_wp) copy(1, 1) = rhs(1)
   end subroutine keep

   !> Times a pack of four designs. All four are equal, so that every lane performs every step.
   subroutine time_packs(suspension, case, kkt, figures)
      type(suspension_t), intent(in), target :: suspension
      type(case_t), intent(in), target :: case
      type(kkt_t), intent(in) :: kkt             !! system with a plan
      type(figures_t), intent(inout) :: figures
      type(kkt_t), target :: own(lanes)
      type(path_t), target :: path(lanes)
      type(walker_t) :: walker
      type(member_t) :: members(lanes)
      real(wp) :: start, time
      integer :: k, l

      call new_path(suspension, case, path(1))
      call new_pack(suspension, kkt, path(1), walker%pack)
      time = huge(time)
      do l = 1, lanes
         own(l) = kkt
         members(l)%suspension => suspension
         members(l)%case => case
         members(l)%kkt => own(l)
         members(l)%path => path(l)
      end do
      do k = 1, rounds
         do l = 1, lanes
            call new_path(suspension, case, path(l))
         end do
         walker%steps = 0
         walker%steps_alone = 0
         start = processor_seconds()
         call walk_pack(walker, members)
         time = min(time, processor_seconds() - start)
      end do
      if (.not. all(members%is_walked)) return
      figures%pack_states = lanes*path(1)%states/time
      figures%alone = real(walker%steps_alone, wp)/max(walker%steps, 1)
   end subroutine time_packs

   !> Times the K&C quantities at design by plan: the compliance matrix alone, and the matrix with all quantities that are read from
   !> the matrix.
   subroutine time_kandc(suspension, case, path, kkt, figures)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path           !! path whose states are all reached
      type(kkt_t), intent(inout) :: kkt          !! system with a plan
      type(figures_t), intent(inout) :: figures
      type(compliance_t) :: compliance
      type(kandc_t) :: kandc
      type(state_t) :: state
      type(inputs_t) :: inputs
      logical, allocatable :: is_asked(:)
      real(wp) :: start
      integer :: k, round, number

      if (size(suspension%wheels) == 0) return
      compliance = new_compliance(suspension, .false.)
      allocate (is_asked(size(compliance%response, 2)), source=.false.)
      is_asked(:6*size(suspension%wheels)) = .true.
      call ask(compliance, is_asked, .false.)
      call start_kandc(suspension, kandc)
      number = max(path%start, 1)
      state = design_state(suspension)
      call unpack_state(path%packed(:, number), state)
      call inputs_at(new_schedule(suspension, case), path%value(number), inputs)
      figures%kandc_row = huge(start)
      figures%kandc_all = huge(start)
      do round = 1, rounds
         start = processor_seconds()
         do k = 1, rows
            call wheel_compliance(suspension, state, inputs, 0, kkt, compliance)
         end do
         figures%kandc_row = min(figures%kandc_row, (processor_seconds() - start)/rows)
         start = processor_seconds()
         do k = 1, rows
            call observe_kandc(suspension, state, inputs, kkt, kandc)
         end do
         figures%kandc_all = min(figures%kandc_all, (processor_seconds() - start)/rows)
      end do
   end subroutine time_kandc

   !> Times complete designs as in a study: numbers to suspension, examination, preload trim (`balance`), states and one column.
   !> Also times the states and the column without the other steps. In each design, the first nonzero number that the deck gives is
   !> changed in its tenth digit. If a changed model cannot be built from numbers, nothing is measured.
   subroutine time_designs(settings, case_name, figures, error)
      type(deck_settings_t), intent(in) :: settings
      character(*), intent(in) :: case_name
      type(figures_t), intent(inout) :: figures
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(factor_paths_t) :: paths(1)
      type(solve_options_t) :: options
      real(wp) :: start, value, time
      logical :: is_done
      integer :: k, d

      allocate (workspace)
      call read_changed(settings%file, settings%changes, deck, error)
      if (.not. allocated(error)) call open_cases(deck, [case_name], definition, workspace, error)
      if (allocated(error)) return
      associate (list => workspace%definition%parameters%list, x => workspace%definition%parameters%x)
         do k = 1, workspace%definition%parameters%used
            if (list(k)%is_given .and. abs(x(k)) > 0.0_wp) exit
         end do
         paths(1)%found = [choice_t(k, 1.0_wp)]
         value = x(k)/list(k)%unit
      end associate
      workspace%deck_cases%increments = short_sweep
      allocate (options%columns(1))
      options%columns = 'toe_deg'
      if (size(workspace%suspension%wheels) > 1) options%columns = prefix_of(workspace%suspension, 1)//'toe_deg'
      figures%design = huge(time)
      figures%states = huge(time)
      do k = 1, rounds/2
         start = processor_seconds()
         do d = 1, designs
            call change_design(paths, [value*(1.0_wp + 1.0e-10_wp*d)], workspace, is_done)
            if (.not. is_done) then      ! such a model has no design from numbers
               figures%design = 0.0_wp
               return
            end if
            call solve_mounted(options, workspace%cases(1)%result, observer=workspace%cases(1)%observer)
         end do
         figures%design = min(figures%design, (processor_seconds() - start)/designs)
         start = processor_seconds()
         do d = 1, designs
            associate (this => workspace%cases(1)%result)
               call sweep(this%suspension, this%case, this%path, this%kkt, space=this%space)
               call observe(this%suspension, this%case, this%path, this%kkt, workspace%cases(1)%observer, this%table)
            end associate
         end do
         figures%states = min(figures%states, (processor_seconds() - start)/designs)
      end do
   end subroutine time_designs

end module ek_bench
