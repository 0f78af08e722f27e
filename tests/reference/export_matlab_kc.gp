set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.86490E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 5.40540E-01; set tmargin at screen 8.62610E-01
set title 'BumpSteer.FL' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [-1:1]
set border 3
plot $s1_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
    0*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 38 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'
unset label 1; unset label 2; unset label 9; unset key

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 5.40540E-01; set tmargin at screen 8.62610E-01
set title 'BumpCamber.FL' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s2_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     -3.95091E-02*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 51 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 5.40540E-01; set tmargin at screen 8.62610E-01
set title 'LatWhlCtrDisp.FL' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s3_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     -2.75349E-02*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 77 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 9.00900E-02; set tmargin at screen 4.12160E-01
set title 'LngWhlCtrDisp.FL' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [-1:1]
set border 3
plot $s4_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
    0*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 90 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 9.00900E-02; set tmargin at screen 4.12160E-01
set title 'NrmlWhlRates.FL' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'N' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s5_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'plane_axle_kandc.m' skip 103 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'
unset multiplot
unset label
unset output
}
