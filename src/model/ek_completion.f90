!> Completes a suspension whose parts are at their design points: reference points, arms, design values.
module ek_completion
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, measure_value, is_of_angle, distance
   use ek_element, only: bushing_element, set_design_value
   use ek_elastic, only: set_bushing_axes
   use ek_suspension, only: suspension_t
   use ek_wheel_contact, only: put_at_contact
   implicit none(type, external)
   private
   public :: settle_design, settle_element

contains

   !> Sets the reference points, converts design points to arms, and computes design values: the targets of the rows, and the design
   !> values of readouts and elements. Cannot fail and allocates nothing.
   pure subroutine settle_design(self)
      type(suspension_t), intent(inout) :: self
      integer :: k, t

      if (are_checked .and. size(self%rows) > 0) call require(sum(self%rows%terms) == size(self%terms) .and. &
         all(self%rows%first + self%rows%terms - 1 <= size(self%terms)), 'settle_design: rows and terms do not belong together')
      call settle_origins(self)
      do k = 1, size(self%terms)
         call subtract_origins(self, self%terms(k)%measure)
      end do
      do k = 1, size(self%readouts)
         call subtract_origins(self, self%readouts(k)%measure)
      end do
      do k = 1, size(self%elements)
         call settle_element(k, self)
      end do
      do k = 1, size(self%joints)
         self%joints(k)%arm_j = self%joints(k)%arm_j - origin_of(self, self%joints(k)%body_j)
      end do
      do k = 1, size(self%bodies)
         self%bodies(k)%centre = self%bodies(k)%centre - self%bodies(k)%origin
      end do
      do k = 1, size(self%loads)
         self%loads(k)%arm = self%loads(k)%arm - origin_of(self, self%loads(k)%body)
      end do
      do k = 1, size(self%wheels)        ! then their loads
         associate (w => self%wheels(k))
            w%centre = w%centre - origin_of(self, w%body)
            w%contact = w%contact - origin_of(self, w%body)
            w%steer_axis = w%steer_axis - spread(origin_of(self, w%body), 2, 2)
         end associate
      end do
      do k = 1, size(self%loads)
         t = self%loads(k)%wheel
         if (t > 0) call put_at_contact(self%wheels, t, self%loads(k))
      end do

      do k = 1, size(self%rows)
         self%rows(k)%target = 0.0_wp
         do t = self%rows(k)%first, self%rows(k)%first + self%rows(k)%terms - 1
            associate (m => self%terms(t)%measure)
               self%rows(k)%target = self%rows(k)%target + self%terms(t)%coefficient*design_value(self, m)
            end associate
         end do
      end do
      do k = 1, size(self%readouts)
         self%readouts(k)%design_value = design_value(self, self%readouts(k)%measure)
      end do
   end subroutine settle_design

   !> Converts the design points of an element to arms, and computes its values at design. The reference points of the bodies are
   !> settled.
   pure subroutine settle_element(k, self)
      integer, intent(in) :: k
      type(suspension_t), intent(inout) :: self

      associate (element => self%elements(k), measure => self%elements(k)%measure)
         if (element%kind == bushing_element) element%bushing%gap0 = measure%arm_j - measure%arm_i
         if (measure%kind == distance) call set_design_value(element, norm2(measure%arm_j - measure%arm_i))
         if (.not. is_of_angle(measure%kind)) call subtract_origins(self, measure)
         if (element%kind == bushing_element) then
            call set_bushing_axes(element%bushing)
         else if (measure%kind /= distance) then
            call set_design_value(element, design_value(self, measure))
         end if
      end associate
   end subroutine settle_element

   !> The value of a measure with arms at design, in the unit of the measure.
   pure real(wp) function design_value(self, measure) result(value)
      type(suspension_t), intent(in) :: self
      type(measure_t), intent(in) :: measure
      type(pose_t) :: pose_i, pose_j

      pose_i%r = origin_of(self, measure%body_i)
      pose_j%r = origin_of(self, measure%body_j)
      value = measure_value(measure, pose_i, pose_j)
   end function design_value

   !> Sets the reference point of each body for which the deck gives no reference point: the mean of the attachment points.
   pure subroutine settle_origins(self)
      type(suspension_t), intent(inout) :: self
      integer :: k, first, last

      do k = 1, size(self%bodies)
         self%bodies(k)%attached = 0
         if (.not. self%bodies(k)%has_origin) self%bodies(k)%origin = 0.0_wp
      end do
      do k = 1, size(self%joints)
         first = self%rows(self%joints(k)%first_row)%first
         last = first
         if (.not. self%joints(k)%is_of_measures) last = first + self%joints(k)%rows - 1
         if (all(is_of_angle(self%terms(first:last)%measure%kind))) cycle      ! angles do not locate a body
         call include_points(self, self%terms(first)%measure)
      end do
      do k = 1, size(self%elements)
         if (.not. is_of_angle(self%elements(k)%measure%kind)) call include_points(self, self%elements(k)%measure)
      end do
      do k = 1, size(self%bodies)
         associate (body => self%bodies(k))
            if (.not. body%has_origin .and. body%attached > 0) body%origin = body%origin/body%attached
         end associate
      end do
   end subroutine settle_origins

   !> Adds both design points of a measure to the sums of the attachment points of its bodies, which `origin` still contains.
   pure subroutine include_points(self, m)
      type(suspension_t), intent(inout) :: self
      type(measure_t), intent(in) :: m
      integer :: end, body

      do end = 1, 2
         body = merge(m%body_i, m%body_j, end == 1)
         if (body == 0) cycle
         if (self%bodies(body)%has_origin) cycle
         self%bodies(body)%origin = self%bodies(body)%origin + merge(m%arm_i, m%arm_j, end == 1)
         self%bodies(body)%attached = self%bodies(body)%attached + 1
      end do
   end subroutine include_points

   !> Converts the design points of a measure to arms.
   pure subroutine subtract_origins(self, measure)
      type(suspension_t), intent(in) :: self
      type(measure_t), intent(inout) :: measure
      measure%arm_i = measure%arm_i - origin_of(self, measure%body_i)
      measure%arm_j = measure%arm_j - origin_of(self, measure%body_j)
   end subroutine subtract_origins

   !> Reference point of a body at design [m]; for the chassis, the global origin.
   pure function origin_of(self, body) result(origin)
      type(suspension_t), intent(in) :: self
      integer, intent(in) :: body
      real(wp) :: origin(3)
      origin = 0.0_wp
      if (body > 0) origin = self%bodies(body)%origin
   end function origin_of

end module ek_completion
