!> Writes the store of a study in NetCDF-4 from its chunks.
!>
!> Factors and responses are variables over design. The swept value and the columns of the curves are variables over (design,
!> state). Chunks are read one after the other, so that the memory does not grow with the number of designs. The sizes of the blocks
!> in the file do not depend on the sizes of the chunks, so that two stores of the same results have the same bytes. Each block has
!> a checksum (fletcher32), so that a damaged block cannot be read.
module ek_netcdf_store
   use, intrinsic :: iso_fortran_env, only: int8, int64
   use, intrinsic :: iso_c_binding, only: c_int, c_size_t, c_float
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use netcdf, only: nf90_create, nf90_def_dim, nf90_def_var, nf90_put_att, nf90_put_var, nf90_enddef, nf90_close, nf90_strerror, &
      nf90_netcdf4, nf90_clobber, nf90_noerr, nf90_global, nf90_double, nf90_int, nf90_byte, nf90_char
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_file
   use ek_file, only: join_path
   use ek_chunk, only: chunk_t, read_chunk, chunk_name, status_names, design_invalid
   use ek_store_description, only: store_t, attributes_t, keeps, factor_role, response_role, curve_role, whole_kind, real_kind
   implicit none(type, external)
   private
   public :: write_store_file

   interface
      !> Sets the cache of a variable, by the C library; returns the status. The Fortran interface sets the cache in megabytes, too
      !> much for a thousand variables.
      integer(c_int) function nc_set_var_chunk_cache(file, variable, size, slots, preemption) bind(c)
         import :: c_int, c_size_t, c_float
         implicit none(type, external)
         integer(c_int), value :: file, variable           ! variable: from 0
         integer(c_size_t), value :: size, slots           ! bytes; entries of its hash table, a prime number
         real(c_float), value :: preemption                ! 1: blocks that are complete leave first
      end function nc_set_var_chunk_cache
   end interface

   integer, parameter :: block = 8192             !! number of designs in a block of a variable over design
   integer, parameter :: block_bytes = 524288     !! largest number of bytes in a block of any other variable
   integer, parameter :: level = 1 !! level of the compression: higher levels take twice the time for a tenth of the size

   !> The open file, with the ids of its dimensions and variables.
   type :: file_t
      integer :: id = 0
      integer :: design = 0, state = 0            !! ids of the dimensions
      integer :: design_number = 0, state_number = 0, status = 0, within = 0, reason = 0      !! ids of the variables
      integer, allocatable :: variables(:)        !! id of each variable of the description
      integer :: fault = nf90_noerr               !! status of the first error
   end type file_t

contains

   !> Writes the store of a study into a new file.
   subroutine write_store_file(store, folder, path, error)
      type(store_t), intent(in) :: store
      character(*), intent(in) :: folder                   !! folder of the chunks
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      type(file_t) :: file
      type(chunk_t) :: chunk
      integer(i8) :: next                                  ! design
      integer :: k
      logical :: is_good

      call note(file%fault, nf90_create(path, ior(nf90_netcdf4, nf90_clobber), file%id))
      if (file%fault == nf90_noerr) then
         call define(store, file)
         call write_names(store, file)
         next = 1
         do k = 1, store%chunks
            if (file%fault /= nf90_noerr) exit
            call read_chunk(join_path(folder, chunk_name(k)), store%identity, next, 0, chunk, is_good, error)
            if (is_good) is_good = fits(store, chunk)
            if (.not. is_good) then
               if (.not. allocated(error)) call fail(error, exit_file, join_path(folder, chunk_name(k))// &
                  ': the chunk is missing or damaged')
               exit
            end if
            call write_chunk(store, chunk, file)
            next = next + size(chunk%status)
         end do
         ! after a failure the file is not closed: HDF5 would try again to write what it holds, and may crash
         if (file%fault == nf90_noerr .and. .not. allocated(error)) call note(file%fault, nf90_close(file%id))
      end if
      if (file%fault /= nf90_noerr .and. .not. allocated(error)) call fail(error, exit_file, &
         "cannot write '"//path//"': "//trim(nf90_strerror(file%fault)))
   end subroutine write_store_file

   !> Records the first error of the NetCDF library.
   subroutine note(fault, status)
      integer, intent(inout) :: fault
      integer, intent(in) :: status
      if (fault == nf90_noerr) fault = status
   end subroutine note

   !> Whether a chunk fits into the store: it has as many factors, responses and columns as the store, no more states, and no design
   !> after the last design of the store.
   pure logical function fits(store, chunk)
      type(store_t), intent(in) :: store
      type(chunk_t), intent(in) :: chunk

      fits = all([size(chunk%factors, 1), size(chunk%responses, 1), size(chunk%curves, 1)] == [count_of(store, factor_role), &
         count_of(store, response_role), count_of(store, curve_role)]) .and. all(chunk%states <= store%states) &
         .and. chunk%first + size(chunk%status) - 1 <= store%designs
   end function fits

   !> The number of variables with a role.
   pure integer function count_of(store, role)
      type(store_t), intent(in) :: store
      character(*), intent(in) :: role
      integer :: k

      count_of = 0
      do k = 1, size(store%variables)
         if (store%variables(k)%role == role) count_of = count_of + 1
      end do
   end function count_of

   !> Defines dimensions, variables and attributes. ncdump shows the dimensions in reverse order: the last dimension in Fortran is
   !> the first dimension in ncdump.
   subroutine define(store, file)
      type(store_t), intent(in) :: store
      type(file_t), intent(inout) :: file
      integer :: k, length, text

      call put_attributes(file, nf90_global, store%attributes)
      call note(file%fault, nf90_def_dim(file%id, 'design', store%designs, file%design))
      if (store%states > 0) call note(file%fault, nf90_def_dim(file%id, 'state', store%states, file%state))
      length = min(block, store%designs)
      call over_designs('design', nf90_int, file%design_number)
      call put_text(file, file%design_number, 'long_name', 'number of the design')
      if (store%states > 0) then
         call note(file%fault, nf90_def_var(file%id, 'state', nf90_int, [file%state], file%state_number, &
            chunksizes=[store%states], fletcher32=.true.))
         call put_text(file, file%state_number, 'long_name', 'number of the state of a design')
      end if
      allocate (file%variables(size(store%variables)), source=0)
      do k = 1, size(store%variables)
         associate (this => store%variables(k))
            if (this%role == curve_role) then
               if (store%states == 0) cycle
               call over_two(this%name, nf90_double, file%state, store%states, 8, file%variables(k))
            else
               call over_designs(this%name, nf90_double, file%variables(k))
            end if
            call note(file%fault, nf90_put_att(file%id, file%variables(k), '_FillValue', ieee_value(1.0_wp, ieee_quiet_nan)))
            call put_attributes(file, file%variables(k), this%attributes)
         end associate
      end do
      if (store%has_limits) then
         call over_designs('within', nf90_byte, file%within)
         call put_flags(file, file%within, 'whether the design satisfies all limits of the responses', 'no yes', 1)
      end if
      call over_designs('status', nf90_byte, file%status)
      call put_flags(file, file%status, 'how the design ended', flag_meanings(), design_invalid)
      call note(file%fault, nf90_def_dim(file%id, 'reason_length', max(1, store%reason), text))
      call over_two('reason', nf90_char, text, max(1, store%reason), 1, file%reason)
      call put_text(file, file%reason, 'long_name', 'why the design failed')
      call put_text(file, file%reason, '_Encoding', 'utf-8')

   contains

      !> Defines a variable over design.
      subroutine over_designs(name, kind, variable)
         character(*), intent(in) :: name
         integer, intent(in) :: kind
         integer, intent(out) :: variable
         call note(file%fault, nf90_def_var(file%id, name, kind, [file%design], variable, chunksizes=[length], shuffle=.true., &
            deflate_level=level, fletcher32=.true.))
         call set_cache(8*length, variable)
      end subroutine over_designs

      !> Defines a variable over (design, a second dimension).
      subroutine over_two(name, kind, second, entries, bytes, variable)
         character(*), intent(in) :: name
         integer, intent(in) :: kind
         integer, intent(in) :: second, entries, bytes     !! dimension, its size; bytes of an entry
         integer, intent(out) :: variable
         integer :: designs
         designs = max(1, min(length, block_bytes/(entries*bytes)))
         call note(file%fault, nf90_def_var(file%id, name, kind, [second, file%design], variable, chunksizes=[entries, designs], &
            shuffle=.true., deflate_level=level, fletcher32=.true.))
         call set_cache(entries*designs*bytes, variable)
      end subroutine over_two

      !> Sets the size of the cache of a variable to the two blocks into which a chunk may be written.
      subroutine set_cache(bytes, variable)
         integer, intent(in) :: bytes             !! size of a block
         integer, intent(in) :: variable
         if (file%fault == nf90_noerr) call note(file%fault, int(nc_set_var_chunk_cache(int(file%id, c_int), &
            int(variable - 1, c_int), int(2*bytes, c_size_t), 11_c_size_t, 1.0_c_float)))
      end subroutine set_cache

   end subroutine define

   !> The meanings of the status flags as a string: 'solved incomplete …'.
   pure function flag_meanings() result(text)
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 0, design_invalid
         text = text//' '//trim(status_names(k))
      end do
      text = text(2:)
   end function flag_meanings

   !> Writes the attributes of a byte variable whose values have meanings.
   subroutine put_flags(file, variable, long_name, meanings, last)
      type(file_t), intent(inout) :: file
      integer, intent(in) :: variable
      character(*), intent(in) :: long_name, meanings
      integer, intent(in) :: last                 !! last value; the values are 0 … last
      integer :: k

      call put_text(file, variable, 'long_name', long_name)
      call note(file%fault, nf90_put_att(file%id, variable, 'flag_values', int([(k, k=0, last)], int8)))
      call put_text(file, variable, 'flag_meanings', meanings)
   end subroutine put_flags

   subroutine put_text(file, variable, name, text)
      type(file_t), intent(inout) :: file
      integer, intent(in) :: variable
      character(*), intent(in) :: name, text
      call note(file%fault, nf90_put_att(file%id, variable, name, text))
   end subroutine put_text

   !> Writes the attributes of the store or of one of its variables.
   subroutine put_attributes(file, variable, list)
      type(file_t), intent(inout) :: file
      integer, intent(in) :: variable
      type(attributes_t), intent(in) :: list
      character(:), allocatable :: text
      real(wp) :: value
      integer(int64) :: whole
      integer :: k, ignored

      do k = 1, list%names%count()
         text = list%texts%line(k)
         select case (list%kinds%line(k))
         case (whole_kind)
            read (text, *, iostat=ignored) whole
            call note(file%fault, nf90_put_att(file%id, variable, list%names%line(k), whole))
         case (real_kind)
            read (text, *, iostat=ignored) value
            call note(file%fault, nf90_put_att(file%id, variable, list%names%line(k), value))
         case default
            call put_text(file, variable, list%names%line(k), text)
         end select
      end do
   end subroutine put_attributes

   !> Writes the names of the responses and of the quantities, each list over its own dimension. Writes the indices of the states.
   subroutine write_names(store, file)
      type(store_t), intent(in) :: store
      type(file_t), intent(inout) :: file
      integer :: k

      call write_list(response_role, 'response')
      if (store%states > 0) call write_list(curve_role, 'quantity')
      if (store%states > 0) call note(file%fault, nf90_put_var(file%id, file%state_number, [(k, k=1, store%states)]))

   contains

      subroutine write_list(role, name)
         character(*), intent(in) :: role, name
         character(:), allocatable :: padded
         integer :: n, j, length, list, dimension, text

         n = count_of(store, role)
         if (n == 0) return
         length = 1
         do j = 1, size(store%variables)
            if (store%variables(j)%role == role) length = max(length, len(store%variables(j)%name))
         end do
         call note(file%fault, nf90_def_dim(file%id, name, n, dimension))
         call note(file%fault, nf90_def_dim(file%id, name//'_length', length, text))
         call note(file%fault, nf90_def_var(file%id, name//'_name', nf90_char, [text, dimension], list, &
            chunksizes=[length, n], fletcher32=.true.))
         call put_text(file, list, 'long_name', 'name of the variable of each '//name)
         call put_text(file, list, '_Encoding', 'utf-8')
         call note(file%fault, nf90_enddef(file%id))
         n = 0
         do j = 1, size(store%variables)
            if (store%variables(j)%role /= role) cycle
            n = n + 1
            padded = store%variables(j)%name//repeat(achar(0), length - len(store%variables(j)%name))
            call note(file%fault, nf90_put_var(file%id, list, padded, start=[1, n], count=[length, 1]))
         end do
      end subroutine write_list

   end subroutine write_names

   !> Writes the designs of a chunk. Reasons are written for failed designs only.
   subroutine write_chunk(store, chunk, file)
      type(store_t), intent(in) :: store
      type(chunk_t), intent(in) :: chunk
      type(file_t), intent(inout) :: file
      character(max(1, store%reason)) :: reason
      integer(int8), allocatable :: flags(:)
      real(wp), allocatable :: curve(:, :)
      integer :: first, n, f, r, c, k, design

      first = int(chunk%first)
      n = size(chunk%status)
      call note(file%fault, nf90_put_var(file%id, file%design_number, [(k, k=first, first + n - 1)], start=[first], count=[n]))
      call note(file%fault, nf90_put_var(file%id, file%status, int(chunk%status, int8), start=[first], count=[n]))
      if (store%has_limits) then
         allocate (flags(n))
         call find_within(store, chunk, flags)
         call note(file%fault, nf90_put_var(file%id, file%within, flags, start=[first], count=[n]))
      end if
      allocate (curve(store%states, n))
      f = 0
      r = 0
      c = 0
      do k = 1, size(store%variables)
         select case (store%variables(k)%role)
         case (factor_role)
            f = f + 1
            call note(file%fault, nf90_put_var(file%id, file%variables(k), chunk%factors(f, :), start=[first], count=[n]))
         case (response_role)
            r = r + 1
            call note(file%fault, nf90_put_var(file%id, file%variables(k), chunk%responses(r, :), start=[first], count=[n]))
         case default
            c = c + 1
            if (store%states == 0) cycle
            call take_curve(chunk, c, curve)
            call note(file%fault, nf90_put_var(file%id, file%variables(k), curve, start=[1, first], count=[store%states, n]))
         end select
      end do
      do k = 1, size(chunk%reasons)
         design = chunk%reasons(k)%design
         reason = repeat(achar(0), len(reason))
         reason(:len(chunk%reasons(k)%text)) = chunk%reasons(k)%text
         call note(file%fault, nf90_put_var(file%id, file%reason, reason, start=[1, first + design - 1], count=[len(reason), 1]))
      end do
   end subroutine write_chunk

   !> Finds the designs that satisfy all limits: their flag is 1, the flag of all other designs is 0.
   pure subroutine find_within(store, chunk, flags)
      type(store_t), intent(in) :: store
      type(chunk_t), intent(in) :: chunk
      integer(int8), intent(out) :: flags(:)
      real(wp) :: lower(size(chunk%responses, 1)), upper(size(chunk%responses, 1))
      integer :: k, r

      r = 0
      do k = 1, size(store%variables)
         if (store%variables(k)%role /= response_role) cycle
         r = r + 1
         lower(r) = store%variables(k)%lower
         upper(r) = store%variables(k)%upper
      end do
      do k = 1, size(flags)
         flags(k) = merge(1_int8, 0_int8, chunk%status(k) == 0 .and. keeps(chunk%responses(:, k), lower, upper))
      end do
   end subroutine find_within

   !> Extracts one column of the curves of a chunk. The values are NaN at states that a design lacks.
   pure subroutine take_curve(chunk, column, curve)
      type(chunk_t), intent(in) :: chunk
      integer, intent(in) :: column
      real(wp), intent(out) :: curve(:, :)        !! (state, design)
      integer :: k, row

      curve(:, :) = ieee_value(1.0_wp, ieee_quiet_nan)
      row = 0
      do k = 1, size(chunk%status)
         curve(:chunk%states(k), k) = chunk%curves(column, row + 1:row + chunk%states(k))
         row = row + chunk%states(k)
      end do
   end subroutine take_curve

end module ek_netcdf_store
