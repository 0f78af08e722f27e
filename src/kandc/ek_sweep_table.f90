!> From the states of a sweep to a table: one row a state, every quantity with its unit in its name.
!>
!> Units leave as mm, N, deg, N m whatever the deck speaks; vectors in the deck's frame.
module ek_sweep_table
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre
   use ek_measure, only: measure_value, axis_axis, rotation
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_joint, only: joint_t
   use ek_law, only: deflection
   use ek_spring, only: spring_tension, stop_spring, torsion_spring
   use ek_elastic, only: bushing_view_t, look_bushing, bushing_load
   use ek_suspension, only: suspension_t, driver_row
   use ek_case, only: case_t
   use ek_state, only: state_t, demand_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, demand_at
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_path, only: path_t
   use ek_wheel_side, only: prefix_of
   use ek_attitude, only: attitude_t, attitude_of
   use ek_vehicle, only: vehicle_of
   use ek_kandc_columns, only: kandc_t, start_kandc, tell_kandc
   use ek_table, only: table_t, new_table, name_length
   implicit none(type, external)
   private
   public :: sweep_table, wheel_attitude, factor_unit, reached_rows

   real(wp), parameter :: open_joints = 1.0e-2_wp   !! |Φ| [m, rad] above which a state of a linear method is none

   !> Column names, gathered one by one.
   type :: names_t
      character(name_length), allocatable :: list(:)
      integer :: used = 0
   end type names_t

contains

   !> The table of a sweep: all states that were reached, and the first that was not on either side,
   !> marked by converged = 0 and values that are not numbers.
   !>
   !> Where the case wants all, the quantities of K&C come before the last three columns, from the compliance matrix
   !> of every state.
   subroutine sweep_table(suspension, case, path, kkt, table)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt          !! work space
      type(table_t), intent(out) :: table
      type(state_t) :: state
      type(schedule_t) :: schedule
      type(demand_t) :: demand
      type(names_t) :: names
      type(kandc_t) :: kandc
      real(wp) :: unit
      integer :: first, last, k, row

      if (case%has_all) call start_kandc(suspension, vehicle_of(suspension), kandc)
      call column_names(suspension, kandc, names)
      call reached_rows(path, first, last)
      table = new_table(names%list(:names%used), last - first + 1)
      state = design_state(suspension)
      schedule = new_schedule(suspension, case)
      unit = factor_unit(suspension, case)
      do k = first, last
         row = k - first + 1
         call demand_at(schedule, path%value(k), demand)
         table%values(1, row) = k - 1
         table%values(2, row) = path%value(k)/unit
         table%values(names%used - 2, row) = merge(1.0_wp, 0.0_wp, path%is_reached(k))
         table%values(names%used - 1, row) = path%iterations(k)
         if (.not. path%is_reached(k)) cycle
         call unpack_state(path%packed(:, k), state)
         call assemble(suspension, state, demand, residual_only, kkt)
         call fill_row(suspension, state, kkt, table%values(3:names%used - 3 - kandc%used, row))
         table%values(names%used, row) = norm2(kkt%values)
         if (norm2(kkt%values) > open_joints) table%values(names%used - 2, row) = 0.0_wp
         if (.not. case%has_all) cycle
         call tell_kandc(suspension, state, demand, kkt, kandc)
         table%values(names%used - 2 - kandc%used:names%used - 3, row) = kandc%values
      end do
   end subroutine sweep_table

   !> The states to be told: those reached, and one beyond on a side that failed.
   pure subroutine reached_rows(path, first, last)
      type(path_t), intent(in) :: path
      integer, intent(out) :: first, last
      integer :: k

      first = path%states + 1
      last = 0
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         first = min(first, k)
         last = max(last, k)
      end do
      if (last == 0) then     ! nothing at all: the design state is the one that failed
         first = max(path%start, 1)
         last = first
         return
      end if
      first = max(first - 1, 1)
      last = min(last + 1, path%states)
   end subroutine reached_rows

   !> Unit of the column `factor` in SI: 1 for a load, mm or deg for a driven measure.
   pure real(wp) function factor_unit(suspension, case) result(unit)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer :: row

      unit = case%unit
      if (allocated(case%courses)) return
      row = driver_row(suspension, case%drive)
      if (row == 0) return
      unit = measure_unit(suspension%terms(suspension%rows(row)%first)%measure%kind)
   end function factor_unit

   !> What a measure's value is divided by to leave in mm or deg.
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

   !> Whether a joint's reaction holds a moment about its own point: only rows between directions make one.
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

   !> All names, in the order in which fill_row gives the values.
   subroutine column_names(suspension, kandc, names)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(in) :: kandc
      type(names_t), intent(inout) :: names
      character(:), allocatable :: prefix
      integer :: k

      allocate (names%list(64))
      call add('state')
      call add('factor')
      do k = 1, size(suspension%wheels)
         prefix = prefix_of(suspension, k)
         call add(prefix//'wheel_travel_mm')
         call add(prefix//'toe_deg')
         call add(prefix//'camber_deg')
         call add(prefix//'track_change_mm')
         call add(prefix//'wheelbase_change_mm')
         call add_three(prefix//'wheel_centre_', 'mm')
         call add_three(prefix//'contact_patch_', 'mm')
         if (.not. suspension%wheels(k)%has_steer_axis) cycle
         call add(prefix//'caster_deg')
         call add(prefix//'kingpin_inclination_deg')
         call add(prefix//'scrub_radius_mm')
         call add(prefix//'caster_trail_mm')
         call add(prefix//'spindle_length_mm')
         call add(prefix//'spindle_offset_mm')
      end do
      do k = 1, size(suspension%springs)
         select case (suspension%springs(k)%kind)
         case (stop_spring)
            call add(suspension%springs(k)%name//'_gap_mm')
            call add(suspension%springs(k)%name//'_force_n')
         case (torsion_spring)
            call add(suspension%springs(k)%name//'_angle_deg')
            call add(suspension%springs(k)%name//'_moment_nm')
         case default
            call add(suspension%springs(k)%name//'_length_mm')
            call add(suspension%springs(k)%name//'_force_n')
         end select
      end do
      do k = 1, size(suspension%readouts)
         select case (suspension%readouts(k)%measure%kind)
         case (rotation)
            call add(suspension%readouts(k)%name//'_deg')
         case (axis_axis)
            call add(suspension%readouts(k)%name//'_cosine')
         case default
            call add(suspension%readouts(k)%name//'_mm')
         end select
      end do
      do k = 1, size(suspension%bushings)
         call add_three(suspension%bushings(k)%name//'_d', 'mm')
         call add_three(suspension%bushings(k)%name//'_r', 'deg')
         call add_three(suspension%bushings(k)%name//'_f', 'n')
         call add_three(suspension%bushings(k)%name//'_m', 'nm')
      end do
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%is_of_measures) then
               call add(joint%name//'_reaction_'//reaction_unit(suspension, joint%first_row))
            else
               call add_three(joint%name//'_f', 'n')
               if (has_moment(suspension, joint)) call add_three(joint%name//'_m', 'nm')
            end if
         end associate
      end do
      do k = 1, kandc%used
         call add(trim(kandc%names(k)))
      end do
      call add('converged')
      call add('iterations')
      call add('constraint_error')

   contains

      subroutine add(name)
         character(*), intent(in) :: name
         character(name_length), allocatable :: more(:)

         if (names%used == size(names%list)) then
            allocate (more(2*names%used))
            more(:names%used) = names%list
            call move_alloc(more, names%list)
         end if
         names%used = names%used + 1
         names%list(names%used) = name
      end subroutine add

      subroutine add_three(stem, unit)
         character(*), intent(in) :: stem, unit
         call add(stem//'x_'//unit)
         call add(stem//'y_'//unit)
         call add(stem//'z_'//unit)
      end subroutine add_three

   end subroutine column_names

   !> Unit of λ of a row: N, or N m where the measure has no length.
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

   !> Values of one state, after `assemble` there.
   pure subroutine fill_row(suspension, state, kkt, row)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(inout) :: row(:)
      type(attitude_t) :: now
      type(bushing_view_t) :: view
      real(wp) :: frame(3), tension, slope, length, force(3), moment(3), arm(3)
      integer :: k, at, r

      frame = 1.0_wp
      if (suspension%is_iso) frame = [-1.0_wp, -1.0_wp, 1.0_wp]
      at = 0
      do k = 1, size(suspension%wheels)
         now = wheel_attitude(suspension, state, k)
         row(at + 1:at + 5) = [now%centre(3)/millimetre, now%toe/degree, now%camber/degree, &
            now%track_change/millimetre, now%wheelbase_change/millimetre]
         row(at + 6:at + 8) = frame*now%centre/millimetre
         row(at + 9:at + 11) = frame*now%contact/millimetre
         at = at + 11
         if (.not. suspension%wheels(k)%has_steer_axis) cycle
         if (now%has_steer_axis) row(at + 1:at + 6) = [now%caster/degree, now%kingpin_inclination/degree, &
            now%scrub_radius/millimetre, now%caster_trail/millimetre, now%spindle_length/millimetre, &
            now%spindle_offset/millimetre]
         at = at + 6
      end do
      do k = 1, size(suspension%springs)
         associate (spring => suspension%springs(k))
            length = measure_value(spring%measure, state%poses(spring%measure%body_i + 1), &
               state%poses(spring%measure%body_j + 1))
            call spring_tension(spring, length, tension, slope)
            select case (spring%kind)
            case (stop_spring)
               row(at + 1) = -deflection(spring%law, length)/millimetre
            case (torsion_spring)
               row(at + 1) = length/degree
            case default
               row(at + 1) = length/millimetre
            end select
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
      do k = 1, size(suspension%bushings)
         associate (bushing => suspension%bushings(k))
            call look_bushing(bushing, state%poses(bushing%body_i + 1), state%poses(bushing%body_j + 1), view)
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
            row(at + 1:at + 3) = frame*(moment - cross(arm, force))
            at = at + 3
         end associate
      end do
   end subroutine fill_row

   !> Adds what a row exerts on its second body: −λ × gradient; moment about the reference point.
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

   !> Attitude of wheel k at a state.
   pure function wheel_attitude(suspension, state, k) result(attitude)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k
      type(attitude_t) :: attitude
      associate (wheel => suspension%wheels(k))
         attitude = attitude_of(wheel, suspension%bodies(wheel%body)%origin, state%poses(wheel%body + 1))
      end associate
   end function wheel_attitude

end module ek_sweep_table
