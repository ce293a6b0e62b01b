// Requests of any kind, as the reactor of a stream hands them over, without a network. Claims:
//   (1) no crash and no undefined behaviour (with the sanitizers), nothing thrown, within two
//       seconds
//   (2) every request gets an answer or ends the stream; the stream ends with OK after a summary,
//       else with a status that names its reason, and never as a bug
//   (3) what comes out can be read, is finite, and every joint is shared
//   (4) a token goes on where it was given: the answers after it are those of the unbroken stream,
//       and a changed token is refused
//   (5) no memory stays counted
//
// The first byte chooses the form of the input:
//   {     lines, each of them a request of CompensatePath in JSON
//   [     the same of CompensateProgram, after this one character
//   0, 1  requests of CompensatePath, CompensateProgram framed as on the wire: a flag, four bytes
//   of
//         length, big endian, and the message
//   else  the bytes choose a valid path, sent in batches of both layouts

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/compensated_block.h"
#include "server/rpc/compensate_path.h"
#include "server/rpc/compensate_program.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/fuzzed_path.h"

namespace trc::fuzz {
namespace {

using server::Turn;

server::Backend& backend() {
  static server::Backend backend(
      [] {
        server::Config config;
        config.worker_threads = 1;
        config.log_level = "off";
        return config;
      }(),
      std::string(32, 'k'));
  return backend;
}

struct Path {
  using Request = v1::CompensatePathRequest;
  using Response = v1::CompensatePathResponse;
  using Work = server::CompensatePath;
  static constexpr server::Method method = server::Method::compensate_path;
  static v1::PathSetup& setup_of(Request& request) { return *request.mutable_setup(); }
};

struct Program {
  using Request = v1::CompensateProgramRequest;
  using Response = v1::CompensateProgramResponse;
  using Work = server::CompensateProgram;
  static constexpr server::Method method = server::Method::compensate_program;
  static v1::PathSetup& setup_of(Request& request) {
    return *request.mutable_setup()->mutable_path();
  }
};

// The answers of one stream, and with which status it ended.
template <class Rpc>
struct Answers {
  std::vector<typename Rpc::Response> responses{};
  std::vector<std::size_t> behind{};  // how many responses there were after each request
  grpc::Status status{};
};

void claim_named(const server::Ending& ending) {
  const grpc::Status& status = ending.status;
  claim(status.error_code() != grpc::INTERNAL && status.error_code() != grpc::UNKNOWN,
        status.error_message());
  google::rpc::Status details;
  google::rpc::ErrorInfo error;
  claim(details.ParseFromString(status.error_details()) && details.details_size() > 0 &&
            details.details(0).UnpackTo(&error) && !error.reason().empty(),
        "A status without a reason");
}

template <class Rpc>
Answers<Rpc> play(std::span<const typename Rpc::Request> requests) {
  server::CallRecord record(backend().telemetry, Rpc::method, "fuzz", {});
  const std::atomic<bool> cancelled = false;
  const auto peer = backend().peers.of("fuzz");
  server::StreamAccount account(backend(), *peer);
  // Else the time that its limits count would be that of all inputs before.
  const server::StreamAccount::Turn turn_of_all(account);
  typename Rpc::Work work({backend(), record, cancelled, account});
  Answers<Rpc> answers;
  typename Rpc::Response response;
  // Whether the stream goes on.
  const auto conclude = [&](Turn turn) {
    while (true) {
      if (turn.write) answers.responses.push_back(response);
      if (turn.next == Turn::Next::read) return true;
      if (turn.next == Turn::Next::finish) {
        claim(!turn.write, "An answer and the end in one turn");
        answers.status = turn.ending.status;
        if (!answers.status.ok()) claim_named(turn.ending);
        return false;
      }
      turn = work.proceed(response);
    }
  };
  for (const auto& request : requests) {
    const std::size_t before = answers.responses.size();
    if (!conclude(work.take(request, response))) return answers;
    claim(answers.responses.size() > before, "A request without an answer");
    answers.behind.push_back(answers.responses.size());
  }
  claim(!conclude(work.ended(response)), "A stream that does not end");
  const bool summed_up = !answers.responses.empty() && answers.responses.back().has_summary();
  claim(answers.status.ok() == summed_up, "OK and the summary belong together");
  return answers;
}

// What a client would make of the answers.
template <class Rpc>
std::vector<CompensatedBlock> read(const Answers<Rpc>& answers, const v1::PathSetup& setup) {
  wire::FieldFaults faults;
  wire::CompensatedReader reader(
      wire::from_proto(setup, wire::FieldPath("setup"), faults).session.program.start);
  std::vector<CompensatedBlock> blocks;
  for (const auto& response : answers.responses) {
    if (response.has_batch()) reader.read(response.batch(), blocks, faults);
    if (response.has_columns()) reader.read(response.columns(), blocks, faults);
  }
  claim(faults.empty(), "Answers that cannot be read");
  return blocks;
}

// Times differ from run to run.
template <class Response>
std::string text_of(Response response) {
  if (response.has_summary()) {
    v1::PathSummary* summary = nullptr;
    if constexpr (std::is_same_v<Response, v1::CompensatePathResponse>)
      summary = response.mutable_summary();
    else
      summary = response.mutable_summary()->mutable_path();
    summary->clear_wall_time_seconds();
    summary->clear_cpu_time_seconds();
  }
  return response.ShortDebugString();
}

// Goes on after a few of the requests whose last answer has a token.
template <class Rpc>
void check_tokens(const std::vector<typename Rpc::Request>& requests,
                  const Answers<Rpc>& unbroken) {
  constexpr std::size_t tries = 3;
  const std::size_t stride = 1 + unbroken.behind.size() / tries;
  for (std::size_t cut = 1; cut < unbroken.behind.size(); cut += stride) {
    const std::size_t begin = unbroken.behind[cut];
    const std::string& token = unbroken.responses[begin - 1].resume_token();
    if (token.empty()) continue;
    std::vector<typename Rpc::Request> rest(requests.begin() + static_cast<std::ptrdiff_t>(cut),
                                            requests.end());
    rest.front() = requests.front();
    v1::PathSetup& setup = Rpc::setup_of(rest.front());
    setup.set_resume_token(token);
    const Answers<Rpc> resumed = play<Rpc>(rest);
    claim(resumed.status.error_code() == unbroken.status.error_code() &&
              resumed.responses.size() == unbroken.responses.size() - begin + 1,
          "A resumed stream ends otherwise");
    for (std::size_t i = begin; i < unbroken.responses.size(); ++i)
      claim(text_of(resumed.responses[i - begin + 1]) == text_of(unbroken.responses[i]),
            "A resumed stream answers otherwise");

    (*setup.mutable_resume_token())[cut * 37 % token.size()] ^= 1;
    const Answers<Rpc> changed = play<Rpc>(rest);
    claim(changed.responses.empty() && !changed.status.ok(), "A changed token was taken");
  }
}

template <class Rpc>
void check(std::vector<typename Rpc::Request> requests) {
  const TimeBound bound;
  const Answers<Rpc> answers = play<Rpc>(requests);
  if (!answers.behind.empty()) {
    claim_path(read(answers, Rpc::setup_of(requests.front())));
    // A token the fuzzer has brought along is gone from here on.
    Rpc::setup_of(requests.front()).clear_resume_token();
    check_tokens<Rpc>(requests, answers);
  }
  claim(backend().memory.used_bytes() == 0, "Memory stays counted");
}

template <class Request>
std::vector<Request> from_json(std::string_view text) {
  std::vector<Request> requests;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    Request request;
    if (google::protobuf::util::JsonStringToMessage(std::string(line), &request).ok())
      requests.push_back(std::move(request));
  }
  return requests;
}

// The length is cut to what is there.
template <class Request>
std::vector<Request> from_frames(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t head = 5;
  std::vector<Request> requests;
  while (bytes.size() > head) {
    const std::size_t length = std::size_t{bytes[1]} << 24U | std::size_t{bytes[2]} << 16U |
                               std::size_t{bytes[3]} << 8U | bytes[4];
    bytes = bytes.subspan(head);
    const auto message = bytes.first(std::min(length, bytes.size()));
    bytes = bytes.subspan(message.size());
    Request request;
    // gRPC ends a stream with such a message before the service gets it.
    if (!request.ParseFromArray(message.data(), static_cast<int>(message.size()))) break;
    requests.push_back(std::move(request));
  }
  return requests;
}

// Batches of both layouts by turns.
std::vector<v1::CompensatePathRequest> requests_of(const FuzzedPath& path) {
  std::vector<v1::CompensatePathRequest> requests(1);
  wire::to_proto(path.settings, *requests.front().mutable_setup());
  wire::BlockWriter writer;
  std::span<const wire::PathInput> items(path.items);
  do {
    const auto batch = items.first(std::min(path.cut, items.size()));
    items = items.subspan(batch.size());
    v1::CompensatePathRequest& request = requests.emplace_back();
    const auto write = [&](auto& message) {
      writer.write(batch, message);
      message.set_final(items.empty());
    };
    if (requests.size() % 2 == 0)
      write(*request.mutable_batch());
    else
      write(*request.mutable_columns());
  } while (!items.empty());
  return requests;
}

void check(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  switch (bytes.front()) {
    case '{':
      return check<Path>(from_json<v1::CompensatePathRequest>(text));
    case '[':
      return check<Program>(from_json<v1::CompensateProgramRequest>(text.substr(1)));
    case 0:
      return check<Path>(from_frames<v1::CompensatePathRequest>(bytes));
    case 1:
      return check<Program>(from_frames<v1::CompensateProgramRequest>(bytes));
    default:
      return check<Path>(requests_of(fuzzed_path(bytes.subspan(1))));
  }
}

}  // namespace
}  // namespace trc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  trc::fuzz::check({bytes, size});
  return 0;
}
