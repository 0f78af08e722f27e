!> IPGKinematics 3.6.7: seven axles of Formula Student cars, published with their inputs in the repository
!> SDS-RC-FEE-CTU-in-Prague/FormulaCarMaker (numbers only; 7 digits, compliances at states beside design 5 digits).
!>
!> Positions and angles are those of the left wheel: R = Rz(rz) Rx(rx) Ry(ry), x forward, y left. What the source defines otherwise:
!>
!> - Its contact point does not turn with the carrier about the spin axis, in track, trail and scrub radius, but the ground is at the height of the
!>   point that does. Trail, scrub radius and hub offsets are measured in the direction of the wheel. All of these, the angles and the frame are
!>   those of --definitions ipg.
!> - Its tyre deflects as if the contact point were at 0.6 of the radius below the wheel centre, while the force acts at the whole radius: this
!>   follows from its heights and loads (0.600 within 0.002 for all axles and states). Here the tyre has one contact point, at the whole radius. So the heights of
!>   the road in the decks are those of the source plus 0.4 of the rise of the contact point above the wheel centre (check_roads). The point at
!>   0.6 of the radius is fixed in the carrier: the lowest point of a torus or of a disc rises otherwise (tyre_heights).
!> - Not compared, because the definition is not published and differs: rc, anti_brake, anti_drive, Ackermann percentage, rack force.
module ek_published_ipg
   use ek_kinds, only: wp, degree
   use ek_table, only: table_t, row_count
   use ek_text, only: str
   use ek_lowest_point, only: lowest_point
   use ek_comparison, only: comparisons_t, add, solve, read_numbers, read_loads, pick
   implicit none(type, external)
   private
   public :: axles, compare_ipg, tyre_heights

   character(*), parameter :: axles(7) = [character(11) :: 'fse04_front', 'fse04_rear', 'fse06_front', 'fse06_rear', &
      'fse08_front', 'fse08_rear', 'pltka_rear'], sides(2) = [character(5) :: 'left', 'right'], &
      loads(6) = [character(2) :: 'Fx', 'Fy', 'Fz', 'Mx', 'My', 'Mz'], &
      ways(6) = [character(2) :: 'tx', 'ty', 'tz', 'rx', 'ry', 'rz'], poses(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz']
   real(wp), parameter :: step(6) = [1.0e3_wp, 1.0e3_wp, 1.0e3_wp, 1.0e2_wp, 1.0e2_wp, 1.0e2_wp], &   ! ± N, N m
      lift = 1.0e-5_wp                    !! m/N, the size of tz per Fz

   !> The wheel at design: line from its centre to the contact point [mm], static toe and camber [deg].
   type :: wheel_t
      real(wp) :: arm(3), toe, camber
   end type wheel_t

contains

   !> Appends all comparable numbers of the seven axles.
   subroutine compare_ipg(list)
      type(comparisons_t), intent(inout) :: list
      type(table_t) :: table, defined
      integer :: k

      do k = 1, size(axles)
         list%part = axles(k)
         call solve(list, trim(axles(k)), 'loads', [character(1) :: ''], table, 'ipg', defined)
         if (allocated(list%trouble)) return
         call check_roads(list, trim(axles(k)), table)
         call compare_states(list, trim(axles(k)), defined)
         call compare_compliance(list, trim(axles(k)), defined)
         call compare_forces(list, trim(axles(k)), table)
         if (index(axles(k), 'front') > 0) call compare_steering(list, trim(axles(k)))
      end do
   end subroutine compare_ipg

   !> Numbers of the deck that rotations are read with.
   pure type(wheel_t) function wheel_of(axle) result(wheel)
      character(*), intent(in) :: axle

      wheel%arm = [0.0_wp, 0.0_wp, -200.0_wp]
      if (axle == 'fse04_front') wheel%arm(3) = -199.7792_wp
      if (axle == 'fse06_front' .or. axle == 'pltka_rear') wheel%arm(3) = -199.807_wp
      wheel%toe = 0.2_wp
      wheel%camber = -1.3_wp
      if (index(axle, 'front') == 0) return
      wheel%toe = -0.133333333333_wp
      wheel%camber = -1.5_wp
   end function wheel_of

   !> The heights of the road in the deck are those of the source (see above), at every state and under every load. Tolerance 1e-5 mm: they have
   !> 6 digits after the point, and the last digit of the published states is 1e-5 mm.
   subroutine check_roads(list, axle, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: axle
      type(table_t), intent(in) :: table
      type(table_t) :: states, compliances, given
      real(wp) :: rise
      integer :: k, row

      call read_numbers(list, axle//'_states', states)
      call read_numbers(list, axle//'_compliance', compliances)
      call read_loads(list, axle//'_loads', given)
      do k = 1, row_count(states)
         do row = row_of(states, compliances, k), row_of(states, compliances, k + 1) - 1
            rise = pick(table, 'left_contact_patch_z_mm', row) - pick(table, 'left_wheel_centre_z_mm', row)
            if (abs(pick(given, 'left_travel_mm', row) - 0.4_wp*rise - pick(states, 'road', k)) <= 1.0e-5_wp) cycle
            if (.not. allocated(list%trouble)) list%trouble = axle//': the road of row '//str(row)//' is not that of the source'
         end do
      end do
   end subroutine check_roads

   !> How far the lower end of the tyre rises above the wheel centre [mm], in each published state: by the source, whose tyre
   !> deflects by load/rate, and for four contact points: 0.6 of the radius and the whole radius below the centre, fixed in the
   !> carrier; the lowest point of a torus with a crown of 0.4 of the radius, and of a disc.
   subroutine tyre_heights(list, axle, published, points)
      type(comparisons_t), intent(inout) :: list
      integer, intent(in) :: axle                         !! index in `axles`
      real(wp), allocatable, intent(out) :: published(:), points(:, :)
      real(wp), parameter :: rates(*) = [110.0_wp, 110.0_wp, 110.0_wp, 110.0_wp, 960.0_wp, 96.0_wp, 140.0_wp]   ! tyre, N/mm
      type(table_t) :: states
      type(wheel_t) :: wheel
      real(wp) :: turn(3), arm(3), spin(3), radius, design
      integer :: k, c, first

      call read_numbers(list, trim(axles(axle))//'_states', states)
      wheel = wheel_of(trim(axles(axle)))
      allocate (published(row_count(states)), points(row_count(states), 4))
      first = state_at(states, 0.0_wp)
      do k = 1, row_count(states)
         published(k) = pick(states, 'road', k) - (pick(states, 'load', k) - pick(states, 'load', first))/rates(axle) - &
            pick(states, 'z', k)
         turn = [(pick(states, trim(poses(c)), k), c=4, 6)]
         arm = turned_z(turned_x(turned_y(in_wheel(wheel%arm, wheel), turn(2)), turn(1)), turn(3))
         points(k, 1) = 0.6_wp*(arm(3) - wheel%arm(3))
         points(k, 2) = arm(3) - wheel%arm(3)
         spin = turned_z(turned_x([0.0_wp, 1.0_wp, 0.0_wp], turn(1)), turn(3))
         do c = 3, 4
            associate (core => merge(0.6_wp, 1.0_wp, c == 3))
               radius = -wheel%arm(3)/(core*cos(degree*wheel%camber) + 1 - core)
               arm = lowest_point(core*radius*spin)
               points(k, c) = arm(3) - (1 - core)*radius - wheel%arm(3)
            end associate
         end do
      end do
      design = published(first)
      published = published - design
   end subroutine tyre_heights

   !> The states over the height of the road.
   !>
   !> Tolerances, of numbers with 7 digits: 1e-4 mm and 5e-3 N; for FSE06 front 4e-4 mm and 0.05 N, because of one state (36 mm, the end of its travel:
   !> 3.1e-4 mm and 0.034 N, unexplained). Angles 2e-5 deg: their last digit is up to 5e-6. Trail 1e-4 mm.
   !> Scrub radius and track 1e-2 mm: where the contact point of the source is in y is known to 2.4e-3 mm, and its track is up to 2e-3 mm wide at design.
   subroutine compare_states(list, axle, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: axle
      type(table_t), intent(in) :: table                  !! in the definitions of IPG
      real(wp), parameter :: angle = 2.0e-5_wp, at_contact = 1.0e-2_wp
      type(table_t) :: theirs, compliances
      real(wp) :: pose(6), length
      character(:), allocatable :: place
      integer :: k, q, row

      call read_numbers(list, axle//'_states', theirs)
      call read_numbers(list, axle//'_compliance', compliances)
      do k = 1, row_count(theirs)
         row = row_of(theirs, compliances, k)
         place = 'road '//str(nint(pick(theirs, 'road', k)))//' mm'
         length = merge(4.0e-4_wp, 1.0e-4_wp, axle == 'fse06_front')
         pose = pose_of(table, row, 1)
         do q = 1, 6
            call add(list, trim(poses(q)), place, merge('mm ', 'deg', q <= 3), pose(q), pick(theirs, trim(poses(q)), k), &
               merge(length, angle, q <= 3))
         end do
         call add(list, 'wheel load', place, 'N', pick(table, 'left wheel load [N]', row), pick(theirs, 'load', k), &
            merge(5.0e-2_wp, 5.0e-3_wp, axle == 'fse06_front'))
         call add(list, 'coil force', place, 'N', pick(table, 'left_coil force [N]', row), pick(theirs, 'coil', k), 1.0e-2_wp)
         call compare('caster', 'deg', 'caster', angle)
         call compare('kingpin inclination', 'deg', 'kingpin', angle)
         call compare('longitudinal hub offset', 'mm', 'spindle_offset', 2.0e-5_wp)
         call compare('lateral hub offset', 'mm', 'spindle_length', 2.0e-5_wp)
         call compare('caster trail', 'mm', 'trail', 1.0e-4_wp)
         call compare('scrub radius', 'mm', 'scrub', at_contact)
         call compare('track change', 'mm', 'track', at_contact)
      end do

   contains

      !> Adds a quantity of the left wheel.
      subroutine compare(name, unit, published, tolerance)
         character(*), intent(in) :: name, unit, published
         real(wp), intent(in) :: tolerance
         call add(list, name, place, unit, pick(table, 'left '//name//' ['//unit//']', row), pick(theirs, published, k), tolerance)
      end subroutine compare

   end subroutine compare_states

   !> The row of the solved table that is the published state k: behind each state two rows follow for each load with published compliances.
   integer function row_of(states, compliances, k) result(row)
      type(table_t), intent(in) :: states, compliances
      integer, intent(in) :: k
      integer :: before, entry

      row = k
      do before = 1, k - 1
         do entry = 1, row_count(compliances)
            if (abs(pick(compliances, 'road', entry) - pick(states, 'road', before)) < 0.5_wp) row = row + 2
         end do
      end do
   end function row_of

   !> The published state at a height of the road [mm].
   integer function state_at(states, road) result(k)
      type(table_t), intent(in) :: states
      real(wp), intent(in) :: road
      do k = 1, row_count(states)
         if (abs(pick(states, 'road', k) - road) < 0.5_wp) exit
      end do
   end function state_at

   !> Compliances: differences of the states under ±1000 N, ±100 N m at the wheel centre, as in the source, over their double load.
   !>
   !> An entry is compared with √(Cii Cjj): the matrix is unsymmetric by up to 5 % of an entry, because rotations are differences of Cardan angles, in
   !> the source and here. Tolerance 3e-4: the published entries have 5 digits, and the position of the masses is known from the joint forces only.
   subroutine compare_compliance(list, axle, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: axle
      type(table_t), intent(in) :: table                  !! in the definitions of IPG
      type(table_t) :: states, theirs, design
      real(wp), parameter :: tolerance = 3.0e-4_wp
      real(wp) :: c(6), size_of(6), road
      integer :: k, d, j, row

      call read_numbers(list, axle//'_states', states)
      call read_numbers(list, axle//'_compliance', theirs)
      call read_numbers(list, axle//'_design', design)
      road = -huge(road)
      row = 0
      do k = 1, row_count(theirs)
         if (abs(pick(theirs, 'road', k) - road) > 0.5_wp) then
            road = pick(theirs, 'road', k)
            size_of = sizes(theirs, road)
            row = row_of(states, theirs, state_at(states, road))
         end if
         j = nint(pick(theirs, 'load', k))
         c = (pose_of(table, row + 1, 1) - pose_of(table, row + 2, 1))/(2*step(j))
         c = [1.0e-3_wp*c(:3), degree*c(4:)]
         row = row + 2
         call add_column(list, theirs, k, 'road '//str(nint(road))//' mm', j, c, size_of, tolerance)
         if (abs(road) > 0.5_wp) cycle
         do d = 1, row_count(design)
            if (nint(pick(design, 'load', d)) == j) &
               call add_column(list, design, d, 'design, 7 digits', j, c, size_of, tolerance)
         end do
      end do
   end subroutine compare_compliance

   !> Appends a column of the compliance matrix, made dimensionless by √(Cii Cjj).
   subroutine add_column(list, theirs, k, place, j, c, size_of, tolerance)
      type(comparisons_t), intent(inout) :: list
      type(table_t), intent(in) :: theirs
      integer, intent(in) :: k, j                        !! row of the publication, load
      character(*), intent(in) :: place
      real(wp), intent(in) :: c(6), size_of(6), tolerance
      real(wp) :: published
      integer :: i

      do i = 1, 6
         published = pick(theirs, ways(i), k)
         if (i == 3 .and. place(:4) == 'road') cycle      ! published at design only
         call add(list, 'compliance '//loads(j)//' '//ways(i), place, '-', c(i)/sqrt(size_of(i)*size_of(j)), &
            published/sqrt(size_of(i)*size_of(j)), tolerance)
      end do
   end subroutine add_column

   !> The published diagonal at a road height; that of z is not published.
   function sizes(theirs, road) result(size_of)
      type(table_t), intent(in) :: theirs
      real(wp), intent(in) :: road
      real(wp) :: size_of(6)
      integer :: k, j

      size_of = lift
      do k = 1, row_count(theirs)
         j = nint(pick(theirs, 'load', k))
         if (abs(pick(theirs, 'road', k) - road) < 0.5_wp .and. j /= 3) size_of(j) = pick(theirs, ways(j), k)
      end do
   end function sizes

   !> Forces at design: of each arm on the body (the sum of its two bushings), of the tie rod. Only the source splits the x-force of an arm in
   !> halves, which also shifts up to 0.01 N of y and z between the two bushings. Tolerance 1e-3 N: the published forces are those of a state
   !> that its solver left with residuals of up to 4e-4 N.
   subroutine compare_forces(list, axle, table)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: axle
      type(table_t), intent(in) :: table
      character(*), parameter :: bushings(5) = [character(13) :: 'lower_front', 'lower_rear', 'upper_front', 'upper_rear', &
         'tie_rod_inner'], directions = 'xyz'
      real(wp), parameter :: tolerance = 1.0e-3_wp
      type(table_t) :: states, theirs, compliances
      integer :: q, row
      character :: way

      call read_numbers(list, axle//'_forces', theirs)
      call read_numbers(list, axle//'_states', states)
      call read_numbers(list, axle//'_compliance', compliances)
      row = row_of(states, compliances, state_at(states, 0.0_wp))
      do q = 1, 3
         way = directions(q:q)
         call add(list, 'lower arm force '//way, 'design', 'N', force(1) + force(2), &
            pick(theirs, 'f'//way, 1) + pick(theirs, 'f'//way, 2), tolerance)
         call add(list, 'upper arm force '//way, 'design', 'N', force(3) + force(4), &
            pick(theirs, 'f'//way, 3) + pick(theirs, 'f'//way, 4), tolerance)
         call add(list, 'tie rod force '//way, 'design', 'N', force(5), pick(theirs, 'f'//way, 5), tolerance)
      end do

   contains

      !> Force of a bushing on its arm [N].
      real(wp) function force(b)
         integer, intent(in) :: b
         force = -pick(table, 'left_'//trim(bushings(b))//'_bush_f'//way//'_n', row)
      end function force

   end subroutine compare_forces

   !> Steering at the published heights of the wheel centres. Tolerance 1e-2 mm and deg of up to 29 mm and deg: the wheel load acts at the contact point of
   !> the source, which does not turn with the carrier, and the bushing of the tie rod yields to its moment.
   subroutine compare_steering(list, axle)
      type(comparisons_t), intent(inout) :: list
      character(*), intent(in) :: axle
      real(wp), parameter :: tolerance = 1.0e-2_wp
      type(table_t) :: own, table, theirs
      real(wp) :: pose(6)
      integer :: k, s, q

      call read_numbers(list, axle//'_racks', theirs)
      call solve(list, axle, 'racks', [character(1) :: ''], own, 'ipg', table)
      do k = 1, row_count(theirs)
         do s = 1, 2
            pose = pose_of(table, k, s)
            do q = 1, 6
               if (q == 3) cycle                       ! prescribed
               call add(list, 'steering, '//trim(sides(s))//' '//trim(poses(q)), &
                  'rack '//str(nint(pick(theirs, 'rack', k)))//' mm', merge('mm ', 'deg', q <= 3), pose(q), &
                  pick(theirs, trim(sides(s))//'_'//trim(poses(q)), k), tolerance)
            end do
         end do
      end do
   end subroutine compare_steering

   !> Displacement of a wheel centre [mm] and its Cardan angles rx, ry, rz [deg], of R = Rz Rx Ry with ry = 0 at design.
   function pose_of(table, row, side) result(pose)
      type(table_t), intent(in) :: table                  !! in the definitions of IPG
      integer, intent(in) :: row, side                    !! 1 left, 2 right
      real(wp) :: pose(6)
      integer :: q

      do q = 1, 6
         pose(q) = pick(table, trim(sides(side))//' '//trim(poses(q))//trim(merge(' [mm] ', ' [deg]', q <= 3)), row)
      end do
   end function pose_of

   !> A direction at design in the frame of the left wheel.
   pure function in_wheel(v, wheel) result(w)
      real(wp), intent(in) :: v(3)
      type(wheel_t), intent(in) :: wheel
      real(wp) :: w(3)
      w = turned_x(turned_z(v, wheel%toe), wheel%camber)
   end function in_wheel

   !> A vector turned about x by an angle [deg].
   pure function turned_x(v, angle) result(w)
      real(wp), intent(in) :: v(3), angle
      real(wp) :: w(3), c, s
      c = cos(degree*angle)
      s = sin(degree*angle)
      w = [v(1), c*v(2) - s*v(3), s*v(2) + c*v(3)]
   end function turned_x

   !> A vector turned about y by an angle [deg].
   pure function turned_y(v, angle) result(w)
      real(wp), intent(in) :: v(3), angle
      real(wp) :: w(3), c, s
      c = cos(degree*angle)
      s = sin(degree*angle)
      w = [c*v(1) + s*v(3), v(2), -s*v(1) + c*v(3)]
   end function turned_y

   !> A vector turned about z by an angle [deg].
   pure function turned_z(v, angle) result(w)
      real(wp), intent(in) :: v(3), angle
      real(wp) :: w(3), c, s
      c = cos(degree*angle)
      s = sin(degree*angle)
      w = [c*v(1) - s*v(2), s*v(1) + c*v(2), v(3)]
   end function turned_z

end module ek_published_ipg
