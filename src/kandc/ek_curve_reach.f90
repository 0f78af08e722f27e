!> Warns of curves used beyond their first or last point, where they are extrapolated linearly and the result does not
!> rest on a number of the deck.
module ek_curve_reach
   use ek_kinds, only: wp
   use ek_text, only: str, quoted
   use ek_units, only: millimetre, degree
   use ek_curve, only: curve_t
   use ek_law, only: law_t, deflection
   use ek_measure, only: measure_value, rotation
   use ek_element, only: element_label
   use ek_elastic, only: bushing_view_t, look_bushing
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, design_state, unpack_state
   use ek_path, only: path_t
   use ek_remark, only: swept_words, remark_list_t, warning, on_curve
   implicit none(type, external)
   private
   public :: curve_reach_remarks

   !> The range of one curve that was used, and the states at its ends.
   type :: reach_t
      real(wp) :: least = 0.0_wp, most = 0.0_wp      !! m or rad
      integer :: at_least = 0, at_most = 0           !! 0: no state was evaluated
   end type reach_t

contains

   !> One message for each end of a curve that was exceeded by more than a thousandth of its span. Elements from one line of
   !> the deck (the two sides of a mirrored one) with the same curve give one message, for the largest excess.
   subroutine curve_reach_remarks(suspension, case, path, remarks)
      type(suspension_t), intent(in) :: suspension       !! on the rig
      type(case_t), intent(in) :: case                   !! on the rig
      type(path_t), intent(in) :: path
      type(remark_list_t), intent(inout) :: remarks
      type(reach_t) :: reach(6, size(suspension%elements))      ! of an element of one measure: the first
      type(state_t) :: state
      type(bushing_view_t) :: view
      type(curve_t) :: curve
      logical :: is_told(2)
      integer :: s, k, c

      if (.not. (any(suspension%elements%law%has_curve) .or. any(suspension%elements%bushing%has_curves))) return
      state = design_state(suspension)
      do s = 1, path%states
         if (.not. path%is_reached(s)) cycle
         call unpack_state(path%packed(:, s), state)
         do k = 1, size(suspension%elements)
            associate (element => suspension%elements(k), b => suspension%elements(k)%bushing, &
                  pose_i => state%poses(suspension%elements(k)%measure%body_i + 1), &
                  pose_j => state%poses(suspension%elements(k)%measure%body_j + 1))
               if (element%law%has_curve) &
                  call extend(reach(1, k), element%law, measure_value(element%measure, pose_i, pose_j), s)
               if (.not. b%has_curves) cycle
               call look_bushing(b, element%measure, pose_i, pose_j, view)
               do c = 1, 3
                  if (b%laws(c)%has_curve) &
                     call extend(reach(c, k), b%laws(c), dot_product(b%axes(:, c), view%gap), s)
                  if (b%laws(c + 3)%has_curve) &
                     call extend(reach(c + 3, k), b%laws(c + 3), dot_product(b%axes(:, c), view%turn%theta), s)
               end do
            end associate
         end do
      end do
      do k = 1, size(suspension%elements)
         do c = 1, 6
            if (reach(c, k)%at_most == 0) cycle
            is_told = .false.
            do s = 1, size(suspension%elements)
               if (s == k .or. suspension%elements(s)%where /= suspension%elements(k)%where .or. reach(c, s)%at_most == 0) cycle
               is_told = is_told .or. further(reach(c, s), reach(c, k), s < k)
            end do
            associate (element => suspension%elements(k))
               if (element%law%has_curve) then
                  curve = element%law%curve
               else
                  curve = element%bushing%laws(c)%curve
               end if
               call tell(case, path, curve, reach(c, k), element_label(element), element%measure%kind == rotation .or. c > 3, &
                  is_told, remarks)
            end associate
         end do
      end do
   end subroutine curve_reach_remarks

   !> Includes the deflection of a state; a stop without contact has none.
   subroutine extend(reach, law, value, state)
      type(reach_t), intent(inout) :: reach
      type(law_t), intent(in) :: law
      real(wp), intent(in) :: value
      integer, intent(in) :: state
      real(wp) :: e

      e = deflection(law, value)
      if (law%is_one_sided) e = max(e, 0.0_wp)
      if (reach%at_least == 0 .or. e < reach%least) then
         reach%least = e
         reach%at_least = state
      end if
      if (reach%at_most == 0 .or. e > reach%most) then
         reach%most = e
         reach%at_most = state
      end if
   end subroutine extend

   !> Whether another curve of the same line has a larger excess, below and above; of two equal ones the first is reported.
   pure function further(other, own, is_before) result(is_further)
      type(reach_t), intent(in) :: other, own
      logical, intent(in) :: is_before
      logical :: is_further(2)
      real(wp) :: slack

      slack = 1.0e-6_wp*max(abs(own%most), abs(own%least), abs(other%most), abs(other%least))
      is_further(1) = other%least < own%least - slack .or. (is_before .and. other%least < own%least + slack)
      is_further(2) = other%most > own%most + slack .or. (is_before .and. other%most > own%most - slack)
   end function further

   !> The messages on one curve.
   subroutine tell(case, path, curve, reach, thing, is_angle, is_told, remarks)
      type(case_t), intent(in) :: case
      type(path_t), intent(in) :: path
      type(curve_t), intent(in) :: curve
      type(reach_t), intent(in) :: reach
      character(*), intent(in) :: thing
      logical, intent(in) :: is_angle
      logical, intent(in) :: is_told(2)           !! below the first point, beyond the last: reported for another element
      type(remark_list_t), intent(inout) :: remarks
      character(:), allocatable :: head, unit_name
      real(wp) :: unit, slack
      integer :: n

      n = size(curve%breaks)
      slack = 1.0e-3_wp*(curve%breaks(n) - curve%breaks(1))
      unit = merge(degree, millimetre, is_angle)
      unit_name = trim(merge(' deg', ' mm ', is_angle))
      head = 'curve'
      if (allocated(curve%name)) head = head//' '//quoted(curve%name)
      head = head//' of '//thing
      if (reach%least < curve%breaks(1) - slack .and. .not. is_told(1)) &
         call warn('begins', curve%breaks(1), reach%least, reach%at_least, 'before its first')
      if (reach%most > curve%breaks(n) + slack .and. .not. is_told(2)) &
         call warn('ends', curve%breaks(n), reach%most, reach%at_most, 'beyond its last')

   contains

      subroutine warn(verb, limit, used, state, beyond)
         character(*), intent(in) :: verb, beyond
         real(wp), intent(in) :: limit, used
         integer, intent(in) :: state
         call remarks%add(warning, on_curve, case, head//' '//verb//' at '//str(limit/unit, 4)//unit_name//' and was used to '// &
            str(used/unit, 4)//unit_name//', at '//swept_words(case, path%value(state), 4)//'; '//beyond// &
            ' point it is extrapolated linearly', path%value(state))
      end subroutine warn

   end subroutine tell

end module ek_curve_reach
