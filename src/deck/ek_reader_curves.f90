!> &curve, and the rates and curves of elements.
!>
!> A curve has no units of its own: its numbers have the deck units of the element that uses it.
module ek_reader_curves
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_curve, only: curve_t, new_curve, scaled_curve, curve_kinds
   use ek_group, only: curve_group, word_length, most_values
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, has_key, choice, look_up
   implicit none(type, external)
   private
   public :: read_curves, find_law, find_curve, check_rate, check_either

   real(wp), parameter :: least_step = 1.0e-30_wp   !! deck unit; with numbers below 1e30 no slope overflows

contains

   !> &curve: points and interpolation.
   subroutine read_curves(deck, draft)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      character(word_length) :: name, kind
      real(wp) :: x(most_values), y(most_values)
      namelist /curve/ name, x, y, kind
      integer :: k, j, c, n, used, status

      allocate (draft%curves(count(draft%cards%group == curve_group)))
      used = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= curve_group) cycle
         used = used + 1
         draft%cards(k)%index = used
         name = ''
         kind = 'linear'
         x = 0.0_wp
         y = 0.0_wp
         read (draft%cards(k)%text, nml=curve, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         call choice(draft, deck, k, 'kind', trim(kind), curve_kinds, c)
         if (.not. draft%cards(k)%is_good) cycle
         n = value_count(deck, k, 'x')
         if (value_count(deck, k, 'y') /= n) then
            call complain(draft, deck, k, 'y', 'y needs as many values as x, '//str(n)//', found '// &
               str(value_count(deck, k, 'y')))
            cycle
         end if
         do j = 2, n
            if (x(j) > x(j - 1)) cycle
            call complain(draft, deck, k, 'x', 'x must increase, found '//str(x(j))//' after '//str(x(j - 1)))
            exit
         end do
         do j = 2, n
            if (.not. draft%cards(k)%is_good) exit
            if (x(j) - x(j - 1) < least_step) call complain(draft, deck, k, 'x', 'x must increase by '//str(least_step)// &
               ' or more, found '//str(x(j))//' after '//str(x(j - 1)))
         end do
         if (.not. draft%cards(k)%is_good) cycle
         draft%curves(used) = new_curve(x(:n), y(:n), lower(trim(kind)))
         draft%curves(used)%name = trim(name)
      end do
   end subroutine read_curves

   !> The number of values of a key, however they are written.
   pure integer function value_count(deck, k, key)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key
      integer :: e

      value_count = 0
      do e = 1, deck%records(k)%used
         if (deck%records(k)%entries(e)%key == key) value_count = value_count + deck%records(k)%entries(e)%used
      end do
   end function value_count

   !> The curve named by a key of record k, in SI; unallocated if there is none or it was rejected.
   subroutine find_curve(draft, deck, k, key, name, x_unit, y_unit, curve)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, name
      real(wp), intent(in) :: x_unit, y_unit     !! SI per deck unit of the deflection and of the force
      type(curve_t), allocatable, intent(out) :: curve
      integer :: found

      call look_up(draft, deck, k, key, curve_group, name, found)
      if (found == 0) return
      if (draft%cards(found)%is_good) curve = scaled_curve(draft%curves(draft%cards(found)%index), x_unit, y_unit)
   end subroutine find_curve

   !> The law of an element with either a rate or a curve: checks both keys and returns the curve if there is one.
   subroutine find_law(draft, deck, k, rate, curve, x_unit, y_unit, law)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k                   !! record of the element
      real(wp), intent(in) :: rate               !! deck units
      character(*), intent(in) :: curve          !! name of the curve; '': none
      real(wp), intent(in) :: x_unit, y_unit     !! SI per deck unit of the deflection and of the force
      type(curve_t), allocatable, intent(out) :: law   !! SI; unallocated if there is none or it was rejected

      call check_either(draft, deck, k)
      call check_rate(draft, deck, k, 'rate', '', rate)
      call find_curve(draft, deck, k, 'curve', curve, x_unit, y_unit, law)
   end subroutine find_law

   !> Exactly one of rate and curve must be given.
   subroutine check_either(draft, deck, k)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k

      if (has_key(deck, k, 'rate') .and. has_key(deck, k, 'curve')) then
         call complain(draft, deck, k, 'curve', 'give either rate or curve, not both')
      else if (.not. (has_key(deck, k, 'rate') .or. has_key(deck, k, 'curve'))) then
         call complain(draft, deck, k, '', "give 'rate' or 'curve'")
      end if
   end subroutine check_either

   !> A rate must not be negative.
   subroutine check_rate(draft, deck, k, key, element, rate)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key, element
      real(wp), intent(in) :: rate
      if (rate < 0.0_wp) call complain(draft, deck, k, key, key//element//' must be 0 or more, found '//str(rate))
   end subroutine check_rate

end module ek_reader_curves
