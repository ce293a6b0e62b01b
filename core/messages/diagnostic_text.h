#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/call_places.h"
#include "core/base/diagnostic.h"
#include "core/base/language.h"
#include "core/base/source.h"

namespace trc {

// The texts it was sent with; else those from the tables of this program.
[[nodiscard]] DiagnosticTexts texts_of(const Diagnostic& diagnostic);

// "in line 7 (N70)", "in block 6" where there is no line.
[[nodiscard]] std::string place_of(const Source& source, Language language = Language::english);

// "other block", "anderer Satz".
[[nodiscard]] std::string text_of(const RelatedPlace& related, Language language);

// "in O1001, called from line 7", where subprograms are called; else empty.
[[nodiscard]] std::string text_of(const std::vector<CallPlace>& calls, Language language);

// The title of a code: the cause of its row, in the language.
[[nodiscard]] std::string_view title_of(Code code, Language language = Language::english);

// "tool radius 10.000 mm is not smaller than …: R 10 (radius of the contour 6.000 mm)": cause,
// detail and values in one sentence, without place and code. Lengths are in the unit of the
// program, mm with three decimals or in with four. Another block is named by line and N number:
// "other block in line 7 (N70)".
[[nodiscard]] std::string message_of(const Diagnostic& diagnostic,
                                     Language language = Language::english);

// What the operator or programmer can do: the remedy of its slip, if any, else that of its row.
[[nodiscard]] std::string help_of(const Diagnostic& diagnostic,
                                  Language language = Language::english);

}  // namespace trc
