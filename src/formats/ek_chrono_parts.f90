!> Parts of a suspension of Chrono: the law of a spring or shock with its stops, and the bushing of an arm.
!>
!> The force of a spring pushes its ends apart: preload - rate (length - free length), or preload - curve(length - free length).
!> Stops act if the file has both lengths. A map of forces over deformation and speed counts at speed 0.
module ek_chrono_parts
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_flaws, only: flaws_t, shown
   use ek_json_tree, only: json_tree_t, find_leaf, has_branch, branch_line
   use ek_axle_facts, only: spring_part_t, bushing_part_t
   implicit none(type, external)
   private
   public :: take_spring, take_bushing, take_axes, take_angle, take_value, take_positive

   integer, parameter :: most_points = 200      !! of a curve of a deck

contains

   !> Takes the law of a spring or a shock. A part without a force at rest is a damper.
   subroutine take_spring(tree, object, part, assumed, omitted, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object               !! 'Spring' or 'Shock'
      type(spring_part_t), intent(inout) :: part
      type(message_list_t), intent(inout) :: assumed, omitted
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: preload
      logical :: has_preload

      call take_value(tree, object//'/Preload', preload, has_preload, flaws)
      part%is_given = .true.
      part%line = branch_line(tree, object//'/')
      if (has_branch(tree, object//'/Map Data')) then
         call take_map(tree, object, preload, part, flaws)
      else if (has_branch(tree, object//'/Spring Curve Data')) then
         call take_curve(tree, object, preload, part, flaws)
      else if (find_leaf(tree, object//'/Spring Coefficient') > 0) then
         call take_rate(tree, object, preload, part, flaws)
      else if (object == 'Spring') then
         call flaws%add(part%line, 'expected ''Spring Coefficient'', ''Spring Curve Data'' or ''Map Data'' of '//shown(object)// &
            ', found none of them')
      end if
      part%name = 'spring'
      if (object == 'Shock') part%name = merge('spring_damper', 'damper       ', part%has_law)
      if (allocated(part%x)) call assumed%add('beyond its points, the curve of '//object//' continues straight')
      if (part%has_law) call take_stops(tree, object, part, omitted, flaws)
   end subroutine take_spring

   !> Takes a constant rate. A preload is a longer free length.
   subroutine take_rate(tree, object, preload, part, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object
      real(wp), intent(in) :: preload
      type(spring_part_t), intent(inout) :: part
      type(flaws_t), intent(inout) :: flaws
      logical :: is_good

      call take_positive(tree, object//'/Spring Coefficient', part%rate, is_good, flaws)
      if (.not. is_good) return
      part%line = tree%leaves(find_leaf(tree, object//'/Spring Coefficient'))%line
      call take_positive(tree, object//'/Free Length', part%free_length, is_good, flaws)
      if (.not. is_good) return
      part%free_length = part%free_length + preload/part%rate
      part%has_law = part%free_length > 0.0_wp
      if (.not. part%has_law) call flaws%add(part%line, 'expected a positive length without force (''Free Length'' plus '// &
         '''Preload'' per ''Spring Coefficient'') of '//shown(object)//', found '//str(part%free_length))
   end subroutine take_rate

   !> Takes a curve of force over deformation, which is negative in compression.
   subroutine take_curve(tree, object, preload, part, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object
      real(wp), intent(in) :: preload
      type(spring_part_t), intent(inout) :: part
      type(flaws_t), intent(inout) :: flaws
      real(wp), allocatable :: rows(:, :)
      character(:), allocatable :: path
      logical :: is_good

      path = object//'/Spring Curve Data'
      part%line = branch_line(tree, path//'/')
      call take_rows(tree, path, 2, rows, flaws)
      if (.not. allocated(rows)) return
      call take_positive(tree, object//'/Free Length', part%free_length, is_good, flaws)
      if (.not. is_good) return
      call keep_curve(rows(1, :), rows(2, :), preload, part, flaws)
   end subroutine take_curve

   !> Takes the forces of a map at speed 0. Its deformation is the length minus the free length, which is 0.
   subroutine take_map(tree, object, preload, part, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object
      real(wp), intent(in) :: preload
      type(spring_part_t), intent(inout) :: part
      type(flaws_t), intent(inout) :: flaws
      real(wp), allocatable :: rows(:, :), lengths(:), forces(:)
      real(wp) :: share
      integer :: k, n

      part%line = branch_line(tree, object//'/Map Data/')
      call take_list(tree, object//'/Deformation', lengths, flaws)
      if (.not. allocated(lengths)) return
      n = size(lengths)
      call take_rows(tree, object//'/Map Data', n + 1, rows, flaws)
      if (.not. allocated(rows)) return
      do k = 2, size(rows, 2)
         if (rows(1, k) <= rows(1, k - 1)) exit
      end do
      if (k <= size(rows, 2) .or. rows(1, 1) > 0.0_wp .or. rows(1, size(rows, 2)) < 0.0_wp) then
         call flaws%add(part%line, 'expected increasing speeds from below 0 to above 0 in ''Map Data'', found others')
         return
      end if
      k = max(2, findloc(rows(1, :) >= 0.0_wp, .true., dim=1))
      share = -rows(1, k - 1)/(rows(1, k) - rows(1, k - 1))
      forces = (1.0_wp - share)*rows(2:, k - 1) + share*rows(2:, k)
      if (.not. any(abs(forces) > 0.0_wp) .and. .not. abs(preload) > 0.0_wp) return
      part%free_length = lengths(n)
      if (part%free_length > 0.0_wp) then
         call keep_curve(lengths - lengths(n), forces, preload, part, flaws)
      else
         call flaws%add(part%line, 'expected a positive length at the end of ''Deformation'', found '//str(lengths(n)))
      end if
   end subroutine take_map

   !> Stores a curve of force over extension as a curve of compressive force over compression.
   subroutine keep_curve(extension, force, preload, part, flaws)
      real(wp), intent(in) :: extension(:), force(:), preload
      type(spring_part_t), intent(inout) :: part
      type(flaws_t), intent(inout) :: flaws
      integer :: n

      n = size(extension)
      if (any(extension(2:) <= extension(:n - 1))) then
         call flaws%add(part%line, 'expected increasing deformations, found others')
         return
      end if
      part%x = -extension(n:1:-1) + 0.0_wp      ! no −0
      part%y = preload - force(n:1:-1)
      part%has_law = .true.
   end subroutine keep_curve

   !> Takes the lengths at which the stops are touched. Chrono uses them if both are given.
   subroutine take_stops(tree, object, part, omitted, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object
      type(spring_part_t), intent(inout) :: part
      type(message_list_t), intent(inout) :: omitted
      type(flaws_t), intent(inout) :: flaws
      logical :: has(2)

      call take_value(tree, object//'/Minimum Length', part%shortest, has(1), flaws)
      call take_value(tree, object//'/Maximum Length', part%longest, has(2), flaws)
      if (.not. any(has)) return
      part%stop_line = tree%leaves(max(find_leaf(tree, object//'/Minimum Length'), find_leaf(tree, object//'/Maximum Length')))%line
      part%has_stops = all(has) .and. part%shortest > 0.0_wp .and. part%longest > part%shortest
      if (part%has_stops) return
      if (all(has)) then
         call omitted%add('line '//str(part%stop_line)//': stops of '//object//': Minimum Length is not below Maximum Length')
      else
         call omitted%add('line '//str(part%stop_line)//': stop of '//object//': Chrono uses none without both lengths')
      end if
   end subroutine take_stops

   !> Takes the bushing of an arm, if the file has one.
   subroutine take_bushing(tree, object, bushing, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: object
      type(bushing_part_t), intent(inout) :: bushing
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: path
      logical :: has_free, is_good(2)

      path = object//'/Bushing Data'
      if (.not. has_branch(tree, path)) return
      bushing%line = branch_line(tree, path//'/')
      call take_positive(tree, path//'/Stiffness Linear', bushing%kt, is_good(1), flaws)
      call take_positive(tree, path//'/Stiffness Rotational', bushing%kr, is_good(2), flaws)
      call take_value(tree, path//'/DOF/Stiffness Rotational', bushing%kr_free, has_free, flaws)
      if (has_free .and. bushing%kr_free < 0.0_wp) call flaws%add(bushing%line, 'expected a stiffness of 0 or more for '// &
         shown(path//'/DOF/Stiffness Rotational')//', found '//str(bushing%kr_free))
      bushing%is_given = all(is_good)
   end subroutine take_bushing

   !> Takes a number. A value that is no number is an error.
   subroutine take_value(tree, path, value, has, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      real(wp), intent(out) :: value                   !! 0 if there is none
      logical, intent(out) :: has
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      value = 0.0_wp
      k = find_leaf(tree, path)
      has = k > 0
      if (.not. has) return
      has = tree%leaves(k)%is_number
      if (has) value = tree%leaves(k)%value
      if (.not. has) call flaws%add(tree%leaves(k)%line, 'expected a number for '//shown(path)//', found '// &
         shown(tree%leaves(k)%text))
   end subroutine take_value

   !> Takes a number that must be given and positive.
   subroutine take_positive(tree, path, value, is_good, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      real(wp), intent(out) :: value
      logical, intent(out) :: is_good
      type(flaws_t), intent(inout) :: flaws
      logical :: has
      integer :: k

      call take_value(tree, path, value, has, flaws)
      is_good = has .and. value > 0.0_wp
      if (is_good) return
      k = find_leaf(tree, path)
      if (k == 0) then
         call flaws%add(branch_line(tree, path(:index(path, '/'))), 'expected '//shown(path)//', found none')
      else if (has) then
         call flaws%add(tree%leaves(k)%line, 'expected a positive number for '//shown(path)//', found '// &
            shown(tree%leaves(k)%text))
      end if
   end subroutine take_positive

   !> Takes three numbers: a point or an axis.
   subroutine take_axes(tree, path, what, at, line, is_good, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path, what
      real(wp), intent(out) :: at(3)
      integer, intent(out) :: line                     !! of the last number
      logical, intent(out) :: is_good
      type(flaws_t), intent(inout) :: flaws
      integer :: c, k

      at = 0.0_wp
      line = 0
      is_good = .false.
      do c = 1, 3
         k = find_leaf(tree, path//'/'//str(c))
         if (k == 0) then
            call flaws%add(branch_line(tree, path), 'expected three numbers for '//shown(path)//' ('//what//'), found '//str(c - 1))
            return
         else if (.not. tree%leaves(k)%is_number) then
            call flaws%add(tree%leaves(k)%line, 'expected a number for '//shown(path)//', found '//shown(tree%leaves(k)%text))
            return
         end if
         at(c) = tree%leaves(k)%value
         line = tree%leaves(k)%line
      end do
      is_good = find_leaf(tree, path//'/4') == 0
      if (.not. is_good) call flaws%add(line, 'expected three numbers for '//shown(path)//', found more')
   end subroutine take_axes

   !> Takes a list of 2 to 200 numbers; not allocated after an error.
   subroutine take_list(tree, path, values, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      real(wp), allocatable, intent(out) :: values(:)
      type(flaws_t), intent(inout) :: flaws
      integer :: first, n

      call find_leaves(tree, path, first, n)
      if (n < 2 .or. n > most_points) then
         call flaws%add(branch_line(tree, path), 'expected 2 to '//str(most_points)//' numbers in '//shown(path)// &
            ', found '//str(n))
      else if (.not. all(tree%leaves(first:first + n - 1)%is_number)) then
         call flaws%add(tree%leaves(first)%line, 'expected numbers only in '//shown(path)//', found others')
      else
         values = tree%leaves(first:first + n - 1)%value
      end if
   end subroutine take_list

   !> Takes a list of 2 to 200 rows of equally many numbers; not allocated after an error.
   subroutine take_rows(tree, path, width, rows, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      integer, intent(in) :: width
      real(wp), allocatable, intent(out) :: rows(:, :)
      type(flaws_t), intent(inout) :: flaws
      integer :: first, n, k, row, column

      call find_leaves(tree, path, first, n)
      if (n < 2*width .or. n > most_points*width) then
         call flaws%add(branch_line(tree, path), 'expected 2 to '//str(most_points)//' rows of '//str(width)//' numbers in '// &
            shown(path)//', found '//str(n)//' numbers')
         return
      end if
      do k = 0, n - 1
         row = k/width + 1
         column = modulo(k, width) + 1
         associate (leaf => tree%leaves(first + k))
            if (leaf%is_number .and. leaf%path == path//'/'//str(row)//'/'//str(column)) cycle
            call flaws%add(leaf%line, 'expected '//str(width)//' numbers in each row of '//shown(path)//', found '// &
               shown(leaf%text)//' in row '//str(row))
            return
         end associate
      end do
      if (modulo(n, width) > 0) then
         call flaws%add(tree%leaves(first + n - 1)%line, 'expected '//str(width)//' numbers in each row of '//shown(path)// &
            ', found '//str(modulo(n, width))//' in the last row')
         return
      end if
      rows = reshape(tree%leaves(first:first + n - 1)%value, [width, n/width])
   end subroutine take_rows

   !> Finds the first value of a list, and the number of its values.
   pure subroutine find_leaves(tree, path, first, n)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: path
      integer, intent(out) :: first, n
      integer :: k

      first = 0
      n = 0
      do k = 1, tree%used
         if (index(tree%leaves(k)%path, path//'/') /= 1) cycle
         if (n == 0) first = k
         n = n + 1
      end do
   end subroutine find_leaves

   !> Takes a static angle [deg]: camber is positive if the top leans outboard, toe is positive if the front edge is inboard.
   subroutine take_angle(tree, key, value, has, line, flaws)
      type(json_tree_t), intent(in) :: tree
      character(*), intent(in) :: key
      real(wp), intent(inout) :: value
      logical, intent(inout) :: has
      integer, intent(inout) :: line                   !! unchanged without the angle
      type(flaws_t), intent(inout) :: flaws
      integer :: k

      k = find_leaf(tree, key)
      has = k > 0
      if (.not. has) return
      has = tree%leaves(k)%is_number
      if (has) has = abs(tree%leaves(k)%value) < 45.0_wp
      if (has) then
         value = tree%leaves(k)%value
         line = tree%leaves(k)%line
      else
         call flaws%add(tree%leaves(k)%line, 'expected '//shown(key)//' between -45 and 45, found '//shown(tree%leaves(k)%text))
      end if
   end subroutine take_angle

end module ek_chrono_parts
