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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00
set lmargin at screen 1.15000E-01; set rmargin at screen 9.70000E-01
set tmargin at screen 8.80000E-01; set bmargin at screen 1.15000E-01
set ylabel 'wheel travel [mm]    (+ bump)' textcolor rgb '#202020'
set xlabel 'Camber, deg    (+ top outward)' textcolor rgb '#202020'
set xrange [*:*]

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_camber.'.format
   set label 1 'Camber' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   plot 'plane_axle_centre.csv' using "left_camber_deg":"left_wheel_travel_mm" with lines linestyle 1 title 'left', \
        'plane_axle_centre.csv' using "right_camber_deg":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) title 'right', \
        'plane_axle_centre.csv' using "left_camber_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_camber_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00
set lmargin at screen 1.15000E-01; set rmargin at screen 9.70000E-01
set tmargin at screen 8.80000E-01; set bmargin at screen 1.15000E-01
set ylabel 'wheel travel [mm]    (+ bump)' textcolor rgb '#202020'
set xlabel 'Half-track change, mm    (contact point, + outward)' textcolor rgb '#202020'
set xrange [*:*]

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_lateral.'.format
   set label 1 'Lateral movement of the contact point' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   plot 'plane_axle_centre.csv' using "left_track_change_mm":"left_wheel_travel_mm" with lines linestyle 1 title 'left', \
        'plane_axle_centre.csv' using "right_track_change_mm":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) title 'right', \
        'plane_axle_centre.csv' using "left_track_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_track_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00
set lmargin at screen 1.15000E-01; set rmargin at screen 9.70000E-01
set tmargin at screen 8.80000E-01; set bmargin at screen 1.15000E-01
set ylabel 'wheel travel [mm]    (+ bump)' textcolor rgb '#202020'
set xlabel 'Wheelbase change, mm    (contact point, + rearward)' textcolor rgb '#202020'
set xrange [* < -1 : 1 < *]

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_longitudinal.'.format
   set label 1 'Longitudinal movement of the contact point' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   plot 'plane_axle_centre.csv' using "left_wheelbase_change_mm":"left_wheel_travel_mm" with lines linestyle 1 title 'left', \
        'plane_axle_centre.csv' using "right_wheelbase_change_mm":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) title 'right', \
        'plane_axle_centre.csv' using "left_wheelbase_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_wheelbase_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,12' noenhanced }
set output 'plane_axle_centre_overview.'.format
   set label 1 'Overview' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   set multiplot layout 2, 2 margins 9.50000E-02, 9.70000E-01, 8.50000E-02, 8.50000E-01 spacing 1.15000E-01, 1.55000E-01

   set title 'Toe' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Toe, deg    (+ front edge inward)' textcolor rgb '#202020'
   set xrange [* < -5.00000E-02 : 5.00000E-02 < *]
   plot 'plane_axle_centre.csv' using "left_toe_deg":"left_wheel_travel_mm" with lines linestyle 1 title 'left', \
        'plane_axle_centre.csv' using "right_toe_deg":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) title 'right', \
        'plane_axle_centre.csv' using "left_toe_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_toe_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
   unset label 1; unset label 2

   set title 'Camber' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Camber, deg    (+ top outward)' textcolor rgb '#202020'
   set xrange [*:*]
   plot 'plane_axle_centre.csv' using "left_camber_deg":"left_wheel_travel_mm" with lines linestyle 1 notitle, \
        'plane_axle_centre.csv' using "right_camber_deg":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) notitle, \
        'plane_axle_centre.csv' using "left_camber_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 notitle, \
        'plane_axle_centre.csv' using "right_camber_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle

   set title 'Half-track change' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Half-track change, mm    (contact point, + outward)' textcolor rgb '#202020'
   set xrange [*:*]
   plot 'plane_axle_centre.csv' using "left_track_change_mm":"left_wheel_travel_mm" with lines linestyle 1 notitle, \
        'plane_axle_centre.csv' using "right_track_change_mm":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) notitle, \
        'plane_axle_centre.csv' using "left_track_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 notitle, \
        'plane_axle_centre.csv' using "right_track_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle

   set title 'Wheelbase change' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Wheelbase change, mm    (contact point, + rearward)' textcolor rgb '#202020'
   set xrange [* < -1 : 1 < *]
   plot 'plane_axle_centre.csv' using "left_wheelbase_change_mm":"left_wheel_travel_mm" with lines linestyle 1 notitle, \
        'plane_axle_centre.csv' using "right_wheelbase_change_mm":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) notitle, \
        'plane_axle_centre.csv' using "left_wheelbase_change_mm":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 notitle, \
        'plane_axle_centre.csv' using "right_wheelbase_change_mm":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
   unset multiplot
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 8.23333E-01, screen 8.80000E-01 left top vertical Left reverse samplen 2.50000E+00
set lmargin at screen 1.15000E-01; set rmargin at screen 8.08333E-01
set tmargin at screen 8.80000E-01; set bmargin at screen 1.15000E-01
set ylabel 'wheel travel [mm]    (+ bump)' textcolor rgb '#202020'
set xlabel 'force, N    (+ compression)' textcolor rgb '#202020'
set xrange [*:*]

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_spring_force.'.format
   set label 1 'Spring force' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   plot 'plane_axle_centre.csv' using "left_coil_force_n":"left_wheel_travel_mm" with lines linestyle 1 title 'left_coil', \
        'plane_axle_centre.csv' using "right_coil_force_n":"right_wheel_travel_mm" with lines linestyle 1 dashtype (12, 7) title 'right_coil', \
        'plane_axle_centre.csv' using "across_force_n":"left_wheel_travel_mm" with lines linestyle 2 title 'across', \
        'plane_axle_centre.csv' using "left_coil_force_n":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_coil_force_n":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle, \
        'plane_axle_centre.csv' using "across_force_n":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 notitle
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00
set lmargin at screen 1.15000E-01; set rmargin at screen 9.70000E-01
set tmargin at screen 8.80000E-01; set bmargin at screen 1.15000E-01
set ylabel 'wheel travel [mm]    (+ bump)' textcolor rgb '#202020'
set xlabel 'Toe, deg    (+ front edge inward)' textcolor rgb '#202020'
set xrange [* < -5.00000E-02 : 5.00000E-02 < *]

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,15' noenhanced }
set output 'plane_axle_centre_toe.'.format
   set label 1 'Toe' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'axle of two plane four-bars, centre' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   plot 'plane_axle_centre.csv' using "left_toe_deg":"left_wheel_travel_mm" with lines linestyle 1 title 'left', \
        'plane_axle_centre.csv' using "right_toe_deg":"right_wheel_travel_mm" with lines linestyle 2 dashtype (12, 7) title 'right', \
        'plane_axle_centre.csv' using "left_toe_deg":(column("factor") == 0 ? column("left_wheel_travel_mm") : NaN) with points linestyle 20 title 'design', \
        'plane_axle_centre.csv' using "right_toe_deg":(column("factor") == 0 ? column("right_wheel_travel_mm") : NaN) with points linestyle 20 notitle
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
set style line 1 linecolor rgb '#0072B2' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 2 linecolor rgb '#D55E00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 3 linecolor rgb '#009E73' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 4 linecolor rgb '#CC79A7' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 5 linecolor rgb '#E69F00' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 6 linecolor rgb '#56B4E9' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 7 linecolor rgb '#4D4D4D' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 8 linecolor rgb '#8C510A' linewidth 2.60000E+00 pointtype 7 pointsize 7.00000E-01
set style line 20 linecolor rgb '#202020' linewidth 2 pointtype 6 pointsize 1.80000E+00   # marks

set key at screen 9.75000E-01, screen 9.65000E-01 right top horizontal Right noreverse samplen 2.50000E+00

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 900 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 900 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 18cm font 'sans-serif,12' noenhanced }
set output 'tiny_sweep_overview.'.format
   set label 1 'Overview' at screen 2.50000E-02, screen 9.65000E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
   set label 2 'tiny, sweep' at screen 2.50000E-02, screen 9.22000E-01 font 'sans-serif,14' textcolor rgb '#606060'
   set multiplot layout 2, 2 margins 9.50000E-02, 9.70000E-01, 8.50000E-02, 8.50000E-01 spacing 1.15000E-01, 1.55000E-01

   set title 'Toe' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Toe, deg    (+ front edge inward)' textcolor rgb '#202020'
   set xrange [* < -5.00000E-02 : 5.00000E-02 < *]
   plot 'tiny_sweep.csv' using "toe_deg":"wheel_travel_mm" with lines linestyle 1 notitle, \
        'tiny_sweep.csv' using "toe_deg":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points linestyle 20 title 'design'
   unset label 1; unset label 2

   set title 'Camber' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Camber, deg    (+ top outward)' textcolor rgb '#202020'
   set xrange [*:*]
   plot 'tiny_sweep.csv' using "camber_deg":"wheel_travel_mm" with lines linestyle 1 notitle, \
        'tiny_sweep.csv' using "camber_deg":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points linestyle 20 notitle

   set title 'Half-track change' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Half-track change, mm    (contact point, + outward)' textcolor rgb '#202020'
   set xrange [*:*]
   plot 'tiny_sweep.csv' using "track_change_mm":"wheel_travel_mm" with lines linestyle 1 notitle, \
        'tiny_sweep.csv' using "track_change_mm":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points linestyle 20 notitle

   set title 'Wheelbase change' font 'sans-serif:Bold,14' textcolor rgb '#202020'
   set ylabel 'wheel travel [mm]'."\n".'(+ bump)' textcolor rgb '#202020'
   set xlabel 'Wheelbase change, mm    (contact point, + rearward)' textcolor rgb '#202020'
   set xrange [* < -1 : 1 < *]
   plot 'tiny_sweep.csv' using "wheelbase_change_mm":"wheel_travel_mm" with lines linestyle 1 notitle, \
        'tiny_sweep.csv' using "wheelbase_change_mm":(column("factor") == 0 ? column("wheel_travel_mm") : NaN) with points linestyle 20 notitle
   unset multiplot
unset output
}
