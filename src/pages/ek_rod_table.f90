!> The section of a report's page with the largest tension and compression of each rod in the manoeuvres.
module ek_rod_table
   use ek_page, only: page_t, begin_section, begin_table, end_table, add_cell, add_text, page_number
   use ek_part_record, only: part_record_t
   implicit none(type, external)
   private
   public :: add_rod_table

contains

   !> Adds the section, unless there is no rod.
   subroutine add_rod_table(page, record)
      type(page_t), intent(inout) :: page
      type(part_record_t), intent(in) :: record
      integer :: k

      if (size(record%rods) == 0) return
      call begin_section(page, 'rods', 'Rods in load cases', is_printed=.false.)
      call add_text(page, 'p', 'Largest tension and largest compression of each rod (a joint of type distance) over all '// &
         'manoeuvres and named rows of load tables, with the name of the load case. '// &
         'The command elastokin loads writes the loads on all parts.')
      call begin_table(page, [character(16) :: 'Rod', '>Tension [N]', 'in', '>Compression [N]', 'in'])
      do k = 1, size(record%rods)
         call add_cell(page, record%rods(k)%name)
         call add_cell(page, page_number(record%rods(k)%tension))
         call add_cell(page, record%rods(k)%tension_name)
         call add_cell(page, page_number(record%rods(k)%compression))
         call add_cell(page, record%rods(k)%compression_name)
      end do
      call end_table(page)
   end subroutine add_rod_table

end module ek_rod_table
