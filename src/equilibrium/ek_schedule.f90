!> The inputs of a case along its path: the indices of loads and rows, and their values.
!>
!> The path coordinate (`place`) is one number, the swept value: the factor of a load, the travel of a wheel, the roll angle,
!> or the row of a table. Each actuation of a case is a function of the swept value.
module ek_schedule
   use ek_kinds, only: wp
   use ek_case, only: max_driven, case_t, follows_place, follows_tangent, follows_table
   use ek_suspension, only: suspension_t, driver_row, load_number
   use ek_state, only: inputs_t
   implicit none(type, external)
   private
   public :: schedule_t, new_schedule, make_schedule, inputs_at, same_schedule

   !> An actuation with indices instead of names.
   type :: actuator_t
      integer :: law = 0                      !! follows_place, follows_tangent or follows_table (ek_case)
      real(wp) :: share = 1.0_wp
      real(wp), allocatable :: values(:)      !! values of the table [SI], for follows_table
   end type actuator_t

   !> The actuations of a case, with their names resolved.
   type :: schedule_t
      integer :: loads = 0, rows = 0
      logical :: is_settling = .false.  !! no case: the swept value is the share of the imbalance at design that acts
      integer :: rest = 0               !! table row at which all inputs count as zero: the next row is reached from there
      integer :: load(max_driven) = 0, row(max_driven) = 0     !! indices of the loads and rows in the suspension
      integer :: further(max_driven) = 0   !! number of loads after the load of each actuator that it scales, too
      type(actuator_t), allocatable :: load_actuator(:), row_actuator(:)
   end type schedule_t

contains

   !> The schedule of a case, with the names of its actuations resolved. The suspension must already contain all loads and rows (see
   !> ek_rig).
   function new_schedule(suspension, case) result(schedule)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(schedule_t) :: schedule
      call make_schedule(suspension, case, schedule)
   end function new_schedule

   !> Creates the schedule of a case in the memory of an earlier schedule, for one design after the other.
   subroutine make_schedule(suspension, case, schedule)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(schedule_t), intent(inout) :: schedule
      integer :: k, most

      most = 1
      if (allocated(case%actuations)) most = min(max_driven, size(case%actuations))
      if (allocated(schedule%load_actuator)) then
         if (size(schedule%load_actuator) /= most) deallocate (schedule%load_actuator, schedule%row_actuator)
      end if
      if (.not. allocated(schedule%load_actuator)) allocate (schedule%load_actuator(most), schedule%row_actuator(most))
      schedule%loads = 0
      schedule%rows = 0
      schedule%is_settling = .false.
      schedule%rest = 0
      if (.not. allocated(case%actuations)) then
         call include(case%load, case%drive, follows_place, 1.0_wp)
         return
      end if
      do k = 1, size(case%actuations)
         associate (this => case%actuations(k))
            call include(this%load, this%drive, this%law, this%share, this%values, this%loads)
         end associate
      end do

   contains

      !> Adds an actuation of the load, of the driver row, or of both, whichever have the given names.
      subroutine include(load, drive, law, share, values, loads)
         character(*), intent(in) :: load, drive
         integer, intent(in) :: law
         real(wp), intent(in) :: share
         real(wp), allocatable, intent(in), optional :: values(:)
         integer, intent(in), optional :: loads        !! number of consecutive loads that are scaled; default 1
         integer :: number

         number = load_number(suspension, load)
         if (number > 0 .and. schedule%loads < most) then
            schedule%loads = schedule%loads + 1
            schedule%load(schedule%loads) = number
            schedule%further(schedule%loads) = 0
            if (present(loads)) schedule%further(schedule%loads) = loads - 1
            call put(schedule%load_actuator(schedule%loads), law, share, values)
         end if
         number = driver_row(suspension, drive)
         if (number > 0 .and. schedule%rows < most) then
            schedule%rows = schedule%rows + 1
            schedule%row(schedule%rows) = number
            call put(schedule%row_actuator(schedule%rows), law, share, values)
         end if
      end subroutine include

   end subroutine make_schedule

   !> Sets law, share and table values of an actuator.
   pure subroutine put(this, law, share, values)
      type(actuator_t), intent(inout) :: this
      integer, intent(in) :: law
      real(wp), intent(in) :: share
      real(wp), allocatable, intent(in), optional :: values(:)

      this%law = law
      this%share = share
      if (.not. present(values)) return
      if (allocated(values)) this%values = values
   end subroutine put

   !> Whether two schedules give the same inputs at all swept values; .false. if they use a table.
   pure logical function same_schedule(a, b)
      type(schedule_t), intent(in) :: a, b
      integer :: k

      same_schedule = a%loads == b%loads .and. a%rows == b%rows
      if (.not. same_schedule) return
      do k = 1, a%loads
         same_schedule = same_schedule .and. a%load(k) == b%load(k) .and. a%further(k) == b%further(k) .and. &
            same_law(a%load_actuator(k), b%load_actuator(k))
      end do
      do k = 1, a%rows
         same_schedule = same_schedule .and. a%row(k) == b%row(k) .and. same_law(a%row_actuator(k), b%row_actuator(k))
      end do

   contains

      !> Whether two actuators have the same law and share; .false. for a table.
      pure logical function same_law(one, other)
         type(actuator_t), intent(in) :: one, other
         same_law = one%law == other%law .and. abs(one%share - other%share) <= 0.0_wp .and. one%law /= follows_table
      end function same_law

   end function same_schedule

   !> Computes the inputs at a value of the path coordinate.
   pure subroutine inputs_at(schedule, place, inputs)
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: place
      type(inputs_t), intent(inout) :: inputs    !! elements beyond the number of loads and rows stay unchanged
      integer :: k

      inputs%homotopy = 0.0_wp
      if (schedule%is_settling) inputs%homotopy = 1.0_wp - place
      inputs%loads = schedule%loads
      do k = 1, schedule%loads
         inputs%load(k) = schedule%load(k)
         inputs%further(k) = schedule%further(k)
         inputs%factor(k) = value_at(schedule%load_actuator(k), place, schedule%rest)
      end do
      inputs%rows = schedule%rows
      do k = 1, schedule%rows
         inputs%row(k) = schedule%row(k)
         inputs%change(k) = value_at(schedule%row_actuator(k), place, schedule%rest)
      end do
   end subroutine inputs_at

   !> Value of an actuation: share × swept value, share × tan(swept value), or the value of the table. Table values are linear
   !> between rows. From swept value `rest` (initially 0) to the next row, they change linearly from 0.
   pure real(wp) function value_at(actuation, place, rest) result(value)
      type(actuator_t), intent(in) :: actuation
      real(wp), intent(in) :: place
      integer, intent(in) :: rest
      real(wp) :: before
      integer :: k

      select case (actuation%law)
      case (follows_tangent)
         value = actuation%share*tan(place)
      case (follows_table)
         k = min(max(int(place), 0), size(actuation%values) - 1)
         before = 0.0_wp
         if (k /= rest) before = actuation%values(k)
         value = before + (place - k)*(actuation%values(k + 1) - before)
      case default
         value = actuation%share*place
      end select
   end function value_at

end module ek_schedule
