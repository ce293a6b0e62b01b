#include "tests/faults/long_stream.h"

#include <cmath>
#include <numbers>

namespace trc::faults {

std::string laps(int count, std::string_view head) {
  constexpr int blocks_of_lap = 100;
  constexpr double radius = 20;
  std::string text = std::string(head) + "G1 G41 V.G.WZ_AKT.R=0.5 X20 Y0 F800\n";
  for (int i = 1; i <= count * blocks_of_lap; ++i) {
    const double angle = 2 * std::numbers::pi * i / blocks_of_lap;
    text += "X" + std::to_string(radius * std::cos(angle)) + " Y" +
            std::to_string(radius * std::sin(angle)) + "\n";
  }
  return text + "G40\nX0 Y0\nM30\n";
}

LongStream::LongStream(const std::shared_ptr<grpc::Channel>& channel, const std::string& text,
                       const v1::ProgramSetup& setup, std::size_t first_byte)
    : stub_(v1::TrcService::NewStub(channel)), stream_(stub_->CompensateProgram(&context_)) {
  stream_->Write(server::setup_request(setup));
  constexpr std::size_t piece = 512U << 10U;
  for (std::size_t at = first_byte; at < text.size(); at += piece)
    stream_->Write(server::text_request(at, text.substr(at, piece), at + piece >= text.size()));
  stream_->WritesDone();
}

LongStream::~LongStream() {
  context_.TryCancel();
  end();
}

server::StreamAnswer LongStream::end() {
  if (ended_) return answer_;
  ended_ = true;
  v1::CompensateProgramResponse response;
  while (stream_->Read(&response)) answer_.text += response.nc_text();
  answer_.status = stream_->Finish();
  return answer_;
}

}  // namespace trc::faults
