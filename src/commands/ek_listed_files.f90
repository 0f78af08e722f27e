!> A list of the files of a report or of a study, with a checksum of each file. The next report or study in the folder removes every
!> listed file that it does not write itself, unless the file has been changed since. A note names each changed file.
module ek_listed_files
   use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_null_char
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: quoted
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_system_call, only: c_open, c_read, c_close, to_read
   use ek_system, only: facts_t, facts_of, regular_file, unknown_file
   use ek_file, only: write_whole, join_path, file_exists, folder_exists, remove_file
   use ek_frame, only: frame_t, new_frame
   use ek_text_table, only: text_table_t, read_text_table, cell_of
   use ek_report_names, only: parts_folder, windows_folder, definitions_folder
   use ek_console, only: print_note
   implicit none(type, external)
   private
   public :: renew_file_list, check_listed, is_among

contains

   !> Removes the files of an earlier list from the folder, and writes the list of the present files. Files of the earlier list that
   !> are also in `kept` stay, and so do their rows.
   subroutine renew_file_list(folder, list, files, owner, is_quiet, error, kept)
      character(*), intent(in) :: folder, list              !! list: name of the list in the folder
      type(message_list_t), intent(in) :: files             !! present files, relative to the folder; missing files are not listed
      character(*), intent(in) :: owner                     !! 'report' or 'study', for messages
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the list cannot be written
      type(message_list_t), intent(in), optional :: kept
      type(frame_t) :: frame
      type(text_table_t) :: old
      type(error_t), allocatable :: unread
      character(:), allocatable :: path
      integer :: k

      path = join_path(folder, list)
      frame = new_frame('file,checksum')
      if (file_exists(path)) then
         call read_text_table(path, old, unread)
         if (allocated(unread)) call print_note(is_quiet, unread%message//': files of an earlier '//owner// &
            ' in this folder stay')
         do k = 1, old%rows
            if (is_among(cell_of(old, k, 'file'), files)) cycle
            if (present(kept)) then
               if (is_among(cell_of(old, k, 'file'), kept)) then
                  call put(cell_of(old, k, 'file'), cell_of(old, k, 'checksum'))
                  cycle
               end if
            end if
            call remove_unchanged(folder, cell_of(old, k, 'file'), cell_of(old, k, 'checksum'), owner, is_quiet)
         end do
      end if
      do k = 1, files%count()
         if (file_exists(join_path(folder, files%line(k)))) call put(files%line(k), sum_of(join_path(folder, files%line(k))))
      end do
      call write_whole(path, frame%csv(), error)

   contains

      subroutine put(name, sum)
         character(*), intent(in) :: name, sum
         call frame%put(name)
         call frame%put(sum)
      end subroutine put

   end subroutine renew_file_list

   !> Removes a file of an earlier list, unless it was changed since.
   subroutine remove_unchanged(folder, name, sum, owner, is_quiet)
      character(*), intent(in) :: folder, name
      character(*), intent(in) :: sum                       !! checksum in the list
      character(*), intent(in) :: owner
      logical, intent(in) :: is_quiet

      if (.not. is_inside(name)) return
      if (.not. file_exists(join_path(folder, name))) return
      if (sum_of(join_path(folder, name)) == sum .and. sum /= '') then
         call remove_file(join_path(folder, name))
      else
         call print_note(is_quiet, quoted(join_path(folder, name))//' belongs to an earlier '//owner// &
            ' and was changed since; it stays')
      end if
   end subroutine remove_unchanged

   !> Checks that a file of a list is there, and was not changed after the list was written.
   subroutine check_listed(folder, name, sum, error)
      character(*), intent(in) :: folder, name
      character(*), intent(in) :: sum                       !! checksum in the list
      type(error_t), allocatable, intent(out) :: error      !! exit_file
      character(:), allocatable :: path

      path = join_path(folder, name)
      if (.not. file_exists(path)) then
         call fail(error, exit_file, path//' is missing; run the study again')
      else if (sum_of(path) /= sum) then
         call fail(error, exit_file, path//': this is not the table of this study: it was changed or damaged after it was '// &
            'written; run the study again')
      end if
   end subroutine check_listed

   !> Whether a listed name is the name of a file in the folder, or in its subfolders of figures, parts, windows and definitions.
   pure logical function is_inside(name)
      character(*), intent(in) :: name
      character(*), parameter :: folders(*) = [character(11) :: 'figures', parts_folder, windows_folder, definitions_folder]
      integer :: first, k

      first = 1
      do k = 1, size(folders)
         if (index(name, trim(folders(k))//'/') == 1) first = len_trim(folders(k)) + 2
      end do
      is_inside = len(name) >= first
      if (is_inside) is_inside = scan(name(first:), '/\') == 0 .and. name(first:first) /= '.'
   end function is_inside

   !> Whether a name is in a list.
   pure logical function is_among(name, files)
      character(*), intent(in) :: name
      type(message_list_t), intent(in) :: files
      integer :: k

      is_among = .false.
      do k = 1, files%count()
         is_among = is_among .or. files%line(k) == name
      end do
   end function is_among

   !> The checksum of a file, which may be larger than the memory; '' if the file cannot be read.
   function sum_of(path) result(digits)
      character(*), intent(in) :: path
      character(:), allocatable :: digits
      integer, parameter :: room = 65536                    ! bytes that are read at once
      type(checksum_t) :: sum
      type(facts_t) :: facts
      character(kind=c_char, len=room) :: bytes
      integer(c_int32_t) :: file
      integer :: got, ignored

      digits = ''
      facts = facts_of(path, follow=.true.)
      if (folder_exists(path) .or. .not. (facts%kind == regular_file .or. facts%kind == unknown_file)) return
      file = c_open(path//c_null_char, to_read)
      if (file < 0) return
      do
         got = c_read(file, bytes, room)
         if (got <= 0) exit
         call include(sum, bytes(:got))
      end do
      ignored = c_close(file)
      if (got == 0) digits = digits_of(sum)
   end function sum_of

end module ek_listed_files
