!> The results of a large study as one NetCDF-4 file, the store. This module decides whether to write the store, describes the
!> store, and calls the program elastokin-netcdf. If elastokin was built with NetCDF-Fortran, elastokin-netcdf is in the folder of
!> elastokin.
module ek_store
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, printable, plural
   use ek_version, only: version
   use ek_system, only: program_folder
   use ek_file, only: join_path, program_exists, read_whole, write_whole, remove_file
   use ek_writer, only: scratch_t, begin_scratch, end_scratch, move_file
   use ek_process, only: run_program
   use ek_noise, only: widen
   use ek_quantity, only: quantity_t, quantity_named, unit_of, unit_text
   use ek_study, only: study_t, study_factor_t, response_t, kind_names, change_names, by_delta, by_scale
   use ek_sampler_kind, only: sampler_kinds
   use ek_sampler_settings, only: seed_text
   use ek_study_plan, only: study_plan_t
   use ek_study_run, only: parts_folder
   use ek_study_tables, only: study_counts_t, has_limits, kernels_text
   use ek_store_description, only: store_t, store_variable_t, write_description, description_name, factor_role, response_role, &
      curve_role, whole_kind, real_kind
   implicit none(type, external)
   private
   public :: store_texts_t, keep_texts, wants_store, choose_store, write_store, read_store, store_name

   integer, parameter :: many_designs = 10000     !! number of designs above which the results are stored in NetCDF by default
   integer, parameter :: time_limit = 86400       !! limit for the helper program [s]; a million designs take a minute
   integer, parameter :: room = 2000000           !! number of bytes for which a full disk is tested
   integer, parameter :: longest_log = 2000       !! largest number of characters of the helper's message
   character(*), parameter :: helper_name = 'elastokin-netcdf', log_name = 'netcdf.log', &
      ended_with = 'it ended with status '         ! without a message

   !> Strings that are written to the store.
   type :: store_texts_t
      character(:), allocatable :: study, deck    !! contents of the study file and of the deck file
      character(:), allocatable :: changes        !! settings of --set, one per line
      character(:), allocatable :: swept, swept_unit     !! name of the swept value: 'wheel travel', 'mm'; '-' if it has no unit
   end type store_texts_t

contains

   !> Stores the present contents of the study file and of the deck file, and the settings of --set. The content is '' for a path
   !> that is not a file.
   subroutine keep_texts(study, deck, changes, texts)
      character(*), intent(in) :: study, deck              !! paths
      type(message_list_t), intent(in) :: changes          !! settings of --set
      type(store_texts_t), intent(out) :: texts
      type(error_t), allocatable :: unread

      call read_whole(study, texts%study, unread)
      call read_whole(deck, texts%deck, unread)
      texts%changes = changes%text()
   end subroutine keep_texts

   !> The file name of the store of a study.
   pure function store_name(study) result(name)
      type(study_t), intent(in) :: study
      character(:), allocatable :: name
      name = study%name//'.nc'
   end function store_name

   !> Whether a study stores its results in NetCDF if the helper program exists: the study gives format = 'netcdf', or gives no
   !> format and has many designs.
   pure logical function wants_store(study, designs)
      type(study_t), intent(in) :: study
      integer, intent(in) :: designs
      wants_store = study%format == 'netcdf' .or. (study%format == '' .and. designs > many_designs)
   end function wants_store

   !> Decides whether the results are written to a store. The helper program must exist, and the study must request a store, or have
   !> many designs and give no format.
   subroutine choose_store(study, plan, is_wanted, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      logical, intent(out) :: is_wanted
      type(error_t), allocatable, intent(out) :: error     !! exit_file: the study requests a store, but the helper program does not
                                                           !! exist
      logical :: has_helper

      is_wanted = wants_store(study, plan%designs)
      if (.not. is_wanted) return
      has_helper = helper_exists()
      if (study%format == 'netcdf' .and. .not. has_helper) call fail(error, exit_file, study%where//': format = ''netcdf'' '// &
         'needs the program '//helper_name//' in the folder of elastokin, '//program_folder()//'; install '// &
         'NetCDF-Fortran (Debian, Ubuntu: libnetcdff-dev) and build elastokin again, or write format = ''csv''')
      is_wanted = has_helper
   end subroutine choose_store

   logical function helper_exists()
      helper_exists = program_folder() /= ''
      if (helper_exists) helper_exists = program_exists(helper())
   end function helper_exists

   function helper() result(path)
      character(:), allocatable :: path
      path = join_path(program_folder(), helper_name)
   end function helper

   !> Writes the store from the chunks: the complete file, or no file.
   subroutine write_store(study, plan, out, texts, counts, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(store_texts_t), intent(in) :: texts
      type(study_counts_t), intent(in) :: counts
      type(error_t), allocatable, intent(out) :: error
      type(scratch_t) :: scratch
      type(store_t) :: store
      type(message_list_t) :: words
      character(:), allocatable :: parts, trouble

      parts = parts_folder(study, out)
      call describe(study, plan, texts, counts, store)
      call write_description(store, join_path(parts, description_name), error)
      if (.not. allocated(error)) call begin_scratch(out, scratch, error)
      if (allocated(error)) return
      call words%add(parts)
      call words%add(join_path(scratch%path, store_name(study)))
      call run_helper(words, scratch%path, trouble)
      if (len(trouble) > 0) then
         call fail(error, exit_file, helper_name//' could not write '//join_path(out, store_name(study))//': '//trouble// &
            '; the designs are stored: the same command writes it, with format = ''csv'' in the study as CSV')
      else
         call move_file(join_path(scratch%path, store_name(study)), join_path(out, store_name(study)), error, is_awaited=.true.)
      end if
      call end_scratch(scratch)
      call remove_file(join_path(parts, description_name))
   end subroutine write_store

   !> Reads a store and writes its tables as CSV into a folder. The table of states contains the curves of every n-th design.
   subroutine read_store(study, out, every, folder, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: out                      !! folder of the store
      integer, intent(in) :: every                         !! n
      character(*), intent(in) :: folder
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      type(message_list_t) :: words
      character(:), allocatable :: trouble

      if (.not. helper_exists()) then
         call fail(error, exit_file, join_path(out, store_name(study))//' can be read only with the program '//helper_name// &
            ' in the folder of elastokin, '//program_folder()//'; install NetCDF-Fortran (Debian, Ubuntu: '// &
            'libnetcdff-dev) and build elastokin again, or run the study with format = ''csv''')
         return
      end if
      call words%add('--csv')
      call words%add(join_path(out, store_name(study)))
      call words%add(folder)
      call words%add(str(every))
      call run_helper(words, folder, trouble)
      if (index(trouble, ended_with) == 1) trouble = trouble//'; the file is probably damaged'        ! a signal in HDF5
      if (len(trouble) > 0) call fail(error, exit_file, helper_name//' could not read '//join_path(out, store_name(study))//': '// &
         trouble)
   end subroutine read_store

   !> Runs the helper program. HDF5 file locks are switched off: no other process uses the file, and some network disks reject the
   !> lock.
   subroutine run_helper(arguments, folder, trouble)
      type(message_list_t), intent(in) :: arguments
      character(*), intent(in) :: folder                   !! folder for its messages
      character(:), allocatable, intent(out) :: trouble    !! '' if the helper program succeeded
      type(message_list_t) :: words
      type(error_t), allocatable :: unread, full
      character(:), allocatable :: log
      integer :: status, k, bytes

      call words%add('env')
      call words%add('HDF5_USE_FILE_LOCKING=FALSE')
      call words%add(helper())
      do k = 1, arguments%count()
         call words%add(arguments%line(k))
      end do
      call run_program(words, '.', join_path(folder, log_name), time_limit, status, trouble)
      if (len(trouble) > 0 .or. status == 0) return
      call read_whole(join_path(folder, log_name), log, unread)
      log = log(:min(len(log), longest_log))
      trouble = printable(log(:verify(log, ' '//new_line('a'), back=.true.)))
      if (len(trouble) == 0) trouble = ended_with//str(status)
      ! HDF5 does not say that the disk is full
      bytes = room                   ! a variable: gfortran would put the string of a constant into the program
      call write_whole(join_path(folder, 'room'), repeat(' ', bytes), full)
      if (allocated(full)) trouble = full%message(index(full%message, ': ', back=.true.) + 2:)
   end subroutine run_helper

   !> Describes a study for the helper program: sizes, names, units and strings.
   subroutine describe(study, plan, texts, counts, store)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(store_texts_t), intent(in) :: texts
      type(study_counts_t), intent(in) :: counts
      type(store_t), intent(out) :: store
      integer :: k, n

      store%identity = plan%identity
      store%designs = plan%designs
      store%chunks = plan%chunks
      store%states = counts%states
      store%reason = counts%reason
      store%has_limits = has_limits(study)
      associate (list => store%attributes)
         call list%add('Conventions', 'CF-1.8')
         if (study%title /= '') call list%add('title', study%title)
         if (study%title == '') call list%add('title', study%name)
         call list%add('source', 'elastokin '//version)
         call list%add('study', study%name)
         call list%add('kind', trim(kind_names(study%kind)))
         if (sampler_kinds(study%kind)%has_size) call list%add('samples', str(int(study%settings%size)), whole_kind)
         if (sampler_kinds(study%kind)%has_seed) call list%add('seed', seed_text(study%settings), whole_kind)
         call list%add('identity', plan%identity)
         call list%add('deck_checksum', plan%deck_sum)
         if (kernels_text(counts) /= '') call list%add('blas_kernels', kernels_text(counts))
         call list%add('study_text', texts%study)
         call list%add('deck_text', texts%deck)
         if (texts%changes /= '') call list%add('deck_changes', texts%changes)
      end associate
      allocate (store%variables(size(study%factors) + size(plan%heads) + plan%columns))
      do k = 1, size(study%factors)
         call begin_variable(store, k, trim(plan%factor_heads(k)), factor_role)
         call describe_factor(study%factors(k), trim(plan%units(k)), store%variables(k))
      end do
      n = size(study%factors)
      do k = 1, size(plan%heads)
         call begin_variable(store, n + k, trim(plan%heads(k)), response_role)
         call describe_response(study%responses(k), plan%tolerance, store%variables(n + k))
      end do
      n = n + size(plan%heads)
      if (plan%columns == 0) return
      call begin_variable(store, n + 1, 'factor', curve_role)
      if (texts%swept_unit == '-') call store%variables(n + 1)%attributes%add('units', '1')
      if (texts%swept_unit /= '-') call store%variables(n + 1)%attributes%add('units', texts%swept_unit)
      call store%variables(n + 1)%attributes%add('long_name', 'swept value: '//texts%swept)
      do k = 1, size(study%columns)
         call begin_variable(store, n + 1 + k, trim(study%columns(k)), curve_role)
         call describe_column(trim(study%columns(k)), store%variables(n + 1 + k))
      end do
   end subroutine describe

   !> Begins variable k with its name. If the name is already used, or reserved for a dimension or another variable, the role is
   !> appended to the name.
   subroutine begin_variable(store, k, head, role)
      type(store_t), intent(inout) :: store
      integer, intent(in) :: k
      character(*), intent(in) :: head, role
      character(*), parameter :: reserved(*) = [character(15) :: 'design', 'state', 'response', 'quantity', 'status', 'reason', &
         'within', 'response_name', 'quantity_name', 'reason_length', 'response_length', 'quantity_length']
      character(:), allocatable :: name
      logical :: is_taken
      integer :: j

      name = head
      do
         is_taken = any(reserved == name)
         do j = 1, k - 1
            if (store%variables(j)%name == name) is_taken = .true.
         end do
         if (.not. is_taken) exit
         name = name//'_'//role
      end do
      store%variables(k)%name = name
      store%variables(k)%role = role
      if (name /= head) call store%variables(k)%attributes%add('column_in_csv', head)
   end subroutine begin_variable

   subroutine describe_factor(factor, unit, variable)
      type(study_factor_t), intent(in) :: factor
      character(*), intent(in) :: unit                     !! '' if the factor has no unit
      type(store_variable_t), intent(inout) :: variable
      character(:), allocatable :: paths, long_name
      integer :: k

      paths = trim(factor%paths(1))
      long_name = paths
      if (size(factor%paths) > 1) long_name = paths//' and '//plural(size(factor%paths) - 1, 'more number', 'more numbers')
      do k = 2, size(factor%paths)
         paths = paths//', '//trim(factor%paths(k))
      end do
      if (factor%change == by_delta) long_name = long_name//', added to the deck'
      if (factor%change == by_scale) long_name = long_name//', as a multiple of the deck'
      associate (list => variable%attributes)
         if (unit == '') call list%add('units', '1')
         if (unit /= '') call list%add('units', unit)
         call list%add('long_name', long_name)
         call list%add('path', paths)
         call list%add('change', trim(change_names(factor%change)))
      end associate
   end subroutine describe_factor

   subroutine describe_response(response, tolerance, variable)
      type(response_t), intent(in) :: response
      real(wp), intent(in) :: tolerance           !! largest tolerance of the cases [m]
      type(store_variable_t), intent(inout) :: variable
      type(quantity_t) :: quantity
      character(:), allocatable :: text, over, units

      quantity = quantity_named(response%column)
      text = trim(quantity%title)
      over = response%over
      if (over == '') over = 'the wheel travel'
      select case (response%of)
      case ('value')
         text = text//' at '//str(response%at)
      case ('slope')
         text = text//', slope over '//over//' at '//str(response%at)
      case ('rms')
         text = text//', root mean square of the deviations from '//response%file
      case ('gradient')
         text = 'Gradient '//response%column
         if (response%side /= '') text = text//', '//response%side//' wheel'
      case ('difference')
         text = 'Difference of '//trim(response%names(1))//' and '//trim(response%names(2))
      case default
         text = text//', '//response%of
      end select
      units = units_of(variable%name)
      if (units == '1' .and. response%of /= 'slope' .and. response%of /= 'gradient') units = units_of(response%column)
      if (response%case /= '') text = text//', case '//response%case
      variable%lower = response%lower
      variable%upper = response%upper
      call widen(variable%name, tolerance, variable%lower, variable%upper)       ! a value that touches a limit is within
      associate (list => variable%attributes)
         call list%add('units', units)
         call list%add('long_name', text)
         if (response%column /= '') call list%add('column', response%column)
         call list%add('of', response%of)
         if (response%lower > -huge(1.0_wp)) call list%add('lower_limit', str(response%lower, 17), real_kind)
         if (response%upper < huge(1.0_wp)) call list%add('upper_limit', str(response%upper, 17), real_kind)
      end associate
   end subroutine describe_response

   subroutine describe_column(column, variable)
      character(*), intent(in) :: column
      type(store_variable_t), intent(inout) :: variable
      type(quantity_t) :: quantity

      quantity = quantity_named(column)
      call variable%attributes%add('units', units_of(column))
      call variable%attributes%add('long_name', trim(quantity%title))
      if (quantity%sign /= '') call variable%attributes%add('comment', trim(quantity%sign))
   end subroutine describe_column

   !> The unit at the end of a column heading; '1' if the heading has no unit.
   function units_of(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text

      text = '1'
      if (unit_of(name) /= '') text = unit_text(unit_of(name))
      if (text == '–') text = '1'
   end function units_of

end module ek_store
