!> The Fortran interface: all procedures and types for programs that call elastokin.
!>
!>     use ek_api
!>     type(session_t), target :: session
!>     type(case_result_t), pointer :: result
!>     type(error_t), allocatable :: error
!>     type(model_remarks_t) :: remarks
!>     call open_file('axle.nml', session, error)
!>     call find_remarks(session, remarks, error)                                remarks%warnings, remarks%doubts, as printed by run
!>     call set_number(session, 'bushing.lca_front.kt(1)', 500.0_wp, error)      in the unit of the deck, as --set
!>     call solve(session, 'parallel_travel', error)
!>     result => result_of(session)
!>     toe = column(result%table, 'left_toe_deg')
!>     call copy_session(session, other, error)                                  the same deck and changes, no file is read again
!>     call find_slopes(session, row, columns, paths, slopes, errors, error)     exact derivatives in a row of the solution
!>     call poses_at(session, row, rotation, shift, error)                       motion of the bodies from design to this row
!>
!> `error` has the message and the exit status of the program for the same error; check `error` after every call. Nothing is
!> printed, and nothing is stored outside the session: different threads may use different sessions at the same time. gfortran
!> stores the length of a string that a function returns in one location for all threads. Therefore, only one thread at a time
!> creates strings (ek_words). Solutions after the first of a case create no strings and run at the same time.
module ek_api
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_table, only: table_t, column, column_index
   use ek_case_result, only: case_result_t
   use ek_session, only: session_t, open_file, open_text, checksum_of, copy_session, opened_files, open_files, used_deck, &
      find_remarks
   use ek_session_settings, only: set_number, set_text, get_number, set_all, reset
   use ek_kept_files, only: kept_files_t
   use ek_session_solution, only: solve, result_of, read_remark, compliance_at, find_slopes, read_key_numbers
   use ek_session_poses, only: poses_at
   use ek_model_remark, only: model_remarks_t, read_model_remark
   implicit none(type, external)
   private
   public :: wp, error_t, table_t, column, column_index, case_result_t, session_t, open_file, open_text, set_number, set_text, &
      get_number, set_all, reset, checksum_of, solve, result_of, read_remark, compliance_at, find_slopes, &
      read_key_numbers, find_remarks, model_remarks_t, read_model_remark, copy_session, opened_files, open_files, &
      kept_files_t, used_deck, poses_at

end module ek_api
