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
-60 1.14152E+00
-40 4.74632E-01
-20 -2.37444E-01
0 -1
20 -1.81964E+00
40 -2.70454E+00
60 -3.66488E+00
80 -4.71336E+00


0 -1


EOD
set output 'centre_camber_deg.svg'
set label 1 'Camber' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'deg    (+ top outward)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -2.33205E+01
-60 -1.59366E+01
-40 -9.62605E+00
-20 -4.33000E+00
0 0
20 3.40407E+00
40 5.91563E+00
60 7.56276E+00
80 8.36921E+00


0 0


EOD
set output 'centre_track_change_mm.svg'
set label 1 'Half-track change' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (contact point, + outward)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -1.76256E+03
-60 -1.30852E+03
-40 -8.67005E+02
-20 -4.32389E+02
0 0
20 4.34128E+02
40 8.73445E+02
60 1.32102E+03
80 1.77965E+03


0 0


EOD
set output 'centre_vertical_force_n.svg'
set label 1 'Wheel load' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'N    (ground on wheel)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 2.31244E+01
-60 2.23370E+01
-40 2.18608E+01
-20 2.16395E+01
0 2.16322E+01
20 2.18092E+01
40 2.21481E+01
60 2.26327E+01
80 2.32518E+01


0 2.16322E+01


EOD
set output 'centre_wheel_rate_n_per_mm.svg'
set label 1 'Wheel rate' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'N/mm    (wheels in parallel travel)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 3.03005E+02
-60 2.62944E+02
-40 2.24304E+02
-20 1.86894E+02
0 1.50577E+02
20 1.15267E+02
40 8.09221E+01
60 4.75460E+01
80 1.51967E+01


0 1.50577E+02


EOD
set output 'centre_roll_centre_height_mm.svg'
set label 1 'Roll centre height' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (+ above the ground)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.93802E+03
-60 1.79752E+03
-40 1.67177E+03
-20 1.55718E+03
0 1.45130E+03
20 1.35237E+03
40 1.25910E+03
60 1.17053E+03
80 1.08594E+03


0 1.45130E+03


EOD
set output 'centre_front_view_arm_length_mm.svg'
set label 1 'Front-view swing arm length' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [-20000 < * : * < 20000]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 7.11543E+00
-60 5.35469E+00
-40 3.87912E+00
-20 2.67482E+00
0 1.72277E+00
20 1.00183E+00
40 4.90627E-01
60 1.68723E-01
80 1.72361E-02


0 1.72277E+00


EOD
set output 'centre_lateral_in_load_held_deflection_mm_per_kn.svg'
set label 1 'Lateral deflection' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm/kN    (in phase, load constant)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 5.43250E-01
-60 5.05807E-01
-40 4.61054E-01
-20 4.09837E-01
0 3.52446E-01
20 2.88652E-01
40 2.17699E-01
60 1.38224E-01
80 4.81167E-02


0 3.52446E-01


-80 -5.43250E-01
-60 -5.05807E-01
-40 -4.61054E-01
-20 -4.09837E-01
0 -3.52446E-01
20 -2.88652E-01
40 -2.17699E-01
60 -1.38224E-01
80 -4.81167E-02


0 -3.52446E-01


EOD
set output 'centre_lateral_in_load_held_camber_deg_per_kn.svg'
set label 1 'Lateral force camber' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'deg/kN    (in phase, load constant)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 dashtype (10, 6) linecolor rgb '#D55E00' notitle, \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.51336E+03
-60 1.52813E+03
-40 1.54075E+03
-20 1.55134E+03
0 1560
20 1.56681E+03
40 1.57183E+03
60 1.57513E+03
80 1.57674E+03


0 1560


EOD
set output 'centre_total_track_mm.svg'
set label 1 'Total track' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'mm    (distance of the contact points)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
unset key
set tmargin at screen 8.20000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' notitle, \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -6.01024E-01
-60 -5.99975E-01
-40 -5.99615E-01
-20 -5.99810E-01
0 -6.00448E-01
20 -6.01425E-01
40 -6.02643E-01
60 -6.04003E-01
80 -6.05401E-01


0 -6.00448E-01


-80 2.84802E-01
-60 2.09225E-01
-40 1.37143E-01
-20 6.76554E-02
0 0
20 -6.65008E-02
40 -1.32477E-01
60 -1.98551E-01
80 -2.65369E-01


0 0


EOD
set output 'centre_motion_ratio.svg'
set label 1 'Motion ratio' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'd(length)/d(wheel travel)    (− shortens in bump)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'coil (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'across', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 -2.87994E+03
-60 -2.15941E+03
-40 -1.43972E+03
-20 -7.20116E+02
0 0
20 7.21095E+02
40 1.44352E+03
60 2.16750E+03
80 2.89314E+03


0 0


-80 2.22213E+02
-60 1.23541E+02
-40 5.43682E+01
-20 1.34817E+01
0 0
20 1.33280E+01
40 5.31308E+01
60 1.19323E+02
80 2.12071E+02


0 0


EOD
set output 'centre_force.svg'
set label 1 'Springs, dampers, stops' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'force, N    (+ compression)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 1
set tmargin at screen 7.60000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'coil (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#D55E00' title 'across', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle

$data << EOD
-80 1.25036E+03
-60 9.48843E+02
-40 6.39197E+02
-20 3.22502E+02
0 0
20 3.26849E+02
40 6.56302E+02
60 9.86268E+02
80 1.31424E+03


0 0


-80 2.86718E+02
-60 2.04819E+02
-40 1.30740E+02
-20 6.28387E+01
0 0
20 5.84624E+01
40 1.12853E+02
60 1.63088E+02
80 2.08647E+02


0 0


-80 1.74037E+03
-60 1.31025E+03
-40 8.79208E+02
-20 4.43525E+02
0 0
20 4.54134E+02
40 9.21226E+02
60 1.40318E+03
80 1.90141E+03


0 0


-80 2.86718E+02
-60 2.04819E+02
-40 1.30740E+02
-20 6.28387E+01
0 0
20 5.84624E+01
40 1.12853E+02
60 1.63088E+02
80 2.08647E+02


0 0


EOD
set output 'centre_bushings.svg'
set label 1 'Bushings and joints' at screen 2.00000E-02, screen 9.45000E-01 font 'sans-serif:Bold,15' textcolor rgb '#202020'
set label 2 'force, magnitude, N    (the 8 largest of 10)' at screen 2.00000E-02, screen 8.75000E-01 font ',12' textcolor rgb '#606060'
set xlabel 'wheel travel [mm]    (+ bump)' offset 0, 6.50000E-01 font ',12' textcolor rgb '#606060'
set yrange [*:*]
unset object; unset label 3
set key at screen 2.00000E-02, screen 8.45000E-01 left top vertical Left reverse samplen 1.60000E+00 spacing 1 width -1 font ',11' textcolor rgb '#404040' maxrows 2
set tmargin at screen 7.10000E-01
plot $data index 0 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#0072B2' title 'lca_hinge (left = right)', \
     $data index 1 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 2 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#009E73' title 'uca_hinge (left = right)', \
     $data index 3 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 4 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#E69F00' title 'lower_ball (left = right)', \
     $data index 5 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle, \
     $data index 6 using 1:2 with lines linewidth 2.20000E+00 linecolor rgb '#4D4D4D' title 'upper_ball (left = right)', \
     $data index 7 using 1:2 with points pointtype 6 pointsize 9.00000E-01 linewidth 1.60000E+00 linecolor rgb '#202020' notitle
unset output
