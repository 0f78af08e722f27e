!> The columns of a state itself: wheels, springs, measures, bushings, joints, tilts. Columns that need the compliance matrix are in
!> ek_kandc_columns.
!>
!> Units are mm, N, deg, N m regardless of the deck's units; vectors are in the deck's frame. input/QUANTITIES.md defines each
!> column.
module ek_state_columns
   use ek_kinds, only: wp, degree, millimetre
   use ek_quantity, only: wheel_position, steer_axis, axis
   use ek_measure, only: measure_t, measure_value, axis_axis, rotation
   use ek_tilt, only: tilt_between, tilt_of_end
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_law, only: deflection
   use ek_element, only: element_kinds, is_of_angle
   use ek_element_force, only: spring_tension
   use ek_elastic, only: deflect_bushing, bushing_load
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_kkt, only: kkt_t
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_attitude, only: attitude_t, axis_values
   use ek_column_list, only: column_list_t, begin_list, add_quantities, add_column, end_block, fill_block, choose
   implicit none(type, external)
   private
   public :: list_state, state_columns, state_values, block_vector, has_wheels, has_joints, has_only_wheels
   public :: most_values
   public :: of_position, of_axis, of_element, of_readout, of_bushing, of_joint, of_tilt, of_adjuster, measure_of_tilt

   ! sections: of a wheel, an element of one measure, a measure, a bushing, a joint, a rated tilt, an adjuster of &align
   integer, parameter :: of_position = 1, of_axis = 2, of_element = 3, of_readout = 4, of_bushing = 5, of_joint = 6, of_tilt = 7, &
      of_adjuster = 8
   integer, parameter :: most_values = max(12, size(wheel_position), size(steer_axis))   !! greatest number of values of a section

   ! rotations, cosines, lengths: ending of the column of an element's value, and its unit
   character(*), parameter :: endings(3) = [character(10) :: '_angle_deg', '_cosine', '_length_mm']
   real(wp), parameter :: units(3) = [degree, 1.0_wp, millimetre]

contains

   !> Lists the columns of a model. All are requested.
   subroutine state_columns(suspension, list)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(out) :: list
      logical, allocatable :: is_wanted(:)

      call list_state(suspension, list)
      allocate (is_wanted(list%used), source=.true.)
      call choose(list, is_wanted)
   end subroutine state_columns

   !> Lists the names of the columns of a model: list%names(:list%used). `choose` must mark the requested columns before any column
   !> is filled.
   subroutine list_state(suspension, list)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(out) :: list
      character(len(endings)) :: ending
      integer :: j, k

      call begin_list(list, 128)
      do k = 1, size(suspension%wheels)
         call add_quantities(list, wheel_position, prefix_of(suspension, k), 0)
         call end_block(list, of_position, k)
         call add_quantities(list, steer_axis, prefix_of(suspension, k), merge(axis, 0, suspension%wheels(k)%has_steer_axis))
         call end_block(list, of_axis, k)
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
         call end_block(list, of_element, k)
      end do
      do k = 1, size(suspension%readouts)
         ending = endings(which(suspension%readouts(k)%measure%kind))
         call add_column(list, suspension%readouts(k)%name//trim(ending(index(ending, '_', back=.true.):)))
         call end_block(list, of_readout, k)
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         call add_three(suspension%elements(k)%name//'_d', 'mm')
         call add_three(suspension%elements(k)%name//'_r', 'deg')
         call add_three(suspension%elements(k)%name//'_f', 'n')
         call add_three(suspension%elements(k)%name//'_m', 'nm')
         call end_block(list, of_bushing, k)
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
         call end_block(list, of_joint, k)
      end do
      do k = 1, size(suspension%tilts)
         call add_column(list, suspension%tilts(k)%name//'_deg')
         call end_block(list, of_tilt, k)
      end do
      do j = 1, size(suspension%aligns)
         do k = 1, suspension%aligns(j)%angles
            call add_column(list, 'adjuster_'//suspension%adjusters(suspension%aligns(j)%adjusters(k))%name//'_mm')
            call end_block(list, of_adjuster, suspension%aligns(j)%adjusters(k))
         end do
      end do

   contains

      !> Adds the columns x, y and z of a vector.
      subroutine add_three(stem, unit)
         character(*), intent(in) :: stem, unit
         call add_column(list, stem//'x_'//unit)
         call add_column(list, stem//'y_'//unit)
         call add_column(list, stem//'z_'//unit)
      end subroutine add_three

   end subroutine list_state

   !> Whether any column of a wheel is requested.
   pure logical function has_wheels(list)
      type(column_list_t), intent(in) :: list
      integer :: k

      has_wheels = .false.
      do k = 1, size(list%blocks)
         has_wheels = has_wheels .or. list%section(list%blocks(k)) <= of_axis
      end do
   end function has_wheels

   !> Whether only columns of wheels are requested. They follow from the attitudes of the wheels.
   pure logical function has_only_wheels(list)
      type(column_list_t), intent(in) :: list
      integer :: k

      has_only_wheels = .true.
      do k = 1, size(list%blocks)
         has_only_wheels = has_only_wheels .and. list%section(list%blocks(k)) <= of_axis
      end do
   end function has_only_wheels

   !> Whether any column of a joint is requested.
   pure logical function has_joints(list)
      type(column_list_t), intent(in) :: list
      integer :: k

      has_joints = .false.
      do k = 1, size(list%blocks)
         has_joints = has_joints .or. list%section(list%blocks(k)) == of_joint
      end do
   end function has_joints

   !> Computes the values of the requested columns at a state.
   pure subroutine state_values(suspension, state, wheels, kkt, list, row)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(attitude_t), intent(in) :: wheels(:)  !! at this state, if has_wheels
      type(kkt_t), intent(in) :: kkt             !! if has_joints, assembled at this state; provides the gradients of the rows
      type(column_list_t), intent(in) :: list    !! of state_columns
      real(wp), intent(inout) :: row(*)          !! one per column; values not requested are unchanged
      real(wp) :: values(most_values)
      integer :: k

      do k = 1, size(list%blocks)
         call block_vector(suspension, state, wheels, kkt, list, list%blocks(k), values)
         call fill_block(list, list%blocks(k), values, .true., row)
      end do
   end subroutine state_values

   !> Computes the values of all quantities of one block. A new section needs its case here; ek_state_blocks is right without
   !> one if the values do not follow from reactions, but with one its derivatives are cheaper.
   pure subroutine block_vector(suspension, state, wheels, kkt, list, b, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(attitude_t), intent(in) :: wheels(:)  !! as for state_values
      type(kkt_t), intent(in) :: kkt             !! as for state_values
      type(column_list_t), intent(in) :: list
      integer, intent(in) :: b                   !! index of the block
      real(wp), intent(inout) :: values(most_values)      !! as fill_block takes them
      real(wp) :: frame(3)

      frame = deck_frame(suspension)
      select case (list%section(b))
      case (of_position)
         call position_values(wheels(list%item(b)), frame, values)
      case (of_axis)
         values(:size(steer_axis)) = axis_values(wheels(list%item(b))%axis)
      case (of_element)
         call element_values(suspension, state, list%item(b), values)
      case (of_readout)
         associate (m => suspension%readouts(list%item(b))%measure)
            values(1) = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))/units(which(m%kind))
         end associate
      case (of_bushing)
         call bushing_values(suspension, state, list%item(b), values)
      case (of_joint)
         call joint_values(suspension, state, kkt%gradients, frame, list%item(b), values)
      case (of_tilt)
         values(1) = tilt_value(suspension, state, list%item(b))/degree
      case (of_adjuster)
         values(1) = suspension%adjusters(list%item(b))%value/millimetre
      end select
   end subroutine block_vector

   !> Computes the values of the section wheel_position, in SI.
   pure subroutine position_values(now, frame, values)
      type(attitude_t), intent(in) :: now
      real(wp), intent(in) :: frame(3)
      real(wp), intent(inout) :: values(most_values)

      values(1) = now%travel
      values(2) = now%toe
      values(3) = now%camber
      values(4) = now%track_change
      values(5) = now%wheelbase_change
      values(6:8) = frame*now%centre
      values(9:11) = frame*now%contact
   end subroutine position_values

   !> Computes the value of an element with one measure (length, angle, cosine, or the clearance of a stop), and its force (positive
   !> in compression) or moment, in the units of the columns.
   pure subroutine element_values(suspension, state, k, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      real(wp), intent(inout) :: values(most_values)
      real(wp) :: length, tension, slope

      associate (element => suspension%elements(k), m => suspension%elements(k)%measure)
         length = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
         call spring_tension(element, length, tension, slope)
         values(1) = length/units(which(m%kind))
         if (element_kinds(element%kind)%has_gap) values(1) = -deflection(element%law, length)/millimetre
         values(2) = -tension
      end associate
   end subroutine element_values

   !> Computes deflection, rotation, force and moment of a bushing in its marker axes, in the units of the columns.
   pure subroutine bushing_values(suspension, state, k, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      real(wp), intent(inout) :: values(most_values)
      real(wp) :: gap(3), theta(3)
      integer :: i

      associate (bushing => suspension%elements(k)%bushing, m => suspension%elements(k)%measure)
         call deflect_bushing(bushing, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), gap, theta)
         do i = 1, 3
            values(i) = dot_product(gap, bushing%axes(:, i))/millimetre
            values(i + 3) = dot_product(theta, bushing%axes(:, i))/degree
         end do
         call bushing_load(bushing, gap, theta, values(7:9), values(10:12))
      end associate
   end subroutine bushing_values

   !> Computes force and moment of a joint on its second body, at the point of the joint [N, N m], in the frame of the deck. For a
   !> joint of measures, computes the reaction of its first row.
   pure subroutine joint_values(suspension, state, gradients, frame, k, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gradients(:, :)    !! gradients of the terms of rows
      real(wp), intent(in) :: frame(3)
      integer, intent(in) :: k
      real(wp), intent(inout) :: values(most_values)
      real(wp) :: force(3), moment(3), arm(3)
      integer :: r, t

      associate (joint => suspension%joints(k))
         if (joint%is_of_measures) then
            values(1) = -state%reaction(joint%first_row)
            return
         end if
         force = 0.0_wp
         moment = 0.0_wp
         do r = joint%first_row, joint%first_row + joint%rows - 1
            do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
               force = force - state%reaction(r)*gradients(7:9, t)         ! on the second body: −λ × gradient
               moment = moment - state%reaction(r)*gradients(10:12, t)     ! about its reference point
            end do
         end do
         arm = rotated(state%poses(joint%body_j + 1)%a, joint%arm_j)
         values(1:3) = frame*force
         values(4:6) = frame*(moment - cross(arm, force))                  ! about the joint's point
      end associate
   end subroutine joint_values

   !> The tilt of a joint or bushing, or of an end of a rod [rad].
   pure real(wp) function tilt_value(suspension, state, k) result(value)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      type(measure_t) :: m
      real(wp) :: axis(3), at_design(3), arms(3, 2)

      m = measure_of_tilt(suspension, k)
      associate (this => suspension%tilts(k), pose_i => state%poses(m%body_i + 1), pose_j => state%poses(m%body_j + 1))
         axis = this%axis
         if (this%end == 0) then
            if (this%bushing > 0 .and. .not. norm2(axis) > 0.0_wp) &
               axis = suspension%elements(suspension%scalars + this%bushing)%bushing%axes(:, 3)
            value = tilt_between(pose_i, pose_j, axis)
            return
         end if
         arms = reshape([m%arm_i, m%arm_j], [3, 2])
         at_design = arms(:, 2) - arms(:, 1)
         if (m%body_j > 0) at_design = at_design + suspension%bodies(m%body_j)%origin
         if (m%body_i > 0) at_design = at_design - suspension%bodies(m%body_i)%origin
         value = tilt_of_end(state%poses(merge(m%body_i, m%body_j, this%end == 1) + 1), axis, &
            pose_j%r + rotated(pose_j%a, arms(:, 2)) - pose_i%r - rotated(pose_i%a, arms(:, 1)), at_design)
      end associate
   end function tilt_value

   !> The measure with the bodies of a tilt; for an end of a rod, also with its points.
   pure type(measure_t) function measure_of_tilt(suspension, k) result(measure)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k

      associate (this => suspension%tilts(k))
         if (this%bushing > 0) then
            measure = suspension%elements(suspension%scalars + this%bushing)%measure
         else
            measure = suspension%terms(suspension%rows(suspension%joints(this%joint)%first_row)%first)%measure
         end if
      end associate
   end function measure_of_tilt

   !> Index in `endings` and `units` for a kind of measure.
   pure integer function which(kind)
      integer, intent(in) :: kind
      which = 3
      if (kind == rotation) which = 1
      if (kind == axis_axis) which = 2
   end function which

   !> Whether any of a joint's rows has a moment. Rows between directions have moments.
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
