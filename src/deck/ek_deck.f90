!> A deck in memory: read from a file or a text, changed by settings, identified by a checksum.
!>
!> A mistake in the writing (a group without its end, a key given twice) does not stop the
!> reading: it is kept here, and `build_model` reports it together with every other mistake.
!> So `error` is set here only when the file cannot be read (exit_file) or is empty (exit_deck).
module ek_deck
   use, intrinsic :: iso_fortran_env, only: input_unit, iostat_eor
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_deck, exit_usage
   use ek_file, only: read_whole
   use ek_text, only: str, lower
   use ek_record, only: record_t, entry_t, complaints_t, element, is_given, add_value, add_entry
   use ek_scanner, only: scan_text
   use ek_setting, only: apply_setting, split_setting
   implicit none(type, external)
   private
   public :: deck_t, read_deck, parse_deck, set_value, split_setting, deck_checksum

   !> The parsed deck.
   type :: deck_t
      character(:), allocatable :: file          !! as named by the user; for messages
      type(record_t), allocatable :: records(:)  !! the first `used`, in the order of the text
      integer :: used = 0
      type(complaints_t) :: complaints           !! mistakes of writing
   end type deck_t

contains

   !> Reads a file; '-' is standard input.
   subroutine read_deck(path, deck, error)
      character(*), intent(in) :: path
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text

      if (path == '-') then
         call read_standard_input(text)
         call parse_deck(text, 'standard input', deck, error)
      else
         call read_whole(path, text, error)
         if (allocated(error)) return
         call parse_deck(text, path, deck, error)
      end if
   end subroutine read_deck

   !> Takes a deck from a text; `name` stands for the file in messages.
   subroutine parse_deck(text, name, deck, error)
      character(*), intent(in) :: text, name
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error

      deck%file = trim(name)
      call scan_text(text, deck%file, deck%records, deck%used, deck%complaints)
      call name_tests(deck)
      if (deck%used == 0 .and. deck%complaints%count() == 0) &
         call fail(error, exit_deck, deck%file//': the deck is empty')
   end subroutine parse_deck

   !> A case of the rig without a name is called like its test: parallel_travel, aligning_torque_anti.
   subroutine name_tests(deck)
      type(deck_t), intent(inout) :: deck
      type(entry_t) :: name
      character(:), allocatable :: text
      integer :: k

      do k = 1, deck%used
         if (deck%records(k)%group /= 'case' .or. is_given(deck%records(k), 'name')) cycle
         text = lower(element(deck%records(k), 'test', 1))
         if (text == '') cycle
         if (lower(element(deck%records(k), 'phase', 1)) == 'anti') text = text//'_anti'
         name%key = 'name'
         name%first = 1
         name%line = deck%records(k)%line
         call add_value(name, text, .true., .false.)
         call add_entry(deck%records(k), name)
      end do
   end subroutine name_tests

   !> Sets one value, as `--set path=value` does: `point.lower_ball_joint.z`, `bushing.top_mount.kt(1)`,
   !> `spring.coil.rate`, `model.length`. A key that the record lacks is added. Ranges are checked
   !> by `build_model`, whose messages then name this setting as their place.
   subroutine set_value(deck, path, text, error)
      type(deck_t), intent(inout) :: deck
      character(*), intent(in) :: path    !! group.name.key or model.key
      character(*), intent(in) :: text    !! the value as in a deck; quotes around words may be left out
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: message

      call apply_setting(deck%records, deck%used, path, text, message)
      if (message == '') return
      if (deck%complaints%count() > 0) message = deck%complaints%text()//new_line('a')//message
      call fail(error, exit_usage, message)
   end subroutine set_value

   !> 16 hexadecimal digits (FNV-1a, 64 bits) of everything that can change a result: comments,
   !> notes, titles and layout do not count, settings do.
   function deck_checksum(deck) result(digits)
      type(deck_t), intent(in) :: deck
      character(16) :: digits
      integer(i8) :: high, low
      integer :: k, e, v

      high = int(z'cbf29ce4', i8)
      low = int(z'84222325', i8)
      do k = 1, deck%used
         call include('&'//deck%records(k)%group)
         do e = 1, deck%records(k)%used
            associate (entry => deck%records(k)%entries(e))
               if (entry%key == 'note' .or. entry%key == 'title') cycle
               call include(';'//entry%key//'('//str(entry%first)//')')
               do v = 1, entry%used
                  call include(merge("'", ',', entry%values(v)%is_string)//entry%values(v)%text)
               end do
            end associate
         end do
      end do
      write (digits, '(2z8.8)') high, low

   contains

      !> hash ← (hash xor byte) × (2^40 + 0x1b3), in two halves of 32 bits so that nothing overflows.
      subroutine include(text)
         character(*), intent(in) :: text
         integer(i8), parameter :: mask = int(z'ffffffff', i8), multiplier = int(z'1b3', i8)
         integer(i8) :: product
         integer :: c

         do c = 1, len(text)
            low = ieor(low, int(ichar(text(c:c)), i8))
            product = low*multiplier
            high = iand(high*multiplier + ishft(product, -32) + ishft(iand(low, int(z'ffffff', i8)), 8), mask)
            low = iand(product, mask)
         end do
      end subroutine include

   end function deck_checksum

   !> All of standard input, line by line: it may be a pipe, without a size.
   subroutine read_standard_input(text)
      character(:), allocatable, intent(out) :: text
      character(4096) :: chunk
      character(:), allocatable :: grown
      integer :: status, got, filled

      allocate (character(65536) :: text)
      filled = 0
      do
         read (input_unit, '(a)', advance='no', iostat=status, size=got) chunk
         if (status /= 0 .and. status /= iostat_eor) exit
         if (filled + got + 1 > len(text)) then
            allocate (character(2*len(text)) :: grown)
            grown(:filled) = text(:filled)
            call move_alloc(grown, text)
         end if
         text(filled + 1:filled + got) = chunk(:got)
         filled = filled + got
         if (status == iostat_eor) then
            filled = filled + 1
            text(filled:filled) = new_line('a')
         end if
      end do
      text = text(:filled)
   end subroutine read_standard_input

end module ek_deck
