# Sourced: contours whose size matters.

# ring BLOCKS: a closed contour of so many lines that comes near itself nowhere: a circle with ripples,
# compensated outside. Under contour masking it is held back as a whole.
ring() {
  awk -v blocks="$1" 'BEGIN {
    turn = 8 * atan2(1, 1); radius = blocks * 5 / turn
    printf "N1 G17 G90 G138 G25\nN2 V.G.WZ_AKT.R = 5\nN3 G00 X%.4f Y-60\n", radius + 40
    for (i = 0; i <= blocks; i++) {
      angle = turn * i / blocks
      r = radius + 8 * sin(angle * blocks / 12)
      printf "N%d %sX%.4f Y%.4f\n", i + 4, i ? "" : "G42 G01 F1000 ", r * cos(angle), r * sin(angle)
    }
    printf "N%d G40 X%.4f Y60\nN%d M30\n", i + 4, radius + 40, i + 5
  }'
}
