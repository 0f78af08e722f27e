!> A deck opened for a program that calls elastokin: change its numbers, solve its cases, read the results. The Fortran interface;
!> ek_c_model and its neighbours make the C interface of it.
!>
!>     type(session_t) :: session
!>     type(error_t), allocatable :: error
!>     call open_file('axle.nml', session, error)
!>     call set_number(session, 'bushing.lca_front.kt(1)', 500.0_wp, error)      in the unit of the deck, as --set
!>     call solve(session, 'parallel_travel', error)
!>     result => result_of(session)
!>     toe = column(result%table, 'left_toe_deg')
!>
!> `error` has the message and the exit status of the program for the same fault. Nothing is printed, nothing is kept outside the
!> session: different sessions may be used by different threads at a time. gfortran keeps the length of a text that a function
!> returns in one place for all threads, so everything that makes texts is done in the critical section `ek_words`; solutions after the
!> first of a case are numbers only and run at the same time.
module ek_session
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, is_like
   use ek_group, only: did_you_mean
   use ek_deck, only: deck_t, read_deck, parse_deck, set_value, deck_checksum
   use ek_parameter, only: choice_t, find_parameters
   use ek_case_result, only: case_result_t, solve_options_t, add_remarks, failure_of
   use ek_remark, only: remark_t, remark_list_t, note, warning
   use ek_response, only: no_column
   use ek_factor_paths, only: shortest
   use ek_table, only: name_length, column_index
   use ek_compliance, only: compliance_t, new_compliance
   use ek_schedule, only: new_schedule
   use ek_sweep_table, only: state_compliance
   use ek_wheel_side, only: deck_frame
   use ek_design_numbers, only: design_numbers_t, begin_numbers, reset_numbers, place_number, add_path, put_path, put_at, &
      apply_settings
   use ek_design_solver, only: design_solver_t, begin_design_solver, put_numbers, solve_case_fully, solve_case_again, &
      heads_of_case, case_number
   implicit none(type, external)
   private
   public :: session_t, open_file, open_text, set_number, set_text, get_number, set_all, reset, solve, result_of
   public :: compliance_at, read_remark, checksum_of

   !> A deck, its present numbers, and its last solution.
   type :: session_t
      type(deck_t) :: original                      !! as opened
      type(deck_t) :: deck                          !! with the settings of set_text
      type(design_solver_t) :: solver               !! of this deck
      type(design_numbers_t) :: numbers             !! changed since
      integer :: solved = 0                         !! case of the last solution; 0: there is none
      type(prepared_t), allocatable, private :: prepared(:)
      type(design_solver_t), allocatable, private :: other      !! of the deck with the numbers as text, for one solution
      logical, private :: is_text_changed = .false.
   end type session_t

   !> A case that was solved with these columns: a further solution makes no text.
   type :: prepared_t
      logical :: is_ready = .false.
      character(name_length), allocatable :: asked(:)      !! as the caller wrote them; of size 0: all
      type(solve_options_t) :: options
   end type prepared_t

contains

   !> Opens a deck file; '-' is standard input.
   subroutine open_file(path, session, error)
      character(*), intent(in) :: path
      type(session_t), intent(out) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_file, exit_deck: every mistake of the deck

      !$omp critical (ek_words)
      call read_deck(path, session%original, error)
      if (.not. allocated(error)) call begin(session%original, session, error)
      !$omp end critical (ek_words)
   end subroutine open_file

   !> Opens a deck that is given as text.
   subroutine open_text(text, name, session, error)
      character(*), intent(in) :: text
      character(*), intent(in) :: name                     !! for messages; its folder is that of included files and load tables
      type(session_t), intent(out) :: session
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: every mistake of the deck

      !$omp critical (ek_words)
      call parse_deck(text, name, session%original, error)
      if (.not. allocated(error)) call begin(session%original, session, error)
      !$omp end critical (ek_words)
   end subroutine open_text

   !> Takes a deck; the session stays as it was if the deck has mistakes.
   subroutine begin(deck, session, error)
      type(deck_t), intent(in) :: deck
      type(session_t), intent(inout) :: session
      type(error_t), allocatable, intent(out) :: error
      type(design_solver_t) :: solver

      call begin_design_solver(deck, solver, error)
      if (allocated(error)) return
      session%deck = deck
      session%solver = solver
      if (allocated(session%prepared)) deallocate (session%prepared)
      allocate (session%prepared(size(solver%cases)))
      call begin_numbers(session%solver%design, session%numbers)
   end subroutine begin

   !> Sets all numbers to which a path leads, as --set path=value: both sides of a mirrored axle, and * in names. A value outside its
   !> legal range is reported by the next solution.
   subroutine set_number(session, path, value, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: path
      real(wp), intent(in) :: value                        !! in the unit of the deck
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: nothing was changed
      integer :: setting

      setting = place_number(session%numbers, path)
      if (setting == 0 .or. .not. ieee_is_finite(value)) then
         !$omp critical (ek_words)
         call first_number(session, trim(adjustl(path)), value, setting, error)
         !$omp end critical (ek_words)
      end if
      if (allocated(error) .or. setting == 0) return
      call put_path(session%numbers, setting, value)
   end subroutine set_number

   !> A path that is used for the first time: checks it as --set does. setting is 0 if the path leads to no number of the design
   !> space, and the value was set in the text.
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
      call set_value(trial, path, shortest(value), error)
      if (allocated(error)) return
      call find_parameters(session%solver%design%parameters, session%solver%design%records, path, found)
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

      changed = session%deck
      call apply_settings(session%numbers, session%solver%design, changed, error)
      if (.not. allocated(error)) call set_value(changed, path, text, error)
      if (.not. allocated(error)) call begin(changed, session, error)
      if (.not. allocated(error)) session%is_text_changed = .true.
   end subroutine take_text

   !> The number to which a path leads; not a number if it leads to several that differ.
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
      call find_parameters(session%solver%design%parameters, session%solver%design%records, path, found)
      if (size(found) == 0) then
         trial = session%deck
         call set_value(trial, path, '1', error)           ! its message says what is wrong with the path
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
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: nothing was changed
      integer, intent(in), optional :: first               !! default 1
      integer :: k, before

      before = 0
      if (present(first)) before = first - 1
      if (.not. all(ieee_is_finite(values))) then
         call fail(error, exit_usage, 'expected finite numbers')
         return
      end if
      do k = 1, size(values)
         call put_at(session%numbers, before + k, values(k))
      end do
   end subroutine set_all

   !> All numbers and texts as opened.
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

   !> Solves a case at the present numbers: of the deck, or a standard test. Its table has all columns, or `state`, `factor`, those named
   !> (in the order of the program's tables) and the last ones on convergence.
   subroutine solve(session, name, error, columns)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: name                         !! '': the first case of the deck
      type(error_t), allocatable, intent(out) :: error         !! exit_usage, exit_deck, exit_model: there is no result;
      !!                                                          exit_convergence: there is one, with the states that converged
      character(*), intent(in), optional :: columns(:)         !! * stands for any characters; absent or of size 0: all
      character(name_length), allocatable :: asked(:)
      logical :: is_done
      integer :: k

      session%solved = 0
      if (allocated(session%other)) deallocate (session%other)
      allocate (asked(0))
      if (present(columns)) asked = columns
      k = case_number(name, session%solver)
      is_done = .false.
      if (session%numbers%is_new) call put_numbers(session%numbers%x, session%solver)
      session%numbers%is_new = .false.
      if (k > 0) then
         if (is_ready(session%prepared(k), asked)) then
            call solve_case_again(k, session%prepared(k)%options, session%solver, is_done)
            if (is_done) session%solved = k
         end if
      end if
      !$omp critical (ek_words)
      if (.not. is_done) call solve_with_words(session, name, asked, error)
      if (session%solved > 0) call end_solution(session, error)
      !$omp end critical (ek_words)
   end subroutine solve

   !> Whether a case was solved before with these columns.
   pure logical function is_ready(prepared, asked)
      type(prepared_t), intent(in) :: prepared
      character(name_length), intent(in) :: asked(:)

      is_ready = prepared%is_ready
      if (is_ready) is_ready = size(asked) == size(prepared%asked)
      if (is_ready) is_ready = all(asked == prepared%asked)
   end function is_ready

   !> A first solution, or one that may fail.
   subroutine solve_with_words(session, name, asked, error)
      type(session_t), intent(inout) :: session
      character(*), intent(in) :: name
      character(name_length), intent(in) :: asked(:)
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: changed
      type(prepared_t) :: prepared
      logical :: is_done
      integer :: k

      call find_case(name, session%solver, session%deck%file, k, error)
      if (.not. allocated(error)) call prepare(session%solver, k, asked, session%prepared(k), error)
      if (.not. allocated(error)) call solve_case_fully(k, session%prepared(k)%options, session%solver, is_done, error)
      if (allocated(error)) return
      session%prepared(k)%is_ready = is_done
      if (.not. is_done) then
         changed = session%deck
         allocate (session%other)
         call apply_settings(session%numbers, session%solver%design, changed, error)
         if (.not. allocated(error)) call begin_design_solver(changed, session%other, error)
         if (.not. allocated(error)) call find_case(name, session%other, session%deck%file, k, error)
         if (.not. allocated(error)) call prepare(session%other, k, asked, prepared, error)
         if (.not. allocated(error)) call solve_case_fully(k, prepared%options, session%other, is_done, error)
         if (allocated(error)) return
      end if
      session%solved = k
   end subroutine solve_with_words

   subroutine find_case(name, solver, file, k, error)
      character(*), intent(in) :: name, file
      type(design_solver_t), intent(in) :: solver
      integer, intent(out) :: k
      type(error_t), allocatable, intent(out) :: error
      character(name_length) :: names(size(solver%cases))
      integer :: j

      k = case_number(name, solver)
      if (k > 0) return
      do j = 1, size(names)
         names(j) = solver%cases(j)%case%name
      end do
      call fail(error, exit_usage, 'no case '//quoted(name)//' in '//file//did_you_mean(name, names))
   end subroutine find_case

   !> The columns that a case is to have: names with * become those that they fit.
   subroutine prepare(solver, k, asked, prepared, error)
      type(design_solver_t), intent(in) :: solver
      integer, intent(in) :: k
      character(name_length), intent(in) :: asked(:)
      type(prepared_t), intent(out) :: prepared
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: columns that the case does not have
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:)
      logical, allocatable :: is_wanted(:), fits(:)
      integer :: j, h

      prepared%options%has_remarks = .false.
      prepared%asked = asked
      if (size(asked) == 0) return
      call heads_of_case(k, solver, heads)
      allocate (is_wanted(size(heads)), source=.false.)
      do j = 1, size(asked)
         fits = [(is_like(trim(heads(h)), trim(asked(j))), h=1, size(heads))]
         if (.not. any(fits)) call mistakes%add('case '//quoted(solver%cases(k)%case%name)//': '//no_column(trim(asked(j)), heads))
         is_wanted = is_wanted .or. fits
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
      prepared%options%columns = pack(heads, is_wanted)
   end subroutine prepare

   !> Remarks on the last solution, and its failures as an error.
   subroutine end_solution(session, error)
      type(session_t), intent(inout), target :: session
      type(error_t), allocatable, intent(inout) :: error
      type(solve_options_t) :: options
      type(case_result_t), pointer :: result

      result => result_of(session)
      if (result%is_run()) call add_remarks(options, result)
      call failure_of(result, error)
      if (.not. result%is_run()) session%solved = 0
   end subroutine end_solution

   !> The last solution: result%table has the columns, one row per state; result%remarks the notes, warnings and failures.
   !> Not associated if there is none.
   function result_of(session) result(last)
      type(session_t), intent(inout), target :: session
      type(case_result_t), pointer :: last

      nullify (last)
      if (session%solved == 0) return
      if (allocated(session%other)) then
         last => session%other%cases(session%solved)%result
      else
         last => session%solver%cases(session%solved)%result
      end if
   end function result_of

   !> A remark on a solution: its text, and 'note', 'warning' or 'failure'.
   subroutine read_remark(remarks, k, text, severity)
      type(remark_list_t), intent(in) :: remarks
      integer, intent(in) :: k
      character(:), allocatable, intent(out) :: text, severity
      type(remark_t) :: remark

      remark = remarks%item(k)
      text = remark%whole()
      severity = 'failure'
      if (remark%severity == note) severity = 'note'
      if (remark%severity == warning) severity = 'warning'
   end subroutine read_remark

   !> The compliance matrix at the wheel centres in one row of a solution, left before right, frame of the deck: displacements
   !> x y z and rotations [m, rad] by forces and moments [N, N m]; not a number where the state did not converge.
   subroutine compliance_at(result, row, c)
      type(case_result_t), intent(inout) :: result
      integer, intent(in) :: row
      real(wp), intent(out) :: c(:, :)                     !! 6 × wheels
      type(compliance_t) :: compliance
      real(wp) :: arm(3, size(c, 1)/6), frame(3)
      integer :: state, i, j

      state = nint(result%table%values(column_index(result%table, 'state'), row)) + 1
      c = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. result%path%is_reached(state)) return
      compliance = new_compliance(result%suspension, .false.)
      call state_compliance(result%suspension, new_schedule(result%suspension, result%case), result%path, state, result%kkt, &
         compliance, c, arm)
      frame = deck_frame(result%suspension)
      do j = 1, size(c, 2)
         do i = 1, size(c, 1)
            c(i, j) = frame(mod(i - 1, 3) + 1)*frame(mod(j - 1, 3) + 1)*c(i, j)
         end do
      end do
   end subroutine compliance_at

   !> The checksum of the deck with its present numbers.
   subroutine checksum_of(session, digits, error)
      type(session_t), intent(in) :: session
      character(16), intent(out) :: digits
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: changed

      !$omp critical (ek_words)
      changed = session%deck
      call apply_settings(session%numbers, session%solver%design, changed, error)
      digits = deck_checksum(changed)
      !$omp end critical (ek_words)
   end subroutine checksum_of

end module ek_session
