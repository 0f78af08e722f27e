!> A deck opened for a program that calls elastokin. Part of the Fortran interface (described in ek_api): opening, copies,
!> and the messages on the model.
!>
!> A copy is made from the deck as opened, and no file is read again. The copy has the same checksum even if the files have changed
!> since.
module ek_session
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: replace
   use ek_deck, only: deck_t, read_deck, parse_deck, move_deck, deck_checksum
   use ek_reader, only: definition_t
   use ek_case_result, only: solve_options_t
   use ek_table, only: name_length
   use ek_design_numbers, only: design_numbers_t, begin_numbers, apply_settings
   use ek_workspace, only: workspace_t, put_numbers, settle_model
   use ek_workspace_cases, only: open_workspace, report_cases
   use ek_named_numbers, only: named_numbers_t
   use ek_defined_column, only: defined_t
   use ek_derivatives, only: derivatives_t
   use ek_kept_files, only: kept_files_t
   use ek_deck_writer, only: deck_as_used
   use ek_case, only: case_t
   use ek_model_remark, only: model_remarks_t, find_model_remarks
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: session_t, prepared_t, derived_t, open_file, open_text, open_deck, take_deck, take_new_numbers, changed_deck, reread, &
      checksum_of, without_option, begin_opened, begin_again, begin_workspace, empty_session, copy_session, opened_files, &
      open_files, used_deck, find_remarks

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
      integer, allocatable :: column(:), direction(:)                  !! index of each column and each path in `derivatives`; of a
                                                                       !! column of another program −index in `defined`
      character(10) :: program = ''                                    !! other program whose columns may be named; '': none
      type(defined_t), allocatable :: list(:)                          !! columns of this program that were named
      type(derivatives_t) :: defined
   end type derived_t

   !> A deck, its present numbers, and its last solution. A caller may read the components, but must change them through procedures.
   type :: session_t
      type(deck_t) :: original                      !! deck as opened
      type(deck_t) :: deck                          !! deck with the settings of set_text
      class(workspace_t), allocatable :: workspace !! workspace of `deck`; allocated when opened. A class as in case_work_t
      class(definition_t), allocatable :: definition       !! of `workspace`, which points to it
      type(design_numbers_t) :: numbers             !! numbers as changed since the deck was opened
      logical :: is_text_changed = .false.
      ! ek_session_solution
      integer :: solved = 0                         !! case of the last solution; 0: no solution
      type(prepared_t), allocatable :: prepared(:)  !! columns of each case
      class(workspace_t), allocatable :: other  !! workspace of the last solution if `workspace` lacks it: of the deck with its
      !!                                               numbers as strings, or of the deck before set_text or reset
      class(definition_t), allocatable :: other_definition !! of `other`
      real(wp), allocatable :: solved_x(:)          !! values of all parameters at the last solution [SI]
      class(derived_t), allocatable :: derived      !! derivatives requested last (ek_session_solution)
      ! key numbers (ek_session_solution)
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
      call begin_words()
      call read_deck(path, session%original, error)
      if (.not. allocated(error)) call begin_opened(session, error)
      call end_words()
   end subroutine open_file

   !> Opens a deck that is given as a string.
   subroutine open_text(text, name, session, error)
      character(*), intent(in) :: text
      character(*), intent(in) :: name                     !! name for messages; its folder contains included files and load tables
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck

      call empty_session(session)
      call begin_words()
      call parse_deck(text, name, session%original, error)
      if (.not. allocated(error)) call begin_opened(session, error)
      call end_words()
   end subroutine open_text

   !> Opens a deck that has already been read.
   subroutine open_deck(deck, session, error)
      type(deck_t), intent(in) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck
      type(deck_t) :: copy

      call begin_words()
      copy = deck
      call end_words()
      call take_deck(copy, session, error)
   end subroutine open_deck

   !> Opens a deck as open_deck does, but moves the deck into the session instead of copying it.
   subroutine take_deck(deck, session, error)
      type(deck_t), intent(inout) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck

      call empty_session(session)
      call begin_words()
      call move_deck(deck, session%original)
      call begin_opened(session, error)
      call end_words()
   end subroutine take_deck

   !> Opens the workspace of the deck as opened, and copies this deck to the current deck.
   subroutine begin_opened(session, error)
      type(session_t), intent(inout), target :: session
      type(error_t), allocatable, intent(out) :: error

      allocate (session%workspace, session%definition)
      call open_workspace(session%original, session%definition, session%workspace, error)
      if (allocated(error)) return
      session%deck = session%original
      call begin_workspace(session)
   end subroutine begin_opened

   !> Replaces the deck. If the new deck has errors, the session is unchanged. The last solution is not deleted in either case: its
   !> workspace is stored until the next solution.
   subroutine begin_again(deck, session, error)
      type(deck_t), intent(in) :: deck
      type(session_t), intent(inout), target :: session
      type(error_t), allocatable, intent(out) :: error
      class(workspace_t), allocatable :: workspace
      class(definition_t), allocatable, target :: definition

      allocate (workspace, definition)
      call open_workspace(deck, definition, workspace, error)
      if (allocated(error)) return
      session%deck = deck
      if (session%solved > 0 .and. .not. allocated(session%other)) then
         call move_alloc(session%workspace, session%other)
         call move_alloc(session%definition, session%other_definition)
      end if
      call move_alloc(workspace, session%workspace)
      call move_alloc(definition, session%definition)      ! it stays where it is
      call begin_workspace(session)
   end subroutine begin_again

   !> Resets the parts of a session that depend on the deck of its workspace.
   subroutine begin_workspace(session)
      type(session_t), intent(inout) :: session

      if (allocated(session%prepared)) deallocate (session%prepared)
      allocate (session%prepared(size(session%workspace%cases)))
      call begin_numbers(session%workspace%definition, session%numbers)
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
      call apply_settings(session%numbers, session%workspace%definition, deck, error)
   end subroutine changed_deck

   !> Reads the deck again with the current numbers as settings, for numbers that the blueprint cannot take: outside of its range, or a
   !> design that may have a defect. Only one thread at a time may call this procedure.
   subroutine reread(deck, numbers, of_deck, definition, workspace, error)
      type(deck_t), intent(in) :: deck
      type(design_numbers_t), intent(in) :: numbers        !! of a session of the deck
      type(definition_t), intent(in) :: of_deck            !! of this session
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the workspace
      type(workspace_t), intent(inout) :: workspace        !! of the deck read again
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: a number is outside its range
      type(deck_t) :: changed

      changed = deck
      call apply_settings(numbers, of_deck, changed, error)
      if (.not. allocated(error)) call open_workspace(changed, definition, workspace, error)
      call without_option(error)
   end subroutine reread

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

      call begin_words()
      call changed_deck(session, changed, error)
      digits = deck_checksum(changed)
      call end_words()
   end subroutine checksum_of

   !> Creates a second session of the same deck with the same changes, without a solution.
   subroutine copy_session(from, to, error)
      type(session_t), intent(in) :: from                  !! session with a deck
      type(session_t), intent(inout), target :: to
      type(error_t), allocatable, intent(out) :: error

      call empty_session(to)
      call begin_words()
      to%original = from%original
      to%deck = from%deck
      allocate (to%workspace, to%definition)
      call open_workspace(to%deck, to%definition, to%workspace, error)
      if (.not. allocated(error)) then
         call begin_workspace(to)
         to%numbers = from%numbers
         to%numbers%is_new = .true.
         to%is_text_changed = from%is_text_changed
      end if
      call end_words()
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
      call begin_words()
      call parse_deck(files%text(1), files%path(1), session%original, error, kept=files)
      if (.not. allocated(error)) call begin_opened(session, error)
      call end_words()
   end subroutine open_files

   !> Writes the deck with its present numbers as one string. The string contains the included files, hardpoints, property files,
   !> both sides and all changes.
   subroutine used_deck(session, text, error)
      type(session_t), intent(in) :: session
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: the present numbers define no valid model
      type(deck_t) :: changed

      call begin_words()
      call changed_deck(session, changed, error)
      if (.not. allocated(error)) call deck_as_used(changed, text, error)
      call without_option(error)
      call end_words()
      if (.not. allocated(text)) text = ''
   end subroutine used_deck

   !> Finds the messages on the model at the present numbers, as the command line prints them. Examples: no spring, contact points
   !> away from the ground, implausible values, preloads found by the preload trim (`balance`), or the reason why the model cannot
   !> be solved. No case is solved; the last solution is unchanged.
   subroutine find_remarks(session, remarks, error)
      type(session_t), intent(inout) :: session
      type(model_remarks_t), intent(out) :: remarks
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: a number is outside its range
      class(workspace_t), allocatable :: other
      type(definition_t), target :: definition
      logical :: is_done

      call take_new_numbers(session)
      call begin_words()
      call find_of(session%workspace, remarks, is_done)
      if (.not. is_done) then
         allocate (other)
         call reread(session%deck, session%numbers, session%workspace%definition, definition, other, error)
         if (.not. allocated(error)) call find_of(other, remarks, is_done)
      end if
      call end_words()
   end subroutine find_remarks

   !> Finds the messages at the numbers of a workspace. is_done is .false. if the design must be read from the deck's strings.
   subroutine find_of(workspace, remarks, is_done)
      type(workspace_t), intent(inout) :: workspace
      type(model_remarks_t), intent(out) :: remarks
      logical, intent(out) :: is_done
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: fault
      logical :: is_balanced

      call settle_model(workspace, is_balanced, is_done, fault)
      if (.not. is_done) return
      call report_cases(workspace, cases)
      if (is_balanced) then
         call find_model_remarks(workspace%suspension, workspace%raw, workspace%deck_cases, cases, .true., remarks)
      else
         call find_model_remarks(workspace%raw, workspace%raw, workspace%deck_cases, cases, .false., remarks)
      end if
      if (allocated(fault)) call remarks%faults%add(fault%message)
   end subroutine find_of

end module ek_session
