!> The numbers of the deck that the factors of a fit change: each number belongs to one factor.
module ek_fit_claims
   use ek_kinds, only: wp
   use ek_text, only: quoted
   use ek_study, only: by_value, by_scale
   use ek_matched_numbers, only: matches_t, match_t, match_paths, match_name, claims_t, claim
   use ek_factor_paths, only: shared_text
   use ek_workspace, only: workspace_t
   use ek_fit, only: fit_t
   implicit none(type, external)
   private
   public :: claim_factor

contains

   !> Checks that the numbers of a factor belong to no earlier factor. `message` describes a number that an earlier factor changes,
   !> and a number that two paths of the factor change in different ways; otherwise it is ''.
   subroutine claim_factor(fit, f, workspace, claims, message)
      type(fit_t), intent(in) :: fit
      integer, intent(in) :: f                             !! index of the factor
      type(workspace_t), intent(in) :: workspace
      type(claims_t), intent(inout) :: claims              !! numbers of all factors
      character(:), allocatable, intent(out) :: message
      type(matches_t) :: matches, one
      type(match_t), allocatable :: shared(:)
      character(:), allocatable :: ignored
      integer :: k, j, other

      associate (factor => fit%factors(f), design => workspace%design)
         call match_paths(design%parameters, design%records, factor%paths, factor%change /= by_value, matches, message)
         if (factor%change == by_scale) message = ''                 ! a multiple has no direction
         do k = 2, merge(size(factor%paths), 1, message == '' .and. matches%has_repeated)
            call match_paths(design%parameters, design%records, factor%paths(k:k), factor%change /= by_value, one, ignored)
            do j = 1, size(matches%list)
               associate (before => matches%list(j)%path)
                  if (before >= k .or. .not. any(one%list%number == matches%list(j)%number)) cycle
                  if (message == '' .and. abs(factor%weights(before) - factor%weights(k)) > 0.0_wp) message = 'its paths '// &
                     quoted(trim(factor%paths(before)))//' and '//quoted(trim(factor%paths(k)))//' change '// &
                     match_name(design%records, matches%list(j), matches%list)//' with different weights; remove one of them'
               end associate
            end do
         end do
         if (message /= '') message = factor%where//': factor '//quoted(factor%name)//': '//message
         call claim(claims, matches%list, f, other, shared)
         if (other > 0 .and. message == '') message = shared_text(factor%where, factor%name, fit%factors(other)%where, &
            fit%factors(other)%name, match_name(design%records, shared(1), shared))
      end associate
   end subroutine claim_factor

end module ek_fit_claims
