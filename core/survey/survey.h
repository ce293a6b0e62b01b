#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/session/path_session.h"
#include "core/survey/program_reading.h"
#include "core/verify/clearance.h"
#include "core/verify/selection_walls.h"

namespace trc::survey {

// The most radii of one program in one survey.
inline constexpr std::size_t most_radii = 64;

struct SurveySetup {
  // Its radius and tools are not used; `verify` off means enforce.
  SessionSetup session{};
  // Measures what each radius leaves uncut. For a refused radius: with the path that G141 with
  // REMOVE_MASKED_BLOCKS would give.
  bool uncut = false;
  // Is called when part of a path has come out.
  std::function<void()> progressed{};
};

// The result of a session with one radius.
struct Surveyed {
  double radius = 0;                    // mm
  std::optional<Diagnostic> refusal{};  // it is refused with this
  Summary summary{};
  verify::ClearanceReport clearance{};
  double left_out_length = 0;  // mm of wall, of masked blocks and removed loops
  std::uint64_t warnings = 0;

  // Where SurveySetup::uncut asks for it. `uncut_by_removal`: of a path with removed loops in place
  // of the one that is refused; that may be refused as well.
  bool uncut_known = false;
  bool uncut_by_removal = false;
  double wall_length = 0;   // mm
  double uncut_length = 0;  // mm, of these
  std::vector<verify::UncutWall> uncut{};

  [[nodiscard]] bool accepted() const { return !refusal.has_value(); }
  // The path touches every wall that a corner does not cut off: nothing is left out, and the path
  // is nowhere nearer than the radius.
  bool reaches_all = false;
  // Where it does not: the blocks in the way.
  std::vector<Source> limits{};
};

// The largest radius that reaches every wall.
struct Largest {
  double radius = 0;       // mm, whole micrometres; 0: none
  bool is_limited = true;  // false: the search ended there, all do
  // The result with a micrometre more.
  std::optional<Diagnostic> refusal{};
  std::vector<Source> limits{};  // the two blocks; one where it is too small by itself
  std::uint32_t runs = 0;        // it took
};

// One program and many radii: it is read once, and each radius has a session of its own over the
// blocks. A program whose blocks depend on the radius (G40 under G239) is read for each.
class Survey {
 public:
  Survey(SurveySetup setup, Reader reader);

  // False: the program cannot be read, whatever the radius; diagnostics() say why.
  bool read();
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return reading_.diagnostics; }
  [[nodiscard]] std::size_t blocks() const { return reading_.blocks.size(); }

  // mm, of the tool itself: wear and allowance of the setup are added.
  [[nodiscard]] Surveyed run(double radius);
  // Finds the largest radius; uses the runs made so far.
  [[nodiscard]] Largest largest();

 private:
  struct Tried {
    bool reaches = false;
    std::optional<double> guess{};  // the largest radius, as what is in the way tells it
    std::optional<Diagnostic> refusal{};
    std::vector<Source> limits{};
  };
  using Micrometres = std::int64_t;

  // The radius as the state holds it: in wear mode a difference.
  [[nodiscard]] double term_of(double radius) const;
  enum class LoopHandling : std::uint8_t { as_programmed, removed };
  void compensate(const ProgramReading& reading, LoopHandling loops, Surveyed& found);
  void look_for_uncut(const ProgramReading& reading, Surveyed& found);
  [[nodiscard]] std::optional<Diagnostic> too_much_wear(const ProgramReading& reading,
                                                        double radius) const;
  [[nodiscard]] std::vector<Source> limits_of(const ProgramReading& reading,
                                              const Surveyed& found) const;
  [[nodiscard]] static std::vector<Source> around(const ProgramReading& reading,
                                                  const Source& pinched);
  [[nodiscard]] static std::optional<double> guess_of(const Surveyed& found);
  [[nodiscard]] double search_limit() const;
  const Tried& tried(Micrometres radius);
  // Every radius up to `low` reaches every wall, `high` does not; without it nothing is known.
  struct Bracket {
    Micrometres low = 0;
    std::optional<Micrometres> high{};
    std::optional<double> guess{};  // mm, of `high`
  };
  [[nodiscard]] Bracket bracket_of_list() const;
  void look_above(Bracket& bracket);
  void narrow(Bracket& bracket);

  SurveySetup setup_;
  Reader reader_;
  ProgramReading reading_;
  verify::KnownWalls walls_;       // the same for all radii, mostly
  std::map<double, Tried> tried_;  // by radius, mm
  std::uint32_t runs_ = 0;         // for the largest
};

}  // namespace trc::survey
