!> Reads JSON (RFC 8259) as a list of its numbers and strings, each with its path and its line: 'Spring/Free Length', 0.339.
!> The elements of a list have their position in the path: 'Spindle/COM/1'. Comments (// and /* */) are skipped, because
!> programs that read JSON for vehicles accept them.
module ek_json_tree
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_decimal, only: get_decimal
   use ek_flaws, only: flaws_t, shown
   implicit none(type, external)
   private
   public :: json_tree_t, json_leaf_t, parse_json, find_leaf, has_branch, branch_line, triple_at

   integer, parameter :: deepest = 20, most_leaves = 20000, most_keys = 2000, longest_path = 120

   !> A number, a string, or true, false and null as text.
   type :: json_leaf_t
      character(longest_path) :: path = ''
      character(:), allocatable :: text        !! the string, or the number as written
      logical :: is_number = .false.
      real(wp) :: value = 0.0_wp
      integer :: line = 0
   end type json_leaf_t

   type :: json_tree_t
      integer :: used = 0
      type(json_leaf_t), allocatable :: leaves(:)
   end type json_tree_t

   !> The position in the text.
   type :: reader_t
      character(:), allocatable :: text
      integer :: at = 1, line = 1
   end type reader_t

contains

   !> Reads a text. At the first error the reading ends.
   subroutine parse_json(text, tree, flaws)
      character(*), intent(in) :: text
      type(json_tree_t), intent(out) :: tree
      type(flaws_t), intent(inout) :: flaws
      type(reader_t) :: reader

      allocate (tree%leaves(64))
      reader%text = text
      call read_value(reader, '', 0, tree, flaws)
      if (flaws%count() > 0) return
      call skip_blanks(reader)
      if (reader%at <= len(reader%text)) call flaws%add(reader%line, 'expected the end of the file, found '// &
         shown(reader%text(reader%at:min(reader%at + 19, len(reader%text)))))
   end subroutine parse_json

   !> The index of a leaf; 0 if there is none. Letter case matters.
   pure integer function find_leaf(tree, path) result(found)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path

      do found = 1, tree%used
         if (tree%leaves(found)%path == path) return
      end do
      found = 0
   end function find_leaf

   !> Whether an object or a list has a leaf.
   pure logical function has_branch(tree, path)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      integer :: k

      has_branch = any([(index(tree%leaves(k)%path, path//'/') == 1, k=1, tree%used)])
   end function has_branch

   !> The line of the first value of an object or a list; 0 if it has none.
   pure integer function branch_line(tree, path) result(line)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      integer :: k

      line = 0
      do k = 1, tree%used
         if (index(tree%leaves(k)%path, path) /= 1) cycle
         line = tree%leaves(k)%line
         return
      end do
   end function branch_line

   !> Finds whether leaves k, k + 1, k + 2 are the three numbers of a list, 'name/1' to 'name/3'. `path` is then the name.
   pure subroutine triple_at(tree, k, path, at, is_triple)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: k
      character(:), allocatable, intent(out) :: path
      real(wp), intent(out) :: at(3)
      logical, intent(out) :: is_triple
      integer :: j

      path = trim(tree%leaves(k)%path)
      at = 0.0_wp
      is_triple = .false.
      if (k + 2 > tree%used .or. len(path) < 3) return
      if (path(len(path) - 1:) /= '/1') return
      path = path(:len(path) - 2)
      do j = 1, 3
         if (tree%leaves(k + j - 1)%path /= path//'/'//str(j) .or. .not. tree%leaves(k + j - 1)%is_number) return
         at(j) = tree%leaves(k + j - 1)%value
      end do
      is_triple = .true.
      if (k + 3 <= tree%used) is_triple = tree%leaves(k + 3)%path /= path//'/4'
   end subroutine triple_at

   recursive subroutine read_value(reader, path, depth, tree, flaws)
      type(reader_t), intent(inout) :: reader
      character(*), intent(in) :: path
      integer, intent(in) :: depth
      type(json_tree_t), intent(inout) :: tree
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: text

      if (depth > deepest) then
         call flaws%add(reader%line, 'expected at most '//str(deepest)//' objects and lists in each other, found more')
         return
      end if
      call skip_blanks(reader)
      select case (next(reader))
      case ('{')
         call read_items(reader, path, depth, '}', tree, flaws)
      case ('[')
         call read_items(reader, path, depth, ']', tree, flaws)
      case ('"')
         call read_string(reader, text, flaws)
         if (flaws%count() == 0) call add_leaf(reader, path, text, .false., tree, flaws)
      case default
         call read_word(reader, text)
         if (text == '') then
            call flaws%add(reader%line, 'expected a value, found '//found_text(reader))
         else
            call add_leaf(reader, path, text, .true., tree, flaws)
         end if
      end select
   end subroutine read_value

   !> Reads the items of an object or a list.
   recursive subroutine read_items(reader, path, depth, bracket, tree, flaws)
      type(reader_t), intent(inout) :: reader
      character(*), intent(in) :: path
      integer, intent(in) :: depth
      character, intent(in) :: bracket
      type(json_tree_t), intent(inout) :: tree
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: key, below
      type(message_list_t) :: keys
      integer :: count, begin

      begin = reader%line
      reader%at = reader%at + 1
      below = ''
      if (path /= '') below = path//'/'
      count = 0
      do
         call skip_blanks(reader)
         if (next(reader) == bracket .and. count == 0) exit
         count = count + 1
         key = str(count)
         if (bracket == '}') then
            if (next(reader) /= '"') then
               call flaws%add(reader%line, 'expected a name in double quotes, found '//found_text(reader))
               return
            end if
            call read_string(reader, key, flaws)
            if (flaws%count() > 0) return
            call skip_blanks(reader)
            if (next(reader) /= ':') then
               call flaws%add(reader%line, 'expected : after '//shown(key)//', found '//found_text(reader))
               return
            end if
            reader%at = reader%at + 1
            if (is_known(keys, key)) then
               call flaws%add(reader%line, shown(below//key)//' is given twice')
               return
            end if
            if (keys%count() == most_keys) then
               call flaws%add(reader%line, 'expected at most '//str(most_keys)//' names in an object, found more')
               return
            end if
            call keys%add(key)
         end if
         if (len(below) + len(key) > longest_path) then
            call flaws%add(reader%line, 'expected a shorter name, found '//shown(key))
            return
         end if
         call read_value(reader, below//key, depth + 1, tree, flaws)
         if (flaws%count() > 0) return
         call skip_blanks(reader)
         if (next(reader) == bracket) exit
         if (next(reader) /= ',') then
            call flaws%add(reader%line, 'expected , or '//bracket//' (begun in line '//str(begin)//'), found '//found_text(reader))
            return
         end if
         reader%at = reader%at + 1
      end do
      reader%at = reader%at + 1
   end subroutine read_items

   !> Whether a list has a key.
   pure logical function is_known(keys, key)
      type(message_list_t), intent(in) :: keys
      character(*), intent(in) :: key
      integer :: k

      is_known = .true.
      do k = 1, keys%count()
         if (keys%line(k) == key) return
      end do
      is_known = .false.
   end function is_known

   !> Reads a string in double quotes.
   subroutine read_string(reader, text, flaws)
      type(reader_t), intent(inout) :: reader
      character(:), allocatable, intent(out) :: text
      type(flaws_t), intent(inout) :: flaws
      integer :: first, at

      first = reader%at + 1
      at = first
      do while (at <= len(reader%text))
         if (reader%text(at:at) == '"' .or. reader%text(at:at) == new_line('a')) exit
         at = at + merge(2, 1, reader%text(at:at) == '\')
      end do
      text = ''
      if (at > len(reader%text)) then
         call flaws%add(reader%line, 'expected a closing double quote, found the end of the file')
      else if (reader%text(at:at) /= '"') then
         call flaws%add(reader%line, 'expected a closing double quote, found the end of the line')
      else
         text = reader%text(first:at - 1)
      end if
      reader%at = at + 1
   end subroutine read_string

   !> Reads a number, true, false or null.
   subroutine read_word(reader, text)
      type(reader_t), intent(inout) :: reader
      character(:), allocatable, intent(out) :: text
      integer :: length

      length = verify(reader%text(min(reader%at, len(reader%text) + 1):), &
         'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-._') - 1
      if (length < 0) length = len(reader%text) - reader%at + 1
      text = reader%text(reader%at:reader%at + length - 1)
      reader%at = reader%at + length
   end subroutine read_word

   !> Adds a leaf. Text that is no number is an error.
   subroutine add_leaf(reader, path, text, is_word, tree, flaws)
      type(reader_t), intent(in) :: reader
      character(*), intent(in) :: path, text
      logical, intent(in) :: is_word
      type(json_tree_t), intent(inout) :: tree
      type(flaws_t), intent(inout) :: flaws
      type(json_leaf_t) :: leaf

      leaf%path = path
      leaf%text = text
      leaf%line = reader%line
      if (is_word .and. .not. any([character(5) :: 'true', 'false', 'null'] == text)) then
         call get_decimal(text, leaf%value, leaf%is_number)
         if (leaf%is_number) leaf%is_number = abs(leaf%value) < 1.0e25_wp
         if (.not. leaf%is_number) then
            call flaws%add(reader%line, 'expected a finite number for '//shown(path)//', found '//shown(text))
            return
         end if
      end if
      if (tree%used == most_leaves) then
         call flaws%add(reader%line, 'expected at most '//str(most_leaves)//' values, found more')
         return
      end if
      if (tree%used == size(tree%leaves)) tree%leaves = [tree%leaves, tree%leaves]      ! twice the size
      tree%used = tree%used + 1
      tree%leaves(tree%used) = leaf
   end subroutine add_leaf

   !> Skips blanks, line ends and comments.
   pure subroutine skip_blanks(reader)
      type(reader_t), intent(inout) :: reader
      integer :: length

      do while (reader%at <= len(reader%text))
         select case (reader%text(reader%at:reader%at))
         case (new_line('a'))
            reader%line = reader%line + 1
         case (' ', achar(9), achar(13))
            continue
         case ('/')
            if (reader%at == len(reader%text)) return
            if (reader%text(reader%at + 1:reader%at + 1) == '/') then
               length = index(reader%text(reader%at:), new_line('a'))
               if (length == 0) length = len(reader%text) - reader%at + 3
               reader%at = reader%at + length - 2
            else if (reader%text(reader%at + 1:reader%at + 1) == '*') then
               length = index(reader%text(reader%at + 2:), '*/')
               if (length == 0) return
               reader%line = reader%line + count_lines(reader%text(reader%at:reader%at + length))
               reader%at = reader%at + length + 2
            else
               return
            end if
         case default
            return
         end select
         reader%at = reader%at + 1
      end do
   end subroutine skip_blanks

   pure integer function count_lines(text) result(lines)
      character(*), intent(in) :: text
      integer :: k
      lines = count([(text(k:k) == new_line('a'), k=1, len(text))])
   end function count_lines

   !> The next character; a blank at the end of the text.
   pure character function next(reader)
      type(reader_t), intent(in) :: reader

      next = ' '
      if (reader%at <= len(reader%text)) next = reader%text(reader%at:reader%at)
   end function next

   !> What is at the present position, for a message.
   pure function found_text(reader) result(words)
      type(reader_t), intent(in) :: reader
      character(:), allocatable :: words
      integer :: last

      if (reader%at > len(reader%text)) then
         words = 'the end of the file'
         return
      end if
      last = index(reader%text(reader%at:), new_line('a'))
      last = merge(len(reader%text), reader%at + last - 2, last == 0)
      words = shown(reader%text(reader%at:min(last, reader%at + 19)))
   end function found_text

end module ek_json_tree
