!> The contributions to the rates and the key compliances of a report: the parts of the rates, and the largest
!> contributions to each compliance at design, as bars.
module ek_explanation
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_largest, only: largest
   use ek_key_numbers, only: without_side
   use ek_quantity, only: quantity_t, quantity_named, unit_of, unit_text
   use ek_case_result, only: case_result_t
   use ek_schedule, only: new_schedule
   use ek_path_states, only: nearest_reached
   use ek_contribution_table, only: contribution_table_t, start_contributions, choose_contributions, find_contributions, &
      is_key_compliance, share_length
   use ek_rate_split, only: classes, split_wheel_rate, split_roll_rate
   use ek_test_result, only: design_row
   use ek_table, only: column_index
   use ek_page, only: page_t, begin_section, add_text, begin_table, add_cell, add_group, add_bar, end_table, page_number
   implicit none(type, external)
   private
   public :: explanation_t, find_explanations, add_explanations, parts_of, cause_of, percent_text

   integer, parameter :: shown = 10      !! largest number of contributions of a column

   !> A column at design with its contributions, or a rate with its parts.
   type :: explanation_t
      character(:), allocatable :: title, column, unit
      real(wp) :: value = 0.0_wp
      integer :: rows = 0
      character(share_length + 12) :: row(shown) = ''      !! name of a contribution: 'arm_front x'
      real(wp) :: part(shown) = 0.0_wp                     !! in the unit; of a compliance, the largest first
      real(wp) :: rest = 0.0_wp
   end type explanation_t

contains

   !> Finds the parts of the wheel rate and the roll rate, then the contributions to the key compliances, at the state of a
   !> case that is nearest to design. For an axle, only the left wheel is explained. The list is empty if the model has no key
   !> compliance, if no state was reached, or if the matrix of that state is singular.
   subroutine find_explanations(result, list)
      type(case_result_t), intent(inout) :: result              !! is_run
      type(explanation_t), allocatable, intent(out) :: list(:)
      type(contribution_table_t) :: table
      type(explanation_t), allocatable :: found(:)
      logical, allocatable :: is_wanted(:)
      integer, allocatable :: order(:)
      type(explanation_t) :: rates(3)
      type(quantity_t) :: quantity
      integer :: k, c, used

      allocate (list(0), found(0))
      call start_contributions(result%suspension, table)
      allocate (is_wanted(table%columns%used))
      do c = 1, size(is_wanted)
         is_wanted(c) = is_key_compliance(trim(table%columns%names(c))) .and. index(table%columns%names(c), 'right_') == 0
      end do
      k = nearest_reached(result%path, 0.0_wp)
      if (k == 0 .or. .not. any(is_wanted)) return
      call choose_contributions(is_wanted, table)
      call find_contributions(result%suspension, new_schedule(result%suspension, result%case), result%path, k, result%kkt, table)
      if (.not. table%is_known) return
      deallocate (found)
      allocate (found(size(table%values)))
      do c = 1, size(found)
         associate (this => found(c))
            this%column = trim(table%columns%names(table%columns%asked(c)))
            this%unit = unit_text(unit_of(this%column))
            if (index(this%column, 'left_') == 1) then
               quantity = quantity_named(this%column(6:))
            else
               quantity = quantity_named(this%column)
            end if
            this%title = trim(quantity%title)
            if (index(this%title, 'patch_') == 1) this%title = 'Vertical compliance at the contact point'
            this%value = table%values(c)
            call largest(table%parts(c, :), shown, order)
            this%rows = 0
            do k = 1, size(order)
               if (reads_zero(table%parts(c, order(k)))) exit
               this%rows = k
               this%row(k) = trim(table%row(order(k))%row)//' '//table%row(order(k))%part
               this%part(k) = table%parts(c, order(k))
            end do
            this%rest = this%value - sum(this%part)
         end associate
      end do
      call find_rates(result, table, rates, used)
      deallocate (list)
      allocate (list(used + size(found)))           ! gfortran 12 loses the texts of [rates, found]
      do c = 1, used
         list(c) = rates(c)
      end do
      do c = 1, size(found)
         list(used + c) = found(c)
      end do
   end subroutine find_explanations

   !> Finds the wheel rate of the left or single wheel and the roll rate, with their parts. A rate is omitted if the table of
   !> the case does not give it at design, or if its parts are not known.
   subroutine find_rates(result, table, found, used)
      type(case_result_t), intent(in) :: result
      type(contribution_table_t), intent(in) :: table
      type(explanation_t), intent(out) :: found(3)
      integer, intent(out) :: used
      character(*), parameter :: names(3) = [character(32) :: 'left_wheel_rate_n_per_mm', 'wheel_rate_n_per_mm', &
         'suspension_roll_rate_nm_per_deg']
      real(wp) :: shares(size(classes))
      logical :: is_known
      integer :: k, column, row

      used = 0
      row = design_row(result%table)
      do k = 1, size(names)
         column = 0
         if (row > 0) column = column_index(result%table, names(k))
         if (column == 0) cycle
         if (k == size(names)) then
            call split_roll_rate(result%suspension, table, shares, is_known)
         else
            call split_wheel_rate(result%suspension, table, 1, shares, is_known)
         end if
         if (.not. is_known .or. .not. ieee_is_finite(result%table%values(column, row))) cycle
         used = used + 1
         found(used) = split_of(trim(names(k)), result%table%values(column, row), shares)
      end do
   end subroutine find_rates

   !> A rate with its parts. Parts that are printed as 0.0 % belong to the rest.
   function split_of(column, value, shares) result(rate)
      character(*), intent(in) :: column
      real(wp), intent(in) :: value, shares(:)
      type(explanation_t) :: rate
      integer :: c

      rate%column = column
      rate%unit = unit_text(unit_of(column))
      rate%title = 'Wheel rate at design, wheels in parallel travel'
      if (index(column, 'roll_rate') > 0) rate%title = 'Suspension roll rate at design'
      rate%value = value
      do c = 1, size(shares)
         if (abs(shares(c)) < 0.5e-4_wp) cycle           ! 0.0 %
         rate%rows = rate%rows + 1
         rate%row(rate%rows) = classes(c)
         rate%part(rate%rows) = shares(c)*value
      end do
      rate%rest = value - sum(rate%part)
   end function split_of

   !> The parts of a column: 'at design: springs 81 %, bushings 15 %, …'; '' if the column has no explanation.
   function parts_of(list, column) result(text)
      type(explanation_t), intent(in) :: list(:)
      character(*), intent(in) :: column
      character(:), allocatable :: text
      integer :: c, k

      text = ''
      do c = 1, size(list)
         if (list(c)%column /= column) cycle
         do k = 1, list(c)%rows
            if (len(text) > 0) text = text//', '
            text = text//trim(list(c)%row(k))//' '//str(anint(1000.0_wp*list(c)%part(k)/list(c)%value)/10.0_wp, 4)//' %'
         end do
         if (len(text) > 0) text = 'at design: '//text
         return
      end do
   end function parts_of

   !> The element that contributes more than half of a compliance: '85 % from the stiffness of rack_drive'; '' if there is none, or if
   !> the column is not an explained compliance. The contributions of all axes of an element, of the left and of the right one, belong
   !> together. Above 150 %, the contributions of several elements cancel, and none is the cause.
   function cause_of(list, column) result(text)
      type(explanation_t), intent(in) :: list(:)
      character(*), intent(in) :: column               !! without left_
      character(:), allocatable :: text
      real(wp), parameter :: limit = 1.5_wp
      real(wp) :: share, most
      integer :: c, k, l, cause

      text = ''
      if (index(column, '_held_') == 0) return
      do c = 1, size(list)
         if (without_side(list(c)%column) /= column .or. reads_zero(list(c)%value)) cycle
         most = 0.5_wp
         cause = 0
         do k = 1, list(c)%rows
            share = 0.0_wp
            do l = 1, list(c)%rows
               if (element_of(list(c)%row(l)) == element_of(list(c)%row(k))) share = share + list(c)%part(l)/list(c)%value
            end do
            if (.not. share > most) cycle
            most = share
            cause = k
         end do
         if (cause == 0 .or. most > limit .or. nint(100*most) <= 50) return
         text = str(nint(100*most))//' % from '
         if (index(trim(list(c)%row(cause))//'|', ' stiffness|') > 0) text = text//'the stiffness of '
         text = text//element_of(list(c)%row(cause))
         return
      end do
   end function cause_of

   !> The element of a contribution, without its part and the name of its side: 'lca_front' for 'left_lca_front y'.
   function element_of(row) result(name)
      character(*), intent(in) :: row
      character(:), allocatable :: name

      name = without_side(row(:index(trim(row), ' ', back=.true.) - 1))
   end function element_of

   !> Adds the section of contributions; adds nothing for an empty list.
   subroutine add_explanations(page, list)
      type(page_t), intent(inout) :: page
      type(explanation_t), intent(in) :: list(:)
      integer :: c, k

      if (size(list) == 0) return
      call begin_section(page, 'contributions', 'Contributions to these numbers', is_printed=.false.)
      call add_text(page, 'p', 'Each compliance at design is the exact sum of what every axis of every bushing, spring, bar '// &
         'and preload adds to it; elastokin explain lists all of them at every state. Geometric: by the force that the part '// &
         'carries, not by its rate. A rate that is 1 % higher lowers the compliance by 1 % of its contribution. '// &
         'The rates are the same sums for a given motion: the part of a spring is its rate times the square of its motion ratio.')
      call begin_table(page, [character(13) :: 'Contribution', '>Value', '>Share, %', '- 0 +', '~Unit'])
      do c = 1, size(list)
         if (list(c)%rows == 0 .and. reads_zero(list(c)%value)) cycle      ! held by a joint, or zero by symmetry
         associate (this => list(c))
            call add_group(page, this%title//': '//page_number(this%value)//' '//this%unit)
            do k = 1, this%rows
               call add_row(page, trim(this%row(k)), this%part(k), this)
            end do
            if (.not. reads_zero(this%rest)) call add_row(page, 'rest', this%rest, this)
         end associate
      end do
      call end_table(page)
   end subroutine add_explanations

   subroutine add_row(page, name, part, this)
      type(page_t), intent(inout) :: page
      character(*), intent(in) :: name
      real(wp), intent(in) :: part
      type(explanation_t), intent(in) :: this
      real(wp) :: most

      most = max(maxval(abs(this%part)), abs(this%rest))      ! a row is shown: one of them is not zero
      call add_cell(page, name)
      call add_cell(page, page_number(part))
      if (reads_zero(this%value)) then
         call add_cell(page, '–')                 ! parts that cancel
      else
         call add_cell(page, percent_text(part/this%value))
      end if
      call add_bar(page, part/most)
      call add_cell(page, this%unit)
   end subroutine add_row

   !> A share in percent, rounded to 0.1 and printed with the digits that this rounding leaves: '44.1', '−0.5', '0'. A share of
   !> 1e6 % or more, of a value that nearly cancels, has four digits.
   pure function percent_text(share) result(text)
      real(wp), intent(in) :: share
      character(:), allocatable :: text
      character(16) :: buffer

      text = page_number(100.0_wp*share)
      if (abs(share) >= 1.0e4_wp) return
      write (buffer, '(f0.1)') 100.0_wp*abs(share)
      text = trim(buffer)
      if (text(1:1) == '.') text = '0'//text
      if (text == '0.0') text = '0'
      if (share < 0.0_wp .and. text /= '0') text = '−'//text
   end function percent_text

   !> Whether a number is printed as zero on the page. A row with such a number would show rounding only.
   pure logical function reads_zero(number)
      real(wp), intent(in) :: number
      reads_zero = page_number(number) == '0'
   end function reads_zero

end module ek_explanation
