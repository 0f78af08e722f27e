!> Records of a deck that is made from points: points with their notes, bodies and joints.
module ek_deck_parts
   use ek_kinds, only: wp
   use ek_deck_text, only: deck_text_t
   use ek_point_name, only: point_count, point_names
   implicit none(type, external)
   private
   public :: writing_t, put_point, put_body, put_joint, put_joint_at, put_hinge, put_line_joint, put_axis_joint, put_ends

   !> The deck being written.
   type :: writing_t
      type(deck_text_t) :: deck
      logical :: is_rear = .false.                  !! axes of the deck: x-rear; otherwise iso
      real(wp) :: factor = 1.0_wp                   !! unit of the table per unit of the deck
      real(wp) :: metre = 1.0e3_wp                  !! units of length of the deck in a metre
      character(2) :: length = 'mm'                 !! unit of the deck
      logical :: is_written(point_count) = .false.
      character(:), allocatable :: file
   end type writing_t

contains

   subroutine put_point(name, at, note, writing)
      character(*), intent(in) :: name, note
      real(wp), intent(in) :: at(3)
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('point')
      call writing%deck%word('name', name)
      call writing%deck%numbers('at', at)
      call writing%deck%word('note', note)
      call writing%deck%end()
   end subroutine put_point

   subroutine put_body(name, writing, origin)
      character(*), intent(in) :: name
      type(writing_t), intent(inout) :: writing
      character(*), intent(in), optional :: origin

      call writing%deck%begin('body')
      call writing%deck%word('name', name)
      if (present(origin)) call writing%deck%word('origin', origin)
      call writing%deck%end()
   end subroutine put_body

   !> Writes a joint between two bodies at one or two points.
   subroutine put_joint(name, type, first, second, at, writing)
      character(*), intent(in) :: name, type, first, second
      integer, intent(in) :: at(:)
      type(writing_t), intent(inout) :: writing

      if (size(at) == 1) then
         call put_joint_at(name, type, first, second, trim(point_names(at(1))), writing)
      else
         call begin_joint(name, type, first, second, writing)
         call writing%deck%words('at', trim(point_names(at(1))), trim(point_names(at(2))))
         call writing%deck%end()
      end if
   end subroutine put_joint

   !> Writes a rod between two points that are given by their names.
   subroutine put_ends(name, first, second, one, other, writing)
      character(*), intent(in) :: name, first, second, one, other
      type(writing_t), intent(inout) :: writing

      call begin_joint(name, 'distance', first, second, writing)
      call writing%deck%words('at', one, other)
      call writing%deck%end()
   end subroutine put_ends

   !> Writes a joint at a point that is given by its name.
   subroutine put_joint_at(name, type, first, second, at, writing)
      character(*), intent(in) :: name, type, first, second, at
      type(writing_t), intent(inout) :: writing

      call begin_joint(name, type, first, second, writing)
      call writing%deck%word('at', at)
      call writing%deck%end()
   end subroutine put_joint_at

   !> Writes the hinge of an arm on the chassis.
   subroutine put_hinge(name, body, one, other, writing)
      character(*), intent(in) :: name, body
      integer, intent(in) :: one, other
      type(writing_t), intent(inout) :: writing
      call put_line_joint(name, 'revolute', 'chassis', body, one, other, writing)
   end subroutine put_hinge

   !> Writes a joint at a point, whose axis goes from there to another point.
   subroutine put_line_joint(name, type, first, second, one, other, writing)
      character(*), intent(in) :: name, type, first, second
      integer, intent(in) :: one, other
      type(writing_t), intent(inout) :: writing

      call begin_joint(name, type, first, second, writing)
      call writing%deck%word('at', trim(point_names(one)))
      call writing%deck%words('axis', trim(point_names(one)), trim(point_names(other)))
      call writing%deck%end()
   end subroutine put_line_joint

   !> Writes a joint at a point with an axis, and perhaps a second axis fixed in the second body.
   subroutine put_axis_joint(name, type, first, second, at, axis, writing, axis_2)
      character(*), intent(in) :: name, type, first, second, at
      real(wp), intent(in) :: axis(3)
      type(writing_t), intent(inout) :: writing
      real(wp), intent(in), optional :: axis_2(3)

      call begin_joint(name, type, first, second, writing)
      call writing%deck%word('at', at)
      call writing%deck%numbers('axis_vector', axis)
      if (present(axis_2)) call writing%deck%numbers('axis_2_vector', axis_2)
      call writing%deck%end()
   end subroutine put_axis_joint

   subroutine begin_joint(name, type, first, second, writing)
      character(*), intent(in) :: name, type, first, second
      type(writing_t), intent(inout) :: writing

      call writing%deck%begin('joint')
      call writing%deck%word('name', name)
      call writing%deck%word('type', type)
      call writing%deck%words('bodies', first, second)
   end subroutine begin_joint

end module ek_deck_parts
