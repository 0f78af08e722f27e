!> Difference quotients of columns between neighbouring designs: along the motions of the states, or at states that do not move.
module ek_observed_slopes
   use ek_kinds, only: wp
   use ek_state, only: state_t, inputs_t, design_state
   use ek_case_result, only: case_result_t
   use ek_state_derivative, only: displace
   use ek_stencil, only: stencils, differentiate
   use ek_column_observer, only: column_observer_t, observe_columns, count_blocks, columns_of_block, is_same_block, observe_block
   use ek_direction, only: direction_t
   use ek_neighbour, only: neighbour_t, point_t, go_to
   implicit none(type, external)
   private
   public :: find_slopes_along, add_slopes_at

contains

   !> Finds the difference quotients of the columns along the motions of the states. The first stencil whose points are all valid
   !> designs is used.
   !> Equation (E.2) of docs/theory/derivatives.md.
   subroutine find_slopes_along(motions, x, direction, result, points, here, values, kept, neighbour, observer, can_move, slopes, &
      errors)
      real(wp), intent(in) :: motions(:, :)                !! (unknown, state): dz/dp
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(direction_t), intent(in) :: direction
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      type(inputs_t), intent(in) :: here(:)                !! inputs of the states, of the design itself
      real(wp), intent(in) :: values(:, :)                 !! (column, state)
      real(wp), intent(in) :: kept(:, :, :)                !! (load, unknown, state): data from keep_state
      type(neighbour_t), intent(inout) :: neighbour
      type(column_observer_t), intent(inout) :: observer
      logical, intent(out) :: can_move                     !! .false.: every stencil contains a design that is not valid
      real(wp), intent(inout) :: slopes(:, :), errors(:, :)      !! (column, state)
      type(inputs_t) :: inputs(size(points))
      type(state_t) :: moved
      real(wp) :: step(result%kkt%nq), y(size(values, 1), 4, size(points))
      logical :: has_inputs
      integer :: kind, k, s

      moved = design_state(result%suspension)
      do kind = 1, size(stencils)
         do k = 1, 4
            call go_to(x, direction, stencils(kind)%at(k), result, points, neighbour, inputs, has_inputs, can_move)
            if (.not. can_move) exit
            if (.not. has_inputs) inputs = here
            associate (there => neighbour%workspace%cases(neighbour%case)%result)
               do s = 1, size(points)
                  if (.not. points(s)%is_regular) cycle
                  call displace(points(s)%state, motions(:, s), direction%step*stencils(kind)%at(k), step, moved)
                  call observe_columns(there%suspension, moved, inputs(s), there%kkt, observer, y(:, k, s), kept(:, :, s))
               end do
            end associate
         end do
         if (.not. can_move) cycle
         do s = 1, size(points)
            if (points(s)%is_regular) call differentiate(stencils(kind), direction%step, values(:, s), y(:, :, s), slopes(:, s), &
               errors(:, s))
         end do
         return
      end do
   end subroutine find_slopes_along

   !> Adds the difference quotients of the columns at states that do not move, ∂y/∂p. Only blocks of columns whose numbers differ
   !> between the designs are observed. The columns must follow from states alone (reads_states).
   !> Equation (E.9) of docs/theory/derivatives.md.
   subroutine add_slopes_at(x, direction, result, points, values, neighbour, observer, can_move, slopes, errors)
      real(wp), intent(in) :: x(:)                         !! numbers of the design
      type(direction_t), intent(in) :: direction
      type(case_result_t), intent(in) :: result
      type(point_t), intent(in) :: points(:)
      real(wp), intent(in) :: values(:, :)                 !! (column, state)
      type(neighbour_t), intent(inout) :: neighbour
      type(column_observer_t), intent(inout) :: observer
      logical, intent(out) :: can_move                     !! .false.: every stencil contains a design that is not valid
      real(wp), intent(inout) :: slopes(:, :), errors(:, :)      !! (column, state)
      type(inputs_t) :: inputs(size(points))               ! no column of a state reads the inputs
      real(wp) :: y(size(values, 1), 4, size(points)), slope(size(values, 1)), error(size(values, 1))
      logical :: is_other(count_blocks(observer), 4), has_inputs
      integer :: kind, k, s, b, first, last

      do kind = 1, size(stencils)
         do k = 1, 4
            call go_to(x, direction, stencils(kind)%at(k), result, points, neighbour, inputs, has_inputs, can_move)
            if (.not. can_move) exit
            associate (there => neighbour%workspace%cases(neighbour%case)%result)
               do b = 1, size(is_other, 1)
                  is_other(b, k) = .not. is_same_block(result%suspension, there%suspension, observer, b)
                  if (.not. is_other(b, k)) cycle
                  do s = 1, size(points)
                     if (points(s)%is_regular) call observe_block(there%suspension, points(s)%state, there%kkt, observer, b, &
                        y(:, k, s))
                  end do
               end do
            end associate
         end do
         if (.not. can_move) cycle
         do s = 1, size(points)
            if (.not. points(s)%is_regular) cycle
            do b = 1, size(is_other, 1)
               if (.not. any(is_other(b, :))) cycle
               call columns_of_block(observer, b, first, last)
               do k = 1, 4
                  if (.not. is_other(b, k)) y(first:last, k, s) = values(first:last, s)
               end do
               call differentiate(stencils(kind), direction%step, values(first:last, s), y(first:last, :, s), &
                  slope(first:last), error(first:last))
               slopes(first:last, s) = slopes(first:last, s) + slope(first:last)
               errors(first:last, s) = errors(first:last, s) + error(first:last)
            end do
         end do
         return
      end do
   end subroutine add_slopes_at

end module ek_observed_slopes
