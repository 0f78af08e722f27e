!> Text that the program wrote, against text that is kept: without what differs from one machine or run to the next.
!>
!> Numbers keep six digits, without a point if they are whole then, and below 1e-9 they are 0, without a sign or a place for it:
!> kernels of the BLAS and optimisers differ by rounding.
module ek_reference_text
   use, intrinsic :: iso_fortran_env, only: int32, int64, real32
   use ek_kinds, only: wp
   use ek_buffer, only: buffer_t
   use ek_error, only: error_t
   use ek_version, only: version
   use ek_file, only: read_whole, write_whole
   use ek_text, only: str
   use ek_scratch, only: scratch, shell_quoted
   implicit none(type, external)
   private
   public :: normalised, without_drawings, without_column, without_values, without_empty_places, condensed, decoded, numbers_of, &
      is_renewing, against_reference

   character(*), parameter :: nl = new_line('a')

contains

   !> Version, date, scratch folder, identity of a study (which holds the version) and the last digits of numbers taken out.
   function normalised(text) result(plain)
      character(*), intent(in) :: text
      character(:), allocatable :: plain
      character(*), parameter :: mark = ', study '
      character(*), parameter :: kernel = ', BLAS kernel '
      integer :: at, last

      plain = replaced(text, scratch(''), 'SCRATCH')
      plain = replaced(plain, 'elastokin '//version, 'elastokin VERSION')
      at = index(plain, mark) + len(mark)
      if (at > len(mark) .and. index(plain, 'deck checksum') > 0) plain = plain(:at - 1)//'IDENTITY'//plain(at + 16:)
      at = index(plain, kernel)                   ! of this processor
      last = at + index(plain(at + 1:)//new_line('a'), new_line('a'))
      if (at > 0) plain = plain(:at - 1)//plain(min(last, len(plain) + 1):)
      plain = rounded(undated(plain))
   end function normalised

   !> Every '2026-01-31 23:59 +0100' as DATE.
   function undated(text) result(plain)
      character(*), intent(in) :: text
      character(:), allocatable :: plain
      character(*), parameter :: form = '0000-00-00 00:00'
      integer :: at, k

      plain = text
      at = 1
      do while (at + len(form) - 1 <= len(plain))
         do k = 1, len(form)
            if (form(k:k) == '0') then
               if (index('0123456789', plain(at + k - 1:at + k - 1)) == 0) exit
            else if (plain(at + k - 1:at + k - 1) /= form(k:k)) then
               exit
            end if
         end do
         if (k > len(form)) then
            plain = plain(:at - 1)//'DATE'//plain(at + len(form):)
            if (scan(plain(min(at + 5, len(plain)):min(at + 5, len(plain))), '+-') == 1) plain = plain(:at + 3)//plain(at + 10:)
         end if
         at = at + 1
      end do
   end function undated

   !> What gnuplot drew: of every <svg …>…</svg> the label alone stays, which is the program's own.
   function without_drawings(page) result(plain)
      character(*), intent(in) :: page
      character(:), allocatable :: plain
      integer :: at, first, label, last

      plain = ''
      at = 1
      do
         first = index(page(at:), '<svg')
         if (first == 0) exit
         first = at + first - 1
         last = first + index(page(first:), '</svg>') - 1
         if (last < first) exit
         plain = plain//page(at:first - 1)//'<svg'
         label = index(page(first:last), ' aria-label="')
         if (label > 0) then
            label = first + label - 1
            plain = plain//page(label:label + len(' aria-label="') - 1 + index(page(label + len(' aria-label="'):), '"'))
         end if
         plain = plain//'/>'
         at = last + len('</svg>')
      end do
      plain = plain//page(at:)
      at = 1
      do                                       ! pictures as addresses
         first = index(plain(at:), ' src="data:')
         if (first == 0) exit
         at = at + first + len(' src="data:') - 2
         last = at + index(plain(at + 1:), '"')
         if (last == at) exit
         plain = plain(:at)//plain(last:)
      end do
   end function without_drawings

   !> CSV text with one column's values as a dash.
   function without_column(text, name) result(plain)
      character(*), intent(in) :: text, name
      character(:), allocatable :: plain, line
      integer :: at, last, column, k, first, comma

      plain = ''
      column = 0
      at = 1
      do while (at <= len(text))
         last = at + index(text(at:), nl) - 2
         if (last == at - 2) last = len(text)
         line = text(at:last)
         if (column == 0) then
            first = index(','//line//',', ','//name//',')
            if (first > 0) then
               column = 1
               do k = 1, first - 1
                  if (line(k:k) == ',') column = column + 1
               end do
            end if
         else
            first = 1
            do k = 2, column
               first = first + index(line(first:), ',')
            end do
            comma = index(line(first:)//',', ',')
            line = line(:first - 1)//'-'//line(first + comma - 1:)
         end if
         plain = plain//line//nl
         at = last + 2
      end do
   end function without_column

   !> JSON with … as the value, a number or a list, of every item with a key.
   function without_values(json, key) result(plain)
      character(*), intent(in) :: json, key
      character(:), allocatable :: plain
      character(:), allocatable :: mark
      integer :: at, first, last, depth

      mark = '"'//key//'": '
      plain = ''
      at = 1
      do
         first = index(json(at:), mark)
         if (first == 0) exit
         first = at + first - 1 + len(mark)
         depth = 0
         do last = first, len(json)
            if (json(last:last) == '[') depth = depth + 1
            if (json(last:last) == ']') depth = depth - 1
            if (depth < 0 .or. (depth == 0 .and. scan(json(last:last), ',}]') > 0)) exit
         end do
         if (json(first:first) == '[') last = last + 1
         plain = plain//json(at:first - 1)//'…'
         at = last
      end do
      plain = plain//json(at:)
   end function without_values

   !> Differences of curves as CSV, without the place of a difference of 0: with another rounding it is at another state.
   function without_empty_places(csv) result(plain)
      character(*), intent(in) :: csv
      character(:), allocatable :: plain, line
      character(*), parameter :: ending = ',0,same,states'
      integer :: at, last, comma

      plain = ''
      at = 1
      do while (at <= len(csv))
         last = at + index(csv(at:)//nl, nl) - 2
         line = csv(at:last)
         if (index(line, ending, back=.true.) == len(line) - len(ending) + 1 .and. len(line) > len(ending)) then
            line = line(:len(line) - len(ending))
            comma = index(line, ',', back=.true.)
            line = line(:comma)//'-'//ending
         end if
         plain = plain//line//nl
         at = last + 2
      end do
   end function without_empty_places

   !> The script of a picture in space, or of frames 1, 1 + step … of a moving one. A block of corners or of points of lines is
   !> written as the number of its points and of its faces or lines, and in tenths of a millimetre: mean and root mean square of
   !> x, y and z, and the mean distance from one point to the next of a line. A corner that is rounded to the other side does not
   !> show in them.
   function condensed(script, step) result(plain)
      character(*), intent(in) :: script
      integer, intent(in) :: step
      character(:), allocatable :: plain
      character(*), parameter :: last_of_frame = '      1/0 notitle'
      type(buffer_t) :: out
      real(wp) :: at_point(3), before(3), total(3), squares(3), way
      integer :: at, last, frame, points, runs, ways, status
      logical :: is_in_block, has_before

      frame = 0
      is_in_block = .false.
      at = 1
      do while (at <= len(script))
         last = at + index(script(at:), nl) - 2
         if (last == at - 2) last = len(script)
         associate (line => script(at:last))
            if (mod(frame, step) /= 0) then
               continue
            else if (.not. is_in_block) then
               call out%line(line)
               is_in_block = index(line, '$') == 1 .and. index(line, '<< EOD') > 0
               has_before = .false.
               points = 0
               runs = 0
               ways = 0
               total = 0.0_wp
               squares = 0.0_wp
               way = 0.0_wp
            else if (line == 'EOD') then
               is_in_block = .false.
               call out%line(str(points)//' points of '//str(runs)//':'// &
                  tenths(total/points)//','//tenths(sqrt(squares/points))//','//tenths([way/max(1, ways)]))
            else if (line == '') then
               has_before = .false.
            else
               read (line, *, iostat=status) at_point
               if (status /= 0) call out%line('not three numbers: '//line)
               if (.not. has_before) runs = runs + 1
               if (has_before) way = way + norm2(at_point - before)
               if (has_before) ways = ways + 1
               points = points + 1
               total = total + at_point
               squares = squares + at_point**2
               before = at_point
               has_before = .true.
            end if
            if (line == last_of_frame) frame = frame + 1
         end associate
         at = last + 2
      end do
      plain = out%text()

   contains

      function tenths(values) result(text)
         real(wp), intent(in) :: values(:)
         character(:), allocatable :: text
         integer :: k

         text = ''
         do k = 1, size(values)
            text = text//' '//str(nint(10.0_wp*values(k)))
         end do
      end function tenths

   end function condensed

   !> JSON with its base64 strings as lists of their numbers of 32 bits.
   function decoded(json) result(plain)
      character(*), intent(in) :: json
      character(:), allocatable :: plain
      character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/='
      type(buffer_t) :: out
      integer :: at, first, last

      at = 1
      do
         first = at + index(json(at:), '"')
         last = first + index(json(first:), '"') - 2
         if (first == at .or. last < first - 1) exit
         if (last - first + 1 >= 16 .and. mod(last - first + 1, 4) == 0 .and. verify(json(first:last), letters) == 0) then
            call out%add(json(at:first - 2)//'[')
            call add_list(numbers_of(json(first:last)), out)
            call out%add(']')
         else
            call out%add(json(at:last + 1))
         end if
         at = last + 2
      end do
      call out%add(json(at:))
      plain = out%text()
   end function decoded

   subroutine add_list(values, out)
      real(wp), intent(in) :: values(:)
      type(buffer_t), intent(inout) :: out
      integer :: k

      do k = 1, size(values)
         if (k > 1) call out%add(', ')
         call out%add(str(values(k), 8))
      end do
   end subroutine add_list

   !> The numbers of 32 bits, lowest byte first, of a base64 string.
   function numbers_of(text) result(values)
      character(*), intent(in) :: text
      real(wp), allocatable :: values(:)
      character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'
      integer :: bytes(3*(len(text)/4) + 3), k, l, three
      integer(int64) :: bits

      bytes = 0
      do k = 1, len(text) - 3, 4
         three = 0
         do l = k, k + 3
            three = 64*three + max(0, index(letters, text(l:l)) - 1)
         end do
         bytes(3*(k/4) + 1:3*(k/4) + 3) = [three/65536, mod(three/256, 256), mod(three, 256)]
      end do
      allocate (values((3*(len(text)/4) - count([(text(k:k) == '=', k=1, len(text))]))/4))
      do k = 1, size(values)
         bits = bytes(4*k - 3) + 256_int64*(bytes(4*k - 2) + 256_int64*(bytes(4*k - 1) + 256_int64*bytes(4*k)))
         if (bits >= 2147483648_int64) bits = bits - 4294967296_int64
         values(k) = real(transfer(int(bits, int32), 1.0_real32), wp)
      end do
   end function numbers_of

   function replaced(text, old, new) result(changed)
      character(*), intent(in) :: text, old, new
      character(:), allocatable :: changed
      integer :: at, step

      changed = ''
      at = 1
      do
         step = index(text(at:), old)
         if (step == 0) exit
         changed = changed//text(at:at + step - 2)//new
         at = at + step - 1 + len(old)
      end do
      changed = changed//text(at:)
   end function replaced

   !> Numbers with a point or an exponent, standing alone.
   function rounded(text) result(plain)
      character(*), intent(in) :: text
      character(:), allocatable :: plain
      character(*), parameter :: minus = '−'
      character(*), parameter :: part = '0123456789.+-eE'
      character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_#%0123456789'
      character(24) :: number
      real(wp) :: value
      integer :: at, last, status, used
      logical :: is_alone

      allocate (character(8*len(text)) :: plain)      ! at most 12 characters for two; grown piece by piece it fills flang's stack
      used = 0
      at = 1
      do while (at <= len(text))
         last = verify(text(at:), part) + at - 2
         if (last == at - 2) last = len(text)
         if (last < at) then
            last = scan(text(at:), part) + at - 2
            if (last == at - 2) last = len(text)
            call append(text(at:last))
            at = last + 1
            cycle
         end if
         is_alone = scan(text(at:last), '.eE') > 0 .and. scan(text(at:last), '0123456789') > 0
         if (at > 1) is_alone = is_alone .and. scan(text(at - 1:at - 1), letters) == 0
         if (last < len(text)) is_alone = is_alone .and. scan(text(last + 1:last + 1), letters) == 0
         status = 1
         if (is_alone) read (text(at:last), *, iostat=status) value
         if (status /= 0) then
            call append(text(at:last))
         else if (abs(value) < 1.0e-9_wp) then
            if (used >= len(minus)) then
               if (plain(used - len(minus) + 1:used) == minus) used = used - len(minus)
            end if
            if (used > 1) then
               if (plain(used - 1:used) == '  ') used = used - 1
            end if
            call append('0')
         else
            write (number, '(es12.5)') value
            read (number, *) value
            if (abs(value) < 9.0e5_wp .and. .not. abs(value - anint(value)) > 0.0_wp) write (number, '(i0)') nint(value)
            call append(trim(adjustl(number)))
         end if
         at = last + 1
      end do
      plain = plain(:used)

   contains

      subroutine append(piece)
         character(*), intent(in) :: piece
         plain(used + 1:used + len(piece)) = piece
         used = used + len(piece)
      end subroutine append

   end function rounded

   !> Whether the references are to be written anew: tests/support/renew_references.sh asks for it.
   logical function is_renewing()
      integer :: length
      call get_environment_variable('EK_RENEW_REFERENCES', length=length)
      is_renewing = length > 0
   end function is_renewing

   !> '' when a text is that of tests/reference/<name>; else how they differ, and how to renew it.
   function against_reference(text, name) result(differences)
      character(*), intent(in) :: text, name
      character(:), allocatable :: differences, kept
      type(error_t), allocatable :: error
      character(*), parameter :: folder = 'tests/reference/'
      integer :: status, started

      differences = ''
      if (is_renewing()) then
         call write_whole(folder//name, text, error)
         if (allocated(error)) differences = error%message
         return
      end if
      call read_whole(folder//name, kept, error)
      if (allocated(error)) kept = ''
      if (kept == text .and. len(kept) == len(text)) return
      call write_whole(scratch('found'), text, error)
      call execute_command_line('diff -u '//shell_quoted(folder//name)//' '//shell_quoted(scratch('found'))//' >'// &
         shell_quoted(scratch('differences'))//' 2>&1', exitstat=status, cmdstat=started)
      call read_whole(scratch('differences'), differences, error)
      differences = folder//name//' is another; if that is meant: tests/support/renew_references.sh'//nl// &
         differences(:min(len(differences), 6000))
   end function against_reference

end module ek_reference_text
