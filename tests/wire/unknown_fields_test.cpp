#include "proto/wire/unknown_fields.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

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
      // Behind one in which nothing is wrong.
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

}  // namespace
}  // namespace trc::wire
