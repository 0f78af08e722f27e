!> The section of peak loads on the page of a report: one row per member, the loads on its second body.
module ek_peak_section
   use ek_kinds, only: wp
   use ek_member_loads, only: load_record_t
   use ek_page, only: page_t, begin_section, add_text, begin_table, add_cell, end_table, page_number
   implicit none(type, external)
   private
   public :: add_peak_loads

   integer, parameter :: forces(4) = [1, 2, 3, 4], resultant = 4, moment = 8, own(3) = [9, 10, 11]     !! components of a record

contains

   !> Adds the section. Members whose largest force and moment are printed as 0 are omitted. The last two columns belong to the
   !> largest force, or to the largest moment if the force is printed as 0: beside a joint, a bushing has a force of some 1e-9 N.
   subroutine add_peak_loads(page, record)
      type(page_t), intent(inout) :: page
      type(load_record_t), intent(in) :: record
      integer :: e, c, leader

      call begin_section(page, 'peak-loads', 'Peak loads', is_printed=.false.)
      call add_text(page, 'p', 'Largest value of each component over all tests: force and moment on the body in the frame of '// &
         'the deck, with the moment about the hardpoint. The columns "own" give the force of a bushing along its own axes. '// &
         'The forces on the first body of each member are opposite. '// &
         'peak-loads.csv contains both bodies and the state of every component; loads.csv contains all states.')
      call begin_table(page, [character(15) :: 'Member', 'On body', 'At', '>Fx [N]', '>Fy [N]', '>Fz [N]', '>Force [N]', &
         '>Moment [N m]', '>own Fx [N]', '>own Fy [N]', '>own Fz [N]', 'Largest load in', '>at'])
      do e = 2, size(record%ends), 2
         if (record%case(resultant, e) == 0) cycle
         leader = merge(moment, resultant, page_number(record%peaks(resultant, e)) == '0')
         if (page_number(record%peaks(leader, e)) == '0') cycle
         call add_cell(page, record%ends(e)%member)
         call add_cell(page, record%ends(e)%body)
         call add_cell(page, record%ends(e)%point)
         do c = 1, size(forces)
            call add_cell(page, page_number(record%peaks(forces(c), e)), 'n')
         end do
         call add_cell(page, page_number(record%peaks(moment, e)), 'n')
         do c = 1, size(own)
            if (record%case(own(c), e) == 0) call add_cell(page, '–', 'n')
            if (record%case(own(c), e) > 0) call add_cell(page, page_number(record%peaks(own(c), e)), 'n')
         end do
         call add_cell(page, trim(record%cases(record%case(leader, e))))
         call add_cell(page, page_number(record%factor(leader, e)), 'n')
      end do
      call end_table(page)
   end subroutine add_peak_loads

end module ek_peak_section
