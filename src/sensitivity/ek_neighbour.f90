!> The neighbouring designs of a design, on the rig of a case. Like every design, each neighbour is realised, balanced and mounted,
!> one neighbour after the other.
module ek_neighbour
   use ek_kinds, only: wp
   use ek_case, only: case_t
   use ek_parameter, only: in_range
   use ek_blueprint, only: mark_own_elements
   use ek_realise, only: realise_element
   use ek_element, only: copy_element
   use ek_suspension, only: suspension_t, copy_numbers
   use ek_rotation, only: perpendicular
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, make_schedule, inputs_at, same_schedule
   use ek_kkt, only: copy_scales
   use ek_path, only: path_t, new_path
   use ek_case_result, only: case_result_t
   use ek_workspace, only: workspace_t, put_numbers, mount_numbers
   use ek_direction, only: direction_t, move_along
   use ek_stencil, only: stencil_t, stencils, close_pair, close_four
   use ek_part_change, only: change_t, draft_t, begin_draft, learn_neighbour, learn_elements, finish_draft
   implicit none(type, external)
   private
   public :: neighbour_t, point_t, begin_neighbour, follow_design, take_states, learn_number, go_to

   real(wp), parameter :: balance_tolerance = 1.0e-13_wp      !! tolerance of the preload trim [m]: balance 'spring' iterates, and
                                                              !! its error is divided by a step

   !> A neighbouring design: a design close to a given design.
   type :: neighbour_t
      integer :: case = 0                                  !! index of the case in the workspace
      class(workspace_t), allocatable :: workspace         !! the deck at the numbers of the neighbour; a class for the reason given
                                                           !! at case_work_t
      real(wp), allocatable :: x(:)
      type(schedule_t), private :: here, schedule          !! schedules of the inputs: of the design, of the neighbour
      type(path_t), private :: path
      ! a number of a few elements alone, of a model without preload trim: only these elements are realised
      logical, private :: has_elements_alone = .false.     !! such a number was moved last
      logical, private :: is_at_design = .false.           !! all parts except the moved elements have the numbers of the design
      logical, allocatable, private :: is_own(:)           !! each element that has the number
      logical, allocatable, private :: is_moved(:)         !! each element that does not have the numbers of the design
   end type neighbour_t

   !> One state on the path of the design.
   type :: point_t
      integer :: number = 0                      !! index of the state on the path
      logical :: is_regular = .false.            !! the state was reached, and its tangent is regular
      type(state_t) :: state
   end type point_t

contains

   !> Prepares the neighbouring designs of a design. Creates strings.
   subroutine begin_neighbour(workspace, k, self)
      type(workspace_t), intent(in) :: workspace          !! the case was solved at its present numbers
      integer, intent(in) :: k                             !! index of the case
      type(neighbour_t), intent(inout) :: self

      self%case = k
      if (allocated(self%workspace)) deallocate (self%workspace)
      allocate (self%workspace, source=workspace)
      self%workspace%keeps_origins = .true.
      self%x = workspace%x
      associate (elements => size(workspace%raw%elements))
         self%is_own = spread(.false., 1, elements)
         self%is_moved = spread(.false., 1, elements)
      end associate
   end subroutine begin_neighbour

   !> Copies the present design to the neighbour, so that numbers that do not change in the neighbour are identical bit for bit, and
   !> the scales of its system.
   subroutine follow_design(workspace, self)
      type(workspace_t), intent(in) :: workspace
      type(neighbour_t), intent(inout) :: self

      call copy_numbers(workspace%raw, self%workspace%raw)
      self%workspace%raw%bodies%has_origin = .true.
      self%is_at_design = .false.
      call keep_choices(workspace%raw, self%workspace%raw)
      call copy_scales(workspace%cases(self%case)%result%kkt, self%workspace%cases(self%case)%result%kkt)
   end subroutine follow_design

   !> Copies to the neighbour the directions across the joint axes that the rows of joints use. Each direction is computed from the
   !> global axis with the smallest component along the joint axis. If two components are equal, neighbours could use different
   !> global axes, and λ would have a different meaning in each neighbour.
   subroutine keep_choices(design, neighbour)
      type(suspension_t), intent(in) :: design
      type(suspension_t), intent(inout) :: neighbour
      integer :: k

      do k = 1, size(design%joints)
         neighbour%joints(k)%across = 0.0_wp
         if (design%joints(k)%is_of_measures) cycle
         if (norm2(design%joints(k)%axis(:, 1)) > 0.0_wp) neighbour%joints(k)%across = perpendicular(design%joints(k)%axis(:, 1))
      end do
   end subroutine keep_choices

   !> Whether the bushing axes of two neighbouring designs are close. If a deck gives one axis only, the program chooses the other
   !> axis. If this choice changes between the designs, rates and columns have no derivative.
   pure logical function has_same_axes(a, b)
      type(suspension_t), intent(in) :: a, b
      real(wp), parameter :: close = 0.1_wp
      integer :: k

      has_same_axes = .true.
      do k = a%scalars + 1, size(a%elements)
         if (any(abs(a%elements(k)%bushing%axes - b%elements(k)%bushing%axes) > close)) has_same_axes = .false.
      end do
   end function has_same_axes

   !> Copies states of the path and finds their inputs. States that were not reached are marked as not regular.
   subroutine take_states(result, states, self, points, inputs)
      type(case_result_t), intent(in) :: result
      integer, intent(in) :: states(:)
      type(neighbour_t), intent(inout) :: self
      type(point_t), intent(inout) :: points(:)
      type(inputs_t), intent(inout) :: inputs(:)
      integer :: s

      call make_schedule(result%suspension, result%case, self%here)
      do s = 1, size(states)
         points(s)%number = states(s)
         points(s)%state = design_state(result%suspension)
         points(s)%is_regular = result%path%is_reached(states(s))
         if (.not. points(s)%is_regular) cycle
         call unpack_state(result%path%packed(:, states(s)), points(s)%state)
         call inputs_at(self%here, result%path%value(states(s)), inputs(s))
      end do
   end subroutine take_states

   !> Finds the change that a number causes in the parts of the model, from two neighbours close to the design. Four neighbours are
   !> used if the axes of a bushing may turn: between a stiff and a soft axis, rates and preloads curve a hundred times as much as
   !> the angle. If a nonlinear law changes, or at the end of the range of the number, the first stencil whose points are all valid
   !> designs is used.
   subroutine learn_number(x, direction, result, points, here, self, draft, change, can_move)
      real(wp), intent(in) :: x(:)
      type(direction_t), intent(in) :: direction
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      type(inputs_t), intent(in) :: here(:)                !! inputs of the states, of the design itself
      type(neighbour_t), intent(inout) :: self
      type(draft_t), intent(inout) :: draft                !! work space
      type(change_t), intent(inout) :: change
      logical, intent(out) :: can_move                     !! .false.: every stencil contains a design that is not valid
      integer :: kind

      call visit_neighbours(x, direction, close_pair, result, points, here, self, draft, change, can_move)
      if (can_move .and. change%has_axes .and. .not. change%has_curves) &
         call visit_neighbours(x, direction, close_four, result, points, here, self, draft, change, can_move)
      do kind = 1, size(stencils)
         if (can_move .and. .not. change%has_curves) return
         call visit_neighbours(x, direction, stencils(kind), result, points, here, self, draft, change, can_move)
         if (can_move) return
      end do
   end subroutine learn_number

   !> Finds the change of the parts from the points of a stencil. can_move is .false. if a point is not a valid design.
   subroutine visit_neighbours(x, direction, stencil, result, points, here, self, draft, change, can_move)
      real(wp), intent(in) :: x(:)
      type(direction_t), intent(in) :: direction
      type(stencil_t), intent(in) :: stencil
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      type(inputs_t), intent(in) :: here(:)
      type(neighbour_t), intent(inout) :: self
      type(draft_t), intent(inout) :: draft
      type(change_t), intent(inout) :: change
      logical, intent(out) :: can_move
      type(inputs_t) :: there(size(points))
      logical :: has_inputs
      integer :: k

      call begin_draft(result%suspension, stencil, direction%step, draft, change)
      do k = 1, stencil%points
         call go_to(x, direction, stencil%at(k), result, points, self, there, has_inputs, can_move)
         if (.not. can_move) return
         associate (there => self%workspace%cases(self%case)%result%suspension)
            if (self%has_elements_alone) then
               call learn_elements(result%suspension, there, k, self%is_own, change, draft)
            else
               call learn_neighbour(result%suspension, there, k, change, draft)
            end if
         end associate
         if (has_inputs) call add_rates(points, here, there, change%weight(k), change%rates)
      end do
      call finish_draft(direction%step, draft, change)
   end subroutine visit_neighbours

   !> Adds the contribution of a neighbour, times `weight`, to the derivatives of the inputs.
   subroutine add_rates(points, here, there, weight, rates)
      type(point_t), intent(in) :: points(:)
      type(inputs_t), intent(in) :: here(:), there(:)      !! inputs of each state, for the same loads and rows
      real(wp), intent(in) :: weight
      type(inputs_t), allocatable, intent(inout) :: rates(:)
      integer :: s

      if (.not. allocated(rates)) then
         rates = here
         do s = 1, size(rates)
            rates(s)%factor = 0.0_wp
            rates(s)%change = 0.0_wp
         end do
      end if
      do s = 1, size(rates)
         if (.not. points(s)%is_regular) cycle
         rates(s)%factor = rates(s)%factor + weight*(there(s)%factor - here(s)%factor)
         rates(s)%change = rates(s)%change + weight*(there(s)%change - here(s)%change)
      end do
   end subroutine add_rates

   !> Puts the neighbour with a changed number on the rig, with the inputs of the states.
   subroutine go_to(x, direction, steps, result, points, self, inputs, has_inputs, is_done)
      real(wp), intent(in) :: x(:)
      type(direction_t), intent(in) :: direction
      real(wp), intent(in) :: steps                        !! distance in steps of the direction
      type(case_result_t), intent(in) :: result            !! result of the design itself
      type(point_t), intent(in) :: points(:)
      type(neighbour_t), intent(inout) :: self
      type(inputs_t), intent(inout) :: inputs(:)
      logical, intent(out) :: has_inputs                   !! inputs differ from the design's inputs; otherwise they are not set
      logical, intent(out) :: is_done !! .false.: the neighbour is not valid, has other bushing axes, or has other states
      real(wp) :: place
      integer :: s

      has_inputs = .false.
      call find_own_elements(direction, self)
      if (self%has_elements_alone) then
         call move_elements(x, direction, steps, self, is_done)
         return
      end if
      self%x(:) = x
      call move_along(direction, steps*direction%step, self%x)
      self%is_at_design = .false.
      call put_numbers(self%x, self%workspace)
      call mount_numbers(self%case, balance_tolerance, self%workspace, is_done)
      if (.not. is_done) return
      associate (there => self%workspace%cases(self%case)%result, path => result%path)
         is_done = has_same_axes(result%suspension, there%suspension)
         if (.not. is_done) return
         call make_schedule(there%suspension, there%case, self%schedule)
         has_inputs = has_other_range(there%case, result%case) .or. .not. same_schedule(self%schedule, self%here)
         if (.not. has_inputs) return
         if (has_other_range(there%case, result%case)) then
            call new_path(there%suspension, there%case, self%path)
            is_done = self%path%states == path%states .and. self%path%start == path%start
            if (.not. is_done) return
         end if
         do s = 1, size(points)
            if (.not. points(s)%is_regular) cycle
            place = path%value(points(s)%number)
            if (has_other_range(there%case, result%case)) place = self%path%value(points(s)%number)
            call inputs_at(self%schedule, place, inputs(s))
         end do
      end associate
   end subroutine go_to

   !> Finds the elements that a direction changes, if it changes nothing else. With a preload trim, each number changes preloads,
   !> too; with a start state, forces and heights of the wheels.
   pure subroutine find_own_elements(direction, self)
      type(direction_t), intent(in) :: direction
      type(neighbour_t), intent(inout) :: self
      integer :: j

      self%has_elements_alone = self%workspace%raw%balance == 'none' .and. self%workspace%raw%start == ''
      if (.not. self%has_elements_alone) return
      self%is_own(:) = .false.
      do j = 1, size(direction%found)
         call mark_own_elements(self%workspace%definition%plan, direction%found(j)%number, &
            self%workspace%cases(self%case)%number, self%is_own, self%has_elements_alone)
         if (.not. self%has_elements_alone) return
      end do
   end subroutine find_own_elements

   !> Puts the neighbour with changed elements on the rig, where the design itself is put first. Elements that the neighbour before
   !> changed get their numbers back.
   subroutine move_elements(x, direction, steps, self, is_done)
      real(wp), intent(in) :: x(:)
      type(direction_t), intent(in) :: direction
      real(wp), intent(in) :: steps                        !! distance in steps of the direction
      type(neighbour_t), intent(inout) :: self             !! has_elements_alone
      logical, intent(out) :: is_done
      integer :: k

      is_done = .true.
      if (.not. self%is_at_design) then
         call put_numbers(x, self%workspace)
         call mount_numbers(self%case, balance_tolerance, self%workspace, is_done)
         if (.not. is_done) return
         self%is_at_design = .true.
         self%is_moved(:) = .false.
      end if
      self%x(:) = x
      call move_along(direction, steps*direction%step, self%x)
      is_done = in_range(self%workspace%definition%parameters, direction%found, self%x)
      if (.not. is_done) return
      associate (raw => self%workspace%raw, there => self%workspace%cases(self%case)%result%suspension)
         do k = 1, size(raw%elements)
            if (.not. (self%is_own(k) .or. self%is_moved(k))) cycle
            self%is_moved(k) = self%is_own(k)
            call realise_element(self%workspace%definition%plan, self%x, k, raw, is_done)
            if (.not. is_done) exit
            call copy_element(raw%elements(k), there%elements(k))
         end do
      end associate
      if (.not. is_done) self%is_at_design = .false.       ! not all elements are as `is_moved` says
   end subroutine move_elements

   !> Whether the swept values of two designs of a case differ.
   pure logical function has_other_range(a, b)
      type(case_t), intent(in) :: a, b
      has_other_range = abs(a%from - b%from) > 0.0_wp .or. abs(a%to - b%to) > 0.0_wp
   end function has_other_range

end module ek_neighbour
