!> Plausibility of the steering of a deck: the rack, its guide and its measure, and the tie rods.
module ek_plausible_steering
   use ek_kinds, only: wp, millimetre
   use ek_text, only: quoted
   use ek_rotation, only: cross
   use ek_measure, only: measure_t, body_gap, global_gap
   use ek_suspension, only: suspension_t, body_name, driver_row
   use ek_plausible_range, only: doubts_t, length
   use ek_plausible_shape, only: point_of
   implicit none(type, external)
   private
   public :: doubt_steering, find_opposite_rod

contains

   !> Adds remarks on the body moved by the driver of &steering, and on its tie rods.
   subroutine doubt_steering(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: rack, guide

      rack = rack_body(suspension)
      if (rack == 0) return
      call doubt_rack(suspension, rack, doubts)
      guide = guide_of(suspension, rack)
      if (guide > 0) call doubt_guide(suspension, rack, guide, doubts)
      call doubt_rods(suspension, rack, guide, doubts)
   end subroutine doubt_steering

   !> Index of the body moved by the driver of &steering; 0 without such a driver.
   pure integer function rack_body(suspension)
      type(suspension_t), intent(in) :: suspension
      integer :: row

      rack_body = 0
      if (.not. suspension%steering%has_steering) return
      row = driver_row(suspension, suspension%steering%driver)
      if (row == 0) return
      associate (joint => suspension%joints(suspension%rows(row)%joint))
         rack_body = max(joint%body_i, joint%body_j)
         if (any(suspension%wheels%body == rack_body)) rack_body = min(joint%body_i, joint%body_j)
      end associate
      ! a measure from a housing to the rack: the rack is the one with the tie rods
      associate (joint => suspension%joints(suspension%rows(row)%joint))
         if (min(joint%body_i, joint%body_j) > 0 .and. .not. leads_to_wheel(suspension, rack_body) .and. &
            leads_to_wheel(suspension, joint%body_i + joint%body_j - rack_body)) &
            rack_body = joint%body_i + joint%body_j - rack_body
      end associate
   end function rack_body

   !> Whether a distance joint connects a body to the body of a wheel.
   pure logical function leads_to_wheel(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      integer :: k

      leads_to_wheel = .false.
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (joint%kind /= 'distance' .or. all([joint%body_i, joint%body_j] /= body)) cycle
            leads_to_wheel = leads_to_wheel .or. any(suspension%wheels%body == joint%body_i + joint%body_j - body)
         end associate
      end do
   end function leads_to_wheel

   !> Index of the joint that guides the rack: the only translational, cylindrical or revolute joint of the rack; 0 if there is
   !> none, or more.
   pure integer function guide_of(suspension, rack) result(guide)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rack
      integer :: k, guides

      guide = 0
      guides = 0
      do k = 1, size(suspension%joints)
         associate (joint => suspension%joints(k))
            if (all([joint%body_i, joint%body_j] /= rack)) cycle
            if (all(joint%kind /= [character(13) :: 'translational', 'cylindrical', 'revolute'])) cycle
            guides = guides + 1
            guide = k
         end associate
      end do
      if (guides /= 1) guide = 0
   end function guide_of

   !> Examines whether the rack is connected to another moving body, such as a tie rod or a wheel carrier.
   subroutine doubt_rack(suspension, rack, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rack
      type(doubts_t), intent(inout) :: doubts
      integer :: k

      if (any([(leads(suspension%terms(k)%measure), k=1, size(suspension%terms))])) return
      if (any([(leads(suspension%elements(k)%measure), k=1, size(suspension%elements))])) return
      call doubts%examine(suspension%steering%where, '&steering')
      call doubts%add('no tie rod', 'the rack, body '//quoted(body_name(suspension, rack))// &
         ', is not connected to a wheel: is a tie rod missing?')

   contains

      !> Whether a measure connects the rack to another moving body.
      pure logical function leads(m)
         type(measure_t), intent(in) :: m
         leads = any([m%body_i, m%body_j] == rack) .and. min(m%body_i, m%body_j) > 0
      end function leads

   end subroutine doubt_rack

   !> Examines the guide of the rack: the driver should be measured from the body on which the rack is guided, and the guide should
   !> lie near the line through the tie rods.
   subroutine doubt_guide(suspension, rack, guide, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rack, guide
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: far = 200.0_wp*millimetre
      real(wp) :: axis(3), to(3), off, nearest
      integer :: from, on, k, own, driver
      logical :: is_of_guide

      driver = suspension%rows(driver_row(suspension, suspension%steering%driver))%joint
      associate (joint => suspension%joints(guide), drive => suspension%joints(driver))
         on = joint%body_i + joint%body_j - rack
         from = drive%body_i + drive%body_j - rack
         is_of_guide = any(suspension%terms(suspension%rows(drive%first_row)%first)%measure%kind == [body_gap, global_gap]) .neqv. &
            joint%kind == 'revolute'
         call doubts%examine(drive%where, 'joint '//quoted(drive%name))
         if (on /= from .and. is_of_guide) call doubts%add('measured from', 'its measure gives the position of body '// &
            quoted(body_name(suspension, rack))//' on body '//quoted(body_name(suspension, from))//', but joint '// &
            quoted(joint%name)//' guides it on body '//quoted(body_name(suspension, on))//': motion between '// &
            quoted(body_name(suspension, from))//' and '//quoted(body_name(suspension, on))//' then moves the rack; '// &
            'give both the same bodies')
         if (joint%kind == 'revolute') return
         call doubts%examine(joint%where, 'joint '//quoted(joint%name))
         axis = suspension%terms(suspension%rows(joint%first_row)%first)%measure%v
         nearest = huge(1.0_wp)
         do k = 1, size(suspension%joints)
            if (suspension%joints(k)%kind /= 'distance') cycle
            associate (m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
               own = findloc([m%body_i, m%body_j], rack, dim=1)
               if (own == 0) cycle
               to = point_of(suspension, rack, merge(m%arm_i, m%arm_j, own == 1)) - &
                  point_of(suspension, joint%body_j, joint%arm_j)
               off = norm2(cross(axis, to))/norm2(axis)
               nearest = min(nearest, off)
            end associate
         end do
         if (nearest > far .and. nearest < huge(1.0_wp)) call doubts%add('far guide', 'its axis passes the inner ends of the '// &
            'tie rods at a distance of '//doubts%speak(length, nearest)//'; check the coordinates of its point')
      end associate
   end subroutine doubt_guide

   !> Examines the direction of the rods of the rack: within 32° of the direction in which their ends on the rack move.
   subroutine doubt_rods(suspension, rack, guide, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: rack, guide
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: along = 0.85_wp        ! cosine: 32°
      real(wp) :: apart(3), moves(3), at(3)
      integer :: k, own

      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%kind /= 'distance') cycle
         associate (joint => suspension%joints(k), &
               m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
            own = findloc([m%body_i, m%body_j], rack, dim=1)
            if (own == 0) cycle
            at = point_of(suspension, rack, merge(m%arm_i, m%arm_j, own == 1))
            apart = point_of(suspension, m%body_j, m%arm_j) - point_of(suspension, m%body_i, m%arm_i)
            call find_motion(suspension, guide, at, moves)
            if (abs(dot_product(apart, moves)) >= along*norm2(apart)*norm2(moves)) cycle
            call doubts%examine(joint%where, 'joint '//quoted(joint%name))
            call doubts%add('askew', 'the tie rod is more than 32 deg off the direction in which the rack moves; check the '// &
               'signs of the coordinates of its ends')
         end associate
      end do
   end subroutine doubt_rods

   !> Finds the direction in which the steering driver moves a point of the rack. A rack is guided along its axis; the end of a
   !> steering lever moves across the axis of its hinge. Without a guide, the direction of the measure; 0 if this is not a
   !> displacement.
   subroutine find_motion(suspension, guide, at, moves)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: guide
      real(wp), intent(in) :: at(3)                 !! point of the rack at design [m]
      real(wp), intent(out) :: moves(3)

      moves = 0.0_wp
      if (guide > 0) then
         associate (joint => suspension%joints(guide))
            if (joint%kind == 'revolute') then
               moves = cross(suspension%terms(suspension%rows(joint%first_row + 3)%first)%measure%v, &
                  at - point_of(suspension, joint%body_j, joint%arm_j))
            else
               moves = suspension%terms(suspension%rows(joint%first_row)%first)%measure%v
            end if
         end associate
         return
      end if
      associate (m => suspension%terms(suspension%rows(driver_row(suspension, suspension%steering%driver))%first)%measure)
         if (any(m%kind == [body_gap, global_gap])) moves = m%u
      end associate
   end subroutine find_motion

   !> Finds a rod of a wheel carrier whose ends are at nearly opposite heights z and −z, more than 60 mm apart: one of its signs may
   !> be wrong. A rod is a distance joint, or a body with one joint to the carrier and one other joint or bushing.
   subroutine find_opposite_rod(suspension, carrier, name, z)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: carrier
      character(:), allocatable, intent(out) :: name       !! "joint 'tie_rod'", "body 'toe_link'"; '' if there is none
      real(wp), intent(out) :: z(2)                        !! heights of the ends [m]
      integer :: k, link

      name = ''
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%is_of_measures) cycle
         associate (joint => suspension%joints(k), &
               m => suspension%terms(suspension%rows(suspension%joints(k)%first_row)%first)%measure)
            if (all([joint%body_i, joint%body_j] /= carrier)) cycle
            if (joint%kind == 'distance') then
               z = [height(m%body_i, m%arm_i), height(m%body_j, m%arm_j)]
               if (is_opposite(z)) name = 'joint '//quoted(joint%name)
            else
               link = joint%body_i + joint%body_j - carrier
               if (link == 0) cycle
               z(1) = height(joint%body_j, joint%arm_j)
               if (.not. has_other_end(link, k, z(2))) cycle
               if (is_opposite(z)) name = 'body '//quoted(body_name(suspension, link))
            end if
            if (name /= '') return
         end associate
      end do

   contains

      pure logical function is_opposite(z)
         real(wp), intent(in) :: z(2)
         real(wp), parameter :: apart = 60.0_wp*millimetre
         is_opposite = abs(z(2) - z(1)) > apart .and. abs(z(1) + z(2)) < 0.2_wp*abs(z(2) - z(1))
      end function is_opposite

      pure real(wp) function height(body, arm)
         integer, intent(in) :: body
         real(wp), intent(in) :: arm(3)
         real(wp) :: at(3)
         at = point_of(suspension, body, arm)
         height = at(3)
      end function height

      !> Whether one other joint or bushing holds a link, and the height of this end.
      logical function has_other_end(body, joint, end_height)
         integer, intent(in) :: body, joint
         real(wp), intent(out) :: end_height
         integer :: j, ends

         ends = 0
         end_height = 0.0_wp
         do j = 1, size(suspension%joints)
            if (j == joint .or. all([suspension%joints(j)%body_i, suspension%joints(j)%body_j] /= body)) cycle
            ends = ends + 1
            end_height = height(suspension%joints(j)%body_j, suspension%joints(j)%arm_j)
         end do
         do j = 1, size(suspension%elements)
            associate (m => suspension%elements(j)%measure)
               if (all([m%body_i, m%body_j] /= body)) cycle
               ends = ends + 1
               end_height = height(m%body_j, m%arm_j)
            end associate
         end do
         has_other_end = ends == 1
      end function has_other_end

   end subroutine find_opposite_rod

end module ek_plausible_steering
