#include "proto/wire/unknown_fields.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "trc/v1/trc_service.pb.h"

namespace trc::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr int number_of_nobody = 4711;

// A field of the request in which a message stands, and that of the message in it, and so on.
using Way = std::vector<const FieldDescriptor*>;

// Every way to a message within the type.
void find_ways(const google::protobuf::Descriptor& type, const Way& way, std::vector<Way>& ways) {
  ways.push_back(way);
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* const field = type.field(i);
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || field->is_map()) continue;
    Way further = way;
    further.push_back(field);
    find_ways(*field->message_type(), further, ways);
  }
}

Message& made_at(Message& request, const Way& way, std::string& place) {
  Message* message = &request;
  for (const FieldDescriptor* const field : way) {
    place += (place.empty() ? "" : ".") + field->name();
    if (field->is_repeated()) {
      // After one in which nothing is wrong.
      message->GetReflection()->AddMessage(message, field);
      message = message->GetReflection()->AddMessage(message, field);
      place += "[1]";
    } else {
      message = message->GetReflection()->MutableMessage(message, field);
    }
  }
  return *message;
}

template <class Request>
class UnknownFields : public testing::Test {};
using Requests = testing::Types<v1::CompensatePathRequest, v1::CompensateProgramRequest,
                                v1::CompensateProgramOnceRequest, v1::PreviewPathRequest,
                                v1::SurveyRadiiRequest>;
TYPED_TEST_SUITE(UnknownFields, Requests);

// In whatever message of a request a later schema has a field more.
TYPED_TEST(UnknownFields, AreFoundInEveryMessage) {
  std::vector<Way> ways;
  find_ways(*TypeParam::descriptor(), {}, ways);
  for (const Way& way : ways) {
    TypeParam request;
    std::string place;
    Message& message = made_at(request, way, place);
    SCOPED_TRACE(place);
    EXPECT_FALSE(unknown_field_in(request).has_value());
    message.GetReflection()->MutableUnknownFields(&message)->AddVarint(number_of_nobody, 1);
    const auto found = unknown_field_in(request);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->place, place);
    EXPECT_EQ(found->message, message.GetDescriptor()->full_name());
    EXPECT_EQ(found->number, number_of_nobody);
  }
}

std::optional<UnknownField> unknown_in(const std::string& bytes) {
  google::protobuf::io::ArrayInputStream stream(bytes.data(), static_cast<int>(bytes.size()));
  return unknown_field_of_maps(stream, *v1::CompensateProgramOnceRequest::descriptor());
}

// Protobuf sends an unknown field as the bytes of the field with that number.
std::string with_entry(int map, const std::string& entry) {
  v1::CompensateProgramOnceRequest request;
  request.mutable_setup()->mutable_path()->set_tool_radius(5);
  (*request.mutable_setup()->mutable_variables())["#1"] = 1;
  (*request.mutable_setup()->mutable_subprograms())["A"] = "M17";
  auto& setup = *request.mutable_setup();
  setup.GetReflection()->MutableUnknownFields(&setup)->AddLengthDelimited(map)->assign(entry);
  return request.SerializeAsString();
}

constexpr int of_variables = v1::ProgramSetup::kVariablesFieldNumber;
constexpr int of_files = v1::ProgramSetup::kSubprogramFilesFieldNumber;

TEST(UnknownFieldsOfMaps, AreFoundInTheBytes) {  // D-164
  const std::string key = "\x0A\x04#500";
  const auto extra = unknown_in(with_entry(of_variables, key + "\x38\x01"));
  ASSERT_TRUE(extra.has_value());
  EXPECT_EQ(extra->place, "setup.variables");
  EXPECT_EQ(extra->message, "trc.v1.ProgramSetup.VariablesEntry");
  EXPECT_EQ(extra->number, 7);
  // 5 as a float, which Protobuf skips: the variable would be 0.
  const auto single = unknown_in(with_entry(of_variables, key + std::string("\x15\0\0\xA0@", 5)));
  ASSERT_TRUE(single.has_value());
  EXPECT_EQ(single->number, 2);
  EXPECT_EQ(unknown_in(with_entry(of_files, key + "\x10\x05"))->place, "setup.subprogram_files");
}

TEST(UnknownFieldsOfMaps, AreNotSeenWhereThereAreNone) {
  EXPECT_FALSE(unknown_in(with_entry(of_variables, "\x0A\x04#500")));
  EXPECT_FALSE(unknown_in(with_entry(of_files, "\x12\x01x\x0A\x01y")));
  EXPECT_FALSE(unknown_in(""));
}

// Whoever parses them refuses them.
TEST(UnknownFieldsOfMaps, AreNotSoughtInBytesThatAreNoMessage) {
  const std::string whole = with_entry(of_variables, "\x0A\x04#500");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(unknown_in(whole.substr(0, size))) << size;
}

TEST(UnknownFieldsOfMaps, AreOnlySoughtInMessagesWithMaps) {
  EXPECT_TRUE(holds_maps(*v1::CompensateProgramRequest::descriptor()));
  EXPECT_TRUE(holds_maps(*v1::SurveyRadiiRequest::descriptor()));
  EXPECT_FALSE(holds_maps(*v1::CompensatePathRequest::descriptor()));
}

}  // namespace
}  // namespace trc::wire
