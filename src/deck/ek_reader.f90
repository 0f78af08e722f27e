!> From a deck to a design: the blueprint, its parameters, and the load cases.
!>
!> Here numbers are converted from the deck's units: x is in SI, in the axes of the deck. All errors of the deck are collected. The
!> blueprint is complete if no record other than a &case or a &target_band has an error.
module ek_reader
   use ek_kinds, only: wp, i8
   use ek_text, only: str, quoted, lower, did_you_mean
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_record, only: single, record_t, hand_over, element, place_of, own_name, is_given
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, model_group, point_group, body_group, &
      measure_group, joint_group, bushing_group, spring_groups, case_group, curve_group, mass_group, wheel_group, axle_group, &
      steering_group, load_group, manoeuvre_group, target_group, word_length, record_head, has_results, &
      load_state_group, adjuster_group, align_group, part_group
   use ek_namelist, only: check_record, name_fault
   use ek_deck, only: deck_t, finish_deck
   use ek_attachment, only: units_in_deck
   use ek_deck_reading, only: deck_reading_t, complain, complain_of_all, where_of, line_of, choice, text_of, switch_of, &
      number_of, is_second, slot, has_key, refuse
   use ek_parameter, only: parameters_t
   use ek_reader_bodies, only: read_point, read_body, read_mass, read_load, read_wheel, read_axle, read_steering
   use ek_reader_joints, only: read_measure, read_joint
   use ek_reader_manoeuvres, only: read_manoeuvre
   use ek_reader_adjusters, only: read_adjuster, read_align
   use ek_reader_parts, only: read_part, parts_at
   use ek_manoeuvre, only: has_manoeuvres, axle_fault, manoeuvre_fault
   use ek_reader_elements, only: read_curve, read_element
   use ek_target_band, only: target_band_t, read_target_band
   use ek_reader_cases, only: read_case, refuse_one_file_for_two
   use ek_load_table, only: read_tables
   use ek_suspension, only: suspension_t, point_t
   use ek_assembly, only: add_gravity, add_start_loads
   use ek_blueprint, only: blueprint_t, new_blueprint
   use ek_free_wheels, only: find_free_wheels
   use ek_markers, only: list_markers
   use ek_realise, only: new_design, realise
   use ek_case, only: case_t, manoeuvre_t
   implicit none(type, external)
   private
   public :: definition_t, read_design, build_design, build_model, find_parts_at

   !> The order of reading: groups to which others refer come first. Wheels come early if a contact point is computed, otherwise
   !> late.
   integer, parameter :: reading_order(*) = [model_group, load_state_group, point_group, curve_group, body_group, mass_group, &
      wheel_group, measure_group, joint_group, bushing_group, spring_groups, wheel_group, axle_group, steering_group, load_group, &
      manoeuvre_group, adjuster_group, align_group, part_group]

   !> A deck as a design space: realise(plan, x) is a suspension.
   type :: definition_t
      type(blueprint_t) :: plan
      type(parameters_t) :: parameters           !! the parameters, with their values in the deck (x)
      type(record_t), allocatable :: records(:)  !! of the mirrored deck, to which the parameters refer
      type(case_t), allocatable :: cases(:)      !! cases and their tables; may be of size 0; includes cases with an error
      type(target_band_t), allocatable :: targets(:)      !! target bands of key numbers, for the page of a report
   end type definition_t

contains

   !> Builds the model and the cases of a deck, or lists all its errors, in the order of files and lines.
   subroutine build_model(deck, suspension, cases, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:)     !! may be of size 0; includes cases with an error
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_whole             !! suspension complete: all errors are in cases or bands
      type(definition_t) :: design
      logical :: is_complete

      call build_design(deck, design, suspension, error, is_complete)
      call move_alloc(design%cases, cases)
      if (present(is_whole)) is_whole = is_complete
   end subroutine build_model

   !> Reads the design of a deck and realises its suspension. If the suspension cannot be realised, because the reader has missed an
   !> error in the numbers, `error` is set and `is_whole` is .false.
   subroutine build_design(deck, design, suspension, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(definition_t), intent(out) :: design
      type(suspension_t), intent(out) :: suspension
      type(error_t), allocatable, intent(out) :: error       !! exit_deck: all errors of the deck
      logical, intent(out) :: is_whole                       !! suspension complete: all errors are in cases or bands

      call read_design(deck, design, error, is_whole)
      if (.not. is_whole) return
      call new_design(design%plan, suspension)
      call realise(design%plan, design%parameters%x, suspension, is_whole)
      if (.not. (is_whole .or. allocated(error))) call fail(error, exit_deck, deck%file//': its numbers give no model (an axis '// &
         'without length, a point on the wrong side, or a number outside its range); please report this deck, as a message '// &
         'should name the line')
      if (.not. is_whole) return
      call find_free_wheels(suspension)
      call check_manoeuvres(suspension, design%cases, error)
   end subroutine build_design

   !> Adds an error for each manoeuvre whose forces the axle cannot carry at the numbers of the deck.
   subroutine check_manoeuvres(suspension, cases, error)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(inout) :: error     !! exit_deck; earlier errors are kept
      type(message_list_t) :: faults
      character(:), allocatable :: words
      integer :: k, j

      k = findloc([(has_manoeuvres(cases(k)), k=1, size(cases))], .true., dim=1)
      if (k == 0) return
      if (.not. (cases(k)%is_good .and. allocated(cases(k)%manoeuvres))) return
      words = axle_fault(suspension)
      if (words /= '') call add_fault(cases(k)%manoeuvres(1))
      do j = 1, merge(size(cases(k)%manoeuvres), 0, words == '')
         words = manoeuvre_fault(suspension, cases(k)%manoeuvres(j))
         if (words /= '') call add_fault(cases(k)%manoeuvres(j))
      end do
      if (faults%count() == 0) return
      words = faults%text()
      if (allocated(error)) words = error%message//new_line('a')//words
      if (allocated(error)) deallocate (error)
      call fail(error, exit_deck, words)

   contains

      !> Adds the present fault with the location and the name of a manoeuvre.
      subroutine add_fault(this)
         type(manoeuvre_t), intent(in) :: this
         call faults%add(this%where//': manoeuvre '//quoted(this%name)//': '//words)
      end subroutine add_fault

   end subroutine check_manoeuvres

   !> Reads the design space of a deck, or all errors of the deck.
   subroutine read_design(deck, design, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(definition_t), intent(out) :: design
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_whole             !! blueprint complete: all errors are in cases or bands
      type(deck_t) :: finished
      type(deck_reading_t) :: reading
      logical :: is_complete

      call finish_deck(deck, finished)
      reading%deck_errors = finished%deck_errors
      call hand_over(finished%records, finished%used, reading%records)
      reading%file = deck%file
      allocate (design%cases(0))
      call read_records(reading, design%cases, is_complete, error)
      call read_targets(reading, design%targets, error)
      if (is_complete) call complete_prototype(reading)
      call read_tables(finished%kept, design%cases, reading%plan%prototype, is_complete)
      design%plan = reading%plan
      design%parameters = reading%parameters
      call move_alloc(reading%records, design%records)
      if (present(is_whole)) is_whole = is_complete
   end subroutine read_design

   !> Finds the names of the parts at a point of a deck, each after a blank and in quotes. `names` is '' if there is no such point.
   subroutine find_parts_at(deck, point, names)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: point
      character(:), allocatable, intent(out) :: names
      type(deck_t) :: finished
      type(deck_reading_t) :: reading
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: error
      logical :: is_whole
      integer :: k

      names = ''
      call finish_deck(deck, finished)
      call hand_over(finished%records, finished%used, reading%records)
      reading%file = deck%file
      allocate (cases(0))
      call read_records(reading, cases, is_whole, error)
      if (.not. allocated(reading%cards)) return
      do k = 1, size(reading%records)
         if (reading%cards(k)%group /= point_group .or. reading%cards(k)%index == 0) cycle
         if (reading%cards(k)%name /= point .and. own_name(reading%records(k)) /= point) cycle
         names = parts_at(reading, reading%cards(k)%index)
         return
      end do
   end subroutine find_parts_at

   !> Reads all records except &target_band, group by group.
   subroutine read_records(reading, cases, is_whole, error)
      type(deck_reading_t), intent(inout) :: reading
      type(case_t), allocatable, intent(inout) :: cases(:)
      logical, intent(out) :: is_whole
      type(error_t), allocatable, intent(out) :: error
      type(case_t) :: case
      character(:), allocatable :: command
      integer, parameter :: early = findloc(reading_order, wheel_group, dim=1)
      logical :: has_crown
      integer :: j, k, before, in_cases

      is_whole = .false.
      if (size(reading%records) == 0 .and. reading%deck_errors%count() == 1) then     ! not a text file: only this is reported
         call fail(error, exit_deck, reading%deck_errors%text())
         return
      end if
      allocate (reading%cards(size(reading%records)), reading%parameters%list(64), reading%parameters%x(64))
      allocate (reading%vectors(3, 0:4*size(reading%records) + 1), source=0.0_wp)     ! a record makes two at most
      reading%vectors(:, 1) = [0.0_wp, 0.0_wp, 1.0_wp]
      call new_blueprint(reading%plan)
      if (is_study(reading%records)) then
         reading%k = 1
         command = 'study'
         if (any([(reading%records(k)%group == 'fit', k=1, size(reading%records))])) command = 'fit'
         call fail(error, exit_deck, where_of(reading)//': this is a '//command//' (&'//reading%records(1)%group// &
            '), not a deck; run it with: elastokin '//command//' '//reading%file)
         return
      end if
      call refuse_doubled_deck(reading, error)
      if (allocated(error)) return
      in_cases = 0
      do k = 1, size(reading%records)
         reading%k = k
         before = reading%deck_errors%count()
         call check_names(reading)
         if (reading%cards(k)%group == case_group .or. reading%records(k)%group == 'target_band') &
            in_cases = in_cases + reading%deck_errors%count() - before
      end do
      if (.not. any(reading%cards%group == model_group) .and. all(reading%cards%group > 0) .and. &
         .not. reading%deck_errors%lacks(model_group)) &
         call complain_of_all(reading, 'there is no &model (it gives name, units and axes)')
      has_crown = any([(reading%cards(k)%group == wheel_group .and. is_given(reading%records(k), 'crown_radius'), &
         k=1, size(reading%records))])
      do j = 1, size(reading_order)
         if (reading_order(j) == adjuster_group) call list_markers(reading%plan)
         do k = 1, size(reading%records)
            if (reading%cards(k)%group /= reading_order(j)) cycle
            if (reading_order(j) == wheel_group .and. ((j == early) .neqv. has_crown)) cycle
            reading%k = k
            call read_record(reading)
         end do
      end do
      if (.not. any(reading%cards%group == body_group) .and. all(reading%cards%group > 0) .and. &
         .not. reading%deck_errors%lacks(body_group)) &
         call complain_of_all(reading, 'there is no &body, so nothing can move')
      do k = 1, size(reading%records)      ! a body is attached to nothing, unless the element attached to it was rejected
         if (reading%cards(k)%group == body_group .and. .not. reading%cards(k)%is_used .and. reading%cards(k)%name /= '' .and. &
            all(reading%cards%group > 0) .and. .not. reading%deck_errors%lacks(body_group)) &
            call complain(reading, '', 'no joint, bushing or spring is attached to it', at=k)
      end do
      is_whole = reading%deck_errors%count() == in_cases
      do k = 1, size(reading%records)
         if (reading%cards(k)%group /= case_group) cycle
         reading%k = k
         call read_case(reading, case)
         cases = [cases, case]
      end do
      call refuse_one_file_for_two(reading, cases)
      if (reading%deck_errors%count() > 0) call fail(error, exit_deck, reading%deck_errors%text())
   end subroutine read_records

   !> Reads the target bands of key numbers. If the deck has bands and an error, `error` then lists all errors of the deck,
   !> including the errors of the bands.
   subroutine read_targets(reading, targets, error)
      type(deck_reading_t), intent(inout) :: reading
      type(target_band_t), allocatable, intent(out) :: targets(:)
      type(error_t), allocatable, intent(inout) :: error
      type(target_band_t) :: target
      integer :: k

      allocate (targets(0))
      if (.not. allocated(reading%cards)) return
      do k = 1, size(reading%records)
         if (reading%cards(k)%group /= target_group) cycle
         reading%k = k
         call read_target_band(reading, target)
         targets = [targets, target]
      end do
      if (size(targets) == 0 .or. reading%deck_errors%count() == 0) return
      if (allocated(error)) deallocate (error)
      call fail(error, exit_deck, reading%deck_errors%text())
   end subroutine read_targets

   !> Reads the current record with the reader of its group.
   subroutine read_record(reading)
      type(deck_reading_t), intent(inout) :: reading

      select case (reading%cards(reading%k)%group)
      case (model_group)
         call read_model(reading)
      case (load_state_group)
         call read_load_state(reading)
      case (point_group)
         call read_point(reading)
      case (curve_group)
         call read_curve(reading)
      case (body_group)
         call read_body(reading)
      case (mass_group)
         call read_mass(reading)
      case (measure_group)
         call read_measure(reading)
      case (joint_group)
         call read_joint(reading)
      case (wheel_group)
         call read_wheel(reading)
      case (axle_group)
         call read_axle(reading)
      case (steering_group)
         call read_steering(reading)
      case (load_group)
         call read_load(reading)
      case (manoeuvre_group)
         call read_manoeuvre(reading)
      case (adjuster_group)
         call read_adjuster(reading)
      case (align_group)
         call read_align(reading)
      case (part_group)
         call read_part(reading)
      case default
         call read_element(reading)
      end select
   end subroutine read_record

   !> Completes the lists of the prototype that depend on all records: points and weights.
   subroutine complete_prototype(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(point_t), allocatable :: points(:)
      integer :: k, n

      allocate (points(count(reading%cards%group == point_group)))
      n = 0
      do k = 1, size(reading%records)
         reading%k = k
         associate (card => reading%cards(k))
            if (card%group /= point_group) cycle
            n = n + 1
            points(n)%name = trim(card%name)
            points(n)%where = where_of(reading)
            points(n)%is_used = card%is_used
            reading%plan%points = [reading%plan%points, card%index]
         end associate
      end do
      call move_alloc(points, reading%plan%prototype%points)
      call add_gravity(reading%plan%prototype)
      call choose_start(reading)
      call list_markers(reading%plan)      ! again, with the weights
   end subroutine complete_prototype

   !> Selects the start state of the tests (ek_start), and adds the loads that it needs. A preload trim holds the design position,
   !> so that only adjusters, deviations of parts, and a height or a load of the deck, give another state.
   subroutine choose_start(reading)
      type(deck_reading_t), intent(inout) :: reading
      logical :: has_loads
      integer :: k

      has_loads = .false.
      associate (plan => reading%plan, model => reading%plan%prototype)
         do k = 1, size(plan%loads)
            if (model%loads(k)%is_case .or. all(model%wheels%body /= model%loads(k)%body)) cycle
            if (plan%loads(k)%force == 0) cycle
            has_loads = has_loads .or. abs(reading%parameters%x(plan%loads(k)%force + 2)) > 0.0_wp
         end do
         model%must_start = model%start /= '' .or. any(plan%start > 0)
         if (plan%start(3) > 0) then
            model%start = 'added_mass'
         else if (plan%start(2) > 0) then
            model%start = 'wheel_load'
         else if (plan%start(1) > 0) then
            model%start = 'height'
         else if (model%balance /= 'none' .and. size(model%adjusters) == 0 .and. size(plan%parts) == 0) then
            model%start = ''
         else if (model%start == '') then
            model%start = merge('loads ', 'height', has_loads)
            model%start = trim(model%start)
         end if
         if (size(model%wheels) == 0) model%start = ''
         if (model%start /= '' .and. model%start /= 'loads') call add_start_loads(model)
      end associate
   end subroutine choose_start

   !> Whether a file contains groups of a study or of a fit, and no groups of a deck.
   pure logical function is_study(records)
      type(record_t), intent(in) :: records(:)
      integer :: groups(size(records)), k

      groups = [(group_number(records(k)%group), k=1, size(records))]
      is_study = any(groups > 0) .and. .not. any([(is_deck_group(groups(k)), k=1, size(records))])
   end function is_study

   !> Checks group, keys, counts and types of the record, and that its name is legal and unique.
   subroutine check_names(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(:), allocatable :: name
      integer :: group

      associate (card => reading%cards(reading%k), record => reading%records(reading%k))
         group = group_number(record%group)
         if (.not. is_deck_group(group)) group = 0     ! a group of a study
         card%group = group
         name = element(record, 'name', 1)
         if (len(name) <= word_length) card%name = name
         card%hash = name_hash(lower(trim(card%name)))
         if (group == 0) then
            if (record%group /= '') call reading%deck_errors%add(place_of(record, 0), 'there is no group &'//record%group// &
               did_you_mean(record%group, names_of_groups(of_deck=.true.)))
            return
         end if
         call check_record(record, group, record_head(group, trim(card%name)), reading%deck_errors, card%is_good)
         if (card%name == '') return
         name = own_name(record)
         if (name == '') name = trim(card%name)
      end associate
      if (group == part_group) then         ! '<body or rod>.<point>', checked by its reader
         call check_new(reading)
         return
      end if
      name = name_fault(name, has_results(group))
      if (name /= '') call complain(reading, 'name', name)
      if (group /= model_group) call check_new(reading)
   end subroutine check_names

   !> The hash value of a string. Equal strings have equal values; different strings may have equal values too.
   pure integer function name_hash(text) result(hash)
      character(*), intent(in) :: text
      integer(i8) :: sum
      integer :: k

      sum = 0
      do k = 1, len(text)
         sum = modulo(131*sum + iachar(text(k:k)), 2147483647_i8)
      end do
      hash = int(sum)
   end function name_hash

   !> Checks that no earlier record of the group has the same name. Joints, measures and elastic elements have columns in the
   !> results, so that their names must differ across these groups too. Letter case is ignored.
   subroutine check_new(reading)
      type(deck_reading_t), intent(inout) :: reading
      integer :: j, k

      k = reading%k
      do j = 1, k - 1
         if (reading%cards(j)%hash /= reading%cards(k)%hash) cycle
         if (lower(reading%cards(j)%name) /= lower(reading%cards(k)%name)) cycle
         if (reading%cards(j)%group == reading%cards(k)%group) then
            call complain(reading, 'name', 'the name is given twice, first in '//line_of(reading, j)//doubling(j))
            exit
         else if (has_results(reading%cards(k)%group) .and. has_results(reading%cards(j)%group)) then
            call complain(reading, 'name', 'the name is already used by the '// &
               trim(group_names(reading%cards(j)%group))//' in '//line_of(reading, j)//doubling(j)// &
               ' (names of joints, measures and elastic elements make column names)')
            exit
         end if
      end do

   contains

      !> Phrase with the original name of a record, if &mirror created only one of the two records with equal names; otherwise ''.
      function doubling(j) result(words)
         integer, intent(in) :: j
         character(:), allocatable :: words

         words = ''
         if ((reading%records(j)%side == single) .eqv. (reading%records(k)%side == single)) return
         words = ' (&mirror creates '//trim(reading%cards(k)%name)//' from '// &
            own_name(reading%records(merge(j, k, reading%records(k)%side == single)))//')'
      end function doubling

   end subroutine check_new

   !> Rejects a second &model with the same name, as in a file that contains the deck twice. Only this error is reported, instead of
   !> an error for every duplicate name.
   subroutine refuse_doubled_deck(reading, error)
      type(deck_reading_t), intent(in) :: reading
      type(error_t), allocatable, intent(out) :: error
      integer :: k, first

      first = 0
      do k = 1, size(reading%records)
         if (reading%records(k)%group /= 'model') cycle
         if (first > 0) then
            if (element(reading%records(k), 'name', 1) /= element(reading%records(first), 'name', 1)) cycle
            call fail(error, exit_deck, reading%records(k)%file//':'//str(reading%records(k)%line)//': model '// &
               quoted(element(reading%records(k), 'name', 1))//': a second &model of this name; the first is in '// &
               line_of_record(reading%records(first), reading%records(k))//'. Does the file contain the deck twice?')
            return
         end if
         if (first == 0) first = k
      end do
   end subroutine refuse_doubled_deck

   !> The location of a record for a message about record `from`: 'line 12', or 'other.nml:12' if the two records are in different
   !> files.
   pure function line_of_record(record, from) result(words)
      type(record_t), intent(in) :: record, from
      character(:), allocatable :: words
      words = 'line '//str(record%line)
      if (record%file /= from%file) words = record%file//':'//str(record%line)
   end function line_of_record

   !> Reads &model: name, title, units, axes, preload trim (`balance`), gravity, and whether implausible numbers are reported.
   subroutine read_model(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(:), allocatable :: balance, start
      integer :: c, gravity

      if (is_second(reading)) return
      call choice(reading, 'length', c)
      call choice(reading, 'force', c)
      call choice(reading, 'angle', c)
      call choice(reading, 'mass', c)
      call choice(reading, 'axes', c)
      call choice(reading, 'balance', c, word=balance)
      call choice(reading, 'start', c, word=start)
      call units_in_deck(reading%records(reading%k:reading%k), reading%units, reading%plan%is_iso)
      call slot(reading, 'gravity', gravity)
      reading%plan%gravity = gravity
      call slot(reading, 'start_height', reading%plan%start(1))
      call slot(reading, 'start_load', reading%plan%start(2))
      if (has_key(reading, 'start_load')) call refuse(reading, [character(12) :: 'start', 'start_height'], &
         'start_load gives the start state; remove one of the two')
      if (start == 'loads') call refuse(reading, ['start_height'], &
         'start = ''loads'' lets the wheels settle; remove one of the two')
      call check_state(reading)
      associate (model => reading%plan%prototype)
         model%gravity = number_of(reading, 'gravity', 0.0_wp)
         model%name = text_of(reading, 'name')
         model%title = text_of(reading, 'title')
         model%balance = balance
         model%start = start
         model%is_iso = reading%plan%is_iso
         model%units = reading%units
         model%is_plausible_wanted = switch_of(reading, 'plausible')
         model%where = where_of(reading)
      end associate
   end subroutine read_model

   !> Checks that the deck has the load state that &model names, and no other start state.
   subroutine check_state(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(word_length), allocatable :: names(:)
      character(:), allocatable :: state
      integer :: k

      state = text_of(reading, 'state')
      reading%plan%prototype%state = state
      if (state == '') return
      call refuse(reading, [character(12) :: 'start', 'start_height', 'start_load'], &
         'state names the start state; remove one of the two')
      names = pack([(reading%cards(k)%name, k=1, size(reading%cards))], reading%cards%group == load_state_group)
      if (any([(lower(names(k)) == lower(state), k=1, size(names))])) return
      call complain(reading, 'state', 'there is no &load_state '//quoted(state)//did_you_mean(state, names))
   end subroutine check_state

   !> Reads &load_state: its height, wheel load or added mass, the number of the start state if &model names this load state.
   subroutine read_load_state(reading)
      type(deck_reading_t), intent(inout) :: reading
      character(*), parameter :: keys(*) = [character(10) :: 'height', 'wheel_load', 'added_mass']
      integer :: start(size(keys)), k

      if (count([(has_key(reading, trim(keys(k))), k=1, size(keys))]) /= 1) &
         call complain(reading, '', "give one of 'height', 'wheel_load' and 'added_mass'")
      do k = 1, size(keys)
         call slot(reading, trim(keys(k)), start(k))
      end do
      if (lower(text_of(reading, 'name')) == lower(reading%plan%prototype%state)) reading%plan%start = start
   end subroutine read_load_state

end module ek_reader
