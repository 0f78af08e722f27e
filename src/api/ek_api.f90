!> The Fortran interface: everything that a program which calls elastokin needs.
!>
!>     use ek_api
!>     type(session_t), target :: session
!>     type(case_result_t), pointer :: result
!>     type(error_t), allocatable :: error
!>     call open_file('axle.nml', session, error)
!>     call set_number(session, 'bushing.lca_front.kt(1)', 500.0_wp, error)      in the unit of the deck, as --set
!>     call solve(session, 'parallel_travel', error)
!>     result => result_of(session)
!>     toe = column(result%table, 'left_toe_deg')
!>
!> `error` has the message and the exit status of the program for the same fault; look at it after every call. Nothing is printed,
!> nothing is kept outside the session: different sessions may be used by different threads at a time. gfortran keeps the length of a
!> text that a function returns in one place for all threads, so everything that makes texts is done in the critical section `ek_words`;
!> solutions after the first of a case are numbers only and run at the same time.
module ek_api
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_table, only: table_t, column, column_index
   use ek_case_result, only: case_result_t
   use ek_session, only: session_t, open_file, open_text, set_number, set_text, get_number, set_all, reset, checksum_of
   use ek_session_solution, only: solve, result_of, read_remark, compliance_at
   use ek_session_numbers, only: read_key_numbers
   implicit none(type, external)
   private
   public :: wp, error_t, table_t, column, column_index, case_result_t, session_t, open_file, open_text, set_number, set_text, &
      get_number, set_all, reset, checksum_of, solve, result_of, read_remark, compliance_at, read_key_numbers

end module ek_api
