!> The delivery of the files of a command: writes each file into one folder, prints its path and lists its name. Failures are
!> stored, so that a command writes all its files and then asks once:
!>
!>     box%folder = settings%out
!>     call box%put('bump.csv', table)
!>     call box%put('loads.csv', text)
!>     call box%finish(error)
!>
!> Only the first failure of a kind is stored. After a failure to write, no further file is written, printed or listed. A failure to
!> draw, or to print a path, does not stop the delivery, because the files exist.
module ek_outbox
   use ek_error, only: error_t, message_list_t
   use ek_file, only: join_path, write_whole, remove_file, write_standard_output, make_folder_of => make_folder
   use ek_table, only: table_t, write_csv
   use ek_drawing, only: run_gnuplot
   use ek_console, only: print_note
   use ek_listed_files, only: is_among
   use ek_run_log, only: log_output
   implicit none(type, external)
   private
   public :: outbox_t, outbox_in, keep_first

   type :: outbox_t
      character(:), allocatable :: folder                   !! existing folder of all files
      type(message_list_t) :: files                         !! names of the files written so far, in order, each once
      type(error_t), allocatable :: undrawn                 !! first failure to draw pictures
      type(error_t), allocatable, private :: unwritten      !! first failure to write a file
      type(error_t), allocatable, private :: unprinted      !! first failure to print a path
      type(message_list_t), private :: scripts, pictures    !! files of the next call of `draw`
   contains
      procedure, private :: put_text, put_table
      generic :: put => put_text, put_table
      procedure :: make_folder, write => write_file, announce, remove, add_script, draw, has_failed, take, finish
   end type outbox_t

contains

   !> An empty outbox of a folder.
   pure type(outbox_t) function outbox_in(folder) result(box)
      character(*), intent(in) :: folder
      box%folder = folder
   end function outbox_in

   !> Makes a folder in the folder of the outbox, unless it exists.
   subroutine make_folder(self, name)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name
      if (.not. self%has_failed()) call make_folder_of(join_path(self%folder, name), self%unwritten)
   end subroutine make_folder

   !> Writes a string as a file, and prints its path.
   subroutine put_text(self, name, text)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name, text                !! name: relative to the folder
      call self%write(name, text)
      call self%announce(name)
   end subroutine put_text

   !> Writes a table as a CSV file, and prints its path.
   subroutine put_table(self, name, table)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name
      type(table_t), intent(in) :: table

      if (self%has_failed()) return
      call write_csv(table, join_path(self%folder, name), self%unwritten)
      if (self%has_failed()) return
      call list_once(self%files, name)
      call self%announce(name)
   end subroutine put_table

   !> Writes a string as a file without printing its path.
   subroutine write_file(self, name, text, can_be_redrawn)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name, text
      logical, intent(in), optional :: can_be_redrawn       !! if .true., the call does not wait for the disk (ek_writer)

      if (self%has_failed()) return
      call write_whole(join_path(self%folder, name), text, self%unwritten, can_be_redrawn)
      if (.not. self%has_failed()) call list_once(self%files, name)
   end subroutine write_file

   !> Prints the path of a file to standard output and adds it to the log. A reader that closes the pipe (`| head`) is no failure.
   subroutine announce(self, name)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name
      type(error_t), allocatable :: error
      character(:), allocatable :: line

      if (self%has_failed()) return
      line = join_path(self%folder, name)//new_line('a')
      call log_output(line)
      if (allocated(self%unprinted)) return
      call write_standard_output(line, error)
      if (.not. allocated(error)) return
      if (len(error%message) > 0) call move_alloc(error, self%unprinted)
   end subroutine announce

   !> Removes files of an earlier run, so that they cannot be mistaken for results of this run.
   subroutine remove(self, names)
      class(outbox_t), intent(in) :: self
      character(*), intent(in) :: names(:)
      integer :: k

      do k = 1, size(names)
         call remove_file(join_path(self%folder, trim(names(k))))
      end do
   end subroutine remove

   !> Writes a gnuplot script that draws NAME.png and NAME.svg, or other pictures, at the next call of `draw`. A failure is a
   !> failure to draw.
   subroutine add_script(self, name, text, pictures)
      class(outbox_t), intent(inout) :: self
      character(*), intent(in) :: name, text                !! name: without extension
      type(message_list_t), intent(in), optional :: pictures     !! paths relative to the folder
      integer :: k

      if (self%has_failed() .or. allocated(self%undrawn)) return
      call write_whole(join_path(self%folder, name//'.gp'), text, self%undrawn, can_be_redrawn=.true.)
      if (allocated(self%undrawn)) return
      call list_once(self%files, name//'.gp')
      call self%scripts%add(name//'.gp')
      if (present(pictures)) then
         do k = 1, pictures%count()
            call self%pictures%add(pictures%line(k))
         end do
      else
         call self%pictures%add(name//'.png')
         call self%pictures%add(name//'.svg')
      end if
   end subroutine add_script

   !> Runs gnuplot on the scripts added since the last call. Prints a note if gnuplot is not installed.
   subroutine draw(self, is_quiet, reason)
      class(outbox_t), intent(inout) :: self
      logical, intent(in) :: is_quiet
      character(:), allocatable, intent(out) :: reason      !! reason for missing pictures; '' if they were drawn

      reason = ''
      if (self%has_failed()) return
      if (.not. allocated(self%undrawn)) call run_gnuplot(self%scripts, self%pictures, self%folder, reason, self%undrawn)
      if (len(reason) > 0) call print_note(is_quiet, reason)
      if (allocated(self%undrawn)) reason = self%undrawn%message
      self%scripts = message_list_t()
      self%pictures = message_list_t()
   end subroutine draw

   !> Whether a file could not be written.
   pure logical function has_failed(self)
      class(outbox_t), intent(in) :: self
      has_failed = allocated(self%unwritten)
   end function has_failed

   !> Takes the failure to write out of the outbox, so that further files are written.
   subroutine take(self, error)
      class(outbox_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error      !! exit_file
      call move_alloc(self%unwritten, error)
   end subroutine take

   !> Ends the delivery: sets `error` to the first failure to write, or else to draw, or else to print a path, unless `error` is
   !> already set.
   subroutine finish(self, error)
      class(outbox_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error    !! exit_file

      call keep_first(error, self%unwritten)
      call keep_first(error, self%undrawn)
      call keep_first(error, self%unprinted)
   end subroutine finish

   !> Adds a name to a list, unless the list contains it.
   pure subroutine list_once(list, name)
      type(message_list_t), intent(inout) :: list
      character(*), intent(in) :: name
      if (.not. is_among(name, list)) call list%add(name)
   end subroutine list_once

   !> Moves a later error to `error`, unless `error` is already set. A later error that is not moved stays in `later`.
   pure subroutine keep_first(error, later)
      type(error_t), allocatable, intent(inout) :: error, later
      if (allocated(later) .and. .not. allocated(error)) call move_alloc(later, error)
   end subroutine keep_first

end module ek_outbox
