!> What a test of exports needs: the map of a deck, and readers of the written files that know nothing of the writers.
module ek_exported
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_deck, only: deck_t, read_deck
   use ek_reader, only: build_model
   use ek_balance, only: balance
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_length_choice, only: choose_lengths
   use ek_kandc_map, only: kandc_map_t, solve_map
   use ek_map_request, only: map_request_t, over_steer
   implicit none(type, external)
   private
   public :: model_of, map_of, numbers_of, skc_rows, par_rows, places_of

contains

   !> The balanced model of a deck.
   subroutine model_of(file, suspension, trouble)
      character(*), intent(in) :: file
      type(suspension_t), intent(out) :: suspension
      character(:), allocatable, intent(out) :: trouble      !! '' if all is well
      type(deck_t) :: deck
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: error

      trouble = ''
      call read_deck(file, deck, error)
      if (.not. allocated(error)) call build_model(deck, suspension, cases, error)
      if (.not. allocated(error)) call balance(suspension, 1.0e-10_wp, error)
      if (allocated(error)) trouble = error%message
   end subroutine model_of

   !> The map of a deck over travel and the second argument of its kind.
   subroutine map_of(file, kind, travel, second, vertical, wish, map, trouble)
      character(*), intent(in) :: file
      integer, intent(in) :: kind
      real(wp), intent(in) :: travel(:), second(:)           !! m
      character(*), intent(in) :: vertical, wish             !! wish: as after --length; '': none
      type(kandc_map_t), intent(out) :: map
      character(:), allocatable, intent(out) :: trouble      !! '' if all is well
      type(suspension_t) :: suspension
      type(map_request_t) :: request
      type(message_list_t) :: wishes
      type(error_t), allocatable :: error

      call model_of(file, suspension, trouble)
      if (trouble /= '') return
      request%kind = kind
      request%travel = travel
      request%second = second
      request%driver = ''
      if (kind == over_steer) request%driver = suspension%steering%driver
      request%vertical = vertical
      request%held = trim(merge('road  ', 'centre', all(suspension%wheels%tyre_rate > 0.0_wp)))
      if (wish /= '') call wishes%add(wish)
      call choose_lengths(suspension, wishes, request%choices, error)
      if (.not. allocated(error)) call solve_map(suspension, request, map, error)
      if (allocated(error)) trouble = error%message
   end subroutine map_of

   !> n numbers from m/1000: places_of(-24, 52, 39) are −24, −22 … 52 mm.
   pure function places_of(from, to, count) result(values)
      integer, intent(in) :: from, to, count      !! mm
      real(wp) :: values(count)
      integer :: k
      values = [(1.0e-3_wp*(from + real((to - from)*(k - 1), wp)/(count - 1)), k=1, count)]
   end function places_of

   !> The numbers behind "key =" in a text of lines; empty if there is no such line.
   subroutine numbers_of(text, key, values)
      character(*), intent(in) :: text, key
      real(wp), allocatable, intent(out) :: values(:)
      integer :: at, end

      allocate (values(0))
      at = index(text, new_line('a')//key)
      if (at == 0) return
      at = at + 1 + len(key)
      end = at + index(text(at:), new_line('a')) - 2
      call take_words(text(at:end), values)
   end subroutine numbers_of

   !> All words of a line that are numbers, up to the first that is not; a leading '=' is skipped.
   subroutine take_words(line, values)
      character(*), intent(in) :: line
      real(wp), allocatable, intent(inout) :: values(:)
      real(wp) :: x
      integer :: at, end, status

      at = 1
      do while (at <= len(line))
         if (scan(line(at:at), ' =,'//achar(9)) == 1) then
            at = at + 1
            cycle
         end if
         end = at + scan(line(at:)//' ', ' ,'//achar(9)) - 2
         read (line(at:end), *, iostat=status) x
         if (status /= 0 .or. verify(line(at:end), '0123456789+-.eEdD') > 0) return
         values = [values, x]
         at = end + 2
      end do
   end subroutine take_words

   !> The table of side 'L' or 'R' of an infofile: (column, i1, i0), by the two indices in front of each row.
   subroutine skc_rows(text, side, rows)
      character(*), intent(in) :: text
      character(1), intent(in) :: side
      real(wp), allocatable, intent(out) :: rows(:, :, :)
      real(wp), allocatable :: first(:), second(:), numbers(:)
      character(:), allocatable :: key
      integer :: at, end, i, j

      key = text(index(text, new_line('a')//'Susp') + 1:)
      key = key(:6)//'Kin.0.'//side
      call numbers_of(text, key//'.Arg0 ', first)
      call numbers_of(text, key//'.Arg1 ', second)
      allocate (rows(10, size(second), size(first)), source=huge(1.0_wp))
      at = index(text, key//'.Data:')
      if (at == 0) return
      do
         at = at + index(text(at:), new_line('a'))
         end = at + index(text(at:), new_line('a')) - 2
         if (end < at) return
         if (index(text(at:end), '""') > 0) cycle
         if (allocated(numbers)) deallocate (numbers)
         allocate (numbers(0))
         call take_words(text(at:end), numbers)
         if (size(numbers) /= 12) return
         i = nint(numbers(1)) + 1
         j = nint(numbers(2)) + 1
         if (i > size(first) .or. j > size(second)) return
         rows(:, j, i) = numbers(3:)
      end do
   end subroutine skc_rows

   !> The rows of a table of a parsfile behind 'iside 1' or 'iside 2': (column, row).
   subroutine par_rows(text, side, keyword, rows)
      character(*), intent(in) :: text, keyword
      integer, intent(in) :: side
      real(wp), allocatable, intent(out) :: rows(:, :)
      real(wp), allocatable :: numbers(:)
      integer :: at, end

      allocate (rows(2, 0))
      at = index(text, new_line('a')//'iside '//merge('1', '2', side == 1))
      if (at == 0) return
      at = at + index(text(at:), new_line('a')//keyword//' SPLINE')
      do
         at = at + index(text(at:), new_line('a'))
         end = at + index(text(at:), new_line('a')) - 2
         if (end < at) return
         if (text(at:end) == 'ENDTABLE') return
         if (allocated(numbers)) deallocate (numbers)
         allocate (numbers(0))
         call take_words(text(at:end), numbers)
         if (size(numbers) /= 2) return
         rows = reshape([rows, numbers], [2, size(rows, 2) + 1])
      end do
   end subroutine par_rows

end module ek_exported
