#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/call_places.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// The files of --subprograms, for messages that show one of their lines.
class GivenSubprograms {
 public:
  explicit GivenSubprograms(const v1::ProgramSetup& setup);

  struct Line {
    std::string file{};
    std::string text{};
  };
  // Nothing where the place is in the program itself, or where no file, or more than one, has the
  // name of the subprogram.
  [[nodiscard]] std::optional<Line> line_of(const CallPlace& place) const;

 private:
  std::map<std::string, std::string> texts_{};
};

}  // namespace trc::cli
