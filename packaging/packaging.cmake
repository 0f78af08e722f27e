# Packages: `cmake --build --preset release --target packages` compiles what they need and calls cpack; results in build/release/packages.
#
# The tarball holds everything. A Debian package is made of every component of the install rules; a new component needs nothing here,
# and a line of `ek_packages` if its package is to have another name than elastokin-<component>.
set(ek_packages runtime=elastokin lib=libelastokin${PROJECT_VERSION_MAJOR})
set(EK_MAINTAINER "elastokin developers <developers@elastokin.invalid>" CACHE STRING "Maintainer named in packages")

# Both licences, in the form of Debian (DEP-5): a binary must come with them
file(READ LICENSE ek_license)
file(READ src/math/ek_sobol_numbers.f90 ek_numbers)
string(REGEX MATCH "!> Copyright.*direct.*possibility of such damage\\.\n" ek_numbers "${ek_numbers}")
if(NOT ek_numbers)
  message(FATAL_ERROR "src/math/ek_sobol_numbers.f90: its licence was not found")
endif()
string(REGEX REPLACE "!>" "" ek_numbers "${ek_numbers}")
foreach(text license numbers)
  string(STRIP "${ek_${text}}" ek_${text})
  string(REGEX REPLACE "\n+ *" "\n" ek_${text} "${ek_${text}}")
  string(REPLACE "\n" "\n " ek_${text} "${ek_${text}}")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/copyright @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: elastokin

Files: *
Copyright: 2026 the elastokin developers
License: BSD-3-Clause

Files: src/math/ek_sobol_numbers.f90
Copyright: 2008 Frances Y. Kuo and Stephen Joe
License: BSD-3-Clause-Kuo-Joe

License: BSD-3-Clause
 @ek_license@

License: BSD-3-Clause-Kuo-Joe
 @ek_numbers@
")
# OpenBLAS in the programs, with its LAPACK, comes with both licences, as the system has them:
# …/openblas-pthread/libopenblas.a is of the package libopenblas-pthread-dev
get_target_property(ek_archive elastokin EK_BLAS_ARCHIVE)
if(ek_archive)
  file(REAL_PATH ${ek_archive} ek_archive)
  cmake_path(GET ek_archive PARENT_PATH ek_archive)
  cmake_path(GET ek_archive FILENAME ek_archive)
  foreach(library blas lapack)
    string(TOUPPER ${library} key)
    set(ek_documents_of_blas lib${ek_archive}-dev libopenblas-dev)
    set(ek_documents_of_lapack liblapack-pic liblapack-dev liblapack3)
    list(TRANSFORM ek_documents_of_${library} PREPEND /usr/share/doc/)
    find_file(EK_${key}_LICENCE NAMES copyright PATHS ${ek_documents_of_${library}} NO_DEFAULT_PATH
      DOC "Licence of the ${library} in the programs, for packages")
    if(EK_${key}_LICENCE)
      install(FILES ${EK_${key}_LICENCE} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime RENAME copyright.${library})
    else()
      message(STATUS "Packages: the licence of the ${library} in the programs was not found; name its file by "
        "-DEK_${key}_LICENCE=…, or take the shared library by -DEK_STATIC_BLAS=OFF")
    endif()
  endforeach()
endif()
install(FILES README.md CHANGELOG.md CITATION.cff ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
# The library of decks and all that the README refers to, as in the repository. Links in the folder of the README lead there, so that its
# links hold too
set(ek_folders docs examples input schema studies)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/elastokin COMPONENT runtime)
install(DIRECTORY ${ek_folders} DESTINATION ${CMAKE_INSTALL_DATADIR}/elastokin COMPONENT runtime USE_SOURCE_PERMISSIONS
  PATTERN out EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN docs/site EXCLUDE PATTERN "docs/pictures/*.gp" EXCLUDE PATTERN docs/pictures/draw.sh EXCLUDE)
install(FILES python/README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/elastokin/python COMPONENT runtime)
file(RELATIVE_PATH ek_up ${CMAKE_INSTALL_FULL_DOCDIR} ${CMAKE_INSTALL_FULL_DATADIR}/elastokin)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/documents)
foreach(folder IN LISTS ek_folders ITEMS python)
  file(CREATE_LINK ${ek_up}/${folder} ${PROJECT_BINARY_DIR}/documents/${folder} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/documents/${folder} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
endforeach()
if(TARGET elastokin-mpi)      # the same program: its page refers to that of elastokin
  file(WRITE ${PROJECT_BINARY_DIR}/elastokin-mpi.1 ".so man1/elastokin.1\n")
  install(FILES ${PROJECT_BINARY_DIR}/elastokin-mpi.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT mpi)
endif()

# cpack would else compile the tests: `all` is what it asks for first
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY TRUE)
add_custom_target(packages COMMAND ${CMAKE_CPACK_COMMAND} -C ${CMAKE_BUILD_TYPE} WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
  COMMENT "Packages, in ${PROJECT_BINARY_DIR}/packages" VERBATIM)
add_dependencies(packages elastokin)
foreach(target elastokin-mpi elastokin-netcdf elastokin_c)
  if(TARGET ${target})
    add_dependencies(packages ${target})
  endif()
endforeach()

set(CPACK_GENERATOR TGZ)
find_program(EK_DPKG_SHLIBDEPS dpkg-shlibdeps)      # names the packages of the shared libraries in use
find_program(EK_FILE file)                          # by which cpack finds the programs for it
if(EK_DPKG_SHLIBDEPS AND EK_FILE)
  list(APPEND CPACK_GENERATOR DEB)
else()
  message(STATUS "Packages: the tarball only; Debian packages require dpkg-dev and file")
endif()
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_VENDOR "elastokin developers")
set(CPACK_PACKAGE_CONTACT "${EK_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "kinematics and compliance of vehicle suspensions")
set(CPACK_PACKAGE_FILE_NAME ${PROJECT_NAME}-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
set(CPACK_EK_CHANGES ${PROJECT_SOURCE_DIR}/CHANGELOG.md)          # for that script
set(CPACK_EK_COPYRIGHT ${PROJECT_BINARY_DIR}/copyright)

get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(TARGET ek_loaded_lanes)     # a library of the programs alone, in the package that the others depend on
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib/elastokin)
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
string(JOIN "\n" ek_description
  "elastokin reads a deck of hardpoints, joints, bushings, springs and load cases"
  "and computes the curves, compliance matrices and gradients that a K&C rig"
  "measures: one HTML page, CSV and JSON files. Studies vary a deck in thousands"
  "to millions of designs.")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(name elastokin-${component})
  foreach(pair IN LISTS ek_packages)
    if(pair MATCHES "^${component}=(.*)")
      set(name ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${ek_description}")
endforeach()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "elastokin-mpi, elastokin-netcdf, elastokin-dev")
set(ek_same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "elastokin ${ek_same}")
set(CPACK_DEBIAN_NETCDF_PACKAGE_DEPENDS "elastokin ${ek_same}")
# module files are readable by the compiler that wrote them
string(REGEX MATCH "^[0-9]+" ek_major "${CMAKE_Fortran_COMPILER_VERSION}")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libopenblas-dev | liblapack-dev")
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", gfortran-${ek_major}")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
if(lib IN_LIST CPACK_COMPONENTS_ALL)
  string(PREPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${CPACK_DEBIAN_LIB_PACKAGE_NAME} ${ek_same}, ")
  set(CPACK_DEBIAN_LIB_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)      # of packages with a library
  file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
endif()
include(CPack)

include(${CMAKE_CURRENT_LIST_DIR}/wasm/wasm.cmake)
