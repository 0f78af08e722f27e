!> The assembled model: bodies, constraint rows, elastic elements, loads, wheels.
!>
!> Built by the reader and ek_realise. The preload trim (`balance`) sets preloads and targets; the solution of a case does
!> not change the model. All values are in SI, in the vehicle frame x rearward, y right, z up; at design the axes of every
!> body are parallel to the frame. Body 0 is the chassis.
module ek_suspension
   use ek_kinds, only: wp, units_t
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, rotation, axis_axis
   use ek_joint, only: joint_t, row_t, term_t
   use ek_element, only: element_t, copy_element
   use ek_load, only: load_t, has_potential
   use ek_tilt, only: tilt_t
   use ek_adjuster, only: adjuster_t, place_t, align_t
   use ek_contract, only: are_checked, require
   implicit none(type, external)
   private
   public :: suspension_t, body_t, point_t, load_t, wheel_t, wheel_place_t, wheel_place_list_t, readout_t, axle_t, steering_t
   public :: marker_t, of_term, of_readout, of_element, of_axes, of_joint, of_centre, of_contact, of_steer_axis, of_body, of_mass, &
      of_load
   public :: allocate_lists, copy_numbers, copy_load, body_name, design_poses, driver_row, driver_unit, load_number, &
      has_symmetric_loads, of_adjuster

   character(*), parameter :: of_adjuster = 'adjuster.'     !! in the key `drive` of a case: the rod of an adjuster

   !> The numbers of a body. What copies the numbers of a part copies this parent of its type, and does not name them.
   type :: body_numbers_t
      real(wp) :: origin(3) = 0.0_wp      !! reference point r at design [m]
      integer :: attached = 0             !! number of attachment points
      real(wp) :: mass = 0.0_wp           !! kg
      real(wp) :: centre(3) = 0.0_wp      !! centre of gravity of a body with a mass: arm from the reference point, body axes [m]
   end type body_numbers_t

   !> A rigid body.
   type, extends(body_numbers_t) :: body_t
      character(:), allocatable :: name, where
      logical :: has_origin = .false.     !! `origin` is given in the deck; otherwise it is the mean of the attachment points
   end type body_t

   !> A named hardpoint, design position.
   type :: point_t
      character(:), allocatable :: name, where
      real(wp) :: at(3) = 0.0_wp          !! m
      logical :: is_used = .false.
   end type point_t

   !> The numbers of a wheel from which its attitude follows.
   type :: wheel_place_t
      real(wp) :: centre(3) = 0.0_wp      !! wheel centre: arm from the carrier's reference point, body axes [m]
      real(wp) :: contact(3) = 0.0_wp     !! contact point: arm from the carrier's reference point, body axes; with a crown, at
                                          !! design [m]
      real(wp) :: spin(3) = [0.0_wp, -1.0_wp, 0.0_wp]   !! spin axis: unit vector, outboard, body axes
      real(wp) :: rim(3) = 0.0_wp         !! with a crown: core radius × spin axis, body axes [m]
      real(wp) :: crown = 0.0_wp          !! with a crown: its radius [m]; 0: a disc
      real(wp) :: steer_axis(3, 2) = 0.0_wp             !! two points on the carrier, arms [m]
      real(wp) :: start_rise(2) = 0.0_wp  !! rise of wheel centre and contact point in the start state (ek_start) from design [m]
   end type wheel_place_t

   !> These numbers as a list (see law_list_t of ek_law).
   type :: wheel_place_list_t
      real(wp) :: v(storage_size(wheel_place_t())/storage_size(1.0_wp)) = 0.0_wp
   end type wheel_place_list_t

   !> The numbers of a wheel.
   type, extends(wheel_place_t) :: wheel_numbers_t
      real(wp) :: toe = 0.0_wp, camber = 0.0_wp         !! static angles, given in the deck or derived from the spin axis [rad]
      real(wp) :: radius = 0.0_wp         !! m
      real(wp) :: tyre_rate = 0.0_wp      !! vertical stiffness of the tyre [N/m]; 0: not given
      real(wp) :: tyre_width = 0.0_wp     !! width of the tread [m]; 0: not given
      real(wp) :: sprung_mass = 0.0_wp    !! sprung mass carried by this wheel [kg]; 0: not given
   end type wheel_numbers_t

   !> A wheel with its points, angles and tyre, on its carrier.
   type, extends(wheel_numbers_t) :: wheel_t
      character(:), allocatable :: name, where
      integer :: body = 0
      integer :: side = -1                !! −1 left, +1 right
      logical :: gives_spin = .false.     !! the deck gives the spin axis instead of toe and camber
      logical :: has_steer_axis = .false.
      logical :: has_crown = .false.      !! the contact point is the lowest point of the wheel, and moves in the carrier
   end type wheel_t

   !> A named measure that is driven, coupled, or only read out.
   type :: readout_t
      character(:), allocatable :: name, where
      type(measure_t) :: measure
      real(wp) :: design_value = 0.0_wp   !! value at design [m, - or rad]
      integer :: wheel = 0                !! index of the wheel whose lowest point is the second point; 0: a point of the body
   end type readout_t

   !> The numbers of the vehicle, for characteristics of the axle that depend on the complete car.
   type :: axle_numbers_t
      real(wp) :: wheelbase = 0.0_wp      !! m
      real(wp) :: cg_height = 0.0_wp      !! height of the centre of gravity of the car above the ground [m]
      real(wp) :: mass = 0.0_wp           !! mass of the car [kg]; 0: not given
      real(wp) :: load = 0.0_wp           !! force of the road on both wheels when the car stands [N]; 0: not given
      real(wp) :: roll_share = -1.0_wp    !! share of the car's lateral load transfer on this axle, 0 to 1; negative: not given
      real(wp) :: brake_share = 0.0_wp    !! share of the car's braking force that acts on the FRONT axle, 0 to 1
      real(wp) :: drive_share = 1.0_wp    !! share of the car's driving force that acts on THIS axle, 0 to 1
      real(wp) :: front_overhang = 0.0_wp !! distance of the front corner of the car ahead of the wheels [m]; 0: not given
      real(wp) :: front_width = 0.0_wp    !! width of the car at its front corners [m]; given together with front_overhang
   end type axle_numbers_t

   !> Data of the vehicle.
   type, extends(axle_numbers_t) :: axle_t
      logical :: has_axle = .false.       !! the deck has an &axle
      character(:), allocatable :: where
      logical :: is_front = .true.
      integer :: class = 0                !! class of the car: index in class_names of ek_usual_range; 0: not given
      logical :: drives_at_patch = .false.   !! the axle carries the drive torque (solid axle): driving force acts at contact point;
                                             !! otherwise (independent suspension) at the wheel centre
      logical :: brakes_at_centre = .false.  !! the body takes the brake torque (inboard brakes): braking force acts at wheel centre;
                                             !! otherwise (brake on the carrier) at the contact point
   end type axle_t

   !> The numbers of the steering.
   type :: steering_numbers_t
      real(wp) :: ratio = 0.0_wp          !! rack travel per revolution of the steering wheel [m]; sign as given in the deck
      real(wp) :: travel = 0.0_wp         !! largest rack travel each way [m]
   end type steering_numbers_t

   !> The transmission from the steering wheel to the driver that moves the rack.
   type, extends(steering_numbers_t) :: steering_t
      logical :: has_steering = .false.   !! the deck has a &steering
      character(:), allocatable :: where
      character(:), allocatable :: driver !! name of the driver joint (driver_row gives the row)
   end type steering_t

   ! what has a marker
   integer, parameter :: of_term = 1, of_readout = 2, of_element = 3, of_axes = 4, of_joint = 5, of_centre = 6, of_contact = 7, &
      of_steer_axis = 8, of_body = 9, of_mass = 10, of_load = 11

   !> A point that a part has on a body, with a direction that is fixed in this body (ek_markers).
   type :: marker_t
      integer :: part = 0                 !! what has it: of_term, …
      integer :: index = 0                !! index of the term, readout, element, joint, wheel, body, mass or load
      integer :: side = 1                 !! of measure and joint: 1 on body i, 2 on body j; of_axes: column; of_steer_axis: point
      integer :: body = 0                 !! 0: the chassis
      integer :: point = 0, direction = 0 !! indices of the vectors of the blueprint that give them; 0: none
      logical :: is_attachment = .false.  !! one of the points whose mean is the reference point of a body without `origin`
      logical :: only_turns = .false.     !! of an angle: only its direction has an effect
   end type marker_t

   !> The numbers of all parts if some are made with deviations (&part): what ek_adjust puts in place of the drawn ones.
   type :: made_parts_t
      logical :: has_deviations = .false.      !! the other components are in use
      real(wp), allocatable :: at(:, :), directions(:, :)      !! of the markers
      real(wp), allocatable :: longer(:)                       !! of the rows: change of the length of a rod [m]
   end type made_parts_t

   !> The numbers of a suspension that belong to no part.
   type :: model_numbers_t
      real(wp) :: gravity = 0.0_wp        !! m/s²
      real(wp) :: start_height = 0.0_wp      !! start 'height': rise of the wheel centres from design [m]
      real(wp) :: start_load = 0.0_wp        !! start 'wheel_load': vertical force of the road on each wheel [N]
      real(wp) :: start_mass = 0.0_wp        !! start 'added_mass': mass on each wheel in addition to the loads [kg]
   end type model_numbers_t

   type, extends(model_numbers_t) :: suspension_t
      character(:), allocatable :: name, title, where
      type(units_t) :: units = units_t()  !! units of the deck, used in remarks on implausible numbers
      logical :: is_plausible_wanted = .true.   !! report implausible numbers
      logical :: is_iso = .false.         !! the deck uses ISO 8855 axes: vectors are written in that frame
      character(:), allocatable :: balance   !! 'none', 'spring' or 'all'
      character(:), allocatable :: start     !! start state of the tests: '' (as trimmed), 'height', 'loads', 'wheel_load' or
                                             !! 'added_mass', see ek_start
      character(:), allocatable :: state     !! name of the &load_state that gives the start state; '': none
      logical :: must_start = .false.        !! the deck asks for this start state: an error if there is no such state
      type(body_t), allocatable :: bodies(:)
      type(point_t), allocatable :: points(:)
      type(joint_t), allocatable :: joints(:)
      type(row_t), allocatable :: rows(:)      !! Φ(q) = 0, in joint order
      type(term_t), allocatable :: terms(:)
      type(element_t), allocatable :: elements(:)
      integer :: scalars = 0   !! elements(:scalars) act along one measure: springs, dampers, stops, torsion springs, in this order
                               !! if built from a deck; the other elements have six components: bushings
      type(load_t), allocatable :: loads(:)
      integer :: rig_rows = 0                  !! number of rows of the rig, which are the last rows, see ek_rig
      type(wheel_t), allocatable :: wheels(:)
      integer :: free_wheels = 0               !! number of wheels whose height nothing carries, see ek_free_wheels
      integer :: bushed_wheels = 0             !! number of wheels that only the stiffness of bushings about their axes carries
      type(readout_t), allocatable :: readouts(:)
      type(tilt_t), allocatable :: tilts(:)    !! rated tilts of joints and bushings
      type(marker_t), allocatable :: markers(:)   !! points of the parts on bodies, without those of a rig
      type(adjuster_t), allocatable :: adjusters(:)
      type(place_t), allocatable :: places(:)  !! all markers that adjusters move
      type(align_t), allocatable :: aligns(:)  !! static angles that adjusters give
      type(made_parts_t) :: made               !! the parts as made, see ek_made_parts
      logical :: has_set_adjusters = .false.   !! the arms are those of the parts as made and of the set adjusters (ek_adjust), not
                                               !! of the drawn axle
      type(axle_t) :: axle = axle_t()
      type(steering_t) :: steering = steering_t()
      real(wp), allocatable :: vectors(:, :)   !! (3, 0:n) design points [m] and directions of the blueprint, see ek_realise
   contains
      procedure :: unknowns                    !! 6 × bodies
      procedure :: constraints                 !! number of rows
      procedure :: own_rows                    !! number of rows without the rows of the rig
   end type suspension_t

contains

   !> Creates a suspension without parts.
   subroutine allocate_lists(self)
      type(suspension_t), intent(inout) :: self
      allocate (self%bodies(0), self%points(0), self%joints(0), self%rows(0), self%terms(0), self%elements(0), self%loads(0), &
         self%wheels(0), self%readouts(0), self%tilts(0), self%markers(0), self%adjusters(0), self%places(0), self%aligns(0))
      self%balance = 'none'
      self%start = ''
      self%state = ''
      self%name = ''
      self%title = ''
      self%where = ''
      self%axle%where = ''
      self%steering%where = ''
      self%steering%driver = ''
   end subroutine allocate_lists

   !> Copies the numbers of a suspension to another suspension with the same parts. The latter may also have rows, terms and loads
   !> of a rig after these parts (ek_rig). Copies every number that `realise`, `settle_design`, `balance` or `find_start`
   !> sets, without allocation.
   pure subroutine copy_numbers(from, to)
      type(suspension_t), intent(in) :: from
      type(suspension_t), intent(inout) :: to
      integer :: k

      if (are_checked) call require(size(from%bodies) == size(to%bodies) .and. size(from%joints) <= size(to%joints) .and. &
         size(from%terms) <= size(to%terms) .and. size(from%elements) == size(to%elements) .and. &
         size(from%loads) <= size(to%loads), 'copy_numbers: the suspensions are of different models')
      to%model_numbers_t = from%model_numbers_t
      do k = 1, size(from%bodies)
         to%bodies(k)%body_numbers_t = from%bodies(k)%body_numbers_t
      end do
      do k = 1, size(from%points)
         to%points(k)%at = from%points(k)%at
      end do
      do k = 1, size(from%joints)
         to%joints(k)%arm_j = from%joints(k)%arm_j
         to%joints(k)%axis = from%joints(k)%axis
      end do
      to%rows(:size(from%rows)) = from%rows
      to%terms(:size(from%terms)) = from%terms
      do k = 1, size(from%elements)
         call copy_element(from%elements(k), to%elements(k))
      end do
      do k = 1, size(from%loads)
         call copy_load(from%loads(k), to%loads(k))
      end do
      do k = 1, size(from%wheels)
         to%wheels(k)%wheel_numbers_t = from%wheels(k)%wheel_numbers_t
      end do
      do k = 1, size(from%readouts)
         to%readouts(k)%measure = from%readouts(k)%measure
         to%readouts(k)%design_value = from%readouts(k)%design_value
      end do
      do k = 1, size(from%tilts)
         to%tilts(k)%axis = from%tilts(k)%axis
      end do
      to%has_set_adjusters = from%has_set_adjusters
      to%made%has_deviations = from%made%has_deviations
      if (from%made%has_deviations) to%made = from%made
      do k = 1, size(from%aligns)
         to%aligns(k)%toe = from%aligns(k)%toe
         to%aligns(k)%camber = from%aligns(k)%camber
      end do
      do k = 1, size(from%adjusters)
         to%adjusters(k)%adjuster_numbers_t = from%adjusters(k)%adjuster_numbers_t
      end do
      to%axle%axle_numbers_t = from%axle%axle_numbers_t
      to%steering%steering_numbers_t = from%steering%steering_numbers_t
      if (allocated(from%vectors)) to%vectors(:, :) = from%vectors
   end subroutine copy_numbers

   !> Copies the numbers of a load.
   pure subroutine copy_load(from, to)
      type(load_t), intent(in) :: from
      type(load_t), intent(inout) :: to

      to%load_numbers_t = from%load_numbers_t
      to%follows = from%follows
      to%wheel = from%wheel
   end subroutine copy_load

   !> The number of unknowns of the bodies, the length of Δq.
   pure integer function unknowns(self)
      class(suspension_t), intent(in) :: self
      unknowns = 6*size(self%bodies)
   end function unknowns

   !> The number of rows of Φ.
   pure integer function constraints(self)
      class(suspension_t), intent(in) :: self
      constraints = size(self%rows)
   end function constraints

   !> The number of rows of Φ without the rows of the rig, which are last. λ(:own_rows) belongs to the suspension. λ(own_rows+1:)
   !> belongs to the rig: the forces of the ground that hold heights.
   pure integer function own_rows(self)
      class(suspension_t), intent(in) :: self
      own_rows = self%constraints() - self%rig_rows
   end function own_rows

   !> The design poses of bodies 0 … n, with the chassis first.
   pure function design_poses(self) result(poses)
      type(suspension_t), intent(in) :: self
      type(pose_t) :: poses(size(self%bodies) + 1)
      integer :: k

      do k = 1, size(self%bodies)
         poses(k + 1)%r = self%bodies(k)%origin
      end do
   end function design_poses

   !> The name of a body; 'chassis' for body 0.
   pure function body_name(self, body) result(name)
      type(suspension_t), intent(in) :: self
      integer, intent(in) :: body
      character(:), allocatable :: name
      name = 'chassis'
      if (body > 0) name = self%bodies(body)%name
   end function body_name

   !> Index of the row of the driver with this joint name, or of the rod (distance joint) of 'adjuster.<name>'; 0 if there is none.
   pure integer function driver_row(self, name)
      type(suspension_t), intent(in) :: self
      character(*), intent(in) :: name
      integer :: k

      driver_row = 0
      do k = 1, size(self%joints)
         if (self%joints(k)%kind == 'driver' .and. self%joints(k)%name == name) driver_row = self%joints(k)%first_row
      end do
      if (index(name, of_adjuster) /= 1) return
      do k = 1, size(self%adjusters)
         if (self%adjusters(k)%name == name(len(of_adjuster) + 1:)) driver_row = self%adjusters(k)%row
      end do
   end function driver_row

   !> The unit of the value of a driver in results: mm, deg or '-'; mm also for a name that is not a driver of the deck.
   pure function driver_unit(self, name) result(unit)
      type(suspension_t), intent(in) :: self
      character(*), intent(in) :: name
      character(3) :: unit
      integer :: row

      unit = 'mm'
      row = driver_row(self, name)
      if (row == 0) return
      select case (self%terms(self%rows(row)%first)%measure%kind)
      case (rotation)
         unit = 'deg'
      case (axis_axis)
         unit = '-'
      end select
   end function driver_unit

   !> Index of the load with this name; 0 if the name is empty or no load has it.
   pure integer function load_number(self, name)
      type(suspension_t), intent(in) :: self
      character(*), intent(in) :: name
      integer :: k

      load_number = 0
      do k = 1, size(self%loads)
         if (len(name) > 0 .and. self%loads(k)%name == name) load_number = k
      end do
   end function load_number

   !> Whether all loads leave the true tangent symmetric (has_potential).
   pure logical function has_symmetric_loads(self)
      type(suspension_t), intent(in) :: self
      integer :: k
      has_symmetric_loads = all([(has_potential(self%loads(k)), k=1, size(self%loads))])
   end function has_symmetric_loads

end module ek_suspension
