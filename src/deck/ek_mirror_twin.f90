!> The mirror image of one record under y → −y: numbers, sense of an axis, side.
module ek_mirror_twin
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_record, only: record_t, entry_t, value_t, entry_index
   use ek_group, only: number
   use ek_namelist, only: value_fault
   use ek_mirror_role, only: role_of, turns, polar, axial, curves, side
   implicit none(type, external)
   private
   public :: reflect, number_of

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
