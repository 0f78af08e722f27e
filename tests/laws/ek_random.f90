!> Random directions, poses and measures for the tests, the same ones in every run.
module ek_random
   use ek_kinds, only: wp, i8
   use ek_measure, only: measure_t
   use ek_relative_rotation, only: pose_t
   use ek_rotation, only: unit_vector, quaternion_of_vector, rotation_matrix, quaternion_product
   implicit none(type, external)
   private
   public :: random_t

   integer(i8), parameter :: modulus = 2147483647_i8   ! Park and Miller 1988, "minimal standard", with
   integer(i8), parameter :: factor = 48271_i8         ! the multiplier they recommended in 1993

   !> A generator; give each test its own seed.
   type :: random_t
      integer(i8) :: seed = 1_i8     !! 1 … modulus − 1
   contains
      procedure :: number            !! uniform in [low, high]
      procedure :: vector            !! each component uniform in [−size, size]
      procedure :: direction         !! unit vector
      procedure :: pose              !! place and attitude
      procedure :: turned            !! a pose turned by a given angle from another
      procedure :: measure           !! a measure of a kind, between bodies 1 and 2
   end type random_t

contains

   real(wp) function number(self, low, high)
      class(random_t), intent(inout) :: self
      real(wp), intent(in) :: low, high
      self%seed = mod(self%seed*factor, modulus)
      number = low + (high - low)*real(self%seed, wp)/real(modulus, wp)
   end function number

   function vector(self, size) result(v)
      class(random_t), intent(inout) :: self
      real(wp), intent(in) :: size
      real(wp) :: v(3)
      integer :: k
      do k = 1, 3
         v(k) = self%number(-size, size)
      end do
   end function vector

   function direction(self) result(u)
      class(random_t), intent(inout) :: self
      real(wp) :: u(3)
      do
         u = self%vector(1.0_wp)
         if (norm2(u) < 1.0_wp .and. norm2(u) > 0.1_wp) exit   ! no preferred direction, no 0/0
      end do
      u = unit_vector(u)
   end function direction

   !> Anywhere within a metre, turned by any angle.
   function pose(self)
      class(random_t), intent(inout) :: self
      type(pose_t) :: pose
      pose = self%turned(pose_t(), self%number(0.0_wp, 3.0_wp))
   end function pose

   !> Anywhere within a metre, turned against `from` by `angle` [rad] about any axis.
   function turned(self, from, angle) result(pose)
      class(random_t), intent(inout) :: self
      type(pose_t), intent(in) :: from
      real(wp), intent(in) :: angle
      type(pose_t) :: pose
      pose%r = self%vector(1.0_wp)
      pose%q = quaternion_product(quaternion_of_vector(angle*self%direction()), from%q)
      pose%q = pose%q/norm2(pose%q)
      pose%a = rotation_matrix(pose%q)
   end function turned

   function measure(self, kind)
      class(random_t), intent(inout) :: self
      integer, intent(in) :: kind
      type(measure_t) :: measure
      measure%kind = kind
      measure%body_i = 1
      measure%body_j = 2
      measure%u = self%direction()
      measure%v = self%direction()
      measure%arm_i = self%vector(0.5_wp)
      measure%arm_j = self%vector(0.5_wp)
   end function measure

end module ek_random
