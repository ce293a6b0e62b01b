#pragma once

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/named_words.h"

namespace trc {

// AP= and RP=, also with AC() and IC().
bool read_polar_word(Reading& reading, const NamedWord& word, ProgramLine& line, BlockWords& block);

// G110 counts from where the machine stands, G111 from the zero point, G112 from the last pole.
void take_pole(Reading& reading, const BlockWords& block);

// AP= and RP= become the coordinates of the plane; an arc among them has the pole for its centre.
bool resolve_polar_words(Reading& reading, ProgramLine& line, BlockWords& block);

// AC() and IC() become coordinates as G90 and G91 have them; AR= and CIP become a centre.
bool resolve_references(Reading& reading, ProgramLine& line, BlockWords& block);

// CT: the arc goes on where the contour has led. Where that is straight ahead it is a line.
bool take_tangent(Reading& reading, ProgramLine& line, BlockWords& block);

// ANG= of Sinumerik and ,A of Fanuc: the angle of a line, with one of its coordinates.
bool take_angle(Reading& reading, ProgramLine& line, BlockWords& block);

}  // namespace trc
