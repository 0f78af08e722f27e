!> &case: the load or motion applied to the wheels or to any driver.
module ek_reader_cases
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_units, only: millimetre
   use ek_case, only: case_t, method_names, follow_names, most_increments
   use ek_twin, only: right_twin
   use ek_record, only: value_t, own_name
   use ek_namelist, only: value_fault
   use ek_group, only: wheel_group, case_group, load_group, number
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, line_of, has_key, choice, look_up
   use ek_case_words, only: words_t, read_words, find_driver, find_wheel
   use ek_reader_tests, only: read_test
   implicit none(type, external)
   private
   public :: read_cases

   ! limits of the tolerance: rounding of a metre is 1e-13 mm, and no case converges below that; above a millimetre
   ! the first guess of every state would be accepted
   real(wp), parameter :: least_tolerance = 1.0e-15_wp, most_tolerance = 1.0e-3_wp      !! m

contains

   !> All cases in the order of the deck, including those with a mistake, which is reported in the reading.
   subroutine read_cases(deck, draft, cases)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(case_t), allocatable, intent(out) :: cases(:)
      type(words_t) :: words
      real(wp) :: factor
      integer, allocatable :: records(:)     ! records of the cases
      integer :: k, c, used

      allocate (cases(count(draft%cards%group == case_group)))
      allocate (records(size(cases)))
      used = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= case_group) cycle
         used = used + 1
         records(used) = k
         call read_words(deck, k, draft, words)

         factor = 1.0_wp
         cases(used)%wheel = 1
         cases(used)%test = ''
         cases(used)%vertical = ''
         cases(used)%file = ''
         cases(used)%drive = ''
         if (has_key(deck, k, 'test')) then
            call read_test(deck, k, draft, words, cases(used), factor)
         else
            call read_drive(deck, k, draft, words, cases(used), factor)
         end if
         if (words%test /= 'table') then
            call require('from')
            call require('to')
            if (draft%cards(k)%is_good .and. .not. abs(words%to - words%from) > 0.0_wp) &
               call complain(draft, deck, k, 'to', 'from and to must differ, found '//str(words%from)//' twice')
         end if
         if (words%increments < 1 .or. words%increments > most_increments) &
            call complain(draft, deck, k, 'increments', 'increments must be 1 to '//str(most_increments)//', found '// &
               str(words%increments))
         call choice(draft, deck, k, 'method', trim(words%method), method_names, c)
         if (.not. words%tolerance > 0.0_wp) then
            call complain(draft, deck, k, 'tolerance', 'tolerance must be above 0, found '//str(words%tolerance))
         else if (words%tolerance*draft%units%length < least_tolerance .or. &
            words%tolerance*draft%units%length > most_tolerance) then
            call complain(draft, deck, k, 'tolerance', 'tolerance must be '//str(least_tolerance/millimetre)//' to '// &
               str(most_tolerance/millimetre)//' mm, found '//str(words%tolerance*draft%units%length/millimetre)//' mm')
         end if
         call choice(draft, deck, k, 'quantities', trim(words%quantities), [character(5) :: 'basic', 'all'], c)
         cases(used)%has_all = c == 2
         call read_target()
         call read_follow()

         cases(used)%name = trim(words%name)
         cases(used)%where = where_of(deck, k)
         cases(used)%is_good = draft%cards(k)%is_good
         cases(used)%from = words%from*factor
         cases(used)%to = words%to*factor
         cases(used)%increments = words%increments
         cases(used)%method = lower(trim(words%method))
         if (has_key(deck, k, 'tolerance')) cases(used)%tolerance = words%tolerance*draft%units%length
      end do
      call refuse_one_file_for_two(deck, draft, cases, records)

   contains

      subroutine require(key)
         character(*), intent(in) :: key
         if (.not. has_key(deck, k, key)) call complain(draft, deck, k, '', quoted(key)//' is missing')
      end subroutine require

      !> target = 'column=value', the value in the unit of the column.
      subroutine read_target()
         type(value_t) :: value
         character(:), allocatable :: hint
         integer :: equals

         cases(used)%target = trim(words%target)
         if (words%target == '') return
         equals = index(words%target, '=')
         value%text = trim(adjustl(words%target(equals + 1:)))
         value%is_empty = value%text == ''
         if (equals == 0 .or. words%target(:max(equals - 1, 0)) == '' .or. value_fault(value, number) /= '') then
            hint = ''
            if (index(value%text, ',') > 0) hint = ' (write the number with a decimal point)'
            call complain(draft, deck, k, 'target', &
               "target: expected 'column=value', as in 'coil_length_mm=250', found "//quoted(words%target)//hint)
         else if (words%method /= '' .and. lower(words%method) /= 'equilibrium') then
            call complain(draft, deck, k, 'target', "target: only method = 'equilibrium' can search for one, found "// &
               quoted(words%method))
         end if
      end subroutine read_target

      !> follow = 'arc': needs method 'equilibrium'; tables and targets, which need a unique factor, are not allowed.
      subroutine read_follow()
         integer :: c

         call choice(draft, deck, k, 'follow', trim(words%follow), follow_names, c)
         cases(used)%follows_arc = c == 2
         if (c /= 2) return
         if (words%test == 'table') then
            call complain(draft, deck, k, 'follow', &
               "follow = 'arc' is not allowed in test 'table': each row of the table is one state")
         else if (words%target /= '') then
            call complain(draft, deck, k, 'follow', "follow = 'arc' is not allowed with a target: a path that turns back "// &
               'passes the same factor more than once')
         end if
         if (lower(words%method) /= 'equilibrium') call complain(draft, deck, k, 'follow', &
            "follow = 'arc' needs method = 'equilibrium', found "//quoted(words%method))
      end subroutine read_follow

   end subroutine read_cases

   !> The target of a case has its own file, <case>_target: no other case may have this name.
   subroutine refuse_one_file_for_two(deck, draft, cases, records)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(case_t), intent(in) :: cases(:)
      integer, intent(in) :: records(:)      !! records of the cases
      integer :: a, b

      do a = 1, size(cases)
         if (cases(a)%target == '') cycle
         do b = 1, size(cases)
            if (lower(cases(b)%name) /= lower(cases(a)%name)//'_target') cycle
            call complain(draft, deck, records(b), 'name', &
               'the results of this case would have the same file as the target of case '// &
               quoted(cases(a)%name)//' in '//line_of(deck, records(a), records(b)))
         end do
      end do
   end subroutine refuse_one_file_for_two

   !> A case that scales loads or drives a joint directly.
   subroutine read_drive(deck, k, draft, words, this, factor)
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k
      type(draft_t), intent(inout) :: draft
      type(words_t), intent(inout) :: words
      type(case_t), intent(inout) :: this
      real(wp), intent(inout) :: factor      !! unit of from and to → SI
      character(8), parameter :: test_keys(4) = [character(8) :: 'vertical', 'phase', 'offset', 'file']
      integer :: j, loads, refused

      if (has_key(deck, k, 'load') .and. has_key(deck, k, 'drive')) then
         call complain(draft, deck, k, 'drive', 'give either load or drive, not both')
      else if (.not. (has_key(deck, k, 'load') .or. has_key(deck, k, 'drive'))) then
         call complain(draft, deck, k, '', "give 'load', 'drive' or 'test'")
      end if
      do j = 1, size(test_keys)
         if (has_key(deck, k, trim(test_keys(j)))) call complain(draft, deck, k, trim(test_keys(j)), &
            trim(test_keys(j))//": only a case with a 'test' takes this key")
      end do
      loads = count(words%load /= '')
      refused = 0
      do j = 1, loads
         if (any(words%load(:j - 1) == words%load(j))) then
            call complain(draft, deck, k, 'load', 'load '//quoted(words%load(j))//' is named twice')
            exit
         end if
         call find_load(trim(words%load(j)))
      end do
      this%load = trim(words%load(1))
      if (loads > 1) then
         allocate (this%courses(loads))
         do j = 1, loads
            this%courses(j)%load = trim(words%load(j))
            this%courses(j)%drive = ''
            if (j > 1) this%load = this%load//', '//trim(words%load(j))
         end do
      end if
      if (words%drive /= '') then
         if (lower(words%drive) == 'wheel_travel') then
            words%drive = 'wheel_travel'
            factor = draft%units%length
            if (.not. any(draft%cards%group == wheel_group)) &
               call complain(draft, deck, k, 'drive', "drive is 'wheel_travel', but there is no &wheel")
         else
            call find_driver(deck, k, draft, trim(words%drive), [character(12) :: 'wheel_travel'], factor)
         end if
      end if
      this%drive = trim(words%drive)
      if (words%wheel /= '') call find_wheel(deck, k, draft, words, words%drive == 'wheel_travel', &
         "with drive = 'wheel_travel'", this)

   contains

      subroutine find_load(name)
         character(*), intent(in) :: name
         integer :: found

         call look_up(draft, deck, k, 'load', load_group, name, found)
         if (found == 0) return
         if (draft%cards(found)%is_used) return
         ! a load duplicated by &mirror is reported once
         if (.not. (deck%records(found)%twin == right_twin .and. refused == found - 1)) call complain(draft, deck, k, 'load', &
            'load '//quoted(own_name(deck%records(found)))//' in '//line_of(deck, found, k)// &
            " is constant; a case scales loads with factor = 'case'")
         refused = found
      end subroutine find_load

   end subroutine read_drive

end module ek_reader_cases
