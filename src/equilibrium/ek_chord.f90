!> Checks of a step across bent laws (a stop comes into contact, a curve gets stiffer): whether its end is on the path, and
!> whether the path does not reverse within the step.
!>
!> The tangents at the ends of such a step disagree with the motion, as the slopes of the laws change on the way. Two checks
!> replace the comparison with the motion:
!>
!> - With every law replaced by its chord, the straight line through its forces at both ends, a and b are equilibria of the
!>   changed model too, and only its geometry is nonlinear. Its tangents must then agree with the motion.
!> - On the way, the slope of each law stays between a minimum and a maximum. N grows with each slope (in the sense of its
!>   quadratic form), and each eigenvalue does too. If N has as many negative eigenvalues with all slopes at their minimum as
!>   with all at their maximum, N is regular for all slopes between: no limit point, however the laws follow each other.
!>
!> The forces at both ends are unchanged, so that only the slopes change: N of the changed model is N plus a dyad per bent law
!> (ek_dyads). No memory is allocated after new_chord.
module ek_chord
   use ek_kinds, only: wp
   use ek_suspension, only: suspension_t
   use ek_measure, only: measure_t, evaluation_t, body_gap, rotation, measure_value, evaluate
   use ek_law, only: look_up_law, find_slopes
   use ek_element, only: element_t, look_up_element, element_slopes, is_linear, bushing_element
   use ek_state, only: state_t, inputs_t
   use ek_kkt, only: kkt_t
   use ek_tangent, only: tangent_t, find_tangent
   use ek_dyads, only: dyads_t, new_dyads, add_dyad, solve_columns, set_changes
   implicit none(type, external)
   private
   public :: chord_t, new_chord, renew_chord, straighten, evaluate_along_chord
   public :: at_a, at_b, least, mean, most

   integer, parameter :: at_a = 1, at_b = 2
   integer, parameter :: least = 1, mean = 2, most = 3

   real(wp), parameter :: bent = 1.0e-2_wp      !! limit, as a share of the largest slope: a smaller change of slope is not a bend

   !> Position of a law in the model: its element and component.
   type :: place_t
      integer :: element = 0, component = 0     !! indices: element; component of a bushing, 0 for other elements
      type(measure_t) :: measure                !! measure on which the law acts
      real(wp) :: offset = 0.0_wp               !! argument of the law = measure − offset [m]
   end type place_t

   !> The laws in a step, one column per law.
   type :: chord_t
      type(place_t), allocatable :: place(:)
      real(wp), allocatable :: value(:, :), force(:, :)    !! (at_a or at_b, law): argument and force at a or b [m, N; rad, N m]
      real(wp), allocatable :: own(:, :)                   !! (at_a or at_b, law): slope at a or b [N/m, N m/rad]
      real(wp), allocatable :: slope(:, :)                 !! (least, mean or most, law): slope between a and b [N/m, N m/rad]
      real(wp), allocatable :: change(:)                   !! change of the slope of each bent law [N/m, N m/rad]
      integer, allocatable :: bent_law(:)                  !! indices of the laws that bend in the step
      integer :: bends = 0                                 !! number of laws that bend
      type(dyads_t) :: dyads
   end type chord_t

contains

   !> The laws of a model, with work space.
   function new_chord(suspension) result(self)
      type(suspension_t), intent(in) :: suspension
      type(chord_t) :: self
      integer :: laws

      laws = count_laws(suspension)
      allocate (self%place(laws))
      call find_places(suspension, self%place)
      allocate (self%bent_law(laws), source=0)
      allocate (self%value(2, laws), self%force(2, laws), self%own(2, laws), self%slope(3, laws), self%change(laws), source=0.0_wp)
      if (laws > 0) self%dyads = new_dyads(suspension%unknowns() + suspension%constraints(), laws)
   end function new_chord

   !> Renews the chords for other numbers of the model, in place unless the number of laws that can bend has changed.
   subroutine renew_chord(suspension, self)
      type(suspension_t), intent(in) :: suspension
      type(chord_t), intent(inout) :: self        !! of new_chord, for the same model

      if (count_laws(suspension) /= size(self%place)) then
         self = new_chord(suspension)
         return
      end if
      call find_places(suspension, self%place)
      self%bends = 0
   end subroutine renew_chord

   !> The number of laws that can bend.
   pure integer function count_laws(suspension) result(laws)
      type(suspension_t), intent(in) :: suspension
      integer :: k, component

      laws = 0
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k), bushing => suspension%elements(k)%bushing)
            if (element%kind /= bushing_element) then
               if (.not. is_linear(element)) laws = laws + 1
               cycle
            end if
            if (.not. bushing%has_curves) cycle
            do component = 1, 6
               if (bushing%laws(component)%has_curve) laws = laws + 1
            end do
         end associate
      end do
   end function count_laws

   !> Lists the laws that can bend: of elements with one measure, and of components of bushings. A component of a bushing acts along
   !> or about an axis of the bushing's marker.
   pure subroutine find_places(suspension, place)
      type(suspension_t), intent(in) :: suspension
      type(place_t), intent(out) :: place(:)     !! of each law that count_laws counts
      integer :: k, component, law

      law = 0
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k), bushing => suspension%elements(k)%bushing)
            if (element%kind /= bushing_element) then
               if (is_linear(element)) cycle
               law = law + 1
               place(law) = place_t(element=k, measure=element%measure)
               cycle
            end if
            if (.not. bushing%has_curves) cycle
            do component = 1, 6
               if (.not. bushing%laws(component)%has_curve) cycle
               law = law + 1
               place(law)%element = k
               place(law)%component = component
               place(law)%measure = element%measure
               place(law)%measure%kind = merge(body_gap, rotation, component <= 3)
               place(law)%measure%u = bushing%axes(:, 1 + mod(component - 1, 3))
               if (component <= 3) place(law)%offset = dot_product(bushing%axes(:, component), bushing%gap0)
            end do
         end associate
      end do
   end subroutine find_places

   !> Replaces every law by its chord between two states. `is_bent`: the slope of a law changes between the states.
   pure subroutine straighten(self, suspension, a, b, is_bent)
      type(chord_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: a, b
      logical, intent(out) :: is_bent
      integer :: k, i, j

      self%bends = 0
      do k = 1, size(self%place)
         associate (place => self%place(k))
            i = place%measure%body_i + 1
            j = place%measure%body_j + 1
            self%value(at_a, k) = measure_value(place%measure, a%poses(i), a%poses(j)) - place%offset
            self%value(at_b, k) = measure_value(place%measure, b%poses(i), b%poses(j)) - place%offset
            call draw(self, k, suspension%elements(place%element), place%component)
         end associate
         if (.not. self%slope(most, k) - self%slope(least, k) > bent*maxval(abs(self%slope(:, k)))) cycle
         self%bends = self%bends + 1
         self%bent_law(self%bends) = k
      end do
      is_bent = self%bends > 0
   end subroutine straighten

   !> Computes the force and slope of a law at both ends, and the least, mean and most slope between the ends.
   pure subroutine draw(self, number, element, component)
      type(chord_t), intent(inout) :: self
      integer, intent(in) :: number                !! index of the law, whose values are set
      type(element_t), intent(in) :: element
      integer, intent(in) :: component             !! of a bushing; 0: the law of the element
      real(wp) :: slope
      integer :: end

      associate (value => self%value(:, number), force => self%force(:, number))
         do end = at_a, at_b
            if (component == 0) then
               call look_up_element(element, value(end), force(end), self%own(end, number))
            else
               call look_up_law(element%bushing%laws(component), value(end), force(end), self%own(end, number))
            end if
         end do
         if (component == 0) then
            call element_slopes(element, value(at_a), value(at_b), self%slope(least, number), self%slope(most, number))
         else
            call find_slopes(element%bushing%laws(component), value(at_a), value(at_b), self%slope(least, number), &
               self%slope(most, number))
         end if
         slope = self%own(at_a, number)
         if (abs(value(at_b) - value(at_a)) > 0.0_wp) slope = (force(at_b) - force(at_a))/(value(at_b) - value(at_a))
      end associate
      ! of nearly equal values the quotient is rounding
      self%slope(mean, number) = min(max(slope, self%slope(least, number)), self%slope(most, number))
   end subroutine draw

   !> Computes the tangent of the changed model at one end, with the factors of N at this end. Determines whether N is regular for
   !> all slopes of the laws in the step.
   !> Equation (K.16) of docs/theory/kkt.md.
   subroutine evaluate_along_chord(self, suspension, work, end, state, inputs, rate, kkt, tangent, is_regular)
      type(chord_t), intent(inout) :: self
      type(suspension_t), intent(in) :: suspension
      type(tangent_t), intent(inout) :: work
      integer, intent(in) :: end                   !! at_a or at_b
      type(state_t), intent(in) :: state           !! at this end
      type(inputs_t), intent(in) :: inputs, rate
      type(kkt_t), intent(inout) :: kkt
      real(wp), intent(out) :: tangent(:)
      logical, intent(out) :: is_regular
      type(evaluation_t) :: evaluation
      integer :: k, slope

      self%dyads%number = 0
      do k = 1, self%bends
         associate (measure => self%place(self%bent_law(k))%measure)
            call evaluate(measure, state%poses(measure%body_i + 1), state%poses(measure%body_j + 1), evaluation)
            call add_dyad(self%dyads, measure%body_i, measure%body_j, evaluation%gradient)
         end associate
      end do
      is_regular = .not. kkt%is_singular
      tangent = 0.0_wp
      if (.not. is_regular) return
      call solve_columns(self%dyads, kkt)
      do slope = least, most
         associate (laws => self%bent_law(:self%bends))
            self%change(:self%bends) = self%slope(slope, laws) - self%own(end, laws)
         end associate
         call set_changes(self%dyads, self%change, kkt%negative)
         is_regular = is_regular .and. self%dyads%negative == kkt%negative
         if (.not. is_regular) return
         if (slope /= mean) cycle
         call find_tangent(work, suspension, state, inputs, rate, kkt, tangent, is_regular, self%dyads)
      end do
   end subroutine evaluate_along_chord

end module ek_chord
