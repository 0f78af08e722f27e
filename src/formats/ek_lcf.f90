!> A load case file of Adams/Car (.lcf): rows of 19 numbers, as a table of loads for `test = 'table'`.
!>
!> | columns | meaning                                   | columns of the table                     |
!> |---------|-------------------------------------------|------------------------------------------|
!> | 1, 2    | height of the wheel, left and right; a force with VERTICAL_MODE = 'force' | travel_mm; fz_n |
!> | 3, 4    | lateral force at the contact point                 | fy_n                                     |
!> | 5 – 8   | damage radius, damage force                | none; the force must be 0                |
!> | 9, 10   | aligning torque                            | mz_nm                                    |
!> | 11, 12  | braking force at the contact point, rearward       | fx_n                                     |
!> | 13, 14  | driving force at the wheel centre, forward | centre_fx_n                              |
!> | 15, 16  | overturning moment                         | mx_nm                                    |
!> | 17, 18  | rolling resistance moment                  | my_nm                                    |
!> | 19      | steer, an angle or with STEERING_MODE = 'length' the travel of the rack | <driver>_deg, _mm |
!>
!> The table is for a deck with x rearward and y to the right.
module ek_lcf
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str, lower
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, split_lines, take_number
   use ek_unit_word, only: length_unit, force_unit, angle_unit
   use ek_teimorbit, only: teimorbit_t, parse_teimorbit, find_block, entry_of, units_in, check_units, row_item
   implicit none(type, external)
   private
   public :: lcf_t, parse_lcf, lcf_table, lcf_columns

   integer, parameter :: lcf_columns = 19
   integer, parameter :: most_rows = 20000
   integer, parameter :: damage_force(2) = [7, 8], steer = 19

   type :: lcf_t
      integer :: rows = 0
      real(wp), allocatable :: values(:, :)     !! numbers (column, row) [SI]
      logical :: is_force = .false.             !! columns 1 and 2 are forces
      logical :: is_rack = .false.              !! column 19 is the travel of the rack
   end type lcf_t

contains

   !> Reads a load case from the content of a .lcf file.
   subroutine parse_lcf(text, lcf, flaws)
      character(*), intent(in) :: text
      type(lcf_t), intent(out) :: lcf
      type(flaws_t), intent(inout) :: flaws
      type(lines_t) :: lines
      type(teimorbit_t) :: file
      real(wp) :: units(5), factors(lcf_columns), moment
      logical :: is_good
      integer :: k, j, block

      allocate (lcf%values(lcf_columns, 64))
      call split_lines(text, lines, flaws)
      if (lines%count == 0) return
      call parse_teimorbit(lines, file, flaws)
      call units_in(file, units, flaws)
      call check_units(file, units, [length_unit, force_unit, angle_unit], flaws)
      call take_mode('vertical_mode', 'length', 'force', lcf%is_force)
      call take_mode('steering_mode', 'angle', 'length', lcf%is_rack)
      block = find_block(file, 'data')
      if (block == 0) then
         call flaws%add(0, 'expected a block [DATA], found none')
         return
      end if
      moment = units(force_unit)*units(length_unit)
      factors(1:2) = units(merge(force_unit, length_unit, lcf%is_force))
      factors(3:4) = units(force_unit)
      factors(5:6) = units(length_unit)
      factors(7:8) = units(force_unit)
      factors(9:10) = moment
      factors(11:14) = units(force_unit)
      factors(15:18) = moment
      factors(steer) = units(merge(length_unit, angle_unit, lcf%is_rack))
      do k = 1, file%used
         associate (item => file%items(k))
            if (file%names(item%block) /= 'data' .or. item%kind /= row_item) cycle
            if (item%used /= lcf_columns) then
               call flaws%add(item%line, 'expected 19 numbers, found '//str(item%used))
               cycle
            end if
            if (lcf%rows == most_rows) then
               call flaws%add(item%line, 'expected at most '//str(most_rows)//' rows, found more')
               return
            end if
            if (lcf%rows == size(lcf%values, 2)) call grow(lcf%values)
            lcf%rows = lcf%rows + 1
            do j = 1, lcf_columns
               call take_number(item%fields(j)%text, item%line, 'column '//str(j), lcf%values(j, lcf%rows), flaws, is_good)
            end do
            if (any(abs(lcf%values(damage_force, lcf%rows)) > 0.0_wp)) call flaws%add(item%line, &
               'expected damage forces (columns 7 and 8) of 0, found others; they are not modelled')
            lcf%values(:, lcf%rows) = lcf%values(:, lcf%rows)*factors
         end associate
      end do
      if (lcf%rows == 0 .and. flaws%count() == 0) call flaws%add(file%block_lines(block), 'expected rows of 19 numbers, found none')

   contains

      !> Reads an entry of [MODE] with two choices. Without the entry, the first choice is used.
      subroutine take_mode(key, usual, other, is_other)
         character(*), intent(in) :: key, usual, other
         logical, intent(out) :: is_other
         character(:), allocatable :: word
         integer :: item

         is_other = .false.
         item = entry_of(file, find_block(file, 'mode'), key)
         if (item == 0) return
         word = ''
         if (file%items(item)%used > 0) word = lower(trim(adjustl(file%items(item)%fields(1)%text)))
         is_other = word == other
         if (word /= usual .and. .not. is_other) call flaws%add(file%items(item)%line, 'expected '//usual//' or '//other// &
            ' for '//key//', found '//shown(word))
      end subroutine take_mode

   end subroutine parse_lcf

   subroutine grow(values)
      real(wp), allocatable, intent(inout) :: values(:, :)
      real(wp), allocatable :: grown(:, :)

      allocate (grown(size(values, 1), 2*size(values, 2)))
      grown(:, :size(values, 2)) = values
      call move_alloc(grown, values)
   end subroutine grow

   !> The table of loads as CSV. Columns 1 and 2 are always included, and damage columns (5 to 8) never. Other columns of zeros are
   !> omitted.
   function lcf_table(lcf, driver, source) result(text)
      type(lcf_t), intent(in) :: lcf
      character(*), intent(in) :: driver      !! name of the driver that column 19 moves
      character(*), intent(in) :: source      !! the file, for a comment
      character(:), allocatable :: text
      character(*), parameter :: sides(2) = [character(6) :: 'left_', 'right_']
      character(*), parameter :: names(10) = [character(11) :: 'travel_mm', 'fy_n', '', '', 'mz_nm', 'fx_n', 'centre_fx_n', &
         'mx_nm', 'my_nm', '']
      type(buffer_t) :: buffer
      character(40) :: number
      character(:), allocatable :: separator
      real(wp) :: factor(lcf_columns)
      logical :: is_kept(lcf_columns)
      integer :: j, k, side, used

      factor = 1.0_wp
      if (.not. lcf%is_force) factor(1:2) = 1/millimetre
      factor(13:14) = -1.0_wp
      factor(steer) = 1/merge(millimetre, degree, lcf%is_rack)
      is_kept = [(any(abs(lcf%values(j, :lcf%rows)) > 0.0_wp), j=1, lcf_columns)]
      is_kept(1:2) = .true.
      is_kept(5:8) = .false.
      call buffer%line('# Made by elastokin import from '//source)
      call buffer%line("# For a deck with axes = 'x-rear' and two wheels: &case test = 'table', file = …"// &
         trim(merge(" /                     ", ", vertical = 'centre' /", lcf%is_force)))
      if (is_kept(steer)) call buffer%line('# The last column moves the driver joint '//driver//'; write the name of yours')
      separator = ''
      do j = 1, lcf_columns
         if (.not. is_kept(j)) cycle
         call buffer%add(separator)
         separator = ','
         side = 2 - mod(j, 2)
         if (j == steer) then
            call buffer%add(driver//trim(merge('_mm ', '_deg', lcf%is_rack)))
         else if (j <= 2 .and. lcf%is_force) then
            call buffer%add(trim(sides(side))//'fz_n')
         else
            call buffer%add(trim(sides(side))//trim(names((j + 1)/2)))
         end if
      end do
      call buffer%line('')
      do k = 1, lcf%rows
         separator = ''
         do j = 1, lcf_columns
            if (.not. is_kept(j)) cycle
            call buffer%add(separator)
            separator = ','
            used = 0
            call put_decimal(lcf%values(j, k)*factor(j), number, used)
            call buffer%add(number(:used))
         end do
         call buffer%line('')
      end do
      text = buffer%text()
   end function lcf_table

end module ek_lcf
