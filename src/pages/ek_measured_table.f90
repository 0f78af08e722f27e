!> The section of a report's page with the deviations of measured curves from the curves of the model.
module ek_measured_table
   use ek_kinds, only: wp
   use ek_text, only: str
   use ek_page, only: page_t, begin_section, begin_table, end_table, add_cell, add_text, page_number
   use ek_measurement, only: measurement_t
   implicit none(type, external)
   private
   public :: add_measured_table

contains

   !> Adds the section with a row for each measured curve.
   subroutine add_measured_table(page, measurements)
      type(page_t), intent(inout) :: page
      type(measurement_t), intent(in) :: measurements(:)
      integer :: k, l

      call begin_section(page, 'measured', 'Measured curves', is_printed=.true.)
      call add_text(page, 'p', 'Points of the charts are measured. The model is solved at each measured swept value: rms is '// &
         'the root of the mean square of measured minus computed. Slopes are those of least-squares lines in the window around '// &
         'design, per unit of the swept value. Loop: the curve on its way down minus the curve on its way up, at design.')
      call begin_table(page, [character(18) :: 'Test', 'Column', 'Unit', '>Points', '>rms', '>Largest', '>Slope, measured', &
         '>Slope, computed', '>Loop'])
      do k = 1, size(measurements)
         do l = 1, size(measurements(k)%channels)
            associate (channel => measurements(k)%channels(l))
               call add_cell(page, measurements(k)%test)
               call add_cell(page, trim(channel%column))
               call add_cell(page, trim(channel%unit))
               call add_cell(page, str(channel%points))
               call add_cell(page, page_number(channel%rms))
               call add_cell(page, page_number(channel%largest))
               call add_cell(page, short(channel%slope))
               call add_cell(page, short(channel%model_slope))
               call add_cell(page, page_number(channel%loop))
            end associate
         end do
      end do
      call end_table(page)
   end subroutine add_measured_table

   !> A slope with four digits; slopes per millimetre or newton are small numbers. A dash if there is none.
   function short(slope) result(text)
      real(wp), intent(in) :: slope
      character(:), allocatable :: text

      text = page_number(slope)
      if (.not. abs(slope) < 1.0_wp) return
      text = str(abs(slope), 4)
      if (slope < 0.0_wp) text = '−'//text
   end function short

end module ek_measured_table
