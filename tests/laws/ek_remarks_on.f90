!> The remarks of a deck on implausible values, for a deck file with one piece of its text replaced.
module ek_remarks_on
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_file, only: read_whole
   use ek_deck, only: deck_t, parse_deck
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_balance, only: balance
   use ek_plausibility, only: doubt
   implicit none(type, external)
   private
   public :: find_remarks_on, count_lines

contains

   !> Reads a deck with text `new` instead of `old`, applies the preload trim (`balance`) if possible, and lists the remarks, one per
   !> line. If the deck cannot be read, `words` is the message, and '? ' stands before it.
   subroutine find_remarks_on(deck_file, old, new, words)
      character(*), intent(in) :: deck_file, old, new
      character(:), allocatable, intent(out) :: words
      type(deck_t) :: deck
      type(error_t), allocatable :: error
      type(suspension_t) :: suspension, raw
      type(case_t), allocatable :: cases(:)
      type(message_list_t) :: remarks
      character(:), allocatable :: text
      integer :: at

      call read_whole(deck_file, text, error)
      if (.not. allocated(error)) then
         at = index(text, old)
         if (at == 0) then
            words = '? no text '//old
            return
         end if
         text = text(:at - 1)//new//text(at + len(old):)
         call parse_deck(text, deck_file, deck, error)
      end if
      if (.not. allocated(error)) call build_model(deck, suspension, cases, error)
      if (allocated(error)) then
         words = '? '//error%message
         return
      end if
      raw = suspension
      call balance(suspension, 1.0e-10_wp, error)
      if (allocated(error)) suspension = raw
      call doubt(suspension, cases, remarks, raw)
      words = remarks%text()
   end subroutine find_remarks_on

   !> Number of lines that contain a string.
   pure integer function count_lines(words, string) result(lines)
      character(*), intent(in) :: words, string
      integer :: first, length

      lines = 0
      first = 1
      do while (first <= len(words))
         length = index(words(first:)//new_line('a'), new_line('a')) - 1
         if (index(words(first:first + length - 1), string) > 0) lines = lines + 1
         first = first + length + 1
      end do
   end function count_lines

end module ek_remarks_on
