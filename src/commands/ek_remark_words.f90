!> Messages of run and report on a deck before they run it (implausible values, a model that cannot be solved), and on its cases.
module ek_remark_words
   use ek_error, only: message_list_t
   use ek_text, only: plural
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_balance, only: balance_words
   use ek_plausibility, only: doubt
   use ek_examination, only: examination_t
   use ek_model_remarks, only: patch_words, spring_words, preload_words
   use ek_remark, only: remark_t, remark_list_t, note, warning
   use ek_words, only: say, warn
   implicit none(type, external)
   private
   public :: print_model_words, print_remarks, unsolvable_words

contains

   !> Prints the messages on a balanced model before its cases are run; `page` collects the warnings, and every remark.
   subroutine print_model_words(quiet, suspension, cases, chosen, page)
      logical, intent(in) :: quiet
      type(suspension_t), intent(in) :: suspension      !! balanced
      type(case_t), intent(in) :: cases(:), chosen(:)   !! all of the deck; those to be run
      type(message_list_t), intent(inout), optional :: page
      type(message_list_t) :: notes, warnings
      integer :: k

      call preload_words(suspension, notes)
      do k = 1, notes%count()
         call say(quiet, notes%line(k))
      end do
      call patch_words(suspension, warnings)
      call spring_words(suspension, chosen, warnings)
      call balance_words(suspension, warnings)
      do k = 1, warnings%count()
         call warn(warnings%line(k))
         if (present(page)) call page%add(warnings%line(k))
      end do
      call warn_of_remarks(suspension, cases, page)
   end subroutine print_model_words

   !> Prints the notes and warnings on a case; its failures become an error.
   subroutine print_remarks(quiet, remarks)
      logical, intent(in) :: quiet
      type(remark_list_t), intent(in) :: remarks
      type(remark_t) :: remark
      integer :: k

      do k = 1, remarks%count()
         remark = remarks%item(k)
         if (remark%severity == note) call say(quiet, remark%whole())
         if (remark%severity == warning) call warn(remark%whole())
      end do
   end subroutine print_remarks

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
