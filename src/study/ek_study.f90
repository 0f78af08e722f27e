module ek_study
 implicit none
end module
