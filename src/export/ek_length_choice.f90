!> The elements of a model that are spring, damper, bump stop and bar of a wheel.
!>
!> Without a choice of the user, these are the only spring, damper and bump stop of the wheel. On an axle, the names of these
!> elements begin with left_ or right_, as &mirror creates them. A missing damper has the length of the spring, a missing stop the
!> length of the damper. A missing spring on two points is replaced by the travel of the wheel with the opposite sign: a spring of
!> ratio 1, which shortens in bump. A bar that was not chosen is replaced by the travel tz. The rate of such a spring or bar in the
!> simulator is then the rate at the wheel.
module ek_length_choice
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, suggestion
   use ek_element, only: element_t, axial_spring, damper, stop_spring
   use ek_measure, only: is_of_angle
   use ek_suspension, only: suspension_t
   use ek_wheel_side, only: left_and_right, prefix_of, side_name
   use ek_wheel_motion, only: length_choice_t, lengths, length_names, spring_length, damper_length, stop_length, bar_length
   implicit none(type, external)
   private
   public :: choose_lengths

contains

   !> Chooses the four lengths of both sides. `wishes` are strings such as 'spring=NAME' or 'damper=LEFT,RIGHT'.
   subroutine choose_lengths(suspension, wishes, choices, error)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(in) :: wishes
      type(length_choice_t), intent(out) :: choices(lengths, 2)      !! left, right; of a side without a wheel nothing
      type(error_t), allocatable, intent(out) :: error               !! exit_usage: every error
      type(message_list_t) :: mistakes
      character(:), allocatable :: wish, name
      integer :: wheels(2), side, j, k, equals

      call left_and_right(suspension, wheels)
      do k = 1, wishes%count()
         wish = wishes%line(k)
         equals = index(wish, '=')
         j = 0
         if (equals > 1) j = findloc(length_names == wish(:equals - 1), .true., dim=1)
         if (j == 0) call mistakes%add('--length: expected spring=NAME, damper=NAME, stop=NAME or bar=NAME, found '//quoted(wish))
      end do
      do side = 1, 2
         if (wheels(side) == 0) cycle
         do j = 1, lengths
            name = ''
            do k = 1, wishes%count()
               wish = wishes%line(k)
               if (index(wish, trim(length_names(j))//'=') == 1) name = wish(len_trim(length_names(j)) + 2:)
            end do
            if (name == '') then
               call choose_itself(suspension, wheels(side), side, j, choices(j, side), mistakes)
            else
               call take_named(suspension, wheels(side), side, j, name, choices(j, side), mistakes)
            end if
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine choose_lengths

   !> Chooses the only element of a kind, or the replacement of a missing element. Several elements are an error.
   subroutine choose_itself(suspension, wheel, side, j, choice, mistakes)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel, side, j
      type(length_choice_t), intent(inout) :: choice
      type(message_list_t), intent(inout) :: mistakes
      character(:), allocatable :: prefix, names
      integer :: k, found

      prefix = prefix_of(suspension, wheel)
      found = 0
      names = ''
      do k = 1, suspension%scalars
         associate (element => suspension%elements(k))
            if (.not. is_kind(element, j)) cycle
            if (index(element%name, prefix) /= 1) cycle
            names = names//' '//quoted(element%name(len(prefix) + 1:))
            found = found + 1
            call take(choice, element%name)
            choice%measure = element%measure
         end associate
      end do
      if (found == 1) return
      if (found > 1) then
         if (side == 1 .or. size(suspension%wheels) == 1) call mistakes%add('--length: expected '//trim(length_names(j))// &
            '=NAME, as a wheel has several of them; found'//names)
         return
      end if
      select case (j)
      case (spring_length)
         choice%sign = -1.0_wp
         choice%label = '-tz'
      case (damper_length)
         choice%same_as = spring_length
         choice%label = 'lSpring'
      case (stop_length)
         choice%same_as = damper_length
         choice%label = 'lDamp'
      case (bar_length)
         choice%label = 'tz'
      end select
   end subroutine choose_itself

   !> Chooses an element or a measure by name: NAME stands for left_NAME or right_NAME on an axle; LEFT,RIGHT gives one name per
   !> side.
   subroutine take_named(suspension, wheel, side, j, name, choice, mistakes)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: wheel, side, j
      character(*), intent(in) :: name
      type(length_choice_t), intent(inout) :: choice
      type(message_list_t), intent(inout) :: mistakes
      character(64), allocatable :: names(:)
      character(:), allocatable :: wanted
      integer :: k, comma

      comma = index(name, ',')
      wanted = name
      if (comma > 0 .and. side == 1) wanted = name(:comma - 1)
      if (comma > 0 .and. side == 2) wanted = name(comma + 1:)
      if (comma == 0) wanted = prefix_of(suspension, wheel)//name
      allocate (names(suspension%scalars + size(suspension%readouts)))
      do k = 1, suspension%scalars
         names(k) = suspension%elements(k)%name
         if (names(k) /= wanted .or. is_of_angle(suspension%elements(k)%measure%kind)) cycle
         choice%measure = suspension%elements(k)%measure
         call take(choice, wanted)
      end do
      do k = 1, size(suspension%readouts)
         names(suspension%scalars + k) = suspension%readouts(k)%name
         if (suspension%readouts(k)%name /= wanted .or. is_of_angle(suspension%readouts(k)%measure%kind)) cycle
         choice%measure = suspension%readouts(k)%measure
         call take(choice, wanted)
      end do
      if (choice%has_measure) return
      call mistakes%add('--length '//trim(length_names(j))//'='//name//': the '//trim(side_name(side))//' wheel has no spring, '// &
         'damper, stop or measure '//quoted(wanted)//' that is a length'//suggestion(wanted, names))
   end subroutine take_named

   !> Accepts a measure as the length, with its label.
   subroutine take(choice, label)
      type(length_choice_t), intent(inout) :: choice
      character(*), intent(in) :: label

      choice%has_measure = .true.
      choice%label = label
   end subroutine take

   !> Whether an element gives length j without a choice of the user: springs on two points, dampers, and bump stops. A rebound stop
   !> does not, because it acts in tension. No element gives the length of the bar.
   pure logical function is_kind(element, j)
      type(element_t), intent(in) :: element
      integer, intent(in) :: j

      select case (j)
      case (spring_length)
         is_kind = element%kind == axial_spring
      case (damper_length)
         is_kind = element%kind == damper
      case (stop_length)
         is_kind = element%kind == stop_spring .and. element%law%sign < 0.0_wp
      case default
         is_kind = .false.
      end select
   end function is_kind

end module ek_length_choice
