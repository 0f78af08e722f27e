!> The [HARDPOINT] blocks of a subsystem or an assembly of Adams/Car: rows `name symmetry x y z` below {headings}, or entries
!> HARDPOINT_NAME, SYMMETRY, X_VALUE, Y_VALUE, Z_VALUE.
module ek_hardpoint_blocks
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: take_number
   use ek_unit_word, only: length_unit
   use ek_teimorbit, only: teimorbit_t, find_block, entry_of, units_in, check_units, row_item, heads_item
   use ek_hardpoint, only: hardpoints_t, single_point, add_hardpoint, take_symmetry
   implicit none(type, external)
   private
   public :: take_blocks

contains

   !> Reads all [HARDPOINT] blocks.
   subroutine take_blocks(file, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: units(5)
      integer :: block, order(5)

      call units_in(file, units, flaws)
      call check_units(file, units, [length_unit], flaws)
      block = find_block(file, 'hardpoint')
      if (block == 0) then
         call flaws%add(0, 'expected a block [HARDPOINT], found none'//advice(file))
         return
      end if
      do while (block > 0)
         order = [1, 2, 3, 4, 5]
         if (entry_of(file, block, 'hardpoint_name') > 0) then
            call take_entries(file, block, units(length_unit), sheet, flaws)
         else
            call take_rows(file, block, units(length_unit), order, sheet, flaws)
         end if
         block = find_block(file, 'hardpoint', after=block)
      end do
   end subroutine take_blocks

   !> Advice for a file without hardpoints: the subsystems that an assembly names, whose files contain the hardpoints; otherwise ''.
   function advice(file) result(words)
      type(teimorbit_t), intent(in) :: file
      character(:), allocatable :: words
      integer :: block, item

      words = ''
      block = find_block(file, 'subsystem')
      do while (block > 0 .and. len(words) < 300)
         item = entry_of(file, block, 'usage')
         if (item > 0) then
            if (file%items(item)%used > 0) words = words//' '//shown(file%items(item)%fields(1)%text)
         end if
         block = find_block(file, 'subsystem', after=block)
      end do
      if (words /= '') words = '; read its subsystems instead:'//words
   end function advice

   !> Reads the rows of one block.
   subroutine take_rows(file, block, unit, order, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block
      real(wp), intent(in) :: unit
      integer, intent(inout) :: order(5)           !! columns of name, symmetry, x, y, z
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: names(5) = [character(14) :: 'hardpoint_name', 'symmetry', 'x_value', 'y_value', 'z_value']
      real(wp) :: at(3)
      integer :: k, j, c, symmetry
      logical :: is_good(3)

      do k = 1, file%used
         associate (item => file%items(k))
            if (item%block /= block) cycle
            if (item%kind == heads_item) then
               order = 0
               do j = 1, item%used
                  c = findloc(names == lower(item%fields(j)%text), .true., dim=1)
                  if (c > 0) order(c) = j
               end do
               do c = 1, size(names)
                  if (order(c) == 0) call flaws%add(item%line, 'expected a column '//trim(names(c))//', found none')
               end do
               if (any(order == 0)) return
            else if (item%kind == row_item) then
               if (item%used < maxval(order)) then
                  call flaws%add(item%line, 'expected '//str(maxval(order))//' values (name, symmetry, x, y, z), found '// &
                     str(item%used))
                  cycle
               end if
               call take_symmetry(item%fields(order(2))%text, item%line, symmetry, flaws)
               do j = 1, 3
                  call take_number(item%fields(order(j + 2))%text, item%line, 'xyz'(j:j)//' of '// &
                     shown(item%fields(order(1))%text), at(j), flaws, is_good(j))
               end do
               if (all(is_good) .and. symmetry >= 0) &
                  call add_hardpoint(sheet, item%fields(order(1))%text, at*unit, symmetry, item%line, flaws)
            else
               call flaws%add(item%line, 'expected rows of hardpoints, found '//shown(trim(item%key)//' ='))
            end if
         end associate
      end do
   end subroutine take_rows

   !> Reads a block with one hardpoint as entries.
   subroutine take_entries(file, block, unit, sheet, flaws)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block
      real(wp), intent(in) :: unit
      type(hardpoints_t), intent(inout) :: sheet
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: names(3) = ['x_value', 'y_value', 'z_value']
      character(:), allocatable :: name
      real(wp) :: at(3)
      integer :: j, item, line, symmetry
      logical :: is_good(3)

      item = entry_of(file, block, 'hardpoint_name')
      line = file%items(item)%line
      name = ''
      if (file%items(item)%used > 0) name = file%items(item)%fields(1)%text
      symmetry = single_point
      item = entry_of(file, block, 'symmetry')
      if (item > 0) then
         if (file%items(item)%used > 0) call take_symmetry(file%items(item)%fields(1)%text, file%items(item)%line, symmetry, flaws)
      end if
      do j = 1, 3
         item = entry_of(file, block, names(j))
         is_good(j) = item > 0
         if (is_good(j)) is_good(j) = file%items(item)%used > 0
         if (.not. is_good(j)) then
            call flaws%add(line, 'expected '//names(j)//' of '//shown(name)//', found none')
         else
            call take_number(file%items(item)%fields(1)%text, file%items(item)%line, names(j), at(j), flaws, is_good(j))
         end if
      end do
      if (all(is_good) .and. symmetry >= 0) call add_hardpoint(sheet, name, at*unit, symmetry, line, flaws)
   end subroutine take_entries

end module ek_hardpoint_blocks
