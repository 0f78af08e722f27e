!> What a test reads off a state: constraints, wheel attitude, forces.
module ek_reading
   use ek_kinds, only: wp, degree, millimetre
   use ek_elastic, only: bushing_evaluation_t, evaluate_bushing
   use ek_element, only: element_t
   use ek_element_force, only: spring_tension
   use ek_kkt, only: kkt_t, assemble, residual_only
   use ek_measure, only: measure_value
   use ek_differences, only: measure_gradient
   use ek_relative_rotation, only: pose_t
   use ek_path, only: path_t
   use ek_state, only: state_t, inputs_t, design_state, unpack_state
   use ek_suspension, only: suspension_t
   implicit none(type, external)
   private
   public :: phi, phi_gradient, attitude_t, attitude, state_of, joint_force, bushing_force, tension, closure
   public :: load_demand, row_demand

   !> Where a left wheel is.
   type :: attitude_t
      real(wp) :: centre(3) = 0.0_wp      !! displacement of the wheel centre [mm]
      real(wp) :: contact(3) = 0.0_wp     !! of the contact point, carried along by the wheel carrier [mm]
      real(wp) :: toe = 0.0_wp            !! atan2(−s_x, −s_y) of the spin axis s, toe-in positive [deg]
      real(wp) :: camber = 0.0_wp         !! asin(−s_z), positive when the top leans out [deg]
   end type attitude_t

contains

   !> Φ(q) less its design value, for every row.
   function phi(suspension, poses) result(values)
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses(0:)    !! chassis first
      real(wp) :: values(size(suspension%rows))
      integer :: k, t

      do k = 1, size(values)
         values(k) = -suspension%rows(k)%target
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               values(k) = values(k) + term%coefficient*measure_value(term%measure, poses(term%measure%body_i), &
                  poses(term%measure%body_j))
            end associate
         end do
      end do
   end function phi

   !> Φq, six columns a body.
   function phi_gradient(suspension, poses) result(gradient)
      type(suspension_t), intent(in) :: suspension
      type(pose_t), intent(in) :: poses(0:)
      real(wp) :: gradient(size(suspension%rows), 6*size(suspension%bodies)), g(12)
      integer :: k, t, at

      gradient = 0.0_wp
      do k = 1, size(suspension%rows)
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (term => suspension%terms(t))
               g = term%coefficient*measure_gradient(term%measure, poses(term%measure%body_i), poses(term%measure%body_j))
               at = 6*(term%measure%body_i - 1)
               if (at >= 0) gradient(k, at + 1:at + 6) = gradient(k, at + 1:at + 6) + g(1:6)
               at = 6*(term%measure%body_j - 1)
               if (at >= 0) gradient(k, at + 1:at + 6) = gradient(k, at + 1:at + 6) + g(7:12)
            end associate
         end do
      end do
   end function phi_gradient

   !> State number k of a path.
   function state_of(suspension, path, k) result(state)
      type(suspension_t), intent(in) :: suspension
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(state_t) :: state
      state = design_state(suspension)
      call unpack_state(path%packed(:, k), state)
   end function state_of

   !> Attitude of the first wheel at state number k of a path.
   type(attitude_t) function attitude(suspension, path, k)
      type(suspension_t), intent(in) :: suspension
      type(path_t), intent(in) :: path
      integer, intent(in) :: k
      type(state_t) :: state
      real(wp) :: spin(3)

      state = state_of(suspension, path, k)
      associate (w => suspension%wheels(1), pose => state%poses(suspension%wheels(1)%body + 1), &
            origin => suspension%bodies(suspension%wheels(1)%body)%origin)
         attitude%centre = (pose%r + matmul(pose%a, w%centre) - origin - w%centre)/millimetre
         attitude%contact = (pose%r + matmul(pose%a, w%contact) - origin - w%contact)/millimetre
         spin = matmul(pose%a, w%spin)
         attitude%toe = atan2(-spin(1), -spin(2))/degree
         attitude%camber = asin(-spin(3))/degree
      end associate
   end function attitude

   !> Force of a joint on its body_j, global axes [N]: −Σ λ_k ∂φ_k/∂r_j.
   function joint_force(suspension, state, joint) result(force)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: joint
      real(wp) :: force(3), gradient(12)
      integer :: k, t

      force = 0.0_wp
      do k = suspension%joints(joint)%first_row, suspension%joints(joint)%first_row + suspension%joints(joint)%rows - 1
         do t = suspension%rows(k)%first, suspension%rows(k)%first + suspension%rows(k)%terms - 1
            associate (m => suspension%terms(t)%measure)
               gradient = suspension%terms(t)%coefficient* &
                  measure_gradient(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
            end associate
            force = force - state%reaction(k)*gradient(7:9)
         end do
      end do
   end function joint_force

   !> Force of a bushing on its body_j, axes of its marker on body_i [N]: preload − k·gap.
   function bushing_force(element, state) result(force)
      type(element_t), intent(in) :: element
      type(state_t), intent(in) :: state
      real(wp) :: force(3)
      type(bushing_evaluation_t) :: evaluation

      associate (b => element%bushing, m => element%measure)
         call evaluate_bushing(b, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
         force = b%preload_force - b%kt*matmul(transpose(b%axes), evaluation%gap)
      end associate
   end function bushing_force

   !> Tension of a spring [N].
   real(wp) function tension(suspension, state, spring)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: spring
      real(wp) :: slope

      associate (s => suspension%elements(spring))
         call spring_tension(s, measure_value(s%measure, state%poses(s%measure%body_i + 1), &
            state%poses(s%measure%body_j + 1)), tension, slope)
      end associate
   end function tension

   !> One load, scaled.
   pure type(inputs_t) function load_demand(load, factor) result(inputs)
      integer, intent(in) :: load
      real(wp), intent(in) :: factor
      inputs%loads = 1
      inputs%load(1) = load
      inputs%factor(1) = factor
   end function load_demand

   !> One row, driven.
   pure type(inputs_t) function row_demand(row, change) result(inputs)
      integer, intent(in) :: row
      real(wp), intent(in) :: change
      inputs%rows = 1
      inputs%row(1) = row
      inputs%change(1) = change
   end function row_demand

   !> |Φ(q) − c| of (31) at a state under a demand [SI].
   real(wp) function closure(suspension, state, inputs, kkt)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(inputs_t), intent(in) :: inputs
      type(kkt_t), intent(inout) :: kkt
      call assemble(suspension, state, inputs, residual_only, kkt)
      closure = norm2(kkt%values)
   end function closure

end module ek_reading
