#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/base/length_unit.h"
#include "core/nc/program/linuxcnc_flow.h"
#include "core/nc/text/characters.h"

// Parameters of LinuxCNC.

namespace trc::program {
namespace {

// Parameters that QtPlasmaC's filter looks for in the text, before the control reads it.
constexpr auto read_by_the_filter =
    std::to_array<std::string_view>({"h_diameter", "h_velocity", "holes", "i_diameter",
                                     "i_velocity", "keep-z-motion", "oclength", "pierce-only"});

// Parameters that the control itself sets, and only knows when the program runs.
constexpr auto states = std::to_array<std::string_view>({
    "_a",
    "_abs_a",
    "_abs_b",
    "_abs_c",
    "_abs_u",
    "_abs_v",
    "_abs_w",
    "_abs_x",
    "_abs_y",
    "_abs_z",
    "_absolute",
    "_adaptive_feed",
    "_b",
    "_c",
    "_call_level",
    "_ccomp",
    "_coord_system",
    "_current_pocket",
    "_current_tool",
    "_feed",
    "_feed_hold",
    "_feed_override",
    "_flood",
    "_ijk_absolute_mode",
    "_incremental",
    "_inverse_time",
    "_lathe_diameter_mode",
    "_lathe_radius_mode",
    "_line",
    "_mist",
    "_motion_mode",
    "_plane",
    "_remap_level",
    "_retract_old_z",
    "_retract_r_plane",
    "_rpm",
    "_selected_pocket",
    "_selected_tool",
    "_speed_override",
    "_spindle_css_mode",
    "_spindle_cw",
    "_spindle_on",
    "_spindle_rpm_mode",
    "_task",
    "_tool_offset",
    "_u",
    "_units_per_minute",
    "_units_per_rev",
    "_v",
    "_vmajor",
    "_vminor",
    "_w",
    "_x",
    "_y",
    "_z",
});
constexpr auto beginnings_of_states = std::to_array<std::string_view>({"_ini[", "_hal["});

bool names_a_state(std::string_view name) {
  return std::ranges::find(states, name) != states.end() ||
         std::ranges::any_of(beginnings_of_states,
                             [&](std::string_view begin) { return name.starts_with(begin); });
}

// The last of the parameters that a program sets for itself.
constexpr std::int64_t last_number_of_programs = 5000;

}  // namespace

bool LinuxcncFlow::scan_assignment(std::size_t& at) {
  ExpressionReader expression = expression_at(at);
  Assignment assignment{.begin = at};
  assignment.target = target_at(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    return refuse(Code::expression_invalid, at, "# without =");
  expression.go_to(expression.at() + (expression.failed() ? 0 : 1));
  expression.pass_blanks();
  const std::size_t value_begin = expression.at();
  kept_text_.begin(outlives_program(assignment.target) ? spelled(assignment.target) : "");
  assignment.value = expression.operand().number;
  kept_text_.end();
  if (expression.failed()) return refuse(expression.fault());
  at = expression.at();
  assignment.kept = kept_text_;
  if (kept_text_.stays()) assignment.text = kept_text_.text(line_, value_begin, at);
  const std::size_t behind = behind_blanks(line_, at);
  if (behind < line_.size() &&
      std::string_view("+-*/[]").find(line_[behind]) != std::string_view::npos)
    return refuse(Code::expression_invalid, behind, std::string(1, line_[behind]));
  assignments_.push_back(std::move(assignment));
  return true;
}

bool LinuxcncFlow::assign(const Assignment& assignment) {
  const auto& [name, number] = assignment.target;
  const std::string spelling = spelled(assignment.target);
  Locals& locals = locals_.back();
  if (is_state(assignment.target))
    return refuse(number == 0 && name.empty() ? Code::value_invalid : Code::machine_state,
                  assignment.begin, spelling);
  if (std::ranges::find(read_by_the_filter, name) != read_by_the_filter.end()) {
    settings_.append(spelling).append("=");
    append_value(settings_, assignment.value, PointStyle::as_whole);
    settings_.append(line_end());
  }
  const bool is_everyones = !is_own(assignment.target);
  kept_text_ = assignment.kept;
  if (is_everyones) note_counter(spelling);
  if (is_everyones && assignment.text.empty()) {
    if (name.empty())
      unwritten_numbers_.insert(number);
    else
      unwritten_names_.insert(name);
    if (kept_text_.hangs_by_the_way()) warn_of_given(assignment.begin, spelling);
  }
  if (!is_everyones) locals.of_machine.erase(spelling);
  if (!is_everyones && kept_text_.hangs_on_machine()) locals.of_machine.insert(spelling);
  if (!name.empty())
    (name.front() == '_' ? globals_ : locals.named)[name] = assignment.value;
  else if (number < static_cast<std::int64_t>(locals.numbered.size()))
    locals.numbered.at(static_cast<std::size_t>(number)) = assignment.value;
  else
    common_[number] = assignment.value;
  return true;
}

// All assignments that the control computes itself are in one line, as they all take effect after
// it.
void LinuxcncFlow::write_kept_assignments() {
  std::string text;
  for (const Assignment& assignment : assignments_) {
    if (assignment.text.empty()) continue;
    const auto& [name, number] = assignment.target;
    if (name.empty())
      unwritten_numbers_.erase(number);
    else
      unwritten_names_.erase(name);
    text.append(text.empty() ? "" : " ").append(spelled(assignment.target));
    text.append("=").append(assignment.text);
  }
  if (!text.empty()) settings_.append(text).append(line_end());
}

LinuxcncFlow::Target LinuxcncFlow::target_at(ExpressionReader& expression) {
  const std::size_t begin = expression.at();
  expression.go_to(begin + 1);
  expression.pass_blanks();
  if (expression.peek() != '<') return {.number = expression.whole_operand()};
  const std::string_view line = expression.line();
  const std::size_t close = line.find('>', expression.at());
  if (close == std::string_view::npos || close == expression.at() + 1) {
    static_cast<void>(expression.fail(Code::expression_invalid, begin, "#<, a name without >"));
    return {.name = "?"};
  }
  std::string name = plain_name(line.substr(expression.at() + 1, close - expression.at() - 1));
  expression.go_to(close + 1);
  return {.name = std::move(name)};
}

bool LinuxcncFlow::is_state(const Target& target) {
  return target.name.empty() ? target.number == 0 || target.number > last_number_of_programs
                             : names_a_state(target.name);
}

std::string LinuxcncFlow::spelled(const Target& target) {
  return target.name.empty() ? "#" + std::to_string(target.number) : "#<" + target.name + ">";
}

const double* LinuxcncFlow::given_to(const Target& target) const {
  return given(target.name.empty() ? std::to_string(target.number) : in_upper_case(target.name));
}

// A global parameter that the control sets, or whose value depends on the control.
bool LinuxcncFlow::is_of_machine(const Target& target) const {
  if (!outlives_program(target)) return false;
  const bool is_set =
      target.name.empty() ? common_.contains(target.number) : globals_.contains(target.name);
  return is_set ? counter(spelled(target)) != nullptr : given_to(target) != nullptr;
}

bool LinuxcncFlow::is_given_state(const Target& target) const {
  return is_state(target) && given_to(target) != nullptr;
}

// A parameter that is not global.
bool LinuxcncFlow::is_own(const Target& target) const {
  const auto numbered = static_cast<std::int64_t>(locals_.back().numbered.size());
  return target.name.empty() ? target.number < numbered : target.name.front() != '_';
}

std::optional<double> LinuxcncFlow::content_of(const Target& target) const {
  const auto& [name, number] = target;
  const Locals& locals = locals_.back();
  const auto content = [](const auto& map, const auto& key) {
    const auto known = map.find(key);
    return known == map.end() ? std::optional<double>() : std::optional<double>(known->second);
  };
  std::optional<double> known;
  if (!name.empty())
    known = content(name.front() == '_' ? globals_ : locals.named, name);
  else if (number > 0 && number < static_cast<std::int64_t>(locals.numbered.size()))
    known = locals.numbered.at(static_cast<std::size_t>(number));
  else
    known = content(common_, number);
  const bool* const counted = known ? counter(spelled(target)) : nullptr;
  if (counted != nullptr && !*counted) return {};
  if (known) return known;
  if (name == "_metric" || name == "_imperial")
    return (name == "_imperial") == (modes_.unit == LengthUnit::inch) ? 1 : 0;
  if (name == "_absolute" || name == "_incremental")
    return (name == "_incremental") == modes_.incremental ? 1 : 0;
  if (!lost_to_.empty() && !is_own(target)) return {};
  if (const double* const value = given_to(target)) return *value;
  // #5410 counts in the unit of the machine.
  constexpr std::int64_t diameter_of_tool = 5410;
  const bool is_diameter =
      number == diameter_of_tool && name.empty() && modes_.unit == setup_.length_unit();
  if (!is_diameter || !modes_.spindle_diameter) return std::nullopt;
  return *modes_.spindle_diameter / mm_of(modes_.unit);
}

Value LinuxcncFlow::read(ExpressionReader& expression) {
  suppose();
  const std::size_t begin = expression.at();
  const Target target = kept_text_.read_aside([&] { return target_at(expression); });
  if (expression.failed()) return {};
  Value value = value_of(expression, target, begin);
  std::string text;
  append_value(text, value.number, PointStyle::as_whole);
  kept_text_.take(begin, expression.at(), text.front() == '-' ? "[" + text + "]" : text);
  return value;
}

Value LinuxcncFlow::value_of(ExpressionReader& expression, const Target& target,
                             std::size_t begin) {
  const std::string name = spelled(target);
  const bool is_everyones = outlives_program(target);
  const bool* const counted = is_everyones ? counter(name) : nullptr;
  const std::optional<double> content = content_of(target);
  if (content) {
    if (is_of_machine(target))
      kept_text_.keep(name);
    else if (locals_.back().of_machine.contains(name) || is_given_state(target))
      kept_text_.hang_by_the_way();
    return {.number = *content};
  }
  if (is_everyones && kept_text_.may_be_unknown(name)) {
    kept_text_.keep_unknown(name);
    return {.number = 1};
  }
  std::string detail = name;
  if (counted == nullptr && is_everyones && !lost_to_.empty())
    detail += ", which may have been set by " + lost_to_;
  return without_value(expression, is_state(target) ? Code::machine_state : Code::variable_unset,
                       begin, std::move(detail));
}

bool LinuxcncFlow::exists(ExpressionReader& expression) {
  if (expression.peek() != '#') {
    static_cast<void>(expression.fail(Code::expression_invalid, expression.at(), "EXISTS"));
    return false;
  }
  const Target target = target_at(expression);
  return content_of(target).has_value() || counter(spelled(target)) != nullptr;
}

}  // namespace trc::program
