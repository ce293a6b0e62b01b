#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "server/http/rpc_exchange.h"
#include "trc/v1/trc_service.pb.h"

namespace trc::server::http {

// The requests of CompensateProgram, or of another RPC that takes a setup and text, for a whole
// text.
template <class Request, class Setup>
class TextQuestions final : public Questions {
 public:
  TextQuestions(const Setup& setup, std::shared_ptr<const std::string> text,
                std::size_t most_message_bytes)
      : text_(std::move(text)), piece_bytes_(std::min(piece_bytes, most_message_bytes / 2)) {
    *message_.mutable_setup() = setup;
  }

  grpc::ByteBuffer next(bool& last) override {
    if (std::exchange(set_up_, true)) {
      v1::ProgramText& piece = *message_.mutable_text();
      piece.set_first_byte(at_);
      piece.set_text(text_->substr(at_, piece_bytes_));
      at_ = std::min(at_ + piece_bytes_, text_->size());
      piece.set_final(at_ == text_->size());
      last = piece.final();
    }
    return RpcCall::bytes_of(message_);
  }

 private:
  static constexpr std::size_t piece_bytes = 256U << 10U;

  std::shared_ptr<const std::string> text_;
  std::size_t piece_bytes_;
  std::size_t at_ = 0;
  bool set_up_ = false;
  Request message_;
};

using ProgramQuestions = TextQuestions<v1::CompensateProgramRequest, v1::ProgramSetup>;
using SurveyQuestions = TextQuestions<v1::SurveyRadiiRequest, v1::SurveySetup>;

}  // namespace trc::server::http
