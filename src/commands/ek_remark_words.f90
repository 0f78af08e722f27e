!> Messages of run and report on a deck before they run it: implausible values, a model that cannot be solved.
module ek_remark_words
   use ek_error, only: message_list_t
   use ek_text, only: plural
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_balance, only: balance_words
   use ek_plausibility, only: doubt
   use ek_examination, only: examination_t
   use ek_words, only: warn
   implicit none(type, external)
   private
   public :: warn_of_balance, warn_of_remarks, unsolvable_words

contains

   !> Warnings on springs that balance has left out or could not determine.
   subroutine warn_of_balance(suspension, page)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout), optional :: page
      type(message_list_t) :: words
      integer :: k

      call balance_words(suspension, words)
      do k = 1, words%count()
         call warn(words%line(k))
         if (present(page)) call page%add(words%line(k))
      end do
   end subroutine warn_of_balance

   !> One warning for all remarks of ek_plausibility: the first, and a reference to the others. The page lists them all.
   subroutine warn_of_remarks(suspension, cases, page)
      type(suspension_t), intent(in) :: suspension      !! balanced
      type(case_t), intent(in) :: cases(:)              !! of the deck
      type(message_list_t), intent(inout), optional :: page
      type(message_list_t) :: remarks
      character(:), allocatable :: more
      integer :: k

      call doubt(suspension, cases, remarks)
      if (remarks%count() == 0) return
      more = ''
      if (remarks%count() > 1) more = '; and '//plural(remarks%count() - 1, 'more remark', 'more remarks')//': see elastokin check'
      call warn('plausible? '//remarks%line(1)//more)
      if (.not. present(page)) return
      do k = 1, remarks%count()
         call page%add('plausible? '//remarks%line(k))
      end do
   end subroutine warn_of_remarks

   !> The reasons why no case of a deck can be run; each defect once.
   function unsolvable_words(file, found) result(words)
      character(*), intent(in) :: file
      type(examination_t), intent(in) :: found          !! no case can be solved
      character(:), allocatable :: words

      if (size(found%is_solvable) == 1) then
         words = found%faults%line(1)
      else
         words = file//': the model cannot be solved'//new_line('a')//found%distinct%text()
      end if
   end function unsolvable_words

end module ek_remark_words
