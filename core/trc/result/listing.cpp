#include "core/trc/result/listing.h"

#include <charconv>
#include <numbers>

#include "core/nc/text/number_format.h"

namespace trc {
namespace {

void append_integer(std::string& out, std::int64_t number) {
  char digits[24];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void append_position(std::string& out, const Position& position, int decimals) {
  for (const double coordinate : position) {
    out += ' ';
    append_fixed(out, coordinate, decimals);
  }
}

void append_tracking(std::string& out, const CompensatedBlock& block,
                     std::span<const std::string> tracking_axes, int decimals) {
  for (std::size_t i = 0; i < block.tracking.size(); ++i) {
    const AxisTravel& travel = block.tracking[i];
    if (!travel.moves()) continue;
    out += ' ';
    if (i < tracking_axes.size()) {
      out += tracking_axes[i];
    } else {
      out += '#';
      append_integer(out, static_cast<std::int64_t>(i) + 1);
    }
    out += ' ';
    append_fixed(out, travel.from, decimals);
    out += " -> ";
    append_fixed(out, travel.to, decimals);
  }
}

}  // namespace

std::string_view name_of(Origin origin) {
  switch (origin) {
    case Origin::programmed:
      return "programmed";
    case Origin::approach:
      return "approach";
    case Origin::retract:
      return "retract";
    case Origin::transition:
      return "transition";
    case Origin::masked:
      return "masked";
    case Origin::radius_change:
      return "radius_change";
    case Origin::kerf:
      return "kerf";
    case Origin::converted_circle:
      return "converted_circle";
    case Origin::passthrough:
      return "passthrough";
    case Origin::uncompensated:
      break;
  }
  return "uncompensated";
}

void append_listing(std::string& out, const CompensatedBlock& block,
                    std::span<const std::string> tracking_axes, int decimals) {
  if (block.source.number == Source::no_number) {
    out += '-';
  } else {
    append_integer(out, block.source.number);
  }
  out += ' ';
  out += name_of(block.origin);
  if (block.origin == Origin::passthrough) {
    if (!block.text.empty()) (out += ' ') += block.text;
    return;
  }

  const auto* arc = std::get_if<Arc>(&block.path);
  out += arc != nullptr ? " arc" : block.rapid ? " rapid" : " line";
  append_position(out, from_plane(block.plane, start_of(block.path), block.normal.from), decimals);
  out += " ->";
  append_position(out, from_plane(block.plane, end_of(block.path), block.normal.to), decimals);
  if (arc != nullptr) {
    out += " center";
    append_position(out, from_plane(block.plane, arc->center, block.normal.from), decimals);
    out += " sweep ";
    append_fixed(out, arc->sweep * 180 / std::numbers::pi, decimals);
  }
  append_tracking(out, block, tracking_axes, decimals);
  if (!block.rapid && block.feed > 0) {
    out += " F";
    append_units(out, to_units(block.feed, decimals), decimals);
  }
}

}  // namespace trc
