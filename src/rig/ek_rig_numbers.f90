!> The rig of a case, and the numbers of the rig for one design after the other: the points of its heights and loads, the tyres on
!> its road, the range of the swept value.
!>
!> ek_rig creates the parts of a rig once, with their names; `set_rig_numbers` computes every number of these parts that a design
!> can change.
module ek_rig_numbers
   use ek_kinds, only: wp
   use ek_joint, only: joint_t, row_t, term_t
   use ek_measure, only: measure_t, global_gap
   use ek_suspension, only: suspension_t, load_t
   use ek_case, only: case_t, actuation_t, follows_tangent, follows_table
   use ek_grid, only: is_grid, grid_size, set_grid_values
   use ek_wheel_side, only: design_track
   implicit none(type, external)
   private
   public :: rig_t, height_t, acting_t, set_rig_numbers, copy_rig_numbers, up

   real(wp), parameter :: up(3) = [0.0_wp, 0.0_wp, 1.0_wp]

   !> The sum that a driver prescribes: Σ sign × height of wheels, in the order of the terms of its row.
   type :: height_t
      integer :: wheels(2) = 0                           !! indices of the wheels; 0: none
      real(wp) :: signs(2) = 0.0_wp
      logical :: is_at_centre = .false.                  !! height of the wheel centre; otherwise of the contact point
      logical :: is_road = .false.                       !! height of the road under the tyre at the contact point
   end type height_t

   !> The point of application of a load of the rig, and the force and moment of this load at the load factor 1.
   type :: acting_t
      integer :: wheel = 0
      logical :: is_at_patch = .false.                   !! at the contact point; otherwise at the wheel centre
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp  !! at the load factor 1 [N, N m]
      logical :: has_trail = .false.                     !! the offset of the case gives a moment
   end type acting_t

   !> Additions of a case to a suspension. The indices of joints, rows, terms and loads of the rig continue after the suspension.
   type :: rig_t
      type(joint_t), allocatable :: joints(:)            !! drivers of heights, one row each
      type(row_t), allocatable :: rows(:)
      type(term_t), allocatable :: terms(:)
      type(load_t), allocatable :: loads(:)
      type(height_t), allocatable :: heights(:)          !! height prescribed by each row
      type(acting_t), allocatable :: acting(:)           !! point and value of each load
      type(actuation_t), allocatable :: actuations(:)    !! actuations of loads and rows of the rig, and of those the case names
      logical :: is_table = .false.                      !! the rows of a table are the path of the case
      real(wp) :: from = 0.0_wp, to = 0.0_wp             !! swept values, SI
      integer :: increments = 0
      character(:), allocatable :: unit, place_name      !! unit and name of the swept value: 'mm', 'wheel travel'
   end type rig_t

contains

   !> Sets the numbers of a rig for a design of the suspension and of the case. Memory is allocated only for the first values of a
   !> grid.
   pure subroutine set_rig_numbers(suspension, case, rig)
      type(suspension_t), intent(in) :: suspension       !! completed, not on a rig
      type(case_t), intent(in) :: case
      type(rig_t), intent(inout) :: rig
      real(wp) :: arm(3)
      integer :: h, k, t, rows

      rig%from = case%from
      rig%to = case%to
      rig%increments = case%increments
      if (rig%is_table) then
         rows = case%table%rows
         if (is_grid(case)) rows = product(grid_size(case))
         rig%from = merge(0.0_wp, 1.0_wp, rows == 1)      ! from the design state, which is also reported
         rig%to = rows
         rig%increments = max(rows - 1, 1)
      end if
      t = 0
      do h = 1, size(rig%heights)
         associate (this => rig%heights(h), row => rig%rows(h), joint => rig%joints(h))
            row%compliance = 0.0_wp
            if (this%is_road) row%compliance = sum(this%signs(:row%terms)**2/suspension%wheels(this%wheels(:row%terms))%tyre_rate)
            do k = 1, row%terms
               t = t + 1
               associate (w => suspension%wheels(this%wheels(k)))
                  arm = w%contact
                  if (this%is_at_centre) arm = w%centre
                  rig%terms(t)%measure = measure_t(kind=global_gap, body_i=0, body_j=w%body, u=up, &
                     arm_i=suspension%bodies(w%body)%origin + arm, arm_j=arm)
               end associate
               rig%terms(t)%coefficient = this%signs(k)
               if (k == 1) joint%arm_j = arm
            end do
         end associate
      end do
      do k = 1, size(rig%acting)
         associate (this => rig%acting(k), load => rig%loads(k))
            load%arm = suspension%wheels(this%wheel)%centre
            if (this%is_at_patch) load%arm = suspension%wheels(this%wheel)%contact
            load%force = this%force
            load%moment = this%moment + merge(case%offset, 0.0_wp, this%has_trail)*up
         end associate
      end do
      do k = 1, size(rig%actuations)
         if (rig%actuations(k)%law == follows_tangent) rig%actuations(k)%share = design_track(suspension)
         if (rig%actuations(k)%law == follows_table .and. is_grid(case)) &
            call set_grid_values(case, rig%actuations(k)%drive == case%drive, rig%actuations(k)%values)
      end do
   end subroutine set_rig_numbers

   !> Copies the numbers of a rig to a suspension that is already on this rig.
   pure subroutine copy_rig_numbers(rig, suspension)
      type(rig_t), intent(in) :: rig
      type(suspension_t), intent(inout) :: suspension    !! of put_on
      integer :: joints, loads, k

      joints = size(suspension%joints) - size(rig%joints)
      loads = size(suspension%loads) - size(rig%loads)
      do k = 1, size(rig%joints)
         suspension%joints(joints + k)%arm_j = rig%joints(k)%arm_j
      end do
      suspension%rows(size(suspension%rows) - size(rig%rows) + 1:) = rig%rows
      suspension%terms(size(suspension%terms) - size(rig%terms) + 1:) = rig%terms
      do k = 1, size(rig%loads)
         suspension%loads(loads + k)%arm = rig%loads(k)%arm
         suspension%loads(loads + k)%force = rig%loads(k)%force
         suspension%loads(loads + k)%moment = rig%loads(k)%moment
      end do
   end subroutine copy_rig_numbers

end module ek_rig_numbers
