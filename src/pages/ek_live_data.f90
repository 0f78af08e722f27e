!> The object "live" of data.json: the rates that a page can change, and the data that its script needs for the design state
!> and for every state of the tests. The data consist of as few numbers as possible (ek_live_small).
module ek_live_data
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_base64, only: base64_of_numbers
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_buffer, only: buffer_t
   use ek_quantity, only: unit_of, unit_text
   use ek_live_rates, only: live_rate_t, rate_path
   use ek_live_state, only: live_state_t
   use ek_live, only: live_t, live_test_t
   use ek_live_small, only: small_t, make_small, entries
   use ek_key_number, only: key_number_t, at_design
   use ek_summary, only: kept_number
   implicit none(type, external)
   private
   public :: add_live_data, find_columns

   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

contains

   !> Adds the object "live"; adds nothing if there are no rates.
   subroutine add_live_data(json, live, numbers)
      type(json_t), intent(inout) :: json
      type(live_t), intent(in) :: live
      type(key_number_t), intent(in) :: numbers(:)         !! key numbers of the report
      integer, allocatable :: columns(:, :)                ! of each number: of the left and the right wheel in the design state
      logical, allocatable :: is_used(:), is_left(:)
      integer :: k, wheel

      if (.not. allocated(live%rates)) return
      call json%open('{', 'live')
      call json%item('balance', json_string(trim(live%balance)))
      call json%open('[', 'rates')
      do k = 1, size(live%rates%rate)
         call add_rate(json, live%rates%rate(k))
      end do
      call json%close(']')
      if (live%reruns > 0) call add_reruns(json, live)
      allocate (columns(2, size(numbers)), is_used(size(live%design%column)))
      is_used = .false.
      do k = 1, size(numbers)
         call find_columns(live%design, numbers(k), columns(:, k))
         do wheel = 1, 2
            if (columns(wheel, k) > 0) is_used(columns(wheel, k)) = .true.
         end do
      end do
      is_left = is_used
      call json%item('design', test_text(live%design, live%rates%of_law, .true., is_left))
      call json%open('[', 'numbers')
      do k = 1, size(numbers)
         if (any(columns(:, k) > 0)) call add_number(json, numbers, k, columns(:, k), is_used)
      end do
      call json%close(']')
      call json%open('[', 'tests')
      do k = 1, size(live%tests)
         deallocate (is_used)
         allocate (is_used(size(live%tests(k)%column)), source=.true.)
         do while (any(is_used))
            call json%item_of_list(test_text(live%tests(k), live%rates%of_law, .false., is_used))
         end do
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_live_data

   !> Adds a rate: its group, name and part, its value in N/mm or N m/deg, and the paths of the settings that change it in the
   !> deck.
   subroutine add_rate(json, rate)
      type(json_t), intent(inout) :: json
      type(live_rate_t), intent(in) :: rate
      character(:), allocatable :: name
      real(wp) :: value
      integer :: side

      name = trim(rate%element(1))
      if (rate%element(2) /= '') name = name(6:)
      value = rate%rate/1.0e3_wp
      if (rate%is_of_angle) value = rate%rate*degree
      call json%open('{')
      call json%item('name', json_string(name))
      call json%item('group', json_string(trim(rate%group)))
      call json%item('part', json_string(trim(rate%part)))
      call json%item('value', json_number(value))
      call json%item('unit', json_string(trim(merge('N m/deg', 'N/mm   ', rate%is_of_angle))))
      call json%open('[', 'paths')
      do side = 1, 2
         if (rate%element(side) == '') cycle
         call json%item_of_list(json_string(rate_path(rate, side)))
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_rate

   !> Adds the deviation of the page from runs at the ends of the sliders: number of runs, runs without a result, and of the largest
   !> deviation (a share of the value of the run) the column, the factors of the rates, and the values of page and run.
   subroutine add_reruns(json, live)
      type(json_t), intent(inout) :: json
      type(live_t), intent(in) :: live

      call json%open('{', 'reruns')
      call json%item('count', str(live%reruns))
      call json%item('failed', str(live%failed))
      call json%item('deviation', json_number(live%deviation))
      if (allocated(live%worst)) then
         call json%item('column', json_string(live%worst))
         call json%item('factors', json_numbers(live%worst_factor))
         call json%item('values', json_numbers(live%worst_values))
      end if
      call json%close('}')
   end subroutine add_reruns

   !> Finds the columns of the design state from which a key number is read, for the left and the right wheel. A column is 0
   !> if the key number is not read at design, has no value or does not follow the rates.
   subroutine find_columns(design, number, columns)
      type(live_test_t), intent(in) :: design
      type(key_number_t), intent(in) :: number
      integer, intent(out) :: columns(2)
      integer :: wheel

      columns = 0
      if (number%how /= at_design .or. size(number%sources) == 0) return
      do wheel = 1, 2
         columns(wheel) = findloc(design%column, number%sources(1)%column(wheel), dim=1)
         if (columns(wheel) == 0) cycle
         if (.not. ieee_is_finite(design%value(columns(wheel), 1))) columns(wheel) = 0
      end do
   end subroutine find_columns

   !> Adds a key number that follows the rates. `beside` is the name of the key number of the page next to which it is shown.
   subroutine add_number(json, numbers, k, columns, is_used)
      type(json_t), intent(inout) :: json
      type(key_number_t), intent(in) :: numbers(:)
      integer, intent(in) :: k
      integer, intent(in) :: columns(2)
      logical, intent(in) :: is_used(:)                    !! columns that are written
      integer :: kept

      kept = kept_number(numbers, k)
      if (kept == 0) kept = k
      call json%open('{')
      call json%item('name', json_string(numbers(k)%name))
      call json%item('beside', json_string(numbers(kept)%name))
      call json%item('title', json_string(numbers(k)%quantity))
      call json%item('unit', json_string(numbers(k)%unit))
      if (columns(1) > 0) call json%item('left', str(count(is_used(:columns(1))) - 1))
      if (columns(2) > 0) call json%item('right', str(count(is_used(:columns(2))) - 1))
      call json%close('}')
   end subroutine add_number

   !> Columns of a test as JSON: laws, columns, and states. With `is_exact`, the numbers of a state are lists with all digits;
   !> otherwise base64 with 7 digits, in the same order. The design state, and the first string of a test, also contain the
   !> data for the displacements of the wheel centres (end_numbers).
   function test_text(test, of_law, is_exact, is_used) result(text)
      type(live_test_t), intent(in) :: test
      integer, intent(in) :: of_law(:)
      logical, intent(in) :: is_exact
      logical, intent(inout) :: is_used(:)                 !! columns to be written; on return, columns that are not written yet
      character(:), allocatable :: text, name
      type(small_t) :: small
      type(buffer_t) :: out
      logical :: is_first
      integer :: k, c

      is_first = all(is_used) .or. is_exact
      call make_small(test, of_law, is_exact, is_used, small)
      call out%add('{"name": '//json_string(test%name)//', "of_law": ')
      call out%add(json_numbers(real(small%of_law - 1, wp), separator=','))
      call out%add(', "is_whole": '//truth(small%is_whole)//', "has_self": '// &
         truth(small%has_self)//', "has_held": '//truth(small%has_held)//', "vectors": '//str(small%vectors)//', "columns": [')
      do c = 1, size(small%column)
         if (c > 1) call out%add(', ')
         name = trim(test%column(small%column(c)))
         call out%add('{"name": '//json_string(name)//', "unit": '//json_string(unit_text(unit_of(name)))//', "is_held": '// &
            truth(test%is_held(small%column(c)))//', "is_inverse": '//truth(test%is_inverse(small%column(c)))//', "read": '// &
            str(small%read(c) - 1)//', "load": '//str(small%load(c) - 1)//'}')
      end do
      call out%add('], "states": [')
      do k = 1, size(test%state)
         if (k > 1) call out%add(', ')
         if (.not. test%state(k)%is_known) then
            call out%add('null')
         else if (is_exact) then
            call out%add(json_numbers(small%numbers(:, k), separator=','))
         else
            call out%add('"'//base64_of_numbers(small%numbers(:, k))//'"')
         end if
      end do
      call out%add(']')
      if (is_first) then                  ! of a test once: how far its states would move
         call out%add(', "ends_of_law": ')
         call out%add(json_numbers(real(of_law - 1, wp), separator=','))
         call out%add(', "ends": [')
         do k = 1, size(test%shown)
            if (k > 1) call out%add(', ')
            call out%add('"'//base64_of_numbers(end_numbers(test%state(test%shown(k)), test%holds_heights))//'"')
         end do
         call out%add(']')
      end if
      call out%add('}')
      text = out%text()
   end function test_text

   !> The numbers from which the page computes the motion of a state: matrix A row by row, deflections, and displacements of the
   !> wheel centres.
   function end_numbers(state, is_held) result(list)
      type(live_state_t), intent(in) :: state
      logical, intent(in) :: is_held                       !! heights are held
      real(wp), allocatable :: list(:)

      if (is_held) then
         list = [entries(state%held_self, .true.), state%deflection, reshape(state%held_move, [size(state%held_move)])]
      else
         list = [entries(state%self, .true.), state%deflection, reshape(state%move, [size(state%move)])]
      end if
   end function end_numbers

   pure function truth(is_so) result(text)
      logical, intent(in) :: is_so
      character(:), allocatable :: text
      text = trim(merge('true ', 'false', is_so))
   end function truth

end module ek_live_data
