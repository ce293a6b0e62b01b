#include "proto/wire/compensated_block.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "proto/wire/compensated_batch_bytes.h"
#include "tests/wire/samples.h"

namespace trc::wire {
namespace {

template <class Message>
std::vector<CompensatedBlock> there_and_back(std::span<const CompensatedBlock> blocks,
                                             std::size_t batch) {
  CompensatedReader reader(Position{});
  std::vector<CompensatedBlock> read;
  FieldFaults faults;
  Message reused;
  for (std::size_t from = 0; from < blocks.size(); from += batch) {
    to_proto(blocks.subspan(from, std::min(batch, blocks.size() - from)), from, reused);
    Message received;
    EXPECT_TRUE(received.ParseFromString(reused.SerializeAsString()));
    EXPECT_TRUE(reader.read(received, read, faults));
  }
  for (const FieldFault& fault : faults.listed())
    ADD_FAILURE() << fault.field << " " << fault.description;
  return read;
}

void expect_same_blocks(const std::vector<CompensatedBlock>& expected,
                        const std::vector<CompensatedBlock>& got) {
  ASSERT_EQ(expected.size(), got.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_TRUE(same(expected[i], got[i])) << "block " << i;
}

std::string bytes_of(std::span<const CompensatedBlock> blocks, std::uint64_t first) {
  std::string bytes = "before";
  append_batch(blocks, first, bytes);
  EXPECT_EQ(bytes.substr(0, 6), "before");
  return bytes.substr(6);
}

std::string bytes_by_protobuf(std::span<const CompensatedBlock> blocks, std::uint64_t first) {
  v1::CompensatedBatch batch;
  to_proto(blocks, first, batch);
  return batch.SerializeAsString();
}

TEST(BytesOfABatch, AreThoseOfProtobuf) {
  EXPECT_EQ(bytes_of({}, 0), bytes_by_protobuf({}, 0));
  for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 40U}) {
    const std::vector<CompensatedBlock> every = every_compensated_block();
    EXPECT_EQ(bytes_of(every, first), bytes_by_protobuf(every, first));
    for (const CompensatedBlock& block : every)
      EXPECT_EQ(bytes_of({&block, 1}, first), bytes_by_protobuf({&block, 1}, first));
  }
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<CompensatedBlock> blocks = random_compensated_blocks(seed, 300);
    EXPECT_EQ(bytes_of(blocks, seed), bytes_by_protobuf(blocks, seed));
  }
}

// Numbers at the ends of their ranges, where they take most and least.
TEST(BytesOfABatch, AreThoseOfProtobufForEveryLength) {
  std::vector<CompensatedBlock> blocks;
  for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz})
    for (const std::int64_t number :
         {Source::no_number, std::int64_t{0}, std::numeric_limits<std::int64_t>::max()})
      for (const std::uint64_t index : {0ULL, 127ULL, 128ULL, 0xffffffffULL, 0x100000000ULL})
        for (const std::uint32_t line : {0U, 1U, 0xffffffffU})
          for (const double feed : {0.0, 1e9})
            for (const double sweep : {0.0, -0.0, -1.5}) {
              CompensatedBlock block{.source = {.index = index, .number = number, .line = line},
                                     .origin = Origin::uncompensated,
                                     .plane = plane,
                                     .tangential = feed != 0,
                                     .feed = feed};
              block.path = Arc{.start = {1, -0.0}, .end = {3, 4}, .center = {5, 6}, .sweep = sweep};
              blocks.push_back(block);
              block.path = Line{.start = {1, 2}, .end = {0, 0}};
              block.rapid = line != 0;
              blocks.push_back(block);
            }
  for (const CompensatedBlock& block : blocks)
    ASSERT_EQ(bytes_of({&block, 1}, 0), bytes_by_protobuf({&block, 1}, 0));
  EXPECT_EQ(bytes_of(blocks, 7), bytes_by_protobuf(blocks, 7));
}

template <class Message>
class ResultLayout : public ::testing::Test {};
using ResponseLayouts = ::testing::Types<v1::CompensatedBatch, v1::CompensatedColumns>;
TYPED_TEST_SUITE(ResultLayout, ResponseLayouts);

TYPED_TEST(ResultLayout, ReadsBackEveryField) {
  const std::vector<CompensatedBlock> blocks = every_compensated_block();
  expect_same_blocks(blocks, there_and_back<TypeParam>(blocks, blocks.size()));
  expect_same_blocks(blocks, there_and_back<TypeParam>(blocks, 1));
}

TYPED_TEST(ResultLayout, CarriesTextOfAProgramThatIsLatin1) {
  const std::vector<CompensatedBlock> sent{{.origin = Origin::passthrough, .text = "; Fr\xE4ser"}};
  const std::vector<CompensatedBlock> read = there_and_back<TypeParam>(sent, 1);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].text, "; Fräser");
}

TYPED_TEST(ResultLayout, ReadsBackRandomPathsInAnyBatches) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<CompensatedBlock> blocks = random_compensated_blocks(seed, 300);
    for (const std::size_t batch : {1U, 7U, 300U})
      expect_same_blocks(blocks, there_and_back<TypeParam>(blocks, batch));
  }
}

TYPED_TEST(ResultLayout, KeepsAGapBetweenBlocks) {
  std::vector<CompensatedBlock> blocks = random_compensated_blocks(3, 10);
  blocks.push_back({.path = Line{.start = {7, 7}, .end = {8, 8}}});
  expect_same_blocks(blocks, there_and_back<TypeParam>(blocks, blocks.size()));
}

TYPED_TEST(ResultLayout, RefusesABatchOutOfSequence) {
  const std::vector<CompensatedBlock> blocks = random_compensated_blocks(1, 3);
  TypeParam message;
  to_proto(blocks, 1, message);
  CompensatedReader reader(Position{});
  std::vector<CompensatedBlock> read;
  FieldFaults faults;
  EXPECT_FALSE(reader.read(message, read, faults));
  EXPECT_EQ(faults.count(), 1U);
  EXPECT_TRUE(read.empty());
}

TEST(CompensatedColumns, ConnectedPathSendsOneStart) {
  std::vector<CompensatedBlock> blocks = random_compensated_blocks(5, 100);
  v1::CompensatedColumns message;
  to_proto(blocks, 0, message);
  EXPECT_EQ(message.start_x_size(), 1);
  EXPECT_GT(message.end_x_size(), 50);
}

TEST(CompensatedColumns, ColumnsOfWrongLengthAreRefused) {
  const std::vector<CompensatedBlock> blocks = random_compensated_blocks(5, 20);
  v1::CompensatedColumns good;
  to_proto(blocks, 0, good);
  const auto refused_field = [](const v1::CompensatedColumns& message) {
    CompensatedReader reader(Position{});
    std::vector<CompensatedBlock> read;
    FieldFaults faults;
    EXPECT_FALSE(reader.read(message, read, faults));
    return faults.empty() ? std::string() : faults.listed()[0].field;
  };
  v1::CompensatedColumns bad = good;
  bad.mutable_end_y()->RemoveLast();
  EXPECT_EQ(refused_field(bad), "columns.end_y");
  bad = good;
  bad.mutable_flags()->pop_back();
  EXPECT_EQ(refused_field(bad), "columns.flags");
  bad = good;
  (*bad.mutable_kinds())[0] = 9;
  EXPECT_EQ(refused_field(bad), "columns.kinds[0]");
  bad = good;
  bad.mutable_sweep()->Clear();
  EXPECT_EQ(refused_field(bad), "columns.sweep");
  bad = good;
  bad.mutable_texts(0)->set_index(19);
  EXPECT_EQ(refused_field(bad), "columns.texts");
}

TEST(CompensatedBlockMessage, UnknownOriginIsRefused) {
  v1::CompensatedBatch batch;
  batch.add_blocks()->set_origin(static_cast<v1::CompensatedBlock::Origin>(99));
  CompensatedReader reader(Position{});
  std::vector<CompensatedBlock> read;
  FieldFaults faults;
  EXPECT_FALSE(reader.read(batch, read, faults));
  EXPECT_TRUE(read.empty());
  ASSERT_EQ(faults.count(), 1U);
  EXPECT_EQ(faults.listed()[0].field, "batch.blocks[0].origin");
}

}  // namespace
}  // namespace trc::wire
