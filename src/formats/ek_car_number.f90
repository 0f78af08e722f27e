!> Numbers of the car, the steering and the adjusters among the hardpoints of a table or a list: 'wheelbase', 'CG height', 'rack
!> travel', 'tie rod adjuster'. Each has one number, an adjuster two.
module ek_car_number
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   implicit none(type, external)
   private
   public :: car_number_t, car_numbers_t, car_number_of, add_car_number, find_car_number, count_of, slot_names
   public :: wheelbase, cg_height, car_mass, brake_share, drive_share, rack_ratio, rack_travel, rod_adjuster

   integer, parameter :: wheelbase = 1, cg_height = 2, car_mass = 3, brake_share = 4, drive_share = 5, rack_ratio = 6, &
      rack_travel = 7, rod_adjuster = 8
   integer, parameter :: slots = 8, most = 40
   character(16), parameter :: slot_names(slots) = [character(16) :: 'wheelbase', 'cg_height', 'mass', 'brake_share', &
      'drive_share', 'rack_ratio', 'rack_travel', 'tie_rod_adjuster']

   !> A name without blanks and signs.
   type :: word_t
      integer :: slot
      character(24) :: word
   end type word_t

   type(word_t), parameter :: words(*) = [ &
      word_t(wheelbase, 'wheelbase'), word_t(wheelbase, 'radstand'), &
      word_t(cg_height, 'cgheight'), word_t(cg_height, 'cogheight'), word_t(cg_height, 'heightofcg'), &
      word_t(cg_height, 'centreofgravityheight'), word_t(cg_height, 'centerofgravityheight'), &
      word_t(cg_height, 'schwerpunkthoehe'), &
      word_t(car_mass, 'mass'), word_t(car_mass, 'carmass'), word_t(car_mass, 'vehiclemass'), word_t(car_mass, 'totalmass'), &
      word_t(brake_share, 'brakeshare'), word_t(brake_share, 'frontbrakeshare'), word_t(brake_share, 'brakebias'), &
      word_t(drive_share, 'driveshare'), &
      word_t(rack_ratio, 'rackratio'), word_t(rack_ratio, 'racktravelperrevolution'), word_t(rack_ratio, 'cfactor'), &
      word_t(rack_travel, 'racktravel'), word_t(rack_travel, 'maxracktravel'), &
      word_t(rod_adjuster, 'tierodadjuster'), word_t(rod_adjuster, 'trackrodadjuster'), word_t(rod_adjuster, 'toeadjuster'), &
      word_t(rod_adjuster, 'toelinkadjuster'), word_t(rod_adjuster, 'toerodadjuster')]

   type :: car_number_t
      integer :: slot = 0
      integer :: axle = 0                    !! 0 both, 1 front, 2 rear
      real(wp) :: value(2) = 0.0_wp          !! in the unit of the file
      integer :: line = 0
   end type car_number_t

   type :: car_numbers_t
      character(60) :: source = ''           !! file of the numbers; '': that of the points
      integer :: used = 0
      type(car_number_t) :: list(most)
   end type car_numbers_t

contains

   !> The number that a name stands for; 0 for another name.
   pure integer function car_number_of(name) result(slot)
      character(*), intent(in) :: name
      character(:), allocatable :: plain
      integer :: k

      slot = 0
      if (len(name) > 60) return
      plain = ''
      do k = 1, len(name)
         if (scan(name(k:k), ' _-./') == 0) plain = plain//lower(name(k:k))
      end do
      do k = 1, size(words)
         if (words(k)%word == plain) slot = words(k)%slot
      end do
   end function car_number_of

   !> How many numbers a slot has.
   pure integer function count_of(slot)
      integer, intent(in) :: slot
      count_of = merge(2, 1, slot == rod_adjuster)
   end function count_of

   !> Adds a number. A number given twice, or one that is not possible, is an error.
   subroutine add_car_number(number, numbers, flaws)
      type(car_number_t), intent(in) :: number
      type(car_numbers_t), intent(inout) :: numbers
      type(flaws_t), intent(inout) :: flaws
      character(:), allocatable :: limit
      integer :: k

      do k = 1, numbers%used
         if (numbers%list(k)%slot /= number%slot .or. numbers%list(k)%axle /= number%axle) cycle
         call flaws%add(number%line, 'expected '//trim(slot_names(number%slot))//' once, found it again (first in line '// &
            str(numbers%list(k)%line)//')')
         return
      end do
      limit = ''
      select case (number%slot)
      case (brake_share, drive_share)
         if (number%value(1) < 0.0_wp .or. number%value(1) > 1.0_wp) limit = 'from 0 to 1'
      case (rod_adjuster)
         if (number%value(1) > 0.0_wp .or. number%value(2) < 0.0_wp .or. number%value(1) >= number%value(2)) &
            limit = 'as lowest and highest change of length, with 0 between them'
      case default
         if (.not. number%value(1) > 0.0_wp .or. number%value(1) > 1.0e6_wp) limit = 'above 0 and below 1e6'
      end select
      if (limit /= '') then
         call flaws%add(number%line, 'expected '//trim(slot_names(number%slot))//' '//limit//', found '// &
            shown(str(number%value(1))))
      else if (numbers%used < most) then
         numbers%used = numbers%used + 1
         numbers%list(numbers%used) = number
      end if
   end subroutine add_car_number

   !> The index of a number of an axle: the number of this axle, or that of both; 0 if there is none.
   pure integer function find_car_number(numbers, slot, axle) result(found)
      type(car_numbers_t), intent(in) :: numbers
      integer, intent(in) :: slot, axle
      integer :: k

      found = 0
      do k = 1, numbers%used
         if (numbers%list(k)%slot /= slot) cycle
         if (numbers%list(k)%axle == axle) then
            found = k
            return
         end if
         if (numbers%list(k)%axle == 0) found = k
      end do
   end function find_car_number

end module ek_car_number
