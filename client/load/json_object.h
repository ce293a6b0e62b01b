#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace trc::cli::load {

// A JSON object, member by member, in the order they are added.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, std::string_view text);
  JsonObject& add(std::string_view name, const char* text) {
    return add(name, std::string_view(text));
  }
  JsonObject& add(std::string_view name, double number);
  JsonObject& add(std::string_view name, std::uint64_t number);
  JsonObject& add(std::string_view name, std::same_as<bool> auto truth) {
    return add_value(name, truth ? "true" : "false");
  }
  JsonObject& add(std::string_view name, const JsonObject& object) {
    return add_value(name, object.text());
  }

  [[nodiscard]] std::string text() const { return "{" + members_ + "}"; }

 private:
  JsonObject& add_value(std::string_view name, std::string_view value);

  std::string members_;
};

}  // namespace trc::cli::load
