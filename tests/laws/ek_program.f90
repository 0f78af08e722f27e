!> The program as its user runs it: exit status, what it printed, the files it wrote.
!>
!> The program is that of the environment variable EK_PROGRAM, or build/bin/elastokin; the working directory is the root of the
!> repository. Output is kept in the scratch folder of the test (ek_scratch).
module ek_program
   use ek_error, only: error_t
   use ek_file, only: read_whole
   use ek_table, only: table_t, column, column_index, read_csv
   use ek_kinds, only: wp
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_scratch, only: scratch, shell_quoted
   implicit none(type, external)
   private
   public :: outcome_t, elastokin, content, holds, count_of, listing, values_in
   public :: done, usage, bad_deck, bad_model, not_found, bad_file, stopped

   integer, parameter :: done = 0, usage = 1, bad_deck = 2, bad_model = 3, not_found = 4, bad_file = 5, &
      stopped = 6

   !> What a run of the program left behind.
   type :: outcome_t
      integer :: status = -1
      character(:), allocatable :: out, err     !! standard output, standard error
   end type outcome_t

contains

   !> elastokin ARGUMENTS, read by a shell. Status −1: there is no such program.
   type(outcome_t) function elastokin(arguments, before, tool) result(run)
      character(*), intent(in) :: arguments
      character(*), intent(in), optional :: before      !! words for the shell ahead of the program
      character(*), intent(in), optional :: tool        !! end of the name of a tool in the same folder: '-bench'
      character(:), allocatable :: path, prefix
      integer :: length, started

      path = 'build/bin/elastokin'
      call get_environment_variable('EK_PROGRAM', length=length)
      if (length > 0) then
         path = repeat(' ', length)
         call get_environment_variable('EK_PROGRAM', value=path)
      end if
      if (present(tool)) path = path//tool
      prefix = ''
      if (present(before)) prefix = before//' '
      call execute_command_line(prefix//shell_quoted(path)//' '//arguments//' </dev/null >'//shell_quoted(scratch('stdout'))// &
         ' 2>'//shell_quoted(scratch('stderr')), exitstat=run%status, cmdstat=started)
      run%out = content(scratch('stdout'))
      run%err = content(scratch('stderr'))
   end function elastokin

   !> A file, whole; '' when it is not there.
   function content(path) result(text)
      character(*), intent(in) :: path
      character(:), allocatable :: text
      type(error_t), allocatable :: error

      call read_whole(path, text, error)
      if (allocated(error) .or. .not. allocated(text)) text = ''
   end function content

   pure logical function holds(text, part)
      character(*), intent(in) :: text, part
      holds = index(text, part) > 0
   end function holds

   !> How often a part stands in a text.
   pure integer function count_of(text, part)
      character(*), intent(in) :: text, part
      integer :: at, step

      count_of = 0
      at = 1
      do
         step = index(text(at:), part)
         if (step == 0) return
         count_of = count_of + 1
         at = at + step
      end do
   end function count_of

   !> The names in a folder, hidden ones too, one a line.
   function listing(folder) result(names)
      character(*), intent(in) :: folder
      character(:), allocatable :: names
      integer :: status, started

      call execute_command_line('ls -A '//shell_quoted(folder)//' >'//shell_quoted(scratch('listing'))//' 2>/dev/null', &
         exitstat=status, cmdstat=started)
      names = content(scratch('listing'))
   end function listing

   !> A column of a CSV file; one value that is not a number, which equals nothing, when it is not there.
   function values_in(path, name) result(values)
      character(*), intent(in) :: path, name
      real(wp), allocatable :: values(:)
      type(table_t) :: table
      type(error_t), allocatable :: error

      call read_csv(path, table, error)
      if (.not. allocated(error)) then
         if (column_index(table, name) > 0) then
            values = column(table, name)
            if (size(values) > 0) return
         end if
      end if
      values = [ieee_value(1.0_wp, ieee_quiet_nan)]
   end function values_in

end module ek_program
