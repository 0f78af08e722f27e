!> &axle and &steering: data of the vehicle around the suspension. At most one of each.
module ek_reader_axle
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_measure, only: axis_axis, rotation
   use ek_suspension, only: suspension_t
   use ek_record, only: element
   use ek_group, only: group_names, axle_group, steering_group, joint_group, measure_group, word_length
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, line_of, where_of, has_key, choice, look_up, find_card
   implicit none(type, external)
   private
   public :: read_axle, read_steering

contains

   !> &axle: front or rear, and its shares of braking and driving force.
   subroutine read_axle(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, position, drive_reaction
      real(wp) :: wheelbase, cg_height, mass, brake_share, drive_share, front_overhang, front_width
      namelist /axle/ name, position, wheelbase, cg_height, mass, brake_share, drive_share, drive_reaction, &
         front_overhang, front_width
      integer :: k, c, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= axle_group) cycle
         if (is_second(draft, deck, k)) cycle
         name = ''
         position = ''
         drive_reaction = 'wheel_centre'
         wheelbase = 1.0_wp
         cg_height = 1.0_wp
         mass = 1.0_wp
         brake_share = 0.0_wp
         drive_share = 1.0_wp
         front_overhang = 1.0_wp
         front_width = 1.0_wp
         read (draft%cards(k)%text, nml=axle, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         call check_positive(draft, deck, k, 'wheelbase', wheelbase)
         call check_positive(draft, deck, k, 'cg_height', cg_height)
         call check_positive(draft, deck, k, 'mass', mass)
         if (.not. has_key(deck, k, 'mass')) mass = 0.0_wp
         call check_share(draft, deck, k, 'brake_share', brake_share)
         call check_share(draft, deck, k, 'drive_share', drive_share)
         call check_positive(draft, deck, k, 'front_overhang', front_overhang)
         call check_positive(draft, deck, k, 'front_width', front_width)
         if (has_key(deck, k, 'front_overhang') .neqv. has_key(deck, k, 'front_width')) call complain(draft, deck, k, &
            trim(merge('front_overhang', 'front_width   ', has_key(deck, k, 'front_overhang'))), &
            'give front_overhang and front_width together (both define the wall-to-wall turning circle)')
         associate (this => suspension%axle)
            call choice(draft, deck, k, 'position', trim(position), [character(5) :: 'front', 'rear'], c)
            this%is_front = c == 1
            call choice(draft, deck, k, 'drive_reaction', trim(drive_reaction), [character(12) :: 'wheel_centre', 'patch'], c)
            this%drives_at_patch = c == 2
            this%has_axle = .true.
            this%where = where_of(deck, k)
            this%wheelbase = wheelbase*draft%units%length
            this%cg_height = cg_height*draft%units%length
            this%mass = mass
            this%brake_share = brake_share
            this%drive_share = drive_share
            if (has_key(deck, k, 'front_overhang') .and. c > 0 .and. .not. this%is_front) call complain(draft, deck, k, &
               'front_overhang', "front_overhang belongs to the front axle, found position = 'rear'")
            if (has_key(deck, k, 'front_overhang')) this%front_overhang = front_overhang*draft%units%length
            if (has_key(deck, k, 'front_width')) this%front_width = front_width*draft%units%length
         end associate
      end do
   end subroutine read_axle

   !> &steering: the driver of the rack, and the ratio to the steering wheel.
   subroutine read_steering(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, driver
      real(wp) :: ratio, travel
      namelist /steering/ name, driver, ratio, travel
      integer :: k, found, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= steering_group) cycle
         if (is_second(draft, deck, k)) cycle
         name = ''
         driver = ''
         ratio = 1.0_wp
         travel = 1.0_wp
         read (draft%cards(k)%text, nml=steering, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         if (.not. abs(ratio) > 0.0_wp) call complain(draft, deck, k, 'ratio', 'ratio must not be zero')
         call check_positive(draft, deck, k, 'travel', travel)
         call look_up(draft, deck, k, 'driver', joint_group, trim(driver), found)
         if (found > 0) call check_driver()
         suspension%steering%has_steering = .true.
         suspension%steering%where = where_of(deck, k)
         suspension%steering%driver = trim(driver)
         suspension%steering%ratio = ratio*draft%units%length
         suspension%steering%travel = travel*draft%units%length
      end do

   contains

      !> The joint must be a driver of a length, as ratio and travel are lengths.
      subroutine check_driver()
         integer :: measure

         if (lower(element(deck%records(found), 'type', 1)) /= 'driver') then
            call complain(draft, deck, k, 'driver', 'driver: the joint '//quoted(driver)//' in line '// &
               str(deck%records(found)%line)//' is not a driver')
            return
         end if
         measure = find_card(draft, measure_group, element(deck%records(found), 'measure', 1))
         if (measure == 0) return
         associate (index => draft%cards(measure)%index)
            if (index == 0) return
            if (any(suspension%readouts(index)%measure%kind == [axis_axis, rotation])) call complain(draft, deck, k, &
               'driver', 'driver: '//quoted(driver)//' must prescribe a length, but its measure is an angle')
         end associate
      end subroutine check_driver

   end subroutine read_steering

   !> Whether a group that may occur once has occurred before; reports it as a mistake.
   logical function is_second(draft, deck, k)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      integer :: first

      first = findloc(draft%cards%group, draft%cards(k)%group, dim=1)
      is_second = first < k
      if (is_second) call complain(draft, deck, k, '', 'a second &'//trim(group_names(draft%cards(k)%group))// &
         '; the first is in '//line_of(deck, first, k))
   end function is_second

   subroutine check_positive(draft, deck, k, key, value)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key
      real(wp), intent(in) :: value
      if (.not. value > 0.0_wp) call complain(draft, deck, k, key, key//' must be above 0, found '//str(value))
   end subroutine check_positive

   subroutine check_share(draft, deck, k, key, value)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      character(*), intent(in) :: key
      real(wp), intent(in) :: value
      if (value < 0.0_wp .or. value > 1.0_wp) call complain(draft, deck, k, key, key//' must be 0 to 1, found '//str(value))
   end subroutine check_share

end module ek_reader_axle
