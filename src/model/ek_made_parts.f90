!> Parts that are made with deviations (&part): a point deviates in one body or rod, and in no other part.
!>
!> What a body carries at the point is that of the body in an axle whose point is moved: the arms of its joints, springs, bushings
!> and loads, and the directions fixed in it that two points give. So if all parts at a point deviate alike, the axle is that with
!> the moved point. A rod (distance joint) has the length of the axle with the moved point. Springs, gaps of bushings, and the
!> targets of all other rows keep the design values of the drawn axle.
!>
!> ek_adjust puts these numbers in place of the drawn ones, after the preload trim.
module ek_made_parts
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, measure_numbers_t, global_gap, contact_gap, is_of_angle
   use ek_elastic, only: set_bushing_axes
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: begin_made, make_part, put_made

contains

   !> Copies the numbers of all parts as drawn.
   pure subroutine begin_made(self)
      type(suspension_t), intent(inout) :: self
      integer :: k

      associate (made => self%made)
         if (.not. allocated(made%terms)) then
            allocate (made%terms(size(self%terms)), made%readouts(size(self%readouts)), made%elements(size(self%elements)))
            allocate (made%markers(3, 3, size(self%elements) - self%scalars), made%wheels(size(self%wheels)))
            allocate (made%longer(size(self%rows)), made%centres(3, size(self%bodies)), made%loads(3, size(self%loads)))
            allocate (made%joints(3, size(self%joints)), made%axes(3, 2, size(self%joints)))
         end if
         made%terms(:) = self%terms%measure%measure_numbers_t
         made%readouts(:) = self%readouts%measure%measure_numbers_t
         made%elements(:) = self%elements%measure%measure_numbers_t
         do k = 1, size(made%markers, 3)
            made%markers(:, :, k) = self%elements(self%scalars + k)%bushing%axes
         end do
         made%wheels(:) = self%wheels%wheel_place_t
         made%longer(:) = 0.0_wp
         do k = 1, size(self%bodies)
            made%centres(:, k) = self%bodies(k)%centre
         end do
         do k = 1, size(self%loads)
            made%loads(:, k) = self%loads(k)%arm
         end do
         do k = 1, size(self%joints)
            made%joints(:, k) = self%joints(k)%arm_j
            made%axes(:, :, k) = self%joints(k)%axis
         end do
      end associate
   end subroutine begin_made

   !> Makes one part: a rod if `row` is not 0, otherwise a body. `moved` is the axle whose points are moved as those of the part.
   pure subroutine make_part(moved, body, row, self)
      type(suspension_t), intent(in) :: moved
      integer, intent(in) :: body              !! 0: the chassis
      integer, intent(in) :: row
      type(suspension_t), intent(inout) :: self
      real(wp) :: shift(3)                     ! from the reference point of the drawn body to that of the moved one
      integer :: k

      if (row > 0) then
         self%made%longer(row) = moved%rows(row)%target - self%rows(row)%target
         return
      end if
      shift = 0.0_wp
      if (body > 0) shift = moved%bodies(body)%origin - self%bodies(body)%origin
      associate (made => self%made)
         do k = 1, size(made%terms)
            call take(moved%terms(k)%measure, made%terms(k))
         end do
         do k = 1, size(made%readouts)
            call take(moved%readouts(k)%measure, made%readouts(k))
         end do
         do k = 1, size(made%elements)
            call take(moved%elements(k)%measure, made%elements(k))
         end do
         do k = 1, size(made%markers, 3)
            associate (from => moved%elements(self%scalars + k))
               if (from%measure%body_i == body) made%markers(:, :, k) = from%bushing%axes
            end associate
         end do
         do k = 1, size(made%wheels)
            if (moved%wheels(k)%body /= body) cycle
            made%wheels(k) = moved%wheels(k)%wheel_place_t
            made%wheels(k)%centre = moved%wheels(k)%centre + shift
            made%wheels(k)%contact = moved%wheels(k)%contact + shift
            made%wheels(k)%steer_axis = moved%wheels(k)%steer_axis + spread(shift, 2, 2)
         end do
         if (body > 0) made%centres(:, body) = moved%bodies(body)%centre + shift
         do k = 1, size(made%loads, 2)
            if (moved%loads(k)%body == body) made%loads(:, k) = moved%loads(k)%arm + shift
         end do
         do k = 1, size(made%joints, 2)
            if (moved%joints(k)%body_j == body) made%joints(:, k) = moved%joints(k)%arm_j + shift
            if (moved%joints(k)%body_i == body) made%axes(:, 1, k) = moved%joints(k)%axis(:, 1)
            if (moved%joints(k)%body_j == body) made%axes(:, 2, k) = moved%joints(k)%axis(:, 2)
         end do
      end associate

   contains

      !> Takes the arms and directions of a measure that are fixed in the body.
      pure subroutine take(from, to)
         type(measure_t), intent(in) :: from
         type(measure_numbers_t), intent(inout) :: to

         if (from%body_i == body) then
            if (.not. is_of_angle(from%kind)) to%arm_i = from%arm_i + shift
            if (.not. any(from%kind == [global_gap, contact_gap])) to%u = from%u
         end if
         if (from%body_j == body) then
            if (.not. is_of_angle(from%kind)) to%arm_j = from%arm_j + shift
            to%v = from%v
         end if
      end subroutine take

   end subroutine make_part

   !> Puts the numbers of the parts as made in place of the drawn ones.
   pure subroutine put_made(self)
      type(suspension_t), intent(inout) :: self
      real(wp) :: rise(2)
      integer :: k

      associate (made => self%made)
         self%terms(:)%measure%measure_numbers_t = made%terms
         self%readouts(:)%measure%measure_numbers_t = made%readouts
         self%elements(:)%measure%measure_numbers_t = made%elements
         do k = 1, size(made%markers, 3)
            self%elements(self%scalars + k)%bushing%axes = made%markers(:, :, k)
            call set_bushing_axes(self%elements(self%scalars + k)%bushing)
         end do
         do k = 1, size(self%wheels)
            rise = self%wheels(k)%start_rise
            self%wheels(k)%wheel_place_t = made%wheels(k)
            self%wheels(k)%start_rise = rise
         end do
         self%rows(:)%target = self%rows%target + made%longer
         do k = 1, size(self%bodies)
            self%bodies(k)%centre = made%centres(:, k)
         end do
         do k = 1, size(self%loads)
            self%loads(k)%arm = made%loads(:, k)
         end do
         do k = 1, size(self%joints)
            self%joints(k)%arm_j = made%joints(:, k)
            self%joints(k)%axis = made%axes(:, :, k)
         end do
      end associate
   end subroutine put_made

end module ek_made_parts
