!> The part of a deck that makes a design of a study: the records whose numbers its factors change, with the new numbers.
module ek_deck_fragment
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_record, only: element
   use ek_worker, only: worker_t, put_factor
   use ek_study_design, only: designer_t
   implicit none(type, external)
   private
   public :: deck_fragment

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_lines = 60        !! a study of every number of a model would fill the page

contains

   !> Lines such as `&bushing name = 'lca_front', kt = 8000, 2000, 8000 /`: one per key, all numbers of the key. '' if a factor is
   !> no number of the design space.
   function deck_fragment(designer, values) result(text)
      type(designer_t), intent(in) :: designer     !! with the numbers of the deck
      real(wp), intent(in) :: values(:)            !! of the factors
      character(:), allocatable :: text
      type(worker_t) :: worker
      integer :: f, j, lines

      text = ''
      worker%design = designer%worker%design
      worker%x = worker%design%parameters%x
      do f = 1, size(values)
         if (size(designer%paths(f)%found) == 0) return
         call put_factor(designer%paths(f), values(f), worker)
      end do
      lines = 0
      do f = 1, size(values)
         do j = 1, size(designer%paths(f)%found)
            call add_line(worker, designer%paths(f)%found(j)%number, lines, text)
         end do
      end do
      if (lines > most_lines) text = text//'! and '//str(lines - most_lines)//' more lines'//nl
      if (len(text) > 0) text = text(:len(text) - 1)
   end function deck_fragment

   !> The line of the key of a parameter, unless it is there.
   subroutine add_line(worker, number, lines, text)
      type(worker_t), intent(in) :: worker
      integer, intent(in) :: number
      integer, intent(inout) :: lines
      character(:), allocatable, intent(inout) :: text
      character(:), allocatable :: line
      integer :: k

      associate (design => worker%design, this => worker%design%parameters%list(number))
         line = '&'//design%records(this%record)%group
         if (element(design%records(this%record), 'name', 1) /= '') line = line//' name = '''// &
            element(design%records(this%record), 'name', 1)//''','
         line = line//' '//trim(this%key)//' ='
         do k = 1, design%parameters%used
            associate (other => design%parameters%list(k))
               if (other%record /= this%record .or. other%key /= this%key) cycle
               if (line(len(line):) /= '=') line = line//','
               line = line//' '//number_text(worker%x(k)/other%unit)
            end associate
         end do
         line = line//' /'//nl
      end associate
      if (index(nl//text, nl//line) > 0) return
      lines = lines + 1
      if (lines <= most_lines) text = text//line
   end subroutine add_line

   !> A number without the rounding of its unit: 12 digits.
   function number_text(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      text = str(value, 12)
   end function number_text

end module ek_deck_fragment
