!> Contracts of procedures: requirements on the caller, checked in the debug preset only.
!>
!> A call in the wrong order, or with values of another model, stops the debug build with a sentence. In a release build
!> `are_checked` is a constant .false. and the compiler removes the checks.
module ek_contract
   implicit none(type, external)
   private
   public :: are_checked, require

#ifdef EK_CONTRACTS
   logical, parameter :: are_checked = .true.
#else
   logical, parameter :: are_checked = .false.
#endif

contains

   !> Stops with the message `broken` if a condition does not hold. Call it as `if (are_checked) call require(…)`.
   pure subroutine require(holds, broken)
      logical, intent(in) :: holds
      character(*), intent(in) :: broken      !! 'solve: the matrix is not factorised'
      if (.not. holds) error stop broken
   end subroutine require

end module ek_contract
