!> Builds the suspension and its load cases from a deck.
!>
!> Here numbers are converted from the deck's units and axes: all results are SI, x rearward.
!> All mistakes of the deck are collected; the suspension is complete only if there are none.
module ek_reader
   use ek_kinds, only: wp
   use ek_text, only: str, lower
   use ek_error, only: error_t, fail, exit_deck
   use ek_units, only: new_units
   use ek_twin, only: single
   use ek_complaint, only: place_t, place_in
   use ek_record, only: element, place_of, own_name
   use ek_group, only: group_names, group_number, is_deck_group, names_of_groups, model_group, point_group, body_group, &
      case_group, word_length, note_length, record_head, did_you_mean, is_legal_name, illegal_name, has_results
   use ek_namelist, only: check_record
   use ek_deck, only: deck_t, finish_deck
   use ek_draft, only: draft_t, complain, where_of, line_of, find_point, to_internal, choice, has_key
   use ek_reader_joints, only: read_measures, read_joints
   use ek_reserved_name, only: reserved_because
   use ek_reader_curves, only: read_curves
   use ek_reader_masses, only: read_masses
   use ek_reader_springs, only: read_scalar_elements
   use ek_reader_elements, only: read_bushings, read_loads
   use ek_reader_wheels, only: read_wheels
   use ek_reader_axle, only: read_axle, read_steering
   use ek_reader_cases, only: read_cases
   use ek_suspension, only: suspension_t
   use ek_builder, only: add_point, add_body, add_gravity
   use ek_completion, only: complete
   use ek_case, only: case_t
   implicit none(type, external)
   private
   public :: build_model

contains

   !> The model and the cases of a deck, or all its mistakes, in the order of files and lines.
   subroutine build_model(deck, suspension, cases, error, is_whole)
      type(deck_t), intent(in) :: deck
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:)     !! may be of size 0; includes cases with a mistake
      type(error_t), allocatable, intent(out) :: error
      logical, intent(out), optional :: is_whole             !! the suspension is complete: all mistakes are in cases
      type(deck_t) :: finished
      logical :: is_complete

      if (deck%is_finished()) then
         call build_finished(deck, suspension, cases, is_complete, error)
      else
         call finish_deck(deck, finished)
         call build_finished(finished, suspension, cases, is_complete, error)
      end if
      if (present(is_whole)) is_whole = is_complete
   end subroutine build_model

   !> The same for a deck already mirrored.
   subroutine build_finished(deck, suspension, cases, is_whole, error)
      type(deck_t), intent(in) :: deck
      type(suspension_t), intent(out) :: suspension
      type(case_t), allocatable, intent(out) :: cases(:)     !! may be of size 0
      logical, intent(out) :: is_whole
      type(error_t), allocatable, intent(out) :: error
      type(draft_t) :: draft
      integer :: k, before, in_cases

      is_whole = .false.
      draft%complaints = deck%complaints
      if (deck%used == 0 .and. draft%complaints%count() == 1) then     ! not a text file: only this is reported
         allocate (cases(0))
         call fail(error, exit_deck, draft%complaints%text())
         return
      end if
      if (is_study(deck)) then
         allocate (cases(0))
         call fail(error, exit_deck, where_of(deck, 1)//': this is a study (&'//deck%records(1)%group// &
            '), not a deck; run it with: elastokin study '//deck%file)
         return
      end if
      allocate (draft%cards(deck%used))
      in_cases = 0
      do k = 1, deck%used
         before = draft%complaints%count()
         call check_names(deck, k, draft)
         if (draft%cards(k)%group == case_group) in_cases = in_cases + draft%complaints%count() - before
      end do
      call read_model(deck, draft, suspension)
      call read_points(deck, draft)
      call read_curves(deck, draft)
      call read_bodies(deck, draft, suspension)
      call read_masses(deck, draft, suspension)
      call read_measures(deck, draft, suspension)
      call read_joints(deck, draft, suspension)
      call read_bushings(deck, draft, suspension)
      call read_scalar_elements(deck, draft, suspension)
      call read_wheels(deck, draft, suspension)
      call read_axle(deck, draft, suspension)
      call read_steering(deck, draft, suspension)
      call read_loads(deck, draft, suspension)
      call check_bodies(deck, draft)
      is_whole = draft%complaints%count() == in_cases
      call read_cases(deck, draft, cases)
      if (draft%complaints%count() > 0) call fail(error, exit_deck, draft%complaints%text())
      if (.not. is_whole) return
      do k = 1, deck%used
         associate (card => draft%cards(k))
            if (card%group == point_group) call add_point(suspension, trim(card%name), where_of(deck, k), card%at, card%is_used)
         end associate
      end do
      call add_gravity(suspension, draft%gravity)
      call complete(suspension)
   end subroutine build_finished

   !> Whether a file contains groups of a study and none of a deck.
   pure logical function is_study(deck)
      type(deck_t), intent(in) :: deck
      integer :: k, group

      is_study = .false.
      do k = 1, deck%used
         group = group_number(deck%records(k)%group)
         if (is_deck_group(group)) then
            is_study = .false.
            return
         end if
         is_study = is_study .or. group > 0
      end do
   end function is_study

   !> Checks group, keys, counts and types of record k, and that its name is legal and unique.
   subroutine check_names(deck, k, draft)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      character(:), allocatable :: name
      type(place_t) :: place

      associate (card => draft%cards(k), record => deck%records(k))
         card%group = group_number(record%group)
         if (.not. is_deck_group(card%group)) card%group = 0     ! a group of a study
         name = element(record, 'name', 1)
         if (len(name) <= word_length) card%name = name
         if (card%group == 0) then
            call place_of(record, 0, place)
            if (record%group /= '') call draft%complaints%add(place, 'there is no group &'//record%group// &
               did_you_mean(record%group, names_of_groups(of_deck=.true.)))
            return
         end if
         call check_record(record, card%group, record_head(card%group, trim(card%name)), draft%complaints, &
            card%text, card%is_good)
         if (card%name == '') return
         name = own_name(record)
         if (name == '') name = trim(card%name)

         if (.not. is_legal_name(name)) then
            call complain(draft, deck, k, 'name', illegal_name(name))
         else
            name = reserved_because(name, has_results(card%group))
            if (name /= '') call complain(draft, deck, k, 'name', name)
         end if
         if (card%group /= model_group) call check_new(deck, k, draft)
      end associate
   end subroutine check_names

   !> Checks that no record before k has the same name.
   subroutine check_new(deck, k, draft)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      integer :: j

      associate (card => draft%cards(k))
         do j = 1, k - 1
            if (lower(draft%cards(j)%name) /= lower(card%name)) cycle
            if (draft%cards(j)%group == card%group) then
               call complain(draft, deck, k, 'name', 'the name is given twice, first in '//line_of(deck, j, k)//doubling(j))
               exit
            else if (has_results(card%group) .and. has_results(draft%cards(j)%group)) then
               call complain(draft, deck, k, 'name', 'the name is already used by the '// &
                  trim(group_names(draft%cards(j)%group))//' in '//line_of(deck, j, k)//doubling(j)// &
                  ' (names of joints, measures and elastic elements make column names)')
               exit
            end if
         end do
      end associate

   contains

      !> If &mirror created only one of the two, its original name.
      function doubling(j) result(words)
         integer, intent(in) :: j
         character(:), allocatable :: words

         words = ''
         if ((deck%records(j)%twin == single) .eqv. (deck%records(k)%twin == single)) return
         words = ' (&mirror creates '//trim(draft%cards(k)%name)//' from '// &
            own_name(deck%records(merge(j, k, deck%records(k)%twin == single)))//')'
      end function doubling

   end subroutine check_new

   !> &model: names, units, axes.
   subroutine read_model(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, length, force, angle, axes, balance
      character(note_length) :: title
      real(wp) :: gravity
      logical :: plausible
      namelist /model/ name, title, length, force, angle, axes, balance, gravity, plausible
      character(*), parameter :: lengths(2) = [character(2) :: 'mm', 'm'], forces(2) = [character(2) :: 'N', 'kN'], &
         angles(2) = ['deg', 'rad'], frames(2) = [character(6) :: 'x-rear', 'iso'], &
         balances(3) = [character(6) :: 'none', 'spring', 'all']
      integer :: k, first, c, status

      first = 0
      suspension%name = ''
      suspension%title = ''
      suspension%balance = 'none'
      do k = 1, deck%used
         if (draft%cards(k)%group /= model_group) cycle
         if (first > 0) then
            call complain(draft, deck, k, '', 'a second &model; the first is in '//line_of(deck, first, k))
            cycle
         end if
         first = k
         name = ''
         title = ''
         length = 'mm'
         force = 'N'
         angle = 'deg'
         axes = 'x-rear'
         balance = 'none'
         gravity = 0.0_wp
         plausible = .true.
         read (draft%cards(k)%text, nml=model, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         call choice(draft, deck, k, 'length', trim(length), lengths, c)
         call choice(draft, deck, k, 'force', trim(force), forces, c)
         call choice(draft, deck, k, 'angle', trim(angle), angles, c)
         draft%units = new_units(lower(trim(length)), lower(trim(force)), lower(trim(angle)))
         call choice(draft, deck, k, 'axes', trim(axes), frames, c)
         draft%is_iso = c == 2
         call choice(draft, deck, k, 'balance', trim(balance), balances, c)
         if (gravity < 0.0_wp) &
            call complain(draft, deck, k, 'gravity', 'gravity must be 0 or more (m/s², downward), found '//str(gravity))
         draft%gravity = gravity
         suspension%name = trim(name)
         suspension%title = trim(title)
         suspension%balance = lower(trim(balance))
         suspension%is_iso = draft%is_iso
         suspension%units = draft%units
         suspension%is_plausible_wanted = plausible
         suspension%where = where_of(deck, k)
      end do
      if (first == 0 .and. all(draft%cards%group > 0)) &
         call complain_of_all(deck, draft, 'there is no &model (it gives name, units and axes)')
   end subroutine read_model

   !> &point: design positions, kept on the cards.
   subroutine read_points(deck, draft)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      character(word_length) :: name
      real(wp) :: at(3)
      namelist /point/ name, at
      integer :: k, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= point_group) cycle
         name = ''
         at = 0.0_wp
         read (draft%cards(k)%text, nml=point, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         draft%cards(k)%at = to_internal(draft, at)*draft%units%length
      end do
   end subroutine read_points

   !> &body.
   subroutine read_bodies(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, origin, centre
      real(wp) :: mass
      namelist /body/ name, origin, mass, centre
      real(wp) :: at(3), centre_at(3)
      logical :: is_found, has_centre
      integer :: k, bodies, status

      bodies = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= body_group) cycle
         name = ''
         origin = ''
         centre = ''
         mass = 1.0_wp
         read (draft%cards(k)%text, nml=body, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         bodies = bodies + 1
         draft%cards(k)%index = bodies
         call find_point(draft, deck, k, 'origin', trim(origin), at, is_found)
         call find_point(draft, deck, k, 'centre', trim(centre), centre_at, has_centre)
         if (.not. mass > 0.0_wp) call complain(draft, deck, k, 'mass', 'mass must be above 0 kg, found '//str(mass))
         if (has_key(deck, k, 'mass') .neqv. has_key(deck, k, 'centre')) call complain(draft, deck, k, &
            trim(merge('mass  ', 'centre', has_key(deck, k, 'mass'))), 'give mass and centre (of gravity) together')
         if (.not. has_key(deck, k, 'mass')) mass = 0.0_wp
         if (is_found) then
            call add_body(suspension, trim(name), where_of(deck, k), at, mass, centre_at)
         else
            call add_body(suspension, trim(name), where_of(deck, k), mass=mass, centre=centre_at)
         end if
      end do
      if (bodies == 0 .and. all(draft%cards%group > 0)) &
         call complain_of_all(deck, draft, 'there is no &body, so nothing can move')
   end subroutine read_bodies

   !> Reports a mistake of the deck as a whole.
   subroutine complain_of_all(deck, draft, what)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      character(*), intent(in) :: what
      type(place_t) :: place

      call place_in(deck%file, 0, 0, place)
      call draft%complaints%add(place, what)
   end subroutine complain_of_all

   !> Reports a body attached to nothing, unless the element attached to it was rejected.
   subroutine check_bodies(deck, draft)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      integer :: k

      if (any(draft%cards%group == 0)) return
      do k = 1, deck%used
         if (draft%cards(k)%group /= body_group .or. draft%cards(k)%is_used .or. draft%cards(k)%name == '') cycle
         call complain(draft, deck, k, '', 'no joint, bushing or spring is attached to it')
      end do
   end subroutine check_bodies

end module ek_reader
