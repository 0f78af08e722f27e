!> One equation of Φ(q) = 0: a sum of measures held at a value.
module ek_row
   use ek_number, only: num, zero, one
   use ek_measure, only: measure_t
   implicit none(type, external)
   private
   public :: row_t, row_numbers_t, row_list_t, term_t, term_numbers_t, term_list_t

   !> The numbers of a term, without those of its measure.
   type :: term_numbers_t
      real(num) :: coefficient = one
   end type term_numbers_t

   !> The numbers of a term as a list (see law_list_t).
   type :: term_list_t
      real(num) :: v(storage_size(term_numbers_t())/storage_size(zero)) = zero
   end type term_list_t

   !> A term of a row: coefficient × measure.
   type, extends(term_numbers_t) :: term_t
      type(measure_t) :: measure
   end type term_t

   !> The numbers of a row.
   type :: row_numbers_t
      real(num) :: target = zero           !! value at which Σ terms is held [m, - or rad]
      real(num) :: compliance = zero       !! driver with a stiffness: Σ terms = target + compliance × λ [m/N, rad/(N m)]
   end type row_numbers_t

   !> The numbers of a row as a list (see law_list_t).
   type :: row_list_t
      real(num) :: v(storage_size(row_numbers_t())/storage_size(zero)) = zero
   end type row_list_t

   !> One equation Σ terms = target.
   type, extends(row_numbers_t) :: row_t
      integer :: first = 0, terms = 1      !! index of the first term in the suspension; number of terms
      integer :: joint = 0                 !! index of the joint
      logical :: is_driver = .false.
   end type row_t

end module ek_row
