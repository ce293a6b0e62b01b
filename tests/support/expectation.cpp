#include "tests/support/expectation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "core/nc/dialect/dialect.h"
#include "tests/support/run.h"

namespace trc::support {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double tolerance = 1e-4;  // mm or degrees

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The words of one line, taken one after the other.
class Words {
 public:
  explicit Words(const std::string& line) : line_(line), words_(words_of(line)) {}

  [[nodiscard]] bool more() const { return next_ < words_.size(); }
  [[nodiscard]] const std::string& peek() const { return words_.at(next_); }

  std::string word() {
    if (!more()) throw std::runtime_error("too short: " + line_);
    return words_[next_++];
  }
  void keyword(const std::string& expected) {
    if (word() != expected) throw std::runtime_error("no `" + expected + "` in: " + line_);
  }
  double number() {
    std::size_t used = 0;
    const std::string text = word();
    const double value = std::stod(text, &used);
    if (used != text.size()) throw std::runtime_error("no number: " + line_);
    return value;
  }
  Point point() {
    const double x = number();
    return {x, number()};
  }
  template <class Number>
  std::optional<Number> number_or_any() {
    const std::string text = word();
    if (text == "*") return std::nullopt;
    return static_cast<Number>(std::stoll(text));
  }

 private:
  std::string line_;
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

ExpectedBlock read_block(const std::string& line) {
  Words words(line);
  ExpectedBlock block;
  block.text = line;
  block.number = words.number_or_any<std::int64_t>();
  block.origin = words.word();
  if (block.origin == "passthrough") {
    while (words.more()) block.passthrough += (block.passthrough.empty() ? "" : " ") + words.word();
    return block;
  }
  block.is_arc = words.peek() == "arc";
  words.keyword(block.is_arc ? "arc" : "line");
  block.start = words.point();
  words.keyword("->");
  block.end = words.point();
  if (block.is_arc) {
    words.keyword("center");
    block.center = words.point();
    words.keyword("sweep");
    block.sweep = words.number();
  }
  while (words.more()) {
    const std::string word = words.word();
    if (word == "third") {
      block.third.from = words.number();
      block.third.to = words.number();
    } else if (word.front() == 'F') {
      block.feed = std::stod(word.substr(1));
    } else {
      throw std::runtime_error("unknown `" + word + "` in: " + line);
    }
  }
  return block;
}

bool near(const Point& a, const Point& b) { return (a - b).norm() <= tolerance; }

std::string fault_of(const CompensatedBlock& actual, const ExpectedBlock& expected) {
  if (expected.number && *expected.number != actual.source.number) return "N number";
  if (expected.origin != "*" && expected.origin != name_of(actual.origin)) return "origin";
  if (actual.origin == Origin::passthrough)
    return expected.passthrough == actual.text ? "" : "text";
  const Point& start =
      std::visit([](const auto& s) -> const Point& { return s.start; }, actual.path);
  const Point& end = std::visit([](const auto& s) -> const Point& { return s.end; }, actual.path);
  if (is_arc(actual.path) != expected.is_arc) return "shape";
  if (!near(start, expected.start)) return "start";
  if (!near(end, expected.end)) return "end";
  if (const auto* arc = std::get_if<Arc>(&actual.path)) {
    if (!near(arc->center, expected.center)) return "center";
    if (std::abs(arc->sweep * degrees - expected.sweep) > tolerance) return "sweep";
  }
  if (expected.third.moves()) {
    if (std::abs(actual.normal.from - expected.third.from) > tolerance ||
        std::abs(actual.normal.to - expected.third.to) > tolerance)
      return "third axis";
  } else if (actual.normal.moves()) {
    return "third axis moves";
  }
  if (expected.feed && std::abs(actual.feed - *expected.feed) > tolerance)
    return "feed " + std::to_string(actual.feed);
  return "";
}

bool moves_nothing(const CompensatedBlock& block) {
  if (is_arc(block.path) || block.normal.moves() || block.origin == Origin::masked) return false;
  const Line& line = std::get<Line>(block.path);
  return near(line.start, line.end) &&
         std::none_of(block.tracking.begin(), block.tracking.end(),
                      [](const AxisTravel& axis) { return axis.moves(); });
}

}  // namespace

Expectation read_expectation(std::string_view text) {
  Expectation expectation;
  for (const std::string& line : lines_of(text)) {
    if (line.empty() || line.front() == '#') continue;
    if (!line.starts_with("diagnostic ")) {
      expectation.blocks.push_back(read_block(line));
      continue;
    }
    Words words(line);
    words.keyword("diagnostic");
    const auto code = static_cast<Code>(static_cast<std::int32_t>(words.number()));
    words.keyword("line");
    expectation.diagnostics.push_back({.code = code, .line = words.number_or_any<std::uint32_t>()});
  }
  return expectation;
}

ExpectedDiagnostic read_expected_refusal(std::string_view program) {
  const std::vector<std::string> lines = lines_of(program);
  if (lines.empty()) throw std::runtime_error("empty program");
  Words words(lines.front());
  words.keyword(";");
  words.keyword("expect:");
  const auto code = static_cast<Code>(static_cast<std::int32_t>(words.number()));
  words.keyword("at");
  words.keyword("line");
  return {.code = code, .line = words.number_or_any<std::uint32_t>()};
}

ProgramSessionSetup read_setup(std::string_view program) {
  ProgramSessionSetup setup;
  setup.nc_text = false;
  for (const std::string& line : lines_of(program)) {
    if (!line.starts_with("; setup: ")) continue;
    Words words(line.substr(9));
    const std::string key = words.word();
    if (key == "tool") {
      const auto number = static_cast<std::int64_t>(words.number());
      setup.session.program.tools[number] = words.number();
    } else if (key == "start") {
      for (double& coordinate : setup.session.program.start) coordinate = words.number();
    } else if (key == "look_ahead") {
      setup.session.compensator.limits.look_ahead_blocks = static_cast<std::size_t>(words.number());
    } else if (key == "dialect") {
      ProgramSetup& start = setup.session.program;
      start.dialect = dialect_spelled(words.word()).value();
      dialect_of(start.dialect).begin(start.mode);
    } else if (key == "leads") {
      LeadSettings& leads = setup.session.compensator.leads;
      leads.find = LeadSettings::Find::none;
      if (words.more()) {
        leads.find = LeadSettings::Find::counted;
        leads.blocks_in = static_cast<std::size_t>(words.number());
        leads.blocks_out = static_cast<std::size_t>(words.number());
      }
    } else if (key == "max_masked_share") {
      setup.session.compensator.largest_masked_share = words.number();
    } else if (key == "verify") {
      const bool reports = words.more() && words.word() == "report";
      setup.session.verify = reports ? Verify::report : Verify::enforce;
    } else if (key == "selection_blocks") {
      setup.session.compensator.limits.selection_blocks = static_cast<std::size_t>(words.number());
    } else if (key == "wear") {
      setup.session.program.wear = words.number();
    } else if (key == "allowance") {
      setup.session.program.allowance = words.number();
    } else if (key == "nominal_radius") {
      setup.session.program.nominal_radius = words.number();
    } else if (key == "max_executed_lines") {
      setup.session.program.max_executed_lines = static_cast<std::uint64_t>(words.number());
    } else if (key == "implicit_masking") {
      setup.session.compensator.implicit_contour_masking = true;
    } else {
      throw std::runtime_error("unknown setup: " + line);
    }
  }
  return setup;
}

std::string difference(const std::vector<CompensatedBlock>& actual,
                       const std::vector<ExpectedBlock>& expected, bool beginning) {
  const bool with_text =
      std::any_of(expected.begin(), expected.end(),
                  [](const ExpectedBlock& block) { return block.origin == "passthrough"; });
  std::size_t next = 0;
  for (const CompensatedBlock& block : actual) {
    if (block.origin == Origin::passthrough ? !with_text : moves_nothing(block)) continue;
    if (next == expected.size()) return "not expected\n  " + text_of(block);
    const std::string fault = fault_of(block, expected[next]);
    if (!fault.empty())
      return fault + " differs\n  " + text_of(block) + "\nexpected\n  " + expected[next].text;
    ++next;
  }
  if (next < expected.size() && !beginning) return "missing\n  " + expected[next].text;
  return {};
}

}  // namespace trc::support
