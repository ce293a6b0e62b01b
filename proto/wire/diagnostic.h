#pragma once

#include <string>

#include "core/base/diagnostic.h"
#include "trc/v1/diagnostic.pb.h"

namespace trc::wire {

// A diagnostic with the texts its sender gave it. The sender may know codes that
// the reader does not.
struct ReceivedDiagnostic {
  Diagnostic diagnostic{};  // values in the order of their names
  std::string message{};
  std::string remedy{};
  std::string reason{};  // UPPER_SNAKE
  // In the language that was asked for; empty of a sender that has none yet.
  std::string title{};
  std::string text{};
  std::string help{};
};

[[nodiscard]] v1::Diagnostic::Severity to_proto(Severity severity);

// Replaces the content of the message; texts come from the table of codes.
void to_proto(const Diagnostic& diagnostic, v1::Diagnostic& message);
// With the texts it came with.
void to_proto(const ReceivedDiagnostic& received, v1::Diagnostic& message);
[[nodiscard]] ReceivedDiagnostic from_proto(const v1::Diagnostic& message);

}  // namespace trc::wire
