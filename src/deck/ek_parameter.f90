!> The parameters: every number of a deck, by its path as `--set` writes it.
!>
!> x(k) is the value of parameter k [SI, axes of the deck]. On a mirrored axle the two parameters of a number of the half deck have
!> one path without the side, and the one on the right takes `sign` × the value.
module ek_parameter
   use ek_kinds, only: wp
   use ek_text, only: str, is_like
   use ek_twin, only: right_twin
   use ek_record, only: record_t, entry_index, element, own_name
   use ek_group, only: group_names, group_number, point_group, key_t, find_key, is_single
   use ek_setting, only: path_t
   use ek_mirror_role, only: sign_of_image
   implicit none(type, external)
   private
   public :: parameter_t, parameters_t, add_parameter, find_parameters, parameter_path

   !> One number of the deck.
   type :: parameter_t
      integer :: record = 0               !! number of its record in the mirrored deck
      character(14) :: key = ''
      integer :: at = 1                   !! subscript
      real(wp) :: unit = 1.0_wp           !! SI value of its unit in the deck
      logical :: is_given = .true.        !! .false.: the deck omits it, x has its default
      real(wp) :: sign = 1.0_wp           !! −1: on the right side, the opposite of the value on the left
      integer :: tied = 0                 !! the parameter of the left side with the same path; 0: none
   end type parameter_t

   !> All parameters with their values in the deck.
   type :: parameters_t
      integer :: used = 0
      type(parameter_t), allocatable :: list(:)     !! the first `used`
      real(wp), allocatable :: x(:)
   end type parameters_t

contains

   !> Adds a number of a record; its number is parameters%used.
   subroutine add_parameter(parameters, records, k, key, at, value, unit, is_given)
      type(parameters_t), intent(inout) :: parameters
      type(record_t), intent(in) :: records(:)
      integer, intent(in) :: k, at
      character(*), intent(in) :: key
      real(wp), intent(in) :: value                  !! SI
      real(wp), intent(in) :: unit
      logical, intent(in) :: is_given
      type(parameter_t), allocatable :: grown(:)
      real(wp), allocatable :: grown_x(:)
      integer :: n, j

      n = parameters%used
      if (.not. allocated(parameters%list)) allocate (parameters%list(64), parameters%x(64))
      if (n == size(parameters%x)) then
         allocate (grown(2*n), grown_x(2*n))
         grown(:n) = parameters%list
         grown_x(:n) = parameters%x
         call move_alloc(grown, parameters%list)
         call move_alloc(grown_x, parameters%x)
      end if
      n = n + 1
      parameters%used = n
      parameters%x(n) = value
      parameters%list(n) = parameter_t(k, key, at, unit, is_given)
      if (records(k)%twin /= right_twin) return
      parameters%list(n)%sign = sign_of_image(records(k), key, at)
      do j = n - 1, 1, -1         ! the left record precedes the right one
         if (parameters%list(j)%record /= k - 1) cycle
         if (parameters%list(j)%key /= key .or. parameters%list(j)%at /= at) cycle
         parameters%list(n)%tied = j
         return
      end do
   end subroutine add_parameter

   !> The parameters with a path, which may have * in place of names; none if the path is that of a text or of nothing.
   subroutine find_parameters(parameters, records, path, found)
      type(parameters_t), intent(in) :: parameters
      type(record_t), intent(in) :: records(:)
      type(path_t), intent(in) :: path
      integer, allocatable, intent(out) :: found(:)
      logical :: is_meant(parameters%used)
      integer :: k

      do k = 1, parameters%used
         associate (this => parameters%list(k))
            is_meant(k) = .false.
            if (records(this%record)%group /= group_names(path%group)) cycle
            if (this%key /= path%key) cycle
            if (path%has_subscript .and. this%at /= path%first) cycle
            is_meant(k) = is_single(path%group) .or. is_like(element(records(this%record), 'name', 1), path%name) .or. &
               is_like(own_name(records(this%record)), path%name)
         end associate
      end do
      found = pack([(k, k=1, parameters%used)], is_meant)
   end subroutine find_parameters

   !> 'point.tie_rod_inner.z', 'bushing.top_mount.kt(1)', 'axle.wheelbase'.
   function parameter_path(this, records) result(path)
      type(parameter_t), intent(in) :: this
      type(record_t), intent(in) :: records(:)
      character(:), allocatable :: path
      character(*), parameter :: axes = 'xyz'
      type(key_t) :: key
      logical :: is_known

      associate (record => records(this%record))
         path = record%group//'.'
         if (element(record, 'name', 1) /= '') path = path//element(record, 'name', 1)//'.'
         if (record%group == group_names(point_group)) then
            path = path//axes(this%at:this%at)
            return
         end if
         path = path//trim(this%key)
         call find_key(group_number(record%group), trim(this%key), key, is_known)
         if (is_known .and. key%most > 1) path = path//'('//str(this%at)//')'
      end associate
   end function parameter_path

end module ek_parameter
