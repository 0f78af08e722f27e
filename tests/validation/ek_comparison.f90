!> Numbers of this program beside published ones: what the tests of this folder check and docs/validation.md lists.
module ek_comparison
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_rig_table, only: rig_table
   use ek_table, only: table_t, column_index, row_count, read_csv
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: comparison_t, comparisons_t, add, breach, solve, read_numbers, read_loads, pick

   character(*), parameter :: decks = 'tests/validation/decks/', numbers = 'tests/validation/numbers/'
   real(wp), parameter :: missing = 1.0e30_wp        !! in no tolerance; debug builds trap comparisons of nan

   !> One number, in the unit and with the sign of the publication.
   type :: comparison_t
      character(24) :: part = ''             !! of the publication: an axle
      character(40) :: quantity = ''
      character(32) :: place = ''            !! the state
      character(8) :: unit = ''
      real(wp) :: ours = missing, published = 0.0_wp, tolerance = 0.0_wp
   end type comparison_t

   type :: comparisons_t
      type(comparison_t), allocatable :: items(:)
      character(24) :: part = ''             !! of the numbers added next
      character(:), allocatable :: trouble   !! why numbers are missing; not allocated: none are
   end type comparisons_t

contains

   !> Appends a number.
   subroutine add(list, quantity, place, unit, ours, published, tolerance)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: quantity, place, unit
      real(wp), intent(in) :: ours, published, tolerance
      type(comparison_t), allocatable :: longer(:)
      integer :: n

      if (.not. allocated(list%items)) allocate (list%items(0))
      n = size(list%items)
      allocate (longer(n + 1))
      longer(:n) = list%items
      longer(n + 1)%part = list%part
      longer(n + 1)%quantity = quantity
      longer(n + 1)%place = place
      longer(n + 1)%unit = unit
      longer(n + 1)%ours = ours
      longer(n + 1)%published = published
      longer(n + 1)%tolerance = tolerance
      call move_alloc(longer, list%items)
   end subroutine add

   !> The first number outside its tolerance as a sentence, or the reason why numbers are missing; '' if the list has `least` numbers
   !> or more and all are within their tolerances.
   function breach(list, least) result(text)
      type(comparisons_t), intent(in) :: list
      integer, intent(in) :: least
      character(:), allocatable :: text
      character(100) :: values
      integer :: k

      text = ''
      if (allocated(list%trouble)) text = list%trouble
      if (text == '' .and. .not. allocated(list%items)) text = 'no numbers were compared'
      if (text /= '') return
      if (size(list%items) < least) text = 'only '//str(size(list%items))//' numbers were compared, expected '//str(least)
      do k = 1, size(list%items)
         associate (item => list%items(k))
            if (abs(item%ours - item%published) <= item%tolerance) cycle
            write (values, '(es22.14, a, es22.14, a, es9.2)') &
               item%ours, ', published', item%published, ', tolerance', item%tolerance
            text = trim(item%part)//' '//trim(item%quantity)//' at '//trim(item%place)//' ['//trim(item%unit)//']:'//values
            return
         end associate
      end do
   end function breach

   !> The table of a case of a deck of this folder, also in the definitions of a program; trouble is kept in the list.
   subroutine solve(list, deck, case_name, settings, table, program, defined)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: deck, case_name
      character(*), intent(in) :: settings(:)
      type(table_t), intent(out) :: table
      character(*), intent(in), optional :: program
      type(table_t), intent(out), optional :: defined
      character(:), allocatable :: trouble

      call rig_table(decks//deck//'.nml', case_name, settings, table, trouble, program, defined)
      if (trouble /= '' .and. .not. allocated(list%trouble)) list%trouble = deck//': '//trouble
   end subroutine solve

   !> Published numbers from a file of this folder; trouble is kept in the list.
   subroutine read_numbers(list, name, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: name
      type(table_t), intent(out) :: table
      type(error_t), allocatable :: error

      call read_csv(numbers//name//'.csv', table, error)
      if (allocated(error) .and. .not. allocated(list%trouble)) list%trouble = error%message
   end subroutine read_numbers

   !> The loads of a case of a deck of this folder; trouble is kept in the list.
   subroutine read_loads(list, name, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: name
      type(table_t), intent(out) :: table
      type(error_t), allocatable :: error

      call read_csv(decks//name//'.csv', table, error)
      if (allocated(error) .and. .not. allocated(list%trouble)) list%trouble = error%message
   end subroutine read_loads

   !> A number of a table; a number outside every tolerance if the table does not have it.
   real(wp) function pick(table, name, row) result(value)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      integer, intent(in) :: row
      integer :: place

      value = missing
      place = column_index(table, name)
      if (place > 0 .and. row <= row_count(table)) value = table%values(place, row)
   end function pick

end module ek_comparison
