#include "core/nc/dialect/gcode_corners.h"

#include <string>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/reading.h"

// Roundings and chamfers of the dialects of plain letters and numbers: ,R and ,C, RND=, CHF=, CHR=
// and RNDM=, G36 and G39 of Fagor.

namespace trc {
namespace {

using enum GGroup;

}  // namespace

bool take_fagor_words(Reading& reading, ProgramLine& line, BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  if (reading.dialect.name != DialectName::fanuc || found.function == nullptr || !block.move.radius)
    return true;
  const int number = found.function->number;
  if (number < 36 || number > 39) return true;
  if (number == 37 || number == 38) {
    const bool selects = block.selects();
    if (!reading.trc_active() && !selects) return true;
    return reading.refuse(
        line,
        TextFault{.code = Code::nc_unsupported,
                  .begin = found.begin,
                  .detail = number == 37 ? "G37 R, a tangential entry: program its line and arc"
                                         : "G38 R, a tangential exit: program its arc and line"});
  }
  block.corners.begin = found.begin;
  block.move.corner = {.form = number == 36 ? CornerCut::Form::round : CornerCut::Form::leg,
                       .size = *block.move.radius};
  block.move.radius.reset();
  const bool in_contour = reading.trc_active() && !block.has(side);
  block.center.reset();
  for (WordRange& word : line.words) {
    const char letter = line.text[word.begin];
    if (word.role == WordRole::coordinate && (letter == 'R' || letter == 'r'))
      word.role = in_contour ? WordRole::trc : WordRole::technology;
    const bool is_center = letter >= 'I' && letter <= 'K';
    if (word.role == WordRole::coordinate && (is_center || (letter >= 'i' && letter <= 'k')) &&
        !block.center)
      block.center = word.begin;
  }
  found = {};
  return true;
}

bool take_modal_rounding(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool selects = block.selects();
  const bool ends = block.deselects() && reading.trc_active();
  if (block.corners.modal_rounding) {
    reading.gcode.corners.modal_rounding =
        block.corners.modal_rounding->value * reading.length_unit();
    if (reading.trc_active() || selects)
      for (WordRange& word : line.words)
        if (word.begin == block.corners.modal_rounding->begin) word.role = WordRole::trc;
  }
  const bool from_outside = selects && !reading.trc_active() && !block.corners.modal_rounding;
  // The corner before the departure is that of the block that leads to it: RNDM=0 after that
  // block does not end it.
  const bool rounds_departure = ends && reading.gcode.corners.last_is_round;
  if (rounds_departure || (reading.gcode.corners.modal_rounding != 0 && (from_outside || ends)))
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = block.of(side).begin,
                        .detail = "RNDM= beyond the contour: set it after G41, G42, and "
                                  "to 0 before G40"});
  if (block.axis || block.center)
    reading.gcode.corners.last_is_round = reading.gcode.corners.modal_rounding != 0 && !selects;
  if (reading.gcode.corners.modal_rounding != 0 && reading.trc_active() && !selects &&
      (block.axis || block.center) && !block.corners.begin && !block.copied)
    block.move.corner = {.form = CornerCut::Form::round,
                         .size = reading.gcode.corners.modal_rounding / reading.length_unit(),
                         .modal = true};
  return true;
}

bool take_corner_feed(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (block.corners.modal_feed)
    reading.gcode.corners.feed = block.corners.modal_feed->value * reading.feed_unit(reading.unit);
  if (!block.move.corner || !reading.trc_active()) return true;
  const bool is_said = block.corners.feed && block.corners.feed->value > 0;
  block.move.corner_feed = is_said ? block.corners.feed->value * reading.feed_unit(reading.unit)
                                   : reading.gcode.corners.feed;
  for (WordRange& word : line.words)
    if (block.corners.feed && word.begin == block.corners.feed->begin) word.role = WordRole::trc;
  if (block.move.corner_feed == 0 || reading.feed_mode == 94) return true;
  return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                        .begin = block.corners.feed ? block.corners.feed->begin
                                                                    : begin_of_words(line),
                                        .detail = "FRC= or FRCM=, no feed per minute"});
}

bool take_corner(Reading& reading, ProgramLine& line, BlockWords& block) {
  const bool moves = block.axis || block.center;
  const bool selects = block.selects();
  // The approach is not the line that the programmed rounding leads into.
  if (selects && reading.gcode.corners.open.source.line > 0)
    return reading.refuse_at(reading.gcode.corners.open, Code::nc_unsupported,
                             "a rounding or a chamfer before the motion that selects TRC");
  if (moves) reading.gcode.corners.open = {};
  if (!block.corners.begin) return true;
  if (!reading.contour_open() && !block.has(side)) {
    if (moves && block.move.corner->size != 0)
      reading.gcode.corners.open = reading.place_of_word(line, *block.corners.begin);
    block.move.corner.reset();
    return true;
  }
  const bool nothing_else = reading.trc_active() && !block.has(side) && block.axis;
  if (!nothing_else || !(block.move.corner->size >= 0))
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = *block.corners.begin,
                                    .detail = "a rounding or a chamfer beside G40 … G42, or after "
                                              "a motion that is none"});
  if (block.move.corner->size == 0) block.move.corner.reset();
  for (WordRange& word : line.words)
    if (word.begin == *block.corners.begin) word.role = WordRole::trc;
  return true;
}

}  // namespace trc
