!> realise: (blueprint, x) → suspension, for one design after the other.
!>
!> The suspension is a copy of the blueprint's prototype; all its numbers are computed anew in place, so that no memory is
!> allocated (except for curves with new points) and no name is looked up. Every number comes from the same formula as for a
!> suspension built part by part: the rows of a joint from `joint_terms`, arms and design values from `settle_design`.
!>
!> Where x is outside the range for which the blueprint is valid (an axis without length, a point that leaves its side), `is_good`
!> is .false. and the suspension must not be used; the deck reader reports the reason.
module ek_realise
   use ek_kinds, only: wp
   use ek_dimension, only: unit_size, length, angle, force_dimension => force, moment
   use ek_contract, only: are_checked, require
   use ek_curve, only: curve_t, look_up_curve
   use ek_new_curve, only: new_curve, has_points, min_step
   use ek_measure, only: distance
   use ek_joint, only: term_t, joint_geometry_t, joint_terms, joint_table, axes_fit, max_terms
   use ek_element, only: element_kinds, element_numbers, set_numbers
   use ek_adjuster, only: is_reachable
   use ek_made_parts, only: begin_made, make_part
   use ek_markers, only: find_point
   use ek_suspension, only: suspension_t, of_term
   use ek_wheel_contact, only: measure_at_contact, set_rim
   use ek_case, only: case_t
   use ek_grid, only: is_grid
   use ek_manoeuvre, only: has_manoeuvres
   use ek_completion, only: settle_design, settle_element
   use ek_blueprint, only: blueprint_t, inward, number_at, triple_at
   use ek_design_vector, only: find_vectors, marker_axes, spin_of
   implicit none(type, external)
   private
   public :: new_design, realise, realise_element, realise_cases

   real(wp), parameter, public :: steepest_roll = 0.5_wp      !! largest axle roll of a test [rad]

contains

   !> Creates a suspension for `realise`, with all memory except the memory of new curves.
   subroutine new_design(plan, suspension)
      type(blueprint_t), intent(in) :: plan
      type(suspension_t), intent(out) :: suspension

      suspension = plan%prototype
      if (allocated(suspension%vectors)) deallocate (suspension%vectors)
      allocate (suspension%vectors(3, 0:size(plan%vectors)), source=0.0_wp)
   end subroutine new_design

   !> Computes all numbers of the suspension for the parameters x. `new_design` must have been called once.
   subroutine realise(plan, x, suspension, is_good, keeps_origins)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)                        !! SI, axes of the deck
      type(suspension_t), intent(inout) :: suspension
      logical, intent(out) :: is_good
      logical, intent(in), optional :: keeps_origins      !! as in realise_drawn

      call realise_drawn(plan, x, suspension, is_good, keeps_origins)
      suspension%made%has_deviations = .false.
      if (is_good .and. size(plan%parts) > 0) call realise_parts(plan, x, suspension, is_good)
   end subroutine realise

   !> Computes the parts that are made with deviations: each is that of an axle whose points are moved.
   subroutine realise_parts(plan, x, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(suspension_t), intent(inout) :: suspension     !! as drawn
      logical, intent(inout) :: is_good
      type(suspension_t) :: moved
      real(wp) :: there(size(x))
      logical :: is_same(size(plan%parts))
      integer :: k, j

      do k = 1, size(plan%parts)
         is_same = plan%parts%body == plan%parts(k)%body .and. plan%parts%row == plan%parts(k)%row
         if (any(is_same(:k - 1))) cycle
         there = x
         do j = k, size(plan%parts)
            if (.not. is_same(j)) cycle
            associate (first => plan%vectors(plan%parts(j)%point)%first, by => plan%parts(j)%by)
               there(first:first + 2) = there(first:first + 2) + x(by:by + 2)
            end associate
         end do
         if (.not. any(abs(there - x) > 0.0_wp)) cycle
         if (.not. suspension%made%has_deviations) then
            call begin_made(suspension)
            moved = suspension
            suspension%made%has_deviations = .true.
         end if
         call realise_drawn(plan, there, moved, is_good, is_part=.true.)
         if (.not. is_good) return
         call make_part(moved, plan%parts(k)%body, plan%parts(k)%row, suspension)
      end do
   end subroutine realise_parts

   !> Computes all numbers of the suspension as drawn.
   subroutine realise_drawn(plan, x, suspension, is_good, keeps_origins, is_part)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)                        !! SI, axes of the deck
      type(suspension_t), intent(inout) :: suspension
      logical, intent(out) :: is_good
      logical, intent(in), optional :: keeps_origins      !! whether the reference points of the bodies stay where they are, also of
                                                          !! bodies for which the deck names a point; default .false.
      logical, intent(in), optional :: is_part            !! see find_vectors
      logical :: is_kept
      integer :: k

      if (are_checked) then
         call require(allocated(suspension%vectors), 'realise: call new_design first')
         call require(size(suspension%vectors, 2) == size(plan%vectors) + 1 .and. suspension%scalars == size(plan%elements) &
            .and. size(suspension%elements) == size(plan%elements) + size(plan%bushings), &
            'realise: the suspension is of another blueprint')
      end if
      call find_vectors(plan, x, suspension%vectors, is_good, is_part=is_part)
      do k = 1, size(plan%points)
         suspension%points(k)%at = suspension%vectors(:, plan%points(k))
      end do
      call place_markers(suspension)
      is_kept = .false.
      if (present(keeps_origins)) is_kept = keeps_origins
      call place_bodies(plan, x, is_kept, suspension)
      call place_wheels(plan, x, suspension, is_good)
      do k = 1, size(plan%readouts)
         associate (measure => suspension%readouts(k)%measure, this => plan%readouts(k))
            measure%u = suspension%vectors(:, this%u)
            measure%v = suspension%vectors(:, this%v)
            if (suspension%readouts(k)%wheel > 0) call measure_at_contact(suspension%wheels(suspension%readouts(k)%wheel), measure)
         end associate
      end do
      do k = 1, size(plan%tilt_axes)
         suspension%tilts(k)%axis = suspension%vectors(:, plan%tilt_axes(k))
      end do
      call place_joints(plan, x, suspension, is_good)
      do k = 1, size(plan%elements)
         associate (measure => suspension%elements(k)%measure, this => plan%elements(k))
            measure%u = suspension%vectors(:, this%axis)
            if (this%readout > 0) measure = suspension%readouts(this%readout)%measure
            if (measure%kind == distance) is_good = is_good .and. norm2(measure%arm_j - measure%arm_i) > 0.0_wp
         end associate
         call place_element(plan, x, k, suspension, is_good)
      end do
      do k = 1, size(plan%bushings)
         call place_bushing(plan, x, k, suspension, is_good)
      end do
      call place_loads(plan, x, suspension, is_good)
      associate (axle => suspension%axle, steering => suspension%steering)
         axle%wheelbase = number_at(x, plan%axle(1))
         axle%cg_height = number_at(x, plan%axle(2))
         axle%mass = number_at(x, plan%axle(3))
         axle%brake_share = number_at(x, plan%axle(4))
         axle%drive_share = number_at(x, plan%axle(5), 1.0_wp)
         axle%front_overhang = number_at(x, plan%axle(6))
         axle%front_width = number_at(x, plan%axle(7))
         axle%load = number_at(x, plan%axle(8))
         axle%roll_share = number_at(x, plan%axle(9), -1.0_wp)
         steering%ratio = number_at(x, plan%steering(1))
         steering%travel = number_at(x, plan%steering(2))
      end associate
      call place_adjusters(plan, x, suspension, is_good)
      if (is_good) call settle_design(suspension)
   end subroutine realise_drawn

   !> Puts all markers at their design points, without those of terms, which come from `joint_terms`. Points that follow from other
   !> numbers (a contact point that moves, a weight) and directions are set after this.
   subroutine place_markers(suspension)
      type(suspension_t), intent(inout), target :: suspension
      real(wp), pointer, contiguous :: at(:)
      integer :: k

      do k = 1, size(suspension%markers)
         if (suspension%markers(k)%part == of_term) cycle
         call find_point(suspension, suspension%markers(k), at)
         if (associated(at)) at(1:3) = suspension%vectors(:, suspension%markers(k)%point)
      end do
   end subroutine place_markers

   !> Computes values, directions and points of the adjusters. ek_adjust moves the parts.
   subroutine place_adjusters(plan, x, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      integer :: k

      suspension%has_set_adjusters = .false.
      do k = 1, size(plan%aligns)
         suspension%aligns(k)%toe = number_at(x, plan%aligns(k)%toe)
         suspension%aligns(k)%camber = number_at(x, plan%aligns(k)%camber)
      end do
      do k = 1, size(plan%adjusters)
         associate (this => suspension%adjusters(k), from => plan%adjusters(k))
            this%value = number_at(x, from%value)
            this%along = suspension%vectors(:, from%along)
            this%bolt = suspension%vectors(:, from%bolt)
            this%pivot = suspension%vectors(:, from%pivot)
            is_good = is_good .and. this%value >= this%low .and. this%value <= this%high
            if (is_good) is_good = is_reachable(this)
         end associate
      end do
   end subroutine place_adjusters

   !> Computes reference points, masses, and the centres of gravity of bodies with several masses.
   subroutine place_bodies(plan, x, keeps_origins, suspension)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      logical, intent(in) :: keeps_origins
      type(suspension_t), intent(inout) :: suspension
      integer :: k

      do k = 1, size(plan%bodies)
         associate (body => suspension%bodies(k), this => plan%bodies(k))
            if (this%origin > 0 .and. .not. keeps_origins) body%origin = suspension%vectors(:, this%origin)
            body%mass = number_at(x, this%mass)
         end associate
      end do
      ! as weights are parallel, one mass at the common centre of gravity is equivalent: m = Σ m_k, centre = Σ m_k c_k / m
      do k = 1, size(plan%masses)
         associate (body => suspension%bodies(plan%masses(k)%body), this => plan%masses(k))
            body%centre = (body%mass*body%centre + x(this%kg)*suspension%vectors(:, this%at))/(body%mass + x(this%kg))
            body%mass = body%mass + x(this%kg)
         end associate
      end do
   end subroutine place_bodies

   !> Computes the terms of all joints, with design points instead of arms.
   subroutine place_joints(plan, x, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      type(joint_geometry_t) :: geometry
      type(term_t) :: terms(max_terms)
      integer :: terms_of_row(max_terms), rows, k, t, first

      do k = 1, size(plan%joints)
         associate (joint => suspension%joints(k), this => plan%joints(k))
            first = suspension%rows(joint%first_row)%first
            if (allocated(this%readouts)) then
               do t = 1, size(this%readouts)
                  suspension%terms(first + t - 1)%measure = suspension%readouts(this%readouts(t))%measure
                  if (.not. allocated(this%ratios)) cycle
                  if (.not. abs(x(this%ratios(t))) > 0.0_wp) is_good = .false.
                  suspension%terms(first + t - 1)%coefficient = x(this%ratios(t))*this%units(1)/this%units(t)
               end do
               if (this%stiffness > 0) suspension%rows(joint%first_row)%compliance = 1.0_wp/x(this%stiffness)
               joint%arm_j = suspension%terms(first)%measure%arm_j
               cycle
            end if
            geometry%body_i = joint%body_i
            geometry%body_j = joint%body_j
            geometry%point_i = suspension%vectors(:, this%ends(1))
            geometry%point_j = suspension%vectors(:, this%ends(2))
            geometry%axis_i = suspension%vectors(:, this%axes(1))
            geometry%axis_j = suspension%vectors(:, this%axes(2))
            geometry%across = joint%across
            is_good = is_good .and. axes_fit(joint_table(joint%number)%angle, geometry%axis_i, geometry%axis_j)
            if (joint_table(joint%number)%min_points == 2) &
               is_good = is_good .and. norm2(geometry%point_j - geometry%point_i) > 0.0_wp
            if (.not. is_good) return
            call joint_terms(joint%kind, geometry, terms, terms_of_row, rows)
            t = sum(terms_of_row(:rows))
            suspension%terms(first:first + t - 1) = terms(:t)
            joint%axis(:, 1) = geometry%axis_i
            joint%axis(:, 2) = geometry%axis_j
         end associate
      end do
   end subroutine place_joints

   !> Computes one element again, for parameters that differ from those of the last `realise` in numbers of the element alone
   !> (own_element). All other parts keep their numbers, and the result equals that of `realise`.
   subroutine realise_element(plan, x, k, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)                        !! SI, axes of the deck
      integer, intent(in) :: k                            !! index of the element
      type(suspension_t), intent(inout) :: suspension     !! after `realise`
      logical, intent(out) :: is_good

      is_good = .true.
      if (k <= suspension%scalars) then
         call place_element(plan, x, k, suspension, is_good)
      else
         call place_bushing(plan, x, k - suspension%scalars, suspension, is_good)
      end if
      if (is_good) call settle_element(suspension%elements(k))
   end subroutine realise_element

   !> Computes the numbers of elastic element k, of one measure, without those of the measure.
   subroutine place_element(plan, x, k, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: k
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      real(wp) :: numbers(element_numbers), force, slope
      integer :: n

      associate (spring => suspension%elements(k), this => plan%elements(k))
         do n = 1, element_numbers
            numbers(n) = number_at(x, this%numbers(n))
         end do
         call set_numbers(spring, numbers)
         if (this%curve == 0) return
         call renew(plan, this%curve, x, this%value_unit, this%force_unit, spring%law%curve, is_good)
         if (.not. (element_kinds(spring%kind)%has_gap .and. is_good)) return
         call look_up_curve(spring%law%curve, 0.0_wp, force, slope)
         is_good = abs(force) <= 0.0_wp      ! without contact it exerts no force
      end associate
   end subroutine place_element

   !> Computes the numbers of bushing k, without those of its measure.
   subroutine place_bushing(plan, x, k, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: k
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      real(wp) :: rates(6)
      integer :: c

      associate (this => plan%bushings(k), bushing => suspension%elements(suspension%scalars + k)%bushing)
         call marker_axes(plan, suspension%vectors(:, this%z), suspension%vectors(:, this%x), bushing%axes, is_good)
         bushing%kt = triple_at(x, this%kt)
         bushing%kr = triple_at(x, this%kr)
         bushing%preload_force = triple_at(x, this%preload_force)
         bushing%preload_moment = triple_at(x, this%preload_moment)
         rates = [bushing%kt, bushing%kr]
         do c = 1, 6
            if (this%curves(c) == 0) cycle
            call renew(plan, this%curves(c), x, unit_size(merge(length, angle, c <= 3), plan%prototype%units), &
               unit_size(merge(force_dimension, moment, c <= 3), plan%prototype%units), bushing%laws(c)%curve, is_good)
            is_good = is_good .and. abs(rates(c)) <= 0.0_wp      ! a component has either a rate or a curve
         end do
      end associate
   end subroutine place_bushing

   !> Computes a curve of an element in SI. If its points are unchanged, the curve is not computed again.
   subroutine renew(plan, number, x, x_unit, y_unit, curve, is_good)
      type(blueprint_t), intent(in) :: plan
      integer, intent(in) :: number
      real(wp), intent(in) :: x(:)
      real(wp), intent(in) :: x_unit, y_unit      !! SI per deck unit
      type(curve_t), intent(inout) :: curve
      logical, intent(inout) :: is_good

      associate (this => plan%curves(number))
         associate (at => x(this%x:this%x + this%points - 1), values => x(this%y:this%y + this%points - 1))
            if (has_points(curve, at, values, x_unit, y_unit)) return
            is_good = is_good .and. all(at(2:) - at(:this%points - 1) >= min_step)
            if (.not. is_good) return
            curve = new_curve(at, values, this%kind, x_unit, y_unit)
            curve%name = this%name
         end associate
      end associate
   end subroutine renew

   subroutine place_loads(plan, x, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      integer :: k, used

      suspension%gravity = number_at(x, plan%gravity)
      suspension%start_height = number_at(x, plan%start(1))
      suspension%start_load = number_at(x, plan%start(2))
      suspension%start_mass = number_at(x, plan%start(3))
      used = size(plan%loads)
      do k = 1, used
         associate (load => suspension%loads(k), this => plan%loads(k))
            load%force = inward(plan, triple_at(x, this%force))
            load%moment = inward(plan, triple_at(x, this%moment))
         end associate
      end do
      ! a weight for every body with a mass, or none
      if ((suspension%gravity > 0.0_wp) .neqv. any(suspension%loads%is_weight)) &
         is_good = is_good .and. .not. any(suspension%bodies%mass > 0.0_wp)
      do k = used + 1, size(suspension%loads)
         associate (load => suspension%loads(k), body => suspension%bodies(suspension%loads(k)%body))
            if (load%start_of > 0) then
               load%arm = suspension%vectors(:, plan%wheels(load%start_of)%contact)
               load%force = 0.0_wp                     ! of find_start
               cycle
            end if
            load%arm = body%centre
            load%force = [0.0_wp, 0.0_wp, -body%mass*suspension%gravity]
         end associate
      end do
   end subroutine place_loads

   !> Computes wheels, with design points instead of arms.
   subroutine place_wheels(plan, x, suspension, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(suspension_t), intent(inout) :: suspension
      logical, intent(inout) :: is_good
      integer :: k

      do k = 1, size(plan%wheels)
         associate (wheel => suspension%wheels(k), this => plan%wheels(k))
            wheel%radius = number_at(x, this%radius, wheel%centre(3) - wheel%contact(3))
            wheel%tyre_rate = number_at(x, this%tyre_rate)
            wheel%tyre_width = number_at(x, this%tyre_width)
            wheel%sprung_mass = number_at(x, this%sprung_mass)
            call spin_of(wheel%side, number_at(x, this%toe), number_at(x, this%camber), &
               suspension%vectors(:, this%spin), wheel)
            if (wheel%has_crown) then
               wheel%crown = x(this%crown_radius)
               is_good = is_good .and. wheel%crown >= 0.0_wp .and. wheel%crown < wheel%radius
               call set_rim(wheel)
            end if
            is_good = is_good .and. wheel%side*wheel%centre(2) >= 0.0_wp .and. wheel%centre(3) > wheel%contact(3) &
               .and. wheel%side*wheel%spin(2) > 0.0_wp
            if (wheel%has_steer_axis) &
               is_good = is_good .and. norm2(wheel%steer_axis(:, 2) - wheel%steer_axis(:, 1)) > 0.0_wp
         end associate
      end do
   end subroutine place_wheels

   !> Computes the numbers of the cases for the parameters x.
   subroutine realise_cases(plan, x, cases, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(case_t), intent(inout) :: cases(:)
      logical, intent(inout) :: is_good
      real(wp) :: travel                     ! of the rack
      integer :: k, j

      do k = 1, size(cases)
         associate (this => plan%cases(k))
            cases(k)%offset = number_at(x, this%offset)
            if (cases(k)%test == 'table') cycle
            if (has_manoeuvres(cases(k))) then
               do j = 1, size(cases(k)%manoeuvres)
                  associate (to => cases(k)%manoeuvres(j), from => plan%manoeuvres(j))
                     to%vertical = number_at(x, from%vertical, 1.0_wp)
                     to%longitudinal = number_at(x, from%longitudinal)
                     to%lateral = number_at(x, from%lateral)
                     to%downforce = number_at(x, from%downforce)
                     to%steer = number_at(x, from%steer)
                     if (from%wheels > 0) to%wheels = x(from%wheels:from%wheels + 1)
                  end associate
               end do
               cycle
            end if
            cases(k)%from = number_at(x, this%from)
            cases(k)%to = number_at(x, this%to)
            is_good = is_good .and. abs(cases(k)%to - cases(k)%from) > 0.0_wp
            if (is_grid(cases(k))) then
               travel = number_at(x, plan%steering(2))
               cases(k)%steer_from = number_at(x, this%steer_from, -travel)
               cases(k)%steer_to = number_at(x, this%steer_to, travel)
               is_good = is_good .and. abs(cases(k)%steer_to - cases(k)%steer_from) > 0.0_wp
            end if
            if (cases(k)%test == 'roll') is_good = is_good .and. max(abs(cases(k)%from), abs(cases(k)%to)) <= steepest_roll
         end associate
      end do
   end subroutine realise_cases

end module ek_realise
