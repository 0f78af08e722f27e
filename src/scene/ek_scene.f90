!> A scene in space: faces, lines and labels, in metres; x rearward, y right, z up.
!>
!> All solids are made of faces, which can be sorted by depth and shaded (see ek_scene_script).
module ek_scene
   use ek_kinds, only: wp, pi
   use ek_rotation, only: cross
   implicit none(type, external)
   private
   public :: scene_t, run_t, add_run, add_label, add_tube, add_surface, add_coil, add_ball
   public :: part_ground, part_tyre, part_plate, part_carrier, part_arm, part_rod, part_spring, part_damper, part_bushing, &
      part_ball, part_mount, part_stop, parts, line_bump, line_rebound, line_ground, line_axes, line_kinds

   integer, parameter :: part_ground = 1, part_tyre = 2, part_plate = 3, part_carrier = 4, part_arm = 5, part_rod = 6, &
      part_spring = 7, part_damper = 8, part_bushing = 9, part_ball = 10, part_mount = 11, part_stop = 12, parts = 12
   integer, parameter :: line_bump = 1, line_rebound = 2, line_ground = 3, line_axes = 4, line_kinds = 4

   !> Faces or lines of a scene. Each face or line is a run of vertices.
   type :: run_t
      real(wp), allocatable :: at(:, :)        !! vertices [m]
      integer, allocatable :: first(:), kind(:)   !! vertices of run k: first(k) … first(k+1) − 1; kind: part_* or line_*
      integer :: runs = 0, used = 0
   end type run_t

   type :: label_t
      real(wp) :: at(3) = 0.0_wp
      character(:), allocatable :: text
   end type label_t

   type :: scene_t
      type(run_t) :: faces, lines
      type(label_t), allocatable :: labels(:)
      character(:), allocatable :: bump, rebound   !! labels of the thin lines; unallocated: none
   end type scene_t

contains

   !> Appends a face (a plane polygon) or a line through points. The storage doubles when it is full.
   pure subroutine add_run(list, kind, at)
      type(run_t), intent(inout) :: list      !! the faces or the lines of a scene
      integer, intent(in) :: kind             !! part_* of a face, line_* of a line
      real(wp), intent(in) :: at(:, :)        !! corners or points (3, n) [m]
      real(wp), allocatable :: more(:, :)
      integer :: n

      n = size(at, 2)
      if (.not. allocated(list%at)) then
         allocate (list%at(3, 4096), list%first(1025), list%kind(1024))
         list%first(1) = 1
      end if
      if (list%used + n > size(list%at, 2)) then
         allocate (more(3, 2*(list%used + n)))
         more(:, :list%used) = list%at(:, :list%used)
         call move_alloc(more, list%at)
      end if
      if (list%runs == size(list%kind)) then
         list%first = [list%first, list%first]
         list%kind = [list%kind, list%kind]
      end if
      list%at(:, list%used + 1:list%used + n) = at
      list%used = list%used + n
      list%runs = list%runs + 1
      list%kind(list%runs) = kind
      list%first(list%runs + 1) = list%used + 1
   end subroutine add_run

   !> Adds the name of a point.
   pure subroutine add_label(scene, at, text)
      type(scene_t), intent(inout) :: scene
      real(wp), intent(in) :: at(3)
      character(*), intent(in) :: text
      type(label_t) :: label

      label%at = at
      label%text = text
      if (.not. allocated(scene%labels)) allocate (scene%labels(0))
      scene%labels = [scene%labels, label]
   end subroutine add_label

   !> Adds a round bar from a to b, closed at both ends. Long bars are made of pieces, because faces are sorted by their middle.
   pure subroutine add_tube(scene, kind, a, b, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: a(3), b(3), radius      !! m
      integer, intent(in) :: sides
      real(wp), parameter :: piece = 0.07_wp          ! m
      real(wp), allocatable :: along(:), round(:)
      real(wp) :: length
      integer :: pieces, k

      length = norm2(b - a)
      if (length < 1.0e-4_wp) return
      pieces = max(1, nint(length/piece))
      along = [0.0_wp, (length*k/pieces, k=0, pieces), length]
      round = [0.0_wp, (radius, k=0, pieces), 0.0_wp]
      call add_surface(scene, kind, a, (b - a)/length, along, round, sides)
   end subroutine add_tube

   !> Adds a surface of revolution, given by the radius at positions along an axis through a point.
   pure subroutine add_surface(scene, kind, base, axis, along, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: base(3), axis(3)        !! m, unit
      real(wp), intent(in) :: along(:), radius(:)     !! m
      integer, intent(in) :: sides
      real(wp) :: u(3), v(3), face(3, 4), now(3), next(3)
      integer :: k, l

      call find_normals(axis, u, v)
      do k = 1, sides
         now = u*cos(2*pi*(k - 1)/sides) + v*sin(2*pi*(k - 1)/sides)
         next = u*cos(2*pi*k/sides) + v*sin(2*pi*k/sides)
         do l = 1, size(along) - 1
            face(:, 1) = base + axis*along(l) + now*radius(l)
            face(:, 2) = base + axis*along(l) + next*radius(l)
            face(:, 3) = base + axis*along(l + 1) + next*radius(l + 1)
            face(:, 4) = base + axis*along(l + 1) + now*radius(l + 1)
            if (radius(l) <= 0.0_wp) then
               call add_run(scene%faces, kind, face(:, 2:4))
            else if (radius(l + 1) <= 0.0_wp) then
               call add_run(scene%faces, kind, face(:, 1:3))
            else
               call add_run(scene%faces, kind, face)
            end if
         end do
      end do
   end subroutine add_surface

   !> Adds a coil spring from a to b, in which 0.6 of a coil is flat at each end.
   pure subroutine add_coil(scene, kind, a, b, radius, wire, coils, per_coil)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: a(3), b(3), radius, wire     !! m
      integer, intent(in) :: coils, per_coil
      integer, parameter :: sides = 4
      real(wp) :: axis(3), u(3), v(3), length, angle, share, out(3), centre(3), ring(3, sides), before(3, sides), face(3, 4)
      integer :: k, n, l, next

      length = norm2(b - a)
      if (length < 1.0e-3_wp) return
      axis = (b - a)/length
      call find_normals(axis, u, v)
      n = coils*per_coil
      do k = 0, n
         angle = 2*pi*real(k, wp)/per_coil
         share = min(1.0_wp, max(0.0_wp, (real(k, wp)/n*(coils) - 0.6_wp)/(coils - 1.2_wp)))   ! flat end coils
         out = u*cos(angle) + v*sin(angle)
         centre = a + axis*(wire + share*(length - 2*wire)) + out*radius
         do l = 1, sides
            ring(:, l) = centre + wire*(out*cos(2*pi*(l - 0.5_wp)/sides) + axis*sin(2*pi*(l - 0.5_wp)/sides))
         end do
         if (k > 0) then
            do l = 1, sides
               next = modulo(l, sides) + 1
               face = reshape([before(:, l), before(:, next), ring(:, next), ring(:, l)], [3, 4])
               call add_run(scene%faces, kind, face)
            end do
         end if
         before = ring
      end do
   end subroutine add_coil

   !> Adds a small sphere.
   pure subroutine add_ball(scene, kind, at, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: at(3), radius
      integer, intent(in) :: sides

      call add_surface(scene, kind, at, [0.0_wp, 0.0_wp, 1.0_wp], radius*[-1.0_wp, -0.6_wp, 0.6_wp, 1.0_wp], &
         radius*[0.0_wp, 0.8_wp, 0.8_wp, 0.0_wp], sides)
   end subroutine add_ball

   !> Finds two unit vectors normal to an axis and to each other.
   pure subroutine find_normals(axis, u, v)
      real(wp), intent(in) :: axis(3)
      real(wp), intent(out) :: u(3), v(3)
      integer :: least

      least = minloc(abs(axis), dim=1)
      u = 0.0_wp
      u(least) = 1.0_wp
      u = u - axis*dot_product(axis, u)
      u = u/norm2(u)
      v = cross(axis, u)
   end subroutine find_normals

end module ek_scene
