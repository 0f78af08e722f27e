!> The settings of elastokin export: target, ranges and choices of the command line, completed from the deck.
module ek_export_settings
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_deck
   use ek_text, only: str, quoted
   use ek_decimal, only: get_bounded
   use ek_definition, only: check_program
   use ek_suspension, only: suspension_t, driver_row
   use ek_measure, only: is_of_angle
   use ek_case, only: case_t
   use ek_standard_tests, only: standard_tests
   use ek_command_line, only: command_line_t, refuse_stream
   use ek_load_deck, only: deck_settings_t, read_deck_settings
   use ek_length_choice, only: choose_lengths
   use ek_map_request, only: map_request_t, grid_values, over_steer, over_opposite, over_none
   implicit none(type, external)
   private
   public :: export_settings_t, range_t, read_export_settings, make_request, front_of

   !> A range of the command line, from:to:points; for --loads, force:moment:points.
   type :: range_t
      logical :: is_given = .false.
      real(wp) :: from = 0.0_wp, to = 0.0_wp
      integer :: points = 0
   end type range_t

   type, extends(deck_settings_t) :: export_settings_t
      character(:), allocatable :: target, map, driver, vertical, held, axle, signs, other
      character(:), allocatable :: program                   !! other program whose columns target csv also has; not allocated: none
      type(message_list_t) :: lengths
      type(range_t) :: travel, steer, loads
      logical :: has_plots = .false.
   end type export_settings_t

contains

   !> Reads the settings of export from the command line and checks them.
   subroutine read_export_settings(line, targets, settings, error)
      type(command_line_t), intent(in) :: line
      character(*), intent(in) :: targets(:)                  !! names of the formats
      type(export_settings_t), intent(out) :: settings
      type(error_t), allocatable, intent(out) :: error        !! exit_usage: every error
      type(message_list_t) :: mistakes

      call refuse_stream(line, error)
      if (allocated(error)) return
      call read_deck_settings(line, settings)
      settings%lengths = line%values('--length')
      settings%has_plots = line%has('--plot')
      settings%driver = line%value('--driver')
      settings%other = line%value('--other')
      call take_word('--to', targets, settings%target)
      if (.not. line%has('--to')) call mistakes%add('export needs --to '//list(targets))
      call take_word('--map', [character(8) :: 'steer', 'opposite'], settings%map)
      call take_word('--vertical', [character(6) :: 'centre', 'patch', 'road'], settings%vertical)
      call take_word('--held', [character(6) :: 'road', 'centre', 'force'], settings%held)
      call take_word('--axle', [character(5) :: 'front', 'rear'], settings%axle)
      call take_word('--signs', [character(3) :: 'iso', 'sae'], settings%signs)
      call take_range('--travel', settings%travel, 3)
      call take_range('--steer', settings%steer, 3)
      call take_range('--loads', settings%loads, 3)
      if (settings%loads%is_given .and. (settings%loads%from <= 0.0_wp .or. settings%loads%to <= 0.0_wp)) call mistakes%add( &
         '--loads: expected force:moment:points with a largest force in N and a largest moment in N m, found '// &
         quoted(line%value('--loads')))
      if (settings%other /= '' .and. settings%target /= 'matlab-kc') &
         call mistakes%add('--other: only matlab-kc writes both axles in one file')
      if (settings%signs /= '' .and. settings%target /= 'csv') call mistakes%add('--signs: only csv has a choice of signs; '// &
         'carmaker and matlab-kc use ISO 8855, carsim uses the signs of CarSim')
      if (line%has('--definitions')) then
         settings%program = line%value('--definitions')
         call check_program(settings%program, error)
         if (allocated(error)) call mistakes%add(error%message)
         if (settings%target /= 'csv') call mistakes%add('--definitions: only csv has columns of another program')
      end if
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())

   contains

      !> Reads an option whose value must be in a list.
      subroutine take_word(option, words, word)
         character(*), intent(in) :: option, words(:)
         character(:), allocatable, intent(out) :: word

         word = line%value(option)
         if (word == '' .or. any(words == word)) return
         call mistakes%add(option//': expected '//list(words)//', found '//quoted(word))
      end subroutine take_word

      !> Reads an option of the form from:to:n.
      subroutine take_range(option, range, least)
         character(*), intent(in) :: option
         type(range_t), intent(out) :: range
         integer, intent(in) :: least      !! smallest number of points
         character(:), allocatable :: text
         real(wp) :: numbers(3)
         integer :: k, colon
         logical :: is_good

         text = line%value(option)
         if (text == '') return
         range%is_given = .true.
         do k = 1, 3
            colon = index(text//':', ':')
            call get_bounded(text(:colon - 1), numbers(k), is_good)
            if (.not. is_good .or. colon == 1) exit
            text = text(min(colon + 1, len(text) + 1):)
         end do
         if (k > 3 .and. text == '') then
            range%from = numbers(1)
            range%to = numbers(2)
            if (numbers(3) >= least .and. numbers(3) <= 1001.0_wp) range%points = nint(numbers(3))
         end if
         if (range%points < least) then
            call mistakes%add(option//': expected from:to:points with '//str(least)//' to 1001 points, as -80:80:33, found '// &
               quoted(line%value(option)))
            return
         end if
         if (option == '--loads') return
         if (range%from >= range%to .or. range%from > 0.0_wp .or. range%to < 0.0_wp) call mistakes%add(option// &
            ': expected a range that contains 0, from below to, found '//quoted(line%value(option)))
      end subroutine take_range

   end subroutine read_export_settings

   pure function list(words) result(text)
      character(*), intent(in) :: words(:)
      character(:), allocatable :: text
      integer :: k

      text = trim(words(1))
      do k = 2, size(words)
         text = text//trim(merge(' or', ',  ', k == size(words)))//' '//trim(words(k))
      end do
   end function list

   !> Builds the request for a model. Ranges come from the command line, otherwise from the tests of travel and steering.
   subroutine make_request(settings, suspension, cases, request, error)
      type(export_settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)                    !! cases of the deck
      type(map_request_t), intent(out) :: request
      type(error_t), allocatable, intent(out) :: error        !! exit_usage
      integer, parameter :: travel_points = 33, steer_points = 17
      type(case_t), allocatable :: tests(:)
      integer :: k

      if (size(suspension%wheels) == 0) then
         call fail(error, exit_deck, settings%file//': the deck has no &wheel, so there are no kinematics to export')
         return
      end if
      call standard_tests(suspension, cases, tests)
      call choose_kind(settings, suspension, request, error)
      if (allocated(error)) return
      do k = 1, size(tests)
         if (tests(k)%test == 'parallel_travel' .and. .not. allocated(request%travel)) &
            call take('--travel', settings%travel, tests(k)%from, tests(k)%to, travel_points, request%travel, error)
         if (tests(k)%test == 'steering' .and. .not. allocated(request%second) .and. request%kind == over_steer) &
            call take('--steer', settings%steer, tests(k)%from, tests(k)%to, steer_points, request%second, error)
         if (allocated(error)) return
      end do
      if (request%kind == over_steer .and. .not. allocated(request%second)) then
         if (.not. settings%steer%is_given) then
            call fail(error, exit_usage, 'the driver '//quoted(request%driver)// &
               ' has no range of its own: give it with --steer from:to:points, in mm')
            return
         end if
         call take('--steer', settings%steer, 0.0_wp, 0.0_wp, steer_points, request%second, error)
      end if
      request%vertical = settings%vertical
      if (request%vertical == '') request%vertical = 'patch'
      request%held = settings%held
      if (request%held == '') request%held = trim(merge('road  ', 'centre', all(suspension%wheels%tyre_rate > 0.0_wp)))
      if ((request%held == 'road' .or. request%vertical == 'road') .and. .not. all(suspension%wheels%tyre_rate > 0.0_wp)) then
         call fail(error, exit_usage, '--held road, --vertical road: needs tyre_rate of every &wheel; add it, or use centre')
         return
      end if
      call choose_lengths(suspension, settings%lengths, request%choices, error)
   end subroutine make_request

   !> Chooses the second input of the map (steering, travel of the other wheel, or none), and the driver that steers.
   subroutine choose_kind(settings, suspension, request, error)
      type(export_settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      type(map_request_t), intent(inout) :: request
      type(error_t), allocatable, intent(out) :: error        !! exit_usage
      integer :: row

      request%driver = settings%driver
      if (request%driver == '' .and. suspension%steering%has_steering) request%driver = suspension%steering%driver
      request%kind = over_none
      if (settings%map == 'opposite' .and. size(suspension%wheels) < 2) then
         call fail(error, exit_usage, '--map opposite: the deck has one wheel; without it the other side is the mirror image of it')
      else if (settings%map == 'steer' .and. request%driver == '') then
         call fail(error, exit_usage, '--map steer: the deck has no &steering; name the driver joint with --driver NAME')
      else if (settings%map == 'opposite') then
         request%kind = over_opposite
      else if (settings%map == '' .and. request%driver == '' .and. size(suspension%wheels) > 1 .and. &
         (settings%target == 'carmaker' .or. settings%target == 'csv')) then
         request%kind = over_opposite
      else if (request%driver /= '') then
         request%kind = over_steer
         row = driver_row(suspension, request%driver)
         if (row == 0) then
            call fail(error, exit_usage, '--driver: no driver joint '//quoted(request%driver)//' in '//settings%file)
         else if (is_of_angle(suspension%terms(suspension%rows(row)%first)%measure%kind)) then
            call fail(error, exit_usage, '--driver: '//quoted(request%driver)// &
               ' drives an angle; expected a driver of a length (a rack)')
         end if
      end if
      if (allocated(error)) return
      if (settings%steer%is_given .and. request%kind /= over_steer) call fail(error, exit_usage, &
         '--steer: this export has no steer; the deck has no &steering: name the driver joint with --driver NAME')
   end subroutine choose_kind

   !> Sets the values of a grid: from a range of the command line, otherwise from the range of a test.
   subroutine take(option, range, from, to, points, values, error)
      character(*), intent(in) :: option
      type(range_t), intent(in) :: range                      !! range of the command line [mm]
      real(wp), intent(in) :: from, to                        !! range of the test [m]
      integer, intent(in) :: points
      real(wp), allocatable, intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error        !! exit_usage: the range of the test excludes design

      if (range%is_given) then
         values = grid_values(range%from*millimetre, range%to*millimetre, range%points)
      else if (min(from, to) > 0.0_wp .or. max(from, to) < 0.0_wp .or. .not. abs(to - from) > 0.0_wp) then
         call fail(error, exit_usage, 'the range of the test in the deck leaves 0 out: give one with '//option//' from:to:points')
      else
         values = grid_values(min(from, to), max(from, to), points)
      end if
   end subroutine take

   !> Finds whether the axle is the front axle.
   subroutine front_of(settings, suspension, is_front, error)
      type(export_settings_t), intent(in) :: settings
      type(suspension_t), intent(in) :: suspension
      logical, intent(out) :: is_front
      type(error_t), allocatable, intent(out) :: error        !! exit_usage

      is_front = .true.
      if (suspension%axle%has_axle) is_front = suspension%axle%is_front
      if (settings%axle /= '') is_front = settings%axle == 'front'
      if (settings%axle == '' .and. .not. suspension%axle%has_axle) call fail(error, exit_usage, &
         'the deck has no &axle with the position of the axle: add --axle front or --axle rear')
   end subroutine front_of

end module ek_export_settings
