!> The factors of N at the newest state of a path, stored while Newton's method factorises N elsewhere.
!>
!> `exchange` swaps these factors with the factors in kkt_t, without a copy. `keep` allocates memory when it first stores factors.
module ek_factors
   use ek_kinds, only: wp
   use ek_kkt, only: kkt_t, nothing
   implicit none(type, external)
   private
   public :: factors_t, new_factors, mark, keep, exchange

   !> Stored factors of N, with the number of the factorisation made at their state.
   type :: factors_t
      logical :: is_kept = .false.          !! the object contains the factors of the state
      integer, private :: serial = -1       !! number of the factorisation; −1: the state has no factors
      integer, private :: negative = 0      !! number of negative eigenvalues
      logical, private :: is_singular = .false.   !! whether N is singular, as in kkt_t
      integer, private :: stage = nothing   !! stage of the factors, as in kkt_t
      integer, private :: way = 0           !! plan of the factors, as in kkt_t
      real(wp), allocatable, private :: matrix(:, :), planned(:)
      integer, allocatable, private :: pivots(:)
   end type factors_t

contains

   !> An empty store of factors; its work space is allocated when factors are first stored.
   pure function new_factors() result(self)
      type(factors_t) :: self
      self%serial = -1
   end function new_factors

   !> Records that the state has changed. The factors of the new state have the serial number `serial` and are still in kkt_t.
   pure subroutine mark(self, serial)
      type(factors_t), intent(inout) :: self
      integer, intent(in) :: serial         !! kkt%factorisations after the factorisation; −1: not known

      self%serial = serial
      self%is_kept = .false.
   end subroutine mark

   !> Stores the factors of the state, if kkt_t contains them.
   pure subroutine keep(self, kkt)
      type(factors_t), intent(inout) :: self
      type(kkt_t), intent(inout) :: kkt

      if (self%is_kept .or. self%serial /= kkt%factorisations) return
      ! work space may serve several systems: those of a pack have plans of their own
      if (allocated(self%matrix)) then
         if (size(self%pivots) /= kkt%n) deallocate (self%matrix, self%pivots)
      end if
      if (allocated(kkt%matrix) .and. .not. allocated(self%matrix)) then
         allocate (self%matrix(kkt%n, kkt%n), source=0.0_wp)
         allocate (self%pivots(kkt%n), source=0)
      end if
      if (allocated(self%planned) .and. allocated(kkt%planned)) then
         if (size(self%planned) /= size(kkt%planned)) deallocate (self%planned)
      end if
      if (allocated(kkt%planned) .and. .not. allocated(self%planned)) allocate (self%planned(size(kkt%planned)), source=0.0_wp)
      call exchange(self, kkt)
      self%is_kept = .true.
   end subroutine keep

   !> Exchanges the stored factors and the factors in kkt_t.
   pure subroutine exchange(self, kkt)
      type(factors_t), intent(inout) :: self
      type(kkt_t), intent(inout) :: kkt
      real(wp), allocatable :: matrix(:, :), planned(:)
      integer, allocatable :: pivots(:)
      integer :: number
      logical :: is_singular

      call move_alloc(self%matrix, matrix)
      call move_alloc(kkt%matrix, self%matrix)
      call move_alloc(matrix, kkt%matrix)
      call move_alloc(self%pivots, pivots)
      call move_alloc(kkt%pivots, self%pivots)
      call move_alloc(pivots, kkt%pivots)
      call move_alloc(self%planned, planned)
      call move_alloc(kkt%planned, self%planned)
      call move_alloc(planned, kkt%planned)
      number = self%way
      self%way = kkt%way
      kkt%way = number
      number = self%negative
      self%negative = kkt%negative
      kkt%negative = number
      is_singular = self%is_singular
      self%is_singular = kkt%is_singular
      kkt%is_singular = is_singular
      number = self%stage
      self%stage = kkt%stage
      kkt%stage = number
      kkt%is_at_design = .false.
   end subroutine exchange

end module ek_factors
