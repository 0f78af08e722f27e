!> Reads back a report folder or a table of results: the tests, and the description of each test in the header of its table.
module ek_report_files
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str, quoted, lower
   use ek_file, only: join_path, base_name, file_exists, folder_exists
   use ek_definition, only: title_of
   use ek_test_charts, only: program_of
   use ek_table, only: read_csv, name_length
   use ek_decimal, only: get_decimal
   use ek_gnuplot_text, only: one_line
   use ek_frame, only: frame_t, new_frame
   use ek_text_table, only: text_table_t, read_text_table, cell_of
   use ek_test_result, only: test_result_t, find_wheels, choose_abscissa, read_frame_line
   use ek_gradient, only: gradient_t, test_gradients, read_gradients
   use ek_gradient_definition, only: windows_t
   use ek_report_names, only: contents_file, gradients_file, numbers_file, deck_file, is_table_of_report, &
      definitions_folder, definitions_file
   use ek_deck_file, only: deck_record_t, read_deck_file, facts_of_table
   implicit none(type, external)
   private
   public :: results_t, read_results, read_test, contents_csv, test_line, name_files, table_file, envelope_file, &
      test_number

   character(*), parameter :: mark = 'test ', size_mark = 'factor size ', anti_mark = '(anti phase)'

   !> Results to be compared: a report folder or one table.
   type :: results_t
      character(:), allocatable :: path, label
      logical :: is_report = .false.         !! a report folder; otherwise one table
      type(test_result_t), allocatable :: tests(:)
      type(gradient_t), allocatable :: gradients(:)
      type(gradient_t), allocatable :: numbers(:)        !! key numbers: test = group, column = name, window = condition
      type(deck_record_t) :: deck            !! deck of the report, as far as it is known
      character(10) :: program = ''          !! other program whose definitions the tables have; '': elastokin
   end type results_t

contains

   !> Sets the file names of each test: its table, and the envelope of its wheels.
   pure subroutine name_files(tests)
      type(test_result_t), intent(inout) :: tests(:)
      integer :: k

      do k = 1, size(tests)
         tests(k)%file = table_file(tests(k)%name)
      end do
      do k = 1, size(tests)
         tests(k)%envelope = envelope_file(tests, k)
      end do
   end subroutine name_files

   !> The header line of a table that describes its test.
   pure function test_line(kind, is_anti, factor_size) result(line)
      character(*), intent(in) :: kind
      logical, intent(in) :: is_anti
      real(wp), intent(in) :: factor_size
      character(:), allocatable :: line
      character(24) :: number

      write (number, '(es23.15)') factor_size
      line = mark//kind//', '
      if (is_anti) line = line//'opposed '//anti_mark//', '
      line = line//size_mark//trim(adjustl(number))
   end function test_line

   !> The file name of a test's table: name.csv or, if a report has another table of this name, name-case.csv. Case names have
   !> no hyphen, so the latter is not the table of another test.
   pure function table_file(name) result(file)
      character(*), intent(in) :: name
      character(:), allocatable :: file

      file = name//'.csv'
      if (is_table_of_report(lower(file))) file = name//'-case.csv'
   end function table_file

   !> The file name of the wheel envelope of a test: name_envelope.csv or, if the table of a test has this name,
   !> name-envelope.csv.
   pure function envelope_file(tests, k) result(file)
      type(test_result_t), intent(in) :: tests(:)      !! with their files
      integer, intent(in) :: k
      character(:), allocatable :: file
      integer :: j

      file = tests(k)%name//'_envelope.csv'
      do j = 1, size(tests)
         if (lower(tests(j)%file) == lower(file)) file = tests(k)%name//'-envelope.csv'
      end do
   end function envelope_file

   !> tests.csv: the tests of a report that were run, and the files of their tables.
   pure function contents_csv(tests) result(text)
      type(test_result_t), intent(in) :: tests(:)
      character(:), allocatable :: text
      type(frame_t) :: frame
      integer :: k

      frame = new_frame('test,kind,title,file')
      do k = 1, size(tests)
         if (.not. tests(k)%is_run) cycle
         call frame%put(tests(k)%name)
         call frame%put(tests(k)%kind)
         call frame%put(tests(k)%title)
         call frame%put(tests(k)%file)
      end do
      text = frame%csv()
   end function contents_csv

   !> Reads a report folder, or one CSV file. The gradients of a CSV file are computed. All files listed in the contents of a folder
   !> must be in the folder itself.
   subroutine read_results(path, windows, results, error, program)
      character(*), intent(in) :: path
      type(windows_t), intent(in) :: windows
      type(results_t), intent(out) :: results
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      character(*), intent(in), optional :: program        !! other program, in whose definitions a report is read
      type(text_table_t) :: contents
      integer :: k

      results%path = path
      results%is_report = folder_exists(path)
      results%label = label_of(path, results%is_report)
      allocate (results%numbers(0))
      if (.not. results%is_report) then
         allocate (results%tests(1))
         call read_test(path, 'results', results%tests(1), error, may_stream=.true.)
         if (allocated(error)) return
         results%program = program_of(results%tests(1)%table)
         results%tests(1)%table%is_of_rows = .true.         ! the states of a table cannot be chosen
         call test_gradients(results%tests(1), windows, results%gradients)
         call facts_of_table(results%tests(1)%table, results%deck)
         return
      end if
      if (.not. file_exists(join_path(path, contents_file))) then
         call fail(error, exit_file, quoted(path)//' is not a report folder: it has no '//contents_file)
         return
      end if
      call read_text_table(join_path(path, contents_file), contents, error)
      if (allocated(error)) return
      if (present(program)) results%program = program
      if (results%program /= '') then
         call read_defined_report(path, contents, results, error)
         return
      end if
      allocate (results%tests(contents%rows))
      do k = 1, contents%rows
         if (.not. (is_file_name(cell_of(contents, k, 'file')) .and. is_file_name(cell_of(contents, k, 'test')))) then
            call fail(error, exit_file, contents%file//':'//str(contents%lines(k))//': '// &
               quoted(cell_of(contents, k, 'file'))//' or '//quoted(cell_of(contents, k, 'test'))// &
               ' is not a plain file name')
            return
         end if
         call read_test(join_path(path, cell_of(contents, k, 'file')), cell_of(contents, k, 'test'), results%tests(k), error)
         if (allocated(error)) return
         results%tests(k)%title = cell_of(contents, k, 'title')
      end do
      call read_gradients(join_path(path, gradients_file), results%gradients, error)
      if (.not. allocated(error)) call read_numbers(join_path(path, numbers_file), results%numbers, error)
      if (.not. allocated(error)) call read_deck_file(join_path(path, deck_file), results%deck, error)
      if (allocated(error) .or. size(results%tests) == 0) return
      call facts_of_table(results%tests(1)%table, results%deck)
   end subroutine read_results

   !> Reads key_numbers.csv. The list is empty if the file does not exist, as in folders of early versions.
   subroutine read_numbers(path, numbers, error)
      character(*), intent(in) :: path
      type(gradient_t), allocatable, intent(out) :: numbers(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      type(text_table_t) :: table
      integer :: k

      allocate (numbers(0))
      if (.not. file_exists(path)) return
      call read_text_table(path, table, error)
      if (allocated(error)) return
      deallocate (numbers)
      allocate (numbers(table%rows))
      do k = 1, table%rows
         associate (n => numbers(k))
            n%test = cell_of(table, k, 'group')
            n%quantity = cell_of(table, k, 'quantity')
            n%side = cell_of(table, k, 'side')
            n%unit = cell_of(table, k, 'unit')
            n%window = cell_of(table, k, 'condition')
            n%column = cell_of(table, k, 'name')
            call take_value(path, table, k, n%value, error)
            if (allocated(error)) return
         end associate
      end do
   end subroutine read_numbers

   !> Index of the test of a given name in a result; 0 if the result has no such test.
   pure integer function test_number(results, name) result(number)
      type(results_t), intent(in) :: results
      character(*), intent(in) :: name

      do number = size(results%tests), 1, -1
         if (results%tests(number)%name == name) return
      end do
   end function test_number

   !> Whether a name is a plain file name: not empty, without a folder, not hidden, not a command option, and without control
   !> characters.
   pure logical function is_file_name(name)
      character(*), intent(in) :: name
      is_file_name = len_trim(name) > 0 .and. scan(name, '/') == 0 .and. index(name, '.') /= 1 .and. index(name, '-') /= 1 &
         .and. one_line(name) == name
   end function is_file_name

   !> Reads a table and, from its header, the description of its test. A test without a description has the kind
   !> 'parallel_travel' if its abscissa is the wheel travel, otherwise 'other'.
   subroutine read_test(path, name, test, error, may_stream)
      character(*), intent(in) :: path, name
      type(test_result_t), intent(out) :: test
      type(error_t), allocatable, intent(out) :: error
      logical, intent(in), optional :: may_stream          !! see read_whole
      character(:), allocatable :: line
      logical :: is_number
      integer :: k, at, side

      test%name = name
      test%title = base_name(path)
      test%file = path
      test%kind = 'other'
      side = -1
      call read_csv(path, test%table, error, may_stream)
      if (allocated(error)) return
      do k = 1, test%table%header%count()
         line = test%table%header%line(k)
         call read_frame_line(line, test%is_iso, side)
         if (index(line, mark) /= 1 .or. index(line, size_mark) == 0) cycle
         at = index(line, ',')
         test%kind = line(len(mark) + 1:at - 1)
         test%is_anti = index(line, anti_mark(2:11)) > 0         ! earlier versions wrote no brackets
         call get_decimal(line(index(line, size_mark) + len(size_mark):), test%factor_size, is_number)
         if (is_number) is_number = ieee_is_finite(test%factor_size)
         if (.not. is_number) test%factor_size = 1.0_wp
      end do
      call find_wheels(test, side)
      if (program_of(test%table) /= '') call take_swept_value(test)
      call choose_abscissa(test)
      ! a table of `run` does not state its kind: with the travel as abscissa it is treated as parallel travel
      if (test%kind == 'other' .and. test%abscissa /= 'factor') test%kind = 'parallel_travel'
      call suit_table(test)
   end subroutine read_test

   !> Makes the swept value the abscissa of a table in the definitions of another program, which does not have the columns of
   !> elastokin. The header gives its label and the kind of the test: 'factor: wheel travel [mm], test parallel_travel'.
   pure subroutine take_swept_value(test)
      type(test_result_t), intent(inout) :: test
      character(*), parameter :: factor_mark = 'factor: ', test_mark = ', test '
      character(:), allocatable :: line
      integer :: k, at

      test%abscissa = 'factor'
      test%label = 'factor'
      do k = 1, test%table%header%count()
         line = test%table%header%line(k)
         if (index(line, factor_mark) /= 1) cycle
         line = line(len(factor_mark) + 1:)
         at = index(line//test_mark, test_mark)
         test%label = line(:at - 1)
         if (at <= len(line)) test%kind = line(at + len(test_mark):)
      end do
   end subroutine take_swept_value

   !> Reads the tables and the numbers at design of a report that was written with --definitions.
   subroutine read_defined_report(path, contents, results, error)
      character(*), intent(in) :: path
      type(text_table_t), intent(in) :: contents           !! tests.csv
      type(results_t), intent(inout) :: results            !! its `program` is known
      type(error_t), allocatable, intent(out) :: error     !! exit_file
      type(test_result_t) :: test
      character(:), allocatable :: file
      integer :: k

      allocate (results%tests(0), results%gradients(0))
      do k = 1, contents%rows
         file = cell_of(contents, k, 'file')
         if (.not. (is_file_name(file) .and. is_file_name(cell_of(contents, k, 'test')))) cycle
         file = join_path(path, definitions_folder//'/'//file)
         if (.not. file_exists(file)) cycle
         call read_test(file, cell_of(contents, k, 'test'), test, error)
         if (allocated(error)) return
         if (program_of(test%table) /= results%program) exit
         test%title = cell_of(contents, k, 'title')
         results%tests = [results%tests, test]
      end do
      if (size(results%tests) == 0) then
         call fail(error, exit_file, quoted(path)//' has no tables in the definitions of '//title_of(trim(results%program))// &
            ': write the report with --definitions '//trim(results%program))
         return
      end if
      call read_defined_numbers(join_path(path, definitions_file), results%numbers, error)
      if (.not. allocated(error)) call read_deck_file(join_path(path, deck_file), results%deck, error)
      if (.not. allocated(error)) call facts_of_table(results%tests(1)%table, results%deck)
   end subroutine read_defined_report

   !> Reads definitions.csv as key numbers: the printed quantities at design.
   subroutine read_defined_numbers(path, numbers, error)
      character(*), intent(in) :: path
      type(gradient_t), allocatable, intent(out) :: numbers(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      type(text_table_t) :: table
      integer :: k, used

      allocate (numbers(0))
      if (.not. file_exists(path)) return
      call read_text_table(path, table, error)
      if (allocated(error)) return
      deallocate (numbers)
      allocate (numbers(table%rows))
      used = 0
      do k = 1, table%rows
         if (cell_of(table, k, 'value') == '') cycle        ! not printed
         used = used + 1
         associate (n => numbers(used))
            n%test = 'At design'
            n%quantity = cell_of(table, k, 'name')
            n%side = cell_of(table, k, 'of')
            n%unit = cell_of(table, k, 'unit')
            n%window = 'at design'
            n%column = trim(adjustl(n%side//' '//n%quantity))
            call take_value(path, table, k, n%value, error)
            if (allocated(error)) return
         end associate
      end do
      numbers = numbers(:used)
   end subroutine read_defined_numbers

   !> Reads the number in the column `value` of a row.
   subroutine take_value(path, table, k, value, error)
      character(*), intent(in) :: path
      type(text_table_t), intent(in) :: table
      integer, intent(in) :: k                       !! index of the row
      real(wp), intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error      !! exit_file: the value is not a number
      logical :: is_number

      call get_decimal(cell_of(table, k, 'value'), value, is_number)
      if (.not. is_number) call fail(error, exit_file, path//':'//str(table%lines(k))//': '// &
         quoted(cell_of(table, k, 'value'))//' is not a number')
   end subroutine take_value

   !> Completes a table of another program or a part of a table: without a column of wheel travel, the prefixes left_ and right_ give
   !> the wheels; without the abscissa of its test, the first column is the abscissa if it rises or falls from row to row.
   pure subroutine suit_table(test)
      type(test_result_t), intent(inout) :: test
      character(6), parameter :: sides(2) = [character(6) :: 'left_', 'right_']
      integer :: k, n

      if (size(test%table%columns) == 0) return
      do k = 1, merge(2, 0, size(test%sides) == 0)
         if (.not. any(index(test%table%columns, trim(sides(k))) == 1)) cycle
         test%prefixes = [character(name_length) :: test%prefixes, sides(k)]
         test%sides = [test%sides, 3 - 2*k]
      end do
      if (any(test%table%columns == test%abscissa) .or. size(test%table%values, 2) < 2) return
      if (any([(any(test%table%columns == trim(test%prefixes(k))//test%abscissa), k=1, size(test%prefixes))])) return
      n = size(test%table%values, 2)
      associate (x => test%table%values(1, :))
         if (.not. all(ieee_is_finite(x))) return
         if (.not. (all(x(2:) > x(:n - 1)) .or. all(x(2:) < x(:n - 1)))) return
      end associate
      test%abscissa = trim(test%table%columns(1))
      test%label = test%abscissa
   end subroutine suit_table

   !> The label of a result in the legend: the last part of its path, of a file without its extension.
   pure function label_of(path, is_folder) result(label)
      character(*), intent(in) :: path
      logical, intent(in) :: is_folder
      character(:), allocatable :: label

      label = path(:min(len(path), max(1, verify(path, '/', back=.true.))))
      if (is_folder) label = label(index(label(:len(label) - 1), '/', back=.true.) + 1:)
      if (.not. is_folder) label = base_name(label)
   end function label_of

end module ek_report_files
