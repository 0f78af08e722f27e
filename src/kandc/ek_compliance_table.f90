!> The compliance matrix at every state of a sweep as a table: one row per state, one column per entry.
!>
!> A column is called <place>_<displacement>_by_<load>_<unit>: displacement and load begin with the wheel (`left_`, `right_`),
!> then x, y, z (displacements), rx, ry, rz (rotations), fx, fy, fz (forces), mx, my, mz (moments), in the frame of the deck.
!> `centre`: loads and displacements at the wheel centres; `patch`: loads and displacements at the contact points of the
!> deck. Loads keep their direction; the vertical force on all wheels is held, heights held by the rig are released
!> (ek_compliance).
module ek_compliance_table
   use ek_kinds, only: wp
   use ek_units, only: degree
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, demand_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, new_schedule, demand_at
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_block, only: rotated
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_compliance, only: compliance_t, new_compliance, wheel_compliance, load_at_patch, read_at_patch
   use ek_table, only: table_t, new_table, name_length
   implicit none(type, external)
   private
   public :: compliance_table

   character(*), parameter :: places(2) = [character(7) :: 'centre_', 'patch_']
   character(*), parameter :: moves(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz'], &
      loads(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']

contains

   !> The table of a sweep: the converged states. Without a wheel there is no column of the matrix.
   subroutine compliance_table(suspension, case, path, kkt, table)
      type(suspension_t), intent(in) :: suspension      !! on the rig
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(kkt_t), intent(inout) :: kkt                 !! work space
      type(table_t), intent(out) :: table
      type(compliance_t) :: compliance
      type(state_t) :: state
      type(demand_t) :: demand
      type(schedule_t) :: schedule
      real(wp), allocatable :: c(:, :), scale(:), arm(:, :)
      real(wp) :: unit
      integer :: n, k, w, row

      compliance = new_compliance(suspension, .false.)
      n = 6*compliance%wheels
      allocate (c(n, n), scale(n), arm(3, compliance%wheels))
      scale = [(deck_frame(suspension), k=1, n/3)]
      table = new_table(columns_of(suspension, compliance), count(path%is_reached))
      unit = case%unit
      schedule = new_schedule(suspension, case)
      state = design_state(suspension)
      row = 0
      do k = 1, path%states
         if (.not. path%is_reached(k)) cycle
         row = row + 1
         table%values(1, row) = k - 1
         table%values(2, row) = path%value(k)/unit
         call unpack_state(path%packed(:, k), state)
         call demand_at(schedule, path%value(k), demand)
         call wheel_compliance(suspension, state, demand, 0, kkt, compliance)
         do w = 1, compliance%wheels
            associate (wheel => suspension%wheels(compliance%order(w)))
               arm(:, w) = rotated(state%poses(wheel%body + 1)%a, wheel%contact - wheel%centre)
            end associate
         end do
         c = compliance%response(:n, :n)
         call put(c, scale, table%values(3:2 + n*n, row))
         call put(read_at_patch(load_at_patch(c, arm), arm), scale, table%values(3 + n*n:2 + 2*n*n, row))
      end do
   end subroutine compliance_table

   !> The entries of a matrix, row by row, in the units of the columns and the frame of the deck.
   pure subroutine put(c, frame, values)
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
   end subroutine put

   !> 'state', 'factor', then every entry of both matrices, row by row.
   function columns_of(suspension, compliance) result(names)
      type(suspension_t), intent(in) :: suspension
      type(compliance_t), intent(in) :: compliance
      character(name_length), allocatable :: names(:)
      character(:), allocatable :: unit
      integer :: n, p, i, j, at

      n = 6*compliance%wheels
      allocate (names(2 + 2*n*n))
      names(1) = 'state'
      names(2) = 'factor'
      at = 2
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
   end function columns_of

end module ek_compliance_table
