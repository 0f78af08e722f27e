# difference.awk: difference between two sweeps at the same wheel stroke.
#
#     awk -v column=toe_deg -f difference.awk REFERENCE.csv OTHER.csv
#
# prints `stroke,difference` for every state of OTHER whose stroke REFERENCE covers; the reference is
# interpolated linearly between its two neighbouring states. The strokes of both files must increase.
BEGIN { FS = "," }
FNR == 1 { file++; is_head = 1 }
/^#/ { next }
is_head {
    for (k = 1; k <= NF; k++) place[$k] = k
    if (!("wheel_travel_mm" in place) || !(column in place)) {
        print "difference.awk: " FILENAME " has no column " column > "/dev/stderr"
        exit 1
    }
    x = place["wheel_travel_mm"]; y = place[column]
    is_head = 0
    next
}
file == 1 { n++; stroke[n] = $x + 0; value[n] = $y + 0; next }
$x + 0 >= stroke[1] && $x + 0 <= stroke[n] {
    if (at < 1) at = 1
    while (at < n - 1 && stroke[at + 1] < $x + 0) at++
    share = ($x - stroke[at]) / (stroke[at + 1] - stroke[at])
    printf "%.9g,%.9g\n", $x, $y - (value[at] + share * (value[at + 1] - value[at]))
}
