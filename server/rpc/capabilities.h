#pragma once

#include <span>
#include <string_view>

namespace trc::server {

// A keyword of the `#TRC` command (spec section 7).
struct Keyword {
  std::string_view name;
  double min = 0;
  double max = 1;
  double initial = 0;
  std::string_view unit = "";
  bool available = true;  // else refused with 900102
};

// A G function as NC text knows it (spec section 1.8).
struct GFunction {
  std::string_view name;
  std::string_view group;
  bool initial = false;
  std::string_view meaning;
};

std::span<const Keyword> trc_keywords();
std::span<const GFunction> g_functions();

}  // namespace trc::server
