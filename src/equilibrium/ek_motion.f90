!> Motions of bodies by twists: their size, and the poses after a motion.
module ek_motion
   use ek_kinds, only: wp
   use ek_number, only: num, mask, one, some
   use ek_relative_rotation, only: pose_t
   use ek_rotation, only: cross, rotate_quaternion, rotation_matrix, quaternion_product
   implicit none(type, external)
   private
   public :: largest_motion, move_all, take_step, unpack_poses, pack_poses, extrapolate, &
      squared_distance, find_motion, trapezoidal_rest, body_motion

   real(wp), parameter, public :: smooth = 4.0e-3_wp      !! allowed error of the trapezoidal rule, as a share of the motion
   real(wp), parameter :: nothing = 1.0e-9_wp      !! a motion below this is rounding [m]

contains

   !> Finds the motion of a body between two poses: Δr of its reference point, and its rotation vector, global axes.
   !> Equation (R.6) of docs/theory/rotations.md.
   pure subroutine find_motion(r_a, q_a, r_b, q_b, motion)
      real(num), intent(in) :: r_a(3), q_a(4), r_b(3), q_b(4)
      real(num), intent(out) :: motion(6)               !! m, rad
      real(num) :: q(4), back(4), sine, turn
      logical(mask) :: is_far, is_large

      motion(1:3) = r_b - r_a
      back(1) = q_a(1)
      back(2:4) = -q_a(2:4)
      q = quaternion_product(q_b, back)
      is_far = q(1) < 0.0_wp                            ! q and −q are the same rotation
      if (some(is_far)) q = merge(-q, q, is_far)
      sine = sqrt(q(2)**2 + q(3)**2 + q(4)**2)
      turn = 2.0_wp
      is_large = sine > 1.0e-4_wp
      if (some(is_large)) turn = merge(2.0_wp*atan2(sine, q(1))/merge(sine, one, is_large), turn, is_large)
      motion(4:6) = turn*q(2:4)
   end subroutine find_motion


   !> The largest |Δr|, or |Δπ| × characteristic length, of any body [m]; huge if a motion is not finite.
   !> Equation (K.11) of docs/theory/kkt.md.
   pure function largest_motion(motion, length) result(largest)
      real(num), contiguous, intent(in) :: motion(:)   !! [Δr Δπ] of each body [m, rad]
      real(num), intent(in) :: length                  !! m
      real(num) :: largest, total, unlimited, shift, turn
      logical(mask) :: is_finite
      integer :: k

      unlimited = huge(1.0_wp)
      largest = 0.0_wp
      total = 0.0_wp
      do k = 1, size(motion), 6
         shift = motion(k)**2 + motion(k + 1)**2 + motion(k + 2)**2
         turn = length**2*(motion(k + 3)**2 + motion(k + 4)**2 + motion(k + 5)**2)
         largest = max(largest, max(shift, turn))
         total = total + (shift + turn)             ! max() may drop what is not a number: the sum does not
      end do
      is_finite = total < unlimited
      largest = merge(sqrt(largest), unlimited, is_finite)
   end function largest_motion

   !> Moves every body by a screw motion: the exponential of the twist (Δr at its reference point, Δπ).
   !>
   !>     r ← r + V(Δπ) Δr,   V = I + (1 − cos θ)/θ² Δπ̃ + (θ − sin θ)/θ³ Δπ̃²,   A ← exp(Δπ̃) A
   !>
   !> The result agrees with `move` of ek_state to first order. In contrast to `move`, it does not depend on the reference point of
   !> the body: a twist and its exponential belong to the body, not to a point.
   !> Equations (R.8), (R.12) of docs/theory/rotations.md.
   pure subroutine move_all(bodies, step, poses)
      integer, intent(in) :: bodies
      real(num), intent(in) :: step(6*bodies)           !! [Δr Δπ] of each body [m, rad]
      type(pose_t), intent(inout) :: poses(0:bodies)    !! the chassis, which does not move, then the bodies
      integer :: k

      do k = 1, bodies
         call move_body(step(6*k - 5:6*k - 3), step(6*k - 2:6*k), poses(k))
      end do
   end subroutine move_all

   !> Moves one body by a screw motion.
   pure subroutine move_body(v, w, pose)
      real(num), intent(in) :: v(3), w(3)               !! Δr, Δπ [m, rad]
      type(pose_t), intent(inout) :: pose
      real(num) :: bow(3), square, theta, b, c
      logical(mask) :: is_small

      square = w(1)**2 + w(2)**2 + w(3)**2
      is_small = square < 1.0e-2_wp      ! Taylor series, next terms below 1e-16
      b = 0.5_wp - square/24.0_wp*(1.0_wp - square/30.0_wp*(1.0_wp - square/56.0_wp*(1.0_wp - square/90.0_wp)))
      c = 1.0_wp/6.0_wp - square/120.0_wp*(1.0_wp - square/42.0_wp*(1.0_wp - square/72.0_wp*(1.0_wp - square/110.0_wp)))
      if (some(.not. is_small)) then
         square = merge(one, square, is_small)
         theta = sqrt(square)
         b = merge(b, (1.0_wp - cos(theta))/square, is_small)
         c = merge(c, (theta - sin(theta))/(theta*square), is_small)
      end if
      bow = cross(w, v)
      pose%r = pose%r + v + b*bow + c*cross(w, bow)
      pose%q = rotate_quaternion(w, pose%q)
      pose%a = rotation_matrix(pose%q)
   end subroutine move_body

   !> Moves the bodies and changes the reactions of those designs for which is_taken is true.
   pure subroutine take_step(bodies, rows, step, is_taken, poses, reaction)
      integer, intent(in) :: bodies, rows
      real(num), intent(in) :: step(6*bodies + rows)    !! [Δr Δπ] of each body, then Δλ
      logical(mask), intent(in) :: is_taken
      type(pose_t), intent(inout) :: poses(0:bodies)
      real(num), intent(inout) :: reaction(rows)
      type(pose_t) :: moved
      integer :: k

      do k = 1, bodies
         moved = poses(k)
         call move_body(step(6*k - 5:6*k - 3), step(6*k - 2:6*k), moved)
         poses(k)%r = merge(moved%r, poses(k)%r, is_taken)
         poses(k)%q = merge(moved%q, poses(k)%q, is_taken)
         poses(k)%a = merge(moved%a, poses(k)%a, is_taken)
      end do
      do k = 1, rows
         reaction(k) = merge(reaction(k) + step(6*bodies + k), reaction(k), is_taken)
      end do
   end subroutine take_step

   !> Unpacks poses and reactions of a packed state: [r, q] of each body, then λ; the quaternions are normalised.
   pure subroutine unpack_poses(bodies, rows, packed, poses, reaction)
      integer, intent(in) :: bodies, rows
      real(num), intent(in) :: packed(7*bodies + rows)
      type(pose_t), intent(inout) :: poses(0:bodies)
      real(num), intent(inout) :: reaction(rows)
      real(num) :: q(4)
      integer :: k

      do k = 1, bodies
         q = packed(7*k - 3:7*k)
         poses(k)%r = packed(7*k - 6:7*k - 4)
         poses(k)%q = q/sqrt(q(1)**2 + q(2)**2 + q(3)**2 + q(4)**2)
         poses(k)%a = rotation_matrix(poses(k)%q)
      end do
      reaction = packed(7*bodies + 1:)
   end subroutine unpack_poses

   !> Packs poses and reactions into one state.
   pure subroutine pack_poses(bodies, rows, poses, reaction, packed)
      integer, intent(in) :: bodies, rows
      type(pose_t), intent(in) :: poses(0:bodies)
      real(num), intent(in) :: reaction(rows)
      real(num), intent(inout) :: packed(7*bodies + rows)
      integer :: k

      do k = 1, bodies
         packed(7*k - 6:7*k - 4) = poses(k)%r
         packed(7*k - 3:7*k) = poses(k)%q
      end do
      packed(7*bodies + 1:) = reaction
   end subroutine pack_poses

   !> The largest squared distance of a body from its pose in a packed state [m²]. The distance is the distance of its reference
   !> point, or its rotation × characteristic length.
   pure function squared_distance(bodies, poses, packed, length) result(largest)
      integer, intent(in) :: bodies
      type(pose_t), intent(in) :: poses(0:bodies)
      real(num), intent(in) :: packed(*)
      real(num), intent(in) :: length                   !! m
      real(num) :: largest, dr(3), dq(4)
      integer :: k

      largest = 0.0_wp
      do k = 1, bodies
         dr = poses(k)%r - packed(7*k - 6:7*k - 4)
         dq = poses(k)%q - packed(7*k - 3:7*k)
         ! a quaternion turns by half the angle
         largest = max(largest, max(dr(1)**2 + dr(2)**2 + dr(3)**2, &
            (2.0_wp*length)**2*(dq(1)**2 + dq(2)**2 + dq(3)**2 + dq(4)**2)))
      end do
   end function squared_distance

   !> The motion of a body [m]: the larger of |Δr| and |Δπ| × characteristic length.
   pure function body_motion(twist, length) result(size)
      real(num), intent(in) :: twist(6), length
      real(num) :: size
      size = sqrt(max(twist(1)**2 + twist(2)**2 + twist(3)**2, length**2*(twist(4)**2 + twist(5)**2 + twist(6)**2)))
   end function body_motion

   !> The error of the trapezoidal rule as a share of the motion [-]; 0 if the error is within rounding, huge if the
   !> error is not finite.
   !> Equation (K.14) of docs/theory/kkt.md.
   pure function trapezoidal_rest(motion, tangent_a, tangent_b, width, length) result(rest)
      real(num), contiguous, intent(in) :: motion(:), tangent_a(:), tangent_b(:)
      real(wp), intent(in) :: width
      real(num), intent(in) :: length
      real(num) :: rest, twist(6), part, unlimited, least, whole, none
      integer :: k

      unlimited = huge(1.0_wp)
      least = nothing
      rest = 0.0_wp
      none = 0.0_wp
      do k = 1, size(motion), 6
         twist = motion(k:k + 5) - (0.5_wp*width)*(tangent_a(k:k + 5) + tangent_b(k:k + 5))
         part = body_motion(twist, length)
         rest = max(rest, merge(part, unlimited, part < unlimited))
      end do
      whole = max(largest_motion(motion, length), least)
      whole = merge(merge(rest, none, rest < unlimited)/whole, rest, rest < unlimited)
      rest = merge(whole, none, rest > least*smooth)
   end function trapezoidal_rest

   !> Computes guess ← Σ weight(j) × packed(:, slot(j)).
   !> Equation (K.12) of docs/theory/kkt.md.
   pure subroutine extrapolate(length, states, weight, slot, packed, guess)
      integer, intent(in) :: length, states
      real(num), intent(in) :: weight(states)
      integer, intent(in) :: slot(states)
      real(num), intent(in) :: packed(length, *)
      real(num), intent(inout) :: guess(length)
      integer :: j, k

      do k = 1, length
         guess(k) = weight(1)*packed(k, slot(1))
      end do
      do j = 2, states
         do k = 1, length
            guess(k) = guess(k) + weight(j)*packed(k, slot(j))
         end do
      end do
   end subroutine extrapolate

end module ek_motion
