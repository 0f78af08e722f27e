!> Common parts of the readers of files that a deck names: the units of the deck, paths, errors, and records created from a file.
!> The location of such a record is its line in the file from which it was created. Errors in a file are reported once, even if the
!> deck names the file several times.
module ek_attachment
   use ek_kinds, only: wp, units_t
   use ek_dimension, only: units_of
   use ek_error, only: message_list_t
   use ek_text, only: lower
   use ek_file, only: join_path, folder_name
   use ek_decimal, only: decimal
   use ek_record, only: deck_errors_t, place_in, record_t, entry_t, add_value, add_entry, entry_index, element, place_of
   use ek_group, only: group_number, record_head
   use ek_flaws, only: flaws_t
   implicit none(type, external)
   private
   public :: units_in_deck, path_of, report, text_of, complain, put_word, put_numbers

contains

   !> Finds the units of a deck, and whether the axes of the deck are x forward and y to the left (axes = 'iso').
   pure subroutine units_in_deck(records, units, is_iso)
      type(record_t), intent(in) :: records(:)
      type(units_t), intent(out) :: units
      logical, intent(out) :: is_iso
      integer :: k

      is_iso = .false.
      do k = 1, size(records)
         if (records(k)%group /= 'model') cycle
         units = units_of(element(records(k), 'length', 1), element(records(k), 'force', 1), element(records(k), 'angle', 1), &
            element(records(k), 'mass', 1))
         is_iso = lower(element(records(k), 'axes', 1)) == 'iso'
         return
      end do
   end subroutine units_in_deck

   !> The path of a file that a record names. The name in the record is relative to the folder of the deck file that contains the
   !> record.
   pure function path_of(record, name) result(path)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: name
      character(:), allocatable :: path

      path = trim(name)
      if (index(record%file, '/') > 0) path = join_path(folder_name(record%file), trim(name))
   end function path_of

   !> Adds the errors in a file to the errors of the deck, once per file: `seen` lists the files whose errors were added before.
   subroutine report(flaws, source, seen, deck_errors)
      type(flaws_t), intent(in) :: flaws
      integer, intent(in) :: source
      type(message_list_t), intent(inout) :: seen
      type(deck_errors_t), intent(inout) :: deck_errors
      integer :: k

      do k = 1, seen%count()
         if (seen%line(k) == flaws%file) return
      end do
      call seen%add(flaws%file)
      do k = 1, flaws%count()
         call deck_errors%add(place_in(flaws%file, source, flaws%line(k)), flaws%what(k))
      end do
   end subroutine report

   !> The quoted string of a key; '' if the key is not given or its value is not a string. The check of the record reports a value
   !> that is not a string.
   pure function text_of(record, key) result(text)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      character(:), allocatable :: text
      integer :: e

      text = ''
      e = entry_index(record, key, 1)
      if (e == 0) return
      if (record%entries(e)%values(1)%is_string) text = trim(record%entries(e)%values(1)%text)
   end function text_of

   !> Adds an error at a key of a record, with the group and the name of the record.
   subroutine complain(record, key, what, deck_errors)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key, what
      type(deck_errors_t), intent(inout) :: deck_errors

      call deck_errors%add(place_of(record, entry_index(record, key, 0)), record_head(group_number(record%group), &
         trim(element(record, 'name', 1)))//what)
   end subroutine complain

   !> Adds a key with a string value to a record.
   subroutine put_word(record, key, word)
      type(record_t), intent(inout) :: record
      character(*), intent(in) :: key, word
      type(entry_t) :: entry

      entry%key = key
      entry%line = record%line
      call add_value(entry, word, .true.)
      call add_entry(record, entry)
   end subroutine put_word

   !> Adds a key with a list of numbers to a record.
   subroutine put_numbers(record, key, values)
      type(record_t), intent(inout) :: record
      character(*), intent(in) :: key
      real(wp), intent(in) :: values(:)
      type(entry_t) :: entry
      integer :: k

      entry%key = key
      entry%line = record%line
      do k = 1, size(values)
         call add_value(entry, decimal(values(k)), .false.)
      end do
      call add_entry(record, entry)
   end subroutine put_numbers

end module ek_attachment
