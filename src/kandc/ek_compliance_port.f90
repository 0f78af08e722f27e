!> The compliance matrix transformed to other points, and with heights held.
!>
!> C has six rows and columns per wheel, loads and displacements at the wheel centre. The contact point given by the deck is
!> fixed to the carrier at the arm a from the centre: a force F there equals the same force at the centre with the moment a×F,
!> and the point moves by δ + θ×a. Moments and rotations of the carrier do not depend on the point.
module ek_compliance_port
   use ek_kinds, only: wp
   use ek_rotation, only: cross, identity3
   implicit none(type, external)
   private
   public :: load_at_patch, read_at_patch, hold, lock

contains

   !> M = C B: loads at the contact points, displacements at the wheel centres.
   !> Equation (C.7) of docs/theory/compliance.md.
   pure function load_at_patch(c, arm) result(m)
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(in) :: arm(:, :)      !! contact point less wheel centre, of each wheel in the order of C [m]
      real(wp) :: m(size(c, 1), size(c, 2))
      real(wp) :: moment(3)
      integer :: w, k, at

      m = c
      do w = 1, size(arm, 2)
         at = 6*(w - 1)
         do k = 1, 3
            moment = cross(arm(:, w), identity3(:, k))
            m(:, at + k) = c(:, at + k) + moment(1)*c(:, at + 4) + moment(2)*c(:, at + 5) + moment(3)*c(:, at + 6)
         end do
      end do
   end function load_at_patch

   !> Bᵀ M: displacements of the contact points.
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

   !> The displacements M while the heights of all wheel centres are held: M − C(:,z) C_zz⁻¹ M(z,:), z one row per wheel.
   !> Equation (C.6) of docs/theory/compliance.md.
   pure function hold(c, m) result(held)
      real(wp), intent(in) :: c(:, :)        !! at the wheel centres
      real(wp), intent(in) :: m(:, :)        !! response at the wheel centres to any loads
      real(wp) :: held(size(m, 1), size(m, 2))
      integer :: k

      held = m
      call lock(c, [(6*k - 3, k=1, size(c, 1)/6)], held)
   end function hold

   !> Takes from displacements M those of the loads at some ports that undo the displacements of these ports.
   !>
   !> The ports are held one after the other, the one that is most compliant then first; a port without compliance once others are
   !> held (wheels that can only move together, two springs on one arm; below 1e-9 of its own compliance is rounding) is held
   !> already.
   !> Equations (C.6) of docs/theory/compliance.md and (S.8) of docs/theory/suspension.md.
   pure subroutine lock(c, ports, m)
      real(wp), intent(in) :: c(:, :)           !! response to the loads of all ports
      integer, intent(in) :: ports(:)
      real(wp), intent(inout) :: m(:, :)        !! response to any loads
      real(wp) :: left(size(c, 1), size(ports)), own(size(ports)), column(size(c, 1)), compliance, most
      logical :: is_held(size(ports))
      integer :: k, j, next

      left = c(:, ports)
      own = [(abs(left(ports(k), k)), k=1, size(ports))]
      is_held = own <= tiny(own)
      do k = 1, size(ports)
         next = 0
         most = 0.0_wp
         do j = 1, size(ports)
            compliance = abs(left(ports(j), j))
            if (is_held(j) .or. compliance <= 1.0e-9_wp*own(j) .or. compliance <= most) cycle
            next = j
            most = compliance
         end do
         if (next == 0) return
         is_held(next) = .true.
         column = left(:, next)/left(ports(next), next)
         do j = 1, size(m, 2)
            m(:, j) = m(:, j) - column*m(ports(next), j)
         end do
         do j = 1, size(ports)
            if (.not. is_held(j)) left(:, j) = left(:, j) - column*left(ports(next), j)
         end do
      end do
   end subroutine lock

end module ek_compliance_port
