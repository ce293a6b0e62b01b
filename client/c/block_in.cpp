#include "client/c/block_in.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/utf8.h"
#include "core/nc/text/characters.h"

namespace trc::c {
namespace {

constexpr std::uint32_t end_bits = TRC_HAS_X | TRC_HAS_Y | TRC_HAS_Z;
constexpr std::uint32_t center_bits = TRC_HAS_I | TRC_HAS_J | TRC_HAS_K;

// The fields that a block of this kind may have; none: the kind does not exist.
std::optional<std::uint32_t> allowed_bits(std::int32_t kind) {
  switch (kind) {
    case TRC_RAPID:
    case TRC_LINE:
      return end_bits | TRC_HAS_FEED | TRC_HAS_NUMBER;
    case TRC_CLOCKWISE:
    case TRC_COUNTER_CLOCKWISE:
      return end_bits | center_bits | TRC_HAS_RADIUS | TRC_HAS_FEED | TRC_HAS_NUMBER;
    case TRC_TEXT:
    case TRC_LEFT:
    case TRC_RIGHT:
    case TRC_OFF:
    case TRC_COMMAND:
      return TRC_HAS_NUMBER;
    default:
      return {};
  }
}

bool is_motion(std::int32_t kind) { return kind >= TRC_RAPID && kind <= TRC_COUNTER_CLOCKWISE; }

// The fault of the block itself, whatever its values; empty: none.
std::string fault_in(const trc_block& block) {
  const auto allowed = allowed_bits(block.kind);
  if (!allowed) return "kind is " + std::to_string(block.kind) + ", allowed are 1 to 9 (trc_kind)";
  if ((block.given & ~*allowed) != 0)
    return "given is " + std::to_string(block.given) + ", a block of this kind may have " +
           std::to_string(*allowed) + " (trc_given)";
  if ((block.given & TRC_HAS_RADIUS) != 0 && (block.given & center_bits) != 0)
    return "given names a radius and a centre; an arc has one of them";
  if ((block.given & TRC_HAS_NUMBER) != 0 && block.number < 0)
    return "number is " + std::to_string(block.number) + ", allowed is 0 or more";
  if (block.role < TRC_ROLE_OF_SETUP || block.role > TRC_ROLE_LEAD)
    return "role is " + std::to_string(block.role) + ", allowed are 0 to 2 (trc_role)";
  if (!is_motion(block.kind) && (block.role != TRC_ROLE_OF_SETUP || block.axis_count > 0))
    return "a block without motion has no role and no axes";
  if (block.axis_count > 0 && block.axes == nullptr) return "axes is NULL, axis_count is not 0";
  if (block.kind != TRC_TEXT && block.kind != TRC_COMMAND) return {};
  if (block.text == nullptr) return "text is NULL";
  const std::string_view text = block.text;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_character(text.substr(at));
    if (bytes == 0) return "text is no UTF-8 at byte " + std::to_string(at);
    at += bytes;
  }
  return {};
}

template <class Move>
void write_move(const trc_block& block, Move& move) {
  v1::Position& end = *move.mutable_end();
  if ((block.given & TRC_HAS_X) != 0) end.set_x(block.x);
  if ((block.given & TRC_HAS_Y) != 0) end.set_y(block.y);
  if ((block.given & TRC_HAS_Z) != 0) end.set_z(block.z);
  if ((block.given & TRC_HAS_FEED) != 0) move.set_feed(block.feed);
  move.set_role(static_cast<v1::BlockRole>(block.role));
  for (std::uint32_t i = 0; i < block.axis_count; ++i) {
    v1::AxisPosition& position = *move.add_tracking_axes();
    position.set_axis(block.axes[i].axis);
    position.set_position(block.axes[i].position);
  }
}

void write_arc(const trc_block& block, v1::CircularMove& move) {
  write_move(block, move);
  move.set_clockwise(block.kind == TRC_CLOCKWISE);
  if ((block.given & TRC_HAS_RADIUS) != 0) return move.set_radius(block.radius);
  if ((block.given & center_bits) == 0) return;
  v1::Position& center = *move.mutable_center();
  if ((block.given & TRC_HAS_I) != 0) center.set_x(block.i);
  if ((block.given & TRC_HAS_J) != 0) center.set_y(block.j);
  if ((block.given & TRC_HAS_K) != 0) center.set_z(block.k);
}

}  // namespace

std::string write_block(const trc_block& block, wire::Json& json, v1::Block& message) {
  std::string fault = fault_in(block);
  if (!fault.empty()) return fault;
  if ((block.given & TRC_HAS_NUMBER) != 0)
    message.set_source_number(static_cast<std::uint64_t>(block.number));
  switch (block.kind) {
    case TRC_RAPID:
    case TRC_LINE:
      write_move(block, *message.mutable_linear());
      message.mutable_linear()->set_rapid(block.kind == TRC_RAPID);
      break;
    case TRC_CLOCKWISE:
    case TRC_COUNTER_CLOCKWISE:
      write_arc(block, *message.mutable_circular());
      break;
    case TRC_TEXT:
      message.mutable_passthrough()->set_text(block.text);
      break;
    case TRC_COMMAND:
      fault = json.read(block.text, *message.mutable_command());
      if (!fault.empty()) fault = "text: " + fault;
      break;
    default:
      message.mutable_command()->set_side(block.kind == TRC_LEFT    ? v1::COMPENSATION_SIDE_LEFT
                                          : block.kind == TRC_RIGHT ? v1::COMPENSATION_SIDE_RIGHT
                                                                    : v1::COMPENSATION_SIDE_OFF);
  }
  return fault;
}

}  // namespace trc::c
