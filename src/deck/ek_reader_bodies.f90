!> &point, &body, &mass and &load; &wheel: the wheels whose attitude is reported; &axle and &steering: data of the vehicle around
!> the suspension, at most one of each.
module ek_reader_bodies
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_dimension, only: unit_name, length
   use ek_record, only: single, left_side, right_side, element
   use ek_measure, only: is_of_angle
   use ek_suspension, only: body_t, load_t, wheel_t, body_name
   use ek_blueprint, only: vector_t, body_plan_t, mass_plan_t, load_plan_t, wheel_plan_t, hardpoint, given, lowest, inward, &
      off_left, off_right, in_plane
   use ek_design_vector, only: plane
   use ek_group, only: joint_group, measure_group
   use ek_deck_reading, only: deck_reading_t, complain, where_of, has_key, choice, text_of, switch_of, number_of, numbers_of, &
      is_second, slot, unit_of
   use ek_reference, only: look_up, find_card, find_point, find_place, find_points, find_moving_body, check_apart, is_driver, &
      new_vector
   implicit none(type, external)
   private
   public :: read_point, read_body, read_mass, read_load, read_wheel, read_axle, read_steering

contains

   !> Reads &point: a position at design. With &mirror, also records on which side of the plane the point must stay, or that it must
   !> stay in the plane.
   subroutine read_point(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(vector_t) :: vector
      integer :: number

      vector%kind = hardpoint
      call slot(reading, 'at', vector%first, default=0.0_wp)
      call new_vector(reading, vector, number)
      reading%cards(reading%k)%index = number
      ! a setting of one side has the last word and may have taken its point across the plane: no range keeps it then
      associate (stays => reading%plan%vectors(number)%stays, side => reading%records(reading%k)%side, &
         y => reading%vectors(2, number))
         if (side == left_side .and. y <= -plane) stays = off_left
         if (side == right_side .and. y >= plane) stays = off_right
         if (side == single .and. abs(y) < plane .and. any(reading%records%side /= single)) stays = in_plane
      end associate
   end subroutine read_point

   !> Reads &body: origin, mass and centre of gravity.
   subroutine read_body(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(body_plan_t) :: plan
      type(body_t) :: body
      logical :: is_found, has_centre

      call find_point(reading, 'origin', text_of(reading, 'origin'), plan%origin, is_found)
      call find_point(reading, 'centre', text_of(reading, 'centre'), plan%centre, has_centre)
      if (has_key(reading, 'mass') .neqv. has_key(reading, 'centre')) call complain(reading, &
         trim(merge('mass  ', 'centre', has_key(reading, 'mass'))), 'give mass and centre (of gravity) together')
      call slot(reading, 'mass', plan%mass)
      body%name = text_of(reading, 'name')
      body%where = where_of(reading)
      body%has_origin = plan%origin > 0
      body%mass = number_of(reading, 'mass', 0.0_wp)*unit_of(reading, 'mass')
      reading%plan%prototype%bodies = [reading%plan%prototype%bodies, body]
      reading%plan%bodies = [reading%plan%bodies, plan]
      reading%cards(reading%k)%index = size(reading%plan%bodies)
   end subroutine read_body

   !> Reads &mass: a further mass of a body, in addition to the mass of &body.
   subroutine read_mass(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(mass_plan_t) :: plan
      logical :: has_body, has_place

      call find_moving_body(reading, plan%body, has_body)
      call find_point(reading, 'at', text_of(reading, 'at'), plan%at, has_place)
      if (.not. reading%cards(reading%k)%is_good .or. .not. has_body .or. .not. has_place) return
      call slot(reading, 'kg', plan%kg)
      associate (body => reading%plan%prototype%bodies(plan%body))      ! whether it has a weight
         body%mass = body%mass + number_of(reading, 'kg', 1.0_wp)*unit_of(reading, 'kg')
      end associate
      reading%plan%masses = [reading%plan%masses, plan]
   end subroutine read_mass

   !> Reads &load: force and moment in the axes of the deck at design. With `follows`, the load rotates with its body.
   subroutine read_load(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(load_plan_t) :: plan
      type(load_t) :: element
      logical :: has_body, is_found
      integer :: c

      call find_moving_body(reading, element%body, has_body)
      call find_place(reading, text_of(reading, 'at'), plan%at, element%wheel, is_found)
      call choice(reading, 'factor', c)
      if (.not. (has_key(reading, 'force') .or. has_key(reading, 'moment'))) &
         call complain(reading, '', "give 'force' or 'moment'")
      element%is_case = c /= 1
      ! stored for a rejected load too: a case may check whether it is scaled
      reading%cards(reading%k)%is_used = element%is_case
      if (element%wheel > 0) then
         if (has_body .and. reading%plan%prototype%wheels(element%wheel)%body /= element%body) call complain(reading, 'at', &
            'at: the contact point of wheel '//quoted(reading%plan%prototype%wheels(element%wheel)%name)//' is on body '// &
            quoted(body_name(reading%plan%prototype, reading%plan%prototype%wheels(element%wheel)%body))//', not on '// &
            quoted(text_of(reading, 'body')))
         if (switch_of(reading, 'follows')) call complain(reading, 'follows', 'a load at a contact point that moves in its '// &
            'carrier cannot rotate with it; leave follows out')
      end if
      if (.not. reading%cards(reading%k)%is_good) return

      call slot(reading, 'force', plan%force)
      call slot(reading, 'moment', plan%moment)
      element%name = text_of(reading, 'name')
      element%where = where_of(reading)
      element%follows = switch_of(reading, 'follows')
      reading%plan%prototype%loads = [reading%plan%prototype%loads, element]
      reading%plan%loads = [reading%plan%loads, plan]
   end subroutine read_load

   !> Reads &wheel: its body, side, points, spin axis and steering axis, and the data of its tyre.
   subroutine read_wheel(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(wheel_plan_t) :: plan
      type(wheel_t) :: this
      real(wp) :: height, centre(3)
      logical :: has_body, has_centre, has_contact, is_there
      integer :: c

      reading%cards(reading%k)%index = 1 + count(reading%cards(:reading%k - 1)%group == reading%cards(reading%k)%group)
      call find_moving_body(reading, this%body, has_body)
      call choice(reading, 'side', c)
      this%side = merge(-1, 1, c == 1)
      call find_point(reading, 'centre', text_of(reading, 'centre'), plan%centre, has_centre)
      call find_point(reading, 'contact', text_of(reading, 'contact'), plan%contact, has_contact)
      this%has_crown = has_key(reading, 'crown_radius')
      if (.not. (this%has_crown .or. has_key(reading, 'contact'))) call complain(reading, '', "'contact' is missing")
      if (this%has_crown) call check_crown(reading)
      centre = reading%vectors(:, plan%centre)
      ! a left wheel on the right side would reverse the signs of its results
      if (has_centre .and. c > 0 .and. this%side*centre(2) < 0.0_wp) call complain(reading, 'side', 'side is '// &
         quoted(text_of(reading, 'side'))//', but the centre '//quoted(text_of(reading, 'centre'))// &
         ' lies on the other side (y points '//trim(merge('left ', 'right', reading%plan%is_iso))//')')
      if (has_centre .and. has_contact) then
         height = centre(3) - reading%vectors(3, plan%contact)
         if (.not. height > 0.0_wp) call complain(reading, 'contact', &
            'the contact point must lie below the wheel centre, found it '//str(-height/reading%units%length)//' above')
      end if
      call find_spin(reading, plan, this)
      this%gives_spin = plan%spin > 0
      this%has_steer_axis = has_key(reading, 'steer_axis')
      call find_points(reading, 'steer_axis', plan%steer_axis, is_there)
      if (is_there) call check_apart(reading, 'steer_axis', plan%steer_axis, '', is_there)
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'radius', plan%radius)
      call slot(reading, 'tyre_rate', plan%tyre_rate)
      call slot(reading, 'tyre_width', plan%tyre_width)
      call slot(reading, 'sprung_mass', plan%sprung_mass)
      this%name = text_of(reading, 'name')
      this%where = where_of(reading)
      reading%plan%prototype%wheels = [reading%plan%prototype%wheels, this]
      call slot(reading, 'crown_radius', plan%crown_radius)
      reading%plan%wheels = [reading%plan%wheels, plan]
      if (this%has_crown) call compute_contact(reading, plan%contact)
   end subroutine read_wheel

   !> Checks the radii of a wheel with a crown.
   subroutine check_crown(reading)
      type(deck_reading_t), intent(inout) :: reading
      real(wp) :: crown, radius

      if (.not. has_key(reading, 'radius')) then
         call complain(reading, 'crown_radius', "crown_radius needs the radius of the wheel: give 'radius'")
         return
      end if
      if (.not. reading%cards(reading%k)%is_good) return
      crown = number_of(reading, 'crown_radius', 0.0_wp)
      radius = number_of(reading, 'radius', 1.0_wp)
      if (crown >= radius) call complain(reading, 'crown_radius', 'crown_radius must be smaller than radius ('//str(radius)// &
         '), found '//str(crown))
   end subroutine check_crown

   !> Adds the contact point of the last wheel, its lowest point, to the blueprint. A contact point of the deck must be there.
   subroutine compute_contact(reading, given)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(in) :: given               !! index of the vector of the point `contact`; 0: not given
      real(wp), parameter :: tolerance = 1.0e-4_wp         ! m
      real(wp) :: lowest_point(3), off
      integer :: number, w

      w = size(reading%plan%wheels)
      call new_vector(reading, vector_t(kind=lowest, wheel=w), number)
      reading%plan%wheels(w)%contact = number
      if (given == 0) return
      lowest_point = reading%vectors(:, number)
      off = norm2(reading%vectors(:, given) - lowest_point)
      if (off <= tolerance) return
      lowest_point = inward(reading%plan, lowest_point)/reading%units%length
      call complain(reading, 'contact', 'the point '//quoted(text_of(reading, 'contact'))//' is '// &
         str(off/reading%units%length, 3)//' '//unit_name(length, reading%units)// &
         ' away from the lowest point of the wheel, which is at = '//str(lowest_point(1), 8)//', '// &
         str(lowest_point(2), 8)//', '//str(lowest_point(3), 8)//'; correct it, or leave contact out')
   end subroutine compute_contact

   !> Finds the spin axis, from spin_vector or from toe and camber.
   subroutine find_spin(reading, plan, this)
      type(deck_reading_t), intent(inout) :: reading
      type(wheel_plan_t), intent(inout) :: plan
      type(wheel_t), intent(in) :: this
      type(vector_t) :: vector
      real(wp) :: spin(3)

      if (.not. has_key(reading, 'spin_vector')) then
         call slot(reading, 'toe', plan%toe)
         call slot(reading, 'camber', plan%camber)
         return
      end if
      if (has_key(reading, 'toe') .or. has_key(reading, 'camber')) call complain(reading, 'spin_vector', &
         'give either spin_vector or toe and camber, not both')
      if (.not. reading%cards(reading%k)%is_good) return
      if (.not. norm2(numbers_of(reading, 'spin_vector', 3)) > 0.0_wp) then
         call complain(reading, 'spin_vector', 'spin_vector has zero length')
         return
      end if
      vector%kind = given
      call slot(reading, 'spin_vector', vector%first)
      call new_vector(reading, vector, plan%spin)
      spin = reading%vectors(:, plan%spin)
      if (.not. this%side*spin(2) > 0.0_wp) call complain(reading, 'spin_vector', 'spin_vector must point outboard, to the '// &
         text_of(reading, 'side')//' (y points '//trim(merge('left ', 'right', reading%plan%is_iso))//')')
   end subroutine find_spin

   !> Reads &axle: its position (front or rear), the class of the car, the share of the front axle in the braking force, the share of
   !> this axle in the driving force, the points at which the driving and the braking force act, and the vehicle data.
   subroutine read_axle(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: c, number(9)

      if (is_second(reading)) return
      if (has_key(reading, 'front_overhang') .neqv. has_key(reading, 'front_width')) call complain(reading, &
         trim(merge('front_overhang', 'front_width   ', has_key(reading, 'front_overhang'))), &
         'give front_overhang and front_width together (both define the wall-to-wall turning circle)')
      call slot(reading, 'wheelbase', number(1))
      call slot(reading, 'cg_height', number(2))
      call slot(reading, 'mass', number(3))
      call slot(reading, 'brake_share', number(4))
      call slot(reading, 'drive_share', number(5))
      call slot(reading, 'front_overhang', number(6))
      call slot(reading, 'front_width', number(7))
      call slot(reading, 'axle_load', number(8))
      call slot(reading, 'roll_share', number(9))
      reading%plan%axle = number
      associate (this => reading%plan%prototype%axle)
         call choice(reading, 'position', c)
         this%is_front = c == 1
         call choice(reading, 'class', this%class)
         if (has_key(reading, 'front_overhang') .and. c == 2) call complain(reading, 'front_overhang', &
            "front_overhang belongs to the front axle, found position = 'rear'")
         call choice(reading, 'drive_reaction', c)
         this%drives_at_patch = c == 2
         call choice(reading, 'brake_reaction', c)
         this%brakes_at_centre = c == 2
         this%has_axle = .true.
         this%where = where_of(reading)
      end associate
   end subroutine read_axle

   !> Reads &steering: the driver joint of the rack, the rack travel per revolution of the steering wheel, and the largest rack
   !> travel.
   subroutine read_steering(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(:), allocatable :: driver
      integer :: found, number(2)

      if (is_second(reading)) return
      driver = text_of(reading, 'driver')
      call look_up(reading, 'driver', joint_group, driver, found)
      if (found > 0) call check_driver()
      call slot(reading, 'ratio', number(1))
      call slot(reading, 'travel', number(2))
      reading%plan%steering = number
      associate (this => reading%plan%prototype%steering)
         this%has_steering = .true.
         this%where = where_of(reading)
         this%driver = driver
      end associate

   contains

      !> Checks that the joint is a driver that prescribes a length, because ratio and travel are lengths.
      subroutine check_driver()
         integer :: measure

         if (.not. is_driver(reading, found)) then
            call complain(reading, 'driver', 'driver: the joint '//quoted(driver)//' in line '// &
               str(reading%records(found)%line)//' is not a driver')
            return
         end if
         measure = find_card(reading, measure_group, element(reading%records(found), 'measure', 1))
         if (measure == 0) return
         if (reading%cards(measure)%index == 0) return
         if (is_of_angle(reading%plan%prototype%readouts(reading%cards(measure)%index)%measure%kind)) call complain(reading, &
            'driver', 'driver: '//quoted(driver)//' must prescribe a length, but its measure is an angle')
      end subroutine check_driver

   end subroutine read_steering

end module ek_reader_bodies
