!> The line of the verdict about the rated tilts of joints and bushings: the largest tilt relative to its rating, over all tests.
module ek_tilt_verdict
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, degree
   use ek_text, only: str
   use ek_tilt, only: tilt_t
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, converged_rows
   use ek_page, only: page_number
   use ek_usual_range, only: word_length, inside, outside
   implicit none(type, external)
   private
   public :: judge_tilts

contains

   !> Finds the largest tilt relative to its rating, and creates the message: 'left_ball_joint 11.20 of 12 deg: in test steering at
   !> factor −75'. The message is '' if no test has a rated tilt.
   subroutine judge_tilts(tilts, tests, words, verdict)
      type(tilt_t), intent(in) :: tilts(:)
      type(test_result_t), intent(in) :: tests(:)
      character(:), allocatable, intent(out) :: words
      character(word_length), intent(out) :: verdict   !! 'inside', 'outside' of the rating, or ''
      real(wp) :: largest(size(tilts)), share
      integer :: k, t, row, at(2, size(tilts)), over

      words = ''
      verdict = ''
      largest = -1.0_wp
      at = 0
      do t = 1, size(tests)
         if (.not. tests(t)%is_run) cycle
         do k = 1, size(tilts)
            call find_largest(tests(t), tilts(k)%name//'_deg', share, row)
            share = share*degree/tilts(k)%rating
            if (row == 0 .or. share <= largest(k)) cycle
            largest(k) = share
            at(:, k) = [t, row]
         end do
      end do
      if (.not. any(largest >= 0.0_wp)) return
      k = maxloc(largest, dim=1)
      words = part_name(tilts(k))//' '//page_number(largest(k)*tilts(k)%rating/degree)//' of '// &
         str(tilts(k)%rating/degree, 6)//' deg: in test '//tests(at(1, k))%name//' at '//state_words(tests(at(1, k)), at(2, k))
      over = count(largest > 1.0_wp)
      if (over > 0) words = words//'; '//str(over)//' of '//str(size(tilts))//' over the rating'
      verdict = merge(outside, inside, over > 0)
   end subroutine judge_tilts

   !> Finds the largest value of a column in the converged states of a test.
   pure subroutine find_largest(test, name, value, row)
      type(test_result_t), intent(in) :: test
      character(*), intent(in) :: name
      real(wp), intent(out) :: value
      integer, intent(out) :: row      !! 0: the test has no value
      logical :: is_value(size(test%table%values, 2))
      integer :: column

      value = 0.0_wp
      row = 0
      column = column_index(test%table, name)
      if (column == 0) return
      is_value = converged_rows(test%table) .and. ieee_is_finite(test%table%values(column, :))
      if (.not. any(is_value)) return
      row = maxloc(test%table%values(column, :), dim=1, mask=is_value)
      value = test%table%values(column, row)
   end subroutine find_largest

   !> The name of the joint or bushing of a tilt, with the end of a rod.
   pure function part_name(tilt) result(words)
      type(tilt_t), intent(in) :: tilt
      character(:), allocatable :: words

      words = tilt%name(:len(tilt%name) - len('_tilt'))
      if (tilt%end > 0) words = words(:len(words) - 2)//' end '//str(tilt%end)
   end function part_name

   !> The state in a row of a test: its name, its travel and steering in a grid, or the value of `factor`.
   function state_words(test, row) result(words)
      type(test_result_t), intent(in) :: test
      integer, intent(in) :: row
      character(:), allocatable :: words
      integer :: place(2)

      if (allocated(test%table%names)) then
         words = test%table%names(row)%text
         return
      end if
      if (allocated(test%grid)) then
         place = findloc(test%grid%row, row)
         if (all(place > 0)) then
            words = 'travel '//page_number(test%grid%travel(place(1)))//' mm, '//test%grid%driver//' '// &
               page_number(test%grid%steer(place(2)))//' '//trim(test%grid%unit)
            return
         end if
      end if
      words = 'state '//str(row)
      if (column_index(test%table, 'factor') > 0) &
         words = 'factor '//page_number(test%table%values(column_index(test%table, 'factor'), row))
   end function state_words

end module ek_tilt_verdict
