#include "server/http/page.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "server/http/api.h"
#include "server/http/handlers.h"
#include "server/http/problem.h"

namespace trc::server::http {
namespace {

// The page holds everything it needs; it loads nothing else and runs nothing inline.
constexpr const char* policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> types{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
  }};
  for (const auto& [ending, type] : types)
    if (name.ends_with(ending)) return std::string(type);
  return "application/octet-stream";
}

void answer_file(Exchange& exchange, std::string_view name) {
  const auto files = page_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const PageFile& file) { return file.name == name; });
  if (found == files.end())
    return answer_problem(exchange, problem(404, "NOT_FOUND", "There is nothing at this path",
                                            "the page has no such file"));
  exchange.answer({.content_type = type_of(name),
                   .headers = {{"Content-Security-Policy", policy}, {"Cache-Control", "no-cache"}}},
                  std::string(found->content));
}

}  // namespace

void page_start(Api& /*api*/, const ExchangePointer& exchange) {
  answer_file(*exchange, "index.html");
}

void page_file(Api& /*api*/, const ExchangePointer& exchange) {
  const std::string_view path = exchange->request().path;
  answer_file(*exchange, path.substr(path.rfind('/') + 1));
}

void offered_program(Api& api, const ExchangePointer& exchange) {
  const std::string_view path = exchange->request().path;
  const Offer* offer = api.offer();
  if (offer == nullptr || offer->token != path.substr(path.rfind('/') + 1))
    return answer_problem(*exchange, problem(404, "NOT_FOUND", "There is nothing at this path",
                                             "no program is offered under this name"));
  exchange->answer({.content_type = "application/octet-stream",
                    .headers = {{"Trc-Name", offer->name}, {"Trc-Settings", offer->settings}}},
                   offer->text);
}

}  // namespace trc::server::http
