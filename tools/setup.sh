#!/usr/bin/env bash
# setup.sh [PACKAGE...]: installs what is missing to build elastokin and draw its figures.
#
# Checks for gfortran 12 or newer, a C compiler, CMake 3.25 or newer, make, Ninja, a LAPACK, and gnuplot with a font. Missing packages
# are installed with apt-get, as root or through sudo without a password; if neither
# is possible, the command is printed and the status is 1. PACKAGE: further Debian or Ubuntu packages.
# Quick when nothing is missing. FC selects another compiler than gfortran.
set -euo pipefail

missing=()
reasons=()
lacks() { # lacks PACKAGE WHAT
  missing+=("$1")
  reasons+=("$2")
}

at_least() { # at_least WANTED FOUND: version numbers
  [ "$(printf '%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]
}

has_compiler() {
  command -v "${FC:-gfortran}" >/dev/null && at_least 12 "$("${FC:-gfortran}" -dumpversion)"
}

has_c_compiler() { # with the headers of the C library
  printf '#include <unistd.h>\n' | "${CC:-cc}" -fsyntax-only -x c - 2>/dev/null
}

has_cmake() {
  command -v cmake >/dev/null && at_least 3.25 "$(cmake --version | awk 'NR == 1 {print $3}')"
}

has_lapack() { # whether a program that calls LAPACK links
  local folder status=1 libraries
  folder=$(mktemp -d) || { # errexit does not count in a condition
    echo "setup: cannot make a temporary folder in ${TMPDIR:-/tmp}; set TMPDIR to a folder that can be written" >&2
    exit 1
  }
  printf 'external dsytrf\ncall dsytrf\nend\n' >"$folder/probe.f90"
  for libraries in -lopenblas '-llapack -lblas'; do
    # shellcheck disable=SC2086  # two arguments
    if "${FC:-gfortran}" -o "$folder/probe" "$folder/probe.f90" $libraries 2>/dev/null; then status=0; break; fi
  done
  rm -rf "$folder"
  return $status
}

has_font() { # a sans-serif font; without it gnuplot uses another font, or draws boxes
  [ -n "$(find -L /usr/share/fonts /usr/local/share/fonts "${HOME:-/nonexistent}/.fonts" \
    "${HOME:-/nonexistent}/.local/share/fonts" \( -iname '*sans*.[ot]tf' -o -iname '*arial*.ttf' \) -print -quit 2>/dev/null)" ]
}

check_all() {
  missing=()
  reasons=()
  has_compiler || lacks gfortran 'gfortran 12 or newer'
  if has_compiler && ! has_c_compiler; then     # gfortran brings both
    lacks gcc 'a C compiler'
    lacks libc6-dev 'the headers of the C library'
  fi
  has_cmake || lacks cmake 'CMake 3.25 or newer'
  command -v make >/dev/null || lacks make make
  command -v ninja >/dev/null || lacks ninja-build Ninja
  if ! has_compiler || ! has_lapack; then
    # without a compiler LAPACK cannot be tested; installing it again costs nothing
    lacks libopenblas-dev LAPACK
  fi
  command -v gnuplot >/dev/null || lacks gnuplot-nox gnuplot
  has_font || lacks fonts-dejavu-core 'a font for the figures'
  local package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep 'ok installed' >/dev/null || lacks "$package" "$package"
  done
}

explain() {
  local k
  for k in "${!missing[@]}"; do echo "setup: missing: ${reasons[k]}" >&2; done
}

check_all "$@"
[ ${#missing[@]} -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
  explain
  echo "setup: apt-get is not available; install these packages by other means and run this again" >&2
  exit 1
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo -n)
  else
    explain
    echo "setup: root is required to install them. Please run" >&2
    echo "    sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" </dev/null >>"$log" 2>&1; }
install() { apt install -y --no-install-recommends "${missing[@]}"; }

echo "setup: installing ${missing[*]}"
# package lists are fetched only if they are absent or out of date
if ! apt-cache show "${missing[@]}" >/dev/null 2>&1 || ! install; then
  if ! apt update || ! install; then
    tail -n 20 "$log" >&2
    echo "setup: apt-get could not install ${missing[*]}" >&2
    exit 1
  fi
fi

check_all "$@"
if [ ${#missing[@]} -gt 0 ]; then
  explain
  echo "setup: still missing after apt-get: is this release older than Debian 12 or Ubuntu 24.04?" >&2
  exit 1
fi
