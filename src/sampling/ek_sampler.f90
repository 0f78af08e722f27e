!> Samplers: the designs of a study by number. The factor values x(design) are a pure function of sampler and design number.
!>
!> Designs may be computed in any order and by any number of workers. Below, u is a number in (0, 1) that the quantile function of
!> the factor converts to a value (ek_distribution). The number t is a fraction of the range of the factor (`ends_of`, or its list
!> of values).
!>
!> | kind | designs | x |
!> |---|---|---|
!> | grid | product of the levels | all combinations, first factor slowest; t = 0, 1/(l − 1), …, 1 with l levels |
!> | one_at_a_time | 1 + sum of the levels | nominal; then each factor through its levels, the others nominal (tornado) |
!> | list | rows | rows that were given |
!> | latin_hypercube | n | u of each factor once in each of n equal intervals (McKay, Beckman, Conover 1979) |
!> | sobol | n | u = Sobol' point (ek_sobol); unscrambled points are shifted by half a cell |
!> | saltelli | n (k + 2) | A, AB₁ … AB_k, B from Sobol' points of 2k coordinates, for sensitivity indices (ek_sensitivity) |
!> | monte_carlo | n | u independent |
!> | morris | n (k + 1) | n trajectories, on which each factor changes once by p/2 of its p levels (Morris 1991) |
!> | tolerance | n | designs of monte_carlo, in addition to the moments by derivatives (ek_tolerance) |
!>
!> Here k is the number of factors. A factor with `values` has only these values: as levels, or at random each with the same
!> probability. Correlations (ek_copula) apply to latin_hypercube, sobol and monte_carlo. In a latin_hypercube with correlations,
!> the interval of each design is computed once for all designs (ek_rank_order).
!>
!> u and t are identical to the last bit on every machine; x is as exact as the machine's logarithm.
!>
!> To add a kind: add its number and row in ek_sampler_kind, and its case in `count_designs` and in `sample`.
!>
!> A trajectory of Morris' method has k + 1 designs.
module ek_sampler
   use ek_kinds, only: wp, i8
   use ek_contract, only: are_checked, require
   use ek_error, only: error_t, fail, exit_deck
   use ek_normal, only: normal_quantile, normal_probability
   use ek_philox, only: fill_uniforms, uniform
   use ek_permutation, only: permutation_t, new_permutation, image_of, largest_permutation
   use ek_sobol, only: sobol_t, new_sobol, sobol_coordinate
   use ek_distribution, only: quantile, quantile_of_score, ends_of
   use ek_copula, only: copula_t, new_copula, correlate
   use ek_rank_order, only: order_ranks
   use ek_sampler_kind, only: grid_kind, one_at_a_time_kind, list_kind, latin_hypercube_kind, sobol_kind, saltelli_kind, &
      morris_kind
   use ek_sampler_settings, only: factor_t, sampler_settings_t, check_settings, design_stream, permutation_stream, &
      scramble_stream, trajectory_stream
   implicit none(type, external)
   private
   public :: sampler_t, new_sampler, sample, designs_of, factors_of, is_kind, is_ordered, is_shifted, changed_factor, &
      morris_change, trajectory_t, find_trajectory, level_on, factor_changed, change_of_level

   !> The position of a design on its trajectory.
   type :: trajectory_t
      integer(i8) :: seed = 0, number = 0      !! seed of the study; index of the trajectory, from 0
      integer(i8) :: step = 0                  !! number of factors already changed, 0 … k
      integer(i8) :: levels = 2
      type(permutation_t) :: order             !! order in which the factors change
   end type trajectory_t

   type :: sampler_t
      type(sampler_settings_t) :: settings
      type(factor_t), allocatable :: factors(:)
      real(wp), allocatable :: low(:), high(:)               !! range of each factor without values
      integer(i8), allocatable :: levels(:)                  !! number of levels of each factor
      integer(i8) :: designs = 0
      type(permutation_t), allocatable :: permutations(:)    !! latin_hypercube: permutation of the intervals of each factor
      type(sobol_t) :: points
      real(wp) :: shift = 0.0_wp                             !! added to each coordinate of an unscrambled Sobol' point
      type(copula_t) :: copula
      logical :: is_correlated = .false.
      integer, allocatable :: intervals(:, :) !! latin_hypercube: intervals of the correlated factors, see ek_rank_order
      integer, allocatable :: position(:) !! position of each factor in `intervals`; 0: the factor has no correlation
   end type sampler_t

contains

   !> Creates a sampler. Settings that are not legal are an error (exit_deck).
   pure subroutine new_sampler(settings, factors, sampler, error)
      type(sampler_settings_t), intent(in) :: settings
      type(factor_t), intent(in) :: factors(:)
      type(sampler_t), intent(out) :: sampler
      type(error_t), allocatable, intent(out) :: error
      integer :: j, k

      k = size(factors)
      call check_settings(settings, factors, error)
      if (allocated(error)) return
      sampler%settings = settings
      sampler%factors = factors
      allocate (sampler%low(k), sampler%high(k), sampler%levels(k))
      do j = 1, k
         call ends_of(factors(j)%distribution, sampler%low(j), sampler%high(j))
         sampler%levels(j) = settings%levels
         if (allocated(factors(j)%values)) sampler%levels(j) = size(factors(j)%values)
      end do
      call count_designs(sampler, error)
      if (allocated(error)) return
      select case (settings%kind)
      case (latin_hypercube_kind)
         allocate (sampler%permutations(k))
         do j = 1, k
            sampler%permutations(j) = new_permutation(settings%size, settings%seed, permutation_stream, int(j, i8))
         end do
      case (sobol_kind, saltelli_kind)
         if (settings%kind == saltelli_kind) k = 2*k
         if (settings%is_scrambled) then
            call new_sobol(k, sampler%points, settings%seed, scramble_stream)
         else
            call new_sobol(k, sampler%points)
            sampler%shift = shift_of_points(settings%size)
         end if
      end select
      if (allocated(settings%pairs)) sampler%is_correlated = size(settings%pairs, 2) > 0
      if (sampler%is_correlated) call new_copula(size(factors), settings%pairs, settings%correlations, sampler%copula, error)
      if (allocated(error) .or. .not. sampler%is_correlated .or. settings%kind /= latin_hypercube_kind) return
      sampler%position = [(merge(1, 0, any(settings%pairs == j)), j=1, size(factors))]
      call order_ranks(sampler%permutations, sampler%copula, pack([(j, j=1, size(factors))], sampler%position == 1), &
         settings%size, sampler%intervals, error)
      sampler%position = sampler%position*[(sum(sampler%position(:j)), j=1, size(factors))]
   end subroutine new_sampler

   !> The shift of unscrambled Sobol' points: half a cell. The first n points are multiples of 1/p, where p is the power of two not
   !> below n. In the middle of the cells, none of them is at an end of the range of a factor, and their mean is 1/2 if n = p.
   pure real(wp) function shift_of_points(n) result(shift)
      integer(i8), intent(in) :: n                 !! number of points
      real(wp), parameter :: smallest = 2.0_wp**(-33)        ! coordinate of point 0 (ek_sobol)

      shift = 0.5_wp
      do while (0.5_wp/shift < real(n, wp))
         shift = 0.5_wp*shift
      end do
      shift = shift - smallest
   end function shift_of_points

   !> Counts the designs of a sampler. More than 2⁴⁰ designs of a grid are an error.
   pure subroutine count_designs(sampler, error)
      type(sampler_t), intent(inout) :: sampler
      type(error_t), allocatable, intent(out) :: error
      integer(i8) :: k
      integer :: j

      associate (s => sampler, n => sampler%settings%size)
         k = size(s%factors)
         select case (s%settings%kind)
         case (grid_kind)
            s%designs = 1
            do j = 1, int(k)
               if (s%designs <= largest_permutation/s%levels(j)) then
                  s%designs = s%designs*s%levels(j)
               else
                  call fail(error, exit_deck, 'the grid has more than 2**40 designs')
                  return
               end if
            end do
         case (one_at_a_time_kind)
            s%designs = 1 + sum(s%levels)
         case (list_kind)
            s%designs = size(s%settings%rows, 2)
         case (saltelli_kind)
            s%designs = n*(k + 2)
         case (morris_kind)
            s%designs = n*(k + 1)
         case default
            s%designs = n
         end select
      end associate
   end subroutine count_designs

   !> The number of designs of a study. Designs are numbered from 1.
   pure integer(i8) function designs_of(sampler) result(designs)
      type(sampler_t), intent(in) :: sampler

      designs = sampler%designs
   end function designs_of

   !> The number of factors of a sampler.
   pure integer function factors_of(sampler) result(factors)
      type(sampler_t), intent(in) :: sampler

      factors = size(sampler%factors)
   end function factors_of

   !> Whether a sampler is of a kind.
   pure logical function is_kind(sampler, kind)
      type(sampler_t), intent(in) :: sampler
      integer, intent(in) :: kind                  !! one of *_kind

      is_kind = sampler%settings%kind == kind
   end function is_kind

   !> Computes the factor values of a design. No memory is allocated.
   pure subroutine sample(sampler, design, x)
      type(sampler_t), intent(in) :: sampler
      integer(i8), intent(in) :: design            !! 1 … designs_of
      real(wp), intent(out) :: x(:)                !! one value per factor
      type(trajectory_t) :: trajectory
      integer(i8) :: rest
      integer :: j, k

      if (are_checked) call require(size(x) == size(sampler%factors) .and. design >= 1 .and. design <= sampler%designs, &
         'sample: a design of another sampler')
      k = size(x)
      select case (sampler%settings%kind)
      case (grid_kind)
         rest = design - 1
         do j = k, 1, -1
            x(j) = level_of(sampler, j, mod(rest, sampler%levels(j)), sampler%levels(j))
            rest = rest/sampler%levels(j)
         end do
      case (one_at_a_time_kind)
         rest = design - 2
         do j = 1, k
            x(j) = sampler%factors(j)%nominal
            if (rest >= 0 .and. rest < sampler%levels(j)) x(j) = level_of(sampler, j, rest, sampler%levels(j))
            rest = rest - sampler%levels(j)
         end do
      case (list_kind)
         do j = 1, k
            x(j) = sampler%settings%rows(j, design)
         end do
      case (morris_kind)
         call find_trajectory(sampler%settings, k, design, trajectory)
         call fill_uniforms(trajectory%seed, trajectory_stream, trajectory%number, x)
         do j = 1, k
            x(j) = level_of(sampler, j, level_on(trajectory, j, x(j)), trajectory%levels)
         end do
      case default
         call sample_at_random(sampler, design, x)
      end select
   end subroutine sample

   !> Computes the factor values of a design, for the kinds of samplers that start from numbers u in (0, 1).
   pure subroutine sample_at_random(sampler, design, x)
      type(sampler_t), intent(in) :: sampler
      integer(i8), intent(in) :: design
      real(wp), intent(out) :: x(:)
      integer(i8) :: row, block
      integer :: j, k

      k = size(x)
      associate (s => sampler%settings)
         select case (s%kind)
         case (latin_hypercube_kind)
            call fill_uniforms(s%seed, design_stream, design, x)
            do j = 1, k
               x(j) = point_in_interval(interval_of(sampler, j, design), s%size, x(j))
            end do
         case (sobol_kind)
            do j = 1, k
               x(j) = sobol_coordinate(sampler%points, design - 1, j) + sampler%shift
            end do
         case (saltelli_kind)
            row = (design - 1)/(k + 2)
            block = design - 1 - row*(k + 2)             ! 0: A, j: A with factor j from B, k + 1: B
            do j = 1, k
               x(j) = sobol_coordinate(sampler%points, row, merge(j + k, j, block == j .or. block == k + 1)) + sampler%shift
            end do
         case default
            call fill_uniforms(s%seed, design_stream, design, x)
         end select
      end associate
      call take_quantiles(sampler, x)
   end subroutine sample_at_random

   !> The interval, 0 … n − 1, of a factor in a design of a latin hypercube.
   pure integer(i8) function interval_of(sampler, j, design) result(i)
      type(sampler_t), intent(in) :: sampler
      integer, intent(in) :: j
      integer(i8), intent(in) :: design

      if (is_ordered(sampler)) then
         if (sampler%position(j) > 0) then
            i = sampler%intervals(sampler%position(j), design)
            return
         end if
      end if
      i = image_of(sampler%permutations(j), design - 1)
   end function interval_of

   !> The point at a fraction of interval i of n equal intervals of (0, 1). Rounding never moves the point into another interval.
   !>
   !> Equation (D.6) of docs/theory/sampling.md.
   pure real(wp) function point_in_interval(i, n, fraction) result(u)
      integer(i8), intent(in) :: i, n              !! i: 0 … n − 1; n up to 2⁴⁰
      real(wp), intent(in) :: fraction
      real(wp) :: margin

      margin = real(n, wp)*2.0_wp**(-50)
      u = (real(i, wp) + max(margin, min(1.0_wp - margin, fraction)))/real(n, wp)
   end function point_in_interval

   !> Converts numbers u in (0, 1) to values of the factors, in place: x_j = F_j⁻¹(u_j), with correlations x_j = F_j⁻¹(Φ(Σ L_ji
   !> Φ⁻¹(u_i))). The sum is omitted for a latin hypercube, whose intervals are already ordered.
   pure subroutine take_quantiles(sampler, x)
      type(sampler_t), intent(in) :: sampler
      real(wp), intent(inout) :: x(:)
      logical :: is_tied                           ! through scores; an ordered sample is tied by its intervals
      integer :: j

      is_tied = sampler%is_correlated .and. .not. is_ordered(sampler)
      if (is_tied) then
         do j = 1, size(x)
            x(j) = normal_quantile(x(j))
         end do
         call correlate(sampler%copula, x)
      end if
      do j = 1, size(x)
         associate (factor => sampler%factors(j))
            if (allocated(factor%values)) then
               if (is_tied) x(j) = normal_probability(x(j))
               x(j) = factor%values(min(size(factor%values), 1 + int(x(j)*size(factor%values))))
            else if (is_tied) then
               x(j) = quantile_of_score(factor%distribution, x(j))
            else
               x(j) = quantile(factor%distribution, x(j))
            end if
         end associate
      end do
   end subroutine take_quantiles

   !> The value of level i of a factor. Levels are evenly spaced over the range, or taken from the list of values: the nearest
   !> entry, if the number of levels differs from the length of the list.
   pure real(wp) function level_of(sampler, j, i, levels) result(x)
      type(sampler_t), intent(in) :: sampler
      integer, intent(in) :: j
      integer(i8), intent(in) :: i, levels         !! i: 0 … levels − 1
      real(wp) :: t

      t = 0.0_wp
      if (levels > 1) t = real(i, wp)/real(levels - 1, wp)
      if (allocated(sampler%factors(j)%values)) then
         x = sampler%factors(j)%values(1 + nint(t*(size(sampler%factors(j)%values) - 1)))
      else
         x = (1.0_wp - t)*sampler%low(j) + t*sampler%high(j)
      end if
   end function level_of

   !> Whether the correlated factors of a latin hypercube are ordered by ranks (ek_rank_order).
   pure logical function is_ordered(sampler)
      type(sampler_t), intent(in) :: sampler
      is_ordered = allocated(sampler%intervals)
   end function is_ordered

   !> Whether the designs are Sobol' points without scrambling, shifted by half a cell.
   pure logical function is_shifted(sampler)
      type(sampler_t), intent(in) :: sampler
      is_shifted = sampler%shift > 0.0_wp
   end function is_shifted

   !> Index of the only factor that differs: from the nominal design (one_at_a_time), from the previous design (morris), or from A
   !> (saltelli). The result is 0 for the nominal design, the start of a trajectory, A, B, and all designs of other kinds.
   pure integer function changed_factor(sampler, design) result(factor)
      type(sampler_t), intent(in) :: sampler
      integer(i8), intent(in) :: design
      type(trajectory_t) :: trajectory
      integer(i8) :: rest
      integer :: k

      k = size(sampler%factors)
      factor = 0
      select case (sampler%settings%kind)
      case (one_at_a_time_kind)
         rest = design - 1
         do while (rest > 0)
            factor = factor + 1
            rest = rest - sampler%levels(factor)
         end do
      case (saltelli_kind)
         factor = int(mod(design - 1, k + 2_i8))
         if (factor == k + 1) factor = 0
      case (morris_kind)
         call find_trajectory(sampler%settings, k, design, trajectory)
         factor = factor_changed(trajectory, k)
      end select
   end function changed_factor

   !> The change of the factor from the previous design, as a fraction of its range: ±p/(2(p − 1)), with p levels. The change of a
   !> factor with `values` is the step between two of its values, which is not p/2 levels if the number of values differs from p.
   pure real(wp) function morris_change(sampler, design, factor) result(change)
      type(sampler_t), intent(in) :: sampler
      integer(i8), intent(in) :: design            !! index of the design, which is not the first of its trajectory
      integer, intent(in) :: factor                !! changed_factor of this design
      type(trajectory_t) :: trajectory
      real(wp) :: before(size(sampler%factors)), x(size(sampler%factors))

      if (allocated(sampler%factors(factor)%values)) then
         call sample(sampler, design - 1, before)
         call sample(sampler, design, x)
         change = 0.0_wp
         associate (values => sampler%factors(factor)%values)
            if (maxval(values) > minval(values)) change = (x(factor) - before(factor))/(maxval(values) - minval(values))
         end associate
         return
      end if
      call find_trajectory(sampler%settings, size(sampler%factors), design, trajectory)
      change = change_of_level(trajectory, factor)
   end function morris_change

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

end module ek_sampler
