#!/usr/bin/env bash
# check_layers.sh [FOLDER]: whether every `use` in FOLDER/src (default: this repository) points to its own layer or to one below.
#
# The layers and what they may use are the lines ek_layer(LAYER USES ...) of src/CMakeLists.txt and src/lanes/lanes.cmake; a module
# belongs to the layer whose folder it stands in, a copy ek_x_lanes of a kernel to lanes. Files outside the layers (main.f90, netcdf)
# may use everything. Two modules of one name are a mistake as well: their .mod files would be installed into one folder.
#
# A lock of ek_words that is not given back stops every other thread. So each `call begin_words()` must have its `call end_words()`
# in the same procedure and the same block, with no `return` between them, and no `cycle` or `exit` of a loop around both.
# Status 1 if something is wrong.
set -uo pipefail
cd "${1:-$(dirname "$0")/..}/src" || exit 1

find . -name '*.[fF]90' | sort | sed 's|^\./||' | awk -v tables='CMakeLists.txt lanes/lanes.cmake' '
  function mistake(at, what) {print "src/" file ":" at ": " what; wrong = 1}
  BEGIN {
    n = split(tables, files, " ")
    for (k = 1; k <= n; k++) while ((getline line < files[k]) > 0)
      if (match(line, /^ek_layer\([a-z]+/)) {
        layer = substr(line, 10, RLENGTH - 9)
        layers[layer]
        if (match(line, / USES [a-z ]+/)) {
          text = substr(line, RSTART + 6, RLENGTH - 6)
          sub(/ SOURCES.*/, "", text)
          m = split(text, part, " ")
          for (j = 1; j <= m; j++) may[layer, part[j]]
        }
      }
    # what stands below a layer below
    do {
      more = 0
      for (a in layers) for (b in layers) if ((a, b) in may) for (c in layers) if ((b, c) in may && !((a, c) in may)) {may[a, c]; more = 1}
    } while (more)
    for (a in layers) if ((a, a) in may) {print "layer " a " stands below itself"; wrong = 1}
    from["ek_page_assets"] = "pages"     # made by the build
    from["ek_library_decks"] = "commands"
    from["ek_build_facts"] = "top"
  }
  {
    layer = $0
    if (!sub(/\/.*/, "", layer) || !(layer in layers)) layer = "top"
    file = $0
    row = 0
    begun = 0
    while ((getline line < file) > 0) {
      row++
      line = tolower(line)
      bare = line
      gsub(/\047[^\047]*\047|"[^"]*"/, "", bare)
      sub(/!.*/, "", bare)
      if (bare ~ /call +(begin|end)_words/) n_words++
      if (bare ~ /call +begin_words/) {
        if (begun) mistake(begun, "begin_words is called again at line " row " before end_words")
        if (bare !~ /^ *call/) mistake(row, "begin_words is called on a condition")
        begun = row
        loops = 0
        column = index(bare, "call")
      } else if (bare ~ /call +end_words/) {
        if (!begun) mistake(row, "end_words is called without begin_words")
        else if (bare !~ /^ *call/ || index(bare, "call") != column) mistake(row, "end_words is not in the block of begin_words, line " begun)
        begun = 0
      } else if (begun) {
        if (bare ~ /^ *([a-z_0-9]+ *: *)?do( |$)/) loops++
        if (bare ~ /^ *end *do/) loops--
        if (bare ~ /(^|[ );])(return|stop|error +stop)( |$)/) mistake(row, "leaves the procedure between begin_words, line " begun ", and end_words")
        if (bare ~ /(^|[ );])(cycle|exit)( |$)/ && loops == 0) mistake(row, "leaves the loop between begin_words, line " begun ", and end_words")
        if (bare ~ /^ *(end +(subroutine|function)|contains)/) {mistake(begun, "begin_words has no end_words"); begun = 0}
      }
      if (match(line, /^ *module +ek_[a-z0-9_]+ *(!.*)?$/)) {
        split(line, part, " ")
        if (part[2] in place) {print "src/" file ":" row ": module " part[2] " stands in src/" place[part[2]] " too"; wrong = 1}
        place[part[2]] = file
        from[part[2]] = layer
      } else if (match(line, /^ *use *(, *(non_)?intrinsic)?( *:: *| +)ek_[a-z0-9_]+/)) {
        used = substr(line, RSTART, RLENGTH)
        sub(/.*[ :]/, "", used)
        uses[++n_uses] = layer " " used " " file ":" row
      }
    }
    close(file)
  }
  END {
    for (k = 1; k <= n_uses; k++) {
      split(uses[k], u, " ")
      kernel = u[2]
      target = from[u[2]]
      if (target == "" && sub(/_lanes$/, "", kernel) && kernel in from) target = "lanes"
      if (target == "") {print "src/" u[3] ": there is no module " u[2]; wrong = 1}
      else if (u[1] != "top" && target != u[1] && !((u[1], target) in may)) {
        print "src/" u[3] ": layer " u[1] " may not use " u[2] " of layer " target
        wrong = 1
      }
    }
    if (n_uses < 100) {print "only " n_uses " use statements"; wrong = 1}
    if (n_words < 20) {print "only " n_words + 0 " calls of begin_words and end_words"; wrong = 1}
    print "check_layers: " n_uses " use statements" (wrong ? "" : ", all point downwards") ", " n_words " calls of begin_words and end_words"
    exit wrong
  }'
