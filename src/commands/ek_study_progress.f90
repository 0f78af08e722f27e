!> Progress of a study: a line on the terminal that overwrites itself, one line per minute in a log, and --status.
module ek_study_progress
   use ek_kinds, only: wp
   use ek_error, only: error_t
   use ek_text, only: str, plural
   use ek_file, only: join_path, file_exists, is_terminal, write_standard_error
   use ek_study_run, only: run_state_t
   use ek_study_survey, only: survey_t, survey_parts
   use ek_study_tables, only: responses_name
   use ek_store, only: choose_store, store_name
   use ek_opened_study, only: opened_study_t
   use ek_console, only: print_note, print_text
   implicit none(type, external)
   private
   public :: show_state, end_state, print_status

   real(wp), parameter :: pause = 60.0_wp            !! time between two lines of a log [s]

contains

   !> Shows the progress: on a terminal in a line that overwrites itself, otherwise as one line per minute.
   subroutine show_state(state)
      type(run_state_t), intent(inout) :: state

      if (state%is_quiet) return
      if (is_terminal(2)) then
         call write_standard_error(achar(13)//'  '//state_text(state)//'   ')
      else if (state%now - state%reported > pause) then
         state%reported = state%now
         call print_note(state%is_quiet, state_text(state))
      end if
   end subroutine show_state

   !> Clears the progress line.
   subroutine end_state(state)
      type(run_state_t), intent(in) :: state
      if (is_terminal(2) .and. .not. state%is_quiet) call write_standard_error(achar(13)//repeat(' ', 78)//achar(13))
   end subroutine end_state

   !> Progress as a line: '1200 of 5000 designs, 850/s, 4 s left, 3 failed'. The rate is the rate of this run only.
   function state_text(state) result(text)
      type(run_state_t), intent(in) :: state
      character(:), allocatable :: text
      real(wp) :: rate

      rate = (state%done - state%before)/max(state%now - state%begun, 1.0e-6_wp)
      text = str(state%done)//' of '//plural(state%wanted, 'design', 'designs')//', '// &
         rate_text(rate, state%wanted - state%done)//str(state%failed)//' failed'
   end function state_text

   !> Rate and remaining time: '850/s, 4 s left, '; '' if the rate is unknown.
   function rate_text(rate, left) result(text)
      real(wp), intent(in) :: rate                   !! designs per second
      integer, intent(in) :: left                    !! designs
      character(:), allocatable :: text

      text = ''
      if (.not. rate > 0.0_wp) return
      if (rate < 99.5_wp) text = str(rate, 2)
      if (.not. rate < 99.5_wp) text = str(nint(rate))
      text = text//'/s, '//time_text(left/rate)//' left, '
   end function rate_text

   !> A time in suitable units: '45 s', '12 min', '3.5 h'.
   function time_text(time) result(text)
      real(wp), intent(in) :: time                   !! s
      character(:), allocatable :: text

      if (time < 120.0_wp) then
         text = str(nint(time))//' s'
      else if (time < 7200.0_wp) then
         text = str(nint(time/60.0_wp))//' min'
      else
         text = str(time/3600.0_wp, 3)//' h'
      end if
   end function time_text

   !> Prints the progress of a study that another process may be running.
   subroutine print_status(this, error)
      type(opened_study_t), intent(in) :: this
      type(error_t), allocatable, intent(out) :: error
      character(:), allocatable :: name
      logical :: has_table, has_store
      type(survey_t) :: now

      call survey_parts(this%study, this%plan, this%out, now)
      call choose_store(this%study, this%plan, has_store, error)
      name = responses_name(this%study)
      if (has_store) name = store_name(this%study)
      if (allocated(error)) return
      has_table = file_exists(join_path(this%out, name))
      if (now%done == 0 .and. has_table) then
         call print_text('study '//this%study%name//': complete, '//join_path(this%out, name)//new_line('a'), error)
      else
         name = 'study '//this%study%name//': '//str(now%done)//' of '//plural(this%plan%designs, 'design', 'designs')// &
            ' done, '
         if (now%is_at_work) name = name//rate_text(now%rate, this%plan%designs - now%done)
         name = name//str(now%failed)//' failed'
         if (.not. now%is_at_work) name = name//'; no run is at work'
         call print_text(name//new_line('a'), error)
      end if
   end subroutine print_status

end module ek_study_progress
