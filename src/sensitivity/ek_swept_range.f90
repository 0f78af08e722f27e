!> The swept value of a requested number, checked against the range of its case.
module ek_swept_range
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_workspace, only: workspace_t
   use ek_wanted_number, only: wanted_number_t
   implicit none(type, external)
   private
   public :: range_fault

contains

   !> The reason why a requested number has no value in its case: its swept value lies outside the range of the case, or the case
   !> does not contain design, which a change needs; '' without such a reason, and of a case that was refused without a solution.
   function range_fault(wanted, workspace) result(text)
      type(wanted_number_t), intent(in) :: wanted
      type(workspace_t), intent(in) :: workspace
      character(:), allocatable :: text
      real(wp), parameter :: rounding = 1.0e-7_wp          !! share of the range
      real(wp) :: low, high

      text = ''
      if (wanted%column == '' .or. wanted%case == 0) return
      if (.not. allocated(workspace%cases(wanted%case)%result)) return
      associate (case => workspace%cases(wanted%case)%result%case)
         low = min(case%from, case%to)/case%unit
         high = max(case%from, case%to)/case%unit
         if (wanted%is_change .and. low*high > 0.0_wp) then
            text = 'of = ''change'' needs a case with design; case '//quoted(case%name)//' goes from '//str(low)//' to '// &
               str(high)//' '//case%unit_name
         else if (wanted%over == 'factor' .and. (wanted%at < low - rounding*(high - low) .or. &
            wanted%at > high + rounding*(high - low))) then
            text = 'case '//quoted(case%name)//' goes from '//str(low)//' to '//str(high)//' '//case%unit_name//', found '// &
               str(wanted%at)
         end if
      end associate
   end function range_fault

end module ek_swept_range
