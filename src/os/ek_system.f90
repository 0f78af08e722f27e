!> System queries: files and folders, failures, this machine and its memory. Without /proc, the machine is identified by its name,
!> and the folder of the program is unknown.
module ek_system
   use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_null_char
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file, message_list_t
   use ek_text, only: str
   use ek_system_call, only: c_facts, c_open_folder, c_next_name, c_close_folder, c_random, c_text, c_is_folder, c_write, &
      c_prepare, c_make_link, text_of, done, reason, host, working, program_path
   implicit none(type, external)
   private
   public :: facts_t, facts_of, no_file, regular_file, folder_file, device_file, link_file, other_file, unknown_file
   public :: folder_names, random_tag, machine_tag, working_folder, system_reason, program_folder, host_name
   public :: folder_exists, write_bytes, make_link, prepare_surroundings, ask_memory, has_memory, memory_remarks, blocks_in_memory

   ! As in elastokin_system.c
   integer, parameter :: unknown_file = -1, no_file = 0, regular_file = 1, folder_file = 2, device_file = 3, link_file = 4, &
      other_file = 5                                !! other_file: a named pipe or a socket

   !> The facts of a path: kind, identity and age.
   type :: facts_t
      integer :: kind = unknown_file
      integer(i8) :: inode = 0, device = 0          !! together: identity of the file
      integer(i8) :: changed = 0                    !! last modification [s since 1970]
   end type facts_t

   integer(c_int32_t), parameter :: max_letters = 4096         !! characters of the longest path

contains

   !> Kind, identity and age of a path. For a link, they are the facts of its target if `follow` is .true., otherwise of the link
   !> itself.
   type(facts_t) function facts_of(path, follow) result(facts)
      character(*), intent(in) :: path
      logical, intent(in) :: follow
      integer(c_int64_t) :: numbers(3)

      facts%kind = c_facts(path//c_null_char, merge(1_c_int32_t, 0_c_int32_t, follow), numbers)
      facts%inode = numbers(1)
      facts%device = numbers(2)
      facts%changed = numbers(3)
   end function facts_of

   !> Lists the names in a folder, in system order, without '.' and '..'. The list is empty if the folder cannot be read.
   subroutine folder_names(path, names)
      character(*), intent(in) :: path
      type(message_list_t), intent(out) :: names
      integer(c_int32_t), parameter :: most = 1024
      character(kind=c_char) :: letters(most)
      integer(c_int64_t) :: folder
      integer :: length

      folder = c_open_folder(path//c_null_char)
      if (folder == 0) return
      do
         length = c_next_name(folder, letters, most)
         if (length == 0) exit
         call names%add(text_of(letters, length))
      end do
      call c_close_folder(folder)
   end subroutine folder_names

   !> A string of 16 unpredictable hexadecimal digits. If the system provides no random bytes, the digits depend on the clock, and
   !> `attempt` distinguishes two calls at the same time.
   function random_tag(attempt) result(tag)
      integer, intent(in) :: attempt
      character(16) :: tag
      character(kind=c_char) :: bytes(8)
      integer(i8) :: ticks
      integer :: k

      bytes = c_null_char
      if (c_random(bytes, size(bytes, kind=c_int32_t)) /= done) then
         call system_clock(ticks)
         ticks = ieor(ticks, ishft(int(attempt, i8), 40))
         bytes = [(achar(int(iand(ishft(ticks, -8*k), 255_i8))), k=0, 7)]
      end if
      write (tag, '(8z2.2)') iachar(bytes)
   end function random_tag

   !> A string of 8 characters that distinguishes this running system from other systems with access to the same folder. It is
   !> computed from the boot id, or else from the name of the system. Containers on one machine share this string, as they share its
   !> locks.
   function machine_tag() result(tag)
      character(8) :: tag
      character(64) :: text
      integer :: unit, status, k, filled

      text = ''
      open (newunit=unit, file='/proc/sys/kernel/random/boot_id', action='read', status='old', iostat=status)
      if (status == 0) then
         read (unit, '(a)', iostat=status) text
         close (unit, iostat=k)
      end if
      if (status /= 0 .or. len_trim(text) < 8) text = host_name()
      tag = '00000000'
      filled = 0
      do k = 1, len_trim(text)
         if (filled == len(tag)) exit
         if (verify(text(k:k), '0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ') > 0) cycle
         filled = filled + 1
         tag(filled:filled) = text(k:k)
      end do
   end function machine_tag

   !> The name of this machine; '' if it is unknown.
   function host_name() result(name)
      character(:), allocatable :: name
      name = text_from(host)
   end function host_name

   !> The working folder; '.' if it has no path.
   function working_folder() result(path)
      character(:), allocatable :: path

      path = text_from(working)
      if (path == '') path = '.'
   end function working_folder

   !> The folder of the program that is running; '' if it is unknown.
   function program_folder() result(path)
      character(:), allocatable :: path

      path = text_from(program_path)
      if (path /= '') path = path(:max(1, index(path, '/', back=.true.) - 1))
   end function program_folder

   !> The C library's message for its last failure.
   function system_reason() result(text)
      character(:), allocatable :: text

      text = text_from(reason)
      if (text == '') text = 'unknown reason'
   end function system_reason

   !> A text of the system: `reason`, `host`, `working` or `program_path` of ek_system_call.
   function text_from(what) result(text)
      integer(c_int32_t), intent(in) :: what
      character(:), allocatable :: text
      character(kind=c_char) :: letters(max_letters)
      integer :: length

      length = c_text(what, letters, max_letters)
      text = text_of(letters, length)
   end function text_from

   !> Whether a path is a folder.
   logical function folder_exists(path)
      character(*), intent(in) :: path

      folder_exists = .false.
      if (len(path) > 0) folder_exists = c_is_folder(path//c_null_char) /= 0
   end function folder_exists

   !> Makes a symbolic link to `target`, a path relative to the folder of the link.
   subroutine make_link(target, path, is_made)
      character(*), intent(in) :: target, path
      logical, intent(out) :: is_made
      is_made = c_make_link(target//c_null_char, path//c_null_char) == done
   end subroutine make_link

   !> Writes all bytes of a string to an open file. `outcome` is `done`, `failed` or `broken_pipe` of ek_system_call.
   subroutine write_bytes(file, text, outcome)
      integer(c_int32_t), intent(in) :: file
      character(*), intent(in) :: text
      integer, intent(out) :: outcome
      outcome = c_write(file, text, len(text, c_int64_t))
   end subroutine write_bytes

   !> Prepares this process: corrects settings made by a batch system, a shell or a pipe. Only the main program may call it,
   !> once, before anything else.
   !>
   !> A reader that closes the pipe (`| head`) and a file that reaches `ulimit -f` become write errors instead of ending the
   !> process. Descriptors 0, 1 and 2 are opened if they were closed (`>&-`). Otherwise a results file could get one of these
   !> numbers, and messages would be written into the file.
   subroutine prepare_surroundings()
      call c_prepare()
   end subroutine prepare_surroundings

   !> Checks that a block of a number of bytes can be allocated. The check is made before hours of work begin, so that a shortage
   !> gives a message and an exit status instead of a crash at the allocation that fails. The block is released at once; only
   !> address space is used.
   subroutine ask_memory(bytes, purpose, error)
      integer(i8), intent(in) :: bytes
      character(*), intent(in) :: purpose                     !! user of the memory, for the message: 'case 'x' with 1000 states'
      type(error_t), allocatable, intent(out) :: error        !! exit_file

      if (.not. has_memory(bytes)) call fail(error, exit_file, memory_remarks(bytes, purpose))
   end subroutine ask_memory

   !> Whether a block of a number of bytes can be allocated.
   logical function has_memory(bytes)
      integer(i8), intent(in) :: bytes
      character(1), allocatable, volatile :: block(:)         ! volatile: the optimiser must not remove it as unused
      integer :: status

      allocate (block(bytes), stat=status)
      has_memory = status == 0
   end function has_memory

   !> The number of blocks of a given size that can be allocated at the same time, at most `most`. Several blocks are tried because
   !> a kernel may refuse one large block but grant parts that are never filled.
   integer function blocks_in_memory(most, bytes) result(blocks)
      integer, intent(in) :: most
      integer(i8), intent(in) :: bytes                        !! size of each block
      type :: block_t
         character(1), allocatable :: bytes(:)
      end type block_t
      type(block_t), volatile :: list(most)                   ! volatile as in has_memory
      integer :: status

      do blocks = 0, most - 1
         allocate (list(blocks + 1)%bytes(bytes), stat=status)
         if (status /= 0) return
      end do
      blocks = most
   end function blocks_in_memory

   !> Message that a block of a number of bytes cannot be allocated.
   pure function memory_remarks(bytes, purpose) result(text)
      integer(i8), intent(in) :: bytes
      character(*), intent(in) :: purpose
      character(:), allocatable :: text

      text = 'not enough memory: '//purpose//' needs '//str(int((bytes + 999999)/1000000))// &
         ' MB (a limit of the machine or of ulimit -v)'
   end function memory_remarks

end module ek_system
