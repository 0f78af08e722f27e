!> Messages on the solution of a case as data: notes, warnings and failures, in the order in which they were found. Also the
!> messages on a model before a solution: contact points, springs, preloads found by the preload trim (`balance`).
module ek_remark
   use ek_kinds, only: wp, millimetre, degree, pi
   use ek_text, only: str, quoted
   use ek_rig, only: lacks_springs
   use ek_case, only: case_t
   use ek_error, only: message_list_t
   use ek_element, only: element_kinds
   use ek_free_wheels, only: has_spring, has_rates
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, driver_unit
   implicit none(type, external)
   private
   public :: remark_t, remark_list_t, swept_text, note, warning, failure, on_case, on_end, on_settling, on_drift, on_travel, &
      on_stability, on_rack, on_curve, on_closure, patch_remarks, spring_remarks, half_turn_remarks, preload_remarks

   ! severities
   integer, parameter :: note = 1        !! the results are sound
   integer, parameter :: warning = 2     !! results may be unreliable
   integer, parameter :: failure = 3     !! results are missing, or marked converged = 0

   ! topics
   integer, parameter :: on_case = 0     !! the case was not run
   integer, parameter :: on_end = 1, on_settling = 2, on_drift = 3, on_travel = 4, on_stability = 5, on_rack = 6, on_curve = 7
   integer, parameter :: on_closure = 8

   !> A message (note, warning or failure) as data.
   type :: remark_t
      integer :: severity = note, topic = on_case
      character(:), allocatable :: case      !! name of the case
      character(:), allocatable :: head      !! heading: "case 'x'", "case 'x', method recursive"; '' for on_case
      character(:), allocatable :: text      !! message without its heading, one or more lines
      logical :: has_place = .false.
      real(wp) :: place = 0.0_wp             !! swept value to which the message applies, SI
   contains
      procedure :: whole                     !! string of the message with its heading
   end type remark_t

   !> The messages on a case.
   type :: remark_list_t
      type(remark_t), allocatable, private :: remarks(:)
   contains
      procedure :: add => list_add, count => list_count, item => list_item, failures => list_failures, &
         has_failed => list_has_failed
   end type remark_list_t

contains

   !> A swept value of a case on the rig with its name and unit: 'wheel travel = 12.5 mm'.
   pure function swept_text(case, value, digits) result(text)
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: value      !! SI
      integer, intent(in) :: digits
      character(:), allocatable :: text

      text = case%place_name//' = '//str(value/case%unit, digits)
      if (case%unit_name /= '-') text = text//' '//case%unit_name
   end function swept_text

   !> The string of a message with its heading: "case 'x': message"; '' as heading gives the message alone.
   pure function whole(self) result(text)
      class(remark_t), intent(in) :: self
      character(:), allocatable :: text

      text = self%text
      if (len(self%head) > 0) text = self%head//': '//text
   end function whole

   !> Adds a message; adds nothing for an empty string.
   pure subroutine list_add(self, severity, topic, case, text, place, is_of_method)
      class(remark_list_t), intent(inout) :: self
      integer, intent(in) :: severity, topic
      type(case_t), intent(in) :: case
      character(*), intent(in) :: text
      real(wp), intent(in), optional :: place           !! swept value, SI
      logical, intent(in), optional :: is_of_method     !! the heading names the method
      type(remark_t) :: new

      if (len(text) == 0) return
      new%severity = severity
      new%topic = topic
      new%case = case%name
      new%text = text
      new%head = ''
      if (topic /= on_case) new%head = 'case '//quoted(case%name)
      if (present(is_of_method)) new%head = new%head//', method '//case%method
      new%has_place = present(place)
      if (present(place)) new%place = place
      if (.not. allocated(self%remarks)) allocate (self%remarks(0))
      self%remarks = [self%remarks, new]
   end subroutine list_add

   pure integer function list_count(self)
      class(remark_list_t), intent(in) :: self
      list_count = 0
      if (allocated(self%remarks)) list_count = size(self%remarks)
   end function list_count

   pure type(remark_t) function list_item(self, k)
      class(remark_list_t), intent(in) :: self
      integer, intent(in) :: k
      list_item = self%remarks(k)
   end function list_item

   pure logical function list_has_failed(self)
      class(remark_list_t), intent(in) :: self

      list_has_failed = .false.
      if (allocated(self%remarks)) list_has_failed = any(self%remarks%severity == failure)
   end function list_has_failed

   !> All failures as one string, each on a new line; '' without a failure.
   pure function list_failures(self) result(text)
      class(remark_list_t), intent(in) :: self
      character(:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, self%count()
         if (self%remarks(k)%severity /= failure) cycle
         if (len(text) > 0) text = text//new_line('a')
         text = text//self%remarks(k)%whole()
      end do
   end function list_failures

   !> Warns of a contact point at which a wheel of the given radius would not touch the ground. Tests and compliance matrix both use
   !> the contact point of the deck, so that an error in this point affects both.
   subroutine patch_remarks(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      real(wp), parameter :: much = 0.02_wp      ! share of the radius; the camber of a real wheel moves the point by half of this
      real(wp) :: down(3), off
      integer :: k

      do k = 1, size(suspension%wheels)
         associate (w => suspension%wheels(k))
            if (w%has_crown) cycle                  ! computed
            down = [0.0_wp, 0.0_wp, -1.0_wp] + w%spin(3)*w%spin                        ! in the plane of the wheel
            down = down/max(norm2(down), 0.1_wp)
            off = min(norm2(w%contact - w%centre - w%radius*down), &
               norm2(w%contact - w%centre + w%radius*[0.0_wp, 0.0_wp, 1.0_wp]))
            if (off <= much*w%radius) cycle
            call words%add('wheel '//quoted(w%name)//': its contact point is '//str(off/millimetre, 3)// &
               ' mm away from the point where a wheel of radius '//str(w%radius/millimetre, 4)//' mm touches the ground; all '// &
               'forces of the road act at the contact point')
         end associate
      end do
   end subroutine patch_remarks

   !> Warns of a deck without a spring, whose equilibrium rests on bushings and stops. No warning is added if every case prescribes
   !> a wheel travel or a driver and does not request all columns (kinematics): such cases do not need a spring.
   subroutine spring_remarks(suspension, cases, words, all_cases)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)              !! cases to be run
      type(message_list_t), intent(inout) :: words
      type(case_t), intent(in) :: all_cases(:)          !! cases of the deck
      integer :: k

      if (size(suspension%wheels) == 0) return
      if (has_rates(suspension) .and. has_spring(suspension)) return
      if (size(cases) > 0 .and. all([(.not. cases(k)%has_all .and. len(cases(k)%drive) > 0, k=1, size(cases))])) return
      if (.not. has_rates(suspension)) then
         call kinematic_remark(suspension, all_cases, words)
         return
      end if
      call words%add('the deck has no spring: the wheels are carried by bushings, anti-roll bars and stops alone, '// &
         'and the reported rates are those of these elements')
   end subroutine spring_remarks

   !> Warns of a deck in which nothing carries the wheels, and lists the cases that need forces.
   subroutine kinematic_remark(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      character(:), allocatable :: names
      integer :: k

      names = ''
      do k = 1, size(cases)
         if (lacks_springs(suspension, cases(k))) names = names//', '//quoted(cases(k)%name)
      end do
      if (names /= '') names = '; cases that need forces: '//names(3:)
      if (suspension%free_wheels > 0) then
         call words%add('kinematics only: no spring carries the wheels, so that rates and forces have no value'//names)
      else
         call words%add('no spring carries the wheels, only the stiffness of bushings about their axes; what depends on the '// &
            'spring has no value'//names)
      end if
   end subroutine kinematic_remark

   !> Warns of cases that drive a rotation beyond the limit of a rotation measure.
   subroutine half_turn_remarks(suspension, cases, words)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: cases(:)
      type(message_list_t), intent(inout) :: words
      real(wp) :: far
      integer :: k

      do k = 1, size(cases)
         if (len(cases(k)%drive) == 0) cycle
         if (driver_unit(suspension, cases(k)%drive) /= 'deg') cycle
         far = max(abs(cases(k)%from), abs(cases(k)%to))
         if (far >= pi) call words%add('case '//quoted(cases(k)%name)//': '//cases(k)%drive//' is driven to '// &
            str(far/degree, 4)//' deg, but a rotation is limited to less than 180 deg either way; use a shorter range')
      end do
   end subroutine half_turn_remarks

   !> Adds one note per adjuster that &align has set, and per axial spring on the preload found by the preload trim (`balance`).
   subroutine preload_remarks(suspension, words)
      type(suspension_t), intent(in) :: suspension
      type(message_list_t), intent(inout) :: words
      integer :: k, j

      do j = 1, size(suspension%aligns)
         do k = 1, suspension%aligns(j)%angles
            associate (this => suspension%adjusters(suspension%aligns(j)%adjusters(k)))
               call words%add('align: adjuster '//quoted(this%name)//' = '//str(this%value/millimetre, 6)//' mm (range '// &
                  str(this%low/millimetre, 6)//' to '//str(this%high/millimetre, 6)//' mm)')
            end associate
         end do
      end do
      if (suspension%balance == 'none') return
      do k = 1, size(suspension%elements)
         if (.not. element_kinds(suspension%elements(k)%kind)%is_axial_spring) cycle
         call words%add('balance: preload of '//element_label(suspension%elements(k))//' = '// &
            str(suspension%elements(k)%preload, 9)//' N (compression)')
      end do
   end subroutine preload_remarks

end module ek_remark
