!> Elastic elements: what each kind is, the record of one element, and the functions that create one.
!>
!> | kind    | tension T (dV/dvalue)                                                                 |
!> |---------|---------------------------------------------------------------------------------------|
!> | spring  | rate (L − L_design) − preload, or −c(compression) − preload with a curve              |
!> | damper  | gas_rate (L − L_design) − gas_force; damping does not act in statics                  |
!> | stop    | −f(e), e = (L_design − clearance) − L (bump); f(e), e = L − (L_design + clearance) (rebound) |
!> | torsion | rate φ − preload, or c(φ) − preload; φ = m·θ, the rotation about its axis             |
!> | measure | as a spring, of a gap; as a torsion spring, of a rotation or a cosine, φ = value − design value |
!> | bushing | six components, see ek_elastic                                                        |
!>
!> f is one-sided and rounded (ek_law). All kinds but the bushing act along one measure: the force ON the bodies is
!> −T × gradient of the measure. Forces and tangents of all kinds: ek_element_force.
!>
!> A new kind of one measure: its number, its row in `element_kinds` and a function that creates one, all in this file.
module ek_element
   use ek_kinds, only: wp
   use ek_text, only: quoted
   use ek_measure, only: measure_t, axis_axis, distance, rotation
   use ek_curve, only: curve_t
   use ek_law, only: law_t
   use ek_elastic, only: bushing_t
   implicit none(type, external)
   private
   public :: element_t, element_kinds, new_spring, new_damper, new_stop, new_torsion, new_measure_spring, new_bushing
   public :: element_numbers_t, set_numbers, set_measure_design, is_of_angle, element_label
   public :: axial_spring, damper, stop_spring, torsion_spring, measure_spring, bushing_element
   public :: no_shape, coil_shape, damper_shape, stop_shape, bushing_shape

   ! kinds, numbered as in element_kinds
   integer, parameter :: bushing_element = 1
   integer, parameter :: axial_spring = 2    !! its preload may be set by balance; its motion ratio is reported
   integer, parameter :: torsion_spring = 3
   integer, parameter :: measure_spring = 4  !! on a gap, a rotation or a cosine; keeps its preload
   integer, parameter :: stop_spring = 5
   integer, parameter :: damper = 6

   ! shapes in pictures
   integer, parameter :: no_shape = 0, coil_shape = 1, damper_shape = 2, stop_shape = 3, bushing_shape = 4

   !> The properties of a kind.
   type :: element_kind_t
      character(8) :: label       !! in messages: the group of the deck
      character(20) :: one, many  !! counted by `check`, in the order of the table; '': not counted
      logical :: carries          !! its rate at design carries the car (a deck without such an element gives a warning)
      logical :: has_gap          !! its column is the gap to contact instead of the value of its measure
      integer :: shape            !! in pictures, of an element on a distance, or a bushing
   end type element_kind_t

   type(element_kind_t), parameter :: element_kinds(*) = [ &
      element_kind_t('bushing', 'bushing', 'bushings', .false., .false., bushing_shape), &
      element_kind_t('spring', 'spring', 'springs', .true., .false., coil_shape), &
      element_kind_t('torsion', 'torsion spring', 'torsion springs', .false., .false., no_shape), &
      element_kind_t('spring', 'spring on a measure', 'springs on measures', .true., .false., no_shape), &
      element_kind_t('stop', 'stop', 'stops', .false., .true., stop_shape), &
      element_kind_t('damper', '', '', .false., .false., damper_shape)]

   !> An elastic element. What the solution reads comes first.
   type :: element_t
      integer :: kind = axial_spring
      logical :: has_law = .false.          !! `law` replaces rate and design length
      logical :: is_balanced = .true.       !! spring: balance may change its preload
      type(measure_t) :: measure            !! its bodies; the length, angle or other measure on which it acts; kind 0: bushing
      real(wp) :: rate = 0.0_wp             !! N/m, N m/rad; used if has_law is .false.
      real(wp) :: design_length = 0.0_wp    !! value at design: m, rad, -; 0 rad for a torsion spring
      real(wp) :: preload = 0.0_wp          !! compression at design [N], moment on body j about the axis [N m]
      type(law_t) :: law
      type(bushing_t) :: bushing            !! the six components of a bushing
      character(:), allocatable :: name, where
   end type element_t

   !> The numbers of an element, SI: all that a change of design can change.
   type :: element_numbers_t
      type(measure_t) :: measure            !! design points instead of arms
      real(wp) :: rate = 0.0_wp             !! N/m, N m/rad; of a damper its gas rate
      real(wp) :: preload = 0.0_wp          !! N, N m; of a damper its gas force
      real(wp) :: free_length = 0.0_wp      !! m; 0: not given
      real(wp) :: clearance = 0.0_wp, rounding = 0.0_wp   !! of a stop [m]
   end type element_numbers_t

contains

   !> Sets all numbers of an element whose kind, law and curve are known.
   !>
   !> A free length sets the preload from the design length; with a curve, compression is measured from the free length.
   pure subroutine set_numbers(spring, numbers)
      type(element_t), intent(inout) :: spring
      type(element_numbers_t), intent(in) :: numbers

      spring%measure = numbers%measure
      spring%design_length = 0.0_wp
      if (numbers%measure%kind == distance) spring%design_length = norm2(numbers%measure%arm_j - numbers%measure%arm_i)
      spring%preload = numbers%preload
      spring%rate = 0.0_wp
      if (spring%kind == stop_spring) then
         spring%law%reference = spring%design_length + spring%law%sign*numbers%clearance
         spring%law%rounding = numbers%rounding
         spring%law%rate = numbers%rate
      else if (spring%has_law) then
         spring%law%reference = spring%design_length
         if (numbers%free_length > 0.0_wp) spring%law%reference = numbers%free_length
      else
         spring%rate = numbers%rate
         if (numbers%free_length > 0.0_wp) &
            spring%preload = numbers%rate*(numbers%free_length - spring%design_length)
      end if
   end subroutine set_numbers


   !> A spring between two design points (global; `complete` of the builder converts them to arms).
   !>
   !> free_length > 0 sets the preload from the design length; with a curve, compression is measured from the free length.
   pure function new_spring(name, where, body_i, body_j, point_i, point_j, rate, preload, free_length, curve) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: rate                        !! N/m
      real(wp), intent(in), optional :: preload           !! N, compression at design
      real(wp), intent(in), optional :: free_length       !! m
      type(curve_t), intent(in), optional :: curve        !! force over compression [N, m]; instead of the rate
      type(element_t) :: spring

      spring = axial(name, where, body_i, body_j, point_i, point_j)
      spring%rate = rate
      if (present(preload)) spring%preload = preload
      if (present(curve)) then
         spring%rate = 0.0_wp
         spring%has_law = .true.
         spring%law%sign = -1.0_wp
         spring%law%reference = spring%design_length
         if (present(free_length)) spring%law%reference = free_length
         spring%law%has_curve = .true.
         spring%law%curve = curve
      else if (present(free_length)) then
         spring%preload = rate*(free_length - spring%design_length)
      end if
   end function new_spring

   !> A damper at rest: the gas force on the rod.
   pure function new_damper(name, where, body_i, body_j, point_i, point_j, gas_rate, gas_force) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      real(wp), intent(in) :: gas_rate                    !! N/m
      real(wp), intent(in) :: gas_force                   !! N, pushes the ends apart at design
      type(element_t) :: spring

      spring = axial(name, where, body_i, body_j, point_i, point_j)
      spring%kind = damper
      spring%rate = gas_rate
      spring%preload = gas_force
   end function new_damper

   !> A bump or rebound stop: free for `clearance` of shortening or lengthening from design, then rate or curve.
   pure function new_stop(name, where, body_i, body_j, point_i, point_j, is_bump, clearance, rounding, rate, curve) &
      result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)      !! m
      logical, intent(in) :: is_bump                      !! else rebound
      real(wp), intent(in) :: clearance, rounding         !! m
      real(wp), intent(in) :: rate                        !! N/m
      type(curve_t), intent(in), optional :: curve        !! force over penetration [N, m]; instead of the rate
      type(element_t) :: spring

      spring = axial(name, where, body_i, body_j, point_i, point_j)
      spring%kind = stop_spring
      spring%has_law = .true.
      spring%law%sign = merge(-1.0_wp, 1.0_wp, is_bump)
      spring%law%reference = spring%design_length + spring%law%sign*clearance
      spring%law%is_one_sided = .true.
      spring%law%rounding = rounding
      spring%law%rate = rate
      if (.not. present(curve)) return
      spring%law%has_curve = .true.
      spring%law%curve = curve
   end function new_stop

   !> A torsion spring about an axis fixed in body i; at design it exerts only its preload.
   pure function new_torsion(name, where, body_i, body_j, axis, rate, preload, curve) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: axis(3)                     !! unit, global at design
      real(wp), intent(in) :: rate                        !! N m/rad
      real(wp), intent(in) :: preload                     !! N m on body j about the axis at design
      type(curve_t), intent(in), optional :: curve        !! moment over angle [N m, rad]; instead of the rate
      type(element_t) :: spring

      spring%name = name
      spring%where = where
      spring%kind = torsion_spring
      spring%measure = measure_t(kind=rotation, body_i=body_i, body_j=body_j, u=axis)
      spring%rate = rate
      spring%preload = preload
      if (.not. present(curve)) return
      spring%rate = 0.0_wp
      spring%has_law = .true.
      spring%law%has_curve = .true.
      spring%law%curve = curve
   end function new_torsion

   !> A spring on a measure; its arms as design points, its design value set by `complete` of the builder.
   !>
   !> On a distance it is identical to a spring between the two points. On a gap compression is positive too: the preload
   !> opens the gap. On a rotation or a cosine the law is that of a torsion spring: the preload increases the value.
   pure function new_measure_spring(name, where, measure, rate, preload, free_length, curve) result(spring)
      character(*), intent(in) :: name, where
      type(measure_t), intent(in) :: measure              !! design points, unit directions
      real(wp), intent(in) :: rate                        !! N/m, N m/rad, N m
      real(wp), intent(in), optional :: preload           !! N, N m, at design
      real(wp), intent(in), optional :: free_length       !! m; for a distance only
      type(curve_t), intent(in), optional :: curve        !! force over compression, moment over φ; instead of the rate
      type(element_t) :: spring

      if (measure%kind == distance) then
         spring = new_spring(name, where, measure%body_i, measure%body_j, measure%arm_i, measure%arm_j, rate, preload, &
            free_length, curve)
         return
      end if
      spring%name = name
      spring%where = where
      spring%kind = measure_spring
      spring%measure = measure
      spring%rate = rate
      if (present(preload)) spring%preload = preload
      if (.not. present(curve)) return
      spring%rate = 0.0_wp
      spring%has_law = .true.
      if (.not. is_of_angle(measure%kind)) spring%law%sign = -1.0_wp
      spring%law%has_curve = .true.
      spring%law%curve = curve
   end function new_measure_spring

   !> Sets the design value of a spring on a measure, from which its deflection is measured.
   pure subroutine set_measure_design(spring, value)
      type(element_t), intent(inout) :: spring
      real(wp), intent(in) :: value       !! m, rad, -

      spring%design_length = value
      if (spring%has_law) spring%law%reference = value
   end subroutine set_measure_design

   !> Whether the generalised force of a measure is a moment (rotation, cosine).
   pure logical function is_of_angle(kind)
      integer, intent(in) :: kind         !! of the measure
      is_of_angle = kind == rotation .or. kind == axis_axis
   end function is_of_angle

   !> The components common to all elements between two points.
   pure function axial(name, where, body_i, body_j, point_i, point_j) result(spring)
      character(*), intent(in) :: name, where
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point_i(3), point_j(3)
      type(element_t) :: spring

      spring%name = name
      spring%where = where
      spring%measure = measure_t(kind=distance, body_i=body_i, body_j=body_j, arm_i=point_i, arm_j=point_j)
      spring%design_length = norm2(point_j - point_i)
   end function axial

   !> A bushing; its markers are given as design points. All components except the derived ones are set.
   pure function new_bushing(bushing) result(element)
      type(bushing_t), intent(in) :: bushing
      type(element_t) :: element

      element%name = bushing%name
      element%where = bushing%where
      element%kind = bushing_element
      element%measure = measure_t(body_i=bushing%body_i, body_j=bushing%body_j, arm_i=bushing%arm_i, arm_j=bushing%arm_j)
      element%bushing = bushing
   end function new_bushing

   !> "spring 'coil'", for messages.
   pure function element_label(element) result(text)
      type(element_t), intent(in) :: element
      character(:), allocatable :: text
      text = trim(element_kinds(element%kind)%label)//' '//quoted(element%name)
   end function element_label

end module ek_element
