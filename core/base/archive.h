#pragma once

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>

#include "core/base/source.h"
#include "core/base/state.h"

namespace trc {

// The structured bindings here and in the other files of this kind name every member, so that a new
// one cannot be forgotten.
template <class Archive>
void serialize(Archive& archive, Source& source) {
  auto& [index, number, line, part] = source;
  archive(index, number, line, part);
}

}  // namespace trc
