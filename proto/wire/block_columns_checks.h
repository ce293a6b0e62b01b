#pragma once

#include "proto/wire/field_fault.h"
#include "trc/v1/block.pb.h"

namespace trc::wire::block_columns {

// Whether kinds, bits and lengths of the columns fit each other; the values are not looked at.
bool check(const v1::BlockColumns& message, const FieldReader& reader);

}  // namespace trc::wire::block_columns
