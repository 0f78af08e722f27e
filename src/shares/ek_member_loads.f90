!> Loads of springs, dampers, stops, torsion springs, bushings, joints, drivers and couplers on the bodies that they connect, at the
!> points where they are held: for stress and durability.
!>
!> A load is the force and the moment ON a body, the moment about the design hardpoint as it has moved with this body, in the frame
!> of the deck. Every member has two loads: on its first and on its second body (the chassis included); the two forces are opposite.
!> A member without points (a torsion spring, a `parallel` joint) has moments only, and no hardpoint.
module ek_member_loads
   use ek_kinds, only: wp
   use ek_frame, only: frame_t, new_frame
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_measure, only: measure_t, axis_axis, rotation
   use ek_element, only: bushing_element
   use ek_element_force, only: element_evaluation_t, evaluate_element
   use ek_suspension, only: suspension_t, body_name
   use ek_case, only: case_t, row_name
   use ek_path, only: path_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_wheel_side, only: deck_frame
   implicit none(type, external)
   private
   public :: member_end_t, member_ends, end_loads, load_record_t, begin_loads, add_loads, peak_loads

   real(wp), parameter :: at_point = 1.0e-9_wp      !! m: a member is held at a hardpoint that is nearer than this

   !> One end of a member.
   type :: member_end_t
      character(:), allocatable :: member, point, body     !! names; point: '' if no hardpoint lies there
      integer :: element = 0             !! index of the element; 0: the member is a joint
      integer :: first_term = 0, last_term = 0     !! indices of the first and last term of a joint
      integer :: side = 1                !! 1: first body, 2: second body
      integer :: number = 0              !! index of the body; 0: chassis
      real(wp) :: arm(3) = 0.0_wp        !! end from the reference point of the body, body axes [m]
   end type member_end_t

   !> A string of its own length.
   type :: text_t
      character(:), allocatable :: text
   end type text_t

   !> The loads of several cases: a table with one row per load as a string, and the peaks, each with its state, swept value (column
   !> `factor`) and case.
   type :: load_record_t
      type(member_end_t), allocatable :: ends(:)
      type(frame_t) :: rows                        !! content of loads.csv
      real(wp), allocatable :: peaks(:, :)         !! (component, end): value of largest magnitude [N, N m]; see `components`
      integer, allocatable :: state(:, :)
      real(wp), allocatable :: factor(:, :)
      integer, allocatable :: case(:, :)
      character(64), allocatable :: cases(:)       !! names of the cases
      logical :: has_names = .false.               !! rows have the name of their manoeuvre, or of their row of a load table
      type(text_t), allocatable :: names(:, :)     !! name of the state of each peak
   end type load_record_t

   ! a load that exceeds a peak by less does not replace this peak: the first state stays, on both sides of an axle
   real(wp), parameter :: rounding = 1.0e-9_wp, tiny_load = 1.0e-9_wp      !! tolerances of a peak: share of the value; N, N m

   !> Components of a load. The last three are the force of a bushing in its own axes x, y, z, which move with its first body.
   character(*), parameter :: components(11) = [character(6) :: 'fx', 'fy', 'fz', 'f', 'mx', 'my', 'mz', 'm', 'own_fx', 'own_fy', &
      'own_fz']
   integer, parameter :: of_all = 8           !! number of components that every member has
   integer, parameter :: resultants(2) = [4, 8]

contains

   !> Lists the ends of all members: first the elements, then the joints. The members of the rig are the last.
   subroutine member_ends(suspension, has_rig, ends)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: has_rig                !! .false.: without joints of the rig
      type(member_end_t), allocatable, intent(out) :: ends(:)
      integer :: k, n, t, r, last

      last = size(suspension%rows)
      if (.not. has_rig) last = suspension%own_rows()
      n = 0
      allocate (ends(2*(size(suspension%elements) + size(suspension%terms))))
      do k = 1, size(suspension%elements)
         call add_pair(suspension%elements(k)%name, suspension%elements(k)%measure, .true.)
         ends(n - 1:n)%element = k
      end do
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%first_row + joint%rows - 1 > last) cycle
            associate (first => suspension%rows(joint%first_row), final => suspension%rows(joint%first_row + joint%rows - 1))
               if (joint%is_of_measures) then      ! each of its measures has bodies of its own
                  do t = first%first, first%first + first%terms - 1
                     call add_pair(joint%name, suspension%terms(t)%measure, suspension%terms(t)%measure%kind /= axis_axis)
                     ends(n - 1:n)%first_term = t
                     ends(n - 1:n)%last_term = t
                  end do
               else
                  r = first%first
                  call add_pair(joint%name, suspension%terms(r)%measure, joint%kind /= 'parallel')
                  ends(n - 1:n)%first_term = r
                  ends(n - 1:n)%last_term = final%first + final%terms - 1
               end if
            end associate
         end associate
      end do
      ends = ends(:n)

   contains

      !> Adds both ends of a member to the list.
      subroutine add_pair(name, measure, has_points)
         character(*), intent(in) :: name
         type(measure_t), intent(in) :: measure
         logical, intent(in) :: has_points         !! the member acts at points, unless its measure is a rotation

         call add_end(name, 1, measure%body_i, measure%arm_i, has_points .and. measure%kind /= rotation)
         call add_end(name, 2, measure%body_j, measure%arm_j, has_points .and. measure%kind /= rotation)
      end subroutine add_pair

      !> Adds the end of a member on one body to the list, with the first hardpoint of the deck at its point.
      subroutine add_end(name, side, number, arm, has_point)
         character(*), intent(in) :: name
         integer, intent(in) :: side, number
         real(wp), intent(in) :: arm(3)
         logical, intent(in) :: has_point
         real(wp) :: at(3)
         integer :: p

         n = n + 1
         ends(n)%member = name
         ends(n)%side = side
         ends(n)%number = number
         ends(n)%arm = arm
         ends(n)%body = body_name(suspension, number)
         ends(n)%point = ''
         at = arm
         if (number > 0) at = at + suspension%bodies(number)%origin
         do p = size(suspension%points), 1, -1
            if (norm2(suspension%points(p)%at - at) < at_point .and. has_point) ends(n)%point = suspension%points(p)%name
         end do
      end subroutine add_end

   end subroutine member_ends

   !> Computes force and moment on the body of every end [N, N m], frame of the deck.
   pure subroutine end_loads(suspension, state, gradients, ends, loads)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gradients(:, :)       !! gradients of the terms, assembled at this state
      type(member_end_t), intent(in) :: ends(:)
      real(wp), intent(out) :: loads(:, :)          !! (6, end)
      type(element_evaluation_t) :: evaluation
      real(wp) :: force(3), moment(3), arm(3), frame(3)
      integer :: k, r, t, at

      frame = deck_frame(suspension)
      do k = 1, size(ends)
         at = 6*(ends(k)%side - 1)
         if (ends(k)%element > 0) then
            associate (element => suspension%elements(ends(k)%element))
               call evaluate_element(element, state%poses(element%measure%body_i + 1), state%poses(element%measure%body_j + 1), &
                  evaluation)
               force = -evaluation%generalised_force(at + 1:at + 3)
               moment = -evaluation%generalised_force(at + 4:at + 6)
            end associate
         else
            force = 0.0_wp
            moment = 0.0_wp
            do r = 1, size(suspension%rows)
               do t = suspension%rows(r)%first, suspension%rows(r)%first + suspension%rows(r)%terms - 1
                  if (t < ends(k)%first_term .or. t > ends(k)%last_term) cycle
                  force = force - state%reaction(r)*gradients(at + 1:at + 3, t)
                  moment = moment - state%reaction(r)*gradients(at + 4:at + 6, t)
               end do
            end do
         end if
         arm = rotated(state%poses(ends(k)%number + 1)%a, ends(k)%arm)
         loads(1:3, k) = frame*force
         loads(4:6, k) = frame*(moment - cross(arm, force))
      end do
   end subroutine end_loads

   !> Begins a record without cases. If the states of any case have names, every row has a last column `name`.
   subroutine begin_loads(suspension, model, checksum, record, cases)
      type(suspension_t), intent(in) :: suspension      !! not on the rig
      character(*), intent(in) :: model, checksum
      type(load_record_t), intent(out) :: record
      type(case_t), intent(in), optional :: cases(:)    !! cases that will be added
      integer :: k

      call member_ends(suspension, .false., record%ends)
      allocate (record%peaks(size(components), size(record%ends)), record%factor(size(components), size(record%ends)), &
         source=0.0_wp)
      allocate (record%state(size(components), size(record%ends)), record%case(size(components), size(record%ends)), source=0)
      allocate (record%cases(0), record%names(size(components), size(record%ends)))
      if (present(cases)) record%has_names = any([(row_name(cases(k), 1) /= '', k=1, size(cases))])
      record%rows = new_frame('test,state,factor,element,hardpoint,body,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm'// &
         trim(merge(',name', '     ', record%has_names)))
      call record%rows%header%add('model '//model//', deck checksum '//checksum//', axes '// &
         trim(merge('iso   ', 'x-rear', suspension%is_iso))//'. Force and moment on the body, at the hardpoint')
   end subroutine begin_loads

   !> Adds the loads at the converged states of a case: rows of the table, and peaks.
   subroutine add_loads(suspension, case, path, kkt, record)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(load_record_t), intent(inout) :: record
      character(64), allocatable :: names(:)
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(inputs_t) :: inputs
      real(wp), allocatable :: loads(:, :)
      real(wp) :: own(3)
      character(:), allocatable :: name
      integer :: k, e

      allocate (names(size(record%cases) + 1), loads(6, size(record%ends)))
      names(:size(record%cases)) = record%cases
      names(size(names)) = case%name
      call move_alloc(names, record%cases)
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         call unpack_state(path%packed(:, k), state)
         call inputs_at(schedule, path%value(k), inputs)
         call assemble(suspension, state, inputs, residual_only, kkt)
         call end_loads(suspension, state, kkt%gradients, record%ends, loads)
         name = row_name(case, nint(path%value(k)))
         call record%rows%put(case%name)
         call record%rows%put(k - 1)
         call record%rows%put(path%value(k)/case%unit, 9)
         call record%rows%hold()
         do e = 1, size(record%ends)
            call record%rows%put(record%ends(e)%member)
            call record%rows%put(record%ends(e)%point)
            call record%rows%put(record%ends(e)%body)
            call record%rows%put(loads(:, e), 9)
            if (record%has_names) call record%rows%put(name)
            own = own_force(suspension, state, record%ends(e), loads(1:3, e))
            call keep(e, k - 1, path%value(k)/case%unit, [loads(1:3, e), norm2(loads(1:3, e)), loads(4:6, e), &
               norm2(loads(4:6, e)), own])
         end do
         call record%rows%release()
      end do

   contains

      !> Stores each component of the load at end e whose magnitude exceeds the peak of this component so far.
      subroutine keep(e, number, factor, values)
         integer, intent(in) :: e, number
         real(wp), intent(in) :: factor, values(size(components))
         integer :: i, last

         last = of_all
         if (is_of_bushing(suspension, record%ends(e))) last = size(components)
         do i = 1, last
            if (record%case(i, e) > 0 .and. abs(values(i)) <= abs(record%peaks(i, e))*(1.0_wp + rounding) + tiny_load) cycle
            record%peaks(i, e) = values(i)
            record%state(i, e) = number
            record%factor(i, e) = factor
            record%case(i, e) = size(record%cases)
            if (record%has_names) record%names(i, e)%text = name
         end do
      end subroutine keep

   end subroutine add_loads

   pure logical function is_of_bushing(suspension, end)
      type(suspension_t), intent(in) :: suspension
      type(member_end_t), intent(in) :: end

      is_of_bushing = end%element > 0
      if (is_of_bushing) is_of_bushing = suspension%elements(end%element)%kind == bushing_element
   end function is_of_bushing

   !> The force on an end of a bushing along the axes of the bushing at this state [N]; 0 for other members.
   pure function own_force(suspension, state, end, force) result(own)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(member_end_t), intent(in) :: end
      real(wp), intent(in) :: force(3)              !! frame of the deck
      real(wp) :: own(3), global(3), axis(3)
      integer :: k

      own = 0.0_wp
      if (.not. is_of_bushing(suspension, end)) return
      global = deck_frame(suspension)*force
      associate (element => suspension%elements(end%element))
         do k = 1, 3
            axis = element%bushing%axes(:, k)
            axis = rotated(state%poses(element%measure%body_i + 1)%a, axis)
            own(k) = dot_product(axis, global)
         end do
      end associate
   end function own_force

   !> The peak of every component at every end, with its test and state, as comma-separated values.
   function peak_loads(record) result(text)
      type(load_record_t), intent(in) :: record
      character(:), allocatable :: text
      type(frame_t) :: frame
      integer :: e, i

      frame = new_frame('element,hardpoint,body,component,value,unit,test,state,factor'// &
         trim(merge(',name', '     ', record%has_names)))
      do e = 1, size(record%ends)
         do i = 1, size(components)
            if (record%case(i, e) == 0) cycle
            call frame%put(record%ends(e)%member)
            call frame%put(record%ends(e)%point)
            call frame%put(record%ends(e)%body)
            call frame%put(trim(components(i)))
            call frame%put(record%peaks(i, e), 9)
            call frame%put(trim(merge('N  ', 'N m', i <= resultants(1) .or. i > of_all)))
            call frame%put(trim(record%cases(record%case(i, e))))
            call frame%put(record%state(i, e))
            call frame%put(record%factor(i, e), 9)
            if (record%has_names) call frame%put(record%names(i, e)%text)
         end do
      end do
      text = frame%csv()
   end function peak_loads

end module ek_member_loads
