!> What the blocks of the columns of a state follow from: unknowns, and numbers of the design. The derivatives of the columns are
!> found block by block.
module ek_state_blocks
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, axis_axis, global_gap
   use ek_same_parts, only: same_measure, same_element, same_wheel
   use ek_suspension, only: suspension_t
   use ek_column_list, only: column_list_t
   use ek_state_columns, only: of_position, of_axis, of_element, of_readout, of_bushing, of_joint, of_tilt, of_adjuster, &
      measure_of_tilt
   implicit none(type, external)
   private
   public :: block_reads, same_block, parts_of_block, pair_of_block

contains

   !> Finds the unknowns that the values of a block follow from: unknowns of bodies, and reactions of rows. Values that follow from
   !> reactions are proportional to them.
   pure subroutine block_reads(suspension, list, b, is_read)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(in) :: list
      integer, intent(in) :: b                   !! index of the block
      logical, intent(out) :: is_read(:)         !! of each unknown of the system
      integer :: t

      is_read = .false.
      associate (k => list%item(b))
         select case (list%section(b))
         case (of_position, of_axis)
            call mark_body(suspension%wheels(k)%body, is_read)
         case (of_element, of_bushing)
            call mark_bodies(suspension%elements(k)%measure, is_read)
         case (of_readout)
            call mark_bodies(suspension%readouts(k)%measure, is_read)
         case (of_tilt)
            call mark_bodies(measure_of_tilt(suspension, k), is_read)
         case (of_adjuster)
         case (of_joint)
            associate (joint => suspension%joints(k))
               associate (first => suspension%unknowns() + joint%first_row)
                  is_read(first:first + joint%rows - 1) = .true.
               end associate
               if (joint%is_of_measures) return
               do t = first_term(suspension, joint%first_row), last_term(suspension, joint%first_row + joint%rows - 1)
                  associate (m => suspension%terms(t)%measure)
                     select case (m%kind)
                     case (global_gap)           ! a constant force at the point of the joint
                     case (axis_axis)            ! a moment that turns with the bodies
                        call mark_rotation(m%body_i, is_read)
                        call mark_rotation(m%body_j, is_read)
                     case default
                        call mark_body(joint%body_j, is_read)
                        call mark_bodies(m, is_read)
                     end select
                  end associate
               end do
            end associate
         case default
            is_read(:suspension%unknowns()) = .true.
         end select
      end associate
   end subroutine block_reads

   !> Marks the unknowns of the bodies of a measure.
   pure subroutine mark_bodies(measure, is_read)
      type(measure_t), intent(in) :: measure
      logical, intent(inout) :: is_read(:)

      call mark_body(measure%body_i, is_read)
      call mark_body(measure%body_j, is_read)
   end subroutine mark_bodies

   !> Marks the unknowns of a body.
   pure subroutine mark_body(body, is_read)
      integer, intent(in) :: body                !! 0: the chassis, which has none
      logical, intent(inout) :: is_read(:)
      if (body > 0) is_read(6*body - 5:6*body) = .true.
   end subroutine mark_body

   !> Marks the rotations of a body.
   pure subroutine mark_rotation(body, is_read)
      integer, intent(in) :: body                !! 0: the chassis, which has none
      logical, intent(inout) :: is_read(:)
      if (body > 0) is_read(6*body - 2:6*body) = .true.
   end subroutine mark_rotation

   !> Whether the values of a block at a state are equal in two designs: all numbers that they follow from are equal.
   pure logical function same_block(here, there, list, b)
      type(suspension_t), intent(in) :: here, there
      type(column_list_t), intent(in) :: list
      integer, intent(in) :: b                   !! index of the block
      integer :: t

      associate (k => list%item(b))
         select case (list%section(b))
         case (of_position, of_axis)
            associate (body => here%wheels(k)%body)
               same_block = same_wheel(here%wheels(k), there%wheels(k)) .and. &
                  .not. any(abs(here%bodies(body)%origin - there%bodies(body)%origin) > 0.0_wp)
            end associate
         case (of_element, of_bushing)
            same_block = same_element(here%elements(k), there%elements(k))
         case (of_readout)
            same_block = same_measure(here%readouts(k)%measure, there%readouts(k)%measure)
         case (of_tilt)
            same_block = same_tilt(here, there, k)
         case (of_joint)
            associate (a => here%joints(k), first => here%joints(k)%first_row)
               same_block = .true.
               do t = first_term(here, first), last_term(here, first + a%rows - 1)
                  associate (m => here%terms(t)%measure, other => there%terms(t)%measure)
                     if (m%kind == global_gap .or. m%kind == axis_axis) then      ! the arms are not used
                        same_block = same_block .and. .not. (any(abs(m%u - other%u) > 0.0_wp) .or. any(abs(m%v - other%v) > 0.0_wp))
                     else
                        same_block = same_block .and. same_measure(m, other) .and. &
                           .not. any(abs(a%arm_j - there%joints(k)%arm_j) > 0.0_wp)
                     end if
                  end associate
                  same_block = same_block .and. .not. abs(here%terms(t)%coefficient - there%terms(t)%coefficient) > 0.0_wp
               end do
            end associate
         case default
            same_block = .false.
         end select
      end associate
   end function same_block

   !> Whether a tilt has equal axes, and for an end of a rod equal points, in two designs.
   pure logical function same_tilt(here, there, k)
      type(suspension_t), intent(in) :: here, there
      integer, intent(in) :: k
      type(measure_t) :: a, b

      a = measure_of_tilt(here, k)
      b = measure_of_tilt(there, k)
      associate (this => here%tilts(k), other => there%tilts(k))
         same_tilt = .not. any(abs(this%axis - other%axis) > 0.0_wp)
         if (this%end > 0) then
            same_tilt = same_tilt .and. same_measure(a, b) .and. same_origin(a%body_i) .and. same_origin(a%body_j)
         else if (this%bushing > 0) then
            same_tilt = same_tilt .and. .not. any(abs(here%elements(here%scalars + this%bushing)%bushing%axes - &
               there%elements(there%scalars + this%bushing)%bushing%axes) > 0.0_wp)
         end if
      end associate

   contains

      !> Whether a body has the same reference point in both designs.
      pure logical function same_origin(body)
         integer, intent(in) :: body
         same_origin = .true.
         if (body > 0) same_origin = .not. any(abs(here%bodies(body)%origin - there%bodies(body)%origin) > 0.0_wp)
      end function same_origin

   end function same_tilt

   !> Finds the wheel whose attitude a block follows from, and the joint whose gradients; 0: none.
   pure subroutine parts_of_block(list, b, wheel, joint)
      type(column_list_t), intent(in) :: list
      integer, intent(in) :: b
      integer, intent(out) :: wheel, joint

      wheel = merge(list%item(b), 0, list%section(b) <= of_axis)
      joint = merge(list%item(b), 0, list%section(b) == of_joint)
   end subroutine parts_of_block

   !> Finds the bodies i and j if the values of a block follow from the pose of j relative to i alone. Both are 0 if one of the
   !> bodies is the chassis, or if the values follow from a global direction.
   pure subroutine pair_of_block(suspension, list, b, body_i, body_j)
      type(suspension_t), intent(in) :: suspension
      type(column_list_t), intent(in) :: list
      integer, intent(in) :: b                   !! index of the block
      integer, intent(out) :: body_i, body_j

      body_i = 0
      body_j = 0
      associate (k => list%item(b))
         select case (list%section(b))
         case (of_element, of_bushing)
            call take_pair(suspension%elements(k)%measure, body_i, body_j)
         case (of_readout)
            call take_pair(suspension%readouts(k)%measure, body_i, body_j)
         end select
      end associate
   end subroutine pair_of_block

   !> Takes the bodies of a measure, if their relative pose alone decides its value.
   pure subroutine take_pair(measure, body_i, body_j)
      type(measure_t), intent(in) :: measure
      integer, intent(inout) :: body_i, body_j

      if (measure%kind == global_gap .or. measure%body_i == 0 .or. measure%body_j == 0) return
      body_i = measure%body_i
      body_j = measure%body_j
   end subroutine take_pair

   !> Index of the first term of a row, of the last term of a row.
   pure integer function first_term(suspension, row)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      first_term = suspension%rows(row)%first
   end function first_term

   pure integer function last_term(suspension, row)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      last_term = suspension%rows(row)%first + suspension%rows(row)%terms - 1
   end function last_term

end module ek_state_blocks
