# Travel and steering: envelope of the wheels
#
#     gnuplot travel_and_steering_envelope.gp
#
# in this folder draws travel_and_steering_envelope.png and .svg;
# gnuplot -e "formats='pdf'" travel_and_steering_envelope.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator whitespace
set datafile missing 'NaN'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
unset key; set style fill solid 1 noborder
$s1_1 << EOD
-1.43848E+01 -7.96509E+02 -40 -1.09091E+01 -5.89999E+01 -6.62456E-02
-1.34777E+01 -7.98227E+02 -6.66667E+00 -1.08110E+01 -5.90130E+01 7.66279E-01
-1.25810E+01 -7.96769E+02 2.66667E+01 -1.07132E+01 -5.90097E+01 1.75639E+00
-1.17569E+01 -7.92168E+02 60 -1.06383E+01 -5.89756E+01 2.94969E+00
2.40349E+00 -7.98510E+02 -40 2.56135E+00 -5.99408E+01 -7.37039E-01
3.18791E+00 -8.00135E+02 -6.66667E+00 2.56681E+00 -5.99450E+01 7.49570E-02
3.93364E+00 -7.98584E+02 2.66667E+01 2.54987E+00 -5.99366E+01 1.04928E+00
4.54457E+00 -7.93900E+02 60 2.47150E+00 -5.99075E+01 2.23152E+00
1.93283E+01 -7.96699E+02 -40 1.59958E+01 -5.78043E+01 -1.67333E+00
1.99957E+01 -7.98251E+02 -6.66667E+00 1.59141E+01 -5.78439E+01 -9.07986E-01
2.05948E+01 -7.96637E+02 2.66667E+01 1.57872E+01 -5.78858E+01 1.98641E-02
2.09928E+01 -7.91916E+02 60 1.55601E+01 -5.79355E+01 1.16860E+00
EOD
$s1_2 << EOD
-1.43848E+01 -7.96509E+02 -40
2.40349E+00 -7.98510E+02 -40
1.93283E+01 -7.96699E+02 -40


-1.34777E+01 -7.98227E+02 -6.66667E+00
3.18791E+00 -8.00135E+02 -6.66667E+00
1.99957E+01 -7.98251E+02 -6.66667E+00


-1.25810E+01 -7.96769E+02 2.66667E+01
3.93364E+00 -7.98584E+02 2.66667E+01
2.05948E+01 -7.96637E+02 2.66667E+01


-1.17569E+01 -7.92168E+02 60
4.54457E+00 -7.93900E+02 60
2.09928E+01 -7.91916E+02 60


EOD
$s1_3 << EOD
-1.43848E+01 -7.96509E+02 -40
-1.34777E+01 -7.98227E+02 -6.66667E+00
-1.25810E+01 -7.96769E+02 2.66667E+01
-1.17569E+01 -7.92168E+02 60


2.40349E+00 -7.98510E+02 -40
3.18791E+00 -8.00135E+02 -6.66667E+00
3.93364E+00 -7.98584E+02 2.66667E+01
4.54457E+00 -7.93900E+02 60


1.93283E+01 -7.96699E+02 -40
1.99957E+01 -7.98251E+02 -6.66667E+00
2.05948E+01 -7.96637E+02 2.66667E+01
2.09928E+01 -7.91916E+02 60


EOD
$s2_1 << EOD
1.25456E+01 7.97893E+02 -40 1.06296E+01 5.90374E+01 -1.26597E+00
1.32590E+01 7.99471E+02 -6.66667E+00 1.05821E+01 5.90575E+01 -4.78696E-01
1.39163E+01 7.97879E+02 2.66667E+01 1.04986E+01 5.90725E+01 4.71581E-01
1.43995E+01 7.93167E+02 60 1.03306E+01 5.90813E+01 1.63632E+00
-4.32897E+00 7.98165E+02 -40 -2.82320E+00 5.99320E+01 -4.37262E-01
-3.49622E+00 7.99824E+02 -6.66667E+00 -2.78143E+00 5.99342E+01 3.86031E-01
-2.69075E+00 7.98307E+02 2.66667E+01 -2.75316E+00 5.99211E+01 1.37029E+00
-1.99482E+00 7.93650E+02 60 -2.77097E+00 5.98813E+01 2.55977E+00
-2.10680E+01 7.94613E+02 -40 -1.63133E+01 5.77396E+01 1.27176E-01
-2.01096E+01 7.96377E+02 -6.66667E+00 -1.61760E+01 5.77704E+01 9.60503E-01
-1.91503E+01 7.94966E+02 2.66667E+01 -1.60301E+01 5.77862E+01 1.94825E+00
-1.82393E+01 7.90413E+02 60 -1.58914E+01 5.77721E+01 3.13904E+00
EOD
$s2_2 << EOD
1.25456E+01 7.97893E+02 -40
-4.32897E+00 7.98165E+02 -40
-2.10680E+01 7.94613E+02 -40


1.32590E+01 7.99471E+02 -6.66667E+00
-3.49622E+00 7.99824E+02 -6.66667E+00
-2.01096E+01 7.96377E+02 -6.66667E+00


1.39163E+01 7.97879E+02 2.66667E+01
-2.69075E+00 7.98307E+02 2.66667E+01
-1.91503E+01 7.94966E+02 2.66667E+01


1.43995E+01 7.93167E+02 60
-1.99482E+00 7.93650E+02 60
-1.82393E+01 7.90413E+02 60


EOD
$s2_3 << EOD
1.25456E+01 7.97893E+02 -40
1.32590E+01 7.99471E+02 -6.66667E+00
1.39163E+01 7.97879E+02 2.66667E+01
1.43995E+01 7.93167E+02 60


-4.32897E+00 7.98165E+02 -40
-3.49622E+00 7.99824E+02 -6.66667E+00
-2.69075E+00 7.98307E+02 2.66667E+01
-1.99482E+00 7.93650E+02 60


-2.10680E+01 7.94613E+02 -40
-2.01096E+01 7.96377E+02 -6.66667E+00
-1.91503E+01 7.94966E+02 2.66667E+01
-1.82393E+01 7.90413E+02 60


EOD

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1400, 788 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1400, 788 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 28cm, 15cm font 'sans-serif,15' noenhanced }
set output 'travel_and_steering_envelope.'.format
set label 1 'Travel and steering: envelope of the wheels' at screen 2.00000E-02, screen 9.61930E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'push; blue: wheel centre, lines of equal wheel travel, orange: of equal rack_drive;'."\n".'grey: spin axis, 60 mm outboard' at screen 2.00000E-02, screen 9.23860E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
unset colorbox

unset lmargin; unset rmargin; unset bmargin; unset tmargin; set size 5.00000E-01, 9.00000E-01; set origin 0, 0
set title 'left wheel; z upward [mm]' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'x [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'y [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 50; set grid noxtics; unset logscale x; set format x
unset yzeroaxis
set xrange [-4.94502E+01:6.14502E+01]
set ytics scale 6.00000E-01 50; set grid noytics; unset logscale y; set format y
unset xzeroaxis
set yrange [-8.81450E+02:-7.70550E+02]
set ztics scale 6.00000E-01 50; set grid noztics; unset logscale z; set format z
unset xzeroaxis
set zrange [-4.44502E+01:6.64502E+01]
set view equal xyz; set border 4095 linewidth 5.00000E-01 linecolor rgb '#C0C0C0'
set xyplane at -4.44502E+01; set view 68, 320, 1.10000E+00
splot $s1_1 using 1:2:3:4:5:6 with vectors nohead linewidth 1.50000E+00 linecolor rgb '#909090' notitle, \
     $s1_2 using 1:2:3 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $s1_3 using 1:2:3 with lines linewidth 2 linecolor rgb '#D55E00' notitle
unset label 1; unset label 2; unset label 9; unset key

unset lmargin; unset rmargin; unset bmargin; unset tmargin; set size 5.00000E-01, 9.00000E-01; set origin 5.00000E-01, 0
set title 'right wheel; z upward [mm]' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'x [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'y [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 50; set grid noxtics; unset logscale x; set format x
unset yzeroaxis
set xrange [-6.13347E+01:4.93347E+01]
set ytics scale 6.00000E-01 50; set grid noytics; unset logscale y; set format y
unset xzeroaxis
set yrange [7.69665E+02:8.80335E+02]
set ztics scale 6.00000E-01 50; set grid noztics; unset logscale z; set format z
unset xzeroaxis
set zrange [-4.43347E+01:6.63347E+01]
set view equal xyz; set border 4095 linewidth 5.00000E-01 linecolor rgb '#C0C0C0'
set xyplane at -4.43347E+01; set view 68, 220, 1.10000E+00
splot $s2_1 using 1:2:3:4:5:6 with vectors nohead linewidth 1.50000E+00 linecolor rgb '#909090' notitle, \
     $s2_2 using 1:2:3 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $s2_3 using 1:2:3 with lines linewidth 2 linecolor rgb '#D55E00' notitle
unset multiplot
unset label
unset output
}
