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
   public :: load_at_patch, read_at_patch, hold

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
   !>
   !> The heights are held one after the other, the more compliant first; a height without compliance once the other is held
   !> (wheels that can only move together; below 1e-9 of its own compliance is rounding) is held already.
   !> Equation (C.6) of docs/theory/compliance.md.
   pure function hold(c, m) result(held)
      real(wp), intent(in) :: c(:, :)        !! at the wheel centres
      real(wp), intent(in) :: m(:, :)        !! response at the wheel centres to any loads
      real(wp) :: held(size(m, 1), size(m, 2))
      real(wp) :: left(size(c, 1), size(c, 2)), row(size(c, 2)), column(size(c, 1))
      integer :: order(size(c, 1)/6), k, j, z

      left = c
      held = m
      order = [(6*k - 3, k=1, size(order))]
      if (size(order) == 2) then
         if (abs(c(9, 9)) > abs(c(3, 3))) order = [9, 3]
      end if
      do k = 1, size(order)
         z = order(k)
         if (abs(left(z, z)) <= 1.0e-9_wp*abs(c(z, z)) .or. abs(c(z, z)) <= tiny(1.0_wp)) cycle
         column = left(:, z)/left(z, z)
         row = held(z, :)
         do j = 1, size(m, 2)
            held(:, j) = held(:, j) - column*row(j)
         end do
         row = left(z, :)
         do j = 1, size(c, 2)
            left(:, j) = left(:, j) - column*row(j)
         end do
      end do
   end function hold

end module ek_compliance_port
