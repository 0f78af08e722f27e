# add_up.awk RESULTS LOG: adds up what ctest printed (RESULTS) and the summaries of the test programs,
# which it keeps in LastTest.log (LOG) also where they passed. Last line: `N passed, N failed`.

# 12/40 Test #12: test_measure ......   Passed    0.01 sec
FNR == NR && /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / {
  ran[$4] = 1
  if ($0 ~ /\*\*\*(Skipped|Not Run \(Disabled\))/) { delete ran[$4]; skipped++ }
  else if ($0 !~ / Passed +[0-9.]+ sec/) bad[$4] = 1
}
FNR == NR && /^ctest status / { ctest_status = $3 }
FNR == NR { next }

/^[0-9]+\/[0-9]+ Test: / { name = $3 }
/^<end of output>/ { name = "" }
name == "" { next }

# The stand-in: "test_measure: 12 passed, 0 failed, 1 skipped"
/^[A-Za-z0-9_]+: [0-9]+ passed, [0-9]+ failed/ {
  known[name] = 1; good_of[name] = $2; bad_of[name] = $4 + 0
  skipped_of[name] = $6 + 0
}
# pFUnit: " (12 tests, 1 disabled)", or "Tests run: 12, Failures: 1, Errors: 0, Disabled: 0"
/^ \([0-9]+ tests?(, [0-9]+ disabled)?\)$/ {
  known[name] = 1; good_of[name] = substr($1, 2) + 0; bad_of[name] = 0
  skipped_of[name] = $3 + 0
}
/^Tests run: [0-9]+, Failures: / {
  known[name] = 1; bad_of[name] = $5 + $7; good_of[name] = $3 - bad_of[name]
}
# ... which pFUnit 4.14 breaks after the errors
/, Disabled: [0-9]+$/ { skipped_of[name] = $NF }

END {
  for (name in ran) {
    if (!(name in known)) { if (name in bad) failed++; else passed++; continue }
    passed += good_of[name]
    failed += bad_of[name]
    skipped += skipped_of[name]
    # Ended badly after, or without regard to, a summary without failures.
    if ((name in bad) && bad_of[name] == 0) failed++
  }
  if (passed + failed == 0) print "no test ran"
  if (ctest_status != 0 && failed == 0) print "ctest ended with status " ctest_status
  if (skipped > 0) print skipped + 0 " skipped"
  print passed + 0 " passed, " failed + 0 " failed"
  exit (failed > 0 || passed == 0 || ctest_status != 0)
}
