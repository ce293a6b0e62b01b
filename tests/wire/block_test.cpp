#include "proto/wire/block.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/wire/samples.h"

namespace trc::wire {
namespace {

constexpr std::size_t tracking_axes = 2;

template <class Message>
std::vector<PathInput> read_all(const std::vector<Message>& messages, FieldFaults& faults) {
  std::vector<PathInput> items;
  BlockReader reader(tracking_axes);
  for (const Message& message : messages) {
    // As on the way through the network.
    Message received;
    EXPECT_TRUE(received.ParseFromString(message.SerializeAsString()));
    reader.read(
        received,
        [&items](const PathInput& item) {
          items.push_back(item);
          return true;
        },
        faults);
  }
  return items;
}

// Written in batches of the given size and read again.
template <class Message>
std::vector<PathInput> sent_and_read(std::span<const PathInput> items, std::size_t batch) {
  BlockWriter writer;
  std::vector<Message> messages;
  for (std::size_t from = 0; from < items.size(); from += batch) {
    const auto part = items.subspan(from, std::min(batch, items.size() - from));
    EXPECT_EQ(writer.next_block(), from);
    writer.write(part, messages.emplace_back());
    EXPECT_EQ(messages.back().first_block(), from);
    EXPECT_FALSE(messages.back().final());
  }
  FieldFaults faults;
  std::vector<PathInput> read = read_all(messages, faults);
  EXPECT_TRUE(faults.empty()) << faults.listed()[0].field << faults.listed()[0].description;
  return read;
}

void expect_same_items(const std::vector<PathInput>& expected, const std::vector<PathInput>& got) {
  ASSERT_EQ(expected.size(), got.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(same(expected[i], got[i])) << "item " << i;
}

template <class Message>
class PathLayout : public ::testing::Test {};
using RequestLayouts = ::testing::Types<v1::BlockBatch, v1::BlockColumns>;
TYPED_TEST_SUITE(PathLayout, RequestLayouts);

TYPED_TEST(PathLayout, ReadsBackEveryField) {
  const std::vector<PathInput> items = every_path_input();
  expect_same_items(items, sent_and_read<TypeParam>(items, items.size()));
  expect_same_items(items, sent_and_read<TypeParam>(items, 1));
}

TYPED_TEST(PathLayout, ReadsBackRandomPathsInAnyBatches) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<PathInput> items = random_path_inputs(seed, 200);
    for (const std::size_t batch : {1U, 7U, 200U})
      expect_same_items(items, sent_and_read<TypeParam>(items, batch));
  }
}

TYPED_TEST(PathLayout, ReusedMessageKeepsNothing) {
  const std::vector<PathInput> items = every_path_input();
  TypeParam reused;
  BlockWriter first;
  first.write(items, reused);
  reused.set_final(true);
  BlockWriter second;
  second.write(std::span(items).first(2), reused);
  TypeParam fresh;
  BlockWriter third;
  third.write(std::span(items).first(2), fresh);
  EXPECT_EQ(reused.SerializeAsString(), fresh.SerializeAsString());
}

TYPED_TEST(PathLayout, StopsWhenTheSinkDoes) {
  const std::vector<PathInput> items = every_path_input();
  BlockWriter writer;
  TypeParam message;
  writer.write(items, message);
  BlockReader reader(tracking_axes);
  FieldFaults faults;
  int given = 0;
  EXPECT_FALSE(reader.read(
      message, [&given](const PathInput&) { return ++given < 3; }, faults));
  EXPECT_EQ(given, 3);
  EXPECT_TRUE(faults.empty());
}

TEST(BlockColumns, UniformColumnsNeedNoPresence) {
  const std::vector<PathInput> items{MoveRequest{.end = {1, 2, {}}, .feed = 5},
                                     MoveRequest{.end = {3, 4, {}}, .feed = 6}};
  BlockWriter writer;
  v1::BlockColumns columns;
  writer.write(items, columns);
  EXPECT_TRUE(columns.present().empty());
  EXPECT_EQ(columns.x_size(), 2);
  EXPECT_EQ(columns.z_size(), 0);
}

struct RefusedBlock {
  std::string name;
  std::string block;  // protobuf text format
  std::string field;
};

v1::Block parse_block(const std::string& text) {
  v1::Block block;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &block)) << text;
  return block;
}

class RefusedBlocks : public ::testing::TestWithParam<RefusedBlock> {};

TEST_P(RefusedBlocks, NameTheirFieldAndLetTheEarlierOnesThrough) {
  v1::BlockBatch batch;
  batch.add_blocks()->mutable_passthrough()->set_text("M8");
  *batch.add_blocks() = parse_block(GetParam().block);
  FieldFaults faults;
  BlockReader reader(tracking_axes);
  int given = 0;
  EXPECT_FALSE(reader.read(
      batch, [&given](const PathInput&) { return ++given > 0; }, faults));
  EXPECT_EQ(given, 1);
  ASSERT_EQ(faults.count(), 1U);
  EXPECT_EQ(faults.listed()[0].field, GetParam().field);
  EXPECT_FALSE(faults.listed()[0].description.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Batch, RefusedBlocks,
    ::testing::Values(
        RefusedBlock{"NotANumber", "linear { end { x: nan } }", "batch.blocks[1].linear.end.x"},
        RefusedBlock{"Infinite", "linear { end { y: -inf } }", "batch.blocks[1].linear.end.y"},
        RefusedBlock{"Huge", "linear { end { z: 1e300 } }", "batch.blocks[1].linear.end.z"},
        RefusedBlock{"JustBeyondTheRange", "linear { end { z: -1000000.0000000001 } }",
                     "batch.blocks[1].linear.end.z"},
        RefusedBlock{"CenterNotANumber", "circular { center { x: nan } }",
                     "batch.blocks[1].circular.center.x"},
        RefusedBlock{"RadiusNotANumber", "circular { radius: nan }",
                     "batch.blocks[1].circular.radius"},
        RefusedBlock{"NoCenter", "circular { end { x: 1 } }", "batch.blocks[1].circular"},
        RefusedBlock{"FeedZero", "linear { feed: 0 }", "batch.blocks[1].linear.feed"},
        RefusedBlock{"FeedNotANumber", "circular { center {} feed: nan }",
                     "batch.blocks[1].circular.feed"},
        RefusedBlock{"UnknownAxis", "linear { tracking_axes { axis: 2 position: 1 } }",
                     "batch.blocks[1].linear.tracking_axes[0].axis"},
        RefusedBlock{"AxisTwice", "linear { tracking_axes { axis: 1 } tracking_axes { axis: 1 } }",
                     "batch.blocks[1].linear.tracking_axes[1].axis"},
        RefusedBlock{"AxisNotANumber", "linear { tracking_axes { axis: 1 position: nan } }",
                     "batch.blocks[1].linear.tracking_axes[0].position"},
        RefusedBlock{"AxisJustBeyondTheRange",
                     "linear { tracking_axes { axis: 1 position: 1000000.0000000001 } }",
                     "batch.blocks[1].linear.tracking_axes[0].position"},
        RefusedBlock{"Empty", "", "batch.blocks[1]"},
        RefusedBlock{"NumberTooLarge", "source_number: 9223372036854775808 linear {}",
                     "batch.blocks[1].source_number"},
        RefusedBlock{"LineFeedInText", "passthrough { text: 'M8\\nG0 X0' }",
                     "batch.blocks[1].passthrough.text"},
        RefusedBlock{"DeleteInText", "passthrough { text: 'M8\\177' }",
                     "batch.blocks[1].passthrough.text"},
        RefusedBlock{"NextLineInText", "passthrough { text: 'M8\\302\\205' }",
                     "batch.blocks[1].passthrough.text"},
        RefusedBlock{"EscapeSequenceInText", "passthrough { text: '\\302\\23331m' }",
                     "batch.blocks[1].passthrough.text"},
        RefusedBlock{"UnknownSide", "command { side: 9 }", "batch.blocks[1].command.side"},
        RefusedBlock{"ToolRadiusNotANumber", "command { tool_radius: nan }",
                     "batch.blocks[1].command.tool_radius"},
        RefusedBlock{"Online", "command { options { online: 1 } }",
                     "batch.blocks[1].command.options.online"},
        RefusedBlock{"StretchFactorInfinite", "command { options { stretch_factor: inf } }",
                     "batch.blocks[1].command.options.stretch_factor"},
        RefusedBlock{"SplitWithoutMeasure",
                     "command { options { split { dist_seg1: 1 feed_seg1: 1 } } }",
                     "batch.blocks[1].command.options.split.measure"},
        RefusedBlock{
            "SplitWithoutAxis",
            "command { options { split { measure: MEASURE_AXIS dist_seg1: 1 feed_seg1: 1 } } }",
            "batch.blocks[1].command.options.split.axis"},
        RefusedBlock{"SplitAxisBeyondZ",
                     "command { options { split { measure: MEASURE_AXIS axis: 4 dist_seg1: 1 "
                     "feed_seg1: 1 } } }",
                     "batch.blocks[1].command.options.split.axis"}),
    [](const auto& tested) { return tested.param.name; });

struct RefusedColumns {
  std::string name;
  std::string columns;  // protobuf text format
  std::string field;
};

v1::BlockColumns parse_columns(const std::string& text) {
  v1::BlockColumns columns;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &columns)) << text;
  return columns;
}

class RefusedBlockColumns : public ::testing::TestWithParam<RefusedColumns> {};

TEST_P(RefusedBlockColumns, NameTheColumn) {
  FieldFaults faults;
  BlockReader reader(tracking_axes);
  EXPECT_FALSE(reader.read(
      parse_columns(GetParam().columns), [](const PathInput&) { return true; }, faults));
  ASSERT_EQ(faults.count(), 1U);
  EXPECT_EQ(faults.listed()[0].field, GetParam().field);
}

INSTANTIATE_TEST_SUITE_P(
    Batch, RefusedBlockColumns,
    ::testing::Values(
        RefusedColumns{"ShortColumn", "kinds: '\\001\\001' x: [1, 2] y: [1]", "columns.y"},
        RefusedColumns{"LongColumn", "kinds: '\\001' x: [1, 2]", "columns.x"},
        RefusedColumns{"CenterWithoutArc", "kinds: '\\001' i: [1]", "columns.i"},
        RefusedColumns{"UnknownKind", "kinds: '\\001\\010'", "columns.kinds[1]"},
        RefusedColumns{"KindZero", "kinds: '\\000'", "columns.kinds[0]"},
        RefusedColumns{"PresentTooShort", "kinds: '\\001\\001' present: '\\001' x: [1]",
                       "columns.present"},
        RefusedColumns{"PresentNamesCenterOfALine", "kinds: '\\001' present: '\\010' i: [1]",
                       "columns.present[0]"},
        RefusedColumns{"FewerValuesThanPresent", "kinds: '\\001\\001' present: '\\001\\001' x: [1]",
                       "columns.x"},
        RefusedColumns{"NotANumber", "kinds: '\\001\\001' x: [1, nan]", "columns.x[1]"},
        RefusedColumns{"CenterInfinite", "kinds: '\\003' k: [inf]", "columns.k[0]"},
        RefusedColumns{"FeedNegative", "kinds: '\\001' feed: [-1]", "columns.feed[0]"},
        RefusedColumns{"NumberTooLarge", "kinds: '\\001' source_number: [9223372036854775808]",
                       "columns.source_number[0]"},
        RefusedColumns{"CommandMissing", "kinds: '\\005'", "columns.commands"},
        RefusedColumns{"CommandTooMany", "kinds: '' commands {}", "columns.commands"},
        RefusedColumns{"CommandElsewhere", "kinds: '\\001\\005' commands { index: 0 }",
                       "columns.commands[0].index"},
        RefusedColumns{"CommandWithoutOne", "kinds: '\\005' commands { index: 0 }",
                       "columns.commands[0].command"},
        RefusedColumns{"PassthroughWithoutOne", "kinds: '\\006' passthroughs { index: 0 }",
                       "columns.passthroughs[0].passthrough"},
        RefusedColumns{"TextMissing", "kinds: '\\006'", "columns.passthroughs"},
        RefusedColumns{"OtherWithoutMotion", "kinds: '\\007' others { block { command {} } }",
                       "columns.others[0].block"},
        RefusedColumns{"OtherNotANumber",
                       "kinds: '\\007' others { block { linear { end { x: nan } } } }",
                       "columns.others[0].block.linear.end.x"}),
    [](const auto& tested) { return tested.param.name; });

TEST(FieldFaults, ListsTwentyAndCountsAll) {
  FieldFaults faults;
  for (int i = 0; i < 30; ++i) faults.add({.field = "x", .description = "is wrong"});
  EXPECT_EQ(faults.listed().size(), 20U);
  EXPECT_EQ(faults.count(), 30U);
}

}  // namespace
}  // namespace trc::wire
