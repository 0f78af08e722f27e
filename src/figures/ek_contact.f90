!> The states of a test in which stops are in contact, from the clearance columns of the stops.
module ek_contact
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_table, only: table_t, name_length, row_count
   use ek_test_result, only: converged_rows
   implicit none(type, external)
   private
   public :: contact_t, states_in_contact, contacts_of

   character(*), parameter :: ending = '_gap_mm'

   !> A range of consecutive states in which a stop is in contact.
   type :: contact_t
      character(name_length) :: stop = ''        !! name of the stop, without its side if both sides have the same range
      integer :: first = 0, last = 0             !! first and last row of the range in the table
   end type contact_t

contains

   !> Finds the rows in which any stop is in contact. is_in_contact is not allocated if the table has no stop.
   pure subroutine states_in_contact(table, is_in_contact)
      type(table_t), intent(in) :: table
      logical, allocatable, intent(out) :: is_in_contact(:)
      integer :: c

      do c = 1, size(table%columns)
         if (.not. is_gap(table%columns(c))) cycle
         if (.not. allocated(is_in_contact)) allocate (is_in_contact(row_count(table)), source=.false.)
         is_in_contact = is_in_contact .or. is_closed(table, c)
      end do
   end subroutine states_in_contact

   !> The ranges of states in which stops are in contact. Equal ranges of the two sides are listed once.
   pure function contacts_of(table) result(list)
      type(table_t), intent(in) :: table
      type(contact_t), allocatable :: list(:)
      type(contact_t) :: contact
      logical, allocatable :: closed(:)
      integer :: c, k

      allocate (list(0))
      do c = 1, size(table%columns)
         if (.not. is_gap(table%columns(c))) cycle
         closed = [.false., is_closed(table, c), .false.]
         do k = 2, size(closed)
            if (closed(k) .and. .not. closed(k - 1)) contact%first = k - 1
            if (closed(k) .or. .not. closed(k - 1)) cycle
            contact%last = k - 2
            contact%stop = table%columns(c) (:len_trim(table%columns(c)) - len(ending))
            call add(list, contact)
         end do
      end do
   end function contacts_of

   !> Appends a range. If the left side of the stop has an equal range, that range then stands for both sides, and none is
   !> appended.
   pure subroutine add(list, contact)
      type(contact_t), allocatable, intent(inout) :: list(:)
      type(contact_t), intent(in) :: contact
      integer :: k

      do k = 1, size(list)
         if (list(k)%first /= contact%first .or. list(k)%last /= contact%last) cycle
         if (index(list(k)%stop, 'left_') /= 1 .or. index(contact%stop, 'right_') /= 1) cycle
         if (list(k)%stop(6:) /= contact%stop(7:)) cycle
         list(k)%stop = contact%stop(7:)
         return
      end do
      list = [list, contact]
   end subroutine add

   pure logical function is_gap(column)
      character(*), intent(in) :: column
      integer :: at

      at = len_trim(column) - len(ending)
      is_gap = at >= 1
      if (is_gap) is_gap = column(at + 1:) == ending
   end function is_gap

   !> Whether a stop is in contact in each row.
   pure function is_closed(table, column) result(closed)
      type(table_t), intent(in) :: table
      integer, intent(in) :: column
      logical :: closed(row_count(table))

      closed = converged_rows(table)
      where (closed) closed = ieee_is_finite(table%values(column, :))
      where (closed) closed = table%values(column, :) < 0.0_wp
   end function is_closed

end module ek_contact
