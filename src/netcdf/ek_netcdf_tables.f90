!> Writes the tables of a study as CSV, from its store in NetCDF-4, for figures and for programs that do not read NetCDF.
!>
!> The columns are the columns that elastokin writes (ek_study_tables), in the order in which the store defines its variables. A
!> factor has the attribute `change`, a response has the attribute `of`, and the curves are over (design, state).
module ek_netcdf_tables
   use, intrinsic :: iso_fortran_env, only: int8
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use netcdf, only: nf90_open, nf90_close, nf90_strerror, nf90_inquire, nf90_inquire_variable, nf90_inquire_attribute, &
      nf90_inquire_dimension, nf90_inq_dimid, nf90_inq_varid, nf90_get_att, nf90_get_var, nf90_nowrite, nf90_noerr, nf90_global, &
      nf90_max_name
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: plural, printable, quoted
   use ek_file, only: join_path
   use ek_namelist, only: is_legal_name
   use ek_table, only: table_t, new_table, name_length, csv_head, csv_row
   use ek_writer, only: writer_t, begin_file
   use ek_study_tables, only: quoted_field, tables_of, repeated_factors, kernel_words
   implicit none(type, external)
   private
   public :: write_store_tables

   integer, parameter :: block = 8192             !! number of designs that are read at once
   integer, parameter :: curve_block = 64         !! number of designs whose curves are read at once

   !> The open store, with the ids of its variables.
   type :: store_file_t
      integer :: id = 0, fault = nf90_noerr       !! id of the file; status of the first error
      integer :: designs = 0, states = 0
      integer :: within = 0, status = 0, reason = 0, reason_length = 0
      integer, allocatable :: factors(:), responses(:), curves(:)             !! ids of the variables
      character(name_length), allocatable :: heads(:)                         !! column heading of each variable
   end type store_file_t

contains

   !> Writes <study>_responses.csv and, if the store has curves, <study>_curves.csv with the curves of every n-th design.
   subroutine write_store_tables(path, folder, every, error)
      character(*), intent(in) :: path, folder
      integer, intent(in) :: every
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      type(store_file_t) :: file
      type(writer_t) :: rows, curves
      character(:), allocatable :: name

      call note(file, nf90_open(path, nf90_nowrite, file%id))
      allocate (file%factors(0), file%responses(0), file%curves(0), file%heads(0))
      if (file%fault == nf90_noerr) call survey(file)
      call get_text(file, nf90_global, 'study', name)
      call check(file, error)
      if (.not. allocated(error) .and. .not. is_legal_name(name)) call fail(error, exit_file, path// &
         ': the attribute ''study'' is '//quoted(printable(name))//', not the name of a study (letters, digits and _)')
      if (.not. allocated(error)) call begin_file(rows, join_path(folder, tables_of(name, 1)), error)
      if (.not. allocated(error)) call write_rows(file, rows)
      call check(file, error)
      if (.not. allocated(error)) call rows%finish(error)
      if (.not. allocated(error) .and. size(file%curves) > 0) then
         call begin_file(curves, join_path(folder, tables_of(name, 2)), error)
         if (.not. allocated(error)) call write_curves(file, every, curves)
         call check(file, error)
         if (.not. allocated(error)) call curves%finish(error)
      end if
      call rows%abandon()                         ! no effect on a finished table
      call curves%abandon()
      if (file%id /= 0) call note(file, nf90_close(file%id))
   end subroutine write_store_tables

   !> Records the first error of the NetCDF library.
   subroutine note(file, status)
      type(store_file_t), intent(inout) :: file
      integer, intent(in) :: status
      if (file%fault == nf90_noerr) file%fault = status
   end subroutine note

   !> Returns the recorded error of the NetCDF library, unless another error has already occurred.
   subroutine check(file, error)
      type(store_file_t), intent(in) :: file
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. file%fault == nf90_noerr) return
      call fail(error, exit_file, 'it is not the store of a study, or damaged: '//trim(nf90_strerror(file%fault)))
   end subroutine check

   !> Reads the dimensions of the store, and finds its variables.
   subroutine survey(file)
      type(store_file_t), intent(inout) :: file
      character(nf90_max_name) :: name
      character(:), allocatable :: head
      integer :: design, state, reason, variables, dimensions, dimids(8), k
      logical :: is_curve

      call note(file, nf90_inq_dimid(file%id, 'design', design))
      if (file%fault == nf90_noerr) call note(file, nf90_inquire_dimension(file%id, design, len=file%designs))
      state = 0
      if (nf90_inq_dimid(file%id, 'state', state) == nf90_noerr) &
         call note(file, nf90_inquire_dimension(file%id, state, len=file%states))
      call note(file, nf90_inq_varid(file%id, 'status', file%status))
      call note(file, nf90_inq_varid(file%id, 'reason', file%reason))
      if (file%fault == nf90_noerr) call note(file, nf90_inq_dimid(file%id, 'reason_length', reason))
      if (file%fault == nf90_noerr) call note(file, nf90_inquire_dimension(file%id, reason, len=file%reason_length))
      if (nf90_inq_varid(file%id, 'within', file%within) /= nf90_noerr) file%within = 0
      if (file%fault == nf90_noerr) call note(file, nf90_inquire(file%id, nvariables=variables))
      if (file%fault /= nf90_noerr) return
      do k = 1, variables
         call note(file, nf90_inquire_variable(file%id, k, name=name, ndims=dimensions, dimids=dimids))
         if (file%fault /= nf90_noerr) return
         head = trim(name)
         if (has(file, k, 'column_in_csv')) call get_text(file, k, 'column_in_csv', head)
         file%heads = [character(name_length) :: file%heads, head]
         is_curve = dimensions == 2 .and. file%states > 0
         if (is_curve) is_curve = dimids(1) == state .and. dimids(2) == design
         if (is_curve) file%curves = [file%curves, k]
         if (has(file, k, 'change')) file%factors = [file%factors, k]
         if (has(file, k, 'of')) file%responses = [file%responses, k]
      end do
   end subroutine survey

   logical function has(file, variable, name)
      type(store_file_t), intent(in) :: file
      integer, intent(in) :: variable
      character(*), intent(in) :: name
      has = nf90_inquire_attribute(file%id, variable, name) == nf90_noerr
   end function has

   !> Reads a string attribute; '' if the file has had an error before. If the read fails, the string is undefined; test
   !> `file%fault`.
   subroutine get_text(file, variable, name, text)
      type(store_file_t), intent(inout) :: file
      integer, intent(in) :: variable
      character(*), intent(in) :: name
      character(:), allocatable, intent(out) :: text
      integer :: length

      length = 0
      if (file%fault == nf90_noerr) call note(file, nf90_inquire_attribute(file%id, variable, name, len=length))
      allocate (character(length) :: text)
      if (file%fault == nf90_noerr) call note(file, nf90_get_att(file%id, variable, name, text))
   end subroutine get_text

   !> Adds the header lines and the column headings of a table.
   subroutine add_head(file, variables, last, table_file)
      type(store_file_t), intent(inout) :: file
      integer, intent(in) :: variables(:)
      character(*), intent(in) :: last(:)
      type(writer_t), intent(inout) :: table_file
      type(table_t) :: table
      character(:), allocatable :: study, kind, source, deck_sum, identity, kernels

      call get_text(file, nf90_global, 'study', study)
      call get_text(file, nf90_global, 'kind', kind)
      call get_text(file, nf90_global, 'source', source)
      call get_text(file, nf90_global, 'deck_checksum', deck_sum)
      call get_text(file, nf90_global, 'identity', identity)
      kernels = ''
      if (has(file, nf90_global, 'blas_kernels')) call get_text(file, nf90_global, 'blas_kernels', kernels)
      if (file%fault /= nf90_noerr) return
      table = new_table([character(name_length) :: 'design', file%heads(variables), last], 0)
      call table%header%add('study '//study//', kind '//kind//', '//plural(file%designs, 'design', 'designs'))
      call table%header%add(source//', deck checksum '//deck_sum//', study '//identity//kernel_words(kernels))
      call table_file%add(csv_head(table))
   end subroutine add_head

   !> Writes the table of designs, one row per design.
   subroutine write_rows(file, rows)
      type(store_file_t), intent(inout) :: file
      type(writer_t), intent(inout) :: rows
      character(file%reason_length) :: reason
      character(:), allocatable :: line
      real(wp), allocatable :: values(:, :), part(:)
      integer(int8), allocatable :: flags(:)
      integer :: variables(size(file%factors) + size(file%responses)), numbers(merge(2, 1, file%within > 0))
      logical, allocatable :: is_whole(:)
      integer :: first, n, k, j, m

      variables(:) = [file%factors, file%responses]
      m = size(variables)
      numbers(1) = file%within
      numbers(size(numbers)) = file%status
      call add_head(file, variables, [character(name_length) :: file%heads(numbers), 'reason'], rows)
      allocate (values(1 + m + size(numbers), block), part(block), flags(block))
      allocate (is_whole(size(values, 1)), source=.true.)
      is_whole(2:m + 1) = .false.
      do first = 1, file%designs, block
         n = min(block, file%designs - first + 1)
         values(1, :n) = [(real(first + k - 1, wp), k=1, n)]
         do j = 1, m
            call note(file, nf90_get_var(file%id, variables(j), part(:n), start=[first], count=[n]))
            values(1 + j, :n) = part(:n)
         end do
         do j = 1, size(numbers)
            call note(file, nf90_get_var(file%id, numbers(j), flags(:n), start=[first], count=[n]))
            values(1 + m + j, :n) = real(flags(:n), wp)
         end do
         if (file%fault /= nf90_noerr) return
         do k = 1, n
            line = csv_row(values(:, k), is_whole)
            reason = ''
            if (flags(k) /= 0) call note(file, nf90_get_var(file%id, file%reason, reason, start=[1, first + k - 1], &
               count=[len(reason), 1]))
            call rows%add(line(:len(line) - 1)//','//quoted_field(reason(:index(reason//achar(0), achar(0)) - 1))//new_line('a'))
         end do
      end do
   end subroutine write_rows

   !> Writes the table of states, one row per state of every n-th design. States that a design lacks are omitted.
   subroutine write_curves(file, every, curves)
      type(store_file_t), intent(inout) :: file
      integer, intent(in) :: every
      type(writer_t), intent(inout) :: curves
      real(wp), allocatable :: factors(:, :), states(:, :, :), part(:), plane(:, :)
      logical, allocatable :: is_whole(:)
      integer :: first, n, k, j, s, f, c

      f = repeated_factors(size(file%factors))
      c = size(file%curves)
      call add_head(file, [file%factors(:f), file%curves], [character(name_length) ::], curves)
      allocate (factors(f, curve_block), states(c, file%states, curve_block), part(curve_block), plane(file%states, curve_block))
      allocate (is_whole(1 + f + c), source=.false.)
      is_whole(1) = .true.
      do first = 1, file%designs, curve_block*every
         n = min(curve_block, (file%designs - first)/every + 1)
         do j = 1, f
            call note(file, nf90_get_var(file%id, file%factors(j), part(:n), start=[first], count=[n], stride=[every]))
            factors(j, :n) = part(:n)
         end do
         do j = 1, c
            call note(file, nf90_get_var(file%id, file%curves(j), plane(:, :n), start=[1, first], count=[file%states, n], &
               stride=[1, every]))
            states(j, :, :n) = plane(:, :n)
         end do
         if (file%fault /= nf90_noerr) return
         do k = 1, n
            if (.not. any(ieee_is_finite(states(1, :, k)))) cycle
            if (first + k > 2) call curves%add(new_line('a'))
            do s = 1, file%states
               if (ieee_is_finite(states(1, s, k))) call curves%add(csv_row([real(first + (k - 1)*every, wp), factors(:, k), &
                  states(:, s, k)], is_whole))
            end do
         end do
      end do
   end subroutine write_curves

end module ek_netcdf_tables
