#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/nc/program/flow.h"

namespace trc::program {

// Of Heidenhain: labels that are called, LBL 1 … LBL 0, and stretches that are repeated, CALL LBL 1
// REP 3. Where a contour is in one of them, or one is called within a contour, all of them are
// written out; else the program comes out as it is (D-82).
class KlartextFlow : public Flow {
 public:
  KlartextFlow(const ProgramSetup& setup, CallPlaces& calls, ProgramText text, std::size_t start);

 protected:
  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t) override {}

 private:
  static constexpr std::size_t nowhere = std::string_view::npos;

  // LBL NAME … LBL 0.
  struct Label {
    std::size_t line = 0;
    std::size_t end = nowhere;  // the line of its LBL 0
    bool is_called = false;     // up to there
    bool is_twice = false;
  };
  // A line, as far as it has to do with labels.
  struct Statement {
    enum class Kind { none, label, call, program_end };
    Kind kind = Kind::none;
    std::size_t begin = 0;  // of the statement
    std::string label{};
    bool repeats = false;
    std::optional<std::uint64_t> repetitions{};  // none: they hang on a parameter
  };

  [[nodiscard]] static Statement statement_in(std::string_view line);
  void find_labels();
  [[nodiscard]] bool expands() const;
  // RL or RR stands there, or in what is called from there.
  [[nodiscard]] bool has_contour(std::size_t begin, std::size_t end, std::size_t depth) const;
  void write_as_written(std::string& flat);
  void write_name(std::string& flat, const std::string& label);
  bool execute_call(const Statement& statement, std::string& flat);
  bool write_behind_end(std::string& flat);

  std::map<std::string, Label> labels_{};
  bool expands_ = false;
  bool behind_end_ = false;  // of the program: text alone
  bool leaves_out_ = false;  // there: a label that has been written out
};

// CALL LBL.
[[nodiscard]] bool klartext_computes(std::string_view line);

}  // namespace trc::program
