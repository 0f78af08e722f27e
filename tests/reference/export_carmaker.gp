# Front axle with push rods and rockers: carmaker
#
#     gnuplot push_carmaker.gp
#
# in this folder draws push_carmaker.png and .svg;
# gnuplot -e "formats='pdf'" push_carmaker.gp makes a PDF.
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
-9.99434E+00 2.36250E-01
-9.68192E+00 2.28817E-01
-9.36949E+00 2.21387E-01
-9.05708E+00 2.13960E-01
-8.74467E+00 2.06537E-01
-8.43227E+00 1.99117E-01
-8.11987E+00 1.91700E-01
-7.80748E+00 1.84287E-01
-7.49510E+00 1.76877E-01
-7.18273E+00 1.69470E-01
-6.87036E+00 1.62066E-01
-6.55800E+00 1.54666E-01
-6.24564E+00 1.47269E-01
-5.93329E+00 1.39875E-01
-5.62095E+00 1.32485E-01
-5.30861E+00 1.25097E-01
-4.99629E+00 1.17713E-01
-4.68396E+00 1.10332E-01
-4.37165E+00 1.02955E-01
-4.05934E+00 9.55801E-02
-3.74704E+00 8.82089E-02
-3.43475E+00 8.08408E-02
-3.12247E+00 7.34760E-02
-2.81019E+00 6.61142E-02
-2.49791E+00 5.87557E-02
-2.18565E+00 5.14003E-02
-1.87339E+00 4.40481E-02
-1.56114E+00 3.66989E-02
-1.24890E+00 2.93529E-02
-9.36663E-01 2.20101E-02
-6.24435E-01 1.46703E-02
-3.12213E-01 7.33360E-03
0 0
3.07403E-01 -7.21777E-03
6.14799E-01 -1.44326E-02
9.22187E-01 -2.16444E-02
1.22957E+00 -2.88533E-02
1.53694E+00 -3.60593E-02
1.84431E+00 -4.32623E-02
2.15167E+00 -5.04624E-02
2.45902E+00 -5.76596E-02
2.76636E+00 -6.48539E-02
3.07370E+00 -7.20454E-02
3.38103E+00 -7.92339E-02
3.68835E+00 -8.64196E-02
3.99566E+00 -9.36025E-02
4.30297E+00 -1.00782E-01
4.61027E+00 -1.07960E-01
4.91756E+00 -1.15134E-01
5.22484E+00 -1.22306E-01
5.53212E+00 -1.29474E-01
5.83939E+00 -1.36640E-01
6.14665E+00 -1.43804E-01
6.45390E+00 -1.50964E-01
6.76114E+00 -1.58122E-01
7.06838E+00 -1.65277E-01
7.37561E+00 -1.72430E-01
7.68283E+00 -1.79579E-01
7.99004E+00 -1.86726E-01
8.29724E+00 -1.93871E-01
8.60444E+00 -2.01012E-01
8.91163E+00 -2.08151E-01
9.21881E+00 -2.15288E-01
9.52598E+00 -2.22422E-01
9.83314E+00 -2.29553E-01
1.01403E+01 -2.36682E-01
1.04474E+01 -2.43808E-01
1.07546E+01 -2.50932E-01
1.10617E+01 -2.58053E-01
1.13688E+01 -2.65172E-01
1.16759E+01 -2.72288E-01
1.19831E+01 -2.79402E-01
1.22901E+01 -2.86513E-01
1.25972E+01 -2.93622E-01
1.29043E+01 -3.00728E-01
1.32114E+01 -3.07832E-01
1.35184E+01 -3.14934E-01
1.38255E+01 -3.22033E-01
1.41325E+01 -3.29130E-01
1.44396E+01 -3.36225E-01
1.47466E+01 -3.43318E-01
1.50536E+01 -3.50408E-01
1.53606E+01 -3.57496E-01
1.56676E+01 -3.64582E-01
1.59746E+01 -3.71665E-01
1.62816E+01 -3.78747E-01
1.65886E+01 -3.85826E-01
1.68955E+01 -3.92903E-01
1.72025E+01 -3.99979E-01
1.75094E+01 -4.07052E-01
1.78164E+01 -4.14123E-01
1.81233E+01 -4.21192E-01
1.84302E+01 -4.28259E-01
1.87371E+01 -4.35324E-01
1.90440E+01 -4.42387E-01
1.93509E+01 -4.49448E-01
1.96578E+01 -4.56507E-01
1.99647E+01 -4.63565E-01
EOD
$s2_1 << EOD
-9.99434E+00 3.34655E-02
-9.68192E+00 3.67308E-02
-9.36949E+00 3.97174E-02
-9.05708E+00 4.24255E-02
-8.74467E+00 4.48550E-02
-8.43227E+00 4.70060E-02
-8.11987E+00 4.88786E-02
-7.80748E+00 5.04729E-02
-7.49510E+00 5.17888E-02
-7.18273E+00 5.28264E-02
-6.87036E+00 5.35858E-02
-6.55800E+00 5.40670E-02
-6.24564E+00 5.42702E-02
-5.93329E+00 5.41952E-02
-5.62095E+00 5.38422E-02
-5.30861E+00 5.32113E-02
-4.99629E+00 5.23024E-02
-4.68396E+00 5.11157E-02
-4.37165E+00 4.96511E-02
-4.05934E+00 4.79088E-02
-3.74704E+00 4.58887E-02
-3.43475E+00 4.35909E-02
-3.12247E+00 4.10155E-02
-2.81019E+00 3.81625E-02
-2.49791E+00 3.50319E-02
-2.18565E+00 3.16238E-02
-1.87339E+00 2.79382E-02
-1.56114E+00 2.39752E-02
-1.24890E+00 1.97348E-02
-9.36663E-01 1.52170E-02
-6.24435E-01 1.04219E-02
-3.12213E-01 5.34959E-03
0 0
3.07403E-01 -5.53813E-03
6.14799E-01 -1.13450E-02
9.22187E-01 -1.74205E-02
1.22957E+00 -2.37646E-02
1.53694E+00 -3.03773E-02
1.84431E+00 -3.72586E-02
2.15167E+00 -4.44085E-02
2.45902E+00 -5.18268E-02
2.76636E+00 -5.95136E-02
3.07370E+00 -6.74689E-02
3.38103E+00 -7.56926E-02
3.68835E+00 -8.41846E-02
3.99566E+00 -9.29450E-02
4.30297E+00 -1.01974E-01
4.61027E+00 -1.11271E-01
4.91756E+00 -1.20836E-01
5.22484E+00 -1.30670E-01
5.53212E+00 -1.40771E-01
5.83939E+00 -1.51142E-01
6.14665E+00 -1.61780E-01
6.45390E+00 -1.72686E-01
6.76114E+00 -1.83860E-01
7.06838E+00 -1.95303E-01
7.37561E+00 -2.07014E-01
7.68283E+00 -2.18992E-01
7.99004E+00 -2.31239E-01
8.29724E+00 -2.43754E-01
8.60444E+00 -2.56537E-01
8.91163E+00 -2.69587E-01
9.21881E+00 -2.82906E-01
9.52598E+00 -2.96492E-01
9.83314E+00 -3.10347E-01
1.01403E+01 -3.24470E-01
1.04474E+01 -3.38860E-01
1.07546E+01 -3.53518E-01
1.10617E+01 -3.68444E-01
1.13688E+01 -3.83638E-01
1.16759E+01 -3.99100E-01
1.19831E+01 -4.14830E-01
1.22901E+01 -4.30827E-01
1.25972E+01 -4.47093E-01
1.29043E+01 -4.63626E-01
1.32114E+01 -4.80427E-01
1.35184E+01 -4.97495E-01
1.38255E+01 -5.14832E-01
1.41325E+01 -5.32436E-01
1.44396E+01 -5.50308E-01
1.47466E+01 -5.68447E-01
1.50536E+01 -5.86855E-01
1.53606E+01 -6.05530E-01
1.56676E+01 -6.24473E-01
1.59746E+01 -6.43683E-01
1.62816E+01 -6.63162E-01
1.65886E+01 -6.82908E-01
1.68955E+01 -7.02922E-01
1.72025E+01 -7.23203E-01
1.75094E+01 -7.43752E-01
1.78164E+01 -7.64569E-01
1.81233E+01 -7.85654E-01
1.84302E+01 -8.07006E-01
1.87371E+01 -8.28626E-01
1.90440E+01 -8.50514E-01
1.93509E+01 -8.72670E-01
1.96578E+01 -8.95093E-01
1.99647E+01 -9.17784E-01
EOD
$s3_1 << EOD
-9.99434E+00 1.40822E-01
-9.68192E+00 1.48713E-01
-9.36949E+00 1.56617E-01
-9.05708E+00 1.64535E-01
-8.74467E+00 1.72466E-01
-8.43227E+00 1.80410E-01
-8.11987E+00 1.88368E-01
-7.80748E+00 1.96339E-01
-7.49510E+00 2.04324E-01
-7.18273E+00 2.12322E-01
-6.87036E+00 2.20333E-01
-6.55800E+00 2.28358E-01
-6.24564E+00 2.36396E-01
-5.93329E+00 2.44448E-01
-5.62095E+00 2.52513E-01
-5.30861E+00 2.60592E-01
-4.99629E+00 2.68684E-01
-4.68396E+00 2.76790E-01
-4.37165E+00 2.84909E-01
-4.05934E+00 2.93042E-01
-3.74704E+00 3.01188E-01
-3.43475E+00 3.09347E-01
-3.12247E+00 3.17521E-01
-2.81019E+00 3.25708E-01
-2.49791E+00 3.33908E-01
-2.18565E+00 3.42122E-01
-1.87339E+00 3.50349E-01
-1.56114E+00 3.58590E-01
-1.24890E+00 3.66845E-01
-9.36663E-01 3.75113E-01
-6.24435E-01 3.83395E-01
-3.12213E-01 3.91691E-01
0 4.00000E-01
3.07403E-01 4.08195E-01
6.14799E-01 4.16403E-01
9.22187E-01 4.24624E-01
1.22957E+00 4.32858E-01
1.53694E+00 4.41105E-01
1.84431E+00 4.49366E-01
2.15167E+00 4.57641E-01
2.45902E+00 4.65928E-01
2.76636E+00 4.74229E-01
3.07370E+00 4.82543E-01
3.38103E+00 4.90870E-01
3.68835E+00 4.99211E-01
3.99566E+00 5.07565E-01
4.30297E+00 5.15932E-01
4.61027E+00 5.24312E-01
4.91756E+00 5.32706E-01
5.22484E+00 5.41114E-01
5.53212E+00 5.49535E-01
5.83939E+00 5.57969E-01
6.14665E+00 5.66416E-01
6.45390E+00 5.74877E-01
6.76114E+00 5.83352E-01
7.06838E+00 5.91839E-01
7.37561E+00 6.00340E-01
7.68283E+00 6.08855E-01
7.99004E+00 6.17383E-01
8.29724E+00 6.25924E-01
8.60444E+00 6.34479E-01
8.91163E+00 6.43048E-01
9.21881E+00 6.51630E-01
9.52598E+00 6.60225E-01
9.83314E+00 6.68834E-01
1.01403E+01 6.77457E-01
1.04474E+01 6.86092E-01
1.07546E+01 6.94742E-01
1.10617E+01 7.03405E-01
1.13688E+01 7.12081E-01
1.16759E+01 7.20771E-01
1.19831E+01 7.29475E-01
1.22901E+01 7.38192E-01
1.25972E+01 7.46923E-01
1.29043E+01 7.55667E-01
1.32114E+01 7.64425E-01
1.35184E+01 7.73197E-01
1.38255E+01 7.81982E-01
1.41325E+01 7.90781E-01
1.44396E+01 7.99593E-01
1.47466E+01 8.08419E-01
1.50536E+01 8.17259E-01
1.53606E+01 8.26112E-01
1.56676E+01 8.34979E-01
1.59746E+01 8.43860E-01
1.62816E+01 8.52755E-01
1.65886E+01 8.61663E-01
1.68955E+01 8.70584E-01
1.72025E+01 8.79520E-01
1.75094E+01 8.88469E-01
1.78164E+01 8.97432E-01
1.81233E+01 9.06409E-01
1.84302E+01 9.15399E-01
1.87371E+01 9.24403E-01
1.90440E+01 9.33421E-01
1.93509E+01 9.42453E-01
1.96578E+01 9.51498E-01
1.99647E+01 9.60557E-01
EOD
$s4_1 << EOD
-9.99434E+00 -1.03497E-01
-9.68192E+00 -1.03363E-01
-9.36949E+00 -1.03230E-01
-9.05708E+00 -1.03099E-01
-8.74467E+00 -1.02970E-01
-8.43227E+00 -1.02842E-01
-8.11987E+00 -1.02716E-01
-7.80748E+00 -1.02591E-01
-7.49510E+00 -1.02469E-01
-7.18273E+00 -1.02347E-01
-6.87036E+00 -1.02228E-01
-6.55800E+00 -1.02110E-01
-6.24564E+00 -1.01994E-01
-5.93329E+00 -1.01879E-01
-5.62095E+00 -1.01766E-01
-5.30861E+00 -1.01654E-01
-4.99629E+00 -1.01544E-01
-4.68396E+00 -1.01436E-01
-4.37165E+00 -1.01330E-01
-4.05934E+00 -1.01224E-01
-3.74704E+00 -1.01121E-01
-3.43475E+00 -1.01019E-01
-3.12247E+00 -1.00919E-01
-2.81019E+00 -1.00820E-01
-2.49791E+00 -1.00723E-01
-2.18565E+00 -1.00627E-01
-1.87339E+00 -1.00533E-01
-1.56114E+00 -1.00440E-01
-1.24890E+00 -1.00349E-01
-9.36663E-01 -1.00260E-01
-6.24435E-01 -1.00171E-01
-3.12213E-01 -1.00085E-01
0 -1.00000E-01
3.07403E-01 -9.99178E-02
6.14799E-01 -9.98370E-02
9.22187E-01 -9.97576E-02
1.22957E+00 -9.96797E-02
1.53694E+00 -9.96032E-02
1.84431E+00 -9.95282E-02
2.15167E+00 -9.94545E-02
2.45902E+00 -9.93823E-02
2.76636E+00 -9.93114E-02
3.07370E+00 -9.92420E-02
3.38103E+00 -9.91740E-02
3.68835E+00 -9.91073E-02
3.99566E+00 -9.90420E-02
4.30297E+00 -9.89781E-02
4.61027E+00 -9.89155E-02
4.91756E+00 -9.88543E-02
5.22484E+00 -9.87944E-02
5.53212E+00 -9.87359E-02
5.83939E+00 -9.86787E-02
6.14665E+00 -9.86228E-02
6.45390E+00 -9.85682E-02
6.76114E+00 -9.85149E-02
7.06838E+00 -9.84630E-02
7.37561E+00 -9.84123E-02
7.68283E+00 -9.83629E-02
7.99004E+00 -9.83148E-02
8.29724E+00 -9.82679E-02
8.60444E+00 -9.82223E-02
8.91163E+00 -9.81780E-02
9.21881E+00 -9.81349E-02
9.52598E+00 -9.80930E-02
9.83314E+00 -9.80523E-02
1.01403E+01 -9.80129E-02
1.04474E+01 -9.79746E-02
1.07546E+01 -9.79376E-02
1.10617E+01 -9.79017E-02
1.13688E+01 -9.78670E-02
1.16759E+01 -9.78335E-02
1.19831E+01 -9.78011E-02
1.22901E+01 -9.77698E-02
1.25972E+01 -9.77397E-02
1.29043E+01 -9.77108E-02
1.32114E+01 -9.76829E-02
1.35184E+01 -9.76561E-02
1.38255E+01 -9.76305E-02
1.41325E+01 -9.76059E-02
1.44396E+01 -9.75823E-02
1.47466E+01 -9.75599E-02
1.50536E+01 -9.75385E-02
1.53606E+01 -9.75181E-02
1.56676E+01 -9.74987E-02
1.59746E+01 -9.74804E-02
1.62816E+01 -9.74630E-02
1.65886E+01 -9.74467E-02
1.68955E+01 -9.74313E-02
1.72025E+01 -9.74169E-02
1.75094E+01 -9.74034E-02
1.78164E+01 -9.73909E-02
1.81233E+01 -9.73793E-02
1.84302E+01 -9.73685E-02
1.87371E+01 -9.73587E-02
1.90440E+01 -9.73498E-02
1.93509E+01 -9.73418E-02
1.96578E+01 -9.73346E-02
1.99647E+01 -9.73282E-02
EOD
$s5_1 << EOD
-9.99434E+00 2.31923E+02
-9.68192E+00 2.31708E+02
-9.36949E+00 2.31494E+02
-9.05708E+00 2.31279E+02
-8.74467E+00 2.31064E+02
-8.43227E+00 2.30849E+02
-8.11987E+00 2.30634E+02
-7.80748E+00 2.30419E+02
-7.49510E+00 2.30203E+02
-7.18273E+00 2.29988E+02
-6.87036E+00 2.29773E+02
-6.55800E+00 2.29557E+02
-6.24564E+00 2.29341E+02
-5.93329E+00 2.29125E+02
-5.62095E+00 2.28909E+02
-5.30861E+00 2.28693E+02
-4.99629E+00 2.28476E+02
-4.68396E+00 2.28260E+02
-4.37165E+00 2.28044E+02
-4.05934E+00 2.27827E+02
-3.74704E+00 2.27610E+02
-3.43475E+00 2.27393E+02
-3.12247E+00 2.27176E+02
-2.81019E+00 2.26959E+02
-2.49791E+00 2.26742E+02
-2.18565E+00 2.26525E+02
-1.87339E+00 2.26307E+02
-1.56114E+00 2.26090E+02
-1.24890E+00 2.25872E+02
-9.36663E-01 2.25654E+02
-6.24435E-01 2.25436E+02
-3.12213E-01 2.25218E+02
0 225
3.07403E-01 2.24785E+02
6.14799E-01 2.24570E+02
9.22187E-01 2.24355E+02
1.22957E+00 2.24140E+02
1.53694E+00 2.23924E+02
1.84431E+00 2.23709E+02
2.15167E+00 2.23493E+02
2.45902E+00 2.23278E+02
2.76636E+00 2.23062E+02
3.07370E+00 2.22846E+02
3.38103E+00 2.22630E+02
3.68835E+00 2.22414E+02
3.99566E+00 2.22198E+02
4.30297E+00 2.21982E+02
4.61027E+00 2.21765E+02
4.91756E+00 2.21549E+02
5.22484E+00 2.21332E+02
5.53212E+00 2.21115E+02
5.83939E+00 2.20899E+02
6.14665E+00 2.20682E+02
6.45390E+00 2.20465E+02
6.76114E+00 2.20248E+02
7.06838E+00 2.20030E+02
7.37561E+00 2.19813E+02
7.68283E+00 2.19596E+02
7.99004E+00 2.19378E+02
8.29724E+00 2.19161E+02
8.60444E+00 2.18943E+02
8.91163E+00 2.18725E+02
9.21881E+00 2.18507E+02
9.52598E+00 2.18289E+02
9.83314E+00 2.18071E+02
1.01403E+01 2.17853E+02
1.04474E+01 2.17635E+02
1.07546E+01 2.17416E+02
1.10617E+01 2.17198E+02
1.13688E+01 2.16979E+02
1.16759E+01 2.16761E+02
1.19831E+01 2.16542E+02
1.22901E+01 2.16323E+02
1.25972E+01 2.16104E+02
1.29043E+01 2.15885E+02
1.32114E+01 2.15666E+02
1.35184E+01 2.15447E+02
1.38255E+01 2.15228E+02
1.41325E+01 2.15009E+02
1.44396E+01 2.14789E+02
1.47466E+01 2.14570E+02
1.50536E+01 2.14350E+02
1.53606E+01 2.14131E+02
1.56676E+01 2.13911E+02
1.59746E+01 2.13691E+02
1.62816E+01 2.13471E+02
1.65886E+01 2.13251E+02
1.68955E+01 2.13031E+02
1.72025E+01 2.12811E+02
1.75094E+01 2.12591E+02
1.78164E+01 2.12371E+02
1.81233E+01 2.12150E+02
1.84302E+01 2.11930E+02
1.87371E+01 2.11709E+02
1.90440E+01 2.11489E+02
1.93509E+01 2.11268E+02
1.96578E+01 2.11048E+02
1.99647E+01 2.10827E+02
EOD
$s6_1 << EOD
-10 -5.20815E+00
-9.79592E+00 -5.10358E+00
-9.59184E+00 -4.99904E+00
-9.38776E+00 -4.89452E+00
-9.18367E+00 -4.79001E+00
-8.97959E+00 -4.68552E+00
-8.77551E+00 -4.58105E+00
-8.57143E+00 -4.47660E+00
-8.36735E+00 -4.37216E+00
-8.16327E+00 -4.26774E+00
-7.95918E+00 -4.16333E+00
-7.75510E+00 -4.05894E+00
-7.55102E+00 -3.95457E+00
-7.34694E+00 -3.85021E+00
-7.14286E+00 -3.74586E+00
-6.93878E+00 -3.64153E+00
-6.73469E+00 -3.53722E+00
-6.53061E+00 -3.43291E+00
-6.32653E+00 -3.32862E+00
-6.12245E+00 -3.22434E+00
-5.91837E+00 -3.12007E+00
-5.71429E+00 -3.01582E+00
-5.51020E+00 -2.91158E+00
-5.30612E+00 -2.80734E+00
-5.10204E+00 -2.70312E+00
-4.89796E+00 -2.59891E+00
-4.69388E+00 -2.49471E+00
-4.48980E+00 -2.39052E+00
-4.28571E+00 -2.28633E+00
-4.08163E+00 -2.18216E+00
-3.87755E+00 -2.07800E+00
-3.67347E+00 -1.97384E+00
-3.46939E+00 -1.86969E+00
-3.26531E+00 -1.76555E+00
-3.06122E+00 -1.66141E+00
-2.85714E+00 -1.55729E+00
-2.65306E+00 -1.45316E+00
-2.44898E+00 -1.34905E+00
-2.24490E+00 -1.24494E+00
-2.04082E+00 -1.14083E+00
-1.83674E+00 -1.03673E+00
-1.63265E+00 -9.32639E-01
-1.42857E+00 -8.28548E-01
-1.22449E+00 -7.24461E-01
-1.02041E+00 -6.20377E-01
-8.16326E-01 -5.16297E-01
-6.12245E-01 -4.12219E-01
-4.08163E-01 -3.08144E-01
-2.04082E-01 -2.04071E-01
0 -1.00000E-01
2.08333E-01 6.23783E-03
4.16667E-01 1.12475E-01
6.25000E-01 2.18711E-01
8.33333E-01 3.24946E-01
1.04167E+00 4.31182E-01
1.25000E+00 5.37417E-01
1.45833E+00 6.43654E-01
1.66667E+00 7.49892E-01
1.87500E+00 8.56131E-01
2.08333E+00 9.62372E-01
2.29167E+00 1.06862E+00
2.50000E+00 1.17486E+00
2.70833E+00 1.28111E+00
2.91667E+00 1.38736E+00
3.12500E+00 1.49362E+00
3.33333E+00 1.59988E+00
3.54167E+00 1.70614E+00
3.75000E+00 1.81241E+00
3.95833E+00 1.91868E+00
4.16667E+00 2.02496E+00
4.37500E+00 2.13125E+00
4.58333E+00 2.23754E+00
4.79167E+00 2.34383E+00
5 2.45014E+00
5.20833E+00 2.55645E+00
5.41667E+00 2.66277E+00
5.62500E+00 2.76910E+00
5.83333E+00 2.87543E+00
6.04167E+00 2.98178E+00
6.25000E+00 3.08813E+00
6.45833E+00 3.19449E+00
6.66667E+00 3.30086E+00
6.87500E+00 3.40725E+00
7.08333E+00 3.51364E+00
7.29167E+00 3.62004E+00
7.50000E+00 3.72646E+00
7.70833E+00 3.83288E+00
7.91667E+00 3.93932E+00
8.12500E+00 4.04577E+00
8.33333E+00 4.15223E+00
8.54167E+00 4.25871E+00
8.75000E+00 4.36520E+00
8.95833E+00 4.47170E+00
9.16667E+00 4.57822E+00
9.37500E+00 4.68475E+00
9.58333E+00 4.79129E+00
9.79167E+00 4.89785E+00
10 5.00443E+00
EOD
$s7_1 << EOD
-10 6.75986E-01
-9.79592E+00 6.70809E-01
-9.59184E+00 6.65614E-01
-9.38776E+00 6.60400E-01
-9.18367E+00 6.55167E-01
-8.97959E+00 6.49914E-01
-8.77551E+00 6.44643E-01
-8.57143E+00 6.39352E-01
-8.36735E+00 6.34043E-01
-8.16327E+00 6.28714E-01
-7.95918E+00 6.23367E-01
-7.75510E+00 6.18000E-01
-7.55102E+00 6.12615E-01
-7.34694E+00 6.07210E-01
-7.14286E+00 6.01787E-01
-6.93878E+00 5.96344E-01
-6.73469E+00 5.90882E-01
-6.53061E+00 5.85402E-01
-6.32653E+00 5.79902E-01
-6.12245E+00 5.74384E-01
-5.91837E+00 5.68846E-01
-5.71429E+00 5.63289E-01
-5.51020E+00 5.57714E-01
-5.30612E+00 5.52119E-01
-5.10204E+00 5.46506E-01
-4.89796E+00 5.40873E-01
-4.69388E+00 5.35222E-01
-4.48980E+00 5.29551E-01
-4.28571E+00 5.23862E-01
-4.08163E+00 5.18153E-01
-3.87755E+00 5.12426E-01
-3.67347E+00 5.06679E-01
-3.46939E+00 5.00914E-01
-3.26531E+00 4.95130E-01
-3.06122E+00 4.89326E-01
-2.85714E+00 4.83504E-01
-2.65306E+00 4.77663E-01
-2.44898E+00 4.71803E-01
-2.24490E+00 4.65923E-01
-2.04082E+00 4.60025E-01
-1.83674E+00 4.54108E-01
-1.63265E+00 4.48172E-01
-1.42857E+00 4.42217E-01
-1.22449E+00 4.36243E-01
-1.02041E+00 4.30250E-01
-8.16326E-01 4.24238E-01
-6.12245E-01 4.18207E-01
-4.08163E-01 4.12157E-01
-2.04082E-01 4.06088E-01
0 4.00000E-01
2.08333E-01 3.93766E-01
4.16667E-01 3.87512E-01
6.25000E-01 3.81238E-01
8.33333E-01 3.74944E-01
1.04167E+00 3.68630E-01
1.25000E+00 3.62297E-01
1.45833E+00 3.55944E-01
1.66667E+00 3.49571E-01
1.87500E+00 3.43178E-01
2.08333E+00 3.36765E-01
2.29167E+00 3.30333E-01
2.50000E+00 3.23880E-01
2.70833E+00 3.17408E-01
2.91667E+00 3.10916E-01
3.12500E+00 3.04404E-01
3.33333E+00 2.97873E-01
3.54167E+00 2.91321E-01
3.75000E+00 2.84750E-01
3.95833E+00 2.78158E-01
4.16667E+00 2.71547E-01
4.37500E+00 2.64916E-01
4.58333E+00 2.58265E-01
4.79167E+00 2.51594E-01
5 2.44904E-01
5.20833E+00 2.38193E-01
5.41667E+00 2.31462E-01
5.62500E+00 2.24712E-01
5.83333E+00 2.17941E-01
6.04167E+00 2.11151E-01
6.25000E+00 2.04341E-01
6.45833E+00 1.97510E-01
6.66667E+00 1.90660E-01
6.87500E+00 1.83790E-01
7.08333E+00 1.76900E-01
7.29167E+00 1.69989E-01
7.50000E+00 1.63059E-01
7.70833E+00 1.56109E-01
7.91667E+00 1.49139E-01
8.12500E+00 1.42149E-01
8.33333E+00 1.35138E-01
8.54167E+00 1.28108E-01
8.75000E+00 1.21057E-01
8.95833E+00 1.13987E-01
9.16667E+00 1.06897E-01
9.37500E+00 9.97858E-02
9.58333E+00 9.26551E-02
9.79167E+00 8.55042E-02
10 7.83332E-02
EOD
$s8_1 << EOD
-1000 -5.37203E-01
-900 -4.83517E-01
-800 -4.29823E-01
-700 -3.76121E-01
-600 -3.22412E-01
-500 -2.68696E-01
-400 -2.14972E-01
-300 -1.61240E-01
-200 -1.07501E-01
-100 -5.37542E-02
0 0
100 5.37617E-02
200 1.07531E-01
300 1.61308E-01
400 2.15092E-01
500 2.68884E-01
600 3.22683E-01
700 3.76490E-01
800 4.30304E-01
900 4.84126E-01
1000 5.37955E-01
EOD
$s9_1 << EOD
-1000 -2.90113E-02
-900 -2.61084E-02
-800 -2.32059E-02
-700 -2.03038E-02
-600 -1.74021E-02
-500 -1.45007E-02
-400 -1.15998E-02
-300 -8.69928E-03
-200 -5.79913E-03
-100 -2.89937E-03
0 0
100 2.89899E-03
200 5.79759E-03
300 8.69580E-03
400 1.15936E-02
500 1.44911E-02
600 1.73882E-02
700 2.02849E-02
800 2.31812E-02
900 2.60771E-02
1000 2.89727E-02
EOD
$s10_1 << EOD
-100 -1.32875E-02
-90 -1.19591E-02
-80 -1.06306E-02
-70 -9.30211E-03
-60 -7.97348E-03
-50 -6.64478E-03
-40 -5.31599E-03
-30 -3.98712E-03
-20 -2.65816E-03
-10 -1.32912E-03
0 0
10 1.32921E-03
20 2.65850E-03
30 3.98787E-03
40 5.31733E-03
50 6.64687E-03
60 7.97650E-03
70 9.30621E-03
80 1.06360E-02
90 1.19659E-02
100 1.32958E-02
EOD
$s11_1 << EOD
-100 -1.17453E-01
-90 -1.05709E-01
-80 -9.39647E-02
-70 -8.22200E-02
-60 -7.04750E-02
-50 -5.87298E-02
-40 -4.69844E-02
-30 -3.52387E-02
-20 -2.34927E-02
-10 -1.17465E-02
0 0
10 1.17467E-02
20 2.34938E-02
30 3.52410E-02
40 4.69886E-02
50 5.87364E-02
60 7.04845E-02
70 8.22329E-02
80 9.39815E-02
90 1.05730E-01
100 1.17480E-01
EOD
$s12_1 << EOD
-100 -1.09160E-01
-90 -9.82436E-02
-80 -8.73274E-02
-70 -7.64113E-02
-60 -6.54953E-02
-50 -5.45793E-02
-40 -4.36633E-02
-30 -3.27474E-02
-20 -2.18316E-02
-10 -1.09158E-02
0 0
10 1.09157E-02
20 2.18314E-02
30 3.27470E-02
40 4.36626E-02
50 5.45781E-02
60 6.54937E-02
70 7.64091E-02
80 8.73246E-02
90 9.82400E-02
100 1.09155E-01
EOD

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1500, 1688 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1500, 1688 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 30cm, 33cm font 'sans-serif,12' noenhanced }
set output 'push_carmaker.'.format
set label 1 'Front axle with push rods and rockers: carmaker' at screen 2.00000E-02, screen 9.82230E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'points of the exported file over curves that were solved separately' at screen 2.00000E-02, screen 9.64450E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.92890E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 7.58290E-01; set tmargin at screen 9.27730E-01
set title 'tx over travel, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'tx [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s1_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($2==1 ? $5*1000 : NaN):($3*1000) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'
unset label 1; unset label 2; unset label 9; unset key

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 7.58290E-01; set tmargin at screen 9.27730E-01
set title 'ty over travel, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'ty [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s2_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($2==1 ? $5*1000 : NaN):($4*1000) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 7.58290E-01; set tmargin at screen 9.27730E-01
set title 'rx over travel, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'rx [deg]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s3_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($2==1 ? $5*1000 : NaN):($6*5.72958E+01) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 5.21330E-01; set tmargin at screen 6.90760E-01
set title 'rz over travel, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'rz [deg]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s4_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($2==1 ? $5*1000 : NaN):($8*5.72958E+01) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 5.21330E-01; set tmargin at screen 6.90760E-01
set title 'lSpring over travel, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'lSpring [mm]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s5_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($2==1 ? $5*1000 : NaN):($9*1000) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 5.21330E-01; set tmargin at screen 6.90760E-01
set title 'rz over steer, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'steer, driver [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'rz [deg]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s6_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($1==1 ? word("-10 0 10", int($2)+1)+0 : NaN):($8*5.72958E+01) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 2.84360E-01; set tmargin at screen 4.53790E-01
set title 'rx over steer, side L' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'steer, driver [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'rx [deg]' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s7_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'push.skc' skip 27 every ::0:0:14:0 using ($1==1 ? word("-10 0 10", int($2)+1)+0 : NaN):($6*5.72958E+01) with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 2.84360E-01; set tmargin at screen 4.53790E-01
set title 'Com Frc.x → tx' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s8_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     5.37579E-04*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 2.84360E-01; set tmargin at screen 4.53790E-01
set title 'Com Frc.y → ty' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s9_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     2.89918E-05*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 4.73930E-02; set tmargin at screen 2.16820E-01
set title 'Com Trq.x → rx' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N m' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s10_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     1.32880E-04*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 4.73930E-02; set tmargin at screen 2.16820E-01
set title 'Com Trq.y → ry' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N m' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s11_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     1.17467E-03*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 4.73930E-02; set tmargin at screen 2.16820E-01
set title 'Com Trq.z → rz' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N m' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s12_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     1.09108E-03*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'
unset multiplot
unset label
unset output
}
