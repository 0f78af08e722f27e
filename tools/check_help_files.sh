#!/usr/bin/env bash
# check_help_files.sh PROGRAM: man pages and completion of bash, zsh and fish, as the build makes them from the tables of commands.
#
# Man pages: no warning of mandoc or groff (what is installed), and every command and option of `--help` in its page. Completion: each
# shell that is installed is asked what it offers: every command; every option of every command; folders, and the names of a list as values.
# Status 77 if none of the tools is installed.
# shellcheck disable=SC2016,SC2317     # expanded by another shell; called by name
set -uo pipefail
program=$(realpath "$1")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
wrong=0
checked=''
bad() { echo "check_help_files: $1" >&2; wrong=1; }

"$program" --help-files "$work/share" || exit 1
pages=$work/share/man/man1
bash_file=$work/share/bash-completion/completions/elastokin
mapfile -t commands < <("$program" --help | sed -n 's/^  \([a-z][a-z_-]*\) .*/\1/p')
[ ${#commands[@]} -ge 8 ] || bad "only ${#commands[@]} commands"
options_of() { "$program" "$1" --help | grep -oE -- '(^ +|\[|, )--[a-z][a-z-]*' | grep -oE -- '--[a-z-]+' | sort -u; }

# ---- man pages
for page in "$pages"/*.1; do
  if command -v mandoc >/dev/null; then
    mandoc -T lint -W warning "$page" || bad "mandoc: $(basename "$page")"
    checked="$checked mandoc"
  fi
  if command -v groff >/dev/null; then
    groff -man -ww -K utf8 -T utf8 -z "$page" 2>"$work/said"
    [ ! -s "$work/said" ] || { cat "$work/said"; bad "groff: $(basename "$page")"; }
    checked="$checked groff"
  fi
done
plain() { sed -e 's/\\-/-/g' "$1"; }
for command in "${commands[@]}"; do
  page=$pages/elastokin-$command.1
  [ -s "$page" ] || { bad "no page of $command"; continue; }
  plain "$pages/elastokin.1" | grep "^.BR elastokin-$command (1)" >/dev/null || bad "elastokin.1 without $command"
  for option in $(options_of "$command"); do
    plain "$page" | grep -E "^\.BI? $option( |$)" >/dev/null || bad "elastokin-$command.1 without $option"
  done
  if grep -Pzoq '\.TP\n\.BI? [^\n]*\n(\n|\.TP|\.SH)' "$page"; then bad "elastokin-$command.1: an option without a description"; fi
done

# ---- completion: each of these prints what a shell offers for a command line, one per line
mkdir -p "$work/folder/within" "$work/home"
touch "$work/folder/deck.nml"
cd "$work/folder" || exit 1

offered_by_bash() {
  bash --norc -c '
    source "$1"; shift
    compopt() { :; }      # belongs to a completion at the prompt
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=()
    _elastokin
    printf "%s\n" "${COMPREPLY[@]}"' - "$bash_file" "$@"
}

offered_by_fish() {
  HOME=$work/home fish --no-config -c 'source $argv[1]; complete -C "$argv[2]"' "$work/share/fish/vendor_completions.d/elastokin.fish" "$*" | cut -f 1
}

# zsh completes only at a prompt: one in a pseudo terminal, where what is offered is printed between marks
cat >"$work/complete.zsh" <<'END'
zmodload zsh/zpty
zpty shell zsh -f -i
ask() { zpty -w shell "$1"; }
ask 'PROMPT= ; RPROMPT= ; unsetopt beep zle_bracketed_paste; stty -echo 2>/dev/null'
ask "fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D"
ask "zstyle ':completion:*' list-grouped false; zstyle ':completion:*' verbose false; LISTMAX=0; COLUMNS=500"
ask 'compadd() { if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
  typeset -a __hits; builtin compadd -A __hits "$@"; (( ${#__hits} )) && print -rl -- "<"${^__hits}">" > /dev/tty; builtin compadd "$@" }'
ask 'finish() { zle -I; print -r -- "<<end>>" > /dev/tty }; zle -N finish; bindkey "^X" finish; bindkey "^I" complete-word'
ask 'print -r -- "<<ready"">>"'
zpty -r shell said '*<<ready>>*'
zpty -n -w shell "$2"$'\t\x18'
zpty -r shell said '*<<end>>*'
print -r -- "$said" | tr -d '\r' | sed -n 's/^.*<\([^<>]*\)>$/\1/p'
zpty -d shell
END
offered_by_zsh() { HOME=$work/home timeout 20 zsh -f "$work/complete.zsh" "$work/share/zsh/site-functions" "$*"; }

expect_offer() { # expect_offer SHELL LABEL WANTED…: the offer, in $work/offer, has these items
  local shell=$1 label=$2 word
  shift 2
  for word; do
    grep -qxE -- "${word}[ =/]?" "$work/offer" || { bad "$shell: '$label' does not offer $word, but $(tr '\n' ' ' <"$work/offer")"; return; }
  done
}

for shell in bash zsh fish; do
  command -v $shell >/dev/null || continue
  checked="$checked $shell"
  "offered_by_$shell" elastokin '' >"$work/offer"
  expect_offer $shell 'elastokin ' "${commands[@]}"
  for command in "${commands[@]}"; do
    mapfile -t options < <(options_of "$command")
    "offered_by_$shell" elastokin "$command" -- >"$work/offer"
    expect_offer $shell "elastokin $command --" "${options[@]}"
    [ "$(grep -c -- '^--' "$work/offer")" -eq ${#options[@]} ] || bad "$shell: $command: offers others: $(tr '\n' ' ' <"$work/offer")"
  done
  "offered_by_$shell" elastokin run --out '' >"$work/offer"
  expect_offer $shell 'elastokin run --out ' within
  ! grep -q deck "$work/offer" || bad "$shell: a file for --out"
  "offered_by_$shell" elastokin run --method '' >"$work/offer"
  expect_offer $shell 'elastokin run --method ' recursive corrected equilibrium
  "offered_by_$shell" elastokin new '' >"$work/offer"
  expect_offer $shell 'elastokin new ' double_wishbone mcpherson push_rod
done
# bash splits --method=c
offered_by_bash elastokin run --method = c >"$work/offer"
[ "$(cat "$work/offer")" = corrected ] || bad "bash: --method=c"

checked=$(tr ' ' '\n' <<<"$checked" | sort -u | tr '\n' ' ')
echo "remark:${checked:- nothing}"
[ -n "$checked" ] || exit 77
exit $wrong
