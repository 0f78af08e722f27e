!> Vehicles of Project Chrono (JSON of a WheeledVehicle): the suspension of one of its two axles, moved to its location, and the
!> rack that steers it.
!>
!> The file names the files of its parts relative to a folder above its own. Their numbers are read by ek_chrono.
module ek_chrono_vehicle
   use ek_kinds, only: wp, degree, pi
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_file, only: read_whole, most_of_input, join_path, folder_name, file_exists
   use ek_flaws, only: flaws_t, new_flaws, shown
   use ek_json_tree, only: json_tree_t, parse_json, find_leaf, branch_line
   use ek_car_number, only: car_number_t, add_car_number, rack_ratio, rack_travel
   use ek_point_table, only: point_table_t
   use ek_axle_facts, only: axle_facts_t
   use ek_chrono, only: parse_chrono
   use ek_chrono_parts, only: take_axes, take_value, take_positive
   implicit none(type, external)
   private
   public :: is_chrono_vehicle, parse_chrono_vehicle

contains

   !> Whether a text in JSON is a vehicle with suspensions.
   pure logical function is_chrono_vehicle(text)
      character(*), intent(in) :: text
      is_chrono_vehicle = index(text, '"Vehicle"') > 0 .and. index(text, '"Suspension Input File"') > 0
   end function is_chrono_vehicle

   !> Reads the suspension of an axle of a vehicle.
   subroutine parse_chrono_vehicle(text, path, axle, table, facts, source, flaws)
      character(*), intent(in) :: text, path
      character(*), intent(in) :: axle                          !! front, rear; otherwise an error lists the files of both
      type(point_table_t), intent(out) :: table
      type(axle_facts_t), intent(out) :: facts
      character(:), allocatable, intent(out) :: source          !! path of the file of the suspension
      type(flaws_t), intent(inout) :: flaws
      type(json_tree_t) :: tree
      real(wp) :: at(3)
      integer :: line, k
      logical :: is_good

      source = path
      allocate (table%points(1))
      call parse_json(text, tree, flaws)
      if (flaws%count() > 0) return
      k = axle_of(tree, axle, flaws)
      if (flaws%count() > 0) return
      call take_axes(tree, place(k)//'Suspension Location', 'location', at, line, is_good, flaws)
      if (.not. is_good) return
      if (abs(at(2)) > 0.0_wp) call flaws%add(line, 'expected a suspension in the middle of the car (y = 0), found y = '// &
         str(at(2)))
      call read_suspension(tree, k, path, table, facts, source, flaws)
      if (flaws%count() > 0) return
      call move(table, at)
      call facts%assumed%add('the points are those of the suspension, moved by '//str(at(1))//', '//str(at(2))//', '//str(at(3))// &
         ' m to its location in the vehicle ('//base(path)//':'//str(line)//')')
      call take_rack(tree, k, path, table, facts, flaws)
      call omit_others(tree, k, path, facts)
   end subroutine parse_chrono_vehicle

   !> The index of an axle: the first is the front axle, the second the rear axle. Another number of axles is an error.
   integer function axle_of(tree, axle, flaws) result(k)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: axle
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: files
      integer :: leaf, axles

      axles = 0
      files = ''
      do
         leaf = find_leaf(tree, place(axles + 1)//'Suspension Input File')
         if (leaf == 0) exit
         axles = axles + 1
         if (axles <= 4) files = files//', '//shown(tree%leaves(leaf)%text)
      end do
      k = findloc(['front', 'rear '] == axle, .true., dim=1)
      if (axles == 0) then
         call flaws%add(branch_line(tree, 'Axles'), 'expected ''Axles'' with ''Suspension Input File'', found none')
      else if (axles /= 2) then
         call flaws%add(0, 'expected a vehicle with two axles, found '//str(axles)//'; import the file of one suspension: '// &
            files(3:))
      else if (k == 0) then
         call flaws%add(0, 'the vehicle has both axles; give --axle front or --axle rear: '//files(3:))
      end if
   end function axle_of

   !> The path of an axle in the file.
   pure function place(k) result(words)
      integer, intent(in) :: k
      character(:), allocatable :: words
      words = 'Axles/'//str(k)//'/'
   end function place

   !> Reads the suspension in its own file. Its errors are reported with that file and their lines.
   subroutine read_suspension(tree, k, path, table, facts, source, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: k
      character(*), intent(in) :: path
      type(point_table_t), intent(inout) :: table
      type(axle_facts_t), intent(inout) :: facts
      character(:), allocatable, intent(inout) :: source
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: content
      type(flaws_t) :: inner
      integer :: leaf

      leaf = find_leaf(tree, place(k)//'Suspension Input File')
      call read_part(tree, leaf, path, 'suspension', source, content, flaws)
      if (flaws%count() > 0) return
      inner = new_flaws(source)
      call parse_chrono(content, table, facts, inner)
      if (inner%count() > 0) call flaws%add(tree%leaves(leaf)%line, 'errors in the suspension:'//new_line('a')//inner%text())
   end subroutine read_suspension

   !> Reads the file that a leaf names: at its path from the folder of the vehicle or from a folder above, or by its name in the
   !> folder of the vehicle.
   subroutine read_part(tree, leaf, path, what, found, content, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: leaf
      character(*), intent(in) :: path, what
      character(:), allocatable, intent(out) :: found, content
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: above(4) = [character(9) :: '', '../', '../../', '../../../']
      type(error_t), allocatable :: error
      integer :: k

      content = ''
      associate (named => tree%leaves(leaf)%text, line => tree%leaves(leaf)%line)
         found = ''
         do k = 1, size(above)
            found = join_path(folder_name(path), trim(above(k))//named)
            if (file_exists(found)) exit
         end do
         if (.not. file_exists(found)) found = join_path(folder_name(path), base(named))
         if (len(named) == 0 .or. .not. file_exists(found)) then
            call flaws%add(line, 'cannot find the '//what//' '//shown(named)//'; put it in the folder of '//shown(path)// &
               ', or import the file of the suspension')
            return
         end if
         call read_whole(found, content, error, most=most_of_input)
         if (allocated(error)) call flaws%add(line, error%message)
      end associate
   end subroutine read_part

   !> Moves the points to the location of the suspension.
   subroutine move(table, at)
      type(point_table_t), intent(inout) :: table
      real(wp), intent(in) :: at(3)                    !! [m]
      integer :: k

      do k = 1, table%used
         table%points(k)%at = table%points(k)%at + at
      end do
   end subroutine move

   !> Takes ratio and travel of the rack that steers an axle. Another steering gear is listed.
   subroutine take_rack(tree, k, path, table, facts, flaws)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: k
      character(*), intent(in) :: path
      type(point_table_t), intent(inout) :: table
      type(axle_facts_t), intent(inout) :: facts
      type(flaws_t), intent(inout) :: flaws
      type(json_tree_t) :: gear
      type(flaws_t) :: inner
      character(:), allocatable :: source, content
      real(wp) :: radius, angle, number
      logical :: has(2)
      integer :: leaf

      call take_value(tree, place(k)//'Steering Index', number, has(1), flaws)
      if (.not. has(1) .or. number < 0.0_wp .or. number > 20.0_wp) return
      leaf = find_leaf(tree, 'Steering Subsystems/'//str(nint(number) + 1)//'/Input File')
      if (leaf == 0) return
      call read_part(tree, leaf, path, 'steering', source, content, flaws)
      if (flaws%count() > 0) return
      inner = new_flaws(source)
      call parse_json(content, gear, inner)
      if (find_leaf(gear, 'Pinion/Radius') == 0) then
         call facts%omitted%add(base(source)//': steering gear: not a rack')
      else
         call take_value(gear, 'Pinion/Radius', radius, has(1), inner)
         call take_positive(gear, 'Pinion/Maximum Angle (deg)', angle, has(2), inner)
         if (all(has) .and. abs(radius) > 0.0_wp) then
            table%numbers%source = base(source)
            call add_car_number(car_number_t(rack_ratio, 0, [2*pi*abs(radius), 0.0_wp], line_of('Pinion/Radius')), &
               table%numbers, inner)
            call add_car_number(car_number_t(rack_travel, 0, [abs(radius)*angle*degree, 0.0_wp], &
               line_of('Pinion/Maximum Angle (deg)')), table%numbers, inner)
         end if
      end if
      if (inner%count() > 0) call flaws%add(tree%leaves(leaf)%line, 'errors in the steering:'//new_line('a')//inner%text())

   contains

      pure integer function line_of(path)
         character(*), intent(in) :: path
         line_of = gear%leaves(find_leaf(gear, path))%line
      end function line_of

   end subroutine take_rack

   !> Lists what the vehicle has of the axle and the deck has not.
   subroutine omit_others(tree, k, path, facts)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: k
      character(*), intent(in) :: path
      type(axle_facts_t), intent(inout) :: facts
      character(*), parameter :: keys(3) = [character(22) :: 'Antirollbar Input File', 'Subchassis Index', 'Wheel Separation'], &
         words(3) = [character(38) :: 'anti-roll bar', 'subchassis: springs end on the chassis', 'double wheels']
      integer :: j, leaf

      do j = 1, size(keys)
         leaf = find_leaf(tree, place(k)//trim(keys(j)))
         if (leaf > 0) call facts%omitted%add(base(path)//':'//str(tree%leaves(leaf)%line)//': '//trim(words(j)))
      end do
      leaf = find_leaf(tree, 'Wheelbase')
      if (leaf > 0) call facts%omitted%add(base(path)//':'//str(tree%leaves(leaf)%line)//': wheelbase '// &
         tree%leaves(leaf)%text//' m: &axle needs cg_height and brake_share, too')
   end subroutine omit_others

   !> The name of a file without its folder.
   pure function base(path) result(name)
      character(*), intent(in) :: path
      character(:), allocatable :: name
      name = path(index(path, '/', back=.true.) + 1:)
   end function base

end module ek_chrono_vehicle
