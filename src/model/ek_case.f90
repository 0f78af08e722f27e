!> A load case: something is driven from one place to another in increments.
module ek_case
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: case_t, course_t, append_course, method_names, default_tolerance, most_increments
   public :: follow_names, follows_place, follows_tangent, follows_table

   character(*), parameter :: method_names(3) = [character(11) :: 'recursive', 'corrected', 'equilibrium']
   character(*), parameter :: follow_names(2) = [character(6) :: 'factor', 'arc']
   integer, parameter :: most_increments = 1000000   !! a state takes about 3 kB on its way to the file
   real(wp), parameter :: default_tolerance = 1.0e-10_wp   !! m, that is 1e-7 mm

   integer, parameter :: follows_place = 1     !! share × place
   integer, parameter :: follows_tangent = 2   !! share × tan(place): heights of an axle that rolls
   integer, parameter :: follows_table = 3     !! the value in row `place` of a table

   !> How one load or one driver follows the place on the path. One of `load` and `drive` is empty.
   type :: course_t
      character(:), allocatable :: load       !! name of the load that is scaled
      character(:), allocatable :: drive      !! name of the driver joint
      integer :: law = follows_place
      real(wp) :: share = 1.0_wp
      real(wp), allocatable :: values(:)      !! of follows_table, SI
   end type course_t

   !> What the deck says of a case, SI. Without a `test` either `load` or `drive` is not empty.
   type :: case_t
      character(:), allocatable :: name, where
      character(:), allocatable :: load     !! name of the load scaled by the case
      character(:), allocatable :: drive    !! 'wheel_travel', or the name of a driver joint
      integer :: wheel = 1                  !! whose travel is driven
      real(wp) :: from = 0.0_wp, to = 0.0_wp   !! places: factor of the load [-], or change of the driven value [m, rad]
      integer :: increments = 100
      character(:), allocatable :: method   !! one of method_names
      logical :: follows_arc = .false.      !! states at equal distances along the path, which may turn back; else at equal places
      real(wp) :: tolerance = default_tolerance   !! last Newton correction of a state, at most [m]
      ! a test of the rig, see ek_rig
      character(:), allocatable :: test     !! its name; not allocated or empty: none
      character(:), allocatable :: vertical !! what holds the wheels: 'centre', 'patch', 'road', 'force', or '' for the test's own
      logical :: is_anti = .false.          !! the right wheel is loaded the other way
      real(wp) :: offset = 0.0_wp           !! trail of a lateral force behind the patch [m]
      character(:), allocatable :: file     !! of a table of loads
      character(:), allocatable :: target   !! 'column=value', '' for none
      logical :: is_good = .true.           !! .false.: the deck has a mistake in it, and it cannot be put on the rig
      logical :: has_all = .false.          !! the compliance matrix and all it gives, at every state
      ! what the case drives, once it stands on the rig; not allocated: `load` or `drive` alone
      type(course_t), allocatable :: courses(:)
      real(wp) :: unit = 1.0_wp             !! SI value of a place's unit
      character(:), allocatable :: unit_name, place_name   !! 'mm', 'wheel travel'
   end type case_t

contains

   !> One more thing that a case drives: a load, or a driver joint; the other name is empty.
   pure subroutine append_course(courses, load, drive, share, law, values)
      type(course_t), allocatable, intent(inout) :: courses(:)
      character(*), intent(in) :: load, drive
      real(wp), intent(in) :: share
      integer, intent(in) :: law
      real(wp), intent(in), optional :: values(:)      !! of follows_table, SI
      type(course_t), allocatable :: more(:)
      integer :: n

      n = 0
      if (allocated(courses)) n = size(courses)
      allocate (more(n + 1))
      if (n > 0) more(:n) = courses
      more(n + 1)%load = load
      more(n + 1)%drive = drive
      more(n + 1)%share = share
      more(n + 1)%law = law
      if (present(values)) more(n + 1)%values = values
      call move_alloc(more, courses)
   end subroutine append_course

end module ek_case
