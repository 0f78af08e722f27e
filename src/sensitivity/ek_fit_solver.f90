!> Finds the factors of a fit at which its targets are met best: weighted least squares within bounds, with priors. Minimised is the
!> sum
!>
!>     Σ ((y − target)/deviation)² + Σ (beyond a limit/deviation)² + Σ ((factor − nominal)/deviation of the prior)²
module ek_fit_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_bounded_search, only: bounded_search_t, begin_search, advance_search
   use ek_workspace, only: workspace_t
   use ek_direction, only: direction_t
   use ek_study, only: is_given
   use ek_noise, only: noise_of, solved
   use ek_wanted_values, only: wanted_values_t, begin_values, find_values
   use ek_fit_problem, only: fit_problem_t, fit_point_t
   implicit none(type, external)
   private
   public :: fit_result_t, begin_fit, search_fit, difference_of, is_at_work, noise_of_sum

   type :: fit_result_t
      real(wp), allocatable :: x(:)                  !! values of the factors, in their units
      integer, allocatable :: held(:)                !! −1, +1: a factor is at its lower or upper bound; 0: between the bounds
      logical, allocatable :: is_kept(:)             !! whether each factor keeps its value, because the targets do not determine it
      real(wp), allocatable :: before(:), after(:)   !! values of the points, at the start and at the end
      real(wp), allocatable :: jacobian(:, :)        !! (point, factor): derivatives of the points, in their units
      real(wp) :: sum_before = 0.0_wp, sum_after = 0.0_wp     !! sum that is minimised, at the start and at the end
      integer :: steps = 0, sweeps = 0               !! number of iterations; number of designs that were solved
      integer :: ended = 0                           !! reason for the end, of ek_bounded_search; 0: limit of iterations
   end type fit_result_t

contains

   !> Prepares the values of a fit; solves the required cases at the start. Creates strings.
   subroutine begin_fit(problem, workspace, values, error)
      type(fit_problem_t), intent(in) :: problem
      type(workspace_t), intent(inout) :: workspace
      class(wanted_values_t), allocatable, intent(out) :: values
      type(error_t), allocatable, intent(out) :: error
      type(direction_t), allocatable :: directions(:)
      integer :: f

      allocate (directions(size(problem%variables)))
      do f = 1, size(directions)
         directions(f) = problem%variables(f)%direction
      end do
      call begin_values(problem%wanted, directions, workspace, values, error)
   end subroutine begin_fit

   !> Searches the smallest sum of squares from given factors. The workspace then contains the design found. A fixed factor keeps
   !> its value. found%after is not allocated if a target has no value or no derivative where the search begins.
   subroutine search_fit(problem, begin, is_fixed, iterations, values, workspace, found)
      type(fit_problem_t), intent(in) :: problem
      real(wp), intent(in) :: begin(:)                     !! factors where the search begins, in their units
      logical, intent(in) :: is_fixed(:)
      integer, intent(in) :: iterations                    !! limit of the number of iterations
      class(wanted_values_t), intent(inout) :: values
      type(workspace_t), intent(inout) :: workspace
      type(fit_result_t), intent(out) :: found
      type(bounded_search_t) :: search
      real(wp), allocatable :: r(:), jacobian(:, :), tried(:), x(:)
      logical :: is_valid

      associate (variables => problem%variables)
         allocate (r(size(problem%points) + size(variables)))
         allocate (jacobian(size(r), size(variables)))
         x = min(max(begin, variables%lower), variables%upper)
         call begin_search(x, merge(x, variables%lower, is_fixed), merge(x, variables%upper, is_fixed), variables%scale, search)
         do
            tried = search%x
            call find_values(tried - variables%start, workspace, values, is_valid)
            call find_residuals(problem, tried, values, r, jacobian)
            call advance_search(r, jacobian, is_valid, search)
            if (.not. allocated(search%residuals)) exit
            if (.not. allocated(found%before)) then
               found%before = values%values
               found%sum_before = sum(r**2)
            end if
            if (is_valid .and. all(abs(search%best - tried) <= 0.0_wp)) then
               found%after = values%values
               found%jacobian = values%jacobian
            end if
            if (search%is_finished .or. search%steps >= iterations) exit
         end do
         found%sweeps = values%sweeps
         if (.not. allocated(search%residuals)) return
         if (any(abs(search%best - tried) > 0.0_wp)) call find_values(search%best - variables%start, workspace, values, is_valid)
         found%x = search%best
         found%held = search%held
         where (is_fixed .or. (found%x > variables%lower .and. found%x < variables%upper)) found%held = 0
         found%is_kept = is_fixed
      end associate
      found%sum_after = sum(search%residuals**2)
      found%steps = search%steps
      found%sweeps = values%sweeps
      found%ended = search%ended
   end subroutine search_fit

   !> Computes all differences and their derivatives. The differences of priors are after the differences of the points; the
   !> difference of a factor without a prior is zero.
   !> Equation (E.5) of docs/theory/derivatives.md.
   subroutine find_residuals(problem, x, values, r, jacobian)
      type(fit_problem_t), intent(in) :: problem
      real(wp), intent(in) :: x(:)
      type(wanted_values_t), intent(in) :: values
      real(wp), intent(out) :: r(:), jacobian(:, :)
      integer :: f, k

      r = 0.0_wp
      jacobian = 0.0_wp
      do k = 1, size(problem%points)
         if (.not. ieee_is_finite(values%values(k))) return
         if (.not. is_at_work(problem%points(k), values%values(k))) cycle
         r(k) = difference_of(problem%points(k), values%values(k))
         jacobian(k, :) = values%jacobian(k, :)/problem%points(k)%deviation
      end do
      do f = 1, size(x)
         associate (this => problem%variables(f))
            if (.not. is_given(this%deviation)) cycle
            r(k - 1 + f) = (x(f) - this%nominal)/this%deviation
            jacobian(k - 1 + f, f) = 1.0_wp/this%deviation
         end associate
      end do
   end subroutine find_residuals

   !> The signed difference of a value from its target, in deviations; 0 between limits.
   !> Equation (E.5) of docs/theory/derivatives.md.
   pure real(wp) function difference_of(point, value) result(difference)
      type(fit_point_t), intent(in) :: point
      real(wp), intent(in) :: value

      difference = 0.0_wp
      if (is_given(point%value)) difference = value - point%value
      if (is_given(point%high)) difference = difference + max(0.0_wp, value - point%high)
      if (is_given(point%low)) difference = difference - max(0.0_wp, point%low - value)
      difference = difference/point%deviation
   end function difference_of

   !> The largest difference of two sums of squares that is only rounding noise of the values (ek_noise).
   pure real(wp) function noise_of_sum(problem, values) result(noise)
      type(fit_problem_t), intent(in) :: problem
      real(wp), intent(in) :: values(:)                    !! value of each point, in its unit
      real(wp) :: of_value
      integer :: k

      noise = 0.0_wp
      do k = 1, size(problem%points)
         of_value = noise_of(problem%wanted(k)%heading, values(k), solved)/problem%points(k)%deviation
         noise = noise + (2.0_wp*abs(difference_of(problem%points(k), values(k))) + of_value)*of_value
      end do
   end function noise_of_sum

   !> Whether a point contributes to the fit: its target is a value, or its limit is exceeded.
   pure logical function is_at_work(point, value)
      type(fit_point_t), intent(in) :: point
      real(wp), intent(in) :: value

      is_at_work = is_given(point%value)
      if (is_given(point%high)) is_at_work = is_at_work .or. value > point%high
      if (is_given(point%low)) is_at_work = is_at_work .or. value < point%low
   end function is_at_work

end module ek_fit_solver
