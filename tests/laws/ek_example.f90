!> The two suspensions of the reference solutions, and cases to load them with.
!>
!> Numbers: tests/reference/README.md. A model comes WITHOUT `complete`, so that a test may change it first.
module ek_example
   use ek_kinds, only: wp
   use ek_case, only: case_t
   use ek_measure, only: measure_t
   use ek_element, only: element_t, set_kind, bushing_element
   use ek_joint, only: joint_geometry_t
   use ek_rotation, only: identity3
   use ek_suspension, only: suspension_t, load_t, wheel_t
   use ek_rig, only: rig_t, new_rig, add_height, put_on, set_rig_numbers
   use ek_parts, only: add_body, add_joint, add_bushing, add_spring, add_load, add_wheel
   implicit none(type, external)
   private
   public :: mcpherson_model, double_wishbone_model, load_case, drive_case, new_bushing, geometry, hold_height, add_travel_driver

   ! what a test may want to put a reference point on
   real(wp), parameter, public :: mcpherson_contact(3) = [0.0_wp, -0.75_wp, -0.31_wp]
   real(wp), parameter, public :: mcpherson_ball_joint(3) = [0.0_wp, -0.72_wp, -0.1_wp]

contains

   !> Adds the rig's driver of the height of one wheel, 'centre', 'patch' or 'road', to a completed model.
   subroutine hold_height(suspension, name, wheel, control)
      type(suspension_t), intent(inout) :: suspension
      character(*), intent(in) :: name, control
      integer, intent(in) :: wheel
      type(suspension_t) :: base
      type(rig_t) :: rig
      type(case_t) :: none

      base = suspension
      rig = new_rig()
      call add_height(rig, base, name, base%wheels(wheel)%where, [wheel], [1.0_wp], control)
      call set_rig_numbers(base, none, rig)
      call put_on(rig, base, suspension)
   end subroutine hold_height

   !> The same of a wheel centre, named as by a case with drive = 'wheel_travel'.
   subroutine add_travel_driver(suspension, wheel)
      type(suspension_t), intent(inout) :: suspension
      integer, intent(in) :: wheel
      call hold_height(suspension, 'wheel_travel', wheel, 'centre')
   end subroutine add_travel_driver

   !> McPherson strut: bodies lca, carrier, strut; scaled loads 'vertical', 'longitudinal' at the contact point.
   subroutine mcpherson_model(suspension, is_preloaded, order, ball_stiffness)
      type(suspension_t), intent(out) :: suspension
      logical, intent(in), optional :: is_preloaded      !! variant A: static 3500 N and preloads
      integer, intent(in), optional :: order(3)          !! place of lca, carrier, strut among the bodies
      real(wp), intent(in), optional :: ball_stiffness   !! N/m: the ball joint becomes a bushing
      real(wp), parameter :: top(3) = [0.03_wp, -0.56_wp, 0.58_wp], low(3) = [0.01_wp, -0.6_wp, 0.15_wp], &
         front(3) = [0.0_wp, -0.36_wp, -0.08_wp], rear(3) = [0.3_wp, -0.38_wp, -0.07_wp], &
         rod_out(3) = [0.13_wp, -0.69_wp, -0.06_wp], rod_in(3) = [0.15_wp, -0.33_wp, -0.045_wp], &
         coil_top(3) = [0.029_wp, -0.562_wp, 0.53_wp], coil_low(3) = [0.006_wp, -0.622_wp, 0.27_wp], &
         centre(3) = [0.0_wp, -0.75_wp, 0.0_wp]
      real(wp), parameter :: strut_axis(3) = [0.046262100205922495_wp, 0.09252420041184484_wp, 0.9946351544273336_wp]
      type(element_t) :: bushing(3)
      type(load_t) :: static
      integer :: lca, carrier, strut, k
      logical :: is_a

      is_a = .false.
      if (present(is_preloaded)) is_a = is_preloaded
      lca = 1; carrier = 2; strut = 3
      if (present(order)) then
         lca = order(1); carrier = order(2); strut = order(3)
      end if
      suspension%name = 'mcpherson'
      do k = 1, 3
         if (k == lca) call add_body(suspension, 'lca', '', [0.1_wp, -0.5_wp, -0.085_wp])
         if (k == carrier) call add_body(suspension, 'carrier', '', centre)
         if (k == strut) call add_body(suspension, 'strut', '', top)
      end do

      if (present(ball_stiffness)) then
         call add_bushing(suspension, new_bushing('j_lbj', lca, carrier, mcpherson_ball_joint, identity3, &
            spread(ball_stiffness, 1, 3), spread(0.0_wp, 1, 3)))
      else
         call add_joint(suspension, 'j_lbj', '', 'spherical', geometry(lca, carrier, mcpherson_ball_joint))
      end if
      call add_joint(suspension, 'j_strut', '', 'cylindrical', geometry(carrier, strut, low, strut_axis))
      call add_joint(suspension, 'j_tierod', '', 'distance', joint_geometry_t(0, carrier, rod_in, rod_out))
      call add_joint(suspension, 'j_cp_x', '', 'in_plane', &
         geometry(0, carrier, mcpherson_contact, [1.0_wp, 0.0_wp, 0.0_wp]))

      bushing(1) = new_bushing('b_top', 0, strut, top, reshape([ &
         0.9989293358814412_wp, -0.004284951574826551_wp, -0.046063229429385504_wp, &
         0.0_wp, 0.9957012159921018_wp, -0.09262336892949768_wp, &
         0.0462621002059225_wp, 0.09252420041184485_wp, 0.9946351544273337_wp], [3, 3]), &
         [1.0e6_wp, 1.0e6_wp, 8.0e5_wp], [50.0_wp, 50.0_wp, 20.0_wp])
      bushing(2) = new_bushing('b_lca_f', 0, lca, front, reshape([ &
         0.0664453456987284_wp, 0.9977876079092372_wp, 0.002214844856624279_wp, &
         -0.03331483023263846_wp, 0.0_wp, 0.9994449069791543_wp, &
         0.9972337429718005_wp, -0.06648224953145343_wp, 0.033241124765726666_wp], [3, 3]), &
         [8.0e6_wp, 8.0e6_wp, 6.0e5_wp], [400.0_wp, 400.0_wp, 100.0_wp])
      bushing(3) = new_bushing('b_lca_r', 0, lca, rear, identity3, &
         [8.0e5_wp, 2.0e6_wp, 6.0e5_wp], [250.0_wp, 250.0_wp, 150.0_wp])
      if (is_a) then
         bushing(1)%bushing%preload_force = [54.61188113719136_wp, -658.5184447623097_wp, -3617.9836847875_wp]
         bushing(1)%bushing%preload_moment = [0.10776523501810735_wp, -0.013670518839916962_wp, -0.25180106231122223_wp]
         bushing(2)%bushing%preload_force = [961.6172418855174_wp, 41.497610570568334_wp, -39.28790725383991_wp]
         bushing(2)%bushing%preload_moment = [0.014401669053152523_wp, -0.18679520455860094_wp, 1.3333399998872824_wp]
         bushing(3)%bushing%preload_force = [-53.16670735557621_wp, -31.769493207490783_wp, -4.717455950824692_wp]
         bushing(3)%bushing%preload_moment = [3.328616580770816_wp, -0.21262747714072486_wp, -0.003514773437692738_wp]
      end if
      do k = 1, 3
         call add_bushing(suspension, bushing(k))
      end do
      call add_spring(suspension, 's_coil', '', carrier, strut, coil_low, coil_top, 3.0e4_wp, &
         preload=merge(3653.4797576368433_wp, 0.0_wp, is_a))
      if (is_a) then
         static%name = 'static_wheel_load'
         static%body = carrier
         static%arm = mcpherson_contact
         static%force = [0.0_wp, 0.0_wp, 3500.0_wp]
         call add_load(suspension, static)
      end if
      call add_case_load(suspension, 'vertical', carrier, mcpherson_contact, [0.0_wp, 0.0_wp, 1.0_wp])
      call add_case_load(suspension, 'lateral', carrier, mcpherson_contact, [0.0_wp, 1.0_wp, 0.0_wp])
      call add_left_wheel(suspension, carrier, centre, mcpherson_contact, [0.0_wp, -1.0_wp, 0.0_wp], 0.31_wp)
   end subroutine mcpherson_model

   !> Double wishbone: bodies lca, uca, carrier; scaled loads 'vertical', 'lateral' at the contact point. With
   !> `is_rigid` the arms turn in revolute joints: one degree of freedom is left, and no bushing.
   subroutine double_wishbone_model(suspension, is_rigid)
      type(suspension_t), intent(out) :: suspension
      logical, intent(in), optional :: is_rigid
      integer, parameter :: lca = 1, uca = 2, carrier = 3
      real(wp), parameter :: contact(3) = [0.0_wp, -0.78_wp, -0.33_wp], centre(3) = [0.0_wp, -0.78_wp, 0.0_wp], &
         lca_ball(3) = [-0.01_wp, -0.745_wp, -0.155_wp], uca_ball(3) = [0.025_wp, -0.69_wp, 0.215_wp], &
         lca_front(3) = [-0.19_wp, -0.4_wp, -0.135_wp], lca_rear(3) = [0.21_wp, -0.41_wp, -0.125_wp], &
         uca_front(3) = [-0.11_wp, -0.46_wp, 0.2_wp], uca_rear(3) = [0.17_wp, -0.47_wp, 0.175_wp], &
         rod_out(3) = [-0.135_wp, -0.735_wp, -0.1_wp], rod_in(3) = [-0.15_wp, -0.38_wp, -0.085_wp], &
         coil_low(3) = [0.005_wp, -0.6_wp, -0.12_wp], coil_top(3) = [0.03_wp, -0.5_wp, 0.42_wp]
      real(wp), parameter :: lca_axes(3, 3) = reshape([ &
         0.02497658566935248_wp, 0.9996878414158374_wp, 0.0006244146417338125_wp, &
         -0.02499219116020309_wp, 0.0_wp, 0.9996876464081228_wp, &
         0.9993755853278153_wp, -0.024984389633195266_wp, 0.024984389633195405_wp], [3, 3])
      real(wp), parameter :: uca_axes(3, 3) = reshape([ &
         0.0354094285139982_wp, 0.9993678886852575_wp, -0.00316155611732127_wp, &
         0.08893193797450559_wp, 0.0_wp, 0.9960377053144619_wp, &
         0.9954080986110223_wp, -0.03555028923610777_wp, -0.08887572309026992_wp], [3, 3])
      logical :: with_bushings

      with_bushings = .true.
      if (present(is_rigid)) with_bushings = .not. is_rigid
      suspension%name = 'double_wishbone'
      call add_body(suspension, 'lca', '', [0.0_wp, -0.55_wp, -0.14_wp])
      call add_body(suspension, 'uca', '', [0.03_wp, -0.56_wp, 0.2_wp])
      call add_body(suspension, 'carrier', '', centre)
      call add_joint(suspension, 'j_lbj', '', 'spherical', geometry(lca, carrier, lca_ball))
      call add_joint(suspension, 'j_ubj', '', 'spherical', geometry(uca, carrier, uca_ball))
      call add_joint(suspension, 'j_tierod', '', 'distance', joint_geometry_t(0, carrier, rod_in, rod_out))
      if (with_bushings) then
         call add_bushing(suspension, new_bushing('b_lca_f', 0, lca, lca_front, lca_axes, &
            [1.0e7_wp, 1.0e7_wp, 8.0e5_wp], [300.0_wp, 300.0_wp, 80.0_wp]))
         call add_bushing(suspension, new_bushing('b_lca_r', 0, lca, lca_rear, lca_axes, &
            [3.0e6_wp, 6.0e6_wp, 5.0e5_wp], [250.0_wp, 250.0_wp, 60.0_wp]))
         call add_bushing(suspension, new_bushing('b_uca_f', 0, uca, uca_front, uca_axes, &
            [6.0e6_wp, 6.0e6_wp, 6.0e5_wp], [200.0_wp, 200.0_wp, 40.0_wp]))
         call add_bushing(suspension, new_bushing('b_uca_r', 0, uca, uca_rear, uca_axes, &
            [6.0e6_wp, 6.0e6_wp, 6.0e5_wp], [200.0_wp, 200.0_wp, 40.0_wp]))
      else
         call add_joint(suspension, 'j_lca', '', 'revolute', geometry(0, lca, lca_front, lca_axes(:, 3)))
         call add_joint(suspension, 'j_uca', '', 'revolute', geometry(0, uca, uca_front, uca_axes(:, 3)))
      end if
      call add_spring(suspension, 's_coil', '', lca, 0, coil_low, coil_top, 9.0e4_wp)
      call add_case_load(suspension, 'vertical', carrier, contact, [0.0_wp, 0.0_wp, 1.0_wp])
      call add_case_load(suspension, 'lateral', carrier, contact, [0.0_wp, 1.0_wp, 0.0_wp])
      call add_left_wheel(suspension, carrier, centre, contact, &
         [-0.001745198111449739_wp, -0.9999238466874082_wp, 0.012217000835247169_wp], 0.33_wp)
   end subroutine double_wishbone_model

   !> A joint whose two points, and two axes, coincide.
   pure type(joint_geometry_t) function geometry(body_i, body_j, point, axis)
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point(3)
      real(wp), intent(in), optional :: axis(3)
      geometry%body_i = body_i
      geometry%body_j = body_j
      geometry%point_i = point
      geometry%point_j = point
      if (present(axis)) then
         geometry%axis_i = axis
         geometry%axis_j = axis
      end if
   end function geometry

   !> A bushing at one design point.
   pure type(element_t) function new_bushing(name, body_i, body_j, point, axes, kt, kr) result(bushing)
      character(*), intent(in) :: name
      integer, intent(in) :: body_i, body_j
      real(wp), intent(in) :: point(3), axes(3, 3), kt(3), kr(3)
      bushing%name = name
      bushing%where = ''
      call set_kind(bushing, bushing_element, measure_t(body_i=body_i, body_j=body_j, arm_i=point, arm_j=point))
      bushing%bushing%axes = axes
      bushing%bushing%kt = kt
      bushing%bushing%kr = kr
   end function new_bushing

   subroutine add_case_load(suspension, name, body, point, force)
      type(suspension_t), intent(inout) :: suspension
      character(*), intent(in) :: name
      integer, intent(in) :: body
      real(wp), intent(in) :: point(3), force(3)
      type(load_t) :: load
      load%name = name
      load%where = ''
      load%body = body
      load%arm = point
      load%force = force
      load%is_case = .true.
      call add_load(suspension, load)
   end subroutine add_case_load

   subroutine add_left_wheel(suspension, body, centre, contact, spin, radius)
      type(suspension_t), intent(inout) :: suspension
      integer, intent(in) :: body
      real(wp), intent(in) :: centre(3), contact(3), spin(3), radius
      type(wheel_t) :: wheel
      wheel%name = 'left'
      wheel%where = ''
      wheel%body = body
      wheel%centre = centre
      wheel%contact = contact
      wheel%spin = spin
      wheel%radius = radius
      call add_wheel(suspension, wheel)
   end subroutine add_left_wheel

   !> A case that scales a load [-].
   pure type(case_t) function load_case(load, from, to, increments, method) result(case)
      character(*), intent(in) :: load, method
      real(wp), intent(in) :: from, to
      integer, intent(in) :: increments
      case%name = load
      case%where = ''
      case%load = load
      case%drive = ''
      case%from = from
      case%to = to
      case%increments = increments
      case%method = method
   end function load_case

   !> A case that drives a joint [m, rad].
   pure type(case_t) function drive_case(drive, from, to, increments, method) result(case)
      character(*), intent(in) :: drive, method
      real(wp), intent(in) :: from, to
      integer, intent(in) :: increments
      case = load_case('', from, to, increments, method)
      case%drive = drive
   end function drive_case

end module ek_example
