!> One case of a deck as `elastokin run` goes through it: read, put on the rig, swept, tabulated.
!>
!> Further groups may be appended to the deck; the last case is the one that runs. And what a test reads off
!> its states without asking the code under test: the elastic energy, and what the chassis bears.
module ek_trial
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ek_kinds, only: wp
   use ek_error, only: error_t, fail, exit_deck, exit_file
   use ek_file, only: read_whole
   use ek_deck, only: deck_t, parse_deck
   use ek_reader, only: build_model
   use ek_measure, only: measure_value
   use ek_differences, only: measure_gradient
   use ek_elastic, only: bushing_evaluation_t, evaluate_bushing
   use ek_element_force, only: spring_tension
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t
   use ek_state, only: state_t, inputs_t
   use ek_schedule, only: new_schedule, inputs_at
   use ek_kkt, only: kkt_t, new_kkt
   use ek_balance, only: balance
   use ek_path, only: path_t, sweep
   use ek_rig, only: mount
   use ek_reading, only: state_of
   use ek_sweep_table, only: sweep_table
   use ek_table, only: table_t, new_table, column, column_index, row_count
   use ek_attitude, only: vertical_force
   implicit none(type, external)
   private
   public :: trial_t, try, go_through, put_on_rig, values, elastic_energy, chassis_lift, wheel_force, differs

   type :: trial_t
      type(suspension_t) :: suspension      !! on the rig
      type(case_t) :: case
      type(path_t) :: path
      type(kkt_t) :: kkt
      type(table_t) :: table                !! without rows when there is trouble
      character(:), allocatable :: trouble  !! the error, '' for none
      integer :: code = 0                   !! its code
   end type trial_t

contains

   !> Runs the last case of a deck with more groups behind it.
   subroutine try(file, groups, trial)
      character(*), intent(in) :: file, groups
      type(trial_t), intent(out) :: trial
      type(deck_t) :: deck
      type(error_t), allocatable :: error
      character(:), allocatable :: text

      call read_whole(file, text, error)
      if (.not. allocated(error)) call parse_deck(text//new_line('a')//groups, file, deck, error)
      call go_through(deck, '', error, trial)
   end subroutine try

   !> Runs one case of a deck: builds, balances, mounts, sweeps, tabulates.
   subroutine go_through(deck, case_name, error, trial)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: case_name                       !! '': the last one
      type(error_t), allocatable, intent(inout) :: error          !! of reading the deck; then nothing is done
      type(trial_t), intent(out) :: trial
      type(case_t), allocatable :: cases(:)
      integer :: k

      trial%table = new_table([character(4) :: 'none'], 0)
      trial%trouble = ''
      if (.not. allocated(error)) call build_model(deck, trial%suspension, cases, error)
      if (.not. allocated(error)) then
         do k = size(cases), 1, -1
            if (case_name == '' .or. cases(k)%name == case_name) exit
         end do
         if (k == 0) then
            trial%trouble = 'no case '//case_name//' in '//deck%file
            return
         end if
         trial%case = cases(k)
         call balance(trial%suspension, trial%case%tolerance, error)
      end if
      if (.not. allocated(error)) call put_on_rig(trial%suspension, trial%case, error)
      if (allocated(error)) then
         trial%trouble = error%message
         trial%code = error%code
         return
      end if
      trial%kkt = new_kkt(trial%suspension)
      call sweep(trial%suspension, trial%case, trial%path, trial%kkt)
      call sweep_table(trial%suspension, trial%case, trial%path, trial%kkt, trial%table)
      if (.not. all(trial%path%is_reached)) trial%trouble = 'not all states were reached'
   end subroutine go_through

   !> Puts a suspension on the rig for a case, whose table has no mistakes, and keeps the case with its actuations.
   subroutine put_on_rig(suspension, case, error)
      type(suspension_t), intent(inout) :: suspension
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(out) :: error      !! of the table
      type(suspension_t) :: base
      type(case_t) :: given

      base = suspension
      given = case
      if (given%table%mistakes%count() > 0) then
         call fail(error, merge(exit_file, exit_deck, allocated(given%table%fault)), given%table%mistakes%text())
      else
         call mount(base, given, suspension, case)
      end if
   end subroutine put_on_rig

   !> A column; one value that is not a number, which equals nothing, when it is not there.
   function values(trial, name) result(list)
      type(trial_t), intent(in) :: trial
      character(*), intent(in) :: name
      real(wp), allocatable :: list(:)

      if (column_index(trial%table, name) > 0 .and. row_count(trial%table) > 0) then
         list = column(trial%table, name)
      else
         allocate (list(1), source=ieee_value(1.0_wp, ieee_quiet_nan))
      end if
   end function values

   !> Energy of springs and bushings at each state [J]: ½ k e² − preload × e, component by component.
   function elastic_energy(trial) result(energy)
      type(trial_t), intent(in) :: trial
      real(wp) :: energy(trial%path%states)
      type(state_t) :: state
      type(bushing_evaluation_t) :: evaluation
      real(wp) :: e, d(3), turn(3)
      integer :: s, k

      energy = 0.0_wp
      do s = 1, trial%path%states
         state = state_of(trial%suspension, trial%path, s)
         do k = 1, trial%suspension%scalars
            associate (spring => trial%suspension%elements(k), m => trial%suspension%elements(k)%measure)
               e = measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1)) - spring%design_length
               energy(s) = energy(s) + 0.5_wp*spring%law%rate*e**2 - spring%preload*e
            end associate
         end do
         do k = 1, size(trial%suspension%elements) - trial%suspension%scalars
            associate (b => trial%suspension%elements(trial%suspension%scalars + k)%bushing, &
               m => trial%suspension%elements(trial%suspension%scalars + k)%measure)
               call evaluate_bushing(b, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
               d = matmul(transpose(b%axes), evaluation%gap)
               turn = matmul(transpose(b%axes), evaluation%rotation%theta)
               energy(s) = energy(s) + sum(0.5_wp*b%kt*d**2 - b%preload_force*d) &
                  + sum(0.5_wp*b%kr*turn**2 - b%preload_moment*turn)
            end associate
         end do
      end do
   end function elastic_energy

   !> What the chassis exerts upward on all bodies together, at each state [N]: by springs, bushings and the
   !> deck's joints, not by the rig.
   function chassis_lift(trial) result(lift)
      type(trial_t), intent(in) :: trial
      real(wp) :: lift(trial%path%states)
      type(state_t) :: state
      type(bushing_evaluation_t) :: evaluation
      real(wp) :: tension, slope, gradient(12)
      integer :: s, k, t

      lift = 0.0_wp
      do s = 1, trial%path%states
         state = state_of(trial%suspension, trial%path, s)
         do k = 1, trial%suspension%scalars
            associate (m => trial%suspension%elements(k)%measure)
               call spring_tension(trial%suspension%elements(k), &
                  measure_value(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1)), tension, slope)
               gradient = tension*measure_gradient(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
               call include(m%body_i, m%body_j)
            end associate
         end do
         do k = 1, size(trial%suspension%elements) - trial%suspension%scalars
            associate (b => trial%suspension%elements(trial%suspension%scalars + k)%bushing, &
               m => trial%suspension%elements(trial%suspension%scalars + k)%measure)
               call evaluate_bushing(b, m, state%poses(m%body_i + 1), state%poses(m%body_j + 1), evaluation)
               gradient = 0.0_wp
               gradient(3) = -evaluation%force(3)
               gradient(9) = evaluation%force(3)
               call include(m%body_i, m%body_j)
            end associate
         end do
         do k = 1, trial%suspension%own_rows()
            do t = trial%suspension%rows(k)%first, trial%suspension%rows(k)%first + trial%suspension%rows(k)%terms - 1
               associate (term => trial%suspension%terms(t), m => trial%suspension%terms(t)%measure)
                  gradient = state%reaction(k)*term%coefficient* &
                     measure_gradient(m, state%poses(m%body_i + 1), state%poses(m%body_j + 1))
                  call include(m%body_i, m%body_j)
               end associate
            end do
         end do
      end do

   contains

      !> The force on the body that moves, of an element between it and the chassis.
      subroutine include(body_i, body_j)
         integer, intent(in) :: body_i, body_j
         if (body_i == 0 .and. body_j > 0) lift(s) = lift(s) - gradient(9)
         if (body_j == 0 .and. body_i > 0) lift(s) = lift(s) - gradient(3)
      end subroutine include

   end function chassis_lift

   !> The vertical force of the ground on a wheel at each state [N].
   function wheel_force(trial, wheel) result(force)
      type(trial_t), intent(in) :: trial
      integer, intent(in) :: wheel
      real(wp) :: force(trial%path%states)
      type(inputs_t) :: inputs
      integer :: s

      do s = 1, trial%path%states
         call inputs_at(new_schedule(trial%suspension, trial%case), trial%path%value(s), inputs)
         force(s) = vertical_force(trial%suspension, state_of(trial%suspension, trial%path, s), inputs, wheel)
      end do
   end function wheel_force

   !> Whether two numbers differ; two that are not numbers do not. Debug builds trap other comparisons of them.
   elemental logical function differs(a, b)
      real(wp), intent(in) :: a, b

      if (ieee_is_nan(a) .or. ieee_is_nan(b)) then
         differs = ieee_is_nan(a) .neqv. ieee_is_nan(b)
      else
         differs = abs(a - b) > 0.0_wp
      end if
   end function differs

end module ek_trial
