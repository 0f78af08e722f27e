!> Key numbers at particular states of a test: steering ratio and Ackermann percentage with the inner wheel at 20 deg, wheel travel
!> to the contact of a stop, and the largest force on the rack over all tests.
module ek_place_numbers
   use ek_kinds, only: wp
   use ek_text, only: spaced
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t
   use ek_key_number, only: key_number_t, key_source_t, nothing, at_place, to_contact, largest_of_all
   implicit none(type, external)
   private
   public :: number_list_t, new_number, add_source, append, numbers_of, place_numbers

   real(wp), parameter :: inner_steer = 20.0_wp        !! steer of the inner wheel [deg]: tight corner in town, a usual reference
   character(*), parameter :: gap_ending = '_gap_mm', travel = 'wheel_travel_mm', rack_force = 'steering_rack_force_n', &
      rack_name = 'largest_rack_force_n', to_stop = 'travel_to_'

   type :: slot_t
      type(key_number_t), allocatable :: number
   end type slot_t

   !> Key numbers in order. Each key number is stored in a slot of its own. A key number with the columns of all tests needs
   !> kilobytes; with slots, an insertion does not copy the others.
   type :: number_list_t
      private
      type(slot_t), allocatable :: slots(:)
      integer :: used = 0
   end type number_list_t

contains

   !> Creates a key number without values and sources.
   subroutine new_number(group, quantity, unit, sign, how, number)
      character(*), intent(in) :: group, quantity, unit, sign
      integer, intent(in) :: how
      type(key_number_t), intent(out) :: number

      number%group = group
      number%quantity = quantity
      number%unit = unit
      number%sign = sign
      number%name = ''
      number%condition = ''
      number%definition = ''
      number%how = how
      number%left = nothing()
      number%right = nothing()
      allocate (number%sources(0))
   end subroutine new_number

   !> Appends a source to a key number.
   subroutine add_source(source, number)
      type(key_source_t), intent(in) :: source
      type(key_number_t), intent(inout) :: number
      number%sources = [number%sources, source]
   end subroutine add_source

   !> Appends the key numbers of this module whose columns are in the tables of the tests.
   subroutine place_numbers(tests, numbers, wanted)
      type(test_result_t), intent(in) :: tests(:)
      type(number_list_t), intent(inout) :: numbers
      character(*), intent(in), optional :: wanted(:)    !! names without left_ and right_; absent: all
      integer :: t

      if (present(wanted)) then
         if (.not. any(index(wanted, rack_name) == 1 .or. index(wanted, '_at_20_deg') > 0 .or. index(wanted, to_stop) == 1)) return
      end if

      t = findloc([(tests(t)%kind == 'parallel_travel', t=1, size(tests))], .true., dim=1)
      if (t > 0) call add_stops(tests(t), t, numbers)
      t = findloc([(tests(t)%kind == 'steering', t=1, size(tests))], .true., dim=1)
      if (t > 0) then
         call add_at_steer(tests(t), t, 'steering_ratio', 'steering ratio at 20 deg', 'steering_ratio_at_20_deg', '–', numbers)
         call add_at_steer(tests(t), t, 'ackermann_percent', 'Ackermann at 20 deg', 'ackermann_at_20_deg', '%', numbers)
      end if
      call add_rack_force(tests, numbers)
   end subroutine place_numbers

   !> Adds the value of a column with the inner wheel at 20 deg. `left` is the value in a turn to the left, where the left wheel is
   !> the inner wheel.
   subroutine add_at_steer(test, place, column, quantity, name, unit, numbers)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place                 !! index of the test
      character(*), intent(in) :: column, quantity, name, unit
      type(number_list_t), intent(inout) :: numbers
      type(key_number_t) :: number
      type(key_source_t) :: source
      integer :: k, wheel

      call new_number('Steering', quantity, unit, 'steer of the inner wheel = 20 deg; left turn for the left wheel', &
         at_place, number)
      if (column_index(test%table, column) == 0) return
      do k = 1, size(test%prefixes)
         wheel = merge(2, 1, test%sides(k) > 0 .and. size(test%prefixes) > 1)
         if (column_index(test%table, trim(test%prefixes(k))//'steer_deg') == 0) cycle
         source%column(wheel) = column
         source%over(wheel) = trim(test%prefixes(k))//'steer_deg'
         source%wanted(wheel) = -test%sides(k)*inner_steer
      end do
      source%test = place
      call add_source(source, number)
      number%name = name
      number%condition = 'test '//test%name//', where the inner wheel is steered by 20 deg (left: turn to the left)'
      number%definition = column//' at the state with this steer angle'
      call append(number, numbers)
   end subroutine add_at_steer

   !> Adds the wheel travel from design to the contact of each stop, in parallel travel: the travel of the wheel on the side
   !> of the stop, or of the first wheel if the name of the stop gives no side.
   subroutine add_stops(test, place, numbers)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: place                 !! index of the test
      type(number_list_t), intent(inout) :: numbers
      type(key_number_t) :: number
      type(key_source_t) :: source
      character(:), allocatable :: stop
      logical :: is_pair
      integer :: c, ends

      is_pair = size(test%prefixes) > 1
      do c = 1, size(test%table%columns)
         ends = len_trim(test%table%columns(c)) - len(gap_ending)
         if (ends < 1) cycle
         if (test%table%columns(c) (ends + 1:) /= gap_ending) cycle
         stop = test%table%columns(c) (:ends)
         if (column_index(test%table, stop//'_force_n') == 0) cycle
         ! with the left one
         if (is_pair .and. index(stop, 'right_') == 1 .and. column_index(test%table, 'left_'//stop(7:)//gap_ending) > 0) cycle
         call new_number('Ride', '', 'mm', 'from design to contact, parallel travel', to_contact, number)
         source = key_source_t(test=place)
         if (is_pair .and. index(stop, 'right_') == 1) then
            call read_at(2, stop, 'right_')
            stop = stop(7:)
         else if (is_pair .and. index(stop, 'left_') == 1) then
            stop = stop(6:)
            call read_at(1, 'left_'//stop, 'left_')
            if (column_index(test%table, 'right_'//stop//gap_ending) > 0) call read_at(2, 'right_'//stop, 'right_')
         else
            call read_at(1, stop, '')
            number%is_of_axle = is_pair
         end if
         call add_source(source, number)
         number%quantity = 'wheel travel to '//spaced(stop)
         number%name = to_stop//stop
         number%condition = 'test '//test%name//', from design to contact'
         number%definition = 'magnitude of the change of '//travel//' from design to where '//stop//gap_ending// &
            ' is 0'
         call append(number, numbers)
      end do

   contains

      !> Adds the clearance of a stop and the travel on its side as the columns to be read.
      subroutine read_at(wheel, element, prefix)
         integer, intent(in) :: wheel
         character(*), intent(in) :: element, prefix       !! prefix: side of the stop, or ''

         source%over(wheel) = element//gap_ending
         source%column(wheel) = prefix//travel
         if (column_index(test%table, prefix//travel) == 0) source%column(wheel) = trim(test%prefixes(1))//travel
      end subroutine read_at

   end subroutine add_stops

   !> Adds the largest magnitude of the force on the rack over all states of all tests.
   subroutine add_rack_force(tests, numbers)
      type(test_result_t), intent(in) :: tests(:)
      type(number_list_t), intent(inout) :: numbers
      type(key_number_t) :: number
      type(key_source_t) :: source
      integer :: t

      call new_number('Steering', 'maximum rack force', 'N', 'magnitude, over all tests', largest_of_all, number)
      source%column(1) = rack_force
      do t = 1, size(tests)
         if (column_index(tests(t)%table, rack_force) == 0) cycle
         source%test = t
         call add_source(source, number)
      end do
      if (size(number%sources) == 0) return
      number%is_of_axle = .true.
      number%name = rack_name
      number%condition = 'all tests'
      number%definition = 'largest magnitude of '//rack_force
      call append(number, numbers)
   end subroutine add_rack_force

   !> Inserts a key number after the last key number of its group, or at the end of the list if it begins a new group.
   subroutine append(number, list)
      type(key_number_t), intent(in) :: number
      type(number_list_t), intent(inout) :: list
      type(slot_t), allocatable :: grown(:)
      integer :: k, at

      if (.not. allocated(list%slots)) allocate (list%slots(64))
      if (list%used == size(list%slots)) then
         allocate (grown(2*list%used))
         do k = 1, list%used
            call move_alloc(list%slots(k)%number, grown(k)%number)
         end do
         call move_alloc(grown, list%slots)
      end if
      do at = list%used, 1, -1
         if (list%slots(at)%number%group == number%group) exit
      end do
      if (at == 0) at = list%used
      do k = list%used, at + 1, -1
         call move_alloc(list%slots(k)%number, list%slots(k + 1)%number)
      end do
      allocate (list%slots(at + 1)%number, source=number)
      list%used = list%used + 1
   end subroutine append

   !> Returns the key numbers of a list as an array.
   subroutine numbers_of(list, numbers)
      type(number_list_t), intent(in) :: list
      type(key_number_t), allocatable, intent(out) :: numbers(:)
      integer :: k

      allocate (numbers(list%used))
      do k = 1, list%used
         numbers(k) = list%slots(k)%number
      end do
   end subroutine numbers_of

end module ek_place_numbers
