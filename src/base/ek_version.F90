!> The program version, set only by project() in CMakeLists.txt.
module ek_version
   implicit none(type, external)
   private
   character(*), parameter, public :: version = EK_VERSION
end module ek_version
