!> Kinds of suspension that a set of hardpoints may be: the points that each kind needs, and what is missing.
module ek_point_kind
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_point_name, only: point_count, point_names, nearest_point, wheel_centre, lca_front, lca_rear, lower_ball, uca_front, &
      uca_rear, upper_ball, tie_inner, tie_outer, toe_inner, toe_outer, strut_top, strut_low, arm_inner, arm_outer, &
      upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, trailing_rear, &
      kingpin_low, kingpin_top, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, &
      drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, triangle_chassis, triangle_axle, axle_pivot, &
      watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever
   use ek_point_table, only: point_table_t
   use ek_frame_votes, only: point_set_t
   implicit none(type, external)
   private
   public :: kinds, double_wishbone, mcpherson, five_link, trailing_arm, four_link_axle, three_link_axle, de_dion, is_solid, &
      find_kind, incomplete, check_rod, nearest_text

   integer, parameter :: most_needed = 14

   !> A kind of suspension with the points that it needs. `rod` is the tie rod or the toe link.
   type :: kind_t
      character(20) :: name
      character(60) :: title
      logical :: has_rod
      integer :: needs(most_needed)
   end type kind_t

   integer, parameter :: double_wishbone = 1, mcpherson = 2, five_link = 3, trailing_arm = 4, four_link_axle = 5, &
      three_link_axle = 6, de_dion = 7
   type(kind_t), parameter :: kinds(7) = [ &
      kind_t('double wishbone', 'Double wishbone axle', .true., &
      [wheel_centre, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('McPherson', 'McPherson axle', .true., &
      [wheel_centre, lca_front, lca_rear, lower_ball, strut_low, strut_top, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('five-link', 'Five-link axle', .true., &
      [wheel_centre, upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, &
      trailing_rear, 0, 0, 0, 0, 0]), &
      kind_t('trailing arm', 'Trailing arm axle', .false., &
      [wheel_centre, arm_inner, arm_outer, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('solid four-link', 'Solid axle, four links', .false., &
      [wheel_centre, kingpin_low, kingpin_top, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, &
      tie_outer, drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, 0, 0]), &
      kind_t('solid three-link', 'Solid axle, two links and triangle', .false., &
      [wheel_centre, lower_rod_chassis, lower_rod_axle, triangle_chassis, triangle_axle, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('de Dion', 'De Dion axle with Watt linkage', .false., &
      [wheel_centre, axle_pivot, watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, 0, 0, 0, 0, 0, 0, 0, 0])]

contains

   !> Whether both wheels are on one axle tube.
   pure logical function is_solid(kind)
      integer, intent(in) :: kind
      is_solid = any([four_link_axle, three_link_axle, de_dion] == kind)
   end function is_solid

   !> Finds the kind of suspension for which the fewest points are missing; 0 if half of the points of every kind or more are
   !> missing.
   subroutine find_kind(points, kind, missing)
      type(point_set_t), intent(in) :: points
      integer, intent(out) :: kind, missing
      integer :: k, lacking, needed

      kind = 0
      missing = huge(missing)
      do k = 1, size(kinds)
         call count_missing(points, k, lacking, needed)
         if (2*lacking >= needed .or. lacking >= missing) cycle
         kind = k
         missing = lacking
      end do
   end subroutine find_kind

   subroutine count_missing(points, kind, lacking, needed)
      type(point_set_t), intent(in) :: points
      integer, intent(in) :: kind
      integer, intent(out) :: lacking, needed
      logical :: has(point_count)

      has = points%half(1)%has .or. points%half(2)%has
      associate (needs => kinds(kind)%needs)
         needed = count(needs > 0)
         lacking = count(.not. has(pack(needs, needs > 0)))
      end associate
      if (.not. kinds(kind)%has_rod) return
      needed = needed + 2
      lacking = lacking + min(count(.not. has([tie_inner, tie_outer])), count(.not. has([toe_inner, toe_outer])))
   end subroutine count_missing

   !> What is missing, and the names that were not recognised, on at most eight lines.
   function incomplete(points, kind, table) result(text)
      type(point_set_t), intent(in) :: points
      integer, intent(in) :: kind
      type(point_table_t), intent(in) :: table
      character(:), allocatable :: text
      logical :: has(point_count)
      integer :: k, told

      has = points%half(1)%has .or. points%half(2)%has
      text = ''
      do k = 1, most_needed
         if (kinds(kind)%needs(k) == 0) cycle
         if (.not. has(kinds(kind)%needs(k))) text = text//', '//trim(point_names(kinds(kind)%needs(k)))
      end do
      if (kinds(kind)%has_rod .and. .not. (all(has([tie_inner, tie_outer])) .or. all(has([toe_inner, toe_outer])))) &
         text = text//', tie_rod_inner and tie_rod_outer (or toe_inner and toe_outer)'
      text = 'the points of a '//trim(kinds(kind)%name)//' axle are not complete; missing: '//text(3:)
      told = 0
      do k = 1, table%used
         if (table%points(k)%point /= -1) cycle
         told = told + 1
         if (told <= 6) text = text//new_line('a')//'  line '//str(table%points(k)%line)//': '// &
            shown(trim(table%points(k)%name))//' is not recognised'//nearest_text(trim(table%points(k)%name))
      end do
      if (told > 6) text = text//new_line('a')//'  and '//str(told - 6)//' more names'
   end function incomplete

   !> Phrase with the nearest known name; '' if there is none.
   function nearest_text(name) result(words)
      character(*), intent(in) :: name
      character(:), allocatable :: words

      words = nearest_point(name)
      if (words /= '') words = '; nearest known name: '//words
   end function nearest_text

   !> Checks that the axle is known, if it has tie rods: they end on a rack of a front axle, and on the chassis of a rear axle.
   subroutine check_rod(points, kind, flaws)
      type(point_set_t), intent(in) :: points
      integer, intent(in) :: kind
      type(flaws_t), intent(inout) :: flaws

      if (.not. kinds(kind)%has_rod .or. points%axle > 0) return
      if (.not. any(points%half(1)%has(tie_inner) .or. points%half(2)%has([tie_inner]))) return
      call flaws%add(0, 'the file does not name the axle; give --axle front (the tie rods end on a rack) or --axle rear (they '// &
         'end on the chassis)')
   end subroutine check_rod

end module ek_point_kind
