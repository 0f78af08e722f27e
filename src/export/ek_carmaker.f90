!> A map as a file of suspension kinematics and compliance for CarMaker (.skc): an "infofile" of keys and tables.
!>
!> The file has the frame of ek_wheel_motion. Units are SI, so all factors to SI are 1. Kinematics are of kind MapNL: a table for
!> the left and for the right wheel, over the wheel's own travel (Arg0) and over steer or the travel of the other wheel (Arg1,
!> which varies fastest). Compliance is of kind CoeffConstFr1: one row per load on the wheel and on the opposite wheel. The vertical
!> force does not have a row, because the springs carry it.
module ek_carmaker
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_letters, only: line_count
   use ek_buffer, only: buffer_t
   use ek_version, only: version
   use ek_gnuplot_text, only: one_line
   use ek_wheel_motion, only: at_tx, lengths, quantity_names
   use ek_monotonic, only: check_monotonic
   use ek_load_response, only: load_parts
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_steer, over_none
   implicit none(type, external)
   private
   public :: carmaker_text, skc_table_lines, load_names

   character(1), parameter :: sides(2) = ['L', 'R']
   integer, parameter :: columns = 10                     !! number of quantities in the tables, tx to lStabi
   character(5), parameter :: load_names(5) = [character(5) :: 'Frc.x', 'Frc.y', 'Trq.x', 'Trq.y', 'Trq.z']  !! keys of load_parts

contains

   !> Writes the .skc file of a map as a string.
   subroutine carmaker_text(map, is_front, checksum, text, error)
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_front
      character(*), intent(in) :: checksum                  !! of the deck
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error      !! exit_model: a column is not monotonic
      type(buffer_t) :: file
      real(wp), allocatable :: second(:)
      character(:), allocatable :: axle, kin
      integer :: side, i, j

      call check_monotonic(map, 'CarMaker', .true., error)
      if (allocated(error)) return
      axle = 'Susp'//merge('F', 'R', is_front)//'.'
      kin = axle//'Kin.0.'
      call second_argument(map, second)
      call file%line('#INFOFILE1 - Do not remove this line!')
      call file%line('FileIdent = CarMaker-SuspKnC-* 1')
      call file%line('FileCreator = elastokin '//version)
      call file%line('')
      call describe(map, checksum, file)
      call file%line('')
      call file%line(axle//'Kin.N = 1')
      call file%line(kin//'Kind = MapNL')
      call file%line(kin//'ValidSide = left+right')
      call file%line(kin//'InputSide = left+right')
      do side = 1, 2
         call file%line('')
         call file%line(kin//sides(side)//'.Arg = comp '//trim(merge('steer', 'comp ', map%kind == over_steer)))
         call add_numbers(file, kin//sides(side)//'.Arg0 =', map%travel)
         call file%line(kin//sides(side)//'.Arg0.Fac2SI = 1.0')
         call add_numbers(file, kin//sides(side)//'.Arg1 =', second)
         call file%line(kin//sides(side)//'.Arg1.Fac2SI = 1.0')
         call file%add(kin//sides(side)//'.Data.Name = %i0 %i1')
         do j = 1, columns
            call file%add(' '//trim(quantity_names(j)))
         end do
         call file%line('')
         call file%line(kin//sides(side)//'.Data.Fac2SI = 1 1'//repeat(' 1.0', columns))
         call file%line(kin//sides(side)//'.Data:')
         do i = 1, size(map%travel)
            if (i > 1) call file%line(achar(9)//'""')
            do j = 1, size(second)
               call add_numbers(file, achar(9)//str(i - 1)//' '//str(j - 1), &
                  map%value(at_tx:columns, min(j, size(map%value, 2)), i, side))
            end do
         end do
      end do
      call file%line('')
      call add_compliance(map, axle, file)
      text = file%text()
   end subroutine carmaker_text

   !> Number of lines of the file before the first row of the table of a side, for plots. The rows of a side are consecutive, with
   !> one line between blocks.
   pure integer function skc_table_lines(text, side) result(lines)
      character(*), intent(in) :: text
      integer, intent(in) :: side
      integer :: last

      last = index(text, '.'//sides(side)//'.Data:')
      lines = line_count(text(:last))
   end function skc_table_lines

   !> Finds the values of the second argument. At least two values are returned, even if no column depends on this argument.
   pure subroutine second_argument(map, second)
      type(kandc_map_t), intent(in) :: map
      real(wp), allocatable, intent(out) :: second(:)

      second = map%second
      if (map%kind == over_none) second = [map%travel(1), map%travel(size(map%travel))]
   end subroutine second_argument

   subroutine describe(map, checksum, file)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: checksum
      type(buffer_t), intent(inout) :: file
      integer :: side, j

      call file%line('Description:')
      call add('Suspension kinematics and compliance of '//one_line(map%title))
      call add('model '//map%model//', deck checksum '//checksum)
      call add('x forward, y to the left, z up; m, rad, N; relative to design, rotations with the static angles')
      select case (map%vertical)
      case ('road')
         call add('comp: height of the road under the tyre rate, positive up; forces of the ground act at the contact point')
      case ('patch')
         call add('comp: height of the contact point relative to the body, positive up; forces of the ground act there')
      case default
         call add('comp: height of the wheel centre relative to the body, positive up; forces act there')
      end select
      if (map%kind == over_steer) then
         call add('steer: travel of driver '//map%driver//' times '//str(map%driver_sign)// &
            ', positive: wheels to the left; both wheels at the same travel')
      end if
      if (map%kind == over_none) call add('one wheel without steering: the second argument has no effect')
      do side = 1, 2
         if (map%is_mirrored(side)) call add(trim(merge('left ', 'right', side == 1))// &
            ' side: mirror image of the other; the deck has one wheel, and no loads on the opposite wheel')
         call file%add(achar(9)//sides(side)//':')
         do j = 1, lengths
            call file%add(trim(merge(', ', '  ', j > 1))//' '//trim(quantity_names(6 + j))//' = '//trim(map%length_labels(j, side)))
         end do
         call file%line('')
      end do
      select case (map%held)
      case ('road')
         call add('compliance: loads at the wheel centre, the contact point held on the road by the tyre rate')
      case ('centre')
         call add('compliance: loads at the wheel centre, its height constant')
      case default
         call add('compliance: loads at the wheel centre, vertical load constant')
      end select

   contains

      subroutine add(line)
         character(*), intent(in) :: line
         call file%line(achar(9)//line)
      end subroutine add

   end subroutine describe

   subroutine add_compliance(map, axle, file)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: axle
      type(buffer_t), intent(inout) :: file
      character(:), allocatable :: key
      integer :: side, k

      call file%line(axle//'Com.N = 1')
      call file%line(axle//'Com.0.Kind = CoeffConstFr1')
      call file%line(axle//'Com.0.ValidSide = left+right')
      call file%line(axle//'Com.0.InputSide = left+right')
      do side = 1, 2
         key = axle//'Com.0.'//sides(side)//'.'
         call file%line('')
         call file%line(key//'Data.Name = tx ty tz rx ry rz')
         call file%line(key//'Frc.Fac2SI = 1.0 1.0 1.0 1.0 1.0 1.0')
         call file%line(key//'Trq.Fac2SI = 1.0 1.0 1.0 1.0 1.0 1.0')
         do k = 1, 5
            call add_numbers(file, key//load_names(k)//' =', map%compliance(:, load_parts(k), side))
         end do
         do k = 1, 5
            call add_numbers(file, key//load_names(k)(:3)//'Opp.'//load_names(k)(5:)//' =', &
               map%compliance(:, 6 + load_parts(k), side))
         end do
      end do
   end subroutine add_compliance

   !> Adds a line of numbers with nine digits each.
   subroutine add_numbers(file, key, values)
      type(buffer_t), intent(inout) :: file
      character(*), intent(in) :: key
      real(wp), intent(in) :: values(:)
      character(17) :: number
      integer :: k

      call file%add(key)
      do k = 1, size(values)
         write (number, '(es17.8e3)') values(k)
         call file%add(number)
      end do
      call file%line('')
   end subroutine add_numbers

end module ek_carmaker
