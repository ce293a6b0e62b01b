#include "server/rpc/status.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/messages/diagnostic_text.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/text.h"

namespace trc::server {
namespace {

using grpc::StatusCode;

struct Row {
  Refusal refusal;
  StatusCode code;
  std::string_view reason;
  std::string_view sentence;
  std::string_view german;
  int retry_after_s = 0;  // 0: waiting does not help
};

constexpr std::array<Row, 34> table{{
    {Refusal::setup_missing, StatusCode::FAILED_PRECONDITION, "SETUP_MISSING",
     "the first request must carry the setup", "die erste Anfrage muss das Setup enthalten"},
    {Refusal::setup_repeated, StatusCode::FAILED_PRECONDITION, "SETUP_REPEATED",
     "the setup may be sent once only, as the first request",
     "das Setup darf nur einmal kommen, als erste Anfrage"},
    {Refusal::request_empty, StatusCode::INVALID_ARGUMENT, "REQUEST_EMPTY",
     "the request carries nothing this server knows; update the server if the client is newer, or "
     "send what it takes",
     "die Anfrage enthält nichts, was dieser Server kennt; den Server aktualisieren, falls der "
     "Client neuer ist, oder senden, was er nimmt"},
    {Refusal::request_unreadable, StatusCode::INVALID_ARGUMENT, "REQUEST_UNREADABLE",
     "the request is no message of this service: its bytes are cut off or changed, or a text in it "
     "is no UTF-8",
     "die Anfrage ist keine Nachricht dieses Dienstes: Bytes fehlen oder sind verändert, oder ein "
     "Text darin ist kein UTF-8"},
    {Refusal::json_unreadable, StatusCode::INVALID_ARGUMENT, "REQUEST_UNREADABLE",
     "the JSON of the request cannot be taken", "das JSON der Anfrage ist so nicht möglich"},
    {Refusal::call_invalid, StatusCode::INVALID_ARGUMENT, "CALL_INVALID",
     "the call is none of the Connect protocol", "der Aufruf ist keiner des Connect-Protokolls"},
    {Refusal::stream_needs_grpc, StatusCode::UNIMPLEMENTED, "STREAM_NEEDS_GRPC",
     "streams from the client need gRPC; CompensateProgramOnce and PreviewPath take everything in "
     "one request",
     "Streams vom Client brauchen gRPC; CompensateProgramOnce und PreviewPath nehmen alles in "
     "einer Anfrage"},
    {Refusal::rpc_unknown, StatusCode::UNIMPLEMENTED, "RPC_UNKNOWN", "there is no such RPC",
     "diesen RPC gibt es nicht"},
    {Refusal::input_after_final, StatusCode::FAILED_PRECONDITION, "INPUT_AFTER_FINAL",
     "nothing may follow the request marked final",
     "nach der Anfrage mit final darf nichts mehr kommen"},
    {Refusal::batch_out_of_sequence, StatusCode::OUT_OF_RANGE, "BATCH_OUT_OF_SEQUENCE",
     "first_block must be the next expected block",
     "first_block muss der nächste erwartete Satz sein"},
    {Refusal::text_out_of_sequence, StatusCode::OUT_OF_RANGE, "TEXT_OUT_OF_SEQUENCE",
     "first_byte must be the next expected byte",
     "first_byte muss das nächste erwartete Byte sein"},
    {Refusal::contour_incomplete, StatusCode::ABORTED, "CONTOUR_INCOMPLETE",
     "the stream ended before a request marked final; the path is not complete",
     "der Stream endete vor einer Anfrage mit final; die Bahn ist nicht vollständig"},
    {Refusal::stream_idle, StatusCode::ABORTED, "STREAM_IDLE",
     "no request came within the idle timeout", "es kam zu lange keine Anfrage"},
    {Refusal::field_invalid, StatusCode::INVALID_ARGUMENT, "FIELD_INVALID",
     "a field has a value that is not allowed", "ein Feld hat einen Wert, der nicht erlaubt ist"},
    {Refusal::field_unknown, StatusCode::INVALID_ARGUMENT, "FIELD_UNKNOWN",
     "the request has a field that this server does not know; update the server, or leave the "
     "field out",
     "die Anfrage hat ein Feld, das dieser Server nicht kennt; den Server aktualisieren oder das "
     "Feld weglassen"},
    {Refusal::message_too_large, StatusCode::RESOURCE_EXHAUSTED, "MESSAGE_TOO_LARGE",
     "the request is larger than the setting max-message-bytes allows; send smaller pieces",
     "die Anfrage ist größer, als die Einstellung max-message-bytes erlaubt; kleinere "
     "Stücke senden"},
    {Refusal::batch_too_large, StatusCode::RESOURCE_EXHAUSTED, "BATCH_TOO_LARGE",
     "the batch has more blocks than the setting max-blocks-per-batch allows; send smaller "
     "batches",
     "die Nachricht hat mehr Sätze, als die Einstellung max-blocks-per-batch erlaubt; kleinere "
     "senden"},
    {Refusal::answer_too_large, StatusCode::RESOURCE_EXHAUSTED, "ANSWER_TOO_LARGE",
     "the answer is larger than the setting max-message-bytes allows; use CompensateProgram",
     "die Antwort ist größer, als die Einstellung max-message-bytes erlaubt; CompensateProgram "
     "nehmen"},
    {Refusal::stream_limit, StatusCode::RESOURCE_EXHAUSTED, "STREAM_LIMIT",
     "as many streams are open as the setting max-streams allows; try again later",
     "es sind so viele Streams offen, wie die Einstellung max-streams erlaubt; später noch einmal "
     "versuchen",
     1},
    {Refusal::stream_limit_of_peer, StatusCode::RESOURCE_EXHAUSTED, "STREAM_LIMIT",
     "as many streams of this client are open as the setting max-streams-per-peer allows; try "
     "again later",
     "von diesem Client sind so viele Streams offen, wie die Einstellung max-streams-per-peer "
     "erlaubt; später noch einmal versuchen",
     1},
    {Refusal::memory_limit, StatusCode::RESOURCE_EXHAUSTED, "MEMORY_LIMIT",
     "what all streams hold passes the setting max-session-memory-mib; try again later, or set "
     "look_ahead_blocks",
     "alle Streams zusammen halten mehr, als die Einstellung max-session-memory-mib erlaubt; "
     "später noch einmal versuchen, oder look_ahead_blocks setzen",
     1},
    {Refusal::memory_limit_of_peer, StatusCode::RESOURCE_EXHAUSTED, "MEMORY_LIMIT",
     "what the streams of this client hold passes the setting max-memory-per-peer-mib; try again "
     "later, or set look_ahead_blocks",
     "die Streams dieses Clients halten mehr, als die Einstellung max-memory-per-peer-mib erlaubt; "
     "später noch einmal versuchen, oder look_ahead_blocks setzen",
     1},
    {Refusal::memory_limit_of_stream, StatusCode::RESOURCE_EXHAUSTED, "MEMORY_LIMIT",
     "this stream alone holds more than the settings max-session-memory-mib and "
     "max-memory-per-peer-mib allow; set look_ahead_blocks, and verify to OFF",
     "dieser Stream allein hält mehr, als die Einstellungen max-session-memory-mib und "
     "max-memory-per-peer-mib erlauben; look_ahead_blocks setzen, und verify auf OFF"},
    {Refusal::memory_limit_of_process, StatusCode::RESOURCE_EXHAUSTED, "MEMORY_LIMIT",
     "the server is close to the memory it may have, the setting memory-limit-mib; try again later",
     "der Server hat fast den Speicher erreicht, den er haben darf, die Einstellung "
     "memory-limit-mib; später noch einmal versuchen",
     1},
    {Refusal::cpu_limit, StatusCode::RESOURCE_EXHAUSTED, "CPU_LIMIT",
     "the stream has computed for longer than the server allows",
     "der Stream hat länger gerechnet, als der Server erlaubt"},
    {Refusal::resume_token_invalid, StatusCode::INVALID_ARGUMENT, "RESUME_TOKEN_INVALID",
     "the resume token cannot be used; begin the path anew, without it",
     "mit diesem Resume-Token kann es nicht weitergehen; die Bahn ohne es neu beginnen"},
    {Refusal::resume_token_of_other_version, StatusCode::FAILED_PRECONDITION,
     "RESUME_TOKEN_OF_OTHER_VERSION",
     "the resume token is of another version of the server; begin the path anew",
     "das Resume-Token ist von einer anderen Version des Servers; die Bahn neu beginnen"},
    {Refusal::resume_setup_differs, StatusCode::FAILED_PRECONDITION, "RESUME_SETUP_DIFFERS",
     "the setup is not that of the stream which gave the resume token",
     "das Setup ist nicht das des Streams, von dem das Resume-Token stammt"},
    {Refusal::client_not_allowed, StatusCode::PERMISSION_DENIED, "CLIENT_NOT_ALLOWED",
     "the name of the client's certificate is not in the setting tls-allowed-clients",
     "der Name im Zertifikat des Clients steht nicht in der Einstellung tls-allowed-clients"},
    {Refusal::draining, StatusCode::UNAVAILABLE, "SERVER_DRAINING",
     "the server is shutting down and takes no new streams",
     "der Server fährt herunter und nimmt keine neuen Streams", 1},
    {Refusal::drain_timeout, StatusCode::UNAVAILABLE, "DRAIN_TIMEOUT",
     "the server shuts down, and the stream was not done within the setting drain-timeout-s; go on "
     "with its last resume token, or begin anew",
     "der Server fährt herunter, und der Stream war innerhalb der Einstellung drain-timeout-s "
     "nicht fertig; mit seinem letzten Resume-Token weitermachen oder neu beginnen",
     1},
    {Refusal::cancelled, StatusCode::CANCELLED, "CANCELLED", "the call was cancelled",
     "der Aufruf wurde abgebrochen"},
    {Refusal::deadline_exceeded, StatusCode::DEADLINE_EXCEEDED, "DEADLINE_EXCEEDED",
     "the deadline of the client has passed", "die Frist des Clients ist abgelaufen"},
    {Refusal::internal, StatusCode::INTERNAL, "INTERNAL",
     "the server has failed; its log has more under the incident id",
     "der Server hat versagt; unter der Nummer des Vorfalls steht mehr in seinem Protokoll"},
}};

// Details that are the same for every client.
constexpr std::array<Sentence, 6> details{{
    {"setup or text", "setup oder text"},
    {"setup, batch or columns", "setup, batch oder columns"},
    {"setup, text or blocks", "setup, text oder Sätze"},
    {"{} takes none", "{} nimmt keines"},
    {"it is none of this service", "es ist keines dieses Dienstes"},
    {"it was changed, or comes from a server with another resume-key-file",
     "es ist verändert oder von einem Server mit einer anderen resume-key-file"},
}};

const Row& row_of(Refusal refusal) {
  return *std::find_if(table.begin(), table.end(),
                       [&](const Row& row) { return row.refusal == refusal; });
}

constexpr std::string_view domain = "trc.v1";

// A peer drops a status whose trailers exceed 8 KB, and details travel in base64.
constexpr std::size_t longest_in_list = 80;
constexpr std::size_t longest_localized = 1000;
// Room for whole sentences; the status still fits into the 8 KiB of metadata that clients accept.
constexpr std::size_t longest_of_diagnostic = 400;

Ending finished(StatusCode code, std::string_view reason, std::string_view message,
                google::rpc::Status rich) {
  rich.set_code(static_cast<int>(code));
  rich.set_message(std::string(message));
  return {.status = grpc::Status(code, rich.message(), rich.SerializeAsString()),
          .reason = std::string(reason)};
}

// The key is made beforehand: g++ 12 wrongly warns of overflows if the map makes it.
void set_value(google::rpc::ErrorInfo& info, const std::string& name, std::string value) {
  (*info.mutable_metadata())[name] = std::move(value);
}

google::rpc::ErrorInfo error_info(std::string_view reason) {
  google::rpc::ErrorInfo info;
  info.set_reason(std::string(reason));
  info.set_domain(std::string(domain));
  return info;
}

// What happened and what helps, for readers of a language other than English.
void add_localized(const Diagnostic& diagnostic, google::rpc::Status& rich) {
  if (diagnostic.language == Language::english) return;
  google::rpc::LocalizedMessage localized;
  localized.set_locale("de");
  const std::string text = place_of(diagnostic.source, diagnostic.language) + ": " +
                           message_of(diagnostic, diagnostic.language) + ". " +
                           help_of(diagnostic, diagnostic.language);
  localized.set_message(presentable(text, longest_localized));
  rich.add_details()->PackFrom(localized);
}

}  // namespace

std::span<const Sentence> refusal_sentences() {
  // Each sentence alone, and with a detail after it.
  static const auto patterns = [] {
    std::vector<std::pair<std::string, std::string>> made;
    for (const Row& row : table) {
      made.emplace_back(std::string(row.sentence) + ": {}", std::string(row.german) + ": {}");
      made.emplace_back(row.sentence, row.german);
    }
    return made;
  }();
  static const std::vector<Sentence> sentences = [] {
    std::vector<Sentence> made;
    made.reserve(patterns.size() + details.size());
    for (const auto& [english, german] : patterns)
      made.push_back({.english = english, .german = german});
    made.insert(made.end(), details.begin(), details.end());
    return made;
  }();
  return sentences;
}

Ending refuse(Refusal refusal, std::string_view detail, const Values& values) {
  const Row& row = row_of(refusal);
  std::string message(row.sentence);
  if (!detail.empty()) message += ": " + presentable(detail);
  google::rpc::ErrorInfo info = error_info(row.reason);
  for (const auto& [name, value] : values) set_value(info, name, presentable(value));
  google::rpc::Status rich;
  rich.add_details()->PackFrom(info);
  const auto field = info.metadata().find("field");
  if (row.code == StatusCode::INVALID_ARGUMENT && field != info.metadata().end()) {
    google::rpc::BadRequest request;
    auto* violation = request.add_field_violations();
    violation->set_field(field->second);
    violation->set_description(message);
    rich.add_details()->PackFrom(request);
  }
  if (row.retry_after_s > 0) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(row.retry_after_s);
    rich.add_details()->PackFrom(retry);
  }
  return finished(row.code, row.reason, message, std::move(rich));
}

Ending refuse_batch_of(std::string_view got, std::uint32_t most) {
  const std::string allowed = std::to_string(most);
  return refuse(Refusal::batch_too_large, std::string(got) + " of " + allowed,
                {{"max_blocks_per_batch", allowed}, {"got", std::string(got)}});
}

Ending refuse(const wire::FieldFaults& faults) {
  const Row& row = row_of(Refusal::field_invalid);
  google::rpc::ErrorInfo info = error_info(row.reason);
  google::rpc::BadRequest fields;
  for (const wire::FieldFault& fault : faults.listed()) {
    auto* violation = fields.add_field_violations();
    violation->set_field(presentable(fault.field, longest_in_list));
    violation->set_description(presentable(fault.description, longest_in_list));
  }
  if (faults.count() > faults.listed().size())
    set_value(info, "field_violations_dropped",
              std::to_string(faults.count() - faults.listed().size()));
  set_value(info, "field", fields.field_violations(0).field());
  const std::string message =
      fields.field_violations(0).field() + " " + fields.field_violations(0).description();
  google::rpc::Status rich;
  rich.add_details()->PackFrom(info);
  rich.add_details()->PackFrom(fields);
  return finished(row.code, row.reason, message, std::move(rich));
}

Ending refuse(const wire::UnknownField& unknown) {
  const std::string number = std::to_string(unknown.number);
  std::string detail = "field " + number + " of " + unknown.message;
  if (!unknown.place.empty()) detail += ", in " + unknown.place;
  return refuse(Refusal::field_unknown, detail,
                {{"field", unknown.place}, {"message", unknown.message}, {"field_number", number}});
}

Ending refuse(const Diagnostic& diagnostic) {
  const CodeRow& row = trc::row_of(diagnostic.code);
  google::rpc::ErrorInfo info = error_info(row.reason);
  const std::string code = std::to_string(static_cast<int>(diagnostic.code));
  const Source& source = diagnostic.source;
  set_value(info, "code", code);
  set_value(info, "source_index", std::to_string(source.index));
  if (source.number != Source::no_number)
    set_value(info, "source_number", std::to_string(source.number));
  if (source.line > 0) set_value(info, "line", std::to_string(source.line));
  if (diagnostic.column > 0) set_value(info, "column", std::to_string(diagnostic.column));
  if (!diagnostic.detail.empty()) set_value(info, "detail", presentable(diagnostic.detail));
  for (const DiagnosticValue& value : diagnostic.values)
    set_value(info, value.name, shortest(value.value));
  set_value(info, "remedy", help_of(diagnostic));

  std::string message;
  if (source.line > 0) message = "line " + std::to_string(source.line) + ": ";
  message += "error " + code + ": " + presentable(message_of(diagnostic), longest_of_diagnostic);
  // The program has no fault; it exceeds a limit of this server.
  const StatusCode status = diagnostic.code == Code::selection_too_long
                                ? StatusCode::RESOURCE_EXHAUSTED
                                : StatusCode::INVALID_ARGUMENT;
  google::rpc::Status rich;
  rich.add_details()->PackFrom(info);
  add_localized(diagnostic, rich);
  return finished(status, row.reason, message, std::move(rich));
}

std::string_view name_of(StatusCode code) {
  switch (code) {
    case StatusCode::OK:
      return "OK";
    case StatusCode::CANCELLED:
      return "CANCELLED";
    case StatusCode::UNKNOWN:
      return "UNKNOWN";
    case StatusCode::INVALID_ARGUMENT:
      return "INVALID_ARGUMENT";
    case StatusCode::DEADLINE_EXCEEDED:
      return "DEADLINE_EXCEEDED";
    case StatusCode::NOT_FOUND:
      return "NOT_FOUND";
    case StatusCode::ALREADY_EXISTS:
      return "ALREADY_EXISTS";
    case StatusCode::PERMISSION_DENIED:
      return "PERMISSION_DENIED";
    case StatusCode::UNAUTHENTICATED:
      return "UNAUTHENTICATED";
    case StatusCode::RESOURCE_EXHAUSTED:
      return "RESOURCE_EXHAUSTED";
    case StatusCode::FAILED_PRECONDITION:
      return "FAILED_PRECONDITION";
    case StatusCode::ABORTED:
      return "ABORTED";
    case StatusCode::OUT_OF_RANGE:
      return "OUT_OF_RANGE";
    case StatusCode::UNIMPLEMENTED:
      return "UNIMPLEMENTED";
    case StatusCode::INTERNAL:
      return "INTERNAL";
    case StatusCode::UNAVAILABLE:
      return "UNAVAILABLE";
    case StatusCode::DATA_LOSS:
      return "DATA_LOSS";
    default:
      return "UNKNOWN";
  }
}

}  // namespace trc::server
