# cpack runs this before it packs: makes the files of each Debian package as Debian has them. Man pages and change logs are compressed,
# copyright and change log are in every package, and zsh reads its completions from vendor-completions.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()

function(ek_run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The change log in the form of Debian: the version and its date in CHANGELOG.md, by which the archive is the same every time
file(STRINGS ${CPACK_EK_CHANGES} ek_lines REGEX "^## \\[[0-9]")
list(GET ek_lines 0 ek_line)
string(REGEX MATCH "[0-9][0-9][0-9][0-9]-[0-9][0-9]-[0-9][0-9]" ek_day "${ek_line}")
execute_process(COMMAND date -u -R -d "${ek_day} 12:00" OUTPUT_VARIABLE ek_date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  if(NOT EXISTS ${root})
    continue()
  endif()
  file(GLOB pages ${root}/share/man/man*/*.[0-9])
  if(pages)
    ek_run(gzip -9 -n -f ${pages})
  endif()
  if(EXISTS ${root}/share/zsh/site-functions)
    file(RENAME ${root}/share/zsh/site-functions ${root}/share/zsh/vendor-completions)
  endif()
  set(documents ${root}/share/doc/${package})
  file(REMOVE ${documents}/CHANGELOG.md)
  file(COPY ${CPACK_EK_COPYRIGHT} DESTINATION ${documents})
  file(COPY_FILE ${CPACK_EK_CHANGES} ${documents}/changelog)
  file(WRITE ${documents}/changelog.Debian
    "elastokin (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * The changes are in changelog.gz.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${ek_date}\n")
  ek_run(gzip -9 -n -f ${documents}/changelog ${documents}/changelog.Debian)
  ek_run(chmod -R u=rwX,go=rX ${CPACK_TEMPORARY_DIRECTORY}/${component})
endforeach()
