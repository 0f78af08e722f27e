!> Names that are not allowed in a deck, with the reason: an illegal character, or the column of a quantity that an element, a
!> measure or a joint of this name would have as well. input/README.md lists them.
module ek_reserved_name
   use ek_text, only: lower
   use ek_letters, only: visible
   use ek_quantity, only: column_of_stem
   implicit none(type, external)
   private
   public :: reserved_because, is_legal_name, illegal_name

contains

   !> Whether a name begins with a letter and contains only letters, digits and _. Names appear in messages, paths and
   !> column headings.
   pure logical function is_legal_name(name)
      character(*), intent(in) :: name
      character(*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
      is_legal_name = verify(lower(name), letters//'0123456789_') == 0 .and. scan(lower(name), letters) == 1
   end function is_legal_name

   !> The message for an illegal name. A leading or trailing blank is made visible.
   pure function illegal_name(name) result(words)
      character(*), intent(in) :: name     !! as written in the deck
      character(:), allocatable :: words

      words = 'a name must begin with a letter and contain only letters, digits and _'
      if (len(name) == 0) return
      if (name(len(name):) == ' ') then
         words = words//", found '"//visible(trim(name))//"<U+0020>'; remove the trailing blank"
      else if (name(:1) == ' ') then
         words = words//", found '<U+0020>"//visible(trim(adjustl(name)))//"'; remove the leading blank"
      end if
   end function illegal_name

   !> The message for a reserved name; '' if the name is allowed.
   pure function reserved_because(name, has_results) result(words)
      character(*), intent(in) :: name
      logical, intent(in) :: has_results       !! elements of its kind have columns in the results
      character(*), parameter :: rate = '_per'
      character(:), allocatable :: words, head, column

      words = ''
      select case (lower(name))
      case ('chassis', 'ground')
         words = 'the name is reserved for the fixed body'
         return
      case ('wheel_travel')
         words = "the name is reserved: drive = 'wheel_travel' prescribes the height of a wheel (column wheel_travel_mm)"
         return
      end select
      if (index(lower(name), 'rig_') == 1) then
         words = 'the name is reserved: names of the test rig begin with rig_, as in the column rig_left_height_reaction_n'
         return
      end if
      if (.not. has_results) return
      if (len(name) > len(rate)) then
         if (lower(name(len(name) - len(rate) + 1:)) == rate) then
            words = 'the name is reserved: names of rates end in _per, as in the column wheel_rate_n_per_mm'
            return
         end if
      end if
      head = ''
      if (index(lower(name), 'left_') == 1) head = 'left_'
      if (index(lower(name), 'right_') == 1) head = 'right_'
      column = column_of_stem(lower(name(len(head) + 1:)))
      if (column /= '') words = 'the name is reserved: the results have a column '//head//column
   end function reserved_because

end module ek_reserved_name
