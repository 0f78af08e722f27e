!> The columns that are linear in the compliance matrix: the responses to forces and torques, with vertical loads or heights
!> held, and the entries of the matrix itself. The value of such a column is therefore a sum over shares of the matrix
!> (ek_contribution). The kernels that compute the columns also compute the shares, so that a new column of these sections needs
!> no code in this module.
!>
!> With heights held, load and displacement both include the vertical forces that hold the heights. A share C_e of the matrix then
!> becomes Hᵀ C_e H; the sum of these shares is C_held.
module ek_linear_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t
   use ek_attitude, only: attitude_t, wheel_attitude
   use ek_characteristics, only: wheel_characteristics, wheel_characteristics_t, wheel_groups, of_forces_load_held, &
      of_forces_height_held
   use ek_column_list, only: fill_block
   use ek_compliance, only: ask
   use ek_kandc_list, only: kandc_t, start_kandc, choose_kandc
   use ek_kandc_columns, only: observe_kandc
   use ek_loaded_wheels, only: loaded_t, stand_t, load_wheels
   use ek_port_response, only: lock_t, find_lock, keep_locked, load_at_patch, read_at_patch
   use ek_compliance_table, only: compliance_columns, put_compliance
   use ek_table, only: name_length
   use ek_wheel_columns, only: wheel_values
   use ek_wheel_side, only: deck_frame
   implicit none(type, external)
   private
   public :: linear_columns_t, start_linear_columns, choose_linear_columns, find_linear_columns, fill_linear_columns, &
      fill_changed_columns

   integer, parameter :: sections(2) = [of_forces_load_held, of_forces_height_held]
   integer, parameter :: most = 40      !! greatest number of values of a section

   !> The columns of a model, and the data from which their values at a state are computed.
   type :: linear_columns_t
      integer :: used = 0
      character(name_length), allocatable :: names(:)     !! names of all columns
      integer, allocatable :: asked(:)                    !! indices of the columns that are computed
      type(kandc_t) :: kandc                              !! K&C quantities of the state, with its compliance matrix
      integer, allocatable, private :: column(:)          !! index in kandc; columns after these are entries of the matrix
      logical, private :: has_kandc = .false., has_entries = .false.
      type(attitude_t), allocatable, private :: wheels(:)
   end type linear_columns_t

contains

   !> Lists the names of all columns that are linear in the compliance matrix. All columns are requested.
   subroutine start_linear_columns(suspension, self)
      type(suspension_t), intent(in) :: suspension          !! on the rig
      type(linear_columns_t), intent(out) :: self
      character(name_length), allocatable :: entries(:)
      logical, allocatable :: is_wanted(:)
      integer :: b, first

      call start_kandc(suspension, self%kandc)
      allocate (is_wanted(self%kandc%used), source=.false.)
      first = 1
      do b = 1, size(self%kandc%last)
         if (any(sections == self%kandc%section(b))) is_wanted(first:self%kandc%last(b)) = .true.
         first = self%kandc%last(b) + 1
      end do
      self%column = pack([(b, b=1, self%kandc%used)], is_wanted)
      call compliance_columns(suspension, entries)
      self%used = size(self%column) + size(entries)
      allocate (self%names(self%used), self%wheels(size(suspension%wheels)))
      self%names(:size(self%column)) = self%kandc%names(self%column)
      self%names(size(self%column) + 1:) = entries
      deallocate (is_wanted)
      allocate (is_wanted(self%used), source=.true.)
      call choose_linear_columns(self, is_wanted)
   end subroutine start_linear_columns

   !> Restricts the columns that are computed.
   subroutine choose_linear_columns(self, is_wanted)
      type(linear_columns_t), intent(inout) :: self
      logical, intent(in) :: is_wanted(:)                   !! of each column
      logical, allocatable :: of_kandc(:), is_load(:)
      integer :: k, n

      n = size(self%column)
      self%asked = pack([(k, k=1, self%used)], is_wanted)
      self%has_kandc = any(is_wanted(:n))
      self%has_entries = any(is_wanted(n + 1:))
      allocate (of_kandc(self%kandc%used), source=.false.)
      of_kandc(self%column) = is_wanted(:n)
      call choose_kandc(self%kandc, of_kandc)
      self%kandc%is_matrix_wanted = .true.
      allocate (is_load(size(self%kandc%compliance%response, 2)), source=.false.)
      is_load(:6*self%kandc%compliance%wheels) = .true.     ! every share is one of the whole matrix
      call ask(self%kandc%compliance, is_load, .false.)
   end subroutine choose_linear_columns

   !> Computes the compliance matrix and the requested columns at a state.
   subroutine find_linear_columns(suspension, state, inputs, kkt, self, values)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt                     !! work space; on return, with the factors of the state
      type(linear_columns_t), intent(inout) :: self
      real(wp), intent(out) :: values(:)                    !! of the requested columns, in their units
      integer :: k

      do k = 1, size(self%wheels)
         self%wheels(k) = wheel_attitude(suspension, state, k)
      end do
      call observe_kandc(suspension, state, inputs, kkt, self%kandc)
      call fill_linear_columns(suspension, self%kandc%compliance%response(:6*size(self%wheels), :6*size(self%wheels)), self, values)
   end subroutine find_linear_columns

   !> Fills the requested columns for one contribution to the compliance matrix of this state.
   !> Equation (C.15) of docs/theory/compliance.md.
   subroutine fill_linear_columns(suspension, share, self, values)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: share(:, :)                   !! matrix at the wheel centres, SI, global axes
      type(linear_columns_t), intent(in) :: self            !! of find_linear_columns
      real(wp), intent(out) :: values(:)
      type(wheel_characteristics_t) :: is(size(self%wheels))
      real(wp) :: all(self%used), section(most), of_kandc(self%kandc%used)
      real(wp) :: arm(3, size(self%wheels)), frame(size(share, 1))
      integer :: b, k, n

      values = ieee_value(1.0_wp, ieee_quiet_nan)
      if (any(.not. ieee_is_finite(share))) return          ! no compliance at this state
      of_kandc = 0.0_wp
      if (self%has_kandc) then
         if (any(.not. ieee_is_finite(self%kandc%compliance%response(:size(share, 1), :size(share, 2))))) return
         call characterise(suspension, share, self, is)
         section = 0.0_wp
         do k = 1, size(self%kandc%blocks)
            b = self%kandc%blocks(k)
            call wheel_values(self%kandc%section(b), is(self%kandc%item(b)), self%kandc%frame, section)
            call fill_block(self%kandc%column_list_t, b, section, .true., of_kandc)
         end do
      end if
      n = size(self%column)
      all(:n) = of_kandc(self%column)
      if (self%has_entries) then
         do k = 1, size(self%wheels)
            associate (now => self%wheels(self%kandc%compliance%order(k)))
               arm(:, k) = now%at_contact - now%at_centre
            end associate
         end do
         frame = [(deck_frame(suspension), k=1, size(share, 1)/3)]
         k = size(share)
         call put_compliance(share, frame, all(n + 1:n + k))
         call put_compliance(read_at_patch(load_at_patch(share, arm), arm), frame, all(n + k + 1:n + 2*k))
      end if
      values = all(self%asked)
   end subroutine fill_linear_columns

   !> Fills the requested columns for another compliance matrix at this state. Heights are held according to that matrix.
   subroutine fill_changed_columns(suspension, c, self, values)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: c(:, :)                       !! matrix at the wheel centres, SI, global axes
      type(linear_columns_t), intent(in) :: self            !! of find_linear_columns
      real(wp), intent(out) :: values(:)
      type(linear_columns_t) :: changed

      changed = self
      changed%kandc%compliance%response(:size(c, 1), :size(c, 2)) = c
      call fill_linear_columns(suspension, c, changed, values)
   end subroutine fill_changed_columns

   !> Computes the responses of every wheel to forces and torques.
   subroutine characterise(suspension, share, self, is)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: share(:, :)
      type(linear_columns_t), intent(in) :: self
      type(wheel_characteristics_t), intent(inout) :: is(:)
      logical :: is_asked(wheel_groups)
      type(stand_t) :: stand
      integer :: k, at

      is_asked = .false.
      associate (c => self%kandc%compliance%response, order => self%kandc%compliance%order)
         if (self%kandc%is_pair) then
            do k = 1, 2
               is_asked(sections) = self%kandc%is_group_asked(sections, k)
               call respond_held(c(:12, :12), share, self%kandc%stand, k, is_asked, is(k))
            end do
            return
         end if
         do k = 1, size(is)        ! each by itself
            at = 6*(k - 1)
            is_asked(sections) = self%kandc%is_group_asked(sections, k)
            stand%axes(1) = self%wheels(order(k))%axes
            stand%centre(:, 1) = self%wheels(order(k))%at_centre
            stand%arm(:, 1) = self%wheels(order(k))%at_contact - self%wheels(order(k))%at_centre
            call respond_held(c(at + 1:at + 6, at + 1:at + 6), share(at + 1:at + 6, at + 1:at + 6), stand, 1, is_asked, is(k))
         end do
      end associate

   contains

      !> Computes the responses of one wheel, with vertical loads held and, if requested, with the heights of the wheel centres
      !> held.
      subroutine respond_held(c, share, stand, place, is_asked, is)
         real(wp), intent(in) :: c(:, :), share(:, :)
         type(stand_t), intent(in) :: stand
         integer, intent(in) :: place
         logical, intent(in) :: is_asked(:)
         type(wheel_characteristics_t), intent(inout) :: is
         type(loaded_t) :: loaded, held
         type(lock_t) :: lock
         real(wp) :: mirrored(size(c, 2), size(c, 1)), projected(size(c, 1), size(c, 2)), row(size(c, 2))
         integer :: i, n

         n = size(c, 1)
         call find_lock(c, [(6*i - 3, i=1, n/6)], lock)
         call load_wheels(share, stand%arm(:, :n/6), .true., .true., lock, loaded)
         if (is_asked(of_forces_height_held)) then
            mirrored = transpose(c)
            call find_lock(mirrored, [(6*i - 3, i=1, n/6)], lock)
            do i = 1, n
               row = share(i, :)
               call keep_locked(lock, row)
               projected(i, :) = row
            end do
            call find_lock(c, [(6*i - 3, i=1, n/6)], lock)
            call load_wheels(projected, stand%arm(:, :n/6), .true., .true., lock, held)
            loaded%c_held = held%c_held
            loaded%m_held = held%m_held
         end if
         call wheel_characteristics(loaded, stand, place, suspension%axle, is_asked, is)
      end subroutine respond_held

   end subroutine characterise

end module ek_linear_columns
