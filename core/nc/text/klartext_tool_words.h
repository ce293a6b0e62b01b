#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trc {

// A word after TOOL CALL or TOOL DEF.
struct KlartextToolWord {
  enum class Kind : std::uint8_t {
    end,
    number,     // 5, 5.1: the tool
    text,       // "…": its name
    parameter,  // Q5, QS1
    name,       // S1000, DR+0.5, Z: `name`, and after it perhaps a value
    unknown,
  };
  enum class Value : std::uint8_t {
    none,
    number,
    parameter,  // Q5, +Q5
    other,      // S(VC=100), F AUTO
  };
  Kind kind = Kind::end;
  std::string_view name{};
  Value has = Value::none;
  double value = 0;
  std::string_view parameter{};  // without its sign
  bool negative = false;         // of the parameter
  std::string_view text{};       // the whole word
};

// Cuts what stands after TOOL CALL and TOOL DEF into words: capitals, the letters in quotes are
// hidden, single blanks. Words need no blanks between them; blanks may stand between a name and its
// value.
class KlartextToolReader {
 public:
  explicit KlartextToolReader(std::string_view words) : text_(words) {}
  [[nodiscard]] KlartextToolWord next();

 private:
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  void skip_blanks();
  [[nodiscard]] std::string_view name_here() const;
  [[nodiscard]] bool read_number_here(double& value);
  [[nodiscard]] std::string_view read_parameter();
  void read_value(KlartextToolWord& word);

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace trc
