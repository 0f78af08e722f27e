!> A bushing of IPGKinematics (.gum): lines with a quoted label and numbers. Each axis (x is the axis of the bushing) has
!> displacements in mm, forces in N, damping, and a rotational stiffness in N m/rad. The last line gives whether the negative side
!> has separate numbers (1) or is the image of the positive side (0).
module ek_gum
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, lower
   use ek_flaws, only: flaws_t, shown
   use ek_fields, only: lines_t, field_t, split_fields, take_number
   use ek_law_points, only: law_points_t, add_point, finish_law
   implicit none(type, external)
   private
   public :: parse_gum, is_gum

   character(*), parameter :: axes = 'xyz'

   !> The content of a .gum file.
   type :: gum_t
      type(law_points_t) :: halves(2, 3)      !! (positive or negative side, axis); y is 0 until the forces are read
      integer :: force_line(2, 3) = 0
      real(wp) :: stiffness(3) = 0.0_wp       !! rotational stiffness about each axis [N m/rad]
      logical :: has_stiffness(3) = .false.
      integer :: axis = 0                     !! axis of the list that was read last; 0: none
      integer :: flag = -1                    !! 0: the negative side is the image of the positive side; 1: its numbers are separate
   end type gum_t

contains

   !> Whether a file is a bushing: a line that begins with a quote contains `displacement`.
   pure logical function is_gum(lines)
      type(lines_t), intent(in) :: lines
      integer :: k

      is_gum = .false.
      do k = 1, lines%count
         if (index(adjustl(lines%line(k)), '''') /= 1) cycle
         is_gum = index(lower(lines%line(k)), 'displacement') > 0
         if (is_gum) return
      end do
   end function is_gum

   !> Reads the laws of a bushing in [m, N] and [rad, N m].
   subroutine parse_gum(lines, laws, flaws)
      type(lines_t), intent(in) :: lines
      type(law_points_t), intent(inout) :: laws(6)
      type(flaws_t), intent(inout) :: flaws
      type(gum_t) :: gum
      type(field_t) :: fields(64)
      character(:), allocatable :: label
      integer :: k, used, axis

      do k = 1, lines%count
         if (index(adjustl(lines%line(k)), '#') == 1) cycle
         call split_fields(lines%line(k), k, fields, used, flaws)
         if (used == 0) cycle
         if (.not. fields(1)%is_quoted) then
            call flaws%add(k, 'expected a label in quotes, found '//shown(fields(1)%text))
            cycle
         end if
         label = lower(trim(adjustl(fields(1)%text)))
         if (index(label, 'displacement') == 1) then
            call take_displacements(gum, label, k, fields(2:used), flaws)
         else if (index(label, 'force') == 1) then
            call take_forces(gum, label, k, fields(2:used), flaws)
         else if (index(label, 'rot') == 1) then
            call take_stiffness(gum, label, k, fields(2:used), flaws)
         else if (index(label, 'symmetric') == 1 .and. used > 1) then
            call take_symmetry(gum, k, fields(2), flaws)
         end if
      end do
      if (gum%flag < 0) then
         call flaws%add(0, "expected a line 'symmetric=0, asymmetric=1' with 0 or 1, found none")
         return
      end if
      do axis = 1, 3
         call join_halves(gum, axis, laws(axis), flaws)
         call put_stiffness(gum, axis, laws(axis)%line, laws(axis + 3), flaws)
      end do
   end subroutine parse_gum

   !> Reads a list of displacements for one side of an axis.
   subroutine take_displacements(gum, label, line, fields, flaws)
      type(gum_t), intent(inout) :: gum
      character(*), intent(in) :: label
      integer, intent(in) :: line
      type(field_t), intent(in) :: fields(:)
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: value
      logical :: is_good
      integer :: side, j

      call find_axis(label, line, gum%axis, side, flaws)
      if (gum%axis == 0) return
      associate (half => gum%halves(side, gum%axis))
         if (half%is_given) then
            call flaws%add(line, 'expected each list once, found '//trim(label)//' again (first in line '//str(half%line)//')')
            return
         end if
         half%is_given = .true.
         half%line = line
         do j = 1, size(fields)
            call take_number(fields(j)%text, line, 'the displacement', value, flaws, is_good)
            if (.not. is_good) half%is_bad = .true.
            call add_point(half, value*millimetre, 0.0_wp, line)
         end do
      end associate
   end subroutine take_displacements

   !> Reads the forces at the displacements of a list.
   subroutine take_forces(gum, label, line, fields, flaws)
      type(gum_t), intent(inout) :: gum
      character(*), intent(in) :: label
      integer, intent(in) :: line
      type(field_t), intent(in) :: fields(:)
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: value
      logical :: is_good
      integer :: side, j

      call find_axis(label, line, gum%axis, side, flaws)
      if (gum%axis == 0) return
      associate (half => gum%halves(side, gum%axis))
         gum%force_line(side, gum%axis) = line
         if (size(fields) /= half%used) then
            call flaws%add(line, 'expected '//str(half%used)//' forces, one for each displacement, found '//str(size(fields)))
            half%is_bad = .true.
            return
         end if
         do j = 1, size(fields)
            call take_number(fields(j)%text, line, 'the force', value, flaws, is_good)
            if (.not. is_good) half%is_bad = .true.
            half%y(j) = value
         end do
      end associate
   end subroutine take_forces

   !> Reads the rotational stiffness of the axis whose lists were read last.
   subroutine take_stiffness(gum, label, line, fields, flaws)
      type(gum_t), intent(inout) :: gum
      character(*), intent(in) :: label
      integer, intent(in) :: line
      type(field_t), intent(in) :: fields(:)
      type(flaws_t), intent(inout) :: flaws
      logical :: is_good

      if (gum%axis == 0 .or. size(fields) == 0) then
         call flaws%add(line, 'expected a number for '//trim(label)//' after the lists of an axis')
         return
      end if
      associate (stiffness => gum%stiffness(gum%axis))
         call take_number(fields(1)%text, line, 'the rotational stiffness', stiffness, flaws, is_good)
         gum%has_stiffness(gum%axis) = .true.
         if (is_good .and. stiffness < 0.0_wp) &
            call flaws%add(line, 'expected a rotational stiffness of 0 or more, found '//str(stiffness))
      end associate
   end subroutine take_stiffness

   !> Reads whether the negative side has separate numbers.
   subroutine take_symmetry(gum, line, field, flaws)
      type(gum_t), intent(inout) :: gum
      integer, intent(in) :: line
      type(field_t), intent(in) :: field
      type(flaws_t), intent(inout) :: flaws
      real(wp) :: value
      logical :: is_good

      call take_number(field%text, line, 'the flag of symmetry', value, flaws, is_good)
      if (.not. is_good) return
      if (abs(value) <= 0.0_wp) gum%flag = 0
      if (abs(value - 1.0_wp) <= 0.0_wp) gum%flag = 1
      if (gum%flag < 0) call flaws%add(line, 'expected 0 (symmetric) or 1 (asymmetric), found '//str(value))
   end subroutine take_symmetry

   !> Builds the law of the rotation about an axis.
   subroutine put_stiffness(gum, axis, line, law, flaws)
      type(gum_t), intent(in) :: gum
      integer, intent(in) :: axis, line
      type(law_points_t), intent(inout) :: law
      type(flaws_t), intent(inout) :: flaws

      law%line = line
      if (.not. gum%has_stiffness(axis)) call flaws%add(line, 'expected a rotational stiffness of '//axes(axis:axis)// &
         ', found none')
      call add_point(law, -1.0_wp, -gum%stiffness(axis), line)
      call add_point(law, 1.0_wp, gum%stiffness(axis), line)
   end subroutine put_stiffness

   !> Joins the laws of both sides to one law, with the origin between them. If the file is symmetric, the negative side is the
   !> image of the positive side.
   subroutine join_halves(gum, axis, law, flaws)
      type(gum_t), intent(inout) :: gum
      integer, intent(in) :: axis
      type(law_points_t), intent(inout) :: law
      type(flaws_t), intent(inout) :: flaws
      integer :: j, k

      law%line = gum%halves(1, axis)%line
      do k = 1, 1 + gum%flag
         if (.not. gum%halves(k, axis)%is_given) then
            call flaws%add(0, 'expected displacements '//merge('+', '-', k == 1)//axes(axis:axis)//', found none')
         else if (gum%force_line(k, axis) == 0) then
            call flaws%add(gum%halves(k, axis)%line, 'expected forces after these displacements, found none')
         else if (.not. gum%halves(k, axis)%is_bad) then
            call finish_half(gum%halves(k, axis), k, flaws)
         end if
         if (gum%halves(k, axis)%is_bad .or. .not. gum%halves(k, axis)%is_given .or. gum%force_line(k, axis) == 0) return
      end do
      associate (positive => gum%halves(1, axis), negative => gum%halves(1 + gum%flag, axis))
         do j = negative%used, 1, -1
            call add_point(law, -abs(negative%x(j)), -abs(negative%y(j)), negative%line)
         end do
         call add_point(law, 0.0_wp, 0.0_wp, positive%line)
         do j = 1, positive%used
            call add_point(law, positive%x(j), positive%y(j), positive%line)
         end do
      end associate
      call finish_law(law, 'the list of '//axes(axis:axis), flaws)
   end subroutine join_halves

   !> Checks that the distance of the points of one side from 0 increases, and that no point of the positive side has a negative
   !> displacement. A first point at the origin is dropped.
   subroutine finish_half(half, side, flaws)
      type(law_points_t), intent(inout) :: half
      integer, intent(in) :: side
      type(flaws_t), intent(inout) :: flaws
      integer :: k, kept
      real(wp) :: last

      kept = 0
      last = 0.0_wp
      do k = 1, half%used
         if (abs(half%x(k)) <= 0.0_wp .and. abs(half%y(k)) <= 0.0_wp .and. kept == 0) cycle
         if (.not. abs(half%x(k)) > last .or. (side == 1 .and. half%x(k) < 0.0_wp)) then
            call flaws%add(half%line, 'expected displacements that lead away from 0, found '//str(half%x(k)/millimetre))
            half%is_bad = .true.
            return
         end if
         kept = kept + 1
         last = abs(half%x(k))
         half%x(kept) = half%x(k)
         half%y(kept) = half%y(k)
      end do
      half%used = kept
   end subroutine finish_half

   !> Finds the axis and the side of a label: 'displacement +X [mm]'.
   subroutine find_axis(label, line, axis, side, flaws)
      character(*), intent(in) :: label
      integer, intent(in) :: line
      integer, intent(out) :: axis, side         !! side: 1 positive, 2 negative; axis 0: not found
      type(flaws_t), intent(inout) :: flaws
      integer :: mark

      axis = 0
      side = 1
      mark = scan(label, '+-')
      if (mark > 0 .and. mark < len(label)) then
         axis = index(axes, label(mark + 1:mark + 1))
         if (label(mark:mark) == '-') side = 2
      end if
      if (axis == 0) call flaws%add(line, 'expected an axis with its sign (+X … -Z) in the label, found '//shown(label))
   end subroutine find_axis

end module ek_gum
