#pragma once

#include "core/trc/state_archive.h"
#include "core/verify/clearance.h"
#include "core/verify/measured_path.h"

namespace trc::verify {

template <class Archive>
void serialize(Archive& archive, Clearance& clearance) {
  auto& [distance, required, place, path, contour] = clearance;
  archive(distance, required, place, path, contour);
}

template <class Archive>
void serialize(Archive& archive, Piece& piece) {
  auto& [start, end, center, sweep] = piece;
  archive(start, end, center, sweep);
}

template <class Archive>
void serialize(Archive& archive, Rule& rule) {
  auto& [selection, required, radius, side, nominal, plane, reverses, follows, joins_fine_steps] =
      rule;
  archive(selection, required, radius, side, nominal, plane, reverses, follows, joins_fine_steps);
}

template <class Archive>
void serialize(Archive& archive, ProgrammedPiece& programmed) {
  auto& [piece, source, rule, number, is_contour, crosses_behind, from_anywhere, role] = programmed;
  archive(piece, source, rule, number, is_contour, crosses_behind, from_anywhere, role);
}

template <class Archive>
void serialize(Archive& archive, MeasuredPiece& path) {
  auto& [piece, height, programmed, inserted, on_contour] = path;
  archive(piece, height, programmed, inserted, on_contour);
}

template <class Archive>
void serialize(Archive& archive, Way& way) {
  auto& [piece, height, source, programmed] = way;
  archive(piece, height, source, programmed);
}

}  // namespace trc::verify
