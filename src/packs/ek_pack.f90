!> Four designs of one deck as one model. The numbers of each design are in one lane; common data are stored once.
!>
!> All designs have the connections, the plan of elimination and the scale of the deck's own design. The result of a design
!> therefore does not depend on the other lanes.
module ek_pack
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, lanes
   use ek_lane_copy, only: set_lane
   use ek_suspension, only: suspension_t
   use ek_kkt, only: kkt_t
   use ek_path_states, only: path_t
   use ek_pattern, only: pattern_t
   use ek_plan, only: plan_t
   use ek_predictor, only: depth
   use ek_relative_rotation_lanes, only: pose_t
   use ek_element_lanes, only: element_t
   use ek_row_lanes, only: row_t, term_t
   use ek_load_lanes, only: load_t
   implicit none(type, external)
   private
   public :: pack_t, new_pack, set_design

   !> Four designs, the present state of their solution, and work space.
   type :: pack_t
      integer :: bodies = 0, rows = 0, n = 0
      type(pattern_t) :: pattern
      type(plan_t) :: plan
      real(wp), allocatable :: places(:)                 !! swept values of the states
      real(wp), allocatable :: scale(:), scaling(:)      !! scale factors D of the unknowns, and factor of each entry of the matrix
      real(wp) :: length = 1.0_wp                        !! characteristic length [m]
      type(load_t), allocatable :: loads(:)
      type(element_t), allocatable :: elements(:)
      type(row_t), allocatable :: equations(:)
      type(term_t), allocatable :: terms(:)
      type(lanes_t), allocatable :: origin(:, :)         !! (3, body): reference points at design [m]
      ! the state
      type(pose_t), allocatable :: poses(:)              !! poses of the chassis and of the bodies
      type(lanes_t), allocatable :: reaction(:)
      type(lanes_t), allocatable :: factor(:), change(:) !! inputs of each load and row
      type(lanes_t), allocatable :: rate_factor(:), rate_change(:)   !! derivatives of the inputs by the path coordinate
      ! the system
      type(lanes_t), allocatable :: gradients(:, :), values(:), store(:), factors(:), rhs(:)
      type(lanes_t), allocatable :: spare(:)             !! factors that are saved while other designs are factorised again
      type(lanes_t), allocatable :: tangent_a(:), tangent_b(:), motion(:), motion_before(:) !! tangents at both ends of a step,
                                                                                            !! motions of the bodies in this step
                                                                                            !! and in the step before
      ! earlier states, newest first in `slot`
      type(lanes_t), allocatable :: packed(:, :), guess(:)
      ! the newest of them: poses, reactions, factors
      type(pose_t), allocatable :: poses_before(:)
      type(lanes_t), allocatable :: reaction_before(:), factors_before(:)
      integer :: slot(depth) = 0
   end type pack_t

contains

   !> Creates the work space for designs with the connections of this suspension.
   subroutine new_pack(suspension, kkt, path, pack)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt                     !! KKT system with a plan
      type(path_t), intent(in) :: path                   !! path created by new_path
      type(pack_t), intent(out) :: pack
      type(lanes_t) :: zero
      integer :: k

      zero%v = 0.0_wp
      pack%bodies = size(suspension%bodies)
      pack%rows = kkt%nc
      pack%n = kkt%n
      pack%pattern = kkt%pattern
      pack%plan = kkt%plan(1)
      pack%scale = kkt%scale
      pack%scaling = kkt%scaling
      pack%length = kkt%length
      pack%places = path%value
      allocate (pack%loads(size(suspension%loads)), pack%elements(size(suspension%elements)), &
         pack%equations(size(suspension%rows)), pack%terms(size(suspension%terms)), pack%poses(pack%bodies + 1), &
         pack%poses_before(pack%bodies + 1))
      allocate (pack%origin(3, pack%bodies), source=zero)
      allocate (pack%reaction(pack%rows), pack%change(pack%rows), pack%rate_change(pack%rows), pack%values(pack%rows), source=zero)
      allocate (pack%factor(size(suspension%loads)), pack%rate_factor(size(suspension%loads)), source=zero)
      allocate (pack%gradients(12, size(suspension%terms)), pack%store(kkt%pattern%stored), pack%factors(pack%plan%length), &
         pack%spare(pack%plan%length), pack%factors_before(pack%plan%length), pack%rhs(pack%n), &
         pack%reaction_before(pack%rows), source=zero)
      allocate (pack%tangent_a(pack%n), pack%tangent_b(pack%n), pack%motion(6*pack%bodies), &
         pack%motion_before(6*pack%bodies), source=zero)
      allocate (pack%packed(7*pack%bodies + pack%rows, depth), pack%guess(7*pack%bodies + pack%rows), source=zero)
      pack%slot = [(k, k=1, depth)]
   end subroutine new_pack

   !> Stores the numbers of a design in a lane. The design must have the connections of the pack.
   subroutine set_design(suspension, lane, pack)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: lane
      type(pack_t), intent(inout) :: pack
      integer :: k

      do k = 1, pack%bodies
         call set_lane(pack%origin(:, k), lane, suspension%bodies(k)%origin)
      end do
      do k = 1, size(pack%loads)
         call set_lane(pack%loads(k), lane, suspension%loads(k))
      end do
      do k = 1, size(pack%elements)
         call set_lane(pack%elements(k), lane, suspension%elements(k))
      end do
      do k = 1, size(pack%equations)
         call set_lane(pack%equations(k), lane, suspension%rows(k))
      end do
      do k = 1, size(pack%terms)
         call set_lane(pack%terms(k), lane, suspension%terms(k))
      end do
   end subroutine set_design

end module ek_pack
