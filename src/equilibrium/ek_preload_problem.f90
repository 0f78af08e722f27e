!> The linear problem of `balance = 'all'`: forces in bushings (x), springs and joints (y) that hold the loads at design.
!>
!>     min ½ |x|²   subject to   W x + F y = b
!>
!> The columns of W are the forces of the components of bushings on the bodies, times the square root of the rate of the component:
!> ½ |x|² is the complementary energy Σ f²/2k of the bushings. The columns of F are the forces of springs and joints on the bodies;
!> y is not part of the minimised energy. All rows are scaled by D
!> (ek_scale). With multipliers v, displacements of the bodies, x = Wᵀ v:
!>
!>     [ W Wᵀ  F ] [v]   [b]
!>     [ Fᵀ    0 ] [y] = [0]
!>
!> W Wᵀ is the stiffness of the bushings at design. ek_preload_solution solves the system.
module ek_preload_problem
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, evaluation_t, evaluate
   use ek_element, only: element_kinds, element_t
   use ek_elastic, only: bushing_t, set_bushing_axes, design_rates
   use ek_rotation, only: cross
   use ek_state, only: state_t, inputs_t, design_state
   use ek_suspension, only: suspension_t
   use ek_kkt, only: kkt_t, renew_kkt, assemble, residual_only
   implicit none(type, external)
   private
   public :: preload_problem_t, set_problem, clear_preloads, is_free, takes_part

   !> The problem: the columns of W and F as gradients at two bodies, and b.
   type :: preload_problem_t
      integer :: nq = 0                          !! number of rows: unknowns of the bodies
      integer :: nx = 0                          !! number of columns of W: six per bushing
      integer :: ny = 0                          !! number of columns of F: elements of one measure, then rows of Φ
      real(wp), allocatable :: load(:)           !! b, scaled
      real(wp), allocatable :: root(:)           !! square root of each rate: preload = root × x
      real(wp), allocatable :: weighted(:, :)    !! (12, nx) W, scaled
      integer, allocatable :: at(:, :)           !! (2, bushing) unknowns before each of the two bodies; negative: the chassis
      real(wp), allocatable :: piece(:, :)       !! (12, piece) parts of the columns of F, scaled
      integer, allocatable :: piece_at(:, :)     !! (2, piece) unknowns before each of the two bodies
      integer, allocatable :: piece_of(:)        !! the position in `used` of the column to which a piece belongs
      integer :: pieces = 0
      integer, allocatable :: used(:)            !! the columns of F that may carry a force
      type(kkt_t), private :: kkt                !! work space, also for the next design of the model
   end type preload_problem_t

contains

   !> Whether the preload trim (`balance`) may change the preload of a spring; .false. for other elements.
   elemental logical function is_free(element)
      type(element_t), intent(in) :: element
      is_free = element_kinds(element%kind)%is_axial_spring .and. element%is_balanced
   end function is_free

   !> Whether a row may carry a force at design. A driver with a stiffness may not if its joint sets `balance = .false.`, or if it
   !> acts on the body of a wheel and its joint does not give `balance`.
   pure logical function takes_part(suspension, row)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: row
      integer :: t

      takes_part = .true.
      if (.not. suspension%rows(row)%compliance > 0.0_wp) return
      associate (joint => suspension%joints(suspension%rows(row)%joint))
         takes_part = joint%is_balanced
         if (joint%says_balance) return
      end associate
      do t = suspension%rows(row)%first, suspension%rows(row)%first + suspension%rows(row)%terms - 1
         associate (m => suspension%terms(t)%measure)
            if (any(suspension%wheels%body == m%body_i) .or. any(suspension%wheels%body == m%body_j)) takes_part = .false.
         end associate
      end do
   end function takes_part

   !> Sets all preloads that `balance = 'all'` may change to zero.
   pure subroutine clear_preloads(suspension)
      type(suspension_t), intent(inout) :: suspension
      integer :: k

      do k = 1, suspension%scalars
         if (is_free(suspension%elements(k))) suspension%elements(k)%preload = 0.0_wp
      end do
      do k = suspension%scalars + 1, size(suspension%elements)
         suspension%elements(k)%bushing%preload_force = 0.0_wp
         suspension%elements(k)%bushing%preload_moment = 0.0_wp
         call set_bushing_axes(suspension%elements(k)%bushing)
      end do
   end subroutine clear_preloads

   !> Creates the problem of a suspension at design. The memory of the previous design is used again.
   !> Equation (K.21) of docs/theory/kkt.md.
   subroutine set_problem(suspension, problem)
      type(suspension_t), intent(in) :: suspension    !! after `clear_preloads`: the preloads that are sought are zero
      type(preload_problem_t), intent(inout) :: problem
      type(state_t) :: state
      type(evaluation_t) :: evaluation
      real(wp) :: rates(6)
      logical :: has_force(suspension%constraints())
      integer :: b, k, s, t, at, columns

      call renew_kkt(suspension, .false., problem%kkt)
      state = design_state(suspension)
      do k = 1, suspension%constraints()
         has_force(k) = takes_part(suspension, k)
      end do
      call allocate_problem(suspension, count(is_free(suspension%elements(:suspension%scalars))) + count(has_force), problem)
      associate (kkt => problem%kkt)
         call assemble(suspension, state, inputs_t(), residual_only, kkt)
         problem%load(:) = -kkt%rhs(:kkt%nq)*kkt%scale(:kkt%nq)
         do b = 1, problem%nx/6
            associate (element => suspension%elements(suspension%scalars + b))
               rates = design_rates(element%bushing)
               problem%at(:, b) = [6*(element%measure%body_i - 1), 6*(element%measure%body_j - 1)]
               do k = 1, 6
                  at = 6*(b - 1) + k
                  problem%root(at) = sqrt(max(rates(k), 0.0_wp))
                  call bushing_column(element%bushing, element%measure, k, problem%weighted(:, at))
                  call scale_gradient(problem%root(at), kkt%scale, problem%at(:, b), problem%weighted(:, at))
               end do
            end associate
         end do
         columns = 0
         do s = 1, suspension%scalars
            if (.not. is_free(suspension%elements(s))) cycle
            columns = columns + 1
            problem%used(columns) = s
            associate (m => suspension%elements(s)%measure)
               call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
               call add_piece(1.0_wp, evaluation%gradient, m, columns, kkt%scale, problem)
            end associate
         end do
         do k = 1, kkt%nc
            if (.not. has_force(k)) cycle
            columns = columns + 1
            problem%used(columns) = suspension%scalars + k
            do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
               call add_piece(-1.0_wp, kkt%gradients(:, t), suspension%terms(t)%measure, columns, kkt%scale, problem)
            end do
         end do
      end associate
   end subroutine set_problem

   !> Allocates the lists of a problem with the sizes that the suspension requires.
   pure subroutine allocate_problem(suspension, used, problem)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: used                     !! columns of F that may carry a force
      type(preload_problem_t), intent(inout) :: problem
      integer :: most
      problem%nq = suspension%unknowns()
      problem%nx = 6*(size(suspension%elements) - suspension%scalars)
      problem%ny = suspension%scalars + suspension%constraints()
      problem%pieces = 0
      most = suspension%scalars + size(suspension%terms)
      if (allocated(problem%load)) then
         if (size(problem%load) == problem%nq .and. size(problem%root) == problem%nx .and. size(problem%piece_of) == most &
            .and. size(problem%used) == used) return
         deallocate (problem%load, problem%root, problem%weighted, problem%piece, problem%at, problem%piece_at)
         deallocate (problem%piece_of, problem%used)
      end if
      allocate (problem%load(problem%nq), problem%root(problem%nx), problem%weighted(12, problem%nx), problem%piece(12, most), &
         problem%at(2, problem%nx/6), problem%piece_at(2, most), problem%piece_of(most), problem%used(used))
   end subroutine allocate_problem

   !> Adds a part of a column of F.
   pure subroutine add_piece(factor, gradient, measure, column, scale, problem)
      real(wp), intent(in) :: factor, gradient(12), scale(:)
      type(measure_t), intent(in) :: measure
      integer, intent(in) :: column
      type(preload_problem_t), intent(inout) :: problem

      problem%pieces = problem%pieces + 1
      associate (p => problem%pieces)
         problem%piece_of(p) = column
         problem%piece_at(:, p) = [6*(measure%body_i - 1), 6*(measure%body_j - 1)]
         problem%piece(:, p) = gradient
         call scale_gradient(factor, scale, problem%piece_at(:, p), problem%piece(:, p))
      end associate
   end subroutine add_piece

   !> Computes the generalised force of a unit preload component k of a bushing on its bodies at design.
   pure subroutine bushing_column(bushing, measure, k, gradient)
      type(bushing_t), intent(in) :: bushing
      type(measure_t), intent(in) :: measure
      integer, intent(in) :: k
      real(wp), intent(out) :: gradient(12)
      real(wp) :: axis(3)

      axis = bushing%axes(:, merge(k, k - 3, k <= 3))
      gradient = 0.0_wp
      if (k <= 3) then
         gradient(1:3) = -axis
         gradient(4:6) = -cross(measure%arm_i + bushing%gap0, axis)
         gradient(7:9) = axis
         gradient(10:12) = cross(measure%arm_j, axis)
      else
         gradient(4:6) = -axis
         gradient(10:12) = axis
      end if
   end subroutine bushing_column

   !> Multiplies a gradient by a factor and the scales of its two bodies; zero for the chassis.
   pure subroutine scale_gradient(factor, scale, at, gradient)
      real(wp), intent(in) :: factor, scale(:)
      integer, intent(in) :: at(2)
      real(wp), intent(inout) :: gradient(12)

      if (at(1) >= 0) then
         gradient(1:6) = factor*gradient(1:6)*scale(at(1) + 1:at(1) + 6)
      else
         gradient(1:6) = 0.0_wp
      end if
      if (at(2) >= 0) then
         gradient(7:12) = factor*gradient(7:12)*scale(at(2) + 1:at(2) + 6)
      else
         gradient(7:12) = 0.0_wp
      end if
   end subroutine scale_gradient

end module ek_preload_problem
