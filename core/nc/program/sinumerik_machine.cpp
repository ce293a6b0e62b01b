#include <algorithm>
#include <array>
#include <utility>

#include "core/nc/dialect/sinumerik_names.h"
#include "core/nc/program/gcode_line.h"
#include "core/nc/program/sinumerik_flow.h"
#include "core/nc/text/characters.h"

// Variables of the program that calls of the machine may read and set: R parameters (D-95), and
// variables given to them by name (D-83).

namespace trc::program {
namespace {

// Calls of the control that set variables, with the positions of these among the arguments.
struct SettingCall {
  std::string_view name;
  std::array<std::size_t, 2> places;
};
constexpr auto setting_calls = std::to_array<SettingCall>({{"DELETE", {0, 0}},
                                                           {"EXTCLOSE", {0, 0}},
                                                           {"EXTOPEN", {0, 0}},
                                                           {"FILEDATE", {0, 2}},
                                                           {"FILEINFO", {0, 2}},
                                                           {"FILESIZE", {0, 2}},
                                                           {"FILESTAT", {0, 2}},
                                                           {"FILETIME", {0, 2}},
                                                           {"GETEXET", {0, 0}},
                                                           {"GETSELT", {0, 0}},
                                                           {"READ", {0, 4}},
                                                           {"RESETMON", {0, 0}},
                                                           {"SETTA", {0, 0}},
                                                           {"SETTIA", {0, 0}},
                                                           {"WRITE", {0, 0}}});

// Splits the text between the bracket at `open` and its closing bracket at the commas.
std::vector<std::string_view> arguments_of(std::string_view line, std::size_t open) {
  std::vector<std::string_view> arguments;
  const std::size_t close = behind_bracket(line, open);
  std::size_t begin = open + 1;
  bool quoted = false;
  int depth = 0;
  for (std::size_t at = begin; at < close; ++at) {
    const char sign = line[at];
    if (sign == '"') quoted = !quoted;
    if (quoted) continue;
    if ((sign == ',' && depth == 0) || at + 1 == close) {
      arguments.push_back(
          without_blanks_behind(without_blanks_in_front(line.substr(begin, at - begin))));
      begin = at + 1;
    }
    if (sign == '(' || sign == '[') ++depth;
    if (sign == ')' || sign == ']') --depth;
  }
  return arguments;
}

// Whether NAME(…) at `at` may be a call: not a function of an expression, X=AC(…) and the like.
bool may_be_call(std::string_view line, std::size_t at, std::string_view name) {
  const std::string_view before = without_blanks_behind(line.substr(0, at));
  const bool is_value = !before.empty() && std::string_view("=+-*/<>:(,[").find(before.back()) !=
                                               std::string_view::npos;
  const Grammar& grammar = sinumerik_grammar();
  const auto is_name = [name](const auto& row) { return row.spelling == name; };
  return !is_value && std::ranges::none_of(grammar.functions, is_name) &&
         std::ranges::none_of(grammar.operators, is_name);
}

}  // namespace

SinumerikFlow::Passing SinumerikFlow::passing_to(std::string_view call, std::size_t place) const {
  const auto setting = std::ranges::find(setting_calls, call, &SettingCall::name);
  if (setting != setting_calls.end())
    return std::ranges::find(setting->places, place) != setting->places.end()
               ? Passing::by_reference
               : Passing::by_value;
  if (const auto external = externals_.find(call); external != externals_.end())
    return external->second.contains(place) ? Passing::by_reference : Passing::by_value;
  const bool is_of_control = is_sinumerik_name(call) || is_sinumerik_call(call);
  return call.empty() || is_of_control ? Passing::by_value : Passing::unknown;
}

// EXTERN NAME(REAL, VAR INT)
void SinumerikFlow::know_external(std::string_view line, std::size_t at) {
  at = behind_blanks(line, at);
  const std::string name = name_at(line, at);
  const std::size_t open = behind_blanks(line, at + name.size());
  std::set<std::size_t>& by_reference = externals_[name];
  if (sign_at(line, open) != '(') return;
  const std::vector<std::string_view> types = arguments_of(line, open);
  for (std::size_t place = 0; place < types.size(); ++place)
    if (has_word_at(types[place], 0, "VAR")) by_reference.insert(place);
}

// The variables of the main program that calls in the output receive: their DEF stays too.
void SinumerikFlow::find_what_calls_are_given(const Unit& main) {
  for (const ProgramText& text : texts_)
    for (std::size_t line = 0; line < text.size(); ++line) {
      checkpoint_.pass();
      const std::size_t at = named_head_of(text.line(line)).behind;
      if (name_at(text.line(line), at) == "EXTERN") know_external(text.line(line), at + 6);
    }
  for (std::size_t number = main.begin; number < main.end; ++number) {
    checkpoint_.pass();
    const std::string_view line = texts_[main.text].line(number);
    std::size_t at = named_head_of(line).behind;
    if (name_at(line, at) == "EXTERN") continue;
    for (bool quoted = false; at < line.size() && (quoted || line[at] != ';'); ++at) {
      if (line[at] == '"') quoted = !quoted;
      const std::string name = quoted ? std::string() : name_at(line, at);
      if (name.empty()) continue;
      const std::size_t begin = std::exchange(at, at + name.size() - 1);
      const std::size_t open = behind_blanks(line, at + 1);
      if (sign_at(line, open) != '(' || unit_named(name) != nullptr ||
          !may_be_call(line, begin, name))
        continue;
      const std::vector<std::string_view> given = arguments_of(line, open);
      for (std::size_t place = 0; place < given.size(); ++place)
        if (name_at(given[place], 0).size() == given[place].size() &&
            passing_to(name, place) != Passing::by_value)
          kept_.insert(in_upper_case(given[place]));
    }
  }
}

// Whether the machine has the variable too.
bool SinumerikFlow::is_kept(std::string_view name) const {
  return is_variable_name(name) ||
         (scopes_.size() == 1 && kept_.contains(name) && scopes_.back().contains(name));
}

void SinumerikFlow::note_setting(const Place& place) {
  if (place.parameter >= 0)
    unwritten_.insert(place.parameter);
  else if (place.scope == 0 && kept_.contains(place.name))
    unwritten_elements_.insert({place.name, place.element});
}

void SinumerikFlow::write_setting(std::string_view name, const Value& value) {
  settings_.append(name).append("=").append(text_of_value(value)).append(line_end());
}

void SinumerikFlow::write_element(const std::string& name, std::size_t element) {
  const auto known = scopes_.front().find(name);
  if (known == scopes_.front().end() || known->second.is_lost) return;
  const Variable& variable = known->second;
  std::string indices;
  std::size_t left = element;
  for (auto size = variable.sizes.rbegin(); size != variable.sizes.rend(); ++size) {
    indices.insert(0,
                   (size + 1 == variable.sizes.rend() ? "" : ",") + std::to_string(left % *size));
    left /= *size;
  }
  write_setting(indices.empty() ? name : name + "[" + indices + "]", variable.elements[element]);
}

// Writes the values set since the last time, for a call that may read them.
void SinumerikFlow::write_values() {
  const bool writes_all = reads_variables_ || modal_call_reads_;
  const auto is_given = [&](const std::string& name) {
    return std::ranges::find(given_to_calls_, name) != given_to_calls_.end();
  };
  if (!writes_all && given_to_calls_.empty()) return;
  std::erase_if(unwritten_, [&](std::int64_t number) {
    const std::string name = "R" + std::to_string(number);
    if (!writes_all && !is_given(name)) return false;
    if (const auto known = parameters_.find(number); known != parameters_.end())
      write_setting(name, {.number = known->second});
    return true;
  });
  std::erase_if(unwritten_elements_, [&](const auto& each) {
    if (!is_given(each.first)) return false;
    write_element(each.first, each.second);
    return true;
  });
}

// Loses R parameters, and the variables that the calls received by name. Under MCALL a call follows
// each motion.
void SinumerikFlow::lose_values() {
  const auto moves = [this](const Piece& piece) {
    const char letter = piece.is_comment ? ' ' : upper(line_[piece.begin]);
    return letter >= 'X' && letter <= 'Z' && (!piece.instead || !piece.instead->empty());
  };
  if (modal_call_reads_ && std::ranges::any_of(pieces_, moves)) calls_of_line_.push_back("MCALL");
  for (const std::string& name : given_to_calls_) {
    if (setup_.pass_words.contains(called_)) continue;
    lost_to_ = called_;
    if (Variable* const variable = declared(name)) {
      variable->is_lost = true;
      continue;
    }
    const std::int64_t number = number_of_parameter(name);
    parameters_.erase(number);
    counters_.erase("R" + std::to_string(number));
  }
  if (calls_of_line_.empty()) return;
  lost_to_ = calls_of_line_.back();
  parameters_.clear();
  counters_.clear();
}

}  // namespace trc::program
