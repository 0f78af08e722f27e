# The charts of a page. Run gnuplot in this folder to draw them again.
reset
set encoding utf8
set terminal svg size 460, 330 dynamic font 'sans-serif,13' linewidth 1 noenhanced
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set lmargin at screen 1.35000E-01; set rmargin at screen 9.65000E-01; set bmargin at screen 1.65000E-01
set xtics font ',12' offset 0, 2.50000E-01; set ytics font ',12'

$data << EOD
-80 1.76738E+00
-40 4.74632E-01
0 -1
40 -2.70454E+00
80 -4.71336E+00


0 -1


EOD
set output 'centre_camber_deg.svg'
set label 1 'Camber' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'deg    (+ top outward)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = B = C, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -2.33205E+01
-40 -9.62605E+00
0 0
40 5.91563E+00
80 8.36921E+00


0 0


EOD
set output 'centre_track_change_mm.svg'
set label 1 'Half-track change' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (contact point, + outward)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = B = C, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -1.76256E+03
-40 -8.67005E+02
0 0
40 8.73445E+02
80 1.77965E+03


0 0


-80 -1.69367E+03
-40 -8.42339E+02
0 0
40 8.70487E+02
80 1.80069E+03


0 0


-80 -1.66642E+03
-40 -8.28591E+02
0 0
40 8.56275E+02
80 1.77163E+03


0 0


-80 -1.83607E+03
-40 -8.97645E+02
0 0
40 9.04202E+02
80 1.85210E+03


0 0


-80 -1.77838E+03
-40 -8.68869E+02
0 0
40 8.75205E+02
80 1.79372E+03


0 0


EOD
set output 'centre_vertical_force_n.svg'
set label 1 'Wheel load' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'N    (ground on wheel)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 3
set tmargin at screen 6.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'B, left', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#D55E00' title 'B, right', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'C, left', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#009E73' title 'C, right', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 2.31244E+01
-40 2.18608E+01
0 2.16322E+01
40 2.21481E+01
80 2.32518E+01


0 2.16322E+01


-80 2.17831E+01
-40 2.09984E+01
0 2.12721E+01
40 2.23835E+01
80 2.42640E+01


0 2.12721E+01


-80 2.14309E+01
-40 2.06552E+01
0 2.09234E+01
40 2.20174E+01
80 2.38702E+01


0 2.09234E+01


-80 2.44986E+01
-40 2.27277E+01
0 2.23533E+01
40 2.30143E+01
80 2.45427E+01


0 2.23533E+01


-80 2.37231E+01
-40 2.19976E+01
0 2.16322E+01
40 2.22746E+01
80 2.37628E+01


0 2.16322E+01


EOD
set output 'centre_wheel_rate_n_per_mm.svg'
set label 1 'Wheel rate' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'N/mm    (wheels in parallel travel)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 3
set tmargin at screen 6.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'B, left', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#D55E00' title 'B, right', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'C, left', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#009E73' title 'C, right', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 3.03005E+02
-40 2.24304E+02
0 1.50577E+02
40 8.09221E+01
80 1.51967E+01


0 1.50577E+02


EOD
set output 'centre_roll_centre_height_mm.svg'
set label 1 'Roll centre height' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (+ above the ground)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = B = C', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.93802E+03
-40 1.67177E+03
0 1.45130E+03
40 1.25910E+03
80 1.08594E+03


0 1.45130E+03


EOD
set output 'centre_front_view_arm_length_mm.svg'
set label 1 'Front-view swing arm length' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [-20000 < * : * < 20000]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = B = C, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 7.11543E+00
-40 3.87912E+00
0 1.72277E+00
40 4.90627E-01
80 1.72361E-02


0 1.72277E+00


-80 7.57927E+00
-40 4.04086E+00
0 1.75194E+00
40 4.85494E-01
80 1.65010E-02


0 1.75194E+00


-80 7.69827E+00
-40 4.10728E+00
0 1.78114E+00
40 4.93489E-01
80 1.67638E-02


0 1.78114E+00


-80 6.85241E+00
-40 3.75007E+00
0 1.66720E+00
40 4.74364E-01
80 1.66163E-02


0 1.66720E+00


-80 7.06289E+00
-40 3.87265E+00
0 1.72277E+00
40 4.89896E-01
80 1.71331E-02


0 1.72277E+00


EOD
set output 'centre_lateral_in_load_held_deflection_mm_per_kn.svg'
set label 1 'Lateral deflection' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm/kN    (in phase, load constant)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 3
set tmargin at screen 6.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, left = right', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'B, left', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#D55E00' title 'B, right', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'C, left', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#009E73' title 'C, right', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 5.43250E-01
-40 4.61054E-01
0 3.52446E-01
40 2.17699E-01
80 4.81167E-02


0 3.52446E-01


-80 -5.43250E-01
-40 -4.61054E-01
0 -3.52446E-01
40 -2.17699E-01
80 -4.81167E-02


0 -3.52446E-01


-80 5.78663E-01
-40 4.80278E-01
0 3.58413E-01
40 2.15421E-01
80 4.60647E-02


0 3.58413E-01


-80 -5.87749E-01
-40 -4.88173E-01
0 -3.64387E-01
40 -2.18969E-01
80 -4.67983E-02


0 -3.64387E-01


-80 5.23169E-01
-40 4.45716E-01
0 3.41077E-01
40 2.10482E-01
80 4.63867E-02


0 3.41077E-01


-80 -5.39239E-01
-40 -4.60285E-01
0 -3.52446E-01
40 -2.17374E-01
80 -4.78294E-02


0 -3.52446E-01


EOD
set output 'centre_lateral_in_load_held_camber_deg_per_kn.svg'
set label 1 'Lateral force camber' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'deg/kN    (in phase, load constant)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 2
set tmargin at screen 7.10000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, left', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#0072B2' title 'A, right', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'B, left', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#D55E00' title 'B, right', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'C, left', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 10 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#009E73' title 'C, right', \
     $data index 11 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.51336E+03
-40 1.54075E+03
0 1560
40 1.57183E+03
80 1.57674E+03


0 1560


EOD
set output 'centre_total_track_mm.svg'
set label 1 'Total track' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (distance of the contact points)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = B = C', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -6.01024E-01
-40 -5.99615E-01
0 -6.00448E-01
40 -6.02643E-01
80 -6.05401E-01


0 -6.00448E-01


-80 2.84802E-01
-40 1.37143E-01
0 0
40 -1.32477E-01
80 -2.65369E-01


0 0


-80 -5.81831E-01
-40 -5.84950E-01
0 -5.90527E-01
40 -5.98035E-01
80 -6.07106E-01


0 -5.90527E-01


EOD
set output 'centre_motion_ratio.svg'
set label 1 'Motion ratio' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'd(length)/d(wheel travel)    (− shortens in bump)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 2
set tmargin at screen 7.10000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A = C, coil (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'A = B = C, across', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#0072B2' title 'B, coil (left = right)', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -2.87994E+03
-40 -1.43972E+03
0 0
40 1.44352E+03
80 2.89314E+03


0 0


-80 2.22213E+02
-40 5.43682E+01
0 0
40 5.31308E+01
80 2.12071E+02


0 0


-80 -2.85655E+03
-40 -1.43364E+03
0 0
40 1.44969E+03
80 2.91968E+03


0 0


-80 -2.80972E+03
-40 -1.41014E+03
0 0
40 1.42593E+03
80 2.87182E+03


0 0


-80 -2.97593E+03
-40 -1.48771E+03
0 0
40 1.49163E+03
80 2.98958E+03


0 0


-80 -2.87994E+03
-40 -1.43972E+03
0 0
40 1.44352E+03
80 2.89314E+03


0 0


-80 3.33320E+02
-40 8.15523E+01
0 0
40 7.96962E+01
80 3.18106E+02


0 0


EOD
set output 'centre_force.svg'
set label 1 'Springs, dampers, stops' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'force, N    (+ compression)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 4
set tmargin at screen 6.10000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, coil (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'A = B, across', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#0072B2' title 'B, left_coil', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 4, 2, 4) linecolor rgb '#0072B2' title 'B, right_coil', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'C, left_coil', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 10 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#0072B2' title 'C, right_coil', \
     $data index 11 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 12 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'C, across', \
     $data index 13 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.25036E+03
-40 6.39197E+02
0 0
40 6.56302E+02
80 1.31424E+03


0 0


-80 2.86718E+02
-40 1.30740E+02
0 0
40 1.12853E+02
80 2.08647E+02


0 0


-80 1.74037E+03
-40 8.79208E+02
0 0
40 9.21226E+02
80 1.90141E+03


0 0


-80 2.86718E+02
-40 1.30740E+02
0 0
40 1.12853E+02
80 2.08647E+02


0 0


-80 1351
-40 6.98430E+02
0 0
40 7.35190E+02
80 1.49358E+03


0 0


-80 1.32664E+03
-40 6.86411E+02
0 0
40 7.23740E+02
80 1.47157E+03


0 0


-80 2.75512E+02
-40 1.27021E+02
0 0
40 1.12470E+02
80 2.11114E+02


0 0


-80 2.71080E+02
-40 1.24948E+02
0 0
40 1.10634E+02
80 2.07707E+02


0 0


-80 1.67235E+03
-40 8.54194E+02
0 0
40 9.18106E+02
80 1.92389E+03


0 0


-80 1.64544E+03
-40 8.40253E+02
0 0
40 9.03116E+02
80 1.89285E+03


0 0


-80 2.75512E+02
-40 1.27021E+02
0 0
40 1.12470E+02
80 2.11114E+02


0 0


-80 2.71080E+02
-40 1.24948E+02
0 0
40 1.10634E+02
80 2.07707E+02


0 0


-80 1.24437E+03
-40 6.47639E+02
0 0
40 6.92477E+02
80 1.41729E+03


0 0


-80 1.19966E+03
-40 6.25455E+02
0 0
40 6.71657E+02
80 1.37799E+03


0 0


-80 2.98677E+02
-40 1.35361E+02
0 0
40 1.16826E+02
80 2.17141E+02


0 0


-80 2.89292E+02
-40 1.31022E+02
0 0
40 1.13080E+02
80 2.10296E+02


0 0


-80 1.81296E+03
-40 9.10279E+02
0 0
40 9.53665E+02
80 1.97882E+03


0 0


-80 1.75599E+03
-40 8.81098E+02
0 0
40 9.23082E+02
80 1.91644E+03


0 0


-80 2.98677E+02
-40 1.35361E+02
0 0
40 1.16826E+02
80 2.17141E+02


0 0


-80 2.89292E+02
-40 1.31022E+02
0 0
40 1.13080E+02
80 2.10296E+02


0 0


EOD
set output 'centre_bushings.svg'
set label 1 'Bushings and joints' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'force, magnitude, N    (the 8 largest of 10)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 10
set tmargin at screen 3.10000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'A, lca_hinge (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'A, uca_hinge (left = right)', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#E69F00' title 'A, lower_ball (left = right)', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#4D4D4D' title 'A, upper_ball (left = right)', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 8 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#0072B2' title 'B, left_lca_hinge', \
     $data index 9 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 10 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#D55E00' title 'B, right_lca_hinge', \
     $data index 11 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 12 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#009E73' title 'B, left_uca_hinge', \
     $data index 13 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 14 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#CC79A7' title 'B, right_uca_hinge', \
     $data index 15 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 16 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#E69F00' title 'B, left_lower_ball', \
     $data index 17 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 18 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#56B4E9' title 'B, right_lower_ball', \
     $data index 19 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 20 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#4D4D4D' title 'B, left_upper_ball', \
     $data index 21 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 22 using 1:2 with lines linewidth 2.20000E+00 dashtype (2, 4) linecolor rgb '#8C510A' title 'B, right_upper_ball', \
     $data index 23 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 24 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'C, left_lca_hinge', \
     $data index 25 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 26 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'C, right_lca_hinge', \
     $data index 27 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 28 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'C, left_uca_hinge', \
     $data index 29 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 30 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#CC79A7' title 'C, right_uca_hinge', \
     $data index 31 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 32 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#E69F00' title 'C, left_lower_ball', \
     $data index 33 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 34 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#56B4E9' title 'C, right_lower_ball', \
     $data index 35 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 36 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#4D4D4D' title 'C, left_upper_ball', \
     $data index 37 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 38 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#8C510A' title 'C, right_upper_ball', \
     $data index 39 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle
unset output
