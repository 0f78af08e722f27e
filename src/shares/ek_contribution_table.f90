!> The contributions to the columns of a case that are linear in the compliance matrix, state by state: the share of each element,
!> joint and load in each column, and the load paths of each state.
module ek_contribution_table
   use ek_kinds, only: wp
   use ek_text, only: is_like
   use ek_noise, only: noise_of, is_lost, derived
   use ek_element, only: element_kinds, bushing_element
   use ek_suspension, only: suspension_t
   use ek_free_wheels, only: has_rates
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_schedule, only: schedule_t, inputs_at
   use ek_kkt, only: kkt_t
   use ek_path, only: path_t
   use ek_wheel_contact, only: contact_lever
   use ek_loaded_wheels, only: quotient, min_compliance
   use ek_port_response, only: load_at_patch, read_at_patch
   use ek_linear_columns, only: linear_columns_t, start_linear_columns, choose_linear_columns, find_linear_columns, &
      fill_linear_columns
   use ek_contribution, only: contribution_t, share_t, new_contribution, split_compliance, of_element, of_joint, of_load, &
      geometric, of_stiffness
   use ek_load_path, only: load_path_t, find_load_paths
   implicit none(type, external)
   private
   public :: contribution_table_t, row_name_t, start_contributions, choose_contributions, find_contributions, name_share, &
      is_key_compliance

   integer, parameter, public :: share_length = 64      !! greatest length of a name in a deck

   !> The columns that are shown if none are named. For each wheel: deflection, steer and camber under a lateral force, steer under
   !> an aligning moment, deflection and steer under braking, and vertical compliance at the contact point.
   character(*), parameter, public :: key_compliances(*) = [character(48) :: '*lateral_in_load_held_deflection_mm_per_kn', &
      '*lateral_in_load_held_steer_deg_per_kn', '*lateral_in_load_held_camber_deg_per_kn', &
      '*aligning_in_load_held_steer_deg_per_100nm', '*braking_load_held_deflection_mm_per_kn', &
      '*braking_load_held_steer_deg_per_kn', 'patch_z_by_fz_mm_per_kn', 'patch_left_z_by_left_fz_mm_per_kn', &
      'patch_right_z_by_right_fz_mm_per_kn']

   !> The part of the model to which a row of the table belongs.
   type :: row_name_t
      character(share_length) :: row = ''       !! name of the element, joint or load
      character(20) :: kind = ''                !! 'bushing', 'spring', 'spherical', 'load', 'state'
      character(10) :: part = ''                !! 'x' … 'rz', 'rate', 'stiffness', 'geometric', 'unbalanced'
   end type row_name_t

   !> The columns and rows of a model on the rig, and their values at one state.
   type :: contribution_table_t
      type(linear_columns_t) :: columns
      type(contribution_t) :: shares
      type(row_name_t), allocatable :: row(:)
      real(wp), allocatable :: values(:)        !! values of the requested columns, in their units
      real(wp), allocatable :: parts(:, :)      !! (requested column, row): contributions, which add up to the value
      type(load_path_t) :: paths
      real(wp), allocatable :: arm(:, :)        !! from each wheel centre to its contact point at the state [m], global axes
      real(wp), allocatable :: energy(:, :)     !! (load of the paths, row): share of the strain energy; the rows add up to 1
      logical :: is_known = .false.             !! whether the matrix of the state is not singular
   end type contribution_table_t

contains

   !> Lists the columns and rows. All columns are requested.
   subroutine start_contributions(suspension, self)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(contribution_table_t), intent(out) :: self
      logical, allocatable :: is_wanted(:)
      integer :: k

      call start_linear_columns(suspension, self%columns)
      self%shares = new_contribution(suspension, self%columns%kandc%compliance%wheels)
      allocate (self%row(size(self%shares%share)))
      do k = 1, size(self%row)
         call name_share(suspension, self%shares%share(k), self%row(k))
      end do
      allocate (self%energy(3*self%columns%kandc%compliance%wheels, size(self%row)), source=0.0_wp)
      allocate (is_wanted(self%columns%used), source=.true.)
      call choose_contributions(is_wanted, self)
   end subroutine start_contributions

   !> Restricts the table to the requested columns.
   subroutine choose_contributions(is_wanted, self)
      logical, intent(in) :: is_wanted(:)
      type(contribution_table_t), intent(inout) :: self

      call choose_linear_columns(self%columns, is_wanted)
      if (allocated(self%values)) deallocate (self%values, self%parts)
      allocate (self%values(size(self%columns%asked)), self%parts(size(self%columns%asked), size(self%row)), source=0.0_wp)
   end subroutine choose_contributions

   !> Sets the names of a row.
   subroutine name_share(suspension, share, name)
      type(suspension_t), intent(in) :: suspension
      type(share_t), intent(in) :: share
      type(row_name_t), intent(out) :: name
      character(2), parameter :: axes(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz']

      name%part = 'geometric'
      select case (share%kind)
      case (of_element)
         associate (element => suspension%elements(share%item))
            name%row = element%name
            name%kind = element_kinds(element%kind)%label
            if (share%part /= geometric .and. element%kind == bushing_element) name%part = axes(share%part)
            if (share%part /= geometric .and. element%kind /= bushing_element) name%part = 'rate'
         end associate
      case (of_joint)
         name%row = suspension%joints(share%item)%name
         name%kind = suspension%joints(share%item)%kind
         if (share%part == of_stiffness) name%part = 'stiffness'
      case (of_load)
         name%row = suspension%loads(share%item)%name
         name%kind = 'load'
      case default
         name%row = 'state'
         name%kind = 'state'
         name%part = 'unbalanced'
      end select
   end subroutine name_share

   !> Finds the contributions at one reached state of a path. If the matrix of the state is singular, only is_known and the values
   !> are set. A compliance that is only rounding noise, such as that of a wheel held by joints, is 0 and has no contributions.
   !> Equation (C.15) of docs/theory/compliance.md.
   subroutine find_contributions(suspension, schedule, path, k, kkt, self)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(schedule_t), intent(in) :: schedule              !! of the case
      type(path_t), intent(in) :: path
      integer, intent(in) :: k                              !! index of the state
      type(kkt_t), intent(inout) :: kkt                     !! work space; on return, with the factors of the state
      type(contribution_table_t), intent(inout) :: self
      type(state_t) :: state
      type(inputs_t) :: inputs
      real(wp) :: arm(3, size(suspension%wheels))
      integer :: e, w, n

      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
      call inputs_at(schedule, path%value(k), inputs)
      call find_linear_columns(suspension, state, inputs, kkt, self%columns, self%values)
      associate (compliance => self%columns%kandc%compliance)
         self%is_known = compliance%is_known .and. has_rates(suspension)
         if (.not. self%is_known) return
         call split_compliance(suspension, state, inputs, kkt, compliance, self%shares)
         n = 6*compliance%wheels
         call fill_linear_columns(suspension, compliance%response(:n, :n), self%columns, self%values)     ! refined
         do e = 1, size(self%row)
            call fill_linear_columns(suspension, self%shares%matrix(:, :, e), self%columns, self%parts(:, e))
         end do
         call remove_noise(self)
         do w = 1, compliance%wheels
            associate (wheel => suspension%wheels(compliance%order(w)))
               arm(:, w) = contact_lever(wheel, state%poses(wheel%body + 1)%a)
            end associate
         end do
         call find_load_paths(suspension, state, inputs, kkt, compliance, self%shares, arm, self%paths)
         call find_energy(compliance%response(:n, :n), arm, self)
         self%arm = arm
      end associate
   end subroutine find_contributions

   !> Sets a column to 0 that is only noise, with its contributions, and single contributions that are only noise. A sum of
   !> contributions that cancel but for noise is 0.
   subroutine remove_noise(self)
      type(contribution_table_t), intent(inout) :: self
      real(wp) :: whole
      integer :: c

      do c = 1, size(self%values)
         whole = sum(abs(self%parts(c, :)))
         associate (column => self%columns%names(self%columns%asked(c)))
            if (max(whole, abs(self%values(c))) <= noise_of(trim(column), 0.0_wp, derived)) self%parts(c, :) = 0.0_wp
            where (is_lost(self%parts(c, :), whole)) self%parts(c, :) = 0.0_wp
            if (abs(self%values(c)) <= noise_of(trim(column), whole, derived)) self%values(c) = 0.0_wp
         end associate
      end do
   end subroutine remove_noise

   !> Finds the shares of the strain energy under unit forces at the contact points, from the diagonal of C. A share is NaN if a
   !> joint holds the contact point against the force.
   subroutine find_energy(c, arm, self)
      real(wp), intent(in) :: c(:, :), arm(:, :)
      type(contribution_table_t), intent(inout) :: self
      real(wp) :: whole(size(c, 1), size(c, 2)), share(size(c, 1), size(c, 2))
      integer :: e, load, at

      whole = read_at_patch(load_at_patch(c, arm), arm)
      do e = 1, size(self%row)
         share = read_at_patch(load_at_patch(self%shares%matrix(:, :, e), arm), arm)
         do load = 1, size(self%energy, 1)
            at = 6*((load - 1)/3) + mod(load - 1, 3) + 1
            self%energy(load, e) = quotient(share(at, at), whole(at, at), min_compliance)
         end do
      end do
   end subroutine find_energy

   !> Whether a column is one of the key compliances.
   pure logical function is_key_compliance(column)
      character(*), intent(in) :: column
      integer :: k

      is_key_compliance = .false.
      do k = 1, size(key_compliances)
         is_key_compliance = is_key_compliance .or. is_like(column, trim(key_compliances(k)))
      end do
   end function is_key_compliance

end module ek_contribution_table
