!> The rates that contribute most to the key compliances of a suspension. A reader of the report may change them on the page.
!>
!> A rate is the constant of one law: an axis of a bushing, a spring, a bar, or the stiffness of a driver. Corresponding laws of the
!> left and the right side with equal constants are one rate. Laws with a curve or a clearance have no rate.
module ek_live_rates
   use ek_kinds, only: wp
   use ek_largest, only: largest
   use ek_element_part, only: is_part_of_angle, has_rate
   use ek_suspension, only: suspension_t
   use ek_text, only: str
   use ek_schedule, only: new_schedule
   use ek_case_result, only: case_result_t
   use ek_contribution, only: contribution_t, of_stiffness
   use ek_measure, only: is_of_angle
   use ek_contribution_table, only: contribution_table_t, start_contributions, choose_contributions, find_contributions, &
      is_key_compliance, share_length
   implicit none(type, external)
   private
   public :: live_rate_t, live_rates_t, choose_rates, find_laws, rate_path

   real(wp), parameter :: same = 1.0e-9_wp      !! relative difference up to which rates are equal

   !> A rate that can be changed.
   type :: live_rate_t
      character(share_length) :: group = ''            !! group of the deck: 'bushing', 'spring', 'torsion', 'joint'
      character(share_length) :: element(2) = ''       !! names of the elements, left and right; (2) is '' for one element
      character(10) :: part = ''                       !! name of the law: 'x' to 'rz' of a bushing, 'rate', 'stiffness'
      integer :: number = 0                            !! index of the law in the element, 1 to 6; of_stiffness: of a driver
      real(wp) :: rate = 0.0_wp                        !! rate of the law [N/m, N m/rad]
      logical :: is_of_angle = .false.
   end type live_rate_t

   !> All selected rates, and the laws that have these rates.
   type :: live_rates_t
      type(live_rate_t), allocatable :: rate(:)
      integer, allocatable :: of_law(:)                !! index of the rate of each law; a rate of both sides has two, left first
   end type live_rates_t

contains

   !> Chooses the rates with the largest contributions to a key compliance at a state, the largest first. The list is empty if the
   !> matrix of the state is singular.
   subroutine choose_rates(result, k, many, rates)
      type(case_result_t), intent(inout) :: result         !! is_run
      integer, intent(in) :: k                             !! index of the state, which was reached
      integer, intent(in) :: many                          !! greatest number of rates
      type(live_rates_t), intent(out) :: rates
      type(contribution_table_t) :: table
      type(live_rate_t), allocatable :: all(:)
      logical, allocatable :: is_wanted(:)
      real(wp), allocatable :: score(:)
      integer, allocatable :: order(:)
      integer :: j

      call start_contributions(result%suspension, table)
      allocate (is_wanted(table%columns%used), all(0), score(0))
      do j = 1, size(is_wanted)
         is_wanted(j) = is_key_compliance(trim(table%columns%names(j)))
      end do
      if (any(is_wanted)) then
         call choose_contributions(is_wanted, table)
         call find_contributions(result%suspension, new_schedule(result%suspension, result%case), result%path, k, result%kkt, table)
         if (table%is_known) call list_rates(result%suspension, table, all, score)
      end if
      call largest(score, many, order)
      allocate (rates%rate(size(order)), rates%of_law(0))
      do j = 1, size(order)
         rates%rate(j) = all(order(j))
         rates%of_law = [rates%of_law, j]
         if (rates%rate(j)%element(2) /= '') rates%of_law = [rates%of_law, j]
      end do
   end subroutine choose_rates

   !> Lists all rates and, as a score, the largest contribution of each rate to a requested column [-]: its share of the sum of the
   !> magnitudes of all contributions.
   subroutine list_rates(suspension, table, all, score)
      type(suspension_t), intent(in) :: suspension
      type(contribution_table_t), intent(in) :: table       !! at the state
      type(live_rate_t), allocatable, intent(inout) :: all(:)
      real(wp), allocatable, intent(inout) :: score(:)
      type(live_rate_t) :: new
      integer :: l, k, row

      do l = 1, size(table%shares%law)
         k = table%shares%law(l)
         associate (part => table%shares%share(k))
            if (.not. has_rate(suspension%elements(part%item), part%part) .or. .not. table%shares%slope(l) > 0.0_wp) cycle
            new%group = table%row(k)%kind
            new%number = part%part
            new%rate = table%shares%slope(l)
            new%is_of_angle = is_part_of_angle(suspension%elements(part%item), part%part)
         end associate
         call add(k)
      end do
      do k = 1, size(table%shares%share)
         associate (part => table%shares%share(k))
            if (part%part /= of_stiffness) cycle
            row = suspension%joints(part%item)%first_row
            new%group = 'joint'
            new%number = of_stiffness
            new%rate = 1.0_wp/suspension%rows(row)%compliance
            new%is_of_angle = is_of_angle(suspension%terms(suspension%rows(row)%first)%measure%kind)
         end associate
         call add(k)
      end do

   contains

      !> Adds the new rate, or a rate on the right side to that on the left.
      subroutine add(k)
         integer, intent(in) :: k                            !! index of its share
         real(wp) :: share
         integer :: c, at

         share = 0.0_wp
         do c = 1, size(table%values)
            if (.not. sum(abs(table%parts(c, :))) > 0.0_wp) cycle
            share = max(share, abs(table%parts(c, k))/sum(abs(table%parts(c, :))))
         end do
         new%element = [character(share_length) :: table%row(k)%row, '']
         new%part = table%row(k)%part
         at = other_side(all, new)
         if (at > 0) then
            all(at)%element(2) = new%element(1)
            score(at) = max(score(at), share)
         else
            all = [all, new]
            score = [score, share]
         end if
      end subroutine add

   end subroutine list_rates

   !> Index of the equal rate of the same part on the left side, for a new rate on the right side; 0 without such a rate.
   pure integer function other_side(all, new) result(at)
      type(live_rate_t), intent(in) :: all(:), new

      do at = size(all), 1, -1
         if (all(at)%element(2) /= '' .or. all(at)%part /= new%part .or. all(at)%group /= new%group) cycle
         if (index(all(at)%element(1), 'left_') /= 1 .or. index(new%element(1), 'right_') /= 1) cycle
         if (all(at)%element(1) (6:) == new%element(1) (7:) .and. abs(all(at)%rate - new%rate) <= same*new%rate) return
      end do
      at = 0
   end function other_side

   !> Finds the indices of the laws with live rates among the contributions of a test, in the order of `of_law`; 0 for a law that
   !> the test does not have.
   subroutine find_laws(suspension, shares, rates, laws)
      type(suspension_t), intent(in) :: suspension          !! on the rig of the test
      type(contribution_t), intent(in) :: shares            !! of the test, with or without the drivers
      type(live_rates_t), intent(in) :: rates
      integer, allocatable, intent(out) :: laws(:)
      integer :: j, l, side

      allocate (laws(size(rates%of_law)), source=0)
      do j = 1, size(laws)
         side = 1
         if (j > 1) side = merge(2, 1, rates%of_law(j) == rates%of_law(max(1, j - 1)))
         associate (rate => rates%rate(rates%of_law(j)))
            do l = 1, size(shares%law)
               associate (share => shares%share(shares%law(l)))
                  if (share%part /= rate%number) cycle
                  if (share%part == of_stiffness) then
                     if (suspension%joints(share%item)%name == trim(rate%element(side))) laws(j) = l
                  else if (suspension%elements(share%item)%name == trim(rate%element(side))) then
                     laws(j) = l
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine find_laws

   !> The path of the number of the deck that a rate is: 'bushing.left_lca.kt(1)'.
   pure function rate_path(rate, side) result(path)
      type(live_rate_t), intent(in) :: rate
      integer, intent(in) :: side                          !! index of the element
      character(:), allocatable :: path

      path = trim(rate%group)//'.'//trim(rate%element(side))//'.'
      select case (rate%group)
      case ('bushing')
         path = path//trim(merge('kr', 'kt', rate%number > 3))//'('//str(mod(rate%number - 1, 3) + 1)//')'
      case ('damper')
         path = path//'gas_rate'
      case ('joint')
         path = path//'stiffness'
      case default
         path = path//'rate'
      end select
   end function rate_path

end module ek_live_rates
