!> Kinds of suspension that a set of hardpoints may be: the points that each kind needs, and what is missing.
module ek_point_kind
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_point_name, only: point_count, point_names, nearest_point, wheel_centre, lca_front, lca_rear, lower_ball, uca_front, &
      uca_rear, upper_ball, tie_inner, tie_outer, toe_inner, toe_outer, strut_top, strut_low, arm_inner, arm_outer, &
      upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, trailing_rear, &
      kingpin_low, kingpin_top, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, panhard_chassis, &
      panhard_axle, drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, triangle_chassis, triangle_axle, axle_pivot, &
      watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, axle_guide, drag_link_knuckle, arm_ball, &
      upper_lateral_in, upper_lateral_out, lower_lateral_in, lower_lateral_out
   use ek_point_table, only: point_table_t
   use ek_point_vote, only: half_t
   use ek_frame_votes, only: point_set_t
   implicit none(type, external)
   private
   public :: kinds, double_wishbone, mcpherson, five_link, trailing_arm, lateral_arm, is_solid, has_knuckles, find_kind, &
      incomplete, check_rod, check_ends, nearest_text
   public :: by_links, by_triangle, by_watt, by_slide, by_pipe, crank_and_rod, crank_and_rods, knuckle_link

   integer, parameter :: most_needed = 14

   !> Guides of an axle tube: four links, two links and a triangle, a ball and a Watt linkage, a slide that rolls, or a ball and a
   !> Panhard rod.
   integer, parameter :: by_links = 1, by_triangle = 2, by_watt = 3, by_slide = 4, by_pipe = 5
   !> Steering of a solid axle: a bell crank moves the tie rod between the knuckles, a bell crank moves a tie rod to each knuckle,
   !> or a drag link moves one knuckle, with a tie rod to the other one.
   integer, parameter :: crank_and_rod = 1, crank_and_rods = 2, knuckle_link = 3

   !> A kind of suspension with the points that it needs. `rod` is the tie rod or the toe link.
   type :: kind_t
      character(20) :: name
      character(60) :: title
      logical :: has_rod = .false.
      integer :: guide = 0                   !! of an axle tube; 0: independent wheels
      integer :: steering = 0                !! of a solid axle; 0: the wheels are on the tube
      integer :: needs(most_needed) = 0
   end type kind_t

   integer, parameter :: double_wishbone = 1, mcpherson = 2, five_link = 3, trailing_arm = 4, lateral_arm = 5
   type(kind_t), parameter :: kinds(*) = [ &
      kind_t('double wishbone', 'Double wishbone axle', has_rod=.true., &
      needs=[wheel_centre, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('McPherson', 'McPherson axle', has_rod=.true., &
      needs=[wheel_centre, lca_front, lca_rear, lower_ball, strut_low, strut_top, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('five-link', 'Five-link axle', has_rod=.true., &
      needs=[wheel_centre, upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, &
      trailing_rear, 0, 0, 0, 0, 0]), &
      kind_t('trailing arm', 'Trailing arm axle', &
      needs=[wheel_centre, arm_inner, arm_outer, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('arm and two links', 'Trailing arms, each on two lateral links', &
      needs=[wheel_centre, arm_ball, upper_lateral_in, upper_lateral_out, lower_lateral_in, lower_lateral_out, 0, 0, 0, 0, 0, 0, &
      0, 0]), &
      kind_t('solid four-link', 'Solid axle, four links', guide=by_links, steering=crank_and_rod, &
      needs=[wheel_centre, kingpin_low, kingpin_top, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, &
      tie_outer, drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, 0, 0]), &
      kind_t('live four-link', 'Solid axle, four links', guide=by_links, &
      needs=[wheel_centre, upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('solid three-link', 'Solid axle, two links and triangle', guide=by_triangle, &
      needs=[wheel_centre, lower_rod_chassis, lower_rod_axle, triangle_chassis, triangle_axle, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('steered three-link', 'Steered solid axle, two links and triangle', guide=by_triangle, steering=crank_and_rods, &
      needs=[wheel_centre, lower_rod_chassis, lower_rod_axle, triangle_chassis, triangle_axle, kingpin_low, kingpin_top, &
      tie_outer, drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, 0, 0]), &
      kind_t('de Dion', 'De Dion axle with Watt linkage', guide=by_watt, &
      needs=[wheel_centre, axle_pivot, watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, 0, 0, 0, 0, 0, &
      0, 0, 0]), &
      kind_t('steered de Dion', 'Steered de Dion axle with Watt linkage', guide=by_watt, steering=knuckle_link, &
      needs=[wheel_centre, axle_pivot, watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, kingpin_low, &
      kingpin_top, tie_outer, drag_link_chassis, drag_link_knuckle, 0, 0, 0]), &
      kind_t('leaf spring', 'Solid axle on leaf springs', guide=by_slide, &
      needs=[wheel_centre, axle_guide, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('steered leaf spring', 'Steered solid axle on leaf springs', guide=by_slide, steering=knuckle_link, &
      needs=[wheel_centre, axle_guide, kingpin_low, kingpin_top, tie_outer, drag_link_chassis, drag_link_knuckle, 0, 0, 0, 0, 0, &
      0, 0]), &
      kind_t('push pipe', 'Solid axle with push pipe and Panhard rod', guide=by_pipe, &
      needs=[wheel_centre, axle_pivot, panhard_chassis, panhard_axle, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), &
      kind_t('steered push pipe', 'Steered solid axle with push pipe and Panhard rod', guide=by_pipe, steering=knuckle_link, &
      needs=[wheel_centre, axle_pivot, panhard_chassis, panhard_axle, kingpin_low, kingpin_top, tie_outer, drag_link_chassis, &
      drag_link_knuckle, 0, 0, 0, 0, 0])]

contains

   !> Whether both wheels are on one axle tube.
   pure logical function is_solid(kind)
      integer, intent(in) :: kind
      is_solid = kinds(kind)%guide > 0
   end function is_solid

   !> Whether the wheels of a solid axle are on knuckles, not on the tube.
   pure logical function has_knuckles(kind)
      integer, intent(in) :: kind
      has_knuckles = kinds(kind)%steering > 0
   end function has_knuckles

   !> Finds the kind of suspension for which the fewest points are missing, and of those the one with most points. It is 0 if half
   !> of the points of every kind or more are missing.
   subroutine find_kind(points, kind, missing)
      type(point_set_t), intent(in) :: points
      integer, intent(out) :: kind, missing
      integer :: k, lacking, needed, most

      kind = 0
      missing = huge(missing)
      most = 0
      do k = 1, size(kinds)
         call count_missing(points, k, lacking, needed)
         if (2*lacking >= needed .or. lacking > missing) cycle
         if (lacking == missing .and. needed <= most) cycle
         kind = k
         missing = lacking
         most = needed
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
      if (is_solid(kind) .and. .not. has_knuckles(kind) .and. any(has([kingpin_low, kingpin_top]))) lacking = needed   ! steered
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

   !> Checks the ends of the rods of a solid axle without steering: along the car, the end on the tube is nearer to the wheel centre
   !> than the end on the chassis. Otherwise, the names are exchanged, or front ends are on the tube.
   subroutine check_ends(half, forward, kind, flaws)
      type(half_t), intent(in) :: half
      integer, intent(in) :: forward                   !! column
      integer, intent(in) :: kind
      type(flaws_t), intent(inout) :: flaws
      integer, parameter :: tube(2) = [lower_rod_axle, upper_rod_axle], chassis(2) = [lower_rod_chassis, upper_rod_chassis]
      integer :: k

      if (kinds(kind)%guide /= by_links .or. has_knuckles(kind)) return
      do k = 1, size(tube)
         if (from_wheel(tube(k)) < from_wheel(chassis(k))) cycle
         call flaws%add(half%line(tube(k)), 'expected the end of the rod on the axle nearer to the wheel centre than the end '// &
            'on the chassis (line '//str(half%line(chassis(k)))//'), along the car; name the ends '//trim(point_names(tube(k)))// &
            ' and '//trim(point_names(chassis(k))))
      end do

   contains

      !> Distance of a point from the wheel centre along the car.
      pure real(wp) function from_wheel(point)
         integer, intent(in) :: point
         from_wheel = abs(half%at(abs(forward), point) - half%at(abs(forward), wheel_centre))
      end function from_wheel

   end subroutine check_ends

end module ek_point_kind
