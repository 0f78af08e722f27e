!> Wheels whose height nothing carries: a deck of points and links without springs.
!>
!> The height h of a wheel is free if a motion of the bodies changes h, but no joint and no elastic part. With the gradients a of
!> all rows of Φ and g of all laws with a slope at design, this holds if the gradient of h is not a linear combination of the a and
!> g. The size of a rate has no influence. Steering drivers count as rows.
!>
!> A wheel that is free without the stiffness of bushings about their axes rests on bushings alone: the deck has no spring, and what
!> depends on a rate depends on the spring that is missing.
!>
!> The gradients are made orthogonal one after the other, twice each (Gram-Schmidt). A remainder below 1e-9 of a gradient is
!> rounding.
module ek_free_wheels
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, evaluation_t, evaluate
   use ek_wheel_contact, only: height_measure
   use ek_relative_rotation, only: pose_t
   use ek_element, only: element_kinds, torsion_spring, bushing_element
   use ek_element_part, only: element_part_t, count_parts, take_apart
   use ek_suspension, only: suspension_t, design_poses
   implicit none(type, external)
   private
   public :: find_free_wheels, is_rigid, has_spring, has_rates, unsprung_wheels

   real(wp), parameter :: length = 0.3_wp           !! m: a rotation counts as the displacement at this radius
   real(wp), parameter :: rounding = 1.0e-9_wp      !! share of a gradient
   integer, parameter :: most = 600                 !! unknowns: the cost grows with their cube, and no axle has more

   !> Orthonormal directions in the space of all motions.
   type :: span_t
      integer :: used = 0
      real(wp), allocatable :: basis(:, :)          !! (unknown, direction)
   end type span_t

contains

   !> Counts the wheels whose height is free at design, and, if there is none and no spring, those that rest on bushings alone. A
   !> model with more than 100 bodies is not examined.
   subroutine find_free_wheels(suspension)
      type(suspension_t), intent(inout) :: suspension      !! completed

      suspension%free_wheels = count_free_wheels(suspension, .true.)
      suspension%bushed_wheels = 0
      if (suspension%free_wheels == 0 .and. .not. has_spring(suspension)) &
         suspension%bushed_wheels = count_free_wheels(suspension, .false.)
   end subroutine find_free_wheels

   !> Whether the model has a spring that carries the car: a spring, or a torsion spring that acts against the chassis.
   pure logical function has_spring(suspension)
      type(suspension_t), intent(in) :: suspension

      associate (e => suspension%elements)
         has_spring = any(element_kinds(e%kind)%carries .or. &
            (e%kind == torsion_spring .and. min(e%measure%body_i, e%measure%body_j) == 0))
      end associate
   end function has_spring

   !> Whether the columns that depend on the rate of the wheels have values.
   pure logical function has_rates(suspension)
      type(suspension_t), intent(in) :: suspension
      has_rates = unsprung_wheels(suspension) == 0
   end function has_rates

   !> The number of wheels that need a spring: nothing carries them, or bushings alone.
   pure integer function unsprung_wheels(suspension)
      type(suspension_t), intent(in) :: suspension
      unsprung_wheels = suspension%free_wheels + suspension%bushed_wheels
   end function unsprung_wheels

   !> The number of wheels whose height is free at design. 0 for a model with more than 100 bodies, which is not examined.
   function count_free_wheels(suspension, has_twist) result(free)
      type(suspension_t), intent(in) :: suspension         !! completed
      logical, intent(in) :: has_twist                     !! .false.: without the stiffness of bushings about their axes
      integer :: free
      type(span_t) :: span
      type(pose_t) :: poses(size(suspension%bodies) + 1)
      type(evaluation_t) :: evaluation
      type(element_part_t) :: parts(6)
      type(measure_t) :: height
      real(wp) :: row(6*size(suspension%bodies))
      logical :: is_new
      integer :: k, t, p

      free = 0
      if (size(suspension%wheels) == 0 .or. size(row) > most) return
      poses = design_poses(suspension)
      allocate (span%basis(size(row), size(row)))
      do k = 1, size(suspension%rows)
         row = 0.0_wp
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (m => suspension%terms(t)%measure)
               call evaluate(m, poses(m%body_i + 1), poses(m%body_j + 1), evaluation)
               call add(suspension%terms(t)%coefficient, evaluation%gradient, m%body_i, m%body_j, row)
            end associate
         end do
         call include(row, span, is_new)
      end do
      do k = 1, size(suspension%elements)
         associate (e => suspension%elements(k), m => suspension%elements(k)%measure)
            call take_apart(e, poses(m%body_i + 1), poses(m%body_j + 1), parts)
            do p = 1, merge(3, count_parts(e), e%kind == bushing_element .and. .not. has_twist)
               if (.not. abs(parts(p)%slope) > 0.0_wp) cycle
               row = 0.0_wp
               call add(1.0_wp, parts(p)%gradient, m%body_i, m%body_j, row)
               call include(row, span, is_new)
            end do
         end associate
      end do
      do k = 1, size(suspension%wheels)
         associate (w => suspension%wheels(k))
            height = height_measure(suspension, k, .true.)
            call evaluate(height, poses(1), poses(w%body + 1), evaluation)
            row = 0.0_wp
            call add(1.0_wp, evaluation%gradient, 0, w%body, row)
            call include(row, span, is_new)
            if (is_new) free = free + 1
         end associate
      end do
   end function count_free_wheels

   !> Whether the joints and the rig leave no motion, so that no force deforms the model: every motion follows from the rig alone.
   pure logical function is_rigid(suspension)
      type(suspension_t), intent(in) :: suspension         !! on a rig that can be solved
      is_rigid = suspension%unknowns() == suspension%constraints() .and. &
         .not. any(suspension%rows(:suspension%own_rows())%compliance > 0.0_wp)
   end function is_rigid

   !> Adds the gradient of a measure of two bodies to a row over all unknowns; rotations count at a radius of `length`.
   pure subroutine add(coefficient, gradient, body_i, body_j, row)
      real(wp), intent(in) :: coefficient, gradient(12)
      integer, intent(in) :: body_i, body_j                !! 0: the chassis
      real(wp), intent(inout) :: row(:)
      real(wp), parameter :: unit(6) = [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp/length, 1.0_wp/length, 1.0_wp/length]

      if (body_i > 0) row(6*body_i - 5:6*body_i) = row(6*body_i - 5:6*body_i) + coefficient*unit*gradient(:6)
      if (body_j > 0) row(6*body_j - 5:6*body_j) = row(6*body_j - 5:6*body_j) + coefficient*unit*gradient(7:)
   end subroutine add

   !> Includes a row in the span, unless the row is a linear combination of the directions that the span has.
   pure subroutine include(row, span, is_new)
      real(wp), intent(inout) :: row(:)                    !! on return, its remainder
      type(span_t), intent(inout) :: span
      logical, intent(out) :: is_new
      real(wp) :: size_of_row, rest
      integer :: pass, k

      size_of_row = norm2(row)
      is_new = .false.
      if (span%used == size(row)) return
      do pass = 1, 2
         do k = 1, span%used
            row = row - dot_product(span%basis(:, k), row)*span%basis(:, k)
         end do
      end do
      rest = norm2(row)
      is_new = rest > rounding*size_of_row
      if (.not. is_new) return
      span%used = span%used + 1
      span%basis(:, span%used) = row/rest
   end subroutine include

end module ek_free_wheels
