!> The part of a deck that defines another design: the records whose numbers change, with the new numbers.
module ek_deck_fragment
   use ek_kinds, only: wp
   use ek_text, only: quoted, str
   use ek_record, only: record_t, element, own_name
   use ek_parameter, only: choice_t
   use ek_reader, only: definition_t
   use ek_factor_numbers, only: put_factor
   use ek_designer, only: designer_t
   implicit none(type, external)
   private
   public :: deck_fragment, records_with

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: most_lines = 60        !! largest number of lines; a study of every number of a model would fill the page

contains

   !> The part of a deck that defines a design of a study; '' if a factor is not a number of the design space.
   function deck_fragment(designer, values) result(text)
      type(designer_t), intent(in) :: designer     !! designer with the numbers of the deck
      real(wp), intent(in) :: values(:)            !! values of the factors
      character(:), allocatable :: text
      real(wp), allocatable :: x(:)
      type(choice_t), allocatable :: found(:)
      integer :: f

      text = ''
      x = designer%workspace%definition%parameters%x
      allocate (found(0))
      do f = 1, size(values)
         if (size(designer%paths(f)%found) == 0) return
         call put_factor(designer%paths(f), values(f), designer%workspace%definition%parameters, x)
         found = [found, designer%paths(f)%found]
      end do
      text = records_with(designer%workspace%definition, x, found)
   end function deck_fragment

   !> Lines such as `&bushing name = 'lca_front', kt = 8000, 2000, 8000 /`: one per key, with all numbers of the key. Where the
   !> numbers of both sides change together, the record of the half deck is used. At most 60 lines are given; a comment states the
   !> number of further lines.
   function records_with(design, x, found) result(text)
      type(definition_t), intent(in) :: design
      real(wp), intent(in) :: x(:)                 !! numbers of the new design [SI, axes of the deck]
      type(choice_t), intent(in) :: found(:)       !! numbers that change
      character(:), allocatable :: text
      character(:), allocatable :: all             ! lines, of which `text` has the first
      integer :: j, lines

      text = ''
      all = ''
      lines = 0
      do j = 1, size(found)
         if (is_image(design, x, found, found(j)%number)) cycle
         call add_line(design, x, found(j)%number, has_image(design, x, found, found(j)%number), lines, all, text)
      end do
      if (lines > most_lines) text = text//'! and '//str(lines - most_lines)//' more lines'//nl
      if (len(text) > 0) text = text(:len(text) - 1)
   end function records_with

   !> Whether a number of the right side is derived from a number of the half deck, and changes together with the number on the left
   !> side.
   pure logical function is_image(design, x, found, number)
      type(definition_t), intent(in) :: design
      real(wp), intent(in) :: x(:)
      type(choice_t), intent(in) :: found(:)
      integer, intent(in) :: number

      associate (this => design%parameters%list(number))
         is_image = this%tied > 0
         if (is_image) is_image = any(found%number == this%tied) .and. abs(x(number) - this%sign*x(this%tied)) <= &
            1.0e-14_wp*abs(x(number))
      end associate
   end function is_image

   !> Whether a number of the left side has a corresponding number on the right side that changes with it.
   pure logical function has_image(design, x, found, number)
      type(definition_t), intent(in) :: design
      real(wp), intent(in) :: x(:)
      type(choice_t), intent(in) :: found(:)
      integer, intent(in) :: number
      integer :: j

      has_image = .false.
      do j = 1, size(found)
         if (design%parameters%list(found(j)%number)%tied == number) has_image = is_image(design, x, found, found(j)%number)
         if (has_image) return
      end do
   end function has_image

   !> Adds the line of the key of a parameter, unless the string already contains the line.
   subroutine add_line(design, x, number, is_half, lines, all, text)
      type(definition_t), intent(in) :: design
      real(wp), intent(in) :: x(:)
      integer, intent(in) :: number
      logical, intent(in) :: is_half               !! whether the line is written as in the half deck
      integer, intent(inout) :: lines
      character(:), allocatable, intent(inout) :: all, text
      character(:), allocatable :: line, name
      integer :: k

      associate (this => design%parameters%list(number))
         name = element(design%records(this%record), 'name', 1)
         if (is_half) name = own_name(design%records(this%record))
         line = head_of(design%records(this%record), name)//' '//trim(this%key)//' ='
         do k = 1, design%parameters%used
            associate (other => design%parameters%list(k))
               if (other%record /= this%record .or. other%key /= this%key) cycle
               if (line(len(line):) /= '=') line = line//','
               line = line//' '//number_text(x(k)/other%unit)
            end associate
         end do
         if (allocated(design%records(this%record)%origin)) then
            line = line//' in units and axes of the deck'//nl
         else
            line = line//' /'//nl
         end if
      end associate
      if (index(nl//all, nl//line) > 0) return
      all = all//line
      lines = lines + 1
      if (lines <= most_lines) text = text//line
   end subroutine add_line

   !> The beginning of the line of a record. The line of a record that was created from another file is a comment with the file and
   !> line, because the deck cannot give such a record.
   function head_of(record, name) result(head)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: name             !! name of the record in the deck; '' without a name
      character(:), allocatable :: head

      if (allocated(record%origin)) then
         head = '! '//record%group//' '//quoted(name)//' of '//record%file//':'//str(record%line)//' ('//record%origin//'):'
         return
      end if
      head = '&'//record%group
      if (name /= '') head = head//' name = '''//name//''','
   end function head_of

   !> A number with 12 digits, which removes the rounding of its conversion from SI.
   function number_text(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      text = str(value, 12)
   end function number_text

end module ek_deck_fragment
