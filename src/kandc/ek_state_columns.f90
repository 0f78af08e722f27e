!> The columns of a state itself: wheels, springs, measures, bushings, joints. Columns that need the compliance matrix are in
!> ek_kandc_columns.
!>
!> Units are mm, N, deg, N m regardless of the deck's units; vectors are in the deck's frame. input/QUANTITIES.md defines each of
!> them.
module ek_state_columns
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre
   use ek_quantity, only: wheel_position, axis
   use ek_measure, only: measure_value, axis_axis, rotation
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_joint, only: joint_t
   use ek_law, only: deflection
   use ek_element, only: element_kinds, is_of_angle
   use ek_element_force, only: spring_tension
   use ek_elastic, only: bushing_view_t, look_bushing, bushing_load
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_kkt, only: kkt_t
   use ek_wheel_side, only: prefix_of
   use ek_attitude, only: attitude_t, wheel_attitude, axis_values
   use ek_column_list, only: column_list_t, begin_list, add_quantities, add_column, end_block, fill_block
   implicit none(type, external)
   private
   public :: state_columns, state_values, measure_unit

contains

   !> The columns of a model, in the order in which state_values gives the values; each wheel is a block.
   subroutine state_columns(suspension, list)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(out) :: list
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
               call add_column(list, element%name//value_ending(element%measure%kind))
            end if
            call add_column(list, element%name//trim(merge('_moment_nm', '_force_n  ', is_of_angle(element%measure%kind))))
         end associate
      end do
      do k = 1, size(suspension%readouts)
         select case (suspension%readouts(k)%measure%kind)
         case (rotation)
            call add_column(list, suspension%readouts(k)%name//'_deg')
         case (axis_axis)
            call add_column(list, suspension%readouts(k)%name//'_cosine')
         case default
            call add_column(list, suspension%readouts(k)%name//'_mm')
         end select
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
               call add_column(list, joint%name//'_reaction_'//reaction_unit(suspension, joint%first_row))
            else
               call add_three(joint%name//'_f', 'n')
               if (has_moment(suspension, joint)) call add_three(joint%name//'_m', 'nm')
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
      type(bushing_view_t) :: view
      real(wp) :: frame(3), tension, slope, length, force(3), moment(3), arm(3)
      integer :: k, at, r

      frame = 1.0_wp
      if (suspension%is_iso) frame = [-1.0_wp, -1.0_wp, 1.0_wp]
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
            row(at + 1) = length/measure_unit(m%kind)
            if (element_kinds(element%kind)%has_gap) row(at + 1) = -deflection(element%law, length)/millimetre
            row(at + 2) = -tension
            at = at + 2
         end associate
      end do
      do k = 1, size(suspension%readouts)
         associate (m => suspension%readouts(k)%measure)
            at = at + 1
            row(at) = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))/measure_unit(m%kind)
         end associate
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         associate (bushing => suspension%elements(k)%bushing, m => suspension%elements(k)%measure)
            call look_bushing(bushing, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), view)
            row(at + 1:at + 3) = to_marker(bushing%axes, view%gap)/millimetre
            row(at + 4:at + 6) = to_marker(bushing%axes, view%turn%theta)/degree
            call bushing_load(bushing, view, force, moment)
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
               call add_reaction(suspension, kkt, state%reaction(r), r, force, moment)
            end do
            row(at + 1:at + 3) = frame*force
            at = at + 3
            if (.not. has_moment(suspension, joint)) cycle
            arm = rotated(state%poses(joint%body_j + 1)%a, joint%arm_j)
            moment = moment - cross(arm, force)      ! about the joint's point; a separate statement avoids a temporary of the row
            row(at + 1:at + 3) = frame*moment
            at = at + 3
         end associate
      end do
   end subroutine state_values

   !> Ending of the column of the value of the measure of an element.
   pure function value_ending(kind) result(ending)
      integer, intent(in) :: kind         !! kind of the measure
      character(:), allocatable :: ending

      select case (kind)
      case (rotation)
         ending = '_angle_deg'
      case (axis_axis)
         ending = '_cosine'
      case default
         ending = '_length_mm'
      end select
   end function value_ending

   !> Divisor of a measure's value for mm or deg.
   pure real(wp) function measure_unit(kind) result(unit)
      integer, intent(in) :: kind
      select case (kind)
      case (rotation)
         unit = degree
      case (axis_axis)
         unit = 1.0_wp
      case default
         unit = millimetre
      end select
   end function measure_unit

   !> Whether a joint's reaction has a moment about its point: only rows between directions produce one.
   pure logical function has_moment(suspension, joint)
      type(suspension_t), intent(in) :: suspension
      type(joint_t), intent(in) :: joint
      integer :: r

      has_moment = .false.
      do r = joint%first_row, joint%first_row + joint%rows - 1
         select case (suspension%terms(suspension%rows(r)%first)%measure%kind)
         case (axis_axis, rotation)
            has_moment = .true.
         end select
      end do
   end function has_moment

   !> Unit of λ of a row: N, or N m if the measure is an angle.
   pure function reaction_unit(suspension, row) result(unit)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      character(:), allocatable :: unit

      unit = 'n'
      select case (suspension%terms(suspension%rows(row)%first)%measure%kind)
      case (axis_axis, rotation)
         unit = 'nm'
      end select
   end function reaction_unit

   !> Adds the force and moment of a row on its second body: −λ × gradient; moment about the reference point.
   pure subroutine add_reaction(suspension, kkt, reaction, r, force, moment)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(in) :: reaction
      integer, intent(in) :: r
      real(wp), intent(inout) :: force(3), moment(3)
      integer :: t

      do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
         force = force - reaction*kkt%gradients(7:9, t)
         moment = moment - reaction*kkt%gradients(10:12, t)
      end do
   end subroutine add_reaction

   !> Eᵀ v
   pure function to_marker(axes, v) result(w)
      real(wp), intent(in) :: axes(3, 3), v(3)
      real(wp) :: w(3)
      w = [dot_product(axes(:, 1), v), dot_product(axes(:, 2), v), dot_product(axes(:, 3), v)]
   end function to_marker

end module ek_state_columns
