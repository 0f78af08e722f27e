#!/usr/bin/env bash
# check_page.sh PAGE.html...: opens each page in headless Chromium, at desktop and at phone width. Status 1 if a
# page writes to the console, requests anything but itself, loads a script or has a duplicate id, or is wider than a phone.
#
# No network access: names are not resolved.
set -uo pipefail

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "no Chromium here (Debian: apt-get install chromium)" >&2
  exit 1
}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
wrong=0
phone=390     # CSS pixels across

# requests of a page, recognised by the traffic annotations of blink_resource_loader and navigation_url_loader; the
# browser itself uses others, for its updates and accounts
by_page='"traffic_annotation":(101845102|63171670),"url":"(https?|wss?|ftp)://[^"]*"'

load() { # load ADDRESS [OPTION...]: the loaded page on standard output; $work/log.txt, $work/net.json
  local address=$1
  shift
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-background-networking --disable-component-update \
    --disable-sync --disable-extensions --no-pings --no-first-run --host-resolver-rules='MAP * ~NOTFOUND' \
    --user-data-dir="$work/profile" --enable-logging=stderr --log-net-log="$work/net.json" \
    --net-log-capture-mode=Default --dump-dom "$@" "$address" 2>"$work/log.txt"
}

requests() { grep -oE "$by_page" "$work/net.json" | grep -oE '"url".*' | sort -u | head -5; }
console() { grep -o 'CONSOLE.*' "$work/log.txt" | head -3; }

# a page with forbidden requests: a browser that does not log them cannot be used here
cat >"$work/probe.html" <<'END'
<!DOCTYPE html><html><body><img src="http://image.invalid/x.png"><iframe src="http://frame.invalid/"></iframe>
<script>console.error('probe')</script></body></html>
END
load "file://$work/probe.html" >"$work/dom.html"
if [ "$(requests | wc -l)" -ne 2 ] || [ -z "$(console)" ]; then
  echo "this browser does not log the requests and console messages of a page: $("$browser" --version 2>/dev/null)" >&2
  requests >&2
  console >&2
  exit 1
fi

for page in "$@"; do
  path=$(realpath "$page")
  load "file://$path" >"$work/dom.html"
  bad=
  grep -q '</html>' "$work/dom.html" || bad+=" did not open;"
  said=$(console)
  [ -n "$said" ] && bad+=" $said;"
  asked=$(requests)
  [ -n "$asked" ] && bad+=" requests $asked;"
  grep -qi '<script[^>]* src' "$work/dom.html" && bad+=" loads a script;"
  twice=$(grep -oE " id=[\"'][^\"']*" "$work/dom.html" | sort | uniq -d | head -3)
  [ -n "$twice" ] && bad+=" duplicate ids:$twice;"

  cat >"$work/phone.html" <<END
<!DOCTYPE html><html><head><title>not loaded</title></head><body><iframe id="f" width="$phone" height="800" src="file://$path"></iframe>
<script>f.onload = () => { document.title = 'needs ' + f.contentDocument.documentElement.scrollWidth + ' pixels' }</script></body></html>
END
  load "file://$work/phone.html" --allow-file-access-from-files --virtual-time-budget=20000 >"$work/dom.html"
  needs=$(sed -n 's/.*<title>needs \([0-9]*\) pixels<.title>.*/\1/p' "$work/dom.html")
  if [ -z "$needs" ]; then
    bad+=" width on a phone could not be measured;"
  elif [ "$needs" -gt "$phone" ]; then
    bad+=" needs $needs pixels on a phone $phone pixels wide;"
  fi

  if [ -n "$bad" ]; then
    echo "$page:$bad"
    wrong=1
  else
    echo "$page: opens at desktop and phone width, no console message, no request"
  fi
done
exit $wrong
