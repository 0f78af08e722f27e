!> All forces and moments on each part (body) at a state, for stress analysis: members, loads of the deck, forces of the road, drivers
!> of the rig, weight and inertia.
!>
!> A load is given twice: at the hardpoint as it has moved, in the frame of the deck; and at the hardpoint as drawn, in the axes of
!> the part, which coincide with the frame of the deck at design and move with the part. The second form is loaded onto the drawn
!> part. The loads on a part at a state form a block, whose forces and moments about any point sum to zero in equilibrium.
module ek_part_loads
   use ek_kinds, only: wp
   use ek_block, only: rotated
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t
   use ek_kkt, only: kkt_t, wrench
   use ek_member_loads, only: member_end_t, member_ends, end_loads
   use ek_wheel_side, only: deck_frame
   implicit none(type, external)
   private
   public :: part_load_t, part_loads

   !> One load on a part: its origin, point of application, force and moment about this point.
   type :: part_load_t
      character(:), allocatable :: source, point    !! name of the member or load; hardpoint: '' if there is none
      integer :: body = 0
      real(wp) :: at(3) = 0.0_wp                    !! point at the state, frame of the deck [m]
      real(wp) :: force(3) = 0.0_wp, moment(3) = 0.0_wp           !! frame of the deck [N, N m]
      real(wp) :: drawn_at(3) = 0.0_wp              !! point at design, frame of the deck [m]
      real(wp) :: own_force(3) = 0.0_wp, own_moment(3) = 0.0_wp   !! axes of the part [N, N m]
   end type part_load_t

contains

   !> Lists all loads on all bodies at a state, in the order of the bodies.
   subroutine part_loads(suspension, state, kkt, loads)
      type(suspension_t), intent(in) :: suspension        !! on the rig
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt                      !! assembled at this state
      type(part_load_t), allocatable, intent(out) :: loads(:)
      type(member_end_t), allocatable :: ends(:)
      real(wp), allocatable :: values(:, :)
      real(wp) :: inertia(3)
      integer :: b, k

      call member_ends(suspension, .true., ends)
      allocate (values(6, size(ends)), loads(0))
      call end_loads(suspension, state, kkt%gradients, ends, values)
      do b = 1, size(suspension%bodies)
         do k = 1, size(ends)
            if (ends(k)%number == b) call add(ends(k)%member, ends(k)%point, ends(k)%arm, values(1:3, k), values(4:6, k))
         end do
         inertia = 0.0_wp
         do k = 1, size(suspension%loads)
            associate (load => suspension%loads(k))
               if (load%body /= b) cycle
               if (load%start_of > 0 .and. .not. norm2(load%force) > 0.0_wp) cycle
               if (load%is_weight .and. load%is_case) then
                  inertia = inertia + kkt%factor(k)*load%force
                  cycle
               end if
               call add_load(k)
            end associate
         end do
         if (any([(suspension%loads(k)%body == b .and. suspension%loads(k)%is_weight .and. suspension%loads(k)%is_case, &
            k=1, size(suspension%loads))])) call add('inertia of '//suspension%bodies(b)%name, '', suspension%bodies(b)%centre, &
            deck_frame(suspension)*inertia, [0.0_wp, 0.0_wp, 0.0_wp])
      end do

   contains

      !> Adds a load of the deck or of the rig.
      subroutine add_load(k)
         integer, intent(in) :: k
         real(wp) :: force(3), moment(3), arm(3), frame(3), place(3)

         frame = deck_frame(suspension)
         associate (load => suspension%loads(k))
            call wrench(load, state%poses(b + 1), force, moment, arm)
            moment = moment - cross(arm, force)
            place = load%arm
            if (load%wheel > 0) place = matmul(arm, state%poses(b + 1)%a)      ! the lowest point of the wheel
            call add(load%name, '', place, kkt%factor(k)*frame*force, kkt%factor(k)*frame*moment)
         end associate
      end subroutine add_load

      !> Adds a load on body b at a point given in the axes of the body.
      subroutine add(source, point, arm, force, moment)
         character(*), intent(in) :: source, point
         real(wp), intent(in) :: arm(3)              !! from the reference point, body axes [m]
         real(wp), intent(in) :: force(3), moment(3) !! frame of the deck; moment about the point
         type(part_load_t) :: this
         real(wp) :: frame(3), turn(3, 3)
         integer :: p

         frame = deck_frame(suspension)
         associate (pose => state%poses(b + 1), body => suspension%bodies(b))
            this%source = source
            this%point = point
            this%body = b
            this%at = frame*(pose%r + rotated(pose%a, arm))
            this%force = force
            this%moment = moment
            this%drawn_at = frame*(body%origin + arm)
            do p = 1, size(suspension%points)
               if (this%point /= '') exit
               if (norm2(frame*suspension%points(p)%at - this%drawn_at) < 1.0e-9_wp) this%point = suspension%points(p)%name
            end do
            turn = transpose(reshape([(rotated(pose%a, unit(p)), p=1, 3)], [3, 3]))
            this%own_force = frame*matmul(turn, frame*force)
            this%own_moment = frame*matmul(turn, frame*moment)
         end associate
         loads = [loads, this]
      end subroutine add

      !> Unit vector along axis p.
      pure function unit(p)
         integer, intent(in) :: p
         real(wp) :: unit(3)
         unit = 0.0_wp
         unit(p) = 1.0_wp
      end function unit

   end subroutine part_loads

end module ek_part_loads
