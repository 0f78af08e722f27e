# shellcheck shell=bash disable=SC2154
# Checks of reports, pages and JSON files.

is_png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]; }

# Required contents of the report in folder $1
report_is_sound() {
  local folder=$1 table wrong=0
  [ "$(grep -o '{"charts": \[[^]]*' "$folder/report.html" | tr ',' '\n' | wc -l)" -gt 5 ] || { echo "$folder: report.html has no charts"; wrong=1; }
  for table in gradients key_numbers; do
    python3 -m json.tool "$folder/$table.json" >/dev/null || { echo "$folder: $table.json"; wrong=1; }
    [ "$(grep -vc '^#' "$folder/$table.csv")" -gt 10 ] || { echo "$folder: $table.csv is short"; wrong=1; }
  done
  is_png "$folder/picture.png" || { echo "$folder: no picture"; wrong=1; }
  grep -q '<svg' "$folder/picture.svg" || { echo "$folder: no picture as SVG"; wrong=1; }
  for table in "$folder"/*.csv; do
    case $table in */gradients.csv | */key_numbers.csv | */tests.csv | */compliance.csv | */deck.csv | */report-files.csv) continue ;; esac
    awk -F, '/^#/ {next}
      !column {for (k = 1; k <= NF; k++) if ($k == "converged") column = k; if (!column) exit 1; next}
      {states++; if ($column != 1) lost++}
      END {if (states < 3 || lost > 0) exit 1}' "$table" || { echo "$table: not every state converged"; wrong=1; }
  done
  return $wrong
}

# The first command of the README, from an empty folder to figures and a report, and again with everything up to date
demonstration() {
  local picture start
  rm -rf out/demo
  tools/demo.sh || return 1
  for picture in toe camber lateral increments; do
    is_png "out/demo/$picture.png" || return 1
    [ "$(wc -c <"out/demo/$picture.png")" -gt 30000 ] || return 1
    grep -q '<svg' "out/demo/$picture.svg" || return 1
  done
  report_is_sound out/demo/report || return 1
  start=$SECONDS
  tools/demo.sh || return 1
  echo "remark: again in $((SECONDS - start)) s"
}

# Checks every deck of the library and writes its report, unless that is done: build/ci/reports
make_reports() {
  local deck name command wrong=0
  [ -z "$(find build/release/bin/elastokin input -newer "$logs/reports/made" 2>&1 | head -n 1)" ] && return 0
  rm -rf "$logs/reports"
  for deck in input/*/*.nml; do
    grep -q '^ *&model' "$deck" || continue      # part of other decks
    name=$(basename "$deck" .nml)
    mkdir -p "$logs/reports/$name"
    for command in "check $deck" "report $deck --out $logs/reports/$name"; do
      # shellcheck disable=SC2086  # several arguments
      build/release/bin/elastokin $command >"$logs/reports/$name/said.txt" 2>&1 && continue
      echo "elastokin $command: status $?"
      cat "$logs/reports/$name/said.txt"
      wrong=1
    done
  done
  [ $wrong -eq 0 ] && touch "$logs/reports/made"
  return $wrong
}

# The reports of the library have what a report must have, one of them an animation
reports_of_the_library() {
  local page wrong=0 decks=0
  for page in "$logs"/reports/*/report.html; do
    decks=$((decks + 1))
    report_is_sound "$(dirname "$page")" || wrong=1
  done
  build/release/bin/elastokin report input/mcpherson_axle/mcpherson_axle.nml --case parallel_travel --animate \
    --out "$logs/animated" --quiet || wrong=1
  [ "$(head -c 6 "$logs/animated/animation.gif")" = GIF89a ] || { echo "no animation"; wrong=1; }
  [ "$decks" -ge 14 ] || { echo "only $decks decks"; wrong=1; }
  echo "remark: $decks reports"
  return $wrong
}

# Two of the reports in a browser, at desktop and at phone width; the live charts of one are used by a script
page_in_a_browser() {
  local name pages=() tools=$logs/venv_browser
  rm -rf "$logs/browser"
  if ! command -v chromium >/dev/null && ! tools/setup.sh chromium; then
    skip "chromium could not be installed"
    return
  fi
  for name in mcpherson_axle twist_beam_axle; do pages+=("$logs/reports/$name/report.html"); done
  build/release/bin/elastokin solve input/mcpherson_axle/mcpherson_axle.nml --vary point.tie_rod_inner.z=-80:-50 --for left_bump_toe=-1 \
    --page --out "$logs/browser/solved" --quiet >/dev/null || return 1
  pages+=("$logs/browser/solved/mcpherson_axle_solve.html")
  tools/check_page.sh "${pages[@]}" || return 1
  if ! python_with venv_browser playwright axe-playwright-python; then
    skip "live charts are not used, playwright could not be installed from PyPI"
    return
  fi
  build/release/bin/elastokin report input/mcpherson_axle/mcpherson_axle.nml \
    --set point.tie_rod_outer.z=+5 --out "$logs/browser/softer" --no-plots --quiet || return 1
  "$tools/bin/python" tests/page/report_in_a_browser.py "$logs/reports/mcpherson_axle" "$logs/browser/softer/data.json" |
    tee "$logs/browser.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
  echo "remark: $(tail -n 1 "$logs/browser.txt")"
  build/release/bin/elastokin compare "$logs/reports/mcpherson_axle" "$logs/browser/softer" --out "$logs/browser/compared" \
    --no-plots --quiet >/dev/null || return 1
  "$tools/bin/python" tests/page/comparison_in_a_browser.py "$logs/browser/compared" "$logs/reports/mcpherson_axle" \
    "$logs/browser/softer" | tee "$logs/compared.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
  echo "remark: $(tail -n 1 "$logs/compared.txt")"
  for name in what_matters hardpoint_tolerance; do
    build/release/bin/elastokin study "studies/$name/study.nml" --samples 32 --out "$logs/browser/studies" --quiet >/dev/null || return 1
    "$tools/bin/python" tests/page/study_in_a_browser.py "$logs/browser/studies/$name.html" | tee "$logs/study_page.txt"
    [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
    echo "remark: $(tail -n 1 "$logs/study_page.txt")"
  done
  # other rates on the page against runs of the program: free of stress, and with preloads; wheels whose contact point is computed, free
  # of stress and from where they settle
  local live=("$tools/bin/python" tests/page/live_rates_in_a_browser.py build/release/bin/elastokin)
  "${live[@]}" input/mcpherson_axle/mcpherson_axle.nml "$logs/browser/live" model.balance=none 'load.static.force(3)=0' \
    damper.damper.gas_force=0 && "${live[@]}" input/mcpherson_axle/mcpherson_axle.nml "$logs/browser/live" &&
    "${live[@]}" input/double_wishbone/double_wishbone.nml "$logs/browser/live" &&
    "${live[@]}" tests/decks/crown_axle.nml "$logs/browser/live" 'load.road.force(1)=0' 'load.road.force(2)=0' 'load.road.force(3)=0' &&
    "${live[@]}" tests/decks/crown_axle.nml "$logs/browser/live"
}

# What the report of a whole axle costs apart from gnuplot: instructions, which do not depend on the load of the machine, and times
report_apart_from_gnuplot() {
  tools/measure_report.sh >"$logs/measure_report.txt" || return 1
  cat "$logs/measure_report.txt"
  sed -n 's/^million/remark: million/p' "$logs/measure_report.txt"
}

# Every sentence of a report on a number, computed again from the tables that it names, for every deck of the library
reports_say_what_is_so() {
  local decks
  mapfile -t decks < <(grep -l '^&model' input/*/*.nml)
  python3 tests/support/check_said.py build/release/bin/elastokin "${decks[@]}"
}

# Every JSON that the program writes fits its schema in schema/, and a file with a mistake does not
json_fits_the_schemas() {
  local tools=$logs/venv_json folder=$logs/json program=$top/build/release/bin/elastokin axle=input/mcpherson_axle/mcpherson_axle.nml
  if ! "$tools/bin/python" -c 'import jsonschema' 2>/dev/null; then
    if ! python3 -m venv "$tools" || ! "$tools/bin/pip" install --quiet jsonschema; then
      skip "jsonschema could not be installed from PyPI"
      return
    fi
  fi
  rm -rf "$folder"
  mkdir -p "$folder/out"
  for deck in input/mcpherson/mcpherson.nml "$axle" input/twist_beam_axle/twist_beam_axle.nml; do
    "$program" report "$deck" --no-plots --quiet --out "$folder/$(basename "$deck" .nml)" || return 1
  done
  "$program" report "$axle" --no-plots --quiet --live 5 --out "$folder/live" || return 1
  "$program" run "$axle" --json --quiet --out "$folder/out" || return 1
  "$program" run tests/decks/run_tie_rod.nml --json --quiet --out "$folder/out"     # states that are lost
  [ -s "$folder/out/mcpherson_axle_run.json" ] || return 1
  "$program" check tests/decks/bad_many.nml --json >"$folder/check.json" 2>/dev/null      # errors of a deck
  "$program" check "$axle" --json --set spring.coil.rate=30000 >"$folder/out/axle_check.json" || return 1
  "$program" explain "$axle" --json --quiet --case parallel_travel --increments 4 --out "$folder/out" >"$folder/explained" || return 1
  "$program" loads tests/decks/truss_corner_loads.nml --json --quiet --out "$folder/out" >"$folder/listed" || return 1
  "$program-bench" "$axle" --increments 20 --json >"$folder/bench.json" && "$program-bench" --growth 200 --json >"$folder/growth.json" || return 1
  if "$program" --help | grep '^  export ' >/dev/null; then
    "$program" export "$axle" --to matlab-kc --out "$folder/export" && "$program" export "$axle" --to csv --out "$folder/export" || return 1
  fi
  "$program" list "$axle" --json >"$folder/list.json" && "$program" list tests/decks/every_dimension.nml --json >"$folder/out/every_list.json" || return 1
  printf 'WhlZ_FL,Toe_FL\nmm,min\n-10,3\n0,0\n10,-2\n' >"$folder/rig.csv"
  "$program" compare "$axle" --measured parallel_travel="$folder/rig.csv" --map examples/measured/fl_iso.nml --json --quiet \
    --out "$folder/compared" >"$folder/compare.json" || return 1
  "$program" list --definitions mathworks --json >"$folder/definitions.json" || return 1
  "$program" report input/mcpherson/mcpherson.nml --no-plots --quiet --definitions lotus --out "$folder/lotus" || return 1
  "$program" run "$axle" --json --quiet --definitions ipg --out "$folder/out/ipg" || return 1
  "$program" schema >"$folder/schema" && cmp "$folder/schema" schema/deck.schema.json || return 1
  "$tools/bin/python" tests/support/deck_as_data.py "$folder/decks" input/*/*.nml || return 1
  "$tools/bin/python" tests/support/check_json.py schema "$folder" || return 1
  "$tools/bin/python" tests/support/deck_schema_laws.py "$program" input/*/*.nml tests/decks/[!b]*.nml || return 1
  sed 's/"value": [^,]*/"value": "x"/' "$folder/mcpherson/key_numbers.json" >"$folder/key_numbers.json"
  ! "$tools/bin/python" tests/support/check_json.py schema "$folder"
}
