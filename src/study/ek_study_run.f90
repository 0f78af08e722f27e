!> Runs the designs of a study in chunks, by several threads of one or several processes, and stores the finished chunks.
!>
!> The folder <out>/<study>.parts contains one file per finished chunk (ek_chunk). A run computes only the missing chunks. The same
!> command therefore resumes a study that was stopped, or killed at any moment. The results of a chunk do not depend on the thread
!> that computes the chunk.
!> Several runs may use one folder. Each run has a locked scratch folder in it, and only the last run removes the chunks. The locks
!> of other machines may be invisible, so a run renews its scratch folder every hour. A scratch folder of another machine that was
!> not renewed for a day belongs to a terminated run.
module ek_study_run
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str, is_printable
   use ek_clock, only: seconds
   use ek_interrupt, only: is_stop_asked
   use ek_threads, only: threads_in_memory
   use ek_file, only: make_folder, join_path, read_whole, write_whole, file_exists, remove_file
   use ek_writer, only: remove_stale, remove_empty_folder, find_users, scratch_t, begin_scratch, &
      renew_scratch, end_scratch
   use ek_deck, only: deck_t
   use ek_study, only: study_t
   use ek_designer, only: designer_t
   use ek_study_design, only: solve_designs, complete_design
   use ek_design_cause, only: causes_t
   use ek_ranks, only: ranks_t, count_up, share, agree, help_others, ticket_counter, done_counter, failed_counter, stopped_counter
   use ek_study_plan, only: study_plan_t, begin_chunk, first_of, designs_in
   use ek_chunk, only: chunk_t, write_chunk, read_chunk, chunk_name, remove_foreign
   use ek_words, only: begin_words, end_words
   implicit none(type, external)
   private
   public :: run_options_t, run_state_t, report_procedure, open_parts, run_chunks, parts_folder, count_parts, &
      remove_parts, chunk_of_parts, check_parts
   public :: nobody, this_machine, other_machine

   character(*), parameter :: identity_name = 'study.txt', build_word = 'build '
   integer, parameter :: nobody = 0, this_machine = 1, other_machine = 2      !! the machine of a run that still needs the chunks
   real(wp), parameter :: an_hour = 3600.0_wp     !! one hour [s]
   character(*), parameter :: line_end = new_line('a')
   integer(i8), parameter :: of_a_design = 2_i8**25         !! work space of a thread [bytes]

   !> The options of a run of a study.
   type :: run_options_t
      integer :: jobs = 1                         !! number of threads
      integer :: shard = 1, shards = 1            !! index of the shard, number of shards: this run computes the chunks shard, shard
                                                  !! + shards, …
      real(wp) :: time_limit = huge(1.0_wp)       !! limit of the elapsed time [s]
      logical :: is_quiet = .false.
   end type run_options_t

   !> The progress of a run.
   type :: run_state_t
      integer :: wanted = 0                       !! number of designs of this run (its shard)
      integer :: before = 0                       !! number of wanted designs that were finished before the run began
      integer :: done = 0                         !! number of wanted designs that are finished now, by all ranks
      integer :: failed = 0                       !! number of failed designs among the designs computed by this run
      integer :: idle = 0                         !! number of requested threads for which there was no memory
      real(wp) :: begun = 0.0_wp, now = 0.0_wp    !! time when the run began, and of the last chunk [s]
      logical :: is_stopped = .false.             !! stopped by a signal, or at the time limit
      logical :: is_quiet = .false.               !! option of the run, for the report procedure
      real(wp) :: reported = 0.0_wp               !! time of the last report, for the report procedure [s]
   end type run_state_t

   abstract interface
      !> Reports the progress after every chunk; called by one thread at a time.
      subroutine report_procedure(state)
         import :: run_state_t
         implicit none(type, external)
         type(run_state_t), intent(inout) :: state
      end subroutine report_procedure
   end interface

   !> Data shared by the threads of a process.
   type :: shared_t
      character(:), allocatable :: folder         !! folder of the chunks
      integer, allocatable :: pending(:)          !! indices of the missing chunks of this run
      type(scratch_t) :: hold                     !! locked scratch folder of this run
      real(wp) :: renewed = 0.0_wp                !! time when `hold` was renewed [s]
      real(wp) :: longest = 0.0_wp                !! longest time of a chunk so far [s]
      type(run_state_t) :: state
      type(error_t), allocatable :: error         !! error of the first chunk that could not be computed or written
   end type shared_t

contains

   !> Path of the folder of the chunks.
   pure function parts_folder(study, out) result(folder)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: out
      character(:), allocatable :: folder
      folder = join_path(out, study%name//'.parts')
   end function parts_folder

   !> Opens the folder of the chunks: creates the folder if necessary, and begins the scratch folder `hold`. Rejects a folder with
   !> chunks of another study or of another build of this program.
   subroutine open_parts(study, plan, out, hold, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(scratch_t), intent(inout) :: hold               !! while `hold` exists, no other run removes the chunks
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      character(:), allocatable :: folder
      integer :: attempt

      folder = parts_folder(study, out)
      do attempt = 1, 3                                    ! a run that ends just now may remove the empty folder
         call make_folder(folder, error)
         if (allocated(error)) return
         call begin_scratch(join_path(folder, ''), hold, error)
         if (.not. allocated(error)) exit
      end do
      if (allocated(error)) return
      call remove_stale(folder)
      call check_parts(study, plan, out, error)
      if (allocated(error)) return
      if (file_exists(join_path(folder, identity_name))) return
      call write_whole(join_path(folder, identity_name), content_of(study, plan), error)
   end subroutine open_parts

   !> Rejects a folder with chunks of another study, or with designs computed by another build of this program.
   subroutine check_parts(study, plan, out, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      character(*), parameter :: remedy = '; remove that folder to begin anew, or choose another one with --out'
      character(:), allocatable :: folder, text
      integer :: at

      folder = parts_folder(study, out)
      if (.not. file_exists(join_path(folder, identity_name))) return
      call read_whole(join_path(folder, identity_name), text, error)
      if (allocated(error)) return
      if (text == content_of(study, plan)) return
      at = index(text//line_end//build_word, line_end//build_word)
      if (.not. is_printable(text)) then
         call fail(error, exit_file, join_path(folder, identity_name)//' is damaged'//remedy)
      else if (text(at:) == line_end//build_word//plan%build//line_end) then
         call fail(error, exit_file, folder//' holds designs of another study or deck'//remedy)
      else
         text = text(min(at + 1, len(text) + 1):)
         call fail(error, exit_file, folder//' holds designs of another study or deck, or of another build of elastokin ('// &
            text(len(build_word) + 1:max(len(build_word), len(text) - 1))//'; this is '//plan%build//')'//remedy)
      end if
   end subroutine check_parts

   !> The content of the file that identifies the study and the build to which the chunks in a folder belong.
   function content_of(study, plan) result(lines)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(:), allocatable :: lines

      lines = 'elastokin study '//study%name//line_end//'identity '//plan%identity//line_end//'designs '// &
         str(plan%designs)//' in chunks of '//str(plan%chunk)//line_end//build_word//plan%build//line_end
   end function content_of

  !> The number of designs per chunk of the existing folder; 0 without such a folder. Shards may have chosen smaller chunks.
   integer function chunk_of_parts(study, out) result(chunk)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: out
      character(*), parameter :: words = ' in chunks of '
      character(:), allocatable :: path, text
      type(error_t), allocatable :: unread
      integer :: at, status

      chunk = 0
      path = join_path(parts_folder(study, out), identity_name)
      if (.not. file_exists(path)) return
      call read_whole(path, text, unread)
      at = index(text, words)
      status = 1
      if (at > 0) at = at + len(words)
      if (at > 0) read (text(at:at + index(text(at:), line_end) - 2), *, iostat=status) chunk
      if (status /= 0) chunk = 0
      chunk = max(0, chunk)
   end function chunk_of_parts

   !> Counts the designs whose chunks exist and are complete.
   subroutine count_parts(study, plan, out, done)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      integer, intent(out) :: done                !! number of designs
      type(shared_t) :: shared

      shared%folder = parts_folder(study, out)
      call list_pending(plan, run_options_t(), shared)
      done = shared%state%before
   end subroutine count_parts

   !> Removes the chunks after the tables were written, unless another run needs the chunks.
   subroutine remove_parts(study, plan, out, hold, user)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(scratch_t), intent(inout) :: hold               !! scratch folder of this run, which is ended
      integer, intent(out) :: user                         !! machine of a run that needs the chunks; nobody: they are removed
      character(:), allocatable :: folder
      logical :: is_in_use, is_here
      integer :: k

      folder = parts_folder(study, out)
      call end_scratch(hold)
      call find_users(folder, is_in_use, is_here)
      user = merge(this_machine, merge(other_machine, nobody, is_in_use), is_here)
      if (is_in_use) return
      do k = 1, plan%chunks
         call remove_file(join_path(folder, chunk_name(k)))
      end do
      call remove_file(join_path(folder, identity_name))
      call remove_empty_folder(folder)
   end subroutine remove_parts

   !> Computes the missing chunks, or as many as the time limit permits. All ranks must call run_chunks; `state` covers all ranks.
   subroutine run_chunks(study, plan, deck, out, hold, options, designer, ranks, state, report, error)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: out
      type(scratch_t), intent(in) :: hold                  !! scratch folder from open_parts; ended on all ranks except the first
      type(run_options_t), intent(in) :: options
      type(designer_t), intent(in) :: designer             !! designer with the design of the deck
      type(ranks_t), intent(inout) :: ranks                !! ranks of the run, with all counters at zero
      type(run_state_t), intent(out) :: state
      procedure(report_procedure) :: report
      type(error_t), allocatable, intent(out) :: error     !! error of a chunk, not caused by a design
      type(shared_t) :: shared
      integer :: threads, stops

      shared%folder = parts_folder(study, out)
      shared%hold = hold
      if (ranks%is_first) call list_pending(plan, options, shared)
      call share(ranks, shared%pending)
      shared%state%begun = seconds()
      shared%state%now = shared%state%begun
      shared%state%reported = shared%state%begun
      shared%renewed = shared%state%begun
      shared%state%is_quiet = options%is_quiet .or. .not. ranks%is_first
      threads = max(1, min(options%jobs, size(shared%pending)))
      if (.not. ranks%has_threads) threads = 1
      shared%state%idle = threads
      threads = threads_in_memory(threads, of_a_design + 16_i8*plan%columns*plan%states*plan%chunk)     ! curves: kept and grown
      shared%state%idle = shared%state%idle - threads
      !$omp parallel num_threads(threads) default(shared)
      call work(study, plan, deck, options, designer, ranks, shared, report)
      !$omp end parallel
      if (allocated(shared%error)) call move_alloc(shared%error, error)
      call agree(ranks, error)
      call count_all(ranks, shared%state)
      call count_up(ranks, stopped_counter, 0, stops)
      state = shared%state
      state%is_stopped = stops > 0 .and. state%done < state%wanted
   end subroutine run_chunks

   !> Counts the finished designs and the failed designs of all ranks.
   subroutine count_all(ranks, state)
      type(ranks_t), intent(inout) :: ranks
      type(run_state_t), intent(inout) :: state
      integer :: designs

      call count_up(ranks, done_counter, 0, designs)
      state%done = state%before + designs
      call count_up(ranks, failed_counter, 0, state%failed)
   end subroutine count_all

   !> Lists the chunks of this run whose files are missing, damaged or from another study.
   subroutine list_pending(plan, options, shared)
      type(study_plan_t), intent(in) :: plan
      type(run_options_t), intent(in) :: options
      type(shared_t), intent(inout) :: shared     !! shared data with the folder of the chunks
      type(chunk_t) :: chunk
      logical :: is_pending(plan%chunks), is_good
      integer :: k, designs

      is_pending = .false.
      do k = options%shard, plan%chunks, options%shards
         designs = designs_in(plan, k)
         shared%state%wanted = shared%state%wanted + designs
         call read_chunk(join_path(shared%folder, chunk_name(k)), plan%identity, first_of(plan, k), designs, chunk, is_good)
         is_pending(k) = .not. is_good
         if (.not. is_good) call remove_foreign(join_path(shared%folder, chunk_name(k)))
         if (is_good) shared%state%before = shared%state%before + designs
      end do
      shared%pending = pack([(k, k=1, plan%chunks)], is_pending)
      shared%state%done = shared%state%before
   end subroutine list_pending

   !> Computes chunks, as one thread, until no chunk is left or the run stops.
   subroutine work(study, plan, deck, options, designer, ranks, shared, report)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      type(deck_t), intent(in) :: deck
      type(run_options_t), intent(in) :: options
      type(designer_t), intent(in) :: designer
      type(ranks_t), intent(inout) :: ranks
      type(shared_t), intent(inout) :: shared
      procedure(report_procedure) :: report
      class(designer_t), allocatable :: mine
      type(chunk_t) :: chunk
      type(causes_t) :: causes
      real(wp) :: begun
      integer :: number, k
      logical :: is_whole

      call begin_words()
      allocate (mine, source=designer)
      call end_words()
      do
         call begin_words()
         call take_chunk(options, ranks, shared, number)
         call end_words()
         if (number == 0) exit
         begun = seconds()
         call begin_chunk(plan, number, chunk)
         is_whole = .true.
         do k = 1, size(chunk%status), size(mine%packs%workspaces) + 1
            call solve_designs(study, mine, k, min(k + size(mine%packs%workspaces), size(chunk%status)), chunk, causes)
            is_whole = .not. (is_stop_asked() .or. allocated(chunk%error))
            if (.not. is_whole) exit
            if (ranks%count == 1) cycle
            call begin_words()
            call help_others(ranks)
            call end_words()
         end do
         call begin_words()
         do k = 1, merge(causes%used, 0, is_whole)
            call complete_design(study, deck, mine, causes%list(k), chunk)
            is_whole = .not. (is_stop_asked() .or. allocated(chunk%error))
            if (.not. is_whole) exit
            if (ranks%count > 1) call help_others(ranks)
         end do
         call put_chunk(plan, number, chunk, is_whole, seconds() - begun, ranks, shared, report)
         call end_words()
      end do
   end subroutine work

   !> Chooses the next chunk. Returns 0 if no chunk is left, the run must stop, or another chunk could exceed the time
   !> limit. The run stops after an error of a chunk or a signal.
   subroutine take_chunk(options, ranks, shared, number)
      type(run_options_t), intent(in) :: options
      type(ranks_t), intent(inout) :: ranks
      type(shared_t), intent(inout) :: shared
      integer, intent(out) :: number
      real(wp), parameter :: reserve = 1.5_wp        ! a chunk may take this much longer than the longest so far
      real(wp) :: passed
      logical :: must_stop
      integer :: before, stops

      number = 0
      if (allocated(shared%error)) return
      passed = seconds() - shared%state%begun
      must_stop = is_stop_asked() .or. passed + reserve*shared%longest > options%time_limit
      if (must_stop) then
         call count_up(ranks, stopped_counter, 1, stops)
         return
      end if
      call count_up(ranks, ticket_counter, 1, before)
      if (before < size(shared%pending)) number = shared%pending(before + 1)
   end subroutine take_chunk

   !> Stores a chunk if all of its designs are finished; then updates and reports the progress. An error that is not caused by a
   !> design is passed to `shared`.
   subroutine put_chunk(plan, number, chunk, is_whole, time, ranks, shared, report)
      type(study_plan_t), intent(in) :: plan
      integer, intent(in) :: number
      type(chunk_t), intent(inout) :: chunk
      logical, intent(in) :: is_whole
      real(wp), intent(in) :: time                   !! time of the chunk [s]
      type(ranks_t), intent(inout) :: ranks
      type(shared_t), intent(inout) :: shared
      procedure(report_procedure) :: report
      type(error_t), allocatable :: error
      integer :: before

      if (allocated(chunk%error)) then
         if (.not. allocated(shared%error)) then
            call move_alloc(chunk%error, shared%error)
            shared%error%message = shared%error%message//'; finished designs are stored: run the same command again to resume'
         end if
         return
      end if
      if (.not. is_whole) then
         call count_up(ranks, stopped_counter, 1, before)
         return
      end if
      call write_chunk(chunk, join_path(shared%folder, chunk_name(number)), plan%identity, plan%kernel, error)
      if (allocated(error)) then
         if (.not. allocated(shared%error)) call move_alloc(error, shared%error)
         return
      end if
      shared%longest = max(shared%longest, time)
      call count_up(ranks, done_counter, size(chunk%status), before)
      call count_up(ranks, failed_counter, count(chunk%status /= 0), before)
      call count_all(ranks, shared%state)
      shared%state%now = seconds()
      if (shared%state%now - shared%renewed > an_hour) then
         call renew_scratch(shared%hold)
         shared%renewed = shared%state%now
      end if
      call report(shared%state)
   end subroutine put_chunk

end module ek_study_run
