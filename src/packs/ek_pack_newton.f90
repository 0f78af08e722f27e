!> Newton's method for four designs at the same time. Each design takes the steps of find_equilibrium (ek_newton).
!>
!> A design that has converged or failed is not changed while the other designs continue, so that its result does not depend on
!> them.
module ek_pack_newton
   use ek_kinds, only: wp
   use ek_lanes, only: lanes_t, mask_t, lanes
   use ek_newton, only: outcome_t, ends_here, max_iterations, max_chords, rest, good_chord
   use ek_kkt, only: max_growth, whole_tangent, residual_only
   use ek_kkt_terms_lanes, only: assemble_terms
   use ek_plan_factors_lanes, only: soundness_t, gather_and_factorise, solve_by
   use ek_motion_lanes, only: largest_motion, take_step
   use ek_pack, only: pack_t
   implicit none(type, external)
   private
   public :: find_equilibria

contains

   !> Iterates from the poses and reactions of the pack to equilibrium under the inputs of the pack.
   subroutine find_equilibria(pack, tolerance, is_wanted, outcome)
      type(pack_t), intent(inout) :: pack
      real(wp), intent(in) :: tolerance                  !! m
      logical, intent(in) :: is_wanted(lanes)            !! designs that are not wanted remain unchanged
      type(outcome_t), intent(out) :: outcome(lanes)
      logical :: is_going(lanes), is_in_chord(lanes), is_taken(lanes)
      type(soundness_t) :: soundness
      real(wp) :: largest, previous(lanes), before(lanes)
      type(lanes_t) :: length
      integer :: iteration, chord, l

      largest = 0.25_wp*pack%length + 0.05_wp
      previous = huge(previous)
      is_going = is_wanted
      do iteration = 1, max_iterations
         call assemble(pack, whole_tangent)
         call factorise(pack, is_going .or. .not. is_wanted, soundness)
         call find_step(pack, length)
         is_in_chord = .false.
         do l = 1, lanes
            if (.not. is_going(l)) cycle
            associate (this => outcome(l))
               this%factorisations = iteration
               this%negative = nint(soundness%negative%v(l))
               this%log_determinant = soundness%log_determinant%v(l)
               this%pivot_ratio = soundness%least%v(l)/max(soundness%most%v(l), tiny(1.0_wp))
               this%last = length%v(l)
               if (iteration == 1) this%first = this%last
               this%missed = this%last
               this%is_singular = .not. soundness%growth%v(l) < max_growth
               if (this%is_singular .or. .not. this%last <= largest) then
                  is_going(l) = .false.
                  cycle
               end if
               is_in_chord(l) = .true.
            end associate
         end do
         call take(pack, is_in_chord)
         do l = 1, lanes
            if (.not. is_in_chord(l)) cycle
            associate (this => outcome(l))
               if (ends_here(this%last, tolerance, pack%length)) then
                  this%is_converged = .true.
                  is_going(l) = .false.
               else if (0.5_wp*this%last > previous(l)) then
                  is_going(l) = .false.
               end if
               previous(l) = this%last
               is_in_chord(l) = is_going(l) .and. this%last < 0.01_wp*pack%length
            end associate
         end do
         do chord = 1, max_chords
            if (.not. any(is_in_chord)) exit
            before = outcome%last
            call assemble(pack, residual_only)
            call find_step(pack, length)
            is_taken = is_in_chord .and. length%v < before
            call take(pack, is_taken)
            do l = 1, lanes
               if (.not. is_in_chord(l)) cycle
               associate (this => outcome(l))
                  this%last = length%v(l)
                  is_in_chord(l) = this%last <= good_chord*before(l)
                  if (.not. is_in_chord(l)) cycle
                  if (this%last**2 <= rest*tolerance*before(l)) then
                     is_in_chord(l) = .false.
                     is_going(l) = .false.
                     this%is_converged = this%last <= tolerance
                  end if
               end associate
            end do
         end do
         if (.not. any(is_going)) return
      end do
   end subroutine find_equilibria

   !> Assembles the systems of all designs at the present poses: matrix and right-hand side, or the right-hand side alone.
   subroutine assemble(pack, mode)
      type(pack_t), intent(inout) :: pack
      integer, intent(in) :: mode
      integer :: k

      call assemble_terms(pack%pattern, pack%loads, pack%elements, pack%equations, pack%terms, pack%poses, pack%reaction, &
         pack%factor, pack%change, mode, pack%gradients, pack%values, pack%store(1), pack%store(pack%pattern%jacobian + 1), &
         pack%rhs)
      if (mode == residual_only) return
      do k = 1, pack%rows
         pack%store(pack%pattern%diagonal + k)%v = -pack%equations(k)%compliance%v
      end do
   end subroutine assemble

   !> Factorises the matrices at the present poses. The factors of designs whose iteration has ended are unchanged, so that the
   !> results of these designs do not depend on the other designs.
   subroutine factorise(pack, is_going, soundness)
      type(pack_t), intent(inout) :: pack
      logical, intent(in) :: is_going(lanes)
      type(soundness_t), intent(out) :: soundness
      integer :: k, l

      if (.not. all(is_going)) then
         do k = 1, size(pack%spare)
            pack%spare(k) = pack%factors(k)
         end do
      end if
      call gather_and_factorise(pack%pattern%entries, pack%pattern%from, pack%plan, pack%store, pack%scaling, pack%factors, &
         soundness)
      do l = 1, lanes
         if (is_going(l)) cycle
         do k = 1, size(pack%spare)
            pack%factors(k)%v(l) = pack%spare(k)%v(l)
         end do
      end do
   end subroutine factorise

   !> Solves for the steps of all designs with the factors in the pack, and measures the steps.
   subroutine find_step(pack, length)
      type(pack_t), intent(inout) :: pack
      type(lanes_t), intent(out) :: length               !! largest |Δr|, |Δπ| × characteristic length [m]
      type(lanes_t) :: scale

      scale%v = pack%length
      call solve_by(pack%plan, pack%factors, pack%scale, pack%rhs)
      length = largest_motion(pack%rhs(:6*pack%bodies), scale)
   end subroutine find_step

   !> Applies the steps of the designs for which is_taken is .true.
   subroutine take(pack, is_taken)
      type(pack_t), intent(inout) :: pack
      logical, intent(in) :: is_taken(lanes)
      type(mask_t) :: taken

      taken%v = merge(1.0_wp, 0.0_wp, is_taken)
      call take_step(pack%bodies, pack%rows, pack%rhs, taken, pack%poses, pack%reaction)
   end subroutine take

end module ek_pack_newton
