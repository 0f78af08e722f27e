!> A bushing of IPGKinematics (.gum): lines of a quoted label and numbers. For each axis, of which x is that of the bushing:
!> displacements in mm, forces in N, damping, and a rotational stiffness in N m/rad; at the end, whether the negative side has
!> numbers of its own (1) or is the image of the positive side (0).
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

contains

   !> Whether a file is a bushing: some line has a label with `displacement`.
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

   !> The laws of a bushing, [m, N] and [rad, N m].
   subroutine parse_gum(lines, laws, flaws)
      type(lines_t), intent(in) :: lines
      type(law_points_t), intent(inout) :: laws(6)
      type(flaws_t), intent(inout) :: flaws
      type(field_t) :: fields(64)
      character(:), allocatable :: label
      type(law_points_t) :: halves(2, 3)      ! (positive or negative side, axis); y stays 0 until the forces are read
      logical :: has_stiffness(3), is_good
      integer :: force_line(2, 3), k, j, used, axis, side, flag
      real(wp) :: value, stiffness(3)

      has_stiffness = .false.
      stiffness = 0.0_wp
      force_line = 0
      flag = -1
      axis = 0
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
            call find_axis(label, k, axis, side, flaws)
            if (axis == 0) cycle
            if (halves(side, axis)%is_given) then
               call flaws%add(k, 'expected each list once, found '//trim(label)//' again (first in line '// &
                  str(halves(side, axis)%line)//')')
               cycle
            end if
            halves(side, axis)%is_given = .true.
            halves(side, axis)%line = k
            do j = 2, used
               call take_number(fields(j)%text, k, 'the displacement', value, flaws, is_good)
               if (.not. is_good) halves(side, axis)%is_bad = .true.
               call add_point(halves(side, axis), value*millimetre, 0.0_wp, k)
            end do
         else if (index(label, 'force') == 1) then
            call find_axis(label, k, axis, side, flaws)
            if (axis == 0) cycle
            force_line(side, axis) = k
            if (used - 1 /= halves(side, axis)%used) then
               call flaws%add(k, 'expected '//str(halves(side, axis)%used)//' forces, one for each displacement, found '// &
                  str(used - 1))
               halves(side, axis)%is_bad = .true.
               cycle
            end if
            do j = 2, used
               call take_number(fields(j)%text, k, 'the force', value, flaws, is_good)
               if (.not. is_good) halves(side, axis)%is_bad = .true.
               halves(side, axis)%y(j - 1) = value
            end do
         else if (index(label, 'rot') == 1) then
            if (axis == 0 .or. used < 2) then
               call flaws%add(k, 'expected a number for '//trim(label)//' behind the lists of an axis')
               cycle
            end if
            call take_number(fields(2)%text, k, 'the rotational stiffness', stiffness(axis), flaws, is_good)
            has_stiffness(axis) = .true.
            if (is_good .and. stiffness(axis) < 0.0_wp) then
               call flaws%add(k, 'expected a rotational stiffness of 0 or more, found '//str(stiffness(axis)))
               stiffness(axis) = 0.0_wp
            end if
         else if (index(label, 'symmetric') == 1 .and. used > 1) then
            call take_number(fields(2)%text, k, 'the flag of symmetry', value, flaws, is_good)
            if (is_good .and. abs(value) <= 0.0_wp) flag = 0
            if (is_good .and. abs(value - 1.0_wp) <= 0.0_wp) flag = 1
            if (is_good .and. flag < 0) call flaws%add(k, 'expected 0 (symmetric) or 1 (asymmetric), found '//str(value))
         end if
      end do
      if (flag < 0) then
         call flaws%add(0, "expected a line 'symmetric=0, asymmetric=1' with 0 or 1, found none")
         return
      end if
      do axis = 1, 3
         call join_halves(axis)
         laws(axis + 3)%is_given = .true.
         laws(axis + 3)%line = laws(axis)%line
         if (.not. has_stiffness(axis)) call flaws%add(laws(axis)%line, 'expected a rotational stiffness of '//axes(axis:axis)// &
            ', found none')
         call add_point(laws(axis + 3), -1.0_wp, -stiffness(axis), laws(axis)%line)
         call add_point(laws(axis + 3), 1.0_wp, stiffness(axis), laws(axis)%line)
      end do

   contains

      !> One law of both sides, with the origin between them.
      subroutine join_halves(axis)
         integer, intent(in) :: axis
         integer :: j, k

         laws(axis)%is_given = .true.
         laws(axis)%line = halves(1, axis)%line
         do k = 1, 1 + flag
            if (.not. halves(k, axis)%is_given) then
               call flaws%add(0, 'expected displacements '//merge('+', '-', k == 1)//axes(axis:axis)//', found none')
            else if (force_line(k, axis) == 0) then
               call flaws%add(halves(k, axis)%line, 'expected forces behind these displacements, found none')
            else if (.not. halves(k, axis)%is_bad) then
               call finish_law_of_half(halves(k, axis), k)
            end if
            if (halves(k, axis)%is_bad .or. .not. halves(k, axis)%is_given .or. force_line(k, axis) == 0) then
               laws(axis)%is_bad = .true.
               return
            end if
         end do
         k = 1 + flag
         do j = halves(k, axis)%used, 1, -1
            call add_point(laws(axis), -abs(halves(k, axis)%x(j)), -abs(halves(k, axis)%y(j)), halves(k, axis)%line)
         end do
         call add_point(laws(axis), 0.0_wp, 0.0_wp, halves(1, axis)%line)
         do j = 1, halves(1, axis)%used
            call add_point(laws(axis), halves(1, axis)%x(j), halves(1, axis)%y(j), halves(1, axis)%line)
         end do
         call finish_law(laws(axis), 'the list of '//axes(axis:axis), flaws)
      end subroutine join_halves

      !> The points of one side lie on it and lead away from 0; a point at 0 is dropped.
      subroutine finish_law_of_half(half, side)
         type(law_points_t), intent(inout) :: half
         integer, intent(in) :: side
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
      end subroutine finish_law_of_half

   end subroutine parse_gum

   !> The axis and the side of a label: 'displacement +X [mm]'.
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
