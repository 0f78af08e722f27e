!> Lists of hardpoints as JSON or TOML, as scripts make them from the workbooks of OptimumKinematics and other programs: each point
!> is a name with three numbers, in objects or tables that may name the axle or the side.
!>
!> JSON: `{"front": {"CHAS_LowFor_L": [160, 205, 110], ...}}`. TOML: `[front]`, then `CHAS_LowFor_L = [160, 205, 110]`.
!> A string `unit` or `length` with a unit of length is the unit. Other numbers are listed as not read.
!> The format defines no frame: it is given or decided by votes, as for a table.
module ek_point_list
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t
   use ek_json_tree, only: json_tree_t, parse_json, triple_at
   use ek_unit_word, only: unit_of, length_unit
   use ek_car_number, only: car_number_t, car_number_of, add_car_number, count_of
   use ek_point_heading, only: split_place
   use ek_point_table, only: point_table_t, table_point_t, not_a_point, take_length, recognise, add_point
   implicit none(type, external)
   private
   public :: is_toml, parse_point_list, as_json

   integer, parameter :: max_others = 50      !! most numbers that are listed as not read

contains

   !> Whether a file is TOML, by its extension: files of Adams/Car look similar.
   pure logical function is_toml(path)
      character(*), intent(in) :: path
      is_toml = lower(path(index(path, '.', back=.true.) + 1:)) == 'toml'
   end function is_toml

   !> Whether a line is the heading of a table, as [front] or [front.left].
   pure logical function is_table(line)
      character(*), intent(in) :: line

      is_table = .false.
      if (len(line) < 3) return
      if (line(1:1) /= '[' .or. line(len(line):) /= ']') return
      is_table = is_name(line(2:len(line) - 1))
   end function is_table

   !> Whether a text can be a name of TOML.
   pure logical function is_name(text)
      character(*), intent(in) :: text

      is_name = text /= '' .and. verify(trim(adjustl(text)), &
         'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-."'' ') == 0
   end function is_name

   !> Converts TOML to JSON with the same lines. Only tables, strings, numbers and lists on one line are accepted.
   subroutine as_json(lines, text, flaws)
      type(lines_t), intent(in) :: lines
      character(:), allocatable, intent(out) :: text
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: line, name
      logical :: is_first, is_in_table
      integer :: k, at

      text = '{'
      is_first = .true.
      is_in_table = .false.
      do k = 1, lines%count
         line = trim(adjustl(without_comment(lines%line(k))))
         at = index(line, '=')
         if (line == '') then
            continue
         else if (is_table(line)) then
            if (is_in_table) text = text//'}'
            if (is_in_table .or. .not. is_first) text = text//','
            text = text//json_name(line(2:len(line) - 1))//': {'
            is_in_table = .true.
            is_first = .true.
         else if (at > 1 .and. is_name(line(:max(at - 1, 1)))) then
            name = json_name(line(:at - 1))
            if (.not. is_first) text = text//','
            text = text//name//':'//line(at + 1:)
            is_first = .false.
         else
            call flaws%add(k, 'expected [table] or name = value on one line, found '//shown(line))
            return
         end if
         text = text//new_line('a')
      end do
      if (is_in_table) text = text//'}'
      text = text//'}'
   end subroutine as_json

   !> A line without its comment, which begins with # outside of double quotes.
   pure function without_comment(line) result(text)
      character(*), intent(in) :: line
      character(:), allocatable :: text
      logical :: is_quoted
      integer :: k

      is_quoted = .false.
      do k = 1, len(line)
         if (line(k:k) == '"') is_quoted = .not. is_quoted
         if (line(k:k) == '#' .and. .not. is_quoted) exit
      end do
      text = line(:k - 1)
   end function without_comment

   !> A name in double quotes, without its own quotes.
   pure function json_name(text) result(name)
      character(*), intent(in) :: text
      character(:), allocatable :: name
      integer :: k

      name = '"'
      do k = 1, len_trim(text)
         if (scan(text(k:k), '"''') == 0) name = name//text(k:k)
      end do
      name = '"'//trim(adjustl(name(2:)))//'"'
   end function json_name

   !> Reads the points of JSON.
   subroutine parse_point_list(text, table, flaws)
      character(*), intent(in) :: text
      type(point_table_t), intent(out) :: table
      type(flaws_t), intent(inout) :: flaws
      type(json_tree_t) :: tree
      character(:), allocatable :: path
      type(table_point_t) :: point
      real(wp) :: unit
      logical :: is_triple, is_number
      integer :: k, last, others

      last = 0
      others = 0
      allocate (table%points(32))
      call parse_json(text, tree, flaws)
      if (flaws%count() > 0) return
      do k = 1, tree%used
         call triple_at(tree, k, path, point%at, is_triple)
         is_number = .false.
         if (k > last) is_number = is_car_number(tree, k)
         if (is_triple) then
            point%line = tree%leaves(k)%line
            call take_path(path, point)
            point%point = -1
            call add_point(point, table, flaws)
            last = k + 2
         else if (names_unit(trim(tree%leaves(k)%path)) .and. .not. tree%leaves(k)%is_number) then
            unit = unit_of(length_unit, tree%leaves(k)%text)
            call take_length(unit, tree%leaves(k)%line, table, flaws)
            if (.not. unit > 0.0_wp) call flaws%add(tree%leaves(k)%line, 'expected a unit of length for '// &
               shown(trim(tree%leaves(k)%path))//', found '//shown(tree%leaves(k)%text))
         else if (is_number) then
            call take_path(without_index(trim(tree%leaves(k)%path)), point)
            last = k + count_of(car_number_of(trim(point%name))) - 1
            call add_car_number(car_number_t(car_number_of(trim(point%name)), point%axle, &
               [tree%leaves(k)%value, tree%leaves(last)%value], tree%leaves(k)%line), table%numbers, flaws)
         else if (k > last .and. tree%leaves(k)%is_number .and. others < max_others) then
            others = others + 1
            call add_point(table_point_t(name=trim(tree%leaves(k)%path), point=not_a_point, line=tree%leaves(k)%line), table, flaws)
         end if
      end do
      if (table%used == others .and. flaws%count() == 0) call flaws%add(0, &
         'expected points, as "lca_front": [1, 2, 3], or the JSON of a Chrono suspension ("Type": "Suspension"), found neither')
      call recognise(table, flaws)
   end subroutine parse_point_list

   !> Whether leaf k is a number of the car, or the first of the two numbers of an adjuster.
   logical function is_car_number(tree, k)
      type(json_tree_t), intent(in) :: tree
      integer, intent(in) :: k
      character(:), allocatable :: path
      type(table_point_t) :: point
      integer :: n

      is_car_number = .false.
      if (.not. tree%leaves(k)%is_number) return
      path = trim(tree%leaves(k)%path)
      call take_path(without_index(path), point)
      if (car_number_of(trim(point%name)) == 0) return
      n = count_of(car_number_of(trim(point%name)))
      if (n == 1) is_car_number = without_index(path) == path
      if (n == 1 .or. k + n - 1 > tree%used) return
      if (without_index(path)//'/1' /= path) return
      is_car_number = tree%leaves(k + 1)%path == without_index(path)//'/2' .and. tree%leaves(k + 1)%is_number
      if (k + 2 <= tree%used) is_car_number = is_car_number .and. tree%leaves(k + 2)%path /= without_index(path)//'/3'
   end function is_car_number

   !> A path without the index of an element at its end.
   pure function without_index(path) result(short)
      character(*), intent(in) :: path
      character(:), allocatable :: short
      integer :: at

      at = index(path, '/', back=.true.)
      short = path
      if (at > 1 .and. at < len(path)) then
         if (verify(path(at + 1:), '0123456789') == 0) short = path(:at - 1)
      end if
   end function without_index

   !> Whether the last name of a path is that of a unit.
   pure logical function names_unit(path)
      character(*), intent(in) :: path
      names_unit = any([character(12) :: 'unit', 'units', 'length', 'length_unit'] == &
         lower(path(index(path, '/', back=.true.) + 1:)))
   end function names_unit

   !> Takes name, axle and side from a path: the last name is that of the point, and objects may name axle or side.
   subroutine take_path(path, point)
      character(*), intent(in) :: path
      type(table_point_t), intent(inout) :: point
      character(:), allocatable :: rest
      integer :: at, axle, side
      logical :: is_place

      at = index(path, '/', back=.true.)
      point%name = path(at + 1:)
      point%axle = 0
      point%side = 0
      rest = path(:max(at - 1, 0))
      do while (rest /= '')
         at = scan(rest//'/', '/.')
         call split_place(rest(:at - 1), axle, side, is_place)
         if (is_place .and. axle > 0) point%axle = axle
         if (is_place .and. side > 0) point%side = side
         rest = rest(min(at + 1, len(rest) + 1):)
      end do
   end subroutine take_path

end module ek_point_list
