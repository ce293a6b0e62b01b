#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/nc/dialect/g_function.h"
#include "core/nc/dialect/interpreter.h"
#include "core/nc/state/program_state.h"

namespace trc {

// What the words of one block say, before any of it takes effect: the order of
// the words within a block does not matter.
struct Interpreter::BlockWords {
  struct Function {
    const GFunction* function = nullptr;
    std::uint32_t begin = 0;

    [[nodiscard]] bool is(int number) const {
      return function != nullptr && function->number == number;
    }
  };
  struct Value {
    double value = 0;
    std::uint32_t begin = 0;
  };

  [[nodiscard]] const Function& of(GGroup group) const {
    return functions[static_cast<std::size_t>(group)];
  }
  [[nodiscard]] bool has(GGroup group) const { return of(group).function != nullptr; }

  std::array<Function, g_group_count> functions{};
  MoveRequest move{};                     // in the unit of the program
  std::optional<std::uint32_t> axis{};    // where the first axis word stands
  std::optional<std::uint32_t> center{};  // the first I J K R
  std::optional<Value> feed{};
  std::optional<Value> tool{};          // D
  std::optional<Value> tool_radius{};   // V.G.WZ_AKT.R
  std::optional<TrcOptions> options{};  // #TRC
  std::optional<double> tangfeed{};     // #TANGFEED
  std::optional<std::uint32_t> number_alone{};
  std::uint32_t command = 0;  // where a # command stands
  bool has_command = false;
  bool has_spindle = false;
  bool has_tool_number = false;
  std::uint32_t words = 0;  // without N and comments
};

}  // namespace trc
