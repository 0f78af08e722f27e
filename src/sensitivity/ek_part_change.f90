!> The changes of the numbers of the parts of a model with a number p of the deck. They are computed once for each design, from
!> neighbouring designs.
!>
!> A number of the deck affects a few joints, elements and loads. The derivatives of their numbers are differences of neighbouring
!> designs. ek_part_force finds the effect of these changes on F at a state.
module ek_part_change
   use ek_kinds, only: wp
   use ek_same_parts, only: same_wheel, same_law, same_form, same_spring, same_load
   use ek_suspension, only: suspension_t, copy_load
   use ek_state, only: inputs_t
   use ek_measure, only: measure_t
   use ek_element, only: element_t, element_shape, bushing_element, is_linear
   use ek_row, only: row_t, term_t
   use ek_load, only: load_t
   use ek_stencil, only: stencil_t, weight_of, corner_weight
   implicit none(type, external)
   private
   public :: change_t, term_change_t, element_change_t, load_change_t
   public :: draft_t, begin_draft, learn_neighbour, learn_elements, finish_draft, mark_parts

   real(wp), parameter :: rounding = 1.0e-6_wp             !! limit of a corner of preloads [N, N m]; smaller corners are ignored

   !> The derivatives of the numbers of a term of a row with respect to p.
   type :: term_change_t
      integer :: term = 0, row = 0
      logical :: is_touched = .false., has_arms = .false., has_directions = .false.
      real(wp) :: arms(6) = 0.0_wp, u(3) = 0.0_wp, v(3) = 0.0_wp, coefficient = 0.0_wp
   end type term_change_t

   !> The derivatives of the numbers of a row with respect to p.
   type :: row_change_t
      integer :: row = 0
      logical :: is_touched = .false.
      real(wp) :: target = 0.0_wp, compliance = 0.0_wp
   end type row_change_t

   !> The derivatives of the numbers of an element with respect to p.
   type :: element_change_t
      integer :: element = 0
      logical :: is_touched = .false., has_arms = .false., has_directions = .false., has_stiffness = .false., has_load = .false.
      real(wp) :: arms(6) = 0.0_wp, u(3) = 0.0_wp, v(3) = 0.0_wp
      real(wp) :: preload = 0.0_wp, reference = 0.0_wp, rate = 0.0_wp               ! one measure
      real(wp) :: load(6) = 0.0_wp, gap(3) = 0.0_wp, stiffness_t(3, 3) = 0.0_wp, stiffness_r(3, 3) = 0.0_wp   ! bushing
      type(element_t), allocatable :: there(:)   ! of the neighbours, with the markers of the design: laws that are not linear
      ! of each neighbour: preload and reference, or preloads and gap of a bushing with curves. The change of a law may be a
      ! rounding error that some of the neighbours do not have
      real(wp) :: held(9, 4) = 0.0_wp
      logical :: is_held(4) = .false.
   end type element_change_t

   !> The change of a load: the loads of the neighbours, without names.
   type :: load_change_t
      integer :: load = 0
      logical :: is_touched = .false.
      type(load_t) :: there(4)
   end type load_change_t

   !> The parts that a number of the deck changes, with their changes.
   type :: change_t
      type(term_change_t), allocatable :: terms(:)
      type(row_change_t), allocatable :: rows(:)
      type(element_change_t), allocatable :: elements(:)
      type(load_change_t), allocatable :: loads(:)
      type(inputs_t), allocatable :: rates(:)            !! derivatives of the inputs of each state, if the inputs change
      real(wp) :: weight(4) = 0.0_wp, corner(4) = 0.0_wp !! weights of the neighbours in a derivative, and in half the change of a
                                                         !! slope
      real(wp) :: doubt = 0.0_wp                         !! corner of preloads, as a share of the change of the preloads
      logical :: moves_wheels = .false.                  !! numbers of the wheels change
      logical :: has_axes = .false.                      !! the rates of a bushing change, in the axes of body i
      logical :: has_curves = .false.                    !! a law that is not linear changes: F may have a corner
   end type change_t

   !> The changes of all parts, as in change_t, collected while the neighbours are visited.
   type :: draft_t
      type(term_change_t), allocatable, private :: terms(:)
      type(row_change_t), allocatable, private :: rows(:)
      type(element_change_t), allocatable, private :: elements(:)
      type(load_change_t), allocatable, private :: loads(:)
      real(wp), allocatable, private :: bends(:, :)      ! corners of the preloads of each element
   end type draft_t

contains

   !> Begins the change of a number: empties the collected changes, and sets the weights of the neighbours.
   subroutine begin_draft(suspension, stencil, step, draft, change)
      type(suspension_t), intent(in) :: suspension
      type(stencil_t), intent(in) :: stencil
      real(wp), intent(in) :: step
      type(draft_t), intent(inout) :: draft
      type(change_t), intent(out) :: change
      integer :: k

      if (.not. allocated(draft%terms)) allocate (draft%terms(size(suspension%terms)), draft%rows(size(suspension%rows)), &
         draft%elements(size(suspension%elements)), draft%loads(size(suspension%loads)), draft%bends(7, size(suspension%elements)))
      do k = 1, size(draft%terms)
         if (draft%terms(k)%is_touched) draft%terms(k) = term_change_t()
      end do
      do k = 1, size(draft%rows)
         if (draft%rows(k)%is_touched) draft%rows(k) = row_change_t()
      end do
      do k = 1, size(draft%elements)
         if (draft%elements(k)%is_touched) draft%elements(k) = element_change_t()
      end do
      do k = 1, size(draft%loads)
         draft%loads(k)%is_touched = .false.
      end do
      draft%bends(:, :) = 0.0_wp
      do k = 1, 4
         change%weight(k) = weight_of(stencil, k)/step
         change%corner(k) = corner_weight(stencil, k)/step
      end do
   end subroutine begin_draft

   !> Adds the differences between neighbour k of the stencil and the design.
   !> Equation (E.7) of docs/theory/derivatives.md.
   subroutine learn_neighbour(here, there, k, change, draft)
      type(suspension_t), intent(in) :: here, there        !! the design and its neighbour, on the same rig
      integer, intent(in) :: k
      type(change_t), intent(inout) :: change
      type(draft_t), intent(inout) :: draft
      integer :: r, t, e

      change%moves_wheels = change%moves_wheels .or. .not. all(same_wheel(here%wheels, there%wheels))
      do r = 1, size(here%rows)
         call learn_row(here%rows(r), there%rows(r), r, change%weight(k), draft%rows(r))
         do t = here%rows(r)%first, here%rows(r)%first + here%rows(r)%terms - 1
            call learn_term(here%terms(t), there%terms(t), t, r, change%weight(k), draft%terms(t))
         end do
      end do
      call learn_elements(here, there, k, [(.true., e=1, size(here%elements))], change, draft)
      do e = 1, size(here%loads)
         call learn_load(here%loads(e), there%loads(e), e, k, draft%loads(e))
      end do
   end subroutine learn_neighbour

   !> Adds the differences between some elements of neighbour k of the stencil and of the design.
   !> Equation (E.7) of docs/theory/derivatives.md.
   subroutine learn_elements(here, there, k, is_meant, change, draft)
      type(suspension_t), intent(in) :: here, there        !! the design and its neighbour, on the same rig
      integer, intent(in) :: k
      logical, intent(in) :: is_meant(:)                   !! of each element
      type(change_t), intent(inout) :: change
      type(draft_t), intent(inout) :: draft
      integer :: e

      do e = 1, size(here%elements)
         if (.not. is_meant(e)) cycle
         if (here%elements(e)%kind == bushing_element) then
            call learn_bushing(here%elements(e), there%elements(e), e, k, change, draft%elements(e), draft%bends(:, e))
         else
            call learn_spring(here%elements(e), there%elements(e), e, k, change, draft%elements(e), draft%bends(:, e))
         end if
      end do
   end subroutine learn_elements

   !> Stores the parts that the number affects in `change`, and finds the corner of the preloads.
   subroutine finish_draft(step, draft, change)
      real(wp), intent(in) :: step
      type(draft_t), intent(inout) :: draft
      type(change_t), intent(inout) :: change
      real(wp) :: jump
      integer :: k, used

      change%terms = pack(draft%terms, draft%terms%is_touched)
      change%rows = pack(draft%rows, draft%rows%is_touched)
      change%loads = pack(draft%loads, draft%loads%is_touched)
      allocate (change%elements(count(draft%elements%is_touched)))
      used = 0
      do k = 1, size(draft%elements)
         if (.not. draft%elements(k)%is_touched) cycle
         used = used + 1
         if (allocated(draft%elements(k)%there)) call put_held(draft%elements(k))
         change%elements(used) = draft%elements(k)
         change%has_curves = change%has_curves .or. allocated(draft%elements(k)%there)
         change%has_axes = change%has_axes .or. draft%elements(k)%has_stiffness
      end do
      jump = sum(abs(draft%bends))
      if (jump*step > rounding) change%doubt = jump/(jump + sum(abs(change%elements%preload)) + &
         sum([(sum(abs(change%elements(k)%load)), k=1, used)]))
   end subroutine finish_draft

   !> Sets the preloads in the laws of the neighbours.
   pure subroutine put_held(change)
      type(element_change_t), intent(inout) :: change
      integer :: k

      do k = 1, 4
         if (.not. change%is_held(k)) cycle
         associate (there => change%there(k), held => change%held(:, k))
            if (there%kind == bushing_element) then
               there%bushing%preload_force = held(1:3)
               there%bushing%preload_moment = held(4:6)
               there%bushing%gap0 = held(7:9)
            else
               there%preload = held(1)
               there%law%reference = held(2)
            end if
         end associate
      end do
   end subroutine put_held

   !> Marks the terms and elements that the number affects.
   pure subroutine mark_parts(change, terms, elements)
      type(change_t), intent(in) :: change
      logical, intent(inout) :: terms(:), elements(:)

      terms(change%terms%term) = .true.
      elements(change%elements%element) = .true.
   end subroutine mark_parts

   !> Adds the weighted change of a row (target, compliance) between two designs.
   pure subroutine learn_row(here, there, number, weight, change)
      type(row_t), intent(in) :: here, there
      integer, intent(in) :: number
      real(wp), intent(in) :: weight
      type(row_change_t), intent(inout) :: change

      if (.not. (abs(there%target - here%target) > 0.0_wp .or. abs(there%compliance - here%compliance) > 0.0_wp)) return
      change%row = number
      change%is_touched = .true.
      change%target = change%target + weight*(there%target - here%target)
      change%compliance = change%compliance + weight*(there%compliance - here%compliance)
   end subroutine learn_row

   !> Adds the weighted change of a term of a row between two designs.
   pure subroutine learn_term(here, there, number, row, weight, change)
      type(term_t), intent(in) :: here, there
      integer, intent(in) :: number, row
      real(wp), intent(in) :: weight
      type(term_change_t), intent(inout) :: change

      call learn_measure(here%measure, there%measure, weight, change%arms, change%u, change%v, change%has_arms, &
         change%has_directions)
      change%coefficient = change%coefficient + weight*(there%coefficient - here%coefficient)
      if (.not. (change%has_arms .or. change%has_directions .or. abs(there%coefficient - here%coefficient) > 0.0_wp)) return
      change%term = number
      change%row = row
      change%is_touched = .true.
   end subroutine learn_term

   !> Adds the weighted changes of the arms and directions of a measure between two designs.
   pure subroutine learn_measure(here, there, weight, arms, u, v, has_arms, has_directions)
      type(measure_t), intent(in) :: here, there
      real(wp), intent(in) :: weight
      real(wp), intent(inout) :: arms(6), u(3), v(3)
      logical, intent(inout) :: has_arms, has_directions

      if (any(abs(there%arm_i - here%arm_i) > 0.0_wp) .or. any(abs(there%arm_j - here%arm_j) > 0.0_wp)) then
         has_arms = .true.
         arms(1:3) = arms(1:3) + weight*(there%arm_i - here%arm_i)
         arms(4:6) = arms(4:6) + weight*(there%arm_j - here%arm_j)
      end if
      if (any(abs(there%u - here%u) > 0.0_wp) .or. any(abs(there%v - here%v) > 0.0_wp)) then
         has_directions = .true.
         u = u + weight*(there%u - here%u)
         v = v + weight*(there%v - here%v)
      end if
   end subroutine learn_measure

   !> Adds the weighted changes of an element with one measure between two designs. If its nonlinear law changes, stores the law.
   pure subroutine learn_spring(here, there, number, k, all, change, bends)
      type(element_t), intent(in) :: here, there
      integer, intent(in) :: number, k
      type(change_t), intent(in) :: all
      type(element_change_t), intent(inout) :: change
      real(wp), intent(inout) :: bends(7)
      logical :: has_load

      call learn_measure(here%measure, there%measure, all%weight(k), change%arms, change%u, change%v, change%has_arms, &
         change%has_directions)
      has_load = .not. (same_spring(here, there, 1) .and. same_law(here%law, there%law))
      change%is_held(k) = .true.
      change%held(1:2, k) = [there%preload, there%law%reference]
      if (.not. (has_load .or. change%has_arms .or. change%has_directions)) return
      change%element = number
      change%is_touched = .true.
      if (.not. has_load) return
      change%has_load = .true.
      associate (weight => all%weight(k))
         change%preload = change%preload + weight*(there%preload - here%preload)
         change%reference = change%reference + weight*(there%law%reference - here%law%reference)
         change%rate = change%rate + weight*(there%law%rate - here%law%rate)
      end associate
      bends(1) = bends(1) + all%corner(k)*(there%preload - here%preload)
      if (is_linear(here)) return
      if (same_form(here%law, there%law) .and. same_spring(here, there, element_shape) .and. &
         .not. abs(there%law%rate - here%law%rate) > 0.0_wp) return
      call keep_neighbour(here, there, k, change%there)
   end subroutine learn_spring

   !> Adds the weighted changes of a bushing between two designs. If its nonlinear laws change, stores the laws.
   pure subroutine learn_bushing(here, there, number, k, all, change, bends)
      type(element_t), intent(in) :: here, there
      integer, intent(in) :: number, k
      type(change_t), intent(in) :: all
      type(element_change_t), intent(inout) :: change
      real(wp), intent(inout) :: bends(7)
      real(wp) :: load(6)

      call learn_measure(here%measure, there%measure, all%weight(k), change%arms, change%u, change%v, change%has_arms, &
         change%has_directions)
      associate (p => here%bushing, q => there%bushing, weight => all%weight(k))
         load = [q%force0 - p%force0, q%moment0 - p%moment0]
         if (any(abs(load) > 0.0_wp) .or. any(abs(q%gap0 - p%gap0) > 0.0_wp)) then
            change%has_load = .true.
            change%load = change%load - weight*load
            change%gap = change%gap + weight*(q%gap0 - p%gap0)
            bends(2:7) = bends(2:7) + all%corner(k)*load
         end if
         if (p%has_curves) then
            change%is_held(k) = .true.
            change%held(:, k) = [q%preload_force, q%preload_moment, q%gap0]
            if (.not. same_components(here, there)) call keep_neighbour(here, there, k, change%there)
         else if (any(abs(q%stiffness_t - p%stiffness_t) > 0.0_wp) .or. any(abs(q%stiffness_r - p%stiffness_r) > 0.0_wp)) then
            change%has_stiffness = .true.
            change%stiffness_t = change%stiffness_t + weight*(q%stiffness_t - p%stiffness_t)
            change%stiffness_r = change%stiffness_r + weight*(q%stiffness_r - p%stiffness_r)
         end if
      end associate
      if (.not. (change%has_arms .or. change%has_load .or. change%has_stiffness .or. allocated(change%there))) return
      change%element = number
      change%is_touched = .true.
   end subroutine learn_bushing

   !> Stores the law of a neighbour with the markers of the design.
   pure subroutine keep_neighbour(here, there, k, laws)
      type(element_t), intent(in) :: here, there
      integer, intent(in) :: k
      type(element_t), allocatable, intent(inout) :: laws(:)
      integer :: j

      if (.not. allocated(laws)) then
         allocate (laws(4))
         do j = 1, 4
            laws(j) = here
         end do
      end if
      laws(k) = there
      laws(k)%measure = here%measure
   end subroutine keep_neighbour

   !> Stores the load of neighbour k, if the load differs from the load of the design.
   pure subroutine learn_load(here, there, number, k, change)
      type(load_t), intent(in) :: here, there
      integer, intent(in) :: number, k
      type(load_change_t), intent(inout) :: change
      integer :: j

      if (same_load(here, there)) return
      if (.not. change%is_touched) then
         change%load = number
         change%is_touched = .true.
         do j = 1, 4
            call copy_load(here, change%there(j))
         end do
      end if
      call copy_load(there, change%there(k))
   end subroutine learn_load

   !> Whether two bushings with curves have equal rates, equal curves, and equal axes to rounding.
   pure logical function same_components(a, b)
      type(element_t), intent(in) :: a, b
      integer :: c

      associate (p => a%bushing, q => b%bushing)
         same_components = .not. (any(abs(p%axes - q%axes) > 8.0_wp*epsilon(1.0_wp)) .or. any(abs(p%kt - q%kt) > 0.0_wp) .or. &
            any(abs(p%kr - q%kr) > 0.0_wp))
         do c = 1, size(p%laws)
            same_components = same_components .and. same_law(p%laws(c), q%laws(c))
         end do
      end associate
   end function same_components

end module ek_part_change
