!> The files of the loads on parts, with --loads and of the command `loads`: parts/<part>.csv, load-envelope.csv and loads.json.
module ek_part_files
   use ek_error, only: error_t
   use ek_buffer, only: buffer_t
   use ek_file, only: make_folder, write_whole, join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_part_record, only: part_record_t, envelope_text, parts_json
   use ek_report_names, only: envelope_file, loads_json_file, part_file, parts_folder
   use ek_console, only: print_path
   implicit none(type, external)
   private
   public :: write_parts, remove_parts

contains

   !> Writes all files and prints their paths.
   subroutine write_parts(suspension, record, folder, unprinted, error)
      type(suspension_t), intent(in) :: suspension
      type(part_record_t), intent(in) :: record
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: unprinted      !! a path could not be printed
      type(error_t), allocatable, intent(out) :: error            !! exit_file
      type(buffer_t) :: envelope
      character(:), allocatable :: json
      integer :: b

      call make_folder(join_path(folder, parts_folder), error)
      do b = 1, size(suspension%bodies)
         if (allocated(error)) return
         call put(part_file(suspension%bodies(b)%name), record%texts(b)%text())
      end do
      if (allocated(error)) return
      call envelope_text(suspension, record, envelope)
      call put(envelope_file, envelope%text())
      if (allocated(error)) return
      call parts_json(record, json)
      call put(loads_json_file, json)

   contains

      !> Writes one file and prints its path.
      subroutine put(name, text)
         character(*), intent(in) :: name, text

         call write_whole(join_path(folder, name), text, error)
         if (.not. allocated(error)) call print_path(join_path(folder, name), unprinted)
      end subroutine put

   end subroutine write_parts

   !> Removes the files of an earlier run, so that they cannot be mistaken for results of this run.
   subroutine remove_parts(suspension, folder)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: folder
      integer :: b

      call remove_file(join_path(folder, envelope_file))
      call remove_file(join_path(folder, loads_json_file))
      do b = 1, size(suspension%bodies)
         call remove_file(join_path(folder, part_file(suspension%bodies(b)%name)))
      end do
   end subroutine remove_parts

end module ek_part_files
