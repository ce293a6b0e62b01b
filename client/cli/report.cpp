#include "client/cli/report.h"

namespace trc::cli {
namespace {

std::string_view word_for(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

// Texts come from the program or from a server: a control character must not
// reach the terminal.
void append_printable(std::string& line, std::string_view text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
}

// "FILE:LINE: WORD CODE: "
std::string place_and_code(std::string_view file, const Diagnostic& diagnostic,
                           std::string_view word) {
  std::string line;
  append_printable(line, file);
  if (diagnostic.source.line > 0) line += ":" + std::to_string(diagnostic.source.line);
  line.append(": ").append(word);
  return line + " " + std::to_string(static_cast<int>(diagnostic.code)) + ": ";
}

}  // namespace

std::string line_for(std::string_view file, const wire::ReceivedDiagnostic& received) {
  const Diagnostic& diagnostic = received.diagnostic;
  std::string line = place_and_code(file, diagnostic, word_for(diagnostic.severity));
  append_printable(line, received.message);
  if (diagnostic.column > 0) line += ", column " + std::to_string(diagnostic.column);
  if (!received.remedy.empty()) {
    line += " (";
    append_printable(line, received.remedy);
    line += ")";
  }
  return line;
}

std::vector<std::string> help_lines_for(std::string_view file, const Diagnostic& diagnostic,
                                        const Writing& writing) {
  if (!diagnostic.entry_help) return {};
  std::vector<std::string> lines = lines_of(*diagnostic.entry_help, writing);
  for (std::string& line : lines) line.insert(0, place_and_code(file, diagnostic, "help"));
  return lines;
}

}  // namespace trc::cli
