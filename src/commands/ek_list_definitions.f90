!> elastokin list --definitions NAME: the quantities of another program, with their formulas of columns of elastokin.
module ek_list_definitions
   use ek_error, only: error_t, fail, exit_usage
   use ek_text, only: quoted, is_like, suggestion_by_part
   use ek_buffer, only: buffer_t
   use ek_json, only: json_t, json_string
   use ek_definition_json, only: add_definition
   use ek_definition_rows, only: definition_t, definitions
   use ek_definition, only: rows_of, check_program, title_of
   use ek_command_line, only: command_line_t
   use ek_console, only: print_text
   use ek_version, only: version
   implicit none(type, external)
   private
   public :: list_definitions

contains

   !> Prints the definitions of a program as text or, with --json, as one JSON object (schema/definitions.schema.json).
   subroutine list_definitions(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_usage: an unknown program, or no name matches --like
      character(:), allocatable :: program, pattern, text
      integer, allocatable :: rows(:)
      integer :: k

      program = line%value('--definitions')
      call check_program(program, error)
      if (.not. allocated(error)) call refuse_lists(line, error)
      if (allocated(error)) return
      pattern = line%value('--like', '*')
      rows = rows_of(program)
      rows = pack(rows, [(is_like(trim(definitions(rows(k))%name), pattern) .or. &
         is_like(trim(definitions(rows(k))%ours), pattern), k=1, size(rows))])
      if (size(rows) == 0) then
         rows = rows_of(program)
         call fail(error, exit_usage, '--like: no name of '//title_of(program)//' and no column of elastokin matches '// &
            quoted(pattern)//'; * stands for any letters'//suggestion_by_part(pattern, definitions(rows)%name))
         return
      end if
      if (line%has('--json')) then
         text = as_json(program, rows)
      else
         text = as_text(program, rows)
      end if
      call print_text(text, error)
   end subroutine list_definitions

   !> Rejects the lists of a deck.
   subroutine refuse_lists(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error     !! exit_usage
      character(*), parameter :: others(*) = [character(10) :: '--paths', '--cases', '--numbers', '--set', '--set-file', &
         '--height', '--state']
      integer :: k

      do k = size(others), 1, -1
         if (line%has(trim(others(k)))) call fail(error, exit_usage, '--definitions does not depend on a deck, and cannot be '// &
            'used with '//trim(others(k)))
      end do
   end subroutine refuse_lists

   !> The rows as text: the printed ones with unit, sign and formula, then the others with the reason.
   function as_text(program, rows) result(text)
      character(*), intent(in) :: program
      integer, intent(in) :: rows(:)
      character(:), allocatable :: text
      type(buffer_t) :: out
      integer :: k

      call out%line(title_of(program)//': name [unit], positive, and formula of the columns of elastokin at the same state')
      do k = 1, size(rows)
         if (definitions(rows(k))%formula /= '') call put(definitions(rows(k)))
      end do
      if (any(definitions(rows)%formula == '')) then
         call out%line('')
         call out%line('not printed')
         do k = 1, size(rows)
            if (definitions(rows(k))%formula == '') call put(definitions(rows(k)))
         end do
      end if
      text = out%text()

   contains

      subroutine put(row)
         type(definition_t), intent(in) :: row
         character(:), allocatable :: words

         words = trim(row%name)
         if (row%unit /= '') words = words//' ['//trim(row%unit)//']'
         if (row%positive /= '') words = words//', positive: '//trim(row%positive)
         if (row%formula == '') words = words//' ('//trim(row%ours)//'): '//trim(row%difference)
         call out%line('  '//words)
         if (row%formula /= '') call out%line('      = '//trim(row%formula))
         if (row%formula /= '' .and. row%difference /= '') call out%line('      '//trim(row%difference))
         if (row%errs /= '') call out%line('      '//title_of(program)//' errs: '//trim(row%errs))
      end subroutine put

   end function as_text

   !> The rows as one JSON object.
   function as_json(program, rows) result(text)
      character(*), intent(in) :: program
      integer, intent(in) :: rows(:)
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: k

      call json%open('{')
      call json%item('program', json_string('elastokin '//version))
      call json%item('definitions', json_string(program))
      call json%item('title', json_string(title_of(program)))
      call json%open('[', 'rows')
      do k = 1, size(rows)
         associate (row => definitions(rows(k)))
            call json%open('{')
            call add_definition(json, row)
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function as_json

end module ek_list_definitions
