!> How sharply the laws of a model bend between two states: there the path bends.
module ek_bent_law
   use ek_suspension, only: suspension_t
   use ek_measure, only: measure_value
   use ek_law, only: bend_between, no_bend
   use ek_elastic, only: bushing_view_t, look_bushing
   use ek_state, only: state_t
   implicit none(type, external)
   private
   public :: sharpest_bend

contains

   !> The sharpest bend of a law between a and b.
   pure integer function sharpest_bend(suspension, a, b) result(bend)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: a, b
      type(bushing_view_t) :: from, to
      integer :: k, axis, i, j

      bend = no_bend
      do k = 1, size(suspension%elements)
         associate (element => suspension%elements(k), bushing => suspension%elements(k)%bushing)
            i = element%measure%body_i + 1
            j = element%measure%body_j + 1
            if (element%has_law) bend = max(bend, bend_between(element%law, &
               measure_value(element%measure, a%poses(i), a%poses(j)), measure_value(element%measure, b%poses(i), b%poses(j))))
            if (.not. bushing%has_curves) cycle
            call look_bushing(bushing, a%poses(i), a%poses(j), from)
            call look_bushing(bushing, b%poses(i), b%poses(j), to)
            do axis = 1, 3
               if (bushing%laws(axis)%has_curve) bend = max(bend, bend_between(bushing%laws(axis), &
                  dot_product(bushing%axes(:, axis), from%gap), dot_product(bushing%axes(:, axis), to%gap)))
               if (bushing%laws(axis + 3)%has_curve) bend = max(bend, bend_between(bushing%laws(axis + 3), &
                  dot_product(bushing%axes(:, axis), from%turn%theta), dot_product(bushing%axes(:, axis), to%turn%theta)))
            end do
         end associate
      end do
   end function sharpest_bend

end module ek_bent_law
