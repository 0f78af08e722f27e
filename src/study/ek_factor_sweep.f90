!> A sweep of one or two factors of a deck: the family of curves, and the responses of each design.
module ek_factor_sweep
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8
   use ek_memory, only: ask_memory
   use ek_error, only: error_t, fail, exit_deck, exit_convergence, message_list_t
   use ek_text, only: str, quoted, nearest_name
   use ek_deck, only: deck_t, set_value
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t, sweep
   use ek_sweep_table, only: sweep_table
   use ek_table, only: table_t, new_table, column_index, name_length
   use ek_study, only: study_t, response_t
   use ek_subject, only: make_subject
   use ek_csv, only: csv_head, csv_row
   use ek_writer, only: writer_t
   implicit none(type, external)
   private
   public :: sweep_factors

contains

   !> Runs all designs. A design that cannot be built or solved is told in `troubles` and has no values.
   !>
   !> The rows of a design are handed to the writers as soon as they are there; gnuplot wants an empty line after every curve,
   !> and after every row of the grid that two factors make.
   subroutine sweep_factors(study, deck, curves, responses, troubles, error, curve_writer, response_writer)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(table_t), intent(out) :: curves        !! design, factors, then the study's columns; one row a state
      type(table_t), intent(out) :: responses     !! design, factors, responses, converged; one row a design
      type(message_list_t), intent(out) :: troubles
      type(error_t), allocatable, intent(out) :: error   !! the study itself is wrong (a path, a column)
      type(writer_t), intent(inout), optional :: curve_writer, response_writer
      type(table_t) :: table
      type(error_t), allocatable :: trouble
      real(wp), allocatable :: values(:), rows(:, :)
      character(:), allocatable :: label
      integer :: design, designs, first, second, i, j, f, n, used, before

      n = size(study%factors)
      first = size(study%factors(1)%values)
      second = 1
      if (n == 2) second = size(study%factors(2)%values)
      designs = first*second
      allocate (values(n), rows(0, 0))
      used = 0
      design = 0
      do i = 1, first
         do j = 1, second
            design = design + 1
            values(1) = study%factors(1)%values(i)
            if (n == 2) values(2) = study%factors(2)%values(j)
            label = ''
            do f = 1, n
               label = label//study%factors(f)%path//'='//str(values(f), 9)//' '
            end do
            call run_design(study, deck, values, table, trouble, error)
            if (allocated(error)) return
            if (design == 1) then
               if (.not. allocated(trouble)) call check_columns(study, table, error)
               if (allocated(trouble)) call fail(error, trouble%code, 'the first design of the study must stand: '// &
                  trim(label)//': '//trouble%message)
               if (allocated(error)) return
               call start_tables(study, table, designs, curves, responses)
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
               call take_responses(study, table, n + 1, responses%values(:, design))
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

   !> One design: its table, or why there is none. `error`: a path that no design can have.
   subroutine run_design(study, deck, values, table, trouble, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      real(wp), intent(in) :: values(:)
      type(table_t), intent(out) :: table
      type(error_t), allocatable, intent(out) :: trouble, error
      type(deck_t) :: changed
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
      character(*), parameter :: given = '--set '
      character(32) :: number
      integer :: f, k

      changed = deck
      do f = 1, size(values)
         write (number, '(es24.16)') values(f)
         call set_value(changed, study%factors(f)%path, trim(adjustl(number)), error)
         if (.not. allocated(error)) cycle
         ! a mistake of the study, not of the command line; of a deck with mistakes of its own these come first
         error%code = exit_deck
         if (index(error%message, given) == 1) error%message = study%factors(f)%where//': factor '// &
            quoted(study%factors(f)%name)//': '//error%message(len(given) + 1:)
         return
      end do
      call make_subject(changed, study%case, suspension, case, kkt, trouble)
      if (allocated(trouble)) return
      call sweep(suspension, case, path, kkt)
      call sweep_table(suspension, case, path, kkt, table)
      do k = 1, 2
         if (path%failure(k)%state > 0) call fail(trouble, exit_convergence, 'state at factor '// &
            str(path%value(path%failure(k)%state))//' was not found')
      end do
   end subroutine run_design

   !> All columns named by the study must be in the table.
   subroutine check_columns(study, table, error)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, size(study%columns)
         call check(trim(study%columns(k)), study%where//': columns')
      end do
      do k = 1, size(study%responses)
         associate (this => study%responses(k))
            call check(this%column, this%where//': response '//quoted(this%name))
            if (this%of == 'slope') call check(this%over, this%where//': response '//quoted(this%name))
         end associate
      end do
      if (len(text) > 0) call fail(error, exit_deck, text(:len(text) - 1))

   contains

      subroutine check(name, who)
         character(*), intent(in) :: name, who
         character(:), allocatable :: hint
         if (column_index(table, name) > 0) return
         hint = nearest_name(name, table%columns)
         if (len(hint) > 0) hint = ' (did you mean '//quoted(hint)//'?)'
         text = text//who//': the results have no column '//quoted(name)//hint//new_line('a')
      end subroutine check

   end subroutine check_columns

   !> Heads of both tables.
   subroutine start_tables(study, table, designs, curves, responses)
      type(study_t), intent(in) :: study
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
         heads(n + 1 + k) = study%responses(k)%name
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
      integer :: k, r, n

      n = size(values)
      do r = 1, size(table%values, 2)
         used = used + 1
         rows(1, used) = design
         rows(2:n + 1, used) = values
         rows(n + 2, used) = table%values(2, r)
         do k = 1, size(study%columns)
            rows(n + 2 + k, used) = table%values(column_index(table, trim(study%columns(k))), r)
         end do
      end do
   end subroutine take_curves

   !> Evaluates the responses of a design.
   subroutine take_responses(study, table, at, row)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      integer, intent(in) :: at                !! columns before the responses
      real(wp), intent(inout) :: row(:)
      integer :: k

      do k = 1, size(study%responses)
         row(at + k) = response_value(study%responses(k), table)
      end do
      row(size(row)) = minval(table%values(column_index(table, 'converged'), :))
   end subroutine take_responses

   !> A response of one table: the value at a factor (linear between states), the least-squares slope over a
   !> window there, or the span over all states.
   function response_value(response, table) result(value)
      type(response_t), intent(in) :: response
      type(table_t), intent(in) :: table
      real(wp) :: value, centre, mean_x, mean_y, spread
      real(wp) :: x(size(table%values, 2)), y(size(table%values, 2))
      logical :: is_near(size(table%values, 2))

      y = table%values(column_index(table, response%column), :)
      select case (response%of)
      case ('value')
         value = between(table%values(2, :), y, response%at)
      case ('slope')
         x = table%values(column_index(table, response%over), :)
         centre = between(table%values(2, :), x, response%at)
         is_near = abs(x - centre) <= response%window
         value = ieee_value(1.0_wp, ieee_quiet_nan)
         if (count(is_near) < 2) return
         mean_x = sum(x, mask=is_near)/count(is_near)
         mean_y = sum(y, mask=is_near)/count(is_near)
         spread = sum((x - mean_x)**2, mask=is_near)
         if (spread > 0.0_wp) value = sum((x - mean_x)*(y - mean_y), mask=is_near)/spread
      case default
         value = maxval(y) - minval(y)
      end select
   end function response_value

   !> y at x = at, linear between the rows; not a number outside them.
   pure real(wp) function between(x, y, at) result(value)
      real(wp), intent(in) :: x(:), y(:), at
      integer :: k

      value = ieee_value(1.0_wp, ieee_quiet_nan)
      do k = 1, size(x)
         if (abs(x(k) - at) <= 0.0_wp) then
            value = y(k)
            return
         end if
         if (k == size(x)) exit
         if ((x(k) - at)*(x(k + 1) - at) < 0.0_wp) then
            value = y(k) + (y(k + 1) - y(k))*(at - x(k))/(x(k + 1) - x(k))
            return
         end if
      end do
   end function between

end module ek_factor_sweep
