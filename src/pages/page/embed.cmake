# Makes ek_page_assets.f90 of the style sheet and the script of the pages:
#   cmake -DSTYLE=page.css "-DSCRIPT=chart.js,page.js" -DLIVE_STYLE=live.css -DLIVE_SCRIPT=live.js \
#     -DTURNTABLE_SCRIPT=turntable.js -DFIGURE_SCRIPT=figure.js -DMODULE=ek_page_assets.f90 -P embed.cmake
# The parts of pages whose rates can be changed, and of those with a turntable or figures, are added to those of all pages.
# Comments of a whole line and indents are left out.
include(${CMAKE_CURRENT_LIST_DIR}/../../embed.cmake)

# Statements that append the lines of files to the buffer `out`, in the variable `result`
function(ek_statements_of_files result)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ ${file} content)
    string(APPEND text "\n${content}")
  endforeach()
  string(REGEX REPLACE "\n[ ]+" "\n" text "${text}")
  string(REGEX REPLACE "\n//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n/[*][^\n]*[*]/" "" text "${text}")
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  string(REGEX REPLACE "^\n" "" text "${text}")
  ek_statements(statements "      " "${text}")
  set(${result} "${statements}" PARENT_SCOPE)
endfunction()

string(REPLACE "," ";" SCRIPT "${SCRIPT}")
ek_statements_of_files(style ${STYLE})
ek_statements_of_files(script ${SCRIPT})
ek_statements_of_files(live_style ${LIVE_STYLE})
ek_statements_of_files(live_script ${LIVE_SCRIPT})
ek_statements_of_files(turntable_script ${TURNTABLE_SCRIPT})
ek_statements_of_files(figure_script ${FIGURE_SCRIPT})
file(WRITE ${MODULE} "!> Style sheet and script of the pages, made by embed.cmake from the files in src/pages/page.
module ek_page_assets
   use ek_buffer, only: buffer_t
   implicit none(type, external)
   private
   public :: add_style, add_script, add_live_style, add_live_script, add_turntable_script, add_figure_script

   character(*), parameter :: nl = new_line('a')

contains

   pure subroutine add_style(out)
      type(buffer_t), intent(inout) :: out
${style}   end subroutine add_style

   pure subroutine add_script(out)
      type(buffer_t), intent(inout) :: out
${script}   end subroutine add_script

   pure subroutine add_live_style(out)
      type(buffer_t), intent(inout) :: out
${live_style}   end subroutine add_live_style

   pure subroutine add_live_script(out)
      type(buffer_t), intent(inout) :: out
${live_script}   end subroutine add_live_script

   pure subroutine add_turntable_script(out)
      type(buffer_t), intent(inout) :: out
${turntable_script}   end subroutine add_turntable_script

   pure subroutine add_figure_script(out)
      type(buffer_t), intent(inout) :: out
${figure_script}   end subroutine add_figure_script

end module ek_page_assets
")
