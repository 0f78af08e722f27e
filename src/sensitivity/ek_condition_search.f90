!> Conditions of `solve` at a design: values, deviations and derivatives, and the searches for numbers that satisfy the conditions.
!>
!> A deviation is divided by the weight of its condition, and the unknowns are measured in widths of their bounds. A deviation or
!> a derivative that is only rounding noise is zero (ek_noise), so that an unknown without effect does not move.
module ek_condition_search
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_model
   use ek_noise, only: is_noise, solved
   use ek_noticeable, only: noticeable_change
   use ek_bounded_search, only: bounded_search_t, begin_search, advance_search, bounded_step, gain_is_small
   use ek_workspace, only: workspace_t
   use ek_direction, only: direction_t
   use ek_wanted_number, only: wanted_number_t
   use ek_swept_range, only: range_fault
   use ek_wanted_values, only: wanted_values_t, begin_values, find_values
   implicit none(type, external)
   private
   public :: unknown_t, search_t, open_search, set_targets, evaluate, minimise, shorten, approach
   public :: deviations, sum_of_squares, is_close, distance_of

   !> A number of the deck that may change.
   type :: unknown_t
      type(direction_t) :: direction
      real(wp) :: lower = 0.0_wp, upper = 0.0_wp     !! bounds, in the unit of the direction
   end type unknown_t

   !> The conditions and unknowns, and the design that was evaluated last.
   type :: search_t
      real(wp), allocatable :: targets(:), weights(:)      !! of the conditions, in the units of their quantities
      real(wp), allocatable :: start(:), width(:)          !! value in the deck and distance of the bounds of each unknown
      real(wp), allocatable :: lower(:), upper(:)
      real(wp), allocatable :: origin(:)                   !! start, moved between the bounds
      real(wp), allocatable :: x(:)                        !! unknowns at the design that was evaluated last
      real(wp), allocatable :: reach(:)                    !! change of each quantity that all unknowns can cause
      real(wp), allocatable :: slack(:)                    !! deviation of a quantity that cannot change which counts as satisfied
      logical :: is_valid = .false.                        !! whether all quantities have values and derivatives at x
      class(wanted_values_t), allocatable :: values        !! values and derivatives at x
   end type search_t

   real(wp), parameter :: close = 1.0e-7_wp         !! deviation that counts as satisfied, as a share of `reach`
   real(wp), parameter :: closest = 1.0e-9_wp       !! deviation at which a search ends, as a share of `reach`
   real(wp), parameter :: unnoticed = 0.5_wp        !! `slack`, as a share of the noticeable change and of the weight: a value that
                                                    !! was rounded to the noticeable change is met
   real(wp), parameter :: stiff = 1.0e5_wp          !! weight of the conditions against the length of a change

contains

   !> Prepares a search; solves the required cases at the numbers of the workspace. Creates strings.
   subroutine open_search(unknowns, wanted, targets, weights, workspace, self, error)
      type(unknown_t), intent(in) :: unknowns(:)
      type(wanted_number_t), intent(in) :: wanted(:)
      real(wp), intent(in) :: targets(:), weights(:)       !! see set_targets
      type(workspace_t), intent(inout) :: workspace
      type(search_t), intent(out) :: self
      type(error_t), allocatable, intent(out) :: error     !! a wanted number has no value at the start
      type(direction_t), allocatable :: directions(:)
      type(message_list_t) :: mistakes
      character(:), allocatable :: text
      integer :: j

      allocate (directions(size(unknowns)), self%start(size(unknowns)))
      allocate (self%reach(size(targets)), self%slack(size(targets)), source=0.0_wp)
      do j = 1, size(unknowns)
         directions(j) = unknowns(j)%direction
         self%start(j) = unknowns(j)%direction%value
      end do
      self%targets = targets
      self%weights = weights
      self%lower = unknowns%lower
      self%upper = unknowns%upper
      self%width = self%upper - self%lower
      self%origin = min(max(self%start, self%lower), self%upper)
      self%x = self%start
      call begin_values(wanted, directions, workspace, self%values, error)
      if (.not. allocated(error)) return
      do j = 1, size(wanted)
         text = range_fault(self%values%wanted(j), workspace)
         if (text /= '') call mistakes%add('--for '//wanted(j)%name//': '//text)
      end do
      if (error%code == exit_model .and. mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine open_search

   !> Replaces targets that are NaN by the values at the design that was evaluated last, and weights that are NaN by the noticeable
   !> changes of the quantities.
   subroutine set_targets(self)
      type(search_t), intent(inout) :: self
      real(wp) :: notice
      integer :: i

      do i = 1, size(self%targets)
         if (.not. ieee_is_finite(self%targets(i))) self%targets(i) = self%values%values(i)
         associate (wanted => self%values%wanted(i))
            notice = noticeable_change(wanted%unit, self%targets(i))
            if (.not. ieee_is_finite(self%weights(i))) self%weights(i) = notice
            self%slack(i) = unnoticed*min(self%weights(i), notice)
         end associate
      end do
   end subroutine set_targets

   !> Evaluates the design with given unknowns.
   subroutine evaluate(self, x, workspace)
      type(search_t), intent(inout) :: self
      real(wp), intent(in) :: x(:)
      type(workspace_t), intent(inout) :: workspace

      self%x = x
      call find_values(x - self%start, workspace, self%values, self%is_valid)
   end subroutine evaluate

   !> Deviation of each condition from its target, in the unit of the quantity. It is 0 for a deviation that is rounding noise, and
   !> for an unnoticed deviation of a quantity that no unknown can change.
   pure function deviations(self) result(deviation)
      type(search_t), intent(in) :: self
      real(wp) :: deviation(size(self%targets))
      integer :: i

      deviation = self%values%values - self%targets
      do i = 1, size(deviation)
         if (.not. ieee_is_finite(deviation(i))) cycle
         if (is_noise(deviation(i), self%values%wanted(i)%heading, self%targets(i), solved)) deviation(i) = 0.0_wp
         if (.not. self%reach(i) > 0.0_wp .and. abs(deviation(i)) <= self%slack(i)) deviation(i) = 0.0_wp
      end do
   end function deviations

   !> The sum of the squares of the deviations, each divided by its weight.
   pure real(wp) function sum_of_squares(self)
      type(search_t), intent(in) :: self
      sum_of_squares = sum((deviations(self)/self%weights)**2)
   end function sum_of_squares

   !> Whether each condition is satisfied at the design that was evaluated last.
   pure function is_close(self)
      type(search_t), intent(in) :: self
      logical :: is_close(size(self%targets))
      is_close = abs(deviations(self)) <= close*self%reach
   end function is_close

   !> The length of the change of all unknowns, in widths of their bounds.
   pure real(wp) function distance_of(self, x)
      type(search_t), intent(in) :: self
      real(wp), intent(in) :: x(:)
      distance_of = norm2((x - self%origin)/self%width)
   end function distance_of

   !> Finds the smallest sum of squares from a given point by Gauss-Newton steps within the bounds. The design with the smallest sum
   !> is evaluated last, and is never worse than the point where the search begins.
   subroutine minimise(self, begin, max_sweeps, workspace, held)
      type(search_t), intent(inout) :: self
      real(wp), intent(in) :: begin(:)
      integer, intent(in) :: max_sweeps                    !! limit of the number of sweeps of this search
      type(workspace_t), intent(inout) :: workspace
      integer, allocatable, intent(out) :: held(:)         !! −1, +1: an unknown is held at its lower or upper bound; 0: free
      type(bounded_search_t) :: search
      real(wp) :: weights(size(self%weights)), before
      integer :: last

      last = self%values%sweeps + max_sweeps
      allocate (held(size(begin)), source=0)
      weights = self%weights
      where (.not. self%reach > 0.0_wp) weights = huge(1.0_wp)      ! a constant would hide the gains of the others
      call begin_search(begin, self%lower, self%upper, self%width, search)
      do
         if (search%trials > 0 .or. .not. self%is_valid .or. any(abs(search%x - self%x) > 0.0_wp)) &
            call evaluate(self, search%x, workspace)
         if (self%is_valid) then
            if (all(abs(deviations(self)) <= closest*self%reach)) return
         end if
         call advance_search(deviations(self)/weights, self%values%jacobian/spread(weights, 2, size(begin)), self%is_valid, &
            search)
         if (search%is_finished .or. self%values%sweeps >= last) exit
      end do
      if (search%ended == gain_is_small) then      ! the last step, which gains little in all, may yet satisfy a condition
         before = sum(search%residuals**2)
         call evaluate(self, search%x, workspace)
         if (self%is_valid) self%is_valid = sum((deviations(self)/weights)**2) <= before
         if (self%is_valid) search%best = self%x
      end if
      if (any(abs(search%best - self%x) > 0.0_wp)) call evaluate(self, search%best, workspace)
      held = search%held
      where (self%x > self%lower .and. self%x < self%upper) held = 0
   end subroutine minimise

   !> Reduces the change of the unknowns at a design that satisfies all conditions, along the designs that satisfy them, until no
   !> neighbour is nearer to the origin.
   subroutine shorten(self, max_sweeps, workspace)
      type(search_t), intent(inout) :: self
      integer, intent(in) :: max_sweeps
      type(workspace_t), intent(inout) :: workspace
      real(wp), parameter :: still = 1.0e-6_wp, gain = 1.0e-9_wp
      real(wp) :: x(size(self%x)), d(size(self%x))
      integer :: last, cuts

      last = self%values%sweeps + max_sweeps
      do while (self%values%sweeps < last)
         x = self%x
         call nearest_step(self, d)
         if (maxval(abs(d)) <= still) exit
         do cuts = 0, 4
            call restore(self, inside(self, x + 0.25_wp**cuts*d*self%width), workspace)
            if (.not. self%is_valid) cycle
            if (distance_of(self, self%x) < distance_of(self, x)*(1.0_wp - gain)) exit
         end do
         if (cuts <= 4) cycle
         call evaluate(self, x, workspace)
         exit
      end do
      call polish(self, workspace)
   end subroutine shorten

   !> Takes one more step to a design that satisfies all conditions, if the deviations then are smaller.
   subroutine polish(self, workspace)
      type(search_t), intent(inout) :: self
      type(workspace_t), intent(inout) :: workspace
      real(wp) :: x(size(self%x)), d(size(self%x)), before
      integer :: held(size(self%x))

      x = self%x
      before = maxval(abs(scaled_deviations(self)))
      call bounded_step(scaled_slopes(self), scaled_deviations(self), (self%lower - x)/self%width, (self%upper - x)/self%width, &
         0.0_wp, d, held)
      call evaluate(self, inside(self, x + d*self%width), workspace)
      if (self%is_valid) self%is_valid = maxval(abs(scaled_deviations(self))) <= before
      if (.not. self%is_valid) call evaluate(self, x, workspace)
   end subroutine polish

   !> Follows the conditions from the origin in steps, each time to the nearest design. Leaves is_valid .false. if a step fails.
   subroutine approach(self, workspace)
      type(search_t), intent(inout) :: self
      type(workspace_t), intent(inout) :: workspace
      integer, parameter :: steps = 5
      real(wp) :: targets(size(self%targets)), first(size(self%targets)), d(size(self%x))
      integer :: k

      targets = self%targets
      call evaluate(self, self%origin, workspace)
      first = self%values%values
      do k = 1, steps
         if (.not. self%is_valid) exit
         self%targets = first + (targets - first)*k/steps
         call nearest_step(self, d)
         call restore(self, inside(self, self%x + d*self%width), workspace)
      end do
      self%targets = targets
   end subroutine approach

   !> Finds the step to the design nearest to the origin that satisfies the conditions to first order, in widths.
   subroutine nearest_step(self, d)
      type(search_t), intent(in) :: self
      real(wp), intent(out) :: d(:)
      real(wp) :: a(size(self%targets) + size(d), size(d)), r(size(self%targets) + size(d))
      integer :: held(size(d)), j, m

      m = size(self%targets)
      a = 0.0_wp
      r = 0.0_wp
      a(:m, :) = stiff*scaled_slopes(self)
      r(:m) = stiff*scaled_deviations(self)
      do j = 1, size(d)
         a(m + j, j) = 1.0_wp
         r(m + j) = (self%x(j) - self%origin(j))/self%width(j)
      end do
      call bounded_step(a, r, (self%lower - self%x)/self%width, (self%upper - self%x)/self%width, 0.0_wp, d, held)
   end subroutine nearest_step

   !> Moves from a given point to a design near it that satisfies the conditions. Leaves is_valid .false. if there is none.
   subroutine restore(self, begin, workspace)
      type(search_t), intent(inout) :: self
      real(wp), intent(in) :: begin(:)
      type(workspace_t), intent(inout) :: workspace
      integer, parameter :: trials = 6
      real(wp) :: d(size(begin))
      integer :: held(size(begin)), k

      call evaluate(self, begin, workspace)
      do k = 1, trials
         if (.not. self%is_valid) return
         if (all(abs(scaled_deviations(self)) <= closest)) return
         if (k == trials) exit
         call bounded_step(scaled_slopes(self), scaled_deviations(self), (self%lower - self%x)/self%width, &
            (self%upper - self%x)/self%width, 0.0_wp, d, held)
         call evaluate(self, inside(self, self%x + d*self%width), workspace)
      end do
      self%is_valid = .false.
   end subroutine restore

   !> Deviations in shares of the reach of their quantities; 0 for a quantity that no unknown can change.
   pure function scaled_deviations(self) result(scaled)
      type(search_t), intent(in) :: self
      real(wp) :: scaled(size(self%targets))

      scaled = 0.0_wp
      where (self%reach > 0.0_wp) scaled = deviations(self)/self%reach
   end function scaled_deviations

   !> Derivatives of the quantities in shares of their reach, per width of each unknown.
   pure function scaled_slopes(self) result(slopes)
      type(search_t), intent(in) :: self
      real(wp) :: slopes(size(self%targets), size(self%x))
      integer :: i

      do i = 1, size(self%targets)
         slopes(i, :) = 0.0_wp
         if (self%reach(i) > 0.0_wp) slopes(i, :) = self%values%jacobian(i, :)*self%width/self%reach(i)
      end do
   end function scaled_slopes

   !> Unknowns moved between their bounds; an unknown within rounding of its origin is moved to the origin.
   pure function inside(self, x) result(y)
      type(search_t), intent(in) :: self
      real(wp), intent(in) :: x(:)
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: y(size(x))

      y = min(max(x, self%lower), self%upper)
      where (abs(y - self%origin) <= rounding*self%width) y = self%origin
   end function inside

end module ek_condition_search
