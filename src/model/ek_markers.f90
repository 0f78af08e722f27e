!> The markers of a suspension: the points that its parts have on bodies, with the directions fixed there.
!>
!> Only this file lists the kinds of parts that are on bodies: `list_markers` when the deck is read, `find_point` and
!> `find_direction` for the numbers.
!> Loops over markers place the points of a design (ek_realise), convert them to arms (ek_completion), make parts with deviations
!> (ek_made_parts), and set adjusters (ek_adjust); the readers of adjusters and of deviations find what is at a point.
!>
!> A new kind of part needs its lines in these procedures, and its index in ek_suspension.
module ek_markers
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, global_gap, contact_gap, is_of_angle
   use ek_suspension, only: suspension_t, marker_t, of_term, of_readout, of_element, of_axes, of_joint, of_centre, of_contact, &
      of_steer_axis, of_body, of_mass, of_load
   use ek_blueprint, only: blueprint_t
   implicit none(type, external)
   private
   public :: list_markers, find_point, find_direction

contains

   !> Lists the markers of all parts of the prototype. The loads come last, as weights are added when all records are read.
   subroutine list_markers(plan)
      type(blueprint_t), intent(inout) :: plan
      type(marker_t), allocatable :: list(:)
      integer :: k, t, first, last

      allocate (list(0))
      associate (model => plan%prototype)
         do k = 1, size(plan%joints)
            associate (joint => model%joints(k), this => plan%joints(k))
               first = model%rows(joint%first_row)%first
               last = first + sum(model%rows(joint%first_row:joint%first_row + joint%rows - 1)%terms) - 1
               do t = first, last
                  if (allocated(this%readouts)) then
                     call add_readout(of_term, t, this%readouts(t - first + 1), t == first .and. has_points(k))
                  else
                     call add_measure(of_term, t, model%terms(t)%measure, this%ends, this%axes, t == first .and. has_points(k))
                  end if
               end do
               list = [list, marker_t(of_joint, k, 1, joint%body_i, this%ends(1), this%axes(1), only_turns=.true.), &
                  marker_t(of_joint, k, 2, joint%body_j, this%ends(2), this%axes(2))]
            end associate
         end do
         do k = 1, size(plan%readouts)
            call add_readout(of_readout, k, k, .false.)
         end do
         do k = 1, size(plan%elements)
            associate (measure => model%elements(k)%measure, this => plan%elements(k))
               if (this%readout > 0) then
                  call add_readout(of_element, k, this%readout, .not. is_of_angle(measure%kind))
               else
                  call add_measure(of_element, k, measure, this%ends, [this%axis, 0], .not. is_of_angle(measure%kind))
               end if
            end associate
         end do
         do k = 1, size(plan%bushings)
            associate (measure => model%elements(model%scalars + k)%measure, this => plan%bushings(k))
               call add_measure(of_element, model%scalars + k, measure, this%ends, [0, 0], .true.)
               list = [list, (marker_t(of_axes, model%scalars + k, t, measure%body_i, 0, merge(this%x, this%z, t == 1)), t=1, 3)]
            end associate
         end do
         do k = 1, size(plan%wheels)
            associate (body => model%wheels(k)%body, this => plan%wheels(k))
               list = [list, marker_t(of_centre, k, 1, body, this%centre, this%spin), &
                  marker_t(of_contact, k, 1, body, this%contact, this%spin), &
                  (marker_t(of_steer_axis, k, t, body, this%steer_axis(t)), t=1, 2)]
            end associate
         end do
         list = [list, (marker_t(of_body, k, 1, k, plan%bodies(k)%centre), k=1, size(plan%bodies)), &
            (marker_t(of_mass, k, 1, plan%masses(k)%body, plan%masses(k)%at), k=1, size(plan%masses)), &
            (marker_t(of_load, k, 1, model%loads(k)%body), k=1, size(model%loads))]
         first = size(list) - size(model%loads)
         list(first + 1:first + size(plan%loads))%point = plan%loads%at
      end associate
      call move_alloc(list, plan%prototype%markers)

   contains

      !> Whether a joint locates its bodies: angles do not.
      pure logical function has_points(k)
         integer, intent(in) :: k
         integer :: first, last

         associate (joint => plan%prototype%joints(k))
            first = plan%prototype%rows(joint%first_row)%first
            last = merge(first, first + joint%rows - 1, joint%is_of_measures)
         end associate
         has_points = .not. all(is_of_angle(plan%prototype%terms(first:last)%measure%kind))
      end function has_points

      !> Adds the markers of a part with the measure of a readout.
      subroutine add_readout(part, index, readout, is_attachment)
         integer, intent(in) :: part, index, readout
         logical, intent(in) :: is_attachment

         associate (this => plan%readouts(readout))
            call add_measure(part, index, plan%prototype%readouts(readout)%measure, this%ends, [this%u, this%v], is_attachment)
         end associate
      end subroutine add_readout

      !> Adds the markers of a part with a measure.
      subroutine add_measure(part, index, measure, ends, directions, is_attachment)
         integer, intent(in) :: part, index
         type(measure_t), intent(in) :: measure
         integer, intent(in) :: ends(2), directions(2)      !! indices of vectors
         logical, intent(in) :: is_attachment

         list = [list, marker_t(part, index, 1, measure%body_i, ends(1), directions(1), is_attachment, is_of_angle(measure%kind)), &
            marker_t(part, index, 2, measure%body_j, ends(2), directions(2), is_attachment, is_of_angle(measure%kind))]
      end subroutine add_measure

   end subroutine list_markers

   !> Finds the point of a marker: its arm, or its design point before the design is settled. `at` is not associated if the marker
   !> has no point of its own: that of a mass is in the centre of its body.
   pure subroutine find_point(self, marker, at)
      type(suspension_t), intent(inout), target :: self
      type(marker_t), intent(in) :: marker
      real(wp), pointer, contiguous, intent(out) :: at(:)

      nullify (at)
      associate (k => marker%index, side => marker%side)
         select case (marker%part)
         case (of_term)
            call find_end(self%terms(k)%measure, side, at)
         case (of_readout)
            call find_end(self%readouts(k)%measure, side, at)
         case (of_element)
            if (.not. is_of_angle(self%elements(k)%measure%kind)) call find_end(self%elements(k)%measure, side, at)
         case (of_joint)
            if (side == 2) at => self%joints(k)%arm_j
         case (of_centre)
            at => self%wheels(k)%centre
         case (of_contact)
            at => self%wheels(k)%contact
         case (of_steer_axis)
            at => self%wheels(k)%steer_axis(:, side)
         case (of_body)
            at => self%bodies(k)%centre
         case (of_load)
            at => self%loads(k)%arm
         end select
      end associate
   end subroutine find_point

   !> Finds the point on one side of a measure.
   pure subroutine find_end(measure, side, at)
      type(measure_t), intent(inout), target :: measure
      integer, intent(in) :: side
      real(wp), pointer, contiguous, intent(inout) :: at(:)

      if (side == 1) then
         at => measure%arm_i
      else
         at => measure%arm_j
      end if
   end subroutine find_end

   !> Finds the direction of a marker. `direction` is not associated if there is none, or a global one, which is fixed in no body.
   pure subroutine find_direction(self, marker, direction)
      type(suspension_t), intent(inout), target :: self
      type(marker_t), intent(in) :: marker
      real(wp), pointer, contiguous, intent(out) :: direction(:)

      nullify (direction)
      associate (k => marker%index, side => marker%side)
         select case (marker%part)
         case (of_term)
            call find_axis(self%terms(k)%measure, side, direction)
         case (of_readout)
            call find_axis(self%readouts(k)%measure, side, direction)
         case (of_element)
            call find_axis(self%elements(k)%measure, side, direction)
         case (of_axes)
            direction => self%elements(k)%bushing%axes(:, side)
         case (of_joint)
            direction => self%joints(k)%axis(:, side)
         case (of_centre)
            direction => self%wheels(k)%spin
         case (of_contact)
            direction => self%wheels(k)%rim
         end select
      end associate
   end subroutine find_direction

   !> Finds the direction of a measure that is fixed in the body of one side.
   pure subroutine find_axis(measure, side, direction)
      type(measure_t), intent(inout), target :: measure
      integer, intent(in) :: side
      real(wp), pointer, contiguous, intent(inout) :: direction(:)

      if (side == 2) then
         direction => measure%v
      else if (.not. any(measure%kind == [global_gap, contact_gap])) then
         direction => measure%u
      end if
   end subroutine find_axis

end module ek_markers
