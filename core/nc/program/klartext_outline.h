#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/program/klartext_label_effects.h"

namespace trc::program {

// The part of a line of Klartext that concerns labels.
struct LabelStatement {
  enum class Kind : std::uint8_t { none, label, call, program_end };
  Kind kind = Kind::none;
  std::size_t begin = 0;  // of the statement
  std::string label{};
  bool repeats = false;
  std::optional<std::uint64_t> repetitions{};  // none: a parameter gives them
};

// `words`: the result of statement_of() for the line after its number.
[[nodiscard]] LabelStatement label_statement_in(std::string_view line, std::string_view words);
[[nodiscard]] LabelStatement label_statement_in(std::string_view line);

// The labels of a program in Klartext, what they reach, and where contours stand in it. It takes
// the lines one by one; whatever depends on all of them is found once, in time proportional to
// their number, however the labels call each other.
class KlartextOutline {
 public:
  static constexpr std::size_t nowhere = std::string_view::npos;

  // LBL NAME … LBL 0.
  struct Label {
    std::size_t line = nowhere;
    std::size_t end = nowhere;  // the line of its LBL 0
    bool is_called = false;     // up to there
    bool is_twice = false;
    bool has_contour = false;  // RL or RR stands there, or in a label called from there
  };

  // Whether the line is executed, judging by `/` and the setup.
  enum class Execution : std::uint8_t { certain, perhaps, never };
  void read(std::string_view line, Execution execution);
  // To be called after the last line.
  void finish();

  // A contour is repeated by a call or contains a call, and no label is a contour of cycles, which
  // the control itself looks up.
  [[nodiscard]] bool repeats_contour() const { return repeats_contour_ && !is_named_by_cycles_; }
  // Null: the program has no such label.
  [[nodiscard]] const Label* label(const std::string& name) const;
  // The effects of calling the label; nothing where `name` is neither a label nor a parameter.
  [[nodiscard]] std::optional<KlartextEffects> effects_of(const std::string& name);

 private:
  struct Call {
    std::size_t line = 0;
    std::size_t section = 0;
    std::size_t label = 0;
    bool repeats = false;
    bool in_contour = false;
  };
  // The lines up to an LBL 0: each label in them reaches from its LBL to there.
  struct Section {
    std::vector<std::size_t> labels{};  // in the order of their lines
    std::size_t with_contour = 0;       // so many of them, the first ones
    std::size_t last_contour = nowhere;
  };

  [[nodiscard]] std::size_t index_of(const std::string& name);
  void read_label(const std::string& name);
  void read_effects(std::string_view line, std::string_view words, const LabelStatement& statement,
                    Execution execution);
  // That line, after the labels of the section, has a contour or calls one.
  void take_contour(Section& section, std::size_t line);
  void find_contours_of_labels();
  [[nodiscard]] bool has_contour(std::size_t begin, std::size_t end) const;

  std::map<std::string, std::size_t> names_{};
  std::vector<Label> labels_{};
  std::vector<Section> sections_{1};
  std::vector<Call> calls_{};
  std::vector<std::size_t> contours_{};  // lines of RL and RR, and of calls that reach one; rising
  std::vector<std::size_t> reached_{};   // labels found to have a contour, whose calls are to come
  LabelEffects effects_{};
  std::size_t lines_ = 0;
  bool in_contour_ = false;
  bool is_named_by_cycles_ = false;
  bool repeats_contour_ = false;
};

}  // namespace trc::program
