!> &target_band: the band in which a key number of the report should lie.
module ek_target_band
   use ek_kinds, only: wp
   use ek_group, only: word_length
   use ek_deck_reading, only: deck_reading_t, complain, has_key, number_of, text_of, where_of
   implicit none(type, external)
   private
   public :: target_band_t, read_target_band

   type :: target_band_t
      character(word_length) :: quantity = ''        !! name of the number in key_numbers.csv; left_ and right_ are removed
      character(:), allocatable :: where             !! file and line
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)     !! in the unit of the number; ±huge: no limit
   end type target_band_t

contains

   !> Reads the current record. A band holds for both wheels, so that left_ and right_ of its quantity do not count. The quantity is
   !> compared with the names of the key numbers when the report has computed them.
   subroutine read_target_band(reading, target)
      type(deck_reading_t), intent(inout) :: reading
      type(target_band_t), intent(out) :: target

      target%quantity = text_of(reading, 'quantity')
      if (index(target%quantity, 'left_') == 1) target%quantity = target%quantity(6:)
      if (index(target%quantity, 'right_') == 1) target%quantity = target%quantity(7:)
      target%where = where_of(reading)
      target%low = number_of(reading, 'low', -huge(1.0_wp))
      target%high = number_of(reading, 'high', huge(1.0_wp))
      if (.not. (has_key(reading, 'low') .or. has_key(reading, 'high'))) call complain(reading, 'quantity', &
         'give low, high or both')
      if (target%low > target%high) call complain(reading, 'low', 'low must not be above high')
   end subroutine read_target_band

end module ek_target_band
