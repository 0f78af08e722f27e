!> The heart: five scalar functions of the poses of two bodies, with gradient and Hessian.
!>
!> A joint is a list of measures held at a value, an elastic element a list of measures with
!> a law, a driver a measure with a prescribed value, an output a measure read out.
!>
!> Coordinates: z = [Δr_i Δπ_i Δr_j Δπ_j], translation and rotation vector in GLOBAL axes,
!> r ← r + Δr, A ← exp(Δπ̃) A (Kang 2005, eq. 4). A point on arm s moves by Δr − s̃ Δπ (eq. 12).
!>
!> | kind       | value   | gradient in z                     |
!> |------------|---------|-----------------------------------|
!> | axis_axis  | u·v     | [0, u×v, 0, v×u]                  |
!> | body_gap   | u·d     | [−u, −(a+d)×u, u, b×u]            |
!> | global_gap | n·d     | [−n, −a×n, n, b×n]                |
!> | distance   | \|d\|   | Jᵀe, J = [−I, ã, I, −b̃], e = d/\|d\| |
!> | rotation   | m·θ     | [0, −A_i g, 0, A_i g]             |
!>
!> u is fixed in body i and v in body j, n is a global direction; a, b are the arms of the two
!> points, d = x_j − x_i; θ = log(A_iᵀ A_j) in the axes of body i, m a constant vector there.
!> S(p,g) = ½(p gᵀ + g pᵀ) − (p·g) I, p̃ the skew matrix of p. Hessians are those in the
!> exponential coordinates above, hence symmetric; every block was derived by hand and is checked
!> against central differences in tests/model/test_measure.pf.
module ek_measure
   use ek_kinds, only: wp
   use ek_rotation, only: cross, identity3
   implicit none(type, external)
   private
   public :: pose_t, measure_t, view_t, turn_t
   public :: axis_axis, body_gap, global_gap, distance, rotation
   public :: look, measure_value, measure_gradient, add_measure_hessian
   public :: relative_turn, turn_jacobian, add_turn_hessian
   public :: turn_gradient, add_gap_hessian, add_link_stiffness, add_diagonal_block, add_block
   public :: s_matrix, rotated

   integer, parameter :: axis_axis = 1    !! cosine between an axis of i and an axis of j [-]
   integer, parameter :: body_gap = 2     !! gap of two points along a direction fixed in i [m]
   integer, parameter :: global_gap = 3   !! gap of two points along a global direction [m]
   integer, parameter :: distance = 4     !! distance of two points [m]
   integer, parameter :: rotation = 5     !! component of the relative rotation vector [rad]

   !> Where a body is. Kept together, 128 bytes, because every measure reads all of it.
   type :: pose_t
      real(wp) :: r(3) = 0.0_wp                          !! reference point, global [m]
      real(wp) :: q(4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]  !! unit quaternion of a
      real(wp) :: a(3, 3) = identity3                    !! body axes → global axes
   end type pose_t

   !> One scalar measure between body i and body j (0 is the chassis). At design all body axes
   !> are parallel to the global ones, so directions and arms are those of the design position.
   type :: measure_t
      integer :: kind = 0                 !! one of the five above
      integer :: body_i = 0, body_j = 0
      real(wp) :: u(3) = 0.0_wp           !! direction in i (body_gap, axis_axis: unit), n, or m
      real(wp) :: v(3) = 0.0_wp           !! direction in j (axis_axis)
      real(wp) :: arm_i(3) = 0.0_wp       !! point on i from its reference point, body axes [m]
      real(wp) :: arm_j(3) = 0.0_wp       !! point on j likewise
   end type measure_t

   !> The relative rotation of two bodies: θ = α(t) p, p = 2 qv, t = pᵀp, in the axes of body i.
   type :: turn_t
      real(wp) :: q0 = 1.0_wp, qv(3) = 0.0_wp   !! quaternion of A_iᵀ A_j, q0 ≥ 0
      real(wp) :: p(3) = 0.0_wp
      real(wp) :: alpha = 1.0_wp, alpha1 = 0.0_wp, alpha2 = 0.0_wp   !! α, dα/dt, d²α/dt²
      real(wp) :: theta(3) = 0.0_wp             !! rotation vector [rad]
   end type turn_t

   !> A measure's vectors in global axes at one pair of poses: computed once, used for
   !> value, gradient and Hessian.
   type :: view_t
      real(wp) :: value = 0.0_wp
      real(wp) :: gradient(12) = 0.0_wp
      real(wp) :: u(3) = 0.0_wp, v(3) = 0.0_wp   !! directions, or e and (m·θ): A_i g
      real(wp) :: a(3) = 0.0_wp, b(3) = 0.0_wp, d(3) = 0.0_wp
      real(wp) :: frame(3, 3) = 0.0_wp           !! A_i, kept for `rotation`
      type(turn_t) :: turn
   end type view_t

contains

   !> A v
   pure function rotated(a, v) result(w)
      real(wp), intent(in) :: a(3, 3), v(3)
      real(wp) :: w(3)
      w(1) = a(1, 1)*v(1) + a(1, 2)*v(2) + a(1, 3)*v(3)
      w(2) = a(2, 1)*v(1) + a(2, 2)*v(2) + a(2, 3)*v(3)
      w(3) = a(3, 1)*v(1) + a(3, 2)*v(2) + a(3, 3)*v(3)
   end function rotated

   !> S(p,g) = ½(p gᵀ + g pᵀ) − (p·g) I
   pure function s_matrix(p, g) result(s)
      real(wp), intent(in) :: p(3), g(3)
      real(wp) :: s(3, 3), x, y, z

      x = p(1)*g(1); y = p(2)*g(2); z = p(3)*g(3)
      s(1, 1) = -y - z
      s(2, 2) = -x - z
      s(3, 3) = -x - y
      s(2, 1) = 0.5_wp*(p(1)*g(2) + p(2)*g(1)); s(1, 2) = s(2, 1)
      s(3, 1) = 0.5_wp*(p(1)*g(3) + p(3)*g(1)); s(1, 3) = s(3, 1)
      s(3, 2) = 0.5_wp*(p(2)*g(3) + p(3)*g(2)); s(2, 3) = s(3, 2)
   end function s_matrix

   !> Value and gradient of a measure, and its vectors for the Hessian.
   !>
   !> Degenerate: a distance of 0 has no direction (checked when the model is built); a rotation
   !> of exactly π has no unique axis.
   pure subroutine look(measure, pose_i, pose_j, view)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      type(view_t), intent(inout) :: view     !! only what this kind needs is set
      real(wp) :: g(3), w(3)

      select case (measure%kind)
      case (axis_axis)
         view%u = rotated(pose_i%a, measure%u)
         view%v = rotated(pose_j%a, measure%v)
         view%value = dot_product(view%u, view%v)
         w = cross(view%u, view%v)
         view%gradient(1:3) = 0.0_wp
         view%gradient(4:6) = w
         view%gradient(7:9) = 0.0_wp
         view%gradient(10:12) = -w
      case (rotation)
         call relative_turn(pose_i, pose_j, view%turn)
         view%value = dot_product(measure%u, view%turn%theta)
         g = turn_gradient(view%turn, measure%u)
         view%u = measure%u
         view%v = rotated(pose_i%a, g)
         view%frame = pose_i%a
         view%gradient(1:3) = 0.0_wp
         view%gradient(4:6) = -view%v
         view%gradient(7:9) = 0.0_wp
         view%gradient(10:12) = view%v
      case default
         view%a = rotated(pose_i%a, measure%arm_i)
         view%b = rotated(pose_j%a, measure%arm_j)
         view%d = (pose_j%r - pose_i%r) + (view%b - view%a)
         w = view%a
         select case (measure%kind)
         case (body_gap)
            view%u = rotated(pose_i%a, measure%u)
            view%value = dot_product(view%u, view%d)
            w = view%a + view%d
         case (global_gap)
            view%u = measure%u
            view%value = dot_product(view%u, view%d)
         case default
            view%value = sqrt(view%d(1)**2 + view%d(2)**2 + view%d(3)**2)
            view%u = view%d/view%value
         end select
         view%gradient(1:3) = -view%u
         view%gradient(4:6) = -cross(w, view%u)
         view%gradient(7:9) = view%u
         view%gradient(10:12) = cross(view%b, view%u)
      end select
   end subroutine look

   !> The value alone.
   pure real(wp) function measure_value(measure, pose_i, pose_j) result(value)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      type(view_t) :: view
      call look(measure, pose_i, pose_j, view)
      value = view%value
   end function measure_value

   !> The gradient alone, d(value)/d[Δr_i Δπ_i Δr_j Δπ_j].
   pure function measure_gradient(measure, pose_i, pose_j) result(gradient)
      type(measure_t), intent(in) :: measure
      type(pose_t), intent(in) :: pose_i, pose_j
      real(wp) :: gradient(12)
      type(view_t) :: view
      call look(measure, pose_i, pose_j, view)
      gradient = view%gradient
   end function measure_gradient

   !> Adds weight × Hessian to the lower triangle of a matrix.
   !>
   !> at_i, at_j: number of unknowns before those of body i, j; negative: the body has none.
   !> Diagonal 3×3 blocks are added whole.
   pure subroutine add_measure_hessian(kind, view, weight, at_i, at_j, ld, matrix)
      integer, intent(in) :: kind
      type(view_t), intent(in) :: view          !! of `look`, at the same poses
      real(wp), intent(in) :: weight
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: u(3), m(3, 3), slope
      real(wp), parameter :: none(3, 3) = 0.0_wp

      select case (kind)
      case (rotation)
         u = weight*view%u
         call add_turn_hessian(view%turn, u, none, view%frame, at_i, at_j, ld, matrix)
      case (axis_axis)
         u = weight*view%u
         m = s_matrix(u, view%v)
         call add_diagonal_block(m, at_i + 3, at_i, ld, matrix)
         call add_diagonal_block(m, at_j + 3, at_j, ld, matrix)
         if (at_i >= 0 .and. at_j >= 0) then
            call add_block(dyad_rest(view%v, u), at_i + 3, at_j + 3, ld, matrix)
         end if
      case (body_gap)
         u = weight*view%u
         call add_gap_hessian(u, view%a, view%b, view%d, at_i, at_j, ld, matrix)
      case (global_gap)
         u = weight*view%u
         call add_diagonal_block(-s_matrix(view%a, u), at_i + 3, at_i, ld, matrix)
         call add_diagonal_block(s_matrix(view%b, u), at_j + 3, at_j, ld, matrix)
      case (distance)
         slope = weight/view%value
         m = slope*(identity3 - dyad(view%u, view%u))
         call add_link_stiffness(m, view%a, view%b, at_i, at_j, ld, matrix)
         u = weight*view%u
         call add_diagonal_block(-s_matrix(view%a, u), at_i + 3, at_i, ld, matrix)
         call add_diagonal_block(s_matrix(view%b, u), at_j + 3, at_j, ld, matrix)
      end select
   end subroutine add_measure_hessian

   !> Adds the Hessian of f·d, f fixed in body i (any length: the measure is linear in f).
   !>
   !> π_iπ_i: S(a+d,f);  π_jπ_j: S(b,f);  π_i r_j = f̃ = −π_i r_i;  π_iπ_j = (f·b)I − b fᵀ
   pure subroutine add_gap_hessian(f, a, b, d, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: f(3), a(3), b(3), d(3)   !! global axes
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: skew_f(3, 3)

      call add_diagonal_block(s_matrix(b, f), at_j + 3, at_j, ld, matrix)
      if (at_i < 0) return
      call add_diagonal_block(s_matrix(a + d, f), at_i + 3, at_i, ld, matrix)
      skew_f(:, 1) = [0.0_wp, f(3), -f(2)]
      skew_f(:, 2) = [-f(3), 0.0_wp, f(1)]
      skew_f(:, 3) = [f(2), -f(1), 0.0_wp]
      call add_block(-skew_f, at_i + 3, at_i, ld, matrix)
      if (at_j < 0) return
      call add_block(skew_f, at_i + 3, at_j, ld, matrix)
      call add_block(dyad_rest(b, f), at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_gap_hessian

   !> The relative rotation of body j seen from body i.
   pure subroutine relative_turn(pose_i, pose_j, turn)
      type(pose_t), intent(in) :: pose_i, pose_j
      type(turn_t), intent(out) :: turn
      real(wp) :: i0, iv(3), j0, jv(3), half, s

      i0 = pose_i%q(1); iv = pose_i%q(2:4)
      j0 = pose_j%q(1); jv = pose_j%q(2:4)
      turn%q0 = i0*j0 + dot_product(iv, jv)
      turn%qv = i0*jv - j0*iv - cross(iv, jv)
      if (turn%q0 < 0.0_wp) then
         turn%q0 = -turn%q0
         turn%qv = -turn%qv
      end if
      turn%p = 2.0_wp*turn%qv
      s = dot_product(turn%qv, turn%qv)
      if (s < 1.0e-3_wp) then
         ! asin(x)/x and its derivatives in t = 4 x²; s = x². Terms left out are below 1e-17 of α
         turn%alpha = 1.0_wp + s*(1.0_wp/6 + s*(3.0_wp/40 + s*(5.0_wp/112 + s*(35.0_wp/1152 + s*63.0_wp/2816))))
         turn%alpha1 = 0.25_wp*(1.0_wp/6 + s*(3.0_wp/20 + s*(15.0_wp/112 + s*(35.0_wp/288 + s*(315.0_wp/2816 &
            + s*231.0_wp*6/13312)))))
         turn%alpha2 = 0.0625_wp*(3.0_wp/20 + s*(15.0_wp/56 + s*(35.0_wp/96 + s*(315.0_wp/704 &
            + s*231.0_wp*30/13312))))
      else
         s = sqrt(s)
         half = atan2(s, turn%q0)
         turn%alpha = half/s
         ! q0 = cos(half angle): zero only at exactly half a turn, where θ itself jumps
         turn%alpha1 = (1.0_wp/turn%q0 - turn%alpha)/(8.0_wp*s*s)
         turn%alpha2 = (0.125_wp/turn%q0**3 - 3.0_wp*turn%alpha1)/(8.0_wp*s*s)
      end if
      turn%theta = turn%alpha*turn%p
   end subroutine relative_turn

   !> g = Pᵀ w, the gradient of m·θ in δ, with P = q0 I − q̃v and w = (αI + 2α' p pᵀ) m.
   pure function turn_gradient(turn, m) result(g)
      type(turn_t), intent(in) :: turn
      real(wp), intent(in) :: m(3)
      real(wp) :: g(3), w(3)
      w = turn%alpha*m + (2.0_wp*turn%alpha1*dot_product(turn%p, m))*turn%p
      g = turn%q0*w + cross(turn%qv, w)
   end function turn_gradient

   !> G = ∂θ/∂δ = (αI + 2α' p pᵀ)(q0 I − q̃v), δ = A_iᵀ(π_j − π_i).
   pure function turn_jacobian(turn) result(jacobian)
      type(turn_t), intent(in) :: turn
      real(wp) :: jacobian(3, 3), w(3)
      integer :: k

      do k = 1, 3
         w = (2.0_wp*turn%alpha1*turn%p(k))*turn%p
         w(k) = w(k) + turn%alpha
         jacobian(k, :) = turn%q0*w + cross(turn%qv, w)
      end do
   end function turn_jacobian

   !> Adds the Hessian of m·θ to the rotation blocks of i and j, and `inner`, a symmetric
   !> 3×3 stiffness in δ (body-i axes), with the same chain rule.
   !>
   !> In δ: Pᵀ[2α'(m pᵀ + p mᵀ) + 2α'(m·p)I + 4α''(m·p) p pᵀ]P − ½(w·qv) I; then
   !> δ = A_iᵀ(π_j − π_i − ½ π_i×π_j) brings the block π_iπ_j += ½ [A_i g]~.
   pure subroutine add_turn_hessian(turn, m, inner, a_i, at_i, at_j, ld, matrix)
      type(turn_t), intent(in) :: turn
      real(wp), intent(in) :: m(3)           !! body-i axes
      real(wp), intent(in) :: inner(3, 3)
      real(wp), intent(in) :: a_i(3, 3)      !! rotation of body i
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: h(3, 3), w(3), mp, c1, c2, core(3, 3), left(3, 3), g(3), b(3, 3), half_wq
      integer :: k

      mp = dot_product(m, turn%p)
      c1 = 2.0_wp*turn%alpha1
      c2 = 4.0_wp*turn%alpha2*mp
      do k = 1, 3
         core(:, k) = c1*(m*turn%p(k) + turn%p*m(k)) + (c2*turn%p(k))*turn%p
         core(k, k) = core(k, k) + c1*mp
      end do
      do k = 1, 3   ! left = Pᵀ core, Pᵀ x = q0 x + qv × x
         left(:, k) = turn%q0*core(:, k) + cross(turn%qv, core(:, k))
      end do
      do k = 1, 3   ! h = left P, row by row: (Pᵀ leftᵀ)ᵀ
         h(k, :) = turn%q0*left(k, :) + cross(turn%qv, left(k, :))
      end do
      w = turn%alpha*m + (c1*mp)*turn%p
      half_wq = 0.5_wp*dot_product(w, turn%qv)
      h = h + inner
      do k = 1, 3
         h(k, k) = h(k, k) - half_wq
      end do
      if (at_i < 0) then      ! the chassis never turns: a_i is the unit matrix
         call add_diagonal_block(h, at_j + 3, at_j, ld, matrix)
         return
      end if
      do k = 1, 3
         left(:, k) = rotated(a_i, h(:, k))
      end do
      do k = 1, 3
         b(k, :) = rotated(a_i, left(k, :))
      end do
      call add_diagonal_block(b, at_i + 3, at_i, ld, matrix)
      if (at_j < 0) return
      call add_diagonal_block(b, at_j + 3, at_j, ld, matrix)
      g = 0.5_wp*rotated(a_i, turn%q0*w + cross(turn%qv, w))
      b = -b
      b(2, 1) = b(2, 1) + g(3); b(3, 1) = b(3, 1) - g(2)
      b(1, 2) = b(1, 2) - g(3); b(3, 2) = b(3, 2) + g(1)
      b(1, 3) = b(1, 3) + g(2); b(2, 3) = b(2, 3) - g(1)
      call add_block(b, at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_turn_hessian

   !> Adds Jᵀ M J, J = [−I, ã, I, −b̃]: a symmetric stiffness M between two points.
   pure subroutine add_link_stiffness(m, a, b, at_i, at_j, ld, matrix)
      real(wp), intent(in) :: m(3, 3)       !! symmetric, global axes [N/m]
      real(wp), intent(in) :: a(3), b(3)    !! arms, global axes [m]
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: ma(3, 3), mb(3, 3), x(3, 3)   ! M ã, M b̃
      integer :: k

      if (at_j >= 0) then
         do k = 1, 3
            mb(k, :) = cross(m(:, k), b)
         end do
         do k = 1, 3
            x(:, k) = cross(mb(:, k), b)
         end do
         call add_diagonal_block(m, at_j, at_j, ld, matrix)
         call add_diagonal_block(x, at_j + 3, at_j, ld, matrix)
         call add_block(-mb, at_j, at_j + 3, ld, matrix)
      end if
      if (at_i >= 0) then
         do k = 1, 3
            ma(k, :) = cross(m(:, k), a)
         end do
         do k = 1, 3
            x(:, k) = cross(ma(:, k), a)
         end do
         call add_diagonal_block(m, at_i, at_i, ld, matrix)
         call add_diagonal_block(x, at_i + 3, at_i, ld, matrix)
         call add_block(-ma, at_i, at_i + 3, ld, matrix)
      end if
      if (at_i >= 0 .and. at_j >= 0) then
         do k = 1, 3
            x(:, k) = cross(a, mb(:, k))
         end do
         call add_block(-m, at_i, at_j, ld, matrix)
         call add_block(mb, at_i, at_j + 3, ld, matrix)
         call add_block(transpose(ma), at_i + 3, at_j, ld, matrix)
         call add_block(x, at_i + 3, at_j + 3, ld, matrix)
      end if
   end subroutine add_link_stiffness

   !> matrix(at+1:at+3, at+1:at+3) += block, nothing when the body has no unknowns.
   pure subroutine add_diagonal_block(block, at, body_at, ld, matrix)
      real(wp), intent(in) :: block(3, 3)
      integer, intent(in) :: at, body_at, ld
      real(wp), intent(inout) :: matrix(ld, *)
      integer :: l

      if (body_at < 0) return
      do l = 1, 3
         matrix(at + 1, at + l) = matrix(at + 1, at + l) + block(1, l)
         matrix(at + 2, at + l) = matrix(at + 2, at + l) + block(2, l)
         matrix(at + 3, at + l) = matrix(at + 3, at + l) + block(3, l)
      end do
   end subroutine add_diagonal_block

   !> Adds an off-diagonal block at (row, column) to the lower triangle, transposed if it
   !> belongs above the diagonal.
   pure subroutine add_block(block, row, column, ld, matrix)
      real(wp), intent(in) :: block(3, 3)
      integer, intent(in) :: row, column, ld
      real(wp), intent(inout) :: matrix(ld, *)
      integer :: l

      if (row > column) then
         do l = 1, 3
            matrix(row + 1, column + l) = matrix(row + 1, column + l) + block(1, l)
            matrix(row + 2, column + l) = matrix(row + 2, column + l) + block(2, l)
            matrix(row + 3, column + l) = matrix(row + 3, column + l) + block(3, l)
         end do
      else
         do l = 1, 3
            matrix(column + 1, row + l) = matrix(column + 1, row + l) + block(l, 1)
            matrix(column + 2, row + l) = matrix(column + 2, row + l) + block(l, 2)
            matrix(column + 3, row + l) = matrix(column + 3, row + l) + block(l, 3)
         end do
      end if
   end subroutine add_block

   !> x yᵀ
   pure function dyad(x, y) result(m)
      real(wp), intent(in) :: x(3), y(3)
      real(wp) :: m(3, 3)
      m(:, 1) = x*y(1)
      m(:, 2) = x*y(2)
      m(:, 3) = x*y(3)
   end function dyad

   !> (x·y) I − x yᵀ
   pure function dyad_rest(x, y) result(m)
      real(wp), intent(in) :: x(3), y(3)
      real(wp) :: m(3, 3), c
      c = dot_product(x, y)
      m = -dyad(x, y)
      m(1, 1) = m(1, 1) + c
      m(2, 2) = m(2, 2) + c
      m(3, 3) = m(3, 3) + c
   end function dyad_rest

end module ek_measure
