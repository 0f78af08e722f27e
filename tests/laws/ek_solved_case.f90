!> A case of a deck, solved at few states that are converged to rounding, and directions of numbers of the deck: where the laws of
!> derivatives begin.
module ek_solved_case
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage, exit_convergence
   use ek_file, only: read_whole
   use ek_deck, only: deck_t, parse_deck
   use ek_reader, only: definition_t
   use ek_case_result, only: solve_options_t
   use ek_workspace, only: workspace_t, solve_or_explain
   use ek_workspace_cases, only: open_workspace, case_number
   use ek_state, only: inputs_t
   use ek_kkt, only: kkt_t, new_kkt
   use ek_direction, only: direction_t, find_directions, all_directions
   use ek_part_change, only: draft_t
   use ek_neighbour, only: neighbour_t, point_t, begin_neighbour, follow_design, take_states
   implicit none(type, external)
   private
   public :: scene_t, open_scene, open_solved, one_in

   !> A solved case, two of its states, directions, and its neighbouring designs.
   type :: scene_t
      type(workspace_t) :: workspace
      type(workspace_t) :: other                           !! for complete designs, with the reference points of the bodies
      integer :: k = 0                                     !! index of the case
      type(direction_t), allocatable :: directions(:)
      type(neighbour_t) :: neighbour
      type(draft_t) :: draft
      type(point_t), allocatable :: points(:)              !! the second and the last state but one
      type(inputs_t), allocatable :: inputs(:)
      type(kkt_t) :: kkt
   end type scene_t

   real(wp), parameter :: tolerance = 1.0e-13_wp      ! m, of every state: differences divide its error by their step
   integer, parameter :: increments = 8

contains

   !> Opens a deck with further groups at two states of a case. `trouble` is '' if the case was solved.
   subroutine open_scene(file, groups, case, paths, definition, scene, trouble)
      character(*), intent(in) :: file, groups, case
      character(*), intent(in) :: paths                    !! see open_solved
      type(definition_t), target, intent(inout) :: definition
      type(scene_t), intent(out) :: scene
      character(:), allocatable, intent(out) :: trouble

      call open_solved(file, groups, case, paths, definition, scene%workspace, scene%k, scene%directions, trouble)
      if (trouble /= '') return
      call begin_neighbour(scene%workspace, scene%k, scene%neighbour)
      call follow_design(scene%workspace, scene%neighbour)
      allocate (scene%points(2), scene%inputs(2))
      associate (result => scene%workspace%cases(scene%k)%result)
         call take_states(result, [2, result%path%states - 1], scene%neighbour, scene%points, scene%inputs)
         scene%kkt = new_kkt(result%suspension)
      end associate
      scene%other = scene%neighbour%workspace
   end subroutine open_scene

   !> Opens a deck with further groups, and solves one of its cases. `trouble` is '' if the case was solved.
   subroutine open_solved(file, groups, case, paths, definition, workspace, k, directions, trouble)
      character(*), intent(in) :: file, groups, case
      character(*), intent(in) :: paths                    !! separated by blanks; '': all numbers of the deck
      type(definition_t), target, intent(inout) :: definition
      type(workspace_t), intent(out) :: workspace
      integer, intent(out) :: k                            !! index of the case
      type(direction_t), allocatable, intent(out) :: directions(:)
      character(:), allocatable, intent(out) :: trouble
      type(deck_t) :: deck
      type(error_t), allocatable :: error
      character(:), allocatable :: text
      logical :: is_done

      k = 0
      call read_whole(file, text, error)
      if (.not. allocated(error)) call parse_deck(text//new_line('a')//groups//new_line('a'), file, deck, error)
      if (.not. allocated(error)) call open_workspace(deck, definition, workspace, error)
      if (.not. allocated(error)) then
         k = case_number(case, workspace)
         if (k == 0) call fail(error, exit_usage, file//' has no case '//case)
      end if
      if (.not. allocated(error)) then
         workspace%cases%case%increments = increments
         workspace%cases%case%tolerance = tolerance
         workspace%deck_cases%increments = increments
         workspace%deck_cases%tolerance = tolerance
         call solve_or_explain(k, solve_options_t(), workspace, is_done, error)
         if (.not. allocated(error) .and. .not. is_done) call fail(error, exit_convergence, file//': '//case//' is not solved')
      end if
      if (.not. allocated(error)) call find_numbers(definition, deck, paths, directions, error)
      trouble = ''
      if (allocated(error)) trouble = error%message
   end subroutine open_solved

   !> The directions of paths, or of all numbers.
   subroutine find_numbers(definition, deck, paths, directions, error)
      type(definition_t), intent(in) :: definition
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: paths
      type(direction_t), allocatable, intent(out) :: directions(:)
      type(error_t), allocatable, intent(out) :: error
      type(message_list_t) :: list
      integer :: first, last

      if (paths == '') then
         call all_directions(definition, directions)
         return
      end if
      first = 1
      do while (first < len_trim(paths))
         last = first + index(paths(first:)//' ', ' ') - 2
         call list%add(paths(first:last))
         first = last + 2
      end do
      call find_directions(definition, deck, list, directions, error)
   end subroutine find_numbers

   !> One direction in so many, beginning with `first`.
   function one_in(stride, first, directions) result(some)
      integer, intent(in) :: stride, first
      type(direction_t), intent(in) :: directions(:)
      type(direction_t), allocatable :: some(:)
      integer :: k

      allocate (some(0))
      do k = first, size(directions), stride
         some = [some, directions(k)]
      end do
   end function one_in

end module ek_solved_case
