#include "tests/server/calls.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "proto/wire/compensated_block.h"
#include "tests/support/process.h"

namespace trc::server {
namespace {

constexpr auto longest_call = std::chrono::seconds(60) * testing_support::times_slower;

google::rpc::ErrorInfo error_info(const grpc::Status& status) {
  google::rpc::Status rich;
  google::rpc::ErrorInfo info;
  if (!rich.ParseFromString(status.error_details())) return info;
  for (const auto& detail : rich.details())
    if (detail.UnpackTo(&info)) break;
  return info;
}

std::string coordinates(const v1::Position& position) {
  std::array<char, 64> text{};
  // Adding 0 turns -0 into 0.
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4 + 0.0; };
  std::snprintf(text.data(), text.size(), "%.10g %.10g", rounded(position.x()),
                rounded(position.y()));
  return text.data();
}

// Reads blocks of both layouts; a block is the same in either.
class Collector {
 public:
  explicit Collector(StreamAnswer& answer) : answer_(answer) {}

  template <class Response>
  void take(const Response& response) {
    ++answer_.responses;
    if (response.has_batch()) {
      EXPECT_EQ(response.batch().first_block(), answer_.blocks.size());
      for (const auto& block : response.batch().blocks()) answer_.blocks.push_back(block);
    }
    if (response.has_columns()) take_columns(response.columns());
    for (const auto& diagnostic : response.diagnostics()) answer_.diagnostics.push_back(diagnostic);
    if (response.has_summary()) {
      ++answer_.summaries;
      set_summary(response.summary());
    }
  }

 private:
  void take_columns(const v1::CompensatedColumns& columns) {
    EXPECT_EQ(columns.first_block(), answer_.blocks.size());
    std::vector<CompensatedBlock> native;
    wire::FieldFaults faults;
    EXPECT_TRUE(reader_.read(columns, native, faults));
    for (const CompensatedBlock& block : native)
      wire::to_proto(block, answer_.blocks.emplace_back());
  }
  void set_summary(const v1::PathSummary& summary) { answer_.path_summary = summary; }
  void set_summary(const v1::ProgramSummary& summary) {
    answer_.program_summary = summary;
    answer_.path_summary = summary.path();
  }

  StreamAnswer& answer_;
  wire::CompensatedReader reader_{Position{}};
};

// Writes from a thread of its own: neither side may wait for the other to finish.
template <class Stream, class Request, class Response, class Take>
void exchange(Stream& stream, const std::vector<Request>& requests, Response& response,
              const Take& take) {
  std::thread writer([&] {
    for (const Request& request : requests)
      if (!stream.Write(request)) return;
    stream.WritesDone();
  });
  while (stream.Read(&response)) take(response);
  writer.join();
}

}  // namespace

std::string StreamAnswer::listing() const {
  std::string lines;
  for (const v1::CompensatedBlock& block : blocks) {
    if (!lines.empty()) lines += '\n';
    lines += v1::CompensatedBlock::Origin_Name(block.origin()) + ' ';
    if (block.has_passthrough()) {
      lines += block.passthrough().text();
      continue;
    }
    lines += coordinates(block.start()) + (block.has_arc() ? " ~> " : " -> ") +
             coordinates(block.has_arc() ? block.arc().end() : block.line().end());
  }
  return lines;
}

std::string StreamAnswer::bytes() const {
  std::string all = text;
  for (const auto& block : blocks) all += block.SerializeAsString();
  for (const auto& diagnostic : diagnostics) all += diagnostic.ShortDebugString();
  return all;
}

std::string StreamAnswer::reason() const { return error_info(status).reason(); }

std::string StreamAnswer::metadata(const std::string& key) const {
  const auto info = error_info(status);
  const auto found = info.metadata().find(key);
  return found == info.metadata().end() ? std::string() : found->second;
}

StreamAnswer call_path(const std::shared_ptr<grpc::Channel>& channel,
                       const std::vector<v1::CompensatePathRequest>& requests) {
  StreamAnswer answer;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + longest_call);
  const auto stub = v1::TrcService::NewStub(channel);
  const auto stream = stub->CompensatePath(&context);
  Collector collector(answer);
  v1::CompensatePathResponse response;
  exchange(*stream, requests, response, [&](const v1::CompensatePathResponse& got) {
    if (got.has_accepted()) ++answer.accepted;
    if (got.has_consumed_through_block()) answer.consumed = got.consumed_through_block();
    collector.take(got);
  });
  answer.status = stream->Finish();
  return answer;
}

StreamAnswer call_program(const std::shared_ptr<grpc::Channel>& channel,
                          const std::vector<v1::CompensateProgramRequest>& requests) {
  StreamAnswer answer;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + longest_call);
  const auto stub = v1::TrcService::NewStub(channel);
  const auto stream = stub->CompensateProgram(&context);
  Collector collector(answer);
  v1::CompensateProgramResponse response;
  exchange(*stream, requests, response, [&](const v1::CompensateProgramResponse& got) {
    if (got.has_accepted()) ++answer.accepted;
    if (got.consumed_bytes() > 0) answer.consumed = got.consumed_bytes();
    answer.text += got.nc_text();
    collector.take(got);
  });
  answer.status = stream->Finish();
  return answer;
}

StreamAnswer call_preview(const std::shared_ptr<grpc::Channel>& channel,
                          const v1::PreviewPathRequest& request) {
  StreamAnswer answer;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + longest_call);
  const auto stub = v1::TrcService::NewStub(channel);
  const auto stream = stub->PreviewPath(&context, request);
  Collector collector(answer);
  v1::PreviewPathResponse response;
  while (stream->Read(&response)) collector.take(response);
  answer.status = stream->Finish();
  return answer;
}

v1::CompensateProgramRequest setup_request(const v1::ProgramSetup& setup) {
  v1::CompensateProgramRequest request;
  *request.mutable_setup() = setup;
  return request;
}

v1::CompensatePathRequest setup_request(const v1::PathSetup& setup) {
  v1::CompensatePathRequest request;
  *request.mutable_setup() = setup;
  return request;
}

v1::CompensateProgramRequest text_request(std::uint64_t first_byte, std::string_view text,
                                          bool final) {
  v1::CompensateProgramRequest request;
  request.mutable_text()->set_first_byte(first_byte);
  request.mutable_text()->set_text(std::string(text));
  request.mutable_text()->set_final(final);
  return request;
}

StreamAnswer run_program(const std::shared_ptr<grpc::Channel>& channel,
                         const v1::ProgramSetup& setup, std::string_view text,
                         const std::vector<std::size_t>& cuts) {
  std::vector<v1::CompensateProgramRequest> requests{setup_request(setup)};
  std::size_t from = 0;
  for (const std::size_t cut : cuts) {
    requests.push_back(text_request(from, text.substr(from, cut - from), false));
    from = cut;
  }
  requests.push_back(text_request(from, text.substr(from), true));
  return call_program(channel, requests);
}

v1::ProgramSetup blocks_setup(v1::ResponseLayout layout) {
  v1::ProgramSetup setup;
  setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  setup.mutable_path()->set_response_layout(layout);
  return setup;
}

v1::Block line_to(double x, double y) {
  v1::Block block;
  block.mutable_linear()->mutable_end()->set_x(x);
  block.mutable_linear()->mutable_end()->set_y(y);
  block.mutable_linear()->set_feed(1000);
  return block;
}

v1::Block command(v1::CompensationSide side) {
  v1::Block block;
  block.mutable_command()->set_side(side);
  return block;
}

v1::CompensatePathRequest batch(std::uint64_t first_block, const std::vector<v1::Block>& blocks,
                                bool final) {
  v1::CompensatePathRequest request;
  request.mutable_batch()->set_first_block(first_block);
  for (const v1::Block& block : blocks) *request.mutable_batch()->add_blocks() = block;
  request.mutable_batch()->set_final(final);
  return request;
}

bool eventually(const std::function<bool()>& holds, double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

const std::string_view g239_program =
    "N10 G0 X0 Y0\n"
    "N20 G239\n"
    "N30 V.G.WZ_AKT.R = 10\n"
    "N40 G41 G01 X30 Y20 F1000\n"
    "N50 X60\n"
    "N60 X90\n"
    "N70 X120\n"
    "N80 G40\n"
    "N90 G00 X150 Y0\n"
    "N100 M30\n";

}  // namespace trc::server
