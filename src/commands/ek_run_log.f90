!> The log of this run (--log FILE): one line of JSON, appended when the program ends, whether the run succeeded or failed. Many
!> runs, also at the same time, may share one file.
!>
!>     {"time": "2026-01-31T16:05:09Z", "seconds": 0.31, "status": 0, "host": "node7", "program": "elastokin 0.1.0 (commit …)",
!>      "folder": "/data/batch", "arguments": ["run", "front.nml", …], "decks": [{"file": "front.nml", "checksum": "…"}],
!>      "messages": ["warning: …"], "output": ["out/front_bump.csv"]}
!>
!> This module records the printed output: its state is one run of the program, and only commands use it.
module ek_run_log
   use ek_kinds, only: wp
   use ek_error, only: error_t, message_list_t, fail, exit_usage
   use ek_text, only: str
   use ek_clock, only: seconds, universal_time
   use ek_system, only: host_name, working_folder
   use ek_append_file, only: append_file_t, open_append_file
   use ek_json, only: json_t, json_string, json_number, json_strings
   use ek_command_line, only: command_line_t, argument
   implicit none(type, external)
   private
   public :: begin_log, is_logging, log_message, log_output, log_deck, drop_log, end_log

   character(*), parameter :: log_option = '--log'

   !> The content of the log entry of a run.
   type :: log_t
      character(20) :: time
      real(wp) :: start = 0.0_wp                     !! time of a clock when the log was opened [s]
      type(message_list_t) :: files, checksums       !! names and checksums of the decks that were read
      type(message_list_t) :: messages, output       !! messages; output on standard output, in order
   end type log_t

   type(append_file_t), save :: file
   type(log_t), save :: log

contains

   !> Opens the log file if the command line names one.
   subroutine begin_log(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error        !! exit_file, before any work; exit_usage: --log -

      if (.not. line%has(log_option)) return
      log%time = universal_time()
      log%start = seconds()
      if (line%value(log_option) == '-') then
         call fail(error, exit_usage, '--log: expected a file, found -')
      else
         call open_append_file(line%value(log_option), '{', file, error)
      end if
   end subroutine begin_log

   !> Whether the log of the run is open.
   logical function is_logging()
      is_logging = file%is_open()
   end function is_logging

   !> Logs a note, warning or error as printed. Notes are logged even if --quiet suppresses them.
   subroutine log_message(text)
      character(*), intent(in) :: text
      if (file%is_open()) call log%messages%add(text)
   end subroutine log_message

   !> Logs findings, or the path of a result, as printed on standard output.
   subroutine log_output(text)
      character(*), intent(in) :: text
      integer :: length

      length = len(text)
      if (length > 0) length = length - merge(1, 0, text(len(text):) == new_line('a'))
      if (file%is_open()) call log%output%add(text(:length))
   end subroutine log_output

   !> Logs a deck that was read.
   subroutine log_deck(name, checksum)
      character(*), intent(in) :: name
      character(*), intent(in) :: checksum                    !! with the changes of --set, as in the headings of tables
      if (.not. file%is_open()) return
      call log%files%add(name)
      call log%checksums%add(checksum)
   end subroutine log_deck

   !> Drops the record of this process. In a study with several processes, only the first process writes the record.
   subroutine drop_log()
      call file%close()
   end subroutine drop_log

   !> Appends the record of the run to the log.
   subroutine end_log(program, status, error)
      character(*), intent(in) :: program                     !! name, version and commit
      integer, intent(in) :: status                           !! exit status
      type(error_t), allocatable, intent(out) :: error        !! exit_file
      type(json_t) :: json
      type(message_list_t) :: arguments
      integer :: k

      if (.not. file%is_open()) return
      do k = 1, command_argument_count()
         call arguments%add(argument(k))
      end do
      json%is_one_line = .true.
      call json%open('{')
      call json%item('time', json_string(log%time))
      call json%item('seconds', json_number(anint((seconds() - log%start)*1e6_wp)/1e6_wp))
      call json%item('status', str(status))
      call json%item('host', json_string(host_name()))
      call json%item('program', json_string(program))
      call json%item('folder', json_string(working_folder()))
      call json%item('arguments', json_strings(arguments))
      call json%open('[', 'decks')
      do k = 1, log%files%count()
         call json%open('{')
         call json%item('file', json_string(log%files%line(k)))
         call json%item('checksum', json_string(log%checksums%line(k)))
         call json%close('}')
      end do
      call json%close(']')
      call json%item('messages', json_strings(log%messages))
      call json%item('output', json_strings(log%output))
      call json%close('}')
      call file%add(json%text(), error)
      call file%close()
   end subroutine end_log

end module ek_run_log
