#include "core/nc/program/flow.h"

#include <algorithm>
#include <utility>

#include "core/base/reasons.h"
#include "core/base/utf8.h"
#include "core/nc/dialect/block_skip.h"
#include "core/nc/program/fanuc_flow.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/program/isg_flow.h"
#include "core/nc/program/klartext_flow.h"
#include "core/nc/program/linuxcnc_flow.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/state/variable_name.h"
#include "core/nc/text/characters.h"

namespace trc::program {

Flow::Flow(const ProgramSetup& setup, const Lent& lent)
    : setup_(setup), calls_(lent.calls), checkpoint_(lent.checkpoint) {
  for (const auto& [name, value] : setup.variables)
    given_[plain_variable_name(name, setup.dialect)] = value;
}

std::uint32_t Flow::line_in_program() const {
  // A given subprogram has its own text; its caller is in an outer frame.
  for (auto frame = executed_frame(); frame != frames_.rend(); ++frame)
    if (frame->text == 0) return texts_[0].number(frame->current);
  return 0;
}

std::int64_t Flow::number_in_program() const {
  for (auto frame = executed_frame(); frame != frames_.rend(); ++frame)
    if (frame->text == 0) return head_of(texts_[0].line(frame->current)).number;
  return Source::no_number;
}

std::uint32_t Flow::line_within() const {
  const Frame& frame = *executed_frame();
  return frame.text == 0 ? 0 : texts_[frame.text].number(frame.current);
}

std::string_view Flow::line_end() const {
  const Frame& frame = frames_.back();
  const std::string_view own = texts_[frame.text].line_end(frame.current);
  if (!own.empty()) return own;
  // The last line of a text may have no line end.
  return texts_[0].size() > 1 ? texts_[0].line_end(0) : "\n";
}

bool Flow::is_left_out(std::string_view line) const {
  SkipSign sign;
  return decided_about(line, setup_, sign) == BlockSkip::leave_out;
}

bool Flow::count_line() {
  seen_line() = true;
  if (looks_ahead_ || ++executed_ <= setup_.max_executed_lines) return true;
  refuse(Code::too_many_lines_executed, 0, {});
  refusals_.back().column = 0;
  refusals_.back().values = {{"limit", static_cast<double>(setup_.max_executed_lines)}};
  return false;
}

std::vector<bool>::reference Flow::seen_line() {
  const Frame& frame = frames_.back();
  if (seen_.size() < texts_.size()) seen_.resize(texts_.size());
  std::vector<bool>& lines = seen_[frame.text];
  if (lines.empty()) lines.resize(texts_[frame.text].size());
  return lines[frame.current];
}

bool Flow::was_seen(const Frame& frame, std::size_t line) const {
  return frame.text < seen_.size() && line < seen_[frame.text].size() && seen_[frame.text][line];
}

bool Flow::enter(Frame callee) {
  if (frames_.size() > deepest_call) {
    if (looks_ahead_) return true;
    refuse(Code::calls_too_deep, 0, callee.name);
    refusals_.back().values = {{"limit", static_cast<double>(deepest_call)}};
    return false;
  }
  const Frame& caller = frames_.back();
  // A subprogram at the end of the text with no line but its name.
  callee.current = std::min(callee.current, texts_[callee.text].size() - 1);
  callee.chain =
      calls_.enter(caller.chain, as_utf8(callee.name), texts_[caller.text].number(caller.current));
  if (looks_ahead_) {
    forget_values();
    ahead_.push_back({.frames = frames_});
    ahead_.back().frames.push_back(std::move(callee));
    return true;
  }
  frames_.push_back(std::move(callee));
  has_entered_ = true;
  return true;
}

void Flow::forget_values() {
  for (LinesAhead& lines : ahead_) lines.knows_values = false;
}

Flow::Step Flow::step(std::string& flat) {
  refusals_.clear();
  warnings_.clear();
  settings_.clear();
  kept_text_ = {};
  call_leaves_.reset();
  calls_the_machine_ = machine_follows_ = has_entered_ = false;
  return looks_ahead_ ? look_at_next(flat) : execute_next(flat);
}

// Reads the refused line again, for further faults and for the variable that it sets.
void Flow::look_ahead() {
  if (std::exchange(looks_ahead_, true)) return;
  for (std::size_t depth = frames_.size(); depth > 0; --depth)
    ahead_.push_back(
        {.frames = {frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(depth)},
         .knows_values = true});
  Frame& innermost = ahead_.front().frames.back();
  innermost.next = innermost.current;
  seen_line() = false;
}

Flow::Step Flow::look_at_next(std::string& flat) {
  while (!ahead_.empty()) {
    frames_ = ahead_.front().frames;
    Frame& at = frames_.back();
    while (at.next < at.end && was_seen(at, at.next)) ++at.next;
    if (at.next >= at.end) {
      ahead_.pop_front();
      continue;
    }
    std::size_t levels = 1;
    for (std::size_t depth = 1; depth < frames_.size(); ++depth)
      levels += frames_[depth].own_variables ? 1 : 0;
    keep_variables(levels);
    std::size_t& next = ahead_.front().frames.back().next;
    next = at.next + 1;
    supposes_ = ended_ = false;
    passed_over_ = 0;
    const bool goes_on = execute_line(flat);
    next = std::max(next, passed_over_);
    if (ended_) next = at.end;
    return goes_on && refusals_.empty() ? Step::goes_on : Step::refused;
  }
  return Step::ended;
}

bool Flow::may_be_a_consequence(Code code) const {
  switch (code) {
    case Code::variable_unset:
      return !ahead_.front().knows_values;
    case Code::jump_target_unknown:
    case Code::subprogram_unknown:
    case Code::division_by_zero:
    case Code::value_invalid:
      return supposes_;
    case Code::program_alarm:
      return true;
    case Code::block_structure:
      return misread_;
    default:
      return false;
  }
}

bool Flow::refuse(Code code, std::size_t begin, std::string detail) {
  if (looks_ahead_ && may_be_a_consequence(code)) return false;
  misread_ |= code == Code::expression_invalid;
  refusals_.push_back(diagnostic(code, {}, std::move(detail)));
  refusals_.back().column = static_cast<std::uint32_t>(begin + 1);
  return false;
}

void Flow::note_counter(const std::string& name) {
  if (kept_text_.stays())
    counters_[name] = kept_text_.is_known();
  else if (!counters_.empty())
    counters_.erase(name);
}

const bool* Flow::counter(const std::string& name) const {
  const auto found = counters_.find(name);
  return found == counters_.end() ? nullptr : &found->second;
}

void Flow::warn_of_given(std::size_t begin, const std::string& name) {
  if (looks_ahead_ || !warned_of_.insert(name).second) return;
  warnings_.push_back(diagnostic(Code::given_value_kept, {}, name));
  warnings_.back().column = static_cast<std::uint32_t>(begin + 1);
}

Value Flow::without_value(ExpressionReader& expression, Code code, std::size_t begin,
                          std::string detail) {
  if (!looks_ahead_) return expression.fail(code, begin, std::move(detail));
  refuse(code, begin, std::move(detail));
  return {.number = 1};
}

std::size_t Flow::first_with(char letter, int first, int second, std::size_t begin,
                             std::size_t end) const {
  for (; begin < end; ++begin) {
    checkpoint_.pass();
    if (has_function(texts_.front().line(begin), letter, first, second)) break;
  }
  return begin;
}

// No call resolves this contour (D-143).
bool Flow::refuse_contour_behind_end(std::size_t line) {
  frames_.erase(frames_.begin() + 1, frames_.end());
  std::string detail = "G41, G42";
  const ProgramText& text = texts_.front();
  const auto ends = [&](std::size_t at) {
    return has_function(text.line(at), 'M', 2, 30) || has_function(text.line(at), 'M', 17, 99);
  };
  std::size_t end = frames_.front().current;
  while (end < line && !without_blanks_in_front(text.line(end)).starts_with('%') && !ends(end))
    ++end;
  if (end < line && !ends(end))
    detail.append(reason::after_percent).append(std::to_string(text.number(end)));
  frames_.front().current = line;
  return refuse(Code::side_behind_end, 0, std::move(detail));
}

bool Flow::computes_behind_end(std::string_view line) const { return computes(setup_, line); }

std::size_t Flow::end_of_plain_text(std::size_t begin, std::size_t end) const {
  for (; begin < end; ++begin) {
    checkpoint_.pass();
    const std::string_view line = texts_.front().line(begin);
    if (was_seen(frames_.front(), begin) || computes_behind_end(line)) break;
  }
  return begin;
}

std::size_t Flow::write_text_behind_end(std::string& flat, std::size_t behind) {
  const std::size_t begin = frames_.front().current + 1;
  const std::size_t end = end_of_plain_text(begin, behind);
  return copy_text_behind_end(flat, end) ? std::max(begin, end) : begin;
}

bool Flow::copy_text_behind_end(std::string& flat, std::size_t behind) {
  // Without M02 or M30 the lines would be executed; in a call they stand after the call.
  if (flat.empty() || frames_.size() > 1) return false;
  const ProgramText& text = texts_.front();
  for (std::size_t line = frames_.front().current + 1; line < behind; ++line) {
    checkpoint_.pass();
    is_as_written_ = false;
    flat.append(text.line(line)).append(text.line_end(line));
  }
  return true;
}

const double* Flow::given(std::string_view name) const {
  const auto known = given_.find(name);
  return known == given_.end() ? nullptr : &known->second;
}

bool computes(const ProgramSetup& setup, std::string_view line) {
  switch (setup.dialect) {
    case DialectName::fanuc:
      return fanuc_computes(line);
    case DialectName::linuxcnc:
      return linuxcnc_computes(line);
    case DialectName::sinumerik:
      return sinumerik_computes(setup, line);
    case DialectName::isg:
      return isg_computes(setup, line);
    case DialectName::heidenhain:
      return klartext_computes(line);
  }
  return false;
}

std::unique_ptr<Flow> make_flow(const ProgramSetup& setup, const Lent& lent, ProgramText text,
                                std::size_t start, FirstBlock first_block) {
  if (setup.dialect == DialectName::linuxcnc)
    return std::make_unique<LinuxcncFlow>(setup, lent, std::move(text), start);
  if (setup.dialect == DialectName::sinumerik)
    return std::make_unique<SinumerikFlow>(setup, lent, std::move(text), start);
  if (setup.dialect == DialectName::isg)
    return std::make_unique<IsgFlow>(setup, lent, std::move(text), first_block);
  if (setup.dialect == DialectName::heidenhain)
    return std::make_unique<KlartextFlow>(setup, lent, std::move(text), start);
  return std::make_unique<FanucFlow>(setup, lent, std::move(text), start);
}

}  // namespace trc::program
