!> Settings from a file, as an optimiser or a driver writes it for each design: `run DECK --set-file params.in`.
!>
!> | line               | meaning                                                                             |
!> |--------------------|-------------------------------------------------------------------------------------|
!> | path = value       | as for --set, also *1.1 and +2                                                      |
!> | path value         | as for --set, with a blank instead of the = sign                                   |
!> | 105.5 path         | a number before its path                                                            |
!> | { path = value }   | APREPRO; the names that Dakota adds itself are ignored                              |
!> | 2 variables        | Dakota's parameters file: two lines `number path` follow, the rest belongs to Dakota |
!> | # comment          | ignored, also after a setting; empty lines are ignored too                          |
module ek_set_file
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: str, quoted, replace, lower, plural
   use ek_letters, only: with_line_ends, visible
   use ek_decimal, only: get_decimal
   use ek_file, only: read_whole, most_of_input
   use ek_deck, only: deck_t, set_value
   implicit none(type, external)
   private
   public :: set_file_t, read_set_file, apply_set_file, show_set_file, setting_count, get_setting

   !> One setting and its location in the file.
   type :: line_t
      character(:), allocatable :: path, value
      character(:), allocatable :: where           !! location of the line: 'params.in:3'
   end type line_t

   !> The settings of a file, in the order of the lines.
   type :: set_file_t
      private
      type(line_t), allocatable :: lines(:)
      integer :: used = 0
      type(message_list_t) :: mistakes             !! lines that are not settings
   end type set_file_t

   integer, parameter :: most_mistakes = 1000      !! largest number of reported mistakes
   character(*), parameter :: line_end = new_line('a'), blanks = ' '//achar(9)
   character(*), parameter :: of_dakota(4) = [character(7) :: 'dakota_', 'asv_', 'dvv_', 'ac_']

contains

   !> Reads a file of settings. The settings are not compared with a deck. Lines that are not settings are reported later, together
   !> with settings that do not match the deck.
   subroutine read_set_file(path, file, error)
      character(*), intent(in) :: path
      type(set_file_t), intent(out) :: file
      type(error_t), allocatable, intent(out) :: error     !! exit_file: the file cannot be read
      character(:), allocatable :: text, content
      integer :: first, last, line, left

      allocate (file%lines(16))
      call read_whole(path, text, error, may_stream=.true., most=most_of_input)
      if (allocated(error)) return
      text = with_line_ends(text)
      line = 0
      left = -1                                  ! lines of Dakota's variables still to come; −1: not its file
      first = 1
      do while (first <= len(text) .and. left /= 0 .and. file%mistakes%count() < most_mistakes)
         last = index(text(first:), line_end) + first - 2     ! no copy of the rest
         if (last == first - 2) last = len(text)
         line = line + 1
         content = bare(text(first:last))
         first = last + 2
         if (content == '') cycle
         if (left < 0 .and. file%used == 0) call read_head(content, left)
         if (left >= 0 .and. ends_with_variables(content)) cycle
         call take_line(content, path//':'//str(line), left > 0, file)
         left = max(left - 1, -1)
      end do
      if (left > 0) call file%mistakes%add(path//': '//plural(left, 'variable', 'variables')//' missing at the end of the file')
   end subroutine read_set_file

   !> A line without its comment and without blanks at both ends. Tabs become blanks. A # between quotes does not begin a comment.
   pure function bare(line) result(content)
      character(*), intent(in) :: line
      character(:), allocatable :: content
      logical :: is_quoted
      integer :: k

      content = line
      is_quoted = .false.
      do k = 1, len(content)
         if (scan(content(k:k), '''"') > 0) is_quoted = .not. is_quoted
         if (scan(content(k:k), blanks) > 0) content(k:k) = ' '
         if (content(k:k) /= '#' .or. is_quoted) cycle
         content = content(:k - 1)
         exit
      end do
      content = trim(adjustl(content))
   end function bare

   pure logical function ends_with_variables(content)
      character(*), intent(in) :: content
      integer :: at

      at = index(content, ' ', back=.true.)
      ends_with_variables = at > 1 .and. (content(at + 1:) == 'variables' .or. content(at + 1:) == 'variable')
   end function ends_with_variables

   !> Reads the number of variables if a line is the first line of Dakota's parameters file. `left` is unchanged for any other line.
   subroutine read_head(content, left)
      character(*), intent(in) :: content
      integer, intent(inout) :: left
      integer :: status, number

      if (.not. ends_with_variables(content)) return
      read (content(:index(content, ' ')), *, iostat=status) number
      if (status == 0 .and. number >= 0) left = number
   end subroutine read_head

   !> Reads one line as a setting. A line that is not a setting is added to the errors of the file; a value that Dakota adds itself
   !> is ignored.
   subroutine take_line(content, where, is_variable, file)
      character(*), intent(in) :: content, where
      logical, intent(in) :: is_variable           !! a line of Dakota: a number before its path
      type(set_file_t), intent(inout) :: file
      character(:), allocatable :: inner, path, value
      logical :: is_number
      real(wp) :: number
      integer :: mark, k

      inner = content
      if (content(1:1) == '{') then
         if (content(len(content):) /= '}' .or. index(content, '=') == 0) then
            call file%mistakes%add(where//': expected { path = value }, found '//quoted(content))
            return
         end if
         inner = trim(adjustl(content(2:len(content) - 1)))
         if (any([(index(lower(inner), trim(of_dakota(k))) == 1, k=1, size(of_dakota))])) return
      end if
      mark = index(inner, '=')
      is_number = .false.
      if (mark == 0) then
         mark = index(inner//' ', ' ')
         call get_decimal(inner(:mark - 1), number, is_number)
      end if
      path = trim(adjustl(inner(:mark - 1)))
      value = trim(adjustl(inner(min(mark, len(inner)) + 1:)))
      if (is_number) then
         inner = path
         path = value
         value = inner
      end if
      if (path == '' .or. value == '' .or. (is_variable .and. .not. is_number)) then
         call file%mistakes%add(where//': expected '//trim(merge('number path ', 'path = value', is_variable))// &
            ', as in spring.coil.rate = 30, found '//quoted(content))
         return
      end if
      if (file%used == size(file%lines)) file%lines = [file%lines, file%lines]
      file%used = file%used + 1
      file%lines(file%used)%path = path
      file%lines(file%used)%value = value
      file%lines(file%used)%where = where
   end subroutine take_line

   !> Applies all settings of a file to a deck. Each error is reported with its line.
   subroutine apply_set_file(file, deck, error)
      type(set_file_t), intent(in) :: file
      type(deck_t), intent(inout) :: deck
      type(error_t), allocatable, intent(out) :: error     !! exit_deck
      type(error_t), allocatable :: mistake
      type(message_list_t) :: mistakes
      integer :: k

      mistakes = file%mistakes
      do k = 1, file%used
         call set_value(deck, file%lines(k)%path, file%lines(k)%value, mistake)
         if (.not. allocated(mistake)) cycle
         call show_set_file(file, mistake%message)
         call mistakes%add(mistake%message)
         if (deck%deck_errors%count() > 0) exit            ! the message contains those of the deck
         if (mistakes%count() >= most_mistakes) exit
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, visible(mistakes%text()))
   end subroutine apply_set_file

   !> The number of settings of a file.
   pure integer function setting_count(file)
      type(set_file_t), intent(in) :: file
      setting_count = file%used
   end function setting_count

   !> Returns setting k of a file with its location.
   pure subroutine get_setting(file, k, path, value, where)
      type(set_file_t), intent(in) :: file
      integer, intent(in) :: k
      character(:), allocatable, intent(out) :: path, value
      character(:), allocatable, intent(out) :: where        !! 'params.in:3'

      path = file%lines(k)%path
      value = file%lines(k)%value
      where = file%lines(k)%where
   end subroutine get_setting

   !> Replaces '--set' in a message about settings by the file and line: 'params.in:3: path=value' instead of '--set path=value'.
   subroutine show_set_file(file, message)
      type(set_file_t), intent(in) :: file
      character(:), allocatable, intent(inout) :: message
      integer :: k

      do k = 1, file%used
         associate (line => file%lines(k))
            call replace(message, '--set '//line%path//'='//line%value, line%where//': '//line%path//'='//line%value)
            ! a message shows invisible characters by their numbers
            call replace(message, '--set '//visible(line%path//'='//line%value), line%where//': '// &
               visible(line%path//'='//line%value))
         end associate
      end do
   end subroutine show_set_file

end module ek_set_file
