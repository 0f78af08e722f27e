!> Elastic elements of one measure: springs, dampers, stops along a distance, torsion springs about an axis, springs on
!> any other measure.
!>
!> | kind    | tension T (dV/dvalue)                                                                 |
!> |---------|---------------------------------------------------------------------------------------|
!> | spring  | rate (L − L_design) − preload, or −c(compression) − preload with a curve              |
!> | damper  | gas_rate (L − L_design) − gas_force; damping does not act in statics                  |
!> | stop    | −f(e), e = (L_design − clearance) − L (bump); f(e), e = L − (L_design + clearance) (rebound) |
!> | torsion | rate φ − preload, or c(φ) − preload; φ = m·θ, the rotation about its axis             |
!> | measure | as a spring, of a gap; as a torsion spring, of a rotation or a cosine, φ = value − design value |
!>
!> f is one-sided and rounded (ek_law). The force ON the bodies is −T × gradient of the measure.
module ek_spring
   use ek_kinds, only: wp
   use ek_measure, only: measure_t, view_t, axis_axis, distance, rotation, add_measure_hessian
   use ek_block, only: add_link_stiffness, add_diagonal_block, add_block, s_matrix, dyad
   use ek_curve, only: curve_t
   use ek_law, only: law_t, look_up_law
   implicit none(type, external)
   private
   public :: spring_t, new_spring, new_damper, new_stop, new_torsion, new_measure_spring, set_measure_design
   public :: axial_spring, damper, stop_spring, torsion_spring, measure_spring, is_of_angle
   public :: spring_tension, add_spring_tangent, add_torsion_tangent, add_torsion_material, add_measure_material

   integer, parameter :: axial_spring = 1    !! its preload may be set by balance
   integer, parameter :: damper = 2
   integer, parameter :: stop_spring = 3
   integer, parameter :: torsion_spring = 4
   integer, parameter :: measure_spring = 5  !! on a gap, a rotation or a cosine; keeps its preload

   !> An elastic element on one distance or rotation.
   type :: spring_t
      character(:), allocatable :: name, where
      integer :: kind = axial_spring
      type(measure_t) :: measure            !! the length, angle or other measure on which it acts
      real(wp) :: rate = 0.0_wp             !! N/m, N m/rad; used if has_law is .false.
      real(wp) :: design_length = 0.0_wp    !! value at design: m, rad, -; 0 rad for a torsion spring
      real(wp) :: preload = 0.0_wp          !! compression at design [N], moment on body j about the axis [N m]
      logical :: is_balanced = .true.       !! spring: balance may change its preload
      logical :: has_law = .false.          !! `law` replaces rate and design length
      type(law_t) :: law
   end type spring_t

contains

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
      type(spring_t) :: spring

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
      type(spring_t) :: spring

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
      type(spring_t) :: spring

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
      type(spring_t) :: spring

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
      type(spring_t) :: spring

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
      type(spring_t), intent(inout) :: spring
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
      type(spring_t) :: spring

      spring%name = name
      spring%where = where
      spring%measure = measure_t(kind=distance, body_i=body_i, body_j=body_j, arm_i=point_i, arm_j=point_j)
      spring%design_length = norm2(point_j - point_i)
   end function axial

   !> Tension at a length, and its slope dT/dL; for a torsion spring, the moment at an angle.
   !> Equation (M.14) of docs/theory/measures.md.
   pure subroutine spring_tension(spring, length, tension, slope)
      type(spring_t), intent(in) :: spring
      real(wp), intent(in) :: length    !! m, rad
      real(wp), intent(out) :: tension  !! N, pulls the ends together; N m, reduces the angle
      real(wp), intent(out) :: slope    !! N/m, N m/rad

      if (spring%has_law) then
         call look_up_law(spring%law, length, tension, slope)
         tension = tension - spring%preload
      else
         tension = spring%rate*(length - spring%design_length) - spring%preload
         slope = spring%rate
      end if
   end subroutine spring_tension

   !> Adds Jᵀ[slope e eᵀ + tension/L (I − e eᵀ)]J and the arm terms of the distance's Hessian.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_spring_tangent(view, tension, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view       !! of the spring's measure
      real(wp), intent(in) :: tension, slope
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: m(3, 3), pull(3), across
      integer :: k

      across = tension/view%value
      do k = 1, 3
         m(:, k) = ((slope - across)*view%u(k))*view%u
         m(k, k) = m(k, k) + across
      end do
      call add_link_stiffness(m, view%a, view%b, at_i, at_j, ld, matrix)
      pull = tension*view%u
      call add_diagonal_block(-s_matrix(view%a, pull), at_i + 3, at_i, ld, matrix)
      call add_diagonal_block(s_matrix(view%b, pull), at_j + 3, at_j, ld, matrix)
   end subroutine add_spring_tangent

   !> Adds slope g gᵀ + moment × Hessian of the rotation.
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_torsion_tangent(view, moment, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view       !! of the spring's measure
      real(wp), intent(in) :: moment, slope  !! N m, N m/rad
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      call add_torsion_material(view, slope, at_i, at_j, ld, matrix)
      call add_measure_hessian(rotation, view, moment, at_i, at_j, ld, matrix)
   end subroutine add_torsion_tangent

   !> Adds slope g gᵀ alone, g = [0, −v, 0, v].
   pure subroutine add_torsion_material(view, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view
      real(wp), intent(in) :: slope
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: k(3, 3), pull(3)

      pull = slope*view%v
      k = dyad(pull, view%v)
      call add_diagonal_block(k, at_i + 3, at_i, ld, matrix)
      call add_diagonal_block(k, at_j + 3, at_j, ld, matrix)
      if (at_i >= 0 .and. at_j >= 0) call add_block(-k, at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_torsion_material

   !> Adds slope g gᵀ of any measure: the material part of its tangent (the other part is tension × Hessian).
   !> Equation (M.13) of docs/theory/measures.md.
   pure subroutine add_measure_material(view, slope, at_i, at_j, ld, matrix)
      type(view_t), intent(in) :: view        !! of the spring's measure
      real(wp), intent(in) :: slope           !! N/m, N m/rad, N m
      integer, intent(in) :: at_i, at_j, ld
      real(wp), intent(inout) :: matrix(ld, *)

      call add_own(slope, view%gradient(1:6), at_i, ld, matrix)
      call add_own(slope, view%gradient(7:12), at_j, ld, matrix)
      if (at_i < 0 .or. at_j < 0) return
      call add_dyad(slope, view%gradient(1:3), view%gradient(7:9), at_i, at_j, ld, matrix)
      call add_dyad(slope, view%gradient(1:3), view%gradient(10:12), at_i, at_j + 3, ld, matrix)
      call add_dyad(slope, view%gradient(4:6), view%gradient(7:9), at_i + 3, at_j, ld, matrix)
      call add_dyad(slope, view%gradient(4:6), view%gradient(10:12), at_i + 3, at_j + 3, ld, matrix)
   end subroutine add_measure_material

   !> Adds slope g gᵀ of one body.
   pure subroutine add_own(slope, gradient, at, ld, matrix)
      real(wp), intent(in) :: slope, gradient(6)
      integer, intent(in) :: at, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: scaled(3), block(3, 3)

      if (at < 0) return
      scaled = slope*gradient(1:3)
      block = dyad(scaled, gradient(1:3))
      call add_diagonal_block(block, at, at, ld, matrix)
      scaled = slope*gradient(4:6)
      block = dyad(scaled, gradient(4:6))
      call add_diagonal_block(block, at + 3, at, ld, matrix)
      call add_dyad(slope, gradient(1:3), gradient(4:6), at, at + 3, ld, matrix)
   end subroutine add_own

   !> Adds slope p qᵀ to the rows after `row` and the columns after `column`, off the diagonal.
   pure subroutine add_dyad(slope, p, q, row, column, ld, matrix)
      real(wp), intent(in) :: slope, p(3), q(3)
      integer, intent(in) :: row, column, ld
      real(wp), intent(inout) :: matrix(ld, *)
      real(wp) :: scaled(3), block(3, 3)

      scaled = slope*p
      block = dyad(scaled, q)
      call add_block(block, row, column, ld, matrix)
   end subroutine add_dyad

end module ek_spring
