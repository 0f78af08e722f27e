# McPherson front axle with rack, anti-roll bar and stops: carsim
#
#     gnuplot mcpherson_axle_carsim.gp
#
# in this folder draws mcpherson_axle_carsim.png and .svg;
# gnuplot -e "formats='pdf'" mcpherson_axle_carsim.gp makes a PDF.
if (!exists('formats')) formats = 'png svg'
reset
set encoding utf8
set datafile separator comma
set datafile missing 'nan'
set border 3 linecolor rgb '#808080'
set tics out nomirror scale 6.00000E-01 textcolor rgb '#404040'
set grid linetype 1 linecolor rgb '#E6E6E6' linewidth 1
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
unset key; set style fill solid 1 noborder
$s1_1 << EOD
-9.99461E+00,1.22228E-01
-9.68224E+00,1.21610E-01
-9.36988E+00,1.20986E-01
-9.05751E+00,1.20358E-01
-8.74515E+00,1.19724E-01
-8.43279E+00,1.19085E-01
-8.12043E+00,1.18442E-01
-7.80808E+00,1.17793E-01
-7.49573E+00,1.17140E-01
-7.18338E+00,1.16482E-01
-6.87103E+00,1.15818E-01
-6.55869E+00,1.15150E-01
-6.24634E+00,1.14477E-01
-5.93401E+00,1.13799E-01
-5.62167E+00,1.13116E-01
-5.30933E+00,1.12428E-01
-4.99700E+00,1.11736E-01
-4.68467E+00,1.11038E-01
-4.37235E+00,1.10336E-01
-4.06002E+00,1.09629E-01
-3.74770E+00,1.08916E-01
-3.43538E+00,1.08200E-01
-3.12306E+00,1.07478E-01
-2.81075E+00,1.06752E-01
-2.49843E+00,1.06020E-01
-2.18612E+00,1.05284E-01
-1.87381E+00,1.04544E-01
-1.56151E+00,1.03798E-01
-1.24920E+00,1.03048E-01
-9.36898E-01,1.02293E-01
-6.24596E-01,1.01533E-01
-3.12297E-01,1.00769E-01
0,1.00000E-01
3.07491E-01,9.92382E-02
6.14980E-01,9.84718E-02
9.22467E-01,9.77010E-02
1.22995E+00,9.69256E-02
1.53744E+00,9.61457E-02
1.84492E+00,9.53613E-02
2.15240E+00,9.45725E-02
2.45988E+00,9.37791E-02
2.76735E+00,9.29813E-02
3.07483E+00,9.21790E-02
3.38230E+00,9.13723E-02
3.68978E+00,9.05611E-02
3.99724E+00,8.97455E-02
4.30471E+00,8.89255E-02
4.61218E+00,8.81011E-02
4.91965E+00,8.72722E-02
5.22711E+00,8.64390E-02
5.53458E+00,8.56014E-02
5.84204E+00,8.47593E-02
6.14950E+00,8.39130E-02
6.45696E+00,8.30622E-02
6.76441E+00,8.22071E-02
7.07187E+00,8.13477E-02
7.37933E+00,8.04839E-02
7.68678E+00,7.96158E-02
7.99423E+00,7.87434E-02
8.30169E+00,7.78666E-02
8.60914E+00,7.69856E-02
8.91658E+00,7.61002E-02
9.22403E+00,7.52106E-02
9.53148E+00,7.43167E-02
9.83893E+00,7.34185E-02
1.01464E+01,7.25161E-02
1.04538E+01,7.16094E-02
1.07613E+01,7.06984E-02
1.10687E+01,6.97832E-02
1.13761E+01,6.88638E-02
1.16836E+01,6.79402E-02
1.19910E+01,6.70123E-02
1.22985E+01,6.60802E-02
1.26059E+01,6.51440E-02
1.29133E+01,6.42035E-02
1.32208E+01,6.32588E-02
1.35282E+01,6.23100E-02
1.38356E+01,6.13570E-02
1.41431E+01,6.03998E-02
1.44505E+01,5.94385E-02
1.47579E+01,5.84730E-02
1.50654E+01,5.75034E-02
1.53728E+01,5.65296E-02
1.56802E+01,5.55517E-02
1.59877E+01,5.45697E-02
1.62951E+01,5.35836E-02
1.66025E+01,5.25933E-02
1.69099E+01,5.15990E-02
1.72174E+01,5.06006E-02
1.75248E+01,4.95980E-02
1.78322E+01,4.85914E-02
1.81396E+01,4.75807E-02
1.84471E+01,4.65660E-02
1.87545E+01,4.55472E-02
1.90619E+01,4.45243E-02
1.93693E+01,4.34974E-02
1.96768E+01,4.24664E-02
1.99842E+01,4.14314E-02
EOD
$s2_1 << EOD
-9.99461E+00,-3.49065E-01
-9.68224E+00,-3.54150E-01
-9.36988E+00,-3.59212E-01
-9.05751E+00,-3.64250E-01
-8.74515E+00,-3.69264E-01
-8.43279E+00,-3.74255E-01
-8.12043E+00,-3.79223E-01
-7.80808E+00,-3.84167E-01
-7.49573E+00,-3.89087E-01
-7.18338E+00,-3.93984E-01
-6.87103E+00,-3.98857E-01
-6.55869E+00,-4.03706E-01
-6.24634E+00,-4.08532E-01
-5.93401E+00,-4.13334E-01
-5.62167E+00,-4.18112E-01
-5.30933E+00,-4.22866E-01
-4.99700E+00,-4.27596E-01
-4.68467E+00,-4.32303E-01
-4.37235E+00,-4.36985E-01
-4.06002E+00,-4.41644E-01
-3.74770E+00,-4.46278E-01
-3.43538E+00,-4.50888E-01
-3.12306E+00,-4.55475E-01
-2.81075E+00,-4.60037E-01
-2.49843E+00,-4.64574E-01
-2.18612E+00,-4.69088E-01
-1.87381E+00,-4.73577E-01
-1.56151E+00,-4.78042E-01
-1.24920E+00,-4.82482E-01
-9.36898E-01,-4.86899E-01
-6.24596E-01,-4.91290E-01
-3.12297E-01,-4.95657E-01
0,-5.00000E-01
3.07491E-01,-5.04252E-01
6.14980E-01,-5.08480E-01
9.22467E-01,-5.12684E-01
1.22995E+00,-5.16864E-01
1.53744E+00,-5.21020E-01
1.84492E+00,-5.25152E-01
2.15240E+00,-5.29260E-01
2.45988E+00,-5.33344E-01
2.76735E+00,-5.37404E-01
3.07483E+00,-5.41439E-01
3.38230E+00,-5.45450E-01
3.68978E+00,-5.49437E-01
3.99724E+00,-5.53400E-01
4.30471E+00,-5.57338E-01
4.61218E+00,-5.61252E-01
4.91965E+00,-5.65142E-01
5.22711E+00,-5.69007E-01
5.53458E+00,-5.72847E-01
5.84204E+00,-5.76663E-01
6.14950E+00,-5.80454E-01
6.45696E+00,-5.84220E-01
6.76441E+00,-5.87962E-01
7.07187E+00,-5.91679E-01
7.37933E+00,-5.95372E-01
7.68678E+00,-5.99039E-01
7.99423E+00,-6.02681E-01
8.30169E+00,-6.06299E-01
8.60914E+00,-6.09891E-01
8.91658E+00,-6.13459E-01
9.22403E+00,-6.17001E-01
9.53148E+00,-6.20518E-01
9.83893E+00,-6.24011E-01
1.01464E+01,-6.27477E-01
1.04538E+01,-6.30919E-01
1.07613E+01,-6.34335E-01
1.10687E+01,-6.37726E-01
1.13761E+01,-6.41092E-01
1.16836E+01,-6.44432E-01
1.19910E+01,-6.47746E-01
1.22985E+01,-6.51035E-01
1.26059E+01,-6.54299E-01
1.29133E+01,-6.57536E-01
1.32208E+01,-6.60748E-01
1.35282E+01,-6.63935E-01
1.38356E+01,-6.67095E-01
1.41431E+01,-6.70230E-01
1.44505E+01,-6.73338E-01
1.47579E+01,-6.76421E-01
1.50654E+01,-6.79478E-01
1.53728E+01,-6.82508E-01
1.56802E+01,-6.85513E-01
1.59877E+01,-6.88491E-01
1.62951E+01,-6.91444E-01
1.66025E+01,-6.94370E-01
1.69099E+01,-6.97269E-01
1.72174E+01,-7.00142E-01
1.75248E+01,-7.02989E-01
1.78322E+01,-7.05810E-01
1.81396E+01,-7.08603E-01
1.84471E+01,-7.11371E-01
1.87545E+01,-7.14111E-01
1.90619E+01,-7.16825E-01
1.93693E+01,-7.19512E-01
1.96768E+01,-7.22173E-01
1.99842E+01,-7.24806E-01
EOD
$s3_1 << EOD
-9.99461E+00,1.77473E-01
-9.68224E+00,1.72456E-01
-9.36988E+00,1.67404E-01
-9.05751E+00,1.62319E-01
-8.74515E+00,1.57199E-01
-8.43279E+00,1.52045E-01
-8.12043E+00,1.46857E-01
-7.80808E+00,1.41634E-01
-7.49573E+00,1.36378E-01
-7.18338E+00,1.31087E-01
-6.87103E+00,1.25763E-01
-6.55869E+00,1.20404E-01
-6.24634E+00,1.15011E-01
-5.93401E+00,1.09584E-01
-5.62167E+00,1.04123E-01
-5.30933E+00,9.86275E-02
-4.99700E+00,9.30982E-02
-4.68467E+00,8.75348E-02
-4.37235E+00,8.19373E-02
-4.06002E+00,7.63058E-02
-3.74770E+00,7.06402E-02
-3.43538E+00,6.49405E-02
-3.12306E+00,5.92069E-02
-2.81075E+00,5.34392E-02
-2.49843E+00,4.76375E-02
-2.18612E+00,4.18018E-02
-1.87381E+00,3.59321E-02
-1.56151E+00,3.00283E-02
-1.24920E+00,2.40906E-02
-9.36898E-01,1.81189E-02
-6.24596E-01,1.21133E-02
-3.12297E-01,6.07362E-03
0,0
3.07491E-01,-6.01336E-03
6.14980E-01,-1.20596E-02
9.22467E-01,-1.81388E-02
1.22995E+00,-2.42509E-02
1.53744E+00,-3.03960E-02
1.84492E+00,-3.65739E-02
2.15240E+00,-4.27847E-02
2.45988E+00,-4.90284E-02
2.76735E+00,-5.53049E-02
3.07483E+00,-6.16144E-02
3.38230E+00,-6.79568E-02
3.68978E+00,-7.43320E-02
3.99724E+00,-8.07401E-02
4.30471E+00,-8.71810E-02
4.61218E+00,-9.36549E-02
4.91965E+00,-1.00162E-01
5.22711E+00,-1.06701E-01
5.53458E+00,-1.13273E-01
5.84204E+00,-1.19879E-01
6.14950E+00,-1.26517E-01
6.45696E+00,-1.33188E-01
6.76441E+00,-1.39892E-01
7.07187E+00,-1.46628E-01
7.37933E+00,-1.53398E-01
7.68678E+00,-1.60200E-01
7.99423E+00,-1.67035E-01
8.30169E+00,-1.73903E-01
8.60914E+00,-1.80804E-01
8.91658E+00,-1.87738E-01
9.22403E+00,-1.94705E-01
9.53148E+00,-2.01704E-01
9.83893E+00,-2.08736E-01
1.01464E+01,-2.15801E-01
1.04538E+01,-2.22899E-01
1.07613E+01,-2.30030E-01
1.10687E+01,-2.37193E-01
1.13761E+01,-2.44390E-01
1.16836E+01,-2.51619E-01
1.19910E+01,-2.58881E-01
1.22985E+01,-2.66176E-01
1.26059E+01,-2.73504E-01
1.29133E+01,-2.80864E-01
1.32208E+01,-2.88258E-01
1.35282E+01,-2.95684E-01
1.38356E+01,-3.03143E-01
1.41431E+01,-3.10635E-01
1.44505E+01,-3.18160E-01
1.47579E+01,-3.25718E-01
1.50654E+01,-3.33308E-01
1.53728E+01,-3.40931E-01
1.56802E+01,-3.48588E-01
1.59877E+01,-3.56277E-01
1.62951E+01,-3.63999E-01
1.66025E+01,-3.71754E-01
1.69099E+01,-3.79541E-01
1.72174E+01,-3.87362E-01
1.75248E+01,-3.95215E-01
1.78322E+01,-4.03102E-01
1.81396E+01,-4.11021E-01
1.84471E+01,-4.18973E-01
1.87545E+01,-4.26958E-01
1.90619E+01,-4.34976E-01
1.93693E+01,-4.43027E-01
1.96768E+01,-4.51110E-01
1.99842E+01,-4.59227E-01
EOD
$s4_1 << EOD
-9.99461E+00,3.02301E-01
-9.68224E+00,2.96831E-01
-9.36988E+00,2.91104E-01
-9.05751E+00,2.85121E-01
-8.74515E+00,2.78881E-01
-8.43279E+00,2.72384E-01
-8.12043E+00,2.65631E-01
-7.80808E+00,2.58622E-01
-7.49573E+00,2.51356E-01
-7.18338E+00,2.43833E-01
-6.87103E+00,2.36054E-01
-6.55869E+00,2.28018E-01
-6.24634E+00,2.19726E-01
-5.93401E+00,2.11177E-01
-5.62167E+00,2.02371E-01
-5.30933E+00,1.93309E-01
-4.99700E+00,1.83991E-01
-4.68467E+00,1.74416E-01
-4.37235E+00,1.64584E-01
-4.06002E+00,1.54496E-01
-3.74770E+00,1.44151E-01
-3.43538E+00,1.33550E-01
-3.12306E+00,1.22692E-01
-2.81075E+00,1.11578E-01
-2.49843E+00,1.00207E-01
-2.18612E+00,8.85791E-02
-1.87381E+00,7.66949E-02
-1.56151E+00,6.45540E-02
-1.24920E+00,5.21565E-02
-9.36898E-01,3.95024E-02
-6.24596E-01,2.65916E-02
-3.12297E-01,1.34241E-02
0,0
3.07491E-01,-1.34684E-02
6.14980E-01,-2.71857E-02
9.22467E-01,-4.11519E-02
1.22995E+00,-5.53671E-02
1.53744E+00,-6.98311E-02
1.84492E+00,-8.45441E-02
2.15240E+00,-9.95060E-02
2.45988E+00,-1.14717E-01
2.76735E+00,-1.30177E-01
3.07483E+00,-1.45886E-01
3.38230E+00,-1.61844E-01
3.68978E+00,-1.78051E-01
3.99724E+00,-1.94507E-01
4.30471E+00,-2.11213E-01
4.61218E+00,-2.28167E-01
4.91965E+00,-2.45371E-01
5.22711E+00,-2.62823E-01
5.53458E+00,-2.80526E-01
5.84204E+00,-2.98477E-01
6.14950E+00,-3.16678E-01
6.45696E+00,-3.35127E-01
6.76441E+00,-3.53827E-01
7.07187E+00,-3.72775E-01
7.37933E+00,-3.91973E-01
7.68678E+00,-4.11421E-01
7.99423E+00,-4.31118E-01
8.30169E+00,-4.51064E-01
8.60914E+00,-4.71260E-01
8.91658E+00,-4.91706E-01
9.22403E+00,-5.12401E-01
9.53148E+00,-5.33346E-01
9.83893E+00,-5.54540E-01
1.01464E+01,-5.75985E-01
1.04538E+01,-5.97679E-01
1.07613E+01,-6.19622E-01
1.10687E+01,-6.41816E-01
1.13761E+01,-6.64260E-01
1.16836E+01,-6.86953E-01
1.19910E+01,-7.09897E-01
1.22985E+01,-7.33090E-01
1.26059E+01,-7.56534E-01
1.29133E+01,-7.80227E-01
1.32208E+01,-8.04171E-01
1.35282E+01,-8.28365E-01
1.38356E+01,-8.52809E-01
1.41431E+01,-8.77504E-01
1.44505E+01,-9.02449E-01
1.47579E+01,-9.27644E-01
1.50654E+01,-9.53090E-01
1.53728E+01,-9.78786E-01
1.56802E+01,-1.00473E+00
1.59877E+01,-1.03093E+00
1.62951E+01,-1.05738E+00
1.66025E+01,-1.08408E+00
1.69099E+01,-1.11103E+00
1.72174E+01,-1.13823E+00
1.75248E+01,-1.16568E+00
1.78322E+01,-1.19338E+00
1.81396E+01,-1.22134E+00
1.84471E+01,-1.24954E+00
1.87545E+01,-1.27799E+00
1.90619E+01,-1.30670E+00
1.93693E+01,-1.33566E+00
1.96768E+01,-1.36487E+00
1.99842E+01,-1.39433E+00
EOD
$s5_1 << EOD
-1000,8.50401E-02
-900,7.65065E-02
-800,6.79795E-02
-700,5.94591E-02
-600,5.09453E-02
-500,4.24381E-02
-400,3.39375E-02
-300,2.54433E-02
-200,1.69557E-02
-100,8.47464E-03
0,0
100,-8.46819E-03
200,-1.69299E-02
300,-2.53853E-02
400,-3.38343E-02
500,-4.22769E-02
600,-5.07131E-02
700,-5.91430E-02
800,-6.75667E-02
900,-7.59840E-02
1000,-8.43951E-02
EOD
$s6_1 << EOD
-100,-1.01891E-01
-90,-9.17104E-02
-80,-8.15276E-02
-70,-7.13429E-02
-60,-6.11564E-02
-50,-5.09682E-02
-40,-4.07781E-02
-30,-3.05863E-02
-20,-2.03927E-02
-10,-1.01972E-02
0,0
10,1.01991E-02
20,2.03999E-02
30,3.06026E-02
40,4.08072E-02
50,5.10135E-02
60,6.12217E-02
70,7.14317E-02
80,8.16436E-02
90,9.18573E-02
100,1.02073E-01
EOD
$s7_1 << EOD
-1000,-5.70569E-02
-900,-5.16019E-02
-800,-4.60911E-02
-700,-4.05245E-02
-600,-3.49023E-02
-500,-2.92244E-02
-400,-2.34907E-02
-300,-1.77015E-02
-200,-1.18566E-02
-100,-5.95608E-03
0,0
100,6.01163E-03
200,1.20788E-02
300,1.82014E-02
400,2.43795E-02
500,3.06131E-02
600,3.69020E-02
700,4.32463E-02
800,4.96460E-02
900,5.61009E-02
1000,6.26110E-02
EOD
$s8_1 << EOD
-1000,-3.21504E+00
-900,-2.89515E+00
-800,-2.57490E+00
-700,-2.25429E+00
-600,-1.93332E+00
-500,-1.61199E+00
-400,-1.29031E+00
-300,-9.68269E-01
-200,-6.45870E-01
-100,-3.23113E-01
0,0
100,3.23470E-01
200,6.47297E-01
300,9.71481E-01
400,1.29602E+00
500,1.62092E+00
600,1.94617E+00
700,2.27177E+00
800,2.59773E+00
900,2.92405E+00
1000,3.25072E+00
EOD
$s9_1 << EOD
-9.99461E+00,-9.16775E+00
-9.68224E+00,-8.88259E+00
-9.36988E+00,-8.59734E+00
-9.05751E+00,-8.31201E+00
-8.74515E+00,-8.02660E+00
-8.43279E+00,-7.74110E+00
-8.12043E+00,-7.45552E+00
-7.80808E+00,-7.16985E+00
-7.49573E+00,-6.88409E+00
-7.18338E+00,-6.59825E+00
-6.87103E+00,-6.31233E+00
-6.55869E+00,-6.02632E+00
-6.24634E+00,-5.74022E+00
-5.93401E+00,-5.45404E+00
-5.62167E+00,-5.16777E+00
-5.30933E+00,-4.88142E+00
-4.99700E+00,-4.59497E+00
-4.68467E+00,-4.30845E+00
-4.37235E+00,-4.02183E+00
-4.06002E+00,-3.73513E+00
-3.74770E+00,-3.44834E+00
-3.43538E+00,-3.16146E+00
-3.12306E+00,-2.87450E+00
-2.81075E+00,-2.58745E+00
-2.49843E+00,-2.30030E+00
-2.18612E+00,-2.01308E+00
-1.87381E+00,-1.72576E+00
-1.56151E+00,-1.43836E+00
-1.24920E+00,-1.15086E+00
-9.36898E-01,-8.63280E-01
-6.24596E-01,-5.75609E-01
-3.12297E-01,-2.87849E-01
0,0
3.07491E-01,2.83508E-01
6.14980E-01,5.67103E-01
9.22467E-01,8.50785E-01
1.22995E+00,1.13455E+00
1.53744E+00,1.41841E+00
1.84492E+00,1.70235E+00
2.15240E+00,1.98639E+00
2.45988E+00,2.27050E+00
2.76735E+00,2.55471E+00
3.07483E+00,2.83901E+00
3.38230E+00,3.12339E+00
3.68978E+00,3.40786E+00
3.99724E+00,3.69242E+00
4.30471E+00,3.97707E+00
4.61218E+00,4.26181E+00
4.91965E+00,4.54664E+00
5.22711E+00,4.83155E+00
5.53458E+00,5.11656E+00
5.84204E+00,5.40165E+00
6.14950E+00,5.68684E+00
6.45696E+00,5.97212E+00
6.76441E+00,6.25748E+00
7.07187E+00,6.54294E+00
7.37933E+00,6.82848E+00
7.68678E+00,7.11412E+00
7.99423E+00,7.39985E+00
8.30169E+00,7.68566E+00
8.60914E+00,7.97157E+00
8.91658E+00,8.25757E+00
9.22403E+00,8.54367E+00
9.53148E+00,8.82985E+00
9.83893E+00,9.11612E+00
1.01464E+01,9.40249E+00
1.04538E+01,9.68895E+00
1.07613E+01,9.97550E+00
1.10687E+01,1.02622E+01
1.13761E+01,1.05489E+01
1.16836E+01,1.08357E+01
1.19910E+01,1.11226E+01
1.22985E+01,1.14096E+01
1.26059E+01,1.16968E+01
1.29133E+01,1.19840E+01
1.32208E+01,1.22713E+01
1.35282E+01,1.25586E+01
1.38356E+01,1.28461E+01
1.41431E+01,1.31337E+01
1.44505E+01,1.34214E+01
1.47579E+01,1.37091E+01
1.50654E+01,1.39970E+01
1.53728E+01,1.42850E+01
1.56802E+01,1.45730E+01
1.59877E+01,1.48612E+01
1.62951E+01,1.51494E+01
1.66025E+01,1.54377E+01
1.69099E+01,1.57262E+01
1.72174E+01,1.60147E+01
1.75248E+01,1.63033E+01
1.78322E+01,1.65920E+01
1.81396E+01,1.68808E+01
1.84471E+01,1.71698E+01
1.87545E+01,1.74588E+01
1.90619E+01,1.77479E+01
1.93693E+01,1.80371E+01
1.96768E+01,1.83264E+01
1.99842E+01,1.86158E+01
EOD

do for [format in formats] {
if (format eq 'png') { set terminal pngcairo size 1500, 1288 font 'sans-serif,12' noenhanced }
if (format eq 'svg') { set terminal svg size 1500, 1288 font 'sans-serif,12' noenhanced background 'white' }
if (format eq 'pdf') { set terminal pdfcairo size 30cm, 25cm font 'sans-serif,12' noenhanced }
set output 'mcpherson_axle_carsim.'.format
set label 1 'McPherson front axle with rack, anti-roll bar and stops: carsim' at screen 2.00000E-02, screen 9.76710E-01 font 'sans-serif:Bold,20' textcolor rgb '#202020'
set label 2 'points of the exported file over curves that were solved separately' at screen 2.00000E-02, screen 9.53420E-01 font 'sans-serif,14' textcolor rgb '#606060'
set multiplot
set palette defined (0 '#440154', 2.50000E-01 '#3B528B', 5.00000E-01 '#21918C', 7.50000E-01 '#5EC962', 1 '#E8D000')
set key at screen 9.70000E-01, screen 9.90680E-01 right top samplen 1.60000E+00 textcolor rgb '#404040'
unset colorbox

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 6.83230E-01; set tmargin at screen 9.05280E-01
set title 'TOE_TABLE, iside 1' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s1_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'mcpherson_axle_carsim.par' skip 10 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'
unset label 1; unset label 2; unset label 9; unset key

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 6.83230E-01; set tmargin at screen 9.05280E-01
set title 'CAMBER_TABLE, iside 1' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
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
     'mcpherson_axle_carsim.par' skip 17 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 6.83230E-01; set tmargin at screen 9.05280E-01
set title 'SUSP_X_TABLE, iside 1' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
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
     'mcpherson_axle_carsim.par' skip 24 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 3.72670E-01; set tmargin at screen 5.94720E-01
set title 'SUSP_LAT_TABLE, iside 1' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s4_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     'mcpherson_axle_carsim.par' skip 31 every ::0:0:3:0 using 1:2 with points pointtype 6 pointsize 1.10000E+00 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 3.72670E-01; set tmargin at screen 5.94720E-01
set title 'CS_FY, steer under Fy' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s5_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     -8.47141E-05*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 3.72670E-01; set tmargin at screen 5.94720E-01
set title 'CS_MZ, steer under Mz' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N m' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s6_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     1.01982E-03*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.33330E-02; set rmargin at screen 3.13330E-01; set bmargin at screen 6.21120E-02; set tmargin at screen 2.84160E-01
set title 'CC_FX, camber under Fx' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'N' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'deg' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s7_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     5.98386E-05*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 4.06670E-01; set rmargin at screen 6.46670E-01; set bmargin at screen 6.21120E-02; set tmargin at screen 2.84160E-01
set title 'C_LONG, x under Fx' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
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
     3.23292E-03*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'

set lmargin at screen 7.40000E-01; set rmargin at screen 9.80000E-01; set bmargin at screen 6.21120E-02; set tmargin at screen 2.84160E-01
set title 'CMP_SPR_SEAT, compression of the spring' offset 0, -4.00000E-01 font 'sans-serif:Bold,12' textcolor rgb '#202020'
set xlabel 'wheel centre, height [mm]' offset 0, 3.00000E-01 textcolor rgb '#404040'
set ylabel 'mm' offset 6.00000E-01, 0 textcolor rgb '#404040'
set xtics scale 6.00000E-01 autofreq; set grid xtics; unset logscale x; set format x
set yzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set xrange [*:*]
set ytics scale 6.00000E-01 autofreq; set grid ytics; unset logscale y; set format y
set xzeroaxis linetype 1 linecolor rgb '#909090' linewidth 1.20000E+00
set yrange [*:*]
set border 3
plot $s9_1 using 1:2 with lines linewidth 2 linecolor rgb '#D55E00' title 'solved separately', \
     9.21940E-01*x with lines dashtype 2 linewidth 2 linecolor rgb '#0072B2' title 'written file'
unset multiplot
unset label
unset output
}
