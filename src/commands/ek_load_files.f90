!> The files of --loads. loads.csv contains the loads of all members at all states of all cases; peak-loads.csv contains the largest
!> loads.
module ek_load_files
   use ek_error, only: error_t
   use ek_buffer, only: buffer_t
   use ek_file, only: write_whole, join_path, remove_file
   use ek_member_loads, only: load_record_t, peak_loads
   use ek_report_names, only: loads_file, peaks_file
   use ek_console, only: print_path
   implicit none(type, external)
   private
   public :: write_loads, remove_loads

contains

   !> Writes both files and prints their paths.
   subroutine write_loads(record, folder, unprinted, error)
      type(load_record_t), intent(in) :: record
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: unprinted      !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error            !! exit_file
      type(buffer_t) :: peaks

      call write_whole(join_path(folder, loads_file), record%text%text(), error)
      if (allocated(error)) return
      call print_path(join_path(folder, loads_file), unprinted)
      call peak_loads(record, peaks)
      call write_whole(join_path(folder, peaks_file), peaks%text(), error)
      if (.not. allocated(error)) call print_path(join_path(folder, peaks_file), unprinted)
   end subroutine write_loads

   !> Removes the files of an earlier run, so that they cannot be mistaken for results of this run.
   subroutine remove_loads(folder)
      character(*), intent(in) :: folder

      call remove_file(join_path(folder, loads_file))
      call remove_file(join_path(folder, peaks_file))
   end subroutine remove_loads

end module ek_load_files
