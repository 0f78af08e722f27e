!> fit DECK: fits a bushing rate to a target compliance (as fit.py and fit.c). CMakeLists.txt: find_package(elastokin), target elastokin::api.
program fit
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ek_api, only: wp, error_t, session_t, open_file, get_number, set_number, read_key_numbers
   implicit none(type, external)
   character(*), parameter :: path = 'bushing.lca_front.kt(2)'       ! [N/mm]
   character(*), parameter :: number = 'left_braking_deflection'     ! [mm/kN]
   real(wp), parameter :: target_value = 6.0_wp
   type(session_t) :: session
   type(error_t), allocatable :: error
   real(wp) :: before, rate, miss_before, miss_now, slope
   character(1000) :: deck
   integer :: step

   call get_command_argument(1, deck)
   call open_file(trim(deck), session, error)
   call stop_on(error)
   call get_number(session, path, before, error)
   call stop_on(error)
   rate = 0.9_wp*before
   call find_miss(before, miss_before)
   call find_miss(rate, miss_now)
   do step = 1, 20
      print '(i2,2(1x,es23.16))', step, rate, miss_now
      if (abs(miss_now) < 1.0e-9_wp) exit
      slope = (miss_now - miss_before)/(rate - before)
      before = rate
      miss_before = miss_now
      rate = rate - miss_now/slope
      call find_miss(rate, miss_now)
   end do
   if (step > 20) error stop 'fit: no rate found in 20 steps'

contains

   !> Difference from the target at a rate.
   subroutine find_miss(rate, miss)
      real(wp), intent(in) :: rate
      real(wp), intent(out) :: miss
      real(wp) :: values(1)

      call set_number(session, path, rate, error)
      call stop_on(error)
      call read_key_numbers(session, [number], values, error)
      call stop_on(error)
      miss = values(1) - target_value
   end subroutine find_miss

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      stop 1, quiet=.true.
   end subroutine stop_on

end program fit
