; refused 900003
#<depth> = -2
o100 sub
G0 X0 Y0
o100 endsub
o100 call
M2
