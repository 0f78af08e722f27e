!> Through the front door: a deck on the test rig, and the table that a user would be given.
module ek_rig_table
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_deck, only: deck_t, read_deck, set_value, split_setting
   use ek_table, only: table_t, new_table, column, row_count
   use ek_trial, only: trial_t, go_through
   use ek_defined_table, only: defined_table
   implicit none(type, external)
   private
   public :: rig_table, values_of

contains

   !> Deck file → model → rig → sweep → table of one case, all of whose states must be found.
   subroutine rig_table(file, case_name, settings, table, trouble, program, defined)
      character(*), intent(in) :: file, case_name
      character(*), intent(in) :: settings(:)                   !! 'group.name.key=value', applied in this order; blank: none
      type(table_t), intent(out) :: table                       !! without a row when there is trouble
      character(:), allocatable, intent(out) :: trouble         !! what went wrong, '' if all is well
      character(*), intent(in), optional :: program             !! whose definitions `defined` has. As with
                                                                !! --definitions, the case then has all quantities
      type(table_t), intent(out), optional :: defined
      type(deck_t) :: deck
      type(trial_t) :: trial
      type(error_t), allocatable :: error
      character(:), allocatable :: place, value
      integer :: k

      call read_deck(file, deck, error)
      do k = 1, size(settings)
         if (allocated(error)) exit
         if (settings(k) == '') cycle
         call split_setting(settings(k), place, value, error)
         if (allocated(error)) exit
         call set_value(deck, place, value, error)
      end do
      if (present(program) .and. .not. allocated(error)) call set_value(deck, 'case.'//case_name//'.quantities', 'all', error)
      call go_through(deck, case_name, error, trial)
      trouble = trial%trouble
      table = trial%table
      if (trouble /= '') table = new_table([character(4) :: 'none'], 0)
      if (.not. present(defined)) return
      defined = table
      if (trouble == '') call defined_table(trial%suspension, table, program, defined)
   end subroutine rig_table

   !> A column as numbers × unit; as many zeros as rows, and a word in `trouble`, when it is not there.
   subroutine values_of(table, name, unit, values, trouble)
      type(table_t), intent(in) :: table
      character(*), intent(in) :: name
      real(wp), intent(in) :: unit                              !! SI value of the column's unit
      real(wp), allocatable, intent(out) :: values(:)
      character(:), allocatable, intent(inout) :: trouble
      values = unit*column(table, name)
      if (size(values) == row_count(table) .and. size(values) > 0) return
      trouble = trouble//'no values of '//name//'; '
      deallocate (values)
      allocate (values(row_count(table)), source=0.0_wp)
   end subroutine values_of

end module ek_rig_table
