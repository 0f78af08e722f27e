!> A row of K&C quantities: the first pass through the list of columns collects the names, every later one the values.
module ek_kandc_row
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use ek_kinds, only: wp
   use ek_vehicle, only: vehicle_t
   use ek_compliance, only: compliance_t
   use ek_geometry_columns, only: column_list_t
   use ek_table, only: name_length
   implicit none(type, external)
   private
   public :: kandc_t, put, put_known

   !> The columns of a model and the work space to fill them.
   type :: kandc_t
      integer :: used = 0                              !! number of columns
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      logical :: is_naming = .true.
      type(vehicle_t) :: vehicle
      type(compliance_t) :: compliance
      type(column_list_t) :: geometry
   end type kandc_t

contains

   !> A column from the compliance matrix: not a number if the matrix is unknown.
   subroutine put_known(self, name, value)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in) :: value

      if (self%compliance%is_known .or. self%is_naming) then
         call put(self, name, value)
      else
         call put(self, name, ieee_value(1.0_wp, ieee_quiet_nan))
      end if
   end subroutine put_known

   !> The next column: its name in the first pass, its value afterwards.
   subroutine put(self, name, value)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in) :: value
      character(name_length), allocatable :: more(:)

      self%used = self%used + 1
      if (.not. self%is_naming) then
         self%values(self%used) = value
         return
      end if
      if (self%used > size(self%names)) then
         allocate (more(2*size(self%names)))
         more(:self%used - 1) = self%names
         call move_alloc(more, self%names)
      end if
      self%names(self%used) = name
   end subroutine put

end module ek_kandc_row
