!> The error value returned by every procedure that can fail, and the exit codes of the program.
!>
!> An unallocated error means success. The caller writes `if (allocated(error)) return` after every call.
module ek_error
   implicit none(type, external)
   private
   public :: error_t, fail, message_list_t
   public :: exit_usage, exit_deck, exit_model, exit_convergence, exit_file, exit_stopped, exit_outside

   integer, parameter :: exit_usage = 1        !! wrong command line
   integer, parameter :: exit_deck = 2         !! errors in a deck
   integer, parameter :: exit_model = 3        !! mechanism or redundant constraint
   integer, parameter :: exit_convergence = 4  !! a state did not converge; the converged states are written
   integer, parameter :: exit_file = 5         !! a file cannot be read or written
   integer, parameter :: exit_stopped = 6      !! a study was stopped before its end; used by the command line only
   integer, parameter :: exit_outside = 7      !! a number is outside its range, with --fail-outside; command line only

   !> An error: its message and the exit status of the program.
   type :: error_t
      integer :: code = exit_usage
      character(:), allocatable :: message    !! one or more lines, no trailing newline
   end type error_t

   type :: line_t
      character(:), allocatable :: text
   end type line_t

   !> Messages collected in order, so that one run reports every error.
   type :: message_list_t
      private
      type(line_t), allocatable :: lines(:)
      integer :: used = 0
   contains
      procedure :: add => list_add, count => list_count, text => list_text, line => list_line
   end type message_list_t

contains

   !> Creates an error with a code and a message.
   pure subroutine fail(error, code, message)
      type(error_t), allocatable, intent(out) :: error
      integer, intent(in) :: code               !! one of exit_*
      character(*), intent(in) :: message

      allocate (error)
      error%code = code
      error%message = message
   end subroutine fail

   !> Appends one message.
   pure subroutine list_add(self, message)
      class(message_list_t), intent(inout) :: self
      character(*), intent(in) :: message

      if (.not. allocated(self%lines)) allocate (self%lines(8))
      if (self%used == size(self%lines)) self%lines = [self%lines, self%lines]      ! twice the size
      self%used = self%used + 1
      self%lines(self%used)%text = message
   end subroutine list_add

   !> The number of messages.
   pure integer function list_count(self)
      class(message_list_t), intent(in) :: self
      list_count = self%used
   end function list_count

   !> Message k, counted in the order of addition.
   pure function list_line(self, k) result(text)
      class(message_list_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: text
      text = self%lines(k)%text
   end function list_line

   !> All messages, one per line, in the order of their addition.
   pure function list_text(self) result(text)
      class(message_list_t), intent(in) :: self
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, self%used
         if (k > 1) text = text//new_line('a')
         text = text//self%lines(k)%text
      end do
   end function list_text

end module ek_error
