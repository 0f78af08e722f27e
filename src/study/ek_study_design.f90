!> Solves one design of a study: the factors become a model, its cases are solved, and the observations become a row of responses
!> and the rows of the curves.
!>
!> What a design costs is numbers only. A message (of a design that fails, or one that must be read from the text) is
!> made by one thread at a time: gfortran keeps the length of a text that a function returns in one place for all threads.
module ek_study_design
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck, exit_file
   use ek_text, only: str, quoted, replace
   use ek_deck, only: deck_t, set_value
   use ek_case_result, only: case_result_t, solve_options_t, solve_case, solve_mounted, failure_of, test_of
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: table_t, column_index, name_length
   use ek_quantity, only: head_with_unit
   use ek_study, only: study_t, not_given
   use ek_response, only: needed_columns, no_column, prepare_reading, prepare_difference, fault_text
   use ek_response_value, only: reading_t, read_response, is_difference
   use ek_study_pack, only: pack_space_t, begin_packs, walk_case, lanes
   use ek_worker, only: worker_t, factor_paths_t, make_worker, change_design
   use ek_factor_unit, only: factor_unit, unit_ending
   use ek_factor_paths, only: check_paths, check_planes, find_paths, setting_of, shortest
   use ek_chunk, only: chunk_t, add_reason, put_error, design_solved, design_incomplete, design_unsolvable, design_invalid
   implicit none(type, external)
   private
   public :: designer_t, begin_designer, new_designer, solve_designs

   !> What one thread keeps from design to design.
   type :: designer_t
      class(worker_t), allocatable :: worker               !! allocated by begin_designer; a class as in worker_case_t
      class(pack_space_t), allocatable :: packs                       !! for designs that are solved together
      type(factor_paths_t), allocatable :: paths(:)        !! of the factors
      character(name_length), allocatable :: case_names(:) !! of the cases that are solved; '': the first of the deck
      type(solve_options_t), allocatable :: options(:)     !! of each case: its columns
      type(reading_t), allocatable :: readings(:)
      integer, allocatable :: case_of(:)                   !! of each response
      integer :: increments = 0                            !! of all cases; 0: those of the deck
      integer :: states = 0                                !! of the first case, in the first design
      character(name_length), allocatable :: units(:)      !! of the factors, '' if they have none: 'N/mm'
      character(name_length), allocatable :: heads(:)      !! of the columns of the factors: 'rate_n_per_mm'
   end type designer_t

contains

   !> Reads the deck and finds the numbers that the factors change; nothing is solved.
   subroutine begin_designer(study, deck, designer, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(out) :: designer
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: all mistakes of the paths
      integer :: k

      call list_cases(study, designer)
      call check_paths(study, deck, error)
      if (allocated(error)) return
      if (allocated(study%increments)) designer%increments = sum(study%increments)       ! one or none
      allocate (designer%worker)
      call make_worker(deck, designer%case_names, designer%worker, error, designer%increments)
      if (allocated(error)) return
      allocate (designer%paths(size(study%factors)), designer%units(size(study%factors)), designer%heads(size(study%factors)))
      do k = 1, size(study%factors)
         call find_paths(study%factors(k), designer%worker%design, designer%paths(k))
         designer%units(k) = factor_unit(designer%worker%design, designer%paths(k))
         designer%heads(k) = head_with_unit(study%factors(k)%name, unit_ending(trim(designer%units(k))))
      end do
      call check_planes(study, designer%worker%design, designer%paths, error)
   end subroutine begin_designer

   !> Reads the deck, and checks all paths, columns and responses against it. The design of the deck itself must be sound.
   subroutine new_designer(study, deck, home, designer, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: home                     !! folder of the study with its slash
      type(designer_t), intent(out) :: designer
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: all mistakes of the study
      integer :: k

      call begin_designer(study, deck, designer, error)
      if (allocated(error)) return
      allocate (designer%options(size(designer%case_names)))
      do k = 1, size(designer%case_names)
         call list_columns(study, designer, k)
         designer%options(k)%has_remarks = .false.
         associate (this => designer%worker%cases(k))
            call solve_case(designer%worker%suspension, this%case, designer%options(k), this%result, observer=this%observer)
            if (.not. this%result%is_run()) call failure_of(this%result, error)
         end associate
         if (allocated(error)) return
      end do
      allocate (designer%packs)
      call begin_packs(designer%worker, designer%packs)
      designer%states = size(designer%worker%cases(1)%result%table%values, 2)
      call check_columns(study, home, designer, error)
   end subroutine new_designer

   !> The cases: that of the study first, then those of its responses.
   subroutine list_cases(study, designer)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer :: k

      designer%case_names = [character(name_length) :: study%case]
      allocate (designer%case_of(size(study%responses)))
      do k = 1, size(study%responses)
         if (study%responses(k)%case /= '' .and. .not. any(designer%case_names == study%responses(k)%case)) &
            designer%case_names = [character(name_length) :: designer%case_names, study%responses(k)%case]
         designer%case_of(k) = 1
         if (study%responses(k)%case /= '') &
            designer%case_of(k) = findloc(designer%case_names == study%responses(k)%case, .true., dim=1)
      end do
   end subroutine list_cases

   !> The columns that are computed of a case.
   subroutine list_columns(study, designer, case)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: case
      character(name_length), allocatable :: wanted(:)
      integer :: k

      allocate (wanted(merge(size(study%columns), 0, case == 1)))
      if (case == 1) wanted(:) = study%columns
      do k = 1, size(study%responses)
         if (designer%case_of(k) == case) call needed_columns(study%responses(k), &
            designer%worker%cases(case)%case%test, wanted)
      end do
      designer%options(case)%columns = wanted
      designer%options(case)%has_violation = any(wanted == 'constraint_error')
   end subroutine list_columns

   !> Checks that all columns named by the study are in the tables of the first design and that its responses can be read.
   subroutine check_columns(study, home, designer, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: home
      type(designer_t), intent(inout) :: designer
      type(error_t), allocatable, intent(out) :: error   !! exit_deck, every mistake
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:)    ! all columns of the results
      character(:), allocatable :: message
      integer :: k

      associate (first => designer%worker%cases(1)%result)
         call sweep_columns(first%suspension, first%case, heads)
         do k = 1, size(study%columns)
            if (column_index(first%table, trim(study%columns(k))) == 0) &
               call mistakes%add(study%where//': columns: '//no_column(trim(study%columns(k)), heads))
         end do
      end associate
      allocate (designer%readings(size(study%responses)))
      do k = 1, size(study%responses)
         associate (result => designer%worker%cases(designer%case_of(k))%result, readings => designer%readings, &
            asked => study%responses(k))
            call sweep_columns(result%suspension, result%case, heads)
            if (asked%of == 'difference') then
               call prepare_difference(asked, readings(asked%less(1)), readings(asked%less(2)), readings(k), message)
            else
               call prepare_reading(asked, result%table, result%case%unit_name, readings(k), message, heads, home, test_of(result))
            end if
            if (message /= '') call mistakes%add(message)
         end associate
      end do
      call check_heads(study, designer, mistakes)
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine check_columns

   !> No two columns of the table of responses may have the same name.
   subroutine check_heads(study, designer, mistakes)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(message_list_t), intent(inout) :: mistakes
      integer :: j, k

      do k = 1, size(study%factors)
         do j = 1, k - 1
            if (designer%heads(j) == designer%heads(k)) call add(study%factors(k)%where//': factor '// &
               quoted(study%factors(k)%name), trim(designer%heads(k)), 'factor '//quoted(study%factors(j)%name))
         end do
      end do
      do k = 1, size(designer%readings)
         associate (this => designer%readings(k))
            do j = 1, size(study%factors)
               if (designer%heads(j) == this%head) call add(this%asked%where//': response '//quoted(this%asked%name), this%head, &
                  'factor '//quoted(study%factors(j)%name))
            end do
            do j = 1, k - 1
               if (designer%readings(j)%head == this%head) call add(this%asked%where//': response '//quoted(this%asked%name), &
                  this%head, 'response '//quoted(designer%readings(j)%asked%name))
            end do
         end associate
      end do

   contains

      subroutine add(who, head, other)
         character(*), intent(in) :: who, head, other
         call mistakes%add(who//': its column would have the name '//quoted(head)//', like that of '//other//'; rename one')
      end subroutine add

   end subroutine check_heads

   !> Solves some designs of a chunk, at most `lanes`, whose factors the chunk has, and fills their rows.
   subroutine solve_designs(study, deck, designer, first, last, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: first, last
      type(chunk_t), intent(inout) :: chunk
      logical :: is_done(lanes), is_walked(lanes, size(designer%options))
      integer :: k, l, c

      is_done = .false.
      do k = first, last
         l = k - first + 1
         if (l == 1) then
            call change_design(designer%paths, chunk%factors(:, k), designer%worker, is_done(l))
         else
            call change_design(designer%paths, chunk%factors(:, k), designer%packs%workers(l - 1), is_done(l))
         end if
      end do
      is_walked = .false.
      do c = 1, size(designer%options)
         if (any(is_done)) call walk_case(c, designer%worker, is_done, designer%packs, is_walked(:, c))
      end do
      do k = first, last
         l = k - first + 1
         if (.not. is_done(l)) then
            chunk%responses(:, k) = not_given()
            !$omp critical (ek_words)
            call solve_from_text(study, deck, designer, k, chunk)
            !$omp end critical (ek_words)
         else if (l == 1) then
            call finish_design(study, designer, is_walked(l, :), k, designer%worker, chunk)
         else
            call finish_design(study, designer, is_walked(l, :), k, designer%packs%workers(l - 1), chunk)
         end if
      end do
   end subroutine solve_designs

   !> Solves the cases of a design whose paths were not walked in a pack, and fills its row.
   subroutine finish_design(study, designer, is_walked, k, worker, chunk)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      logical, intent(in) :: is_walked(:)         !! of each case
      integer, intent(in) :: k
      type(worker_t), intent(inout) :: worker     !! with the numbers of the design
      type(chunk_t), intent(inout) :: chunk
      integer :: faults(size(designer%readings)), c

      chunk%responses(:, k) = not_given()
      do c = 1, size(worker%cases)
         associate (this => worker%cases(c))
            call solve_mounted(designer%options(c), this%result, observer=this%observer, is_walked=is_walked(c))
         end associate
      end do
      call take_row(study, designer, worker, k, chunk, faults)
      if (chunk%status(k) == design_solved) return
      !$omp critical (ek_words)
      call explain(designer, worker, k, faults, chunk)
      !$omp end critical (ek_words)
   end subroutine finish_design

   !> Solves a design that is read from the deck with its factors as settings, with a worker of its own.
   subroutine solve_from_text(study, deck, designer, k, chunk)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      type(deck_t) :: changed
      type(worker_t) :: worker
      type(error_t), allocatable :: error
      integer :: faults(size(designer%readings)), f, j, case

      changed = deck
      do f = 1, size(study%factors)
         do j = 1, size(study%factors(f)%paths)
            if (.not. allocated(error)) call set_value(changed, trim(study%factors(f)%paths(j)), &
               setting_of(study%factors(f)%change, chunk%factors(f, k)), error)
         end do
      end do
      if (.not. allocated(error)) call make_worker(changed, designer%case_names, worker, error, designer%increments)
      if (allocated(error)) then
         if (error%code == exit_file) call put_error(chunk, error)
         chunk%status(k) = merge(design_invalid, design_unsolvable, error%code == exit_deck)
         do f = 1, size(study%factors)          ! a number of the study, not of the command line
            associate (factor => study%factors(f))
               do j = 1, size(factor%paths)
                  call replace(error%message, '--set '//trim(factor%paths(j))//'='// &
                     setting_of(factor%change, chunk%factors(f, k)), &
                     factor%where//': factor '//quoted(factor%name)//' = '//shortest(chunk%factors(f, k)))
               end do
            end associate
         end do
         call add_reason(chunk, k, error%message)
         return
      end if
      do case = 1, size(worker%cases)
         associate (this => worker%cases(case))
            call solve_case(worker%suspension, this%case, designer%options(case), this%result, observer=this%observer)
         end associate
      end do
      call take_row(study, designer, worker, k, chunk, faults)
      if (chunk%status(k) /= design_solved) call explain(designer, worker, k, faults, chunk)
   end subroutine solve_from_text

   !> The responses and the curves of a design. A response of a case that lost a state has no value.
   subroutine take_row(study, designer, worker, k, chunk, faults)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      type(worker_t), intent(in) :: worker        !! with the results of its cases
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      integer, intent(out) :: faults(:)           !! of each response, see read_response
      integer :: j

      do j = 1, size(worker%cases)
         if (.not. is_whole(worker%cases(j)%result)) chunk%status(k) = design_incomplete
      end do
      faults = 0
      do j = 1, size(designer%readings)
         associate (result => worker%cases(designer%case_of(j))%result, less => designer%readings(j)%asked%less)
            if (is_difference(designer%readings(j))) then
               chunk%responses(j, k) = chunk%responses(less(1), k) - chunk%responses(less(2), k)
            else if (is_whole(result)) then
               call read_response(designer%readings(j), result%table, chunk%responses(j, k), faults(j))
            end if
            if (.not. ieee_is_finite(chunk%responses(j, k))) chunk%status(k) = design_incomplete
         end associate
      end do
      if (worker%cases(1)%result%is_run()) call take_curves(study, worker%cases(1)%result%table, k, chunk)
   end subroutine take_row

   !> Whether all states of a case converged.
   pure logical function is_whole(result)
      type(case_result_t), intent(in) :: result

      is_whole = result%is_run()
      if (is_whole) is_whole = all(result%path%failure%state == 0)
   end function is_whole

   !> Appends the states of a design; columns that its model does not define are nan.
   pure subroutine take_curves(study, table, k, chunk)
      type(study_t), intent(in) :: study
      type(table_t), intent(in) :: table
      integer, intent(in) :: k
      type(chunk_t), intent(inout) :: chunk
      real(wp), allocatable :: more(:, :)
      logical :: is_next
      integer :: place, j, rows

      if (size(study%columns) == 0) return
      rows = size(table%values, 2)
      if (chunk%rows + rows > size(chunk%curves, 2)) then
         allocate (more(size(chunk%curves, 1), 2*(chunk%rows + rows)))
         more(:, :chunk%rows) = chunk%curves(:, :chunk%rows)
         call move_alloc(more, chunk%curves)
      end if
      associate (curves => chunk%curves(:, chunk%rows + 1:chunk%rows + rows))
         curves(1, :) = table%values(2, :)
         place = 2
         do j = 1, size(study%columns)
            is_next = place < size(table%columns)
            if (is_next) is_next = table%columns(place + 1) == study%columns(j)       ! many columns stand in their order
            place = merge(place + 1, 0, is_next)
            if (.not. is_next) place = column_index(table, study%columns(j))
            if (place > 0) curves(1 + j, :) = table%values(place, :)
            if (place == 0) curves(1 + j, :) = not_given()
         end do
      end associate
      chunk%states(k) = rows
      chunk%rows = chunk%rows + rows
   end subroutine take_curves

   !> Says why a design is incomplete.
   subroutine explain(designer, worker, k, faults, chunk)
      type(designer_t), intent(in) :: designer
      type(worker_t), intent(in) :: worker        !! with the results of its cases
      integer, intent(in) :: k, faults(:)
      type(chunk_t), intent(inout) :: chunk
      type(message_list_t) :: words
      type(error_t), allocatable :: error
      integer :: j, side

      do j = 1, size(worker%cases)
         associate (result => worker%cases(j)%result, path => worker%cases(j)%result%path)
            if (.not. result%is_run()) then
               call failure_of(result, error)
               call words%add(error%message)
               if (error%code == exit_file) call put_error(chunk, error)
               cycle
            end if
            do side = 1, 2
               if (path%failure(side)%state > 0) call words%add('case '//quoted(result%case%name)// &
                  ': no equilibrium at factor '//str(path%value(path%failure(side)%state)/result%case%unit))
            end do
         end associate
      end do
      do j = 1, size(faults)
         if (faults(j) /= 0) call words%add('response '//quoted(designer%readings(j)%asked%name)//': '// &
            fault_text(designer%readings(j), worker%cases(designer%case_of(j))%result%table, faults(j)))
      end do
      if (words%count() == 0) call words%add('a response has no value')
      call add_reason(chunk, k, words%text())
   end subroutine explain

end module ek_study_design
