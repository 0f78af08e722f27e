!> elastokin import: converts files of other programs to a deck.
module ek_import
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: quoted
   use ek_file, only: write_whole, base_name
   use ek_console, only: print_text, print_note
   use ek_foreign_deck, only: import_file, put_model, axle_kind, loads_kind, table_kind
   use ek_frame_votes, only: wish_t
   use ek_command_line, only: command_line_t
   implicit none(type, external)
   private
   public :: import

contains

   !> Writes the deck to standard output, or to the file given by --out. Errors in all files are reported together.
   subroutine import(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: fault
      character(:), allocatable :: deck, text, out
      type(message_list_t) :: faults
      type(wish_t) :: wish
      integer :: k, kind, code

      deck = ''
      code = 0
      wish = wish_t(axes=line%value('--axes'), length=line%value('--length'), datum=line%value('--datum'), &
         axle=line%value('--axle'), side=line%value('--side'))
      do k = 1, line%files%count()
         call import_file(line%files%line(k), text, kind, fault, wish)
         if (allocated(fault)) then
            call faults%add(fault%message)
            code = max(code, fault%code)
            cycle
         end if
         if (any(kind == [axle_kind, loads_kind, table_kind])) then
            if (line%files%count() > 1) call faults%add(quoted(line%files%line(k))//' gives a separate file: import it alone')
         else if (deck == '') then
            deck = put_model(base_name(line%files%line(k)))
         end if
         deck = deck//text
      end do
      if (faults%count() > 0) then
         call fail(error, merge(code, exit_usage, code > 0), faults%text())
         return
      end if
      out = line%value('--out', '-')
      if (out == '-') then
         call print_text(deck, error)
      else
         call write_whole(out, deck, error)
         if (.not. allocated(error)) call print_note(line%has('--quiet'), 'written: '//out)
      end if
   end subroutine import

end module ek_import
