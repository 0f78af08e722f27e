!> Measured curves of a test: a table of a rig laboratory, and the map from its headings to the columns of elastokin.
!>
!> The map is a namelist file with one `&channel` for each heading:
!>
!>     &channel heading = 'WhlZ_FL', quantity = 'factor', test = 'parallel_travel', scale = -1 /   ! swept value of this test
!>     &channel heading = 'Toe_FL',  quantity = 'left_toe_deg', unit = 'min', scale = 0.0166667 /
!>
!> A map serves all tests of a laboratory: headings that a table does not have are ignored.
module ek_rig_map
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_deck
   use ek_text, only: quoted, lower, did_you_mean
   use ek_quantity, only: name_length
   use ek_record, only: place_of, element
   use ek_group, only: group_number, map_groups, channel_group, group_names, record_head
   use ek_namelist, only: check_record
   use ek_deck, only: deck_t, read_deck
   use ek_deck_reading, only: deck_reading_t, complain, complain_of_all, where_of, text_of, number_of, switch_of, line_of
   use ek_sheet, only: sheet_t, read_sheet, column_of, mistakes_of
   use ek_sheet_columns, only: find_unit_row, take_columns, or_empty
   use ek_unit_row, only: unit_of_heading
   use ek_measurement, only: measurement_t
   implicit none(type, external)
   private
   public :: map_channel_t, read_map, find_channel, read_measurement, swept_value

   character(*), parameter :: swept_value = 'factor'      !! quantity of the channel with the swept value

   !> A channel of a laboratory: its heading, and its meaning.
   type :: map_channel_t
      character(name_length) :: heading = '', quantity = ''
      character(:), allocatable :: test           !! only in this test, by its name or its kind; '': in every test
      character(:), allocatable :: unit           !! unit of the channel, compared with a row of units; '': unit of the quantity
      real(wp) :: scale = 1.0_wp                  !! value of the quantity per value of the channel
      logical :: is_zeroed = .false.              !! the channel was set to zero at design
      character(:), allocatable :: where          !! 'file:line', for messages
   end type map_channel_t

contains

   !> Reads a map. All errors of the file are reported in one error.
   subroutine read_map(path, channels, error)
      character(*), intent(in) :: path
      type(map_channel_t), allocatable, intent(out) :: channels(:)
      type(error_t), allocatable, intent(out) :: error       !! exit_file, exit_deck
      type(deck_t) :: file
      type(deck_reading_t) :: reading
      integer :: k

      allocate (channels(0))
      call read_deck(path, file, error, is_study=.true.)
      if (allocated(error)) return
      reading%file = file%file
      reading%records = file%records(:file%used)
      reading%deck_errors = file%deck_errors
      allocate (reading%cards(file%used))
      do k = 1, file%used
         reading%k = k
         associate (card => reading%cards(k), record => reading%records(k))
            card%group = group_number(record%group)
            if (any(map_groups == card%group)) then
               call check_record(record, card%group, record_head(card%group, trim(element(record, 'heading', 1))), &
                  reading%deck_errors, card%is_good)
            else
               call reading%deck_errors%add(place_of(record, 0), 'there is no group &'//record%group// &
                  ' in a map of channels'//did_you_mean(record%group, group_names(map_groups)))
               card%group = 0
            end if
         end associate
         if (reading%cards(k)%group == channel_group) call take_channel(reading, channels)
      end do
      if (file%used == 0) call complain_of_all(reading, 'there is no &channel')
      if (reading%deck_errors%count() > 0) call fail(error, exit_deck, reading%deck_errors%text())
   end subroutine read_map

   !> Reads a &channel. A quantity has one channel in a test.
   subroutine take_channel(reading, channels)
      type(deck_reading_t), intent(inout) :: reading
      type(map_channel_t), allocatable, intent(inout) :: channels(:)
      type(map_channel_t) :: new
      integer :: k

      new%heading = text_of(reading, 'heading')
      new%quantity = text_of(reading, 'quantity')
      new%test = text_of(reading, 'test')
      new%unit = text_of(reading, 'unit')
      new%scale = number_of(reading, 'scale', 1.0_wp)
      new%is_zeroed = switch_of(reading, 'zeroed', .false.)
      new%where = where_of(reading)
      if (new%quantity == swept_value .and. new%is_zeroed) &
         call complain(reading, 'zeroed', 'the swept value counts from design in every test')
      do k = 1, size(channels)
         if (channels(k)%quantity /= new%quantity .or. channels(k)%test /= new%test) cycle
         call complain(reading, 'quantity', 'the quantity is given twice for the same test, first in '//line_of(reading, k))
         exit
      end do
      channels = [channels, new]
   end subroutine take_channel

   !> Index of the channel of a quantity in a test, first one given for this test alone; 0 if there is none.
   pure integer function find_channel(channels, quantity, test, kind) result(found)
      type(map_channel_t), intent(in) :: channels(:)
      character(*), intent(in) :: quantity, test, kind       !! name and kind of the test
      integer :: pass

      do pass = 1, 2
         do found = 1, size(channels)
            if (channels(found)%quantity /= quantity) cycle
            if (pass == 1 .and. is_of(channels(found), test, kind) .and. channels(found)%test /= '') return
            if (pass == 2 .and. channels(found)%test == '') return
         end do
      end do
      found = 0
   end function find_channel

   !> Whether a channel has its meaning in a test.
   pure logical function is_of(channel, test, kind)
      type(map_channel_t), intent(in) :: channel
      character(*), intent(in) :: test, kind
      is_of = channel%test == '' .or. lower(channel%test) == lower(test) .or. lower(channel%test) == lower(kind)
   end function is_of

   !> Reads the measured curves of a test. All errors of the table are reported in one error.
   subroutine read_measurement(path, test, kind, channels, measurement, error)
      character(*), intent(in) :: path
      character(*), intent(in) :: test, kind                 !! name and kind of the test
      type(map_channel_t), intent(in) :: channels(:)
      type(measurement_t), intent(out) :: measurement
      type(error_t), allocatable, intent(out) :: error       !! exit_file, exit_deck
      type(sheet_t) :: sheet
      type(message_list_t) :: mistakes
      integer, allocatable :: used(:)

      measurement%file = path
      measurement%test = test
      allocate (measurement%x(0), measurement%channels(0), used(0))
      call read_sheet(path, sheet, error)
      if (allocated(error)) return
      if (sheet%head_mistakes%count() == 0) call choose_channels(sheet, test, kind, channels, used)
      if (sheet%head_mistakes%count() == 0) call take_curves(sheet, channels, used, measurement)
      call mistakes_of(sheet, mistakes)
      if (mistakes%count() > 0) call fail(error, exit_deck, mistakes%text())
   end subroutine read_measurement

   !> Chooses the channels that a table has: the swept value first, then each quantity.
   subroutine choose_channels(sheet, test, kind, channels, used)
      type(sheet_t), intent(inout) :: sheet                  !! receives errors
      character(*), intent(in) :: test, kind
      type(map_channel_t), intent(in) :: channels(:)
      integer, allocatable, intent(out) :: used(:)
      integer :: k

      used = [find_channel(channels, swept_value, test, kind)]
      if (used(1) == 0) then
         call sheet%head_mistakes%add(sheet%file//': the map has no &channel with quantity = '//quoted(swept_value)// &
            ' for test '//quoted(test)//', so the heading of its swept value is not known')
         return
      else if (column_of(sheet, trim(channels(used(1))%heading)) == 0) then
         call sheet%head_mistakes%add(sheet%file//': there is no column '//quoted(trim(channels(used(1))%heading))// &
            ', the swept value of test '//quoted(test)//' ('//channels(used(1))%where//')'// &
            did_you_mean(trim(channels(used(1))%heading), sheet%heads))
         return
      end if
      do k = 1, size(channels)
         if (channels(k)%quantity == swept_value .or. column_of(sheet, trim(channels(k)%heading)) == 0) cycle
         if (find_channel(channels, trim(channels(k)%quantity), test, kind) == k) used = [used, k]
      end do
      if (size(used) == 1) call sheet%head_mistakes%add(sheet%file//': none of its columns is in the map for test '// &
         quoted(test)//did_you_mean('', sheet%heads))
   end subroutine choose_channels

   !> Reads the numbers of the chosen channels, in the units of the quantities. Rows without a swept value are errors; a quantity may
   !> be missing in a row.
   subroutine take_curves(sheet, channels, used, measurement)
      type(sheet_t), intent(inout) :: sheet
      type(map_channel_t), intent(in) :: channels(:)
      integer, intent(in) :: used(:)                         !! swept value, quantities
      type(measurement_t), intent(inout) :: measurement
      real(wp), allocatable :: swept(:, :), values(:, :)
      character(16) :: units(size(used))
      integer :: places(size(used)), k

      do k = 1, size(used)
         associate (channel => channels(used(k)))
            places(k) = column_of(sheet, trim(channel%heading))
            units(k) = channel%unit
            if (channel%unit == '' .and. abs(abs(channel%scale) - 1.0_wp) <= 0.0_wp) &
               units(k) = unit_of_heading(trim(channel%quantity))
         end associate
      end do
      call find_unit_row(sheet, places)
      call take_columns(sheet, places(:1), swept, units(:1))
      call take_columns(sheet, places(2:), values, units(2:), or_empty)
      if (sheet%row_mistakes%count() > 0) return
      measurement%x = swept(1, :)*channels(used(1))%scale
      deallocate (measurement%channels)
      allocate (measurement%channels(size(used) - 1))
      do k = 2, size(used)
         associate (channel => measurement%channels(k - 1), given => channels(used(k)))
            channel%column = given%quantity
            channel%heading = given%heading
            channel%unit = unit_of_heading(trim(given%quantity))
            channel%is_zeroed = given%is_zeroed
            channel%y = values(k - 1, :)*given%scale
         end associate
      end do
   end subroutine take_curves

end module ek_rig_map
