!> Sets the adjusters of a suspension (ek_adjuster): moves the arms of the parts that they carry. The parts are those as made
!> (ek_made_parts).
!>
!> The design position, the design values of springs and measures and the preloads stay those of the drawn axle. The rows of Φ are
!> therefore not satisfied at design if an adjuster has a value; the solution finds the position that satisfies them.
module ek_adjust
   use ek_kinds, only: wp
   use ek_adjuster, only: adjuster_t, place_t, moved_point, turned_direction, rod_of_joint, seat, of_term, of_element, &
      of_joint, of_readout, of_load, of_centre, of_contact, of_axis
   use ek_measure, only: measure_t, global_gap
   use ek_made_parts, only: put_made
   use ek_suspension, only: suspension_t
   use ek_wheel_contact, only: put_at_contact
   implicit none(type, external)
   private
   public :: adjust, is_adjusted

contains

   !> Whether an adjuster has a value, or a part a deviation: the bodies then leave the design position.
   pure logical function is_adjusted(suspension)
      type(suspension_t), intent(in) :: suspension
      is_adjusted = suspension%made%has_deviations .or. any(abs(suspension%adjusters%value) > 0.0_wp)
   end function is_adjusted

   !> Makes all parts as they are, and sets all adjusters of a suspension, unless this is done already.
   pure subroutine adjust(suspension)
      type(suspension_t), intent(inout) :: suspension
      integer :: k, w

      if (suspension%has_set_adjusters) return
      suspension%has_set_adjusters = .true.
      if (suspension%made%has_deviations) call put_made(suspension)
      do k = 1, size(suspension%adjusters)
         associate (this => suspension%adjusters(k))
            if (this%kind == rod_of_joint) then
               suspension%rows(this%row)%target = suspension%rows(this%row)%target + this%value
            else if (this%kind == seat) then
               associate (law => suspension%elements(this%element)%law)
                  law%reference = law%reference + this%value
               end associate
            end if
         end associate
      end do
      do k = 1, size(suspension%places)
         associate (place => suspension%places(k))
            if (.not. abs(suspension%adjusters(place%adjuster)%value) > 0.0_wp) cycle
            call move(suspension%adjusters(place%adjuster), place, suspension)
         end associate
      end do
      do k = 1, size(suspension%loads)
         w = max(suspension%loads(k)%wheel, suspension%loads(k)%start_of)
         if (w > 0) call put_at_contact(suspension%wheels, w, suspension%loads(k))
      end do
   end subroutine adjust

   !> Moves one arm.
   pure subroutine move(adjuster, place, suspension)
      type(adjuster_t), intent(in) :: adjuster
      type(place_t), intent(in) :: place
      type(suspension_t), intent(inout) :: suspension
      real(wp) :: origin(3)

      origin = 0.0_wp
      if (adjuster%body > 0) origin = suspension%bodies(adjuster%body)%origin
      select case (place%part)
      case (of_term)
         call move_measure(suspension%terms(place%index)%measure)
      case (of_element)
         call move_measure(suspension%elements(place%index)%measure)
      case (of_readout)
         call move_measure(suspension%readouts(place%index)%measure)
      case (of_joint)
         call move_arm(suspension%joints(place%index)%arm_j)
      case (of_load)
         call move_arm(suspension%loads(place%index)%arm)
      case (of_centre)
         call move_arm(suspension%wheels(place%index)%centre)
      case (of_contact)
         call move_arm(suspension%wheels(place%index)%contact)
      case (of_axis)
         call move_arm(suspension%wheels(place%index)%steer_axis(:, place%side))
      end select

   contains

      !> Moves the arm of a measure on one of its bodies, with the direction that is fixed in this body.
      pure subroutine move_measure(measure)
         type(measure_t), intent(inout) :: measure

         if (place%side == 1) then
            call move_arm(measure%arm_i)
            if (measure%kind /= global_gap) measure%u = turned_direction(adjuster, measure%u)
         else
            call move_arm(measure%arm_j)
            measure%v = turned_direction(adjuster, measure%v)
         end if
      end subroutine move_measure

      pure subroutine move_arm(arm)
         real(wp), intent(inout) :: arm(3)
         arm = moved_point(adjuster, origin + arm, place%share) - origin
      end subroutine move_arm

   end subroutine move

end module ek_adjust
