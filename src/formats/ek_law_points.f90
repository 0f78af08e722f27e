!> The points of a law as a file of another program gives them, converted to the order that a curve of a deck requires.
module ek_law_points
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_flaws, only: flaws_t
   implicit none(type, external)
   private
   public :: law_points_t, add_point, finish_law, constant_rate

   integer, parameter :: most_points = 200      !! most points of a curve of a deck

   type :: law_points_t
      logical :: is_given = .false.
      logical :: is_bad = .false.                !! an error was reported
      integer :: line = 0                        !! line at which the law begins
      integer :: used = 0
      real(wp), allocatable :: x(:), y(:)        !! displacement and force, or angle and moment [SI]
      integer, allocatable :: lines(:)           !! line of each point in the file
   end type law_points_t

contains

   !> Appends a point and its line in the file.
   pure subroutine add_point(law, x, y, line)
      type(law_points_t), intent(inout) :: law
      real(wp), intent(in) :: x, y
      integer, intent(in) :: line

      if (.not. allocated(law%x)) allocate (law%x(16), law%y(16), law%lines(16))
      if (law%used == size(law%x)) then          ! twice the size
         law%x = [law%x, law%x]
         law%y = [law%y, law%y]
         law%lines = [law%lines, law%lines]
      end if
      law%used = law%used + 1
      law%x(law%used) = x
      law%y(law%used) = y
      law%lines(law%used) = line
   end subroutine add_point

   !> Sorts the points by increasing x: a falling list is reversed, and a point given twice is dropped. Reports too few or too many
   !> points, a list that neither rises nor falls, and two values at one x.
   subroutine finish_law(law, name, flaws)
      type(law_points_t), intent(inout) :: law
      character(*), intent(in) :: name           !! name of the block, for messages
      type(flaws_t), intent(inout) :: flaws
      integer :: k, kept
      logical :: falls

      if (law%is_bad) return
      law%is_bad = .true.
      if (law%used < 2) then
         call flaws%add(law%line, name//': expected at least 2 points, found '//str(law%used))
         return
      end if
      falls = law%x(law%used) < law%x(1)
      do k = 2, law%used
         if (.not. ((law%x(k) < law%x(k - 1)) .neqv. falls) .or. .not. abs(law%x(k) - law%x(k - 1)) > 0.0_wp) cycle
         call flaws%add(law%lines(k), name//': expected displacements that only '//trim(merge('fall', 'rise', falls))// &
            ', found one that '//trim(merge('rises', 'falls', falls)))
         return
      end do
      if (falls) then
         law%x(:law%used) = law%x(law%used:1:-1)
         law%y(:law%used) = law%y(law%used:1:-1)
         law%lines(:law%used) = law%lines(law%used:1:-1)
      end if
      kept = 1
      do k = 2, law%used
         if (law%x(k) > law%x(kept)) then
            kept = kept + 1
            law%x(kept) = law%x(k)
            law%y(kept) = law%y(k)
            law%lines(kept) = law%lines(k)
         else if (abs(law%y(k) - law%y(kept)) > 0.0_wp) then
            call flaws%add(max(law%lines(k), law%lines(kept)), name//': a displacement is given twice, here and in line '// &
               str(min(law%lines(k), law%lines(kept)))//', with different forces')
            return
         end if
      end do
      law%used = kept
      if (kept < 2) then
         call flaws%add(law%line, name//': expected at least 2 different displacements, found 1')
      else if (kept > most_points) then
         call flaws%add(law%lines(most_points + 1), name//': expected at most '//str(most_points)//' points, found '//str(kept))
      else
         law%is_bad = .false.
      end if
   end subroutine finish_law

   !> Finds whether all points lie on one straight line through the origin (to 1e-9 of the largest force), and the slope of this
   !> line.
   pure subroutine constant_rate(law, rate, is_constant)
      type(law_points_t), intent(in) :: law
      real(wp), intent(out) :: rate
      logical, intent(out) :: is_constant
      real(wp), parameter :: near = 1.0e-9_wp
      integer :: far

      rate = 0.0_wp
      is_constant = .false.
      if (law%used < 2) return
      far = maxloc(abs(law%x(:law%used)), dim=1)
      rate = law%y(far)/law%x(far)
      is_constant = all(abs(law%y(:law%used) - rate*law%x(:law%used)) <= near*maxval(abs(law%y(:law%used))))
   end subroutine constant_rate

end module ek_law_points
