% Parameters of the block Independent Suspension - K and C (Vehicle Dynamics Blockset)
% elastokin VERSION
% front: Numbers of places, model numbered, deck checksum 0123
% rear: Numbers of places, model numbered, deck checksum 4567
% Arrays are [FL FR RL RR], of axles [F R]. Steer positive to the left, camber positive top outward, caster
% positive top rearward, x forward, y to the left, z and travel up; Mz up. In the block: ISO directions.
% Units are in the comments; compare them, and the order of the two rows, with the dialog of the block.

BumpSteer = [9.03846E-01 9.03846E-01 1.02854E+00 1.02854E+00]; % deg/mm: steer per travel
BumpCamber = [7.11538E-01 7.11538E-01 1.04263E+00 1.04263E+00]; % deg/mm: camber per travel
BumpCaster = [1 1 1 1]; % deg/mm: caster per travel
LatWhlCtrDisp = [7.11538E-01 7.11538E-01 1.04263E+00 1.04263E+00]; % mm/mm: y of the wheel centre per travel
LngWhlCtrDisp = [9.03846E-01 9.03846E-01 1.02854E+00 1.02854E+00]; % mm/mm: x of the wheel centre per travel
NrmlWhlRates = [7.11538E-01 7.11538E-01 1.04263E+00 1.04263E+00]; % N/mm: wheel rate in parallel travel
NrmlWhlFrcOff = [1.72230E+01 1.72240E+01 1.72230E+01 1.72240E+01]; % N: wheel load at design
CambVsSteerAng = [1.03061E+00 1.03061E+00 NaN NaN]; % deg/deg: camber per steer of the wheel
CastVsSteerAng = [1.01020E+00 1.01020E+00 NaN NaN]; % deg/deg: caster per steer of the wheel
LngSteerCompl = [1.83634E-02 3.06284E-02 3.48839E-02 5.87314E-02; 2.75776E-02 4.32556E-02 5.51552E-02 8.65113E-02]; % deg/N: row 1 braking (Fx < 0 at the contact point), row 2 driving (Fx > 0 at the wheel centre)
LngCambCompl = [-1.30714E-02 2.23567E-02 -2.48230E-02 4.28634E-02; -1.96702E-02 3.16065E-02 -3.93404E-02 6.32131E-02]; % deg/N: row 1 braking (Fx < 0 at the contact point), row 2 driving (Fx > 0 at the wheel centre)
LngCastCompl = [-1.91016E-02 -2.03236E-02 -3.62813E-02 -3.89686E-02; -2.87109E-02 -2.87166E-02 -5.74218E-02 -5.74333E-02]; % deg/N: row 1 braking (Fx < 0 at the contact point), row 2 driving (Fx > 0 at the wheel centre)
LngWhlCtrCompl = [6.61858E-03 7.07140E-03 1.25389E-02 1.35331E-02; 1.01100E-02 1.01200E-02 2.02200E-02 2.02400E-02]; % mm/N: row 1 braking (Fx < 0 at the contact point), row 2 driving (Fx > 0 at the wheel centre)
LatWhlCtrComplLngBrk = [1.32986E-02 1.41714E-02 2.52349E-02 2.71531E-02; 2.01100E-02 2.01200E-02 4.02200E-02 4.02400E-02]; % mm/N: row 1 braking (Fx < 0 at the contact point), row 2 driving (Fx > 0 at the wheel centre)
LatSteerCompl = [3.65437E-02 5.74162E-02 7.48719E-02 1.17650E-01]; % deg/N: steer per Fy at the contact point
LatCambCompl = [-2.61046E-02 4.19943E-02 -5.34860E-02 8.60514E-02]; % deg/N: camber per Fy at the contact point
LatWhlCtrComplLat = [2.67842E-02 2.68385E-02 5.48833E-02 5.50007E-02]; % mm/N: y of the wheel centre per Fy at the contact point
AlgnTrqSteerCompl = [2.77942E-02 4.36206E-02 5.55884E-02 8.72412E-02]; % deg/(N m): steer per Mz
AlgnTrqCambCompl = [-1.99233E-02 3.19754E-02 -3.98466E-02 6.39508E-02]; % deg/(N m): camber per Mz
StatToe = [-6.22700E+00 6.22800E+00 -6.22700E+00 6.22800E+00]; % deg: toe at design, positive: front edge inward
StatCamber = [1.22230E+01 1.22240E+01 1.22230E+01 1.22240E+01]; % deg: camber at design
StatCaster = [1.32290E+01 1.32300E+01 1.32290E+01 1.32300E+01]; % deg: caster at design
StatLdWhlR = [3.11000E-01 3.12000E-01 3.42100E-01 3.43200E-01]; % m: height of the wheel centre above the contact point at design
MotRatios = [-1 -1]; % -: compression of the damper per travel; axles
RollStiffArb = [1.69492E+03 4.93009E+02]; % N m/deg: roll stiffness with the bar; axles
RollStiffNoArb = [1.21326E+03 3.52853E+02]; % N m/deg: roll stiffness from the wheel rates in parallel travel, without the bar

% The same as tables, for the table-based settings: BumpSteer = KnCTables.BumpSteer; and so on
% BumpSteer: mm, deg, change from design
KnCTables.BumpSteer.FL = [
  -1.60000E-02 -1.20000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpSteer.FR = [
  -1.60000E-02 -1.20000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpSteer.RL = [
  -1.12000E-01 -1.14000E-01
  0 0
  1.04000E-01 1.08000E-01
];
KnCTables.BumpSteer.RR = [
  -1.12000E-01 -1.14000E-01
  0 0
  1.04000E-01 1.08000E-01
];
% BumpCamber: mm, deg, change from design
KnCTables.BumpCamber.FL = [
  -1.60000E-02 -4.00000E-03
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpCamber.FR = [
  -1.60000E-02 -4.00000E-03
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpCamber.RL = [
  -1.12000E-01 -1.08000E-01
  0 0
  1.04000E-01 1.16000E-01
];
KnCTables.BumpCamber.RR = [
  -1.12000E-01 -1.08000E-01
  0 0
  1.04000E-01 1.16000E-01
];
% BumpCaster: mm, deg, change from design
KnCTables.BumpCaster.FL = [
  -1.60000E-02 -1.60000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpCaster.FR = [
  -1.60000E-02 -1.60000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.BumpCaster.RL = [
  -1.12000E-01 -1.12000E-01
  0 0
  1.04000E-01 1.04000E-01
];
KnCTables.BumpCaster.RR = [
  -1.12000E-01 -1.12000E-01
  0 0
  1.04000E-01 1.04000E-01
];
% LatWhlCtrDisp: mm, mm, change from design
KnCTables.LatWhlCtrDisp.FL = [
  -1.60000E-02 -4.00000E-03
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.LatWhlCtrDisp.FR = [
  -1.60000E-02 -4.00000E-03
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.LatWhlCtrDisp.RL = [
  -1.12000E-01 -1.08000E-01
  0 0
  1.04000E-01 1.16000E-01
];
KnCTables.LatWhlCtrDisp.RR = [
  -1.12000E-01 -1.08000E-01
  0 0
  1.04000E-01 1.16000E-01
];
% LngWhlCtrDisp: mm, mm, change from design
KnCTables.LngWhlCtrDisp.FL = [
  -1.60000E-02 -1.20000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.LngWhlCtrDisp.FR = [
  -1.60000E-02 -1.20000E-02
  0 0
  1.00000E-02 1.00000E-02
];
KnCTables.LngWhlCtrDisp.RL = [
  -1.12000E-01 -1.14000E-01
  0 0
  1.04000E-01 1.08000E-01
];
KnCTables.LngWhlCtrDisp.RR = [
  -1.12000E-01 -1.14000E-01
  0 0
  1.04000E-01 1.08000E-01
];
% NrmlWhlRates: mm, N
KnCTables.NrmlWhlRates.FL = [
  -1.60000E-02 1.72190E+01
  0 1.72230E+01
  1.00000E-02 1.72330E+01
];
KnCTables.NrmlWhlRates.FR = [
  -1.60000E-02 1.72200E+01
  0 1.72240E+01
  1.00000E-02 1.72340E+01
];
KnCTables.NrmlWhlRates.RL = [
  -1.12000E-01 1.71150E+01
  0 1.72230E+01
  1.04000E-01 1.73390E+01
];
KnCTables.NrmlWhlRates.RR = [
  -1.12000E-01 1.71160E+01
  0 1.72240E+01
  1.04000E-01 1.73400E+01
];
% CambVsSteerAng: deg, deg, change from design
KnCTables.CambVsSteerAng.FL = [
  -9.80000E-02 -9.60000E-02
  0 0
  9.80000E-02 1.06000E-01
  1.96000E-01 2.02000E-01
];
KnCTables.CambVsSteerAng.FR = [
  -9.80000E-02 -9.60000E-02
  0 0
  9.80000E-02 1.06000E-01
  1.96000E-01 2.02000E-01
];
% CastVsSteerAng: deg, deg, change from design
KnCTables.CastVsSteerAng.FL = [
  -9.80000E-02 -1.04000E-01
  0 0
  9.80000E-02 9.40000E-02
  1.96000E-01 1.98000E-01
];
KnCTables.CastVsSteerAng.FR = [
  -9.80000E-02 -1.04000E-01
  0 0
  9.80000E-02 9.40000E-02
  1.96000E-01 1.98000E-01
];
