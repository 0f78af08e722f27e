!> The comparison of results, and its page: charts of the curves of all results, and the table of gradients.
module ek_compare_page
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str
   use ek_version, only: version
   use ek_test_result, only: design_row
   use ek_quantity, only: quantity_t, all_quantities, quantity_named, held_name
   use ek_gradient, only: gradient_t
   use ek_test_charts, only: quantity_chart, quantities_of
   use ek_chart, only: chart_t, add_trace, append_chart
   use ek_page, only: page_t, begin_page, begin_section, add_warnings, add_facts, begin_table, &
      add_cell, add_group, end_table, add_legend, page_text, page_number
   use ek_report_files, only: results_t
   use ek_report_page, only: add_charts
   implicit none(type, external)
   private
   public :: comparison_t, difference_t, compare_gradients, difference, percent, overlay, page_of, test_number, letter_of

   !> The gradients of one test, quantity and side.
   type, extends(gradient_t) :: difference_t
      real(wp), allocatable :: values(:)      !! one per result; not a number if it lacks the gradient
      logical, allocatable :: is_there(:)
   end type difference_t

   !> Results and what differs between them.
   type :: comparison_t
      character(:), allocatable :: folder               !! of the page
      type(results_t), allocatable :: results(:)        !! the first is the one compared with
      type(difference_t), allocatable :: rows(:)
      type(chart_t), allocatable :: charts(:)           !! of the tests of the first
      type(message_list_t) :: missing                   !! from some results
      logical :: has_pictures = .false.                 !! those in the folder belong to this comparison
   end type comparison_t

contains

   !> All gradients of all results; the same test, quantity and side are one row. Rows are in the order of the first
   !> result, followed by gradients of the others only.
   subroutine compare_gradients(results, rows)
      type(results_t), intent(in) :: results(:)
      type(difference_t), allocatable, intent(out) :: rows(:)
      integer :: s, k, row, used

      allocate (rows(sum([(size(results(s)%gradients), s=1, size(results))])))
      used = 0
      do s = 1, size(results)
         do k = 1, size(results(s)%gradients)
            associate (g => results(s)%gradients(k))
               do row = 1, used
                  if (rows(row)%test == g%test .and. rows(row)%quantity == g%quantity .and. rows(row)%side == g%side) exit
               end do
               if (row > used) then
                  used = row
                  rows(row)%gradient_t = g
                  allocate (rows(row)%values(size(results)), rows(row)%is_there(size(results)))
                  rows(row)%values = ieee_value(1.0_wp, ieee_quiet_nan)
                  rows(row)%is_there = .false.
               end if
               rows(row)%values(s) = g%value
               rows(row)%is_there(s) = .true.
               if (rows(row)%window /= g%window) rows(row)%window = 'different windows'
            end associate
         end do
      end do
      rows = rows(:used)
   end subroutine compare_gradients

   !> b − a; not a number if one is missing.
   elemental real(wp) function difference(a, b)
      real(wp), intent(in) :: a, b

      difference = ieee_value(1.0_wp, ieee_quiet_nan)
      if (ieee_is_finite(a) .and. ieee_is_finite(b)) difference = b - a
   end function difference

   !> 100 (b − a)/|a|; not a number if a is zero to rounding.
   elemental real(wp) function percent(a, b)
      real(wp), intent(in) :: a, b
      real(wp), parameter :: nothing = 1.0e-9_wp     ! in the unit of any gradient: rounding of a zero

      percent = ieee_value(1.0_wp, ieee_quiet_nan)
      if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
      if (abs(a) <= nothing) return
      if (abs(b - a) < huge(1.0_wp)*min(1.0_wp, abs(a))/100) percent = 100*((b - a)/abs(a))
   end function percent

   !> Charts of every test of the first result: one per column that another result also has, with one curve per result.
   subroutine overlay(results, charts)
      type(results_t), intent(in) :: results(:)
      type(chart_t), allocatable, intent(out) :: charts(:)
      character(48), allocatable :: columns(:)
      integer :: t, k

      allocate (charts(0))
      do t = 1, size(results(1)%tests)
         columns = quantities_of(results(1)%tests(t)%kind)
         do k = 1, size(columns)
            call overlay_quantity(results, t, quantity_named(columns(k)), charts)
         end do
         do k = 1, size(all_quantities)
            if (.not. all_quantities(k)%span > 0.0_wp .or. any(columns == held_name(all_quantities(k)%name, 1))) cycle
            call overlay_quantity(results, t, quantity_named(held_name(all_quantities(k)%name, 1)), charts)
         end do
      end do
   end subroutine overlay

   !> One quantity of a test; separate charts for left and right.
   subroutine overlay_quantity(results, test, quantity, charts)
      type(results_t), intent(in) :: results(:)
      integer, intent(in) :: test
      type(quantity_t), intent(in) :: quantity
      type(chart_t), allocatable, intent(inout) :: charts(:)
      type(chart_t), allocatable :: own(:)
      type(chart_t) :: chart
      integer :: r, side, u, k

      if (quantity%name == results(1)%tests(test)%abscissa) return
      allocate (own(size(results)))
      own(1) = quantity_chart(results(1)%tests(test), quantity)
      do r = 2, size(results)
         u = test_number(results(r), results(1)%tests(test)%name)
         if (u > 0) own(r) = quantity_chart(results(r)%tests(u), quantity)
      end do
      allocate (chart%traces(0))      ! gfortran 12 takes the bounds of an unallocated component for uninitialised
      do side = 1, size(own(1)%traces)
         chart = own(1)
         chart%test = test
         chart%traces = chart%traces(:0)
         associate (name => own(1)%traces(side)%title)
            if (len(name) > 0) then
               chart%name = chart%name//'_'//name
               chart%title = chart%title//', '//name
            end if
            do r = 1, size(results)
               if (.not. allocated(own(r)%traces)) cycle
               do k = 1, size(own(r)%traces)
                  if (own(r)%traces(k)%title /= name) cycle
                  own(r)%traces(k)%colour = r
                  own(r)%traces(k)%dash = merge(0, 1 + modulo(r - 2, 3), r == 1)
                  call add_trace(chart, own(r)%traces(k))
               end do
            end do
         end associate
         if (size(chart%traces) > 1) call append_chart(charts, chart)
      end do
   end subroutine overlay_quantity

   !> compare.html
   function page_of(this, why_none) result(text)
      type(comparison_t), intent(in) :: this
      character(*), intent(in) :: why_none          !! why there are no pictures; '' if there is no message
      character(:), allocatable :: text
      type(page_t) :: page
      type(message_list_t) :: names, values, warnings
      character(longest_label(this%results)) :: labels(size(this%results))
      integer :: r, t

      do r = 1, size(this%results)
         labels(r) = this%results(r)%label
         call names%add(letter_of(r))
         call values%add(this%results(r)%path)
      end do
      call names%add('Program')
      call values%add('elastokin '//version)
      call begin_page(page, 'Comparison', 'Overlaid results; gradients compared with those of A')
      call add_facts(page, names, values)
      if (len(why_none) > 0) then
         call warnings%add('The page has no pictures: '//why_none)
         call add_warnings(page, 'Warnings', warnings)
      end if
      call add_warnings(page, 'Missing from some results', this%missing)
      if (size(this%rows) > 0) call add_gradients(page, this%results, this%rows, labels)
      do t = 1, size(this%results(1)%tests)
         if (.not. any(this%charts%test == t)) cycle
         call begin_section(page, 'test-'//str(t), this%results(1)%tests(t)%title)
         call add_legend(page, labels, design_row(this%results(1)%tests(t)%table) > 0, &
            this%results(1)%tests(t)%kind == 'table')
         if (this%has_pictures) call add_charts(page, this%charts, t, this%folder)
      end do
      text = page_text(page)
   end function page_of

   !> The table of gradients.
   subroutine add_gradients(page, results, rows, labels)
      type(page_t), intent(inout) :: page
      type(results_t), intent(in) :: results(:)
      type(difference_t), intent(in) :: rows(:)
      character(*), intent(in) :: labels(:)
      character(len(labels) + 1) :: heads(3*size(results) + 1)
      character(:), allocatable :: test
      integer :: k, r, t

      call begin_section(page, 'gradients', 'Gradients')
      heads(1) = 'Quantity'
      heads(2) = '>'//labels(1)
      do r = 2, size(results)
         heads(3*r - 3) = '>'//labels(r)
         heads(3*r - 2) = '>difference'
         heads(3*r - 1) = '>percent'
      end do
      heads(size(heads) - 1) = 'Unit'
      heads(size(heads)) = 'Window'
      call begin_table(page, heads)
      test = ''
      do k = 1, size(rows)
         if (rows(k)%test /= test) then
            test = rows(k)%test
            t = test_number(results(1), test)
            if (t > 0) call add_group(page, results(1)%tests(t)%title)
            if (t == 0) call add_group(page, test)
         end if
         call add_cell(page, trim(rows(k)%quantity//' '//rows(k)%side))
         call add_cell(page, page_number(rows(k)%values(1)), 'n')
         do r = 2, size(results)
            call add_cell(page, page_number(rows(k)%values(r)), 'n')
            call add_cell(page, page_number(difference(rows(k)%values(1), rows(k)%values(r))), 'n')
            call add_cell(page, page_number(percent(rows(k)%values(1), rows(k)%values(r))), 'n')
         end do
         call add_cell(page, rows(k)%unit)
         call add_cell(page, rows(k)%window)
      end do
      call end_table(page)
   end subroutine add_gradients

   !> The letter of a result: A is the first.
   pure character(1) function letter_of(result)
      integer, intent(in) :: result
      letter_of = achar(iachar('A') + modulo(result - 1, 26))
   end function letter_of

   !> Room for every label and for 'difference'.
   pure integer function longest_label(results) result(longest)
      type(results_t), intent(in) :: results(:)
      integer :: r
      longest = maxval([len('difference'), (len(results(r)%label), r=1, size(results))])
   end function longest_label

   !> The number of the test of this name in a result; 0 if there is none.
   pure integer function test_number(results, name) result(number)
      type(results_t), intent(in) :: results
      character(*), intent(in) :: name

      do number = size(results%tests), 1, -1
         if (results%tests(number)%name == name) return
      end do
   end function test_number

end module ek_compare_page
