!> One equation of Φ(q) = 0: a sum of measures held at a value.
module ek_row
   use ek_number, only: num, zero, one
   use ek_measure, only: measure_t
   implicit none(type, external)
   private
   public :: row_t, term_t

   !> A term of a row: coefficient × measure.
   type :: term_t
      type(measure_t) :: measure
      real(num) :: coefficient = one
   end type term_t

   !> One equation Σ terms = target.
   type :: row_t
      integer :: first = 0, terms = 1      !! index of the first term in the suspension; number of terms
      real(num) :: target = zero           !! value at which Σ terms is held [m, - or rad]
      integer :: joint = 0                 !! index of the joint
      logical :: is_driver = .false.
      real(num) :: compliance = zero       !! driver with a stiffness: Σ terms = target + compliance × λ [m/N, rad/(N m)]
   end type row_t

end module ek_row
