#include "core/nc/program/program_reader.h"

#include <algorithm>
#include <utility>

#include "core/base/reasons.h"
#include "core/nc/program/gcode_flow.h"
#include "core/nc/program/isg_line.h"
#include "core/nc/program/sinumerik_line.h"
#include "core/nc/text/characters.h"

namespace trc {
namespace {

enum class Text : std::uint8_t { goes_on, ends };

// The position after the line that begins at `at`; 0 if none does, or its end is still to come.
std::size_t behind_line(std::string_view text, std::size_t at, Text rest) {
  const std::size_t behind_text = rest == Text::ends && at < text.size() ? text.size() : 0;
  const std::size_t line_feed = text.find('\n', at);
  const std::size_t end = std::min(text.substr(0, line_feed).find('\r', at), line_feed);
  if (end == std::string_view::npos) return behind_text;
  if (text[end] == '\n') return end + 1;
  if (end + 1 == text.size()) return behind_text;
  return end + (text[end + 1] == '\n' ? 2 : 1);
}

constexpr std::size_t bytes_that_tell_utf16 = 2;

bool is_utf16(std::string_view text) {
  if (text.size() < bytes_that_tell_utf16) return false;
  const bool has_mark = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  return has_mark || (text[1] == '\0' && text[0] > 0 && text[0] <= '~');
}

// Searches from one to the next: comparing each byte takes five times as long.
std::uint64_t line_feeds_in(std::string_view text) {
  std::uint64_t count = 0;
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    ++count;
  return count;
}

bool is_plain(std::string_view text) {
  return !text.empty() && program::is_plain_isg(text) && text.find('\r') == std::string_view::npos;
}

std::string_view without_line_end(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

ProgramReader::ProgramReader(const ReaderLimits& limits, ProgramState& state,
                             Diagnostics& diagnostics, Checkpoint::Interrupt interrupt)
    : limits_(limits),
      state_(state),
      setup_(state.setup()),
      diagnostics_(diagnostics),
      interpreter_(limits, state, diagnostics),
      checkpoint_(std::move(interrupt)) {}

ProgramReader::~ProgramReader() = default;

bool ProgramReader::feed(std::string_view text, std::vector<LinePointer>& lines) {
  if (has_begun_) return take(text, lines);
  partial_.append(text);
  const bool may_be_mark = byte_order_mark.starts_with(partial_);
  if (partial_.size() < bytes_that_tell_utf16 || (may_be_mark && partial_ != byte_order_mark))
    return true;
  return begin(lines);
}

// The first bytes have come. A byte order mark goes to the Interpreter, so that the first line
// begins after it. A text in UTF-16 has a fault in each line; it is told once, and as such.
bool ProgramReader::begin(std::vector<LinePointer>& lines) {
  has_begun_ = true;
  const std::string first = std::exchange(partial_, {});
  if (is_utf16(first)) {
    Diagnostic refused = diagnostic(Code::nc_not_text, {}, std::string(reason::text_in_utf16));
    refused.source.line = 1;
    refused.column = 1;
    return interpreter_.stop(std::move(refused));
  }
  if (!first.starts_with(byte_order_mark)) return take(first, lines);
  return interpreter_.feed(byte_order_mark, lines) &&
         take(std::string_view(first).substr(byte_order_mark.size()), lines);
}

bool ProgramReader::take(std::string_view text, std::vector<LinePointer>& lines) {
  if (passes_) return interpreter_.feed(text, lines);
  if (computing_) return collect(text, lines);
  if (setup_.dialect == DialectName::isg && is_plain(text)) return pass_plain(text, lines);
  return split(text, lines);
}

// Nothing follows: what has been kept of a last line is the whole of it.
bool ProgramReader::end_text(std::vector<LinePointer>& lines) {
  if (!has_begun_ && !begin(lines)) return false;
  text_has_ended_ = true;
  return passes_ || computing_ || split({}, lines);
}

std::size_t ProgramReader::behind_next_line(std::string_view text, std::size_t at) const {
  return behind_line(text, at, text_has_ended_ ? Text::ends : Text::goes_on);
}

// Text of lines that compute nothing and end in line feeds goes on as a whole, except for the line
// that was begun before it.
bool ProgramReader::pass_plain(std::string_view text, std::vector<LinePointer>& lines) {
  if (!partial_.empty()) {
    const std::size_t behind = std::min(text.find('\n'), text.size() - 1) + 1;
    if (!split(text.substr(0, behind), lines)) return false;
    text.remove_prefix(behind);
    if (computing_) return collect(text, lines);
    if (passes_) return interpreter_.feed(text, lines);
    if (text.empty()) return true;
  }
  const std::size_t end = text.rfind('\n') + 1;
  lines_before_ += line_feeds_in(text.substr(0, end));
  before_is_whole_ = false;
  return (end == 0 || interpreter_.feed(text.substr(0, end), lines)) &&
         keep_partial(text.substr(end), lines);
}

// Lines that compute nothing go on together.
bool ProgramReader::split(std::string_view text, std::vector<LinePointer>& lines) {
  if (!partial_.empty()) {
    const std::string whole = std::exchange(partial_, {}).append(text);
    return split(whole, lines);
  }
  if (has_to_wait()) {
    text.remove_prefix(wait(text));
    if (computing_) return collect(text, lines);
    return has_to_wait() && !text_has_ended_ ? keep_partial(text, lines)
                                             : stop_waiting(text, lines);
  }
  std::size_t begin = 0;
  std::uint64_t count = 0;
  for (std::size_t end = behind_next_line(text, begin); end > 0;
       end = behind_next_line(text, begin)) {
    const std::string_view line = without_line_end(text.substr(begin, end - begin));
    if (!check_order_of_files(line, lines_before_ + count + 1)) return false;
    if (program::computes(setup_, line)) {
      if (!pass(text.substr(0, begin), lines)) return false;
      lines_before_ += std::exchange(count, 0);
      text.remove_prefix(begin);
      end -= std::exchange(begin, 0);
      if (!interpreter_.has_ended()) {
        computing_ = true;
        return collect(text, lines);
      }
      if (calls_what_stands_first(line))
        return refuse_order_of_programs(
            program::program_head_of(first_program_).told() + ", a subprogram before what calls it",
            lines_before_ + 1);
      // Only text follows the end of the program.
      passes_ = first_program_.empty();
      if (passes_) return interpreter_.feed(text, lines);
    }
    begin = end;
    ++count;
  }
  const bool goes_on = pass(text.substr(0, begin), lines);
  lines_before_ += count;
  return goes_on && keep_partial(text.substr(begin), lines);
}

// Takes whole lines until it is known whether they belong to the main program. Returns the number
// of bytes.
std::size_t ProgramReader::wait(std::string_view text) {
  std::size_t begin = 0;
  for (std::size_t end = behind_next_line(text, begin); end > 0;
       end = behind_next_line(text, begin)) {
    if (!lets_wait(text.substr(begin, end - begin))) return begin;
    begin = end;
    if (computing_) return begin;
  }
  return begin;
}

// Whether the line, which may end in a line end, waits too; if not, none does any more.
bool ProgramReader::lets_wait(std::string_view text) {
  const std::string_view line = without_line_end(text);
  const bool is_head = program::program_head_of(line).is_there();
  const bool says_nothing = program::is_percent(line) || program::is_over(line, 0);
  if (waits_ == Waits::for_head && is_head) {
    first_program_ = line;
    waits_ = Waits::for_main;
  }
  const bool begins_otherwise = waits_ == Waits::for_head && !says_nothing;
  const bool is_long = waiting_.size() + line.size() > most_text_before;
  if (begins_otherwise || is_long || program::tells_main_program(line)) {
    waits_ = Waits::not_any_more;
    return false;
  }
  const bool returns = program::has_function(line, 'M', 99, 99);
  computing_ = returns || program::computes(setup_, line);
  waiting_.append(text);
  return true;
}

// The lines that waited are read like any others, with the text that follows them.
bool ProgramReader::stop_waiting(std::string_view text, std::vector<LinePointer>& lines) {
  waits_ = Waits::not_any_more;
  const std::string whole = std::exchange(waiting_, {}).append(text);
  return split(whole, lines);
}

// Finds the main program in the collected text.
bool ProgramReader::find_main_program() {
  if (setup_.dialect != DialectName::fanuc) return true;
  const bool waited = has_to_wait();
  const bool is_whole = waited || before_is_whole_;
  std::string whole = is_whole ? before_ : std::string();
  whole.append(waiting_).append(text_);
  const program::ProgramText text({}, std::move(whole), 1, &checkpoint_);
  const program::MainProgram main =
      program::main_program_of(text, program::program_head_of(first_program_), checkpoint_);
  const std::uint64_t line_of_main = (is_whole ? 0 : lines_before_) + main.line + 1;
  if (!main.ambiguous.empty()) return refuse_order_of_programs(main.ambiguous, line_of_main);
  if (!main.is_first && !waited)
    return refuse_order_of_programs(main.first + ", a subprogram before what calls it",
                                    line_of_main);
  if (!waited) return true;
  if (!main.is_first) {
    waits_ = Waits::not_any_more;
    text_.insert(0, std::exchange(waiting_, {}));
    starts_at_main_ = true;
    main_line_ = main.line;
    return true;
  }
  // The main program comes first: its lines are read like any others.
  computing_ = false;
  waits_ = Waits::not_any_more;
  rest_ = std::exchange(waiting_, {}).append(std::exchange(text_, {}));
  text_has_ended_ = false;
  return true;
}

bool ProgramReader::read_rest(std::vector<LinePointer>& lines) {
  constexpr std::size_t bytes_per_call = 8 * 1024;
  const std::string_view piece = std::string_view(rest_).substr(rest_at_, bytes_per_call);
  rest_at_ += piece.size();
  const bool goes_on = take(piece, lines);
  if (!has_rest()) {
    rest_ = std::string();
    rest_at_ = 0;
  }
  return goes_on;
}

bool ProgramReader::refuse_order_of_programs(std::string detail, std::uint64_t line) {
  Diagnostic refused = diagnostic(Code::nc_unsupported, {}, std::move(detail));
  refused.source.line = static_cast<std::uint32_t>(line);
  return interpreter_.stop(std::move(refused));
}

// A subprogram before its caller does not know the modes that the caller sets before the call.
bool ProgramReader::check_order_of_files(std::string_view line, std::uint64_t number) {
  if (setup_.dialect != DialectName::sinumerik || !line.starts_with('%')) return true;
  std::string file = program::file_of_header(line);
  if (file.empty()) return true;
  if (first_file_.ends_with(program::subprogram_ending) &&
      file.ends_with(program::main_program_ending))
    return refuse_order_of_programs(first_file_ + ", a subprogram before what calls it", number);
  if (first_file_.empty()) first_file_ = std::move(file);
  return true;
}

// After the end: the first program has ended with M99.
bool ProgramReader::calls_what_stands_first(std::string_view line) {
  if (first_program_.empty()) return false;
  if (before_is_whole_) {
    const std::vector<program::ProgramOfText> programs =
        program::programs_of(program::ProgramText({}, before_), checkpoint_);
    if (programs.empty() || programs.front().ends_all) return false;
  }
  program::ProgramCalls calls;
  program::add_calls(line, calls);
  return calls.may_lead_to(program::program_head_of(first_program_).name);
}

bool ProgramReader::keep_partial(std::string_view text, std::vector<LinePointer>& lines) {
  if (text.size() > limits_.longest_line && has_to_wait()) return stop_waiting(text, lines);
  partial_.append(text);
  if (partial_.size() <= limits_.longest_line) return true;
  return interpreter_.feed(std::exchange(partial_, {}), lines);  // the interpreter refuses it
}

bool ProgramReader::pass(std::string_view text, std::vector<LinePointer>& lines) {
  if (setup_.dialect == DialectName::isg)
    keep_what_tells(text);
  else if (before_is_whole_ && before_.size() + text.size() <= most_text_before) {
    before_.append(text);
  } else if (!text.empty()) {
    before_is_whole_ = false;
    before_ = std::string();
  }
  return text.empty() || interpreter_.feed_lines(text, lines);
}

// In ISG the first jump target already counts as computing, so that no jump leads back before it.
void ProgramReader::keep_what_tells(std::string_view text) {
  before_is_whole_ &= text.empty();
  std::size_t begin = 0;
  for (std::size_t end = behind_line(text, begin, Text::ends); end > 0;
       end = behind_line(text, begin, Text::ends)) {
    const std::string_view line = text.substr(begin, end - begin);
    if (program::isg_tells_state(line) && before_.size() + line.size() <= most_text_before)
      before_.append(line);
    begin = end;
  }
}

bool ProgramReader::collect(std::string_view text, std::vector<LinePointer>& lines) {
  if (text_.size() + text.size() > most_computing_text) {
    // Klartext only calls labels, which may also pass unchanged.
    if (setup_.dialect == DialectName::heidenhain) {
      computing_ = false;
      passes_ = true;
      return interpreter_.feed(std::exchange(text_, {}), lines) && interpreter_.feed(text, lines);
    }
    Diagnostic refused = diagnostic(Code::computing_text_too_long, {});
    refused.values = {{"bytes", static_cast<double>(text_.size() + text.size())},
                      {"limit", static_cast<double>(most_computing_text)}};
    refused.source.line = static_cast<std::uint32_t>(lines_before_ + 1);
    return interpreter_.stop(std::move(refused));
  }
  text_.append(text);
  return check_last_line();
}

// A line may go on for ever, and a step of the execution takes a whole one.
bool ProgramReader::check_last_line() {
  if (text_.size() <= limits_.longest_line) return true;
  const std::size_t first = text_.size() - limits_.longest_line - 1;
  if (text_.find_first_of("\r\n", first) != std::string::npos) return true;
  const program::ProgramText lines({}, waiting_ + text_, 1, &checkpoint_);
  Diagnostic refused = diagnostic(
      Code::nc_line_too_long, {.line = static_cast<std::uint32_t>(lines_before_ + lines.size())});
  refused.values = {{"longest_line", static_cast<double>(limits_.longest_line)}};
  return interpreter_.stop(std::move(refused));
}

bool ProgramReader::finish(std::vector<LinePointer>& lines) {
  while (resolve(lines)) continue;
  if (diagnostics_.stopped()) return false;
  const bool computes = setup_.dialect == DialectName::linuxcnc && flow_;
  return interpreter_.finish(lines, computes ? "subprograms that nothing calls" : "");
}

std::uint64_t ProgramReader::lines_read() const {
  return flow_ ? lines_of_text_ : interpreter_.lines_read();
}

}  // namespace trc
