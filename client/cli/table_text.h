#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace trc::cli {

// Without blanks and quotation marks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The cells of a row, trimmed; at least one.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// Empty unless all of the text is one finite number.
[[nodiscard]] std::optional<double> number_from(std::string_view text);

// Empty unless it is an integer from 0 to 2147483647.
[[nodiscard]] std::optional<std::uint32_t> tool_number(std::optional<double> number);

// The words of a line of letters and numbers, up to a comment.
[[nodiscard]] std::multimap<char, double> words_of(std::string_view line);

}  // namespace trc::cli
