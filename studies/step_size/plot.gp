# Error and time against the number of increments, all methods.
#
#     gnuplot studies/step_size/plot.gp                     reads and writes studies/step_size/out
#     gnuplot -e "out='my/folder'" studies/step_size/plot.gp
if (!exists('out')) out = 'studies/step_size/out'
data = out.'/step_size.csv'

set encoding utf8
set datafile separator comma
set border 3 linecolor rgb '#808080'
set tics out nomirror textcolor rgb '#404040'
set mxtics 10; set mytics 1
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set style line 1 linecolor rgb '#0072B2' linewidth 2.2 pointtype 5 pointsize 1.1
set style line 2 linecolor rgb '#202020' linewidth 2.2 pointtype 9 pointsize 1.3
set style line 3 linecolor rgb '#D55E00' linewidth 2.2 pointtype 7 pointsize 1.2
set style line 8 linecolor rgb '#A0A0A0' linewidth 1.6 dashtype (6, 6)

# The rows of one method; an error of zero is drawn at the rounding level.
n(method) = strcol('method') eq method ? column('increments') : NaN
e(method, name, least) = strcol('method') eq method ? (abs(column(name)) > least ? abs(column(name)) : least) : NaN
t(method) = strcol('method') eq method ? 1e3*column('seconds') : NaN

array column_of[4] = ['constraint_error', 'travel_error_mm', 'toe_error_deg', 'camber_error_deg']
array title_of[4] = ['Joints: |Φ| of (31)', 'Wheel travel: error relative to equilibrium', \
   'Toe: error relative to equilibrium', 'Camber: error relative to equilibrium']
array label_of[4] = ['|Φ|  [m, rad]', 'error [mm]', 'error [deg]', 'error [deg]']
array first_order[4] = [1.8e-2, 0, 0, 0]
array second_order[4] = [1.9e-2, 1.5, 0.2, 0.9]
array least[4] = [3e-17, 3e-14, 3e-15, 3e-15]

set logscale xy
set format y '10^{%T}'
set xrange [8:1300]

do for [format in 'png svg'] {
   if (format eq 'png') { set terminal pngcairo size 1300, 1000 font 'sans-serif,14' }
   if (format eq 'svg') { set terminal svg size 1300, 1000 font 'sans-serif,14' background 'white' }
   set output sprintf('%s/convergence.%s', out, format)
   set multiplot
   set label 1 'Error against the number of increments' at screen 0.02, screen 0.965 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'McPherson strut, vertical load 0 to −3000 N' at screen 0.02, screen 0.93 textcolor rgb '#606060'
   do for [k = 1:4] {
      left = k % 2 == 1 ? 0.085 : 0.575
      top = k <= 2 ? 0.845 : 0.395
      set lmargin at screen left; set rmargin at screen left + 0.4
      set tmargin at screen top; set bmargin at screen top - 0.315
      set title title_of[k] font 'sans-serif:Bold,15' offset 0, -0.4
      set ylabel label_of[k] offset 0.5, 0
      set xlabel (k > 2 ? 'increments' : '')
      if (k == 1) { set key at screen 0.985, screen 0.985 right top vertical samplen 3 } else { unset key }
      name = column_of[k]
      plot data using (n('recursive')):(e('recursive', name, least[k])) with linespoints linestyle 3 title 'recursive (paper)', \
           data using (n('corrected')):(e('corrected', name, least[k])) with linespoints linestyle 2 title 'corrected', \
           data using (n('equilibrium')):(e('equilibrium', name, least[k])) with linespoints linestyle 1 title 'equilibrium', \
           (first_order[k] > 0 ? first_order[k]/x : NaN) with lines linestyle 8 title 'slopes −1 and −2', \
           second_order[k]/x**2 with lines linestyle 8 notitle
      unset label 1; unset label 2
   }
   unset multiplot
   unset output

   if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' }
   if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' background 'white' }
   set output sprintf('%s/work_precision.%s', out, format)
   set label 1 'Accuracy against time' at screen 0.03, screen 0.955 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'McPherson strut, vertical load 0 to −3000 N in 10 to 1000 increments' at screen 0.03, screen 0.915 textcolor rgb '#606060'
   set lmargin at screen 0.11; set rmargin at screen 0.96; set tmargin at screen 0.86; set bmargin at screen 0.11
   unset title
   set key at screen 0.975, screen 0.985 right top vertical samplen 3
   set xlabel 'time of the sweep [ms]'
   set ylabel 'error of toe at the end [deg]'
   set format x '%g'
   set xrange [*:*]
   plot data using (t('recursive')):(e('recursive', 'toe_error_deg', least[3])) with linespoints linestyle 3 title 'recursive (paper)', \
        data using (t('corrected')):(e('corrected', 'toe_error_deg', least[3])) with linespoints linestyle 2 title 'corrected', \
        data using (t('equilibrium')):(e('equilibrium', 'toe_error_deg', least[3])) with linespoints linestyle 1 title 'equilibrium'
   unset label 1; unset label 2
   set xrange [8:1300]
   unset output
}
