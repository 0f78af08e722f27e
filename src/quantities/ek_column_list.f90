!> The columns of a model, block by block, and their values at a state. A block (a wheel, the axle, …) consists of several
!> sections of the table of quantities. The values of a block come from one kernel. They are computed only if a column of the
!> block is requested.
module ek_column_list
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: quantity_t, held_name, unit_size, matrix, pair, tyres, axis, rack, ratio, &
      car, front, rear, mass, sprung, width, corner, rate
   use ek_suspension, only: suspension_t
   use ek_wheel_side, only: is_axle
   use ek_geometry_columns, only: mass_on
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: column_list_t, begin_list, add_quantities, add_column, end_block, fill_block, fill_asked, choose, conditions_of

   type :: column_list_t
      integer :: used = 0                              !! number of columns
      character(name_length), allocatable :: names(:)
      logical, allocatable :: is_of_matrix(:)          !! the value of this column comes from the compliance matrix
      logical, allocatable :: is_of_rate(:)            !! the value of this column depends on the springs that carry the wheels
      logical :: lacks_rate = .false.                  !! nothing carries the wheels: such a column has no value
      logical :: is_elastic = .false.                  !! forces deform the model, also with the heights of the wheels held
      logical :: is_matrix_wanted = .true.             !! a requested column needs the compliance matrix
      integer, allocatable :: place(:)                 !! index of the value of each column in the vector of its block
      real(wp), allocatable :: unit(:)                 !! unit of each column in SI; 0 for a quantity not yet requested
      integer :: offered = 0                           !! length of the vector of the block that is being added
      integer, allocatable :: last(:)                  !! last column of each block
      integer, allocatable :: section(:), item(:)      !! section of each block, and index of its wheel, element, …
      integer, allocatable :: asked(:)                 !! indices of the requested columns
      integer, allocatable :: last_asked(:)            !! number of requested columns up to the end of each block
      integer, allocatable :: blocks(:)                !! indices of the blocks with requested columns
   end type column_list_t

contains

   !> Begins an empty list. Memory for n columns is allocated.
   pure subroutine begin_list(list, n)
      class(column_list_t), intent(inout) :: list
      integer, intent(in) :: n

      allocate (list%names(n), list%is_of_matrix(n), list%is_of_rate(n), list%place(n), list%unit(n), list%last(0), &
         list%section(0), list%item(0))
   end subroutine begin_list

   !> Adds to the current block the quantities of a section that the model defines. A quantity that the model does not define has an
   !> entry in the vector of the block, but no column.
   pure subroutine add_quantities(list, section, prefix, has, condition)
      class(column_list_t), intent(inout) :: list
      type(quantity_t), intent(in) :: section(:)
      character(*), intent(in) :: prefix               !! 'left_', 'right_' or ''
      integer, intent(in) :: has                       !! sum of the conditions that the model meets
      integer, intent(in), optional :: condition       !! 1 load held, 2 height held (held_name); absent: names without '*'
      integer :: k, held, first

      held = 1
      if (present(condition)) held = condition
      first = len(prefix) + 1
      do k = 1, size(section)
         if (iand(section(k)%needs, not(ior(has, matrix + rate))) /= 0) then
            list%offered = list%offered + 1
            cycle
         end if
         call add_column(list, prefix, iand(section(k)%needs, matrix) /= 0)
         list%unit(list%used) = 0.0_wp
         list%is_of_rate(list%used) = iand(section(k)%needs, rate) /= 0 .and. (held == 1 .or. list%is_elastic)
         associate (name => list%names(list%used))          ! not put together first: that asks for memory
            name(first:) = section(k)%name
            if (index(section(k)%name, '*') > 0) name(first:) = held_name(section(k)%name, held)
         end associate
      end do
   end subroutine add_quantities

   !> Adds a column to the current block. The vector of the block gives its value in the unit of the column.
   pure subroutine add_column(list, name, is_of_matrix)
      class(column_list_t), intent(inout) :: list
      character(*), intent(in) :: name
      logical, intent(in), optional :: is_of_matrix    !! default .false.
      integer :: n

      n = size(list%is_of_matrix)
      if (list%used == n) then
         list%names = [character(name_length) :: list%names, list%names]
         list%is_of_matrix = [list%is_of_matrix, list%is_of_matrix]
         list%is_of_rate = [list%is_of_rate, list%is_of_rate]
         list%place = [list%place, list%place]
         list%unit = [list%unit, list%unit]
      end if
      list%offered = list%offered + 1
      list%used = list%used + 1
      n = list%used
      list%names(n) = name
      list%is_of_matrix(n) = .false.
      if (present(is_of_matrix)) list%is_of_matrix(n) = is_of_matrix
      list%is_of_rate(n) = .false.
      list%place(n) = list%offered
      list%unit(n) = 1.0_wp
   end subroutine add_column

   !> Ends the current block, and stores its section and the index of its wheel, element, …
   pure subroutine end_block(list, section, item)
      class(column_list_t), intent(inout) :: list
      integer, intent(in) :: section, item

      list%last = [list%last, list%used]
      list%section = [list%section, section]
      list%item = [list%item, item]
      list%offered = 0
   end subroutine end_block

   !> Copies the requested values of a block from its vector. Values are NaN if they need a matrix that is unknown, or a rate that
   !> the model does not have.
   pure subroutine fill_block(list, block, vector, is_known, values)
      class(column_list_t), intent(in) :: list
      integer, intent(in) :: block
      real(wp), intent(in) :: vector(*)                !! values of all quantities of the sections of the block, SI
      logical, intent(in) :: is_known                  !! the compliance matrix
      real(wp), intent(inout) :: values(*)             !! values of all columns, in their units
      integer :: k, j, first

      first = 1
      if (block > 1) first = list%last_asked(block - 1) + 1
      if (is_known) then
         do j = first, list%last_asked(block)
            k = list%asked(j)
            values(k) = column_value(list, k, vector)
         end do
      else
         do j = first, list%last_asked(block)
            k = list%asked(j)
            values(k) = ieee_value(1.0_wp, ieee_quiet_nan)
            if (.not. list%is_of_matrix(k)) values(k) = column_value(list, k, vector)
         end do
      end if
      if (.not. list%lacks_rate) return
      do j = first, list%last_asked(block)
         if (list%is_of_rate(list%asked(j))) values(list%asked(j)) = ieee_value(1.0_wp, ieee_quiet_nan)
      end do
   end subroutine fill_block

   !> The value of a column in its unit, from the vector of its block.
   pure real(wp) function column_value(list, column, vector)
      class(column_list_t), intent(in) :: list
      integer, intent(in) :: column
      real(wp), intent(in) :: vector(*)                !! values of all quantities of the sections of the block, SI
      column_value = vector(list%place(column))/list%unit(column)
   end function column_value

   !> Copies the requested values of a block, as fill_block does, to a row of the requested columns alone.
   pure subroutine fill_asked(list, block, vector, values)
      class(column_list_t), intent(in) :: list
      integer, intent(in) :: block
      real(wp), intent(in) :: vector(*)                !! values of all quantities of the sections of the block, SI
      real(wp), intent(inout) :: values(*)             !! values of the requested columns, in their units
      integer :: k, j, first

      first = 1
      if (block > 1) first = list%last_asked(block - 1) + 1
      do j = first, list%last_asked(block)
         k = list%asked(j)
         values(j) = column_value(list, k, vector)
      end do
   end subroutine fill_asked

   !> Chooses the columns that are filled. A block without a requested column is skipped. The matrix is solved only if a requested
   !> column needs it.
   pure subroutine choose(list, is_wanted)
      class(column_list_t), intent(inout) :: list
      logical, intent(in) :: is_wanted(:)              !! of each column
      logical :: has_columns(size(list%last))
      integer :: k

      list%is_matrix_wanted = any(is_wanted .and. list%is_of_matrix(:list%used))
      list%asked = pack([(k, k=1, list%used)], is_wanted)
      do k = 1, list%used
         if (is_wanted(k) .and. .not. list%unit(k) > 0.0_wp) list%unit(k) = unit_size(trim(list%names(k)))
      end do
      list%last_asked = [(count(is_wanted(:list%last(k))), k=1, size(list%last))]
      has_columns = list%last_asked > 0
      has_columns(2:) = list%last_asked(2:) > list%last_asked(:size(list%last) - 1)
      list%blocks = pack([(k, k=1, size(list%last))], has_columns)
   end subroutine choose

   !> Finds which of the conditions of ek_quantity a model satisfies.
   subroutine conditions_of(suspension, order, has_rack, has)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: order(:)      !! order of the wheels in the compliance matrix
      logical, intent(in) :: has_rack      !! a rack steers
      integer, intent(out) :: has(0:)      !! conditions of each wheel, in the order of the compliance matrix; (0) without a wheel
      integer :: both, k

      both = 0
      associate (axle => suspension%axle, wheels => suspension%wheels)
         if (is_axle(suspension)) both = pair
         if (has_rack) both = both + rack
         if (suspension%steering%has_steering) both = both + merge(ratio, 0, abs(suspension%steering%ratio) > 0.0_wp)
         if (axle%has_axle) both = both + car + merge(front, rear, axle%is_front)
         if (axle%mass > 0.0_wp) both = both + mass
         if (axle%front_overhang > 0.0_wp) both = both + corner
         if (all(wheels%tyre_width > 0.0_wp)) both = both + width
         has = both
         if (all(wheels%tyre_rate > 0.0_wp)) both = both + tyres
         has(0) = both
         do k = 1, size(wheels)
            associate (wheel => wheels(order(k)))
               if (wheel%has_steer_axis) has(k) = has(k) + axis
               if (is_axle(suspension)) then
                  has(k) = has(k) + iand(both, tyres)
               else if (wheel%tyre_rate > 0.0_wp) then
                  has(k) = has(k) + tyres
               end if
               if (.not. wheel%tyre_rate > 0.0_wp) cycle
               if (mass_on(suspension, order(k)) > 0.0_wp) has(k) = has(k) + sprung
            end associate
         end do
      end associate
   end subroutine conditions_of

end module ek_column_list
