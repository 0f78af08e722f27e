!> The instruction set for which the lane kernels are compiled.
!>
!> The build may compile this layer for several instruction sets, as copies of a shared library. The loader chooses the best copy
!> that the processor can run (src/lanes/loaded_lanes.cmake). Only the chosen copy contains the name of its instruction set. A
!> procedure therefore returns the name; a constant would be copied from the module file into the program.
module ek_lane_instructions
   use, intrinsic :: iso_fortran_env, only: compiler_options
   implicit none(type, external)
   private
   public :: get_instruction_set

   character(*), parameter :: options = compiler_options()
   character(*), parameter :: key = '-march='

contains

   !> Returns the name in the option -march, such as 'x86-64-v3'; the last name if there are several. Returns '' without this
   !> option, or if the compiler does not report its options.
   pure subroutine get_instruction_set(name)
      character(*), intent(out) :: name
      integer :: first, last

      name = ''
      first = index(options, key, back=.true.)
      if (first == 0) return
      first = first + len(key)
      last = first + scan(options(first:)//' ', ' ') - 2
      name = options(first:last)
   end subroutine get_instruction_set

end module ek_lane_instructions
