!> Laws of property files as groups of a deck in mm, N, deg.
module ek_law_text
   use ek_text, only: str
   use ek_kinds, only: wp, degree, millimetre
   use ek_deck_text, only: deck_text_t
   use ek_law_points, only: law_points_t, constant_rate
   use ek_property, only: is_of_rotation, component_names
   implicit none(type, external)
   private
   public :: put_curve, put_curves, put_bushing_law, units_of_law

contains

   !> Returns the SI values of the units of a law: the units of displacement and force of a component of a bushing.
   pure subroutine units_of_law(component, length, force, angle, x_unit, y_unit)
      integer, intent(in) :: component
      real(wp), intent(in) :: length, force, angle      !! SI values of the units of the deck
      real(wp), intent(out) :: x_unit, y_unit

      x_unit = merge(angle, length, is_of_rotation(component))
      y_unit = merge(force*length, force, is_of_rotation(component))
   end subroutine units_of_law

   !> Writes a law as a record &curve.
   subroutine put_curve(deck, name, law, component, kind, file)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, kind
      type(law_points_t), intent(in) :: law
      integer, intent(in) :: component           !! component of a bushing; 1 for a spring or a stop
      character(*), intent(in), optional :: file !! the note is this file with the line of the law; default: no note
      real(wp) :: x_unit, y_unit

      call units_of_law(component, millimetre, 1.0_wp, degree, x_unit, y_unit)
      call deck%begin('curve')
      call deck%word('name', name)
      call deck%word('kind', kind)
      call deck%numbers('x', law%x(:law%used)/x_unit)
      call deck%numbers('y', law%y(:law%used)/y_unit)
      if (present(file)) call deck%word('note', file//':'//str(law%line))
      call deck%end()
   end subroutine put_curve

   !> Writes a &curve, named <name>_fx …, for each component of a bushing without a constant rate of 0 or more.
   subroutine put_curves(deck, name, laws, kind, file)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name, kind
      type(law_points_t), intent(in) :: laws(6)
      character(*), intent(in), optional :: file !! see put_curve
      real(wp) :: rate
      logical :: is_constant
      integer :: k

      do k = 1, 6
         call constant_rate(laws(k), rate, is_constant)
         if (is_constant .and. rate >= 0.0_wp) cycle
         call put_curve(deck, name//'_'//component_names(k), laws(k), k, kind, file)
      end do
   end subroutine put_curves

   !> Writes the keys kt, kr and curve of a bushing. Constant rates of 0 or more are in kt and kr. The other components refer to the
   !> curves that `put_curves` writes.
   subroutine put_bushing_law(deck, name, laws)
      type(deck_text_t), intent(inout) :: deck
      character(*), intent(in) :: name
      type(law_points_t), intent(in) :: laws(6)
      real(wp) :: rates(6), x_unit, y_unit
      logical :: is_constant(6)
      integer :: k

      do k = 1, 6
         call constant_rate(laws(k), rates(k), is_constant(k))
         is_constant(k) = is_constant(k) .and. rates(k) >= 0.0_wp
         call units_of_law(k, millimetre, 1.0_wp, degree, x_unit, y_unit)
         rates(k) = merge(rates(k)*x_unit/y_unit, 0.0_wp, is_constant(k))
      end do
      if (any(is_constant(:3))) call deck%numbers('kt', rates(:3))
      if (any(is_constant(4:))) call deck%numbers('kr', rates(4:))
      do k = 1, 6
         if (.not. is_constant(k)) call deck%add_word('curve', component_names(k)//'='//name//'_'//component_names(k), &
            count(.not. is_constant(:k)) == 1)
      end do
   end subroutine put_bushing_law

end module ek_law_text
