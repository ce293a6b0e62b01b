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

// A line of Klartext, as far as it has to do with labels.
struct LabelStatement {
  enum class Kind : std::uint8_t { none, label, call, program_end };
  Kind kind = Kind::none;
  std::size_t begin = 0;  // of the statement
  std::string label{};
  bool repeats = false;
  std::optional<std::uint64_t> repetitions{};  // none: they hang on a parameter
};

// `words`: what statement_of() makes of the line from behind its number on.
[[nodiscard]] LabelStatement label_statement_in(std::string_view line, std::string_view words);
[[nodiscard]] LabelStatement label_statement_in(std::string_view line);

// Which labels a program in Klartext has, what they reach, and where contours stand in it. It takes
// the lines one by one; what hangs on all of them is found once, in time that grows with their
// number alone, however the labels call each other.
class KlartextOutline {
 public:
  static constexpr std::size_t nowhere = std::string_view::npos;

  // LBL NAME … LBL 0.
  struct Label {
    std::size_t line = nowhere;
    std::size_t end = nowhere;  // the line of its LBL 0
    bool is_called = false;     // up to there
    bool is_twice = false;
    bool has_contour = false;  // RL or RR stands there, or in what is called from there
  };

  // Whether the line is executed, as far as `/` and the setup say.
  enum class Execution : std::uint8_t { certain, perhaps, never };
  void read(std::string_view line, Execution execution);
  // Behind the last line.
  void finish();

  // A contour is repeated by a call, or has one in it, and no label is a contour of cycles, which
  // the control itself looks up.
  [[nodiscard]] bool repeats_contour() const { return repeats_contour_ && !is_named_by_cycles_; }
  // Null: no line has it.
  [[nodiscard]] const Label* label(const std::string& name) const;
  // What a call of the label leaves in force; nothing where no line has it, nor is it a parameter.
  [[nodiscard]] std::optional<KlartextEffects> effects_of(const std::string& name);

 private:
  struct Call {
    std::size_t line = 0;
    std::size_t section = 0;
    std::size_t label = 0;
    bool repeats = false;
    bool in_contour = false;
  };
  // Lines up to an LBL 0: each of its labels goes from where it stands to there.
  struct Section {
    std::vector<std::size_t> labels{};  // in the order of their lines
    std::size_t with_contour = 0;       // so many of them, the first ones
    std::size_t last_contour = nowhere;
  };

  [[nodiscard]] std::size_t index_of(const std::string& name);
  void read_label(const std::string& name);
  void read_effects(std::string_view line, std::string_view words, const LabelStatement& statement,
                    Execution execution);
  // Behind the labels of the section a contour, or a call of one, stands in that line.
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
