#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <memory>
#include <string>

#include "client/load/digest.h"
#include "client/load/job.h"

namespace trc::load {

// What one response says.
struct Response {
  bool readable = false;
  bool summary = false;
  bool output = false;           // blocks or text
  std::uint32_t window = 0;      // of the response that accepts the stream
  std::uint64_t blocks_out = 0;  // of text, all of them with the summary
  std::uint64_t consumed = 0;    // the input position after what is answered; 0: not said
};

// The messages of one stream, in the bytes gRPC carries: the requests one after the other, and what
// the responses say. Their size is known here, and large ones are not held longer than they need.
class Conversation {
 public:
  virtual ~Conversation() = default;

  [[nodiscard]] virtual grpc::ByteBuffer setup() const = 0;
  // The next batch, until `at_end`. Not while another thread calls it.
  [[nodiscard]] virtual grpc::ByteBuffer next() = 0;
  [[nodiscard]] virtual bool at_end() const = 0;
  // The input position after the last batch.
  [[nodiscard]] virtual std::uint64_t position() const = 0;

  [[nodiscard]] virtual Response read(grpc::ByteBuffer& bytes) = 0;
};

// "/trc.v1.TrcService/CompensatePath" or …/CompensateProgram.
[[nodiscard]] std::string method_of(Layout layout);

// `check` gets the result; none: nothing is compared.
[[nodiscard]] std::unique_ptr<Conversation> converse(const Job& job, ResultCheck* check);

}  // namespace trc::load
