# Text as statements of Fortran, for the modules that are made of files (pages/page/embed.cmake, commands/library/embed.cmake)

# ek_statements(result indent text): statements that append a text to the buffer `out`, in the variable `result`; each begins
# with the text `indent`. A line is cut into constants of at most 60 letters.
string(REPEAT "[^\n]" 60 ek_piece)
function(ek_statements result indent text)
  string(ASCII 1 cut)
  string(REGEX REPLACE "\n$" "" text "${text}")
  string(REGEX REPLACE "(${ek_piece})" "\\1${cut}" text "${text}")
  string(REPLACE "'" "''" text "${text}")
  string(REPLACE "${cut}" "')\n${indent}call out%add('" text "${text}")
  string(REPLACE "\n${indent}call" "${cut}" text "${text}")
  string(REPLACE "\n" "'//nl)\n${indent}call out%add('" text "${text}")
  string(REPLACE "${cut}" "\n${indent}call" text "${text}")
  set(${result} "${indent}call out%add('${text}'//nl)\n" PARENT_SCOPE)
endfunction()
