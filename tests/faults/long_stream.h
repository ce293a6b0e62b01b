#pragma once

#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "tests/server/calls.h"
#include "trc/v1/trc_service.grpc.pb.h"

namespace trc::faults {

// A program of so many laps of one circle: each block is near those of all laps, which under G141
// and to a verification is as long a work as there is.
[[nodiscard]] std::string laps(int count, std::string_view head = "G141\n");

// A stream of CompensateProgram that has sent all of its program, from a byte on, and of which
// nothing is read until its end.
class LongStream {
 public:
  LongStream(const std::shared_ptr<grpc::Channel>& channel, const std::string& text,
             const v1::ProgramSetup& setup = {}, std::size_t first_byte = 0);
  ~LongStream();
  LongStream(const LongStream&) = delete;
  LongStream& operator=(const LongStream&) = delete;

  // What it has answered.
  server::StreamAnswer end();

 private:
  grpc::ClientContext context_;
  std::unique_ptr<v1::TrcService::Stub> stub_;
  std::unique_ptr<
      grpc::ClientReaderWriter<v1::CompensateProgramRequest, v1::CompensateProgramResponse>>
      stream_;
  server::StreamAnswer answer_;
  bool ended_ = false;
};

}  // namespace trc::faults
