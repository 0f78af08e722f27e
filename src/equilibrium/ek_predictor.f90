!> Guesses the next state from earlier ones: the polynomial through the last few, in Lagrange's form.
!>
!> Positions, quaternions and reactions are all smooth along a path, so each packed number is
!> extrapolated by itself; the quaternions are brought back to unit length afterwards.
module ek_predictor
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: predictor_t, new_predictor, remember, predict, forget

   integer, parameter, public :: depth = 6   !! states kept; more would amplify rounding (Σ|w| = 2^depth − 1)

   !> The last states, newest first in age order through `slot`.
   type :: predictor_t
      real(wp), allocatable :: packed(:, :)   !! (coordinate, slot)
      real(wp), allocatable :: guess(:)       !! work space: one packed state
      real(wp) :: abscissa(depth) = 0.0_wp
      integer :: newest = 0, count = 0
   end type predictor_t

contains

   !> Room for states of `length` numbers.
   pure function new_predictor(length) result(self)
      integer, intent(in) :: length
      type(predictor_t) :: self
      allocate (self%packed(length, depth), self%guess(length), source=0.0_wp)
   end function new_predictor

   !> Forget all states.
   pure subroutine forget(self)
      type(predictor_t), intent(inout) :: self
      self%newest = 0
      self%count = 0
   end subroutine forget

   !> Add a state at a place of the path.
   pure subroutine remember(self, abscissa, packed)
      type(predictor_t), intent(inout) :: self
      real(wp), intent(in) :: abscissa
      real(wp), contiguous, intent(in) :: packed(:)

      self%newest = mod(self%newest, depth) + 1
      self%count = min(self%count + 1, depth)
      self%abscissa(self%newest) = abscissa
      self%packed(:, self%newest) = packed
   end subroutine remember

   !> The state expected at a place, in self%guess, from at most `most` earlier ones (the newest alone:
   !> no change). At least one must be remembered.
   pure subroutine predict(self, abscissa, most)
      type(predictor_t), intent(inout) :: self
      real(wp), intent(in) :: abscissa
      integer, intent(in) :: most
      real(wp) :: weight(depth)
      integer :: slot(depth), n, j, k

      n = min(self%count, most)
      do j = 1, n
         slot(j) = modulo(self%newest - j, depth) + 1
      end do
      do j = 1, n
         weight(j) = 1.0_wp
         do k = 1, n
            if (k == j) cycle
            weight(j) = weight(j)*(abscissa - self%abscissa(slot(k)))/(self%abscissa(slot(j)) - self%abscissa(slot(k)))
         end do
      end do
      self%guess = 0.0_wp
      do j = 1, n
         self%guess = self%guess + weight(j)*self%packed(:, slot(j))
      end do
   end subroutine predict

end module ek_predictor
