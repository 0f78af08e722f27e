!> A chunk of a study: designs that are computed, written and resumed together, and the file of the chunk.
!>
!> The file begins with lines (file type, identity of the study, BLAS kernel, sizes of the chunk). Then follow the numbers as bytes
!> and the messages of failed designs. The file ends with a checksum of everything before. The file is written under a temporary
!> name and renamed when it is complete, so that a file under its final name is a finished chunk. A chunk damaged afterwards is
!> recognised and computed again.
module ek_chunk
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_file, only: read_whole, remove_file, file_exists
   use ek_system, only: facts_t, facts_of, regular_file, link_file, device_file, other_file, unknown_file
   use ek_writer, only: writer_t, begin_file
   implicit none(type, external)
   private
   public :: remove_foreign
   public :: chunk_t, new_chunk, add_reason, put_error, reason_of, write_chunk, read_chunk, kernel_of, chunk_name, design_solved, &
      design_incomplete, design_unsolvable, design_invalid, status_names

   ! how a design ended
   integer, parameter :: design_solved = 0         !! all states converged, all responses have a value
   integer, parameter :: design_incomplete = 1     !! a state did not converge, or a response has no value
   integer, parameter :: design_unsolvable = 2     !! mechanism, redundant constraint, or the preload trim (`balance`) failed
   integer, parameter :: design_invalid = 3        !! the numbers of the design do not define a valid model
   character(*), parameter :: status_names(0:3) = [character(12) :: 'solved', 'incomplete', 'not_solvable', 'invalid']

   character(*), parameter :: mark = 'elastokin chunk 2'
   character(*), parameter :: line_end = new_line('a')

   !> The reason why a design of a chunk failed.
   type :: reason_t
      integer :: design = 0
      character(:), allocatable :: text
   end type reason_t

   !> The results of a chunk: designs first … first + size(status) − 1.
   type :: chunk_t
      integer(i8) :: first = 1
      integer, allocatable :: status(:)           !! status of each design, one of design_*
      integer, allocatable :: states(:)           !! number of rows in `curves` of each design
      real(wp), allocatable :: factors(:, :)      !! (factor, design), units of the deck
      real(wp), allocatable :: responses(:, :)    !! (response, design), units of the column headings
      real(wp), allocatable :: curves(:, :)       !! (swept value and columns; state, design after design)
      integer :: rows = 0                         !! number of used rows of `curves`
      type(reason_t), allocatable :: reasons(:)
      type(error_t), allocatable :: error         !! too little memory, or a file cannot be read (not caused by a design): the chunk
                                                  !! is not stored
   end type chunk_t

contains

   !> Creates an empty chunk.
   pure subroutine new_chunk(first, designs, factors, responses, columns, states, self)
      integer(i8), intent(in) :: first
      integer, intent(in) :: designs, factors, responses, columns
      integer, intent(in) :: states               !! expected number of states of a design
      type(chunk_t), intent(inout) :: self        !! its memory is reused if the sizes fit

      self%first = first
      if (allocated(self%status)) then
         if (size(self%status) /= designs .or. size(self%factors, 1) /= factors .or. size(self%responses, 1) /= responses .or. &
            size(self%curves, 1) /= columns) deallocate (self%status, self%states, self%factors, self%responses, self%curves)
      end if
      if (.not. allocated(self%status)) then
         allocate (self%status(designs), self%states(designs), self%factors(factors, designs), &
            self%responses(responses, designs), self%curves(columns, states*designs))
      end if
      self%status(:) = design_solved
      self%states(:) = 0
      self%factors(:, :) = 0.0_wp
      self%responses(:, :) = 0.0_wp
      self%rows = 0
      if (allocated(self%error)) deallocate (self%error)
      if (allocated(self%reasons)) deallocate (self%reasons)
      allocate (self%reasons(0))
   end subroutine new_chunk

   !> Records the reason why a design of the chunk failed.
   pure subroutine add_reason(self, design, text)
      type(chunk_t), intent(inout) :: self
      integer, intent(in) :: design               !! index of the design in the chunk, from 1
      character(*), intent(in) :: text
      type(reason_t), allocatable :: more(:)
      integer :: n

      n = size(self%reasons)
      allocate (more(n + 1))
      more(:n) = self%reasons
      more(n + 1)%design = design
      more(n + 1)%text = text
      call move_alloc(more, self%reasons)
   end subroutine add_reason

   !> Stores the first error that was not caused by a design: too little memory, or a file that can no longer be read.
   subroutine put_error(self, error)
      type(chunk_t), intent(inout) :: self
      type(error_t), intent(in) :: error

      if (.not. allocated(self%error)) self%error = error
   end subroutine put_error

   !> The reason why a design of the chunk failed; '' if the design did not fail.
   pure function reason_of(self, design) result(text)
      type(chunk_t), intent(in) :: self
      integer, intent(in) :: design               !! index of the design in the chunk
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, size(self%reasons)
         if (self%reasons(k)%design == design) text = self%reasons(k)%text
      end do
   end function reason_of

   !> The file name of a chunk, for instance 'chunk_000001.bin'.
   pure function chunk_name(number) result(name)
      integer, intent(in) :: number               !! index of the chunk, from 1
      character(:), allocatable :: name
      character(*), parameter :: zeros = '000000'

      name = str(number)
      name = 'chunk_'//zeros(:max(0, len(zeros) - len(name)))//name//'.bin'
   end function chunk_name

   !> Writes a chunk: the complete file, or no file.
   subroutine write_chunk(self, path, identity, kernel, error)
      type(chunk_t), intent(in) :: self
      character(*), intent(in) :: path
      character(*), intent(in) :: identity        !! identity of the study
      character(*), intent(in) :: kernel          !! kernel of the BLAS; '': unknown
      type(error_t), allocatable, intent(out) :: error
      type(writer_t) :: writer
      type(checksum_t) :: sum
      integer :: k, n

      n = size(self%status)
      ! without waiting for the disk, up to a millisecond of all threads: a chunk that a power cut damages is computed again
      call begin_file(writer, path, error, can_be_redrawn=.true.)
      if (allocated(error)) return
      call put(mark//line_end//identity//line_end//kernel//line_end)
      call put(line_of(self)//line_end)
      call put(bytes_of(real([1], wp)))                     ! a machine of another byte order reads another number
      call put(bytes_of(real(self%status, wp)))
      call put(bytes_of(real(self%states, wp)))
      do k = 1, n
         call put(bytes_of(self%factors(:, k)))
         call put(bytes_of(self%responses(:, k)))
      end do
      call put(bytes_of(reshape(self%curves(:, :self%rows), [size(self%curves, 1)*self%rows])))
      do k = 1, size(self%reasons)
         call put(str(self%reasons(k)%design)//' '//str(len(self%reasons(k)%text))//line_end//self%reasons(k)%text//line_end)
      end do
      call writer%add(digits_of(sum)//line_end)
      call writer%finish(error)

   contains

      subroutine put(text)
         character(*), intent(in) :: text
         call writer%add(text)
         call include(sum, text)
      end subroutine put

   end subroutine write_chunk

   !> Sizes of a chunk, for instance '1 250 2 5 3 5500 0': index of the first design, numbers of designs, factors, responses,
   !> columns and rows of the curves, reasons.
   pure function line_of(self) result(text)
      type(chunk_t), intent(in) :: self
      character(:), allocatable :: text

      text = str(int(self%first))//' '//str(size(self%status))//' '//str(size(self%factors, 1))//' '// &
         str(size(self%responses, 1))//' '//str(size(self%curves, 1))//' '//str(self%rows)//' '//str(size(self%reasons))
   end function line_of

   !> Reads a chunk. is_good is .false. if the file is absent, damaged, from another study, written on a machine of another byte
   !> order, or contains other designs (a renamed file).
   subroutine read_chunk(path, identity, first, designs, self, is_good, unread)
      character(*), intent(in) :: path, identity
      integer(i8), intent(in) :: first             !! index of the first design of the chunk
      integer, intent(in) :: designs               !! number of designs of the chunk; 0: not known
      type(chunk_t), intent(inout) :: self
      logical, intent(out) :: is_good
      type(error_t), allocatable, intent(out), optional :: unread   !! reason why the file cannot be read; not its content
      character(:), allocatable :: text
      type(error_t), allocatable :: error
      type(checksum_t) :: sum
      real(wp), allocatable :: numbers(:)
      integer :: sizes(7), at, status, k, design, length

      is_good = .false.
      call read_whole(path, text, error)
      if (allocated(error)) then
         if (.not. present(unread)) return
         if (file_exists(path)) call move_alloc(error, unread)
         return
      end if
      at = len(text) - 17
      if (at < len(mark)) return
      if (index(text, mark//line_end//identity//line_end) /= 1) return
      call include(sum, text(:at))
      if (text(at + 1:) /= digits_of(sum)//line_end) return
      at = len(mark) + len(identity) + 3
      at = at + index(text(at:), line_end)        ! after the kernel
      k = index(text(at:), line_end)
      read (text(at:at + k - 2), *, iostat=status) sizes
      if (status /= 0 .or. sizes(1) /= first .or. (designs > 0 .and. sizes(2) /= designs)) return
      at = at + k
      call new_chunk(int(sizes(1), i8), sizes(2), sizes(3), sizes(4), sizes(5), 0, self)
      allocate (numbers(max(1, sizes(2))))
      call take(numbers(:1))
      if (abs(numbers(1) - 1.0_wp) > 0.0_wp) return
      call take(numbers(:sizes(2)))
      self%status(:) = nint(numbers(:sizes(2)))
      call take(numbers(:sizes(2)))
      self%states(:) = nint(numbers(:sizes(2)))
      do k = 1, sizes(2)
         call take(self%factors(:, k))
         call take(self%responses(:, k))
      end do
      if (size(self%curves, 2) < sizes(6)) then
         deallocate (self%curves)
         allocate (self%curves(sizes(5), sizes(6)))
      end if
      do k = 1, sizes(6)
         call take(self%curves(:, k))
      end do
      self%rows = sizes(6)
      do k = 1, sizes(7)
         read (text(at:at + index(text(at:), line_end) - 2), *, iostat=status) design, length
         if (status /= 0) return
         at = at + index(text(at:), line_end)
         call add_reason(self, design, text(at:at + length - 1))
         at = at + length + 1
      end do
      is_good = .true.

   contains

      !> Reads the next numbers of the file.
      subroutine take(values)
         real(wp), intent(out) :: values(:)
         integer :: j

         do j = 1, size(values)
            values(j) = transfer(text(at:at + 7), values(j))
            at = at + 8
         end do
      end subroutine take

   end subroutine read_chunk

   !> The BLAS kernel with which a chunk was computed; '' if the kernel is unknown or the file does not exist.
   function kernel_of(path) result(kernel)
      character(*), intent(in) :: path
      character(:), allocatable :: kernel
      character(80) :: lines(3)
      type(facts_t) :: facts
      integer :: unit, status, ignored, k

      kernel = ''
      facts = facts_of(path, follow=.true.)
      if (.not. (facts%kind == regular_file .or. facts%kind == unknown_file)) return      ! a device may be endless
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do k = 1, size(lines)
         if (status == 0) read (unit, '(a)', iostat=status) lines(k)
      end do
      close (unit, iostat=ignored)
      if (status == 0) kernel = trim(lines(3))
   end function kernel_of

   !> Removes what is not a file, such as a link or a pipe, from the path of a chunk: a chunk would be written through a link.
   subroutine remove_foreign(path)
      character(*), intent(in) :: path
      type(facts_t) :: facts

      facts = facts_of(path, follow=.false.)
      if (any(facts%kind == [link_file, device_file, other_file])) call remove_file(path)
   end subroutine remove_foreign

   !> The bytes of real numbers as a string.
   pure function bytes_of(numbers) result(text)
      real(wp), intent(in) :: numbers(:)
      character(8*size(numbers)) :: text
      text = transfer(numbers, text)
   end function bytes_of

end module ek_chunk
