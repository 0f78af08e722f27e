!> callers DECK PATH VALUE CASE: as callers.c, by the Fortran interface: changes a number, solves a case, and prints column names and values
!> with 17 digits.
program callers
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ek_api, only: wp, error_t, session_t, case_result_t, open_file, set_number, solve, result_of
   implicit none(type, external)
   type(session_t), target :: session
   type(error_t), allocatable :: error
   type(case_result_t), pointer :: last
   character(1000) :: arguments(4)
   character(28) :: field
   real(wp) :: value
   integer :: k, row

   do k = 1, 4
      call get_command_argument(k, arguments(k))
   end do
   read (arguments(3), *) value
   call open_file(trim(arguments(1)), session, error)
   call stop_on(error)
   call set_number(session, trim(arguments(2)), value, error)
   call stop_on(error)
   call solve(session, trim(arguments(4)), error)
   call stop_on(error)
   last => result_of(session)
   do k = 1, size(last%table%columns)
      call put(trim(last%table%columns(k)), k)
   end do
   print '(a)', ''
   do row = 1, size(last%table%values, 2)
      do k = 1, size(last%table%columns)
         write (field, '(es28.16e3)') last%table%values(k, row)
         call put(trim(adjustl(field)), k)
      end do
      print '(a)', ''
   end do

contains

   subroutine put(text, k)
      character(*), intent(in) :: text
      integer, intent(in) :: k

      if (k > 1) write (*, '(a)', advance='no') ','
      write (*, '(a)', advance='no') text
   end subroutine put

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      stop 1, quiet=.true.
   end subroutine stop_on

end program callers
