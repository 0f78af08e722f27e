!> Plausibility of the ends of rods, springs, dampers and stops: an end on another body than the one among whose points it lies, and
!> two ends that are exchanged.
module ek_plausible_ends
   use ek_kinds, only: wp, millimetre
   use ek_text, only: quoted
   use ek_measure, only: measure_t, axis_axis, rotation, distance
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, body_name
   use ek_plausible_range, only: doubts_t, length
   use ek_plausible_names, only: has_word, without_side
   use ek_plausible_shape, only: point_of
   implicit none(type, external)
   private
   public :: doubt_rod_ends

   integer, parameter :: least_points = 3      !! number of other points of a body whose extent is judged

   !> The box around the points of a body: joints, bushings, ends of springs.
   type :: extent_t
      integer :: points = 0
      real(wp) :: low(3) = huge(1.0_wp), high(3) = -huge(1.0_wp)
   end type extent_t

contains

   !> Examines the ends of all distance joints and of all elements between two points.
   subroutine doubt_rod_ends(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      type(extent_t) :: extents(0:size(suspension%bodies))
      integer :: k

      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%kind /= 'distance') cycle
         associate (m => first_measure(suspension, k))
            call find_extents(suspension, m, extents)
            call doubts%examine(suspension%joints(k)%where, 'joint '//quoted(suspension%joints(k)%name))
            call doubt_end(suspension, extents, m, .false., doubts)
            call doubt_end(suspension, extents, m, .true., doubts)
            call doubt_exchange(suspension, extents, m, doubts)
         end associate
      end do
      do k = 1, suspension%scalars
         associate (m => suspension%elements(k)%measure)
            if (m%kind /= distance) cycle
            call find_extents(suspension, m, extents)
            call doubts%examine(suspension%elements(k)%where, element_label(suspension%elements(k)))
            call doubt_end(suspension, extents, m, .false., doubts)
            call doubt_end(suspension, extents, m, .true., doubts)
         end associate
      end do
   end subroutine doubt_rod_ends

   !> Examines whether an end lies far from all other points of its body, and among the points of another body. If its name contains
   !> the name of the other body, a smaller distance is enough. Without such a name, the carrier of a wheel is not examined: its
   !> levers reach among the arms.
   subroutine doubt_end(suspension, extents, m, is_second, doubts)
      type(suspension_t), intent(in) :: suspension
      type(extent_t), intent(in) :: extents(0:)      !! of the bodies, without this rod
      type(measure_t), intent(in) :: m
      logical, intent(in) :: is_second               !! examine the end on body j
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: far = 150.0_wp*millimetre, off = 60.0_wp*millimetre, among = 30.0_wp*millimetre
      real(wp) :: at(3), own_distance
      character(:), allocatable :: name
      integer :: own, b

      own = merge(m%body_j, m%body_i, is_second)
      if (own == 0) return
      if (extents(own)%points < least_points) return
      at = end_of(suspension, m, is_second)
      own_distance = distance_to(extents(own), at)
      if (own_distance < off) return
      name = name_at(suspension, at)
      do b = 1, size(suspension%bodies)
         if (b == m%body_i .or. b == m%body_j .or. extents(b)%points < least_points) cycle
         if (distance_to(extents(b), at) > among) cycle
         if ((own_distance < far .or. any(suspension%wheels%body == own)) .and. .not. has_word(name, bare(suspension, b))) cycle
         call doubts%add('body of an end', 'its end '//at_point(name)//'on body '//quoted(body_name(suspension, own))//' lies '// &
            doubts%speak(length, own_distance)//' from the other points of this body, but among those of body '// &
            quoted(body_name(suspension, b))//'; should it be on that body?')
         return
      end do
   end subroutine doubt_end

   !> Examines whether each end lies at a point that is named after the body of the other end, with a rod that would be nearer to
   !> both bodies with its ends exchanged.
   subroutine doubt_exchange(suspension, extents, m, doubts)
      type(suspension_t), intent(in) :: suspension
      type(extent_t), intent(in) :: extents(0:)      !! of the bodies, without this rod
      type(measure_t), intent(in) :: m
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: nearer = 20.0_wp*millimetre
      character(:), allocatable :: name_i, name_j
      real(wp) :: at_i(3), at_j(3)
      logical :: is_of_j, is_of_i

      if (min(m%body_i, m%body_j) == 0) return
      if (min(extents(m%body_i)%points, extents(m%body_j)%points) < 1) return
      at_i = end_of(suspension, m, .false.)
      at_j = end_of(suspension, m, .true.)
      name_i = name_at(suspension, at_i)
      name_j = name_at(suspension, at_j)
      is_of_j = has_word(name_i, bare(suspension, m%body_j)) .and. .not. has_word(name_i, bare(suspension, m%body_i)) .and. &
         .not. has_word(name_j, bare(suspension, m%body_j))
      is_of_i = has_word(name_j, bare(suspension, m%body_i)) .and. .not. has_word(name_j, bare(suspension, m%body_j)) .and. &
         .not. has_word(name_i, bare(suspension, m%body_i))
      if (.not. (is_of_i .or. is_of_j)) return
      if (distance_to(extents(m%body_i), at_i) + distance_to(extents(m%body_j), at_j) < nearer + &
         distance_to(extents(m%body_i), at_j) + distance_to(extents(m%body_j), at_i)) return
      call doubts%add('swapped', 'its end on body '//quoted(body_name(suspension, m%body_i))//' is at '//quoted(name_i)// &
         ', its end on body '//quoted(body_name(suspension, m%body_j))//' at '//quoted(name_j)//': are the two points swapped?')
   end subroutine doubt_exchange

   !> Name of a body without its side.
   pure function bare(suspension, body) result(name)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      character(:), allocatable :: name

      name = without_side(body_name(suspension, body))
   end function bare

   !> Phrase about the point of an end: "at 'drop_lca' "; '' if no hardpoint is there.
   pure function at_point(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      text = ''
      if (name /= '') text = 'at '//quoted(name)//' '
   end function at_point

   !> Name of the hardpoint at a position; '' if there is none.
   pure function name_at(suspension, at) result(name)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: at(3)
      character(:), allocatable :: name
      real(wp), parameter :: same = 1.0e-9_wp      ! m
      integer :: k

      name = ''
      do k = 1, size(suspension%points)
         if (maxval(abs(suspension%points(k)%at - at)) < same) name = suspension%points(k)%name
      end do
   end function name_at

   !> Position of an end of a measure at design [m].
   pure function end_of(suspension, m, is_second) result(at)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: m
      logical, intent(in) :: is_second
      real(wp) :: at(3)

      if (is_second) then
         at = point_of(suspension, m%body_j, m%arm_j)
      else
         at = point_of(suspension, m%body_i, m%arm_i)
      end if
   end function end_of

   !> First measure of a joint: its arms are the attachment points.
   pure function first_measure(suspension, joint) result(m)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: joint
      type(measure_t) :: m
      m = suspension%terms(suspension%rows(suspension%joints(joint)%first_row)%first)%measure
   end function first_measure

   !> Finds the boxes around the points of each body. Elements and joints between the points of the rod are left out, because a
   !> spring, its damper and its stops have the same ends.
   subroutine find_extents(suspension, rod, extents)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: rod
      type(extent_t), intent(out) :: extents(0:)
      integer :: k

      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%is_of_measures) cycle
            associate (m => first_measure(suspension, k))
               if (m%kind == rotation .or. (m%kind == axis_axis .and. joint%rows < 4)) cycle
               call include_both(m)
            end associate
         end associate
      end do
      do k = 1, size(suspension%elements)
         associate (m => suspension%elements(k)%measure)
            if (m%kind == rotation .or. m%kind == axis_axis) cycle
            call include_both(m)
         end associate
      end do

   contains

      subroutine include_both(m)
         type(measure_t), intent(in) :: m
         real(wp), parameter :: same = 1.0e-9_wp
         real(wp) :: a(3), b(3)

         a = end_of(suspension, m, .false.)
         b = end_of(suspension, m, .true.)
         if (all([m%body_i, m%body_j] == [rod%body_i, rod%body_j]) .and. norm2(a - end_of(suspension, rod, .false.)) < same .and. &
            norm2(b - end_of(suspension, rod, .true.)) < same) return
         call include(m%body_i, a)
         call include(m%body_j, b)
      end subroutine include_both

      subroutine include(body, at)
         integer, intent(in) :: body
         real(wp), intent(in) :: at(3)

         extents(body)%points = extents(body)%points + 1
         extents(body)%low = min(extents(body)%low, at)
         extents(body)%high = max(extents(body)%high, at)
      end subroutine include

   end subroutine find_extents

   !> Distance of a position from a box [m]; 0 inside.
   pure real(wp) function distance_to(extent, at)
      type(extent_t), intent(in) :: extent
      real(wp), intent(in) :: at(3)

      if (extent%points == 0) then
         distance_to = huge(1.0_wp)
      else
         distance_to = norm2(max(extent%low - at, at - extent%high, 0.0_wp))
      end if
   end function distance_to

end module ek_plausible_ends
