!> Suspensions of Project Chrono (JSON of Chrono::Vehicle): the hardpoints of an axle. The format defines the frame: x forward,
!> y left, z up, in m, for the left half. It does not give the axle, the tyre and the road.
!>
!> Read are the templates of `templates`, by the names of their points. Masses, springs, dampers and bushings are not read; the
!> deck lists them.
module ek_chrono
   use ek_kinds, only: wp
   use ek_text, only: str, did_you_mean
   use ek_flaws, only: flaws_t, shown
   use ek_hardpoint, only: single_point
   use ek_json_tree, only: json_tree_t, parse_json, find_leaf, has_branch
   use ek_point_name, only: wheel_centre, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, tie_inner, tie_outer, &
      strut_top, strut_low, arm_inner, arm_outer, upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, &
      lower_out, trailing_front, trailing_rear, point_names
   use ek_point_table, only: point_table_t, table_point_t
   use ek_point_deck, only: axle_facts_t
   implicit none(type, external)
   private
   public :: is_json, is_chrono, parse_chrono

   !> A point of a template: its path in the file.
   type :: place_t
      character(22) :: template
      integer :: point
      character(48) :: path
   end type place_t

   character(*), parameter :: upper_arm = 'Upper Control Arm/Location ', lower_arm = 'Lower Control Arm/Location '
   character(*), parameter :: arms = 'DoubleWishbone', reduced = 'DoubleWishboneReduced', strut = 'MacPhersonStrut', &
      links = 'MultiLink', arm = 'SemiTrailingArm', every = ''
   character(22), parameter :: templates(5) = [character(22) :: arms, reduced, strut, links, arm]
   type(place_t), parameter :: places(*) = [ &
      place_t(every, wheel_centre, 'Spindle/COM'), &
      place_t(arms, uca_front, upper_arm//'Chassis Front'), place_t(arms, uca_rear, upper_arm//'Chassis Back'), &
      place_t(arms, upper_ball, upper_arm//'Upright'), &
      place_t(arms, lca_front, lower_arm//'Chassis Front'), place_t(arms, lca_rear, lower_arm//'Chassis Back'), &
      place_t(arms, lower_ball, lower_arm//'Upright'), &
      place_t(strut, lca_front, 'Control Arm/Location Chassis Front'), &
      place_t(strut, lca_rear, 'Control Arm/Location Chassis Back'), place_t(strut, lower_ball, 'Control Arm/Location Upright'), &
      place_t(strut, strut_low, 'Spring/Location Upright'), place_t(strut, strut_top, 'Spring/Location Chassis'), &
      place_t(links, upper_front_in, 'Upper Arm/Location Chassis Front'), &
      place_t(links, upper_front_out, 'Upper Arm/Location Upright'), &
      place_t(links, upper_rear_in, 'Upper Arm/Location Chassis Back'), &
      place_t(links, upper_rear_out, 'Upper Arm/Location Upright'), &
      place_t(links, lower_in, 'Lateral/Location Chassis'), place_t(links, lower_out, 'Lateral/Location Upright'), &
      place_t(links, trailing_front, 'Trailing Link/Location Chassis'), &
      place_t(links, trailing_rear, 'Trailing Link/Location Upright'), &
      place_t(arm, arm_inner, 'Trailing Arm/Location Chassis Inner'), &
      place_t(arm, arm_outer, 'Trailing Arm/Location Chassis Outer'), &
      place_t(every, tie_inner, 'Tierod/Location Chassis'), place_t(every, tie_outer, 'Tierod/Location Upright')]

   !> Objects of the files that are not read.
   character(*), parameter :: unread(5) = [character(6) :: 'Spring', 'Shock', 'Axle', 'Mass', 'Damper']

contains

   !> Whether a text is JSON.
   pure logical function is_json(text)
      character(*), intent(in) :: text
      integer :: at

      at = verify(text, ' '//achar(9)//achar(10)//achar(13))
      is_json = .false.
      if (at > 0) is_json = text(at:at) == '{'
   end function is_json

   !> Whether a text in JSON may be a file of Chrono: it has the name "Type" or "Template".
   pure logical function is_chrono(text)
      character(*), intent(in) :: text
      is_chrono = index(text, '"Type"') > 0 .or. index(text, '"Template"') > 0
   end function is_chrono

   !> Reads the points of a suspension.
   subroutine parse_chrono(text, table, facts, flaws)
      character(*), intent(in) :: text
      type(point_table_t), intent(out) :: table
      type(axle_facts_t), intent(out) :: facts
      type(flaws_t), intent(inout) :: flaws
      type(json_tree_t) :: tree
      character(:), allocatable :: template
      integer :: k

      allocate (table%points(size(places) + size(unread)))
      call parse_json(text, tree, flaws)
      if (flaws%count() > 0) return
      call find_template(tree, template, flaws)
      if (flaws%count() > 0) return
      do k = 1, size(places)
         if (places(k)%template /= every .and. places(k)%template /= template) cycle
         if (template == arm .and. index(places(k)%path, 'Tierod') == 1) cycle
         call take_point(tree, places(k), table, flaws)
      end do
      if (table%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected the points of a suspension, found none')
      do k = 1, size(unread)
         if (.not. has_branch(tree, trim(unread(k)))) cycle
         table%used = table%used + 1
         table%points(table%used) = table_point_t(name=unread(k), point=0, line=line_of(tree, trim(unread(k))))
      end do
      table%length = 3                       ! m
      call take_angle(tree, 'Camber Angle (deg)', facts%camber, facts%has_camber, flaws)
      call take_angle(tree, 'Toe Angle (deg)', facts%toe, facts%has_toe, flaws)
   end subroutine parse_chrono

   !> Finds the template of a suspension. The reduced double wishbone has the points of the double wishbone.
   subroutine find_template(tree, template, flaws)
      type(json_tree_t), intent(in) :: tree
      character(:), allocatable, intent(out) :: template
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      template = ''
      k = find_leaf(tree, 'Type')
      if (k == 0) then
         call flaws%add(0, 'expected the JSON of a Chrono suspension ("Type": "Suspension"), found JSON without "Type"')
         return
      else if (tree%leaves(k)%text /= 'Suspension') then
         call flaws%add(tree%leaves(k)%line, 'expected "Type": "Suspension", found '//shown(tree%leaves(k)%text)// &
            '; import the file of a suspension')
         return
      end if
      k = find_leaf(tree, 'Template')
      if (k == 0) then
         call flaws%add(0, 'expected "Template", found none')
         return
      end if
      template = tree%leaves(k)%text
      if (any(templates == template)) then
         if (template == reduced) template = arms
      else
         call flaws%add(tree%leaves(k)%line, 'the template '//shown(template)//' is not read'//did_you_mean(template, templates)// &
            '; give its points as a table (name, x, y, z)')
      end if
   end subroutine find_template

   !> Takes a point: three numbers.
   subroutine take_point(tree, place, table, flaws)
      type(json_tree_t), intent(in) :: tree
      type(place_t), intent(in) :: place
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      type(table_point_t) :: point
      integer :: c, k

      point%name = place%path
      point%point = place%point
      point%side = single_point
      do c = 1, 3
         k = find_leaf(tree, trim(place%path)//'/'//str(c))
         if (k == 0) then
            call flaws%add(line_of(tree, trim(place%path)), 'expected three numbers for '//shown(trim(place%path))//' ('// &
               trim(point_names(place%point))//'), found '//str(c - 1))
            return
         else if (.not. tree%leaves(k)%is_number) then
            call flaws%add(tree%leaves(k)%line, 'expected a number for '//shown(trim(place%path))//', found '// &
               shown(tree%leaves(k)%text))
            return
         end if
         point%at(c) = tree%leaves(k)%value
         point%line = tree%leaves(k)%line
      end do
      if (find_leaf(tree, trim(place%path)//'/4') > 0) then
         call flaws%add(point%line, 'expected three numbers for '//shown(trim(place%path))//', found more')
         return
      end if
      table%used = table%used + 1
      table%points(table%used) = point
   end subroutine take_point

   !> The line of the first value of an object or a list; 0 if it has none.
   pure integer function line_of(tree, path) result(line)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      integer :: k

      line = 0
      do k = 1, tree%used
         if (index(tree%leaves(k)%path, path) /= 1) cycle
         line = tree%leaves(k)%line
         return
      end do
   end function line_of

   !> Takes a static angle [deg]: camber is positive if the top leans outboard, toe is positive if the front edge is inboard.
   subroutine take_angle(tree, key, value, has, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: key
      real(wp), intent(inout) :: value
      logical, intent(inout) :: has
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      k = find_leaf(tree, key)
      has = k > 0
      if (.not. has) return
      has = tree%leaves(k)%is_number
      if (has) has = abs(tree%leaves(k)%value) < 45.0_wp
      if (has) then
         value = tree%leaves(k)%value
      else
         call flaws%add(tree%leaves(k)%line, 'expected '//shown(key)//' between -45 and 45, found '//shown(tree%leaves(k)%text))
      end if
   end subroutine take_angle

end module ek_chrono
