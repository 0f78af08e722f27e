!> The table of a case in the definitions of another program (ek_definition_rows).
!>
!> Columns without a definition are omitted; state, factor and the columns on convergence stay.
module ek_defined_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: of_state
   use ek_definition, only: title_of, definitions_mark
   use ek_suspension, only: suspension_t
   use ek_defined_column, only: defined_t, define_columns, keep_named, defined_value
   use ek_table, only: table_t, new_table, name_length, name_index
   implicit none(type, external)
   private
   public :: defined_list_t, needed_columns, defined_table, definitions_line, append_defined, fill_defined

   !> Columns of a program that are appended to the table of a case.
   type :: defined_list_t
      type(defined_t), allocatable :: list(:)
      character(name_length), allocatable :: columns(:)      !! the columns of the table to which the sources of the list refer
   end type defined_list_t

contains

   !> Lists the columns of elastokin that columns of a program need, each once.
   subroutine needed_columns(columns, list, needed)
      character(name_length), intent(in) :: columns(:)       !! all columns of a case
      type(defined_t), intent(in) :: list(:)                 !! from define_columns with these columns
      character(name_length), allocatable, intent(inout) :: needed(:)      !! receives the names
      integer :: c, j, k, v

      do k = 1, size(list)
         do v = 1, size(list(k)%sources)
            do j = 1, size(list(k)%sources(v)%columns)
               c = list(k)%sources(v)%columns(j)
               if (c == 0) cycle
               if (.not. any(needed == columns(c))) needed = [character(name_length) :: needed, columns(c)]
            end do
         end do
      end do
   end subroutine needed_columns

   !> Converts a table to the definitions of a program. The header gains a line that names the program.
   subroutine defined_table(suspension, table, program, result, rows, of, names)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table                     !! with the columns of needed_columns
      character(*), intent(in) :: program
      type(table_t), intent(out) :: result
      integer, allocatable, intent(out), optional :: rows(:) !! of each column: index in `definitions`; 0: a column of elastokin
      character(name_length), allocatable, intent(out), optional :: of(:)  !! of each column: wheel or element
      character(*), intent(in), optional :: names(:)         !! only the columns with these names (is_named)
      type(defined_t), allocatable :: list(:)
      integer, allocatable :: first(:), last(:)
      integer :: k, n

      call define_columns(suspension, table%columns, program, list)
      if (present(names)) call keep_named(names, list)
      first = pack([(k, k=1, size(table%columns))], [(any(table%columns(k) == ['state ', 'factor']), k=1, size(table%columns))])
      last = pack([(k, k=1, size(table%columns))], [(any(of_state(3:)%name == table%columns(k)), k=1, size(table%columns))])
      n = size(first) + size(list)
      result = new_table([character(name_length) :: table%columns(first), list%head, table%columns(last)], size(table%values, 2))
      result%values(:size(first), :) = table%values(first, :)
      result%values(n + 1:, :) = table%values(last, :)
      do k = 1, size(table%values, 2)
         call fill_row(suspension, table%values(:, k), list, result%values(size(first) + 1:n, k))
      end do
      result%header = table%header
      call result%header%add(definitions_line(program))
      if (allocated(table%is_scheduled)) result%is_scheduled = table%is_scheduled
      if (allocated(table%names)) result%names = table%names
      result%is_along_arc = table%is_along_arc
      result%lacks_springs = table%lacks_springs
      result%rests_on_bushings = table%rests_on_bushings
      result%is_of_rows = table%is_of_rows
      if (present(rows)) then
         allocate (rows(size(result%columns)), source=0)
         rows(size(first) + 1:n) = list%row
      end if
      if (present(of)) then
         allocate (of(size(result%columns)))
         of = ''
         of(size(first) + 1:n) = list%of
      end if
   end subroutine defined_table

   !> The line of a header on the definitions.
   function definitions_line(program) result(line)
      character(*), intent(in) :: program
      character(:), allocatable :: line

      line = definitions_mark//program//' ('//title_of(program)//'). Columns without a known definition are omitted; '// &
         'elastokin list --definitions '//program//' lists all'
   end function definitions_line

   !> Appends columns of a program to a table. Creates no strings.
   subroutine append_defined(suspension, more, table)
      type(suspension_t), intent(in) :: suspension
      type(defined_list_t), intent(in) :: more
      type(table_t), intent(inout) :: table                  !! of `observe`
      type(table_t) :: longer

      longer = new_table([character(name_length) :: table%columns, more%list%head], size(table%values, 2))
      longer%values(:size(table%columns), :) = table%values
      call move_alloc(longer%columns, table%columns)
      call move_alloc(longer%values, table%values)
      call move_alloc(longer%is_whole, table%is_whole)
      call fill_defined(suspension, more, table)
   end subroutine append_defined

   !> Computes the last columns of a table, which append_defined has appended. A column without its sources in the table is NaN.
   subroutine fill_defined(suspension, more, table)
      type(suspension_t), intent(in) :: suspension
      type(defined_list_t), intent(in) :: more
      type(table_t), intent(inout) :: table
      real(wp) :: row(size(more%columns))
      integer :: place(size(more%columns)), n, c, k

      n = size(table%columns) - size(more%list)
      do c = 1, size(place)
         place(c) = c
         if (c <= n) then
            if (table%columns(c) == more%columns(c)) cycle
         end if
         place(c) = name_index(table%columns(:n), trim(more%columns(c)))
      end do
      do k = 1, size(table%values, 2)
         row = ieee_value(1.0_wp, ieee_quiet_nan)
         do c = 1, size(place)
            if (place(c) > 0) row(c) = table%values(place(c), k)
         end do
         call fill_row(suspension, row, more%list, table%values(n + 1:, k))
      end do
   end subroutine fill_defined

   !> Computes the columns of a program in one row of a table.
   subroutine fill_row(suspension, row, list, values)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: row(:)
      type(defined_t), intent(in) :: list(:)
      real(wp), intent(out) :: values(:)
      real(wp), allocatable :: gradient(:)
      integer :: k

      do k = 1, size(list)
         allocate (gradient(list(k)%formula%used))
         call defined_value(suspension, row, list(k), values(k), gradient)
         deallocate (gradient)
      end do
   end subroutine fill_row

end module ek_defined_table
