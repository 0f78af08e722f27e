!> &part: the name of a record, and the records of paths `part.<body or rod>.<point>.<x, y or z>` that the deck does not give.
!>
!> Such a path is legal in every deck. A part without a record is as drawn, so the record that is added has a deviation of 0.
module ek_part_records
   use ek_kinds, only: wp
   use ek_text, only: quoted, did_you_mean, lower
   use ek_record, only: record_t, add_record, element, is_given
   use ek_group, only: group_names, part_group, part_name, word_length
   use ek_parameter, only: path_t, split_path, is_meant
   use ek_attachment, only: put_word, put_numbers
   implicit none(type, external)
   private
   public :: name_parts, add_part

contains

   !> Names each &part that has no name; gives part and point to each &part that has only a name.
   subroutine name_parts(records, used)
      type(record_t), intent(inout) :: records(:)
      integer, intent(in) :: used
      type(record_t) :: record
      character(:), allocatable :: part, message      ! message: the reader reports it
      integer :: k

      do k = 1, used
         if (records(k)%group /= group_names(part_group)) cycle
         part = element(records(k), 'body', 1)//element(records(k), 'joint', 1)
         if (.not. is_given(records(k), 'name')) then
            if (part /= '' .and. is_given(records(k), 'at')) &
               call put_word(records(k), 'name', part_name(part//'.'//element(records(k), 'at', 1)))
         else if (part == '' .and. .not. is_given(records(k), 'at')) then
            record = records(k)
            call put_ends(records, used, element(record, 'name', 1), .true., record, message)
            records(k) = record
         end if
      end do
   end subroutine name_parts

   !> Adds the &part of a path, unless the path leads to another group, contains *, or the record exists. `message` is '' if there
   !> is no error.
   subroutine add_part(records, used, path_text, where, message)
      type(record_t), allocatable, intent(inout) :: records(:)
      integer, intent(inout) :: used
      character(*), intent(in) :: path_text, where         !! where: the location in messages on the record
      character(:), allocatable, intent(out) :: message
      type(path_t) :: path
      type(record_t) :: record
      integer :: k

      call split_path(trim(adjustl(path_text)), path, message)
      if (message /= '' .or. path%group /= part_group .or. path%is_wild) then
         message = ''                                      ! an error in the path is reported where it is used
         return
      end if
      do k = 1, used
         if (is_meant(records(k), path)) return
      end do
      call put_ends(records, used, path%name, .false., record, message)
      if (message /= '') return
      record%group = trim(group_names(part_group))
      record%file = where
      call put_word(record, 'name', part_name(element(record, 'body', 1)//element(record, 'joint', 1)//'.'// &
         element(record, 'at', 1)))
      call put_numbers(record, 'deviation', [0.0_wp, 0.0_wp, 0.0_wp])
      call add_record(records, used, record)
   end subroutine add_part

   !> Gives a record the part and the point of a name '<body or rod>.<point>'. With a side in the name, they may have the side, or
   !> not: of a deck with &mirror.
   subroutine put_ends(records, used, name, keeps_side, record, message)
      type(record_t), intent(in) :: records(:)
      integer, intent(in) :: used
      character(*), intent(in) :: name
      logical, intent(in) :: keeps_side        !! with &mirror, the record is of the side in the name, not of both sides
      type(record_t), intent(inout) :: record
      character(:), allocatable, intent(out) :: message    !! '' if both exist
      character(:), allocatable :: side, part, point
      logical :: is_body, has_mirror
      integer :: dot, k

      message = ''
      dot = index(name, '.')
      if (dot < 2 .or. dot == len(name)) then
         message = 'expected part.<body or rod>.<point>.<x, y or z>'
         return
      end if
      has_mirror = any([(records(k)%group == 'mirror', k=1, used)])
      side = ''
      if (index(name, 'left_') == 1) side = 'left_'
      if (index(name, 'right_') == 1) side = 'right_'
      part = found_name(name(len(side) + 1:dot - 1), 'body')
      is_body = part /= ''
      if (.not. is_body) part = found_name(name(len(side) + 1:dot - 1), 'joint')
      point = found_name(name(dot + 1:), 'point')
      if (part == '') then
         message = 'there is no body and no rod (distance joint) '//quoted(name(:dot - 1))// &
            did_you_mean(name(len(side) + 1:dot - 1), names_of([character(5) :: 'body', 'joint']))
      else if (point == '') then
         message = 'there is no point '//quoted(name(dot + 1:))//did_you_mean(name(dot + 1:), names_of(['point']))
      else
         call put_word(record, trim(merge('body ', 'joint', is_body)), part)
         call put_word(record, 'at', point)
      end if

   contains

      !> The name of a record of a group: with the side of the path, or else without it; '' if there is none.
      function found_name(stem, group) result(found)
         character(*), intent(in) :: stem, group
         character(:), allocatable :: found
         integer :: j

         found = ''
         if (group == 'body' .and. is_fixed(stem)) found = stem
         do j = 1, used
            if (.not. is_candidate(records(j), [group])) cycle
            if (element(records(j), 'name', 1) == side//stem) found = side//stem
            if (element(records(j), 'name', 1) == stem .and. found == '') found = stem
         end do
         if (keeps_side .and. found == stem .and. has_mirror .and. .not. is_fixed(stem)) found = side//stem
      end function found_name

      pure logical function is_fixed(body)
         character(*), intent(in) :: body
         is_fixed = any(lower(body) == [character(7) :: 'chassis', 'ground'])
      end function is_fixed

      !> The names of bodies, rods or points, for suggestions.
      function names_of(groups) result(names)
         character(*), intent(in) :: groups(:)
         character(word_length), allocatable :: names(:)
         integer :: j

         allocate (names(0))
         do j = 1, used
            if (is_candidate(records(j), groups)) names = [names, [character(word_length) :: element(records(j), 'name', 1)]]
         end do
      end function names_of

      !> Whether a record is of one of the groups; of joints, only those of type 'distance'.
      pure logical function is_candidate(candidate, groups)
         type(record_t), intent(in) :: candidate
         character(*), intent(in) :: groups(:)

         is_candidate = any(groups == candidate%group)
         if (is_candidate .and. candidate%group == 'joint') is_candidate = lower(element(candidate, 'type', 1)) == 'distance'
      end function is_candidate

   end subroutine put_ends

end module ek_part_records
