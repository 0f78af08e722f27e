!> &mass: further masses of a body, in addition to that of &body.
module ek_reader_masses
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_suspension, only: suspension_t
   use ek_group, only: mass_group, word_length
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, find_point, find_body
   implicit none(type, external)
   private
   public :: read_masses

contains

   !> Adds each mass to its body. As their weights are parallel, one mass at the common centre of gravity is equivalent:
   !>
   !>     m = Σ m_k        centre = Σ m_k c_k / m        [kg, m]
   subroutine read_masses(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension      !! with design points instead of arms
      character(word_length) :: name, body, at
      real(wp) :: kg, place(3)
      namelist /mass/ name, body, kg, at
      logical :: has_body, has_place
      integer :: k, number, status

      do k = 1, deck%used
         if (draft%cards(k)%group /= mass_group) cycle
         name = ''
         body = ''
         at = ''
         kg = 1.0_wp
         read (draft%cards(k)%text, nml=mass, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         call find_body(draft, deck, k, 'body', trim(body), number, has_body)
         call find_point(draft, deck, k, 'at', trim(at), place, has_place)
         if (.not. kg > 0.0_wp) call complain(draft, deck, k, 'kg', 'kg must be above 0, found '//str(kg))
         if (has_body .and. number == 0) &
            call complain(draft, deck, k, 'body', 'body must be one that moves, found '//quoted(body))
         if (.not. draft%cards(k)%is_good .or. .not. has_body .or. .not. has_place) cycle
         if (number > size(suspension%bodies)) cycle
         associate (this => suspension%bodies(number))
            this%centre = (this%mass*this%centre + kg*place)/(this%mass + kg)
            this%mass = this%mass + kg
         end associate
      end do
   end subroutine read_masses

end module ek_reader_masses
