!> Hardpoints in a file: a table as CSV, or the [HARDPOINT] blocks of a subsystem or an assembly of Adams/Car (.sub, .asy). A row
!> with the symmetry 'left/right' is a pair of points and gives the coordinates of the left point.
module ek_hardpoint_sheet
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_file, only: read_whole, most_of_input
   use ek_flaws, only: flaws_t, new_flaws
   use ek_fields, only: lines_t, split_lines
   use ek_teimorbit, only: teimorbit_t, parse_teimorbit, is_teimorbit
   use ek_hardpoint, only: hardpoint_t, hardpoints_t, single_point, left_point, right_point, point_pair
   use ek_hardpoint_blocks, only: take_blocks
   use ek_hardpoint_table, only: take_table
   implicit none(type, external)
   private
   public :: hardpoint_t, hardpoints_t, read_hardpoints, parse_hardpoints, single_point, left_point, right_point, point_pair

contains

   !> Reads a file; errors in its content are in `flaws`.
   subroutine read_hardpoints(path, length, sheet, flaws, error, may_stream)
      character(*), intent(in) :: path
      real(wp), intent(in) :: length                       !! unit of a CSV column whose heading names none [m]
      type(hardpoints_t), intent(out) :: sheet
      type(flaws_t), intent(out) :: flaws
      type(error_t), allocatable, intent(out) :: error     !! exit_file: the file cannot be read
      logical, intent(in), optional :: may_stream
      character(:), allocatable :: text

      flaws = new_flaws(path)
      call read_whole(path, text, error, may_stream, most_of_input)
      if (.not. allocated(error)) call parse_hardpoints(text, length, sheet, flaws)
   end subroutine read_hardpoints

   !> Reads hardpoints from the content of a file.
   subroutine parse_hardpoints(text, length, sheet, flaws)
      character(*), intent(in) :: text
      real(wp), intent(in) :: length
      type(hardpoints_t), intent(out) :: sheet
      type(flaws_t), intent(inout) :: flaws
      type(lines_t) :: lines
      type(teimorbit_t) :: file

      allocate (sheet%points(32))
      call split_lines(text, lines, flaws)
      if (lines%count == 0) return
      sheet%is_adams = is_teimorbit(lines%text)
      if (sheet%is_adams) then
         call parse_teimorbit(lines, file, flaws)
         call take_blocks(file, sheet, flaws)
      else
         call take_table(text, length, sheet, flaws)
      end if
      if (sheet%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected hardpoints, found none')
   end subroutine parse_hardpoints

end module ek_hardpoint_sheet
