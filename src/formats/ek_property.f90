!> Property files of elastic elements: .bus, .spr, .bum, .reb of Adams/Car and .gum of IPGKinematics, as curves in SI.
!>
!> The kind of the file follows from its content. In every file, force and moment oppose the displacement: a positive displacement
!> gives a positive number, as in a curve of a deck. The displacement of a spring is its compression; the displacement of a stop is
!> its penetration.
module ek_property
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str, lower
   use ek_file, only: read_whole, most_of_input
   use ek_flaws, only: flaws_t, new_flaws, shown
   use ek_fields, only: lines_t, split_lines, take_number
   use ek_unit_word, only: length_unit, force_unit, angle_unit
   use ek_teimorbit, only: teimorbit_t, parse_teimorbit, find_block, entry_of, is_teimorbit, units_in, check_units, row_item
   use ek_law_points, only: law_points_t, add_point, finish_law
   use ek_gum, only: parse_gum, is_gum
   implicit none(type, external)
   private
   public :: property_t, read_property, parse_property, bushing_file, spring_file, bump_file, rebound_file, damper_file, &
      file_kinds, component_names, is_of_rotation

   integer, parameter :: bushing_file = 1, spring_file = 2, bump_file = 3, rebound_file = 4, damper_file = 5
   character(*), parameter :: file_kinds(5) = [character(12) :: 'bushing', 'spring', 'bump stop', 'rebound stop', 'damper']
   character(*), parameter :: component_names(6) = ['fx', 'fy', 'fz', 'mx', 'my', 'mz']

   !> Names of the curves of a bushing in the file: moments begin with T.
   character(*), parameter :: bushing_blocks(6) = [character(8) :: 'fx_curve', 'fy_curve', 'fz_curve', 'tx_curve', 'ty_curve', &
      'tz_curve']

   !> The content of a property file.
   type :: property_t
      integer :: kind = 0                      !! kind of the file, as in file_kinds; 0: not a property file
      type(law_points_t) :: laws(6)            !! [m, N], [rad, N m]; a spring or a stop has only the first
      real(wp) :: free_length = 0.0_wp         !! free length of a spring [m]; 0: not given
      integer :: free_length_line = 0
   end type property_t

contains

   !> Whether a component of a bushing is a moment.
   elemental logical function is_of_rotation(component)
      integer, intent(in) :: component
      is_of_rotation = component > 3
   end function is_of_rotation

   !> Reads a file; errors in its content are in `flaws`.
   subroutine read_property(path, property, flaws, error, may_stream)
      character(*), intent(in) :: path
      type(property_t), intent(out) :: property
      type(flaws_t), intent(out) :: flaws
      type(error_t), allocatable, intent(out) :: error       !! exit_file: the file cannot be read
      logical, intent(in), optional :: may_stream
      character(:), allocatable :: text

      flaws = new_flaws(path)
      call read_whole(path, text, error, may_stream, most_of_input)
      if (.not. allocated(error)) call parse_property(text, property, flaws)
   end subroutine read_property

   !> Reads a property file from its content.
   subroutine parse_property(text, property, flaws)
      character(*), intent(in) :: text
      type(property_t), intent(out) :: property
      type(flaws_t), intent(inout) :: flaws
      type(lines_t) :: lines
      type(teimorbit_t) :: file

      call split_lines(text, lines, flaws)
      if (lines%count == 0) return
      if (is_teimorbit(lines%text)) then
         call parse_teimorbit(lines, file, flaws)
         property%kind = kind_of(file)
         select case (property%kind)
         case (bushing_file)
            call take_bushing(file, property, flaws)
         case (spring_file, bump_file, rebound_file)
            call take_curve(file, property, flaws)
         case (damper_file)
            call flaws%add(0, 'expected a bushing, a spring or a stop, found a damper (damping forces are not modelled)')
         case default
            call flaws%add(0, 'expected the blocks of a bushing ([FX_CURVE] …), a spring ([SPRING_DATA]) or '// &
               'a stop ([CURVE]), found none of them')
         end select
      else if (is_gum(lines)) then
         property%kind = bushing_file
         call parse_gum(lines, property%laws, flaws)
      else if (index(adjustl(lines%line(1)), '<') == 1) then
         call flaws%add(1, 'expected a property file in the TeimOrbit format, found XML (save it as TeimOrbit)')
      else
         call flaws%add(1, 'expected a property file (.bus, .spr, .bum, .reb with [BLOCKS], or .gum), found '//shown(lines%line(1)))
      end if
   end subroutine parse_property

   !> The kind of a file, from its header if the header gives a kind, otherwise from its blocks; 0 if neither gives a kind.
   pure integer function kind_of(file) result(kind)
      type(teimorbit_t), intent(in) :: file
      character(*), parameter :: endings(5) = ['bus', 'spr', 'bum', 'reb', 'dpr']
      integer :: block, item, k

      kind = 0
      block = find_block(file, 'mdi_header')
      if (block > 0) then
         item = entry_of(file, block, 'file_type')
         if (item > 0) then
            if (file%items(item)%used > 0) kind = findloc([(is_same(file%items(item)%fields(1)%text, endings(k)), k=1, 5)], &
               .true., dim=1)
         end if
      end if
      if (kind > 0) return
      if (any([(find_block(file, trim(bushing_blocks(k))) > 0, k=1, 6)])) then
         kind = bushing_file
      else if (find_block(file, 'spring_data') > 0) then
         kind = spring_file
      else if (find_block(file, 'curve') > 0) then
         kind = bump_file
      end if
   end function kind_of

   !> Whether two strings are equal apart from letter case and surrounding blanks. The second string is in lower case.
   pure logical function is_same(a, b)
      character(*), intent(in) :: a, b
      is_same = lower(trim(adjustl(a))) == b
   end function is_same

   !> Reads the six curves of a bushing.
   subroutine take_bushing(file, property, flaws)
      type(teimorbit_t), intent(in) :: file
      type(property_t), intent(inout) :: property
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: units(5)
      integer :: k, block

      call units_in(file, units, flaws)
      call check_units(file, units, [length_unit, force_unit, angle_unit], flaws)
      do k = 1, 6
         block = find_block(file, trim(bushing_blocks(k)))
         if (block == 0) then
            call flaws%add(0, 'expected a block ['//upper(trim(bushing_blocks(k)))//'], found none')
         else if (is_of_rotation(k)) then
            call take_points(file, block, units(angle_unit), units(force_unit)*units(length_unit), property%laws(k), flaws)
         else
            call take_points(file, block, units(length_unit), units(force_unit), property%laws(k), flaws)
         end if
      end do
   end subroutine take_bushing

   !> Reads the curve of a spring or a stop, and the free length of a spring.
   subroutine take_curve(file, property, flaws)
      type(teimorbit_t), intent(in) :: file
      type(property_t), intent(inout) :: property
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: units(5)
      integer :: block, item
      logical :: is_good

      call units_in(file, units, flaws)
      call check_units(file, units, [length_unit, force_unit], flaws)
      block = find_block(file, 'curve')
      if (block == 0) then
         call flaws%add(0, 'expected a block [CURVE], found none')
      else
         call take_points(file, block, units(length_unit), units(force_unit), property%laws(1), flaws)
      end if
      if (property%kind /= spring_file) then
         call turn_rebound(property%laws(1))
         return
      end if
      block = find_block(file, 'spring_data')
      if (block == 0) return
      item = entry_of(file, block, 'free_length')
      if (item == 0) return
      property%free_length_line = file%items(item)%line
      if (file%items(item)%used == 0) then
         call flaws%add(property%free_length_line, 'expected a number for FREE_LENGTH, found nothing')
         return
      end if
      call take_number(file%items(item)%fields(1)%text, property%free_length_line, 'FREE_LENGTH', property%free_length, &
         flaws, is_good)
      if (.not. is_good) return
      property%free_length = property%free_length*units(length_unit)
      if (.not. property%free_length > 0.0_wp) call flaws%add(property%free_length_line, 'FREE_LENGTH must be above 0, found '// &
         shown(file%items(item)%fields(1)%text))
   end subroutine take_curve

   !> Reads the points of a curve: rows of two numbers, from all blocks that have the name of `block`, and from the parts of these
   !> blocks.
   subroutine take_points(file, block, x_unit, y_unit, law, flaws)
      type(teimorbit_t), intent(in) :: file
      integer, intent(in) :: block                  !! index of the first block of its name
      real(wp), intent(in) :: x_unit, y_unit
      type(law_points_t), intent(inout) :: law
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: x, y
      logical :: is_x, is_y
      integer :: k

      law%line = file%block_lines(block)
      do k = 1, file%used
         associate (item => file%items(k))
            if (file%names(item%block) /= file%names(block)) cycle
            if (item%kind /= row_item) cycle
            if (item%used /= 2) then
               call flaws%add(item%line, 'expected 2 numbers (displacement and force), found '//str(item%used))
               law%is_bad = .true.
               cycle
            end if
            call take_number(item%fields(1)%text, item%line, 'the displacement', x, flaws, is_x)
            call take_number(item%fields(2)%text, item%line, 'the force', y, flaws, is_y)
            if (is_x .and. is_y) then
               call add_point(law, x*x_unit, y*y_unit, item%line)
            else
               law%is_bad = .true.
            end if
         end associate
      end do
      call finish_law(law, upper(trim(file%names(block))), flaws)
   end subroutine take_points

   !> Changes the signs of the law of a stop if no penetration and no force is positive.
   pure subroutine turn_rebound(law)
      type(law_points_t), intent(inout) :: law

      if (law%is_bad .or. law%used < 2) return
      if (any(law%x(:law%used) > 0.0_wp) .or. any(law%y(:law%used) > 0.0_wp)) return
      law%x(:law%used) = -law%x(law%used:1:-1)
      law%y(:law%used) = -law%y(law%used:1:-1)
      law%lines(:law%used) = law%lines(law%used:1:-1)
   end subroutine turn_rebound

   !> A string with its ASCII letters in upper case.
   pure function upper(text) result(capital)
      character(*), intent(in) :: text
      character(len(text)) :: capital
      integer :: k

      capital = text
      do k = 1, len(text)
         if (text(k:k) >= 'a' .and. text(k:k) <= 'z') capital(k:k) = achar(iachar(text(k:k)) - 32)
      end do
   end function upper

end module ek_property
