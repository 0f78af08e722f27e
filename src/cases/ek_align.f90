!> &align: finds the values of adjusters with which the wheels have given static angles.
!>
!> In the start state of the tests (ek_start), toe and camber of a wheel are functions of the values v of its adjusters through the
!> closure of the joints. Newton's method solves angle(v) = target for all wheels together; the derivatives
!> are quotients of differences over 1 µm, which is sufficient because each iteration repeats them until the angles are met.
module ek_align
   use ek_kinds, only: wp
   use ek_lapack_routines, only: dgesv
   use ek_adjust, only: adjust
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_balance, only: balance_failure_t, not_aligned
   use ek_suspension, only: suspension_t, copy_numbers
   use ek_state, only: state_t
   use ek_start, only: start_space_t, find_start, hold
   implicit none(type, external)
   private
   public :: align_space_t, find_alignment

   integer, parameter :: max_iterations = 12
   real(wp), parameter :: enough = 1.0e-14_wp        !! rad: no further iteration
   real(wp), parameter :: met = 1.7e-11_wp           !! rad, 1e-9 deg: the angles are met
   real(wp), parameter :: step = 1.0e-6_wp           !! m: step of the differences
   real(wp), parameter :: tight = 1.0e-13_wp         !! m: tolerance of the held states

   !> Work space, for one design of a model after the other.
   type :: align_space_t
      private
      type(suspension_t) :: drawn                    !! with trimmed preloads, adjusters not set
      type(suspension_t) :: trial
      type(start_space_t) :: start, held             !! two, as the rigs of a start state and of held wheels differ
   end type align_space_t

contains

   !> Sets all adjusters of a suspension: those of &align so that the static angles of the wheels are met. Without a solution, the
   !> adjusters keep the values of the deck, and `failure` has the reason.
   subroutine find_alignment(suspension, space, failure, iterations)
      type(suspension_t), intent(inout) :: suspension      !! with trimmed preloads, adjusters not set; on no rig
      type(align_space_t), intent(inout) :: space
      type(balance_failure_t), intent(inout) :: failure
      integer, intent(out), optional :: iterations         !! number of corrections of the values
      real(wp), allocatable :: values(:), target(:), angles(:), moved(:), jacobian(:, :), change(:)
      integer, allocatable :: adjusters(:), pivots(:)
      real(wp) :: worst, before
      integer :: iteration, k, info
      logical :: is_found

      if (present(iterations)) iterations = 0
      call list_unknowns(suspension, adjusters, target)
      if (allocated(space%drawn%bodies)) then
         call copy_numbers(suspension, space%drawn)
      else
         space%drawn = suspension
         space%trial = suspension
      end if
      values = suspension%adjusters(adjusters)%value
      allocate (angles(size(values)), moved(size(values)), jacobian(size(values), size(values)), pivots(size(values)), &
         change(size(values)))
      worst = 0.0_wp
      before = huge(before)
      failure%reason = not_aligned
      do iteration = 1, max_iterations
         call find_angles(adjusters, values, space, angles, is_found)
         if (.not. is_found) exit
         worst = maxval(abs(angles - target))
         if (worst <= enough .or. (worst <= met .and. .not. worst < 0.5_wp*before)) then
            failure%reason = 0
            exit
         end if
         before = worst
         do k = 1, size(values)
            values(k) = values(k) + step
            call find_angles(adjusters, values, space, moved, is_found)
            values(k) = values(k) - step
            if (.not. is_found) return
            jacobian(:, k) = (moved - angles)/step
         end do
         change(:) = target - angles
         call dgesv(size(values), 1, jacobian, size(values), pivots, change, size(values), info)
         failure%adjuster = 0
         if (info /= 0 .or. .not. maxval(abs(change)) < 1.0_wp) exit      ! the adjusters do not move the angles independently
         failure%needed = 0.0_wp
         if (present(iterations)) iterations = iteration
         do k = 1, size(values)
            values(k) = values(k) + change(k)
            associate (this => suspension%adjusters(adjusters(k)))
               if (values(k) >= this%low .and. values(k) <= this%high) cycle
               if (failure%adjuster == 0) then
                  failure%adjuster = adjusters(k)
                  failure%needed = values(k)
               end if
               values(k) = min(max(values(k), this%low), this%high)
            end associate
         end do
      end do
      if (failure%reason == 0) then
         if (any(values < suspension%adjusters(adjusters)%low) .or. any(values > suspension%adjusters(adjusters)%high)) &
            failure%reason = not_aligned
      end if
      failure%worst_angle = worst
      if (failure%reason == 0) suspension%adjusters(adjusters)%value = values
      call adjust(suspension)
   end subroutine find_alignment

   !> Lists the adjusters of all &align, and the angle that each of them has to meet.
   pure subroutine list_unknowns(suspension, adjusters, target)
      type(suspension_t), intent(in) :: suspension
      integer, allocatable, intent(out) :: adjusters(:)
      real(wp), allocatable, intent(out) :: target(:)      !! rad
      integer :: k

      allocate (adjusters(0), target(0))
      do k = 1, size(suspension%aligns)
         associate (this => suspension%aligns(k))
            adjusters = [adjusters, this%adjusters(:this%angles)]
            if (this%has_toe) target = [target, this%toe]
            if (this%has_camber) target = [target, this%camber]
         end associate
      end do
   end subroutine list_unknowns

   !> Finds the angles of all &align in the start state of the tests.
   subroutine find_angles(adjusters, values, space, angles, is_found)
      integer, intent(in) :: adjusters(:)
      real(wp), intent(in) :: values(:)
      type(align_space_t), intent(inout) :: space
      real(wp), intent(out) :: angles(:)                   !! rad
      logical, intent(out) :: is_found
      type(state_t) :: state
      type(attitude_t) :: now
      integer :: k, used

      angles = 0.0_wp
      call copy_numbers(space%drawn, space%trial)
      space%trial%adjusters(adjusters)%value = values
      call adjust(space%trial)
      call find_start(space%trial, tight, space%start, is_found)      ! without a start state: design height
      call hold(space%trial, tight, space%held, state, is_found)
      if (.not. is_found) return
      used = 0
      do k = 1, size(space%trial%aligns)
         associate (this => space%trial%aligns(k))
            now = wheel_attitude(space%trial, state, this%wheel)
            if (this%has_toe) call include(now%toe)
            if (this%has_camber) call include(now%camber)
         end associate
      end do

   contains

      subroutine include(angle)
         real(wp), intent(in) :: angle
         used = used + 1
         angles(used) = angle
      end subroutine include

   end subroutine find_angles

end module ek_align
