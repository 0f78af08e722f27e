!> Applies the target bands of a deck (&target_band) as limits to those responses of a study that equal key numbers.
module ek_response_bands
   use ek_kinds, only: wp
   use ek_study, only: response_t
   use ek_study_data, only: study_axis_t
   use ek_target_band, only: target_band_t
   use ek_key_numbers, only: number_name
   implicit none(type, external)
   private
   public :: set_bands, number_at_design

contains

   !> Sets the limits of the responses that have a band and no limits of their own. If a key number has several bands, the last band
   !> counts, as in a report.
   subroutine set_bands(targets, responses, axes)
      type(target_band_t), intent(in) :: targets(:)
      type(response_t), intent(in) :: responses(:)
      type(study_axis_t), intent(inout) :: axes(:)   !! axes of the responses
      character(:), allocatable :: name
      integer :: r, t

      do r = 1, size(axes)
         if (axes(r)%lower > -huge(1.0_wp) .or. axes(r)%upper < huge(1.0_wp)) cycle
         name = key_number_of(responses(r))
         if (name == '') cycle
         do t = 1, size(targets)
            if (targets(t)%quantity /= name) cycle
            axes(r)%is_target = .true.
            axes(r)%lower = targets(t)%low
            axes(r)%upper = targets(t)%high
         end do
      end do
   end subroutine set_bands

   !> Name of the key number that a response equals: a gradient with the window of the report, or a column at design. '' if the
   !> response does not equal a key number.
   pure function key_number_of(response) result(name)
      type(response_t), intent(in) :: response
      character(:), allocatable :: name

      name = ''
      if (response%of == 'gradient') then
         if (response%over == '' .and. .not. abs(response%window) > 0.0_wp) &
            name = trim(number_name(response%column, is_slope=.true.))
      else if (response%of == 'value' .and. .not. abs(response%at) > 0.0_wp) then
         name = number_at_design(response%column)
      end if
   end function key_number_of

   !> Name of the key number that equals a column at design: 'toe_deg' for 'left_toe_deg'. '' if there is none.
   pure function number_at_design(column) result(name)
      character(*), intent(in) :: column
      character(:), allocatable :: name
      integer :: first

      first = 1
      if (index(column, 'left_') == 1) first = 6
      if (index(column, 'right_') == 1) first = 7
      name = trim(number_name(column(first:), is_slope=.false.))
   end function number_at_design

end module ek_response_bands
