!> A scene in space: faces, lines and words, in metres, as a gnuplot script.
!>
!> Everything solid is made of faces, so that gnuplot can sort them by depth and shade them. The script can be turned with
!> the mouse: `gnuplot -p picture.gp` after `set terminal qt`.
!>
!> Frame x rearward, y right, z up. A view is two angles [deg] of gnuplot's `set view`: at turn = 0 one looks to the right
!> of the car from its left, at 270 rearward from its front.
module ek_scene
   use ek_kinds, only: wp
   use ek_units, only: degree, millimetre, pi
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_gnuplot, only: gnuplot_text
   implicit none(type, external)
   private
   public :: scene_t, camera_t, add_face, add_line, add_words, add_tube, add_surface, add_coil, add_ball
   public :: scene_script, animation_script, fit_camera
   public :: part_ground, part_tyre, part_plate, part_carrier, part_arm, part_rod, part_spring, part_damper, part_bushing, &
      part_ball, part_mount, line_bump, line_rebound, line_ground

   integer, parameter :: part_ground = 1, part_tyre = 2, part_plate = 3, part_carrier = 4, part_arm = 5, part_rod = 6, &
      part_spring = 7, part_damper = 8, part_bushing = 9, part_ball = 10, part_mount = 11, parts = 11
   integer, parameter :: line_bump = 1, line_rebound = 2, line_ground = 3, line_kinds = 3

   character(7), parameter :: part_colours(parts) = ['#E9EEF2', '#4A4A4A', '#3B76B5', '#7C8896', '#3B76B5', '#1B9E8A', &
      '#C8442F', '#A9B4C0', '#E8A33D', '#30343B', '#30343B']
   real(wp), parameter :: part_solidity(parts) = [0.35_wp, 0.16_wp, 0.22_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, &
      1.0_wp, 1.0_wp]
   character(16), parameter :: part_names(parts) = [character(16) :: '', 'wheel', '', 'wheel carrier', 'arms', 'rods', &
      'springs', 'struts, dampers', 'bushings', 'joints', 'chassis']
   character(7), parameter :: line_colours(line_kinds) = ['#D55E00', '#009E73', '#C4CCD4']

   !> Faces and lines as runs of vertices.
   type :: run_t
      real(wp), allocatable :: at(:, :)        !! vertices [m]
      integer, allocatable :: first(:), kind(:)   !! first(k) … first(k+1) − 1 are the vertices of run k
      integer :: runs = 0, used = 0
   end type run_t

   type :: words_t
      real(wp) :: at(3) = 0.0_wp
      real(wp) :: aside = 0.0_wp               !! letters to the right
      character(:), allocatable :: text
   end type words_t

   type :: scene_t
      type(run_t) :: faces, lines
      type(words_t), allocatable :: words(:)
      integer :: labels = 0
      character(:), allocatable :: bump, rebound   !! legend of the thin lines; unallocated: none
   end type scene_t

   !> From where and how large.
   type :: camera_t
      real(wp) :: tilt = 68.0_wp, turn = 300.0_wp       !! deg
      real(wp) :: centre(3) = 0.0_wp                    !! m, in the middle of the picture
      real(wp) :: span = 1.0_wp                         !! m, edge of the cube that gnuplot is told of
      real(wp) :: zoom = 1.0_wp                         !! third number of `set view`
   end type camera_t

contains

   !> A plane polygon.
   pure subroutine add_face(scene, kind, at)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind             !! part_*
      real(wp), intent(in) :: at(:, :)        !! corners (3, n) [m]
      call add_run(scene%faces, kind, at)
   end subroutine add_face

   !> A line through points.
   pure subroutine add_line(scene, kind, at)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind             !! line_*
      real(wp), intent(in) :: at(:, :)
      call add_run(scene%lines, kind, at)
   end subroutine add_line

   pure subroutine add_run(list, kind, at)
      type(run_t), intent(inout) :: list
      integer, intent(in) :: kind
      real(wp), intent(in) :: at(:, :)
      real(wp), allocatable :: more(:, :)
      integer, allocatable :: first(:), kinds(:)
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
         allocate (first(2*list%runs + 1), kinds(2*list%runs))
         first(:list%runs + 1) = list%first
         kinds(:list%runs) = list%kind
         call move_alloc(first, list%first)
         call move_alloc(kinds, list%kind)
      end if
      list%at(:, list%used + 1:list%used + n) = at
      list%used = list%used + n
      list%runs = list%runs + 1
      list%kind(list%runs) = kind
      list%first(list%runs + 1) = list%used + 1
   end subroutine add_run

   !> Small letters at a point.
   pure subroutine add_words(scene, at, text, aside)
      type(scene_t), intent(inout) :: scene
      real(wp), intent(in) :: at(3)
      character(*), intent(in) :: text
      real(wp), intent(in), optional :: aside    !! letters to the right of the point; none: 0.6
      type(words_t), allocatable :: grown(:)

      if (.not. allocated(scene%words)) allocate (scene%words(16))
      if (scene%labels == size(scene%words)) then
         allocate (grown(2*scene%labels))
         grown(:scene%labels) = scene%words
         call move_alloc(grown, scene%words)
      end if
      scene%labels = scene%labels + 1
      scene%words(scene%labels)%at = at
      scene%words(scene%labels)%text = text
      scene%words(scene%labels)%aside = 0.6_wp
      if (present(aside)) scene%words(scene%labels)%aside = aside
   end subroutine add_words

   !> A round bar from a to b, closed at both ends. Long ones are made of pieces: faces are sorted by their middle.
   pure subroutine add_tube(scene, kind, a, b, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: a(3), b(3), radius      !! m
      integer, intent(in), optional :: sides
      real(wp), parameter :: piece = 0.07_wp          ! m
      real(wp), allocatable :: along(:), round(:)
      real(wp) :: length
      integer :: pieces, k

      length = norm2(b - a)
      if (length < 1.0e-4_wp) return
      pieces = max(1, nint(length/piece))
      allocate (along(pieces + 3), round(pieces + 3))
      along(1) = 0.0_wp
      along(pieces + 3) = length
      round = radius
      round(1) = 0.0_wp
      round(pieces + 3) = 0.0_wp
      do k = 0, pieces
         along(k + 2) = length*k/pieces
      end do
      call add_surface(scene, kind, a, (b - a)/length, along, round, sides)
   end subroutine add_tube

   !> A surface of revolution: radius at places along an axis through a point.
   pure subroutine add_surface(scene, kind, base, axis, along, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: base(3), axis(3)        !! m, unit
      real(wp), intent(in) :: along(:), radius(:)     !! m
      integer, intent(in), optional :: sides
      real(wp) :: u(3), v(3), face(3, 4), now(3), next(3)
      integer :: n, k, l

      n = 7
      if (present(sides)) n = sides
      call across(axis, u, v)
      do k = 1, n
         now = u*cos(2*pi*(k - 1)/n) + v*sin(2*pi*(k - 1)/n)
         next = u*cos(2*pi*k/n) + v*sin(2*pi*k/n)
         do l = 1, size(along) - 1
            face(:, 1) = base + axis*along(l) + now*radius(l)
            face(:, 2) = base + axis*along(l) + next*radius(l)
            face(:, 3) = base + axis*along(l + 1) + next*radius(l + 1)
            face(:, 4) = base + axis*along(l + 1) + now*radius(l + 1)
            if (radius(l) <= 0.0_wp) then
               call add_face(scene, kind, face(:, 2:4))
            else if (radius(l + 1) <= 0.0_wp) then
               call add_face(scene, kind, face(:, 1:3))
            else
               call add_face(scene, kind, face)
            end if
         end do
      end do
   end subroutine add_surface

   !> A coil spring from a to b, closed and ground at its ends.
   pure subroutine add_coil(scene, kind, a, b, radius, wire, coils, per_coil)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: a(3), b(3), radius, wire     !! m
      integer, intent(in) :: coils, per_coil
      integer, parameter :: sides = 4
      real(wp) :: axis(3), u(3), v(3), length, angle, share, out(3), centre(3), ring(3, sides), before(3, sides), face(3, 4)
      integer :: k, n, l

      length = norm2(b - a)
      if (length < 1.0e-3_wp) return
      axis = (b - a)/length
      call across(axis, u, v)
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
               face(:, 1) = before(:, l)
               face(:, 2) = before(:, modulo(l, sides) + 1)
               face(:, 3) = ring(:, modulo(l, sides) + 1)
               face(:, 4) = ring(:, l)
               call add_face(scene, kind, face)
            end do
         end if
         before = ring
      end do
   end subroutine add_coil

   !> A small ball.
   pure subroutine add_ball(scene, kind, at, radius, sides)
      type(scene_t), intent(inout) :: scene
      integer, intent(in) :: kind
      real(wp), intent(in) :: at(3), radius
      integer, intent(in), optional :: sides

      call add_surface(scene, kind, at, [0.0_wp, 0.0_wp, 1.0_wp], radius*[-1.0_wp, -0.6_wp, 0.6_wp, 1.0_wp], &
         radius*[0.0_wp, 0.8_wp, 0.8_wp, 0.0_wp], sides)
   end subroutine add_ball

   !> Two unit vectors across an axis.
   pure subroutine across(axis, u, v)
      real(wp), intent(in) :: axis(3)
      real(wp), intent(out) :: u(3), v(3)
      integer :: least

      least = minloc(abs(axis), dim=1)
      u = 0.0_wp
      u(least) = 1.0_wp
      u = u - axis*dot_product(axis, u)
      u = u/norm2(u)
      v = [axis(2)*u(3) - axis(3)*u(2), axis(3)*u(1) - axis(1)*u(3), axis(1)*u(2) - axis(2)*u(1)]
   end subroutine across

   !> Sets centre, span and zoom so that all faces and lines of some scenes fill a picture of this shape.
   !>
   !> gnuplot draws the longest edge of its box a certain share of the shorter side of the picture long, times the zoom.
   subroutine fit_camera(camera, scenes, width, height, footer)
      type(camera_t), intent(inout) :: camera     !! tilt and turn are given
      type(scene_t), intent(in) :: scenes(:)
      real(wp), intent(in) :: width, height       !! of the picture, any unit
      real(wp), intent(in) :: footer              !! share of the height that is kept free below
      real(wp), parameter :: box_share = 0.507_wp      ! measured with gnuplot 5.4, and letters of 12 to 13
      real(wp), parameter :: above_middle = 0.014_wp   ! where it puts the centre, in heights of the picture; likewise
      real(wp) :: right(3), up(3), low(2), high(2), p(2), scale
      integer :: s, k

      right = [cos(camera%turn*degree), sin(camera%turn*degree), 0.0_wp]
      up = [-sin(camera%turn*degree)*cos(camera%tilt*degree), cos(camera%turn*degree)*cos(camera%tilt*degree), &
         sin(camera%tilt*degree)]
      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      camera%span = 0.1_wp
      do s = 1, size(scenes)
         do k = 1, scenes(s)%faces%used
            call include(scenes(s)%faces%at(:, k))
         end do
         do k = 1, scenes(s)%lines%used
            call include(scenes(s)%lines%at(:, k))
         end do
      end do
      if (low(1) > high(1)) return
      p = (low + high)/2
      scale = 0.95_wp*min(width/max(high(1) - low(1), 1.0e-3_wp), height*(1 - footer)/max(high(2) - low(2), 1.0e-3_wp))
      camera%centre = right*p(1) + up*(p(2) - (footer/2 - above_middle)*height/scale)
      ! the box must hold every vertex, or gnuplot would cut there
      do s = 1, size(scenes)
         do k = 1, scenes(s)%faces%used
            camera%span = max(camera%span, 2.1_wp*maxval(abs(scenes(s)%faces%at(:, k) - camera%centre)))
         end do
         do k = 1, scenes(s)%lines%used
            camera%span = max(camera%span, 2.1_wp*maxval(abs(scenes(s)%lines%at(:, k) - camera%centre)))
         end do
      end do
      camera%zoom = scale*camera%span/(box_share*min(width, height))

   contains

      subroutine include(at)
         real(wp), intent(in) :: at(3)
         p = [dot_product(right, at), dot_product(up, at)]
         low = min(low, p)
         high = max(high, p)
      end subroutine include

   end subroutine fit_camera

   !> A script that draws one scene as <name>.png and <name>.svg.
   pure function scene_script(scene, camera, name, title) result(text)
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera
      character(*), intent(in) :: name, title
      character(:), allocatable :: text
      type(buffer_t) :: script

      call script%line('# '//title)
      call script%line('# Run gnuplot in this folder to draw it again; to turn it: gnuplot -e "look=1" -p '//name//'.gp')
      call add_look(script, camera)
      call add_blocks(script, scene)
      call script%line("if (exists('look')) { set terminal qt size 1200, 800; set mouse } "// &
         "else { set terminal svg size 960, 640 dynamic font 'sans-serif,13' noenhanced; set output "// &
         gnuplot_text(name//'.svg')//' }')
      call add_splot(script, scene, .true.)
      call script%line("if (!exists('look')) { set terminal pngcairo size 1440, 960 font 'sans-serif,13' fontscale 1.25 "// &
         'linewidth 1.5 noenhanced; set output '//gnuplot_text(name//'.png')//'; replot; unset output }')
      text = script%text()
   end function scene_script

   !> A script that draws scenes one after the other as <name>.gif, for ever.
   pure function animation_script(scenes, captions, camera, name, title) result(text)
      type(scene_t), intent(in) :: scenes(:)
      character(*), intent(in) :: captions(:)
      type(camera_t), intent(in) :: camera
      character(*), intent(in) :: name, title
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k

      call script%line('# '//title//': '//str(size(scenes))//' pictures, one after the other')
      call script%line('set terminal gif animate delay 7 loop 0 size 720, 540 font ''sans,12'' noenhanced')
      call script%line('set output '//gnuplot_text(name//'.gif'))
      call add_look(script, camera)
      do k = 1, size(scenes)
         call add_blocks(script, scenes(k))
         call script%line('set label 99 '//gnuplot_text(trim(captions(k)))//' at screen 0.03, screen 0.05')
         call add_splot(script, scenes(k), .false.)
      end do
      call script%line('unset output')
      call script%line('unset label 99')
      text = script%text()
   end function animation_script

   !> Equal axes without box, view, shading.
   pure subroutine add_look(script, camera)
      type(buffer_t), intent(inout) :: script
      type(camera_t), intent(in) :: camera
      integer :: k
      character(1), parameter :: names(3) = ['x', 'y', 'z']

      call script%line('reset')
      call script%line('set encoding utf8')
      call script%line('set view equal xyz')
      call script%line('set view '//str(camera%tilt, 4)//', '//str(camera%turn, 4)//', '//str(camera%zoom, 5))
      do k = 1, 3
         call script%line('set '//names(k)//'range ['//str((camera%centre(k) - camera%span/2)/millimetre, 6)//' : '// &
            str((camera%centre(k) + camera%span/2)/millimetre, 6)//']')
      end do
      call script%line('set xyplane at '//str((camera%centre(3) - camera%span/2)/millimetre, 6))
      call script%line('unset border; unset tics; unset key')
      call script%line('set pm3d depthorder noborder')
      call script%line('set pm3d lighting primary 0.42 specular 0.12')
   end subroutine add_look

   !> The vertices [mm], one block a kind.
   pure subroutine add_blocks(script, scene)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      integer :: kind

      do kind = 1, parts
         if (has_kind(scene%faces, kind)) call add_block(script, '$part'//str(kind), scene%faces, kind, .true.)
      end do
      do kind = 1, line_kinds
         if (has_kind(scene%lines, kind)) call add_block(script, '$line'//str(kind), scene%lines, kind, .false.)
      end do
   end subroutine add_blocks

   pure logical function has_kind(list, kind)
      type(run_t), intent(in) :: list
      integer, intent(in) :: kind

      has_kind = .false.
      if (list%runs > 0) has_kind = any(list%kind(:list%runs) == kind)
   end function has_kind

   pure subroutine add_block(script, name, list, kind, is_closed)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name
      type(run_t), intent(in) :: list
      integer, intent(in) :: kind
      logical, intent(in) :: is_closed       !! polygons: gnuplot wants two blank lines between them
      character(3*longest_decimal + 3) :: line
      integer :: k, vertex, axis, used

      call script%line(name//' << EOD')
      do k = 1, list%runs
         if (list%kind(k) /= kind) cycle
         do vertex = list%first(k), list%first(k + 1) - 1
            used = 0
            do axis = 1, 3
               if (axis > 1) then
                  used = used + 1
                  line(used:used) = ' '
               end if
               call put_decimal(anint(list%at(axis, vertex)*1.0e4_wp)/10.0_wp, line, used)   ! to 0.1 mm
            end do
            call script%line(line(:used))
         end do
         call script%line('')
         if (is_closed) call script%line('')
      end do
      call script%line('EOD')
   end subroutine add_block

   !> Labels, legend and the splot command.
   pure subroutine add_splot(script, scene, has_legend)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      logical, intent(in) :: has_legend
      character(:), allocatable :: line
      integer :: kind, k

      do k = 1, scene%labels
         call script%line('set label '//str(100 + k)//' '//gnuplot_text(scene%words(k)%text)//' at '// &
            str(scene%words(k)%at(1)/millimetre, 5)//', '//str(scene%words(k)%at(2)/millimetre, 5)//', '// &
            str(scene%words(k)%at(3)/millimetre, 5)//" front font ',11' textcolor rgb '#30343B' offset "// &
            str(scene%words(k)%aside, 3)//', 0.5')
      end do
      if (has_legend) call add_legend(script, scene)
      line = 'splot '
      do kind = 1, line_kinds
         if (.not. has_kind(scene%lines, kind)) cycle
         call script%line(line//'$line'//str(kind)//" using 1:2:3 with lines linecolor rgb '"//line_colours(kind)// &
            "' linewidth 1.3 notitle, \")
         line = '      '
      end do
      do kind = 1, parts
         if (.not. has_kind(scene%faces, kind)) cycle
         call script%line(line//'$part'//str(kind)//' using 1:2:3 with polygons '//fill(kind)//' notitle, \')
         line = '      '
      end do
      call script%line("      1/0 notitle")
   end subroutine add_splot

   !> Swatches and names below the picture. (gnuplot's own legend loses entries in splot when it has several columns.)
   pure subroutine add_legend(script, scene)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      integer, parameter :: in_a_row = 6
      integer :: kind, used

      used = 0
      do kind = 1, parts
         if (has_kind(scene%faces, kind) .and. len_trim(part_names(kind)) > 0) &
            call add_entry(script, used, trim(part_names(kind)), key_colour(kind), 0.012_wp, in_a_row)
      end do
      if (allocated(scene%bump)) call add_entry(script, used, scene%bump, line_colours(line_bump), 0.003_wp, in_a_row)
      if (allocated(scene%rebound)) call add_entry(script, used, scene%rebound, line_colours(line_rebound), 0.003_wp, in_a_row)
   end subroutine add_legend

   !> One swatch and its name.
   pure subroutine add_entry(script, used, name, colour, height, in_a_row)
      type(buffer_t), intent(inout) :: script
      integer, intent(inout) :: used
      character(*), intent(in) :: name, colour
      real(wp), intent(in) :: height              !! of the swatch, share of the picture
      integer, intent(in) :: in_a_row
      character(:), allocatable :: x, y

      x = str(0.045_wp + 0.158_wp*modulo(used, in_a_row), 4)
      y = str(0.075_wp - 0.04_wp*(used/in_a_row), 4)
      used = used + 1
      call script%line('set object '//str(used)//' rectangle center screen '//x//', screen '//y//' size screen 0.024, screen '// &
         str(height)//" fillcolor rgb '"//colour//"' fillstyle solid noborder")
      call script%line('set label '//str(used)//' '//gnuplot_text(name)//' at screen '//x//', screen '//y// &
         " offset 2.4, 0 font ',12' textcolor rgb '#30343B'")
   end subroutine add_entry

   !> The colour of a part on white.
   pure function key_colour(kind) result(colour)
      integer, intent(in) :: kind
      character(7) :: colour
      colour = part_colours(kind)
      if (kind == part_tyre) colour = '#CCCCCC'
   end function key_colour

   pure function fill(kind) result(words)
      integer, intent(in) :: kind
      character(:), allocatable :: words

      if (part_solidity(kind) < 1.0_wp) then
         words = 'fillstyle transparent solid '//str(part_solidity(kind), 2)//' noborder'
      else
         words = 'fillstyle solid noborder'
      end if
      words = words//" fillcolor rgb '"//part_colours(kind)//"'"
   end function fill

end module ek_scene
