#include "tests/support/coasts.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace trc::support {
namespace {

using Ring = std::vector<Point>;

constexpr double mm_a_degree = 10;

struct Before {
  bool operator()(const Point& a, const Point& b) const {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  }
};
using Pieces = std::multimap<Point, Ring, Before>;  // by their first points

std::string what_gmt_says(const std::string& resolution) {
  const std::string command =
      "gmt coast -Rd -D" + resolution + " -W -M --GMT_HISTORY=false 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("no pipe from " + command);
  std::string text;
  char part[65536];
  for (std::size_t count = 0; (count = fread(part, 1, sizeof part, pipe.get())) > 0;)
    text.append(part, count);
  return text;
}

// Points of a piece at the rim of the world lie on one side of it or on the other.
Point place(double longitude, double latitude) {
  const double round = std::round(1e4 * longitude) / 1e4;
  return mm_a_degree * Point(round < 0 ? round + 360 : (round >= 360 ? round - 360 : round),
                             std::round(1e4 * latitude) / 1e4);
}

Pieces pieces_in(const std::string& text) {
  Pieces pieces;
  Ring piece;
  const auto keep = [&] {
    if (piece.size() > 1) pieces.emplace(piece.front(), std::move(piece));
    piece.clear();
  };
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('>')) {
      keep();
      continue;
    }
    double longitude = 0;
    double latitude = 0;
    if (!(std::istringstream(line) >> longitude >> latitude))
      throw std::runtime_error("gmt wrote " + line);
    const Point at = place(longitude, latitude);
    if (piece.empty() || piece.back() != at) piece.push_back(at);
  }
  keep();
  return pieces;
}

// Puts pieces together where one begins at the end of another; without the first point again.
std::vector<Ring> rings_of(Pieces pieces) {
  std::vector<Ring> rings;
  while (!pieces.empty()) {
    Ring ring = std::move(pieces.extract(pieces.begin()).mapped());
    while (ring.front() != ring.back()) {
      const auto next = pieces.find(ring.back());
      if (next == pieces.end()) throw std::runtime_error("a coast has an end");
      ring.insert(ring.end(), next->second.begin() + 1, next->second.end());
      pieces.erase(next);
    }
    ring.pop_back();
    if (ring.size() > 2) rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace

// GMT gives them out cut along meridians and parallels.
std::vector<std::vector<Point>> coasts(const std::string& resolution) {
  Pieces pieces = pieces_in(what_gmt_says(resolution));
  if (pieces.empty()) throw std::runtime_error("gmt has no coasts of resolution " + resolution);
  return rings_of(std::move(pieces));
}

}  // namespace trc::support
