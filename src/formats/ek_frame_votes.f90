!> The frame of a table of hardpoints: its axes, its unit of length and the height of the road. Each is given by an option or
!> decided by votes, at least two and none against; otherwise it is refused, with the votes. Nothing is guessed.
!>
!> A vote is something that holds for every suspension of a car: the lower ball joint is below the upper one, the wheel is
!> outboard of the pivots, the point called front is ahead of the one called rear, half the track is between 0.45 and 1.14 m.
!> A direction is a column of the table with a sign: 3 is the third column upwards, −1 the first column backwards. A vote whose
!> vector does not lie clearly along a column is not counted. All votes are on one half, so that the table of a
!> symmetric axle needs no sides.
module ek_frame_votes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ek_kinds, only: wp, degree
   use ek_text, only: str, lower, plural
   use ek_decimal, only: get_decimal
   use ek_vote, only: ballot_t, add_vote, leader, for, against, reasons, vote_lines, questions, side_name, column_name, &
      take_axes, axes_form, length_names, length_values, of_up, of_outboard, of_forward, of_length
   use ek_point_vote, only: half_t, vote_along, vote_vector, vote_column, vote_sign
   use ek_solid_vote, only: vote_on_solid_up, vote_on_solid_outboard, vote_on_solid_forward
   use ek_point_name, only: point_count, point_names, wheel_centre, contact_patch, lca_front, lca_rear, lower_ball, uca_front, &
      uca_rear, upper_ball, tie_inner, tie_outer, toe_inner, toe_outer, strut_top, strut_low, arm_inner, arm_outer, &
      upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, lower_out, trailing_front, trailing_rear, &
      damper_top, spring_top, kingpin_low, kingpin_top
   implicit none(type, external)
   private
   public :: half_t, point_set_t, wish_t, frame_t, find_frame

   !> The points of an axle.
   type :: point_set_t
      type(half_t) :: half(2)                !! left and right; without sides, all points are in the first
      logical :: is_sided = .false.          !! the table names the sides
      integer :: axle = 0                    !! 0 not known, 1 front, 2 rear
      logical :: has_other = .false.         !! the wheel centre of the other axle, of the same side, is known
      real(wp) :: other_centre(3) = 0.0_wp
      integer :: length = 0                  !! unit that the table names, index in length_names; 0: none
      logical :: has_front_ends = .false.    !! the rods of a solid axle are named by their front and rear ends
   end type point_set_t

   !> The options of `elastokin import`; '' if not given.
   type :: wish_t
      character(60) :: axes = '', length = '', datum = '', axle = '', side = ''
      character(40) :: source = ''              !! format that defines axes and length; '': the options
      character(40) :: datum_source = ''        !! what gives datum; '': the option
   end type wish_t

   type :: frame_t
      integer :: up = 0, outboard = 0, forward = 0      !! directions; outboard of the half that is used
      integer :: half = 1                               !! the half that is used
      integer :: length = 0                             !! unit, index in length_names
      real(wp) :: road = 0.0_wp                         !! height of the road along `up`, in the unit of the table
      logical :: has_road = .false.
      logical :: is_image = .false.                     !! the half is the right one, whose image is written
      character(:), allocatable :: how                  !! lines on the decisions
      character(:), allocatable :: source               !! what gives the axes
      character(:), allocatable :: problem              !! what is not certain, with the votes; '' if all is decided
      type(ballot_t), private :: ballot
   end type frame_t

contains

   !> Decides the frame of the points of an axle.
   subroutine find_frame(points, wish, frame)
      type(point_set_t), intent(in) :: points
      type(wish_t), intent(in) :: wish
      type(frame_t), intent(out) :: frame
      integer :: given(3)

      frame%how = ''
      frame%problem = ''
      frame%source = '--axes'
      if (wish%source /= '') frame%source = trim(wish%source)
      if (.not. any(points%half(1)%has)) frame%half = 2
      if (lower(wish%side) == 'right') frame%half = 2
      call take_axes(wish%axes, given, frame%problem)
      if (frame%problem /= '') return
      call check_images(points, wish, frame)
      if (frame%problem /= '') return
      call vote_on_up(points%half(frame%half), frame)
      call vote_on_outboard(points, frame)
      call decide_direction(frame, of_up, given(3), frame%up)
      call decide_outboard(points, frame, given(2))
      if (frame%problem == '') call vote_on_forward(points, frame)
      call decide_direction(frame, of_forward, given(1), frame%forward)
      if (frame%problem == '') call check_columns(frame)
      call decide_length(points, wish, frame)
      call decide_road(points%half(frame%half), wish, frame)
   end subroutine find_frame

   !> Checks that, if both sides are given and both are to be used, each right point is the image of the left point: one column
   !> changes its sign, and the others are equal.
   subroutine check_images(points, wish, frame)
      type(point_set_t), intent(in) :: points
      type(wish_t), intent(in) :: wish
      type(frame_t), intent(inout) :: frame
      real(wp) :: sum(3), difference(3), near
      character(:), allocatable :: list
      integer :: k, column, bad

      if (wish%side /= '') return
      if (.not. any(points%half(1)%has .and. points%half(2)%has)) return
      near = 2.0e-5_wp*max(maxval(abs(points%half(1)%at)), maxval(abs(points%half(2)%at)))      ! 0.02 mm of a car
      column = mirror_column(points)
      list = ''
      bad = 0
      do k = 1, point_count
         if (.not. (points%half(1)%has(k) .and. points%half(2)%has(k))) cycle
         difference = abs(points%half(1)%at(:, k) - points%half(2)%at(:, k))
         sum = abs(points%half(1)%at(:, k) + points%half(2)%at(:, k))
         difference(column) = sum(column)
         if (all(difference <= near)) cycle
         bad = bad + 1
         if (bad <= 3) list = list//new_line('a')//'  '//trim(point_names(k))//' of lines '// &
            str(points%half(1)%line(k))//' and '//str(points%half(2)%line(k))
      end do
      if (bad > 0) frame%problem = 'the right side is not the mirror image of the left side: '// &
         plural(bad, 'point differs', 'points differ')//'; correct them, or give --side left or --side right to mirror one side'// &
         list
   end subroutine check_images

   !> The column in which left and right differ most.
   pure integer function mirror_column(points) result(column)
      type(point_set_t), intent(in) :: points
      real(wp) :: difference(3)
      integer :: k

      difference = 0.0_wp
      do k = 1, point_count
         if (points%half(1)%has(k) .and. points%half(2)%has(k)) difference = difference + &
            abs(points%half(1)%at(:, k) - points%half(2)%at(:, k))
      end do
      column = maxloc(difference, dim=1)
   end function mirror_column

   subroutine vote_on_up(half, frame)
      type(half_t), intent(in) :: half
      type(frame_t), intent(inout) :: frame

      call vote_along(frame%ballot, of_up, half, contact_patch, wheel_centre, 'wheel centre above the contact point')
      call vote_on_lowest(half, frame)
      call vote_along(frame%ballot, of_up, half, lower_ball, upper_ball, 'upper ball joint above the lower one')
      call vote_along(frame%ballot, of_up, half, lower_ball, strut_top, 'strut top above the lower ball joint')
      call vote_along(frame%ballot, of_up, half, strut_low, strut_top, 'strut top above its lower end')
      call vote_along(frame%ballot, of_up, half, lower_ball, damper_top, 'damper top above the lower ball joint')
      call vote_along(frame%ballot, of_up, half, lower_ball, spring_top, 'spring top above the lower ball joint')
      if (all(half%has([lca_front, lca_rear, uca_front, uca_rear]))) call vote_vector(frame%ballot, of_up, &
         half%at(:, uca_front) + half%at(:, uca_rear) - half%at(:, lca_front) - half%at(:, lca_rear), &
         'pivots of the upper arm above those of the lower one')
      call vote_along(frame%ballot, of_up, half, lower_out, upper_front_out, 'upper link above the lower link, at the carrier')
      call vote_along(frame%ballot, of_up, half, lower_in, upper_front_in, 'upper link above the lower link, at the chassis')
      call vote_on_solid_up(half, frame%ballot)
   end subroutine vote_on_up

   !> Adds the vote of the contact point: of at least four points, it is the lowest by a tenth of the loaded radius or more.
   subroutine vote_on_lowest(half, frame)
      type(half_t), intent(in) :: half
      type(frame_t), intent(inout) :: frame
      real(wp) :: radius(3), height(point_count)
      integer :: column

      if (.not. all(half%has([contact_patch, wheel_centre])) .or. count(half%has) < 4) return
      radius = half%at(:, wheel_centre) - half%at(:, contact_patch)
      column = maxloc(abs(radius), dim=1)
      height = (half%at(column, :) - half%at(column, contact_patch))*sign(1.0_wp, radius(column))
      if (count(half%has .and. height < 0.1_wp*abs(radius(column))) /= 1) return         ! the contact point itself
      call add_vote(frame%ballot, of_up, merge(column, -column, radius(column) > 0.0_wp), 'contact point below all other points')
   end subroutine vote_on_lowest

   subroutine vote_on_outboard(points, frame)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(inout) :: frame
      integer :: k

      associate (half => points%half(frame%half), other => points%half(3 - frame%half))
         if (all(half%has([lca_front, lca_rear, lower_ball]))) call vote_vector(frame%ballot, of_outboard, &
            2*half%at(:, lower_ball) - half%at(:, lca_front) - half%at(:, lca_rear), 'lower ball joint outboard of the pivots')
         if (all(half%has([uca_front, uca_rear, upper_ball]))) call vote_vector(frame%ballot, of_outboard, &
            2*half%at(:, upper_ball) - half%at(:, uca_front) - half%at(:, uca_rear), 'upper ball joint outboard of the pivots')
         call vote_along(frame%ballot, of_outboard, half, tie_inner, tie_outer, &
            'outer end of the tie rod outboard of the inner end')
         call vote_along(frame%ballot, of_outboard, half, toe_inner, toe_outer, &
            'outer end of the toe link outboard of the inner end')
         call vote_along(frame%ballot, of_outboard, half, arm_inner, arm_outer, &
            'outer pivot of the arm outboard of the inner pivot')
         call vote_along(frame%ballot, of_outboard, half, lower_in, lower_out, &
            'outer end of the lower link outboard of the inner end')
         call vote_along(frame%ballot, of_outboard, half, upper_front_in, upper_front_out, &
            'outer end of the upper front link outboard of the inner end')
         call vote_along(frame%ballot, of_outboard, half, upper_rear_in, upper_rear_out, &
            'outer end of the upper rear link outboard of the inner end')
         call vote_on_solid_outboard(half, frame%ballot)
         do k = 1, point_count
            if (.not. (half%has(k) .and. other%has(k))) cycle
            call vote_vector(frame%ballot, of_outboard, half%at(:, k) - other%at(:, k), 'the other side is the mirror image')
            exit
         end do
      end associate
   end subroutine vote_on_outboard

   !> Adds the votes on the forward direction; the upward and outboard directions are decided.
   subroutine vote_on_forward(points, frame)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(inout) :: frame
      real(wp) :: top(3), middle(3)
      integer :: column, low, high

      column = 6 - abs(frame%up) - abs(frame%outboard)
      if (column < 1 .or. column > 3 .or. abs(frame%up) == abs(frame%outboard)) return
      associate (half => points%half(frame%half))
         call vote_column(frame%ballot, column, half, lca_rear, lca_front, 'front pivot of the lower arm ahead of the rear one')
         call vote_column(frame%ballot, column, half, uca_rear, uca_front, 'front pivot of the upper arm ahead of the rear one')
         call vote_column(frame%ballot, column, half, trailing_rear, trailing_front, &
            'front end of the trailing link ahead of the rear one')
         call vote_column(frame%ballot, column, half, upper_rear_in, upper_front_in, 'upper front link ahead of the rear one')
         if (all(half%has([arm_inner, arm_outer, wheel_centre]))) then
            middle = 0.5_wp*(half%at(:, arm_inner) + half%at(:, arm_outer)) - half%at(:, wheel_centre)
            call vote_sign(frame%ballot, column, middle(column), 'pivots of a trailing arm ahead of the wheel')
         end if
         if (points%has_other .and. half%has(wheel_centre) .and. points%axle > 0) call vote_sign(frame%ballot, column, &
            merge(1, -1, points%axle == 1)*(half%at(column, wheel_centre) - points%other_centre(column)), &
            'front wheels ahead of the rear wheels')
         if (points%is_sided) call add_vote(frame%ballot, of_forward, handed(frame), &
            'a right-handed frame, with the '//trim(merge('left ', 'right', frame%half == 1))//' side where the table has it')
         call vote_on_solid_forward(half, column, points%axle, points%has_front_ends, frame%ballot)
         call find_steering_axis(half, low, high)
         if (points%axle == 1 .and. low > 0) then
            top = half%at(:, high) - half%at(:, low)
            if (abs(top(column)) > tan(degree)*abs(top(abs(frame%up)))) call vote_sign(frame%ballot, column, -top(column), &
               'positive caster of a front axle')
            call vote_on_trail(half, half%at(:, low), top, column, frame)
            call vote_on_inclination(top, frame)
         end if
      end associate
   end subroutine vote_on_forward

   !> Finds the lower and the upper point of the steering axis; 0 if they are not known.
   pure subroutine find_steering_axis(half, low, high)
      type(half_t), intent(in) :: half
      integer, intent(out) :: low, high
      integer, parameter :: lows(3) = [lower_ball, lower_ball, kingpin_low], highs(3) = [upper_ball, strut_top, kingpin_top]
      integer :: k

      low = 0
      high = 0
      do k = size(lows), 1, -1
         if (.not. (half%has(lows(k)) .and. half%has(highs(k)))) cycle
         low = lows(k)
         high = highs(k)
      end do
   end subroutine find_steering_axis

   !> Adds the vote of the mechanical trail: the steering axis meets the road ahead of the contact point.
   subroutine vote_on_trail(half, low, axis, column, frame)
      type(half_t), intent(in) :: half
      real(wp), intent(in) :: low(3), axis(3)          !! a point of the steering axis, and its direction
      integer, intent(in) :: column
      type(frame_t), intent(inout) :: frame
      real(wp) :: trail, height

      if (.not. all(half%has([contact_patch, wheel_centre]))) return
      if (.not. abs(axis(abs(frame%up))) > 0.0_wp) return
      height = half%at(abs(frame%up), contact_patch) - low(abs(frame%up))
      trail = low(column) + height/axis(abs(frame%up))*axis(column) - half%at(column, contact_patch)
      if (abs(trail) > 0.01_wp*norm2(half%at(:, contact_patch) - half%at(:, wheel_centre))) call vote_sign(frame%ballot, column, &
         trail, 'positive mechanical trail of a front axle')
   end subroutine vote_on_trail

   !> Adds the vote of the kingpin inclination of a front axle: the steering axis leans inboard.
   subroutine vote_on_inclination(axis, frame)
      real(wp), intent(in) :: axis(3)
      type(frame_t), intent(inout) :: frame
      real(wp) :: lean

      lean = sign(1, frame%outboard)*axis(abs(frame%outboard))
      if (abs(lean) < tan(degree)*abs(axis(abs(frame%up)))) return
      call add_vote(frame%ballot, of_outboard, merge(frame%outboard, -frame%outboard, lean < 0.0_wp), &
         'steering axis of a front axle leans inboard')
      if (lean > 0.0_wp) call refuse(frame, of_outboard)
   end subroutine vote_on_inclination

   !> The forward direction of a right-handed frame with the decided upward direction and the side that the table names.
   pure integer function handed(frame) result(direction)
      type(frame_t), intent(in) :: frame
      integer :: left, sign_of(3)

      left = merge(frame%outboard, -frame%outboard, frame%half == 1)
      sign_of = 0
      direction = 6 - abs(left) - abs(frame%up)
      ! forward × left = up, so that forward = left × up
      if (mod(abs(frame%up) - abs(left) + 3, 3) == 2) direction = -direction
      direction = direction*sign(1, left)*sign(1, frame%up)
   end function handed

   !> Decides the outboard direction. The column of option --axes has no sign for a table without sides.
   subroutine decide_outboard(points, frame, left)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(inout) :: frame
      integer, intent(in) :: left               !! column of --axes that points to the left; 0 if not given
      real(wp) :: middle
      integer :: column, given

      if (frame%problem /= '') return
      column = abs(left)
      if (column == 0) column = abs(leader(frame%ballot, of_outboard))
      associate (half => points%half(frame%half))
         if (column > 0 .and. half%has(wheel_centre)) then
            call add_vote(frame%ballot, of_outboard, merge(column, -column, half%at(column, wheel_centre) > 0.0_wp), &
               'wheel centre outboard of the middle of the car')
         else if (column > 0) then
            middle = sum(half%at(column, :))          ! 0 without points
            if (abs(middle) > 0.0_wp) call add_vote(frame%ballot, of_outboard, merge(column, -column, middle > 0.0_wp), &
               'points outboard of the middle of the car')
         end if
      end associate
      given = 0
      if (left /= 0) then
         given = left
         if (.not. points%is_sided .and. leader(frame%ballot, of_outboard) /= 0) &
            given = sign(left, leader(frame%ballot, of_outboard))
         if (points%is_sided .and. frame%half == 2) given = -left
      end if
      call decide_direction(frame, of_outboard, given, frame%outboard)
      if (left /= 0) frame%is_image = frame%outboard /= left
      if (left == 0) frame%is_image = points%is_sided .and. frame%half == 2
   end subroutine decide_outboard

   !> Decides a direction by the option, or by at least two votes and none against. An option is refused if at least two votes are
   !> against it and none is for it, or if the wheel would be inboard or below the road.
   subroutine decide_direction(frame, question, given, direction)
      type(frame_t), intent(inout) :: frame
      integer, intent(in) :: question, given
      integer, intent(out) :: direction
      integer :: best

      direction = given
      if (frame%problem /= '') return
      best = leader(frame%ballot, question)
      if (given /= 0) then
         if (against(frame%ballot, question, given) >= merge(2, 1, question == of_forward) .and. &
            for(frame%ballot, question, given) == 0) then
            call refuse(frame, question, 'by '//frame%source//', '//side_name(question)//' is '//column_name(given)// &
               ', which the points contradict')
         end if
         if (question /= of_outboard) call explain(frame, side_name(question)//' '//column_name(given)//': '//frame%source)
         return
      end if
      if (best == 0) then
         call refuse(frame, question)
      else if (for(frame%ballot, question, best) < 2 .or. against(frame%ballot, question, best) > 0) then
         call refuse(frame, question)
      else
         direction = best
         call explain(frame, side_name(question)//' '//column_name(best)//': '//reasons(frame%ballot, question, best))
      end if
   end subroutine decide_direction

   !> Checks that the three directions are three columns.
   subroutine check_columns(frame)
      type(frame_t), intent(inout) :: frame

      if (abs(frame%up) /= abs(frame%outboard) .and. abs(frame%up) /= abs(frame%forward) .and. &
         abs(frame%outboard) /= abs(frame%forward)) return
      frame%problem = 'up, outboard and forward must be three columns, found '//column_name(frame%up)//', '// &
         column_name(frame%outboard)//' and '//column_name(frame%forward)//'; give --axes ('//axes_form//')'
   end subroutine check_columns

   !> Decides the unit of length: that of the option or of the table, if no size is against it, or that of two sizes.
   subroutine decide_length(points, wish, frame)
      type(point_set_t), intent(in) :: points
      type(wish_t), intent(in) :: wish
      type(frame_t), intent(inout) :: frame
      logical :: fits(size(length_names))
      character(:), allocatable :: words
      integer :: sizes, given

      if (frame%problem /= '') return
      fits = .true.
      sizes = 0
      call vote_on_length(points, frame, fits, sizes)
      given = points%length
      if (wish%length /= '') then
         frame%length = findloc(length_names == lower(wish%length), .true., dim=1)
         if (frame%length == 0) then
            frame%problem = '--length must be mm, cm, m, in or ft, found '''//trim(wish%length)//''''
         else if (given > 0 .and. given /= frame%length) then
            frame%problem = 'the table is in '//trim(length_names(given))//', but --length is '//trim(wish%length)
         else
            words = '--length'
            if (wish%source /= '') words = trim(wish%source)
            call explain(frame, 'unit of length '//trim(length_names(frame%length))//': '//words)
         end if
      else if (given > 0) then
         frame%length = given
         if (.not. fits(given)) call refuse(frame, of_length, 'the table names the unit '//trim(length_names(given))// &
            ', which the sizes contradict')
         call explain(frame, 'unit of length '//trim(length_names(given))//': named in the table')
      else if (sizes < 2 .or. count(fits) /= 1) then
         call refuse(frame, of_length)
      else
         frame%length = findloc(fits, .true., dim=1)
         call explain(frame, 'unit of length '//trim(length_names(frame%length))//': '// &
            reasons(frame%ballot, of_length, frame%length))
      end if
   end subroutine decide_length

   !> Adds the votes on the unit by the sizes of cars, from a Formula Student car to a truck. The ranges are narrower
   !> than a factor of 2.54, or fit two units at most.
   subroutine vote_on_length(points, frame, fits, sizes)
      type(point_set_t), intent(in) :: points
      type(frame_t), intent(inout) :: frame
      logical, intent(inout) :: fits(:)
      integer, intent(inout) :: sizes

      associate (half => points%half(frame%half))
         if (half%has(wheel_centre)) then
            call vote_on_size(abs(half%at(abs(frame%outboard), wheel_centre)), 0.45_wp, 1.14_wp, 'half the track')
            if (points%has_other) call vote_on_size(abs(half%at(abs(frame%forward), wheel_centre) - &
               points%other_centre(abs(frame%forward))), 1.4_wp, 5.5_wp, 'wheelbase')
         end if
         if (all(half%has([wheel_centre, contact_patch]))) call vote_on_size(norm2(half%at(:, wheel_centre) - &
            half%at(:, contact_patch)), 0.17_wp, 0.6_wp, 'loaded radius')
         if (all(half%has([lower_ball, upper_ball]))) call vote_on_size(norm2(half%at(:, lower_ball) - half%at(:, upper_ball)), &
            0.1_wp, 0.6_wp, 'distance of the ball joints')
         if (all(half%has([lower_ball, strut_top]))) call vote_on_size(norm2(half%at(:, lower_ball) - half%at(:, strut_top)), &
            0.35_wp, 0.85_wp, 'length of the steering axis')
         if (all(half%has([tie_inner, tie_outer]))) call vote_on_size(norm2(half%at(:, tie_inner) - half%at(:, tie_outer)), &
            0.15_wp, 0.75_wp, 'length of the tie rod')
         if (all(half%has([toe_inner, toe_outer]))) call vote_on_size(norm2(half%at(:, toe_inner) - half%at(:, toe_outer)), &
            0.15_wp, 0.75_wp, 'length of the toe link')
      end associate

   contains

      subroutine vote_on_size(value, least, most, what)
         real(wp), intent(in) :: value, least, most
         character(*), intent(in) :: what
         integer :: k

         sizes = sizes + 1
         do k = 1, size(length_names)
            if (value*length_values(k) >= least .and. value*length_values(k) <= most) then
               call add_vote(frame%ballot, of_length, k, what//' '//shown_number(value)//', in cars '//str(least)//' to '// &
                  str(most)//' m')
            else
               fits(k) = .false.
            end if
         end do
      end subroutine vote_on_size

   end subroutine vote_on_length

   !> Decides the height of the road: at the contact point of the table, or that of --datum. No point may be below the road, and the
   !> height of the wheel centre must be possible for a wheel.
   subroutine decide_road(half, wish, frame)
      type(half_t), intent(in) :: half
      type(wish_t), intent(in) :: wish
      type(frame_t), intent(inout) :: frame
      real(wp) :: height(point_count), value, near
      logical :: is_good

      if (frame%problem /= '') return
      height = sign(1, frame%up)*half%at(abs(frame%up), :)
      near = 1.0e-3_wp/length_values(frame%length)
      frame%has_road = half%has(contact_patch)
      if (frame%has_road) frame%road = height(contact_patch)
      if (wish%datum == '') then
         if (half%has(wheel_centre) .and. .not. frame%has_road) frame%problem = 'the file has no contact point, and the '// &
            'height of the road is not certain; give --datum ground (the height is 0 on the road), --datum HEIGHT (height of '// &
            'the road in the file), or --datum radius:R (loaded radius below the wheel centre)'
         if (frame%has_road) call explain(frame, 'road: at the contact point of the table')
      else
         call read_datum(trim(wish%datum), height(wheel_centre), half%has(wheel_centre), value, is_good)
         if (.not. is_good) then
            frame%problem = '--datum must be ground, a height or radius:R (of a table with a wheel centre), found '''// &
               trim(wish%datum)//''''
         else if (frame%has_road .and. abs(frame%road - value) > near) then
            frame%problem = 'by --datum, the height of the road is '//str(value)//', but the contact point (line '// &
               str(half%line(contact_patch))//') is at '//str(frame%road)
         end if
         frame%has_road = .true.
         frame%road = value
         if (wish%datum_source == '') call explain(frame, 'road: --datum '//trim(wish%datum))
         if (wish%datum_source /= '') call explain(frame, 'road: '//trim(wish%datum_source)//', '//trim(wish%datum))
      end if
      if (frame%problem == '' .and. frame%has_road) call check_road(half, height, near, frame)
   end subroutine decide_road

   !> Reads the option --datum.
   subroutine read_datum(text, centre, has_centre, road, is_good)
      character(*), intent(in) :: text
      real(wp), intent(in) :: centre                 !! height of the wheel centre
      logical, intent(in) :: has_centre
      real(wp), intent(out) :: road                  !! height of the road; 0 if the option is not good
      logical, intent(out) :: is_good
      logical :: is_radius

      road = 0.0_wp
      is_good = .true.
      if (lower(text) == 'ground') return
      is_radius = index(lower(text), 'radius:') == 1
      call get_decimal(text(merge(len('radius:') + 1, 1, is_radius):), road, is_good)
      if (is_good) is_good = ieee_is_finite(road) .and. (has_centre .or. .not. is_radius)
      if (is_good) is_good = abs(road) < 1.0e9_wp
      if (.not. is_good) road = 0.0_wp
      if (is_good .and. is_radius) road = centre - road
   end subroutine read_datum

   !> Checks that no point is below the road, and that the height of the wheel centre is between 0.1 and 0.8 m.
   subroutine check_road(half, height, near, frame)
      type(half_t), intent(in) :: half
      real(wp), intent(in) :: height(:), near        !! near: 1 mm, in the unit of the table
      type(frame_t), intent(inout) :: frame
      real(wp) :: radius
      integer :: k

      radius = (height(wheel_centre) - frame%road)*length_values(frame%length)
      if (half%has(wheel_centre) .and. (radius < 0.1_wp .or. radius > 0.8_wp)) frame%problem = 'the wheel centre (line '// &
         str(half%line(wheel_centre))//') must be 0.1 to 0.8 m above the road, found '//str(radius)//' m; check the contact '// &
         'point, the unit or --datum'
      do k = point_count, 1, -1
         if (half%has(k) .and. height(k) < frame%road - near) frame%problem = 'the point '//trim(point_names(k))//' (line '// &
            str(half%line(k))//') is below the road, which is at the height '//str(frame%road)//'; check contact point or --datum'
      end do
   end subroutine check_road

   !> Reports that a question is not decided, with at most seven votes.
   subroutine refuse(frame, question, cause)
      type(frame_t), intent(inout) :: frame
      integer, intent(in) :: question
      character(*), intent(in), optional :: cause
      character(:), allocatable :: text

      if (frame%problem /= '') return
      text = 'cannot decide '//trim(questions(question))//' (at least 2 votes and none against are needed)'
      if (present(cause)) text = cause
      if (question == of_length) then
         text = text//'; give --length mm, cm, m, in or ft'
      else
         text = text//'; give --axes ('//axes_form//')'
      end if
      text = text//vote_lines(frame%ballot, question)
      frame%problem = text
   end subroutine refuse

   subroutine explain(frame, line)
      type(frame_t), intent(inout) :: frame
      character(*), intent(in) :: line

      if (frame%how /= '') frame%how = frame%how//new_line('a')
      frame%how = frame%how//line
   end subroutine explain

   !> A size for a message, with few digits.
   pure function shown_number(value) result(words)
      real(wp), intent(in) :: value
      character(:), allocatable :: words
      words = str(real(nint(min(value, 1.0e6_wp)*1000), wp)/1000)
   end function shown_number

end module ek_frame_votes
