!> The bushings of an axle of IPGKinematics as groups of a deck.
module ek_kin_mounts
   use ek_kinds, only: wp
   use ek_law_points, only: law_points_t
   use ek_deck_text, only: deck_text_t
   use ek_law_text, only: put_curves, put_bushing_law
   use ek_kin, only: kin_t
   implicit none(type, external)
   private
   public :: mount_law_t, put_mounts, turns_freely, frame_of

   !> The law of a bushing of the file.
   type :: mount_law_t
      type(law_points_t) :: laws(6)
      character(:), allocatable :: note       !! source of the law
   end type mount_law_t

contains

   !> Writes the bushings of the axle into the deck. x of the markers is along the axis of each bushing.
   subroutine put_mounts(deck, kin, mounts)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      character(:), allocatable :: upper

      upper = frame_of(kin%has_subframe .and. kin%has_upper_on_subframe)
      call deck%heading('bushings: kt in N/mm, kr in N mm/deg, x along the axis of the bushing')
      call put_mount(deck, kin, mounts, 'lower_front', 3, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_front')
      call put_mount(deck, kin, mounts, 'lower_rear', 4, frame_of(kin%has_subframe), 'lower_arm', 'lower_arm_rear')
      call put_mount(deck, kin, mounts, 'upper_front', 5, upper, 'upper_arm', 'upper_arm_front')
      call put_mount(deck, kin, mounts, 'upper_rear', 6, upper, 'upper_arm', 'upper_arm_rear')
      call put_mount(deck, kin, mounts, 'tie_rod_bush', 7, 'rack', 'tie_rod', 'tie_rod_inner')
      if (kin%has_subframe) then
         call put_mount(deck, kin, mounts, 'subframe_front', 1, 'chassis', 'subframe', 'subframe_front')
         call put_mount(deck, kin, mounts, 'subframe_rear', 2, 'chassis', 'subframe', 'subframe_rear')
      end if
   end subroutine put_mounts

   !> Writes a bushing of the file at a point of the axle. The position that the file gives in its list of bushings sets only the
   !> axis.
   subroutine put_mount(deck, kin, mounts, name, k, first, second, at)
      type(deck_text_t), intent(inout) :: deck
      type(kin_t), intent(in) :: kin
      type(mount_law_t), intent(in) :: mounts(:)
      character(*), intent(in) :: name, first, second, at
      integer, intent(in) :: k
      real(wp) :: axis(3)

      call put_curves(deck, name, mounts(k)%laws, 'linear')
      call deck%begin('bushing')
      call deck%word('name', name)
      call deck%words('bodies', first, second)
      call deck%word('at', at)
      axis = kin%mounts(k)%axis - kin%mounts(k)%centre
      if (norm2(axis) > 0.0_wp) call deck%numbers('x_vector', axis/norm2(axis))
      call put_bushing_law(deck, name, mounts(k)%laws)
      call deck%word('note', mounts(k)%note)
      call deck%end()
   end subroutine put_mount

   !> Whether a bushing has no rotational stiffness.
   pure logical function turns_freely(law)
      type(mount_law_t), intent(in) :: law
      integer :: j

      turns_freely = .true.
      do j = 4, 6
         turns_freely = turns_freely .and. .not. any(abs(law%laws(j)%y(:law%laws(j)%used)) > 0.0_wp)
      end do
   end function turns_freely

   !> Name of the body that carries an arm or the rack: 'subframe' or 'chassis'.
   pure function frame_of(is_subframe) result(name)
      logical, intent(in) :: is_subframe
      character(:), allocatable :: name

      name = 'chassis'
      if (is_subframe) name = 'subframe'
   end function frame_of

end module ek_kin_mounts
