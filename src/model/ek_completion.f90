!> Completes a suspension whose parts are at their design points: reference points, arms, design values.
module ek_completion
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_relative_rotation, only: pose_t
   use ek_measure, only: measure_t, measure_value, distance
   use ek_element, only: element_t, bushing_element, set_design_value
   use ek_elastic, only: set_bushing_axes
   use ek_suspension, only: suspension_t
   use ek_markers, only: find_point
   use ek_wheel_contact, only: put_at_contact
   implicit none(type, external)
   private
   public :: settle_design, settle_element

contains

   !> Sets the reference points, converts design points to arms, and computes design values: the targets of the rows, and the design
   !> values of readouts and elements. Cannot fail and allocates nothing.
   pure subroutine settle_design(self)
      type(suspension_t), intent(inout), target :: self
      real(wp), pointer, contiguous :: at(:)
      integer :: k, t

      if (are_checked .and. size(self%rows) > 0) call require(sum(self%rows%terms) == size(self%terms) .and. &
         all(self%rows%first + self%rows%terms - 1 <= size(self%terms)), 'settle_design: rows and terms do not belong together')
      call settle_origins(self)
      do k = 1, size(self%elements)                  ! from design points
         associate (element => self%elements(k), measure => self%elements(k)%measure)
            if (element%kind == bushing_element) element%bushing%gap0 = measure%arm_j - measure%arm_i
            if (measure%kind == distance) element%design_length = norm2(measure%arm_j - measure%arm_i)
         end associate
      end do
      do k = 1, size(self%markers)
         if (self%markers(k)%body == 0) cycle        ! at the origin
         call find_point(self, self%markers(k), at)
         if (associated(at)) at(1:3) = at(1:3) - self%bodies(self%markers(k)%body)%origin
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
      do k = 1, size(self%elements)
         associate (element => self%elements(k), measure => self%elements(k)%measure)
            if (element%kind /= bushing_element .and. measure%kind /= distance) &
               element%design_length = design_value(self, measure)
            call settle_element(element)
         end associate
      end do
   end subroutine settle_design

   !> Computes what follows from the numbers of an element and its length at design.
   pure subroutine settle_element(element)
      type(element_t), intent(inout) :: element

      if (element%kind == bushing_element) then
         call set_bushing_axes(element%bushing)
      else
         call set_design_value(element, (element%design_length))
      end if
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
      type(suspension_t), intent(inout), target :: self
      real(wp), pointer, contiguous :: at(:)
      integer :: k

      do k = 1, size(self%bodies)
         self%bodies(k)%attached = 0
         if (.not. self%bodies(k)%has_origin) self%bodies(k)%origin = 0.0_wp
      end do
      do k = 1, size(self%markers)
         if (.not. self%markers(k)%is_attachment .or. self%markers(k)%body == 0) cycle
         associate (body => self%bodies(self%markers(k)%body))
            if (body%has_origin) cycle
            call find_point(self, self%markers(k), at)
            body%origin = body%origin + at(1:3)
            body%attached = body%attached + 1
         end associate
      end do
      do k = 1, size(self%bodies)
         associate (body => self%bodies(k))
            if (.not. body%has_origin .and. body%attached > 0) body%origin = body%origin/body%attached
         end associate
      end do
   end subroutine settle_origins

   !> Reference point of a body at design [m]; for the chassis, the global origin.
   pure function origin_of(self, body) result(origin)
      type(suspension_t), intent(in) :: self
      integer, intent(in) :: body
      real(wp) :: origin(3)
      origin = 0.0_wp
      if (body > 0) origin = self%bodies(body)%origin
   end function origin_of

end module ek_completion
