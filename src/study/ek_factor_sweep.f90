!> Runs the designs of a study: a family of curves, and the responses of each design.
!>
!> A sampler (ek_sampler) makes the factors from the number of a design; a worker solves the design; its observations become rows
!> of the two tables (ek_response). Sampler and rows are pure; what a worker keeps between designs is its own.
module ek_factor_sweep
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8
   use ek_system, only: ask_memory
   use ek_error, only: error_t, fail, exit_deck, exit_convergence, message_list_t
   use ek_text, only: str, quoted
   use ek_deck, only: deck_t, set_value
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, failure_of
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: table_t, new_table, column_index, name_length, csv_head, csv_row
   use ek_study, only: study_t
   use ek_sampler, only: design_count, sample
   use ek_response, only: reading_t, needed_columns, no_column, prepare_reading, read_response
   use ek_subject, only: subject_t, factor_paths_t, make_subject, change_subject
   use ek_parameter, only: find_parameters
   use ek_writer, only: writer_t
   implicit none(type, external)
   private
   public :: sweep_factors

   !> What one worker keeps between designs.
   type :: worker_t
      type(subject_t) :: subject
      type(factor_paths_t), allocatable :: paths(:)      !! of the factors, set by the first design
   end type worker_t

contains

   !> Runs all designs. A design that cannot be built or solved is reported in `troubles` and has no values.
   !>
   !> The rows of a design are passed to the writers as soon as they are available; gnuplot requires an empty line after every
   !> curve, and after every block of designs.
   subroutine sweep_factors(study, deck, curves, responses, troubles, error, writers)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(table_t), intent(out) :: curves        !! design, factors, then the columns of the study; one row per state
      type(table_t), intent(out) :: responses     !! design, factors, responses, converged; one row per design
      type(message_list_t), intent(out) :: troubles
      type(error_t), allocatable, intent(out) :: error   !! a mistake in the study itself (a path, a column)
      type(writer_t), intent(inout), optional :: writers(2)      !! of curves and responses
      type(worker_t) :: worker
      type(case_result_t) :: result
      type(error_t), allocatable :: trouble
      type(reading_t), allocatable :: readings(:)
      character(name_length), allocatable :: wanted(:)
      real(wp) :: values(size(study%factors))
      integer :: design, k, used, before
      logical :: begins_block

      allocate (wanted(size(study%columns)))
      wanted(:) = study%columns
      do k = 1, size(study%responses)
         call needed_columns(study%responses(k), wanted)
      end do
      used = 0
      do design = 1, design_count(study%kind, study%factors)
         call sample(study%kind, study%factors, design, values, begins_block)
         call run_design(study, deck, values, wanted, worker, result, trouble, error)
         if (allocated(error)) return
         if (design == 1) then
            if (allocated(trouble)) then
               call fail(error, trouble%code, 'the first design of the study failed: '//label_of(study, values)//trouble%message)
            else
               call check_columns(study, result, readings, error)
            end if
            if (.not. allocated(error)) call start_tables(study, readings, size(result%table%values, 2), curves, responses, error)
            if (allocated(error)) return
            if (present(writers)) call writers(1)%add(csv_head(curves))
            if (present(writers)) call writers(2)%add(csv_head(responses))
         end if
         responses%values(:size(values) + 1, design) = [real(design, wp), values]
         responses%values(size(responses%columns), design) = 0.0_wp
         before = used
         if (allocated(trouble)) then
            call troubles%add(label_of(study, values)//trouble%message)
         else
            call take_curves(study, result%table, responses%values(:size(values) + 1, design), curves, used)
            call take_responses(readings, result%table, label_of(study, values), responses%values(size(values) + 2:, design), &
               troubles)
         end if
         if (.not. present(writers)) cycle
         if (before > 0 .and. used > before) call writers(1)%add(new_line('a'))
         do k = before + 1, used
            call writers(1)%add(csv_row(curves%values(:, k), curves%is_whole))
         end do
         if (begins_block .and. design > 1) call writers(2)%add(new_line('a'))
         call writers(2)%add(csv_row(responses%values(:, design), responses%is_whole))
         call writers(1)%flush()
         call writers(2)%flush()
      end do
      curves%values = curves%values(:, :used)
   end subroutine sweep_factors

   !> Solves one design, or gives the reason for its failure. `error`: a path that is invalid for every design.
   subroutine run_design(study, deck, values, wanted, worker, result, trouble, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      real(wp), intent(in) :: values(:)
      character(name_length), intent(in) :: wanted(:)    !! columns that are computed
      type(worker_t), intent(inout) :: worker
      type(case_result_t), intent(out) :: result
      type(error_t), allocatable, intent(out) :: trouble, error
      type(solve_options_t) :: options
      logical :: is_made
      integer :: k

      is_made = .false.
      if (allocated(worker%paths)) call change_subject(deck%file, worker%paths, values, worker%subject, is_made, trouble)
      if (.not. is_made) call read_again(study, deck, values, worker, trouble, error)
      if (allocated(error) .or. allocated(trouble)) return
      options%has_remarks = .false.
      options%columns = wanted
      call solve_case(worker%subject%suspension, worker%subject%case, options, result, observer=worker%subject%observer)
      if (.not. result%is_run()) call failure_of(result, trouble)
      if (allocated(trouble)) return
      associate (path => result%path)
         do k = 1, 2
            if (path%failure(k)%state > 0) call fail(trouble, exit_convergence, 'no equilibrium at factor '// &
               str(path%value(path%failure(k)%state)))
         end do
      end associate
   end subroutine run_design

   !> Reads a design from the deck with the factors as settings.
   subroutine read_again(study, deck, values, worker, trouble, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      real(wp), intent(in) :: values(:)
      type(worker_t), intent(inout) :: worker
      type(error_t), allocatable, intent(out) :: trouble, error
      type(deck_t) :: changed
      character(*), parameter :: given = '--set '
      integer :: f

      if (allocated(worker%paths)) deallocate (worker%paths)
      changed = deck
      do f = 1, size(values)
         associate (factor => study%factors(f))
            call set_value(changed, factor%path, shortest(values(f)), error)
            if (.not. allocated(error)) cycle
            ! report as a mistake of the study, not of the command line; mistakes of the deck itself come first
            error%code = exit_deck
            if (index(error%message, given) == 1) error%message = factor%where//': factor '//quoted(factor%name)//': '// &
               error%message(len(given) + 1:)
            return
         end associate
      end do
      call make_subject(changed, study%case, worker%subject, trouble)
      if (.not. allocated(trouble)) allocate (worker%paths(size(values)))
      do f = 1, size(values)
         associate (factor => study%factors(f), design => worker%subject%design)
            if (allocated(trouble)) then
               call replace(trouble%message, given//factor%path//'='//shortest(values(f)), factor%where//': factor '// &
                  quoted(factor%name)//' = '//shortest(values(f)))
            else
               call find_parameters(design%parameters, design%records, factor%path, worker%paths(f)%found)
            end if
         end associate
      end do
   end subroutine read_again

   !> 'spring.coil.rate=30 bushing.top_mount.kt(1)=500: ', for messages.
   function label_of(study, values) result(label)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: values(:)
      character(:), allocatable :: label
      integer :: f

      label = ''
      do f = 1, size(values)
         label = label//' '//study%factors(f)%path//'='//shortest(values(f))
      end do
      label = label(2:)//': '
   end function label_of

   !> The shortest text of nine or more digits that reads back as the same number: -5, 0.1, 1E-05.
   function shortest(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      real(wp) :: again
      integer :: digits, status

      do digits = 9, 17
         text = str(value, digits)
         read (text, *, iostat=status) again
         if (status == 0 .and. abs(again - value) <= 0.0_wp) return
      end do
   end function shortest

   !> Replaces every occurrence of a text by another.
   pure subroutine replace(text, old, new)
      character(:), allocatable, intent(inout) :: text
      character(*), intent(in) :: old, new
      integer :: first, at

      first = 1
      do
         at = index(text(first:), old)
         if (at == 0) return
         at = first + at - 1
         text = text(:at - 1)//new//text(at + len(old):)
         first = at + len(new)
      end do
   end subroutine replace

   !> Checks that all columns named by the study are in the first table and that its responses can be read.
   subroutine check_columns(study, result, readings, error)
      type(study_t), intent(in) :: study
      type(case_result_t), intent(in) :: result          !! of the first design
      type(reading_t), allocatable, intent(out) :: readings(:)
      type(error_t), allocatable, intent(out) :: error   !! exit_deck, every mistake
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:)    ! all columns of the results
      character(:), allocatable :: message
      integer :: j, k

      call sweep_columns(result%suspension, result%case, heads)
      do k = 1, size(study%columns)
         if (column_index(result%table, trim(study%columns(k))) == 0) &
            call mistakes%add(study%where//': columns: '//no_column(trim(study%columns(k)), heads))
      end do
      allocate (readings(size(study%responses)))
      do k = 1, size(study%responses)
         call prepare_reading(study%responses(k), result%table, result%case%unit_name, readings(k), message, heads)
         if (message /= '') call mistakes%add(message)
         do j = 1, k - 1
            if (readings(j)%head == readings(k)%head) call mistakes%add(readings(k)%asked%where//': response '// &
               quoted(readings(k)%asked%name)//': its column would have the name '//quoted(readings(k)%head)// &
               ', like that of response '//quoted(readings(j)%asked%name)//'; rename one')
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine check_columns

   !> Both tables with their columns, empty.
   subroutine start_tables(study, readings, states, curves, responses, error)
      type(study_t), intent(in) :: study
      type(reading_t), intent(in) :: readings(:)
      integer, intent(in) :: states                      !! of the first design
      type(table_t), intent(out) :: curves, responses
      type(error_t), allocatable, intent(out) :: error   !! there is not enough memory
      character(name_length), allocatable :: common(:), heads(:)
      integer :: k, designs

      designs = design_count(study%kind, study%factors)
      allocate (common(size(study%factors) + 1), heads(size(readings)))
      common(1) = 'design'
      do k = 1, size(study%factors)
         common(k + 1) = study%factors(k)%name
      end do
      do k = 1, size(readings)
         heads(k) = readings(k)%head
      end do
      responses = new_table([character(name_length) :: common, heads, 'converged'], designs)
      call ask_memory(16_i8*(size(common) + 1 + size(study%columns))*designs*states, 'a study of '//str(designs)//' designs', error)
      if (allocated(error)) return
      curves = new_table([character(name_length) :: common, 'factor', study%columns], designs*states)
      curves%is_whole(1) = .true.
      responses%is_whole(1) = .true.
   end subroutine start_tables

   !> Appends the states of a design; columns that its model does not define are nan.
   subroutine take_curves(study, table, design, curves, used)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      real(wp), intent(in) :: design(:)           !! its number and factors
      type(table_t), intent(inout) :: curves
      integer, intent(inout) :: used
      real(wp) :: nan
      integer :: place, k, n, states

      nan = ieee_value(nan, ieee_quiet_nan)
      n = size(design)
      states = size(table%values, 2)
      if (used + states > size(curves%values, 2)) &           ! a factor may be the number of increments
         curves%values = reshape(curves%values, [size(curves%values, 1), 2*(used + states)], pad=[nan])
      curves%values(:n, used + 1:used + states) = spread(design, 2, states)
      curves%values(n + 1, used + 1:used + states) = table%values(2, :)
      do k = 1, size(study%columns)
         place = column_index(table, trim(study%columns(k)))
         if (place > 0) curves%values(n + 1 + k, used + 1:used + states) = table%values(place, :)
      end do
      used = used + states
   end subroutine take_curves

   !> Evaluates the responses of a design.
   subroutine take_responses(readings, table, label, row, troubles)
      type(reading_t), intent(in) :: readings(:)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: label        !! of the design, for messages
      real(wp), intent(inout) :: row(:)        !! the responses, converged
      type(message_list_t), intent(inout) :: troubles
      character(:), allocatable :: message, all
      integer :: k

      all = ''
      do k = 1, size(readings)
         call read_response(readings(k), table, row(k), message)
         if (message /= '') all = all//'; response '//quoted(readings(k)%asked%name)//': '//message
      end do
      if (all /= '') call troubles%add(label//all(3:))
      row(size(row)) = minval(table%values(column_index(table, 'converged'), :))
   end subroutine take_responses

end module ek_factor_sweep
