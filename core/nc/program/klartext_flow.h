#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/nc/program/flow.h"
#include "core/nc/program/klartext_outline.h"

namespace trc::program {

// Heidenhain: labels that are called, LBL 1 … LBL 0, and program sections that are repeated, CALL
// LBL 1 REP 3. Where one of them has a contour, or is called within a contour, all of them are
// written out; else the program comes out as it is (D-82).
class KlartextFlow : public Flow {
 public:
  KlartextFlow(const ProgramSetup& setup, const Lent& lent, ProgramText text, std::size_t start);

 protected:
  [[nodiscard]] Step execute_next(std::string& flat) override;
  [[nodiscard]] bool execute_line(std::string& flat) override;
  void keep_variables(std::size_t) override {}

 private:
  // Takes the lines into the outline; how the program comes out is known after the last one.
  void read_outline();
  void take_effects_of_call();
  void write_as_written(std::string& flat);
  void write_name(std::string& flat, const std::string& label);
  bool execute_call(const LabelStatement& statement, std::string& flat);
  bool write_behind_end(std::string& flat);

  KlartextOutline outline_{};
  std::size_t lines_in_outline_ = 0;
  bool behind_end_ = false;  // of the program: text alone
  bool leaves_out_ = false;  // there: a label that has been written out
};

// Whether the line is a CALL LBL.
[[nodiscard]] bool klartext_computes(std::string_view line);

}  // namespace trc::program
