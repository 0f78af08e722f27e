!> Checks that the columns of a map rise or fall everywhere. A simulator that inverts columns or uses them as an abscissa requires
!> such columns.
module ek_monotonic
   use ek_kinds, only: wp, millimetre
   use ek_error, only: error_t, message_list_t, fail, exit_model
   use ek_text, only: str
   use ek_wheel_side, only: side_name
   use ek_wheel_motion, only: at_tz, at_rz, at_lengths, length_names, quantity_names
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_steer, over_opposite
   implicit none(type, external)
   private
   public :: check_monotonic, check_steer

contains

   !> Checks tz and, on request, the four lengths of both sides over travel. A column that is not monotonic is reported with the
   !> first position at which it reverses.
   subroutine check_monotonic(map, target, has_lengths, error)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: target                    !! name of the export, for the message
      logical, intent(in) :: has_lengths                    !! the target inverts lengths too
      type(error_t), allocatable, intent(out) :: error      !! exit_model: every column that is not strictly monotonic
      integer, parameter :: columns(5) = [at_tz, at_lengths + 1, at_lengths + 2, at_lengths + 3, at_lengths + 4]
      type(message_list_t) :: mistakes
      integer :: side, c, i, j

      do side = 1, 2
         do c = 1, merge(size(columns), 1, has_lengths)
            search: do j = 1, size(map%second)
               associate (values => map%value(columns(c), j, :, side))
                  do i = 2, size(values) - 1
                     if ((values(i) - values(i - 1))*(values(i + 1) - values(i)) > 0.0_wp) cycle
                     ! not values(i - 1:i + 1): gfortran 12 passes a section of a strided associate name wrongly
                     call mistakes%add(message(side, c, i, j, map%value(columns(c), j, i - 1:i + 1, side)))
                     exit search
                  end do
               end associate
            end do search
         end do
      end do
      if (mistakes%count() > 0) call fail(error, exit_model, target// &
         ' needs columns that are strictly monotonic in wheel travel; nothing was written'//new_line('a')//mistakes%text())

   contains

      function message(side, c, i, j, three) result(text)
         integer, intent(in) :: side, c, i, j
         real(wp), intent(in) :: three(3)
         character(:), allocatable :: text

         text = trim(side_name(side))//' '//trim(quantity_names(columns(c)))
         if (c > 1) text = text//' ('//trim(map%length_labels(c - 1, side))//')'
         text = text//': '//str(three(1)/millimetre, 8)//', '//str(three(2)/millimetre, 8)//', '//str(three(3)/millimetre, 8)// &
            ' mm at travels of '//str(map%travel(i - 1)/millimetre)//', '//str(map%travel(i)/millimetre)//', '// &
            str(map%travel(i + 1)/millimetre)//' mm'
         if (map%kind == over_steer) text = text//', steer '//str(map%second(j)/millimetre)//' mm'
         if (map%kind == over_opposite) text = text//', other wheel at '//str(map%second(j)/millimetre)//' mm'
         text = text//'; use a shorter range (--travel)'
         if (c > 1) text = text//', or another element (--length '//trim(length_names(c - 1))//'=NAME)'
      end function message

   end subroutine check_monotonic

   !> Checks that the steer angle of both wheels rises with the travel of the rack at design height, because it is the abscissa of
   !> tables.
   subroutine check_steer(map, target, error)
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: target                    !! name of the export, for the message
      type(error_t), allocatable, intent(out) :: error      !! exit_model
      integer :: side, i, j

      if (map%kind /= over_steer) return
      i = minloc(abs(map%travel), dim=1)
      do side = 1, 2
         do j = 2, size(map%second)
            if (map%value(at_rz, j, i, side) > map%value(at_rz, j - 1, i, side)) cycle
            call fail(error, exit_model, target//' needs a steer angle that rises with the rack; nothing was written'// &
               new_line('a')//'the '//trim(side_name(side))//' wheel turns back between rack travels of '// &
               str(map%second(j - 1)/millimetre)//' and '//str(map%second(j)/millimetre)//' mm; use a shorter range (--steer)')
            return
         end do
      end do
   end subroutine check_steer

end module ek_monotonic
