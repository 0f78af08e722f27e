!> The responses of one or two wheels to loads at their centres and at their contact points, with vertical loads or heights held:
!> the data for their characteristics. Only the requested responses are set.
!>
!> No suspension is stiffer than a block of steel (about 1e10 N/m), so a compliance below 1e-12 m/N is rounding.
module ek_loaded_wheels
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_attitude, only: axes_t
   use ek_port_response, only: lock_t, keep_locked
   implicit none(type, external)
   private
   public :: stand_t, loaded_t, load_wheels, phase, quotient

   real(wp), parameter, public :: min_compliance = 1.0e-12_wp   !! m/N; a smaller compliance is rounding

   !> Positions and tyre rates of the wheels at a state, in the order of the compliance matrix C.
   type :: stand_t
      type(axes_t) :: axes(2)
      real(wp) :: centre(3, 2) = 0.0_wp      !! wheel centres [m]
      real(wp) :: arm(3, 2) = 0.0_wp         !! contact point less wheel centre [m]
      real(wp) :: tyre_rate(2) = 0.0_wp      !! N/m; 0: not given
      real(wp) :: track = 0.0_wp             !! distance of the contact points at design [m]
      real(wp) :: roll = 0.0_wp              !! axle roll at the state [rad]
   end type stand_t

   !> Responses of the wheels. Rows and columns as in C: x, y, z and the rotations about x, y, z of the left wheel, then of the
   !> right wheel; a single wheel has the first six.
   type :: loaded_t
      integer :: wheels = 0
      real(wp) :: c(12, 12) = 0.0_wp         !! loads and displacements at the wheel centres
      real(wp) :: m(12, 12) = 0.0_wp         !! forces at the contact points, displacements at the centres; no moments
      real(wp) :: c_held(12, 12) = 0.0_wp    !! c with the heights of the centres held: columns fx and mz only
      real(wp) :: m_held(12, 12) = 0.0_wp    !! m with the heights of the centres held: columns fx and fy only
      ! i, j: 2 lateral, 3 vertical
      real(wp) :: patch(2:3, 2, 2:3, 2) = 0.0_wp   !! (i, w, j, v): displacement i of contact point w per force j at v
   end type loaded_t

contains

   !> The quotient a/b; NaN if |b| is at most `least`.
   pure real(wp) function quotient(a, b, least)
      real(wp), intent(in) :: a, b, least
      if (abs(b) > least) then
         quotient = a/b
      else
         quotient = ieee_value(1.0_wp, ieee_quiet_nan)
      end if
   end function quotient

   !> Computes the requested responses at one state.
   pure subroutine load_wheels(c, arm, has_patch, has_held, lock, loaded)
      real(wp), intent(in) :: c(:, :)             !! six rows and columns per wheel
      real(wp), intent(in) :: arm(:, :)           !! contact point less wheel centre of each wheel [m]
      logical, intent(in) :: has_patch            !! forces at the contact points are requested
      logical, intent(in) :: has_held             !! held heights are requested; requires has_patch
      type(lock_t), intent(in) :: lock            !! holds the heights of the centres; used only if has_held
      type(loaded_t), intent(inout) :: loaded
      integer :: n, w, v, j, at

      n = size(c, 1)
      loaded%wheels = n/6
      loaded%c(:n, :n) = c
      if (.not. has_patch) return
      do v = 1, n/6
         at = 6*(v - 1)
         call load_patch(n, loaded%c(1, at + 1), arm(:, v), loaded%m(1, at + 1))
         do w = 1, n/6
            do j = 2, 3
               call read_patch(loaded%m(6*w - 5, at + j), arm(:, w), loaded%patch(:, w, j, v))
            end do
         end do
         if (.not. has_held) cycle
         do j = 1, 6, 5
            loaded%c_held(:n, at + j) = loaded%c(:n, at + j)
            call keep_locked(lock, loaded%c_held(:n, at + j))
         end do
         do j = 1, 2
            loaded%m_held(:n, at + j) = loaded%m(:n, at + j)
            call keep_locked(lock, loaded%m_held(:n, at + j))
         end do
      end do
   end subroutine load_wheels

   !> Moves the columns of the three forces of a wheel to its contact point: a force F at the contact point equals F and a×F at the
   !> centre.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure subroutine load_patch(n, c, arm, m)
      integer, intent(in) :: n
      real(wp), intent(in) :: c(12, 6)
      real(wp), intent(in) :: arm(3)
      real(wp), intent(inout) :: m(12, 3)
      integer :: i

      do i = 1, n
         m(i, 1) = c(i, 1) + arm(3)*c(i, 5) - arm(2)*c(i, 6)
         m(i, 2) = c(i, 2) - arm(3)*c(i, 4) + arm(1)*c(i, 6)
         m(i, 3) = c(i, 3) + arm(2)*c(i, 4) - arm(1)*c(i, 5)
      end do
   end subroutine load_patch

   !> Computes the lateral and vertical displacement of a contact point: δ + θ×a.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure subroutine read_patch(twist, arm, moves)
      real(wp), intent(in) :: twist(6)
      real(wp), intent(in) :: arm(3)
      real(wp), intent(out) :: moves(2:3)

      moves(2) = twist(2) + (twist(6)*arm(1) - twist(4)*arm(3))
      moves(3) = twist(3) + (twist(4)*arm(2) - twist(5)*arm(1))
   end subroutine read_patch

   !> Response of a wheel if the other wheel carries an equal load (with = 1) or the opposite load (with = −1). A single wheel
   !> responds to its own load only.
   !> Equation (C.8) of docs/theory/compliance.md.
   pure function phase(wheels, c, place, load, with) result(own)
      integer, intent(in) :: wheels
      real(wp), intent(in) :: c(12, 12)
      integer, intent(in) :: place       !! 1 or 2: index of the wheel in C
      integer, intent(in) :: load        !! 1 to 6
      real(wp), intent(in) :: with
      real(wp) :: own(6)
      integer :: at, other, i

      at = 6*(place - 1)
      other = 6 - at
      do i = 1, 6
         own(i) = c(at + i, at + load)
      end do
      if (wheels < 2) return
      do i = 1, 6
         own(i) = own(i) + with*c(at + i, other + load)
      end do
   end function phase

end module ek_loaded_wheels
