!> A deck opened for a program that calls elastokin. Part of the Fortran interface (described in ek_api).
module ek_session
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: replace
   use ek_deck, only: deck_t, read_deck, parse_deck, move_deck, deck_checksum
   use ek_case_result, only: solve_options_t
   use ek_table, only: name_length
   use ek_design_numbers, only: design_numbers_t, begin_numbers, apply_settings
   use ek_workspace, only: workspace_t, put_numbers
   use ek_workspace_cases, only: open_workspace
   use ek_named_numbers, only: named_numbers_t
   use ek_derivatives, only: derivatives_t
   implicit none(type, external)
   private
   public :: session_t, prepared_t, derived_t, open_file, open_text, open_deck, take_deck
   public :: take_new_numbers, changed_deck, checksum_of, without_option, begin_opened, begin_again, begin_workspace, empty_session

   !> The columns with which a case was solved. A further solution with these columns creates no strings.
   type :: prepared_t
      logical :: is_ready = .false.
      character(name_length), allocatable :: asked(:)      !! columns as the caller wrote them; of size 0: all columns
      type(solve_options_t) :: options
   end type prepared_t

   !> The derivatives requested last. Computing them again for another design creates no strings.
   type :: derived_t
      type(derivatives_t) :: derivatives
      character(name_length), allocatable :: columns(:), paths(:)      !! columns and paths as the caller wrote them
      integer, allocatable :: column(:), direction(:)                  !! index of each column and each path in `derivatives`
   end type derived_t

   !> A deck, its present numbers, and its last solution. A caller may read the components, but must change them through procedures.
   type :: session_t
      type(deck_t) :: original                      !! deck as opened
      type(deck_t) :: deck                          !! deck with the settings of set_text
      class(workspace_t), allocatable :: workspace !! workspace of `deck`; allocated when opened. A class as in case_work_t
      type(design_numbers_t) :: numbers             !! numbers as changed since the deck was opened
      logical :: is_text_changed = .false.
      ! ek_session_solution
      integer :: solved = 0                         !! case of the last solution; 0: no solution
      type(prepared_t), allocatable :: prepared(:)  !! columns of each case
      class(workspace_t), allocatable :: other  !! workspace of the last solution if `workspace` lacks it: of the deck with its
      !!                                               numbers as strings, or of the deck before set_text or reset
      real(wp), allocatable :: solved_x(:)          !! values of all parameters at the last solution [SI]
      class(derived_t), allocatable :: derived      !! derivatives requested last (ek_session_derivatives)
      ! ek_session_numbers
      class(named_numbers_t), allocatable :: named  !! key numbers requested last
      character(name_length), allocatable :: names(:)
      logical :: is_named_ready = .false.  !! whether these key numbers were read before: a further reading creates no strings
   end type session_t

contains

   !> Empties a session. This is one procedure because gfortran writes out the deallocation of a session at each call.
   subroutine empty_session(session)
      type(session_t), intent(out) :: session
      session%solved = 0
   end subroutine empty_session

   !> Opens a deck file; '-' is standard input.
   subroutine open_file(path, session, error)
      character(*), intent(in) :: path
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_file, exit_deck: every error of the deck

      call empty_session(session)
      !$omp critical (ek_words)
      call read_deck(path, session%original, error)
      if (.not. allocated(error)) call begin_opened(session, error)
      !$omp end critical (ek_words)
   end subroutine open_file

   !> Opens a deck that is given as a string.
   subroutine open_text(text, name, session, error)
      character(*), intent(in) :: text
      character(*), intent(in) :: name                     !! name for messages; its folder contains included files and load tables
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck

      call empty_session(session)
      !$omp critical (ek_words)
      call parse_deck(text, name, session%original, error)
      if (.not. allocated(error)) call begin_opened(session, error)
      !$omp end critical (ek_words)
   end subroutine open_text

   !> Opens a deck that has already been read.
   subroutine open_deck(deck, session, error)
      type(deck_t), intent(in) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck
      type(deck_t) :: copy

      !$omp critical (ek_words)
      copy = deck
      !$omp end critical (ek_words)
      call take_deck(copy, session, error)
   end subroutine open_deck

   !> Opens a deck as open_deck does, but moves the deck into the session instead of copying it.
   subroutine take_deck(deck, session, error)
      type(deck_t), intent(inout) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck

      call empty_session(session)
      !$omp critical (ek_words)
      call move_deck(deck, session%original)
      call begin_opened(session, error)
      !$omp end critical (ek_words)
   end subroutine take_deck

   !> Opens the workspace of the deck as opened, and copies this deck to the current deck.
   subroutine begin_opened(session, error)
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error

      allocate (session%workspace)
      call open_workspace(session%original, session%workspace, error)
      if (allocated(error)) return
      session%deck = session%original
      call begin_workspace(session)
   end subroutine begin_opened

   !> Replaces the deck. If the new deck has errors, the session is unchanged. The last solution is not deleted in either case: its
   !> workspace is stored until the next solution.
   subroutine begin_again(deck, session, error)
      type(deck_t), intent(in) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: workspace

      allocate (workspace)
      call open_workspace(deck, workspace, error)
      if (allocated(error)) return
      session%deck = deck
      if (session%solved > 0 .and. .not. allocated(session%other)) call move_alloc(session%workspace, session%other)
      call move_alloc(workspace, session%workspace)
      call begin_workspace(session)
   end subroutine begin_again

   !> Resets the parts of a session that depend on the deck of its workspace.
   subroutine begin_workspace(session)
      type(session_t), intent(inout) :: session

      if (allocated(session%prepared)) deallocate (session%prepared)
      allocate (session%prepared(size(session%workspace%cases)))
      call begin_numbers(session%workspace%design, session%numbers)
      session%numbers%is_new = .false.                     ! the workspace was made with them
      session%is_named_ready = .false.
      if (allocated(session%derived)) session%derived%derivatives%case = 0      ! of another workspace: kept as room
   end subroutine begin_workspace

   !> Passes the numbers to the workspace if the numbers have changed since the workspace took them.
   subroutine take_new_numbers(session)
      type(session_t), intent(inout) :: session

      if (session%numbers%is_new) call put_numbers(session%numbers%x, session%workspace)
      session%numbers%is_new = .false.
   end subroutine take_new_numbers

   !> Creates a copy of the deck with the current numbers as settings. Only one thread at a time may call this procedure.
   subroutine changed_deck(session, deck, error)
      type(session_t), intent(in) :: session
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error

      deck = session%deck
      call apply_settings(session%numbers, session%workspace%design, deck, error)
   end subroutine changed_deck

   !> Removes '--set' from a message about a setting, so that the message gives only the path.
   subroutine without_option(error)
      type(error_t), allocatable, intent(inout) :: error
      if (allocated(error)) call replace(error%message, '--set ', '')
   end subroutine without_option

   !> Returns the checksum of the deck with its present numbers.
   subroutine checksum_of(session, digits, error)
      type(session_t), intent(in) :: session
      character(16), intent(out) :: digits
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: changed

      !$omp critical (ek_words)
      call changed_deck(session, changed, error)
      digits = deck_checksum(changed)
      !$omp end critical (ek_words)
   end subroutine checksum_of

end module ek_session
