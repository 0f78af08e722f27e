!> The input of the program elastokin-netcdf, which writes the store of a study from its chunks: sizes, names, units, strings.
!>
!> elastokin writes the description into the folder of the chunks. The file is a list of records. The first line of a record gives
!> word, name and length; then follow as many characters as the length, and a line end. A description of another version is
!> rejected.
module ek_store_description
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_version, only: version
   use ek_file, only: read_whole, write_whole
   implicit none(type, external)
   private
   public :: store_t, store_variable_t, attributes_t, write_description, read_description, description_name, keeps, factor_role, &
      response_role, curve_role, text_kind, whole_kind, real_kind

   character(*), parameter :: description_name = 'store.txt'       !! name of the file, in the folder of the chunks
   character(*), parameter :: mark = 'elastokin store 1, version '//version
   character(*), parameter :: line_end = new_line('a')

   ! roles of a variable, and kinds of an attribute
   character(*), parameter :: factor_role = 'factor', response_role = 'response', curve_role = 'curve'
   character(*), parameter :: text_kind = 'text', whole_kind = 'whole', real_kind = 'real'

   !> Attributes of a variable or of the store, in the order of writing.
   type :: attributes_t
      type(message_list_t) :: names, texts, kinds
   contains
      procedure :: add => attributes_add
   end type attributes_t

   !> A variable of the store.
   type :: store_variable_t
      character(:), allocatable :: name           !! name, unique in the store
      character(:), allocatable :: role           !! factor_role and response_role: one number per design; curve_role: one per state
                                                  !! of each design
      type(attributes_t) :: attributes
      real(wp) :: lower = -huge(1.0_wp), upper = huge(1.0_wp)      !! limits of a response; ∓huge if there is no limit
   end type store_variable_t

   !> A store. The variables have the order of the chunk: factors, responses, swept value and columns.
   type :: store_t
      character(:), allocatable :: identity       !! identity of the study
      integer :: designs = 0, chunks = 0          !! numbers of designs and of chunk files
      integer :: states = 0                       !! largest number of states of a design
      integer :: reason = 0                       !! length of the longest reason of a failed design
      logical :: has_limits = .false.
      type(attributes_t) :: attributes            !! attributes of the store itself
      type(store_variable_t), allocatable :: variables(:)
   end type store_t

contains

   !> Adds an attribute to a list.
   pure subroutine attributes_add(self, name, text, kind)
      class(attributes_t), intent(inout) :: self
      character(*), intent(in) :: name, text
      character(*), intent(in), optional :: kind  !! kind of the attribute; default: text_kind

      call self%names%add(name)
      call self%texts%add(text)
      if (present(kind)) call self%kinds%add(kind)
      if (.not. present(kind)) call self%kinds%add(text_kind)
   end subroutine attributes_add

   !> Whether all responses of a design satisfy their limits. A response without a value does not satisfy a limit.
   pure logical function keeps(responses, lower, upper)
      real(wp), intent(in) :: responses(:), lower(:), upper(:)
      integer :: k

      keeps = .true.
      do k = 1, size(responses)
         if (.not. (lower(k) > -huge(1.0_wp) .or. upper(k) < huge(1.0_wp))) cycle
         if (.not. ieee_is_finite(responses(k))) then
            keeps = .false.
         else
            keeps = keeps .and. responses(k) >= lower(k) .and. responses(k) <= upper(k)
         end if
      end do
   end function keeps

   !> Writes the description of a store.
   subroutine write_description(store, path, error)
      type(store_t), intent(in) :: store
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error
      type(buffer_t) :: text
      integer :: k

      call text%line(mark)
      call put('identity', 'of', store%identity)
      call put('size', 'designs', str(store%designs))
      call put('size', 'chunks', str(store%chunks))
      call put('size', 'states', str(store%states))
      call put('size', 'reason', str(store%reason))
      call put('size', 'limits', merge('1', '0', store%has_limits))
      call put('size', 'variables', str(size(store%variables)))
      call put_attributes(store%attributes)
      do k = 1, size(store%variables)
         associate (this => store%variables(k))
            call put('variable', this%role, this%name)
            call put('limit', 'lower', exact(this%lower))
            call put('limit', 'upper', exact(this%upper))
            call put_attributes(this%attributes)
         end associate
      end do
      call write_whole(path, text%text(), error)

   contains

      subroutine put(word, name, content)
         character(*), intent(in) :: word, name, content
         call text%add(word//' '//name//' '//str(len(content))//line_end//content//line_end)
      end subroutine put

      subroutine put_attributes(list)
         type(attributes_t), intent(in) :: list
         integer :: j
         do j = 1, list%names%count()
            call put(list%kinds%line(j), list%names%line(j), list%texts%line(j))
         end do
      end subroutine put_attributes

   end subroutine write_description

   !> A real number as a string with all its digits.
   function exact(value) result(text)
      real(wp), intent(in) :: value
      character(26) :: text
      write (text, '(es26.17e3)') value
   end function exact

   !> Reads the description of a store.
   subroutine read_description(path, store, error)
      character(*), intent(in) :: path
      type(store_t), intent(out) :: store
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      character(:), allocatable :: text, word, name
      integer :: at, length, used, last

      call read_whole(path, text, error)
      if (allocated(error)) return
      if (index(text, mark//line_end) /= 1) then
         call fail(error, exit_file, path//': it is not of this version, '//version//'; elastokin and elastokin-netcdf must be '// &
            'built together')
         return
      end if
      at = len(mark) + 2
      used = 0
      do while (at <= len(text))
         call next_head(text, at, word, name, length)
         last = at + length - 1
         if (length < 0 .or. last >= len(text) .or. (used == 0 .and. word == 'limit')) then
            call fail(error, exit_file, path//': it is damaged')
            return
         end if
         call take(text(at:last))
         at = last + 2
      end do
      if (.not. allocated(store%variables) .or. .not. allocated(store%identity)) then
         call fail(error, exit_file, path//': it is damaged')
      else if (used /= size(store%variables)) then
         call fail(error, exit_file, path//': it is damaged')
      end if

   contains

      !> Stores the content of a record in the description.
      subroutine take(content)
         character(*), intent(in) :: content
         integer :: number, ignored

         select case (word)
         case ('identity')
            store%identity = content
         case ('size')
            read (content, *, iostat=ignored) number
            if (name == 'designs') store%designs = number
            if (name == 'chunks') store%chunks = number
            if (name == 'states') store%states = number
            if (name == 'reason') store%reason = number
            if (name == 'limits') store%has_limits = number == 1
            if (name == 'variables') allocate (store%variables(number))
         case ('variable')
            used = used + 1
            store%variables(used)%role = name
            store%variables(used)%name = content
         case ('limit')
            if (name == 'lower') read (content, *, iostat=ignored) store%variables(used)%lower
            if (name == 'upper') read (content, *, iostat=ignored) store%variables(used)%upper
         case default
            if (used == 0) call store%attributes%add(name, content, word)
            if (used > 0) call store%variables(used)%attributes%add(name, content, word)
         end select
      end subroutine take

   end subroutine read_description

   !> Reads the first line of a record, such as 'text units 2'.
   subroutine next_head(text, at, word, name, length)
      character(*), intent(in) :: text
      integer, intent(inout) :: at                !! first character of the record; on return, of its content
      character(:), allocatable, intent(out) :: word, name
      integer, intent(out) :: length              !! length of the content; −1 if the line is not valid
      integer :: end, first, second, status

      end = at + index(text(at:), line_end) - 1
      word = ''
      name = ''
      length = -1
      if (end < at) return
      first = index(text(at:end), ' ')
      second = index(text(at:end), ' ', back=.true.)
      if (first < 2 .or. second <= first) return
      word = text(at:at + first - 2)
      name = text(at + first:at + second - 2)
      read (text(at + second:end - 1), *, iostat=status) length
      if (status /= 0) length = -1
      at = end + 1
   end subroutine next_head

end module ek_store_description
