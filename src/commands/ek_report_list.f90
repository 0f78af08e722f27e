!> A folder contains one report. report-files.csv lists the files of the report, with checksums. The next report in the folder
!> removes every listed file that it does not write itself, unless the file has been changed since. A note names each changed file.
module ek_report_list
   use ek_error, only: error_t, message_list_t
   use ek_text, only: quoted
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_file, only: write_whole, read_whole, join_path, file_exists, remove_file
   use ek_text_table, only: text_table_t, new_text_table, add_row, text_table_csv, read_text_table, cell_of
   use ek_report_content, only: report_t
   use ek_report_names, only: list_file, files_of_reports, files_of_loads
   use ek_console, only: print_note
   implicit none(type, external)
   private
   public :: renew_list

contains

   !> Removes the files of an earlier report from the folder, and writes the list of files of this report.
   subroutine renew_list(report, is_quiet, error)
      type(report_t), intent(in) :: report
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error       !! exit_file: the list cannot be written
      type(message_list_t) :: files
      type(text_table_t) :: table
      integer :: k

      call list_files(report, files)
      if (file_exists(join_path(report%folder, list_file))) call remove_earlier(report%folder, files, is_quiet)
      table = new_text_table([character(8) :: 'file', 'checksum'])
      do k = 1, files%count()
         if (.not. file_exists(join_path(report%folder, files%line(k)))) cycle
         call add_row(table)
         table%cells(1, table%rows)%text = files%line(k)
         table%cells(2, table%rows)%text = sum_of(join_path(report%folder, files%line(k)))
      end do
      call write_whole(join_path(report%folder, list_file), text_table_csv(table), error)
   end subroutine renew_list

   !> Lists the files of a report.
   subroutine list_files(report, files)
      type(report_t), intent(in) :: report
      type(message_list_t), intent(inout) :: files
      integer :: k

      do k = 1, size(files_of_reports)
         call files%add(trim(files_of_reports(k)))
      end do
      do k = 1, size(report%tests)
         if (.not. report%tests(k)%is_run) cycle
         call files%add(report%tests(k)%file)
         if (allocated(report%tests(k)%grid)) call files%add(report%tests(k)%envelope)
      end do
      if (allocated(report%loads)) then
         do k = 1, size(files_of_loads)
            call files%add(trim(files_of_loads(k)))
         end do
      end if
      do k = 1, report%copies%count()
         call files%add(report%copies%line(k))
      end do
      do k = 1, report%drawn%count()
         call files%add(report%drawn%line(k))
      end do
   end subroutine list_files

   !> Removes the files of an earlier list that this report did not write and that have not been changed since. If the list cannot
   !> be read, no file is removed.
   subroutine remove_earlier(folder, files, is_quiet)
      character(*), intent(in) :: folder
      type(message_list_t), intent(in) :: files
      logical, intent(in) :: is_quiet
      type(text_table_t) :: table
      type(error_t), allocatable :: unread
      character(:), allocatable :: name
      integer :: k

      call read_text_table(join_path(folder, list_file), table, unread)
      if (allocated(unread)) then
         call print_note(is_quiet, unread%message//': files of an earlier report in this folder stay')
         return
      end if
      do k = 1, table%rows
         name = cell_of(table, k, 'file')
         if (.not. is_inside(name) .or. is_among(name, files)) cycle
         if (.not. file_exists(join_path(folder, name))) cycle
         if (sum_of(join_path(folder, name)) == cell_of(table, k, 'checksum')) then
            call remove_file(join_path(folder, name))
         else
            call print_note(is_quiet, quoted(join_path(folder, name))// &
               ' belongs to an earlier report and was changed since; it stays')
         end if
      end do
   end subroutine remove_earlier

   !> Whether a listed name is the name of a file in the folder or in its subfolder of figures.
   pure logical function is_inside(name)
      character(*), intent(in) :: name
      character(*), parameter :: figures = 'figures/'
      integer :: first

      first = 1
      if (index(name, figures) == 1) first = len(figures) + 1
      is_inside = len(name) >= first
      if (is_inside) is_inside = scan(name(first:), '/\') == 0 .and. name(first:first) /= '.'
   end function is_inside

   pure logical function is_among(name, files)
      character(*), intent(in) :: name
      type(message_list_t), intent(in) :: files
      integer :: k

      is_among = .false.
      do k = 1, files%count()
         is_among = is_among .or. files%line(k) == name
      end do
   end function is_among

   !> The checksum of a file; '' if the file cannot be read.
   function sum_of(path) result(digits)
      character(*), intent(in) :: path
      character(:), allocatable :: digits
      type(checksum_t) :: sum
      type(error_t), allocatable :: unread
      character(:), allocatable :: text

      digits = ''
      call read_whole(path, text, unread)
      if (allocated(unread)) return
      call include(sum, text)
      digits = digits_of(sum)
   end function sum_of

end module ek_report_list
