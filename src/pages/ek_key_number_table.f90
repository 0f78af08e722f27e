!> key_numbers.csv and key_numbers.json: the key numbers of a report for programs, one row per name.
module ek_key_number_table
   use ek_kinds, only: wp
   use ek_decimal, only: decimal
   use ek_json, only: json_t, json_string, json_number
   use ek_table, only: name_length
   use ek_text_table, only: text_table_t, new_text_table, add_row, text_table_csv
   use ek_key_number, only: key_number_t
   use ek_key_numbers, only: number_heads
   implicit none(type, external)
   private
   public :: key_numbers_csv, key_numbers_json

   character(*), parameter :: columns(8) = [character(10) :: 'name', 'value', 'unit', 'side', 'group', 'quantity', 'condition', &
      'definition']
   character(*), parameter :: sides(2) = [character(5) :: 'left', 'right']

contains

   !> The key numbers as CSV, one line per name; `nan` for a missing value.
   function key_numbers_csv(numbers, is_pair) result(text)
      type(key_number_t), intent(in) :: numbers(:)
      logical, intent(in) :: is_pair
      character(:), allocatable :: text
      character(name_length) :: heads(2)
      type(text_table_t) :: table
      integer :: k, wheel

      table = new_text_table(columns)
      do k = 1, size(numbers)
         call number_heads(numbers(k), is_pair, heads)
         do wheel = 1, 2
            if (heads(wheel) == '') cycle
            call add_row(table)
            associate (row => table%rows, n => numbers(k))
               table%cells(1, row)%text = trim(heads(wheel))
               table%cells(2, row)%text = decimal(value_of(n, wheel))
               table%cells(3, row)%text = n%unit
               table%cells(4, row)%text = side_of(n, is_pair, wheel)
               table%cells(5, row)%text = n%group
               table%cells(6, row)%text = n%quantity
               table%cells(7, row)%text = n%condition
               table%cells(8, row)%text = n%definition
            end associate
         end do
      end do
      text = text_table_csv(table)
   end function key_numbers_csv

   !> The key numbers as JSON: { "model", "checksum", "key_numbers": [ { … } ] }.
   function key_numbers_json(numbers, is_pair, model, checksum) result(text)
      type(key_number_t), intent(in) :: numbers(:)
      logical, intent(in) :: is_pair
      character(*), intent(in) :: model, checksum
      character(:), allocatable :: text
      character(name_length) :: heads(2)
      type(json_t) :: json
      integer :: k, wheel

      call json%open('{')
      call json%item('model', json_string(model))
      call json%item('checksum', json_string(checksum))
      call json%open('[', 'key_numbers')
      do k = 1, size(numbers)
         call number_heads(numbers(k), is_pair, heads)
         do wheel = 1, 2
            if (heads(wheel) == '') cycle
            associate (n => numbers(k))
               call json%open('{')
               call json%item('name', json_string(trim(heads(wheel))))
               call json%item('value', json_number(value_of(n, wheel)))
               call json%item('unit', json_string(n%unit))
               call json%item('side', json_string(side_of(n, is_pair, wheel)))
               call json%item('group', json_string(n%group))
               call json%item('quantity', json_string(n%quantity))
               call json%item('condition', json_string(n%condition))
               call json%item('definition', json_string(n%definition))
               call json%close('}')
            end associate
         end do
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function key_numbers_json

   pure real(wp) function value_of(number, wheel) result(value)
      type(key_number_t), intent(in) :: number
      integer, intent(in) :: wheel
      value = merge(number%left, number%right, wheel == 1)
   end function value_of

   !> Side of a key number: 'left', 'right', or '' for the axle and for a single wheel.
   function side_of(number, is_pair, wheel) result(side)
      type(key_number_t), intent(in) :: number
      logical, intent(in) :: is_pair
      integer, intent(in) :: wheel
      character(:), allocatable :: side

      side = ''
      if (is_pair .and. .not. number%is_of_axle) side = trim(sides(wheel))
   end function side_of

end module ek_key_number_table
