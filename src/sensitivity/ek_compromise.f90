!> The compromise between two conditions of `solve` that exclude each other: designs of which none is better in both conditions than
!> another one.
!>
!> The first design satisfies the first condition best, the last design the second. Between these two, the value of the first
!> quantity goes in equal steps, and for each value the second condition is satisfied best.
module ek_compromise
   use ek_kinds, only: wp
   use ek_workspace, only: workspace_t
   use ek_condition_search, only: search_t, evaluate, minimise
   implicit none(type, external)
   private
   public :: compromise_t, find_compromise

   integer, parameter :: points = 10                 !! number of designs

   type :: compromise_t
      real(wp), allocatable :: x(:, :)               !! (unknown, design), in the units of the unknowns
      real(wp), allocatable :: values(:, :)          !! (condition, design): values of the quantities
      real(wp), allocatable :: deviations(:, :)      !! (condition, design): deviation from the target, divided by the weight
   end type compromise_t

contains

   !> Finds the compromise of a search with two conditions. There are no designs if one design satisfies both conditions as well as
   !> each of them can be satisfied. The search then is at the design where it was before.
   subroutine find_compromise(search, max_sweeps, workspace, compromise)
      type(search_t), intent(inout) :: search
      integer, intent(in) :: max_sweeps                    !! limit of the sweeps of each design
      type(workspace_t), intent(inout) :: workspace
      type(compromise_t), intent(out) :: compromise
      real(wp), parameter :: strong = 1.0e3_wp             !! the first condition counts as much more than the second
      real(wp), parameter :: apart = 1.0e-6_wp             !! least difference of both ends, as a share of the larger deviation
      real(wp) :: targets(2), weights(2), y(2, points), x(size(search%x), points), here(size(search%x)), span(2)
      integer, allocatable :: held(:)
      integer :: k

      allocate (compromise%x(size(search%x), 0), compromise%values(2, 0), compromise%deviations(2, 0))
      if (size(search%targets) /= 2 .or. .not. all(search%reach > 0.0_wp)) return
      targets = search%targets
      weights = search%weights
      here = search%x
      search%weights = [weights(1)/strong, weights(2)]
      call minimise(search, here, max_sweeps, workspace, held)
      call note(1)
      search%weights = [weights(1), weights(2)/strong]
      call minimise(search, here, max_sweeps, workspace, held)
      call note(points)
      span = abs(y(:, points) - y(:, 1))
      if (all(span > apart*max(abs(y(:, 1) - targets), abs(y(:, points) - targets)))) then
         ! changes of both quantities over the compromise count the same, times the strength of the first
         search%weights = [span(1)/strong, span(2)]
         do k = 2, points - 1
            search%targets(1) = y(1, 1) + (y(1, points) - y(1, 1))*(k - 1)/(points - 1)
            call minimise(search, x(:, k - 1), max_sweeps, workspace, held)
            call note(k)
         end do
         compromise%x = x
         compromise%values = y
         compromise%deviations = (y - spread(targets, 2, points))/spread(weights, 2, points)
      end if
      search%targets = targets
      search%weights = weights
      call evaluate(search, here, workspace)

   contains

      !> Records the design that was evaluated last.
      subroutine note(place)
         integer, intent(in) :: place
         x(:, place) = search%x
         y(:, place) = search%values%values
      end subroutine note

   end subroutine find_compromise

end module ek_compromise
