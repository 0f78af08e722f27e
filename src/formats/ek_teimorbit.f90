!> A file in the TeimOrbit format of Adams/Car: blocks, each with entries and rows of a table.
!>
!>     [BLOCK]                         a block, whose name may occur again
!>     KEY = value                     an entry; a string is in quotes
!>     (PART)                          a part of the block, with entries and rows of its own
!>     {first second third}            the column headings of the rows that follow
!>     value value value               a row
!>     $ text                          a comment, also after values; also ! at the beginning of a line
!>
!> Case does not matter in names of blocks, keys and headings.
module ek_teimorbit
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, split_lines, field_t, split_fields
   use ek_unit_word, only: unit_of, quantity_names, length_unit, force_unit, angle_unit
   implicit none(type, external)
   private
   public :: teimorbit_t, parse_teimorbit, find_block, entry_of, is_teimorbit, units_in, check_units, &
      entry_item, row_item, heads_item

   integer, parameter :: name_length = 40
   integer, parameter :: entry_item = 1, row_item = 2, heads_item = 3     !! kinds of an item

   !> An entry, a row or the headings of a block.
   type :: item_t
      integer :: kind = 0
      integer :: block = 0                  !! index of the block
      integer :: line = 0
      character(name_length) :: key = ''    !! key of an entry, in lower case
      integer :: used = 0
      type(field_t), allocatable :: fields(:)   !! values of a row or of an entry; headings
   end type item_t

   !> A file as blocks and items. A part of a block is stored as a separate block with the name of the block.
   type :: teimorbit_t
      integer :: blocks = 0
      character(name_length), allocatable :: names(:)     !! names of the blocks in lower case
      integer, allocatable :: block_lines(:)
      integer :: used = 0
      type(item_t), allocatable :: items(:)
   end type teimorbit_t

   character, parameter :: tab = achar(9)

contains

   !> Whether a string probably has this format: its first line that is neither a comment nor empty begins a block.
   pure logical function is_teimorbit(text)
      character(*), intent(in) :: text
      integer :: at, next

      is_teimorbit = .false.
      at = 1
      do while (at <= len(text))
         next = scan(text(at:), achar(10)//achar(13))
         if (next == 0) next = len(text) - at + 2
         associate (line => text(at:at + next - 2))
            if (verify(line, ' '//tab) > 0) then
               is_teimorbit = index(bare(line), '[') == 1
               if (scan(bare(line), '$!') /= 1) return
            end if
         end associate
         at = at + next
      end do
   end function is_teimorbit

   !> Splits the content of a file into blocks, and the blocks into items. The readers of the kinds of file check the values.
   subroutine parse_teimorbit(lines, file, flaws)
      type(lines_t), intent(in) :: lines
      type(teimorbit_t), intent(out) :: file
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: text
      type(field_t) :: fields(64)
      integer :: k, ending, mark, used
      logical :: is_lost

      allocate (file%names(16), file%block_lines(16), file%items(32))
      is_lost = .false.
      do k = 1, lines%count
         text = without_comment(lines%line(k))
         if (len(text) == 0) cycle
         select case (text(1:1))
         case ('[', '(')
            ending = index(text, merge(']', ')', text(1:1) == '['))
            if (ending == 0) then
               call flaws%add(k, 'expected a closing '//merge(']', ')', text(1:1) == '[')//', found '//shown(text))
               ending = len(text) + 1
            end if
            if (text(1:1) == '[') then
               call begin_block(file, lower(bare(text(2:ending - 1))), k)
            else if (file%blocks > 0) then
               call begin_block(file, trim(file%names(file%blocks)), k)
            end if
         case ('{')
            if (file%blocks == 0) cycle
            ending = index(text, '}')
            if (ending == 0) then
               call flaws%add(k, 'expected a closing }, found '//shown(text))
               ending = len(text) + 1
            end if
            call split_fields(text(2:ending - 1), k, fields, used, flaws)
            call add_item(file, heads_item, k, '', fields, used)
         case default
            if (file%blocks == 0) then
               if (.not. is_lost) call flaws%add(k, 'expected a [BLOCK], found '//shown(text))
               is_lost = .true.
               cycle
            end if
            mark = index(text, '=')
            if (scan(text(:max(mark, 1)), '''"') > 0) mark = 0      ! the sign is in a text
            if (mark > 0) then
               call split_fields(text(mark + 1:), k, fields, used, flaws)
               call add_item(file, entry_item, k, lower(bare(text(:mark - 1))), fields, used)
            else
               call split_fields(text, k, fields, used, flaws)
               call add_item(file, row_item, k, '', fields, used)
            end if
         end select
      end do
      if (file%blocks == 0 .and. .not. is_lost) call flaws%add(0, 'expected blocks as [UNITS], found none')
   end subroutine parse_teimorbit

   !> A string without surrounding blanks and tabs.
   pure function bare(string) result(text)
      character(*), intent(in) :: string
      character(:), allocatable :: text
      text = string(max(1, verify(string, ' '//tab)):verify(string, ' '//tab, back=.true.))
   end function bare

   !> A line without its comment and surrounding blanks.
   pure function without_comment(line) result(text)
      character(*), intent(in) :: line
      character(:), allocatable :: text
      character :: quote
      integer :: k, first, last

      first = verify(line, ' '//tab)
      text = ''
      if (first == 0) return
      if (scan(line(first:first), '$!') == 1) return
      quote = ' '
      last = len(line)
      do k = first, len(line)
         if (quote /= ' ') then
            if (line(k:k) == quote) quote = ' '
         else if (line(k:k) == '$') then
            last = k - 1
            exit
         else if (index('''"', line(k:k)) > 0) then
            if (index(line(k + 1:), line(k:k)) > 0) quote = line(k:k)
         end if
      end do
      text = bare(line(first:last))
   end function without_comment

   subroutine begin_block(file, name, line)
      type(teimorbit_t), intent(inout) :: file
      character(*), intent(in) :: name
      integer, intent(in) :: line

      if (file%blocks == size(file%names)) then
         file%names = [file%names, file%names]      ! twice the size
         file%block_lines = [file%block_lines, file%block_lines]
      end if
      file%blocks = file%blocks + 1
      file%names(file%blocks) = name
      file%block_lines(file%blocks) = line
   end subroutine begin_block

   subroutine add_item(file, kind, line, key, fields, used)
      type(teimorbit_t), intent(inout) :: file
      integer, intent(in) :: kind, line, used
      character(*), intent(in) :: key
      type(field_t), intent(in) :: fields(:)
      integer :: k

      if (file%used == size(file%items)) file%items = [file%items, file%items]      ! twice the size
      file%used = file%used + 1
      associate (item => file%items(file%used))
         item%kind = kind
         item%block = file%blocks
         item%line = line
         item%key = key
         item%used = used
         if (allocated(item%fields)) deallocate (item%fields)
         allocate (item%fields(used))
         do k = 1, used
            item%fields(k)%text = fields(k)%text
            item%fields(k)%is_quoted = fields(k)%is_quoted
         end do
      end associate
   end subroutine add_item

   !> Index of the first block with a name after block `after`; 0 if there is none.
   pure integer function find_block(file, name, after)
      type(teimorbit_t), intent(in) :: file
      character(*), intent(in) :: name                !! lower case
      integer, intent(in), optional :: after
      integer :: first

      first = 1
      if (present(after)) first = after + 1
      do find_block = first, file%blocks
         if (file%names(find_block) == name) return
      end do
      find_block = 0
   end function find_block

   !> Index of the item of an entry in a block; 0 if the block has no entry with this key.
   pure integer function entry_of(file, block, key)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block
      character(*), intent(in) :: key                 !! lower case

      do entry_of = 1, file%used
         if (file%items(entry_of)%block == block .and. file%items(entry_of)%kind == entry_item .and. &
            file%items(entry_of)%key == key) return
      end do
      entry_of = 0
   end function entry_of

   !> Reads the SI values of the units of the file, in the order of ek_unit_word. The value is 0 for a unit that the file does not
   !> name. An unknown unit is reported, and its value is then 1.
   subroutine units_in(file, units, flaws)
      type(teimorbit_t), intent(in) :: file
      real(wp), intent(out) :: units(size(quantity_names))
      type(flaws_t), intent(inout) :: flaws
      integer :: block, item, k

      units = 0.0_wp
      block = find_block(file, 'units')
      if (block == 0) return
      do k = 1, size(quantity_names)
         item = entry_of(file, block, lower(trim(quantity_names(k))))
         if (item == 0) cycle
         if (file%items(item)%used == 0) then
            call flaws%add(file%items(item)%line, 'expected a unit for '//trim(quantity_names(k))//', found nothing')
            units(k) = 1.0_wp
            cycle
         end if
         units(k) = unit_of(k, file%items(item)%fields(1)%text)
         if (units(k) > 0.0_wp) cycle
         call flaws%add(file%items(item)%line, 'expected a unit for '//trim(quantity_names(k))//trim(examples(k))//', found '// &
            shown(file%items(item)%fields(1)%text))
         units(k) = 1.0_wp      ! this mistake is reported once
      end do

   contains

      pure function examples(quantity) result(words)
         integer, intent(in) :: quantity
         character(60) :: words

         select case (quantity)
         case (length_unit)
            words = ' (mm, cm, meter, inch, foot)'
         case (force_unit)
            words = ' (newton, kilonewton, pound_force, kg_force)'
         case (angle_unit)
            words = ' (degrees, radians)'
         case default
            words = ''
         end select
      end function examples

   end subroutine units_in

   !> Reports the units that a reader needs but the file does not name.
   subroutine check_units(file, units, needed, flaws)
      type(teimorbit_t), intent(in) :: file
      real(wp), intent(inout) :: units(:)         !! a value of 0 becomes 1
      integer, intent(in) :: needed(:)            !! quantities of ek_unit_word
      type(flaws_t), intent(inout) :: flaws
      integer :: block, k

      block = find_block(file, 'units')
      if (block == 0) call flaws%add(0, 'expected a block [UNITS], found none (the numbers have no unit without it)')
      do k = 1, size(needed)
         if (units(needed(k)) > 0.0_wp) cycle
         units(needed(k)) = 1.0_wp
         if (block > 0) call flaws%add(file%block_lines(block), 'expected '//trim(quantity_names(needed(k)))// &
            ' in [UNITS], found none')
      end do
   end subroutine check_units

end module ek_teimorbit
