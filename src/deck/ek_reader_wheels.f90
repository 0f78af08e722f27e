!> &wheel: the wheels whose attitude is reported.
module ek_reader_wheels
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_rotation, only: unit_vector
   use ek_suspension, only: suspension_t, wheel_t
   use ek_builder, only: add_wheel
   use ek_group, only: wheel_group, word_length
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, find_point, find_body, to_internal
   implicit none(type, external)
   private
   public :: read_wheels

contains

   !> &wheel. Spin axis outboard: w = (−cos γ sin δ, side cos γ cos δ, −sin γ), δ toe-in, γ camber
   !> (top outboard), which inverts toe = atan2(−w_x, side w_y), camber = asin(−w_z).
   subroutine read_wheels(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, body, side, centre, contact, steer_axis(2)
      real(wp) :: spin_vector(3), toe, camber, radius, tyre_rate, tyre_width, sprung_mass, height
      namelist /wheel/ name, body, side, centre, contact, spin_vector, toe, camber, radius, tyre_rate, tyre_width, &
         sprung_mass, steer_axis
      type(wheel_t) :: this
      logical :: has_body, has_centre, has_contact, is_there(2)
      integer :: k, j, c, wheels, status

      wheels = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= wheel_group) cycle
         name = ''
         body = ''
         side = ''
         centre = ''
         contact = ''
         steer_axis = ''
         spin_vector = [0.0_wp, 0.0_wp, 0.0_wp]
         toe = 0.0_wp
         camber = 0.0_wp
         radius = 1.0_wp
         tyre_rate = 1.0_wp
         tyre_width = 1.0_wp
         sprung_mass = 1.0_wp
         read (draft%cards(k)%text, nml=wheel, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')
         wheels = wheels + 1
         draft%cards(k)%index = wheels

         call find_body(draft, deck, k, 'body', trim(body), this%body, has_body)
         if (has_body .and. this%body == 0) &
            call complain(draft, deck, k, 'body', 'body must be one that moves, found '//quoted(body))
         call choice(draft, deck, k, 'side', trim(side), [character(5) :: 'left', 'right'], c)
         this%side = merge(-1, 1, c == 1)
         call find_point(draft, deck, k, 'centre', trim(centre), this%centre, has_centre)
         call find_point(draft, deck, k, 'contact', trim(contact), this%contact, has_contact)
         if (has_centre .and. c > 0) call check_side()
         this%radius = radius*draft%units%length
         if (.not. radius > 0.0_wp) then
            call complain(draft, deck, k, 'radius', 'radius must be above 0, found '//str(radius))
         else if (has_centre .and. has_contact) then
            height = this%centre(3) - this%contact(3)
            if (.not. height > 0.0_wp) call complain(draft, deck, k, 'contact', &
               'the contact point must lie below the wheel centre, found it '//str(-height/draft%units%length)//' above')
            if (.not. has_key(deck, k, 'radius')) this%radius = height
         end if
         if (.not. tyre_rate > 0.0_wp) &
            call complain(draft, deck, k, 'tyre_rate', 'tyre_rate must be above 0, found '//str(tyre_rate))
         this%tyre_rate = 0.0_wp
         if (has_key(deck, k, 'tyre_rate')) this%tyre_rate = tyre_rate*(draft%units%force/draft%units%length)
         if (.not. tyre_width > 0.0_wp) &
            call complain(draft, deck, k, 'tyre_width', 'tyre_width must be above 0, found '//str(tyre_width))
         this%tyre_width = 0.0_wp
         if (has_key(deck, k, 'tyre_width')) this%tyre_width = tyre_width*draft%units%length
         if (.not. sprung_mass > 0.0_wp) &
            call complain(draft, deck, k, 'sprung_mass', 'sprung_mass must be above 0 kg, found '//str(sprung_mass))
         this%sprung_mass = 0.0_wp
         if (has_key(deck, k, 'sprung_mass')) this%sprung_mass = sprung_mass
         call find_spin(draft, deck, k, spin_vector, toe, camber, side, this)
         this%has_steer_axis = has_key(deck, k, 'steer_axis')
         do j = 1, 2
            call find_point(draft, deck, k, 'steer_axis', trim(steer_axis(j)), this%steer_axis(:, j), is_there(j))
         end do
         if (all(is_there)) then
            if (.not. norm2(this%steer_axis(:, 2) - this%steer_axis(:, 1)) > 0.0_wp) call complain(draft, deck, k, &
               'steer_axis', 'steer_axis: the points '//quoted(steer_axis(1))//' and '//quoted(steer_axis(2))//' coincide')
         end if
         if (.not. draft%cards(k)%is_good) cycle
         this%name = trim(name)
         this%where = where_of(deck, k)
         call add_wheel(suspension, this)
      end do

   contains

      !> A left wheel on the right side would reverse the signs of its results.
      subroutine check_side()
         if (this%side*this%centre(2) >= 0.0_wp) return
         call complain(draft, deck, k, 'side', 'side is '//quoted(side)//', but the centre '//quoted(centre)// &
            ' lies on the other side (y points '//trim(merge('left ', 'right', draft%is_iso))//')')
      end subroutine check_side

   end subroutine read_wheels

   !> The spin axis, from spin_vector or from toe and camber.
   subroutine find_spin(draft, deck, k, spin_vector, toe, camber, side, this)
      type(draft_t), intent(inout) :: draft
      type(deck_t), intent(in) :: deck
      integer, intent(in) :: k                         !! record
      real(wp), intent(in) :: spin_vector(3), toe, camber      !! as given in the deck, or the defaults
      character(*), intent(in) :: side
      type(wheel_t), intent(inout) :: this             !! side → spin, toe, camber
      real(wp) :: delta, gamma, w(3)

      delta = toe*draft%units%angle
      gamma = camber*draft%units%angle
      w = [-cos(gamma)*sin(delta), this%side*cos(gamma)*cos(delta), -sin(gamma)]
      if (has_key(deck, k, 'spin_vector')) then
         if (has_key(deck, k, 'toe') .or. has_key(deck, k, 'camber')) call complain(draft, deck, k, 'spin_vector', &
            'give either spin_vector or toe and camber, not both')
         w = to_internal(draft, spin_vector)
         if (.not. draft%cards(k)%is_good) return
         if (.not. norm2(w) > 0.0_wp) then
            call complain(draft, deck, k, 'spin_vector', 'spin_vector has zero length')
            return
         else if (.not. this%side*w(2) > 0.0_wp) then
            call complain(draft, deck, k, 'spin_vector', 'spin_vector must point outboard, to the '//trim(side)// &
               ' (y points '//trim(merge('left ', 'right', draft%is_iso))//')')
         end if
         w = unit_vector(w)
      end if
      this%spin = w
      this%toe = delta
      this%camber = gamma
      if (has_key(deck, k, 'spin_vector')) then
         this%toe = atan2(-w(1), this%side*w(2))
         this%camber = asin(max(-1.0_wp, min(1.0_wp, -w(3))))
      end if
   end subroutine find_spin

end module ek_reader_wheels
