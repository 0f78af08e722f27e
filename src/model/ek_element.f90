!> Elastic elements: the properties of each kind, the record of one element, and the numbers that define it.
!>
!> | kind    | tension T (dV/dvalue)                                                                 |
!> |---------|---------------------------------------------------------------------------------------|
!> | spring  | rate (L − L_design) − preload, or −c(compression) − preload with a curve              |
!> | damper  | gas_rate (L − L_design) − gas_force; damping does not act in statics                  |
!> | stop    | −f(e), e = (L_design − clearance) − L (bump); f(e), e = L − (L_design + clearance) (rebound) |
!> | torsion | rate φ − preload, or c(φ) − preload; φ = m·θ, the rotation about its axis             |
!> | measure | as a spring, of a displacement; as a torsion spring, of a rotation or a cosine, φ = value − design value |
!> | bushing | six components, see ek_elastic                                                        |
!>
!> f is one-sided and rounded (ek_law). All kinds but the bushing act along one measure: the force ON the bodies is
!> −T × gradient of the measure. Forces and tangents of all kinds: ek_element_force.
!>
!> A new kind of one measure needs its index and its row in `element_kinds`, here, and its group, keys and reader in the deck layer.
!> A new number of the deck also needs its position in the list of numbers and its line in `set_numbers`. A formula that ek_law does
!> not have needs its case in `look_up_element`, `element_slopes` and `is_linear`.
module ek_element
   use ek_kinds, only: wp
   use ek_number, only: num, mask, zero, some
   use ek_measure, only: measure_t, is_of_angle
   use ek_law, only: law_t, copy_law, look_up_law, find_slopes
   use ek_elastic, only: bushing_t
   implicit none(type, external)
   private
   public :: element_t, element_numbers_t, element_list_t, element_shape, element_kinds
   public :: set_kind, set_design_value, copy_element, is_of_angle
   public :: axial_spring, damper, stop_spring, torsion_spring, measure_spring, bushing_element
   public :: element_numbers, rate_number, preload_number, free_length_number, clearance_number, rounding_number, set_numbers
   public :: look_up_element, element_slopes, is_linear
   public :: no_shape, coil_shape, damper_shape, stop_shape, bushing_shape
   public :: spring_share, bar_share, stop_share, bushing_share, gas_share

   ! kinds, numbered as in element_kinds
   integer, parameter :: bushing_element = 1
   integer, parameter :: axial_spring = 2
   integer, parameter :: torsion_spring = 3
   integer, parameter :: measure_spring = 4  !! spring on a displacement, rotation or cosine; `balance` leaves its preload unchanged
   integer, parameter :: stop_spring = 5
   integer, parameter :: damper = 6

   ! numbers that a deck gives for an element of one measure
   integer, parameter :: rate_number = 1, preload_number = 2, free_length_number = 3, clearance_number = 4, rounding_number = 5
   integer, parameter :: element_numbers = 5      !! count of these numbers

   ! shapes in pictures
   integer, parameter :: no_shape = 0, coil_shape = 1, damper_shape = 2, stop_shape = 3, bushing_shape = 4

   ! classes of the shares in a wheel rate or roll rate (ek_rate_split)
   integer, parameter :: spring_share = 1, bar_share = 2, stop_share = 3, bushing_share = 4, gas_share = 5

   !> The properties of a kind of element.
   type :: element_kind_t
      character(8) :: label       !! group of the deck, for messages
      character(20) :: one, many  !! names in the counts of `check`, in the order of the table; '': not counted
      logical :: carries          !! the rate at design carries the car (a deck without such an element gives a warning)
      logical :: has_gap          !! a stop: free up to contact; the result column is the clearance, not the value of the measure
      logical :: is_axial_spring        !! the preload trim (`balance`) may set its preload; its motion ratio is reported
      integer :: shape            !! shape in pictures, for a bushing, or for an element on a distance
      integer :: share            !! class of the share of an element in a wheel rate or roll rate
   end type element_kind_t

   type(element_kind_t), parameter :: element_kinds(*) = [ &
      element_kind_t('bushing', 'bushing', 'bushings', .false., .false., .false., bushing_shape, bushing_share), &
      element_kind_t('spring', 'spring', 'springs', .true., .false., .true., coil_shape, spring_share), &
      element_kind_t('torsion', 'torsion spring', 'torsion springs', .false., .false., .false., no_shape, bar_share), &
      element_kind_t('spring', 'spring on a measure', 'springs on measures', .true., .false., .false., no_shape, spring_share), &
      element_kind_t('stop', 'stop', 'stops', .false., .true., .false., stop_shape, stop_share), &
      element_kind_t('damper', '', '', .false., .false., .false., damper_shape, gas_share)]

   !> The numbers of an element, without those of its measure, its law and its bushing. The first four affect the force only by the
   !> preload, and by reference and rate of the law.
   type :: element_numbers_t
      real(num) :: preload = zero          !! compression at design [N], moment on body j about the axis [N m]
      real(num) :: design_length = zero    !! value of the measure at design [m, rad, -]
      real(num) :: free_length = zero      !! free length [m]; 0: not given
      real(num) :: clearance = zero        !! clearance of a stop [m]
   end type element_numbers_t

   integer, parameter :: element_shape = 5  !! from here on, the numbers of the list that give the law of an element its shape

   !> The numbers of an element as a list (see law_list_t).
   type :: element_list_t
      real(num) :: v(storage_size(element_numbers_t())/storage_size(zero)) = zero
   end type element_list_t

   !> An elastic element.
   type, extends(element_numbers_t) :: element_t
      integer :: kind = axial_spring
      logical :: is_balanced = .true.       !! spring: the preload trim (`balance`) may change its preload
      type(measure_t) :: measure            !! bodies, points, and the measure on which the element acts; kind 0: bushing
      type(law_t) :: law                    !! law of the measure, from which the preload is subtracted [N, N m]
      type(bushing_t) :: bushing            !! the six components of a bushing
      logical :: gives_z = .false., gives_x = .false.   !! bushing: the deck gives its z axis, its x axis
      character(:), allocatable :: name, where
   end type element_t

contains

   !> Stores the numbers of a design, in SI; 0 where the deck does not give a number.
   pure subroutine set_numbers(element, numbers)
      type(element_t), intent(inout) :: element
      real(num), intent(in) :: numbers(element_numbers)      !! N/m and N, of an angle N m/rad and N m; m

      element%law%rate = numbers(rate_number)
      element%preload = numbers(preload_number)
      element%free_length = numbers(free_length_number)
      element%clearance = numbers(clearance_number)
      element%law%rounding = numbers(rounding_number)
   end subroutine set_numbers

   !> Sets kind and measure of an element. The argument of the law is the compression for a length, and the increase for an angle or
   !> cosine.
   pure subroutine set_kind(element, kind, measure)
      type(element_t), intent(inout) :: element
      integer, intent(in) :: kind
      type(measure_t), intent(in) :: measure

      element%kind = kind
      element%measure = measure
      element%law%sign = merge(1.0_wp, -1.0_wp, is_of_angle(measure%kind))
      element%law%is_one_sided = kind == stop_spring
   end subroutine set_kind

   !> Sets the design value of the measure, from which the deflection counts. All other numbers must be set.
   !>
   !> Without a curve, a free length sets the preload: rate × (free length − design length). With a curve, compression is measured
   !> from the free length.
   pure subroutine set_design_value(element, value)
      type(element_t), intent(inout) :: element
      real(num), intent(in) :: value       !! m, rad, -
      logical(mask) :: has_free_length

      element%design_length = value
      element%law%reference = value + element%law%sign*element%clearance
      has_free_length = element%free_length > 0.0_wp
      if (.not. some(has_free_length)) return
      if (element%law%has_curve) then
         element%law%reference = merge(element%free_length, element%law%reference, has_free_length)
      else
         element%preload = merge(element%law%rate*(element%free_length - value), element%preload, has_free_length)
      end if
   end subroutine set_design_value

   !> Copies the numbers of an element to another element that differs only in numbers, without allocation.
   pure subroutine copy_element(from, to)
      type(element_t), intent(in) :: from
      type(element_t), intent(inout) :: to

      to%measure = from%measure
      to%element_numbers_t = from%element_numbers_t
      if (from%kind == bushing_element) then
         call copy_bushing(from%bushing, to%bushing)
      else
         call copy_law(from%law, to%law)
      end if
   end subroutine copy_element

   !> Copies the numbers of a bushing to another bushing that differs only in numbers, without allocation.
   pure subroutine copy_bushing(from, to)
      type(bushing_t), intent(in) :: from
      type(bushing_t), intent(inout) :: to
      integer :: c

      if (.not. (allocated(from%laws) .and. allocated(to%laws))) then
         to = from
         return
      end if
      to%bushing_numbers_t = from%bushing_numbers_t
      do c = 1, size(to%laws)
         call copy_law(from%laws(c), to%laws(c))
      end do
   end subroutine copy_bushing

   !> Finds the force of an element with one measure (the derivative of its energy) and the slope of the force, at a value of the
   !> measure. The preload is not included.
   pure subroutine look_up_element(element, value, force, slope)
      type(element_t), intent(in) :: element
      real(num), intent(in) :: value               !! m, rad, -
      real(num), intent(out) :: force, slope       !! N and N/m; N m and N m/rad
      call look_up_law(element%law, value, force, slope)
   end subroutine look_up_element

   !> Finds the smallest and the largest slope of the force of an element with one measure, between two values of the measure.
   pure subroutine element_slopes(element, from, to, least, most)
      type(element_t), intent(in) :: element
      real(num), intent(in) :: from, to            !! m, rad, -
      real(num), intent(out) :: least, most        !! N/m, N m/rad
      call find_slopes(element%law, from, to, least, most)
   end subroutine element_slopes

   !> Whether the force of an element is linear in its measure, with an equal slope everywhere.
   pure logical function is_linear(element)
      type(element_t), intent(in) :: element
      is_linear = .not. (element%law%has_curve .or. element%law%is_one_sided)
   end function is_linear

end module ek_element
