!> Appends joints, drivers of the rig and weights to a suspension whose lists are allocated.
module ek_assembly
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, global_gap
   use ek_joint, only: joint_t, row_t, term_t, joint_table, joint_kinds
   use ek_suspension, only: suspension_t, load_t
   implicit none(type, external)
   private
   public :: append_joint, add_travel_driver, add_height_driver, add_gravity

contains

   !> Appends a joint with its terms; terms_of_row gives the number of terms in each row.
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

   !> Adds a driver of the height of a wheel centre relative to the vehicle body, joint name 'wheel_travel', to a completed
   !> model. Its value is the wheel travel [m].
   pure subroutine add_travel_driver(self, wheel)
      type(suspension_t), intent(inout) :: self
      integer, intent(in) :: wheel
      call add_height_driver(self, 'wheel_travel', self%wheels(wheel)%where, [wheel], [1.0_wp], .false.)
   end subroutine add_travel_driver

   !> Adds a driver of Σ sign × height relative to the vehicle body, of wheel centres or contact patches, to a completed model.
   !> Its value is the change from design [m]. It belongs to the rig, not to the suspension.
   !> With tyre rates given, the road is driven: the tyres deflect under the loads at the patches, so that
   !> Σ sign × height = value + λ Σ sign²/rate.
   pure subroutine add_height_driver(self, name, where, wheels, signs, is_at_patch, tyre_rate)
      type(suspension_t), intent(inout) :: self
      character(*), intent(in) :: name, where
      integer, intent(in) :: wheels(:)
      real(wp), intent(in) :: signs(:)         !! one per wheel
      logical, intent(in) :: is_at_patch
      real(wp), intent(in), optional :: tyre_rate(:)   !! of each wheel, above 0 [N/m]
      type(term_t) :: terms(size(wheels))
      real(wp) :: arm(3)
      integer :: k

      do k = 1, size(wheels)
         associate (w => self%wheels(wheels(k)))
            arm = w%centre
            if (is_at_patch) arm = w%contact
            terms(k)%measure = measure_t(kind=global_gap, body_i=0, body_j=w%body, u=[0.0_wp, 0.0_wp, 1.0_wp], &
               arm_i=self%bodies(w%body)%origin + arm, arm_j=arm)
            terms(k)%coefficient = signs(k)
         end associate
      end do
      call append_joint(self, name, where, 'driver', terms, [size(terms)])
      if (present(tyre_rate)) self%rows(size(self%rows))%compliance = sum(signs**2/tyre_rate)
      self%joints(size(self%joints))%is_rig = .true.
   end subroutine add_height_driver

   !> Adds the weight of every body with a mass as a constant load; `realise` sets its point and force.
   !>
   !> Its name contains blanks, so that it cannot coincide with a name in the deck.
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

end module ek_assembly
