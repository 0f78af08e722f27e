!> The values of requested columns at one state: quantities of the table of a case, and entries of its compliance matrix.
module ek_column_observer
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t, assemble_gradients
   use ek_attitude, only: attitude_t, find_attitude
   use ek_table, only: name_length
   use ek_sweep_table, only: observer_t, make_observer, observe_state, quantity_columns, reads_matrix, reads_poses_of_wheels
   use ek_state_columns, only: block_vector, most_values
   use ek_column_list, only: fill_asked
   use ek_state_blocks, only: block_reads, same_block, parts_of_block, pair_of_block
   use ek_compliance, only: compliance_t, new_compliance, keep_responses
   use ek_skew_system, only: has_skew_part
   use ek_compliance_table, only: compliance_columns, observe_compliance
   implicit none(type, external)
   private
   public :: column_observer_t, new_column_observer, observe_columns, keep_state, kept_loads, &
      reads_states, reads_wheels_only
   public :: count_blocks, columns_of_block, find_reads, find_pair, is_same_block, observe_block

   !> The requested columns of a model, and work space to observe the columns.
   type :: column_observer_t
      character(name_length), allocatable :: columns(:)    !! quantities, then entries of the compliance matrix
      integer, private :: quantities = 0
      integer, allocatable, private :: entries(:)          !! indices of the entries among compliance_columns
      class(observer_t), allocatable, private :: observer      !! a class for the reason given at case_work_t
      type(compliance_t), private :: compliance
      type(attitude_t), allocatable, private :: wheels(:)
      real(wp), allocatable, private :: work(:), matrix(:)
   end type column_observer_t

contains

   !> Creates an observer of the requested columns. Columns that the model does not define are omitted. Creates strings.
   subroutine new_column_observer(suspension, case, columns, self)
      type(suspension_t), intent(in) :: suspension         !! suspension on the rig
      type(case_t), intent(in) :: case
      character(*), intent(in) :: columns(:)
      type(column_observer_t), intent(out) :: self
      character(name_length), allocatable :: names(:)
      integer :: j

      allocate (self%observer)
      call make_observer(suspension, case, self%observer, columns)
      self%columns = quantity_columns(self%observer)
      self%quantities = size(self%columns)
      call compliance_columns(suspension, names)
      self%entries = pack([(j, j=1, size(names))], [(any(columns == names(j)), j=1, size(names))])
      self%columns = [character(name_length) :: self%columns, names(self%entries)]
      self%compliance = new_compliance(suspension, .false.)
      allocate (self%wheels(size(suspension%wheels)))
      allocate (self%matrix(size(names)), source=0.0_wp)
   end subroutine new_column_observer

   !> Computes the values of the columns at an equilibrium. With the data `kept`, stored at an equilibrium, the values may be
   !> computed at a state close to the equilibrium.
   subroutine observe_columns(suspension, state, inputs, kkt, self, values, kept)
      type(suspension_t), intent(in) :: suspension         !! suspension on the rig
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                    !! work space
      type(column_observer_t), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      real(wp), intent(in), optional :: kept(:, :)         !! data stored by keep_state
      logical :: has_kept

      if (self%quantities > 0) call observe_state(suspension, state, inputs, kkt, self%observer, self%wheels, self%work, &
         values(:self%quantities))
      if (size(self%entries) == 0) return
      has_kept = present(kept)
      if (has_kept) has_kept = size(kept, 1) > 0
      if (has_kept) has_kept = .not. has_skew_part(suspension, inputs)
      if (has_kept) then
         call observe_compliance(suspension, state, inputs, kkt, self%compliance, self%matrix, kept)
      else
         call observe_compliance(suspension, state, inputs, kkt, self%compliance, self%matrix)
      end if
      values(self%quantities + 1:) = self%matrix(self%entries)
   end subroutine observe_columns

   !> Number of blocks of columns: a wheel, an element, a joint, … Each block has columns next to one another. Only if reads_states.
   pure integer function count_blocks(self)
      type(column_observer_t), intent(in) :: self
      count_blocks = size(self%observer%list%blocks)
   end function count_blocks

   !> Finds the first and last column of a block.
   pure subroutine columns_of_block(self, k, first, last)
      type(column_observer_t), intent(in) :: self
      integer, intent(in) :: k                             !! 1 … count_blocks
      integer, intent(out) :: first, last

      associate (list => self%observer%list)
         first = 1
         if (list%blocks(k) > 1) first = list%last_asked(list%blocks(k) - 1) + 1
         last = list%last_asked(list%blocks(k))
      end associate
   end subroutine columns_of_block

   !> Finds the unknowns that the values of a block follow from.
   pure subroutine find_reads(suspension, self, k, is_read)
      type(suspension_t), intent(in) :: suspension
      type(column_observer_t), intent(in) :: self
      integer, intent(in) :: k
      logical, intent(out) :: is_read(:)                   !! of each unknown of the system
      call block_reads(suspension, self%observer%list, self%observer%list%blocks(k), is_read)
   end subroutine find_reads

   !> Finds the bodies i and j if the values of a block follow from the pose of j relative to i alone; else both are 0.
   pure subroutine find_pair(suspension, self, k, body_i, body_j)
      type(suspension_t), intent(in) :: suspension
      type(column_observer_t), intent(in) :: self
      integer, intent(in) :: k
      integer, intent(out) :: body_i, body_j
      call pair_of_block(suspension, self%observer%list, self%observer%list%blocks(k), body_i, body_j)
   end subroutine find_pair

   !> Whether the values of a block at any state are equal in two designs.
   pure logical function is_same_block(here, there, self, k)
      type(suspension_t), intent(in) :: here, there
      type(column_observer_t), intent(in) :: self
      integer, intent(in) :: k
      is_same_block = same_block(here, there, self%observer%list, self%observer%list%blocks(k))
   end function is_same_block

   !> Computes the values of a block, as observe_columns does, which must have been called before.
   subroutine observe_block(suspension, state, kkt, self, k, values)
      type(suspension_t), intent(in) :: suspension         !! suspension on the rig
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt                    !! work space
      type(column_observer_t), intent(inout) :: self
      integer, intent(in) :: k
      real(wp), intent(inout) :: values(:)                 !! of all columns; those of the block change
      real(wp) :: vector(most_values)
      integer :: wheel, joint

      associate (list => self%observer%list, b => self%observer%list%blocks(k))
         call parts_of_block(list, b, wheel, joint)
         if (wheel > 0) then
            associate (body => suspension%wheels(wheel)%body)
               call find_attitude(suspension%wheels(wheel), suspension%bodies(body)%origin, state%poses(body + 1), &
                  self%wheels(wheel))
            end associate
         end if
         if (joint > 0) then
            associate (row => suspension%joints(joint)%first_row, rows => suspension%joints(joint)%rows)
               call assemble_gradients(suspension, state, row, row + rows - 1, kkt)
            end associate
         end if
         call block_vector(suspension, state, self%wheels, kkt, list, b, vector)
         call fill_asked(list, b, vector, values)
      end associate
   end subroutine observe_block

   !> Whether all columns follow from a state alone, without the compliance matrix and without a model in addition to the state.
   pure logical function reads_states(self)
      type(column_observer_t), intent(in) :: self
      reads_states = size(self%entries) == 0 .and. .not. reads_matrix(self%observer)
   end function reads_states

   !> Whether all columns follow from the poses and the data of the wheels.
   pure logical function reads_wheels_only(self)
      type(column_observer_t), intent(in) :: self
      reads_wheels_only = size(self%entries) == 0 .and. reads_poses_of_wheels(self%observer)
   end function reads_wheels_only

   !> Number of unit loads whose responses are stored: the loads of the compliance matrix, or 0 if no entry of the matrix is
   !> observed.
   pure integer function kept_loads(self)
      type(column_observer_t), intent(in) :: self
      kept_loads = merge(6*size(self%wheels), 0, size(self%entries) > 0)
   end function kept_loads

   !> Stores the data of an observed equilibrium for observe_columns at states close to the equilibrium.
   pure subroutine keep_state(self, kept)
      type(column_observer_t), intent(in) :: self          !! observer after observe_columns
      real(wp), intent(inout) :: kept(:, :)                !! (kept_loads, unknown)
      if (size(kept, 1) > 0) call keep_responses(self%compliance, kept)
   end subroutine keep_state

end module ek_column_observer
