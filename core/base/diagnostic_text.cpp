#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/diagnostic.h"

namespace trc {
namespace {

enum class Measure { length, angle, share, feed, count };

struct ValueWords {
  std::string_view name;
  std::string_view words;
  Measure measure = Measure::length;
};

// Names that are no words as they stand, or no lengths. All others are lengths by their names.
constexpr auto words_of_values = std::to_array<ValueWords>({
    {"angle", "angle", Measure::angle},
    {"blocks", "blocks", Measure::count},
    {"bytes", "bytes", Measure::count},
    {"compensated_length", "compensated length"},
    {"contour_radius", "radius of the contour"},
    {"corrected_sweep", "sweep of its path", Measure::angle},
    {"decimals", "decimals", Measure::count},
    {"feed", "feed", Measure::feed},
    {"largest_sweep", "largest sweep", Measure::angle},
    {"left_out_length", "length left out"},
    {"limit", "limit", Measure::count},
    {"lines", "lines", Measure::count},
    {"longest_line", "longest line in characters", Measure::count},
    {"look_ahead_blocks", "blocks of the window", Measure::count},
    {"max_masked_share", "largest share", Measure::share},
    {"path_radius", "radius of the path"},
    {"selection_block", "selection block N", Measure::count},
    {"turn", "turn", Measure::angle},
    {"value", "value", Measure::count},
    {"wall_length", "length of all walls"},
});

static_assert(std::ranges::is_sorted(words_of_values, {}, &ValueWords::name));

Measure measure_of(std::string_view name) {
  const auto row = std::ranges::lower_bound(words_of_values, name, {}, &ValueWords::name);
  return row != words_of_values.end() && row->name == name ? row->measure : Measure::length;
}

std::string words_of(std::string_view name) {
  const auto row = std::ranges::lower_bound(words_of_values, name, {}, &ValueWords::name);
  if (row != words_of_values.end() && row->name == name) return std::string(row->words);
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string written(double value, std::chars_format format, int precision) {
  std::array<char, 400> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, format, precision);
  return {digits.data(), end.ptr};
}

// Three decimals, or the digits of one that would be 0 by them.
std::string length_text(double value, int decimals) {
  if (value != 0 && std::abs(value) < 0.0005) return written(value, std::chars_format::general, 3);
  if (std::abs(value) >= 1e9) return written(value, std::chars_format::general, 9);
  return written(value, std::chars_format::fixed, decimals);
}

// How many decimals of a length tell all of these from each other.
int decimals_for(std::span<const DiagnosticValue> values) {
  constexpr int least = 3;
  constexpr int most = 9;
  const auto look_the_same = [&](int decimals) {
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t k = i + 1; k < values.size(); ++k)
        if (values[i].value != values[k].value && measure_of(values[i].name) == Measure::length &&
            measure_of(values[k].name) == Measure::length &&
            length_text(values[i].value, decimals) == length_text(values[k].value, decimals))
          return true;
    return false;
  };
  int decimals = least;
  while (decimals < most && look_the_same(decimals)) ++decimals;
  return decimals;
}

void append_value(std::string& text, const DiagnosticValue& value, int decimals) {
  text += words_of(value.name) + " ";
  switch (measure_of(value.name)) {
    case Measure::length:
      text += length_text(value.value, decimals) + " mm";
      break;
    case Measure::angle:
      text += written(value.value, std::chars_format::fixed, 3) + " degrees";
      break;
    case Measure::share:
      text += written(100 * value.value, std::chars_format::general, 9) + " %";
      break;
    case Measure::feed:
      text += written(value.value, std::chars_format::general, 9) + " mm/min";
      break;
    case Measure::count:
      text += written(value.value, std::chars_format::general, 9);
      break;
  }
}

// Takes the values of one append_place() from the front.
void append_named_block(std::string& text, std::span<const DiagnosticValue>& values) {
  const std::string_view index = values.front().name;
  const std::string name(index.substr(0, index.rfind('_')));
  Source source{.index = static_cast<std::uint64_t>(values.front().value)};
  values = values.subspan(1);
  if (!values.empty() && values.front().name == name + "_line") {
    source.line = static_cast<std::uint32_t>(values.front().value);
    values = values.subspan(1);
  }
  if (!values.empty() && values.front().name == name + "_number") {
    source.number = static_cast<std::int64_t>(values.front().value);
    values = values.subspan(1);
  }
  text.append(name).append(" block ").append(
      std::string_view(place_of(source)).substr(std::string_view("in ").size()));
}

}  // namespace

std::string place_of(const Source& source) {
  std::string place = source.line > 0 ? "in line " + std::to_string(source.line)
                                      : "in block " + std::to_string(source.index);
  if (source.number != Source::no_number) place += " (N" + std::to_string(source.number) + ")";
  return place;
}

void append_place(std::vector<DiagnosticValue>& values, const std::string& name,
                  const Source& source) {
  values.push_back({name + "_index", static_cast<double>(source.index)});
  if (source.line > 0) values.push_back({name + "_line", static_cast<double>(source.line)});
  if (source.number != Source::no_number)
    values.push_back({name + "_number", static_cast<double>(source.number)});
}

std::string message_of(const Diagnostic& diagnostic) {
  std::string text(row_of(diagnostic.code).cause);
  if (!diagnostic.detail.empty()) text.append(": ").append(diagnostic.detail);
  const char* separator = " (";
  std::span<const DiagnosticValue> values(diagnostic.values);
  const int decimals = decimals_for(values);
  while (!values.empty()) {
    text.append(separator);
    if (values.front().name.ends_with("_index")) {
      append_named_block(text, values);
    } else {
      append_value(text, values.front(), decimals);
      values = values.subspan(1);
    }
    separator = ", ";
  }
  if (!diagnostic.values.empty()) text.append(")");
  return text;
}

}  // namespace trc
