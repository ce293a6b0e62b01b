#include "server/http/exchange.h"

#include <algorithm>

namespace trc::server::http {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string_view without_parameters(std::string_view type) {
  return trimmed(type.substr(0, type.find(';')));
}

}  // namespace

std::string_view Request::header(std::string_view name) const {
  const auto found = std::find_if(headers.begin(), headers.end(),
                                  [&](const auto& pair) { return pair.first == name; });
  return found == headers.end() ? std::string_view() : found->second;
}

bool Request::accepts(std::string_view type) const {
  std::string_view left = header("accept");
  while (!left.empty()) {
    const std::string_view one = left.substr(0, left.find(','));
    if (without_parameters(one) == type) return true;
    left.remove_prefix(std::min(left.size(), one.size() + 1));
  }
  return false;
}

std::string_view Request::content_type() const {
  return without_parameters(header("content-type"));
}

}  // namespace trc::server::http
