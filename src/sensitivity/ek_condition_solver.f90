!> Finds numbers of a deck for which results have given values, by Newton's method within bounds.
!>
!> The conditions are scaled by the change that the unknowns can cause within their bounds. The unknowns are scaled by the width of
!> the bounds. With fewer conditions than unknowns, the change of the unknowns, in widths, is as small as possible. Conditions that
!> cannot all be satisfied are satisfied in the sense of least squares, and the findings give the reason.
module ek_condition_solver
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_convergence
   use ek_singular_values, only: singular_values_t, decompose
   use ek_bounded_search, only: bounded_search_t, begin_search, advance_search
   use ek_workspace, only: workspace_t
   use ek_direction, only: direction_t
   use ek_wanted_number, only: wanted_number_t
   use ek_wanted_values, only: wanted_values_t, begin_values, find_values
   implicit none(type, external)
   private
   public :: unknown_t, findings_t, solve_conditions

   !> A number of the deck that may change.
   type :: unknown_t
      type(direction_t) :: direction
      real(wp) :: lower = 0.0_wp, upper = 0.0_wp     !! bounds, in the unit of the direction
   end type unknown_t

   !> The result of the search: unknowns, values before and after, effects and conflicts.
   type :: findings_t
      real(wp), allocatable :: x(:)                  !! values of the unknowns, in the units of their directions
      integer, allocatable :: held(:)                !! −1, +1: an unknown is at its lower or upper bound; 0: between the bounds
      real(wp), allocatable :: before(:), after(:)   !! values of the wanted numbers at the start and at the end
      logical, allocatable :: is_reached(:)          !! whether each condition is satisfied
      real(wp), allocatable :: effect(:, :)          !! (condition, unknown): change if the unknown moves by the width of its
                                                     !! bounds, by the derivative
      integer :: rank = 0                            !! rank of the effects
      real(wp), allocatable :: conflict(:, :)        !! (condition, k): unit vectors of conditions that the unknowns cannot change
      integer :: sweeps = 0                          !! number of designs that were solved
   end type findings_t

   real(wp), parameter :: close = 1.0e-7_wp         !! deviation that counts as satisfied, as a share of the possible change
   real(wp), parameter :: closest = 1.0e-9_wp       !! deviation at which the search ends, as a share of the possible change
   real(wp), parameter :: no_effect = 1.0e-9_wp     !! effect that is an error of the derivatives, as a share of the largest effect

contains

   !> Finds unknowns that satisfy the conditions: wanted numbers equal to targets. The workspace then contains the numbers found.
   !> Creates strings.
   subroutine solve_conditions(unknowns, wanted, targets, max_sweeps, workspace, found, error)
      type(unknown_t), intent(in) :: unknowns(:)
      type(wanted_number_t), intent(in) :: wanted(:)
      real(wp), intent(in) :: targets(:)                    !! targets of the wanted numbers, in their units
      integer, intent(in) :: max_sweeps
      type(workspace_t), intent(inout) :: workspace
      type(findings_t), intent(out) :: found
      type(error_t), allocatable, intent(out) :: error      !! a wanted number has no value or no derivative at the start
      type(bounded_search_t) :: search
      class(wanted_values_t), allocatable :: values
      type(direction_t), allocatable :: directions(:)
      real(wp), allocatable :: start(:), width(:), scale(:), missing(:)
      logical :: is_valid
      integer :: j

      allocate (directions(size(unknowns)), start(size(unknowns)), width(size(unknowns)))
      do j = 1, size(unknowns)
         directions(j) = unknowns(j)%direction
         start(j) = unknowns(j)%direction%value
         width(j) = unknowns(j)%upper - unknowns(j)%lower
      end do
      call begin_values(wanted, directions, workspace, values, error)
      if (allocated(error)) return
      call begin_search(start, unknowns%lower, unknowns%upper, width, search)
      if (any(abs(search%x - start) > 0.0_wp)) then          ! the search begins at a bound: the design before it
         call find_values(0.0_wp*start, workspace, values, is_valid)
         found%before = values%values
      end if
      do
         call find_values(search%x - start, workspace, values, is_valid)
         if (is_valid .and. .not. allocated(scale)) then
            if (.not. allocated(found%before)) found%before = values%values
            scale = max(matmul(abs(values%jacobian), width), no_effect*max(abs(targets), abs(values%values)), tiny(1.0_wp))
         end if
         if (.not. allocated(scale)) exit
         missing = (values%values - targets)/scale
         if (is_valid) then
            if (all(abs(missing) <= closest)) exit
         end if
         call advance_search(missing, values%jacobian/spread(scale, 2, size(width)), is_valid, search)
         if (search%is_finished .or. values%sweeps >= max_sweeps) exit
      end do
      if (.not. allocated(scale)) then
         call fail(error, exit_convergence, 'the wanted numbers have no value or no derivative where the search begins')
         return
      end if
      call conclude()

   contains

      !> Records the findings at the last point if the last point satisfies all conditions, otherwise at the best point.
      subroutine conclude()
         type(singular_values_t) :: parts
         real(wp), allocatable :: effect(:, :)

         found%x = search%x
         if (is_valid) is_valid = all(abs(missing) <= closest)
         if (.not. is_valid) then
            found%x = search%best
            call find_values(search%best - start, workspace, values, is_valid)
            missing = (values%values - targets)/scale
         end if
         found%sweeps = values%sweeps
         found%after = values%values
         found%is_reached = abs(missing) <= close
         found%held = search%held
         where (found%x > unknowns%lower .and. found%x < unknowns%upper) found%held = 0
         found%effect = values%jacobian*spread(width, 1, size(targets))
         effect = found%effect/spread(scale, 2, size(width))
         call decompose(effect, no_effect, parts, whole=1.0_wp)
         found%rank = parts%rank
         found%conflict = parts%left(:, parts%rank + 1:)
      end subroutine conclude

   end subroutine solve_conditions

end module ek_condition_solver
