!> Derivatives of the columns of a case with respect to numbers of the deck, at states of its path. No solution is repeated.
!>
!>     call begin_derivatives(workspace, k, columns, directions, self)        once per deck, case, columns, numbers; creates strings
!>     call find_derivatives(workspace, states, self)                         at each design, after its case is solved
!>
!> The derivative of a column y with respect to a number p follows in two steps at every state z:
!>
!> 1. The motion of the state, dz/dp, is found (ek_part_force, ek_state_derivative). The motion is exact except for rounding.
!> 2. Each column is observed at both ends of this motion, in the neighbouring designs p + h and p − h:
!>
!>        dy/dp = [y(z ⊕ h dz/dp, p + h) − y(z ⊕ −h dz/dp, p − h)]/2h
!>
!> The state z ⊕ h dz/dp follows the path of equilibria to first order, which is sufficient for a derivative. So every column of the
!> table is differentiated by the formula with which it is observed, and a new column needs no code here. If there are few columns
!> and many numbers, the adjoint method (ek_column_gradient) replaces the motions of the state.
!>
!> With the same difference at 2h, Richardson's extrapolation removes the error of order h². The difference of both quotients is the
!> reported error. The reported error is an upper limit if the column is smooth. The error is large if the column has a corner
!> within 2h (a stop at contact, a point of a curve, an absolute value).
!> A neighbouring design is the complete design of x ± h: realised, balanced, mounted. Its swept values are the swept values of the
!> same state of the path. An undefined derivative is NaN: at a state that was not reached or has a singular tangent, for a number
!> that cannot move, and for a column without a value at the state.
module ek_derivatives
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_contract, only: are_checked, require
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_lapack, only: dgemm
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, inputs_rate
   use ek_schedule, only: schedule_t, new_schedule, inputs_at
   use ek_kkt, only: assemble_rate
   use ek_table, only: name_length
   use ek_case_result, only: case_result_t
   use ek_workspace, only: workspace_t
   use ek_state_derivative, only: solve_motions, displace
   use ek_part_change, only: change_t, draft_t
   use ek_part_force, only: part_forces_t, choose_parts, find_responses, find_force
   use ek_column_observer, only: column_observer_t, new_column_observer, observe_columns, keep_state, kept_loads, reads_states, &
      reads_wheels_only, count_blocks, columns_of_block, is_same_block, observe_block
   use ek_column_gradient, only: find_gradients, parts_of_gradient
   use ek_direction, only: direction_t
   use ek_block_gradient, only: block_gradients_t, begin_gradients, are_cheaper, find_block_gradients, find_shares
   use ek_neighbour, only: neighbour_t, point_t, begin_neighbour, follow_design, take_states, learn_number, go_to
   use ek_stencil, only: stencils, differentiate
   implicit none(type, external)
   private
   public :: derivatives_t, begin_derivatives, find_derivatives, refuse_case

   real(wp), parameter :: rounding = 1.0e-6_wp !! limit of corners of the forces on the bodies [N]; smaller corners are ignored
   integer, parameter :: max_numbers = 4000000 !! limit of the numbers in motions and observations that are stored at a time: 32 MB

   !> The derivatives of the columns of a case at some states.
   type :: derivatives_t
      integer :: case = 0                                  !! index of the case in the workspace
      character(name_length), allocatable :: columns(:)
      type(direction_t), allocatable :: directions(:)
      integer, allocatable :: states(:)                    !! indices of the states on the path of the case
      real(wp), allocatable :: factor(:)                   !! swept value of each state, in its unit
      real(wp), allocatable :: values(:, :)                !! (column, state): values as in the table of the case
      real(wp), allocatable :: slopes(:, :, :) !! (column, direction, state): derivatives, unit of the column per unit of the number
      real(wp), allocatable :: errors(:, :, :)             !! estimated errors of `slopes`
      real(wp), allocatable :: along(:, :)                 !! (column, state): dy/ds along the path, per SI unit of the swept value,
                                                           !! at the states where they are wanted
      logical, allocatable :: can_move(:)                  !! whether each direction can be varied at this design
      type(neighbour_t) :: neighbour                       !! work space, also for the numbers of the model (ek_defined_slopes)
      type(column_observer_t), private :: observer
   end type derivatives_t

contains

   !> Prepares the derivatives of a case that is solved by `workspace`. Creates strings.
   subroutine begin_derivatives(workspace, k, columns, directions, self)
      type(workspace_t), intent(in) :: workspace          !! the case was solved at its present numbers (solve_or_explain)
      integer, intent(in) :: k                             !! index of the case, which refuse_case must accept
      character(*), intent(in) :: columns(:) !! columns of the table of the case, or of the table of its compliance matrix
      type(direction_t), intent(in) :: directions(:)
      type(derivatives_t), intent(out) :: self

      self%case = k
      self%directions = directions
      call begin_neighbour(workspace, k, self%neighbour)
      associate (result => workspace%cases(k)%result)
         call new_column_observer(result%suspension, result%case, columns, self%observer)
      end associate
      self%columns = self%observer%columns
      allocate (self%can_move(size(directions)), source=.true.)
   end subroutine begin_derivatives

   !> Rejects a case that has no derivatives. A case has derivatives if each of its states is an equilibrium, under inputs that
   !> follow from the swept value of the state.
   subroutine refuse_case(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(out) :: error     !! exit_usage

      if (case%method /= 'equilibrium') then
         call fail(error, exit_usage, 'case '//quoted(case%name)//' has method '//quoted(case%method)//', whose states are not '// &
            'equilibria: their derivatives depend on all states before them. Derivatives need method equilibrium')
      else if (case%follows_arc) then
         call fail(error, exit_usage, 'case '//quoted(case%name)//' has follow = ''arc'', where the swept value of a state '// &
            'depends on the design. Derivatives need follow = ''factor''')
      end if
   end subroutine refuse_case

   !> Computes the derivatives at states of the path that the workspace has found for the case. No string is created.
   subroutine find_derivatives(workspace, states, self, wants_along)
      type(workspace_t), intent(inout) :: workspace !! the case is solved at its present numbers; the work space of the case is used
      integer, intent(in) :: states(:)
      type(derivatives_t), intent(inout) :: self           !! prepared by begin_derivatives
      logical, intent(in), optional :: wants_along(:)      !! whether self%along is wanted at each state; absent: nowhere
      integer :: first, last, many

      if (are_checked) call require(self%case > 0 .and. size(self%neighbour%x) == size(workspace%x), &
         'find_derivatives: call begin_derivatives first')
      call allocate_results(size(states), self)
      self%states = states
      call follow_design(workspace, self%neighbour)
      associate (result => workspace%cases(self%case)%result)
         self%factor = result%path%value(states)/result%case%unit
         ! motions are kept for as many states as fit
         many = max(1, max_numbers/max(1, (size(self%directions) + kept_loads(self%observer) + 4)*result%kkt%n, &
            6*size(self%columns)))
         do first = 1, size(states), many
            last = min(first + many - 1, size(states))
            call derive(workspace%x, result, first, last, self, wants_along)
         end do
      end associate
   end subroutine find_derivatives

   subroutine allocate_results(states, self)
      integer, intent(in) :: states
      type(derivatives_t), intent(inout) :: self

      if (allocated(self%slopes)) then
         if (size(self%slopes, 3) /= states) deallocate (self%values, self%slopes, self%errors, self%along)
      end if
      associate (columns => size(self%columns), directions => size(self%directions))
         if (.not. allocated(self%slopes)) allocate (self%values(columns, states), self%slopes(columns, directions, states), &
            self%errors(columns, directions, states), self%along(columns, states))
      end associate
      self%can_move(:) = .true.
   end subroutine allocate_results

   !> Computes derivatives at the states first … last of self%states.
   subroutine derive(x, result, first, last, self, wants_along)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: first, last
      type(derivatives_t), intent(inout) :: self
      logical, intent(in), optional :: wants_along(:)      !! of all states
      type(point_t), allocatable :: points(:)
      type(inputs_t), allocatable :: inputs(:)             ! of each state
      real(wp), allocatable :: values(:, :), kept(:, :, :)
      type(change_t) :: changes(size(self%directions))
      type(draft_t) :: draft
      type(block_gradients_t) :: gradients
      integer :: p, s

      allocate (points(first:last), inputs(first:last))
      allocate (values(size(self%columns), first:last), source=ieee_value(1.0_wp, ieee_quiet_nan))
      allocate (kept(kept_loads(self%observer), result%kkt%n, first:last), source=0.0_wp)
      call take_states(result, self%states(first:last), self%neighbour, points, inputs)
      do s = first, last
         if (.not. points(s)%is_regular) cycle
         call observe_columns(result%suspension, points(s)%state, inputs(s), result%kkt, self%observer, values(:, s))
         call keep_state(self%observer, kept(:, :, s))
         if (.not. present(wants_along)) cycle
         if (wants_along(s)) call find_along(result, points(s), values(:, s), kept(:, :, s), self%observer, self%along(:, s))
      end do
      self%values(:, first:last) = values
      do p = 1, size(self%directions)
         call learn_number(x, self%directions(p), result, points, inputs, self%neighbour, draft, changes(p), self%can_move(p))
      end do
      if (is_adjoint(self)) then
         call derive_by_columns(x, result, first, last, inputs, changes, values, points, self)
      else if (is_by_blocks(result, self, gradients)) then
         call derive_by_blocks(x, result, first, last, inputs, changes, values, points, gradients, self)
      else
         call derive_by_numbers(x, result, first, last, inputs, changes, values, kept, points, self)
      end if
      do s = first, last
         if (points(s)%is_regular) cycle
         self%slopes(:, :, s) = ieee_value(1.0_wp, ieee_quiet_nan)
         self%errors(:, :, s) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
      do p = 1, size(self%directions)
         if (self%can_move(p)) cycle
         self%slopes(:, p, first:last) = ieee_value(1.0_wp, ieee_quiet_nan)
         self%errors(:, p, first:last) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
   end subroutine derive

   !> Computes the derivatives of the columns along the path, dy/ds, as those with respect to a number. The motion of the state is
   !> the tangent of the path, and each column is observed at both ends of this motion.
   !> Equation (E.11) of docs/theory/derivatives.md.
   subroutine find_along(result, point, values, kept, observer, along)
      type(case_result_t), intent(inout) :: result
      type(point_t), intent(inout) :: point
      real(wp), intent(in) :: values(:), kept(:, :)        !! of the state
      type(column_observer_t), intent(inout) :: observer
      real(wp), intent(out) :: along(:)
      real(wp), parameter :: share = 1.0e-4_wp             ! step, as a share of the range of the case
      type(schedule_t) :: schedule
      type(inputs_t) :: here, there(4)
      type(state_t) :: moved
      real(wp) :: motion(result%kkt%n, 1), step(result%kkt%nq), y(size(values), 4), errors(size(values)), h
      integer :: k

      along = ieee_value(1.0_wp, ieee_quiet_nan)
      h = share*abs(result%case%to - result%case%from)
      if (.not. h > 0.0_wp) return
      schedule = new_schedule(result%suspension, result%case)
      associate (place => result%path%value(point%number))
         call inputs_at(schedule, place, here)
         do k = 1, 4
            call inputs_at(schedule, place + stencils(1)%at(k)*h, there(k))
         end do
      end associate
      call assemble_rate(result%suspension, point%state, &
         inputs_rate(there(2), there(3), (stencils(1)%at(3) - stencils(1)%at(2))*h), result%kkt)
      motion(:, 1) = result%kkt%rhs(:result%kkt%n)
      call solve_motions(result%suspension, point%state, here, result%kkt, 1, motion, point%is_regular)
      if (.not. point%is_regular) return
      moved = design_state(result%suspension)
      do k = 1, 4
         call displace(point%state, motion(:, 1), stencils(1)%at(k)*h, step, moved)
         call observe_columns(result%suspension, moved, there(k), result%kkt, observer, y(:, k), kept)
      end do
      call differentiate(stencils(1), h, values, y, along, errors)
   end subroutine find_along

   !> Whether the derivatives are computed by columns: one solution per column costs less than one per number, and all columns
   !> follow from the state.
   pure logical function is_adjoint(self)
      type(derivatives_t), intent(in) :: self
      is_adjoint = size(self%columns) > 0 .and. 3*size(self%columns) <= size(self%directions) .and. reads_states(self%observer)
   end function is_adjoint

   !> Whether the derivatives are computed from gradients of blocks of columns. If so, prepares the gradients.
   logical function is_by_blocks(result, self, gradients)
      type(case_result_t), intent(in) :: result
      type(derivatives_t), intent(in) :: self
      type(block_gradients_t), intent(inout) :: gradients

      is_by_blocks = size(self%columns) > 0 .and. reads_states(self%observer)
      if (.not. is_by_blocks) return
      call begin_gradients(result%suspension, result%kkt, self%observer, gradients)
      is_by_blocks = are_cheaper(gradients, size(self%directions))
   end function is_by_blocks

   !> Computes the derivatives from the motions of the states, with one solution per number and state.
   subroutine derive_by_numbers(x, result, first, last, inputs, changes, values, kept, points, self)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: first, last
      type(inputs_t), intent(in) :: inputs(first:)         !! inputs of each state
      type(change_t), intent(in) :: changes(:)             !! changes from learn_number, of each number
      real(wp), intent(in) :: values(:, first:)            !! (column, state)
      real(wp), intent(in) :: kept(:, :, first:)           !! (load, unknown, state): data from keep_state
      type(point_t), intent(inout) :: points(first:)
      type(derivatives_t), intent(inout) :: self
      type(part_forces_t) :: parts
      real(wp), allocatable :: motions(:, :, :), doubts(:, :)
      integer :: p, s

      allocate (doubts(size(self%directions), first:last), source=0.0_wp)
      allocate (motions(result%kkt%n, size(self%directions), first:last))
      call choose_parts(result%suspension, changes, parts)
      do s = first, last
         if (.not. points(s)%is_regular) cycle
         call find_forces(result, points(s)%state, inputs(s), s - first + 1, changes, parts, self, motions(:, :, s), doubts(:, s))
         call solve_motions(result%suspension, points(s)%state, inputs(s), result%kkt, size(self%directions), motions(:, :, s), &
            points(s)%is_regular)
      end do
      if (size(self%columns) == 0) return
      do p = 1, size(self%directions)
         if (self%can_move(p)) call find_slopes_along(motions(:, p, :), x, self%directions(p), result, points, inputs, values, &
            kept, self%neighbour, self%observer, self%can_move(p), self%slopes(:, p, first:last), self%errors(:, p, first:last))
      end do
      call add_doubts(doubts, first, last, self)
   end subroutine derive_by_numbers

   !> Adds the errors of ∂F/∂p to the errors of the derivatives.
   subroutine add_doubts(doubts, first, last, self)
      integer, intent(in) :: first, last
      real(wp), intent(in) :: doubts(:, first:)            !! (number, state), from find_forces
      type(derivatives_t), intent(inout) :: self
      integer :: p, s

      do s = first, last
         do p = 1, size(self%directions)
            if (.not. abs(doubts(p, s)) <= 0.0_wp) self%errors(:, p, s) = self%errors(:, p, s) + doubts(p, s)* &
               abs(self%slopes(:, p, s))
         end do
      end do
   end subroutine add_doubts

   !> Computes the derivatives of columns of states as ∂y/∂z dz/dp + ∂y/∂p, with one gradient ∂y/∂z for all numbers.
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine derive_by_blocks(x, result, first, last, inputs, changes, values, points, gradients, self)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: first, last
      type(inputs_t), intent(in) :: inputs(first:)         !! inputs of each state
      type(change_t), intent(in) :: changes(:)             !! changes from learn_number, of each number
      real(wp), intent(in) :: values(:, first:)            !! (column, state)
      type(point_t), intent(inout) :: points(first:)
      type(block_gradients_t), intent(inout) :: gradients  !! from begin_gradients
      type(derivatives_t), intent(inout) :: self
      type(part_forces_t) :: parts
      type(state_t) :: moved
      real(wp) :: motions(result%kkt%n, size(self%directions)), doubts(size(self%directions), first:last)
      integer :: p, s

      doubts = 0.0_wp
      call choose_parts(result%suspension, changes, parts)
      moved = design_state(result%suspension)
      do s = first, last
         if (.not. points(s)%is_regular) cycle
         call find_forces(result, points(s)%state, inputs(s), s - first + 1, changes, parts, self, motions, doubts(:, s))
         call solve_motions(result%suspension, points(s)%state, inputs(s), result%kkt, size(self%directions), motions, &
            points(s)%is_regular)
         if (.not. points(s)%is_regular) cycle
         call find_block_gradients(result%suspension, points(s)%state, result%kkt, values(:, s), self%observer, moved, gradients)
         call find_shares(motions, values(:, s), gradients, self%slopes(:, :, s), self%errors(:, :, s))
      end do
      do p = 1, size(self%directions)
         if (self%can_move(p)) call add_slopes_at(x, self%directions(p), result, points, values, self%neighbour, self%observer, &
            self%can_move(p), self%slopes(:, p, first:last), self%errors(:, p, first:last))
      end do
      call add_doubts(doubts, first, last, self)
   end subroutine derive_by_blocks

   !> Computes the derivatives from the gradients of the columns, with one solution per column and state (adjoint method).
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine derive_by_columns(x, result, first, last, inputs, changes, values, points, self)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: first, last
      type(inputs_t), intent(in) :: inputs(first:)         !! inputs of each state
      type(change_t), intent(in) :: changes(:)             !! changes from learn_number, of each number
      real(wp), intent(in) :: values(:, first:)            !! (column, state)
      type(point_t), intent(inout) :: points(first:)
      type(derivatives_t), intent(inout) :: self
      type(part_forces_t) :: parts
      type(state_t) :: moved
      real(wp) :: forces(result%kkt%n, size(self%directions)), doubts(size(self%directions)), &
         gradients(result%kkt%n, parts_of_gradient, size(self%columns)), &
         shares(size(self%directions), parts_of_gradient, size(self%columns))
      integer :: c, p, s

      do s = first, last
         if (.not. points(s)%is_regular) cycle
         self%slopes(:, :, s) = spread(values(:, s) - values(:, s), 2, size(self%directions))
         self%errors(:, :, s) = self%slopes(:, :, s)
      end do
      do p = 1, size(self%directions)
         if (.not. self%can_move(p)) cycle
         if (changes(p)%moves_wheels .or. .not. reads_wheels_only(self%observer)) call add_slopes_at(x, self%directions(p), &
            result, points, values, self%neighbour, self%observer, self%can_move(p), self%slopes(:, p, first:last), &
            self%errors(:, p, first:last))
      end do
      call choose_parts(result%suspension, changes, parts)
      moved = design_state(result%suspension)
      do s = first, last
         if (.not. points(s)%is_regular) cycle
         call find_gradients(result%suspension, points(s)%state, inputs(s), result%kkt, self%observer, values(:, s), moved, &
            gradients)
         call solve_motions(result%suspension, points(s)%state, inputs(s), result%kkt, size(gradients)/result%kkt%n, gradients, &
            points(s)%is_regular, is_transposed=.true.)
         if (.not. points(s)%is_regular) cycle
         call find_forces(result, points(s)%state, inputs(s), s - first + 1, changes, parts, self, forces, doubts)
         call dgemm('T', 'N', size(self%directions), size(gradients)/result%kkt%n, result%kkt%n, 1.0_wp, forces, result%kkt%n, &
            gradients, result%kkt%n, 0.0_wp, shares, size(self%directions))
         do p = 1, size(self%directions)
            if (.not. self%can_move(p)) cycle
            do c = 1, size(self%columns)
               associate (share => shares(p, :, c))
                  self%slopes(c, p, s) = self%slopes(c, p, s) + share(1)
                  self%errors(c, p, s) = self%errors(c, p, s) + abs(share(2)) + abs(share(3)) + doubts(p)*abs(share(1))
               end associate
            end do
         end do
      end do
   end subroutine derive_by_columns

   !> Computes ∂F/∂p of all numbers at a state.
   !> Equation (E.1) of docs/theory/derivatives.md.
   subroutine find_forces(result, state, inputs, at, changes, parts, self, forces, doubts)
      type(case_result_t), intent(in) :: result
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      integer, intent(in) :: at                            !! index of the state in the rates of the changes
      type(change_t), intent(in) :: changes(:)
      type(part_forces_t), intent(inout) :: parts          !! prepared by choose_parts
      type(derivatives_t), intent(in) :: self
      real(wp), intent(inout) :: forces(:, :)              !! (unknown, number); zero for a number that cannot move
      real(wp), intent(inout) :: doubts(:)                 !! corner of F, as a share of ∂F/∂p
      real(wp) :: corner(size(forces, 1)), jump
      integer :: p

      call find_responses(result%suspension, state, parts)
      do p = 1, size(changes)
         if (.not. self%can_move(p)) then
            forces(:, p) = 0.0_wp
            cycle
         end if
         call find_force(result%suspension, state, inputs, at, changes(p), parts, forces(:, p), corner)
         doubts(p) = changes(p)%doubt
         if (.not. changes(p)%has_curves) cycle
         jump = norm2(corner*result%kkt%scale)
         if (jump*self%directions(p)%step*sqrt(result%kkt%stiffness) > rounding) doubts(p) = max(doubts(p), &
            jump/max(norm2(forces(:, p)*result%kkt%scale), jump))
      end do
   end subroutine find_forces

   !> Finds the difference quotients of the columns along the motions of the states. The first stencil whose points are all valid
   !> designs is used.
   !> Equation (E.2) of docs/theory/derivatives.md.
   subroutine find_slopes_along(motions, x, direction, result, points, here, values, kept, neighbour, observer, can_move, slopes, &
      errors)
      real(wp), intent(in) :: motions(:, :)                !! (unknown, state): dz/dp
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(direction_t), intent(in) :: direction
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      type(inputs_t), intent(in) :: here(:)                !! inputs of the states, of the design itself
      real(wp), intent(in) :: values(:, :)                 !! (column, state)
      real(wp), intent(in) :: kept(:, :, :)                !! (load, unknown, state): data from keep_state
      type(neighbour_t), intent(inout) :: neighbour
      type(column_observer_t), intent(inout) :: observer
      logical, intent(out) :: can_move                     !! .false.: every stencil contains a design that is not valid
      real(wp), intent(inout) :: slopes(:, :), errors(:, :)      !! (column, state)
      type(inputs_t) :: inputs(size(points))
      type(state_t) :: moved
      real(wp) :: step(result%kkt%nq), y(size(values, 1), 4, size(points))
      logical :: has_inputs
      integer :: kind, k, s

      moved = design_state(result%suspension)
      do kind = 1, size(stencils)
         do k = 1, 4
            call go_to(x, direction, stencils(kind)%at(k), result, points, neighbour, inputs, has_inputs, can_move)
            if (.not. can_move) exit
            if (.not. has_inputs) inputs = here
            associate (there => neighbour%workspace%cases(neighbour%case)%result)
               do s = 1, size(points)
                  if (.not. points(s)%is_regular) cycle
                  call displace(points(s)%state, motions(:, s), direction%step*stencils(kind)%at(k), step, moved)
                  call observe_columns(there%suspension, moved, inputs(s), there%kkt, observer, y(:, k, s), kept(:, :, s))
               end do
            end associate
         end do
         if (.not. can_move) cycle
         do s = 1, size(points)
            if (points(s)%is_regular) call differentiate(stencils(kind), direction%step, values(:, s), y(:, :, s), slopes(:, s), &
               errors(:, s))
         end do
         return
      end do
   end subroutine find_slopes_along

   !> Adds the difference quotients of the columns at states that do not move, ∂y/∂p. Only blocks of columns whose numbers differ
   !> between the designs are observed. The columns must follow from states alone (reads_states).
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine add_slopes_at(x, direction, result, points, values, neighbour, observer, can_move, slopes, errors)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(direction_t), intent(in) :: direction
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      real(wp), intent(in) :: values(:, :)                 !! (column, state)
      type(neighbour_t), intent(inout) :: neighbour
      type(column_observer_t), intent(inout) :: observer
      logical, intent(out) :: can_move                     !! .false.: every stencil contains a design that is not valid
      real(wp), intent(inout) :: slopes(:, :), errors(:, :)      !! (column, state)
      type(inputs_t) :: inputs(size(points))               ! no column of a state reads the inputs
      real(wp) :: y(size(values, 1), 4, size(points)), slope(size(values, 1)), error(size(values, 1))
      logical :: is_other(count_blocks(observer), 4), has_inputs
      integer :: kind, k, s, b, first, last

      do kind = 1, size(stencils)
         do k = 1, 4
            call go_to(x, direction, stencils(kind)%at(k), result, points, neighbour, inputs, has_inputs, can_move)
            if (.not. can_move) exit
            associate (there => neighbour%workspace%cases(neighbour%case)%result)
               do b = 1, size(is_other, 1)
                  is_other(b, k) = .not. is_same_block(result%suspension, there%suspension, observer, b)
                  if (.not. is_other(b, k)) cycle
                  do s = 1, size(points)
                     if (points(s)%is_regular) call observe_block(there%suspension, points(s)%state, there%kkt, observer, b, &
                        y(:, k, s))
                  end do
               end do
            end associate
         end do
         if (.not. can_move) cycle
         do s = 1, size(points)
            if (.not. points(s)%is_regular) cycle
            do b = 1, size(is_other, 1)
               if (.not. any(is_other(b, :))) cycle
               call columns_of_block(observer, b, first, last)
               do k = 1, 4
                  if (.not. is_other(b, k)) y(first:last, k, s) = values(first:last, s)
               end do
               call differentiate(stencils(kind), direction%step, values(first:last, s), y(first:last, :, s), &
                  slope(first:last), error(first:last))
               slopes(first:last, s) = slopes(first:last, s) + slope(first:last)
               errors(first:last, s) = errors(first:last, s) + error(first:last)
            end do
         end do
         return
      end do
   end subroutine add_slopes_at

end module ek_derivatives
