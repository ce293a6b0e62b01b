#include "core/nc/dialect/interpreter.h"

#include <algorithm>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/slip.h"

namespace trc {
namespace {

constexpr bool is_of_center(char letter) {
  return (letter >= 'I' && letter <= 'K') || letter == 'R';
}

// Enters which roles and axes there are.
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
      line.main_axes |= static_cast<std::uint8_t>(1U << (letter - 'X'));
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

Interpreter::Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics)
    : limits_(limits),
      dialect_(dialect_of(state.setup().dialect)),
      state_(state),
      diagnostics_(diagnostics),
      inch_(state.setup().inch),
      absolute_center_(state.setup().absolute_center),
      reads_plain_lines_(state.setup().dialect == DialectName::isg),
      in_front_of_tape_(state.setup().dialect == DialectName::fanuc ||
                        state.setup().dialect == DialectName::linuxcnc) {
  motion_ = dialect_.motion.value_or(motion_);
  motion_given_ = dialect_.motion.has_value();
  diagnostics_.units().count_in(inch_, 0);
  state_.set_inch(inch_);
  if (dialect_.name == DialectName::heidenhain) {
    absolute_center_ = true;
    state_.set_absolute_center(true);
  }
  axis_of_letter_.fill(-1);
  for (const char main : {'X', 'Y', 'Z'})
    axis_of_letter_[static_cast<std::size_t>(main - 'A')] = static_cast<std::int16_t>(main - 'X');
  std::int16_t index = 3;
  for (const std::string& name : state.setup().tracking_axes) {
    if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z') {
      std::int16_t& place = axis_of_letter_[static_cast<std::size_t>(name[0] - 'A')];
      if (place < 0) place = index;
    }
    ++index;
  }
}

bool Interpreter::stop(Diagnostic error) {
  error.source.index = blocks_read_;
  if (faults_.empty()) return diagnostics_.report(std::move(error));
  std::vector<Diagnostic> all = told_faults();
  all.push_back(std::move(error));
  return diagnostics_.report_together(std::move(all));
}

bool Interpreter::note(Diagnostic error) {
  error.source.index = blocks_read_;
  collect(std::move(error));
  return !diagnostics_.stopped();
}

void Interpreter::count_in(const ProgramLine& line, bool inch) {
  inch_ = inch;
  state_.set_inch(inch);
  diagnostics_.units().count_in(inch, line.source.index);
}

// Diagnostics of the state name the column too, where the block is one line.
void Interpreter::place(const ProgramLine& line, std::uint32_t begin) {
  state_.place(column_in(line, begin));
}

WordPlace Interpreter::place_of_word(const ProgramLine& line, std::uint32_t begin) const {
  return {.source = line.source, .column = column_in(line, begin)};
}

// Where the setup says how the switch of the machine stands: on, nothing of the line remains; off,
// all but its `/`.
bool Interpreter::is_left_out(ProgramLine& line) {
  const BlockSkip decided = decided_about(line.text, state_.setup(), cut_);
  if (decided == BlockSkip::execute) line.text.erase(cut_.begin, cut_.end - cut_.begin);
  if (decided == BlockSkip::refuse) cut_ = {};
  if (decided == BlockSkip::refuse) cut_skipped_words(line);
  if (decided != BlockSkip::leave_out) return false;
  line.has_trc_words = true;
  return true;
}

// Where the sign stands within the line, what is behind it, up to a comment.
void Interpreter::cut_skipped_words(ProgramLine& line) {
  const SkipSign sign = skip_sign_within(line.text, dialect_.name);
  if (!sign.is_there() || is_beside_the_path(line.text, sign, dialect_.name)) return;
  cut_ = sign;
  if (state_.setup().block_skip == BlockSkip::leave_out)
    cut_.end = std::min(line.text.find_first_of("(;", sign.end), line.text.size());
  line.text.erase(cut_.begin, cut_.end - cut_.begin);
}

bool Interpreter::read_line(ProgramLine& line) {
  cut_ = {};
  const bool may_be_skipped = state_.setup().block_skip != BlockSkip::refuse && !ended_ &&
                              comment_block_ == 0 && !in_subprogram_;
  if (may_be_skipped && is_left_out(line)) return true;
  if (dialect_.name == DialectName::heidenhain) {
    if (const auto goes_on = take_plain_klartext(line)) return *goes_on;
  } else if (PlainMotion plain; is_plain(line, plain)) {
    return apply(line, plain);
  }
  line.words.clear();
  if (state_.setup().encoding == Encoding::utf8)
    if (const std::size_t bad = first_byte_that_is_no_utf8(line.text);
        bad != std::string_view::npos)
      return refuse(line, TextFault{.code = Code::nc_not_text,
                                    .begin = static_cast<std::uint32_t>(bad),
                                    .detail = "within a comment"});
  const std::string_view text = without_blanks_in_front(line.text);
  const bool is_name = text.starts_with('%') && dialect_.name != DialectName::heidenhain;
  if (dialect_.name != DialectName::isg && (ended_ || is_name)) {
    // The `%` in front of the first block begins the tape, the next one ends it. What stands
    // behind may be in any encoding.
    if (ended_) return read_line_behind_end(line);
    if (blocks_read_ == 0 && in_front_of_tape_) forget_what_stands_in_front();
    ended_ |= blocks_read_ > 0;
    in_front_of_tape_ = false;
    return true;
  }
  if (!ended_ && comment_block_ == 0 && !is_name && !in_subprogram_)
    return text.empty() || read_block(line);

  const std::size_t bad =
      ended_ ? first_byte_that_is_no_utf8(line.text) : first_byte_that_is_no_text(line.text);
  if (bad != std::string_view::npos && state_.setup().demands_utf8())
    return refuse(line, TextFault{.code = Code::nc_not_text,
                                  .begin = static_cast<std::uint32_t>(bad),
                                  .detail = "in a text that is only passed on"});
  if (ended_) return read_line_behind_end(line);
  if (comment_block_ != 0) return read_comment_block(line);
  const auto place_of_name = static_cast<std::uint32_t>(line.text.size() - text.size());
  const bool local =
      text.size() > 2 && (text[1] == 'L' || text[1] == 'l') && (text[2] == ' ' || text[2] == '\t');
  if (is_name && blocks_read_ > 0)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = place_of_name,
                                  .detail = local ? "%L, a subprogram" : "%, a second program"});
  if (is_name) in_subprogram_ = local;
  return !in_subprogram_ || read_line_of_subprogram(line);
}

// What stands in front of a tape is for people (D-61): the words that it seems to have count for
// nothing.
void Interpreter::forget_what_stands_in_front() {
  faults_.clear();
  code_ = {};
  called_motion_ = called_dimension_ = false;
}

// A subprogram in front of the program passes as text: what calls it is not followed.
bool Interpreter::read_line_of_subprogram(const ProgramLine& line) {
  isg_word_seen_ = true;
  const std::size_t place = place_of_side(line.text);
  return place == std::string_view::npos ||
         refuse(line, TextFault{.code = Code::nc_unsupported,
                                .begin = static_cast<std::uint32_t>(place),
                                .detail = "G41, G42 in a subprogram"});
}

bool Interpreter::read_line_behind_end(ProgramLine& line) {
  const bool klartext = dialect_.name == DialectName::heidenhain;
  if (klartext && !enter_label_behind_end(line)) return false;
  const std::size_t place = klartext ? place_of_klartext_side(line.text) : place_of_side(line.text);
  if (place == std::string::npos) return true;
  // A contour of cycles: they compensate it.
  if (klartext && klartext_.cycle_section != 0 && klartext_.called_section == 0) return true;
  if (klartext && klartext_.called_section != 0)
    return refuse(
        line, TextFault{.code = Code::nc_unsupported,
                        .begin = static_cast<std::uint32_t>(place),
                        .detail = "CALL LBL in line " + std::to_string(klartext_.called_section) +
                                  ", whose contour stands behind the end: write the lines of "
                                  "the label in its place"});
  const std::size_t behind =
      klartext ? place + 2 : line.text.find_first_not_of("Gg0123456789 ", place);
  std::string side = line.text.substr(place, behind - place);
  side.erase(side.find_last_not_of(' ') + 1);
  return refuse(line, TextFault{.code = Code::side_behind_end,
                                .begin = static_cast<std::uint32_t>(place),
                                .detail = std::move(side)});
}

bool Interpreter::read_words_of_dialect(ProgramLine& line, BlockWords& block) {
  if (sets_variables_) {
    const auto end = static_cast<std::uint32_t>(line.text.size());
    line.words.push_back({.begin = 0, .end = end, .role = WordRole::technology});
    return true;
  }
  switch (dialect_.name) {
    case DialectName::isg:
      return read_words(line, block);
    case DialectName::sinumerik:
      return read_named_words(line, block);
    case DialectName::heidenhain:
    case DialectName::fanuc:
    case DialectName::linuxcnc:
      break;
  }
  return read_code_words(line, block);
}

bool Interpreter::read_block(ProgramLine& line) {
  if (dialect_.name == DialectName::heidenhain) return read_klartext(line);
  BlockWords block;
  const bool is_isg = dialect_.name == DialectName::isg;
  const bool passes = is_isg && !contour_open() && read_passing_line(line, block);
  const bool readable = calls_the_machine_ ? read_call_of_machine(line, block)
                                           : passes || read_words_of_dialect(line, block);
  sum_up_words(line);
  if (!faults_.empty() && block.has(GGroup::side)) scanned_trc_ = !block.of(GGroup::side).is(40);
  in_front_of_tape_ &= !readable || (line.roles & ~bit(WordRole::comment)) == 0;
  if (!readable || !faults_.empty()) return false;
  if ((line.roles & ~bit(WordRole::comment)) == 0) return true;
  line.has_words = true;
  ++blocks_read_;
  if (!(is_isg ? check_block(line, block) : check_feed(line, block))) return false;
  copy_plunge_from_nowhere(line, block);
  copy_helix_with_pitch(line, block);
  sum_up_words(line);
  if (!line.has(WordRole::trc) && !block.side_of_machine) {
    // Whatever it was taken for: what comes out must not say it any more (D-121).
    const std::size_t place = place_of_side(line.text);
    if (place != std::string_view::npos)
      return refuse(line, TextFault{.code = Code::nc_unsupported,
                                    .begin = static_cast<std::uint32_t>(place),
                                    .detail = "G41, G42 in a line that passes"});
  }
  const bool goes_on = apply(line, block);
  // RNDM=: the motion ends where its corner begins.
  if (line.is_motion && contour_open() && block.move.corner) line.has_trc_words = true;
  return goes_on;
}

// An increment of the third axis, whose place is not known: while TRC is off nothing hangs on it.
void Interpreter::copy_plunge_from_nowhere(ProgramLine& line, BlockWords& block) const {
  using enum GGroup;
  const std::size_t third = axes_of(state_.programmed_plane()).third;
  const auto reference = block.end_reference[third];  // IC(…)
  const bool incremental = reference != 0         ? reference < 0
                           : block.has(dimension) ? block.of(dimension).is(91)
                                                  : incremental_;
  const bool straight =
      block.has(motion) ? block.of(motion).function->number < 2 : motion_ <= MotionKind::linear;
  if (block.copied || contour_open() || block.has(side) || block.has(plane) || !incremental ||
      !straight || block.center || state_.is_known(third) || !block.move.end[third])
    return;
  for (std::size_t axis = 0; axis < block.move.end.size(); ++axis)
    if (axis != third && block.move.end[axis]) return;
  block.copied = true;
  for (WordRange& word : line.words)
    if (word.role == WordRole::coordinate) word.role = WordRole::technology;
}

// Whether the line can be read in one pass, with nothing to refuse before its motion.
bool Interpreter::is_plain(ProgramLine& line, PlainMotion& plain) const {
  return !ended_ && comment_block_ == 0 && !in_subprogram_ && feed_mode_ == 94 &&
         reads_plain_lines_ && !machine_follows_ && !state_.retract_is_lost() &&
         plain.read(line.text, line.words) && (motion_given_ || plain.has_function()) &&
         (!incremental_ || state_.is_known(axes_of(state_.programmed_plane()).third)) &&
         (!plain.has_feed() || state_.is_feed(plain.feed() * feed_unit(inch_)));
}

bool Interpreter::apply(ProgramLine& line, const PlainMotion& plain) {
  MoveRequest request;
  plain.enter(request);
  const MotionKind kind = plain.has_function() ? plain.motion() : motion_;
  const bool passes_over_circle_words =
      dialect_.name == DialectName::fanuc && plain.has_circle_words() && kind <= MotionKind::linear;
  if (passes_over_circle_words ||
      request.center[axes_of(state_.programmed_plane()).third].value_or(0) != 0) {  // a pitch
    line.words.clear();
    return read_block(line);
  }
  line.source.number = plain.number();
  line.roles = plain.roles();
  line.main_axes = plain.main_axes();
  line.has_words = true;
  ++blocks_read_;
  if (plain.has_function()) motion_ = plain.motion();
  motion_given_ = true;
  if (plain.has_feed()) feed_ = plain.feed() * feed_unit(inch_);
  state_.place(plain.first_coordinate() + 1, plain.has_circle_words() ? column_of_center(line) : 0);
  return move(line, request);
}

}  // namespace trc
