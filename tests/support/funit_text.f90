!> Values, indices and counts as they stand in a failure message.
module funit_text
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none(type, external)
  private

  public :: to_text, index_text, where_text

  interface to_text
    procedure text_of_real, text_of_integer, text_of_logical
  end interface to_text

contains

  pure function text_of_real(x) result(text)
    real(real64), intent(in) :: x
    character(len=:), allocatable :: text

    character(len=40) :: buffer

    write (buffer, '(g26.17e3)') x       ! not g0, whose digits are the compiler's choice
    text = trim(adjustl(buffer))
    if (index(text, 'Inf') > 0) text = text(:index(text, 'Inf') + 2)      ! or 'Infinity', likewise
  end function text_of_real

  pure function text_of_integer(x) result(text)
    integer, intent(in) :: x
    character(len=:), allocatable :: text

    character(len=12) :: buffer

    write (buffer, '(i0)') x
    text = trim(adjustl(buffer))
  end function text_of_integer

  pure function text_of_logical(x) result(text)
    logical, intent(in) :: x
    character(len=:), allocatable :: text

    character(len=1) :: buffer

    write (buffer, '(l1)') x
    text = trim(adjustl(buffer))
  end function text_of_logical

  !> `, worst of 3 at (2,1)`: the element shown and how many are wrong; empty for a scalar.
  pure function where_text(which, position, extents, is_wrong) result(text)
    character(len=*), intent(in) :: which
    integer, intent(in) :: position     !! in array element order
    integer, intent(in) :: extents(:)
    logical, intent(in) :: is_wrong(:)
    character(len=:), allocatable :: text

    integer :: first

    text = ''
    if (size(extents) == 0) return
    text = ', ' // which // ' of ' // to_text(count(is_wrong)) // ' at '
    if (size(extents) == 1) text = text // index_text([position])
    if (size(extents) == 2) then
      first = modulo(position - 1, extents(1)) + 1
      text = text // index_text([first, (position - 1)/extents(1) + 1])
    end if
  end function where_text

  pure function index_text(indices) result(text)
    integer, intent(in) :: indices(:)
    character(len=:), allocatable :: text

    integer :: i

    text = '('
    do i = 1, size(indices)
      if (i > 1) text = text // ','
      text = text // to_text(indices(i))
    end do
    text = text // ')'
  end function index_text

end module funit_text
