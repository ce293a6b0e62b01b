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

}  // namespace

std::string line_for(std::string_view file, const wire::ReceivedDiagnostic& received) {
  const Diagnostic& diagnostic = received.diagnostic;
  std::string line;
  append_printable(line, file);
  if (diagnostic.source.line > 0) line += ":" + std::to_string(diagnostic.source.line);
  line += ": ";
  line += word_for(diagnostic.severity);
  line += " " + std::to_string(static_cast<int>(diagnostic.code)) + ": ";
  append_printable(line, received.message);
  if (diagnostic.column > 0) line += ", column " + std::to_string(diagnostic.column);
  if (!received.remedy.empty()) {
    line += " (";
    append_printable(line, received.remedy);
    line += ")";
  }
  return line;
}

}  // namespace trc::cli
