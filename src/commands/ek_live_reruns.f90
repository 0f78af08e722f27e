!> What the sliders of a page leave out with `balance` = 'all': with other rates of bushings the preloads are distributed among them in
!> another way, which changes their geometric stiffness. The design state is solved with rates at the ends of the sliders, and the
!> numbers of the page are compared with these runs.
module ek_live_reruns
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_case, only: case_t
   use ek_case_result, only: case_result_t, solve_options_t, solve_case
   use ek_key_number, only: key_number_t
   use ek_live, only: live_t, slider_end
   use ek_live_data, only: find_columns
   use ek_live_rates, only: rate_path
   use ek_live_state, only: changed_value
   use ek_noise, only: is_noise, solved
   use ek_parameter, only: choice_t, find_parameters
   use ek_table, only: column_index
   use ek_test_result, only: test_result_t, design_row
   use ek_workspace, only: workspace_t, put_numbers, settle_numbers, succeeded
   implicit none(type, external)
   private
   public :: measure_reruns

contains

   !> Solves the design state with each rate alone, with all rates, and with every other rate at either end of its slider, then
   !> changes the rates of the largest deviation one by one, and stores the largest deviation of a number of the page. Does nothing
   !> without sliders, and for another preload trim: the page is then exact.
   subroutine measure_reruns(workspace, cases, tests, numbers, live)
      class(workspace_t), intent(in) :: workspace
      type(case_t), intent(in) :: cases(:)                 !! of the tests
      type(test_result_t), intent(in) :: tests(:)
      type(key_number_t), intent(in) :: numbers(:)         !! key numbers of the report
      type(live_t), intent(inout) :: live
      class(workspace_t), allocatable :: other
      real(wp), allocatable :: factor(:)
      integer :: k, n, sort, the_end, of_design, sweep

      if (.not. allocated(live%rates)) return
      if (live%balance /= 'all' .or. .not. live%design%state(1)%is_known) return
      do of_design = 1, size(tests)
         if (tests(of_design)%name == live%design%name) exit
      end do
      if (of_design > size(tests)) return
      allocate (other, source=workspace)
      n = size(live%rates%rate)
      allocate (factor(n))
      do the_end = -1, 1, 2
         do sort = 1, n + 2
            factor(:) = 1.0_wp
            if (sort <= n) factor(sort) = slider_end**the_end
            if (sort == n + 1) factor(:) = slider_end**the_end
            if (sort == n + 2) factor(:) = [(slider_end**merge(the_end, -the_end, mod(k, 2) == 0), k=1, n)]
            call compare_run(other, workspace%x, cases(of_design), factor, numbers, live)
         end do
      end do
      do sweep = 1, merge(2, 0, allocated(live%worst))
         do k = 1, n
            do the_end = -1, 1
               factor(:) = live%worst_factor
               if (abs(factor(k) - slider_end**the_end) <= 0.0_wp) cycle
               factor(k) = slider_end**the_end
               call compare_run(other, workspace%x, cases(of_design), factor, numbers, live)
            end do
         end do
      end do
   end subroutine measure_reruns

   !> Solves the design state with other rates, and compares the numbers of the page.
   subroutine compare_run(workspace, x, case, factor, numbers, live)
      class(workspace_t), intent(inout) :: workspace
      real(wp), intent(in) :: x(:)                         !! numbers of the deck
      type(case_t), intent(in) :: case
      real(wp), intent(in) :: factor(:)                    !! of the rates
      type(key_number_t), intent(in) :: numbers(:)
      type(live_t), intent(inout) :: live
      type(solve_options_t) :: options
      class(case_result_t), allocatable :: result
      type(choice_t), allocatable :: found(:)
      real(wp) :: changed(size(x)), rerun, page
      integer :: columns(2), k, side, outcome, row, c

      live%reruns = live%reruns + 1
      changed = x
      do k = 1, size(factor)
         do side = 1, count(live%rates%rate(k)%element /= '')
            call find_parameters(workspace%definition%parameters, workspace%definition%records, &
               rate_path(live%rates%rate(k), side), found)
            changed(found%number) = factor(k)*x(found%number)
         end do
      end do
      call put_numbers(changed, workspace)
      call settle_numbers([logical ::], workspace, outcome)
      row = 0
      if (outcome == succeeded) then
         allocate (result)
         options%reach = 0.0_wp
         options%is_compared = .false.
         call solve_case(workspace%suspension, case, options, result)
         if (result%is_run()) row = design_row(result%table)
      end if
      if (row == 0) then
         live%failed = live%failed + 1
         return
      end if
      associate (design => live%design)
         do k = 1, size(numbers)
            call find_columns(design, numbers(k), columns)
            do side = 1, 2
               c = columns(side)
               if (c == 0) cycle
               rerun = result%table%values(column_index(result%table, design%column(c)), row)
               page = changed_value(design%state(1), c, design%is_held(c), design%is_inverse(c), design%value(c, 1), &
                  factor(live%rates%of_law) - 1.0_wp)
               if (.not. (ieee_is_finite(rerun) .and. ieee_is_finite(page))) cycle
               if (is_noise(page - rerun, trim(design%column(c)), abs(design%value(c, 1)), solved)) cycle
               if (.not. is_larger(abs(page - rerun), live%deviation*abs(rerun))) cycle
               live%deviation = abs(page - rerun)/max(abs(rerun), tiny(1.0_wp))
               live%worst = trim(design%column(c))
               live%worst_factor = factor
               live%worst_values = [page, rerun]
            end do
         end do
      end associate

   contains

      !> Whether a deviation is larger than the largest one by more than noise. Of two wheels that are equal, the left is named.
      pure logical function is_larger(deviation, largest)
         real(wp), intent(in) :: deviation, largest        !! in the unit of column c

         is_larger = deviation > largest .and. .not. is_noise(deviation - largest, trim(live%design%column(c)), &
            abs(live%design%value(c, 1)), solved)
      end function is_larger

   end subroutine compare_run

end module ek_live_reruns
