#include "client/cli/standalone_page.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/base/version.h"
#include "proto/wire/json.h"
#include "server/http/page.h"

namespace trc::cli {
namespace {

using server::http::Element;
using server::http::Elements;
using server::http::Lines;
using server::http::View;

static_assert(std::endian::native == std::endian::little);

std::string base64_of(std::string_view bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

// The hash by which a policy allows a script or a style inside a page.
std::string hash_of(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available");
  return "'sha256-" + base64_of({reinterpret_cast<const char*>(digest.data()), size}) + "'";
}

std::string_view page_file(std::string_view name) {
  for (const auto& file : server::http::page_files())
    if (file.name == name) return file.content;
  throw std::logic_error("the page has no file " + std::string(name));
}

// Makes one script from the modules of the page. Each becomes a function that returns its exports.
class Bundle {
 public:
  std::string of(std::string_view name) {
    script_ = "'use strict';\nconst modules = {};\n";
    add(name);
    return std::move(script_);
  }

 private:
  void add(std::string_view name) {
    if (std::find(added_.begin(), added_.end(), name) != added_.end()) return;
    added_.push_back(name);
    std::string body;
    std::string exported;
    std::string_view text = page_file(name);
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      add_line(text.substr(0, end), body, exported);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    script_ += "modules['" + std::string(name) + "'] = (() => {\n" + body + "return {" + exported +
               "};\n})();\n";
  }

  // The modules write each import on one line, and `export` before a declaration.
  void add_line(std::string_view line, std::string& body, std::string& exported) {
    constexpr std::string_view importing = "import ";
    constexpr std::string_view importing_no_name = "import './";
    constexpr std::string_view exporting = "export ";
    if (line.starts_with(importing_no_name)) {
      line.remove_prefix(importing_no_name.size());
      return add(line.substr(0, line.find('\'')));
    }
    if (line.starts_with(importing)) {
      const std::size_t from = line.find(" from './");
      std::string_view names = line.substr(importing.size(), from - importing.size());
      constexpr std::string_view all = "* as ";
      if (names.starts_with(all)) names.remove_prefix(all.size());
      std::string_view file = line.substr(from + 9);
      file = file.substr(0, file.find('\''));
      add(file);
      body += "const " + std::string(names) + " = modules['" + std::string(file) + "'];\n";
      return;
    }
    if (line.starts_with(exporting)) {
      line.remove_prefix(exporting.size());
      constexpr std::array<std::string_view, 5> kinds{"const ", "let ", "class ", "async function ",
                                                      "function "};
      for (const std::string_view kind : kinds) {
        if (!line.starts_with(kind)) continue;
        const std::string_view name = line.substr(kind.size());
        exported += std::string(name.substr(0, name.find_first_of(" =({"))) + ", ";
        break;
      }
    }
    body += line;
    body += '\n';
  }

  std::vector<std::string_view> added_;
  std::string script_;
};

template <class Number>
void append(std::string& bytes, Number number) {
  std::array<char, sizeof number> own{};
  std::memcpy(own.data(), &number, sizeof number);
  bytes.append(own.data(), own.size());
}

// In columns for typed arrays; client/page/inside.js reads them.
std::string columns_of(const Elements& elements) {
  std::string ends;
  std::string values;
  std::string words;
  std::string arcs;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Element& element = elements[i];
    for (const double mm : {element.start.x(), element.start.y(), element.end.x(), element.end.y()})
      append(ends, mm);
    for (const float value :
         {element.third_from, element.third_to, element.feed, element.tool_radius})
      append(values, value);
    append(words, element.line);
    append(words, static_cast<std::uint32_t>(element.style) |
                      static_cast<std::uint32_t>(element.origin) << 16U |
                      static_cast<std::uint32_t>(element.plane) << server::http::plane_shift |
                      (element.rapid ? server::http::rapid_flag : 0U) |
                      (element.from_unknown ? server::http::from_unknown_flag : 0U));
    const Segment shape = elements.shape_of(element);
    const auto* arc = std::get_if<Arc>(&shape);
    append(words, arc == nullptr ? 0U : static_cast<std::uint32_t>(element.arc + 1));
    if (arc == nullptr) continue;
    for (const double value : {arc->center.x(), arc->center.y(), arc->sweep}) append(arcs, value);
  }
  return "{\"ends\":\"" + base64_of(ends) + "\",\"values\":\"" + base64_of(values) +
         "\",\"words\":\"" + base64_of(words) + "\",\"arcs\":\"" + base64_of(arcs) + "\"}";
}

// The text as base64 of its UTF-8, because a program may hold any characters.
std::string text_of(const Lines& lines) { return "\"" + base64_of(lines.text()) + "\""; }

std::string json_of(const View& view, std::string_view language) {
  std::string json = "{\"version\":\"" + std::string(version()) + "\",";
  if (!language.empty()) json += "\"language\":\"" + std::string(language) + "\",";
  json += "\"view\":";
  json += wire::json_of(view.said_by_now());
  json += ",\"text\":" + text_of(view.program());
  if (const auto output = view.output()) {
    json += ",\"output\":" + text_of(*output) + ",\"sources\":[";
    for (std::size_t i = 0; i < output->sources().size(); ++i)
      json += (i == 0 ? "" : ",") + std::to_string(output->sources()[i]);
    json += "]";
  }
  json += ",\"contour\":" + columns_of(view.contour()) + ",\"path\":" + columns_of(view.path());
  // A name may look like the end of the element that contains this text.
  std::string safe;
  for (const char c : json + "}") {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

void replace(std::string& text, std::string_view old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the page has no " + std::string(old));
  text.replace(at, old.size(), by);
}

}  // namespace

std::string standalone_page(const View& view, std::string_view language) {
  const std::string script = Bundle().of("main.js");
  const std::string style(page_file("style.css"));
  const std::string policy = "default-src 'none'; script-src " + hash_of(script) + "; style-src " +
                             hash_of(style) +
                             "; img-src data: blob:; base-uri 'none'; form-action 'none'";
  std::string page(page_file("index.html"));
  replace(page, "<link rel=\"stylesheet\" href=\"page/style.css\">",
          "<meta http-equiv=\"Content-Security-Policy\" content=\"" + policy + "\">\n<style>" +
              style + "</style>");
  replace(page, "<script type=\"module\" src=\"page/main.js\"></script>\n", "");
  replace(page, "</body>",
          "<script type=\"application/json\" id=\"inside\">" + json_of(view, language) +
              "</script>\n<script>" + script + "</script>\n</body>");
  return page;
}

}  // namespace trc::cli
