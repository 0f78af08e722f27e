!> key_numbers.csv and key_numbers.json: the key numbers of a report for programs, one row per name.
module ek_key_number_table
   use ek_json, only: json_t, json_string
   use ek_table, only: name_length
   use ek_frame, only: frame_t, new_frame
   use ek_key_number, only: key_number_t
   use ek_key_numbers, only: number_heads
   use ek_report_content, only: report_t
   use ek_verdict, only: add_assessment
   implicit none(type, external)
   private
   public :: key_numbers_csv, key_numbers_json

   character(*), parameter :: sides(2) = [character(5) :: 'left', 'right']

contains

   !> The key numbers as CSV, one line per name; `nan` for a missing value.
   function key_numbers_csv(numbers, is_pair) result(text)
      type(key_number_t), intent(in) :: numbers(:)
      logical, intent(in) :: is_pair                   !! the model has two wheels
      character(:), allocatable :: text
      type(frame_t) :: frame

      frame = frame_of(numbers, is_pair)
      text = frame%csv()
   end function key_numbers_csv

   !> The key numbers as JSON: { "model", "checksum", "assessment", "key_numbers": [ { … } ] }.
   function key_numbers_json(report, is_pair, model, checksum) result(text)
      type(report_t), intent(in) :: report
      logical, intent(in) :: is_pair
      character(*), intent(in) :: model, checksum
      character(:), allocatable :: text
      type(frame_t) :: frame
      type(json_t) :: json

      call json%open('{')
      call json%item('model', json_string(model))
      call json%item('checksum', json_string(checksum))
      if (allocated(report%start)) then
         if (report%start /= '') call json%item('start_state', json_string(report%start))
      end if
      call add_assessment(json, report)
      frame = frame_of(report%numbers, is_pair)
      call frame%add_json('key_numbers', json)
      call json%close('}')
      text = json%text()
   end function key_numbers_json

   !> One row per name.
   type(frame_t) function frame_of(numbers, is_pair) result(frame)
      type(key_number_t), intent(in) :: numbers(:)
      logical, intent(in) :: is_pair
      character(name_length) :: heads(2)
      integer :: k, wheel

      frame = new_frame('name,value,unit,side,group,quantity,condition,definition')
      do k = 1, size(numbers)
         call number_heads(numbers(k), is_pair, heads)
         do wheel = 1, 2
            if (heads(wheel) == '') cycle
            associate (n => numbers(k))
               call frame%put(trim(heads(wheel)))
               call frame%put(merge(n%left, n%right, wheel == 1))
               call frame%put(n%unit)
               call frame%put(side_of(n, is_pair, wheel))
               call frame%put(n%group)
               call frame%put(n%quantity)
               call frame%put(n%condition)
               call frame%put(n%definition)
            end associate
         end do
      end do
   end function frame_of

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
