#include "server/http/uri.h"

#include <algorithm>
#include <utility>

#include "core/base/ascii.h"

namespace trc::server::http {
namespace {

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// In a query a plus sign means a blank.
std::optional<std::string> decoded(std::string_view text, bool plus_is_blank) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && plus_is_blank) {
      result += ' ';
    } else if (text[i] != '%') {
      result += text[i];
    } else {
      const int high = i + 2 < text.size() ? digit_of(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? digit_of(text[i + 2]) : -1;
      if (high < 0 || low < 0) return std::nullopt;
      result += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return result;
}

// Takes scheme and host from an absolute target and leaves its path; false: the target has none.
bool take_origin(std::string_view& target, Target& read) {
  constexpr std::string_view mark = "://";
  const std::size_t end = target.find(mark);
  if (end == std::string_view::npos || end == 0) return false;
  const std::string_view rest = target.substr(end + mark.size());
  const std::size_t path = std::min(rest.find_first_of("/?"), rest.size());
  if (!is_authority(rest.substr(0, path))) return false;
  read.scheme = in_lower_case(target.substr(0, end));
  read.host = rest.substr(0, path);
  target = rest.substr(path);
  return true;
}

}  // namespace

bool is_authority(std::string_view text) {
  std::string_view port;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos || end == 1) return false;
    port = text.substr(end + 1);
    if (!port.empty() && !port.starts_with(':')) return false;
  } else {
    const std::size_t colon = std::min(text.find(':'), text.size());
    if (colon == 0) return false;
    port = text.substr(colon);
  }
  if (!port.empty()) port.remove_prefix(1);
  return port.find_first_not_of("0123456789") == std::string_view::npos &&
         text.find_first_of("@\\/") == std::string_view::npos;
}

std::optional<Target> read_target(std::string_view method, std::string_view target) {
  // A fragment is never sent. Where someone forgot to write %23, settings after it would be lost.
  if (target.find('#') != std::string_view::npos) return std::nullopt;
  Target read;
  const bool is_whole = !target.starts_with('/') && target != "*";
  if (is_whole && !take_origin(target, read)) return std::nullopt;
  // An absolute target without a path means the root, or for OPTIONS the whole server.
  if (target.empty()) target = method == "OPTIONS" ? "*" : "/";
  if (target == "*" && method != "OPTIONS") return std::nullopt;
  const std::size_t mark = target.find('?');
  auto path = mark == 0 ? std::string("/") : decoded(target.substr(0, mark), false);
  if (!path) return std::nullopt;
  const bool controls =
      std::any_of(path->begin(), path->end(), [](char c) { return c >= 0 && c < ' '; });
  if (controls) return std::nullopt;
  read.path = std::move(*path);
  std::string_view query = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    auto name = decoded(pair.substr(0, equals), true);
    auto value = decoded(equals == std::string_view::npos ? "" : pair.substr(equals + 1), true);
    if (!name || !value) return std::nullopt;
    read.query.emplace_back(std::move(*name), std::move(*value));
  }
  return read;
}

}  // namespace trc::server::http
