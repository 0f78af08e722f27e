!> elastokin solve: finds numbers of a deck for which quantities have given values:
!> the conditions of the options --for and --weight, and the target bands of the deck as weights.
module ek_solve_command
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_text, only: str, plural, quoted, suggestion
   use ek_letters, only: visible
   use ek_decimal, only: decimal, get_bounded, size_hint
   use ek_buffer, only: buffer_t
   use ek_file, only: make_folder, join_path
   use ek_system, only: facts_t, facts_of
   use ek_parameter, only: choice_t
   use ek_session, only: session_t
   use ek_direction, only: direction_t, find_directions, shared_number
   use ek_wanted_number, only: wanted_number_t, find_wanted
   use ek_condition_search, only: unknown_t, search_t
   use ek_condition_solver, only: findings_t, solve_conditions
   use ek_compromise, only: compromise_t, find_compromise
   use ek_solve_text, only: add_findings, compromise_csv
   use ek_solve_page, only: solve_page
   use ek_suspension, only: suspension_t
   use ek_deck_fragment, only: records_with
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: deck_settings_t, read_deck_settings, load_session, spare_results
   use ek_console, only: print_text
   use ek_outbox, only: outbox_t, outbox_in, keep_first
   use ek_version, only: version
   use ek_key_number, only: nothing
   use ek_target_band, only: target_band_t
   use ek_study_results, only: number_at_design
   use ek_table, only: name_length
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: case_number
   implicit none(type, external)
   private
   public :: solve_for

   character(*), parameter :: keep = 'keep'         !! value of --for: the value at the start

   integer, parameter :: max_sweeps = 40      !! largest number of sweeps; Newton's method needs about five

contains

   !> Finds the numbers of --vary that meet the conditions of --for, and writes these numbers.
   subroutine solve_for(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_convergence: not all conditions are met
      type(deck_settings_t) :: settings
      class(session_t), allocatable :: session
      type(unknown_t), allocatable :: unknowns(:)
      type(wanted_number_t), allocatable :: wanted(:)
      real(wp), allocatable :: targets(:), weights(:)
      type(search_t) :: search
      type(findings_t) :: found
      type(message_list_t) :: origins
      type(compromise_t) :: compromise
      type(suspension_t) :: before           ! at the start
      type(error_t), allocatable :: fault
      type(message_list_t) :: given
      character(:), allocatable :: path
      integer :: k

      call read_deck_settings(line, settings)
      if (settings%out == '-') then
         call fail(error, exit_usage, 'solve writes a file and cannot be used with --out -')
      else if (.not. line%has('--vary') .or. .not. line%has('--for')) then
         call fail(error, exit_usage, 'solve needs --vary path=low:high, and --for quantity=value')
      end if
      if (allocated(error)) return
      given = line%values('--vary')
      do k = 1, given%count()
         path = given%line(k)
         if (index(path, '=') > 1) call settings%paths%add(path(:index(path, '=') - 1))
      end do
      call load_session(settings, session, error)
      if (.not. allocated(error)) call spare_results('compromise', session%workspace%deck_cases, error)
      if (allocated(error)) return
      call read_unknowns(line%values('--vary'), session, unknowns, error)
      call read_conditions(line, settings, session%workspace, wanted, targets, weights, origins, fault)
      if (allocated(error) .and. allocated(fault)) error%message = error%message//new_line('a')//fault%message
      call keep_first(error, fault)
      if (allocated(error)) return
      before = session%workspace%raw
      call solve_conditions(unknowns, wanted, targets, weights, max_sweeps, session%workspace, search, found, error)
      if (allocated(error)) return
      allocate (compromise%x(size(unknowns), 0))
      if (.not. all(found%is_reached)) call find_compromise(search, max_sweeps, session%workspace, compromise)
      call write_results(settings, session, unknowns, search, found, origins, compromise, before, line%has('--page'), error)
      if (allocated(error)) return
      if (.not. all(found%is_reached)) call fail(error, exit_convergence, 'not met: '//str(count(.not. found%is_reached))// &
         ' of '//plural(size(found%is_reached), 'condition', 'conditions')//'; the numbers that come closest were written')
   end subroutine solve_for

   !> Reads the numbers of --vary with their bounds; reports all errors.
   subroutine read_unknowns(given, session, unknowns, error)
      type(message_list_t), intent(in) :: given
      type(session_t), intent(in) :: session
      type(unknown_t), allocatable, intent(out) :: unknowns(:)
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: fault
      type(direction_t), allocatable :: directions(:)
      type(message_list_t) :: mistakes, path
      type(unknown_t) :: this
      character(:), allocatable :: text, hint
      type(buffer_t) :: names
      logical :: has_low, has_high
      integer :: k, j, equals, colon

      allocate (unknowns(0))
      do k = 1, given%count()
         text = given%line(k)
         equals = index(text, '=')
         colon = equals + index(text(equals + 1:), ':')
         has_low = .false.
         has_high = .false.
         if (equals > 1 .and. colon > equals) then
            call get_bounded(trim(adjustl(text(equals + 1:colon - 1))), this%lower, has_low)
            call get_bounded(trim(adjustl(text(colon + 1:))), this%upper, has_high)
         end if
         if (.not. (has_low .and. has_high)) then
            hint = size_hint(text(equals + 1:max(equals, colon - 1)))
            if (hint == '') hint = size_hint(text(colon + 1:))
            call mistakes%add('--vary '//text//': expected path=low:high, as in point.tie_rod_inner.z=-70:-50'//hint)
            cycle
         end if
         if (.not. this%upper > this%lower) then
            call mistakes%add('--vary '//text//': the upper bound must be above the lower one')
            cycle
         end if
         path = message_list_t()
         call path%add(trim(adjustl(text(:equals - 1))))
         call find_directions(session%workspace%definition, session%deck, path, directions, fault)
         if (allocated(fault)) then
            call mistakes%add('--vary '//fault%message)
         else if (size(directions) > 1) then
            names = buffer_t()
            do j = 1, size(directions)
               call names%add(' '//directions(j)%path)
            end do
            call mistakes%add('--vary '//text//': leads to several numbers; give each its own --vary:'//names%text())
         else
            this%direction = directions(1)
            unknowns = [unknowns, this]
         end if
      end do
      do k = 2, size(unknowns)
         do j = 1, k - 1
            text = shared_number(session%workspace%definition, unknowns(j)%direction, unknowns(k)%direction)
            if (text /= '') call mistakes%add('--vary: '//text)
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine read_unknowns

   !> Writes the solution as a file of settings, the compromise of two conditions that exclude each other as a table, and prints the
   !> findings.
   subroutine write_results(settings, session, unknowns, search, found, origins, compromise, before, has_page, error)
      type(deck_settings_t), intent(in) :: settings
      type(session_t), intent(in) :: session
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      type(message_list_t), intent(in) :: origins           !! of read_conditions
      type(compromise_t), intent(in) :: compromise
      type(suspension_t), intent(in) :: before              !! model at the start
      logical, intent(in) :: has_page                       !! a page is written, too
      type(error_t), allocatable, intent(out) :: error
      type(outbox_t) :: box
      type(choice_t), allocatable :: changed(:)
      type(buffer_t) :: text, file
      character(:), allocatable :: name, records
      integer :: j

      allocate (changed(0))
      call add_findings(session%workspace, unknowns, search, found, origins, text)
      call file%line('# elastokin '//version//' solve: numbers of '//session%workspace%raw%name//' for --set-file')
      do j = 1, settings%set_files%count()
         call file%line('# found with --set-file '//visible(settings%set_files%line(j))//'; give this file after it')
      end do
      do j = 1, size(found%after)
         call file%line('# '//search%values%wanted(j)%name//' = '//str(found%after(j), 9)//', wanted '//str(search%targets(j), 9))
      end do
      do j = 1, size(unknowns)
         call file%line(unknowns(j)%direction%path//' = '//decimal(found%x(j)))
         changed = [changed, unknowns(j)%direction%found]
      end do
      call text%line('as records of the deck:')
      records = records_with(session%workspace%definition, session%workspace%x, changed)
      call text%line(records)
      box = outbox_in(settings%out)
      call make_folder(settings%out, error)
      if (allocated(error)) return
      call box%put(free_name(settings%out, session%workspace%raw%name//'_solve', settings%set_files), file%text())
      name = session%workspace%raw%name//'_compromise.csv'
      if (size(compromise%x, 2) > 0) then
         call box%put(name, compromise_csv(session%workspace, unknowns, search, compromise))
      else if (.not. box%has_failed()) then
         call box%remove([name])                           ! of an earlier step
      end if
      if (has_page) call box%put(session%workspace%raw%name//'_solve.html', solve_page(settings%file, before, session%workspace, &
         unknowns, search, found, compromise, records))
      call box%finish(error)
      if (.not. allocated(error)) call print_text(text%text(), error)
   end subroutine write_results

   !> The name of the file of settings: STEM.set, or STEM_2.set, … if --set-file gives a file of this path: it is not overwritten.
   function free_name(folder, stem, given) result(name)
      character(*), intent(in) :: folder, stem
      type(message_list_t), intent(in) :: given              !! files of --set-file
      character(:), allocatable :: name
      integer :: k

      name = stem//'.set'
      k = 1
      do while (is_given(join_path(folder, name), given))
         k = k + 1
         name = stem//'_'//str(k)//'.set'
      end do
   end function free_name

   !> Whether a path leads to one of the given files.
   logical function is_given(path, given)
      character(*), intent(in) :: path
      type(message_list_t), intent(in) :: given
      type(facts_t) :: this, other
      integer :: k

      is_given = .false.
      this = facts_of(path, follow=.true.)
      do k = 1, given%count()
         if (given%line(k) == path) is_given = .true.
         if (this%inode == 0) cycle
         other = facts_of(given%line(k), follow=.true.)
         if (other%inode == this%inode .and. other%device == this%device) is_given = .true.
      end do
   end function is_given

   !> Reads the conditions of --for, each [case:]quantity[@swept value]=value, and their weights; reports all errors.
   !> The weight of a condition is that of --weight, otherwise half the width of the target band of the deck for its quantity.
   subroutine read_conditions(line, settings, workspace, wanted, targets, weights, origins, error)
      type(command_line_t), intent(in) :: line
      type(deck_settings_t), intent(in) :: settings
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), allocatable, intent(out) :: wanted(:)
      real(wp), allocatable, intent(out) :: targets(:)       !! NaN: the value at the start
      real(wp), allocatable, intent(out) :: weights(:)       !! NaN: not given
      type(message_list_t), intent(out) :: origins           !! description of the band of each weight; '' without a band
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: given, mistakes
      type(error_t), allocatable :: fault
      character(:), allocatable :: text, whole, case, place, usual
      real(wp) :: at
      logical :: is_number
      integer :: k, j, c, mark

      usual = line%value('--at', '0')
      place = ''
      given = line%values('--for')
      allocate (wanted(given%count()), targets(given%count()))
      do k = 1, given%count()
         text = given%line(k)
         mark = index(text, '=', back=.true.)
         is_number = .false.
         targets(k) = nothing()
         if (mark > 1) is_number = trim(adjustl(text(mark + 1:))) == keep
         if (mark > 1 .and. .not. is_number) call get_bounded(trim(adjustl(text(mark + 1:))), targets(k), is_number)
         if (.not. is_number) then
            call mistakes%add('--for '//text//': expected quantity=value, case:quantity=value or quantity@swept value=value'// &
               size_hint(text(mark + 1:)))
            cycle
         end if
         whole = trim(adjustl(text(:mark - 1)))
         call split(whole, case, text, place)
         mark = index(whole, '@')
         if (index(whole, ':') == 0) case = settings%case
         if (mark == 0) place = usual
         call get_bounded(trim(adjustl(place)), at, is_number)
         if (.not. is_number) then
            call mistakes%add(trim(merge('--for', '--at ', mark > 0))//': expected a swept value, found '//quoted(place)// &
               size_hint(place))
            cycle
         end if
         c = case_number(case, workspace)
         if (c == 0) then
            call mistakes%add(unknown_case(case, settings%file, workspace))
            cycle
         end if
         call find_wanted(workspace, c, text, at, wanted(k), fault)
         if (allocated(fault)) call mistakes%add('--for '//fault%message)
         if (allocated(fault)) cycle
         do j = 1, k - 1
            if (.not. allocated(wanted(j)%name)) cycle
            if (wanted(j)%name == text .and. wanted(j)%case == wanted(k)%case .and. abs(wanted(j)%at - at) <= 0.0_wp) &
               call mistakes%add('--for: '//quoted(text)//' is given twice')
         end do
      end do
      call read_weights(line%values('--weight'), wanted, workspace, weights, mistakes)
      do k = 1, size(wanted)
         call take_band(workspace%definition%targets, wanted(k), weights(k), text)
         call origins%add(text)
      end do
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine read_conditions

   !> Sets a weight that is not given to half the width of the band of the deck (&target_band) for the quantity: a key number, or a
   !> column at design. A band with one limit has no width. If a quantity has several bands, the last band counts, as in a report.
   subroutine take_band(bands, wanted, weight, origin)
      type(target_band_t), intent(in) :: bands(:)
      type(wanted_number_t), intent(in) :: wanted
      real(wp), intent(inout) :: weight                      !! NaN: not given
      character(:), allocatable, intent(out) :: origin       !! description of the band; '' if the weight is not that of a band
      character(:), allocatable :: name
      integer :: t

      origin = ''
      if (ieee_is_finite(weight)) return
      name = ''
      if (allocated(wanted%key)) then
         name = wanted%key%name
      else if (.not. abs(wanted%at) > 0.0_wp) then
         name = number_at_design(trim(wanted%column))
      end if
      if (name == '') return
      do t = size(bands), 1, -1
         if (bands(t)%quantity == name) exit
      end do
      if (t == 0) return
      if (.not. (bands(t)%low > -huge(1.0_wp) .and. bands(t)%high < huge(1.0_wp))) return
      if (.not. bands(t)%high > bands(t)%low) return
      weight = 0.5_wp*(bands(t)%high - bands(t)%low)
      origin = ', half the width of the target band '//str(bands(t)%low, 9)//' to '//str(bands(t)%high, 9)//' of '//bands(t)%where
   end subroutine take_band

   !> Splits [case:]quantity[@swept value] into its parts; a part that is not given is ''.
   subroutine split(text, case, name, place)
      character(*), intent(in) :: text
      character(:), allocatable, intent(out) :: case, name, place
      integer :: mark

      mark = index(text, ':')
      case = text(:max(0, mark - 1))
      name = text(mark + 1:)
      place = ''
      mark = index(name, '@')
      if (mark == 0) return
      place = name(mark + 1:)
      name = trim(name(:mark - 1))
   end subroutine split

   !> Reads the weights of --weight, each [case:]quantity[@swept value]=size. Without a case or a swept value, the weight belongs to
   !> all conditions of its quantity.
   subroutine read_weights(given, wanted, workspace, weights, mistakes)
      type(message_list_t), intent(in) :: given
      type(wanted_number_t), intent(in) :: wanted(:)
      type(workspace_t), intent(in) :: workspace
      real(wp), allocatable, intent(out) :: weights(:)
      type(message_list_t), intent(inout) :: mistakes
      character(:), allocatable :: text, case, name, place
      character(name_length), allocatable :: names(:)
      real(wp) :: size_of, at
      logical :: is_number, is_used
      integer :: k, j, mark

      allocate (weights(size(wanted)), source=nothing())
      allocate (names(0))
      do j = 1, size(wanted)
         if (allocated(wanted(j)%name)) names = [character(name_length) :: names, wanted(j)%name]
      end do
      do k = 1, given%count()
         text = given%line(k)
         mark = index(text, '=', back=.true.)
         is_number = .false.
         if (mark > 1) call get_bounded(trim(adjustl(text(mark + 1:))), size_of, is_number)
         if (is_number) is_number = size_of > 0.0_wp
         if (.not. is_number) then
            call mistakes%add('--weight '//text//': expected quantity=size, a deviation above 0 in the unit of the quantity'// &
               size_hint(text(mark + 1:)))
            cycle
         end if
         call split(trim(adjustl(text(:mark - 1))), case, name, place)
         at = 0.0_wp
         if (place /= '') call get_bounded(trim(adjustl(place)), at, is_number)
         is_used = .false.
         do j = 1, size(wanted)
            if (.not. allocated(wanted(j)%name) .or. .not. is_number) cycle
            if (wanted(j)%name /= name) cycle
            if (case /= '' .and. wanted(j)%case /= case_number(case, workspace)) cycle
            if (place /= '' .and. abs(wanted(j)%at - at) > 0.0_wp) cycle
            weights(j) = size_of
            is_used = .true.
         end do
         if (.not. is_used) call mistakes%add('--weight '//text//': there is no such condition in --for'//suggestion(name, names))
      end do
   end subroutine read_weights

   !> Message about a case that the deck does not have.
   function unknown_case(name, file, workspace) result(text)
      character(*), intent(in) :: name, file
      type(workspace_t), intent(in) :: workspace
      character(:), allocatable :: text
      character(name_length) :: names(size(workspace%cases))
      integer :: j

      do j = 1, size(names)
         names(j) = workspace%cases(j)%case%name
      end do
      text = 'no case '//quoted(name)//' in '//file//', and no standard test of this name'//suggestion(name, names)
      if (size(names) == 0) text = file//': no &case group and no wheel, so there is no case to solve'
   end function unknown_case

end module ek_solve_command
