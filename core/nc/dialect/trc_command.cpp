#include "core/nc/dialect/trc_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/number_text.h"
#include "core/nc/text/characters.h"
#include "core/nc/text/expression.h"

namespace trc {
namespace {

constexpr auto keywords = std::to_array<TrcKeyword>({
    {"CONV_CIR_TO_LIN", 0, 1, 0, true, "arcs too small for the tool become lines (with G141)"},
    {"KERF_MASKING", 0, 1, 0, true, "points in kerfs the tool cannot enter are moved"},
    {"REVERSE", 0, 1, 0, true, "the side changes at points of reversal without a block"},
    {"IGNORE_CONT_DAMAGE", 0, 1, 0, true, "contour violations do not stop"},
    {"REMOVE_MASKED_BLOCKS", 0, 1, 0, true, "contour loops are removed (with G141)"},
    {"EXT_ANGLE_BLOCK_INTERSECTION", 0, 1, 0, true, "nothing is inserted up to 181 degrees"},
    {"G236_LIN", 0, 1, 0, true, "G236 inserts a line in place of an arc, 90 to 180 degrees"},
    {"STRETCH_FACTOR", 1, 9, 1, true, "longest stretch of a block, in tool radii"},
    {"TANGENTIAL_LIMIT", 0.1, 3, 3, true, "turns up to this count as tangential", "degrees"},
    {"PERPENDICULAR_RADIUS_CHANGE", 0, 1, 0, true, "a new radius acts at once, across the contour"},
    {"GEN_CIR_BLOCK_IN_CORNER", 0, 1, 0, true, "inside corners get a circle of radius 0"},
    {"SUPPRESS_TRC", 0, 1, 0, true, "only KERF_MASKING acts, nothing is offset"},
    {"INVERSE", 0, 1, 0, true, "needs ONLINE, 22125 without it", "", false},
    {"ONLINE", 0, 3, 0, true, "compensation of a radius that changes while machining", "", false},
    {"ONLINE_BY_VECTOR", 0, 1, 0, true, "ONLINE for a wire that is inclined", "", false},
    {"SPLIT", 0, 0, 0, false, "splits selection and deselection by the travel of an axis"},
    {"SPLIT_PATH", 0, 0, 0, false, "splits selection and deselection by the length of the path"},
    {"SPLIT_OFF", 0, 0, 0, false, "no splitting"},
    {"PRE", 0, 0, 0, false, "SPLIT at selection (initial)"},
    {"POST", 0, 0, 0, false, "SPLIT at deselection"},
    {"COMBINED", 0, 0, 0, false, "SPLIT at both"},
    {"AX", 0, 0, 0, true, "SPLIT: the axis, X Y Z"},
    {"AXNR", 1, 3, 0, true, "SPLIT: the axis, 1 to 3 for X Y Z"},
    {"DIST_SEG1", 0, 1e6, 0, true, "SPLIT: length of the first segment", "mm"},
    {"FEED_SEG1", 0, 1e9, 0, true, "SPLIT: feed of the first segment", "mm/min"},
    {"DIST_SEG2", 0, 1e6, 0, true, "SPLIT: length of the second segment", "mm"},
    {"FEED_SEG2", 0, 1e9, 0, true, "SPLIT: feed of the second segment", "mm/min"},
});

struct Flag {
  std::string_view name;
  bool TrcOptions::*field;
};

constexpr auto flags = std::to_array<Flag>({
    {"CONV_CIR_TO_LIN", &TrcOptions::conv_cir_to_lin},
    {"KERF_MASKING", &TrcOptions::kerf_masking},
    {"REVERSE", &TrcOptions::reverse},
    {"IGNORE_CONT_DAMAGE", &TrcOptions::ignore_cont_damage},
    {"REMOVE_MASKED_BLOCKS", &TrcOptions::remove_masked_blocks},
    {"EXT_ANGLE_BLOCK_INTERSECTION", &TrcOptions::ext_angle_block_intersection},
    {"G236_LIN", &TrcOptions::g236_lin},
    {"PERPENDICULAR_RADIUS_CHANGE", &TrcOptions::perpendicular_radius_change},
    {"GEN_CIR_BLOCK_IN_CORNER", &TrcOptions::gen_cir_block_in_corner},
    {"SUPPRESS_TRC", &TrcOptions::suppress_trc},
    {"INVERSE", &TrcOptions::inverse},
});

std::string range_text(const TrcKeyword& keyword) {
  const bool either = keyword.smallest == 0 && keyword.largest == 1;
  return std::string(keyword.name) + ", " + shortest(keyword.smallest) +
         (either ? " or " : " to ") + shortest(keyword.largest);
}

// The least number of letters to insert, remove or replace.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::string with_suggestion(std::string_view name) {
  // A longer name is no misspelling.
  constexpr std::size_t longest_misspelling = 40;
  std::string text(name.substr(0, longest_misspelling));
  const auto edits = [&](const TrcKeyword& keyword) { return edits_between(text, keyword.name); };
  const auto nearest = std::ranges::min_element(keywords, {}, edits);
  if (edits(*nearest) <= nearest->name.size() / 3)
    return text + ", perhaps " + std::string(nearest->name);
  text += ", known are";
  for (const TrcKeyword& keyword : keywords) text.append(" ").append(keyword.name);
  return text;
}

// The SPLIT words of one command.
struct SplitWords {
  enum class By : std::uint8_t { none, axis, path, off };
  By by = By::none;
  bool any = false;
  std::optional<SplitOption::Where> where{};
  std::optional<std::uint8_t> axis{};
  SplitOption option{};
};

class CommandReader {
 public:
  explicit CommandReader(std::string_view text) : text_(text) {}

  [[nodiscard]] std::optional<TextFault> trc(TrcOptions& options);
  [[nodiscard]] std::optional<TextFault> tangfeed(double& radius);

 private:
  using Fault = std::optional<TextFault>;

  [[nodiscard]] TextFault fault(Code code, std::size_t at, std::string detail) const {
    return {.code = code, .begin = static_cast<std::uint32_t>(at), .detail = std::move(detail)};
  }
  [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[at_]; }
  void skip_separators();
  std::string identifier();
  [[nodiscard]] Fault value(std::string_view name, std::size_t begin, double& number);
  [[nodiscard]] Fault close(std::size_t open);
  [[nodiscard]] Fault key(TrcOptions& options);
  [[nodiscard]] Fault split_key(const TrcKeyword& keyword, std::size_t begin, double number);
  [[nodiscard]] Fault split_axis(std::size_t begin);
  [[nodiscard]] Fault finish_split(TrcOptions& options) const;

  std::string_view text_;
  std::size_t at_ = 0;
  SplitWords split_{};
  std::array<bool, keywords.size()> seen_{};
};

// Blanks, commas, and the `\` of continued lines.
void CommandReader::skip_separators() {
  while (!at_end()) {
    const bool separates = std::string_view(",\\\r\n").find(peek()) != std::string_view::npos;
    const std::size_t length = separates ? 1 : blank_at_start(text_.substr(at_));
    if (length == 0) return;
    at_ += length;
  }
}

std::string CommandReader::identifier() {
  std::string name;
  for (; is_letter(peek()) || is_digit(peek()) || peek() == '_'; ++at_) name += upper(peek());
  return name;
}

CommandReader::Fault CommandReader::value(std::string_view name, std::size_t begin,
                                          double& number) {
  skip_separators();
  const bool assigned = peek() == '=';
  if (assigned) ++at_;
  skip_separators();
  // A name without = is the next keyword.
  if (at_end() || peek() == ']' || (!assigned && is_letter(peek())))
    return fault(Code::trc_option_out_of_range, begin, std::string(name) + " without value");
  std::size_t length = 0;
  if (Fault wrong = read_expression(text_.substr(at_), number, length)) {
    wrong->begin += static_cast<std::uint32_t>(at_);
    wrong->detail.insert(0, std::string(name) + "=");
    return wrong;
  }
  at_ += length;
  return {};
}

// Nothing may follow the last bracket.
CommandReader::Fault CommandReader::close(std::size_t open) {
  if (peek() != ']') return fault(Code::nc_unclosed, open, "[");
  ++at_;
  skip_separators();
  if (!at_end()) return fault(Code::nc_syntax, at_, "a word after a # command");
  return {};
}

CommandReader::Fault CommandReader::trc(TrcOptions& options) {
  ++at_;  // #
  skip_separators();
  identifier();
  skip_separators();
  const std::size_t open = at_;
  if (peek() != '[') return fault(Code::nc_syntax, open, "#TRC without [");
  std::size_t depth = 0;
  for (;;) {
    skip_separators();
    if (peek() == '[') {
      ++depth;
      ++at_;
    } else if (peek() == ']' && depth > 1) {
      --depth;
      ++at_;
    } else if (is_letter(peek())) {
      if (Fault wrong = key(options)) return wrong;
    } else {
      break;
    }
  }
  const bool comment = peek() == '(' || peek() == ';';
  if (!at_end() && peek() != ']' && !comment)
    return fault(Code::nc_syntax, at_, std::string(text_.substr(at_, 1)));
  if (Fault wrong = close(open)) return wrong;
  return finish_split(options);
}

CommandReader::Fault CommandReader::key(TrcOptions& options) {
  const std::size_t begin = at_;
  const std::string name = identifier();
  // The longest keyword that the word begins with; its value may follow directly.
  const TrcKeyword* keyword = nullptr;
  for (const TrcKeyword& candidate : keywords) {
    if (!name.starts_with(candidate.name)) continue;
    const bool exact = name.size() == candidate.name.size();
    const bool with_value =
        candidate.takes_value && !exact && is_digit(name[candidate.name.size()]);
    if ((exact || with_value) &&
        (keyword == nullptr || candidate.name.size() > keyword->name.size()))
      keyword = &candidate;
  }
  if (keyword == nullptr) return fault(Code::trc_option_unknown, begin, with_suggestion(name));
  at_ = begin + keyword->name.size();
  bool& seen = seen_[static_cast<std::size_t>(keyword - keywords.data())];
  if (std::exchange(seen, true))
    return fault(Code::nc_word_twice, begin, std::string(keyword->name));
  if (keyword->name == "AX") return split_axis(begin);

  double number = 0;
  if (keyword->takes_value) {
    if (Fault wrong = value(keyword->name, begin, number)) return wrong;
    if (keyword->name == "STRETCH_FACTOR") {
      options.stretch_factor = number;
      return {};
    }
    const bool switched = keyword->smallest == 0 && keyword->largest == 1;
    const bool in_range = number >= keyword->smallest && number <= keyword->largest &&
                          (!switched || number == 0 || number == 1);
    if (!in_range) return fault(Code::trc_option_out_of_range, begin, range_text(*keyword));
    if (keyword->name.starts_with("ONLINE")) {
      if (number == 0) return {};
      return fault(Code::not_available, begin, std::string(keyword->name));
    }
    if (keyword->name == "TANGENTIAL_LIMIT") {
      options.tangential_limit = number;
      return {};
    }
    const auto flag = std::ranges::find(flags, keyword->name, &Flag::name);
    if (flag != flags.end()) {
      options.*flag->field = number != 0;
      return {};
    }
  }
  return split_key(*keyword, begin, number);
}

CommandReader::Fault CommandReader::split_axis(std::size_t begin) {
  skip_separators();
  if (peek() == '=') ++at_;
  skip_separators();
  const std::string axis = identifier();
  if (axis != "X" && axis != "Y" && axis != "Z")
    return fault(Code::nc_axis_unknown, begin,
                 std::string("AX=").append(axis).append(", X, Y or Z"));
  split_.any = true;
  split_.axis = static_cast<std::uint8_t>(axis[0] - 'X');
  return {};
}

CommandReader::Fault CommandReader::split_key(const TrcKeyword& keyword, std::size_t begin,
                                              double number) {
  using enum SplitOption::Where;
  split_.any = true;
  const std::string_view name = keyword.name;
  if (name == "PRE" || name == "POST" || name == "COMBINED") {
    if (split_.where) return fault(Code::nc_group_twice, begin, std::string(name));
    split_.where = name == "PRE" ? pre : name == "POST" ? post : combined;
  } else if (name.starts_with("SPLIT")) {
    if (split_.by != SplitWords::By::none)
      return fault(Code::nc_group_twice, begin, std::string(name));
    split_.by = name == "SPLIT"        ? SplitWords::By::axis
                : name == "SPLIT_PATH" ? SplitWords::By::path
                                       : SplitWords::By::off;
  } else if (name == "AXNR") {
    if (number != std::floor(number))
      return fault(Code::trc_option_out_of_range, begin, range_text(keyword));
    if (split_.axis) return fault(Code::nc_group_twice, begin, "AXNR");
    split_.axis = static_cast<std::uint8_t>(number - 1);
  } else if (name == "DIST_SEG1") {
    split_.option.distance_1 = number;
  } else if (name == "FEED_SEG1") {
    split_.option.feed_1 = number;
  } else if (name == "DIST_SEG2") {
    split_.option.distance_2 = number;
  } else {
    split_.option.feed_2 = number;
  }
  return {};
}

CommandReader::Fault CommandReader::finish_split(TrcOptions& options) const {
  using enum SplitWords::By;
  if (!split_.any) return {};
  if (split_.by == off) {
    options.split = {};
    return {};
  }
  if (split_.by == none)
    return fault(Code::trc_option_out_of_range, 0, "SPLIT or SPLIT_PATH is missing");
  if ((split_.by == axis) != split_.axis.has_value())
    return fault(Code::trc_option_out_of_range, 0,
                 split_.by == axis ? "SPLIT without AX or AXNR" : "SPLIT_PATH with AX or AXNR");
  options.split = split_.option;
  options.split.along_path = split_.by == path;
  options.split.axis = split_.axis.value_or(0);
  options.split.where = split_.where.value_or(SplitOption::Where::pre);
  return {};
}

CommandReader::Fault CommandReader::tangfeed(double& radius) {
  ++at_;  // #
  skip_separators();
  const bool old_form = identifier() == "SET";
  skip_separators();
  if (old_form) {
    identifier();  // TANGFEED
    skip_separators();
    if (identifier() != "RMIN") return fault(Code::nc_syntax, 0, "#SET TANGFEED without RMIN");
    skip_separators();
  }
  const std::size_t open = at_;
  radius = 0;
  if (peek() != '[') return fault(Code::nc_syntax, open, "#TANGFEED without [");
  ++at_;
  skip_separators();
  const std::size_t begin = at_;
  if (!old_form && peek() != ']') {
    const std::string name = identifier();
    if (!name.starts_with("RMIN")) return fault(Code::nc_syntax, begin, "#TANGFEED, RMIN only");
    at_ = begin + std::string_view("RMIN").size();
    if (Fault wrong = value("RMIN", begin, radius)) return wrong;
  } else if (old_form) {
    if (Fault wrong = value("RMIN", begin, radius)) return wrong;
  }
  skip_separators();
  return close(open);
}

}  // namespace

std::span<const TrcKeyword> trc_keywords() { return keywords; }

std::optional<TextFault> read_trc_command(std::string_view command, TrcOptions& options) {
  return CommandReader(command).trc(options);
}

std::optional<TextFault> read_tangfeed_command(std::string_view command, double& radius) {
  return CommandReader(command).tangfeed(radius);
}

}  // namespace trc
