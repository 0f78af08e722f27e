!> Factors that are deviations of single parts: change = 'part', and paths part.<body or rod>.<point>.<x, y or z>.
!>
!> change = 'part' with path = 'point.<point>.x' and bodies = 'a', 'b' is short for the paths part.a.<point>.x and part.b.<point>.x,
!> whose numbers the factor replaces: 0 is as drawn. The static toe and camber of a wheel in its carrier belong to one part, so that
!> a deviation of the part is a change of the number.
module ek_part_factor
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: quoted
   use ek_group, only: point_group, wheel_group, note_length
   use ek_deck, only: deck_t, declare_path
   use ek_parameter, only: path_t, split_path
   use ek_reader, only: find_parts_at
   use ek_study, only: study_factor_t, by_value, by_delta, by_part
   implicit none(type, external)
   private
   public :: expand_part

contains

   !> Replaces the paths of a factor with change = 'part' by those of the parts, and adds to the deck the parts, as drawn, to which
   !> paths of the factor lead.
   subroutine expand_part(factor, deck, error)
      class(study_factor_t), intent(inout) :: factor
      type(deck_t), intent(inout) :: deck
      type(error_t), allocatable, intent(inout) :: error   !! exit_deck; an error that exists is left unchanged
      character(note_length), allocatable :: paths(:)
      character(:), allocatable :: head, message, names
      type(path_t) :: path
      integer :: k, b

      if (allocated(error)) return
      head = factor%where//': factor '//quoted(factor%name)
      if (factor%change == by_part) then
         allocate (paths(0))
         factor%change = by_value
         do k = 1, size(factor%paths)
            call split_path(trim(adjustl(factor%paths(k))), path, message)
            if (message /= '') return                      ! reported where the paths are checked
            if (path%group == wheel_group .and. any(path%key == ['toe   ', 'camber']) .and. size(factor%paths) == 1 .and. &
               size(factor%bodies) == 0) then
               factor%change = by_delta
               return
            else if (path%group /= point_group .or. path%is_wild .or. path%first /= path%last .or. .not. path%has_subscript) then
               call fail(error, exit_deck, head//": change = 'part' needs paths of a point, such as "// &
                  "'point.lower_ball_joint.x', with bodies, or the path of one toe or camber of a &wheel alone; found "// &
                  quoted(trim(factor%paths(k))))
               return
            end if
            if (size(factor%bodies) == 0) then
               call find_parts_at(deck, path%name, names)
               if (names == '') return                     ! no such point: reported where the paths are checked
               call fail(error, exit_deck, head//": change = 'part' needs bodies, the parts that deviate; at "// &
                  quoted(path%name)//' are'//names)
               return
            end if
            do b = 1, size(factor%bodies)
               paths = [paths, [character(note_length) :: 'part.'//trim(factor%bodies(b))//'.'//path%name//'.'// &
                  'xyz'(path%first:path%first)]]
            end do
         end do
         call move_alloc(paths, factor%paths)
      end if
      do k = 1, size(factor%paths)
         call declare_path(deck, trim(factor%paths(k)), head, error)
         if (allocated(error)) then
            error%code = exit_deck
            return
         end if
      end do
   end subroutine expand_part

end module ek_part_factor
