!> Progress of a study for --status, from the chunks in the folder of the study. Another process may be running the study.
module ek_study_survey
   use ek_kinds, only: wp, i8
   use ek_file, only: join_path, file_exists, folder_exists
   use ek_system, only: facts_t, facts_of
   use ek_writer, only: find_users
   use ek_study, only: study_t
   use ek_study_plan, only: study_plan_t, first_of, designs_in
   use ek_study_run, only: parts_folder
   use ek_chunk, only: chunk_t, read_chunk, chunk_name
   implicit none(type, external)
   private
   public :: survey_t, survey_parts, rate_of_chunks

   integer(i8), parameter :: least_time = 20        !! least period of a rate [s]; file times are integers

   !> The progress of a study, from the folder of its chunks.
   type :: survey_t
      integer :: done = 0, failed = 0                !! number of finished designs (with failed designs); number of failed designs
      logical :: is_at_work = .false.                !! a run uses the folder
      real(wp) :: rate = 0.0_wp                      !! finished designs per second in the last period; 0: unknown
   end type survey_t

contains

   !> Reads all chunks in the folder, counts finished and failed designs, and finds the rate of finished designs.
   subroutine survey_parts(study, plan, out, survey)
      type(study_t), intent(in) :: study
      type(study_plan_t), intent(in) :: plan
      character(*), intent(in) :: out
      type(survey_t), intent(out) :: survey
      type(chunk_t) :: chunk
      type(facts_t) :: facts
      character(:), allocatable :: folder, path
      integer(i8) :: times(plan%chunks)
      integer :: designs(plan%chunks), k, n
      logical :: is_good, is_here

      folder = parts_folder(study, out)
      n = 0
      do k = 1, plan%chunks
         path = join_path(folder, chunk_name(k))
         if (.not. file_exists(path)) cycle
         call read_chunk(path, plan%identity, first_of(plan, k), designs_in(plan, k), chunk, is_good)
         if (.not. is_good) cycle
         facts = facts_of(path, follow=.true.)
         n = n + 1
         times(n) = facts%changed
         designs(n) = size(chunk%status)
         survey%failed = survey%failed + count(chunk%status /= 0)
      end do
      survey%done = sum(designs(:n))
      if (folder_exists(folder)) call find_users(folder, survey%is_at_work, is_here)
      survey%rate = rate_of_chunks(times(:n), designs(:n))
   end subroutine survey_parts

   !> Rate of finished designs [1/s] over the last period of at least 20 s in which chunks were written. Chunks written at the
   !> beginning of the period do not count. 0 if all chunks were written in less than 20 s.
   pure real(wp) function rate_of_chunks(times, designs) result(rate)
      integer(i8), intent(in) :: times(:)            !! time when each chunk was written [s]
      integer, intent(in) :: designs(:)              !! number of designs of each chunk
      integer(i8) :: last, begin

      rate = 0.0_wp
      if (size(times) == 0) return
      last = maxval(times)
      if (.not. any(times <= last - least_time)) return
      begin = maxval(times, mask=times <= last - least_time)
      rate = sum(designs, mask=times > begin)/real(last - begin, wp)
   end function rate_of_chunks

end module ek_study_survey
