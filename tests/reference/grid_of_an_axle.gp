# Travel and steering: carpets of toe and camber
#
#     gnuplot travel_and_steering_carpet.gp
#
# in this folder draws travel_and_steering_carpet.png and .svg;
# gnuplot -e "formats='pdf'" travel_and_steering_carpet.gp makes a PDF.
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
unset key
$equal1_1 << EOD
0 1.04756E+01
4.00000E-01 -2.44684E+00
8.00000E-01 -1.54680E+01

3.33333E-01 1.03813E+01
7.33333E-01 -2.45187E+00
1.13333E+00 -1.53828E+01

6.66667E-01 1.02900E+01
1.06667E+00 -2.43605E+00
1.46667E+00 -1.52553E+01

1 1.02254E+01
1.40000E+00 -2.36241E+00
1.80000E+00 -1.50336E+01

EOD
$ends1_1 << EOD
8.00000E-01 -1.54680E+01 -1 "-40"
1.13333E+00 -1.53828E+01 -1 "-6.66700E+00"
1.46667E+00 -1.52553E+01 -1 "2.66700E+01"
1.80000E+00 -1.50336E+01 -1 "60"
EOD
$equal2_1 << EOD
0 1.04756E+01
3.33333E-01 1.03813E+01
6.66667E-01 1.02900E+01
1 1.02254E+01

4.00000E-01 -2.44684E+00
7.33333E-01 -2.45187E+00
1.06667E+00 -2.43605E+00
1.40000E+00 -2.36241E+00

8.00000E-01 -1.54680E+01
1.13333E+00 -1.53828E+01
1.46667E+00 -1.52553E+01
1.80000E+00 -1.50336E+01

EOD
$ends2_1 << EOD
0 1.04756E+01 1 "-20"
4.00000E-01 -2.44684E+00 -1 "5"
8.00000E-01 -1.54680E+01 -2 "30"
EOD
$equal1_2 << EOD
0 -1.02067E+01
4.00000E-01 2.69703E+00
8.00000E-01 1.57767E+01

3.33333E-01 -1.01586E+01
7.33333E-01 2.65708E+00
1.13333E+00 1.56425E+01

6.66667E-01 -1.00776E+01
1.06667E+00 2.63068E+00
1.46667E+00 1.55042E+01

1 -9.91813E+00
1.40000E+00 2.64943E+00
1.80000E+00 1.53800E+01

EOD
$ends1_2 << EOD
8.00000E-01 1.57767E+01 1 "-40"
1.13333E+00 1.56425E+01 1 "-6.66700E+00"
1.46667E+00 1.55042E+01 1 "2.66700E+01"
1.80000E+00 1.53800E+01 1 "60"
EOD
$equal2_2 << EOD
0 -1.02067E+01
3.33333E-01 -1.01586E+01
6.66667E-01 -1.00776E+01
1 -9.91813E+00

4.00000E-01 2.69703E+00
7.33333E-01 2.65708E+00
1.06667E+00 2.63068E+00
1.40000E+00 2.64943E+00

8.00000E-01 1.57767E+01
1.13333E+00 1.56425E+01
1.46667E+00 1.55042E+01
1.80000E+00 1.53800E+01

EOD
$ends2_2 << EOD
0 -1.02067E+01 -1 "-20"
4.00000E-01 2.69703E+00 1 "5"
8.00000E-01 1.57767E+01 2 "30"
EOD
$equal1_3 << EOD
0 6.32599E-02
4.00000E-01 7.03838E-01
8.00000E-01 1.59812E+00

3.33333E-01 -7.31762E-01
7.33333E-01 -7.15787E-02
1.13333E+00 8.67095E-01

6.66667E-01 -1.67747E+00
1.06667E+00 -1.00204E+00
1.46667E+00 -1.89688E-02

1 -2.81788E+00
1.40000E+00 -2.13143E+00
1.80000E+00 -1.11600E+00

EOD
$ends1_3 << EOD
0 6.32599E-02 -1 "-40"
3.33333E-01 -7.31762E-01 -1 "-6.66700E+00"
6.66667E-01 -1.67747E+00 -1 "2.66700E+01"
1 -2.81788E+00 -1 "60"
EOD
$equal2_3 << EOD
0 6.32599E-02
3.33333E-01 -7.31762E-01
6.66667E-01 -1.67747E+00
1 -2.81788E+00

4.00000E-01 7.03838E-01
7.33333E-01 -7.15787E-02
1.06667E+00 -1.00204E+00
1.40000E+00 -2.13143E+00

8.00000E-01 1.59812E+00
1.13333E+00 8.67095E-01
1.46667E+00 -1.89688E-02
1.80000E+00 -1.11600E+00

EOD
$ends2_3 << EOD
1 -2.81788E+00 -2 "-20"
1.40000E+00 -2.13143E+00 -1 "5"
1.80000E+00 -1.11600E+00 -1 "30"
EOD
$equal1_4 << EOD
0 1.20900E+00
4.00000E-01 4.17558E-01
8.00000E-01 -1.21444E-01

3.33333E-01 4.57126E-01
7.33333E-01 -3.68635E-01
1.13333E+00 -9.17252E-01

6.66667E-01 -4.50331E-01
1.06667E+00 -1.30865E+00
1.46667E+00 -1.86077E+00

1 -1.56276E+00
1.40000E+00 -2.44514E+00
1.80000E+00 -2.99893E+00

EOD
$ends1_4 << EOD
8.00000E-01 -1.21444E-01 -1 "-40"
1.13333E+00 -9.17252E-01 -1 "-6.66700E+00"
1.46667E+00 -1.86077E+00 -1 "2.66700E+01"
1.80000E+00 -2.99893E+00 -1 "60"
EOD
$equal2_4 << EOD
0 1.20900E+00
3.33333E-01 4.57126E-01
6.66667E-01 -4.50331E-01
1 -1.56276E+00

4.00000E-01 4.17558E-01
7.33333E-01 -3.68635E-01
1.06667E+00 -1.30865E+00
1.40000E+00 -2.44514E+00

8.00000E-01 -1.21444E-01
1.13333E+00 -9.17252E-01
1.46667E+00 -1.86077E+00
1.80000E+00 -2.99893E+00

EOD
$ends2_4 << EOD
1 -1.56276E+00 -1 "-20"
1.40000E+00 -2.44514E+00 -1 "5"
1.80000E+00 -2.99893E+00 -2 "30"
EOD

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1200, 1068 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1200, 1068 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 24cm, 21cm font 'sans-serif,15' noenhanced }
set output 'travel_and_steering_carpet.'.format
set label 1 'Travel and steering: carpets of toe and camber' at screen 2.00000E-02, screen 9.71910E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'push; blue: lines of equal wheel travel [mm], orange: of equal rack_drive [mm]' at screen 2.00000E-02, screen 9.43820E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
unset xtics; unset xzeroaxis; unset yzeroaxis; set border 2; set grid noxtics
set offsets graph 1.60000E-01, graph 1.40000E-01, graph 1.00000E-01, graph 1.00000E-01

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 4.96250E-01; set tmargin at screen 8.85770E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel '' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'Toe, left, deg    (+ front edge inward)' offset 6.00000E-01, 0 textcolor rgb '#404040'
plot $equal1_1 using 1:2 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $ends1_1 using ($3 == 1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $ends1_1 using ($3 == -1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $equal2_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' notitle, \
     $ends2_1 using ($3 == 1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_1 using ($3 == -1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_1 using ($3 == 2 ? $1 : NaN):2:4 with labels center offset 0, 1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_1 using ($3 == -2 ? $1 : NaN):2:4 with labels center offset 0, -1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle
unset label 1; unset label 2; unset label 9

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 4.96250E-01; set tmargin at screen 8.85770E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel '' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'Toe, right, deg    (+ front edge inward)' offset 6.00000E-01, 0 textcolor rgb '#404040'
plot $equal1_2 using 1:2 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $ends1_2 using ($3 == 1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $ends1_2 using ($3 == -1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $equal2_2 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' notitle, \
     $ends2_2 using ($3 == 1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_2 using ($3 == -1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_2 using ($3 == 2 ? $1 : NaN):2:4 with labels center offset 0, 1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_2 using ($3 == -2 ? $1 : NaN):2:4 with labels center offset 0, -1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle

set lmargin at screen 9.16670E-02; set rmargin at screen 4.75000E-01; set bmargin at screen 3.74530E-02; set tmargin at screen 4.26970E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel '' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'Camber, left, deg    (+ top outward)' offset 6.00000E-01, 0 textcolor rgb '#404040'
plot $equal1_3 using 1:2 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $ends1_3 using ($3 == 1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $ends1_3 using ($3 == -1 ? $1 : NaN):2:4 with labels right offset -7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $equal2_3 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' notitle, \
     $ends2_3 using ($3 == 1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_3 using ($3 == -1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_3 using ($3 == 2 ? $1 : NaN):2:4 with labels center offset 0, 1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_3 using ($3 == -2 ? $1 : NaN):2:4 with labels center offset 0, -1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle

set lmargin at screen 5.91670E-01; set rmargin at screen 9.75000E-01; set bmargin at screen 3.74530E-02; set tmargin at screen 4.26970E-01
set title '' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel '' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'Camber, right, deg    (+ top outward)' offset 6.00000E-01, 0 textcolor rgb '#404040'
plot $equal1_4 using 1:2 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
     $ends1_4 using ($3 == 1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $ends1_4 using ($3 == -1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#0072B2' notitle, \
     $equal2_4 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' notitle, \
     $ends2_4 using ($3 == 1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, 4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_4 using ($3 == -1 ? $1 : NaN):2:4 with labels left offset 7.00000E-01, -4.50000E-01 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_4 using ($3 == 2 ? $1 : NaN):2:4 with labels center offset 0, 1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle, \
     $ends2_4 using ($3 == -2 ? $1 : NaN):2:4 with labels center offset 0, -1.50000E+00 font ',12' textcolor rgb '#D55E00' notitle
set xtics; set border 3; set offsets 0, 0, 0, 0
unset multiplot
unset label
unset output
}
==== envelope
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
unset key
$travel1 << EOD
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
$steer1 << EOD
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
$axis1 << EOD
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
$travel2 << EOD
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
$steer2 << EOD
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
$axis2 << EOD
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

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1400, 788 font 'sans-serif,15' noenhanced }
if (format eq 'svg') { set terminal svg size 1400, 788 font 'sans-serif,15' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 28cm, 15cm font 'sans-serif,15' noenhanced }
set output 'travel_and_steering_envelope.'.format
set label 1 'Travel and steering: envelope of the wheels' at screen 2.00000E-02, screen 9.61930E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'push; blue: wheel centre, lines of equal wheel travel, orange: of equal rack_drive;'."\n".'grey: spin axis, 60 mm outboard' at screen 2.00000E-02, screen 9.23860E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set view equal xyz; set border 4095 linewidth 5.00000E-01 linecolor rgb '#C0C0C0'
unset xzeroaxis; unset yzeroaxis; unset grid

set lmargin at screen 7.85710E-02; set rmargin at screen 4.78570E-01; set bmargin at screen 1.01520E-01; set tmargin at screen 8.45180E-01
set title 'left wheel; z upward [mm]' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'x [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'y [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
unset lmargin; unset rmargin; unset bmargin; unset tmargin; set size 5.00000E-01, 9.00000E-01; set origin 0, 0
set xrange [-4.94502E+01 : 6.14502E+01]; set xtics 50
set yrange [-8.81450E+02 : -7.70550E+02]; set ytics 50
set zrange [-4.44502E+01 : 6.64502E+01]; set ztics 50
set xyplane at -4.44502E+01
set view 68, 320, 1.10000E+00
splot $axis1 using 1:2:3:4:5:6 with vectors nohead linewidth 1.50000E+00 linecolor rgb '#909090' notitle, \
      $travel1 using 1:2:3 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
      $steer1 using 1:2:3 with lines linewidth 2 linecolor rgb '#D55E00' notitle
unset label 1; unset label 2; unset label 9

set lmargin at screen 5.78570E-01; set rmargin at screen 9.78570E-01; set bmargin at screen 1.01520E-01; set tmargin at screen 8.45180E-01
set title 'right wheel; z upward [mm]' offset 0, -4.00000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set xlabel 'x [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'y [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
unset lmargin; unset rmargin; unset bmargin; unset tmargin; set size 5.00000E-01, 9.00000E-01; set origin 5.00000E-01, 0
set xrange [-6.13347E+01 : 4.93347E+01]; set xtics 50
set yrange [7.69665E+02 : 8.80335E+02]; set ytics 50
set zrange [-4.43347E+01 : 6.63347E+01]; set ztics 50
set xyplane at -4.43347E+01
set view 68, 220, 1.10000E+00
splot $axis2 using 1:2:3:4:5:6 with vectors nohead linewidth 1.50000E+00 linecolor rgb '#909090' notitle, \
      $travel2 using 1:2:3 with lines linewidth 2 linecolor rgb '#0072B2' notitle, \
      $steer2 using 1:2:3 with lines linewidth 2 linecolor rgb '#D55E00' notitle
unset multiplot
unset label
unset output
}
