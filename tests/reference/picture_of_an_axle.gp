# push: design, and the ends of its travel
# Run gnuplot in this folder to redraw the picture; to rotate it: gnuplot -e "look=1" -p picture.gp
if (!exists('to')) to = '../'
reset
set encoding utf8
set view equal xyz
set view 70, 296, 2.86400E+00
set xrange [-1.15363E+03 : 1.04712E+03]
set yrange [-1.06635E+03 : 1.13440E+03]
set zrange [-1.19090E+03 : 1.00984E+03]
set xyplane at -1.19090E+03
unset border; unset tics; unset key
set pm3d depthorder noborder
set pm3d lighting primary 4.20000E-01 specular 1.20000E-01
$part1 << EOD
4 points of 1: 0 0 -3200, 3680 9620 3200, 11320
$part2 << EOD
2112 points of 528: 0 0 0, 1990 8042 1990, 474
$part3 << EOD
12 points of 4: 95 0 -25, 1351 5266 1263, 3512
$part4 << EOD
871 points of 253: -136 0 -275, 443 7736 879, 296
$part5 << EOD
2632 points of 728: -170 0 322, 932 4964 1467, 239
$part6 << EOD
888 points of 240: -363 0 314, 670 5470 1343, 243
$part7 << EOD
2304 points of 576: 50 0 2900, 372 2821 2923, 147
$part8 << EOD
538 points of 155: -142 0 2273, 469 2656 2672, 239
$part9 << EOD
800 points of 240: 125 0 -37, 1670 3914 1196, 203
$part10 << EOD
1480 points of 444: -376 0 564, 776 5514 1585, 124
$part12 << EOD
320 points of 96: 50 0 2900, 124 1839 2902, 194
$line1 << EOD
162 points of 34: -66 0 656, 1848 7096 2082, 885
$line2 << EOD
162 points of 34: -86 0 -338, 1848 7133 2057, 885
$line3 << EOD
5 points of 1: -736 -1924 -3200, 3680 9620 3200, 13300
$line4 << EOD
6 points of 1: -3480 9820 -3000, 3509 9830 3033, 1200
if (exists('look')) { set terminal qt size 1200, 800; set mouse } else { set terminal svg size 960, 640 dynamic font 'sans-serif,13' noenhanced; set output to.'picture.svg' }
set label 101 'front' at screen 4.91600E-01, screen 3.63400E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 102 'lca' at screen 7.27000E-01, screen 3.99600E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 102 from 5, -5.37500E+02, -1.23750E+02 to screen 7.37200E-01, screen 4.11300E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 103 'uca' at screen 7.53000E-01, screen 6.56500E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 103 from 14, -5.16670E+02, 1.23330E+02 to screen 7.39600E-01, screen 6.44800E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 104 'carrier' at screen 8.64900E-01, screen 5.69000E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 104 from 6, -755, 70 to screen 8.37800E-01, screen 5.57300E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 105 'rocker' at screen 6.51000E-01, screen 6.58000E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 105 from 5, -3.82500E+02, 260 to screen 6.74800E-01, screen 6.69700E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 106 'arb' at screen 6.47600E-01, screen 5.26000E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 107 'rack' at screen 5.91900E-01, screen 5.14700E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 108 'tie rod' at screen 6.77500E-01, screen 3.98700E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 108 from -111, -443, -87 to screen 6.77500E-01, screen 4.10400E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 109 'push rod' at screen 7.67600E-01, screen 5.12600E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 110 'drop link' at screen 7.41400E-01, screen 6.86000E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 110 from 5, -450, 196 to screen 7.07300E-01, screen 6.74200E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 111 'coil' at screen 6.38700E-01, screen 7.86600E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 111 from 5, -2.27500E+02, 290 to screen 6.21800E-01, screen 7.74900E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 112 'damper' at screen 5.49900E-01, screen 7.51600E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 113 'x' at screen 9.90500E-02, screen 4.47200E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 114 'y' at screen 2.62100E-02, screen 4.27200E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 115 'z' at screen 8.42100E-02, screen 4.85200E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set object 1 rectangle center screen 4.50000E-02, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#CCCCCC' fillstyle solid noborder
set label 1 'wheel' at screen 4.50000E-02, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 2 rectangle center screen 2.03000E-01, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#7C8896' fillstyle solid noborder
set label 2 'wheel carrier' at screen 2.03000E-01, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 3 rectangle center screen 3.61000E-01, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#3B76B5' fillstyle solid noborder
set label 3 'arms' at screen 3.61000E-01, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 4 rectangle center screen 5.19000E-01, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#1B9E8A' fillstyle solid noborder
set label 4 'rods' at screen 5.19000E-01, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 5 rectangle center screen 6.77000E-01, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#C8442F' fillstyle solid noborder
set label 5 'springs' at screen 6.77000E-01, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 6 rectangle center screen 8.35000E-01, screen 7.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#A9B4C0' fillstyle solid noborder
set label 6 'struts, dampers' at screen 8.35000E-01, screen 7.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 7 rectangle center screen 4.50000E-02, screen 3.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#E8A33D' fillstyle solid noborder
set label 7 'bushings' at screen 4.50000E-02, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 8 rectangle center screen 2.03000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#30343B' fillstyle solid noborder
set label 8 'joints' at screen 2.03000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 9 rectangle center screen 3.61000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#8E6BBE' fillstyle solid noborder
set label 9 'stops' at screen 3.61000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 10 rectangle center screen 5.19000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 3.00000E-03 fillcolor rgb '#D55E00' fillstyle solid noborder
set label 10 'bump, +60 mm' at screen 5.19000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 11 rectangle center screen 6.77000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 3.00000E-03 fillcolor rgb '#009E73' fillstyle solid noborder
set label 11 'rebound, -60 mm' at screen 6.77000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
splot $line1 using 1:2:3 with lines linecolor rgb '#D55E00' linewidth 1.30000E+00 notitle, \
      $line2 using 1:2:3 with lines linecolor rgb '#009E73' linewidth 1.30000E+00 notitle, \
      $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $line4 using 1:2:3 with lines linecolor rgb '#30343B' linewidth 1.30000E+00 notitle, \
      $part1 using 1:2:3 with polygons fillstyle transparent solid 3.50000E-01 noborder fillcolor rgb '#E9EEF2' notitle, \
      $part2 using 1:2:3 with polygons fillstyle transparent solid 1.60000E-01 noborder fillcolor rgb '#4A4A4A' notitle, \
      $part3 using 1:2:3 with polygons fillstyle transparent solid 2.20000E-01 noborder fillcolor rgb '#3B76B5' notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      $part12 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#8E6BBE' notitle, \
      1/0 notitle
if (!exists('look')) { set terminal pngcairo size 1440, 960 font 'sans-serif,13' fontscale 1.25000E+00 linewidth 1.50000E+00 noenhanced; set output to.'picture.png'; replot; unset output }
