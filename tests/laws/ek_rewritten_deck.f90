!> A deck in mm, N, deg (and kg) rewritten in other units: each number times a factor, by a table of dimensions of its own, which
!> does not use the table of the reader.
module ek_rewritten_deck
   use ek_kinds, only: wp
   use ek_text, only: lower
   use ek_decimal, only: checked_number
   use ek_deck, only: deck_t
   use ek_record, only: record_t, entry_t, element, entry_index, is_given, add_value, add_entry
   implicit none(type, external)
   private
   public :: rewrite_units

   !> Keys of one dimension: powers of length, force and angle, as L, F, A, M; a blank separates factors, '/' precedes the divisor.
   type :: row_t
      character(6) :: dimension
      character(320) :: keys
   end type row_t

   type(row_t), parameter :: rows(*) = [ &
      row_t('L', ' point.at wheel.radius wheel.crown_radius wheel.tyre_width axle.wheelbase axle.cg_height'// &
         ' axle.front_overhang'// &
         ' axle.front_width spring.free_length stop.clearance stop.rounding stop.property_offset steering.ratio steering.travel'// &
         ' case.offset case.tolerance model.start_height load_state.height '), &
      row_t('F', ' load.force bushing.preload_force damper.gas_force axle.axle_load model.start_load load_state.wheel_load '), &
      row_t('FL', ' load.moment bushing.preload_moment torsion.preload '), &
      row_t('F/L', ' bushing.kt stop.rate damper.gas_rate wheel.tyre_rate '), &
      row_t('FL/A', ' bushing.kr torsion.rate '), &
      row_t('A', ' wheel.toe wheel.camber '), &
      row_t('M', ' body.mass wheel.sprung_mass axle.mass load_state.added_mass ')]

contains

   !> Rewrites all numbers of a deck without &include, &hardpoints and property files.
   subroutine rewrite_units(deck, names, sizes)
      type(deck_t), intent(inout) :: deck
      character(*), intent(in) :: names(:)        !! of length, force, angle (and mass), as in &model; '' leaves the unit out
      real(wp), intent(in) :: sizes(4)            !! units of the new deck in mm, N, deg, kg
      character(*), parameter :: keys(4) = [character(6) :: 'length', 'force', 'angle', 'mass']
      type(entry_t) :: entry
      character(:), allocatable :: dimension
      real(wp) :: value
      integer :: k, e, v, j

      dimension = ''
      do k = 1, deck%used
         associate (record => deck%records(k))
            do e = 1, record%used
               do v = 1, record%entries(e)%used
                  dimension = dimension_text(deck, record, trim(record%entries(e)%key), record%entries(e)%first + v - 1)
                  if (dimension == '' .or. record%entries(e)%values(v)%is_string) cycle
                  value = checked_number(record%entries(e)%values(v)%text)/size_of(dimension, sizes)
                  record%entries(e)%values(v)%text = written(value)
               end do
            end do
            if (record%group /= 'model') cycle
            do j = 1, size(names)
               if (names(j) == '') cycle
               e = entry_index(record, trim(keys(j)), 1)
               if (e > 0) record%entries(e)%values(1)%text = trim(names(j))
               if (e > 0) cycle
               entry = entry_t()
               entry%key = trim(keys(j))
               call add_value(entry, trim(names(j)), .true.)
               call add_entry(record, entry)
            end do
         end associate
      end do
   end subroutine rewrite_units

   !> A number with 17 written, which give the same number back.
   function written(value) result(text)
      real(wp), intent(in) :: value
      character(:), allocatable :: text
      character(32) :: buffer

      write (buffer, '(es25.16e3)') value
      text = trim(adjustl(buffer))
   end function written

   !> The SI-free size of a dimension: the product of the sizes of its units.
   pure real(wp) function size_of(dimension, sizes)
      character(*), intent(in) :: dimension
      real(wp), intent(in) :: sizes(4)
      integer :: j
      logical :: is_divisor

      size_of = 1.0_wp
      is_divisor = .false.
      do j = 1, len(dimension)
         if (dimension(j:j) == '/') then
            is_divisor = .true.
         else if (is_divisor) then
            size_of = size_of/sizes(index('LFAM', dimension(j:j)))
         else
            size_of = size_of*sizes(index('LFAM', dimension(j:j)))
         end if
      end do
   end function size_of

   !> The dimension of element `at` of a key; '' for strings, pure numbers and numbers in fixed units.
   function dimension_text(deck, record, key, at) result(dimension)
      type(deck_t), intent(in) :: deck
      type(record_t), intent(in) :: record
      character(*), intent(in) :: key
      integer, intent(in) :: at
      character(:), allocatable :: dimension, kind
      integer :: k

      dimension = ''
      do k = 1, size(rows)
         if (index(rows(k)%keys, ' '//record%group//'.'//key//' ') > 0) dimension = trim(rows(k)%dimension)
      end do
      kind = measure_type(deck, record)
      select case (record%group//'.'//key)
      case ('spring.rate', 'joint.stiffness')
         dimension = 'F/L'
         if (kind == 'rotation') dimension = 'FL/A'
         if (kind == 'axes') dimension = 'FL'
      case ('spring.preload')
         dimension = 'F'
         if (kind == 'rotation' .or. kind == 'axes') dimension = 'FL'
      case ('curve.x', 'curve.y')
         dimension = dimension_of_curve(deck, element(record, 'name', 1), key == 'x')
      case ('case.from', 'case.to')
         dimension = swept_of(deck, record)
      case ('case.steer_from', 'case.steer_to')
         dimension = steered_by(deck, record)
      end select
      if (at < 1) dimension = ''
   end function dimension_text

   !> The type of the measure that a record names; '' for none.
   function measure_type(deck, record) result(kind)
      type(deck_t), intent(in) :: deck
      type(record_t), intent(in) :: record
      character(:), allocatable :: kind
      integer :: k

      kind = ''
      if (.not. is_given(record, 'measure')) return
      do k = 1, deck%used
         if (deck%records(k)%group /= 'measure') cycle
         if (element(deck%records(k), 'name', 1) == element(record, 'measure', 1)) kind = lower(element(deck%records(k), 'type', 1))
      end do
   end function measure_type

   !> The dimension of x or y of a curve, from the element that uses it.
   function dimension_of_curve(deck, name, is_x) result(dimension)
      type(deck_t), intent(in) :: deck
      character(*), intent(in) :: name
      logical, intent(in) :: is_x
      character(:), allocatable :: dimension, word
      integer :: k, w

      dimension = ''
      do k = 1, deck%used
         associate (record => deck%records(k))
            if (.not. is_given(record, 'curve')) cycle
            do w = 1, 6
               word = element(record, 'curve', w)
               if (word(index(word, '=') + 1 + merge(1, 0, index(word, '=-') > 0):) /= name) cycle
               dimension = trim(merge('L', 'F', is_x))
               if (record%group == 'torsion' .or. (record%group == 'bushing' .and. index(word, 'm') == 1)) &
                  dimension = trim(merge('A ', 'FL', is_x))
            end do
         end associate
      end do
   end function dimension_of_curve

   !> The dimension of the swept value of a case.
   function swept_of(deck, record) result(dimension)
      type(deck_t), intent(in) :: deck
      type(record_t), intent(in) :: record
      character(:), allocatable :: dimension

      dimension = ''
      select case (lower(element(record, 'test', 1)))
      case ('parallel_travel', 'opposite_travel', 'single_travel', 'travel_and_steering')
         dimension = 'L'
         if (lower(element(record, 'vertical', 1)) == 'force') dimension = 'F'
      case ('roll')
         dimension = 'A'
      case ('lateral_force', 'braking', 'traction', 'vertical_force')
         dimension = 'F'
      case ('steering')
         dimension = steered_by(deck, record)
      case ('')
         if (is_given(record, 'drive')) dimension = steered_by(deck, record)
         if (element(record, 'drive', 1) == 'wheel_travel') dimension = 'L'
      end select
   end function swept_of

   !> The dimension of the driver of a case: its own, or that of &steering.
   function steered_by(deck, record) result(dimension)
      type(deck_t), intent(in) :: deck
      type(record_t), intent(in) :: record
      character(:), allocatable :: dimension, name, kind
      integer :: k

      name = element(record, 'drive', 1)
      do k = 1, deck%used
         if (name == '' .and. deck%records(k)%group == 'steering') name = element(deck%records(k), 'driver', 1)
      end do
      dimension = 'L'
      do k = 1, deck%used
         if (deck%records(k)%group /= 'joint') cycle
         if (name /= '' .and. element(deck%records(k), 'name', 1) /= name) cycle
         if (lower(element(deck%records(k), 'type', 1)) /= 'driver') cycle
         kind = measure_type(deck, deck%records(k))
         if (kind == 'rotation') dimension = 'A'
         if (kind == 'axes') dimension = ''
      end do
   end function steered_by

end module ek_rewritten_deck
