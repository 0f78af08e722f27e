!> The list of the files of a study, <study>-files.csv, with a checksum of each file (ek_listed_files): the tables, the page and the
!> figures. A later study of the same name removes the files of this study that it does not write itself, and `plot` rejects a table
!> that was changed after it was written.
module ek_study_list
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_file, only: join_path, file_exists
   use ek_text_table, only: text_table_t, read_text_table, cell_of
   use ek_listed_files, only: renew_file_list, check_listed
   use ek_console, only: print_warning
   implicit none(type, external)
   private
   public :: list_tables, list_figures, check_tables, study_list_name

   !> The tables of a study; the first is the table of a study of kind step_size.
   character(*), parameter :: table_endings(*) = [character(14) :: '.csv', '_responses.csv', '_curves.csv', '.nc', '_moments.csv', &
      '_shares.csv', '_bands.csv']

contains

   !> Name of the list of the files of a study. Names of studies have no hyphen, so the list is not the table of another study.
   pure function study_list_name(study) result(name)
      character(*), intent(in) :: study                     !! name of the study
      character(:), allocatable :: name
      name = study//'-files.csv'
   end function study_list_name

   !> Lists the tables that a study has just written, and removes the tables of an earlier study of this name. With `is_more`, the
   !> tables are added to those that are already listed.
   subroutine list_tables(study, out, tables, is_quiet, error, is_more)
      character(*), intent(in) :: study, out                !! name of the study; folder of the tables
      type(message_list_t), intent(in) :: tables            !! names of the tables
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the list cannot be written
      logical, intent(in), optional :: is_more              !! default .false.
      type(message_list_t) :: kept
      logical :: adds

      adds = .false.
      if (present(is_more)) adds = is_more
      call list_kept(study, out, with_tables=adds, with_figures=.true., names=kept)
      call renew_file_list(out, study_list_name(study), tables, 'study', is_quiet, error, kept)
   end subroutine list_tables

   !> Lists the page and the figures of a study, and removes the page and the figures of an earlier study of this name that were not
   !> drawn again.
   subroutine list_figures(study, out, files, is_quiet, error)
      character(*), intent(in) :: study, out                !! name of the study; folder of the tables
      type(message_list_t), intent(in) :: files             !! page and figures, relative to the folder
      logical, intent(in) :: is_quiet
      type(error_t), allocatable, intent(out) :: error      !! exit_file: the list cannot be written
      type(message_list_t) :: kept

      if (files%count() == 0) then
         if (.not. file_exists(join_path(out, study_list_name(study)))) return
      end if
      call list_kept(study, out, with_tables=.true., with_figures=.false., names=kept)
      call renew_file_list(out, study_list_name(study), files, 'study', is_quiet, error, kept)
   end subroutine list_figures

   !> Lists the tables of an existing list, or its other files, or all.
   subroutine list_kept(study, out, with_tables, with_figures, names)
      character(*), intent(in) :: study, out
      logical, intent(in) :: with_tables, with_figures
      type(message_list_t), intent(inout) :: names
      type(text_table_t) :: list
      type(error_t), allocatable :: unread
      integer :: k

      if (.not. file_exists(join_path(out, study_list_name(study)))) return
      call read_text_table(join_path(out, study_list_name(study)), list, unread)
      if (allocated(unread)) return                         ! renew_file_list prints the reason
      do k = 1, list%rows
         if (merge(with_tables, with_figures, is_table(study, cell_of(list, k, 'file')))) &
            call names%add(cell_of(list, k, 'file'))
      end do
   end subroutine list_kept

   !> Whether a file is a table of a study.
   pure logical function is_table(study, file)
      character(*), intent(in) :: study, file
      integer :: k

      is_table = .false.
      do k = 1, size(table_endings)
         is_table = is_table .or. file == study//trim(table_endings(k))
      end do
   end function is_table

   !> Checks that no table of a study was changed after it was written, and that the list contains the table `needed`. Without a
   !> list, as in folders of early versions, a warning is printed.
   subroutine check_tables(study, out, needed, error)
      character(*), intent(in) :: study, out                !! name of the study; folder of the tables
      character(*), intent(in) :: needed                    !! name of a table
      type(error_t), allocatable, intent(out) :: error      !! exit_file
      type(text_table_t) :: list
      character(:), allocatable :: path
      logical :: is_listed
      integer :: k

      path = join_path(out, study_list_name(study))
      if (.not. file_exists(path)) then
         call print_warning(path//' is missing: changed or damaged tables of the study are not recognised')
         return
      end if
      call read_text_table(path, list, error)
      is_listed = .false.
      if (.not. allocated(error)) then
         do k = 1, list%rows
            if (.not. is_table(study, cell_of(list, k, 'file'))) cycle
            is_listed = is_listed .or. cell_of(list, k, 'file') == needed
            call check_listed(out, cell_of(list, k, 'file'), cell_of(list, k, 'checksum'), error)
            if (allocated(error)) return
         end do
      end if
      if (allocated(error)) then
         error%message = error%message//'; run the study again'
      else if (.not. is_listed) then
         call fail(error, exit_file, join_path(out, needed)//': this is not the table of this study: '//path// &
            ' does not list it; run the study again')
      end if
   end subroutine check_tables

end module ek_study_list
