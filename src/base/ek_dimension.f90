!> Dimensions of the numbers of a deck: the SI value and the name of the unit of each dimension, in the units of the deck.
!>
!> The dimension of a key is in its row of the table of keys (ek_group). The dimension of some keys follows from the record that
!> their record names: `deflection` and `reaction` are the two of the measure, driver or element (a length and a force, or an angle
!> and a moment), `reaction_rate` is their quotient, and `swept` is the dimension of the swept value of a case. `dimension_of`
!> replaces these four by the dimension that they have in a record.
module ek_dimension
   use ek_kinds, only: wp, units_t, millimetre, degree, inch, pound, standard_gravity
   use ek_text, only: lower
   implicit none(type, external)
   private
   public :: unit_size, unit_name, unit_formula, dimension_of, is_relative, units_of

   integer, parameter, public :: pure_number = 0, length = 1, force = 2, angle = 3, moment = 4, rate = 5, rotation_rate = 6, &
      mass = 7, kilograms = 8, acceleration = 9, gravities = 10      !! kilograms: a mass that is always in kg; gravities: in g
   integer, parameter, public :: deflection = 11, reaction = 12, reaction_rate = 13, swept = 14

   !> The unit of each dimension from pure_number on: L, F, A and M are length, force, angle and mass in the units of the deck. A
   !> blank separates factors; '/' precedes the divisor.
   character(5), parameter :: patterns(pure_number:gravities) = [character(5) :: '', 'L', 'F', 'A', 'F L', 'F/L', 'F L/A', 'M', &
      'kg', 'm/s²', 'g']

   !> A unit that &model may select.
   type :: unit_t
      character(3) :: name
      real(wp) :: size        !! SI value
   end type unit_t

   type(unit_t), parameter :: length_units(*) = [unit_t('mm', millimetre), unit_t('m', 1.0_wp), unit_t('in', inch)]
   type(unit_t), parameter :: force_units(*) = [unit_t('N', 1.0_wp), unit_t('kN', 1000.0_wp), &
      unit_t('lbf', pound*standard_gravity)]
   type(unit_t), parameter :: angle_units(*) = [unit_t('deg', degree), unit_t('rad', 1.0_wp)]
   type(unit_t), parameter :: mass_units(*) = [unit_t('kg', 1.0_wp), unit_t('lb', pound)]
   character(*), parameter, public :: length_names(*) = length_units%name, force_names(*) = force_units%name, &
      angle_names(*) = angle_units%name, mass_names(*) = mass_units%name      !! units that &model may select, the default first

   !> The unit of each dimension in terms of the keys of &model, or as a fixed unit.
   character(20), parameter :: formulas(pure_number:swept) = [character(20) :: '', 'length', 'force', 'angle', 'force*length', &
      'force/length', 'force*length/angle', 'mass', 'kg', 'm/s2', 'g', 'deflection', 'reaction', 'reaction/deflection', 'swept']

contains

   !> The units with these names. Letter case is ignored; an unknown or blank name gives the default mm, N, deg or kg.
   pure function units_of(length_name, force_name, angle_name, mass_name) result(units)
      character(*), intent(in) :: length_name, force_name, angle_name, mass_name
      type(units_t) :: units

      units = units_t(size_in(length_units, length_name), size_in(force_units, force_name), size_in(angle_units, angle_name), &
         size_in(mass_units, mass_name))
   end function units_of

   !> The SI value of the unit with a name; the value of the first unit if there is no such name.
   pure real(wp) function size_in(units, name)
      type(unit_t), intent(in) :: units(:)
      character(*), intent(in) :: name
      integer :: k

      size_in = units(1)%size
      do k = 2, size(units)
         if (lower(units(k)%name) == lower(name)) size_in = units(k)%size
      end do
   end function size_in

   !> The name of the unit with an SI value.
   pure function name_in(units, size_of_unit) result(name)
      type(unit_t), intent(in) :: units(:)
      real(wp), intent(in) :: size_of_unit
      character(:), allocatable :: name
      name = trim(units(minloc(abs(units%size - size_of_unit), dim=1))%name)
   end function name_in

   !> Whether a dimension follows from the record that a record names.
   elemental logical function is_relative(dimension)
      integer, intent(in) :: dimension
      is_relative = dimension >= deflection
   end function is_relative

   !> The dimension of a number in a record: that of its key, unless this is relative.
   pure integer function dimension_of(dimension, of_deflection, of_reaction, of_swept)
      integer, intent(in) :: dimension          !! dimension of the key
      integer, intent(in) :: of_deflection, of_reaction, of_swept      !! dimensions in the record
      integer, parameter :: rates(pure_number:angle) = [moment, rate, pure_number, rotation_rate]

      select case (dimension)
      case (deflection)
         dimension_of = of_deflection
      case (reaction)
         dimension_of = of_reaction
      case (reaction_rate)
         dimension_of = pure_number
         if (of_reaction /= pure_number) dimension_of = rates(of_deflection)
      case (swept)
         dimension_of = of_swept
      case default
         dimension_of = dimension
      end select
   end function dimension_of

   !> SI value of the deck's unit of a dimension.
   pure real(wp) function unit_size(dimension, units)
      integer, intent(in) :: dimension          !! not relative
      type(units_t), intent(in) :: units

      select case (dimension)
      case (length)
         unit_size = units%length
      case (force)
         unit_size = units%force
      case (angle)
         unit_size = units%angle
      case (moment)
         unit_size = units%force*units%length
      case (rate)
         unit_size = units%force/units%length
      case (rotation_rate)
         unit_size = units%force*units%length/units%angle
      case (mass)
         unit_size = units%mass
      case default                              ! kilograms and accelerations are in kg, m/s² and g in every deck
         unit_size = 1.0_wp
      end select
   end function unit_size

   !> The deck's unit of a dimension, for instance 'N mm/deg'; '' for a pure number.
   pure function unit_name(dimension, units) result(name)
      integer, intent(in) :: dimension          !! not relative
      type(units_t), intent(in) :: units
      character(:), allocatable :: name
      integer :: j

      name = ''
      do j = 1, len_trim(patterns(dimension))
         select case (patterns(dimension) (j:j))
         case ('L')
            name = name//name_in(length_units, units%length)
         case ('F')
            name = name//name_in(force_units, units%force)
         case ('A')
            name = name//name_in(angle_units, units%angle)
         case ('M')
            name = name//name_in(mass_units, units%mass)
         case default
            name = name//patterns(dimension) (j:j)
         end select
      end do
   end function unit_name

   !> The unit of a dimension in any deck, for instance 'force/length' in terms of the keys of &model, or 'kg'; '' for a pure
   !> number. The unit of a relative dimension is the name of the dimension.
   pure function unit_formula(dimension) result(formula)
      integer, intent(in) :: dimension
      character(:), allocatable :: formula
      formula = trim(formulas(dimension))
   end function unit_formula

end module ek_dimension
