!> readers MUTATIONS FILE...: reads that many mutations of each file with the readers of other programs' files.
!>
!> A mutation is the text with one to eight changes: a byte flipped, removed or inserted, a stretch doubled, removed or moved,
!> a line doubled or removed, a number or word replaced by a hostile one, the end cut off. Number k of a seed is always the same text.
!> The program stops with status 1 if a reader accepts a number that is not finite or a curve that does not increase, if the deck
!> made from it holds a word like NaN, or if one text takes longer than two seconds of processor time.
program readers
   use, intrinsic :: iso_fortran_env, only: int64, error_unit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: lower
   use ek_file, only: read_whole
   use ek_flaws, only: flaws_t, new_flaws
   use ek_foreign_deck, only: import_text, kind_of_text, table_kind, loads_kind
   use ek_frame_votes, only: wish_t
   use ek_property, only: property_t, parse_property
   use ek_hardpoint_sheet, only: hardpoints_t, parse_hardpoints
   use ek_kin, only: kin_t
   use ek_kin_reader, only: parse_kin
   use ek_lcf, only: lcf_t, parse_lcf
   use ek_deck, only: deck_t, parse_deck
   implicit none(type, external)
   character(*), parameter :: words(24) = [character(24) :: 'NaN', 'inf', '-Infinity', '1e999', '1e308', '-1e-320', '0', '-0', &
      '9999999999999999999999', '[', ']', '{', '}', '''', '"', '=', '$', '(', ')', ';', ',', '1e', '[UNITS]', '[FX_CURVE]']
   character(4096) :: argument
   character(:), allocatable :: text, changed
   type(error_t), allocatable :: error
   integer(int64) :: state
   integer :: mutations, files, f, k, accepted, refused, change, last
   real(wp) :: slowest, begin, end

   call get_command_argument(1, argument)
   read (argument, *) mutations
   files = command_argument_count() - 1
   accepted = 0
   refused = 0
   slowest = 0.0_wp
   do f = 1, files
      call get_command_argument(f + 1, argument)
      call read_whole(trim(argument), text, error)
      if (allocated(error)) then
         write (error_unit, '(a)') error%message
         error stop 1, quiet=.true.
      end if
      do k = 1, mutations
         state = int(k, int64)*2654435761_int64 + int(f, int64)*40503_int64 + 88172645463325252_int64
         changed = text
         last = random(8)*random(2)            ! one change in every second text
         do change = 0, last
            call mutate(changed)
         end do
         call cpu_time(begin)                  ! of the processor: other programs do not slow a text down
         call read_all(changed)
         call cpu_time(end)
         slowest = max(slowest, end - begin)
         if (slowest > 2.0_wp) call give_up('it took longer than 2 s of processor time')
      end do
   end do
   print '(i0, a, i0, a, i0, a, f0.3, a)', accepted + refused, ' texts: ', accepted, ' accepted, ', refused, &
      ' refused; the slowest took ', slowest, ' s'

contains

   !> A whole number from 0 to n − 1 (xorshift).
   integer function random(n)
      integer, intent(in) :: n
      state = ieor(state, shiftl(state, 13))
      state = ieor(state, shiftr(state, 7))
      state = ieor(state, shiftl(state, 17))
      random = int(modulo(shiftr(state, 11), int(max(n, 1), int64)))
   end function random

   !> One change.
   subroutine mutate(text)
      character(:), allocatable, intent(inout) :: text
      integer :: a, b, c

      if (len(text) < 2) then
         text = text//trim(words(1 + random(size(words))))
         return
      end if
      a = 1 + random(len(text))
      b = min(len(text), a + random(40))
      c = 1 + random(len(text))
      select case (random(10))
      case (0)
         text(a:a) = achar(random(256))
      case (1)
         text = text(:a - 1)//text(b:)
      case (2)
         text = text(:a)//achar(random(256))//text(a + 1:)
      case (3)
         text = text(:a)//text(a:b)//text(a + 1:)
      case (4)
         text = text(:c)//text(a:b)//text(c + 1:)
      case (5)
         call line_of(text, a, b)
         text = text(:b)//text(a:)
      case (6)
         call line_of(text, a, b)
         text = text(:a - 1)//text(b + 1:)
      case (7)
         call word_of(text, a, b)
         text = text(:a - 1)//trim(words(1 + random(size(words))))//text(b + 1:)
      case (8)
         call word_of(text, a, b)
         text = text(:a - 1)//text(min(c, len(text)):min(len(text), c + 7))//text(b + 1:)
      case (9)
         if (random(4) == 0) text = text(:a)
      end select
   end subroutine mutate

   !> The line with a place.
   subroutine line_of(text, first, last)
      character(*), intent(in) :: text
      integer, intent(inout) :: first
      integer, intent(out) :: last
      integer :: at

      at = first
      first = index(text(:at - 1), new_line('a'), back=.true.) + 1
      last = at + index(text(at:), new_line('a')) - 1
      if (last < at) last = len(text)
   end subroutine line_of

   !> The word at a place.
   subroutine word_of(text, first, last)
      character(*), intent(in) :: text
      integer, intent(inout) :: first
      integer, intent(out) :: last
      character(*), parameter :: gaps = ' ,;='//new_line('a')
      integer :: at

      at = first
      first = scan(text(:at), gaps, back=.true.) + 1
      last = at + scan(text(at:), gaps) - 2
      if (last < at) last = at
      first = min(first, at)
   end subroutine word_of

   !> The text by all readers: as the file that it is, and as all others.
   subroutine read_all(text)
      character(*), intent(in) :: text
      character(:), allocatable :: deck_text
      type(flaws_t) :: flaws
      type(property_t) :: property
      type(hardpoints_t) :: sheet
      type(kin_t) :: kin
      type(lcf_t) :: lcf
      integer :: kind, j, n

      flaws = new_flaws('mutation')
      call import_text(text, '/tmp/elastokin_no_such_folder/mutation', deck_text, kind, flaws)
      call judge(flaws, kind, deck_text)
      if (index(text, ' = [') > 0) then         ! TOML, by its extension
         flaws = new_flaws('mutation')
         call import_text(text, 'mutation.toml', deck_text, kind, flaws)
         call judge(flaws, kind, deck_text)
      end if
      if (kind == table_kind) then              ! with the options that a table asks for, too
         flaws = new_flaws('mutation')
         call import_text(text, 'mutation', deck_text, kind, flaws, wish_t(axle='front'))
         call judge(flaws, kind, deck_text)
         flaws = new_flaws('mutation')
         call import_text(text, 'mutation', deck_text, kind, flaws, wish_t(datum='radius:0.3', axle='front'))
         call judge(flaws, kind, deck_text)
         flaws = new_flaws('mutation')
         call import_text(text, 'mutation', deck_text, kind, flaws, wish_t(datum='ground', axle='front'))
         call judge(flaws, kind, deck_text)
         flaws = new_flaws('mutation')
         call import_text(text, 'mutation', deck_text, kind, flaws, wish_t(axes='rear,right,up', length='mm', axle='rear', &
            side='left'))
         call judge(flaws, kind, deck_text)
      end if

      flaws = new_flaws('mutation')
      call parse_property(text, property, flaws)
      if (flaws%count() == 0) then
         do j = 1, 6
            n = property%laws(j)%used
            if (n == 0) cycle
            if (.not. all(ieee_is_finite(property%laws(j)%x(:n))) .or. .not. all(ieee_is_finite(property%laws(j)%y(:n)))) &
               call give_up('a law is not finite')
            if (any(property%laws(j)%x(2:n) <= property%laws(j)%x(:n - 1))) call give_up('a law does not increase')
         end do
         if (.not. ieee_is_finite(property%free_length)) call give_up('a length is not finite')
      end if

      flaws = new_flaws('mutation')
      call parse_hardpoints(text, 1.0e-3_wp, sheet, flaws)
      if (flaws%count() == 0) then
         do j = 1, sheet%used
            if (.not. all(ieee_is_finite(sheet%points(j)%at))) call give_up('a hardpoint is not finite')
         end do
      end if

      if (kind_of_text(text) == 1) then
         flaws = new_flaws('mutation')
         call parse_kin(text, kin, flaws)
         if (flaws%count() == 0 .and. .not. all(ieee_is_finite(kin%at))) call give_up('a point is not finite')
      end if

      flaws = new_flaws('mutation')
      call parse_lcf(text, lcf, flaws)
      if (flaws%count() == 0) then
         if (.not. all(ieee_is_finite(lcf%values(:, :lcf%rows)))) call give_up('a load is not finite')
      end if
   end subroutine read_all

   !> What the import of a text gave: words of refusal, or a deck that is read.
   subroutine judge(flaws, kind, deck_text)
      type(flaws_t), intent(in) :: flaws
      integer, intent(in) :: kind
      character(*), intent(in) :: deck_text
      type(deck_t) :: deck
      type(error_t), allocatable :: error

      if (flaws%count() > 0) then
         refused = refused + 1
         if (len(flaws%text()) == 0) call give_up('a refusal without words')
         return
      end if
      accepted = accepted + 1
      if (kind /= loads_kind) then
         call parse_deck(deck_text, 'mutation', deck, error)
         if (deck%deck_errors%count() > 0) call give_up('the deck has mistakes: '//deck%deck_errors%text())
      end if
      if (has_no_number(deck_text)) call give_up('the deck has a number that is none')
   end subroutine judge

   !> Whether a deck has NaN or infinite where a number should be. Comments and strings, which quote names and titles of the file, are
   !> left out.
   logical function has_no_number(text)
      character(*), intent(in) :: text
      character(:), allocatable :: folded
      logical :: is_comment, is_string
      integer :: at

      folded = lower(text)
      is_comment = .false.
      is_string = .false.
      do at = 1, len(text)
         if (text(at:at) == new_line('a')) is_comment = .false.
         if (text(at:at) == '!' .and. .not. is_string) is_comment = .true.
         if (text(at:at) == "'" .and. .not. is_comment) is_string = .not. is_string
         if (is_comment .or. is_string) folded(at:at) = '_'
      end do
      has_no_number = index(folded, '= nan') > 0 .or. index(folded, ', nan') > 0 .or. index(folded, ',nan') > 0 .or. &
         index(folded, '= inf') > 0 .or. index(folded, ', inf') > 0 .or. index(folded, '-inf') > 0 .or. index(folded, ',inf') > 0
   end function has_no_number

   !> Keeps the text for a repetition, and stops.
   subroutine give_up(what)
      character(*), intent(in) :: what
      integer :: unit

      write (error_unit, '(a, i0, a, i0, 2a)') 'file ', f, ', mutation ', k, ': ', what
      open (newunit=unit, file='mutation.txt', access='stream', form='unformatted', status='replace')
      write (unit) changed
      close (unit)
      error stop 1, quiet=.true.
   end subroutine give_up

end program readers
