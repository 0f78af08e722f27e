!> One thread at a time creates strings.
!>
!> If a function returns a string, gfortran stores the length of this string in one location that all threads share (a static
!> variable of the calling procedure). Two threads that call such a function at the same time would read each other's length.
!> Procedures that threads call therefore create strings, and what is made of strings (decks, messages, headings), only
!> between `begin_words` and `end_words`, with no `return` between the two calls. Solutions create no strings and run at the same
!> time.
!>
!> The lock belongs to the program, not to a model: this is the only variable of the library that outlives a call. A thread may
!> begin again before it has ended, as procedures that create strings call each other. Without OpenMP, nothing is locked.
module ek_words
   !$ use omp_lib, only: omp_nest_lock_kind, omp_init_nest_lock, omp_set_nest_lock, omp_unset_nest_lock
   implicit none(type, external)
   private
   public :: begin_words, end_words

   !$ integer(omp_nest_lock_kind), save :: lock
   !$ logical, save :: is_ready = .false.

contains

   !> Waits until no other thread creates strings.
   subroutine begin_words()
      !$omp critical (ek_words)
      !$ if (.not. is_ready) call omp_init_nest_lock(lock)
      !$ is_ready = .true.
      !$omp end critical (ek_words)
      !$ call omp_set_nest_lock(lock)
   end subroutine begin_words

   !> Ends the time in which only this thread creates strings.
   subroutine end_words()
      !$ call omp_unset_nest_lock(lock)
   end subroutine end_words

end module ek_words
