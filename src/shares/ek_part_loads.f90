!> All forces and moments on each part (body) at a state, for stress analysis: members, loads of the deck, forces of the road, drivers
!> of the rig, weight and inertia.
!>
!> A load is given twice: at the hardpoint as it has moved, in the frame of the deck; and at the hardpoint as drawn, in the axes of
!> the part, which coincide with the frame of the deck at design and move with the part. The second form is loaded onto the drawn
!> part. The loads on a part at a state form a block, whose forces and moments about any point sum to zero in equilibrium.
module ek_part_loads
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, row_name
   use ek_path, only: path_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, residual_only, wrench
   use ek_member_loads, only: member_end_t, member_ends, end_loads
   use ek_wheel_side, only: deck_frame
   use ek_table, only: csv_cell
   implicit none(type, external)
   private
   public :: part_load_t, part_record_t, part_loads, begin_parts, add_parts, envelope_text

   !> One load on a part: its origin, point of application, force and moment about this point.
   type :: part_load_t
      character(:), allocatable :: source, point    !! name of the member or load; hardpoint: '' if there is none
      integer :: body = 0
      real(wp) :: at(3) = 0.0_wp                    !! point at the state, frame of the deck [m]
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp           !! frame of the deck [N, N m]
      real(wp) :: drawn_at(3) = 0.0_wp              !! point at design, frame of the deck [m]
      real(wp) :: own_force(3) = 0.0_wp, own_moment(3) = 0.0_wp   !! axes of the part [N, N m]
   end type part_load_t

   !> Smallest and largest value of a component of a load over all states, with the names of these states.
   type :: extreme_t
      real(wp) :: low = huge(1.0_wp), high = -huge(1.0_wp)
      character(:), allocatable :: low_name, high_name
   end type extreme_t

   !> The envelope of a load on a part: extremes of its components in the axes of the part.
   type :: envelope_t
      character(:), allocatable :: source, point
      integer :: body = 0
      type(extreme_t) :: extremes(6)
   end type envelope_t

   !> The loads on all parts in the named states of several cases.
   type :: part_record_t
      type(buffer_t), allocatable :: texts(:)       !! content of parts/<part>.csv, for each body
      type(envelope_t), allocatable :: envelopes(:)
      character(:), allocatable :: head             !! first line of every file
   end type part_record_t

   character(*), parameter :: nl = new_line('a')
   character(*), parameter :: components(6) = [character(2) :: 'fx', 'fy', 'fz', 'mx', 'my', 'mz']
   ! a value that exceeds an extreme by less does not replace it
   real(wp), parameter :: rounding = 1.0e-9_wp, tiny_load = 1.0e-9_wp      !! share of the value; N, N m

contains

   !> Lists all loads on all bodies at a state, in the order of the bodies.
   subroutine part_loads(suspension, state, kkt, loads)
      type(suspension_t), intent(in) :: suspension        !! on the rig
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt                      !! assembled at this state
      type(part_load_t), allocatable, intent(out) :: loads(:)
      type(member_end_t), allocatable :: ends(:)
      real(wp), allocatable :: values(:, :)
      real(wp) :: inertia(3)
      integer :: b, k

      call member_ends(suspension, .true., ends)
      allocate (values(6, size(ends)), loads(0))
      call end_loads(suspension, state, kkt%gradients, ends, values)
      do b = 1, size(suspension%bodies)
         do k = 1, size(ends)
            if (ends(k)%number == b) call add(ends(k)%member, ends(k)%point, ends(k)%arm, values(1:3, k), values(4:6, k))
         end do
         inertia = 0.0_wp
         do k = 1, size(suspension%loads)
            associate (load => suspension%loads(k))
               if (load%body /= b) cycle
               if (load%is_weight .and. load%is_case) then
                  inertia = inertia + kkt%factor(k)*load%force
                  cycle
               end if
               call add_load(k)
            end associate
         end do
         if (any([(suspension%loads(k)%body == b .and. suspension%loads(k)%is_weight .and. suspension%loads(k)%is_case, &
            k=1, size(suspension%loads))])) call add('inertia of '//suspension%bodies(b)%name, '', suspension%bodies(b)%centre, &
            deck_frame(suspension)*inertia, [0.0_wp, 0.0_wp, 0.0_wp])
      end do

   contains

      !> Adds a load of the deck or of the rig.
      subroutine add_load(k)
         integer, intent(in) :: k
         real(wp) :: force(3), moment(3), arm(3), frame(3)

         frame = deck_frame(suspension)
         associate (load => suspension%loads(k))
            call wrench(load, state%poses(b + 1), force, moment, arm)
            moment = moment - cross(arm, force)
            call add(load%name, '', load%arm, kkt%factor(k)*frame*force, kkt%factor(k)*frame*moment)
         end associate
      end subroutine add_load

      !> Adds a load on body b at a point given in the axes of the body.
      subroutine add(source, point, arm, force, moment)
         character(*), intent(in) :: source, point
         real(wp), intent(in) :: arm(3)              !! from the reference point, body axes [m]
         real(wp), intent(in) :: force(3), moment(3) !! frame of the deck; moment about the point
         type(part_load_t) :: this
         real(wp) :: frame(3), turn(3, 3)
         integer :: p

         frame = deck_frame(suspension)
         associate (pose => state%poses(b + 1), body => suspension%bodies(b))
            this%source = source
            this%point = point
            this%body = b
            this%at = frame*(pose%r + rotated(pose%a, arm))
            this%force = force
            this%moment = moment
            this%drawn_at = frame*(body%origin + arm)
            do p = 1, size(suspension%points)
               if (this%point /= '') exit
               if (norm2(frame*suspension%points(p)%at - this%drawn_at) < 1.0e-9_wp) this%point = suspension%points(p)%name
            end do
            turn = transpose(reshape([(rotated(pose%a, unit(p)), p=1, 3)], [3, 3]))
            this%own_force = frame*matmul(turn, frame*force)
            this%own_moment = frame*matmul(turn, frame*moment)
         end associate
         loads = [loads, this]
      end subroutine add

      !> Unit vector along axis p.
      pure function unit(p)
         integer, intent(in) :: p
         real(wp) :: unit(3)
         unit = 0.0_wp
         unit(p) = 1.0_wp
      end function unit

   end subroutine part_loads

   !> Begins a record without cases.
   subroutine begin_parts(suspension, model, checksum, record)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: model, checksum
      type(part_record_t), intent(out) :: record
      integer :: b

      record%head = '# model '//model//', deck checksum '//checksum//', axes '// &
         trim(merge('iso   ', 'x-rear', suspension%is_iso))//'. Units mm, N, N m'
      allocate (record%texts(size(suspension%bodies)), record%envelopes(0))
      do b = 1, size(suspension%bodies)
         call record%texts(b)%line(record%head)
         call record%texts(b)%line('# Loads on part '//suspension%bodies(b)%name//': x_mm to mz_nm at the state, in the frame '// &
            'of the deck; drawn_x_mm to own_mz_nm at the point as drawn, in axes that move with the part. Moments are about '// &
            'the point. The loads of one state are in equilibrium')
         call record%texts(b)%line('test,state,factor,source,hardpoint,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm,'// &
            'drawn_x_mm,drawn_y_mm,drawn_z_mm,own_fx_n,own_fy_n,own_fz_n,own_mx_nm,own_my_nm,own_mz_nm,name')
      end do
   end subroutine begin_parts

   !> Adds the loads at the converged states of a case whose states have names. A case without names is ignored.
   subroutine add_parts(suspension, case, path, kkt, record)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(part_record_t), intent(inout) :: record
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      type(part_load_t), allocatable :: loads(:)
      character(:), allocatable :: start, name
      integer :: k, j

      if (row_name(case, 1) == '') return
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         call unpack_state(path%packed(:, k), state)
         call inputs_at(schedule, path%value(k), inputs)
         call assemble(suspension, state, inputs, residual_only, kkt)
         call part_loads(suspension, state, kkt, loads)
         name = csv_cell(row_name(case, nint(path%value(k))))
         start = case%name//','//str(k - 1)//','//str(path%value(k)/case%unit, 9)//','
         do j = 1, size(loads)
            call add_line(record%texts(loads(j)%body), start, loads(j), name)
            call extend(record%envelopes, loads(j), name)
         end do
      end do
   end subroutine add_parts

   !> Adds the line of a load to the file of its part.
   subroutine add_line(buffer, start, load, name)
      type(buffer_t), intent(inout) :: buffer
      character(*), intent(in) :: start, name
      type(part_load_t), intent(in) :: load
      real(wp) :: numbers(18)
      integer :: k

      call buffer%add(start//csv_cell(load%source)//','//load%point)
      numbers = [load%at/millimetre, load%force, load%moment, load%drawn_at/millimetre, load%own_force, load%own_moment]
      do k = 1, size(numbers)
         call buffer%add(',')
         call buffer%add(str(numbers(k), 12))
      end do
      call buffer%add(','//name//nl)
   end subroutine add_line

   !> Extends the envelope of a load, or adds a new envelope.
   subroutine extend(envelopes, load, name)
      type(envelope_t), allocatable, intent(inout) :: envelopes(:)
      type(part_load_t), intent(in) :: load
      character(*), intent(in) :: name
      type(envelope_t) :: new
      real(wp) :: values(6), margin
      integer :: k, c

      do k = 1, size(envelopes)
         if (envelopes(k)%body == load%body .and. envelopes(k)%source == load%source .and. envelopes(k)%point == load%point) exit
      end do
      if (k > size(envelopes)) then
         new%source = load%source
         new%point = load%point
         new%body = load%body
         envelopes = [envelopes, new]
      end if
      values = [load%own_force, load%own_moment]
      do c = 1, 6
         associate (this => envelopes(k)%extremes(c))
            margin = abs(values(c))*rounding + tiny_load
            if (.not. allocated(this%low_name) .or. values(c) < this%low - margin) then
               this%low = values(c)
               this%low_name = name
            end if
            if (.not. allocated(this%high_name) .or. values(c) > this%high + margin) then
               this%high = values(c)
               this%high_name = name
            end if
         end associate
      end do
   end subroutine extend

   !> Writes the envelope: a row for each part, load and component, in the axes of the part, with the states of both extremes.
   subroutine envelope_text(suspension, record, buffer)
      type(suspension_t), intent(in) :: suspension
      type(part_record_t), intent(in) :: record
      type(buffer_t), intent(out) :: buffer
      integer :: b, k, c

      call buffer%line(record%head)
      call buffer%line('part,source,hardpoint,component,unit,minimum,minimum_name,maximum,maximum_name')
      do b = 1, size(suspension%bodies)
         do k = 1, size(record%envelopes)
            associate (this => record%envelopes(k))
               if (this%body /= b) cycle
               do c = 1, 6
                  call buffer%line(suspension%bodies(b)%name//','//csv_cell(this%source)//','//this%point//',own_'// &
                     components(c)//','//trim(merge('N  ', 'N m', c <= 3))//','//str(this%extremes(c)%low, 9)//','// &
                     this%extremes(c)%low_name//','//str(this%extremes(c)%high, 9)//','//this%extremes(c)%high_name)
               end do
            end associate
         end do
      end do
   end subroutine envelope_text

end module ek_part_loads
