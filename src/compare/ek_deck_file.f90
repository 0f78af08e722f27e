!> deck.csv of a report: the values of its deck, from which a comparison lists the changes. Rows of kind `fact` describe how the
!> report was made (deck, settings, checksum). Rows of kind `value` contain the values of the deck by their paths.
module ek_deck_file
   use ek_error, only: error_t, message_list_t
   use ek_file, only: file_exists
   use ek_table, only: table_t
   use ek_frame, only: frame_t, new_frame
   use ek_text_table, only: text_table_t, read_text_table, cell_of
   implicit none(type, external)
   private
   public :: deck_record_t, deck_csv, read_deck_file, facts_of_table

   character(*), parameter :: fact = 'fact', value = 'value'
   !> Facts of the page that deck.csv omits: the report contains them elsewhere, or no result depends on them.
   character(*), parameter :: not_kept(2) = [character(14) :: 'Date', 'Road at design']

   type :: deck_record_t
      type(message_list_t) :: names, facts      !! facts: 'Deck checksum' and its value
      type(message_list_t) :: paths, texts      !! values of the deck by their paths
      logical :: is_known = .false.             !! the values of the deck are known
   end type deck_record_t

contains

   !> deck.csv: the facts and the values of the deck.
   function deck_csv(names, facts, paths, texts) result(csv)
      type(message_list_t), intent(in) :: names, facts     !! facts at the top of the page
      type(message_list_t), intent(in) :: paths, texts     !! values of the deck by their paths (ek_deck_values)
      character(:), allocatable :: csv
      type(frame_t) :: frame
      integer :: k

      frame = new_frame('kind,path,value')
      do k = 1, names%count()
         if (any(not_kept == names%line(k))) cycle
         call frame%put(fact)
         call frame%put(names%line(k))
         call frame%put(facts%line(k))
      end do
      do k = 1, paths%count()
         call frame%put(value)
         call frame%put(paths%line(k))
         call frame%put(texts%line(k))
      end do
      csv = frame%csv()
   end function deck_csv

   !> Reads deck.csv. Without the file, the record is empty and is_known is .false.; this is not an error, because reports of
   !> earlier versions do not have the file.
   subroutine read_deck_file(path, record, error)
      character(*), intent(in) :: path
      type(deck_record_t), intent(out) :: record
      type(error_t), allocatable, intent(out) :: error     !! exit_file, with path and line
      type(text_table_t) :: table
      integer :: k

      if (.not. file_exists(path)) return
      call read_text_table(path, table, error)
      if (allocated(error)) return
      record%is_known = .true.
      do k = 1, table%rows
         if (cell_of(table, k, 'kind') == fact) then
            call record%names%add(cell_of(table, k, 'path'))
            call record%facts%add(cell_of(table, k, 'value'))
         else
            call record%paths%add(cell_of(table, k, 'path'))
            call record%texts%add(cell_of(table, k, 'value'))
         end if
      end do
   end subroutine read_deck_file

   !> Reads the facts about a run from the header of a table. If the record already has facts, it is left unchanged.
   subroutine facts_of_table(table, record)
      type(table_t), intent(in) :: table
      type(deck_record_t), intent(inout) :: record
      character(*), parameter :: sum_mark = ', deck checksum '
      character(:), allocatable :: line
      integer :: k, at

      if (record%names%count() > 0) return
      do k = 1, table%header%count()
         line = table%header%line(k)
         at = index(line, sum_mark)
         if (index(line, 'model ') == 1) call add('Run', line)
         if (index(line, 'factor: ') == 1) call add('Input', line(len('factor: ') + 1:))
         if (index(line, 'axes ') == 1) call add('Axes', line(len('axes ') + 1:))
         if (at == 0) cycle
         call add('Deck checksum', line(at + len(sum_mark):))
         call add('Program', line(:at - 1))
      end do

   contains

      subroutine add(name, text)
         character(*), intent(in) :: name, text
         call record%names%add(name)
         call record%facts%add(text)
      end subroutine add

   end subroutine facts_of_table

end module ek_deck_file
