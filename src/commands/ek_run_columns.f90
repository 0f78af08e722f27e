!> run --columns a,b,c and --definitions NAME: chooses the columns of the results that are computed.
module ek_run_columns
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted, suggestion_by_part, is_like
   use ek_quantity, only: column_hint
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, is_mountable
   use ek_lone_case, only: heads_on_rig
   use ek_target, only: find_column
   use ek_table, only: name_length
   use ek_run_numbers, only: split_names
   use ek_definition, only: title_of
   use ek_defined_column, only: defined_t, define_columns, keep_named, is_named
   use ek_defined_table, only: needed_columns
   implicit none(type, external)
   private
   public :: choose_columns, choose_defined

contains

   !> Chooses the result columns that match a list of names or patterns with *, and the columns of the targets of the cases. All
   !> quantities may be named, regardless of the settings of the cases: the cases are set to compute all of them.
   subroutine choose_columns(list, suspension, cases, columns, error, option, others)
      character(*), intent(in) :: list                  !! names with commas between them
      type(suspension_t), intent(in) :: suspension      !! model on no rig
      type(case_t), intent(inout) :: cases(:)
      character(name_length), allocatable, intent(out) :: columns(:)
      type(error_t), allocatable, intent(out) :: error  !! exit_usage: all names that match no column
      character(*), intent(in), optional :: option      !! name of the option with the list, for messages; default --columns
      character(*), intent(in), optional :: others(:)   !! further columns that may be named
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: names(:), heads(:), all(:)
      character(:), allocatable :: given, hint
      logical, allocatable :: is_known(:)
      integer :: c, k

      given = '--columns'
      if (present(option)) given = option
      call split_names(list, names)
      allocate (is_known(size(names)), source=.false.)
      allocate (columns(0), all(0))
      cases%has_all = .true.
      do c = 1, size(cases)
         if (.not. is_mountable(cases(c))) cycle
         call heads_on_rig(suspension, cases(c), heads)
         if (present(others)) heads = [character(name_length) :: heads, others]
         do k = 1, size(names)
            call take(k)
         end do
         all = [character(name_length) :: all, heads]
         call take_target(cases(c), heads, columns)
      end do
      do k = 1, size(names)
         if (is_known(k)) cycle
         hint = column_hint(trim(names(k)), all, has_all=.true.)
         if (hint == '') hint = suggestion_by_part(trim(names(k)), all)
         call mistakes%add(given//': the results have no column '//quoted(trim(names(k)))//hint)
      end do
      if (size(names) == 0) call mistakes%add(given//': no column is named')
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())

   contains

      !> Adds the columns of this case that match name k.
      subroutine take(k)
         integer, intent(in) :: k
         integer :: j

         do j = 1, size(heads)
            if (.not. is_like(trim(heads(j)), trim(names(k)))) cycle
            is_known(k) = .true.
            if (.not. any(columns == heads(j))) columns = [character(name_length) :: columns, heads(j)]
         end do
      end subroutine take

   end subroutine choose_columns

   !> Chooses the columns of elastokin that columns of another program need, and the columns of the targets of the cases. The cases
   !> are set to compute all quantities.
   subroutine choose_defined(program, names, suspension, cases, columns, error, option)
      character(*), intent(in) :: program               !! one of `programs`
      character(*), intent(in) :: names(:)              !! names of columns of the program (is_named)
      type(suspension_t), intent(in) :: suspension      !! model on no rig
      type(case_t), intent(inout) :: cases(:)
      character(name_length), allocatable, intent(out) :: columns(:)
      type(error_t), allocatable, intent(out) :: error  !! exit_usage: all names that name no column
      character(*), intent(in) :: option                !! name of the option with the names, for messages
      type(defined_t), allocatable :: list(:)
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:), all(:)
      logical :: is_known(size(names))
      integer :: c, j, k

      allocate (columns(0), all(0))
      is_known = .false.
      cases%has_all = .true.
      do c = 1, size(cases)
         if (.not. is_mountable(cases(c))) cycle
         call heads_on_rig(suspension, cases(c), heads)
         call define_columns(suspension, heads, program, list)
         do k = 1, size(list)
            all = [character(name_length) :: all, list(k)%head]
            do j = 1, size(names)
               is_known(j) = is_known(j) .or. is_named(list(k), trim(names(j)))
            end do
         end do
         call keep_named(names, list)
         call needed_columns(heads, list, columns)
         call take_target(cases(c), heads, columns)
      end do
      do j = 1, size(names)
         if (.not. is_known(j) .and. names(j) /= '*') call mistakes%add(option//': no column '//quoted(trim(names(j)))// &
            ' in the definitions of '//title_of(program)//suggestion_by_part(trim(names(j)), all)// &
            '; elastokin list --definitions '//program//' lists all')
      end do
      if (size(names) == 0) call mistakes%add(option//': no column is named')
      if (mistakes%count() > 0) call fail(error, exit_usage, mistakes%text())
   end subroutine choose_defined

   !> Adds the column of the target of a case.
   subroutine take_target(case, heads, columns)
      type(case_t), intent(in) :: case
      character(name_length), intent(in) :: heads(:)
      character(name_length), allocatable, intent(inout) :: columns(:)
      type(error_t), allocatable :: absent
      integer :: place

      if (len(case%target) == 0) return
      call find_column(heads, trim(adjustl(case%target(:index(case%target, '=') - 1))), place, absent)
      if (.not. allocated(absent)) columns = [character(name_length) :: columns, heads(place)]
   end subroutine take_target

end module ek_run_columns
