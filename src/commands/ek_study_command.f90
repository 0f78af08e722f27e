!> elastokin study: see ek_study.
module ek_study_command
   use ek_error, only: error_t
   use ek_arguments, only: arguments_t
   implicit none(type, external)
   private
   public :: run_study_command
contains
   subroutine run_study_command(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      if (arguments%quiet) return
   end subroutine run_study_command
end module ek_study_command
