!> Runs the tests of one .pf file; the driver that pf2f90 generates reads like a list of them.
module funit_runner
  use, intrinsic :: iso_fortran_env, only: output_unit
  use funit_failures, only: anyExceptions, next_failure
  implicit none(type, external)
  private

  public :: suite_t

  !> The tests of one file, run in order of appearance.
  type :: suite_t
    character(len=:), allocatable :: name
    integer :: passed = 0
    integer :: failed = 0
    integer :: skipped = 0
    logical :: is_verbose = .false.
  contains
    procedure :: start
    procedure :: run
    procedure :: skip
    procedure :: finish
  end type suite_t

  abstract interface
    subroutine test_procedure()
    end subroutine test_procedure
  end interface

contains

  !> `--verbose`, which ctest gives, names each test before it runs, so that a crash has a name.
  subroutine start(this, name)
    class(suite_t), intent(inout) :: this
    character(len=*), intent(in) :: name

    character(len=16) :: argument

    this%name = name
    call get_command_argument(1, argument)
    this%is_verbose = argument == '--verbose'
  end subroutine start

  !> Run one test. As in pFUnit a failing `before` skips the test and its `after`, a failing test
  !> does not skip `after`.
  subroutine run(this, name, test, before, after)
    class(suite_t), intent(inout) :: this
    character(len=*), intent(in) :: name
    procedure(test_procedure) :: test
    procedure(test_procedure), optional :: before, after

    character(len=:), allocatable :: place, text

    if (this%is_verbose) write (output_unit, '(2a)') '  running ', name
    flush (output_unit)
    if (present(before)) call before()
    if (.not. anyExceptions()) then
      call test()
      if (present(after)) call after()
    end if

    if (.not. anyExceptions()) then
      this%passed = this%passed + 1
      return
    end if
    this%failed = this%failed + 1
    do while (anyExceptions())
      call next_failure(place, text)
      if (place /= '') place = place // ': '
      write (output_unit, '(4a)') place, name, ': ', text
    end do
    flush (output_unit)
  end subroutine run

  !> Count a test that is `@disable`d, and say so.
  subroutine skip(this, name)
    class(suite_t), intent(inout) :: this
    character(len=*), intent(in) :: name

    this%skipped = this%skipped + 1
    write (output_unit, '(3a)') '  skipped ', name, ' (@disable)'
  end subroutine skip

  !> Print the summary line and end the program: status 0, or 2 if a test failed (pFUnit's numbers).
  subroutine finish(this)
    class(suite_t), intent(in) :: this

    character(len=20) :: skipped

    skipped = ''
    if (this%skipped > 0) write (skipped, '(a,i0,a)') ', ', this%skipped, ' skipped'
    write (output_unit, '(2a,i0,a,i0,2a)') this%name, ': ', this%passed, ' passed, ', this%failed, &
      ' failed', trim(skipped)
    flush (output_unit)
    if (this%failed > 0) stop 2, quiet=.true.
    stop 0, quiet=.true.
  end subroutine finish

end module funit_runner
