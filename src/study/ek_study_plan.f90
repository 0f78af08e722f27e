!> The plan of a study: the designs by index, their division into chunks, and the identity of the study.
module ek_study_plan
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, message_list_t, fail, exit_deck, exit_file
   use ek_text, only: str, quoted, suggestion
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_version, only: version
   use ek_loaded_library, only: text_from_library
   use ek_table, only: name_length
   use ek_sheet, only: sheet_t, read_sheet, column_of, mistakes_of, head_place
   use ek_sheet_columns, only: take_columns
   use ek_deck, only: deck_t, deck_checksum
   use ek_sampler, only: sampler_t, new_sampler, sample, designs_of, factors_of, is_ordered, is_shifted
   use ek_sampler_kind, only: list_kind
   use ek_sampler_settings, only: sampler_settings_t, factor_t
   use ek_study, only: study_t, define_factor
   use ek_factor_numbers, only: deck_value
   use ek_designer, only: designer_t
   use ek_chunk, only: chunk_t, new_chunk
   implicit none(type, external)
   private
   public :: study_plan_t, new_plan, plan_sampler, begin_chunk, first_of, designs_in

   integer, parameter :: max_designs = 2000000000
   integer, parameter :: usual_chunks = 400       !! usual number of chunks of a study
   integer, parameter :: min_chunk = 50, max_chunk = 5000       !! limits of the number of designs in a chunk
   integer, parameter :: chunks_of_a_shard = 4    !! least number of chunks per shard, so that the shards have similar numbers of
                                                  !! designs
   integer, parameter :: most_numbers = 4000000   !! limit of the numbers in the curves of a chunk: 32 MB in each thread

   !> Data that all workers of a study share.
   type :: study_plan_t
      type(sampler_t) :: sampler
      integer :: designs = 0, chunk = 1, chunks = 0          !! number of designs; designs per chunk; number of chunks
      character(name_length), allocatable :: heads(:)        !! column headings of the responses
      character(name_length), allocatable :: factor_heads(:) !! column headings of the factors, with their units
      character(name_length), allocatable :: units(:)        !! units of the factors, '' if a factor has no unit
      integer :: columns = 0 !! length of a row of the curves: swept value and columns of the study; 0 without columns
      integer :: states = 0                                  !! number of states of the first case, in the design of the deck
      real(wp) :: tolerance = 0.0_wp                         !! largest tolerance of the cases [m]
      character(:), allocatable :: deck_sum                  !! checksum of the deck
      character(:), allocatable :: identity                  !! checksum: studies of equal identity have equal results, to rounding
      character(:), allocatable :: build                     !! build of the program, part of the identity
      character(:), allocatable :: kernel !! kernel of the BLAS on this processor, for instance 'Haswell'; '' if unknown
   end type study_plan_t

contains

   !> Creates the plan, from a designer that contains the design of the deck.
   subroutine new_plan(study, deck, home, designer, plan, error, shards, chunk, build)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: home                     !! folder of the study with its slash
      type(designer_t), intent(in) :: designer
      type(study_plan_t), intent(out) :: plan
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, exit_file
      integer, intent(in) :: shards                        !! number of shards of this run
      character(*), intent(in) :: build                    !! build of this program: version, commit, compiler, options
      integer, intent(in) :: chunk                         !! number of designs in an existing chunk; 0: no chunks exist
      type(sampler_settings_t) :: settings
      type(checksum_t) :: sum
      integer :: k

      call plan_sampler(study, home, designer, settings, plan%sampler, error)
      if (allocated(error)) return
      plan%designs = int(designs_of(plan%sampler))
      plan%chunk = study%chunk
      plan%columns = merge(size(study%columns) + 1, 0, size(study%columns) > 0)
      plan%states = designer%states
      plan%tolerance = maxval([(designer%workspace%cases(k)%case%tolerance, k=1, size(designer%case_names))])
      if (plan%chunk == 0) plan%chunk = min(max(plan%designs/usual_chunks, min_chunk), max_chunk, &
         max(most_numbers/max(plan%states*plan%columns, 1), 1))
      if (study%chunk == 0 .and. shards > 1) plan%chunk = max(1, min(plan%chunk, plan%designs/(chunks_of_a_shard*shards)))
      if (study%chunk == 0 .and. chunk > 0) plan%chunk = chunk
      plan%chunks = (plan%designs + plan%chunk - 1)/plan%chunk
      plan%units = designer%units
      plan%factor_heads = designer%heads
      allocate (plan%heads(size(designer%readings)))
      do k = 1, size(plan%heads)
         plan%heads(k) = designer%readings(k)%head
      end do
      plan%deck_sum = deck_checksum(deck)
      sum = study%sum
      plan%build = build
      plan%kernel = text_from_library('openblas_get_corename')
      call include(sum, version//' '//build//' '//plan%deck_sum//' '//str(plan%designs))
      if (is_shifted(plan%sampler)) call include(sum, ' shifted by half a cell')   ! not the designs of earlier versions
      if (is_ordered(plan%sampler)) call include(sum, ' ordered by rank')      ! not the designs of earlier versions
      call include_numbers(settings%rows)
      do k = 1, size(designer%readings)
         call include_numbers(designer%readings(k)%curve)
      end do
      plan%identity = digits_of(sum)

   contains

      !> Adds to the checksum the numbers of a list or a curve, which are read from a file that the study names.
      subroutine include_numbers(numbers)
         real(wp), allocatable, intent(in) :: numbers(:, :)
         integer :: j
         if (.not. allocated(numbers)) return
         do j = 1, size(numbers, 2)
            call include(sum, transfer(numbers(:, j), repeat(' ', 8*size(numbers, 1))))
         end do
      end subroutine include_numbers

   end subroutine new_plan

   !> Prepares the sampler of a study. Only begin_designer must have prepared the designer.
   subroutine plan_sampler(study, home, designer, settings, sampler, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: home                     !! folder of the study with its slash
      type(designer_t), intent(in) :: designer
      type(sampler_settings_t), intent(out) :: settings    !! settings of the sampler, with the rows of a list
      type(sampler_t), intent(out) :: sampler
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, exit_file
      type(factor_t) :: factors(size(study%factors))
      integer :: f

      settings = study%settings
      if (study%kind == list_kind) call read_list(study, home, designer, settings%rows, error)
      do f = 1, size(factors)
         if (.not. allocated(error)) call define_factor(study%factors(f), study%kind, &
            deck_value(designer%workspace%definition%parameters, designer%paths(f)), factors(f), error)
      end do
      if (.not. allocated(error)) then
         call new_sampler(settings, factors, sampler, error)
         if (allocated(error)) error%message = study%where//': '//error%message
      end if
      if (allocated(error)) return
      if (designs_of(sampler) > max_designs) then
         call fail(error, exit_deck, study%where//': the study has more than '//str(max_designs)//' designs')
      end if
   end subroutine plan_sampler

   !> Reads the designs of a list from a table with one column per factor. The heading of a column is the name of the factor, with
   !> or without its unit. Other columns are ignored.
   subroutine read_list(study, home, designer, rows, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: home
      type(designer_t), intent(in) :: designer
      real(wp), allocatable, intent(out) :: rows(:, :)     !! (factor, design)
      type(error_t), allocatable, intent(out) :: error     !! exit_file: all errors of the list
      type(sheet_t) :: sheet
      type(message_list_t) :: mistakes, located
      character(:), allocatable :: path
      integer :: places(size(study%factors)), f

      path = study%list
      if (index(path, '/') /= 1) path = home//path
      call read_sheet(path, sheet, error)
      if (allocated(error)) then
         error%message = study%where//': list: '//error%message
         return
      end if
      do f = 1, size(places)
         places(f) = column_of(sheet, study%factors(f)%name)
         if (places(f) == 0) places(f) = column_of(sheet, trim(designer%heads(f)))      ! the results of another study
         if (places(f) == 0 .and. sheet%head_line > 0) call sheet%head_mistakes%add(head_place(sheet)//'there is no column '// &
            quoted(study%factors(f)%name)//' for the factor in '//study%factors(f)%where// &
            suggestion(study%factors(f)%name, sheet%heads))
      end do
      if (all(places > 0)) call take_columns(sheet, places, rows, designer%units)
      call mistakes_of(sheet, mistakes)
      do f = 1, mistakes%count()
         call located%add(study%where//': list: '//mistakes%line(f))
      end do
      if (mistakes%count() > 0) call fail(error, exit_file, located%text())
   end subroutine read_list

   !> Index of the first design of a chunk.
   pure integer(i8) function first_of(plan, number)
      type(study_plan_t), intent(in) :: plan
      integer, intent(in) :: number               !! index of the chunk, from 1
      first_of = int(number - 1, i8)*plan%chunk + 1
   end function first_of

   !> The number of designs of a chunk.
   pure integer function designs_in(plan, number)
      type(study_plan_t), intent(in) :: plan
      integer, intent(in) :: number               !! index of the chunk, from 1
      designs_in = int(min(int(plan%chunk, i8), plan%designs - first_of(plan, number) + 1))
   end function designs_in

   !> Creates an empty chunk and computes the factors of its designs.
   subroutine begin_chunk(plan, number, chunk)
      type(study_plan_t), intent(in) :: plan
      integer, intent(in) :: number               !! index of the chunk, from 1
      type(chunk_t), intent(inout) :: chunk
      integer(i8) :: first
      integer :: k

      first = first_of(plan, number)
      call new_chunk(first, designs_in(plan, number), factors_of(plan%sampler), size(plan%heads), &
         plan%columns, plan%states, chunk)
      do k = 1, size(chunk%status)
         call sample(plan%sampler, first + k - 1, chunk%factors(:, k))
      end do
   end subroutine begin_chunk

end module ek_study_plan
