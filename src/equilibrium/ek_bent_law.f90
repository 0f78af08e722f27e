!> Whether the law of an element has a corner between two states: there the path bends.
module ek_bent_law
   use ek_suspension, only: suspension_t
   use ek_measure, only: measure_value
   use ek_law, only: bends_between
   use ek_elastic, only: bushing_view_t, look_bushing
   use ek_state, only: state_t
   implicit none(type, external)
   private
   public :: has_bent_law

contains

   !> A law has a corner between a and b: a stop is met, or a point of a curve where the slope jumps.
   pure logical function has_bent_law(suspension, a, b)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: a, b
      type(bushing_view_t) :: from, to
      integer :: k, axis, i, j

      has_bent_law = .true.
      do k = 1, size(suspension%springs)
         associate (spring => suspension%springs(k))
            if (.not. spring%has_law) cycle
            i = spring%measure%body_i + 1
            j = spring%measure%body_j + 1
            if (bends_between(spring%law, measure_value(spring%measure, a%poses(i), a%poses(j)), &
               measure_value(spring%measure, b%poses(i), b%poses(j)))) return
         end associate
      end do
      do k = 1, size(suspension%bushings)
         associate (bushing => suspension%bushings(k))
            if (.not. bushing%has_curves) cycle
            call look_bushing(bushing, a%poses(bushing%body_i + 1), a%poses(bushing%body_j + 1), from)
            call look_bushing(bushing, b%poses(bushing%body_i + 1), b%poses(bushing%body_j + 1), to)
            do axis = 1, 3
               if (bushing%laws(axis)%has_curve) then
                  if (bends_between(bushing%laws(axis), dot_product(bushing%axes(:, axis), from%gap), &
                     dot_product(bushing%axes(:, axis), to%gap))) return
               end if
               if (bushing%laws(axis + 3)%has_curve) then
                  if (bends_between(bushing%laws(axis + 3), dot_product(bushing%axes(:, axis), from%turn%theta), &
                     dot_product(bushing%axes(:, axis), to%turn%theta))) return
               end if
            end do
         end associate
      end do
      has_bent_law = .false.
   end function has_bent_law

end module ek_bent_law
