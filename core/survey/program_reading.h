#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/checkpoint.h"
#include "core/base/diagnostics.h"
#include "core/nc/program/program_reader.h"
#include "core/nc/state/block.h"
#include "core/nc/state/program_state.h"
#include "core/session/path_session.h"

namespace trc::survey {

// Passes a whole program to the state and ends it. Faults go to the log.
using Reader = std::function<void(ProgramState& state, Diagnostics& log)>;

// A reader of NC text, which must outlive it.
[[nodiscard]] Reader text_reader(std::string_view text, const ReaderLimits& limits,
                                 Checkpoint::Interrupt interrupt);

// A program as it was read with one radius in place of all its own.
struct ProgramReading {
  double radius = 0;  // ProgramSetup::every_radius
  std::vector<Block> blocks{};
  std::vector<RadiusUse> uses{};  // of every mode that a block has
  TrcMode at_end{};
  RadiusUse use_at_end{};
  bool moves_by_radius = false;  // with another radius blocks begin elsewhere
  std::vector<Diagnostic> diagnostics{};
  ProgramPlaces places{};
  bool refused = false;
};
[[nodiscard]] ProgramReading read_with(double radius, const SessionSetup& session,
                                       const Reader& reader);

// A change to the modes of a reading.
struct ModeChange {
  double radius = 0;           // ProgramSetup::every_radius
  bool removes_loops = false;  // G141 with REMOVE_MASKED_BLOCKS, whatever was programmed
};

// The modes of a reading changed to another radius: the same that reading with it would give.
class ChangedModes {
 public:
  ChangedModes(const ProgramReading& reading, const ModeChange& change);

  // Makes `result` the block with the changed mode; it keeps the memory it has.
  void change(const Block& block, Block& result);
  [[nodiscard]] const TrcMode& at_end() const { return at_end_; }

 private:
  [[nodiscard]] TrcMode changed(TrcMode mode, const RadiusUse& use, double read_with) const;

  ModeChange change_;
  std::unordered_map<const TrcMode*, std::shared_ptr<const TrcMode>> modes_;
  const TrcMode* last_ = nullptr;
  std::shared_ptr<const TrcMode> changed_last_;
  TrcMode at_end_;
};

}  // namespace trc::survey
