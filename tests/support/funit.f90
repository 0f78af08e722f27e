!> The assertions of pFUnit that this project's tests use, under pFUnit's module name.
!>
!> Names, argument order and meaning are pFUnit's; the README of this directory lists the subset.
!> Each records a failure and returns; the preprocessor ends the test after the first one.
module funit
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use, intrinsic :: iso_fortran_env, only: real64
  use funit_equal, only: assertEqual
  use funit_failures, only: SourceLocation, throw, anyExceptions, suspend_traps, restore_traps
  use funit_text, only: to_text, where_text
  implicit none(type, external)
  private

  public :: SourceLocation, anyExceptions
  public :: assertEqual, assertTrue, assertFalse, assertAll, assertFail
  public :: assertLessThan, assertLessThanOrEqual, assertGreaterThan
  public :: assertIsFinite, assertIsNaN
  public :: test, run, is

  !> pFUnit's module has types of these names and a procedure `run`: a test module that takes one of them for its own does
  !> not compile there, and so not here (`is`: where gfortran takes an argument for the type).
  type :: test
  end type test

  type :: is
  end type is

  !> The three orders are of scalars; NaN fails each of them.
  interface assertLessThan
    procedure less_real, less_integer
  end interface assertLessThan

  interface assertLessThanOrEqual
    procedure less_or_equal_real, less_or_equal_integer
  end interface assertLessThanOrEqual

  interface assertGreaterThan
    procedure greater_real, greater_integer
  end interface assertGreaterThan

contains

  !> Nothing; see `test`.
  subroutine run()
  end subroutine run

  subroutine less_real(lhs, rhs, message, location)
    real(real64), intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    logical :: saved

    call suspend_traps(saved)
    if (.not. lhs < rhs) call throw('expected ' // to_text(lhs) // ' < ' // to_text(rhs), message, location)
    call restore_traps(saved)
  end subroutine less_real

  subroutine less_integer(lhs, rhs, message, location)
    integer, intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. lhs < rhs) call throw('expected ' // to_text(lhs) // ' < ' // to_text(rhs), message, location)
  end subroutine less_integer

  subroutine less_or_equal_real(lhs, rhs, message, location)
    real(real64), intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    logical :: saved

    call suspend_traps(saved)
    if (.not. lhs <= rhs) call throw('expected ' // to_text(lhs) // ' <= ' // to_text(rhs), message, location)
    call restore_traps(saved)
  end subroutine less_or_equal_real

  subroutine less_or_equal_integer(lhs, rhs, message, location)
    integer, intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. lhs <= rhs) call throw('expected ' // to_text(lhs) // ' <= ' // to_text(rhs), message, location)
  end subroutine less_or_equal_integer

  subroutine greater_real(lhs, rhs, message, location)
    real(real64), intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    logical :: saved

    call suspend_traps(saved)
    if (.not. lhs > rhs) call throw('expected ' // to_text(lhs) // ' > ' // to_text(rhs), message, location)
    call restore_traps(saved)
  end subroutine greater_real

  subroutine greater_integer(lhs, rhs, message, location)
    integer, intent(in) :: lhs, rhs
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. lhs > rhs) call throw('expected ' // to_text(lhs) // ' > ' // to_text(rhs), message, location)
  end subroutine greater_integer

  subroutine assertTrue(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. condition) call throw('expected true, found false', message, location)
  end subroutine assertTrue

  subroutine assertFalse(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (condition) call throw('expected false, found true', message, location)
  end subroutine assertFalse

  subroutine assertAll(conditions, message, location)
    logical, intent(in) :: conditions(:)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (all(conditions)) return
    call throw('expected all true, found false' // where_text('first', &
      findloc(conditions, .false., 1), shape(conditions), .not. conditions), message, location)
  end subroutine assertAll

  subroutine assertFail(message, location)
    character(len=*), intent(in) :: message
    type(SourceLocation), intent(in), optional :: location

    call throw('', message, location)
  end subroutine assertFail

  subroutine assertIsFinite(x, message, location)
    real(real64), intent(in) :: x
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. ieee_is_finite(x)) call throw('expected finite, found ' // to_text(x), message, location)
  end subroutine assertIsFinite

  subroutine assertIsNaN(x, message, location)
    real(real64), intent(in) :: x
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. ieee_is_nan(x)) call throw('expected NaN, found ' // to_text(x), message, location)
  end subroutine assertIsNaN

end module funit
