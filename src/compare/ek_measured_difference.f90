!> Differences of models from measured curves, for `compare --measured`: one sentence for each model, the rows as text, JSON and
!> CSV.
!>
!>     left toe in parallel_travel: slope -2.5 measured, -0.31 deg/m computed, rms 0.055 deg; 2 of 3 curves agree within 1 % of the
!>     range
!>
!> A slope of the opposite sign is before all others. The others are in the order of rms as a share of the scale of the curve: its
!> measured range, or the least span of a chart if that is larger. A second model is compared with the first by their rms.
module ek_measured_difference
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   use ek_text, only: str, plural
   use ek_buffer, only: buffer_t
   use ek_quantity, only: quantity_t, quantity_named, slope_unit, unit_text, without_phase
   use ek_rig_test, only: rig_test_t, rig_test
   use ek_change, only: least_of, letter_of
   use ek_frame, only: frame_t, new_frame
   use ek_json, only: json_t, json_string
   use ek_key_numbers, only: without_side
   use ek_measurement, only: measurement_t, channel_t, put_measured, measured_heads
   use ek_test_result, only: test_result_t, travel_column
   use ek_comparison, only: descending
   implicit none(type, external)
   private
   public :: measured_model_t, measured_sentences, measured_text, measured_json, measured_differences

   integer, parameter :: most_items = 3

   !> A model and its measured curves, compared.
   type :: measured_model_t
      character(:), allocatable :: path, name, checksum      !! deck, model, checksum of the deck
      type(test_result_t), allocatable :: tests(:)           !! tests of the model; those with a measurement are solved
      type(measurement_t), allocatable :: measured(:)        !! the same files and curves in every model
   end type measured_model_t

   !> A measured curve in the sentence.
   type :: item_t
      character(:), allocatable :: text
      real(wp) :: share = -1.0_wp      !! rms, or change of rms, as a share of the scale of the curve; -1: no point is compared
      logical :: is_flip = .false.     !! the slopes have opposite signs
   end type item_t

contains

   !> Lists one sentence for each model; with several models, each begins with its letter.
   subroutine measured_sentences(models, threshold, lines)
      type(measured_model_t), intent(in) :: models(:)
      real(wp), intent(in) :: threshold            !! least share of the scale of a curve that is mentioned
      type(message_list_t), intent(out) :: lines
      character(:), allocatable :: line
      integer :: r

      line = ''
      do r = 1, size(models)
         if (r == 1) line = sentence_of(models(1), threshold)
         if (r > 1) line = change_sentence(models(1), models(r), threshold)
         if (size(models) > 1) line = letter_of(r)//': '//line
         call lines%add(line)
      end do
   end subroutine measured_sentences

   !> The largest deviations of a model, and the number of curves that agree.
   function sentence_of(model, threshold) result(text)
      type(measured_model_t), intent(in) :: model
      real(wp), intent(in) :: threshold
      character(:), allocatable :: text
      type(item_t), allocatable :: items(:)
      integer :: m, c, used, agreeing, lost

      allocate (items(curves_of(model)))
      used = 0
      do m = 1, size(model%measured)
         do c = 1, size(model%measured(m)%channels)
            used = used + 1
            call deviation_item(model, m, c, threshold, items(used))
         end do
      end do
      agreeing = count(items%share >= 0.0_wp .and. items%share <= threshold .and. .not. items%is_flip)
      if (agreeing == used) then
         text = 'the model agrees with '//plural(used, 'measured curve', 'measured curves')//' within '//percent(threshold)// &
            ' of the range'
         return
      end if
      text = joined(items, threshold, '; ')
      if (text /= '') text = text//'; '
      text = text//str(agreeing)//' of '//plural(used, 'curve agrees', 'curves agree')//' within '//percent(threshold)// &
         ' of the range'
      lost = count(items%share < 0.0_wp)
      if (lost > 0) text = text//'; '//plural(lost, 'curve has', 'curves have')//' no point that can be compared'
   end function sentence_of

   !> The changes of rms from the first model to another model, and the number of curves to which it is nearer.
   function change_sentence(first, other, threshold) result(text)
      type(measured_model_t), intent(in) :: first, other
      real(wp), intent(in) :: threshold
      character(:), allocatable :: text
      type(item_t), allocatable :: items(:)
      real(wp) :: before, after
      integer :: m, c, used, nearer, farther

      allocate (items(curves_of(first)))
      used = 0
      nearer = 0
      farther = 0
      do m = 1, size(first%measured)
         do c = 1, size(first%measured(m)%channels)
            used = used + 1
            before = first%measured(m)%channels(c)%rms
            after = other%measured(m)%channels(c)%rms
            associate (channel => first%measured(m)%channels(c))
               if (.not. (ieee_is_finite(before) .and. ieee_is_finite(after))) cycle
               items(used)%share = abs(after - before)/scale_of(channel)
               items(used)%text = 'rms of '//curve_name(first, m, c)//' '//str(before, 3)//' → '//str(after, 3)// &
                  unit_behind(channel%unit)
            end associate
            items(used)%is_flip = is_opposite(first%measured(m), c, threshold) .neqv. is_opposite(other%measured(m), c, threshold)
            if (items(used)%is_flip) items(used)%text = items(used)%text//' (its slope has the measured sign '// &
               trim(merge('in A only', 'now      ', is_opposite(other%measured(m), c, threshold)))//')'
            if (.not. items(used)%share > threshold) cycle
            if (after < before) nearer = nearer + 1
            if (after > before) farther = farther + 1
         end do
      end do
      text = joined(items, threshold, ', ')
      if (text == '') text = 'no rms changed by more than '//percent(threshold)//' of the range'
      text = text//'; nearer than A to '//str(nearer)//', farther from '//str(farther)//' of '//plural(used, 'curve', 'curves')
   end function change_sentence

   !> The largest items as a phrase; '' if none is above the threshold.
   function joined(items, threshold, mark) result(text)
      type(item_t), intent(in) :: items(:)
      real(wp), intent(in) :: threshold
      character(*), intent(in) :: mark             !! between two items
      character(:), allocatable :: text
      real(wp) :: sizes(size(items))
      integer :: order(size(items)), k, used

      sizes = items%share
      where (items%is_flip) sizes = sizes + 1.0e9_wp
      order = descending(sizes)
      text = ''
      used = 0
      do k = 1, size(items)
         associate (item => items(order(k)))
            if (used == most_items) exit
            if (.not. (item%is_flip .or. item%share > threshold)) cycle
            if (used > 0) text = text//mark
            text = text//item%text
            used = used + 1
         end associate
      end do
   end function joined

   !> Describes the deviation of a curve.
   subroutine deviation_item(model, m, c, threshold, item)
      type(measured_model_t), intent(in) :: model
      integer, intent(in) :: m, c                  !! indices of the measurement and of its curve
      real(wp), intent(in) :: threshold
      type(item_t), intent(out) :: item
      character(:), allocatable :: unit
      real(wp) :: factor

      associate (channel => model%measured(m)%channels(c))
         if (ieee_is_finite(channel%rms)) item%share = channel%rms/scale_of(channel)
         item%is_flip = is_opposite(model%measured(m), c, threshold)
         item%text = curve_name(model, m, c)//': '
         if (ieee_is_finite(channel%slope) .and. ieee_is_finite(channel%model_slope)) then
            call unit_of_slope(model, m, c, unit, factor)
            item%text = item%text//'slope '//str(factor*channel%slope, 3)//' measured, '//str(factor*channel%model_slope, 3)// &
               unit_behind(unit)//' computed'
            if (item%is_flip) item%text = item%text//' (opposite sign)'
            item%text = item%text//', '
         end if
         item%text = item%text//'rms '//str(channel%rms, 3)//unit_behind(channel%unit)
      end associate
   end subroutine deviation_item

   !> Whether the measured and the computed slope of a curve have opposite signs, and differ by more than the threshold over the
   !> window.
   pure logical function is_opposite(measurement, c, threshold)
      type(measurement_t), intent(in) :: measurement
      integer, intent(in) :: c
      real(wp), intent(in) :: threshold

      is_opposite = .false.
      associate (channel => measurement%channels(c))
         if (.not. (ieee_is_finite(channel%slope) .and. ieee_is_finite(channel%model_slope))) return
         if (channel%slope*channel%model_slope < 0.0_wp) is_opposite = &
            2*measurement%half*abs(channel%slope - channel%model_slope) > threshold*scale_of(channel)
      end associate
   end function is_opposite

   !> The scale of a curve: its measured range, or the least span of a chart in its unit if that is larger.
   pure real(wp) function scale_of(channel)
      type(channel_t), intent(in) :: channel
      logical :: is_there(size(channel%y))

      is_there = ieee_is_finite(channel%y)
      scale_of = tiny(1.0_wp)
      if (any(is_there)) scale_of = max(scale_of, maxval(channel%y, is_there) - minval(channel%y, is_there))
      scale_of = max(scale_of, least_of(trim(channel%unit)))
   end function scale_of

   !> The name of a curve: 'left toe in parallel_travel'.
   function curve_name(model, m, c) result(name)
      type(measured_model_t), intent(in) :: model
      integer, intent(in) :: m, c
      character(:), allocatable :: name, column, bare

      column = trim(model%measured(m)%channels(c)%column)
      bare = trim(without_side(column))
      name = trim(without_phase(trim(without_sign(bare))))
      if (bare /= column) name = column(:index(column, '_') - 1)//' '//name
      name = name//' in '//model%measured(m)%test

   contains

      !> The title of a column in lower case, or the column itself if it has no title.
      function without_sign(column) result(title)
         character(*), intent(in) :: column
         character(:), allocatable :: title
         type(quantity_t) :: quantity
         quantity = quantity_named(column)
         title = trim(quantity%title)
         if (title == column) return
         if (title(2:2) >= 'a' .and. title(2:2) <= 'z' .and. title(1:1) >= 'A' .and. title(1:1) <= 'Z') &
            title(1:1) = achar(iachar(title(1:1)) + 32)
      end function without_sign

   end function curve_name

   !> Finds the unit of the slopes of a curve, and their values in this unit per unit of the table.
   subroutine unit_of_slope(model, m, c, unit, factor)
      type(measured_model_t), intent(in) :: model
      integer, intent(in) :: m, c
      character(:), allocatable, intent(out) :: unit
      real(wp), intent(out) :: factor
      type(rig_test_t) :: kind
      character(:), allocatable :: over, ending

      kind = rig_test(model%tests(model%measured(m)%place)%kind)
      over = 'factor'
      if (kind%unit == 'mm' .and. kind%abscissa == travel_column) over = travel_column     ! angles per metre
      call slope_unit(without_side(trim(model%measured(m)%channels(c)%column)), over, trim(kind%unit), ending, factor)
      unit = unit_text(ending)
      if (unit /= '–') return
      factor = 1.0_wp
      unit = trim(model%measured(m)%channels(c)%unit)//' per swept value'
   end subroutine unit_of_slope

   !> A unit behind a number: ' deg'; '' without a unit.
   pure function unit_behind(unit) result(text)
      character(*), intent(in) :: unit
      character(:), allocatable :: text

      text = ''
      if (unit /= '' .and. unit /= '–') text = ' '//trim(unit)
   end function unit_behind

   !> A share in percent: '1 %'.
   function percent(share) result(text)
      real(wp), intent(in) :: share
      character(:), allocatable :: text
      text = str(100*share, 4)//' %'
   end function percent

   !> Number of measured curves.
   pure integer function curves_of(model) result(number)
      type(measured_model_t), intent(in) :: model
      integer :: m
      number = sum([(size(model%measured(m)%channels), m=1, size(model%measured))])
   end function curves_of

   !> The string for standard output: the sentences, the decks, and a row for each curve of each deck.
   function measured_text(models, threshold) result(text)
      type(measured_model_t), intent(in) :: models(:)
      real(wp), intent(in) :: threshold
      character(:), allocatable :: text
      type(message_list_t) :: lines
      type(buffer_t) :: out
      integer :: r, m, c, k

      call measured_sentences(models, threshold, lines)
      do k = 1, lines%count()
         call out%line(lines%line(k))
      end do
      call out%line('')
      do r = 1, size(models)
         call out%line(letter_of(r)//': '//models(r)%path)
      end do
      do m = 1, size(models(1)%measured)
         call out%line('')
         call out%line(left(models(1)%measured(m)%test//', '//models(1)%measured(m)%file, 42)// &
            '   points         rms     largest    measured    computed        loop')
         do c = 1, size(models(1)%measured(m)%channels)
            do r = 1, size(models)
               call add_row(models(r), m, c, r)
            end do
         end do
      end do
      text = out%text()

   contains

      subroutine add_row(model, m, c, r)
         type(measured_model_t), intent(in) :: model
         integer, intent(in) :: m, c, r
         character(:), allocatable :: unit
         real(wp) :: factor

         call unit_of_slope(model, m, c, unit, factor)
         associate (channel => model%measured(m)%channels(c))
            call out%add(left(letter_of(r)//'  '//trim(channel%column), 42)//right(str(channel%points), 9))
            call out%add(right(number(channel%rms), 12)//right(number(channel%largest), 12))
            call out%add(right(number(factor*channel%slope), 12)//right(number(factor*channel%model_slope), 12))
            call out%line(right(number(channel%loop), 12)//'  slopes in '//unit//', the others in '//trim(channel%unit))
         end associate
      end subroutine add_row

      !> A number with six digits; '-' for a missing value.
      function number(value) result(word)
         real(wp), intent(in) :: value
         character(:), allocatable :: word
         word = '-'
         if (ieee_is_finite(value)) word = str(value, 5)
      end function number

      pure function left(word, width) result(filled)
         character(*), intent(in) :: word
         integer, intent(in) :: width
         character(:), allocatable :: filled
         filled = word//repeat(' ', max(1, width - len(word)))
      end function left

      pure function right(word, width) result(filled)
         character(*), intent(in) :: word
         integer, intent(in) :: width
         character(:), allocatable :: filled
         filled = repeat(' ', max(1, width - len(word)))//word
      end function right

   end function measured_text

   !> A row for each curve of each deck.
   function rows_of(models) result(frame)
      type(measured_model_t), intent(in) :: models(:)
      type(frame_t) :: frame
      integer :: r

      frame = new_frame('deck,'//measured_heads)
      do r = 1, size(models)
         call frame%put(models(r)%path)
         call frame%hold()
         call put_measured(models(r)%measured, frame)
         call frame%release()
      end do
   end function rows_of

   !> The rows as CSV.
   function measured_differences(models) result(text)
      type(measured_model_t), intent(in) :: models(:)
      character(:), allocatable :: text
      type(frame_t) :: frame

      frame = rows_of(models)
      text = frame%csv()
   end function measured_differences

   !> The sentences and the rows as one JSON object (schema/compare.schema.json).
   function measured_json(models, threshold) result(text)
      type(measured_model_t), intent(in) :: models(:)
      real(wp), intent(in) :: threshold
      character(:), allocatable :: text
      type(message_list_t) :: lines
      type(frame_t) :: frame
      type(json_t) :: json
      integer :: k

      call measured_sentences(models, threshold, lines)
      call json%begin_record(models(1)%name, models(1)%checksum, deck=models(1)%path)
      call json%open('[', 'sentences')
      do k = 1, lines%count()
         call json%item_of_list(json_string(lines%line(k)))
      end do
      call json%close(']')
      frame = rows_of(models)
      call frame%add_json('curves', json)
      call json%close('}')
      text = json%text()
   end function measured_json

end module ek_measured_difference
