#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trc::program {

// The words of the flat program of Fanuc that its system variables show: the words in force, and
// the axes on which a position was programmed.
class SaidWords {
 public:
  // A line whose values are plain.
  void take(std::string_view line);
  // Lines that were not kept, and texts of the machine that are called, may hold any words.
  void forget();

  // Of T, D, F, H, M and S: the last value; nothing: it is not known.
  [[nodiscard]] std::optional<double> value_of(char letter) const { return of(letter).value; }
  // Whether a line has had such a word.
  [[nodiscard]] bool says(char letter) const { return of(letter).is_said; }
  // Whether a line has programmed X, Y or Z without a rotation, scaling or shift in force.
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

// Whether the line has that letter with a plain number after it, outside of comments.
[[nodiscard]] bool says_plainly(std::string_view line, char letter);

}  // namespace trc::program
