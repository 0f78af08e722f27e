#!/usr/bin/env bash
# tools/check_page.sh PAGE.html...: opens each page in headless Chromium. Status 1 when a page writes to the console,
# asks for anything but itself, holds a script, or has an id twice.
set -uo pipefail

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "no Chromium here (Debian: apt-get install chromium)" >&2
  exit 1
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
wrong=0

for page in "$@"; do
  path=$(realpath "$page")
  "$browser" --headless --no-sandbox --disable-gpu --disable-background-networking --disable-component-update \
    --no-first-run --user-data-dir="$work/profile" --enable-logging=stderr --log-net-log="$work/net.json" \
    --net-log-capture-mode=Default --dump-dom "file://$path" >"$work/dom.html" 2>"$work/log.txt"
  bad=
  grep -q '</html>' "$work/dom.html" || bad+=" it did not open;"
  grep -q 'CONSOLE' "$work/log.txt" && bad+=" $(grep -o 'CONSOLE.*' "$work/log.txt" | head -3);"
  # every request is in the log; those of the page (not the browser's own) stand under its file:// key
  requests=$(grep -oE '"network_isolation_key":"file:.{0,400}"url":"[^"]*"' "$work/net.json" | grep -oE '"url":"[^"]*"' |
    grep -E '"(https?|wss?|ftp)://' | sort -u)
  [ -n "$requests" ] && bad+=" it asks for $requests;"
  grep -qi '<script' "$work/dom.html" && bad+=" it holds a script;"
  twice=$(grep -oE " id=[\"'][^\"']*" "$work/dom.html" | sort | uniq -d | head -3)
  [ -n "$twice" ] && bad+=" ids are there twice:$twice;"
  if [ -n "$bad" ]; then
    echo "$page:$bad"
    wrong=1
  else
    echo "$page: opens, nothing on the console, no request"
  fi
done
exit $wrong
