!> &wheel: the wheels whose attitude is reported.
module ek_reader_wheels
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_suspension, only: wheel_t
   use ek_blueprint, only: wheel_plan_t, vector_t, given
   use ek_group, only: word_length
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, texts_of, numbers_of, slot, slots
   use ek_reference, only: find_point, find_body, new_vector, vector_at
   implicit none(type, external)
   private
   public :: read_wheel

contains

   !> &wheel.
   subroutine read_wheel(draft)
      type(draft_t), intent(inout) :: draft
      type(wheel_plan_t) :: plan
      type(wheel_t) :: this
      character(word_length) :: steer_axis(2)
      real(wp) :: height, centre(3)
      logical :: has_body, has_centre, has_contact, is_there(2)
      integer :: j, c

      draft%cards(draft%k)%index = 1 + count(draft%cards(:draft%k - 1)%group == draft%cards(draft%k)%group)
      call find_body(draft, 'body', text_of(draft, 'body'), this%body, has_body)
      if (has_body .and. this%body == 0) &
         call complain(draft, 'body', 'body must be one that moves, found '//quoted(text_of(draft, 'body')))
      call choice(draft, 'side', [character(5) :: 'left', 'right'], c)
      this%side = merge(-1, 1, c == 1)
      call find_point(draft, 'centre', text_of(draft, 'centre'), plan%centre, has_centre)
      call find_point(draft, 'contact', text_of(draft, 'contact'), plan%contact, has_contact)
      centre = vector_at(draft, plan%centre)
      ! a left wheel on the right side would reverse the signs of its results
      if (has_centre .and. c > 0 .and. this%side*centre(2) < 0.0_wp) call complain(draft, 'side', 'side is '// &
         quoted(text_of(draft, 'side'))//', but the centre '//quoted(text_of(draft, 'centre'))// &
         ' lies on the other side (y points '//trim(merge('left ', 'right', draft%plan%is_iso))//')')
      if (has_centre .and. has_contact) then
         height = centre(3) - sum(vector_at(draft, plan%contact)*[0.0_wp, 0.0_wp, 1.0_wp])
         if (.not. height > 0.0_wp) call complain(draft, 'contact', &
            'the contact point must lie below the wheel centre, found it '//str(-height/draft%units%length)//' above')
      end if
      call find_spin(draft, plan, this)
      this%has_steer_axis = has_key(draft, 'steer_axis')
      steer_axis = texts_of(draft, 'steer_axis', 2)
      do j = 1, 2
         call find_point(draft, 'steer_axis', trim(steer_axis(j)), plan%steer_axis(j), is_there(j))
      end do
      if (all(is_there)) then
         if (.not. norm2(vector_at(draft, plan%steer_axis(2)) - vector_at(draft, plan%steer_axis(1))) > 0.0_wp) &
            call complain(draft, 'steer_axis', 'steer_axis: the points '//quoted(steer_axis(1))//' and '// &
            quoted(steer_axis(2))//' coincide')
      end if
      if (.not. draft%cards(draft%k)%is_good) return
      call slot(draft, 'radius', draft%units%length, plan%radius)
      call slot(draft, 'tyre_rate', draft%units%force/draft%units%length, plan%tyre_rate)
      call slot(draft, 'tyre_width', draft%units%length, plan%tyre_width)
      call slot(draft, 'sprung_mass', 1.0_wp, plan%sprung_mass)
      this%name = text_of(draft, 'name')
      this%where = where_of(draft)
      draft%plan%prototype%wheels = [draft%plan%prototype%wheels, this]
      draft%plan%wheels = [draft%plan%wheels, plan]
   end subroutine read_wheel

   !> The spin axis, from spin_vector or from toe and camber.
   subroutine find_spin(draft, plan, this)
      type(draft_t), intent(inout) :: draft
      type(wheel_plan_t), intent(inout) :: plan
      type(wheel_t), intent(in) :: this
      type(vector_t) :: vector
      real(wp) :: spin(3)

      if (.not. has_key(draft, 'spin_vector')) then
         call slot(draft, 'toe', draft%units%angle, plan%toe, default=0.0_wp)
         call slot(draft, 'camber', draft%units%angle, plan%camber, default=0.0_wp)
         return
      end if
      if (has_key(draft, 'toe') .or. has_key(draft, 'camber')) call complain(draft, 'spin_vector', &
         'give either spin_vector or toe and camber, not both')
      if (.not. draft%cards(draft%k)%is_good) return
      if (.not. norm2(numbers_of(draft, 'spin_vector', 3)) > 0.0_wp) then
         call complain(draft, 'spin_vector', 'spin_vector has zero length')
         return
      end if
      vector%kind = given
      call slots(draft, 'spin_vector', 3, 1.0_wp, vector%first)
      call new_vector(draft, vector, plan%spin)
      spin = vector_at(draft, plan%spin)
      if (.not. this%side*spin(2) > 0.0_wp) call complain(draft, 'spin_vector', 'spin_vector must point outboard, to the '// &
         text_of(draft, 'side')//' (y points '//trim(merge('left ', 'right', draft%plan%is_iso))//')')
   end subroutine find_spin

end module ek_reader_wheels
