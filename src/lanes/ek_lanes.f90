!> The numbers of kernels for four designs at a time. This module replaces `ek_number` in the copies of the kernels that the build
!> makes.
module ek_lanes
   use ek_lane_numbers, only: lanes, lanes_t, zero, one, assignment(=), operator(+), operator(-), operator(*), operator(/), &
      operator(**)
   use ek_lane_conditions, only: mask_t, piece_t, operator(<), operator(<=), operator(>), operator(>=), operator(.and.), &
      operator(.or.), operator(.not.), some, every, merge, min, max, abs, pieces_below, entry
   use ek_lane_functions, only: sqrt, sin, cos, atan2, log, dot_product, sum, norm2
   implicit none(type, external)
   public
end module ek_lanes
