!> Key numbers of springs: the motion ratio of each spring on two points and of each spring on a length measure, at design.
module ek_ratio_numbers
   use ek_text, only: spaced
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t
   use ek_key_number, only: key_number_t, key_source_t, at_design
   use ek_place_numbers, only: number_list_t, new_number, add_source, append
   implicit none(type, external)
   private
   public :: ratio_numbers

   character(*), parameter :: ratio_ending = '_motion_ratio', gap_ending = '_gap_mm'

contains

   !> Appends the motion ratio of each element with a column of motion ratio: the change of the length of the element per wheel
   !> travel. Stops are omitted, because they are without contact near design.
   subroutine ratio_numbers(tests, numbers, wanted)
      type(test_result_t), intent(in) :: tests(:)
      type(number_list_t), intent(inout) :: numbers
      character(*), intent(in), optional :: wanted(:)    !! names without left_ and right_; absent: all
      character(:), allocatable :: element, on_right
      type(key_number_t) :: number
      integer :: t, c, ends
      logical :: is_pair

      do t = 1, size(tests)
         if (tests(t)%kind == 'parallel_travel') exit
      end do
      if (t > size(tests)) return
      associate (test => tests(t), columns => tests(t)%table%columns)
         is_pair = size(test%prefixes) > 1
         do c = 1, size(columns)
            ends = len_trim(columns(c)) - len(ratio_ending)
            if (ends < 1) cycle
            if (columns(c) (ends + 1:) /= ratio_ending) cycle
            element = columns(c) (:ends)
            if (column_index(test%table, element//gap_ending) > 0) cycle
            on_right = ''
            if (is_pair .and. index(element, 'right_') == 1) then
               if (column_index(test%table, 'left_'//element(7:)//ratio_ending) > 0) cycle      ! with the left one
            else if (is_pair .and. index(element, 'left_') == 1) then
               on_right = 'right_'//element(6:)//ratio_ending
               if (column_index(test%table, on_right) == 0) on_right = ''
            end if
            call make(element, on_right)
            if (present(wanted)) then
               if (.not. any(wanted == number%name)) cycle
            end if
            call append(number, numbers)
         end do
      end associate

   contains

      subroutine make(element, on_right)
         character(*), intent(in) :: element, on_right        !! column of the element on the right; '': none
         character(:), allocatable :: stem
         type(key_source_t) :: source

         stem = element
         if (on_right /= '') stem = element(6:)
         call new_number('Motion ratios', 'motion ratio, '//spaced(stem), '–', '− shortens in bump', at_design, number)
         number%name = stem//ratio_ending
         number%condition = 'test '//tests(t)%name//', at design, wheels in parallel travel'
         number%definition = stem//ratio_ending//', d(length of '//stem//')/d(wheel travel); − shortens in bump'
         number%is_of_axle = is_pair .and. on_right == ''
         source = key_source_t(test=t)
         source%column(1) = element//ratio_ending
         source%column(2) = on_right
         call add_source(source, number)
      end subroutine make

   end subroutine ratio_numbers

end module ek_ratio_numbers
