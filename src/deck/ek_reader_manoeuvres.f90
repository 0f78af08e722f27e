!> &manoeuvre: load factor and accelerations of the car, for the wheel loads of test 'manoeuvres'.
module ek_reader_manoeuvres
   use ek_kinds, only: wp
   use ek_blueprint, only: manoeuvre_plan_t
   use ek_group, only: axle_group, manoeuvre_group
   use ek_manoeuvre_records, only: set_names
   use ek_record, only: is_given
   use ek_deck_reading, only: deck_reading_t, complain, refuse, where_of, line_of, has_key, choice, text_of, number_of, slot
   implicit none(type, external)
   private
   public :: read_manoeuvre

contains

   !> Reads a manoeuvre. A record with `set` only names a set, whose manoeuvres are separate records (ek_manoeuvre_records).
   subroutine read_manoeuvre(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(manoeuvre_plan_t) :: plan
      integer :: c

      if (has_key(reading, 'set')) then
         call choice(reading, 'set', set_names, c)
         call refuse(reading, [character(16) :: 'name', 'vertical', 'longitudinal', 'lateral', 'longitudinal_by'], &
            'a set has its own numbers; to replace a manoeuvre of the set, give a &manoeuvre with its name')
         return
      end if
      if (.not. has_key(reading, 'name')) call complain(reading, '', "give 'name', or 'set' for a set of manoeuvres")
      associate (this => plan%manoeuvre)
         this%name = text_of(reading, 'name')
         this%where = where_of(reading)
         this%vertical = number_of(reading, 'vertical', 1.0_wp)
         this%longitudinal = number_of(reading, 'longitudinal', 0.0_wp)
         this%lateral = number_of(reading, 'lateral', 0.0_wp)
         call choice(reading, 'longitudinal_by', [character(5) :: 'brake', 'drive'], c, &
            default=merge(1, 2, this%longitudinal < 0.0_wp))
         this%is_braked = c == 1
         call check_car(reading, abs(this%longitudinal) > 0.0_wp .or. abs(this%lateral) > 0.0_wp)
      end associate
      if (.not. reading%cards(reading%k)%is_good) return
      call slot(reading, 'vertical', 1.0_wp, plan%vertical, default=1.0_wp)
      call slot(reading, 'longitudinal', 1.0_wp, plan%longitudinal, default=0.0_wp)
      call slot(reading, 'lateral', 1.0_wp, plan%lateral, default=0.0_wp)
      reading%plan%manoeuvres = [reading%plan%manoeuvres, plan]
      reading%cards(reading%k)%index = size(reading%plan%manoeuvres)
   end subroutine read_manoeuvre

   !> Checks that the deck has the data of the car that a manoeuvre needs: &axle with `mass` for an acceleration, and gravity if
   !> bodies have masses. A manoeuvre after a manoeuvre with an error is not checked, so that a missing number is reported once.
   subroutine check_car(reading, is_accelerated)
      type(deck_reading_t), intent(inout) :: reading
      logical, intent(in) :: is_accelerated
      integer :: axle

      if (any(reading%cards(:reading%k - 1)%group == manoeuvre_group .and. .not. reading%cards(:reading%k - 1)%is_good)) return
      axle = findloc(reading%cards%group, axle_group, dim=1)
      if (is_accelerated .and. axle == 0) then
         call complain(reading, '', 'longitudinal and lateral need the data of the car, found no &axle: add &axle with '// &
            'wheelbase, cg_height, brake_share and mass')
      else if (is_accelerated) then
         if (.not. is_given(reading%records(axle), 'mass')) call complain(reading, '', &
            'longitudinal and lateral need the mass of the car, found no mass in &axle in '//line_of(reading, axle)// &
            ': add mass, in kg')
      end if
      if (any(reading%plan%prototype%bodies%mass > 0.0_wp) .and. .not. reading%plan%prototype%gravity > 0.0_wp) call complain( &
         reading, '', 'bodies have masses, which need their weight in manoeuvres, found no gravity in &model: add gravity = 9.81')
   end subroutine check_car

end module ek_reader_manoeuvres
