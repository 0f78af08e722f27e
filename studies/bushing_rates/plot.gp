# Families of toe and camber curves, and a contour of the toe gradient, over two bushing rates.
#
#     gnuplot studies/bushing_rates/plot.gp                 reads and writes studies/bushing_rates/out
#     gnuplot -e "out='my/folder'" studies/bushing_rates/plot.gp
if (!exists('out')) out = 'studies/bushing_rates/out'
curves = out.'/bushing_rates_curves.csv'
responses = out.'/bushing_rates_responses.csv'

set encoding utf8
set datafile separator comma
set border 3 linecolor rgb '#808080'
set tics out nomirror textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set palette defined (0 '#440154', 0.25 '#3B528B', 0.5 '#21918C', 0.75 '#5EC962', 1 '#E8D000')

do for [format in 'png svg'] {
   # ---- the family of curves, coloured by the first factor ------------------------------------
   if (format eq 'png') { set terminal pngcairo size 1300, 800 font 'sans-serif,14' }
   if (format eq 'svg') { set terminal svg size 1300, 800 font 'sans-serif,14' background 'white' }
   set output sprintf('%s/family.%s', out, format)
   set multiplot
   set label 1 'Toe and camber over the wheel travel' at screen 0.02, screen 0.955 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'McPherson strut; one curve per pair of bushing rates, coloured by the front rate' at screen 0.02, screen 0.915 textcolor rgb '#606060'
   unset key
   set logscale cb; set cbrange [500:16000]
   set cbtics (500, 1000, 2000, 4000, 8000, 16000)
   set cblabel 'radial rate of the front arm bushing [N/mm]' offset 1.2, 0
   set ylabel 'wheel travel [mm]    (+ bump)'
   set yrange [-80:80]; set ytics 20
   set xzeroaxis linetype 1 linecolor rgb '#909090'; set yzeroaxis linetype 1 linecolor rgb '#909090'
   set tmargin at screen 0.86; set bmargin at screen 0.11
   set lmargin at screen 0.075; set rmargin at screen 0.44
   unset colorbox
   set xlabel 'toe [deg]    (+ front edge inward)'
   plot curves using 'toe_deg':'wheel_travel_mm':'lca_front_radial_n_per_mm' with lines linewidth 1.1 linecolor palette
   unset label 1; unset label 2
   set lmargin at screen 0.51; set rmargin at screen 0.875
   set colorbox user origin screen 0.9, screen 0.16 size screen 0.018, screen 0.65
   set xlabel 'camber [deg]    (+ top outward)'
   plot curves using 'camber_deg':'wheel_travel_mm':'lca_front_radial_n_per_mm' with lines linewidth 1.1 linecolor palette
   unset multiplot
   unset output
   unset xzeroaxis; unset yzeroaxis; unset logscale cb; set cbrange [*:*]; set cbtics autofreq; set yrange [*:*]; set ytics autofreq

   # ---- one response over both factors ---------------------------------------------------------
   if (format eq 'png') { set terminal pngcairo size 1100, 900 font 'sans-serif,15' }
   if (format eq 'svg') { set terminal svg size 1100, 900 font 'sans-serif,15' background 'white' }
   set output sprintf('%s/toe_gradient.%s', out, format)
   set label 1 'Toe gradient over two bushing rates' at screen 0.03, screen 0.955 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'McPherson strut; least squares over ±15 mm of wheel travel, negative: toe-out in bump' at screen 0.03, screen 0.915 textcolor rgb '#606060'
   set lmargin at screen 0.12; set rmargin at screen 0.82; set tmargin at screen 0.86; set bmargin at screen 0.12
   set colorbox user origin screen 0.85, screen 0.16 size screen 0.025, screen 0.65
   set cblabel 'toe gradient [deg/m]' offset 1.5, 0
   set xlabel 'radial rate, front arm bushing [N/mm]'; set ylabel 'lateral rate, rear arm bushing [N/mm]'
   set logscale xy
   set xtics (500, 1000, 2000, 4000, 8000, 16000); set ytics (250, 500, 1000, 2000, 4000, 8000)
   set xrange [500:16000]; set yrange [250:8000]
   set table $grid
   splot responses using 'lca_front_radial_n_per_mm':'lca_rear_lateral_n_per_mm':'toe_gradient_deg_per_m' with lines
   unset table
   set table $lines
   set contour base
   set cntrparam levels 8
   unset surface
   splot responses using 'lca_front_radial_n_per_mm':'lca_rear_lateral_n_per_mm':'toe_gradient_deg_per_m' with lines
   unset table
   unset contour; set surface
   set view map
   unset grid
   set pm3d map interpolate 4, 4
   set datafile separator whitespace      # for the two tables made above
   unset key
   set label 3 'the deck' at first 8000, first 2000 offset 1.2, 0.7 front textcolor rgb '#FFFFFF' font 'sans-serif:Bold,15'
   splot $grid using 1:2:3 with pm3d notitle, \
         $lines using 1:2:(0) with lines linecolor rgb '#FFFFFF' linewidth 1.5 notitle, \
         '+' using (8000):(2000):(0) every ::0::0 with points pointtype 6 pointsize 2 linewidth 2.5 linecolor rgb '#FFFFFF' notitle
   set datafile separator comma
   set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
   unset pm3d; unset label 1; unset label 2; unset label 3; unset logscale xy; unset view
   set xtics autofreq; set ytics autofreq; set xrange [*:*]; set yrange [*:*]
   set view 60, 30
   unset output
}
