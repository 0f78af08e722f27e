!> Votes on the frame of a table of hardpoints (ek_frame_votes), and their count. The answer to a question on a direction is a
!> column with a sign: 3 is the third column upwards, −1 the first column backwards. The answer on the unit is an index in
!> length_names.
module ek_vote
   use ek_kinds, only: wp, inch
   use ek_text, only: lower, plural
   implicit none(type, external)
   private
   public :: ballot_t, add_vote, leader, for, against, reasons, vote_lines, questions, side_name, column_name, take_axes
   public :: length_names, length_values, of_up, of_outboard, of_forward, of_length, axes_form

   integer, parameter :: of_up = 1, of_outboard = 2, of_forward = 3, of_length = 4
   character(30), parameter :: questions(4) = [character(30) :: 'which column points up', 'which column points outboard', &
      'which way is forward', 'the unit of length']
   character(2), parameter :: length_names(5) = [character(2) :: 'mm', 'cm', 'm', 'in', 'ft']
   real(wp), parameter :: length_values(5) = [1.0e-3_wp, 1.0e-2_wp, 1.0_wp, inch, 12*inch]      !! [m]
   character(*), parameter :: axes_form = 'iso, x-rear, sae, or the directions of x, y and z, as rear,right,up'
   integer, parameter :: most_votes = 80, most_lines = 7

   type :: vote_t
      integer :: question = 0
      integer :: answer = 0
      character(100) :: reason = ''
   end type vote_t

   type :: ballot_t
      private
      type(vote_t) :: votes(most_votes)
      integer :: used = 0
   end type ballot_t

contains

   pure subroutine add_vote(ballot, question, answer, reason)
      type(ballot_t), intent(inout) :: ballot
      integer, intent(in) :: question, answer
      character(*), intent(in) :: reason

      if (ballot%used == most_votes) return
      ballot%used = ballot%used + 1
      ballot%votes(ballot%used) = vote_t(question, answer, reason)
   end subroutine add_vote

   !> The answer with most votes; 0 without votes.
   pure integer function leader(ballot, question) result(answer)
      type(ballot_t), intent(in) :: ballot
      integer, intent(in) :: question
      integer :: k, most

      answer = 0
      most = 0
      do k = 1, ballot%used
         if (ballot%votes(k)%question /= question) cycle
         if (for(ballot, question, ballot%votes(k)%answer) <= most) cycle
         most = for(ballot, question, ballot%votes(k)%answer)
         answer = ballot%votes(k)%answer
      end do
   end function leader

   !> The number of votes for an answer.
   pure integer function for(ballot, question, answer)
      type(ballot_t), intent(in) :: ballot
      integer, intent(in) :: question, answer
      for = count(ballot%votes(:ballot%used)%question == question .and. ballot%votes(:ballot%used)%answer == answer)
   end function for

   !> The number of votes for other answers.
   pure integer function against(ballot, question, answer)
      type(ballot_t), intent(in) :: ballot
      integer, intent(in) :: question, answer
      against = count(ballot%votes(:ballot%used)%question == question .and. ballot%votes(:ballot%used)%answer /= answer)
   end function against

   !> The votes on a question, one on a line, at most seven.
   pure function vote_lines(ballot, question) result(text)
      type(ballot_t), intent(in) :: ballot
      integer, intent(in) :: question
      character(:), allocatable :: text
      integer :: k, shown

      text = ''
      shown = 0
      do k = 1, ballot%used
         if (ballot%votes(k)%question /= question) cycle
         shown = shown + 1
         if (shown <= most_lines) text = text//new_line('a')//'  '//answer_name(question, ballot%votes(k)%answer)//'  '// &
            trim(ballot%votes(k)%reason)
      end do
      if (shown == 0) text = new_line('a')//'  no vote: the points that could vote are missing or not recognised'
      if (shown > most_lines) text = text//new_line('a')//'  and '//plural(shown - most_lines, 'more vote', 'more votes')
   end function vote_lines

   !> The reasons for an answer, at most two.
   pure function reasons(ballot, question, answer) result(words)
      type(ballot_t), intent(in) :: ballot
      integer, intent(in) :: question, answer
      character(:), allocatable :: words
      integer :: k, shown

      words = ''
      shown = 0
      do k = 1, ballot%used
         if (ballot%votes(k)%question /= question .or. ballot%votes(k)%answer /= answer) cycle
         shown = shown + 1
         if (shown > 2) cycle
         if (shown > 1) words = words//'; '
         words = words//trim(ballot%votes(k)%reason)
      end do
      if (shown > 2) words = words//'; and '//plural(shown - 2, 'more vote', 'more votes')
   end function reasons

   !> The direction that a question asks for.
   pure function side_name(question) result(words)
      integer, intent(in) :: question
      character(:), allocatable :: words
      character(8), parameter :: list(3) = [character(8) :: 'up', 'outboard', 'forward']
      words = trim(list(question))
   end function side_name

   pure function answer_name(question, answer) result(words)
      integer, intent(in) :: question, answer
      character(2) :: words

      if (question == of_length) then
         words = length_names(answer)
      else
         words = column_name(answer)
      end if
   end function answer_name

   !> A direction as '+x' or '-z'.
   pure function column_name(direction) result(words)
      integer, intent(in) :: direction
      character(2) :: words

      words = '?'
      if (abs(direction) >= 1 .and. abs(direction) <= 3) words = merge('+', '-', direction > 0)// &
         'xyz'(abs(direction):abs(direction))
   end function column_name

   !> Reads the option --axes: the columns of forward, left and up; 0 if it is not given.
   subroutine take_axes(text, given, problem)
      character(*), intent(in) :: text
      integer, intent(out) :: given(3)
      character(:), allocatable, intent(inout) :: problem      !! what is wrong with the option; unchanged if nothing is
      character(*), parameter :: names(8) = [character(8) :: 'forward', 'left', 'up', 'rearward', 'right', 'down', 'rear', 'front']
      integer, parameter :: axis(8) = [1, 2, 3, 1, 2, 3, 1, 1], sign(8) = [1, 1, 1, -1, -1, -1, -1, 1]
      character(:), allocatable :: rest, word
      integer :: k, column, comma

      given = 0
      if (text == '') return
      rest = lower(trim(text))
      if (rest == 'iso') rest = 'forward,left,up'
      if (rest == 'x-rear') rest = 'rear,right,up'
      if (rest == 'sae') rest = 'forward,right,down'
      do column = 1, 3
         comma = index(rest//',', ',')
         word = trim(adjustl(rest(:comma - 1)))
         rest = rest(min(comma + 1, len(rest) + 1):)
         k = findloc(names == word, .true., dim=1)
         if (k == 0) exit
         if (given(axis(k)) /= 0) exit
         given(axis(k)) = sign(k)*column
      end do
      if (any(given == 0) .or. rest /= '') problem = '--axes must be '//axes_form//'; found '''//trim(text)//''''
   end subroutine take_axes

end module ek_vote
