!> The contents of files, each read once: a second read of a file returns the stored bytes, even if the file has changed.
module ek_kept_files
   use ek_error, only: error_t
   use ek_file, only: read_whole, most_of_input
   implicit none(type, external)
   private
   public :: kept_files_t, add_file, keep_file, read_kept

   type :: kept_file_t
      character(:), allocatable :: path, text
   end type kept_file_t

   type :: kept_files_t
      private
      type(kept_file_t), allocatable :: list(:)
      integer :: used = 0
   contains
      procedure :: count => kept_count, path => kept_path, text => kept_text, has => kept_has
   end type kept_files_t

contains

   pure integer function kept_count(self)
      class(kept_files_t), intent(in) :: self
      kept_count = self%used
   end function kept_count

   !> The path with which file k was read.
   pure function kept_path(self, k) result(path)
      class(kept_files_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: path
      path = self%list(k)%path
   end function kept_path

   !> The content of file k, byte for byte.
   pure function kept_text(self, k) result(text)
      class(kept_files_t), intent(in) :: self
      integer, intent(in) :: k
      character(:), allocatable :: text
      text = self%list(k)%text
   end function kept_text

   !> Whether the content of a file is stored.
   pure logical function kept_has(self, path)
      class(kept_files_t), intent(in) :: self
      character(*), intent(in) :: path
      kept_has = place(self, path) > 0
   end function kept_has

   !> The index of a path among the stored files; 0 if the path is not stored.
   pure integer function place(files, path) result(k)
      type(kept_files_t), intent(in) :: files
      character(*), intent(in) :: path

      do k = files%used, 1, -1
         if (files%list(k)%path == path) return
      end do
   end function place

   !> Adds a file, unless its path is already stored.
   pure subroutine add_file(files, path, text)
      type(kept_files_t), intent(inout) :: files
      character(*), intent(in) :: path, text

      if (place(files, path) > 0) return
      if (.not. allocated(files%list)) allocate (files%list(8))
      if (files%used == size(files%list)) files%list = [files%list, files%list]      ! twice the size
      files%used = files%used + 1
      files%list(files%used)%path = path
      files%list(files%used)%text = text
   end subroutine add_file

   !> Reads a file and adds its content. A file that cannot be read is not added; its reader reports the reason.
   subroutine keep_file(files, path)
      type(kept_files_t), intent(inout) :: files
      character(*), intent(in) :: path
      type(error_t), allocatable :: error
      character(:), allocatable :: text

      if (place(files, path) > 0) return
      call read_whole(path, text, error, most=most_of_input)
      if (.not. allocated(error)) call add_file(files, path, text)
   end subroutine keep_file

   !> Returns the stored content of a file; if the file is not stored, reads its present content.
   subroutine read_kept(files, path, text, error)
      type(kept_files_t), intent(in) :: files
      character(*), intent(in) :: path
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error       !! exit_file, see read_whole
      integer :: k

      k = place(files, path)
      if (k > 0) then
         text = files%list(k)%text
      else
         call read_whole(path, text, error, most=most_of_input)
      end if
   end subroutine read_kept

end module ek_kept_files
