# errors.awk: the rows of one method in a step-size study.
#
#     awk -v method=recursive -v column=toe_error_deg -f errors.awk step_size.csv | sort -t, -k1n
#
# prints `increments,size of the error`; an error of exactly zero cannot be drawn on a logarithmic axis and
# is omitted.
BEGIN { FS = "," }
/^#/ { next }
!is_headed {
    for (k = 1; k <= NF; k++) place[$k] = k
    if (!("method" in place) || !("increments" in place) || !(column in place)) {
        print "errors.awk: " FILENAME " has no column method, increments or " column > "/dev/stderr"
        exit 1
    }
    is_headed = 1
    next
}
$place["method"] == method {
    size = $place[column] + 0
    if (size < 0) size = -size
    if (size > 0) print $place["increments"] "," size
}
