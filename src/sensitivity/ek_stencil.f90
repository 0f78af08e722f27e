!> Derivatives of functions of one number from the values at two or four points, with an estimate of the error.
module ek_stencil
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: stencil_t, stencils, close_pair, close_four, weight_of, corner_weight, differentiate, find_quotients

   !> Points of two difference quotients D₁ and D₂, and the weights of the values at these points. D₁ has the step h and D₂ the step
   !> 2h; points and weights are in steps h. The derivative (4 D₁ − D₂)/3 is of higher order than both quotients.
   type :: stencil_t
      real(wp) :: at(4), first(4), second(4)
      integer :: points = 4
   end type stencil_t

   type(stencil_t), parameter :: central = stencil_t([-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp], [0.0_wp, -0.5_wp, 0.5_wp, 0.0_wp], &
      [-0.25_wp, 0.0_wp, 0.0_wp, 0.25_wp])
   ! at the end of a legal range: one side, errors of order h² too
   type(stencil_t), parameter :: forward = stencil_t([0.0_wp, 1.0_wp, 2.0_wp, 4.0_wp], [-1.5_wp, 2.0_wp, -0.5_wp, 0.0_wp], &
      [-0.75_wp, 0.0_wp, 1.0_wp, -0.25_wp])
   type(stencil_t), parameter :: backward = stencil_t(-forward%at, -forward%first, -forward%second)
   ! two points alone, for numbers of parts: these are not differences of large forces, so they bear a small step; the error is of
   ! order h², and is in no error estimate
   type(stencil_t), parameter :: close_pair = stencil_t([-0.02_wp, 0.02_wp, 0.0_wp, 0.0_wp], [-25.0_wp, 25.0_wp, 0.0_wp, 0.0_wp], &
      [-25.0_wp, 25.0_wp, 0.0_wp, 0.0_wp], 2)
   type(stencil_t), parameter :: close_four = stencil_t(0.1_wp*central%at, 10.0_wp*central%first, 10.0_wp*central%second)
   real(wp), parameter :: corner_weights(0:4) = [-1.5_wp, -0.25_wp, 1.0_wp, 1.0_wp, -0.25_wp] !! weights of the value in the middle
                                                                                              !! (0) and of the values at the points
   type(stencil_t), parameter :: stencils(3) = [central, forward, backward]      !! stencils in the order of preference

contains

   !> The weight of the value at a point in the derivative, per step h.
   !> Equation (E.2) of docs/theory/derivatives.md.
   pure real(wp) function weight_of(stencil, k)
      type(stencil_t), intent(in) :: stencil
      integer, intent(in) :: k
      weight_of = (4.0_wp*stencil%first(k) - stencil%second(k))/3.0_wp
   end function weight_of

   !> The weight of the value at a point in half the difference of the slopes on both sides, per step h; point 0 is the middle. The
   !> weighted sum is of order h³ without a corner. One-sided stencils cannot detect a corner.
   !> Equation (E.2) of docs/theory/derivatives.md.
   pure real(wp) function corner_weight(stencil, k) result(weight)
      type(stencil_t), intent(in) :: stencil
      integer, intent(in) :: k

      weight = 0.0_wp
      if (sees_corners(stencil)) weight = corner_weights(k)
   end function corner_weight

   !> Whether a stencil has points on both sides of the middle, so that the stencil detects corners.
   pure logical function sees_corners(stencil)
      type(stencil_t), intent(in) :: stencil
      sees_corners = stencil%at(1)*stencil%at(4) < 0.0_wp
   end function sees_corners

   !> Computes the derivatives of many functions, and estimates of their errors. With a central stencil, the estimate is an upper
   !> limit for a function that is straight except for one corner within the points.
   !> Equation (E.2) of docs/theory/derivatives.md.
   pure subroutine differentiate(stencil, h, here, y, slope, error)
      type(stencil_t), intent(in) :: stencil
      real(wp), intent(in) :: h                            !! step h, in the unit of the number
      real(wp), intent(in) :: here(:), y(:, :)             !! values in the middle; values at the points (function, point)
      real(wp), intent(out) :: slope(:), error(:)
      real(wp) :: gap, corner
      integer :: c

      associate (sees => sees_corners(stencil))
         do c = 1, size(slope)
            call combine(stencil, sees, h, here(c), y(c, 1), y(c, 2), y(c, 3), y(c, 4), slope(c), gap, corner)
            error(c) = abs(gap) + abs(corner)
         end do
      end associate
   end subroutine differentiate

   !> Computes the derivative of one function, and both parts of its error with their signs: the difference of the two quotients,
   !> and the effect of a corner.
   pure subroutine find_quotients(stencil, h, here, y, slope, gap, corner)
      type(stencil_t), intent(in) :: stencil
      real(wp), intent(in) :: h                            !! step h, in the unit of the number
      real(wp), intent(in) :: here, y(4)                   !! values in the middle, and at the points
      real(wp), intent(out) :: slope, gap, corner
      call combine(stencil, sees_corners(stencil), h, here, y(1), y(2), y(3), y(4), slope, gap, corner)
   end subroutine find_quotients

   !> Computes what find_quotients does, from numbers alone, so that it is compiled in place.
   !> Equation (E.2) of docs/theory/derivatives.md.
   pure subroutine combine(stencil, sees, h, here, y1, y2, y3, y4, slope, gap, corner)
      type(stencil_t), intent(in) :: stencil
      logical, intent(in) :: sees                          !! sees_corners
      real(wp), intent(in) :: h, here, y1, y2, y3, y4
      real(wp), intent(out) :: slope, gap, corner
      real(wp), parameter :: third = 1.0_wp/3.0_wp
      real(wp) :: first, second, per_step

      per_step = 1.0_wp/h
      first = (stencil%first(1)*y1 + stencil%first(2)*y2 + stencil%first(3)*y3 + stencil%first(4)*y4)*per_step
      second = (stencil%second(1)*y1 + stencil%second(2)*y2 + stencil%second(3)*y3 + stencil%second(4)*y4)*per_step
      slope = first + third*(first - second)
      gap = 2.0_wp*third*(first - second)
      ! a corner in the middle is the same in both quotients
      corner = 0.0_wp
      if (sees) corner = (corner_weights(0)*here + (corner_weights(1)*y1 + corner_weights(2)*y2 + corner_weights(3)*y3 + &
         corner_weights(4)*y4))*per_step
   end subroutine combine

end module ek_stencil
