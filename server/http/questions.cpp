#include "server/http/questions.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/http/problem.h"
#include "server/text.h"

namespace trc::server::http {
namespace {

template <class Number>
bool is_number(std::string_view text, Number& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size();
}

// The fault of a value; empty: none.
std::string fault_of(const Question& question, std::string_view value) {
  std::uint64_t count = 0;
  if (question.kind == Question::Kind::number && !is_number(value, count))
    return "takes a whole number";
  double share = 0;
  if (question.kind == Question::Kind::share &&
      !(is_number(value, share) && share >= 0 && share <= 1))
    return "takes a number from 0 to 1";
  return {};
}

std::string names_of(std::span<const Question> questions) {
  std::string names;
  for (const Question& question : questions)
    names.append(names.empty() ? "" : ", ").append(question.name);
  return names;
}

std::string fault_of(const Route& route, const std::string& name, std::string_view value) {
  const auto question = std::ranges::find(route.questions, name, &Question::name);
  if (question != route.questions.end()) return fault_of(*question, value);
  if (route.takes_settings) return {};
  return route.questions.empty() ? "is not known: there are no parameters here"
                                 : "is not known: there are " + names_of(route.questions);
}

}  // namespace

std::optional<v1::Problem> refuse_query(const Route& route, const Pairs& query) {
  v1::Problem refused = problem(400, "QUERY_INVALID", "A query parameter cannot be taken", {});
  // More than there are settings. The code below compares every parameter with every other.
  constexpr std::size_t most_parameters = 256;
  if (query.size() > most_parameters) {
    refused.set_detail("there are " + std::to_string(query.size()) + " parameters, at most " +
                       std::to_string(most_parameters) + " are taken");
    return refused;
  }
  for (auto one = query.begin(); one != query.end() && refused.fields_size() < most_fields; ++one) {
    const auto& [name, value] = *one;
    const bool is_repeated =
        std::ranges::find(query.begin(), one, name, &Pairs::value_type::first) != one;
    const std::string fault =
        is_repeated ? "is given more than once" : fault_of(route, name, value);
    if (fault.empty()) continue;
    v1::FieldProblem& field = *refused.add_fields();
    field.set_field(presentable(name));
    field.set_description(fault);
  }
  if (refused.fields().empty()) return std::nullopt;
  refused.set_detail(refused.fields(0).field() + " " + refused.fields(0).description());
  return refused;
}

}  // namespace trc::server::http
