// Numbers at the ends of their types in every field that a client can set: what is asked is
// answered, or refused in words of the request, and never a fault of the server.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/faults/questions.h"
#include "tests/server/calls.h"
#include "tests/support/process.h"

namespace trc::faults {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using server::StreamAnswer;
using testing_support::ServerProcess;

using Change = std::function<void(Message&)>;
struct Changed {
  std::string name;
  Change change;
};

template <class Value>
void add(std::vector<Changed>& all, const std::string& name, const std::vector<Value>& values,
         const std::function<void(Message&, Value)>& set) {
  for (const Value value : values)
    all.push_back(
        {name + "=" + std::to_string(value), [set, value](Message& m) { set(m, value); }});
}

template <class Value>
std::vector<Value> ends() {
  using Limits = std::numeric_limits<Value>;
  if constexpr (std::is_floating_point_v<Value>)
    return {Limits::quiet_NaN(),
            Limits::infinity(),
            -Limits::infinity(),
            1e308,
            -1e308,
            Limits::denorm_min(),
            -0.0,
            214748.3647,
            -1e-300,
            Limits::epsilon()};
  else
    return {Limits::min(), Limits::max(), static_cast<Value>(Limits::max() - 1), Value{0}};
}

// Of one field, where it stands for itself and where it is repeated.
void add_ends(std::vector<Changed>& all, const FieldDescriptor& field) {
  const auto with = [&](auto set_one, auto add_one, auto none) {
    using Value = decltype(none);
    add<Value>(all, field.name(), ends<Value>(), [&field, set_one, add_one](Message& m, Value v) {
      const auto& reflection = *m.GetReflection();
      if (field.is_repeated())
        (reflection.*add_one)(&m, &field, v);
      else
        (reflection.*set_one)(&m, &field, v);
    });
  };
  using R = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return with(&R::SetDouble, &R::AddDouble, double{});
    case FieldDescriptor::CPPTYPE_UINT32:
      return with(&R::SetUInt32, &R::AddUInt32, std::uint32_t{});
    case FieldDescriptor::CPPTYPE_INT32:
      return with(&R::SetInt32, &R::AddInt32, std::int32_t{});
    case FieldDescriptor::CPPTYPE_UINT64:
      return with(&R::SetUInt64, &R::AddUInt64, std::uint64_t{});
    case FieldDescriptor::CPPTYPE_ENUM:
      return with(&R::SetEnumValue, &R::AddEnumValue, int{});
    default:
      return;
  }
}

// Every change of one number in a message, and in what it holds.
std::vector<Changed> changes_of(const google::protobuf::Descriptor& type, int depth = 0) {
  constexpr int deepest = 3;
  std::vector<Changed> all;
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    add_ends(all, field);
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || field.is_map() || depth == deepest)
      continue;
    for (const Changed& inner : changes_of(*field.message_type(), depth + 1))
      all.push_back({field.name() + "." + inner.name, [&field, inner](Message& m) {
                       const auto& reflection = *m.GetReflection();
                       inner.change(field.is_repeated() ? *reflection.AddMessage(&m, &field)
                                                        : *reflection.MutableMessage(&m, &field));
                     }});
  }
  return all;
}

// A fault of the program or of the request is one of these; another code is one of the server's.
void expect_answered(const grpc::Status& status, const std::string& what) {
  const std::set<grpc::StatusCode> known{grpc::OK, grpc::INVALID_ARGUMENT, grpc::OUT_OF_RANGE,
                                         grpc::FAILED_PRECONDITION, grpc::RESOURCE_EXHAUSTED};
  EXPECT_TRUE(known.contains(status.error_code()))
      << what << ": " << status.error_code() << " " << status.error_message();
  EXPECT_TRUE(status.ok() || !status.error_message().empty()) << what;
}

void expect_finite(const StreamAnswer& answer, const std::string& what) {
  for (const v1::CompensatedBlock& block : answer.blocks) {
    const std::string text = block.ShortDebugString();
    EXPECT_EQ(text.find("nan"), std::string::npos) << what << ": " << text;
    EXPECT_EQ(text.find(": inf"), std::string::npos) << what << ": " << text;
    EXPECT_EQ(text.find("-inf"), std::string::npos) << what << ": " << text;
  }
  EXPECT_EQ(answer.text.find("nan"), std::string::npos) << what << ": " << answer.text;
}

std::vector<v1::Block> square() {
  return {server::command(v1::COMPENSATION_SIDE_LEFT),
          server::line_to(10, 0),
          server::line_to(30, 0),
          server::line_to(30, 30),
          server::line_to(0, 30),
          server::command(v1::COMPENSATION_SIDE_OFF),
          server::line_to(-10, -10)};
}

v1::Block circle_to(double x, double y) {
  v1::Block block;
  auto& circular = *block.mutable_circular();
  circular.mutable_end()->set_x(x);
  circular.mutable_end()->set_y(y);
  circular.mutable_center()->set_x(x / 2);
  return block;
}

class Extremes : public testing::Test {
 protected:
  // Each with a server of its own in the end, of which nothing is left behind.
  void TearDown() override {
    EXPECT_TRUE(serves(server_.address()));
    EXPECT_EQ(server_.log().find("\"incident\""), std::string::npos) << server_.log();
  }
  std::shared_ptr<grpc::Channel> channel() {
    if (channel_ == nullptr) channel_ = channel_to(server_.address());
    return channel_;
  }

 private:
  ServerProcess server_{{"--max-selection-cpu-s", "5", "--max-log-lines-per-s", "100000"}};
  std::shared_ptr<grpc::Channel> channel_;
};

TEST_F(Extremes, OfASetupOfAPath) {
  for (const auto& verification : {v1::VERIFICATION_OFF, v1::VERIFICATION_REPORT})
    for (const Changed& changed : changes_of(*v1::PathSetup::descriptor())) {
      v1::PathSetup setup;
      setup.set_tool_radius(2);
      setup.set_verify(verification);
      changed.change(setup);
      const StreamAnswer answer = server::call_path(
          channel(), {server::setup_request(setup), server::batch(0, square(), true)});
      expect_answered(answer.status, changed.name);
      expect_finite(answer, changed.name);
    }
}

TEST_F(Extremes, OfASetupOfAProgram) {
  int answered = 0;
  for (const Changed& changed : changes_of(*v1::ProgramSetup::descriptor())) {
    v1::ProgramSetup setup;
    setup.mutable_path()->set_tool_radius(2);
    changed.change(setup);
    const StreamAnswer answer = server::run_program(
        channel(), setup,
        "G0 X0 Y0\nG1 G41 X10 Y0 F800\nX30\nG3 X40 Y10 J10\nG1 Y30\nG40\nX50 Y40\nM30\n");
    expect_answered(answer.status, changed.name);
    expect_finite(answer, changed.name);
    answered += answer.status.ok() ? 1 : 0;
  }
  EXPECT_GT(answered, 0) << "all of them were refused";
}

TEST_F(Extremes, OfBlocks) {
  const std::vector<Changed> changes = changes_of(*v1::Block::descriptor());
  v1::PathSetup setup;
  setup.set_tool_radius(2);
  setup.set_verify(v1::VERIFICATION_REPORT);
  for (const v1::Block& block : {server::line_to(30, 0), circle_to(20, 0)})
    for (const Changed& changed : changes) {
      std::vector<v1::Block> blocks = square();
      v1::Block odd = block;
      changed.change(odd);
      blocks.insert(blocks.begin() + 2, odd);
      const StreamAnswer answer = server::call_path(
          channel(), {server::setup_request(setup), server::batch(0, blocks, true)});
      expect_answered(answer.status, changed.name);
      expect_finite(answer, changed.name);
    }
}

TEST_F(Extremes, OfASurvey) {
  for (const Changed& changed : changes_of(*v1::SurveySetup::descriptor())) {
    v1::SurveyRadiiRequest first;
    v1::SurveySetup& setup = *first.mutable_setup();
    setup.mutable_path()->set_selection_mode(v1::SELECTION_MODE_DIRECT);
    setup.add_radii(2);
    changed.change(setup);
    v1::SurveyRadiiRequest path;
    *path.mutable_batch() = server::batch(0, square(), true).batch();
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    const auto stub = v1::TrcService::NewStub(channel());
    const auto stream = stub->SurveyRadii(&context);
    stream->Write(first);
    stream->Write(path);
    stream->WritesDone();
    v1::SurveyRadiiResponse response;
    while (stream->Read(&response)) continue;
    expect_answered(stream->Finish(), changed.name);
  }
}

// A zero with a sign is a zero.
TEST_F(Extremes, MinusZeroIsZero) {
  for (const auto& set : std::vector<std::function<void(v1::PathSetup&, double)>>{
           [](auto&setup, double zero) { setup.set_allowance(zero); },
           [](auto&setup, double zero) { setup.set_wear(zero); },
           [](auto&setup, double zero) { setup.mutable_start_position()->set_x(zero); },
           [](auto&setup, double zero) { setup.set_tangfeed_min_radius(zero); },
           [](auto&setup, double zero) { setup.set_input_resolution(zero); }}) {
    std::vector<std::string> listings;
    for (const double zero : {0.0, -0.0}) {
      v1::PathSetup setup;
      setup.set_tool_radius(2);
      set(setup, zero);
      const StreamAnswer answer = server::call_path(
          channel(), {server::setup_request(setup), server::batch(0, square(), true)});
      EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
      listings.push_back(answer.bytes());
    }
    EXPECT_EQ(listings[0], listings[1]);
  }
}

}  // namespace
}  // namespace trc::faults
