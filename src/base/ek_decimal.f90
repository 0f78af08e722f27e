!> Conversion of a real to a string with 15 significant digits, and back: fast, and correctly rounded.
!>
!> gfortran's formatted write takes about a microsecond per number; writing a table of 600 states and 70 columns would take longer
!> than the solution of these states.
!>
!> A double is m·2^b with an integer m < 2^53, so with 10^q = 5^q·2^q
!>
!>     digits = x·10^q = m·5^q · 2^(b+q)
!>
!> is an integer product shifted to the right. The product is exact while 5^q < 2^63 (q ≤ 27, |x| ≥ 1e-13). For larger q, 5^q is
!> truncated to 63 bits, which bounds the digits from both sides; if the bounds round to different numbers, the (slow, exact)
!> formatted write decides. The formatted write also handles values outside 1e-40 ≤ |x| < 1e15. Every string is therefore the
!> correctly rounded decimal; a tie goes to the even digit, as in the formatted write.
module ek_decimal
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan, ieee_positive_inf, ieee_negative_inf
   use ek_kinds, only: wp, i8
   implicit none(type, external)
   private
   public :: decimal, rounded, put_decimal, get_decimal, get_bounded, size_hint, checked_number, longest_decimal, number_limit

   integer, parameter :: longest_decimal = 24       !! most characters of one number
   integer, parameter :: i16 = selected_int_kind(38)
   integer, parameter :: kept = 15                  !! significant digits
   integer(i8), parameter :: full = 10_i8**kept
   integer, parameter :: smallest = -40             !! lowest power of ten of the fast method
   integer, parameter :: most = kept - 1 - smallest !! largest power q
   integer, parameter :: mantissa_bits = digits(1.0_wp) - 1
   integer, parameter :: bias = maxexponent(1.0_wp) - 1 + mantissa_bits

   integer :: k, l                                  ! implied-do indices of the tables here, not used elsewhere
   integer(i16), parameter :: five(0:most) = [(5_i16**k, k=0, most)]
   integer, parameter :: cut(0:most) = [(max(0, 65 - leadz(five(k))), k=0, most)]
   integer(i16), parameter :: top(0:most) = [(shiftr(five(k), cut(k)), k=0, most)]
   real(wp), parameter :: ten(smallest:kept) = [(10.0_wp**k, k=smallest, kept)]
   integer(i8), parameter :: largest = 17976931348623157_i8     !! first 17 digits of the largest double, about 1.797e308
   real(wp), parameter :: number_limit = 1.0e30_wp  !! limit of the magnitude of numbers in decks, settings and options
   real(wp), parameter :: exact_ten(0:22) = [(10.0_wp**k, k=0, 22)]   !! powers of ten without a rounding error
   character(2), parameter :: pair(0:99) = &
      [((achar(iachar('0') + k)//achar(iachar('0') + l), l=0, 9), k=0, 9)]

contains

   !> Appends the number x to a buffer: -102.918270651123, 0.25, 3, 1.23456789012345e-09, nan, inf, -inf. Numbers with 1e-5 ≤ |x| <
   !> 1e15 have no exponent. There are no trailing zeros; both zeros are `0`.
   pure subroutine put_decimal(x, buffer, used)
      real(wp), intent(in) :: x
      character(*), intent(inout) :: buffer     !! with room for longest_decimal more
      integer, intent(inout) :: used            !! characters of the buffer in use
      integer(i8) :: bits, number
      integer :: decade, exponent
      character(kept) :: text

      bits = transfer(x, bits)
      exponent = int(ibits(bits, mantissa_bits, 11))
      if (exponent == 2047 .and. ibits(bits, 0, mantissa_bits) /= 0) then
         call put('nan', buffer, used)
         return
      end if
      bits = ibclr(bits, 63)
      if (bits == 0) then
         call put('0', buffer, used)
         return
      end if
      if (transfer(x, bits) < 0) call put('-', buffer, used)
      if (exponent == 2047) then
         call put('inf', buffer, used)
         return
      end if
      call find_digits(transfer(bits, x), number, decade)
      call spell(number, text)
      call put_digits(text, decade, buffer, used)
   end subroutine put_decimal

   !> The number x as a string without blanks, in the form that put_decimal appends to a buffer.
   pure function decimal(x) result(text)
      real(wp), intent(in) :: x
      character(:), allocatable :: text
      character(longest_decimal) :: buffer
      integer :: used

      used = 0
      call put_decimal(x, buffer, used)
      text = buffer(:used)
   end function decimal

   !> Appends a string to the buffer.
   pure subroutine put(word, buffer, used)
      character(*), intent(in) :: word
      character(*), intent(inout) :: buffer
      integer, intent(inout) :: used

      buffer(used + 1:used + len(word)) = word
      used = used + len(word)
   end subroutine put

   !> Finds the 15 digits of a positive finite x as an integer: x ≈ number·10^(decade − 14).
   pure subroutine find_digits(x, number, decade)
      real(wp), intent(in) :: x
      integer(i8), intent(out) :: number        !! 10^14 ≤ number < 10^15
      integer, intent(out) :: decade
      integer(i8) :: bits
      integer(i16) :: mantissa, product, half
      integer :: exponent, power, shift

      if (.not. (x >= ten(smallest) .and. x < ten(kept))) then
         call find_digits_slowly(x, number, decade)
         return
      end if
      bits = transfer(x, bits)
      exponent = int(shiftr(bits, mantissa_bits)) - bias
      mantissa = ibset(ibits(bits, 0, mantissa_bits), mantissa_bits)
      ! log10(2) = 0.30103 (78913/2^18): the decade or the one below it
      decade = shifta((exponent + mantissa_bits)*78913, 18)
      if (x >= ten(decade + 1)) decade = decade + 1
      power = kept - 1 - decade
      shift = -(exponent + power) - cut(power)
      half = shiftl(1_i16, shift - 1)
      product = mantissa*top(power) + half
      number = int(shiftr(product, shift), i8)
      if (cut(power) > 0) then
         if (int(shiftr(product + mantissa, shift), i8) /= number) then
            call find_digits_slowly(x, number, decade)
            return
         end if
      else if (ibits(product, 0, shift) == 0) then
         number = ibclr(number, 0)
      end if
      if (number >= full) then
         number = full/10
         decade = decade + 1
      end if
   end subroutine find_digits

   !> Finds the digits as find_digits does, but by gfortran's formatted write.
   pure subroutine find_digits_slowly(x, number, decade)
      real(wp), intent(in) :: x
      integer(i8), intent(out) :: number
      integer, intent(out) :: decade
      character(24) :: text
      integer(i8) :: first, rest

      write (text, '(es24.14e3)') x             ! '    1.23456789012345E-009'
      read (text, '(t4, i1, 1x, i14, 1x, i4)') first, rest, decade
      number = first*(full/10) + rest
   end subroutine find_digits_slowly

   !> Writes an integer as 15 digits, four at a time.
   pure subroutine spell(number, text)
      integer(i8), intent(in) :: number
      character(kept), intent(out) :: text
      integer :: high, low

      high = int(number/100000000_i8)           ! 7 digits
      low = int(number - high*100000000_i8)     ! 8 digits
      text(1:1) = achar(iachar('0') + high/1000000)
      text(2:3) = pair(mod(high/10000, 100))
      call spell_four(mod(high, 10000), text(4:7))
      call spell_four(low/10000, text(8:11))
      call spell_four(mod(low, 10000), text(12:15))
   end subroutine spell

   !> Writes an integer below 10000 with four digits.
   pure subroutine spell_four(number, text)
      integer, intent(in) :: number
      character(4), intent(out) :: text

      text(1:2) = pair(number/100)
      text(3:4) = pair(mod(number, 100))
   end subroutine spell_four

   !> Appends digits with the decimal point at its position.
   pure subroutine put_digits(text, decade, buffer, used)
      character(kept), intent(in) :: text
      integer, intent(in) :: decade
      character(*), intent(inout) :: buffer
      integer, intent(inout) :: used
      integer :: last, rest

      do last = kept, 2, -1
         if (text(last:last) /= '0') exit
      end do
      if (decade >= 0 .and. decade < kept) then
         buffer(used + 1:used + kept) = text
         if (last <= decade + 1) then
            used = used + decade + 1
         else
            buffer(used + decade + 2:used + decade + 2) = '.'
            buffer(used + decade + 3:used + kept + 1) = text(decade + 2:)
            used = used + last + 1
         end if
      else if (decade < 0 .and. decade >= -5) then
         buffer(used + 1:used + 6) = '0.0000'
         used = used + 1 - decade
         buffer(used + 1:used + kept) = text
         used = used + last
      else
         buffer(used + 1:used + 1) = text(1:1)
         buffer(used + 2:used + 2) = '.'
         buffer(used + 3:used + kept + 1) = text(2:)
         used = used + merge(1, last + 1, last == 1)
         buffer(used + 1:used + 1) = 'e'
         buffer(used + 2:used + 2) = merge('-', '+', decade < 0)
         used = used + 2
         rest = abs(decade)
         if (rest >= 100) then
            buffer(used + 1:used + 1) = achar(iachar('0') + rest/100)
            used = used + 1
         end if
         buffer(used + 1:used + 2) = pair(mod(rest, 100))
         used = used + 2
      end if
   end subroutine put_digits

   !> Reads a number written by put_decimal or by hand as the nearest double; blanks around it are allowed.
   pure subroutine get_decimal(text, x, is_number)
      character(*), intent(in) :: text
      real(wp), intent(out) :: x
      logical, intent(out) :: is_number         !! false: not a number, or beyond the largest double; x is nan
      integer(i8) :: number
      integer :: at, last, decade, places, figures, mark, sign, status, place

      x = ieee_value(x, ieee_quiet_nan)
      is_number = .false.
      last = len_trim(text)
      if (last == 0) return
      do at = 1, last
         if (text(at:at) /= ' ') exit
      end do
      if (iachar(text(last:last)) > iachar('9')) then          ! a word
         is_number = .true.
         select case (text(at:last))
         case ('nan', 'NaN', 'NAN')
            return
         case ('inf', '+inf', 'Infinity', 'INF')
            x = ieee_value(x, ieee_positive_inf)
            return
         case ('-inf', '-Infinity', '-INF')
            x = ieee_value(x, ieee_negative_inf)
            return
         end select
         is_number = .false.
      end if
      mark = at
      sign = 1
      if (text(at:at) == '-') sign = -1
      if (text(at:at) == '-' .or. text(at:at) == '+') at = at + 1
      number = 0
      places = 0
      figures = 0
      call take_digits(text(:last), at, number, figures)
      if (at <= last) then
         if (text(at:at) == '.') then
            at = at + 1
            places = figures
            call take_digits(text(:last), at, number, figures)
            places = figures - places
         end if
      end if
      if (figures == 0) return
      decade = 0
      if (at <= last) then
         if (scan(text(at:at), 'eEdD') == 0 .or. at == last) return
         if (verify(text(at + 1:at + 1), '+-0123456789') > 0) return
         if (scan(text(at + 1:last), '0123456789') == 0) return
         if (verify(text(at + 2:last), '0123456789') > 0 .or. last - at > 4) return
         do place = at + 1, last                               ! at most a sign and three digits
            if (verify(text(place:place), '+-') > 0) decade = 10*decade + iachar(text(place:place)) - iachar('0')
         end do
         if (text(at + 1:at + 1) == '-') decade = -decade
      end if
      decade = decade - places
      is_number = .true.
      if (number < 2_i8**53 .and. figures <= 18 .and. abs(decade) <= 22) then
         ! one operation on two exact numbers: correctly rounded
         x = real(sign*number, wp)
         if (decade < 0) then
            x = x/exact_ten(-decade)
         else
            x = x*exact_ten(decade)
         end if
      else if (number == 0 .and. figures <= 18) then
         x = 0.0_wp
      else if (overflows(text(mark:last), decade + figures)) then
         is_number = .false.
      else
         read (text(mark:last), *, iostat=status) x
         is_number = status == 0
      end if
   end subroutine get_decimal

   !> Whether a number given as digits is larger than the largest double.
   pure logical function overflows(text, decades)
      character(*), intent(in) :: text
      integer, intent(in) :: decades            !! digits in front of the decimal point, zeros in front of the first digit included
      integer(i8) :: first
      integer :: k, zeros, figures

      overflows = .false.
      if (decades <= 308) return
      first = 0
      zeros = 0
      figures = 0
      do k = 1, len(text)
         if (scan(text(k:k), 'eEdD') > 0 .or. figures == 17) exit
         if (verify(text(k:k), '0123456789') > 0) cycle
         if (figures == 0 .and. text(k:k) == '0') then
            zeros = zeros + 1
         else
            first = 10*first + iachar(text(k:k)) - iachar('0')
            figures = figures + 1
         end if
      end do
      if (first == 0) return
      first = first*10_i8**(17 - figures)
      overflows = decades - zeros > 309 .or. (decades - zeros == 309 .and. first > largest)
   end function overflows

   !> Reads a number for a calculation. The number must be finite and, as in a deck, below 1e30 in magnitude.
   pure subroutine get_bounded(text, x, is_good)
      character(*), intent(in) :: text
      real(wp), intent(out) :: x
      logical, intent(out) :: is_good           !! false: not a number, or a number beyond the limit

      call get_decimal(text, x, is_good)
      if (is_good) is_good = ieee_is_finite(x)
      if (is_good) is_good = abs(x) < number_limit
   end subroutine get_bounded

   !> A hint for a message about a string that get_bounded rejects: ' (write a number below 1e30)' if the string is a number,
   !> otherwise ''.
   pure function size_hint(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      real(wp) :: x
      integer :: mark
      logical :: is_number

      words = ''
      mark = scan(text, 'eEdD')
      if (verify(trim(adjustl(text)), '+-.0123456789eEdD') > 0) return
      if (mark == 0) mark = len_trim(text) + 1
      call get_decimal(text(:mark - 1), x, is_number)
      if (mark <= len_trim(text)) is_number = is_number .and. scan(text(mark + 1:), '123456789') > 0 .and. &
         scan(text(mark + 1:), '+0123456789') == 1 .and. verify(trim(text(mark + 2:)), '0123456789') == 0
      if (is_number .and. abs(x) > 0.0_wp) words = ' (write a number below 1e30)'
   end function size_hint

   !> The number in a string that has already been checked, as a list-directed `read` would return it, but ten times as fast.
   real(wp) function checked_number(text) result(x)
      character(*), intent(in) :: text           !! no blanks in front
      logical :: is_number

      call get_decimal(text, x, is_number)
      if (is_number .and. (abs(x) > 0.0_wp .or. text(:1) /= '-')) return
      read (text, *) x                           ! −0, or far beyond what is written by hand
   end function checked_number

   !> Skips digits and appends the first 18 of them to the number.
   pure subroutine take_digits(text, at, number, figures)
      character(*), intent(in) :: text
      integer, intent(inout) :: at, figures
      integer(i8), intent(inout) :: number
      integer :: digit

      do while (at <= len(text))
         digit = iachar(text(at:at)) - iachar('0')
         if (digit < 0 .or. digit > 9) exit
         figures = figures + 1
         if (figures <= 18) number = 10*number + digit
         at = at + 1
      end do
   end subroutine take_digits

   !> A number rounded to significant digits; 0 for a magnitude below 1e-12. A magnitude above 1e12 is not rounded.
   elemental real(wp) function rounded(value, digits)
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      real(wp) :: scale

      rounded = value
      if (.not. ieee_is_finite(value)) return
      if (abs(value) > 1.0e12_wp) return
      rounded = 0.0_wp
      if (abs(value) < 1.0e-12_wp) return
      scale = 10.0_wp**(digits - 1 - floor(log10(abs(value))))
      rounded = anint(value*scale)/scale
   end function rounded

end module ek_decimal
