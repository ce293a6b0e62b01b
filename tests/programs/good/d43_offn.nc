; setup: dialect sinumerik
; setup: tool 1 9.5
; setup: allowance 0.25
; the stock of the setup and the one of the program
N10 G17 G90 G71
N20 T1 M6
N30 D1 OFFN=0.25
N40 G0 X-20 Y0 F1000
N50 G41 G1 X0 Y0
N60 X50
N70 Y50
N80 G40 X30 Y60
