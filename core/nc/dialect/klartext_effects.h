#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trc {

// Modes that scale coordinates or guide the tool tip: bits of KlartextModes::unfollowed.
struct KlartextLead {
  static constexpr std::uint32_t axes = 7;  // X Y Z of cycle 26, a bit each
  static constexpr std::uint32_t cycle = 8;
  static constexpr std::uint32_t trans = 16;
  static constexpr std::uint32_t tip = 32;          // M114, M128, FUNCTION TCPM
  static constexpr std::uint32_t table = 64;        // M144
  static constexpr std::uint32_t correction = 128;  // FUNCTION CORRDATA
  static constexpr std::uint32_t tool_data = 256;   // FN 17 has written a radius
  static constexpr std::uint32_t all = 511;
};

// Further modes that RL and RR depend on, one bit each after those of KlartextLead.
struct KlartextMode {
  static constexpr std::uint32_t modal_cycle = 512;     // M89
  static constexpr std::uint32_t tool = 1024;           // TOOL CALL has changed the radius
  static constexpr std::uint32_t feed_per_turn = 2048;  // M136
  static constexpr std::uint32_t adapts_feed = 4096;    // M109
  static constexpr std::uint32_t slows_feed = 8192;     // M110
  static constexpr std::uint32_t anything = 16384;      // effects of lines that cannot be followed
  // If it is unknown whether one of these holds, RL and RR are wrong in either case.
  static constexpr std::uint32_t either_way = feed_per_turn | adapts_feed | slows_feed | anything;
};

// The effects of lines on the modes of KlartextLead and KlartextMode: modes that they set, that
// they end, and that they may have set or ended. No bit is in two of the three (D-160).
struct KlartextEffects {
  std::uint32_t sets = 0;
  std::uint32_t clears = 0;
  std::uint32_t unsure = 0;

  // These effects followed by `next`.
  [[nodiscard]] KlartextEffects then(const KlartextEffects& next) const;
  // The effects if the lines may be executed or not, in any order.
  [[nodiscard]] KlartextEffects perhaps() const;
  [[nodiscard]] std::uint32_t touched() const { return sets | clears | unsure; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(sets, clears, unsure);
  }
};

// `statement`: a result of statement_of() that is no motion.
[[nodiscard]] KlartextEffects effects_of_statement(std::string_view statement);
[[nodiscard]] KlartextEffects effects_of_function(int m);
// `text`: any line, from the beginning of its statement on.
[[nodiscard]] KlartextEffects effects_of_line(std::string_view text, std::string_view statement);

// A statement that scales both axes of the plane by the same number.
struct KlartextScale {
  std::uint32_t mode = 0;  // bits of KlartextLead; 0: the statement is another one
  double factor = 1;
};
[[nodiscard]] KlartextScale scale_of_statement(std::string_view statement);

// FN 9 … FN 12, IF: the statement may jump.
[[nodiscard]] bool jumps(std::string_view statement);
// FN 17: SYSWRITE of R or DR in the tool table; a parameter may be any of them (D-72).
[[nodiscard]] bool writes_radius(std::string_view statement);

// The steps of a section at which each mode was last set or ended. They give the effects of a label
// that reaches from its step to the end of the section.
class KlartextSection {
 public:
  void note(const KlartextEffects& effects);
  [[nodiscard]] std::uint32_t steps() const { return steps_; }
  // The effects of the steps after the first `steps`.
  [[nodiscard]] KlartextEffects since(std::uint32_t steps) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(steps_, set_, cleared_, unsure_);
  }

 private:
  static constexpr std::size_t modes = 15;
  using Steps = std::array<std::uint32_t, modes>;

  std::uint32_t steps_ = 0;
  Steps set_{};  // 0: never
  Steps cleared_{};
  Steps unsure_{};
};

}  // namespace trc
