!> The one way in which a file comes to be: under a name that nobody can foresee, in the folder where it belongs, row by
!> row; when the last byte is on the disk it takes its name, in one step for every reader.
!>
!>     call begin_file(writer, path, error)
!>     call writer%add(text)                  ! as often as there is something; a failure is kept
!>     call writer%finish(error)              ! whole, or not there (and then what was there before still is)
!>
!> A temporary file is `.elastokin-<machine>-<random>.tmp`. Its process holds a lock on it, which goes with the process: one
!> without a lock, of this machine, is of a dead run, and `remove_stale` takes it away. Of another machine, whose locks
!> may not be seen here, one is dead when nothing was written to it for a day.
!>
!> What can be drawn again (a picture, a chart's script) takes its name in one step too, but is not waited for: the many
!> pictures of a report would take longer to reach the disk than to be drawn. After a power cut they may be empty.
!>
!> A part is for what is long in the making: `<path>.<machine>-<random>.part`. It stays when the run is killed, with all that was
!> flushed, and goes when a later run finishes the same file.
module ek_writer
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char, c_null_ptr, c_ptr, c_size_t, c_associated
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file, message_list_t
   use ek_buffer, only: buffer_t
   use ek_clock, only: seconds_since_1970
   use ek_posix, only: c_fopen, c_fwrite, c_write, c_fflush, c_fileno, c_fsync, c_fclose, c_rename, c_remove, c_mkdir, c_rmdir, &
      c_access, c_opendir, c_dirfd, c_closedir
   use ek_system, only: facts_t, facts_of, no_file, regular_file, folder_file, device_file, unknown_file, folder_names, &
      try_lock, random_tag, machine_tag, system_reason, error_number, already_there, not_for_this_kind
   implicit none(type, external)
   private
   public :: writer_t, begin_file, begin_part, move_file, remove_stale
   public :: scratch_t, begin_scratch, end_scratch

   character(*), parameter :: front = '.elastokin-', tail = '.tmp', part_tail = '.part'
   integer, parameter :: tag_length = 8 + 1 + 16            !! <machine>-<random>
   integer(i8), parameter :: a_day = 86400                  !! s
   integer, parameter :: most_attempts = 100                !! at a name that is free, and stays ours
   integer(c_int), parameter :: may_exist = 0               !! F_OK of access(2)
   integer(c_int), parameter :: mine_alone = 448            !! 0700

   !> A file in the making.
   type :: writer_t
      private
      type(c_ptr) :: stream = c_null_ptr
      character(:), allocatable :: path, temporary      !! temporary: '' for a device, which is written in place
      character(:), allocatable :: reason               !! of the first failure; '' while all is well
      logical :: is_part = .false., is_empty = .true.
      logical :: is_awaited = .true.                    !! on the disk before it takes its name
      type(buffer_t) :: rows                            !! of a part, since the last flush: they go out together
   contains
      procedure :: add => writer_add
      procedure :: flush => writer_flush
      procedure :: finish => writer_finish
      procedure :: abandon => writer_abandon
      procedure :: temporary_name => writer_temporary_name
   end type writer_t

   !> A folder of this run alone, for programs that write what they want.
   type :: scratch_t
      character(:), allocatable :: path
      type(c_ptr) :: lock = c_null_ptr
   end type scratch_t

contains

   !> Begin the file `path`. Nothing is there under this name, or what was there before, until it is finished.
   subroutine begin_file(writer, path, error, can_be_redrawn)
      type(writer_t), intent(out) :: writer
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      logical, intent(in), optional :: can_be_redrawn        !! then it is not waited for; else, and by default, it is
      type(facts_t) :: facts

      call start(writer, path)
      if (present(can_be_redrawn)) writer%is_awaited = .not. can_be_redrawn
      facts = facts_of(path, follow=.true.)
      if (c_access(path//'/.'//c_null_char, may_exist) == 0) then
         writer%reason = 'it is a folder'
      else if (facts%kind == device_file .or. is_device_name(path)) then
         writer%stream = c_fopen(path//c_null_char, 'wbe'//c_null_char)
         if (.not. c_associated(writer%stream)) writer%reason = system_reason()
      else if (facts%kind /= regular_file .and. facts%kind /= no_file .and. facts%kind /= unknown_file) then
         writer%reason = 'it is neither a file nor a device'
      else
         call open_temporary(writer, folder_of(path)//front, tail)
      end if
      if (len(writer%reason) > 0) call fail(error, exit_file, "cannot write '"//path//"': "//writer%reason)
   end subroutine begin_file

   !> Begin the file `path` as a part, which stays when the run is killed.
   subroutine begin_part(writer, path, error)
      type(writer_t), intent(out) :: writer
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason

      call start(writer, path)
      writer%is_part = .true.
      if (c_access(path//'/.'//c_null_char, may_exist) == 0) then
         writer%reason = 'it is a folder'
      else
         call open_temporary(writer, path//'.', part_tail)
      end if
      if (len(writer%reason) > 0) call fail(error, exit_file, "cannot write '"//path//"': "//writer%reason)
   end subroutine begin_part

   subroutine start(writer, path)
      type(writer_t), intent(inout) :: writer
      character(*), intent(in) :: path

      writer%path = path
      writer%temporary = ''
      writer%reason = ''
   end subroutine start

   !> Devices where the system cannot be asked. /dev/shm is a folder like others.
   pure logical function is_device_name(path)
      character(*), intent(in) :: path

      is_device_name = (index(path, '/dev/') == 1 .and. index(path, '/dev/shm/') /= 1) .or. index(path, '/proc/') == 1
   end function is_device_name

   !> A new file that this process has locked. O_EXCL (the x of the mode): a link planted under the name is not followed.
   subroutine open_temporary(writer, begin, end)
      type(writer_t), intent(inout) :: writer
      character(*), intent(in) :: begin, end                 !! of its path
      integer :: attempt, ignored

      do attempt = 1, most_attempts
         writer%temporary = begin//machine_tag()//'-'//random_tag(attempt)//end
         writer%stream = c_fopen(writer%temporary//c_null_char, 'wbxe'//c_null_char)
         if (.not. c_associated(writer%stream)) then
            if (error_number() == already_there) cycle
            exit
         end if
         ! in between another run may have taken it for a dead one's
         if (is_ours(c_fileno(writer%stream), writer%temporary)) return
         ignored = c_fclose(writer%stream)
      end do
      writer%reason = system_reason()
      writer%temporary = ''
   end subroutine open_temporary

   !> Locks what was just made. Where there are no locks at all, nobody takes it away before a day has passed.
   logical function is_ours(descriptor, path)
      integer(c_int), intent(in) :: descriptor
      character(*), intent(in) :: path
      integer, parameter :: held_by_another = 11             ! EWOULDBLOCK

      is_ours = .true.
      if (.not. try_lock(descriptor)) is_ours = error_number() /= held_by_another
      if (is_ours) is_ours = c_access(path//c_null_char, may_exist) == 0
   end function is_ours

   !> Bytes, as they are.
   subroutine writer_add(self, text)
      class(writer_t), intent(inout) :: self
      character(*), intent(in) :: text
      integer(c_size_t) :: length

      if (len(self%reason) > 0 .or. .not. c_associated(self%stream)) return
      length = len(text, c_size_t)
      self%is_empty = .false.
      if (self%is_part) then
         call self%rows%add(text)
      else if (c_fwrite(text, 1_c_size_t, length, self%stream) /= length) then
         self%reason = system_reason()
      end if
   end subroutine writer_add

   !> Hands over to the system what was added: it stays, whatever becomes of this process. What was added to a part since the
   !> last time goes in one call, so that a part that is left ends where a flush did.
   subroutine writer_flush(self)
      class(writer_t), intent(inout) :: self
      character(:), allocatable :: text
      integer(c_size_t) :: done, now

      if (len(self%reason) > 0 .or. .not. c_associated(self%stream)) return
      if (self%is_part) then
         text = self%rows%text()
         call self%rows%clear()
         done = 0
         do while (done < len(text, c_size_t))
            now = c_write(c_fileno(self%stream), text(done + 1:), len(text, c_size_t) - done)
            if (now < 1) then                                ! a ssize_t: negative on failure
               self%reason = system_reason()
               return
            end if
            done = done + now
         end do
      end if
      if (c_fflush(self%stream) /= 0) self%reason = system_reason()
   end subroutine writer_flush

   !> Every byte to the disk (unless it can be redrawn); then the file takes its name. Where something failed there is no new
   !> file; of a part the rows that are out stay, and are named.
   subroutine writer_finish(self, error)
      class(writer_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(:), allocatable :: words

      if (.not. c_associated(self%stream)) return
      call self%flush()
      if (len(self%reason) == 0 .and. self%is_awaited) then
         if (c_fsync(c_fileno(self%stream)) /= 0 .and. len(self%temporary) > 0) then
            if (error_number() /= not_for_this_kind) self%reason = system_reason()    ! not every file system knows fsync
         end if
      end if
      if (len(self%reason) == 0 .and. len(self%temporary) > 0) then                   ! still locked
         if (c_rename(self%temporary//c_null_char, self%path//c_null_char) /= 0) self%reason = system_reason()
      end if
      if (len(self%reason) == 0) then
         if (c_fclose(self%stream) /= 0 .and. len(self%temporary) == 0) self%reason = system_reason()
         self%stream = c_null_ptr
         if (len(self%temporary) > 0 .and. self%is_awaited) call keep_name(folder_of(self%path))
      end if
      if (len(self%reason) == 0) then
         if (self%is_part) call remove_parts(self%path)
         return
      end if
      words = "cannot write '"//self%path//"': "//self%reason
      if (self%is_part) words = words//'; what came before is in '//self%temporary
      call self%abandon()
      call fail(error, exit_file, words)
   end subroutine writer_finish

   !> Gives the file up: there will be none. A part stays as it is, if there is something in it. One that is finished is left
   !> alone.
   subroutine writer_abandon(self)
      class(writer_t), intent(inout) :: self
      integer :: ignored

      if (.not. c_associated(self%stream)) return
      if (len(self%temporary) > 0 .and. (self%is_empty .or. .not. self%is_part)) ignored = c_remove(self%temporary//c_null_char)
      ignored = c_fclose(self%stream)
      self%stream = c_null_ptr
   end subroutine writer_abandon

   !> Where the bytes are until the file is finished.
   function writer_temporary_name(self) result(path)
      class(writer_t), intent(in) :: self
      character(:), allocatable :: path

      path = ''
      if (allocated(self%temporary)) path = self%temporary
   end function writer_temporary_name

   !> Gives a whole picture of the same disk its place, in one step. It can be drawn again, and is not waited for.
   subroutine move_file(from, to, error)
      character(*), intent(in) :: from, to
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason

      if (c_access(to//'/.'//c_null_char, may_exist) == 0) then
         call fail(error, exit_file, "cannot write '"//to//"': it is a folder")
      else if (c_rename(from//c_null_char, to//c_null_char) /= 0) then
         call fail(error, exit_file, "cannot write '"//to//"': "//system_reason())
      end if
   end subroutine move_file

   !> The new name itself to the disk. Some file systems cannot; the file is then whole all the same.
   subroutine keep_name(folder)
      character(*), intent(in) :: folder
      type(c_ptr) :: handle
      integer :: ignored

      handle = c_opendir(folder//'.'//c_null_char)
      if (.not. c_associated(handle)) return
      ignored = c_fsync(c_dirfd(handle))
      ignored = c_closedir(handle)
   end subroutine keep_name

   !> A new folder in `folder`, which is there. Its owner alone may look into it.
   subroutine begin_scratch(folder, scratch, error)
      character(*), intent(in) :: folder
      type(scratch_t), intent(out) :: scratch
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      integer :: attempt, ignored

      do attempt = 1, most_attempts
         scratch%path = folder_of(folder//'/')//front//machine_tag()//'-'//random_tag(attempt)//tail
         if (c_mkdir(scratch%path//c_null_char, mine_alone) /= 0) then
            if (error_number() == already_there) cycle
            exit
         end if
         scratch%lock = c_opendir(scratch%path//c_null_char)
         if (.not. c_associated(scratch%lock)) cycle
         if (is_ours(c_dirfd(scratch%lock), scratch%path)) return
         ignored = c_closedir(scratch%lock)
         scratch%lock = c_null_ptr
      end do
      call fail(error, exit_file, "cannot make a folder in '"//folder//"': "//system_reason())
   end subroutine begin_scratch

   !> Takes a scratch folder away, with what is left in it.
   subroutine end_scratch(scratch)
      type(scratch_t), intent(inout) :: scratch
      integer :: ignored

      if (.not. c_associated(scratch%lock)) return
      call empty_folder(scratch%path)
      ignored = c_rmdir(scratch%path//c_null_char)
      ignored = c_closedir(scratch%lock)
      scratch%lock = c_null_ptr
   end subroutine end_scratch

   !> Removes the files of a folder. Links go, not what they point to; folders stay, none is made by a script of ours.
   subroutine empty_folder(path)
      character(*), intent(in) :: path
      type(message_list_t) :: names
      integer :: k, ignored

      call folder_names(path, names)
      do k = 1, names%count()
         ignored = c_remove(path//'/'//names%line(k)//c_null_char)
      end do
   end subroutine empty_folder

   !> Removes what dead runs have left in a folder. What cannot be removed, or is not understood, stays.
   subroutine remove_stale(folder)
      character(*), intent(in) :: folder
      type(message_list_t) :: names
      character(:), allocatable :: name
      integer :: k

      call folder_names(folder_of(folder//'/')//'.', names)
      do k = 1, names%count()
         name = names%line(k)
         if (index(name, front) /= 1 .or. len(name) /= len(front) + tag_length + len(tail)) cycle
         if (name(len(name) - len(tail) + 1:) /= tail) cycle
         call remove_dead(folder_of(folder//'/')//name, name(len(front) + 1:))
      end do
   end subroutine remove_stale

   !> Removes the parts that killed runs have left of a file that is now whole.
   subroutine remove_parts(path)
      character(*), intent(in) :: path
      type(message_list_t) :: names
      character(:), allocatable :: name, begin
      integer :: k

      begin = path(index(path, '/', back=.true.) + 1:)//'.'
      call folder_names(folder_of(path)//'.', names)
      do k = 1, names%count()
         name = names%line(k)
         if (index(name, begin) /= 1 .or. len(name) /= len(begin) + tag_length + len(part_tail)) cycle
         if (name(len(name) - len(part_tail) + 1:) /= part_tail) cycle
         call remove_dead(folder_of(path)//name, name(len(begin) + 1:))
      end do
   end subroutine remove_parts

   !> Removes a temporary file or folder if its run is dead. The lock is held meanwhile: two runs do not both remove it, and one
   !> that has just made it notices.
   subroutine remove_dead(path, tag)
      character(*), intent(in) :: path, tag                  !! tag: begins with that of its machine
      type(facts_t) :: facts, opened
      type(c_ptr) :: handle
      integer :: ignored

      facts = facts_of(path, follow=.false.)
      if (facts%kind /= regular_file .and. facts%kind /= folder_file) return
      if (tag(:8) /= machine_tag()) then
         if (facts%changed + a_day > seconds_since_1970()) return
      end if
      if (facts%kind == regular_file) then
         handle = c_fopen(path//c_null_char, 'r+be'//c_null_char)
         if (.not. c_associated(handle)) return
         if (try_lock(c_fileno(handle))) ignored = c_remove(path//c_null_char)
         ignored = c_fclose(handle)
      else
         handle = c_opendir(path//c_null_char)
         if (.not. c_associated(handle)) return
         if (try_lock(c_dirfd(handle))) then
            opened = facts_of(path, follow=.false.)          ! no link was put in its place
            if (opened%kind == folder_file .and. opened%inode == facts%inode .and. opened%device == facts%device) then
               call empty_folder(path)
               ignored = c_rmdir(path//c_null_char)
            end if
         end if
         ignored = c_closedir(handle)
      end if
   end subroutine remove_dead

   !> The folder of a path with its slash; '' for the working folder.
   pure function folder_of(path) result(folder)
      character(*), intent(in) :: path
      character(:), allocatable :: folder
      integer :: slash

      slash = len(path)
      if (slash > 1) then                                    ! of 'a//' the folder is 'a/'
         do while (slash > 1)
            if (path(slash:slash) /= '/' .or. path(slash - 1:slash - 1) /= '/') exit
            slash = slash - 1
         end do
      end if
      folder = path(:index(path(:slash), '/', back=.true.))
   end function folder_of

end module ek_writer
