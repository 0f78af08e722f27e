!> A chain of any length: the model with which `bench --growth` measures the growth of the time of an increment with the size of the
!> model.
!>
!> The chain consists of equal bodies in a row along x. Each body is connected to the body before it, and the first body to the
!> chassis, by a spherical joint at the beginning of the body. A bushing above each joint prevents rotation. A driver lifts the end
!> of the last body. A body has 6 unknowns and its joint has 3 rows, so that the matrix of b bodies has 9 b + 1 rows.
module ek_chain
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_buffer, only: buffer_t
   use ek_deck, only: deck_t, parse_deck
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_rig, only: mount
   implicit none(type, external)
   private
   public :: bodies_of, read_chain

   integer, parameter :: pitch = 100      ! mm: length of a body

contains

   !> The number of bodies of the chain whose number of matrix rows is closest to n.
   pure integer function bodies_of(n)
      integer, intent(in) :: n            !! number of matrix rows, at least 10
      bodies_of = max(nint((n - 1)/9.0_wp), 1)
   end function bodies_of

   !> Reads the deck of a chain and mounts its case on the rig.
   subroutine read_chain(bodies, lift, suspension, case, error)
      integer, intent(in) :: bodies
      integer, intent(in) :: lift         !! lift of the end [mm], with two increments per millimetre
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(suspension_t) :: base
      type(case_t), allocatable :: cases(:)

      call parse_deck(deck_text(bodies, lift), 'chain', deck, error)
      if (.not. allocated(error)) call build_model(deck, base, cases, error)
      if (.not. allocated(error)) call mount(base, cases(1), suspension, case)
   end subroutine read_chain

   !> The chain as the content of a deck.
   function deck_text(bodies, lift) result(text)
      integer, intent(in) :: bodies, lift      !! number of bodies; lift of the end [mm]
      character(:), allocatable :: text
      type(buffer_t) :: deck
      character(:), allocatable :: this, ends
      integer :: k

      call deck%line('&model name = ''chain'' /')
      ends = '''chassis'', '
      do k = 1, bodies
         this = str(k)
         call deck%line('&point name = ''low_'//this//''', at = '//str(pitch*(k - 1))//', 0, 0 /')
         call deck%line('&point name = ''high_'//this//''', at = '//str(pitch*(k - 1))//', 0, 40 /')
         call deck%line('&body name = ''link_'//this//''' /')
         call deck%line('&joint name = ''ball_'//this//''', type = ''spherical'', bodies = '//ends//'''link_'//this// &
            ''', at = ''low_'//this//''' /')
         call deck%line('&bushing name = ''bush_'//this//''', bodies = '//ends//'''link_'//this//''', at = ''high_'//this// &
            ''', kt = 3*1000, kr = 3*100000 /')
         ends = '''link_'//this//''', '
      end do
      call deck%line('&point name = ''end'', at = '//str(pitch*bodies)//', 0, 0 /')
      call deck%line('&measure name = ''height'', type = ''global_gap'', bodies = ''chassis'', ''link_'//str(bodies)// &
         ''', at = ''end'', axis_vector = 0, 0, 1 /')
      call deck%line('&joint name = ''hand'', type = ''driver'', measure = ''height'' /')
      call deck%line('&case name = ''lift'', drive = ''hand'', from = 0, to = '//str(lift)//', increments = '// &
         str(2*lift)//' /')
      text = deck%text()
   end function deck_text

end module ek_chain
