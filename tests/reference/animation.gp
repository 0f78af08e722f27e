# push: 36 pictures in sequence
if (!exists('to')) to = '../'
set terminal gif animate delay 7 loop 0 size 720, 540 font 'sans,12' noenhanced
set output to.'animation.gif'
reset
set encoding utf8
set view equal xyz
set view 70, 296, 2.48280E+00
set xrange [-1.03804E+03 : 1.00108E+03]
set yrange [-1.02858E+03 : 1.01055E+03]
set zrange [-1.07606E+03 : 9.63072E+02]
set xyplane at -1.07606E+03
unset border; unset tics; unset key
set pm3d depthorder noborder
set pm3d lighting primary 4.20000E-01 specular 1.20000E-01
$part4 << EOD
459 points of 133: -167 0 -897, 472 7640 1243, 368
$part5 << EOD
1504 points of 416: -177 0 75, 932 4973 1419, 276
$part6 << EOD
592 points of 160: -371 0 -93, 673 5459 1276, 264
$part7 << EOD
1536 points of 384: 50 0 2805, 372 3045 2830, 191
$part8 << EOD
302 points of 87: -140 0 2199, 465 2800 2588, 306
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -383 0 192, 769 5476 1561, 162
$line3 << EOD
201 points of 5: -33 -48 -665, 1998 8004 2029, 612
set label 99 'Parallel travel' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
$part4 << EOD
459 points of 133: -143 0 280, 468 7636 931, 368
$part5 << EOD
1504 points of 416: -169 0 542, 934 4895 1532, 276
$part6 << EOD
592 points of 160: -367 0 683, 668 5354 1487, 264
$part7 << EOD
1536 points of 384: 50 0 2833, 372 2576 2857, 190
$part8 << EOD
270 points of 79: -163 0 2146, 491 2407 2581, 291
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -376 0 903, 767 5433 1700, 162
$line3 << EOD
201 points of 5: -6 -48 505, 1998 7985 2027, 612
set label 99 'Parallel travel' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
$part4 << EOD
459 points of 133: -154 0 -307, 470 7688 926, 367
$part5 << EOD
1504 points of 416: -170 0 322, 932 4964 1467, 276
$part6 << EOD
592 points of 160: -363 0 314, 670 5470 1343, 264
$part7 << EOD
1536 points of 384: 50 0 2900, 372 2821 2923, 190
$part8 << EOD
302 points of 87: -140 0 2279, 465 2596 2674, 288
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -373 0 555, 768 5505 1586, 162
$line3 << EOD
201 points of 5: -18 -48 -80, 1998 8044 1940, 612
set label 99 'Parallel travel' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
$part4 << EOD
459 points of 133: -132 84 -304, 525 7622 924, 368
$part5 << EOD
1504 points of 416: -170 81 327, 932 4968 1468, 276
$part6 << EOD
592 points of 160: -332 209 320, 619 5480 1347, 264
$part7 << EOD
1536 points of 384: 50 -8 2900, 372 2816 2924, 190
$part8 << EOD
302 points of 87: -140 -7 2279, 465 2592 2674, 287
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -355 119 561, 743 5510 1589, 162
$line3 << EOD
201 points of 5: -16 -28 -80, 1773 7969 1940, 612
set label 99 'Steering' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
$part4 << EOD
459 points of 133: -132 -84 -304, 525 7622 924, 368
$part5 << EOD
1504 points of 416: -170 -81 327, 932 4968 1468, 276
$part6 << EOD
592 points of 160: -332 -209 320, 619 5480 1347, 264
$part7 << EOD
1536 points of 384: 50 8 2900, 372 2816 2924, 190
$part8 << EOD
302 points of 87: -140 7 2279, 465 2592 2674, 287
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -355 -119 561, 743 5510 1589, 162
$line3 << EOD
201 points of 5: -16 -67 -80, 1752 8025 1940, 612
set label 99 'Steering' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
$part4 << EOD
459 points of 133: -132 84 -304, 525 7622 924, 368
$part5 << EOD
1504 points of 416: -170 81 327, 932 4968 1468, 276
$part6 << EOD
592 points of 160: -332 209 320, 619 5480 1347, 264
$part7 << EOD
1536 points of 384: 50 -8 2900, 372 2816 2924, 190
$part8 << EOD
302 points of 87: -140 -7 2279, 465 2592 2674, 287
$part9 << EOD
400 points of 120: 125 0 -38, 1670 3914 1196, 270
$part10 << EOD
800 points of 240: -355 119 561, 743 5510 1589, 162
$line3 << EOD
201 points of 5: -16 -28 -80, 1773 7969 1940, 612
set label 99 'Steering' at screen 3.00000E-02, screen 5.00000E-02
set label 101 'front' at screen 4.70500E-01, screen 3.42900E-01 center front font 'sans-serif,11' textcolor rgb '#30343B'
splot $line3 using 1:2:3 with lines linecolor rgb '#C4CCD4' linewidth 1.30000E+00 notitle, \
      $part4 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#7C8896' notitle, \
      $part5 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#3B76B5' notitle, \
      $part6 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#1B9E8A' notitle, \
      $part7 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#C8442F' notitle, \
      $part8 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#A9B4C0' notitle, \
      $part9 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#E8A33D' notitle, \
      $part10 using 1:2:3 with polygons fillstyle solid noborder fillcolor rgb '#30343B' notitle, \
      1/0 notitle
