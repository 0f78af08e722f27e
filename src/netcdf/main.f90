!> elastokin-netcdf PARTS OUT.nc writes the store of a study from the folder of its chunks. elastokin runs this command when all
!> designs are finished.
!>
!> elastokin-netcdf --csv STORE.nc FOLDER [N] writes the tables of a store as CSV, with the curves of every N-th design.
!>
!> elastokin-netcdf is a separate program because the NetCDF libraries would make every start of elastokin 6 ms longer.
program elastokin_netcdf
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use, intrinsic :: iso_c_binding, only: c_int
   use ek_error, only: error_t, fail, exit_usage
   use ek_system_call, only: c_exit_now
   use ek_file, only: join_path
   use ek_version, only: version
   use ek_store_description, only: store_t, read_description, description_name
   use ek_netcdf_store, only: write_store_file
   use ek_netcdf_tables, only: write_store_tables
   implicit none(type, external)
   type(store_t) :: store
   type(error_t), allocatable :: error
   integer :: every

   if (argument(1) == '--version') then
      write (output_unit, '(a)') 'elastokin-netcdf '//version
   else if (argument(1) == '--csv' .and. (command_argument_count() == 3 .or. command_argument_count() == 4)) then
      call read_every(every, error)
      if (.not. allocated(error)) call write_store_tables(argument(2), argument(3), every, error)
   else if (command_argument_count() /= 2) then
      call fail(error, exit_usage, 'expected: elastokin-netcdf PARTS_FOLDER OUT.nc (elastokin study runs it), or '// &
         'elastokin-netcdf --csv STORE.nc FOLDER [N]')
   else
      call read_description(join_path(argument(1), description_name), store, error)
      if (.not. allocated(error)) call write_store_file(store, argument(1), argument(2), error)
   end if
   if (allocated(error)) then
      write (error_unit, '(a)') error%message
      flush (error_unit)
      call c_exit_now(int(error%code, c_int))      ! not stop: at the end of a program HDF5 closes open files
   end if

contains

   !> Reads the fourth argument, an integer; 1 if the argument is not given.
   subroutine read_every(every, error)
      integer, intent(out) :: every
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text
      integer :: status

      every = 1
      status = 0
      text = argument(4)
      if (len(text) > 0) read (text, *, iostat=status) every
      if (status /= 0 .or. every < 1) call fail(error, exit_usage, '--csv: N must be an integer, 1 or more')
   end subroutine read_every

   !> An argument of the command line; '' if the argument is not given.
   function argument(number) result(text)
      integer, intent(in) :: number
      character(:), allocatable :: text
      integer :: length

      call get_command_argument(number, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_command_argument(number, value=text)
   end function argument

end program elastokin_netcdf
