!> A fit checked against its deck: the factors become directions with bounds and priors. The targets become requested numbers, one
!> per point.
!> Each number of the deck belongs to at most one factor. The curve of a target is a table: abscissa, required value and limits.
module ek_fit_problem
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: str, quoted, did_you_mean
   use ek_table, only: name_length
   use ek_number_range, only: is_inside
   use ek_deck, only: deck_t
   use ek_study, only: by_value, by_scale, is_given, not_given
   use ek_key_number, only: key_number_t, key_source_t, slope
   use ek_number_reach, only: reach_of_place
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: case_number
   use ek_parameter, only: parameter_path
   use ek_matched_numbers, only: claims_t, new_claims, matches_t, match_t, match_paths, match_name, claim
   use ek_direction, only: direction_t, find_directions
   use ek_compliance_table, only: compliance_columns
   use ek_wanted_number, only: wanted_number_t, find_wanted, find_column
   use ek_fit, only: fit_t, fit_factor_t, fit_target_t
   use ek_factor_paths, only: shared_text
   use ek_sheet, only: sheet_t, read_sheet, column_of, mistakes_of, complain
   use ek_sheet_columns, only: take_columns, find_unit_row, or_empty
   use ek_unit_row, only: unit_of_heading
   use ek_case, only: case_t
   use ek_measurement, only: measurement_t
   use ek_rig_map, only: map_channel_t, read_map, read_measurement
   implicit none(type, external)
   private
   public :: fit_problem_t, fit_variable_t, fit_point_t, make_problem

   !> A factor of a fit, as a direction with bounds and a prior.
   type :: fit_variable_t
      character(:), allocatable :: name
      type(direction_t) :: direction
      real(wp) :: start = 0.0_wp                           !! value in the deck, in the unit of the direction
      real(wp) :: lower = -huge(1.0_wp), upper = huge(1.0_wp)
      real(wp) :: nominal = 0.0_wp, deviation !! mean and standard deviation of the prior; deviation is NaN without a prior
      real(wp) :: scale = 1.0_wp                           !! change that counts as large, in the unit of the direction
      logical :: is_positive = .false.                     !! the factor cannot be negative (a rate, a mass, a multiple)
   end type fit_variable_t

   !> One point of a target: a result that is fitted to a value, or to limits.
   type :: fit_point_t
      integer :: target = 0
      real(wp) :: value, low, high                         !! target value and limits; NaN if not given
      real(wp) :: deviation = 1.0_wp                       !! divisor of the difference: standard deviation over weight
   end type fit_point_t

   type :: fit_problem_t
      type(fit_variable_t), allocatable :: variables(:)
      type(fit_point_t), allocatable :: points(:)
      type(wanted_number_t), allocatable :: wanted(:)      !! requested number of each point
      logical :: knows_deviation = .false.                 !! at least one target gives a standard deviation
   end type fit_problem_t

   real(wp), parameter :: steps = 1.0e3_wp                 !! number of steps of a direction that count as large: 100 mm, 5.7 deg,
                                                           !! the largest value of a rate

contains

   !> Checks a fit against its deck and reports all errors. No case is solved.
   subroutine make_problem(fit, home, deck, workspace, problem, error)
      type(fit_t), intent(in) :: fit
      character(*), intent(in) :: home                     !! folder of the fit, with its slash
      type(deck_t), intent(in) :: deck
      type(workspace_t), intent(in) :: workspace          !! workspace of the deck
      type(fit_problem_t), intent(out) :: problem
      type(error_t), allocatable, intent(out) :: error     !! exit_deck
      type(message_list_t) :: mistakes
      type(claims_t) :: claims
      type(fit_problem_t), allocatable :: parts(:)         ! of each target
      character(:), allocatable :: twice
      integer :: k

      allocate (problem%variables(0))
      call new_claims(workspace%definition%parameters, claims)
      do k = 1, size(fit%factors)
         call claim_factor(fit, k, workspace, claims, twice)
         if (twice /= '') call mistakes%add(twice)
         if (twice == '') call add_factor(fit%factors(k), deck, workspace, problem%variables, mistakes)
      end do
      problem%knows_deviation = any(is_given(fit%targets%deviation))
      allocate (parts(size(fit%targets)))
      do k = 1, size(fit%targets)
         allocate (parts(k)%points(0), parts(k)%wanted(0))
         call add_target(fit, k, home, workspace, parts(k), mistakes)
      end do
      call join_parts(parts, problem)
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine make_problem

   !> Joins the points of all targets.
   pure subroutine join_parts(parts, problem)
      type(fit_problem_t), intent(in) :: parts(:)
      type(fit_problem_t), intent(inout) :: problem
      integer :: k, before, n

      n = 0
      do k = 1, size(parts)
         n = n + size(parts(k)%points)
      end do
      allocate (problem%points(n), problem%wanted(n))
      before = 0
      do k = 1, size(parts)
         n = size(parts(k)%points)
         problem%points(before + 1:before + n) = parts(k)%points
         problem%wanted(before + 1:before + n) = parts(k)%wanted
         before = before + n
      end do
   end subroutine join_parts

   !> Adds a factor. With each = .true., adds one factor for each number to which the paths lead.
   subroutine add_factor(factor, deck, workspace, variables, mistakes)
      type(fit_factor_t), intent(in) :: factor
      type(deck_t), intent(in) :: deck
      type(workspace_t), intent(in) :: workspace
      type(fit_variable_t), allocatable, intent(inout) :: variables(:)
      type(message_list_t), intent(inout) :: mistakes
      type(direction_t), allocatable :: found(:)
      type(fit_variable_t) :: this
      type(message_list_t) :: path
      type(error_t), allocatable :: error
      character(:), allocatable :: head
      integer :: k, j, members, many

      head = factor%where//': factor '//quoted(factor%name)//': '
      members = 0
      many = size(variables)
      this%name = factor%name
      do k = 1, size(factor%paths)
         path = message_list_t()
         call path%add(trim(factor%paths(k)))
         call find_directions(workspace%definition, deck, path, found, error)
         if (allocated(error)) then
            call mistakes%add(head//error%message)
            return
         end if
         do j = 1, size(found)
            if (is_known(found(j), factor%is_each)) cycle
            if (factor%is_each) this%name = found(j)%path
            if (factor%is_each .or. members == 0) this%direction = first_member(factor, factor%weights(k), found(j))
            members = members + 1
            if (factor%is_each) call finish()
            if (factor%is_each .or. members == 1) cycle
            if (factor%change == by_value .and. abs(found(j)%value - this%direction%value) > 0.0_wp) then
               call mistakes%add(head//'its paths lead to numbers of different sizes; give change = ''delta'' or ''scale''')
               return
            end if
            call join(factor, factor%weights(k), found(j), this%direction)
         end do
      end do
      if (.not. factor%is_each) call finish()

   contains

      !> Whether earlier paths of the factor already lead to all numbers of a direction. Numbers that they lead to are removed from
      !> the direction, so that a number counts once.
      logical function is_known(number, is_each)
         type(direction_t), intent(inout) :: number
         logical, intent(in) :: is_each
         integer :: l, v, last

         last = size(variables)
         is_known = .false.
         if (members == 0) return
         do v = many + 1, merge(last, many, is_each)
            number%found = pack(number%found, [(all(variables(v)%direction%found%number /= number%found(l)%number), &
               l=1, size(number%found))])
         end do
         if (.not. is_each) number%found = pack(number%found, [(all(this%direction%found%number /= number%found(l)%number), &
            l=1, size(number%found))])
         is_known = size(number%found) == 0
         if (.not. is_known) number%path = parameter_path(workspace%definition%parameters%list(number%found(1)%number), &
            workspace%definition%records, is_of_pair=size(number%found) > 1)
      end function is_known

      !> Sets the bounds and the prior of the factor, which is then complete.
      subroutine finish()
         this%start = this%direction%value
         this%lower = -huge(1.0_wp)
         this%upper = huge(1.0_wp)
         if (is_given(factor%lower)) this%lower = factor%lower
         if (is_given(factor%upper)) this%upper = factor%upper
         this%nominal = this%start
         if (is_given(factor%nominal)) this%nominal = factor%nominal
         this%deviation = factor%deviation
         if (is_given(factor%tolerance)) this%deviation = factor%tolerance/3.0_wp
         this%is_positive = factor%change == by_scale
         associate (list => workspace%definition%parameters%list)
            if (factor%change == by_value) this%is_positive = .not. is_inside(list(this%direction%found(1)%number)%range, -1.0_wp)
         end associate
         this%scale = steps*this%direction%step
         if (is_given(this%deviation)) this%scale = 3.0_wp*this%deviation
         if (is_given(factor%lower) .and. is_given(factor%upper)) this%scale = factor%upper - factor%lower
         variables = [variables, this]
      end subroutine finish

   end subroutine add_factor

   !> The direction of a factor that contains its first number only. The value of the direction is the number itself. For a factor
   !> that adds, the value is 0; for a factor that multiplies, the value is 1.
   function first_member(factor, weight, number) result(direction)
      type(fit_factor_t), intent(in) :: factor
      real(wp), intent(in) :: weight
      type(direction_t), intent(in) :: number
      type(direction_t) :: direction

      direction = number
      if (factor%change == by_value) return
      deallocate (direction%found)
      allocate (direction%found(0))
      direction%value = 0.0_wp
      if (factor%change == by_scale) then
         direction%value = 1.0_wp
         direction%unit = ''
         direction%si = 1.0_wp
         direction%step = 1.0e-4_wp
      end if
      call join(factor, weight, number, direction)
   end function first_member

   !> Adds a number that moves together with the other numbers of a factor. The sign of the number becomes its change per change of
   !> the factor, including the weight of its path.
   subroutine join(factor, weight, number, direction)
      type(fit_factor_t), intent(in) :: factor
      real(wp), intent(in) :: weight
      type(direction_t), intent(in) :: number
      type(direction_t), intent(inout) :: direction
      integer :: j, many

      many = size(direction%found)
      direction%found = [direction%found, number%found]
      do j = many + 1, size(direction%found)
         associate (sign => direction%found(j)%sign)
            if (factor%change == by_scale) then
               sign = sign*weight*number%value*number%si
            else
               sign = sign*weight*number%si/direction%si
            end if
         end associate
      end do
   end subroutine join

   !> Adds the points of a target. A target with weight 0 adds no points.
   subroutine add_target(fit, k, home, workspace, problem, mistakes)
      type(fit_t), intent(in) :: fit
      integer, intent(in) :: k
      character(*), intent(in) :: home
      type(workspace_t), intent(in) :: workspace
      type(fit_problem_t), intent(inout) :: problem
      type(message_list_t), intent(inout) :: mistakes
      type(wanted_number_t) :: wanted
      type(fit_point_t) :: point
      type(error_t), allocatable :: error
      character(name_length), allocatable :: heads(:), entries(:)
      character(:), allocatable :: case, head, unit
      integer :: c

      associate (this => fit%targets(k))
         head = this%where//': target '//quoted(this%name)//': '
         case = this%case
         if (case == '') case = fit%case
         c = case_number(case, workspace)
         if (c == 0) then
            call mistakes%add(head//'the deck has no case '//quoted(case)//', and there is no standard test of this name')
            return
         end if
         if (this%over /= 'factor' .or. this%is_slope) then
            call find_column(workspace, c, this%quantity, trim(this%over), this%at, wanted, heads)
            if (wanted%case == 0) then
               call mistakes%add(head//'case '//quoted(workspace%cases(c)%case%name)//' has no columns '//quoted(this%quantity)// &
                  ' and '//quoted(trim(this%over)))
               return
            end if
            call compliance_columns(workspace%raw, entries)
            if (.not. this%is_slope .and. any(entries == this%over)) then
               call mistakes%add(head//'over = '//quoted(trim(this%over))//' is an entry of the compliance matrix; expected a '// &
                  'column of the table of case '//quoted(workspace%cases(c)%case%name)//', where its path can stop')
               return
            end if
            if (this%is_slope) call make_slope(this, workspace, wanted)
         else
            call find_wanted(workspace, c, this%quantity, this%at, wanted, error)
            if (allocated(error)) then
               call mistakes%add(head//error%message)
               return
            end if
         end if
         if (this%is_change) then
            if (allocated(wanted%key)) then
               call mistakes%add(head//'of = ''change'' needs a column, which has a value at design; a K&C metric has none')
               return
            end if
            wanted%is_change = .true.
         end if
         point%target = k
         point%deviation = 1.0_wp
         if (is_given(this%deviation)) point%deviation = this%deviation
         if (.not. this%weight > 0.0_wp) return
         point%deviation = point%deviation/this%weight
         point%value = this%value
         point%low = this%low
         point%high = this%high
         if (this%file == '') then
            problem%wanted = [problem%wanted, wanted]
            problem%points = [problem%points, point]
            return
         end if
         if (allocated(wanted%key)) then
            call mistakes%add(head//'a K&C metric is one value and has no curve; give value')
            return
         end if
         unit = ''
         if (allocated(workspace%cases(c)%case%unit_name)) unit = workspace%cases(c)%case%unit_name      ! once on the rig
         call add_curve(this, head, home, unit, workspace, wanted, point, problem, mistakes)
      end associate
   end subroutine add_target

   !> Adds the points of a target that is a curve: one point for each row of the file. The swept value and the required value must
   !> be numbers; a limit may be missing in rows with another number.
   subroutine add_curve(this, head, home, swept_unit, workspace, first, model, problem, mistakes)
      type(fit_target_t), intent(in) :: this
      character(*), intent(in) :: head              !! beginning of messages
      character(*), intent(in) :: home
      character(*), intent(in) :: swept_unit        !! unit of the swept value of the case
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), intent(in) :: first    !! the quantity, with `at` to be replaced
      type(fit_point_t), intent(in) :: model        !! a point with target and deviation
      type(fit_problem_t), intent(inout) :: problem
      type(message_list_t), intent(inout) :: mistakes
      real(wp), allocatable :: rows(:, :)           !! abscissa, value, low, high
      type(message_list_t) :: flaws
      type(wanted_number_t), allocatable :: list(:)
      type(fit_point_t), allocatable :: points(:)
      integer :: k, used

      if (this%map == '') call read_curve(this, home, swept_unit, rows, flaws)
      if (this%map /= '') call read_measured_curve(this, home, workspace%cases(first%case)%case, rows, flaws)
      do k = 1, flaws%count()
         call mistakes%add(head//flaws%line(k))
      end do
      if (flaws%count() > 0) return
      used = size(rows, 2)
      allocate (list(used), source=first)
      allocate (points(used), source=model)
      do k = 1, used
         list(k)%at = rows(1, k)
         if (this%over == 'factor') list(k)%reach = reach_of_place(workspace%raw, workspace%cases(first%case)%case, rows(1, k))
         points(k)%value = rows(2, k)
         points(k)%low = rows(3, k)
         points(k)%high = rows(4, k)
      end do
      problem%wanted = [problem%wanted, list]
      problem%points = [problem%points, points]
   end subroutine add_curve

   !> Turns a requested column into its slope within a window around design. The slope is fitted like a gradient of the report.
   subroutine make_slope(target, workspace, wanted)
      type(fit_target_t), intent(in) :: target
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), intent(inout) :: wanted
      type(key_number_t) :: key
      type(key_source_t) :: source

      source%test = wanted%case
      source%column(1) = wanted%column
      source%over(1) = target%over
      source%half = target%window
      if (target%over == 'factor') source%width = target%window      ! otherwise found when the case is solved first
      key%how = slope
      key%sources = [source]
      wanted%key = key
      wanted%unit = wanted%unit//' per '//trim(target%over)
      wanted%column = ''
      wanted%reach = [huge(1.0_wp)]
      if (target%over == 'factor') wanted%reach = reach_of_place(workspace%raw, workspace%cases(wanted%case)%case, target%window)
   end subroutine make_slope

   !> Checks that the numbers of a factor belong to no earlier factor. `message` describes a number that an earlier factor changes,
   !> and a number that two paths of the factor change in different ways; otherwise it is ''.
   subroutine claim_factor(fit, f, workspace, claims, message)
      type(fit_t), intent(in) :: fit
      integer, intent(in) :: f                             !! index of the factor
      type(workspace_t), intent(in) :: workspace
      type(claims_t), intent(inout) :: claims              !! numbers of all factors
      character(:), allocatable, intent(out) :: message
      type(matches_t) :: matches, one
      type(match_t), allocatable :: shared(:)
      character(:), allocatable :: ignored
      integer :: k, j, other

      associate (factor => fit%factors(f), design => workspace%definition)
         call match_paths(design%parameters, design%records, factor%paths, factor%change /= by_value, matches, message)
         if (factor%change == by_scale) message = ''                 ! a multiple has no direction
         do k = 2, merge(size(factor%paths), 1, message == '' .and. matches%has_repeated)
            call match_paths(design%parameters, design%records, factor%paths(k:k), factor%change /= by_value, one, ignored)
            do j = 1, size(matches%list)
               associate (before => matches%list(j)%path)
                  if (before >= k .or. .not. any(one%list%number == matches%list(j)%number)) cycle
                  if (message == '' .and. abs(factor%weights(before) - factor%weights(k)) > 0.0_wp) message = 'its paths '// &
                     quoted(trim(factor%paths(before)))//' and '//quoted(trim(factor%paths(k)))//' change '// &
                     match_name(design%records, matches%list(j), matches%list)//' with different weights; remove one of them'
               end associate
            end do
         end do
         if (message /= '') message = factor%where//': factor '//quoted(factor%name)//': '//message
         call claim(claims, matches%list, f, other, shared)
         if (other > 0 .and. message == '') message = shared_text(factor%where, factor%name, fit%factors(other)%where, &
            fit%factors(other)%name, match_name(design%records, shared(1), shared))
      end associate
   end subroutine claim_factor

   !> Reads the curve of a target. Each row needs the abscissa. If the table has the column of the required values, each row needs
   !> the required value; otherwise each row needs a limit.
   subroutine read_curve(target, home, swept_unit, rows, mistakes)
      type(fit_target_t), intent(in) :: target
      character(*), intent(in) :: home                     !! folder of the fit, with its slash
      character(*), intent(in) :: swept_unit               !! unit of the swept value of the case
      real(wp), allocatable, intent(out) :: rows(:, :)     !! (abscissa, value, low, high; row); nan if not given
      type(message_list_t), intent(inout) :: mistakes      !! receives all errors of the table
      character(*), parameter :: limit(2) = [character(4) :: 'low', 'high']
      type(sheet_t) :: sheet
      type(error_t), allocatable :: error
      character(16) :: units(2)
      character(:), allocatable :: path
      real(wp), allocatable :: values(:, :), limits(:, :)
      integer, allocatable :: of_limits(:)
      integer :: places(2), of(2), k

      allocate (rows(4, 0))
      path = target%file
      if (index(path, '/') /= 1) path = home//path
      call read_sheet(path, sheet, error)
      if (allocated(error)) then
         call mistakes%add(error%message)
         return
      end if
      places = [column_of(sheet, trim(target%over)), column_of(sheet, trim(target%column))]
      of = [(column_of(sheet, trim(limit(k))), k=1, 2)]
      of_limits = pack(of, of > 0)
      units(1) = unit_of_heading(trim(target%over))
      units(2) = unit_of_heading(trim(target%quantity))
      if (target%over == 'factor') units(1) = swept_unit
      if (sheet%head_mistakes%count() == 0 .and. (places(1) == 0 .or. (places(2) == 0 .and. size(of_limits) == 0))) &
         call sheet%head_mistakes%add(path//' must have the columns '//trim(target%over)//' and '//trim(target%column)// &
         ', or low, or high')
      if (sheet%head_mistakes%count() == 0) then
         call find_unit_row(sheet, [pack(places, places > 0), of_limits])
         call take_columns(sheet, pack(places, places > 0), values, pack(units, places > 0))
         call take_columns(sheet, [places(1), of_limits], limits, [units(1), spread(units(2), 1, size(of_limits))], or_empty)
         if (places(2) == 0) then
            do k = 1, size(limits, 2)
               if (.not. any(is_given(limits(2:, k)))) call complain(sheet, sheet%unit_row + k, &
                  'expected a limit in column low or high, found none')
            end do
         end if
      end if
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0) return
      deallocate (rows)
      allocate (rows(4, size(values, 2)), source=not_given())
      rows(1, :) = values(1, :)
      if (places(2) > 0) rows(2, :) = values(2, :)
      do k = 1, 2
         if (of(k) > 0) rows(2 + k, :) = limits(1 + findloc(of_limits, of(k), dim=1), :)
      end do
   end subroutine read_curve

   !> Reads the measured curve of a target by the map of its file. Points without a value are omitted.
   subroutine read_measured_curve(target, home, case, rows, mistakes)
      type(fit_target_t), intent(in) :: target
      character(*), intent(in) :: home                     !! folder of the fit, with its slash
      type(case_t), intent(in) :: case                     !! case of the target
      real(wp), allocatable, intent(out) :: rows(:, :)     !! as read_curve
      type(message_list_t), intent(inout) :: mistakes      !! receives all errors of map and table
      type(map_channel_t), allocatable :: channels(:)
      type(measurement_t) :: measurement
      type(error_t), allocatable :: error
      character(:), allocatable :: kind
      real(wp), allocatable :: y(:)
      integer :: place

      allocate (rows(4, 0))
      kind = ''
      if (allocated(case%test)) kind = case%test
      call read_map(in_home(target%map), channels, error)
      if (.not. allocated(error)) call read_measurement(in_home(target%file), case%name, kind, channels, measurement, error)
      if (allocated(error)) then
         call mistakes%add(error%message)
         return
      end if
      place = findloc(measurement%channels%column == target%quantity, .true., dim=1)
      if (place == 0) then
         call mistakes%add(measurement%file//': no column is '//quoted(target%quantity)//' by the map '//target%map// &
            did_you_mean(target%quantity, measurement%channels%column))
         return
      else if (measurement%channels(place)%is_zeroed .neqv. target%is_change) then
         call mistakes%add(measurement%file//': channel '//quoted(trim(measurement%channels(place)%heading))// &
            ': zeroed of the map and of = ''change'' of the target belong together')
         return
      end if
      y = measurement%channels(place)%y
      deallocate (rows)
      allocate (rows(4, count(is_given(y))), source=not_given())
      rows(1, :) = pack(measurement%x, is_given(y))
      rows(2, :) = pack(y, is_given(y))

   contains

      function in_home(file) result(path)
         character(*), intent(in) :: file
         character(:), allocatable :: path
         path = file
         if (index(path, '/') /= 1) path = home//path
      end function in_home
   end subroutine read_measured_curve

end module ek_fit_problem
