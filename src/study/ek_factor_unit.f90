!> The unit of a factor, which is the unit of the numbers that the factor changes. The unit is given as a label ('N/mm') and as the
!> suffix of a heading ('n_per_mm').
!>
!> A parameter contains only the SI value of its unit. The name of the unit follows from group and key, by one table in this module.
module ek_factor_unit
   use ek_kinds, only: wp, millimetre, degree
   use ek_record, only: is_given
   use ek_reader, only: definition_t
   use ek_study, only: by_scale
   use ek_factor_numbers, only: factor_paths_t
   implicit none(type, external)
   private
   public :: factor_unit, parameter_unit, unit_ending

   !> Keys of one unit. L, F and A are length, force and angle in the units of the deck. A blank separates factors; '/' precedes the
   !> divisor.
   type :: unit_row_t
      character(8) :: unit
      character(200) :: keys             !! group.key, separated and enclosed by blanks
   end type unit_row_t

   type(unit_row_t), parameter :: rows(*) = [ &
      unit_row_t('L', ' point.at wheel.radius wheel.tyre_width axle.wheelbase axle.cg_height axle.front_overhang'// &
         ' axle.front_width spring.free_length stop.clearance stop.rounding steering.ratio steering.travel case.offset '), &
      unit_row_t('F', ' load.force bushing.preload_force damper.gas_force spring.preload '), &
      unit_row_t('F L', ' load.moment bushing.preload_moment torsion.preload '), &
      unit_row_t('F/L', ' bushing.kt spring.rate stop.rate damper.gas_rate wheel.tyre_rate '), &
      unit_row_t('F L/A', ' bushing.kr torsion.rate '), &
      unit_row_t('A', ' wheel.toe wheel.camber '), &
      unit_row_t('kg', ' body.mass mass.kg wheel.sprung_mass axle.mass '), &
      unit_row_t('m/s²', ' model.gravity ')]

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
      character(:), allocatable :: unit, path
      integer :: k

      unit = ''
      associate (this => design%parameters%list(number), plan => design%plan)
         path = ' '//trim(design%records(this%record)%group)//'.'//trim(this%key)//' '
         do k = 1, size(rows)
            if (index(rows(k)%keys, path) > 0) exit
         end do
         if (k > size(rows)) return
         ! the rate of a spring on a &measure is a moment per angle if this is an angle
         if (path == ' spring.rate ' .or. path == ' spring.preload ') then
            if (is_given(design%records(this%record), 'measure')) return
         end if
         unit = written(trim(rows(k)%unit))
      end associate

   contains

      !> The unit of a pattern such as 'F L/A', with the unit names of the deck: 'N mm/deg'.
      function written(pattern) result(text)
         character(*), intent(in) :: pattern
         character(:), allocatable :: text
         integer :: j

         text = ''
         do j = 1, len(pattern)
            select case (pattern(j:j))
            case ('L')
               text = text//trim(merge('mm', 'm ', design%plan%length_unit < 1.5_wp*millimetre))
            case ('F')
               text = text//trim(merge('kN', 'N ', design%plan%force_unit > 500.0_wp))
            case ('A')
               text = text//merge('deg', 'rad', design%plan%angle_unit < 1.5_wp*degree)
            case default
               text = text//pattern(j:j)
            end select
         end do
      end function written

   end function parameter_unit

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
