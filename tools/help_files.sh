#!/usr/bin/env bash
# help_files.sh PROGRAM FOLDER: writes the man page elastokin.1 and the completion of bash, elastokin.bash, from the help of the program.
#
# Both contain what `elastokin --help` and `elastokin COMMAND --help` print, and so follow the tables of src/commands/ek_command.f90.
# shellcheck disable=SC2016     # expanded by the completion, not here
set -euo pipefail
if [ $# -ne 2 ]; then echo "usage: help_files.sh PROGRAM FOLDER" >&2; exit 1; fi
program=$1
folder=$2
commands=$("$program" --help | sed -n 's/^  \([a-z]*\) .*/\1/p' | tr '\n' ' ')

verbatim() { # a help text as preformatted text of a man page
  printf '.nf\n'
  sed -e 's/\\/\\e/g' -e "s/^\([.']\)/\\\\\&\1/" -e 's/-/\\-/g'
  printf '.fi\n'
}

{
  printf '.TH ELASTOKIN 1 "" "%s"\n.SH NAME\nelastokin \\- elastokinematics of vehicle suspensions\n' "$("$program" --version)"
  printf '.SH SYNOPSIS\n'
  "$program" --help | verbatim
  for command in $commands; do
    printf '.SH %s\n' "$(printf '%s' "$command" | tr '[:lower:]' '[:upper:]')"
    "$program" "$command" --help | verbatim
  done
} >"$folder/elastokin.1"

{
  printf '_elastokin() {\n  local word=${COMP_WORDS[COMP_CWORD]}\n  case ${COMP_WORDS[1]-} in\n'
  for command in $commands; do
    printf '    %s) set -- %s ;;\n' "$command" \
      "$({ "$program" "$command" --help | grep -o -- '--[a-z][a-z-]*'; echo --help; } | sort -u | tr '\n' ' ')"
  done
  printf '    *) set -- %s --help --version ;;\n  esac\n' "$commands"
  printf '  [ "$COMP_CWORD" -gt 1 ] || set -- %s --help --version\n' "$commands"
  printf '  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$word")\n}\ncomplete -o default -F _elastokin elastokin\n'
} >"$folder/elastokin.bash"
