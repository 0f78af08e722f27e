!> A study: its factors, responses and settings, as the study file gives them (ek_study_reader).
module ek_study
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, quoted
   use ek_checksum, only: checksum_t
   use ek_group, only: word_length, note_length
   use ek_quantity, only: name_length
   use ek_distribution, only: new_distribution, from_tolerance, truncate, mean_of, uniform_kind, &
      triangular_kind
   use ek_sampler_kind, only: sampler_kinds, list_kind, tolerance_kind
   use ek_sampler_settings, only: factor_t, sampler_settings_t
   implicit none(type, external)
   private
   public :: study_t, study_factor_t, response_t, step_size_kind, kind_names, change_names, by_value, by_delta, by_scale, by_part
   public :: define_factor, is_given, not_given, surplus_factors

   ! The paths of each factor are compared with all numbers and factors: 5000 factors take some 20 s before the first design
   integer, parameter, public :: max_factors = 5000              !! largest number of factors of a study or fit
   ! A tolerance study has derivatives for each pair of factors: 1000 factors take a minute, and the time grows with the cube
   integer, parameter :: max_tolerance_factors = 2000            !! largest number of factors of a tolerance study

   ! how a factor changes a number of the deck
   integer, parameter :: by_value = 1       !! the factor replaces the number of the deck
   integer, parameter :: by_delta = 2       !! the factor is added to the number of the deck
   integer, parameter :: by_scale = 3       !! the factor multiplies the number of the deck
   integer, parameter :: by_part = 4        !! the factor is a deviation of single parts; ek_part_factor makes it one by value
   character(*), parameter :: change_names(4) = [character(8) :: 'absolute', 'delta', 'scale', 'part']

   ! the kinds: those of the samplers, and two names of this module
   integer, parameter :: step_size_kind = size(sampler_kinds) + 1       !! a study of this kind varies the solution, not the deck
   character(*), parameter :: kind_names(step_size_kind + 1) = [character(15) :: sampler_kinds%name, 'step_size', 'sweep']

   !> A factor: numbers of the deck that change together, and the range of the change in units of the deck.
   type :: study_factor_t
      character(:), allocatable :: name
      character(note_length), allocatable :: paths(:)      !! paths of the factor, as in --set
      logical :: is_each = .false.                         !! every number of the paths becomes a separate factor, see ek_study_each
      logical :: is_of_pattern = .false.                   !! the factor is one of several numbers of a path with *
      integer :: change = by_value
      character(word_length), allocatable :: bodies(:)     !! by_part: the parts that deviate; of size 0 if not given
      integer :: distribution = uniform_kind
      real(wp) :: lower, upper, nominal, tolerance, deviation    !! NaN if not given
      real(wp), allocatable :: values(:)                   !! if allocated, the only values of the factor
      character(:), allocatable :: where                   !! 'file:line', for messages
   end type study_factor_t

   !> A number read from the table of a case, or the difference of two such numbers.
   type :: response_t
      character(:), allocatable :: name
      character(:), allocatable :: column         !! column heading; gradient: name of the gradient
      character(:), allocatable :: case           !! name of the case; '': the case of the study
      character(:), allocatable :: of             !! kind of the response, one of of_names
      character(:), allocatable :: side           !! gradient: 'left' or 'right'; '': the left wheel, or a gradient of the axle
      real(wp) :: at = 0.0_wp !! swept value of the case at which the column is read (value) or the window is centred (slope)
      character(:), allocatable :: over           !! column over which the slope is taken; '': the wheel travel
      real(wp) :: window = 15.0_wp !! half width of the window of a slope, unit of `over`; gradient: 0 for the window of the report
      logical :: has_window = .true.              !! the file gives the window; otherwise it ends where the range of the case ends
      character(:), allocatable :: file           !! rms: CSV file of the curve from which deviations are computed
      real(wp) :: lower = -huge(1.0_wp), upper = huge(1.0_wp)      !! limits for a design; ∓huge if not given
      character(word_length) :: names(2) = ''     !! difference: names of two preceding responses, first minus second
      integer :: less(2) = 0                      !! difference: indices of these two responses
      character(:), allocatable :: where          !! 'file:line', for messages
   end type response_t

   !> The kinds of a response: values of key `of`.
   character(*), parameter, public :: of_names(8) = [character(10) :: 'value', 'slope', 'span', 'min', 'max', 'rms', &
      'gradient', 'difference']

   !> The settings of a study, with its factors and responses.
   type :: study_t
      character(:), allocatable :: name, title, deck, case, plot
      integer :: kind = step_size_kind
      character(10) :: definitions = ''           !! other program whose columns the responses may name; '': none
      character(:), allocatable :: end            !! step_size: the end of the case to be examined, 'from' or 'to'
      character(word_length), allocatable :: methods(:)
      character(name_length), allocatable :: columns(:)
      integer, allocatable :: increments(:)
      type(study_factor_t), allocatable :: factors(:)
      type(response_t), allocatable :: responses(:)
      type(sampler_settings_t) :: settings        !! settings of the sampler, without the rows of a list
      character(:), allocatable :: list           !! CSV file of the designs
      integer :: chunk = 0 !! number of designs that are computed, stored and resumed together; 0: chosen by the engine
      character(:), allocatable :: format         !! 'netcdf', 'csv', or '': NetCDF for many designs, if the helper program exists
      character(:), allocatable :: where          !! 'file:line' of the &study, for messages
      type(checksum_t) :: sum                     !! checksum of the file without titles and notes
   end type study_t

contains

   !> A message on a study with more factors than its kind can take; '' otherwise.
   pure function surplus_factors(study) result(message)
      type(study_t), intent(in) :: study
      character(:), allocatable :: message
      integer :: most

      message = ''
      if (study%kind == 0) return
      most = max_factors
      if (study%kind == tolerance_kind) most = max_tolerance_factors
      if (size(study%factors) > most) message = 'a study of kind '//quoted(trim(kind_names(study%kind)))//' has at most '// &
         str(most)//' factors, found '//str(size(study%factors))//'; divide them among several studies'
   end function surplus_factors

   !> NaN, which marks a number that the file does not give.
   pure real(wp) function not_given()
      not_given = ieee_value(1.0_wp, ieee_quiet_nan)
   end function not_given

   !> Whether the file gives a number.
   elemental logical function is_given(value)
      real(wp), intent(in) :: value
      is_given = ieee_is_finite(value)
   end function is_given

   !> Sets the range of a factor for the sampler. A nominal value that the study does not give is `usual` for an absolute factor, 0
   !> for delta, 1 for scale. If `usual` is NaN, the nominal value is the mean of the values or of the distribution.
   subroutine define_factor(given, kind, usual, factor, error)
      type(study_factor_t), intent(in) :: given
      integer, intent(in) :: kind                          !! kind of the sampler
      real(wp), intent(in) :: usual
      type(factor_t), intent(out) :: factor
      type(error_t), allocatable, intent(out) :: error     !! exit_deck
      real(wp) :: nominal
      character(:), allocatable :: what

      nominal = given%nominal
      if (.not. is_given(nominal) .and. given%change == by_value) nominal = usual
      if (.not. is_given(nominal) .and. given%change == by_delta) nominal = 0.0_wp
      if (.not. is_given(nominal) .and. given%change == by_scale) nominal = 1.0_wp
      factor%nominal = nominal
      if (allocated(given%values)) factor%values = given%values
      if (allocated(given%values) .or. kind == list_kind) then
         if (.not. is_given(nominal) .and. allocated(given%values)) factor%nominal = sum(given%values)/size(given%values)
         return
      end if
      if (.not. is_given(nominal) .and. (is_given(given%tolerance) .or. is_given(given%deviation))) then
         call complain('its paths lead to numbers of different sizes; give nominal, or change = ''delta'' or ''scale''')
         return
      end if
      if (is_given(given%tolerance)) then
         call from_tolerance(given%distribution, nominal, given%tolerance, factor%distribution, error)
      else
         select case (given%distribution)
         case (uniform_kind)
            call new_distribution(uniform_kind, given%lower, given%upper, factor%distribution, error)
         case (triangular_kind)
            if (.not. is_given(nominal)) nominal = 0.5_wp*(given%lower + given%upper)
            call new_distribution(triangular_kind, given%lower, nominal, factor%distribution, error, c=given%upper)
         case default
            call new_distribution(given%distribution, nominal, given%deviation, factor%distribution, error)
         end select
      end if
      ! beyond the bounds of a tolerance or a normal distribution nothing is left
      if (.not. allocated(error)) call truncate(factor%distribution, error, &
         merge(given%lower, -huge(1.0_wp), is_given(given%lower)), merge(given%upper, huge(1.0_wp), is_given(given%upper)))
      if (allocated(error)) then
         what = error%message             ! a copy, as the error is replaced
         call complain(what)
         return
      end if
      if (.not. is_given(factor%nominal)) factor%nominal = mean_of(factor%distribution)

   contains

      !> Reports an error in the factor.
      subroutine complain(what)
         character(*), intent(in) :: what
         call fail(error, exit_deck, given%where//': factor '//quoted(given%name)//': '//what)
      end subroutine complain

   end subroutine define_factor

end module ek_study
