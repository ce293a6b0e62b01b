#include "server/config/config_file.h"

#include <toml++/toml.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <istream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/config/config.h"
#include "server/config/config_settings.h"

namespace trc::server {
namespace {

// A setting as the file gives it.
struct FileEntry {
  std::string name{};
  std::vector<std::string> values{};  // one, or those of a list
  int line = 0;
};

[[noreturn]] void refuse_file(const std::string& file, int line, std::string_view what) {
  std::ostringstream text;
  text << "configuration file " << file << ", line " << line << ": " << what;
  throw CLI::ConfigError(text.str());
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

constexpr std::string_view must_be_plain =
    " must be a string, an integer, true, false or a list of them";

std::string toml_scalar(const std::string& file, const toml::node& node, const std::string& key) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  refuse_file(file, line_of(node), "'" + key + "'" + std::string(must_be_plain));
}

// The dots that may part a key: those outside of quotes and comments. All count where a quotation
// does not end in its line.
std::ptrdiff_t dots_of_keys(std::string_view line) {
  char quote = '\0';
  std::ptrdiff_t dots = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char sign = line[at];
    if (quote == '"' && sign == '\\') {
      ++at;
    } else if (quote != '\0') {
      if (sign == quote) quote = '\0';
    } else if (sign == '"' || sign == '\'') {
      quote = sign;
    } else if (sign == '#') {
      break;
    } else if (sign == '.') {
      ++dots;
    }
  }
  return quote == '\0' ? dots : std::ranges::count(line, '.');
}

// toml++ recurses for each part of a dotted key, however many there are.
std::string toml_text(const std::string& file, std::istream& input) {
  constexpr std::ptrdiff_t most_dots = 16;
  std::string text;
  int line = 0;
  for (std::string one; std::getline(input, one); text += one + '\n') {
    ++line;
    if (dots_of_keys(one) > most_dots)
      refuse_file(file, line, "has a key with more than 16 dots; no setting has one");
  }
  return text;
}

std::vector<FileEntry> toml_entries(const std::string& file, std::istream& input) {
  std::vector<FileEntry> entries;
  try {
    for (const auto& [key_node, value] : toml::parse(toml_text(file, input))) {
      FileEntry entry{.name = std::string(key_node.str()), .line = line_of(value)};
      if (const toml::array* list = value.as_array()) {
        for (const toml::node& one : *list)
          entry.values.push_back(toml_scalar(file, one, entry.name));
      } else {
        entry.values.push_back(toml_scalar(file, value, entry.name));
      }
      entries.push_back(std::move(entry));
    }
  } catch (const toml::parse_error& fault) {
    refuse_file(file, static_cast<int>(fault.source().begin.line), fault.description());
  }
  return entries;
}

// yaml-cpp would give null as the text "null".
std::string yaml_scalar(const std::string& file, const YAML::Node& node, const FileEntry& entry) {
  if (node.IsNull()) refuse_file(file, entry.line, "'" + entry.name + "' has an empty entry");
  if (!node.IsScalar())
    refuse_file(file, entry.line, "'" + entry.name + "'" + std::string(must_be_plain));
  return node.Scalar();
}

std::vector<FileEntry> yaml_entries(const std::string& file, std::istream& input) {
  std::vector<FileEntry> entries;
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(input);
    // Several documents are refused, and so is a repeated key: it is unclear which value counts.
    if (documents.size() > 1)
      refuse_file(file, documents[1].Mark().line + 1, "must hold one document, not several");
    const YAML::Node whole = documents.empty() ? YAML::Node() : documents.front();
    if (!whole.IsMap() && !whole.IsNull())
      refuse_file(file, 1, "must hold settings, `name: value`");
    for (const auto& named : whole) {
      FileEntry entry{.line = named.first.Mark().line + 1};
      if (!named.first.IsScalar()) refuse_file(file, entry.line, "must name a setting");
      entry.name = named.first.Scalar();
      if (std::any_of(entries.begin(), entries.end(),
                      [&](const FileEntry& earlier) { return earlier.name == entry.name; }))
        refuse_file(file, entry.line, "'" + entry.name + "' is there already");
      const YAML::Node& value = named.second;
      if (value.IsNull()) refuse_file(file, entry.line, "'" + entry.name + "' has no value");
      if (value.IsSequence()) {
        for (const YAML::Node& one : value) entry.values.push_back(yaml_scalar(file, one, entry));
      } else {
        entry.values.push_back(yaml_scalar(file, value, entry));
      }
      entries.push_back(std::move(entry));
    }
  } catch (const YAML::Exception& fault) {
    refuse_file(file, fault.mark.line + 1, fault.msg);
  }
  return entries;
}

// Checks one value by itself, on a command line with nothing else.
class ValueCheck {
 public:
  ValueCheck() : app_("", "trcd") {
    declare(app_, config_, printed_);
    for (CLI::Option* option : app_.get_options()) option->envname("");
  }

  [[nodiscard]] std::optional<std::string> fault_of(const std::string& name,
                                                    const std::string& value) {
    try {
      const std::string option = "--" + name;
      // CLI11 parses this vector from the last element to the first.
      app_.parse(value.empty() ? std::vector<std::string>{"", option}
                               : std::vector<std::string>{option + "=" + value});
    } catch (const CLI::Error& fault) {
      return fault.what();
    }
    return std::nullopt;
  }

 private:
  Config config_;
  Printed printed_;
  CLI::App app_;
};

class ConfigFile : public CLI::ConfigTOML {
 public:
  explicit ConfigFile(const CLI::App& app) : app_(app) {}

  [[nodiscard]] std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    const auto file = app_.get_config_ptr()->as<std::string>();
    const bool yaml = file.ends_with(".yaml") || file.ends_with(".yml");
    std::vector<CLI::ConfigItem> settings;
    ValueCheck check;
    for (const FileEntry& entry : yaml ? yaml_entries(file, input) : toml_entries(file, input)) {
      const std::string value = value_of(file, entry);
      if (std::ranges::any_of(value, [](unsigned char sign) { return sign < ' '; }))
        refuse_file(file, entry.line, "'" + entry.name + "' holds a control character");
      if (is_guard(entry.name) && is_empty_value(value))
        refuse_file(file, entry.line,
                    "'" + entry.name + "' is empty; give it a value or leave it out");
      if (std::getenv(environment_name(entry.name).c_str()) != nullptr) continue;
      // An empty list keeps the default, if the list may be empty.
      if (is_list(entry.name) && value.empty() && !needs_entry(entry.name)) continue;
      if (const auto fault = check.fault_of(entry.name, value))
        refuse_file(file, entry.line, *fault);
      CLI::ConfigItem item;
      item.name = entry.name;
      item.inputs = {value};
      settings.push_back(std::move(item));
    }
    return settings;
  }

 private:
  [[nodiscard]] bool is_list(const std::string& name) const {
    return app_.get_option("--" + name)->get_delimiter() != '\0';
  }
  [[nodiscard]] bool needs_entry(const std::string& name) const {
    return app_.get_option("--" + name)->get_expected_min() > 0;
  }

  // The value in the form of flags and of the environment; a list is joined.
  [[nodiscard]] std::string value_of(const std::string& file, const FileEntry& entry) const {
    const CLI::Option* option = app_.get_option_no_throw("--" + entry.name);
    if (option == nullptr || !option->get_configurable())
      refuse_file(file, entry.line,
                  "there is no setting '" + entry.name + "'" +
                      did_you_mean(entry.name, setting_names(app_)));
    if (!is_list(entry.name)) {
      if (entry.values.size() == 1) return entry.values.front();
      refuse_file(file, entry.line, "'" + entry.name + "' is one value, not a list");
    }
    if (entry.values.empty() && needs_entry(entry.name))
      refuse_file(file, entry.line, "'" + entry.name + "' needs at least one entry");
    std::string joined;
    for (std::size_t i = 0; i < entry.values.size(); ++i) {
      if (entry.values[i].find_first_not_of(", ") == std::string::npos)
        refuse_file(file, entry.line, "'" + entry.name + "' has an empty entry");
      if (entry.values.size() > 1 && entry.values[i].find(',') != std::string::npos)
        refuse_file(file, entry.line, "'" + entry.values[i] + "' holds a comma");
      joined += (i > 0 ? "," : "") + entry.values[i];
    }
    return joined;
  }

  const CLI::App& app_;
};

}  // namespace

std::shared_ptr<CLI::Config> config_file(const CLI::App& app) {
  return std::make_shared<ConfigFile>(app);
}

}  // namespace trc::server
