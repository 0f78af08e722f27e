# The paper's figures: toe, camber and lateral movement over the wheel stroke by all three methods,
# next to the exact equilibrium, and the error over the number of increments.
#
#     gnuplot plot.gp
#
# in this folder, after ./run.sh has made the results in out. For another folder of results: RESULTS=my/folder gnuplot plot.gp
results = system('printf %s "${RESULTS:-out}"')          # holds a folder for each method; the pictures go there as well
study = results.'/step_size/step_size.csv'
if (!exists('formats'))  formats = 'png svg'

reset
set encoding utf8
set datafile separator comma
set border 3 linecolor rgb '#808080'
set tics out nomirror textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set lmargin at screen 0.125; set rmargin at screen 0.965

# Okabe and Ito's colours, which colour-blind readers can distinguish. The exact solution is a broad band; the
# methods are drawn on top of it.
set style line 1 linecolor rgb '#56B4E9' linewidth 9
set style line 2 linecolor rgb '#202020' linewidth 2.4 dashtype (9, 6) pointtype 5 pointsize 1.3
set style line 3 linecolor rgb '#D55E00' linewidth 2.8 pointtype 7 pointsize 1.5
set style line 9 linetype 1 linecolor rgb '#909090' linewidth 1.2

# The largest magnitude of a range, in short form: 0.012 or 3·10⁻⁶.
largest(low, high) = high > -low ? high : -low
short(x) = x == 0 ? '0' : x >= 1e-3 ? sprintf('%.2g', x) : gprintf('%.0t·10⁻', x).raised(-int(gprintf('%T', x)))
raised(n) = (n > 9 ? raised(n/10) : '').word('⁰ ¹ ² ³ ⁴ ⁵ ⁶ ⁷ ⁸ ⁹', n % 10 + 1)

# A round step that divides a range into about four intervals.
step(range) = step_of(0.25*range, 10**floor(log10(0.25*range)))
step_of(size, power) = power*(size < 1.5*power ? 1 : size < 3.5*power ? 2 : size < 7.5*power ? 5 : 10)

# ---- three quantities over the wheel stroke ---------------------------------------------------

sweep(method) = sprintf("%s/%s/mcpherson_vertical_sweep.csv", results, method)
difference(method, column) = sprintf("< awk -v column=%s -f difference.awk '%s' '%s'", \
   column, sweep('equilibrium'), sweep(method))

files = 'toe camber lateral'
columns = 'toe_deg camber_deg track_change_mm'
units = 'deg deg mm'
array heading[3] = ['Toe over the wheel stroke', 'Camber over the wheel stroke', 'Lateral movement over the wheel stroke']
array axis[3] = ['toe [deg]   (+ front edge inward)', 'camber [deg]   (+ top outward)', \
   'contact point, lateral [mm]   (+ outward)']

set xtics 20
do for [k = 1:3] {
   column = word(columns, k)
   stats difference('recursive', column) using 2 name 'recursive' nooutput
   stats difference('corrected', column) using 2 name 'corrected' nooutput
   recursive_most = largest(recursive_min, recursive_max); corrected_most = largest(corrected_min, corrected_max)
   low = recursive_min < 0 ? recursive_min : 0; high = recursive_max > 0 ? recursive_max : 0

   do for [format in formats] {
      if (format eq 'png') { set terminal pngcairo size 1200, 1000 font 'sans-serif,15' }
      if (format eq 'svg') { set terminal svg size 1200, 1000 font 'sans-serif,15' background 'white' }
      if (format eq 'pdf') { set terminal pdfcairo size 24cm, 20cm font 'sans-serif,12' }
      set output sprintf('%s/%s.%s', results, word(files, k), format)
      set multiplot

      set label 1 heading[k] at screen 0.03, screen 0.967 \
         font 'sans-serif:Bold,21' textcolor rgb '#202020'
      set label 2 'McPherson strut under a vertical load at the contact point' at screen 0.03, screen 0.932 \
         font 'sans-serif,14' textcolor rgb '#606060'
      set key at screen 0.985, screen 0.985 right top vertical Left reverse samplen 4 width -1 spacing 1.05
      set tmargin at screen 0.895; set bmargin at screen 0.41
      set format x ''
      set ylabel axis[k]
      set xzeroaxis linestyle 9; set yzeroaxis linestyle 9
      set offsets 0, 0, graph 0.02, graph 0.02      # gnuplot cuts a line that ends just outside a tic
      plot sweep('equilibrium') using 'wheel_travel_mm':column with lines linestyle 1 title 'equilibrium (exact)', \
           sweep('recursive') using 'wheel_travel_mm':column with lines linestyle 3 title 'recursive (paper)', \
           sweep('corrected') using 'wheel_travel_mm':column with lines linestyle 2 title 'corrected'
      xlow = GPVAL_X_MIN; xhigh = GPVAL_X_MAX
      unset offsets

      unset label 1; unset label 2; unset key
      set label 3 'Difference at equal stroke; maximum:' at screen 0.125, screen 0.356 \
         font 'sans-serif:Bold,15' textcolor rgb '#202020'
      set label 4 sprintf('recursive %s %s', short(recursive_most), word(units, k)) at screen 0.775, screen 0.356 right \
         textcolor rgb '#B84F00'
      set label 5 sprintf('corrected %s %s', short(corrected_most), word(units, k)) at screen 0.965, screen 0.356 right \
         textcolor rgb '#202020'
      set tmargin at screen 0.33; set bmargin at screen 0.09
      set format x '%g'
      set xlabel 'wheel stroke [mm]   (+ bump, − rebound)'
      set ylabel sprintf('difference [%s]', word(units, k))
      unset xzeroaxis
      set xrange [xlow:xhigh]; set yrange [low - 0.12*(high - low) : high + 0.12*(high - low)]
      set ytics step(high - low)
      plot 0 with lines linestyle 1, \
           difference('recursive', column) using 1:2 with lines linestyle 3, \
           difference('corrected', column) using 1:2 with lines linestyle 2
      unset label; unset xlabel
      set xrange [*:*]; set yrange [*:*]; set ytics autofreq
      unset multiplot
      unset output
   }
}

# ---- the error over the number of increments ---------------------------------------------------

errors(method, column) = sprintf("< awk -v method=%s -v column=%s -f errors.awk '%s' | sort -t, -k1n", \
   method, column, study)

set xtics autofreq
set logscale xy
set format y '10^{%T}'
unset xzeroaxis; unset yzeroaxis
stats errors('recursive', 'constraint_error') using 1 name 'n' nooutput
set xrange [0.8*n_min : 1.25*n_max]
do for [format in formats] {
   if (format eq 'png') { set terminal pngcairo size 1200, 1000 font 'sans-serif,15' }
   if (format eq 'svg') { set terminal svg size 1200, 1000 font 'sans-serif,15' background 'white' }
   if (format eq 'pdf') { set terminal pdfcairo size 24cm, 20cm font 'sans-serif,12' }
   set output sprintf('%s/increments.%s', results, format)
   set multiplot

   set label 1 'Error over the number of increments' at screen 0.03, screen 0.967 \
      font 'sans-serif:Bold,21' textcolor rgb '#202020'
   set label 2 'McPherson strut, vertical load 0 to −3000 N' at screen 0.03, screen 0.932 \
      font 'sans-serif,14' textcolor rgb '#606060'
   set key at screen 0.985, screen 0.985 right top vertical Left reverse samplen 4 width -1 spacing 1.05
   set label 3 'Joints:  |Φ|, residual of the joint constraints, equation (31)' \
      at screen 0.125, screen 0.895 font 'sans-serif:Bold,15' textcolor rgb '#202020'
   set tmargin at screen 0.868; set bmargin at screen 0.535
   set format x ''
   set ylabel '|Φ|   [m, rad]'
   plot errors('recursive', 'constraint_error') using 1:2 with linespoints linestyle 3 title 'recursive (paper)', \
        errors('corrected', 'constraint_error') using 1:2 with linespoints linestyle 2 title 'corrected'

   unset label 1; unset label 2; unset key
   set label 3 'Wheel:  error of toe relative to the equilibrium' \
      at screen 0.125, screen 0.472 font 'sans-serif:Bold,15' textcolor rgb '#202020'
   set tmargin at screen 0.445; set bmargin at screen 0.09
   set format x '%g'
   set xlabel 'number of increments'
   set ylabel 'error of toe [deg]'
   plot errors('recursive', 'toe_error_deg') using 1:2 with linespoints linestyle 3, \
        errors('corrected', 'toe_error_deg') using 1:2 with linespoints linestyle 2
   unset label; unset xlabel
   unset multiplot
   unset output
}
