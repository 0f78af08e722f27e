!> Listings of Lotus Suspension Analysis (text, also .sdf): the static hardpoints of one or both axles, the rolling radius and
!> numbers of the car.
!>
!> A line of a point has three numbers, then `POINT:1 Lower wishbone front pivot` or `POINT ( 1 ) = Lower wishbone front pivot`.
!> Only the first run of such lines below the heading of an axle is read; later ones are moved points. `(mm)` above the points
!> is the unit. The format defines neither axes nor origin: they are given or decided by votes, as for a table.
module ek_lotus_listing
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_decimal, only: get_decimal
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, field_t, split_fields, take_number
   use ek_unit_word, only: unit_of, length_unit
   use ek_car_number, only: car_number_t, add_car_number, wheelbase, cg_height, brake_share, drive_share
   use ek_point_name, only: unused_point
   use ek_point_table, only: point_table_t, table_point_t, add_point, recognise, take_length
   use ek_axle_facts, only: axle_facts_t
   implicit none(type, external)
   private
   public :: is_lotus_listing, parse_lotus_listing

   character(*), parameter :: axle_heads(2) = [character(16) :: 'front suspension', 'rear suspension']

   !> A number of the car: the beginning of its label, in lower case.
   type :: label_t
      character(24) :: label
      integer :: slot
      logical :: is_percent
   end type label_t

   type(label_t), parameter :: labels(4) = [label_t('wheelbase', wheelbase, .false.), &
      label_t('c of g height', cg_height, .false.), label_t('breaking on front axle', brake_share, .true.), &
      label_t('drive on front axle', drive_share, .true.)]

contains

   !> Whether a text is a listing: its title is in the first lines.
   pure logical function is_lotus_listing(text)
      character(*), intent(in) :: text
      is_lotus_listing = index(lower(text(:min(len(text), 2000))), 'lotus suspension analysis') > 0
   end function is_lotus_listing

   !> Reads the points, and the rolling radius of each axle in the unit of the file.
   subroutine parse_lotus_listing(lines, table, radius, facts, flaws)
      type(lines_t), intent(in) :: lines
      type(point_table_t), intent(out) :: table
      real(wp), intent(out) :: radius(2)             !! of the front and of the rear axle; 0: not given
      type(axle_facts_t), intent(out) :: facts
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: line
      integer :: k, axle, run, at

      allocate (table%points(32))
      radius = 0.0_wp
      axle = 0
      run = 0                                         ! 0 before the points, 1 among them, 2 below them
      do k = 1, lines%count
         line = trim(adjustl(lines%line(k)))
         at = head_of(line)
         if (at > 0) then
            axle = at
            run = 0
         else if (is_point_line(line)) then
            if (run == 2) cycle
            run = 1
            call take_point(line, k, axle, table, flaws)
         else if (run == 0 .and. index(line, '(') == 1) then
            call take_unit(line, k, table, flaws)
         else if (line /= '') then
            if (run == 1) run = 2
            call take_label(line, k, axle, table, radius, facts, flaws)
         end if
      end do
      if (table%used == 0 .and. flaws%count() == 0) call flaws%add(0, 'expected lines with x, y, z and POINT in the listing, '// &
         'found none')
      call recognise(table, flaws)
   end subroutine parse_lotus_listing

   !> The axle of a heading, as in 'FRONT SUSPENSION FILENAME: a.shk'; 0 for another line.
   pure integer function head_of(line)
      character(*), intent(in) :: line
      character(:), allocatable :: folded

      folded = lower(line)
      head_of = 0
      if (index(folded, 'filename') == 0) return
      if (index(folded, trim(axle_heads(1))) == 1) head_of = 1
      if (index(folded, trim(axle_heads(2))) == 1) head_of = 2
   end function head_of

   !> Whether a line has POINT after a number.
   pure logical function is_point_line(line)
      character(*), intent(in) :: line

      is_point_line = .false.
      if (line == '') return
      is_point_line = scan(line(1:1), '+-.0123456789') == 1 .and. index(line, 'POINT') > 0
   end function is_point_line

   !> Takes a point. A point without a name is skipped.
   subroutine take_point(line, k, axle, table, flaws)
      character(*), intent(in) :: line
      integer, intent(in) :: k, axle
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      type(table_point_t) :: point
      type(field_t) :: fields(64)
      character(:), allocatable :: name
      logical :: is_good(3)
      integer :: used, c

      name = name_of(line(index(line, 'POINT') + len('POINT'):))
      if (name == '' .or. name == 'Not Defined') return
      call split_fields(line(:index(line, 'POINT') - 1), k, fields, used, flaws)
      if (used /= 3) then
         call flaws%add(k, 'expected x, y and z of '//shown(name)//', found '//str(used)//' numbers')
         return
      end if
      do c = 1, 3
         call take_number(fields(c)%text, k, 'xyz'(c:c)//' of '//shown(name), point%at(c), flaws, is_good(c))
         if (is_good(c)) is_good(c) = abs(point%at(c)) < 1.0e25_wp
      end do
      if (.not. all(is_good)) return
      point%name = name
      point%point = merge(unused_point, -1, index(name, 'C of G') > 0)
      point%axle = axle
      point%line = k
      call add_point(point, table, flaws)
   end subroutine take_point

   !> The name behind ':1 ' or '( 1 ) = '.
   pure function name_of(text) result(name)
      character(*), intent(in) :: text
      character(:), allocatable :: name
      integer :: at

      name = ''
      at = verify(text, ' :()=0123456789')
      if (at > 0) name = trim(text(at:))
   end function name_of

   !> Takes the unit of the line of units, '(mm) (mm) (mm)'.
   subroutine take_unit(line, k, table, flaws)
      character(*), intent(in) :: line
      integer, intent(in) :: k
      type(point_table_t), intent(inout) :: table
      type(flaws_t), intent(inout) :: flaws
      integer :: last

      last = index(line, ')')
      if (last > 2) call take_length(unit_of(length_unit, line(2:last - 1)), k, table, flaws)
   end subroutine take_unit

   !> Takes a number with its label: 'WHEELBASE (mm): 1550.00'. Static angles other than 0 are listed: the file does not define
   !> their signs.
   subroutine take_label(line, k, axle, table, radius, facts, flaws)
      character(*), intent(in) :: line
      integer, intent(in) :: k, axle
      type(point_table_t), intent(inout) :: table
      real(wp), intent(inout) :: radius(2)
      type(axle_facts_t), intent(inout) :: facts
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: label
      real(wp) :: value
      logical :: is_good
      integer :: at, j

      at = index(line, ':', back=.true.)
      if (at == 0 .or. at == len(line)) return
      call get_decimal(trim(adjustl(line(at + 1:))), value, is_good)
      if (.not. is_good) return
      label = lower(line(:at - 1))
      if (index(label, 'tyre rolling radius') == 1 .and. value > 0.0_wp .and. value < 1.0e6_wp) then
         if (axle > 0) radius(axle) = value
         if (axle == 0) radius = value
      end if
      if (index(label, 'camber angle') == 1 .or. index(label, 'toe angle') == 1) then
         if (abs(value) > 0.0_wp) call facts%omitted%add('line '//str(k)//': '//line(:at - 1)//': the sign is not in the file')
         return
      end if
      do j = 1, size(labels)
         if (index(label, trim(labels(j)%label)) /= 1) cycle
         if (is_known(labels(j)%slot)) cycle                ! each axle of a car lists the numbers of the car
         if (labels(j)%is_percent) value = value/100.0_wp
         call add_car_number(car_number_t(labels(j)%slot, merge(1, 0, labels(j)%slot == drive_share), [value, 0.0_wp], k), &
            table%numbers, flaws)
         if (labels(j)%slot == drive_share) call add_car_number(car_number_t(drive_share, 2, [1.0_wp - value, 0.0_wp], k), &
            table%numbers, flaws)
      end do

   contains

      pure logical function is_known(slot)
         integer, intent(in) :: slot
         is_known = any(table%numbers%list(:table%numbers%used)%slot == slot)
      end function is_known

   end subroutine take_label

end module ek_lotus_listing
