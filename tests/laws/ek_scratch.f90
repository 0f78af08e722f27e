!> A folder for the files of one test, which no other run of the tests has: made before, removed after.
!>
!>     @before → call make_scratch();  scratch('name') is a path in it;  @after → call remove_scratch()
module ek_scratch
   use, intrinsic :: iso_c_binding, only: c_char, c_null_char, c_ptr, c_associated
   implicit none(type, external)
   private
   public :: make_scratch, remove_scratch, scratch, shell_quoted

   character(:), allocatable :: folder      !! of this process; '' when it could not be made

   interface
      function c_mkdtemp(template) bind(c, name='mkdtemp') result(path)
         import :: c_char, c_ptr
         implicit none(type, external)
         character(kind=c_char), intent(inout) :: template(*)
         type(c_ptr) :: path
      end function c_mkdtemp
   end interface

contains

   !> Makes the folder, below TMPDIR; below /tmp if TMPDIR is not given or a shell would split or change its path, as tests put paths
   !> into command lines.
   subroutine make_scratch()
      character(kind=c_char), allocatable :: letters(:)
      character(*), parameter :: plain = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+,@'
      character(:), allocatable :: template
      integer :: length, k

      if (allocated(folder)) call remove_scratch()
      template = '/tmp'
      call get_environment_variable('TMPDIR', length=length)
      if (length > 0) then
         template = repeat(' ', length)
         call get_environment_variable('TMPDIR', value=template)
         if (verify(template, plain) > 0) template = '/tmp'
      end if
      template = template//'/elastokin_test_XXXXXX'//c_null_char
      allocate (letters(len(template)))
      do k = 1, len(template)
         letters(k) = template(k:k)
      end do
      folder = ''
      if (.not. c_associated(c_mkdtemp(letters))) return
      do k = 1, size(letters) - 1
         folder = folder//letters(k)
      end do
   end subroutine make_scratch

   !> Removes the folder with all that is in it.
   subroutine remove_scratch()
      integer :: ignored, started

      if (.not. allocated(folder)) return
      if (index(folder, '/elastokin_test_') > 0) &
         call execute_command_line('rm -rf '//shell_quoted(folder), exitstat=ignored, cmdstat=started)
      deallocate (folder)
   end subroutine remove_scratch

   !> A path in the folder; '' is the folder itself.
   function scratch(name) result(path)
      character(*), intent(in) :: name
      character(:), allocatable :: path

      path = '/nowhere'
      if (allocated(folder)) then
         if (len(folder) > 0) path = folder
      end if
      if (len(name) > 0) path = path//'/'//name
   end function scratch

   !> As one word of a shell.
   pure function shell_quoted(text) result(word)
      character(*), intent(in) :: text
      character(:), allocatable :: word
      integer :: k

      word = "'"
      do k = 1, len(text)
         if (text(k:k) == "'") then
            word = word//"'\''"
         else
            word = word//text(k:k)
         end if
      end do
      word = word//"'"
   end function shell_quoted

end module ek_scratch
