!> Checks that enough memory is available before hours of work begin, so that a shortage gives a message and an exit status
!> instead of a crash at the allocation that fails.
module ek_memory
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str
   implicit none(type, external)
   private
   public :: ask_memory, has_memory, memory_words

contains

   !> Fails if a block of this many bytes cannot be allocated. The block is released at once; only address space is used.
   subroutine ask_memory(bytes, purpose, error)
      integer(i8), intent(in) :: bytes
      character(*), intent(in) :: purpose                     !! who needs it: 'case 'x' with 1000 states'
      type(error_t), allocatable, intent(out) :: error        !! exit_file

      if (.not. has_memory(bytes)) call fail(error, exit_file, memory_words(bytes, purpose))
   end subroutine ask_memory

   !> Whether a block of this many bytes can be allocated.
   logical function has_memory(bytes)
      integer(i8), intent(in) :: bytes
      character(1), allocatable, volatile :: block(:)         ! volatile: the optimiser must not remove it as unused
      integer :: status

      allocate (block(bytes), stat=status)
      has_memory = status == 0
   end function has_memory

   !> Says that a block of this many bytes cannot be allocated.
   pure function memory_words(bytes, purpose) result(text)
      integer(i8), intent(in) :: bytes
      character(*), intent(in) :: purpose
      character(:), allocatable :: text

      text = 'not enough memory: '//purpose//' needs '//str(int((bytes + 999999)/1000000))// &
         ' MB (a limit of the machine or of ulimit -v)'
   end function memory_words

end module ek_memory
