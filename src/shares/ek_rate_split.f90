!> The wheel rate and the suspension roll rate as sums: the contributions of springs, bushings, bars, stops and preloads to each
!> rate.
!>
!> A vertical load f moves the suspension by f u, and the point of the load by c f. Each part adds its share c_e to the compliance c
!> (module ek_contribution); c_e is twice the elastic energy of the part per f². If the point is moved by 1, the motion is u/c and
!> the rate is k = 1/c = Σ c_e/c². The contribution of a spring is its rate times the square of its motion ratio.
module ek_rate_split
   use ek_kinds, only: wp
   use ek_element, only: element_kinds, spring_share, bar_share, stop_share, bushing_share, gas_share
   use ek_element_label, only: is_rod
   use ek_suspension, only: suspension_t
   use ek_contribution, only: share_t, of_element, of_joint, of_stiffness, geometric
   use ek_contribution_table, only: contribution_table_t
   use ek_port_response, only: load_at_patch, read_at_patch
   use ek_loaded_wheels, only: min_compliance
   implicit none(type, external)
   private
   public :: classes, split_wheel_rate, split_roll_rate

   integer, parameter :: springs = 1, rods = 2, bars = 3, stops = 4, bushings = 5, joints = 6, gas = 7, preloads = 8

   !> The classes by which the parts are summed.
   character(*), parameter :: classes(8) = [character(32) :: 'springs', 'elastic rods', 'anti-roll bar, torsion springs', 'stops', &
      'bushings', 'elastic joints and drivers', 'gas springs', 'preloads and loads (geometric)']

contains

   !> Computes the contributions of the classes to the wheel rate of a wheel, as shares that add up to 1. Both wheels carry the
   !> same load.
   subroutine split_wheel_rate(suspension, table, place, shares, is_known)
      type(suspension_t), intent(in) :: suspension              !! on the rig
      type(contribution_table_t), intent(in) :: table           !! of a state
      integer, intent(in) :: place                              !! index of the wheel in the compliance matrix
      real(wp), intent(out) :: shares(size(classes))
      logical, intent(out) :: is_known                          !! the wheel is not held by joints
      real(wp) :: parts(size(table%row))
      integer :: at

      at = 6*(place - 1)
      parts = 0.0_wp
      if (table%is_known) then
         parts = table%shares%matrix(at + 3, at + 3, :)
         if (table%columns%kandc%compliance%wheels == 2) parts = parts + table%shares%matrix(at + 3, 9 - at, :)
      end if
      call add_up(suspension, table, parts, shares, is_known)
   end subroutine split_wheel_rate

   !> Computes the contributions of the classes to the suspension roll rate, as shares that add up to 1. Both wheels carry opposite
   !> loads.
   subroutine split_roll_rate(suspension, table, shares, is_known)
      type(suspension_t), intent(in) :: suspension              !! on the rig
      type(contribution_table_t), intent(in) :: table           !! of a state
      real(wp), intent(out) :: shares(size(classes))
      logical, intent(out) :: is_known                          !! an axle, not held by joints
      real(wp) :: parts(size(table%row)), share(size(table%shares%matrix, 1), size(table%shares%matrix, 2))
      integer :: e

      parts = 0.0_wp
      if (table%is_known .and. table%columns%kandc%compliance%wheels == 2) then
         do e = 1, size(parts)
            share = read_at_patch(load_at_patch(table%shares%matrix(:, :, e), table%arm), table%arm)
            parts(e) = share(3, 3) - share(3, 9) - share(9, 3) + share(9, 9)
         end do
      end if
      call add_up(suspension, table, parts, shares, is_known)
   end subroutine split_roll_rate

   !> Sums the parts of a compliance by class, as shares of the compliance.
   subroutine add_up(suspension, table, parts, shares, is_known)
      type(suspension_t), intent(in) :: suspension
      type(contribution_table_t), intent(in) :: table
      real(wp), intent(in) :: parts(:)
      real(wp), intent(out) :: shares(size(classes))
      logical, intent(out) :: is_known
      integer :: e, c

      shares = 0.0_wp
      is_known = abs(sum(parts)) > min_compliance
      if (.not. is_known) return
      do e = 1, size(parts)
         c = class_of(suspension, table%shares%share(e))
         shares(c) = shares(c) + parts(e)/sum(parts)
      end do
   end subroutine add_up

   !> Index in `classes` of the class of a part.
   pure integer function class_of(suspension, share) result(group)
      type(suspension_t), intent(in) :: suspension
      type(share_t), intent(in) :: share

      group = preloads
      if (share%kind == of_joint .and. share%part == of_stiffness) group = joints
      if (share%kind /= of_element .or. share%part == geometric) return
      associate (element => suspension%elements(share%item))
         select case (element_kinds(element%kind)%share)
         case (spring_share)
            group = merge(rods, springs, is_rod(suspension%elements, share%item))
         case (bar_share)
            group = bars
         case (stop_share)
            group = stops
         case (bushing_share)
            group = bushings
         case (gas_share)
            group = gas
         end select
      end associate
   end function class_of

end module ek_rate_split
