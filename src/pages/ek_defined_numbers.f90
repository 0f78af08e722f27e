!> The numbers of a report at design in the definitions of another program: definitions.csv, definitions.json, and their section of
!> the page.
module ek_defined_numbers
   use ek_kinds, only: wp
   use ek_json, only: json_t, json_string, json_number
   use ek_buffer, only: buffer_t
   use ek_definition_rows, only: definition_t, definitions
   use ek_definition, only: rows_of, title_of, status_of
   use ek_definition_json, only: add_definition
   use ek_table, only: table_t, csv_cell, name_length
   use ek_test_result, only: design_row
   use ek_decimal, only: decimal
   use ek_page, only: page_t, begin_section, begin_table, end_table, add_cell, add_text, page_number
   implicit none(type, external)
   private
   public :: defined_numbers_t, read_defined, defined_csv, defined_json, add_defined_section

   !> Numbers at the design state of a test.
   type :: defined_numbers_t
      character(:), allocatable :: program, test               !! one of `programs`; title of the test, '' before the first one
      integer, allocatable :: rows(:)                          !! of each number: index in `definitions`
      character(name_length), allocatable :: of(:)             !! of each number: wheel or element, '' for none
      real(wp), allocatable :: values(:)
   end type defined_numbers_t

contains

   !> Reads the numbers of the first test that has a design state. Without one, or if a test was read before, nothing changes.
   subroutine read_defined(table, rows, of, test, numbers)
      type(table_t), intent(in) :: table                       !! in the definitions of the program
      integer, intent(in) :: rows(:)                           !! of each column, as from defined_table
      character(name_length), intent(in) :: of(:)
      character(*), intent(in) :: test
      type(defined_numbers_t), intent(inout) :: numbers
      integer, allocatable :: columns(:)
      integer :: k, row

      row = design_row(table)
      if (row == 0 .or. numbers%test /= '') return
      columns = pack([(k, k=1, size(rows))], rows > 0)
      numbers%test = test
      numbers%rows = rows(columns)
      numbers%of = of(columns)
      numbers%values = table%values(columns, row)
   end subroutine read_defined

   !> The numbers as CSV; then the quantities that are not printed, without a value.
   function defined_csv(numbers) result(text)
      type(defined_numbers_t), intent(in) :: numbers
      character(:), allocatable :: text
      type(buffer_t) :: out
      integer, allocatable :: all(:)
      integer :: k

      call out%line('# definitions: '//numbers%program//' ('//title_of(numbers%program)//'), at design, test '//numbers%test)
      call out%line('name,of,value,unit,positive,status,column,formula,difference,errs')
      do k = 1, size(numbers%rows)
         call put(definitions(numbers%rows(k)), trim(numbers%of(k)), decimal(numbers%values(k)))
      end do
      allocate (all, source=rows_of(numbers%program))
      do k = 1, size(all)
         if (definitions(all(k))%formula == '') call put(definitions(all(k)), '', '')
      end do
      text = out%text()

   contains

      subroutine put(row, of, value)
         type(definition_t), intent(in) :: row
         character(*), intent(in) :: of, value

         call out%line(csv_cell(trim(row%name))//','//of//','//value//','//csv_cell(trim(row%unit))//','// &
            csv_cell(trim(row%positive))//','//status_of(row)//','//trim(row%ours)//','//csv_cell(trim(row%formula))//','// &
            csv_cell(trim(row%difference))//','//csv_cell(trim(row%errs)))
      end subroutine put

   end function defined_csv

   !> The same as JSON (schema/definitions.schema.json).
   function defined_json(numbers, model, checksum) result(text)
      type(defined_numbers_t), intent(in) :: numbers
      character(*), intent(in) :: model, checksum
      character(:), allocatable :: text
      type(json_t) :: json
      integer, allocatable :: all(:)
      integer :: k

      call json%begin_record(model, checksum)
      call json%item('definitions', json_string(numbers%program))
      call json%item('title', json_string(title_of(numbers%program)))
      call json%item('test', json_string(numbers%test))
      call json%open('[', 'rows')
      do k = 1, size(numbers%rows)
         call json%open('{')
         call json%item('of', json_string(trim(numbers%of(k))))
         call json%item('value', json_number(numbers%values(k)))
         call add_definition(json, definitions(numbers%rows(k)))
         call json%close('}')
      end do
      allocate (all, source=rows_of(numbers%program))
      do k = 1, size(all)
         if (definitions(all(k))%formula /= '') cycle
         call json%open('{')
         call json%item('of', '""')
         call json%item('value', 'null')
         call add_definition(json, definitions(all(k)))
         call json%close('}')
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function defined_json

   !> Adds the section of the page: a row for each quantity of both wheels, of an element or of the axle.
   subroutine add_defined_section(page, numbers)
      type(page_t), intent(inout) :: page
      type(defined_numbers_t), intent(in) :: numbers
      character(:), allocatable :: label, note
      logical :: is_pair
      integer :: k

      call begin_section(page, 'definitions', 'In the definitions of '//title_of(numbers%program), is_printed=.true.)
      call add_text(page, 'p', 'At design, test '//numbers%test//'. All other numbers and charts of this page are in the '// &
         'definitions of elastokin. definitions.csv also has the formulas, and the quantities without a known definition.')
      call begin_table(page, [character(24) :: 'Quantity', '>Left', '>Right', '>Value', 'Unit', 'Positive', 'Difference'])
      k = 0
      do while (k < size(numbers%rows))
         k = k + 1
         associate (row => definitions(numbers%rows(k)))
            is_pair = .false.
            if (k < size(numbers%rows)) is_pair = numbers%of(k) == 'left' .and. numbers%of(k + 1) == 'right' .and. &
               numbers%rows(k + 1) == numbers%rows(k)
            label = trim(row%name)
            if (numbers%of(k) /= '' .and. .not. is_pair) label = trim(numbers%of(k))//' '//label
            call add_cell(page, label)
            if (is_pair) then
               call add_cell(page, page_number(numbers%values(k)))
               call add_cell(page, page_number(numbers%values(k + 1)))
               call add_cell(page, '')
               k = k + 1
            else
               call add_cell(page, '')
               call add_cell(page, '')
               call add_cell(page, page_number(numbers%values(k)))
            end if
            note = trim(row%difference)
            if (row%errs /= '') note = note//'; it errs: '//trim(row%errs)
            call add_cell(page, trim(row%unit))
            call add_cell(page, trim(row%positive))
            call add_cell(page, note)
         end associate
      end do
      call end_table(page)
   end subroutine add_defined_section

end module ek_defined_numbers
