# shellcheck shell=bash disable=SC2154
# Checks of the text of sources, scripts and documents.

scripts_are_sound() {
  shellcheck tools/*.sh packaging/*.sh packaging/wasm/*.sh studies/*/*.sh studies/*/*.sbatch tests/support/*.sh docs/pictures/*.sh tests/support/selftest/*.sh tests/attacks/*.sh \
    examples/drivers/dakota/*.sh .ci/run .ci/deep .ci/*.sh .ci/checks/*.sh
}

# House rules that a linter can check: implicit none(type, external), private by default, intent, `use ..., only`,
# no variable saved by its initial value, kinds, no unreachable statement, no trailing blanks
fortran_is_tidy() {
  local tools=$logs/venv
  # Fortran has no pointer to data that must not change: a definition is not written to after its deck was opened
  if grep -rnE '(^|\)) *([a-z_]+%)*definition%[a-z_0-9%]+(\([^)=]*\))?[a-z_0-9%]* = ' src --include='*.f90'; then
    echo 'these lines change a definition, which all workspaces of a deck share'
    return 1
  fi
  # One module knows the terminals of gnuplot, and every colour of its figures
  if grep -rnE "set terminal|rgb '?#|'#[0-9A-Fa-f]{6}" src --include='*.f90' --include='*.F90' | grep -v '^src/figures/ek_gnuplot\.f90:'; then
    echo 'these lines name a terminal or a colour: src/figures/ek_gnuplot.f90 has them by role'
    return 1
  fi
  # What the release build warned of: in a fresh clone its log has the whole program
  if grep -nE -B6 'Warning: .*\[-W' build/release/build.log | grep -E '^[0-9]+-.*/src/[a-z]+/[a-z_0-9]+\.(f|F)90:[0-9]+'; then
    echo 'the compiler warned of these lines (build/release/build.log)'
    return 1
  fi
  if [ ! -x "$tools/bin/fortitude" ]; then
    if ! python3 -m venv "$tools" || ! "$tools/bin/pip" install --quiet fortitude-lint==0.10.0; then
      skip "fortitude-lint could not be installed from PyPI"
      return
    fi
  fi
  "$tools/bin/fortitude" check --output-format concise \
    --select C001,C003,C021,C022,C051,C061,C081,C091,C092,C121,C122,C131,C161,C191,E,S101 src tools/bench
}

# Links, the numbers of README.md (those of the library as the program prints them) and the terms that users look for
# (tests/support/check_documents.py); the deck of README.md, letter by letter; the links of the installed documents. Each kind of
# mistake is noticed
documents_agree() {
  local copy=$logs/documents wrong=0
  PATH=$top/build/release/bin:$PATH tests/support/check_documents.py --run || return 1
  tests/support/check_documents.py "$logs/prefix/share/elastokin" || return 1
  PATH=$top/build/release/bin:$PATH tests/support/run_tutorial.py README.md || return 1
  break_document() { # break_document WHAT FILE SED-EXPRESSION: a copy with this change must be rejected
    sed -i "$3" "$copy/$2"
    cmp -s "$2" "$copy/$2" && { echo "$1: nothing was changed"; wrong=1; }
    "$copy/tests/support/check_documents.py" >"$logs/documents.txt" && { echo "not noticed: $1"; wrong=1; }
    sed "s/^/rejected as intended ($1): /" "$logs/documents.txt"
    cp "$2" "$copy/$2"
  }
  rm -rf "$copy"
  mkdir -p "$copy"
  git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$copy" && git -C "$copy" init -q || return 1
  break_document 'a changed number' README.md 's/31\.3 N\/mm/31.4 N\/mm/'
  break_document 'a new number' README.md '0,/^- Rigid bodies/s//- 17 rigid bodies/'
  break_document 'a changed result' input/mcpherson_axle/README.md 's/| 31\.3; /| 31.2; /'
  break_document 'a link to no file' docs/index.md 's/(tutorial\.md)/(tutorials.md)/'
  break_document 'a link to no heading' docs/questions.md 's/(choices\.md#which-balance)/(choices.md#which-balances)/'
  break_document 'a lost term' docs/glossary.md '/^| rotate a bushing/d'
  break_document 'a long line' docs/limits.md 's/^- The analysis is static\./& Static is what does not move in time, and what does not move in time has no inertia. It has no damping either./'
  break_document 'a long sentence' docs/limits.md 's/^- The analysis is static\./- a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a a./'
  break_document 'two colons' docs/glossary.md 's/^| /| one: two: /'
  rm -rf "$copy"
  return $wrong
}

# The tutorial, and the smallest examples of the manual, each in an empty folder, letter by letter; the commands of the other pages; the snippets of the gallery of joints stand in their decks; the figures are drawn
tutorial_works() {
  local page
  for page in docs/{tutorial,rig_test,read_report,targets,import,optimiser,failed_states,loads,points,adjust,joints}.md input/{README,RIG,STUDIES}.md; do
    PATH=$top/build/release/bin:$PATH tests/support/run_tutorial.py "$page" || return 1
  done
  PATH=$top/build/release/bin:$PATH tests/support/run_commands.py docs/*.md || return 1
  tests/support/check_snippets.py docs/joints.md || return 1
  rm -rf "$logs/pictures"
  docs/pictures/draw.sh "$logs/pictures" || return 1
  diff <(cd docs/pictures && ls ./*.svg) <(cd "$logs/pictures" && ls ./*.svg)
}

# The site of the documentation, with the reports of the library: every link and anchor exists; in the browser no page asks another server
# for anything, writes to the console, or is wider than a phone. The workbench in the tutorial solves the deck of the tutorial, where
# tools/wasm.sh has made the page
site() {
  local tools=$logs/venv_site folder=$logs/site
  if ! python_with venv_site -r docs/site/requirements.txt playwright; then
    skip "MkDocs and playwright could not be installed from PyPI"
    return
  fi
  rm -rf "$folder"
  [ ! -f build/wasm/elastokin.html ] || export EK_PAGE=$top/build/wasm/elastokin.html
  [ -n "${EK_PAGE:-}" ] || echo "remark: the site has no workbench, because build/wasm/elastokin.html does not exist"
  EK_REPORTS=$logs/reports "$tools/bin/mkdocs" build --strict --site-dir "$folder" || return 1
  if ! command -v chromium >/dev/null && ! tools/setup.sh chromium; then
    skip "not opened, chromium could not be installed"
    return
  fi
  "$tools/bin/python" tests/support/check_site.py "$folder" "$logs/site_pictures"
}

# docs/validation.md has the numbers that the program gives, input/NAMES.md its definitions of other programs
validation_page() {
  cmake --build build/release --target validation_numbers --parallel "$EK_JOBS" >"$logs/validation_numbers.txt" 2>&1 || { tail -n 30 "$logs/validation_numbers.txt"; return 1; }
  tests/support/validation_page.py --check build/release/tests/validation_numbers || return 1
  tests/support/names_page.py --check build/release/bin/elastokin
}

# Documents, messages and comments use the terms of the field: tools/check_language.sh contains the list
plain_english() {
  tools/check_language.sh
}

# Every equation of docs/theory names its procedures and every procedure its equations; the check notices a wrong number,
# a renamed procedure and a lost reference
theory_and_code() {
  local copy=$logs/theory wrong=0
  tools/check_theory.sh || return 1
  break_theory() { # break_theory WHAT FILE SED-EXPRESSION: a copy with this change must be rejected
    rm -rf "$copy"
    mkdir -p "$copy"
    cp -r docs src tests tools input studies "$copy"
    sed -i "$3" "$copy/$2"
    cmp -s "$2" "$copy/$2" && { echo "$1: nothing was changed"; wrong=1; }
    tools/check_theory.sh "$copy" >"$logs/theory.txt" && { echo "not noticed: $1"; wrong=1; }
    sed "s/^/rejected as intended ($1): /" "$logs/theory.txt"
  }
  break_theory 'a number that does not exist' src/model/ek_block.f90 's/Equation (M\.2)/Equation (M.99)/'
  break_theory 'another number' src/model/ek_block.f90 's/Equation (M\.2)/Equation (M.4)/'
  break_theory 'a lost reference' src/compliance/ek_port_response.f90 '/Equation (C\.6)/d'
  break_theory 'a renamed procedure' src/equilibrium/ek_motion.f90 's/largest_motion/longest_motion/g'
  break_theory 'an equation without code' docs/theory/measures.md '/^Code of (M\.2)/d'
  break_theory 'a lost equation' docs/theory/kkt.md 's/ .tag{K\.12}//'
  rm -rf "$copy"
  return $wrong
}

# No file contains a path on a developer's machine
no_private_paths() {
  ! grep -rnIE '(^|[^A-Za-z0-9._-])/(work|home|Users|root)/[A-Za-z.]' --exclude-dir=.git --exclude-dir=build \
    --exclude-dir=out --exclude-dir=.venv --exclude=.git .
}

# Nothing that ran left a file, or changed one (tree_before.txt: the state before the first check)
tests_leave_no_trace() {
  diff "$logs/tree_before.txt" <(tree_state)
}
