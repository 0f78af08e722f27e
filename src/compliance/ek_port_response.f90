!> Responses of ports to loads, computed from the compliance matrix: with loads and displacements at the
!> contact points instead of the wheel centres, and with some ports held.
module ek_port_response
   use ek_kinds, only: wp
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: load_at_patch, read_at_patch, hold, lock_t, find_lock, keep_locked

   real(wp), parameter :: rounding = 1.0e-9_wp    !! limit, as a share of a port's own compliance, below which the port is held

   !> Ports that are held, one after the other. The variable is used again from state to state, so that its memory is allocated
   !> once.
   type :: lock_t
      integer :: held = 0                            !! number of ports that had to be held
      integer, allocatable :: port(:)                !! indices of these ports, in the order of holding
      real(wp), allocatable :: column(:, :)          !! (port, k): displacements per displacement of port(k), port(:k − 1) held
      real(wp), allocatable, private :: left(:, :)   !! (port, k): remaining compliance, load at the k-th port to be held
      real(wp), allocatable, private :: own(:)       !! own compliance of each port to be held, before any port is held
      logical, allocatable, private :: is_held(:)
   end type lock_t

contains

   !> The displacements M = C B of the wheel centres under loads at the contact points; B converts these loads to loads at the
   !> wheel centres.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure function load_at_patch(c, arm) result(m)
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(in) :: arm(:, :)      !! contact point less wheel centre, of each wheel in the order of C [m]
      real(wp) :: m(size(c, 1), size(c, 2))
      integer :: w, at

      m = c
      do w = 1, size(arm, 2)
         at = 6*(w - 1)
         m(:, at + 1) = c(:, at + 1) + arm(3, w)*c(:, at + 5) - arm(2, w)*c(:, at + 6)
         m(:, at + 2) = c(:, at + 2) - arm(3, w)*c(:, at + 4) + arm(1, w)*c(:, at + 6)
         m(:, at + 3) = c(:, at + 3) + arm(2, w)*c(:, at + 4) - arm(1, w)*c(:, at + 5)
      end do
   end function load_at_patch

   !> The displacements Bᵀ M of the contact points, from the displacements M of the wheel centres (load_at_patch).
   !> Equation (C.7) of docs/theory/compliance.md.
   pure function read_at_patch(m, arm) result(cp)
      real(wp), intent(in) :: m(:, :)
      real(wp), intent(in) :: arm(:, :)
      real(wp) :: cp(size(m, 1), size(m, 2))
      integer :: w, j, at

      cp = m
      do w = 1, size(arm, 2)
         at = 6*(w - 1)
         do j = 1, size(m, 2)
            cp(at + 1:at + 3, j) = m(at + 1:at + 3, j) + cross(m(at + 4:at + 6, j), arm(:, w))
         end do
      end do
   end function read_at_patch

   !> The displacements M − C(:,z) C_zz⁻¹ M(z,:) with the heights of all wheel centres held; z has one row per wheel.
   !> Equation (C.6) of docs/theory/compliance.md.
   pure function hold(c, m) result(held)
      real(wp), intent(in) :: c(:, :)        !! at the wheel centres
      real(wp), intent(in) :: m(:, :)        !! response at the wheel centres to any loads
      real(wp) :: held(size(m, 1), size(m, 2))
      type(lock_t) :: lock
      integer :: k, j

      call find_lock(c, [(6*k - 3, k=1, size(c, 1)/6)], lock)
      held = m
      do j = 1, size(m, 2)
         call keep_locked(lock, held(:, j))
      end do
   end function hold

   !> Finds the loads at some ports that undo the displacements of these ports.
   !>
   !> The ports are held one after the other, the most compliant remaining port first. Once others are held, a port may have no
   !> compliance left (wheels that can only move together, two springs on one arm). If less than 1e-9 of its own compliance
   !> remains, the port counts as held.
   !> Equation (C.6) of docs/theory/compliance.md.
   !> Equation (S.8) of docs/theory/suspension.md.
   pure subroutine find_lock(c, ports, lock)
      real(wp), intent(in) :: c(:, :)           !! response of all ports to the loads of all ports
      integer, intent(in) :: ports(:)           !! indices of the ports to be held
      type(lock_t), intent(inout) :: lock       !! allocated at the first use
      real(wp) :: compliance, most, factor
      integer :: k, j, i, next, n

      n = size(c, 1)
      if (allocated(lock%left)) then
         if (size(lock%left, 1) /= n .or. size(lock%left, 2) /= size(ports)) &
            deallocate (lock%port, lock%column, lock%left, lock%own, lock%is_held)
      end if
      if (.not. allocated(lock%left)) allocate (lock%port(size(ports)), lock%column(n, size(ports)), lock%left(n, size(ports)), &
         lock%own(size(ports)), lock%is_held(size(ports)))
      lock%held = 0
      do k = 1, size(ports)
         do i = 1, n
            lock%left(i, k) = c(i, ports(k))
         end do
         lock%own(k) = abs(lock%left(ports(k), k))
         lock%is_held(k) = lock%own(k) <= tiny(most)
      end do
      do k = 1, size(ports)
         next = 0
         most = 0.0_wp
         do j = 1, size(ports)
            compliance = abs(lock%left(ports(j), j))
            if (lock%is_held(j) .or. compliance <= rounding*lock%own(j) .or. compliance <= most) cycle
            next = j
            most = compliance
         end do
         if (next == 0) return
         lock%is_held(next) = .true.
         lock%held = k
         lock%port(k) = ports(next)
         do i = 1, n
            lock%column(i, k) = lock%left(i, next)/lock%left(ports(next), next)
         end do
         do j = 1, size(ports)
            if (lock%is_held(j)) cycle
            factor = lock%left(ports(next), j)
            do i = 1, n
               lock%left(i, j) = lock%left(i, j) - lock%column(i, k)*factor
            end do
         end do
      end do
   end subroutine find_lock

   !> Subtracts the displacements caused by the loads that hold the ports from the displacements under a load.
   !> Equation (C.6) of docs/theory/compliance.md.
   pure subroutine keep_locked(lock, moves)
      type(lock_t), intent(in) :: lock                      !! of find_lock
      real(wp), contiguous, intent(inout) :: moves(:)       !! displacements of the first ports, which include all held ports
      real(wp) :: factor
      integer :: k, i

      do k = 1, lock%held
         factor = moves(lock%port(k))
         do i = 1, size(moves)
            moves(i) = moves(i) - lock%column(i, k)*factor
         end do
      end do
   end subroutine keep_locked

end module ek_port_response
