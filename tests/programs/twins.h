#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/geometry/segment.h"
#include "tests/programs/computing.h"

namespace trc::support {

struct TwinOfADialect {
  Twin twin{};
  DialectName dialect{};
};

inline std::ostream& operator<<(std::ostream& out, const TwinOfADialect& tested) {
  return out << tested.twin;
}

inline std::vector<TwinOfADialect> with_setup(std::vector<Twin> twins, DialectName dialect) {
  std::vector<TwinOfADialect> all;
  for (Twin& twin : twins) all.push_back({.twin = std::move(twin), .dialect = dialect});
  return all;
}

inline std::string name_of_twin(const ::testing::TestParamInfo<TwinOfADialect>& tested) {
  return tested.param.twin.name;
}

// A program that computes, and the program that a person would write in its place.
class Twins : public ::testing::TestWithParam<TwinOfADialect> {
 protected:
  [[nodiscard]] const Twin& twin() const { return GetParam().twin; }
  [[nodiscard]] ProgramSessionSetup setup() const { return computing_setup(GetParam().dialect); }
};

}  // namespace trc::support
