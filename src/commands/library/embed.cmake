# Makes ek_library_decks.f90 of decks of the library, for `elastokin new`:
#   cmake "-DDECKS=kind=folder/deck.nml,..." -DINPUT=input -DMODULE=ek_library_decks.f90 -P embed.cmake
# Each deck becomes one text: included files take the place of their &include, without the comment at their beginning. The
# references of the first comment to other files are renewed. points/kind.nml becomes the text of `kind/points`.
include(${CMAKE_CURRENT_LIST_DIR}/../../embed.cmake)

set(cases "")
string(REPLACE "," ";" DECKS "${DECKS}")
foreach(deck IN LISTS DECKS)
  string(REGEX REPLACE "=.*" "" kind "${deck}")
  string(REGEX REPLACE ".*=" "" path "${deck}")
  get_filename_component(folder "${path}" DIRECTORY)
  file(READ "${INPUT}/${path}" text)
  while(text MATCHES "&include file = '([^']*)' /\n")
    set(record "${CMAKE_MATCH_0}")
    string(REPLACE "." "[.]" name "${CMAKE_MATCH_1}")
    file(READ "${INPUT}/${folder}/${CMAKE_MATCH_1}" included)
    string(REGEX REPLACE "^(![^\n]*\n)+\n" "" included "${included}")
    string(REPLACE "${record}" "${included}" text "${text}")
    string(REGEX REPLACE "The left half is described here and in\n! ${name}; " "The deck describes the left half;\n! " text "${text}")
  endwhile()
  string(REPLACE " See README.md." " See input/${folder}/README.md of elastokin." text "${text}")
  ek_statements(statements "         " "${text}")
  string(APPEND cases "      case ('${kind}')\n${statements}")
  file(READ "${CMAKE_CURRENT_LIST_DIR}/points/${kind}.nml" text)
  ek_statements(statements "         " "${text}")
  string(APPEND cases "      case ('${kind}/points')\n${statements}")
endforeach()
file(WRITE ${MODULE} "!> Decks of the library as text, made by embed.cmake from the folder input.
module ek_library_decks
   use ek_buffer, only: buffer_t
   implicit none(type, external)
   private
   public :: add_deck

   character(*), parameter :: nl = new_line('a')

contains

   !> Appends the deck of a kind, or the joints of `kind/points`; nothing if there is no such kind.
   pure subroutine add_deck(kind, out)
      character(*), intent(in) :: kind
      type(buffer_t), intent(inout) :: out

      select case (kind)
${cases}      end select
   end subroutine add_deck

end module ek_library_decks
")
