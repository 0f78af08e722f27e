!> The points of one axle, chosen from a table or another file: the axle, the sides, and the points that the names stand for.
module ek_point_set
   use ek_kinds, only: wp
   use ek_text, only: str, lower, plural
   use ek_flaws, only: flaws_t, shown
   use ek_hardpoint, only: right_point
   use ek_point_name, only: point_names, wheel_centre, uca_front, uca_rear, lower_ball, upper_front_in, upper_front_out, &
      upper_rear_in, upper_rear_out, lower_in, lower_out, lower_rod_chassis, lower_rod_axle, upper_rod_chassis, upper_rod_axle, &
      lower_link_front, lower_link_rear, upper_link_front, upper_link_rear
   use ek_point_table, only: table_point_t, point_table_t
   use ek_frame_votes, only: point_set_t, wish_t
   implicit none(type, external)
   private
   public :: choose_points

contains

   !> Chooses the points of an axle. Of a table with both axles the option --axle gives the axle.
   subroutine choose_points(table, wish, points, flaws)
      type(point_table_t), intent(inout) :: table         !! points of the other axle are removed
      type(wish_t), intent(in) :: wish
      type(point_set_t), intent(out) :: points
      type(flaws_t), intent(inout) :: flaws
      integer :: k, kept

      call choose_axle(table, wish, points%axle, flaws)
      if (flaws%count() > 0) return
      points%length = table%length
      points%is_sided = any(table%points(:table%used)%side > 0 .and. (table%points(:table%used)%axle == 0 .or. &
         table%points(:table%used)%axle == points%axle))
      kept = 0
      do k = 1, table%used
         if (points%axle > 0 .and. table%points(k)%axle > 0 .and. table%points(k)%axle /= points%axle) cycle
         kept = kept + 1
         if (kept /= k) call swap(table%points(kept), table%points(k))
      end do
      call take_other_centre(table, kept, points)
      table%used = kept
      call name_five_links(table%points(:kept))
      call name_rods(table%points(:kept), points%has_front_ends)
      call take_points(table%points(:kept), points, flaws)
   end subroutine choose_points

   !> Takes the axle of the option or of the table. A table with both axles requires the option.
   subroutine choose_axle(table, wish, axle, flaws)
      type(point_table_t), intent(in) :: table
      type(wish_t), intent(in) :: wish
      integer, intent(out) :: axle
      type(flaws_t), intent(inout) :: flaws
      logical :: has(2)

      axle = 0
      has = [any(table%points(:table%used)%axle == 1), any(table%points(:table%used)%axle == 2)]
      if (wish%axle /= '') then
         axle = findloc(['front', 'rear '] == lower(wish%axle), .true., dim=1)
         if (axle == 0) then
            call flaws%add(0, '--axle must be front or rear, found '//shown(trim(wish%axle)))
         else if (any(has) .and. .not. has(axle)) then
            call flaws%add(0, 'the table has no '//trim(wish%axle)//' axle')
         end if
      else if (all(has)) then
         call flaws%add(0, 'the table has both axles; give --axle front or --axle rear')
      else
         axle = findloc(has, .true., dim=1)
      end if
   end subroutine choose_axle

   !> Takes the wheel centre of the other axle, which gives the wheelbase.
   subroutine take_other_centre(table, kept, points)
      type(point_table_t), intent(in) :: table
      integer, intent(in) :: kept
      type(point_set_t), intent(inout) :: points
      integer :: k

      do k = kept + 1, table%used
         if (table%points(k)%point /= wheel_centre) cycle
         if (points%has_other .and. table%points(k)%side == right_point) cycle
         points%has_other = .true.
         points%other_centre = table%points(k)%at
      end do
   end subroutine take_other_centre

   !> Renames the points of a five-link axle: 'upper front inner' is the end of a link, not the pivot of an arm.
   subroutine name_five_links(list)
      type(table_point_t), intent(inout) :: list(:)
      integer, parameter :: arm(3) = [uca_front, uca_rear, lower_ball], link(3) = [upper_front_in, upper_rear_in, lower_out]
      integer :: k, j

      if (.not. any(list%point == upper_front_out .or. list%point == upper_rear_out)) return
      do k = 1, size(list)
         do j = 1, size(arm)
            if (list(k)%point == arm(j)) list(k)%point = link(j)
         end do
      end do
   end subroutine name_five_links

   !> Renames the ends of the rods of a solid axle: the front ends are those on the chassis (check_ends of ek_point_kind), and
   !> 'lower link chassis' belongs to 'lower link axle'.
   pure subroutine name_rods(list, has_front_ends)
      type(table_point_t), intent(inout) :: list(:)
      logical, intent(out) :: has_front_ends
      integer, parameter :: ends(4) = [lower_link_front, lower_link_rear, upper_link_front, upper_link_rear], &
         rods(4) = [lower_rod_chassis, lower_rod_axle, upper_rod_chassis, upper_rod_axle]
      integer :: k, j

      has_front_ends = .false.
      do j = 1, size(ends)
         do k = 1, size(list)
            if (list(k)%point /= ends(j)) cycle
            list(k)%point = rods(j)
            has_front_ends = .true.
         end do
      end do
      if (.not. any(list%point == lower_rod_axle)) return
      where (list%point == lower_in) list%point = lower_rod_chassis
   end subroutine name_rods

   !> Puts the points on their sides. The same point twice is an error: the first one, and the number of the others.
   subroutine take_points(list, points, flaws)
      type(table_point_t), intent(in) :: list(:)
      type(point_set_t), intent(inout) :: points
      type(flaws_t), intent(inout) :: flaws
      integer :: k, half, first, again

      first = 0
      again = 0
      do k = 1, size(list)
         if (list(k)%point <= 0) cycle
         half = merge(2, 1, list(k)%side == right_point)
         associate (this => points%half(half), point => list(k)%point)
            if (this%has(point)) then
               if (again == 0) first = k
               again = again + 1
               cycle
            end if
            this%has(point) = .true.
            this%at(:, point) = list(k)%at
            this%line(point) = list(k)%line
         end associate
      end do
      if (again == 0) return
      associate (this => list(first))
         half = merge(2, 1, this%side == right_point)
         call flaws%add(this%line, 'expected '//trim(point_names(this%point))//' once, found '//shown(trim(this%name))// &
            ' again (first in line '//str(points%half(half)%line(this%point))//')'//more(again - 1))
      end associate
   end subroutine take_points

   !> A phrase for further points that are given twice.
   pure function more(count) result(text)
      integer, intent(in) :: count
      character(:), allocatable :: text

      text = ''
      if (count > 0) text = '; and '//plural(count, 'more point', 'more points')//' twice'
   end function more

   subroutine swap(one, other)
      type(table_point_t), intent(inout) :: one, other
      type(table_point_t) :: kept

      kept = one
      one = other
      other = kept
   end subroutine swap

end module ek_point_set
