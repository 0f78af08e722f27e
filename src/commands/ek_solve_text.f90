!> The findings of elastokin solve as printed: values that were reached, values that were missed, and the reasons.
module ek_solve_text
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_frame, only: frame_t, new_frame
   use ek_buffer, only: buffer_t
   use ek_workspace, only: workspace_t
   use ek_wanted_number, only: wanted_number_t
   use ek_condition_search, only: unknown_t, search_t
   use ek_condition_solver, only: findings_t
   use ek_compromise, only: compromise_t
   implicit none(type, external)
   private
   public :: add_findings, add_explanation, compromise_csv, label_of, has_no_effect

   real(wp), parameter :: share_of_conflict = 0.1_wp !! limit: a condition with a smaller component is no part of a conflict
   real(wp), parameter :: aligned = 0.9999_wp        !! smallest cosine between the effects on two conditions that change as one

contains

   !> Adds all findings of `solve` to the printed output.
   subroutine add_findings(workspace, unknowns, search, found, origins, text)
      type(workspace_t), intent(in) :: workspace
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      type(message_list_t), intent(in) :: origins     !! description of the band of each weight; '' without a band
      type(buffer_t), intent(inout) :: text
      integer :: j

      associate (wanted => search%values%wanted)
         do j = 1, size(wanted)
            call text%line(trim(merge('reached:    ', 'not reached:', found%is_reached(j)))//' '//label_of(workspace, wanted(j))// &
               ' = '//quantity(found%after(j), wanted(j)%unit)//trim(wanted_text(j))//' (before '// &
               quantity(found%before(j), '')//'; weight: '//trim(quantity(search%weights(j), wanted(j)%unit))// &
               origins%line(j)//')')
         end do
      end associate
      if (.not. all(found%is_reached)) call text%line('  sum of squares of the deviations, each divided by its weight: '// &
         str(found%sum_before, 6)//' -> '//str(found%sum_after, 6))
      if (found%begins_at_bound) call text%line('  a parameter of the deck is outside its bounds; the search began at the bound')
      do j = 1, size(unknowns)
         associate (number => unknowns(j)%direction)
            call text%line('  '//number%path//' = '//quantity(found%x(j), number%unit)//' (before '//str(number%value, 9)// &
               ', bounds '//str(unknowns(j)%lower, 9)//' to '//str(unknowns(j)%upper, 9)//')')
         end associate
      end do
      call text%line('  '//plural(found%sweeps, 'sweep', 'sweeps'))
      call add_explanation(unknowns, search, found, text)

   contains

      function wanted_text(j) result(words)
         integer, intent(in) :: j
         character(:), allocatable :: words
         words = ''
         if (.not. found%is_reached(j) .or. (found%is_fixed(j) .and. str(search%targets(j), 9) /= str(found%after(j), 9))) &
            words = ', wanted '//str(search%targets(j), 9)
      end function wanted_text

   end subroutine add_findings

   !> Adds whether other solutions exist, or the reasons why conditions are not met.
   subroutine add_explanation(unknowns, search, found, text)
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(findings_t), intent(in) :: found
      type(buffer_t), intent(inout) :: text
      integer :: j

      if (all(found%is_reached)) then
         call add_freedom(unknowns, found, text)
      else
         call add_reasons(unknowns, search%values%wanted, found, text)
      end if
      do j = 1, size(found%is_fixed)
         if (found%is_fixed(j) .and. found%is_reached(j)) call text%line('  '//search%values%wanted(j)%name// &
            ' was met before, and no number that varies changes it')
      end do
   end subroutine add_explanation

   !> Label of a condition: 'left_toe_deg of parallel_travel at 20 mm'. The label of a key number is its name.
   function label_of(workspace, wanted) result(label)
      type(workspace_t), intent(in) :: workspace
      type(wanted_number_t), intent(in) :: wanted
      character(:), allocatable :: label

      label = wanted%name
      if (allocated(wanted%key)) return
      associate (case => workspace%cases(wanted%case)%result%case)
         label = label//' of '//case%name//' at '//str(wanted%at, 9)//' '//case%unit_name
      end associate
   end function label_of

   !> A value with its unit: '-60.5 mm'.
   function quantity(value, unit) result(text)
      real(wp), intent(in) :: value
      character(*), intent(in) :: unit
      character(:), allocatable :: text

      text = str(value, 9)
      if (unit /= '') text = text//' '//unit
   end function quantity

   !> Adds the unknowns without effect, and whether other solutions exist, for numbers that meet all conditions.
   subroutine add_freedom(unknowns, found, text)
      type(unknown_t), intent(in) :: unknowns(:)
      type(findings_t), intent(in) :: found
      type(buffer_t), intent(inout) :: text
      integer :: j

      do j = 1, size(unknowns)
         if (has_no_effect(found, j)) call text%line('  '//unknowns(j)%direction%path//' has no effect on the conditions')
      end do
      if (found%rank > 0 .and. found%rank < size(unknowns)) call text%line('  other solutions exist: '// &
         plural(size(unknowns), 'number varies', 'numbers vary')//' for '// &
         plural(found%rank, 'independent condition', 'independent conditions')// &
         '; this is the smallest change found from this start')
   end subroutine add_freedom

   !> Adds the reasons why conditions are not met.
   subroutine add_reasons(unknowns, wanted, found, text)
      type(unknown_t), intent(in) :: unknowns(:)
      type(wanted_number_t), intent(in) :: wanted(:)
      type(findings_t), intent(in) :: found
      type(buffer_t), intent(inout) :: text
      character(:), allocatable :: names
      integer :: i, j, k, lines

      lines = text%length()
      do j = 1, size(unknowns)
         if (found%held(j) == 0) cycle
         call text%line('  '//unknowns(j)%direction%path//' is at its '//trim(merge('lower', 'upper', found%held(j) < 0))// &
            ' bound; going beyond it would bring the conditions closer')
      end do
      do j = 1, size(unknowns)
         if (has_no_effect(found, j)) call text%line('  '//unknowns(j)%direction%path//' has no effect on the conditions')
      end do
      do i = 1, size(wanted)
         if (found%is_fixed(i) .and. .not. found%is_reached(i)) &
            call text%line('  nothing that varies has an effect on '//wanted(i)%name)
      end do
      do i = 1, size(wanted)
         do k = i + 1, size(wanted)
            if (abs(cosine(found, i, k)) >= aligned) call text%line('  '//wanted(i)%name//' and '//wanted(k)%name// &
               ' change in a fixed proportion, '//str(ratio(found, i, k), 4)//', whichever number varies: both cannot be met')
         end do
      end do
      do k = 1, size(found%conflict, 2)
         if (found%rank == 0 .or. size(wanted) < 3 .or. size(wanted) > size(unknowns)) exit
         names = ''
         do i = 1, size(wanted)
            if (abs(found%conflict(i, k)) > share_of_conflict) names = names//' '//wanted(i)%name
         end do
         call text%line('  the numbers that vary cannot change these independently:'//names)
      end do
      if (size(wanted) > size(unknowns)) call text%line('  '//plural(size(wanted), 'condition', 'conditions')//' for '// &
         plural(size(unknowns), 'number', 'numbers')//' that may vary: let more numbers vary')
      if (text%length() == lines) call text%line('  the conditions come no closer near these numbers: '// &
         'a maximum or minimum of the quantity lies between the bounds. Try another start with --set')
   end subroutine add_reasons

   !> Whether unknown j has no effect on any condition.
   pure logical function has_no_effect(found, j)
      type(findings_t), intent(in) :: found
      integer, intent(in) :: j
      integer :: i

      has_no_effect = .true.
      do i = 1, size(found%effect, 1)
         if (abs(found%effect(i, j)) > 0.0_wp) has_no_effect = .false.
      end do
   end function has_no_effect

   !> The compromise of two conditions as CSV, one row per design.
   function compromise_csv(workspace, unknowns, search, compromise) result(text)
      type(workspace_t), intent(in) :: workspace
      type(unknown_t), intent(in) :: unknowns(:)
      type(search_t), intent(in) :: search
      type(compromise_t), intent(in) :: compromise
      character(:), allocatable :: text
      type(frame_t) :: frame
      character(:), allocatable :: names
      integer :: i, j, k

      names = 'design'
      do j = 1, size(unknowns)
         names = names//','//unknowns(j)%direction%path
      end do
      frame = new_frame(names//',value_1,value_2,deviation_1,deviation_2,sum_of_squares')
      call frame%header%add('compromise of two conditions: in each row, neither condition can be satisfied better without the '// &
         'other one')
      do i = 1, 2
         associate (wanted => search%values%wanted(i))
            call frame%header%add('condition '//str(i)//': '//label_of(workspace, wanted)//' = '// &
               quantity(search%targets(i), wanted%unit)//', weight '//quantity(search%weights(i), wanted%unit)//'; deviation_'// &
               str(i)//': deviation divided by the weight')
         end associate
      end do
      do k = 1, size(compromise%x, 2)
         call frame%put(k)
         call frame%put([compromise%x(:, k), compromise%values(:2, k), compromise%deviations(:2, k), &
            sum(compromise%deviations(:, k)**2)])
      end do
      text = frame%csv()
   end function compromise_csv

   !> The cosine between the effects of the unknowns on two conditions; 0 if there are no effects.
   pure real(wp) function cosine(found, i, k)
      type(findings_t), intent(in) :: found
      integer, intent(in) :: i, k
      real(wp) :: sizes

      cosine = 0.0_wp
      sizes = norm2(found%effect(i, :))*norm2(found%effect(k, :))
      if (sizes > 0.0_wp) cosine = dot_product(found%effect(i, :), found%effect(k, :))/sizes
   end function cosine

   !> The change of condition i per change of condition k.
   pure real(wp) function ratio(found, i, k)
      type(findings_t), intent(in) :: found
      integer, intent(in) :: i, k

      ratio = dot_product(found%effect(i, :), found%effect(k, :))/sum(found%effect(k, :)**2)
   end function ratio

end module ek_solve_text
