!> Gradients as files: gradients.csv and gradients.json, each value with its window, unit and sign convention.
module ek_gradient_file
   use ek_error, only: error_t, fail, exit_file
   use ek_text, only: str, quoted
   use ek_decimal, only: decimal, get_decimal
   use ek_file, only: write_whole
   use ek_json, only: json_t, json_string, json_number, json_numbers
   use ek_text_table, only: text_table_t, new_text_table, add_row, text_table_csv, read_text_table, cell_of
   use ek_gradient, only: gradient_t
   implicit none(type, external)
   private
   public :: gradients_csv, gradients_json, write_gradients, read_gradients

   character(*), parameter :: columns(11) = [character(12) :: 'test', 'quantity', 'side', 'value', 'unit', 'window', &
      'points', 'sign', 'column', 'over', 'note']

contains

   !> Writes both files.
   subroutine write_gradients(gradients, model, checksum, csv_path, json_path, error)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: model, checksum, csv_path, json_path
      type(error_t), allocatable, intent(out) :: error

      call write_whole(csv_path, gradients_csv(gradients), error)
      if (allocated(error)) return
      call write_whole(json_path, gradients_json(gradients, model, checksum), error)
   end subroutine write_gradients

   !> One line per gradient; `nan` for a missing value.
   pure function gradients_csv(gradients) result(text)
      type(gradient_t), intent(in) :: gradients(:)
      character(:), allocatable :: text
      type(text_table_t) :: table
      integer :: k

      table = new_text_table(columns)
      do k = 1, size(gradients)
         call add_row(table)
         table%cells(1, k)%text = gradients(k)%test
         table%cells(2, k)%text = gradients(k)%quantity
         table%cells(3, k)%text = gradients(k)%side
         table%cells(4, k)%text = decimal(gradients(k)%value)
         table%cells(5, k)%text = gradients(k)%unit
         table%cells(6, k)%text = gradients(k)%window
         table%cells(7, k)%text = str(gradients(k)%points)
         table%cells(8, k)%text = gradients(k)%sign
         table%cells(9, k)%text = gradients(k)%column
         table%cells(10, k)%text = gradients(k)%over
         table%cells(11, k)%text = gradients(k)%note
      end do
      text = text_table_csv(table)
   end function gradients_csv

   !> { "model", "checksum", "gradients": [ { … } ] }
   pure function gradients_json(gradients, model, checksum) result(text)
      type(gradient_t), intent(in) :: gradients(:)
      character(*), intent(in) :: model, checksum
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: k

      call json%open('{')
      call json%item('model', json_string(model))
      call json%item('checksum', json_string(checksum))
      call json%open('[', 'gradients')
      do k = 1, size(gradients)
         associate (g => gradients(k))
            call json%open('{')
            call json%item('test', json_string(g%test))
            call json%item('quantity', json_string(g%quantity))
            call json%item('side', json_string(g%side))
            call json%item('value', json_number(g%value))
            call json%item('unit', json_string(g%unit))
            call json%item('sign', json_string(g%sign))
            call json%item('window', json_string(g%window))
            call json%item('window_limits', json_numbers([-g%window_half, g%window_half]))
            call json%item('points', str(g%points))
            call json%item('column', json_string(g%column))
            call json%item('over', json_string(g%over))
            if (len(g%note) > 0) call json%item('note', json_string(g%note))
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function gradients_json

   !> Reads gradients.csv.
   subroutine read_gradients(path, gradients, error)
      character(*), intent(in) :: path
      type(gradient_t), allocatable, intent(out) :: gradients(:)
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      type(text_table_t) :: table
      character(:), allocatable :: points
      logical :: is_number
      integer :: k, status

      call read_text_table(path, table, error)
      if (allocated(error)) return
      do k = 1, 6
         if (any(table%columns == columns(k))) cycle
         call fail(error, exit_file, path//': missing column '//quoted(columns(k)))
         return
      end do
      allocate (gradients(table%rows))
      do k = 1, table%rows
         associate (g => gradients(k))
            g%test = cell_of(table, k, 'test')
            g%quantity = cell_of(table, k, 'quantity')
            g%side = cell_of(table, k, 'side')
            g%unit = cell_of(table, k, 'unit')
            g%window = cell_of(table, k, 'window')
            g%sign = cell_of(table, k, 'sign')
            g%column = cell_of(table, k, 'column')
            g%over = cell_of(table, k, 'over')
            g%note = cell_of(table, k, 'note')
            call get_decimal(cell_of(table, k, 'value'), g%value, is_number)
            if (.not. is_number) then
               call fail(error, exit_file, path//':'//str(table%lines(k))//': '//quoted(cell_of(table, k, 'value'))// &
                  ' is not a number')
               return
            end if
            points = cell_of(table, k, 'points')
            read (points, *, iostat=status) g%points
            if (status /= 0) g%points = 0
         end associate
      end do
   end subroutine read_gradients

end module ek_gradient_file
