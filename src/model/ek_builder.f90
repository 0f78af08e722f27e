!> Builds a suspension part by part: call the `add_*` procedures in any order (measures before the joints that use them),
!> then `complete` of ek_completion. Points are design positions in global axes, SI; `complete` converts them to arms.
module ek_builder
   use ek_kinds, only: wp
   use ek_measure, only: measure_t
   use ek_joint, only: joint_t, row_t, term_t, joint_geometry_t, joint_terms, max_terms
   use ek_element, only: element_t, new_spring, new_bushing
   use ek_elastic, only: bushing_t
   use ek_suspension, only: suspension_t, body_t, point_t, load_t, wheel_t, readout_t
   implicit none(type, external)
   private
   public :: add_body, add_point, add_joint, add_driver, add_coupler, add_spring, add_element, add_bushing
   public :: add_load, add_gravity, add_wheel, add_readout

contains

   !> Add a body; without `origin` its reference point is the mean of its attachment points.
   pure subroutine add_body(self, name, where, origin, mass, centre)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      real(wp), intent(in), optional :: origin(3)
      real(wp), intent(in), optional :: mass         !! kg
      real(wp), intent(in), optional :: centre(3)    !! of gravity, design point [m]
      type(body_t) :: body

      body%name = name
      body%where = where
      body%has_origin = present(origin)
      if (present(origin)) body%origin = origin
      if (present(mass)) body%mass = mass
      if (present(centre)) body%centre = centre
      if (.not. allocated(self%bodies)) allocate (self%bodies(0))
      self%bodies = [self%bodies, body]
   end subroutine add_body

   !> Add a named hardpoint, used in the messages of `check`; elements store their own points.
   pure subroutine add_point(self, name, where, at, is_used)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      real(wp), intent(in) :: at(3)      !! m
      logical, intent(in) :: is_used     !! an element of the deck refers to it
      type(point_t) :: point

      point%name = name
      point%where = where
      point%at = at
      point%is_used = is_used
      if (.not. allocated(self%points)) allocate (self%points(0))
      self%points = [self%points, point]
   end subroutine add_point

   !> Add a joint that is defined by geometry (all types except driver and coupler).
   subroutine add_joint(self, name, where, kind, geometry)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where, kind
      type(joint_geometry_t), intent(in) :: geometry
      type(term_t) :: terms(max_terms)
      integer :: terms_of_row(max_terms), rows

      call joint_terms(kind, geometry, terms, terms_of_row, rows)
      call append_joint(self, name, where, kind, terms(:sum(terms_of_row(:rows))), terms_of_row(:rows), .false.)
      self%joints(size(self%joints))%arm_j = geometry%point_j
   end subroutine add_joint

   !> Add a driver: readout = its design value + the change prescribed by the case (+ λ/stiffness if a stiffness is given).
   pure subroutine add_driver(self, name, where, readout, stiffness)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: readout
      real(wp), intent(in), optional :: stiffness      !! N/m, N m/rad; above 0
      type(term_t) :: term

      term%measure = self%readouts(readout)%measure
      call append_joint(self, name, where, 'driver', [term], [1], .true.)
      if (present(stiffness)) self%rows(size(self%rows))%compliance = 1.0_wp/stiffness
      self%joints(size(self%joints))%arm_j = term%measure%arm_j
      self%joints(size(self%joints))%is_of_measures = .true.
   end subroutine add_driver

   !> Add a coupler: Σ ratio × readout = its design value.
   pure subroutine add_coupler(self, name, where, readouts, ratios)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: readouts(:)
      real(wp), intent(in) :: ratios(:)
      type(term_t) :: terms(size(readouts))
      integer :: k

      do k = 1, size(readouts)
         terms(k)%measure = self%readouts(readouts(k))%measure
         terms(k)%coefficient = ratios(k)
      end do
      call append_joint(self, name, where, 'coupler', terms, [size(terms)], .false.)
      self%joints(size(self%joints))%arm_j = terms(1)%measure%arm_j
      self%joints(size(self%joints))%is_of_measures = .true.
   end subroutine add_coupler

   !> Append a joint with its terms; terms_of_row gives the number of terms in each row.
   pure subroutine append_joint(self, name, where, kind, terms, terms_of_row, is_driver)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where, kind
      type(term_t), intent(in) :: terms(:)
      integer, intent(in) :: terms_of_row(:)
      logical, intent(in) :: is_driver
      type(joint_t) :: joint
      type(row_t) :: row
      integer :: k

      if (.not. allocated(self%joints)) allocate (self%joints(0))
      if (.not. allocated(self%rows)) allocate (self%rows(0))
      if (.not. allocated(self%terms)) allocate (self%terms(0))
      joint%name = name
      joint%where = where
      joint%kind = kind
      joint%body_i = terms(1)%measure%body_i
      joint%body_j = terms(1)%measure%body_j
      joint%first_row = size(self%rows) + 1
      joint%rows = size(terms_of_row)
      row%first = size(self%terms) + 1
      do k = 1, size(terms_of_row)
         row%terms = terms_of_row(k)
         row%joint = size(self%joints) + 1
         row%is_driver = is_driver
         self%rows = [self%rows, row]
         row%first = row%first + row%terms
      end do
      self%terms = [self%terms, terms]
      self%joints = [self%joints, joint]
   end subroutine append_joint

   !> Add a spring between two design points (global; `complete` converts them to arms).
   !> free_length > 0 sets the preload from the design length.
   pure subroutine add_spring(self, name, where, body_i, body_j, point_i, point_j, rate, preload, free_length)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: rate                        !! N/m
      real(wp), intent(in), optional :: preload           !! N, compression at design
      real(wp), intent(in), optional :: free_length       !! m

      call add_element(self, new_spring(name, where, body_i, body_j, point_i, point_j, rate, preload, free_length))
   end subroutine add_spring

   !> Add an element on one measure, made by a function of ek_element (new_spring, new_damper, …), before all bushings.
   pure subroutine add_element(self, element)
      type(suspension_t), intent(inout) :: self
      type(element_t), intent(in) :: element

      if (.not. allocated(self%elements)) allocate (self%elements(0))
      self%elements = [self%elements(:self%scalars), element, self%elements(self%scalars + 1:)]
      self%scalars = self%scalars + 1
   end subroutine add_element

   !> Add a bushing. The caller sets all components except the derived ones; arms are given as design points.
   pure subroutine add_bushing(self, bushing)
      type(suspension_t), intent(inout) :: self
      type(bushing_t), intent(in) :: bushing
      type(element_t) :: element

      element = new_bushing(bushing)
      if (.not. allocated(self%elements)) allocate (self%elements(0))
      self%elements = [self%elements, element]
   end subroutine add_bushing

   !> Add a load; its arm is given as a design point.
   pure subroutine add_load(self, load)
      type(suspension_t), intent(inout) :: self
      type(load_t), intent(in) :: load

      if (.not. allocated(self%loads)) allocate (self%loads(0))
      self%loads = [self%loads, load]
   end subroutine add_load

   !> Add the weight of every body with a mass as a constant load at its centre of gravity, given as a design point.
   !>
   !> Its name contains blanks, so that it cannot coincide with a name in the deck.
   pure subroutine add_gravity(self, gravity)
      type(suspension_t), intent(inout) :: self
      real(wp), intent(in) :: gravity       !! m/s², acts along −z
      type(load_t) :: load
      integer :: k

      self%gravity = gravity
      if (.not. gravity > 0.0_wp) return
      do k = 1, size(self%bodies)
         if (.not. self%bodies(k)%mass > 0.0_wp) cycle
         load%name = 'weight of '//self%bodies(k)%name
         load%where = self%bodies(k)%where
         load%body = k
         load%arm = self%bodies(k)%centre
         load%force = [0.0_wp, 0.0_wp, -self%bodies(k)%mass*gravity]
         load%is_weight = .true.
         call add_load(self, load)
      end do
   end subroutine add_gravity

   !> Add a wheel; centre, contact and steer axis are given as design points.
   pure subroutine add_wheel(self, wheel)
      type(suspension_t), intent(inout) :: self
      type(wheel_t), intent(in) :: wheel

      if (.not. allocated(self%wheels)) allocate (self%wheels(0))
      self%wheels = [self%wheels, wheel]
   end subroutine add_wheel

   !> Add a named measure, before the drivers and couplers that use it; its arms are given as design points.
   pure subroutine add_readout(self, readout)
      type(suspension_t), intent(inout) :: self
      type(readout_t), intent(in) :: readout

      if (.not. allocated(self%readouts)) allocate (self%readouts(0))
      self%readouts = [self%readouts, readout]
   end subroutine add_readout

end module ek_builder
