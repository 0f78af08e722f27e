!> Every comparison of this folder as CSV, for docs/validation.py; run in the folder of the repository.
program validation_numbers
   use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
   use ek_comparison, only: comparisons_t
   use ek_published_adams, only: compare_adams
   use ek_published_ipg, only: compare_ipg
   use ek_published_small, only: compare_optimum, compare_lotus, compare_rill, compare_boxster, compare_open_kinematics
   implicit none(type, external)
   type(comparisons_t) :: adams, ipg, optimum, lotus, rill, boxster, open_kinematics

   call compare_adams(adams)
   call compare_ipg(ipg)
   call compare_optimum(optimum)
   call compare_lotus(lotus)
   call compare_rill(rill)
   call compare_boxster(boxster)
   call compare_open_kinematics(open_kinematics)
   write (output_unit, '(a)') 'program;part;quantity;place;unit;ours;published;tolerance'
   call print_list('Adams/Car', adams)
   call print_list('IPGKinematics', ipg)
   call print_list('OptimumKinematics', optimum)
   call print_list('Lotus', lotus)
   call print_list('Rill', rill)
   call print_list('Boxster', boxster)
   call print_list('open-kinematics', open_kinematics)

contains

   !> Prints the comparisons with a program, one a line; stops if numbers are missing.
   subroutine print_list(name, list)
      character(*), intent(in) :: name
      type(comparisons_t), intent(in) :: list
      integer :: k

      if (allocated(list%trouble)) then
         write (error_unit, '(a)') list%trouble
         error stop
      end if
      do k = 1, size(list%items)
         associate (item => list%items(k))
            write (output_unit, '(5(a, ";"), es23.16, 2(";", es23.16))') name, trim(item%part), trim(item%quantity), &
               trim(item%place), trim(item%unit), item%ours, item%published, item%tolerance
         end associate
      end do
   end subroutine print_list

end program validation_numbers
