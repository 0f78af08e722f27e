!> The geometry of a design: its points and directions, and further geometry that the reader of a deck and `realise` both compute
!> from them.
module ek_design_vector
   use ek_kinds, only: wp
   use ek_rotation, only: cross, perpendicular, unit_vector, angle_between
   use ek_suspension, only: wheel_t
   use ek_wheel_contact, only: contact_at_design
   use ek_blueprint, only: blueprint_t, vector_t, inward, number_at, hardpoint, along, given, fixed, chosen, chosen_right, across, &
      lowest, off_left, off_right, in_plane
   implicit none(type, external)
   private
   public :: find_vectors, marker_axes, spin_of, plane

   real(wp), parameter :: plane = 1.0e-9_wp           !! distance from y = 0 [m]: a closer point exists once on a mirrored axle
   real(wp), parameter :: min_angle = 0.01_wp       !! smallest angle between x and z of a marker [deg]: below it, x is undefined

contains

   !> Computes all points [m] and directions; vector 0 must be zero. is_good is .false. if a vector has no direction, or if a
   !> hardpoint has left its side of the plane of &mirror, or this plane.
   pure subroutine find_vectors(plan, x, vectors, is_good, only, is_part)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: vectors(3, 0:*)
      logical, intent(out) :: is_good
      integer, intent(in), optional :: only      !! this vector alone
      logical, intent(in), optional :: is_part   !! of one part, whose points may leave the plane; default .false.
      logical :: may_leave
      integer :: k, first, last

      is_good = .true.
      may_leave = .false.
      if (present(is_part)) may_leave = is_part
      first = 1
      last = size(plan%vectors)
      if (present(only)) then
         first = only
         last = only
      end if
      do k = first, last
         associate (this => plan%vectors(k))
            select case (this%kind)
            case (fixed)
               vectors(:, k) = this%value
            case (hardpoint)
               vectors(:, k) = inward(plan, x(this%first:this%first + 2))
               if (may_leave) cycle
               if (this%stays == in_plane) is_good = is_good .and. abs(vectors(2, k)) < plane
               if (this%stays == off_left) is_good = is_good .and. vectors(2, k) <= -plane
               if (this%stays == off_right) is_good = is_good .and. vectors(2, k) >= plane
            case (lowest)
               call find_lowest(plan, x, this%wheel, vectors, vectors(:, k), is_good)
            case default
               call find_direction(plan, x, this, vectors, vectors(:, k), is_good)
            end select
         end associate
      end do
   end subroutine find_vectors

   !> Computes the contact point of a wheel with a crown at design. is_good becomes .false. if the radius of the crown is not
   !> smaller than that of the wheel.
   pure subroutine find_lowest(plan, x, w, vectors, contact, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: w                   !! index of the wheel
      real(wp), intent(in) :: vectors(3, 0:*)
      real(wp), intent(out) :: contact(3)
      logical, intent(inout) :: is_good
      type(wheel_t) :: wheel
      real(wp) :: core

      associate (this => plan%wheels(w))
         core = x(this%radius) - x(this%crown_radius)
         contact = vectors(:, this%centre)
         is_good = is_good .and. core > 0.0_wp
         if (.not. core > 0.0_wp) return
         call spin_of(plan%prototype%wheels(w)%side, number_at(x, this%toe), number_at(x, this%camber), &
            vectors(:, this%spin), wheel)
         contact = contact_at_design(contact, wheel%spin, core, x(this%crown_radius))
      end associate
   end subroutine find_lowest

   !> Computes a unit vector. If the vector has no direction, the result is zero and is_good becomes .false..
   pure subroutine find_direction(plan, x, this, vectors, direction, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: x(:)
      type(vector_t), intent(in) :: this
      real(wp), intent(in) :: vectors(3, 0:*)
      real(wp), intent(out) :: direction(3)
      logical, intent(inout) :: is_good
      real(wp), parameter :: mirror(3) = [1.0_wp, -1.0_wp, 1.0_wp]
      real(wp), parameter :: upright = 1.0e-3_wp      ! sine of the angle to the vertical: below it, longitudinal
      real(wp) :: a(3)

      a = vectors(:, this%a)
      select case (this%kind)
      case (along)
         direction = vectors(:, this%b) - a
      case (given)
         direction = inward(plan, x(this%first:this%first + 2))
      case (chosen)         ! in the axes of the deck, so that the choice is the same in either frame
         direction = a
         if (norm2(a) > 0.0_wp) direction = inward(plan, perpendicular(inward(plan, a)))
      case (chosen_right)
         direction = a
         if (norm2(a) > 0.0_wp) direction = mirror*inward(plan, perpendicular(inward(plan, mirror*a)))
      case (across)
         direction = [-a(2), a(1), 0.0_wp]
         if (norm2(direction) < upright) direction = [1.0_wp, 0.0_wp, 0.0_wp] - a(1)*a
      end select
      is_good = is_good .and. norm2(direction) > 0.0_wp
      if (norm2(direction) > 0.0_wp) direction = unit_vector(direction)
   end subroutine find_direction

   !> Computes the marker axes. z is unchanged, x is made perpendicular to z, and y = z × x. If z or x is zero, the axes are the
   !> global axes of the deck.
   pure subroutine marker_axes(plan, z, x, axes, is_good)
      type(blueprint_t), intent(in) :: plan
      real(wp), intent(in) :: z(3), x(3)          !! unit vectors, or both zero
      real(wp), intent(out) :: axes(3, 3)         !! columns x, y, z; x rearward
      logical, intent(inout) :: is_good           !! .false. if x is parallel to z
      real(wp) :: angle

      axes(:, 1) = inward(plan, [1.0_wp, 0.0_wp, 0.0_wp])
      axes(:, 2) = inward(plan, [0.0_wp, 1.0_wp, 0.0_wp])
      axes(:, 3) = [0.0_wp, 0.0_wp, 1.0_wp]
      if (.not. (norm2(z) > 0.0_wp .and. norm2(x) > 0.0_wp)) return
      angle = angle_between(x, z)
      if (min(angle, 180.0_wp - angle) < min_angle) then
         is_good = .false.
         return
      end if
      axes(:, 1) = unit_vector(x - dot_product(x, z)*z)
      axes(:, 2) = cross(z, axes(:, 1))
      axes(:, 3) = z
   end subroutine marker_axes

   !> Computes spin axis, toe and camber of a wheel, from the direction of the axis or from toe and camber. The axis points
   !> outboard: w = (−cos γ sin δ, side cos γ cos δ, −sin γ), with δ toe-in and γ camber (top outboard). The inverse is
   !> toe = atan2(−w_x, side w_y), camber = asin(−w_z).
   pure subroutine spin_of(side, toe, camber, direction, wheel)
      integer, intent(in) :: side
      real(wp), intent(in) :: toe, camber      !! rad
      real(wp), intent(in) :: direction(3)     !! unit, x rearward; zero: from toe and camber
      type(wheel_t), intent(inout) :: wheel    !! spin, toe, camber

      if (norm2(direction) > 0.0_wp) then
         wheel%spin = direction
         wheel%toe = atan2(-direction(1), side*direction(2))
         wheel%camber = asin(max(-1.0_wp, min(1.0_wp, -direction(3))))
      else
         wheel%spin = [-cos(camber)*sin(toe), side*cos(camber)*cos(toe), -sin(camber)]
         wheel%toe = toe
         wheel%camber = camber
      end if
   end subroutine spin_of

end module ek_design_vector
