!> A sweep of one or two factors of a deck: a family of curves, and the responses of each design.
module ek_factor_sweep
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8
   use ek_memory, only: ask_memory
   use ek_error, only: error_t, fail, exit_deck, exit_convergence, message_list_t
   use ek_text, only: str, quoted, nearest_name
   use ek_deck, only: deck_t, set_value
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, failure_of
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: table_t, new_table, column_index, name_length
   use ek_study, only: study_t
   use ek_response, only: reading_t, needed_columns, prepare_reading, read_response
   use ek_subject, only: subject_t, factor_paths_t, make_subject, change_subject
   use ek_parameter, only: find_parameters
   use ek_csv, only: csv_head, csv_row
   use ek_writer, only: writer_t
   implicit none(type, external)
   private
   public :: sweep_factors

contains

   !> Runs all designs. A design that cannot be built or solved is reported in `troubles` and has no values.
   !>
   !> The rows of a design are passed to the writers as soon as they are available; gnuplot requires an empty line after every
   !> curve, and after every row of the grid of two factors.
   subroutine sweep_factors(study, deck, curves, responses, troubles, error, curve_writer, response_writer)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(table_t), intent(out) :: curves        !! design, factors, then the columns of the study; one row per state
      type(table_t), intent(out) :: responses     !! design, factors, responses, converged; one row per design
      type(message_list_t), intent(out) :: troubles
      type(error_t), allocatable, intent(out) :: error   !! a mistake in the study itself (a path, a column)
      type(writer_t), intent(inout), optional :: curve_writer, response_writer
      type(table_t) :: table
      type(error_t), allocatable :: trouble
      type(reading_t), allocatable :: readings(:)
      type(subject_t) :: subject
      type(factor_paths_t), allocatable :: paths(:)
      real(wp), allocatable :: values(:), rows(:, :)
      character(:), allocatable :: label, unit
      character(name_length), allocatable :: wanted(:), heads(:)
      integer :: design, designs, first, second, i, j, f, n, used, before

      n = size(study%factors)
      first = size(study%factors(1)%values)
      second = 1
      if (n == 2) second = size(study%factors(2)%values)
      designs = first*second
      allocate (values(n), rows(0, 0))
      allocate (wanted(size(study%columns)))
      wanted(:) = study%columns
      do f = 1, size(study%responses)
         call needed_columns(study%responses(f), wanted)
      end do
      used = 0
      design = 0
      do i = 1, first
         do j = 1, second
            design = design + 1
            values(1) = study%factors(1)%values(i)
            if (n == 2) values(2) = study%factors(2)%values(j)
            label = ''
            do f = 1, n
               label = label//study%factors(f)%path//'='//shortest(values(f))//' '
            end do
            call run_design(study, deck, values, subject, paths, wanted, table, heads, unit, trouble, error)
            if (allocated(error)) return
            if (design == 1) then
               if (.not. allocated(trouble)) call check_columns(study, table, heads, unit, readings, error)
               if (allocated(trouble)) call fail(error, trouble%code, 'the first design of the study failed: '// &
                  trim(label)//': '//trouble%message)
               if (allocated(error)) return
               call start_tables(study, readings, table, designs, curves, responses)
               call ask_memory(16_i8*size(curves%columns)*designs*size(table%values, 2), &
                  'a study of '//str(designs)//' designs', error)
               if (allocated(error)) return
               deallocate (rows)
               allocate (rows(size(curves%columns), designs*size(table%values, 2)))
               if (present(curve_writer)) call curve_writer%add(csv_head(curves))
               if (present(response_writer)) call response_writer%add(csv_head(responses))
            end if
            responses%values(1, design) = design
            responses%values(2:n + 1, design) = values
            responses%values(size(responses%columns), design) = 0.0_wp
            before = used
            if (allocated(trouble)) then
               call troubles%add(trim(label)//': '//trouble%message)
            else
               call take_curves(study, table, design, values, rows, used)
               call take_responses(readings, table, n + 1, trim(label), responses%values(:, design), troubles)
            end if
            if (present(curve_writer)) then
               if (before > 0 .and. used > before) call curve_writer%add(new_line('a'))
               do f = before + 1, used
                  call curve_writer%add(csv_row(rows(:, f), curves%is_whole))
               end do
               call curve_writer%flush()
            end if
            if (present(response_writer)) then
               if (n == 2 .and. j == 1 .and. i > 1) call response_writer%add(new_line('a'))
               call response_writer%add(csv_row(responses%values(:, design), responses%is_whole))
               call response_writer%flush()
            end if
         end do
      end do
      curves%values = rows(:, :used)
   end subroutine sweep_factors

   !> Runs one design: its table, or the reason for its failure. `error`: a path that is invalid for every design.
   subroutine run_design(study, deck, values, subject, paths, wanted, table, heads, unit, trouble, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      real(wp), intent(in) :: values(:)
      type(subject_t), intent(inout) :: subject          !! from the designs before
      type(factor_paths_t), allocatable, intent(inout) :: paths(:)   !! of the factors, set by the first design
      character(name_length), intent(in) :: wanted(:)    !! columns that are computed
      type(table_t), intent(out) :: table                !! those that the model defines
      character(name_length), allocatable, intent(inout) :: heads(:)   !! all columns of the results, set by the first design
      character(:), allocatable, intent(out) :: unit     !! of the column `factor`: 'mm', 'N', …
      type(error_t), allocatable, intent(out) :: trouble, error
      type(solve_options_t) :: options
      type(case_result_t) :: result
      logical :: is_made
      integer :: k

      unit = ''
      is_made = .false.
      if (allocated(paths)) call change_subject(deck%file, paths, values, subject, is_made, trouble)
      if (.not. is_made) call read_again(study, deck, values, subject, paths, trouble, error)
      if (allocated(error) .or. allocated(trouble)) return
      options%has_remarks = .false.
      options%columns = wanted
      call solve_case(subject%suspension, subject%case, options, result, observer=subject%observer)
      if (.not. result%is_run()) call failure_of(result, trouble)
      if (allocated(trouble)) return
      unit = result%case%unit_name
      table = result%table
      if (.not. allocated(heads)) call sweep_columns(result%suspension, result%case, heads)
      associate (path => result%path)
         do k = 1, 2
            if (path%failure(k)%state > 0) call fail(trouble, exit_convergence, 'no equilibrium at factor '// &
               str(path%value(path%failure(k)%state)))
         end do
      end associate
   end subroutine run_design

   !> Reads a design from the deck with the factors as settings.
   subroutine read_again(study, deck, values, subject, paths, trouble, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      real(wp), intent(in) :: values(:)
      type(subject_t), intent(inout) :: subject
      type(factor_paths_t), allocatable, intent(inout) :: paths(:)
      type(error_t), allocatable, intent(out) :: trouble, error
      type(deck_t) :: changed
      character(*), parameter :: given = '--set '
      integer :: f

      if (allocated(paths)) deallocate (paths)
      changed = deck
      do f = 1, size(values)
         call set_value(changed, study%factors(f)%path, shortest(values(f)), error)
         if (.not. allocated(error)) cycle
         ! report as a mistake of the study, not of the command line; mistakes of the deck itself come first
         error%code = exit_deck
         if (index(error%message, given) == 1) error%message = study%factors(f)%where//': factor '// &
            quoted(study%factors(f)%name)//': '//error%message(len(given) + 1:)
         return
      end do
      call make_subject(changed, study%case, subject, trouble)
      if (allocated(trouble)) then
         do f = 1, size(values)
            call replace(trouble%message, given//study%factors(f)%path//'='//shortest(values(f)), &
               study%factors(f)%where//': factor '//quoted(study%factors(f)%name)//' = '//shortest(values(f)))
         end do
         return
      end if
      allocate (paths(size(values)))
      do f = 1, size(values)
         call find_parameters(subject%design%parameters, subject%design%records, study%factors(f)%path, paths(f)%found)
      end do
   end subroutine read_again

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

   !> Checks that all columns named by the study are in the table and that its responses can be read.
   subroutine check_columns(study, table, heads, unit, readings, error)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      character(*), intent(in) :: heads(:)               !! all columns of the results
      character(*), intent(in) :: unit                   !! of the column `factor`
      type(reading_t), allocatable, intent(out) :: readings(:)
      type(error_t), allocatable, intent(out) :: error   !! exit_deck, every mistake
      character(:), allocatable :: text, hint
      integer :: j, k

      text = ''
      do k = 1, size(study%columns)
         if (column_index(table, trim(study%columns(k))) > 0) cycle
         hint = nearest_name(trim(study%columns(k)), heads)
         if (len(hint) > 0) hint = ' (did you mean '//quoted(hint)//'?)'
         text = text//study%where//': columns: the results have no column '//quoted(study%columns(k))//hint//new_line('a')
      end do
      allocate (readings(size(study%responses)))
      do k = 1, size(study%responses)
         call prepare_reading(study%responses(k), table, unit, readings(k), hint, heads)
         if (hint /= '') text = text//hint//new_line('a')
         do j = 1, k - 1
            if (readings(j)%head == readings(k)%head) text = text//readings(k)%asked%where//': response '// &
               quoted(readings(k)%asked%name)//': its column would have the name '//quoted(readings(k)%head)// &
               ', like that of response '//quoted(readings(j)%asked%name)//'; rename one'//new_line('a')
         end do
      end do
      if (len(text) > 0) call fail(error, exit_deck, text(:len(text) - 1))
   end subroutine check_columns

   !> Column names of both tables.
   subroutine start_tables(study, readings, table, designs, curves, responses)
      type(study_t), intent(in) :: study
      type(reading_t), intent(in) :: readings(:)
      type(table_t), intent(in) :: table
      integer, intent(in) :: designs
      type(table_t), intent(out) :: curves, responses
      character(name_length), allocatable :: heads(:)
      integer :: k, n

      n = size(study%factors)
      allocate (heads(n + 2 + size(study%columns)))
      heads(1) = 'design'
      do k = 1, n
         heads(k + 1) = study%factors(k)%name
      end do
      heads(n + 2) = 'factor'
      do k = 1, size(study%columns)
         heads(n + 2 + k) = study%columns(k)
      end do
      curves = new_table(heads, size(table%values, 2))
      curves%is_whole(1) = .true.
      deallocate (heads)
      allocate (heads(n + 2 + size(study%responses)))
      heads(1) = 'design'
      do k = 1, n
         heads(k + 1) = study%factors(k)%name
      end do
      do k = 1, size(study%responses)
         heads(n + 1 + k) = readings(k)%head
      end do
      heads(size(heads)) = 'converged'
      responses = new_table(heads, designs)
      responses%is_whole(1) = .true.
   end subroutine start_tables

   !> Appends the states of a design.
   subroutine take_curves(study, table, design, values, rows, used)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      integer, intent(in) :: design
      real(wp), intent(in) :: values(:)
      real(wp), intent(inout) :: rows(:, :)
      integer, intent(inout) :: used
      integer :: place(size(study%columns)), k, r, n

      n = size(values)
      do k = 1, size(place)
         place(k) = column_index(table, trim(study%columns(k)))
      end do
      do r = 1, size(table%values, 2)
         used = used + 1
         rows(1, used) = design
         rows(2:n + 1, used) = values
         rows(n + 2, used) = table%values(2, r)
         do k = 1, size(study%columns)
            rows(n + 2 + k, used) = ieee_value(1.0_wp, ieee_quiet_nan)      ! the model of this design does not define it
            if (place(k) > 0) rows(n + 2 + k, used) = table%values(place(k), r)
         end do
      end do
   end subroutine take_curves

   !> Evaluates the responses of a design.
   subroutine take_responses(readings, table, at, label, row, troubles)
      type(reading_t), intent(in) :: readings(:)
      type(table_t), intent(in) :: table
      integer, intent(in) :: at                !! number of columns before the responses
      character(*), intent(in) :: label        !! label of the design, for messages
      real(wp), intent(inout) :: row(:)
      type(message_list_t), intent(inout) :: troubles
      character(:), allocatable :: message, all
      integer :: k

      all = ''
      do k = 1, size(readings)
         call read_response(readings(k), table, row(at + k), message)
         if (message /= '') all = all//'; response '//quoted(readings(k)%asked%name)//': '//message
      end do
      if (all /= '') call troubles%add(label//': '//all(3:))
      row(size(row)) = minval(table%values(column_index(table, 'converged'), :))
   end subroutine take_responses

end module ek_factor_sweep
