!> A free table of loads: a CSV file of which every row is one state.
module ek_load_table
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: quoted
   use ek_case, only: case_t
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: mount_table

contains

   subroutine mount_table(suspension, case, wheels, error)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: case
      integer, intent(in) :: wheels(2)      !! left, right; 0: none
      type(error_t), allocatable, intent(out) :: error

      if (size(suspension%bodies) + sum(wheels) < 0) return
      call fail(error, exit_deck, case%where//': case '//quoted(case%name)//': tables are not read yet')
   end subroutine mount_table

end module ek_load_table
