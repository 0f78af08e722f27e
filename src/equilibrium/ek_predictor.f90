!> Predicts the next state by a polynomial through the last few states, in Lagrange's form.
!>
!> Positions, quaternions and reactions are smooth along a path, so that each packed number is extrapolated separately. The
!> quaternions are normalised afterwards. At a stop contact or a corner of a curve the path is not smooth, and a polynomial through
!> many states oscillates beyond this point. After a poor prediction, the next prediction therefore uses the number of states that
!> would have predicted best.
module ek_predictor
   use ek_kinds, only: wp
   use ek_vector, only: add_multiple
   implicit none(type, external)
   private
   public :: predictor_t, new_predictor, remember, predict, judge, forget, usable, find_weights

   integer, parameter, public :: depth = 6   !! number of states stored; more would amplify rounding (Σ|w| = 2^depth − 1)

   real(wp), parameter :: too_near = 1.0e-6_wp   !! distance of states, as a share of the step ahead: closer states amplify rounding

   !> The last states, in a ring of slots, and the number of states that predictions use.
   type :: predictor_t
      real(wp), allocatable :: packed(:, :)   !! (coordinate, slot): packed states
      real(wp), allocatable :: guess(:)       !! work space: one packed state
      real(wp) :: abscissa(depth) = 0.0_wp
      integer :: newest = 0, count = 0
      integer :: trusted = depth              !! number of states used for the prediction
   end type predictor_t

contains

   !> A predictor without states, with storage for states of `length` numbers.
   pure function new_predictor(length) result(self)
      integer, intent(in) :: length
      type(predictor_t) :: self
      allocate (self%packed(length, depth), self%guess(length), source=0.0_wp)
   end function new_predictor

   !> Forgets all states, for a new path.
   pure subroutine forget(self)
      type(predictor_t), intent(inout) :: self
      self%newest = 0
      self%count = 0
      self%trusted = depth
   end subroutine forget

   !> Adds a state at a value of the path coordinate.
   pure subroutine remember(self, abscissa, packed)
      type(predictor_t), intent(inout) :: self
      real(wp), intent(in) :: abscissa
      real(wp), contiguous, intent(in) :: packed(:)

      self%newest = mod(self%newest, depth) + 1
      self%count = min(self%count + 1, depth)
      self%abscissa(self%newest) = abscissa
      self%packed(:, self%newest) = packed
   end subroutine remember

   !> Predicts the state at a value of the path coordinate, in self%guess, from at most `most` earlier states. With one state, the
   !> prediction is this state. At least one state must be stored.
   !> Equation (K.12) of docs/theory/kkt.md.
   pure subroutine predict(self, abscissa, most)
      type(predictor_t), intent(inout) :: self
      real(wp), intent(in) :: abscissa
      integer, intent(in) :: most
      real(wp) :: weight(depth)
      integer :: slot(depth), n, j

      n = min(usable(self, abscissa), most)
      call find_weights(self, abscissa, n, slot, weight)
      self%guess = 0.0_wp
      do j = 1, n
         call add_multiple(size(self%guess), weight(j), self%packed(:, slot(j)), self%guess)
      end do
   end subroutine predict

   !> Adapts to a state that was found, before it is stored. After a good prediction, one more state is used from now on. After a
   !> poor prediction, the number of states that would have predicted best is used, or `depth` if all stored states were best.
   !> `used`: number of packed values that are compared (the poses).
   pure subroutine judge(self, abscissa, packed, used, is_good)
      type(predictor_t), intent(inout) :: self
      real(wp), intent(in) :: abscissa
      real(wp), contiguous, intent(in) :: packed(:)
      integer, intent(in) :: used
      logical, intent(in) :: is_good
      real(wp) :: weight(depth), error, least
      integer :: slot(depth), most, n, k

      if (is_good) then
         self%trusted = min(self%trusted + 1, depth)
         return
      end if
      least = huge(least)
      most = usable(self, abscissa)
      do n = 1, most
         call find_weights(self, abscissa, n, slot, weight)
         error = 0.0_wp
         do k = 1, used
            error = max(error, abs(sum(weight(:n)*self%packed(k, slot(:n))) - packed(k)))
         end do
         if (error >= least) cycle
         least = error
         self%trusted = n
      end do
      ! the new state will be one more; if all stored states were best, the polynomial is adequate
      if (self%trusted == most) self%trusted = depth
   end subroutine judge

   !> Number of the newest states that can be used for extrapolation. Weights of states older than two nearly coincident states
   !> amplify rounding. A range from 80 to -1e-18 has such states.
   pure integer function usable(self, abscissa)
      type(predictor_t), intent(in) :: self
      real(wp), intent(in) :: abscissa
      real(wp) :: ahead
      integer :: newer, older

      usable = min(self%count, 1)
      if (usable == 0) return
      ahead = abs(abscissa - self%abscissa(self%newest))
      newer = self%newest
      do while (usable < self%count)
         older = modulo(newer - 2, depth) + 1
         if (.not. abs(self%abscissa(newer) - self%abscissa(older)) > too_near*ahead) exit
         newer = older
         usable = usable + 1
      end do
   end function usable

   !> Finds the Lagrange weights of the newest n states at a value of the path coordinate, and the storage slots of these states.
   !> Equation (K.12) of docs/theory/kkt.md.
   pure subroutine find_weights(self, abscissa, n, slot, weight)
      type(predictor_t), intent(in) :: self
      real(wp), intent(in) :: abscissa
      integer, intent(in) :: n
      integer, intent(out) :: slot(depth)
      real(wp), intent(out) :: weight(depth)
      integer :: j, k

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
   end subroutine find_weights

end module ek_predictor
