!> Votes on the frame of a table of hardpoints (ek_frame_votes), and their count. The answer to a question on a direction is a
!> column with a sign: 3 is the third column upwards, −1 the first column backwards. The answer on the unit is an index in
!> length_names.
module ek_vote
   use ek_kinds, only: wp, inch
   use ek_text, only: plural
   implicit none(type, external)
   private
   public :: ballot_t, add_vote, leader, for, against, reasons, vote_lines, questions, side_name, column_name
   public :: length_names, length_values, of_up, of_outboard, of_forward, of_length

   integer, parameter :: of_up = 1, of_outboard = 2, of_forward = 3, of_length = 4
   character(30), parameter :: questions(4) = [character(30) :: 'which column points up', 'which column points outboard', &
      'which way is forward', 'the unit of length']
   character(2), parameter :: length_names(5) = [character(2) :: 'mm', 'cm', 'm', 'in', 'ft']
   real(wp), parameter :: length_values(5) = [1.0e-3_wp, 1.0e-2_wp, 1.0_wp, inch, 12*inch]      !! [m]
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

end module ek_vote
