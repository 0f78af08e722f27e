!> Describes a motion of the bodies in a message: the bodies, the line of the motion, and the hardpoints on this line.
module ek_motion_text
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, quoted, vector_text, plural
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_wheel_side, only: deck_frame
   use ek_state, only: state_t
   use ek_kkt, only: kkt_t
   implicit none(type, external)
   private
   public :: motion_text, moving_text, body_parts, main_body, place

   real(wp), parameter :: takes_part = 1.0e-3_wp          !! limit, as a share of the largest motion: smaller motions are omitted

contains

   !> The location of a record as ' (file:line)'; '' if the location is not known.
   pure function place(where) result(text)
      character(*), intent(in) :: where
      character(:), allocatable :: text
      text = ''
      if (len(where) > 0) text = ' ('//where//')'
   end function place

   !> The size of the motion of each body: the norm of its six scaled unknowns.
   pure function body_parts(motion) result(part)
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      real(wp) :: part(size(motion)/6)
      part = norm2(reshape(motion, [6, size(part)]), dim=1)
   end function body_parts

   !> Index of the body that moves most. Of bodies whose motions are equal within 1e-4 (left and right of a symmetric axle), the
   !> first.
   pure integer function main_body(motion)
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      real(wp), parameter :: equal = 1.0e-4_wp
      real(wp) :: part(size(motion)/6)

      part = body_parts(motion)
      main_body = max(1, findloc(part >= (1.0_wp - equal)*maxval(part), .true., dim=1))      ! 1: not a number
   end function main_body

   !> Description of the body that moves most, its motion, and the bodies that move with it. One or two other bodies are listed
   !> with their motion; of more bodies, up to six names are listed.
   function motion_text(suspension, state, kkt, motion) result(text)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      character(:), allocatable :: text
      real(wp) :: part(size(suspension%bodies))
      integer, parameter :: max_described = 2, max_named = 6
      character(:), allocatable :: names
      integer :: k, main, named, others

      part = body_parts(motion)
      main = main_body(motion)
      text = 'body '//quoted(suspension%bodies(main)%name)//place(suspension%bodies(main)%where)//' '// &
         one_body_text(suspension, state%poses(main + 1)%r, kkt, motion(6*main - 5:6*main), main)
      others = count(part > takes_part*part(main)) - 1
      named = 0
      names = ''
      do k = 1, size(part)
         if (k == main .or. part(k) <= takes_part*part(main)) cycle
         named = named + 1
         if (others <= max_described) then
            text = text//'; body '//quoted(suspension%bodies(k)%name)//' '// &
               one_body_text(suspension, state%poses(k + 1)%r, kkt, motion(6*k - 5:6*k), k)
         else if (named <= max_named) then
            names = names//', '//quoted(suspension%bodies(k)%name)
         end if
      end do
      if (others > max_named) names = names//' and '//plural(others - max_named, 'body', 'bodies')//' more'
      if (others > max_described) text = text//'; the following bodies move with it: '//names(3:)
   end function motion_text

   !> Description of a motion. If a wheel steers, the description begins with the wheel; of a second wheel, it names only the wheel.
   function moving_text(suspension, state, kkt, motion, has_steering) result(text)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      logical, intent(inout) :: has_steering       !! a wheel that steers was described before
      character(:), allocatable :: text

      text = steering_text(suspension, kkt, motion)
      if (text /= '' .and. has_steering) then
         text = text//', too'
         return
      end if
      has_steering = has_steering .or. text /= ''
      if (text /= '') text = text//': is a tie rod or toe link missing? '
      text = text//motion_text(suspension, state, kkt, motion)
   end function moving_text

   !> Phrase about a motion in which a wheel steers: "wheel 'left' can steer freely"; '' for other motions.
   !> The carrier, the body that moves most, turns about an axis within 25° of the vertical that passes near the wheel centre.
   function steering_text(suspension, kkt, motion) result(text)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      character(:), allocatable :: text
      real(wp), parameter :: upright = 0.9_wp      ! cosine: 25°
      real(wp), parameter :: beside = 0.4_wp       ! m: distance of the axis from the wheel centre
      real(wp) :: v(3), w(3), axis(3)
      integer :: main, k

      text = ''
      main = main_body(motion)
      k = findloc(suspension%wheels%body, main, dim=1)
      if (k == 0) return
      if (count(suspension%wheels%body == main) > 1) return
      v = motion(6*main - 5:6*main - 3)*kkt%scale(6*main - 5)
      w = motion(6*main - 2:6*main)*kkt%scale(6*main - 2)
      if (norm2(w)*kkt%length < norm2(v)*takes_part) return
      axis = w/norm2(w)
      if (abs(axis(3)) < upright) return
      ! the wheel centre moves with v + w × arm: across the axis by its distance from the axis
      v = v + cross(w, suspension%wheels(k)%centre)
      if (norm2(v - dot_product(v, axis)*axis) > beside*norm2(w) .or. abs(dot_product(v, axis)) > 0.1_wp*norm2(w)) return
      text = 'wheel '//quoted(suspension%wheels(k)%name)//' can steer freely'
   end function steering_text

   !> Phrase about the motion of a body: 'turns freely about the axis …' or 'slides freely along …'.
   function one_body_text(suspension, r, kkt, motion, body) result(text)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: r(3), motion(6)
      type(kkt_t), intent(in) :: kkt
      integer, intent(in) :: body
      character(:), allocatable :: text
      real(wp) :: v(3), w(3), axis(3), through(3), lead

      v = motion(1:3)*kkt%scale(6*body - 5)
      w = motion(4:6)*kkt%scale(6*body - 2)
      if (norm2(w)*kkt%length < takes_part*norm2(v)) then
         axis = deck_frame(suspension)*v/norm2(v)
         text = 'slides freely along '//vector_text(axis, 4)
         return
      end if
      axis = w/norm2(w)
      through = r + cross(axis, v)/norm2(w)
      lead = dot_product(v, axis)/norm2(w)
      text = 'turns freely about the axis '//vector_text(deck_frame(suspension)*tidy(axis), 3)//' through '// &
         vector_text(deck_frame(suspension)*merge(through, 0.0_wp, abs(through) > 1.0e-12_wp)/millimetre, 5)//' mm'// &
         points_on(suspension, axis, through)
      if (abs(lead) > takes_part*kkt%length) text = text//', sliding '//str(lead/millimetre, 3)//' mm/rad along it'
   end function one_body_text

   !> The axis with components below 1e-6 set to zero, and with its largest component positive.
   pure function tidy(axis) result(clean)
      real(wp), intent(in) :: axis(3)
      real(wp) :: clean(3)
      clean = merge(axis, 0.0_wp, abs(axis) > 1.0e-6_wp)
      if (clean(maxloc(abs(clean), dim=1)) < 0.0_wp) clean = -clean
   end function tidy

   !> Up to four hardpoints on an axis as " (the line of 'a', 'b')"; '' if no hardpoint is on the axis.
   pure function points_on(suspension, axis, through) result(text)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: axis(3), through(3)
      character(:), allocatable :: text
      real(wp), parameter :: near = 0.5e-3_wp     ! m: points this close count as on the line
      integer :: k, found

      text = ''
      found = 0
      do k = 1, size(suspension%points)
         if (norm2(cross(axis, suspension%points(k)%at - through)) > near) cycle
         found = found + 1
         if (found > 4) exit
         if (found > 1) text = text//', '
         text = text//quoted(suspension%points(k)%name)
      end do
      if (found > 0) text = ' (the line of '//text//')'
   end function points_on

end module ek_motion_text
