#include "core/nc/dialect/read_line.h"

#include <algorithm>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/dialect/apply_block.h"
#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/copied_block.h"
#include "core/nc/dialect/gcode_block_words.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/isg_block.h"
#include "core/nc/dialect/isg_block_words.h"
#include "core/nc/dialect/isg_command.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/klartext_labels.h"
#include "core/nc/dialect/klartext_plain.h"
#include "core/nc/dialect/passing_calls.h"
#include "core/nc/dialect/plain_motion.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/dialect/sinumerik_block.h"
#include "core/nc/dialect/turning.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

constexpr bool is_of_center(char letter) {
  return (letter >= 'I' && letter <= 'K') || letter == 'R';
}

// Sums up the roles and axes of the words.
void sum_up_words(ProgramLine& line) {
  line.roles = 0;
  line.names_other_axes = false;
  line.main_axes = 0;
  for (const WordRange& word : line.words) {
    line.roles |= bit(word.role);
    if (word.role != WordRole::coordinate) continue;
    if (!long_name_of(line, word).empty()) {
      line.names_other_axes = true;
      continue;
    }
    if (!names_an_axis(line, word)) continue;
    const char letter = upper(line.text[word.begin]);
    if (letter >= 'X' && letter <= 'Z') {
      line.main_axes |= main_axis_bit(static_cast<std::size_t>(letter - 'X'));
    } else if (!is_of_center(letter)) {
      line.names_other_axes = true;
    }
  }
}

// 1-based, of the first I, J, K or R of a plain motion; 0: none.
std::uint32_t column_of_center(const ProgramLine& line) {
  for (const WordRange& word : line.words)
    if (word.role == WordRole::coordinate && is_of_center(upper(line.text[word.begin])))
      return word.begin + 1;
  return 0;
}

// Cuts the words after a skip sign within the line, up to a comment.
void cut_skipped_words(Reading& reading, ProgramLine& line) {
  const SkipSign sign = skip_sign_within(line.text, reading.dialect.name);
  if (!sign.is_there() || is_beside_the_path(line.text, sign, reading.dialect.name)) return;
  reading.cut = sign;
  if (reading.state.setup().block_skip == BlockSkip::leave_out)
    reading.cut.end = std::min(line.text.find_first_of("(;", sign.end), line.text.size());
  line.text.erase(reading.cut.begin, reading.cut.end - reading.cut.begin);
}

// Applies the position of the machine's switch given in the setup: on, nothing of the line remains;
// off, all but its `/`.
bool is_left_out(Reading& reading, ProgramLine& line) {
  const BlockSkip decided = decided_about(line.text, reading.state.setup(), reading.cut);
  if (decided == BlockSkip::execute)
    line.text.erase(reading.cut.begin, reading.cut.end - reading.cut.begin);
  if (decided == BlockSkip::refuse) reading.cut = {};
  if (decided == BlockSkip::refuse) cut_skipped_words(reading, line);
  if (decided != BlockSkip::leave_out) return false;
  line.has_trc_words = true;
  return true;
}

// Text before a tape is for people (D-61): anything that looks like words there has no effect.
void forget_what_stands_in_front(Reading& reading) {
  reading.faults.clear();
  reading.gcode = {};
  reading.called_motion = reading.called_dimension = false;
}

// A subprogram before the program passes as text: calls of it are not followed.
bool read_line_of_subprogram(Reading& reading, const ProgramLine& line) {
  reading.isg_word_seen = true;
  const std::size_t place = place_of_side(line.text);
  return place == std::string_view::npos ||
         reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                        .begin = static_cast<std::uint32_t>(place),
                                        .detail = "G41, G42 in a subprogram"});
}

bool read_line_behind_end(Reading& reading, ProgramLine& line) {
  const bool klartext = reading.dialect.name == DialectName::heidenhain;
  if (klartext && !enter_label_behind_end(reading, line)) return false;
  const std::size_t place = klartext ? place_of_klartext_side(line.text) : place_of_side(line.text);
  if (place == std::string::npos) return true;
  // A contour of cycles: the cycles compensate it.
  if (klartext && reading.klartext_modes.cycle_section != 0 &&
      reading.klartext_modes.called_section == 0)
    return true;
  if (klartext && reading.klartext_modes.called_section != 0)
    return reading.refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = static_cast<std::uint32_t>(place),
                        .detail = "CALL LBL in line " +
                                  std::to_string(reading.klartext_modes.called_section) +
                                  ", whose contour stands after the end: write the lines of "
                                  "the label in its place"});
  const std::size_t behind =
      klartext ? place + 2 : line.text.find_first_not_of("Gg0123456789 ", place);
  std::string side = line.text.substr(place, behind - place);
  side.erase(side.find_last_not_of(' ') + 1);
  if (reading.ending_percent != 0)
    side.append(reason::after_percent).append(std::to_string(reading.ending_percent));
  return reading.refuse(line, TextFault{.code = Code::side_behind_end,
                                        .begin = static_cast<std::uint32_t>(place),
                                        .detail = std::move(side)});
}

bool read_words_of_dialect(Reading& reading, ProgramLine& line, BlockWords& block) {
  if (reading.sets_variables) {
    const auto end = static_cast<std::uint32_t>(line.text.size());
    line.words.push_back({.begin = 0, .end = end, .role = WordRole::technology});
    return true;
  }
  switch (reading.dialect.name) {
    case DialectName::isg:
      return read_isg_words(reading, line, block);
    case DialectName::sinumerik:
      return read_named_words(reading, line, block);
    case DialectName::heidenhain:
    case DialectName::fanuc:
    case DialectName::linuxcnc:
      break;
  }
  return read_gcode_words(reading, line, block);
}

// An increment of the third axis from an unknown position: while TRC is off nothing depends on it.
// Other motion in the line is not followed either.
void copy_plunge_from_nowhere(const Reading& reading, ProgramLine& line, BlockWords& block) {
  using enum GGroup;
  const std::size_t third = axes_of(reading.state.programmed_plane()).third;
  const auto reference = block.references.end[third];  // IC(…)
  const bool incremental = reference != 0         ? reference < 0
                           : block.has(dimension) ? block.of(dimension).is(91)
                                                  : reading.incremental;
  const bool straight = block.has(motion) ? block.of(motion).function->number < 2
                                          : reading.motion <= MotionKind::linear;
  if (block.copied || reading.contour_open() || block.has(side) || block.has(plane) ||
      !incremental || !straight || block.center || reading.state.is_known(third) ||
      !block.move.end[third])
    return;
  block.copied = true;
  block.forget |= block.named_axes();
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate) word.role = WordRole::technology;
}

bool read_block(Reading& reading, ProgramLine& line) {
  if (reading.dialect.name == DialectName::heidenhain) return read_klartext(reading, line);
  BlockWords block;
  const bool is_isg = reading.dialect.name == DialectName::isg;
  const bool passes = is_isg && !reading.contour_open() && read_passing_line(reading, line, block);
  const bool readable = reading.calls_the_machine
                            ? read_call_of_machine(reading, line, block)
                            : passes || read_words_of_dialect(reading, line, block);
  sum_up_words(line);
  if (!reading.faults.empty() && block.has(GGroup::side)) reading.scanned_trc = !block.deselects();
  // Text after the end is no program to be looked through for further faults.
  if (!reading.faults.empty() && !block.to_skip && !reading.reads_flat && !reading.in_front_of_tape)
    reading.ended |= line.ends_program;
  reading.in_front_of_tape &= !readable || (line.roles & ~bit(WordRole::comment)) == 0;
  if (!readable || !reading.faults.empty()) return false;
  if ((line.roles & ~bit(WordRole::comment)) == 0) return true;
  line.has_words = true;
  ++reading.blocks_read;
  if (!(is_isg ? check_isg_block(reading, line, block) : check_feed(reading, line, block)))
    return false;
  copy_plunge_from_nowhere(reading, line, block);
  copy_helix_with_pitch(reading, line, block);
  sum_up_words(line);
  if (!line.has(WordRole::trc) && !block.side_of_machine) {
    // However the line was read, the output must not contain G41 or G42 (D-121).
    const std::size_t place = place_of_side(line.text);
    if (place != std::string_view::npos)
      return reading.refuse(line, TextFault{.code = Code::nc_unsupported,
                                            .begin = static_cast<std::uint32_t>(place),
                                            .detail = "G41, G42 in a line that passes"});
  }
  const bool goes_on = apply_block(reading, line, block);
  // RNDM=: the motion ends where its corner begins.
  if (line.is_motion && reading.contour_open() && block.move.corner) line.has_trc_words = true;
  return goes_on;
}

// Refuses control characters outside comments, however the line was read: lines of cycles and calls
// are copied as they stand.
bool check_text(Reading& reading, const ProgramLine& line) {
  const auto is_control = [](char sign) {
    const auto byte = static_cast<unsigned char>(sign);
    return (byte < 0x20 && sign != '\t' && !is_line_end(sign)) || byte == 0x7f;
  };
  const auto is_in_comment = [&](std::size_t at) {
    return std::ranges::any_of(line.words, [&](const WordRange& word) {
      return word.role == WordRole::comment && word.begin <= at && at < word.end;
    });
  };
  const bool is_klartext = reading.dialect.name == DialectName::heidenhain;
  bool is_quoted = false;
  for (std::size_t at = 0; at < line.text.size(); ++at) {
    // The comment of a copied line of Klartext is no word of its own.
    if (is_klartext && line.text[at] == ';' && !is_quoted) return true;
    is_quoted ^= line.text[at] == '"';
    if (is_control(line.text[at]) && !is_in_comment(at))
      return reading.refuse(
          line, TextFault{.code = Code::nc_not_text,
                          .begin = static_cast<std::uint32_t>(at),
                          .detail = name_of_character(std::string_view(line.text).substr(at)) +
                                    ", outside a comment"});
  }
  return true;
}

// Whether the line can be read in one pass, with nothing to refuse before its motion.
bool is_plain(const Reading& reading, ProgramLine& line, PlainMotion& plain) {
  return !reading.ended && reading.comment_block == 0 && !reading.in_subprogram &&
         reading.feed_mode == 94 && reading.reads_plain_lines && !reading.machine_follows &&
         !reading.state.retract_is_lost() && plain.read(line.text, line.words) &&
         (reading.motion_given || plain.has_function()) &&
         (!reading.incremental ||
          reading.state.is_known(axes_of(reading.state.programmed_plane()).third)) &&
         !(plain.has_radius() && reading.dialect.name == DialectName::sinumerik) &&
         (!plain.has_feed() ||
          reading.state.is_feed(plain.feed() * reading.feed_unit(reading.unit)));
}

bool apply_plain(Reading& reading, ProgramLine& line, const PlainMotion& plain) {
  MoveRequest request;
  plain.enter(request);
  const MotionKind kind = plain.has_function() ? plain.motion() : reading.motion;
  // FANUC may pass over them, LINUXCNC refuses them.
  const bool has_circle_words_of_straight = (reading.dialect.name == DialectName::fanuc ||
                                             reading.dialect.name == DialectName::linuxcnc) &&
                                            plain.has_circle_words() && kind <= MotionKind::linear;
  if (has_circle_words_of_straight ||
      request.center[axes_of(reading.state.programmed_plane()).third].value_or(0) !=
          0) {  // a pitch
    line.words.clear();
    return read_block(reading, line);
  }
  line.source.number = plain.number();
  line.roles = plain.roles();
  line.main_axes = plain.main_axes();
  line.has_words = true;
  if (reading.dialect.name == DialectName::isg) note_axes(reading, line.main_axes);
  ++reading.blocks_read;
  if (plain.has_function()) reading.motion = plain.motion();
  reading.motion_given = true;
  if (plain.has_feed()) reading.feed = plain.feed() * reading.feed_unit(reading.unit);
  reading.state.place(plain.first_coordinate() + 1,
                      plain.has_circle_words() ? column_of_center(line) : 0);
  return move(reading, line, request);
}

}  // namespace

std::size_t place_of_side(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"' && depth == 0)
      if (const std::size_t close = text.find('"', at + 1); close != std::string_view::npos)
        at = close;
    if (text[at] == '(') ++depth;
    if (text[at] == ')' && depth > 0) --depth;
    if (depth > 0) continue;
    if (text[at] == ';') break;
    const bool in_a_name = at > 0 && (is_letter(text[at - 1]) || text[at - 1] == '_');
    if (upper(text[at]) != 'G' || in_a_name) continue;
    std::string_view number = without_blanks_in_front(text.substr(at + 1));
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    const bool is_side = number.starts_with("41") || number.starts_with("42");
    if (is_side && (number.size() == 2 || number[2] < '0' || number[2] > '9')) return at;
  }
  return std::string_view::npos;
}

bool read_line(Reading& reading, ProgramLine& line) {
  reading.cut = {};
  const bool may_be_skipped = reading.state.setup().block_skip != BlockSkip::refuse &&
                              !reading.ended && reading.comment_block == 0 &&
                              !reading.in_subprogram;
  if (may_be_skipped && is_left_out(reading, line)) return true;
  if (reading.dialect.name == DialectName::heidenhain) {
    if (const auto goes_on = take_plain_klartext(reading, line)) return *goes_on;
  } else if (PlainMotion plain; is_plain(reading, line, plain)) {
    return apply_plain(reading, line, plain);
  }
  line.words.clear();
  if (reading.state.setup().encoding == Encoding::utf8)
    if (const std::size_t bad = first_byte_that_is_no_utf8(line.text);
        bad != std::string_view::npos)
      return reading.refuse(line, TextFault{.code = Code::nc_not_text,
                                            .begin = static_cast<std::uint32_t>(bad),
                                            .detail = "within a comment"});
  const std::string_view text = without_blanks_in_front(line.text);
  const bool is_name = text.starts_with('%') && reading.dialect.name != DialectName::heidenhain;
  if (reading.dialect.name != DialectName::isg && (reading.ended || is_name)) {
    // The `%` before the first block begins the tape, the next one ends it. The text after the end
    // may have any encoding.
    if (reading.ended) return read_line_behind_end(reading, line);
    if (reading.blocks_read == 0 && reading.in_front_of_tape) forget_what_stands_in_front(reading);
    reading.in_front_of_tape = false;
    if (reading.blocks_read == 0) return true;
    reading.ended = true;
    reading.ending_percent = line.source.line;
    reading.state.place(0);
    return reading.state.end(line.source);
  }
  if (!reading.ended && reading.comment_block == 0 && !is_name && !reading.in_subprogram)
    return text.empty() || (read_block(reading, line) && check_text(reading, line));

  const std::size_t bad =
      reading.ended ? first_byte_that_is_no_utf8(line.text) : first_byte_that_is_no_text(line.text);
  if (bad != std::string_view::npos && reading.state.setup().demands_utf8())
    return reading.refuse(line, TextFault{.code = Code::nc_not_text,
                                          .begin = static_cast<std::uint32_t>(bad),
                                          .detail = "in a text that is only passed on"});
  if (reading.ended) return read_line_behind_end(reading, line);
  if (reading.comment_block != 0) return read_comment_block(reading, line);
  const auto place_of_name = static_cast<std::uint32_t>(line.text.size() - text.size());
  const bool local =
      text.size() > 2 && (text[1] == 'L' || text[1] == 'l') && (text[2] == ' ' || text[2] == '\t');
  if (is_name && reading.blocks_read > 0)
    return reading.refuse(line,
                          TextFault{.code = Code::nc_unsupported,
                                    .begin = place_of_name,
                                    .detail = local ? "%L, a subprogram" : "%, a second program"});
  if (is_name) reading.in_subprogram = local;
  return !reading.in_subprogram || read_line_of_subprogram(reading, line);
}

}  // namespace trc
