; refused 900306 line 5
#<depth> = -2
o100 sub
o100 endsub
o200 call [#<depth>]
M2
