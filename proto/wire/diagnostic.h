#pragma once

#include "core/base/diagnostic.h"
#include "trc/v1/diagnostic.pb.h"

namespace trc::wire {

[[nodiscard]] v1::Diagnostic::Severity to_proto(Severity severity);

// Replaces the content of the message.
void to_proto(const Diagnostic& diagnostic, v1::Diagnostic& message);
// With the texts it came with, and values in the order of their names.
[[nodiscard]] Diagnostic from_proto(const v1::Diagnostic& message);

}  // namespace trc::wire
