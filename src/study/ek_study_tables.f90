!> The tables of a finished study, from its chunks: one row per design, and one row per state of every design.
!>
!> The chunks are read one after the other, so that a million designs need no more memory than one chunk.
module ek_study_tables
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_file
   use ek_text, only: str, plural
   use ek_version, only: version
   use ek_file, only: join_path
   use ek_table, only: table_t, new_table, name_length, csv_head, put_csv_row, csv_length
   use ek_writer, only: writer_t, begin_file
   use ek_noise, only: widen
   use ek_study, only: study_t, kind_names
   use ek_sampler_kind, only: sampler_kinds, grid_kind
   use ek_sampler_settings, only: seed_text
   use ek_factor_paths, only: label_of
   use ek_study_plan, only: study_plan_t, first_of, designs_in
   use ek_study_run, only: parts_folder
   use ek_chunk, only: chunk_t, read_chunk, kernel_of, chunk_name, reason_of, design_invalid
   use ek_store_description, only: keeps
   implicit none(type, external)
   private
   public :: study_counts_t, write_tables, count_designs, responses_name, curves_name, has_limits, limits_of, tables_of, &
      repeated_factors, kernels_text, kernel_words, quoted_field

   integer, parameter :: max_reasons = 10        !! number of reasons that are printed; all reasons are in the table
   integer, parameter :: most_repeated = 10      !! largest number of factors that the table of states repeats in each row

   !> Counts of the designs of a study by status, and sizes for the tables.
   type :: study_counts_t
      integer :: designs(0:design_invalid) = 0                !! number of designs of each status
      integer :: within = 0                                  !! number of solved designs that satisfy all limits of the responses
      logical :: is_missing = .false.                        !! a chunk is missing or damaged; the counts are then incomplete
      type(message_list_t) :: reasons !! messages of the first failed designs, with the settings of each design
      integer :: states = 0                                  !! largest number of states of a design
      type(message_list_t) :: kernels                        !! kernels of the BLAS with which the chunks were computed
      integer :: reason = 0                                  !! length of the longest reason of a failed design
   end type study_counts_t

contains

   !> Name of a table of a study: the table of designs (1) or of states (2).
   pure function tables_of(study_name, number) result(name)
      character(*), intent(in) :: study_name
      integer, intent(in) :: number
      character(:), allocatable :: name
      name = study_name//'_curves.csv'
      if (number == 1) name = study_name//'_responses.csv'
   end function tables_of

   !> Number of factors that the table of states repeats in each row: all factors, or 0 if their number exceeds the limit.
   pure integer function repeated_factors(factors)
      integer, intent(in) :: factors
      repeated_factors = merge(factors, 0, factors <= most_repeated)
   end function repeated_factors

   !> The name of the table of designs.
   pure function responses_name(study) result(name)
      type(study_t), intent(in) :: study
      character(:), allocatable :: name
      name = tables_of(study%name, 1)
   end function responses_name

   !> The name of the table of states.
   pure function curves_name(study) result(name)
      type(study_t), intent(in) :: study
      character(:), allocatable :: name
      name = tables_of(study%name, 2)
   end function curves_name

   !> Writes the table of designs and, if the study has columns, the table of states as CSV. Each table is complete, or is not
   !> written.
   !>
   !> gnuplot needs an empty line after every curve, and in the table of designs after every block of a grid.
   subroutine write_tables(study, plan, out, counts, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(study_counts_t), intent(out) :: counts
      type(error_t), allocatable, intent(out) :: error
      type(writer_t) :: rows, curves
      type(chunk_t) :: chunk
      logical :: has_curves, is_begun
      integer :: k

      is_begun = .false.
      has_curves = plan%columns > 0
      call list_kernels(study, plan, out, counts)
      call begin_file(rows, join_path(out, responses_name(study)), error)
      if (.not. allocated(error) .and. has_curves) call begin_file(curves, join_path(out, curves_name(study)), error)
      if (.not. allocated(error)) then
         call rows%add(head_of(study, plan, counts, [character(name_length) :: plan%factor_heads, plan%heads, &
            last_columns(study)]))
         if (has_curves) call curves%add(head_of(study, plan, counts, [character(name_length) :: &
            plan%factor_heads(:repeated_factors(size(plan%factor_heads))), 'factor', study%columns]))
         do k = 1, plan%chunks
            call load_chunk(study, plan, out, k, chunk, error)
            counts%is_missing = allocated(error)
            if (allocated(error)) exit
            call count_chunk(study, plan, chunk, counts)
            call add_rows(study, plan, chunk, rows)
            if (has_curves) call add_curves(chunk, is_begun, curves)
         end do
      end if
      if (.not. allocated(error)) call rows%finish(error)
      if (.not. allocated(error) .and. has_curves) call curves%finish(error)
      call rows%abandon()                                    ! no effect on a finished table
      call curves%abandon()
   end subroutine write_tables

   !> Counts the designs by status, and the sizes that the tables need. No table is written.
   subroutine count_designs(study, plan, out, counts, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(study_counts_t), intent(out) :: counts
      type(error_t), allocatable, intent(out) :: error
      type(chunk_t) :: chunk
      integer :: k

      call list_kernels(study, plan, out, counts)
      do k = 1, plan%chunks
         call load_chunk(study, plan, out, k, chunk, error)
         counts%is_missing = allocated(error)
         if (allocated(error)) return
         call count_chunk(study, plan, chunk, counts)
      end do
   end subroutine count_designs

   !> Lists the BLAS kernels with which the chunks were computed. Each kernel is listed once, in the order of the chunks.
   subroutine list_kernels(study, plan, out, counts)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(study_counts_t), intent(inout) :: counts
      character(:), allocatable :: kernel
      integer :: j, k

      do k = 1, plan%chunks
         kernel = kernel_of(join_path(parts_folder(study, out), chunk_name(k)))
         if (kernel == '') cycle
         do j = 1, counts%kernels%count()
            if (counts%kernels%line(j) == kernel) exit
         end do
         if (j > counts%kernels%count()) call counts%kernels%add(kernel)
      end do
   end subroutine list_kernels

   !> The BLAS kernels of a study, for instance 'Haswell', or 'Haswell and SkylakeX'; '' if no kernel is known.
   function kernels_text(counts) result(text)
      type(study_counts_t), intent(in) :: counts
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, counts%kernels%count()
         if (k > 1) text = text//' and '
         text = text//counts%kernels%line(k)
      end do
   end function kernels_text

   !> The BLAS kernels for a header, for instance ', BLAS kernel Haswell'; '' if no kernel is known.
   pure function kernel_words(kernels) result(text)
      character(*), intent(in) :: kernels            !! result of kernels_text
      character(:), allocatable :: text

      text = ''
      if (kernels /= '') text = ', BLAS kernel '//kernels
   end function kernel_words

   !> Reads chunk k from its file. A missing or damaged chunk is an error.
   subroutine load_chunk(study, plan, out, k, chunk, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: path
      logical :: is_good

      path = join_path(parts_folder(study, out), chunk_name(k))
      call read_chunk(path, plan%identity, first_of(plan, k), designs_in(plan, k), chunk, is_good, error)
      if (.not. is_good .and. .not. allocated(error)) call fail(error, exit_file, path//': the chunk is missing or damaged')
   end subroutine load_chunk

   !> Counts the designs of a chunk by status, and updates the sizes that the tables need.
   subroutine count_chunk(study, plan, chunk, counts)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(chunk_t), intent(in) :: chunk
      type(study_counts_t), intent(inout) :: counts
      character(:), allocatable :: reason
      real(wp), allocatable :: limits(:, :)
      integer :: k

      allocate (limits, source=limits_of(study, plan%heads, plan%tolerance))
      do k = 1, size(chunk%status)
         if (chunk%status(k) == 0 .and. keeps(chunk%responses(:, k), limits(1, :), limits(2, :))) &
            counts%within = counts%within + 1
         counts%designs(chunk%status(k)) = counts%designs(chunk%status(k)) + 1
         counts%states = max(counts%states, chunk%states(k))
         if (chunk%status(k) == 0) cycle
         reason = reason_of(chunk, k)
         counts%reason = max(counts%reason, len(reason))
         if (counts%reasons%count() < max_reasons) call counts%reasons%add('design '//str(int(chunk%first) + k - 1)//' ('// &
            label_of(study, chunk%factors(:, k))//'): '//reason)
      end do
   end subroutine count_chunk

   !> The header lines and the column headings of a table.
   function head_of(study, plan, counts, columns) result(text)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(study_counts_t), intent(in) :: counts
      character(*), intent(in) :: columns(:)      !! column headings after the column of the design index
      character(:), allocatable :: text
      type(table_t) :: table

      table = new_table([character(name_length) :: 'design', columns], 0)
      call table%header%add('study '//study%name//', kind '//trim(kind_names(study%kind))//', '// &
         plural(plan%designs, 'design', 'designs')//seed_of(study))
      call table%header%add('elastokin '//version//', deck checksum '//plan%deck_sum//', study '//plan%identity// &
         kernel_words(kernels_text(counts)))
      text = csv_head(table)
   end function head_of

   !> The seed for a header, for instance ', seed 1'; '' for a kind that draws no random numbers.
   function seed_of(study) result(text)
      type(study_t), intent(in) :: study
      character(:), allocatable :: text

      text = ''
      if (sampler_kinds(study%kind)%has_seed) text = ', seed '//seed_text(study%settings)
   end function seed_of

   !> Appends the rows of a chunk to the table of designs.
   subroutine add_rows(study, plan, chunk, rows)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(chunk_t), intent(in) :: chunk
      type(writer_t), intent(inout) :: rows
      real(wp), allocatable :: values(:), limits(:, :)
      logical, allocatable :: is_whole(:)
      character(:), allocatable :: line
      integer :: k, n, many, block, filled

      n = 1 + size(chunk%factors, 1) + size(chunk%responses, 1)
      many = n + merge(2, 1, has_limits(study))
      allocate (values(many), is_whole(many))
      allocate (character(csv_length(many)) :: line)
      is_whole = .true.
      is_whole(2:n) = .false.
      block = block_of(study)
      allocate (limits, source=limits_of(study, plan%heads, plan%tolerance))
      do k = 1, size(chunk%status)
         values(1) = real(chunk%first + k - 1, wp)
         values(2:size(chunk%factors, 1) + 1) = chunk%factors(:, k)
         values(size(chunk%factors, 1) + 2:n) = chunk%responses(:, k)
         if (many > n + 1) values(n + 1) = merge(1.0_wp, 0.0_wp, chunk%status(k) == 0 .and. &
            keeps(chunk%responses(:, k), limits(1, :), limits(2, :)))
         values(many) = chunk%status(k)
         if (block > 0 .and. chunk%first + k > 2) then
            if (mod(int(chunk%first) + k - 2, block) == 0) call rows%add(new_line('a'))
         end if
         call put_csv_row(values, is_whole, line, filled)
         call rows%add(line(:filled - 1)//','//quoted_field(reason_of(chunk, k))//new_line('a'))
      end do

   end subroutine add_rows

   !> The headings of the columns after the responses.
   pure function last_columns(study) result(names)
      type(study_t), intent(in) :: study
      character(name_length), allocatable :: names(:)

      names = [character(name_length) :: 'status', 'reason']
      if (has_limits(study)) names = [character(name_length) :: 'within', names]
   end function last_columns

   !> Whether any response of a study has a limit.
   pure logical function has_limits(study)
      type(study_t), intent(in) :: study
      has_limits = any(study%responses%lower > -huge(1.0_wp) .or. study%responses%upper < huge(1.0_wp))
   end function has_limits

   !> The limits of the responses, widened by noise: (lower and upper; response). A response that touches a limit is inside.
   pure function limits_of(study, heads, tolerance) result(limits)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: heads(:)           !! column headings of the responses
      real(wp), intent(in) :: tolerance              !! largest tolerance of the cases [m]
      real(wp) :: limits(2, size(study%responses))
      integer :: r

      do r = 1, size(study%responses)
         limits(:, r) = [study%responses(r)%lower, study%responses(r)%upper]
         call widen(trim(heads(r)), tolerance, limits(1, r), limits(2, r))
      end do
   end function limits_of

   !> Number of designs between two empty lines of the table of designs; 0 if the table has no empty lines.
   pure integer function block_of(study)
      type(study_t), intent(in) :: study

      block_of = 0
      if (study%kind /= grid_kind .or. size(study%factors) < 2) return
      block_of = study%settings%levels
      if (allocated(study%factors(size(study%factors))%values)) block_of = size(study%factors(size(study%factors))%values)
   end function block_of

   !> A string as a quoted CSV field (RFC 4180) on one line, with '; ' instead of each line end. An empty string is an empty field.
   pure function quoted_field(text) result(field)
      character(*), intent(in) :: text
      character(:), allocatable :: field
      integer :: k

      field = ''
      if (text == '') return
      do k = 1, len(text)
         select case (text(k:k))
         case ('"')
            field = field//'""'
         case (new_line('a'))
            field = field//'; '
         case default
            field = field//text(k:k)
         end select
      end do
      field = '"'//field//'"'
   end function quoted_field

   !> Appends the states of the designs of a chunk to the table of states.
   subroutine add_curves(chunk, is_begun, curves)
      type(chunk_t), intent(in) :: chunk
      logical, intent(inout) :: is_begun          !! the table already contains a curve
      type(writer_t), intent(inout) :: curves
      real(wp) :: values(1 + repeated_factors(size(chunk%factors, 1)) + size(chunk%curves, 1))
      logical :: is_whole(size(values))
      character(csv_length(size(values))) :: line
      integer :: k, j, row, repeated, filled

      repeated = repeated_factors(size(chunk%factors, 1))
      is_whole = .false.
      is_whole(1) = .true.
      row = 0
      do k = 1, size(chunk%status)
         if (chunk%states(k) == 0) cycle
         if (is_begun) call curves%add(new_line('a'))
         is_begun = .true.
         do j = 1, chunk%states(k)
            row = row + 1
            values(1) = real(chunk%first + k - 1, wp)
            values(2:repeated + 1) = chunk%factors(:repeated, k)
            values(repeated + 2:) = chunk%curves(:, row)
            call put_csv_row(values, is_whole, line, filled)
            call curves%add(line(:filled))
         end do
      end do
   end subroutine add_curves

end module ek_study_tables
