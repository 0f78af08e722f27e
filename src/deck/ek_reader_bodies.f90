!> &point, &body, &mass and &load; &wheel: the wheels whose attitude is reported; &axle and &steering: data of the vehicle around
!> the suspension, at most one of each.
module ek_reader_bodies
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_record, only: single, left_side, right_side, element
   use ek_measure, only: is_of_angle
   use ek_suspension, only: body_t, load_t, wheel_t
   use ek_blueprint, only: vector_t, body_plan_t, mass_plan_t, load_plan_t, wheel_plan_t, hardpoint, given, off_left, off_right, &
      in_plane
   use ek_design_vector, only: plane
   use ek_group, only: joint_group, measure_group
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, switch_of, number_of, numbers_of, is_second, slot
   use ek_reference, only: look_up, find_card, find_point, find_points, find_moving_body, check_apart, is_driver, new_vector
   implicit none(type, external)
   private
   public :: read_point, read_body, read_mass, read_load, read_wheel, read_axle, read_steering

contains

   !> &point: a design position.
   subroutine read_point(draft)
      type(draft_t), intent(inout) :: draft
      type(vector_t) :: vector
      integer :: number

      vector%kind = hardpoint
      call slot(draft, 'at', draft%units%length, vector%first, default=0.0_wp, count=3)
      call new_vector(draft, vector, number)
      draft%cards(draft%k)%index = number
      associate (stays => draft%plan%vectors(number)%stays, side => draft%records(draft%k)%side)
         if (side == left_side) stays = off_left
         if (side == right_side) stays = off_right
         if (side == single .and. abs(draft%vectors(2, number)) < plane .and. any(draft%records%side /= single)) stays = in_plane
      end associate
   end subroutine read_point

   !> &body.
   subroutine read_body(draft)
      type(draft_t), intent(inout) :: draft
      type(body_plan_t) :: plan
      type(body_t) :: body
      logical :: is_found, has_centre

      call find_point(draft, 'origin', text_of(draft, 'origin'), plan%origin, is_found)
      call find_point(draft, 'centre', text_of(draft, 'centre'), plan%centre, has_centre)
      if (has_key(draft, 'mass') .neqv. has_key(draft, 'centre')) call complain(draft, &
         trim(merge('mass  ', 'centre', has_key(draft, 'mass'))), 'give mass and centre (of gravity) together')
      call slot(draft, 'mass', 1.0_wp, plan%mass)
      body%name = text_of(draft, 'name')
      body%where = where_of(draft)
      body%has_origin = plan%origin > 0
      body%mass = number_of(draft, 'mass', 0.0_wp)
      draft%plan%prototype%bodies = [draft%plan%prototype%bodies, body]
      draft%plan%bodies = [draft%plan%bodies, plan]
      draft%cards(draft%k)%index = size(draft%plan%bodies)
   end subroutine read_body

   !> &mass: a further mass of a body, in addition to that of &body.
   subroutine read_mass(draft)
      type(draft_t), intent(inout) :: draft
      type(mass_plan_t) :: plan
      logical :: has_body, has_place

      call find_moving_body(draft, plan%body, has_body)
      call find_point(draft, 'at', text_of(draft, 'at'), plan%at, has_place)
      if (.not. draft%cards(draft%k)%is_good .or. .not. has_body .or. .not. has_place) return
      call slot(draft, 'kg', 1.0_wp, plan%kg)
      associate (body => draft%plan%prototype%bodies(plan%body))      ! whether it has a weight
         body%mass = body%mass + number_of(draft, 'kg', 1.0_wp)
      end associate
      draft%plan%masses = [draft%plan%masses, plan]
   end subroutine read_mass

   !> &load: force and moment in global axes.
   subroutine read_load(draft)
      type(draft_t), intent(inout) :: draft
      type(load_plan_t) :: plan
      type(load_t) :: element
      logical :: has_body, is_found
      integer :: c

      call find_moving_body(draft, element%body, has_body)
      call find_point(draft, 'at', text_of(draft, 'at'), plan%at, is_found)
      call choice(draft, 'factor', [character(8) :: 'constant', 'case'], c, default=1)
      if (.not. (has_key(draft, 'force') .or. has_key(draft, 'moment'))) &
         call complain(draft, '', "give 'force' or 'moment'")
      element%is_case = c /= 1
      ! stored for a rejected load too: a case may check whether it is scaled
      draft%cards(draft%k)%is_used = element%is_case
      if (.not. draft%cards(draft%k)%is_good) return

      call slot(draft, 'force', draft%units%force, plan%force, default=0.0_wp, count=3)
      call slot(draft, 'moment', draft%units%force*draft%units%length, plan%moment, default=0.0_wp, count=3)
      element%name = text_of(draft, 'name')
      element%where = where_of(draft)
      element%follows = switch_of(draft, 'follows', .false.)
      draft%plan%prototype%loads = [draft%plan%prototype%loads, element]
      draft%plan%loads = [draft%plan%loads, plan]
   end subroutine read_load

   !> &wheel.
   subroutine read_wheel(draft)
      type(draft_t), intent(inout) :: draft
      type(wheel_plan_t) :: plan
      type(wheel_t) :: this
      real(wp) :: height, centre(3)
      logical :: has_body, has_centre, has_contact, is_there
      integer :: c

      draft%cards(draft%k)%index = 1 + count(draft%cards(:draft%k - 1)%group == draft%cards(draft%k)%group)
      call find_moving_body(draft, this%body, has_body)
      call choice(draft, 'side', [character(5) :: 'left', 'right'], c)
      this%side = merge(-1, 1, c == 1)
      call find_point(draft, 'centre', text_of(draft, 'centre'), plan%centre, has_centre)
      call find_point(draft, 'contact', text_of(draft, 'contact'), plan%contact, has_contact)
      centre = draft%vectors(:, plan%centre)
      ! a left wheel on the right side would reverse the signs of its results
      if (has_centre .and. c > 0 .and. this%side*centre(2) < 0.0_wp) call complain(draft, 'side', 'side is '// &
         quoted(text_of(draft, 'side'))//', but the centre '//quoted(text_of(draft, 'centre'))// &
         ' lies on the other side (y points '//trim(merge('left ', 'right', draft%plan%is_iso))//')')
      if (has_centre .and. has_contact) then
         height = centre(3) - draft%vectors(3, plan%contact)
         if (.not. height > 0.0_wp) call complain(draft, 'contact', &
            'the contact point must lie below the wheel centre, found it '//str(-height/draft%units%length)//' above')
      end if
      call find_spin(draft, plan, this)
      this%has_steer_axis = has_key(draft, 'steer_axis')
      call find_points(draft, 'steer_axis', plan%steer_axis, is_there)
      if (is_there) call check_apart(draft, 'steer_axis', plan%steer_axis, '', is_there)
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'radius', draft%units%length, plan%radius)
      call slot(draft, 'tyre_rate', draft%units%force/draft%units%length, plan%tyre_rate)
      call slot(draft, 'tyre_width', draft%units%length, plan%tyre_width)
      call slot(draft, 'sprung_mass', 1.0_wp, plan%sprung_mass)
      this%name = text_of(draft, 'name')
      this%where = where_of(draft)
      draft%plan%prototype%wheels = [draft%plan%prototype%wheels, this]
      draft%plan%wheels = [draft%plan%wheels, plan]
   end subroutine read_wheel

   !> The spin axis, from spin_vector or from toe and camber.
   subroutine find_spin(draft, plan, this)
      type(draft_t), intent(inout) :: draft
      type(wheel_plan_t), intent(inout) :: plan
      type(wheel_t), intent(in) :: this
      type(vector_t) :: vector
      real(wp) :: spin(3)

      if (.not. has_key(draft, 'spin_vector')) then
         call slot(draft, 'toe', draft%units%angle, plan%toe, default=0.0_wp)
         call slot(draft, 'camber', draft%units%angle, plan%camber, default=0.0_wp)
         return
      end if
      if (has_key(draft, 'toe') .or. has_key(draft, 'camber')) call complain(draft, 'spin_vector', &
         'give either spin_vector or toe and camber, not both')
      if (.not. draft%cards(draft%k)%is_good) return
      if (.not. norm2(numbers_of(draft, 'spin_vector', 3)) > 0.0_wp) then
         call complain(draft, 'spin_vector', 'spin_vector has zero length')
         return
      end if
      vector%kind = given
      call slot(draft, 'spin_vector', 1.0_wp, vector%first, count=3)
      call new_vector(draft, vector, plan%spin)
      spin = draft%vectors(:, plan%spin)
      if (.not. this%side*spin(2) > 0.0_wp) call complain(draft, 'spin_vector', 'spin_vector must point outboard, to the '// &
         text_of(draft, 'side')//' (y points '//trim(merge('left ', 'right', draft%plan%is_iso))//')')
   end subroutine find_spin

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

         if (.not. is_driver(draft, found)) then
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

end module ek_reader_bodies
