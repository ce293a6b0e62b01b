#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/session/path_session.h"
#include "proto/wire/block.h"
#include "proto/wire/compensated_batch_bytes.h"
#include "proto/wire/compensated_block.h"
#include "tests/bench/part.h"
#include "tests/bench/timed.h"

// Messages of both layouts, 1000 blocks each: converting them, their bytes, and what a stream of
// CompensatePath takes without its transport. Time a programmed block; of a response, time
// a compensated block.

namespace trc::bench {
namespace {

void require(bool going) {
  if (!going) throw std::runtime_error("the sample contour is refused");
}

wire::PathInput input_of(const Block& block) {
  const auto& motion = std::get<MotionBlock>(block);
  MoveRequest move{.source = motion.source, .feed = motion.feed};
  const Point& end = end_of(motion.path);
  move.end = {end.x(), end.y(), std::nullopt};
  if (const Arc* arc = std::get_if<Arc>(&motion.path)) {
    const Vector center = arc->center - arc->start;
    move.kind = arc->sweep < 0 ? MotionKind::clockwise : MotionKind::counter_clockwise;
    move.center = {center.x(), center.y(), std::nullopt};
  }
  return move;
}

std::vector<wire::PathInput> inputs_of(const std::vector<Block>& blocks) {
  std::vector<wire::PathInput> inputs;
  for (const Block& block : blocks) inputs.push_back(input_of(block));
  return inputs;
}

SessionSetup session_setup() {
  SessionSetup setup;
  const TrcMode& mode = *std::get<MotionBlock>(part().lap_blocks.front()).mode;
  setup.program.mode.tool_radius = mode.tool_radius;
  setup.program.mode.transition = mode.transition;
  return setup;
}

// The session of a stream that is on its way round the contour.
class Stream {
 public:
  Stream() {
    Answers out;
    const std::vector<wire::PathInput> approach = inputs_of(part().approach);
    give(approach.front(), out);
    session_.program().select(Side::right, {});
    give(approach.back(), out);
    advance(out);
  }

  bool give(const wire::PathInput& input, Answers& out) {
    constexpr std::size_t group = 256;  // as the server
    return wire::apply(input, session_.program()) && (++items_ % group != 0 || advance(out));
  }
  bool advance(Answers& out) { return session_.advance(out); }

 private:
  PathSession session_{session_setup()};
  std::size_t items_ = 0;
};

std::vector<CompensatedBlock> compensated_lap() {
  Stream stream;
  Answers out;
  for (const Block& block : part().lap_blocks) require(stream.give(input_of(block), out));
  require(stream.advance(out));
  return out.take().blocks;
}

template <class Batch>
Batch request_batch() {
  Batch batch;
  wire::BlockWriter().write(inputs_of(part().lap_blocks), batch);
  return batch;
}

template <class Batch>
void read_request(benchmark::State& state) {
  const auto batch = request_batch<Batch>();
  wire::BlockReader reader(6);
  wire::FieldFaults faults;
  run_timed(
      state, Part::blocks_per_lap, [] {},
      [&] {
        reader.read(
            batch,
            [](const wire::PathInput& input) {
              benchmark::DoNotOptimize(&input);
              return true;
            },
            faults);
      });
  require(faults.empty());
}

template <class Batch>
void write_request(benchmark::State& state) {
  const std::vector<wire::PathInput> inputs = inputs_of(part().lap_blocks);
  wire::BlockWriter writer;
  Batch batch;
  run_timed(
      state, Part::blocks_per_lap, [] {}, [&] { writer.write(inputs, batch); });
}

template <class Batch>
void write_response(benchmark::State& state) {
  const std::vector<CompensatedBlock> blocks = compensated_lap();
  Batch batch;
  run_timed(
      state, blocks.size(), [] {}, [&] { wire::to_proto(blocks, 0, batch); });
}

template <class Batch>
void read_response(benchmark::State& state) {
  const std::vector<CompensatedBlock> blocks = compensated_lap();
  Batch batch;
  wire::to_proto(blocks, 0, batch);
  wire::CompensatedReader reader({});
  wire::FieldFaults faults;
  std::vector<CompensatedBlock> out;
  run_timed(
      state, blocks.size(),
      [&] {
        batch.set_first_block(reader.next_block());
        out.clear();
      },
      [&] { reader.read(batch, out, faults); });
  require(faults.empty());
}

template <class Message>
void serialize(benchmark::State& state, const Message& message, std::size_t blocks) {
  std::string bytes;
  run_timed(
      state, blocks, [&] { bytes.clear(); }, [&] { message.SerializeToString(&bytes); });
  state.counters["bytes"] = static_cast<double>(bytes.size()) / static_cast<double>(blocks);
}

template <class Message>
void parse(benchmark::State& state, const Message& message, std::size_t blocks) {
  const std::string bytes = message.SerializeAsString();
  Message parsed;
  run_timed(
      state, blocks, [] {}, [&] { require(parsed.ParseFromString(bytes)); });
}

template <class Batch>
Batch response_batch(std::size_t& blocks) {
  const std::vector<CompensatedBlock> compensated = compensated_lap();
  blocks = compensated.size();
  Batch batch;
  wire::to_proto(compensated, 0, batch);
  return batch;
}

// Filling and serializing in one, as the server does it for blocks as messages.
void write_response_bytes(benchmark::State& state) {
  const std::vector<CompensatedBlock> blocks = compensated_lap();
  std::string bytes;
  run_timed(
      state, blocks.size(), [&] { bytes.clear(); }, [&] { wire::append_batch(blocks, 0, bytes); });
}

void write_answer(std::span<const CompensatedBlock> blocks, v1::CompensatedColumns& message,
                  std::string& answer) {
  wire::to_proto(blocks, 0, message);
  message.SerializeToString(&answer);
}
void write_answer(std::span<const CompensatedBlock> blocks, v1::CompensatedBatch& /*message*/,
                  std::string& answer) {
  answer.clear();
  wire::append_batch(blocks, 0, answer);
}

// What the server does with one request, and no transport.
template <class Request, class Response>
void served(benchmark::State& state) {
  const std::string bytes = request_batch<Request>().SerializeAsString();
  Stream stream;
  Request request;
  Response response;
  wire::BlockReader reader(6);
  wire::FieldFaults faults;
  Answers out;
  std::string answer;
  run_timed(
      state, Part::blocks_per_lap, [] {},
      [&] {
        out.blocks().clear();
        require(request.ParseFromString(bytes));
        reader.read(
            request, [&](const wire::PathInput& input) { return stream.give(input, out); }, faults);
        require(stream.advance(out));
        write_answer(out.blocks(), response, answer);
      });
  require(faults.empty() && !out.blocks().empty());
}

template <class Request, class Response>
void add_layout(const std::string& layout) {
  const auto name = [&](const char* what) { return "wire: " + (what + (" " + layout)); };
  add(name("read request").c_str(), read_request<Request>);
  add(name("write request").c_str(), write_request<Request>);
  add(name("read response").c_str(), read_response<Response>);
  add(name("write response").c_str(), write_response<Response>);
  add(name("serialize request").c_str(), [](benchmark::State& state) {
    serialize(state, request_batch<Request>(), Part::blocks_per_lap);
  });
  add(name("parse request").c_str(), [](benchmark::State& state) {
    parse(state, request_batch<Request>(), Part::blocks_per_lap);
  });
  add(name("serialize response").c_str(), [](benchmark::State& state) {
    std::size_t blocks = 0;
    const auto batch = response_batch<Response>(blocks);
    serialize(state, batch, blocks);
  });
  add(name("parse response").c_str(), [](benchmark::State& state) {
    std::size_t blocks = 0;
    const auto batch = response_batch<Response>(blocks);
    parse(state, batch, blocks);
  });
  add(name("served").c_str(), served<Request, Response>);
}

const bool registered = [] {
  add_layout<v1::BlockColumns, v1::CompensatedColumns>("columns");
  add_layout<v1::BlockBatch, v1::CompensatedBatch>("blocks");
  add("wire: write response blocks as bytes", write_response_bytes);
  return true;
}();

}  // namespace
}  // namespace trc::bench
