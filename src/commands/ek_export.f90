!> elastokin export: deck → kinematics and compliance as tables → a file that another simulator reads.
module ek_export
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: str
   use ek_file, only: make_folder, write_whole, join_path
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_balance, only: balance
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: load_deck
   use ek_console, only: print_path, print_note, print_model_remarks
   use ek_export_settings, only: export_settings_t, read_export_settings, make_request, front_of
   use ek_kandc_map, only: kandc_map_t, map_request_t, solve_map
   use ek_carmaker, only: carmaker_text
   implicit none(type, external)
   private
   public :: export

contains

   !> Solves everything first: a number that cannot be computed is an error, and no file is written.
   subroutine export(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(export_settings_t) :: settings
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:)
      type(map_request_t) :: request
      type(kandc_map_t) :: map
      type(error_t), allocatable :: unprinted
      character(:), allocatable :: checksum, text, path
      logical :: is_front

      call read_export_settings(line, settings, error)
      if (.not. allocated(error)) call load_deck(settings, suspension, cases, checksum, error)
      if (.not. allocated(error)) call make_request(settings, suspension, cases, request, error)
      if (.not. allocated(error) .and. settings%target /= 'csv') call front_of(settings, suspension, is_front, error)
      if (.not. allocated(error)) call balance(suspension, default_tolerance, error)
      if (allocated(error)) return
      call print_model_remarks(settings%is_quiet, suspension, cases, cases)
      call solve_map(suspension, request, map, error)
      if (allocated(error)) return
      path = ''
      select case (settings%target)
      case ('carmaker')
         call carmaker_text(map, is_front, checksum, text, error)
         path = join_path(settings%out, map%model//'.skc')
      end select
      if (.not. allocated(error)) call make_folder(settings%out, error)
      if (.not. allocated(error)) call write_whole(path, text, error)
      if (allocated(error)) return
      call print_path(path, unprinted)
      if (allocated(unprinted)) call move_alloc(unprinted, error)
   end subroutine export

end module ek_export
