!> The loads of a manoeuvre on the rig: the forces of the road on the wheels, and the inertia of the masses (ek_manoeuvre). Also the
!> position of the steering.
module ek_manoeuvre_loads
   use ek_kinds, only: wp
   use ek_wheel_side, only: side_name
   use ek_suspension, only: suspension_t, load_t
   use ek_case, only: case_t, append_actuation, follows_table
   use ek_manoeuvre, only: vertical_column, lateral_column, brake_column, drive_column, obstacle_column, columns_of_side, &
      inertia_column, steer_column, has_sides
   use ek_rig_parts, only: rig_t, acting_t, add_load
   implicit none(type, external)
   private
   public :: load_wheel, load_masses, hold_steering

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp], right(3) = [0.0_wp, 1.0_wp, 0.0_wp], rear(3) = [1.0_wp, 0.0_wp, 0.0_wp]
   real(wp), parameter :: nothing(3) = 0.0_wp

contains

   !> Adds the forces of the road on a wheel in all manoeuvres of a case, in addition to the constant loads of the deck.
   pure subroutine load_wheel(suspension, case, wheel, side, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: wheel, side
      type(rig_t), intent(inout) :: rig

      call add(rig, vertical_column, 'vertical', .true., up)
      call add(rig, lateral_column, 'lateral', .true., right)
      call add(rig, brake_column, 'braking', .not. suspension%axle%brakes_at_centre, rear)
      call add(rig, drive_column, 'driving', suspension%axle%drives_at_patch, rear)
      if (any(case%manoeuvres%hits_obstacle)) call add(rig, obstacle_column, 'obstacle', .false., rear)

   contains

      !> Adds one force of the wheel.
      pure subroutine add(rig, column, name, is_at_patch, force)
         type(rig_t), intent(inout) :: rig
         integer, intent(in) :: column
         character(*), intent(in) :: name
         logical, intent(in) :: is_at_patch
         real(wp), intent(in) :: force(3)

         call add_load(rig, suspension, case, trim(side_name(side))//'_'//name, acting_t(wheel, is_at_patch, force, nothing), &
            1.0_wp, follows_table)
         rig%actuations(size(rig%actuations))%column = columns_of_side*(side - 1) + column
      end subroutine add

   end subroutine load_wheel

   !> Adds the inertia of the masses in all manoeuvres of a case: one actuation for each direction, with one load for each mass. If
   !> the two sides of the car have different accelerations, each side has its own actuations and loads.
   pure subroutine load_masses(suspension, case, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig
      integer :: side

      if (.not. any(suspension%bodies%mass > 0.0_wp)) return
      if (.not. has_sides(case)) call load_masses_of(suspension, case, 0, 'rig_inertia_', rig)
      do side = 1, merge(2, 0, has_sides(case))
         call load_masses_of(suspension, case, side, 'rig_'//trim(side_name(side))//'_inertia_', rig)
      end do
   end subroutine load_masses

   !> Adds the inertia of the shares of the masses on a side; for side 0, of the masses.
   pure subroutine load_masses_of(suspension, case, side, prefix, rig)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      integer, intent(in) :: side
      character(*), intent(in) :: prefix               !! of the names of the loads
      type(rig_t), intent(inout) :: rig
      real(wp), parameter :: directions(3, 3) = reshape([rear, right, up], [3, 3])
      character(*), parameter :: letters = 'xyz'
      type(load_t) :: load
      integer :: c, k, n

      do c = 1, 3
         n = 0
         do k = 1, size(suspension%bodies)
            if (.not. suspension%bodies(k)%mass > 0.0_wp) cycle
            n = n + 1
            load%name = prefix//letters(c:c)//' of '//suspension%bodies(k)%name
            load%where = case%where
            load%body = k
            load%is_case = .true.
            load%is_weight = .true.
            rig%loads = [rig%loads, load]
            rig%acting = [rig%acting, acting_t(force=directions(:, c), mass=k, side=side)]
            if (n == 1) call append_actuation(rig%actuations, load%name, '', 1.0_wp, follows_table)
         end do
         rig%actuations(size(rig%actuations))%loads = n
         rig%actuations(size(rig%actuations))%column = inertia_column(c, side)
      end do
   end subroutine load_masses_of

   !> Adds the position of the steering driver, if a manoeuvre of the case gives it.
   pure subroutine hold_steering(case, rig)
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig
      integer :: k

      do k = 1, size(case%manoeuvres)
         if (.not. allocated(case%manoeuvres(k)%driver)) cycle
         call append_actuation(rig%actuations, '', case%manoeuvres(k)%driver, 1.0_wp, follows_table)
         rig%actuations(size(rig%actuations))%column = steer_column
         return
      end do
   end subroutine hold_steering

end module ek_manoeuvre_loads
