#pragma once

#include "core/trc/state_archive.h"
#include "core/verify/clearance.h"

namespace trc::verify {

template <class Archive>
void serialize(Archive& archive, Clearance& clearance) {
  auto& [distance, required, place, path, contour, accepted] = clearance;
  archive(distance, required, place, path, contour, accepted);
}

}  // namespace trc::verify
