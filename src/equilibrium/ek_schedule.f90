!> The inputs of a case along its path: which loads and rows, and their values.
!>
!> The path coordinate (place) is one number, the swept value: the factor of a load, the travel of a wheel, the roll angle,
!> or the row number of a table. Each actuation of a case is a function of it.
module ek_schedule
   use ek_kinds, only: wp
   use ek_case, only: max_driven, case_t, actuation_t, follows_tangent, follows_table
   use ek_suspension, only: suspension_t, driver_row, load_number
   use ek_state, only: inputs_t
   implicit none(type, external)
   private
   public :: schedule_t, new_schedule, inputs_at

   !> The actuations of a case, with their names resolved.
   type :: schedule_t
      integer :: loads = 0, rows = 0
      logical :: is_settling = .false.  !! no case: the swept value is the share of the imbalance at design that acts
      integer :: rest = 0               !! table row at which all inputs count as zero: the next row is reached from there
      integer :: load(max_driven) = 0, row(max_driven) = 0     !! their numbers in the suspension
      type(actuation_t), allocatable :: load_actuation(:), row_actuation(:)
   end type schedule_t

contains

   !> Resolves the names of the actuations of a case. The suspension must already contain all loads and rows (see ek_rig).
   function new_schedule(suspension, case) result(schedule)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(schedule_t) :: schedule
      type(actuation_t) :: actuation
      integer :: k

      allocate (schedule%load_actuation(max_driven), schedule%row_actuation(max_driven))
      if (allocated(case%actuations)) then
         do k = 1, size(case%actuations)
            call include(case%actuations(k))
         end do
      else
         actuation%load = case%load
         actuation%drive = case%drive
         call include(actuation)
      end if

   contains

      subroutine include(this)
         type(actuation_t), intent(in) :: this
         integer :: number

         number = load_number(suspension, this%load)
         if (number > 0 .and. schedule%loads < max_driven) then
            schedule%loads = schedule%loads + 1
            schedule%load(schedule%loads) = number
            schedule%load_actuation(schedule%loads) = this
         end if
         number = driver_row(suspension, this%drive)
         if (number > 0 .and. schedule%rows < max_driven) then
            schedule%rows = schedule%rows + 1
            schedule%row(schedule%rows) = number
            schedule%row_actuation(schedule%rows) = this
         end if
      end subroutine include

   end function new_schedule

   !> The inputs at a value of the path coordinate.
   pure subroutine inputs_at(schedule, place, inputs)
      type(schedule_t), intent(in) :: schedule
      real(wp), intent(in) :: place
      type(inputs_t), intent(inout) :: inputs    !! what is beyond the number of loads and rows stays
      integer :: k

      inputs%homotopy = 0.0_wp
      if (schedule%is_settling) inputs%homotopy = 1.0_wp - place
      inputs%loads = schedule%loads
      do k = 1, schedule%loads
         inputs%load(k) = schedule%load(k)
         inputs%factor(k) = value_at(schedule%load_actuation(k), place, schedule%rest)
      end do
      inputs%rows = schedule%rows
      do k = 1, schedule%rows
         inputs%row(k) = schedule%row(k)
         inputs%change(k) = value_at(schedule%row_actuation(k), place, schedule%rest)
      end do
   end subroutine inputs_at

   !> share × place, share × tan(place), or the value of the table: linear between its rows, and from 0 at
   !> place `rest` to the next row (initially from swept value 0 to row 1).
   pure real(wp) function value_at(actuation, place, rest) result(value)
      type(actuation_t), intent(in) :: actuation
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
