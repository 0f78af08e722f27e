!> A free table of loads: a CSV file of which every row is one state.
!>
!> | column (two wheels: left_…, right_…)  | what it is                                               |
!> |---------------------------------------|----------------------------------------------------------|
!> | fx_n, fy_n, fz_n                      | force at the contact patch, frame of the deck            |
!> | mx_nm, my_nm, mz_nm                   | moment on the wheel                                      |
!> | centre_fx_n, centre_fy_n, centre_fz_n | force at the wheel centre                                |
!> | travel_mm                             | height of the wheel centre above design, held            |
!> | <driver>_mm, <driver>_deg             | change of what a driver joint prescribes                 |
!>
!> Loads and heights are in addition to the constant loads of the deck; what has no column stays.
module ek_load_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck
   use ek_text, only: str, quoted, nearest_name
   use ek_units, only: degree, millimetre
   use ek_case, only: case_t, append_course, follows_table
   use ek_measure, only: rotation
   use ek_state, only: most_driven
   use ek_suspension, only: suspension_t, load_t, driver_row
   use ek_builder, only: add_height_driver, add_load
   use ek_table, only: table_t, name_length, row_count, column_index
   use ek_csv, only: read_csv
   use ek_wheel_side, only: prefix_of, height_name
   implicit none(type, external)
   private
   public :: mount_table

   character(*), parameter :: load_columns(9) = [character(11) :: 'fx_n', 'fy_n', 'fz_n', 'mx_nm', 'my_nm', 'mz_nm', &
      'centre_fx_n', 'centre_fy_n', 'centre_fz_n']

   real(wp), parameter :: most = 1.0e31_wp      !! as in a deck: larger numbers are slips, and could overflow later

contains

   !> Adds the loads and drivers of the table's columns, and makes its rows the path of the case.
   subroutine mount_table(suspension, case, wheels, error)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: case
      integer, intent(in) :: wheels(2)      !! left, right; 0: none
      type(error_t), allocatable, intent(out) :: error   !! exit_file: not readable; exit_deck: a column without meaning
      type(table_t) :: table
      integer :: k

      call read_csv(case%file, table, error)
      if (allocated(error)) return
      if (row_count(table) == 0) call fail(error, exit_deck, case%file//': the table has no rows')
      if (size(table%columns) > most_driven) call fail(error, exit_deck, case%file//': at most '//str(most_driven)// &
         ' columns, found '//str(size(table%columns)))
      if (allocated(error)) return
      do k = 1, size(table%columns)
         if (column_index(table, trim(table%columns(k))) /= k) then
            call fail(error, exit_deck, case%file//': the column '//quoted(table%columns(k))//' is there twice')
            return
         end if
         if (.not. all(ieee_is_finite(table%values(k, :)))) then
            call fail(error, exit_deck, case%file//': column '//quoted(table%columns(k))//' holds a value that is not a number')
            return
         end if
         if (any(abs(table%values(k, :)) >= most)) then
            call fail(error, exit_deck, case%file//': column '//quoted(table%columns(k))//' holds '// &
               str(table%values(k, maxloc(abs(table%values(k, :)), dim=1)))//'; a number must be below '//str(most))
            return
         end if
         call take_column(trim(table%columns(k)), table%values(k, :))
         if (allocated(error)) return
      end do
      case%from = 1.0_wp
      case%to = row_count(table)
      case%increments = row_count(table) - 1
      if (row_count(table) == 1) then      ! from the design state, which comes out too
         case%from = 0.0_wp
         case%increments = 1
      end if

   contains

      subroutine take_column(name, values)
         character(*), intent(in) :: name
         real(wp), intent(in) :: values(:)
         character(:), allocatable :: prefix, stem
         integer :: side, c, row
         logical :: is_angle

         if (name == 'state' .or. name == 'factor') return
         do side = 1, 2
            if (wheels(side) == 0) cycle
            prefix = prefix_of(suspension, wheels(side))
            if (index(name, prefix) /= 1) cycle
            stem = name(len(prefix) + 1:)
            if (stem == 'travel_mm') then
               if (driver_row(suspension, height_name(side)) == 0) call add_height_driver(suspension, height_name(side), &
                  case%where, wheels(side:side), [1.0_wp], .false.)
               call append_course(case%courses, '', height_name(side), 1.0_wp, follows_table, values*millimetre)
               return
            end if
            do c = 1, size(load_columns)
               if (load_columns(c) /= stem) cycle
               call add_unit_load(name, wheels(side), c, values)
               return
            end do
         end do
         c = index(name, '_', back=.true.)
         if (c > 1) then
            row = driver_row(suspension, name(:c - 1))
            if (row > 0) then
               is_angle = suspension%terms(suspension%rows(row)%first)%measure%kind == rotation
               if (name(c:) == trim(merge('_deg', '_mm ', is_angle))) then
                  call append_course(case%courses, '', name(:c - 1), 1.0_wp, follows_table, &
                     values*merge(degree, millimetre, is_angle))
                  return
               end if
            end if
         end if
         call fail(error, exit_deck, case%file//': there is no use for the column '//quoted(name)//advice(name))
      end subroutine take_column

      !> A unit force or moment along an axis of the deck, scaled by a column.
      subroutine add_unit_load(name, wheel, c, values)
         character(*), intent(in) :: name
         integer, intent(in) :: wheel, c      !! c: place in load_columns
         real(wp), intent(in) :: values(:)
         type(load_t) :: load
         integer :: axis
         real(wp) :: unit

         axis = mod(c - 1, 3) + 1
         unit = 1.0_wp
         if (suspension%is_iso .and. axis < 3) unit = -1.0_wp
         load%name = 'rig_'//name
         load%where = case%where
         load%body = suspension%wheels(wheel)%body
         load%arm = suspension%wheels(wheel)%contact
         if (c > 6) load%arm = suspension%wheels(wheel)%centre
         if (c >= 4 .and. c <= 6) then
            load%moment(axis) = unit
         else
            load%force(axis) = unit
         end if
         load%is_case = .true.
         call add_load(suspension, load)
         call append_course(case%courses, load%name, '', 1.0_wp, follows_table, values)
      end subroutine add_unit_load

      !> The columns there might be.
      function advice(name) result(words)
         character(*), intent(in) :: name
         character(:), allocatable :: words
         character(name_length) :: known(2*size(load_columns) + 2)
         integer :: side, c, used

         known = ''
         used = 0
         do side = 1, 2
            if (wheels(side) == 0) cycle
            do c = 1, size(load_columns)
               used = used + 1
               known(used) = prefix_of(suspension, wheels(side))//load_columns(c)
            end do
            used = used + 1
            known(used) = prefix_of(suspension, wheels(side))//'travel_mm'
         end do
         words = nearest_name(name, known)
         if (words /= '') then
            words = ' (did you mean '//quoted(words)//'?)'
         else
            words = ' (known: '//trim(known(1))//' … '//trim(known(used))//', <driver>_mm, <driver>_deg)'
         end if
      end function advice

   end subroutine mount_table

end module ek_load_table
