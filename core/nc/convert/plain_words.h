#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/convert/conversion.h"
#include "core/nc/dialect/dialect.h"
#include "core/nc/state/program_line.h"
#include "core/nc/state/program_setup.h"

namespace trc {

// Why a plane other than G17 is a fault in Klartext.
inline constexpr std::string_view plane_of_klartext = ", a plane: Klartext has it with TOOL CALL";

// G17, G18 or G19.
[[nodiscard]] inline std::string_view name_of(Plane plane) {
  return plane == Plane::xy ? "G17" : plane == Plane::zx ? "G18" : "G19";
}

// The words of a line of a plain program besides its motion.
struct PlainWords {
  std::vector<std::string> functions{};  // M
  std::string speed{};                   // S, its number
  std::optional<std::int64_t> tool{};
  std::optional<std::int64_t> next_tool{};  // T2 M6 T3: made ready after the change
  bool loads_tool = false;
  // The length of a tool: G43, the number after its H or after the D of ISG; D1 of SINUMERIK;
  // G49.
  bool begins_length = false;
  std::optional<std::int64_t> length{};
  bool names_edge = false;
  bool ends_length = false;
  std::string comment{};  // its text
  std::optional<Plane> plane{};
  bool ends_program = false;
};

// Reads such words of a dialect for a conversion; each that has no plain meaning is a fault.
class PlainWordsReader {
 public:
  // `to`: what the program is converted to.
  PlainWordsReader(const ProgramSetup& setup, DialectName to)
      : from_(dialect_of(setup.dialect)),
        setup_(setup),
        to_klartext_(to == DialectName::heidenhain) {}

  // T of a program without M6 changes the tool (D-40, D-56).
  void look_for_tool_changes(const std::vector<LinePointer>& lines);
  // Reads all words, also after one that cannot be converted. Returns whether all can be.
  bool read(const ProgramLine& line, PlainWords& words);
  // Returns false.
  bool fail(const ProgramLine& line, std::string word);
  [[nodiscard]] std::vector<ConvertedProgram::Fault>& faults() { return faults_; }

 private:
  bool read_word(const ProgramLine& line, const WordRange& range, PlainWords& words);
  bool read_mode(const ProgramLine& line, std::string_view given, PlainWords& words);
  bool read_technology(const ProgramLine& line, std::string_view given, PlainWords& words);
  bool read_length(std::string_view word, PlainWords& words) const;
  bool read_tool_call(const ProgramLine& line, std::string_view given, PlainWords& words);

  const Dialect& from_;
  const ProgramSetup& setup_;
  bool to_klartext_;
  bool changes_by_t_ = false;
  std::vector<ConvertedProgram::Fault> faults_{};
};

}  // namespace trc
