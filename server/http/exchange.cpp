#include "server/http/exchange.h"

#include <algorithm>
#include <utility>

#include "core/base/ascii.h"
#include "server/resources/peers.h"

namespace trc::server::http {
namespace {

// "text/plain" for "Text/plain; charset=utf-8".
std::string without_parameters(std::string_view type) {
  return in_lower_case(trimmed(type.substr(0, type.find(';')), " "));
}

std::string parameter_of(std::string_view type, std::string_view name) {
  while (type.find(';') != std::string_view::npos) {
    type.remove_prefix(type.find(';') + 1);
    const std::string_view one = type.substr(0, type.find(';'));
    const std::size_t equals = std::min(one.find('='), one.size());
    if (in_lower_case(trimmed(one.substr(0, equals), " ")) != name || equals == one.size())
      continue;
    std::string_view value = trimmed(one.substr(equals + 1), " ");
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    return in_lower_case(value);
  }
  return {};
}

}  // namespace

std::string client_of(const std::string& peer) {
  return peer_of_address((peer.starts_with('[') ? "ipv6:" : "ipv4:") + peer);
}

std::string_view Request::header(std::string_view name) const {
  const auto found = std::find_if(headers.begin(), headers.end(),
                                  [&](const auto& pair) { return pair.first == name; });
  return found == headers.end() ? std::string_view() : found->second;
}

void Request::set_header(std::string_view name, std::string value) {
  std::erase_if(headers, [&](const auto& pair) { return pair.first == name; });
  headers.emplace_back(name, std::move(value));
}

bool Request::accepts(std::string_view type) const {
  std::string_view left = header("accept");
  while (!left.empty()) {
    const std::string_view one = left.substr(0, left.find(','));
    const std::string quality = parameter_of(one, "q");
    const bool is_refused =
        !quality.empty() && quality.find_first_not_of("0.") == std::string::npos;
    if (!is_refused && without_parameters(one) == type) return true;
    left.remove_prefix(std::min(left.size(), one.size() + 1));
  }
  return false;
}

std::string Request::content_type() const { return without_parameters(header("content-type")); }

bool is_text(std::string_view content_type) {
  return content_type.empty() || content_type.starts_with("text/") ||
         content_type == "application/octet-stream";
}

bool is_json(std::string_view content_type) {
  return content_type == "application/json" || content_type == "application/x-www-form-urlencoded";
}

std::string Request::charset() const { return parameter_of(header("content-type"), "charset"); }

std::shared_ptr<const std::string> Request::take_body() {
  return std::make_shared<const std::string>(std::exchange(body, {}));
}

}  // namespace trc::server::http
