#include <algorithm>

#include "core/base/reasons.h"
#include "core/nc/program/fanuc_flow.h"
#include "core/nc/text/characters.h"

// Variables of Fanuc, and values that the control itself keeps in them.

namespace trc::program {
namespace {

// Switches of the machine that move nothing (D-93): clocks, single block and feed hold, counters.
bool is_machine_switch(std::int64_t variable) {
  return (variable >= 3001 && variable <= 3004) || variable == 3901 || variable == 3902;
}

}  // namespace

bool FanucFlow::assign(std::string& flat, std::size_t at) {
  ExpressionReader expression = expression_at(at);
  const std::int64_t number = number_of_variable(expression);
  expression.pass_blanks();
  if (!expression.failed() && expression.peek() != '=')
    return refuse(Code::expression_invalid, at, "# without =");
  expression.go_to(expression.at() + (expression.failed() ? 0 : 1));
  const std::size_t value_begin = behind_blanks(line_, expression.at());
  kept_text_.begin(is_kept(number) ? "#" + std::to_string(number) : "");
  const Value value = expression.expression();
  kept_text_.end();
  if (expression.failed()) return refuse(expression.fault());
  const std::size_t behind = expression.at();
  if (!is_over(line_, behind)) {
    const std::size_t place = behind_blanks(line_, behind);
    return refuse(Code::expression_invalid, place,
                  line_[place] == '#' ? "#, a second assignment: one in a block"
                                      : name_of_character(line_.substr(place)));
  }
  if (!value.vacant && is_machine_switch(number)) {
    std::string text = "#" + std::to_string(number) + "=";
    append_value(text, value.number, PointStyle::as_whole);
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? text : text + " " + comments);
    return true;
  }
  constexpr std::int64_t stop = 3006;
  if (number == stop) {
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? "M00" : "M00 " + comments);
    return true;
  }
  if (const std::string data = data_setting(number, value); !data.empty()) {
    common_[number] = value.number;
    const std::string comments = comments_of(line_, behind);
    write_behind_number(flat, comments.empty() ? data : data + " " + comments);
    return true;
  }
  if (!set(number, value, at)) return false;
  if (!kept_text_.stays()) return finish_statement(flat, behind);
  // The control computes the value anew in each run.
  std::string text = "#" + std::to_string(number) + "=";
  text += without_blanks_behind(kept_text_.text(line_, value_begin, behind));
  const std::string comments = comments_of(line_, behind);
  write_behind_number(flat, comments.empty() ? text : text + " " + comments);
  unwritten_.erase(number);
  return true;
}

// Sets a zero point or the radius of a tool with the G10 that the reader follows; under G91 G10
// would add instead. The registers of #2001 to #2800 and #10001 depend on the memory of the
// control. Empty: the variable sets no such data.
std::string FanucFlow::data_setting(std::int64_t number, const Value& value) const {
  constexpr std::int64_t in_row = 20;  // axes of one zero point
  constexpr std::string_view axes = "XYZ";
  const auto index_in = [&](std::int64_t first, std::int64_t last) {
    return number >= first && number <= last ? number - first : -1;
  };
  const std::int64_t standard = index_in(5201, 5328);
  const std::int64_t further = index_in(7001, 7948);
  const std::int64_t wear = index_in(12001, 12999);
  const std::int64_t radius = index_in(13001, 13999);
  std::string text;
  if (value.vacant || modes_.incremental) return text;
  const std::int64_t zero_point = std::max(standard, further);
  if (zero_point >= 0) {
    const auto axis = static_cast<std::size_t>(zero_point % in_row);
    if (axis >= axes.size()) return text;
    text = standard >= 0 ? "G10 L2 P" + std::to_string(standard / in_row)
                         : "G10 L20 P" + std::to_string(further / in_row + 1);
    text.append(" ").append(1, axes[axis]);
  } else if (radius >= 0 || wear >= 0) {
    text = radius >= 0 ? "G10 L12 P" + std::to_string(radius + 1) + " R"
                       : "G10 L13 P" + std::to_string(wear + 1) + " R";
  }
  if (!text.empty()) append_value(text, value.number, PointStyle::with_point);
  return text;
}

bool FanucFlow::set(std::int64_t number, const Value& value, std::size_t begin) {
  const std::optional<double> content =
      value.vacant ? std::optional<double>() : std::optional<double>(value.number);
  constexpr std::int64_t alarm = 3000;
  const auto locals = static_cast<std::int64_t>(locals_.back().size());
  if (number > 0 && number < locals) {
    Locals& own = locals_.back();
    own[static_cast<std::size_t>(number)] = content;
    own.of_machine.erase(static_cast<std::size_t>(number));
    if (kept_text_.hangs_on_machine()) own.of_machine.insert(static_cast<std::size_t>(number));
  } else if (number >= 100 && number < 1000) {
    common_[number] = content;
    unwritten_.insert(number);
    note_counter("#" + std::to_string(number));
    if (kept_text_.hangs_by_the_way() && is_kept(number))
      warn_of_given(begin, "#" + std::to_string(number));
  } else if (number == alarm) {
    return refuse(Code::program_alarm, begin,
                  std::string(without_blanks_behind(line_.substr(begin))));
  } else {
    const std::string told = told_variable(number);
    if (number < 1000) return refuse(Code::value_invalid, begin, told);
    const bool has_own_reason = told.find(',') != std::string::npos;
    return refuse(Code::machine_state, begin,
                  has_own_reason ? told : std::string(told).append(reason::set_by_program));
  }
  return true;
}

void FanucFlow::write_value(std::string& flat, std::int64_t number,
                            const std::optional<double>& content) {
  flat.append("#").append(std::to_string(number)).append("=");
  if (content)
    append_value(flat, *content, PointStyle::with_point);
  else
    flat.append("#0");
  flat.append(line_end());
  is_as_written_ = false;
}

// D-95
void FanucFlow::write_values(std::string& flat, Called called) {
  if (called == Called::subprogram) {
    const Locals& locals = locals_.back();
    for (std::size_t number = 1; number < locals.size(); ++number)
      if (locals[number]) write_value(flat, static_cast<std::int64_t>(number), locals[number]);
  }
  for (const std::int64_t number : unwritten_) write_value(flat, number, common_.at(number));
  unwritten_.clear();
}

// At the end of the program (D-89).
void FanucFlow::write_lasting_values(std::string& flat) {
  for (const std::int64_t number : unwritten_)
    if (is_kept(number)) write_value(flat, number, common_.at(number));
  unwritten_.clear();
}

std::int64_t FanucFlow::number_of_variable(ExpressionReader& expression) {
  expression.go_to(expression.at() + 1);
  return expression.whole_operand();
}

// #4001 …: the functions of their groups, and the words, that are in force.
FanucFlow::Followed FanucFlow::followed(std::int64_t number) const {
  const auto mode = [](double value) {
    return Followed{.is_followed = true, .is_changed = true, .value = value};
  };
  const auto word = [this](char letter) {
    // A word beside it in the same block may be in force already.
    const bool is_clear = !says_plainly(line_, letter);
    return Followed{.is_followed = true,
                    .is_changed = said_.says(letter) || !is_clear,
                    .value = is_clear ? said_.value_of(letter) : std::nullopt};
  };
  switch (number) {
    case 4001:
      return mode(static_cast<double>(modes_.motion));
    case 4002:
      return mode(modes_.plane == Plane::xy ? 17 : modes_.plane == Plane::zx ? 18 : 19);
    case 4003:
      return mode(modes_.incremental ? 91 : 90);
    case 4006:
      return mode(modes_.unit == LengthUnit::inch ? 20 : 21);
    case 4107:
      return word('D');
    case 4109:
      return word('F');
    case 4111:
      return word('H');
    case 4113:
      return word('M');
    case 4119:
      return word('S');
    case 4120:
      return word('T');
    default:
      return followed_place(number);
  }
}

// #5001 …: the end of the previous block; #5041 …: the tool position, including the tool length,
// which only the control knows.
FanucFlow::Followed FanucFlow::followed_place(std::int64_t number) const {
  constexpr std::int64_t end_of_block = 5001;
  constexpr std::int64_t standing = 5041;
  constexpr std::int64_t axes = 3;
  const auto axis_from = [&](std::int64_t first) {
    return number >= first && number < first + axes ? number - first : -1;
  };
  const std::int64_t index = std::max(axis_from(end_of_block), axis_from(standing));
  if (index < 0) return {};
  const auto axis = static_cast<std::size_t>(index);
  const bool has_length = axis_from(standing) >= 0 && axis == 2 && said_.has_length();
  Followed found{.is_followed = true, .is_changed = said_.moves()};
  if (said_.is_placed(axis) && !has_length && !modes_.contour_open)
    found.value = modes_.place.at(axis);
  return found;
}

Value FanucFlow::value_followed(ExpressionReader& expression, std::int64_t number,
                                std::size_t begin, const Followed& state) {
  const double* const value = given(std::to_string(number));
  if (state.is_changed && (value != nullptr || !state.value))
    return without_value(expression, Code::machine_state, begin,
                         told_variable(number).append(reason::changed_by_program));
  if (state.value) return {.number = *state.value};
  if (value == nullptr)
    return without_value(expression, Code::machine_state, begin, told_variable(number));
  kept_text_.hang_by_the_way();
  return {.number = *value};
}

// While lines are only checked, a vacant variable might have been assigned a value.
Value FanucFlow::content_or_vacant(const std::optional<double>& content) const {
  if (looks_ahead() && !content) return {.number = 1};
  return {.number = content.value_or(0), .vacant = !content};
}

Value FanucFlow::lost(ExpressionReader& expression, std::int64_t number, std::size_t begin) {
  return without_value(expression, Code::variable_unset, begin,
                       "#" + std::to_string(number) + ", which may have been set by " + lost_to_);
}

Value FanucFlow::read(ExpressionReader& expression) {
  suppose();
  const std::size_t begin = expression.at();
  const std::int64_t number = kept_text_.read_aside([&] { return number_of_variable(expression); });
  if (expression.failed() || number == 0) return {.vacant = true};
  Value value = value_of(expression, number, begin);
  std::string text;
  if (value.vacant)
    text = "#0";
  else
    append_value(text, value.number, PointStyle::with_point);
  kept_text_.take(begin, expression.at(), text.front() == '-' ? "[" + text + "]" : text);
  return value;
}

Value FanucFlow::value_of(ExpressionReader& expression, std::int64_t number, std::size_t begin) {
  const Locals& own = locals_.back();
  if (number < static_cast<std::int64_t>(own.size())) {
    const auto index = static_cast<std::size_t>(number);
    if (own.are_lost && !own[index]) return lost(expression, number, begin);
    if (own.of_machine.contains(index)) kept_text_.hang_by_the_way();
    return content_or_vacant(own[index]);
  }
  const std::string name = "#" + std::to_string(number);
  const auto known = common_.find(number);
  const bool* const counted = counter(name);
  if (known != common_.end() && (counted == nullptr || *counted)) {
    if (counted != nullptr) kept_text_.keep(name);
    return content_or_vacant(known->second);
  }
  if (const Followed state = followed(number); state.is_followed)
    return value_followed(expression, number, begin, state);
  const double* const value = known == common_.end() ? given(name.substr(1)) : nullptr;
  if (value != nullptr) {
    is_kept(number) ? kept_text_.keep(name) : kept_text_.hang_by_the_way();
    return {.number = *value};
  }
  const bool is_lost = number < 1000 && !lost_to_.empty();
  if (number >= 100 && number < 1000 && !is_kept(number) && !is_lost) return content_or_vacant({});
  if (is_kept(number) && kept_text_.may_be_unknown(name)) {
    kept_text_.keep_unknown(name);
    return {.number = 1};
  }
  if (counted != nullptr) return without_value(expression, Code::variable_unset, begin, name);
  if (is_lost) return lost(expression, number, begin);
  const Code code = number >= 1000    ? Code::machine_state
                    : is_kept(number) ? Code::variable_unset
                                      : Code::value_invalid;
  return without_value(expression, code, begin, told_variable(number));
}

std::string FanucFlow::told_variable(std::int64_t number) {
  const bool is_of_both = number >= 10'000 && number < 11'000;
  return std::string("#")
      .append(std::to_string(number))
      .append(is_of_both ? reason::variable_of_haas : std::string_view());
}

bool FanucFlow::exists(ExpressionReader& /*expression*/) { return false; }

}  // namespace trc::program
