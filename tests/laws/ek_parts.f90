!> Models built by hand: call the `add_*` procedures in any order (measures before the joints that use them), then `complete`.
!> Points are design positions in global axes, SI; `complete` converts them to arms, as `realise` does for a deck.
module ek_parts
   use ek_kinds, only: wp
   use ek_curve, only: curve_t
   use ek_measure, only: measure_t, distance, rotation
   use ek_joint, only: term_t, joint_geometry_t, joint_terms, max_terms
   use ek_element, only: element_t, set_kind, set_design_value, axial_spring, damper, stop_spring, torsion_spring, measure_spring
   use ek_suspension, only: suspension_t, body_t, load_t, wheel_t, readout_t, allocate_lists
   use ek_assembly, only: append_joint
   use ek_blueprint, only: blueprint_t, new_blueprint
   use ek_markers, only: list_markers
   use ek_completion, only: settle_design
   implicit none(type, external)
   private
   public :: add_body, add_joint, add_driver, add_coupler, add_spring, add_element, add_bushing, add_load, add_wheel, add_readout
   public :: new_spring, new_damper, new_stop, new_torsion, new_measure_spring
   public :: complete

contains

   !> Sets reference points, arms and design values; after the last add.
   subroutine complete(self)
      type(suspension_t), intent(inout) :: self
      type(blueprint_t) :: plan

      call prepare(self)
      call new_blueprint(plan)
      plan%prototype = self
      deallocate (plan%joints, plan%readouts, plan%elements, plan%bushings, plan%wheels, plan%bodies)
      allocate (plan%joints(size(self%joints)), plan%readouts(size(self%readouts)), plan%elements(self%scalars), &
         plan%bushings(size(self%elements) - self%scalars), plan%wheels(size(self%wheels)), plan%bodies(size(self%bodies)))
      call list_markers(plan)
      call move_alloc(plan%prototype%markers, self%markers)
      call settle_design(self)
   end subroutine complete

   !> Allocates the lists before the first part.
   subroutine prepare(self)
      type(suspension_t), intent(inout) :: self
      character(:), allocatable :: name

      if (allocated(self%bodies)) return
      call move_alloc(self%name, name)
      call allocate_lists(self)
      if (allocated(name)) self%name = name
   end subroutine prepare

   !> Adds a body; without `origin` its reference point is the mean of its attachment points.
   subroutine add_body(self, name, where, origin)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      real(wp), intent(in), optional :: origin(3)
      type(body_t) :: body

      call prepare(self)
      body%name = name
      body%where = where
      body%has_origin = present(origin)
      if (present(origin)) body%origin = origin
      self%bodies = [self%bodies, body]
   end subroutine add_body

   !> Adds a joint that is defined by geometry (all types except driver and coupler).
   subroutine add_joint(self, name, where, kind, geometry)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where, kind
      type(joint_geometry_t), intent(in) :: geometry
      type(term_t) :: terms(max_terms)
      integer :: terms_of_row(max_terms), rows

      call prepare(self)
      call joint_terms(kind, geometry, terms, terms_of_row, rows)
      call append_joint(self, name, where, kind, terms(:sum(terms_of_row(:rows))), terms_of_row(:rows))
   end subroutine add_joint

   !> Adds a driver: readout = its design value + the change prescribed by the case (+ λ/stiffness if a stiffness is given).
   subroutine add_driver(self, name, where, readout, stiffness)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: readout
      real(wp), intent(in), optional :: stiffness      !! N/m, N m/rad; above 0
      type(term_t) :: term

      term%measure = self%readouts(readout)%measure
      call append_joint(self, name, where, 'driver', [term], [1])
      if (present(stiffness)) self%rows(size(self%rows))%compliance = 1.0_wp/stiffness
   end subroutine add_driver

   !> Adds a coupler: Σ ratio × readout = its design value.
   subroutine add_coupler(self, name, where, readouts, ratios)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: readouts(:)
      real(wp), intent(in) :: ratios(:)
      type(term_t) :: terms(size(readouts))

      terms%measure = self%readouts(readouts)%measure
      terms%coefficient = ratios
      call append_joint(self, name, where, 'coupler', terms, [size(terms)])
   end subroutine add_coupler

   !> Adds a spring between two points. free_length > 0 sets the preload from the design length.
   subroutine add_spring(self, name, where, body_i, body_j, point_i, point_j, rate, preload, free_length)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: rate                        !! N/m
      real(wp), intent(in), optional :: preload           !! N, compression at design
      real(wp), intent(in), optional :: free_length       !! m
      call add_element(self, new_spring(name, where, body_i, body_j, point_i, point_j, rate, preload, free_length))
   end subroutine add_spring

   !> Adds an element on one measure, before all bushings.
   subroutine add_element(self, element)
      type(suspension_t), intent(inout) :: self
      type(element_t), intent(in) :: element
      call prepare(self)
      self%elements = [self%elements(:self%scalars), element, self%elements(self%scalars + 1:)]
      self%scalars = self%scalars + 1
   end subroutine add_element

   subroutine add_bushing(self, bushing)
      type(suspension_t), intent(inout) :: self
      type(element_t), intent(in) :: bushing
      call prepare(self)
      self%elements = [self%elements, bushing]
   end subroutine add_bushing

   subroutine add_load(self, load)
      type(suspension_t), intent(inout) :: self
      type(load_t), intent(in) :: load
      call prepare(self)
      self%loads = [self%loads, load]
   end subroutine add_load

   subroutine add_wheel(self, wheel)
      type(suspension_t), intent(inout) :: self
      type(wheel_t), intent(in) :: wheel
      call prepare(self)
      self%wheels = [self%wheels, wheel]
   end subroutine add_wheel

   subroutine add_readout(self, readout)
      type(suspension_t), intent(inout) :: self
      type(readout_t), intent(in) :: readout
      call prepare(self)
      self%readouts = [self%readouts, readout]
   end subroutine add_readout

   !> A spring between two points; with a curve, compression is measured from the free length.
   pure function new_spring(name, where, body_i, body_j, point_i, point_j, rate, preload, free_length, curve) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: rate                        !! N/m
      real(wp), intent(in), optional :: preload           !! N, compression at design
      real(wp), intent(in), optional :: free_length       !! m
      type(curve_t), intent(in), optional :: curve        !! force over compression [N, m]; instead of the rate
      type(element_t) :: spring

      spring = new_measure_spring(name, where, measure_t(kind=distance, body_i=body_i, body_j=body_j, arm_i=point_i, &
         arm_j=point_j), rate, preload, free_length, curve)
   end function new_spring

   !> A damper at rest: the gas force on the rod.
   pure function new_damper(name, where, body_i, body_j, point_i, point_j, gas_rate, gas_force) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: gas_rate                    !! N/m
      real(wp), intent(in) :: gas_force                   !! N, pushes the ends apart at design
      type(element_t) :: spring

      spring = new_spring(name, where, body_i, body_j, point_i, point_j, gas_rate, gas_force)
      spring%kind = damper
   end function new_damper

   !> A bump or rebound stop: free for `clearance` of shortening or lengthening from design, then rate or curve.
   pure function new_stop(name, where, body_i, body_j, point_i, point_j, is_bump, clearance, rounding, rate, curve) &
      result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      logical, intent(in) :: is_bump                      !! else rebound
      real(wp), intent(in) :: clearance, rounding         !! m
      real(wp), intent(in) :: rate                        !! N/m
      type(curve_t), intent(in), optional :: curve        !! force over penetration [N, m]; instead of the rate
      type(element_t) :: spring

      spring = new_spring(name, where, body_i, body_j, point_i, point_j, rate, curve=curve)
      call set_kind(spring, stop_spring, spring%measure)
      if (.not. is_bump) spring%law%sign = 1.0_wp
      spring%clearance = clearance
      spring%law%rounding = rounding
      call set_design_value(spring, spring%design_length)
   end function new_stop

   !> A torsion spring about an axis fixed in body i; at design it exerts only its preload.
   pure function new_torsion(name, where, body_i, body_j, axis, rate, preload, curve) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: axis(3)                     !! unit, global at design
      real(wp), intent(in) :: rate                        !! N m/rad
      real(wp), intent(in) :: preload                     !! N m on body j about the axis at design
      type(curve_t), intent(in), optional :: curve        !! moment over angle [N m, rad]; instead of the rate
      type(element_t) :: spring

      spring = new_measure_spring(name, where, measure_t(kind=rotation, body_i=body_i, body_j=body_j, u=axis), rate, preload, &
         curve=curve)
      spring%kind = torsion_spring
   end function new_torsion

   !> A spring on a measure; `complete` sets its design value, which is known here for a distance.
   pure function new_measure_spring(name, where, measure, rate, preload, free_length, curve) result(spring)
      character(*), intent(in) :: name, where
      type(measure_t), intent(in) :: measure              !! design points, unit directions
      real(wp), intent(in) :: rate                        !! N/m, N m/rad, N m
      real(wp), intent(in), optional :: preload           !! N, N m, at design
      real(wp), intent(in), optional :: free_length       !! m; for a distance only
      type(curve_t), intent(in), optional :: curve        !! force over compression, moment over φ; instead of the rate
      type(element_t) :: spring

      spring%name = name
      spring%where = where
      call set_kind(spring, merge(axial_spring, measure_spring, measure%kind == distance), measure)
      spring%law%rate = rate
      if (present(preload)) spring%preload = preload
      if (present(free_length)) spring%free_length = free_length
      spring%law%has_curve = present(curve)
      if (present(curve)) spring%law%curve = curve
      if (measure%kind == distance) call set_design_value(spring, norm2(measure%arm_j - measure%arm_i))
   end function new_measure_spring

end module ek_parts
