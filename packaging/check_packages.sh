#!/usr/bin/env bash
# check_packages.sh [BUILD]: makes the packages of a build folder (default build/release) and tries them on a fresh machine.
#
# The machine is a minimal Debian or Ubuntu of the same release in a temporary folder, entered by chroot: `dpkg -i` and the packages
# it depends on, `elastokin --version`, the man pages, a deck of the library, a user without rights; then the package is purged and
# nothing of it may be left, and the program of the tarball runs. Requires root with the right to mount, mmdebstrap or debootstrap,
# and the network; status 77 where one of these is missing.
# shellcheck disable=SC1091,SC2016     # /etc/os-release; expanded inside
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "${1:-build/release}")

skip() { echo "skipped: $1"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip 'root is required for chroot'
command -v dpkg-deb >/dev/null || skip 'this system has no Debian packages'
make_root=$(command -v mmdebstrap || command -v debootstrap) || skip 'neither mmdebstrap nor debootstrap is installed'
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
components=main
if [ "$(. /etc/os-release && echo "$ID")" = ubuntu ]; then components=main,universe; fi

work=$(mktemp -d)
root=$work/root
end() { umount -l "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$work"; }
trap end EXIT
fail() { echo "check_packages: $1" >&2; exit 1; }

# The program of the build runs here: a LAPACK that no package has would fail below
rm -rf "$build/packages"
cmake --build "$build" --target packages >"$work/packages.log" 2>&1 || { cat "$work/packages.log"; fail 'no packages'; }
version=$(sed -n 's/^project(elastokin VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
packages=("$build"/packages/elastokin_"$version"-*.deb)
for name in elastokin-mpi elastokin-netcdf libelastokin0; do
  for file in "$build"/packages/"$name"_"$version"-*.deb; do [ -f "$file" ] && packages+=("$file"); done
done
tarball=$(ls "$build"/packages/elastokin-"$version"-*.tar.gz)
for file in "${packages[@]}"; do dpkg-deb --info "$file" | sed -n 's/^ \(Package\|Depends\)/\1/p'; done
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error --suppress-tags initial-upload-closes-no-bugs "${packages[@]}"
fi

if ! case $make_root in
  */mmdebstrap) mmdebstrap --quiet --variant=minbase --components="$components" "$suite" "$root" >"$work/root.log" 2>&1 ;;
  *) debootstrap --variant=minbase --components="$components" "$suite" "$root" >"$work/root.log" 2>&1 ;;
esac; then
  tail -n 20 "$work/root.log"
  skip 'a fresh system could not be made'
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
# as on any machine: the loader takes from /proc where a program lies, and its private library beside it
mount -t proc proc "$root/proc" 2>/dev/null || mount --bind /proc "$root/proc" || skip '/proc cannot be mounted'
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
apt() { inside apt-get -qq -o Acquire::Check-Valid-Until=false --no-install-recommends "$@" >"$work/apt.log" 2>&1 || { cat "$work/apt.log"; fail "apt-get $*"; }; }
apt update
apt install -y man-db

# dpkg alone unpacks it and says what is missing; apt adds that
mkdir "$root/packages"
cp "${packages[@]}" "$tarball" "$root/packages"
inside sh -c 'dpkg -i /packages/*.deb' >"$work/dpkg.log" 2>&1 || echo 'dpkg -i: dependencies are missing, as on any fresh machine'
apt install -y -f
for file in "${packages[@]}"; do
  name=$(dpkg-deb --field "$file" Package)
  inside dpkg-query -W -f '${Status}\n' "$name" | grep -qx 'install ok installed' || { cat "$work/dpkg.log"; fail "$name is not installed"; }
done
# what the others need is there; these are only resolved, not installed
for file in "$build"/packages/elastokin-dev_"$version"-*.deb; do
  [ -f "$file" ] || continue
  cp "$file" "$root/packages"
  apt install -s "/packages/$(basename "$file")"
done

inside elastokin --version | tee "$work/version"
[ "$(head -n 1 "$work/version")" = "elastokin $version" ] || fail 'another version'
grep -q '^LAPACK  *[^ ]' "$work/version" || fail 'no LAPACK'
# the instruction set of packs is that of the program in the build folder: its private library came along, in all copies
has_same_packs() { [ "$(sed -n 's/^packs  *//p' "$1")" = "$("$build/bin/elastokin" --version | sed -n 's/^packs  *//p')" ]; }
has_same_packs "$work/version" || fail 'packs run on other instructions than in the build folder'
for page in elastokin $(inside elastokin --help | sed -n 's/^  \([a-z]*\) .*/elastokin-\1/p'); do
  inside env MANWIDTH=100 man "$page" >"$work/page" 2>"$work/page.log" || { cat "$work/page.log"; fail "man $page"; }
  [ ! -s "$work/page.log" ] || { cat "$work/page.log"; fail "man $page has warnings"; }
  [ "$(wc -l <"$work/page")" -gt 15 ] || { cat "$work/page"; fail "man $page is short"; }
done
inside sh -c 'cd /tmp && chroot --userspec=nobody / elastokin run /usr/share/elastokin/input/mcpherson/mcpherson.nml --increments 20 --out /tmp/results'
[ "$(grep -vc '^#' "$root/tmp/results/mcpherson_vertical_sweep.csv")" -eq 22 ] || fail 'no results'
for file in bash-completion/completions/elastokin zsh/vendor-completions/_elastokin fish/vendor_completions.d/elastokin.fish; do
  [ -s "$root/usr/share/$file" ] || fail "no $file"
done

# purged: no file of it is left, nor a folder of its name
names=()
for file in "${packages[@]}"; do names+=("$(dpkg-deb --field "$file" Package)"); done
inside dpkg -L "${names[@]}" | sort -u >"$work/files"
inside dpkg -P "${names[@]}" >"$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log"; fail 'dpkg -P'; }
while read -r file; do
  if [ -f "$root$file" ] || [[ -e $root$file && $file == *elastokin* ]]; then fail "$file is left"; fi
done <"$work/files"
left=$(find "$root" -xdev -name '*elastokin*' -not -path "$root/packages/*" -not -path "$root/tmp/*")
[ -z "$left" ] || fail "left: $left"

# the tarball, below any folder
mkdir "$root/opt/elastokin"
tar -xzf "$tarball" -C "$root/opt/elastokin" --strip-components=1
inside /opt/elastokin/bin/elastokin --version >"$work/version"
[ "$(head -n 1 "$work/version")" = "elastokin $version" ] || fail 'the program of the tarball'
has_same_packs "$work/version" || fail 'packs of the tarball run on other instructions than in the build folder'
inside /opt/elastokin/bin/elastokin check /opt/elastokin/share/elastokin/input/mcpherson_axle/mcpherson_axle.nml >/dev/null
inside env MANPATH=/opt/elastokin/share/man man elastokin >"$work/page"
[ -s "$work/page" ] || fail 'the man page of the tarball'
echo "packages: $(cd "$build/packages" && echo *)"
