!> Data that a study stores from design to design: the numbers that the factors change, the cases to be solved, and the
!> responses. The responses are checked against the design of the deck itself.
module ek_designer
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: quoted
   use ek_deck, only: deck_t
   use ek_reader, only: definition_t
   use ek_case_result, only: solve_options_t, solve_case, add_remarks, failure_of, test_of
   use ek_sweep_table, only: sweep_columns
   use ek_table, only: column_index, name_length, scheduled_rows
   use ek_quantity, only: head_with_unit
   use ek_case, only: is_mountable
   use ek_lone_case, only: heads_on_rig
   use ek_defined_column, only: defined_t, define_columns, keep_named, is_named
   use ek_defined_table, only: defined_list_t, append_defined, needed_of_program => needed_columns
   use ek_study, only: study_t, response_t
   use ek_response, only: needed_columns, no_column, prepare_reading, prepare_difference, check_reading
   use ek_response_value, only: reading_t, stop_where_read, is_difference
   use ek_read_states, only: reads_few_states
   use ek_study_pack, only: pack_space_t, begin_packs
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_cases
   use ek_factor_numbers, only: factor_paths_t
   use ek_factor_unit, only: factor_unit, unit_ending
   use ek_factor_paths, only: check_paths, check_planes, find_paths
   implicit none(type, external)
   private
   public :: designer_t, begin_designer, new_designer

   !> Data that one thread of a study stores from design to design.
   type :: designer_t
      class(workspace_t), allocatable :: workspace !! allocated by begin_designer; a class for the reason given at case_work_t
      class(pack_space_t), allocatable :: packs                       !! work space for designs that are solved together
      type(factor_paths_t), allocatable :: paths(:)        !! numbers of the deck that each factor changes
      character(name_length), allocatable :: case_names(:) !! names of the cases to be solved; '': the first case of the deck
      type(solve_options_t), allocatable :: options(:)     !! options of each case, with the columns to compute
      type(reading_t), allocatable :: readings(:)
      integer, allocatable :: case_of(:)                   !! index of the case of each response
      integer :: increments = 0                            !! number of increments of all cases; 0: the increments of the deck
      integer :: states = 0                                !! number of states of the first case, in the design of the deck
      character(name_length), allocatable :: units(:)      !! unit of each factor, for instance 'N/mm'; '' if the factor has no unit
      character(name_length), allocatable :: heads(:)      !! column heading of each factor, for instance 'rate_n_per_mm'
   end type designer_t

contains

   !> Reads the deck and finds the numbers that the factors change. No case is solved.
   subroutine begin_designer(study, deck, definition, designer, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the designer and its copies
      type(designer_t), intent(out) :: designer
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: all errors of the paths
      integer :: k

      call list_cases(study, designer)
      call check_paths(study, deck, error)
      if (allocated(error)) return
      if (allocated(study%increments)) designer%increments = sum(study%increments)       ! one or none
      allocate (designer%workspace)
      call open_cases(deck, designer%case_names, definition, designer%workspace, error, designer%increments)
      if (allocated(error)) return
      call find_paths(study, designer%workspace%definition, designer%paths, error)
      if (allocated(error)) return
      allocate (designer%units(size(study%factors)), designer%heads(size(study%factors)))
      do k = 1, size(study%factors)
         designer%units(k) = factor_unit(designer%workspace%definition, designer%paths(k))
         designer%heads(k) = head_with_unit(study%factors(k)%name, unit_ending(trim(designer%units(k))))
      end do
      call check_planes(study, designer%workspace%definition, designer%paths, error)
   end subroutine begin_designer

   !> Reads the deck, and checks all paths, columns and responses of the study against the deck. All cases must be solvable in the
   !> design of the deck.
   subroutine new_designer(study, deck, home, definition, designer, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: home                     !! folder of the study with its slash
      type(definition_t), target, intent(inout) :: definition !! replaced; must outlive the designer and its copies
      type(designer_t), intent(inout) :: designer          !! replaced
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: errors of the study; otherwise the deck or its first case
                                                           !! that cannot be run
      type(message_list_t) :: mistakes
      integer :: k

      call begin_designer(study, deck, definition, designer, error)
      if (allocated(error)) return
      allocate (designer%options(size(designer%case_names)))
      do k = 1, size(designer%case_names)
         call list_columns(study, designer, k)
         call solve_first(k, designer, error)
         if (allocated(error)) return
         if (study%definitions /= '') call append_first(study, designer, k)
      end do
      call check_columns(study, home, designer, error)
      if (allocated(error)) return
      do k = 1, size(designer%readings)
         call stop_where_read(designer%readings(k), designer%workspace%cases(designer%case_of(k))%case)
      end do
      do k = 1, size(designer%case_names)
         associate (case => designer%workspace%cases(k)%case)
            if (.not. (allocated(case%places) .or. allocated(case%windows))) cycle
         end associate
         call solve_first(k, designer, error)
         if (allocated(error)) return
      end do
      call check_readings(designer, mistakes)
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
      if (allocated(error)) return
      allocate (designer%packs)
      call begin_packs(designer%workspace, designer%packs)
      designer%states = count(scheduled_rows(designer%workspace%cases(1)%result%table))
      do k = 1, size(designer%options)
         associate (this => designer%workspace%cases(k))
            designer%options(k)%defers_kandc = reads_few_states(designer%readings, designer%case_of, k, &
               study%columns(:merge(size(study%columns), 0, k == 1)), designer%options(k), this%observer, this%result%table)
         end associate
      end do
   end subroutine new_designer

   !> Solves a case in the design of the deck.
   subroutine solve_first(k, designer, error)
      integer, intent(in) :: k                             !! index of the case
      type(designer_t), intent(inout) :: designer
      type(error_t), allocatable, intent(out) :: error     !! the case cannot be run

      associate (this => designer%workspace%cases(k))
         call solve_case(designer%workspace%suspension, this%case, designer%options(k), this%result, observer=this%observer)
         if (this%result%is_run()) return
         call add_remarks(designer%options(k), this%result)
         call failure_of(this%result, error)
      end associate
   end subroutine solve_first

   !> Appends the columns of another program that responses name to the table of a case, in this and in all later designs.
   subroutine append_first(study, designer, case)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: case
      type(defined_list_t) :: more

      associate (result => designer%workspace%cases(case)%result)
         more%columns = result%table%columns
         call define_columns(result%suspension, more%columns, trim(study%definitions), more%list)
         call keep_named(names_of_case(study, designer, case), more%list)
         if (size(more%list) == 0) return
         call append_defined(result%suspension, more, result%table)
         designer%options(case)%defined = more
      end associate
   end subroutine append_first

   !> The columns that the responses of a case name.
   function names_of_case(study, designer, case) result(names)
      type(study_t), intent(in) :: study
      type(designer_t), intent(in) :: designer
      integer, intent(in) :: case
      character(name_length), allocatable :: names(:)
      integer :: k

      allocate (names(0))
      do k = 1, size(study%responses)
         associate (asked => study%responses(k))
            if (designer%case_of(k) /= case .or. asked%of == 'difference' .or. asked%of == 'gradient') cycle
            names = [character(name_length) :: names, asked%column, asked%over]
         end associate
      end do
   end function names_of_case

   !> Replaces names of columns of another program by their headings: 'left Toe Angle' by 'left Toe Angle [deg]'.
   subroutine take_headings(options, asked, message)
      type(solve_options_t), intent(in) :: options           !! of the case of the response
      type(response_t), intent(inout) :: asked
      character(:), allocatable, intent(out) :: message      !! a name of several columns; '' otherwise

      message = ''
      if (.not. allocated(options%defined) .or. asked%of == 'gradient') return
      call take_heading(asked%column)
      if (message == '') call take_heading(asked%over)
      if (message /= '') message = asked%where//': response '//quoted(asked%name)//': '//message

   contains

      subroutine take_heading(name)
         character(:), allocatable, intent(inout) :: name
         character(:), allocatable :: found
         integer :: k, many

         many = 0
         associate (list => options%defined%list)
            do k = 1, size(list)
               if (.not. is_named(list(k), name)) cycle
               many = many + 1
               if (many == 1) found = trim(list(k)%head)
               if (many == 2) message = quoted(name)//' names several columns: '//quoted(found)//', '// &
                  quoted(trim(list(k)%head))//'; name one'
            end do
         end associate
         if (many == 1) name = found
      end subroutine take_heading

   end subroutine take_headings

   !> Reads all responses in the design of the deck.
   subroutine check_readings(designer, mistakes)
      type(designer_t), intent(in) :: designer
      type(message_list_t), intent(inout) :: mistakes
      character(:), allocatable :: message
      integer :: k

      do k = 1, size(designer%readings)
         if (is_difference(designer%readings(k))) cycle
         call check_reading(designer%readings(k), designer%workspace%cases(designer%case_of(k))%result%table, message)
         if (message /= '') call mistakes%add(message)
      end do
   end subroutine check_readings

   !> Lists the cases: the case of the study first, then the cases of its responses.
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

   !> Lists the columns that are computed for a case: columns of the study (first case only), and columns that responses need.
   subroutine list_columns(study, designer, case)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: case
      character(name_length), allocatable :: wanted(:)
      integer :: k

      allocate (wanted(merge(size(study%columns), 0, case == 1)))
      if (case == 1) wanted(:) = study%columns
      if (study%definitions /= '') call add_needed(study, designer, case, wanted)
      do k = 1, size(study%responses)
         if (designer%case_of(k) == case) call needed_columns(study%responses(k), &
            designer%workspace%cases(case)%case%test, wanted)
      end do
      designer%options(case)%columns = wanted
      designer%options(case)%has_violation = any(wanted == 'constraint_error')
   end subroutine list_columns

   !> Adds the columns of elastokin from which the columns of another program follow that responses name.
   subroutine add_needed(study, designer, case, wanted)
      type(study_t), intent(in) :: study
      type(designer_t), intent(inout) :: designer
      integer, intent(in) :: case
      character(name_length), allocatable, intent(inout) :: wanted(:)
      character(name_length), allocatable :: heads(:)
      type(defined_t), allocatable :: list(:)

      associate (workspace => designer%workspace)
         if (.not. is_mountable(workspace%cases(case)%case)) return
         call heads_on_rig(workspace%raw, workspace%cases(case)%case, heads)
         call define_columns(workspace%raw, heads, trim(study%definitions), list)
      end associate
      call keep_named(names_of_case(study, designer, case), list)
      call needed_of_program(heads, list, wanted)
   end subroutine add_needed

   !> Checks that all columns named by the study are in the table of the first case, in the design of the deck, and that all
   !> responses can be read.
   subroutine check_columns(study, home, designer, error)
      type(study_t), intent(in) :: study
      character(*), intent(in) :: home
      type(designer_t), intent(inout) :: designer
      type(error_t), allocatable, intent(out) :: error   !! exit_deck, all errors
      type(message_list_t) :: mistakes
      character(name_length), allocatable :: heads(:)    ! all columns of the results
      type(defined_t), allocatable :: list(:)
      type(response_t) :: asked
      character(:), allocatable :: message
      integer :: k

      associate (first => designer%workspace%cases(1)%result)
         call sweep_columns(first%suspension, first%case, heads)
         do k = 1, size(study%columns)
            if (column_index(first%table, trim(study%columns(k))) == 0) &
               call mistakes%add(study%where//': columns: '//no_column(trim(study%columns(k)), heads))
         end do
      end associate
      allocate (designer%readings(size(study%responses)))
      do k = 1, size(study%responses)
         asked = study%responses(k)
         associate (result => designer%workspace%cases(designer%case_of(k))%result, readings => designer%readings)
            call sweep_columns(result%suspension, result%case, heads)
            if (study%definitions /= '') then
               call define_columns(result%suspension, heads, trim(study%definitions), list)
               heads = [character(name_length) :: heads, list%head]
            end if
            call take_headings(designer%options(designer%case_of(k)), asked, message)
            if (message /= '') then
               continue
            else if (asked%of == 'difference') then
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

   !> Checks that no two columns of the table of designs have the same heading.
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

      !> Reports a column heading that is used twice.
      subroutine add(who, head, other)
         character(*), intent(in) :: who, head, other
         call mistakes%add(who//': its column would have the name '//quoted(head)//', like that of '//other//'; rename one')
      end subroutine add

   end subroutine check_heads

end module ek_designer
