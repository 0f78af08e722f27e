!> Factors with each = .true.: every number to which the paths lead becomes a separate factor. Columns with `*` become all matching
!> columns.
module ek_study_each
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, quoted, is_like
   use ek_record, only: own_name, right_side
   use ek_deck, only: deck_t
   use ek_parameter, only: choice_t, path_t, find_parameters, split_path, parameter_path
   use ek_reader, only: definition_t, read_design
   use ek_study, only: study_t, study_factor_t, surplus_factors, by_scale
   use ek_factor_paths, only: is_held_in_plane
   use ek_workspace, only: workspace_t
   use ek_workspace_cases, only: open_cases, heads_of_case
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: expand_factors, expand_columns

contains

   !> Replaces each factor with each = .true. by one factor per number. The following numbers are omitted: numbers that the deck
   !> does not give, zeros that would be scaled, and y of a point in the centre plane of a mirrored deck, unless `shared` names the
   !> point. The two sides of a mirrored axle are one factor, unless the path contains the side.
   subroutine expand_factors(study, deck, error)
      type(study_t), intent(inout) :: study
      type(deck_t), intent(in) :: deck
      type(error_t), allocatable, intent(out) :: error     !! exit_deck
      type(definition_t) :: design
      type(study_factor_t), allocatable :: factors(:)
      integer :: place(size(study%factors)), f, k, before

      if (.not. any(study%factors%is_each)) return
      call read_design(deck, design, error)
      if (allocated(error)) return
      allocate (factors(0))
      do f = 1, size(study%factors)
         before = size(factors)
         place(f) = before + 1
         if (.not. study%factors(f)%is_each) then
            factors = [factors, study%factors(f)]
            cycle
         end if
         do k = 1, size(study%factors(f)%paths)
            call add_each(design, study%factors(f), trim(study%factors(f)%paths(k)), before, factors)
         end do
         if (size(factors) > before) cycle
         call fail(error, exit_deck, study%factors(f)%where//': factor '//quoted(study%factors(f)%name)// &
            ': its paths lead to no parameter of the deck')
         return
      end do
      study%settings%pairs = reshape(place(pack(study%settings%pairs, .true.)), shape(study%settings%pairs))
      call move_alloc(factors, study%factors)
      if (surplus_factors(study) /= '') call fail(error, exit_deck, study%where//': study '//quoted(study%name)//': '// &
         surplus_factors(study))
   end subroutine expand_factors

   !> Replaces columns with `*` by the matching columns of the results. The columns `state`, `factor` (which is always written) and
   !> `converged` do not match.
   subroutine expand_columns(study, deck, error)
      type(study_t), intent(inout) :: study
      type(deck_t), intent(in) :: deck
      type(error_t), allocatable, intent(out) :: error     !! exit_deck, or as open_cases
      class(workspace_t), allocatable :: workspace
      type(definition_t), target :: definition
      character(name_length), parameter :: never(3) = [character(name_length) :: 'state', 'factor', 'converged']
      character(name_length), allocatable :: heads(:)
      character(name_length), allocatable :: columns(:)
      integer :: c, k
      logical :: is_found

      allocate (workspace)
      if (.not. any(index(study%columns, '*') > 0)) return
      call open_cases(deck, [study%case], definition, workspace, error)
      if (allocated(error)) return
      call heads_of_case(1, workspace, heads)
      allocate (columns(0))
      do c = 1, size(study%columns)
         if (index(study%columns(c), '*') == 0) then
            call add(study%columns(c))
            cycle
         end if
         is_found = .false.
         do k = 1, size(heads)
            if (any(heads(k) == never) .or. .not. is_like(trim(heads(k)), trim(study%columns(c)))) cycle
            is_found = .true.
            call add(heads(k))
         end do
         if (is_found) cycle
         call fail(error, exit_deck, study%where//': columns: the results have no column like '//quoted(trim(study%columns(c))))
         return
      end do
      call move_alloc(columns, study%columns)

   contains

      subroutine add(name)
         character(*), intent(in) :: name
         if (.not. any(columns == name)) columns = [character(name_length) :: columns, name]
      end subroutine add

   end subroutine expand_columns

   !> Adds one factor for each number to which a path leads, with the omissions of expand_factors.
   subroutine add_each(design, given, path_text, before, factors)
      type(definition_t), intent(in) :: design
      type(study_factor_t), intent(in) :: given
      character(*), intent(in) :: path_text
      integer, intent(in) :: before              !! number of factors of the former lines
      type(study_factor_t), allocatable, intent(inout) :: factors(:)
      type(study_factor_t) :: one
      type(choice_t), allocatable :: found(:)
      type(path_t) :: path
      character(:), allocatable :: message
      logical :: is_both
      integer :: k, j

      call split_path(path_text, path, message)
      call find_parameters(design%parameters, design%records, path_text, found)
      do k = 1, size(found)
         associate (parameter => design%parameters%list(found(k)%number), x => design%parameters%x(found(k)%number), &
            record => design%records(design%parameters%list(found(k)%number)%record))
            is_both = is_like(own_name(record), path%name)
            if (is_both .and. record%side == right_side .and. parameter%tied > 0) cycle      ! with that of the left side
            if (.not. parameter%is_given .or. (given%change == by_scale .and. .not. abs(x) > 0.0_wp)) cycle
            if (is_held_in_plane(design, found(k)%number)) cycle
            one = given
            one%is_each = .false.
            one%is_of_pattern = index(path_text, '*') > 0
            deallocate (one%paths)
            allocate (one%paths(1))
            one%paths(1) = parameter_path(parameter, design%records, is_of_pair=is_both)
            if (any([(factors(j)%paths(1) == one%paths(1), j=before + 1, size(factors))])) cycle     ! of an earlier path
            one%name = name_of(trim(one%paths(1)), factors)
            factors = [factors, one]
         end associate
      end do
   end subroutine add_each

   !> Name of the factor of a path: 'lca_front_kt_1' for 'bushing.lca_front.kt(1)'. If another factor has this name, the name begins
   !> with the group.
   pure function name_of(path, factors) result(name)
      character(*), intent(in) :: path
      type(study_factor_t), intent(in) :: factors(:)
      character(:), allocatable :: name
      integer :: k

      name = ''
      do k = 1, len(path)
         if (path(k:k) == ')') cycle
         name = name//path(k:k)
         if (scan(path(k:k), '.(') > 0) name(len(name):) = '_'
      end do
      do k = 1, size(factors)
         if (factors(k)%name == name(index(name, '_') + 1:)) return
      end do
      name = name(index(name, '_') + 1:)
   end function name_of

end module ek_study_each
