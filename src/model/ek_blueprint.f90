!> The blueprint of a suspension: the connections of the parts, and the index of each number in the parameters.
!>
!> The numbers of a design are the vector x [SI, axes of the deck]; everything here is an index into x, or the index of another
!> part. `realise` of ek_realise computes the suspension from (blueprint, x). Everything placed on a point refers to the index of
!> the point in `vectors`.
!>
!> Index 0 of a parameter means that the deck does not give the parameter. Index 0 of a vector means no vector.
module ek_blueprint
   use ek_kinds, only: wp
   use ek_element, only: element_numbers
   use ek_suspension, only: suspension_t, allocate_lists
   use ek_case, only: manoeuvre_t
   implicit none(type, external)
   private
   public :: blueprint_t, vector_t, body_plan_t, mass_plan_t, readout_plan_t, joint_plan_t, element_plan_t, bushing_plan_t
   public :: wheel_plan_t, load_plan_t, curve_plan_t, case_plan_t, manoeuvre_plan_t, adjuster_plan_t, align_plan_t, part_plan_t
   public :: hardpoint, along, given, fixed, chosen, chosen_right, across, lowest
   public :: new_blueprint, add_vector, mark_own_elements, inward, number_at, triple_at

   ! kinds of vector
   integer, parameter :: fixed = 0         !! the constant vector `value`
   integer, parameter :: hardpoint = 1     !! point given by three parameters
   integer, parameter :: along = 2         !! unit vector from vector a to vector b
   integer, parameter :: given = 3         !! unit vector along three parameters
   integer, parameter :: chosen = 4        !! unit vector perpendicular to vector a: the same choice in either frame of a deck
   integer, parameter :: chosen_right = 5  !! mirror image of the `chosen` vector for the mirror image of a
   integer, parameter :: across = 6        !! horizontal unit vector perpendicular to vector a: symmetric on a mirrored axle
   integer, parameter :: lowest = 7        !! lowest point of a wheel with a crown

   ! where a hardpoint must stay, or the deck has another topology
   integer, parameter, public :: anywhere = 0, in_plane = 1, off_left = 2, off_right = 3   !! side of the plane of &mirror

   integer, parameter, public :: upright = 1   !! index of the vector z (up), the first of every blueprint

   !> A point [m] or a unit vector at design, x rearward.
   type :: vector_t
      integer :: kind = fixed
      integer :: first = 0              !! index of the first of three parameters
      integer :: a = 0, b = 0           !! indices of other vectors, smaller than the index of this vector
      integer :: stays = anywhere       !! required position of a hardpoint
      integer :: wheel = 0              !! of a lowest point: index of the wheel
      real(wp) :: value(3) = 0.0_wp
   end type vector_t

   type :: body_plan_t
      integer :: origin = 0, centre = 0     !! indices of vectors
      integer :: mass = 0                   !! index of the parameter
   end type body_plan_t

   !> An additional mass of a body.
   type :: mass_plan_t
      integer :: body = 0
      integer :: kg = 0                     !! index of the parameter
      integer :: at = 0                     !! index of the vector
   end type mass_plan_t

   type :: readout_plan_t
      integer :: ends(2) = 0                !! indices of vectors: points
      integer :: u = 0, v = 0               !! indices of vectors: directions
   end type readout_plan_t

   !> A joint: of geometry (ends, axes), or of measures (driver, coupler).
   type :: joint_plan_t
      integer :: ends(2) = 0, axes(2) = 0   !! indices of vectors
      integer, allocatable :: readouts(:)   !! indices of the readouts: the measures of a driver or coupler
      integer, allocatable :: ratios(:)     !! indices of the parameters: ratios of a coupler
      real(wp), allocatable :: units(:)     !! SI value of the deck unit of each measure
      integer :: stiffness = 0              !! index of the parameter: stiffness of a driver [N/m or N m/rad]
   end type joint_plan_t

   !> An elastic element of one measure.
   type :: element_plan_t
      integer :: ends(2) = 0, axis = 0      !! indices of vectors
      integer :: readout = 0                !! index of the readout of a spring on a measure
      integer :: numbers(element_numbers) = 0   !! indices of parameters, in the order of ek_element
      integer :: curve = 0                  !! index of the curve; 0: none
      real(wp) :: value_unit = 1.0_wp, force_unit = 1.0_wp   !! SI per deck unit of the x, of the y of the curve
   end type element_plan_t

   type :: bushing_plan_t
      integer :: ends(2) = 0, z = 0, x = 0  !! indices of vectors
      integer :: kt = 0, kr = 0, preload_force = 0, preload_moment = 0   !! index of the first of three parameters
      integer :: curves(6) = 0              !! indices of the curves of the components; 0: none
   end type bushing_plan_t

   type :: wheel_plan_t
      integer :: centre = 0, contact = 0, spin = 0, steer_axis(2) = 0   !! indices of vectors
      ! indices of parameters
      integer :: toe = 0, camber = 0, radius = 0, crown_radius = 0, tyre_rate = 0, tyre_width = 0, sprung_mass = 0
   end type wheel_plan_t

   type :: load_plan_t
      integer :: at = 0                     !! index of the vector
      integer :: force = 0, moment = 0      !! index of the first of three parameters
   end type load_plan_t

   !> A curve, in the deck units of the element that uses it.
   type :: curve_plan_t
      integer :: points = 0                 !! number of points
      integer :: x = 0, y = 0               !! indices of the first parameters of x and of y, one per point
      character(:), allocatable :: kind, name
   end type curve_plan_t

   !> The numbers of a case, as indices of parameters.
   type :: case_plan_t
      integer :: from = 0, to = 0, offset = 0
      integer :: steer_from = 0, steer_to = 0      !! indices of parameters; 0 in a grid: ± travel of &steering
   end type case_plan_t

   !> A manoeuvre with the indices of its parameters.
   type :: manoeuvre_plan_t
      type(manoeuvre_t) :: manoeuvre
      integer :: vertical = 0, longitudinal = 0, lateral = 0
      integer :: wheels = 0                        !! the first of two
      integer :: downforce = 0, steer = 0
   end type manoeuvre_plan_t

   type :: adjuster_plan_t
      integer :: value = 0                         !! index of the parameter
      integer :: along = 0, bolt = 0, pivot = 0    !! indices of vectors
   end type adjuster_plan_t

   type :: align_plan_t
      integer :: toe = 0, camber = 0               !! indices of parameters
   end type align_plan_t

   !> A part that is made with a deviation of one of its points.
   type :: part_plan_t
      integer :: body = 0                          !! index of the body; 0: the chassis
      integer :: row = 0                           !! of a rod: row of Φ of the distance joint; 0: a body
      integer :: point = 0                         !! index of the vector
      integer :: by = 0                            !! index of the first of three parameters
   end type part_plan_t

   type :: blueprint_t
      type(suspension_t) :: prototype       !! names, connections, and the numbers of the deck
      logical :: is_iso = .false.           !! the axes of the deck are ISO 8855
      integer :: gravity = 0                !! index of the parameter
      integer :: start(3) = 0               !! indices of the parameters height, wheel load and added mass of the start state
      integer, allocatable :: points(:)     !! index of the vector of each point of the prototype
      type(vector_t), allocatable :: vectors(:)
      type(body_plan_t), allocatable :: bodies(:)
      type(mass_plan_t), allocatable :: masses(:)
      type(readout_plan_t), allocatable :: readouts(:)
      type(joint_plan_t), allocatable :: joints(:)
      type(element_plan_t), allocatable :: elements(:)
      type(bushing_plan_t), allocatable :: bushings(:)
      type(wheel_plan_t), allocatable :: wheels(:)
      type(load_plan_t), allocatable :: loads(:)
      type(curve_plan_t), allocatable :: curves(:)
      type(case_plan_t), allocatable :: cases(:)
      type(manoeuvre_plan_t), allocatable :: manoeuvres(:)
      type(adjuster_plan_t), allocatable :: adjusters(:)
      type(align_plan_t), allocatable :: aligns(:)
      type(part_plan_t), allocatable :: parts(:)
      integer, allocatable :: tilt_axes(:)  !! index of the vector of the axis of each tilt; 0: the default axis
      ! &axle: wheelbase, cg_height, mass, brake_share, drive_share, front_overhang, front_width, axle_load, roll_share;
      ! &steering: ratio, travel
      integer :: axle(9) = 0, steering(2) = 0   !! indices of parameters
   end type blueprint_t

contains

   !> Creates a blueprint without parts.
   subroutine new_blueprint(self)
      type(blueprint_t), intent(out) :: self
      integer :: number

      call allocate_lists(self%prototype)
      allocate (self%points(0), self%vectors(0), self%bodies(0), self%masses(0), self%readouts(0), self%joints(0))
      allocate (self%elements(0), self%bushings(0), self%wheels(0), self%loads(0), self%curves(0), self%cases(0))
      allocate (self%manoeuvres(0), self%adjusters(0), self%aligns(0), self%parts(0), self%tilt_axes(0))
      call add_vector(self, vector_t(value=[0.0_wp, 0.0_wp, 1.0_wp]), number)
   end subroutine new_blueprint

   !> Adds a vector. Its index is the new size of the list.
   pure subroutine add_vector(self, vector, number)
      type(blueprint_t), intent(inout) :: self
      type(vector_t), intent(in) :: vector
      integer, intent(out) :: number

      self%vectors = [self%vectors, vector]
      number = size(self%vectors)
   end subroutine add_vector

   !> Marks the elastic elements that have a parameter as a number of their own: a rate, a preload, a length, a point of a curve.
   !> is_alone is .true. if the parameter changes nothing else in a case. A parameter is of one record of the deck: of an element or
   !> a curve, of a case, or of another part.
   pure subroutine mark_own_elements(self, number, case, is_own, is_alone)
      type(blueprint_t), intent(in) :: self
      integer, intent(in) :: number              !! index of the parameter
      integer, intent(in) :: case                !! index of the case in the deck; 0: a standard test
      logical, intent(inout) :: is_own(:)        !! of each element
      logical, intent(out) :: is_alone
      logical :: has(size(is_own))
      integer :: k, c

      has = .false.
      do k = 1, size(self%elements)
         has(k) = any(self%elements(k)%numbers == number) .or. is_on_curve(self%elements(k)%curve)
      end do
      do k = 1, size(self%bushings)
         associate (this => self%bushings(k), of_bushing => has(size(self%elements) + k))
            of_bushing = is_of_triple(this%kt) .or. is_of_triple(this%kr) .or. is_of_triple(this%preload_force) .or. &
               is_of_triple(this%preload_moment)
            do c = 1, size(this%curves)
               if (is_on_curve(this%curves(c))) of_bushing = .true.
            end do
         end associate
      end do
      is_own = is_own .or. has
      is_alone = any(has)
      do k = 1, size(self%cases)
         associate (this => self%cases(k))
            if (k /= case .and. any([this%from, this%to, this%offset, this%steer_from, this%steer_to] == number)) is_alone = .true.
         end associate
      end do

   contains

      !> Whether the parameter is one of three from index `first` on.
      pure logical function is_of_triple(first)
         integer, intent(in) :: first
         is_of_triple = first > 0 .and. number >= first .and. number <= first + 2
      end function is_of_triple

      pure logical function is_on_curve(curve)
         integer, intent(in) :: curve

         is_on_curve = .false.
         if (curve == 0) return
         associate (this => self%curves(curve))
            is_on_curve = (number >= this%x .and. number < this%x + this%points) .or. &
               (number >= this%y .and. number < this%y + this%points)
         end associate
      end function is_on_curve

   end subroutine mark_own_elements

   !> A vector converted from the axes of the deck to x rearward, y right, z up.
   pure function inward(self, vector) result(turned)
      type(blueprint_t), intent(in) :: self
      real(wp), intent(in) :: vector(3)
      real(wp) :: turned(3)
      turned = vector
      if (self%is_iso) turned(1:2) = -vector(1:2)
   end function inward

   !> Value of parameter k; the default (usually 0) if the deck does not give the parameter.
   pure real(wp) function number_at(x, k, default) result(value)
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: k             !! 0: not given
      real(wp), intent(in), optional :: default
      value = 0.0_wp
      if (present(default)) value = default
      if (k > 0) value = x(k)
   end function number_at

   !> Values of three parameters from index k on; 0 if the deck does not give them.
   pure function triple_at(x, k) result(values)
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: k             !! 0: not given
      real(wp) :: values(3)
      values = 0.0_wp
      if (k > 0) values = x(k:k + 2)
   end function triple_at

end module ek_blueprint
