#include "client/load/job.h"

#include <algorithm>
#include <utility>

#include "core/messages/diagnostic_text.h"
#include "core/session/path_session.h"
#include "core/session/program_session.h"
#include "proto/wire/block.h"
#include "proto/wire/setup.h"

namespace trc::load {
namespace {

constexpr double feed = 1000;  // mm/min

// Items of a path that are not contour: selection and approach before it, deselection and retract
// after it.
constexpr std::uint64_t before_contour = 2;
constexpr std::uint64_t behind_contour = 2;

class ColumnsOut {
 public:
  explicit ColumnsOut(v1::BlockColumns& columns) : columns_(columns) { columns.Clear(); }

  void command(v1::CompensationSide side) {
    auto& entry = *columns_.add_commands();
    entry.set_index(static_cast<std::uint32_t>(columns_.kinds().size()));
    entry.mutable_command()->set_side(side);
    add_kind(v1::BlockColumns::KIND_COMMAND);
  }
  void line(const Point& end) {
    add_kind(v1::BlockColumns::KIND_LINEAR);
    add_end(end);
  }
  void arc(const ContourElement& element, const Vector& center) {
    add_kind(element.kind == ContourElement::Kind::clockwise
                 ? v1::BlockColumns::KIND_CLOCKWISE
                 : v1::BlockColumns::KIND_COUNTER_CLOCKWISE);
    add_end(element.end);
    columns_.add_i(center.x());
    columns_.add_j(center.y());
  }

 private:
  void add_kind(v1::BlockColumns::Kind kind) {
    columns_.mutable_kinds()->push_back(static_cast<char>(kind));
  }
  void add_end(const Point& end) {
    columns_.add_x(end.x());
    columns_.add_y(end.y());
    columns_.add_feed(feed);
  }

  v1::BlockColumns& columns_;
};

class BlocksOut {
 public:
  explicit BlocksOut(v1::BlockBatch& batch) : batch_(batch) { batch.Clear(); }

  void command(v1::CompensationSide side) {
    batch_.add_blocks()->mutable_command()->set_side(side);
  }
  void line(const Point& end) { set(*batch_.add_blocks()->mutable_linear(), end); }
  void arc(const ContourElement& element, const Vector& center) {
    v1::CircularMove& move = *batch_.add_blocks()->mutable_circular();
    set(move, element.end);
    move.set_clockwise(element.kind == ContourElement::Kind::clockwise);
    set(*move.mutable_center(), center);
  }

 private:
  static void set(v1::Position& position, const Point& point) {
    position.set_x(point.x());
    position.set_y(point.y());
  }
  template <class Move>
  static void set(Move& move, const Point& end) {
    set(*move.mutable_end(), end);
    move.set_feed(feed);
  }

  v1::BlockBatch& batch_;
};

}  // namespace

Job::Job(const ShapeRequest& shape, Layout layout, std::uint32_t batch, v1::ProgramSetup setup)
    : contour_(shape),
      program_(contour_, {"G17 G90 G162"}),
      layout_(layout),
      batch_(batch),
      setup_(std::move(setup)) {
  v1::PathSetup& path = *setup_.mutable_path();
  if (!path.has_tool_radius()) path.set_tool_radius(shape.tool_radius);
  path.set_response_layout(layout == Layout::blocks ? v1::RESPONSE_LAYOUT_BLOCKS
                                                    : v1::RESPONSE_LAYOUT_COLUMNS);
  if (layout == Layout::text) return;
  path.mutable_start_position()->set_x(contour_.approach_from().x());
  path.mutable_start_position()->set_y(contour_.approach_from().y());
}

std::uint64_t Job::items() const {
  return layout_ == Layout::text ? program_.size()
                                 : before_contour + contour_.size() + behind_contour;
}

Job::Range Job::range_of(std::uint64_t batch) const {
  const std::uint64_t begin = batch * batch_;
  return {begin, std::min(begin + batch_, items())};
}

template <class Out>
void Job::write_item(std::uint64_t item, Out& out) const {
  if (item == 0) return out.command(v1::COMPENSATION_SIDE_RIGHT);
  if (item == 1) return out.line(contour_.start());
  const std::uint64_t index = item - before_contour;
  if (index == contour_.size()) return out.command(v1::COMPENSATION_SIDE_OFF);
  if (index > contour_.size()) return out.line(contour_.retract_to());
  const ContourElement& element = contour_[index];
  if (element.kind == ContourElement::Kind::line) return out.line(element.end);
  const Point& start = index == 0 ? contour_.start() : contour_[index - 1].end;
  out.arc(element, element.center - start);
}

void Job::write(std::uint64_t number, v1::BlockColumns& columns) const {
  const Range range = range_of(number);
  ColumnsOut out(columns);
  for (std::uint64_t item = range.begin; item < range.end; ++item) write_item(item, out);
  columns.set_first_block(range.begin);
  columns.set_final(range.end == items());
}

void Job::write(std::uint64_t number, v1::BlockBatch& batch) const {
  const Range range = range_of(number);
  BlocksOut out(batch);
  for (std::uint64_t item = range.begin; item < range.end; ++item) write_item(item, out);
  batch.set_first_block(range.begin);
  batch.set_final(range.end == items());
}

void Job::write(std::uint64_t number, v1::ProgramText& text) const {
  const Range range = range_of(number);
  text.mutable_text()->clear();
  for (std::uint64_t item = range.begin; item < range.end; ++item)
    program_.append(item, *text.mutable_text());
  text.set_final(range.end == items());
}

namespace {

std::string why_refused(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics)
    if (diagnostic.severity == Severity::error)
      return std::to_string(static_cast<int>(diagnostic.code)) + ": " + message_of(diagnostic);
  return "the core gives no path";
}

std::string first_of(const wire::FieldFaults& faults) {
  const wire::FieldFault& fault = faults.listed().front();
  return fault.field + ": " + fault.description;
}

ExpectedResult expected_path(const Job& job, std::string& refused) {
  constexpr std::uint64_t blocks_between_checkpoints = 1024;
  ExpectedResult expected(blocks_between_checkpoints);
  wire::FieldFaults faults;
  const wire::PathSettings settings =
      wire::from_proto(job.setup().path(), wire::FieldPath("setup"), faults);
  if (!faults.empty()) {
    refused = first_of(faults);
    return expected;
  }
  PathSession session(settings.session);
  wire::BlockReader reader(settings.session.program.tracking_axes.size());
  std::vector<Diagnostic> told;
  Answers out([&](const Answer& part) {
    for (const CompensatedBlock& block : part.blocks) expected.add(block);
    told.insert(told.end(), part.diagnostics.begin(), part.diagnostics.end());
    return true;
  });
  const auto give = [&](const wire::PathInput& input) {
    return wire::apply(input, session.program());
  };
  bool going = true;
  v1::BlockColumns columns;
  for (std::uint64_t batch = 0; batch < job.batches() && going; ++batch) {
    job.write(batch, columns);
    going = reader.read(columns, give, faults);
    going = session.advance(out) && going;
  }
  going = going && session.finish({.index = reader.next_block()}, out);
  if (!faults.empty())
    refused = first_of(faults);
  else if (!going)
    refused = why_refused(told);
  return expected;
}

ExpectedResult expected_text(const Job& job, std::string& refused) {
  constexpr std::uint64_t bytes_between_checkpoints = 64U * 1024U;
  ExpectedResult expected(bytes_between_checkpoints);
  wire::FieldFaults faults;
  const wire::ProgramSettings settings =
      wire::from_proto(job.setup(), wire::FieldPath("setup"), faults);
  if (!faults.empty()) {
    refused = first_of(faults);
    return expected;
  }
  ProgramSession session({.session = settings.path.session});
  std::vector<Diagnostic> told;
  Answers out([&](const Answer& part) {
    expected.add(std::string_view(part.text));
    told.insert(told.end(), part.diagnostics.begin(), part.diagnostics.end());
    return true;
  });
  bool going = true;
  v1::ProgramText text;
  for (std::uint64_t batch = 0; batch < job.batches() && going; ++batch) {
    job.write(batch, text);
    going = session.feed(text.text(), out);
  }
  going = going && session.finish(out);
  if (!going) refused = why_refused(told);
  return expected;
}

}  // namespace

ExpectedResult expected_of(const Job& job, std::string& refused) {
  return job.layout() == Layout::text ? expected_text(job, refused) : expected_path(job, refused);
}

}  // namespace trc::load
