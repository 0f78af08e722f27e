!> Suspensions of Project Chrono (JSON of Chrono::Vehicle): hardpoints, springs, stops and bushings of an axle. The format defines
!> the frame: x forward, y left, z up, in m, for the left half. It does not give the axle, the tyre and the road.
!>
!> The templates and the names of their points are in ek_chrono_template. ek_chrono_parts reads springs and bushings.
module ek_chrono
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_hardpoint, only: single_point
   use ek_json_tree, only: json_tree_t, parse_json, find_leaf, has_branch, branch_line
   use ek_point_name, only: point_names, strut_top, strut_low, damper_top, damper_low, spring_top, spring_low
   use ek_point_table, only: point_table_t, table_point_t
   use ek_axle_facts, only: axle_facts_t, spring_slot, damper_slot, upper_slot, lower_slot, rod_slot
   use ek_chrono_template, only: templates, find_template, is_place_of, places, why_not_read, arms, strut, links, arm, solid, &
      watt, leaf, lateral, toe_bar, cranks
   use ek_chrono_parts, only: take_spring, take_bushing, take_axes, take_angle
   implicit none(type, external)
   private
   public :: is_json, is_chrono, parse_chrono

contains

   !> Whether a text is JSON, perhaps below comments.
   pure logical function is_json(text)
      character(*), intent(in) :: text
      integer :: at, step

      is_json = .false.
      at = 1
      do while (at <= len(text))
         step = verify(text(at:), ' '//achar(9)//achar(10)//achar(13))
         if (step == 0) return
         at = at + step - 1
         is_json = text(at:at) == '{'
         if (is_json .or. at == len(text)) return
         if (text(at:at + 1) /= '//') return
         step = index(text(at:), achar(10))
         if (step == 0) return
         at = at + step
      end do
   end function is_json

   !> Whether a text in JSON may be a file of Chrono: it has the name "Type" or "Template".
   pure logical function is_chrono(text)
      character(*), intent(in) :: text
      is_chrono = index(text, '"Type"') > 0 .or. index(text, '"Template"') > 0
   end function is_chrono

   !> Reads a suspension.
   subroutine parse_chrono(text, table, facts, flaws)
      character(*), intent(in) :: text
      type(point_table_t), intent(out) :: table
      type(axle_facts_t), intent(out) :: facts
      type(flaws_t), intent(inout) :: flaws
      type(json_tree_t) :: tree
      type(message_list_t) :: missing
      integer :: k, template

      allocate (table%points(size(places) + 4))
      call parse_json(text, tree, flaws)
      if (flaws%count() > 0) return
      call take_template(tree, template, flaws)
      if (flaws%count() > 0) return
      do k = 1, size(places)
         if (.not. is_place_of(k, template)) cycle
         if (index(places(k)%path, 'Trackbar') == 1 .and. .not. has_branch(tree, 'Trackbar')) cycle
         if (branch_line(tree, trim(places(k)%path)//'/') == 0) then
            call missing%add(trim(places(k)%path))
         else
            call take_point(tree, places(k)%point, trim(places(k)%path), table, flaws)
         end if
      end do
      if (missing%count() > 0) then            ! the cause alone: of another template, springs are elsewhere, too
         call flaws%add(0, missing_points(missing, trim(templates(template)%name)))
         return
      end if
      table%length = 3                       ! m
      call take_angle(tree, 'Camber Angle (deg)', facts%camber, facts%has_camber, facts%camber_line, flaws)
      call take_angle(tree, 'Toe Angle (deg)', facts%toe, facts%has_toe, facts%toe_line, flaws)
      call take_springs(tree, template, table, facts, flaws)
      call take_bushings(tree, template, facts, flaws)
      call explain(tree, template, facts)
   end subroutine parse_chrono

   !> Finds the template of a suspension.
   subroutine take_template(tree, template, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(out) :: template                 !! index in templates
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      template = 0
      k = find_leaf(tree, 'Type')
      if (k == 0) then
         call flaws%add(0, 'expected the JSON of a Chrono suspension ("Type": "Suspension"), found JSON without "Type"')
         return
      else if (find_leaf(tree, 'Vehicle/Input File') > 0) then
         k = find_leaf(tree, 'Vehicle/Input File')
         call flaws%add(tree%leaves(k)%line, 'expected a suspension, found a list of parts; import the file of its vehicle, '// &
            shown(tree%leaves(k)%text))
         return
      else if (tree%leaves(k)%text /= 'Suspension') then
         call flaws%add(tree%leaves(k)%line, 'expected "Type": "Suspension", found '//shown(tree%leaves(k)%text)// &
            '; import the file of a suspension, or of a vehicle')
         return
      end if
      k = find_leaf(tree, 'Template')
      if (k == 0) then
         call flaws%add(0, 'expected "Template", found none')
         return
      end if
      template = find_template(tree%leaves(k)%text)
      if (template == 0) call flaws%add(tree%leaves(k)%line, why_not_read(tree%leaves(k)%text))
   end subroutine take_template

   !> The message on points that the template needs and the file does not have, of which three are named.
   function missing_points(missing, template) result(text)
      type(message_list_t), intent(in) :: missing
      character(*), intent(in) :: template
      character(:), allocatable :: text
      integer :: k

      text = 'expected the points of the template '//shown(template)//'; missing: '
      do k = 1, min(missing%count(), 3)
         if (k > 1) text = text//', '
         text = text//shown(missing%line(k))
      end do
      if (missing%count() > 3) text = text//' and '//str(missing%count() - 3)//' more; is it another template?'
   end function missing_points

   !> Takes a point: three numbers.
   subroutine take_point(tree, id, path, table, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: id                        !! index in point_names
      character(*), intent(in) :: path
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      type(table_point_t) :: point
      logical :: is_good

      point%name = path
      point%point = id
      point%side = single_point
      call take_axes(tree, path, trim(point_names(id)), point%at, point%line, is_good, flaws)
      if (.not. is_good) return
      table%used = table%used + 1
      table%points(table%used) = point
   end subroutine take_point

   !> Takes spring and shock with their points. The spring of a strut acts between the ends of the strut.
   subroutine take_springs(tree, template, table, facts, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: template                  !! index in templates
      type(point_table_t), intent(inout) :: table
      type(axle_facts_t), intent(inout) :: facts
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: objects(2) = [character(6) :: 'Spring', 'Shock']
      integer, parameter :: tops(2) = [spring_top, damper_top], lows(2) = [spring_low, damper_low]
      character(:), allocatable :: object
      integer :: k

      do k = spring_slot, damper_slot
         object = trim(objects(k))
         if (.not. has_branch(tree, object)) cycle
         associate (this => facts%springs(k))
            this%top = tops(k)
            this%low = lows(k)
            if (templates(template)%family == strut .and. k == spring_slot) then
               this%top = strut_top
               this%low = strut_low
            else
               call take_point(tree, this%top, object//'/Location Chassis', table, flaws)
               call take_point(tree, this%low, object//'/'//trim(templates(template)%end_key), table, flaws)
            end if
            this%body = templates(template)%body
            call take_spring(tree, object, this, facts%assumed, facts%omitted, flaws)
         end associate
      end do
      if (templates(template)%family /= links .or. .not. any(facts%springs%is_given)) return
      call take_link_axes(tree, facts, flaws)
   end subroutine take_springs

   !> Takes the axes of the joint of the trailing link on the chassis, which must be perpendicular.
   subroutine take_link_axes(tree, facts, flaws)
      type(json_tree_t), intent(in) :: tree
      type(axle_facts_t), intent(inout) :: facts
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: paths(2) = [character(42) :: 'Trailing Link/Universal Joint Axis Chassis', &
         'Trailing Link/Universal Joint Axis Link']
      logical :: is_good(2)
      integer :: k, line

      do k = 1, 2
         call take_axes(tree, trim(paths(k)), 'an axis', facts%link_axes(:, k), line, is_good(k), flaws)
         if (.not. is_good(k)) return
         if (.not. norm2(facts%link_axes(:, k)) > 1.0e-6_wp) then
            call flaws%add(line, 'expected an axis for '//shown(trim(paths(k)))//', found 0, 0, 0')
            return
         end if
         facts%link_axes(:, k) = facts%link_axes(:, k)/norm2(facts%link_axes(:, k))
      end do
      if (abs(dot_product(facts%link_axes(:, 1), facts%link_axes(:, 2))) > 1.0e-3_wp) call flaws%add(line, &
         'expected perpendicular axes of the universal joint of the trailing link, found others')
      facts%link_axes(:, 2) = facts%link_axes(:, 2) - facts%link_axes(:, 1)*dot_product(facts%link_axes(:, 1), &
         facts%link_axes(:, 2))
      facts%has_link_axes = .true.
   end subroutine take_link_axes

   !> Takes the bushings of arms and tie rod. Those of a tie rod count if the rod is a body, with a mass.
   subroutine take_bushings(tree, template, facts, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: template                  !! index in templates
      type(axle_facts_t), intent(inout) :: facts
      type(flaws_t), intent(inout) :: flaws

      select case (templates(template)%name)
      case (arms)
         call take_bushing(tree, 'Upper Control Arm', facts%bushings(upper_slot), flaws)
         call take_bushing(tree, 'Lower Control Arm', facts%bushings(lower_slot), flaws)
      case (strut)
         call take_bushing(tree, 'Control Arm', facts%bushings(lower_slot), flaws)
      case (arm)
         call take_bushing(tree, 'Trailing Arm', facts%bushings(lower_slot), flaws)
      end select
      if (any([character(22) :: arms, strut, links] == templates(template)%name) .and. find_leaf(tree, 'Tierod/Mass') > 0) &
         call take_bushing(tree, 'Tierod', facts%bushings(rod_slot), flaws)
      if (any(facts%bushings%is_given)) call facts%assumed%add('one bushing replaces a hinge, with equal rates along x, y '// &
         'and z, as in Chrono')
   end subroutine take_bushings

   !> Adds lines on what is assumed and omitted.
   subroutine explain(tree, template, facts)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: template                  !! index in templates
      type(axle_facts_t), intent(inout) :: facts

      if (templates(template)%family == solid .or. any([character(18) :: toe_bar, cranks] == templates(template)%steering)) &
         call facts%assumed%add('the drag link ends on the chassis: the file has no steering gear')
      select case (templates(template)%family)
      case (solid)
         if (has_branch(tree, 'Trackbar')) call facts%assumed%add('four rigid links and the Panhard rod lock the axle in roll, '// &
            'as in Chrono: put the links on bushings before a test')
      case (leaf)
         call facts%assumed%add('the axle tube slides along z and rolls about x at its centre of gravity, as in '// &
            'Chrono: the leaves are springs, without axle steer')
      case (watt)
         call facts%assumed%add('the lever of the Watt linkage rotates about the middle of its ends (Chrono: left end plus '// &
            'half of the right one)')
      end select
      if (templates(template)%family == lateral) call omit_bushings(tree, facts)
      if (has_branch(tree, 'Shock')) call facts%omitted%add('line '//str(branch_line(tree, 'Shock/'))//': Shock: damping')
      call facts%omitted%add('masses and moments of inertia')
   end subroutine explain

   !> Lists the bushings of an arm on two links, which are not read.
   subroutine omit_bushings(tree, facts)
      type(json_tree_t), intent(in) :: tree
      type(axle_facts_t), intent(inout) :: facts
      character(*), parameter :: paths(5) = [character(34) :: 'Trailing Arm/Bushing Data Chassis', 'Upper Link/Bushing Data Arm', &
         'Upper Link/Bushing Data Chassis', 'Lower Link/Bushing Data Arm', 'Lower Link/Bushing Data Chassis']
      integer :: k

      do k = 1, size(paths)
         if (has_branch(tree, trim(paths(k)))) call facts%omitted%add('line '//str(branch_line(tree, trim(paths(k))//'/'))//': '// &
            trim(paths(k))//': the joint is rigid in the deck')
      end do
   end subroutine omit_bushings

end module ek_chrono
