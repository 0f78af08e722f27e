!> Checks the targets of a deck's cases and the heads of the results before any solution, and reports all errors in them and
!> in the tables, which were read with the deck, together.
module ek_case_inputs
   use ek_error, only: error_t, message_list_t, fail, exit_deck, exit_file
   use ek_text, only: quoted
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_rig, only: mount
   use ek_sweep_table, only: sweep_columns
   use ek_target, only: find_column
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: check_inputs

contains

   !> Collects the mistakes of every table, finds the column of every target, compares all heads of the results.
   !>
   !> A message on a table gives the line in the file and the line of the case in the deck:
   !> `loads.csv:7: column 'fz_n': expected a number, found 'two'; in case 'bench' (front.nml:41)`.
   !> In a deck with other errors the cases are checked as far as possible.
   subroutine check_inputs(suspension, cases, error, is_whole)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_deck; exit_file if only files are at fault
      logical, intent(in), optional :: is_whole            !! the suspension is complete; default .true., else tables alone
      type(message_list_t) :: mistakes
      integer :: k, unread
      logical :: has_model

      has_model = .true.
      if (present(is_whole)) has_model = is_whole
      unread = 0
      if (has_model) call compare_heads(suspension, cases, mistakes)
      do k = 1, size(cases)
         call collect_table(cases, k, mistakes, unread)
         if (has_model) call look_up_target(suspension, cases(k), mistakes)
      end do
      if (mistakes%count() > 0) call fail(error, merge(exit_file, exit_deck, mistakes%count() == unread), mistakes%text())
   end subroutine check_inputs

   !> The mistakes in the table of case k, with all cases that name it, unless an earlier case names the same one.
   subroutine collect_table(cases, k, mistakes, unread)
      type(case_t), intent(in) :: cases(:)
      integer, intent(in) :: k
      type(message_list_t), intent(inout) :: mistakes
      integer, intent(inout) :: unread            !! files that cannot be read
      character(:), allocatable :: users
      integer :: j

      if (cases(k)%table%mistakes%count() == 0) return
      users = ''
      do j = 1, size(cases)
         if (cases(j)%file /= cases(k)%file) cycle
         if (j < k) return
         if (users /= '') users = users//', '
         users = users//'in case '//quoted(cases(j)%name)//' ('//cases(j)%where//')'
      end do
      do j = 1, cases(k)%table%mistakes%count()
         call mistakes%add(cases(k)%table%mistakes%line(j)//'; '//users)
      end do
      if (allocated(cases(k)%table%fault)) unread = unread + 1
   end subroutine collect_table

   !> Checks that the results of a case have the column of its target.
   subroutine look_up_target(suspension, case, mistakes)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: case
      type(message_list_t), intent(inout) :: mistakes
      type(suspension_t) :: mounted
      type(case_t) :: this
      type(error_t), allocatable :: error
      character(name_length), allocatable :: columns(:)
      integer :: mark, place

      if (.not. allocated(case%target)) return
      mark = index(case%target, '=')
      if (case%target(:max(mark - 1, 0)) == '') return
      if (.not. case%is_good .and. index(adjustl(case%target), 'rig_') == 1) return     ! the case cannot be mounted on the rig
      if (case%is_good .and. .not. is_mountable(case)) return
      if (case%is_good) then
         call mount(suspension, case, mounted, this)
         call sweep_columns(mounted, this, columns)
      else
         call sweep_columns(suspension, case, columns)
      end if
      call find_column(columns, trim(adjustl(case%target(:mark - 1))), place, error)
      if (allocated(error)) call mistakes%add(case%where//': case '//quoted(case%name)//': target: '//error%message)
   end subroutine look_up_target

   !> Refuses two result columns with the same head, as the names of different elements with their endings may coincide.
   subroutine compare_heads(suspension, cases, mistakes)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: mistakes
      character(name_length), allocatable :: columns(:)
      type(case_t) :: this
      character(:), allocatable :: owners, place
      integer :: j, k, m

      if (size(cases) == 0) return
      this%has_all = .true.
      call sweep_columns(suspension, this, columns)
      do k = 2, size(columns)
         do j = 1, k - 1
            if (columns(j) /= columns(k)) cycle
            owners = ''
            place = cases(1)%where(:index(cases(1)%where, ':', back=.true.) - 1)
            do m = 1, suspension%scalars
               call add_owner(suspension%elements(m)%name, suspension%elements(m)%where)
            end do
            do m = 1, size(suspension%readouts)
               call add_owner(suspension%readouts(m)%name, suspension%readouts(m)%where)
            end do
            do m = suspension%scalars + 1, size(suspension%elements)
               call add_owner(suspension%elements(m)%name, suspension%elements(m)%where)
            end do
            do m = 1, size(suspension%joints)
               call add_owner(suspension%joints(m)%name, suspension%joints(m)%where)
            end do
            call mistakes%add(place//': two columns of the results would have the name '//quoted(columns(k))// &
               owners//'; rename one')
            exit
         end do
      end do

   contains

      !> An element whose name begins that of the column.
      subroutine add_owner(name, where)
         character(*), intent(in) :: name, where

         if (index(columns(k), name//'_') /= 1) return
         owners = owners//trim(merge(', of   ', ' and of', owners == ''))//' '//quoted(name)//' ('//where//')'
         place = where
      end subroutine add_owner

   end subroutine compare_heads

end module ek_case_inputs
