!> A deck of the library with points and links only, for elastokin new KIND --points-only: without springs, with joints instead of
!> bushings.
!>
!> The deck is changed as text, record by record. Each record begins on a line with & and ends on a line whose last character is /,
!> as in all decks of the library. For each kind, a file of library/points contains the joints that replace the bushings. A record
!> of this file with the name of a record of the deck, and &mirror, replace that record; all other records are inserted at the
!> first bushing. Its first line may list further records that are dropped: `! drop: 'arb_hinge', 'drop_link'`.
module ek_points_only
   use ek_text, only: replace
   use ek_buffer, only: buffer_t
   implicit none(type, external)
   private
   public :: keep_points

   character, parameter :: nl = new_line('a')
   !> Groups of records that are dropped, and the tests that do not need a spring.
   character(*), parameter :: dropped(*) = [character(8) :: 'bushing', 'spring', 'stop', 'damper', 'torsion', 'curve', 'load'], &
      kinematic(*) = [character(15) :: 'parallel_travel', 'opposite_travel', 'single_travel', 'roll', 'steering']
   character(*), parameter :: rule = '-----------------------------------------------'

   !> A record of a deck, or a line between the records.
   type :: piece_t
      character(:), allocatable :: text      !! with its line end
      character(:), allocatable :: group     !! '' for a line between the records
      character(:), allocatable :: name      !! '' without a name
      logical :: is_kept = .true.
   end type piece_t

contains

   !> Writes the deck of points and links.
   subroutine keep_points(deck, joints, title, out)
      character(*), intent(in) :: deck       !! of the library
      character(*), intent(in) :: joints     !! file of library/points
      character(*), intent(in) :: title      !! kind of suspension, for the comment at the beginning
      type(buffer_t), intent(inout) :: out
      type(piece_t), allocatable :: pieces(:), news(:)
      character(:), allocatable :: of_points
      logical, allocatable :: is_placed(:)
      integer :: k

      of_points = title
      call replace(of_points, ' and anti-roll bar', '')
      call cut(deck, pieces)
      call cut(joints, news)
      do k = 1, size(news)
         if (news(k)%group == '') news(k)%is_kept = .false.
      end do
      allocate (is_placed(size(news)), source=.false.)
      do k = 1, size(pieces)
         call choose(pieces(k), joints, of_points)
         if (pieces(k)%group /= '' .and. pieces(k)%is_kept) call replace_record(pieces(k), news, is_placed)
      end do
      call drop_unnamed(pieces, news)
      call put_comment(of_points, out)
      call put_pieces(pieces, news, is_placed, out)
   end subroutine keep_points

   !> Decides whether a record of the deck is kept, and changes &model.
   pure subroutine choose(this, joints, of_points)
      type(piece_t), intent(inout) :: this
      character(*), intent(in) :: joints, of_points
      integer :: n

      if (any(dropped == this%group)) this%is_kept = .false.
      if (this%group == 'case') this%is_kept = any([(index(this%text, "'"//trim(kinematic(n))//"'") > 0, n=1, size(kinematic))])
      if (this%group == 'model') then
         call replace(this%text, " balance = 'all',", '')
         call set_title(this%text, of_points)
      end if
      if (this%name == '' .or. index(joints, '! drop:') /= 1) return
      if (index(joints(:index(joints, nl)), "'"//this%name//"'") > 0) this%is_kept = .false.
   end subroutine choose

   !> Replaces a record by the record of the file of joints that has the same name.
   pure subroutine replace_record(this, news, is_placed)
      type(piece_t), intent(inout) :: this
      type(piece_t), intent(in) :: news(:)
      logical, intent(inout) :: is_placed(:)
      integer :: n

      do n = 1, size(news)
         if (.not. is_successor(news(n), this)) cycle
         this%text = news(n)%text
         is_placed(n) = .true.
      end do
   end subroutine replace_record

   !> Drops points and bodies that no record names any more, until none is left.
   pure subroutine drop_unnamed(pieces, news)
      type(piece_t), intent(inout) :: pieces(:)
      type(piece_t), intent(in) :: news(:)
      logical :: has_changed
      integer :: k

      has_changed = .true.
      do while (has_changed)
         has_changed = .false.
         do k = 1, size(pieces)
            if (.not. pieces(k)%is_kept .or. .not. is_part(pieces(k))) cycle
            pieces(k)%is_kept = is_named(pieces(k)%name, pieces, news)
            has_changed = has_changed .or. .not. pieces(k)%is_kept
         end do
      end do
   end subroutine drop_unnamed

   !> Whether a record is a point or a body.
   pure logical function is_part(piece)
      type(piece_t), intent(in) :: piece
      is_part = any([character(5) :: 'point', 'body'] == piece%group)
   end function is_part

   !> Whether a record that is kept, other than &mirror and the record itself, names a point or a body.
   pure logical function is_named(name, pieces, news)
      character(*), intent(in) :: name
      type(piece_t), intent(in) :: pieces(:), news(:)
      integer :: j

      is_named = .false.
      do j = 1, size(pieces)
         if (.not. pieces(j)%is_kept .or. pieces(j)%group == 'mirror' .or. pieces(j)%group == '') cycle
         if (pieces(j)%name == name .and. is_part(pieces(j))) cycle
         is_named = is_named .or. names(pieces(j), name)
      end do
      do j = 1, size(news)
         is_named = is_named .or. names(news(j), name)
      end do
   end function is_named

   !> Whether a record names a thing, perhaps with its side in front.
   pure logical function names(piece, name)
      type(piece_t), intent(in) :: piece
      character(*), intent(in) :: name
      names = index(piece%text, "'"//name//"'") > 0 .or. index(piece%text, "_"//name//"'") > 0
   end function names

   subroutine put_comment(of_points, out)
      character(*), intent(in) :: of_points
      type(buffer_t), intent(inout) :: out

      call out%line('! '//of_points//': points and links only, for kinematics without springs.')
      call out%line('!')
      call out%line('! Coordinates: x rearward, y right, z up, origin on the wheel centre line; mm, deg. The deck describes')
      call out%line('! the left half; the right half is its mirror image. Joints replace the bushings.')
   end subroutine put_comment

   !> Writes the records that are kept from &model on, and at the first bushing the records that replace bushings. A heading is
   !> written with the first record below it.
   subroutine put_pieces(pieces, news, is_placed, out)
      type(piece_t), intent(in) :: pieces(:), news(:)
      logical, intent(inout) :: is_placed(:)
      type(buffer_t), intent(inout) :: out
      character(:), allocatable :: pending
      integer :: k, n

      pending = nl
      do k = findloc([(pieces(n)%group == 'model', n=1, size(pieces))], .true., dim=1), size(pieces)
         associate (this => pieces(k))
            if (this%group == '') then
               if (index(this%text, '! ----') == 1) pending = nl//this%text//nl
               if (this%text == nl .and. pending == '') pending = nl
            else if (this%group == 'bushing' .and. .not. all(is_placed .or. .not. news%is_kept)) then
               call out%add(nl//'! ---- pivots and links, instead of bushings '//rule//nl//nl)
               do n = 1, size(news)
                  if (news(n)%is_kept .and. .not. is_placed(n)) call out%add(news(n)%text)
                  is_placed(n) = .true.
               end do
               pending = ''
            else if (this%is_kept) then
               call out%add(pending//this%text)
               pending = ''
            end if
         end associate
      end do
   end subroutine put_pieces

   !> Gives &model the title of a deck without an anti-roll bar and stops.
   pure subroutine set_title(text, of_points)
      character(:), allocatable, intent(inout) :: text
      character(*), intent(in) :: of_points
      integer :: first, last

      first = index(text, "title = '") + len("title = '")
      last = first + index(text(first:), "'") - 2
      text = text(:first - 1)//of_points//', points and links'//text(last + 1:)
   end subroutine set_title

   !> Whether a record of the file of joints replaces a record of the deck.
   pure logical function is_successor(new, old)
      type(piece_t), intent(in) :: new, old

      is_successor = new%group == old%group .and. new%group /= ''
      if (is_successor .and. new%group /= 'mirror') is_successor = new%name == old%name .and. new%name /= ''
   end function is_successor

   !> Divides a deck into its records and the lines between them.
   pure subroutine cut(text, pieces)
      character(*), intent(in) :: text
      type(piece_t), allocatable, intent(out) :: pieces(:)
      type(piece_t) :: piece
      integer :: first, last, pass, n

      do pass = 1, 2                         ! first the number of pieces
         n = 0
         first = 1
         do while (first <= len(text))
            last = end_of_line(text, first)
            if (text(first:first) == '&') then
               do while (text(last - 1:last - 1) /= '/' .and. last < len(text))
                  last = end_of_line(text, last + 1)
               end do
            end if
            n = n + 1
            if (pass == 2) then
               piece%text = text(first:last)
               piece%group = ''
               piece%name = ''
               if (text(first:first) == '&') then
                  piece%group = text(first + 1:first - 1 + scan(text(first:last), ' /'//nl) - 1)
                  piece%name = name_of(text(first:last))
               end if
               pieces(n) = piece
            end if
            first = last + 1
         end do
         if (pass == 1) allocate (pieces(n))
      end do
   end subroutine cut

   !> Position of the end of the line that contains a position of a text.
   pure integer function end_of_line(text, at)
      character(*), intent(in) :: text
      integer, intent(in) :: at

      end_of_line = index(text(at:), nl)
      end_of_line = merge(at - 1 + end_of_line, len(text), end_of_line > 0)
   end function end_of_line

   !> The name of a record; '' without a name.
   pure function name_of(record) result(name)
      character(*), intent(in) :: record
      character(:), allocatable :: name
      character(*), parameter :: key = "name = '"
      integer :: first

      name = ''
      first = index(record, key)
      if (first == 0) return
      first = first + len(key)
      name = record(first:first + index(record(first:), "'") - 2)
   end function name_of

end module ek_points_only
