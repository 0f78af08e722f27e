!> elastokin-bench --growth N: growth of the time of an increment and of the memory with the size of the model.
!>
!> Chains with matrices of about 100, 200, 400, 1000 and 2000 rows, but at most N, are lifted at their end. All chains
!> are solved by plan first and then by LAPACK, so that the peak memory of the process shows the memory of each solver. The models
!> are not examined (`check`): the time of this examination grows as the time of LAPACK does.
!>
!> A chain consists of equal bodies in a row along x. Each body is connected to the body before it, and the first body to the
!> chassis, by a spherical joint at the beginning of the body. A bushing above each joint prevents rotation. A driver lifts the end
!> of the last body. A body has 6 unknowns and its joint has 3 rows, so that the matrix of b bodies has 9 b + 1 rows.
module ek_growth
   use ek_kinds, only: wp, i8
   use ek_error, only: error_t, fail, exit_usage, exit_convergence
   use ek_text, only: str
   use ek_clock, only: seconds
   use ek_buffer, only: buffer_t
   use ek_json, only: json_t, json_string, json_number
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_kkt, only: kkt_t, new_kkt
   use ek_path, only: path_t
   use ek_increment_parts, only: parts_t, time_walk, time_parts, processor_seconds
   use ek_command_line, only: command_line_t
   use ek_console, only: print_text
   use ek_deck, only: deck_t, parse_deck
   use ek_reader, only: build_model
   use ek_rig, only: mount
   implicit none(type, external)
   private
   public :: bench_growth, bodies_of, read_chain

   integer, parameter :: pitch = 100      ! mm: length of a body

   character(*), parameter :: nl = new_line('a')
   integer, parameter :: rows(*) = [100, 200, 400, 1000, 2000]     !! approximate number of rows of the matrices
   integer, parameter :: lift = 25                !! lift of the end of each chain [mm]: 50 increments
   integer, parameter :: rounds = 15              !! walks of each chain; the shortest counts
   real(wp), parameter :: patience = 1.0_wp       !! elapsed time after which a chain is not walked again [s]

   !> The times and the memory for one size of the chain.
   type :: size_t
      integer :: n = 0, bodies = 0
      integer :: nonzeros = 0, length = 0         !! entries of the lower triangle; numbers in the factors by plan
      integer :: fallbacks = 0                    !! factorisations repeated by LAPACK
      real(wp) :: analysis = 0.0_wp               !! time to find the plans [s]
      real(wp) :: peak(2) = 0.0_wp                !! peak memory of the process after each solver [MB]; 0: not known
      type(parts_t) :: parts(2)                   !! times by plan, times by LAPACK
   end type size_t

   integer, parameter :: by_plan = 1, by_lapack = 2

contains

   !> Times all chains and prints the results to standard output as a table; with --json, as an object.
   subroutine bench_growth(line, error)
      type(command_line_t), intent(in) :: line
      type(error_t), allocatable, intent(out) :: error
      type(size_t), allocatable :: sizes(:)
      character(13), parameter :: of_decks(*) = [character(13) :: '--case', '--increments', '--set', '--derivatives']
      integer :: k, solver

      if (line%files%count() > 0) call fail(error, exit_usage, '--growth builds its own models; omit the deck')
      do k = 1, size(of_decks)
         if (allocated(error)) return
         if (line%has(trim(of_decks(k)))) &
            call fail(error, exit_usage, '--growth builds its own models; omit '//trim(of_decks(k)))
      end do
      if (.not. allocated(error) .and. line%number('--growth') < rows(1)) &
         call fail(error, exit_usage, '--growth: expected a size of at least '//str(rows(1))//', found '//line%value('--growth'))
      if (allocated(error)) return
      allocate (sizes(count(rows <= line%number('--growth'))))
      do solver = by_plan, by_lapack
         do k = 1, size(sizes)
            call time_chain(rows(k), solver, sizes(k), error)
            if (allocated(error)) return
         end do
      end do
      if (line%has('--json')) then
         call print_text(json_of(sizes)//nl, error)
      else
         call print_text(table_of(sizes), error)
      end if
   end subroutine bench_growth

   !> Times a chain with one of the solvers, and stores the peak memory.
   subroutine time_chain(n, solver, this, error)
      integer, intent(in) :: n, solver
      type(size_t), intent(inout) :: this
      type(error_t), allocatable, intent(out) :: error
      type(suspension_t) :: suspension
      type(case_t) :: case
      type(kkt_t) :: kkt
      type(path_t) :: path
      real(wp) :: start, spent
      integer :: k

      call read_chain(bodies_of(n), lift, suspension, case, error)
      if (allocated(error)) return
      start = processor_seconds()
      kkt = new_kkt(suspension, wants_plan=solver == by_plan)
      spent = processor_seconds() - start
      this%n = kkt%n
      this%bodies = bodies_of(n)
      if (solver == by_plan) then
         this%analysis = spent
         this%nonzeros = kkt%pattern%entries
         this%length = kkt%plan(1)%length
      end if
      start = seconds()
      do k = 1, rounds
         call time_walk(suspension, case, path, kkt, this%parts(solver))
         if (any(path%failure%state > 0)) call fail(error, exit_convergence, 'the chain of '//str(this%bodies)// &
            ' bodies does not converge at every state and cannot be timed')
         if (allocated(error)) return
         if (seconds() - start > patience) exit
      end do
      call time_parts(suspension, case, path, kkt, this%parts(solver))
      this%fallbacks = this%fallbacks + kkt%fallbacks
      this%peak(solver) = peak_memory()
   end subroutine time_chain

   !> The largest memory of this process so far [MB]; 0 if the system does not report it.
   real(wp) function peak_memory() result(peak)
      character(80) :: line
      integer(i8) :: kilobytes
      integer :: unit, status, k

      peak = 0.0_wp
      open (newunit=unit, file='/proc/self/status', action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, 'VmHWM:') /= 1) cycle
         read (line(7:index(line, 'kB') - 1), *, iostat=status) kilobytes
         if (status == 0) peak = kilobytes/1024.0_wp
         exit
      end do
      close (unit, iostat=k)
   end function peak_memory

   !> The results of all sizes as lines for the terminal.
   function table_of(sizes) result(text)
      type(size_t), intent(in) :: sizes(:)
      character(:), allocatable :: text
      type(buffer_t) :: table
      character(200) :: line
      integer :: k, last

      call table%line('chain of bodies on spherical joints and bushings, lifted at its end in '//str(2*lift)//' increments')
      call table%line('    n  bodies   LAPACK us     plan us   ratio  by plan: assembly   factor    solve     rest'// &
         '  analysis ms  nonzeros  with fill')
      do k = 1, size(sizes)
         associate (this => sizes(k), plan => sizes(k)%parts(by_plan), lapack => sizes(k)%parts(by_lapack))
            write (line, '(i5,i8,2f12.1,f8.1,f19.1,3f9.1,f13.1,i10,i11)') this%n, this%bodies, &
               1.0e6_wp*[lapack%increment, plan%increment], lapack%increment/plan%increment, &
               1.0e6_wp*[plan%assembly, plan%factor, plan%solve, plan%rest], 1.0e3_wp*this%analysis, this%nonzeros, this%length
            call table%line(trim(line))
            if (this%fallbacks > 0) call table%line('by LAPACK instead of the plan: '//str(this%fallbacks)//' factorisations')
         end associate
      end do
      last = size(sizes)
      if (sizes(last)%peak(by_plan) > 0.0_wp) then
         write (line, '(a,*(f8.1))') 'peak memory of the process by plan [MB]:', sizes%peak(by_plan)
         call table%line(trim(line))
         write (line, '(a,*(f8.1))') 'and after that by LAPACK [MB]:          ', sizes%peak(by_lapack)
         call table%line(trim(line))
      end if
      if (last > 1) then
         write (line, '(2(a,i0),2(a,f0.2))') 'from n = ', sizes(last - 1)%n, ' to ', sizes(last)%n, &
            ' the time of an increment grows as n to the power of: by plan ', power(by_plan), ', by LAPACK ', power(by_lapack)
         call table%line(trim(line))
      end if
      text = table%text()

   contains

      !> The exponent of the growth of the time with the matrix size, from the last two sizes.
      real(wp) function power(solver)
         integer, intent(in) :: solver
         power = log(sizes(last)%parts(solver)%increment/sizes(last - 1)%parts(solver)%increment)/ &
            log(real(sizes(last)%n, wp)/sizes(last - 1)%n)
      end function power

   end function table_of

   !> The results of all sizes as a JSON object.
   function json_of(sizes) result(text)
      type(size_t), intent(in) :: sizes(:)
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: k

      call json%open('{')
      call json%item('model', json_string('chain'))
      call json%item('increments', str(2*lift))
      call json%open('[', 'sizes')
      do k = 1, size(sizes)
         associate (this => sizes(k), plan => sizes(k)%parts(by_plan), lapack => sizes(k)%parts(by_lapack))
            call json%open('{')
            call json%item('n', str(this%n))
            call json%item('bodies', str(this%bodies))
            call json%item('lapack_us', json_number(lapack%increment*1.0e6_wp))
            call json%item('plan_us', json_number(plan%increment*1.0e6_wp))
            call json%item('ratio', json_number(lapack%increment/plan%increment))
            call json%item('plan_assembly_us', json_number(plan%assembly*1.0e6_wp))
            call json%item('plan_factor_us', json_number(plan%factor*1.0e6_wp))
            call json%item('plan_solve_us', json_number(plan%solve*1.0e6_wp))
            call json%item('plan_rest_us', json_number(plan%rest*1.0e6_wp))
            call json%item('analysis_ms', json_number(this%analysis*1.0e3_wp))
            call json%item('nonzeros', str(this%nonzeros))
            call json%item('with_fill', str(this%length))
            call json%item('fallbacks', str(this%fallbacks))
            if (this%peak(by_plan) > 0.0_wp) then
               call json%item('plan_peak_mb', json_number(this%peak(by_plan)))
               call json%item('lapack_peak_mb', json_number(this%peak(by_lapack)))
            end if
            call json%close('}')
         end associate
      end do
      call json%close(']')
      call json%close('}')
      text = json%text()
   end function json_of

   !> The number of bodies of the chain whose number of matrix rows is closest to n.
   pure integer function bodies_of(n)
      integer, intent(in) :: n            !! number of matrix rows, at least 10
      bodies_of = max(nint((n - 1)/9.0_wp), 1)
   end function bodies_of

   !> Reads the deck of a chain and mounts its case on the rig.
   subroutine read_chain(bodies, lift, suspension, case, error)
      integer, intent(in) :: bodies
      integer, intent(in) :: lift         !! lift of the end [mm], with two increments per millimetre
      type(suspension_t), intent(out) :: suspension
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(deck_t) :: deck
      type(suspension_t) :: base
      type(case_t), allocatable :: cases(:)

      call parse_deck(deck_text(bodies, lift), 'chain', deck, error)
      if (.not. allocated(error)) call build_model(deck, base, cases, error)
      if (.not. allocated(error)) call mount(base, cases(1), suspension, case)
   end subroutine read_chain

   !> The chain as the content of a deck.
   function deck_text(bodies, lift) result(text)
      integer, intent(in) :: bodies, lift      !! number of bodies; lift of the end [mm]
      character(:), allocatable :: text
      type(buffer_t) :: deck
      character(:), allocatable :: this, ends
      integer :: k

      call deck%line('&model name = ''chain'' /')
      ends = '''chassis'', '
      do k = 1, bodies
         this = str(k)
         call deck%line('&point name = ''low_'//this//''', at = '//str(pitch*(k - 1))//', 0, 0 /')
         call deck%line('&point name = ''high_'//this//''', at = '//str(pitch*(k - 1))//', 0, 40 /')
         call deck%line('&body name = ''link_'//this//''' /')
         call deck%line('&joint name = ''ball_'//this//''', type = ''spherical'', bodies = '//ends//'''link_'//this// &
            ''', at = ''low_'//this//''' /')
         call deck%line('&bushing name = ''bush_'//this//''', bodies = '//ends//'''link_'//this//''', at = ''high_'//this// &
            ''', kt = 3*1000, kr = 3*100000 /')
         ends = '''link_'//this//''', '
      end do
      call deck%line('&point name = ''end'', at = '//str(pitch*bodies)//', 0, 0 /')
      call deck%line('&measure name = ''height'', type = ''global_gap'', bodies = ''chassis'', ''link_'//str(bodies)// &
         ''', at = ''end'', axis_vector = 0, 0, 1 /')
      call deck%line('&joint name = ''hand'', type = ''driver'', measure = ''height'' /')
      call deck%line('&case name = ''lift'', drive = ''hand'', from = 0, to = '//str(lift)//', increments = '// &
         str(2*lift)//' /')
      text = deck%text()
   end function deck_text

end module ek_growth
