# key_numbers.awk: K&C metrics of the three sweeps at the same wheel strokes.
#
#     awk -f key_numbers.awk recursive/x.csv corrected/x.csv equilibrium/x.csv
#
# Between two states the values are interpolated linearly.
function at_stroke(column, stroke,    k) {
    for (k = 2; k < n && row[k, "wheel_travel_mm"] < stroke; k++) continue
    k--
    return row[k, column] + (row[k + 1, column] - row[k, column]) * (stroke - row[k, "wheel_travel_mm"]) / \
        (row[k + 1, "wheel_travel_mm"] - row[k, "wheel_travel_mm"])
}
function print_method(    k, line) {
    line = sprintf("%-12s", method)
    for (k = 1; k <= 9; k++) line = line sprintf(k % 3 == 1 ? "  %9.5f" : " %9.5f", value(k))
    print line
}
function value(k,    v) {
    v = at_stroke(k <= 3 ? "toe_deg" : k <= 6 ? "camber_deg" : "track_change_mm", stroke[(k - 1) % 3 + 1])
    return v > -5e-6 && v < 5e-6 ? 0 : v    # otherwise rounding noise would print as -0.00000
}
BEGIN {
    FS = ","
    split("-100 0 90", stroke, " ")
    print "McPherson strut, vertical load -3000 to 3000 N"
    printf "%-12s  %-29s  %-29s  %s\n", "", "toe [deg]", "camber [deg]", "lateral movement [mm]"
    printf "%-12s", "at stroke"
    for (k = 1; k <= 9; k++) printf(k % 3 == 1 ? "  %6d mm" : " %6d mm", stroke[(k - 1) % 3 + 1])
    print ""
}
FNR == 1 {
    if (NR > 1) print_method()
    is_headed = 0
    n = 0
    parts = split(FILENAME, part, "/")
    method = part[parts - 1]
}
/^#/ { next }
!is_headed { for (k = 1; k <= NF; k++) name[k] = $k; is_headed = 1; next }
{ n++; for (k = 1; k <= NF; k++) row[n, name[k]] = $k }
END { print_method() }
