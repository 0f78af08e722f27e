!> The parts of a rig: its drivers of heights, its loads, and their actuations. ek_rig makes the rig of a case from them.
module ek_rig_parts
   use ek_kinds, only: wp
   use ek_joint, only: joint_t, row_t, term_t, joint_kinds
   use ek_suspension, only: suspension_t, load_t
   use ek_case, only: case_t, append_actuation, actuation_t
   implicit none(type, external)
   private
   public :: rig_t, acting_t, new_rig, add_height, add_load

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
      integer :: mass = 0                                !! index of a body: its mass times the force acts at its centre of gravity;
                                                         !! 0: the load acts on a wheel
      integer :: side = 0                                !! of a mass: only its share on the left (1) or on the right (2)
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

   !> A rig without rows and loads.
   pure type(rig_t) function new_rig() result(rig)
      allocate (rig%joints(0), rig%rows(0), rig%terms(0), rig%loads(0), rig%heights(0), rig%acting(0), rig%actuations(0))
      rig%unit = '-'
      rig%place_name = ''
   end function new_rig

   !> Adds a driver of Σ sign × height relative to the vehicle body, with the heights of wheel centres, of contact points, or of the
   !> road under the tyres. The value of the driver is the change from design [m]. The tyres on the road deflect under the loads at
   !> the contact points, so that Σ sign × height = value + λ Σ sign²/rate.
   pure subroutine add_height(rig, suspension, name, where, wheels, signs, control)
      type(rig_t), intent(inout) :: rig        !! the numbers of the rig are set later (set_rig_numbers)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name, where
      integer, intent(in) :: wheels(:)
      real(wp), intent(in) :: signs(:)         !! one per wheel
      character(*), intent(in) :: control      !! 'centre', 'patch' or 'road'
      type(joint_t) :: joint
      type(height_t) :: height
      type(term_t) :: term
      integer :: k

      height%wheels(:size(wheels)) = wheels
      height%signs(:size(wheels)) = signs
      height%is_at_centre = control == 'centre'
      height%is_road = control == 'road'
      rig%heights = [rig%heights, height]
      joint%name = name
      joint%where = where
      joint%kind = 'driver'
      joint%number = findloc(joint_kinds, 'driver', dim=1)
      joint%body_j = suspension%wheels(wheels(1))%body
      joint%first_row = size(suspension%rows) + size(rig%rows) + 1
      joint%rows = 1
      joint%is_of_measures = .true.
      rig%rows = [rig%rows, row_t(first=size(suspension%terms) + size(rig%terms) + 1, terms=size(wheels), &
         joint=size(suspension%joints) + size(rig%joints) + 1, is_driver=.true.)]
      rig%terms = [rig%terms, [(term, k=1, size(wheels))]]
      rig%joints = [rig%joints, joint]
   end subroutine add_height

   !> Adds a load 'rig_<name>' on a wheel, and the actuation that scales it.
   pure subroutine add_load(rig, suspension, case, name, acting, share, law, values)
      type(rig_t), intent(inout) :: rig
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      character(*), intent(in) :: name
      type(acting_t), intent(in) :: acting
      real(wp), intent(in) :: share
      integer, intent(in) :: law
      real(wp), intent(in), optional :: values(:)
      type(load_t) :: load

      load%name = 'rig_'//name
      load%where = case%where
      load%body = suspension%wheels(acting%wheel)%body
      load%is_case = .true.
      rig%loads = [rig%loads, load]
      rig%acting = [rig%acting, acting]
      call append_actuation(rig%actuations, load%name, '', share, law, values)
   end subroutine add_load

end module ek_rig_parts
