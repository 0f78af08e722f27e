!> The definitions of another program: its rows, units and column headings.
module ek_definition
   use ek_kinds, only: wp, degree, millimetre
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted, suggestion
   use ek_quantity, only: unit_of, unit_text, unit_size
   use ek_formula, only: formula_t, read_formula
   use ek_definition_rows, only: definition_t, definitions, programs, program_titles, unpublished, unconfirmed, beyond
   implicit none(type, external)
   private
   public :: rows_of, check_program, title_of, own_unit_size, has_own_unit, heading, label_of_heading, status_of, formula_of, &
      is_of_wheel, has_no_column

   !> A unit of another program with its SI value. % and ratios count as they are.
   type :: own_unit_t
      character(12) :: text
      real(wp) :: size = 1.0_wp
   end type own_unit_t

   type(own_unit_t), parameter :: own_units(*) = [own_unit_t(''), own_unit_t('mm', millimetre), own_unit_t('deg', degree), &
      own_unit_t('N'), own_unit_t('%'), own_unit_t('Hz'), own_unit_t('mm/m'), own_unit_t('deg/deg'), own_unit_t('N/mm', 1.0e3_wp), &
      own_unit_t('deg/m', degree), own_unit_t('deg/mm', 1.0e3_wp*degree), own_unit_t('mm/kN', 1.0e-6_wp), &
      own_unit_t('deg/100 N m', degree/100.0_wp), own_unit_t('deg/(N mm)', 1.0e3_wp*degree)]

   !> Begin of the header line of a table in the definitions of another program.
   character(*), parameter, public :: definitions_mark = 'definitions: '

   !> Numbers of a wheel that are not columns.
   character(*), parameter, public :: wheel_numbers(*) = [character(13) :: 'side', 'height', 'centre_x', 'centre_y', 'centre_z', &
      'patch_x', 'patch_y', 'patch_z', 'foot_x', 'foot_y', 'foot_z', 'design_toe', 'design_camber']

   !> Numbers of the model that are not columns.
   character(*), parameter, public :: axle_numbers(*) = [character(17) :: 'iso', 'wheelbase', 'cg_height', 'car_mass', &
      'front_brake_share', 'rear_brake_share', 'front_drive_share', 'rear_drive_share']

contains

   !> The indices of the rows of a program.
   pure function rows_of(program) result(rows)
      character(*), intent(in) :: program
      integer, allocatable :: rows(:)
      integer :: k

      rows = pack([(k, k=1, size(definitions))], definitions%program == program)
   end function rows_of

   !> Checks the value of --definitions.
   subroutine check_program(program, error)
      character(*), intent(in) :: program
      type(error_t), allocatable, intent(out) :: error      !! exit_usage: not one of the programs
      character(:), allocatable :: names
      integer :: k

      if (any(programs == program)) return
      names = trim(programs(1))
      do k = 2, size(programs)
         names = names//trim(merge(' or', ',  ', k == size(programs)))//' '//trim(programs(k))
      end do
      call fail(error, exit_usage, '--definitions: expected '//names//', found '//quoted(program)//suggestion(program, programs))
   end subroutine check_program

   !> The full name of a program.
   pure function title_of(program) result(title)
      character(*), intent(in) :: program
      character(:), allocatable :: title

      title = trim(program_titles(findloc(programs == program, .true., dim=1)))
   end function title_of

   !> SI value of the unit of a row.
   pure real(wp) function own_unit_size(text) result(size_of)
      character(*), intent(in) :: text

      size_of = own_units(max(1, findloc(own_units%text == text, .true., dim=1)))%size
   end function own_unit_size

   !> Whether a string is the unit of a row; '' for a number without unit.
   pure logical function has_own_unit(text)
      character(*), intent(in) :: text

      has_own_unit = any(own_units%text == text)
   end function has_own_unit

   !> The heading of a column: 'left Toe Angle [deg]'.
   pure function heading(row, of) result(head)
      type(definition_t), intent(in) :: row
      character(*), intent(in) :: of        !! wheel or element; '' for a single wheel and an axle
      character(:), allocatable :: head

      head = trim(row%name)
      if (of /= '') head = of//' '//head
      if (row%unit /= '') head = head//' ['//trim(row%unit)//']'
   end function heading

   !> The unit of a column as a label: of a heading with a unit in brackets, and of a column of elastokin.
   pure function label_of_heading(head) result(label)
      character(*), intent(in) :: head
      character(:), allocatable :: label
      integer :: last

      last = len_trim(head)
      label = unit_text(unit_of(trim(head)))
      if (last == 0) return
      if (head(last:last) == ']' .and. index(head, '[') > 0) label = head(index(head, '[', back=.true.) + 1:last - 1)
   end function label_of_heading

   !> Whether a row is printed, and the reason if it is not.
   pure function status_of(row) result(status)
      type(definition_t), intent(in) :: row
      character(:), allocatable :: status

      if (row%formula /= '') then
         status = 'printed'
      else if (index(row%difference, unpublished) == 1) then
         status = unpublished
      else if (index(row%difference, unconfirmed) == 1) then
         status = unconfirmed
      else
         status = beyond
      end if
   end function status_of

   !> The formula of a row. The formulas of all rows are valid, which a test checks.
   type(formula_t) function formula_of(row) result(formula)
      type(definition_t), intent(in) :: row
      character(:), allocatable :: mistake

      call read_formula(trim(row%formula), formula, mistake)
   end function formula_of

   !> Whether a variable is a number of a wheel.
   pure logical function is_of_wheel(variable)
      character(*), intent(in) :: variable

      is_of_wheel = any(wheel_numbers == variable)
   end function is_of_wheel

   !> Whether a variable is a number of a wheel or of the axle, not a column.
   pure logical function has_no_column(variable)
      character(*), intent(in) :: variable

      has_no_column = any(axle_numbers == variable) .or. is_of_wheel(variable) .or. &
         is_of_wheel(variable(index(variable, '_') + 1:))       ! left_centre_y
   end function has_no_column

end module ek_definition
