!> Through the front door: a deck on the test rig, and the table that a user would be given.
module ek_rig_table
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str
   use ek_deck, only: deck_t, read_deck, set_value, split_setting
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_rig, only: mount
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_path, only: path_t, sweep
   use ek_table, only: table_t, new_table, column, row_count
   use ek_sweep_table, only: sweep_table
   implicit none(type, external)
   private
   public :: rig_table, values_of

contains

   !> Deck file → model → rig → sweep → table of one case, all of whose states must be found.
   subroutine rig_table(file, case_name, settings, table, trouble)
      character(*), intent(in) :: file, case_name
      character(*), intent(in) :: settings(:)                   !! 'group.name.key=value', applied in this order; blank: none
      type(table_t), intent(out) :: table                       !! without a row when there is trouble
      character(:), allocatable, intent(out) :: trouble         !! what went wrong, '' if all is well
      type(deck_t) :: deck
      type(suspension_t) :: suspension
      type(case_t), allocatable :: cases(:)
      type(error_t), allocatable :: error
      type(path_t) :: path
      type(kkt_t) :: kkt
      character(:), allocatable :: place, value
      integer :: k

      table = new_table([character(4) :: 'none'], 0)
      trouble = ''
      call read_deck(file, deck, error)
      do k = 1, size(settings)
         if (allocated(error)) exit
         if (settings(k) == '') cycle
         call split_setting(settings(k), place, value, error)
         if (allocated(error)) exit
         call set_value(deck, place, value, error)
      end do
      if (.not. allocated(error)) call build_model(deck, suspension, cases, error)
      if (allocated(error)) then
         trouble = error%message
         return
      end if
      do k = 1, size(cases)
         if (cases(k)%name == case_name) exit
      end do
      if (k > size(cases)) then
         trouble = 'no case '//case_name//' in '//file
         return
      end if
      call balance(suspension, cases(k)%tolerance, error)
      if (.not. allocated(error)) call mount(suspension, cases(k), error)
      if (allocated(error)) then
         trouble = error%message
         return
      end if
      kkt = new_kkt(suspension)
      call sweep(suspension, cases(k), path, kkt)
      if (.not. all(path%is_reached)) then
         trouble = file//', '//case_name//': '//str(count(.not. path%is_reached))//' states were not found'
         return
      end if
      call sweep_table(suspension, cases(k), path, kkt, table)
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
