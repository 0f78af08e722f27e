!> rating_angle and rating_axis_vector of &joint and &bushing: the permitted tilt of a stud in its housing.
module ek_reader_ratings
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_blueprint, only: vector_t, given
   use ek_deck_reading, only: deck_reading_t, complain, has_key, number_of, numbers_of, value_count, text_of, slot, unit_of
   use ek_reference, only: new_vector
   use ek_tilt, only: tilt_t
   implicit none(type, external)
   private
   public :: rating_t, read_rating, add_tilts

   character(*), parameter :: angle_key = 'rating_angle', axis_key = 'rating_axis_vector'

   !> The ratings of a joint or bushing, of one tilt, or of both ends of a rod.
   type :: rating_t
      integer :: tilts = 0               !! number of tilts; 0: not rated
      real(wp) :: angle(2) = 0.0_wp      !! rad
      integer :: axis(2) = 0             !! indices of the vectors; 0: the default axis
   end type rating_t

contains

   !> Reads the ratings of the record being read.
   subroutine read_rating(reading, ends, needs_axis, rating)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: ends            !! 2 for a rod, otherwise 1
      logical, intent(in) :: needs_axis      !! the axis has no default
      type(rating_t), intent(out) :: rating
      type(vector_t) :: vector
      real(wp) :: numbers(6), unit
      integer :: k, first, given_values

      if (.not. has_key(reading, angle_key)) then
         if (has_key(reading, axis_key)) call complain(reading, axis_key, axis_key//' is used only with '//angle_key)
         return
      end if
      if (value_count(reading, angle_key) > ends) call complain(reading, angle_key, angle_key//': one angle is needed, found '// &
         str(value_count(reading, angle_key))//' (only a distance joint has two ends)')
      rating%tilts = ends
      unit = unit_of(reading, angle_key)
      rating%angle(1) = number_of(reading, angle_key, 0.0_wp)*unit
      rating%angle(2) = number_of(reading, angle_key, rating%angle(1)/unit, 2)*unit
      given_values = value_count(reading, axis_key)
      if (given_values == 0) then
         if (needs_axis) call complain(reading, '', "'"//axis_key//"' is missing: the axis of stud and housing at design")
         return
      end if
      if (given_values /= 3 .and. given_values /= 3*ends) then
         call complain(reading, axis_key, axis_key//' needs 3 values'//trim(merge(', or 6 for both ends', '                    ', &
            ends == 2))//', found '//str(given_values))
         return
      end if
      if (.not. has_key(reading, axis_key)) return      ! its values were rejected
      numbers = numbers_of(reading, axis_key, 6)
      do k = 1, given_values/3
         if (norm2(numbers(3*k - 2:3*k)) > 0.0_wp) cycle
         if (reading%cards(reading%k)%is_good) call complain(reading, axis_key, axis_key//' has zero length')
         return
      end do
      call slot(reading, axis_key, first, count=given_values)
      vector%kind = given
      do k = 1, given_values/3
         vector%first = first + 3*(k - 1)
         call new_vector(reading, vector, rating%axis(k))
      end do
      if (given_values == 3) rating%axis(2) = rating%axis(1)
   end subroutine read_rating

   !> Adds the rated tilts of a joint or of a bushing to the prototype.
   subroutine add_tilts(reading, rating, joint, bushing)
      type(deck_reading_t), intent(inout) :: reading
      type(rating_t), intent(in) :: rating
      integer, intent(in) :: joint, bushing      !! index of one of them, the other one 0
      type(tilt_t) :: tilt
      integer :: k

      do k = 1, rating%tilts
         tilt%name = text_of(reading, 'name')//'_tilt'
         if (rating%tilts > 1) tilt%name = text_of(reading, 'name')//'_'//str(k)//'_tilt'
         tilt%joint = joint
         tilt%bushing = bushing
         tilt%end = merge(k, 0, rating%tilts > 1)
         tilt%rating = rating%angle(k)
         reading%plan%prototype%tilts = [reading%plan%prototype%tilts, tilt]
         reading%plan%tilt_axes = [reading%plan%tilt_axes, rating%axis(k)]
      end do
   end subroutine add_tilts

end module ek_reader_ratings
