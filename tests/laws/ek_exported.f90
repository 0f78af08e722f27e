!> What a test of exports needs: the map of a deck, and readers of the written files that know nothing of the writers.
module ek_exported
   use ek_kinds, only: wp, degree, millimetre
   use ek_error, only: error_t, message_list_t
   use ek_deck, only: deck_t, read_deck
   use ek_reader, only: build_model
   use ek_balance, only: balance
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_length_choice, only: choose_lengths
   use ek_kandc_map, only: kandc_map_t, solve_map
   use ek_map_request, only: map_request_t, over_steer, over_opposite
   use ek_load_response, only: load_table_result_t
   implicit none(type, external)
   private
   public :: model_of, map_of, numbered_map, numbered_loads, numbers_of, skc_rows, par_rows, places_of

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

   !> A map whose numbers name their places, so that a written file shows which number stands where: in mm, deg and N, quantity q at
   !> second argument j, travel i and side s is q.jis, with 0.002·mod(q i² j, 5) added, so that the slopes of the curves differ. tz is
   !> less its value at design, 0 travel and 0 of the second argument.
   function numbered_map(kind, vertical, held) result(map)
      integer, intent(in) :: kind
      character(*), intent(in) :: vertical, held
      type(kandc_map_t) :: map
      real(wp) :: unit
      integer :: q, j, i, s

      map%model = 'numbered'
      map%title = 'Numbers of places'
      map%kind = kind
      map%travel = [-0.02_wp, 0.0_wp, 0.03_wp]
      map%second = [0.0_wp]
      if (kind == over_steer) map%second = [-0.01_wp, 0.0_wp, 0.015_wp, 0.04_wp]
      if (kind == over_opposite) map%second = map%travel
      map%driver = 'rack_drive'
      map%driver_sign = -1.0_wp
      map%vertical = vertical
      map%held = held
      allocate (map%value(17, size(map%second), size(map%travel), 2))
      do q = 1, 17
         unit = millimetre
         if (any(q == [4, 5, 6, 11, 12, 13])) unit = degree
         if (q == 17) unit = 1.0_wp
         do j = 1, size(map%second)
            do i = 1, size(map%travel)
               map%value(q, j, i, :) = unit*(q + 0.1_wp*j + 0.01_wp*i + 0.001_wp*[1, 2] + 0.002_wp*mod(q*i*i*j, 5))
            end do
         end do
      end do
      j = minloc(abs(map%second), dim=1)
      do s = 1, 2
         map%value(3, :, :, s) = map%value(3, :, :, s) - map%value(3, j, 2, s)
      end do
      ! row r, column c, side s: r.ccs e-5 m or e-4 rad; of both wheels r c e-7, with 1e-5 on the diagonal
      do s = 1, 2
         do j = 1, 12
            map%compliance(:3, j, s) = 1.0e-5_wp*([1, 2, 3] + 0.01_wp*j + 0.001_wp*s)
            map%compliance(4:, j, s) = 1.0e-4_wp*([4, 5, 6] + 0.01_wp*j + 0.001_wp*s)
         end do
      end do
      do j = 1, 12
         map%free(:, j) = 1.0e-7_wp*j*[(i, i=1, 12)]
         map%free(j, j) = map%free(j, j) + 1.0e-5_wp
      end do
      map%arm = reshape([0.011_wp, 0.021_wp, -0.311_wp, 0.012_wp, -0.022_wp, -0.312_wp], [3, 2])
      map%spin = reshape([0.1_wp, 0.9_wp, 0.2_wp, 0.3_wp, -0.8_wp, 0.4_wp], [3, 2])
      map%track = 1.5_wp
      map%length_labels(:, 1) = [character(63) :: 'left_coil', 'left_shock', 'lDamp', 'tz']
      map%length_labels(:, 2) = [character(63) :: 'right_coil', 'lSpring', 'right_foam', 'right_link']
   end function numbered_map

   !> A table of loads whose numbers name their places, as those of a numbered map: load part k of both wheels in row r is k.r, or
   !> −k.r on the right; quantity q of side s in row r is q.rs.
   function numbered_loads() result(loads)
      type(load_table_result_t) :: loads
      type(kandc_map_t) :: map
      integer :: r, k

      map = numbered_map(over_opposite, 'patch', 'road')
      allocate (loads%load(10, 3), loads%value(17, 3, 2))
      do r = 1, 3
         loads%load(:, r) = [(k + 0.1_wp*r, k=1, 5), (-k - 0.1_wp*r, k=1, 5)]
         loads%value(:, r, :) = map%value(:, r, r, :)
      end do
   end function numbered_loads

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
