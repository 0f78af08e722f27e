!> A scene in space as a gnuplot script, still or moving.
!>
!> gnuplot sorts the faces by depth and shades them.
module ek_scene_script
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_decimal, only: put_decimal, longest_decimal
   use ek_gnuplot_text, only: gnuplot_text, gnuplot_comment
   use ek_camera, only: camera_t
   use ek_scene, only: scene_t, run_t, part_tyre, line_bump, line_rebound, parts, line_kinds
   use ek_scene_labels, only: placed_label_t, place_in_scene
   implicit none(type, external)
   private
   public :: scene_script, animation_script

   character(7), parameter :: part_colours(parts) = ['#E9EEF2', '#4A4A4A', '#3B76B5', '#7C8896', '#3B76B5', '#1B9E8A', &
      '#C8442F', '#A9B4C0', '#E8A33D', '#30343B', '#30343B', '#8E6BBE']
   character(22), parameter :: part_fills(parts) = [character(22) :: 'transparent solid 0.35', 'transparent solid 0.16', &
      'transparent solid 0.22', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid', 'solid']
   character(16), parameter :: part_names(parts) = [character(16) :: '', 'wheel', '', 'wheel carrier', 'arms', 'rods', &
      'springs', 'struts, dampers', 'bushings', 'joints', 'chassis', 'stops']
   character(7), parameter :: line_colours(line_kinds) = ['#D55E00', '#009E73', '#C4CCD4', '#30343B']

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
      call script%line("if (exists('look')) { set terminal qt size 1200, 800; set mouse } "// &
         "else { set terminal svg size 960, 640 dynamic font 'sans-serif,13' noenhanced; set output "// &
         'to.'//gnuplot_text(name//'.svg')//' }')
      call add_splot(script, scene, camera, .true.)
      call script%line("if (!exists('look')) { set terminal pngcairo size 1440, 960 font 'sans-serif,13' fontscale 1.25 "// &
         'linewidth 1.5 noenhanced; set output to.'//gnuplot_text(name//'.png')//'; replot; unset output }')
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
      call script%line('set terminal gif animate delay 7 loop 0 size 720, 540 font ''sans,12'' noenhanced')
      call script%line('set output to.'//gnuplot_text(name//'.gif'))
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
         call script%line(line//'$line'//str(kind)//" using 1:2:3 with lines linecolor rgb '"//line_colours(kind)// &
            "' linewidth 1.3 notitle, \")
         line = '      '
      end do
      do kind = 1, parts
         if (.not. has_kind(scene%faces, kind)) cycle
         call script%line(line//'$part'//str(kind)//' using 1:2:3 with polygons fillstyle '//trim(part_fills(kind))// &
            " noborder fillcolor rgb '"//part_colours(kind)//"' notitle, \")
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
               " center front font 'sans-serif,11' textcolor rgb '#30343B'")
            if (to%has_line) call script%line('set arrow '//str(100 + k)//' from '//str(label%at(1)/millimetre, 5)//', '// &
               str(label%at(2)/millimetre, 5)//', '//str(label%at(3)/millimetre, 5)//' to '//on_screen(to%foot)// &
               " nohead front linewidth 0.8 linecolor rgb '#7C8896'")
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
            merge('#CCCCCC', part_colours(kind), kind == part_tyre), 0.012_wp)     ! a tyre is transparent
      end do
      if (allocated(scene%bump)) call add_entry(scene%bump, line_colours(line_bump), 0.003_wp)
      if (allocated(scene%rebound)) call add_entry(scene%rebound, line_colours(line_rebound), 0.003_wp)

   contains

      !> Adds one swatch and its label.
      subroutine add_entry(name, colour, height)
         character(*), intent(in) :: name, colour
         real(wp), intent(in) :: height              !! height of the swatch, as a share of the picture
         integer, parameter :: in_a_row = 6
         character(:), allocatable :: at

         at = 'screen '//str(0.045_wp + 0.158_wp*modulo(used, in_a_row), 4)//', screen '// &
            str(0.075_wp - 0.04_wp*(used/in_a_row), 4)
         used = used + 1
         call script%line('set object '//str(used)//' rectangle center '//at//' size screen 0.024, screen '// &
            str(height)//" fillcolor rgb '"//colour//"' fillstyle solid noborder")
         call script%line('set label '//str(used)//' '//gnuplot_text(name)//' at '//at// &
            " offset 2.4, 0 font ',12' textcolor rgb '#30343B'")
      end subroutine add_entry

   end subroutine add_legend

end module ek_scene_script
