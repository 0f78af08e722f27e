!> The factors of a fit: those that the targets determine are fitted, the others keep their values.
!>
!> First, all factors are fitted. A factor that the targets do not determine then has any value, often that of a bound. Such a
!> factor returns to its start, and the others are fitted again. This is the result if the sum of squares is not significantly
!> larger (95 %). So the next factor is tried, from the factor with the widest interval on.
module ek_fit_factors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck, exit_model, exit_convergence
   use ek_text, only: quoted
   use ek_study, only: is_given
   use ek_workspace, only: workspace_t
   use ek_wanted_values, only: wanted_values_t, find_values
   use ek_swept_range, only: range_fault
   use ek_fit, only: fit_t
   use ek_fit_problem, only: fit_problem_t
   use ek_fit_solver, only: fit_result_t, begin_fit, search_fit, noise_of_sum
   use ek_fit_statistics, only: fit_statistics_t, find_statistics
   implicit none(type, external)
   private
   public :: fit_factors

   real(wp), parameter :: small = 0.05_wp            !! limit of the same difference, as a share of the smallest sum, if no target
                                                     !! gives its deviation: the scatter of few numbers is hardly known

contains

   !> Fits the factors and computes their statistics. The workspace then contains the design found. Creates strings.
   subroutine fit_factors(fit, problem, workspace, found, statistics, error)
      type(fit_t), intent(in) :: fit
      type(fit_problem_t), intent(in) :: problem           !! problem of the fit
      type(workspace_t), intent(inout) :: workspace
      type(fit_result_t), intent(out) :: found
      type(fit_statistics_t), intent(out) :: statistics
      type(error_t), allocatable, intent(out) :: error
      class(wanted_values_t), allocatable :: values
      type(fit_result_t) :: trial
      type(fit_statistics_t) :: of_trial
      real(wp), allocatable :: begin(:), start(:)
      logical, allocatable :: is_fixed(:), is_tried(:)
      logical :: is_valid, is_last
      real(wp) :: limit
      integer :: f

      call begin_fit(problem, workspace, values, error)
      call check_ranges(fit, problem, values, workspace, error)
      if (allocated(error)) return
      start = min(max(problem%variables%start, problem%variables%lower), problem%variables%upper)
      allocate (is_fixed(size(start)), is_tried(size(start)), source=.false.)
      call search_fit(problem, start, is_fixed, fit%iterations, values, workspace, found)
      if (.not. allocated(found%after)) then
         call fail(error, exit_convergence, 'the targets have no value or no derivative where the search begins')
         return
      end if
      call find_statistics(problem, found, statistics)
      if (found%ended == 0) return                         ! all iterations were used
      limit = (statistics%quantile*statistics%sigma)**2
      if (.not. problem%knows_deviation) limit = min(limit, small*found%sum_after)
      limit = found%sum_after + limit + noise_of_sum(problem, found%after)
      is_last = .true.
      do
         f = next_factor(problem, found, statistics, start, is_fixed .or. is_tried)
         if (f == 0) exit
         is_tried(f) = .true.
         is_fixed(f) = .true.
         begin = found%x
         begin(f) = start(f)
         call search_fit(problem, begin, is_fixed, fit%iterations, values, workspace, trial)
         is_last = .false.
         is_fixed(f) = .false.
         if (.not. allocated(trial%after)) cycle
         if (trial%ended == 0 .or. trial%sum_after > limit) cycle
         call find_statistics(problem, trial, of_trial)
         if (of_trial%is_learned(f)) cycle
         is_fixed(f) = .true.
         is_last = .true.
         trial%before = found%before
         trial%sum_before = found%sum_before
         trial%steps = found%steps + trial%steps
         found = trial
         statistics = of_trial
      end do
      if (.not. is_last) call find_values(found%x - problem%variables%start, workspace, values, is_valid)
      found%sweeps = values%sweeps
   end subroutine fit_factors

   !> Replaces the error of a target without a value by messages on swept values outside the ranges of the cases, one per target.
   subroutine check_ranges(fit, problem, values, workspace, error)
      type(fit_t), intent(in) :: fit
      type(fit_problem_t), intent(in) :: problem
      class(wanted_values_t), intent(in) :: values
      type(workspace_t), intent(in) :: workspace
      type(error_t), allocatable, intent(inout) :: error
      type(message_list_t) :: mistakes
      character(:), allocatable :: text
      integer :: k, last

      if (.not. allocated(error)) return
      if (error%code /= exit_model) return
      last = 0                                             ! target of the last message
      do k = 1, size(problem%points)
         if (problem%points(k)%target == last) cycle
         text = range_fault(values%wanted(k), workspace)
         if (text == '') cycle
         last = problem%points(k)%target
         call mistakes%add(fit%targets(last)%where//': target '//quoted(fit%targets(last)%name)//': '//text)
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine check_ranges

   !> The factor whose value is to be tried next at the start: of the factors that have moved, that are at a bound or are not
   !> determined, and that have no prior, the one with the widest interval in shares of its range. 0 if there is none.
   pure integer function next_factor(problem, found, statistics, start, is_done) result(next)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      real(wp), intent(in) :: start(:)
      logical, intent(in) :: is_done(:)
      real(wp) :: widest, share
      integer :: f

      next = 0
      widest = -1.0_wp
      do f = 1, size(start)
         if (is_done(f) .or. is_given(problem%variables(f)%deviation)) cycle
         if (statistics%is_learned(f) .and. found%held(f) == 0) cycle
         if (abs(found%x(f) - start(f)) <= 0.0_wp) cycle
         share = huge(share)
         if (ieee_is_finite(statistics%half_alone(f))) share = statistics%half_alone(f)/statistics%width(f)
         if (share > widest) next = f
         widest = max(widest, share)
      end do
   end function next_factor

end module ek_fit_factors
