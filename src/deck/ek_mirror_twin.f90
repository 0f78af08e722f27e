!> The mirror image of one record under y → −y: numbers, sense of an axis, side.
module ek_mirror_twin
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_rotation, only: perpendicular
   use ek_record, only: record_t, entry_t, value_t, add_entry, add_value, element, entry_index, is_given
   use ek_group, only: number
   use ek_namelist, only: value_fault
   use ek_mirror_role, only: role_of, turns, polar, axial, curves, side
   implicit none(type, external)
   private
   public :: reflect, complete_marker, number_of

contains

   !> Creates the mirror image of a record; names are unchanged.
   subroutine reflect(record)
      type(record_t), intent(inout) :: record
      integer :: e, role

      do e = 1, record%used
         role = role_of(record, record%entries(e)%key)
         associate (entry => record%entries(e))
            select case (role)
            case (polar)
               call turn_round(entry, [2])
            case (axial)
               call turn_round(entry, [1, 3])
            case (curves)
               call turn_curves(entry)
            case (side)
               if (lower(entry%values(1)%text) == 'left') entry%values(1)%text = 'right'
            end select
            if (entry%key == 'axis' .and. turns(record)) call exchange_ends(entry)
         end associate
      end do
   end subroutine reflect

   !> Changes the sign of some elements of a key; invalid numbers are left for the check of values.
   subroutine turn_round(entry, which)
      type(entry_t), intent(inout) :: entry
      integer, intent(in) :: which(:)      !! subscripts
      integer :: k

      do k = 1, entry%used
         if (.not. any(which == entry%first + k - 1)) cycle
         if (value_fault(entry%values(k), number) /= '') cycle
         call turn_number(entry%values(k)%text)
      end do
   end subroutine turn_round

   !> '5' ↔ '-5'; zero has no sign.
   subroutine turn_number(text)
      character(:), allocatable, intent(inout) :: text

      if (verify(text(:scan(text//'e', 'eEdD') - 1), '+-0.') == 0) return
      select case (text(1:1))
      case ('-')
         text = text(2:)
      case ('+')
         text = '-'//text(2:)
      case default
         text = '-'//text
      end select
   end subroutine turn_number

   !> 'fy=c' ↔ 'fy=-c', for the components whose sign changes in marker axes.
   subroutine turn_curves(entry)
      type(entry_t), intent(inout) :: entry
      character(:), allocatable :: name, component
      integer :: k, mark

      do k = 1, entry%used
         mark = index(entry%values(k)%text, '=')
         if (mark < 2) cycle
         component = trim(adjustl(lower(entry%values(k)%text(:mark - 1))))
         if (.not. any(component == [character(2) :: 'fy', 'mx', 'mz'])) cycle
         name = trim(adjustl(entry%values(k)%text(mark + 1:)))
         if (index(name, '-') == 1) then
            name = trim(adjustl(name(2:)))
         else
            name = '-'//name
         end if
         entry%values(k)%text = component//'='//name
      end do
   end subroutine turn_curves

   !> Exchanges the two points of an axis.
   subroutine exchange_ends(entry)
      type(entry_t), intent(inout) :: entry
      type(value_t) :: kept

      if (entry%used == 2 .and. entry%first == 1) then
         kept = entry%values(1)
         entry%values(1) = entry%values(2)
         entry%values(2) = kept
      else if (entry%used == 1 .and. entry%first <= 2) then
         entry%first = 3 - entry%first
      end if
   end subroutine exchange_ends

   !> If only one of the two axes of a bushing is given, `perpendicular` chooses the other, but not symmetrically on
   !> both sides. Therefore the choice for the left side is written into the record.
   subroutine complete_marker(records, original, copy)
      type(record_t), intent(in) :: records(:)      !! of the half deck, which contains the points
      type(record_t), intent(in) :: original        !! with the names of the half deck
      type(record_t), intent(inout) :: copy         !! receives x_vector or z_vector
      type(entry_t) :: added
      real(wp) :: axis(3), chosen(3)
      character(32) :: text
      logical :: has_x, has_z, is_known
      integer :: k

      if (original%group /= 'bushing') return
      has_x = is_given(original, 'x_axis') .or. is_given(original, 'x_vector')
      has_z = is_given(original, 'z_axis') .or. is_given(original, 'z_vector')
      if (has_x .eqv. has_z) return
      call find_axis(records, original, merge('x_axis', 'z_axis', has_x), merge('x_vector', 'z_vector', has_x), axis, is_known)
      if (.not. is_known) return
      chosen = perpendicular(axis)
      added%key = merge('z_vector', 'x_vector', has_x)
      added%line = original%line
      do k = 1, 3
         write (text, '(es24.16)') chosen(k)
         call add_value(added, trim(adjustl(text)), .false., .false.)
      end do
      call add_entry(copy, added)
   end subroutine complete_marker

   !> A direction in deck axes, unit length; unknown if it has a mistake.
   subroutine find_axis(records, record, points_key, vector_key, axis, is_known)
      type(record_t), intent(in) :: records(:), record
      character(*), intent(in) :: points_key, vector_key
      real(wp), intent(out) :: axis(3)
      logical, intent(out) :: is_known
      real(wp) :: ends(3, 2)
      logical :: is_there(2)
      integer :: k, j

      if (is_given(record, vector_key)) then
         call vector_of(record, vector_key, axis, is_known)
      else
         is_there = .false.
         ends = 0.0_wp
         do j = 1, 2
            do k = 1, size(records)
               if (records(k)%group /= 'point') cycle
               if (element(records(k), 'name', 1) /= element(record, points_key, j)) cycle
               call vector_of(records(k), 'at', ends(:, j), is_there(j))
            end do
         end do
         axis = ends(:, 2) - ends(:, 1)
         is_known = all(is_there)
      end if
      if (is_known) is_known = norm2(axis) > 0.0_wp
      if (is_known) axis = axis/norm2(axis)
   end subroutine find_axis

   !> Three numbers of a key, deck units.
   subroutine vector_of(record, key, vector, is_known)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      real(wp), intent(out) :: vector(3)
      logical, intent(out) :: is_known
      logical :: is_number(3)
      integer :: k

      do k = 1, 3
         call number_of(record, key, k, vector(k), is_number(k))
      end do
      is_known = all(is_number)
   end subroutine vector_of

   !> Element `at` of a key as a number; 0 if it is not a number.
   subroutine number_of(record, key, at, value, is_known)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      real(wp), intent(out) :: value
      logical, intent(out) :: is_known
      integer :: e, status

      value = 0.0_wp
      e = entry_index(record, key, at)
      is_known = e > 0
      if (.not. is_known) return
      associate (given => record%entries(e)%values(at - record%entries(e)%first + 1))
         is_known = value_fault(given, number) == ''
         if (.not. is_known) return
         read (given%text, *, iostat=status) value
         is_known = status == 0
      end associate
   end subroutine number_of

end module ek_mirror_twin
