#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "server/http/run.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {

// The requests of CompensateProgram for a whole text.
class ProgramQuestions final : public Questions {
 public:
  ProgramQuestions(const v1::ProgramSetup& setup, std::string text, std::size_t most_message_bytes)
      : text_(std::move(text)), piece_bytes_(std::min(piece_bytes, most_message_bytes / 2)) {
    *message_.mutable_setup() = setup;
  }

  grpc::ByteBuffer next(bool& last) override {
    if (std::exchange(set_up_, true)) {
      v1::ProgramText& piece = *message_.mutable_text();
      piece.set_first_byte(at_);
      piece.set_text(text_.substr(at_, piece_bytes_));
      at_ = std::min(at_ + piece_bytes_, text_.size());
      piece.set_final(at_ == text_.size());
      last = piece.final();
    }
    return RpcCall::bytes_of(message_);
  }

 private:
  static constexpr std::size_t piece_bytes = 256U << 10U;

  std::string text_;
  std::size_t piece_bytes_;
  std::size_t at_ = 0;
  bool set_up_ = false;
  v1::CompensateProgramRequest message_;
};

}  // namespace trc::server::http
