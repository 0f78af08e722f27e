!> A scene in space as a gnuplot script, still or moving.
!>
!> gnuplot sorts the faces by depth and shades them.
!>
!> The names in a picture are placed without overlap, inside the picture, near their points, and covering as few drawn lines and
!> faces as possible.
module ek_scene_script
   use ek_kinds, only: wp, millimetre, pi
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_gnuplot, only: begin_scene, end_scene, begin_animation, ink, text_ink, fill, on_part, on_line, on_point, &
      on_leader, on_swatch
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_comment
   use ek_camera, only: camera_t, projection_t, new_projection, in_picture
   use ek_scene, only: scene_t, run_t, part_tyre, line_bump, line_rebound, parts, line_kinds, part_ground, part_plate
   implicit none(type, external)
   private
   public :: scene_script, animation_script, placed_label_t, place_in_scene

   !> A placed name. Positions are shares of the picture's width, from the left, and of its height, from below.
   type :: placed_label_t
      real(wp) :: middle(2) = 0.0_wp, half(2) = 0.0_wp    !! centre of the label; half of its width and of its height
      real(wp) :: foot(2) = 0.0_wp                        !! end, at the label, of the line from the label to its point
      logical :: has_line = .false.
   end type placed_label_t

   ! The picture as pixels: 960 by 640, font size 11
   real(wp), parameter :: pixels(2) = [960.0_wp, 640.0_wp], letter = 6.6_wp, line_height = 15.0_wp
   real(wp), parameter :: margin = 3.0_wp              ! around a text
   real(wp), parameter :: legend_height = 0.115_wp     ! share that is kept free below
   integer, parameter :: cells(2) = [160, 106]         ! of the map of what is drawn
   integer, parameter :: rings = 26, directions = 24   ! tried around a point
   real(wp), parameter :: ring_step = 5.0_wp           ! pixels
   real(wp), parameter :: cover_price = 90.0_wp        ! pixels of distance that a free place is worth more than a covered one

   character(22), parameter :: part_fills(parts) = [character(22) :: 'transparent solid 0.35', 'transparent solid 0.16', &
      'transparent solid 0.22', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid']
   character(16), parameter :: part_names(parts) = [character(16) :: '', 'wheel', '', 'wheel carrier', 'arms', 'rods', &
      'springs', 'struts, dampers', 'bushings', 'joints', 'chassis', 'stops']

   character(*), parameter :: nl = new_line('a'), default_place = "if (!exists('to')) to = '../'"

contains

   !> A gnuplot script that draws one scene as <name>.png and <name>.svg in the folder above the script's folder, unless the
   !> variable `to` gives another folder. With the variable `look`, the script opens a window instead.
   function scene_script(scene, camera, name, title) result(text)
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera
      character(*), intent(in) :: name, title
      character(:), allocatable :: text
      type(buffer_t) :: script

      call script%line(gnuplot_comment(title))
      call script%line(gnuplot_comment('Run gnuplot in this folder to redraw the picture; to rotate it: gnuplot -e "look=1" -p '// &
         name//'.gp'))
      call script%line(default_place)
      call add_style(script, camera)
      call add_blocks(script, scene)
      call begin_scene(script, name)
      call add_splot(script, scene, camera, .true.)
      call end_scene(script, name)
      text = script%text()
   end function scene_script

   !> A gnuplot script that draws a sequence of scenes as <name>.gif, which repeats endlessly, in the folder above the
   !> script's folder, unless the variable `to` gives another folder.
   function animation_script(scenes, captions, camera, name, title) result(text)
      type(scene_t), intent(in) :: scenes(:)
      character(*), intent(in) :: captions(:)
      type(camera_t), intent(in) :: camera
      character(*), intent(in) :: name, title
      character(:), allocatable :: text
      type(buffer_t) :: script
      integer :: k

      call script%line(gnuplot_comment(title//': '//str(size(scenes))//' pictures in sequence'))
      call script%line(default_place)
      call begin_animation(script, name)
      call add_style(script, camera)
      do k = 1, size(scenes)
         call add_blocks(script, scenes(k))
         call script%line('set label 99 '//gnuplot_text(trim(captions(k)))//' at screen 0.03, screen 0.05')
         call add_splot(script, scenes(k), camera, .false.)
      end do
      call script%line('unset output'//nl//'unset label 99')
      text = script%text()
   end function animation_script

   !> Adds the style: equal axes without a box, direction of view, shading.
   pure subroutine add_style(script, camera)
      type(buffer_t), intent(inout) :: script
      type(camera_t), intent(in) :: camera
      integer :: k
      character(1), parameter :: names(3) = ['x', 'y', 'z']

      call script%line('reset'//nl//'set encoding utf8'//nl//'set view equal xyz')
      call script%line('set view '//str(camera%tilt, 4)//', '//str(camera%turn, 4)//', '//str(camera%zoom, 5))
      do k = 1, 3
         call script%line('set '//names(k)//'range ['//str((camera%centre(k) - camera%span/2)/millimetre, 6)//' : '// &
            str((camera%centre(k) + camera%span/2)/millimetre, 6)//']')
      end do
      call script%line('set xyplane at '//str((camera%centre(3) - camera%span/2)/millimetre, 6))
      call script%line('unset border; unset tics; unset key'//nl//'set pm3d depthorder noborder'//nl// &
         'set pm3d lighting primary 0.42 specular 0.12')
   end subroutine add_style

   !> Adds the vertices [mm], one block per kind.
   pure subroutine add_blocks(script, scene)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      integer :: kind

      do kind = 1, parts
         call add_block(script, '$part', scene%faces, kind, nl)   ! gnuplot needs two blank lines between polygons
      end do
      do kind = 1, line_kinds
         call add_block(script, '$line', scene%lines, kind, '')
      end do
   end subroutine add_blocks

   !> Whether a list of faces or lines contains a kind.
   pure logical function has_kind(list, kind)
      type(run_t), intent(in) :: list
      integer, intent(in) :: kind

      has_kind = .false.
      if (list%runs > 0) has_kind = any(list%kind(:list%runs) == kind)
   end function has_kind

   !> Adds the data of all faces or lines of a kind [mm], to 0.1 mm.
   pure subroutine add_block(script, name, list, kind, ending)
      type(buffer_t), intent(inout) :: script
      character(*), intent(in) :: name, ending       !! ending: after each face or line
      type(run_t), intent(in) :: list
      integer, intent(in) :: kind
      character(3*(longest_decimal + 1)) :: line
      integer :: k, vertex, axis, used

      if (.not. has_kind(list, kind)) return
      call script%line(name//str(kind)//' << EOD')
      do k = 1, list%runs
         if (list%kind(k) /= kind) cycle
         do vertex = list%first(k), list%first(k + 1) - 1
            used = 0
            do axis = 1, 3
               call put_decimal(anint(list%at(axis, vertex)*1.0e4_wp)/10.0_wp, line, used)
               used = used + 1
               line(used:used) = ' '
            end do
            call script%line(line(:used - 1))
         end do
         call script%line(ending)
      end do
      call script%line('EOD')
   end subroutine add_block

   !> Adds labels, legend and the splot command.
   subroutine add_splot(script, scene, camera, has_legend)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera
      logical, intent(in) :: has_legend
      character(:), allocatable :: line
      integer :: kind

      call add_labels(script, scene, camera)
      if (has_legend) call add_legend(script, scene)
      line = 'splot '
      do kind = 1, line_kinds
         if (.not. has_kind(scene%lines, kind)) cycle
         call script%line(line//'$line'//str(kind)//" using 1:2:3 with lines"//ink(on_line + kind - 1)// &
            " linewidth 1.3 notitle, \")
         line = '      '
      end do
      do kind = 1, parts
         if (.not. has_kind(scene%faces, kind)) cycle
         call script%line(line//'$part'//str(kind)//' using 1:2:3 with polygons fillstyle '//trim(part_fills(kind))// &
            ' noborder'//fill(on_part + kind - 1)//' notitle, \')
         line = '      '
      end do
      call script%line("      1/0 notitle")
   end subroutine add_splot

   !> Adds the names of points at positions that cover few drawn lines and faces. A name away from its point has a line to the
   !> point.
   subroutine add_labels(script, scene, camera)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera
      type(placed_label_t), allocatable :: placed(:)
      integer :: k

      if (.not. allocated(scene%labels)) return
      call place_in_scene(scene, camera, placed)
      do k = 1, size(placed)
         associate (label => scene%labels(k), to => placed(k))
            call script%line('set label '//str(100 + k)//' '//gnuplot_text(label%text)//' at '//on_screen(to%middle)// &
               " center front font 'sans-serif,11'"//text_ink(on_point))
            if (to%has_line) call script%line('set arrow '//str(100 + k)//' from '//str(label%at(1)/millimetre, 5)//', '// &
               str(label%at(2)/millimetre, 5)//', '//str(label%at(3)/millimetre, 5)//' to '//on_screen(to%foot)// &
               " nohead front linewidth 0.8"//ink(on_leader))
         end associate
      end do
   end subroutine add_labels

   !> A position in the picture as a gnuplot string: shares of the width and of the height [-].
   pure function on_screen(at) result(text)
      real(wp), intent(in) :: at(2)
      character(:), allocatable :: text
      text = 'screen '//str(at(1), 4)//', screen '//str(at(2), 4)
   end function on_screen

   !> Adds colour swatches and labels below the picture. gnuplot's own legend is not used: with several columns, splot drops
   !> entries.
   subroutine add_legend(script, scene)
      type(buffer_t), intent(inout) :: script
      type(scene_t), intent(in) :: scene
      integer :: kind, used

      used = 0
      do kind = 1, parts
         if (has_kind(scene%faces, kind) .and. len_trim(part_names(kind)) > 0) &
            call add_entry(trim(part_names(kind)), &
            merge(on_swatch, on_part + kind - 1, kind == part_tyre), 0.012_wp)     ! a tyre is transparent
      end do
      if (allocated(scene%bump)) call add_entry(scene%bump, on_line + line_bump - 1, 0.003_wp)
      if (allocated(scene%rebound)) call add_entry(scene%rebound, on_line + line_rebound - 1, 0.003_wp)

   contains

      !> Adds one swatch and its label.
      subroutine add_entry(name, role, height)
         character(*), intent(in) :: name
         integer, intent(in) :: role                 !! role of the colour
         real(wp), intent(in) :: height              !! height of the swatch, as a share of the picture
         integer, parameter :: in_a_row = 6
         character(:), allocatable :: at

         at = 'screen '//str(0.045_wp + 0.158_wp*modulo(used, in_a_row), 4)//', screen '// &
            str(0.075_wp - 0.04_wp*(used/in_a_row), 4)
         used = used + 1
         call script%line('set object '//str(used)//' rectangle center '//at//' size screen 0.024, screen '// &
            str(height)//fill(role)//' fillstyle solid noborder')
         call script%line('set label '//str(used)//' '//gnuplot_text(name)//' at '//at// &
            " offset 2.4, 0 font ',12'"//text_ink(on_point))
      end subroutine add_entry

   end subroutine add_legend

   !> Places the names one after the other, each at the position with the lowest cost, given the names already placed. If no
   !> position is free, the name is at its point.
   subroutine place_in_scene(scene, camera, placed)
      type(scene_t), intent(in) :: scene
      type(camera_t), intent(in) :: camera                !! fitted
      type(placed_label_t), allocatable, intent(out) :: placed(:)
      type(projection_t) :: projection
      real(wp), allocatable :: drawn(:, :)
      real(wp) :: anchor(2), half(2), middle(2), away(2), price, least
      integer :: k, ring, direction

      allocate (placed(size(scene%labels)))
      projection = new_projection(camera)
      allocate (drawn(cells(1), cells(2)), source=0.0_wp)
      call mark_faces(scene%faces, projection, drawn)
      call mark_lines(scene%lines, projection, drawn)
      do k = 1, size(placed)
         anchor = in_picture(projection, scene%labels(k)%at)*pixels
         half = [0.5_wp*letter*letters_in(scene%labels(k)%text) + margin, 0.5_wp*line_height]
         least = huge(1.0_wp)
         do ring = 1, rings
            do direction = 0, directions - 1
               away = [cos(2*pi*direction/directions), sin(2*pi*direction/directions)]
               middle = anchor + away*(ring_step*ring + half)
               if (any(middle - half < 0.0_wp) .or. any(middle + half > pixels)) cycle
               if (middle(2) - half(2) < legend_height*pixels(2)) cycle
               if (is_taken(placed(:k - 1), middle, half)) cycle
               price = ring_step*ring + cover_price*covered(drawn, middle, half)
               if (price >= least) cycle
               least = price
               placed(k)%middle = middle
               placed(k)%has_line = ring > 3
            end do
         end do
         if (.not. least < huge(1.0_wp)) placed(k)%middle = anchor      ! no room at all
         placed(k)%half = half
         placed(k)%foot = max(placed(k)%middle - half, min(placed(k)%middle + half, anchor))
      end do
      do k = 1, size(placed)
         placed(k)%middle = placed(k)%middle/pixels
         placed(k)%half = placed(k)%half/pixels
         placed(k)%foot = placed(k)%foot/pixels
      end do
   end subroutine place_in_scene

   !> The number of characters in a UTF-8 string.
   pure integer function letters_in(text)
      character(*), intent(in) :: text
      integer :: k
      letters_in = count([(iand(iachar(text(k:k)), 192) /= 128, k=1, len(text))])
   end function letters_in

   !> Whether a name would overlap a name that is already placed.
   pure logical function is_taken(placed, middle, half)
      type(placed_label_t), intent(in) :: placed(:)
      real(wp), intent(in) :: middle(2), half(2)
      integer :: k

      is_taken = .false.
      do k = 1, size(placed)
         if (all(abs(placed(k)%middle - middle) < placed(k)%half + half)) is_taken = .true.
      end do
   end function is_taken

   !> The mean weight of the cells that a label would cover. A cell in which nothing is drawn has the weight 0.
   pure real(wp) function covered(drawn, middle, half)
      real(wp), intent(in) :: drawn(:, :), middle(2), half(2)
      integer :: low(2), high(2)

      low = cell_of(middle - half)
      high = cell_of(middle + half)
      covered = sum(drawn(low(1):high(1), low(2):high(2)))/product(high - low + 1)
   end function covered

   !> The cell of the picture that contains a position [pixels].
   pure function cell_of(place) result(cell)
      real(wp), intent(in) :: place(2)
      integer :: cell(2)
      cell = max(1, min(cells, ceiling(max(0.0_wp, min(1.0_wp, place/pixels))*cells)))
   end function cell_of

   !> Marks the boxes around faces, which are small. Transparent faces have a lower weight; the road is not marked.
   subroutine mark_faces(faces, projection, drawn)
      type(run_t), intent(in) :: faces
      type(projection_t), intent(in) :: projection
      real(wp), intent(inout) :: drawn(:, :)
      real(wp) :: place(2), least(2), most(2), weight
      integer :: k, v, low(2), high(2)

      do k = 1, faces%runs
         weight = 1.0_wp
         if (faces%kind(k) == part_ground) cycle
         if (faces%kind(k) == part_tyre) weight = 0.25_wp
         if (faces%kind(k) == part_plate) weight = 0.4_wp
         least = huge(1.0_wp)
         most = -huge(1.0_wp)
         do v = faces%first(k), faces%first(k + 1) - 1
            place = in_picture(projection, faces%at(:, v))*pixels
            least = min(least, place)
            most = max(most, place)
         end do
         low = cell_of(least)
         high = cell_of(most)
         drawn(low(1):high(1), low(2):high(2)) = max(weight, drawn(low(1):high(1), low(2):high(2)))
      end do
   end subroutine mark_faces

   !> Marks the cells through which lines pass.
   subroutine mark_lines(lines, projection, drawn)
      type(run_t), intent(in) :: lines
      type(projection_t), intent(in) :: projection
      real(wp), intent(inout) :: drawn(:, :)
      real(wp), parameter :: weight = 0.6_wp
      real(wp) :: from(2), to(2)
      integer :: k, v, n, steps, cell(2)

      do k = 1, lines%runs
         do v = lines%first(k), lines%first(k + 1) - 2
            from = in_picture(projection, lines%at(:, v))*pixels
            to = in_picture(projection, lines%at(:, v + 1))*pixels
            steps = 1 + ceiling(maxval(abs(to - from)/pixels*cells))
            do n = 0, steps
               cell = cell_of(from + (to - from)*n/steps)
               drawn(cell(1), cell(2)) = max(weight, drawn(cell(1), cell(2)))
            end do
         end do
      end do
   end subroutine mark_lines

end module ek_scene_script
