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

#include "client/c/answer_out.h"
#include "client/c/block_in.h"
#include "client/c/structure.h"
#include "core/base/version.h"
#include "core/messages/diagnostic_text.h"
#include "core/session/program_session.h"
#include "proto/wire/block.h"
#include "proto/wire/json.h"
#include "proto/wire/settings.h"
#include "proto/wire/setup.h"

namespace wire = trc::wire;
namespace v1 = trc::v1;

// One of the two sessions of the core, and its answers that have not been taken yet.
struct trc_session {
  std::optional<trc::PathSession> path{};
  std::optional<trc::ProgramSession> program{};

  // For blocks.
  std::optional<wire::BlockReader> reader{};
  v1::BlockBatch batch{};
  wire::Json json{};

  trc::Answers answers{};
  trc::Answer taken{};  // the part being taken
  bool text_has_left = false;
  std::size_t next_block = 0;  // of that part
  std::size_t next_diagnostic = 0;

  trc::c::AnswerOut last{};

  bool finished = false;
  std::string refusal{};  // empty: not refused
  int unusable = TRC_OK;  // TRC_MEMORY or TRC_INTERNAL after an exception

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

// Of fixed size, so that an error message needs no memory.
thread_local std::array<char, 1024> last_error{};

int fail(int status, std::string_view text) {
  std::size_t size = std::min(text.size(), last_error.size() - 1);
  // Does not cut a character in two.
  if (size < text.size())
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80U) --size;
  std::copy_n(text.data(), size, last_error.data());
  last_error[size] = '\0';
  return status;
}

// After an exception the session cannot go on.
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

int fault_of_newer(const char* name) {
  return fail(TRC_ARGUMENT, std::string(name) + ": it holds what only a newer library than " +
                                std::string(trc::version()) + " knows");
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
    session->program.emplace(
        trc::ProgramSessionSetup{.session = settings.path.session, .nc_text = settings.nc_text});
  } else {
    const wire::PathSettings settings = wire::from_proto(setup.path(), place, faults);
    if (!faults.empty()) return fail(TRC_ARGUMENT, text_of(faults));
    session->path.emplace(settings.session);
    session->reader.emplace(settings.session.program.tracking_axes.size());
  }
  return TRC_OK;
}

// --- Blocks in

int fault_of_block(const trc_session& session, const std::string& fault) {
  return fail(TRC_ARGUMENT, "block " + std::to_string(session.reader->next_block()) + ": " + fault);
}

// The part after "batch.blocks[3].": an index in the library's own batch means nothing to the
// caller.
std::string without_batch(const wire::FieldFault& fault) {
  const std::size_t bracket = fault.field.find("].");
  const std::string field =
      bracket == std::string::npos ? std::string() : fault.field.substr(bracket + 2) + " ";
  return field + fault.description;
}

// Fails with the error that has just stopped the session, in one sentence.
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

// Gives the blocks in the batch to the session.
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
  // Few enough blocks to stay in the caches.
  constexpr std::size_t group = 256;
  for (std::size_t first = 0; first < count; first += group) {
    session.batch.Clear();
    std::string fault;
    for (std::size_t i = first; i < std::min(count, first + group) && fault.empty(); ++i) {
      const unsigned char* given = blocks + i * block_size;
      trc_block block{};
      std::memcpy(&block, given, sizeof block);
      fault = trc::c::is_zero_behind(given, sizeof block, block_size)
                  ? trc::c::write_block(block, session.json, *session.batch.add_blocks())
                  : "it holds what only a newer library knows";
      // A block that is only partly written is not given.
      if (!fault.empty() && session.batch.blocks_size() > static_cast<int>(i - first))
        session.batch.mutable_blocks()->RemoveLast();
    }
    if (const int status = give_batch(session); status != TRC_OK) return status;
    if (!fault.empty()) return fault_of_block(session, fault);
  }
  return TRC_OK;
}

// --- Answers out

// Takes the next part; false: there is none.
bool take_part(trc_session& session) {
  auto& parts = session.answers.parts();
  while (parts.size() > 1 && parts.front().empty()) parts.pop_front();
  if (parts.front().empty()) return false;
  session.taken.text.clear();
  session.taken.blocks.clear();
  session.taken.diagnostics.clear();
  // Swapping lets the next part reuse the memory of the last one.
  std::swap(session.taken, parts.front());
  if (parts.size() > 1) parts.pop_front();
  session.text_has_left = session.taken.text.empty();
  session.next_block = 0;
  session.next_diagnostic = 0;
  return true;
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
      answer.motion = session.last.motion_of(session.taken.blocks[session.next_block++]);
      break;
    }
    if (session.next_diagnostic < session.taken.diagnostics.size()) {
      answer.kind = TRC_ANSWER_DIAGNOSTIC;
      answer.diagnostic =
          session.last.diagnostic_of(session.taken.diagnostics[session.next_diagnostic++]);
      break;
    }
    if (!take_part(session)) {
      trc::c::write_out(answer, out);
      return TRC_END;
    }
  }
  trc::c::write_out(answer, out);
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
    trc::c::copy(measured->worst->place, summary.clearance_at);
    summary.clearance_wall = measured->worst->contour.index;
  });
  if (session.program) summary.lines_in = session.program->lines_read();
  return summary;
}

// The fault that keeps a session from taking more input, or TRC_OK. `takes`: whether the session
// takes input of this kind.
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
  // A literal "major.minor.patch", so it ends with NUL.
  return trc::version().data();
}

const char* trc_last_error(void) { return last_error.data(); }

int trc_create(const trc_setup* setup, trc_session** session) {
  if (session == nullptr) return fail(TRC_ARGUMENT, "session: is NULL");
  *session = nullptr;
  if (setup == nullptr) return fail(TRC_ARGUMENT, "setup: is NULL");
  return guarded(nullptr, [&] {
    if (!trc::c::is_size(setup->size, sizeof *setup))
      return fault_of_size("trc_setup", setup->size, sizeof *setup);
    if (!trc::c::is_zero_behind(setup, sizeof *setup, setup->size))
      return fault_of_newer("trc_setup");
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
    if (!trc::c::is_size(block_size, sizeof(trc_block)))
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
    if (!trc::c::is_size(answer->size, sizeof *answer))
      return fault_of_size("trc_answer", answer->size, sizeof *answer);
    if (session->unusable != TRC_OK) return unusable(*session);
    return next(*session, *answer);
  });
}

int trc_summarize(const trc_session* session, trc_summary* summary) {
  return guarded(nullptr, [&] {
    if (session == nullptr) return no_session();
    if (summary == nullptr) return fail(TRC_ARGUMENT, "summary: is NULL");
    if (!trc::c::is_size(summary->size, sizeof *summary))
      return fault_of_size("trc_summary", summary->size, sizeof *summary);
    if (session->unusable != TRC_OK) return unusable(*session);
    if (!session->finished && session->refusal.empty())
      return fail(TRC_ORDER, "the session is not finished: trc_finish comes before");
    trc::c::write_out(summary_of(*session), *summary);
    return session->refusal.empty() ? TRC_OK : fail(TRC_REFUSED, session->refusal);
  });
}

void trc_free(trc_session* session) { delete session; }
