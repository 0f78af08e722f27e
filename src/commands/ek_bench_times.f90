!> The single measurements of `bench`, in processor time.
module ek_bench_times
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence
   use ek_clock, only: processor_seconds
   use ek_lapack, only: dsysv
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, whole_matrix, whole_tangent
   use ek_lanes, only: lanes
   use ek_pack, only: new_pack
   use ek_pack_walk, only: member_t, walker_t, walk_pack
   use ek_path, only: path_t, new_path, sweep
   use ek_compliance, only: compliance_t, new_compliance, ask, wheel_compliance
   use ek_kandc_list, only: kandc_t, start_kandc
   use ek_kandc_columns, only: observe_kandc
   use ek_sweep_table, only: observe
   use ek_load_deck, only: deck_settings_t, read_changed
   use ek_deck, only: deck_t
   use ek_parameter, only: choice_t
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_cases
   use ek_factor_numbers, only: factor_paths_t, change_design
   use ek_case_result, only: solve_options_t, solve_mounted
   use ek_wheel_side, only: prefix_of
   use ek_bench_figures, only: figures_t, short_sweep
   implicit none(type, external)
   private
   public :: rounds, collect_matrices, time_lapack, time_packs, time_kandc, time_designs

   integer, parameter :: rounds = 30          !! rounds of a measurement; the minimum counts
   integer, parameter :: kept_numbers = 2**17 !! numbers in the matrices stored for the unit: 1 MB fits in the cache
   integer, parameter :: designs = 10         !! number of designs timed together
   integer, parameter :: rows = 20            !! number of rows of K&C quantities timed together

contains

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
      type(factor_paths_t) :: paths(1)
      type(solve_options_t) :: options
      real(wp) :: start, value, time
      logical :: is_done
      integer :: k, d

      allocate (workspace)
      call read_changed(settings%file, settings%changes, deck, error)
      if (.not. allocated(error)) call open_cases(deck, [case_name], workspace, error)
      if (allocated(error)) return
      associate (list => workspace%design%parameters%list, x => workspace%design%parameters%x)
         do k = 1, workspace%design%parameters%used
            if (list(k)%is_given .and. abs(x(k)) > 0.0_wp) exit
         end do
         paths(1)%found = [choice_t(k, 1.0_wp)]
         value = x(k)/list(k)%unit
      end associate
      workspace%design%cases%increments = short_sweep
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

end module ek_bench_times
