!> The start state of the tests: heights and vertical forces of the wheels before a load or a travel is applied.
!>
!> All tests of a report start from one state. If the preload trim (`balance`) or the constant loads of the deck hold the design
!> position, that state is the design position, and nothing is changed. Otherwise the key `start` of &model selects the state:
!>
!> | start      | heights of the wheels                | vertical forces on the wheels                   |
!> |------------|--------------------------------------|-------------------------------------------------|
!> | height     | design height plus `start_height`    | loads of the deck, and the force that is needed |
!> | loads      | static equilibrium under the loads   | loads of the deck                               |
!> | wheel_load | static equilibrium under `start_load`| `start_load` on each wheel                      |
!> | added_mass | static equilibrium under the loads   | loads of the deck, or without loads the force   |
!> |            | and the weight of `added_mass`       | at design height, and the weight                |
!>
!> `find_start` stores the state as numbers of the model. The needed force F is a constant vertical load at the contact point of
!> each wheel, as if the deck contained it. The heights are start_rise of the wheels: the rig holds and moves the wheels from there
!> (ek_rig), and the wheel travel of the results counts from there (ek_attitude). F is found with the heights held: Newton's method
!> on the reactions λ(F) of the rows that hold the wheel centres, until λ = 0. Then the wheels stand at these heights without being
!> held, so that tests with held heights and tests with held forces begin in the same state. A neighbouring design has its own
!> start state, so that derivatives contain the change of F and of the heights.
module ek_start
   use ek_kinds, only: wp, millimetre
   use ek_noise, only: is_noise, noise_of, solved
   use ek_suspension, only: suspension_t
   use ek_adjust, only: is_adjusted
   use ek_state, only: state_t, inputs_t, design_state
   use ek_kkt, only: kkt_t, assemble, factorise, solve, whole_tangent, residual_only
   use ek_newton, only: outcome_t, find_equilibrium
   use ek_reach, only: settle, failure_t
   use ek_wheel_contact, only: contact_arm
   use ek_manoeuvre, only: standing_load, gravity_of
   use ek_case, only: case_t
   use ek_rig, only: mounted_case_t, mount_again
   implicit none(type, external)
   private
   public :: start_space_t, find_start, needed_force, hold

   integer, parameter :: max_iterations = 12
   real(wp), parameter :: free = 1.0e-15_wp      !! largest reaction, as a share of the forces, of a wheel that is not held
   real(wp), parameter :: held = 1.0e-7_wp       !! largest reaction, as a share of the forces, with which the iteration may end

   !> Work space, for one design of a model after the other.
   type :: start_space_t
      type(mounted_case_t) :: mounted
   end type start_space_t

contains

   !> Finds the start state that suspension%start selects, and stores it in the loads and wheels. If the state is the design
   !> position but for rounding noise, the model is unchanged. If there is no such state, the model is unchanged and is_found is
   !> .false.
   subroutine find_start(suspension, tolerance, space, is_found)
      type(suspension_t), intent(inout) :: suspension      !! realised, with trimmed preloads, without a start state; on no rig
      real(wp), intent(in) :: tolerance                    !! m
      type(start_space_t), intent(inout) :: space
      logical, intent(out) :: is_found
      integer :: k

      is_found = .true.
      if (size(suspension%wheels) == 0) return
      select case (suspension%start)
      case ('height')
         suspension%wheels%start_rise(1) = suspension%start_height
         call find_force(suspension, tolerance, space, is_found)
      case ('wheel_load')
         do k = 1, size(suspension%loads)
            associate (load => suspension%loads(k))
               if (load%start_of > 0) load%force(3) = suspension%start_load - standing_load(suspension, load%start_of)
            end associate
         end do
         call find_heights(suspension, tolerance, space, is_found)
      case ('added_mass')
         call add_mass(suspension, tolerance, space, is_found)
      case ('loads')
         call find_heights(suspension, tolerance, space, is_found)
      end select
      if (is_found) return
      do k = 1, size(suspension%wheels)
         suspension%wheels(k)%start_rise = 0.0_wp
      end do
      do k = 1, size(suspension%loads)
         if (suspension%loads(k)%start_of > 0) suspension%loads(k)%force = 0.0_wp
      end do
   end subroutine find_start

   !> Finds the vertical force on each wheel at design height: the loads of the deck, and the force that must be added to them.
   subroutine needed_force(suspension, tolerance, force, is_known)
      type(suspension_t), intent(in) :: suspension         !! on no rig
      real(wp), intent(in) :: tolerance                    !! m
      real(wp), allocatable, intent(out) :: force(:)       !! per wheel, upward [N]
      logical, intent(out) :: is_known
      type(suspension_t) :: trial
      type(start_space_t) :: space
      type(state_t) :: state
      integer :: k

      allocate (force(size(suspension%wheels)), source=0.0_wp)
      trial = suspension
      do k = 1, size(trial%wheels)
         trial%wheels(k)%start_rise = 0.0_wp
      end do
      do k = 1, size(trial%loads)
         if (trial%loads(k)%start_of > 0) trial%loads(k)%force = 0.0_wp
      end do
      call hold(trial, tolerance, space, state, is_known)
      if (.not. is_known) return
      do k = 1, size(force)
         force(k) = standing_load(trial, k) - reaction_on(space%mounted, state, k)
      end do
   end subroutine needed_force

   !> Finds the vertical forces with which the wheel centres stand at start_rise without being held, and stores them in the loads of
   !> the start state.
   subroutine find_force(suspension, tolerance, space, is_found)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance
      type(start_space_t), intent(inout) :: space
      logical, intent(out) :: is_found
      type(state_t) :: state
      type(outcome_t) :: outcome
      real(wp), dimension(size(suspension%wheels)) :: force, change, left
      real(wp) :: before
      integer :: iteration, k
      logical :: is_at_design

      is_at_design = .not. any(abs(suspension%wheels%start_rise(1)) > 0.0_wp)
      if (is_at_design .and. .not. is_adjusted(suspension)) then
         call find_residual(suspension, tolerance, space, is_found)
         if (is_found) return
      end if
      call hold(suspension, tolerance, space, state, is_found)
      if (.not. is_found) return
      force = 0.0_wp
      before = huge(before)
      do iteration = 1, max_iterations
         left = [(reaction_on(space%mounted, state, k), k=1, size(left))]
         if (is_at_design .and. iteration == 1 .and. are_noise(left)) return
         if (maxval(abs(left)) <= free*max(1.0_wp, maxval(abs(force))) .or. .not. maxval(abs(left)) < 0.5_wp*before) exit
         before = maxval(abs(left))
         call find_change(suspension, state, left, space%mounted%kkt, space%mounted%suspension, change, is_found)
         if (.not. is_found) return
         force = force + change
         call put_force(force, suspension)
         call put_force(force, space%mounted%suspension)
         call find_equilibrium(space%mounted%suspension, inputs_t(), tolerance, state, space%mounted%kkt, outcome)
         is_found = outcome%is_converged
         if (.not. is_found) return
      end do
      is_found = maxval(abs(left)) <= held*max(1.0_wp, maxval(abs(force)))
      if (.not. is_found .or. is_at_design) return
      do k = 1, size(suspension%wheels)
         suspension%wheels(k)%start_rise(2) = height_of(suspension, state, k, .false.)
      end do
   end subroutine find_force

   !> Finds whether the design position is in equilibrium under the constant loads, but for rounding noise, if the wheels are held.
   !> This takes one assembly, so that a design of a study without preloads and loads costs almost nothing.
   subroutine find_residual(suspension, tolerance, space, is_noise_alone)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance
      type(start_space_t), intent(inout) :: space
      logical, intent(out) :: is_noise_alone

      call mount_again(suspension, standing('parallel_travel', tolerance), space%mounted)
      associate (on_rig => space%mounted%suspension, kkt => space%mounted%kkt)
         call assemble(on_rig, design_state(on_rig), inputs_t(), residual_only, kkt)
         is_noise_alone = are_noise(kkt%rhs(:kkt%nq))
      end associate
   end subroutine find_residual

   !> Finds static equilibrium with the wheels held at start_rise.
   subroutine hold(suspension, tolerance, space, state, is_found)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: tolerance
      type(start_space_t), intent(inout) :: space
      type(state_t), intent(out) :: state
      logical, intent(out) :: is_found
      type(failure_t) :: failure

      call mount_again(suspension, standing('parallel_travel', tolerance), space%mounted)
      state = design_state(space%mounted%suspension)
      call settle(space%mounted%suspension, tolerance, state, space%mounted%kkt, failure)
      is_found = failure%state == 0 .and. size(space%mounted%suspension%rows) - size(suspension%rows) == size(suspension%wheels)
   end subroutine hold

   !> Adds the weight of the added mass to the loads of the deck, and finds static equilibrium. A deck without loads on its wheels
   !> stands at design height without the mass.
   subroutine add_mass(suspension, tolerance, space, is_found)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance
      type(start_space_t), intent(inout) :: space
      logical, intent(out) :: is_found
      integer :: k

      is_found = .true.
      if (.not. any([(abs(standing_load(suspension, k)) > 0.0_wp, k=1, size(suspension%wheels))])) &
         call find_force(suspension, tolerance, space, is_found)
      if (.not. is_found) return
      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (load%start_of > 0) load%force(3) = load%force(3) + suspension%start_mass*gravity_of(suspension)
         end associate
      end do
      call find_heights(suspension, tolerance, space, is_found)
   end subroutine add_mass

   !> Finds static equilibrium under the constant loads, and stores the heights of the wheels.
   subroutine find_heights(suspension, tolerance, space, is_found)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance
      type(start_space_t), intent(inout) :: space
      logical, intent(out) :: is_found
      type(state_t) :: state
      type(failure_t) :: failure
      integer :: k

      call mount_again(suspension, standing('vertical_force', tolerance), space%mounted)
      state = design_state(space%mounted%suspension)
      call settle(space%mounted%suspension, tolerance, state, space%mounted%kkt, failure)
      is_found = failure%state == 0
      if (.not. is_found) return
      do k = 1, size(suspension%wheels)
         associate (wheel => suspension%wheels(k))
            wheel%start_rise = [height_of(suspension, state, k, .true.), height_of(suspension, state, k, .false.)]
         end associate
      end do
      if (all([(is_noise(suspension%wheels(k)%start_rise(1)/millimetre, 'wheel_travel_mm', 0.0_wp, max(tolerance, solved)), &
         k=1, size(suspension%wheels))])) then
         do k = 1, size(suspension%wheels)
            suspension%wheels(k)%start_rise = 0.0_wp
         end do
      end if
   end subroutine find_heights

   !> A test whose loads and travels are zero.
   pure type(case_t) function standing(test, tolerance) result(case)
      character(*), intent(in) :: test
      real(wp), intent(in) :: tolerance                    !! m

      case%name = test                     ! by this name, mount_again finds whether the model is on this rig
      case%where = ''
      case%test = test
      case%load = ''
      case%drive = ''
      case%vertical = ''
      case%file = ''
      case%target = ''
      case%method = 'equilibrium'
      case%increments = 1
      case%tolerance = tolerance
   end function standing

   !> Finds the changes of the vertical forces at the contact points that reduce the reactions of the rows of the rig to zero, by
   !> the tangent at a state: J change = −left, where J(i, k) is the change of reaction i with the force on wheel k.
   subroutine find_change(suspension, state, left, kkt, on_rig, change, is_found)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: left(:)                      !! reaction on each wheel [N]
      type(kkt_t), intent(inout) :: kkt
      type(suspension_t), intent(in) :: on_rig
      real(wp), intent(out) :: change(:)                   !! per wheel [N]
      logical, intent(out) :: is_found
      real(wp) :: jacobian(size(left), size(left)), determinant, arm(3)
      integer :: k, i, at

      change = 0.0_wp
      call assemble(on_rig, state, inputs_t(), whole_tangent, kkt)
      call factorise(kkt)
      is_found = .not. kkt%is_singular
      if (.not. is_found) return
      do k = 1, size(left)
         associate (wheel => suspension%wheels(k))
            at = 6*(wheel%body - 1)
            kkt%rhs = 0.0_wp
            kkt%rhs(at + 3) = 1.0_wp
            arm = contact_arm(wheel, state%poses(wheel%body + 1)%a)
            kkt%rhs(at + 4:at + 5) = [arm(2), -arm(1)]      ! arm × unit vector upward
         end associate
         call solve(kkt)
         jacobian(:, k) = [(kkt%rhs(kkt%nq + row_of(on_rig, i)), i=1, size(left))]
      end do
      if (size(left) == 1) then
         determinant = jacobian(1, 1)
         if (abs(determinant) > 0.0_wp) change = -left/determinant
      else
         determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
         if (abs(determinant) > 0.0_wp) change = -[jacobian(2, 2)*left(1) - jacobian(1, 2)*left(2), &
            jacobian(1, 1)*left(2) - jacobian(2, 1)*left(1)]/determinant
      end if
      is_found = abs(determinant) > 0.0_wp
   end subroutine find_change

   !> Index of the row of the rig that holds a wheel; 0 if there is none.
   pure integer function row_of(on_rig, wheel) result(row)
      type(suspension_t), intent(in) :: on_rig
      integer, intent(in) :: wheel
      real(wp) :: most, distance
      integer :: k

      row = 0
      most = huge(most)
      do k = on_rig%own_rows() + 1, on_rig%constraints()
         associate (m => on_rig%terms(on_rig%rows(k)%first)%measure)
            if (m%body_j /= on_rig%wheels(wheel)%body) cycle
            distance = norm2(m%arm_j - on_rig%wheels(wheel)%centre)      ! one body may carry both wheels
            if (distance >= most) cycle
            most = distance
            row = k
         end associate
      end do
   end function row_of

   !> The reaction of the row that holds a wheel [N]; positive: the row pulls the wheel down.
   pure real(wp) function reaction_on(mounted, state, wheel) result(force)
      type(mounted_case_t), intent(in) :: mounted
      type(state_t), intent(in) :: state
      integer, intent(in) :: wheel
      force = state%reaction(row_of(mounted%suspension, wheel))
   end function reaction_on

   !> Whether forces are only rounding noise.
   pure logical function are_noise(forces)
      real(wp), intent(in) :: forces(:)                    !! N
      are_noise = all(abs(forces) <= noise_of('vertical_force_n', 0.0_wp, solved))       ! false for a force that is not a number
   end function are_noise

   !> Sets the forces of the loads of the start state.
   pure subroutine put_force(force, suspension)
      real(wp), intent(in) :: force(:)                     !! per wheel, upward [N]
      type(suspension_t), intent(inout) :: suspension
      integer :: k

      do k = 1, size(suspension%loads)
         associate (load => suspension%loads(k))
            if (load%start_of > 0) load%force(3) = force(load%start_of)
         end associate
      end do
   end subroutine put_force

   !> The rise of the centre or of the contact point of a wheel from design [m].
   pure real(wp) function height_of(suspension, state, k, is_at_centre) result(height)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: k                             !! index of the wheel
      logical, intent(in) :: is_at_centre
      real(wp) :: arm(3), now(3)

      associate (wheel => suspension%wheels(k), pose => state%poses(suspension%wheels(k)%body + 1))
         arm = merge(wheel%centre, wheel%contact, is_at_centre)
         height = pose%r(3) - suspension%bodies(wheel%body)%origin(3)
         if (wheel%has_crown .and. .not. is_at_centre) then
            now = contact_arm(wheel, pose%a)
            height = height + now(3) - arm(3)
         else
            height = height + dot_product(pose%a(3, :), arm) - arm(3)
         end if
      end associate
   end function height_of

end module ek_start
