#include "client/load/conversation.h"

#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/proto_buffer_reader.h>
#include <grpcpp/support/proto_buffer_writer.h>

#include <vector>

#include "client/trc/received.h"
#include "proto/wire/compensated_block.h"

namespace trc::load {
namespace {

template <class Message>
grpc::ByteBuffer bytes_of(const Message& message) {
  grpc::ByteBuffer bytes;
  bool own = false;
  const grpc::Status status = grpc::SerializationTraits<Message>::Serialize(message, &bytes, &own);
  return status.ok() ? bytes : grpc::ByteBuffer();
}

template <class Message>
bool parse(grpc::ByteBuffer& bytes, Message& message) {
  return grpc::SerializationTraits<Message>::Deserialize(&bytes, &message).ok();
}

// Messages keep their memory between uses. A thread uses one message at a time, for any of its
// streams.
template <class Message>
Message& of_this_thread() {
  thread_local Message message;
  return message;
}

class PathConversation final : public Conversation {
 public:
  PathConversation(const Job& job, ResultCheck* check)
      : job_(job), check_(check), reader_(start_of(job)) {}

  [[nodiscard]] grpc::ByteBuffer setup() const override {
    v1::CompensatePathRequest request;
    *request.mutable_setup() = job_.setup().path();
    return bytes_of(request);
  }

  grpc::ByteBuffer next() override {
    auto& request = of_this_thread<v1::CompensatePathRequest>();
    if (job_.layout() == Layout::columns)
      job_.write(batch_, *request.mutable_columns());
    else
      job_.write(batch_, *request.mutable_batch());
    ++batch_;
    return bytes_of(request);
  }
  [[nodiscard]] bool at_end() const override { return batch_ == job_.batches(); }
  [[nodiscard]] std::uint64_t position() const override {
    return std::min(batch_ * job_.batch(), job_.items());
  }

  Response read(grpc::ByteBuffer& bytes) override {
    auto& message = of_this_thread<client::Received<v1::CompensatePathResponse>>().fresh();
    Response response{.readable = parse(bytes, message)};
    if (!response.readable) return response;
    response.summary = message.has_summary();
    response.window = message.accepted().max_batches_in_flight();
    if (message.has_columns()) response.blocks_out = message.columns().kinds().size();
    if (message.has_batch())
      response.blocks_out = static_cast<std::uint64_t>(message.batch().blocks_size());
    response.output = response.blocks_out > 0;
    if (message.has_consumed_through_block())
      response.consumed = message.consumed_through_block() + 1;
    if (check_ != nullptr) response.readable = check(message);
    return response;
  }

 private:
  static Position start_of(const Job& job) {
    const v1::Position& start = job.setup().path().start_position();
    return {start.x(), start.y(), start.z()};
  }

  bool check(const v1::CompensatePathResponse& message) {
    std::vector<CompensatedBlock> blocks;
    wire::FieldFaults faults;
    if (message.has_columns()) reader_.read(message.columns(), blocks, faults);
    if (message.has_batch()) reader_.read(message.batch(), blocks, faults);
    for (const CompensatedBlock& block : blocks) check_->add(block);
    return faults.empty();
  }

  const Job& job_;
  ResultCheck* check_;
  wire::CompensatedReader reader_;
  std::uint64_t batch_ = 0;
};

class ProgramConversation final : public Conversation {
 public:
  ProgramConversation(const Job& job, ResultCheck* check) : job_(job), check_(check) {}

  [[nodiscard]] grpc::ByteBuffer setup() const override {
    v1::CompensateProgramRequest request;
    *request.mutable_setup() = job_.setup();
    return bytes_of(request);
  }

  grpc::ByteBuffer next() override {
    auto& request = of_this_thread<v1::CompensateProgramRequest>();
    v1::ProgramText& text = *request.mutable_text();
    job_.write(batch_++, text);
    text.set_first_byte(bytes_);
    bytes_ += text.text().size();
    return bytes_of(request);
  }
  [[nodiscard]] bool at_end() const override { return batch_ == job_.batches(); }
  [[nodiscard]] std::uint64_t position() const override { return bytes_; }

  Response read(grpc::ByteBuffer& bytes) override {
    auto& message = of_this_thread<v1::CompensateProgramResponse>();
    Response response{.readable = parse(bytes, message)};
    if (!response.readable) return response;
    response.summary = message.has_summary();
    response.window = message.accepted().max_batches_in_flight();
    response.blocks_out = message.summary().path().blocks_out();
    response.output = !message.nc_text().empty();
    response.consumed = message.consumed_bytes();
    if (check_ != nullptr) check_->add(std::string_view(message.nc_text()));
    return response;
  }

 private:
  const Job& job_;
  ResultCheck* check_;
  std::uint64_t batch_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

std::string method_of(Layout layout) {
  return layout == Layout::text ? "/trc.v1.TrcService/CompensateProgram"
                                : "/trc.v1.TrcService/CompensatePath";
}

std::unique_ptr<Conversation> converse(const Job& job, ResultCheck* check) {
  if (job.layout() == Layout::text) return std::make_unique<ProgramConversation>(job, check);
  return std::make_unique<PathConversation>(job, check);
}

}  // namespace trc::load
