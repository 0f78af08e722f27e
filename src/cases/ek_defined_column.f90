!> The columns of another program that follow from the columns of a table: the sources of the variables of their formulas, and their
!> values with derivatives.
!>
!> A row of the definitions (ek_definition_rows) becomes a column for each wheel, for each element or for the axle, whatever its
!> variables belong to. A column without all its variables is omitted.
module ek_defined_column
   use ek_kinds, only: wp
   use ek_quantity, only: unit_size
   use ek_text, only: is_like
   use ek_formula, only: formula_t, evaluate
   use ek_definition_rows, only: definitions
   use ek_definition, only: rows_of, own_unit_size, heading, formula_of, is_of_wheel, wheel_numbers, axle_numbers
   use ek_suspension, only: suspension_t, wheel_t
   use ek_wheel_side, only: prefix_of, deck_frame
   use ek_table, only: name_index, name_length
   implicit none(type, external)
   private
   public :: defined_t, source_t, define_columns, keep_named, is_named, design_number, defined_value

   !> A variable of a formula: a number of the model at design, plus columns of a table times their factors.
   type :: source_t
      integer :: number = 0                      !! index in `model_numbers`; 0: none
      integer :: wheel = 0                       !! wheel of the number; 0: the number is of the axle
      integer :: columns(2) = 0                  !! indices in the table; 0: none
      real(wp) :: factors(2) = 0.0_wp            !! SI value of the unit of each column, with the sign
   end type source_t

   !> A column in a definition.
   type :: defined_t
      integer :: row = 0                         !! index in `definitions`
      character(name_length) :: of = ''          !! wheel or element; '' for a single wheel and for the axle
      character(name_length) :: head = ''        !! heading
      type(formula_t) :: formula
      type(source_t), allocatable :: sources(:)  !! of each variable of the formula
   end type defined_t

   character(*), parameter :: model_numbers(*) = [character(17) :: wheel_numbers, axle_numbers], axes = 'xyz'

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
      logical :: is_of_axle

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
               call add(rows(k), 0, '', is_of_axle)
               do w = 1, merge(0, size(suspension%wheels), is_of_axle)
                  call add(rows(k), w, '')
               end do
            end if
         end associate
      end do

   contains

      !> Adds a column of a wheel (0: of the axle) or of an element, if the table and the model have all its variables.
      subroutine add(row, wheel, element, is_added)
         integer, intent(in) :: row, wheel
         character(*), intent(in) :: element          !! name in the deck; '' for none
         logical, intent(out), optional :: is_added
         type(defined_t) :: this
         character(:), allocatable :: of
         logical :: is_there
         integer :: v

         if (present(is_added)) is_added = .false.
         this%row = row
         this%formula = formula_of(definitions(row))
         allocate (this%sources(this%formula%used))
         do v = 1, this%formula%used
            call find_source(suspension, columns, trim(this%formula%variables(v)), wheel, element, this%sources(v), is_there)
            if (.not. is_there) return
         end do
         of = element
         if (of == '' .and. wheel > 0) of = prefix_of(suspension, wheel)
         if (len(of) > 0) then
            if (of(len(of):) == '_') of = of(:len(of) - 1)
         end if
         this%of = of
         this%head = heading(definitions(row), of)
         call append(this, list)
         if (present(is_added)) is_added = .true.
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

   subroutine append(this, list)
      type(defined_t), intent(in) :: this
      type(defined_t), allocatable, intent(inout) :: list(:)
      type(defined_t), allocatable :: longer(:)

      allocate (longer(size(list) + 1))
      longer(:size(list)) = list
      longer(size(longer)) = this
      call move_alloc(longer, list)
   end subroutine append

   !> Removes the columns that no name of a list names.
   subroutine keep_named(names, list)
      character(*), intent(in) :: names(:)                   !! see is_named
      type(defined_t), allocatable, intent(inout) :: list(:)
      type(defined_t), allocatable :: kept(:)
      integer :: j, k

      allocate (kept(0))
      do k = 1, size(list)
         if (any([(is_named(list(k), trim(names(j))), j=1, size(names))])) call append(list(k), kept)
      end do
      call move_alloc(kept, list)
   end subroutine keep_named

   !> Whether a name, in which * stands for any letters, names a column: by its heading, with or without the unit, or by the name of
   !> the quantity, which names the columns of all wheels and elements.
   pure logical function is_named(this, name)
      type(defined_t), intent(in) :: this
      character(*), intent(in) :: name
      integer :: mark

      associate (row => definitions(this%row), last => len_trim(this%head))
         mark = last + 1
         if (row%unit /= '') mark = index(this%head, ' [', back=.true.)
         is_named = is_like(this%head(:last), name) .or. is_like(this%head(:mark - 1), name) .or. is_like(trim(row%name), name)
      end associate
   end function is_named

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

   !> Finds a variable of a formula among the columns and the numbers of the model.
   subroutine find_source(suspension, columns, name, wheel, element, source, is_there)
      type(suspension_t), intent(in) :: suspension
      character(name_length), intent(in) :: columns(:)
      character(*), intent(in) :: name, element
      integer, intent(in) :: wheel                    !! 0: of the axle
      type(source_t), intent(out) :: source
      logical, intent(out) :: is_there                !! .false.: the model or the table does not have it
      integer :: w, first

      is_there = .true.
      if (name(1:1) == '#') then
         call take_column(columns, element//name(2:), 1, 1.0_wp, source, is_there)
      else if (any(axle_numbers == name)) then
         is_there = has_number(suspension, name)
         source%number = findloc(model_numbers == name, .true., dim=1)
      else if (wheel > 0 .and. is_of_wheel(name)) then
         call take_number(suspension, columns, name, wheel, source, is_there)
      else
         if (wheel > 0) then
            call take_column(columns, prefix_of(suspension, wheel)//name, 1, 1.0_wp, source, is_there)
            if (is_there) return
         end if
         do w = 1, merge(size(suspension%wheels), 0, size(suspension%wheels) > 1)
            first = len(prefix_of(suspension, w)) + 1
            if (index(name, prefix_of(suspension, w)) /= 1 .or. .not. is_of_wheel(name(first:))) cycle
            call take_number(suspension, columns, name(first:), w, source, is_there)
            return
         end do
         call take_column(columns, name, 1, 1.0_wp, source, is_there)
      end if
   end subroutine find_source

   !> Makes a column the part k of a variable.
   subroutine take_column(columns, name, k, sign, source, is_there)
      character(name_length), intent(in) :: columns(:)
      character(*), intent(in) :: name
      integer, intent(in) :: k
      real(wp), intent(in) :: sign
      type(source_t), intent(inout) :: source
      logical, intent(inout) :: is_there              !! becomes .false. if there is no such column, .true. for k = 1

      source%columns(k) = name_index(columns, name)
      source%factors(k) = sign*unit_size(name)
      is_there = source%columns(k) > 0 .and. (is_there .or. k == 1)
   end subroutine take_column

   !> Makes a number of a wheel a variable: its value at design, and the displacements that it depends on.
   subroutine take_number(suspension, columns, name, wheel, source, is_there)
      type(suspension_t), intent(in) :: suspension
      character(name_length), intent(in) :: columns(:)
      character(*), intent(in) :: name                !! one of wheel_numbers
      integer, intent(in) :: wheel
      type(source_t), intent(inout) :: source
      logical, intent(inout) :: is_there
      character(:), allocatable :: prefix

      source%number = findloc(model_numbers == name, .true., dim=1)
      source%wheel = wheel
      prefix = prefix_of(suspension, wheel)
      if (name == 'height') then
         call take_column(columns, prefix//'wheel_centre_z_mm', 1, 1.0_wp, source, is_there)
         call take_column(columns, prefix//'contact_patch_z_mm', 2, -1.0_wp, source, is_there)
      else if (index(name, 'centre_') == 1) then
         call take_column(columns, prefix//'wheel_'//name//'_mm', 1, 1.0_wp, source, is_there)
      else if (index(name, 'patch_') == 1) then
         call take_column(columns, prefix//'contact_'//name//'_mm', 1, 1.0_wp, source, is_there)
      end if
   end subroutine take_number

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

   !> Computes a column of a program in its unit, and its derivatives with respect to the variables of its formula in SI. NaN if a
   !> variable is not finite or the formula is not defined. Creates no strings.
   pure subroutine defined_value(suspension, row, this, value, gradient)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: row(:)                  !! row of the table
      type(defined_t), intent(in) :: this
      real(wp), intent(out) :: value, gradient(:)
      real(wp) :: x(this%formula%used)
      integer :: k, v

      do v = 1, size(x)
         associate (source => this%sources(v))
            x(v) = 0.0_wp
            if (source%number > 0) x(v) = design_number(suspension, source)
            do k = 1, size(source%columns)
               if (source%columns(k) > 0) x(v) = x(v) + row(source%columns(k))*source%factors(k)
            end do
         end associate
      end do
      call evaluate(this%formula, x, value, gradient)
      value = value/own_unit_size(definitions(this%row)%unit)
      gradient = gradient/own_unit_size(definitions(this%row)%unit)
   end subroutine defined_value

   !> The number of the model in a variable, at design, in SI and the frame of the deck.
   pure real(wp) function design_number(suspension, source) result(number)
      type(suspension_t), intent(in) :: suspension
      type(source_t), intent(in) :: source            !! with a number
      real(wp) :: frame(3)
      character(len(model_numbers)) :: name
      integer :: axis

      name = model_numbers(source%number)
      if (source%wheel == 0) then
         number = axle_number(suspension, name)
         return
      end if
      frame = deck_frame(suspension)
      axis = index(axes, name(len_trim(name):len_trim(name)))
      associate (wheel => suspension%wheels(source%wheel))
         select case (name)
         case ('side')
            number = wheel%side
         case ('height')
            number = frame(3)*(wheel%centre(3) - wheel%contact(3))
         case ('design_toe')
            number = atan2(-wheel%spin(1), wheel%side*wheel%spin(2))
         case ('design_camber')
            number = asin(max(-1.0_wp, min(1.0_wp, -wheel%spin(3))))
         case ('foot_x', 'foot_y', 'foot_z')
            number = foot(wheel, axis)
         case ('centre_x', 'centre_y', 'centre_z')
            number = frame(axis)*(suspension%bodies(wheel%body)%origin(axis) + wheel%centre(axis))
         case default
            number = frame(axis)*(suspension%bodies(wheel%body)%origin(axis) + wheel%contact(axis))
         end select
      end associate
   end function design_number

   !> A number of the axle.
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

end module ek_defined_column
