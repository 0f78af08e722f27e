!> What a file gives of an axle besides its points: static angles, springs, stops and bushings. All numbers are in SI.
module ek_axle_facts
   use ek_kinds, only: wp
   use ek_error, only: message_list_t
   implicit none(type, external)
   private
   public :: axle_facts_t, spring_part_t, bushing_part_t, spring_slot, damper_slot, upper_slot, lower_slot, rod_slot

   integer, parameter :: spring_slot = 1, damper_slot = 2                 !! of axle_facts_t%springs
   integer, parameter :: upper_slot = 1, lower_slot = 2, rod_slot = 3     !! of axle_facts_t%bushings

   !> An element along the line between a point of the chassis and a point of a body: spring, damper, or both.
   type :: spring_part_t
      logical :: is_given = .false.
      character(16) :: name = '', body = ''          !! names in the deck
      integer :: top = 0, low = 0                    !! points of the chassis and of the body, index in point_names
      integer :: line = 0                            !! of the law
      logical :: has_law = .false.                   !! a force at rest; without it the element is a damper
      real(wp) :: rate = 0.0_wp                      !! [N/m]; not used with a curve
      real(wp) :: free_length = 0.0_wp               !! length without force [m]
      real(wp), allocatable :: x(:), y(:)            !! curve: compression from the free length [m], compressive force [N]
      logical :: has_stops = .false.
      real(wp) :: shortest = 0.0_wp, longest = 0.0_wp      !! lengths at which the stops are touched [m]
      integer :: stop_line = 0
   end type spring_part_t

   !> A bushing that replaces a joint. The third axis is that of the joint, or of the rod.
   type :: bushing_part_t
      logical :: is_given = .false.
      integer :: line = 0
      real(wp) :: kt = 0.0_wp                        !! translational stiffness, equal along all axes [N/m]
      real(wp) :: kr = 0.0_wp, kr_free = 0.0_wp      !! about directions that the joint locks, or leaves free [N m/rad]
   end type bushing_part_t

   !> `has_` marks what is given.
   type :: axle_facts_t
      logical :: has_toe = .false., has_camber = .false.
      real(wp) :: toe = 0.0_wp, camber = 0.0_wp      !! [deg], signs of the deck
      integer :: toe_line = 0, camber_line = 0
      type(spring_part_t) :: springs(2)
      type(bushing_part_t) :: bushings(3)
      logical :: has_link_axes = .false.             !! the axes of the joint of the trailing link on the chassis are given
      real(wp) :: link_axes(3, 2) = 0.0_wp           !! fixed in the chassis, fixed in the link; axes of the deck
      type(message_list_t) :: assumed, omitted       !! lines for the comments of the deck
   end type axle_facts_t

end module ek_axle_facts
