!> One design after the other of a deck: the design space, the cases that are solved, and the present design.
!>
!> The first design is read from the text (make_worker); the others are numbers (change_design), and only a design outside the
!> range of the blueprint, or one that may have a defect, is read again, for the message or another topology. change_design calls
!> no function with a text result: gfortran keeps the length of such a text in one place for all threads.
module ek_worker
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck, exit_model
   use ek_text, only: quoted, did_you_mean
   use ek_group, only: word_length
   use ek_deck, only: deck_t
   use ek_reader, only: design_t, read_design, realise_deck
   use ek_parameter, only: choice_t, in_range
   use ek_realise, only: realise, realise_cases
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, copy_case_numbers, is_mountable, prefer_plan
   use ek_balance, only: balance
   use ek_preload_problem, only: preload_problem_t
   use ek_diagnosis, only: diagnosis_t
   use ek_rig, only: mount_again, take_off
   use ek_standard_tests, only: standard_tests, cover_rack_travel
   use ek_sweep_table, only: observer_t
   use ek_case_result, only: case_result_t
   use ek_examination, only: examine_case, known_case_t, check_inputs
   use ek_study, only: by_value, by_delta, not_given
   implicit none(type, external)
   private
   public :: worker_t, worker_case_t, factor_paths_t, make_worker, change_design, examine_design, refresh_case, put_factor
   public :: deck_value

   !> The parameters of one factor.
   type :: factor_paths_t
      integer :: change = by_value                !! see ek_study
      type(choice_t), allocatable :: found(:)
   end type factor_paths_t

   !> One of the cases that are solved, and its solution.
   type :: worker_case_t
      type(case_t) :: case                        !! of the present design, as in the deck
      integer :: number = 0                       !! in the deck; 0: a standard test
      type(known_case_t) :: known                 !! what the first design has proved about the others
      class(observer_t), allocatable :: observer  !! of the columns of its results, for solve_case
      class(case_result_t), allocatable :: result !! of the present design; change_design puts the case on the rig. Classes:
                                                  !! gfortran copies a type that holds one by calling a procedure; otherwise it
                                                  !! writes out the copy at each use, and the program grows
   end type worker_case_t

   !> A worker, which solves the designs of a deck one after the other.
   type :: worker_t
      type(suspension_t) :: suspension            !! of the present design, balanced
      type(worker_case_t), allocatable :: cases(:)
      type(design_t) :: design
      real(wp), allocatable :: x(:)               !! of the present design
      type(preload_problem_t), private :: space   !! of balance
   end type worker_t

contains

   !> Builds the model of a deck, examines it on the rig of each case ('': the first of the deck) and balances it.
   !>
   !> A study passes the same worker with each design of a deck: what does not change between designs is then checked once.
   subroutine make_worker(deck, case_names, worker, error, increments)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: case_names(:)
      type(worker_t), intent(inout) :: worker
      type(error_t), allocatable, intent(out) :: error
      integer, intent(in), optional :: increments          !! of all cases; absent or 0: those of the deck
      type(diagnosis_t) :: diagnosis
      integer :: k

      if (allocated(worker%cases)) then
         if (size(worker%cases) /= size(case_names)) deallocate (worker%cases)
      end if
      if (.not. allocated(worker%cases)) allocate (worker%cases(size(case_names)))
      call read_design(deck, worker%design, error)
      if (allocated(error)) return
      if (present(increments)) then
         if (increments > 0) worker%design%cases%increments = increments
      end if
      call prefer_plan(worker%design%cases)
      call realise_deck(deck%file, worker%design, worker%suspension, error)
      if (allocated(error)) return
      worker%x = worker%design%parameters%x
      do k = 1, size(case_names)
         call take_case(deck%file, trim(case_names(k)), worker%design%cases, worker%suspension, worker%cases(k), error)
         if (allocated(error)) return
         if (present(increments)) then
            if (increments > 0) worker%cases(k)%case%increments = increments       ! also of a standard test
         end if
      end do
      do k = 1, size(worker%cases)
         ! on the rig from now on: the order of elimination of all designs is that of this one
         call examine_case(worker%suspension, worker%cases(k)%case, diagnosis, worker%cases(k)%known, &
            worker%cases(k)%result%mounted_case_t)
         if (diagnosis%is_solvable()) cycle
         call fail(error, exit_model, deck%file//': the model cannot be solved'//new_line('a')//diagnosis%words())
         return
      end do
      call balance(worker%suspension, worker%cases(1)%case%tolerance, error)
   end subroutine make_worker

   !> Finds a case of the deck, or a standard test of the report that it does not have.
   subroutine take_case(file, name, cases, suspension, found, error)
      character(*), intent(in) :: file, name           !! '': the first of the deck
      type(case_t), intent(in) :: cases(:)
      type(suspension_t), intent(in) :: suspension
      type(worker_case_t), intent(inout) :: found
      type(error_t), allocatable, intent(out) :: error
      type(case_t), allocatable :: tests(:)
      character(word_length), allocatable :: names(:)      !! of all that could be meant
      integer :: k, j

      if (allocated(found%observer)) deallocate (found%observer)
      allocate (found%observer)
      if (.not. allocated(found%result)) allocate (found%result)
      call take_off(found%result%mounted_case_t)
      do k = 1, size(cases)
         if (len(name) == 0 .or. cases(k)%name == name) exit
      end do
      if (k > size(cases)) then
         call standard_tests(suspension, cases, tests)
         do j = 1, size(tests)
            if (len(name) > 0 .and. tests(j)%name == name) exit
         end do
         if (j > size(tests)) then
            allocate (names(size(tests)))
            do j = 1, size(tests)
               names(j) = tests(j)%name
            end do
            call fail(error, exit_deck, file//': there is no case '//quoted(name)//did_you_mean(name, names))
            return
         end if
         found%number = 0
         found%case = tests(j)
         call prefer_plan(found%case)
         return
      end if
      if (cases(k)%follows_arc) then
         call fail(error, exit_deck, file//': case '//quoted(cases(k)%name)//' has follow = ''arc'', where a factor '// &
            'may have several states; a study needs a case with follow = ''factor''')
         return
      end if
      call check_inputs(suspension, cases(k:k), error, is_whole=.not. found%known%is_known)
      if (allocated(error)) return
      found%number = k
      found%case = cases(k)
   end subroutine take_case

   !> Changes to the design with these values of the factors, from the numbers alone, with its cases on the rig. is_done is
   !> .false. if it must be
   !> read from the text: a factor is not a number of the design space, a value is outside its range, or the design may have a
   !> defect.
   subroutine change_design(factors, values, worker, is_done)
      type(factor_paths_t), intent(in) :: factors(:)
      real(wp), intent(in) :: values(:)                    !! in the units of the deck
      type(worker_t), intent(inout) :: worker
      logical, intent(out) :: is_done
      type(error_t), allocatable :: error
      integer :: f, k

      worker%x(:) = worker%design%parameters%x
      is_done = .true.
      do f = 1, size(factors)
         call put_factor(factors(f), values(f), worker)
         is_done = is_done .and. size(factors(f)%found) > 0 .and. in_range(worker%design%parameters, factors(f)%found, worker%x)
      end do
      if (is_done) call realise(worker%design%plan, worker%x, worker%suspension, is_done)
      if (is_done) call realise_cases(worker%design%plan, worker%x, worker%design%cases, is_done)
      if (.not. is_done) return
      do k = 1, size(worker%cases)
         call examine_design(worker%suspension, worker%design, worker%cases(k), is_done)
         if (.not. is_done) return
      end do
      call balance(worker%suspension, worker%cases(1)%case%tolerance, error, is_terse=.true., space=worker%space)
      is_done = .not. allocated(error)
      if (.not. is_done .or. worker%suspension%balance == 'none') return
      do k = 1, size(worker%cases)      ! they were examined without the preloads of balance
         call mount_again(worker%suspension, worker%cases(k)%case, worker%cases(k)%result%mounted_case_t)
      end do
   end subroutine change_design

   !> Copies the numbers of a case from a design and examines the design on the rig of the case. is_sound is .false. if the
   !> case cannot be put on the rig, or if the design may have a defect: it must then be read from the text.
   subroutine examine_design(suspension, design, this, is_sound)
      type(suspension_t), intent(in) :: suspension         !! realised, not balanced
      type(design_t), intent(in) :: design                 !! with the cases of these numbers
      type(worker_case_t), intent(inout) :: this
      logical, intent(out) :: is_sound
      type(diagnosis_t) :: diagnosis
      logical :: is_in_doubt

      call refresh_case(suspension, design, this)
      is_sound = is_mountable(this%case)
      if (.not. is_sound) return
      if (.not. allocated(this%result)) allocate (this%result)
      call examine_case(suspension, this%case, diagnosis, this%known, this%result%mounted_case_t, is_in_doubt)
      is_sound = .not. is_in_doubt
   end subroutine examine_design

   !> Renews the numbers of a case at a design: the numbers of the deck, or of the standard test.
   subroutine refresh_case(suspension, design, this)
      type(suspension_t), intent(in) :: suspension
      type(design_t), intent(in) :: design                 !! with the cases of these numbers
      type(worker_case_t), intent(inout) :: this

      if (this%number > 0) then
         call copy_case_numbers(design%cases(this%number), this%case)
      else
         call cover_rack_travel(suspension, this%case)
      end if
   end subroutine refresh_case

   !> Writes a factor into x; relative to the numbers of the deck, or instead of them. The right side of an axle takes the value
   !> with its sign (ek_parameter).
   pure subroutine put_factor(factor, value, worker)
      type(factor_paths_t), intent(in) :: factor
      real(wp), intent(in) :: value
      type(worker_t), intent(inout) :: worker
      integer :: j

      do j = 1, size(factor%found)
         associate (number => factor%found(j)%number, sign => factor%found(j)%sign)
            associate (unit => worker%design%parameters%list(number)%unit, at => worker%x(number))
               select case (factor%change)
               case (by_value)
                  at = (sign*value)*unit
               case (by_delta)
                  at = at + (sign*value)*unit
               case default
                  at = at*value
               end select
            end associate
         end associate
      end do
   end subroutine put_factor

   !> The number of the deck that a factor changes, in the unit of the deck; NaN if there are several that differ.
   pure real(wp) function deck_value(worker, factor) result(value)
      type(worker_t), intent(in) :: worker
      type(factor_paths_t), intent(in) :: factor
      real(wp) :: this
      integer :: j

      value = not_given()
      do j = 1, size(factor%found)
         associate (number => factor%found(j)%number)
            this = factor%found(j)%sign*worker%design%parameters%x(number)/worker%design%parameters%list(number)%unit
         end associate
         if (j == 1) value = this
         if (abs(this - value) > 1.0e-12_wp*abs(value)) then
            value = not_given()
            exit
         end if
      end do
   end function deck_value

end module ek_worker
