!> Removes rounding noise from the results of a study: a response, or a column at a state, that is equal in all designs but for
!> noise (ek_noise) becomes constant. No statistics, effects and figures are then made of its last digits.
module ek_study_noise
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_noise, only: noise_of, is_constant, find_range, widen
   use ek_study, only: study_t
   use ek_study_data, only: study_data_t
   implicit none(type, external)
   private
   public :: settle_responses, settle_curves

contains

   !> Sets the noise and the widened limits of each response. The values of a constant response become its first value.
   subroutine settle_responses(study, tolerance, data)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: tolerance              !! largest tolerance of the cases [m]
      type(study_data_t), intent(inout) :: data
      real(wp) :: sizes(size(data%responses))        ! largest magnitudes; of a difference, those of its responses
      integer :: d, r

      sizes = 0.0_wp
      do r = 1, size(sizes)
         do d = 1, size(data%y, 2)
            if (ieee_is_finite(data%y(r, d))) sizes(r) = max(sizes(r), abs(data%y(r, d)))
         end do
         if (study%responses(r)%of == 'difference') sizes(r) = max(sizes(r), maxval(sizes(study%responses(r)%less)))
         associate (axis => data%responses(r))
            axis%noise = noise_of(axis%name, sizes(r), tolerance)
            axis%widened = [axis%lower, axis%upper]
            call widen(axis%name, tolerance, axis%widened(1), axis%widened(2))
            axis%is_constant = spread_of(data%y(r, :)) <= axis%noise
            if (axis%is_constant) call level(data%y(r, :))
         end associate
      end do
   end subroutine settle_responses

   !> Makes each column constant at the states where its values in all designs are equal but for noise.
   subroutine settle_curves(tolerance, data)
      real(wp), intent(in) :: tolerance              !! tolerance of the first case [m]
      type(study_data_t), intent(inout) :: data
      integer :: c, s

      do s = 1, size(data%curves, 2)
         do c = 1, size(data%curves, 1)
            if (is_constant(data%curves(c, s, :), data%columns(c)%name, tolerance)) call level(data%curves(c, s, :))
         end do
      end do
   end subroutine settle_curves

   !> The difference of the largest and the smallest finite value; 0 without a finite value.
   pure real(wp) function spread_of(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: low, high

      call find_range(values, low, high)
      spread_of = 0.0_wp
      if (high > low) spread_of = high - low
   end function spread_of

   !> Replaces all finite values by the first of them.
   pure subroutine level(values)
      real(wp), intent(inout) :: values(:)
      integer :: first, k

      first = findloc(ieee_is_finite(values), .true., dim=1)
      do k = first + 1, merge(size(values), 0, first > 0)
         if (ieee_is_finite(values(k))) values(k) = values(first)
      end do
   end subroutine level

end module ek_study_noise
