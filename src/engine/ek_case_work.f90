!> A case of a workspace: its numbers, its stage at the present design, and its solution.
module ek_case_work
   use ek_suspension, only: suspension_t
   use ek_case, only: case_t, copy_case_numbers, is_mountable
   use ek_examination, only: recognise_case, known_case_t
   use ek_rig, only: mount_again
   use ek_standard_tests, only: cover_rack_travel
   use ek_sweep_table, only: observer_t
   use ek_case_result, only: case_result_t
   implicit none(type, external)
   private
   public :: case_work_t, renew_case, make_room, examine_again, put_on_rig
   public :: not_examined, examined, on_rig

   ! stages of a case at the present numbers, each after the one before
   integer, parameter :: not_examined = 0
   integer, parameter :: examined = 1       !! the model on the rig of the case has no defect
   integer, parameter :: on_rig = 2         !! the case is examined and on the rig, with a model without the preloads of the preload
                                            !! trim (`balance`)

   type :: case_work_t
      type(case_t) :: case                        !! the case at the present design, as in the deck
      integer :: number = 0                       !! index in the deck; 0: a standard test
      integer :: stage = not_examined
      type(known_case_t) :: known                 !! properties that examine_case has proved for all designs
      class(observer_t), allocatable :: observer  !! observer of the columns of its results
      class(case_result_t), allocatable :: result !! result of the present design; contains the case on the rig. Reason for the
                                                  !! class: gfortran copies a type with a class component by calling a procedure.
                                                  !! Without the class, gfortran writes out the copy at each use, and the program
                                                  !! grows
   end type case_work_t

contains

   !> Renews the numbers of a case at a design. A standard test is adapted to the rack travel of the design.
   subroutine renew_case(suspension, deck_cases, this)
      type(suspension_t), intent(in) :: suspension
      type(case_t), intent(in) :: deck_cases(:)            !! cases of the deck at the present numbers
      type(case_work_t), intent(inout) :: this

      if (this%number > 0) then
         call copy_case_numbers(deck_cases(this%number), this%case)
      else
         call cover_rack_travel(suspension, this%case)
      end if
   end subroutine renew_case

   !> Allocates the work space of a case before its first solution.
   subroutine make_room(this)
      type(case_work_t), intent(inout) :: this
      if (.not. allocated(this%result)) allocate (this%result)
      if (.not. allocated(this%observer)) allocate (this%observer)
   end subroutine make_room

   !> Renews the numbers of a case and examines the design on the rig of the case. is_sound is .false. if the case cannot be put on
   !> the rig, or if the design may have a defect. examine_case then finds the reason and creates strings.
   subroutine examine_again(suspension, deck_cases, this, is_sound)
      type(suspension_t), intent(in) :: suspension         !! realised, without the preload trim
      type(case_t), intent(in) :: deck_cases(:)            !! cases of the deck at the present numbers
      type(case_work_t), intent(inout) :: this
      logical, intent(out) :: is_sound

      call renew_case(suspension, deck_cases, this)
      is_sound = is_mountable(this%case)
      if (.not. is_sound) return
      call make_room(this)
      call recognise_case(suspension, this%case, this%known, this%result%mounted_case_t, is_sound)
      if (is_sound) this%stage = on_rig
   end subroutine examine_again

   !> Puts a case on the rig with a balanced model. If the model needs neither a preload trim nor a start state, a case that is
   !> already on the rig is unchanged.
   subroutine put_on_rig(suspension, this, keeps_scales)
      type(suspension_t), intent(in) :: suspension         !! balanced
      type(case_work_t), intent(inout) :: this
      logical, intent(in), optional :: keeps_scales        !! as for renew_kkt

      if (this%stage == on_rig .and. suspension%balance == 'none' .and. suspension%start == '') return
      call make_room(this)
      call mount_again(suspension, this%case, this%result%mounted_case_t, keeps_scales)
      if (this%stage == on_rig) this%stage = examined      ! with the preloads of balance
   end subroutine put_on_rig

end module ek_case_work
