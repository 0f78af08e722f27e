!> Springs, dampers, stops and bushings of a file as records of a deck, each with the line of its source as a note.
module ek_elastic_deck
   use ek_kinds, only: wp, degree
   use ek_text, only: str
   use ek_point_name, only: point_names
   use ek_axle_facts, only: axle_facts_t, spring_part_t, bushing_part_t
   use ek_deck_parts, only: writing_t, put_point, put_hinge
   implicit none(type, external)
   private
   public :: put_pivot, put_springs, put_rod_bushings, has_springs

   !> The force of the stops of Chrono over the penetration (ChForceFunctors.cpp, "from ADAMS/Car example") [m, N].
   real(wp), parameter :: stop_x(11) = [0.0_wp, 2.0e-3_wp, 4.0e-3_wp, 6.0e-3_wp, 8.0e-3_wp, 10.0e-3_wp, 20.0e-3_wp, &
      30.0e-3_wp, 40.0e-3_wp, 50.0e-3_wp, 60.0e-3_wp]
   real(wp), parameter :: stop_y(11) = [0.0_wp, 200.0_wp, 400.0_wp, 600.0_wp, 800.0_wp, 1000.0_wp, 2500.0_wp, 4500.0_wp, &
      7500.0_wp, 12500.0_wp, 125000.0_wp]
   real(wp), parameter :: idle = 0.1_wp      !! length without force beside the curve of a stop in contact at design [m]

contains

   !> Whether a spring carries the wheel.
   pure logical function has_springs(facts)
      type(axle_facts_t), intent(in) :: facts
      has_springs = any(facts%springs%is_given .and. facts%springs%has_law)
   end function has_springs

   !> Writes the pivot of an arm on the chassis: a hinge, or one bushing in the middle of its two points.
   subroutine put_pivot(body, one, other, at, bushing, writing)
      character(*), intent(in) :: body
      integer, intent(in) :: one, other
      real(wp), intent(in) :: at(:, :)                 !! points, in the frame and the unit of the deck
      type(bushing_part_t), intent(in) :: bushing
      type(writing_t), intent(inout) :: writing

      if (.not. bushing%is_given) then
         call put_hinge(body//'_hinge', body, one, other, writing)
         return
      end if
      call put_point(body//'_middle', 0.5_wp*(at(:, one) + at(:, other)), 'between '//trim(point_names(one))//' and '// &
         trim(point_names(other)), writing)
      call put_bushing(body//'_bushing', 'chassis', body, body//'_middle', [one, other], &
         [bushing%kr, bushing%kr, bushing%kr_free], bushing, writing)
   end subroutine put_pivot

   !> Writes the two bushings of a rod: at its inner end all directions but the spin are free, at its outer end all are.
   subroutine put_rod_bushings(rod, first, ends, bushing, writing)
      character(*), intent(in) :: rod, first           !! bodies: the rod, and that of its inner end
      integer, intent(in) :: ends(2)
      type(bushing_part_t), intent(in) :: bushing
      type(writing_t), intent(inout) :: writing

      call put_bushing(rod//'_inner_bushing', first, rod, trim(point_names(ends(1))), ends, &
         [bushing%kr_free, bushing%kr_free, bushing%kr], bushing, writing)
      call put_bushing(rod//'_outer_bushing', 'carrier', rod, trim(point_names(ends(2))), ends, &
         spread(bushing%kr_free, 1, 3), bushing, writing)
   end subroutine put_rod_bushings

   subroutine put_bushing(name, first, second, at, axis, kr, bushing, writing)
      character(*), intent(in) :: name, first, second, at
      integer, intent(in) :: axis(2)                   !! points of the z axis
      real(wp), intent(in) :: kr(3)                    !! [N m/rad]
      type(bushing_part_t), intent(in) :: bushing
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('bushing')
      call writing%deck%word('name', name)
      call writing%deck%words('bodies', first, second)
      call writing%deck%word('at', at)
      call writing%deck%words('z_axis', trim(point_names(axis(1))), trim(point_names(axis(2))))
      call writing%deck%numbers('kt', spread(bushing%kt/writing%metre, 1, 3))
      call writing%deck%numbers('kr', kr*writing%metre*degree)
      call writing%deck%word('note', source_of(bushing%line, writing))
      call writing%deck%end()
   end subroutine put_bushing

   !> Writes springs, dampers and stops.
   subroutine put_springs(at, facts, writing)
      real(wp), intent(in) :: at(:, :)                 !! points, in the frame and the unit of the deck
      type(axle_facts_t), intent(in) :: facts
      type(writing_t), intent(inout) :: writing
      real(wp) :: length
      integer :: k

      if (.not. any(facts%springs%is_given)) return
      call writing%deck%heading('springs, damper, stops')
      do k = 1, size(facts%springs)
         associate (this => facts%springs(k))
            if (.not. this%is_given) cycle
            if (this%has_law) then
               call put_spring(this, writing)
            else
               call begin_element('damper', trim(this%name), this, writing)
               call end_element(this%line, writing)
            end if
            length = norm2(at(:, this%top) - at(:, this%low))/writing%metre
            if (this%has_stops) call put_stops(this, length, writing)
         end associate
      end do
   end subroutine put_springs

   subroutine put_spring(spring, writing)
      type(spring_part_t), intent(in) :: spring
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: name

      name = trim(spring%name)
      if (allocated(spring%x)) call put_law(name//'_law', spring%x, spring%y, spring%line, writing)
      call begin_element('spring', name, spring, writing)
      if (allocated(spring%x)) then
         call writing%deck%word('curve', name//'_law')
      else
         call writing%deck%number('rate', spring%rate/writing%metre)
      end if
      call writing%deck%number('free_length', spring%free_length*writing%metre)
      call end_element(spring%line, writing)
   end subroutine put_spring

   !> Writes both stops of a spring.
   subroutine put_stops(spring, length, writing)
      type(spring_part_t), intent(in) :: spring
      real(wp), intent(in) :: length                   !! at design [m]
      type(writing_t), intent(inout) :: writing

      call put_law(trim(spring%name)//'_stop_law', stop_x, stop_y, 0, writing)
      call put_stop('bump', length - spring%shortest, spring, writing)
      call put_stop('rebound', spring%longest - length, spring, writing)
   end subroutine put_stops

   !> Writes a stop. A stop in contact at design is a spring without force on the other side of its contact.
   subroutine put_stop(type, clearance, spring, writing)
      character(*), intent(in) :: type
      real(wp), intent(in) :: clearance                !! [m]
      type(spring_part_t), intent(in) :: spring
      type(writing_t), intent(inout) :: writing
      character(:), allocatable :: name

      name = trim(spring%name)//'_'//type
      if (clearance >= 0.0_wp) then
         call begin_element('stop', name, spring, writing)
         call writing%deck%word('type', type)
         call writing%deck%number('clearance', clearance*writing%metre)
         call writing%deck%word('curve', trim(spring%name)//'_stop_law')
      else if (type == 'bump') then
         call put_law(name//'_law', [-idle, stop_x], [0.0_wp, stop_y], 0, writing)
         call begin_element('spring', name, spring, writing)
         call writing%deck%word('curve', name//'_law')
         call writing%deck%number('free_length', spring%shortest*writing%metre)
      else
         call put_law(name//'_law', [-stop_x(size(stop_x):1:-1), idle], [-stop_y(size(stop_y):1:-1), 0.0_wp], 0, writing)
         call begin_element('spring', name, spring, writing)
         call writing%deck%word('curve', name//'_law')
         call writing%deck%number('free_length', spring%longest*writing%metre)
      end if
      call end_element(spring%stop_line, writing)
   end subroutine put_stop

   !> Writes a curve of force over length. Without a line, the curve is that of the program, not of the file.
   subroutine put_law(name, x, y, line, writing)
      character(*), intent(in) :: name
      real(wp), intent(in) :: x(:), y(:)               !! [m, N]
      integer, intent(in) :: line
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('curve')
      call writing%deck%word('name', name)
      call writing%deck%numbers('x', x*writing%metre)
      call writing%deck%numbers('y', y)
      if (line > 0) call writing%deck%word('note', source_of(line, writing))
      if (line == 0) call writing%deck%word('note', 'every stop of Chrono has this curve')
      call writing%deck%end()
   end subroutine put_law

   subroutine begin_element(group, name, spring, writing)
      character(*), intent(in) :: group, name
      type(spring_part_t), intent(in) :: spring
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin(group)
      call writing%deck%word('name', name)
      call writing%deck%words('bodies', trim(spring%body), 'chassis')
      call writing%deck%words('at', trim(point_names(spring%low)), trim(point_names(spring%top)))
   end subroutine begin_element

   subroutine end_element(line, writing)
      integer, intent(in) :: line
      type(writing_t), intent(inout) :: writing

      call writing%deck%word('note', source_of(line, writing))
      call writing%deck%end()
   end subroutine end_element

   !> File and line of a number.
   pure function source_of(line, writing) result(note)
      integer, intent(in) :: line
      type(writing_t), intent(in) :: writing
      character(:), allocatable :: note
      note = writing%file//':'//str(line)
   end function source_of

end module ek_elastic_deck
