# OpenBLAS in the programs from its archive instead of the shared library: tables of the library name 14 000 of its own symbols, and
# the loader looks up each whenever a program starts. That takes a millisecond, as long as the solution of a small deck.
#
#   EK_BLAS_ARCHIVE   property of a target: the archive that it is linked with in place of LAPACK::LAPACK
#
# The bits are those of the shared library, as both have the same kernels. Only in release builds: the programs are 26 MB larger.
option(EK_STATIC_BLAS "Link OpenBLAS into the programs if its archive lies beside the shared library: they start 1 ms sooner" ON)
set(ek_blas_archive "")
set(ek_why "")
set(ek_openblas ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
list(FILTER ek_openblas INCLUDE REGEX "/libopenblas\\.so$")
list(REMOVE_DUPLICATES ek_openblas)
if(NOT EK_STATIC_BLAS)
  set(ek_why "EK_STATIC_BLAS is off")
elseif(NOT CMAKE_Fortran_COMPILER_ID STREQUAL "GNU" OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  set(ek_why "the archive is for release builds by gfortran on Linux")
elseif(NOT ek_openblas)
  set(ek_why "it is not the shared library of OpenBLAS")
else()
  string(REGEX REPLACE "\\.so$" ".a" ek_blas_archive "${ek_openblas}")
  # as ek_one_thread.F90 has it
  include(CheckFortranSourceCompiles)
  include(CMakePushCheckState)
  cmake_push_check_state(RESET)
  set(CMAKE_REQUIRED_LIBRARIES "${ek_blas_archive}" ${CMAKE_DL_LIBS})
  set(CMAKE_REQUIRED_LINK_OPTIONS -Wl,--wrap=openblas_num_threads_env -Wl,-u,openblas_get_config
    -Wl,--export-dynamic-symbol=openblas_set_num_threads)
  check_fortran_source_compiles("integer(c_int) function one() bind(c, name='__wrap_openblas_num_threads_env')
      use, intrinsic :: iso_c_binding, only: c_int
      one = 1_c_int
    end function
    program probe
      external :: dsytrf, dgesvd
      call dsytrf()
      call dgesvd()
    end program" ek_has_blas_archive SRC_EXT f90)
  cmake_pop_check_state()
  if(NOT ek_has_blas_archive)
    set(ek_blas_archive "")
    set(ek_why "no archive beside it that gfortran can link")
  endif()
endif()
if(ek_blas_archive)
  message(STATUS "BLAS of the programs: ${ek_blas_archive}")
else()
  message(STATUS "BLAS of the programs: the shared library, as ${ek_why}")
endif()
