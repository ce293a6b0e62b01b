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

Side side_of(int g_number) {
  return g_number == 41 ? Side::left : g_number == 42 ? Side::right : Side::off;
}

Selection selection_of(int g_number) {
  switch (g_number) {
    case 138:
      return Selection::direct;
    case 236:
      return Selection::on_path;
    case 237:
      return Selection::perpendicular;
    case 238:
      return Selection::inside_corner;
    case 239:
      return Selection::without_block;
    default:
      return Selection::indirect;
  }
}

constexpr std::array<MotionKind, 4> motions{MotionKind::rapid, MotionKind::linear,
                                            MotionKind::clockwise, MotionKind::counter_clockwise};

}  // namespace

Interpreter::Interpreter(const ReaderLimits& limits, ProgramState& state, Diagnostics& diagnostics)
    : limits_(limits),
      dialect_(dialect_of(state.setup().dialect)),
      state_(state),
      diagnostics_(diagnostics),
      inch_(state.setup().inch),
      absolute_center_(state.setup().absolute_center),
      reads_plain_lines_(state.setup().dialect == DialectName::isg) {
  diagnostics_.units().count_in(inch_, 0);
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
  const std::string_view last_line = continued_ == 0 ? text : last_line_of(text);
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
  ProgramLine& line = append_line(text, line_end, lines);
  lines_read_ += 1 + std::exchange(continued_, 0U);
  partial_.clear();
  const bool goes_on = read_line(line);
  enter_modes(line);
  if (faults_.empty()) return goes_on;
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
  line.words.clear();
  line.roles = 0;
  line.names_other_axes = false;
  line.main_axes = 0;
  line.has_words = line.is_motion = line.has_trc_words = false;
  line.ends_program = false;
  line.klartext.reset();
  return line;
}

void Interpreter::enter_modes(ProgramLine& line) const {
  line.motion = motion_;
  line.incremental = incremental_;
  line.inch = inch_;
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
  if (continued_to_nothing) return refuse_open_line();
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
  diagnostics_.units().count_in(inch, line.source.index);
}

// What was mistyped is named as a whole, with what was meant.
TextFault Interpreter::with_slip(const ProgramLine& line, TextFault fault) {
  constexpr std::array codes{Code::nc_syntax,   Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_not_text, Code::nc_number,           Code::nc_axis_unknown};
  if (fault.slip.kind != SlipKind::none || std::ranges::find(codes, fault.code) == codes.end())
    return fault;
  auto found = slip_at(line.text, fault.begin);
  if (!found) return fault;
  fault.code = found->slip.kind == SlipKind::quotes ? Code::nc_syntax : Code::nc_number;
  fault.begin = static_cast<std::uint32_t>(found->begin);
  fault.detail = std::move(found->word);
  fault.slip = std::move(found->slip);
  return fault;
}

// The place of a fault is its physical line, also within a continued block.
bool Interpreter::refuse(const ProgramLine& line, const TextFault& given) {
  const TextFault fault = with_slip(line, given);
  Source source = line.source;
  std::size_t line_begin = 0;
  for (std::size_t at = 0; at < fault.begin && at < line.text.size(); ++at) {
    const bool ends =
        line.text[at] == '\n' || (line.text[at] == '\r' && line.text.compare(at, 2, "\r\n") != 0);
    if (!ends) continue;
    ++source.line;
    line_begin = at + 1;
  }
  Diagnostic refused = diagnostic(fault.code, source, fault.detail);
  refused.column = static_cast<std::uint32_t>(fault.begin - line_begin + 1);
  refused.slip = fault.slip;
  guard_against_other_dialects(line, refused);
  return collect(std::move(refused));
}

// What cannot be read as ISG, in a program that has no word of its own, may be of another dialect.
void Interpreter::guard_against_other_dialects(const ProgramLine& line, Diagnostic& fault) const {
  constexpr std::array codes{Code::nc_syntax, Code::nc_unknown_function, Code::nc_unsupported,
                             Code::nc_number, Code::nc_axis_unknown,     Code::nc_word_twice};
  const bool mistyped =
      fault.slip.kind != SlipKind::none && fault.slip.kind != SlipKind::unit_of_another;
  if (dialect_.name != DialectName::isg || isg_word_seen_ || mistyped ||
      std::ranges::find(codes, fault.code) == codes.end())
    return;
  const auto other = looks_like(line.text);
  if (!other) return;
  fault.code = Code::other_dialect;
  fault.detail.append(", as in ").append(dialect_of(*other).spelling);
}

// Faults of one kind, word and reason alike, are one with the number of its lines.
bool Interpreter::collect(Diagnostic fault) {
  if (limits_.most_faults <= 1) return diagnostics_.report(std::move(fault));
  if (faults_.empty()) scanned_trc_ = state_.contour_open();
  reads_plain_lines_ = false;
  const auto alike = std::ranges::find_if(faults_, [&](const Fault& known) {
    return known.code == fault.code && known.detail == fault.detail;
  });
  if (alike != faults_.end()) {
    if (alike->last_line != fault.source.line) ++alike->lines;
    alike->last_line = fault.source.line;
    return false;
  }
  faults_.push_back({.code = fault.code,
                     .source = fault.source,
                     .column = fault.column,
                     .detail = std::move(fault.detail),
                     .slip = std::move(fault.slip),
                     .last_line = fault.source.line});
  return faults_.size() >= limits_.most_faults && report_faults();
}

bool Interpreter::report_faults() {
  std::vector<Diagnostic> all;
  for (const Fault& fault : faults_) {
    Diagnostic found = diagnostic(fault.code, fault.source, fault.detail);
    found.column = fault.column;
    found.slip = fault.slip;
    if (fault.lines > 1) found.values = {{"lines", static_cast<double>(fault.lines)}};
    all.push_back(std::move(found));
  }
  return diagnostics_.report_together(std::move(all));
}

bool Interpreter::refuse(const ProgramLine& line, const Word& word, Code code, std::string detail) {
  if (detail.empty()) detail = line.text.substr(word.begin, word.end - word.begin);
  return refuse(line, TextFault{.code = code, .begin = word.begin, .detail = std::move(detail)});
}

// Diagnostics of the state name the column too, where the block is one line.
void Interpreter::place(const ProgramLine& line, std::uint32_t begin) {
  const bool one_line = line.source.line == lines_read_;
  const bool in_first_line = one_line || line.text.find_first_of("\r\n") >= begin;
  state_.place(in_first_line ? begin + 1 : 0);
}

bool Interpreter::read_line(ProgramLine& line) {
  if (PlainMotion plain; is_plain(line, plain)) return apply(line, plain);
  line.words.clear();
  const std::string_view text = without_blanks_in_front(line.text);
  const bool is_name = text.starts_with('%') && dialect_.name != DialectName::heidenhain;
  if (dialect_.name != DialectName::isg && (ended_ || is_name)) {
    // The `%` in front of the first block begins the tape, the next one ends it. What stands
    // behind may be in any encoding.
    if (ended_) return read_line_behind_end(line);
    ended_ |= blocks_read_ > 0;
    return true;
  }
  if (!ended_ && comment_block_ == 0 && !is_name) return text.empty() || read_block(line);

  const std::size_t bad =
      ended_ ? first_byte_that_is_no_utf8(line.text) : first_byte_that_is_no_text(line.text);
  if (bad != std::string_view::npos)
    return refuse(line, TextFault{.code = Code::nc_not_text,
                                  .begin = static_cast<std::uint32_t>(bad),
                                  .detail = "in a text that is only passed on"});
  if (ended_) return read_line_behind_end(line);
  if (comment_block_ != 0) return read_comment_block(line);
  const auto place_of_name = static_cast<std::uint32_t>(line.text.size() - text.size());
  const bool local =
      text.size() > 2 && (text[1] == 'L' || text[1] == 'l') && (text[2] == ' ' || text[2] == '\t');
  if (local || blocks_read_ > 0)
    return refuse(line, TextFault{.code = Code::nc_unsupported,
                                  .begin = place_of_name,
                                  .detail = local ? "%L, a subprogram" : "%, a second program"});
  return true;
}

bool Interpreter::read_line_behind_end(ProgramLine& line) {
  const std::size_t place = dialect_.name == DialectName::heidenhain
                                ? place_of_klartext_side(line.text)
                                : place_of_side(line.text);
  if (place == std::string::npos) return true;
  const std::size_t behind = dialect_.name == DialectName::heidenhain
                                 ? place + 2
                                 : line.text.find_first_not_of("Gg0123456789 ", place);
  return refuse(line, TextFault{.code = Code::side_behind_end,
                                .begin = static_cast<std::uint32_t>(place),
                                .detail = line.text.substr(place, behind - place)});
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
  const bool readable = read_words_of_dialect(line, block);
  sum_up_words(line);
  if (!faults_.empty() && block.has(GGroup::side)) scanned_trc_ = !block.of(GGroup::side).is(40);
  if (!readable || !faults_.empty()) return false;
  if ((line.roles & ~bit(WordRole::comment)) == 0) return true;
  line.has_words = true;
  ++blocks_read_;
  if (!(is_isg ? check_block(line, block) : check_feed(line, block))) return false;
  sum_up_words(line);
  return apply(line, block);
}

// Whether the line can be read in one pass, with nothing to refuse before its motion.
bool Interpreter::is_plain(ProgramLine& line, PlainMotion& plain) const {
  return !ended_ && comment_block_ == 0 && feed_mode_ == 94 && reads_plain_lines_ &&
         plain.read(line.text, line.words) &&
         (!plain.has_feed() || state_.is_feed(plain.feed() * feed_unit(inch_)));
}

bool Interpreter::apply(ProgramLine& line, const PlainMotion& plain) {
  line.source.number = plain.number();
  line.roles = plain.roles();
  line.main_axes = plain.main_axes();
  line.has_words = true;
  ++blocks_read_;
  if (plain.has_function()) motion_ = plain.motion();
  if (plain.has_feed()) feed_ = plain.feed() * feed_unit(inch_);
  state_.place(plain.first_coordinate() + 1);
  MoveRequest request;
  plain.enter(request);
  return move(line, request);
}

bool Interpreter::apply(ProgramLine& line, BlockWords& block) {
  line.has_trc_words = line.has(WordRole::trc);
  const auto pass = [&](WordRole role) { return !line.has(role) || pass_words(line, role); };
  block.motion_before = motion_;
  block.feed_before = feed_;
  const bool goes_on = apply_modes(line, block) && apply_trc(line, block) &&
                       pass(WordRole::technology) && apply_motion(line, block) &&
                       pass(WordRole::stop);
  if (!goes_on) return false;
  if (block.of(GGroup::zero_shift).is(53)) forget_position(line, block);
  if (!line.ends_program) return true;
  ended_ = true;
  state_.place(0);
  return state_.end(line.source);
}

bool Interpreter::apply_modes(const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  if (block.has(motion))
    motion_ = motions[static_cast<std::size_t>(block.of(motion).function->number)];
  if (block.has(unit)) {
    count_in(line, counts_in_inch(*block.of(unit).function));
    feed_in_mm_ = dialect_.name == DialectName::sinumerik && block.of(unit).function->number < 100;
  }
  if (block.has(dimension)) incremental_ = block.of(dimension).is(91);
  if (block.has(feed_mode)) feed_mode_ = block.of(feed_mode).function->number;
  if (block.feed) feed_ = block.feed->value * feed_unit(inch_);
  if (block.has(circle_center)) {
    const GFunction& function = *block.of(circle_center).function;
    absolute_center_ = function.number == 161 || function.tenths() == 901;
    state_.set_absolute_center(absolute_center_);
  }
  if (block.has(circle_check)) state_.set_circle_correction(block.of(circle_check).is(165));
  if (block.has(zero_shift)) forget_position(line, block);
  if (block.forget != 0) {
    std::array<bool, 3> axes{};
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      axes[axis] = (block.forget >> axis & 1) != 0;
    state_.forget_position(axes, line.source);
  }
  if (block.sets_position) {
    std::array<std::optional<double>, 3> place = block.move.end;
    for (auto& coordinate : place)
      if (coordinate) *coordinate *= length_unit();
    state_.set_position(place, line.source);
  }
  if (!block.has(plane)) return true;
  place(line, block.of(plane).begin);
  const int number = block.of(plane).function->number;
  return state_.set_plane(number == 17   ? Plane::xy
                          : number == 18 ? Plane::zx
                                         : Plane::yz,
                          line.source);
}

// G92 shifts the axes it names. Controls differ in whether G53 holds for its own block only, so
// that the place its motion leads to is known to none of them.
void Interpreter::forget_position(const ProgramLine& line, const BlockWords& block) {
  std::array<bool, 3> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    axes[axis] = !block.axis || !block.of(GGroup::zero_shift).is(92) || block.move.end[axis];
  state_.forget_position(axes, line.source);
}

// Modes and radius before the side, so that G41 begins with all of its block.
bool Interpreter::apply_trc(const ProgramLine& line, const BlockWords& block) {
  using enum GGroup;
  const Source& source = line.source;
  const auto at = [&](std::uint32_t begin) { return place(line, begin), true; };
  const auto has = [&](GGroup group) { return block.has(group) && at(block.of(group).begin); };

  if (has(transition) &&
      !state_.set_transition(block.of(transition).is(25) || block.of(transition).is(451)
                                 ? Transition::linear
                                 : Transition::circular,
                             source))
    return false;
  if (has(masking) &&
      !state_.set_masking(block.of(masking).is(141) ? Masking::on : Masking::off, source))
    return false;
  if (has(feed_adaptation) &&
      !state_.set_feed_adaptation(block.of(feed_adaptation).is(11) ? FeedAdaptation::on
                                  : block.of(feed_adaptation).is(feed_at_inside)
                                      ? FeedAdaptation::inside
                                      : FeedAdaptation::off,
                                  source))
    return false;
  if (block.options && at(block.command) && !state_.set_options(*block.options, source))
    return false;
  if (block.tangfeed && at(block.command) &&
      !state_.set_tangfeed_minimum(*block.tangfeed * length_unit(), source))
    return false;
  if (has(selection) &&
      !state_.set_selection(selection_of(block.of(selection).function->number), source))
    return false;
  if (block.tool_radius && at(block.tool_radius->begin)) {
    const double value = block.tool_radius->value * length_unit();
    if (!(block.radius_is_change ? state_.change_tool_radius(value, source)
                                 : state_.set_tool_radius(value, source)))
      return false;
  }
  if (block.allowance && at(block.allowance->begin) &&
      !state_.set_allowance_of_program(block.allowance->value * length_unit(), source))
    return false;
  if (block.tool_number) state_.prepare_tool(static_cast<std::int64_t>(block.tool_number->value));
  if (block.loads_tool && at(0) && !state_.load_tool(source)) return false;
  const bool zero = block.tool && block.tool->value == 0 && dialect_.zero_is_a_radius &&
                    !state_.tool().row_of_tool(0);
  if (zero && at(block.tool->begin) && !state_.set_tool_radius(0, source)) return false;
  if (block.tool && !zero && at(block.tool->begin) &&
      !state_.set_tool(static_cast<std::int64_t>(block.tool->value), source))
    return false;
  if (has(tangential) && !state_.set_tangential(source)) return false;
  // A smooth retraction runs along the contour before it ends TRC.
  if (!has(side) || (block.leads_softly && block.of(side).is(40))) return true;
  return state_.select(side_of(block.of(side).function->number), source);
}

bool Interpreter::apply_motion(ProgramLine& line, BlockWords& block) {
  if (block.copied) return true;
  if (dialect_.name == DialectName::sinumerik && (block.axis || block.center) &&
      !resolve_references(line, block))
    return false;
  if (block.leads_softly)
    return block.of(GGroup::soft_lead).function->number % 10 == 7 ? approach_softly(line, block)
                                                                  : depart_softly(line, block);
  const bool axis_is_position = !block.has(GGroup::dwell) && !block.of(GGroup::zero_shift).is(92);
  if ((!block.axis || !axis_is_position) && !block.center) return true;
  const std::uint32_t begin = std::min(block.axis.value_or(~0U), block.center.value_or(~0U));
  place(line, begin);
  const bool per_minute = feed_mode_ == 94;
  const bool adapted = state_.mode().feed_adaptation != FeedAdaptation::off;
  if (!per_minute && state_.contour_open() && (feed_mode_ == 93 || adapted))
    return refuse(line,
                  TextFault{.code = Code::nc_unsupported,
                            .begin = begin,
                            .detail = std::string("G")
                                          .append(std::to_string(feed_mode_))
                                          .append(adapted ? " with G11" : " while TRC is active")});
  return code_.soft_approach ? begin_contour_of_approach(line, block) : move(line, block.move);
}

// The words of `request` are those of the line; the rest is in force.
bool Interpreter::move(ProgramLine& line, MoveRequest& request) {
  request.source = line.source;
  request.kind = motion_;
  request.incremental = incremental_;
  request.feed = feed_mode_ == 94 ? feed_ : 0;
  if (inch_) scale(request);
  // Many post-processors write all three centre words.
  auto& across = request.center[axes_of(state_.mode().plane).third];
  if (dialect_.name != DialectName::isg && across == 0.0) across.reset();
  if (dialect_.arcs_to_the_contour && state_.awaits_approach() &&
      (motion_ == MotionKind::clockwise || motion_ == MotionKind::counter_clockwise)) {
    // An arc leads to the contour tangentially, as G05 does it: which arc, the contour says.
    request.kind = MotionKind::linear;
    request.center = {};
    request.radius.reset();
    state_.approach_tangentially();
  }
  line.is_motion = true;
  return state_.move(request);
}

// From inch to mm.
void Interpreter::scale(MoveRequest& request) const {
  const auto scale = [](std::optional<double>& value) {
    if (value) *value *= mm_per_inch;
  };
  for (auto& coordinate : request.end) scale(coordinate);
  for (auto& coordinate : request.center) scale(coordinate);
  scale(request.radius);
  if (request.corner) request.corner->size *= mm_per_inch;
  // U V W are linear axes, A B C turn: degrees have no inch.
  const auto& names = state_.setup().tracking_axes;
  for (std::size_t axis = 0; axis < request.tracking.size(); ++axis)
    if (!names[axis].empty() &&
        std::string_view("UVWXYZ").find(names[axis][0]) != std::string_view::npos)
      scale(request.tracking[axis]);
}

// The words of one role as one text, in their order.
bool Interpreter::pass_words(const ProgramLine& line, WordRole role) {
  std::string text;
  for (const WordRange& range : line.words) {
    if (range.role != role) continue;
    if (!text.empty()) text += ' ';
    text += line.word(range);
  }
  return state_.pass(line.source, std::move(text));
}

}  // namespace trc
