!> Determines preloads for which the design position is in equilibrium under the constant loads.
!>
!> `spring`: the spring preloads for which the wheels are at design height in static equilibrium.
!> `all`: spring and bushing preloads with which every body stays exactly at design; of several solutions, the
!> solution with the smallest complementary energy Σ f²/2k of the bushing preloads (k of a curve: its slope at design).
!> The preloads of dampers, stops, torsion springs, springs on measures and springs with `balance = .false.` are unchanged.
!>
!> A driver with a stiffness that acts on the body of a wheel (a tyre modelled as a spring under the contact point) would carry the
!> wheel instead of the spring: such a driver is excluded from `all` unless its joint sets `balance = .true.`. Other drivers (a
!> rack, a steering column) are included unless their joint sets `balance = .false.`.
module ek_balance
   use ek_kinds, only: wp, degree
   use ek_error, only: error_t, message_list_t, fail, exit_model, exit_convergence
   use ek_text, only: str, quoted, plural
   use ek_measure, only: evaluation_t, evaluate
   use ek_block, only: rotated, add_gradient
   use ek_elastic, only: set_bushing_axes
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_adjust, only: adjust
   use ek_state, only: state_t, inputs_t, design_state
   use ek_kkt, only: kkt_t, new_kkt, assemble, factorise, solve, whole_tangent
   use ek_preload_problem, only: preload_problem_t, set_problem, clear_preloads, is_free, takes_part
   use ek_preload_solution, only: hold_by_elimination, hold_by_singular_values, rank_share
   use ek_reach, only: settle, failure_t
   use ek_singular_values, only: singular_values_t, decompose, min_norm
   implicit none(type, external)
   private
   public :: balance_failure_t, balance, set_preloads, fail_balance, balance_remarks, no_start, not_aligned

   ! why no preloads were found; fail_balance has the messages
   integer, parameter :: has_no_spring = 1          !! no spring, or no wheel
   integer, parameter :: does_not_settle = 2
   integer, parameter :: misses_height = 3
   integer, parameter :: is_singular_there = 4      !! the matrix is singular at static equilibrium
   integer, parameter :: springs_not_finite = 5
   integer, parameter :: all_not_finite = 6
   integer, parameter :: does_not_hold = 7
   integer, parameter :: not_aligned = 9             !! no values of the adjusters give the angles of &align (ek_align)
   integer, parameter :: no_start = 8               !! the start state of the tests was not found (ek_start)

   type :: balance_failure_t
      integer :: reason = 0                         !! one of the constants above; 0: none
      real(wp) :: misfit = 0.0_wp                   !! largest distance of a wheel from its design height [m]
      integer :: adjuster = 0                       !! not_aligned: index of an adjuster whose range is too small; 0: none
      real(wp) :: needed = 0.0_wp                   !! value that this adjuster would need [m]
      real(wp) :: worst_angle = 0.0_wp              !! largest deviation of an angle from &align [rad]
   end type balance_failure_t

   character(*), parameter :: not_finite = 'the forces or stiffnesses at design are too large to calculate with'

contains

   !> Sets the preloads according to suspension%balance ('none': no change). Returns an error if there is no solution.
   subroutine balance(suspension, tolerance, error)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance                    !! m
      type(error_t), allocatable, intent(out) :: error     !! exit_model, exit_convergence: no solution
      type(preload_problem_t) :: space
      type(balance_failure_t) :: failure

      call set_preloads(suspension, tolerance, space, failure)
      call fail_balance(suspension, failure, error)
   end subroutine balance

   !> Sets the preloads like `balance`, but returns a failure as a reason without a message: no string is created. The preloads hold
   !> the drawn axle; the adjusters are set afterwards, by ek_align if the deck has an &align.
   subroutine set_preloads(suspension, tolerance, space, failure)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance                    !! m
      type(preload_problem_t), intent(inout) :: space      !! work space, for one design of a model after the other
      type(balance_failure_t), intent(out) :: failure

      select case (suspension%balance)
      case ('spring')
         call balance_springs(suspension, tolerance, failure)
      case ('all')
         call balance_all(suspension, space, failure)
      end select
      if (failure%reason == 0 .and. size(suspension%aligns) == 0) call adjust(suspension)
   end subroutine set_preloads

   !> Reports a failure of set_preloads as an error.
   subroutine fail_balance(suspension, failure, error)
      type(suspension_t), intent(in) :: suspension
      type(balance_failure_t), intent(in) :: failure
      type(error_t), allocatable, intent(out) :: error     !! not allocated if there was no failure

      select case (failure%reason)
      case (has_no_spring)
         call fail(error, exit_model, "balance = 'spring' needs a spring and a wheel")
      case (does_not_settle)
         call fail(error, exit_convergence, "balance = 'spring': the suspension does not settle")
      case (misses_height)
         call fail(error, exit_convergence, "balance = 'spring': no preload brings the wheels to design height; "// &
            'the remaining error is '//str(failure%misfit*1000.0_wp, 4)//' mm')
      case (is_singular_there)
         call fail(error, exit_convergence, "balance = 'spring': the matrix is singular where the suspension settles")
      case (springs_not_finite)
         call fail(error, exit_convergence, "balance = 'spring': "//not_finite)
      case (all_not_finite)
         call fail(error, exit_model, "balance = 'all': "//not_finite)
      case (does_not_hold)
         call fail(error, exit_model, "balance = 'all': no preload of springs and bushings holds the constant loads at design"// &
            kept_out(suspension))
      case (not_aligned)
         call fail(error, exit_convergence, suspension%aligns(1)%where//': '//align_words(suspension, failure))
      case (no_start)
         call fail(error, exit_convergence, 'there is no start state'//start_words(suspension))
      end select
   end subroutine fail_balance

   !> Message about angles of &align that were not met.
   function align_words(suspension, failure) result(text)
      type(suspension_t), intent(in) :: suspension
      type(balance_failure_t), intent(in) :: failure
      character(:), allocatable :: text

      text = 'align: the adjusters do not give the angles; '
      if (failure%adjuster > 0) then
         associate (this => suspension%adjusters(failure%adjuster))
            text = text//'adjuster '//quoted(this%name)//' would need about '//str(failure%needed*1000.0_wp, 3)// &
               ' mm, but its range is '//str(this%low*1000.0_wp, 4)//' to '//str(this%high*1000.0_wp, 4)// &
               ' mm; at the end of the range, an angle is '//str(failure%worst_angle/degree, 4)//' deg off'
         end associate
      else
         text = text//'they do not change the angles independently, or no position of the axle was found; '// &
            'name one adjuster for each angle'
      end if
   end function align_words

   !> Phrase about a start state that was not found, for an error message: ' with start_height = 20 mm: no equilibrium …'.
   function start_words(suspension) result(text)
      type(suspension_t), intent(in) :: suspension
      character(:), allocatable :: text

      select case (suspension%start)
      case ('height')
         text = ' at start_height = '//str(suspension%start_height*1000.0_wp, 6)//' mm: with the wheels held there, no '// &
            'equilibrium was found; give a height that the suspension reaches'
      case ('wheel_load')
         text = ' under start_load = '//str(suspension%start_load, 6)//' N: the wheels find no equilibrium '// &
            'under this load; give a load that the springs carry'
      case ('added_mass')
         text = ' with added_mass = '//str(suspension%start_mass, 6)//' kg: the wheels find no equilibrium '// &
            'under this mass; give a mass that the springs carry'
      case default
         text = ' under the constant loads (start = ''loads''): the wheels find no equilibrium; give start = ''height'', '// &
            'or loads that the springs carry'
      end select
   end function start_words

   !> Lists warnings on the preload trim (`balance`): excluded drivers, and preloads that are not unique.
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

   !> Phrase about excluded drivers for an error message: '; driver 'rack' is excluded unless …'; '' without excluded
   !> drivers.
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

   !> Applies Newton's method to the wheel heights in equilibrium. With more springs than wheels, each change of
   !> the preloads has minimum norm.
   !>
   !> The first change solves the linear problem at design and is close to the final change. A wheel with too little preload
   !> would settle on its stop, where the slope would give a change many times too large.
   subroutine balance_springs(suspension, tolerance, failure)
      type(suspension_t), intent(inout) :: suspension
      real(wp), intent(in) :: tolerance
      type(balance_failure_t), intent(inout) :: failure
      type(kkt_t) :: kkt
      type(state_t) :: state
      type(failure_t) :: lost
      real(wp) :: height(size(suspension%wheels))
      integer :: w, iteration

      if (.not. any(is_free(suspension%elements)) .or. size(suspension%wheels) == 0) then
         failure%reason = has_no_spring
         return
      end if
      kkt = new_kkt(suspension)
      state = design_state(suspension)
      call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
      call factorise(kkt)
      if (.not. kkt%is_singular) then
         call solve(kkt)
         height = [(rise(suspension, state, w, kkt%rhs), w=1, size(height))]
         call lower_by(height, suspension, state, kkt, failure)
         if (failure%reason /= 0) return
      end if
      do iteration = 1, 30
         state = design_state(suspension)
         lost = failure_t()
         call settle(suspension, tolerance, state, kkt, lost)
         if (lost%state > 0) then
            failure%reason = does_not_settle
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
         call lower_by(height, suspension, state, kkt, failure)
         if (failure%reason /= 0) return
      end do
      failure = balance_failure_t(misses_height, maxval(abs(height)))
   end subroutine balance_springs

   !> Changes the spring preloads such that the wheels move down by `height` according to the tangent at a state.
   subroutine lower_by(height, suspension, state, kkt, failure)
      real(wp), intent(in) :: height(:)                    !! per wheel [m]
      type(suspension_t), intent(inout) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt                    !! with the factors at this state
      type(balance_failure_t), intent(inout) :: failure
      type(singular_values_t) :: parts
      type(evaluation_t) :: evaluation
      real(wp) :: slope(size(suspension%wheels), suspension%scalars)
      real(wp) :: change(suspension%scalars)         ! per spring; 0 for other elements
      integer :: s, w

      if (kkt%is_singular) then
         failure%reason = is_singular_there
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
         failure%reason = springs_not_finite
         return
      end if
      call min_norm(parts, -height, change)
      associate (springs => suspension%elements(:size(change)))
         where (is_free(springs)) springs%preload = springs%preload + change
      end associate
   end subroutine lower_by

   !> The upward displacement of a wheel centre in a step of all bodies [m].
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

   !> Solves the linear problem min Σ f²/2k, subject to equilibrium of preloads, Φqᵀλ and loads at design.
   subroutine balance_all(suspension, problem, failure)
      type(suspension_t), intent(inout) :: suspension
      type(preload_problem_t), intent(inout) :: problem    !! work space
      type(balance_failure_t), intent(inout) :: failure
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: remainder
      logical :: is_sure, is_found
      integer :: b

      call clear_preloads(suspension)
      call set_problem(suspension, problem)
      allocate (x(problem%nx), y(problem%ny))
      call hold_by_elimination(problem, x, y, is_sure)
      if (.not. is_sure) then
         call hold_by_singular_values(problem, x, y, remainder, is_found)
         if (.not. is_found) then
            failure%reason = all_not_finite
            return
         end if
         if (.not. remainder <= 1.0e-8_wp*max(norm2(problem%load), tiny(1.0_wp))) then
            failure%reason = does_not_hold
            return
         end if
      end if
      associate (springs => suspension%elements(:suspension%scalars))
         where (is_free(springs)) springs%preload = y(:suspension%scalars)
      end associate
      ! the prescribed value of a driver with a stiffness compensates its deflection
      suspension%rows%target = suspension%rows%target - suspension%rows%compliance*y(suspension%scalars + 1:)
      do b = 1, size(suspension%elements) - suspension%scalars
         associate (bushing => suspension%elements(suspension%scalars + b)%bushing)
            bushing%preload_force = x(6*b - 5:6*b - 3)*problem%root(6*b - 5:6*b - 3)
            bushing%preload_moment = x(6*b - 2:6*b)*problem%root(6*b - 2:6*b)
            call set_bushing_axes(bushing)
         end associate
      end do
   end subroutine balance_all

end module ek_balance
