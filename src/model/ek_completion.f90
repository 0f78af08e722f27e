!> Completes a suspension after all parts have been added (ek_builder): reference points, arms, design values.
module ek_completion
   use ek_kinds, only: wp
   use ek_turn, only: pose_t
   use ek_measure, only: measure_t, measure_value, axis_axis, rotation
   use ek_element, only: measure_spring, bushing_element, is_of_angle, set_measure_design
   use ek_elastic, only: set_bushing_axes
   use ek_suspension, only: suspension_t, design_poses
   implicit none(type, external)
   private
   public :: complete

contains

   !> Sets the reference points, converts design points to arms, and computes design values: the targets of the rows and
   !> the design values of the readouts. Call it once, after the last add; it cannot fail.
   subroutine complete(self)
      type(suspension_t), intent(inout) :: self
      type(pose_t), allocatable :: poses(:)
      integer :: k, t

      call ensure_allocated(self)
      call settle_origins(self)
      do k = 1, size(self%terms)
         call subtract_origins(self, self%terms(k)%measure)
      end do
      do k = 1, size(self%readouts)
         call subtract_origins(self, self%readouts(k)%measure)
      end do
      do k = 1, size(self%elements)
         if (.not. is_of_angle(self%elements(k)%measure%kind)) call subtract_origins(self, self%elements(k)%measure)
         if (self%elements(k)%kind /= bushing_element) cycle
         associate (b => self%elements(k)%bushing, m => self%elements(k)%measure)
            b%gap0 = b%arm_j - b%arm_i
            b%arm_i = m%arm_i
            b%arm_j = m%arm_j
            call set_bushing_axes(b)
         end associate
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
      do k = 1, size(self%wheels)
         associate (w => self%wheels(k))
            w%centre = w%centre - origin_of(self, w%body)
            w%contact = w%contact - origin_of(self, w%body)
            w%steer_axis(:, 1) = w%steer_axis(:, 1) - origin_of(self, w%body)
            w%steer_axis(:, 2) = w%steer_axis(:, 2) - origin_of(self, w%body)
         end associate
      end do

      allocate (poses, source=design_poses(self))
      do k = 1, size(self%rows)
         self%rows(k)%target = 0.0_wp
         do t = self%rows(k)%first, self%rows(k)%first + self%rows(k)%terms - 1
            associate (m => self%terms(t)%measure)
               self%rows(k)%target = self%rows(k)%target + self%terms(t)%coefficient* &
                  measure_value(m, poses(m%body_i + 1), poses(m%body_j + 1))
            end associate
         end do
      end do
      do k = 1, size(self%readouts)
         associate (m => self%readouts(k)%measure)
            self%readouts(k)%design_value = measure_value(m, poses(m%body_i + 1), poses(m%body_j + 1))
         end associate
      end do
      do k = 1, size(self%elements)
         if (self%elements(k)%kind /= measure_spring) cycle
         associate (m => self%elements(k)%measure)
            call set_measure_design(self%elements(k), measure_value(m, poses(m%body_i + 1), poses(m%body_j + 1)))
         end associate
      end do
   end subroutine complete

   !> Sets the reference point of each body that has none: the mean of its attachment points.
   subroutine settle_origins(self)
      type(suspension_t), intent(inout) :: self
      real(wp) :: total(3, 0:size(self%bodies))
      integer :: count(0:size(self%bodies)), k, t

      total = 0.0_wp
      count = 0
      do k = 1, size(self%joints)
         t = self%rows(self%joints(k)%first_row)%first
         select case (self%joints(k)%kind)
         case ('parallel', 'perpendicular', 'driver', 'coupler')
            ! angles have no point: they do not locate a body
            if (any(self%terms(t)%measure%kind == [axis_axis, rotation])) cycle
         end select
         call include_measure(self%terms(t)%measure)
      end do
      do k = 1, size(self%elements)
         if (.not. is_of_angle(self%elements(k)%measure%kind)) call include_measure(self%elements(k)%measure)
      end do
      do k = 1, size(self%bodies)
         if (self%bodies(k)%has_origin .or. count(k) == 0) cycle
         self%bodies(k)%origin = total(:, k)/count(k)
      end do

   contains

      subroutine include_measure(m)
         type(measure_t), intent(in) :: m
         call include_point(m%body_i, m%arm_i)
         call include_point(m%body_j, m%arm_j)
      end subroutine include_measure

      subroutine include_point(body, point)
         integer, intent(in) :: body
         real(wp), intent(in) :: point(3)
         total(:, body) = total(:, body) + point
         count(body) = count(body) + 1
      end subroutine include_point

   end subroutine settle_origins

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

   !> Allocates components that were never added, as empty.
   pure subroutine ensure_allocated(self)
      type(suspension_t), intent(inout) :: self
      if (.not. allocated(self%bodies)) allocate (self%bodies(0))
      if (.not. allocated(self%points)) allocate (self%points(0))
      if (.not. allocated(self%joints)) allocate (self%joints(0))
      if (.not. allocated(self%rows)) allocate (self%rows(0))
      if (.not. allocated(self%terms)) allocate (self%terms(0))
      if (.not. allocated(self%elements)) allocate (self%elements(0))
      if (.not. allocated(self%loads)) allocate (self%loads(0))
      if (.not. allocated(self%wheels)) allocate (self%wheels(0))
      if (.not. allocated(self%readouts)) allocate (self%readouts(0))
      if (.not. allocated(self%balance)) self%balance = 'none'
      if (.not. allocated(self%title)) self%title = ''
      if (.not. allocated(self%where)) self%where = ''
      if (.not. allocated(self%axle%where)) self%axle%where = ''
      if (.not. allocated(self%steering%where)) self%steering%where = ''
      if (.not. allocated(self%steering%driver)) self%steering%driver = ''
   end subroutine ensure_allocated

end module ek_completion
