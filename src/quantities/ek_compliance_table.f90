!> The compliance matrix as a table over the states of a sweep, and at a single state.
module ek_compliance_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, degree
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_table, only: table_t, new_table, name_length
   use ek_wheel_contact, only: contact_lever
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance, wheel_compliance_nearby
   use ek_port_response, only: load_at_patch, read_at_patch
   implicit none(type, external)
   private
   public :: compliance_table, compliance_columns, state_compliance, observe_compliance, put_compliance

   character(*), parameter :: places(2) = [character(7) :: 'centre_', 'patch_']
   character(*), parameter :: moves(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz'], &
      loads(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']

contains

   !> Builds a table of the compliance matrix at every converged state of a sweep: one row per state, one column per entry.
   !>
   !> A column is called <point>_<displacement>_by_<load>_<unit>. With two wheels, displacement and load begin with the wheel
   !> (`left_`, `right_`). Then follow x, y, z (displacements), rx, ry, rz (rotations), fx, fy, fz (forces), mx, my, mz (moments),
   !> in the frame of the deck. `centre`: loads and displacements at the wheel centres; `patch`: at the contact points of the deck.
   !> The direction of the loads does not change. The vertical force on all wheels is held; heights held by the rig are released
   !> (ek_compliance). Without a wheel, the table has the columns state and factor only.
   subroutine compliance_table(suspension, case, path, kkt, table)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(table_t), intent(out) :: table
      type(compliance_t) :: compliance
      type(schedule_t) :: schedule
      type(state_t) :: state
      type(inputs_t) :: inputs
      character(name_length), allocatable :: names(:)
      integer :: k, row

      compliance = new_compliance(suspension, .false.)
      call compliance_columns(suspension, names)
      table = new_table([character(name_length) :: 'state', 'factor', names], count(path%is_reached))
      schedule = new_schedule(suspension, case)
      state = design_state(suspension)
      row = 0
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         row = row + 1
         table%values(1, row) = k - 1
         table%values(2, row) = path%value(k)/case%unit
         call unpack_state(path%packed(:, k), state)
         call inputs_at(schedule, path%value(k), inputs)
         call observe_compliance(suspension, state, inputs, kkt, compliance, table%values(3:, row))
      end do
   end subroutine compliance_table

   !> Computes the compliance matrix at one converged state of a sweep, at the wheel centres: x rearward, y right, z up [m/N, rad/N,
   !> m/(N m), rad/(N m)]. All entries are NaN if the matrix is singular.
   subroutine state_compliance(suspension, schedule, path, k, kkt, compliance, c, arm)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(schedule_t), intent(in) :: schedule          !! of the case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k                          !! index of the state
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(compliance_t), intent(inout) :: compliance   !! work space, of new_compliance
      real(wp), intent(out) :: c(:, :)                  !! 6 rows and columns per wheel, left before right
      real(wp), intent(out) :: arm(:, :)                !! from each centre to the contact point [m], global axes
      type(state_t) :: state
      type(inputs_t) :: inputs

      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
      call inputs_at(schedule, path%value(k), inputs)
      call wheel_compliance(suspension, state, inputs, 0, kkt, compliance)
      call read_compliance(suspension, state, compliance, c, arm)
   end subroutine state_compliance

   !> Computes the values of compliance_columns at an equilibrium. With responses stored at an equilibrium, computes the values at a
   !> state near this equilibrium.
   subroutine observe_compliance(suspension, state, inputs, kkt, compliance, values, kept)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(compliance_t), intent(inout) :: compliance   !! work space, of new_compliance
      real(wp), intent(inout) :: values(:)
      real(wp), intent(in), optional :: kept(:, :)      !! of keep_responses
      real(wp) :: c(6*compliance%wheels, 6*compliance%wheels), scale(6*compliance%wheels), arm(3, compliance%wheels)
      integer :: n, k

      n = size(scale)
      scale = [(deck_frame(suspension), k=1, n/3)]
      if (present(kept)) then
         call wheel_compliance_nearby(suspension, state, inputs, kept, kkt, compliance)
      else
         call wheel_compliance(suspension, state, inputs, 0, kkt, compliance)
      end if
      call read_compliance(suspension, state, compliance, c, arm)
      call put_compliance(c, scale, values(:n*n))
      call put_compliance(read_at_patch(load_at_patch(c, arm), arm), scale, values(n*n + 1:2*n*n))
   end subroutine observe_compliance

   !> Reads the compliance matrix at the wheel centres, and the arms from the wheel centres to the contact points.
   pure subroutine read_compliance(suspension, state, compliance, c, arm)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(compliance_t), intent(in) :: compliance      !! of this state
      real(wp), intent(out) :: c(:, :), arm(:, :)
      integer :: w

      do w = 1, compliance%wheels
         associate (wheel => suspension%wheels(compliance%order(w)))
            arm(:, w) = contact_lever(wheel, state%poses(wheel%body + 1)%a)
         end associate
      end do
      c = compliance%response(:size(c, 1), :size(c, 2))
      if (.not. has_rates(suspension)) c = ieee_value(1.0_wp, ieee_quiet_nan)      ! without limit, or that of the bushings alone
   end subroutine read_compliance

   !> Writes the entries of a matrix, row by row, in the units of the columns and the frame of the deck.
   pure subroutine put_compliance(c, frame, values)
      real(wp), intent(in) :: c(:, :)            !! SI
      real(wp), intent(in) :: frame(:)           !! sign of every direction
      real(wp), intent(inout) :: values(:)
      integer :: i, j, at

      at = 0
      do i = 1, size(c, 1)
         do j = 1, size(c, 2)
            at = at + 1
            values(at) = frame(i)*frame(j)*c(i, j)/(merge(1.0e-3_wp, degree, mod(i - 1, 6) < 3)/ &      ! mm or deg
               merge(1.0e3_wp, 1.0e2_wp, mod(j - 1, 6) < 3))                                             ! per kN or 100 N m
         end do
      end do
   end subroutine put_compliance

   !> Lists the column names of all entries of the matrix at the wheel centres, then at the contact points, row by row.
   subroutine compliance_columns(suspension, names)
      type(suspension_t), intent(in) :: suspension
      character(name_length), allocatable, intent(out) :: names(:)
      type(compliance_t) :: compliance
      character(:), allocatable :: unit
      integer :: n, p, i, j, at

      compliance = new_compliance(suspension, .false.)
      n = 6*compliance%wheels
      allocate (names(2*n*n))
      at = 0
      do p = 1, 2
         do i = 1, n
            do j = 1, n
               unit = trim(merge('mm ', 'deg', mod(i - 1, 6) < 3))//'_per_'//trim(merge('kn   ', '100nm', mod(j - 1, 6) < 3))
               at = at + 1
               names(at) = trim(places(p))//prefix_of(suspension, compliance%order((i + 5)/6))//trim(moves(mod(i - 1, 6) + 1))// &
                  '_by_'//prefix_of(suspension, compliance%order((j + 5)/6))//loads(mod(j - 1, 6) + 1)//'_'//unit
            end do
         end do
      end do
   end subroutine compliance_columns

end module ek_compliance_table
