[MDI_HEADER]
 FILE_TYPE = 'reb'
[UNITS]
 LENGTH = 'mm'
 FORCE = 'newton'
[CURVE]
{ disp force }
  0.0    0.0
 10.0  250.0
 20.0  700.0
 40.0 6000.0
