!> The loads on all parts in the manoeuvres and in the named rows of load tables: a file for each part, the envelope, the largest
!> tension and compression of each rod, and all loads as JSON.
module ek_part_record
   use ek_kinds, only: wp, millimetre
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, row_name
   use ek_path, only: path_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_block, only: rotated
   use ek_member_loads, only: member_end_t, member_ends, end_loads
   use ek_part_loads, only: part_load_t, part_loads
   use ek_wheel_side, only: deck_frame
   use ek_table, only: csv_cell
   implicit none(type, external)
   private
   public :: part_record_t, rod_t, has_names, begin_parts, add_parts, envelope_text, parts_json

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

   !> Largest tension and largest compression of a rod (a `distance` joint) over all states, with the names of these states.
   type :: rod_t
      character(:), allocatable :: name
      real(wp) :: tension = 0.0_wp, compression = 0.0_wp          !! N, 0 or more
      character(:), allocatable :: tension_name, compression_name
   end type rod_t

   !> The loads on all parts in the named states of several cases.
   type :: part_record_t
      type(message_list_t) :: names                 !! names of the bodies
      type(buffer_t), allocatable :: texts(:)       !! content of parts/<part>.csv, for each body
      type(envelope_t), allocatable :: envelopes(:)
      type(rod_t), allocatable :: rods(:)
      character(:), allocatable :: head             !! first line of every file
      type(json_t) :: json                          !! content of loads.json, without its end
   end type part_record_t

   character(*), parameter :: nl = new_line('a')
   character(*), parameter :: components(6) = [character(2) :: 'fx', 'fy', 'fz', 'mx', 'my', 'mz']
   ! a value that exceeds an extreme by less does not replace it
   real(wp), parameter :: rounding = 1.0e-9_wp, tiny_load = 1.0e-9_wp      !! share of the value; N, N m

contains

   !> Whether the states of any case have names.
   pure logical function has_names(cases)
      type(case_t), intent(in) :: cases(:)
      integer :: k
      has_names = any([(row_name(cases(k), 1) /= '', k=1, size(cases))])
   end function has_names

   !> Begins a record without cases.
   subroutine begin_parts(suspension, model, program, checksum, record)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: model, program, checksum        !! program: its name and version
      type(part_record_t), intent(out) :: record
      integer :: b

      record%head = '# model '//model//', deck checksum '//checksum//', axes '// &
         trim(merge('iso   ', 'x-rear', suspension%is_iso))//'. Units mm, N, N m'
      allocate (record%texts(size(suspension%bodies)), record%envelopes(0), record%rods(0))
      call record%json%open('{')
      call record%json%item('program', json_string(program))
      call record%json%item('model', json_string(model))
      call record%json%item('checksum', json_string(checksum))
      call record%json%item('axes', json_string(trim(merge('iso   ', 'x-rear', suspension%is_iso))))
      call record%json%open('[', 'states')
      do b = 1, size(suspension%bodies)
         call record%names%add(suspension%bodies(b)%name)
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
         call add_rods(suspension, state, kkt, name, record%rods)
         call add_state(suspension, case, k - 1, row_name(case, nint(path%value(k))), loads, record%json)
      end do
   end subroutine add_parts

   !> Adds the loads of a state to the JSON object, part by part.
   subroutine add_state(suspension, case, number, name, loads, json)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: number                !! index of the state, from 0
      character(*), intent(in) :: name
      type(part_load_t), intent(in) :: loads(:)
      type(json_t), intent(inout) :: json
      integer :: b, j

      call json%open('{')
      call json%item('test', json_string(case%name))
      call json%item('state', str(number))
      call json%item('name', json_string(name))
      call json%open('[', 'parts')
      do b = 1, size(suspension%bodies)
         call json%open('{')
         call json%item('part', json_string(suspension%bodies(b)%name))
         call json%open('[', 'loads')
         do j = 1, size(loads)
            if (loads(j)%body /= b) cycle
            call json%open('{')
            call json%item('source', json_string(loads(j)%source))
            call json%item('hardpoint', json_string(loads(j)%point))
            call json%item('at_mm', json_numbers(loads(j)%at/millimetre))
            call json%item('force_n', json_numbers(loads(j)%force))
            call json%item('moment_nm', json_numbers(loads(j)%moment))
            call json%item('drawn_at_mm', json_numbers(loads(j)%drawn_at/millimetre))
            call json%item('own_force_n', json_numbers(loads(j)%own_force))
            call json%item('own_moment_nm', json_numbers(loads(j)%own_moment))
            call json%close('}')
         end do
         call json%close(']')
         call json%close('}')
      end do
      call json%close(']')
      call json%close('}')
   end subroutine add_state

   !> Ends the JSON object with the rods, and returns its text.
   subroutine parts_json(record, text)
      type(part_record_t), intent(in) :: record
      character(:), allocatable, intent(out) :: text
      type(json_t) :: json
      integer :: k

      json = record%json
      call json%close(']')
      call json%open('[', 'rods')
      do k = 1, size(record%rods)
         associate (rod => record%rods(k))
            call json%open('{')
            call json%item('rod', json_string(rod%name))
            call json%item('tension_n', json_number(rod%tension))
            call json%item('tension_in', json_string(rod%tension_name))
            call json%item('compression_n', json_number(rod%compression))
            call json%item('compression_in', json_string(rod%compression_name))
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end subroutine parts_json

   !> Updates the largest tension and compression of the rods with a state.
   subroutine add_rods(suspension, state, kkt, name, rods)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt               !! assembled at this state
      character(*), intent(in) :: name             !! name of the state
      type(rod_t), allocatable, intent(inout) :: rods(:)
      type(member_end_t), allocatable :: ends(:)
      real(wp), allocatable :: values(:, :)
      real(wp) :: along(3), force
      type(rod_t) :: new
      integer :: e, j, k

      call member_ends(suspension, .false., ends)
      allocate (values(6, size(ends)))
      call end_loads(suspension, state, kkt%gradients, ends, values)
      do e = 2, size(ends), 2
         if (ends(e)%element > 0) cycle
         do j = 1, size(suspension%joints)
            if (suspension%joints(j)%name == ends(e)%member) exit
         end do
         if (suspension%joints(j)%kind /= 'distance') cycle
         along = place(ends(e)) - place(ends(e - 1))
         force = -dot_product(values(1:3, e), deck_frame(suspension)*along)/norm2(along)      ! positive: tension
         do k = 1, size(rods)
            if (rods(k)%name == ends(e)%member) exit
         end do
         if (k > size(rods)) then
            new%name = ends(e)%member
            new%tension_name = ''
            new%compression_name = ''
            rods = [rods, new]
         end if
         if (force > rods(k)%tension*(1.0_wp + rounding) + tiny_load) then
            rods(k)%tension = force
            rods(k)%tension_name = name
         else if (-force > rods(k)%compression*(1.0_wp + rounding) + tiny_load) then
            rods(k)%compression = -force
            rods(k)%compression_name = name
         end if
      end do

   contains

      !> Position of an end at the state [m].
      pure function place(end)
         type(member_end_t), intent(in) :: end
         real(wp) :: place(3)
         place = state%poses(end%number + 1)%r + rotated(state%poses(end%number + 1)%a, end%arm)
      end function place

   end subroutine add_rods

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

   !> Updates the envelope of a load, or adds a new envelope.
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

end module ek_part_record
