#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::server {

// What a stream has answered, put together.
struct StreamAnswer {
  grpc::Status status;
  int accepted = 0;
  int summaries = 0;
  std::string text;
  std::vector<v1::CompensatedBlock> blocks;
  std::vector<v1::Diagnostic> diagnostics;
  v1::PathSummary path_summary;
  v1::ProgramSummary program_summary;
  std::uint64_t consumed = 0;
  int responses = 0;

  // "APPROACH 0 0 -> 30 30" and so on, one line a block, rounded to 1e-4 mm.
  [[nodiscard]] std::string listing() const;
  // Every bit of every block and diagnostic.
  [[nodiscard]] std::string bytes() const;
  // ErrorInfo.reason, empty without.
  [[nodiscard]] std::string reason() const;
  [[nodiscard]] std::string metadata(const std::string& key) const;
};

// Sends all requests and then half-closes, while reading. Ends after 60 s at the latest.
StreamAnswer call_path(const std::shared_ptr<grpc::Channel>& channel,
                       const std::vector<v1::CompensatePathRequest>& requests);
StreamAnswer call_program(const std::shared_ptr<grpc::Channel>& channel,
                          const std::vector<v1::CompensateProgramRequest>& requests);
StreamAnswer call_preview(const std::shared_ptr<grpc::Channel>& channel,
                          const v1::PreviewPathRequest& request);

v1::CompensateProgramRequest setup_request(const v1::ProgramSetup& setup);
v1::CompensatePathRequest setup_request(const v1::PathSetup& setup);
v1::CompensateProgramRequest text_request(std::uint64_t first_byte, std::string_view text,
                                          bool final);

// A program sent in pieces that end at the given bytes.
StreamAnswer run_program(const std::shared_ptr<grpc::Channel>& channel,
                         const v1::ProgramSetup& setup, std::string_view text,
                         const std::vector<std::size_t>& cuts = {});
v1::ProgramSetup blocks_setup(v1::ResponseLayout layout = v1::RESPONSE_LAYOUT_BLOCKS);

// A line of a path, G01.
v1::Block line_to(double x, double y);
v1::Block command(v1::CompensationSide side);
v1::CompensatePathRequest batch(std::uint64_t first_block, const std::vector<v1::Block>& blocks,
                                bool final);

// Tries until it holds, at most so long.
bool eventually(const std::function<bool()>& holds, double seconds = 20);

// Lines of the G239 example T-01, tool radius 10.
extern const std::string_view g239_program;

}  // namespace trc::server
