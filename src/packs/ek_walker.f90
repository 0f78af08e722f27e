!> Data of packs of designs on their paths: the designs, the position and state of each design, inputs, earlier states, work space.
module ek_walker
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, lanes
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_kkt, only: kkt_t
   use ek_state, only: state_t, inputs_t
   use ek_schedule, only: schedule_t, inputs_at
   use ek_path_states, only: path_t
   use ek_branch, only: branch_t
   use ek_predictor, only: predictor_t, usable, find_weights, depth
   use ek_pack, only: pack_t
   implicit none(type, external)
   private
   public :: member_t, place_t, walker_t, set_inputs, find_lane_weights, remember_place, put_lane, get_lane

   !> A design of a pack, on the rig of its case.
   type :: member_t
      type(suspension_t), pointer :: suspension => null()
      type(case_t), pointer :: case => null()
      type(kkt_t), pointer :: kkt => null()
      type(path_t), pointer :: path => null()
      logical :: is_wanted = .true.              !! .false.: the lane only contains data of another design
      logical :: is_walked = .false. !! the path is complete; .false.: the design is left to the sweep of a single design
   end type member_t

   !> Position of a design on its path.
   type :: place_t
      type(schedule_t) :: schedule
      integer :: trusted = depth                 !! number of states used for the prediction
      integer :: settled = -1                    !! number of negative eigenvalues at design
      real(wp) :: beginning = huge(1.0_wp)       !! ln |det N| at design
      integer :: negative = -1                   !! number of negative eigenvalues at the newest state
      real(wp) :: log_determinant = huge(1.0_wp)
      logical :: was_uneven = .true.
      logical :: knows_factors = .false.         !! the previous factors in the pack belong to the newest state
      logical :: is_symmetric = .true.           !! the tangent is symmetric under all loads
   end type place_t

   !> Work space of one thread to walk packs.
   type :: walker_t
      type(pack_t) :: pack
      type(predictor_t) :: history               !! swept values of the stored states; the states are in the pack
      type(branch_t), allocatable :: branch(:)   !! branch of each design, for steps of this design alone
      logical :: is_fresh(lanes) = .false.       !! the branch belongs to the present design
      type(state_t) :: state
      type(place_t), allocatable :: places(:)    !! position of each design; reused as work space
      real(wp) :: tolerance = 0.0_wp             !! tolerance of the present designs [m]
      integer :: steps_alone = 0, steps = 0      !! numbers of steps of all designs so far: alone, and in total
      integer :: tangents_again = 0              !! number of steps that needed the tangents at both ends
   end type walker_t

contains

   !> Sets the inputs of all designs at a swept value.
   subroutine set_inputs(members, places, is_common, value, pack)
      type(member_t), intent(in) :: members(lanes)
      type(place_t), intent(in) :: places(lanes)
      logical, intent(in) :: is_common
      real(wp), intent(in) :: value
      type(pack_t), intent(inout) :: pack
      type(inputs_t) :: inputs
      integer :: l, k, j, last

      last = merge(1, lanes, is_common)
      do l = 1, last
         if (.not. members(l)%is_walked) cycle
         call inputs_at(places(l)%schedule, value, inputs)
         do k = 1, size(pack%loads)
            pack%factor(k)%v(l) = merge(0.0_wp, 1.0_wp, pack%loads(k)%is_case)
         end do
         do k = 1, inputs%loads
            do j = inputs%load(k), inputs%load(k) + inputs%further(k)
               if (pack%loads(j)%is_case) pack%factor(j)%v(l) = pack%factor(j)%v(l) + inputs%factor(k)
            end do
         end do
         pack%change%v(l) = 0.0_wp
         do k = 1, inputs%rows
            pack%change(inputs%row(k))%v(l) = pack%change(inputs%row(k))%v(l) + inputs%change(k)
         end do
      end do
      if (.not. is_common) return
      do l = 2, lanes
         pack%factor%v(l) = pack%factor%v(1)
         pack%change%v(l) = pack%change%v(1)
      end do
   end subroutine set_inputs

   !> Finds the weights of the stored states for each design, for the number of states that the design trusts, and the slots of the
   !> stored states.
   subroutine find_lane_weights(history, value, trusted, weight, slot, states)
      type(predictor_t), intent(in) :: history
      real(wp), intent(in) :: value
      integer, intent(in) :: trusted(lanes)
      type(lanes_t), intent(out) :: weight(depth)
      integer, intent(out) :: slot(depth), states !! slots of the stored states; states: largest number of states that a design uses
      real(wp) :: own(depth)
      integer :: l, j, n, most, last

      most = usable(history, value)
      states = min(most, maxval(trusted))
      last = 0
      own = 0.0_wp
      do l = 1, lanes
         n = min(most, trusted(l))
         if (n /= last) then
            own = 0.0_wp
            call find_weights(history, value, n, slot, own)
            last = n
         end if
         do j = 1, depth
            weight(j)%v(l) = own(j)
         end do
      end do
      do j = 1, states
         slot(j) = modulo(history%newest - j, depth) + 1
      end do
   end subroutine find_lane_weights

   !> Stores a swept value in the history. The states at this value belong in the slot history%newest of the pack.
   pure subroutine remember_place(history, value)
      type(predictor_t), intent(inout) :: history
      real(wp), intent(in) :: value

      history%newest = mod(history%newest, depth) + 1
      history%count = min(history%count + 1, depth)
      history%abscissa(history%newest) = value
   end subroutine remember_place

   !> Copies the numbers of one design to its lane.
   pure subroutine put_lane(lane, numbers, x)
      integer, intent(in) :: lane
      real(wp), intent(in) :: numbers(:)
      type(lanes_t), intent(inout) :: x(:)
      integer :: k

      do k = 1, size(numbers)
         x(k)%v(lane) = numbers(k)
      end do
   end subroutine put_lane

   !> Copies the numbers of one design from its lane.
   pure subroutine get_lane(lane, x, numbers)
      integer, intent(in) :: lane
      type(lanes_t), intent(in) :: x(:)
      real(wp), intent(out) :: numbers(:)
      integer :: k

      do k = 1, size(numbers)
         numbers(k) = x(k)%v(lane)
      end do
   end subroutine get_lane

end module ek_walker
