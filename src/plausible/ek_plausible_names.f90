!> Plausibility of the names of a deck: two hardpoints, bushings or joints whose names differ only in front and rear, low and top,
!> inner and outer, or left and right, and which lie the other way round.
module ek_plausible_names
   use ek_kinds, only: wp, millimetre
   use ek_text, only: lower, quoted
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t
   use ek_plausible_range, only: doubts_t, length
   use ek_plausible_shape, only: point_of
   implicit none(type, external)
   private
   public :: doubt_names, has_word, without_side

   integer, parameter :: rearward = 1, right = 2, up = 3, outboard = 4     !! directions from the first name of a pair to the second

   !> Two parts of names for opposite positions.
   type :: word_pair_t
      character(8) :: first, second
      integer :: direction
      character(16) :: wrong        !! relation of the first to the second if both are exchanged
   end type word_pair_t

   type(word_pair_t), parameter :: pairs(*) = [ &
      word_pair_t('front', 'rear', rearward, 'behind'), word_pair_t('f', 'r', rearward, 'behind'), &
      word_pair_t('low', 'top', up, 'above'), word_pair_t('low', 'high', up, 'above'), &
      word_pair_t('lower', 'upper', up, 'above'), word_pair_t('bottom', 'top', up, 'above'), &
      word_pair_t('inner', 'outer', outboard, 'farther out than'), &
      word_pair_t('inboard', 'outboard', outboard, 'farther out than'), &
      word_pair_t('left', 'right', right, 'right of'), word_pair_t('l', 'r', right, 'right of')]

contains

   !> Adds a remark on each pair of parts whose positions contradict their names. A pair of hardpoints is named once; their bushings
   !> are then not examined.
   subroutine doubt_names(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: j, k
      logical :: has_point

      has_point = .false.
      do k = 1, size(suspension%points)
         if (.not. suspension%points(k)%is_used) cycle
         do j = 1, size(suspension%points)
            if (j == k .or. .not. suspension%points(j)%is_used) cycle
            associate (a => suspension%points(k), b => suspension%points(j))
               call compare('point '//quoted(a%name), a%where, a%name, a%at, 'point '//quoted(b%name), b%name, b%at, has_point)
            end associate
         end do
      end do
      if (has_point) return
      do k = suspension%scalars + 1, size(suspension%elements)
         do j = suspension%scalars + 1, size(suspension%elements)
            if (j == k) cycle
            associate (a => suspension%elements(k), b => suspension%elements(j))
               call compare(element_label(a), a%where, a%name, point_of(suspension, a%measure%body_i, a%measure%arm_i), &
                  element_label(b), b%name, point_of(suspension, b%measure%body_i, b%measure%arm_i), has_point)
            end associate
         end do
      end do

   contains

      !> Adds a remark if the names of two parts differ in the parts of a pair, and their positions contradict these.
      subroutine compare(a, where, name_a, at_a, b, name_b, at_b, has_found)
         character(*), intent(in) :: a, where, name_a, b, name_b
         real(wp), intent(in) :: at_a(3), at_b(3)
         logical, intent(inout) :: has_found
         real(wp), parameter :: clearly = 20.0_wp*millimetre
         real(wp) :: ahead
         integer :: p

         p = pair_of(lower(name_a), lower(name_b))
         if (p == 0) return
         if (pairs(p)%direction == outboard) then
            ahead = abs(at_b(2)) - abs(at_a(2))
         else
            ahead = at_b(pairs(p)%direction) - at_a(pairs(p)%direction)
         end if
         if (ahead > -clearly) return
         has_found = .true.
         call doubts%examine(where, a)
         call doubts%add('names', 'it lies '//doubts%speak(length, -ahead)//' '//trim(pairs(p)%wrong)//' '//b// &
            ': are the coordinates of the two exchanged?')
      end subroutine compare

   end subroutine doubt_names

   !> Index of the pair whose first part is in the first name where the second part is in the second name, with all other parts
   !> equal; 0 if there is none. The parts of a name are separated by underscores.
   pure integer function pair_of(a, b) result(pair)
      character(*), intent(in) :: a, b             !! lower case
      integer :: head, tail, p

      pair = 0
      do head = 1, min(len(a), len(b))
         if (a(head:head) /= b(head:head)) exit
      end do
      head = index('_'//a(:head - 1), '_', back=.true.)        ! start of the first part that differs
      if (head > min(len(a), len(b))) return
      tail = head - 1 + index(a(head:)//'_', '_')              ! after this part
      do p = 1, size(pairs)
         if (a(head:min(tail - 1, len(a))) /= trim(pairs(p)%first)) cycle
         if (a(:head - 1)//trim(pairs(p)%second)//a(tail:) == b) pair = p
      end do
   end function pair_of

   !> A name without its side: 'left_lca', 'lca_left', 'lca_l' and 'l_lca' are 'lca'.
   pure function without_side(name) result(bare)
      character(*), intent(in) :: name
      character(:), allocatable :: bare
      character(5), parameter :: sides(4) = ['left ', 'right', 'l    ', 'r    ']
      integer :: k, n

      bare = name
      do k = 1, size(sides)
         n = len_trim(sides(k))
         if (index(lower(name), trim(sides(k))//'_') == 1) bare = name(n + 2:)
         if (index(lower(name)//' ', '_'//trim(sides(k))//' ', back=.true.) > 1) bare = name(:len(name) - n - 1)
      end do
   end function without_side

   !> Whether a name contains another name, between underscores: 'drop_link_lca' contains 'lca' and 'drop_link'.
   pure logical function has_word(name, word)
      character(*), intent(in) :: name, word
      has_word = index('_'//lower(name)//'_', '_'//lower(word)//'_') > 0
   end function has_word

end module ek_plausible_names
