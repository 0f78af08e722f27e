!> Positions for the names in a picture: without overlap, inside the picture, near their points, and covering as few drawn lines and
!> faces as possible.
module ek_scene_labels
   use ek_kinds, only: wp, pi
   use ek_scene, only: scene_t, run_t, part_ground, part_tyre, part_plate
   use ek_camera, only: camera_t, projection_t, new_projection, in_picture
   implicit none(type, external)
   private
   public :: placed_label_t, place_in_scene

   !> A placed name. Positions are shares of the picture's width, from the left, and of its height, from below.
   type :: placed_label_t
      real(wp) :: middle(2) = 0.0_wp, half(2) = 0.0_wp    !! centre of the label; half of its width and of its height
      real(wp) :: foot(2) = 0.0_wp                        !! end, at the label, of the line from the label to its point
      logical :: has_line = .false.
   end type placed_label_t

   ! The picture as pixels: 960 by 640, font size 11
   real(wp), parameter :: pixels(2) = [960.0_wp, 640.0_wp], letter = 6.6_wp, line_height = 15.0_wp
   real(wp), parameter :: margin = 3.0_wp              ! around a text
   real(wp), parameter :: legend_height = 0.115_wp     ! share that is kept free below
   integer, parameter :: cells(2) = [160, 106]         ! of the map of what is drawn
   integer, parameter :: rings = 26, directions = 24   ! tried around a point
   real(wp), parameter :: ring_step = 5.0_wp           ! pixels
   real(wp), parameter :: cover_price = 90.0_wp        ! pixels of distance that a free place is worth more than a covered one

contains

   !> Places the names one after the other, each at the position with the lowest cost, given the names already placed. If no
   !> position is free, the name is at its point.
   subroutine place_in_scene(scene, camera, placed)
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera                !! fitted
      type(placed_label_t), allocatable, intent(out) :: placed(:)
      type(projection_t) :: projection
      real(wp), allocatable :: drawn(:, :)
      real(wp) :: anchor(2), half(2), middle(2), away(2), price, least
      integer :: k, ring, direction

      allocate (placed(size(scene%labels)))
      projection = new_projection(camera)
      allocate (drawn(cells(1), cells(2)), source=0.0_wp)
      call mark_faces(scene%faces, projection, drawn)
      call mark_lines(scene%lines, projection, drawn)
      do k = 1, size(placed)
         anchor = in_picture(projection, scene%labels(k)%at)*pixels
         half = [0.5_wp*letter*letters_in(scene%labels(k)%text) + margin, 0.5_wp*line_height]
         least = huge(1.0_wp)
         do ring = 1, rings
            do direction = 0, directions - 1
               away = [cos(2*pi*direction/directions), sin(2*pi*direction/directions)]
               middle = anchor + away*(ring_step*ring + half)
               if (any(middle - half < 0.0_wp) .or. any(middle + half > pixels)) cycle
               if (middle(2) - half(2) < legend_height*pixels(2)) cycle
               if (is_taken(placed(:k - 1), middle, half)) cycle
               price = ring_step*ring + cover_price*covered(drawn, middle, half)
               if (price >= least) cycle
               least = price
               placed(k)%middle = middle
               placed(k)%has_line = ring > 3
            end do
         end do
         if (.not. least < huge(1.0_wp)) placed(k)%middle = anchor      ! no room at all
         placed(k)%half = half
         placed(k)%foot = max(placed(k)%middle - half, min(placed(k)%middle + half, anchor))
      end do
      do k = 1, size(placed)
         placed(k)%middle = placed(k)%middle/pixels
         placed(k)%half = placed(k)%half/pixels
         placed(k)%foot = placed(k)%foot/pixels
      end do
   end subroutine place_in_scene

   !> The number of characters in a UTF-8 string.
   pure integer function letters_in(text)
      character(*), intent(in) :: text
      integer :: k
      letters_in = count([(iand(iachar(text(k:k)), 192) /= 128, k=1, len(text))])
   end function letters_in

   !> Whether a name would overlap a name that is already placed.
   pure logical function is_taken(placed, middle, half)
      type(placed_label_t), intent(in) :: placed(:)
      real(wp), intent(in) :: middle(2), half(2)
      integer :: k

      is_taken = .false.
      do k = 1, size(placed)
         if (all(abs(placed(k)%middle - middle) < placed(k)%half + half)) is_taken = .true.
      end do
   end function is_taken

   !> The mean weight of the cells that a label would cover. A cell in which nothing is drawn has the weight 0.
   pure real(wp) function covered(drawn, middle, half)
      real(wp), intent(in) :: drawn(:, :), middle(2), half(2)
      integer :: low(2), high(2)

      low = cell_of(middle - half)
      high = cell_of(middle + half)
      covered = sum(drawn(low(1):high(1), low(2):high(2)))/product(high - low + 1)
   end function covered

   !> The cell of the picture that contains a position [pixels].
   pure function cell_of(place) result(cell)
      real(wp), intent(in) :: place(2)
      integer :: cell(2)
      cell = max(1, min(cells, ceiling(max(0.0_wp, min(1.0_wp, place/pixels))*cells)))
   end function cell_of

   !> Marks the boxes around faces, which are small. Transparent faces have a lower weight; the road is not marked.
   subroutine mark_faces(faces, projection, drawn)
      type(run_t), intent(in) :: faces
      type(projection_t), intent(in) :: projection
      real(wp), intent(inout) :: drawn(:, :)
      real(wp) :: place(2), least(2), most(2), weight
      integer :: k, v, low(2), high(2)

      do k = 1, faces%runs
         weight = 1.0_wp
         if (faces%kind(k) == part_ground) cycle
         if (faces%kind(k) == part_tyre) weight = 0.25_wp
         if (faces%kind(k) == part_plate) weight = 0.4_wp
         least = huge(1.0_wp)
         most = -huge(1.0_wp)
         do v = faces%first(k), faces%first(k + 1) - 1
            place = in_picture(projection, faces%at(:, v))*pixels
            least = min(least, place)
            most = max(most, place)
         end do
         low = cell_of(least)
         high = cell_of(most)
         drawn(low(1):high(1), low(2):high(2)) = max(weight, drawn(low(1):high(1), low(2):high(2)))
      end do
   end subroutine mark_faces

   !> Marks the cells through which lines pass.
   subroutine mark_lines(lines, projection, drawn)
      type(run_t), intent(in) :: lines
      type(projection_t), intent(in) :: projection
      real(wp), intent(inout) :: drawn(:, :)
      real(wp), parameter :: weight = 0.6_wp
      real(wp) :: from(2), to(2)
      integer :: k, v, n, steps, cell(2)

      do k = 1, lines%runs
         do v = lines%first(k), lines%first(k + 1) - 2
            from = in_picture(projection, lines%at(:, v))*pixels
            to = in_picture(projection, lines%at(:, v + 1))*pixels
            steps = 1 + ceiling(maxval(abs(to - from)/pixels*cells))
            do n = 0, steps
               cell = cell_of(from + (to - from)*n/steps)
               drawn(cell(1), cell(2)) = max(weight, drawn(cell(1), cell(2)))
            end do
         end do
      end do
   end subroutine mark_lines

end module ek_scene_labels
