!> The targets of a deck (&target_band) as targets of the key numbers of a report.
module ek_number_targets
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: quoted, suggestion
   use ek_key_number, only: key_number_t
   use ek_target_band, only: target_band_t
   implicit none(type, external)
   private
   public :: set_targets

contains

   !> Sets the targets of the key numbers. A band of a quantity that the report does not have gives a warning.
   subroutine set_targets(targets, numbers, warnings)
      type(target_band_t), intent(in) :: targets(:)
      type(key_number_t), intent(inout) :: numbers(:)
      type(message_list_t), intent(inout) :: warnings
      character(64) :: names(size(numbers))
      logical :: is_there
      integer :: t, k

      do k = 1, size(numbers)
         names(k) = numbers(k)%name
      end do
      do t = 1, size(targets)
         is_there = .false.
         do k = 1, size(numbers)
            if (names(k) /= targets(t)%quantity) cycle
            is_there = .true.
            numbers(k)%has_target = .true.
            numbers(k)%target = [targets(t)%low, targets(t)%high]
         end do
         if (is_there) cycle
         call warnings%add(targets(t)%where//': target_band: the report has no K&C metric '//quoted(trim(targets(t)%quantity))// &
            ' (the names are those of key_numbers.csv, without left_ and right_)'//suggestion(trim(targets(t)%quantity), names))
      end do
   end subroutine set_targets

end module ek_number_targets
