set multiplot layout 2, 3 title 'axle of two plane four-bars: matlab-kc'
   set title 'BumpSteer.FL'
   set xlabel 'wheel centre, height [mm]'
   set ylabel 'deg'
   set yrange [-1:1]
   plot $curve1 using 1:2 with lines linecolor rgb '#D55E00' linewidth 2 title 'solved separately', \
     0*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 38 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'
   set title 'BumpCamber.FL'
   set xlabel 'wheel centre, height [mm]'
   set ylabel 'deg'
   set yrange [*:*]
   plot $curve2 using 1:2 with lines linecolor rgb '#D55E00' linewidth 2 title '', \
      -3.95091E-02*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 51 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title ''
   set title 'LatWhlCtrDisp.FL'
   set xlabel 'wheel centre, height [mm]'
   set ylabel 'mm'
   set yrange [*:*]
   plot $curve3 using 1:2 with lines linecolor rgb '#D55E00' linewidth 2 title '', \
      -2.75349E-02*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 77 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title ''
   set title 'LngWhlCtrDisp.FL'
   set xlabel 'wheel centre, height [mm]'
   set ylabel 'mm'
   set yrange [-1:1]
   plot $curve4 using 1:2 with lines linecolor rgb '#D55E00' linewidth 2 title '', \
     0*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title '', 'plane_axle_kandc.m' skip 90 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title ''
   set title 'NrmlWhlRates.FL'
   set xlabel 'wheel centre, height [mm]'
   set ylabel 'N'
   set yrange [*:*]
   plot $curve5 using 1:2 with lines linecolor rgb '#D55E00' linewidth 2 title '', \
      'plane_axle_kandc.m' skip 103 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title ''
   unset multiplot
unset output
}
