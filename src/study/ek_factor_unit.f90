!> The unit of a factor, which is the unit of the numbers that the factor changes. The unit is given as a label ('N/mm') and as the
!> suffix of a heading ('n_per_mm').
!>
!> A parameter contains only the SI value of its unit. The name of the unit follows from the dimension in the row of its key.
module ek_factor_unit
   use ek_dimension, only: pure_number, length, force, unit_name, is_relative, dimension_of
   use ek_group, only: key_t, find_key, group_number, spring_group
   use ek_record, only: is_given
   use ek_reader, only: definition_t
   use ek_study, only: by_scale
   use ek_factor_numbers, only: factor_paths_t
   implicit none(type, external)
   private
   public :: factor_unit, parameter_unit, parameter_dimension, unit_ending

contains

   !> The unit of a factor, for instance 'N/mm'. The unit is '' for a multiple of the deck's number, for numbers without a known
   !> unit, and for numbers of different units.
   function factor_unit(design, paths) result(unit)
      type(definition_t), intent(in) :: design
      type(factor_paths_t), intent(in) :: paths
      character(:), allocatable :: unit
      integer :: k

      unit = ''
      if (paths%change == by_scale) return
      do k = 1, size(paths%found)
         if (k == 1) unit = parameter_unit(design, paths%found(k)%number)
         if (unit == parameter_unit(design, paths%found(k)%number)) cycle
         unit = ''
         return
      end do
   end function factor_unit

   !> The unit of a number of the deck; '' if the unit is not known.
   function parameter_unit(design, number) result(unit)
      type(definition_t), intent(in) :: design
      integer, intent(in) :: number
      character(:), allocatable :: unit
      unit = unit_name(parameter_dimension(design, number), design%plan%prototype%units)
   end function parameter_unit

   !> The dimension of a number of the deck (ek_dimension); pure_number also if the dimension is not known.
   integer function parameter_dimension(design, number) result(dimension)
      type(definition_t), intent(in) :: design
      integer, intent(in) :: number
      type(key_t) :: row
      logical :: is_known

      associate (this => design%parameters%list(number), record => design%records(design%parameters%list(number)%record))
         call find_key(group_number(record%group), trim(this%key), row, is_known)
         dimension = row%dimension
         if (is_relative(dimension)) then      ! a unit is named only if it follows from the record itself
            if (group_number(record%group) /= spring_group .or. is_given(record, 'measure')) then
               dimension = pure_number
            else
               dimension = dimension_of(dimension, length, force, pure_number)
            end if
         end if
      end associate
   end function parameter_dimension

   !> A unit as the suffix of a heading: 'n_per_mm' for 'N/mm', 'nmm_per_deg' for 'N mm/deg', 'm_per_s2' for 'm/s²'.
   pure function unit_ending(unit) result(ending)
      character(*), intent(in) :: unit
      character(:), allocatable :: ending
      integer :: k

      ending = ''
      do k = 1, len(unit)
         select case (unit(k:k))
         case (' ')
         case ('/')
            ending = ending//'_per_'
         case ('A':'Z')
            ending = ending//achar(iachar(unit(k:k)) + 32)
         case default
            if (iachar(unit(k:k)) < 128) ending = ending//unit(k:k)
         end select
      end do
      if (index(unit, '²') > 0) ending = ending//'2'
   end function unit_ending

end module ek_factor_unit
