# Frame and signs, three figures: frame.svg, signs.svg, tests.svg. Drawn by draw.sh, which gives folder and format.
# Every panel is drawn to one scale in its own units; a wheel is a rectangle turned about its centre.

set encoding utf8
unset key; unset border; unset tics; set margins 0, 0, 0, 0
set style arrow 1 head filled size screen 0.012, 20 lw 2 lc rgb '#1f4e9c'      # axes, directions
set style arrow 2 head filled size screen 0.010, 20 lw 2 lc rgb '#b3361a'      # what is positive
set style arrow 3 nohead lw 1 dt 2 lc rgb '#777777'                             # reference lines
set style arrow 4 nohead lw 2 lc rgb '#333333'                                  # links
set style arrow 5 heads size screen 0.006, 20 lw 1 lc rgb '#b3361a'             # dimensions
body = '#333333'; red = '#b3361a'; blue = '#1f4e9c'

# corner k of a rectangle of width w and height h about (x, y), turned by a degrees counterclockwise
cx(x, w, h, a, k) = x + cos(a*pi/180)*w*(k == 0 || k == 3 ? -0.5 : 0.5) - sin(a*pi/180)*h*(k < 2 ? -0.5 : 0.5)
cy(y, w, h, a, k) = y + sin(a*pi/180)*w*(k == 0 || k == 3 ? -0.5 : 0.5) + cos(a*pi/180)*h*(k < 2 ? -0.5 : 0.5)
n = 100
box = 'n = n + 1; set object n polygon from cx(X,W,H,A,0),cy(Y,W,H,A,0) to cx(X,W,H,A,1),cy(Y,W,H,A,1) '. \
  'to cx(X,W,H,A,2),cy(Y,W,H,A,2) to cx(X,W,H,A,3),cy(Y,W,H,A,3) to cx(X,W,H,A,0),cy(Y,W,H,A,0) lw 1.5 fs solid 0.15 border rgb body fc rgb body'
clean = 'unset object; unset arrow; unset label; n = 100'

# figure(NAME, HEIGHT): terminal and file
figure(name, height) = sprintf(format eq 'svg' ? "set terminal svg size 1050,%d background '#ffffff' font 'sans-serif,11'" : \
  "set terminal pngcairo size 1050,%d font 'sans,10'", height).sprintf("; set output '%s/%s.%s'", folder, name, format)

# ---- the frame ---------------------------------------------------------------------------------

eval figure('frame', 390)
set multiplot layout 1, 3
set xrange [-1.6:1.6]; set yrange [-1.5:1.95]; set size ratio -1

set label 1 "axes = 'x-rear' (default), from above" at 0, 1.75 center font ',13'
set label 2 'front of the car' at 0, 1.5 center tc rgb '#777777'
set arrow from 0, 1.18 to 0, 1.40 as 3
X = -0.8; Y = 0.9; W = 0.26; H = 0.6; A = 0; eval box
X = 0.8; eval box
X = -0.8; Y = -0.75; eval box
X = 0.8; eval box
set arrow from 0, 0.9 to 0, 0.15 as 1; set label 'x, rearward' at 0.0, 0.02 center tc rgb blue
set arrow from 0, 0.9 to 0.55, 0.9 as 1; set label 'y, right' at 0.12, 1.02 tc rgb blue
set object 1 circle at 0, 0.9 radius 0.06 lw 1.5 fs solid 1 border rgb blue fc rgb 'white'
set object 2 circle at 0, 0.9 radius 0.015 fs solid 1 fc rgb blue
set label 'z, up' at -0.1, 0.75 right tc rgb blue
set label 'left: y < 0' at -0.8, 0.45 center; set label 'right: y > 0' at 0.85, 0.45 center
plot NaN
eval clean

set label 1 "axes = 'iso', from above" at 0, 1.75 center font ',13'
X = -0.8; Y = 0.9; A = 0; eval box
X = 0.8; eval box
X = -0.8; Y = -0.75; eval box
X = 0.8; eval box
set arrow from 0, 0.9 to 0, 1.55 as 1; set label 'x, forward' at 0.08, 1.45 tc rgb blue
set arrow from 0, 0.9 to -0.55, 0.9 as 1; set label 'y, left' at -0.12, 1.02 right tc rgb blue
set object 1 circle at 0, 0.9 radius 0.06 lw 1.5 fs solid 1 border rgb blue fc rgb 'white'
set object 2 circle at 0, 0.9 radius 0.015 fs solid 1 fc rgb blue
set label 'z, up' at 0.1, 0.75 tc rgb blue
set label 'left: y > 0' at -0.8, 0.45 center; set label 'right: y < 0' at 0.85, 0.45 center
set label 'the signs of toe, camber and all' at 0, -0.1 center tc rgb '#777777'
set label 'other angles are the same' at 0, -0.28 center tc rgb '#777777'
plot NaN
eval clean

set label 1 'from behind: z up, y right' at 0, 1.75 center font ',13'
X = -0.9; Y = -0.2; W = 0.3; H = 1.1; A = 0; eval box
X = 0.9; eval box
set arrow from -1.5, -0.75 to 1.5, -0.75 as 3
set arrow from 0, -0.2 to 0.55, -0.2 as 1; set label 'y' at 0.6, -0.2 tc rgb blue
set arrow from 0, -0.2 to 0, 0.5 as 1; set label 'z' at 0.06, 0.5 tc rgb blue
set object 1 circle at 0, -0.2 radius 0.06 lw 1.5 fs solid 1 border rgb blue fc rgb 'white'
set object 2 circle at 0, -0.2 radius 0.015 fs solid 1 fc rgb blue
set label 'x points at you' at 0.0, -0.42 center tc rgb blue
set label 'origin: anywhere in the plane y = 0; the library has' at 0, -1.1 center tc rgb '#777777'
set label 'it on the line of the wheel centres' at 0, -1.28 center tc rgb '#777777'
plot NaN
eval clean
unset multiplot

# ---- signs of the wheel ------------------------------------------------------------------------

eval figure('signs', 640)
set multiplot layout 2, 3
set xrange [-1.6:1.6]; set yrange [-1.35:1.35]

set label 1 'toe > 0: front edge inward' at 0, 1.2 center font ',13'
set label 2 'from above, front at the top' at 0, 1.0 center tc rgb '#777777'
W = 0.26; H = 0.9; Y = 0; X = -0.9; A = -10; eval box
X = 0.9; A = 10; eval box
set arrow from -0.9, -0.75 to -0.9, 0.85 as 3; set arrow from 0.9, -0.75 to 0.9, 0.85 as 3
set arrow from -0.9, 0.68 to -0.72, 0.66 as 2; set arrow from 0.9, 0.68 to 0.72, 0.66 as 2
set label 'both +' at 0, 0.62 center tc rgb red
set label 'left' at -0.9, -0.95 center; set label 'right' at 0.9, -0.95 center
plot NaN
eval clean

set label 1 'steer > 0: to the left' at 0, 1.2 center font ',13'
set label 2 'from above, front at the top' at 0, 1.0 center tc rgb '#777777'
X = -0.9; A = 20; eval box
X = 0.9; A = 16; eval box
set arrow from -0.9, -0.75 to -0.9, 0.85 as 3; set arrow from 0.9, -0.75 to 0.9, 0.85 as 3
set arrow from -0.9, 0.66 to -1.16, 0.60 as 2; set arrow from 0.9, 0.66 to 0.68, 0.60 as 2
set label 'left: steer = -toe' at -0.85, -0.95 center; set label 'right: steer = +toe' at 0.85, -0.95 center
set label 'aligning torque > 0' at 0, -0.35 center tc rgb red; set label '(rig, M_z up)' at 0, -0.52 center tc rgb red
set arrow from 0.28, 0.0 to 0.12, 0.25 as 2; set object 1 circle at 0, 0 radius 0.3 arc [-40:60] nowedge lw 2 fs empty border rgb red
plot NaN
eval clean

set label 1 'camber > 0: top outward' at 0, 1.2 center font ',13'
set label 2 'from behind' at 0, 1.0 center tc rgb '#777777'
W = 0.26; H = 1.1; X = -0.9; A = 10; eval box
X = 0.9; A = -10; eval box
set arrow from -0.9, -0.6 to -0.9, 0.8 as 3; set arrow from 0.9, -0.6 to 0.9, 0.8 as 3
set arrow from -0.9, 0.68 to -1.05, 0.68 as 2; set arrow from 0.9, 0.68 to 1.05, 0.68 as 2
set arrow from -1.5, -0.58 to 1.5, -0.58 as 3
set label 'both +; road cars: about -1 deg' at 0, -0.85 center tc rgb red
plot NaN
eval clean

set label 1 'caster > 0: top rearward' at 0, 1.2 center font ',13'
set label 2 'from the left, front at the left' at 0, 1.0 center tc rgb '#777777'
set object 1 circle at 0, 0 radius 0.75 lw 1.5 fs solid 0.1 border rgb body fc rgb body
set arrow from -1.5, -0.75 to 1.5, -0.75 as 3
set arrow from 0, -0.75 to 0, 0.85 as 3
set arrow from -0.30, -0.75 to 0.15, 0.85 as 4
set arrow from -0.01, 0.72 to 0.11, 0.72 as 2
set label 'steering axis' at 0.5, 0.83
set arrow from -0.30, -0.88 to 0, -0.88 as 5
set label 'mechanical trail > 0: axis ahead of the contact point' at 0, -1.08 center tc rgb red
set label 'x' at 1.32, -0.12 tc rgb blue; set arrow from 0.95, 0 to 1.25, 0 as 1
plot NaN
eval clean

set label 1 'kingpin inclination > 0: top inward' at 0, 1.2 center font ',13'
set label 2 'left wheel from behind, car to the right' at 0, 1.0 center tc rgb '#777777'
W = 0.35; H = 1.4; X = -0.5; Y = -0.05; A = 0; eval box
set arrow from -1.5, -0.75 to 1.5, -0.75 as 3
set arrow from -0.12, -0.75 to -0.12, 0.85 as 3
set arrow from -0.12, -0.75 to 0.28, 0.85 as 4
set arrow from -0.11, 0.72 to 0.23, 0.72 as 2
set label 'steering axis' at 0.34, 0.6
set arrow from -0.5, -0.88 to -0.12, -0.88 as 5
set label 'scrub radius > 0: axis inboard of the contact point' at 0, -1.08 center tc rgb red
plot NaN
eval clean

set label 1 'roll > 0: left wheel up' at 0, 1.2 center font ',13'
set label 2 'from behind, relative to the body' at 0, 1.0 center tc rgb '#777777'
W = 0.26; H = 0.9; X = -0.95; Y = 0.2; A = 0; eval box
X = 0.95; Y = -0.15; eval box
set arrow from -1.5, -0.15 to 1.5, -0.70 as 4
set arrow from -1.5, -0.43 to 1.5, -0.43 as 3
set arrow from -1.3, 0.0 to -1.3, 0.5 as 2; set arrow from 1.3, 0.1 to 1.3, -0.4 as 2
set label 'wheel travel > 0: bump' at 0, 0.42 center tc rgb red
set label 'the body rolls to the left' at 0, -1.0 center
plot NaN
eval clean
unset multiplot

# ---- loads of the tests ------------------------------------------------------------------------

eval figure('tests', 330)
set multiplot layout 1, 3
set xrange [-1.6:1.6]; set yrange [-1.15:1.5]

set label 1 'lateral force > 0: to the right' at 0, 1.35 center font ',13'
set label 2 'from behind' at 0, 1.15 center tc rgb '#777777'
W = 0.26; H = 1.0; Y = 0; X = -0.9; A = 0; eval box
X = 0.9; eval box
set arrow from -1.5, -0.5 to 1.5, -0.5 as 3
set arrow from -0.9, -0.5 to -0.4, -0.5 as 2; set arrow from 0.9, -0.5 to 1.4, -0.5 as 2
set label "phase = 'in' (parallel): a right-hand bend" at 0, -0.8 center tc rgb red
set label "'anti': the right wheel's force is reversed" at 0, -1.0 center tc rgb red
plot NaN
eval clean

set label 1 'braking > 0: rearward at the contact point' at 0, 1.35 center font ',12'
set label 2 'from the left, front at the left' at 0, 1.15 center tc rgb '#777777'
set object 1 circle at 0, 0.1 radius 0.6 lw 1.5 fs solid 0.1 border rgb body fc rgb body
set arrow from -1.5, -0.5 to 1.5, -0.5 as 3
set arrow from 0, -0.5 to 0.6, -0.5 as 2
set label 'wheel locked to its carrier' at 0, -0.8 center tc rgb red
set label '(outboard brake)' at 0, -1.0 center tc rgb red
plot NaN
eval clean

set label 1 'traction > 0: forward at the centre' at 0, 1.35 center font ',12'
set label 2 'from the left, front at the left' at 0, 1.15 center tc rgb '#777777'
set object 1 circle at 0, 0.1 radius 0.6 lw 1.5 fs solid 0.1 border rgb body fc rgb body
set arrow from -1.5, -0.5 to 1.5, -0.5 as 3
set arrow from 0, 0.1 to -0.6, 0.1 as 2
set label 'the body reacts the drive torque;' at 0, -0.8 center tc rgb red
set label "at the contact point with drive_reaction = 'patch'" at 0, -1.0 center noenhanced tc rgb red
plot NaN
eval clean
unset multiplot
