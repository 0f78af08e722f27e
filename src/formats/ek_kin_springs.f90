!> The springs, push or pull rods and the anti-roll bar of an axle of IPGKinematics as groups of a deck.
module ek_kin_springs
   use ek_kinds, only: wp, millimetre, degree
   use ek_flaws, only: flaws_t
   use ek_law_points, only: law_points_t, add_point, finish_law
   use ek_deck_text, only: deck_text_t
   use ek_law_text, only: put_curve
   use ek_kin, only: kin_t, kin_curve_t, off
   implicit none(type, external)
   private
   public :: put_springs

contains

   !> Writes the springs of the axle and the torsion spring of the bar into the deck, with the curves of all springs.
   subroutine put_springs(deck, kin, flaws)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(flaws_t), intent(inout) :: flaws
      character(*), parameter :: places(3) = [character(9) :: 'lower_arm', 'carrier', 'upper_arm']

      call deck%heading('springs')
      if (kin%spring /= off) then
         call put_spring(deck, 'coil', trim(places(kin%spring)), 'chassis', 'spring_wheel', 'spring_body', kin%coil, flaws)
      else
         call put_spring(deck, 'push_rod', trim(places(kin%rod)), 'rocker', 'push_rod_wheel', 'push_rod_rocker', kin%rod_law, flaws)
         call put_spring(deck, 'coil', 'rocker', 'chassis', 'spring_rocker', 'spring_body', kin%coil, flaws)
      end if
      if (kin%bar == off) return
      call put_curve_of(deck, 'bar_torsion', kin%bar_law, degree, 4, flaws)
      call deck%begin('torsion')
      call deck%word('name', 'bar_torsion')
      call deck%words('bodies', 'left_bar', 'right_bar')
      call deck%numbers('axis_vector', [0.0_wp, 1.0_wp, 0.0_wp])
      if (kin%bar_law%has_points) then
         call deck%word('curve', 'bar_torsion_law')
      else
         call deck%number('rate', kin%bar_law%rate*1000)
      end if
      call deck%end()
   end subroutine put_springs

   subroutine put_spring(deck, name, first, second, from, to, law, flaws)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, first, second, from, to
      type(kin_curve_t), intent(in) :: law
      type(flaws_t), intent(inout) :: flaws

      call put_curve_of(deck, name, law, millimetre, 1, flaws)
      call deck%begin('spring')
      call deck%word('name', name)
      call deck%words('bodies', first, second)
      call deck%words('at', from, to)
      if (law%has_points) then
         call deck%word('curve', name//'_law')
      else
         call deck%number('rate', law%rate)
      end if
      call deck%end()
   end subroutine put_spring

   !> Writes the curve of a law with points, named <name>_law. Nothing is written for a rate.
   subroutine put_curve_of(deck, name, law, x_unit, component, flaws)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name
      type(kin_curve_t), intent(in) :: law
      real(wp), intent(in) :: x_unit
      integer, intent(in) :: component       !! 1 for a force, 4 for a moment
      type(flaws_t), intent(inout) :: flaws
      type(law_points_t) :: points
      integer :: k

      if (.not. law%has_points) return
      points%line = law%line
      do k = 1, size(law%x)
         call add_point(points, law%x(k)*x_unit, law%y(k)*law%factor, law%line)
      end do
      call finish_law(points, 'the points of '//name, flaws)
      if (.not. points%is_bad) call put_curve(deck, name//'_law', points, component, 'linear')
   end subroutine put_curve_of

end module ek_kin_springs
