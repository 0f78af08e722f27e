!> Axles of two wheels with as few parts as a closed form can follow, for the tests of compliance and characteristics.
!>
!> Every model comes completed, wheels named 'left' and 'right', track 1.5 m, radius 0.3 m, centres at x = z = 0
!> unless said otherwise. `sides` picks one or both: [-1], [1] or [-1, 1].
module ek_axle
   use ek_kinds, only: wp
   use ek_example, only: geometry, new_bushing
   use ek_joint, only: joint_geometry_t
   use ek_measure, only: measure_t, rotation
   use ek_rotation, only: identity3
   use ek_suspension, only: suspension_t, wheel_t, readout_t
   use ek_parts, only: add_body, add_joint, add_driver, add_bushing, add_spring, add_wheel, add_readout
   use ek_parts, only: complete
   implicit none(type, external)
   private
   public :: guided_axle, swinging_axle, wishbone_axle, block_axle, steered_axle, side_name, both

   integer, parameter :: both(2) = [-1, 1]
   real(wp), parameter, public :: half_track = 0.75_wp, radius = 0.3_wp    ! m
   real(wp), parameter :: ahead(3) = [1.0_wp, 0.0_wp, 0.0_wp], abeam(3) = [0.0_wp, 1.0_wp, 0.0_wp], &
      up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

contains

   !> 'left' or 'right'
   pure function side_name(side) result(name)
      integer, intent(in) :: side
      character(:), allocatable :: name
      name = 'left'
      if (side > 0) name = 'right'
   end function side_name

   !> The wheel centre of a side at design.
   pure function centre_of(side) result(centre)
      integer, intent(in) :: side
      real(wp) :: centre(3)
      centre = [0.0_wp, side*half_track, 0.0_wp]
   end function centre_of

   subroutine add_plain_wheel(self, side, body)
      type(suspension_t), intent(inout) :: self
      integer, intent(in) :: side, body
      type(wheel_t) :: wheel

      wheel%name = side_name(side)
      wheel%where = ''
      wheel%side = side
      wheel%body = body
      wheel%centre = centre_of(side)
      wheel%contact = centre_of(side) - radius*up
      wheel%spin = [0.0_wp, real(side, wp), 0.0_wp]
      wheel%radius = radius
      call add_wheel(self, wheel)
   end subroutine add_plain_wheel

   !> Wheels that slide up and down, each on a vertical spring `rate`; `bar` joins them: a spring from the left
   !> centre to a point 0.5 m above the right one, of which (0.5/√2.5)² = 0.1 acts on their difference in height.
   subroutine guided_axle(self, sides, rate, bar)
      type(suspension_t), intent(out) :: self
      integer, intent(in) :: sides(:)
      real(wp), intent(in) :: rate            !! N/m
      real(wp), intent(in), optional :: bar   !! N/m
      integer :: k

      self%name = 'guided'
      do k = 1, size(sides)
         call add_body(self, side_name(sides(k))//'_carrier', '', centre_of(sides(k)))
         call add_joint(self, side_name(sides(k))//'_guide', '', 'translational', &
            geometry(0, k, centre_of(sides(k)) - 0.1_wp*abeam*sides(k), up))
         call add_spring(self, side_name(sides(k))//'_coil', '', k, 0, centre_of(sides(k)), centre_of(sides(k)) + 0.4_wp*up, &
            rate)
         call add_plain_wheel(self, sides(k), k)
      end do
      if (present(bar)) call add_spring(self, 'bar', '', 1, 2, centre_of(-1), centre_of(1) + 0.5_wp*up, bar)
      call complete(self)
   end subroutine guided_axle

   !> Wheels on arms that swing about one axis through a point, mirrored for the right side; a vertical spring
   !> stands on the wheel centre.
   subroutine swinging_axle(self, sides, pivot, axis, rate)
      type(suspension_t), intent(out) :: self
      integer, intent(in) :: sides(:)
      real(wp), intent(in) :: pivot(3), axis(3)    !! of the left side [m, -]
      real(wp), intent(in) :: rate                 !! N/m
      real(wp) :: flip(3)
      integer :: k

      self%name = 'swinging'
      do k = 1, size(sides)
         flip = [1.0_wp, -real(sides(k), wp), 1.0_wp]
         call add_body(self, side_name(sides(k))//'_carrier', '', centre_of(sides(k)))
         call add_joint(self, side_name(sides(k))//'_pivot', '', 'revolute', geometry(0, k, flip*pivot, flip*axis))
         call add_spring(self, side_name(sides(k))//'_coil', '', k, 0, centre_of(sides(k)), centre_of(sides(k)) + 0.4_wp*up, &
            rate)
         call add_plain_wheel(self, sides(k), k)
      end do
      call complete(self)
   end subroutine swinging_axle

   !> Two arms that turn about axes along x, ball joints in the plane of the wheel, and a tie rod 0.15 m behind that
   !> copies the lower arm: the carrier moves in the front view alone. Spring from the lower ball joint upright.
   subroutine wishbone_axle(self, sides, lower_in, lower_out, upper_in, upper_out, rate)
      type(suspension_t), intent(out) :: self
      integer, intent(in) :: sides(:)
      real(wp), intent(in) :: lower_in(2), lower_out(2), upper_in(2), upper_out(2)   !! y, z of the left side [m]
      real(wp), intent(in) :: rate            !! N/m
      integer :: k, lower, upper, carrier

      self%name = 'wishbone'
      do k = 1, size(sides)
         lower = 3*k - 2
         upper = 3*k - 1
         carrier = 3*k
         call add_body(self, side_name(sides(k))//'_lower', '')
         call add_body(self, side_name(sides(k))//'_upper', '')
         call add_body(self, side_name(sides(k))//'_carrier', '', centre_of(sides(k)))
         call add_joint(self, side_name(sides(k))//'_lower_axis', '', 'revolute', &
            geometry(0, lower, in_front(lower_in, sides(k), 0.0_wp), ahead))
         call add_joint(self, side_name(sides(k))//'_upper_axis', '', 'revolute', &
            geometry(0, upper, in_front(upper_in, sides(k), 0.0_wp), ahead))
         call add_joint(self, side_name(sides(k))//'_lower_ball', '', 'spherical', &
            geometry(lower, carrier, in_front(lower_out, sides(k), 0.0_wp)))
         call add_joint(self, side_name(sides(k))//'_upper_ball', '', 'spherical', &
            geometry(upper, carrier, in_front(upper_out, sides(k), 0.0_wp)))
         call add_joint(self, side_name(sides(k))//'_tie_rod', '', 'distance', joint_geometry_t(0, carrier, &
            in_front(lower_in, sides(k), 0.15_wp), in_front(lower_out, sides(k), 0.15_wp)))
         call add_spring(self, side_name(sides(k))//'_coil', '', lower, 0, in_front(lower_out, sides(k), 0.0_wp), &
            in_front(lower_out, sides(k), 0.0_wp) + 0.5_wp*up, rate)
         call add_plain_wheel(self, sides(k), carrier)
      end do
      call complete(self)

   contains

      pure function in_front(point, side, x) result(at)
         real(wp), intent(in) :: point(2), x
         integer, intent(in) :: side
         real(wp) :: at(3)
         at = [x, -side*point(1), point(2)]
      end function in_front

   end subroutine wishbone_axle

   !> Each wheel on one bushing at its centre: C is diagonal. `across`: a spring between the wheel centres.
   subroutine block_axle(self, sides, kt, kr, across)
      type(suspension_t), intent(out) :: self
      integer, intent(in) :: sides(:)
      real(wp), intent(in) :: kt(3), kr(3)        !! N/m, N m/rad
      real(wp), intent(in), optional :: across    !! N/m
      integer :: k

      self%name = 'block'
      do k = 1, size(sides)
         call add_body(self, side_name(sides(k))//'_carrier', '', centre_of(sides(k)) + 0.1_wp*ahead)
         call add_bushing(self, new_bushing(side_name(sides(k))//'_block', 0, k, centre_of(sides(k)), identity3, kt, kr))
         call add_plain_wheel(self, sides(k), k)
      end do
      if (present(across)) call add_spring(self, 'across', '', 1, 2, centre_of(-1), centre_of(1), across)
      call complete(self)
   end subroutine block_axle

   !> Wheels that steer about an inclined axis from `low` to `high` on a strut that slides along z on a spring; a
   !> driver turns each about it: drivers 'left_steer', 'right_steer', positive about the upward axis.
   subroutine steered_axle(self, sides, low, high, rate)
      type(suspension_t), intent(out) :: self
      integer, intent(in) :: sides(:)
      real(wp), intent(in) :: low(3), high(3)      !! of the left side [m]
      real(wp), intent(in) :: rate                 !! N/m
      type(readout_t) :: readout
      real(wp) :: flip(3), axis(3)
      integer :: k

      self%name = 'steered'
      do k = 1, size(sides)
         flip = [1.0_wp, -real(sides(k), wp), 1.0_wp]
         axis = flip*(high - low)/norm2(high - low)
         call add_body(self, side_name(sides(k))//'_strut', '', flip*high)
         call add_body(self, side_name(sides(k))//'_carrier', '', centre_of(sides(k)))
         call add_joint(self, side_name(sides(k))//'_guide', '', 'translational', geometry(0, 2*k - 1, flip*high, up))
         call add_joint(self, side_name(sides(k))//'_kingpin', '', 'revolute', geometry(2*k - 1, 2*k, flip*low, axis))
         call add_spring(self, side_name(sides(k))//'_coil', '', 2*k - 1, 0, flip*high, flip*high + 0.4_wp*up, rate)
         readout%name = side_name(sides(k))//'_angle'
         readout%where = ''
         readout%measure = measure_t(kind=rotation, body_i=2*k - 1, body_j=2*k, u=axis, arm_i=flip*low, arm_j=flip*low)
         call add_readout(self, readout)
         call add_driver(self, side_name(sides(k))//'_steer', '', k)
         call add_plain_wheel(self, sides(k), 2*k)
      end do
      call complete(self)
   end subroutine steered_axle

end module ek_axle
