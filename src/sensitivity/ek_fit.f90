!> A fit: factors of a deck, and targets of the results, as the fit file gives them (ek_fit_reader).
module ek_fit
   use ek_kinds, only: wp
   use ek_quantity, only: name_length
   use ek_study, only: study_factor_t
   implicit none(type, external)
   private
   public :: fit_t, fit_factor_t, fit_target_t

   !> A factor of a fit: numbers of the deck that change together, as in a study.
   type, extends(study_factor_t) :: fit_factor_t
      real(wp), allocatable :: weights(:)         !! weight of each path; its numbers change by weight × factor
   end type fit_factor_t

   !> The target of a result: one value, a curve, or a band between limits. Numbers that are not given are NaN.
   type :: fit_target_t
      character(:), allocatable :: name
      character(:), allocatable :: quantity       !! column, entry of the compliance matrix, or key number
      character(:), allocatable :: case           !! name of the case; '': the case of the fit
      logical :: is_change = .false.              !! the target is the change of the column against its value at design
      logical :: is_slope = .false.               !! the target is the slope of the column over `over`, within `window` of design
      character(name_length) :: over = 'factor'   !! column to which `at` and the abscissa of the file refer
      real(wp) :: at = 0.0_wp, window = 0.0_wp
      real(wp) :: value, low, high
      character(:), allocatable :: file           !! CSV file of a curve; '': no file
      character(:), allocatable :: column         !! column of the file; by default, the name of the quantity
      character(:), allocatable :: map            !! map from the headings of the file to quantities (ek_rig_map); '': none
      real(wp) :: deviation                       !! standard deviation of one value of the target
      real(wp) :: weight = 1.0_wp
      character(:), allocatable :: where          !! 'file:line' of the &target, for messages
   end type fit_target_t

   type :: fit_t
      character(:), allocatable :: name, title, deck, case
      integer :: iterations = 50                  !! limit of the number of iterations
      type(fit_factor_t), allocatable :: factors(:)
      type(fit_target_t), allocatable :: targets(:)
      character(:), allocatable :: where          !! 'file:line' of the &fit, for messages
   end type fit_t

end module ek_fit
