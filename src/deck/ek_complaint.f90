!> The mistakes of a deck, with their locations: they are collected and reported together.
module ek_complaint
   use ek_text, only: str, lower
   use ek_letters, only: visible
   implicit none(type, external)
   private
   public :: place_t, complaints_t, place_in
   public :: single, left_side, right_side, side_prefix, has_side

   !> The sides of the two records that &mirror creates from a record of the left half, which are in their names; or neither.
   integer, parameter :: single = 0, left_side = 1, right_side = 2
   character(*), parameter :: side_prefix(2) = [character(6) :: 'left_', 'right_']

   !> A location in a file or on the command line.
   type :: place_t
      character(:), allocatable :: words  !! 'front.nml:41', '--set point.x.z=-105'
      integer :: source = 0, line = 0     !! messages are sorted by these
      integer :: side = single
   end type place_t

   type :: complaint_t
      type(place_t) :: place
      character(:), allocatable :: text
   end type complaint_t

   !> Mistakes found so far; reported in the order of files and lines.
   !>
   !> A mistake in an element duplicated by &mirror is reported once, under the name used in the deck: a message about the right
   !> side is dropped if there is one about the left side at the same location, and the prefixes are removed from the latter.
   type :: complaints_t
      private
      integer :: used = 0
      type(complaint_t), allocatable :: list(:)
   contains
      procedure :: add => complaints_add
      procedure :: count => complaints_count
      procedure :: text => complaints_text
   end type complaints_t

contains

   !> Whether a name begins with left_ or right_.
   pure logical function has_side(name)
      character(*), intent(in) :: name
      has_side = index(lower(name), 'left_') == 1 .or. index(lower(name), 'right_') == 1
   end function has_side

   !> Record a mistake. Invisible characters in the message are shown as <U+00A0>.
   pure subroutine complaints_add(self, place, what)
      class(complaints_t), intent(inout) :: self
      type(place_t), intent(in) :: place
      character(*), intent(in) :: what
      character(:), allocatable :: text
      integer :: k

      text = visible(what)
      if (place%side == right_side) then
         do k = 1, self%used
            if (self%list(k)%place%side == left_side .and. self%list(k)%place%words == place%words) return
         end do
      else if (place%side == left_side) then
         do
            k = index(text, "'left_")
            if (k == 0) exit
            text = text(:k)//text(k + len("'left_"):)
         end do
      end if
      if (.not. allocated(self%list)) allocate (self%list(8))
      if (self%used == size(self%list)) self%list = [self%list, self%list]      ! twice the size
      self%used = self%used + 1
      self%list(self%used)%place = place
      self%list(self%used)%text = place%words//': '//text
   end subroutine complaints_add

   !> The number of recorded mistakes.
   pure integer function complaints_count(self)
      class(complaints_t), intent(in) :: self
      complaints_count = self%used
   end function complaints_count

   !> The messages, one per line, sorted by file and line number; messages about one line keep their order. The list is cut
   !> at a limit: a file with so many mistakes is probably not a deck.
   pure function complaints_text(self) result(text)
      class(complaints_t), intent(in) :: self
      character(:), allocatable :: text
      integer, parameter :: most = 100
      integer :: order(self%used), k, j

      do k = 1, self%used
         do j = k - 1, 1, -1
            associate (this => self%list(k)%place, other => self%list(order(j))%place)
               if (this%source > other%source .or. (this%source == other%source .and. this%line >= other%line)) exit
            end associate
            order(j + 1) = order(j)
         end do
         order(j + 1) = k
      end do
      text = ''
      do k = 1, min(self%used, most)
         if (k > 1) text = text//new_line('a')
         text = text//self%list(order(k))%text
      end do
      if (self%used > most) text = text//new_line('a')//'and '//str(self%used - most)//' more mistakes; is this a deck?'
   end function complaints_text

   !> The location of a line of a file; line 0: the file itself.
   pure subroutine place_in(file, source, line, place)
      character(*), intent(in) :: file
      integer, intent(in) :: source, line
      type(place_t), intent(out) :: place

      place%words = file
      if (line > 0) place%words = file//':'//str(line)
      place%source = source
      place%line = line
   end subroutine place_in

end module ek_complaint
