# The gallery of joints of docs/joints.md: joints.svg. Drawn by draw.sh, which gives folder and format.

set encoding utf8
if (format eq 'svg') set terminal svg size 1050,700 background '#ffffff' font 'sans-serif,11'
if (format eq 'png') set terminal pngcairo size 1050,700 font 'sans,10'
set termoption noenhanced
set output folder.'/joints.'.format
unset key; unset border; unset tics; set margins 0, 0, 0, 0
body = '#333333'; red = '#b3361a'; blue = '#1f4e9c'; grey = '#777777'
set style arrow 1 nohead lw 4 lc rgb body               # a rod, an arm
set style arrow 2 nohead lw 1 dt 2 lc rgb grey          # an axis
set style arrow 3 heads size screen 0.008, 20 lw 1.5 lc rgb blue      # a motion
set style arrow 4 nohead lw 9 lc rgb '#bbbbbb'          # a tube, a bar
n = 100
ball = 'n = n + 1; set object n circle at X, Y radius 0.07 lw 2 fs solid 1 border rgb red fc rgb "#ffffff"'
rubber = 'n = n + 1; set object n rectangle center X, Y size 0.2, 0.2 lw 2 fs solid 0.3 border rgb blue fc rgb blue'
clean = 'unset object; unset arrow; unset label; n = 100'
title = 'set label 1 T at 0, 1.22 center font ",13"; set label 2 S at 0, 1.03 center tc rgb grey'

set multiplot layout 2, 3
set xrange [-1.6:1.6]; set yrange [-1.35:1.4]; set size ratio -1

T = 'arm on two ball joints'; S = 'from above, outboard to the left'; eval title
set arrow from 0.8, 0.7 to -1.0, 0.0 as 1; set arrow from 0.8, -0.7 to -1.0, 0.0 as 1
set arrow from 0.8, 0.95 to 0.8, -1.0 as 2
X = 0.8; Y = 0.7; eval ball
Y = -0.7; eval ball
X = -1.0; Y = 0.0; eval ball
set label 'spherical' at 0.68, -0.85 right tc rgb red
set label 'in_line' at 0.68, 0.82 right tc rgb red
set label 'spherical' at -1.0, 0.2 center tc rgb red
set label 'pivot axis' at 0.88, 0.1 tc rgb grey
set label 'two spherical joints on the chassis would hold the' at 0, -1.12 center tc rgb grey
set label 'motion along the pivot axis twice' at 0, -1.28 center tc rgb grey
plot NaN
eval clean

T = 'strut, left wheel from behind'; S = ''; eval title
set arrow from -0.35, -0.75 to -0.02, 0.2 as 4; set arrow from -0.25, -0.46 to 0.22, 0.88 as 1
set arrow from -0.39, -0.86 to 0.26, 0.98 as 2
set arrow from -0.35, -0.75 to -1.0, -0.75 as 1
X = 0.22; Y = 0.88; eval rubber
set label 'bushing on the chassis, or' at 0.4, 0.87 tc rgb blue
set label 'spherical: rigid mount' at 0.4, 0.69 tc rgb red
set arrow from 0.22, 0.05 to 0.36, 0.45 as 3
set label 'cylindrical: slides and spins' at 0.2, -0.1 tc rgb red
set label 'damper rod' at 0.45, 0.32
set label 'tube, fixed to the carrier' at -0.15, -0.55
set label 'spring, damper, stops: between tube and rod' at 0, -1.12 center tc rgb grey
plot NaN
eval clean

T = 'link'; S = 'tie rod, drop link, push rod, control link'; eval title
set arrow from -1.0, 0.6 to 1.0, 0.7 as 1
X = -1.0; Y = 0.6; eval ball
X = 1.0; Y = 0.7; eval ball
set label 'distance: rigid, no body, no spin' at 0, 0.42 center tc rgb red
set arrow from -1.0, -0.3 to 1.0, -0.2 as 1
X = -1.0; Y = -0.3; eval ball
X = 1.0; Y = -0.2; eval rubber
set label 'a body: spherical, and rubber, which holds the spin' at 0, -0.48 center tc rgb red
set label 'rod ends: universal, and a bushing without kr' at 0, -0.66 center tc rgb red
set label 'two spherical joints leave the link free' at 0, -1.12 center tc rgb grey
set label 'to spin: check reports a mechanism' at 0, -1.28 center tc rgb grey
plot NaN
eval clean

T = 'anti-roll bar with drop links'; S = 'from above, front at the top'; eval title
set arrow from -0.9, 0.5 to -0.04, 0.5 as 4; set arrow from 0.04, 0.5 to 0.9, 0.5 as 4
set arrow from -0.9, 0.5 to -1.2, -0.3 as 4; set arrow from 0.9, 0.5 to 1.2, -0.3 as 4
X = -0.6; Y = 0.5; eval rubber
X = 0.6; eval rubber
X = -1.2; Y = -0.3; eval ball
X = 1.2; eval ball
set label 'cut: revolute between the halves,' at 0, 0.84 center tc rgb red
set label 'with &torsion, which is the bar' at 0, 0.68 center tc rgb blue
set label 'drop link: distance' at 0, -0.3 center tc rgb red
set label 'bushing' at -0.6, 0.28 center tc rgb blue; set label 'bushing' at 0.6, 0.28 center tc rgb blue
set label 'half a bar is a body' at 0, -1.12 center tc rgb grey
plot NaN
eval clean

T = 'rack'; S = 'from above'; eval title
set arrow from -0.9, 0.1 to 0.9, 0.1 as 4
set object 1 rectangle from -0.5, -0.1 to 0.5, 0.3 lw 1.5 fs solid 0.1 border rgb body fc rgb body
set arrow from -0.9, 0.1 to -1.4, 0.3 as 1; set arrow from 0.9, 0.1 to 1.4, 0.3 as 1
X = -0.9; Y = 0.1; eval ball
X = 0.9; eval ball
set arrow from -0.35, 0.5 to 0.35, 0.5 as 3
set label 'translational' at 0, 0.66 center tc rgb red
set label 'measure of type gap along it, and a driver of that measure' at 0, -0.4 center tc rgb red
set label 'driver with a stiffness: steering wheel held, rack yields' at 0, -0.6 center tc rgb blue
set label 'tie rods: distance' at 0, -1.12 center tc rgb grey
plot NaN
eval clean

T = 'rocker'; S = 'from behind'; eval title
set object 1 polygon from 0, 0 to -0.55, 0.35 to 0.1, 0.65 to 0, 0 lw 2 fs solid 0.2 border rgb body fc rgb body
set arrow from -1.4, -0.9 to -0.55, 0.35 as 1
set arrow from 0.1, 0.65 to 1.2, 0.6 as 4
X = 0; Y = 0; eval ball
X = -0.55; Y = 0.35; eval ball
X = 0.1; Y = 0.65; eval ball
X = -1.4; Y = -0.9; eval ball
set label 'revolute' at 0.14, -0.05 tc rgb red
set label 'push rod: distance' at -0.85, -0.4 tc rgb red
set label '&spring, &damper' at 0.3, 0.8 tc rgb blue
set label '&stop, to the chassis' at 0.3, 0.42 tc rgb blue
plot NaN
eval clean
unset multiplot
