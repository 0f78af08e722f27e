!> Messages on a model before it is solved: contact points, springs, preloads found by balance.
module ek_model_remarks
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_units, only: millimetre
   use ek_text, only: str, quoted
   use ek_element, only: element_kinds, element_label, axial_spring, torsion_spring
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   implicit none(type, external)
   private
   public :: patch_words, spring_words, preload_words, has_spring

contains

   !> Warns of a contact point that is not where a wheel of this radius touches the ground. Tests and compliance matrix both
   !> use the contact point of the deck, so that an error in it affects both.
   subroutine patch_words(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      real(wp), parameter :: much = 0.02_wp      ! share of the radius; the camber of a real wheel moves the point by half of this
      real(wp) :: down(3), off
      integer :: k

      do k = 1, size(suspension%wheels)
         associate (w => suspension%wheels(k))
            down = [0.0_wp, 0.0_wp, -1.0_wp] + w%spin(3)*w%spin                        ! in the plane of the wheel
            down = down/max(norm2(down), 0.1_wp)
            off = min(norm2(w%contact - w%centre - w%radius*down), &
               norm2(w%contact - w%centre + w%radius*[0.0_wp, 0.0_wp, 1.0_wp]))
            if (off <= much*w%radius) cycle
            call words%add('wheel '//quoted(w%name)//': its contact point is '//str(off/millimetre, 3)// &
               ' mm away from the point where a wheel of radius '//str(w%radius/millimetre, 4)//' mm touches the ground; all '// &
               'forces at the contact patch act at the contact point')
         end associate
      end do
   end subroutine patch_words

   !> Whether the deck has a spring that carries the car: a spring, or a torsion spring against the chassis.
   pure logical function has_spring(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: k

      has_spring = .false.
      do k = 1, size(suspension%elements)
         associate (kind => suspension%elements(k)%kind, m => suspension%elements(k)%measure)
            has_spring = has_spring .or. element_kinds(kind)%carries .or. &
               (kind == torsion_spring .and. min(m%body_i, m%body_j) == 0)
         end associate
      end do
   end function has_spring

   !> Warns of a deck without a spring: its equilibrium rests on bushings and stops. Cases that only prescribe a wheel
   !> travel or a driver (kinematics) need no spring.
   subroutine spring_words(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      integer :: k

      if (size(suspension%wheels) == 0 .or. has_spring(suspension)) return
      if (all([(.not. cases(k)%has_all .and. len(cases(k)%drive) > 0, k=1, size(cases))])) return
      call words%add('the deck has no spring: the wheels are carried by bushings, anti-roll bars and stops alone, '// &
         'and the reported rates are those of these elements')
   end subroutine spring_words

   !> The preloads found by balance.
   subroutine preload_words(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      integer :: k

      if (suspension%balance == 'none') return
      do k = 1, size(suspension%elements)
         if (suspension%elements(k)%kind /= axial_spring) cycle
         call words%add('balance: preload of '//element_label(suspension%elements(k))//' = '// &
            str(suspension%elements(k)%preload, 9)//' N (compression)')
      end do
   end subroutine preload_words

end module ek_model_remarks
