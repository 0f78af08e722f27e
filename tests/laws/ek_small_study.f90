!> Runs a study that a test has put together, in the scratch folder of the test, and reads its tables.
module ek_small_study
   use ek_error, only: error_t
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t
   use ek_file, only: make_folder, join_path, folder_exists
   use ek_table, only: table_t, read_csv
   use ek_study, only: study_t, study_factor_t, not_given, by_value
   use ek_designer, only: designer_t, new_designer
   use ek_study_plan, only: study_plan_t, new_plan
   use ek_study_run, only: run_options_t, run_state_t, open_parts, run_chunks
   use ek_ranks, only: ranks_t
   use ek_writer, only: scratch_t, end_scratch
   use ek_study_tables, only: study_counts_t, write_tables, responses_name, curves_name
   use ek_scratch, only: scratch
   implicit none(type, external)
   private
   public :: run_small, plain_factor

contains

   !> A factor with these values.
   function plain_factor(name, path, values, where) result(factor)
      use ek_kinds, only: wp
      character(*), intent(in) :: name, path, where
      real(wp), intent(in) :: values(:)
      type(study_factor_t) :: factor

      factor%name = name
      allocate (factor%paths(1))
      factor%paths(1) = path
      factor%lower = not_given()
      factor%upper = not_given()
      factor%nominal = not_given()
      factor%tolerance = not_given()
      factor%deviation = not_given()
      factor%values = values
      factor%where = where
   end function plain_factor

   !> The tables of a study, and how its designs ended.
   subroutine run_small(study, deck, responses, curves, counts, error, jobs)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(table_t), intent(out) :: responses, curves
      type(study_counts_t), intent(out) :: counts
      type(error_t), allocatable, intent(out) :: error
      integer, intent(in), optional :: jobs              !! usually 1
      character(*), parameter :: this_build = 'test'
      type(designer_t) :: designer
      type(definition_t), target :: definition
      type(study_plan_t) :: plan
      type(run_options_t) :: options
      type(ranks_t) :: ranks
      type(scratch_t) :: hold
      type(run_state_t) :: state
      character(:), allocatable :: folder

      if (present(jobs)) options%jobs = jobs
      folder = scratch('small')
      do while (folder_exists(folder))                   ! of an earlier study of the test
         folder = folder//'_'
      end do
      call make_folder(folder, error)
      if (.not. allocated(error)) call new_designer(study, deck, '', definition, designer, error)
      if (.not. allocated(error)) call new_plan(study, deck, '', designer, plan, error, 1, 0, this_build)
      if (.not. allocated(error)) call open_parts(study, plan, folder, hold, error)
      if (.not. allocated(error)) call run_chunks(study, plan, deck, folder, hold, options, designer, ranks, state, &
         be_silent, error)
      if (.not. allocated(error)) call write_tables(study, plan, folder, counts, error)
      call end_scratch(hold)
      if (.not. allocated(error)) &
         call read_csv(join_path(folder, responses_name(study)), responses, error, has_text=.true.)
      if (.not. allocated(error) .and. plan%columns > 0) &
         call read_csv(join_path(folder, curves_name(study)), curves, error)
   end subroutine run_small

   subroutine be_silent(state)
      type(run_state_t), intent(inout) :: state
      if (state%done < 0) error stop
   end subroutine be_silent

end module ek_small_study
