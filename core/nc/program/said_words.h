#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trc::program {

// What the lines of the flat program of Fanuc have said so far of what its system variables hold:
// the words in force, and on which axes a place was programmed.
class SaidWords {
 public:
  // A line whose values are plain. `calls_the_machine`: what it calls may say anything.
  void take(std::string_view line, bool calls_the_machine);
  // Lines that nobody has kept may have said anything.
  void forget();

  // Of T, D, F, H, M and S: the last value; nothing: it is not known.
  [[nodiscard]] std::optional<double> value_of(char letter) const { return of(letter).value; }
  // Whether a line has said it.
  [[nodiscard]] bool says(char letter) const { return of(letter).is_said; }
  // Whether a line has led there on X, Y or Z, in coordinates that nothing turns, scales or moves.
  [[nodiscard]] bool is_placed(std::size_t axis) const { return placed_.at(axis) && !moves_frame_; }
  [[nodiscard]] bool moves() const { return moves_; }
  // Whether the place of the tool tip differs from that of the spindle.
  [[nodiscard]] bool has_length() const { return has_length_; }

 private:
  struct Said {
    std::optional<double> value{};
    bool is_said = false;
  };
  static constexpr std::string_view letters = "TDFHMS";

  [[nodiscard]] const Said& of(char letter) const { return said_.at(letters.find(letter)); }
  void say(char letter, std::optional<double> value) {
    said_.at(letters.find(letter)) = {.value = value, .is_said = true};
  }
  void take_modes(const struct LineWords& words);
  void take_places(const struct LineWords& words);

  std::array<Said, letters.size()> said_{};
  std::array<bool, 3> placed_{};
  bool moves_ = false;
  bool incremental_ = false;
  bool moves_frame_ = false;
  bool has_length_ = false;
};

// What a line of FANUC writes into the register of a radius or its wear: G10 L12, G10 L13.
struct RegisterSetting {
  std::int64_t variable = 0;      // which has that register: #13001, #12001
  std::optional<double> value{};  // nothing: it hangs on what the line does not say
};
[[nodiscard]] std::optional<RegisterSetting> register_set_by(std::string_view line,
                                                             bool incremental);

// Whether the line has that letter with a plain number behind it, outside of comments.
[[nodiscard]] bool says_plainly(std::string_view line, char letter);

}  // namespace trc::program
