#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/plane.h"
#include "core/geometry/segment.h"
#include "core/verify/shape.h"

namespace trc::server::http {

// The meaning of an element; each has its colour in the picture. The numbers are sent to clients.
enum class Style : std::uint8_t {
  contour = 0,
  contour_masked = 1,  // programmed, but the tool does not get there
  path = 2,
  transition = 3,  // inserted on the path
  lead = 4,        // approach and retract; programmed, but no wall
  plain = 5,       // motion without compensation, and programmed beside a contour
};
inline constexpr std::uint32_t rapid_flag = 1U << 8U;
inline constexpr std::uint32_t path_flag = 1U << 9U;
// Not drawn: UnknownStarts.
inline constexpr std::uint32_t from_unknown_flag = 1U << 11U;
// A plane other than the shown one is in force there: the tool is seen from the side.
inline constexpr std::uint32_t aside_flag = 1U << 10U;
inline constexpr std::uint32_t plane_shift = 12;

// A motion in the plane that the picture shows.
struct Element {
  Point start = Point::Zero();
  Point end = Point::Zero();
  float third_from = 0;  // mm, across the plane
  float third_to = 0;
  float feed = 0;          // mm/min; 0: rapid, or none programmed
  std::uint32_t line = 0;  // 1-based, of the program; 0: none
  std::int32_t arc = -1;   // index of its arc; a line has none
  float tool_radius = 0;   // mm; 0: not compensated
  Style style = Style::path;
  std::uint8_t origin = 0;  // of v1::CompensatedBlock; 0 on the contour
  bool rapid = false;
  bool from_unknown = false;  // a rapid from an unknown place: measured, but not drawn
  Plane plane = Plane::xy;    // that holds in its block
  bool ends_block = true;     // a block of another plane may be seen as several elements

  // Must be seen at any scale.
  [[nodiscard]] bool is_special() const {
    return style == Style::contour_masked || style == Style::transition;
  }
};

struct ElementArc {
  Point center = Point::Zero();
  double sweep = 0;
};

// Elements in the order they are travelled, with boxes around groups of them.
class Elements {
 public:
  static constexpr std::size_t group_size = 64;

  void add(Element element, const Segment& shape);
  // Changes the style of an existing element.
  void restyle(std::size_t index, Style style);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const Element& operator[](std::size_t index) const {
    return pieces_[index / piece_size][index % piece_size];
  }
  [[nodiscard]] Segment shape_of(const Element& element) const;
  [[nodiscard]] verify::Bounds bounds() const;

  struct Group {
    verify::Bounds box{};
    double length = 0;  // of the way up to its start, mm
    bool has_special = false;
  };
  [[nodiscard]] std::span<const Group> groups() const { return groups_; }
  // Of the whole way, mm.
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] std::uint64_t blocks() const { return blocks_; }
  // The range of the way across the plane, mm.
  [[nodiscard]] double lowest() const { return double{lowest_}; }
  [[nodiscard]] double highest() const { return double{highest_}; }

  struct Place {
    std::size_t element = 0;
    double share = 0;  // of that element
  };
  // The place on the way after so many mm; none without elements.
  [[nodiscard]] std::optional<Place> place_after(double length) const;

 private:
  [[nodiscard]] static double length_of(const Element& element, const Segment& shape);

  static constexpr std::size_t piece_size = 64 * group_size;

  // In pieces, so that millions of elements are never copied.
  std::vector<std::vector<Element>> pieces_;
  std::size_t size_ = 0;
  std::vector<ElementArc> arcs_;
  std::vector<Group> groups_;
  double length_ = 0;
  std::uint64_t blocks_ = 0;
  float lowest_ = 0;
  float highest_ = 0;
};

}  // namespace trc::server::http
