#include <string>

#include "core/nc/dialect/block_words.h"

// Roundings and chamfers of the dialects of plain letters and numbers: ,R and ,C, RND=, CHF=, CHR=
// and RNDM=, G36 and G39 of Fagor.

namespace trc {
namespace {

using enum GGroup;

}  // namespace

// With R beside them G36 to G39 are those of Fagor: a rounding, a tangential entry and exit, a
// chamfer. Elsewhere they measure, or have no R.
bool Interpreter::take_fagor_words(ProgramLine& line, BlockWords& block) {
  BlockWords::Function& found = block.functions[static_cast<std::size_t>(single_move)];
  if (dialect_.name != DialectName::fanuc || found.function == nullptr || !block.move.radius)
    return true;
  const int number = found.function->number;
  if (number < 36 || number > 39) return true;
  if (number == 37 || number == 38) {
    const bool selects = block.has(side) && !block.of(side).is(40);
    if (!trc_active() && !selects) return true;
    return refuse(
        line,
        TextFault{.code = Code::nc_unsupported,
                  .begin = found.begin,
                  .detail = number == 37 ? "G37 R, a tangential entry: program its line and arc"
                                         : "G38 R, a tangential exit: program its arc and line"});
  }
  block.corner = found.begin;
  block.move.corner = {.form = number == 36 ? CornerCut::Form::round : CornerCut::Form::leg,
                       .size = *block.move.radius};
  block.move.radius.reset();
  const bool in_contour = trc_active() && !block.has(side);
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

// RNDM= rounds every corner. What the control would round in the output too must not be modal
// there, so that it begins and ends within the contour.
bool Interpreter::take_modal_rounding(ProgramLine& line, BlockWords& block) {
  const bool selects = block.has(side) && !block.of(side).is(40);
  const bool ends = block.of(side).is(40) && trc_active();
  if (block.modal_rounding) {
    code_.modal_rounding = block.modal_rounding->value * length_unit();
    if (trc_active() || selects)
      for (WordRange& word : line.words)
        if (word.begin == block.modal_rounding->begin) word.role = WordRole::trc;
  }
  const bool from_outside = selects && !trc_active() && !block.modal_rounding;
  if (code_.modal_rounding != 0 && (from_outside || ends))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = block.of(side).begin,
                                  .detail = "RNDM= beyond the contour: set it behind G41, G42, and "
                                            "to 0 in front of G40"});
  if (code_.modal_rounding != 0 && trc_active() && !selects && (block.axis || block.center) &&
      !block.corner && !block.copied)
    block.move.corner = {.form = CornerCut::Form::round,
                         .size = code_.modal_rounding / length_unit(),
                         .modal = true};
  return true;
}

// FRC= and FRCM=, the feed of a rounding or a chamfer, which becomes a block of its own. FRCM=
// holds for what comes behind the contour as well: it stays.
bool Interpreter::take_corner_feed(ProgramLine& line, BlockWords& block) {
  if (block.modal_corner_feed)
    code_.corner_feed = block.modal_corner_feed->value * feed_unit(inch_);
  if (!block.move.corner || !trc_active()) return true;
  const bool is_said = block.corner_feed && block.corner_feed->value > 0;
  block.move.corner_feed =
      is_said ? block.corner_feed->value * feed_unit(inch_) : code_.corner_feed;
  for (WordRange& word : line.words)
    if (block.corner_feed && word.begin == block.corner_feed->begin) word.role = WordRole::trc;
  if (block.move.corner_feed == 0 || feed_mode_ == 94) return true;
  return refuse(line, TextFault{.code = Code::nc_unsupported,
                                .begin = block.corner_feed ? block.corner_feed->begin
                                                           : line.words.front().begin,
                                .detail = "FRC= or FRCM=, no feed per minute"});
}

// While TRC is active the corner becomes blocks of its own, and its word is not written. Else the
// control makes it.
bool Interpreter::take_corner(ProgramLine& line, BlockWords& block) {
  const bool moves = block.axis || block.center;
  const bool selects = block.has(side) && !block.of(side).is(40);
  // The approach is another line than the one that the program rounds into.
  if (selects && code_.open_corner.source.line > 0)
    return refuse_at(code_.open_corner, Code::nc_unsupported,
                     "a rounding or a chamfer in front of the motion that selects TRC");
  if (moves) code_.open_corner = {};
  if (!block.corner) return true;
  if (!contour_open() && !block.has(side)) {
    if (moves && block.move.corner->size != 0)
      code_.open_corner = place_of_word(line, *block.corner);
    block.move.corner.reset();
    return true;
  }
  const bool nothing_else = trc_active() && !block.has(side) && block.axis;
  if (!nothing_else || !(block.move.corner->size >= 0))
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = *block.corner,
                                  .detail = "a rounding or a chamfer beside G40 … G42, or behind "
                                            "a motion that is none"});
  if (block.move.corner->size == 0) block.move.corner.reset();
  for (WordRange& word : line.words)
    if (word.begin == *block.corner) word.role = WordRole::trc;
  return true;
}

}  // namespace trc
