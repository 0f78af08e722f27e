!> The results of a finished study for its figures and its page. The tables are read line by line.
!>
!> All values of factors and responses are stored (8 bytes each). Curves are stored for at most 5,000 designs. A NetCDF store is
!> first written as tables into a scratch folder (ek_store).
!>
!> The target bands of a deck (&target_band) become limits of those responses that equal key numbers.
module ek_study_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, plural
   use ek_file, only: join_path, file_exists
   use ek_quantity, only: quantity_t, quantity_named, unit_of, unit_text
   use ek_deck, only: deck_t, deck_checksum
   use ek_reader, only: definition_t
   use ek_rig, only: rig_t, rig_of, counts_from_start
   use ek_study, only: study_t, by_delta, by_scale, response_t
   use ek_sampler, only: sampler_t, designs_of, sample
   use ek_sampler_kind, only: sampler_kinds, tolerance_kind
   use ek_sampler_settings, only: sampler_settings_t
   use ek_designer, only: designer_t, begin_designer
   use ek_study_plan, only: plan_sampler
   use ek_study_tables, only: responses_name, curves_name, has_limits, limits_of
   use ek_load_state, only: start_text
   use ek_study_data, only: extreme_t, study_data_t, study_axis_t, percents
   use ek_store, only: wants_store, read_store, store_name
   use ek_store_description, only: keeps
   use ek_study_list, only: check_tables
   use ek_chunk, only: design_invalid
   use ek_writer, only: scratch_t, begin_scratch, end_scratch
   use ek_study_curves, only: read_curves, curve_step
   use ek_table_lines, only: lines_t, open_table, next_line, take_numbers, close_table
   use ek_moment_tables, only: read_moments
   use ek_study_noise, only: settle_responses
   use ek_study_findings, only: summarise, find_effects, find_extremes
   use ek_target_band, only: target_band_t
   use ek_key_numbers, only: number_name
   implicit none(type, external)
   private
   public :: read_results_of, number_at_design

   integer, parameter :: most_reasons = 12           !! largest number of kinds of failures

   !> Failures whose messages differ only in numbers.
   type :: reason_t
      character(:), allocatable :: pattern, words
      integer :: count = 0, design = 0
   end type reason_t

contains

   !> Reads the tables of a finished study. Nothing is solved.
   subroutine read_results_of(study, deck, home, out, data, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: home               !! folder of the study with its slash
      character(*), intent(in) :: out                !! folder of the tables
      type(study_data_t), intent(out) :: data
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, exit_file
      class(designer_t), allocatable :: designer
      type(definition_t), target :: definition
      type(sampler_settings_t) :: settings
      type(sampler_t) :: sampler
      type(scratch_t) :: scratch
      character(:), allocatable :: folder
      real(wp) :: tolerance
      type(extreme_t), allocatable :: extremes(:)
      integer :: k, r, used

      allocate (designer)
      call begin_designer(study, deck, definition, designer, error)
      if (.not. allocated(error)) call plan_sampler(study, home, designer, settings, sampler, error)
      if (allocated(error)) return
      data%name = study%name
      data%title = study%title
      data%kind = trim(sampler_kinds(study%kind)%name)
      data%deck = study%deck
      data%case = trim(designer%workspace%cases(1)%case%name)
      data%start = ''
      associate (workspace => designer%workspace)
         if (any([(counts_from_start(workspace%cases(k)%case), k=1, size(workspace%cases))]) .and. &
            allocated(workspace%suspension%bodies)) data%start = start_text(workspace%suspension)
      end associate
      data%designs = int(designs_of(sampler))
      call name_axes(study, designer, data)
      call set_bands(designer%workspace%definition%targets, study%responses, data%responses)
      call find_tables(study, out, data%designs, scratch, folder, error)
      tolerance = maxval([(designer%workspace%cases(k)%case%tolerance, k=1, size(designer%case_names))])
      if (.not. allocated(error)) call read_rows(study, deck_checksum(deck), join_path(folder, responses_name(study)), sampler, &
         tolerance, data, error)
      if (allocated(error)) then
         call end_scratch(scratch)
         return
      end if
      call settle_responses(study, tolerance, data)
      if (size(data%columns) > 0) then
         call read_curves(join_path(folder, curves_name(study)), deck_checksum(deck), tolerance, data, error)
      else
         allocate (data%drawn(0), data%sweep(0), data%curves(0, 0, 0), data%bands(size(percents), 0, 0))
      end if
      call end_scratch(scratch)
      if (allocated(error)) return
      allocate (data%summaries(size(data%responses)), data%effects(size(data%responses)))
      allocate (extremes(2*size(data%responses)))
      used = 0
      do r = 1, size(data%responses)
         call summarise(data%responses(r), data%y(r, :), data%summaries(r))
         call find_effects(study, sampler, data, r, data%effects(r))
         call find_extremes(study, designer, data, r, extremes, used)
      end do
      data%extremes = extremes(:used)
      if (study%kind == tolerance_kind) call read_moments(out, data)
   end subroutine read_results_of

   !> Finds the folder of the tables: the folder of the results, or a scratch folder with the tables of the store.
   subroutine find_tables(study, out, designs, scratch, folder, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: out
      integer, intent(in) :: designs
      type(scratch_t), intent(inout) :: scratch
      character(:), allocatable, intent(out) :: folder
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      logical :: has_tables, has_store

      has_tables = file_exists(join_path(out, responses_name(study)))
      has_store = file_exists(join_path(out, store_name(study)))
      folder = out
      if (.not. has_tables .and. .not. has_store) then
         call fail(error, exit_file, 'there is no '//join_path(out, responses_name(study))//' and no '//store_name(study)// &
            ': the study is not finished, or its results are in another folder (--out)')
         return
      end if
      has_store = has_store .and. (wants_store(study, designs) .or. .not. has_tables)
      if (has_store) call check_tables(study%name, out, store_name(study), error)
      if (.not. has_store) call check_tables(study%name, out, responses_name(study), error)
      if (has_store .and. .not. allocated(error)) then
         call begin_scratch(join_path(out, ''), scratch, error)
         if (allocated(error)) return
         folder = scratch%path
         call read_store(study, out, curve_step(designs), folder, error)
      end if
   end subroutine find_tables

   !> Sets names and labels of factors, responses and columns.
   subroutine name_axes(study, designer, data)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(study_data_t), intent(inout) :: data
      type(rig_t) :: rig
      character(:), allocatable :: unit
      integer :: k, j

      allocate (data%factors(size(study%factors)), data%responses(size(study%responses)), data%columns(size(study%columns)))
      do k = 1, size(study%factors)
         associate (axis => data%factors(k), factor => study%factors(k))
            axis%name = factor%name
            axis%head = trim(designer%heads(k))
            unit = trim(designer%units(k))
            if (factor%change == by_scale) unit = '× deck'
            axis%label = factor%name
            if (factor%change == by_delta) axis%label = 'Δ '//factor%name
            if (unit /= '') axis%label = axis%label//' ['//unit//']'
            axis%note = trim(factor%paths(1))
            do j = 2, size(factor%paths)
               axis%note = axis%note//', '//trim(factor%paths(j))
            end do
         end associate
      end do
      do k = 1, size(study%responses)
         associate (axis => data%responses(k), response => study%responses(k))
            axis%name = response%name
            axis%label = response%name
            axis%note = response%of//' of '//response%column
            if (response%of == 'value' .or. response%of == 'slope') axis%note = axis%note//' at '//str(response%at)
            if (response%of == 'difference') axis%note = trim(response%names(1))//' − '//trim(response%names(2))
            if (response%side /= '') axis%note = axis%note//', '//response%side//' wheel'
            if (response%case /= '') axis%note = axis%note//', case '//response%case
            axis%lower = response%lower
            axis%upper = response%upper
         end associate
      end do
      do k = 1, size(study%columns)
         call name_column(trim(study%columns(k)), data%columns(k))
      end do
      rig = rig_of(designer%workspace%suspension, designer%workspace%cases(1)%case)
      data%swept = rig%place_name
      if (rig%unit /= '-') data%swept = data%swept//' ['//rig%unit//']'
   end subroutine name_axes

   !> Sets the name, unit, label and sign convention of a column. Example of a label: 'Toe, left wheel [deg]'.
   subroutine name_column(column, axis)
      character(*), intent(in) :: column
      type(study_axis_t), intent(inout) :: axis
      type(quantity_t) :: quantity
      character(:), allocatable :: side

      axis%name = column
      axis%unit = unit_text(unit_of(column))
      side = ''
      if (index(column, 'left_') == 1) side = 'left'
      if (index(column, 'right_') == 1) side = 'right'
      quantity = quantity_named(column)
      if (side /= '' .and. quantity%title == column) quantity = quantity_named(column(len(side) + 2:))
      if (side /= '' .and. quantity%title == column(min(len(column), len(side) + 2):)) quantity%title = column
      axis%label = trim(quantity%title)
      axis%note = trim(quantity%sign)
      if (axis%label == '') axis%label = column
      if (side /= '' .and. axis%label /= column) axis%label = axis%label//', '//side//' wheel'
      if (unit_of(column) /= '' .and. axis%label /= column) axis%label = axis%label//' ['//unit_text(unit_of(column))//']'
   end subroutine name_column

   !> Reads the table of responses. Its factors must be those of the study.
   subroutine read_rows(study, deck_sum, path, sampler, tolerance, data, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: deck_sum, path
      type(sampler_t), intent(in) :: sampler         !! designs of the study
      real(wp), intent(in) :: tolerance              !! largest tolerance of the cases [m]
      type(study_data_t), intent(inout) :: data
      type(error_t), allocatable, intent(out) :: error
      type(lines_t) :: lines
      type(reason_t), allocatable :: reasons(:)
      character(64), allocatable :: names(:)
      real(wp), allocatable :: values(:), limits(:, :)
      logical :: are_numbers
      integer :: k, m, status, rest, d

      call open_table(path, deck_sum, lines, names, error)
      k = size(data%factors)
      m = size(data%responses)
      if (.not. allocated(error)) then
         if (size(names) /= 1 + k + m + merge(3, 2, has_limits(study))) call wrong()
      end if
      if (.not. allocated(error)) then
         if (any(names(2:k + 1) /= [character(64) :: (data%factors(d)%head, d=1, k)])) call wrong()
      end if
      if (.not. allocated(error)) then
         do d = 1, m
            call name_response(study, d, trim(names(1 + k + d)), data%responses(d))
         end do
         limits = limits_of(study, names(k + 2:k + m + 1), tolerance)
         allocate (values(size(names) - 1), data%x(k, data%designs), data%y(m, data%designs), reasons(0))
         d = 0
         do
            call next_line(lines, status)
            if (status /= 0) exit
            d = d + 1
            if (d > data%designs) exit
            call take_numbers(lines%content(:lines%used), values, rest, are_numbers)
            data%x(:, d) = values(2:k + 1)
            data%y(:, d) = values(k + 2:k + m + 1)
            if (are_numbers) are_numbers = is_design(values)
            if (.not. are_numbers) then
               call fail(error, exit_file, path//':'//str(lines%line)//': this is not design '//str(d)//' of the study; '// &
                  'run the study again')
               exit
            end if
            if (has_limits(study)) data%within = data%within + merge(1, 0, values(k + m + 2) > 0.5_wp)
            if (values(size(values)) < 0.5_wp) cycle
            data%failed = data%failed + 1
            call count_reason(lines%content(rest:lines%used), d, reasons)
         end do
         if (d /= data%designs) call wrong()
         call list_reasons(reasons, data%reasons)
      end if
      call close_table(lines)

   contains

      !> Whether the numbers of a row are possible for design d of the study: index, factors, within the limits or not, and status.
      logical function is_design(row)
         real(wp), intent(in) :: row(:)
         real(wp), parameter :: noise = 1.0e-9_wp      ! relative; a table has 15 digits, and other processors round differently
         real(wp) :: factors(k)
         integer :: f

         is_design = .false.
         if (abs(row(1) - d) > 0.0_wp .or. .not. all(ieee_is_finite(row(:k + 1)))) return
         call sample(sampler, int(d, i8), factors)
         do f = 1, k
            if (abs(row(f + 1) - factors(f)) > noise*max(abs(factors(f)), maxval(abs(data%x(f, :d))))) return
         end do
         if (.not. any(abs(row(size(row)) - [(f, f=0, design_invalid)]) <= 0.0_wp)) return
         is_design = .true.
         if (has_limits(study)) is_design = abs(row(k + m + 2) - merge(1.0_wp, 0.0_wp, row(size(row)) < 0.5_wp .and. &
            keeps(row(k + 2:k + m + 1), limits(1, :), limits(2, :)))) <= 0.0_wp
      end function is_design

      !> Reports that a table does not belong to the study.
      subroutine wrong()
         if (.not. allocated(error)) call fail(error, exit_file, path//': this is not the table of the '// &
            plural(data%designs, 'design', 'designs')//' of the study; run the study again')
      end subroutine wrong

   end subroutine read_rows

   !> Sets the name of a response (its column heading), its unit, and its label: the response name and the unit.
   subroutine name_response(study, number, head, axis)
      type(study_t), intent(in) :: study
      integer, intent(in) :: number
      character(*), intent(in) :: head
      type(study_axis_t), intent(inout) :: axis
      character(:), allocatable :: unit

      axis%name = head
      unit = unit_of(trim(study%responses(number)%column))
      if (any([character(10) :: 'slope', 'gradient', 'difference'] == study%responses(number)%of)) unit = unit_of(head)
      axis%label = study%responses(number)%name
      axis%unit = unit_text(unit)
      if (unit /= '') axis%label = axis%label//' ['//axis%unit//']'
   end subroutine name_response

   !> Counts a failure. Failures whose messages differ only in numbers are counted together. After 12 kinds, the last kind
   !> counts all further failures as 'other reasons'.
   subroutine count_reason(field, design, reasons)
      character(*), intent(in) :: field              !! field of the table, in quotes
      integer, intent(in) :: design
      type(reason_t), allocatable, intent(inout) :: reasons(:)
      type(reason_t) :: new
      integer :: k

      new%words = field
      if (len(field) > 1) new%words = field(2:len(field) - 1)
      new%pattern = ''
      do k = 1, len(new%words)
         if (scan(new%words(k:k), '0123456789.-+E') == 0) new%pattern = new%pattern//new%words(k:k)
      end do
      do k = 1, size(reasons)
         if (reasons(k)%pattern /= new%pattern) cycle
         reasons(k)%count = reasons(k)%count + 1
         return
      end do
      if (size(reasons) >= most_reasons) then
         reasons(most_reasons)%count = reasons(most_reasons)%count + 1
         reasons(most_reasons)%words = 'other reasons'
         return
      end if
      new%count = 1
      new%design = design
      reasons = [reasons, new]
   end subroutine count_reason

   !> Lists the reasons for failures: "12 designs, the first design 7: case 'sweep': no equilibrium".
   subroutine list_reasons(reasons, list)
      type(reason_t), intent(in) :: reasons(:)
      type(message_list_t), intent(inout) :: list
      integer :: k

      do k = 1, size(reasons)
         if (reasons(k)%count == 1) call list%add('design '//str(reasons(k)%design)//': '//reasons(k)%words)
         if (reasons(k)%count > 1) call list%add(str(reasons(k)%count)//' designs, the first design '//str(reasons(k)%design)// &
            ': '//reasons(k)%words)
      end do
   end subroutine list_reasons

   !> Sets the limits of the responses that have a band and no limits of their own. If a key number has several bands, the last band
   !> counts, as in a report.
   subroutine set_bands(targets, responses, axes)
      type(target_band_t), intent(in) :: targets(:)
      type(response_t), intent(in) :: responses(:)
      type(study_axis_t), intent(inout) :: axes(:)   !! axes of the responses
      character(:), allocatable :: name
      integer :: r, t

      do r = 1, size(axes)
         if (axes(r)%lower > -huge(1.0_wp) .or. axes(r)%upper < huge(1.0_wp)) cycle
         name = key_number_of(responses(r))
         if (name == '') cycle
         do t = 1, size(targets)
            if (targets(t)%quantity /= name) cycle
            axes(r)%is_target = .true.
            axes(r)%lower = targets(t)%low
            axes(r)%upper = targets(t)%high
         end do
      end do
   end subroutine set_bands

   !> Name of the key number that a response equals: a gradient with the window of the report, or a column at design. '' if the
   !> response does not equal a key number.
   pure function key_number_of(response) result(name)
      type(response_t), intent(in) :: response
      character(:), allocatable :: name

      name = ''
      if (response%of == 'gradient') then
         if (response%over == '' .and. .not. abs(response%window) > 0.0_wp) &
            name = trim(number_name(response%column, is_slope=.true.))
      else if (response%of == 'value' .and. .not. abs(response%at) > 0.0_wp) then
         name = number_at_design(response%column)
      end if
   end function key_number_of

   !> Name of the key number that equals a column at design: 'toe_deg' for 'left_toe_deg'. '' if there is none.
   pure function number_at_design(column) result(name)
      character(*), intent(in) :: column
      character(:), allocatable :: name
      integer :: first

      first = 1
      if (index(column, 'left_') == 1) first = 6
      if (index(column, 'right_') == 1) first = 7
      name = trim(number_name(column(first:), is_slope=.false.))
   end function number_at_design

end module ek_study_results
