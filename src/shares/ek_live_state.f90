!> Data of a state from which a page computes its columns for other rates, exactly and without the model.
!>
!> Each of the m laws acts along a deflection gᵀu; let s = √rate. G is s gᵀu per unit load at the wheel centres, and G_v is G of
!> the transpose. A is s gᵀu per load s on each law itself. E contains the relative changes of the rates (0.1: 10 % more). The
!> formula of ek_what_if then has no unit:
!>
!>     C' = C − G_vᵀ (I + E A)⁻¹ E G
!>
!> A column that is linear in C is the reading rᵀC b of a load b. It changes by −ρᵀ (I + E A)⁻¹ E β with ρ = G_v r and β = G b: 2m
!> numbers per column in addition to the m(m + 1)/2 numbers of A. The kernels that compute the columns give ρ and β, from the
!> matrices g_v,a g_bᵀ of rows a of G_v and b of G; so a new column needs no code in this module. With heights held, the formula
!> uses G and A of the suspension whose heights are held. A stiffness is the inverse of such a column: the formula gives the change
!> of its inverse.
module ek_live_state
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_compliance, only: compliance_t
   use ek_contribution, only: contribution_t, new_contribution, split_compliance, of_stiffness
   use ek_element_part, only: find_deflections
   use ek_kkt, only: kkt_t
   use ek_lapack, only: dgesv
   use ek_linear_columns, only: linear_columns_t, start_linear_columns, choose_linear_columns, find_linear_columns, &
      fill_linear_columns
   use ek_live_rates, only: live_rates_t, find_laws
   use ek_loaded_wheels, only: phase
   use ek_measure, only: evaluation_t, evaluate
   use ek_path, only: path_t
   use ek_port_response, only: lock_t, find_lock, keep_locked
   use ek_quantity, only: unit_size
   use ek_schedule, only: schedule_t, inputs_at
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_table, only: name_length
   use ek_text, only: is_like
   use ek_what_if, only: find_self_moves
   use ek_wheel_side, only: prefix_of
   implicit none(type, external)
   private
   public :: live_state_t, live_columns_t, start_live, find_live_state, changed_value

   !> A stiffness column equal to 1/(displacement of a wheel centre along an axis, under equal loads along this axis on all wheels).
   !> The ride rate has the tyre in series, which adds a constant to the inverse.
   type :: inverse_t
      character(32) :: name
      integer :: axis
   end type inverse_t
   type(inverse_t), parameter :: inverses(*) = [inverse_t('wheel_rate_n_per_mm', 3), inverse_t('ride_rate_n_per_mm', 3), &
      inverse_t('fore_aft_stiffness_n_per_mm', 1), inverse_t('lateral_stiffness_n_per_mm', 2), &
      inverse_t('vertical_stiffness_n_per_mm', 3)]

   !> The columns of a test that follow the rates, and work space.
   type :: live_columns_t
      integer :: used = 0
      character(name_length), allocatable :: name(:)
      logical, allocatable :: is_held(:)              !! whether each column is at held heights of the wheel centres
      logical, allocatable :: is_inverse(:)
      integer, allocatable, private :: wheel(:), axis(:)      ! of an inverse: index in the matrix
      type(linear_columns_t), private :: columns
      type(contribution_t), private :: shares
      integer, allocatable, private :: laws(:)
   end type live_columns_t

   !> The numbers of a state from which the page computes its columns.
   type :: live_state_t
      logical :: is_known = .false.                   !! whether the matrix is not singular
      real(wp), allocatable :: self(:, :), held_self(:, :)   !! A: (law, law), with loads held; with heights held
      real(wp), allocatable :: read(:, :), load(:, :)        !! ρ and β of each column: (law, column), in the unit of the column
      real(wp), allocatable :: deflection(:)                 !! √rate × deflection that the rate multiplies
      real(wp), allocatable :: move(:, :), held_move(:, :)   !! G_v of the wheel centres: (law, displacement)
   end type live_state_t

contains

   !> Chooses the columns of a test that match `names`, and the laws of the rates. Stiffnesses and columns at held heights are
   !> chosen only for a single wheel or an axle. No column is chosen if the test does not have all laws of the rates.
   subroutine start_live(suspension, rates, names, self)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(live_rates_t), intent(in) :: rates
      character(*), intent(in) :: names(:)                  !! columns, with the name of the wheel; * stands for any letters
      type(live_columns_t), intent(out) :: self
      logical, allocatable :: is_wanted(:)
      character(:), allocatable :: prefix
      logical :: can_hold
      integer :: k, i

      call start_linear_columns(suspension, self%columns)
      self%shares = new_contribution(suspension, self%columns%kandc%compliance%wheels)
      call append_drivers(self%shares)
      call find_laws(suspension, self%shares, rates, self%laws)
      can_hold = size(suspension%wheels) == 1 .or. self%columns%kandc%is_pair
      allocate (self%name(0), self%is_held(0), self%is_inverse(0), self%wheel(0), self%axis(0), is_wanted(self%columns%used))
      is_wanted = .false.
      if (any(self%laws == 0)) return
      do k = 1, self%columns%used
         associate (name => self%columns%names(k))
            is_wanted(k) = is_named(name, names)
            if (index(name, '_height_held_') > 0) is_wanted(k) = is_wanted(k) .and. can_hold
            if (is_wanted(k)) call add(name, index(name, '_height_held_') > 0, 0, 0)
         end associate
      end do
      call choose_linear_columns(self%columns, is_wanted)
      do k = 1, merge(size(suspension%wheels), 0, can_hold)
         prefix = prefix_of(suspension, self%columns%kandc%compliance%order(k))
         do i = 1, size(inverses)
            if (is_named(prefix//trim(inverses(i)%name), names)) &
               call add(prefix//trim(inverses(i)%name), .false., k, inverses(i)%axis)
         end do
      end do

   contains

      subroutine add(name, is_held, wheel, axis)
         character(*), intent(in) :: name
         logical, intent(in) :: is_held
         integer, intent(in) :: wheel, axis

         self%used = self%used + 1
         self%name = [character(name_length) :: self%name, name]
         self%is_held = [self%is_held, is_held]
         self%is_inverse = [self%is_inverse, axis > 0]
         self%wheel = [self%wheel, wheel]
         self%axis = [self%axis, axis]
      end subroutine add

   end subroutine start_live

   !> Appends the drivers with a stiffness to the laws of a list of contributions, which has the laws of the elements alone.
   subroutine append_drivers(shares)
      type(contribution_t), intent(inout) :: shares          !! of new_contribution
      integer :: laws, k

      do k = 1, size(shares%share)
         if (shares%share(k)%part == of_stiffness) shares%law = [shares%law, k]
      end do
      laws = size(shares%law)
      associate (n => size(shares%gradient, 1), loads => size(shares%move, 1))
         deallocate (shares%slope)
         allocate (shares%slope(laws), source=0.0_wp)
         shares%gradient = reshape(shares%gradient, [n, laws], pad=[0.0_wp])
         shares%move = reshape(shares%move, [loads, laws], pad=[0.0_wp])
         shares%left_move = reshape(shares%left_move, [loads, laws], pad=[0.0_wp])
      end associate
   end subroutine append_drivers

   !> Finds slope and gradient of the drivers with a stiffness, and their deflections per unit load. A driver acts along the gradient
   !> of its row like a spring.
   subroutine find_drivers(suspension, state, shares)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(contribution_t), intent(inout) :: shares          !! of append_drivers, at this state
      real(wp) :: value
      integer :: l, n, row

      n = suspension%unknowns()
      do l = 1, size(shares%law)
         associate (share => shares%share(shares%law(l)))
            if (share%part /= of_stiffness) cycle
            row = suspension%joints(share%item)%first_row
         end associate
         shares%slope(l) = 1.0_wp/suspension%rows(row)%compliance
         call find_row(suspension, state, row, value, shares%gradient(:, l))
         shares%move(:, l) = matmul(shares%gradient(:n, l), shares%right(:n, :))
         shares%left_move(:, l) = matmul(shares%gradient(:n, l), shares%left(:n, :))
      end do
   end subroutine find_drivers

   !> Finds the value of the row of a driver, and its gradient.
   subroutine find_row(suspension, state, row, value, gradient)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: row
      real(wp), intent(out) :: value                         !! m, -, rad
      real(wp), intent(out) :: gradient(:)                   !! unknown of all bodies
      type(evaluation_t) :: evaluation
      integer :: t, b

      value = 0.0_wp
      gradient = 0.0_wp
      do t = suspension%rows(row)%first, suspension%rows(row)%first + suspension%rows(row)%terms - 1
         associate (m => suspension%terms(t)%measure, coefficient => suspension%terms(t)%coefficient)
            call evaluate(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
            value = value + coefficient*evaluation%value
            b = 6*m%body_i
            if (b > 0) gradient(b - 5:b) = gradient(b - 5:b) + coefficient*evaluation%gradient(1:6)
            b = 6*m%body_j
            if (b > 0) gradient(b - 5:b) = gradient(b - 5:b) + coefficient*evaluation%gradient(7:12)
         end associate
      end do
   end subroutine find_row

   pure logical function is_named(name, names)
      character(*), intent(in) :: name, names(:)
      integer :: k

      is_named = .false.
      do k = 1, size(names)
         if (is_like(trim(name), trim(names(k)))) is_named = .true.
      end do
   end function is_named

   !> Finds the numbers of one converged state of a path.
   !> Equation (C.19) of docs/theory/compliance.md.
   subroutine find_live_state(suspension, schedule, path, k, kkt, columns, self)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(schedule_t), intent(in) :: schedule              !! of the case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k                              !! index of the state
      type(kkt_t), intent(inout) :: kkt                     !! work space; on return, with the factors of the state
      type(live_columns_t), intent(inout) :: columns        !! of start_live
      type(live_state_t), intent(out) :: self
      type(state_t) :: state
      type(inputs_t) :: inputs
      real(wp), allocatable :: values(:), root(:), move(:, :), left(:, :)
      integer :: l, m

      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
      call inputs_at(schedule, path%value(k), inputs)
      allocate (values(size(columns%columns%asked)))
      call find_linear_columns(suspension, state, inputs, kkt, columns%columns, values)
      associate (compliance => columns%columns%kandc%compliance, shares => columns%shares)
         self%is_known = compliance%is_known .and. has_rates(suspension)
         if (.not. self%is_known) return
         call split_compliance(suspension, state, inputs, kkt, compliance, shares)
         call find_drivers(suspension, state, shares)
         call find_self_moves(columns%laws, kkt, compliance, shares, self%self)
         m = size(columns%laws)
         root = sqrt(shares%slope(columns%laws))
         move = shares%move(:, columns%laws)
         left = shares%left_move(:, columns%laws)
         do l = 1, m
            self%self(:, l) = root(:)*self%self(:, l)*root(l)
            move(:, l) = root(l)*move(:, l)
            left(:, l) = root(l)*left(:, l)
         end do
         call find_factors(suspension, left, move, columns, self)
         call hold_heights(compliance, move, left, self)
         self%move = transpose(left)
         call find_forces(suspension, state, inputs, root, columns, self)
      end associate
   end subroutine find_live_state

   !> Finds ρ and β of every column, from the values of the column for the matrices g_v,a g_bᵀ, whose table over a and b has the
   !> rank 1.
   subroutine find_factors(suspension, left, move, columns, self)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: left(:, :), move(:, :)        !! (load, law)
      type(live_columns_t), intent(in) :: columns
      type(live_state_t), intent(inout) :: self
      real(wp) :: share(size(left, 1), size(left, 1)), whole(12, 12), own(6)
      real(wp), allocatable :: table(:, :, :)
      integer :: a, b, c, n, at(2)

      n = size(columns%columns%asked)
      allocate (table(size(left, 2), size(left, 2), columns%used))
      do b = 1, size(move, 2)
         do a = 1, size(left, 2)
            share = spread(left(:, a), 2, size(left, 1))*spread(move(:, b), 1, size(left, 1))
            call fill_linear_columns(suspension, share, columns%columns, table(a, b, :n))
            whole = 0.0_wp
            whole(:size(share, 1), :size(share, 1)) = share
            do c = n + 1, columns%used
               own = phase(size(share, 1)/6, whole, columns%wheel(c), columns%axis(c), 1.0_wp)
               table(a, b, c) = own(columns%axis(c))*unit_size(trim(columns%name(c)))
            end do
         end do
      end do
      allocate (self%read(size(left, 2), columns%used), self%load(size(left, 2), columns%used), source=0.0_wp)
      do c = 1, columns%used
         if (.not. all(ieee_is_finite(table(:, :, c)))) cycle
         at = maxloc(abs(table(:, :, c)))
         if (.not. abs(table(at(1), at(2), c)) > 0.0_wp) cycle
         self%read(:, c) = table(:, at(2), c)
         self%load(:, c) = table(at(1), :, c)/table(at(1), at(2), c)
      end do
   end subroutine find_factors

   !> Computes A and the displacements of the wheel centres while the heights of the wheel centres are held.
   subroutine hold_heights(compliance, move, left, self)
      type(compliance_t), intent(in) :: compliance
      real(wp), intent(in) :: move(:, :), left(:, :)        !! (load, law)
      type(live_state_t), intent(inout) :: self             !! contains A
      real(wp), allocatable :: response(:, :)
      type(lock_t) :: lock
      integer :: n, m, j

      n = size(move, 1)
      m = size(move, 2)
      allocate (response(n + m, n + m))
      response(:n, :n) = compliance%response(:n, :n)
      response(:n, n + 1:) = left
      response(n + 1:, :n) = transpose(move)
      response(n + 1:, n + 1:) = self%self
      call find_lock(response, [(6*j - 3, j=1, n/6)], lock)
      do j = n + 1, n + m
         call keep_locked(lock, response(:, j))
      end do
      self%held_self = response(n + 1:, n + 1:)
      self%held_move = transpose(response(:n, n + 1:))
   end subroutine hold_heights

   !> Finds √rate × deflection of each law at the state. A changed rate changes the force of its law in proportion to this value. The
   !> deflection of a driver is its displacement from design less its prescribed displacement.
   subroutine find_forces(suspension, state, inputs, root, columns, self)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      real(wp), intent(in) :: root(:)
      type(live_columns_t), intent(in) :: columns
      type(live_state_t), intent(inout) :: self
      real(wp) :: deflection(6), value, at_design
      real(wp) :: gradient(suspension%unknowns())
      integer :: l, k, row

      allocate (self%deflection(size(root)))
      do l = 1, size(root)
         associate (share => columns%shares%share(columns%shares%law(columns%laws(l))))
            if (share%part == of_stiffness) then
               row = suspension%joints(share%item)%first_row
               call find_row(suspension, design_state(suspension), row, at_design, gradient)
               call find_row(suspension, state, row, value, gradient)
               do k = 1, inputs%rows
                  if (inputs%row(k) == row) value = value - inputs%change(k)
               end do
               self%deflection(l) = root(l)*(value - at_design)
               cycle
            end if
            associate (element => suspension%elements(share%item))
               call find_deflections(element, state%poses(element%measure%body_i + 1), state%poses(element%measure%body_j + 1), &
                  deflection)
            end associate
            self%deflection(l) = root(l)*deflection(share%part)
         end associate
      end do
   end subroutine find_forces

   !> The value of a column with other rates, as the script of the page computes it. Equation (C.19) of docs/theory/compliance.md.
   real(wp) function changed_value(state, c, is_held, is_inverse, value, change) result(changed)
      type(live_state_t), intent(in) :: state               !! is_known
      integer, intent(in) :: c                               !! index of the column
      logical, intent(in) :: is_held, is_inverse             !! kind of the column
      real(wp), intent(in) :: value                          !! value with the rates of the deck, in the unit of the column
      real(wp), intent(in) :: change(:)                      !! relative change of the rate of each law
      real(wp) :: matrix(size(change), size(change)), x(size(change), 1)
      integer :: pivots(size(change)), k, info

      do k = 1, size(change)
         if (is_held) matrix(k, :) = change(k)*state%held_self(k, :)
         if (.not. is_held) matrix(k, :) = change(k)*state%self(k, :)
         matrix(k, k) = matrix(k, k) + 1.0_wp
      end do
      x(:, 1) = change*state%load(:, c)
      call dgesv(size(change), 1, matrix, size(change), pivots, x, size(change), info)
      changed = ieee_value(changed, ieee_quiet_nan)
      if (info /= 0) return
      changed = -dot_product(state%read(:, c), x(:, 1))
      if (is_inverse) then
         changed = value/(1.0_wp + value*changed)
      else
         changed = value + changed
      end if
   end function changed_value

end module ek_live_state
