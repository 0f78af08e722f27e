!> elastokin fit: finds the factors of a deck that fit curves, values and limits best, with confidence intervals.
module ek_fit_command
   use ek_error, only: error_t, fail, exit_usage, exit_convergence
   use ek_buffer, only: buffer_t
   use ek_text, only: plural
   use ek_file, only: make_folder, join_path, folder_name
   use ek_deck, only: deck_t
   use ek_session, only: session_t, open_deck
   use ek_fit, only: fit_t
   use ek_fit_reader, only: read_fit
   use ek_fit_problem, only: fit_problem_t, make_problem
   use ek_fit_solver, only: fit_result_t
   use ek_fit_statistics, only: fit_statistics_t
   use ek_fit_factors, only: fit_factors
   use ek_fit_text, only: add_fit_findings
   use ek_fit_files, only: write_fit_files
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: read_changed
   use ek_console, only: print_text, print_path, print_note
   implicit none(type, external)
   private
   public :: run_fit

contains

   !> Reads a fit, solves it, and prints and writes the result.
   subroutine run_fit(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: the iterations did not suffice
      type(fit_t) :: fit
      type(deck_t) :: deck
      class(session_t), allocatable :: session
      type(fit_problem_t) :: problem
      type(fit_result_t) :: found
      type(fit_statistics_t) :: statistics
      type(buffer_t) :: text
      character(:), allocatable :: home, out, message

      allocate (session)
      home = folder_name(line%files%line(1))
      out = line%value('--out', join_path(home, 'out'))
      if (out == '-') then
         call fail(error, exit_usage, 'fit writes several files and cannot be used with --out -')
         return
      end if
      call read_fit(line%files%line(1), fit, error)
      if (.not. allocated(error)) call read_changed(join_path(home, fit%deck), line%values('--set'), deck, error)
      if (.not. allocated(error)) call open_deck(deck, session, error)
      if (.not. allocated(error)) call make_problem(fit, join_path(home, ''), deck, session%workspace, problem, error)
      if (.not. allocated(error)) call make_folder(out, error)
      if (.not. allocated(error)) call fit_factors(fit, problem, session%workspace, found, statistics, error)
      if (allocated(error)) return
      call write_fit_files(fit, session%workspace, problem, found, statistics, out, .not. line%has('--no-plots'), message, error)
      if (allocated(error)) return
      if (message /= '') call print_note(line%has('--quiet'), message)
      call add_fit_findings(fit, session%workspace, problem, found, statistics, text)
      call print_text(text%text(), error)
      if (.not. allocated(error) .and. found%ended == 0) call fail(error, exit_convergence, 'the fit has not ended after '// &
         plural(found%steps, 'iteration', 'iterations')//'; the factors reached were written. Give more iterations in &fit')
   end subroutine run_fit

end module ek_fit_command
