!> The errors found in a file of another program, each with its line, in the order in which they were found.
module ek_flaws
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_letters, only: visible
   implicit none(type, external)
   private
   public :: flaws_t, new_flaws, shown

   integer, parameter :: most_kept = 50      !! most errors stored; a file with more is probably another file
   integer, parameter :: most_shown = 60     !! most characters of the file in a message

   type :: flaws_t
      character(:), allocatable :: file        !! path as given by the user
      integer, private :: lines(most_kept) = 0
      type(message_list_t), private :: words
      integer, private :: untold = 0
   contains
      procedure :: add => flaws_add, count => flaws_count, line => flaws_line, what => flaws_what, text => flaws_text
   end type flaws_t

contains

   !> An empty list for the errors of a file.
   pure type(flaws_t) function new_flaws(file) result(flaws)
      character(*), intent(in) :: file
      flaws%file = file
   end function new_flaws

   !> Adds an error. Only the first 50 errors are stored; further errors are counted.
   pure subroutine flaws_add(self, line, what)
      class(flaws_t), intent(inout) :: self
      integer, intent(in) :: line              !! 0: the file as a whole
      character(*), intent(in) :: what         !! the message, as in 'expected …, found …'

      if (self%words%count() == most_kept) then
         self%untold = self%untold + 1
         return
      end if
      call self%words%add(visible(what))
      self%lines(self%words%count()) = line
   end subroutine flaws_add

   !> The number of stored errors.
   pure integer function flaws_count(self)
      class(flaws_t), intent(in) :: self
      flaws_count = self%words%count()
   end function flaws_count

   pure integer function flaws_line(self, k)
      class(flaws_t), intent(in) :: self
      integer, intent(in) :: k
      flaws_line = self%lines(k)
   end function flaws_line

   !> The message of error k without its file and line.
   pure function flaws_what(self, k) result(text)
      class(flaws_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: text

      text = self%words%line(k)
      if (k == most_kept .and. self%untold > 0) text = text//' (and '//plural(self%untold, 'more error', 'more errors')// &
         '; is this the right file?)'
   end function flaws_what

   !> All errors as lines 'file:line: error'.
   pure function flaws_text(self) result(text)
      class(flaws_t), intent(in) :: self
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, self%words%count()
         if (k > 1) text = text//new_line('a')
         text = text//self%file
         if (self%lines(k) > 0) text = text//':'//str(self%lines(k))
         text = text//': '//self%what(k)
      end do
   end function flaws_text

   !> A string of the file for a message: in quotes, and truncated if it is long.
   pure function shown(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words

      if (len_trim(text) <= most_shown) then
         words = "'"//visible(trim(text))//"'"
      else
         words = "'"//visible(text(:most_shown))//" …'"
      end if
   end function shown

end module ek_flaws
