!> A deck opened for a program that calls elastokin: copies of the session. Part of the Fortran interface (ek_api).
!>
!> A copy is made from the deck as opened, and no file is read again. The copy has the same checksum even if the files have changed
!> since.
module ek_session_copy
   use ek_error, only: error_t, fail, exit_usage
   use ek_kept_files, only: kept_files_t
   use ek_deck, only: deck_t, parse_deck
   use ek_deck_writer, only: deck_as_used
   use ek_workspace_cases, only: open_workspace
   use ek_session, only: session_t, begin_opened, begin_workspace, empty_session, changed_deck, without_option
   implicit none(type, external)
   private
   public :: copy_session, opened_files, open_files, used_deck

contains

   !> Creates a second session of the same deck with the same changes, without a solution.
   subroutine copy_session(from, to, error)
      type(session_t), intent(in) :: from                  !! session with a deck
      type(session_t), intent(inout) :: to
      type(error_t), allocatable, intent(out) :: error

      call empty_session(to)
      !$omp critical (ek_words)
      to%original = from%original
      to%deck = from%deck
      allocate (to%workspace)
      call open_workspace(to%deck, to%workspace, error)
      if (.not. allocated(error)) then
         call begin_workspace(to)
         to%numbers = from%numbers
         to%numbers%is_new = .true.
         to%is_text_changed = from%is_text_changed
      end if
      !$omp end critical (ek_words)
   end subroutine copy_session

   !> The deck as opened, then every file named in the deck: included files, hardpoints, property files, load tables.
   function opened_files(session) result(files)
      type(session_t), intent(in) :: session
      type(kept_files_t) :: files
      files = session%original%kept
   end function opened_files

   !> Opens a deck from the content of its files (opened_files). A file that is not in this list is read from disk.
   subroutine open_files(files, session, error)
      type(kept_files_t), intent(in) :: files              !! the first is the deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: every error of the deck

      call empty_session(session)
      if (files%count() == 0) then
         call fail(error, exit_usage, 'expected the files of a deck, found none')
         return
      end if
      !$omp critical (ek_words)
      call parse_deck(files%text(1), files%path(1), session%original, error, kept=files)
      if (.not. allocated(error)) call begin_opened(session, error)
      !$omp end critical (ek_words)
   end subroutine open_files

   !> Writes the deck with its present numbers as one string. The string contains the included files, hardpoints, property files,
   !> both sides and all changes.
   subroutine used_deck(session, text, error)
      type(session_t), intent(in) :: session
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: the present numbers define no valid model
      type(deck_t) :: changed

      !$omp critical (ek_words)
      call changed_deck(session, changed, error)
      if (.not. allocated(error)) call deck_as_used(changed, text, error)
      call without_option(error)
      !$omp end critical (ek_words)
      if (.not. allocated(text)) text = ''
   end subroutine used_deck

end module ek_session_copy
