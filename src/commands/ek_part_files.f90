!> The files of the loads on parts, with --loads and of the command `loads`: parts/<part>.csv, load-envelope.csv and loads.json.
module ek_part_files
   use ek_buffer, only: buffer_t
   use ek_file, only: join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_part_record, only: part_record_t, envelope_text, parts_json
   use ek_report_names, only: envelope_file, loads_json_file, part_file, parts_folder
   use ek_outbox, only: outbox_t
   implicit none(type, external)
   private
   public :: put_parts, remove_parts

contains

   !> Writes all files and prints their paths.
   subroutine put_parts(suspension, record, box)
      type(suspension_t), intent(in) :: suspension
      type(part_record_t), intent(in) :: record
      type(outbox_t), intent(inout) :: box
      type(buffer_t) :: envelope
      character(:), allocatable :: json
      integer :: b

      call box%make_folder(parts_folder)
      do b = 1, size(suspension%bodies)
         call box%put(part_file(suspension%bodies(b)%name), record%texts(b)%text())
      end do
      call envelope_text(suspension, record, envelope)
      call box%put(envelope_file, envelope%text())
      call parts_json(record, json)
      call box%put(loads_json_file, json)
   end subroutine put_parts

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
