!> Responses and curves of a study at a design, with their derivatives with respect to the factors.
!>
!>     call begin_study_slopes(study, deck, designer, self, error)         once
!>     call find_study_slopes(values, self, is_valid)                      at each design
!>
!> The tables of the cases are moved along the derivatives of their columns, as in ek_wanted_values. A response is read from the
!> moved tables as from any other table. The derivative of the response is a difference quotient of these values. A derivative that
!> is only noise is 0.
module ek_study_slopes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck, exit_model
   use ek_text, only: quoted
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t
   use ek_table, only: column_index, name_length, scheduled_rows
   use ek_study, only: study_t
   use ek_case, only: copy_places
   use ek_response_value, only: reading_t, read_response, reads_all_states, is_difference
   use ek_workspace, only: workspace_t, put_numbers, solve_or_explain
   use ek_factor_numbers, only: factor_paths_t, put_factor
   use ek_designer, only: designer_t
   use ek_workspace_cases, only: open_workspace, case_number
   use ek_direction, only: direction_t, factor_direction
   use ek_derivatives, only: begin_derivatives, refuse_case
   use ek_defined_slopes, only: begin_defined
   use ek_case_slopes, only: case_slopes_t, solve_with_slopes, move_table
   use ek_stencil, only: stencils, differentiate
   use ek_noise, only: noise_of_slope
   implicit none(type, external)
   private
   public :: study_slopes_t, begin_study_slopes, find_study_slopes

   type :: study_slopes_t
      real(wp), allocatable :: values(:)                     !! values of the responses, then of the curves, column by column
      real(wp), allocatable :: slopes(:, :)                  !! (value, factor): derivatives per unit of the factor
      real(wp), allocatable :: noise(:, :)                   !! (value, factor): largest derivative that is only noise
      integer :: responses = 0                               !! number of responses, which precede the curves
      real(wp), allocatable :: sweep(:)                      !! swept values of the states of a curve
      character(name_length), allocatable, private :: heads(:)      !! column headings of the values
      integer, allocatable, private :: columns(:)            !! indices of the curves among the differentiated columns
      type(reading_t), allocatable, private :: readings(:)
      integer, allocatable, private :: case_of(:)            !! index in `cases` of the case of each response
      type(case_slopes_t), allocatable, private :: cases(:)
      type(direction_t), allocatable, private :: directions(:)
      type(factor_paths_t), allocatable, private :: paths(:)
      class(workspace_t), allocatable, private :: workspace
      type(definition_t), private :: definition              !! of the workspace, which points to it
   end type study_slopes_t

contains

   !> Solves the cases with the numbers of the deck and prepares their derivatives. Creates strings.
   subroutine begin_study_slopes(study, deck, designer, self, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer               !! designer of the study (new_designer)
      class(study_slopes_t), allocatable, target, intent(out) :: self
      type(error_t), allocatable, intent(out) :: error       !! exit_deck: factors or cases without derivatives; exit_model
      type(message_list_t) :: mistakes
      logical :: is_done
      integer :: c, f, k, r

      allocate (self)
      allocate (self%workspace)
      call open_workspace(deck, self%definition, self%workspace, error)
      if (allocated(error)) return
      self%readings = designer%readings
      self%case_of = designer%case_of
      self%paths = designer%paths
      allocate (self%directions(size(study%factors)))
      do f = 1, size(study%factors)
         if (size(self%paths(f)%found) == 0) then
            call mistakes%add(study%factors(f)%where//': factor '//quoted(study%factors(f)%name)// &
               ': its paths lead to an integer, a name or a switch, which has no derivative; use kind = ''monte_carlo''')
         else
            self%directions(f) = factor_direction(self%workspace%definition, study%factors(f)%name, self%paths(f))
         end if
      end do
      allocate (self%cases(size(designer%options)))
      do c = 1, size(self%cases)
         associate (this => self%cases(c), workspace => self%workspace)
            k = case_number(designer%case_names(c), workspace)
            this%case = k
            call refuse_case(workspace%cases(k)%case, error)
            if (allocated(error)) call mistakes%add(study%where//': '//error%message)
            if (allocated(error)) cycle
            if (designer%increments > 0) workspace%cases(k)%case%increments = designer%increments
            if (designer%increments > 0 .and. workspace%cases(k)%number > 0) &
               workspace%deck_cases(workspace%cases(k)%number)%increments = designer%increments
            this%options = designer%options(c)
            this%reads_all = c == 1 .and. size(study%columns) > 0
            do r = 1, size(self%readings)
               if (self%case_of(r) == c) this%reads_all = this%reads_all .or. reads_all_states(self%readings(r))
            end do
            call copy_places(designer%workspace%cases(c)%case, workspace%cases(k)%case)
         end associate
      end do
      if (mistakes%count() > 0) then
         if (allocated(error)) deallocate (error)
         call fail(error, exit_deck, mistakes%text())
         return
      end if
      do c = 1, size(self%cases)
         associate (this => self%cases(c), workspace => self%workspace)
            call solve_or_explain(this%case, this%options, workspace, is_done, error)
            if (.not. allocated(error) .and. .not. is_done) call fail(error, exit_model, deck%file//': its numbers give no model')
            if (allocated(error)) return
            allocate (this%derivatives)
            call begin_derivatives(workspace, this%case, this%options%columns, self%directions, this%derivatives)
            if (.not. allocated(this%options%defined)) cycle
            allocate (this%defined)
            call begin_defined(workspace, trim(study%definitions), this%options%defined%list%head, this%derivatives, this%list, &
               this%defined)
         end associate
      end do
      call place_curves(study, self)
   end subroutine begin_study_slopes

   !> Finds the columns of the curves among the differentiated columns, and the swept values of the states. Allocates the results.
   subroutine place_curves(study, self)
      type(study_t), intent(in) :: study
      type(study_slopes_t), intent(inout) :: self
      integer :: c

      associate (result => self%workspace%cases(self%cases(1)%case)%result, names => self%cases(1)%derivatives%columns)
         self%columns = [(findloc(names == study%columns(c), .true., dim=1), c=1, size(study%columns))]
         allocate (self%sweep(0))
         if (size(study%columns) > 0) self%sweep = pack(result%table%values(2, :), scheduled_rows(result%table))
      end associate
      self%responses = size(self%readings)
      allocate (self%values(self%responses + size(self%columns)*size(self%sweep)))
      allocate (self%slopes(size(self%values), size(self%directions)), self%noise(size(self%values), size(self%directions)))
      allocate (self%heads(size(self%values)))
      do c = 1, self%responses
         self%heads(c) = self%readings(c)%head
      end do
      do c = 1, size(self%columns)
         self%heads(self%responses + (c - 1)*size(self%sweep) + 1:self%responses + c*size(self%sweep)) = study%columns(c)
      end do
   end subroutine place_curves

   !> Computes values and derivatives at a design. No string is created. is_valid is .false. in these cases:
   !> - The design has a defect, or a number of the deck is outside its range or cannot be varied.
   !> - A state did not converge.
   !> - A response or its derivative has no value.
   subroutine find_study_slopes(values, self, is_valid)
      real(wp), intent(in) :: values(:)                      !! values of the factors
      type(study_slopes_t), intent(inout) :: self
      logical, intent(out) :: is_valid
      real(wp) :: y(self%responses, 4), errors(self%responses), x(size(self%workspace%x)), h
      integer :: c, f, k

      associate (parameters => self%workspace%definition%parameters)
         x = parameters%x(:parameters%used)
         do f = 1, size(values)
            call put_factor(self%paths(f), values(f), parameters, x)
         end do
      end associate
      call put_numbers(x, self%workspace)
      do c = 1, size(self%cases)
         call solve_with_slopes(.false., self%cases(c), self%workspace, is_valid)
         if (.not. is_valid) return
      end do
      call read_values(.false., self, self%values(:self%responses))
      do f = 1, size(self%directions)
         h = self%directions(f)%step
         do k = 1, 4
            do c = 1, size(self%cases)
               call move_table(f, stencils(1)%at(k)*h, self%cases(c))
            end do
            call read_values(.true., self, y(:, k))
         end do
         call differentiate(stencils(1), h, self%values(:self%responses), y, self%slopes(:self%responses, f), errors)
      end do
      call take_curves(self, is_valid)
      call remove_noise(self)
      do c = 1, size(self%cases)
         is_valid = is_valid .and. all(self%cases(c)%derivatives%can_move)
      end do
      is_valid = is_valid .and. all(ieee_is_finite(self%values(:self%responses)))
      if (is_valid) is_valid = all(ieee_is_finite(self%slopes(:self%responses, :)))
   end subroutine find_study_slopes

   !> Reads the responses from the tables of the design, or from the moved tables.
   subroutine read_values(is_moved, self, values)
      logical, intent(in) :: is_moved
      type(study_slopes_t), intent(in) :: self
      real(wp), intent(out) :: values(:)
      integer :: fault, k

      do k = 1, size(values)
         associate (this => self%cases(self%case_of(k)), less => self%readings(k)%asked%less)
            if (is_difference(self%readings(k))) then
               values(k) = values(less(1)) - values(less(2))
            else if (is_moved) then
               call read_response(self%readings(k), this%moved, values(k), fault)
            else
               call read_response(self%readings(k), this%table, values(k), fault)
            end if
         end associate
      end do
   end subroutine read_values

   !> Sets derivatives to 0 that are only noise. A difference of two responses has the noise of the larger of them.
   pure subroutine remove_noise(self)
      type(study_slopes_t), intent(inout) :: self
      real(wp) :: sizes(size(self%values))
      integer :: f, k

      sizes = abs(self%values)
      do k = 1, size(sizes)
         if (k <= self%responses) then
            if (is_difference(self%readings(k))) sizes(k) = max(sizes(k), maxval(sizes(self%readings(k)%asked%less)))
         end if
         do f = 1, size(self%directions)
            self%noise(k, f) = noise_of_slope(self%directions(f)%step, trim(self%heads(k)), sizes(k))
            if (.not. ieee_is_finite(self%slopes(k, f))) cycle
            if (abs(self%slopes(k, f)) <= self%noise(k, f)) self%slopes(k, f) = 0.0_wp
         end do
      end do
   end subroutine remove_noise

   !> Copies the values and derivatives of the curves, column by column.
   pure subroutine take_curves(self, is_valid)
      type(study_slopes_t), intent(inout) :: self
      logical, intent(inout) :: is_valid                     !! .false. if the case has other states here
      integer :: c, first, last
      integer, allocatable :: shown(:)                       ! states of the schedule

      if (size(self%columns) == 0) return
      associate (found => self%cases(1)%derivatives, states => size(self%sweep), &
         path => self%workspace%cases(self%cases(1)%case)%result%path)
         shown = pack([(c, c=1, size(found%states))], path%is_scheduled(found%states))
         is_valid = is_valid .and. size(shown) == states
         if (.not. is_valid) return
         do c = 1, size(self%columns)
            first = self%responses + (c - 1)*states + 1
            last = first + states - 1
            self%values(first:last) = found%values(self%columns(c), shown)
            self%slopes(first:last, :) = transpose(found%slopes(self%columns(c), :, shown))
         end do
      end associate
   end subroutine take_curves

end module ek_study_slopes
