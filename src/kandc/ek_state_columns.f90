!> The columns of a state itself: wheels, springs, measures, bushings, joints. Columns that need the compliance matrix are in
!> ek_kandc_columns.
!>
!> Units are mm, N, deg, N m regardless of the deck's units; vectors are in the deck's frame. input/QUANTITIES.md defines each of
!> them.
module ek_state_columns
   use ek_kinds, only: wp, degree, millimetre
   use ek_quantity, only: wheel_position, axis
   use ek_measure, only: measure_value, axis_axis, rotation
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_law, only: deflection
   use ek_element, only: element_kinds, is_of_angle
   use ek_element_force, only: spring_tension
   use ek_elastic, only: bushing_evaluation_t, evaluate_bushing, bushing_load
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_kkt, only: kkt_t
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_attitude, only: attitude_t, wheel_attitude, axis_values
   use ek_column_list, only: column_list_t, begin_list, add_quantities, add_column, end_block, fill_block
   implicit none(type, external)
   private
   public :: state_columns, state_values

   ! rotations, cosines, lengths: ending of the column of an element's value, and its unit
   character(*), parameter :: endings(3) = [character(10) :: '_angle_deg', '_cosine', '_length_mm']
   real(wp), parameter :: units(3) = [degree, 1.0_wp, millimetre]

contains

   !> The columns of a model, in the order in which state_values gives the values; each wheel is a block.
   subroutine state_columns(suspension, list)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(out) :: list
      character(len(endings)) :: ending
      integer :: k

      call begin_list(list, 128)
      do k = 1, size(suspension%wheels)
         call add_quantities(list, wheel_position, prefix_of(suspension, k), &
            merge(axis, 0, suspension%wheels(k)%has_steer_axis))
         call end_block(list)
      end do
      do k = 1, suspension%scalars
         associate (element => suspension%elements(k))
            if (element_kinds(element%kind)%has_gap) then
               call add_column(list, element%name//'_gap_mm')
            else
               call add_column(list, element%name//trim(endings(which(element%measure%kind))))
            end if
            call add_column(list, element%name//trim(merge('_moment_nm', '_force_n  ', is_of_angle(element%measure%kind))))
         end associate
      end do
      do k = 1, size(suspension%readouts)
         ending = endings(which(suspension%readouts(k)%measure%kind))
         call add_column(list, suspension%readouts(k)%name//trim(ending(index(ending, '_', back=.true.):)))
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         call add_three(suspension%elements(k)%name//'_d', 'mm')
         call add_three(suspension%elements(k)%name//'_r', 'deg')
         call add_three(suspension%elements(k)%name//'_f', 'n')
         call add_three(suspension%elements(k)%name//'_m', 'nm')
      end do
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%is_of_measures) then
               call add_column(list, joint%name//'_reaction_'//trim(merge('nm', 'n ', has_moment(suspension, joint%first_row, 1))))
            else
               call add_three(joint%name//'_f', 'n')
               if (has_moment(suspension, joint%first_row, joint%rows)) call add_three(joint%name//'_m', 'nm')
            end if
         end associate
      end do

   contains

      subroutine add_three(stem, unit)
         character(*), intent(in) :: stem, unit
         call add_column(list, stem//'x_'//unit)
         call add_column(list, stem//'y_'//unit)
         call add_column(list, stem//'z_'//unit)
      end subroutine add_three

   end subroutine state_columns

   !> The values of the columns at a state.
   pure subroutine state_values(suspension, state, kkt, list, row)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt             !! assembled at this state; provides the gradients of the rows
      type(column_list_t), intent(in) :: list    !! of state_columns
      real(wp), intent(inout) :: row(:)          !! one per column
      type(attitude_t) :: now
      type(bushing_evaluation_t) :: evaluation
      real(wp) :: frame(3), tension, slope, length, force(3), moment(3), arm(3)
      integer :: k, at, r, t

      frame = deck_frame(suspension)
      do k = 1, size(suspension%wheels)
         now = wheel_attitude(suspension, state, k)
         call fill_block(list, k, [now%centre(3), now%toe, now%camber, now%track_change, now%wheelbase_change, &
            frame*now%centre, frame*now%contact, axis_values(now%axis)], .true., row)
      end do
      at = 0
      if (size(suspension%wheels) > 0) at = list%last(size(suspension%wheels))
      do k = 1, suspension%scalars
         associate (element => suspension%elements(k), m => suspension%elements(k)%measure)
            length = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
            call spring_tension(element, length, tension, slope)
            row(at + 1) = length/units(which(m%kind))
            if (element_kinds(element%kind)%has_gap) row(at + 1) = -deflection(element%law, length)/millimetre
            row(at + 2) = -tension
            at = at + 2
         end associate
      end do
      do k = 1, size(suspension%readouts)
         associate (m => suspension%readouts(k)%measure)
            at = at + 1
            row(at) = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))/units(which(m%kind))
         end associate
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         associate (bushing => suspension%elements(k)%bushing, m => suspension%elements(k)%measure)
            call evaluate_bushing(bushing, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            row(at + 1:at + 3) = matmul(evaluation%gap, bushing%axes)/millimetre
            row(at + 4:at + 6) = matmul(evaluation%rotation%theta, bushing%axes)/degree
            call bushing_load(bushing, evaluation, force, moment)
            row(at + 7:at + 9) = force
            row(at + 10:at + 12) = moment
            at = at + 12
         end associate
      end do
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%is_of_measures) then
               at = at + 1
               row(at) = -state%reaction(joint%first_row)
               cycle
            end if
            force = 0.0_wp
            moment = 0.0_wp
            do r = joint%first_row, joint%first_row + joint%rows - 1
               do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
                  force = force - state%reaction(r)*kkt%gradients(7:9, t)         ! on the second body: −λ × gradient
                  moment = moment - state%reaction(r)*kkt%gradients(10:12, t)     ! about its reference point
               end do
            end do
            row(at + 1:at + 3) = frame*force
            at = at + 3
            if (.not. has_moment(suspension, joint%first_row, joint%rows)) cycle
            arm = rotated(state%poses(joint%body_j + 1)%a, joint%arm_j)
            moment = moment - cross(arm, force)      ! about the joint's point; a separate statement avoids a temporary of the row
            row(at + 1:at + 3) = frame*moment
            at = at + 3
         end associate
      end do
   end subroutine state_values

   !> Row of the table above of a kind of measure.
   pure integer function which(kind)
      integer, intent(in) :: kind
      which = 3
      if (kind == rotation) which = 1
      if (kind == axis_axis) which = 2
   end function which

   !> Whether rows have a moment: those between directions.
   pure logical function has_moment(suspension, first, rows)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: first, rows
      integer :: r

      has_moment = .false.
      do r = first, first + rows - 1
         has_moment = has_moment .or. which(suspension%terms(suspension%rows(r)%first)%measure%kind) < 3
      end do
   end function has_moment

end module ek_state_columns
