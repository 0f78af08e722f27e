!> The deck as used: one file with the records of all included files, hardpoints and property files, of both sides, and with all
!> settings. Comments give the file and the line of each record, the setting of each value that was set, and the defaults of numbers
!> that are not given. The file gives the same results as the deck from which it was made.
module ek_deck_writer
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str, quoted
   use ek_buffer, only: buffer_t
   use ek_checksum, only: checksum_t, include, digits_of
   use ek_file, only: write_whole, join_path, folder_name, base_name
   use ek_kept_files, only: kept_files_t, read_kept
   use ek_record, only: record_t, entry_t, right_side, is_given, takes_image
   use ek_system, only: working_folder, facts_t, facts_of, regular_file
   use ek_parameter, only: parameters_t, value_path
   use ek_attachment, only: path_of, text_of
   use ek_deck, only: deck_t, deck_checksum
   use ek_reader, only: definition_t, read_design
   use ek_version, only: version
   implicit none(type, external)
   private
   public :: deck_as_used, write_deck_as_used

   character(*), parameter :: written_out(3) = [character(10) :: 'include', 'hardpoints', 'mirror']
   character(*), parameter :: replaced(4) = [character(15) :: 'property_file', 'property_scale', 'property_offset', 'property_kind']
   character(*), parameter :: nl = new_line('a')
   character(*), parameter :: mark = '! checksum of the lines below: '     !! begins the last line of the head; 16 digits follow

   !> A load table that a record names.
   type :: table_t
      character(:), allocatable :: path, name      !! path from which the table was read; its name in the written deck
   end type table_t

contains

   !> Writes a deck as it was used to a file, and the load tables named in the deck to files DECK_TABLE.csv in the same folder.
   subroutine write_deck_as_used(deck, path, error, copies)
      type(deck_t), intent(in) :: deck                     !! without errors
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error     !! exit_usage, exit_file; exit_deck if the deck has errors
      type(message_list_t), intent(inout), optional :: copies     !! gets the names of the load tables
      type(table_t), allocatable :: tables(:)
      character(:), allocatable :: text, content
      integer :: k

      call refuse_own_files(deck, path, error)
      if (allocated(error)) return
      call make_text(deck, path, text, tables, error)
      if (.not. allocated(error)) call write_whole(path, text, error)
      do k = 1, size(tables)
         if (allocated(error)) return
         if (.not. is_own_file(deck%kept, join_path(folder_name(path), tables(k)%name))) then     ! a written deck in the same folder
            call read_kept(deck%kept, tables(k)%path, content, error)
            if (.not. allocated(error)) call write_whole(join_path(folder_name(path), tables(k)%name), content, error)
         end if
         if (present(copies)) call copies%add(tables(k)%name)
      end do
   end subroutine write_deck_as_used

   !> Rejects a path that would overwrite a file from which the deck was read, and the path '-'.
   subroutine refuse_own_files(deck, path, error)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error     !! exit_usage

      if (path == '-') then
         call fail(error, exit_usage, 'the deck as it was used needs a file, found -')
         return
      end if
      if (is_own_file(deck%kept, path)) call fail(error, exit_usage, quoted(path)//' is a file from which the deck was read; '// &
         'give another file for the deck as it was used')
   end subroutine refuse_own_files

   !> Whether a path leads to a file from which the deck was read.
   logical function is_own_file(kept, path)
      type(kept_files_t), intent(in) :: kept
      character(*), intent(in) :: path
      type(facts_t) :: target, own
      integer :: k

      is_own_file = .false.
      target = facts_of(path, follow=.true.)
      if (target%kind /= regular_file) return
      do k = 1, kept%count()
         own = facts_of(kept%path(k), follow=.true.)
         is_own_file = own%kind == regular_file .and. own%inode == target%inode .and. own%device == target%device
         if (is_own_file) return
      end do
   end function is_own_file

   !> Writes a deck as it was used into a string. Load tables are not copied; the string contains their absolute paths.
   subroutine deck_as_used(deck, text, error)
      type(deck_t), intent(in) :: deck
      character(:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error     !! exit_deck: the deck has errors
      type(table_t), allocatable :: tables(:)

      call make_text(deck, '', text, tables, error)
   end subroutine deck_as_used

   subroutine make_text(deck, path, text, tables, error)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: path                     !! of the written deck; '': absolute paths of load tables
      character(:), allocatable, intent(out) :: text
      type(table_t), allocatable, intent(out) :: tables(:)
      type(error_t), allocatable, intent(out) :: error
      type(definition_t) :: design
      type(buffer_t) :: lines
      type(checksum_t) :: sum
      logical :: is_listed
      integer :: k

      text = ''
      allocate (tables(0))
      call read_design(deck, design, error)
      if (allocated(error)) return
      if (is_written_deck(deck)) then
         call list_tables(deck, path, tables, is_listed)
         if (is_listed) then
            text = deck%kept%text(1)
            return
         end if
      end if
      do k = 1, size(design%records)
         if (any(written_out == design%records(k)%group)) cycle
         call add_record(design%records(k), k, design%parameters, deck%kept, path, tables, lines)
      end do
      text = lines%text()
      call include(sum, text)
      text = '! The deck '//deck%file//' as elastokin '//version//' used it, checksum '//deck_checksum(deck)//':'//nl// &
         '! included files, hardpoints, property files, both sides and settings are written out'//nl//mark//digits_of(sum)//nl//text
   end subroutine make_text

   !> Whether a deck is an unchanged file of write_deck_as_used, without settings, so that the file itself is the deck as used.
   logical function is_written_deck(deck)
      type(deck_t), intent(in) :: deck
      character(:), allocatable :: text
      type(checksum_t) :: sum
      integer :: k, e, at

      is_written_deck = .false.
      if (deck%kept%count() == 0 .or. size(deck%late) > 0) return
      text = deck%kept%text(1)
      at = index(text, nl//mark)
      if (index(text, '! The deck ') /= 1 .or. at == 0 .or. len(text) < at + len(nl//mark) + 16) return
      call include(sum, text(at + len(nl//mark) + 17:))
      if (text(at + len(nl//mark):at + len(nl//mark) + 15) /= digits_of(sum)) return
      do k = 1, deck%used
         do e = 1, deck%records(k)%used
            if (allocated(deck%records(k)%entries(e)%setting)) return
         end do
      end do
      is_written_deck = .true.
   end function is_written_deck

   !> Lists the load tables of a written deck, which keep their names. `is_listed` is .false. if a table is not in the folder of the
   !> deck, could not be read, or would need an absolute path.
   subroutine list_tables(deck, path, tables, is_listed)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: path                     !! as for make_text
      type(table_t), allocatable, intent(inout) :: tables(:)
      logical, intent(out) :: is_listed
      type(table_t) :: this
      integer :: k

      is_listed = .true.
      do k = 1, deck%used
         if (deck%records(k)%group /= 'case' .or. .not. is_given(deck%records(k), 'file')) cycle
         this%name = text_of(deck%records(k), 'file')
         this%path = path_of(deck%records(k), this%name)
         is_listed = is_listed .and. path /= '' .and. deck%kept%has(this%path) .and. base_name(this%name)//'.csv' == this%name
         tables = [tables, this]
      end do
      if (.not. is_listed) tables = tables(:0)
   end subroutine list_tables

   !> Adds one record: its file and line, a line for each key, and comments with the defaults of the numbers that are not given.
   subroutine add_record(record, number, parameters, kept, path, tables, lines)
      type(record_t), intent(in) :: record
      integer, intent(in) :: number
      type(parameters_t), intent(in) :: parameters
      type(kept_files_t), intent(in) :: kept
      character(*), intent(in) :: path                     !! as for make_text
      type(table_t), allocatable, intent(inout) :: tables(:)
      type(buffer_t), intent(inout) :: lines
      character(:), allocatable :: line
      integer :: e, k

      line = ''
      call lines%line(line)
      call lines%line('&'//record%group//'   ! '//record%file//':'//str(record%line))
      do e = 1, record%used
         associate (entry => record%entries(e))
            if (any(replaced == entry%key) .or. (entry%key == 'mirrored' .and. record%side == right_side)) cycle
            if (entry%key == 'file') then
               line = '  file = '//in_quotes(table_name(record, kept, path, tables))
            else
               line = '  '//entry_text(entry)
            end if
            if (allocated(entry%setting)) then
               line = line//'   ! set: '//entry%setting
            else if (entry%line > 0 .and. entry%line /= record%line) then
               line = line//'   ! line '//str(entry%line)
            end if
         end associate
         call lines%line(line)
      end do
      if (record%group == 'bushing' .and. record%side == right_side .and. takes_image(record) .and. gives_one_axis(record)) &
         call lines%line('  mirrored = .true.   ! the axis that is not given is the mirror image of that of the left side')
      do k = 1, parameters%used
         associate (this => parameters%list(k))
            if (this%record /= number .or. this%is_given) cycle
            line = value_path(record, trim(this%key), this%at)
            call lines%line('  ! '//line(index(line, '.', back=.true.) + 1:)//' = '// &
               str(parameters%x(k)/this%unit, 15)//'   by default')
         end associate
      end do
      call lines%line('/')
   end subroutine add_record

   !> Whether a bushing gives only one of its marker axes, so that the program chooses the other axis.
   pure logical function gives_one_axis(record)
      type(record_t), intent(in) :: record

      gives_one_axis = (is_given(record, 'z_axis') .or. is_given(record, 'z_vector')) .neqv. &
         (is_given(record, 'x_axis') .or. is_given(record, 'x_vector'))
   end function gives_one_axis

   !> An entry as written in a deck: 'kt = 700, 700, 150', 'kt(2) = 5', "bodies = 'chassis', 'lca'".
   function entry_text(entry) result(text)
      type(entry_t), intent(in) :: entry
      character(:), allocatable :: text
      integer :: v

      text = entry%key
      if (entry%first /= 1) text = text//'('//str(entry%first)//')'
      text = text//' ='
      do v = 1, entry%used
         if (v > 1) text = text//','
         if (entry%values(v)%is_string) then
            text = text//' '//in_quotes(entry%values(v)%text)
         else
            text = text//' '//entry%values(v)%text
         end if
      end do
   end function entry_text

   !> A string in quotes; a quote inside the string is doubled.
   function in_quotes(text) result(words)
      character(*), intent(in) :: text
      character(:), allocatable :: words
      integer :: k

      words = "'"
      do k = 1, len(text)
         words = words//text(k:k)
         if (text(k:k) == "'") words = words//"'"
      end do
      words = words//"'"
   end function in_quotes

   !> The name of the load table of a case in the written deck. A new name is added to the list of tables. A name that another table
   !> has, or a file from which the deck was read, gets a number. Without a path of the deck, and for a table that could not be read,
   !> the name is the absolute path.
   function table_name(record, kept, path, tables) result(name)
      type(record_t), intent(in) :: record
      type(kept_files_t), intent(in) :: kept
      character(*), intent(in) :: path                     !! as for make_text
      type(table_t), allocatable, intent(inout) :: tables(:)
      character(:), allocatable :: name
      type(table_t) :: this
      integer :: k, number

      this%path = path_of(record, text_of(record, 'file'))
      name = join_path(working_folder(), this%path)
      if (path == '' .or. .not. kept%has(this%path)) return
      do k = 1, size(tables)
         name = tables(k)%name
         if (tables(k)%path == this%path) return
      end do
      number = 0
      do
         number = number + 1
         name = base_name(path)//'_'//base_name(this%path)
         if (number > 1) name = name//'_'//str(number)
         name = name//'.csv'
         if (is_own_file(kept, join_path(folder_name(path), name))) cycle
         if (.not. is_taken(name)) exit
      end do
      this%name = name
      tables = [tables, this]

   contains

      !> Whether another table has this name.
      pure logical function is_taken(name)
         character(*), intent(in) :: name
         integer :: k

         is_taken = .false.
         do k = 1, size(tables)
            is_taken = is_taken .or. tables(k)%name == name
         end do
      end function is_taken

   end function table_name

end module ek_deck_writer
