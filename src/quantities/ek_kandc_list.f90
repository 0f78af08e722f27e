!> The K&C quantities that a model defines, as a list of columns, and the data computed for the requested columns: sections of
!> quantities, loads of the compliance matrix, ports that are held.
module ek_kandc_list
   use ek_kinds, only: wp
   use ek_quantity, only: quantity_t, wheel_now, wheel_load, steer_columns => instant_axis, wheel_rates, wheel_bump, wheel_roll, &
      swing_arms, wheel_forces, wheel_jacking, wheel_stiffness, wheel_pitch, axle_rates, axle_now, roll_centres, of_turn, &
      of_steering, wheel_axis, instant_distances, wheel_slopes, axle_geometry, of_rack
   use ek_element, only: element_kinds, measure_spring, is_of_angle
   use ek_suspension, only: suspension_t, driver_row
   use ek_free_wheels, only: is_rigid, has_rates
   use ek_attitude, only: static_toe
   use ek_wheel_side, only: is_axle, prefix_of, design_track, deck_frame
   use ek_compliance, only: compliance_t, new_compliance, ask
   use ek_port_response, only: lock_t
   use ek_loaded_wheels, only: loaded_t, stand_t
   use ek_characteristics, only: wheel_characteristics_t, wheel_groups, of_rates, of_bump, of_roll, of_arms, of_forces_load_held, &
      of_forces_height_held, of_jacking, of_stiffness, of_anti_features
   use ek_axle_characteristics, only: axle_characteristics_t
   use ek_column_list, only: column_list_t, begin_list, add_quantities, add_column, end_block, choose, conditions_of
   use ek_steer_angle, only: steer_of
   use ek_geometry_columns, only: mass_on
   implicit none(type, external)
   private
   public :: kandc_t, list_kandc, start_kandc, choose_kandc, begin_design, same_columns

   ! Sections behind the groups of a wheel's characteristics
   integer, parameter, public :: at_now = wheel_groups + 1, at_load = at_now + 1, at_instant_axis = at_now + 2, &
      at_axle_rates = at_now + 3, at_axle_now = at_now + 4, at_roll_centres = at_now + 5, at_turn = at_now + 6, &
      at_steering = at_now + 7, at_wheel_axis = at_now + 8, at_instant_distances = at_now + 9, at_slopes = at_now + 10, &
      at_axle_geometry = at_now + 11, at_travel_left = at_now + 12, at_motion_ratio = at_now + 13, at_rack = at_now + 14, &
      at_spring = at_now + 15
   integer, parameter :: sections = at_spring

   !> The columns of a model and the work space for their values.
   type, extends(column_list_t) :: kandc_t
      integer :: steer_row = 0                 !! row of Φ of the steering driver, 0: none
      integer, allocatable :: has(:)           !! sum of the conditions of ek_quantity: (k) for wheel k, (0) without a wheel
      real(wp), allocatable :: values(:)       !! values of the columns, in their units; not set for columns that are not requested
      type(compliance_t) :: compliance
      ! what the asked columns need
      logical :: is_asked(sections) = .false.
      logical, allocatable :: is_group_asked(:, :)      !! whether a group is requested: (group of characteristics, wheel)
      logical :: has_wheels = .false., has_patch = .false., has_held = .false.
      logical :: locks_springs = .false., locks_heights = .false.
      integer, allocatable :: heights(:), springs(:)    ! ports of the wheels and of the springs
      ! of the design
      logical :: is_pair = .false., has_turn = .false.
      real(wp) :: frame(3) = 1.0_wp, static(2) = 0.0_wp, tyre_width(2) = 0.0_wp
      real(wp), allocatable :: mass(:)          ! of each wheel in the compliance matrix [kg], 0: not known
      type(stand_t) :: stand
      ! of the state
      real(wp), allocatable :: vertical(:)      ! force of the ground on each wheel [N]
      type(lock_t) :: held_springs, held_heights, held_wheel
      real(wp), allocatable :: moves(:), free_twist(:, :), held_twist(:, :)
      type(loaded_t) :: loaded
      type(wheel_characteristics_t), allocatable :: wheel(:)
      type(axle_characteristics_t) :: axle
   end type kandc_t

contains

   !> Lists all columns that a model defines, and requests all of them.
   subroutine start_kandc(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(out) :: self
      logical, allocatable :: is_wanted(:)

      call list_kandc(suspension, self)
      allocate (is_wanted(self%used), source=.true.)
      call choose_kandc(self, is_wanted)
      call begin_design(suspension, self)
   end subroutine start_kandc

   !> Lists the names of all columns that a model defines: self%names(:self%used). The order is the order of the table: each wheel,
   !> the axle with its steering, the geometry of each wheel, the geometry of the axle, elements, the rack, axial springs.
   !> choose_kandc then marks the requested columns, before any column is filled.
   subroutine list_kandc(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(out) :: self
      integer :: k

      if (suspension%steering%has_steering) self%steer_row = driver_row(suspension, suspension%steering%driver)
      self%compliance = new_compliance(suspension, self%steer_row > 0)
      associate (wheels => self%compliance%wheels, springs => self%compliance%springs)
         allocate (self%has(0:wheels))
         call conditions_of(suspension, self%compliance%order, self%steer_row > 0, self%has)
         call begin_list(self, 256)
         self%lacks_rate = .not. has_rates(suspension)
         self%is_elastic = .not. is_rigid(suspension)
         do k = 1, wheels
            call add_wheel(suspension, k, self)
         end do
         call add_section(axle_rates, at_axle_rates, 0)
         call add_section(axle_now, at_axle_now, 0)
         call add_section(roll_centres, at_roll_centres, 0)
         call add_section(of_turn, at_turn, 0)
         call add_section(of_steering, at_steering, 0)
         do k = 1, wheels
            call add_section(wheel_axis, at_wheel_axis, k)
            call add_section(instant_distances, at_instant_distances, k)
            call add_section(wheel_slopes, at_slopes, k)
         end do
         call add_section(axle_geometry, at_axle_geometry, 0)
         do k = 1, merge(size(suspension%elements), 0, wheels > 0)      ! without a wheel there is no travel
            call add_element(suspension, k, self)
         end do
         call add_section(of_rack, at_rack, 0)
         do k = 1, merge(springs, 0, wheels > 0)
            call add_column(self, suspension%elements(self%compliance%spring(k))%name//'_motion_ratio', .true.)
            call end_block(self, at_spring, k)
         end do
         allocate (self%values(self%used), self%mass(wheels), self%moves(6*wheels + springs), self%free_twist(6, wheels), &
            self%held_twist(6, wheels), self%vertical(wheels), source=0.0_wp)
         allocate (self%wheel(wheels), self%is_group_asked(wheel_groups, wheels))
         self%heights = [(6*k - 3, k=1, wheels)]
         self%springs = [(6*wheels + k, k=1, springs)]
      end associate

   contains

      !> Adds the columns of a section as one block, with the prefix of the wheel.
      subroutine add_section(section, number, wheel)
         type(quantity_t), intent(in) :: section(:)
         integer, intent(in) :: number
         integer, intent(in) :: wheel      ! index in the compliance matrix, 0: none
         character(:), allocatable :: prefix

         prefix = ''
         if (wheel > 0) prefix = prefix_of(suspension, self%compliance%order(wheel))
         call add_quantities(self, section, prefix, self%has(wheel))
         call end_block(self, number, wheel)
      end subroutine add_section

   end subroutine list_kandc

   !> Adds the sections of a wheel that come before the columns of the axle.
   subroutine add_wheel(suspension, place, self)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: place
      type(kandc_t), intent(inout) :: self
      character(:), allocatable :: prefix

      prefix = prefix_of(suspension, self%compliance%order(place))
      call add(wheel_now, at_now)
      call add(wheel_load, at_load)
      call add(steer_columns, at_instant_axis)
      call add(wheel_rates, of_rates)
      call add(wheel_bump, of_bump)
      call add(wheel_roll, of_roll)
      call add(swing_arms, of_arms)
      call add(wheel_forces, of_forces_load_held, 1)
      call add(wheel_forces, of_forces_height_held, 2)
      call add(wheel_jacking, of_jacking)
      call add(wheel_stiffness, of_stiffness)
      call add(wheel_pitch, of_anti_features)

   contains

      !> Adds the columns of a section of this wheel as one block. For a name with '*', `condition` is the condition that the column
      !> name contains: 1 load held, 2 height held.
      subroutine add(section, number, condition)
         type(quantity_t), intent(in) :: section(:)
         integer, intent(in) :: number
         integer, intent(in), optional :: condition
         call add_quantities(self, section, prefix, self%has(place), condition)
         call end_block(self, number, place)
      end subroutine add

   end subroutine add_wheel

   !> Adds the column of a stop (remaining travel), or of a spring on a length measure (motion ratio). Other elements do not have a
   !> column.
   subroutine add_element(suspension, k, self)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(kandc_t), intent(inout) :: self

      associate (element => suspension%elements(k))
         if (element_kinds(element%kind)%has_gap) then
            call add_column(self, element%name//'_travel_left_mm', .true.)
            call end_block(self, at_travel_left, k)
         else if (element%kind == measure_spring .and. .not. is_of_angle(element%measure%kind)) then
            call add_column(self, element%name//'_motion_ratio', .true.)
            call end_block(self, at_motion_ratio, k)
         end if
      end associate
   end subroutine add_element

   !> Restricts the columns that are filled, and with them the sections that are computed and the loads that are solved.
   subroutine choose_kandc(self, is_wanted)
      type(kandc_t), intent(inout) :: self
      logical, intent(in) :: is_wanted(:)        !! of each column
      logical, allocatable :: is_load(:)
      integer :: k, w, b
      logical :: is_held

      call choose(self, is_wanted)
      self%is_asked = .false.
      self%is_group_asked = .false.
      do k = 1, size(self%blocks)
         b = self%blocks(k)
         self%is_asked(self%section(b)) = .true.
         if (self%section(b) <= wheel_groups) self%is_group_asked(self%section(b), self%item(b)) = .true.
      end do
      associate (is => self%is_asked, of => self%compliance)
         self%has_held = is(of_forces_height_held)
         self%has_patch = any(is([of_roll, of_forces_load_held, of_forces_height_held, of_jacking, of_anti_features, &
            at_axle_rates, at_roll_centres]))
         is_held = is(at_steering) .or. is(at_slopes) .and. of%has_drive
         self%locks_springs = is(at_instant_axis) .or. is(at_instant_distances)
         self%locks_heights = self%has_held .or. is_held .or. self%locks_springs .and. of%springs == 0
         self%has_wheels = any(is(:at_turn)) .or. any(is(at_wheel_axis:at_axle_geometry)) .or. is(at_steering)

         allocate (is_load(size(of%response, 2)), source=.false.)
         do w = 1, of%wheels
            ! every column of the matrix needs the vertical loads: rates, motion ratios, the heights that are held
            is_load(6*w - 3) = self%is_matrix_wanted
            ! forces at the patch are forces and moments at the centre
            is_load(6*w - 2:6*w - 1) = self%has_patch .or. is(of_stiffness)
            is_load(6*w - 5:6*w - 4) = any(is([of_forces_load_held, of_forces_height_held, of_jacking, of_anti_features, &
               of_stiffness, at_roll_centres]))
            is_load(6*w) = is_load(6*w - 5) .or. self%locks_springs .and. .not. of%has_drive
         end do
         is_load(6*of%wheels + 1:6*of%wheels + of%springs) = self%locks_springs
         if (of%has_drive) is_load(size(is_load)) = self%locks_springs .or. is_held
         call ask(of, is_load, self%locks_springs .or. is(at_spring))
      end associate
   end subroutine choose_kandc

   !> Sets the values that are equal at all states of a design.
   subroutine begin_design(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(inout) :: self
      integer :: k

      self%is_pair = is_axle(suspension)
      self%frame = deck_frame(suspension)
      self%has_turn = suspension%axle%has_axle .and. suspension%steering%has_steering
      do k = 1, self%compliance%wheels
         associate (wheel => suspension%wheels(self%compliance%order(k)))
            self%mass(k) = 0.0_wp
            if (self%is_asked(at_slopes) .and. wheel%tyre_rate > 0.0_wp) &
               self%mass(k) = mass_on(suspension, self%compliance%order(k))
            if (.not. self%is_pair) cycle
            self%static(k) = steer_of(static_toe(wheel), wheel%side)
            self%tyre_width(k) = wheel%tyre_width
            self%stand%tyre_rate(k) = wheel%tyre_rate
         end associate
      end do
      if (self%is_pair) self%stand%track = design_track(suspension)
   end subroutine begin_design

   !> Whether another design with the same parts has the columns of `self`.
   logical function same_columns(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(kandc_t), intent(in) :: self
      integer :: has(0:size(suspension%wheels))

      same_columns = .false.
      if (self%lacks_rate .eqv. has_rates(suspension)) return
      if (size(has) /= size(self%has)) return
      call conditions_of(suspension, self%compliance%order, self%steer_row > 0, has)
      same_columns = all(has == self%has)
   end function same_columns

end module ek_kandc_list
