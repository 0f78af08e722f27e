!> A map as plain tables: kinematics over travel and steer, response to loads, and compliance matrix. The tables are written as CSV
!> and as one JSON object.
!>
!> Units are mm, deg, N, N m. The frame is ISO 8855 (x forward, y to the left, z up) or SAE J670 (x forward, y to the right, z
!> down). Toe, camber, caster, travel, lengths and wheel load have the same sign in both frames.
module ek_plain_tables
   use ek_kinds, only: wp, degree, millimetre
   use ek_text, only: str
   use ek_json, only: json_t, json_string, json_numbers
   use ek_table, only: table_t, new_table, name_length
   use ek_version, only: version
   use ek_wheel_side, only: side_name
   use ek_wheel_motion, only: quantities, at_tx, at_rx, at_toe, at_camber, at_caster, at_patch, at_load
   use ek_kandc_map, only: kandc_map_t
   use ek_map_request, only: over_steer, over_opposite
   use ek_load_response, only: load_table_result_t, load_parts, load_heads
   implicit none(type, external)
   private
   public :: kinematics_table, defined_map_table, loads_table, compliance_of_map, tables_json

   character(*), parameter :: heads(quantities) = [character(18) :: 'x_mm', 'y_mm', 'z_mm', 'rx_deg', 'ry_deg', 'rz_deg', &
      'spring_length_mm', 'damper_length_mm', 'stop_length_mm', 'bar_length_mm', 'toe_deg', 'camber_deg', 'caster_deg', &
      'patch_x_mm', 'patch_y_mm', 'patch_z_mm', 'wheel_load_n']
   character(*), parameter :: moves(6) = [character(2) :: 'x', 'y', 'z', 'rx', 'ry', 'rz']

contains

   !> SI values of the units of the quantities, with the signs of the frame.
   pure function unit_sizes(is_sae) result(sizes)
      logical, intent(in) :: is_sae
      real(wp) :: sizes(quantities)
      real(wp) :: frame(3)

      frame = signs(is_sae)
      sizes = millimetre
      sizes(at_tx:at_tx + 2) = millimetre*frame
      sizes(at_rx:at_rx + 2) = degree*frame
      sizes([at_toe, at_camber, at_caster]) = degree
      sizes(at_patch + 1:at_patch + 3) = millimetre*frame
      sizes(at_load) = 1.0_wp
   end function unit_sizes

   !> Signs of x, y, z for the conversion from ISO to the frame of the tables.
   pure function signs(is_sae) result(frame)
      logical, intent(in) :: is_sae
      real(wp) :: frame(3)
      frame = 1.0_wp
      if (is_sae) frame(2:) = -1.0_wp
   end function signs

   !> The table of kinematics, one row per point of the map: travel, steer or opposite travel, then the quantities of the left and
   !> of the right wheel.
   function kinematics_table(map, is_sae, checksum) result(table)
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_sae
      character(*), intent(in) :: checksum
      type(table_t) :: table
      character(name_length), allocatable :: columns(:)
      real(wp) :: sizes(quantities)
      integer :: i, j, row, n

      sizes = unit_sizes(is_sae)
      n = size(map%second)
      call wheel_columns(columns, 2)
      columns(:2) = arguments(map)
      table = new_table(columns, size(map%travel)*n)
      call add_head(table, map, is_sae, checksum)
      row = 0
      do i = 1, size(map%travel)
         do j = 1, n
            row = row + 1
            table%values(:2, row) = [map%travel(i), map%second(j)]/millimetre
            table%values(3:quantities + 2, row) = map%value(:, j, i, 1)/sizes
            if (map%kind == over_opposite) then      ! the own travel of the right wheel is the second of the row
               table%values(quantities + 3:, row) = map%value(:, i, j, 2)/sizes
            else
               table%values(quantities + 3:, row) = map%value(:, j, i, 2)/sizes
            end if
         end do
      end do
   end function kinematics_table

   !> The table of kinematics in the definitions of another program, one row per point of the map: travel, steer or opposite travel,
   !> then the columns of the program. For a deck with one wheel, the table has the columns of this wheel only.
   function defined_map_table(map, checksum) result(table)
      type(kandc_map_t), intent(in) :: map               !! with `defined`
      character(*), intent(in) :: checksum
      type(table_t) :: table
      integer :: i, j, k, n

      n = size(map%second)
      table = new_table([character(name_length) :: arguments(map), map%defined%columns], size(map%travel)*n)
      call add_source(table, map, checksum)
      do k = 1, map%defined%header%count()
         call table%header%add(map%defined%header%line(k))
      end do
      do i = 1, size(map%travel)
         do j = 1, n
            table%values(:2, (i - 1)*n + j) = [map%travel(i), map%second(j)]/millimetre
         end do
      end do
      table%values(3:, :) = map%defined%values
   end function defined_map_table

   !> The headings of the arguments of a map.
   pure function arguments(map) result(columns)
      type(kandc_map_t), intent(in) :: map
      character(name_length) :: columns(2)

      columns = [character(name_length) :: 'travel_mm', 'steer_mm']
      if (map%kind == over_opposite) columns = [character(name_length) :: 'left_travel_mm', 'right_travel_mm']
   end function arguments

   !> Allocates `before` columns, and the columns of both wheels.
   subroutine wheel_columns(columns, before)
      character(name_length), allocatable, intent(out) :: columns(:)
      integer, intent(in) :: before
      integer :: side, k

      allocate (columns(before + 2*quantities))
      do side = 1, 2
         do k = 1, quantities
            columns(before + (side - 1)*quantities + k) = trim(side_name(side))//'_'//heads(k)
         end do
      end do
   end subroutine wheel_columns

   !> The table of loads, one row per state: the loads on the left and on the right wheel, then the quantities of both wheels. For a
   !> deck with one wheel, the table has the quantities of this wheel only.
   function loads_table(map, loads, is_sae, checksum) result(table)
      type(kandc_map_t), intent(in) :: map
      type(load_table_result_t), intent(in) :: loads
      logical, intent(in) :: is_sae
      character(*), intent(in) :: checksum
      type(table_t) :: table
      character(name_length), allocatable :: columns(:)
      real(wp) :: sizes(quantities), frame(6)
      integer :: side, k, row, first(2)

      sizes = unit_sizes(is_sae)
      frame(:3) = signs(is_sae)
      frame(4:) = frame(:3)
      call wheel_columns(columns, 10)
      first = [10, 10 + quantities]                  ! columns before those of each wheel
      if (map%is_mirrored(1)) columns = [columns(:10), columns(11 + quantities:)]
      if (map%is_mirrored(1)) first(2) = 10
      if (map%is_mirrored(2)) columns = columns(:10 + quantities)
      do side = 1, 2
         do k = 1, 5
            columns(5*(side - 1) + k) = trim(side_name(side))//'_'//load_heads(k)
         end do
      end do
      table = new_table(columns, size(loads%load, 2))
      call add_head(table, map, is_sae, checksum)
      call table%header%add('forces at the contact point; '//held_text(map))
      do row = 1, size(loads%load, 2)
         do k = 1, 5
            table%values([k, k + 5], row) = loads%load([k, k + 5], row)*frame(load_parts(k))
         end do
         do side = 1, 2
            k = first(side)
            if (.not. map%is_mirrored(side)) table%values(k + 1:k + quantities, row) = loads%value(:, row, side)/sizes
         end do
      end do
   end function loads_table

   !> The compliance matrix at design: one row per load, in mm and deg per N and N m.
   function compliance_of_map(map, is_sae, checksum) result(table)
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_sae
      character(*), intent(in) :: checksum
      type(table_t) :: table
      character(name_length) :: columns(12)
      real(wp) :: frame(6), sizes(6)
      integer :: side, load, k, row

      frame(:3) = signs(is_sae)
      frame(4:) = frame(:3)
      sizes(:3) = millimetre
      sizes(4:) = degree
      do side = 1, 2
         do k = 1, 6
            columns(6*(side - 1) + k) = trim(side_name(side))//'_'//trim(moves(k))//trim(merge('_mm ', '_deg', k <= 3))
         end do
      end do
      table = new_table(columns, 12)
      call add_head(table, map, is_sae, checksum)
      call table%header%add('compliance at design, displacements of the wheel centres per N or N m there; '//held_text(map))
      call table%header%add('rows: left fx fy fz mx my mz, right fx fy fz mx my mz')
      do row = 1, 12
         load = mod(row - 1, 6) + 1
         do side = 1, 2
            k = load
            if (side /= (row + 5)/6) k = load + 6
            table%values(6*side - 5:6*side, row) = map%compliance(:, k, side)*frame/sizes*frame(load)
         end do
      end do
   end function compliance_of_map

   pure function held_text(map) result(text)
      type(kandc_map_t), intent(in) :: map
      character(:), allocatable :: text

      select case (map%held)
      case ('road')
         text = 'contact points held on the road by the tyre rate'
      case ('centre')
         text = 'wheel centres at constant height'
      case default
         text = 'vertical loads constant'
      end select
   end function held_text

   subroutine add_head(table, map, is_sae, checksum)
      type(table_t), intent(inout) :: table
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_sae
      character(*), intent(in) :: checksum
      integer :: side

      call add_source(table, map, checksum, is_sae)
      do side = 1, 2
         if (map%is_mirrored(side)) call table%header%add(trim(side_name(side))// &
            ' wheel: mirror image of the other; the deck has one wheel')
      end do
   end subroutine add_head

   !> Adds the header lines on program, deck, frame and arguments.
   subroutine add_source(table, map, checksum, is_sae)
      type(table_t), intent(inout) :: table
      type(kandc_map_t), intent(in) :: map
      character(*), intent(in) :: checksum
      logical, intent(in), optional :: is_sae              !! absent: no line on the frame

      call table%header%add('elastokin '//version//', model '//map%model//', deck checksum '//checksum)
      if (present(is_sae)) call table%header%add(frame_text(is_sae))
      call table%header%add('travel: height of the '//trim(place(map))//' above design, positive up')
      if (map%kind == over_steer) call table%header%add('steer: driver '//map%driver//' times '//str(map%driver_sign)// &
         ', positive: wheels to the left')
   end subroutine add_source

   !> Phrase for the point whose height defines the wheel travel.
   pure function place(map) result(text)
      type(kandc_map_t), intent(in) :: map
      character(13) :: text
      text = 'contact point'
      if (map%vertical == 'road') text = 'road'
      if (map%vertical == 'centre') text = 'wheel centre'
   end function place

   pure function frame_text(is_sae) result(text)
      logical, intent(in) :: is_sae
      character(:), allocatable :: text

      text = 'ISO 8855: x forward, y to the left, z up'
      if (is_sae) text = 'SAE J670: x forward, y to the right, z down'
      text = text//'; relative to design, rotations with the static angles; toe + front inward, camber + top outward, '// &
         'caster + top rearward'
   end function frame_text

   !> All tables as one JSON object (schema/export-tables.schema.json).
   function tables_json(names, tables, map, is_sae, checksum) result(text)
      character(*), intent(in) :: names(:)
      type(table_t), intent(in) :: tables(:)
      type(kandc_map_t), intent(in) :: map
      logical, intent(in) :: is_sae
      character(*), intent(in) :: checksum
      character(:), allocatable :: text
      type(json_t) :: json
      integer :: t, k

      call json%open('{')
      call json%item('program', json_string('elastokin '//version))
      call json%item('model', json_string(map%model))
      call json%item('title', json_string(map%title))
      call json%item('deck_checksum', json_string(checksum))
      call json%item('signs', json_string(trim(merge('SAE J670', 'ISO 8855', is_sae))))
      call json%item('frame', json_string(frame_text(is_sae)))
      call json%open('{', 'tables')
      do t = 1, size(tables)
         call json%open('{', trim(names(t)))
         if (names(t) == 'compliance') call json%item('loads', &
            '["left_fx_n", "left_fy_n", "left_fz_n", "left_mx_nm", "left_my_nm", "left_mz_nm", '// &
            '"right_fx_n", "right_fy_n", "right_fz_n", "right_mx_nm", "right_my_nm", "right_mz_nm"]')
         call json%open('{', 'columns')
         do k = 1, size(tables(t)%columns)
            call json%item(trim(tables(t)%columns(k)), json_numbers(tables(t)%values(k, :)))
         end do
         call json%close('}')
         call json%close('}')
      end do
      call json%close('}')
      call json%close('}')
      text = json%text()
   end function tables_json

end module ek_plain_tables
