!> Trajectories of Morris' method (Morris 1991): k + 1 designs each, for k factors. On a trajectory, every factor changes once, by
!> p/2 of its p levels.
module ek_trajectory
   use ek_kinds, only: wp, i8
   use ek_philox, only: uniform
   use ek_permutation, only: permutation_t, new_permutation, image_of
   use ek_sampler_settings, only: sampler_settings_t, permutation_stream, trajectory_stream
   implicit none(type, external)
   private
   public :: trajectory_t, find_trajectory, level_on, factor_changed, change_of_level

   !> The position of a design on its trajectory.
   type :: trajectory_t
      integer(i8) :: seed = 0, number = 0      !! seed of the study; index of the trajectory, from 0
      integer(i8) :: step = 0                  !! number of factors already changed, 0 … k
      integer(i8) :: levels = 2
      type(permutation_t) :: order             !! order in which the factors change
   end type trajectory_t

contains

   !> Finds the trajectory that contains a design, and the step of the design on the trajectory.
   pure subroutine find_trajectory(settings, factors, design, trajectory)
      type(sampler_settings_t), intent(in) :: settings
      integer, intent(in) :: factors               !! k, number of factors
      integer(i8), intent(in) :: design            !! index of the design, from 1
      type(trajectory_t), intent(out) :: trajectory
      integer(i8) :: k

      k = factors
      trajectory%seed = settings%seed
      trajectory%levels = settings%levels
      trajectory%number = (design - 1)/(k + 1)
      trajectory%step = design - 1 - trajectory%number*(k + 1)
      trajectory%order = new_permutation(k, trajectory%seed, permutation_stream, trajectory%number)
   end subroutine find_trajectory

   !> The step, 1 … k, at which a trajectory changes a factor.
   pure integer(i8) function step_of(trajectory, factor) result(step)
      type(trajectory_t), intent(in) :: trajectory
      integer, intent(in) :: factor

      step = 1 + image_of(trajectory%order, int(factor - 1, i8))
   end function step_of

   !> The level of a factor, 0 … p − 1. The first level is random. From the step of the factor on, the level is p/2 higher, or p/2
   !> lower if p − 1 would be exceeded.
   pure integer(i8) function level_on(trajectory, factor, u) result(level)
      type(trajectory_t), intent(in) :: trajectory
      integer, intent(in) :: factor
      real(wp), intent(in) :: u                !! random number in (0, 1) of the factor on this trajectory

      associate (t => trajectory)
         level = min(int(u*t%levels, i8), t%levels - 1)
         if (t%step >= step_of(t, factor)) level = mod(level + t%levels/2, t%levels)
      end associate
   end function level_on

   !> Index of the only factor that differs from the previous design; 0 at the start of a trajectory.
   pure integer function factor_changed(trajectory, factors) result(factor)
      type(trajectory_t), intent(in) :: trajectory
      integer, intent(in) :: factors               !! k, number of factors

      factor = 0
      if (trajectory%step == 0) return
      do factor = 1, factors - 1
         if (step_of(trajectory, factor) == trajectory%step) return
      end do
   end function factor_changed

   !> The change of a factor at its step, as a fraction of its range: ±p/(2(p − 1)), with p levels.
   pure real(wp) function change_of_level(trajectory, factor) result(change)
      type(trajectory_t), intent(in) :: trajectory     !! trajectory at or after the step of the factor
      integer, intent(in) :: factor
      integer(i8) :: level

      level = level_on(trajectory, factor, uniform(trajectory%seed, trajectory_stream, trajectory%number, factor))
      level = 2*level - (trajectory%levels - 1)    ! above the middle after a step upwards
      change = sign(real(trajectory%levels/2, wp)/real(trajectory%levels - 1, wp), real(level, wp))
   end function change_of_level

end module ek_trajectory
