!> A fit: factors of a deck, and targets of the results, as its file gives them (ek_fit_reader).
module ek_fit
   use ek_kinds, only: wp
   use ek_quantity, only: name_length
   use ek_study, only: study_factor_t
   implicit none(type, external)
   private
   public :: fit_t, fit_factor_t, fit_target_t

   !> Numbers of the deck that change together, as in a study.
   type, extends(study_factor_t) :: fit_factor_t
      real(wp), allocatable :: weights(:)         !! of the paths: each changes by weight × factor
   end type fit_factor_t

   !> The target of a result: one value, a curve, or a band. Numbers that are not given are NaN.
   type :: fit_target_t
      character(:), allocatable :: name
      character(:), allocatable :: quantity       !! column, entry of the compliance matrix, or key number
      character(:), allocatable :: case           !! '': the case of the fit
      logical :: is_slope = .false.               !! the slope of the column over `over`, within `window` of design
      character(name_length) :: over = 'factor'   !! column in which `at` and the abscissa of the file are meant
      real(wp) :: at = 0.0_wp, window = 0.0_wp
      real(wp) :: value, low, high
      character(:), allocatable :: file           !! CSV of a curve, '' for none
      character(:), allocatable :: column         !! of the file; '': as the quantity
      real(wp) :: deviation                       !! standard deviation of one value
      real(wp) :: weight = 1.0_wp
      character(:), allocatable :: where          !! 'file:line'
   end type fit_target_t

   type :: fit_t
      character(:), allocatable :: name, title, deck, case
      integer :: iterations = 50                  !! at most
      type(fit_factor_t), allocatable :: factors(:)
      type(fit_target_t), allocatable :: targets(:)
      character(:), allocatable :: where          !! 'file:line' of the &fit
   end type fit_t

end module ek_fit
