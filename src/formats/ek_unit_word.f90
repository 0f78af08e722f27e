!> Names of units in files of other programs, with their values in SI.
module ek_unit_word
   use ek_kinds, only: wp, degree, inch, pound, standard_gravity
   use ek_text, only: lower
   implicit none(type, external)
   private
   public :: unit_of, length_unit, force_unit, angle_unit, mass_unit, time_unit, quantity_names

   integer, parameter :: length_unit = 1, force_unit = 2, angle_unit = 3, mass_unit = 4, time_unit = 5
   character(*), parameter :: quantity_names(5) = [character(6) :: 'LENGTH', 'FORCE', 'ANGLE', 'MASS', 'TIME']

   type :: word_t
      integer :: quantity
      character(14) :: word
      real(wp) :: value
   end type word_t

   type(word_t), parameter :: words(*) = [ &
      word_t(length_unit, 'mm', 1.0e-3_wp), word_t(length_unit, 'millimeter', 1.0e-3_wp), &
      word_t(length_unit, 'millimetre', 1.0e-3_wp), word_t(length_unit, 'cm', 1.0e-2_wp), &
      word_t(length_unit, 'centimeter', 1.0e-2_wp), word_t(length_unit, 'centimetre', 1.0e-2_wp), &
      word_t(length_unit, 'm', 1.0_wp), word_t(length_unit, 'meter', 1.0_wp), word_t(length_unit, 'metre', 1.0_wp), &
      word_t(length_unit, 'km', 1.0e3_wp), word_t(length_unit, 'kilometer', 1.0e3_wp), &
      word_t(length_unit, 'kilometre', 1.0e3_wp), word_t(length_unit, 'in', inch), word_t(length_unit, 'inch', inch), &
      word_t(length_unit, 'inche', inch), word_t(length_unit, 'ft', 12*inch), word_t(length_unit, 'foot', 12*inch), &
      word_t(length_unit, 'feet', 12*inch), &
      word_t(force_unit, 'n', 1.0_wp), word_t(force_unit, 'newton', 1.0_wp), word_t(force_unit, 'kn', 1.0e3_wp), &
      word_t(force_unit, 'kilonewton', 1.0e3_wp), word_t(force_unit, 'knewton', 1.0e3_wp), &
      word_t(force_unit, 'lbf', pound*standard_gravity), word_t(force_unit, 'pound_force', pound*standard_gravity), &
      word_t(force_unit, 'pounds_force', pound*standard_gravity), word_t(force_unit, 'kgf', standard_gravity), &
      word_t(force_unit, 'kg_force', standard_gravity), word_t(force_unit, 'kilogram_force', standard_gravity), &
      word_t(force_unit, 'ounce_force', pound*standard_gravity/16), word_t(force_unit, 'dyne', 1.0e-5_wp), &
      word_t(angle_unit, 'deg', degree), word_t(angle_unit, 'degree', degree), word_t(angle_unit, 'rad', 1.0_wp), &
      word_t(angle_unit, 'radian', 1.0_wp), &
      word_t(mass_unit, 'kg', 1.0_wp), word_t(mass_unit, 'kilogram', 1.0_wp), word_t(mass_unit, 'g', 1.0e-3_wp), &
      word_t(mass_unit, 'gram', 1.0e-3_wp), word_t(mass_unit, 'megagram', 1.0e3_wp), word_t(mass_unit, 'tonne', 1.0e3_wp), &
      word_t(mass_unit, 'lbm', pound), word_t(mass_unit, 'pound_mass', pound), word_t(mass_unit, 'slug', 14.59390294_wp), &
      word_t(mass_unit, 'ounce_mass', pound/16), &
      word_t(time_unit, 's', 1.0_wp), word_t(time_unit, 'sec', 1.0_wp), word_t(time_unit, 'second', 1.0_wp), &
      word_t(time_unit, 'ms', 1.0e-3_wp), word_t(time_unit, 'millisecond', 1.0e-3_wp), word_t(time_unit, 'minute', 60.0_wp), &
      word_t(time_unit, 'min', 60.0_wp), word_t(time_unit, 'hour', 3600.0_wp)]

contains

   !> The SI value of a unit of a quantity; 0 if the unit is not known. Letter case is ignored, and so is a plural s of a unit of
   !> three letters or more.
   pure real(wp) function unit_of(quantity, text) result(value)
      integer, intent(in) :: quantity
      character(*), intent(in) :: text
      character(:), allocatable :: word
      integer :: k

      value = 0.0_wp
      word = lower(trim(adjustl(text)))
      do k = 1, size(words)
         if (words(k)%quantity /= quantity) cycle
         if (word /= words(k)%word .and. .not. (len(word) > 3 .and. word == trim(words(k)%word)//'s')) cycle
         value = words(k)%value
         return
      end do
   end function unit_of

end module ek_unit_word
