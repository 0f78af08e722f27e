!> elastokin report: deck → tests → gradients, charts, picture → one page and its files.
module ek_report
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_units, only: millimetre
   use ek_text, only: str, quoted, plural
   use ek_version, only: version
   use ek_file, only: make_folder, write_whole, join_path, remove_file
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, default_tolerance
   use ek_balance, only: balance
   use ek_state, only: state_t, design_state, unpack_state
   use ek_path, only: path_t
   use ek_csv, only: write_csv
   use ek_test_result, only: test_result_t
   use ek_test_charts, only: test_charts
   use ek_chart, only: charts_script, chart_t
   use ek_gnuplot, only: run_gnuplot, script_name_t
   use ek_gradient, only: gradient_t, test_gradients
   use ek_gradient_window, only: windows_t, set_window
   use ek_gradient_file, only: write_gradients
   use ek_scene, only: scene_t, line_bump, line_rebound
   use ek_scene_script, only: camera_t, fit_camera, scene_script, animation_script
   use ek_picture, only: add_solid, add_ghost, add_ground, add_names
   use ek_arguments, only: arguments_t
   use ek_load_deck, only: load_deck, chosen_cases
   use ek_report_tests, only: planned_test_t, report_cases, planned_tests, run_planned
   use ek_report_files, only: write_contents, contents_file, gradients_file
   use ek_report_page, only: chart_set_t, report_page
   use ek_run_words, only: say_preloads, patch_words, spring_words
   use ek_words, only: say, warn, complain
   implicit none(type, external)
   private
   public :: report, chosen_windows

   integer, parameter :: most_frames = 40        !! of an animation

   !> The states of a test, for pictures.
   type :: film_t
      type(path_t) :: path
      logical :: is_there = .false.
   end type film_t

contains

   !> Runs the tests of a deck and writes everything. A test that fails part way is written as far as it came; the error
   !> at the end then has code exit_convergence.
   subroutine report(arguments, error)
      type(arguments_t), intent(in) :: arguments
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:), all_cases(:), chosen(:)
      type(planned_test_t), allocatable :: planned(:)
      type(test_result_t), allocatable :: tests(:)
      type(film_t), allocatable :: films(:)
      type(gradient_t), allocatable :: gradients(:)
      type(chart_set_t), allocatable :: sets(:)
      type(windows_t) :: windows
      type(message_list_t) :: warnings
      type(error_t), allocatable :: trouble, undrawn
      character(:), allocatable :: checksum, folder, message
      integer :: k, failed, code

      call chosen_windows(arguments, windows, error)
      if (allocated(error)) return
      call load_deck(arguments, suspension, cases, checksum, error)
      if (allocated(error)) return
      call report_cases(suspension, cases, all_cases)
      call chosen_cases(arguments, all_cases, chosen, error)
      if (allocated(error)) return
      folder = arguments%out
      if (len(folder) == 0) folder = 'out'
      call make_folder(join_path(folder, 'figures'), error)
      if (allocated(error)) return
      call balance(suspension, default_tolerance, error)
      if (allocated(error)) return
      call say_preloads(arguments, suspension)
      call planned_tests(suspension, chosen, planned)
      call patch_words(suspension, warnings)
      call spring_words(suspension, planned%case, warnings)
      do k = 1, warnings%count()
         call warn(warnings%line(k))
      end do
      call remove_file(join_path(folder, 'report.html'))     ! of an earlier report: it must not be taken for this one
      call remove_file(join_path(folder, contents_file))

      allocate (tests(size(planned)), films(size(planned)), sets(size(planned)), gradients(0))
      failed = 0
      code = exit_convergence
      do k = 1, size(planned)
         call run_planned(suspension, planned(k), checksum, tests(k), films(k)%path, trouble)
         if (allocated(trouble)) then
            call complain(trouble%message)
            failed = failed + 1
            if (trouble%code /= exit_convergence) code = trouble%code     ! it was not run at all
            call warnings%add(planned(k)%title//': '//trouble%message)
         end if
         allocate (sets(k)%charts(0))
         if (.not. tests(k)%is_run) cycle
         films(k)%is_there = .true.
         call write_csv(tests(k)%table, join_path(folder, tests(k)%file), error)
         if (allocated(error)) return
         write (output_unit, '(a)') join_path(folder, tests(k)%file)
         call test_gradients(tests(k), windows, gradients)
         call test_charts(tests(k), sets(k)%charts)
      end do
      call write_gradients(gradients, suspension%name, checksum, join_path(folder, gradients_file), &
         join_path(folder, 'gradients.json'), error)
      if (allocated(error)) return
      write (output_unit, '(a)') join_path(folder, gradients_file)
      write (output_unit, '(a)') join_path(folder, 'gradients.json')

      call write_contents(tests, join_path(folder, contents_file), error)
      if (allocated(error)) return

      message = ''
      call draw(arguments, suspension, tests, films, sets, folder, message, undrawn)
      if (allocated(undrawn)) then
         call complain(undrawn%message)
         call warnings%add('The page lacks pictures: '//undrawn%message)
      else if (len(message) > 0) then
         if (.not. arguments%no_plots) call say(arguments%quiet, message)
         call warnings%add('The page has no pictures: '//message)
      end if
      call write_page(arguments, suspension, checksum, tests, sets, gradients, warnings, folder, error)
      if (allocated(error)) return
      write (output_unit, '(a)') join_path(folder, 'report.html')
      if (failed > 0) then
         call fail(error, code, plural(failed, 'test', 'tests')//' of '//str(size(tests))// &
            ' ended early; all states before are written, and the page tells where')
      else if (allocated(undrawn)) then
         call fail(error, undrawn%code, 'the report is written, but not all of its pictures')
      end if
   end subroutine report

   !> Windows of the gradients with --window applied.
   subroutine chosen_windows(arguments, windows, error)
      type(arguments_t), intent(in) :: arguments
      type(windows_t), intent(out) :: windows
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: half
      integer :: k, equals, status
      logical :: is_known

      do k = 1, size(arguments%windows)
         associate (text => arguments%windows(k)%text)
            equals = index(text, '=')
            status = 1
            half = 0.0_wp
            if (equals > 1 .and. verify(text(equals + 1:), '0123456789.') == 0 .and. equals < len(text)) &
               read (text(equals + 1:), *, iostat=status) half
            if (status /= 0 .or. .not. half > 0.0_wp) then
               call fail(error, exit_usage, '--window: expected what=half width with a positive number, as in travel=15, '// &
                  'found '//quoted(text))
               return
            end if
            call set_window(windows, text(:equals - 1), half, is_known)
            if (.not. is_known) then
               call fail(error, exit_usage, '--window: expected travel, roll, force, torque, rack or wheel, found '// &
                  quoted(text(:equals - 1)))
               return
            end if
         end associate
      end do
   end subroutine chosen_windows

   !> All pictures, by one run of gnuplot.
   subroutine draw(arguments, suspension, tests, films, sets, folder, message, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: tests(:)
      type(film_t), intent(in) :: films(:)
      type(chart_set_t), intent(in) :: sets(:)
      character(*), intent(in) :: folder
      character(:), allocatable, intent(inout) :: message    !! why there are none
      type(error_t), allocatable, intent(out) :: error
      type(script_name_t), allocatable :: scripts(:)
      type(camera_t) :: camera
      type(chart_t), allocatable :: charts(:)
      integer :: k, n

      ! pictures of an earlier report must not slip into this page
      call remove_file(join_path(folder, 'picture.svg'))
      call remove_file(join_path(folder, 'picture.png'))
      call remove_file(join_path(folder, 'animation.gif'))
      do k = 1, size(sets)
         do n = 1, size(sets(k)%charts)
            call remove_file(join_path(folder, 'figures/'//sets(k)%charts(n)%name//'.svg'))
         end do
      end do
      if (arguments%no_plots) then
         message = 'none were asked for (--no-plots)'
         return
      end if
      n = 0
      do k = 1, size(sets)
         n = n + size(sets(k)%charts)
      end do
      allocate (charts(n))
      n = 0
      do k = 1, size(sets)
         charts(n + 1:n + size(sets(k)%charts)) = sets(k)%charts
         n = n + size(sets(k)%charts)
      end do
      call write_whole(join_path(folder, 'figures/charts.gp'), charts_script(charts), error)
      if (allocated(error)) return
      call write_picture(suspension, tests, films, folder, camera, error)
      if (allocated(error)) return
      n = 2
      if (arguments%animate) then
         call write_animation(suspension, tests, films, folder, camera, error)
         if (allocated(error)) return
         n = 3
      end if
      allocate (scripts(n))
      scripts(1)%text = 'charts.gp'
      scripts(2)%text = 'picture.gp'
      if (n == 3) scripts(3)%text = 'animation.gp'
      call run_gnuplot(scripts, join_path(folder, 'figures'), message, error)
   end subroutine draw

   !> Design as solid parts, the ends of the travel as lines.
   subroutine write_picture(suspension, tests, films, folder, camera, error)
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: tests(:)
      type(film_t), intent(in) :: films(:)
      character(*), intent(in) :: folder
      type(camera_t), intent(out) :: camera
      type(error_t), allocatable, intent(out) :: error
      type(scene_t) :: scenes(1)
      type(state_t) :: state
      integer :: film, last

      camera = view_of(suspension)
      state = design_state(suspension)
      call add_solid(scenes(1), suspension, state)
      call add_ground(scenes(1), suspension, state)
      call add_names(scenes(1), suspension, state)
      film = moving_film(tests, films, [character(16) :: 'parallel_travel', 'vertical_force', 'single_travel'])
      if (film > 0) then
         associate (path => films(film)%path)
            last = findloc(path%is_reached, .true., dim=1)
            call look_at(path, last, suspension, state)
            call add_ghost(scenes(1), suspension, state, line_rebound)
            scenes(1)%rebound = end_name(suspension, state)
            last = findloc(path%is_reached, .true., dim=1, back=.true.)
            call look_at(path, last, suspension, state)
            call add_ghost(scenes(1), suspension, state, line_bump)
            scenes(1)%bump = end_name(suspension, state)
         end associate
      end if
      call fit_camera(camera, scenes, 3.0_wp, 2.0_wp, footer=0.11_wp)
      call write_whole(join_path(folder, 'figures/picture.gp'), scene_script(scenes(1), camera, '../picture', &
         suspension%name//': design, and the ends of its travel'), error)
   end subroutine write_picture

   !> There and back through the travel, then through the steering.
   subroutine write_animation(suspension, tests, films, folder, camera, error)
      type(suspension_t), intent(in) :: suspension
      type(test_result_t), intent(in) :: tests(:)
      type(film_t), intent(in) :: films(:)
      character(*), intent(in) :: folder
      type(camera_t), intent(in) :: camera
      type(error_t), allocatable, intent(out) :: error
      type(scene_t), allocatable :: scenes(:)
      character(64), allocatable :: captions(:)
      type(camera_t) :: fitted
      type(state_t) :: state
      integer :: chosen(2), frames, each, k, f, n, at, first, last

      chosen = [moving_film(tests, films, [character(16) :: 'parallel_travel', 'vertical_force', 'single_travel']), &
         moving_film(tests, films, [character(16) :: 'steering'])]
      frames = most_frames/max(1, count(chosen > 0))
      allocate (scenes(frames*count(chosen > 0)), captions(frames*count(chosen > 0)))
      if (size(scenes) == 0) return
      n = 0
      do f = 1, 2
         if (chosen(f) == 0) cycle
         associate (path => films(chosen(f))%path)
            first = findloc(path%is_reached, .true., dim=1)
            last = findloc(path%is_reached, .true., dim=1, back=.true.)
            each = frames/2
            do k = 0, frames - 1
               at = first + nint(real(last - first, wp)*(1 - cos(acos(-1.0_wp)*k/each))/2)   ! slow at the ends
               call look_at(path, at, suspension, state)
               n = n + 1
               call add_solid(scenes(n), suspension, state, is_plain=.true.)
               call add_ground(scenes(n), suspension, design_state(suspension), is_plain=.true.)
               captions(n) = tests(chosen(f))%title
            end do
         end associate
      end do
      fitted = camera
      call fit_camera(fitted, scenes, 4.0_wp, 3.0_wp, footer=0.06_wp)
      call write_whole(join_path(folder, 'figures/animation.gp'), animation_script(scenes, captions, fitted, '../animation', &
         suspension%name), error)
   end subroutine write_animation

   !> The first of the wanted kinds that has more than one state; 0 when there is none.
   pure integer function moving_film(tests, films, kinds) result(film)
      type(test_result_t), intent(in) :: tests(:)
      type(film_t), intent(in) :: films(:)
      character(*), intent(in) :: kinds(:)
      integer :: kind

      do kind = 1, size(kinds)
         do film = 1, size(tests)
            if (.not. films(film)%is_there .or. tests(film)%kind /= kinds(kind)) cycle
            if (count(films(film)%path%is_reached) > 1) return
         end do
      end do
      film = 0
   end function moving_film

   !> State k of a path. Joints that a case adds have reactions behind those of the suspension.
   subroutine look_at(path, k, suspension, state)
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(out) :: state

      state = design_state(suspension)
      call unpack_state(path%packed(:7*size(suspension%bodies) + suspension%constraints(), k), state)
   end subroutine look_at

   !> 'wheel +80 mm'
   function end_name(suspension, state) result(name)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      character(:), allocatable :: name
      real(wp) :: rise
      integer :: body

      name = 'end of travel'
      if (size(suspension%wheels) == 0) return
      body = suspension%wheels(1)%body
      rise = state%poses(body + 1)%r(3) + dot_product(state%poses(body + 1)%a(3, :), suspension%wheels(1)%centre) - &
         (suspension%bodies(body)%origin(3) + suspension%wheels(1)%centre(3))
      name = 'rebound, '
      if (rise > 0.0_wp) name = 'bump, +'
      name = name//str(anint(rise/millimetre), 3)//' mm'
   end function end_name

   !> From where: an axle from its front left, one wheel from the middle of the car.
   pure type(camera_t) function view_of(suspension) result(camera)
      type(suspension_t), intent(in) :: suspension

      camera%turn = 296.0_wp
      camera%tilt = 70.0_wp
      if (size(suspension%wheels) /= 1) return
      camera%turn = 232.0_wp
      if (suspension%wheels(1)%side > 0) camera%turn = 308.0_wp
   end function view_of

   !> report.html
   subroutine write_page(arguments, suspension, checksum, tests, sets, gradients, warnings, folder, error)
      type(arguments_t), intent(in) :: arguments
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: checksum
      type(test_result_t), intent(in) :: tests(:)
      type(chart_set_t), intent(in) :: sets(:)
      type(gradient_t), intent(in) :: gradients(:)
      type(message_list_t), intent(in) :: warnings
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: names, values
      character(:), allocatable :: title, settings
      integer :: now(8), k
      character(16) :: date

      title = suspension%title
      if (len(title) == 0) title = suspension%name
      call date_and_time(values=now)
      write (date, '(i4.4,a,i2.2,a,i2.2,a,i2.2,a,i2.2)') now(1), '-', now(2), '-', now(3), ' ', now(5), ':', now(6)
      call fact('Deck', arguments%file)
      call fact('Model', suspension%name)
      settings = ''
      do k = 1, size(arguments%settings)
         settings = settings//arguments%settings(k)%text//' '
      end do
      if (len(settings) > 0) call fact('Changed by --set', trim(settings))
      if (size(suspension%wheels) > 0) call fact('Road at design', 'z = '//str(( &
         suspension%bodies(suspension%wheels(1)%body)%origin(3) + suspension%wheels(1)%contact(3))/millimetre, 6)//' mm')
      call fact('Deck checksum', checksum)
      call fact('Program', 'elastokin '//version)
      call fact('Date', date)
      call write_whole(join_path(folder, 'report.html'), report_page(title, 'Kinematics and compliance report', names, values, &
         warnings, tests, sets, gradients, folder), error)

   contains

      subroutine fact(name, value)
         character(*), intent(in) :: name, value
         call names%add(name)
         call values%add(value)
      end subroutine fact

   end subroutine write_page

end module ek_report
