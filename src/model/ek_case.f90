!> A load case: a load or a driven value changes from one value to another in increments.
module ek_case
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   implicit none(type, external)
   private
   public :: add_place, add_window, copy_places
   public :: case_t, actuation_t, table_column_t, load_table_t, append_actuation, scales_loads, is_mountable, prefer_plan, &
      copy_case_numbers, method_names, solver_names, manoeuvre_t, &
      row_name
   public :: default_tolerance, max_increments, max_driven
   public :: follow_names, follows_place, follows_tangent, follows_table

   character(*), parameter :: method_names(3) = [character(11) :: 'recursive', 'corrected', 'equilibrium']
   character(*), parameter :: follow_names(2) = [character(6) :: 'factor', 'arc']
   character(*), parameter :: solver_names(3) = [character(6) :: 'lapack', 'sparse', 'plan']    !! see ek_kkt; 'plan' is an alias
   integer, parameter :: max_increments = 1000000   !! largest number of increments; a state needs about 3 kB
   integer, parameter :: max_driven = 24   !! largest number of loads, and of rows, that one case may drive: nine loads per wheel
                                           !! and a few more
   real(wp), parameter :: default_tolerance = 1.0e-10_wp   !! default of case_t%tolerance [m]: 1e-7 mm

   integer, parameter :: follows_place = 1     !! share × swept value
   integer, parameter :: follows_tangent = 2   !! share × tan(swept value): heights of a rolling axle
   integer, parameter :: follows_table = 3     !! value in a row of a table; the swept value is the index of the row

   !> The actuation of one load or one driver over the swept value. One of `load` and `drive` is empty.
   type :: actuation_t
      character(:), allocatable :: load       !! name of the load that is scaled
      character(:), allocatable :: drive      !! name of the driver joint
      integer :: law = follows_place
      real(wp) :: share = 1.0_wp
      real(wp), allocatable :: values(:)      !! values of the table [SI], for follows_table
      integer :: loads = 1                    !! number of consecutive loads, from `load` on, with this actuation
      integer :: column = 0                   !! quantity of a manoeuvre, see ek_manoeuvre; 0: none
   end type actuation_t

   !> A column of a load table: a load or a height of a wheel, or the value of a driver joint, in every row.
   type :: table_column_t
      character(:), allocatable :: name       !! column heading; for a driver joint, the name of the joint
      integer :: wheel = 0                    !! index of the wheel; 0: a driver joint of the deck
      integer :: component = 0                !! 1–3 force and 4–6 moment at the contact point, 7–9 force at the centre; 0: a height
      real(wp), allocatable :: values(:)      !! value in each row [N, N m, m or rad]
   end type table_column_t

   !> A load table as read with the deck. The table has no rows if it has errors or if its file cannot be read.
   type :: load_table_t
      integer :: rows = 0
      type(table_column_t), allocatable :: columns(:)
      type(message_list_t) :: mistakes        !! all errors of the table, with their lines
      character(:), allocatable :: fault      !! reason why the file cannot be read, for the message when the case is run
      type(message_list_t) :: names           !! name of each row; empty: the rows have no names
   end type load_table_t

   !> A manoeuvre of the car, given by the load factor and the accelerations of the car. With a side, the three numbers are forces
   !> on the wheel of this side per load of the wheel when the car stands.
   type :: manoeuvre_t
      character(:), allocatable :: name, where
      real(wp) :: vertical = 1.0_wp        !! load factor: vertical force of the road per weight; 1 when the car stands [-]
      real(wp) :: longitudinal = 0.0_wp    !! acceleration per standard gravity, positive forward [-]
      real(wp) :: lateral = 0.0_wp         !! acceleration per standard gravity, positive to the left [-]
      logical :: is_braked = .false.       !! the brakes give the longitudinal force; otherwise the drive
      logical :: hits_obstacle = .false.   !! an obstacle gives the longitudinal force, which acts at the wheel centre
      integer :: side = 0                  !! 1 left, 2 right: only this wheel is loaded, the other one stands; 0: the car is loaded
      logical :: has_wheels = .false.      !! each wheel has its own load factor, in place of `vertical`
      real(wp) :: wheels(2) = 1.0_wp       !! load factors of the left and of the right wheel [-]
      real(wp) :: downforce = 0.0_wp       !! aerodynamic force on the axle, positive downward [N]
      character(:), allocatable :: driver  !! steering driver that the manoeuvre holds; not allocated: none
      real(wp) :: steer = 0.0_wp           !! change of the value of this driver from design [m, rad]
   end type manoeuvre_t

   !> A case as given in the deck, in SI. Without a `test`, either `load` or `drive` is not empty.
   type :: case_t
      character(:), allocatable :: name, where
      character(:), allocatable :: load     !! name of the load scaled by the case
      character(:), allocatable :: drive    !! 'wheel_travel', or the name of a driver joint
      integer :: wheel = 1                  !! index of the wheel whose travel is driven
      real(wp) :: from = 0.0_wp, to = 0.0_wp   !! swept values: factor of the load [-], or change of the driven value [m, rad]
      integer :: increments = 100
      real(wp) :: steer_from = 0.0_wp, steer_to = 0.0_wp   !! changes of the steering driver in a grid [m, rad]
      integer :: steer_increments = 12
      character(:), allocatable :: method   !! one of method_names
      logical :: uses_plan = .false.        !! solver 'sparse': factorises by a plan of elimination; else by LAPACK
      logical :: says_solver = .false.      !! the deck or the command line gives the solver
      logical :: follows_arc = .false.      !! states at equal distances along the path; else at equal swept values
      real(wp) :: tolerance = default_tolerance   !! largest last Newton correction of a state [m]
      ! a test of the rig, see ek_rig
      character(:), allocatable :: test     !! name of the test; not allocated or empty: none
      character(:), allocatable :: vertical !! how wheels are held: 'centre', 'patch', 'road', 'force'; '': default of the test
      logical :: is_anti = .false.          !! anti-phase: the load on the right wheel is reversed
      real(wp) :: offset = 0.0_wp           !! trail of a lateral force aft of the contact point [m]
      character(:), allocatable :: file     !! name of the file of a load table
      type(load_table_t) :: table           !! content of this file
      type(manoeuvre_t), allocatable :: manoeuvres(:)   !! rows of test 'manoeuvres'
      logical :: holds_springs = .false.    !! the springs keep their lengths at design, see ek_held_springs
      character(:), allocatable :: target   !! target 'column=value'; '' without a target
      logical :: is_good = .true.           !! .false.: the case has an error and cannot be mounted on the rig
      logical :: has_all = .false.          !! the compliance matrix and the quantities derived from it are written at every state
      ! where numbers are read: the path stops there, too (ek_path_states)
      real(wp), allocatable :: places(:)      !! swept values, in the unit of the swept value
      real(wp), allocatable :: windows(:, :)  !! (centre and half width, window) of slopes, in the unit of the swept value
      ! of a case on the rig, see ek_rig; not allocated in the deck, except for a case that names several loads
      type(actuation_t), allocatable :: actuations(:)
      real(wp) :: unit = 1.0_wp             !! SI value of the unit of the swept value
      character(:), allocatable :: unit_name, place_name   !! unit and name of the swept value, such as 'mm', 'wheel travel'
   end type case_t

contains

   !> Whether a case can be put on the rig, which requires that the table named by the case was read.
   pure logical function is_mountable(case)
      type(case_t), intent(in) :: case

      is_mountable = .true.
      if (allocated(case%test)) is_mountable = case%test /= 'table' .or. case%table%rows > 0
   end function is_mountable

   !> Name of a row of a load table, or of a manoeuvre; 'design' for row 0. '' for a case whose rows have no names.
   pure function row_name(case, row) result(name)
      type(case_t), intent(in) :: case
      integer, intent(in) :: row
      character(:), allocatable :: name

      name = ''
      if (allocated(case%manoeuvres)) then
         if (row > 0) name = case%manoeuvres(row)%name
      else if (case%table%names%count() > 0) then
         if (row > 0) name = case%table%names%line(row)
      else
         return
      end if
      if (row == 0) name = 'design'
   end function row_name

   !> Selects the plan of elimination if neither deck nor command line gives a solver. Used for many designs of one deck.
   elemental subroutine prefer_plan(case)
      type(case_t), intent(inout) :: case
      if (.not. case%says_solver) case%uses_plan = .true.
   end subroutine prefer_plan

   !> Copies the numbers of a case to the case of another design, without allocation. If the other case is empty, the complete case
   !> is copied. Places of readings are copied if the first case has some.
   pure subroutine copy_case_numbers(from, to)
      type(case_t), intent(in) :: from
      type(case_t), intent(inout) :: to
      integer :: k

      if (.not. allocated(to%name)) then
         to = from
         return
      end if
      to%from = from%from
      to%to = from%to
      to%increments = from%increments
      to%steer_from = from%steer_from
      to%steer_to = from%steer_to
      to%steer_increments = from%steer_increments
      to%tolerance = from%tolerance
      to%offset = from%offset
      to%has_all = from%has_all
      call copy_places(from, to)
      if (.not. allocated(from%manoeuvres)) return
      do k = 1, size(from%manoeuvres)
         associate (this => to%manoeuvres(k), other => from%manoeuvres(k))
            this%vertical = other%vertical
            this%longitudinal = other%longitudinal
            this%lateral = other%lateral
            this%wheels = other%wheels
            this%downforce = other%downforce
            this%steer = other%steer
         end associate
      end do
   end subroutine copy_case_numbers

   !> Copies the places of readings from a case that has some.
   pure subroutine copy_places(from, to)
      type(case_t), intent(in) :: from
      type(case_t), intent(inout) :: to

      if (allocated(from%places)) to%places = from%places
      if (allocated(from%windows)) to%windows = from%windows
   end subroutine copy_places

   !> Adds a swept value at which a number is read.
   pure subroutine add_place(place, case)
      real(wp), intent(in) :: place            !! in the unit of the swept value
      type(case_t), intent(inout) :: case

      if (.not. allocated(case%places)) allocate (case%places(0))
      if (any(abs(case%places - place) <= 0.0_wp)) return
      case%places = [case%places, place]
   end subroutine add_place

   !> Adds a window over which a slope is read.
   pure subroutine add_window(centre, half, case)
      real(wp), intent(in) :: centre, half     !! middle and half width, in the unit of the swept value
      type(case_t), intent(inout) :: case
      integer :: k

      if (.not. allocated(case%windows)) allocate (case%windows(2, 0))
      do k = 1, size(case%windows, 2)
         if (all(abs(case%windows(:, k) - [centre, half]) <= 0.0_wp)) return
      end do
      case%windows = reshape([case%windows, centre, half], [2, size(case%windows, 2) + 1])
   end subroutine add_window

   !> Whether a case on the rig scales loads.
   pure logical function scales_loads(case)
      type(case_t), intent(in) :: case
      integer :: k
      scales_loads = any([(len(case%actuations(k)%load) > 0, k=1, size(case%actuations))])
   end function scales_loads

   !> Adds an actuation of a load or of a driver joint to a case. The other of the two names is empty.
   pure subroutine append_actuation(actuations, load, drive, share, law, values)
      type(actuation_t), allocatable, intent(inout) :: actuations(:)
      character(*), intent(in) :: load, drive
      real(wp), intent(in) :: share
      integer, intent(in) :: law
      real(wp), intent(in), optional :: values(:)      !! of follows_table, SI
      type(actuation_t) :: new

      new%load = load
      new%drive = drive
      new%share = share
      new%law = law
      if (present(values)) new%values = values
      if (.not. allocated(actuations)) allocate (actuations(0))
      actuations = [actuations, new]
   end subroutine append_actuation

end module ek_case
