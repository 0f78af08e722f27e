!> System queries: files and folders, failures, this machine and its memory; and signals.
!>
!> Some items are specific to Linux, each with a fallback elsewhere. If the offset of the name in a `struct dirent` is another ('.'
!> is not found there), a folder counts as empty. If statx, which is looked up at run time, is missing, the kinds of files are
!> unknown. Without /proc, the machine is identified by its name, and the folder of the program is unknown.
module ek_system
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_intptr_t, c_null_char, c_null_ptr, c_funptr, &
      c_null_funptr, c_ptr, c_size_t, c_associated, c_f_pointer, c_f_procpointer
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file, message_list_t
   use ek_text, only: str
   use ek_posix, only: c_opendir, c_readdir, c_closedir, c_flock, c_getcwd_raw, c_readlink, c_signal, c_gethostname, c_errno, &
      c_strerror, c_strlen, c_dlsym, c_write, c_access, c_close, c_dup, c_fopen
   implicit none(type, external)
   private
   public :: facts_t, facts_of, no_file, regular_file, folder_file, device_file, link_file, other_file, unknown_file
   public :: folder_names, try_lock, random_tag, machine_tag, working_folder, error_number, system_reason, set_signal
   public :: program_folder, host_name
   public :: folder_exists, write_bytes, prepare_surroundings, sigpipe, ask_memory, has_memory, memory_remarks, blocks_in_memory
   public :: already_there, broken_pipe, interrupted, not_for_this_kind

   ! errno, the same on all systems
   integer, parameter :: no_such_entry = 2, interrupted = 4, already_there = 17, no_folder = 20, not_for_this_kind = 22, &
      broken_pipe = 32

   integer, parameter :: unknown_file = -1, no_file = 0, regular_file = 1, folder_file = 2, device_file = 3, link_file = 4, &
      other_file = 5                                !! other_file: a named pipe or a socket

   !> The facts of a path: kind, identity and age.
   type :: facts_t
      integer :: kind = unknown_file
      integer(i8) :: inode = 0, device = 0          !! together: identity of the file
      integer(i8) :: changed = 0                    !! last modification [s since 1970]
   end type facts_t

   integer, parameter :: sigpipe = 13, sigxfsz = 25  !! numbers of signals, the same on all systems
   integer, parameter :: max_letters = 4096         !! characters of the longest path

   abstract interface
      integer(c_int) function statx_procedure(folder, path, flags, mask, facts) bind(c)
         import :: c_int, c_char
         implicit none(type, external)
         integer(c_int), value :: folder, flags, mask
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: facts(*)
      end function statx_procedure
      integer(c_int) function random_procedure(bytes, count) bind(c)
         import :: c_int, c_char, c_size_t
         implicit none(type, external)
         character(kind=c_char), intent(inout) :: bytes(*)
         integer(c_size_t), value :: count
      end function random_procedure
   end interface

contains

   !> Kind, identity and age of a path. For a link, they are the facts of its target if `follow` is .true., otherwise of the link
   !> itself.
   type(facts_t) function facts_of(path, follow) result(facts)
      character(*), intent(in) :: path
      logical, intent(in) :: follow
      integer(c_int), parameter :: here = -100          ! AT_FDCWD
      integer(c_int), parameter :: the_link = 256       ! AT_SYMLINK_NOFOLLOW
      integer(c_int), parameter :: basic = 2047         ! STATX_BASIC_STATS
      integer(i8), parameter :: kind_bits = 61440       ! S_IFMT, octal 170000
      integer(i8), parameter :: modes(*) = [32768_i8, 16384_i8, 8192_i8, 24576_i8, 40960_i8]
      integer, parameter :: kinds(*) = [regular_file, folder_file, device_file, device_file, link_file]
      character(kind=c_char) :: buffer(256)             ! struct statx
      procedure(statx_procedure), pointer :: statx
      type(c_funptr) :: address
      integer :: k

      address = c_dlsym(c_null_ptr, 'statx'//c_null_char)
      if (.not. c_associated(address)) return
      call c_f_procpointer(address, statx)
      buffer = c_null_char
      if (statx(here, path//c_null_char, merge(0_c_int, the_link, follow), basic, buffer) /= 0) then
         if (any(error_number() == [no_such_entry, no_folder])) facts%kind = no_file
         return
      end if
      facts%kind = other_file
      k = findloc(modes == iand(number_at(28, 2), kind_bits), .true., dim=1)
      if (k > 0) facts%kind = kinds(k)
      facts%inode = number_at(32, 8)
      facts%changed = number_at(112, 8)
      facts%device = number_at(136, 4)*2_i8**31 + number_at(140, 4)

   contains

      !> An integer in the structure, with the lowest byte first, as on all processors in use.
      integer(i8) function number_at(offset, bytes) result(number)
         integer, intent(in) :: offset, bytes
         integer :: k

         number = 0
         do k = bytes, 1, -1
            number = ior(ishft(number, 8), int(iachar(buffer(offset + k)), i8))
         end do
      end function number_at

   end function facts_of

   !> Lists the names in a folder, in system order, without '.' and '..'. The list is empty if the folder cannot be read.
   subroutine folder_names(path, names)
      character(*), intent(in) :: path
      type(message_list_t), intent(out) :: names
      integer, parameter :: name_offset = 19            ! of d_name in struct dirent: Linux, 64 bits
      integer, parameter :: most = 1024
      type(c_ptr) :: folder, entry
      character(kind=c_char), pointer :: letters(:)
      character(most) :: name
      integer :: k, ignored
      logical :: is_understood

      is_understood = .false.
      folder = c_opendir(path//c_null_char)
      if (.not. c_associated(folder)) return
      do
         entry = c_readdir(folder)
         if (.not. c_associated(entry)) exit
         call c_f_pointer(entry, letters, [name_offset + most])
         do k = 1, most
            if (letters(name_offset + k) == c_null_char) exit
            name(k:k) = letters(name_offset + k)
         end do
         if (k == 2 .and. name(1:1) == '.') is_understood = .true.
         if (k == 1 .or. k > most) cycle
         if (name(:k - 1) == '.' .or. name(:k - 1) == '..') cycle
         call names%add(name(:k - 1))
      end do
      ignored = c_closedir(folder)
      if (.not. is_understood) names = message_list_t()
   end subroutine folder_names

   !> Whether an open file or folder could be locked; .false. if another process holds the lock, or if the file cannot be locked.
   !> The lock is released when the file is closed or the process ends.
   logical function try_lock(descriptor)
      integer(c_int), intent(in) :: descriptor
      integer(c_int), parameter :: alone_and_at_once = 6      ! LOCK_EX + LOCK_NB

      try_lock = c_flock(descriptor, alone_and_at_once) == 0
   end function try_lock

   !> A string of 16 unpredictable hexadecimal digits. If the system provides no random bytes, the digits depend on the clock, and
   !> `attempt` distinguishes two calls at the same time.
   function random_tag(attempt) result(tag)
      integer, intent(in) :: attempt
      character(16) :: tag
      character(kind=c_char) :: bytes(8)
      procedure(random_procedure), pointer :: getentropy
      type(c_funptr) :: address
      integer(i8) :: ticks
      integer :: k

      address = c_dlsym(c_null_ptr, 'getentropy'//c_null_char)
      bytes = c_null_char
      k = -1
      if (c_associated(address)) then
         call c_f_procpointer(address, getentropy)
         k = getentropy(bytes, 8_c_size_t)
      end if
      if (k /= 0) then
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
      character(kind=c_char) :: letters(65)

      letters = c_null_char
      name = ''
      if (c_gethostname(letters, 64_c_size_t) == 0) name = text_of(letters)
   end function host_name

   !> The working folder; '.' if it has no path.
   function working_folder() result(path)
      character(:), allocatable :: path
      character(kind=c_char) :: letters(max_letters)

      path = '.'
      letters = c_null_char
      if (.not. c_associated(c_getcwd_raw(letters, int(max_letters, c_size_t)))) return
      path = text_of(letters)
   end function working_folder

   !> The folder of the program that is running; '' if it is unknown.
   function program_folder() result(path)
      character(:), allocatable :: path
      character(kind=c_char) :: letters(max_letters)
      integer(c_size_t) :: length

      letters = c_null_char
      length = c_readlink('/proc/self/exe'//c_null_char, letters, int(max_letters - 1, c_size_t))
      path = ''
      if (length < 1) return
      path = text_of(letters)
      path = path(:max(1, index(path, '/', back=.true.) - 1))
   end function program_folder

   !> The characters before the first null character.
   pure function text_of(letters) result(text)
      character(kind=c_char), intent(in) :: letters(:)
      character(:), allocatable :: text
      integer :: length

      length = findloc([letters == c_null_char, .true.], .true., dim=1) - 1
      text = transfer(letters(:length), repeat(' ', length))
   end function text_of

   !> Whether a path is a folder.
   logical function folder_exists(path)
      character(*), intent(in) :: path

      folder_exists = .false.
      if (len(path) > 0) folder_exists = c_access(path//'/.'//c_null_char, 0_c_int) == 0      ! F_OK
   end function folder_exists

   !> Whether all bytes of a string were written to an open descriptor.
   logical function write_bytes(descriptor, text)
      integer(c_int), intent(in) :: descriptor
      character(*), intent(in) :: text
      integer(c_size_t) :: done, now

      done = 0
      do while (done < len(text, c_size_t))
         now = c_write(descriptor, text(done + 1:), len(text, c_size_t) - done)
         if (now < 1) then                                   ! a ssize_t: negative on failure
            if (error_number() == interrupted) cycle
            exit
         end if
         done = done + now
      end do
      write_bytes = done == len(text, c_size_t)
   end function write_bytes

   !> Sets the action of a signal: ignored with `is_ignored`, otherwise the system's default.
   subroutine set_signal(number, is_ignored)
      integer, intent(in) :: number
      logical, intent(in) :: is_ignored
      type(c_funptr) :: action, ignored

      action = c_null_funptr                                                        ! SIG_DFL
      if (is_ignored) action = transfer(1_c_intptr_t, c_null_funptr)                ! SIG_IGN
      ignored = c_signal(int(number, c_int), action)
   end subroutine set_signal

   !> Prepares this process: corrects settings made by a batch system, a shell or a pipe. Only the main program may call it,
   !> once, before anything else.
   !>
   !> A reader that closes the pipe (`| head`) and a file that reaches `ulimit -f` become write errors instead of ending the
   !> process. Descriptors 0, 1 and 2 are opened if they were closed (`>&-`). Otherwise a results file could get one of these
   !> numbers, and messages would be written into the file.
   subroutine prepare_surroundings()
      type(c_ptr) :: stays_open
      integer(c_int) :: descriptor, copy
      integer :: k, ignored

      call set_signal(sigpipe, is_ignored=.true.)
      call set_signal(sigxfsz, is_ignored=.true.)
      do k = 0, 2
         descriptor = int(k, c_int)
         copy = c_dup(descriptor)
         if (copy >= 0) then
            ignored = c_close(copy)
         else if (k == 0) then                                            ! open takes the lowest free number: this one
            stays_open = c_fopen('/dev/null'//c_null_char, 'w'//c_null_char)      ! reading fails, as it did
         else
            stays_open = c_fopen('/dev/null'//c_null_char, 'r'//c_null_char)      ! writing fails
         end if
      end do
   end subroutine prepare_surroundings

   !> The error number (errno) of the last failure in the C library.
   integer function error_number()
      integer(c_int), pointer :: number

      call c_f_pointer(c_errno(), number)
      error_number = number
   end function error_number

   !> The C library's message for its last failure.
   function system_reason() result(reason)
      character(:), allocatable :: reason
      character(kind=c_char), pointer :: letters(:)
      type(c_ptr) :: text

      text = c_strerror(int(error_number(), c_int))
      reason = 'unknown reason'
      if (.not. c_associated(text)) return
      call c_f_pointer(text, letters, [c_strlen(text)])
      reason = text_of(letters)
   end function system_reason

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
