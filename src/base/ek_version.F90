!> The version, from the one place that sets it: project() in CMakeLists.txt.
module ek_version
   implicit none(type, external)
   private
   character(*), parameter, public :: version = EK_VERSION
end module ek_version
