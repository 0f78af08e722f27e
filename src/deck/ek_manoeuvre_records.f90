!> &manoeuvre: the records of a set of manoeuvres, and the case that solves all manoeuvres of a deck.
!>
!> set = 'durability' adds a &manoeuvre for each manoeuvre of the set that the deck does not define itself. The factors are common
!> first values of hand calculations: three times the static load in a bump, and accelerations at the limit of grip of a road tyre.
module ek_manoeuvre_records
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_record, only: record_t, element, add_record
   use ek_attachment, only: put_word, put_numbers
   implicit none(type, external)
   private
   public :: set_names, attach_manoeuvres

   character(*), parameter :: set_names(1) = ['durability']

   type :: member_t
      character(16) :: name
      real(wp) :: vertical, longitudinal, lateral      !! of &manoeuvre
      character(5) :: longitudinal_by                  !! '': default of &manoeuvre
   end type member_t

   type(member_t), parameter :: durability(*) = [ &
      member_t('bump', 3.0_wp, 0.0_wp, 0.0_wp, ''), &
      member_t('braking', 1.0_wp, -1.0_wp, 0.0_wp, ''), &
      member_t('cornering_left', 1.0_wp, 0.0_wp, 0.9_wp, ''), &
      member_t('cornering_right', 1.0_wp, 0.0_wp, -0.9_wp, ''), &
      member_t('reverse_braking', 1.0_wp, 0.7_wp, 0.0_wp, 'brake'), &
      member_t('driving', 1.0_wp, 0.5_wp, 0.0_wp, '')]

contains

   !> Adds the records of sets. Also adds the case of the manoeuvres if the deck has manoeuvres but no such case.
   subroutine attach_manoeuvres(records, used)
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(record_t) :: case
      integer :: k, own, first

      own = used
      first = 0
      do k = 1, own
         if (records(k)%group /= 'manoeuvre') cycle
         if (first == 0) first = k
         if (lower(element(records(k), 'set', 1)) == set_names(1)) call add_members(k, records, used)
      end do
      if (first == 0) return
      do k = 1, own
         if (records(k)%group == 'case' .and. lower(element(records(k), 'test', 1)) == 'manoeuvres') return
      end do
      call begin_record(records(first), 'case', case)
      call put_word(case, 'name', 'manoeuvres')
      call put_word(case, 'test', 'manoeuvres')
      call add_record(records, used, case)
   end subroutine attach_manoeuvres

   !> Adds the manoeuvres of a set, except those whose names the deck defines, or an earlier record has added.
   subroutine add_members(set, records, used)
      integer, intent(in) :: set                   !! index of the record with the key `set`
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      type(record_t) :: member
      integer :: j, k

      do j = 1, size(durability)
         do k = 1, used
            if (records(k)%group == 'manoeuvre' .and. lower(element(records(k), 'name', 1)) == durability(j)%name) exit
         end do
         if (k <= used) cycle
         call begin_record(records(set), 'manoeuvre', member)
         call put_word(member, 'name', trim(durability(j)%name))
         call put_numbers(member, 'vertical', [durability(j)%vertical])
         call put_numbers(member, 'longitudinal', [durability(j)%longitudinal])
         call put_numbers(member, 'lateral', [durability(j)%lateral])
         if (durability(j)%longitudinal_by /= '') call put_word(member, 'longitudinal_by', trim(durability(j)%longitudinal_by))
         call add_record(records, used, member)
      end do
   end subroutine add_members

   !> Begins a record at the location of another record.
   subroutine begin_record(from, group, record)
      type(record_t), intent(in) :: from
      character(*), intent(in) :: group
      type(record_t), intent(out) :: record

      record%group = group
      record%file = from%file
      record%source = from%source
      record%line = from%line
   end subroutine begin_record

end module ek_manoeuvre_records
