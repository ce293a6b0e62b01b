; radius 0.25 in
G17 G20 G40 G80 G90 G94 (Safe line)
G54 (fixture offset)

T1 M06 (Change to 1/2" end mill)
G43 H5 (tool length offset)

G00 X-1.0 Y.25
G00 Z1.0

S800 M03 (Spindle on clockwise rotation)
F5.0 (Feed rate)
M08 (Coolant on)
G01 Z0.0

G01 G41 D01 X0 (comp (left) on)

G01 X0    Y2.25
G02 X.25  Y2.5  R.25
G01 X1.75 Y2.5
G02 X2.0  Y2.25 R.25
G01 X2.0  Y1.75
G03 X2.35 Y1.4  R.35
G01 X3.25 Y1.4
G02 X3.5  Y1.15 R.25
G01 X3.5  Y.25
G02 X3.25 Y0    R.25
G01 X.25  Y0
G02 X0    Y.25  R.25
G40 (comp off)
G01 Z1.0 (lift up slow)

M09 (Coolant off)

G00 Z7.0 (Rapid to Z home)
G53 G00 Y0 (bring vise forward)
M02 (Program end)
%
