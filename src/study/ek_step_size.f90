!> Step-size convergence: error and time of each method as a function of the number of increments.
!>
!> For every number N of increments, the case is run from design to one of its ends in N increments. Two kinds of errors are
!> reported. |Φ| is the violation of the joint constraints, equation (31) of the paper by Kang. The deviations from the equilibrium
!> are reported in addition, because |Φ| does not contain them.
module ek_step_size
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, degree, millimetre
   use ek_error, only: error_t, fail, exit_deck, exit_convergence
   use ek_text, only: quoted
   use ek_clock, only: seconds
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t
   use ek_suspension, only: suspension_t
   use ek_schedule, only: new_schedule, inputs_at
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_kkt, only: kkt_t, new_kkt, assemble, residual_only
   use ek_path, only: path_t, new_path, walk
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_table, only: new_table, csv_head, csv_row
   use ek_writer, only: writer_t
   use ek_study, only: study_t
   use ek_workspace, only: workspace_t, mount_numbers
   use ek_workspace_cases, only: open_cases
   implicit none(type, external)
   private
   public :: step_size_text

   character(*), parameter :: columns(10) = [character(20) :: 'increments', 'constraint_error', 'travel_error_mm', &
      'toe_error_deg', 'camber_error_deg', 'seconds', 'wheel_travel_mm', 'toe_deg', 'camber_deg', 'reached']
   integer, parameter :: repeats = 5     !! number of timed runs; the shortest time is used

contains

   !> Writes the study as CSV: column `method`, then the columns named in `columns`, with one row for each method and N. If a method
   !> does not reach the end with N increments, the numbers of the row are NaN and `reached` is 0. Each row is also passed to
   !> `writer` as soon as the row is available.
   subroutine step_size_text(study, deck, text, error, writer)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error
      type(writer_t), intent(inout), optional :: writer
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(attitude_t) :: exact, found
      real(wp) :: closure, time, row(size(columns))
      logical :: is_reached, is_done
      integer :: m, k

      allocate (workspace)
      call open_cases(deck, [study%case], definition, workspace, error)
      if (allocated(error)) return
      call mount_numbers(1, workspace%cases(1)%case%tolerance, workspace, is_done)      ! done: the design was examined
      associate (mounted => workspace%cases(1)%result)
         suspension = mounted%suspension
         case = mounted%case
      end associate
      kkt = new_kkt(suspension)
      if (size(suspension%wheels) == 0) then
         call fail(error, exit_deck, deck%file//': a step-size study needs a wheel, but the deck has none')
         return
      end if
      if (study%end == 'from') case%to = case%from
      if (.not. abs(case%to) > 0.0_wp) then
         call fail(error, exit_deck, deck%file//': case '//quoted(case%name)//' has no range towards end = '// &
            quoted(study%end)//'; set end = '//quoted(trim(merge('from', 'to  ', study%end == 'to'))))
         return
      end if
      case%from = 0.0_wp
      case%method = 'equilibrium'
      case%tolerance = 1.0e-13_wp      ! m; the reference is a thousand times more accurate than any result
      case%increments = 100
      call walk_once(suspension, case, kkt, exact, closure, time, is_reached)
      if (.not. is_reached) then
         call fail(error, exit_convergence, deck%file//': case '//quoted(case%name)//': no equilibrium at the end of the range')
         return
      end if
      case%tolerance = 1.0e-10_wp      ! m, the default of a deck

      text = ''
      call put('method,'//csv_head(new_table(columns, 0)))
      do m = 1, size(study%methods)
         case%method = trim(study%methods(m))
         do k = 1, size(study%increments)
            case%increments = study%increments(k)
            call walk_once(suspension, case, kkt, found, closure, time, is_reached)
            row = ieee_value(1.0_wp, ieee_quiet_nan)
            row(1) = case%increments
            row(10) = merge(1, 0, is_reached)
            if (is_reached) row(2:9) = [closure, (found%centre(3) - exact%centre(3))/millimetre, (found%toe - exact%toe)/degree, &
               (found%camber - exact%camber)/degree, time, found%centre(3)/millimetre, found%toe/degree, found%camber/degree]
            call put(trim(study%methods(m))//','//csv_row(row, columns == 'increments' .or. columns == 'reached'))
         end do
      end do

   contains

      subroutine put(line)
         character(*), intent(in) :: line
         text = text//line
         if (.not. present(writer)) return
         call writer%add(line)
         call writer%flush()
      end subroutine put

   end subroutine step_size_text

   !> Runs a case to its end a few times. Returns the attitude of the first wheel and |Φ| at the end, and the shortest time of a run
   !> [s]. If the end is not reached, attitude and |Φ| are not computed.
   subroutine walk_once(suspension, case, kkt, attitude, closure, time, is_reached)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(kkt_t), intent(inout) :: kkt
      type(attitude_t), intent(out) :: attitude
      real(wp), intent(out) :: closure, time
      logical, intent(out) :: is_reached
      type(path_t) :: path
      type(state_t) :: state
      type(inputs_t) :: inputs
      real(wp) :: start
      integer :: k

      time = huge(time)
      closure = 0.0_wp
      do k = 1, repeats
         call new_path(suspension, case, path)
         start = seconds()
         call walk(suspension, case, path, kkt)
         time = min(time, seconds() - start)
      end do
      is_reached = path%is_reached(path%states)
      if (.not. is_reached) return
      state = design_state(suspension)
      call unpack_state(path%packed(:, path%states), state)
      attitude = wheel_attitude(suspension, state, 1)
      call inputs_at(new_schedule(suspension, case), case%to, inputs)
      call assemble(suspension, state, inputs, residual_only, kkt)
      closure = norm2(kkt%values)
   end subroutine walk_once

end module ek_step_size
