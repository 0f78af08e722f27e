!> The files of a fit: its factors, its points, settings for --set-file, and the script and pictures of a figure of start, target
!> and result.
module ek_fit_files
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_decimal, only: decimal
   use ek_frame, only: frame_t, new_frame
   use ek_buffer, only: buffer_t
   use ek_kinds, only: wp
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_version, only: version
   use ek_workspace, only: workspace_t
   use ek_figure, only: figure_t, new_figure, add_series, columns_of, as_line, as_points, as_segments
   use ek_figure_script, only: figure_script
   use ek_gnuplot, only: on_level, on_range, on_limits, on_design, on_derivative
   use ek_parameter, only: choice_t, parameter_path
   use ek_study, only: is_given
   use ek_noise, only: is_noise, solved
   use ek_fit, only: fit_t
   use ek_fit_problem, only: fit_problem_t
   use ek_fit_solver, only: fit_result_t, difference_of
   use ek_fit_statistics, only: fit_statistics_t
   use ek_outbox, only: outbox_t, outbox_in
   implicit none(type, external)
   private
   public :: write_fit_files, changed_numbers, note_of, fit_figure, target_rms_t, rms_of_target

   integer, parameter :: most_panels = 12
   character(6), parameter :: of_words(0:2) = [character(6) :: 'value', 'slope', 'change']
   character(*), parameter :: held_words(-1:1) = [character(5) :: 'lower', '', 'upper']

   !> The differences of a target from its points at the start and of the result.
   type :: target_rms_t
      integer :: points = 0, beyond = 0        !! number of points; of these, points at which a limit is exceeded
      real(wp) :: before = 0.0_wp, after = 0.0_wp      !! root mean square of the differences
      integer :: first = 0                     !! index of the first point; 0: the target has no points
   end type target_rms_t

contains

   !> The root mean squares of the differences of a target, in the unit of its quantity.
   type(target_rms_t) function rms_of_target(problem, found, target) result(rms)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      integer, intent(in) :: target
      integer :: k

      do k = 1, size(problem%points)
         associate (point => problem%points(k))
            if (point%target /= target) cycle
            rms%before = rms%before + (difference_of(point, found%before(k))*point%deviation)**2
            rms%after = rms%after + (difference_of(point, found%after(k))*point%deviation)**2
            rms%points = rms%points + 1
            if (rms%first == 0) rms%first = k
            if (.not. is_given(point%value) .and. .not. is_noise(difference_of(point, found%after(k))*point%deviation, &
               problem%wanted(k)%heading, found%after(k), solved)) rms%beyond = rms%beyond + 1
         end associate
      end do
      rms%before = sqrt(rms%before/max(1, rms%points))
      rms%after = sqrt(rms%after/max(1, rms%points))
   end function rms_of_target

   !> Writes all files and prints their paths. Of the pictures, only the path of the PNG file is printed.
   subroutine write_fit_files(fit, workspace, problem, found, statistics, out, draws, is_quiet, page, error)
      type(fit_t), intent(in) :: fit
      type(workspace_t), intent(in) :: workspace          !! workspace with the numbers found
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      character(*), intent(in) :: out                      !! folder
      logical, intent(in) :: draws                         !! whether gnuplot is run
      logical, intent(in) :: is_quiet
      character(*), intent(in) :: page                     !! page as HTML; '': no page
      type(error_t), allocatable, intent(out) :: error
      type(outbox_t) :: box
      character(:), allocatable :: reason

      box = outbox_in(out)
      call box%put(fit%name//'_factors.csv', factors_csv(problem, found, statistics))
      call box%put(fit%name//'_points.csv', points_csv(fit, workspace, problem, found))
      call box%put(fit%name//'.set', settings(fit, workspace, problem))
      if (page /= '') call box%put(fit%name//'.html', page)
      call box%add_script(fit%name, figure_script(fit_figure(fit, workspace, problem, found)))
      if (.not. allocated(box%undrawn)) call box%announce(fit%name//'.gp')
      if (draws) then
         call box%draw(is_quiet, reason)
         if (reason == '') call box%announce(fit%name//'.png')
      end if
      call box%finish(error)
   end subroutine write_fit_files

   !> The table of factors as CSV, one row per factor.
   function factors_csv(problem, found, statistics) result(text)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      character(:), allocatable :: text
      type(frame_t) :: frame
      integer :: f

      frame = new_frame('factor,unit,start,result,lower,upper,bound,half_of_95_percent,low_95,high_95,half_by_targets_alone,'// &
         'learned,note')
      do f = 1, size(problem%variables)
         associate (this => problem%variables(f))
            call frame%put(this%name)
            call frame%put(this%direction%unit)
            call frame%put_known([this%start, found%x(f), this%lower, this%upper])
            call frame%put(trim(held_words(found%held(f))))
            call frame%put_known([statistics%half(f), statistics%low(f), statistics%high(f), statistics%half_alone(f)])
            call frame%put(merge(1, 0, statistics%is_learned(f)))
            call frame%put(note_of(problem, found, statistics, f))
         end associate
      end do
      text = frame%csv()
   end function factors_csv

   !> A note on the value or the interval of a factor; '' if there is nothing to note.
   function note_of(problem, found, statistics, f) result(note)
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(fit_statistics_t), intent(in) :: statistics
      integer, intent(in) :: f
      character(:), allocatable :: note

      note = ''
      if (.not. statistics%has_effect(f)) then
         note = 'no effect on the targets: keeps its value'
         if (is_given(problem%variables(f)%deviation)) note = 'no effect on the targets: has the value of its prior'
      else if (found%is_kept(f)) then
         note = 'not determined: keeps its value'
      else if (statistics%is_held_by_bound(f)) then
         note = 'the '//trim(held_words(found%held(f)))//' bound holds it'
      else if (.not. statistics%knows_sigma) then
         note = 'interval unknown: not more numbers than factors'
      else if (found%held(f) /= 0) then
         note = 'interval cut at the '//trim(held_words(found%held(f)))//' bound'
      end if
   end function note_of

   !> The table of points as CSV, one row per point: target, case, quantity, abscissa, wanted value, limits, value at the start,
   !> value of the result, deviation, and difference.
   function points_csv(fit, workspace, problem, found) result(text)
      type(fit_t), intent(in) :: fit
      type(workspace_t), intent(in) :: workspace
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      character(:), allocatable :: text
      type(frame_t) :: frame
      character(:), allocatable :: case
      integer :: k

      frame = new_frame('target,case,quantity,over,at,wanted,low,high,start,result,deviation,difference,of')
      do k = 1, size(problem%points)
         associate (point => problem%points(k), wanted => problem%wanted(k), target => fit%targets(problem%points(k)%target))
            case = ''
            if (wanted%case > 0) case = workspace%cases(wanted%case)%case%name
            call frame%put(target%name)
            call frame%put(case)
            call frame%put(wanted%name)
            call frame%put(trim(wanted%over))
            call frame%put_known([wanted%at, point%value, point%low, point%high, found%before(k), found%after(k), point%deviation, &
               difference_of(point, found%after(k))])
            call frame%put(trim(of_words(merge(1, merge(2, 0, target%is_change), target%is_slope))))
         end associate
      end do
      text = frame%csv()
   end function points_csv

   !> Lists all numbers that the factors change.
   subroutine changed_numbers(problem, changed)
      type(fit_problem_t), intent(in) :: problem
      type(choice_t), allocatable, intent(out) :: changed(:)
      integer :: f

      allocate (changed(0))
      do f = 1, size(problem%variables)
         changed = [changed, problem%variables(f)%direction%found]
      end do
   end subroutine changed_numbers

   !> The fitted numbers as settings, one per line (--set-file).
   function settings(fit, workspace, problem) result(text)
      type(fit_t), intent(in) :: fit
      type(workspace_t), intent(in) :: workspace
      type(fit_problem_t), intent(in) :: problem
      character(:), allocatable :: text
      type(buffer_t) :: list
      type(choice_t), allocatable :: changed(:)
      logical, allocatable :: is_tied(:)
      integer :: j

      call changed_numbers(problem, changed)
      call list%line('# elastokin '//version//' fit '//fit%name//': numbers of '//workspace%raw%name//' for --set-file')
      associate (numbers => workspace%definition%parameters)
         ! a number of both sides has the path of the half deck, if both sides changed
         allocate (is_tied(numbers%used), source=.false.)
         do j = 1, size(changed)
            is_tied(changed(j)%number) = any(numbers%list(changed%number)%tied == changed(j)%number)
         end do
         do j = 1, size(changed)
            associate (this => numbers%list(changed(j)%number))
               if (any(changed(:j - 1)%number == changed(j)%number)) cycle
               if (this%tied > 0) then
                  if (is_tied(this%tied)) cycle
               end if
               call list%line(path_of(changed(j)%number, is_tied(changed(j)%number))//' = '// &
                  decimal(workspace%x(changed(j)%number)/this%unit))
            end associate
         end do
      end associate
      text = list%text()

   contains

      !> The path of a number of the design.
      function path_of(number, is_of_pair) result(path)
         integer, intent(in) :: number
         logical, intent(in) :: is_of_pair
         character(:), allocatable :: path
         path = parameter_path(workspace%definition%parameters%list(number), workspace%definition%records, is_of_pair)
      end function path_of

   end function settings

   !> The figure: a panel for each of the first 12 curves with start, target and result. Without curves, one panel shows the
   !> differences of all points.
   function fit_figure(fit, workspace, problem, found) result(figure)
      type(fit_t), intent(in) :: fit
      type(workspace_t), intent(in) :: workspace
      type(fit_problem_t), intent(in) :: problem
      type(fit_result_t), intent(in) :: found
      type(figure_t) :: figure
      character(:), allocatable :: title
      integer, allocatable :: curves(:), points(:)
      integer :: k, p, t

      curves = pack([(t, t=1, size(fit%targets))], [(count(problem%points%target == t) > 1, t=1, size(fit%targets))])
      curves = curves(:min(size(curves), most_panels))
      title = fit%name
      if (fit%title /= '') title = title//': '//fit%title
      figure = new_figure(fit%name, 'Fit: start, target and result', title, size(curves))
      if (size(curves) == 0) then
         call add_differences()
         return
      end if
      do p = 1, size(curves)
         points = pack([(k, k=1, size(problem%points))], problem%points%target == curves(p))
         associate (panel => figure%panels(p), at => problem%wanted(points)%at)
            panel%title = fit%targets(curves(p))%name
            panel%x%label = abscissa(points(1))
            panel%y%label = problem%wanted(points(1))%name
            panel%note = 'no point has a value'
            call add_series(panel, as_line, on_range, columns_of(at, found%before(points)), is_dashed=.true., title='start')
            if (any(is_given(problem%points(points)%low))) call add_series(panel, as_line, on_limits, &
               columns_of(at, known(problem%points(points)%low)), weight=1.0_wp, title='low')
            if (any(is_given(problem%points(points)%high))) call add_series(panel, as_line, on_limits, &
               columns_of(at, known(problem%points(points)%high)), weight=1.0_wp, title='high')
            call add_series(panel, as_points, on_design, columns_of(at, known(problem%points(points)%value)), weight=0.7_wp, &
               title='target')
            call add_series(panel, as_line, on_derivative, columns_of(at, found%after(points)), title='result')
         end associate
      end do

   contains

      !> Adds the differences of the points from their targets, in deviations, as strokes.
      subroutine add_differences()
         real(wp) :: strokes(4, size(problem%points))
         integer :: k

         associate (panel => figure%panels(1))
            panel%y%label = 'difference in deviations'
            panel%x%has_range = .true.
            panel%x%range = [0.5_wp, size(problem%points) + 0.5_wp]
            do k = 1, size(problem%points)
               strokes(:, k) = [1.0_wp*k, 0.0_wp, 0.0_wp, difference_of(problem%points(k), found%after(k))]
               call panel%x%names%add(fit%targets(problem%points(k)%target)%name)
            end do
            call add_series(panel, as_segments, on_level, strokes, weight=4.0_wp)
         end associate
      end subroutine add_differences

      !> A value that is given, otherwise NaN.
      elemental real(wp) function known(value)
         real(wp), intent(in) :: value

         known = value
         if (.not. is_given(value)) known = ieee_value(1.0_wp, ieee_quiet_nan)
      end function known

      !> Label of the abscissa of a point: the case and 'swept value', or the column over which the curve is given.
      function abscissa(t) result(label)
         integer, intent(in) :: t
         character(:), allocatable :: label

         label = trim(problem%wanted(t)%over)
         if (label /= 'factor' .or. problem%wanted(t)%case == 0) return
         associate (case => workspace%cases(problem%wanted(t)%case)%case)
            label = case%name//', swept value'
         end associate
      end function abscissa

   end function fit_figure

end module ek_fit_files
