#!/usr/bin/env bash
# check_theory.sh [--list] [FOLDER]: compares the equations of docs/theory with the comments of the code. Status 1 if they disagree.
#
# - Every equation has one \tag{X.n}, X the letter of its page, n from 1 without gaps, and a "Code of (X.n): …" line.
# - "`name` in `src/…/file.f90`" on such a line: this module, type or procedure exists in the file, and the comment above it
#   contains "Equation (X.n) of docs/theory/page.md" (or "Equations (X.n), (X.m) of …").
# - Every such reference in src is to an existing equation of this page, which names the procedure in return.
#
# --list prints equation, procedure and file. FOLDER: another copy of the repository (default: this one).
set -uo pipefail
list=0
if [ "${1:-}" = --list ]; then list=1; shift; fi
cd "${1:-$(dirname "$0")/..}" || exit 1

LIST=$list perl -e '
  use strict; use warnings;
  my (%page, %claimed, %named, $wrong);    # equation → page; "equation file name" from the pages, from the code
  sub wrong { print "$_[0]\n"; $wrong++ }
  my $number = qr/\([A-Z]\.\d+\)/;

  for my $file (glob "docs/theory/*.md") {
    open(my $in, "<", $file) or die; local $/; my $text = <$in>;
    my (%letter, %has_code, $last);
    while ($text =~ /\\tag\{([A-Z])\.(\d+)\}/g) {
      wrong("$file: ($1.$2) is used twice") if $page{"$1.$2"};
      wrong("$file: ($1.$2) after ($1." . ($last // 0) . ")") if $2 != ($last // 0) + 1;
      ($page{"$1.$2"}, $letter{$1}, $last) = ($file, 1, $2);
    }
    wrong("$file: equations with more than one letter") if keys %letter > 1;
    while ($text =~ /^Code of ((?:$number(?:, | and )?)+): (.*?)(?=\n\n|\nCode of |\z)/gms) {
      my ($of, $where) = ($1, $2);
      wrong("$file: no procedure after \"Code of $of\"") unless $where =~ /` in `/;
      for my $equation ($of =~ /\(([^)]+)\)/g) {
        wrong("$file: \"Code of ($equation)\": no such equation here") if ($page{$equation} // "") ne $file;
        $has_code{$equation} = 1;
        while ($where =~ /((?:`\w+`(?:,\s+|\s+and\s+)?)+)\s+in\s+`(src\/[\w\/]+\.[fF]90)`/g) {
          my $source = $2;
          $claimed{"$equation $source $_"} = 1 for $1 =~ /`(\w+)`/g;
        }
      }
    }
    for (grep { $page{$_} eq $file } keys %page) { wrong("$file: no \"Code of ($_): …\"") unless $has_code{$_} }
  }
  wrong("docs/theory: no equations") unless %page;

  # every number mentioned on any page exists, and so does every file
  for my $file (glob "docs/theory/*.md") {
    open(my $in, "<", $file) or die;
    while (<$in>) {
      for my $equation (/\(([A-Z]\.\d+)\)/g) { wrong("$file:$.: no equation ($equation)") unless $page{$equation} }
      for my $path (m{`((?:src|tests|tools|input|studies)/[\w/.]+)`}g) { wrong("$file:$.: no file $path") unless -e $path }
    }
  }

  for my $source (glob "src/*.f90 src/*/*.f90 src/*/*.F90 tools/bench/*.f90") {
    open(my $in, "<", $source) or die;
    my @above;                             # the comment so far: [line, text]
    while (my $line = <$in>) {
      if ($line =~ /^\s*!(.*)/) { push @above, [$., $1]; refer($source, $., $1); next }
      refer($source, $., $1) if $line =~ /!!(.*)/;
      if ($line =~ /^\s*(?!end\b)(?:[\w()]+\s+)*?(?:subroutine|function|module|type\s*::)\s+(\w+)/i) {
        my $name = lc $1;
        for my $text (map { $_->[1] } @above) {
          while ($text =~ /Equations? ((?:$number(?:, | and )?)+) of docs\/theory\/\w+\.md/g) {
            $named{"$_ $source $name"} = 1 for $1 =~ /\(([^)]+)\)/g;
          }
        }
        $main::exists{"$source $name"} = 1;
      }
      @above = ();
    }
  }

  # a reference in the code: complete, and to an equation of that page
  sub refer {
    my ($source, $at, $text) = @_;
    while ($text =~ /Equations? ((?:$number(?:, | and )?)+) of docs\/theory\/(\w+\.md)/g) {
      my $file = "docs/theory/$2";
      for my $equation ($1 =~ /\(([^)]+)\)/g) {
        wrong("$source:$at: there is no equation ($equation) in $file") if ($page{$equation} // "") ne $file;
      }
    }
    (my $rest = $text) =~ s/Equations? (?:$number(?:, | and )?)+ of docs\/theory\/\w+\.md//g;
    wrong("$source:$at: write $1 as \"Equation $1 of docs/theory/….md\", on one line") if $rest =~ /($number)/;
    wrong("$source:$at: a page of docs/theory without an equation") if $rest =~ /docs\/theory/;
  }

  for (sort keys %claimed) {
    my ($equation, $source, $name) = split / /;
    if (!$main::exists{"$source $name"}) { wrong("$page{$equation}: ($equation): $source has no $name") }
    elsif (!$named{$_}) { wrong("$source: the comment of $name does not refer to ($equation) of $page{$equation}") }
    print "($equation)  $name  $source\n" if $ENV{LIST} && $named{$_};
  }
  for (sort keys %named) {
    my ($equation, $source, $name) = split / /;
    wrong("$source: $name refers to ($equation), whose \"Code of\" does not list it") unless $claimed{$_};
  }
  exit 1 if $wrong;
  print "check_theory: " . keys(%page) . " equations, " . keys(%named) . " references in the code\n" unless $ENV{LIST};
'
