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

#include "core/base/diagnostic.h"
#include "core/base/source.h"
#include "core/base/state.h"

namespace trc {

// The structured bindings here and in the state_archive.h files name every member, so that a new
// one cannot be forgotten.
template <class Archive>
void serialize(Archive& archive, Source& source) {
  auto& [index, number, line, part] = source;
  archive(index, number, line, part);
}

template <class Archive>
void serialize(Archive& archive, DiagnosticValue& named) {
  auto& [name, value] = named;
  archive(name, value);
}

template <class Archive>
void serialize(Archive& archive, DiagnosticPoint& point) {
  auto& [x, y, z] = point;
  archive(x, y, z);
}

template <class Archive>
void serialize(Archive& archive, CallPlace& place) {
  auto& [subprogram, called_from, line_within] = place;
  archive(subprogram, called_from, line_within);
}

template <class Archive>
void serialize(Archive& archive, Slip& slip) {
  auto& [kind, instead] = slip;
  archive(kind, instead);
}

// For a diagnostic that waits for its place: without the additions to an error, after which nothing
// waits, and without the texts of another sender.
template <class Archive>
void serialize(Archive& archive, Diagnostic& diagnostic) {
  auto& [code, severity, source, column, detail, values, point, calls, found_together, told_after,
         entry_help, slip, inch, language, words, texts] = diagnostic;
  archive(code, severity, source, column, detail, values, point, calls, found_together, told_after,
          slip, inch, language, words);
}

}  // namespace trc
