!> The little that pf2f90 knows of Fortran's syntax: strings, comments, brackets, words.
module pf_text
  implicit none(type, external)
  private

  public :: bare, lower, word, has_word, matching_bracket, find_arguments

contains

  !> The line in lower case with the inside of its strings blanked and its comment removed; positions
  !> are kept.
  pure function bare(line) result(code)
    character(len=*), intent(in) :: line
    character(len=len(line)) :: code

    character(len=1) :: quote
    integer :: i

    code = lower(line)
    quote = ' '
    do i = 1, len(line)
      if (quote /= ' ') then
        if (line(i:i) == quote) quote = ' '
        if (quote /= ' ') code(i:i) = ' '
      else if (line(i:i) == '!') then
        code(i:) = ''
        return
      else if (line(i:i) == '''' .or. line(i:i) == '"') then
        quote = line(i:i)
      end if
    end do
  end function bare

  pure function lower(text) result(folded)
    character(len=*), intent(in) :: text
    character(len=len(text)) :: folded

    integer :: i

    folded = text
    do i = 1, len(text)
      if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') folded(i:i) = achar(iachar(text(i:i)) + 32)
    end do
  end function lower

  !> The n-th word of letters, digits and underscores; empty if there are fewer.
  pure function word(text, n) result(found)
    character(len=*), intent(in) :: text
    integer, intent(in) :: n
    character(len=:), allocatable :: found

    character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz0123456789_'
    integer :: i, first, length

    found = ''
    first = 1
    do i = 1, n
      length = scan(text(first:), letters) - 1
      if (length < 0) return
      first = first + length
      length = verify(text(first:), letters) - 1
      if (length < 0) length = len(text) - first + 1
      if (i == n) found = text(first:first + length - 1)
      first = first + length
    end do
  end function word

  pure logical function has_word(text, wanted)
    character(len=*), intent(in) :: text, wanted

    integer :: n

    has_word = .true.
    do n = 1, len(text)
      if (word(text, n) == wanted) return
      if (word(text, n) == '') exit
    end do
    has_word = .false.
  end function has_word

  !> Position of the bracket that closes the one at `open`; 0 if none does. `code` has no strings.
  pure integer function matching_bracket(code, open) result(close)
    character(len=*), intent(in) :: code
    integer, intent(in) :: open

    integer :: depth

    depth = 0
    do close = open, len(code)
      if (index('([', code(close:close)) > 0) depth = depth + 1
      if (index(')]', code(close:close)) > 0) depth = depth - 1
      if (depth == 0) return
    end do
    close = 0
  end function matching_bracket

  !> Position after each top-level argument of `a, b(1, 2), c`: of its comma, or of the end.
  pure subroutine find_arguments(code, ends)
    character(len=*), intent(in) :: code
    integer, allocatable, intent(out) :: ends(:)

    integer :: depth, i

    allocate (ends(0))
    if (len_trim(code) == 0) return
    depth = 0
    do i = 1, len(code)
      if (index('([', code(i:i)) > 0) depth = depth + 1
      if (index(')]', code(i:i)) > 0) depth = depth - 1
      if (depth == 0 .and. code(i:i) == ',') ends = [ends, i]
    end do
    ends = [ends, len(code) + 1]
  end subroutine find_arguments

end module pf_text
