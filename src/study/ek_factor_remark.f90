!> Messages on the samples of a study, on factors that the preload trim replaces, and on factors that move hardpoints: points of a
!> wheel that a pattern also moves, and a point that is moved away from another point at the same location.
module ek_factor_remark
   use ek_kinds, only: wp, i8
   use ek_error, only: message_list_t
   use ek_text, only: str, quoted
   use ek_record, only: record_t, element
   use ek_group, only: group_names, point_group, spring_group, wheel_group, model_group
   use ek_reader, only: definition_t
   use ek_study, only: study_t
   use ek_sampler_kind, only: sobol_kind, saltelli_kind
   use ek_factor_numbers, only: factor_paths_t
   implicit none(type, external)
   private
   public :: factor_remarks, sample_remark

   real(wp), parameter :: same = 1.0e-9_wp        !! limit of a difference of coordinates at one location [m]
   integer, parameter :: most = 3                 !! largest number of points, or of pairs of points, named in a message

contains

   !> Adds the messages on the factors of a study. Each kind of message is given at most once per line of the study file, because
   !> `each = .true.` creates many factors.
   subroutine factor_remarks(study, design, paths, words)
      type(study_t), intent(in) :: study
      type(definition_t), intent(in) :: design                 !! design of the deck
      type(factor_paths_t), intent(in) :: paths(:)         !! paths of each factor
      type(message_list_t), intent(inout) :: words
      logical :: is_moved(size(design%records)), is_new(3)
      character(:), allocatable :: list
      integer :: f

      is_new = .true.
      do f = 1, size(paths)
         associate (factor => study%factors(f))
            if (f > 1) is_new = is_new .or. study%factors(max(f - 1, 1))%where /= factor%where
            call find_moved(design, paths(f), is_moved)
            list = ''
            if (any(index(factor%paths, '*') > 0) .or. factor%is_of_pattern) call wheel_points(design, is_moved, list)
            if (len(list) > 0 .and. is_new(1)) then
               is_new(1) = .false.
               call words%add(factor%where//': factor '//quoted(factor%name)//': the paths also move '//list// &
                  ' of a wheel; if only the suspension is to move, name its points')
            end if
            call parted_points(design, is_moved, list)
            if (len(list) > 0 .and. is_new(2)) then
               is_new(2) = .false.
               call words%add(factor%where//': factor '//quoted(factor%name)//': it moves '//list// &
                  ' at the same location; if they are one point, let one factor move both')
            end if
            list = replaced_key(design, paths(f))
            if (len(list) > 0 .and. is_new(3)) then
               is_new(3) = .false.
               call words%add(factor%where//': factor '//quoted(factor%name)//': it changes '//list//', which has no effect, '// &
                  'because the preload trim (balance in &model) replaces it; set balance = .false. in this &spring, or remove '// &
                  'the factor')
            end if
         end associate
      end do
   end subroutine factor_remarks

   !> The preload or free length of a spring that a factor changes although the preload trim replaces it: "preload of spring 'coil'".
   !> '' if there is none. With more springs than wheels the trim distributes the load according to the given preloads, so that they
   !> have an effect.
   function replaced_key(design, paths) result(text)
      type(definition_t), intent(in) :: design
      type(factor_paths_t), intent(in) :: paths
      character(:), allocatable :: text
      integer :: j

      text = ''
      if (all(setting_of_model(design, 'balance') /= [character(6) :: 'spring', 'all'])) return
      if (count_of(design, group_names(spring_group)) > count_of(design, group_names(wheel_group))) return
      do j = 1, size(paths%found)
         associate (p => design%parameters%list(paths%found(j)%number))
            if (p%record <= 0 .or. all(p%key /= [character(14) :: 'preload', 'free_length'])) cycle
            if (design%records(p%record)%group /= group_names(spring_group)) cycle
            if (element(design%records(p%record), 'balance', 1) /= '') cycle
            if (element(design%records(p%record), 'curve', 1) /= '') cycle
            text = trim(p%key)//' of spring '//quoted(element(design%records(p%record), 'name', 1))
            return
         end associate
      end do
   end function replaced_key

   !> A word of &model; '' if the deck does not give it.
   function setting_of_model(design, key) result(word)
      type(definition_t), intent(in) :: design
      character(*), intent(in) :: key
      character(:), allocatable :: word
      integer :: k

      word = ''
      do k = 1, size(design%records)
         if (design%records(k)%group == group_names(model_group)) word = element(design%records(k), key, 1)
      end do
   end function setting_of_model

   !> Number of records of a group in the mirrored deck.
   integer function count_of(design, group) result(number)
      type(definition_t), intent(in) :: design
      character(*), intent(in) :: group
      integer :: k

      number = 0
      do k = 1, size(design%records)
         if (design%records(k)%group == group) number = number + 1
      end do
   end function count_of

   !> A message on a number of Sobol' points that is no power of 2; '' otherwise. Only the first 2ᵐ points have one point in each of
   !> 2ᵐ equal intervals of every factor. Other numbers lose this balance and much of the accuracy.
   function sample_remark(study) result(words)
      type(study_t), intent(in) :: study
      character(:), allocatable :: words
      integer(i8) :: below

      words = ''
      if (study%kind /= sobol_kind .and. study%kind /= saltelli_kind) return
      associate (n => study%settings%size)
         if (n < 1 .or. popcnt(n) == 1) return
         below = shiftl(1_i8, bit_size(n) - 1 - leadz(n))
         words = study%where//': samples = '//str(int(n))//' is no power of 2, so the Sobol'' points are not balanced; use '// &
            str(int(below))//' or '//str(int(2_i8*below))
      end associate
   end function sample_remark

   !> Marks the points that a factor moves, by one or more coordinates.
   subroutine find_moved(design, paths, is_moved)
      type(definition_t), intent(in) :: design
      type(factor_paths_t), intent(in) :: paths
      logical, intent(out) :: is_moved(:)                  !! whether each record is a point that the factor moves
      integer :: j

      is_moved = .false.
      do j = 1, size(paths%found)
         associate (record => design%parameters%list(paths%found(j)%number)%record)
            if (record > 0) is_moved(record) = is_moved(record) .or. design%records(record)%group == group_names(point_group)
         end associate
      end do
   end subroutine find_moved

   !> Lists the moved points of wheels, for instance "'contact_patch', 'wheel_centre'"; '' if no such point is moved.
   subroutine wheel_points(design, is_moved, list)
      type(definition_t), intent(in) :: design
      logical, intent(in) :: is_moved(:)
      character(:), allocatable, intent(out) :: list
      integer :: k, found

      list = ''
      found = 0
      do k = 1, size(is_moved)
         if (.not. is_moved(k)) cycle
         if (.not. is_of_wheel(design, element(design%records(k), 'name', 1))) cycle
         found = found + 1
         if (found <= most) list = list//', '//quoted(element(design%records(k), 'name', 1))
      end do
      list = list(min(3, len(list) + 1):)
      if (found > most) list = list//' and '//str(found - most)//' more points'
   end subroutine wheel_points

   !> Whether a wheel names a point as its centre or its contact point.
   logical function is_of_wheel(design, name)
      type(definition_t), intent(in) :: design
      character(*), intent(in) :: name
      integer :: k

      is_of_wheel = .false.
      do k = 1, size(design%records)
         if (design%records(k)%group /= 'wheel') cycle
         is_of_wheel = is_of_wheel .or. element(design%records(k), 'centre', 1) == name .or. &
            element(design%records(k), 'contact', 1) == name
      end do
   end function is_of_wheel

   !> Lists moved points that coincide with a point that is not moved: "'strut_top', but not 'spring_upper_seat'". '' if there is no
   !> such point.
   subroutine parted_points(design, is_moved, list)
      type(definition_t), intent(in) :: design
      logical, intent(in) :: is_moved(:)
      character(:), allocatable, intent(out) :: list
      real(wp) :: at(3, size(is_moved))
      logical :: is_point(size(is_moved))
      integer :: k, j, found

      call place_points(design, at, is_point)
      list = ''
      found = 0
      do k = 1, size(is_moved)
         if (.not. is_moved(k)) cycle
         do j = 1, size(is_moved)
            if (.not. is_point(j) .or. is_moved(j)) cycle
            if (maxval(abs(at(:, k) - at(:, j))) > same) cycle
            found = found + 1
            if (found <= most) list = list//', '//quoted(element(design%records(k), 'name', 1))//', but not '// &
               quoted(element(design%records(j), 'name', 1))
            exit
         end do
      end do
      list = list(min(3, len(list) + 1):)
      if (found > most) list = list//' and '//str(found - most)//' more'
   end subroutine parted_points

   !> Finds the locations of all points whose three coordinates are numbers of the deck.
   subroutine place_points(design, at, is_point)
      type(definition_t), intent(in) :: design
      real(wp), intent(out) :: at(:, :)                    !! location of each record [m]
      logical, intent(out) :: is_point(:)
      integer :: k, given(size(is_point))

      at = 0.0_wp
      given = 0
      do k = 1, design%parameters%used
         associate (p => design%parameters%list(k))
            if (p%record <= 0 .or. p%at < 1 .or. p%at > 3) cycle
            if (design%records(p%record)%group /= group_names(point_group)) cycle
            at(p%at, p%record) = design%parameters%x(k)
            given(p%record) = given(p%record) + 1
         end associate
      end do
      is_point = given == 3
   end subroutine place_points

end module ek_factor_remark
