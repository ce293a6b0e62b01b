#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trc::cli {

// Without blanks and quotation marks at both ends.
[[nodiscard]] std::string_view without_quotes(std::string_view text);

// The cells of a row, without those; at least one.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// The cells of a row of CSV.
struct CsvCells {
  std::vector<std::string> cells{};
  std::string fault{};  // a sentence; empty: none
};

// Splits a row as RFC 4180 has it: a separator in quotation marks does not split, two quotation
// marks there are one. Blanks around a cell do not count; a cell does not go on in another line.
[[nodiscard]] CsvCells csv_cells(std::string_view row, char separator);

// Empty unless all of the text is one finite number.
[[nodiscard]] std::optional<double> number_from(std::string_view text);

// Empty unless it is an integer from 0 to 2147483647.
[[nodiscard]] std::optional<std::uint32_t> tool_number(std::optional<double> number);

// A line of words, a letter with a number each, up to a `;`. Comments in parentheses are left out.
class LineOfWords {
 public:
  struct Word {
    char letter = 0;
    std::string_view text{};  // of the number
    double number = 0;
  };

  explicit LineOfWords(std::string_view line);

  // Whether the letter occurs, even without a number.
  [[nodiscard]] bool names(char letter) const { return letters_.find(letter) != letters_.npos; }
  [[nodiscard]] const std::string& letters() const { return letters_; }
  // The first one with a number; null: there is none.
  [[nodiscard]] const Word* find(char letter) const;
  [[nodiscard]] bool has(char letter) const { return find(letter) != nullptr; }
  [[nodiscard]] bool has_function(double number) const;
  // Whether a control leaves the line out if its operator wants so.
  [[nodiscard]] bool is_skippable() const { return is_skippable_; }
  // Why the line cannot be read as a whole, as a sentence; empty: it can. Only the letters in
  // `repeatable` may occur more than once.
  [[nodiscard]] std::string fault_but_for(std::string_view repeatable) const;

 private:
  void take(char letter, std::string_view value);
  void note(std::string fault);

  std::vector<Word> words_{};
  std::string letters_{};
  std::string fault_{};  // the first one
  bool is_skippable_ = false;
};

}  // namespace trc::cli
