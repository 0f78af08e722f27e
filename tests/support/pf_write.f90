!> The two Fortran files made of a checked .pf file.
module pf_write
  use pf_check, only: pf_file_t
  use pf_text, only: lower
  implicit none(type, external)
  private

  public :: write_tests, write_driver

contains

  !> The module with every assertion made a call; `#line` lets the compiler speak of the .pf file.
  subroutine write_tests(file, path)
    type(pf_file_t), intent(in) :: file
    character(len=*), intent(in) :: path

    character(len=:), allocatable :: line
    integer :: unit, i

    open (newunit=unit, file=path, action='write', status='replace')
    write (unit, '(3a)') '#line 1 "', file%path, '"'
    do i = 1, size(file%lines)
      line = trim(adjustl(file%lines(i)))
      if (index(lower(line), '@assert') == 1) then
        write (unit, '(a,i0,3a)') '#line ', i, ' "', file%path, '"'
        write (unit, '(3a)') '  call ', line(2:len(line) - 1), ', &'
        write (unit, '(3a,i0,a)') '    & location=SourceLocation(''', file%base, '.pf'', ', i, '))'
        write (unit, '(a)') '  if (anyExceptions()) return'
        write (unit, '(a,i0,3a)') '#line ', i + 1, ' "', file%path, '"'
      else if (index(line, '@') == 1) then
        write (unit, '(2a)') '!', line
      else
        write (unit, '(a)') trim(file%lines(i))
      end if
    end do
    close (unit)
  end subroutine write_tests

  !> A program that runs the tests in order; renamed, so that no test's name can clash with another.
  subroutine write_driver(file, path)
    type(pf_file_t), intent(in) :: file
    character(len=*), intent(in) :: path

    character(len=:), allocatable :: fixtures
    integer :: unit, i

    open (newunit=unit, file=path, action='write', status='replace')
    write (unit, '(3a)') '! Made by pf2f90 from ', file%base, '.pf'
    write (unit, '(2a)') 'program ', file%base // '_driver'
    write (unit, '(a)') '  use funit_runner, only: suite_t'
    fixtures = ''
    if (file%before /= '') then
      write (unit, '(4a)') '  use ', file%base, ', only: fixture_before => ', file%before
      fixtures = fixtures // ', before=fixture_before'
    end if
    if (file%after /= '') then
      write (unit, '(4a)') '  use ', file%base, ', only: fixture_after => ', file%after
      fixtures = fixtures // ', after=fixture_after'
    end if
    do i = 1, size(file%tests)
      write (unit, '(3a,i0,2a)') '  use ', file%base, ', only: test_', i, ' => ', file%tests(i)%name
    end do
    write (unit, '(a)') '  implicit none(type, external)', '  type(suite_t) :: suite'
    write (unit, '(3a)') '  call suite%start(''', file%base, ''')'
    do i = 1, size(file%tests)
      if (file%tests(i)%is_disabled) then
        write (unit, '(3a)') '  call suite%skip(''', file%tests(i)%name, ''')'
      else
        write (unit, '(3a,/,a,i0,2a)') '  call suite%run(''', file%tests(i)%name, ''', &', '    test_', i, fixtures, ')'
      end if
    end do
    write (unit, '(2a)') '  call suite%finish()', ''
    write (unit, '(2a)') 'end program ', file%base // '_driver'
    close (unit)
  end subroutine write_driver

end module pf_write
