!> Writes every output file: row by row under an unpredictable temporary name in the target folder; when the last byte is
!> on the disk the file is renamed, atomically for other readers.
!>
!>     call begin_file(writer, path, error)
!>     call writer%add(text)                  ! any number of times; a failure is stored
!>     call writer%finish(error)              ! the complete file, or none (an older file is then unchanged)
!>
!> A temporary file is named `.elastokin-<machine>-<random>.tmp`. Its process holds a lock on it until the process ends. An
!> unlocked file of this machine therefore belongs to a terminated run, and `remove_stale` removes it. Locks of other machines
!> may be invisible here: their files count as dead when nothing was written to them for a day (`renew_scratch` of a long run).
!>
!> Files that can be redrawn (pictures, scripts of charts) are renamed atomically too, but without waiting for the disk:
!> writing the many pictures of a report to the disk would take longer than drawing them. After a power cut they may be empty.
!>
!> A part is the temporary file of a long run: `<path>.<machine>-<random>.part`. If the run is killed it remains, with
!> everything that was flushed, until a later run finishes the same file.
module ek_writer
   use, intrinsic :: iso_c_binding, only: c_int32_t, c_null_char
   use ek_kinds, only: i8
   use ek_error, only: error_t, fail, exit_file, message_list_t
   use ek_buffer, only: buffer_t
   use ek_clock, only: seconds_since_1970
   use ek_system_call, only: c_open, c_sync, c_lock, c_close, c_rename, c_remove, c_make_folder, c_rmdir, c_exists, to_write, &
      to_update, to_create, to_hold_folder, done, already_there, try_again
   use ek_system, only: facts_t, facts_of, no_file, regular_file, folder_file, device_file, unknown_file, folder_names, &
      random_tag, machine_tag, system_reason, folder_exists, write_bytes
   implicit none(type, external)
   private
   public :: writer_t, begin_file, move_file, remove_stale, remove_empty_folder, find_users
   public :: scratch_t, begin_scratch, renew_scratch, end_scratch

   character(*), parameter :: front = '.elastokin-', tail = '.tmp', part_tail = '.part'
   integer, parameter :: tag_length = 8 + 1 + 16            !! <machine>-<random>
   integer(i8), parameter :: a_day = 86400                  !! a day [s]
   integer, parameter :: max_held = 60000                  !! characters that are held before they are written
   integer, parameter :: max_attempts = 100                !! attempts to create a file under a free name and to lock it
   integer(c_int32_t), parameter :: mine_alone = 1          !! a scratch folder is for its owner only

   !> A file being written.
   type :: writer_t
      private
      integer(c_int32_t) :: file = -1                   !! descriptor; −1: not open
      character(:), allocatable :: path, temporary      !! temporary: '' for a device, which is written directly
      character(:), allocatable :: reason               !! reason of the first failure; '' if there was none
      logical :: is_part = .false., is_empty = .true.
      logical :: is_awaited = .true.                    !! wait until the file is on the disk before it is renamed
      type(buffer_t) :: rows                            !! bytes added since the last flush
   contains
      procedure :: add => writer_add, flush => writer_flush, finish => writer_finish, abandon => writer_abandon, &
         temporary_name => writer_temporary_name
   end type writer_t

   !> A private folder of this run, for other programs to write into.
   type :: scratch_t
      character(:), allocatable :: path
      integer(c_int32_t) :: lock = -1                   !! descriptor of the folder; −1: not open
   end type scratch_t

contains

   !> Begins the file `path`. Until the file is finished, the path refers to the older file, or to no file.
   subroutine begin_file(writer, path, error, can_be_redrawn, is_part)
      type(writer_t), intent(out) :: writer
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      logical, intent(in), optional :: can_be_redrawn        !! if .true., do not wait for the disk; default .false.
      logical, intent(in), optional :: is_part               !! if .true., the part remains when the run is killed; default .false.
      type(facts_t) :: facts

      writer%path = path
      writer%temporary = ''
      writer%reason = ''
      if (present(can_be_redrawn)) writer%is_awaited = .not. can_be_redrawn
      if (present(is_part)) writer%is_part = is_part
      facts = facts_of(path, follow=.true.)
      if (folder_exists(path)) then
         writer%reason = 'it is a folder'
      else if (facts%kind == device_file .or. is_device_name(path)) then
         writer%file = c_open(path//c_null_char, to_write)
         if (writer%file < 0) writer%reason = system_reason()
      else if (facts%kind /= regular_file .and. facts%kind /= no_file .and. facts%kind /= unknown_file) then
         writer%reason = 'it is neither a file nor a device'
      else if (writer%is_part) then
         call open_temporary(writer, path//'.', part_tail)
      else
         call open_temporary(writer, folder_of(path)//front, tail)
      end if
      if (len(writer%reason) > 0) call fail(error, exit_file, "cannot write '"//path//"': "//writer%reason)
   end subroutine begin_file

   !> Whether a path is a device, judged by its name, where the system gives no file kind. /dev/shm is an ordinary folder.
   pure logical function is_device_name(path)
      character(*), intent(in) :: path

      is_device_name = (index(path, '/dev/') == 1 .and. index(path, '/dev/shm/') /= 1) .or. index(path, '/proc/') == 1
   end function is_device_name

   !> Creates a new file and locks it. A link planted under the name is not followed.
   subroutine open_temporary(writer, begin, end)
      type(writer_t), intent(inout) :: writer
      character(*), intent(in) :: begin, end                 !! of the path of the new file
      integer :: attempt, ignored

      do attempt = 1, max_attempts
         writer%temporary = begin//machine_tag()//'-'//random_tag(attempt)//end
         writer%file = c_open(writer%temporary//c_null_char, to_create)
         if (writer%file == already_there) cycle
         if (writer%file < 0) exit
         ! meanwhile another run may have removed it as a dead run's file
         if (is_ours(writer%file, writer%temporary)) return
         ignored = c_close(writer%file)
      end do
      writer%reason = system_reason()
      writer%file = -1
      writer%temporary = ''
   end subroutine open_temporary

   !> Whether a file just created still exists and no other run holds its lock. Without lock support, no other run removes it.
   logical function is_ours(file, path)
      integer(c_int32_t), intent(in) :: file
      character(*), intent(in) :: path

      is_ours = c_lock(file) /= try_again
      if (is_ours) is_ours = c_exists(path//c_null_char) /= 0
   end function is_ours

   !> Adds bytes unchanged.
   subroutine writer_add(self, text)
      class(writer_t), intent(inout) :: self
      character(*), intent(in) :: text
      integer :: outcome

      if (len(self%reason) > 0 .or. self%file < 0) return
      self%is_empty = .false.
      if (len(text) <= max_held .or. self%is_part) call self%rows%add(text)
      if (max(self%rows%length(), len(text)) > max_held .and. .not. self%is_part) call self%flush()
      if (len(text) <= max_held .or. self%is_part .or. len(self%reason) > 0) return
      call write_bytes(self%file, text, outcome)             ! not copied: a page has megabytes
      if (outcome /= done) self%reason = system_reason()
   end subroutine writer_add

   !> Passes the added bytes to the system, so that they survive the end of this process. The bytes added to a part since the last
   !> flush are written in one call, so that a remaining part always ends at a flush.
   subroutine writer_flush(self)
      class(writer_t), intent(inout) :: self
      integer :: outcome

      if (len(self%reason) > 0 .or. self%file < 0) return
      call write_bytes(self%file, self%rows%text(), outcome)
      if (outcome /= done) self%reason = system_reason()
      call self%rows%clear()
   end subroutine writer_flush

   !> Writes every byte to the disk (unless the file can be redrawn), then renames the file. After a failure there is no new file.
   !> The rows of a part that were written remain, and the message gives their path.
   subroutine writer_finish(self, error)
      class(writer_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      character(:), allocatable :: words

      if (self%file < 0) return
      call self%flush()
      if (len(self%reason) == 0 .and. self%is_awaited) then
         if (c_sync(self%file) /= done .and. len(self%temporary) > 0) self%reason = system_reason()
      end if
      if (len(self%reason) == 0 .and. len(self%temporary) > 0) then                   ! still locked
         if (c_rename(self%temporary//c_null_char, self%path//c_null_char) /= 0) self%reason = system_reason()
      end if
      if (len(self%reason) == 0) then
         if (c_close(self%file) /= 0 .and. len(self%temporary) == 0) self%reason = system_reason()
         self%file = -1
         if (len(self%temporary) > 0 .and. self%is_awaited) call keep_name(folder_of(self%path))
      end if
      if (len(self%reason) == 0) then
         if (self%is_part) call remove_tagged(folder_of(self%path), self%path(len(folder_of(self%path)) + 1:)//'.', part_tail)
         return
      end if
      words = "cannot write '"//self%path//"': "//self%reason
      if (self%is_part) words = words//'; the rows written so far are in '//self%temporary
      call self%abandon()
      call fail(error, exit_file, words)
   end subroutine writer_finish

   !> Abandons the file, so that no file is created. A part that is not empty remains. A finished file is left unchanged.
   subroutine writer_abandon(self)
      class(writer_t), intent(inout) :: self
      integer :: ignored

      if (self%file < 0) return
      if (len(self%temporary) > 0 .and. (self%is_empty .or. .not. self%is_part)) ignored = c_remove(self%temporary//c_null_char)
      ignored = c_close(self%file)
      self%file = -1
   end subroutine writer_abandon

   !> The temporary path, at which the bytes are stored until the file is finished.
   function writer_temporary_name(self) result(path)
      class(writer_t), intent(in) :: self
      character(:), allocatable :: path

      path = ''
      if (allocated(self%temporary)) path = self%temporary
   end function writer_temporary_name

   !> Moves a complete file to its final path on the same disk, atomically.
   subroutine move_file(from, to, error, is_awaited)
      character(*), intent(in) :: from, to
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      logical, intent(in), optional :: is_awaited            !! if .true., wait until it is on the disk; default .false.
      character(:), allocatable :: reason
      logical :: waits

      waits = .false.
      if (present(is_awaited)) waits = is_awaited
      reason = ''
      if (folder_exists(to)) reason = 'it is a folder'
      if (waits .and. len(reason) == 0) call await(from, reason)
      if (len(reason) == 0) then
         if (c_rename(from//c_null_char, to//c_null_char) /= 0) reason = system_reason()
      end if
      if (len(reason) > 0) then
         call fail(error, exit_file, "cannot write '"//to//"': "//reason)
      else if (waits) then
         call keep_name(folder_of(to))
      end if
   end subroutine move_file

   !> Waits until a file is on the disk.
   subroutine await(path, reason)
      character(*), intent(in) :: path
      character(:), allocatable, intent(inout) :: reason     !! set if the disk failed
      integer(c_int32_t) :: file
      integer :: ignored

      file = c_open(path//c_null_char, to_update)
      if (file < 0) then
         reason = system_reason()
         return
      end if
      if (c_sync(file) /= done) reason = system_reason()
      ignored = c_close(file)
   end subroutine await

   !> Writes the entries of a folder to the disk. Some file systems do not support this; the file is complete nevertheless.
   subroutine keep_name(folder)
      character(*), intent(in) :: folder
      integer(c_int32_t) :: file
      integer :: ignored

      file = c_open(folder//'.'//c_null_char, to_hold_folder)
      if (file < 0) return
      ignored = c_sync(file)
      ignored = c_close(file)
   end subroutine keep_name

   !> Creates a folder in the existing `folder`, accessible by its owner only.
   subroutine begin_scratch(folder, scratch, error)
      character(*), intent(in) :: folder
      type(scratch_t), intent(out) :: scratch
      type(error_t), allocatable, intent(out) :: error       !! exit_file, with path and reason
      integer :: attempt, outcome

      do attempt = 1, max_attempts
         scratch%path = folder_of(folder//'/')//front//machine_tag()//'-'//random_tag(attempt)//tail
         outcome = c_make_folder(scratch%path//c_null_char, mine_alone)
         if (outcome == already_there) cycle
         if (outcome /= done) exit
         scratch%lock = c_open(scratch%path//c_null_char, to_hold_folder)
         if (scratch%lock < 0) cycle
         if (is_ours(scratch%lock, scratch%path)) return
         outcome = c_close(scratch%lock)
         scratch%lock = -1
      end do
      call fail(error, exit_file, "cannot create a folder in '"//folder//"': "//system_reason())
   end subroutine begin_scratch

   !> Shows other machines that the run of a scratch folder is active.
   subroutine renew_scratch(scratch)
      type(scratch_t), intent(in) :: scratch
      integer :: ignored

      if (scratch%lock < 0) return
      ignored = c_make_folder(scratch%path//'/alive'//c_null_char, mine_alone)
      ignored = c_rmdir(scratch%path//'/alive'//c_null_char)
   end subroutine renew_scratch

   !> Removes a scratch folder and its content.
   subroutine end_scratch(scratch)
      type(scratch_t), intent(inout) :: scratch
      integer :: ignored

      if (scratch%lock < 0) return
      call remove_folder(scratch%path)
      ignored = c_close(scratch%lock)
      scratch%lock = -1
   end subroutine end_scratch

   !> Removes a folder with its files. Links are removed, but not their targets. A folder with subfolders remains.
   subroutine remove_folder(path)
      character(*), intent(in) :: path
      type(message_list_t) :: names
      integer :: k, ignored

      call folder_names(path, names)
      do k = 1, names%count()
         ignored = c_remove(path//'/'//names%line(k)//c_null_char)
      end do
      ignored = c_rmdir(path//c_null_char)
   end subroutine remove_folder

   !> Removes a folder if it is empty.
   subroutine remove_empty_folder(path)
      character(*), intent(in) :: path
      integer :: ignored

      ignored = c_rmdir(path//c_null_char)
   end subroutine remove_empty_folder

   !> Removes files of terminated runs from a folder. Anything that cannot be removed or identified remains.
   subroutine remove_stale(folder)
      character(*), intent(in) :: folder
      call remove_tagged(folder_of(folder//'/'), front, tail)
   end subroutine remove_stale

   !> Finds whether an active run has a temporary file or folder in a folder, and whether such a run is on this machine (is_here).
   subroutine find_users(folder, is_in_use, is_here)
      character(*), intent(in) :: folder
      logical, intent(out) :: is_in_use, is_here
      type(message_list_t) :: names
      integer :: k

      call remove_stale(folder)
      call folder_names(folder, names)
      is_in_use = .false.
      is_here = .false.
      do k = 1, names%count()
         if (index(names%line(k), front) == 1) is_in_use = .true.
         if (index(names%line(k), front//machine_tag()) == 1) is_here = .true.
      end do
   end subroutine find_users

   !> Removes files of terminated runs with the names <begin><machine>-<random><end>.
   subroutine remove_tagged(folder, begin, end)
      character(*), intent(in) :: folder                     !! with its slash
      character(*), intent(in) :: begin, end
      type(message_list_t) :: names
      character(:), allocatable :: name
      integer :: k

      call folder_names(folder//'.', names)
      do k = 1, names%count()
         name = names%line(k)
         if (len(name) /= len(begin) + tag_length + len(end)) cycle
         if (name(:len(begin)) == begin .and. name(len(begin) + tag_length + 1:) == end) &
            call remove_dead(folder//name, name(len(begin) + 1:))
      end do
   end subroutine remove_tagged

   !> Removes a temporary file or folder of a terminated run. The lock is held meanwhile. Two runs therefore never both remove the
   !> file, and a run that has just created the file notices the removal.
   subroutine remove_dead(path, tag)
      character(*), intent(in) :: path, tag                  !! tag: begins with the tag of its machine
      type(facts_t) :: facts, opened
      integer(c_int32_t) :: file
      integer :: ignored

      facts = facts_of(path, follow=.false.)
      if (facts%kind /= regular_file .and. facts%kind /= folder_file) return
      if (tag(:8) /= machine_tag()) then
         if (facts%changed + a_day > seconds_since_1970()) return
      end if
      if (facts%kind == regular_file) then
         file = c_open(path//c_null_char, to_update)
         if (file < 0) return
         if (c_lock(file) == done) ignored = c_remove(path//c_null_char)
         ignored = c_close(file)
      else
         file = c_open(path//c_null_char, to_hold_folder)
         if (file < 0) return
         if (c_lock(file) == done) then
            opened = facts_of(path, follow=.false.)          ! it must not have been replaced by a link
            if (opened%kind == folder_file .and. opened%inode == facts%inode .and. opened%device == facts%device) &
               call remove_folder(path)
         end if
         ignored = c_close(file)
      end if
   end subroutine remove_dead

   !> The folder of a path, with its slash; '' for the working folder.
   pure function folder_of(path) result(folder)
      character(*), intent(in) :: path
      character(:), allocatable :: folder
      folder = path(:index(path, '/', back=.true.))
   end function folder_of

end module ek_writer
