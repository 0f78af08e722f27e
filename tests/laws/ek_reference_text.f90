!> Text that the program wrote, against text that is kept: without what differs from one machine or run to the next.
!>
!> Numbers keep six digits, and below 1e-9 they are 0: kernels of the BLAS and optimisers differ by rounding.
module ek_reference_text
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_version, only: version
   use ek_file, only: read_whole, write_whole
   use ek_scratch, only: scratch, shell_quoted
   implicit none(type, external)
   private
   public :: normalised, without_drawings, without_column, is_renewing, against_reference

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

   !> Every '2026-01-31 23:59' as DATE.
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
         if (k > len(form)) plain = plain(:at - 1)//'DATE'//plain(at + len(form):)
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
            call append('0')
         else
            write (number, '(es12.5)') value
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
