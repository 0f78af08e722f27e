!> `pf2f90 X.pf DIR NAMES`: checks X.pf and writes DIR/X.F90, its tests, and DIR/X_driver.f90, a program
!> that runs them. NAMES is the file of the public names of pFUnit's module funit, which a test may not declare.
!>
!> Every mistake of the file is reported as `X.pf:line: what`; then nothing is written and the status
!> is 2. Refused is also what gfortran would take but pFUnit would drop or register wrongly.
program pf2f90
  use, intrinsic :: iso_fortran_env, only: error_unit
  use pf_check, only: pf_file_t
  use pf_write, only: write_tests, write_driver
  implicit none(type, external)

  type(pf_file_t) :: file
  character(len=4096) :: path, directory, names
  integer :: i

  call get_command_argument(1, path)
  call get_command_argument(2, directory)
  call get_command_argument(3, names)
  if (command_argument_count() /= 3) then
    write (error_unit, '(a)') 'usage: pf2f90 X.pf OUTPUT_DIRECTORY FILE_OF_NAMES'
    stop 1, quiet=.true.
  end if

  call file%read(trim(path), trim(names))
  call file%check()
  if (size(file%mistakes) > 0) then
    do i = 1, size(file%mistakes)
      write (error_unit, '(a)') file%mistakes(i)%text
    end do
    stop 2, quiet=.true.
  end if
  call write_tests(file, trim(directory) // '/' // file%base // '.F90')
  call write_driver(file, trim(directory) // '/' // file%base // '_driver.f90')

end program pf2f90
