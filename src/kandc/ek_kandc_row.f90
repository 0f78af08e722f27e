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
   public :: kandc_t, put, put_known, choose, begin_block, end_block

   !> The columns of a model and the work space to fill them.
   type :: kandc_t
      integer :: used = 0                              !! number of columns
      character(name_length), allocatable :: names(:)
      real(wp), allocatable :: values(:)
      logical :: is_naming = .true.
      logical :: is_matrix_wanted = .true.             !! a column that is wanted needs the compliance matrix
      logical, allocatable :: is_of_matrix(:)          !! the value of this column comes from the compliance matrix
      integer :: blocks = 0                            !! columns are listed block by block: each wheel, the axle, …
      integer, allocatable :: last(:)                  !! last column of each block
      logical, allocatable :: is_passed_over(:)        !! of each block: none of its columns is wanted
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
         call put(self, name, value, .true.)
      else
         call put(self, name, ieee_value(1.0_wp, ieee_quiet_nan), .true.)
      end if
   end subroutine put_known

   !> The next column: its name in the first pass, its value afterwards.
   subroutine put(self, name, value, is_of_matrix)
      type(kandc_t), intent(inout) :: self
      character(*), intent(in) :: name
      real(wp), intent(in) :: value
      logical, intent(in), optional :: is_of_matrix    !! the value comes from the compliance matrix; default .false.
      character(name_length), allocatable :: more(:)
      logical, allocatable :: of_matrix(:)

      self%used = self%used + 1
      if (.not. self%is_naming) then
         self%values(self%used) = value
         return
      end if
      if (self%used > size(self%names)) then
         allocate (more(2*size(self%names)), of_matrix(2*size(self%names)))
         more(:self%used - 1) = self%names
         call move_alloc(more, self%names)
         of_matrix(:self%used - 1) = self%is_of_matrix
         call move_alloc(of_matrix, self%is_of_matrix)
      end if
      self%names(self%used) = name
      self%is_of_matrix(self%used) = .false.
      if (present(is_of_matrix)) self%is_of_matrix(self%used) = is_of_matrix
   end subroutine put

   !> Restricts the columns that later passes fill: blocks without a wanted column are passed over, and the matrix is solved
   !> only for a column that needs it.
   pure subroutine choose(self, is_wanted)
      type(kandc_t), intent(inout) :: self             !! after the first pass
      logical, intent(in) :: is_wanted(:)              !! of each column
      integer :: k, first

      self%is_matrix_wanted = any(is_wanted .and. self%is_of_matrix(:self%used))
      first = 1
      do k = 1, size(self%last)
         self%is_passed_over(k) = .not. any(is_wanted(first:self%last(k)))
         first = self%last(k) + 1
      end do
   end subroutine choose

   !> Begins the next block of columns; `is_passed_over`: its values are not wanted, and its columns are left out.
   pure subroutine begin_block(self, is_passed_over)
      type(kandc_t), intent(inout) :: self
      logical, intent(out) :: is_passed_over

      self%blocks = self%blocks + 1
      is_passed_over = .false.
      if (self%is_naming) return
      is_passed_over = self%is_passed_over(self%blocks)
      if (is_passed_over) self%used = self%last(self%blocks)
   end subroutine begin_block

   !> Ends a block.
   pure subroutine end_block(self)
      type(kandc_t), intent(inout) :: self

      if (.not. self%is_naming) return
      self%last = [self%last, self%used]
      self%is_passed_over = [self%is_passed_over, .false.]
   end subroutine end_block

end module ek_kandc_row
