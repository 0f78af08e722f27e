!> run --json: the tables, messages (key `remarks`) and status of a run as one object (schema/run.schema.json).
module ek_run_json
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_version, only: version
   use ek_file, only: write_whole, write_standard_output, join_path
   use ek_json, only: json_t, json_string, json_numbers
   use ek_quantity, only: unit_of, unit_text
   use ek_case, only: case_t
   use ek_remark, only: remark_t
   use ek_case_result, only: case_result_t
   use ek_console, only: print_path
   implicit none(type, external)
   private
   public :: begin_run_json, add_run_json, write_run_json

   character(*), parameter :: severities(3) = [character(7) :: 'note', 'warning', 'failure']
   character(*), parameter :: outcomes(0:4) = [character(13) :: 'solved', 'partly_solved', 'not_solvable', 'not_mountable', &
      'out_of_memory']                                           ! of ek_case_result

contains

   !> Begins the JSON object: program, model, checksum, and the list of cases.
   subroutine begin_run_json(model, checksum, json)
      character(*), intent(in) :: model, checksum
      type(json_t), intent(out) :: json

      call json%open('{')
      call json%item('program', json_string('elastokin '//version))
      call json%item('model', json_string(model))
      call json%item('checksum', json_string(checksum))
      call json%open('[', 'cases')
   end subroutine begin_run_json

   !> Adds one case: its outcome, its messages, and its table column by column. A case that was not solved has no columns.
   subroutine add_run_json(result, case, json)
      type(case_result_t), intent(in) :: result
      type(case_t), intent(in) :: case             !! case as in the deck
      type(json_t), intent(inout) :: json
      type(remark_t) :: remark
      integer :: k

      call json%open('{')
      call json%item('name', json_string(case%name))
      call json%item('test', json_string(case%test))
      call json%item('method', json_string(case%method))
      call json%item('solver', json_string(trim(merge('plan  ', 'lapack', case%uses_plan))))
      call json%item('outcome', json_string(trim(outcomes(result%outcome))))
      call json%open('[', 'remarks')
      do k = 1, result%remarks%count()
         remark = result%remarks%item(k)
         call json%open('{')
         call json%item('severity', json_string(trim(severities(remark%severity))))
         call json%item('text', json_string(remark%whole()))
         call json%close('}')
      end do
      call json%close(']')
      if (result%is_run()) then
         call json%item('factor_unit', json_string(result%case%unit_name))
         call json%open('[', 'columns')
         do k = 1, size(result%table%columns)
            call json%open('{')
            call json%item('name', json_string(trim(result%table%columns(k))))
            call json%item('unit', json_string(unit_text(unit_of(trim(result%table%columns(k))))))
            call json%item('values', json_numbers(result%table%values(k, :)))
            call json%close('}')
         end do
         call json%close(']')
      end if
      call json%close('}')
   end subroutine add_run_json

   !> Ends the JSON object and writes it.
   subroutine write_run_json(json, status, folder, model, error)
      type(json_t), intent(inout) :: json
      integer, intent(in) :: status                                !! exit status of the program
      character(*), intent(in) :: folder, model                    !! output folder, - for standard output; model name
      type(error_t), allocatable, intent(inout) :: error           !! a failure to write; an earlier error is not replaced
      type(error_t), allocatable :: unwritten
      character(:), allocatable :: path

      call json%close(']')
      call json%item('status', str(status))
      call json%close('}')
      if (folder == '-') then
         call write_standard_output(json%text(), unwritten)
      else
         path = join_path(folder, model//'_run.json')
         call write_whole(path, json%text(), unwritten)
         if (.not. allocated(unwritten)) call print_path(path, unwritten)
      end if
      if (allocated(unwritten) .and. .not. allocated(error)) call move_alloc(unwritten, error)
   end subroutine write_run_json

end module ek_run_json
