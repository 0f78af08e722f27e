!> elastokin fit: finds the factors of a deck that fit curves, values and limits best, with confidence intervals, and
!> prints what was found.
module ek_fit_command
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_error, only: error_t, fail, exit_usage, exit_convergence
   use ek_buffer, only: buffer_t
   use ek_text, only: plural, str
   use ek_file, only: make_folder, join_path, folder_name
   use ek_deck, only: deck_t
   use ek_session, only: session_t, open_deck
   use ek_fit, only: fit_t
   use ek_fit_reader, only: read_fit
   use ek_fit_problem, only: fit_problem_t, make_problem
   use ek_fit_solver, only: fit_result_t
   use ek_fit_statistics, only: fit_statistics_t
   use ek_fit_factors, only: fit_factors
   use ek_fit_files, only: write_fit_files, changed_numbers, note_of, target_rms_t, rms_of_target
   use ek_fit_page, only: fit_page
   use ek_suspension, only: suspension_t
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: read_changed, settings_of
   use ek_console, only: print_text
   use ek_kinds, only: wp
   use ek_bounded_search, only: gain_is_small, step_is_small
   use ek_parameter, only: choice_t
   use ek_workspace, only: workspace_t
   use ek_deck_fragment, only: records_with
   use ek_study, only: is_given, by_value
   use ek_part_factor, only: expand_part
   implicit none(type, external)
   private
   public :: run_fit

   real(wp), parameter :: strong = 0.95_wp           !! smallest magnitude of a listed correlation
   real(wp), parameter :: part_of = 0.15_wp  !! limit of a share, relative to the largest share: factors above it are combined
   integer, parameter :: most_pairs = 10
   integer, parameter :: name_width = 34

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
      type(suspension_t) :: before                         ! model at the start
      character(:), allocatable :: home, out, page
      integer :: k, j

      allocate (session)
      home = folder_name(line%files%line(1))
      out = line%value('--out', join_path(home, 'out'))
      if (out == '-') then
         call fail(error, exit_usage, 'fit writes several files and cannot be used with --out -')
         return
      end if
      call read_fit(line%files%line(1), fit, error)
      if (.not. allocated(error)) call read_changed(join_path(home, fit%deck), settings_of(line), deck, error)
      if (.not. allocated(error)) then
         do k = 1, size(fit%factors)
            call expand_part(fit%factors(k), deck, error)
            if (size(fit%factors(k)%weights) /= size(fit%factors(k)%paths)) &
               fit%factors(k)%weights = [(1.0_wp, j=1, size(fit%factors(k)%paths))]
         end do
      end if
      if (.not. allocated(error)) call open_deck(deck, session, error)
      if (.not. allocated(error)) call make_problem(fit, join_path(home, ''), deck, session%workspace, problem, error)
      if (.not. allocated(error)) call make_folder(out, error)
      if (.not. allocated(error)) before = session%workspace%raw
      if (.not. allocated(error)) call fit_factors(fit, problem, session%workspace, found, statistics, error)
      if (allocated(error)) return
      call add_fit_findings(fit, session%workspace, problem, found, statistics, text)
      page = ''
      if (line%has('--page')) page = fit_page(fit, before, session%workspace, problem, found, statistics, text%text())
      call write_fit_files(fit, session%workspace, problem, found, statistics, out, .not. line%has('--no-plots'), &
         line%has('--quiet'), page, error)
      if (allocated(error)) return
      call print_text(text%text(), error)
      if (.not. allocated(error) .and. found%ended == 0) call fail(error, exit_convergence, 'the fit has not ended after '// &
         plural(found%steps, 'iteration', 'iterations')//'; the factors reached were written. Give more iterations in &fit')
   end subroutine run_fit

   !> Adds all findings of a fit to the printed output.
   subroutine add_fit_findings(fit, workspace, problem, found, statistics, text)
      type(fit_t), intent(in) :: fit
      type(workspace_t), intent(in) :: workspace          !! workspace with the numbers found
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      type(buffer_t), intent(inout) :: text
      type(choice_t), allocatable :: changed(:)

      call text%line('fit '//fit%name//': '//plural(size(problem%variables), 'factor', 'factors')//', '// &
         plural(size(problem%points), 'number', 'numbers')//' of '//plural(size(fit%targets), 'target', 'targets')//'; '// &
         plural(found%steps, 'iteration', 'iterations')//', '//plural(found%sweeps, 'sweep', 'sweeps'))
      call add_ending(problem, found, statistics, text)
      call add_targets(fit, problem, found, text)
      call add_factors(problem, found, statistics, text)
      call add_doubts(problem, found, statistics, text)
      call text%line('as records of the deck:')
      call changed_numbers(problem, changed)
      call text%line(records_with(workspace%definition, workspace%x, changed))
   end subroutine add_fit_findings

   !> Adds the reason why the fit ended, and the quality of the fit.
   subroutine add_ending(problem, found, statistics, text)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      type(buffer_t), intent(inout) :: text

      select case (found%ended)
      case (step_is_small, gain_is_small)
         call text%line('ended: converged')
      case (0)
         call text%line('ended: all iterations used')
      case default
         call text%line('ended: no step improves the fit any further')
      end select
      call text%line('sum of squares: '//str(found%sum_before, 6)//' -> '//str(found%sum_after, 6))
      if (problem%knows_deviation .and. statistics%freedom > 0) call text%line('per degree of freedom ('// &
         str(statistics%freedom)//'): '//str(found%sum_after/statistics%freedom, 4)//'; 1 if the deviations are right')
      if (.not. statistics%knows_sigma) then
         call text%line('standard deviation of one number: unknown, as there are not more numbers than factors and no target '// &
            'gives its deviation')
      else if (.not. problem%knows_deviation) then
         call text%line('standard deviation of one number, by what is left: '// &
            str(statistics%sigma, 4)//' (no target gives its deviation)')
      end if
      if (.not. any(statistics%has_effect)) then
         call text%line('no factor has an effect on the targets')
      else if (size(statistics%singular) == 0) then
         call text%line('rank 0 of '//plural(size(found%x), 'factor', 'factors')//': all limits are satisfied')
      else
         call text%line('rank '//str(statistics%rank)//' of '//plural(size(found%x), 'factor', 'factors')//'; singular values '// &
            str(maxval(statistics%singular), 4)//' to '//str(minval(statistics%singular), 4))
      end if
   end subroutine add_ending

   !> Adds for each target the root mean square of the differences at the start and of the result, and the number of points at which
   !> a limit is exceeded.
   subroutine add_targets(fit, problem, found, text)
      type(fit_t), intent(in) :: fit
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(buffer_t), intent(inout) :: text
      type(target_rms_t) :: rms
      integer :: t

      call text%line('target'//repeat(' ', name_width - 6)//'points   rms at start   rms of result')
      do t = 1, size(fit%targets)
         rms = rms_of_target(problem, found, t)
         if (rms%points == 0) then
            call text%line(padded(fit%targets(t)%name)//'     0   weight 0')
            cycle
         end if
         call text%line(padded(fit%targets(t)%name)//right(str(rms%points), 6)//right(str(rms%before, 5), 15)// &
            right(str(rms%after, 5), 16)//' '//problem%wanted(rms%first)%unit)
         if (rms%beyond > 0) call text%line('  a limit is exceeded at '//plural(rms%beyond, 'point', 'points'))
      end do
   end subroutine add_targets

   !> Adds start, result and 95 % interval of every factor.
   subroutine add_factors(problem, found, statistics, text)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      type(buffer_t), intent(inout) :: text
      character(:), allocatable :: confidence
      integer :: f

      call text%line('factor'//repeat(' ', name_width - 6)//'       start        result   95 % confidence')
      do f = 1, size(problem%variables)
         associate (this => problem%variables(f))
            confidence = note_of(problem, found, statistics, f)
            if (found%held(f) /= 0) then
               confidence = 'at its '//trim(merge('lower', 'upper', found%held(f) < 0))//' bound; '//confidence
               if (statistics%low(f) < statistics%high(f) .and. ieee_is_finite(statistics%half(f))) confidence = confidence// &
                  ', '//str(statistics%low(f), 6)//' to '//str(statistics%high(f), 6)//' '//this%direction%unit
            else if (confidence == '' .and. .not. ieee_is_finite(statistics%half(f))) then
               confidence = 'unknown'
            else if (confidence == '') then
               confidence = '+- '//str(statistics%half(f), 4)//' '//this%direction%unit
            end if
            call text%line(padded(this%name)//right(str(this%start, 7), 12)//right(str(found%x(f), 9), 14)//'   '//trim(confidence))
         end associate
      end do
   end subroutine add_factors

   !> Adds the factors and combinations of factors that the targets do not determine, and strong correlations.
   subroutine add_doubts(problem, found, statistics, text)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      type(buffer_t), intent(inout) :: text
      integer, allocatable :: members(:)
      integer :: f, g, k, pairs

      do f = 1, size(problem%variables)
         if (statistics%is_learned(f)) cycle
         call text%line(problem%variables(f)%name//' cannot be learned from these tests'//remains(problem, statistics, f))
      end do
      do k = 1, size(statistics%unseen, 2)
         associate (share => abs(statistics%unseen(:, k))/statistics%width)
            members = pack([(f, f=1, size(share))], share > part_of*maxval(share))
         end associate
         if (size(members) > 1) call add_group(problem, found, statistics%unseen(:, k), members, text)
      end do
      pairs = 0
      do f = 1, size(problem%variables)
         do g = f + 1, size(problem%variables)
            if (abs(statistics%correlation(f, g)) < strong) cycle
            pairs = pairs + 1
            if (pairs <= most_pairs) call text%line('correlation '//str(statistics%correlation(f, g), 4)//' between '// &
               problem%variables(f)%name//' and '//problem%variables(g)%name)
         end do
      end do
      if (pairs > most_pairs) call text%line(str(pairs - most_pairs)//' more correlations above '//str(strong))
   end subroutine add_doubts

   !> The 95 % half width of a factor from the targets alone, and whether the prior of the factor determines the result.
   function remains(problem, statistics, f) result(words)
      type(fit_problem_t), intent(in) :: problem
      type(fit_statistics_t), intent(in) :: statistics
      integer, intent(in) :: f
      character(:), allocatable :: words

      words = ': they leave '
      if (ieee_is_finite(statistics%half_alone(f))) then
         words = words//'+- '//str(statistics%half_alone(f), 3)//' '//problem%variables(f)%direction%unit
      else
         words = words//'it open'
      end if
      if (is_given(problem%variables(f)%deviation)) words = words//'; the result is that of its prior'
   end function remains

   !> Adds a line on factors of which the targets determine only combinations.
   subroutine add_group(problem, found, direction, members, text)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      real(wp), intent(in) :: direction(:)                 !! direction along which the targets do not change
      integer, intent(in) :: members(:)
      type(buffer_t), intent(inout) :: text
      real(wp), parameter :: alike = 0.1_wp
      character(:), allocatable :: names
      real(wp) :: ratio, series
      integer :: j

      names = problem%variables(members(1))%name
      do j = 2, size(members)
         names = names//merge(' and ', ',    ', j == size(members))
         if (j < size(members)) names = trim(names)//' '
         names = names//problem%variables(members(j))%name
      end do
      if (size(members) > 2) then
         call text%line('only combinations of '//names//' are seen: the tests do not separate them')
         return
      end if
      associate (a => members(1), b => members(2))
         ratio = direction(a)/direction(b)
         series = -1.0_wp
         if (are_rates(problem, a, b)) series = -(found%x(a)/found%x(b))**2
         if (are_rates(problem, a, b) .and. abs(series + 1.0_wp) > 2.0_wp*alike .and. &
            abs(ratio - series) <= alike*abs(series)) then
            call text%line(names//' act in series: only 1/k1 + 1/k2 is seen')
         else if (are_rates(problem, a, b) .and. abs(series + 1.0_wp) > 2.0_wp*alike .and. abs(ratio + 1.0_wp) <= alike) then
            call text%line(names//' act in parallel: only k1 + k2 is seen')
         else
            call text%line('only one combination of '//names//' is seen: '//problem%variables(a)%name//' may rise by '// &
               str(ratio, 3)//' '//problem%variables(a)%direction%unit//' where '//problem%variables(b)%name//' rises by 1 '// &
               problem%variables(b)%direction%unit)
         end if
      end associate
   end subroutine add_group

   !> Whether two factors are rates with the same unit and positive start values.
   pure logical function are_rates(problem, a, b)
      type(fit_problem_t), intent(in) :: problem
      integer, intent(in) :: a, b

      associate (unit => problem%variables(a)%direction%unit)
         are_rates = index(unit, '/') > 0 .and. unit == problem%variables(b)%direction%unit
      end associate
      are_rates = are_rates .and. problem%variables(a)%start > 0.0_wp .and. problem%variables(b)%start > 0.0_wp
   end function are_rates

   !> A name, padded with blanks to the width of its column.
   function padded(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      text = name//repeat(' ', max(1, name_width - len(name)))
   end function padded

   !> A string, padded with blanks on the left to the width of its column.
   function right(text, width) result(cell)
      character(*), intent(in) :: text
      integer, intent(in) :: width
      character(:), allocatable :: cell
      cell = repeat(' ', max(1, width - len(text)))//text
   end function right

end module ek_fit_command
