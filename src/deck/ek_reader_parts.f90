!> &part: deviations of single parts from the drawing.
module ek_reader_parts
   use ek_text, only: quoted
   use ek_record, only: element, own_name, single
   use ek_group, only: joint_group, body_group, part_name
   use ek_suspension, only: of_term
   use ek_blueprint, only: part_plan_t
   use ek_deck_reading, only: deck_reading_t, complain, text_of, has_key, slot
   use ek_reference, only: look_up, find_body, find_point
   implicit none(type, external)
   private
   public :: read_part, parts_at

contains

   !> Reads &part. All parts of the suspension were read before.
   subroutine read_part(reading)
      type(deck_reading_t), intent(inout) :: reading
      type(part_plan_t) :: plan
      character(:), allocatable :: name
      logical :: is_found
      integer :: k

      is_found = .true.
      if ((has_key(reading, 'body') .eqv. has_key(reading, 'joint')) .or. .not. has_key(reading, 'at')) then
         if (reading%cards(reading%k)%is_good) call complain(reading, '', "give 'body' or 'joint', the part that deviates, and "// &
            "'at', or the name '<body or rod>.<point>' of a part and a point of the deck")
         return
      end if
      name = text_of(reading, 'body')//text_of(reading, 'joint')
      if (text_of(reading, 'body') /= '') call find_body(reading, 'body', name, plan%body, is_found)
      if (has_key(reading, 'joint')) call find_rod(reading, name, plan%row, is_found)
      call find_point(reading, 'at', text_of(reading, 'at'), plan%point, is_found)
      if (.not. reading%cards(reading%k)%is_good .or. plan%point == 0) return
      if (reading%cards(reading%k)%name /= part_name(name//'.'//text_of(reading, 'at'))) then
         call complain(reading, 'name', 'the name of this part is '//quoted(part_name(name//'.'//text_of(reading, 'at')))// &
            '; omit name')
         return
      end if
      if (.not. is_there(reading, plan%body, plan%row, plan%point)) then
         call complain(reading, 'at', 'at: no joint, spring, bushing, mass, load or wheel of '//quoted(name)//' is at '// &
            quoted(text_of(reading, 'at'))//'; the parts at this point are'//parts_at(reading, plan%point))
         return
      end if
      call slot(reading, 'deviation', plan%by)
      do k = plan%by, plan%by + 2
         reading%parameters%list(k)%is_given = .true.      ! 0 as drawn: listed, and found by paths with *
      end do
      reading%plan%parts = [reading%plan%parts, plan]
   end subroutine read_part

   !> Finds the row of the distance joint that is a rod.
   subroutine find_rod(reading, name, row, is_found)
      type(deck_reading_t), intent(inout) :: reading
      character(*), intent(in) :: name
      integer, intent(inout) :: row
      logical, intent(out) :: is_found
      integer :: found, k

      call look_up(reading, 'joint', joint_group, name, found)
      is_found = found > 0
      if (.not. is_found) return
      if (.not. reading%cards(found)%is_good) reading%cards(reading%k)%is_good = .false.
      if (.not. reading%cards(reading%k)%is_good) return
      associate (joints => reading%plan%prototype%joints)
         do k = 1, size(joints)
            if (joints(k)%name == name) exit
         end do
         if (joints(k)%kind == 'distance') then
            row = joints(k)%first_row
         else
            call complain(reading, 'joint', 'joint: '//quoted(name)//' is a '//joints(k)%kind// &
               " joint; a rod is a joint of type 'distance'; at other joints, give the body that deviates")
         end if
      end associate
   end subroutine find_rod

   !> The names of the parts at a point, each after a blank and in quotes, without the side if &mirror created them; otherwise
   !> ' none'.
   function parts_at(reading, point) result(names)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: point                   !! index of the vector
      character(:), allocatable :: names
      integer :: k

      names = ''
      do k = 1, size(reading%cards)
         if (reading%cards(k)%group /= body_group .or. reading%cards(k)%index == 0) cycle
         if (is_there(reading, reading%cards(k)%index, 0, point)) call add(k)
      end do
      do k = 1, size(reading%cards)
         if (reading%cards(k)%group /= joint_group .or. element(reading%records(k), 'type', 1) /= 'distance') cycle
         if (is_there(reading, -1, row_of(k), point)) call add(k)
      end do
      if (is_there(reading, 0, 0, point)) names = names//', '//quoted('chassis')
      if (names == '') names = ', none'
      names = names(2:)

   contains

      subroutine add(k)
         integer, intent(in) :: k
         character(:), allocatable :: name

         name = trim(reading%cards(k)%name)
         if (reading%records(k)%side /= single) name = own_name(reading%records(k))
         names = names//', '//quoted(name)
      end subroutine add

      !> The row of the joint of a record; 0 if the joint was rejected.
      pure integer function row_of(k)
         integer, intent(in) :: k
         integer :: j

         row_of = 0
         do j = 1, size(reading%plan%prototype%joints)
            if (reading%plan%prototype%joints(j)%name == reading%cards(k)%name) &
               row_of = reading%plan%prototype%joints(j)%first_row
         end do
      end function row_of

   end function parts_at

   !> Whether something of a body, or an end of a rod, is at a point, or has a direction from or to this point.
   logical function is_there(reading, body, row, point)
      type(deck_reading_t), intent(in) :: reading
      integer, intent(in) :: body                    !! 0: the chassis
      integer, intent(in) :: row                     !! row of the rod; 0: of the body
      integer, intent(in) :: point                   !! index of the vector
      integer :: k

      is_there = .false.
      associate (model => reading%plan%prototype)
         do k = 1, size(model%markers)
            associate (this => model%markers(k))
               if (row > 0) then
                  if (this%part == of_term .and. this%index == model%rows(row)%first) is_there = is_there .or. this%point == point
               else if (this%body == body) then
                  is_there = is_there .or. depends(this%point) .or. depends(this%direction)
               end if
            end associate
         end do
      end associate

   contains

      !> Whether a vector is the point, or follows from it.
      pure recursive logical function depends(vector) result(follows)
         integer, intent(in) :: vector

         follows = vector == point
         if (follows .or. vector == 0) return
         associate (this => reading%plan%vectors(vector))
            if (this%a > 0) follows = depends(this%a)
            if (this%b > 0 .and. .not. follows) follows = depends(this%b)
         end associate
      end function depends

   end function is_there

end module ek_reader_parts
