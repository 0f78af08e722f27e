# shellcheck shell=bash disable=SC2154
# Checks of what is installed: libraries, man pages, packages, recipes.

# A project outside this folder finds and uses the installed library
installed_package() {
  rm -rf "$logs/consumer"
  cmake -S .ci/consumer -B "$logs/consumer" -DCMAKE_PREFIX_PATH="$logs/prefix" &&
    cmake --build "$logs/consumer" &&
    "$logs/consumer/consumer" input/mcpherson/mcpherson.nml | tee "$logs/consumer.txt" &&
    grep -q '^toe \[deg\] at both ends:   0\.46.*-0\.59' "$logs/consumer.txt" &&
    "$logs/prefix/bin/elastokin" --version | tee "$logs/version.txt" &&
    [ "$(grep '^packs' "$logs/version.txt")" = "$(build/release/bin/elastokin --version | grep '^packs')" ]
}

# Man pages without a warning, and completion as bash, zsh and fish offer it, as the build makes them from the tables of commands;
# installed in their folders
man_page_and_completions() {
  local status file
  tools/setup.sh mandoc groff-base zsh fish || { skip "not all of mandoc, groff, zsh and fish could be installed"; return; }
  tools/check_help_files.sh build/release/bin/elastokin
  status=$?
  [ $status -eq 77 ] && { skip "tools/check_help_files.sh: a tool is missing"; return; }
  rm -rf "$logs/help_prefix"
  cmake --install build/release --prefix "$logs/help_prefix" --component runtime || return 1
  for file in man/man1/elastokin.1 man/man1/elastokin-run.1 bash-completion/completions/elastokin zsh/site-functions/_elastokin \
    fish/vendor_completions.d/elastokin.fish; do
    [ -s "$logs/help_prefix/share/$file" ] || { echo "not installed: $file"; status=1; }
  done
  return $status
}

# cpack's packages on a fresh Debian: installed, used, purged; the tarball unpacked and used
debian_packages() {
  tools/setup.sh dpkg-dev file mmdebstrap || echo "no mmdebstrap"
  packaging/check_packages.sh build/release     # says why, with status 77, if it cannot run
}

# Dockerfile, Apptainer definition, Spack and conda recipes: built where that is possible, else linted
recipes_are_sound() {
  packaging/check_recipes.sh "$logs"     # says why, with status 77, if it cannot run
}

# The files of a release by the commands that the workflow runs for a tag; only the upload is left out
release() {
  local workflow=.github/workflows/release.yml command count=0
  git diff --quiet HEAD || { skip "files are changed, and a release is made of a commit"; return; }
  while read -r command; do
    echo "+ $command"
    bash -c "$command" || return 1
    count=$((count + 1))
  done < <(sed -n 's/^ *- run: //p' $workflow | grep -v '^apt-get \|^git config ')
  [ $count -eq 3 ] || { echo "$workflow has $count commands that could be tried, not 3"; return 1; }
  echo "remark: $(du -sh dist | cut -f 1) in $(find dist -type f | wc -l) files"
}
