!> elastokin new: a commented deck of the library, as the beginning of a new deck.
!>
!> The build puts the decks into the program (library/embed.cmake). A new kind needs a row here and in src/CMakeLists.txt.
module ek_new
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted, did_you_mean
   use ek_buffer, only: buffer_t
   use ek_library_decks, only: add_deck
   use ek_points_only, only: keep_points
   use ek_command_line, only: command_line_t
   use ek_console, only: print_text
   implicit none(type, external)
   private
   public :: print_new_deck, kind_t, kinds

   !> A kind of suspension.
   type :: kind_t
      character(20) :: name
      character(76) :: summary      !! description in the list of kinds
   end type kind_t

   type(kind_t), parameter :: kinds(*) = [ &
      kind_t('double_wishbone', 'double wishbone front axle with rack and anti-roll bar'), &
      kind_t('mcpherson', 'McPherson front axle with rack and anti-roll bar'), &
      kind_t('mcpherson_split_link', 'McPherson front axle with split lower links'), &
      kind_t('five_link', 'five-link rear axle on a subframe'), &
      kind_t('integral_link', 'rear axle with H-arms and integral links on a subframe'), &
      kind_t('semi_trailing', 'semi-trailing arm rear axle'), &
      kind_t('trailing_arm', 'trailing arm rear axle'), &
      kind_t('twist_beam', 'twist beam rear axle'), &
      kind_t('solid', 'solid rear axle with four links and Panhard rod'), &
      kind_t('push_rod', 'double wishbone rear axle with push rods and rockers, Formula Student')]

contains

   !> Prints the deck of a kind to standard output; without a kind, prints the list of kinds. With --points-only, the
   !> deck has points and links only.
   subroutine print_new_deck(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error      !! exit_usage: unknown kind
      type(buffer_t) :: out, deck, joints
      character(:), allocatable :: title
      integer :: k

      if (line%files%count() == 0) then
         do k = 1, size(kinds)
            call out%line(kinds(k)%name//'  '//trim(kinds(k)%summary))
         end do
      else if (any(kinds%name == line%files%line(1))) then
         if (.not. line%has('--points-only')) then
            call add_deck(line%files%line(1), out)
         else
            call add_deck(line%files%line(1), deck)
            call add_deck(line%files%line(1)//'/points', joints)
            do k = 1, size(kinds)
               if (kinds(k)%name /= line%files%line(1)) cycle
               title = trim(kinds(k)%summary)
               title(1:1) = achar(iachar(title(1:1)) - merge(32, 0, title(1:1) >= 'a'))
               call keep_points(deck%text(), joints%text(), title, out)
            end do
         end if
      else
         call fail(error, exit_usage, 'there is no kind '//quoted(line%files%line(1))// &
            did_you_mean(line%files%line(1), kinds%name)//'; elastokin new lists the kinds')
         return
      end if
      call print_text(out%text(), error)
   end subroutine print_new_deck

end module ek_new
