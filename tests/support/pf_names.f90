!> The names that a .pf file declares or imports, and the names that pFUnit's module funit exports.
module pf_names
  use pf_text, only: bare, lower, matching_bracket, word
  implicit none(type, external)
  private

  public :: name_length, taken_names, find_declared

  integer, parameter :: name_length = 63   ! Fortran's own limit

contains

  !> Reads a file of names, one a line; `#` begins a comment. No names if the file cannot be read.
  subroutine taken_names(path, names)
    character(len=*), intent(in) :: path
    character(len=name_length), allocatable, intent(out) :: names(:)

    character(len=200) :: line
    integer :: unit, status

    allocate (names(0))
    open (newunit=unit, file=path, status='old', action='read', iostat=status)
    if (status /= 0) return
    do
      read (unit, '(a)', iostat=status) line
      if (status /= 0) exit
      line = adjustl(line)
      if (line == '' .or. line(1:1) == '#') cycle
      names = [character(len=name_length) :: names, lower(trim(line))]
    end do
    close (unit)
  end subroutine taken_names

  !> Finds the names of procedures, and of variables, types and interfaces of the module, that the lines declare, and the names that
  !> they import from other modules than funit; each with the line on which its statement begins. A `use` without `only:` gives the
  !> name '*', because it may import any name. Components of types and variables of procedures are not listed: they hide the names
  !> of pFUnit, which is legal.
  subroutine find_declared(lines, names, at)
    character(len=*), intent(in) :: lines(:)
    character(len=name_length), allocatable, intent(out) :: names(:)   !! in lower case
    integer, allocatable, intent(out) :: at(:)

    character(len=:), allocatable :: statement, code
    logical :: is_in_type, has_contains
    integer :: i, first

    allocate (names(0), at(0))
    statement = ''
    is_in_type = .false.
    has_contains = .false.
    first = 1
    do i = 1, size(lines)
      code = trim(adjustl(bare(lines(i))))
      if (code == '') cycle
      if (index('#@', code(1:1)) > 0) cycle
      if (statement == '') first = i
      if (code(1:1) == '&') code = code(2:)
      if (code(len(code):) == '&') then
        statement = statement // code(:len(code) - 1)
        cycle
      end if
      call take_statement(trim(adjustl(statement // code)), first, is_in_type, has_contains, names, at)
      statement = ''
    end do
  end subroutine find_declared

  subroutine take_statement(code, line, is_in_type, has_contains, names, at)
    character(len=*), intent(in) :: code     !! one statement, bare
    integer, intent(in) :: line
    logical, intent(inout) :: is_in_type     !! between `type` and `end type`
    logical, intent(inout) :: has_contains   !! the procedures of the module have begun
    character(len=name_length), allocatable, intent(inout) :: names(:)
    integer, allocatable, intent(inout) :: at(:)

    character(len=:), allocatable :: head
    integer :: k

    head = word(code, 1)
    if (head == 'end' .or. index(head, 'end') == 1 .and. index(code, '=') == 0) then
      if (head == 'endtype' .or. word(code, 2) == 'type') is_in_type = .false.
      return
    end if
    k = double_colon(code)
    if (head == 'type' .and. index(adjustl(code(5:)) // ' ', '(') /= 1 .and. index(code, '=') == 0) then
      if (word(code, 2) == 'is' .and. scan(code, '(') > 0) return       ! of select type
      if (.not. has_contains) call add(word(code(max(k, 5):), 1))
      is_in_type = .true.
    else if (is_in_type) then
      return
    else if (code == 'contains') then
      has_contains = .true.
    else if (head == 'use') then
      k = index(code, 'only')
      if (k > 0) then
        if (word(code, 2) /= 'funit') call add_list(code(k + index(code(k:), ':'):))
      else if (all(word(code, 2) /= ['funit ', 'pfunit'])) then
        call add('*')
      end if
    else if (k > 0) then
      if (.not. has_contains .and. all(head /= [character(len=7) :: 'public', 'private', 'import'])) call add_list(code(k + 2:))
    else if (head == 'interface') then
      call add(word(code, 2))
    else
      call add_procedure(code)
    end if

  contains

    !> Adds the name of a procedure from its first statement; any prefixes may stand before.
    subroutine add_procedure(code)
      character(len=*), intent(in) :: code

      integer :: n

      if (scan(code, '=') > 0 .or. head == 'call') return
      do n = 1, 6
        select case (word(code, n))
        case ('subroutine', 'function')
          call add(word(code, n + 1))
          return
        case ('pure', 'elemental', 'impure', 'recursive', 'module', 'logical', 'integer', 'real', 'complex', 'character', 'type', &
              'class', 'wp', 'len', 'kind', 'result')
        case default
          if (n == 1) return
        end select
      end do
    end subroutine add_procedure

    !> Adds the first word of each item of `a, b(3), c = [1, 2], d => e`.
    subroutine add_list(list)
      character(len=*), intent(in) :: list

      integer :: depth, i, start

      depth = 0
      start = 1
      do i = 1, len(list)
        if (index('([', list(i:i)) > 0) depth = depth + 1
        if (index(')]', list(i:i)) > 0) depth = depth - 1
        if (depth > 0 .or. list(i:i) /= ',') cycle
        call add(word(list(start:i - 1), 1))
        start = i + 1
      end do
      call add(word(list(start:), 1))
    end subroutine add_list

    subroutine add(name)
      character(len=*), intent(in) :: name

      if (name == '') return
      names = [character(len=name_length) :: names, name]
      at = [at, line]
    end subroutine add

  end subroutine take_statement

  !> Position of the first `::` outside brackets; 0 if there is none.
  pure integer function double_colon(code) result(k)
    character(len=*), intent(in) :: code

    integer :: close

    k = 1
    do while (k < len(code))
      if (index('([', code(k:k)) > 0) then
        close = matching_bracket(code, k)
        if (close == 0) exit
        k = close
      else if (code(k:k + 1) == '::') then
        return
      end if
      k = k + 1
    end do
    k = 0
  end function double_colon

end module pf_names
