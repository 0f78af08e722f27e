!> assertEqual, for the types and ranks the tests of this project compare.
module funit_equal
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use, intrinsic :: iso_fortran_env, only: real64
  use funit_failures, only: SourceLocation, throw, suspend_traps, restore_traps
  use funit_text, only: index_text, to_text, where_text
  implicit none(type, external)
  private

  public :: assertEqual

  !> Expected and actual are equal, or differ by at most `tolerance` (real64 only, absolute, in the
  !> unit of the values, 0 if absent). NaN equals nothing, infinity equals itself. Numbers and
  !> logicals may have rank 0, 1 or 2; a scalar is expected of every element.
  interface assertEqual
    procedure equal_real, equal_integer, equal_logical, equal_string
  end interface assertEqual

contains

  subroutine equal_real(expected, actual, tolerance, message, location)
    real(real64), intent(in) :: expected(..), actual(..)
    real(real64), intent(in), optional :: tolerance
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    real(real64) :: e(size(actual)), a(size(actual)), difference(size(actual)), allowed
    logical :: is_wrong(size(actual)), saved
    integer :: worst

    if (.not. are_conformable(shape(expected), shape(actual), message, location)) return
    allowed = 0.0_real64
    if (present(tolerance)) allowed = tolerance
    a = flat_real(actual, size(a))
    e = flat_real(expected, size(a))

    ! Not "difference > allowed": NaN must fail. Equality by the two orders, since Inf - Inf is NaN.
    call suspend_traps(saved)
    difference = abs(a - e)
    is_wrong = .not. ((a <= e .and. a >= e) .or. difference <= allowed)
    if (any(is_wrong)) then
      worst = findloc(is_wrong .and. ieee_is_nan(difference), .true., 1)
      if (worst == 0) worst = maxloc(difference, 1, mask=is_wrong)
      call throw('expected ' // to_text(e(worst)) // ', found ' // to_text(a(worst)) // &
        ', difference ' // to_text(a(worst) - e(worst)) // ', tolerance ' // to_text(allowed) // &
        where_text('worst', worst, shape(actual), is_wrong), message, location)
    end if
    call restore_traps(saved)
  end subroutine equal_real

  subroutine equal_integer(expected, actual, message, location)
    integer, intent(in) :: expected(..), actual(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    integer :: e(size(actual)), a(size(actual)), worst
    logical :: is_wrong(size(actual))

    if (.not. are_conformable(shape(expected), shape(actual), message, location)) return
    a = flat_integer(actual, size(a))
    e = flat_integer(expected, size(a))
    is_wrong = a /= e
    if (.not. any(is_wrong)) return

    worst = maxloc(abs(real(a, real64) - real(e, real64)), 1)
    call throw('expected ' // to_text(e(worst)) // ', found ' // to_text(a(worst)) // &
      where_text('worst', worst, shape(actual), is_wrong), message, location)
  end subroutine equal_integer

  subroutine equal_logical(expected, actual, message, location)
    logical, intent(in) :: expected(..), actual(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    logical :: e(size(actual)), a(size(actual)), is_wrong(size(actual))
    integer :: first

    if (.not. are_conformable(shape(expected), shape(actual), message, location)) return
    a = flat_logical(actual, size(a))
    e = flat_logical(expected, size(a))
    is_wrong = a .neqv. e
    if (.not. any(is_wrong)) return

    first = findloc(is_wrong, .true., 1)
    call throw('expected ' // to_text(e(first)) // ', found ' // to_text(a(first)) // &
      where_text('first', first, shape(actual), is_wrong), message, location)
  end subroutine equal_logical

  !> Blanks at both ends do not count, as in pFUnit.
  subroutine equal_string(expected, found, message, location)
    character(len=*), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (trim(adjustl(expected)) == trim(adjustl(found))) return
    call throw('expected "' // trim(adjustl(expected)) // '", found "' // trim(adjustl(found)) // '"', &
      message, location)
  end subroutine equal_string

  !> True if the shapes agree or the expected value is a scalar; the failure is recorded otherwise.
  logical function are_conformable(expected, actual, message, location)
    integer, intent(in) :: expected(:), actual(:)   !! shapes
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    are_conformable = .false.
    if (size(actual) > 2) then
      call throw('rank above 2 is outside the subset', message, location)
    else if (size(expected) == 0) then
      are_conformable = .true.
    else if (size(expected) /= size(actual)) then
      call throw('expected shape ' // index_text(expected) // ', found ' // index_text(actual), message, &
        location)
    else if (any(expected /= actual)) then
      call throw('expected shape ' // index_text(expected) // ', found ' // index_text(actual), message, &
        location)
    else
      are_conformable = .true.
    end if
  end function are_conformable

  ! The n elements in array element order, a scalar n times. One function per type, as `select rank`
  ! is the only way from an assumed rank to an array of known rank.

  pure function flat_real(x, n) result(elements)
    real(real64), intent(in) :: x(..)
    integer, intent(in) :: n
    real(real64) :: elements(n)

    select rank (x)
    rank (0)
      elements = x
    rank (1)
      elements = x
    rank (2)
      elements = reshape(x, [n])
    end select
  end function flat_real

  pure function flat_integer(x, n) result(elements)
    integer, intent(in) :: x(..)
    integer, intent(in) :: n
    integer :: elements(n)

    select rank (x)
    rank (0)
      elements = x
    rank (1)
      elements = x
    rank (2)
      elements = reshape(x, [n])
    end select
  end function flat_integer

  pure function flat_logical(x, n) result(elements)
    logical, intent(in) :: x(..)
    integer, intent(in) :: n
    logical :: elements(n)

    select rank (x)
    rank (0)
      elements = x
    rank (1)
      elements = x
    rank (2)
      elements = reshape(x, [n])
    end select
  end function flat_logical

end module funit_equal
