!> A study as a command opens it: the file, its deck with the settings of the command line, and the plan of its designs.
module ek_opened_study
   use ek_error, only: error_t, fail, exit_usage, exit_file
   use ek_text, only: quoted
   use ek_file, only: join_path, folder_name
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t
   use ek_sampler_kind, only: sampler_kinds
   use ek_study, only: study_t, step_size_kind, kind_names
   use ek_study_reader, only: read_study
   use ek_part_factor, only: expand_part
   use ek_study_each, only: expand_factors, expand_columns
   use ek_designer, only: designer_t, new_designer
   use ek_study_plan, only: study_plan_t, new_plan
   use ek_study_run, only: chunk_of_parts
   use ek_study_tables, only: responses_name
   use ek_store, only: store_texts_t, keep_texts, store_name
   use ek_tolerance, only: tolerance_t
   use ek_command_line, only: command_line_t
   use ek_load_deck, only: read_changed, settings_of
   implicit none(type, external)
   private
   public :: opened_study_t, open_study, plan_study, results_name

   !> An opened study: the study and its deck, the folders, the designer, and the plan of its designs.
   type :: opened_study_t
      type(study_t) :: study                         !! study; factors with each = .true. and columns with * are expanded
      type(deck_t) :: deck
      character(:), allocatable :: home, out         !! folder of the study; folder of its results
      type(definition_t) :: definition               !! of the deck
      type(designer_t) :: designer
      type(study_plan_t) :: plan
      logical :: has_store = .false.                 !! whether the results are written to a NetCDF file
      type(store_texts_t) :: texts
      character(:), allocatable :: build             !! build of this program; '' if unknown
      type(tolerance_t), allocatable :: tolerance    !! results of a tolerance study by derivatives
   end type opened_study_t

contains

   !> Reads the study and its deck. No case is solved.
   subroutine open_study(line, this, error)
      type(command_line_t), intent(in) :: line
      class(opened_study_t), allocatable, intent(out) :: this
      type(error_t), allocatable, intent(out) :: error
      integer :: k

      allocate (this)
      this%build = ''
      if (allocated(line%build)) this%build = line%build
      this%home = folder_name(line%files%line(1))
      this%out = line%value('--out', join_path(this%home, 'out'))
      call read_study(line%files%line(1), this%study, error)
      if (.not. allocated(error) .and. line%has('--samples')) call set_samples(line%number('--samples'), this%study, error)
      if (.not. allocated(error)) call read_changed(join_path(this%home, this%study%deck), settings_of(line), this%deck, error)
      if (allocated(error) .and. allocated(this%study%where)) then         ! a file that cannot be read: where it is named
         if (error%code == exit_file .and. index(error%message, line%files%line(1)) == 0) &
            error%message = this%study%where//': deck: '//error%message
      end if
      if (.not. allocated(error)) then
         do k = 1, size(this%study%factors)
            call expand_part(this%study%factors(k), this%deck, error)
         end do
      end if
      if (.not. allocated(error) .and. this%study%kind /= step_size_kind) call expand_factors(this%study, this%deck, error)
      if (.not. allocated(error) .and. this%study%kind /= step_size_kind) call expand_columns(this%study, this%deck, error)
      if (.not. allocated(error)) call keep_texts(line%files%line(1), &
         join_path(this%home, this%study%deck), settings_of(line), this%texts)
   end subroutine open_study

   !> Plans the study: creates the design of the deck, checks the study against the deck, and creates the plan.
   subroutine plan_study(this, error, shards)
      type(opened_study_t), intent(inout), target :: this
      type(error_t), allocatable, intent(out) :: error
      integer, intent(in), optional :: shards        !! number of shards of this run; default 1
      integer :: n

      n = 1
      if (present(shards)) n = shards
      call new_designer(this%study, this%deck, join_path(this%home, ''), this%definition, this%designer, error)
      if (.not. allocated(error)) call new_plan(this%study, this%deck, join_path(this%home, ''), this%designer, this%plan, error, &
         n, chunk_of_parts(this%study, this%out), this%build)
      if (allocated(error)) return
      this%texts%swept = this%designer%workspace%cases(1)%result%case%place_name
      this%texts%swept_unit = this%designer%workspace%cases(1)%result%case%unit_name
   end subroutine plan_study

   !> File name of the results: the store, or the table of the designs.
   function results_name(this) result(name)
      type(opened_study_t), intent(in) :: this
      character(:), allocatable :: name
      name = responses_name(this%study)
      if (this%has_store) name = store_name(this%study)
   end function results_name

   !> Applies --samples, which reduces a large study to a trial.
   subroutine set_samples(samples, study, error)
      integer, intent(in) :: samples
      type(study_t), intent(inout) :: study
      type(error_t), allocatable, intent(out) :: error

      if (study%kind < step_size_kind) then
         if (sampler_kinds(study%kind)%has_size) then
            study%settings%size = samples
            return
         end if
      end if
      call fail(error, exit_usage, '--samples: a study of kind '//quoted(trim(kind_names(study%kind)))//' has no samples')
   end subroutine set_samples

end module ek_opened_study
