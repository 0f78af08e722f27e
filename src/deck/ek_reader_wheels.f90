!> &wheel and &case: what is looked at, and what is done.
module ek_reader_wheels
   use ek_kinds, only: wp
   use ek_text, only: str, lower, quoted
   use ek_rotation, only: unit_vector
   use ek_suspension, only: suspension_t, wheel_t
   use ek_builder, only: add_wheel
   use ek_case, only: case_t, method_names, most_increments
   use ek_record, only: element
   use ek_group, only: wheel_group, case_group, load_group, joint_group, word_length, did_you_mean
   use ek_deck, only: deck_t
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, look_up, find_point, find_body, find_card, &
      find_direction, to_internal
   implicit none(type, external)
   private
   public :: read_wheels, read_cases

contains

   !> &wheel. Spin axis outboard: w = (−cos γ sin δ, side cos γ cos δ, −sin γ), δ toe-in, γ camber
   !> (top outboard), which inverts toe = atan2(−w_x, side w_y), camber = asin(−w_z).
   subroutine read_wheels(deck, draft, suspension)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(suspension_t), intent(inout) :: suspension
      character(word_length) :: name, body, side, centre, contact, steer_axis(2)
      real(wp) :: spin_vector(3), toe, camber, radius
      namelist /wheel/ name, body, side, centre, contact, spin_vector, toe, camber, radius, steer_axis
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
         else if (.not. has_key(deck, k, 'radius') .and. has_centre .and. has_contact) then
            this%radius = this%centre(3) - this%contact(3)
            if (.not. this%radius > 0.0_wp) call complain(draft, deck, k, 'contact', &
               'the contact point must lie below the centre, found it '//str(-this%radius/draft%units%length)//' above')
         end if
         call find_spin()
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

      !> A left wheel on the right side would turn every sign of its results round.
      subroutine check_side()
         if (this%side*this%centre(2) >= 0.0_wp) return
         call complain(draft, deck, k, 'side', 'side is '//quoted(side)//', but the centre '//quoted(centre)// &
            ' lies on the other side (y points '//trim(merge('left ', 'right', draft%is_iso))//')')
      end subroutine check_side

      subroutine find_spin()
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
               call complain(draft, deck, k, 'spin_vector', 'spin_vector has no length')
               return
            else if (.not. this%side*w(2) > 0.0_wp) then
               call complain(draft, deck, k, 'spin_vector', 'spin_vector must point outboard, to the '//trim(side)// &
                  ' (y points '//trim(merge('left ', 'right', draft%is_iso))//')')
            end if
            w = unit_vector(w)
         end if
         this%spin = w
      end subroutine find_spin

   end subroutine read_wheels

   !> &case.
   subroutine read_cases(deck, draft, cases)
      type(deck_t), intent(in) :: deck
      type(draft_t), intent(inout) :: draft
      type(case_t), allocatable, intent(out) :: cases(:)
      character(word_length) :: name, load, drive, wheel, method
      real(wp) :: from, to, tolerance
      integer :: increments
      namelist /case/ name, load, drive, wheel, from, to, increments, method, tolerance
      real(wp) :: factor
      integer :: k, c, found, used, status

      allocate (cases(count(draft%cards%group == case_group)))
      used = 0
      do k = 1, deck%used
         if (draft%cards(k)%group /= case_group) cycle
         used = used + 1
         name = ''
         load = ''
         drive = ''
         wheel = ''
         method = 'equilibrium'
         from = 0.0_wp
         to = 0.0_wp
         tolerance = cases(used)%tolerance/draft%units%length
         increments = cases(used)%increments
         read (draft%cards(k)%text, nml=case, iostat=status)
         if (status /= 0) call complain(draft, deck, k, '', 'cannot be read')

         factor = 1.0_wp
         if (has_key(deck, k, 'load') .and. has_key(deck, k, 'drive')) then
            call complain(draft, deck, k, 'drive', 'give either load or drive, not both')
         else if (.not. (has_key(deck, k, 'load') .or. has_key(deck, k, 'drive'))) then
            call complain(draft, deck, k, '', "'load' or 'drive' is missing")
         end if
         call find_load()
         call find_drive()
         cases(used)%wheel = 1
         if (wheel /= '') then
            call look_up(draft, deck, k, 'wheel', wheel_group, trim(wheel), found)
            if (found > 0) cases(used)%wheel = draft%cards(found)%index
            if (drive /= 'wheel_travel') call complain(draft, deck, k, 'wheel', &
               "wheel: only a case with drive = 'wheel_travel' has one")
         end if
         if (draft%cards(k)%is_good .and. .not. abs(to - from) > 0.0_wp) &
            call complain(draft, deck, k, 'to', 'from and to must differ, found '//str(from)//' twice')
         if (increments < 1 .or. increments > most_increments) &
            call complain(draft, deck, k, 'increments', 'increments must be 1 to '//str(most_increments)//', found '// &
               str(increments))
         call choice(draft, deck, k, 'method', trim(method), method_names, c)
         if (.not. tolerance > 0.0_wp) &
            call complain(draft, deck, k, 'tolerance', 'tolerance must be above 0, found '//str(tolerance))

         cases(used)%name = trim(name)
         cases(used)%where = where_of(deck, k)
         cases(used)%load = trim(load)
         cases(used)%drive = trim(drive)
         cases(used)%from = from*factor
         cases(used)%to = to*factor
         cases(used)%increments = increments
         cases(used)%method = lower(trim(method))
         if (has_key(deck, k, 'tolerance')) cases(used)%tolerance = tolerance*draft%units%length
      end do

   contains

      subroutine find_load()
         call look_up(draft, deck, k, 'load', load_group, trim(load), found)
         if (found == 0) return
         if (.not. draft%cards(found)%is_used) call complain(draft, deck, k, 'load', 'load '//quoted(load)//' in line '// &
            str(deck%records(found)%line)//" is constant; a case scales loads with factor = 'case'")
      end subroutine find_load

      subroutine find_drive()
         character(word_length), allocatable :: names(:)
         integer :: j

         if (drive == '') return
         if (lower(drive) == 'wheel_travel') then
            drive = 'wheel_travel'
            factor = draft%units%length
            if (.not. any(draft%cards%group == wheel_group)) &
               call complain(draft, deck, k, 'drive', "drive is 'wheel_travel', but there is no &wheel")
            return
         end if
         found = find_card(draft, joint_group, drive)
         if (found > 0) then
            factor = draft%cards(found)%factor
            if (lower(element(deck%records(found), 'type', 1)) /= 'driver') call complain(draft, deck, k, 'drive', &
               'drive: the joint '//quoted(drive)//' in line '//str(deck%records(found)%line)//' is not a driver')
            return
         end if
         allocate (names(deck%used + 1))
         names = ''
         names(1) = 'wheel_travel'
         do j = 1, deck%used
            if (draft%cards(j)%group /= joint_group) cycle
            if (lower(element(deck%records(j), 'type', 1)) == 'driver') names(j + 1) = draft%cards(j)%name
         end do
         call complain(draft, deck, k, 'drive', 'drive: there is no driver joint '//quoted(drive)//did_you_mean(drive, names))
      end subroutine find_drive

   end subroutine read_cases

end module ek_reader_wheels
