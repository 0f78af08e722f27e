!> Tolerances: mean, standard deviation, skewness and shares of the responses of a study, from derivatives.
!>
!> The responses are expanded about the centre of the factors, in the standard form of each factor (ek_standard_factor). The slopes
!> are derivatives (ek_study_slopes). The curvatures are central differences of these derivatives, from two designs close to the
!> centre for each factor. With k factors, 2 k + 1 designs are solved with their derivatives. Two more designs for each factor, at the
!> ends of its range, show whether the responses have values there.
module ek_tolerance
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, message_list_t, fail, exit_model
   use ek_text, only: quoted, str, replace
   use ek_deck, only: deck_t
   use ek_study, only: study_t, define_factor
   use ek_factor_numbers, only: deck_value
   use ek_designer, only: designer_t
   use ek_sampler_settings, only: factor_t
   use ek_standard_factor, only: standard_factor_t, new_standard_factor, value_at, slope_at
   use ek_moments, only: expansion_t, moments_t, find_moments
   use ek_chunk, only: chunk_t, new_chunk, reason_of
   use ek_study_design, only: solve_designs, complete_design
   use ek_design_cause, only: causes_t
   use ek_study_slopes, only: study_slopes_t, begin_study_slopes, find_study_slopes
   implicit none(type, external)
   private
   public :: tolerance_t, find_tolerance

   real(wp), parameter :: step = 0.1_wp         !! distance of the two gradients from the centre [standard deviations]; the relative
                                                !! error of a curvature is a sixth of the square of its relative change over this
                                                !! distance

   type :: tolerance_t
      type(standard_factor_t), allocatable :: factors(:)
      type(expansion_t), allocatable :: expansions(:)        !! expansions of the responses, then of the curves
      type(moments_t), allocatable :: moments(:)             !! moments of the responses, then of the curves
      real(wp), allocatable :: sweep(:)                      !! swept values of the states of a curve
      integer :: responses = 0
      logical, allocatable :: has_end(:, :, :)               !! whether the response has a value at the low and at the high end of a
                                                             !! factor: (response, end, factor)
      type(message_list_t) :: failures                       !! reasons why designs at the ends have no values
   end type tolerance_t

contains

   !> Expands all responses and curves of a study, and finds their moments. Creates strings.
   !>
   !> Equation (D.14) of docs/theory/sampling.md.
   subroutine find_tolerance(study, deck, designer, tolerance, error)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer               !! designer of the study (new_designer)
      type(tolerance_t), intent(out) :: tolerance
      type(error_t), allocatable, intent(out) :: error       !! exit_deck, exit_model: numbers without a derivative, and the reason
      class(study_slopes_t), allocatable :: slopes
      type(factor_t) :: factor
      real(wp), allocatable :: here(:), low(:, :), high(:, :), noise(:)
      logical :: is_valid
      integer :: f, j, k

      allocate (tolerance%factors(size(study%factors)))
      do f = 1, size(study%factors)
         call define_factor(study%factors(f), study%kind, &
            deck_value(designer%workspace%definition%parameters, designer%paths(f)), factor, error)
         if (allocated(error)) return
         call new_standard_factor(factor, tolerance%factors(f))
      end do
      call begin_study_slopes(study, deck, designer, slopes, error)
      if (allocated(error)) return
      allocate (here(size(study%factors)))
      do f = 1, size(here)
         here(f) = value_at(tolerance%factors(f), 0.0_wp)
      end do
      call find_study_slopes(here, slopes, is_valid)
      if (.not. is_valid) then
         call fail(error, exit_model, study%where//': the design at the centre of all factors has no derivatives: a response '// &
            'has no value there, a state was not reached, or a parameter of the deck is outside its range')
         return
      end if
      tolerance%responses = slopes%responses
      tolerance%sweep = slopes%sweep
      allocate (tolerance%expansions(size(slopes%values)), tolerance%moments(size(slopes%values)))
      do k = 1, size(slopes%values)
         tolerance%expansions(k)%value = slopes%values(k)
         tolerance%expansions(k)%slopes = [(slopes%slopes(k, f)*slope_at(tolerance%factors(f), 0.0_wp), f=1, size(here))]
         allocate (tolerance%expansions(k)%curvatures(size(here), size(here)), source=0.0_wp)
      end do
      do f = 1, size(here)
         if (.not. tolerance%factors(f)%scale > 0.0_wp) cycle
         call find_beside(-step, low)
         if (allocated(error)) return
         call find_beside(step, high)
         if (allocated(error)) return
         do k = 1, size(slopes%values)
            ! of a factor without a slope; twice the noise of a slope, because it is a difference of two
            noise = 2.0_wp*slopes%noise(k, :)*[(slope_at(tolerance%factors(j), 0.0_wp), j=1, size(here))]
            associate (b => tolerance%expansions(k)%curvatures(:, f), a => tolerance%expansions(k)%slopes)
               b = (high(k, :) - low(k, :))/(2.0_wp*step)
               where (min(abs(a), abs(a(f))) <= 0.0_wp .and. abs(high(k, :) - low(k, :)) <= noise) b = 0.0_wp
            end associate
         end do
      end do
      do k = 1, size(slopes%values)
         associate (b => tolerance%expansions(k)%curvatures)
            b = 0.5_wp*(b + transpose(b))
            where (.not. ieee_is_finite(b)) b = 0.0_wp
         end associate
         if (is_finite(tolerance%expansions(k))) then
            call find_moments(tolerance%expansions(k), tolerance%factors, tolerance%moments(k))
         else                                                ! a column that is not defined at a state
            tolerance%moments(k)%mean = ieee_value(1.0_wp, ieee_quiet_nan)
            tolerance%moments(k)%deviation = tolerance%moments(k)%mean
         end if
      end do
      call find_ends(study, deck, designer, here, tolerance)

   contains

      !> Computes the slopes in standard form at the design whose factor f is u standard deviations from the centre.
      subroutine find_beside(u, standard)
         real(wp), intent(in) :: u
         real(wp), allocatable, intent(out) :: standard(:, :)      !! (value, factor)
         real(wp) :: values(size(here))
         integer :: j

         values = here
         values(f) = value_at(tolerance%factors(f), u)
         call find_study_slopes(values, slopes, is_valid)
         if (.not. is_valid) then
            call fail(error, exit_model, study%factors(f)%where//': factor '//quoted(study%factors(f)%name)// &
               ': a design a tenth of a standard deviation from the centre has no derivatives')
            return
         end if
         standard = slopes%slopes
         do j = 1, size(here)
            standard(:, j) = standard(:, j)*slope_at(tolerance%factors(j), merge(u, 0.0_wp, j == f))
         end do
      end subroutine find_beside

   end subroutine find_tolerance

   !> Solves the designs at the ends of each factor, with all other factors at their centres. Finds the responses that have a value
   !> there, and the reasons of failures. Creates strings.
   subroutine find_ends(study, deck, designer, here, tolerance)
      type(study_t), intent(in) :: study
      type(deck_t), intent(in) :: deck
      type(designer_t), intent(in) :: designer
      real(wp), intent(in) :: here(:)                        !! factors at the centre
      type(tolerance_t), intent(inout) :: tolerance
      character(*), parameter :: words(2) = [character(5) :: 'lower', 'upper']
      class(designer_t), allocatable :: mine
      type(chunk_t) :: chunk
      type(causes_t) :: causes
      character(:), allocatable :: reason
      integer :: f, k, side, together

      allocate (mine, source=designer)
      call new_chunk(1_i8, 2*size(here), size(here), tolerance%responses, &
         merge(size(study%columns) + 1, 0, size(study%columns) > 0), designer%states, chunk)
      do f = 1, size(here)
         do side = 1, 2
            k = 2*(f - 1) + side
            chunk%factors(:, k) = here
            chunk%factors(f, k) = value_at(tolerance%factors(f), tolerance%factors(f)%ends(side))
         end do
      end do
      together = size(mine%packs%workspaces) + 1
      do k = 1, size(chunk%status), together
         call solve_designs(study, mine, k, min(k + together - 1, size(chunk%status)), chunk, causes)
      end do
      do k = 1, causes%used
         call complete_design(study, deck, mine, causes%list(k), chunk)
      end do
      allocate (tolerance%has_end(tolerance%responses, 2, size(here)))
      do f = 1, size(here)
         do side = 1, 2
            k = 2*(f - 1) + side
            tolerance%has_end(:, side, f) = ieee_is_finite(chunk%responses(:, k))
            if (chunk%status(k) == 0) cycle
            reason = reason_of(chunk, k)
            call replace(reason, new_line('a'), '; ')
            call tolerance%failures%add('factor '//quoted(study%factors(f)%name)//' at its '// &
               words(side)//' end '//str(chunk%factors(f, k), 6)//': '//reason// &
               '; responses without a value there have no '//trim(merge('at_low ', 'at_high', side == 1)))
         end do
      end do
   end subroutine find_ends

   pure logical function is_finite(expansion)
      type(expansion_t), intent(in) :: expansion
      is_finite = ieee_is_finite(expansion%value) .and. all(ieee_is_finite(expansion%slopes))
   end function is_finite

end module ek_tolerance
