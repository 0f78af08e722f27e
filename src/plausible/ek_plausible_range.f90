!> Usual values of road vehicles: one table of ranges, from Formula Student to heavy trucks, with the likely cause of a value
!> outside its range.
!>
!> A value outside its range is converted with the other units of its dimension. The remark names all units that bring the value
!> well into the range, or else into the range. Without such a unit, the remark gives the cause in the table row. No finding is an error.
module ek_plausible_range
   use ek_kinds, only: wp, units_t, millimetre, degree, inch, pound, standard_gravity
   use ek_dimension, only: unit_size, unit_name, pure_number, length_ => length, force_ => force, angle_ => angle, mass_ => mass, &
      rate_ => rate, rotation_rate_ => rotation_rate
   use ek_error, only: message_list_t
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: doubts_t, size_t, size_of, length, rate, rotation_rate, force, is_usual

   ! dimensions
   integer, parameter :: length = 1, rate = 2, rotation_rate = 3, force = 4, moment = 5, angle = 6, mass = 7, share = 8, &
      acceleration = 9, derived = 10, &         ! a length computed from other values
      frequency = 11, slope = 12, derived_rate = 13, &
      wheel_angle = 14, computed_angle = 15     ! toe and camber, which are also measured in minutes; an angle between points

   !> The dimension of a key of the deck with the same unit; the name of a unit that is the same for all decks.
   integer, parameter :: kinds(15) = [length_, rate_, rotation_rate_, force_, pure_number, angle_, mass_, pure_number, &
      pure_number, length_, pure_number, pure_number, rate_, angle_, angle_]
   character(5), parameter :: fixed_names(15) = [character(5) :: '', '', '', '', 'N m', '', '', '1', 'm/s²', '', 'Hz', 'deg/m', &
      '', '', '']

   !> A unit that may have been used by error.
   type :: unit_t
      integer :: dimension
      character(8) :: name
      real(wp) :: size          !! SI value of the unit
   end type unit_t

   !> The units to which a value may belong, in order of likelihood.
   type(unit_t), parameter :: units_tried(*) = [ &
      unit_t(length, 'm', 1.0_wp), unit_t(length, 'mm', 1.0e-3_wp), unit_t(length, 'inches', inch), &
      unit_t(length, 'cm', 0.01_wp), &
      unit_t(rate, 'N/m', 1.0_wp), unit_t(rate, 'kN/mm', 1.0e6_wp), unit_t(rate, 'N/mm', 1.0e3_wp), &
      unit_t(rate, 'lbf/in', pound*standard_gravity/inch), &
      unit_t(rotation_rate, 'N m/rad', 1.0_wp), unit_t(rotation_rate, 'N m/deg', 1.0_wp/degree), &
      unit_t(rotation_rate, 'N mm/rad', 1.0e-3_wp), unit_t(rotation_rate, 'N mm/deg', 1.0e-3_wp/degree), &
      unit_t(force, 'kN', 1.0e3_wp), unit_t(force, 'N', 1.0_wp), unit_t(force, 'kgf', standard_gravity), &
      unit_t(moment, 'N mm', 1.0e-3_wp), unit_t(moment, 'kN m', 1.0e3_wp), unit_t(moment, 'N m', 1.0_wp), &
      unit_t(angle, 'rad', 1.0_wp), unit_t(angle, 'deg', degree), &
      unit_t(wheel_angle, 'minutes', degree/60.0_wp), unit_t(wheel_angle, 'rad', 1.0_wp), unit_t(wheel_angle, 'deg', degree), &
      unit_t(mass, 'g', 1.0e-3_wp), unit_t(mass, 't', 1.0e3_wp), unit_t(mass, 'kg', 1.0_wp), unit_t(share, 'per cent', 0.01_wp), &
      unit_t(acceleration, 'mm/s²', 1.0e-3_wp), unit_t(acceleration, 'g', standard_gravity)]

   !> The usual range of one quantity. The range applies to the magnitude unless `low` is negative.
   type :: range_t
      character(28) :: quantity
      integer :: dimension
      real(wp) :: low, high     !! limits, by dimension in mm, N/mm, N mm/deg, N, N m, deg, kg, 1, m/s², Hz, deg/m
      logical :: may_be_zero
      character(100) :: suspect  !! likely cause or hint if no other unit fits
   end type range_t

   ! The limits are those of existing vehicles, widened: Formula Student (10 inch wheels, 1.5 m wheelbase, springs of 15 N/mm),
   ! race cars (springs of 1000 N/mm), heavy trucks (leaf springs of 3000 N/mm, 1 t axles, 8 m wheelbase).
   type(range_t), parameter :: ranges(*) = [ &
      range_t('half track', length, 400.0_wp, 1400.0_wp, .false., 'check that y is lateral and 0 in the middle of the car'), &
      range_t('wheel radius', length, 180.0_wp, 750.0_wp, .false., 'is it the diameter?'), &
      range_t('height of centre', length, 150.0_wp, 750.0_wp, .false., 'check that z has the same origin for all points'), &
      range_t('contact offset', derived, 0.0_wp, 80.0_wp, .true., 'the contact point lies below the centre; check x and y'), &
      range_t('static toe', wheel_angle, -1.5_wp, 1.5_wp, .true., 'toe is given in degrees'), &
      range_t('static camber', wheel_angle, -8.0_wp, 5.0_wp, .true., 'camber is given in degrees; negative: top inward'), &
      range_t('tyre rate', rate, 50.0_wp, 2500.0_wp, .false., 'give the vertical stiffness of one tyre'), &
      range_t('wheelbase', length, 1200.0_wp, 8000.0_wp, .false., 'is it the track?'), &
      range_t('cg height', length, 150.0_wp, 2500.0_wp, .false., 'give the height of the car''s centre of gravity over the road'), &
      range_t('brake share', share, 0.3_wp, 0.95_wp, .false., 'give the share of the FRONT axle, also on a rear axle'), &
      range_t('rack ratio', length, 20.0_wp, 150.0_wp, .false., 'give the rack travel per revolution, not the steering ratio'), &
      range_t('rack travel', length, 10.0_wp, 250.0_wp, .false., 'give the travel to each side'), &
      range_t('spring rate', rate, 3.0_wp, 3000.0_wp, .false., 'give the rate of one spring along its axis'), &
      range_t('rod rate', rate, 3000.0_wp, 1.0e6_wp, .false., 'give the stiffness of the rod along its axis'), &
      range_t('length at design', derived, 30.0_wp, 1500.0_wp, .false., 'check its two points'), &
      range_t('static compression', length, 0.0_wp, 500.0_wp, .true., 'preload and rate do not fit together'), &
      range_t('gas force', force, 5.0_wp, 5000.0_wp, .true., 'give the gas force at design'), &
      range_t('gas rate', rate, 0.01_wp, 100.0_wp, .true., 'give the increase of the gas force per compression'), &
      range_t('clearance', length, 0.5_wp, 250.0_wp, .true., 'give the distance from design to contact'), &
      range_t('rounding', length, 0.0_wp, 10.0_wp, .true., 'such a long transition belongs in the curve'), &
      range_t('stop rate', rate, 3.0_wp, 50000.0_wp, .false., 'give the force per penetration'), &
      range_t('bushing rate kt', rate, 5.0_wp, 1.0e6_wp, .true., 'not in the range of rubber; for a rigid link use a joint'), &
      range_t('bushing rate kr', rotation_rate, 2.0_wp, 5.0e7_wp, .true., &
      'not in the range of rubber; for a rigid link use a joint'), &
      range_t('bushing gap', length, 0.0_wp, 20.0_wp, .true., 'its two points are apart; check their names'), &
      range_t('torsion bar rate', rotation_rate, 1500.0_wp, 1.0e6_wp, .false., 'give the rate between the halves of the bar'), &
      range_t('torsion element rate', rotation_rate, 20.0_wp, 5.0e7_wp, .false., 'give the moment per angle'), &
      range_t('torsion spring rate', rotation_rate, 500.0_wp, 5.0e7_wp, .false., 'give the moment per angle'), &
      range_t('driver stiffness', rate, 20.0_wp, 1.0e6_wp, .false., 'give the stiffness at the rack'), &
      range_t('span of the curve', length, 0.5_wp, 600.0_wp, .false., 'its x is a deflection in the deck''s unit'), &
      range_t('angular span of the curve', angle, 0.2_wp, 400.0_wp, .false., 'its x is an angle in the deck''s unit'), &
      range_t('largest force of the curve', force, 30.0_wp, 1.0e6_wp, .false., 'its y is a force in the deck''s unit'), &
      range_t('slope of the curve', rate, 0.1_wp, 1.0e6_wp, .true., 'its x and y are in the deck''s units'), &
      range_t('static wheel load', force, 450.0_wp, 70000.0_wp, .false., 'give the load on one wheel'), &
      range_t('mass', mass, 0.1_wp, 1500.0_wp, .false., 'give the mass of one body of the suspension'), &
      range_t('mass of a link', mass, 0.02_wp, 1500.0_wp, .false., 'give the mass of one body of the suspension'), &
      range_t('gravity', acceleration, 9.0_wp, 10.5_wp, .true., 'gravity is in m/s², regardless of the deck''s units'), &
      range_t('wheel travel', length, 2.0_wp, 400.0_wp, .false., 'give the travel of a wheel from design'), &
      range_t('roll angle', angle, 0.1_wp, 12.0_wp, .false., 'give the roll angle of the axle'), &
      range_t('rack displacement', length, 1.0_wp, 300.0_wp, .false., 'give the displacement of the rack from design'), &
      range_t('test force', force, 30.0_wp, 150000.0_wp, .false., 'give the force on one wheel'), &
      range_t('test moment', moment, 1.0_wp, 5000.0_wp, .false., 'the moment is in N m, regardless of the deck''s units'), &
      range_t('offset of the force', length, 0.0_wp, 200.0_wp, .true., 'give a pneumatic trail'), &
      range_t('caster of a front axle', computed_angle, -3.0_wp, 20.0_wp, .true., &
      'usually the top is rearward; check axes and sign of x'), &
      range_t('caster', computed_angle, -25.0_wp, 25.0_wp, .true., 'check the points of the steering axis'), &
      range_t('kingpin inclination', computed_angle, -6.0_wp, 30.0_wp, .true., &
      'is the upper point outboard of the lower one?'), &
      range_t('scrub radius', derived, -150.0_wp, 250.0_wp, .true., 'check the points of the steering axis'), &
      range_t('mechanical trail', derived, -100.0_wp, 200.0_wp, .true., 'check the points of the steering axis'), &
      range_t('link length', derived, 20.0_wp, 2500.0_wp, .false., 'check its two points'), &
      ! response at design; sources below the table
      range_t('wheel rate', derived_rate, 2.0_wp, 3000.0_wp, .false., 'check the rods and levers between wheel and spring'), &
      range_t('ride frequency', frequency, 0.4_wp, 10.0_wp, .false., &
      'spring, levers and wheel load do not fit together'), &
      range_t('motion ratio', share, 0.2_wp, 2.0_wp, .true., &
      'is a rocker or lever near its dead centre, or an arm of it wrong?'), &
      range_t('bump toe', slope, -50.0_wp, 50.0_wp, .true., 'check both ends of the tie rod or toe link'), &
      range_t('bump camber', slope, -200.0_wp, 200.0_wp, .true., 'check the ball joints and the inner points of the arms'), &
      range_t('size √(kr/kt)', derived, 1.0_wp, 300.0_wp, .true., 'kr and kt do not fit together')]

   ! Sources of the ranges of the response. Ride frequency, of the wheel rate without the tyre and the load on the wheel: 0.5 to
   ! 1.5 Hz of passenger cars, 1.5 to 2 Hz of touring cars, 3 to 5 Hz and more of race cars with downforce (M. Giaraffa, OptimumG,
   ! Springs & Dampers, part 1; Milliken & Milliken, Race Car Vehicle Dynamics, chapter 16), widened by a factor of two. Motion
   ! ratio: 0.5 to 1 (from these sources), widened by two. Wheel rate: from the spring rates above with these motion ratios. Bump
   ! camber: the inverse of the length of the front-view swing arm, no shorter than 0.3 m, three quarters of the narrowest half
   ! track of the table. Bump toe: five times the largest of production cars (10 deg/m, suspensiondesigner.com, KPI - Bump/Roll
   ! Steer). Both are per radius of a car's wheel: a smaller wheel travels less. Compliances have no range: no source covers both
   ! trucks and race cars.

   integer, parameter :: any_size = 0, light = 1, car = 2, heavy = 3

   !> The size of a vehicle: a class with ranges of its own, and the scale of a model car.
   type :: size_t
      private
      integer :: class = any_size
      real(wp) :: scale = 1.0_wp       !! lengths of a model car as a share of those of a car
      real(wp) :: wheel = 1.0_wp       !! radius of the wheel as a share of that of a car
   end type size_t

   !> The range of a quantity for one class.
   type :: class_range_t
      integer :: class
      character(28) :: quantity
      real(wp) :: low, high            !! as in `ranges`
   end type class_range_t

   ! Light: Formula Student and cars with wheels up to 13 inch. Heavy: trucks and buses; a drag link
   ! steers a beam axle in bump. The limits are those of existing vehicles, widened.
   type(class_range_t), parameter :: class_ranges(*) = [ &
      class_range_t(light, 'half track', 400.0_wp, 900.0_wp), class_range_t(car, 'half track', 450.0_wp, 1200.0_wp), &
      class_range_t(heavy, 'half track', 600.0_wp, 1400.0_wp), class_range_t(light, 'wheel rate', 2.0_wp, 500.0_wp), &
      class_range_t(car, 'wheel rate', 3.0_wp, 1500.0_wp), class_range_t(heavy, 'wheel rate', 10.0_wp, 3000.0_wp), &
      class_range_t(heavy, 'bump toe', -100.0_wp, 100.0_wp)]

   !> The remarks without repetition. Both sides of a mirrored deck have the same line and give one remark.
   type :: doubts_t
      type(message_list_t) :: remarks
      type(units_t) :: units = units_t()               !! units of the deck
      type(size_t) :: size = size_t()                  !! size of the vehicle
      character(:), allocatable, private :: where, thing   !! location and name of the examined item: file:line, "spring 'coil'"
      type(message_list_t), private :: seen
   contains
      procedure :: examine
      procedure :: add
      procedure :: judge
      procedure :: speak
   end type doubts_t

contains

   !> Sets the item to which the next remarks refer.
   pure subroutine examine(self, where, thing)
      class(doubts_t), intent(inout) :: self
      character(*), intent(in) :: where        !! file:line
      character(*), intent(in) :: thing        !! "spring 'coil'", '' for a remark without a heading

      self%where = where
      self%thing = thing
   end subroutine examine

   !> Adds a remark of a rule, at most once per rule and line of the deck.
   pure subroutine add(self, rule, text)
      class(doubts_t), intent(inout) :: self
      character(*), intent(in) :: rule, text
      integer :: k

      do k = 1, self%seen%count()
         if (self%seen%line(k) == rule//' '//self%where) return
      end do
      call self%seen%add(rule//' '//self%where)
      call self%remarks%add(head(self%where)//head(self%thing)//text)

   contains

      pure function head(of)
         character(*), intent(in) :: of
         character(:), allocatable :: head
         head = ''
         if (len(of) > 0) head = of//': '
      end function head

   end subroutine add

   !> Compares a value with the usual range of its quantity, and adds a remark if the value is outside this range.
   pure subroutine judge(self, quantity, value, detail, rim, is_computed)
      class(doubts_t), intent(inout) :: self
      character(*), intent(in) :: quantity     !! quantity of a row of `ranges`
      real(wp), intent(in) :: value            !! SI
      character(*), intent(in), optional :: detail   !! follows the likely cause of the table
      real(wp), intent(in), optional :: rim    !! diameter [m] over which the angle may be given in mm
      logical, intent(in), optional :: is_computed   !! the deck does not give the value: no unit is suggested
      type(range_t) :: row
      real(wp) :: x, unit, usual
      character(:), allocatable :: text, names, meanings
      logical :: tries_units
      integer :: k

      k = findloc(ranges%quantity, quantity, dim=1)
      if (k == 0) then      ! a programming error: found by the tests, which expect no remark on a sound deck
         call self%add(quantity, 'no range for '//quantity)
         return
      end if
      row = row_of(k, self%size)
      unit = deck_unit(row%dimension, self%units)
      usual = deck_unit(row%dimension, units_t())
      x = value
      if (row%low >= 0.0_wp) x = abs(value)        ! the sign does not matter
      if (row%may_be_zero .and. abs(x) <= 0.0_wp) return
      if (is_within(row, x)) return
      names = ''
      meanings = ''
      tries_units = .true.
      if (present(is_computed)) tries_units = .not. is_computed
      if (tries_units) call try_units(2.0_wp, names, meanings)
      if (tries_units .and. names == '') call try_units(1.0_wp, names, meanings)
      text = trim(row%suspect)
      if (present(detail)) text = text//detail
      if (names /= '') text = 'looks like '//names//': '//meanings
      call self%add(quantity, trim(quantity)//' '//self%speak(row%dimension, x)//' (usual range: '// &
         short(row%low*usual/unit)//' to '//self%speak(row%dimension, row%high*usual)//'); '//text)

   contains

      !> Lists the units with which the value is in the range, and by a factor of `inside` from both limits.
      pure subroutine try_units(inside, names, meanings)
         real(wp), intent(in) :: inside
         character(:), allocatable, intent(inout) :: names, meanings
         integer :: u

         do u = 1, size(units_tried)
            if (units_tried(u)%dimension == row%dimension .and. units_tried(u)%name /= deck_name(row%dimension, self%units)) &
               call try(trim(units_tried(u)%name), x/unit*units_tried(u)%size, inside, names, meanings)
         end do
         if (present(rim) .and. abs(self%units%length - millimetre) <= 0.0_wp) &
            call try('mm at the rim', atan(x/unit*1.0e-3_wp/rim), inside, names, meanings)
      end subroutine try_units

      !> Lists a unit, if the value is in the range with it.
      pure subroutine try(name, meant, inside, names, meanings)
         character(*), intent(in) :: name
         real(wp), intent(in) :: meant            ! SI
         real(wp), intent(in) :: inside
         character(:), allocatable, intent(inout) :: names, meanings

         if (.not. is_within(row, meant) .or. .not. is_within(row, meant*inside)) return
         if (row%low > 0.0_wp .and. .not. is_within(row, meant/inside)) return
         if (names /= '') then
            names = names//' or '
            meanings = meanings//', '
         end if
         names = names//name
         meanings = meanings//short(x/unit)//' '//name//' would be '//self%speak(row%dimension, meant)
      end subroutine try

   end subroutine judge

   !> Whether a value is in the range of its quantity.
   pure logical function is_usual(quantity, value)
      character(*), intent(in) :: quantity     !! quantity of a row of `ranges`
      real(wp), intent(in) :: value            !! SI
      integer :: k

      k = findloc(ranges%quantity, quantity, dim=1)
      is_usual = k > 0
      if (is_usual) is_usual = is_within(ranges(k), value)
   end function is_usual

   !> Row k of the table for a size of vehicle: the narrower range of its class, or the range of a model car of this scale. Forces of
   !> a model are proportional to its volume, so that its rates are to its area. Angles per travel are to the inverse of the radius of
   !> the wheel.
   pure type(range_t) function row_of(k, size_of_car) result(row)
      integer, intent(in) :: k
      type(size_t), intent(in) :: size_of_car
      real(wp) :: factor
      integer :: c

      row = ranges(k)
      do c = 1, size(class_ranges)
         if (class_ranges(c)%class /= size_of_car%class .or. class_ranges(c)%quantity /= row%quantity) cycle
         row%low = class_ranges(c)%low
         row%high = class_ranges(c)%high
      end do
      select case (row%dimension)
      case (length, derived)
         factor = size_of_car%scale
      case (rate, derived_rate)
         factor = size_of_car%scale**2
      case (force, mass)
         factor = size_of_car%scale**3
      case (rotation_rate, moment)
         factor = size_of_car%scale**4
      case (frequency)
         factor = 1.0_wp/sqrt(size_of_car%scale)
      case (slope)
         factor = 1.0_wp/size_of_car%wheel
      case default
         return
      end select
      row%low = factor*row%low
      row%high = factor*row%high
   end function row_of

   !> The size of a vehicle by the radius of its wheels and its wheelbase. A wheel below 120 mm is that of a model car if loads and
   !> springs are those of a model, too; otherwise its unit is doubtful.
   pure type(size_t) function size_of(radius, wheelbase, largest_load, least_rate) result(size_of_car)
      real(wp), intent(in) :: radius           !! m
      real(wp), intent(in) :: wheelbase        !! m; 0: not known
      real(wp), intent(in) :: largest_load     !! largest constant load on a wheel [N]; 0: none
      real(wp), intent(in) :: least_rate       !! smallest rate of a spring [N/m]; 0: none
      real(wp), parameter :: usual_radius = 0.31_wp, largest_model = 0.12_wp, smallest_model = 0.008_wp, &
         largest_wheel = 0.75_wp

      if (radius > smallest_model) size_of_car%wheel = min(radius, largest_wheel)/usual_radius
      if (radius >= 0.18_wp .and. radius <= 0.275_wp .and. wheelbase < 1.75_wp) then
         size_of_car%class = light
      else if (radius >= 0.4_wp .and. radius <= 0.75_wp) then
         size_of_car%class = heavy
      else if (radius >= 0.24_wp .and. radius < 0.4_wp .and. wheelbase < 3.6_wp) then
         size_of_car%class = car
      else if (radius > smallest_model .and. radius < largest_model) then
         if (max(largest_load, least_rate) > 0.0_wp .and. largest_load < 60.0_wp .and. least_rate < 3.0e3_wp) &
            size_of_car%scale = radius/usual_radius
      end if
   end function size_of

   !> Whether a value (SI) is within the range of a table row.
   pure logical function is_within(row, value)
      type(range_t), intent(in) :: row
      real(wp), intent(in) :: value
      real(wp), parameter :: rim = 1.0e-9_wp
      real(wp) :: x, widening

      x = value/deck_unit(row%dimension, units_t())
      widening = rim*max(abs(row%low), abs(row%high))
      is_within = x >= row%low - widening .and. x <= row%high + widening
   end function is_within

   !> A value with the unit of the deck: '29.77 N/mm'.
   pure function speak(self, dimension, value) result(text)
      class(doubts_t), intent(in) :: self
      integer, intent(in) :: dimension
      real(wp), intent(in) :: value            !! SI
      character(:), allocatable :: text

      text = short(value/deck_unit(dimension, self%units))
      if (dimension /= share) text = text//' '//deck_name(dimension, self%units)
   end function speak

   !> A number with five significant digits; with nine from 1e5 to 1e9.
   pure function short(x) result(text)
      real(wp), intent(in) :: x
      character(:), allocatable :: text
      text = str(x, merge(9, 5, abs(x) >= 1.0e5_wp .and. abs(x) < 1.0e9_wp))
   end function short

   !> SI value of the deck's unit of a dimension.
   pure real(wp) function deck_unit(dimension, units) result(unit)
      integer, intent(in) :: dimension
      type(units_t), intent(in) :: units

      unit = unit_size(kinds(dimension), units)
      if (dimension == slope) unit = degree
   end function deck_unit

   !> Name of the deck's unit of a dimension.
   pure function deck_name(dimension, units) result(name)
      integer, intent(in) :: dimension
      type(units_t), intent(in) :: units
      character(:), allocatable :: name

      name = trim(fixed_names(dimension))
      if (name == '') name = unit_name(kinds(dimension), units)
   end function deck_name

end module ek_plausible_range
