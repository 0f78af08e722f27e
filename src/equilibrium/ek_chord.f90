!> A step past bent laws (a stop comes into contact, a curve turns stiff): is it on the path, and does the path not turn back in it?
!>
!> The tangents at the ends of such a step disagree with the motion, as the slopes of the laws change on the way. Two questions
!> replace that comparison:
!>
!> - With every law replaced by its chord, the straight line through its forces at both ends, a and b are equilibria of the
!>   changed model too, and nothing in it bends but the geometry. Its tangents must then agree with the motion.
!> - On the way, the slope of each law stays between a least and a most. N grows with each slope (in the sense of its
!>   quadratic form), and so does each of its eigenvalues. If N has as many negative ones with all slopes at their least as with
!>   all at their most, it is regular for all slopes between: no limit point, however the laws follow each other.
!>
!> No memory is allocated after new_chord.
module ek_chord
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_measure, only: measure_value
   use ek_law, only: law_t, look_up_law, find_slopes, set_line
   use ek_elastic, only: bushing_view_t, look_bushing
   use ek_state, only: state_t
   implicit none(type, external)
   private
   public :: chord_t, new_chord, straighten, is_at_an_end, tilt, at_a, at_b, least, most

   integer, parameter :: at_a = 1, at_b = 2
   integer, parameter :: least = 1, mean = 2, most = 3

   real(wp), parameter :: bent = 1.0e-2_wp      !! of the largest slope: a smaller change is no bend

   !> The changed model; one column per law.
   type :: chord_t
      type(suspension_t) :: suspension
      real(wp), allocatable :: value(:, :), force(:, :)    !! (at_a or at_b, law): measure and force there [m, N; rad, N m]
      real(wp), allocatable :: own(:, :)                   !! (at_a or at_b, law): slope there [N/m, N m/rad]
      real(wp), allocatable :: slope(:, :)                 !! (least, mean or most, law): between them [N/m, N m/rad]
   end type chord_t

contains

   !> Copies a model and allocates the work space; without laws nothing is copied.
   function new_chord(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(chord_t) :: self
      integer :: k, laws

      laws = count(suspension%springs%has_law)
      do k = 1, size(suspension%bushings)
         if (suspension%bushings(k)%has_curves) laws = laws + count(suspension%bushings(k)%laws%has_curve)
      end do
      allocate (self%value(2, laws), self%force(2, laws), self%own(2, laws), self%slope(3, laws), source=0.0_wp)
      if (laws > 0) self%suspension = suspension
   end function new_chord

   !> Replaces every law by its chord between two states; `is_bent`: the slope of one changes between them.
   pure subroutine straighten(self, suspension, a, b, is_bent)
      type(chord_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: a, b
      logical, intent(out) :: is_bent
      type(bushing_view_t) :: from, to
      integer :: k, axis, i, j, law

      is_bent = .false.
      if (size(self%slope, 2) == 0) return
      law = 0
      do k = 1, size(suspension%springs)
         associate (spring => suspension%springs(k))
            if (.not. spring%has_law) cycle
            i = spring%measure%body_i + 1
            j = spring%measure%body_j + 1
            call draw(self, law, spring%law, measure_value(spring%measure, a%poses(i), a%poses(j)), &
               measure_value(spring%measure, b%poses(i), b%poses(j)))
         end associate
      end do
      do k = 1, size(suspension%bushings)
         associate (bushing => suspension%bushings(k))
            if (.not. bushing%has_curves) cycle
            call look_bushing(bushing, a%poses(bushing%body_i + 1), a%poses(bushing%body_j + 1), from)
            call look_bushing(bushing, b%poses(bushing%body_i + 1), b%poses(bushing%body_j + 1), to)
            do axis = 1, 3
               if (bushing%laws(axis)%has_curve) call draw(self, law, bushing%laws(axis), &
                  dot_product(bushing%axes(:, axis), from%gap), dot_product(bushing%axes(:, axis), to%gap))
            end do
            do axis = 1, 3
               if (bushing%laws(axis + 3)%has_curve) call draw(self, law, bushing%laws(axis + 3), &
                  dot_product(bushing%axes(:, axis), from%turn%theta), dot_product(bushing%axes(:, axis), to%turn%theta))
            end do
         end associate
      end do
      is_bent = any(self%slope(most, :) - self%slope(least, :) > bent*max(abs(self%slope(least, :)), abs(self%slope(most, :))))
      call tilt(self, at_a, mean)
   end subroutine straighten

   !> Stores a law at both ends.
   pure subroutine draw(self, number, law, value_a, value_b)
      type(chord_t), intent(inout) :: self
      integer, intent(inout) :: number             !! of the law before → of this one
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: value_a, value_b     !! of its measure
      real(wp) :: force(2), slope

      number = number + 1
      call look_up_law(law, value_a, force(at_a), self%own(at_a, number))
      call look_up_law(law, value_b, force(at_b), self%own(at_b, number))
      self%value(:, number) = [value_a, value_b]
      self%force(:, number) = force
      call find_slopes(law, value_a, value_b, self%slope(least, number), self%slope(most, number))
      slope = self%own(at_a, number)
      if (abs(value_b - value_a) > 0.0_wp) slope = (force(at_b) - force(at_a))/(value_b - value_a)
      ! of nearly equal values the quotient is rounding
      self%slope(mean, number) = min(max(slope, self%slope(least, number)), self%slope(most, number))
   end subroutine draw

   !> Whether all laws have their least, or their largest, slope together at a or at b: N was factorised with these there.
   pure logical function is_at_an_end(self, slope)
      type(chord_t), intent(in) :: self
      integer, intent(in) :: slope        !! least or most
      logical :: is_at(2)
      integer :: k

      is_at = .true.
      do k = 1, size(self%slope, 2)
         is_at = is_at .and. abs(self%own(:, k) - self%slope(slope, k)) <= bent*maxval(abs(self%slope(:, k)))
      end do
      is_at_an_end = any(is_at)
   end function is_at_an_end

   !> Replaces every law by a straight line through its force at a or b.
   pure subroutine tilt(self, end, slope)
      type(chord_t), intent(inout) :: self
      integer, intent(in) :: end          !! at_a or at_b
      integer, intent(in) :: slope        !! least, mean or most
      integer :: k, component, law

      law = 0
      do k = 1, size(self%suspension%springs)
         if (.not. self%suspension%springs(k)%has_law) cycle
         law = law + 1
         call set_line(self%suspension%springs(k)%law, self%value(end, law), self%force(end, law), self%slope(slope, law))
      end do
      do k = 1, size(self%suspension%bushings)
         associate (bushing => self%suspension%bushings(k))
            if (.not. bushing%has_curves) cycle
            do component = 1, 6
               if (.not. bushing%laws(component)%has_curve) cycle
               law = law + 1
               call set_line(bushing%laws(component), self%value(end, law), self%force(end, law), self%slope(slope, law))
            end do
         end associate
      end do
   end subroutine tilt

end module ek_chord
