!> The input of a sampler from a study: its factors and settings.
module ek_sampler_settings
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, quoted
   use ek_sobol, only: largest_dimension, largest_index
   use ek_distribution, only: distribution_t
   use ek_sampler_kind, only: sampler_kind_t, sampler_kinds, grid_kind, list_kind, sobol_kind, saltelli_kind, morris_kind
   implicit none(type, external)
   private
   public :: factor_t, sampler_settings_t, check_settings, seed_text

   ! what one seed is used for (ek_philox)
   integer, parameter, public :: design_stream = 0, permutation_stream = 1, scramble_stream = 2, trajectory_stream = 3

   !> A factor: one number, or a group of numbers that change together.
   type :: factor_t
      type(distribution_t) :: distribution
      real(wp) :: nominal = 0.0_wp             !! nominal value for one_at_a_time: from the study; otherwise the deck's value (0 for
                                               !! delta, 1 for scale); the mean if the paths have different values
      real(wp), allocatable :: values(:)       !! if allocated, the only values; `distribution` is then not used
   end type factor_t

   type :: sampler_settings_t
      integer :: kind = grid_kind
      integer(i8) :: size = 0                  !! n: number of designs, base points or trajectories
      integer :: levels = 2 !! number of levels of a factor without values, evenly spaced over its range; an even number for morris
      integer(i8) :: seed = 1
      logical :: is_scrambled = .true.         !! sobol, saltelli: the points are scrambled by the seed
      real(wp), allocatable :: rows(:, :)      !! (factor, design): the designs of a list
      integer, allocatable :: pairs(:, :)      !! (2, m): indices of two factors
      real(wp), allocatable :: correlations(:) !! (m): correlation of each pair
   end type sampler_settings_t

contains

   !> The seed of a sampler as a string.
   pure function seed_text(settings) result(text)
      type(sampler_settings_t), intent(in) :: settings
      character(:), allocatable :: text
      character(20) :: buffer

      write (buffer, '(i0)') settings%seed
      text = trim(buffer)
   end function seed_text

   !> Checks the settings of a sampler and its lists of values. Settings that the kind does not allow are errors.
   pure subroutine check_settings(settings, factors, error)
      type(sampler_settings_t), intent(in) :: settings
      type(factor_t), intent(in) :: factors(:)
      type(error_t), allocatable, intent(out) :: error
      type(sampler_kind_t) :: kind
      integer :: j, dimensions

      if (settings%kind < 1 .or. settings%kind > size(sampler_kinds)) then
         call fail(error, exit_deck, 'unknown kind of sampler '//str(settings%kind))
         return
      end if
      if (size(factors) == 0) call fail(error, exit_deck, 'the study has no factor')
      do j = 1, size(factors)
         if (.not. allocated(factors(j)%values)) cycle
         if (size(factors(j)%values) == 0) call fail(error, exit_deck, 'factor '//str(j)//' has an empty list of values')
      end do
      if (allocated(error)) return
      kind = sampler_kinds(settings%kind)
      if (kind%has_size .and. (settings%size < 1 .or. settings%size > largest_index)) then
         call fail(error, exit_deck, quoted(kind%name)//' requires a number of samples between 1 and 2**32 - 1')
      else if (kind%has_levels .and. settings%levels < 2) then
         call fail(error, exit_deck, quoted(kind%name)//' requires at least 2 levels, found '//str(settings%levels))
      else if (settings%kind == morris_kind .and. mod(settings%levels, 2) /= 0) then
         call fail(error, exit_deck, '''morris'' requires an even number of levels, found '//str(settings%levels))
      end if
      if (allocated(error)) return
      if (allocated(settings%correlations) .and. .not. kind%has_correlations) then
         if (size(settings%correlations) > 0) call fail(error, exit_deck, quoted(kind%name)// &
            ' requires independent factors, found correlations')
      end if
      select case (settings%kind)
      case (list_kind)
         if (.not. allocated(settings%rows)) then
            call fail(error, exit_deck, 'the list of designs is missing')
         else if (size(settings%rows, 1) /= size(factors)) then
            call fail(error, exit_deck, 'the list of designs has '//str(size(settings%rows, 1))//' columns for '// &
               str(size(factors))//' factors')
         end if
      case (sobol_kind, saltelli_kind)
         dimensions = merge(2, 1, settings%kind == saltelli_kind)*size(factors)
         if (dimensions > largest_dimension) call fail(error, exit_deck, quoted(kind%name)//' requires '//str(dimensions)// &
            ' coordinates for '//str(size(factors))//' factors; the limit is '//str(largest_dimension))
      end select
   end subroutine check_settings

end module ek_sampler_settings
