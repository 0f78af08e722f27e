!> Determines preloads for which the design position is in equilibrium under the constant loads.
!>
!> `spring`: the spring preloads with which the wheels settle at their design height.
!> `all`: spring and bushing preloads with which every body stays exactly at design; if there are several solutions,
!> the one with the smallest complementary energy Σ f²/2k of the bushing preloads (k of a curve: its slope at design).
!> Dampers, stops, torsion springs and springs with `balance = .false.` keep their preloads.
!>
!> A driver with a stiffness that acts on the body of a wheel (a tyre modelled as a spring under the patch) would carry the
!> wheel instead of the spring: it is excluded from `all` unless its joint sets `balance = .true.`. Others (a rack, a steering
!> column) take part.
module ek_balance
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model, exit_convergence
   use ek_text, only: str, quoted, plural
   use ek_measure, only: evaluation_t, evaluate
   use ek_block, only: rotated, add_gradient
   use ek_element, only: element_kinds, element_t
   use ek_elastic, only: set_bushing_axes, design_rates
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, design_state
   use ek_kkt, only: kkt_t, new_kkt, assemble, factorise, solve, residual_only, whole_tangent
   use ek_reach, only: settle, failure_t
   use ek_singular_values, only: singular_values_t, decompose, min_norm
   implicit none(type, external)
   private
   public :: balance, balance_remarks, takes_part

   real(wp), parameter :: rank_share = 1.0e-11_wp       !! of the largest singular value: smaller ones are rounding
   character(*), parameter :: not_finite = 'the forces or stiffnesses at design are too large to calculate with'

contains

   !> Sets the preloads according to suspension%balance ('none': no change).
   subroutine balance(suspension, tolerance, error, is_terse)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance                    !! m
      type(error_t), allocatable, intent(out) :: error     !! exit_model: no solution
      logical, intent(in), optional :: is_terse            !! .true.: a message without numbers and names, safe in a thread
      logical :: has_details

      has_details = .true.
      if (present(is_terse)) has_details = .not. is_terse
      select case (suspension%balance)
      case ('spring')
         call balance_springs(suspension, tolerance, has_details, error)
      case ('all')
         call balance_all(suspension, has_details, error)
      end select
   end subroutine balance

   !> Whether balance may change the preload of an element.
   elemental logical function is_free(element)
      type(element_t), intent(in) :: element
      is_free = element_kinds(element%kind)%is_axial_spring .and. element%is_balanced
   end function is_free

   !> Whether a row may carry a force at design: yes, except for drivers with a stiffness that act on the body of a wheel
   !> (`balance` of their joint overrides this).
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

   !> Remarks about a balance: excluded drivers, preloads that are not unique.
   subroutine balance_remarks(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      integer :: k, springs

      select case (suspension%balance)
      case ('all')
         do k = 1, size(suspension%rows)
            if (takes_part(suspension, k)) cycle
            associate (joint => suspension%joints(suspension%rows(k)%joint))
               call words%add('balance: driver '//quoted(joint%name)//' is excluded and carries no force at design'// &
                  trim(merge('                                                                             ', &
                  ' (it acts on the body of a wheel; balance = .true. in its &joint includes it)', joint%says_balance)))
            end associate
         end do
      case ('spring')
         springs = count(is_free(suspension%elements))
         if (springs > size(suspension%wheels)) call words%add('balance: '//str(springs)//' springs are balanced for '// &
            plural(size(suspension%wheels), 'wheel', 'wheels')//', so their preloads are not unique; the smallest change of '// &
            'them is used. Springs in series carry one force: set balance = .false. in the &spring that is to keep its preload')
      end select
   end subroutine balance_remarks

   !> '; driver … is excluded', for an error message.
   function kept_out(suspension) result(text)
      type(suspension_t), intent(in) :: suspension
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, size(suspension%rows)
         if (takes_part(suspension, k)) cycle
         text = text//'; driver '//quoted(suspension%joints(suspension%rows(k)%joint)%name)// &
            ' is excluded unless its &joint sets balance = .true.'
      end do
   end function kept_out

   !> Newton's method on the wheel heights in equilibrium; with more springs than wheels, the change of minimum norm.
   !>
   !> The first change is the solution of the linear problem at design, close to the final one. A wheel with too little preload
   !> would settle on its stop, where the slope would give a change many times too large.
   subroutine balance_springs(suspension, tolerance, has_details, error)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance
      logical, intent(in) :: has_details
      type(error_t), allocatable, intent(out) :: error
      type(kkt_t) :: kkt
      type(state_t) :: state
      type(failure_t) :: failure
      real(wp) :: height(size(suspension%wheels))
      integer :: w, iteration

      if (.not. any(is_free(suspension%elements)) .or. size(suspension%wheels) == 0) then
         call fail(error, exit_model, "balance = 'spring' needs a spring and a wheel")
         return
      end if
      kkt = new_kkt(suspension)
      state = design_state(suspension)
      call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
      call factorise(kkt)
      if (.not. kkt%is_singular) then
         call solve(kkt)
         height = [(rise(suspension, state, w, kkt%rhs), w=1, size(height))]
         call lower_by(height, suspension, state, kkt, error)
         if (allocated(error)) return
      end if
      do iteration = 1, 30
         state = design_state(suspension)
         failure = failure_t()
         call settle(suspension, tolerance, state, kkt, failure)
         if (failure%state > 0) then
            call fail(error, exit_convergence, "balance = 'spring': the suspension does not settle")
            return
         end if
         do w = 1, size(height)
            associate (wheel => suspension%wheels(w), pose => state%poses(suspension%wheels(w)%body + 1))
               height(w) = pose%r(3) + dot_product(pose%a(3, :), wheel%centre) &
                  - suspension%bodies(wheel%body)%origin(3) - wheel%centre(3)
            end associate
         end do
         if (maxval(abs(height)) <= 10.0_wp*tolerance) return
         call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
         call factorise(kkt)
         call lower_by(height, suspension, state, kkt, error)
         if (allocated(error)) return
      end do
      call fail(error, exit_convergence, "balance = 'spring': no preload brings the wheels to design height")
      if (has_details) error%message = error%message//'; the remaining error is '//str(maxval(abs(height))*1000.0_wp, 4)//' mm'
   end subroutine balance_springs

   !> Changes the spring preloads so that, according to the tangent at a state, the wheels move down by `height`.
   subroutine lower_by(height, suspension, state, kkt, error)
      real(wp), intent(in) :: height(:)                    !! per wheel [m]
      type(suspension_t), intent(inout) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt                    !! with the factors at this state
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: the tangent is singular
      type(singular_values_t) :: parts
      type(evaluation_t) :: evaluation
      real(wp) :: slope(size(suspension%wheels), suspension%scalars)
      real(wp) :: change(suspension%scalars)         ! per spring; 0 for other elements
      integer :: s, w

      if (kkt%is_singular) then
         call fail(error, exit_convergence, "balance = 'spring': the matrix is singular where the suspension settles")
         return
      end if
      slope = 0.0_wp
      do s = 1, size(change)
         if (.not. is_free(suspension%elements(s))) cycle
         associate (m => suspension%elements(s)%measure)
            call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            kkt%rhs = 0.0_wp     ! a unit preload pushes the ends apart
            call add_gradient(1.0_wp, evaluation%gradient, 6*(m%body_i - 1), 6*(m%body_j - 1), kkt%rhs)
         end associate
         call solve(kkt)
         slope(:, s) = [(rise(suspension, state, w, kkt%rhs), w=1, size(height))]
      end do
      call decompose(slope, rank_share, parts)
      if (.not. parts%is_found) then
         call fail(error, exit_convergence, "balance = 'spring': "//not_finite)
         return
      end if
      call min_norm(parts, -height, change)
      associate (springs => suspension%elements(:size(change)))
         where (is_free(springs)) springs%preload = springs%preload + change
      end associate
   end subroutine lower_by

   !> The upward motion of a wheel centre in a step of all bodies [m].
   pure real(wp) function rise(suspension, state, wheel, step)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: wheel
      real(wp), intent(in) :: step(:)
      real(wp) :: arm(3)
      integer :: at

      at = 6*(suspension%wheels(wheel)%body - 1)
      arm = rotated(state%poses(suspension%wheels(wheel)%body + 1)%a, suspension%wheels(wheel)%centre)
      rise = step(at + 3) + dot_product([0.0_wp, 0.0_wp, 1.0_wp], cross(step(at + 4:at + 6), arm))
   end function rise

   !> Solves one linear problem: min Σ f²/2k, subject to equilibrium of preloads, Φqᵀλ and loads at design.
   subroutine balance_all(suspension, has_details, error)
      type(suspension_t), intent(inout) :: suspension
      logical, intent(in) :: has_details
      type(error_t), allocatable, intent(out) :: error
      type(kkt_t) :: kkt
      type(state_t) :: state
      type(evaluation_t) :: evaluation
      type(singular_values_t) :: carried, held
      real(wp), allocatable :: weighted(:, :), free(:, :), load(:), x(:), y(:), remainder(:), uncarried(:, :)
      real(wp), allocatable :: root(:), column(:)
      integer :: b, k, s, t, nx, ny

      where (is_free(suspension%elements)) suspension%elements%preload = 0.0_wp
      do b = 1, size(suspension%elements) - suspension%scalars
         suspension%elements(suspension%scalars + b)%bushing%preload_force = 0.0_wp
         suspension%elements(suspension%scalars + b)%bushing%preload_moment = 0.0_wp
         call set_bushing_axes(suspension%elements(suspension%scalars + b)%bushing)
      end do
      kkt = new_kkt(suspension)
      state = design_state(suspension)
      call assemble(suspension, state, inputs_t(), residual_only, kkt)
      allocate (load(kkt%nq), remainder(kkt%nq))
      load = kkt%rhs(:kkt%nq)*kkt%scale(:kkt%nq)
      nx = 6*(size(suspension%elements) - suspension%scalars)
      ny = suspension%scalars + kkt%nc
      allocate (weighted(kkt%nq, nx), free(kkt%nq, ny), root(nx), column(kkt%nq), source=0.0_wp)
      do b = 1, size(suspension%elements) - suspension%scalars
         root(6*b - 5:6*b) = sqrt(max(design_rates(suspension%elements(suspension%scalars + b)%bushing), 0.0_wp))
         do k = 1, 6
            call bushing_column(suspension, b, k, column)
            weighted(:, 6*(b - 1) + k) = column*root(6*(b - 1) + k)*kkt%scale(:kkt%nq)
         end do
      end do
      do s = 1, suspension%scalars
         if (.not. is_free(suspension%elements(s))) cycle
         associate (m => suspension%elements(s)%measure)
            call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            call add_gradient(1.0_wp, evaluation%gradient, 6*(m%body_i - 1), 6*(m%body_j - 1), free(:, s))
         end associate
      end do
      do k = 1, kkt%nc
         if (.not. takes_part(suspension, k)) cycle
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (m => suspension%terms(t)%measure)
               call add_gradient(-1.0_wp, kkt%gradients(:, t), 6*(m%body_i - 1), 6*(m%body_j - 1), free(:, suspension%scalars + k))
            end associate
         end do
      end do
      free = free*spread(kkt%scale(:kkt%nq), 2, ny)

      ! the part that springs and joints can carry without cost is projected out; the bushings carry the rest. If springs and
      ! joints can carry everything, only rounding is left of `weighted`, which is not a stiffness.
      call decompose(free, rank_share, carried)
      allocate (uncarried, source=transpose(carried%left(:, carried%rank + 1:)))
      call decompose(matmul(uncarried, weighted), rank_share, held, whole=norm2(weighted))
      if (.not. (carried%is_found .and. held%is_found .and. all(ieee_is_finite(load)))) then
         call fail(error, exit_model, "balance = 'all': "//not_finite)
         return
      end if
      allocate (x(nx), y(ny))
      call min_norm(held, -matmul(uncarried, load), x)
      remainder = -load - matmul(weighted, x)
      call min_norm(carried, remainder, y)
      remainder = remainder - matmul(free, y)
      if (.not. norm2(remainder) <= 1.0e-8_wp*max(norm2(load), tiny(1.0_wp))) then
         call fail(error, exit_model, "balance = 'all': no preload of springs and bushings holds the constant loads at design")
         if (has_details) error%message = error%message//kept_out(suspension)
         return
      end if
      associate (springs => suspension%elements(:suspension%scalars))
         where (is_free(springs)) springs%preload = y(:suspension%scalars)
      end associate
      ! the prescribed value of a driver with a stiffness compensates its deflection
      suspension%rows%target = suspension%rows%target - suspension%rows%compliance*y(suspension%scalars + 1:)
      do b = 1, size(suspension%elements) - suspension%scalars
         suspension%elements(suspension%scalars + b)%bushing%preload_force = x(6*b - 5:6*b - 3)*root(6*b - 5:6*b - 3)
         suspension%elements(suspension%scalars + b)%bushing%preload_moment = x(6*b - 2:6*b)*root(6*b - 2:6*b)
         call set_bushing_axes(suspension%elements(suspension%scalars + b)%bushing)
      end do
   end subroutine balance_all

   !> The generalised force on the bodies at design of a unit preload component k of bushing b.
   subroutine bushing_column(suspension, b, k, column)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: b, k
      real(wp), intent(out) :: column(:)
      real(wp), parameter :: none(3) = 0.0_wp
      real(wp) :: axis(3), gradient(12)

      column = 0.0_wp
      associate (bushing => suspension%elements(suspension%scalars + b)%bushing, &
         measure => suspension%elements(suspension%scalars + b)%measure)
         axis = bushing%axes(:, merge(k, k - 3, k <= 3))
         gradient = [none, -axis, none, axis]
         if (k <= 3) gradient = [-axis, -cross(measure%arm_i + bushing%gap0, axis), axis, cross(measure%arm_j, axis)]
         call add_gradient(1.0_wp, gradient, 6*(measure%body_i - 1), 6*(measure%body_j - 1), column)
      end associate
   end subroutine bushing_column

end module ek_balance
