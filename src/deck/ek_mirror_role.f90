!> The behaviour of the keys of a deck under y → −y: references that may be duplicated, vectors, sides.
!>
!> A key that is not listed is the same on both sides (a rate, a radius, static toe). To add a key that
!> holds a name or a direction, and is not one of those of every element: add its row here as well as in ek_group.
module ek_mirror_role
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_record, only: record_t, element
   use ek_group, only: group_number, has_results
   implicit none(type, external)
   private
   public :: role_of, is_element, can_be_doubled, is_name, named_group, turns
   public :: loads, polar, axial, curves, side, sign_of_image

   ! names of other records; a vector; and the rest
   integer, parameter :: points = 1, bodies = 2, measures = 3, joints = 4, loads = 5, wheels = 6
   integer, parameter :: polar = 11     !! (x, y, z) → (x, −y, z)
   integer, parameter :: axial = 12     !! (x, y, z) → (−x, y, −z)
   integer, parameter :: curves = 13    !! 'fy=name' → 'fy=-name' for the components that change sign
   integer, parameter :: side = 14      !! 'left' → 'right'
   character(*), parameter :: named_groups(6) = [character(7) :: 'point', 'body', 'measure', 'joint', 'load', 'wheel']

   type :: role_t
      character(8) :: group
      character(14) :: key
      integer :: role
   end type role_t

   ! the same in every group of elements (is_element), '*'; then those of single groups
   type(role_t), parameter :: roles(*) = [ &
      role_t('*', 'body', bodies), &
      role_t('*', 'bodies', bodies), &
      role_t('*', 'at', points), &
      role_t('*', 'axis', points), &
      role_t('*', 'axis_vector', polar), &
      role_t('*', 'axis_2', points), &
      role_t('*', 'axis_2_vector', polar), &
      role_t('*', 'measure', measures), &
      role_t('*', 'measures', measures), &
      role_t('point', 'at', polar), &
      role_t('body', 'origin', points), &
      role_t('body', 'centre', points), &
      role_t('bushing', 'z_axis', points), &
      role_t('bushing', 'z_vector', polar), &
      role_t('bushing', 'x_axis', points), &
      role_t('bushing', 'x_vector', polar), &
      role_t('bushing', 'preload_force', polar), &       ! along x', y', z', see ek_mirror
      role_t('bushing', 'preload_moment', axial), &
      role_t('bushing', 'curve', curves), &
      role_t('wheel', 'centre', points), &
      role_t('wheel', 'contact', points), &
      role_t('wheel', 'steer_axis', points), &
      role_t('wheel', 'spin_vector', polar), &
      role_t('wheel', 'side', side), &
      role_t('load', 'force', polar), &
      role_t('load', 'moment', axial), &
      role_t('case', 'load', loads), &
      role_t('case', 'drive', joints), &
      role_t('case', 'wheel', wheels), &
      role_t('steering', 'driver', joints)]

contains

   !> The role of a key; 0: the same on both sides.
   pure integer function role_of(record, key) result(role)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer :: k

      role = 0
      do k = 1, size(roles)
         if (roles(k)%group /= record%group .and. .not. (roles(k)%group == '*' .and. is_element(record%group))) cycle
         if (roles(k)%key == key) role = roles(k)%role
      end do
      if (role == polar .and. key == 'axis_vector' .and. turns(record)) role = axial
   end function role_of

   !> The sign of element `at` of a key in the mirror image of its record.
   pure real(wp) function sign_of_image(record, key, at) result(sign)
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at

      sign = 1.0_wp
      select case (role_of(record, key))
      case (polar)
         if (at == 2) sign = -1.0_wp
      case (axial)
         if (at /= 2) sign = -1.0_wp
      end select
   end function sign_of_image

   !> Whether the axis of the record is a rotation axis: the sense of rotation determines the sign of the value.
   pure logical function turns(record)
      type(record_t), intent(in) :: record
      turns = record%group == 'torsion'
      if (record%group == 'measure') turns = lower(element(record, 'type', 1)) == 'rotation'
   end function turns

   !> Whether records of a group are duplicated together with the records to which they refer.
   pure logical function is_element(group)
      character(*), intent(in) :: group
      is_element = has_results(group_number(group)) .or. any([character(5) :: 'wheel', 'load', 'mass'] == group)
   end function is_element

   !> Whether &mirror may duplicate records of this group.
   pure logical function can_be_doubled(group)
      character(*), intent(in) :: group
      can_be_doubled = is_element(group) .or. group == 'point' .or. group == 'body'
   end function can_be_doubled

   !> Whether a role is the name of another record.
   pure logical function is_name(role)
      integer, intent(in) :: role
      is_name = role >= 1 .and. role <= size(named_groups)
   end function is_name

   !> The group of the records to which a role refers.
   pure function named_group(role) result(group)
      integer, intent(in) :: role
      character(:), allocatable :: group
      group = trim(named_groups(role))
   end function named_group

end module ek_mirror_role
