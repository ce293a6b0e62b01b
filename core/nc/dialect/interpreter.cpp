#include "core/nc/dialect/interpreter.h"

#include <algorithm>
#include <utility>

#include "core/nc/dialect/block_words.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/slip.h"

namespace trc {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::size_t spare_lines = 2048;  // as many as a message of 64 KiB holds
constexpr std::size_t longest_spare_line = 256;
constexpr std::size_t usual_words = 8;

constexpr std::string_view center_letters = "IJKR";

void forget_words(ProgramLine& line) {
  line.words.clear();
  line.roles = 0;
  line.names_other_axes = false;
  line.main_axes = 0;
  line.ends_program = line.calls_the_machine = false;
  line.feed_it_takes = 0;
}

// Enters which roles and axes there are.
void sum_up_words(ProgramLine& line) {
  line.roles = 0;
  line.names_other_axes = false;
  line.main_axes = 0;
  for (const WordRange& word : line.words) {
    line.roles |= bit(word.role);
    if (word.role != WordRole::coordinate) continue;
    if (!names_an_axis(line, word)) {
      line.names_other_axes |= is_polar(line, word);
      continue;
    }
    const char letter = upper(line.text[word.begin]);
    if (letter >= 'X' && letter <= 'Z') {
      line.main_axes |= static_cast<std::uint8_t>(1U << (letter - 'X'));
    } else if (center_letters.find(letter) == std::string_view::npos) {
      line.names_other_axes = true;
    }
  }
}

// Few lines get past this.
bool may_be_continued(std::string_view line) {
  return !line.empty() && std::string_view("\\ \t\xA0").find(line.back()) != std::string_view::npos;
}

std::string_view last_line_of(std::string_view text) {
  const std::size_t line_end = text.find_last_of("\r\n");
  return line_end == std::string_view::npos ? text : text.substr(line_end + 1);
}

// Where G41 or G42 stands in a line that is not read, outside of comments; npos: nowhere.
std::size_t place_of_side(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ')' && depth > 0) --depth;
    if (depth > 0) continue;
    if (text[at] == ';') break;
    if (upper(text[at]) != 'G') continue;
    std::string_view number = without_blanks_in_front(text.substr(at + 1));
    number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
    const bool is_side = number.starts_with("41") || number.starts_with("42");
    if (is_side && (number.size() == 2 || number[2] < '0' || number[2] > '9')) return at;
  }
  return std::string_view::npos;
}

}  // namespace

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

bool Interpreter::feed(std::string_view text, std::vector<LinePointer>& lines) {
  if (diagnostics_.stopped()) return false;
  if (carriage_return_ && !text.empty()) {
    carriage_return_ = false;
    const bool line_feed = text.front() == '\n';
    if (line_feed) text.remove_prefix(1);
    if (!take_line({}, line_feed ? "\r\n" : "\r", lines)) return false;
  }
  // Each sign is looked for once, not once for every one of the other.
  std::size_t line_feed = 0;
  std::size_t carriage_return = 0;
  const auto find_from = [&](char sign, std::size_t at, std::size_t& found) {
    if (found < at || at == 0) found = std::min(text.find(sign, at), text.size());
  };
  std::size_t at = 0;
  while (at < text.size()) {
    find_from('\n', at, line_feed);
    find_from('\r', at, carriage_return);
    const std::size_t end = std::min(line_feed, carriage_return);
    const std::string_view part = text.substr(at, end - at);
    if (partial_.size() + part.size() > limits_.longest_line) return refuse_long_line();
    if (end == text.size()) {
      partial_.append(part);
      return true;
    }
    std::string_view line_end = "\n";
    if (text[end] == '\r') {
      if (end + 1 == text.size()) {
        partial_.append(part);
        carriage_return_ = true;
        return true;
      }
      line_end = text[end + 1] == '\n' ? "\r\n" : "\r";
    }
    at = end + line_end.size();
    if (!take_line(part, line_end, lines)) return false;
  }
  return true;
}

bool Interpreter::read(const FlatLine& line, std::vector<LinePointer>& lines) {
  if (diagnostics_.stopped()) return false;
  if (std::exchange(carriage_return_, false) && !take_line({}, "\r", lines)) return false;
  lines_read_ = line.number - 1 - continued_;
  knows_columns_ = line.is_as_written;
  // The text may be gone before the line is.
  const std::string_view line_end = line.line_end == "\n"     ? "\n"
                                    : line.line_end == "\r\n" ? "\r\n"
                                    : line.line_end == "\r"   ? "\r"
                                                              : "";
  calls_the_machine_ = line.calls_the_machine;
  machine_follows_ = line.machine_follows;
  const bool goes_on = take_line(line.text, line_end, lines);
  calls_the_machine_ = machine_follows_ = false;
  return goes_on;
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

// Takes the rest of a line, with its end; what came before of it is in partial_.
bool Interpreter::take_line(std::string_view text, std::string_view line_end,
                            std::vector<LinePointer>& lines) {
  if (!partial_.empty()) {
    partial_.append(text);
    text = partial_;
  }
  if (lines_read_ == 0 && continued_ == 0 && text.starts_with(byte_order_mark)) {
    enter_modes(append_line(byte_order_mark, {}, lines));
    text.remove_prefix(byte_order_mark.size());
  }
  std::string_view last_line = continued_ == 0 ? text : last_line_of(text);
  if (continued_ > 0 && dialect_.name == DialectName::heidenhain && is_klartext_comment(text) &&
      begins_klartext_block(last_line)) {
    if (!take_comment_before(last_line, lines)) return false;
    last_line = text = partial_;
  }
  const bool goes_on_below = dialect_.name == DialectName::heidenhain
                                 ? is_continued_klartext(last_line)
                                 : may_be_continued(last_line) && is_continued(last_line);
  if (!ended_ && comment_block_ == 0 && goes_on_below) {
    if (line_end.empty()) return refuse_open_line();
    if (partial_.empty()) partial_.assign(text);
    partial_.erase(0, partial_.size() - text.size());  // the byte order mark
    partial_.append(line_end);
    ++continued_;
    return true;
  }
  const bool goes_on = take_block(text, line_end, 1 + std::exchange(continued_, 0U), lines);
  partial_.clear();
  return goes_on;
}

bool Interpreter::take_comment_before(std::string_view last_line, std::vector<LinePointer>& lines) {
  const std::string whole = std::exchange(partial_, std::string(last_line));
  std::string_view comment(whole.data(), whole.size() - last_line.size());
  const std::string_view line_end = comment.ends_with("\r\n") ? "\r\n"
                                    : comment.ends_with('\n') ? "\n"
                                                              : "\r";
  comment.remove_suffix(line_end.size());
  return take_block(comment, line_end, std::exchange(continued_, 0U), lines);
}

bool Interpreter::take_block(std::string_view text, std::string_view line_end,
                             std::uint32_t lines_of_it, std::vector<LinePointer>& lines) {
  ProgramLine& line = append_line(text, line_end, lines);
  lines_read_ += lines_of_it;
  const bool goes_on = read_line(line);
  enter_modes(line);
  if (faults_.empty()) return goes_on;
  // It may turn out to stand in front of the tape: a text without words.
  if (in_front_of_tape_ && blocks_read_ == 0 && !diagnostics_.stopped()) {
    forget_words(line);
    return true;
  }
  recycle(std::move(lines.back()));
  lines.pop_back();
  return !diagnostics_.stopped();
}

ProgramLine& Interpreter::append_line(std::string_view text, std::string_view line_end,
                                      std::vector<LinePointer>& lines) {
  if (spare_.empty()) {
    lines.emplace_back(std::make_unique<ProgramLine>())->words.reserve(usual_words);
  } else {
    lines.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
  ProgramLine& line = *lines.back();
  line.text.assign(text);
  line.line_end = line_end;
  line.source = {.index = blocks_read_, .line = static_cast<std::uint32_t>(lines_read_ + 1)};
  line.has_words = line.is_motion = line.has_trc_words = false;
  line.klartext.reset();
  forget_words(line);
  return line;
}

void Interpreter::enter_modes(ProgramLine& line) const {
  line.motion = motion_;
  line.incremental = incremental_;
  line.inch = inch_;
  line.feed_in_inch = inch_ && !feed_in_mm_;
  line.absolute_center = absolute_center_;
  line.plane = state_.programmed_plane();
  line.feed = feed_mode_ == 94 ? feed_ : 0;
}

void Interpreter::recycle(LinePointer line) {
  if (spare_.size() == spare_lines || line->text.capacity() > longest_spare_line) return;
  spare_.push_back(std::move(line));
}

bool Interpreter::finish(std::vector<LinePointer>& lines) {
  if (diagnostics_.stopped()) return false;
  if (carriage_return_) {
    carriage_return_ = false;
    if (!take_line({}, "\r", lines)) return false;
  }
  const bool continued_to_nothing = !partial_.empty() && is_line_end(partial_.back());
  if (continued_to_nothing) {
    const bool comment = dialect_.name == DialectName::heidenhain && is_klartext_comment(partial_);
    if (!comment) return refuse_open_line();
    if (!take_comment_before({}, lines)) return false;
  }
  if (!partial_.empty() && !take_line({}, {}, lines)) return false;
  if (!faults_.empty()) return report_faults();
  const auto last_line = static_cast<std::uint32_t>(std::max<std::uint64_t>(lines_read_, 1));
  if (comment_block_ != 0)
    return diagnostics_.report(
        diagnostic(Code::nc_unclosed, {.line = comment_block_}, "#COMMENT BEGIN"));
  if (blocks_read_ == 0)
    return diagnostics_.report(diagnostic(Code::program_empty, {.line = last_line}));
  state_.place(0);
  return state_.end({.index = blocks_read_, .line = last_line});
}

bool Interpreter::refuse_long_line() {
  Diagnostic refused = diagnostic(
      Code::nc_line_too_long,
      {.index = blocks_read_, .line = static_cast<std::uint32_t>(lines_read_ + continued_ + 1)});
  refused.values = {{"longest_line", static_cast<double>(limits_.longest_line)}};
  partial_.clear();
  return diagnostics_.report(std::move(refused));
}

// The text ends behind a `\`.
bool Interpreter::refuse_open_line() {
  const auto last_line = static_cast<std::uint32_t>(lines_read_ + std::max(continued_, 1U));
  return diagnostics_.report(diagnostic(Code::nc_unclosed,
                                        {.index = blocks_read_, .line = last_line},
                                        dialect_.name == DialectName::heidenhain ? "~" : "\\"));
}

void Interpreter::count_in(const ProgramLine& line, bool inch) {
  inch_ = inch;
  state_.set_inch(inch);
  diagnostics_.units().count_in(inch, line.source.index);
}

// Diagnostics of the state name the column too, where the block is one line.
void Interpreter::place(const ProgramLine& line, std::uint32_t begin) {
  state_.place(place_of_word(line, begin).column);
}

WordPlace Interpreter::place_of_word(const ProgramLine& line, std::uint32_t begin) const {
  const bool one_line = line.source.line == lines_read_;
  const bool in_first_line = one_line || line.text.find_first_of("\r\n") >= begin;
  return {.source = line.source, .column = in_first_line && knows_columns_ ? column_of(begin) : 0};
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
  if (PlainMotion plain; is_plain(line, plain)) return apply(line, plain);
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
  sum_up_words(line);
  return apply(line, block);
}

// An increment of the third axis, whose place is not known: while TRC is off nothing hangs on it.
void Interpreter::copy_plunge_from_nowhere(ProgramLine& line, BlockWords& block) const {
  using enum GGroup;
  const std::size_t third = axes_of(state_.programmed_plane()).third;
  const bool incremental = block.has(dimension) ? block.of(dimension).is(91) : incremental_;
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
  line.source.number = plain.number();
  line.roles = plain.roles();
  line.main_axes = plain.main_axes();
  line.has_words = true;
  ++blocks_read_;
  if (plain.has_function()) motion_ = plain.motion();
  motion_given_ = true;
  if (plain.has_feed()) feed_ = plain.feed() * feed_unit(inch_);
  state_.place(plain.first_coordinate() + 1);
  MoveRequest request;
  plain.enter(request);
  return move(line, request);
}

}  // namespace trc
