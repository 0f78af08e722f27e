!> The name of an element in messages, and its shape in pictures. These are not in `ek_element`, which is a kernel: kernels create
!> no strings.
module ek_element_label
   use ek_kinds, only: wp
   use ek_text, only: quoted
   use ek_element, only: element_t, element_kinds, axial_spring
   implicit none(type, external)
   private
   public :: element_label, is_between_bodies, is_rod

contains

   !> The group and name of an element for messages: "spring 'coil'".
   pure function element_label(element) result(text)
      type(element_t), intent(in) :: element
      character(:), allocatable :: text
      text = trim(element_kinds(element%kind)%label)//' '//quoted(element%name)
   end function element_label

   !> Whether both ends of an element are on moving bodies.
   pure logical function is_between_bodies(element)
      type(element_t), intent(in) :: element
      is_between_bodies = min(element%measure%body_i, element%measure%body_j) > 0
   end function is_between_bodies

   !> Whether a spring is an elastic rod, as push rods and pull rods are: between two moving bodies, stiffer than a coil, and on a
   !> body on which a softer spring acts. The coil of a strut with a top mount is also between two bodies, but it is the only spring
   !> on these bodies.
   pure logical function is_rod(elements, k)
      type(element_t), intent(in) :: elements(:)
      integer, intent(in) :: k
      real(wp), parameter :: stiff = 3.0e6_wp      ! N/m: the stiffest spring of a vehicle is a leaf spring of 3000 N/mm
      integer :: j

      is_rod = .false.
      if (.not. is_stiff(elements(k)) .or. .not. is_between_bodies(elements(k))) return
      do j = 1, size(elements)
         if (elements(j)%kind /= axial_spring .or. is_stiff(elements(j))) cycle
         associate (a => elements(k)%measure, b => elements(j)%measure)
            is_rod = is_rod .or. any([a%body_i, a%body_j] == max(b%body_i, b%body_j))
         end associate
      end do

   contains

      !> Whether an element is a linear spring at least as stiff as a rod.
      pure logical function is_stiff(element)
         type(element_t), intent(in) :: element
         is_stiff = element%kind == axial_spring .and. .not. element%law%has_curve .and. element%law%rate >= stiff
      end function is_stiff

   end function is_rod

end module ek_element_label
