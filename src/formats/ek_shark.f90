!> Suspensions of Lotus Shark (.shk): the hardpoints of an axle by the names of its template, and the loaded radius.
!>
!> Two blocks are read. TEMP_SETTINGS: the type of the template, its title, the numbers of parts and points, the names of the
!> parts, and nine lines for each point, of which the first is its name. FRONT SUSPENSION or REAR SUSPENSION: the type of the
!> template, three numbers for each point in the order of these names, and the loaded radius. All other blocks are skipped.
!>
!> The format defines neither axes nor origin: they are given or decided by votes, as for a table. The name of a block is the slot
!> of the assembly; it is the axle if the file has both.
module ek_shark
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, field_t, split_fields, take_number
   use ek_point_name, only: unused_point
   use ek_point_table, only: point_table_t, table_point_t, add_point, recognise
   implicit none(type, external)
   private
   public :: is_shark, parse_shark

   character(*), parameter :: slots(2) = ['FRONT SUSPENSION', 'REAR SUSPENSION ']
   integer, parameter :: lines_per_point = 9, most_names = 200

   !> The names of a template.
   type :: template_t
      integer :: type = 0
      integer :: used = 0
      character(63) :: names(most_names) = ''
   end type template_t

contains

   !> Whether lines are a model of Lotus Shark.
   logical function is_shark(lines)
      type(lines_t), intent(in) :: lines
      integer :: k

      is_shark = .false.
      if (lines%count == 0) return
      if (trim(adjustl(lines%line(1))) /= 'VERSION') return
      is_shark = any([(index(lines%line(k), 'TEMP_') == 1, k=1, lines%count)])
   end function is_shark

   !> Reads the points, and the loaded radius of each axle in the unit of the file.
   subroutine parse_shark(lines, table, radius, flaws)
      type(lines_t), intent(in) :: lines
      type(point_table_t), intent(out) :: table
      real(wp), intent(out) :: radius(2)             !! of the front and the rear slot; 0: not given
      type(flaws_t), intent(inout) :: flaws
      type(template_t) :: template
      integer :: k, slot, count, axle

      allocate (table%points(32))
      radius = 0.0_wp
      count = 0
      do k = 1, lines%count
         if (any(slots == trim(adjustl(lines%line(k))))) count = count + 1
      end do
      if (count == 0) call flaws%add(0, 'expected a block FRONT SUSPENSION or REAR SUSPENSION, found none')
      do k = 1, lines%count
         slot = findloc(slots == trim(adjustl(lines%line(k))), .true., dim=1)
         if (slot == 0 .or. flaws%count() > 0) cycle
         axle = merge(slot, 0, count > 1)
         call read_template(lines, k, template, flaws)
         if (flaws%count() == 0) call read_points(lines, k, template, axle, table, radius(slot), flaws)
      end do
      call recognise(table, flaws)
   end subroutine parse_shark

   !> Reads the names of the template whose type stands below the heading of a block of points.
   subroutine read_template(lines, block, template, flaws)
      type(lines_t), intent(in) :: lines
      integer, intent(in) :: block                   !! line of the heading
      type(template_t), intent(out) :: template
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: numbers(2)
      integer :: k, at, parts

      call numbers_in(lines, block + 1, 1, 'the type of the template', numbers, flaws)
      if (flaws%count() > 0) return
      template%type = nint(numbers(1))
      do k = 1, lines%count - 3
         if (trim(adjustl(lines%line(k))) /= 'TEMP_SETTINGS') cycle
         call numbers_in(lines, k + 1, 1, 'the type of the template', numbers, flaws)
         if (flaws%count() > 0) return
         if (nint(numbers(1)) /= template%type) cycle
         call numbers_in(lines, k + 3, 2, 'the numbers of parts and points', numbers, flaws)
         if (flaws%count() > 0) return
         parts = nint(numbers(1))
         template%used = nint(numbers(2))
         if (parts < 0 .or. parts > most_names .or. template%used < 1 .or. template%used > most_names) then
            call flaws%add(k + 3, 'expected the numbers of parts and points up to '//str(most_names)//', found '// &
               shown(lines%line(k + 3)))
            return
         end if
         at = k + 4 + parts
         if (at + lines_per_point*template%used - 1 > lines%count) then
            call flaws%add(lines%count, 'expected nine lines for each of '//str(template%used)//' points, found the end of '// &
               'the file')
            return
         end if
         template%names(:template%used) = [(name_in(lines, at + lines_per_point*parts), parts=0, template%used - 1)]
         return
      end do
      call flaws%add(block + 1, 'expected a block TEMP_SETTINGS with the names of template '//str(template%type)//', found none')
   end subroutine read_template

   !> The name in a line.
   function name_in(lines, k) result(name)
      type(lines_t), intent(in) :: lines
      integer, intent(in) :: k
      character(63) :: name
      name = trim(adjustl(lines%line(k)))
   end function name_in

   !> Reads the points of a block, and the loaded radius behind them.
   subroutine read_points(lines, block, template, axle, table, radius, flaws)
      type(lines_t), intent(in) :: lines
      integer, intent(in) :: block, axle
      type(template_t), intent(in) :: template
      type(point_table_t), intent(inout) :: table
      real(wp), intent(out) :: radius
      type(flaws_t), intent(inout) :: flaws
      type(table_point_t) :: point
      real(wp) :: numbers(3)
      integer :: k, line

      radius = 0.0_wp
      do k = 1, template%used
         line = block + 1 + k
         if (template%names(k) == 'Not Defined') cycle
         call numbers_in(lines, line, 3, 'x, y, z of '//shown(trim(template%names(k))), numbers, flaws)
         if (flaws%count() > 0) return
         point%name = template%names(k)
         point%point = merge(unused_point, -1, index(template%names(k), 'C of G') > 0)
         point%axle = axle
         point%at = numbers
         point%line = line
         call add_point(point, table, flaws)
      end do
      line = block + 2 + template%used
      call numbers_in(lines, line, 1, 'the loaded radius', numbers, flaws)
      if (flaws%count() > 0) return
      radius = numbers(1)
      if (radius < 0.0_wp) call flaws%add(line, 'expected a positive loaded radius, found '//shown(lines%line(line)))
   end subroutine read_points

   !> Reads the first numbers of a line. A line with fewer numbers is an error, and so is one with more, if three are expected.
   subroutine numbers_in(lines, k, count, what, numbers, flaws)
      type(lines_t), intent(in) :: lines
      integer, intent(in) :: k, count
      character(*), intent(in) :: what
      real(wp), intent(out) :: numbers(:)
      type(flaws_t), intent(inout) :: flaws
      type(field_t) :: fields(64)
      logical :: is_good
      integer :: used, j

      numbers = 0.0_wp
      if (k > lines%count) then
         call flaws%add(lines%count, 'expected '//what//', found the end of the file')
         return
      end if
      call split_fields(lines%line(k), k, fields, used, flaws)
      if (used < count .or. (count /= 2 .and. used > count)) then
         call flaws%add(k, 'expected '//str(count)//' numbers ('//what//'), found '//shown(lines%line(k)))
         return
      end if
      do j = 1, count
         call take_number(fields(j)%text, k, what, numbers(j), flaws, is_good)
         if (is_good .and. count < 3 .and. abs(numbers(j)) > 1.0e6_wp) call flaws%add(k, 'expected a smaller number for '//what)
      end do
   end subroutine numbers_in

end module ek_shark
