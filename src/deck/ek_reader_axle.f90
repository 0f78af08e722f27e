!> &axle and &steering: data of the vehicle around the suspension. At most one of each.
module ek_reader_axle
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_measure, only: is_of_angle
   use ek_record, only: element
   use ek_group, only: group_names, joint_group, measure_group
   use ek_draft, only: draft_t, complain, line_of, where_of, has_key, choice, text_of, slot
   use ek_reference, only: look_up, find_card
   implicit none(type, external)
   private
   public :: read_axle, read_steering

contains

   !> &axle: front or rear, and its shares of braking and driving force.
   subroutine read_axle(draft)
      type(draft_t), intent(inout) :: draft
      integer :: c, number(7)

      if (is_second(draft)) return
      if (has_key(draft, 'front_overhang') .neqv. has_key(draft, 'front_width')) call complain(draft, &
         trim(merge('front_overhang', 'front_width   ', has_key(draft, 'front_overhang'))), &
         'give front_overhang and front_width together (both define the wall-to-wall turning circle)')
      call slot(draft, 'wheelbase', draft%units%length, number(1))
      call slot(draft, 'cg_height', draft%units%length, number(2))
      call slot(draft, 'mass', 1.0_wp, number(3))
      call slot(draft, 'brake_share', 1.0_wp, number(4))
      call slot(draft, 'drive_share', 1.0_wp, number(5), default=1.0_wp)
      call slot(draft, 'front_overhang', draft%units%length, number(6))
      call slot(draft, 'front_width', draft%units%length, number(7))
      draft%plan%axle = number
      associate (this => draft%plan%prototype%axle)
         call choice(draft, 'position', [character(5) :: 'front', 'rear'], c)
         this%is_front = c == 1
         if (has_key(draft, 'front_overhang') .and. c == 2) call complain(draft, 'front_overhang', &
            "front_overhang belongs to the front axle, found position = 'rear'")
         call choice(draft, 'drive_reaction', [character(12) :: 'wheel_centre', 'patch'], c, default=1)
         this%drives_at_patch = c == 2
         this%has_axle = .true.
         this%where = where_of(draft)
      end associate
   end subroutine read_axle

   !> &steering: the driver of the rack, and the ratio to the steering wheel.
   subroutine read_steering(draft)
      type(draft_t), intent(inout) :: draft
      character(:), allocatable :: driver
      integer :: found, number(2)

      if (is_second(draft)) return
      driver = text_of(draft, 'driver')
      call look_up(draft, 'driver', joint_group, driver, found)
      if (found > 0) call check_driver()
      call slot(draft, 'ratio', draft%units%length, number(1))
      call slot(draft, 'travel', draft%units%length, number(2))
      draft%plan%steering = number
      associate (this => draft%plan%prototype%steering)
         this%has_steering = .true.
         this%where = where_of(draft)
         this%driver = driver
      end associate

   contains

      !> The joint must be a driver of a length, as ratio and travel are lengths.
      subroutine check_driver()
         integer :: measure

         if (lower(element(draft%records(found), 'type', 1)) /= 'driver') then
            call complain(draft, 'driver', 'driver: the joint '//quoted(driver)//' in line '// &
               str(draft%records(found)%line)//' is not a driver')
            return
         end if
         measure = find_card(draft, measure_group, element(draft%records(found), 'measure', 1))
         if (measure == 0) return
         if (draft%cards(measure)%index == 0) return
         if (is_of_angle(draft%plan%prototype%readouts(draft%cards(measure)%index)%measure%kind)) call complain(draft, &
            'driver', 'driver: '//quoted(driver)//' must prescribe a length, but its measure is an angle')
      end subroutine check_driver

   end subroutine read_steering

   !> Whether a group that may occur once has occurred before; reports it as a mistake.
   logical function is_second(draft)
      type(draft_t), intent(inout) :: draft
      integer :: first

      first = findloc(draft%cards%group, draft%cards(draft%k)%group, dim=1)
      is_second = first < draft%k
      if (is_second) call complain(draft, '', 'a second &'//trim(group_names(draft%cards(draft%k)%group))// &
         '; the first is in '//line_of(draft, first))
   end function is_second

end module ek_reader_axle
