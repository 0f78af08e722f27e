!> &point, &body, &mass and &load.
module ek_reader_bodies
   use ek_kinds, only: wp
   use ek_complaint, only: single, left_side, right_side
   use ek_suspension, only: body_t, load_t
   use ek_blueprint, only: vector_t, body_plan_t, mass_plan_t, load_plan_t, hardpoint, off_left, off_right, in_plane
   use ek_design_vector, only: plane
   use ek_draft, only: draft_t, complain, where_of, has_key, choice, text_of, switch_of, number_of, slot
   use ek_reference, only: find_point, find_moving_body, new_vector
   implicit none(type, external)
   private
   public :: read_point, read_body, read_mass, read_load

contains

   !> &point: a design position.
   subroutine read_point(draft)
      type(draft_t), intent(inout) :: draft
      type(vector_t) :: vector
      real(wp) :: at(3)
      integer :: number

      vector%kind = hardpoint
      call slot(draft, 'at', draft%units%length, vector%first, default=0.0_wp, count=3)
      call new_vector(draft, vector, number)
      draft%cards(draft%k)%index = number
      at = draft%vectors(:, number)
      associate (stays => draft%plan%vectors(number)%stays)
         select case (draft%records(draft%k)%side)
         case (left_side)
            stays = off_left
         case (right_side)
            stays = off_right
         case default
            if (abs(at(2)) < plane .and. any(draft%records%side /= single)) stays = in_plane
         end select
      end associate
   end subroutine read_point

   !> &body.
   subroutine read_body(draft)
      type(draft_t), intent(inout) :: draft
      type(body_plan_t) :: plan
      type(body_t) :: body
      logical :: is_found, has_centre

      call find_point(draft, 'origin', text_of(draft, 'origin'), plan%origin, is_found)
      call find_point(draft, 'centre', text_of(draft, 'centre'), plan%centre, has_centre)
      if (has_key(draft, 'mass') .neqv. has_key(draft, 'centre')) call complain(draft, &
         trim(merge('mass  ', 'centre', has_key(draft, 'mass'))), 'give mass and centre (of gravity) together')
      call slot(draft, 'mass', 1.0_wp, plan%mass)
      body%name = text_of(draft, 'name')
      body%where = where_of(draft)
      body%has_origin = plan%origin > 0
      body%mass = number_of(draft, 'mass', 0.0_wp)
      draft%plan%prototype%bodies = [draft%plan%prototype%bodies, body]
      draft%plan%bodies = [draft%plan%bodies, plan]
      draft%cards(draft%k)%index = size(draft%plan%bodies)
   end subroutine read_body

   !> &mass: a further mass of a body, in addition to that of &body.
   subroutine read_mass(draft)
      type(draft_t), intent(inout) :: draft
      type(mass_plan_t) :: plan
      logical :: has_body, has_place

      call find_moving_body(draft, plan%body, has_body)
      call find_point(draft, 'at', text_of(draft, 'at'), plan%at, has_place)
      if (.not. draft%cards(draft%k)%is_good .or. .not. has_body .or. .not. has_place) return
      call slot(draft, 'kg', 1.0_wp, plan%kg)
      associate (body => draft%plan%prototype%bodies(plan%body))      ! whether it has a weight
         body%mass = body%mass + number_of(draft, 'kg', 1.0_wp)
      end associate
      draft%plan%masses = [draft%plan%masses, plan]
   end subroutine read_mass

   !> &load: force and moment in global axes.
   subroutine read_load(draft)
      type(draft_t), intent(inout) :: draft
      type(load_plan_t) :: plan
      type(load_t) :: element
      logical :: has_body, is_found
      integer :: c

      call find_moving_body(draft, element%body, has_body)
      call find_point(draft, 'at', text_of(draft, 'at'), plan%at, is_found)
      call choice(draft, 'factor', [character(8) :: 'constant', 'case'], c, default=1)
      if (.not. (has_key(draft, 'force') .or. has_key(draft, 'moment'))) &
         call complain(draft, '', "give 'force' or 'moment'")
      element%is_case = c /= 1
      ! stored for a rejected load too: a case may check whether it is scaled
      draft%cards(draft%k)%is_used = element%is_case
      if (.not. draft%cards(draft%k)%is_good) return

      call slot(draft, 'force', draft%units%force, plan%force, default=0.0_wp, count=3)
      call slot(draft, 'moment', draft%units%force*draft%units%length, plan%moment, default=0.0_wp, count=3)
      element%name = text_of(draft, 'name')
      element%where = where_of(draft)
      element%follows = switch_of(draft, 'follows', .false.)
      draft%plan%prototype%loads = [draft%plan%prototype%loads, element]
      draft%plan%loads = [draft%plan%loads, plan]
   end subroutine read_load

end module ek_reader_bodies
