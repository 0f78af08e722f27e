!> The values of requested numbers of a design, and their derivatives with respect to factors, for `solve` and `fit`.
!>
!>     call begin_values(wanted, directions, workspace, self, error)          once; solves the cases that are needed
!>     call find_values(distances, workspace, self, is_valid)                 at each design: self%values, self%jacobian
!>
!> A factor is a direction of ek_direction. The design moves by a distance along each direction. The distances are measured from the
!> numbers that the workspace contains when begin_values is called.
!>
!> All numbers are differentiated in one way. ek_derivatives gives the derivative of every column at every state. The tables of the
!> cases are moved along these derivatives, by steps that need no solution, and the number is read from the moved tables in the
!> usual way. The difference quotient of the number is its derivative. So a fitted slope, a value where another column has a given
!> value, a maximum and any future number that is read from tables need no formula in this module.
module ek_wanted_values
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_model, exit_convergence
   use ek_text, only: quoted, str
   use ek_noise, only: is_flat
   use ek_table, only: name_length, column_index, add_stop
   use ek_case_result, only: add_remarks, failure_of
   use ek_case, only: add_place, add_window
   use ek_table_reading, only: usual_width
   use ek_key_number, only: nothing, add_stops, largest_of_all, is_slope, needs_all
   use ek_missing_number, only: missing_reason, missing_value
   use ek_number_reach, only: required_reach, lacks_state
   use ek_workspace, only: workspace_t, put_numbers, solve_or_explain
   use ek_direction, only: direction_t, move_along
   use ek_derivatives, only: begin_derivatives, refuse_case
   use ek_case_slopes, only: case_slopes_t, solve_with_slopes, move_table
   use ek_stencil, only: stencils, differentiate
   use ek_wanted_number, only: wanted_number_t, read_number
   implicit none(type, external)
   private
   public :: wanted_values_t, begin_values, find_values

   !> A case that must be solved for the requested values.
   type, extends(case_slopes_t) :: needed_t
      logical :: is_used = .false.                           !! a requested number is read from the case
   end type needed_t

   !> Requested numbers and their values at a design.
   type :: wanted_values_t
      type(wanted_number_t), allocatable :: wanted(:)
      type(direction_t), allocatable :: directions(:)
      real(wp), allocatable :: values(:)                     !! values of the numbers, in their units
      real(wp), allocatable :: jacobian(:, :)                !! (number, direction): derivatives per unit of the direction
      logical, allocatable :: can_move(:) !! whether each direction can be varied at this design
      integer :: sweeps = 0                                  !! number of designs that were solved
      logical, private :: is_fresh = .false.                 !! begin_values has solved the design at distance 0
      real(wp), allocatable, private :: start(:)             !! numbers of the deck at distance 0
      type(needed_t), allocatable, private :: needed(:)
   end type wanted_values_t

contains

   !> Solves the required cases with the current numbers of the workspace, and prepares their derivatives. Creates strings.
   subroutine begin_values(wanted, directions, workspace, self, error)
      type(wanted_number_t), intent(in) :: wanted(:)
      type(direction_t), intent(in) :: directions(:)
      type(workspace_t), intent(inout) :: workspace           !! its cases stop where the numbers are read
      class(wanted_values_t), allocatable, intent(out) :: self
      type(error_t), allocatable, intent(out) :: error       !! exit_usage, exit_model, exit_convergence: a number has no value
      type(message_list_t) :: mistakes
      integer :: n, j, code

      allocate (self)
      self%wanted = wanted
      self%directions = directions
      self%start = workspace%x
      allocate (self%needed(count_cases(wanted)))
      allocate (self%values(size(wanted)), self%jacobian(size(wanted), size(directions)))
      allocate (self%can_move(size(directions)), source=.true.)
      do n = 1, size(wanted)
         do j = 1, size(wanted(n)%cases)
            call add_need(wanted(n), j, self%needed)
            call find_width(j, self%needed, workspace, self%wanted(n))
            call stop_where_read(self%wanted(n), j, workspace)
         end do
      end do
      code = exit_model
      do n = 1, size(wanted)
         call settle(self%wanted(n), self%needed, workspace, error)
         if (.not. allocated(error)) cycle
         code = error%code
         call mistakes%add(quoted(wanted(n)%name)//': '//error%message)
         deallocate (error)
      end do
      if (mistakes%count() > 0) then
         call fail(error, code, mistakes%text())
         return
      end if
      call mark_used(self)
      self%sweeps = 1
      self%is_fresh = .true.
      do j = 1, size(self%needed)
         associate (this => self%needed(j))
            if (.not. this%is_used) cycle
            allocate (this%derivatives)
            call begin_derivatives(workspace, this%case, this%options%columns, directions, this%derivatives)
         end associate
      end do
   end subroutine begin_values

   !> Adds the columns and the reach that a requested number needs of a case to the list of needs.
   subroutine add_need(wanted, source, needed)
      type(wanted_number_t), intent(in) :: wanted
      integer, intent(in) :: source
      type(needed_t), intent(inout) :: needed(:)             !! list of needs; entries with case 0 are not yet in use
      integer :: j, wheel

      j = needed_number(wanted%cases(source), needed)
      if (j == 0) then
         j = needed_number(0, needed)
         needed(j)%case = wanted%cases(source)
         allocate (needed(j)%options%columns(0))
         needed(j)%options%reach = 0.0_wp
         needed(j)%required = 0.0_wp
      end if
      associate (options => needed(j)%options)
         options%reach = max(options%reach, wanted%reach(source))
         needed(j)%required = max(needed(j)%required, required_of(wanted, source))
         call add(wanted%column)
         call add(wanted%over)
         if (.not. allocated(wanted%key)) then
            if (wanted%over /= 'factor') call add_stop(trim(wanted%over), wanted%at, options%stops)
            return
         end if
         call add_stops(wanted%key%how, wanted%key%sources(source), options%stops)
         needed(j)%reads_all = needed(j)%reads_all .or. needs_all(wanted%key%how)
         do wheel = 1, 2
            call add(wanted%key%sources(source)%column(wheel))
            call add(wanted%key%sources(source)%over(wheel))
         end do
      end associate

   contains

      subroutine add(name)
         character(name_length), intent(in) :: name
         if (name == '' .or. any(needed(j)%options%columns == name)) return
         needed(j)%options%columns = [character(name_length) :: needed(j)%options%columns, name]
      end subroutine add

   end subroutine add_need

   !> Adds the swept values at which a requested number is read to the stops of its case.
   subroutine stop_where_read(wanted, source, workspace)
      type(wanted_number_t), intent(in) :: wanted
      integer, intent(in) :: source
      type(workspace_t), intent(inout) :: workspace

      associate (case => workspace%cases(wanted%cases(source))%case)
         if (.not. allocated(wanted%key)) then
            if (wanted%over == 'factor') call add_place(wanted%at, case)
            if (wanted%is_change) call add_place(0.0_wp, case)
         else if (is_slope(wanted%key%how)) then
            call add_window(0.0_wp, wanted%key%sources(source)%width, case)
         else
            call add_place(0.0_wp, case)
         end if
      end associate
   end subroutine stop_where_read

   !> Finds the half width in the swept value of the window of a slope over any column, from the case at the present numbers. The
   !> error of a case that cannot be solved is returned when the number is read.
   subroutine find_width(source, needed, workspace, wanted)
      integer, intent(in) :: source
      type(needed_t), intent(inout) :: needed(:)
      type(workspace_t), intent(inout) :: workspace
      type(wanted_number_t), intent(inout) :: wanted
      type(error_t), allocatable :: ignored
      logical :: is_done
      integer :: n

      if (.not. allocated(wanted%key)) return
      if (.not. is_slope(wanted%key%how)) return
      associate (this => wanted%key%sources(source))
         if (this%width > 0.0_wp) return
         this%width = this%half
         n = needed_number(wanted%cases(source), needed)
         call solve_or_explain(needed(n)%case, needed(n)%options, workspace, is_done, ignored)
         if (allocated(ignored) .or. .not. is_done) return
         associate (table => workspace%cases(needed(n)%case)%result%table)
            this%width = usual_width(table, column_index(table, trim(this%over(1))), 0.0_wp, this%half)
         end associate
      end associate
   end subroutine find_width

   !> The number of cases that the requested numbers need.
   pure integer function count_cases(wanted) result(many)
      type(wanted_number_t), intent(in) :: wanted(:)
      integer, allocatable :: cases(:)
      integer :: n, j

      allocate (cases(0))
      do n = 1, size(wanted)
         do j = 1, size(wanted(n)%cases)
            if (.not. any(cases == wanted(n)%cases(j))) cases = [cases, wanted(n)%cases(j)]
         end do
      end do
      many = size(cases)
   end function count_cases

   !> Index of a case in the list of needed cases; 0 if the case is not needed.
   pure integer function needed_number(case, needed) result(j)
      integer, intent(in) :: case
      type(needed_t), intent(in) :: needed(:)

      do j = 1, size(needed)
         if (needed(j)%case == case) return
      end do
      j = 0
   end function needed_number

   !> Finds and solves the case from which a number is read. A key number is read from the first test that has a value of the key
   !> number. A key number that is the largest of all tests is read from all tests.
   subroutine settle(wanted, needed, workspace, error)
      type(wanted_number_t), intent(inout) :: wanted
      type(needed_t), intent(inout) :: needed(:)
      type(workspace_t), intent(inout) :: workspace
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: value
      integer :: j, n

      value = nothing()
      do j = 1, size(wanted%cases)
         n = needed_number(wanted%cases(j), needed)
         if (allocated(error)) deallocate (error)
         call refuse_case(workspace%cases(wanted%cases(j))%case, error)
         if (allocated(error)) return                      ! a further test would give another number than that of the report
         call solve_first(needed(n), required_of(wanted, j), workspace, error)
         if (allocated(error)) then
            if (.not. allocated(wanted%key)) return
            ! the slope of another test, and a maximum of the other tests, are other numbers
            if ((is_slope(wanted%key%how) .or. wanted%key%how == largest_of_all) .and. error%code /= exit_model) return
            cycle
         end if
         wanted%case = wanted%cases(j)
         call read_number(wanted, j, needed(n)%table, value)
         if (wanted%column /= '') then
            ! an entry of the compliance matrix is no column of the table of the case
            if (.not. ieee_is_finite(value) .and. column_index(needed(n)%table, trim(wanted%column)) > 0) &
               call fail(error, exit_model, 'no value at '//trim(wanted%over)//' = '//str(wanted%at)//' in case '// &
               quoted(workspace%cases(wanted%case)%case%name)//': '//missing_value(needed(n)%table, trim(wanted%column), &
               trim(wanted%over), wanted%at))
            return
         end if
         if (is_slope(wanted%key%how) .and. .not. ieee_is_finite(value)) exit
         if (.not. ieee_is_finite(value)) cycle
         if (wanted%key%how == largest_of_all) cycle
         wanted%source = j
         return
      end do
      if (ieee_is_finite(value)) then
         if (allocated(error)) deallocate (error)
      else if (.not. allocated(error)) then
         call fail(error, exit_model, 'no value ('//wanted%key%condition//': '//missing_reason(wanted%key, wanted%wheel, 1, &
            needed(needed_number(wanted%cases(1), needed))%table)//')')
      end if
   end subroutine settle

   !> The swept value within which a requested number needs every state of a source.
   pure real(wp) function required_of(wanted, source) result(required)
      type(wanted_number_t), intent(in) :: wanted
      integer, intent(in) :: source

      required = wanted%reach(source)
      if (allocated(wanted%key)) required = required_reach(wanted%key%how, required)
   end function required_of

   !> Solves a case for the first time, unless the case was already solved. An error is returned if a state that the number needs
   !> did not converge.
   subroutine solve_first(this, reach, workspace, error)
      type(needed_t), intent(inout) :: this
      real(wp), intent(in) :: reach                          !! swept value within which no state may be missing
      type(workspace_t), intent(inout) :: workspace
      type(error_t), allocatable, intent(out) :: error
      logical :: is_done

      if (.not. allocated(this%table%columns)) then
         call solve_or_explain(this%case, this%options, workspace, is_done, error)
         if (.not. allocated(error) .and. .not. is_done) call fail(error, exit_model, 'its numbers give no model')
         if (allocated(error)) return
         if (workspace%cases(this%case)%result%is_run()) this%table = workspace%cases(this%case)%result%table
      end if
      associate (result => workspace%cases(this%case)%result)
         if (.not. lacks_state(result, reach)) return
         call add_remarks(this%options, result)
         call failure_of(result, error)
         if (.not. allocated(error)) call fail(error, exit_convergence, 'case '//quoted(result%case%name)// &
            ' lacks a state that it needs')
      end associate
   end subroutine solve_first

   !> Marks the cases from which a number is read. Other cases are not solved again.
   subroutine mark_used(self)
      type(wanted_values_t), intent(inout) :: self
      integer :: j, k, n

      do n = 1, size(self%wanted)
         do j = 1, size(self%wanted(n)%cases)
            if (self%wanted(n)%source > 0 .and. j /= self%wanted(n)%source) cycle
            k = needed_number(self%wanted(n)%cases(j), self%needed)
            self%needed(k)%is_used = self%needed(k)%is_used .or. allocated(self%needed(k)%table%columns)
         end do
      end do
   end subroutine mark_used

   !> Computes values and derivatives of a design. is_valid is .false. if a number has no value or no derivative. Reasons are a
   !> defect of the design, a number of the deck outside its range, or a required state that did not converge.
   subroutine find_values(distances, workspace, self, is_valid)
      real(wp), intent(in) :: distances(:)                   !! distances along the directions, in their units
      type(workspace_t), intent(inout) :: workspace
      type(wanted_values_t), intent(inout) :: self
      logical, intent(out) :: is_valid
      real(wp) :: x(size(self%start))
      integer :: j, p

      self%is_fresh = self%is_fresh .and. all(abs(distances) <= 0.0_wp)
      if (.not. self%is_fresh) then
         self%sweeps = self%sweeps + 1
         x = self%start
         do p = 1, size(distances)
            call move_along(self%directions(p), distances(p), x)
         end do
         call put_numbers(x, workspace)
      end if
      self%values = nothing()
      self%jacobian = nothing()
      do j = 1, size(self%needed)
         if (.not. self%needed(j)%is_used) cycle
         call solve_with_slopes(self%is_fresh, self%needed(j)%case_slopes_t, workspace, is_valid)
         if (.not. is_valid) return
      end do
      self%is_fresh = .false.
      self%can_move = .true.
      do j = 1, size(self%needed)
         if (self%needed(j)%is_used) self%can_move = self%can_move .and. self%needed(j)%derivatives%can_move
      end do
      call read_values(self, .false., self%values)
      is_valid = all(ieee_is_finite(self%values))
      if (is_valid) call differentiate_values(self)
      if (is_valid) is_valid = all(ieee_is_finite(self%jacobian))
   end subroutine find_values

   !> Reads all numbers from the tables of the cases, or from the moved tables.
   subroutine read_values(self, is_moved, values)
      type(wanted_values_t), intent(in) :: self
      logical, intent(in) :: is_moved                        !! whether the moved tables are read
      real(wp), intent(out) :: values(:)
      integer :: j, k, n

      values = nothing()
      do n = 1, size(self%wanted)
         do j = 1, size(self%wanted(n)%cases)
            if (self%wanted(n)%source > 0 .and. j /= self%wanted(n)%source) cycle
            k = needed_number(self%wanted(n)%cases(j), self%needed)
            if (.not. self%needed(k)%is_used) cycle
            if (is_moved) then
               call read_number(self%wanted(n), j, self%needed(k)%moved, values(n))
            else
               call read_number(self%wanted(n), j, self%needed(k)%table, values(n))
            end if
         end do
      end do
   end subroutine read_values

   !> Computes the Jacobian: all numbers are read from the tables moved along each direction. A number of the deck that cannot be
   !> varied has the derivative 0, as has a derivative that is only rounding noise: such a number cannot move the requested number.
   !> Equation (E.3) of docs/theory/derivatives.md.
   subroutine differentiate_values(self)
      type(wanted_values_t), intent(inout) :: self
      real(wp) :: y(size(self%wanted), 4), errors(size(self%wanted)), h
      integer :: j, k, n, p

      do p = 1, size(self%directions)
         h = self%directions(p)%step
         do k = 1, 4
            do j = 1, size(self%needed)
               if (self%needed(j)%is_used) call move_table(p, stencils(1)%at(k)*h, self%needed(j)%case_slopes_t)
            end do
            call read_values(self, .true., y(:, k))
         end do
         call differentiate(stencils(1), h, self%values, y, self%jacobian(:, p), errors)
         do n = 1, size(self%wanted)
            if (is_flat(self%jacobian(n, p), h, self%wanted(n)%heading, self%values(n))) self%jacobian(n, p) = 0.0_wp
         end do
      end do
   end subroutine differentiate_values

end module ek_wanted_values
