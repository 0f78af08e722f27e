# mcpherson: design, and the ends of its travel
# Run gnuplot in this folder to redraw the picture; to rotate it: gnuplot -e "look=1" -p picture.gp
if (!exists('to')) to = '../'
reset
set encoding utf8
set view equal xyz
set view 70, 232, 2.10510E+00
set xrange [-9.36697E+02 : 3.88041E+02]
set yrange [-1.08304E+03 : 2.41698E+02]
set zrange [-5.44728E+02 : 7.80011E+02]
set xyplane at -5.44728E+02
unset border; unset tics; unset key
set pm3d depthorder noborder
set pm3d lighting primary 4.20000E-01 specular 1.20000E-01
$part1 << EOD
4 points of 1: 0 -6350 -3100, 3565 6920 3100, 6587
$part2 << EOD
1056 points of 264: 0 -7500 0, 1928 7542 1928, 459
$part3 << EOD
3 points of 1: 1000 -4867 -833, 1732 5139 843, 3776
$part4 << EOD
661 points of 190: 107 -7059 -122, 409 7086 1420, 282
$part5 << EOD
392 points of 105: 804 -5454 -873, 1338 5591 881, 270
$part6 << EOD
156 points of 42: 1400 -5100 -525, 1403 5259 531, 249
$part7 << EOD
1152 points of 288: 175 -5920 4000, 414 5933 4092, 147
$part8 << EOD
494 points of 136: 189 -5823 3336, 242 5826 3637, 267
$part9 << EOD
300 points of 90: 1100 -4333 1433, 1750 4428 3411, 203
$part10 << EOD
150 points of 45: 607 -7060 -813, 891 7062 844, 116
$part11 << EOD
80 points of 24: 750 -5400 -1775, 1073 5796 2224, 342
$line1 << EOD
69 points of 11: 91 -7083 899, 1923 7140 2365, 749
$line2 << EOD
69 points of 11: 65 -7022 -539, 1923 7077 2394, 749
$line3 << EOD
5 points of 1: -713 -6900 -3100, 3565 7407 3100, 6315
$line4 << EOD
6 points of 1: -3365 -2840 -2900, 3395 2875 2934, 1200
if (exists('look')) { set terminal qt size 1200, 800; set mouse } else { set terminal svg size 960, 640 dynamic font 'sans-serif,13' noenhanced; set output to.'picture.svg' }
set label 101 'front' at screen 5.05200E-01, screen 2.42800E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 102 'lca' at screen 3.88500E-01, screen 5.33600E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 102 from 100, -4.86670E+02, -8.33330E+01 to screen 4.02000E-01, screen 5.21800E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 103 'carrier' at screen 5.41900E-01, screen 6.29500E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 103 from 5, -675, 75 to screen 5.15300E-01, screen 6.17800E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 104 'strut' at screen 4.29600E-01, screen 7.73300E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 104 from 1.95000E+01, -581, 340 to screen 4.49900E-01, screen 7.73300E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 105 'tie rod' at screen 3.40700E-01, screen 5.18200E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 105 from 146, -402, -48 to screen 3.53100E-01, screen 5.06500E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 106 'coil' at screen 4.16100E-01, screen 8.58500E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set arrow 106 from 2.21000E+01, -580, 452 to screen 4.33000E-01, screen 8.58500E-01 nohead front linewidth 8.00000E-01 linecolor rgb '#7C8896'
set label 107 'x' at screen 4.22000E-01, screen 1.92300E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 108 'y' at screen 4.16300E-01, screen 1.48100E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
set label 109 'z' at screen 4.88000E-01, screen 2.66800E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
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
set object 9 rectangle center screen 3.61000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 1.20000E-02 fillcolor rgb '#30343B' fillstyle solid noborder
set label 9 'chassis' at screen 3.61000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 10 rectangle center screen 5.19000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 3.00000E-03 fillcolor rgb '#D55E00' fillstyle solid noborder
set label 10 'bump, +80 mm' at screen 5.19000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
set object 11 rectangle center screen 6.77000E-01, screen 3.50000E-02 size screen 2.40000E-02, screen 3.00000E-03 fillcolor rgb '#009E73' fillstyle solid noborder
set label 11 'rebound, -80 mm' at screen 6.77000E-01, screen 3.50000E-02 offset 2.40000E+00, 0 font ',12' textcolor rgb '#30343B'
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
      $part11 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
if (!exists('look')) { set terminal pngcairo size 1440, 960 font 'sans-serif,13' fontscale 1.25000E+00 linewidth 1.50000E+00 noenhanced; set output to.'picture.png'; replot; unset output }
