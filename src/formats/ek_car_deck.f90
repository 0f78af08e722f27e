!> The records &axle, &steering and &adjuster of a deck made from points, if the file has their numbers.
module ek_car_deck
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_car_number, only: car_numbers_t, find_car_number, slot_names, wheelbase, cg_height, car_mass, brake_share, drive_share, &
      rack_ratio, rack_travel, rod_adjuster
   use ek_deck_parts, only: writing_t
   implicit none(type, external)
   private
   public :: put_car, missing_groups, unused_numbers

   integer, parameter :: of_axle(3) = [wheelbase, cg_height, brake_share], of_steering(2) = [rack_ratio, rack_travel]

contains

   !> Writes the records that are complete.
   subroutine put_car(numbers, axle, is_steered, rod, writing)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: axle                      !! 1 front, 2 rear, 0 not known
      logical, intent(in) :: is_steered
      character(*), intent(in) :: rod                  !! distance joint of the tie rod; '' if there is none
      type(writing_t), intent(inout) :: writing

      if (is_complete(numbers, of_axle, axle) .and. axle > 0) call put_axle_record(numbers, axle, writing)
      if (is_complete(numbers, of_steering, axle) .and. is_steered) then
         call writing%deck%begin('steering')
         call writing%deck%word('driver', 'rack_drive')
         call put('ratio', rack_ratio)
         call put('travel', rack_travel)
         call put_note(numbers, of_steering, axle, writing)
      end if
      if (.not. is_complete(numbers, [rod_adjuster], axle) .or. rod == '') return
      call writing%deck%begin('adjuster')
      call writing%deck%word('name', rod)
      call writing%deck%word('type', 'rod')
      call writing%deck%word('joint', rod)
      call writing%deck%numbers('range', numbers%list(find_car_number(numbers, rod_adjuster, axle))%value*writing%factor)
      call put_note(numbers, [rod_adjuster], axle, writing)

   contains

      subroutine put(key, slot)
         character(*), intent(in) :: key
         integer, intent(in) :: slot
         call writing%deck%number(key, numbers%list(find_car_number(numbers, slot, axle))%value(1)*writing%factor)
      end subroutine put

   end subroutine put_car

   subroutine put_axle_record(numbers, axle, writing)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: axle
      type(writing_t), intent(inout) :: writing
      integer, parameter :: slots(5) = [wheelbase, cg_height, car_mass, brake_share, drive_share]
      integer :: k, found

      call writing%deck%begin('axle')
      call writing%deck%word('position', trim(merge('front', 'rear ', axle == 1)))
      do k = 1, size(slots)
         found = find_car_number(numbers, slots(k), axle)
         if (found == 0) cycle
         call writing%deck%number(trim(slot_names(slots(k))), numbers%list(found)%value(1)*merge(writing%factor, 1.0_wp, &
            any([wheelbase, cg_height] == slots(k))))
      end do
      call put_note(numbers, slots, axle, writing)
   end subroutine put_axle_record

   !> Ends a record with the lines of its numbers.
   subroutine put_note(numbers, slots, axle, writing)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: slots(:), axle
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: lines, file
      integer :: k, found

      file = writing%file
      if (numbers%source /= '') file = trim(numbers%source)
      lines = ''
      do k = 1, size(slots)
         found = find_car_number(numbers, slots(k), axle)
         if (found > 0) lines = lines//', '//str(numbers%list(found)%line)
      end do
      call writing%deck%word('note', file//':'//lines(3:))
      call writing%deck%end()
   end subroutine put_note

   pure logical function is_complete(numbers, slots, axle)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: slots(:), axle
      integer :: k
      is_complete = all([(find_car_number(numbers, slots(k), axle) > 0, k=1, size(slots))])
   end function is_complete

   !> The groups that the deck does not have, for its comments.
   pure function missing_groups(numbers, axle, is_steered) result(text)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: axle
      logical, intent(in) :: is_steered
      character(:), allocatable :: text

      text = ''
      if (.not. is_complete(numbers, of_axle, axle) .or. axle == 0) text = '&axle (heights and shares of the car), '
      if (.not. is_complete(numbers, of_steering, axle) .or. .not. is_steered) text = text// &
         '&steering (ratio and travel of the rack), '
   end function missing_groups

   !> Why number k is not in the deck; '' if it is.
   pure function unused_numbers(numbers, k, axle, is_steered, rod) result(text)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: k, axle
      logical, intent(in) :: is_steered
      character(*), intent(in) :: rod
      character(:), allocatable :: text

      text = ''
      select case (numbers%list(k)%slot)
      case (rack_ratio, rack_travel)
         if (.not. is_complete(numbers, of_steering, axle)) text = '&steering needs rack_ratio and rack_travel'
         if (.not. is_steered) text = 'the axle has no rack'
      case (rod_adjuster)
         if (rod == '') text = 'the axle has no tie rod'
      case default
         if (.not. is_complete(numbers, of_axle, axle)) text = '&axle needs wheelbase, cg_height and brake_share'
         if (axle == 0) text = '&axle needs --axle front or --axle rear'
      end select
      if (text == '') return
      text = 'line '//str(numbers%list(k)%line)//': '//trim(slot_names(numbers%list(k)%slot))//': '//text
      if (numbers%source /= '') text = trim(numbers%source)//', '//text
   end function unused_numbers

end module ek_car_deck
