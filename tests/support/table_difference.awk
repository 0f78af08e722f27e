# awk -f table_difference.awk A.csv B.csv: largest difference of two tables of results: value, column, file
#
# Relative to the largest number of the column, which counts as at least 1 m, 1 kN or 1 kN m, or 1 of any other unit: forces in stiff
# bushings that carry nothing, or coordinates in the plane of symmetry, are zero but for rounding. Status 1 if the tables differ in shape
# or in text.
BEGIN { FS = ","; worst = 0; column = "-" }
/^#/ { next }
NR == FNR { lines[++count] = $0; next }
{
  row++
  if (split(lines[row], other, ",") != NF) { differs = 1; exit }
  for (k = 1; k <= NF; k++) {
    if (row == 1) { head[k] = $k; size[k] = $k ~ /_(mm|n|nm)$/ ? 1000 : 1 }
    if ($k == other[k]) continue
    if (row == 1 || tolower($k other[k]) ~ /[a-df-z]/) { differs = 1; exit }    # a heading, a text, or not a number
    gap = $k > other[k] ? $k - other[k] : other[k] - $k
    if (head[k] == "iterations" && gap <= 1) continue
    if (gap > gaps[k]) gaps[k] = gap
  }
  for (k = 1; k <= NF; k++) {
    value = $k < 0 ? -$k : $k + 0
    if (row > 1 && value > size[k]) size[k] = value
  }
}
END {
  if (differs || row != count) { print "shape or text differs in row " row " of " FILENAME; exit 1 }
  for (k in gaps) if (gaps[k] / size[k] > worst) { worst = gaps[k] / size[k]; column = head[k] }
  printf "%.1e %s %s\n", worst, column, FILENAME
}
