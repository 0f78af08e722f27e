!> consumer DECK: reads a deck, sweeps its first case and prints toe at both ends, by the library alone.
program consumer
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ek_case, only: case_t
   use ek_deck, only: deck_t, read_deck
   use ek_error, only: error_t
   use ek_kinds, only: wp
   use ek_kkt, only: kkt_t, new_kkt
   use ek_path, only: path_t, sweep
   use ek_reader, only: build_model
   use ek_suspension, only: suspension_t
   use ek_sweep_table, only: sweep_table
   use ek_table, only: table_t, column
   implicit none(type, external)
   type(error_t), allocatable :: error
   type(deck_t) :: deck
   type(suspension_t) :: suspension
   type(case_t), allocatable :: cases(:)
   type(kkt_t) :: kkt
   type(path_t) :: path
   type(table_t) :: table
   real(wp), allocatable :: toe(:)
   character(1000) :: file

   call get_command_argument(1, file)
   call read_deck(trim(file), deck, error)
   call stop_on(error)
   call build_model(deck, suspension, cases, error)
   call stop_on(error)
   kkt = new_kkt(suspension)
   call sweep(suspension, cases(1), path, kkt)
   call sweep_table(suspension, cases(1), path, kkt, table)
   toe = column(table, 'toe_deg')
   write (*, '(a,2f9.4)') 'toe [deg] at both ends:', toe(1), toe(size(toe))

contains

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      stop 1, quiet=.true.
   end subroutine stop_on

end program consumer
