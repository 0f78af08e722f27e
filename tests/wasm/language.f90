!> Prints what the features of Fortran give on which retarget.py and the runtime for WebAssembly depend: layouts that compiler and
!> runtime share (descriptors, types, namelists), calls between Fortran and C in both directions, input and output. `.ci/deep wasm`
!> compares the output with that of flang for this machine, line by line.
module things
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funptr, c_int, c_ptr, c_size_t
   implicit none(type, external)
   private
   public :: pair_t, chain_t, shape_t, square_t, circle_t, compare, describe, c_qsort, c_strlen, c_getenv, area_sum

   type, bind(c) :: pair_t
      integer(c_int) :: key
      real(c_double) :: value
   end type pair_t

   type :: chain_t
      type(chain_t), allocatable :: next
      integer :: number = 5
      character(:), allocatable :: names(:)
   contains
      procedure, private :: equals, assign_chain
      generic :: operator(==) => equals
      generic :: assignment(=) => assign_chain
      final :: finish
   end type chain_t

   type, abstract :: shape_t
      real(c_double) :: size = 1
   contains
      procedure(area_of), deferred :: area
   end type shape_t
   type, extends(shape_t) :: square_t
   contains
      procedure :: area => square_area
   end type square_t
   type, extends(shape_t) :: circle_t
      character(:), allocatable :: colour
   contains
      procedure :: area => circle_area
   end type circle_t

   abstract interface
      real(c_double) function area_of(this)
         import :: c_double, shape_t
         class(shape_t), intent(in) :: this
      end function area_of
   end interface

   interface
      subroutine c_qsort(list, count, size, order) bind(c, name='qsort')
         import :: c_funptr, c_ptr, c_size_t
         type(c_ptr), value :: list
         integer(c_size_t), value :: count, size
         type(c_funptr), value :: order
      end subroutine c_qsort
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen
      type(c_ptr) function c_getenv(name) bind(c, name='getenv')
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: name(*)
      end function c_getenv
   end interface

contains

   !> Order of two pairs by value, for qsort.
   integer(c_int) function compare(a, b) bind(c)
      type(c_ptr), value :: a, b
      type(pair_t), pointer :: first, second

      call c_f_pointer(a, first)
      call c_f_pointer(b, second)
      compare = merge(1_c_int, merge(-1_c_int, 0_c_int, first%value < second%value), first%value > second%value)
   end function compare

   pure logical function equals(a, b)
      class(chain_t), intent(in) :: a, b
      equals = a%number == b%number
   end function equals

   recursive subroutine assign_chain(a, b)
      class(chain_t), intent(inout) :: a
      class(chain_t), intent(in) :: b
      a%number = b%number + 100
      if (allocated(b%names)) a%names = b%names
      if (allocated(b%next)) then
         if (.not. allocated(a%next)) allocate (a%next)
         a%next = b%next
      end if
   end subroutine assign_chain

   impure elemental subroutine finish(this)
      type(chain_t), intent(inout) :: this
      write (*, '(a,i0)') 'finished ', this%number
   end subroutine finish

   real(c_double) function square_area(this)
      class(square_t), intent(in) :: this
      square_area = this%size**2
   end function square_area

   real(c_double) function circle_area(this)
      class(circle_t), intent(in) :: this
      circle_area = 3*this%size**2
   end function circle_area

   !> Areas of shapes of any type, by their own procedures.
   real(c_double) function area_sum(shapes)
      class(shape_t), intent(in) :: shapes(:)
      integer :: k
      area_sum = 0
      do k = 1, size(shapes)
         area_sum = area_sum + shapes(k)%area()
      end do
   end function area_sum

   !> Prints values of any type.
   subroutine describe(values)
      class(*), intent(in) :: values(:)
      select type (values)
      type is (integer)
         write (*, '(a,*(1x,i0))') 'integers', values
      type is (real(c_double))
         write (*, '(a,*(1x,f6.2))') 'reals', values
      type is (character(*))
         write (*, '(a,*(1x,a))') 'strings', values
      class default
         write (*, '(a)') 'another type'
      end select
   end subroutine describe

end module things

program language
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_funloc, c_int, c_loc, c_null_char, c_ptr, c_size_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use things, only: pair_t, chain_t, shape_t, square_t, circle_t, compare, describe, c_qsort, c_strlen, c_getenv, area_sum
   implicit none(type, external)

   call procedures_of_c()
   call derived_types()
   call arrays()
   call texts()
   call files()
   call numbers()
   error stop 3, quiet=.true.

contains

   subroutine procedures_of_c()
      type(pair_t), target :: list(3)
      type(c_ptr) :: home

      list = [pair_t(1_c_int, 3.0_c_double), pair_t(2_c_int, 1.0_c_double), pair_t(3_c_int, 2.0_c_double)]
      call c_qsort(c_loc(list), 3_c_size_t, storage_size(list, c_size_t)/8_c_size_t, c_funloc(compare))
      write (*, '(a,*(1x,i0))') 'sorted', list%key
      home = c_getenv('EK_TEST'//c_null_char)
      write (*, '(a,l2)') 'variable', c_associated(home)
      if (c_associated(home)) write (*, '(a,i0)') 'length ', c_strlen(home)
   end subroutine procedures_of_c

   subroutine derived_types()
      type(chain_t) :: a, b
      class(shape_t), allocatable :: shapes(:), copy(:)

      a%names = [character(4) :: 'left', 'mid']
      allocate (a%next)
      a%next%number = 6
      b = a
      write (*, '(a,3(1x,i0),l2,2(1x,a))') 'copied', b%number, b%next%number, size(b%names), a == b, b%names
      allocate (square_t :: shapes(2))
      shapes%size = [2.0_c_double, 3.0_c_double]
      write (*, '(a,f6.2)') 'squares', area_sum(shapes)
      allocate (copy, source=shapes)
      deallocate (shapes)
      allocate (circle_t :: shapes(1))
      select type (shapes)
      class is (circle_t)
         shapes(1)%colour = 'red'
      end select
      write (*, '(a,2f6.2,l2)') 'circle and squares', area_sum(shapes), area_sum(copy), same_type_as(copy(1), square_t())
      call describe([1, 2])
      call describe([1.0_c_double, 2.5_c_double])
      call describe(a%names)
      call describe(shapes)
   end subroutine derived_types

   subroutine arrays()
      real(c_double) :: m(3, 3), v(3)
      real(c_double), allocatable :: grown(:)
      character(1), allocatable :: huge_one(:)
      integer :: k, status

      m = reshape([(real(k, c_double), k=1, 9)], [3, 3])
      v = matmul(m, [1.0_c_double, 2.0_c_double, 3.0_c_double])
      m = matmul(transpose(m), m)
      write (*, '(a,*(1x,f7.1))') 'products', v, m, dot_product(v, v)
      write (*, '(a,*(1x,i0))') 'places', maxloc(m), minloc(v), findloc(v, v(2)), count(m > 50)
      write (*, '(a,*(1x,f7.1))') 'values', sum(m), maxval(m), pack(v, v > 31), norm2(v)
      write (*, '(a,*(1x,i0))') 'shifted', spread([1, 2], 1, 2), cshift([1, 2, 3], 1), eoshift([1, 2, 3], 1)
      grown = [real(c_double) ::]
      do k = 1, 5
         grown = [grown, real(k, c_double)**2]
      end do
      write (*, '(a,*(1x,f5.1))') 'grown', grown(ubound(grown, 1):1:-2)
      allocate (huge_one(2100000000), stat=status)     ! an error where the memory ends, as it does in WebAssembly
      write (*, '(a,l2)') 'large array done', allocated(huge_one) .eqv. status == 0
   end subroutine arrays

   subroutine texts()
      character(80) :: line, message
      character(:), allocatable :: joined, list(:)
      integer :: k, status
      real(c_double) :: x

      write (line, '(i0,1x,f4.1,1x,es12.4e3,1x,l1)') 42, 1.5_c_double, 1e-100_c_double, .true.
      write (*, '(a)') trim(line)
      read (line, *, iostat=status) k, x
      write (*, '(a,i0,1x,f4.1,1x,i0)') 'read ', k, x, status
      line = 'abc'
      message = ''
      read (line, *, iostat=status, iomsg=message) k
      write (*, '(a,2l2)') 'no number', status > 0, len_trim(message) > 0
      list = [character(5) :: 'a', 'bb', 'ccc']
      joined = ''
      do k = 1, size(list)
         joined = joined//trim(list(k))//','
      end do
      write (*, '(a,1x,i0)') joined, len(joined)
      do k = 1, 6000     ! in all 18 MB, if the room for a string inside `if` were not used again
         if (k > 0) joined = joined//'x'
      end do
      write (*, '(a,1x,i0)') 'grown', len(joined)
      write (*, '(a,*(1x,i0))') 'found', index('hello', 'l', .true.), scan('abc', 'c'), verify('aab', 'a'), len(repeat('x', 3))
      call get_command_argument(1, line)
      write (*, '(a,i0,1x,a)') 'arguments ', command_argument_count(), trim(line)
      call get_environment_variable('EK_TEST', line, status=status)
      write (*, '(a,1x,i0)') trim(line), status
   end subroutine texts

   subroutine files()
      character(80) :: line, message
      real(c_double) :: v(3), x
      integer :: unit, status, n
      namelist /group/ n, x, v

      open (newunit=unit, file='written.txt', status='replace', action='write')
      write (unit, '(a)') 'first line'
      write (unit, '(3es24.16)') [1.0_c_double/3, 2.0_c_double/3, acos(-1.0_c_double)]
      write (unit, '(a)') '&group n=3 x=2.5e0 v=1,2*7 /'
      close (unit)
      open (newunit=unit, file='written.txt', status='old', action='read')
      read (unit, '(a)') line
      read (unit, *) v
      write (*, '(a,3(1x,es24.16))') trim(line), v
      read (unit, nml=group)
      write (*, '(a,1x,i0,4(1x,f4.1))') 'namelist', n, x, v
      read (unit, '(a)', iostat=status) line
      write (*, '(a,l2)') 'end of file', is_iostat_end(status)
      close (unit, status='delete')
      open (newunit=unit, file='written.txt', status='old', action='read', iostat=status, iomsg=message)
      write (*, '(a,2l2)') 'deleted', status > 0, len_trim(message) > 0
      open (newunit=unit, access='stream', form='unformatted', file='bytes.bin', status='replace')
      write (unit) 'abc', 7_c_int
      inquire (unit=unit, size=n)
      close (unit, status='delete')
      write (*, '(a,1x,i0)') 'bytes', n
   end subroutine files

   subroutine numbers()
      real(c_double) :: x

      x = ieee_value(x, ieee_quiet_nan)
      write (*, '(a,l2,1x,i0)') 'numbers', ieee_is_nan(x), huge(1_c_size_t)
      write (*, '(a,4(1x,es23.15))') 'functions', sqrt(2.0_c_double), nearest(1.0_c_double, 1.0_c_double) - 1, &
         scale(3.0_c_double, -4), set_exponent(1.0_c_double, 5)
      write (*, '(a,3(1x,i0))') 'rounded', nint(2.5_c_double), floor(-1.5_c_double), ceiling(-1.5_c_double)
   end subroutine numbers

end program language
