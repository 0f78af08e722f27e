!> Votes of points on the frame of their table: the column of the vector from one point to another.
module ek_point_vote
   use ek_kinds, only: wp
   use ek_vote, only: ballot_t, add_vote, of_forward
   use ek_point_name, only: point_count
   implicit none(type, external)
   private
   public :: half_t, vote_along, vote_vector, vote_column, vote_sign

   !> The points of one side, in the columns and the unit of the table.
   type :: half_t
      logical :: has(point_count) = .false.
      real(wp) :: at(3, point_count) = 0.0_wp
      integer :: line(point_count) = 0
   end type half_t

   real(wp), parameter :: clear = 1.5_wp     !! a vector lies along a column if the others are smaller by this factor

contains

   !> Adds a vote for the direction from one point to another.
   subroutine vote_along(ballot, question, half, from, to, reason)
      type(ballot_t), intent(inout) :: ballot
      integer, intent(in) :: question, from, to
      type(half_t), intent(in) :: half
      character(*), intent(in) :: reason

      if (half%has(from) .and. half%has(to)) call vote_vector(ballot, question, half%at(:, to) - half%at(:, from), reason)
   end subroutine vote_along

   !> Adds a vote for the column of a vector, if one is clearly the largest.
   subroutine vote_vector(ballot, question, vector, reason)
      type(ballot_t), intent(inout) :: ballot
      integer, intent(in) :: question
      real(wp), intent(in) :: vector(3)
      character(*), intent(in) :: reason
      integer :: column

      column = maxloc(abs(vector), dim=1)
      if (count(clear*abs(vector) > abs(vector(column))) /= 1) return
      call add_vote(ballot, question, merge(column, -column, vector(column) > 0.0_wp), reason)
   end subroutine vote_vector

   !> Adds a vote for the forward direction from one point to another.
   subroutine vote_column(ballot, column, half, from, to, reason)
      type(ballot_t), intent(inout) :: ballot
      integer, intent(in) :: column, from, to
      type(half_t), intent(in) :: half
      character(*), intent(in) :: reason
      real(wp) :: vector(3)

      if (.not. (half%has(from) .and. half%has(to))) return
      vector = half%at(:, to) - half%at(:, from)
      if (abs(vector(column)) > 0.3_wp*norm2(vector)) call vote_sign(ballot, column, vector(column), reason)
   end subroutine vote_column

   !> Adds a vote for the forward direction by a sign.
   subroutine vote_sign(ballot, column, value, reason)
      type(ballot_t), intent(inout) :: ballot
      integer, intent(in) :: column
      real(wp), intent(in) :: value
      character(*), intent(in) :: reason

      if (abs(value) > 0.0_wp) call add_vote(ballot, of_forward, merge(column, -column, value > 0.0_wp), reason)
   end subroutine vote_sign

end module ek_point_vote
