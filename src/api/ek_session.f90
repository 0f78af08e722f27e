!> A deck opened for a program that calls elastokin: its numbers. Part of the Fortran interface (ek_api, where it is described).
module ek_session
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_decimal, only: number_limit
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_deck
   use ek_text, only: quoted, replace
   use ek_deck, only: deck_t, read_deck, parse_deck, move_deck, set_value, deck_checksum
   use ek_parameter, only: choice_t, find_parameters, parameter_path
   use ek_reader, only: design_t, read_design
   use ek_case_result, only: solve_options_t
   use ek_factor_paths, only: shortest
   use ek_table, only: name_length
   use ek_design_numbers, only: design_numbers_t, begin_numbers, reset_numbers, place_number, add_path, put_path, put_at, &
      is_legal_path, is_legal_at, apply_settings
   use ek_workspace, only: workspace_t, put_numbers
   use ek_workspace_cases, only: open_workspace
   use ek_named_numbers, only: named_numbers_t
   use ek_derivatives, only: derivatives_t
   implicit none(type, external)
   private
   public :: session_t, prepared_t, derived_t, open_file, open_text, open_deck, take_deck, set_number, set_text
   public :: get_number, set_all, reset
   public :: take_new_numbers, changed_deck, checksum_of, without_option, begin_opened, begin_workspace, empty_session

   !> A case that was solved with these columns: a further solution makes no text.
   type :: prepared_t
      logical :: is_ready = .false.
      character(name_length), allocatable :: asked(:)      !! as the caller wrote them; of size 0: all
      type(solve_options_t) :: options
   end type prepared_t

   !> Derivatives that were requested last: the same derivatives of another design create no strings.
   type :: derived_t
      type(derivatives_t) :: derivatives
      character(name_length), allocatable :: columns(:), paths(:)      !! as the caller wrote them
      integer, allocatable :: column(:), direction(:)                  !! where each stands in `derivatives`
   end type derived_t

   !> A deck, its present numbers, and its last solution. A caller may read the components, and changes them by procedures only.
   type :: session_t
      type(deck_t) :: original                      !! as opened
      type(deck_t) :: deck                          !! with the settings of set_text
      class(workspace_t), allocatable :: workspace !! of this deck; allocated when opened. A class as in case_work_t
      type(design_numbers_t) :: numbers             !! numbers as changed since the deck was opened
      logical :: is_text_changed = .false.
      ! ek_session_solution
      integer :: solved = 0                         !! case of the last solution; 0: there is none
      type(prepared_t), allocatable :: prepared(:)  !! of each case
      class(workspace_t), allocatable :: other  !! has the last solution if `workspace` has not: deck with its numbers as text,
      !!                                               or of the deck before set_text or reset
      real(wp), allocatable :: solved_x(:)          !! the numbers of the last solution
      class(derived_t), allocatable :: derived      !! ek_session_derivatives
      ! ek_session_numbers
      class(named_numbers_t), allocatable :: named  !! key numbers requested last
      character(name_length), allocatable :: names(:)
      logical :: is_named_ready = .false.           !! the numbers were read before: a further reading makes no text
   end type session_t

contains

   !> Empties a session: one procedure where gfortran writes out how a session is given back.
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

   !> Opens a deck that is given as text.
   subroutine open_text(text, name, session, error)
      character(*), intent(in) :: text
      character(*), intent(in) :: name                     !! for messages; its folder contains included files and load tables
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every error of the deck

      call empty_session(session)
      !$omp critical (ek_words)
      call parse_deck(text, name, session%original, error)
      if (.not. allocated(error)) call begin_opened(session, error)
      !$omp end critical (ek_words)
   end subroutine open_text

   !> Opens a deck that was read.
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

   !> Opens a deck as open_deck does; the deck is handed over.
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

   !> Takes the deck as opened.
   subroutine begin_opened(session, error)
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error

      allocate (session%workspace)
      call open_workspace(session%original, session%workspace, error)
      if (allocated(error)) return
      session%deck = session%original
      call begin_workspace(session)
   end subroutine begin_opened

   !> Replaces the deck; if the new deck has errors, the session is unchanged. The last solution is not deleted in either case: its
   !> workspace is stored until the next solution.
   subroutine begin(deck, session, error)
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
   end subroutine begin

   !> Begins the parts of a session that depend on its workspace's deck.
   subroutine begin_workspace(session)
      type(session_t), intent(inout) :: session

      if (allocated(session%prepared)) deallocate (session%prepared)
      allocate (session%prepared(size(session%workspace%cases)))
      call begin_numbers(session%workspace%design, session%numbers)
      session%numbers%is_new = .false.                     ! the workspace was made with them
      session%is_named_ready = .false.
      if (allocated(session%derived)) session%derived%derivatives%case = 0      ! of another workspace: kept as room
   end subroutine begin_workspace

   !> Sets all numbers to which a path leads, as --set path=value: both sides of a mirrored axle, and * in names. Legal numbers that
   !> together do not define a valid model are stored, and the next solution reports them.
   subroutine set_number(session, path, value, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value                        !! in the unit of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage; exit_deck, outside its legal range: nothing was changed
      integer :: setting

      setting = place_number(session%numbers, path)
      if (setting == 0 .or. .not. ieee_is_finite(value)) then
         !$omp critical (ek_words)
         call first_number(session, trim(adjustl(path)), value, setting, error)
         !$omp end critical (ek_words)
      end if
      if (allocated(error) .or. setting == 0) return
      if (is_legal_path(session%numbers, setting, value, session%workspace%design%parameters)) then
         call put_path(session%numbers, setting, value)
      else
         !$omp critical (ek_words)
         call fail(error, exit_deck, range_message(session, trim(adjustl(path)), value))
         !$omp end critical (ek_words)
      end if
   end subroutine set_number

   !> The message about a number outside its legal range, as the reader of decks gives it.
   function range_message(session, path, value) result(message)
      type(session_t), intent(in) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value                        !! in the unit of the deck
      character(:), allocatable :: message
      type(error_t), allocatable :: error
      type(message_list_t) :: lines
      type(deck_t) :: trial
      type(design_t) :: design
      character(:), allocatable :: setting, rest
      integer :: last

      setting = path//'='//shortest(value)
      trial = session%deck
      call set_value(trial, path, shortest(value), error)
      if (.not. allocated(error)) call read_design(trial, design, error)
      call without_option(error)
      rest = ''
      if (allocated(error)) rest = error%message
      do while (len(rest) > 0)                             ! other mistakes are not of this call
         last = index(rest//new_line('a'), new_line('a')) - 1
         if (index(rest, setting//':') == 1) call lines%add(rest(:last))
         rest = rest(min(last + 2, len(rest) + 1):)
      end do
      message = lines%text()
      if (lines%count() == 0) message = setting//': the number is outside its legal range'
   end function range_message

   !> Finds a path that is used for the first time: checks it as --set does. setting is 0 if the path leads to no number of the
   !> design space, and the value was set in the text.
   subroutine first_number(session, path, value, setting, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value
      integer, intent(inout) :: setting
      type(error_t), allocatable, intent(out) :: error
      type(choice_t), allocatable :: found(:)
      type(deck_t) :: trial

      if (.not. ieee_is_finite(value)) then
         call fail(error, exit_usage, quoted(path)//': expected a finite number')
         return
      end if
      trial = session%deck
      ! of a value that is too large, whether the path is right: set_number refuses the value
      call set_value(trial, path, shortest(merge(value, 1.0_wp, abs(value) < number_limit)), error)
      call without_option(error)
      if (allocated(error)) return
      call find_parameters(session%workspace%design%parameters, session%workspace%design%records, path, found)
      if (size(found) == 0) then
         call take_text(session, path, shortest(value), error)
      else
         call add_path(session%numbers, path, found, setting)
      end if
   end subroutine first_number

   !> Sets a value as --set path=text does: '*1.1', '+2', a number or a word. The deck is read again, which takes some milliseconds.
   subroutine set_text(session, path, text, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path, text
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: nothing was changed

      !$omp critical (ek_words)
      call take_text(session, path, text, error)
      !$omp end critical (ek_words)
   end subroutine set_text

   subroutine take_text(session, path, text, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path, text
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: changed

      call changed_deck(session, changed, error)
      if (.not. allocated(error)) call set_value(changed, path, text, error)
      if (.not. allocated(error)) call begin(changed, session, error)
      call without_option(error)
      if (.not. allocated(error)) session%is_text_changed = .true.
   end subroutine take_text

   !> Returns the number to which a path leads; not a number if it leads to several that differ.
   subroutine get_number(session, path, value, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(out) :: value                       !! in the unit of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: it leads to no number that the deck gives
      type(choice_t), allocatable :: found(:)
      type(deck_t) :: trial
      real(wp) :: this
      logical :: is_one
      integer :: j

      value = 0.0_wp
      is_one = .true.
      !$omp critical (ek_words)
      call find_parameters(session%workspace%design%parameters, session%workspace%design%records, path, found)
      if (size(found) == 0) then
         trial = session%deck
         call set_value(trial, path, '1', error)           ! its message says what is wrong with the path
         if (allocated(error)) call replace(error%message, '=1: ', ': ')
         call without_option(error)
         if (.not. allocated(error)) call fail(error, exit_usage, quoted(path)//' leads to no number that can be read')
      end if
      do j = 1, size(found)
         this = found(j)%sign*session%numbers%value(found(j)%number)
         if (j == 1) value = this
         if (abs(this - value) > 0.0_wp) is_one = .false.
      end do
      !$omp end critical (ek_words)
      if (.not. is_one) value = ieee_value(value, ieee_quiet_nan)
   end subroutine get_number

   !> Sets all numbers, or from number `first` on as many as there are values.
   subroutine set_all(session, values, error, first)
      type(session_t), intent(inout) :: session
      real(wp), intent(in) :: values(:)                    !! in the units of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage; exit_deck, every number outside its legal range: nothing
      !!                                                      was changed
      integer, intent(in), optional :: first               !! default 1
      logical :: is_legal
      integer :: k, before

      before = 0
      if (present(first)) before = first - 1
      if (.not. all(ieee_is_finite(values))) then
         call fail(error, exit_usage, 'expected finite numbers')
         return
      end if
      is_legal = .true.
      do k = 1, size(values)
         is_legal = is_legal .and. is_legal_at(session%numbers, before + k, values(k), session%workspace%design%parameters)
      end do
      if (is_legal) then
         do k = 1, size(values)
            call put_at(session%numbers, before + k, values(k))
         end do
      else
         !$omp critical (ek_words)
         call refuse_all(session, values, before, error)
         !$omp end critical (ek_words)
      end if
   end subroutine set_all

   !> Makes the message about all numbers outside their legal ranges.
   subroutine refuse_all(session, values, before, error)
      type(session_t), intent(in) :: session
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: before                        !! numbers before the first
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: lines
      integer :: k

      associate (design => session%workspace%design)
         do k = 1, size(values)
            if (is_legal_at(session%numbers, before + k, values(k), design%parameters)) cycle
            call lines%add(range_message(session, parameter_path(design%parameters%list(before + k), design%records), values(k)))
         end do
      end associate
      call fail(error, exit_deck, lines%text())
   end subroutine refuse_all

   !> Resets all numbers and strings to their values when the deck was opened.
   subroutine reset(session, error)
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error

      if (session%is_text_changed) then
         !$omp critical (ek_words)
         call begin(session%original, session, error)
         !$omp end critical (ek_words)
         session%is_text_changed = .false.
      else
         call reset_numbers(session%numbers)
      end if
   end subroutine reset

   !> Gives the workspace the numbers that were changed since.
   subroutine take_new_numbers(session)
      type(session_t), intent(inout) :: session

      if (session%numbers%is_new) call put_numbers(session%numbers%x, session%workspace)
      session%numbers%is_new = .false.
   end subroutine take_new_numbers

   !> Makes the deck with its present numbers as settings. One thread at a time.
   subroutine changed_deck(session, deck, error)
      type(session_t), intent(in) :: session
      type(deck_t), intent(out) :: deck
      type(error_t), allocatable, intent(out) :: error

      deck = session%deck
      call apply_settings(session%numbers, session%workspace%design, deck, error)
   end subroutine changed_deck

   !> Removes the option of the command line from a message on a setting, which then names its path alone.
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
