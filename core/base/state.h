#pragma once

// The state that a session carries from one call to the next can be saved and loaded by a later
// session, so that a stream goes on elsewhere. A class with such state has a member template
// `serialize` that names it; an aggregate has a function in a file state_archive.h. archive.h
// defines the archives.
namespace cereal {
class PortableBinaryInputArchive;
class PortableBinaryOutputArchive;
}  // namespace cereal

namespace trc {

using StateReader = cereal::PortableBinaryInputArchive;
using StateWriter = cereal::PortableBinaryOutputArchive;

}  // namespace trc
