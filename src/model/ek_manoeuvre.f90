!> Manoeuvres of the car: the forces of the road on the wheels of an axle, from the load factor and the accelerations of the car.
!>
!> With g the gravity of the deck (standard gravity if the deck has none), m the mass of the car, h the height of its centre of
!> gravity, L the wheelbase, t the track, and N0 the load of the axle when the car stands:
!>
!>     axle load          N  = n N0 ± m g a_x h/L + D      + rear axle, a_x: acceleration forward per g, D: downforce on the axle
!>     load transfer      ΔN = s m g a_y h/t               from the inner to the outer wheel, s: roll share of the axle
!>     lateral force      N0 a_y                           in proportion to the vertical forces of the wheels
!>     longitudinal force m g a_x × share of the axle      share of the brakes or of the drive, in the same proportion
!>
!> A wheel that lifts carries 0, and the other wheel carries the load of the axle. In a deck with one wheel, the other wheel is its
!> mirror image. The masses of the deck carry m (n − 1) g downward and m g a against the acceleration, in addition to their weights.
!>
!> With a load factor n_k of each wheel, n_k N0_k replaces n N0_k, the part of the wheel in n N0. In a manoeuvre of one wheel, the
!> car is not accelerated: the wheel with the load N0_k when the car stands carries n N0_k upward, a_x N0_k forward and a_y N0_k to
!> the left, and the other wheel carries its load when the car stands. In both, each mass has the factors of the wheel on its side.
module ek_manoeuvre
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, manoeuvre_t
   use ek_wheel_side, only: left_and_right, design_track, share_on_wheel
   implicit none(type, external)
   private
   public :: has_manoeuvres, wheel_forces, set_manoeuvre_values, standing_load, gravity_of, axle_fault, manoeuvre_fault, can_drive
   public :: vertical_column, lateral_column, brake_column, drive_column, obstacle_column, columns_of_side, inertia_column, &
      steer_column, has_sides

   ! columns of the inputs of a manoeuvre: five for each side; three for the masses of the car, on the left and on the right; steering
   integer, parameter :: vertical_column = 1, lateral_column = 2, brake_column = 3, drive_column = 4, obstacle_column = 5, &
      columns_of_side = 5
   integer, parameter :: inertia_column(3, 0:2) = reshape([11, 12, 13, 14, 15, 16, 17, 18, 19], [3, 3])
   integer, parameter :: steer_column = 20

   real(wp), parameter :: standard_gravity = 9.80665_wp      !! m/s²

   ! faults of a manoeuvre
   integer, parameter :: none = 0, rolls_over = 1, lifts_off = 2

contains

   !> Whether the states of a case are manoeuvres.
   pure logical function has_manoeuvres(case)
      type(case_t), intent(in) :: case

      has_manoeuvres = .false.
      if (allocated(case%test)) has_manoeuvres = case%test == 'manoeuvres'
   end function has_manoeuvres

   !> Whether the left and the right side of the car have different load factors or accelerations in a manoeuvre of a case.
   pure logical function has_sides(case)
      type(case_t), intent(in) :: case
      has_sides = any(case%manoeuvres%side > 0) .or. any(case%manoeuvres%has_wheels)
   end function has_sides

   !> Gravity of the deck; standard gravity if the deck has no gravity [m/s²].
   pure real(wp) function gravity_of(suspension) result(gravity)
      type(suspension_t), intent(in) :: suspension

      gravity = suspension%gravity
      if (.not. gravity > 0.0_wp) gravity = standard_gravity
   end function gravity_of

   !> The constant vertical force of the road on a wheel at design [N], positive upward: the constant loads of the deck on its body.
   pure real(wp) function standing_load(suspension, wheel) result(load)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel
      integer :: k

      load = 0.0_wp
      do k = 1, size(suspension%loads)
         associate (this => suspension%loads(k))
            if (this%is_case .or. this%is_weight) cycle
            load = load + share_on_wheel(suspension, wheel, this%body, this%arm)*this%force(3)
         end associate
      end do
   end function standing_load

   !> Computes the load of the axle when the car stands, and its share on each side.
   pure subroutine standing_axle(suspension, axle_load, shares)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(out) :: axle_load     !! key axle_load of &axle; without this key, the wheel loads at design [N]
      real(wp), intent(out) :: shares(2)     !! left, right [-]
      real(wp) :: loads(2)
      integer :: wheels(2), k

      call left_and_right(suspension, wheels)
      loads = 0.0_wp
      do k = 1, 2
         if (wheels(k) > 0) loads(k) = standing_load(suspension, wheels(k))
      end do
      do k = 1, 2
         if (wheels(k) == 0) loads(k) = loads(3 - k)
      end do
      axle_load = sum(loads)
      shares = 0.5_wp
      if (all(loads > 0.0_wp)) shares = loads/axle_load
      if (suspension%axle%load > 0.0_wp) axle_load = suspension%axle%load
   end subroutine standing_axle

   !> Track of the axle [m]; for one wheel, twice the distance of its contact point from the middle of the car.
   pure real(wp) function track_of(suspension) result(track)
      type(suspension_t), intent(in) :: suspension
      integer :: wheels(2), w

      call left_and_right(suspension, wheels)
      if (all(wheels > 0)) then
         track = design_track(suspension)
      else
         w = maxval(wheels)
         track = 2.0_wp*abs(suspension%bodies(suspension%wheels(w)%body)%origin(2) + suspension%wheels(w)%contact(2))
      end if
   end function track_of

   !> Computes the forces of the road on the wheels in a manoeuvre. With a fault, the forces are those of the wheels that can still
   !> carry a load.
   pure subroutine wheel_forces(suspension, manoeuvre, forces, fault)
      type(suspension_t), intent(in) :: suspension
      type(manoeuvre_t), intent(in) :: manoeuvre
      real(wp), intent(out) :: forces(3, 2)     !! (component, side) rearward, to the right, upward [N]
      integer, intent(out) :: fault             !! none, rolls_over, lifts_off
      real(wp) :: standing, shares(2), weight, vertical, axle_load, further, transfer, roll_share, share, track
      integer :: k

      fault = none
      call standing_axle(suspension, standing, shares)
      if (manoeuvre%side > 0) then
         call load_one_wheel(standing*shares, shares, manoeuvre, forces, fault)
         return
      end if
      associate (axle => suspension%axle)
         weight = axle%mass*gravity_of(suspension)
         vertical = manoeuvre%vertical
         if (manoeuvre%has_wheels) vertical = dot_product(shares, manoeuvre%wheels)
         axle_load = vertical*standing
         transfer = 0.0_wp
         share = 0.0_wp
         if (axle%has_axle) then
            axle_load = axle_load + merge(-1.0_wp, 1.0_wp, axle%is_front)*weight*manoeuvre%longitudinal*axle%cg_height/ &
               axle%wheelbase
            roll_share = axle%roll_share
            if (roll_share < 0.0_wp .and. weight > 0.0_wp) roll_share = min(standing/weight, 1.0_wp)
            track = track_of(suspension)
            if (abs(manoeuvre%lateral) > 0.0_wp) then
               transfer = roll_share*weight*manoeuvre%lateral*axle%cg_height/track
               if (abs(manoeuvre%lateral)*axle%cg_height*standing > 0.5_wp*track*(vertical*standing + manoeuvre%downforce)) &
                  fault = rolls_over
            end if
            share = axle%drive_share
            if (manoeuvre%is_braked) share = merge(axle%brake_share, 1.0_wp - axle%brake_share, axle%is_front)
         end if
         axle_load = axle_load + manoeuvre%downforce
         further = axle_load - vertical*standing
         if (axle_load < 0.0_wp) then
            fault = lifts_off
            axle_load = 0.0_wp
         end if
         forces(3, :) = axle_load*shares + [-transfer, transfer]      ! to the left: the right wheel is the outer one
         if (manoeuvre%has_wheels) forces(3, :) = (standing*manoeuvre%wheels + further)*shares + [-transfer, transfer]
         do k = 1, 2
            if (forces(3, k) >= 0.0_wp) cycle
            forces(3, k) = 0.0_wp
            forces(3, 3 - k) = axle_load
         end do
         forces(:2, :) = 0.0_wp
         if (.not. axle_load > 0.0_wp) return
         forces(1, :) = -weight*manoeuvre%longitudinal*share*forces(3, :)/axle_load
         forces(2, :) = -standing*manoeuvre%lateral*forces(3, :)/axle_load
      end associate
   end subroutine wheel_forces

   !> Computes the forces of the road on the wheels in a manoeuvre of one wheel, whose factors count from its load when the car
   !> stands. The other wheel stands.
   pure subroutine load_one_wheel(standing, shares, manoeuvre, forces, fault)
      real(wp), intent(in) :: standing(2)       !! loads of the left and of the right wheel when the car stands [N]
      real(wp), intent(in) :: shares(2)         !! shares of the wheels in the load of the axle [-]
      type(manoeuvre_t), intent(in) :: manoeuvre
      real(wp), intent(out) :: forces(3, 2)     !! as for wheel_forces [N]
      integer, intent(out) :: fault             !! none, lifts_off

      forces = 0.0_wp
      forces(3, :) = standing
      associate (load => standing(manoeuvre%side))
         forces(:, manoeuvre%side) = load*[-manoeuvre%longitudinal, -manoeuvre%lateral, manoeuvre%vertical]
      end associate
      forces(3, :) = forces(3, :) + manoeuvre%downforce*shares
      fault = merge(lifts_off, none, any(forces(3, :) < 0.0_wp))
      forces(3, :) = max(forces(3, :), 0.0_wp)
   end subroutine load_one_wheel

   !> The load factor and the accelerations of the masses on a side of the car: vertical, longitudinal, lateral [-].
   pure function factors_of(manoeuvre, side) result(factors)
      type(manoeuvre_t), intent(in) :: manoeuvre
      integer, intent(in) :: side               !! 1 left, 2 right, 0 the car
      real(wp) :: factors(3)

      factors = [manoeuvre%vertical, manoeuvre%longitudinal, manoeuvre%lateral]
      if (side == 0) return
      if (manoeuvre%has_wheels) factors(1) = manoeuvre%wheels(side)
      if (manoeuvre%side == 3 - side) factors = [1.0_wp, 0.0_wp, 0.0_wp]
   end function factors_of

   !> Sets the values of an actuation in all manoeuvres of a case: the change of a force of a wheel from design [N], the acceleration
   !> of the masses that acts in addition to their weights [m/s²], or the position of the steering [m, rad]. Memory of a suitable size
   !> is used again.
   pure subroutine set_manoeuvre_values(suspension, case, column, values)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: column             !! one of the columns above; the columns of the right side follow the left side
      real(wp), allocatable, intent(inout) :: values(:)
      real(wp) :: forces(3, 2), factors(3), gravity
      integer :: k, side, part, fault, wheels(2), at(2)

      if (allocated(values)) then
         if (size(values) /= size(case%manoeuvres)) deallocate (values)
      end if
      if (.not. allocated(values)) allocate (values(size(case%manoeuvres)))
      call left_and_right(suspension, wheels)
      gravity = gravity_of(suspension)
      side = (column - 1)/columns_of_side + 1
      part = column - (side - 1)*columns_of_side
      at = findloc(inertia_column, column) - [0, 1]      ! direction, side
      do k = 1, size(values)
         associate (this => case%manoeuvres(k))
            if (column == steer_column) then
               values(k) = this%steer
            else if (at(1) > 0) then
               factors = factors_of(this, at(2))
               if (at(1) == 1) values(k) = gravity*factors(2)      ! rearward, against the acceleration
               if (at(1) == 2) values(k) = gravity*factors(3)      ! to the right
               if (at(1) == 3) values(k) = -gravity*(factors(1) - 1.0_wp)
            else
               call wheel_forces(suspension, this, forces, fault)
               select case (part)
               case (vertical_column)
                  values(k) = forces(3, side) - standing_load(suspension, wheels(side))
               case (lateral_column)
                  values(k) = forces(2, side)
               case (brake_column)
                  values(k) = merge(forces(1, side), 0.0_wp, this%is_braked)
               case (drive_column)
                  values(k) = merge(0.0_wp, forces(1, side), this%is_braked .or. this%hits_obstacle)
               case default
                  values(k) = merge(forces(1, side), 0.0_wp, this%hits_obstacle)
               end select
            end if
         end associate
      end do
   end subroutine set_manoeuvre_values

   !> Whether the axle carries the forces of all manoeuvres of a case; .true. for a case without manoeuvres. Creates no string.
   pure logical function can_drive(suspension, case)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      real(wp) :: forces(3, 2), standing, shares(2)
      integer :: k, fault

      can_drive = .true.
      if (.not. allocated(case%manoeuvres)) return
      call standing_axle(suspension, standing, shares)
      can_drive = standing > 0.0_wp
      do k = 1, size(case%manoeuvres)
         call wheel_forces(suspension, case%manoeuvres(k), forces, fault)
         can_drive = can_drive .and. fault == none
      end do
   end function can_drive

   !> The fault of an axle without load when the car stands; '' if the axle has a load.
   pure function axle_fault(suspension) result(words)
      type(suspension_t), intent(in) :: suspension
      character(:), allocatable :: words
      real(wp) :: standing, shares(2)

      words = ''
      call standing_axle(suspension, standing, shares)
      if (.not. standing > 0.0_wp) words = 'the load of the axle when the car stands is not known, found '//str(standing, 6)// &
         ' N from the constant loads on the wheels: give axle_load in &axle, or a constant &load on each wheel'
   end function axle_fault

   !> The fault of a manoeuvre in which a car rolls over or its axle lifts off; '' if the axle carries the load.
   pure function manoeuvre_fault(suspension, manoeuvre) result(words)
      type(suspension_t), intent(in) :: suspension
      type(manoeuvre_t), intent(in) :: manoeuvre
      character(:), allocatable :: words
      character(:), allocatable :: factor, aerodynamic
      real(wp) :: forces(3, 2), standing, shares(2), vertical
      integer :: fault

      call wheel_forces(suspension, manoeuvre, forces, fault)
      words = ''
      if (fault == none) return
      call standing_axle(suspension, standing, shares)
      vertical = manoeuvre%vertical
      factor = 'vertical'
      if (manoeuvre%has_wheels) then
         vertical = dot_product(shares, manoeuvre%wheels)
         factor = 'the mean of wheels'
      end if
      aerodynamic = ''
      if (abs(manoeuvre%downforce) > 0.0_wp) aerodynamic = ', downforce = '//str(manoeuvre%downforce, 6)//' N'
      select case (fault)
      case (rolls_over)
         words = 'the car rolls over: lateral must be at most '//factor//' × track/(2 cg_height) = '
         if (aerodynamic /= '') words = 'the car rolls over: lateral must be at most ('//factor// &
            ' + downforce/axle load) × track/(2 cg_height) = '
         words = words//str(0.5_wp*track_of(suspension)*(vertical + manoeuvre%downforce/standing)/suspension%axle%cg_height, 4)// &
            ' g, found '//str(abs(manoeuvre%lateral))//' g: use a smaller lateral, or a larger '// &
            trim(merge('factor  ', 'vertical', manoeuvre%has_wheels))
      case (lifts_off)
         words = 'the axle lifts off the road: its load must not be below 0 with '//factor//' = '//str(vertical)//aerodynamic// &
            ' and longitudinal = '//str(manoeuvre%longitudinal)//': use a smaller acceleration, or a larger '// &
            trim(merge('factor  ', 'vertical', manoeuvre%has_wheels))
      end select
   end function manoeuvre_fault

end module ek_manoeuvre
