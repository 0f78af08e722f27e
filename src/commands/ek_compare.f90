!> stub
module ek_compare
   use ek_error, only: error_t
   use ek_arguments, only: arguments_t
   implicit none(type, external)
   private
   public :: compare
contains
   subroutine compare(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      if (arguments%help) return
   end subroutine compare
end module ek_compare
