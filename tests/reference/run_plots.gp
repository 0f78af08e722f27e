# Camber
#
#     gnuplot plane_axle_centre_camber.gp
#
# in this folder draws plane_axle_centre_camber.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_camber.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_camber.'.format
set label 1 'Camber' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 8.64440E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'Camber, deg    (+ top outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]    (+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_camber_deg":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left', \
     'plane_axle_centre.csv' using "right_camber_deg":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' title 'right', \
     'plane_axle_centre.csv' using "left_camber_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_camber_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key
unset multiplot
unset label
unset output
}
# Lateral movement of the contact point
#
#     gnuplot plane_axle_centre_lateral.gp
#
# in this folder draws plane_axle_centre_lateral.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_lateral.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_lateral.'.format
set label 1 'Lateral movement of the contact point' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 8.64440E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'Half-track change, mm    (contact point, + outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]    (+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_track_change_mm":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left', \
     'plane_axle_centre.csv' using "right_track_change_mm":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' title 'right', \
     'plane_axle_centre.csv' using "left_track_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_track_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key
unset multiplot
unset label
unset output
}
# Longitudinal movement of the contact point
#
#     gnuplot plane_axle_centre_longitudinal.gp
#
# in this folder draws plane_axle_centre_longitudinal.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_longitudinal.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_longitudinal.'.format
set label 1 'Longitudinal movement of the contact point' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 8.64440E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'Wheelbase change, mm    (contact point, + rearward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]    (+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -1 : 1 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_wheelbase_change_mm":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left', \
     'plane_axle_centre.csv' using "right_wheelbase_change_mm":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' title 'right', \
     'plane_axle_centre.csv' using "left_wheelbase_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_wheelbase_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key
unset multiplot
unset label
unset output
}
# Overview
#
#     gnuplot plane_axle_centre_overview.gp
#
# in this folder draws plane_axle_centre_overview.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_overview.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,12' noenhanced }
set output 'plane_axle_centre_overview.'.format
set label 1 'Overview' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 5.40000E-01; set tmargin at screen 8.64440E-01
set title 'Toe' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Toe, deg    (+ front edge inward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -5.00000E-02 : 5.00000E-02 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_toe_deg":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left', \
     'plane_axle_centre.csv' using "right_toe_deg":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' title 'right', \
     'plane_axle_centre.csv' using "left_toe_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_toe_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 5.40000E-01; set tmargin at screen 8.64440E-01
set title 'Camber' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Camber, deg    (+ top outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_camber_deg":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'plane_axle_centre.csv' using "right_camber_deg":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' notitle, \
     'plane_axle_centre.csv' using "left_camber_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle, \
     'plane_axle_centre.csv' using "right_camber_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 4.13330E-01
set title 'Half-track change' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Half-track change, mm    (contact point, + outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_track_change_mm":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'plane_axle_centre.csv' using "right_track_change_mm":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' notitle, \
     'plane_axle_centre.csv' using "left_track_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle, \
     'plane_axle_centre.csv' using "right_track_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 4.13330E-01
set title 'Wheelbase change' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Wheelbase change, mm    (contact point, + rearward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -1 : 1 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_wheelbase_change_mm":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'plane_axle_centre.csv' using "right_wheelbase_change_mm":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' notitle, \
     'plane_axle_centre.csv' using "left_wheelbase_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle, \
     'plane_axle_centre.csv' using "right_wheelbase_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset multiplot
unset label
unset output
}
# Spring force
#
#     gnuplot plane_axle_centre_spring_force.gp
#
# in this folder draws plane_axle_centre_spring_force.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_spring_force.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_spring_force.'.format
set label 1 'Spring force' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 8.25000E-01, screen 8.64440E-01 left top Left reverse samplen 2.50000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 8.00000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 8.64440E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'force, N    (+ compression)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]    (+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_coil_force_n":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left_coil', \
     'plane_axle_centre.csv' using "right_coil_force_n":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#0072B2' title 'right_coil', \
     'plane_axle_centre.csv' using "across_force_n":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#D55E00' title 'across', \
     'plane_axle_centre.csv' using "left_coil_force_n":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_coil_force_n":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle, \
     'plane_axle_centre.csv' using "across_force_n":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key
unset multiplot
unset label
unset output
}
# Toe
#
#     gnuplot plane_axle_centre_toe.gp
#
# in this folder draws plane_axle_centre_toe.png and .svg;
# gnuplot -e "formats='pdf'" plane_axle_centre_toe.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_toe.'.format
set label 1 'Toe' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'axle of two plane four-bars, centre' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 8.64440E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'Toe, deg    (+ front edge inward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]    (+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -5.00000E-02 : 5.00000E-02 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'plane_axle_centre.csv' using "left_toe_deg":"left_wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' title 'left', \
     'plane_axle_centre.csv' using "right_toe_deg":"right_wheel_travel_mm" with lines linewidth 2.60000E+00 dashtype (12, 7) linecolor rgb '#D55E00' title 'right', \
     'plane_axle_centre.csv' using "left_toe_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design', \
     'plane_axle_centre.csv' using "right_toe_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset label 1; unset label 2; unset label 9; unset key
unset multiplot
unset label
unset output
}
# Overview
#
#     gnuplot tiny_sweep_overview.gp
#
# in this folder draws tiny_sweep_overview.png and .svg;
# gnuplot -e "formats='pdf'" tiny_sweep_overview.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set datafile columnheaders
unset key; set style fill solid 1 noborder

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,12' noenhanced }
set output 'tiny_sweep_overview.'.format
set label 1 'Overview' at screen 2.00000E-02, screen 9.66670E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'tiny, sweep' at screen 2.00000E-02, screen 9.33330E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86670E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 5.40000E-01; set tmargin at screen 8.64440E-01
set title 'Toe' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Toe, deg    (+ front edge inward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -5.00000E-02 : 5.00000E-02 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'tiny_sweep.csv' using "toe_deg":"wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'tiny_sweep.csv' using "toe_deg":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' title 'design'
unset label 1; unset label 2; unset label 9; unset key

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 5.40000E-01; set tmargin at screen 8.64440E-01
set title 'Camber' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Camber, deg    (+ top outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'tiny_sweep.csv' using "camber_deg":"wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'tiny_sweep.csv' using "camber_deg":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 4.13330E-01
set title 'Half-track change' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Half-track change, mm    (contact point, + outward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'tiny_sweep.csv' using "track_change_mm":"wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'tiny_sweep.csv' using "track_change_mm":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 8.88890E-02; set tmargin at screen 4.13330E-01
set title 'Wheelbase change' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'Wheelbase change, mm    (contact point, + rearward)' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'wheel travel [mm]'."\n".'(+ bump)' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [* < -1 : 1 < *]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot 'tiny_sweep.csv' using "wheelbase_change_mm":"wheel_travel_mm" with lines linewidth 2.60000E+00 linecolor rgb '#0072B2' notitle, \
     'tiny_sweep.csv' using "wheelbase_change_mm":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points pointtype 6 pointsize 1.80000E+00 linewidth 2 linecolor rgb '#202020' notitle
unset multiplot
unset label
unset output
}
