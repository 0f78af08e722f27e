!> From a deck to a design: the blueprint, its parameters, and the load cases.
!>
!> Here numbers are converted from the deck's units: x is in SI, in the axes of the deck. All mistakes of the deck are
!> collected; the blueprint is complete only if there are none.
module ek_reader
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_error, only: error_t, fail, exit_deck
   use ek_units, only: units_t, millimetre, degree
   use ek_record, only: single, record_t, element, place_of, own_name
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, model_group, point_group, body_group, &
      measure_group, joint_group, bushing_group, spring_groups, spring_group, damper_group, stop_group, torsion_group, case_group, &
      curve_group, mass_group, wheel_group, axle_group, steering_group, load_group, &
      word_length, record_head, did_you_mean, has_results
   use ek_namelist, only: check_record, name_fault
   use ek_deck, only: deck_t, finish_deck
   use ek_draft, only: draft_t, complain, complain_of_all, where_of, line_of, choice, text_of, switch_of, &
      number_of, is_second, slot
   use ek_parameter, only: parameters_t
   use ek_reader_bodies, only: read_point, read_body, read_mass, read_load, read_wheel, read_axle, read_steering
   use ek_reader_joints, only: read_measure, read_joint
   use ek_reader_elements, only: read_curve, read_spring, read_damper, read_stop, read_torsion, read_bushing
   use ek_reader_cases, only: read_case, refuse_one_file_for_two
   use ek_load_table, only: read_tables
   use ek_suspension, only: suspension_t, point_t
   use ek_assembly, only: add_gravity
   use ek_blueprint, only: blueprint_t, new_blueprint
   use ek_realise, only: new_design, realise
   use ek_case, only: case_t
   implicit none(type, external)
   private
   public :: design_t, read_design, build_model

   !> The order of reading: what others refer to comes first.
   integer, parameter :: reading_order(*) = [model_group, point_group, curve_group, body_group, mass_group, measure_group, &
      joint_group, bushing_group, spring_groups, wheel_group, axle_group, steering_group, load_group]

   !> A deck as a design space: realise(plan, x) is a suspension.
   type :: design_t
      type(blueprint_t) :: plan
      type(parameters_t) :: parameters           !! with their values in the deck, x
      type(record_t), allocatable :: records(:)  !! of the mirrored deck, to which the parameters refer
      type(case_t), allocatable :: cases(:)      !! with their tables; may be of size 0; includes cases with a mistake
   end type design_t

contains

   !> The model and the cases of a deck, or all its mistakes, in the order of files and lines.
   subroutine build_model(deck, suspension, cases, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:)     !! may be of size 0; includes cases with a mistake
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_whole             !! the suspension is complete: all mistakes are in cases
      type(design_t) :: design
      logical :: is_complete, is_good

      call read_design(deck, design, error, is_complete)
      call move_alloc(design%cases, cases)
      if (is_complete) then
         call new_design(design%plan, suspension)
         call realise(design%plan, design%parameters%x, suspension, is_good)
      end if
      if (present(is_whole)) is_whole = is_complete
   end subroutine build_model

   !> The design space of a deck, or all mistakes of the deck.
   subroutine read_design(deck, design, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(design_t), intent(out) :: design
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_whole             !! the blueprint is complete: all mistakes are in cases
      type(deck_t) :: finished
      type(draft_t) :: draft
      logical :: is_complete

      call finish_deck(deck, finished)
      draft%complaints = finished%complaints
      draft%records = finished%records(:finished%used)
      draft%file = deck%file
      allocate (design%cases(0))
      call read_records(draft, design%cases, is_complete, error)
      if (is_complete) call complete_prototype(draft)
      call read_tables(design%cases, draft%plan%prototype, is_complete)
      design%plan = draft%plan
      design%parameters = draft%parameters
      call move_alloc(draft%records, design%records)
      if (present(is_whole)) is_whole = is_complete
   end subroutine read_design

   !> All records, group by group.
   subroutine read_records(draft, cases, is_whole, error)
      type(draft_t), intent(inout) :: draft
      type(case_t), allocatable, intent(inout) :: cases(:)
      logical, intent(out) :: is_whole
      type(error_t), allocatable, intent(out) :: error
      type(case_t) :: case
      integer :: j, k, before, in_cases

      is_whole = .false.
      if (size(draft%records) == 0 .and. draft%complaints%count() == 1) then     ! not a text file: only this is reported
         call fail(error, exit_deck, draft%complaints%text())
         return
      end if
      allocate (draft%cards(size(draft%records)), draft%parameters%list(64), draft%parameters%x(64))
      allocate (draft%vectors(3, 0:4*size(draft%records) + 1), source=0.0_wp)     ! a record makes two at most
      draft%vectors(:, 1) = [0.0_wp, 0.0_wp, 1.0_wp]
      call new_blueprint(draft%plan)
      if (is_study(draft%records)) then
         draft%k = 1
         call fail(error, exit_deck, where_of(draft)//': this is a study (&'//draft%records(1)%group// &
            '), not a deck; run it with: elastokin study '//draft%file)
         return
      end if
      in_cases = 0
      do k = 1, size(draft%records)
         draft%k = k
         before = draft%complaints%count()
         call check_names(draft)
         if (draft%cards(k)%group == case_group) in_cases = in_cases + draft%complaints%count() - before
      end do
      if (.not. any(draft%cards%group == model_group) .and. all(draft%cards%group > 0)) &
         call complain_of_all(draft, 'there is no &model (it gives name, units and axes)')
      do j = 1, size(reading_order)
         do k = 1, size(draft%records)
            if (draft%cards(k)%group /= reading_order(j)) cycle
            draft%k = k
            call read_record(draft)
         end do
      end do
      if (.not. any(draft%cards%group == body_group) .and. all(draft%cards%group > 0)) &
         call complain_of_all(draft, 'there is no &body, so nothing can move')
      do k = 1, size(draft%records)      ! a body is attached to nothing, unless the element attached to it was rejected
         if (draft%cards(k)%group == body_group .and. .not. draft%cards(k)%is_used .and. draft%cards(k)%name /= '' .and. &
            all(draft%cards%group > 0)) call complain(draft, '', 'no joint, bushing or spring is attached to it', at=k)
      end do
      is_whole = draft%complaints%count() == in_cases
      do k = 1, size(draft%records)
         if (draft%cards(k)%group /= case_group) cycle
         draft%k = k
         call read_case(draft, case)
         cases = [cases, case]
      end do
      call refuse_one_file_for_two(draft, cases)
      if (draft%complaints%count() > 0) call fail(error, exit_deck, draft%complaints%text())
   end subroutine read_records

   !> The record being read.
   subroutine read_record(draft)
      type(draft_t), intent(inout) :: draft

      select case (draft%cards(draft%k)%group)
      case (model_group)
         call read_model(draft)
      case (point_group)
         call read_point(draft)
      case (curve_group)
         call read_curve(draft)
      case (body_group)
         call read_body(draft)
      case (mass_group)
         call read_mass(draft)
      case (measure_group)
         call read_measure(draft)
      case (joint_group)
         call read_joint(draft)
      case (bushing_group)
         call read_bushing(draft)
      case (spring_group)
         call read_spring(draft)
      case (damper_group)
         call read_damper(draft)
      case (stop_group)
         call read_stop(draft)
      case (torsion_group)
         call read_torsion(draft)
      case (wheel_group)
         call read_wheel(draft)
      case (axle_group)
         call read_axle(draft)
      case (steering_group)
         call read_steering(draft)
      case (load_group)
         call read_load(draft)
      end select
   end subroutine read_record

   !> The lists of the prototype that follow from the whole deck: points and weights.
   subroutine complete_prototype(draft)
      type(draft_t), intent(inout) :: draft
      type(point_t) :: point
      integer :: k

      do k = 1, size(draft%records)
         draft%k = k
         associate (card => draft%cards(k))
            if (card%group /= point_group) cycle
            point%name = trim(card%name)
            point%where = where_of(draft)
            point%is_used = card%is_used
            draft%plan%prototype%points = [draft%plan%prototype%points, point]
            draft%plan%points = [draft%plan%points, card%index]
         end associate
      end do
      call add_gravity(draft%plan%prototype)
   end subroutine complete_prototype

   !> Whether a file contains groups of a study and none of a deck.
   pure logical function is_study(records)
      type(record_t), intent(in) :: records(:)
      integer :: groups(size(records)), k

      groups = [(group_number(records(k)%group), k=1, size(records))]
      is_study = any(groups > 0) .and. .not. any([(is_deck_group(groups(k)), k=1, size(records))])
   end function is_study

   !> Checks group, keys, counts and types of the record, and that its name is legal and unique.
   subroutine check_names(draft)
      type(draft_t), intent(inout) :: draft
      character(:), allocatable :: name
      integer :: group

      associate (card => draft%cards(draft%k), record => draft%records(draft%k))
         group = group_number(record%group)
         if (.not. is_deck_group(group)) group = 0     ! a group of a study
         card%group = group
         name = element(record, 'name', 1)
         if (len(name) <= word_length) card%name = name
         if (group == 0) then
            if (record%group /= '') call draft%complaints%add(place_of(record, 0), 'there is no group &'//record%group// &
               did_you_mean(record%group, names_of_groups(of_deck=.true.)))
            return
         end if
         call check_record(record, group, record_head(group, trim(card%name)), draft%complaints, card%is_good)
         if (card%name == '') return
         name = own_name(record)
         if (name == '') name = trim(card%name)
      end associate
      name = name_fault(name, has_results(group))
      if (name /= '') call complain(draft, 'name', name)
      if (group /= model_group) call check_new(draft)
   end subroutine check_names

   !> Checks that no earlier record has the same name.
   subroutine check_new(draft)
      type(draft_t), intent(inout) :: draft
      integer :: j, k

      k = draft%k
      do j = 1, k - 1
         if (lower(draft%cards(j)%name) /= lower(draft%cards(k)%name)) cycle
         if (draft%cards(j)%group == draft%cards(k)%group) then
            call complain(draft, 'name', 'the name is given twice, first in '//line_of(draft, j)//doubling(j))
            exit
         else if (has_results(draft%cards(k)%group) .and. has_results(draft%cards(j)%group)) then
            call complain(draft, 'name', 'the name is already used by the '// &
               trim(group_names(draft%cards(j)%group))//' in '//line_of(draft, j)//doubling(j)// &
               ' (names of joints, measures and elastic elements make column names)')
            exit
         end if
      end do

   contains

      !> If &mirror created only one of the two, its original name.
      function doubling(j) result(words)
         integer, intent(in) :: j
         character(:), allocatable :: words

         words = ''
         if ((draft%records(j)%side == single) .eqv. (draft%records(k)%side == single)) return
         words = ' (&mirror creates '//trim(draft%cards(k)%name)//' from '// &
            own_name(draft%records(merge(j, k, draft%records(k)%side == single)))//')'
      end function doubling

   end subroutine check_new

   !> &model: names, units, axes.
   subroutine read_model(draft)
      type(draft_t), intent(inout) :: draft
      character(*), parameter :: balances(3) = [character(6) :: 'none', 'spring', 'all']
      integer :: length, force, angle, frame, balance, gravity

      if (is_second(draft)) return
      call choice(draft, 'length', [character(2) :: 'mm', 'm'], length, default=1)
      call choice(draft, 'force', [character(2) :: 'N', 'kN'], force, default=1)
      call choice(draft, 'angle', ['deg', 'rad'], angle, default=1)
      call choice(draft, 'axes', [character(6) :: 'x-rear', 'iso'], frame, default=1)
      call choice(draft, 'balance', balances, balance, default=1)
      draft%units = units_t(merge(1.0_wp, millimetre, length == 2), merge(1000.0_wp, 1.0_wp, force == 2), &
         merge(1.0_wp, degree, angle == 2))
      draft%plan%length_unit = draft%units%length
      draft%plan%force_unit = draft%units%force
      draft%plan%angle_unit = draft%units%angle
      draft%plan%is_iso = frame == 2
      call slot(draft, 'gravity', 1.0_wp, gravity)
      draft%plan%gravity = gravity
      associate (model => draft%plan%prototype)
         model%gravity = number_of(draft, 'gravity', 0.0_wp)
         model%name = text_of(draft, 'name')
         model%title = text_of(draft, 'title')
         model%balance = trim(balances(max(balance, 1)))
         model%is_iso = frame == 2
         model%units = draft%units
         model%is_plausible_wanted = switch_of(draft, 'plausible', .true.)
         model%where = where_of(draft)
      end associate
   end subroutine read_model

end module ek_reader
