#include "proto/wire/diagnostic.h"

#include <algorithm>
#include <limits>

namespace trc::wire {

v1::Diagnostic::Severity to_proto(Severity severity) {
  switch (severity) {
    case Severity::note:
      return v1::Diagnostic::NOTE;
    case Severity::warning:
      return v1::Diagnostic::WARNING;
    case Severity::error:
      break;
  }
  return v1::Diagnostic::ERROR;
}

void to_proto(const Diagnostic& diagnostic, v1::Diagnostic& message) {
  message.Clear();
  const Source& source = diagnostic.source;
  const CodeRow& row = row_of(diagnostic.code);
  message.set_code(static_cast<std::int32_t>(diagnostic.code));
  message.set_severity(to_proto(diagnostic.severity));
  if (source.number != Source::no_number)
    message.set_source_number(static_cast<std::uint64_t>(source.number));
  if (source.index <= std::numeric_limits<std::uint32_t>::max())
    message.set_source_index(static_cast<std::uint32_t>(source.index));
  if (source.line != 0) message.set_line(source.line);
  if (diagnostic.column != 0) message.set_column(diagnostic.column);
  message.set_message(message_of(diagnostic));
  for (const DiagnosticValue& value : diagnostic.values)
    (*message.mutable_values())[value.name] = value.value;
  message.set_remedy(std::string(row.remedy));
  if (diagnostic.point) {
    v1::Position& point = *message.mutable_point();
    point.set_x(diagnostic.point->x);
    point.set_y(diagnostic.point->y);
    point.set_z(diagnostic.point->z);
  }
  message.set_reason(std::string(row.reason));
  message.set_detail(diagnostic.detail);
}

void to_proto(const ReceivedDiagnostic& received, v1::Diagnostic& message) {
  to_proto(received.diagnostic, message);
  message.set_message(received.message);
  message.set_remedy(received.remedy);
  message.set_reason(received.reason);
}

ReceivedDiagnostic from_proto(const v1::Diagnostic& message) {
  ReceivedDiagnostic received{
      .message = message.message(), .remedy = message.remedy(), .reason = message.reason()};
  Diagnostic& diagnostic = received.diagnostic;
  diagnostic.code = static_cast<Code>(message.code());
  // A severity this reader does not know is taken for the gravest.
  diagnostic.severity = message.severity() == v1::Diagnostic::NOTE      ? Severity::note
                        : message.severity() == v1::Diagnostic::WARNING ? Severity::warning
                                                                        : Severity::error;
  diagnostic.source = {.index = message.source_index(),
                       .number = message.has_source_number()
                                     ? static_cast<std::int64_t>(message.source_number())
                                     : Source::no_number,
                       .line = message.line()};
  diagnostic.column = message.column();
  diagnostic.detail = message.detail();
  for (const auto& [name, value] : message.values())
    diagnostic.values.push_back({.name = name, .value = value});
  std::sort(diagnostic.values.begin(), diagnostic.values.end(),
            [](const DiagnosticValue& a, const DiagnosticValue& b) { return a.name < b.name; });
  if (message.has_point())
    diagnostic.point = DiagnosticPoint{
        .x = message.point().x(), .y = message.point().y(), .z = message.point().z()};
  return received;
}

}  // namespace trc::wire
