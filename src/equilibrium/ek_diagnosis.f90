!> Detects mechanisms and redundant constraints of a model, with the names of the parts, and its condition number.
!>
!> A mechanism is a motion that satisfies every joint and has no stiffness: a null vector of Zᵀ T Z,
!> where Z is a basis of the null space of Φq. A redundant constraint is a left null vector of Φq. Both are
!> found by LAPACK's singular value and eigenvalue decompositions of the scaled matrices.
!>
!> The stiffness of a motion v counts as zero if it is below the rounding error of its own sums (vᵀ T v against |v|ᵀ |T| |v|), or
!> below 1e-7 of the rate of the softest spring or bushing. Hardpoints rounded to a tenth of a millimetre cause such stiffnesses.
!> The limit is lower if many bodies move. A stiffness is not compared with the characteristic stiffness: a coil of 30 N/mm next to
!> bushings of 1e10 N/mm, or the bending of a chain of 160 bodies, is extremely soft in comparison, but not a mechanism.
!>
!> T includes the geometric stiffness of preloads. A motion without material stiffness (K) is held by preloads or loads only
!> and is reported separately.
!> Equation (K.7) of docs/theory/kkt.md.
!>
!> A dead point is recognised, too: a position, such as a crank and its rod in line, in which a constraint is redundant and a motion is free at
!> the same time, but in no neighbouring position. The joints are sound; the position is not.
module ek_diagnosis
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, quoted, plural
   use ek_element, only: element_kinds, bushing_element
   use ek_element_label, only: element_label
   use ek_element_force, only: design_stiffness
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, inputs_t, move
   use ek_kkt, only: kkt_t, assemble, condition, whole_matrix, whole_tangent, material_only
   use ek_motion_text, only: motion_text, moving_text, body_parts, place
   use ek_singular_values, only: singular_values_t, decompose
   use ek_lapack, only: dsyev
   implicit none(type, external)
   private
   public :: diagnosis_t, diagnose, softest_rate, scaled_parts, modes, rank_tolerance, no_stiffness, rounding

   real(wp), parameter :: step = 1.0e-3_wp             !! largest motion to the neighbouring position [m, rad]
   real(wp), parameter :: opens = 3.0e-5_wp            !! limit of the smallest singular value there, as a share of the largest. At a
                                                       !! dead point it grows with the step, otherwise with its square

   real(wp), parameter :: rank_tolerance = 1.0e-9_wp      !! limit of a singular value of scaled Φq, as a share of the largest
   real(wp), parameter :: no_stiffness = 1.0e-7_wp        !! limit for a mechanism of one body, as a share of the rate of the
                                                          !! softest element
   real(wp), parameter :: rounding = 50.0_wp*epsilon(1.0_wp)   !! error of a sum, per term: smaller sums count as zero
   real(wp), parameter :: soft_stiffness = 1.0e-5_wp      !! limit, as a share of the characteristic stiffness: below it a warning
                                                          !! is given
   real(wp), parameter :: takes_part = 1.0e-3_wp          !! limit, as a share of the largest entry of a null vector: joints with
                                                          !! larger entries are listed
   character(*), parameter :: failed = 'the model cannot be examined: its forces or stiffnesses are too large to calculate with'

   !> Findings about a model at a state.
   type :: diagnosis_t
      integer :: unknowns = 0
      integer :: constraints = 0, rank = 0       !! number and rank of the rigid rows (a driver with a stiffness is elastic)
      integer :: freedoms = 0                    !! unknowns − rank: motions held by elastic elements or free
      integer :: negative = 0                    !! negative eigenvalues of the KKT matrix; constraints + compliant rows if stable
      real(wp) :: rcond = 0.0_wp                 !! reciprocal condition number of the scaled KKT matrix
      real(wp) :: softest = 0.0_wp               !! smallest stiffness of a motion that the joints allow / characteristic stiffness
      type(message_list_t) :: mechanisms         !! messages on mechanisms, one line each
      type(message_list_t) :: redundancies       !! messages on redundant constraints, one line each
      type(message_list_t) :: failures           !! message on a decomposition that failed: nothing is known then
      type(message_list_t) :: warnings           !! messages on soft or unstable motions
      type(message_list_t) :: preload_held       !! messages on motions held by preloads or loads only
   contains
      procedure :: is_solvable
      procedure :: words
   end type diagnosis_t

contains

   !> Whether the diagnosis found no mechanism and no redundant constraint. The result is also .false. if the diagnosis failed.
   pure logical function is_solvable(self)
      class(diagnosis_t), intent(in) :: self
      is_solvable = self%mechanisms%count() + self%redundancies%count() + self%failures%count() == 0
   end function is_solvable

   !> The messages on mechanisms, redundant constraints and failures, one per line.
   pure function words(self) result(text)
      class(diagnosis_t), intent(in) :: self
      character(:), allocatable :: text

      text = self%mechanisms%text()
      if (len(text) > 0 .and. self%redundancies%count() > 0) text = text//new_line('a')
      text = text//self%redundancies%text()
      if (len(text) > 0 .and. self%failures%count() > 0) text = text//new_line('a')
      text = text//self%failures%text()
   end function words

   !> Examines a model at a state: design, or the state at which a solution failed.
   !>
   !> Driven rows count as constraints, except drivers with a stiffness. The cost is a few dense decompositions: suitable for a
   !> check, but not for an increment.
   subroutine diagnose(suspension, state, kkt, diagnosis, wants_preload_held)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt              !! work space of this model
      type(diagnosis_t), intent(out) :: diagnosis
      logical, intent(in), optional :: wants_preload_held    !! also search motions held by preload only
      type(singular_values_t) :: parts
      real(wp), allocatable :: jacobian(:, :), tangent(:, :), material(:, :)
      integer, allocatable :: rows(:)

      call condition(suspension, state, inputs_t(), kkt, diagnosis%rcond)
      diagnosis%negative = kkt%negative
      call assemble(suspension, state, inputs_t(), whole_tangent, kkt)
      call scaled_parts(suspension, kkt, rows, jacobian, tangent)
      call decompose(jacobian, rank_tolerance, parts, wants_null_space=.true.)
      diagnosis%unknowns = kkt%nq
      diagnosis%constraints = size(rows)
      diagnosis%rank = parts%rank
      diagnosis%freedoms = kkt%nq - parts%rank
      if (.not. (parts%is_found .and. all(ieee_is_finite(tangent)) .and. all(ieee_is_finite(kkt%rhs)))) then
         call diagnosis%failures%add(failed)
         return
      end if
      if (parts%rank < size(rows)) call name_redundancies(suspension, parts%left(:, parts%rank + 1:), rows, diagnosis)
      if (diagnosis%freedoms > 0) call name_mechanisms(suspension, state, tangent, parts%right(:, parts%rank + 1:), kkt, &
         diagnosis)
      if (parts%rank < size(rows) .and. diagnosis%mechanisms%count() > 0) call recognise_dead_point(suspension, state, rows, &
         parts%left(:, parts%rank + 1:), parts%right(:, parts%rank + 1:), kkt, diagnosis%mechanisms, diagnosis%redundancies)
      if (diagnosis%freedoms == 0 .or. .not. present(wants_preload_held)) return
      if (.not. wants_preload_held) return
      call assemble(suspension, state, inputs_t(), material_only, kkt)
      call scaled_parts(suspension, kkt, rows, jacobian, material)
      call name_preload_held(suspension, state, tangent, material, parts%right(:, parts%rank + 1:), kkt, diagnosis)
   end subroutine diagnose

   !> Finds the rigid rows (without compliance) of the last assembled system, their scaled Φq, and the scaled stiffness T
   !> with the drivers that have a stiffness.
   subroutine scaled_parts(suspension, kkt, rows, jacobian, stiffness)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      integer, allocatable, intent(out) :: rows(:)
      real(wp), allocatable, intent(out) :: jacobian(:, :), stiffness(:, :)
      real(wp) :: gradient(kkt%nq), whole(kkt%n, kkt%n)
      integer :: i, j

      whole = whole_matrix(kkt)
      rows = pack([(i, i=1, kkt%nc)], .not. suspension%rows%compliance > 0.0_wp)
      allocate (jacobian(size(rows), kkt%nq), stiffness(kkt%nq, kkt%nq))
      do j = 1, kkt%nq
         jacobian(:, j) = whole(kkt%nq + rows, j)*kkt%scale(kkt%nq + rows)*kkt%scale(j)
         do i = 1, kkt%nq
            stiffness(i, j) = whole(i, j)*kkt%scale(i)*kkt%scale(j)
         end do
      end do
      do i = 1, kkt%nc       ! a driver with a stiffness is a spring
         if (.not. suspension%rows(i)%compliance > 0.0_wp) cycle
         gradient = whole(kkt%nq + i, :kkt%nq)*kkt%scale(:kkt%nq)
         do j = 1, kkt%nq
            stiffness(:, j) = stiffness(:, j) + gradient*(gradient(j)/suspension%rows(i)%compliance)
         end do
      end do
   end subroutine scaled_parts

   !> Records the names of the joints in each left null vector of Φq.
   subroutine name_redundancies(suspension, basis, rows, diagnosis)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: basis(:, :)
      integer, intent(in) :: rows(:)             !! indices of the rigid rows in the suspension
      type(diagnosis_t), intent(inout) :: diagnosis
      real(wp) :: vectors(size(basis, 1), size(basis, 2))
      logical :: is_part(size(suspension%joints)), seen(size(suspension%joints), size(basis, 2))
      integer :: k, r, j, times(size(basis, 2)), groups, g

      vectors = basis
      call make_sparse(vectors)
      groups = 0
      times = 0
      do k = 1, size(vectors, 2)
         is_part = .false.
         do r = 1, size(rows)
            if (abs(vectors(r, k)) > takes_part*maxval(abs(vectors(:, k)))) is_part(suspension%rows(rows(r))%joint) = .true.
         end do
         do g = 1, groups
            if (all(seen(:, g) .eqv. is_part)) exit
         end do
         if (g > groups) then
            groups = g
            seen(:, g) = is_part
         end if
         times(g) = times(g) + 1
      end do
      do g = 1, groups
         block
            character(:), allocatable :: text
            text = ''
            do j = 1, size(suspension%joints)
               if (.not. seen(j, g)) cycle
               if (len(text) > 0) text = text//', '
               text = text//quoted(suspension%joints(j)%name)//place(suspension%joints(j)%where)
            end do
            diagnosis_line: if (count(seen(:, g)) == 1) then
               text = 'redundant: joint '//text//' constrains '//plural(times(g), 'motion', 'motions')// &
                  ' that cannot happen anyway'
            else
               text = 'redundant: joints '//text//' over-constrain '//plural(times(g), 'direction', 'directions')// &
                  '; '//remedy(suspension, seen(:, g))
            end if diagnosis_line
            call diagnosis%redundancies%add(text)
         end block
      end do
   end subroutine name_redundancies

   !> Advice for joints that over-constrain the same direction.
   pure function remedy(suspension, is_part) result(text)
      type(suspension_t), intent(in) :: suspension
      logical, intent(in) :: is_part(:)
      character(:), allocatable :: text
      integer :: first, last

      text = 'replace one by a weaker joint type or by a bushing, or remove it'
      first = findloc(is_part, .true., dim=1)
      last = findloc(is_part, .true., dim=1, back=.true.)
      if (count(is_part) /= 2) return
      associate (one => suspension%joints(first), other => suspension%joints(last))
         if (one%kind /= 'spherical' .or. other%kind /= 'spherical') return
         if (one%body_i /= other%body_i .or. one%body_j /= other%body_j) return
         if (norm2(one%arm_j - other%arm_j) <= 0.0_wp) return
         text = 'an arm on two ball joints: make '//quoted(other%name)//' of type in_line, with its axis along the line of the '// &
            'two, or a bushing'
      end associate
   end function remedy

   !> Lists the motions without stiffness, and warns of soft and unstable motions.
   subroutine name_mechanisms(suspension, state, tangent, basis, kkt, diagnosis)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: tangent(:, :)        !! scaled
      real(wp), intent(in) :: basis(:, :)          !! null space of scaled Φq
      type(kkt_t), intent(in) :: kkt
      type(diagnosis_t), intent(inout) :: diagnosis
      real(wp) :: motions(size(basis, 1), size(basis, 2)), eigenvalue(size(basis, 2)), noise(size(basis, 2))
      real(wp), allocatable :: free(:, :)
      character(:), allocatable :: text
      logical :: is_free(size(basis, 2)), is_found, has_steering
      integer :: k, others

      call modes(tangent, basis, softest_rate(suspension, kkt), motions, eigenvalue, noise, is_found)
      if (.not. is_found) call diagnosis%failures%add(failed)
      if (.not. is_found) return
      diagnosis%softest = eigenvalue(1)
      is_free = abs(eigenvalue) <= noise
      has_steering = .false.
      allocate (free, source=pick(motions, is_free))
      call make_sparse(free)
      do k = 1, size(free, 2)
         call diagnosis%mechanisms%add('mechanism: '//moving_text(suspension, state, kkt, free(:, k), has_steering))
      end do
      do k = 1, size(eigenvalue)
         if (eigenvalue(k) < -noise(k)) call diagnosis%warnings%add('unstable at design (negative stiffness): '// &
            moving_text(suspension, state, kkt, motions(:, k), has_steering))
      end do
      k = findloc(eigenvalue > noise, .true., dim=1)       ! the softest motion with a stiffness
      others = count(eigenvalue > noise .and. eigenvalue < soft_stiffness) - 1
      if (others < 0) return
      text = 'very soft ('//str(eigenvalue(k), 2)//' of the characteristic stiffness'// &
         softer_than(suspension, eigenvalue(k)*kkt%stiffness)//'): '// &
         moving_text(suspension, state, kkt, motions(:, k), has_steering)
      if (others > 0) text = text//'; and '//plural(others, 'motion', 'motions')//' more'
      call diagnosis%warnings%add(text)
   end subroutine name_mechanisms

   !> Lists the motions without material stiffness that are held by preloads or loads.
   subroutine name_preload_held(suspension, state, tangent, material, basis, kkt, diagnosis)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: tangent(:, :), material(:, :), basis(:, :)   !! scaled; with and without geometric stiffness
      type(kkt_t), intent(in) :: kkt
      type(diagnosis_t), intent(inout) :: diagnosis
      real(wp) :: motions(size(basis, 1), size(basis, 2)), eigenvalue(size(basis, 2)), noise(size(basis, 2))
      real(wp), allocatable :: loose(:, :), held(:, :), motions_held(:, :), stiffness(:), least(:)
      logical :: is_found
      integer :: k

      call modes(material, basis, softest_rate(suspension, kkt), motions, eigenvalue, noise, is_found)
      if (.not. is_found) call diagnosis%failures%add(failed)
      if (.not. is_found) return
      allocate (loose, source=pick(motions, eigenvalue <= noise))
      if (size(loose, 2) == 0) return
      allocate (held, mold=loose)
      allocate (stiffness(size(loose, 2)), least(size(loose, 2)))
      call modes(tangent, loose, softest_rate(suspension, kkt), held, stiffness, least, is_found)
      if (.not. is_found) call diagnosis%failures%add(failed)
      if (.not. is_found) return
      allocate (motions_held, source=pick(held, stiffness > least))
      call make_sparse(motions_held)
      do k = 1, size(motions_held, 2)
         call diagnosis%preload_held%add('held by preloads or loads alone; no spring, bushing or link resists it: '// &
            motion_text(suspension, state, kkt, motions_held(:, k)))
      end do
   end subroutine name_preload_held

   !> Finds the eigenvectors of a stiffness within a space of motions, softest first. Also finds for each eigenvector the limit
   !> below which its stiffness counts as zero.
   subroutine modes(stiffness, basis, least, motions, eigenvalue, noise, is_found)
      real(wp), intent(in) :: stiffness(:, :), basis(:, :)
      real(wp), intent(in) :: least              !! rate of the softest element, scaled
      real(wp), intent(out) :: motions(:, :), eigenvalue(:), noise(:)
      logical, intent(out) :: is_found           !! false: numbers are not finite, or LAPACK's iteration did not converge
      ! not automatic: flang has these on the stack, too small for long chains
      real(wp), allocatable :: reduced(:, :), work(:), forces(:, :), sizes(:, :)
      integer :: n, k, info

      n = size(basis, 2)
      allocate (work(40*n))
      reduced = matmul(transpose(basis), matmul(stiffness, basis))
      eigenvalue = 0.0_wp
      is_found = all(ieee_is_finite(reduced))
      if (.not. is_found) return
      call dsyev('V', 'L', n, reduced, n, eigenvalue, work, size(work), info)
      is_found = info == 0
      motions = matmul(basis, reduced)
      forces = matmul(stiffness, motions)      ! of all motions at once: one by one they take half the time of a long chain
      sizes = matmul(abs(stiffness), abs(motions))
      do k = 1, n
         eigenvalue(k) = dot_product(motions(:, k), forces(:, k))
         noise(k) = rounding*size(basis, 1)*dot_product(abs(motions(:, k)), sizes(:, k))
         noise(k) = max(noise(k), no_stiffness*least/bodies_in(motions(:, k))**2, tiny(1.0_wp))
      end do
   end subroutine modes

   !> The number of bodies that share a motion: (Σ p)²/Σ p², with p the size of the motion of each body; 1 for a single body.
   pure real(wp) function bodies_in(motion) result(bodies)
      real(wp), intent(in) :: motion(:)
      real(wp) :: part(size(motion)/6)
      part = body_parts(motion)
      bodies = sum(part)**2/max(sum(part**2), tiny(1.0_wp))
   end function bodies_in

   !> Smallest translational rate of the springs between two points and of the bushings at design, relative to the characteristic
   !> stiffness [-]; at most 1.
   real(wp) function softest_rate(suspension, kkt) result(least)
      type(suspension_t), intent(in) :: suspension
      type(kkt_t), intent(in) :: kkt
      real(wp) :: rates(6)
      integer :: k

      least = kkt%stiffness
      do k = 1, size(suspension%elements)
         associate (kind => suspension%elements(k)%kind)
            if (.not. (element_kinds(kind)%is_axial_spring .or. kind == bushing_element)) cycle
         end associate
         rates = design_stiffness(suspension%elements(k))
         least = min(least, minval(rates(1:3), mask=rates(1:3) > 0.0_wp))
      end do
      least = least/kkt%stiffness
   end function softest_rate

   !> The columns of a matrix for which a mask is true.
   pure function pick(matrix, mask) result(columns)
      real(wp), intent(in) :: matrix(:, :)
      logical, intent(in) :: mask(:)
      real(wp), allocatable :: columns(:, :)
      integer :: k
      columns = matrix(:, pack([(k, k=1, size(mask))], mask))
   end function pick

   !> Phrase that compares a stiffness with the stiffest bushing: ", 3E+10 times softer than bushing 'x'"; '' if no bushing is
   !> 1e6 times stiffer.
   function softer_than(suspension, stiffness) result(text)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: stiffness           !! N/m
      character(:), allocatable :: text
      real(wp), parameter :: much = 1.0e6_wp
      integer :: k, stiffest

      text = ''
      stiffest = 0
      do k = suspension%scalars + 1, size(suspension%elements)
         if (stiffest == 0) stiffest = k
         if (maxval(suspension%elements(k)%bushing%kt) > maxval(suspension%elements(stiffest)%bushing%kt)) stiffest = k
      end do
      if (stiffest == 0) return
      associate (element => suspension%elements(stiffest), kt => suspension%elements(stiffest)%bushing%kt)
         if (maxval(kt) < much*stiffness) return
         text = ', '//str(maxval(kt)/stiffness, 2)//' times softer than '//element_label(element)//place(element%where)
      end associate
   end function softer_than

   !> Transforms vectors by Gauss–Jordan elimination, with the largest entry of each vector as pivot. The new vectors span the same
   !> space and have few nonzero entries, so that two independent defects are reported separately.
   pure subroutine make_sparse(vectors)
      real(wp), intent(inout) :: vectors(:, :)
      integer :: k, l, r
      logical :: is_taken(size(vectors, 1))

      is_taken = .false.
      do k = 1, size(vectors, 2)
         r = maxloc(abs(vectors(:, k)), dim=1, mask=.not. is_taken)
         if (.not. abs(vectors(r, k)) > 0.0_wp) cycle
         is_taken(r) = .true.
         vectors(:, k) = vectors(:, k)/vectors(r, k)
         do l = 1, size(vectors, 2)
            if (l /= k) vectors(:, l) = vectors(:, l) - vectors(r, l)*vectors(:, k)
         end do
      end do
   end subroutine make_sparse

   !> Replaces the messages on mechanisms and redundant constraints by one on a dead point, if all constraints are independent in a
   !> neighbouring position.
   subroutine recognise_dead_point(suspension, state, rows, left, right, kkt, mechanisms, redundancies)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      integer, intent(in) :: rows(:)               !! indices of the rigid rows in the suspension
      real(wp), intent(in) :: left(:, :)           !! left null space of scaled Φq at the state
      real(wp), intent(in) :: right(:, :)          !! right null space
      type(kkt_t), intent(inout) :: kkt            !! work space; overwritten
      type(message_list_t), intent(inout) :: mechanisms, redundancies
      type(singular_values_t) :: parts
      type(message_list_t) :: found
      type(state_t) :: beside
      real(wp) :: motion(kkt%nq)
      character(:), allocatable :: joints
      integer :: k, j

      if (size(rows) > kkt%nq .or. size(right, 2) == 0) return      ! too many constraints in any position
      motion = 0.0_wp
      do k = 1, size(right, 2)                     ! a motion in which all free directions take part, unequally
         motion = motion + right(:, k)/real(k, wp)
      end do
      motion = motion/max(norm2(motion), tiny(1.0_wp))
      beside = state
      motion = motion*kkt%scale(:kkt%nq)
      call move(beside, step*motion/max(maxval(abs(motion)), tiny(1.0_wp)))
      call assemble(suspension, beside, inputs_t(), whole_tangent, kkt)
      call decompose(scaled_rows(rows, kkt), 0.0_wp, parts, wants_null_space=.false.)
      if (.not. parts%is_found) return
      if (parts%values(size(rows)) < opens*parts%values(1)) return
      joints = ''
      do j = 1, size(suspension%joints)
         if (.not. any([(any(abs(pack(left(:, k), suspension%rows(rows)%joint == j)) > takes_part*maxval(abs(left(:, k)))), &
            k=1, size(left, 2))])) cycle
         if (joints /= '') joints = joints//', '
         joints = joints//quoted(suspension%joints(j)%name)//place(suspension%joints(j)%where)
      end do
      call found%add('dead point: only in this position (parts in line, for instance), joints '//joints// &
         ' cannot start this motion: '//motion_text(suspension, state, kkt, right(:, 1))//'; the joints are sound in other '// &
         'positions: choose another design position, or drive this body')
      mechanisms = found
      redundancies = message_list_t()
   end subroutine recognise_dead_point

   !> The scaled Φq of the rigid rows of the last assembled system.
   function scaled_rows(rows, kkt) result(jacobian)
      integer, intent(in) :: rows(:)
      type(kkt_t), intent(in) :: kkt
      real(wp) :: jacobian(size(rows), kkt%nq)
      real(wp) :: whole(kkt%n, kkt%n)
      integer :: j

      whole = whole_matrix(kkt)
      do j = 1, kkt%nq
         jacobian(:, j) = whole(kkt%nq + rows, j)*kkt%scale(kkt%nq + rows)*kkt%scale(j)
      end do
   end function scaled_rows

end module ek_diagnosis
