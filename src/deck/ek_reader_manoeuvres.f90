!> &manoeuvre: load factor and accelerations of the car, for the wheel loads of test 'manoeuvres'.
module ek_reader_manoeuvres
   use ek_kinds, only: wp
   use ek_dimension, only: mass, unit_name
   use ek_blueprint, only: manoeuvre_plan_t
   use ek_case, only: manoeuvre_t
   use ek_text, only: lower, str
   use ek_group, only: axle_group, manoeuvre_group, wheel_group, steering_group, joint_group
   use ek_record, only: is_given, element
   use ek_reference, only: find_card, is_driver
   use ek_deck_reading, only: deck_reading_t, complain, refuse, where_of, line_of, has_key, choice, text_of, number_of, slot, &
      unit_of
   implicit none(type, external)
   private
   public :: read_manoeuvre

contains

   !> Reads a manoeuvre. A record with `set` only names a set, whose manoeuvres are separate records (ek_manoeuvre_records).
   subroutine read_manoeuvre(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(manoeuvre_plan_t) :: plan
      integer :: c, usual

      if (has_key(reading, 'set')) then
         call choice(reading, 'set', c)
         call refuse(reading, [character(16) :: 'name', 'vertical', 'longitudinal', 'lateral', 'longitudinal_by', 'side', &
            'wheels', 'downforce', 'steer'], &
            'a set has its own numbers; to replace a manoeuvre of the set, give a &manoeuvre with its name')
         return
      end if
      if (.not. has_key(reading, 'name')) call complain(reading, '', "give 'name', or 'set' for a set of manoeuvres")
      associate (this => plan%manoeuvre)
         this%name = text_of(reading, 'name')
         this%where = where_of(reading)
         this%vertical = number_of(reading, 'vertical', 1.0_wp)
         this%longitudinal = number_of(reading, 'longitudinal', 0.0_wp)
         this%lateral = number_of(reading, 'lateral', 0.0_wp)
         this%has_wheels = has_key(reading, 'wheels')
         if (this%has_wheels) call refuse(reading, [character(8) :: 'vertical', 'side'], &
            'wheels gives the load factor of each wheel')
         call read_side(reading, this%side)
         usual = merge(1, 2, this%longitudinal < 0.0_wp)
         if (this%side > 0) usual = 3
         call choice(reading, 'longitudinal_by', c, default=usual)
         this%is_braked = c == 1
         this%hits_obstacle = c == 3
         if (c == 3 .and. this%side == 0) call complain(reading, 'longitudinal_by', "longitudinal_by = 'obstacle' needs side: "// &
            'the wheel that hits the obstacle')
         if (this%has_wheels) this%wheels = [number_of(reading, 'wheels', 1.0_wp, 1), number_of(reading, 'wheels', 1.0_wp, 2)]
         this%downforce = number_of(reading, 'downforce', 0.0_wp)*unit_of(reading, 'downforce')
         if (has_key(reading, 'steer')) call find_steering(reading, plan%manoeuvre)
         this%steer = number_of(reading, 'steer', 0.0_wp)*unit_of(reading, 'steer')
         call check_car(reading, this%side == 0 .and. (abs(this%longitudinal) > 0.0_wp .or. abs(this%lateral) > 0.0_wp))
      end associate
      if (.not. reading%cards(reading%k)%is_good) return
      if (.not. plan%manoeuvre%has_wheels) call slot(reading, 'vertical', plan%vertical)
      call slot(reading, 'longitudinal', plan%longitudinal)
      call slot(reading, 'lateral', plan%lateral)
      call slot(reading, 'wheels', plan%wheels)
      call slot(reading, 'downforce', plan%downforce)
      call slot(reading, 'steer', plan%steer)
      reading%plan%manoeuvres = [reading%plan%manoeuvres, plan]
      reading%cards(reading%k)%index = size(reading%plan%manoeuvres)
   end subroutine read_manoeuvre

   !> Reads the side of the wheel that a manoeuvre of one wheel loads. The deck must have a wheel on this side.
   subroutine read_side(reading, side)
      type(deck_reading_t), intent(inout) :: reading
      integer, intent(out) :: side           !! 1 left, 2 right, 0: not given
      character(5), parameter :: sides(2) = [character(5) :: 'left', 'right']      ! as in ek_choices
      integer :: j

      call choice(reading, 'side', side)
      if (side == 0 .or. .not. any(reading%cards%group == wheel_group)) return
      if (.not. any([(reading%cards(j)%group == wheel_group .and. lower(element(reading%records(j), 'side', 1)) == sides(side), &
         j=1, size(reading%cards))])) call complain(reading, 'side', 'side: the deck has no '//trim(sides(side))//' wheel')
   end subroutine read_side

   !> Finds the steering driver that a manoeuvre holds: the driver of &steering, otherwise the only driver of the deck. The dimension
   !> of `steer` is that of this driver.
   subroutine find_steering(reading, this)
      type(deck_reading_t), intent(inout) :: reading
      type(manoeuvre_t), intent(inout) :: this
      logical :: is_one(size(reading%cards))
      integer :: j, found

      is_one = [(is_driver(reading, j), j=1, size(reading%cards))]
      j = findloc(reading%cards%group, steering_group, dim=1)
      if (j > 0) then
         found = find_card(reading, joint_group, element(reading%records(j), 'driver', 1))
         if (found == 0) return              ! reported with &steering
      else if (count(is_one) == 1) then
         found = findloc(is_one, .true., dim=1)
      else
         call complain(reading, 'steer', 'steer needs a steering driver, found '// &
            'no &steering and '//str(count(is_one))//' driver joints: add &steering with its driver')
         return
      end if
      reading%cards(reading%k)%deflection = reading%cards(found)%deflection
      this%driver = trim(reading%cards(found)%name)
   end subroutine find_steering

   !> Checks that the deck has the data of the car that a manoeuvre needs: &axle with `mass` for an acceleration, and gravity if
   !> bodies have masses. A manoeuvre after a manoeuvre with an error is not checked, so that a missing number is reported once.
   subroutine check_car(reading, is_accelerated)
      type(deck_reading_t), intent(inout) :: reading
      logical, intent(in) :: is_accelerated
      integer :: axle

      if (any(reading%cards(:reading%k - 1)%group == manoeuvre_group .and. .not. reading%cards(:reading%k - 1)%is_good)) return
      axle = findloc(reading%cards%group, axle_group, dim=1)
      if (is_accelerated .and. axle == 0) then
         call complain(reading, '', 'longitudinal and lateral need the data of the car, found no &axle: add &axle with '// &
            'wheelbase, cg_height, brake_share and mass')
      else if (is_accelerated) then
         if (.not. is_given(reading%records(axle), 'mass')) call complain(reading, '', &
            'longitudinal and lateral need the mass of the car, found no mass in &axle in '//line_of(reading, axle)// &
            ': add mass, in '//unit_name(mass, reading%units))
      end if
      if (any(reading%plan%prototype%bodies%mass > 0.0_wp) .and. .not. reading%plan%prototype%gravity > 0.0_wp) call complain( &
         reading, '', 'bodies have masses, which need their weight in manoeuvres, found no gravity in &model: add gravity = 9.81')
   end subroutine check_car

end module ek_reader_manoeuvres
