!> One .pf file: its lines, its tests, and what is wrong with it.
module pf_check
  use pf_names, only: name_length, taken_names, find_declared
  use pf_text, only: bare, find_arguments, has_word, lower, matching_bracket, word
  implicit none(type, external)
  private

  public :: pf_file_t, line_length

  integer, parameter :: line_length = 1024
  !> A free-form line has 132 columns, of which pFUnit's `  call ` and `, &` for `@` and `)` take 8 more.
  integer, parameter :: longest_assertion = 132 - 8

  type :: text_t
    character(len=:), allocatable :: text
  end type text_t

  type :: test_t
    character(len=:), allocatable :: name
    logical :: is_disabled = .false.
  end type test_t

  type :: pf_file_t
    character(len=:), allocatable :: path
    character(len=:), allocatable :: base      !! file name without directory and suffix
    character(len=line_length), allocatable :: lines(:)
    type(test_t), allocatable :: tests(:)      !! in order of appearance
    character(len=:), allocatable :: before, after   !! empty if the file has none
    type(text_t), allocatable :: mistakes(:)
    character(len=name_length), allocatable :: taken(:)    !! public names of pFUnit's module funit, in lower case
  contains
    procedure :: read => read_lines
    procedure :: check
    procedure, private :: check_module, check_subroutine, check_directive, check_assertion, check_names, refuse
  end type pf_file_t

contains

  subroutine read_lines(this, path, names)
    class(pf_file_t), intent(inout) :: this
    character(len=*), intent(in) :: path
    character(len=*), intent(in) :: names    !! file of the names that pFUnit exports, one a line

    character(len=line_length) :: line
    integer :: unit, status, i, n

    this%path = path
    this%base = path(index(path, '/', back=.true.) + 1:)
    if (index(this%base, '.') > 1) this%base = this%base(:index(this%base, '.') - 1)
    allocate (this%tests(0), this%mistakes(0))
    this%before = ''
    this%after = ''
    call taken_names(names, this%taken)
    if (size(this%taken) == 0) call this%refuse(0, 'the names of pFUnit cannot be read from ' // names)

    open (newunit=unit, file=path, status='old', action='read', iostat=status)
    if (status /= 0) then
      call this%refuse(0, 'cannot be opened')
      return
    end if
    n = 0
    do
      read (unit, '(a)', iostat=status) line
      if (status /= 0) exit
      n = n + 1
    end do
    rewind (unit)
    allocate (this%lines(n))
    do i = 1, n
      read (unit, '(a)') this%lines(i)
    end do
    close (unit)
  end subroutine read_lines

  !> One pass over the lines: module, directives, the subroutines they announce, assertions.
  subroutine check(this)
    class(pf_file_t), intent(inout) :: this

    character(len=line_length) :: code
    character(len=name_length) :: module_name
    character(len=7) :: pending   !! directive whose subroutine has not come yet, or empty
    logical :: is_disabled, is_continued, has_test
    integer :: i

    if (size(this%mistakes) > 0) return
    module_name = ''
    pending = ''
    is_disabled = .false.
    is_continued = .false.
    has_test = .false.
    do i = 1, size(this%lines)
      code = adjustl(bare(this%lines(i)))
      if (code == '' .or. code(1:1) == '#') cycle
      if (code(1:1) == '@') then
        if (is_continued) call this%refuse(i, 'a directive cannot follow a line that ends in &')
        call this%check_directive(i, pending, is_disabled)
        has_test = has_test .or. pending == '@test'
      else
        if (scan(code, '@') > 0) call this%refuse(i, 'an assertion stands alone on its line, and so does ' // &
          'every directive: write if (...) then, @assert..., end if on three lines')
        if (word(code, 1) == 'use' .and. has_word(code, 'pfunit')) call this%refuse(i, &
          'write "use funit": the module pfunit exists in MPI builds only')
        if (word(code, 1) == 'module') call this%check_module(i, trim(code), module_name)
        if (pending /= '') call this%check_subroutine(i, trim(code), trim(pending), is_disabled)
        pending = ''
        is_disabled = .false.
      end if
      is_continued = code(max(1, len_trim(code)):len_trim(code)) == '&'
    end do
    if (pending /= '') call this%refuse(size(this%lines), 'no subroutine follows ' // trim(pending))
    if (module_name == '') call this%refuse(1, 'the file needs a module named ' // this%base)
    if (.not. has_test) call this%refuse(max(1, size(this%lines)), 'the file has no @test')
    call this%check_names()
  end subroutine check

  !> `use funit` brings all public names of pFUnit into the file. A name of the file, or of another module, that is one of them is
  !> ambiguous or is taken for pFUnit's.
  subroutine check_names(this)
    class(pf_file_t), intent(inout) :: this

    character(len=name_length), allocatable :: names(:)
    integer, allocatable :: lines(:)
    integer :: k

    call find_declared(this%lines, names, lines)
    do k = 1, size(names)
      if (names(k) == '*') call this%refuse(lines(k), 'write only: after the module, because every name that it exports is ' // &
        'imported, and pFUnit may export the same name')
      if (any(this%taken == names(k))) call this%refuse(lines(k), trim(names(k)) // &
        ' is a public name of pFUnit (module funit); give it another name')
    end do
  end subroutine check_names

  !> pFUnit finds the suite by the file name, the tests by the module name.
  subroutine check_module(this, i, code, module_name)
    class(pf_file_t), intent(inout) :: this
    integer, intent(in) :: i
    character(len=*), intent(in) :: code
    character(len=name_length), intent(inout) :: module_name   !! of the module seen so far, or blank

    if (any([character(len=10) :: 'procedure', 'subroutine', 'function'] == word(code, 2))) return
    if (module_name /= '') call this%refuse(i, 'a second module; one per file')
    module_name = word(code, 2)
    if (module_name /= lower(this%base)) call this%refuse(i, 'module ' // trim(module_name) // &
      ' must be named like its file, ' // this%base)
    if (adjustl(lower(this%lines(i))) /= 'module ' // module_name) call this%refuse(i, &
      'nothing but "module ' // trim(module_name) // '" may stand on this line, or pFUnit overlooks it')
  end subroutine check_module

  !> The statement after @test, @before or @after must be a plain `subroutine name()`.
  subroutine check_subroutine(this, i, code, pending, is_disabled)
    class(pf_file_t), intent(inout) :: this
    integer, intent(in) :: i
    character(len=*), intent(in) :: code, pending
    logical, intent(in) :: is_disabled

    type(test_t) :: test
    character(len=:), allocatable :: name
    character(len=len(code)) :: rest

    if (word(code, 1) /= 'subroutine') then
      if (has_word(code, 'subroutine')) then
        call this%refuse(i, 'no prefix (' // word(code, 1) // ') may stand before a subroutine after ' // pending)
      else
        call this%refuse(i, 'expected "subroutine name()" after ' // pending)
      end if
      return
    end if
    name = word(code, 2)
    rest = adjustl(code(len('subroutine') + 1:))
    rest = adjustl(rest(len(name) + 1:))
    if (scan(code, ';') > 0) then
      call this%refuse(i, 'a one-line subroutine after ' // pending // '; give each statement its line')
    else if (rest /= '' .and. .not. (rest(1:1) == '(' .and. adjustl(rest(2:)) == ')')) then
      call this%refuse(i, 'a subroutine after ' // pending // ' takes no arguments: subroutine ' // name // '()')
    end if

    select case (pending)
    case ('@before')
      if (this%before /= '') call this%refuse(i, 'a second @before; one per file')
      this%before = name
    case ('@after')
      if (this%after /= '') call this%refuse(i, 'a second @after; one per file')
      this%after = name
    case default
      test%name = name
      test%is_disabled = is_disabled
      this%tests = [this%tests, test]
    end select
  end subroutine check_subroutine

  subroutine check_directive(this, i, pending, is_disabled)
    class(pf_file_t), intent(inout) :: this
    integer, intent(in) :: i
    character(len=*), intent(inout) :: pending
    logical, intent(inout) :: is_disabled

    character(len=:), allocatable :: line, name

    line = trim(adjustl(this%lines(i)))
    name = '@' // word(lower(line(2:)), 1)
    select case (name)
    case ('@test', '@before', '@after')
      if (lower(line) /= name) call this%refuse(i, 'nothing may follow ' // name // ' on its line')
      if (pending /= '') call this%refuse(i, 'no subroutine follows the ' // trim(pending) // ' above')
      pending = name
    case ('@disable')
      if (lower(line) /= '@disable') call this%refuse(i, 'nothing may follow @disable on its line')
      if (pending /= '@test') call this%refuse(i, '@disable must stand between @test and its subroutine; ' // &
        'anywhere else pFUnit ignores it')
      is_disabled = .true.
    case ('@assertalltrue')
      call this%refuse(i, '@assertAllTrue does not exist; write @assertAll')
    case ('@fail')
      call this%refuse(i, '@fail does not exist in pFUnit; write @assertFail')
    case ('@suite')
      call this%refuse(i, '@suite breaks the registration of the tests; leave it out')
    case default
      if (pending /= '') call this%refuse(i, 'no subroutine follows the ' // trim(pending) // ' above')
      pending = ''
      call this%check_assertion(i, line, name)
    end select
  end subroutine check_directive

  !> `@assertXxx(expected, actual, message=...)`: known, whole, and with the arguments of the subset.
  subroutine check_assertion(this, i, line, name)
    class(pf_file_t), intent(inout) :: this
    integer, intent(in) :: i
    character(len=*), intent(in) :: line, name

    character(len=len(line)) :: code
    character(len=len(line)) :: rest
    integer, allocatable :: ends(:)
    integer :: n_operands, open, close, k
    logical :: has_message

    select case (name)
    case ('@assertequal', '@assertlessthan', '@assertlessthanorequal', '@assertgreaterthan')
      n_operands = 2
    case ('@asserttrue', '@assertfalse', '@assertall', '@assertisfinite', '@assertisnan', '@assertfail')
      n_operands = 1
    case default
      call this%refuse(i, 'unknown directive ' // line(:len(name)) // '; the subset is @test @disable @before ' // &
        '@after @assertEqual/True/False/LessThan/LessThanOrEqual/GreaterThan/All/IsFinite/IsNaN/Fail')
      return
    end select

    code = bare(line)
    open = len(name) + 1 + verify(code(len(name) + 1:) // '.', ' ') - 1
    close = 0
    if (code(min(open, len(code)):min(open, len(code))) == '(') close = matching_bracket(code, open)
    if (scan(code(len_trim(code):len_trim(code)), '&') > 0) then
      call this%refuse(i, 'an assertion is one line: no continuation (&)')
    else if (close > 0 .and. close < len(line) .and. code(close + 1:) == '') then
      call this%refuse(i, 'no comment may follow an assertion')
    else if (close /= len(line)) then
      call this%refuse(i, 'an assertion is one line that ends with its closing bracket')
    else if (len(line) > longest_assertion) then
      call this%refuse(i, 'an assertion longer than 124 characters: the call made of it passes column 132')
    end if
    if (close == 0) return

    call find_arguments(code(open + 1:close - 1), ends)
    if (size(ends) < n_operands) then
      call this%refuse(i, 'too few arguments')
      return
    end if
    has_message = name == '@assertfail'
    do k = n_operands + 1, size(ends)
      rest = adjustl(code(open + ends(k - 1) + 1:open + ends(k) - 1))
      if (word(rest, 1) == 'message') has_message = .true.
      if (is_keyword(rest, 'message')) cycle
      if (is_keyword(rest, 'tolerance') .and. name == '@assertequal') cycle
      call this%refuse(i, 'only message=, and tolerance= for @assertEqual, may follow the operands, by keyword')
    end do
    if (name == '@asserttrue' .and. .not. has_message) call this%refuse(i, &
      '@assertTrue needs message=, as true and false explain nothing')
  end subroutine check_assertion

  !> `name = value` and not `name == value`?
  pure logical function is_keyword(code, name)
    character(len=*), intent(in) :: code, name

    character(len=len(code)) :: rest

    is_keyword = .false.
    if (word(code, 1) /= name .or. index(code, name) /= 1) return
    rest = adjustl(code(len(name) + 1:))
    is_keyword = rest(1:1) == '=' .and. rest(2:2) /= '='
  end function is_keyword

  subroutine refuse(this, line, text)
    class(pf_file_t), intent(inout) :: this
    integer, intent(in) :: line    !! 0 for the file as a whole
    character(len=*), intent(in) :: text

    type(text_t) :: mistake
    character(len=12) :: digits

    write (digits, '(i0)') line
    mistake%text = this%path // ':' // trim(digits) // ': ' // text
    this%mistakes = [this%mistakes, mistake]
  end subroutine refuse

end module pf_check
