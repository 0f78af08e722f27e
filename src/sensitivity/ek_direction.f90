!> Directions in the space of designs. Each direction is one number of the deck, with its image on the other side of a mirrored
!> axle.
!>
!> A derivative with respect to a number is the derivative along its direction: the parameters of the direction change to x +
!> distance × sign × unit. All numbers of a deck with one path are one direction. A path with the name of a side
!> ('point.left_tie_rod.z') is the number of this side alone.
module ek_direction
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, replace
   use ek_deck, only: deck_t, set_value
   use ek_parameter, only: parameter_t, choice_t, find_parameters, parameter_path
   use ek_reader, only: definition_t
   use ek_study, only: by_scale
   use ek_factor_numbers, only: factor_paths_t
   use ek_factor_paths, only: is_held_in_plane
   use ek_dimension, only: length, angle
   use ek_factor_unit, only: parameter_unit, parameter_dimension
   implicit none(type, external)
   private
   public :: direction_t, all_directions, find_directions, factor_direction, move_along, shared_number, refuse_shared

   !> A number of the deck, and the numbers that change with it.
   type :: direction_t
      character(:), allocatable :: path, unit        !! path as in --set; unit, for instance 'N/mm', '' if there is no unit
      type(choice_t), allocatable :: found(:)        !! the parameters, with their signs
      real(wp) :: value = 0.0_wp                     !! value in the deck, in `unit`
      real(wp) :: si = 1.0_wp                        !! SI value of the unit
      real(wp) :: step = 0.0_wp                      !! step of differences along the direction, in `unit`
   end type direction_t

   ! Steps of differences. Their error is that of rounding, some 1e-16 of the size of a car (times a stiffness, of a force) over the
   ! step, and after extrapolation the fourth power of the step over the length on which a quantity curves, some 100 mm: a stiff
   ! bushing (300 kN/mm) rounds its force to 1e-7 N, and with a tenth of this step that is seen
   real(wp), parameter :: length_step = 0.1_wp*millimetre        !! step of lengths [m]
   real(wp), parameter :: angle_step = 1.0e-4_wp                 !! step of angles [rad]
   real(wp), parameter :: share_of_value = 1.0e-3_wp !! step of other numbers, as a share of the largest number of the same key
   real(wp), parameter :: share_of_step = 0.3_wp                 !! step for points of curves, as a share of the steps above: the
                                                                 !! points are a few mm apart

contains

   !> Lists the directions of all numbers that a deck gives. Numbers that cannot be varied (y of a point in the plane of &mirror)
   !> are omitted.
   subroutine all_directions(design, directions)
      type(definition_t), intent(in) :: design
      type(direction_t), allocatable, intent(out) :: directions(:)
      integer :: k, used

      used = design%parameters%used
      call gather(design, [(choice_t(k, design%parameters%list(k)%sign), k=1, used)], directions, .true.)
   end subroutine all_directions

   !> Finds the directions of paths, in the order of the paths, each direction once. A path with * or to a list (bushing.a.kt) leads
   !> to several directions.
   subroutine find_directions(design, deck, paths, directions, error)
      type(definition_t), intent(in) :: design
      type(deck_t), intent(in) :: deck                     !! deck of the design
      type(message_list_t), intent(in) :: paths
      type(direction_t), allocatable, intent(out) :: directions(:)
      type(error_t), allocatable, intent(out) :: error !! exit_usage: messages on all paths that lead to no number, with suggestions
      type(direction_t), allocatable :: more(:)
      type(choice_t), allocatable :: found(:)
      type(message_list_t) :: mistakes
      integer :: k, j

      allocate (directions(0))
      do k = 1, paths%count()
         call find_parameters(design%parameters, design%records, paths%line(k), found)
         call gather(design, found, more, index(paths%line(k), '*') > 0)
         if (size(more) == 0) call mistakes%add(fault_of(design, deck, paths%line(k), found))
         do j = 1, size(more)
            if (.not. is_listed(more(j)%path, directions)) directions = [directions, more(j)]
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine find_directions

   pure logical function is_listed(path, directions)
      character(*), intent(in) :: path
      type(direction_t), intent(in) :: directions(:)
      integer :: k

      is_listed = .false.
      do k = 1, size(directions)
         if (directions(k)%path == path) is_listed = .true.
      end do
   end function is_listed

   !> Describes a number that two directions have in common; '' if they have none.
   function shared_number(design, a, b) result(text)
      type(definition_t), intent(in) :: design
      type(direction_t), intent(in) :: a, b
      character(:), allocatable :: text
      integer :: j

      text = ''
      do j = 1, size(b%found)
         if (.not. any(a%found%number == b%found(j)%number)) cycle
         if (a%path == b%path) then
            text = a%path//' and '//b%path//' are the same number'
         else
            text = a%path//' and '//b%path//' both change '// &
               parameter_path(design%parameters%list(b%found(j)%number), design%records, is_of_pair=.false.)//'; remove one of them'
         end if
         return
      end do
   end function shared_number

   !> Rejects directions that have a number in common: their derivatives would count the number twice.
   subroutine refuse_shared(design, directions, error)
      type(definition_t), intent(in) :: design
      type(direction_t), intent(in) :: directions(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: all pairs of directions
      type(message_list_t) :: mistakes
      integer :: owner(design%parameters%used), k, j, other

      owner = 0
      do k = 1, size(directions)
         other = 0
         do j = 1, size(directions(k)%found)
            associate (number => directions(k)%found(j)%number)
               if (owner(number) > 0 .and. other == 0) other = owner(number)
               if (owner(number) == 0) owner(number) = k
            end associate
         end do
         if (other > 0) call mistakes%add(shared_number(design, directions(other), directions(k)))
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine refuse_shared

   !> Creates one direction for each number found. A y coordinate in the centre plane of a mirrored deck is omitted. The number of
   !> the right side joins the direction of the left number if both were found.
   subroutine gather(design, found, directions, is_free_choice)
      type(definition_t), intent(in) :: design
      type(choice_t), intent(in) :: found(:)
      type(direction_t), allocatable, intent(out) :: directions(:)
      logical, intent(in) :: is_free_choice      !! numbers that the deck does not give are omitted
      type(direction_t) :: this
      integer :: j, k

      allocate (directions(0))
      associate (list => design%parameters%list)
         do j = 1, size(found)
            k = found(j)%number
            if (any(found%number == list(k)%tied)) cycle
            if (is_held_in_plane(design, k)) cycle
            if (is_free_choice .and. .not. list(k)%is_given) cycle
            this%found = [found(j), pack(found, list(found%number)%tied == k)]
            this%path = parameter_path(list(k), design%records, is_of_pair=size(this%found) > 1)
            this%unit = parameter_unit(design, k)
            this%si = list(k)%unit
            this%value = found(j)%sign*design%parameters%x(k)/list(k)%unit
            this%step = step_of(design, k)/this%si
            if (index(this%path, 'curve.') == 1) this%step = share_of_step*this%step
            directions = [directions, this]
         end do
      end associate
   end subroutine gather

   !> The direction of a factor of a study, in which all numbers of the factor move together. In this direction, `sign` of a number
   !> is its change [SI] per change of the factor, divided by `si`; for a factor that multiplies, `sign` is the number itself. The
   !> value of the factor is not set.
   function factor_direction(design, name, paths) result(direction)
      type(definition_t), intent(in) :: design
      character(*), intent(in) :: name
      type(factor_paths_t), intent(in) :: paths            !! paths of the factor, which lead to at least one number
      type(direction_t) :: direction
      integer :: j

      direction%path = name
      allocate (direction%found, source=paths%found)
      associate (first => paths%found(1)%number, list => design%parameters%list)
         direction%unit = parameter_unit(design, first)
         direction%si = list(first)%unit
         direction%step = step_of(design, first)/direction%si
         if (index(parameter_path(list(first), design%records, is_of_pair=.false.), 'curve.') == 1) &
            direction%step = share_of_step*direction%step
         if (paths%change == by_scale) then
            direction%unit = ''
            direction%si = 1.0_wp
            direction%step = share_of_value
         end if
         do j = 1, size(paths%found)
            associate (number => paths%found(j)%number, sign => direction%found(j)%sign)
               if (paths%change == by_scale) then
                  sign = design%parameters%x(number)
               else
                  sign = sign*list(number)%unit/direction%si
               end if
            end associate
         end do
      end associate
   end function factor_direction

   !> The step of difference quotients for a number, in SI units.
   real(wp) function step_of(design, number) result(step)
      type(definition_t), intent(in) :: design
      integer, intent(in) :: number
      type(parameter_t) :: this
      real(wp) :: largest
      integer :: k

      this = design%parameters%list(number)
      select case (parameter_dimension(design, number))
      case (length)
         step = length_step
      case (angle)
         step = angle_step
      case default
         largest = 0.0_wp
         do k = 1, design%parameters%used
            associate (other => design%parameters%list(k))
               if (other%record == this%record .and. other%key == this%key) largest = max(largest, abs(design%parameters%x(k)))
            end associate
         end do
         if (.not. largest > 0.0_wp) largest = 1.0e3_wp*this%unit      ! nothing else is known of a number that is zero
         step = share_of_value*largest
      end select
   end function step_of

   !> The reason why a path leads to no number that can be varied.
   function fault_of(design, deck, path, found) result(text)
      type(definition_t), intent(in) :: design
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: path
      type(choice_t), intent(in) :: found(:)
      character(:), allocatable :: text
      type(deck_t) :: trial
      type(error_t), allocatable :: error

      if (size(found) > 0) then
         if (is_held_in_plane(design, found(1)%number)) then
            text = quoted(path)//': y of a point in the centre plane of a deck with &mirror must remain 0; list the point in '// &
               'shared of &mirror if it is to move sideways'
         else
            text = quoted(path)//': the deck does not give this number'
         end if
         return
      end if
      trial = deck
      call set_value(trial, path, '1', error)              ! its message says what is wrong with the path
      if (allocated(error)) then
         text = error%message
         call replace(text, '--set ', '')
         call replace(text, '=1: ', ': ')
         call replace(text, 'group.name.key=value', 'group.name.key')
      else if (index(path, 'part.') == 1) then
         text = quoted(path)//': the part is as drawn, and the model does not contain it yet; set it to 0 first'
      else
         text = quoted(path)//' has no derivative: it is an integer, a name or a switch, or the deck does not give it; '// &
            'only numbers that vary continuously have one'
      end if
   end function fault_of

   !> Moves all numbers of a direction by a distance along the direction.
   pure subroutine move_along(direction, distance, x)
      type(direction_t), intent(in) :: direction
      real(wp), intent(in) :: distance                     !! distance in the unit of the direction
      real(wp), intent(inout) :: x(:)                      !! numbers of the design, SI units, axes of the deck
      integer :: j

      do j = 1, size(direction%found)
         associate (at => x(direction%found(j)%number))
            at = at + direction%found(j)%sign*distance*direction%si
         end associate
      end do
   end subroutine move_along

end module ek_direction
