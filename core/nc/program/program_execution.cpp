#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "core/nc/program/flow.h"
#include "core/nc/program/program_reader.h"

// The execution of a program that computes, once the whole of it has been collected.

namespace trc {
namespace {

// The number of lines executed, or output, before others have their turn.
constexpr std::size_t lines_per_call = 256;
constexpr std::size_t executed_per_call = 4096;

// After these faults the rest of the program is not checked.
bool tells_all_alone(Code code) {
  return code == Code::too_many_lines_executed || code == Code::calls_too_deep ||
         code == Code::program_alarm || code == Code::side_behind_end;
}

}  // namespace

bool ProgramReader::begin_to_execute(std::vector<LinePointer>& lines) {
  if (flow_) return true;
  if (!text_has_ended_ && !end_text(lines)) return false;
  if (computing_ && !std::exchange(main_is_known_, true) && !find_main_program()) return false;
  if (has_rest() || !computing_) return false;
  const std::uint64_t first_line = before_is_whole_ ? 1 : lines_before_ + 1;
  const std::size_t start = starts_at_main_ ? main_line_ : before_is_whole_ ? lines_before_ : 0;
  const std::string told = before_is_whole_ ? std::string() : std::exchange(before_, {});
  program::ProgramText text({}, std::exchange(before_, {}).append(std::exchange(text_, {})),
                            static_cast<std::uint32_t>(first_line), &checkpoint_);
  lines_of_text_ = first_line - 1 + text.size();
  for (std::size_t line = start; line < text.size(); ++line) {
    checkpoint_.pass();
    if (!check_order_of_files(text.line(line), text.number(line))) return false;
  }
  const auto first_block = interpreter_.blocks_read() > 0 ? program::FirstBlock::before_text
                                                          : program::FirstBlock::in_text;
  flow_ = program::make_flow(setup_, {.calls = diagnostics_.calls(), .checkpoint = checkpoint_},
                             std::move(text), start, first_block);
  flow_->know(told);
  return true;
}

bool ProgramReader::resolve(std::vector<LinePointer>& lines) {
  if (executed_ || diagnostics_.stopped()) return false;
  if (has_rest()) return read_rest(lines);
  if (!begin_to_execute(lines)) return has_rest() && !diagnostics_.stopped();
  for (std::size_t executed = 0; executed < executed_per_call && lines.size() < lines_per_call;
       ++executed) {
    checkpoint_.pass();
    if (flat_at_ == flat_.size() && !execute_next(lines)) return false;
    if (!read_flat_lines(flat_, flat_at_, FlatText::rest, lines_per_call, lines)) return false;
    executed_ = ended_ && flat_at_ == flat_.size();
    if (executed_) return false;
  }
  return true;
}

bool ProgramReader::execute_next(std::vector<LinePointer>& lines) {
  flat_.clear();
  flat_at_ = 0;
  flow_->hold(modes());
  const program::Flow::Step step = flow_->step(flat_);
  ended_ = step == program::Flow::Step::ended;
  for (const Diagnostic& warning : flow_->warnings())
    if (!diagnostics_.report(with_place(warning))) return false;
  if (step == program::Flow::Step::refused && !take_refusals()) return false;
  std::size_t at = 0;
  const std::string& settings = flow_->settings();
  return read_flat_lines(settings, at, FlatText::settings, settings.size() + lines.size(), lines);
}

program::ModalState ProgramReader::modes() const {
  std::array<std::optional<double>, 3> place{};
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    if (state_.contour_open() || !state_.is_known(axis)) continue;
    place.at(axis) = state_.position().at(axis) / mm_of(interpreter_.unit_in_force());
  }
  return {.motion = interpreter_.motion_in_force(),
          .plane = interpreter_.plane_in_force(),
          .incremental = interpreter_.is_incremental(),
          .unit = interpreter_.unit_in_force(),
          .tool_radius = interpreter_.radius_in_force(),
          .spindle_diameter = interpreter_.spindle_diameter(),
          .contour_open = interpreter_.is_in_contour(),
          .place = place};
}

// All lines that come from one line are reported at its place.
bool ProgramReader::read_flat_lines(std::string_view flat, std::size_t& at, FlatText kind,
                                    std::size_t most, std::vector<LinePointer>& lines) {
  const bool sets_variables = kind == FlatText::settings;
  while (at < flat.size() && lines.size() < most) {
    const std::size_t begin = at;
    const std::size_t end = std::min(flat.find_first_of("\r\n", begin), flat.size());
    const std::size_t next =
        end == flat.size() ? end : end + (flat.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    diagnostics_.calls().stand(interpreter_.blocks_read(), flow_->chain(), flow_->line_within());
    const Interpreter::FlatLine line{
        .text = flat.substr(begin, end - begin),
        .line_end = flat.substr(end, next - end),
        .number = flow_->line_in_program(),
        // The columns are those of the program.
        .is_as_written = !sets_variables && flow_->is_as_written() && flow_->line_within() == 0,
        .sets_variables = sets_variables,
        .calls_the_machine = !sets_variables && flow_->calls_the_machine() && next == flat.size(),
        .machine_follows = !sets_variables && flow_->machine_follows() && next == flat.size(),
        .call_leaves = flow_->call_leaves()};
    if (!interpreter_.read(line, lines)) return false;
    at = next;
  }
  return true;
}

// The place of the line that was executed last.
Diagnostic ProgramReader::with_place(Diagnostic found) const {
  found.source.line = flow_->line_in_program();
  found.source.number = flow_->number_in_program();
  found.calls = diagnostics_.calls().of(flow_->chain(), flow_->line_within());
  // The column is meaningless for a line of another text.
  if (flow_->line_within() > 0) found.column = 0;
  return found;
}

// Whether the rest of the program is checked.
bool ProgramReader::take_refusals() {
  diagnostics_.calls().stand(interpreter_.blocks_read(), flow_->chain(), flow_->line_within());
  for (const Diagnostic& found : flow_->refusals()) {
    Diagnostic refusal = with_place(found);
    if (tells_all_alone(refusal.code)) return interpreter_.stop(std::move(refusal));
    if (!interpreter_.note(std::move(refusal))) return false;
  }
  flow_->look_ahead();
  return true;
}

}  // namespace trc
