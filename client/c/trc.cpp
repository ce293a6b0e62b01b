#include "client/c/trc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/version.h"
#include "core/nc/text/characters.h"
#include "core/session/program_session.h"
#include "proto/wire/block.h"
#include "proto/wire/compensated_block.h"
#include "proto/wire/json.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace wire = trc::wire;
namespace v1 = trc::v1;

// One of the two sessions of the core, and what it has said that was not taken yet.
struct trc_session {
  std::optional<trc::PathSession> path{};
  std::optional<trc::ProgramSession> program{};

  // Of blocks.
  std::optional<wire::BlockReader> reader{};
  v1::BlockBatch batch{};
  wire::Json json{};

  trc::Answers answers{};
  trc::Answer taken{};  // the part that leaves at present
  bool text_has_left = false;
  std::size_t next_block = 0;  // of that part
  std::size_t next_diagnostic = 0;

  // What the last answer points at.
  trc_motion motion{};
  std::vector<double> axis_start{};
  std::vector<double> axis_end{};
  trc_diagnostic diagnostic{};
  trc::DiagnosticTexts texts{};
  std::vector<trc_value> values{};

  bool finished = false;
  std::string refusal{};  // why, once it is refused
  int unusable = TRC_OK;  // TRC_MEMORY or TRC_INTERNAL, once something was thrown

  template <class Use>
  decltype(auto) with(Use use) {
    return path ? use(*path) : use(*program);
  }
  template <class Use>
  decltype(auto) with(Use use) const {
    return path ? use(*path) : use(*program);
  }
};

namespace {

// Of a size, so that saying what is wrong takes no memory.
thread_local std::array<char, 1024> last_error{};

int fail(int status, std::string_view text) {
  std::size_t size = std::min(text.size(), last_error.size() - 1);
  // Not within a character.
  if (size < text.size())
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80U) --size;
  std::copy_n(text.data(), size, last_error.data());
  last_error[size] = '\0';
  return status;
}

// What is thrown leaves no session that could go on.
template <class Work>
int guarded(trc_session* session, Work work) noexcept {
  int status = TRC_INTERNAL;
  try {
    return work();
  } catch (const std::bad_alloc&) {
    status = fail(TRC_MEMORY, "out of memory; give the program or path to a new session");
  } catch (const std::exception& thrown) {
    status = fail(TRC_INTERNAL, thrown.what());
  } catch (...) {
    status = fail(TRC_INTERNAL, "an unknown fault");
  }
  if (session != nullptr) session->unusable = status;
  return status;
}

int fault_of_size(const char* name, std::size_t size, std::size_t expected) {
  return fail(TRC_ARGUMENT, std::string(name) + ": its size is " + std::to_string(size) +
                                ", expected is sizeof(" + name + "), " + std::to_string(expected));
}

// No structure is larger in any version: what is, was never set.
constexpr std::size_t largest_structure = 4096;

bool is_size(std::size_t size, std::size_t known) {
  return size >= known && size <= largest_structure;
}

// Whether what a newer header has behind a structure says nothing.
bool is_zero_behind(const void* structure, std::size_t known, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(structure);
  return std::all_of(bytes + known, bytes + size, [](unsigned char byte) { return byte == 0; });
}

int fault_of_newer(const char* name) {
  return fail(TRC_ARGUMENT, std::string(name) + ": it holds what only a newer library than " +
                                std::string(trc::version()) + " knows");
}

// Into a structure of the caller's, whose size is kept.
template <class Structure>
void write_out(const Structure& value, Structure& out) {
  const std::size_t size = out.size;
  std::memcpy(&out, &value, sizeof value);
  std::memset(reinterpret_cast<unsigned char*>(&out) + sizeof value, 0, size - sizeof value);
  out.size = size;
}

int no_session() { return fail(TRC_ARGUMENT, "session: is NULL"); }

int unusable(const trc_session& session) {
  return fail(session.unusable, "the session has failed before; only trc_free may follow");
}

std::string text_of(const wire::FieldFaults& faults) {
  std::string text;
  for (const wire::FieldFault& fault : faults.listed())
    text += (text.empty() ? "" : "; ") + fault.field + " " + fault.description;
  return text;
}

// --- Setup

std::string read_setup(const trc_setup& given, v1::ProgramSetup& setup) {
  const bool is_text = given.input == TRC_INPUT_TEXT;
  if (given.json != nullptr && *given.json != '\0') {
    wire::Json json;
    const std::string fault =
        is_text ? json.read(given.json, setup) : json.read(given.json, *setup.mutable_path());
    if (!fault.empty()) return "json: " + fault;
  }
  for (std::uint32_t i = 0; i < given.setting_count; ++i) {
    const std::string place = "settings[" + std::to_string(i) + "]: ";
    if (given.settings[i] == nullptr) return place + "is NULL";
    const std::string fault = wire::apply_setting(given.settings[i], setup);
    if (!fault.empty()) return place + fault;
  }
  if (!setup.path().resume_token().empty())
    return "resume_token: sessions of this library do not go on from those of a server; leave it "
           "away";
  if (!is_text && setup.tools_size() > 0)
    return "tools: blocks select no tools; set tool_radius, and change it by a TRC_COMMAND";
  return {};
}

int create(const trc_setup& given, std::unique_ptr<trc_session>& session) {
  v1::ProgramSetup setup;
  if (const std::string fault = read_setup(given, setup); !fault.empty())
    return fail(TRC_ARGUMENT, fault);
  session = std::make_unique<trc_session>();
  wire::FieldFaults faults;
  const wire::FieldPath place("setup");
  if (given.input == TRC_INPUT_TEXT) {
    const wire::ProgramSettings settings = wire::from_proto(setup, place, faults);
    if (!faults.empty()) return fail(TRC_ARGUMENT, text_of(faults));
    session->program.emplace(trc::ProgramSessionSetup{.session = settings.path.session,
                                                      .nc_text = settings.nc_text,
                                                      .decimals = settings.decimals});
  } else {
    const wire::PathSettings settings = wire::from_proto(setup.path(), place, faults);
    if (!faults.empty()) return fail(TRC_ARGUMENT, text_of(faults));
    session->path.emplace(settings.session);
    session->reader.emplace(settings.session.program.tracking_axes.size());
  }
  return TRC_OK;
}

// --- Blocks in

constexpr std::uint32_t end_bits = TRC_HAS_X | TRC_HAS_Y | TRC_HAS_Z;
constexpr std::uint32_t center_bits = TRC_HAS_I | TRC_HAS_J | TRC_HAS_K;

// What a block of this kind may have; nothing: there is no such kind.
std::optional<std::uint32_t> allowed_bits(std::int32_t kind) {
  switch (kind) {
    case TRC_RAPID:
    case TRC_LINE:
      return end_bits | TRC_HAS_FEED | TRC_HAS_NUMBER;
    case TRC_CLOCKWISE:
    case TRC_COUNTER_CLOCKWISE:
      return end_bits | center_bits | TRC_HAS_RADIUS | TRC_HAS_FEED | TRC_HAS_NUMBER;
    case TRC_TEXT:
    case TRC_LEFT:
    case TRC_RIGHT:
    case TRC_OFF:
    case TRC_COMMAND:
      return TRC_HAS_NUMBER;
    default:
      return {};
  }
}

bool is_motion(std::int32_t kind) { return kind >= TRC_RAPID && kind <= TRC_COUNTER_CLOCKWISE; }

// What is wrong with the block itself, whatever its values.
std::string fault_in(const trc_block& block) {
  const auto allowed = allowed_bits(block.kind);
  if (!allowed) return "kind is " + std::to_string(block.kind) + ", allowed are 1 to 9 (trc_kind)";
  if ((block.given & ~*allowed) != 0)
    return "given is " + std::to_string(block.given) + ", a block of this kind may have " +
           std::to_string(*allowed) + " (trc_given)";
  if ((block.given & TRC_HAS_RADIUS) != 0 && (block.given & center_bits) != 0)
    return "given names a radius and a centre; an arc has one of them";
  if ((block.given & TRC_HAS_NUMBER) != 0 && block.number < 0)
    return "number is " + std::to_string(block.number) + ", allowed is 0 or more";
  if (block.role < TRC_ROLE_OF_SETUP || block.role > TRC_ROLE_LEAD)
    return "role is " + std::to_string(block.role) + ", allowed are 0 to 2 (trc_role)";
  if (!is_motion(block.kind) && (block.role != TRC_ROLE_OF_SETUP || block.axis_count > 0))
    return "a block without motion has no role and no axes";
  if (block.axis_count > 0 && block.axes == nullptr) return "axes is NULL, axis_count is not 0";
  if (block.kind != TRC_TEXT && block.kind != TRC_COMMAND) return {};
  if (block.text == nullptr) return "text is NULL";
  const std::string_view text = block.text;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = trc::utf8_character(text.substr(at));
    if (bytes == 0) return "text is no UTF-8 at byte " + std::to_string(at);
    at += bytes;
  }
  return {};
}

template <class Move>
void write_move(const trc_block& block, Move& move) {
  v1::Position& end = *move.mutable_end();
  if ((block.given & TRC_HAS_X) != 0) end.set_x(block.x);
  if ((block.given & TRC_HAS_Y) != 0) end.set_y(block.y);
  if ((block.given & TRC_HAS_Z) != 0) end.set_z(block.z);
  if ((block.given & TRC_HAS_FEED) != 0) move.set_feed(block.feed);
  move.set_role(static_cast<v1::BlockRole>(block.role));
  for (std::uint32_t i = 0; i < block.axis_count; ++i) {
    v1::AxisPosition& position = *move.add_tracking_axes();
    position.set_axis(block.axes[i].axis);
    position.set_position(block.axes[i].position);
  }
}

void write_arc(const trc_block& block, v1::CircularMove& move) {
  write_move(block, move);
  move.set_clockwise(block.kind == TRC_CLOCKWISE);
  if ((block.given & TRC_HAS_RADIUS) != 0) return move.set_radius(block.radius);
  if ((block.given & center_bits) == 0) return;
  v1::Position& center = *move.mutable_center();
  if ((block.given & TRC_HAS_I) != 0) center.set_x(block.i);
  if ((block.given & TRC_HAS_J) != 0) center.set_y(block.j);
  if ((block.given & TRC_HAS_K) != 0) center.set_z(block.k);
}

// Into an empty message. Returns what is wrong.
std::string write_block(const trc_block& block, wire::Json& json, v1::Block& message) {
  std::string fault = fault_in(block);
  if (!fault.empty()) return fault;
  if ((block.given & TRC_HAS_NUMBER) != 0)
    message.set_source_number(static_cast<std::uint64_t>(block.number));
  switch (block.kind) {
    case TRC_RAPID:
    case TRC_LINE:
      write_move(block, *message.mutable_linear());
      message.mutable_linear()->set_rapid(block.kind == TRC_RAPID);
      break;
    case TRC_CLOCKWISE:
    case TRC_COUNTER_CLOCKWISE:
      write_arc(block, *message.mutable_circular());
      break;
    case TRC_TEXT:
      message.mutable_passthrough()->set_text(block.text);
      break;
    case TRC_COMMAND:
      fault = json.read(block.text, *message.mutable_command());
      if (!fault.empty()) fault = "text: " + fault;
      break;
    default:
      message.mutable_command()->set_side(block.kind == TRC_LEFT    ? v1::COMPENSATION_SIDE_LEFT
                                          : block.kind == TRC_RIGHT ? v1::COMPENSATION_SIDE_RIGHT
                                                                    : v1::COMPENSATION_SIDE_OFF);
  }
  return fault;
}

int fault_of_block(const trc_session& session, const std::string& fault) {
  return fail(TRC_ARGUMENT, "block " + std::to_string(session.reader->next_block()) + ": " + fault);
}

// Behind "batch.blocks[3].": the place in a batch of ours tells the caller nothing.
std::string without_batch(const wire::FieldFault& fault) {
  const std::size_t bracket = fault.field.find("].");
  const std::string field =
      bracket == std::string::npos ? std::string() : fault.field.substr(bracket + 2) + " ";
  return field + fault.description;
}

// The error that has just stopped the session, in one sentence.
int refuse(trc_session& session) {
  if (session.refusal.empty()) {
    session.refusal = "refused";
    for (const trc::Answer& part : session.answers.parts())
      for (const trc::Diagnostic& told : part.diagnostics)
        if (told.severity == trc::Severity::error && session.refusal == "refused")
          session.refusal = "refused " + trc::place_of(told.source) + ": " +
                            std::to_string(static_cast<int>(told.code)) + ": " +
                            trc::texts_of(told).text;
  }
  return fail(TRC_REFUSED, session.refusal);
}

// Gives what is in the batch to the session.
int give_batch(trc_session& session) {
  wire::FieldFaults faults;
  trc::PathSession& path = *session.path;
  session.reader->read(
      session.batch,
      [&](const wire::PathInput& input) { return wire::apply(input, path.program()); }, faults);
  if (!path.advance(session.answers)) return refuse(session);
  return faults.empty() ? TRC_OK : fault_of_block(session, without_batch(faults.listed().front()));
}

int feed_blocks(trc_session& session, const unsigned char* blocks, std::size_t count,
                std::size_t block_size) {
  // So many at once: few enough to lie in the caches still.
  constexpr std::size_t group = 256;
  for (std::size_t first = 0; first < count; first += group) {
    session.batch.Clear();
    std::string fault;
    for (std::size_t i = first; i < std::min(count, first + group) && fault.empty(); ++i) {
      const unsigned char* given = blocks + i * block_size;
      trc_block block{};
      std::memcpy(&block, given, sizeof block);
      fault = is_zero_behind(given, sizeof block, block_size)
                  ? write_block(block, session.json, *session.batch.add_blocks())
                  : "it holds what only a newer library knows";
      // What has begun to be written is not given.
      if (!fault.empty() && session.batch.blocks_size() > static_cast<int>(i - first))
        session.batch.mutable_blocks()->RemoveLast();
    }
    if (const int status = give_batch(session); status != TRC_OK) return status;
    if (!fault.empty()) return fault_of_block(session, fault);
  }
  return TRC_OK;
}

// --- Answers out

// Whether there was another part.
bool take_part(trc_session& session) {
  auto& parts = session.answers.parts();
  while (parts.size() > 1 && parts.front().empty()) parts.pop_front();
  if (parts.front().empty()) return false;
  session.taken.text.clear();
  session.taken.blocks.clear();
  session.taken.diagnostics.clear();
  // What is next has the memory of what has left.
  std::swap(session.taken, parts.front());
  if (parts.size() > 1) parts.pop_front();
  session.text_has_left = session.taken.text.empty();
  session.next_block = 0;
  session.next_diagnostic = 0;
  return true;
}

int word_of(trc::Plane plane) {
  return plane == trc::Plane::xy ? 17 : plane == trc::Plane::zx ? 18 : 19;
}

void copy(const trc::Position& position, double (&to)[3]) {
  std::copy(position.begin(), position.end(), to);
}

const trc_motion* motion_of(const trc::CompensatedBlock& block, trc_session& session) {
  trc_motion& motion = session.motion = {};
  motion.size = sizeof motion;
  motion.origin = static_cast<std::int32_t>(wire::to_proto(block.origin));
  motion.plane = word_of(block.plane);
  motion.tangential = block.tangential ? 1 : 0;
  copy(trc::from_plane(block.plane, trc::start_of(block.path), block.normal.from), motion.start);
  copy(trc::from_plane(block.plane, trc::end_of(block.path), block.normal.to), motion.end);
  if (const auto* arc = std::get_if<trc::Arc>(&block.path)) {
    motion.kind = arc->sweep < 0 ? TRC_CLOCKWISE : TRC_COUNTER_CLOCKWISE;
    copy(trc::from_plane(block.plane, arc->center, block.normal.from), motion.center);
    motion.sweep = arc->sweep;
  } else {
    motion.kind = wire::is_text_alone(block) ? TRC_TEXT : block.rapid ? TRC_RAPID : TRC_LINE;
  }
  motion.feed = block.feed;
  motion.index = block.source.index;
  motion.number = block.source.number;
  motion.line = block.source.line;
  session.axis_start.clear();
  session.axis_end.clear();
  for (const trc::AxisTravel& axis : block.tracking) {
    session.axis_start.push_back(axis.from);
    session.axis_end.push_back(axis.to);
  }
  motion.axis_count = static_cast<std::uint32_t>(session.axis_start.size());
  motion.axis_start = session.axis_start.data();
  motion.axis_end = session.axis_end.data();
  motion.text = block.text.c_str();
  return &motion;
}

std::int32_t severity_of(trc::Severity severity) {
  switch (severity) {
    case trc::Severity::note:
      return TRC_NOTE;
    case trc::Severity::warning:
      return TRC_WARNING;
    case trc::Severity::error:
      break;
  }
  return TRC_ERROR;
}

const trc_diagnostic* diagnostic_of(const trc::Diagnostic& found, trc_session& session) {
  trc_diagnostic& diagnostic = session.diagnostic = {};
  diagnostic.size = sizeof diagnostic;
  diagnostic.code = static_cast<std::int32_t>(found.code);
  diagnostic.severity = severity_of(found.severity);
  diagnostic.index = found.source.index;
  diagnostic.number = found.source.number;
  diagnostic.line = found.source.line;
  diagnostic.column = found.column;
  session.texts = trc::texts_of(found);
  diagnostic.reason = session.texts.reason.c_str();
  diagnostic.title = session.texts.title.c_str();
  diagnostic.text = session.texts.text.c_str();
  diagnostic.help = session.texts.help.c_str();
  diagnostic.detail = found.detail.c_str();
  session.values.clear();
  for (const trc::DiagnosticValue& value : found.values)
    session.values.push_back({.name = value.name.c_str(), .value = value.value});
  diagnostic.values = session.values.data();
  diagnostic.value_count = static_cast<std::uint32_t>(session.values.size());
  if (found.point) {
    diagnostic.has_point = 1;
    copy({found.point->x, found.point->y, found.point->z}, diagnostic.point);
  }
  return &diagnostic;
}

int next(trc_session& session, trc_answer& out) {
  trc_answer answer{};
  for (;;) {
    if (!std::exchange(session.text_has_left, true)) {
      answer.kind = TRC_ANSWER_TEXT;
      answer.text = session.taken.text.c_str();
      answer.text_length = session.taken.text.size();
      break;
    }
    if (session.next_block < session.taken.blocks.size()) {
      answer.kind = TRC_ANSWER_MOTION;
      answer.motion = motion_of(session.taken.blocks[session.next_block++], session);
      break;
    }
    if (session.next_diagnostic < session.taken.diagnostics.size()) {
      answer.kind = TRC_ANSWER_DIAGNOSTIC;
      answer.diagnostic =
          diagnostic_of(session.taken.diagnostics[session.next_diagnostic++], session);
      break;
    }
    if (!take_part(session)) {
      write_out(answer, out);
      return TRC_END;
    }
  }
  write_out(answer, out);
  return TRC_OK;
}

trc_summary summary_of(const trc_session& session) {
  trc_summary summary{};
  session.with([&](const auto& of) {
    const trc::Summary& done = of.summary();
    const auto by = [&](trc::Origin origin) {
      return done.blocks_by_origin[static_cast<std::size_t>(origin)];
    };
    summary.blocks_in = done.blocks_in;
    summary.blocks_out = done.blocks_out;
    summary.masked = by(trc::Origin::masked);
    summary.transitions = by(trc::Origin::transition);
    summary.notes = of.diagnostics().count(trc::Severity::note);
    summary.warnings = of.diagnostics().count(trc::Severity::warning);
    summary.programmed_length = done.programmed_length;
    summary.compensated_length = done.compensated_length;
    summary.effective_radius = std::abs(of.radius_terms().effective());
    const trc::verify::ClearanceReport* measured = of.clearance();
    if (measured == nullptr) return;
    summary.checked = measured->checked;
    summary.gouging = measured->gouging;
    if (!measured->worst) return;
    summary.clearance = measured->worst->distance;
    summary.required = measured->worst->required;
    copy(measured->worst->place, summary.clearance_at);
    summary.clearance_wall = measured->worst->contour.index;
  });
  if (session.program) summary.lines_in = session.program->lines_read();
  return summary;
}

// What keeps a session from taking more, or TRC_OK. `takes`: whether it is of that kind.
int check_feeding(trc_session& session, bool takes, const char* other) {
  if (session.unusable != TRC_OK) return unusable(session);
  if (!takes)
    return fail(TRC_ORDER, std::string("the session is one of the other kind: use ") + other);
  if (!session.refusal.empty()) return refuse(session);
  if (session.finished) return fail(TRC_ORDER, "the session is finished; begin a new one");
  return TRC_OK;
}

}  // namespace

const char* trc_version(void) {
  // "major.minor.patch" of a literal: with its NUL.
  return trc::version().data();
}

const char* trc_last_error(void) { return last_error.data(); }

int trc_create(const trc_setup* setup, trc_session** session) {
  if (session == nullptr) return fail(TRC_ARGUMENT, "session: is NULL");
  *session = nullptr;
  if (setup == nullptr) return fail(TRC_ARGUMENT, "setup: is NULL");
  return guarded(nullptr, [&] {
    if (!is_size(setup->size, sizeof *setup))
      return fault_of_size("trc_setup", setup->size, sizeof *setup);
    if (!is_zero_behind(setup, sizeof *setup, setup->size)) return fault_of_newer("trc_setup");
    if (setup->input != TRC_INPUT_TEXT && setup->input != TRC_INPUT_BLOCKS)
      return fail(TRC_ARGUMENT, "setup.input: is " + std::to_string(setup->input) +
                                    ", allowed are 1 and 2 (trc_input)");
    constexpr std::uint32_t most_settings = 10000;
    if (setup->setting_count > most_settings)
      return fail(TRC_ARGUMENT, "setup.setting_count: is " + std::to_string(setup->setting_count) +
                                    ", allowed are 10000");
    if (setup->setting_count > 0 && setup->settings == nullptr)
      return fail(TRC_ARGUMENT, "setup.settings: is NULL, setting_count is not 0");
    std::unique_ptr<trc_session> made;
    const int status = create(*setup, made);
    if (status == TRC_OK) *session = made.release();
    return status;
  });
}

int trc_feed_text(trc_session* session, const char* text, size_t length) {
  return guarded(session, [&] {
    if (session == nullptr) return no_session();
    const int status = check_feeding(*session, session->program.has_value(), "trc_feed_blocks");
    if (status != TRC_OK) return status;
    if (text == nullptr && length > 0) return fail(TRC_ARGUMENT, "text: is NULL, length is not 0");
    if (length == 0) return static_cast<int>(TRC_OK);
    return session->program->feed({text, length}, session->answers) ? TRC_OK : refuse(*session);
  });
}

int trc_feed_blocks(trc_session* session, const trc_block* blocks, size_t count,
                    size_t block_size) {
  return guarded(session, [&] {
    if (session == nullptr) return no_session();
    const int status = check_feeding(*session, session->path.has_value(), "trc_feed_text");
    if (status != TRC_OK) return status;
    if (!is_size(block_size, sizeof(trc_block)))
      return fault_of_size("trc_block", block_size, sizeof(trc_block));
    if (blocks == nullptr && count > 0)
      return fail(TRC_ARGUMENT, "blocks: is NULL, count is not 0");
    return feed_blocks(*session, reinterpret_cast<const unsigned char*>(blocks), count, block_size);
  });
}

int trc_finish(trc_session* session) {
  return guarded(session, [&] {
    if (session == nullptr) return no_session();
    if (session->unusable != TRC_OK) return unusable(*session);
    if (!session->refusal.empty()) return refuse(*session);
    if (std::exchange(session->finished, true)) return static_cast<int>(TRC_OK);
    const bool done =
        session->path
            ? session->path->finish({.index = session->reader->next_block()}, session->answers)
            : session->program->finish(session->answers);
    return done ? TRC_OK : refuse(*session);
  });
}

int trc_next(trc_session* session, trc_answer* answer) {
  return guarded(session, [&] {
    if (session == nullptr) return no_session();
    if (answer == nullptr) return fail(TRC_ARGUMENT, "answer: is NULL");
    if (!is_size(answer->size, sizeof *answer))
      return fault_of_size("trc_answer", answer->size, sizeof *answer);
    if (session->unusable != TRC_OK) return unusable(*session);
    return next(*session, *answer);
  });
}

int trc_summarize(const trc_session* session, trc_summary* summary) {
  return guarded(nullptr, [&] {
    if (session == nullptr) return no_session();
    if (summary == nullptr) return fail(TRC_ARGUMENT, "summary: is NULL");
    if (!is_size(summary->size, sizeof *summary))
      return fault_of_size("trc_summary", summary->size, sizeof *summary);
    if (session->unusable != TRC_OK) return unusable(*session);
    if (!session->finished && session->refusal.empty())
      return fail(TRC_ORDER, "the session is not finished: trc_finish comes before");
    write_out(summary_of(*session), *summary);
    return session->refusal.empty() ? TRC_OK : fail(TRC_REFUSED, session->refusal);
  });
}

void trc_free(trc_session* session) { delete session; }
