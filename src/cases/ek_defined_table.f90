!> The table of a case in the definitions of another program (ek_definition_rows).
!>
!> A row of the definitions becomes a column for each wheel, for each element or for the axle, whatever its variables belong to.
!> Columns without a row are left out; state, factor and the columns on convergence stay.
module ek_defined_table
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_quantity, only: unit_size, of_state
   use ek_formula, only: formula_t, evaluate
   use ek_definition_rows, only: definition_t, definitions
   use ek_definition, only: rows_of, title_of, own_unit_size, heading, formula_of, is_of_wheel, axle_numbers, &
      definitions_mark
   use ek_suspension, only: suspension_t, wheel_t
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_table, only: table_t, new_table, name_index, name_length
   implicit none(type, external)
   private
   public :: defined_t, define_columns, needed_columns, defined_table, defined_value, definitions_line

   !> A column in a definition: where the variables of its formula come from.
   type :: defined_t
      integer :: row = 0                         !! index in `definitions`
      character(name_length) :: of = ''          !! wheel or element; '' for a single wheel and for the axle
      character(name_length) :: head = ''        !! heading
      type(formula_t) :: formula
      integer, allocatable :: columns(:)         !! of each variable: index of its column in the table; 0: a number of the model
      real(wp), allocatable :: units(:)          !! of each variable: SI value of the unit of its column
      integer, allocatable :: wheels(:)          !! of each variable: index of the wheel of a number; 0: of the axle; negative: the
                                                 !! name of the number begins with the prefix of the wheel
   end type defined_t

contains

   !> Lists the columns of a program that follow from the columns of a table.
   subroutine define_columns(suspension, columns, program, list)
      type(suspension_t), intent(in) :: suspension
      character(name_length), intent(in) :: columns(:)       !! of the table
      character(*), intent(in) :: program                    !! one of `programs`
      type(defined_t), allocatable, intent(out) :: list(:)
      integer, allocatable :: rows(:)
      integer :: k, w, c
      character(:), allocatable :: ending

      allocate (list(0))
      rows = rows_of(program)
      do k = 1, size(rows)
         associate (row => definitions(rows(k)))
            if (row%formula == '') cycle
            ending = ending_of(formula_of(row))
            if (ending /= '') then
               do c = 1, size(columns)
                  if (is_of_element(trim(columns(c)), ending)) call add(rows(k), owner(trim(columns(c))), &
                     columns(c) (:len_trim(columns(c)) - len(ending)))
               end do
            else
               call add(rows(k), 0, '')
               do w = 1, size(suspension%wheels)
                  if (is_of_axle(rows(k))) exit
                  call add(rows(k), w, '')
               end do
            end if
         end associate
      end do

   contains

      !> Whether a row is a column of the axle, which was added.
      logical function is_of_axle(row)
         integer, intent(in) :: row

         is_of_axle = .false.
         if (size(list) == 0) return
         is_of_axle = list(size(list))%row == row .and. all(list(size(list))%wheels <= 0)
      end function is_of_axle

      !> Adds a column of a wheel (0: of the axle) or of an element, if the table and the model have all its variables.
      subroutine add(row, wheel, element)
         integer, intent(in) :: row, wheel
         character(*), intent(in) :: element          !! name in the deck; '' for none
         type(defined_t) :: this
         type(defined_t), allocatable :: longer(:)
         character(:), allocatable :: of
         integer :: v

         this%row = row
         this%formula = formula_of(definitions(row))
         allocate (this%columns(this%formula%used), this%wheels(this%formula%used), source=0)
         allocate (this%units(this%formula%used), source=1.0_wp)
         do v = 1, this%formula%used
            call find_variable(suspension, columns, trim(this%formula%variables(v)), wheel, element, this%columns(v), &
               this%wheels(v))
            if (this%columns(v) < 0) return
            if (this%columns(v) > 0) this%units(v) = unit_size(trim(columns(this%columns(v))))
         end do
         of = element
         if (of == '' .and. wheel > 0) of = prefix_of(suspension, wheel)
         if (len(of) > 0) then
            if (of(len(of):) == '_') of = of(:len(of) - 1)
         end if
         this%of = of
         this%head = heading(definitions(row), of)
         allocate (longer(size(list) + 1))
         longer(:size(list)) = list
         longer(size(longer)) = this
         call move_alloc(longer, list)
      end subroutine add

      !> The wheel whose prefix an element has; the only wheel of a model with one; 0 for an element of the axle.
      integer function owner(column)
         character(*), intent(in) :: column
         integer :: w

         owner = 0
         do w = 1, size(suspension%wheels)
            if (index(column, prefix_of(suspension, w)) == 1) owner = w
         end do
      end function owner

   end subroutine define_columns

   !> The ending of the columns of elements in a formula: '_motion_ratio'; '' for a formula without them.
   pure function ending_of(formula) result(ending)
      type(formula_t), intent(in) :: formula
      character(:), allocatable :: ending
      integer :: v

      ending = ''
      do v = 1, formula%used
         if (index(formula%variables(v), '#') == 1) ending = trim(formula%variables(v) (2:))
      end do
   end function ending_of

   !> Whether a column is that of an element with an ending. A column of the wheel with the same ending (vertical_force_n) is not.
   pure logical function is_of_element(column, ending)
      character(*), intent(in) :: column, ending
      integer :: at

      at = len(column) - len(ending)
      is_of_element = .false.
      if (at < 1) return
      is_of_element = column(at + 1:) == ending .and. index(column, 'vertical_force_n') == 0 .and. &
         index(column, 'steering_rack_force_n') == 0
   end function is_of_element

   !> Finds a variable of a formula: its column, or the wheel of its number. The column is -1 if the model does not have it.
   subroutine find_variable(suspension, columns, name, wheel, element, column, of)
      type(suspension_t), intent(in) :: suspension
      character(name_length), intent(in) :: columns(:)
      character(*), intent(in) :: name, element
      integer, intent(in) :: wheel                    !! 0: of the axle
      integer, intent(out) :: column, of
      integer :: w

      of = 0
      column = 0
      if (name(1:1) == '#') then
         column = name_index(columns, element//name(2:))
         if (column == 0) column = -1
         return
      end if
      if (any(axle_numbers == name)) then
         if (.not. has_number(suspension, name)) column = -1
         return
      end if
      if (wheel > 0) then
         of = wheel
         if (is_of_wheel(name)) return
         column = name_index(columns, prefix_of(suspension, wheel)//name)
         if (column > 0) return
         of = 0
      end if
      do w = 1, merge(size(suspension%wheels), 0, size(suspension%wheels) > 1)
         if (index(name, prefix_of(suspension, w)) /= 1) cycle
         if (.not. is_of_wheel(name(len(prefix_of(suspension, w)) + 1:))) cycle
         of = -w
         return
      end do
      column = name_index(columns, name)
      if (column == 0) column = -1
   end subroutine find_variable

   !> Whether the model has a number of the axle.
   pure logical function has_number(suspension, name)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name

      associate (axle => suspension%axle)
         select case (name)
         case ('iso')
            has_number = .true.
         case ('wheelbase', 'cg_height')
            has_number = axle%has_axle
         case ('car_mass')
            has_number = axle%has_axle .and. axle%mass > 0.0_wp
         case ('front_brake_share', 'front_drive_share')
            has_number = axle%has_axle .and. axle%is_front
         case default
            has_number = axle%has_axle .and. .not. axle%is_front
         end select
      end associate
   end function has_number

   !> Lists the columns of elastokin that the columns of a program need, each once; also those of the wheel positions.
   subroutine needed_columns(suspension, columns, program, needed)
      type(suspension_t), intent(in) :: suspension
      character(name_length), intent(in) :: columns(:)       !! all columns of a case
      character(*), intent(in) :: program
      character(name_length), allocatable, intent(inout) :: needed(:)      !! receives the names
      type(defined_t), allocatable :: list(:)
      character(*), parameter :: places(*) = [character(18) :: 'wheel_centre_x_mm', 'wheel_centre_y_mm', 'wheel_centre_z_mm', &
         'contact_patch_x_mm', 'contact_patch_y_mm', 'contact_patch_z_mm']
      integer :: k, v, w

      call define_columns(suspension, columns, program, list)
      do k = 1, size(list)
         do v = 1, size(list(k)%columns)
            if (list(k)%columns(v) > 0) call take(columns(list(k)%columns(v)))
         end do
      end do
      do w = 1, size(suspension%wheels)
         do k = 1, size(places)
            call take(prefix_of(suspension, w)//trim(places(k)))
         end do
      end do

   contains

      subroutine take(name)
         character(*), intent(in) :: name

         if (any(needed == name)) return
         needed = [character(name_length) :: needed, name]
      end subroutine take

   end subroutine needed_columns

   !> Converts a table to the definitions of a program. The header gains a line that names the program.
   subroutine defined_table(suspension, table, program, result, rows, of)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table                     !! with the columns of needed_columns
      character(*), intent(in) :: program
      type(table_t), intent(out) :: result
      integer, allocatable, intent(out), optional :: rows(:) !! of each column: index in `definitions`; 0: a column of elastokin
      character(name_length), allocatable, intent(out), optional :: of(:)  !! of each column: wheel or element
      type(defined_t), allocatable :: list(:)
      integer, allocatable :: first(:), last(:)
      integer :: k, n

      call define_columns(suspension, table%columns, program, list)
      first = pack([(k, k=1, size(table%columns))], [(any(table%columns(k) == ['state ', 'factor']), k=1, size(table%columns))])
      last = pack([(k, k=1, size(table%columns))], [(any(of_state(3:)%name == table%columns(k)), k=1, size(table%columns))])
      n = size(first) + size(list)
      result = new_table([character(name_length) :: table%columns(first), list%head, table%columns(last)], size(table%values, 2))
      result%values(:size(first), :) = table%values(first, :)
      result%values(n + 1:, :) = table%values(last, :)
      do k = 1, size(table%values, 2)
         call fill_row(suspension, table, k, list, result%values(size(first) + 1:n, k))
      end do
      result%header = table%header
      call result%header%add(definitions_line(program))
      if (allocated(table%is_scheduled)) result%is_scheduled = table%is_scheduled
      if (allocated(table%names)) result%names = table%names
      result%is_along_arc = table%is_along_arc
      result%lacks_springs = table%lacks_springs
      result%rests_on_bushings = table%rests_on_bushings
      result%is_of_rows = table%is_of_rows
      if (present(rows)) then
         allocate (rows(size(result%columns)), source=0)
         rows(size(first) + 1:n) = list%row
      end if
      if (present(of)) then
         allocate (of(size(result%columns)))
         of = ''
         of(size(first) + 1:n) = list%of
      end if
   end subroutine defined_table

   !> The line of a header on the definitions.
   function definitions_line(program) result(line)
      character(*), intent(in) :: program
      character(:), allocatable :: line

      line = definitions_mark//program//' ('//title_of(program)//'). Columns without a known definition are omitted; '// &
         'elastokin list --definitions '//program//' lists all'
   end function definitions_line

   !> Computes the columns of a program in one row of a table.
   subroutine fill_row(suspension, table, row, list, values)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table
      integer, intent(in) :: row
      type(defined_t), intent(in) :: list(:)
      real(wp), intent(out) :: values(:)
      real(wp), allocatable :: gradient(:)
      integer :: k

      do k = 1, size(list)
         allocate (gradient(list(k)%formula%used))
         call defined_value(suspension, table, row, list(k), values(k), gradient)
         deallocate (gradient)
      end do
   end subroutine fill_row

   !> Computes a column of a program in its unit, and its derivatives with respect to its variables in the units of their
   !> columns (numbers of the model: SI).
   subroutine defined_value(suspension, table, row, this, value, gradient)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table
      integer, intent(in) :: row
      type(defined_t), intent(in) :: this
      real(wp), intent(out) :: value, gradient(:)
      real(wp) :: x(this%formula%used)
      integer :: v

      do v = 1, size(x)
         if (this%columns(v) > 0) then
            x(v) = table%values(this%columns(v), row)*this%units(v)
         else
            x(v) = number_of(suspension, table, row, trim(this%formula%variables(v)), this%wheels(v))
         end if
      end do
      call evaluate(this%formula, x, value, gradient)
      value = value/own_unit_size(definitions(this%row)%unit)
      gradient = gradient*this%units/own_unit_size(definitions(this%row)%unit)
   end subroutine defined_value

   !> A number of a wheel or of the model, in SI.
   real(wp) function number_of(suspension, table, row, name, wheel) result(number)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table
      integer, intent(in) :: row, wheel               !! wheel < 0: the name begins with the prefix of this wheel
      character(*), intent(in) :: name

      if (wheel < 0) then
         number = wheel_number(suspension, table, row, name(len(prefix_of(suspension, -wheel)) + 1:), -wheel)
      else if (wheel > 0) then
         number = wheel_number(suspension, table, row, name, wheel)
      else
         number = axle_number(suspension, name)
      end if
   end function number_of

   !> A number of the model.
   pure real(wp) function axle_number(suspension, name) result(number)
      type(suspension_t), intent(in) :: suspension
      character(*), intent(in) :: name

      associate (axle => suspension%axle)
         select case (name)
         case ('iso')
            number = merge(1.0_wp, -1.0_wp, suspension%is_iso)
         case ('wheelbase')
            number = axle%wheelbase
         case ('cg_height')
            number = axle%cg_height
         case ('car_mass')
            number = axle%mass
         case ('front_brake_share')
            number = axle%brake_share
         case ('rear_brake_share')
            number = 1.0_wp - axle%brake_share
         case default
            number = axle%drive_share
         end select
      end associate
   end function axle_number

   !> A number of a wheel at a state: positions from those at design and the displacements in the table.
   real(wp) function wheel_number(suspension, table, row, name, w) result(number)
      type(suspension_t), intent(in) :: suspension
      type(table_t), intent(in) :: table
      integer, intent(in) :: row, w
      character(*), intent(in) :: name
      real(wp) :: centre(3), patch(3), frame(3)
      integer :: axis

      frame = deck_frame(suspension)
      associate (wheel => suspension%wheels(w), origin => suspension%bodies(suspension%wheels(w)%body)%origin)
         axis = index('xyz', name(len(name):))
         select case (name)
         case ('side')
            number = wheel%side
         case ('design_toe')
            number = atan2(-wheel%spin(1), wheel%side*wheel%spin(2))
         case ('design_camber')
            number = asin(max(-1.0_wp, min(1.0_wp, -wheel%spin(3))))
         case ('foot_x', 'foot_y', 'foot_z')
            number = foot(wheel, axis)
         case default
            centre = frame*(origin + wheel%centre) + displacement('wheel_centre_')
            patch = frame*(origin + wheel%contact) + displacement('contact_patch_')
            if (name == 'height') then
               number = centre(3) - patch(3)
            else if (index(name, 'centre_') == 1) then
               number = centre(axis)
            else
               number = patch(axis)
            end if
         end select
      end associate

   contains

      !> Displacement of a point from design in the frame of the deck [m]; NaN without its columns.
      function displacement(stem) result(moved)
         character(*), intent(in) :: stem
         character(*), parameter :: axes = 'xyz'
         real(wp) :: moved(3)
         character(:), allocatable :: column
         integer :: k, place

         do k = 1, 3
            moved(k) = ieee_value(1.0_wp, ieee_quiet_nan)
            column = prefix_of(suspension, w)//stem//axes(k:k)//'_mm'
            place = name_index(table%columns, column)
            if (place > 0) moved(k) = table%values(place, row)*unit_size(column)
         end do
      end function displacement

   end function wheel_number

   !> Contact point from the wheel centre at design in the axes of the wheel [m]: ahead (1), outboard along the spin axis (2), up in
   !> the plane of the wheel (3).
   pure real(wp) function foot(wheel, axis)
      type(wheel_t), intent(in) :: wheel
      integer, intent(in) :: axis
      real(wp) :: arm(3), ahead(3), h

      arm = wheel%contact - wheel%centre
      associate (w => wheel%spin)
         h = hypot(w(1), w(2))
         ahead = wheel%side*[-w(2), w(1), 0.0_wp]/h                        ! x rearward, y right
         select case (axis)
         case (1)
            foot = dot_product(arm, ahead)
         case (2)
            foot = dot_product(arm, w)
         case default
            foot = (arm(3) - w(3)*dot_product(arm, w))/h
         end select
      end associate
   end function foot

end module ek_defined_table
