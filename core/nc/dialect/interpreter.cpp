#include "core/nc/dialect/interpreter.h"

#include <algorithm>
#include <utility>

#include "core/nc/dialect/gcode_tools.h"
#include "core/nc/dialect/heidenhain.h"
#include "core/nc/dialect/klartext_block.h"
#include "core/nc/dialect/read_line.h"
#include "core/nc/dialect/reading.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/klartext_words.h"

// Turns text into lines, wherever the text is cut, and reads each line as soon as it is complete.

namespace trc {
namespace {

constexpr std::size_t spare_lines = 2048;  // as many as a message of 64 KiB holds
constexpr std::size_t longest_spare_line = 256;
constexpr std::size_t usual_words = 8;

void forget_words(ProgramLine& line) {
  line.words.clear();
  line.roles = 0;
  line.names_other_axes = false;
  line.main_axes = 0;
  line.ends_program = line.calls_the_machine = false;
  line.feed_it_takes = 0;
}

// A cheap test that rules out most lines.
bool may_be_continued(std::string_view line) {
  const char last = line.empty() ? '\0' : line.back();
  return last == '\\' || last == ' ' || last == '\t' || last == '\xA0';
}

std::string_view last_line_of(std::string_view text) {
  const std::size_t line_end = text.find_last_of("\r\n");
  return line_end == std::string_view::npos ? text : text.substr(line_end + 1);
}

}  // namespace

bool Interpreter::feed(std::string_view text, std::vector<LinePointer>& lines) {
  if (reading_.diagnostics.stopped()) return false;
  if (carriage_return_ && !text.empty()) {
    carriage_return_ = false;
    const bool line_feed = text.front() == '\n';
    if (line_feed) text.remove_prefix(1);
    if (!take_line({}, line_feed ? "\r\n" : "\r", lines)) return false;
  }
  // Keeps both positions, so that each sign is searched for only once.
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
    if (partial_.size() + part.size() > reading_.limits.longest_line) return refuse_long_line();
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

bool Interpreter::feed_lines(std::string_view text, std::vector<LinePointer>& lines) {
  return feed(text, lines) &&
         (!std::exchange(carriage_return_, false) || take_line({}, "\r", lines));
}

bool Interpreter::read(const FlatLine& line, std::vector<LinePointer>& lines) {
  if (reading_.diagnostics.stopped()) return false;
  reading_.lines_read = line.number - 1 - continued_;
  reading_.knows_columns = line.is_as_written;
  // The text may be released before the line.
  const std::string_view line_end = line.line_end == "\n"     ? "\n"
                                    : line.line_end == "\r\n" ? "\r\n"
                                    : line.line_end == "\r"   ? "\r"
                                                              : "";
  reading_.reads_flat = true;
  reading_.sets_variables = line.sets_variables;
  reading_.calls_the_machine = line.calls_the_machine;
  reading_.machine_follows = line.machine_follows;
  reading_.call_leaves = line.call_leaves;
  const bool goes_on = take_line(line.text, line_end, lines);
  reading_.sets_variables = reading_.calls_the_machine = reading_.machine_follows = false;
  reading_.call_leaves.reset();
  return goes_on;
}

// Takes the rest of a line, with its end; partial_ has its beginning.
bool Interpreter::take_line(std::string_view text, std::string_view line_end,
                            std::vector<LinePointer>& lines) {
  if (!partial_.empty()) {
    partial_.append(text);
    text = partial_;
  }
  if (!std::exchange(has_begun_, true) && text.starts_with(byte_order_mark)) {
    enter_modes(append_line(byte_order_mark, {}, lines));
    text.remove_prefix(byte_order_mark.size());
  }
  std::string_view last_line = continued_ == 0 ? text : last_line_of(text);
  if (continued_ > 0 && reading_.dialect.name == DialectName::heidenhain &&
      is_klartext_comment(text) && begins_klartext_block(last_line)) {
    if (!take_block_before(last_line, lines)) return false;
    last_line = text = partial_;
  }
  if (std::exchange(may_go_on_, false) && !is_rest_of_klartext_block(last_line)) {
    if (!take_block_before(last_line, lines)) return false;
    last_line = text = partial_;
  }
  const bool goes_on_below = reading_.dialect.name == DialectName::heidenhain
                                 ? is_continued_klartext(last_line)
                                 : may_be_continued(last_line) && is_continued(last_line);
  may_go_on_ = !goes_on_below && !line_end.empty() && may_go_on(text);
  if (!reading_.ended && reading_.comment_block == 0 && (goes_on_below || may_go_on_)) {
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

bool Interpreter::may_go_on(std::string_view block) const {
  if (!reading_.klartext_modes.in_columns || reading_.reads_flat || reading_.ended) return false;
  const std::size_t number = block.find_first_not_of(" \t");
  return number != std::string_view::npos && is_digit(block[number]) && !is_klartext_comment(block);
}

bool Interpreter::take_block_before(std::string_view last_line, std::vector<LinePointer>& lines) {
  const std::string whole = std::exchange(partial_, std::string(last_line));
  std::string_view block(whole.data(), whole.size() - last_line.size());
  const std::string_view line_end = block.ends_with("\r\n") ? "\r\n"
                                    : block.ends_with('\n') ? "\n"
                                                            : "\r";
  block.remove_suffix(line_end.size());
  return take_block(block, line_end, std::exchange(continued_, 0U), lines);
}

bool Interpreter::take_block(std::string_view text, std::string_view line_end,
                             std::uint32_t lines_of_it, std::vector<LinePointer>& lines) {
  ProgramLine& line = append_line(text, line_end, lines);
  reading_.lines_read += lines_of_it;
  const bool goes_on = read_line(reading_, line);
  enter_modes(line);
  if (reading_.faults.empty()) return goes_on;
  // The line may turn out to be before the tape: a text without words.
  if (reading_.in_front_of_tape && reading_.blocks_read == 0 && !reading_.diagnostics.stopped()) {
    forget_words(line);
    return true;
  }
  recycle(std::move(lines.back()));
  lines.pop_back();
  return !reading_.diagnostics.stopped();
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
  line.source = {.index = reading_.blocks_read,
                 .line = static_cast<std::uint32_t>(reading_.lines_read + 1)};
  line.has_words = line.is_motion = line.has_trc_words = false;
  line.klartext.reset();
  line.third_set.reset();
  line.is_computed = reading_.reads_flat && !reading_.knows_columns;
  forget_words(line);
  return line;
}

void Interpreter::enter_modes(ProgramLine& line) const {
  line.motion = reading_.motion;
  line.incremental = reading_.incremental;
  line.unit = reading_.unit;
  line.feed_unit = reading_.feed_in_mm ? LengthUnit::mm : reading_.unit;
  line.absolute_center = reading_.state.absolute_center();
  line.plane = reading_.state.programmed_plane();
  line.feed = reading_.feed_mode == 94 ? reading_.feed : 0;
}

void Interpreter::recycle(LinePointer line) {
  if (spare_.size() == spare_lines || line->text.capacity() > longest_spare_line) return;
  spare_.push_back(std::move(line));
}

bool Interpreter::finish(std::vector<LinePointer>& lines, std::string_view why_empty) {
  if (reading_.diagnostics.stopped()) return false;
  if (carriage_return_) {
    carriage_return_ = false;
    if (!take_line({}, "\r", lines)) return false;
  }
  const bool continued_to_nothing = !partial_.empty() && is_line_end(partial_.back());
  if (continued_to_nothing) {
    const bool comment =
        reading_.dialect.name == DialectName::heidenhain && is_klartext_comment(partial_);
    if (!comment && !std::exchange(may_go_on_, false)) return refuse_open_line();
    if (!take_block_before({}, lines)) return false;
  }
  if (!partial_.empty() && !take_line({}, {}, lines)) return false;
  if (!reading_.faults.empty()) return reading_.report_faults();
  const auto last_line =
      static_cast<std::uint32_t>(std::max<std::uint64_t>(reading_.lines_read, 1));
  if (reading_.comment_block != 0)
    return reading_.diagnostics.report(
        diagnostic(Code::nc_unclosed, {.line = reading_.comment_block}, "#COMMENT BEGIN"));
  if (reading_.blocks_read == 0)
    return reading_.diagnostics.report(
        diagnostic(Code::program_empty, {.line = last_line}, std::string(why_empty)));
  reading_.state.place(0);
  return reading_.state.end({.index = reading_.blocks_read, .line = last_line});
}

bool Interpreter::stop(Diagnostic error) {
  error.source.index = reading_.blocks_read;
  if (reading_.faults.empty()) return reading_.diagnostics.report(std::move(error));
  std::vector<Diagnostic> all = reading_.told_faults();
  all.push_back(std::move(error));
  return reading_.diagnostics.report_together(std::move(all));
}

bool Interpreter::note(Diagnostic error) {
  error.source.index = reading_.blocks_read;
  reading_.collect(std::move(error));
  return !reading_.diagnostics.stopped();
}

bool Interpreter::refuse_long_line() {
  Diagnostic refused =
      diagnostic(Code::nc_line_too_long,
                 {.index = reading_.blocks_read,
                  .line = static_cast<std::uint32_t>(reading_.lines_read + continued_ + 1)});
  refused.values = {{"longest_line", static_cast<double>(reading_.limits.longest_line)}};
  partial_.clear();
  return reading_.diagnostics.report(std::move(refused));
}

// The text ends after a `\`.
bool Interpreter::refuse_open_line() {
  const auto last_line = static_cast<std::uint32_t>(reading_.lines_read + std::max(continued_, 1U));
  return reading_.diagnostics.report(
      diagnostic(Code::nc_unclosed, {.index = reading_.blocks_read, .line = last_line},
                 reading_.dialect.name == DialectName::heidenhain ? "~" : "\\"));
}

std::optional<double> Interpreter::spindle_diameter() const {
  return trc::spindle_diameter(reading_);
}

}  // namespace trc
