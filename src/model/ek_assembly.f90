!> Appends joints and weights to a suspension whose lists are allocated.
module ek_assembly
   use ek_kinds, only: wp
   use ek_joint, only: joint_t, row_t, term_t, joint_table, joint_kinds
   use ek_suspension, only: suspension_t, load_t
   implicit none(type, external)
   private
   public :: append_joint, add_gravity, add_start_loads

contains

   !> Appends a joint with its terms. terms_of_row gives the number of terms of each row.
   pure subroutine append_joint(self, name, where, kind, terms, terms_of_row)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where, kind
      type(term_t), intent(in) :: terms(:)
      integer, intent(in) :: terms_of_row(:)
      type(joint_t) :: joint
      type(row_t) :: row
      integer :: k

      joint%name = name
      joint%where = where
      joint%kind = kind
      joint%number = findloc(joint_kinds, kind, dim=1)
      joint%body_i = terms(1)%measure%body_i
      joint%body_j = terms(1)%measure%body_j
      joint%arm_j = terms(1)%measure%arm_j
      joint%is_of_measures = joint_table(joint%number)%is_of_measures
      joint%first_row = size(self%rows) + 1
      joint%rows = size(terms_of_row)
      row%first = size(self%terms) + 1
      row%joint = size(self%joints) + 1
      row%is_driver = kind == 'driver'
      do k = 1, size(terms_of_row)
         row%terms = terms_of_row(k)
         self%rows = [self%rows, row]
         row%first = row%first + row%terms
      end do
      self%terms = [self%terms, terms]
      self%joints = [self%joints, joint]
   end subroutine append_joint

   !> Adds the weight of every body with a mass as a constant load; `realise` sets its point and force.
   !>
   !> The name of the load contains blanks, so that it cannot coincide with a name in the deck.
   pure subroutine add_gravity(self)
      type(suspension_t), intent(inout) :: self
      type(load_t) :: load
      integer :: k

      if (.not. self%gravity > 0.0_wp) return
      do k = 1, size(self%bodies)
         if (.not. self%bodies(k)%mass > 0.0_wp) cycle
         load%name = 'weight of '//self%bodies(k)%name
         load%where = self%bodies(k)%where
         load%body = k
         load%is_weight = .true.
         self%loads = [self%loads, load]
      end do
   end subroutine add_gravity

   !> Adds the constant vertical load that holds each wheel in the start state (ek_start). `find_start` sets the force; before, it
   !> is 0.
   pure subroutine add_start_loads(self)
      type(suspension_t), intent(inout) :: self
      type(load_t) :: load
      integer :: k

      do k = 1, size(self%wheels)
         load%name = 'rig_start_'//self%wheels(k)%name
         load%where = self%wheels(k)%where
         load%body = self%wheels(k)%body
         load%start_of = k
         load%wheel = merge(k, 0, self%wheels(k)%has_crown)
         self%loads = [self%loads, load]
      end do
   end subroutine add_start_loads

end module ek_assembly
