!> Plausibility of springs, stops and bars as pairs: a spring given twice, an anti-roll bar that only one side moves, stops whose
!> names contradict their types, masses without gravity, preloads that the preload trim (`balance`) replaces.
module ek_plausible_springs
   use ek_kinds, only: wp, millimetre
   use ek_text, only: str, quoted, lower, plural
   use ek_measure, only: measure_t
   use ek_element, only: element_t, axial_spring, torsion_spring, stop_spring, bushing_element
   use ek_element_label, only: element_label
   use ek_suspension, only: suspension_t, body_name
   use ek_plausible_range, only: doubts_t, length, rate, rotation_rate, force
   use ek_plausible_shape, only: point_of
   implicit none(type, external)
   private
   public :: doubt_springs, doubt_stop_names, doubt_replaced_preloads

contains

   !> Adds remarks on springs and bushings given twice, on bars of one side, and on masses without gravity.
   subroutine doubt_springs(suspension, doubts)
      type(suspension_t), intent(in) :: suspension
      type(doubts_t), intent(inout) :: doubts
      integer :: k

      do k = 1, size(suspension%elements)
         call doubt_copy(suspension, k, doubts)
         if (suspension%elements(k)%kind == torsion_spring) call doubt_bar_side(suspension, k, doubts)
      end do
      if (suspension%gravity > 0.0_wp) return
      if (all(suspension%loads%is_case .or. suspension%loads%start_of > 0)) return      ! no state has weights
      k = findloc(suspension%bodies%mass > 0.0_wp, .true., dim=1)
      if (k == 0) return
      call doubts%examine(suspension%bodies(k)%where, 'body '//quoted(suspension%bodies(k)%name))
      call doubts%add('mass without gravity', 'its mass has no effect, because &model gives no gravity; give gravity = 9.81'// &
         trim(merge(' (the same holds for the other masses)', '                                      ', &
         count(suspension%bodies%mass > 0.0_wp) > 1)))
   end subroutine doubt_springs

   !> Examines whether an earlier spring, torsion spring or bushing acts between the same ends as element k.
   subroutine doubt_copy(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      integer :: j

      associate (this => suspension%elements(k))
         if (all(this%kind /= [axial_spring, torsion_spring, bushing_element])) return
         do j = 1, k - 1
            associate (other => suspension%elements(j))
               if (other%kind /= this%kind) cycle
               if (.not. have_same_ends(suspension, this%measure, other%measure, this%kind == torsion_spring)) cycle
               call doubts%examine(this%where, element_label(this))
               call doubts%add('copy', 'it acts between the same ends as '//element_label(other)//sum_of(this, other)// &
                  '; is it given twice?')
               return
            end associate
         end do
      end associate

   contains

      !> Phrase about the sum of two rates; '' for bushings and curves.
      function sum_of(a, b) result(text)
         type(element_t), intent(in) :: a, b
         character(:), allocatable :: text

         text = ''
         if (a%kind == bushing_element) text = ', so that their rates add up'
         if (a%kind == bushing_element .or. a%law%has_curve .or. b%law%has_curve) return
         text = ', so that both together have '// &
            doubts%speak(merge(rotation_rate, rate, a%kind == torsion_spring), a%law%rate + b%law%rate)
      end function sum_of

   end subroutine doubt_copy

   !> Whether two measures are between the same two bodies and the same points; of a torsion spring, about the same axis.
   pure logical function have_same_ends(suspension, a, b, is_of_axis)
      type(suspension_t), intent(in) :: suspension
      type(measure_t), intent(in) :: a, b
      logical, intent(in) :: is_of_axis
      real(wp), parameter :: near = 1.0_wp*millimetre, parallel = 0.9999_wp
      real(wp) :: a_i(3), a_j(3), b_i(3), b_j(3)

      have_same_ends = .false.
      if (min(a%body_i, a%body_j) /= min(b%body_i, b%body_j) .or. max(a%body_i, a%body_j) /= max(b%body_i, b%body_j)) return
      if (a%kind /= b%kind) return
      if (is_of_axis) then
         have_same_ends = abs(dot_product(a%u, b%u)) > parallel*norm2(a%u)*norm2(b%u)
         return
      end if
      a_i = point_of(suspension, a%body_i, a%arm_i)
      a_j = point_of(suspension, a%body_j, a%arm_j)
      b_i = point_of(suspension, b%body_i, b%arm_i)
      b_j = point_of(suspension, b%body_j, b%arm_j)
      if (a%body_i == b%body_i) then
         have_same_ends = max(norm2(a_i - b_i), norm2(a_j - b_j)) < near
      else
         have_same_ends = max(norm2(a_i - b_j), norm2(a_j - b_i)) < near
      end if
   end function have_same_ends

   !> Examines an anti-roll bar, a torsion spring between a body on the left and a body on the right: parts connect both bodies to
   !> as many others. A bar between the chassis and a body of one side has another one on the other side.
   subroutine doubt_bar_side(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      integer :: left, right, links_left, links_right, few

      associate (bar => suspension%elements(k), m => suspension%elements(k)%measure)
         if (is_central(suspension, m%body_i) .neqv. is_central(suspension, m%body_j)) then
            call doubt_single_bar(suspension, k, doubts)
            return
         end if
         if (min(m%body_i, m%body_j) == 0) return
         left = m%body_i
         right = m%body_j
         if (suspension%bodies(left)%origin(2)*suspension%bodies(right)%origin(2) >= 0.0_wp) return
         if (any(suspension%wheels%body == left) .or. any(suspension%wheels%body == right)) return
         links_left = links_of(suspension, left, right)
         links_right = links_of(suspension, right, left)
         if (links_left == links_right) return
         few = merge(left, right, links_left < links_right)
         call doubts%examine(bar%where, element_label(bar))
         call doubts%add('one side', 'fewer parts connect its body '//quoted(body_name(suspension, few))//' ('// &
            plural(min(links_left, links_right), 'joint or bushing', 'joints or bushings')//') than its body '// &
            quoted(body_name(suspension, left + right - few))//' ('//str(max(links_left, links_right))// &
            '), so that one side alone moves the bar; is a link missing?')
      end associate
   end subroutine doubt_bar_side

   !> Whether a body is the chassis or in the middle of the car, as a subframe is.
   pure logical function is_central(suspension, body)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body
      real(wp), parameter :: aside = 50.0_wp*millimetre

      is_central = body == 0
      if (body > 0) is_central = abs(suspension%bodies(body)%origin(2)) < aside
   end function is_central

   !> Examines a torsion spring between a central body and a body of one side of an axle, which needs an image on the other side.
   subroutine doubt_single_bar(suspension, k, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k
      type(doubts_t), intent(inout) :: doubts
      real(wp) :: y
      integer :: body, j, other

      if (size(suspension%wheels) < 2) return
      associate (bar => suspension%elements(k))
         body = merge(bar%measure%body_j, bar%measure%body_i, is_central(suspension, bar%measure%body_i))
         y = suspension%bodies(body)%origin(2)
         do j = 1, suspension%scalars
            if (suspension%elements(j)%kind /= torsion_spring .or. j == k) cycle
            associate (m => suspension%elements(j)%measure)
               if (is_central(suspension, m%body_i) .eqv. is_central(suspension, m%body_j)) cycle
               other = merge(m%body_j, m%body_i, is_central(suspension, m%body_i))
               if (suspension%bodies(other)%origin(2)*y < 0.0_wp) return
            end associate
         end do
         call doubts%examine(bar%where, element_label(bar))
         call doubts%add('one side', 'it acts on body '//quoted(body_name(suspension, body))//' of one side only; the other '// &
            'side of the axle has no such spring')
      end associate
   end subroutine doubt_single_bar

   !> Number of joints and bushings that connect a body to bodies other than `except`.
   pure integer function links_of(suspension, body, except) result(links)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: body, except
      integer :: k

      links = 0
      do k = 1, size(suspension%joints)
         if (suspension%joints(k)%is_of_measures) cycle
         if (connects(suspension%joints(k)%body_i, suspension%joints(k)%body_j)) links = links + 1
      end do
      do k = 1, size(suspension%elements)
         if (connects(suspension%elements(k)%measure%body_i, suspension%elements(k)%measure%body_j)) links = links + 1
      end do

   contains

      pure logical function connects(i, j)
         integer, intent(in) :: i, j
         connects = any([i, j] == body) .and. all([i, j] /= except)
      end function connects

   end function links_of

   !> Examines the names of stops: a stop called bump acts when the wheels move up, one called rebound when they move down. The same
   !> holds for the name of its curve.
   subroutine doubt_stop_names(suspension, k, ratio, doubts)
      type(suspension_t), intent(in) :: suspension
      integer, intent(in) :: k                      !! index of the stop
      real(wp), intent(in) :: ratio                 !! change of its length per wheel travel
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: clearly = 0.05_wp
      logical :: acts_in_bump
      character(:), allocatable :: curve

      associate (stop => suspension%elements(k))
         if (.not. abs(ratio) > clearly) return
         acts_in_bump = ratio*stop%law%sign > 0.0_wp
         call doubts%examine(stop%where, element_label(stop))
         if (contradicts(stop%name)) call doubts%add('stop', 'it acts when the wheel moves '// &
            trim(merge('up  ', 'down', acts_in_bump))//', contrary to its name; check type')
         if (.not. stop%law%has_curve) return
         curve = ''
         if (allocated(stop%law%curve%name)) curve = stop%law%curve%name
         if (contradicts(curve) .and. .not. contradicts(stop%name)) call doubts%add('stop', 'it acts when the wheel moves '// &
            trim(merge('up  ', 'down', acts_in_bump))//', contrary to the name of its curve '//quoted(curve)//'; check curve')
      end associate

   contains

      !> Whether a name stands for the other direction.
      pure logical function contradicts(name)
         character(*), intent(in) :: name
         logical :: is_of_bump, is_of_rebound

         is_of_rebound = index(lower(name), 'rebound') > 0 .or. index(lower(name), 'droop') > 0
         is_of_bump = .not. is_of_rebound .and. (index(lower(name), 'bump') > 0 .or. index(lower(name), 'jounce') > 0)
         contradicts = merge(is_of_rebound, is_of_bump, acts_in_bump)
      end function contradicts

   end subroutine doubt_stop_names

   !> Examines the springs whose preload or free length the deck gives and the preload trim replaces by another one.
   subroutine doubt_replaced_preloads(suspension, raw, doubts)
      type(suspension_t), intent(in) :: suspension      !! after the preload trim
      type(suspension_t), intent(in) :: raw             !! as the deck gives it
      type(doubts_t), intent(inout) :: doubts
      real(wp), parameter :: same = 0.02_wp, felt = 1.0_wp     ! share; N
      character(:), allocatable :: key
      integer :: k

      if (suspension%balance == 'none') return
      do k = 1, suspension%scalars
         associate (given => raw%elements(k), found => suspension%elements(k))
            if (given%kind /= axial_spring .or. .not. given%is_balanced) cycle
            key = 'preload'
            if (given%free_length > 0.0_wp) key = 'free_length'
            if (abs(given%preload) <= felt .and. key == 'preload') cycle
            if (abs(found%preload - given%preload) <= max(same*abs(given%preload), felt)) cycle
            call doubts%examine(given%where, element_label(given))
            if (given%law%has_curve) then
               call doubts%add('replaced', 'balance = '//quoted(suspension%balance)//' adds '// &
                  doubts%speak(force, found%preload - given%preload)//' to the force that the deck gives; without balance, '// &
                  'the '//key//' of the deck holds (balance = .false. in this &spring)')
            else
               call doubts%add('replaced', 'its '//key//' has no effect: balance = '//quoted(suspension%balance)// &
                  ' replaces the preload of '//doubts%speak(force, given%preload)//' by '//doubts%speak(force, found%preload)// &
                  free_length_text()//'; remove it, or set balance = .false. in this &spring')
            end if
         end associate
      end do

   contains

      !> Phrase about the free length that gives the found preload; '' for a preload.
      function free_length_text() result(text)
         character(:), allocatable :: text

         text = ''
         associate (given => raw%elements(k), found => suspension%elements(k))
            if (given%free_length > 0.0_wp .and. found%law%rate > 0.0_wp) text = ' (free length '// &
               doubts%speak(length, found%design_length + found%preload/found%law%rate)//')'
         end associate
      end function free_length_text

   end subroutine doubt_replaced_preloads

end module ek_plausible_springs
