!> The printed output of elastokin explain: the largest contributions to each column with bars, the value of each column with rigid
!> elements, and the change of each column by an added spring.
module ek_explain_text
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_quantity, only: unit_of, unit_text
   use ek_element, only: element_t
   use ek_element_part, only: is_part_of_angle
   use ek_suspension, only: suspension_t
   use ek_kkt, only: kkt_t
   use ek_contribution_table, only: contribution_table_t
   use ek_linear_columns, only: fill_changed_columns
   use ek_what_if, only: find_self_moves, changed_compliance, rigid_compliance
   use ek_largest, only: largest
   implicit none(type, external)
   private
   public :: add_largest, add_rigid, add_scan

   integer, parameter :: shown = 10            !! largest number of rows per column
   integer, parameter :: longest_bar = 30      !! length of the longest bar [letters]
   real(wp), parameter :: added_rate = 1.0e6_wp      !! rate of the added spring [N/m]: 1 kN/mm

contains

   !> Adds the largest contributions to each requested column, and the sum of the others.
   subroutine add_largest(table, text)
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      integer, allocatable :: order(:)
      real(wp) :: rest
      integer :: c, k

      do c = 1, size(table%values)
         call text%line(heading(table, c)//' = '//number(table%values(c))//' '//unit(table, c))
         call largest(table%parts(c, :), shown, order)
         rest = table%values(c) - sum(table%parts(c, order))
         do k = 1, size(order)
            associate (row => table%row(order(k)))
               call add_bar(trim(row%row)//'.'//trim(row%part), table%parts(c, order(k)), table%values(c), &
                  maxval(abs(table%parts(c, :))), text)
            end associate
         end do
         if (size(order) < count(abs(table%parts(c, :)) > 0.0_wp)) call add_bar('rest', rest, table%values(c), &
            maxval(abs(table%parts(c, :))), text)
      end do
   end subroutine add_largest

   !> Adds a line with name, value, share and bar.
   subroutine add_bar(name, value, whole, most, text)
      character(*), intent(in) :: name
      real(wp), intent(in) :: value, whole, most
      type(buffer_t), intent(inout) :: text
      character(8) :: percent
      integer :: letters

      percent = ''
      if (abs(whole) > 0.0_wp) write (percent, '(f7.1,a)') 100.0_wp*value/whole, '%'
      letters = 0
      if (most > 0.0_wp) letters = min(nint(longest_bar*abs(value)/most), longest_bar)
      call text%line('  '//padded(name)//number(value)//percent//repeat(' ', merge(2, 0, letters > 0))// &
         repeat(merge('+', '-', value > 0.0_wp), letters))
   end subroutine add_bar

   !> Adds the value of each requested column, and the value of the same column with some laws rigid.
   subroutine add_rigid(suspension, name, laws, kkt, table, text)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name                 !! name of the rigid element or axis
      integer, intent(in) :: laws(:)
      type(kkt_t), intent(inout) :: kkt                !! system with the factors of the state
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      real(wp), allocatable :: self_move(:, :), c(:, :)
      real(wp) :: values(size(table%values))
      integer :: k, n

      n = 6*table%columns%kandc%compliance%wheels
      call find_self_moves(laws, kkt, table%columns%kandc%compliance, table%shares, self_move)
      c = rigid_compliance(table%columns%kandc%compliance%response(:n, :n), table%shares%left_move(:, laws), &
         table%shares%move(:, laws), self_move)
      call fill_changed_columns(suspension, c, table%columns, values)
      call text%line('with '//name//' rigid, at this state:')
      do k = 1, size(values)
         call text%line('  '//padded(heading(table, k))//number(table%values(k))//'  ->'//number(values(k))//' '//unit(table, k))
      end do
   end subroutine add_rigid

   !> Adds the ten locations at which an added spring of 1 kN/mm changes a column most. The locations are along axes of bushings and
   !> parallel to springs.
   subroutine add_scan(suspension, kkt, table, text)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(inout) :: kkt                !! system with the factors of the state
      type(contribution_table_t), intent(in) :: table
      type(buffer_t), intent(inout) :: text
      real(wp), allocatable :: self_move(:, :), c(:, :)
      real(wp) :: change(size(table%values), size(table%shares%law)), values(size(table%values))
      integer, allocatable :: order(:)
      logical :: is_known
      integer :: k, law, n

      n = 6*table%columns%kandc%compliance%wheels
      change = 0.0_wp
      do law = 1, size(table%shares%law)
         associate (share => table%shares%share(table%shares%law(law)))
            if (is_part_of_angle(suspension%elements(share%item), share%part)) cycle
         end associate
         call find_self_moves([law], kkt, table%columns%kandc%compliance, table%shares, self_move)
         call changed_compliance(table%columns%kandc%compliance%response(:n, :n), table%shares%left_move(:, [law]), &
            table%shares%move(:, [law]), self_move, [added_rate], c, is_known)
         if (.not. is_known) cycle
         call fill_changed_columns(suspension, c, table%columns, values)
         change(:, law) = values - table%values
      end do
      do k = 1, size(values)
         call text%line('1 kN/mm more changes '//heading(table, k)//' = '//number(table%values(k))//' '//unit(table, k)//' by:')
         call largest(change(k, :), shown, order)
         do law = 1, size(order)
            associate (row => table%row(table%shares%law(order(law))))
               call add_bar(trim(row%row)//'.'//trim(row%part), change(k, order(law)), table%values(k), maxval(abs(change(k, :))), &
                  text)
            end associate
         end do
      end do
   end subroutine add_scan

   pure function heading(table, c) result(name)
      type(contribution_table_t), intent(in) :: table
      integer, intent(in) :: c
      character(:), allocatable :: name
      name = trim(table%columns%names(table%columns%asked(c)))
   end function heading

   pure function unit(table, c) result(text)
      type(contribution_table_t), intent(in) :: table
      integer, intent(in) :: c
      character(:), allocatable :: text
      text = unit_text(unit_of(heading(table, c)))
   end function unit

   !> A name, padded with blanks to the width of its column.
   pure function padded(name) result(text)
      character(*), intent(in) :: name
      character(:), allocatable :: text
      integer, parameter :: width = 32
      text = name//repeat(' ', max(width - len(name), 1))
   end function padded

   !> A number with seven digits after the point.
   function number(value) result(text)
      real(wp), intent(in) :: value
      character(14) :: text
      write (text, '(f14.7)') value
   end function number

end module ek_explain_text
