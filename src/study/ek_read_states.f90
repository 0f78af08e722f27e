!> The states of a case at which a study reads K&C quantities. The quantities require the compliance matrix, which costs more than
!> the state itself, and a response often reads a single state.
!>
!> | response | states that the response reads |
!> |---|---|
!> | value | the state at `at` |
!> | slope, gradient | the five states of the window |
!> | rms | the state at each point of the given curve |
!> | span, min, max; columns of the curves | all |
!> | difference | the states of its two responses |
module ek_read_states
   use ek_table, only: table_t, column_index
   use ek_sweep_table, only: observer_t, observe_kandc_at, is_kandc_column, reads_matrix
   use ek_defined_table, only: fill_defined
   use ek_case_result, only: case_result_t, solve_options_t
   use ek_response_value, only: reading_t, mark_states, reads_all_states, is_difference, is_slope, place_of_column
   implicit none(type, external)
   private
   public :: reads_few_states, observe_read_states

contains

   !> Whether a case needs the compliance matrix, and no response or curve reads a K&C quantity at all states.
   pure logical function reads_few_states(readings, case_of, case, columns, options, observer, table)
      type(reading_t), intent(in) :: readings(:)           !! readings of all cases
      integer, intent(in) :: case_of(:), case              !! index of the case of each reading; index of this case
      character(*), intent(in) :: columns(:)               !! columns of the curves of this case, read at every state
      type(solve_options_t), intent(in) :: options         !! options of this case
      type(observer_t), intent(in) :: observer             !! observer of this case
      type(table_t), intent(in) :: table                   !! table of this case, in the design of the deck
      integer :: j

      reads_few_states = reads_matrix(observer)
      do j = 1, size(columns)
         if (needs_kandc(observer, options, column_index(table, trim(columns(j))))) reads_few_states = .false.
      end do
      do j = 1, size(readings)
         if (case_of(j) /= case .or. is_difference(readings(j))) cycle
         if (reads_all_states(readings(j)) .and. needs_kandc(observer, options, readings(j)%at_column)) reads_few_states = .false.
      end do
   end function reads_few_states

   !> Whether a column of the table is a K&C quantity, or a column of another program that follows from one.
   pure logical function needs_kandc(observer, options, column)
      type(observer_t), intent(in) :: observer
      type(solve_options_t), intent(in) :: options
      integer, intent(in) :: column                        !! index in the table; 0: none
      integer :: k, n, v

      n = size(observer%columns)
      needs_kandc = .false.
      if (column <= n) then
         needs_kandc = is_kandc_column(observer, column)
      else if (allocated(options%defined)) then
         associate (sources => options%defined%list(column - n)%sources)
            do v = 1, size(sources)
               do k = 1, size(sources(v)%columns)
                  needs_kandc = needs_kandc .or. is_kandc_column(observer, sources(v)%columns(k))
               end do
            end do
         end associate
      end if
   end function needs_kandc

   !> Observes the K&C quantities of a case at the states where a response reads a K&C quantity.
   subroutine observe_read_states(readings, case_of, case, options, observer, result)
      type(reading_t), intent(in) :: readings(:)           !! readings of all cases
      integer, intent(in) :: case_of(:), case              !! index of the case of each reading; index of this case
      type(solve_options_t), intent(in) :: options         !! options of this case
      type(observer_t), intent(inout) :: observer          !! observer of this case
      type(case_result_t), intent(inout) :: result         !! solved with defers_kandc
      logical :: is_read(size(result%table%values, 2))
      integer :: column, over, j

      is_read = .false.
      do j = 1, size(readings)
         if (case_of(j) /= case .or. is_difference(readings(j))) cycle
         column = place_of_column(result%table, readings(j)%asked%column, readings(j)%at_column)
         over = 0
         if (is_slope(readings(j))) over = place_of_column(result%table, readings(j)%over, readings(j)%at_over)
         if (column == 0) cycle                            ! the model of this design does not define it
         if (needs_kandc(observer, options, column) .or. needs_kandc(observer, options, over)) &
            call mark_states(readings(j), result%table, is_read)
      end do
      call observe_kandc_at(is_read, result%suspension, result%case, result%path, result%kkt, observer, result%table)
      if (allocated(options%defined)) call fill_defined(result%suspension, options%defined, result%table)
   end subroutine observe_read_states

end module ek_read_states
