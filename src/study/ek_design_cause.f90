!> Causes of failed designs. While the designs of a chunk are solved, the causes are stored as numbers. After the last design of the
!> chunk, messages are created from the causes, by one thread at a time.
module ek_design_cause
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t
   use ek_text, only: str, quoted
   use ek_case_result, only: failure_of
   use ek_table, only: table_t, column_index
   use ek_sweep_table, only: open_states
   use ek_study, only: not_given
   use ek_response, only: fault_text
   use ek_response_value, only: reading_t
   use ek_workspace, only: workspace_t
   implicit none(type, external)
   private
   public :: cause_t, causes_t, add_cause, add_unread, find_cause, cause_text

   type :: cause_t
      integer :: design = 0                        !! index of the design in the chunk, from 1
      logical :: is_unread = .false.               !! the design must be read from the deck's strings; its cause is found only then
      type(error_t) :: error !! error of the first case that was not run; its message is not allocated if all cases were run
      real(wp), allocatable :: lost(:, :)          !! (side, case): first swept value without an equilibrium; NaN if all states of
                                                   !! the side converged
      real(wp), allocatable :: open(:, :)          !! (2, case): swept value of the first state of open_states, and its |Φ| [m or
                                                   !! rad]; NaN if there is no such state
      integer, allocatable :: faults(:) !! reason code of each response, from read_response; 0 if the response has a value
      type(table_t), allocatable :: tables(:)      !! table of each case, filled only for cases in which a response has no value
   end type cause_t

   !> The causes of a chunk, in the order of the designs.
   type :: causes_t
      integer :: used = 0
      type(cause_t), allocatable :: list(:)
   end type causes_t

contains

   !> Adds the cause of a design that must be read from the deck's strings.
   pure subroutine add_unread(design, causes)
      integer, intent(in) :: design
      type(causes_t), intent(inout) :: causes
      type(cause_t) :: cause

      cause%design = design
      cause%is_unread = .true.
      call add_cause(cause, causes)
   end subroutine add_unread

   !> Adds a cause to the causes of a chunk.
   pure subroutine add_cause(cause, causes)
      type(cause_t), intent(in) :: cause
      type(causes_t), intent(inout) :: causes
      type(cause_t), allocatable :: more(:)

      if (.not. allocated(causes%list)) allocate (causes%list(8))
      if (causes%used == size(causes%list)) then
         allocate (more(2*causes%used))
         more(:causes%used) = causes%list
         call move_alloc(more, causes%list)
      end if
      causes%used = causes%used + 1
      causes%list(causes%used) = cause
   end subroutine add_cause

   !> Finds the causes for which a design is incomplete. No string is created if all cases of the design were run.
   subroutine find_cause(design, case_of, faults, workspace, cause)
      integer, intent(in) :: design
      integer, intent(in) :: case_of(:), faults(:)         !! index of the case, and reason code of read_response, for each response
      type(workspace_t), intent(in) :: workspace           !! workspace with the results of its cases
      type(cause_t), intent(out) :: cause
      type(error_t), allocatable :: error
      integer :: c, j, side, row

      cause%design = design
      allocate (cause%faults, source=faults)               ! an assignment reads bounds of what is not allocated
      allocate (cause%lost(2, size(workspace%cases)), cause%open(2, size(workspace%cases)), source=not_given())
      allocate (cause%tables(size(workspace%cases)))
      do c = 1, size(workspace%cases)
         associate (result => workspace%cases(c)%result, path => workspace%cases(c)%result%path)
            if (.not. result%is_run()) then
               call failure_of(result, error)
               if (.not. allocated(cause%error%message)) cause%error = error
               cycle
            end if
            do side = 1, 2
               if (path%failure(side)%state > 0) cause%lost(side, c) = path%value(path%failure(side)%state)/result%case%unit
            end do
            row = findloc(open_states(result%table), .true., dim=1)
            if (row > 0) cause%open(:, c) = [result%table%values(2, row), result%table%values(column_index(result%table, &
               'constraint_error'), row)]
         end associate
      end do
      do j = 1, size(faults)
         if (faults(j) == 0) cycle
         c = case_of(j)
         if (.not. allocated(cause%tables(c)%columns)) cause%tables(c) = workspace%cases(c)%result%table
      end do
   end subroutine find_cause

   !> The message on a failed design, from its cause.
   function cause_text(cause, case_of, readings, workspace) result(text)
      type(cause_t), intent(in) :: cause
      integer, intent(in) :: case_of(:)                    !! index of the case of each response
      type(reading_t), intent(in) :: readings(:)
      type(workspace_t), intent(in) :: workspace           !! workspace with the names of the cases
      character(:), allocatable :: text
      type(message_list_t) :: words
      integer :: c, j, side

      if (allocated(cause%error%message)) call words%add(cause%error%message)
      do c = 1, size(cause%lost, 2)
         do side = 1, 2
            if (.not. ieee_is_nan(cause%lost(side, c))) call words%add('case '//quoted(workspace%cases(c)%case%name)// &
               ': no equilibrium at factor '//str(cause%lost(side, c)))
         end do
         if (.not. ieee_is_nan(cause%open(1, c))) call words%add('case '//quoted(workspace%cases(c)%case%name)//', method '// &
            workspace%cases(c)%case%method//': at factor '//str(cause%open(1, c))//' a state violates the joint constraints by '// &
            str(cause%open(2, c), 2)//' m or rad; use more increments, or method ''equilibrium''')
      end do
      do j = 1, size(cause%faults)
         if (cause%faults(j) /= 0) call words%add('response '//quoted(readings(j)%asked%name)//': '// &
            fault_text(readings(j), cause%tables(case_of(j)), cause%faults(j)))
      end do
      if (words%count() == 0) call words%add('a response has no value')
      text = words%text()
   end function cause_text

end module ek_design_cause
