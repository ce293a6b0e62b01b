#pragma once

#include <string>

namespace trc::server::http {

// A program that `trc view` shows.
struct Offer {
  std::string token{};     // names it, not to be guessed
  std::string name{};      // percent-encoded
  std::string settings{};  // as a query
  std::string text{};
};

}  // namespace trc::server::http
