!> A deck opened for a program that calls elastokin: sets, reads and resets its numbers and strings. Part of the Fortran interface
!> (ek_api).
module ek_session_settings
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_decimal, only: number_limit
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_deck
   use ek_text, only: str, quoted, replace
   use ek_deck, only: deck_t, set_value
   use ek_parameter, only: choice_t, find_parameters, parameter_path
   use ek_matched_numbers, only: match_parameters
   use ek_reader, only: definition_t, read_design
   use ek_factor_paths, only: shortest
   use ek_design_numbers, only: reset_numbers, place_number, add_path, put_path, put_at, is_legal_path, is_legal_at
   use ek_session, only: session_t, begin_again, changed_deck, without_option
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: set_number, set_text, get_number, set_all, reset

contains

   !> Sets all numbers to which a path leads, as --set path=value does. A path may cover both sides of a mirrored axle, and names
   !> may contain *. Legal numbers that together do not define a valid model are stored; the next solution reports them.
   subroutine set_number(session, path, value, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value                        !! in the unit of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage; exit_deck, outside its legal range: nothing was changed
      integer :: setting

      setting = place_number(session%numbers, path)
      if (setting == 0 .or. .not. ieee_is_finite(value)) then
         call begin_words()
         call first_number(session, trim(adjustl(path)), value, setting, error)
         call end_words()
      end if
      if (allocated(error) .or. setting == 0) return
      if (is_legal_path(session%numbers, setting, value, session%workspace%definition%parameters)) then
         call put_path(session%numbers, setting, value)
      else
         call begin_words()
         call fail(error, exit_deck, range_message(session, trim(adjustl(path)), value))
         call end_words()
      end if
   end subroutine set_number

   !> Message about a number outside its legal range, as given by the deck reader.
   function range_message(session, path, value) result(message)
      type(session_t), intent(in) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value                        !! in the unit of the deck
      character(:), allocatable :: message
      type(error_t), allocatable :: error
      type(message_list_t) :: lines
      type(deck_t) :: trial
      type(definition_t) :: design
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
      if (lines%count() > 0) return
      message = setting//': the number is outside its legal range'
      if (allocated(error)) message = setting//': '//error%message      ! the error is found at another key, such as `curve`
   end function range_message

   !> Finds a path that is used for the first time, and checks it as --set does. `setting` is 0 if the path leads to no number of
   !> the design space; the value was then set in the deck's strings.
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
      call match_parameters(session%workspace%definition%parameters, session%workspace%definition%records, path, .false., found)
      if (size(found) == 0) then
         call take_text(session, path, shortest(value), error)
      else
         call add_path(session%numbers, path, found, setting)
      end if
   end subroutine first_number

   !> Sets a value as --set path=value does: '*1.1', '+2', a number or a string. The deck is read again, which takes some
   !> milliseconds.
   subroutine set_text(session, path, text, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path, text
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_deck: nothing was changed

      call begin_words()
      call take_text(session, path, text, error)
      call end_words()
   end subroutine set_text

   subroutine take_text(session, path, text, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path, text
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: changed

      call changed_deck(session, changed, error)
      if (.not. allocated(error)) call set_value(changed, path, text, error)
      if (.not. allocated(error)) call begin_again(changed, session, error)
      call without_option(error)
      if (.not. allocated(error)) session%is_text_changed = .true.
   end subroutine take_text

   !> Returns the number to which a path leads; NaN if the path leads to several different numbers, and 0 after an error.
   subroutine get_number(session, path, value, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(out) :: value                       !! in the unit of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: the path leads to no number that the deck gives
      type(choice_t), allocatable :: found(:)
      type(deck_t) :: trial
      real(wp) :: this
      logical :: is_one
      integer :: j

      value = 0.0_wp
      is_one = .true.
      call begin_words()
      call find_parameters(session%workspace%definition%parameters, session%workspace%definition%records, path, found)
      if (size(found) == 0) then
         trial = session%deck
         call set_value(trial, path, '1', error)           ! its message says what is wrong with the path
         if (allocated(error)) call replace(error%message, '=1: ', ': ')
         call without_option(error)
         if (.not. allocated(error) .and. index(path, 'part.') /= 1) &      ! a part that was never set is as drawn: 0
            call fail(error, exit_usage, quoted(path)//' leads to no number that can be read')
      end if
      do j = 1, size(found)
         this = found(j)%sign*session%numbers%value(found(j)%number)
         if (j == 1) value = this
         if (abs(this - value) > 0.0_wp) is_one = .false.
      end do
      call end_words()
      if (.not. is_one) value = ieee_value(value, ieee_quiet_nan)
   end subroutine get_number

   !> Sets all numbers, or size(values) numbers beginning with number `first`.
   subroutine set_all(session, values, error, first)
      type(session_t), intent(inout) :: session
      real(wp), intent(in) :: values(:)                    !! in the units of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage; exit_deck, every number outside its legal range: nothing
      !!                                                      was changed
      integer, intent(in), optional :: first               !! default 1
      logical :: is_legal
      integer :: k, before, last, count

      before = 0
      if (present(first)) before = first - 1
      last = before + size(values)
      count = 0
      if (allocated(session%numbers%value)) count = size(session%numbers%value)
      if (count == 0) then
         call fail(error, exit_usage, 'the session has no deck')
      else if (before < 0 .or. last > count) then
         call fail(error, exit_usage, 'expected positions from 1 to '//str(count)//', found '//str(before + 1)//' to '//str(last))
      else if (.not. all(ieee_is_finite(values))) then
         call fail(error, exit_usage, 'expected finite numbers')
      end if
      if (allocated(error)) return
      is_legal = .true.
      do k = 1, size(values)
         is_legal = is_legal .and. is_legal_at(session%numbers, before + k, values(k), session%workspace%definition%parameters)
      end do
      if (is_legal) then
         do k = 1, size(values)
            call put_at(session%numbers, before + k, values(k))
         end do
      else
         call begin_words()
         call refuse_all(session, values, before, error)
         call end_words()
      end if
   end subroutine set_all

   !> Creates the error message that lists all numbers outside their legal ranges.
   subroutine refuse_all(session, values, before, error)
      type(session_t), intent(in) :: session
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: before                        !! number of values before the first
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: lines
      integer :: k

      associate (design => session%workspace%definition)
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
         call begin_words()
         call begin_again(session%original, session, error)
         call end_words()
         session%is_text_changed = .false.
      else
         call reset_numbers(session%numbers)
      end if
   end subroutine reset

end module ek_session_settings
