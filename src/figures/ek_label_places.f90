!> Positions for the names of points in a panel, without overlap.
module ek_label_places
   use ek_kinds, only: wp
   implicit none(type, external)
   private
   public :: label_place_t, place_labels

   !> The position at which the name of a point begins, as shares of the panel's width and height. With is_left, the name is
   !> to the left of the point and ends at this position.
   type :: label_place_t
      real(wp) :: x = 0.0_wp, y = 0.0_wp
      logical :: is_left = .false.
   end type label_place_t

   real(wp), parameter :: gap = 0.02_wp           !! distance between a point and its name, as a share of the panel's width
   integer, parameter :: most_steps = 80          !! number of trial shifts of a name; the step is a quarter of its height

contains

   !> Places the names of points one after the other, each as near to its point as possible. A name is to the right of its
   !> point, or to the left if it would cross the right edge of the panel. A name is moved up and down in small steps until it
   !> overlaps no other name and no point. If no trial position is free, the last one is used.
   pure subroutine place_labels(x, y, widths, height, places)
      real(wp), intent(in) :: x(:), y(:)          !! shares of the panel
      real(wp), intent(in) :: widths(:), height   !! size of the names, as shares of the panel
      type(label_place_t), intent(out) :: places(:)
      real(wp) :: boxes(4, size(x)), box(4), shift
      integer :: k, step

      do k = 1, size(x)
         places(k)%is_left = x(k) + gap + widths(k) > 1.0_wp
         places(k)%x = x(k) + merge(-gap, gap, places(k)%is_left)
         box(1) = places(k)%x - merge(widths(k), 0.0_wp, places(k)%is_left)
         box(2) = box(1) + widths(k)
         do step = 0, most_steps
            shift = 0.25_wp*height*((step + 1)/2)
            if (mod(step, 2) == 0) shift = -shift
            places(k)%y = min(max(y(k) + shift, 0.5_wp*height), 1.0_wp - 0.5_wp*height)
            box(3:4) = places(k)%y + [-0.5_wp, 0.5_wp]*height
            if (is_free(box, boxes(:, :k - 1))) exit
         end do
         boxes(:, k) = box
      end do

   contains

      !> Whether a box (left, right, bottom, top) overlaps no other box and no point.
      pure logical function is_free(box, others)
         real(wp), intent(in) :: box(4), others(:, :)
         integer :: j

         is_free = .true.
         do j = 1, size(others, 2)
            if (box(1) < others(2, j) .and. others(1, j) < box(2) .and. box(3) < others(4, j) .and. others(3, j) < box(4)) &
               is_free = .false.
         end do
         do j = 1, size(x)
            if (box(1) < x(j) + 0.01_wp .and. x(j) - 0.01_wp < box(2) .and. box(3) < y(j) .and. y(j) < box(4)) is_free = .false.
         end do
      end function is_free

   end subroutine place_labels

end module ek_label_places
