!> Conversion of numbers to strings, and operations on strings, for messages and names. Nothing here is used inside an increment.
module ek_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_letters, only: visible, printable
   implicit none(type, external)
   private
   public :: str, lower, quoted, nearest_name, suggestion, suggestion_by_part, did_you_mean, is_like, vector_text, plural, &
      printable, is_printable, spaced, replace

   !> A number as a string for messages and names: an integer (`str_integer`) or a real (`str_real`).
   interface str
      module procedure str_integer, str_real
   end interface str

contains

   !> An integer as a string without blanks.
   pure function str_integer(value) result(text)
      integer, intent(in) :: value
      character(:), allocatable :: text
      character(20) :: buffer
      integer :: rest, first

      rest = value                              ! digit by digit: a formatted write takes a microsecond
      first = len(buffer) + 1
      do
         first = first - 1
         buffer(first:first) = achar(iachar('0') + abs(mod(rest, 10)))
         rest = rest/10
         if (rest == 0) exit
      end do
      if (value < 0) then
         first = first - 1
         buffer(first:first) = '-'
      end if
      text = buffer(first:)
   end function str_integer

   !> A real as a string with `digits` significant digits (default 6), without trailing zeros: 0.25, 1E-05, infinite.
   pure function str_real(value, digits) result(text)
      real(wp), intent(in) :: value
      integer, intent(in), optional :: digits
      character(:), allocatable :: text
      character(40) :: buffer
      character(12) :: form
      integer :: n, mark, exponent

      n = 6
      if (present(digits)) n = digits
      if (ieee_is_nan(value)) then              ! before any comparison, which would trap in a debug build
         text = 'not a number'
         return
      end if
      if (abs(value) <= 0.0_wp) then
         text = '0'
         return
      end if
      if (.not. ieee_is_finite(value)) then
         text = trim(merge('-infinite', 'infinite ', value < 0.0_wp))
         return
      end if
      exponent = floor(log10(abs(value)))
      if (exponent >= -4 .and. exponent < n) then
         write (form, '(a,i0,a)') '(f40.', max(n - 1 - exponent, 0), ')'
         write (buffer, form) value
         text = trim(adjustl(buffer))
         if (index(text, '.') > 0) text = text(:verify(text, '0', back=.true.))
      else
         write (form, '(a,i0,a)') '(es40.', n - 1, merge('e3)', ')  ', abs(exponent) > 98)   ! else the E is lost
         write (buffer, form) value
         text = trim(adjustl(buffer))
         mark = index(text, 'E')
         if (mark > 0) text = text(:verify(text(:mark - 1), '0', back=.true.))//text(mark:)
         mark = index(text, '.E')
         if (mark > 0) text = text(:mark - 1)//text(mark + 1:)
      end if
      if (text(len(text):) == '.') text = text(:len(text) - 1)
      if (text(1:1) == '.') text = '0'//text
      if (index(text, '-.') == 1) text = '-0'//text(2:)
   end function str_real

   !> A vector as a string: '(1, 2.5, -3)'.
   pure function vector_text(vector, digits) result(text)
      real(wp), intent(in) :: vector(:)
      integer, intent(in), optional :: digits
      character(:), allocatable :: text
      integer :: k

      text = '('
      do k = 1, size(vector)
         if (k > 1) text = text//', '
         text = text//str_real(vector(k), digits)
      end do
      text = text//')'
   end function vector_text

   !> A string with its ASCII letters in lower case; other characters are unchanged.
   pure function lower(text) result(folded)
      character(*), intent(in) :: text
      character(len(text)) :: folded
      integer :: k, code

      do k = 1, len(text)
         code = iachar(text(k:k))
         if (code >= iachar('A') .and. code <= iachar('Z')) code = code + 32
         folded(k:k) = achar(code)
      end do
   end function lower

   !> A name between single quotes. Invisible characters in the name are shown by their numbers, as in <U+00A0>.
   pure function quoted(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      text = "'"//visible(trim(name))//"'"
   end function quoted

   !> A name with blanks instead of underscores.
   pure function spaced(name) result(text)
      character(*), intent(in) :: name
      character(len(name)) :: text
      integer :: k

      text = name
      do k = 1, len(name)
         if (name(k:k) == '_') text(k:k) = ' '
      end do
   end function spaced

   !> A count with its noun: '1 body', '3 bodies'.
   pure function plural(count, singular, many) result(text)
      integer, intent(in) :: count
      character(*), intent(in) :: singular, many
      character(:), allocatable :: text

      text = str_integer(count)//' '//many
      if (count == 1) text = '1 '//singular
   end function plural

   !> The candidate most similar to a mistyped name; '' if none is similar, and for a pattern with *. The first candidate that ends
   !> in '_name' is preferred, as left_toe_deg for toe_deg. Otherwise the result is the candidate with the smallest edit distance,
   !> which must be at most a third of the length of the name (at least 1).
   pure function nearest_name(name, candidates) result(best)
      character(*), intent(in) :: name
      character(*), intent(in) :: candidates(:)
      character(:), allocatable :: best
      integer :: k, distance, least

      best = ''
      if (name == '' .or. index(name, '*') > 0) return
      do k = 1, size(candidates)
         if (index(trim(candidates(k)), '_'//trim(name), back=.true.) /= len_trim(candidates(k)) - len_trim(name)) cycle
         if (len_trim(candidates(k)) <= len_trim(name)) cycle
         best = trim(candidates(k))
         return
      end do
      least = max(1, len_trim(name)/3) + 1
      do k = 1, size(candidates)
         if (candidates(k) == '') cycle
         distance = edit_distance(lower(trim(name)), lower(trim(candidates(k))))
         ! of two equally similar ones, prefer the same first letter: typing mistakes there are rare
         if (distance < least .or. (distance == least .and. best /= '' .and. name(:1) == candidates(k)(:1) &
            .and. index(best, name(:1)) /= 1)) then
            least = distance
            best = trim(candidates(k))
         end if
      end do
   end function nearest_name

   !> The shortest candidate that contains a name, ignoring underscores, as left_toe_deg contains lefttoe; '' if there is none.
   pure function shortest_with(name, candidates) result(best)
      character(*), intent(in) :: name
      character(*), intent(in) :: candidates(:)
      character(:), allocatable :: best
      integer, parameter :: long_enough = 5      ! letters: shorter names are in many others
      integer :: k

      best = ''
      if (len_trim(name) < long_enough) return
      do k = 1, size(candidates)
         if (index(joined(candidates(k)), joined(name)) == 0) cycle
         if (best == '' .or. len_trim(candidates(k)) < len(best)) best = trim(candidates(k))
      end do

   contains

      pure function joined(words) result(letters)
         character(*), intent(in) :: words
         character(:), allocatable :: letters
         integer :: j

         letters = ''
         do j = 1, len_trim(words)
            if (words(j:j) /= '_') letters = letters//words(j:j)
         end do
      end function joined

   end function shortest_with

   !> Phrase " (did you mean 'kt'?)" if a candidate is similar; otherwise ''.
   pure function suggestion(name, candidates) result(words)
      character(*), intent(in) :: name, candidates(:)      !! blank candidates are ignored
      character(:), allocatable :: words

      words = nearest_name(name, candidates)
      if (words /= '') words = ' (did you mean '//quoted(words)//'?)'
   end function suggestion

   !> Phrase as returned by `suggestion`. A name also counts as similar if it is part of a candidate, ignoring underscores.
   pure function suggestion_by_part(name, candidates) result(words)
      character(*), intent(in) :: name, candidates(:)      !! blank candidates are ignored
      character(:), allocatable :: words

      words = suggestion(name, candidates)
      if (words == '') words = shortest_with(name, candidates)
      if (words /= '' .and. words(:min(1, len(words))) /= ' ') words = ' (did you mean '//quoted(words)//'?)'
   end function suggestion_by_part

   !> Phrase " (did you mean 'kt'?)" if a candidate is similar; otherwise a phrase with all candidates, or ' (there is none)'. With
   !> more than 20 candidates, none of them similar, the phrase is ''.
   pure function did_you_mean(name, candidates) result(words)
      character(*), intent(in) :: name
      character(*), intent(in) :: candidates(:)    !! blank ones are ignored
      character(:), allocatable :: words
      integer, parameter :: max_listed = 20
      integer :: k

      words = suggestion(name, candidates)
      if (words /= '') return
      if (count(candidates /= '') == 0) then
         words = ' (there is none)'
      else if (count(candidates /= '') <= max_listed) then
         do k = 1, size(candidates)
            if (candidates(k) == '') cycle
            if (words /= '') words = words//', '
            words = words//trim(candidates(k))
         end do
         words = ' (known: '//words//')'
      end if
   end function did_you_mean

   !> Whether a string matches a pattern, in which * stands for any number of characters.
   pure recursive logical function is_like(text, pattern) result(fits)
      character(*), intent(in) :: text, pattern
      integer :: star, k

      star = index(pattern, '*')
      if (star == 0) then
         fits = text == pattern
         return
      end if
      fits = .false.
      if (len(text) < star - 1) return
      if (text(:star - 1) /= pattern(:star - 1)) return
      if (index(pattern(star + 1:), '*') == 0) then          ! the last one: the rest is the end of the text
         k = len_trim(text) - len_trim(pattern) + star + 1
         if (k >= star) fits = text(k:) == pattern(star + 1:)
         return
      end if
      do k = star, len(text) + 1
         fits = is_like(text(k:), pattern(star + 1:))
         if (fits) return
      end do
   end function is_like

   !> Whether a text has printable letters and line ends only.
   pure logical function is_printable(text)
      character(*), intent(in) :: text
      integer :: k

      is_printable = .true.
      do k = 1, len(text)
         is_printable = is_printable .and. (text(k:k) == new_line('a') .or. (text(k:k) >= ' ' .and. iachar(text(k:k)) < 127))
      end do
   end function is_printable

   !> The Levenshtein distance of two strings: the least number of inserted, deleted and replaced characters.
   pure integer function edit_distance(a, b) result(distance)
      character(*), intent(in) :: a, b
      integer :: row(0:len(b)), diagonal, above, i, j

      row = [(j, j=0, len(b))]
      do i = 1, len(a)
         diagonal = row(0)
         row(0) = i
         do j = 1, len(b)
            above = row(j)
            row(j) = min(above + 1, row(j - 1) + 1, diagonal + merge(0, 1, a(i:i) == b(j:j)))
            diagonal = above
         end do
      end do
      distance = row(len(b))
   end function edit_distance

   !> Replaces every occurrence of a string by another string.
   pure subroutine replace(text, old, new)
      character(:), allocatable, intent(inout) :: text
      character(*), intent(in) :: old, new
      integer :: first, at

      first = 1
      do
         at = index(text(first:), old)
         if (at == 0) return
         at = first + at - 1
         text = text(:at - 1)//new//text(at + len(old):)
         first = at + len(new)
      end do
   end subroutine replace

end module ek_text
