!> The kinds of samplers: their names in a study and the keys that each kind uses. ek_sampler describes and computes the designs of
!> each kind.
module ek_sampler_kind
   implicit none(type, external)
   private
   public :: sampler_kind_t, sampler_kinds
   public :: grid_kind, one_at_a_time_kind, list_kind, latin_hypercube_kind, sobol_kind, saltelli_kind, monte_carlo_kind
   public :: morris_kind, tolerance_kind

   integer, parameter :: grid_kind = 1, one_at_a_time_kind = 2, list_kind = 3, latin_hypercube_kind = 4, sobol_kind = 5, &
      saltelli_kind = 6, monte_carlo_kind = 7, morris_kind = 8, tolerance_kind = 9

   !> A kind of sampler, and the settings that a study may give for this kind.
   type :: sampler_kind_t
      character(15) :: name
      logical :: has_size          !! n: number of designs, base points or trajectories
      logical :: has_levels        !! number of levels of a factor without values
      logical :: has_seed
      logical :: has_scrambling    !! whether the seed may scramble the points
      logical :: has_correlations
   end type sampler_kind_t

   type(sampler_kind_t), parameter :: sampler_kinds(*) = [ &
      sampler_kind_t('grid', .false., .true., .false., .false., .false.), &
      sampler_kind_t('one_at_a_time', .false., .true., .false., .false., .false.), &
      sampler_kind_t('list', .false., .false., .false., .false., .false.), &
      sampler_kind_t('latin_hypercube', .true., .false., .true., .false., .true.), &
      sampler_kind_t('sobol', .true., .false., .true., .true., .true.), &
      sampler_kind_t('saltelli', .true., .false., .true., .true., .false.), &
      sampler_kind_t('monte_carlo', .true., .false., .true., .false., .true.), &
      sampler_kind_t('morris', .true., .true., .true., .false., .false.), &
      sampler_kind_t('tolerance', .true., .false., .true., .false., .false.)]

end module ek_sampler_kind
