!> Whether there is room for what comes: asked before hours of work, so that the answer is words and a status, not the end of
!> the process at the allocation that does not succeed.
module ek_memory
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: ask_memory

contains

   !> Fails where a block of so many bytes cannot be had. Nothing is kept; it takes no memory but addresses.
   subroutine ask_memory(bytes, purpose, error)
      integer(i8), intent(in) :: bytes
      character(*), intent(in) :: purpose                     !! who needs it: 'case 'x' with 1000 states'
      type(error_t), allocatable, intent(out) :: error        !! exit_file
      character(1), allocatable, volatile :: block(:)         ! volatile: an optimiser may not take it away as unused
      integer :: status

      allocate (block(bytes), stat=status)
      if (status == 0) return
      call fail(error, exit_file, 'not enough memory: '//purpose//' needs '//str(int((bytes + 999999)/1000000))// &
         ' MB (a limit of the machine or of ulimit -v)')
   end subroutine ask_memory

end module ek_memory
