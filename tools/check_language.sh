#!/usr/bin/env bash
# check_language.sh [FILE...]: finds wording that a native English-speaking engineer would not use, and prints
# file:line, the wording, and the wording to use instead. Status 1 if it finds any.
#
# Without arguments it checks every tracked document, and the decks, studies, scripts and sources outside tests/. In Fortran it
# checks comments and strings only, not identifiers. It does not see wording that is split over two lines. A line may
# contain the phrases of `allowed` below; each has a reason.
#
# Without arguments it also checks
#   - the pages in `pages`: lines up to 120 characters, sentences up to 35 words and with at most one colon or semicolon,
#   - the docstrings of subroutines in src: the first word is a verb of the list `verbs`,
#   - the names of tests: none contains told or tells.
# A page that has been revised is added to `pages`, so that it stays revised.
set -uo pipefail
top=$(cd "$(dirname "$0")/.." && pwd) || exit 1
export LC_ALL=C.UTF-8

# pattern (Perl regular expression, any case, whole words)  =>  wording to use
wording() {
  cat <<'END'
(?:one|rows?|points?|curves?|lines?|files?|once|times?|factorisations?|increments?|units?|values?|records?|groups?|keys?|loads?|arms?|links?|wheels?|bodies|body|results?|tests?|designs?|states?|cost) an? (?:state|revolution|design|side|case|increment|row|line|thing|wheel|joint|group|second|deck|column|test|unit)  =>  per …
a revolution  =>  per revolution
(?:namelist )?group a thing  =>  one group per item
(?:the|a|each|this|that|its) place(?! of)  =>  swept value (of a case), point, position
(?:of|at|for|over|from|between|nearest) places?  =>  swept value (of a case), point, position
words  =>  message, label, text, heading: the one that is meant
told|tells?  =>  reported, print, given
says less|no words but  =>  suppress informational messages
lai?d over (?:each other|one another)|lays? .{0,60}over each other  =>  overlaid, overlay
lost states?|states? (?:is|are|was|were) lost|loses? (?:a )?states?|equilibrium is lost|went wrong|goes wrong  =>  did not converge, failed
mend(?:s|ed|ing)?  =>  fixed
(?:most|least)_[a-z]\w*  =>  max_…, min_…
(?:a|one|each|every|per|the) looks?|look-?outs?  =>  evaluation
(?:a|one|each|every) view  =>  evaluation
relative_turns?|relative turns?  =>  relative_rotation
sway  =>  load_response
courses?  =>  actuation
demands?  =>  inputs, requires
relief  =>  homotopy
(?:a|the|its|their) pulls?  =>  generalised force
(?:a|the|its|their) push  =>  generalised force, scatter
(?:wheel|wheel's|the) lift (?:of|at|on) (?:a|the|each|both) wheels?|wheel lifts?  =>  vertical_force
drafts?  =>  reading
subjects?(?! to)  =>  (name the item)
twins?  =>  side
complaints?|complains?  =>  deck error, message
roll inclination  =>  camber relative to road in roll
copy the one that is nearest  =>  start from the closest one
(?:and )?said to be so  =>  and marked as such
\| of its own \|  =>  characteristic figure
(?:whatever|which) the deck (?:speaks|has)|deck speaks  =>  regardless of the deck's units
and (?:its|their) kin  =>  anti-dive, anti-lift, anti-squat
dampers' velocity|rubber are not there|axes do not couple  =>  statics only: no damping forces; no friction, free play or hysteresis; bushing axes are uncoupled
never asks? what|have come to  =>  never re-evaluates … in the new configuration
capitals do not matter  =>  keywords are case-insensitive, names are not
say there where  =>  use it to record the source
resists with  =>  gives the restoring force
comes? gently|half behind  =>  smooth transition, centred on …
what the rig (?:does|brings)  =>  the rig's loads
jumped over|is not met|met nowhere  =>  does not count as a solution; no solution
a patch floats|no moment acts there but  =>  the contact patch floats: the only horizontal forces and moments on it are …
gives? way  =>  moves with the force, deflects, counts as carried by a constant force
the other sign  =>  the opposite sign, changes sign
who sums up|has it so  =>  to sum moments … use …, as the solver does
rates are theirs|nothing but bushings  =>  the wheels are carried by … alone
as told above  =>  see above
joints? (?:that are|are|is) open|how far the joints are from closed|furthest from closing  =>  violates the joint constraints, residual of the joint constraints
run past what  =>  has left the range that the suspension can reach
needs a folder, and|and --out - is none  =>  --plot needs an output folder and cannot be used with --out -
begins at the end that is studied|take the other  =>  case has no range towards end = '…'; set end = '…'
there is no use for  =>  unknown …
(?:was|were) not found;  =>  no equilibrium at …; the last one was at …
page tells where  =>  see the warnings at the top of the report
hold the same|more than once; remove or weaken  =>  over-constrain one direction; replace one by a weaker type
\(and '+curve'+ as well\)  =>  give 'rate' or 'curve'
not ended by  =>  not terminated by
to be read with care  =>  warnings
ackermann at most|circle, least|largest steer to the  =>  maximum Ackermann; minimum turning circle; maximum steer
to the own side|own side  =>  inner wheel, wheel's own …
can say what is at  =>  are fit for extrapolation
heads? of (?:a |the |its )?columns?|column heads?  =>  column heading
goes? on  =>  continues; run the same command again to resume
an own  =>  a … of its own, a separate …
steer axis|steer axes  =>  steering axis
parallel \(in phase\)|opposed \(anti[ -]phase\)  =>  in phase, anti-phase (of loads); parallel and opposite are travel
whole numbers?  =>  integer
(?<!there )are no|(?<!there )is none  =>  negate the verb: are not …, cannot be used as …, there is no …
END
}

# what is never right where a user reads: in the documents of users (without code), the strings of the program and the page of a report
user_wording() {
  cat <<'END'
(?:contact|the|each|both) patch|patches|patch (?:moves|held)  =>  contact point
caster trail(?! change)  =>  mechanical trail
spindle (?:length|offset)  =>  kingpin offset, caster offset at the wheel centre
steer-axis  =>  steering axis
mistakes?|troubles?  =>  error (of a deck), deviation (of numbers)
refus(?:e|es|ed|al|ing)  =>  reject, not supported
left out|leaves? out  =>  omit
the turntable  =>  3-D view
folded|unfold(?:ed)?  =>  collapsed, expanded
key numbers?  =>  K&C metric
numbers? of (?:the|a) deck|deck values?  =>  parameter
(?:load|height|heights|forces?|heave|centres) held|held heights?|driven (?:value|height)s?  =>  constant, prescribed
packs?|lanes?  =>  SIMD batch
END
}

# phrases that may stay  =>  reason
allowed() {
  cat <<'END'
takes? (?:the|its) place of  =>  ordinary English: replaces
of course  =>  ordinary English
in other words  =>  ordinary English
looks? like  =>  a remark names the likely cause
anti[- ]lift|drive lift|brake lift  =>  names of quantities
sway bar  =>  the glossary: American for anti-roll bar
wheel lift in steer  =>  name of a quantity
contact patch is a point  =>  of the tyre
patch, contact patch, wheel contact point  =>  find a term: names elsewhere
hub offset, spindle length  =>  find a term: names elsewhere
spindle length and spindle offset with two meanings  =>  names elsewhere
caster trail(?:, caster offset| \(80000030\))  =>  names elsewhere
keywords?  =>  not the word list
MemTotal  =>  a name of Linux
json-schema.org/draft  =>  an address
`relative_rotation`  =>  name of a procedure
END
}

pages() {
  cat <<'END'
input/README.md
input/RIG.md
input/STUDIES.md
input/QUANTITIES.md
input/NAMES.md
CONTRIBUTING.md
docs/compilers.md
docs/extending.md
docs/tour.md
END
}

# the first words of docstrings of subroutines; add a verb that is missing
verbs() {
  cat <<'END'
Abandons Accepts Adapts Adds Allocates Appends Applies Assembles Attaches Balances Begins Builds Changes Checks
Chooses Clears Clips Closes Collects Compares Completes Computes Continues Converts Copies Corrects Counts Creates
Decides Decodes Decomposes Defines Deletes Describes Determines Diagnoses Differentiates Divides Does Draws Drops
Duplicates Eliminates Empties Encodes Ends Escapes Estimates Evaluates Examines Exchanges Expands Explains Extracts
Extrapolates Factorises Fills Finds Finishes Fits Follows Forgets Formats Frees Gathers Gives Handles Hands Hides
Includes Increases Inserts Interpolates Inverts Iterates Joins Judges Lays Learns Leaves Links Lists Loads Locks Logs
Looks Makes Maps Marks Measures Merges Mirrors Mounts Moves Multiplies Names Normalises Notes Observes Opens Orders
Packs Pads Parses Passes Places Plans Predicts Prepares Prints Puts Quotes Reads Realises Recalls Records Reduces
Reflects Registers Rejects Removes Renames Renews Replaces Reports Reserves Resets Restores Restricts Returns Reverses
Rotates Rounds Runs Saves Scales Scans Scrambles Searches Selects Sends Sets Settles Shares Shows Skips Solves Sorts
Splits Starts States Steps Stops Stores Subtracts Sums Swaps Sweeps Takes Times Transforms Tries Trims Truncates Turns
Unpacks Updates Uses Validates Verifies Waits Walks Warns Watches Works Wraps Writes
END
}

documents() {
  git -C "$top" ls-files -z -- '*.md' CITATION.cff input studies tools .ci src ':!:tests/decks' |
    while IFS= read -r -d '' file; do
      case $file in
        *.png | tools/check_language.sh) ;;     # this list names what it forbids
        src/vocabulary/ek_definition_rows.f90 | input/NAMES.md) ;;     # names in other programs
        *) printf '%s\0' "$top/$file" ;;
      esac
    done
}

# The text that people read: in Fortran comments and strings, on their lines; other files whole
prose() {
  case $1 in
    *.f90 | *.F90 | *.pf)
      awk -v q="'" '{
        out = ""; open = ""; n = length($0)
        for (k = 1; k <= n; k++) {
          c = substr($0, k, 1)
          if (open != "") { if (c == open) { open = ""; out = out "\"" } else out = out c }
          else if (c == q || c == "\"") { open = c; out = out "\"" }
          else if (c == "!") { out = out substr($0, k); break }
        }
        print out
      }' "$1"
      ;;
    *) cat "$1" ;;
  esac
}

work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
if [ $# -gt 0 ]; then printf '%s\0' "$@"; else documents; fi >"$work/files"
stay=$(allowed | sed 's/  =>  .*//' | paste -s -d '|')

# every line of prose as FILE:LINE:text
while IFS= read -r -d '' file; do
  [ -f "$file" ] || { echo "check_language: no file $file" >&2; exit 1; }
  name=${file#"$top"/}
  prose "$file" | awk -v name="$name" '{print name ":" FNR ":" $0}'
done <"$work/files" >"$work/lines" || exit 1

# Lines of the file LINES that contain a pattern of LIST
find_words() { # find_words LIST LINES
  STAY=$stay perl -CSDA -Mutf8 -e '
    use strict; use warnings;
    my ($list, $lines) = @ARGV;
    my (@pattern, @use, $found);
    open(my $in, "<", $list) or die;
    while (<$in>) { chomp; my ($p, $u) = split /  =>  /, $_, 2; push @pattern, qr/(?<!\w)(?:$p)(?!\w)/i; push @use, $u; }
    my $stay = $ENV{STAY}; utf8::decode($stay) unless utf8::is_utf8($stay); $stay = qr/$stay/i;
    open($in, "<", $lines) or die;
    while (<$in>) {
      chomp;
      my ($where, $text) = /^([^:]*:\d+):(.*)$/ or next;
      $text =~ s/$stay/~/g;
      for my $k (0 .. $#pattern) {
        while ($text =~ /$pattern[$k]/g) { print "$where: \"$&\": use: $use[$k]\n"; $found++; }
      }
    }
    exit($found ? 1 : 0);
  ' "$@"
}

# What users read, as FILE:LINE:text: documents without code, strings of more than a word in Fortran, the text of a report page
user_lines() {
  git -C "$top" ls-files -- '*.md' ':!:docs/theory' ':!:docs/compilers.md' ':!:docs/extending.md' ':!:docs/tour.md' ':!:CONTRIBUTING.md' \
    ':!:packaging' ':!:tests' ':!:input/NAMES.md' | while IFS= read -r file; do
    # the last two words of a line are read again with the first two of the next, so that wording that is split is found
    awk -v name="$file" '/^```/ {code = !code; next} code || /^    / {next} {gsub(/`[^`]*`/, ""); print name ":" FNR ":" $0}
      NF == 0 || /^[|#]/ {end = ""; next} end != "" && !/^ *[-*] / {print name ":" FNR ":" end " " $1 " " $2}
      {end = $(NF > 1 ? NF - 1 : NF) (NF > 1 ? " " $NF : "")}' "$top/$file"
  done
  git -C "$top" ls-files -- 'src/*.f90' 'src/*.F90' ':!:src/vocabulary/ek_definition_rows.f90' | while IFS= read -r file; do
    awk -v q="'" -v name="$file" '{
      out = ""; part = ""; open = ""; n = length($0)
      for (k = 1; k <= n; k++) {
        c = substr($0, k, 1)
        if (open != "") { if (c == open) { open = ""; if (part ~ / [^ ]/) out = out " | " part; part = "" } else part = part c }
        else if (c == q || c == "\"") open = c
        else if (c == "!") break
      }
      if (out != "") print name ":" FNR ":" out
    }' "$top/$file"
  done
  local program=$top/build/release/bin/elastokin
  if [ -x "$program" ] && "$program" report "$top/input/mcpherson_axle/mcpherson_axle.nml" --quiet --no-plots --out "$work/report" >"$work/report.txt" 2>&1; then
    perl -CSDA -0777 -ne 's{<(script|style)\b.*?</\1>}{}gs; s{<code>.*?</code>}{}gs; s{<[^>]*>}{\n}g; my $n = 0;
      for (split /\n/) { $n++; print "page of a report:$n:$_\n" if /\S/ }' "$work/report/report.html"
  else
    echo "check_language: remark: no program in build/release, so no page of a report was read" >&2
  fi
}

status=0
find_words <(wording) "$work/lines" || status=1
if [ $# -eq 0 ]; then
  user_lines >"$work/user" || exit 1
  find_words <(user_wording) "$work/user" || status=1
fi

# Sentences of the pages in FILE...: code and tables of names are skipped, cells of tables may be terse
sentences() {
  perl -CSDA -Mutf8 -e '
    use strict; use warnings;
    my $found = 0;
    sub judge {
      my ($where, $text) = @_;
      $text =~ s/`+[^`]*`+/X/g;
      $text =~ s/\]\([^)]*\)/]/g;
      for my $sentence (split /(?<=[.!?])\s+(?=[\p{Lu}\p{Greek}*`\[(])/, $text) {
        my $words = () = $sentence =~ /\S+/g;
        my $colons = () = $sentence =~ /[:;](?=\s|$)/g;
        if ($words > 35) { print "$where: $words words in a sentence, at most 35: \"", substr($sentence, 0, 60), "\"\n"; $found++; }
        if ($colons > 1) { print "$where: $colons colons in a sentence, at most 1: \"", substr($sentence, 0, 60), "\"\n"; $found++; }
      }
    }
    for my $file (@ARGV) {
      open(my $in, "<", $file) or die "$file: $!\n";
      my ($text, $where, $is_code) = ("", "", 0);
      my $end = sub { judge($where, $text) if $text ne ""; $text = ""; };
      while (my $line = <$in>) {
        chomp $line;
        if (length($line) > 120) { print "$file:$.: ", length($line), " characters in a line, at most 120\n"; $found++; }
        if ($line =~ /^```/) { $is_code = !$is_code; $end->(); next; }
        if ($is_code or $line =~ /^(?:#|\||\s*$)/) { $end->(); next; }
        my $is_item = $line =~ /^\s*(?:[-*]|\d+\.) /;
        $end->() if $is_item;
        next if $text eq "" and $line =~ /^    / and !$is_item;      # an indented block after an empty line
        $where = "$file:$." if $text eq "";
        $text .= " $line";
      }
      $end->();
    }
    exit($found ? 1 : 0);
  ' "$@"
}

# The first word of the docstring above every subroutine in FILE...
docstrings() {
  VERBS=$(verbs | paste -s -d ' ') perl -CSDA -Mutf8 -e '
    use strict; use warnings;
    my %is_verb = map { $_ => 1 } split / /, $ENV{VERBS};
    my $found = 0;
    for my $file (@ARGV) {
      open(my $in, "<", $file) or die "$file: $!\n";
      my ($first, $where) = ("", 0);
      while (my $line = <$in>) {
        if ($line =~ /^\s*!>/) { ($first, $where) = ($line =~ /^\s*!>\s*(\S*)/, $.) if !$where; next; }
        if ($line =~ /^\s*(?:(?:pure|impure|elemental|recursive|module|non_recursive)\s+)*subroutine\s+(\w+)/i and $where) {
          (my $word = $first) =~ s/[.,:;]+$//;
          if (!$is_verb{$word}) { print "$file:$where: docstring of subroutine $1 begins with \"$word\": use: a verb (list `verbs`)\n"; $found++; }
        }
        ($first, $where) = ("", 0) unless $line =~ /^\s*(?:!\$|!GCC\$)/;
      }
    }
    exit($found ? 1 : 0);
  ' "$@"
}

if [ $# -eq 0 ]; then
  cd "$top" || exit 1
  mapfile -t page < <(pages)
  sentences "${page[@]}" || status=1
  mapfile -t source < <(git ls-files -- 'src/*.f90' 'src/*.F90' 'tools/bench/*.f90')
  docstrings "${source[@]}" || status=1
  if git grep -nEi 'subroutine +([a-z0-9_]*_)?(told|tells?)(_[a-z0-9_]*)?\(' -- 'tests/*.pf' | grep -v 'end subroutine'; then
    echo 'the names of tests: use: is_reported, prints, lists, gives'
    status=1
  fi
fi
[ $status -eq 0 ] && echo "check_language: $(tr -cd '\0' <"$work/files" | wc -c) files, nothing found"
exit $status
