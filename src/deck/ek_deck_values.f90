!> The values of a deck as paths and strings. A report stores these values, so that a comparison of two reports can list the
!> changes.
module ek_deck_values
   use ek_error, only: message_list_t
   use ek_deck, only: deck_t, finish_deck
   use ek_parameter, only: value_path
   use ek_record, only: record_t
   implicit none(type, external)
   private
   public :: list_values

   ! Groups whose effect is in the values of others, and keys that describe
   character(*), parameter :: left_out(3) = [character(10) :: 'include', 'hardpoints', 'mirror']
   character(*), parameter :: bands = 'target_band', quantity = 'quantity'
   character(*), parameter :: descriptions(3) = [character(5) :: 'name', 'note', 'title']

contains

   !> Lists the values from which the model was built, in the order of the deck, after settings, property files and &mirror. Names,
   !> notes and titles are omitted. Paths are written as for --set. The path of a limit of a target band contains the name of the
   !> key number; --set does not accept this path.
   subroutine list_values(deck, paths, texts)
      type(deck_t), intent(in) :: deck
      type(message_list_t), intent(out) :: paths, texts       !! of the same length
      type(deck_t) :: whole
      character(:), allocatable :: path
      integer :: k, e, v

      call finish_deck(deck, whole)
      do k = 1, whole%used
         associate (record => whole%records(k))
            if (any(left_out == record%group)) cycle
            do e = 1, record%used
               if (any(descriptions == record%entries(e)%key)) cycle
               do v = 1, record%entries(e)%used
                  if (record%entries(e)%values(v)%is_empty) cycle
                  if (record%group == bands .and. record%entries(e)%key == quantity) cycle
                  path = value_path(record, record%entries(e)%key, record%entries(e)%first + v - 1)
                  if (record%group == bands) path = bands//'.'//quantity_of(record)//'.'//record%entries(e)%key
                  call paths%add(path)
                  call texts%add(record%entries(e)%values(v)%text)
               end do
            end do
         end associate
      end do
   end subroutine list_values

   !> The key number of a band. A band itself has no name.
   pure function quantity_of(record) result(name)
      type(record_t), intent(in) :: record
      character(:), allocatable :: name
      integer :: e

      name = ''
      do e = 1, record%used
         if (record%entries(e)%key == quantity .and. record%entries(e)%used > 0) name = record%entries(e)%values(1)%text
      end do
      if (index(name, 'left_') == 1) name = name(6:)           ! a band holds for both wheels
      if (index(name, 'right_') == 1) name = name(7:)
   end function quantity_of

end module ek_deck_values
