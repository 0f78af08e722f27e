!> The key numbers of a report on its page: the verdicts and the main numbers as a summary, and all other key numbers by group.
module ek_number_section
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_json, only: json_numbers
   use ek_key_number, only: key_number_t
   use ek_number_words, only: steer_effect, target_verdict, short_name, sides_text, wheel_values, limits_text
   use ek_verdict, only: verdict_t, verdict_lines
   use ek_page, only: page_t, begin_section, begin_table, add_cell, end_table, add_facts, add_block, add_charts, &
      write_as_text, write_as_data, begin_beside, end_beside
   use ek_chart_choice, only: first_charts
   use ek_scene_section, only: has_view_in_space, add_view_in_space
   use ek_report_content, only: report_t
   use ek_summary, only: summary_numbers, kept_number
   implicit none(type, external)
   private
   public :: add_summary, has_summary, add_other_numbers

contains

   !> Whether the report has a summary: it has main key numbers.
   pure logical function has_summary(report)
      type(report_t), intent(in) :: report
      has_summary = size(summary_numbers(report%numbers, report%axle)) > 0
   end function has_summary

   !> Adds the summary at the top of the report: the lines of the assessment beside the 3-D picture, four charts, and the main key
   !> numbers as cards. Without main key numbers, adds nothing.
   subroutine add_summary(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(verdict_t), allocatable :: lines(:)
      type(message_list_t) :: domains, texts, marks
      integer, allocatable :: places(:)
      integer :: k

      allocate (places, source=summary_numbers(report%numbers, report%axle))
      if (size(places) == 0) return
      call begin_section(page, 'summary', 'Summary', has_text=.true.)
      call verdict_lines(report, lines)
      do k = 1, size(lines)
         call domains%add(trim(lines(k)%domain))
         call texts%add(lines(k)%text)
         call marks%add(trim(lines(k)%verdict))
      end do
      if (has_view_in_space(report)) call begin_beside(page)
      call add_facts(page, domains, texts, marks)
      if (has_view_in_space(report)) then
         call write_as_data(page, is_only=.true.)
         call add_view_in_space(page, report)
         call write_as_data(page, is_only=.false.)
         call end_beside(page)
      end if
      call add_first_charts(page, report)
      call add_numbers(page, 'cards', report, places)
   end subroutine add_summary

   !> Adds the charts of the first screen, which the script of the page draws.
   subroutine add_first_charts(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      type(message_list_t) :: names
      integer, allocatable :: places(:)
      integer :: k

      allocate (places, source=first_charts(report%charts, report%tests))
      do k = 1, size(places)
         call names%add(report%charts(places(k))%name)
      end do
      if (names%count() > 0) call add_charts(page, names, is_first=.true.)
   end subroutine add_first_charts

   !> Adds all other key numbers, each once. A number that repeats another is named next to the number that is shown.
   subroutine add_other_numbers(page, report)
      type(page_t), intent(inout) :: page
      type(report_t), intent(in) :: report
      logical, allocatable :: is_shown(:)
      integer :: k

      allocate (is_shown, source=[(kept_number(report%numbers, k) == 0, k=1, size(report%numbers))])
      is_shown(summary_numbers(report%numbers, report%axle)) = .false.
      if (.not. any(is_shown)) return
      call begin_section(page, 'key-numbers', 'K&C metrics', is_printed=.false., has_text=.true.)
      call add_numbers(page, 'numbers', report, pack([(k, k=1, size(is_shown))], is_shown))
   end subroutine add_other_numbers

   !> Adds key numbers: their indices for the script, which has the numbers in its data, and a table as text, in which the numbers
   !> that repeat a number follow this number.
   subroutine add_numbers(page, kind, report, places)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: kind              !! 'cards' or 'numbers'
      type(report_t), intent(in) :: report
      integer, intent(in) :: places(:)
      integer :: k, j

      call add_block(page, kind, json_numbers(real(places - 1, wp)))
      call write_as_text(page, is_only=.true.)
      call begin_table(page, [character(9) :: 'Quantity', '>Value', 'Unit', '~Sign', '~How'], 'numbers')
      do k = 1, size(places)
         call add_row(page, report%numbers(places(k)), report%axle%position)
         do j = 1, size(report%numbers)
            if (kept_number(report%numbers, j) == places(k)) call add_row(page, report%numbers(j), report%axle%position)
         end do
      end do
      call end_table(page)
      call write_as_text(page, is_only=.false.)
   end subroutine add_numbers

   !> Adds the row of a key number.
   subroutine add_row(page, number, axle)
      type(page_t), intent(inout) :: page
      type(key_number_t), intent(in) :: number
      integer, intent(in) :: axle
      type(message_list_t) :: values
      character(:), allocatable :: text

      values = wheel_values(number)
      text = short_name(number)
      if (number%held /= '') text = text//', '//trim(number%held)
      call add_cell(page, text)
      text = values%line(1)
      if (values%count() > 1) text = text//' | '//values%line(2)
      call add_cell(page, text, verdict=trim(target_verdict(number)))
      call add_cell(page, number%unit)
      text = number%sign
      if (sides_text(number) /= '') text = text//'; '//sides_text(number)
      if (steer_effect(number, axle) /= '') text = text//'; '//trim(steer_effect(number, axle))
      if (target_verdict(number) /= '') text = text//'; target '//limits_text(number%target)
      call add_cell(page, text)
      text = number%definition//'. '//number%condition//'.'
      if (allocated(number%reason)) text = text//' No value: '//number%reason//'.'
      call add_cell(page, text//' Name: '//number%name)
   end subroutine add_row

end module ek_number_section
