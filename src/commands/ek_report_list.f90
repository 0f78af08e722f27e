!> A folder contains one report. report-files.csv lists the files of the report, with checksums (ek_listed_files).
module ek_report_list
   use ek_error, only: error_t, message_list_t
   use ek_report_content, only: report_t
   use ek_report_names, only: list_file, files_of_reports, files_of_loads, envelope_file, loads_json_file, part_file
   use ek_listed_files, only: renew_file_list
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

      call list_files(report, files)
      call renew_file_list(report%folder, list_file, files, 'report', is_quiet, error)
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
         if (allocated(report%parts)) call list_parts(report, files)
      end if
      do k = 1, report%copies%count()
         call files%add(report%copies%line(k))
      end do
      do k = 1, report%drawn%count()
         call files%add(report%drawn%line(k))
      end do
   end subroutine list_files

   !> Lists the files of the loads on parts.
   subroutine list_parts(report, files)
      type(report_t), intent(in) :: report
      type(message_list_t), intent(inout) :: files
      integer :: k

      call files%add(envelope_file)
      call files%add(loads_json_file)
      do k = 1, report%parts%names%count()
         call files%add(part_file(report%parts%names%line(k)))
      end do
   end subroutine list_parts

end module ek_report_list
