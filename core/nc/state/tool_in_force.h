#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/nc/state/program_setup.h"
#include "core/nc/state/refusal.h"

namespace trc {

// The tool radius in force and its origin: the setup, the tool in the spindle or the program (D-40,
// D-43). Functions return what is to be reported: an error ends the stream.
class ToolInForce {
 public:
  explicit ToolInForce(const ProgramSetup& setup);

  // mm; negative swaps the side (rule 1.5). At most `largest_tool_radius` in size (900104).
  std::optional<Refusal> set_radius(double radius);
  // Adds to the radius, mm. 900219 where there is none.
  std::optional<Refusal> change_radius(double more);
  std::optional<Refusal> set_wear(double wear);            // mm
  std::optional<Refusal> set_allowance(double allowance);  // mm
  std::optional<Refusal> set_scale(double scale);          // RadiusTerms::scale
  // D word; D0 without a row is no tool and gives no radius. A tool missing from the table is
  // reported where a radius is needed (D-52); without a table at once: 900013.
  std::optional<Refusal> set_tool(std::int64_t number, const WordPlace& place);
  // A tool with its sizes, called by the program.
  std::optional<Refusal> call_tool(const ToolRow& row);
  // T word: the tool is made ready. M06: it is the one in the spindle. Its radius in the tool table
  // holds as long as the program has neither a D word nor another radius of its own; without any
  // M06 a T word acts at once, but for LINUXCNC, where it only makes ready.
  void prepare_tool(std::int64_t number, const WordPlace& place) {
    prepared_ = number;
    prepared_place_ = place;
  }
  std::optional<Refusal> load_tool();
  // The program itself gives a tool of the table its radius, mm. 900224 where the setup has
  // another one.
  std::optional<Refusal> define_tool(std::int64_t number, double radius);

  // The wear of that radius, mm.
  void define_wear(std::int64_t number, double wear) { wears_[number] = wear; }
  // Whether the program has given it.
  [[nodiscard]] bool gives_wear(std::int64_t number) const { return wears_.contains(number); }
  // mm, from the program, the table or the single tool of the setup.
  [[nodiscard]] double wear_of(std::int64_t number) const;

  // What the first motion of a selection asks for: that there is a radius (900219) and that its
  // wear is none of a whole radius (900222); 0 gets a warning once (900220). A tool that the table
  // does not hold is told where the program calls it (900013, D-52). `selected`: by whom.
  std::optional<Refusal> check(const Source& selected);
  // The same; a tool made ready without any M06 takes its place first. Under FANUC the register of
  // the tool in the spindle is read anew: G10 may have written into it since (D-163).
  std::optional<Refusal> check_at_first_motion(const Source& selected);

  // The radius that the program may read, mm, without wear. None where no radius was given, or
  // where the program is read for several radii.
  [[nodiscard]] std::optional<double> radius() const {
    const bool is_known =
        giver_ != RadiusGiver::nobody && !has_tool_that_waits() && !setup_.every_radius;
    return is_known ? std::optional(terms_.radius) : std::nullopt;
  }
  // Whether this tool has no radius of its own and takes that of the setup.
  [[nodiscard]] bool is_of_setup(std::int64_t number) const {
    return giver_ == RadiusGiver::setup && !setup_.every_radius && !row_of_tool(number);
  }
  // The parts of the radius in force.
  [[nodiscard]] const RadiusTerms& terms() const { return terms_; }
  // The tool of that name in the table; `no_tool_number`: it has none.
  [[nodiscard]] std::int64_t tool_named(std::string_view name) const;
  // From the program or the tool table; `number` is that of row_of_edge().
  [[nodiscard]] std::optional<ToolRow> row_of_tool(std::int64_t number) const;
  // Whether a D word may name it.
  [[nodiscard]] bool has_tool(std::int64_t number) const {
    return number == 0 || setup_.every_radius || defined_.contains(number) ||
           setup_.tools.contains(number);
  }

  // mm; the reference control keeps 32 bits of 0.1 um.
  static constexpr double largest_tool_radius = 214748.3647;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(defined_, wears_, terms_.radius, terms_.wear, terms_.allowance, terms_.scale, giver_,
            prepared_, loaded_, prepared_place_, loads_tools_, missing_, missing_letter_,
            missing_place_, zero_reported_);
  }

 private:
  // Who has given the radius in force.
  enum class RadiusGiver : std::uint8_t { nobody, setup, tool_in_spindle, program };
  static constexpr std::int64_t no_tool = -1;

  // Replaces the terms in force and the origin of the radius.
  std::optional<Refusal> enter_terms(const RadiusTerms& terms, RadiusGiver giver);
  // The origin stays; a tool not found stays missing.
  std::optional<Refusal> change_terms(const RadiusTerms& terms);
  std::optional<Refusal> enter_row(const ToolRow& row, RadiusGiver giver);
  std::optional<Refusal> take_tool(std::int64_t number);
  // A T word waits, and no M06 so far has shown that T only prepares a tool.
  [[nodiscard]] bool has_tool_that_waits() const {
    return prepared_ != no_tool && !loads_tools_ && setup_.dialect != DialectName::linuxcnc;
  }
  [[nodiscard]] std::string missing_radius(const Source& selected) const;

  const ProgramSetup& setup_;
  std::map<std::int64_t, double> defined_{};  // by the program
  std::map<std::int64_t, double> wears_{};    // likewise
  RadiusTerms terms_;
  RadiusGiver giver_ = RadiusGiver::nobody;
  std::int64_t prepared_ = no_tool;  // of a T word, until it is loaded
  std::int64_t loaded_ = no_tool;    // by the last M06
  bool loads_tools_ = false;         // the program has an M06
  WordPlace prepared_place_{};       // of the last T word
  std::int64_t missing_ = no_tool;   // asked for last, without a radius
  char missing_letter_ = 'T';        // of the word that asked for it
  WordPlace missing_place_{};
  bool zero_reported_ = false;
};

}  // namespace trc
