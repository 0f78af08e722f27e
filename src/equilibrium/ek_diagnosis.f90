!> What is wrong with a model: mechanisms and redundant constraints, by name; and its condition.
!>
!> A mechanism is a motion that keeps every joint and meets no stiffness: a null vector of Zᵀ T Z,
!> Z a basis of the null space of Φq. A redundant constraint is a left null vector of Φq. Both are
!> found by LAPACK's singular and eigenvalue decompositions of the scaled matrices, where every
!> stiffness of a usual suspension is above 1e-5 of the characteristic one.
module ek_diagnosis
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_units, only: millimetre
   use ek_text, only: str, quoted, vector_text, plural
   use ek_rotation, only: cross
   use ek_suspension, only: suspension_t
   use ek_state, only: state_t, demand_t
   use ek_kkt, only: kkt_t, assemble, condition, whole_tangent
   use ek_lapack, only: dgesvd, dsyev
   implicit none(type, external)
   private
   public :: diagnosis_t, diagnose

   real(wp), parameter :: rank_tolerance = 1.0e-9_wp      !! of the largest singular value of scaled Φq
   real(wp), parameter :: no_stiffness = 1.0e-7_wp        !! of the characteristic stiffness: a mechanism
   real(wp), parameter :: soft_stiffness = 1.0e-5_wp      !! likewise: worth a warning
   real(wp), parameter :: takes_part = 1.0e-3_wp          !! of the largest part of a null vector

   !> Findings about a model at a state.
   type :: diagnosis_t
      integer :: unknowns = 0
      integer :: constraints = 0, rank = 0       !! of rows that hold for certain: a driver with a stiffness is elastic
      integer :: freedoms = 0                    !! unknowns − rank: motions held by elastic elements or not at all
      real(wp) :: rcond = 0.0_wp                 !! reciprocal condition number of the scaled KKT matrix
      real(wp) :: softest = 0.0_wp               !! least stiffness of a free motion, of the characteristic one
      type(message_list_t) :: mechanisms         !! one line each
      type(message_list_t) :: redundancies       !! one line each
      type(message_list_t) :: warnings           !! soft or unstable motions
   contains
      procedure :: is_solvable
      procedure :: words
   end type diagnosis_t

contains

   !> No mechanism and no redundant constraint.
   pure logical function is_solvable(self)
      class(diagnosis_t), intent(in) :: self
      is_solvable = self%mechanisms%count() == 0 .and. self%redundancies%count() == 0
   end function is_solvable

   !> All defects, one a line.
   pure function words(self) result(text)
      class(diagnosis_t), intent(in) :: self
      character(:), allocatable :: text

      text = self%mechanisms%text()
      if (self%mechanisms%count() > 0 .and. self%redundancies%count() > 0) text = text//new_line('a')
      text = text//self%redundancies%text()
   end function words

   !> Examines a model at a state (design, or where a solution failed).
   !>
   !> `driven` rows count as held. Costs a few dense decompositions: for a check, not for an increment.
   subroutine diagnose(suspension, state, kkt, diagnosis)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(inout) :: kkt              !! work space of this model
      type(diagnosis_t), intent(out) :: diagnosis
      real(wp) :: tangent(kkt%nq, kkt%nq), right(kkt%nq, kkt%nq), gradient(kkt%nq)
      real(wp), allocatable :: jacobian(:, :), left(:, :), singular(:)
      integer, allocatable :: rows(:)      ! that hold for certain: those without compliance
      integer :: i, j, rank

      rows = pack([(i, i=1, kkt%nc)], .not. suspension%rows%compliance > 0.0_wp)
      allocate (jacobian(size(rows), kkt%nq), left(size(rows), size(rows)), singular(max(1, min(size(rows), kkt%nq))))
      call condition(suspension, state, demand_t(), kkt, diagnosis%rcond)
      call assemble(suspension, state, demand_t(), whole_tangent, kkt)
      do j = 1, kkt%nq
         do i = 1, kkt%nq
            tangent(i, j) = kkt%matrix(max(i, j), min(i, j))*kkt%scale(i)*kkt%scale(j)
         end do
         jacobian(:, j) = kkt%matrix(kkt%nq + rows, j)*kkt%scale(kkt%nq + rows)*kkt%scale(j)
      end do
      do i = 1, kkt%nc       ! a driver with a stiffness is a spring
         if (.not. suspension%rows(i)%compliance > 0.0_wp) cycle
         gradient = kkt%matrix(kkt%nq + i, :kkt%nq)*kkt%scale(:kkt%nq)
         do j = 1, kkt%nq
            tangent(:, j) = tangent(:, j) + gradient*(gradient(j)/suspension%rows(i)%compliance)
         end do
      end do

      left = 0.0_wp
      right = 0.0_wp
      do j = 1, kkt%nq
         right(j, j) = 1.0_wp
      end do
      rank = 0
      if (size(rows) > 0 .and. kkt%nq > 0) then
         call decompose(jacobian, left, singular, right)
         rank = count(singular(:min(size(rows), kkt%nq)) > rank_tolerance*singular(1))
      end if
      diagnosis%unknowns = kkt%nq
      diagnosis%constraints = size(rows)
      diagnosis%rank = rank
      diagnosis%freedoms = kkt%nq - rank
      if (rank < size(rows)) call name_redundancies(suspension, left(:, rank + 1:), rows, diagnosis)
      if (diagnosis%freedoms > 0) call name_mechanisms(suspension, state, tangent, right(:, rank + 1:), kkt, diagnosis)
   end subroutine diagnose

   !> Singular value decomposition: left vectors, singular values, right vectors by column.
   subroutine decompose(a, left, singular, right)
      real(wp), intent(inout) :: a(:, :)
      real(wp), intent(out) :: left(:, :), singular(:), right(:, :)
      real(wp), allocatable :: work(:), vt(:, :)
      integer :: m, n, info

      m = size(a, 1)
      n = size(a, 2)
      allocate (work(10*(m + n) + 5*min(m, n)), vt(n, n))
      call dgesvd('A', 'A', m, n, a, m, singular, left, m, vt, n, work, size(work), info)
      right = transpose(vt)
   end subroutine decompose

   !> Names the joints of each left null vector of Φq.
   subroutine name_redundancies(suspension, basis, rows, diagnosis)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: basis(:, :)
      integer, intent(in) :: rows(:)             !! the rows of the suspension that these are
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
               text = 'redundant: joints '//text//' hold the same '//plural(times(g), 'motion', 'motions')// &
                  ' more than once; remove or weaken one of them'
            end if diagnosis_line
            call diagnosis%redundancies%add(text)
         end block
      end do
   end subroutine name_redundancies

   !> ' (file:line)' or nothing.
   pure function place(where) result(text)
      character(*), intent(in) :: where
      character(:), allocatable :: text
      text = ''
      if (len(where) > 0) text = ' ('//where//')'
   end function place

   !> Names the motions without stiffness, and warns of soft and unstable ones.
   subroutine name_mechanisms(suspension, state, tangent, basis, kkt, diagnosis)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: tangent(:, :)        !! scaled
      real(wp), intent(in) :: basis(:, :)          !! null space of scaled Φq
      type(kkt_t), intent(in) :: kkt
      type(diagnosis_t), intent(inout) :: diagnosis
      real(wp) :: reduced(size(basis, 2), size(basis, 2)), eigenvalue(size(basis, 2)), work(40*size(basis, 2))
      real(wp), allocatable :: motions(:, :)
      integer :: n, k, info

      n = size(basis, 2)
      reduced = matmul(transpose(basis), matmul(tangent, basis))
      call dsyev('V', 'L', n, reduced, n, eigenvalue, work, size(work), info)
      diagnosis%softest = eigenvalue(1)
      motions = matmul(basis, reduced(:, :count(abs(eigenvalue) < no_stiffness)+count(eigenvalue <= -no_stiffness)))
      motions = motions(:, count(eigenvalue <= -no_stiffness) + 1:)
      call make_sparse(motions)
      do k = 1, size(motions, 2)
         call diagnosis%mechanisms%add('mechanism: '//motion_words(suspension, state, kkt, motions(:, k)))
      end do
      do k = 1, n
         if (eigenvalue(k) <= -no_stiffness) then
            call diagnosis%warnings%add('unstable at design (negative stiffness): '// &
               motion_words(suspension, state, kkt, matmul(basis, reduced(:, k))))
         else if (eigenvalue(k) >= no_stiffness .and. eigenvalue(k) < soft_stiffness) then
            call diagnosis%warnings%add('very soft ('//str(eigenvalue(k), 2)//' of the characteristic stiffness): '// &
               motion_words(suspension, state, kkt, matmul(basis, reduced(:, k))))
         end if
      end do
   end subroutine name_mechanisms

   !> Gauss–Jordan with column pivoting on the columns: the same space, each vector with few parts, so
   !> that two independent defects are told as two.
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

   !> Which body moves most, how, and which others go with it.
   function motion_words(suspension, state, kkt, motion) result(text)
      type(suspension_t), intent(in) :: suspension
      type(state_t), intent(in) :: state
      type(kkt_t), intent(in) :: kkt
      real(wp), intent(in) :: motion(:)            !! scaled unknowns
      character(:), allocatable :: text
      real(wp) :: part(size(suspension%bodies))
      integer :: k, main

      do k = 1, size(part)
         part(k) = norm2(motion(6*k - 5:6*k))
      end do
      main = maxloc(part, dim=1)
      text = 'body '//quoted(suspension%bodies(main)%name)//place(suspension%bodies(main)%where)//' '// &
         one_body_words(suspension, state%poses(main + 1)%r, kkt, motion(6*main - 5:6*main), main)
      do k = 1, size(part)
         if (k == main .or. part(k) <= takes_part*part(main)) cycle
         text = text//'; body '//quoted(suspension%bodies(k)%name)//' '// &
            one_body_words(suspension, state%poses(k + 1)%r, kkt, motion(6*k - 5:6*k), k)
      end do
   end function motion_words

   !> 'turns freely about the axis …' or 'slides freely along …'.
   function one_body_words(suspension, r, kkt, motion, body) result(text)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: r(3), motion(6)
      type(kkt_t), intent(in) :: kkt
      integer, intent(in) :: body
      character(:), allocatable :: text
      real(wp) :: v(3), w(3), axis(3), through(3), lead

      v = motion(1:3)*kkt%scale(6*body - 5)
      w = motion(4:6)*kkt%scale(6*body - 2)
      if (norm2(w)*kkt%length < takes_part*norm2(v)) then
         axis = in_frame(suspension, v/norm2(v))
         text = 'slides freely along '//vector_text(axis, 4)
         return
      end if
      axis = w/norm2(w)
      through = r + cross(axis, v)/norm2(w)
      lead = dot_product(v, axis)/norm2(w)
      text = 'turns freely about the axis '//vector_text(in_frame(suspension, tidy(axis)), 3)//' through '// &
         vector_text(in_frame(suspension, through)/millimetre, 5)//' mm'//points_on(suspension, axis, through)
      if (abs(lead) > takes_part*kkt%length) text = text//', sliding '//str(lead/millimetre, 3)//' mm/rad along it'
   end function one_body_words

   !> The axis with rounding dust taken off and its largest part positive.
   pure function tidy(axis) result(clean)
      real(wp), intent(in) :: axis(3)
      real(wp) :: clean(3)
      clean = merge(axis, 0.0_wp, abs(axis) > 1.0e-6_wp)
      if (clean(maxloc(abs(clean), dim=1)) < 0.0_wp) clean = -clean
   end function tidy

   !> A vector in the deck's frame.
   pure function in_frame(suspension, vector) result(out)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: vector(3)
      real(wp) :: out(3)
      out = vector
      if (suspension%is_iso) out(1:2) = -out(1:2)
   end function in_frame

   !> ' (points a, b)' for the hardpoints on an axis.
   pure function points_on(suspension, axis, through) result(text)
      type(suspension_t), intent(in) :: suspension
      real(wp), intent(in) :: axis(3), through(3)
      character(:), allocatable :: text
      real(wp), parameter :: near = 0.5e-3_wp     ! m: an engineer calls that the same line
      integer :: k, found

      text = ''
      found = 0
      do k = 1, size(suspension%points)
         if (norm2(cross(axis, suspension%points(k)%at - through)) > near) cycle
         found = found + 1
         if (found > 4) exit
         if (found > 1) text = text//', '
         text = text//quoted(suspension%points(k)%name)
      end do
      if (found > 0) text = ' (the line of '//text//')'
   end function points_on

end module ek_diagnosis
