!> Templates of suspensions of Project Chrono: the points of each with their paths in the file, and why others are not read.
!>
!> A template consists of the guide of its wheels (its family) and of its steering; both have points. The kind of suspension in the
!> deck follows from the points (ek_point_kind).
module ek_chrono_template
   use ek_text, only: did_you_mean
   use ek_flaws, only: shown
   use ek_point_name, only: wheel_centre, lca_front, lca_rear, lower_ball, uca_front, uca_rear, upper_ball, tie_inner, tie_outer, &
      strut_top, strut_low, arm_inner, arm_outer, upper_front_in, upper_front_out, upper_rear_in, upper_rear_out, lower_in, &
      lower_out, trailing_front, trailing_rear, kingpin_low, kingpin_top, &
      upper_rod_chassis, upper_rod_axle, lower_rod_chassis, lower_rod_axle, panhard_chassis, panhard_axle, &
      drag_link_chassis, drag_link_crank, crank_tie_rod, crank_axle, triangle_chassis, triangle_axle, axle_pivot, &
      watt_left_chassis, watt_left_lever, watt_right_chassis, watt_right_lever, axle_guide, drag_link_knuckle, arm_ball, &
      upper_lateral_in, upper_lateral_out, lower_lateral_in, lower_lateral_out
   implicit none(type, external)
   private
   public :: template_t, templates, find_template, is_place_of, places, why_not_read
   public :: arms, strut, links, arm, solid, triangle, watt, leaf, pipe, lateral, rod, toe_bar, cranks

   !> A point of a family of templates: its path in the file.
   type :: place_t
      character(18) :: family
      integer :: point
      character(48) :: path
   end type place_t

   !> A template: its name, the family and the steering whose points it has, the key of the moved end of springs, and their body in
   !> the deck.
   type :: template_t
      character(27) :: name
      character(18) :: family
      character(16) :: end_key
      character(14) :: body
      character(18) :: steering = 'none'
   end type template_t

   character(*), parameter :: arms = 'DoubleWishbone', strut = 'MacPhersonStrut', links = 'MultiLink', arm = 'SemiTrailingArm', &
      solid = 'SolidAxle', triangle = 'SolidThreeLinkAxle', watt = 'DeDionAxle', leaf = 'LeafspringAxle', pipe = 'PushPipeAxle', &
      lateral = 'ThreeLinkIRS', every = ''
   !> Steering: tie rods on the chassis, a drag link on a knuckle with a toe bar, or a bell crank with two tie rods.
   character(*), parameter :: rod = 'rod', toe_bar = 'toe bar', cranks = 'cranks'
   type(template_t), parameter :: templates(*) = [ &
      template_t('DoubleWishbone', arms, 'Location Arm', 'lca', rod), &
      template_t('DoubleWishboneReduced', arms, 'Location Upright', 'carrier', rod), &
      template_t('MacPhersonStrut', strut, 'Location Upright', 'carrier', rod), &
      template_t('MultiLink', links, 'Location Link', 'trailing_link', rod), &
      template_t('SemiTrailingArm', arm, 'Location Arm', 'arm'), &
      template_t('ThreeLinkIRS', lateral, 'Location Arm', 'arm'), &
      template_t('SolidAxle', solid, 'Location Axle', 'axle'), &
      template_t('SolidThreeLinkAxle', triangle, 'Location Axle', 'axle'), &
      template_t('SolidBellcrankThreeLinkAxle', triangle, 'Location Axle', 'axle', cranks), &
      template_t('DeDionAxle', watt, 'Location Axle', 'axle'), &
      template_t('ToeBarDeDionAxle', watt, 'Location Axle', 'axle', toe_bar), &
      template_t('LeafspringAxle', leaf, 'Location Axle', 'axle'), &
      template_t('ToeBarLeafspringAxle', leaf, 'Location Axle', 'axle', toe_bar), &
      template_t('PushPipeAxle', pipe, 'Location Axle', 'axle'), &
      template_t('ToeBarPushPipeAxle', pipe, 'Location Axle', 'axle', toe_bar)]

   !> A template that is not read, and why.
   type :: refusal_t
      character(24) :: name
      character(76) :: reason
      character(72) :: remedy
   end type refusal_t

   character(*), parameter :: by_hand = 'write its bodies and joints as a deck (docs/joints.md)'
   type(refusal_t), parameter :: refusals(*) = [ &
      refusal_t('SAELeafspringAxle', 'each leaf is a chain of bodies with torsion springs and a shackle', &
      'write the leaves as in docs/joints.md, leaf spring'), &
      refusal_t('SAEToeBarLeafspringAxle', 'each leaf is a chain of bodies with torsion springs and a shackle', &
      'write the leaves as in docs/joints.md, leaf spring'), &
      refusal_t('RigidPanhardAxle', 'its anti-roll bar slides on the axle', by_hand), &
      refusal_t('ToeBarRigidPanhardAxle', 'its anti-roll bar slides on the axle', by_hand), &
      refusal_t('SingleWishbone', 'its carrier is hinged to the only arm', by_hand), &
      refusal_t('HendricksonPRIMAXX', 'its axle has a transverse beam, torque rods and air springs of its own', by_hand), &
      refusal_t('GenericWheeledSuspension', 'its bodies and joints are those of its author', by_hand), &
      refusal_t('RigidSuspension', 'its wheels are fixed to the chassis', 'there is no suspension to import'), &
      refusal_t('RigidPinnedAxle', 'its axle rolls about a pin without springs', 'there is no wheel travel to import')]

   character(*), parameter :: upper_arm = 'Upper Control Arm/Location ', lower_arm = 'Lower Control Arm/Location ', &
      of_watt = 'Watt Mechanism/Location '
   type(place_t), parameter :: places(*) = [ &
      place_t(every, wheel_centre, 'Spindle/COM'), &
      place_t(arms, uca_front, upper_arm//'Chassis Front'), place_t(arms, uca_rear, upper_arm//'Chassis Back'), &
      place_t(arms, upper_ball, upper_arm//'Upright'), &
      place_t(arms, lca_front, lower_arm//'Chassis Front'), place_t(arms, lca_rear, lower_arm//'Chassis Back'), &
      place_t(arms, lower_ball, lower_arm//'Upright'), &
      place_t(strut, lca_front, 'Control Arm/Location Chassis Front'), &
      place_t(strut, lca_rear, 'Control Arm/Location Chassis Back'), place_t(strut, lower_ball, 'Control Arm/Location Upright'), &
      place_t(strut, strut_low, 'Spring/Location Upright'), place_t(strut, strut_top, 'Spring/Location Chassis'), &
      place_t(links, upper_front_in, 'Upper Arm/Location Chassis Front'), &
      place_t(links, upper_front_out, 'Upper Arm/Location Upright'), &
      place_t(links, upper_rear_in, 'Upper Arm/Location Chassis Back'), &
      place_t(links, upper_rear_out, 'Upper Arm/Location Upright'), &
      place_t(links, lower_in, 'Lateral/Location Chassis'), place_t(links, lower_out, 'Lateral/Location Upright'), &
      place_t(links, trailing_front, 'Trailing Link/Location Chassis'), &
      place_t(links, trailing_rear, 'Trailing Link/Location Upright'), &
      place_t(arm, arm_inner, 'Trailing Arm/Location Chassis Inner'), &
      place_t(arm, arm_outer, 'Trailing Arm/Location Chassis Outer'), &
      place_t(solid, kingpin_low, 'Knuckle/Location Lower'), place_t(solid, kingpin_top, 'Knuckle/Location Upper'), &
      place_t(solid, upper_rod_chassis, 'Upper Link/Location Chassis'), &
      place_t(solid, upper_rod_axle, 'Upper Link/Location Axle'), &
      place_t(solid, lower_rod_chassis, 'Lower Link/Location Chassis'), &
      place_t(solid, lower_rod_axle, 'Lower Link/Location Axle'), &
      place_t(solid, panhard_chassis, 'Trackbar/Location Chassis'), place_t(solid, panhard_axle, 'Trackbar/Location Axle'), &
      place_t(solid, tie_outer, 'Tierod/Location Knuckle'), &
      place_t(solid, drag_link_chassis, 'Draglink/Location Chassis'), &
      place_t(solid, drag_link_crank, 'Draglink/Location Bell Crank'), &
      place_t(solid, crank_tie_rod, 'Bell Crank/Location Tierod'), place_t(solid, crank_axle, 'Bell Crank/Location Axle'), &
      place_t(triangle, triangle_chassis, 'Triangular Link/Location Chassis'), &
      place_t(triangle, triangle_axle, 'Triangular Link/Location Axle'), &
      place_t(triangle, lower_rod_chassis, 'Longitudinal Link/Location Chassis'), &
      place_t(triangle, lower_rod_axle, 'Longitudinal Link/Location Axle'), &
      place_t(watt, axle_pivot, 'Axle Tube/Location Connector Chassis'), &
      place_t(watt, watt_left_chassis, of_watt//'Left Link to Chassis'), &
      place_t(watt, watt_left_lever, of_watt//'Left Link to Center'), &
      place_t(watt, watt_right_chassis, of_watt//'Right Link to Chassis'), &
      place_t(watt, watt_right_lever, of_watt//'Right Link to Center'), &
      place_t(leaf, axle_guide, 'Axle Tube/COM'), &
      place_t(pipe, axle_pivot, 'Axle Tube/Location Connector Chassis'), &
      place_t(pipe, panhard_chassis, 'Panhard Rod/Location Connector Chassis'), &
      place_t(pipe, panhard_axle, 'Panhard Rod/Location Connector Axle'), &
      place_t(lateral, arm_ball, 'Trailing Arm/Location Chassis'), &
      place_t(lateral, upper_lateral_in, 'Upper Link/Location Chassis'), &
      place_t(lateral, upper_lateral_out, 'Upper Link/Location Arm'), &
      place_t(lateral, lower_lateral_in, 'Lower Link/Location Chassis'), &
      place_t(lateral, lower_lateral_out, 'Lower Link/Location Arm'), &
      place_t(rod, tie_inner, 'Tierod/Location Chassis'), place_t(rod, tie_outer, 'Tierod/Location Upright'), &
      place_t(toe_bar, kingpin_low, 'Knuckle/Location Lower'), place_t(toe_bar, kingpin_top, 'Knuckle/Location Upper'), &
      place_t(toe_bar, drag_link_knuckle, 'Knuckle/Location Draglink'), &
      place_t(toe_bar, drag_link_chassis, 'Draglink/Location Chassis'), &
      place_t(toe_bar, tie_outer, 'Tierod/Location Knuckle'), &
      place_t(cranks, kingpin_low, 'Knuckle/Location Lower'), place_t(cranks, kingpin_top, 'Knuckle/Location Upper'), &
      place_t(cranks, tie_outer, 'Knuckle/Location Tierod'), &
      place_t(cranks, crank_axle, 'Bellcrank/Location Axle'), place_t(cranks, crank_tie_rod, 'Bellcrank/Location Tierod'), &
      place_t(cranks, drag_link_chassis, 'Draglink/Location Steering'), &
      place_t(cranks, drag_link_crank, 'Draglink/Location Bellcrank')]


contains

   !> The index of a template; 0 if it is not read.
   pure integer function find_template(name) result(found)
      character(*), intent(in) :: name
      found = findloc(templates%name == name, .true., dim=1)
   end function find_template

   !> Whether a template has this point.
   pure logical function is_place_of(place, template)
      integer, intent(in) :: place, template           !! indices in places and templates
      associate (family => places(place)%family)
         is_place_of = family == every .or. family == templates(template)%family .or. family == templates(template)%steering
      end associate
   end function is_place_of

   !> Why a template is not read, and what to do.
   pure function why_not_read(name) result(words)
      character(*), intent(in) :: name
      character(:), allocatable :: words
      integer :: k

      k = findloc(refusals%name == name, .true., dim=1)
      words = 'the template '//shown(name)//' is not read'
      if (k > 0) then
         words = words//', because '//trim(refusals(k)%reason)//'; '//trim(refusals(k)%remedy)
      else
         words = words//did_you_mean(name, templates%name)//'; give its points as a table (name, x, y, z)'
      end if
   end function why_not_read

end module ek_chrono_template
